/*
 * Location of events on the dense output of a step: samples of the event functions, and the tolerance to which a zero
 * is located. Read zeros.h first.
 */
#define ONSET_TIME_TOLERANCE 1e-9   /* of a step, after the onset of a contact, at most */
#define MAX_END_OVERSHOOT 1e-6     /* of a step, after the end of a contact, at most */
#define MAX_SWITCH_OVERSHOOT 1e-2  /* of a step, after a switching point, at most */
#define HARMLESS_ERROR 1e-4    /* of the tolerance: change of a step by the inactive branch that is accepted */

/* Evaluate the dense output at fraction s of the step: y[N_Y], not projected. */
static void interpolate(const Integrator *run, const Step *step, double s, double *y)
{
    step->method->interpolate(run, step, s, y);
}

/*
 * Compute the projected state y, its rates dy and the right-hand side's outputs at fraction s of the step. Returns a
 * status.
 */
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
    return evaluate_rates_at_rest(run, t, y, p, dy, rhs);
}

/*
 * Evaluate the contacts of joints with play at a state. Forces of rigid contacts follow from accelerations, so that
 * these scenes evaluate the whole right-hand side. Returns a status.
 */
static int play(Integrator *run, double t, const double *y, const Parameters *p, RhsOutputs *rhs)
{
#if N_RIGID
    double dy[N_Y];
    return rates(run, t, y, p, dy, rhs);
#else
    count_evaluations(run, 1);
    if (is_cancelled(&run->cancellation))
        return STOPPED;
    copy_inner_states(&run->discrete, y);
    return evaluate_contacts(t, y, &run->discrete, p, rhs);
#endif
}

/* Evaluate the contacts of joints with play at fraction s of the step. Returns a status. */
static int evaluate_contacts_in_step(Integrator *run, const Step *step, double s, const Parameters *p, RhsOutputs *rhs)
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

/* Return the rate of event function k per fraction of the step; NAN if the right-hand side does not contain it. */
static double event_function_slope(const Integrator *run, const Step *step, const RhsOutputs *rhs, int k)
{
    if (k >= N_CLEARANCES || (run->discrete.contact[k].closed && !gives(k)))
        return NAN;
    return (run->discrete.contact[k].closed ? step->h : -step->h) * rhs->clearance[k].deltadot;
}

/* Discard the samples of the previous step. */
static void discard_samples(Integrator *run)
{
    run->roots.samples.n = 0;
    run->roots.samples.beyond = NAN;
}

/*
 * Return the index of the stored sample at fraction s, -1 if there is none. joints_alone: whether a sample of the gaps
 * alone is sufficient.
 */
static int find_sample(const DenseSamples *stored, double s, int joints_alone)
{
    for (int i = stored->n; i > 0 && i > stored->n - N_DENSE_SAMPLES; i--)
        if (stored->fraction[(i - 1) % N_DENSE_SAMPLES] == s
            && joints_alone >= stored->joints_alone[(i - 1) % N_DENSE_SAMPLES])
            return (i - 1) % N_DENSE_SAMPLES;
    return -1;
}

/*
 * Store the event functions and slopes at fraction s of the step; joints_alone: those of joints with play only. Returns
 * the index of the sample.
 */
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

/*
 * Return the index of the sample of all event functions at fraction s; evaluate it if it is not stored; -1: it failed.
 * The whole state is stored as well if event function k is negative there (k = -1: never).
 */
static int sample_at(Integrator *run, const Step *step, double s, int k, const Parameters *p)
{
    DenseSamples *stored = &run->roots.samples;
    double y[N_Y], dy[N_Y];
    RhsOutputs rhs;
    int slot = find_sample(stored, s, 0);
    if (slot >= 0 || state_at(run, step, s, p, y, dy, &rhs))
        return slot;
    slot = add_sample(run, step, s, &rhs, 0);
    if (k >= 0 && stored->event_function[slot][k] < 0.0) {
        stored->beyond = s;
        memcpy(stored->y, y, sizeof y);
        memcpy(stored->dy, dy, sizeof dy);
        stored->rhs = rhs;
    }
    return slot;
}

/* Return value and slope of event function k in the stored sample `slot`; NAN for slot -1. */
static Sample bracket_point_of_sample(const DenseSamples *stored, int slot, double s, int k)
{
    return slot < 0 ? (Sample){s, NAN, NAN}
        : (Sample){s, stored->event_function[slot][k], k < N_CLEARANCES ? stored->slope[slot][k] : NAN};
}

/* Return value and slope of event function k at fraction s of the step; NAN if they cannot be evaluated. */
static Sample bracket_point_at(Integrator *run, const Step *step, double s, int k, const Parameters *p)
{
    const int slot = sample_at(run, step, s, k, p);
    return bracket_point_of_sample(&run->roots.samples, slot, s, k);
}

/* Return the value of event function k at fraction s of the step. */
static double event_function_at(Integrator *run, const Step *step, double s, int k, const Parameters *p)
{
    return bracket_point_at(run, step, s, k, p).f;
}

/* Return value and slope of event function k of a joint with play at fraction s, by evaluating the contacts alone. */
static Sample gap_point_at(Integrator *run, const Step *step, double s, int k, const Parameters *p)
{
    int slot = find_sample(&run->roots.samples, s, 1);
    RhsOutputs rhs;
    if (slot < 0 && !evaluate_contacts_in_step(run, step, s, p, &rhs))
        slot = add_sample(run, step, s, &rhs, 1);
    return bracket_point_of_sample(&run->roots.samples, slot, s, k);
}

