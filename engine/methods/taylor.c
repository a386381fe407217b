/*
 * Taylor's method: integration by the power series of the motion, of variable order and step length. The tolerance
 * determines the order; the last terms and the defect at the end of a step limit its length. The polynomial is the
 * dense output. A. Jorba, M. Zou, A software package for the numerical integration of ODEs by means of high-order
 * Taylor methods, Experimental Mathematics 14 (2005), section 3.
 */
#if TAYLOR
#define TAYLOR_ROUNDING 1e-14 /* of velocities: a smaller defect at the end of a step may be rounding */
enum { TAYLOR_DEFECT_LOG2 = 5 /* of the largest defect at the end of a step, in tolerances; less at low orders */ };
enum { MIN_TAYLOR_ORDER = 4 };

static const double taylor_error_nodes[] = {0.0, 1.0}; /* the series, and the defect at the end of a step */

/*
 * Return the order of the Taylor series for a relative tolerance: ceil(1 - ORDERS_PER_E_FOLD ln tolerance), between
 * MIN_TAYLOR_ORDER and TAYLOR_ORDERS. Lengths, angles and speeds have the same tolerance.
 */
static int choose_taylor_order(double tolerance)
{
    const double order = ceil(1.0 - ORDERS_PER_E_FOLD * log(tolerance));
    return order > TAYLOR_ORDERS ? TAYLOR_ORDERS : order < MIN_TAYLOR_ORDER ? MIN_TAYLOR_ORDER : (int)order;
}

/* Several components of the state in one vector register. */
typedef double SeriesPart __attribute__((vector_size(REGISTER), aligned(8)));
/*
 * Do nothing: for one run, step->error is tested after the step. In lanes, steps with too large an error are rejected
 * here.
 */
static void reject_step_by_defect(const Integrator *run, const Step *step) { (void)run, (void)step; }

/*
 * Subtract one evaluation from the counts: the second evaluation at the end of a repeated series step does not count,
 * as in lanes.
 */
static void subtract_end_evaluation(Integrator *run) { count_evaluations(run, -1); }

#include "../scalar_simd/taylor.h"

/*
 * Compute the series at the state of the run, and from it the longest step (series.max_step), unless both are stored
 * already. All steps tried from this state share the series, which counts as one evaluation unless a lane has counted
 * it. Return 0 or the status.
 */
static int expand_series(Integrator *run, const Parameters *p)
{
    if (run->series.ready == IN_RUN)
        return 0;
    const int n = run->series.order, status = compute_taylor_series(run->t, run->y, p, n, run->series.terms);
    if (status)
        return status;
    count_evaluations(run, run->series.ready != IN_LANE);
    run->series.max_step = round_step_length(run, taylor_compute_max_length(run));
    run->series.ready = IN_RUN;
    return 0;
}

/*
 * Compute a step of at most h (s) by the Taylor series, which sets the length of the attempt. Return 0 or the status.
 * If the series cannot be computed or is not finite, as with links in one line, the step is one of dop853, which
 * becomes step->method.
 */
static int taylor_try_step(Integrator *run, double h, const Parameters *p, Step *step)
{
    const int status = expand_series(run, p);
    if (status || !all_finite(run->series.terms[run->series.order], N_Y)) {
        step->method = &dop853; /* links in one line: its right-hand side passes singular positions */
        const int status_of_other = dop853_try_step(run, h, p, step);
        memset(run->series.end_rounding_errors, 0, sizeof run->series.end_rounding_errors);
        return status_of_other;
    }
    const int status_of_step = taylor_try_series_step(run, h, p, step);
    set_attempt_step_length(run, step->h);
    return status_of_step;
}

/*
 * Copy the series of a step computed in a lane into the run, when its dense output is needed. Nothing happens unless
 * the series is in a lane (ready == IN_LANE).
 */
static void copy_series_from_lane(Integrator *run)
{
    const double *lane_terms = run->series.lane;
    if (run->series.ready != IN_LANE)
        return;
    for (int k = 0; k <= run->series.order; k++)
        for (int i = 0; i < N_Y; i++)
            run->series.terms[k][i] = lane_terms[(k * TAYLOR_Y + i) * run->series.lanes];
    run->series.ready = IN_RUN;
}

/*
 * Compute the dense output of a series step: the Taylor coefficients times powers of the step length, as interval
 * bounds need them. Orders above that of the series are 0. Return 0.
 */
