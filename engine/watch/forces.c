/*
 * Friction that may stick and rigid contacts along a step. This file finds the first zero of three kinds of event
 * functions: the reserve of a sticking force, a sliding velocity, the force of a closed contact.
 *
 * They follow from the right-hand side and have no bounds, and they may change within a step whose motion is at rest.
 * The dense output is sampled and bisected. On each part the event function is the parabola through both ends and the
 * middle within an error. It is ERROR_SAFETY times the largest by which the parabola of the whole part missed the
 * samples of its halves, and at least a fourth of the whole part's error. In theory the halves have an eighth of it.
 */
enum { MAX_FORCE_SAMPLES = 20000, MIN_STAGES = 8 /* of a step that bound a force between them */ };
#define ERROR_SAFETY 4.0
#define COARSE 0.25 /* of a step: longer parts do not show the error of a parabola */
#define MAX_TERM_EXCESS 0.05 /* of the range of a time term over a step: allowed excess over a parabola */
#define FORCE_ROUNDING 1e-12 /* of the largest sample: negative values by rounding */

/* A part of a step: the samples at its middle and end, and the error of the parabola through them. */
typedef struct {
    Sample middle, end;
    double error;
} Sampled;

/*
 * Return whether event function k belongs to this file: that of a closed rigid contact, or of friction that no other
 * friction holds.
 */
static int is_contact_force_function(const Integrator *run, int k)
{
    const int friction = k - N_CLEARANCES - N_SWITCHES;
    if (k < N_CLEARANCES)
        return !gives(k) && run->discrete.contact[k].closed;
    return friction >= 0 && friction < N_FRICTIONS && run->discrete.mode[friction] != MODE_HELD;
}

#if N_FRICTIONS
/* Return the error of slip velocity i that the tolerances of the velocities allow, m/s. */
static double slip_tolerance(Integrator *run, int i, const Parameters *p)
{
    double y[N_Y], dy[N_Y], sum = 0.0;
    RhsOutputs rhs;
    for (int k = N_X; k < 2 * N_X; k++) {
        memcpy(y, run->y, sizeof y);
        y[k] += 1.0 / run->norm.weight[k];
        if (!rates(run, run->t, y, p, dy, &rhs))
            sum += fabs(rhs.friction[i].v - run->rhs.friction[i].v);
    }
    return isfinite(sum) ? sum : 0.0;
}
#endif

/*
 * Return how far event function k may be below zero at the beginning of a step without an event. For a slip velocity
 * that leaves rest it is the rounding or the error of the step, m/s; otherwise 0.
 */
static double rounding_of_velocity(Integrator *run, int k, const Parameters *p)
{
#if N_FRICTIONS
    const int i = k - N_CLEARANCES - N_SWITCHES;
    const double mode = i >= 0 ? run->discrete.mode[i] : 0.0, v = i >= 0 ? run->rhs.friction[i].v : 0.0;
    if (mode != 0.0 && fabs(v) <= AT_REST && mode * run->rhs.friction[i].rate > 0.0)
        return max_of(AT_REST, slip_tolerance(run, i, p));
#endif
    return (void)run, (void)k, (void)p, 0.0;
}

/*
 * Collect a value at the beginning of a step, at its stages in the order of their nodes, and at its end. Returns the
 * number of samples in `all`, at most N_STAGES + 2.
 */
static int values_of_stages(const Step *step, Sample begin, Sample end, StageValues seen, Sample *all)
{
    int n = 1;
    all[0] = begin;
    for (int i = 0; i < step->n_seen; i++) {
        int at = n;
        if (!(step->node[i] > 0.0 && step->node[i] < 1.0))
            continue;
        for (n++; all[at - 1].s > step->node[i]; at--)
            all[at] = all[at - 1];
        all[at] = (Sample){step->node[i], stage_value(seen, i), NAN};
    }
    all[n++] = end;
    return n;
}

#if N_TERMS
/*
 * Return whether a term of time alone may oscillate between samples at both ends and the middle of a part. By its
 * bounds, it may then leave the parabola through them by more than MAX_TERM_EXCESS of its range.
 */
