/*
 * Where along a step a margin crosses zero: looks at the step's interpolant, and roots by what they have found.
 */
enum { QUICK = 6, MOST_PLACES = 4 }; /* looks by which a zero is found as a rule; places that tell where it is */
#define FAR_ENOUGH 1e-4 /* shares of a bracket, a third place from its ends: a nearer one tells of rounding */

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

static double margin_at(Run *run, const Step *step, double s, int k, const Parameters *p)
{
    const int slot = look_in(run, step, s, k, p);
    return slot < 0 ? NAN : run->roots.looked.margin[slot][k];
}

/* A margin at share s of a step, and its slope there; NAN where that is not known. */
typedef struct {
    double s, f, slope;
} Place;

static Place place_at(Run *run, const Step *step, double s, int k, const Parameters *p)
{
    const int slot = look_in(run, step, s, k, p);
    if (slot < 0)
        return (Place){s, NAN, NAN};
    return (Place){s, run->roots.looked.margin[slot][k], k < N_CLEARANCES ? run->roots.looked.slope[slot][k] : NAN};
}

/* The same of a joint with play, of which no more than its margin is known afterwards. */
static Place gap_at(Run *run, const Step *step, double s, int k, const Parameters *p)
{
    int slot = slot_of(&run->roots.looked, s, 1);
    Aside aside;
    if (slot < 0 && !play_in(run, step, s, p, &aside))
        slot = note_look(run, step, s, &aside, 1);
    const Looked *looked = &run->roots.looked;
    return slot < 0 ? (Place){s, NAN, NAN} : (Place){s, looked->margin[slot][k], looked->slope[slot][k]};
}

/* Where the polynomial s(f) through n places of different f meets f = 0 (Neville's scheme). */
static double inverse_zero(const Place *place, int n)
{
    double s[MOST_PLACES];
    for (int i = 0; i < n; i++)
        s[i] = place[i].s;
    for (int m = 1; m < n; m++)
        for (int i = 0; i + m < n; i++)
            s[i] = (place[i].f * s[i + 1] - place[i + m].f * s[i]) / (place[i].f - place[i + m].f);
    return s[0];
}

/*
 * A zero, between a bracket's ends, of the cubic that has their values and slopes and, where that helps, the value of a
 * third place too: of the polynomial of order 4 then.
 */
static double hermite_zero(Place low, Place high, Place third)
{
    const double w = high.s - low.s, a = low.f, b = high.f - a, r = w * low.slope, r_end = w * high.slope;
    const double c = 3.0 * b - 2.0 * r - r_end, d = r + r_end - 2.0 * b, x = (third.s - low.s) / w, v = (1.0 - x) * x;
    const double less = third.f - (a + x * (r + x * (c + x * d))); /* than the cubic there */
    const double e = isfinite(third.f) && fabs(v) > FAR_ENOUGH ? less / (v * v) : 0.0;
    double from = 0.0, to = 1.0, u = -a / b;
    for (int i = 0; i < 60 && to - from > DBL_EPSILON; i++) {
        const double back = 1.0 - u, bend = u * back;
        const double f = a + u * (r + u * (c + u * d)) + e * bend * bend;
        const double f_u = r + u * (2.0 * c + 3.0 * u * d) + 2.0 * e * bend * (back - u), before = u;
        if (f >= 0.0)
            from = u;
        else
            to = u;
        u -= f / f_u;
        if (!(u > from && u < to))
            u = 0.5 * (from + to);
        if (fabs(u - before) < 1e-5) /* Newton's next step is its square */
            break;
    }
    return low.s + w * u;
}

/*
 * What is known of a margin about a zero: a bracket of it, and places beside it, nearest first; what stages tell of
 * them serves to know where to look first.
 */
typedef struct {
    Place at[MOST_PLACES]; /* low, high, others */
    int n;
} Bracket;

/* Where a polynomial through what is known has its zero; of values alone through so many places at most. */
static double guess_zero(const Bracket *of, int places)
{
    const Place low = of->at[0], high = of->at[1];
    if (isfinite(low.f + low.slope + high.f + high.slope))
        return hermite_zero(low, high, of->n > 2 ? of->at[2] : (Place){NAN, NAN, NAN});
    return inverse_zero(of->at, of->n < places ? of->n : places);
}

/* A place more, `at` of those that are known: what was there is known beside it. */
static void narrow(Bracket *of, int at, Place now)
{
    of->n = of->n < MOST_PLACES ? of->n + 1 : MOST_PLACES;
    of->at[3] = of->at[2];
    of->at[2] = of->at[at];
    of->at[at] = now;
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

/* A guess within the bracket. */
static double about_where(double guess, const Bracket *of)
{
    const double low = of->at[0].s, high = of->at[1].s;
    return guess > low && guess < high ? guess : 0.5 * (low + high);
}

/* By how much a margin falls a share near its zero, which is about there: at most, as the places say that are known. */
static double falls_by(const Bracket *of, double about)
{
    const double s = about_where(about, of);
    double most = 0.0;
    for (int i = 0; i < of->n; i++)
        most = max_of(most, fabs(of->at[i].f / (of->at[i].s - s)));
    return most;
}

/* How many places tell where a zero is: near one that is located to rounding a fourth tells of that alone. */
static int telling(const Run *run, int k) { return MOST_PLACES - !may_lie_behind(run, k); }

/* Whether a place behind a zero is no further from it than that, as the margin falls there, or from `low` to there. */
static int is_reached(Place low, Place now, double reach)
{
    const double slope = isfinite(now.slope) ? now.slope : (now.f - low.f) / (now.s - low.s);
    return now.f >= slope * reach;
}

/*
 * The first share at which margin k is below zero, from a bracket of it, which looks make narrow: at the zero of a
 * polynomial through what is known, or a little behind it, on the other side of it once that is known so well, and in
 * the middle where looks do not halve the bracket. guess: the first of these zeros.
 */
static double root(Run *run, const Step *step, int k, Bracket of, double guess, const Parameters *p)
{
    const double least = root_width(run, step);
    const int places = telling(run, k);
    double width = 2.0, before = 2.0;
    for (int i = 0;; i++) {
        const double from = of.at[0].s, to = of.at[1].s;
        double s = i ? guess_zero(&of, places) : guess;
        const double reach = reach_of(run, step, k, falls_by(&of, s)), close = max_of(reach, least);
        if (!(to - from > close))
            break;
        if (!(s > from && s < to) || (i >= QUICK && to - from > 0.5 * before))
            s = 0.5 * (from + to);
        else if (s - from < 2.0 * close)
            s = min_of(from + 0.9 * (to - from), s + 0.75 * close);
        else if (reach > 0.0)
            s += min_of(0.5 * reach, 0.9 * (to - s));
        else if (to - s < 2.0 * close)
            s = max_of(to - 0.9 * (to - from), s - 0.75 * close);
        if (!(s > from && s < to))
            break; /* nothing lies between */
        before = width;
        width = to - from;
        const Place now = i == 0 && k < N_CLEARANCES ? gap_at(run, step, s, k, p) : place_at(run, step, s, k, p);
        if (now.f < 0.0 && is_reached(of.at[0], now, reach))
            return s;
        narrow(&of, now.f >= 0.0 ? 0 : 1, now);
    }
    return of.at[1].s;
}
