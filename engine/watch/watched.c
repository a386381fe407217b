/*
 * Switching points of the user's expressions and user events along a step, for scenes in which they have bounds. Stages
 * of a long step may miss an oscillation of such a function. Bounds of the dense output over any part of it give bounds
 * of the functions (ranges.h). Parts over which a function may be negative are bisected until it is monotone or clear
 * of zero. No zero of the dense output is missed.
 */
/* The dense output of a step in powers of the fraction s, for its bounds; begin t and length h of the step, s. */
typedef struct {
    double power[N_DENSE + 1][2 * N_X + 1], t, h;
    int degree;
} DensePolynomial;

/*
 * Uncertainties of the watched event functions in a step (run/uncertainty.c): by rounding, and by an error of one
 * tolerance of the state, each at the end of the step where it is less. They are computed on first use. Smaller values,
 * as of a velocity that a constraint holds at zero, neither end a step nor start a search.
 */
typedef struct {
    int known;
    double rounding[N_WATCHED], tolerance[N_WATCHED];
    double whole_lower[N_WATCHED]; /* lower bound of the function over the whole step */
} EventUncertainties;

/* Compute the uncertainties of all watched functions in a step, unless they are known. */
static void estimate_uncertainties(
    Integrator *run, const Step *step, EventUncertainties *uncertain, const Parameters *p)
{
    double error[2 * N_X + 1], at_end[N_WATCHED];
    if (uncertain->known)
        return;
    uncertain->known = 1;
    for (int k = 0; k < 2 * N_X; k++)
        error[k] = 1.0 / run->norm.weight[k];
    uncertainty(run, step->t, run->y, p, uncertain->rounding);
    error_of_watched(run, step->t, run->y, error, p, uncertain->tolerance);
    uncertainty(run, step->t + step->h, step->y, p, at_end);
    for (int i = 0; i < N_WATCHED; i++)
        uncertain->rounding[i] = min_of(uncertain->rounding[i], at_end[i]);
    error_of_watched(run, step->t + step->h, step->y, error, p, at_end);
    for (int i = 0; i < N_WATCHED; i++)
        uncertain->tolerance[i] = min_of(uncertain->tolerance[i], at_end[i]);
}

/*
 * Compute the projected state y at fraction s of a step. If watched functions depend on time alone, y is that at the
 * beginning.
 */
static void watched_state(Integrator *run, const Step *step, double s, const Parameters *p, double *y)
{
    memcpy(y, s < 1.0 ? run->y : step->y, N_Y * sizeof *y);
#if WATCHES_STATE
    if (s > 0.0 && s < 1.0) {
        interpolate(run, step, s, y);
        project_state(run, step->t + s * step->h, y, p);
    }
#else
    (void)p;
#endif
}

/* Return whether the value of watched function i at fraction s of a step is below its uncertainty there. */
static int is_below_uncertainty(Integrator *run, const Step *step, double s, int i, double value, const Parameters *p)
{
    double y[N_Y], error[N_WATCHED];
    watched_state(run, step, s, p, y);
    uncertainty(run, step->t + s * step->h, y, p, error);
    return fabs(value) <= error[i];
}

/*
 * Return whether watched function i is zero within its uncertainty over a part of length `width`. Both ends are within
 * rounding, and its bounds f are within the tolerance, or narrow with the part because interval arithmetic
 * overestimates them.
 */
static int is_held_at_zero(const EventUncertainties *uncertain, int i, Range f, double at_a, double at_b, double width)
{
    return fabs(at_a) <= uncertain->rounding[i] && fabs(at_b) <= uncertain->rounding[i] && !f.partly
        && (f.lo >= -uncertain->tolerance[i] || is_narrowing(f.lo, width, uncertain->whole_lower[i]));
}

/* Evaluate all watched event functions at fraction s of a step: out[N_WATCHED]. */
static void event_functions_at(Integrator *run, const Step *step, double s, const Parameters *p, double *out)
{
    RhsOutputs rhs = s < 1.0 ? run->rhs : step->rhs;
    if (s > 0.0 && s < 1.0) {
        double y[N_Y];
        watched_state(run, step, s, p, y);
        watched_functions(step->t + s * step->h, y, y + N_X, &run->discrete, p, &rhs);
    }
    for (int i = 0; i < N_WATCHED; i++)
        out[i] = event_function(&run->discrete, &rhs, watched[i]);
}

