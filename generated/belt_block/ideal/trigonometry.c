/*
 * Sines and cosines of several angles at once, four side by side (vectors of gcc and clang; plain C elsewhere in
 * this file stays as it is where the processor has shorter ones). x = k pi/2 + r with |r| <= pi/4: k is what
 * remains of adding 1.5 2^52, pi/2 is subtracted in three parts, of which the first two times k are exact
 * (W. J. Cody, W. Waite, Software Manual for the Elementary Functions, 1980). Polynomials: the coefficients of
 * fdlibm (Sun Microsystems, 1993), errors below 2^-58. Results are within 1 unit in the last place or so.
 */
typedef double Four __attribute__((vector_size(32)));
typedef long long FourBits __attribute__((vector_size(32)));

static const double TURN_LIMIT = 1e5; /* rad; larger angles go to the library's functions, which take all care */

static void turned_by_library(const Four *angle, Four *sine, Four *cosine)
{
    for (int k = 0; k < 4; k++) {
        (*sine)[k] = sin((*angle)[k]);
        (*cosine)[k] = cos((*angle)[k]);
    }
}

static inline void sines_and_cosines(const Four *angle, Four *sine, Four *cosine)
{
    const double shift = 6755399441055744.0;
    const double half_1 = 1.57079632673412561417, half_2 = 6.07710050630396597660e-11, half_3 = 2.02226624879595063154e-21;
    const Four x = *angle, shifted = x * 0.63661977236758134308 + shift, turns = shifted - shift;
    const FourBits quarter = (FourBits)shifted, small = (x < TURN_LIMIT) & (x > -TURN_LIMIT);
    const Four r = ((x - turns * half_1) - turns * half_2) - turns * half_3;
    const Four z = r * r, w = z * z;
    const Four s_high = 8.33333333332248946124e-03 + z * (-1.98412698298579493134e-04 + z * 2.75573137070700676789e-06)
        + z * w * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10);
    const Four s = r + z * r * (-1.66666666666666324348e-01 + z * s_high);
    const Four c_high = z * (4.16666666666666019037e-02 + z * (-1.38888888888741095749e-03 + z * 2.48015872894767294178e-05))
        + w * w * (-2.75573143513906633035e-07 + z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11));
    const Four half = 0.5 * z, rest = 1.0 - half;
    const Four c = rest + (((1.0 - rest) - half) + z * c_high);
    /* odd quarters exchange sine and cosine; the sign of the sine is that of the half turn, and of the next quarter's */
    const FourBits odd = -(quarter & 1), s_bits = (FourBits)s, c_bits = (FourBits)c;
    *sine = (Four)(((c_bits & odd) | (s_bits & ~odd)) ^ ((quarter & 2) << 62));
    *cosine = (Four)(((s_bits & odd) | (c_bits & ~odd)) ^ (((quarter + 1) & 2) << 62));
    if (!(small[0] & small[1] & small[2] & small[3]))
        turned_by_library(angle, sine, cosine);
}

/* Of n groups. */
static inline void many_sines_and_cosines(int n, const Four *angle, Four *sine, Four *cosine)
{
    for (int k = 0; k < n; k++)
        sines_and_cosines(&angle[k], &sine[k], &cosine[k]);
}
