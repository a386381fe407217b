/*
 * Where the rate of a drive jumps, for rk4: corners of drives are functions of time alone, so that bounds over parts of
 * a step find the first zero of them (ranges.h), however many there are. It is located to neighbouring numbers: what is
 * computed up to the one before it sees one branch only, what begins at the one behind it the other.
 */
#if N_CORNERS
enum { MOST_ENDS = 64, MOST_SEEN = 2000 };

/* Whether any corner has changed its side. */
static int is_crossed(const double *from, const double *now)
{
    int some = 0;
    for (int k = 0; k < N_CORNERS; k++)
        some |= (from[k] < 0.0) != (now[k] < 0.0);
    return some;
}

/*
 * Whether a corner that begins a part of the time, `width` s, on a side is on the other one at its end and not before
 * (1), nowhere (0), or that is not known so far (-1). Bounds are rounded: what is computed at the end comes first.
 */
static int corner_verdict(Range f, double at_a, double at_b, int below, double width, int small)
{
    const int beyond = (at_b < 0.0) != below;
    if (is_empty(f) || (!beyond && (below ? f.hi < 0.0 : f.lo >= 0.0)))
        return 0;
    if (small || (!f.partly && (f.down >= 0.0 || f.up <= 0.0)))
        return beyond;
    if (f.partly)
        return -1;
    /* the nearest to zero that a function of these slopes between these ends may come */
    const double side = below ? -1.0 : 1.0, down = below ? -f.up : f.down, up = below ? -f.down : f.up;
    const double nearest = side * at_a + down * (side * (at_b - at_a) - up * width) / (down - up);
    return side * at_a > 0.0 && side * at_b > 0.0 && nearest > 0.0 ? 0 : -1;
}

/* The same of all corners: 1 where the first is found, -1 where the part from a to b is to be halved. */
static int corners_verdict(const double *from, double a, double b, const double *at_a, const double *at_b, int small,
    const Parameters *p)
{
    Range f[N_CORNERS];
    int found = 0;
    drive_corner_ranges((Range){a, b, 1.0, 1.0, 0}, p, f);
    for (int k = 0; k < N_CORNERS; k++) {
        const int result = corner_verdict(f[k], at_a[k], at_b[k], from[k] < 0.0, b - a, small);
        if (result < 0)
            return -1;
        found |= result;
    }
    return found;
}

/* Neighbouring numbers between a and b, on this side of the first corner and beyond it. */
static void locate_jump(const double *from, double a, double b, const Parameters *p, double *before, double *after)
{
    for (double middle = a + 0.5 * (b - a); a < middle && middle < b; middle = a + 0.5 * (b - a)) {
        double now[N_CORNERS];
        drive_corners(middle, p, now);
        if (is_crossed(from, now))
            b = middle;
        else
            a = middle;
    }
    *before = a;
    *after = b;
}

/* Whether the rate of a drive may jump between two times: the last one before the first jump, and the one after it. */
static int next_jump(double a, double t_end, const Parameters *p, double *before, double *after)
{
    double end[MOST_ENDS + 1], from[N_CORNERS], at_a[N_CORNERS], at_b[N_CORNERS];
    int n = 1, seen = 0;
    drive_corners(a, p, from);
    drive_corners(a, p, at_a);
    end[0] = t_end;
    while (n > 0) {
        const double b = end[n - 1], middle = a + 0.5 * (b - a);
        const int small = !(a < middle && middle < b) || n == MOST_ENDS || ++seen > MOST_SEEN;
        drive_corners(b, p, at_b);
        const int result = corners_verdict(from, a, b, at_a, at_b, small, p);
        if (result > 0) {
            locate_jump(from, a, b, p, before, after);
            return 1;
        }
        if (result < 0) { /* its first half is looked at first */
            end[n++] = middle;
            continue;
        }
        for (int k = 0; k < N_CORNERS; k++)
            at_a[k] = at_b[k];
        a = b;
        n--;
    }
    return 0;
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
