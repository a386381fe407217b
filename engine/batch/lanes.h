/*
 * Several runs side by side: a number of each in the lanes of one vector (extensions of gcc and clang). Lane by lane
 * the operations are those of a single run, in the same order, so that the results are the same to the last bit;
 * functions that only the library has are called for one lane after the other.
 */
#ifndef GUDGEON_LANES_H
#define GUDGEON_LANES_H
#include "../run/run.h"
#include <time.h>

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

static inline LaneBits is_not(LaneBits mask) { return ~mask; }

static inline int any_of(LaneBits mask)
{
#if defined(__GNUC__) && !defined(__clang__) && defined(__AVX512DQ__)
    return __builtin_ia32_cvtq2mask512(mask) != 0;
#elif defined(__GNUC__) && !defined(__clang__) && defined(__AVX__) && !defined(__AVX512F__)
    return __builtin_ia32_movmskpd256((Lanes)mask) != 0;
#else
    long long some = 0;
    for (int k = 0; k < LANES; k++)
        some |= mask[k];
    return some != 0;
#endif
}

/* As max_of, min_of, sign_of: a NaN in x stays. */
static inline Lanes lanes_max_of(Lanes x, Lanes y) { return pick(x < y, y, x); }
static inline Lanes lanes_min_of(Lanes x, Lanes y) { return pick(x > y, y, x); }
static inline Lanes lanes_sign_of(Lanes x) { return pick(x > 0.0, all_of(1.0), pick(x < 0.0, all_of(-1.0), x)); }
static inline Lanes lanes_fabs(Lanes x) { return (Lanes)((LaneBits)x & 0x7fffffffffffffffLL); }

/* As mod_of, mod_on, period_side. */
static inline Lanes lanes_mod_of(Lanes a, Lanes b)
{
    for (int k = 0; k < LANES; k++)
        a[k] = mod_of(a[k], b[k]);
    return a;
}
static inline Lanes lanes_mod_on(Lanes a, Lanes b, Lanes side)
{
    for (int k = 0; k < LANES; k++)
        a[k] = mod_on(a[k], b[k], side[k]);
    return a;
}
static inline Lanes lanes_period_side(Lanes a, Lanes b)
{
    for (int k = 0; k < LANES; k++)
        a[k] = period_side(a[k], b[k]);
    return a;
}

/* As just_ahead, just_behind, finite_slope. */
static inline Lanes lanes_just_ahead(Lanes x) { return x + 1e-9 * (1.0 + lanes_fabs(x)); }
static inline Lanes lanes_just_behind(Lanes x) { return x - 1e-9 * (1.0 + lanes_fabs(x)); }
static inline Lanes lanes_finite_slope(Lanes derivative, Lanes ahead, Lanes behind, Lanes way)
{
    return pick(lanes_fabs(derivative) < INFINITY, derivative, (ahead - behind) / way);
}

