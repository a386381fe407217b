/*
 * Explicit Runge-Kutta methods that are defined by their coefficients. A new method is a Tableau, its source, and a
 * line of METHODS. The last stage is at the end of the step, where rates are evaluated once more after all stages.
 */
#include "../scalar_simd/runge_kutta.h"

/*
 * Try a step of length h (s) of an explicit Runge-Kutta method by the Butcher tableau of step->method: stages, error
 * and end, into `step`. Return 0 or the status.
 */
static int tableau_try_step(Integrator *run, double h, const Parameters *p, Step *step)
{
    return runge_kutta_try_step(run, step->method->tableau, h, p, step);
}

/* Compute the dense output of a step by the Butcher tableau of its method. Return 0. */
static int tableau_compute_dense_output(Integrator *run, const Parameters *p, Step *step)
{
    (void)p;
    runge_kutta_compute_dense_output(run, step->method->tableau, step);
    return 0;
}

/*
 * Compute the state y (N_Y) at fraction s of a step from its dense output of degree 4, which must have been computed.
 * With u = 1 - s it is y0 + s (d0 + u (d1 + s (d2 + u d3))).
 */
static void tableau_interpolate(const Integrator *run, const Step *step, double s, double *y)
{
    const double u = 1.0 - s;
    for (int i = 0; i < N_Y; i++)
        y[i] = run->y[i] + s * (step->dense[0][i] + u * (step->dense[1][i] + s * (step->dense[2][i]
            + u * step->dense[3][i])));
}

/* Fields of a Method that is defined by a tableau. */
#define BY_TABLEAU .try = tableau_try_step, .dense = tableau_compute_dense_output, \
    .interpolate = tableau_interpolate, .degree = 4, .reversed = 0xa

/* Fractions of a step, ascending, at which rk4 evaluates the equations. */
static const double rk4_error_nodes[] = {0.0, 0.5, 1.0};

/* The classical method of order 4, for fixed steps; in the full formulation Baumgarte's terms stabilize it. */
static const Method rk4 = {.name = "rk4", BY_TABLEAU, .tableau = &classical, .stages = RK4_STAGES,
    .lane_method = METHOD_RK4,
    .uses_baumgarte_terms = !TREE, .power = 1.0 / 4.0, .rejected_h_rho = 2.8, .limiting_h_rho = 2.5,
    .error_nodes = rk4_error_nodes, .n_error_nodes = COUNT_OF(rk4_error_nodes)};

/* Fractions of a step, ascending, of the error estimate of dopri5. */
static const double dopri5_error_nodes[] = {0.0, 0.3, 0.8, 8.0 / 9.0, 1.0};

/* The method of order 5 of Dormand and Prince. A decaying mode grows for h rho > 3.3. */
static const Method dopri5 = {.name = "dopri5", BY_TABLEAU, .tableau = &dormand_prince, .stages = DOPRI5_STAGES,
    .lane_method = METHOD_DOPRI5, .power = 1.0 / 5.0, .rejected_h_rho = 3.3, .limiting_h_rho = 2.7,
    .error_nodes = dopri5_error_nodes, .n_error_nodes = COUNT_OF(dopri5_error_nodes)};
