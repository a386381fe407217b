/*
 * Where along a step a margin crosses zero (zeros.h): samples of the step's interpolant, and how near the tolerance of
 * the run asks a zero to be located.
 */
#define ONSET_TIME_TOLERANCE 1e-9   /* of a step, behind the begin of a contact, at most */
#define AT_END 1e-6     /* the same behind its end */
#define AT_SWITCH 1e-2  /* of a step, behind a corner, at most */
#define HARMLESS_ERROR 1e-4    /* of the tolerance, that its wrong branch may change a step by */


static void interpolate(const Integrator *run, const Step *step, double s, double *y)
{
    step->method->interpolate(run, step, s, y);
}

/* State, projected, and right-hand side at share s of the step. */
static int state_at(
    Integrator *run, const Step *step, double s, const Parameters *p, double *y, double *dy, RhsOutputs *rhs)
{
    if (s == run->roots.samples.beyond) {
        memcpy(y, run->roots.samples.y, sizeof run->roots.samples.y);
        memcpy(dy, run->roots.samples.dy, sizeof run->roots.samples.dy);
        *rhs = run->roots.samples.rhs;
        return 0;
    }
    interpolate(run, step, s, y);
    const double t = step->t + s * step->h;
    project_state(run, t, y, p);
    return rates_at_rest(run, t, y, p, dy, rhs);
}

/*
 * What joints with play tell at a state: all of rates() where contacts are rigid, whose forces follow from
 * accelerations.
 */
static int play(Integrator *run, double t, const double *y, const Parameters *p, RhsOutputs *rhs)
{
#if N_RIGID
    double dy[N_Y];
    return rates(run, t, y, p, dy, rhs);
#else
    count_evaluations(run, 1);
    if (given_up(&run->cancellation))
        return STOPPED;
    show_states(&run->discrete, y);
    return play_here(t, y, &run->discrete, p, rhs);
#endif
}

/* What joints with play tell at share s of the step. */
static int play_in(Integrator *run, const Step *step, double s, const Parameters *p, RhsOutputs *rhs)
{
    double y[N_Y];
    if (s == run->roots.samples.beyond) {
        *rhs = run->roots.samples.rhs;
        return 0;
    }
#if N_FRICTIONS
    double dy[N_Y];
    return state_at(run, step, s, p, y, dy, rhs);
#else
    interpolate(run, step, s, y);
    project_state(run, step->t + s * step->h, y, p);
    return play(run, step->t + s * step->h, y, p, rhs);
#endif
}

/* By how much margin k grows per share of the step; NAN where a right-hand side does not tell. */
static double event_function_slope(const Integrator *run, const Step *step, const RhsOutputs *rhs, int k)
{
    if (k >= N_CLEARANCES || (run->discrete.contact[k].closed && !gives(k)))
        return NAN;
    return (run->discrete.contact[k].closed ? step->h : -step->h) * rhs->clearance[k].deltadot;
}

/* Forget the samples of another step. */
static void forget_samples(Integrator *run)
{
    run->roots.samples.n = 0;
    run->roots.samples.beyond = NAN;
}

/* Where in run->roots.looked a share is, with all margins or those of joints with play alone; -1: nowhere. */
static int find_sample(const DenseSamples *looked, double s, int joints_alone)
{
    for (int i = looked->n; i > 0 && i > looked->n - N_DENSE_SAMPLES; i--)
        if (looked->fraction[(i - 1) % N_DENSE_SAMPLES] == s
            && joints_alone >= looked->joints_alone[(i - 1) % N_DENSE_SAMPLES])
            return (i - 1) % N_DENSE_SAMPLES;
    return -1;
}

static int add_sample(Integrator *run, const Step *step, double s, const RhsOutputs *rhs, int joints_alone)
{
    const int slot = run->roots.samples.n++ % N_DENSE_SAMPLES;
    run->roots.samples.fraction[slot] = s;
    run->roots.samples.joints_alone[slot] = joints_alone;
    for (int i = 0; i < (joints_alone ? N_CLEARANCES : N_EVENT_FUNCTIONS); i++)
        run->roots.samples.event_function[slot][i] = event_function(&run->discrete, rhs, i);
    for (int i = 0; i < N_CLEARANCES; i++)
        run->roots.samples.slope[slot][i] = event_function_slope(run, step, rhs, i);
    return slot;
}

/* As find_sample() for all margins, looked at if they have not been. k: the margin for whose zero is looked, -1: none.
 */
static int sample_at(Integrator *run, const Step *step, double s, int k, const Parameters *p)
{
    DenseSamples *looked = &run->roots.samples;
    double y[N_Y], dy[N_Y];
    RhsOutputs rhs;
    int slot = find_sample(looked, s, 0);
    if (slot >= 0 || state_at(run, step, s, p, y, dy, &rhs))
        return slot;
    slot = add_sample(run, step, s, &rhs, 0);
    if (k >= 0 && looked->event_function[slot][k] < 0.0) {
        looked->beyond = s;
        memcpy(looked->y, y, sizeof y);
        memcpy(looked->dy, dy, sizeof dy);
        looked->rhs = rhs;
    }
    return slot;
}

/* Margin k at a share of a step, which is in a slot of run->roots.looked; -1: it is not known. */
static Place bracket_point_of_sample(const DenseSamples *looked, int slot, double s, int k)
{
    return slot < 0 ? (Place){s, NAN, NAN}
        : (Place){s, looked->event_function[slot][k], k < N_CLEARANCES ? looked->slope[slot][k] : NAN};
}

