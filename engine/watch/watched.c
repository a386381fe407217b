/*
 * Corners of the user's expressions and user events along a step. The stages of a long step see next to nothing of a
 * function that swings or dips meanwhile; but the step's interpolant says between which bounds the state stays over
 * any part of it, so that the expressions have bounds there too (ranges.h). Parts over which one may be negative are
 * halved until it is monotone there, or clear of zero: no zero of the interpolant is missed, however many.
 */
/* A step's interpolant in powers of the share s, from which bounds follow, its place in time. */
typedef struct {
    double power[N_DENSE + 1][2 * N_X + 1], t, h;
    int degree;
} Course;

/*
 * Values of watched functions that are below their uncertainty (run/uncertainty.c) mean nothing, as of a velocity that
 * something holds at zero: a step is not ended by their signs, nor searched for them.
 *
 * How large margins are that mean nothing, at whichever end of a step that is less: by rounding, and by the tolerance
 * of an error of the state. They are found once they are asked for.
 */
typedef struct {
    int known;
    double rounding[N_WATCHED], tolerance[N_WATCHED], lowest[N_WATCHED]; /* its lower bound over the whole step */
} Noise;

static void estimate_uncertainties(Integrator *run, const Step *step, Noise *noise, const Parameters *p)
{
    double error[2 * N_X + 1], at_end[N_WATCHED];
    if (noise->known)
        return;
    noise->known = 1;
    for (int k = 0; k < 2 * N_X; k++)
        error[k] = 1.0 / run->norm.weight[k];
    uncertainty(run, step->t, run->y, p, noise->rounding);
    error_of_watched(run, step->t, run->y, error, p, noise->tolerance);
    uncertainty(run, step->t + step->h, step->y, p, at_end);
    for (int i = 0; i < N_WATCHED; i++)
        noise->rounding[i] = min_of(noise->rounding[i], at_end[i]);
    error_of_watched(run, step->t + step->h, step->y, error, p, at_end);
    for (int i = 0; i < N_WATCHED; i++)
        noise->tolerance[i] = min_of(noise->tolerance[i], at_end[i]);
}

/* The state at share s of a step, on the constraints; that at its begin where the time alone is read. */
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

/* Whether margin i, of this value at share s of a step, is below its uncertainty there. */
static int is_below_uncertainty(Integrator *run, const Step *step, double s, int i, double value, const Parameters *p)
{
    double y[N_Y], error[N_WATCHED];
    watched_state(run, step, s, p, y);
    uncertainty(run, step->t + s * step->h, y, p, error);
    return fabs(value) <= error[i];
}

/*
 * Whether a margin is taken as zero over a part: it is no larger than rounding at both ends, and its bounds are within
 * what the tolerance allows; or they are so wide because they do not know how its terms depend on each other, and
 * become narrower with the part, as those of a function do that hides nothing in it.
 */
static int is_held_at_zero(const Noise *noise, int i, Range f, double at_a, double at_b, double width)
{
    return fabs(at_a) <= noise->rounding[i] && fabs(at_b) <= noise->rounding[i] && !f.partly
        && (f.lo >= -noise->tolerance[i] || is_narrowing(f.lo, width, noise->lowest[i]));
}

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
/* y0 + s (d0 + (1 - s) (d1 + s (d2 + ...))), as all methods write it, multiplied out. */
static void course_of(const Integrator *run, const Step *step, Course *course)
{
    const int degree = step->method->degree;
    course->t = step->t, course->h = step->h, course->degree = degree;
    for (int i = 0; i < 2 * N_X; i++) {
        double c[N_DENSE + 1] = {step->dense[degree - 1][i]};
        for (int k = degree - 1; k >= 0; k--) {
            const int turned = step->method->turned >> k & 1; /* times 1 - s instead of s */
            for (int j = degree - k; j > 0; j--)
                c[j] = turned ? c[j] - c[j - 1] : c[j - 1];
            c[0] = (turned ? c[0] : 0.0) + (k > 0 ? step->dense[k - 1][i] : run->y[i]);
        }
        for (int j = 0; j <= degree; j++)
            course->power[j][i] = c[j];
    }
}

/* The state over shares a to b: the polynomial about the middle, each power by its own bounds. */
static void state_over(const Course *course, double a, double b, Range *y)
{
    const double middle = 0.5 * (a + b), reach = 0.5 * (b - a);
    for (int i = 0; i < 2 * N_X; i++) {
        double c[N_DENSE + 1], lo = 0.0, hi = 0.0, slope = 0.0, power = 1.0;
        for (int j = 0; j <= course->degree; j++)
            c[j] = course->power[j][i];
        for (int k = 0; k < course->degree; k++)
            for (int j = course->degree - 1; j >= k; j--)
                c[j] += middle * c[j + 1];
        for (int j = 1; j <= course->degree; j++) {
            slope += j > 1 ? j * fabs(c[j]) * power : 0.0;
            power *= reach;
            lo += power * (j % 2 ? -fabs(c[j]) : min_of(c[j], 0.0));
            hi += power * (j % 2 ? fabs(c[j]) : max_of(c[j], 0.0));
        }
        y[i] = (Range){c[0] + lo, c[0] + hi, c[1] - slope, c[1] + slope, 0};
    }
}

