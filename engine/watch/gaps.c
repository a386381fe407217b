/*
 * Search for contacts in a step: the first zero of a joint's gap or penetration, with a proof that none precedes it.
 * The event function is the gap of an open contact, or the penetration of a closed one.
 *
 * classify_gap_by_stages() decides most steps. The second derivative is bounded by CURVATURE_SAFETY times the largest
 * difference quotient of the rates of neighbouring stages. The dense output differs from the stages by at most
 * DENSE_ERROR tolerances. Otherwise find_first_gap_zero() bisects the dense output. On each part the event function is
 * the cubic Hermite polynomial of both ends within an error. That error is the one measured in the middle of the part
 * before the bisection; in theory its halves have a sixteenth of it.
 *
 * Guarantee: no zero of the dense output is missed, and none before the located one. It assumes that the error of a
 * half does not exceed the measured error of the whole, on parts of at most a quarter of the step.
 */
enum { MAX_BISECTIONS = 48, MAX_SAMPLES = 400 /* of a joint in a step */ };

#define DENSE_ERROR 10.0 /* tolerances of a length, by which the dense output may differ from the stages */

/* A part of a step: the sample at its end, and the error of the cubic between both ends. */
typedef struct {
    Sample end;
    double error;
} PartOfStep;

enum { NO_ZERO, ONE_ZERO, UNKNOWN }; /* no zero; one zero, at which the function decreases; undecided */

/*
 * Return the event function of a contact and its slope at a fraction of the step, from penetration (m) and penetration
 * rate (m/s). For a journal f = (c^2 - e^2) / 2c, negated in contact, which unlike the eccentricity e is smooth at the
 * centre; for sliders and contours the penetration itself. inverse_clearance: 1/c, 1/m.
 */
static Sample evaluate_gap_function(
    const Integrator *run, const Step *step, int joint, double fraction, double penetration, double penetration_rate,
    double inverse_clearance)
{
    const double sign = run->discrete.contact[joint].closed ? 1.0 : -1.0;
#if defined WALLS || defined CONTOURS
    (void)inverse_clearance;
    return (Sample){fraction, sign * penetration, sign * step->h * penetration_rate};
#else
    return (Sample){fraction, sign * penetration * (1.0 + 0.5 * penetration * inverse_clearance),
        sign * step->h * penetration_rate * (1.0 + penetration * inverse_clearance)};
#endif
}

/*
 * Collect samples of the event function of a contact along a step: at its beginning, inner stages and end. samples:
 * values with slopes, in the order of the nodes. Return their number, at most N_STAGES + 2.
 */
static int collect_gap_samples(const Integrator *run, const Step *step, int joint, const Parameters *p,
    Sample *samples)
{
    const StageValues event_functions = get_stage_values(step, joint),
                      rates = get_stage_values(step, STAGE_GAP_RATES + joint);
    const double inverse_clearance = 1.0 / radial_clearance(p, joint), sign = run->discrete.contact[joint].closed ? 1.0
        : -1.0;
    const Clearance *clearance_begin = &run->rhs.clearance[joint], *clearance_end = &step->rhs.clearance[joint];
    int n = 1;
    samples[0] = evaluate_gap_function(run, step, joint, 0.0, clearance_begin->delta, clearance_begin->deltadot,
        inverse_clearance);
    for (int k = 0; k < step->n_stored_stages; k++) {
        const double node = step->node[k];
        int position = n;
        if (!(node > 0.0 && node < 1.0))
            continue;
        for (n++; samples[position - 1].s > node; position--)
            samples[position] = samples[position - 1];
        samples[position] =
            evaluate_gap_function(run, step, joint, node, sign * read_stage(event_functions, k), read_stage(rates, k),
                inverse_clearance);
    }
    samples[n++] = evaluate_gap_function(run, step, joint, 1.0, clearance_end->delta, clearance_end->deltadot,
        inverse_clearance);
    return n;
}

/*
 * Return by how much the dense output of a gap may differ from the stages in the middle of a step, m: DENSE_ERROR
 * tolerances. It is exact at both ends.
 */
static double compute_dense_output_error(const Integrator *run, int joint, const Parameters *p)
{
    return DENSE_ERROR * get_rtol(run) * radial_clearance(p, joint);
}

/*
 * Return whether the gap function of a contact cannot reach zero between its samples at beginning, stages and end, by a
 * bound from the range of its observed rates. This test is the cheapest and decides most steps.
 */
static int is_gap_far_from_zero(const Integrator *run, const Step *step, int joint, const Parameters *p)
{
    return compute_gap_lower_bound(step, joint, compute_event_value(&run->discrete, &run->rhs, joint),
        compute_event_value(&run->discrete, &step->rhs, joint), run->rhs.clearance[joint].deltadot,
        step->rhs.clearance[joint].deltadot) > compute_dense_output_error(run, joint, p);
}

