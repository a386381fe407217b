/*
 * Contacts along a step: the first zero of the event function of a joint with play, and the proof that no zero precedes
 * it. The event function is the gap of an open contact, or the penetration of a closed one.
 *
 * bound_by_stages() decides most steps. The second derivative is bounded by BEND_SAFETY times the largest value that
 * the rates of neighbouring stages show. The dense output differs from the stages by DENSE_ERROR tolerances at most.
 * Otherwise first_zero() bisects the dense output. On each part the event function is the cubic Hermite polynomial of
 * both ends within an error. That error is the one measured in the middle of the part before the bisection; in theory
 * its halves have a sixteenth of it.
 *
 * Guarantee: no zero of the dense output is missed, and none before the located one. It assumes that the error of a
 * half does not exceed the measured error of the whole, on parts of at most a quarter of the step.
 */
enum { MAX_BISECTIONS = 48, MAX_SAMPLES = 400 /* of a joint in a step */ };

#define BEND_SAFETY 2.0
#define WIDEST 0.125     /* w/4 for neighbouring stages at most w of a step apart */
#define DENSE_ERROR 10.0 /* tolerances of a length, by which the dense output may differ from the stages */

/* A part of a step: the sample at its end, and the error of the cubic between both ends. */
typedef struct {
    Sample end;
    double error;
} PartOfStep;

enum { CLEAR, FALLS, UNKNOWN }; /* no zero; one zero, at which the function decreases; undecided */

/*
 * Return the event function of contact i at fraction s from penetration and rate: f = (c^2 - e^2) / 2c for a journal,
 * negated in contact. Unlike the eccentricity e it is smooth at the centre. per_c: 1/c, 1/m.
 */
static Sample gap_function(
    const Integrator *run, const Step *step, int i, double s, double delta, double rate, double per_c)
{
    const double sign = run->discrete.contact[i].closed ? 1.0 : -1.0;
#if defined WALLS || defined CONTOURS
    (void)per_c;
    return (Sample){s, sign * delta, sign * step->h * rate};
#else
    return (Sample){s, sign * delta * (1.0 + 0.5 * delta * per_c), sign * step->h * rate * (1.0 + delta * per_c)};
#endif
}

/*
 * Collect event function i at the beginning of a step, at its stages in the order of their nodes, and at its end.
 * Returns the number of samples in `all`, at most N_STAGES + 2.
 */
static int event_function_at_stages(const Integrator *run, const Step *step, int i, const Parameters *p, Sample *all)
{
    const StageValues event_functions = stage_values(step, i), rates = stage_values(step, STAGE_GAP_RATES + i);
    const double per_c = 1.0 / radial_clearance(p, i), sign = run->discrete.contact[i].closed ? 1.0 : -1.0;
    const Clearance *begin = &run->rhs.clearance[i], *end = &step->rhs.clearance[i];
    int n = 1;
    all[0] = gap_function(run, step, i, 0.0, begin->delta, begin->deltadot, per_c);
    for (int k = 0; k < step->n_seen; k++) {
        const double node = step->node[k];
        int at = n;
        if (!(node > 0.0 && node < 1.0))
            continue;
        for (n++; all[at - 1].s > node; at--)
            all[at] = all[at - 1];
        all[at] =
            gap_function(run, step, i, node, sign * stage_value(event_functions, k), stage_value(rates, k), per_c);
    }
    all[n++] = gap_function(run, step, i, 1.0, end->delta, end->deltadot, per_c);
    return n;
}

/*
 * Return by how much the dense output may differ from the stages in the middle of a step, m. It is exact at both ends.
 */
static double error_of_dense(const Integrator *run, int i, const Parameters *p)
{
    return DENSE_ERROR * tolerance_of(run) * radial_clearance(p, i);
}

/*
 * Return whether event function i is so far from zero at beginning, stages and end that its observed rates cannot reach
 * zero between them.
 */
