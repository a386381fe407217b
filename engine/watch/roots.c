/*
 * Where along a step a margin crosses zero (zeros.h): samples of the step's interpolant, and how near the tolerance of
 * the run asks a zero to be located.
 */
#define AT_ONSET 1e-9   /* of a step, behind the begin of a contact, at most */
#define AT_END 1e-6     /* the same behind its end */
#define AT_CORNER 1e-2  /* of a step, behind a corner, at most */
#define NO_HARM 1e-4    /* of the tolerance, that its wrong branch may change a step by */


static void interpolate(const Run *run, const Step *step, double s, double *y)
{
    step->method->interpolate(run, step, s, y);
}

/* State, projected, and right-hand side at share s of the step. */
static int state_at(Run *run, const Step *step, double s, const Parameters *p, double *y, double *dy, Aside *aside)
{
    if (s == run->roots.looked.beyond) {
        memcpy(y, run->roots.looked.y, sizeof run->roots.looked.y);
        memcpy(dy, run->roots.looked.dy, sizeof run->roots.looked.dy);
        *aside = run->roots.looked.aside;
        return 0;
    }
    interpolate(run, step, s, y);
    const double t = step->t + s * step->h;
    project_state(run, t, y, p);
    return rates_at_rest(run, t, y, p, dy, aside);
}

/*
 * What joints with play tell at a state: all of rates() where contacts are rigid, whose forces follow from
 * accelerations.
 */
static int play(Run *run, double t, const double *y, const Parameters *p, Aside *aside)
{
#if N_RIGID
    double dy[N_Y];
    return rates(run, t, y, p, dy, aside);
#else
    count_evaluations(run, 1);
    if (given_up(&run->cancellation))
        return STOPPED;
    show_states(&run->memory, y);
    return play_here(t, y, &run->memory, p, aside);
#endif
}

/* What joints with play tell at share s of the step. */
static int play_in(Run *run, const Step *step, double s, const Parameters *p, Aside *aside)
{
    double y[N_Y];
    if (s == run->roots.looked.beyond) {
        *aside = run->roots.looked.aside;
        return 0;
    }
#if N_FRICTIONS
    double dy[N_Y];
    return state_at(run, step, s, p, y, dy, aside);
#else
    interpolate(run, step, s, y);
    project_state(run, step->t + s * step->h, y, p);
    return play(run, step->t + s * step->h, y, p, aside);
#endif
}

/* By how much margin k grows per share of the step; NAN where a right-hand side does not tell. */
static double margin_slope(const Run *run, const Step *step, const Aside *aside, int k)
{
    if (k >= N_CLEARANCES || (run->memory.latch[k].closed && !gives(k)))
        return NAN;
    return (run->memory.latch[k].closed ? step->h : -step->h) * aside->clearance[k].deltadot;
}

/* Forget the samples of another step. */
static void forget_looked(Run *run)
{
    run->roots.looked.n = 0;
    run->roots.looked.beyond = NAN;
}

/* Where in run->roots.looked a share is, with all margins or those of joints with play alone; -1: nowhere. */
static int slot_of(const Looked *looked, double s, int joints_alone)
{
    for (int i = looked->n; i > 0 && i > looked->n - N_LOOKED; i--)
        if (looked->share[(i - 1) % N_LOOKED] == s && joints_alone >= looked->joints_alone[(i - 1) % N_LOOKED])
            return (i - 1) % N_LOOKED;
    return -1;
}

static int note_look(Run *run, const Step *step, double s, const Aside *aside, int joints_alone)
{
    const int slot = run->roots.looked.n++ % N_LOOKED;
    run->roots.looked.share[slot] = s;
    run->roots.looked.joints_alone[slot] = joints_alone;
    for (int i = 0; i < (joints_alone ? N_CLEARANCES : N_MARGINS); i++)
        run->roots.looked.margin[slot][i] = margin(&run->memory, aside, i);
    for (int i = 0; i < N_CLEARANCES; i++)
        run->roots.looked.slope[slot][i] = margin_slope(run, step, aside, i);
    return slot;
}

/* As slot_of() for all margins, looked at if they have not been. k: the margin for whose zero is looked, -1: none. */
static int look_in(Run *run, const Step *step, double s, int k, const Parameters *p)
{
    Looked *looked = &run->roots.looked;
    double y[N_Y], dy[N_Y];
    Aside aside;
    int slot = slot_of(looked, s, 0);
    if (slot >= 0 || state_at(run, step, s, p, y, dy, &aside))
        return slot;
    slot = note_look(run, step, s, &aside, 0);
    if (k >= 0 && looked->margin[slot][k] < 0.0) {
        looked->beyond = s;
        memcpy(looked->y, y, sizeof y);
        memcpy(looked->dy, dy, sizeof dy);
        looked->aside = aside;
    }
    return slot;
}

/* Margin k at a share of a step, which is in a slot of run->roots.looked; -1: it is not known. */
static Place place_in(const Looked *looked, int slot, double s, int k)
{
    return slot < 0 ? (Place){s, NAN, NAN}
        : (Place){s, looked->margin[slot][k], k < N_CLEARANCES ? looked->slope[slot][k] : NAN};
}

