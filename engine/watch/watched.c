/*
 * Search for switching points and user events in a step by interval bounds, which miss no zero. Stages of a long step
 * may miss an oscillation of such a function. Bounds of the dense output over any part of it give bounds of the
 * functions (ranges.h). Parts over which a function may be negative are bisected until it is monotone or positive.
 * No zero of the dense output is missed.
 *
 * Monitored functions are the N_MONITORED event functions that this search monitors: switching functions and user
 * events; monitored_event[i] is the number of function i among all event functions. MONITORS_STATE: whether any of them
 * depends on more than time. The functions are evaluated at the projected dense output.
 */
/* The dense output of a step in powers of the fraction s, for its bounds; begin t and length h of the step, s. */
typedef struct {
    double power[N_DENSE + 1][2 * N_X + 1], t, h;
    int degree;
} DensePolynomial;

/*
 * Uncertainties of the monitored event functions in a step (run/uncertainty.c): by rounding, and by an error of one
 * tolerance of the state, each at the end of the step where it is less. They are computed on first use. Smaller values,
 * as of a velocity that a constraint holds at zero, neither end a step nor start a search.
 */
typedef struct {
    int is_known;
    double rounding[N_MONITORED], tolerance[N_MONITORED];
    double lower_bound_of_step[N_MONITORED]; /* lower bound of the function over the whole step */
} EventUncertainties;

/*
 * Compute the uncertainties of all monitored functions in a step, by rounding and by one error tolerance: the minimum
 * of those at both ends. Does nothing if they are known. Called if the bounds of a function do not decide.
 */
static void estimate_uncertainties(
    Integrator *run, const Step *step, EventUncertainties *uncertainties, const Parameters *p)
{
    double error[2 * N_X + 1], at_end[N_MONITORED];
    if (uncertainties->is_known)
        return;
    uncertainties->is_known = 1;
    for (int k = 0; k < 2 * N_X; k++)
        error[k] = 1.0 / run->norm.weight[k];
    estimate_rounding_uncertainty(run, step->t, run->y, p, uncertainties->rounding);
    estimate_monitored_function_errors(run, step->t, run->y, error, p, uncertainties->tolerance);
    estimate_rounding_uncertainty(run, step->t + step->h, step->y, p, at_end);
    for (int i = 0; i < N_MONITORED; i++)
        uncertainties->rounding[i] = min_of(uncertainties->rounding[i], at_end[i]);
    estimate_monitored_function_errors(run, step->t + step->h, step->y, error, p, at_end);
    for (int i = 0; i < N_MONITORED; i++)
        uncertainties->tolerance[i] = min_of(uncertainties->tolerance[i], at_end[i]);
}

/*
 * Compute the projected state y (N_Y) at a fraction of a step, from the dense output. At its ends the states are known.
 * If monitored functions depend on time alone, y is the state at the beginning or end instead.
 */
static void interpolate_projected_state(
    Integrator *run, const Step *step, double fraction, const Parameters *p, double *y)
{
    memcpy(y, fraction < 1.0 ? run->y : step->y, N_Y * sizeof *y);
#if MONITORS_STATE
    if (fraction > 0.0 && fraction < 1.0) {
        interpolate(run, step, fraction, y);
        project_state(run, step->t + fraction * step->h, y, p);
    }
#else
    (void)p;
#endif
}

/*
 * Return whether the magnitude of `value`, a monitored function at a fraction of a step, is at most its uncertainty
 * there. index: of the monitored function.
 */
static int is_below_uncertainty(Integrator *run, const Step *step, double fraction, int index, double value,
    const Parameters *p)
{
    double y[N_Y], error[N_MONITORED];
    interpolate_projected_state(run, step, fraction, p, y);
    estimate_rounding_uncertainty(run, step->t + fraction * step->h, y, p, error);
    return fabs(value) <= error[index];
}

/*
 * Return whether a monitored function is zero within its uncertainty over a part of length `width`, as if a constraint
 * kept it at zero. Its values at both ends are within the rounding uncertainty. Its lower bound is within the
 * uncertainty by the tolerance, or narrows with the part because interval arithmetic overestimates it. Return 0 if the
 * function may be undefined in the part.
 */
