/*
 * Corners of the user's expressions and user events along a step. The stages of a long step see next to nothing of a
 * function that swings or dips meanwhile; but the step's interpolant says between which bounds the state stays over
 * any part of it, so that the expressions have bounds there too (ranges.h). Parts over which one may be negative are
 * halved until it is monotone there, or clear of zero: no zero of the interpolant is missed, however many.
 */
enum { DEEPEST = 64, MAX_PARTS_SEEN = 2000 };

/* A step's interpolant in powers of the share s, from which bounds follow, its place in time. */
typedef struct {
    double power[N_DENSE + 1][2 * N_X + 1], t, h;
    int degree;
} Course;

/* A part of a step, and all margins at its begin. */
typedef struct {
    double a, b, at_a[N_WATCHED];
} Part;

/* What is watched, at one place. */
static void look_at(const Run *run, double t, const double *y, const Parameters *p, Aside *aside)
{
    watched_functions(t, y, y + N_X, &run->memory, p, aside);
}

#include "held_at_zero.c"

static void margins_at(Run *run, const Step *step, double s, const Parameters *p, double *out)
{
    Aside aside = s < 1.0 ? run->aside : step->aside;
    if (s > 0.0 && s < 1.0) {
        double y[N_Y];
        watched_state(run, step, s, p, y);
        look_at(run, step->t + s * step->h, y, p, &aside);
    }
    for (int i = 0; i < N_WATCHED; i++)
        out[i] = margin(&run->memory, &aside, watched[i]);
}

#if WATCHES_STATE
/* y0 + s (d0 + (1 - s) (d1 + s (d2 + ...))), as all methods write it, multiplied out. */
static void course_of(const Run *run, const Step *step, Course *course)
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
static void margins_of_ranges(const Run *run, Range t, const Range *y, const Parameters *p, Range *out)
{
    watched_ranges(t, y, y + N_X, &run->memory, p, out);
    for (int i = 0; i < N_WATCHED; i++) {
        const int k = watched[i] - N_CLEARANCES;
        const double side = k < N_SWITCHES ? run->memory.side[k] : run->memory.event_side[k - N_SWITCHES - N_FRICTIONS];
        out[i] = range_times(only(side), out[i]);
    }
}

/* All margins over shares a to b of the step. */
static void margins_over(const Run *run, const Course *course, double a, double b, const Parameters *p, Range *out)
{
    const Range t = {course->t + a * course->h, course->t + b * course->h, course->h, course->h, 0};
    Range y[2 * N_X + 1] = { {0} };
#if WATCHES_STATE
    state_over(course, a, b, y);
#endif
    margins_of_ranges(run, t, y, p, out);
}

/*
 * Whether a margin is below zero at the end of a part and not before (1), not at all (0), or not known so far (-1).
 * Bounds are rounded: what is computed at the end comes first.
 */
static int verdict(Range f, double at_a, double at_b, double width, int small)
{
    if (is_empty(f) || (f.lo >= 0.0 && !(at_b < 0.0)))
        return 0;
    if (small)
        return at_b < 0.0;
    if (f.partly)
        return -1;
    if (f.down >= 0.0 || f.up <= 0.0)
        return at_b < 0.0;
    /* the lowest that a function of these slopes between these ends may reach */
    const double lowest = at_a + f.down * (at_b - at_a - f.up * width) / (f.down - f.up);
    return at_a >= 0.0 && at_b >= 0.0 && lowest >= 0.0 ? 0 : -1;
}