static int is_far_from_zero(const Integrator *run, const Step *step, int i, const Parameters *p)
{
    const double a = run->rhs.clearance[i].deltadot, b = step->rhs.clearance[i].deltadot;
    const double slowest = min_of(step->rate[i][0], min_of(a, b)), fastest = max_of(step->rate[i][1], max_of(a, b));
    const double begin = event_function(&run->discrete, &run->rhs, i),
                 end = event_function(&run->discrete, &step->rhs, i);
    const double nearest = min_of(step->lowest[i], min_of(begin, end));
    return nearest - WIDEST * step->h * (fastest - slowest) * BEND_SAFETY / 2.0 > error_of_dense(run, i, p);
}

/*
 * Return whether a function with |f''| <= B (bend) is at least `least` between neighbouring samples a and b, w apart.
 * It is at least min(f_a, f_b) - B w^2/8. It is also at least max(f_a + f'_a x - B x^2/2, f_b - f'_b (w - x) - B (w -
 * x)^2/2), which is least where both parabolas meet.
 */
static int is_above_parabolas(Sample a, Sample b, double bend, double least)
{
    const double w = b.s - a.s, curve = bend * w;
    if (min_of(a.f, b.f) - 0.125 * curve * w >= least)
        return 1;
    const double x = (a.f - b.f + (b.slope + 0.5 * curve) * w) / (b.slope - a.slope + curve);
    return x >= 0.0 && x <= w && a.f + x * (a.slope - 0.5 * bend * x) >= least;
}

/*
 * Classify event function i in a step by its stages: CLEAR, FALLS or UNKNOWN. below: the node of the first stage at
 * which it is negative by more than the error of the dense output, else the end.
 */
static int bound_by_stages(const Integrator *run, const Step *step, int i, const Parameters *p, double *below)
{
    Sample all[N_STAGES + 2];
    const int n = event_function_at_stages(run, step, i, p, all);
    const double least = penetration_rounding(p, i), error = 16.0 * error_of_dense(run, i, p);
    double bend = 0.0;
    int falls = 0, first = 1;
    while (first < n - 1 && all[first].f >= -error)
        first++;
    *below = all[first].s;
    if (!(all[0].f >= least))
        return UNKNOWN;
    for (int k = 1; k < n; k++) {
        const double w = all[k].s - all[k - 1].s, change = fabs(all[k].slope - all[k - 1].slope);
        if (change > bend * w)
            bend = change / w;
    }
    bend *= BEND_SAFETY;
    for (int k = 1; k < n; k++) {
        const Sample a = all[k - 1], b = all[k];
        const double s = b.s < 0.5 ? b.s : a.s > 0.5 ? a.s : 0.5, deviation = error * s * s * (1.0 - s) * (1.0 - s);
        if (!falls && b.f >= 0.0 && is_above_parabolas(a, b, bend, least + deviation))
            continue;
        if (!(0.5 * (a.slope + b.slope + bend * (b.s - a.s)) + 0.2 * error < 0.0))
            return UNKNOWN;
        falls = 1;
    }
    return falls && all[n - 1].f < 0.0 ? FALLS : CLEAR;
}

/* Return the minimum of f + u (r + u (c + u d)) for u from 0 to 1/2. */
static double least_of_cubic(double f, double r, double c, double d)
{
    const double root = sqrt(max_of(0.0, c * c - 3.0 * d * r)), u = c > 0.0 ? -r / (c + root) : (root - c) / (3.0 * d);
    const double least = min_of(f, f + 0.5 * (r + 0.5 * (c + 0.5 * d)));
    return u > 0.0 && u < 0.5 ? min_of(least, f + u * (r + u * (c + u * d))) : least;
}

/*
 * Classify an event function between samples a and b: CLEAR, FALLS or UNKNOWN. It differs from their cubic by 16 error
 * u^2 (1 - u)^2 at most, as the error of Hermite's cubic does, and its rate by 3.1 error.
 */
