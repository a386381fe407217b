/*
 * Sines and cosines of several angles at once, four side by side (vectors of gcc and clang; plain C elsewhere in
 * this file stays as it is where the processor has shorter ones). x = k pi/2 + r with |r| <= pi/4: k is what
 * remains of adding 1.5 2^52, pi/2 is subtracted in three parts, of which the first two times k are exact
 * (W. J. Cody, W. Waite, Software Manual for the Elementary Functions, 1980). Polynomials: the coefficients of
 * fdlibm (Sun Microsystems, 1993), errors below 2^-58. Results are within 1.5 units in the last place up to 100 rad,
 * within 2.4 up to 1e5; what r is rounded by is left out.
 */
typedef double Four __attribute__((vector_size(32)));
typedef long long FourBits __attribute__((vector_size(32)));

static void turned_by_library(const Four *angle, Four *sine, Four *cosine)
{
    for (int k = 0; k < 4; k++) {
        (*sine)[k] = sin((*angle)[k]);
        (*cosine)[k] = cos((*angle)[k]);
    }
}

static inline void sines_and_cosines(const Four *angles, Four *sine, Four *cosine)
{
    const Four angle = *angles;
#define SINES_OF Four
#define SINES_BITS FourBits
#include "sines.h"
#undef SINES_OF
#undef SINES_BITS
    if (!(small[0] & small[1] & small[2] & small[3]))
        turned_by_library(angles, sine, cosine);
}

/* Of n groups. */
static inline void many_sines_and_cosines(int n, const Four *angle, Four *sine, Four *cosine)
{
    for (int k = 0; k < n; k++)
        sines_and_cosines(&angle[k], &sine[k], &cosine[k]);
}
