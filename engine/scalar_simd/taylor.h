/*
 * A trial step by the Taylor series of the motion: the longest valid length, and the state at its end. For one run, a
 * SeriesPart is several components of the state; in lanes, one component of several runs.
 */
enum { SERIES_PART = sizeof(SeriesPart) / sizeof(Real) };

#define TAYLOR_DECAY 2.0 /* log2 of the factor by which a term may exceed the tolerance per lower order */
#define TAYLOR_STABILITY 0.3 /* h rho per order of the series: from there on stability limits the steps */
#define TAYLOR_AHEAD 8.0 /* times the last step: first limit of the next one */

/*
 * Return the longest step in s for which the last two terms of the series do not exceed 1/series.strictness tolerances.
 * Symmetry may make these terms small or zero; the defect at the end of the step shows that. Also store series.growth,
 * the ratio of these terms times the order; 0 if the term before the last is 0.
 */
static Real taylor_compute_max_length(IntegratorOf *run)
{
    const int n = run->series.order;
    const Real *last = run->series.terms[n], *before = run->series.terms[n - 1];
    Real largest = make_real(0.0), largest_before = make_real(0.0);
    for (int i = 0; i < N_Y; i++) {
        largest = real_max(largest, real_abs(last[i]) * run->norm.weight[i]);
        largest_before = real_max(largest_before, real_abs(before[i]) * run->norm.weight[i]);
    }
    run->series.growth = select_value(largest_before > 0.0, n * largest / largest_before, make_real(0.0));
    largest *= run->series.strictness, largest_before *= run->series.strictness;
    return real_exp2(-real_max(real_log2(largest) / n, real_log2(largest_before) / (n - 1)));
}

/*
 * Store the stiffness estimate h rho of a step of length h (s) if it exceeds TAYLOR_STABILITY times the order, where
 * stability may limit the step; else 0. In stiff motion, the last terms of the series are those of the fastest mode,
 * c_n / c_(n-1) = rho / n, and steps end where they grow.
 */
static void taylor_estimate_stiffness(IntegratorOf *run, Real h)
{
    const Real h_rho = h * run->series.growth;
    const Mask is_limited = h_rho > TAYLOR_STABILITY * run->series.order;
    store_stiffness_estimate(run, select_value(is_limited, h_rho, make_real(0.0)));
}

/*
 * Return the longest step in s by all terms of the series: each may exceed the tolerance by the factor 2^TAYLOR_DECAY
 * per lower order. Called if the defect of a step shows that the last two terms are too small.
 */
static Real taylor_compute_max_length_by_all_terms(const IntegratorOf *run)
{
    Real steepest = make_real(-INFINITY);
    for (int k = 1; k <= run->series.order; k++) {
        Real largest = make_real(0.0);
        for (int i = 0; i < N_Y; i++)
            largest = real_max(largest, real_abs(run->series.terms[k][i]) * run->norm.weight[i]);
        largest *= run->series.strictness;
        steepest = real_max(steepest, (real_log2(largest) - TAYLOR_DECAY * (run->series.order - k)) / k);
    }
    return real_exp2(-steepest);
}

/*
 * Evaluate the series at time h (s) after the run's state: the change of the state and its rate (N_Y each), by even and
 * odd powers separately (Horner's scheme). The change has the relative precision of its own size, not of the state's.
 */
static inline void taylor_evaluate_change_and_rate(const IntegratorOf *run, Real h, Real *change, Real *rate)
{
    const int last_even = run->series.order - run->series.order % 2;
    const Real square = h * h;
    Real padded_change[TAYLOR_Y], padded_rate[TAYLOR_Y];
    for (int i = 0; i < N_Y; i += SERIES_PART) {
        SeriesPart even = *(const SeriesPart *)(run->series.terms[last_even] + i), odd = {0.0};
        SeriesPart even_slope = {0.0}, odd_slope = {0.0};
        if (last_even < run->series.order)
            odd = *(const SeriesPart *)(run->series.terms[last_even + 1] + i);
        for (int k = last_even - 2; k > 0; k -= 2) {
            even_slope = even + square * even_slope;
            odd_slope = odd + square * odd_slope;
            even = *(const SeriesPart *)(run->series.terms[k] + i) + square * even;
            odd = *(const SeriesPart *)(run->series.terms[k + 1] + i) + square * odd;
        }
        even_slope = even + square * even_slope;
        odd_slope = odd + square * odd_slope;
        odd = *(const SeriesPart *)(run->series.terms[1] + i) + square * odd;
        *(SeriesPart *)(padded_change + i) = h * odd + square * even;
        *(SeriesPart *)(padded_rate + i) = odd + 2.0 * (h * even_slope + square * odd_slope);
    }
    for (int i = 0; i < N_Y; i++) {
        change[i] = padded_change[i];
        rate[i] = padded_rate[i];
    }
}

