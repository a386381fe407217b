/*
 * Computation of the Taylor coefficients of a motion, order by order. Order 0 and its accelerations are the scene's
 * derived functions (taylor.c), higher orders follow one after the other.
 */
#include "../scalar_simd/scalar.h"

#define SeriesWide Wide
/* few products: a register of half the width has no idle parts */
typedef double SeriesRow __attribute__((vector_size(TAYLOR <= 8 && REGISTER > 32 ? 32 : REGISTER)));
#include "../scalar_simd/series.h"

/*
 * Compute coefficients[k], k = 0 ... order, of the Taylor series of the integrated state at time t, where it is y.
 * Return 0 or the number of the pivot that vanished; then only coefficients[0] is valid.
 */
int compute_taylor_series(double t, const double *y, const Parameters *p, int order, double (*coefficients)[TAYLOR_Y])
{
    SeriesRow (*const factors)[TAYLOR_ORDERS][SERIES_ROWS] = get_series_factors();
    TaylorValues at;
    for (int i = 0; i < N_Y; i++)
        coefficients[0][i] = y[i];
    const int status = taylor_values(t, y, y + N_X, p, &at, coefficients[1] + N_X, coefficients[1] + 2 * N_X);
    if (!status)
        compute_series_orders(p, &at, order, coefficients, factors[0], factors[1]);
    return status;
}
