/* Choice of the length of the first step of a run, and of the first step after an event. */
#define ONSET_ERROR 500.0 /* velocity tolerances: error of straight motion into a contact over a fitting first step */
#define ONSET_ERROR_STIFF 80.0 /* the same for stiff methods */
#define CHANGE_AT_SWITCH 2.0 /* relative change of accelerations over a fitting first step at a switching point */
#define CHANGE_AT_SWITCH_STIFF 0.7 /* the same for stiff methods */
#define MAX_CHANGE_TIME_S 1e100 /* s: changes that take longer are none */
#define CHANGE_AFTER_EVENT 0.5  /* the same after other events */
#define MAX_FIRST_FRACTION 1e-2 /* of the time left: longest trial step, and first step if rates are constant */
#define FIT_FAILED 0.1 /* factor on the length if straight motion over it is not finite */
#define MIN_FIT 1e-3 /* smallest factor of one trial on the length */
#define MAX_FIT 30.0 /* largest factor */
#define MAX_LAST_FIT 3.0 /* largest factor of the last trial */
#define MIN_FITTING_FACTOR 0.3 /* factor between this and MAX_FITTING_FACTOR: no other trial is needed */
#define MAX_FITTING_FACTOR 3.0
enum { MAX_FITTED = 3 };

/*
 * Estimate the length of the first step of a run from the error norms of the first two derivatives of the motion. The
 * second derivative is a difference over a trial step by Euler's method. Sets run->control.h (s): MAX_FIRST_FRACTION of
 * remaining_time (s, to the end) if the rates are constant. Return 0, or the status of the right-hand side.
 */
static int estimate_initial_step(Integrator *run, double remaining_time, const Parameters *p)
{
    double y[N_Y], dy[N_Y], first_norm = 0.0, second_norm = 0.0;
    RhsOutputs rhs;
    for (int k = 0; k < 2 * N_X; k++)
        first_norm = max_of(first_norm, fabs(run->dy[k]) * run->norm.weight[k]);
    double h = min_of(first_norm > 0.0 ? 1.0 / first_norm : INFINITY, MAX_FIRST_FRACTION * remaining_time);
    for (int k = 0; k < N_Y; k++)
        y[k] = run->y[k] + h * run->dy[k];
    const int status = evaluate_run_rhs(run, run->t + h, y, p, dy, &rhs);
    if (status)
        return status;
    for (int k = 0; k < 2 * N_X; k++)
        second_norm = max_of(second_norm, fabs(dy[k] - run->dy[k]) / h * run->norm.weight[k]);
    /* rates change completely in the time one / two; passed: tolerances passed in it; two may be subnormal */
    const double time = min_of(first_norm / second_norm, MAX_CHANGE_TIME_S), passed = max_of(1.0, time * first_norm);
    run->control.h = second_norm > 0.0 ? max_of(time * pow(passed, -run->choice.method->power), h) : MAX_FIRST_FRACTION
        * remaining_time;
    return 0;
}

/*
 * Compute the largest change of the accelerations over a time h (s) of straight motion, and their largest size, in
 * tolerances/s. Tolerances are those of the velocities. Return 0, or the status of the right-hand side; then both are
 * 0.
 */
static int compute_acceleration_change(Integrator *run, double h, const Parameters *p, double *change, double *size)
{
    double y[N_Y], dy[N_Y];
    RhsOutputs rhs;
    for (int k = 0; k < N_Y; k++)
        y[k] = run->y[k] + h * run->dy[k];
    const int status = evaluate_run_rhs(run, run->t + h, y, p, dy, &rhs);
    *change = *size = 0.0;
    for (int k = N_X; k < 2 * N_X && !status; k++) {
        *change = max_of(*change, fabs(dy[k] - run->dy[k]) * run->norm.weight[k]);
        *size = max_of(*size, fabs(run->dy[k]) * run->norm.weight[k]);
    }
    return status;
}

/*
 * Return the factor by which a step of length h (s) must change so that straight motion over it has the allowed error.
 * change, size: of the accelerations, by compute_acceleration_change().
 *
 * At an onset the error grows as h^(first_step_order - 1), as forces begin as delta^n: the factor is (allowed_error /
 * (change h))^(1 / (first_step_order - 1)). Elsewhere allowed_error is the relative change of the accelerations, and
 * changes below one tolerance do not count: the factor is max(allowed_error size / change, 1 / sqrt(change h)).
 * Infinity without a change.
 */
static double compute_length_factor(const Integrator *run, double h, double change, double size, double allowed_error)
{
    const double velocity_change = change * h;
    if (!(velocity_change > 0.0))
        return INFINITY;
    return run->control.first_step_order > 0.0
        ? approximate_power(allowed_error / velocity_change, 1.0 / (run->control.first_step_order - 1.0))
        : max_of(allowed_error * size / change, sqrt(1.0 / velocity_change));
}

/*
 * Fit the length run->control.h of the first step after an event to the change of accelerations along straight motion.
 * At an onset the allowed error is that of the last onset. After other events the length is fitted only once; later
 * steps reuse the length stored for that kind of event. At most MAX_FITTED lengths are tried; onset_error_per_s is
 * stored for record_first_step_length(). Does nothing for fixed steps, methods that choose their length, and without an
 * event. remaining_time: to the end of the run, s. Return 0, or STOPPED; other failures shorten the step.
 */
static int fit_first_step_after_event(Integrator *run, double remaining_time, const Parameters *p)
{
    const int stiff = !!run->choice.method->stiff, is_onset = run->control.first_step_order > 0.0;
    const int is_after_switch = is_first_after_switch(run);
    const double last_onset_error = run->control.onset[stiff], default_onset_error = stiff ? ONSET_ERROR_STIFF
        : ONSET_ERROR;
    const double onset_error = last_onset_error > 0.0 ? last_onset_error : default_onset_error;
    const double allowed_error = is_onset ? onset_error
        : !is_after_switch ? CHANGE_AFTER_EVENT : stiff ? CHANGE_AT_SWITCH_STIFF : CHANGE_AT_SWITCH;
    if (!run->control.stored_first_length || run->control.fixed > 0.0 || run->choice.method->controls_length
        || (*run->control.stored_first_length > 0.0 && !is_onset))
        return 0;
    run->control.onset_error_per_s = 0.0;
    for (int i = 1; i <= MAX_FITTED && remaining_time > 0.0; i++) {
        const double h = min_of(run->control.h, remaining_time);
        double change, size, factor = FIT_FAILED;
        const int status = compute_acceleration_change(run, h, p, &change, &size);
        if (status == STOPPED)
            return status;
        if (!status && isfinite(change + size)) {
            factor = compute_length_factor(run, h, change, size, allowed_error);
            run->control.onset_error_per_s = change * approximate_power(h, 2.0 - run->control.first_step_order);
        }
        if (h < run->control.h && factor >= 1.0)
            break; /* the step reaches the end of the run */
        factor = min_of(is_onset || is_after_switch ? 1.0 : i < MAX_FITTED ? MAX_FIT : MAX_LAST_FIT,
            max_of(MIN_FIT, factor));
        run->control.h = factor * h;
        if (factor > MIN_FITTING_FACTOR && factor < MAX_FITTING_FACTOR)
            break;
    }
    return 0;
}