/*
 * Return whether a function with |f''| <= B (max_second_derivative) is at least `lower_bound` between neighbouring
 * samples a and b, w apart. It is at least min(f_a, f_b) - B w^2/8. It is also at least max(f_a + f'_a x - B x^2/2, f_b
 * - f'_b (w - x) - B (w - x)^2/2), whose minimum is where both parabolas meet.
 */
static int is_above_parabolas(Sample a, Sample b, double max_second_derivative, double lower_bound)
{
    const double width = b.s - a.s, max_change = max_second_derivative * width;
    if (min_of(a.f, b.f) - 0.125 * max_change * width >= lower_bound)
        return 1;
    const double x = (a.f - b.f + (b.slope + 0.5 * max_change) * width) / (b.slope - a.slope + max_change);
    return x >= 0.0 && x <= width && a.f + x * (a.slope - 0.5 * max_second_derivative * x) >= lower_bound;
}

/*
 * Classify the event function of a contact in a step by its stages: NO_ZERO (no zero), ONE_ZERO (one zero, at which it
 * decreases) or UNKNOWN. *first_negative: the node of the first stage at which it is negative by more than the error of
 * the dense output, else 1. Called if is_gap_far_from_zero() does not decide.
 */
static int classify_gap_by_stages(const Integrator *run, const Step *step, int joint, const Parameters *p,
    double *first_negative)
{
    Sample samples[N_STAGES + 2];
    const int n = collect_gap_samples(run, step, joint, p, samples);
    const double bound = compute_gap_event_threshold(p, joint),
        error = 16.0 * compute_dense_output_error(run, joint, p);
    double max_second_derivative = 0.0;
    int is_decreasing = 0, first = 1;
    while (first < n - 1 && samples[first].f >= -error)
        first++;
    *first_negative = samples[first].s;
    if (!(samples[0].f >= bound))
        return UNKNOWN;
    for (int k = 1; k < n; k++) {
        const double width = samples[k].s - samples[k - 1].s, change = fabs(samples[k].slope - samples[k - 1].slope);
        if (change > max_second_derivative * width)
            max_second_derivative = change / width;
    }
    max_second_derivative *= CURVATURE_SAFETY;
    for (int k = 1; k < n; k++) {
        const Sample a = samples[k - 1], b = samples[k];
        const double s = b.s < 0.5 ? b.s : a.s > 0.5 ? a.s : 0.5, deviation = error * s * s * (1.0 - s) * (1.0 - s);
        if (!is_decreasing && b.f >= 0.0 && is_above_parabolas(a, b, max_second_derivative, bound + deviation))
            continue;
        if (!(0.5 * (a.slope + b.slope + max_second_derivative * (b.s - a.s)) + 0.2 * error < 0.0))
            return UNKNOWN;
        is_decreasing = 1;
    }
    return is_decreasing && samples[n - 1].f < 0.0 ? ONE_ZERO : NO_ZERO;
}

/* Return the minimum of the cubic f + r u + c u^2 + d u^3 for u from 0 to 1/2. */
static double find_cubic_minimum(double f, double r, double c, double d)
{
    const double discriminant_root = sqrt(max_of(0.0, c * c - 3.0 * d * r)), x = c > 0.0 ? -r / (c + discriminant_root)
        : (discriminant_root - c) / (3.0 * d);
    const double minimum = min_of(f, f + 0.5 * (r + 0.5 * (c + 0.5 * d)));
    return x > 0.0 && x < 0.5 ? min_of(minimum, f + x * (r + x * (c + x * d))) : minimum;
}

/*
 * Classify an event function between samples a and b with slopes: NO_ZERO (no value below `lower_bound`), ONE_ZERO (one
 * zero, at which it decreases) or UNKNOWN. It differs from their cubic by 16 error u^2 (1 - u)^2 at most, as the error
 * of Hermite's cubic does, and its rate by 3.1 error. Called for each part of the dense output that is bisected.
 */
static int classify_gap_by_cubic(Sample a, Sample b, double error, double lower_bound)
{
    const double width = b.s - a.s, slope_a = width * a.slope, slope_b = width * b.slope, rise = b.f - a.f;
    const double c = 3.0 * rise - 2.0 * slope_a - slope_b, d = slope_a + slope_b - 2.0 * rise, deviation = 16.0 * error;
    const int is_positive_at_end = b.f >= (b.s < 1.0 || b.slope > 0.0 ? lower_bound : 0.0);
    if (is_positive_at_end && find_cubic_minimum(a.f, slope_a, c - deviation, d) >= lower_bound
        && find_cubic_minimum(b.f, -slope_b, c + 3.0 * d - deviation, -d) >= lower_bound)
        return NO_ZERO;
    double steepest = max_of(slope_a, slope_b);
    if (d < 0.0 && c > 0.0 && c < -3.0 * d)
        steepest = max_of(steepest, slope_a - c * c / (3.0 * d));
    if (!(steepest + 3.1 * error < 0.0))
        return UNKNOWN;
    return is_positive_at_end ? NO_ZERO : ONE_ZERO;
}

