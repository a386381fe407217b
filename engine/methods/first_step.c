/*
 * How long a first step is: of a run, and after something changed.
 */
#define ONSET 500.0 /* tolerances of velocity, that straight motion into a contact misses it by in a step that fits */
#define ONSET_STIFF 80.0
#define RELAXED 2.0 /* share of the accelerations that straight motion changes in a step that fits: explicit, linear */
#define RELAXED_STIFF 0.7
#define LONG_TIME 1e100 /* s: what takes longer to change does not change */
#define CURVED 0.5  /* the same of motion without a contact that has begun */
#define FIRST_SHARE 1e-2 /* of what is left of the run: the longest trial step, and the first step if rates stay */
#define FIT_FAILED 0.1 /* where straight motion of a step's length ends in no number: the share to try next */
#define MIN_FIT 1e-3 /* least share by which a trial changes the length */
#define MAX_FIT 30.0 /* largest one */
#define MAX_LAST_FIT 3.0 /* largest one of the last trial */
#define MIN_CLOSE 0.3 /* a share between this and MAX_CLOSE: the length is kept without another trial */
#define MAX_CLOSE 3.0
enum { MAX_FITTED = 3 };

/* A first step from the size of the motion's first two rates. */
static int initial_step(Integrator *run, double left, const Parameters *p)
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
    /* in the time one / two rates change by themselves: so many tolerances are gone in it; two may be subnormal */
    const double time = min_of(one / two, LONG_TIME), way = max_of(1.0, time * one);
    run->control.h = two > 0.0 ? max_of(time * pow(way, -run->choice.method->power), h) : FIRST_SHARE * left;
    return 0;
}

/* How accelerations change over h of straight motion: in tolerances of velocity a second, and their size. */
static int acceleration_change(Integrator *run, double h, const Parameters *p, double *change, double *size)
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
 * By which share a step of length h fits better, of which straight motion changes that much. An onset misses velocities
 * by a power of the length, for forces begin as delta^n; elsewhere accelerations change in proportion to it, and what
 * is less than a tolerance is no change.
 */
static double length_ratio(const Integrator *run, double h, double change, double size, double fits)
{
    const double missed = change * h;
    if (!(missed > 0.0))
        return INFINITY;
    return run->control.rough > 0.0 ? rough_power(fits / missed, 1.0 / (run->control.rough - 1.0))
        : max_of(fits * size / change, sqrt(1.0 / missed));
}

/*
 * After an event: as long a step as fits what straight motion changes. Each onset is as fast as it is, by the
 * tolerances that fitted the last one; of others the length is known once their like was there. left: to the run's end.
 */
static int first_step_after_event(Integrator *run, double left, const Parameters *p)
{
    const int stiff = !!run->choice.method->stiff, begins = run->control.rough > 0.0;
    const int corner = begins_at_switch(run);
    const double onset = run->control.onset[stiff] > 0.0 ? run->control.onset[stiff] : stiff ? ONSET_STIFF : ONSET;
    const double fits = begins ? onset : !corner ? CURVED : stiff ? RELAXED_STIFF : RELAXED;
    if (!run->control.first || run->control.fixed > 0.0 || run->choice.method->own_length
        || (*run->control.first > 0.0 && !begins))
        return 0;
    run->control.onset_share = 0.0;
    for (int i = 1; i <= MAX_FITTED && left > 0.0; i++) {
        const double h = min_of(run->control.h, left);
        double change, size, by = FIT_FAILED;
        const int status = acceleration_change(run, h, p, &change, &size);
        if (status == STOPPED)
            return status;
        if (!status && isfinite(change + size)) {
            by = length_ratio(run, h, change, size, fits);
            run->control.onset_share = change * rough_power(h, 2.0 - run->control.rough);
        }
        if (h < run->control.h && by >= 1.0)
            break; /* to the run's end: more is not asked */
        by = min_of(begins || corner ? 1.0 : i < MAX_FITTED ? MAX_FIT : MAX_LAST_FIT, max_of(MIN_FIT, by));
        run->control.h = by * h;
        if (by > MIN_CLOSE && by < MAX_CLOSE)
            break;
    }
    return 0;
}