/*
 * Evaluate the series at time h (s) after the run's state: the state y (N_Y), including the accumulated rounding error.
 * Called for the dense output at a fraction of a step.
 */
static inline void taylor_evaluate_state(const IntegratorOf *run, Real h, Real *y)
{
    Real change[N_Y], rate[N_Y];
    taylor_evaluate_change_and_rate(run, h, change, rate);
    for (int i = 0; i < N_Y; i++)
        y[i] = run->series.terms[0][i] + (run->series.rounding_errors[i] + change[i]);
}

/*
 * Return the step length near h (s) for which the time at its end, run->t + h, is exact; h itself if h is too short for
 * that. Rounding errors of times then do not accumulate.
 */
static inline Real round_step_length(const IntegratorOf *run, Real h)
{
    const Real rounded = (run->t + h) - run->t;
    return select_value(rounded > 0.0, rounded, h);
}

/*
 * Return the defect h |y' - f| at the end of a step in the scaled norm of velocities, times series.defect_weight: 1 is
 * the largest that is accepted. rate: y' of the series; f: step->dy.
 */
static Real taylor_compute_defect(const IntegratorOf *run, const StepOf *step, const Real *rate)
{
    Real largest = make_real(0.0);
    for (int i = N_X; i < 2 * N_X; i++)
        largest = real_max(largest, real_abs(step->h * (rate[i] - step->dy[i])) * run->norm.weight[i]);
    return largest * run->series.defect_weight;
}

/*
 * Try a step of length h (s), or of the longest valid length if that is shorter; a fixed step is always h. Return 0 or
 * a status. step->error is the maximum of h over the valid length and the defect. If the defect at the end is too
 * large, the step is repeated once with a length from all terms.
 */
static int taylor_try_series_step(IntegratorOf *run, Real h, const ParametersOf *p, StepOf *step)
{
    const int is_adaptive = !(run->control.fixed > 0.0);
    Real change[N_Y], rate[N_Y], defect;
    int status;
    if (is_adaptive)
        h = real_min(h, run->series.max_step);
    step->t = run->t, step->dense_ready = 0;
    discard_stages(step);
    for (int is_repeated = 0;; is_repeated = 1) {
        step->h = h;
        taylor_evaluate_change_and_rate(run, h, change, rate);
        for (int i = 0; i < N_Y; i++) {
            step->y[i] = run->series.terms[0][i];
            run->series.end_rounding_errors[i] =
                add_compensated(&step->y[i], run->series.rounding_errors[i] + change[i]);
        }
        step->error = is_adaptive ? h / run->series.max_step : make_real(0.0); /* root of the error: accepted up to 1 */
        if (!is_repeated && decide_step_rejection(run, step))
            return 0;
        status = finish_step(run, step, p);
        if (!is_adaptive)
            return status;
        defect = status ? make_real(INFINITY) : taylor_compute_defect(run, step, rate);
        const Mask is_large = defect > 1.0;
        if (is_repeated || !any_of(is_large))
            break;
        const Real shorter =
            round_step_length(run, real_min(run->series.max_step, taylor_compute_max_length_by_all_terms(run)));
        run->series.max_step = select_value(is_large, shorter, run->series.max_step);
        h = real_min(h, run->series.max_step);
        subtract_end_evaluation(run);
    }
    taylor_estimate_stiffness(run, step->h);
    step->error = real_max(step->error, defect);
    reject_step_by_defect(run, step);
    return status;
}
