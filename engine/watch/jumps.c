/*
 * Where the rate of a drive jumps, for rk4: corners of drives are functions of time alone, so that bounds over parts of
 * a step find the first zero of them (ranges.h), however many there are. It is located to neighbouring numbers: what is
 * computed up to the one before it sees one branch only, what begins at the one behind it the other.
 */
#if N_CORNERS
#define SMALLEST (DBL_MIN * DBL_EPSILON) /* positive number: less than zero by it is less than zero */
/* Whether any corner has changed its side. */
static int is_crossed(const double *from, const double *now)
{
    int some = 0;
    for (int k = 0; k < N_CORNERS; k++)
        some |= (from[k] < 0.0) != (now[k] < 0.0);
    return some;
}

/* The search for the first jump: corners where it begins, and where the part begins that is judged; where it is. */
typedef struct {
    const Parameters *p;
    double from[N_CORNERS], at_a[N_CORNERS], before, after;
} JumpSearch;

/* Below zero once any corner has changed its side; of all of them no more than that is told. */
static int evaluate_sides(void *context, double t, Place *now)
{
    const JumpSearch *of = context;
    double at[N_CORNERS];
    drive_corners(t, of->p, at);
    now->f = is_crossed(of->from, at) ? -1.0 : 1.0;
    return 0;
}

/* Judges a part of the time by bounds of all corners; zero is beyond a corner that comes from below it. */
static int judge_corners(void *context, double a, double b, int small)
{
    JumpSearch *of = context;
    Range f[N_CORNERS];
    double at_b[N_CORNERS];
    int found = 0;
    drive_corners(b, of->p, at_b);
    drive_corner_ranges((Range){a, b, 1.0, 1.0, 0}, of->p, f);
    for (int k = 0; k < N_CORNERS; k++) {
        const int below = of->from[k] < 0.0;
        const double side = below ? -1.0 : 1.0, zero = below ? SMALLEST : 0.0;
        const Range margin = below ? range_add(range_negative(f[k]), only(-zero)) : f[k];
        const int result = zero_verdict(margin, side * of->at_a[k] - zero, side * at_b[k] - zero, b - a, small);
        if (result < 0)
            return -1;
        found |= result;
    }
    if (found) {
        Bracket of_jump = {{{a, 1.0, NAN}, {b, -1.0, NAN}}, 2};
        (void)locate_zero(evaluate_sides, of, &(ZeroTolerance){.width = 0.0}, 2, NAN, &of_jump);
        of->before = of_jump.at[0].s;
        of->after = of_jump.at[1].s;
    }
    memcpy(of->at_a, at_b, sizeof at_b);
    return found;
}

/* Whether the rate of a drive may jump between two times: the last one before the first jump, and the one after it. */
static int next_jump(double a, double t_end, const Parameters *p, double *before, double *after)
{
    JumpSearch of = {.p = p};
    drive_corners(a, p, of.from);
    memcpy(of.at_a, of.from, sizeof of.from);
    const int found = first_part(a, t_end, 0.0, judge_corners, &of);
    *before = of.before;
    *after = of.after;
    return found;
}

/* A run; one that starts at a jump, or right before it, beyond: on the rows that hold there, without work. */
static int begin_run(Run *run, const Parameters *p)
{
    double before, after;
    if (next_jump(run->t, ahead_of(run->t), p, &before, &after))
        project_state(run, after, run->y, p);
    const int status = begin(run, p);
    set_phi_dot_max(run, 0.0); /* rates are those beyond the jump */
    return status;
}
#else
static inline int next_jump(double a, double t_end, const Parameters *p, double *before, double *after)
{
    return (void)a, (void)t_end, (void)p, (void)before, (void)after, 0;
}

static int begin_run(Run *run, const Parameters *p) { return begin(run, p); }
#endif
