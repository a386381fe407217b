/*
 * Several runs side by side: a number of each in the lanes of one vector (extensions of gcc and clang). Lane by lane
 * the operations are those of a single run, in the same order, so that the results are the same to the last bit;
 * functions that only the library has are called for one lane after the other.
 */
#if defined(__AVX512F__)
enum { LANES = 8 };
#elif defined(__AVX__)
enum { LANES = 4 };
#else
enum { LANES = 2 };
#endif
typedef double Lanes __attribute__((vector_size(8 * LANES)));
typedef long long LaneBits __attribute__((vector_size(8 * LANES)));

static inline Lanes all_of(double x) { return x - (Lanes){0.0}; }

/* a where the mask is set, else b. */
static inline Lanes pick(LaneBits mask, Lanes a, Lanes b)
{
    return (Lanes)(((LaneBits)a & mask) | ((LaneBits)b & ~mask));
}

static inline int any_of(LaneBits mask)
{
    long long some = 0;
    for (int k = 0; k < LANES; k++)
        some |= mask[k];
    return some != 0;
}

/* As max_of, min_of, sign_of: a NaN in x stays. */
static inline Lanes lanes_max_of(Lanes x, Lanes y) { return pick(x < y, y, x); }
static inline Lanes lanes_min_of(Lanes x, Lanes y) { return pick(x > y, y, x); }
static inline Lanes lanes_sign_of(Lanes x) { return pick(x > 0.0, all_of(1.0), pick(x < 0.0, all_of(-1.0), x)); }
static inline Lanes lanes_fabs(Lanes x) { return (Lanes)((LaneBits)x & 0x7fffffffffffffffLL); }

static inline Lanes lanes_sqrt(Lanes x)
{
#if defined(__GNUC__) && !defined(__clang__) && defined(__AVX512F__)
    return (Lanes)__builtin_ia32_sqrtpd512_mask(x, x, (unsigned char)-1, 4);
#elif defined(__GNUC__) && !defined(__clang__) && defined(__AVX__)
    return (Lanes)__builtin_ia32_sqrtpd256(x);
#elif defined(__GNUC__) && !defined(__clang__) && defined(__SSE2__)
    return (Lanes)__builtin_ia32_sqrtpd(x);
#else
    Lanes y;
    for (int k = 0; k < LANES; k++)
        y[k] = sqrt(x[k]);
    return y;
#endif
}

#define LANE_AFTER_LANE(function) \
    static inline Lanes lanes_##function(Lanes x) \
    { \
        Lanes y = {0.0}; \
        for (int k = 0; k < LANES; k++) \
            y[k] = function(x[k]); \
        return y; \
    }
#define LANE_AFTER_LANE_OF_TWO(function) \
    static inline Lanes lanes_##function(Lanes a, Lanes b) \
    { \
        Lanes y = {0.0}; \
        for (int k = 0; k < LANES; k++) \
            y[k] = function(a[k], b[k]); \
        return y; \
    }
LANE_AFTER_LANE_OF_TWO(pow)
LANE_AFTER_LANE_OF_TWO(atan2)
LANE_AFTER_LANE(sin)
LANE_AFTER_LANE(cos)
LANE_AFTER_LANE(tan)
LANE_AFTER_LANE(asin)
LANE_AFTER_LANE(acos)
LANE_AFTER_LANE(atan)
LANE_AFTER_LANE(sinh)
LANE_AFTER_LANE(cosh)
LANE_AFTER_LANE(tanh)
LANE_AFTER_LANE(exp)
LANE_AFTER_LANE(log)

/* As trigonometry.c; lanes whose angle is so large that there the library is asked are marked as rare. */
static const double TURN_LIMIT = 1e5; /* rad */

static inline void sines_and_cosines(Lanes angle, Lanes *sine, Lanes *cosine, LaneBits *rare)
{
    const double shift = 6755399441055744.0;
    const double half_1 = 1.57079632673412561417, half_2 = 6.07710050630396597660e-11, half_3 = 2.02226624879595063154e-21;
    const Lanes x = angle, shifted = x * 0.63661977236758134308 + shift, turns = shifted - shift;
    const LaneBits quarter = (LaneBits)shifted, small = (x < TURN_LIMIT) & (x > -TURN_LIMIT);
    const Lanes r = ((x - turns * half_1) - turns * half_2) - turns * half_3;
    const Lanes z = r * r, w = z * z;
    const Lanes s_high = 8.33333333332248946124e-03 + z * (-1.98412698298579493134e-04 + z * 2.75573137070700676789e-06)
        + z * w * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10);
    const Lanes s = r + z * r * (-1.66666666666666324348e-01 + z * s_high);
    const Lanes c_high = z * (4.16666666666666019037e-02 + z * (-1.38888888888741095749e-03 + z * 2.48015872894767294178e-05))
        + w * w * (-2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11));
    const Lanes half = 0.5 * z, rest = 1.0 - half;
    const Lanes c = rest + (((1.0 - rest) - half) + z * c_high);
    /* odd quarters exchange sine and cosine; the sign of the sine is that of the half turn, and of the next quarter's */
    const LaneBits odd = -(quarter & 1), s_bits = (LaneBits)s, c_bits = (LaneBits)c;
    *sine = (Lanes)(((c_bits & odd) | (s_bits & ~odd)) ^ ((quarter & 2) << 62));
    *cosine = (Lanes)(((s_bits & odd) | (c_bits & ~odd)) ^ (((quarter + 1) & 2) << 62));
    *rare |= ~small;
}