static int may_oscillate_between(Step *step, double a, double b, const Parameters *p)
{
    Range f[N_TERMS], low[N_TERMS], middle[N_TERMS], high[N_TERMS];
    const double w = b - a;
    if (step->spread[0] < 0.0) {
        terms_over(step->t, step->h, 0.0, 1.0, p, f);
        for (int k = 0; k < N_TERMS; k++)
            step->spread[k] = f[k].hi - f[k].lo;
    }
    terms_over(step->t, step->h, a, b, p, f);
    terms_over(step->t, step->h, a, a, p, low);
    terms_over(step->t, step->h, a + 0.5 * w, a + 0.5 * w, p, middle);
    terms_over(step->t, step->h, b, b, p, high);
    for (int k = 0; k < N_TERMS; k++) {
        const double slope = high[k].lo - low[k].lo, bend = fabs(low[k].lo - 2.0 * middle[k].lo + high[k].lo);
        const double beyond = max_of(w * f[k].up - slope, slope - w * f[k].down) - 2.0 * bend;
        if (!(beyond <= MAX_TERM_EXCESS * step->spread[k]))
            return 1;
    }
    return 0;
}
#else
/* Return 0: the scene has no terms of time alone. */
static int may_oscillate_between(Step *step, double a, double b, const Parameters *p)
{
    return (void)step, (void)a, (void)b, (void)p, 0;
}
#endif

/* Return whether a term of time alone may oscillate between neighbouring samples of the stages. */
static int may_oscillate_between_stages(Step *step, const Sample *all, int n, const Parameters *p)
{
    if (step->swings < 0) {
        step->swings = may_oscillate_between(step, 0.0, 1.0, p);
        for (int i = 1, is_tested = step->swings; i < n && is_tested; i++) {
            step->swings = may_oscillate_between(step, all[i - 1].s, all[i].s, p);
            is_tested = !step->swings;
        }
    }
    return step->swings;
}

/*
 * Return a bound of the second derivative through n samples: BEND_SAFETY times the largest second difference quotient.
 */
static double max_second_derivative(const Sample *all, int n)
{
    double bend = 0.0;
    for (int i = 1; i + 1 < n; i++) {
        const double left = (all[i].f - all[i - 1].f) / (all[i].s - all[i - 1].s);
        const double right = (all[i + 1].f - all[i].f) / (all[i + 1].s - all[i].s);
        bend = max_of(bend, 2.0 * BEND_SAFETY * fabs(right - left) / (all[i + 1].s - all[i - 1].s));
    }
    return bend;
}

/*
 * Return whether the stages of a step show that event function k has no zero. Between neighbours a and b it is at least
 * min(f_a, f_b) - B w^2/8, where B bounds its second derivative, and at least the smaller one where it is monotone.
 * Values above -rest are not negative, until the function exceeds `rest`.
 */
static int is_clear_of_zero(const Integrator *run, Step *step, int k, double rest, const Parameters *p)
{
    Sample all[N_STAGES + 2];
    const int n =
        values_of_stages(step, bracket_begin(run, step, k), bracket_end(run, step, k), stage_values(step, k), all);
    const int friction = k - N_CLEARANCES - N_SWITCHES;
    double least = INFINITY, most = -INFINITY;
    for (int i = 0; i < n; i++) {
        least = min_of(least, all[i].f);
        most = max_of(most, all[i].f);
    }
    if (step->method->stiff || n < MIN_STAGES) /* inaccurate or distant stages: for velocities only */
        return friction >= 0 && friction < N_FRICTIONS && run->discrete.mode[friction] != 0.0 && least > most - least;
    const double bend = max_second_derivative(all, n);
    for (int i = 1; i < n; i++) {
        const double w = all[i].s - all[i - 1].s, curve = bend * w * w;
        const int monotone = fabs(all[i].f - all[i - 1].f) > 0.5 * curve;
        rest = all[i - 1].f > rest ? 0.0 : rest;
        if (!(min_of(all[i - 1].f, all[i].f) - (monotone ? 0.0 : 0.125 * curve) > -rest))
            return 0;
    }
    return (!(rest > 0.0) || all[n - 1].f >= -AT_REST) && !may_oscillate_between_stages(step, all, n, p);
}

