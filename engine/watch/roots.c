/*
 * Location of events on the dense output of a step, from samples of event functions, to a time tolerance. Read zeros.h
 * first.
 */
#define ONSET_TIME_TOLERANCE 1e-9   /* of a step, after the onset of a contact, at most */
#define MAX_END_OVERSHOOT 1e-6     /* of a step, after the end of a contact, at most */
#define MAX_SWITCH_OVERSHOOT 1e-2  /* of a step, after a switching point, at most */
#define MAX_OVERSHOOT_ERROR 1e-4   /* of the tolerance: accepted change of a step by the inactive branch */

/*
 * Evaluate the dense output at a fraction of the step, by the method of the step: y (N_Y), not projected onto the
 * constraints. The dense output must have been computed.
 */
static void interpolate(const Integrator *run, const Step *step, double fraction, double *y)
{
    step->method->interpolate(run, step, fraction, y);
}

/*
 * Compute the projected state y, its rates dy and the outputs rhs at a fraction of the step. The stored sample after
 * the last located zero (samples.negative_fraction) is returned without evaluation. Residual slips of sticking friction
 * are removed. Return a status.
 */
static int evaluate_state_at(
    Integrator *run, const Step *step, double fraction, const Parameters *p, double *y, double *dy, RhsOutputs *rhs)
{
    if (fraction == run->roots.samples.negative_fraction) {
        memcpy(y, run->roots.samples.y, sizeof run->roots.samples.y);
        memcpy(dy, run->roots.samples.dy, sizeof run->roots.samples.dy);
        *rhs = run->roots.samples.rhs;
        return 0;
    }
    interpolate(run, step, fraction, y);
    const double t = step->t + fraction * step->h;
    project_state(run, t, y, p);
    return evaluate_rates_without_residual_slips(run, t, y, p, dy, rhs);
}

/*
 * Evaluate the contacts of joints with play at a state y and time t (s) into rhs. Forces of rigid contacts follow from
 * accelerations, so that these scenes evaluate the whole right-hand side. Polls cancellation. Return 0, STOPPED or
 * another status.
 */
static int evaluate_contacts_at(Integrator *run, double t, const double *y, const Parameters *p, RhsOutputs *rhs)
{
#if N_RIGID
    double dy[N_Y];
    return evaluate_run_rhs(run, t, y, p, dy, rhs);
#else
    count_evaluations(run, 1);
    if (is_cancelled(&run->cancellation))
        return STOPPED;
    copy_internal_states(&run->discrete, y);
    return evaluate_contacts(t, y, &run->discrete, p, rhs);
#endif
}

/*
 * Evaluate the contacts of joints with play at a fraction of the step into rhs, at the interpolated and projected state
 * (project_state()). The stored sample after the last located zero is copied if it is at that fraction. Scenes with
 * friction elements evaluate the whole right-hand side. Return a status. Used in the searches for zeros and for peaks
 * (run peaks.c).
 */
static int evaluate_contacts_in_step(Integrator *run, const Step *step, double fraction, const Parameters *p,
    RhsOutputs *rhs)
{
    double y[N_Y];
    if (fraction == run->roots.samples.negative_fraction) {
        *rhs = run->roots.samples.rhs;
        return 0;
    }
#if N_FRICTIONS
    double dy[N_Y];
    return evaluate_state_at(run, step, fraction, p, y, dy, rhs);
#else
    interpolate(run, step, fraction, y);
    project_state(run, step->t + fraction * step->h, y, p);
    return evaluate_contacts_at(run, step->t + fraction * step->h, y, p, rhs);
#endif
}

/*
 * Return the rate of an event function per fraction of the step. NAN if the outputs rhs do not contain it: that of a
 * closed rigid contact, a switching point, friction or a user-defined event.
 */
static double compute_event_function_slope(const Integrator *run, const Step *step, const RhsOutputs *rhs, int event)
{
    if (event >= N_CLEARANCES || (run->discrete.contact[event].closed && !is_compliant(event)))
        return NAN;
    return (run->discrete.contact[event].closed ? step->h : -step->h) * rhs->clearance[event].deltadot;
}

/* Discard all stored samples of the dense output. Called when the dense output of a new step has been computed. */
static void discard_dense_samples(Integrator *run)
{
    run->roots.samples.n = 0;
    run->roots.samples.negative_fraction = NAN;
}

/*
 * Return the index of the stored sample at a fraction of the step, -1 if there is none. gaps_only: whether a sample of
 * joints with play alone is sufficient.
 */
static int find_dense_sample(const DenseSamples *samples, double fraction, int gaps_only)
{
    for (int i = samples->n; i > 0 && i > samples->n - N_DENSE_SAMPLES; i--)
        if (samples->fraction[(i - 1) % N_DENSE_SAMPLES] == fraction
            && gaps_only >= samples->has_gaps_only[(i - 1) % N_DENSE_SAMPLES])
            return (i - 1) % N_DENSE_SAMPLES;
    return -1;
}

