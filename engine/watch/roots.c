/*
 * Where along a step a margin crosses zero: the step's interpolant, its roots, and dips that touch zero in between.
 */
enum { QUICK = 6, LOOKS = 8, MOST_LOWEST = 20 }; /* looks by which a zero is found as a rule; evenly along a step */
#define SHALLOW 1e-13 /* m, or 1e-10 of the depth that ends the model: a graze without a force worth the name */

/* How far below zero margin k lies without a meaning: m of a joint with play. */
static double shallow(const Parameters *p, int k)
{
    return k < N_CLEARANCES ? -min_of(SHALLOW, 1e-10 * deepest(p, k)) : 0.0;
}

/* What others have found of a step that they tried. */
static void take_over(const double *lane, int lanes, int rows, double (*to)[N_Y])
{
    for (int k = 0; k < rows; k++)
        for (int i = 0; i < N_Y; i++)
            to[k][i] = lane[(k * N_Y + i) * lanes];
}

static int make_dense(Run *run, const Parameters *p, Step *step)
{
    const int there = step->dense_ready == ELSEWHERE;
    if (step->dense_ready == HERE)
        return 0;
    step->dense_ready = HERE;
    run->looked.n = 0;
    run->looked.beyond = NAN;
    if (there) {
        take_over(step->dense_lane, step->lanes, N_DENSE, step->dense);
        run->evaluations += step->method->more;
        return 0;
    }
    if (step->stages_lane)
        take_over(step->stages_lane, step->lanes, step->method->stages, step->k);
    step->stages_lane = NULL;
    return step->method->dense(run, p, step);
}

static void interpolate(const Run *run, const Step *step, double s, double *y)
{
    step->method->interpolate(run, step, s, y);
}

/* State, projected, and right-hand side at share s of the step. */
static int state_at(Run *run, const Step *step, double s, const Parameters *p, double *y, double *dy, Aside *aside)
{
    if (s == run->looked.beyond) {
        memcpy(y, run->looked.y, sizeof run->looked.y);
        memcpy(dy, run->looked.dy, sizeof run->looked.dy);
        *aside = run->looked.aside;
        return 0;
    }
    interpolate(run, step, s, y);
    const double t = step->t + s * step->h;
    project_state(run, t, y, p);
    return rates(run, t, y, p, dy, aside);
}

/* By how much margin k grows per share of the step; NAN where a right-hand side does not tell. */
static double margin_slope(const Run *run, const Step *step, const Aside *aside, int k)
{
    if (k >= N_CLEARANCES || (run->memory.latch[k].closed && !gives(k)))
        return NAN;
    return (run->memory.latch[k].closed ? step->h : -step->h) * aside->clearance[k].deltadot;
}

/* Where in run->looked all margins at share s are, looked at if they have not been; -1: it has none. */
static int look_in(Run *run, const Step *step, double s, int k, const Parameters *p)
{
    Looked *looked = &run->looked;
    double y[N_Y], dy[N_Y];
    Aside aside;
    for (int i = looked->n; i > 0 && i > looked->n - N_LOOKED; i--)
        if (looked->share[(i - 1) % N_LOOKED] == s)
            return (i - 1) % N_LOOKED;
    if (state_at(run, step, s, p, y, dy, &aside))
        return -1;
    const int slot = looked->n++ % N_LOOKED;
    looked->share[slot] = s;
    margins_of(&run->memory, &aside, looked->margin[slot]);
    for (int i = 0; i < N_CLEARANCES; i++)
        looked->slope[slot][i] = margin_slope(run, step, &aside, i);
    if (looked->margin[slot][k] < 0.0) {
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
    return slot < 0 ? NAN : run->looked.margin[slot][k];
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
    return (Place){s, run->looked.margin[slot][k], k < N_CLEARANCES ? run->looked.slope[slot][k] : NAN};
}

/* Where the parabola x(f) through three places, or the line through two, meets f = 0. */
static double inverse_zero(Place a, Place b, Place c)
{
    const double line = a.s - a.f * (b.s - a.s) / (b.f - a.f);
    if (!isfinite(c.f) || a.f == c.f || b.f == c.f)
        return line;
    return a.s * b.f * c.f / ((a.f - b.f) * (a.f - c.f)) + b.s * a.f * c.f / ((b.f - a.f) * (b.f - c.f))
        + c.s * a.f * b.f / ((c.f - a.f) * (c.f - b.f));
}

/*
 * A zero, between a bracket's ends, of the cubic that has their values and slopes and, where that helps, the value of a
 * third place too: of the polynomial of order 4 then.
 */
static double hermite_zero(Place low, Place high, Place third)
{
    const double w = high.s - low.s, a = low.f, b = high.f - a, r = w * low.slope, r_end = w * high.slope;
    const double c = 3.0 * b - 2.0 * r - r_end, d = r + r_end - 2.0 * b, x = (third.s - low.s) / w, v = (1.0 - x) * x;
    const double e = isfinite(third.f) && v != 0.0 ? (third.f - (a + x * (r + x * (c + x * d)))) / (v * v) : 0.0;
    double from = 0.0, to = 1.0, u = min_of(0.9, max_of(0.1, -a / b));
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
        if (fabs(u - before) < 1e-14)
            break;
    }
    return low.s + w * u;
}

static double guess_zero(Place low, Place high, Place third)
{
    const int known = isfinite(low.f + low.slope + high.f + high.slope);
    return known ? hermite_zero(low, high, third) : inverse_zero(low, high, third);
}