#if WATCHES_STATE
/* Expand the dense output y0 + s (d0 + (1 - s) (d1 + s (d2 + ...))), the form of all methods, into powers of s. */
static void expand_dense_output(const Integrator *run, const Step *step, DensePolynomial *powers)
{
    const int degree = step->method->degree;
    powers->t = step->t, powers->h = step->h, powers->degree = degree;
    for (int i = 0; i < 2 * N_X; i++) {
        double c[N_DENSE + 1] = {step->dense[degree - 1][i]};
        for (int k = degree - 1; k >= 0; k--) {
            const int turned = step->method->turned >> k & 1; /* times 1 - s instead of s */
            for (int j = degree - k; j > 0; j--)
                c[j] = turned ? c[j] - c[j - 1] : c[j - 1];
            c[0] = (turned ? c[0] : 0.0) + (k > 0 ? step->dense[k - 1][i] : run->y[i]);
        }
        for (int j = 0; j <= degree; j++)
            powers->power[j][i] = c[j];
    }
}

/*
 * Compute bounds y of the state over fractions a to b of a step: the polynomial about the middle, each power by its own
 * bounds.
 */
static void bound_state(const DensePolynomial *powers, double a, double b, Range *y)
{
    const double middle = 0.5 * (a + b), reach = 0.5 * (b - a);
    for (int i = 0; i < 2 * N_X; i++) {
        double c[N_DENSE + 1], lo = 0.0, hi = 0.0, slope = 0.0, power = 1.0;
        for (int j = 0; j <= powers->degree; j++)
            c[j] = powers->power[j][i];
        for (int k = 0; k < powers->degree; k++)
            for (int j = powers->degree - 1; j >= k; j--)
                c[j] += middle * c[j + 1];
        for (int j = 1; j <= powers->degree; j++) {
            slope += j > 1 ? j * fabs(c[j]) * power : 0.0;
            power *= reach;
            lo += power * (j % 2 ? -fabs(c[j]) : min_of(c[j], 0.0));
            hi += power * (j % 2 ? fabs(c[j]) : max_of(c[j], 0.0));
        }
        y[i] = (Range){c[0] + lo, c[0] + hi, c[1] - slope, c[1] + slope, 0};
    }
}

#endif
/* Compute bounds of all watched event functions from bounds of time and state: out[N_WATCHED]. */
static void event_functions_of_ranges(const Integrator *run, Range t, const Range *y, const Parameters *p, Range *out)
{
    watched_ranges(t, y, y + N_X, &run->discrete, p, out);
    for (int i = 0; i < N_WATCHED; i++) {
        const int k = watched[i] - N_CLEARANCES;
        const double branch =
            k < N_SWITCHES ? run->discrete.branch[k] : run->discrete.event_sign[k - N_SWITCHES - N_FRICTIONS];
        out[i] = range_times(only(branch), out[i]);
    }
}

/* Compute bounds of all watched event functions over fractions a to b of the step. */
static void event_function_ranges(
    const Integrator *run, const DensePolynomial *powers, double a, double b, const Parameters *p, Range *out)
{
    const Range t = {
        powers->t + a * powers->h, powers->t + b * powers->h, powers->h, powers->h, 0};
    Range y[2 * N_X + 1] = { {0} };
#if WATCHES_STATE
    bound_state(powers, a, b, y);
#endif
    event_functions_of_ranges(run, t, y, p, out);
}

/* The search along a step: its dense output, and all event functions at the beginning of the current part. */
typedef struct {
    Integrator *run;
    Step *step;
    const Parameters *p;
    DensePolynomial powers;
    double at_a[N_WATCHED];
    EventUncertainties uncertain;
} WatchedStep;

/*
 * Return zero_verdict() of watched function i over a part up to b. at_b: its value there, set to 0 if it is below its
 * uncertainty.
 */
static int classify_event_function(WatchedStep *of, int i, Range f, double b, double width, int small, double *at_b)
{
    const int event = watched[i] - N_CLEARANCES - N_SWITCHES - N_FRICTIONS;
    int result = zero_verdict(f, of->at_a[i], *at_b, width, small);
    if (width == 1.0)
        of->uncertain.whole_lower[i] = f.lo;
    if (result > 0 && is_below_uncertainty(of->run, of->step, b, i, *at_b, of->p)) {
        *at_b = 0.0;
        result = zero_verdict(f, of->at_a[i], 0.0, width, small);
    }
    if (result < 0) {
        estimate_uncertainties(of->run, of->step, &of->uncertain, of->p);
        result = -!is_held_at_zero(&of->uncertain, i, f, of->at_a[i], *at_b, width);
    }
    return f.partly && !small && event >= 0 && !of->run->events.no_number[event] ? -1 : result;
}