static int taylor_compute_dense_output(Integrator *run, const Parameters *p, Step *step)
{
    double power = step->h;
    (void)p;
    copy_series_from_lane(run);
    for (int k = 1; k <= TAYLOR_ORDERS; k++, power *= step->h)
        for (int i = 0; i < N_Y; i++)
            step->dense[k - 1][i] = k <= run->series.order ? run->series.terms[k][i] * power : 0.0;
    return 0;
}

/* Compute the state y (N_Y) at fraction s of a step from the series at its beginning. */
static void taylor_interpolate(const Integrator *run, const Step *step, double s, double *y)
{
    taylor_evaluate_state(run, s * step->h, y);
}

/* Taylor's method, which chooses the length of a step itself. */
static const Method taylor = {.name = "taylor",
    .try = taylor_try_step,
    .dense = taylor_compute_dense_output,
    .interpolate = taylor_interpolate,
    .lane_method = METHOD_TAYLOR,
    .power = 1.0 / TAYLOR_ORDERS,
    .rejected_h_rho = INFINITY,
    .limiting_h_rho = 1.0, /* taylor_estimate_stiffness() stores larger values only */
    .degree = TAYLOR_ORDERS,
    .error_nodes = taylor_error_nodes,
    .n_error_nodes = COUNT_OF(taylor_error_nodes),
    .controls_length = 1};

/*
 * Set the order of the series of a run, and the weight of the defect at the end of a step, from the relative tolerance
 * of the steps. The allowed defect is 2^TAYLOR_DEFECT_LOG2 tolerances or TAYLOR_ROUNDING, if larger; at orders below
 * TAYLOR_DEFECT_LOG2 + 4 the exponent is the order minus 4. With the method `auto`, the tolerance and this limit are
 * TAYLOR_TOLERANCE_RATIO times smaller.
 */
static void set_series_order(Integrator *run, double tolerance)
{
    run->series.strictness = run->choice.automatic ? TAYLOR_TOLERANCE_RATIO : 1.0;
    tolerance /= run->series.strictness;
    run->series.order = choose_taylor_order(tolerance);
    const int log2_defect = run->series.order - 4 < TAYLOR_DEFECT_LOG2 ? run->series.order - 4 : TAYLOR_DEFECT_LOG2;
    run->series.defect_weight = run->series.strictness * min_of(1.0, tolerance / TAYLOR_ROUNDING) / (1 << log2_defect);
}

/* Return the rounding errors (N_Y) of the state at the end of the tried step; NULL unless Taylor's method is chosen. */
static double *get_end_rounding(Integrator *run)
{
    return run->choice.method == &taylor ? run->series.end_rounding_errors : NULL;
}

/*
 * Discard the stored series of a run, because its state changes. is_whole: whether the new state is the end of a whole
 * step; with Taylor's method its rounding error is then kept for compensated summation. Otherwise it is set to 0.
 */
static void discard_series(Integrator *run, int is_whole)
{
    run->series.ready = 0;
    for (int i = 0; i < N_Y; i++)
        run->series.rounding_errors[i] =
            is_whole && run->choice.method == &taylor ? run->series.end_rounding_errors[i] : 0.0;
}

/*
 * Return whether the largest rate rho (1/s) of the motion confirms that stability limits the steps of the chosen
 * method: rho h exceeds TAYLOR_STABILITY times the order. Always 1 for other methods than Taylor's.
 */
static int is_limited_by_stability(const Integrator *run, double rho)
{
    return run->choice.method != &taylor || rho * run->step.h > TAYLOR_STABILITY * run->series.order;
}

/*
 * Return the largest length in s of the next tried step: TAYLOR_AHEAD times the longest valid one of the last series.
 */
static double get_max_attempt_length(const Integrator *run) { return TAYLOR_AHEAD * run->series.max_step; }
#else
/* Return NULL: only Taylor's method knows the rounding errors of the state. */
static inline double *get_end_rounding(Integrator *run) { return (void)run, NULL; }

/* Do nothing: the library has no Taylor method. */
static inline void set_series_order(Integrator *run, double tolerance) { (void)run, (void)tolerance; }

/* Do nothing: the library has no Taylor method. */
static inline void discard_series(Integrator *run, int is_whole) { (void)run, (void)is_whole; }

/* Return 1: the estimate of other methods needs no confirmation. */
static inline int is_limited_by_stability(const Integrator *run, double rho) { return (void)run, (void)rho, 1; }

/* Return infinity: the library has no Taylor method. */
static inline double get_max_attempt_length(const Integrator *run) { return (void)run, INFINITY; }
#endif