/* Return value and slope of event function k at the beginning of a step. */
static Sample bracket_begin(const Integrator *run, const Step *step, int k)
{
    return (Sample){0.0, event_function(&run->discrete, &run->rhs, k), event_function_slope(run, step, &run->rhs, k)};
}

/* Return value and slope of event function k at the end of a step. */
static Sample bracket_end(const Integrator *run, const Step *step, int k)
{
    return (Sample){1.0, event_function(&run->discrete, &step->rhs, k), event_function_slope(run, step, &step->rhs, k)};
}

/*
 * Return the bracket of event function k from low to high, with those two stages between them at which it is nearest to
 * zero.
 */
static Bracket stage_bracket(const Step *step, int k, Sample low, Sample high)
{
    Sample nearest = {NAN, NAN, NAN}, next = nearest;
    const StageValues seen = stage_values(step, k);
    for (int i = 0; i < step->n_seen; i++) {
        const Sample now = {step->node[i], stage_value(seen, i), NAN};
        if (!(now.s > low.s && now.s < high.s && now.f == now.f))
            continue;
        if (!(fabs(now.f) >= fabs(nearest.f)))
            next = nearest, nearest = now;
        else if (!(fabs(now.f) >= fabs(next.f)))
            next = now;
    }
    return (Bracket){{low, high, nearest, next}, 2 + (nearest.s == nearest.s) + (next.s == next.s)};
}

/* Return the fraction of the step to which events are located: 4 ulp of the time, or the resolution of event times. */
static double event_time_tolerance(const Integrator *run, const Step *step)
{
    return max_of(4.0 * DBL_EPSILON * fabs(step->t), run->roots.time_resolution) / step->h;
}

/*
 * Return whether event function k may be located after its zero: that of a compliant contact, or of a switching point
 * whose branches meet. Steps of fixed length and watched functions never are.
 */
static int may_be_located_after_zero(const Integrator *run, int k)
{
    const int switch_index = k - N_CLEARANCES;
    if (run->control.fixed > 0.0 || watched_as[k] >= 0)
        return 0;
    return switch_index < 0 ? gives(k) : switch_index < N_SWITCHES && meets[switch_index];
}

/*
 * Return the largest fraction of a step by which a compliant contact may be located after its zero. Forces may begin
 * with a jump, and the length of a contact is not known before its onset. The step that finds the end is a part of the
 * contact, so that its limit is less strict.
 */
static double max_overshoot_of_contact(const Integrator *run, int k)
{
    const double tolerance = tolerance_of(run);
    return run->discrete.contact[k].closed ? min_of(MAX_END_OVERSHOOT, tolerance * sqrt(tolerance))
        : min_of(ONSET_TIME_TOLERANCE, tolerance * tolerance);
}

/*
 * Return the tolerance to which event function k is located. At a switching point, the rates of both branches differ in
 * proportion to its function. The error of the frozen branch thus grows with the square of the distance. It is
 * step->harm tolerances at the end of the step.
 */
static ZeroTolerance event_function_tolerance(const Integrator *run, const Step *step, int k)
{
    const double width = event_time_tolerance(run, step);
    if (!may_be_located_after_zero(run, k))
        return (ZeroTolerance){.width = width};
    if (k < N_CLEARANCES)
        return (ZeroTolerance){width, max_overshoot_of_contact(run, k), INFINITY, 1.0};
    return (ZeroTolerance){
        width, MAX_SWITCH_OVERSHOOT, HARMLESS_ERROR * fabs(event_function(&run->discrete, &step->rhs, k)), step->harm};
}

/*
 * Return the number of samples through which the zero of event function k is interpolated. A fourth one near a zero
 * that is located to rounding contains rounding only.
 */
static int n_interpolation_points(const Integrator *run, int k)
{
    return MAX_POINTS - !may_be_located_after_zero(run, k);
}

/* Event function k of a step, whose zero is located. first: it has not been sampled yet. */
typedef struct {
    Integrator *run;
    const Step *step;
    const Parameters *p;
    int k, first;
} EventFunctionOfStep;

/*
 * Evaluate an event function at fraction s for locate_zero(). The first sample of a gap evaluates the contacts only,
 * because the whole state is needed at the last sample alone.
 */
static int evaluate_event_function(void *context, double s, Sample *now)
{
    EventFunctionOfStep *of = context;
    *now = of->first && of->k < N_CLEARANCES ? gap_point_at(of->run, of->step, s, of->k, of->p)
        : bracket_point_at(of->run, of->step, s, of->k, of->p);
    of->first = 0;
    return 0;
}

/* Return the first fraction at which event function k is negative, from its bracket and a guess. */
static double locate_root(Integrator *run, const Step *step, int k, Bracket of, double guess, const Parameters *p)
{
    EventFunctionOfStep event_function_of_step = {run, step, p, k, 1};
    const ZeroTolerance tolerance = event_function_tolerance(run, step, k);
    (void)locate_zero(
        evaluate_event_function, &event_function_of_step, &tolerance, n_interpolation_points(run, k), guess, &of);
    return of.at[1].s;
}
