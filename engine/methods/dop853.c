/*
 * DOP853: the explicit method of order 8 of Dormand and Prince with dense output of order 7.
 * E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I (1993), section II.5.
 */

#include "../scalar_simd/dop853.h"

/* Fractions of a step, ascending, at which the error estimate evaluates the equations. */
static const double dop853_error_nodes[] = {0.0, 0.25, 0.3076923076923077, 0.3333333333333333, 0.6, 0.6512820512820513,
    0.8571428571428571, 1.0};

/* Compute the state y (N_Y) at fraction s of a step from its dense output of order 7, which must have been computed. */
static void dop853_interpolate(const Integrator *run, const Step *step, double s, double *y)
{
    const double (*d)[N_Y] = (const double (*)[N_Y])step->dense;
    const double u = 1.0 - s;
    for (int i = 0; i < N_Y; i++)
        y[i] = run->y[i] + s * (d[0][i] + u * (d[1][i] + s * (d[2][i] + u * (d[3][i] + s * (d[4][i]
            + u * (d[5][i] + s * d[6][i]))))));
}

/*
 * The method dop853. At h rho = 5.65 the estimate of order 5 vanishes for a decaying mode, at 6.4 the mode grows. Both
 * are zeros of polynomials that follow from the coefficients.
 */
static const Method dop853 = {.name = "dop853", .try = dop853_try_step, .dense = dop853_compute_dense_output,
    .interpolate = dop853_interpolate, .power = 0.125, .rejected_h_rho = 4.8, .limiting_h_rho = 4.0,
    .stages = DOP853_STAGES, .dense_stages = DOP853_DENSE_STAGES, .degree = 7, .reversed = 0x2a,
    .error_nodes = dop853_error_nodes, .n_error_nodes = COUNT_OF(dop853_error_nodes)};