static int is_zero_within_uncertainty(const EventUncertainties *uncertainties, int index, Interval bounds,
    double value_begin, double value_end, double width)
{
    return fabs(value_begin) <= uncertainties->rounding[index] && fabs(value_end) <= uncertainties->rounding[index]
        && !bounds.may_be_undefined
        && (bounds.lo >= -uncertainties->tolerance[index]
            || is_bound_narrowing(bounds.lo, width, uncertainties->lower_bound_of_step[index]));
}

/*
 * Evaluate all monitored event functions at a fraction of a step: values (N_MONITORED), multiplied by branch or sign.
 * At the ends of the step the known outputs are used.
 */
static void evaluate_event_functions_at(Integrator *run, const Step *step, double fraction, const Parameters *p,
    double *values)
{
    RhsOutputs rhs = fraction < 1.0 ? run->rhs : step->rhs;
    if (fraction > 0.0 && fraction < 1.0) {
        double y[N_Y];
        interpolate_projected_state(run, step, fraction, p, y);
        monitored_functions(step->t + fraction * step->h, y, y + N_X, &run->discrete, p, &rhs);
    }
    for (int i = 0; i < N_MONITORED; i++)
        values[i] = compute_event_value(&run->discrete, &rhs, monitored_event[i]);
}

#if MONITORS_STATE
/*
 * Expand the dense output of a step into powers of the fraction s of the step, for coordinates and velocities. All
 * methods have the form y0 + s (d0 + (1 - s) (d1 + s (d2 + ...))). polynomial: coefficients, degree, time and length of
 * the step. Called once for each step that is searched.
 */
static void expand_dense_output(const Integrator *run, const Step *step, DensePolynomial *polynomial)
{
    const int degree = step->method->degree;
    polynomial->t = step->t, polynomial->h = step->h, polynomial->degree = degree;
    for (int i = 0; i < 2 * N_X; i++) {
        double c[N_DENSE + 1] = {step->dense[degree - 1][i]};
        for (int k = degree - 1; k >= 0; k--) {
            const int has_factor_one_minus_s = step->method->reversed >> k & 1; /* times 1 - s instead of s */
            for (int j = degree - k; j > 0; j--)
                c[j] = has_factor_one_minus_s ? c[j] - c[j - 1] : c[j - 1];
            c[0] = (has_factor_one_minus_s ? c[0] : 0.0) + (k > 0 ? step->dense[k - 1][i] : run->y[i]);
        }
        for (int j = 0; j <= degree; j++)
            polynomial->power[j][i] = c[j];
    }
}

/*
 * Compute bounds y (2 N_X) of coordinates and velocities, and of their derivatives with respect to the fraction s of
 * the step, over the fractions `begin` to `end` of a step. The polynomial is shifted to the middle of the part, and
 * each power is bounded by itself.
 */
static void bound_state(const DensePolynomial *polynomial, double begin, double end, Interval *y)
{
    const double middle = 0.5 * (begin + end), half_width = 0.5 * (end - begin);
    for (int i = 0; i < 2 * N_X; i++) {
        double c[N_DENSE + 1], lower = 0.0, upper = 0.0, slope = 0.0, power = 1.0;
        for (int j = 0; j <= polynomial->degree; j++)
            c[j] = polynomial->power[j][i];
        for (int k = 0; k < polynomial->degree; k++)
            for (int j = polynomial->degree - 1; j >= k; j--)
                c[j] += middle * c[j + 1];
        for (int j = 1; j <= polynomial->degree; j++) {
            slope += j > 1 ? j * fabs(c[j]) * power : 0.0;
            power *= half_width;
            lower += power * (j % 2 ? -fabs(c[j]) : min_of(c[j], 0.0));
            upper += power * (j % 2 ? fabs(c[j]) : max_of(c[j], 0.0));
        }
        y[i] = (Interval){c[0] + lower, c[0] + upper, c[1] - slope, c[1] + slope, 0};
    }
}

#endif
/*
 * Compute bounds (N_MONITORED) of all monitored event functions, and of their derivatives with respect to the fraction
 * s of the step, from such bounds of time t and of the state y. Each is multiplied by the frozen branch of its
 * switching function, or by the stored sign of its user event.
 */