/*
 * Store the event functions at a fraction of the step as a sample that replaces the oldest one, and return its index.
 * Slopes are stored for joints with play only. rhs: outputs there; gaps_only: store the functions of these joints only.
 */
static int add_dense_sample(Integrator *run, const Step *step, double fraction, const RhsOutputs *rhs, int gaps_only)
{
    const int index = run->roots.samples.n++ % N_DENSE_SAMPLES;
    run->roots.samples.fraction[index] = fraction;
    run->roots.samples.has_gaps_only[index] = gaps_only;
    for (int i = 0; i < (gaps_only ? N_CLEARANCES : N_EVENT_FUNCTIONS); i++)
        run->roots.samples.event_function[index][i] = compute_event_value(&run->discrete, rhs, i);
    for (int i = 0; i < N_CLEARANCES; i++)
        run->roots.samples.slope[index][i] = compute_event_function_slope(run, step, rhs, i);
    return index;
}

/*
 * Return the index of the sample of all event functions at a fraction of the step; -1 if it cannot be evaluated. It is
 * evaluated and stored on first use. The whole state is stored as well if event function `event` is negative there
 * (event = -1: never).
 */
static int find_or_add_dense_sample(Integrator *run, const Step *step, double fraction, int event, const Parameters *p)
{
    DenseSamples *samples = &run->roots.samples;
    double y[N_Y], dy[N_Y];
    RhsOutputs rhs;
    int index = find_dense_sample(samples, fraction, 0);
    if (index >= 0 || evaluate_state_at(run, step, fraction, p, y, dy, &rhs))
        return index;
    index = add_dense_sample(run, step, fraction, &rhs, 0);
    if (event >= 0 && samples->event_function[index][event] < 0.0) {
        samples->negative_fraction = fraction;
        memcpy(samples->y, y, sizeof y);
        memcpy(samples->dy, dy, sizeof dy);
        samples->rhs = rhs;
    }
    return index;
}

/*
 * Return value and slope of an event function from the stored dense sample `index`, with the location `fraction`; NAN
 * for index -1. Slopes are NAN for functions other than gaps.
 */
static Sample get_event_function_sample(const DenseSamples *samples, int index, double fraction, int event)
{
    return index < 0 ? (Sample){fraction, NAN, NAN}
        : (Sample){fraction, samples->event_function[index][event], event < N_CLEARANCES ? samples->slope[index][event]
            : NAN};
}

/*
 * Return value and slope of an event function at a fraction of the step. A stored dense sample at this fraction is
 * reused; else the right-hand side is evaluated there, and the sample is stored. NAN if the evaluation fails.
 */
static Sample sample_event_function(Integrator *run, const Step *step, double fraction, int event, const Parameters *p)
{
    const int index = find_or_add_dense_sample(run, step, fraction, event, p);
    return get_event_function_sample(&run->roots.samples, index, fraction, event);
}

/* Return the value of an event function at a fraction of the step; NAN if it cannot be evaluated. */
static double evaluate_event_function_at(Integrator *run, const Step *step, double fraction, int event,
    const Parameters *p)
{
    return sample_event_function(run, step, fraction, event, p).f;
}

/*
 * Return value and slope of the event function of a joint with play at a fraction of the step. A stored dense sample at
 * this fraction is reused; else the contacts alone are evaluated there, and the sample is stored in run->roots.samples.
 * NAN if that fails.
 */
static Sample sample_gap_function(Integrator *run, const Step *step, double fraction, int event, const Parameters *p)
{
    int index = find_dense_sample(&run->roots.samples, fraction, 1);
    RhsOutputs rhs;
    if (index < 0 && !evaluate_contacts_in_step(run, step, fraction, p, &rhs))
        index = add_dense_sample(run, step, fraction, &rhs, 1);
    return get_event_function_sample(&run->roots.samples, index, fraction, event);
}

/*
 * Return value and slope of an event function at the beginning of a step (fraction 0). The slope is NAN if it is not
 * known.
 */
static Sample sample_at_step_begin(const Integrator *run, const Step *step, int event)
{
    return (Sample){0.0, compute_event_value(&run->discrete, &run->rhs, event),
        compute_event_function_slope(run, step, &run->rhs, event)};
}

/*
 * Return value and slope of an event function at the end of a step (fraction 1). The slope is NAN if it is not known.
 */
static Sample sample_at_step_end(const Integrator *run, const Step *step, int event)
{
    return (Sample){1.0, compute_event_value(&run->discrete, &step->rhs, event),
        compute_event_function_slope(run, step, &step->rhs, event)};
}

/*
 * Return the bracket of an event function from low to high, with those two stages of the step between them at which its
 * magnitude is smallest. Stages without a finite value are left out, so that the bracket has two to four samples. Used
 * for the first guess of the zero.
 */