/* Return the value at s of the parabola through both ends and the middle of a part. */
static double parabola_at(Sample a, Sample middle, Sample b, double s)
{
    const double u = 2.0 * (s - middle.s) / (b.s - a.s);
    return middle.f + 0.5 * u * (b.f - a.f + u * (a.f - 2.0 * middle.f + b.f));
}

/* Return the minimum of the parabola between both ends of a part, and its largest slope there, `steepest`. */
static double least_of_parabola(Sample a, Sample middle, Sample b, double *steepest)
{
    const double slope = 0.5 * (b.f - a.f), bend = a.f - 2.0 * middle.f + b.f, u = -slope / bend;
    const double least = min_of(a.f, min_of(middle.f, b.f));
    *steepest = 2.0 * (slope + fabs(bend)) / (b.s - a.s);
    return bend > 0.0 && fabs(u) < 1.0 ? min_of(least, middle.f + 0.5 * slope * u) : least;
}

/* Return the error of the parabolas of both halves of a part, from two new samples; infinite for long parts. */
static double error_of_halves(Sample from, Sampled now, Sample left, Sample right)
{
    const double missed = max_of(fabs(left.f - parabola_at(from, now.middle, now.end, left.s)),
        fabs(right.f - parabola_at(from, now.middle, now.end, right.s)));
    const double known = isfinite(now.error) ? 0.25 * now.error : 0.0;
    return now.end.s - from.s > COARSE ? INFINITY : max_of(known, ERROR_SAFETY * missed);
}

/* Return whether event function k has a zero in the step, and samples low, high that enclose the first one. */
static int has_force_zero(Integrator *run, Step *step, int k, const Parameters *p, Sample *low, Sample *high)
{
    const double close = 4.0 * event_time_tolerance(run, step);
    double rest = rounding_of_velocity(run, k, p);
    Sampled part[MAX_BISECTIONS + 1];
    Sample from = bracket_begin(run, step, k);
    double largest = fabs(from.f);
    if (is_clear_of_zero(run, step, k, rest, p) || compute_dense_output(run, p, step))
        return 0;
    part[0] = (Sampled){bracket_point_at(run, step, 0.5, k, p), bracket_end(run, step, k), INFINITY};
    for (int n = 1, samples = 1; n > 0;) {
        const Sampled now = part[n - 1];
        const double w = now.end.s - from.s;
        double steepest;
        rest = from.f > rest ? 0.0 : rest;
        const double least = least_of_parabola(from, now.middle, now.end, &steepest) - now.error;
        const int crosses = now.middle.f < -rest || now.end.f < -rest;
        const int small = w < close || n > MAX_BISECTIONS || samples > MAX_FORCE_SAMPLES;
        largest = max_of(largest, max_of(fabs(now.middle.f), fabs(now.end.f)));
        if (crosses && (small || steepest + 4.0 * now.error / w < 0.0)) {
            *low = from;
            *high = now.middle.f < -rest ? now.middle : now.end;
            return 1;
        }
        if (small
            || (least >= -rest - FORCE_ROUNDING * largest && !may_oscillate_between(step, from.s, now.end.s, p))) {
            from = now.end;
            n--;
            continue;
        }
        const Sample left = bracket_point_at(run, step, from.s + 0.25 * w, k, p);
        const Sample right = bracket_point_at(run, step, now.end.s - 0.25 * w, k, p);
        const double error = error_of_halves(from, now, left, right);
        part[n - 1] = (Sampled){right, now.end, error};
        part[n++] = (Sampled){left, now.middle, error};
        samples += 2;
    }
    *low = bracket_begin(run, step, k);
    *high = from; /* a velocity within its tolerance has reversed */
    return rest > 0.0 && from.f < -AT_REST;
}