static inline Lanes lanes_sqrt(Lanes x)
{
#if defined(__GNUC__) && !defined(__clang__) && defined(__AVX512F__)
    return (Lanes)__builtin_ia32_sqrtpd512_mask(x, x, (char)-1, 4);
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
LANE_AFTER_LANE_OF_TWO(atan2)
LANE_AFTER_LANE(tan)
LANE_AFTER_LANE(asin)
LANE_AFTER_LANE(acos)
LANE_AFTER_LANE(atan)
LANE_AFTER_LANE(sinh)
LANE_AFTER_LANE(cosh)
LANE_AFTER_LANE(tanh)

/* As sine_of, cosine_of, exp_of, log_of, power_of of scene/functions.h; what is beyond their ranges goes to the library lane by lane. */
typedef unsigned long long LaneWords __attribute__((vector_size(8 * LANES)));
static inline LaneWords lanes_bits_of(Lanes x) { return (LaneWords)x; }
static inline Lanes lanes_of_bits(LaneWords bits) { return (Lanes)bits; }
static inline Lanes lanes_entries(const double *table, int width, LaneWords bits, int k)
{
    Lanes found = {0.0};
    for (int lane = 0; lane < LANES; lane++)
        found[lane] = table[(bits[lane] & 127) * (size_t)width + (size_t)k];
    return found;
}
#define PARTS_OF Lanes
#define PARTS_BITS LaneWords
#define PARTS_NAMED(name) lanes_##name
#define PARTS_POWER(bits) __builtin_convertvector((LaneBits)(bits) >> 52, Lanes)
#define PARTS_ENTRY(table, bits, k) lanes_entries(table[0], sizeof table[0] / sizeof(double), bits, k)
#include "../scene/parts.h"
#undef PARTS_OF
#undef PARTS_BITS
#undef PARTS_NAMED
#undef PARTS_POWER
#undef PARTS_ENTRY

static inline Lanes lanes_sin(Lanes x)
{
    Lanes r, rest;
    const LaneBits fits = lanes_fabs(x) < TURN_LIMIT, k = (LaneBits)lanes_quarters(x, &r, &rest);
    Lanes found = pick((k & 1) != 0, lanes_cosine_near(r, rest), lanes_sine_near(r, rest));
    found = pick((k & 2) != 0, -found, found);
    for (int i = 0; any_of(~fits) && i < LANES; i++)
        found[i] = fits[i] ? found[i] : sin(x[i]);
    return found;
}

static inline Lanes lanes_cos(Lanes x)
{
    Lanes r, rest;
    const LaneBits fits = lanes_fabs(x) < TURN_LIMIT, k = (LaneBits)lanes_quarters(x, &r, &rest);
    Lanes found = pick((k & 1) != 0, lanes_sine_near(r, rest), lanes_cosine_near(r, rest));
    found = pick(((k + 1) & 2) != 0, -found, found);
    for (int i = 0; any_of(~fits) && i < LANES; i++)
        found[i] = fits[i] ? found[i] : cos(x[i]);
    return found;
}

static inline LaneBits lanes_is_normal(Lanes x) { return (x >= DBL_MIN) & (x <= DBL_MAX); }

static inline Lanes lanes_exp(Lanes x)
{
    const LaneBits fits = lanes_fabs(x) < 700.0;
    Lanes found = lanes_exp_of_parts(pick(fits, x, all_of(0.0)), all_of(0.0));
    for (int k = 0; any_of(~fits) && k < LANES; k++)
        found[k] = fits[k] ? found[k] : exp(x[k]);
    return found;
}

static inline Lanes lanes_log(Lanes x)
{
    const LaneBits fits = lanes_is_normal(x);
    Lanes rest, found = lanes_log_in_parts(pick(fits, x, all_of(1.0)), &rest);
    for (int k = 0; any_of(~fits) && k < LANES; k++)
        found[k] = fits[k] ? found[k] : log(x[k]);
    return found;
}

static inline Lanes lanes_pow(Lanes x, Lanes y)
{
    const LaneBits none = ((LaneBits)x == 0) & (y > 0.0); /* a contact's law where there is no contact */
    const LaneBits normal = lanes_is_normal(x) & (lanes_fabs(y) < 0x1p60);
    Lanes rest;
    const Lanes log_x = lanes_log_in_parts(pick(normal, x, all_of(1.0)), &rest), x_high = lanes_upper_half(log_x);
    const Lanes y_high = lanes_upper_half(y), high = y_high * x_high;
    const LaneBits fits = normal & (lanes_fabs(high) < 690.0);
    const Lanes less = (y - y_high) * x_high + y * (log_x - x_high + rest);
    Lanes found = pick(none, all_of(0.0), lanes_exp_of_parts(pick(fits, high, all_of(0.0)), less));
    for (int k = 0; any_of(~(fits | none)) && k < LANES; k++)
        found[k] = (fits | none)[k] ? found[k] : pow(x[k], y[k]);
    return found;
}

/* As scene/trigonometry.h; lanes whose angle is so large that there the library is asked are marked as rare. */
static inline void sines_and_cosines(Lanes angle, Lanes *sine, Lanes *cosine, LaneBits *rare)
{
#define SINES_OF Lanes
#define SINES_BITS LaneBits
#include "../scene/sines.h"
#undef SINES_OF
#undef SINES_BITS
    *rare |= ~small;
}

/*
 * Corners. Methods that choose their step (HELD) hold contacts and sides of corners over it and are told where the
 * switching functions are; with rk4 both are as the state says. side: NULL where a function holds none.
 */
#if HELD
#define held_sides(memory) (memory)->side
#define told_sides(aside) (aside)->g
static inline Lanes lanes_side_of(const Lanes *side, Lanes *g, int k, Lanes value)
{
    g[k] = value;
    return side ? side[k] : lanes_sign_of(value);
}
#else
#define held_sides(memory) NULL
#define told_sides(aside) NULL
static inline Lanes lanes_side_of(const Lanes *side, Lanes *g, int k, Lanes value)
{
    (void)side, (void)g, (void)k;
    return lanes_sign_of(value);
}
#endif

/* Corners first to last - 1 of a joint do not switch; the same, those of its film put aside. */
static inline void silence(Lanes *g, int first, int last)
{
    for (int k = first; HELD && k < last; k++)
        g[k] = all_of(NAN);
}
static inline void set_aside(Lanes *g, Lanes *film, int first, int last)
{
    for (int k = first; HELD && k < last; k++)
        film[k] = g[k];
    silence(g, first, last);
}

/* What switches in a joint: of its film where it is free, of the contact elsewhere, where both are mixed of both. */
static inline void put_together(Lanes *g, const Lanes *film, int first, int last, LaneBits touching, LaneBits mixed)
{
    for (int k = first; HELD && k < last; k++)
        g[k] = pick(touching, pick(mixed & (g[k] != g[k]), film[k], g[k]), film[k]);
}

/* What the text in both/ is made of here. */
#define Real Lanes
#define Truth LaneBits
#define RunOf LaneRun
#define MemoryOf LaneMemory
#define AsideOf LaneAside
#define ClearanceOf LaneClearance
#define ParametersOf LaneParameters
#define StepOf LaneStep
static inline Lanes real_of(double x) { return all_of(x); }
static inline Lanes real_max(Lanes x, Lanes y) { return lanes_max_of(x, y); }
static inline Lanes real_abs(Lanes x) { return lanes_fabs(x); }
static inline Lanes real_sqrt(Lanes x) { return lanes_sqrt(x); }

/* As Latch, Memory, PinForce, Clearance, Aside, Linear of a single run. */
typedef struct {
    Lanes closed, deltadot_minus;
} LaneLatch;

typedef struct {
    LaneLatch latch[AT_LEAST_ONE(N_CLEARANCES)];
    Lanes event_side[AT_LEAST_ONE(N_USER_EVENTS)];
#if HELD
    Lanes side[AT_LEAST_ONE(N_SWITCHES)];
#endif
    LaneBits rare; /* lanes whose step the single runs are to make */
} LaneMemory;

typedef struct {
    Lanes n, t, M_i, M_j, v_t;
} LanePinForce;

typedef struct {
    Lanes Fx, Fy, F_n, F_t, e, deltadot, delta, moment_first, moment_second, power;
#if HELD
    Lanes ex, ey, v_t;
#endif
} LaneClearance;

typedef struct {
    Lanes lambda[N_LOOPS + 1], power[N_WORK], event[AT_LEAST_ONE(N_USER_EVENTS)];
    LaneClearance clearance[AT_LEAST_ONE(N_CLEARANCES)];
#if HELD
    Lanes g[AT_LEAST_ONE(N_SWITCHES)];
#endif
} LaneAside;

static inline LaneBits is_closed(const LaneLatch *latch) { return latch->closed > 0.0; }

/* Whether a joint has its dry contact. */
static inline LaneBits is_touching(const LaneLatch *latch, Lanes delta)
{
    return HELD ? is_closed(latch) : (LaneBits)(delta > 0.0);
}

static double lane_seconds(void)
{
    struct timespec now;
    timespec_get(&now, TIME_UTC);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

#if HELD
typedef struct {
    const struct LaneParameters *p;
    Lanes value[AT_LEAST_ONE(N_VALUES)], lu[AT_LEAST_ONE(N_FACTORS)];
} LaneLinear;

/* Of a run by a method that chooses its step: what a step that is tried begins with. */
typedef struct {
    Lanes t, y[N_Y], dy[N_Y], weight[N_Y], accept, stability;
    LaneMemory memory;
    LaneAside aside;
    LaneLinear linear;
} LaneRun;

/* As Step; lanes in which it is accepted, and in which the single runs are to try it. */
typedef struct {
    Lanes t, h, error, y[N_Y], dy[N_Y], k[N_STAGES][N_Y];
    LaneAside aside;
    int dense_ready, n_seen;
    double node[N_STAGES];
    Lanes seen[N_STAGES][AT_LEAST_ONE(N_MARGINS)], rate[AT_LEAST_ONE(N_CLEARANCES)][2];
    Lanes least[2 * N_X + 1], most[2 * N_X + 1];
    LaneBits taken, lost;
} LaneStep;
#else
#define Number Lanes
#define Flag LaneBits
typedef struct {
#include "moving.h"
    LaneMemory memory; /* Moving ends before what is rare */
    LaneAside aside;
} LaneRun;
#undef Number
#undef Flag
#endif

#endif