static Bracket build_stage_bracket(const Step *step, int event, Sample low, Sample high)
{
    Sample nearest = {NAN, NAN, NAN}, second_nearest = nearest;
    const StageValues stages = get_stage_values(step, event);
    for (int i = 0; i < step->n_stored_stages; i++) {
        const Sample sample = {step->node[i], read_stage(stages, i), NAN};
        if (!(sample.s > low.s && sample.s < high.s && sample.f == sample.f))
            continue;
        if (!(fabs(sample.f) >= fabs(nearest.f)))
            second_nearest = nearest, nearest = sample;
        else if (!(fabs(sample.f) >= fabs(second_nearest.f)))
            second_nearest = sample;
    }
    return (Bracket){{low, high, nearest, second_nearest},
        2 + (nearest.s == nearest.s) + (second_nearest.s == second_nearest.s)};
}

/*
 * Return the tolerance of event times as a fraction of the step: the larger of 4 ulp of the time and the resolution of
 * event times, over the step length.
 */
static double compute_event_time_tolerance(const Integrator *run, const Step *step)
{
    return max_of(4.0 * DBL_EPSILON * fabs(step->t), run->roots.time_resolution) / step->h;
}

/*
 * Return whether an event function may be located a little after its zero: that of a compliant contact, or of a
 * switching point of a contact law whose branches meet. With steps of fixed length, and for monitored functions
 * (watched.c), it may not.
 */
static int may_be_located_after_zero(const Integrator *run, int event)
{
    const int switch_index = event - N_CLEARANCES;
    if (run->control.fixed > 0.0 || monitored_index[event] >= 0)
        return 0;
    return switch_index < 0 ? is_compliant(event) : switch_index < N_SWITCHES && is_continuous_switch[switch_index];
}

/*
 * Return the largest fraction of a step by which the event of a compliant contact may be located after its zero: rtol^2
 * for an onset, rtol^1.5 for an end, with the limits above. An onset has the stricter limit: forces may begin with a
 * jump, and the length of a contact is not known before it. The step that finds the end is a part of the contact.
 */
static double compute_max_contact_overshoot(const Integrator *run, int joint)
{
    const double tolerance = get_rtol(run);
    return run->discrete.contact[joint].closed ? min_of(MAX_END_OVERSHOOT, tolerance * sqrt(tolerance))
        : min_of(ONSET_TIME_TOLERANCE, tolerance * tolerance);
}

/*
 * Return the tolerance to which the zero of an event function is located, in fractions of the step: width in time,
 * largest overshoot after the zero, limit of the error there, and factor of that error. Functions that must not be
 * located after their zero have a width only. Compliant contacts have an overshoot without a limit of its error. At a
 * switching point, the error of the frozen branch grows with the square of the distance, as the rates of both branches
 * differ in proportion to its function; it is step->branch_error error tolerances at the end of the step.
 */
static ZeroTolerance compute_zero_tolerance(const Integrator *run, const Step *step, int event)
{
    const double width = compute_event_time_tolerance(run, step);
    if (!may_be_located_after_zero(run, event))
        return (ZeroTolerance){.width = width};
    if (event < N_CLEARANCES)
        return (ZeroTolerance){width, compute_max_contact_overshoot(run, event), INFINITY, 1.0};
    return (ZeroTolerance){
        width, MAX_SWITCH_OVERSHOOT, MAX_OVERSHOOT_ERROR * fabs(compute_event_value(&run->discrete, &step->rhs, event)),
            step->branch_error};
}

/*
 * Return the number of samples through which the zero of an event function is interpolated: MAX_POINTS, or one less for
 * a zero that is located to rounding, near which a fourth sample contains rounding only.
 */
static int count_interpolation_points(const Integrator *run, int event)
{
    return MAX_POINTS - !may_be_located_after_zero(run, event);
}

/* Event function k of a step, whose zero is located. first: it has not been sampled yet. */
typedef struct {
    Integrator *run;
    const Step *step;
    const Parameters *p;
    int k, first;
} EventFunctionOfStep;

/*
 * Evaluate an event function at a fraction of the step into *sample, as the callback of locate_zero(). context: an
 * EventFunctionOfStep. The first sample of a gap evaluates the contacts only, because the whole state is needed at the
 * last sample alone. Return 0; a failure sets NAN.
 */
static int evaluate_event_function(void *context, double fraction, Sample *sample)
{
    EventFunctionOfStep *search = context;
    *sample = search->first && search->k < N_CLEARANCES
        ? sample_gap_function(search->run, search->step, fraction, search->k, search->p)
        : sample_event_function(search->run, search->step, fraction, search->k, search->p);
    search->first = 0;
    return 0;
}

/*
 * Locate the first zero of an event function in a step, from its bracket and a guess, and return its fraction of the
 * step: the upper end of the narrowed bracket, where the function is negative. That sample and its state are stored.
 * Called for each event function whose bracket is known.
 */
static double locate_event_in_step(Integrator *run, const Step *step, int event, Bracket bracket, double guess,
    const Parameters *p)
{
    EventFunctionOfStep event_function_of_step = {run, step, p, event, 1};
    const ZeroTolerance tolerance = compute_zero_tolerance(run, step, event);
    (void)locate_zero(
        evaluate_event_function, &event_function_of_step, &tolerance, count_interpolation_points(run, event), guess,
            &bracket);
    return bracket.at[1].s;
}