/* The share to which a zero is located: 4 ulp of the time, or a tick. */
static double root_width(const Run *run, const Step *step)
{
    return max_of(4.0 * DBL_EPSILON * fabs(step->t), run->tick) / step->h;
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

/* Of the stages that at which margin k is nearest to zero: it tells only where to look first. */
static Place stage_between(const Step *step, int k, double low, double high)
{
    Place best = {NAN, NAN, NAN};
    for (int i = 0; i < step->n_seen; i++)
        if (step->node[i] > low && step->node[i] < high && !(fabs(step->seen[i][k]) >= fabs(best.f)))
            best = (Place){step->node[i], step->seen[i][k], NAN};
    return best;
}

/* Where margin k crosses zero in a bracket of it, as far as stages tell. */
static double stage_guess(const Step *step, int k, Place low, Place high)
{
    return guess_zero(low, high, stage_between(step, k, low.s, high.s));
}

/* A guess within the bracket. */
static double about_where(double guess, Place low, Place high)
{
    return guess > low.s && guess < high.s ? guess : 0.5 * (low.s + high.s);
}

/*
 * The first share at which margin k is below zero, from a bracket of it, which looks make as narrow as zeros are told
 * apart: at the zero of a polynomial through what is known, on the other side of it once that is known so well, and in
 * the middle where looks do not halve the bracket. guess: stage_guess of the bracket.
 */
static double root(Run *run, const Step *step, int k, Place low, Place high, double guess, const Parameters *p)
{
    const double close = root_width(run, step);
    Place third = stage_between(step, k, low.s, high.s);
    double width = 2.0, before = 2.0;
    for (int i = 0; high.s - low.s > close; i++) {
        double s = i ? guess_zero(low, high, third) : guess;
        if (!(s > low.s && s < high.s) || (i >= QUICK && high.s - low.s > 0.5 * before))
            s = 0.5 * (low.s + high.s);
        else if (s - low.s < 2.0 * close)
            s = min_of(low.s + 0.9 * (high.s - low.s), s + 0.75 * close);
        else if (high.s - s < 2.0 * close)
            s = max_of(high.s - 0.9 * (high.s - low.s), s - 0.75 * close);
        if (!(s > low.s && s < high.s))
            break; /* nothing lies between */
        before = width;
        width = high.s - low.s;
        const Place now = place_at(run, step, s, k, p);
        if (now.f >= 0.0)
            third = low, low = now;
        else
            third = high, high = now;
    }
    return high.s;
}

/*
 * Whether a free joint may touch, leave and touch again between what was looked at: it turned round, so near that
 * the way between two looks (a quarter of the step at most) can hide the contact.
 */
static int may_graze(const Run *run, const Step *step, int i, double least)
{
    const Clearance *before = &run->aside.clearance[i], *after = &step->aside.clearance[i];
    const double outward = max_of(step->rate[i][1], max_of(after->deltadot, before->deltadot));
    const double inward = min_of(step->rate[i][0], min_of(after->deltadot, before->deltadot));
    const double nearest = max_of(-least, max_of(after->delta, before->delta));
    return !run->memory.latch[i].closed && outward > 0.0 && inward < 0.0
        && nearest + (outward - inward) * step->h / 16.0 > 0.0;
}

/*
 * The least margin k between two places of which the first falls and the second rises: at the lowest points of cubics
 * through both, which take the place of one; stops where it is below zero, or surely is not.
 */
static double lowest(Run *run, const Step *step, int k, Place low, Place high, double *s, const Parameters *p)
{
    const double least = shallow(p, k);
    double best = min_of(low.f, high.f);
    for (int i = 0; i < MOST_LOWEST && high.s - low.s > 1e-6; i++) {
        const double w = high.s - low.s, mean = 3.0 * (high.f - low.f) / w;
        const double c = mean - 2.0 * low.slope - high.slope, d = low.slope + high.slope - 2.0 / 3.0 * mean;
        const double root = sqrt(max_of(0.0, c * c - 3.0 * d * low.slope)); /* slope + 2 c x + 3 d x^2 = 0 */
        const double x = min_of(0.9, max_of(0.1, -low.slope / (c + root)));
        const Place now = place_at(run, step, low.s + w * x, k, p);
        if (!(now.f >= best))
            best = now.f, *s = now.s;
        if (!(best >= least))
            break;
        if (now.slope < 0.0)
            low = now;
        else
            high = now;
        if (now.f + (now.slope < 0.0 ? now.slope * (high.s - now.s) : now.slope * (low.s - now.s)) > least)
            break; /* a convex one stays above its tangents */
    }
    return best;
}

/* The first of equally spaced looks, and of the lowest places between them, that finds a free joint's margin k below
 * zero; 0: none. */
static double look_along(Run *run, const Step *step, int k, const Parameters *p, double *value)
{
    Place last = begin_of(run, step, k);
    for (int i = 1; i <= LOOKS; i++) {
        const Place now = i < LOOKS ? place_at(run, step, (double)i / LOOKS, k, p) : end_of(run, step, k);
        if (last.slope < 0.0 && now.slope > 0.0) {
            double s = now.s;
            *value = lowest(run, step, k, last, now, &s, p);
            if (*value < shallow(p, k))
                return s;
        }
        if (now.f < (i < LOOKS ? shallow(p, k) : 0.0)) {
            *value = now.f;
            return now.s;
        }
        last = now;
    }
    return 0.0;
}
