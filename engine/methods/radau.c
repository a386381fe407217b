/* Radau IIA of orders 5 and 9: dense output and method tables, and the functions of one run that scalar_simd/radau.h
 * needs. */

/*
 * Factorize Newton's matrix of a Radau method, from the linearization of the run, into `matrix`. eta + i eta_i (s): the
 * step length divided by a complex eigenvalue of the method's matrix. Return 0, or NOT_FINITE if it is singular.
 */
static int factor_complex_matrix(Integrator *run, double eta, double eta_i, ComplexLinear *matrix)
{
    matrix->p = run->newton.linear.p;
    matrix->value = run->newton.linear.value;
    return newton_factor_complex(eta, eta_i, matrix) ? NOT_FINITE : 0;
}

/*
 * Update the iteration history of a run before a step, from which the first guess of the stages is extrapolated. In
 * lanes, the function of this name copies it.
 */
static void load_stage_predictor(Integrator *run) { update_stage_predictor(run); }

/*
 * Do nothing: for one run, evaluate_run_rhs() counts its own evaluations. In lanes, n evaluations of the active runs
 * are counted here.
 */
static void count_stage_evaluations(Integrator *run, int is_active, int n) { (void)run, (void)is_active, (void)n; }

/*
 * Begin a Newton iteration of the stages: discard the values of the stages that the last iteration stored in `step`.
 * The other arguments are used in lanes only.
 */
static void begin_stage_iteration(Integrator *run, Step *step, int is_active, int n)
{
    (void)run, (void)is_active, (void)n;
    discard_stages(step);
}

/*
 * Store the event functions, squared forces and gap rates at one stage of a Newton iteration (record_stage()), and
 * extend the range of the stages by the state y. node: fraction of the step; rhs: outputs of the right-hand side at y.
 * is_active is not used: it is the mask of the lanes where radau_step.h is compiled for lanes.
 */
static void record_newton_stage(Integrator *run, Step *step, int is_active, const double *y, const RhsOutputs *rhs,
    double node)
{
    (void)is_active;
    extend_stage_range(step, y);
    record_stage(run, step, rhs, node);
}

/* Return NOT_FOUND, which rejects the step, if the iteration of its stages failed (`has_failed`); else 0. */
static int mark_failed_stages(Integrator *run, int has_failed) { return (void)run, has_failed ? NOT_FOUND : 0; }

#include "../scalar_simd/radau.h"

/*
 * Compute the dense output of a Radau step: the collocation polynomial through its stages. Return 0. Without films,
 * positions are Hermite's quintic through both ends with their accelerations. With three stages velocities are its
 * derivative, of a higher order, unless rounding of positions exceeds it. With films, the quintic would multiply errors
 * of accelerations by h rho.
 */
static int radau_compute_dense_output(Integrator *run, Step *step, const RadauTable *table, int stages)
{
    const double h = step->h;
    double (*const d)[N_Y] = step->dense, change[N_Y];
    const double *values[RADAU_MAX_STAGES];
    for (int i = 0; i < N_Y; i++)
        change[i] = step->y[i] - run->y[i];
    for (int s = 0; s < stages; s++)
        values[s] = s < stages - 1 ? step->k[s] : change;
    compute_collocation_polynomial(table, stages, values, d);
    for (int i = 0; i < N_X && !has_films(); i++) {
        const int v = N_X + i;
        d[0][i] = step->y[i] - run->y[i];
        d[1][i] = h * run->y[v] - d[0][i];
        d[2][i] = d[0][i] - d[1][i] - h * step->y[v];
        d[3][i] = 0.5 * h * h * run->dy[v] + d[1][i] - d[2][i];
        d[4][i] = 0.5 * h * h * step->dy[v] + d[1][i] + 2.0 * d[2][i] - d[3][i];
        /* the derivative would divide the rounding of positions by h */
        if (stages > 3 || 64.0 * DBL_EPSILON * fabs(run->y[i]) * run->norm.weight[v] > h)
            continue;
        d[0][v] = step->y[v] - run->y[v];
        d[1][v] = h * run->dy[v] - d[0][v];
        d[2][v] = d[0][v] - d[1][v] - h * step->dy[v];
        d[3][v] = 5.0 * d[4][i] / h;
    }
    return 0;
}

/* Compute the dense output of a step of radau5, with three stages (radau_compute_dense_output()). Return 0. */
static int radau5_compute_dense_output(Integrator *run, const Parameters *p, Step *step)
{
    return (void)p, radau_compute_dense_output(run, step, &RADAU5, 3);
}

/* Compute the dense output of a step of radau9, with five stages (radau_compute_dense_output()). Return 0. */
static int radau9_compute_dense_output(Integrator *run, const Parameters *p, Step *step)
{
    return (void)p, radau_compute_dense_output(run, step, &RADAU9, 5);
}

/*
 * Compute the state y (N_Y) at fraction s of a Radau step from its dense output of degree 5, which must have been
 * computed.
 */
static void radau_interpolate(const Integrator *run, const Step *step, double s, double *y)
{
    evaluate_collocation_polynomial(run->y, (const double (*)[N_Y])step->dense, s, y);
}

/* Fractions of a step, ascending, at which radau5 evaluates the equations. */
static const double radau5_error_nodes[] = {0.0, 0.15505102572168219, 0.64494897427831781, 1.0};

/* Fractions of a step, ascending, at which radau9 evaluates the equations. */
static const double radau9_error_nodes[] = {0.0, 0.057104196114517682, 0.27684301363812383, 0.58359043236891682,
    0.86024013565621945, 1.0};

/* The method Radau IIA of order 5 with three stages. */
static const Method radau5 = {.name = "radau5", .try = radau5_try_step, .dense = radau5_compute_dense_output,
    .interpolate = radau_interpolate, .power = 1.0 / 4.0, .stiff = 1, .lane_method = METHOD_RADAU5,
    .rejected_h_rho = INFINITY,
    .limiting_h_rho = INFINITY, .stages = 3, .degree = RADAU_DEGREE, .reversed = RADAU_REVERSED,
    .error_nodes = radau5_error_nodes,
    .n_error_nodes = COUNT_OF(radau5_error_nodes), .max_error_fraction = RADAU5_ERROR_FRACTION,
    .end_rates = &radau5_end_rates};

/* The method Radau IIA of order 9 with five stages. */
static const Method radau9 = {.name = "radau9", .try = radau9_try_step, .dense = radau9_compute_dense_output,
    .interpolate = radau_interpolate, .power = 1.0 / 6.0, .stiff = 1, .lane_method = METHOD_RADAU9,
    .rejected_h_rho = INFINITY,
    .limiting_h_rho = INFINITY, .stages = 5, .degree = RADAU_DEGREE, .reversed = RADAU_REVERSED,
    .error_nodes = radau9_error_nodes,
    .n_error_nodes = COUNT_OF(radau9_error_nodes), .max_error_fraction = RADAU9_ERROR_FRACTION,
    .end_rates = &radau9_end_rates};