/* Classify a part of a step for halve_parts(): 1 if a watched function has its first zero in it, stored in the step. */
static int classify_event_functions(void *context, double a, double b, int small)
{
    WatchedStep *of = context;
    Integrator *run = of->run;
    Step *step = of->step;
    Range f[N_WATCHED];
    double at_b[N_WATCHED];
    int found = 0;
    event_functions_at(run, step, b, of->p, at_b);
    event_function_ranges(run, &of->powers, a, b, of->p, f);
    for (int i = 0; i < N_WATCHED; i++) {
        const int event = watched[i] - N_CLEARANCES - N_SWITCHES - N_FRICTIONS;
        const int result = classify_event_function(of, i, f[i], b, b - a, small, &at_b[i]);
        if (result < 0)
            return -1;
        if (event >= 0 && isnan(at_b[i]))
            record_nan_event(run, event, step->t + b * step->h);
        if (result) {
            step->from[i] = a;
            step->to[i] = b;
            step->above[i] =
                of->at_a[i] < 0.0 && is_below_uncertainty(run, step, a, i, of->at_a[i], of->p) ? 0.0 : of->at_a[i];
            step->below[i] = at_b[i];
            found = 1;
        }
    }
    if (!found)
        memcpy(of->at_a, at_b, sizeof at_b);
    return found;
}

#if WATCHES_STATE
/*
 * Return whether no watched function can be negative between the stages of an explicit step. Bounds of the state are
 * the range of the stages, extended by a quarter; they decide most steps.
 */
static int is_clear(Integrator *run, const Step *step, EventUncertainties *uncertain, const Parameters *p)
{
    Range f[N_WATCHED], y[2 * N_X + 1] = { {0} };
    const Range t = {step->t, step->t + step->h, -INFINITY, INFINITY, 0};
    for (int k = 0; k < 2 * N_X; k++) {
        const double least = min_of(step->least[k], min_of(run->y[k], step->y[k]));
        const double most = max_of(step->most[k], max_of(run->y[k], step->y[k])), beyond = 0.25 * (most - least);
        y[k] = (Range){least - beyond, most + beyond, -INFINITY, INFINITY, 0};
    }
    event_functions_of_ranges(run, t, y, p, f);
    for (int i = 0; i < N_WATCHED; i++) {
        const double from = event_function(&run->discrete, &run->rhs, watched[i]);
        const double to = event_function(&run->discrete, &step->rhs, watched[i]);
        if (f[i].lo >= 0.0 && !f[i].partly && !(to < 0.0))
            continue;
        estimate_uncertainties(run, step, uncertain, p);
        if (!is_held_at_zero(uncertain, i, f[i], from, to, 1.0))
            return 0;
    }
    return 1;
}

#endif
/* Find the first zero of the watched functions along an accepted step. step->from and step->to enclose it; 0: none. */
static void search_step(Integrator *run, Step *step, const Parameters *p)
{
    WatchedStep of = {.run = run, .step = step, .p = p, .powers = {.t = step->t, .h = step->h}};
    for (int i = 0; i < N_WATCHED; i++)
        step->from[i] = step->to[i] = 0.0;
#if WATCHES_STATE
    if ((!step->method->stiff && is_clear(run, step, &of.uncertain, p)) || compute_dense_output(run, p, step))
        return;
    expand_dense_output(run, step, &of.powers);
#endif
    event_functions_at(run, step, 0.0, p, of.at_a);
    (void)halve_parts(0.0, 1.0, 4.0 * event_time_tolerance(run, step), classify_event_functions, &of);
}

/* Return 0: bounds resolve every step. */
static int is_unresolved(const Integrator *run, const Step *step, const Parameters *p)
{
    (void)run, (void)step, (void)p;
    return 0;
}

/* Return the fraction at which watched function i is first negative, and its value; 0: nowhere. */
static double first_negative_sample(const Integrator *run, const Step *step, int i, const Parameters *p, double *value)
{
    (void)run, (void)p;
    *value = step->below[i];
    return step->to[i];
}