/* The same, sampled there if it has not been. */
static Place place_at(Run *run, const Step *step, double s, int k, const Parameters *p)
{
    const int slot = look_in(run, step, s, k, p);
    return place_in(&run->roots.looked, slot, s, k);
}

static double margin_at(Run *run, const Step *step, double s, int k, const Parameters *p)
{
    return place_at(run, step, s, k, p).f;
}

/* The same of a joint with play, of which no more than its margin is known afterwards. */
static Place gap_at(Run *run, const Step *step, double s, int k, const Parameters *p)
{
    int slot = slot_of(&run->roots.looked, s, 1);
    Aside aside;
    if (slot < 0 && !play_in(run, step, s, p, &aside))
        slot = note_look(run, step, s, &aside, 1);
    return place_in(&run->roots.looked, slot, s, k);
}

/* Margin k at both ends of a step. */
static Place begin_of(const Run *run, const Step *step, int k)
{
    return (Place){0.0, margin(&run->memory, &run->aside, k), margin_slope(run, step, &run->aside, k)};
}

static Place end_of(const Run *run, const Step *step, int k)
{
    return (Place){1.0, margin(&run->memory, &step->aside, k), margin_slope(run, step, &step->aside, k)};
}

/* A bracket with those two of the stages in it at which margin k is nearest to zero. */
static Bracket bracket_of(const Step *step, int k, Place low, Place high)
{
    Place nearest = {NAN, NAN, NAN}, next = nearest;
    const Seen seen = seen_of(step, k);
    for (int i = 0; i < step->n_seen; i++) {
        const Place now = {step->node[i], seen_at(seen, i), NAN};
        if (!(now.s > low.s && now.s < high.s && now.f == now.f))
            continue;
        if (!(fabs(now.f) >= fabs(nearest.f)))
            next = nearest, nearest = now;
        else if (!(fabs(now.f) >= fabs(next.f)))
            next = now;
    }
    return (Bracket){{low, high, nearest, next}, 2 + (nearest.s == nearest.s) + (next.s == next.s)};
}

/* The share to which a zero is located: 4 ulp of the time, or a tick. */
static double root_width(const Run *run, const Step *step)
{
    return max_of(4.0 * DBL_EPSILON * fabs(step->t), run->roots.tick) / step->h;
}

/* Whether margin k may be found behind its zero: of a contact that gives, of a corner where branches meet. */
static int may_lie_behind(const Run *run, int k)
{
    const int corner = k - N_CLEARANCES;
    if (run->control.fixed > 0.0 || watched_as[k] >= 0)
        return 0;
    return corner < 0 ? gives(k) : corner < N_SWITCHES && meets[corner];
}

/*
 * How far behind its zero the margin of a contact that gives may be found, as a share of a step. Forces may begin with
 * a jump, and how long a contact lasts is not known before it begins, nor by others: of one as short as the
 * tolerance's share of the step that finds its onset, the tolerance is missed. The step that finds an end is a part of
 * the contact.
 */
static double reach_of_contact(const Run *run, int k)
{
    const double tolerance = tolerance_of(run);
    return run->memory.latch[k].closed ? min_of(AT_END, tolerance * sqrt(tolerance))
        : min_of(AT_ONSET, tolerance * tolerance);
}

/*
 * How near its zero margin k is located: of a corner, where branches meet, as far after it as the wrong one does no
 * harm. Rates differ in proportion to the margin, and what that does grows with the square of the way: at the step's
 * end they do so by what step->harm tells.
 */
static ZeroTolerance zero_tolerance(const Run *run, const Step *step, int k)
{
    const double width = root_width(run, step);
    if (!may_lie_behind(run, k))
        return (ZeroTolerance){.width = width};
    if (k < N_CLEARANCES)
        return (ZeroTolerance){width, reach_of_contact(run, k), INFINITY, 1.0};
    return (ZeroTolerance){width, AT_CORNER, NO_HARM * fabs(margin(&run->memory, &step->aside, k)), step->harm};
}

/* How many places tell where a zero is: near one that is located to rounding a fourth tells of that alone. */
static int telling(const Run *run, int k) { return MOST_PLACES - !may_lie_behind(run, k); }

/* Margin k of a step, whose zero is located; whether it has not been sampled yet. */
typedef struct {
    Run *run;
    const Step *step;
    const Parameters *p;
    int k, first;
} MarginOfStep;

/* The first sample is seldom the last one, after which the whole state is needed. */
static int evaluate_margin(void *context, double s, Place *now)
{
    MarginOfStep *of = context;
    *now = of->first && of->k < N_CLEARANCES ? gap_at(of->run, of->step, s, of->k, of->p)
        : place_at(of->run, of->step, s, of->k, of->p);
    of->first = 0;
    return 0;
}

/* The first share at which margin k is below zero, from a bracket of it and a guess. */
static double root(Run *run, const Step *step, int k, Bracket of, double guess, const Parameters *p)
{
    MarginOfStep margin_of_step = {run, step, p, k, 1};
    const ZeroTolerance near = zero_tolerance(run, step, k);
    (void)locate_zero(evaluate_margin, &margin_of_step, &near, telling(run, k), guess, &of);
    return of.at[1].s;
}
