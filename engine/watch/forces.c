/*
 * Search for events of friction and rigid contacts in a step, by sampling forces and sliding velocities. This file
 * finds the first zero of three kinds of event functions: the margin of a sticking force to its limit, a sliding
 * velocity, the force of a closed contact.
 *
 * They follow from the right-hand side and have no bounds, and they may change within a step whose motion is at rest.
 * The dense output is sampled and bisected. On each part the event function is the parabola through both ends and the
 * middle within an error. It is ERROR_SAFETY times the largest by which the parabola of the whole part missed the
 * samples of its halves, and at least a fourth of the whole part's error. In theory the halves have an eighth of it.
 */
enum { MAX_FORCE_SAMPLES = 20000, MIN_STAGES = 8 /* of a step that bound a force between them */ };
#define ERROR_SAFETY 4.0
#define MAX_PARABOLA_WIDTH 0.25 /* of a step: longer parts do not show the error of a parabola */
#define MAX_TERM_EXCESS 0.05 /* of the range of a time term over a step: allowed excess over a parabola */
#define FORCE_ROUNDING 1e-12 /* of the largest sample: negative values by rounding */

/* A part of a step: the samples at its middle and end, and the error of the parabola through them. */
typedef struct {
    Sample middle, end;
    double error;
} SampledPart;

/*
 * Return whether the zeros of an event function are searched by this file: the force of a closed rigid contact, or the
 * force margin or slip of a friction element whose mode is not MODE_CONSTRAINED.
 */
static int is_force_or_slip_function(const Integrator *run, int event)
{
    const int friction = event - N_CLEARANCES - N_SWITCHES;
    if (event < N_CLEARANCES)
        return !is_compliant(event) && run->discrete.contact[event].closed;
    return friction >= 0 && friction < N_FRICTIONS && run->discrete.mode[friction] != MODE_CONSTRAINED;
}

#if N_FRICTIONS
/*
 * Return the error of a slip velocity that the tolerances of all velocities allow, m/s: the sum of its changes by one
 * tolerance of each velocity, one evaluation each. A failed evaluation counts as 0; 0 if the sum is not finite.
 */
static double compute_slip_tolerance(Integrator *run, int element, const Parameters *p)
{
    double y[N_Y], dy[N_Y], sum = 0.0;
    RhsOutputs rhs;
    for (int k = N_X; k < 2 * N_X; k++) {
        memcpy(y, run->y, sizeof y);
        y[k] += 1.0 / run->norm.weight[k];
        if (!evaluate_run_rhs(run, run->t, y, p, dy, &rhs))
            sum += fabs(rhs.friction[element].v - run->rhs.friction[element].v);
    }
    return isfinite(sum) ? sum : 0.0;
}
#endif

/*
 * Return how far an event function may be below zero at the beginning of a step without an event. For a slip velocity
 * that leaves rest (at most MAX_STICK_SPEED) it is the rounding or the error of the step, m/s; for all other functions
 * 0. Used as the allowance of bracket_force_zero().
 */
static double compute_initial_allowance(Integrator *run, int event, const Parameters *p)
{
#if N_FRICTIONS
    const int i = event - N_CLEARANCES - N_SWITCHES;
    const double mode = i >= 0 ? run->discrete.mode[i] : 0.0, v = i >= 0 ? run->rhs.friction[i].v : 0.0;
    if (mode != 0.0 && fabs(v) <= MAX_STICK_SPEED && mode * run->rhs.friction[i].rate > 0.0)
        return max_of(MAX_STICK_SPEED, compute_slip_tolerance(run, i, p));
#endif
    return (void)run, (void)event, (void)p, 0.0;
}

/*
 * Collect samples of a function along a step in the order of their fractions: at the beginning, at its inner stages
 * (`values`, without slopes), and at the end. Return their number, at most N_STAGES + 2. Used for forces and event
 * functions of explicit steps.
 */
static int collect_stage_samples(const Step *step, Sample begin, Sample end, StageValues values, Sample *samples)
{
    int n = 1;
    samples[0] = begin;
    for (int i = 0; i < step->n_stored_stages; i++) {
        int position = n;
        if (!(step->node[i] > 0.0 && step->node[i] < 1.0))
            continue;
        for (n++; samples[position - 1].s > step->node[i]; position--)
            samples[position] = samples[position - 1];
        samples[position] = (Sample){step->node[i], read_stage(values, i), NAN};
    }
    samples[n++] = end;
    return n;
}

#if N_TERMS
/*
 * Return whether a term of time alone may oscillate between samples at both ends and the middle of a part [begin, end]
 * of the step. By bounds of its slope, the term may leave the parabola through them by more than MAX_TERM_EXCESS of its
 * range over the step. That range is computed into step->term_range on the first call for the step (before: negative).
 * Return 1 if a bound is NaN.
 */