#endif
/* All margins over ranges of time and state. */
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

/* All margins over shares a to b of the step. */
static void event_function_ranges(
    const Integrator *run, const Course *course, double a, double b, const Parameters *p, Range *out)
{
    const Range t = {course->t + a * course->h, course->t + b * course->h, course->h, course->h, 0};
    Range y[2 * N_X + 1] = { {0} };
#if WATCHES_STATE
    state_over(course, a, b, y);
#endif
    event_functions_of_ranges(run, t, y, p, out);
}

/* The search along a step: its interpolant, all margins at the begin of the part that is judged. */
typedef struct {
    Integrator *run;
    Step *step;
    const Parameters *p;
    Course course;
    double at_a[N_WATCHED];
    Noise noise;
} WatchedStep;

/* zero_verdict of margin i over a part up to b; at_b is set to 0 where it means nothing. */
static int classify_event_function(WatchedStep *of, int i, Range f, double b, double width, int small, double *at_b)
{
    const int event = watched[i] - N_CLEARANCES - N_SWITCHES - N_FRICTIONS;
    int result = zero_verdict(f, of->at_a[i], *at_b, width, small);
    if (width == 1.0)
        of->noise.lowest[i] = f.lo;
    if (result > 0 && is_below_uncertainty(of->run, of->step, b, i, *at_b, of->p)) {
        *at_b = 0.0;
        result = zero_verdict(f, of->at_a[i], 0.0, width, small);
    }
    if (result < 0) {
        estimate_uncertainties(of->run, of->step, &of->noise, of->p);
        result = -!is_held_at_zero(&of->noise, i, f, of->at_a[i], *at_b, width);
    }
    return f.partly && !small && event >= 0 && !of->run->events.no_number[event] ? -1 : result;
}

/* Judges a part of a step by the bounds of all margins over it: 1 where the first zero of some is found. */
static int classify_event_functions(void *context, double a, double b, int small)
{
    WatchedStep *of = context;
    Integrator *run = of->run;
    Step *step = of->step;
    Range f[N_WATCHED];
    double at_b[N_WATCHED];
    int found = 0;
    event_functions_at(run, step, b, of->p, at_b);
    event_function_ranges(run, &of->course, a, b, of->p, f);
    for (int i = 0; i < N_WATCHED; i++) {
        const int event = watched[i] - N_CLEARANCES - N_SWITCHES - N_FRICTIONS;
        const int result = classify_event_function(of, i, f[i], b, b - a, small, &at_b[i]);
        if (result < 0)
            return -1;
        if (event >= 0 && isnan(at_b[i]))
            note_no_number(run, event, step->t + b * step->h);
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
/* Whether no margin may be below zero anywhere between the stages of an explicit step: most are done with this. */
static int is_clear(Integrator *run, const Step *step, Noise *noise, const Parameters *p)
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
        estimate_uncertainties(run, step, noise, p);
        if (!is_held_at_zero(noise, i, f[i], from, to, 1.0))
            return 0;
    }
    return 1;
}

#endif
/* The first zero of what is watched along an accepted step: `from` where it is not yet, `to` where it is over. */
static void search_step(Integrator *run, Step *step, const Parameters *p)
{
    WatchedStep of = {.run = run, .step = step, .p = p, .course = {.t = step->t, .h = step->h}};
    for (int i = 0; i < N_WATCHED; i++)
        step->from[i] = step->to[i] = 0.0;
#if WATCHES_STATE
    if ((!step->method->stiff && is_clear(run, step, &of.noise, p)) || make_dense(run, p, step))
        return;
    course_of(run, step, &of.course);
#endif
    event_functions_at(run, step, 0.0, p, of.at_a);
    (void)first_part(0.0, 1.0, 4.0 * event_time_tolerance(run, step), classify_event_functions, &of);
}

static int is_unresolved(const Integrator *run, const Step *step, const Parameters *p)
{
    (void)run, (void)step, (void)p;
    return 0;
}

/* Where watched margin i is below zero for the first time; 0: nowhere. */
static double first_negative_sample(const Integrator *run, const Step *step, int i, const Parameters *p, double *value)
{
    (void)run, (void)p;
    *value = step->below[i];
    return step->to[i];
}