/* The same, sampled there if it has not been. */
static Place bracket_point_at(Integrator *run, const Step *step, double s, int k, const Parameters *p)
{
    const int slot = sample_at(run, step, s, k, p);
    return bracket_point_of_sample(&run->roots.samples, slot, s, k);
}

static double event_function_at(Integrator *run, const Step *step, double s, int k, const Parameters *p)
{
    return bracket_point_at(run, step, s, k, p).f;
}

/* The same of a joint with play, of which no more than its margin is known afterwards. */
static Place gap_point_at(Integrator *run, const Step *step, double s, int k, const Parameters *p)
{
    int slot = find_sample(&run->roots.samples, s, 1);
    RhsOutputs rhs;
    if (slot < 0 && !play_in(run, step, s, p, &rhs))
        slot = add_sample(run, step, s, &rhs, 1);
    return bracket_point_of_sample(&run->roots.samples, slot, s, k);
}

/* Margin k at both ends of a step. */
static Place bracket_begin(const Integrator *run, const Step *step, int k)
{
    return (Place){0.0, event_function(&run->discrete, &run->rhs, k), event_function_slope(run, step, &run->rhs, k)};
}

static Place bracket_end(const Integrator *run, const Step *step, int k)
{
    return (Place){1.0, event_function(&run->discrete, &step->rhs, k), event_function_slope(run, step, &step->rhs, k)};
}

/* A bracket with those two of the stages in it at which margin k is nearest to zero. */
static Bracket stage_bracket(const Step *step, int k, Place low, Place high)
{
    Place nearest = {NAN, NAN, NAN}, next = nearest;
    const StageValues seen = stage_values(step, k);
    for (int i = 0; i < step->n_seen; i++) {
        const Place now = {step->node[i], stage_value(seen, i), NAN};
        if (!(now.s > low.s && now.s < high.s && now.f == now.f))
            continue;
        if (!(fabs(now.f) >= fabs(nearest.f)))
            next = nearest, nearest = now;
        else if (!(fabs(now.f) >= fabs(next.f)))
            next = now;
    }
    return (Bracket){{low, high, nearest, next}, 2 + (nearest.s == nearest.s) + (next.s == next.s)};
}

/* The share to which a zero is located: 4 ulp of the time, or a tick. */
static double event_time_tolerance(const Integrator *run, const Step *step)
{
    return max_of(4.0 * DBL_EPSILON * fabs(step->t), run->roots.time_resolution) / step->h;
}

/* Whether margin k may be found behind its zero: of a contact that gives, of a corner where branches meet. */
static int may_be_located_after_zero(const Integrator *run, int k)
{
    const int corner = k - N_CLEARANCES;
    if (run->control.fixed > 0.0 || watched_as[k] >= 0)
        return 0;
    return corner < 0 ? gives(k) : corner < N_SWITCHES && meets[corner];
}

/*
 * How far behind its zero the margin of a contact that gives may be found, as a share of a step. Forces may begin with
 * a jump, and how long a contact lasts is not known before it begins, nor by others: of one as short as the
 * tolerance's share of the step that finds its onset, the tolerance is missed. The step that finds an end is a part of
 * the contact.
 */
static double max_overshoot_of_contact(const Integrator *run, int k)
{
    const double tolerance = tolerance_of(run);
    return run->discrete.contact[k].closed ? min_of(AT_END, tolerance * sqrt(tolerance))
        : min_of(ONSET_TIME_TOLERANCE, tolerance * tolerance);
}

/*
 * How near its zero margin k is located: of a corner, where branches meet, as far after it as the wrong one does no
 * harm. Rates differ in proportion to the margin, and what that does grows with the square of the way: at the step's
 * end they do so by what step->harm tells.
 */
static ZeroTolerance event_function_tolerance(const Integrator *run, const Step *step, int k)
{
    const double width = event_time_tolerance(run, step);
    if (!may_be_located_after_zero(run, k))
        return (ZeroTolerance){.width = width};
    if (k < N_CLEARANCES)
        return (ZeroTolerance){width, max_overshoot_of_contact(run, k), INFINITY, 1.0};
    return (ZeroTolerance){
        width, AT_SWITCH, HARMLESS_ERROR * fabs(event_function(&run->discrete, &step->rhs, k)), step->harm};
}

/* How many places tell where a zero is: near one that is located to rounding a fourth tells of that alone. */
static int n_interpolation_points(const Integrator *run, int k)
{
    return MOST_PLACES - !may_be_located_after_zero(run, k);
}

/* Margin k of a step, whose zero is located; whether it has not been sampled yet. */
typedef struct {
    Integrator *run;
    const Step *step;
    const Parameters *p;
    int k, first;
} EventFunctionOfStep;

/* The first sample is seldom the last one, after which the whole state is needed. */
static int evaluate_event_function(void *context, double s, Place *now)
{
    EventFunctionOfStep *of = context;
    *now = of->first && of->k < N_CLEARANCES ? gap_point_at(of->run, of->step, s, of->k, of->p)
        : bracket_point_at(of->run, of->step, s, of->k, of->p);
    of->first = 0;
    return 0;
}

/* The first share at which margin k is below zero, from a bracket of it and a guess. */
static double locate_root(Integrator *run, const Step *step, int k, Bracket of, double guess, const Parameters *p)
{
    EventFunctionOfStep event_function_of_step = {run, step, p, k, 1};
    const ZeroTolerance near = event_function_tolerance(run, step, k);
    (void)locate_zero(
        evaluate_event_function, &event_function_of_step, &near, n_interpolation_points(run, k), guess, &of);
    return of.at[1].s;
}