static int may_terms_oscillate_between(Step *step, double begin, double end, const Parameters *p)
{
    Interval term[N_TERMS], terms_at_begin[N_TERMS], term_middle[N_TERMS], terms_at_end[N_TERMS];
    const double width = end - begin;
    if (step->term_range[0] < 0.0) {
        bound_time_terms(step->t, step->h, 0.0, 1.0, p, term);
        for (int k = 0; k < N_TERMS; k++)
            step->term_range[k] = term[k].hi - term[k].lo;
    }
    bound_time_terms(step->t, step->h, begin, end, p, term);
    bound_time_terms(step->t, step->h, begin, begin, p, terms_at_begin);
    bound_time_terms(step->t, step->h, begin + 0.5 * width, begin + 0.5 * width, p, term_middle);
    bound_time_terms(step->t, step->h, end, end, p, terms_at_end);
    for (int k = 0; k < N_TERMS; k++) {
        const double slope = terms_at_end[k].lo - terms_at_begin[k].lo,
            second_difference = fabs(terms_at_begin[k].lo - 2.0 * term_middle[k].lo + terms_at_end[k].lo);
        const double excess = max_of(width * term[k].max_slope - slope, slope - width * term[k].min_slope)
            - 2.0 * second_difference;
        if (!(excess <= MAX_TERM_EXCESS * step->term_range[k]))
            return 1;
    }
    return 0;
}
#else
/* Return 0, no oscillation: the scene has no terms of time alone. */
static int may_terms_oscillate_between(Step *step, double begin, double end, const Parameters *p)
{
    return (void)step, (void)begin, (void)end, (void)p, 0;
}
#endif

/*
 * Return whether a term of time alone may oscillate between neighbouring ones of n samples. Samples are tested only if
 * a term may oscillate over the whole step. The result is stored in step->may_force_oscillate at the first call for a
 * step (before: negative).
 */
static int may_terms_oscillate_between_stages(Step *step, const Sample *samples, int n, const Parameters *p)
{
    if (step->may_force_oscillate < 0) {
        step->may_force_oscillate = may_terms_oscillate_between(step, 0.0, 1.0, p);
        for (int i = 1, is_tested = step->may_force_oscillate; i < n && is_tested; i++) {
            step->may_force_oscillate = may_terms_oscillate_between(step, samples[i - 1].s, samples[i].s, p);
            is_tested = !step->may_force_oscillate;
        }
    }
    return step->may_force_oscillate;
}

/*
 * Return a bound of the second derivative of a function given by n samples: CURVATURE_SAFETY times the largest second
 * difference quotient; 0 for n < 3.
 */
static double bound_second_derivative(const Sample *samples, int n)
{
    double largest = 0.0;
    for (int i = 1; i + 1 < n; i++) {
        const double left = (samples[i].f - samples[i - 1].f) / (samples[i].s - samples[i - 1].s);
        const double right = (samples[i + 1].f - samples[i].f) / (samples[i + 1].s - samples[i].s);
        largest = max_of(largest, 2.0 * CURVATURE_SAFETY * fabs(right - left) / (samples[i + 1].s - samples[i - 1].s));
    }
    return largest;
}

/*
 * Return whether the stages of a step show that an event function has no zero. Between neighbours a and b it is at
 * least min(f_a, f_b) - B w^2/8, where B bounds its second derivative, and at least the smaller one where it is
 * monotone. Until a sample exceeds `allowance`, values above -allowance are not negative (a force or slip that is just
 * leaving zero); later the limit is 0. Stages of stiff methods, or fewer than MIN_STAGES, decide for slip velocities
 * only, by the range of the samples. Return 0 also if terms of time alone may oscillate between the stages. Called
 * before the dense output is bisected.
 */
static int is_bounded_away_from_zero(const Integrator *run, Step *step, int event, double allowance,
    const Parameters *p)
{
    Sample samples[N_STAGES + 2];
    const int n =
        collect_stage_samples(step, sample_at_step_begin(run, step, event), sample_at_step_end(run, step, event),
            get_stage_values(step, event), samples);
    const int friction = event - N_CLEARANCES - N_SWITCHES;
    double smallest = INFINITY, largest = -INFINITY;
    for (int i = 0; i < n; i++) {
        smallest = min_of(smallest, samples[i].f);
        largest = max_of(largest, samples[i].f);
    }
    if (step->method->stiff || n < MIN_STAGES) /* inaccurate or distant stages: for velocities only */
        return friction >= 0 && friction < N_FRICTIONS && run->discrete.mode[friction] != 0.0
            && smallest > largest - smallest;
    const double curvature = bound_second_derivative(samples, n);
    for (int i = 1; i < n; i++) {
        const double width = samples[i].s - samples[i - 1].s, deviation = curvature * width * width;
        const int monotone = fabs(samples[i].f - samples[i - 1].f) > 0.5 * deviation;
        allowance = samples[i - 1].f > allowance ? 0.0 : allowance;
        if (!(min_of(samples[i - 1].f, samples[i].f) - (monotone ? 0.0 : 0.125 * deviation) > -allowance))
            return 0;
    }
    return (!(allowance > 0.0) || samples[n - 1].f >= -MAX_STICK_SPEED)
        && !may_terms_oscillate_between_stages(step, samples, n, p);
}

