/* The length of a first step: of a run, and after an event. */
#define ONSET_ERROR 500.0 /* velocity tolerances: error of straight motion into a contact over a fitting first step */
#define ONSET_ERROR_STIFF 80.0 /* the same for stiff methods */
#define CHANGE_AT_SWITCH 2.0 /* relative change of accelerations over a fitting first step at a switching point */
#define CHANGE_AT_SWITCH_STIFF 0.7 /* the same for stiff methods */
#define LONG_TIME 1e100 /* s: changes that take longer are none */
#define CHANGE_AFTER_EVENT 0.5  /* the same after other events */
#define FIRST_SHARE 1e-2 /* of the time left: longest trial step, and first step if rates are constant */
#define FIT_FAILED 0.1 /* factor on the length if straight motion over it is not finite */
#define MIN_FIT 1e-3 /* smallest factor of one trial on the length */
#define MAX_FIT 30.0 /* largest factor */
#define MAX_LAST_FIT 3.0 /* largest factor of the last trial */
#define MIN_CLOSE 0.3 /* factor between this and MAX_CLOSE: no other trial is needed */
#define MAX_CLOSE 3.0
enum { MAX_FITTED = 3 };

/*
 * Estimate the length of the first step of a run from the sizes of the first two derivatives of the motion. left: time
 * to the end, s. Return 0 or the status.
 */
static int estimate_initial_step(Integrator *run, double left, const Parameters *p)
{
    double y[N_Y], dy[N_Y], one = 0.0, two = 0.0;
    RhsOutputs rhs;
    for (int k = 0; k < 2 * N_X; k++)
        one = max_of(one, fabs(run->dy[k]) * run->norm.weight[k]);
    double h = min_of(one > 0.0 ? 1.0 / one : INFINITY, FIRST_SHARE * left);
    for (int k = 0; k < N_Y; k++)
        y[k] = run->y[k] + h * run->dy[k];
    const int status = rates(run, run->t + h, y, p, dy, &rhs);
    if (status)
        return status;
    for (int k = 0; k < 2 * N_X; k++)
        two = max_of(two, fabs(dy[k] - run->dy[k]) / h * run->norm.weight[k]);
    /* rates change completely in the time one / two; passed: tolerances passed in it; two may be subnormal */
    const double time = min_of(one / two, LONG_TIME), passed = max_of(1.0, time * one);
    run->control.h = two > 0.0 ? max_of(time * pow(passed, -run->choice.method->power), h) : FIRST_SHARE * left;
    return 0;
}

/*
 * Compute the change of accelerations over a time h (s) of straight motion, and their size, in velocity tolerances per
 * s.
 */
static int compute_acceleration_change(Integrator *run, double h, const Parameters *p, double *change, double *size)
{
    double y[N_Y], dy[N_Y];
    RhsOutputs rhs;
    for (int k = 0; k < N_Y; k++)
        y[k] = run->y[k] + h * run->dy[k];
    const int status = rates(run, run->t + h, y, p, dy, &rhs);
    *change = *size = 0.0;
    for (int k = N_X; k < 2 * N_X && !status; k++) {
        *change = max_of(*change, fabs(dy[k] - run->dy[k]) * run->norm.weight[k]);
        *size = max_of(*size, fabs(run->dy[k]) * run->norm.weight[k]);
    }
    return status;
}

/*
 * Return the factor by which a step of length h must change to fit. fits: allowed error; change, size: of the
 * accelerations. At an onset the error grows as h^(first_step_order - 1), as forces begin as delta^n. Elsewhere
 * accelerations change in proportion to h, and changes below one tolerance do not count.
 */
static double length_ratio(const Integrator *run, double h, double change, double size, double fits)
{
    const double missed = change * h;
    if (!(missed > 0.0))
        return INFINITY;
    return run->control.first_step_order > 0.0
        ? approximate_power(fits / missed, 1.0 / (run->control.first_step_order - 1.0))
        : max_of(fits * size / change, sqrt(1.0 / missed));
}

/*
 * Fit the length of the first step after an event by the change of accelerations along straight motion. At an onset the
 * allowed error is that of the last onset. After other events the length is known once an event of that kind has
 * occurred. left: time to the end of the run, s.
 */
static int first_step_after_event(Integrator *run, double left, const Parameters *p)
{
    const int stiff = !!run->choice.method->stiff, begins = run->control.first_step_order > 0.0;
    const int is_after_switch = begins_at_switch(run);
    const double known = run->control.onset[stiff], at_first = stiff ? ONSET_ERROR_STIFF : ONSET_ERROR;
    const double onset = known > 0.0 ? known : at_first;
    const double fits = begins ? onset
        : !is_after_switch ? CHANGE_AFTER_EVENT : stiff ? CHANGE_AT_SWITCH_STIFF : CHANGE_AT_SWITCH;
    if (!run->control.first || run->control.fixed > 0.0 || run->choice.method->controls_length
        || (*run->control.first > 0.0 && !begins))
        return 0;
    run->control.onset_error_per_s = 0.0;
    for (int i = 1; i <= MAX_FITTED && left > 0.0; i++) {
        const double h = min_of(run->control.h, left);
        double change, size, by = FIT_FAILED;
        const int status = compute_acceleration_change(run, h, p, &change, &size);
        if (status == STOPPED)
            return status;
        if (!status && isfinite(change + size)) {
            by = length_ratio(run, h, change, size, fits);
            run->control.onset_error_per_s = change * approximate_power(h, 2.0 - run->control.first_step_order);
        }
        if (h < run->control.h && by >= 1.0)
            break; /* the step reaches the end of the run */
        by = min_of(begins || is_after_switch ? 1.0 : i < MAX_FITTED ? MAX_FIT : MAX_LAST_FIT, max_of(MIN_FIT, by));
        run->control.h = by * h;
        if (by > MIN_CLOSE && by < MAX_CLOSE)
            break;
    }
    return 0;
}