/* Verdicts on all margins over a part: 1 where the first is found, -1 where the part is to be halved. */
static int judge(Run *run, Step *step, const Course *course, const Part *part, double *at_b, int small, Noise *noise,
    const Parameters *p)
{
    Range f[N_WATCHED];
    int found = 0;
    const double width = part->b - part->a;
    margins_over(run, course, part->a, part->b, p, f);
    for (int i = 0; i < N_WATCHED; i++) {
        const int event = watched[i] - N_CLEARANCES - N_SWITCHES - N_FRICTIONS;
        int result = verdict(f[i], part->at_a[i], at_b[i], width, small);
        if (width == 1.0)
            noise->lowest[i] = f[i].lo;
        if (result > 0 && is_noise(run, step, part->b, i, at_b[i], p)) {
            at_b[i] = 0.0;
            result = verdict(f[i], part->at_a[i], 0.0, width, small);
        }
        if (result < 0) {
            find_noise(run, step, noise, p);
            result = -!is_held_at_zero(noise, i, f[i], part->at_a[i], at_b[i], width);
        }
        if (result < 0 || (f[i].partly && !small && event >= 0 && !run->events.no_number[event]))
            return -1;
        if (event >= 0 && isnan(at_b[i]))
            note_no_number(run, event, course->t + part->b * course->h);
        if (result) {
            step->from[i] = part->a;
            step->to[i] = part->b;
            step->above[i] = part->at_a[i] < 0.0 && is_noise(run, step, part->a, i, part->at_a[i], p)
                ? 0.0 : part->at_a[i];
            step->below[i] = at_b[i];
            found = 1;
        }
    }
    return found;
}

#if WATCHES_STATE
/* Whether no margin may be below zero anywhere between the stages of an explicit step: most are done with this. */
static int is_clear(Run *run, const Step *step, Noise *noise, const Parameters *p)
{
    Range f[N_WATCHED], y[2 * N_X + 1] = { {0} };
    const Range t = {step->t, step->t + step->h, -INFINITY, INFINITY, 0};
    for (int k = 0; k < 2 * N_X; k++) {
        const double least = min_of(step->least[k], min_of(run->y[k], step->y[k]));
        const double most = max_of(step->most[k], max_of(run->y[k], step->y[k])), beyond = 0.25 * (most - least);
        y[k] = (Range){least - beyond, most + beyond, -INFINITY, INFINITY, 0};
    }
    margins_of_ranges(run, t, y, p, f);
    for (int i = 0; i < N_WATCHED; i++) {
        const double from = margin(&run->memory, &run->aside, watched[i]);
        const double to = margin(&run->memory, &step->aside, watched[i]);
        if (f[i].lo >= 0.0 && !f[i].partly && !(to < 0.0))
            continue;
        find_noise(run, step, noise, p);
        if (!is_held_at_zero(noise, i, f[i], from, to, 1.0))
            return 0;
    }
    return 1;
}

#endif
/* The first zero of what is watched along an accepted step: `from` where it is not yet, `to` where it is over. */
static void look_inside(Run *run, Step *step, const Parameters *p)
{
    Course course = {.t = step->t, .h = step->h};
    Part parts[DEEPEST + 2];
    Noise noise = {0};
    const double close = root_width(run, step);
    int n = 1, seen = 0;
    for (int i = 0; i < N_WATCHED; i++)
        step->from[i] = step->to[i] = 0.0;
#if WATCHES_STATE
    if ((!step->method->stiff && is_clear(run, step, &noise, p)) || make_dense(run, p, step))
        return;
    course_of(run, step, &course);
#endif
    parts[0].a = 0.0;
    parts[0].b = 1.0;
    margins_at(run, step, 0.0, p, parts[0].at_a);
    while (n > 0) {
        Part *part = &parts[n - 1];
        double at_b[N_WATCHED];
        const double width = part->b - part->a;
        margins_at(run, step, part->b, p, at_b);
        const int small = width <= 4.0 * close || n > DEEPEST || ++seen > MAX_PARTS_SEEN;
        const int result = judge(run, step, &course, part, at_b, small, &noise, p);
        if (result > 0)
            return;
        if (result < 0) { /* its first half is looked at first */
            parts[n] = *part;
            parts[n].b = part->a = part->a + 0.5 * width;
            n++;
            continue;
        }
        if (--n > 0)
            for (int i = 0; i < N_WATCHED; i++)
                parts[n - 1].at_a[i] = at_b[i];
    }
}

static int is_unresolved(const Run *run, const Step *step, const Parameters *p)
{
    (void)run, (void)step, (void)p;
    return 0;
}

/* Where watched margin i is below zero for the first time; 0: nowhere. */
static double first_look(const Run *run, const Step *step, int i, const Parameters *p, double *value)
{
    (void)run, (void)p;
    *value = step->below[i];
    return step->to[i];
}