/*
 * Return the value, at a fraction of the step, of the parabola through three samples: at both ends and the middle of a
 * part.
 */
static double evaluate_parabola(Sample begin, Sample middle, Sample end, double fraction)
{
    const double x = 2.0 * (fraction - middle.s) / (end.s - begin.s);
    return middle.f + 0.5 * x * (end.f - begin.f + x * (begin.f - 2.0 * middle.f + end.f));
}

/*
 * Return the minimum, between begin and end of a part, of the parabola through three equally spaced samples: there and
 * in the middle. *max_slope: the largest signed slope of the parabola in the part, per fraction of the step; the
 * parabola falls over the whole part if it is negative.
 */
static double find_parabola_minimum(Sample begin, Sample middle, Sample end, double *max_slope)
{
    const double slope = 0.5 * (end.f - begin.f), curvature = begin.f - 2.0 * middle.f + end.f, x = -slope / curvature;
    const double minimum = min_of(begin.f, min_of(middle.f, end.f));
    *max_slope = 2.0 * (slope + fabs(curvature)) / (end.s - begin.s);
    return curvature > 0.0 && fabs(x) < 1.0 ? min_of(minimum, middle.f + 0.5 * slope * x) : minimum;
}

/*
 * Return the error of the parabolas of both halves of a part that begins at the sample `begin`, by new samples in the
 * middles of the halves. It is at least a fourth of the error of the whole part, and infinite for parts longer than
 * MAX_PARABOLA_WIDTH.
 */
static double estimate_error_of_halves(Sample begin, SampledPart part, Sample left_middle, Sample right_middle)
{
    const double largest_difference = max_of(fabs(left_middle.f
        - evaluate_parabola(begin, part.middle, part.end, left_middle.s)),
        fabs(right_middle.f - evaluate_parabola(begin, part.middle, part.end, right_middle.s)));
    const double min_error = isfinite(part.error) ? 0.25 * part.error : 0.0;
    return part.end.s - begin.s > MAX_PARABOLA_WIDTH ? INFINITY : max_of(min_error, ERROR_SAFETY * largest_difference);
}

/*
 * Bracket the first zero in the step of an event function of friction or of a closed rigid contact: return whether
 * there is one, and the samples low, high that enclose it. The stages decide if they can; otherwise the dense output is
 * bisected on parts with parabolas and their errors. A slip velocity that leaves rest may be negative within its
 * tolerance at first; if it is still negative at the end, it has reversed. Return 0 without dense output. Called for
 * each such function of a tried step.
 */
static int bracket_force_zero(Integrator *run, Step *step, int event, const Parameters *p, Sample *low, Sample *high)
{
    const double min_width = 4.0 * compute_event_time_tolerance(run, step);
    double allowance = compute_initial_allowance(run, event, p);
    SampledPart parts[MAX_BISECTIONS + 1];
    Sample from = sample_at_step_begin(run, step, event);
    double largest = fabs(from.f);
    if (is_bounded_away_from_zero(run, step, event, allowance, p) || compute_dense_output(run, p, step))
        return 0;
    parts[0] = (SampledPart){sample_event_function(run, step, 0.5, event, p), sample_at_step_end(run, step, event),
        INFINITY};
    for (int n = 1, samples = 1; n > 0;) {
        const SampledPart current = parts[n - 1];
        const double width = current.end.s - from.s;
        double max_slope;
        allowance = from.f > allowance ? 0.0 : allowance;
        const double lower_bound = find_parabola_minimum(from, current.middle, current.end, &max_slope) - current.error;
        const int is_negative = current.middle.f < -allowance || current.end.f < -allowance;
        const int is_small = width < min_width || n > MAX_BISECTIONS || samples > MAX_FORCE_SAMPLES;
        largest = max_of(largest, max_of(fabs(current.middle.f), fabs(current.end.f)));
        if (is_negative && (is_small || max_slope + 4.0 * current.error / width < 0.0)) {
            *low = from;
            *high = current.middle.f < -allowance ? current.middle : current.end;
            return 1;
        }
        if (is_small
            || (lower_bound >= -allowance - FORCE_ROUNDING * largest
                && !may_terms_oscillate_between(step, from.s, current.end.s, p))) {
            from = current.end;
            n--;
            continue;
        }
        const Sample left = sample_event_function(run, step, from.s + 0.25 * width, event, p);
        const Sample right = sample_event_function(run, step, current.end.s - 0.25 * width, event, p);
        const double error = estimate_error_of_halves(from, current, left, right);
        parts[n - 1] = (SampledPart){right, current.end, error};
        parts[n++] = (SampledPart){left, current.middle, error};
        samples += 2;
    }
    *low = sample_at_step_begin(run, step, event);
    *high = from; /* a velocity within its tolerance has reversed */
    return allowance > 0.0 && from.f < -MAX_STICK_SPEED;
}
