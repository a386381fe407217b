/*
 * Sines and cosines of several angles, four at a time in SIMD vectors of gcc and clang. Other compilers compute one
 * after the other, by the same operations. Reduction of angles: x = k pi/2 + r with |r| <= pi/4: k is what remains of
 * adding 1.5 2^52, pi/2 is subtracted in three parts, of which the first two times k are exact (W. J. Cody, W. Waite,
 * Software Manual for the Elementary Functions, 1980). Polynomials: the coefficients of fdlibm (Sun Microsystems,
 * 1993), errors below 2^-58. Results are within 1.5 units in the last place up to 100 rad, within 2.4 up to 1e5; what r
 * is rounded by is left out.
 */
#ifdef __GNUC__
typedef double Four __attribute__((vector_size(32)));
typedef long long FourBits __attribute__((vector_size(32)));

/* Compute sines and cosines of four angles (rad) by the C library, for large angles. */
static void compute_sines_by_library(const Four *angles, Four *sines, Four *cosines)
{
    for (int k = 0; k < 4; k++) {
        (*sines)[k] = sin((*angles)[k]);
        (*cosines)[k] = cos((*angles)[k]);
    }
}

/* Compute sines and cosines of four angles (rad) at once in a vector; if one is large, all use the C library. */
static inline void compute_sines_and_cosines(const Four *angles, Four *sine, Four *cosine)
{
    const Four angle = *angles;
#define SINES_OF Four
#define SINES_BITS FourBits
#define BITS_OF(x) ((FourBits)(x))
#define OF_BITS(x) ((Four)(x))
#include "sines.h"
#undef SINES_OF
#undef SINES_BITS
#undef BITS_OF
#undef OF_BITS
    if (!(small[0] & small[1] & small[2] & small[3]))
        compute_sines_by_library(angles, sine, cosine);
}

#else
typedef double Four[4];

/* Compute sine and cosine of an angle (rad); large angles use the C library. */
static void compute_sine_and_cosine(double angle, double *sine, double *cosine)
{
#define SINES_OF double
#define SINES_BITS uint64_t
#define BITS_OF to_bits
#define OF_BITS from_bits
#include "sines.h"
#undef SINES_OF
#undef SINES_BITS
#undef BITS_OF
#undef OF_BITS
    if (!small) {
        *sine = sin(angle);
        *cosine = cos(angle);
    }
}

/* Compute sines and cosines of four angles (rad), one after the other, by the operations of the vector form. */
static void compute_sines_and_cosines(const Four *angles, Four *sine, Four *cosine)
{
    for (int k = 0; k < 4; k++)
        compute_sine_and_cosine((*angles)[k], &(*sine)[k], &(*cosine)[k]);
}
#endif

/*
 * Compute sines and cosines of n_groups groups of four angles (rad). Called by emitted code for all angles of a
 * linkage.
 */
static inline void compute_sine_and_cosine_groups(int n_groups, const Four *angles, Four *sines, Four *cosines)
{
    for (int i = 0; i < n_groups; i++)
        compute_sines_and_cosines(&angles[i], &sines[i], &cosines[i]);
}