/*
 * Return the error of the Hermite cubic of samples a and b at the middle sample: that of its value plus an eighth of
 * that of its rate. It is the allowed error of both halves.
 */
static double compute_cubic_error(Sample a, Sample middle, Sample b)
{
    const double width = b.s - a.s;
    const double value = 0.5 * (a.f + b.f) + 0.125 * width * (a.slope - b.slope);
    const double slope = 1.5 * (b.f - a.f) - 0.25 * width * (a.slope + b.slope);
    return fabs(middle.f - value) + 0.125 * fabs(width * middle.slope - slope);
}

/*
 * Find the first zero of the event function of a contact on the dense output, by bisection. Return ONE_ZERO with the
 * bracket low, high, or NO_ZERO up to max_fraction of the step. first_negative: fraction at which it is probably
 * negative; the first part ends there if that is within the first half of the step. Parts are not divided further at
 * event times, after MAX_SAMPLES, or if an evaluation fails; then the sign at their end decides. Called if the stages
 * do not decide.
 */
static int find_first_gap_zero(
    Integrator *run, const Step *step, int joint, const Parameters *p, double max_fraction, double first_negative,
    Sample *low,
    Sample *high)
{
    const double bound = compute_gap_event_threshold(p, joint),
        min_width = 4.0 * compute_event_time_tolerance(run, step);
    PartOfStep parts[MAX_BISECTIONS + 1] = {{sample_at_step_end(run, step, joint), INFINITY}};
    Sample begin = sample_at_step_begin(run, step, joint);
    const Sample sample = min_of(first_negative, max_fraction) <= 0.5
        ? sample_gap_function(run, step, min_of(first_negative, max_fraction), joint, p)
        : (Sample){0.0, NAN, NAN};
    int n_parts = 1;
    if (isfinite(sample.f))
        parts[n_parts++] = (PartOfStep){sample, INFINITY};
    for (int n_samples = 0; n_parts > 0 && begin.s < max_fraction;) {
        const PartOfStep part = parts[n_parts - 1];
        const double width = part.end.s - begin.s;
        int result = begin.f >= bound ? classify_gap_by_cubic(begin, part.end, part.error, bound) : ONE_ZERO;
        if (result == UNKNOWN) {
            const Sample middle = width > min_width && n_parts <= MAX_BISECTIONS && n_samples++ < MAX_SAMPLES
                ? sample_gap_function(run, step, begin.s + 0.5 * width, joint, p) : (Sample){0.0, NAN, NAN};
            if (isfinite(middle.f)) {
                const double error = width > 0.5 ? INFINITY : compute_cubic_error(begin, middle, part.end);
                parts[n_parts - 1].error = error;
                parts[n_parts] = (PartOfStep){middle, error};
                n_parts++;
                continue;
            }
            result = part.end.f < (part.end.s < 1.0 ? bound : 0.0) ? ONE_ZERO : NO_ZERO;
        }
        if (result == ONE_ZERO) {
            *low = begin;
            *high = part.end;
            return ONE_ZERO;
        }
        begin = part.end;
        n_parts--;
    }
    return NO_ZERO;
}

/*
 * Bracket the first zero in the step of the event function of a contact: return whether there is one, and its bracket
 * low, high. Zeros after max_fraction may be omitted. The stages decide most steps; otherwise the dense output is
 * bisected. Without dense output the sign at the end decides. A value that is negative within rounding at the
 * beginning, and increases, counts as zero. Called for each joint with play of a tried step.
 */
static int bracket_gap_zero(Integrator *run, Step *step, int joint, const Parameters *p, double max_fraction,
    Sample *low, Sample *high)
{
    double first_negative = 1.0;
    int result = is_gap_far_from_zero(run, step, joint, p) ? NO_ZERO
        : classify_gap_by_stages(run, step, joint, p, &first_negative);
    *low = sample_at_step_begin(run, step, joint);
    *high = sample_at_step_end(run, step, joint);
    if (result == UNKNOWN)
        result = compute_dense_output(run, p, step) ? high->f < 0.0 ? ONE_ZERO : NO_ZERO
            : find_first_gap_zero(run, step, joint, p, max_fraction, first_negative, low, high);
    if (low->f < 0.0 && low->f >= compute_gap_event_threshold(p, joint) && low->slope > 0.0)
        low->f = 0.0; /* within rounding, and increasing */
    return result == ONE_ZERO;
}