static int bound_by_cubic(Sample a, Sample b, double error, double least)
{
    const double w = b.s - a.s, r = w * a.slope, r_end = w * b.slope, rise = b.f - a.f;
    const double c = 3.0 * rise - 2.0 * r - r_end, d = r + r_end - 2.0 * rise, deviation = 16.0 * error;
    const int ends = b.f >= (b.s < 1.0 || b.slope > 0.0 ? least : 0.0);
    if (ends && least_of_cubic(a.f, r, c - deviation, d) >= least
        && least_of_cubic(b.f, -r_end, c + 3.0 * d - deviation, -d) >= least)
        return CLEAR;
    double steepest = max_of(r, r_end);
    if (d < 0.0 && c > 0.0 && c < -3.0 * d)
        steepest = max_of(steepest, r - c * c / (3.0 * d));
    if (!(steepest + 3.1 * error < 0.0))
        return UNKNOWN;
    return ends ? CLEAR : FALLS;
}

/*
 * Return the error of the cubic of a and b at the middle sample: that of its value plus an eighth of that of its rate.
 * It is the allowed error of both halves.
 */
static double error_of_cubic(Sample a, Sample middle, Sample b)
{
    const double w = b.s - a.s;
    const double value = 0.5 * (a.f + b.f) + 0.125 * w * (a.slope - b.slope);
    const double slope = 1.5 * (b.f - a.f) - 0.25 * w * (a.slope + b.slope);
    return fabs(middle.f - value) + 0.125 * fabs(w * middle.slope - slope);
}

/*
 * Find the first zero of event function k on the dense output, by bisection. Return FALLS with the bracket low, high,
 * or CLEAR up to a fraction `until` of the step. below: where it is probably negative; the first part ends there if
 * that is within the first half of the step.
 */
static int first_zero(
    Integrator *run, const Step *step, int k, const Parameters *p, double until, double below, Sample *low,
    Sample *high)
{
    const double least = penetration_rounding(p, k), close = 4.0 * event_time_tolerance(run, step);
    PartOfStep part[MAX_BISECTIONS + 1] = {{bracket_end(run, step, k), INFINITY}};
    Sample from = bracket_begin(run, step, k);
    const Sample early = min_of(below, until) <= 0.5 ? gap_point_at(run, step, min_of(below, until), k, p)
        : (Sample){0.0, NAN, NAN};
    int n = 1;
    if (isfinite(early.f))
        part[n++] = (PartOfStep){early, INFINITY};
    for (int samples = 0; n > 0 && from.s < until;) {
        const PartOfStep now = part[n - 1];
        const double w = now.end.s - from.s;
        int found = from.f >= least ? bound_by_cubic(from, now.end, now.error, least) : FALLS;
        if (found == UNKNOWN) {
            const Sample middle = w > close && n <= MAX_BISECTIONS && samples++ < MAX_SAMPLES
                ? gap_point_at(run, step, from.s + 0.5 * w, k, p) : (Sample){0.0, NAN, NAN};
            if (isfinite(middle.f)) {
                const double error = w > 0.5 ? INFINITY : error_of_cubic(from, middle, now.end);
                part[n - 1].error = error;
                part[n] = (PartOfStep){middle, error};
                n++;
                continue;
            }
            found = now.end.f < (now.end.s < 1.0 ? least : 0.0) ? FALLS : CLEAR;
        }
        if (found == FALLS) {
            *low = from;
            *high = now.end;
            return FALLS;
        }
        from = now.end;
        n--;
    }
    return CLEAR;
}

/*
 * Return whether event function k of a joint with play has a zero in the step, and its bracket low, high. Zeros after
 * the fraction `until` may be omitted.
 */
static int has_zero(Integrator *run, Step *step, int k, const Parameters *p, double until, Sample *low, Sample *high)
{
    double below = 1.0;
    int found = is_far_from_zero(run, step, k, p) ? CLEAR : bound_by_stages(run, step, k, p, &below);
    *low = bracket_begin(run, step, k);
    *high = bracket_end(run, step, k);
    if (found == UNKNOWN)
        found = compute_dense_output(run, p, step) ? high->f < 0.0 ? FALLS : CLEAR
            : first_zero(run, step, k, p, until, below, low, high);
    if (low->f < 0.0 && low->f >= penetration_rounding(p, k) && low->slope > 0.0)
        low->f = 0.0; /* within rounding, and increasing */
    return found == FALLS;
}