static void bound_event_functions_over_box(const Integrator *run, Interval t, const Interval *y, const Parameters *p,
    Interval *bounds)
{
    bound_monitored_functions(t, y, y + N_X, &run->discrete, p, bounds);
    for (int i = 0; i < N_MONITORED; i++) {
        const int k = monitored_event[i] - N_CLEARANCES;
        const double branch =
            k < N_SWITCHES ? run->discrete.branch[k] : run->discrete.event_sign[k - N_SWITCHES - N_FRICTIONS];
        bounds[i] = interval_mul(make_interval(branch), bounds[i]);
    }
}

/*
 * Compute bounds (N_MONITORED) of all monitored event functions over the fractions `begin` to `end` of a step, from its
 * dense output. Called for each part that is bisected.
 */
static void bound_event_functions(
    const Integrator *run, const DensePolynomial *polynomial, double begin, double end, const Parameters *p,
    Interval *bounds)
{
    const Interval t = {
        polynomial->t + begin * polynomial->h, polynomial->t + end * polynomial->h, polynomial->h, polynomial->h, 0};
    Interval y[2 * N_X + 1] = { {0} };
#if MONITORS_STATE
    bound_state(polynomial, begin, end, y);
#endif
    bound_event_functions_over_box(run, t, y, p, bounds);
}

/* The search along a step: its dense output, and all event functions at the beginning of the current part. */
typedef struct {
    Integrator *run;
    Step *step;
    const Parameters *p;
    DensePolynomial powers;
    double values_begin[N_MONITORED];
    EventUncertainties uncertainties;
} MonitoredStep;

/*
 * Classify a monitored function over a part of a step as classify_zero() does: 1 a zero, 0 none, -1 to be halved.
 * index: of the function; bounds: over the part; end, width: fraction at the end of the part, and its length; is_small:
 * the part is not halved further, also if the function may be undefined in it. *value_end: in: the value at the end;
 * out: 0 if a zero was found but the value is below its rounding uncertainty. The part is then classified again with 0.
 *
 * A part that the bounds leave undecided has no zero if is_zero_within_uncertainty(), as for a function that
 * constraints keep at zero. A part over which a user-defined event may be undefined is halved until its NaN is
 * recorded. For the whole step (width 1) the lower bound is stored in search->uncertainties.
 */
static int classify_event_function(MonitoredStep *search, int index, Interval bounds, double end, double width,
    int is_small, double *value_end)
{
    const int event = monitored_event[index] - N_CLEARANCES - N_SWITCHES - N_FRICTIONS;
    int result = classify_zero(bounds, search->values_begin[index], *value_end, width, is_small);
    if (width == 1.0)
        search->uncertainties.lower_bound_of_step[index] = bounds.lo;
    if (result > 0 && is_below_uncertainty(search->run, search->step, end, index, *value_end, search->p)) {
        *value_end = 0.0;
        result = classify_zero(bounds, search->values_begin[index], 0.0, width, is_small);
    }
    if (result < 0) {
        estimate_uncertainties(search->run, search->step, &search->uncertainties, search->p);
        result = -!is_zero_within_uncertainty(
            &search->uncertainties, index, bounds, search->values_begin[index], *value_end, width);
    }
    const int may_become_nan = bounds.may_be_undefined && event >= 0 && !search->run->events.is_nan_reported[event];
    return may_become_nan && !is_small ? -1 : result;
}

/*
 * Classify the part [begin, end] of a step, as the callback of bisect_interval(): 1 if a monitored function has its
 * first zero in it, 0 if none has, -1 if the part is to be halved. A zero stores its bracket in the step. User-defined
 * events that are NaN at the end of the part are recorded. context: a MonitoredStep; is_small: the part is not halved
 * further.
 */
static int classify_event_functions(void *context, double begin, double end, int is_small)
{
    MonitoredStep *search = context;
    Integrator *run = search->run;
    Step *step = search->step;
    Interval bounds[N_MONITORED];
    double values_end[N_MONITORED];
    int has_zero = 0;
    evaluate_event_functions_at(run, step, end, search->p, values_end);
    bound_event_functions(run, &search->powers, begin, end, search->p, bounds);
    for (int i = 0; i < N_MONITORED; i++) {
        const int event = monitored_event[i] - N_CLEARANCES - N_SWITCHES - N_FRICTIONS;
        const int result = classify_event_function(search, i, bounds[i], end, end - begin, is_small, &values_end[i]);
        if (result < 0)
            return -1;
        if (event >= 0 && isnan(values_end[i]))
            record_nan_event(run, event, step->t + end * step->h);
        if (result) {
            step->bracket_begin[i] = begin;
            step->bracket_end[i] = end;
            step->value_at_begin[i] =
                search->values_begin[i] < 0.0
                        && is_below_uncertainty(run, step, begin, i, search->values_begin[i], search->p)
                    ? 0.0 : search->values_begin[i];
            step->value_at_end[i] = values_end[i];
            has_zero = 1;
        }
    }
    if (!has_zero)
        memcpy(search->values_begin, values_end, sizeof values_end);
    return has_zero;
}

#if MONITORS_STATE
/*
 * Return whether no monitored function can be negative between the stages of an explicit step. Bounds of the state are
 * the range of the stages, extended by a quarter; they decide most steps. A function that may be undefined in these
 * bounds or is negative at the end gives 0, unless it is zero within its uncertainty. uncertainties: computed
 * when first needed. Called by bracket_first_zeros() before the dense output is bounded.
 */
static int are_zeros_excluded_by_stages(Integrator *run, const Step *step, EventUncertainties *uncertainties,
    const Parameters *p)
{
    Interval bounds[N_MONITORED], y[2 * N_X + 1] = { {0} };
    const Interval t = {step->t, step->t + step->h, -INFINITY, INFINITY, 0};
    for (int k = 0; k < 2 * N_X; k++) {
        const double lower = min_of(step->min_state[k], min_of(run->y[k], step->y[k]));
        const double upper = max_of(step->max_state[k], max_of(run->y[k], step->y[k])), beyond = 0.25 * (upper - lower);
        y[k] = (Interval){lower - beyond, upper + beyond, -INFINITY, INFINITY, 0};
    }
    bound_event_functions_over_box(run, t, y, p, bounds);
    for (int i = 0; i < N_MONITORED; i++) {
        const double from = compute_event_value(&run->discrete, &run->rhs, monitored_event[i]);
        const double to = compute_event_value(&run->discrete, &step->rhs, monitored_event[i]);
        if (bounds[i].lo >= 0.0 && !bounds[i].may_be_undefined && !(to < 0.0))
            continue;
        estimate_uncertainties(run, step, uncertainties, p);
        if (!is_zero_within_uncertainty(uncertainties, i, bounds[i], from, to, 1.0))
            return 0;
    }
    return 1;
}

#endif
/*
 * Bracket the first zero of each monitored event function along a tried step: step->bracket_begin and step->bracket_end
 * enclose it; both 0: none. Also stores the values there, step->value_at_begin and step->value_at_end. If bounds by the
 * stages exclude zeros, or without dense output, nothing is searched. Called by find_first_event().
 */
static void bracket_first_zeros(Integrator *run, Step *step, const Parameters *p)
{
    MonitoredStep search = {.run = run, .step = step, .p = p, .powers = {.t = step->t, .h = step->h}};
    for (int i = 0; i < N_MONITORED; i++)
        step->bracket_begin[i] = step->bracket_end[i] = 0.0;
#if MONITORS_STATE
    if ((!step->method->stiff && are_zeros_excluded_by_stages(run, step, &search.uncertainties, p))
        || compute_dense_output(run, p, step))
        return;
    expand_dense_output(run, step, &search.powers);
#endif
    evaluate_event_functions_at(run, step, 0.0, p, search.values_begin);
    (void)bisect_interval(0.0, 1.0, 4.0 * compute_event_time_tolerance(run, step), classify_event_functions, &search);
}

/* Return 0, the step is resolved: bounds of the monitored functions resolve every step. */
static int is_step_unresolved(const Integrator *run, const Step *step, const Parameters *p)
{
    (void)run, (void)step, (void)p;
    return 0;
}

/*
 * Return the fraction of the step at which a monitored function is first negative, the bracket end step->bracket_end
 * that bracket_first_zeros() has found, and its value there in *value; 0: nowhere. index: of the monitored function.
 */
static double find_first_negative_sample(const Integrator *run, const Step *step, int index, const Parameters *p,
    double *value)
{
    (void)run, (void)p;
    *value = step->value_at_end[index];
    return step->bracket_end[index];
}
