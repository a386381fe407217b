/*
 * Where along a step a margin crosses zero: the step's interpolant, its roots, and dips that touch zero in between.
 */
enum { ROOT_STEPS = 100, LOOKS = 16 };
#define ACROSS 0.1 /* of the width of a zero, that one is looked at beyond it: what is late at each event adds up */
#define SHALLOW 1e-13 /* m, or 1e-10 of the depth that ends the model: a graze without a force worth the name */

/* How far below zero margin k lies without a meaning: m of a joint with play. */
static double shallow(const Parameters *p, int k)
{
    return k < N_CLEARANCES ? -min_of(SHALLOW, 1e-10 * deepest(p, k)) : 0.0;
}

static int make_dense(Run *run, const Parameters *p, Step *step)
{
    if (step->dense_ready)
        return 0;
    step->dense_ready = 1;
    run->looked.n = 0;
    run->looked.beyond = NAN;
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

static double margin_at(Run *run, const Step *step, double s, int k, const Parameters *p)
{
    Looked *looked = &run->looked;
    double y[N_Y], dy[N_Y];
    Aside aside;
    for (int i = looked->n; i > 0 && i > looked->n - N_LOOKED; i--)
        if (looked->share[(i - 1) % N_LOOKED] == s)
            return looked->margin[(i - 1) % N_LOOKED][k];
    if (state_at(run, step, s, p, y, dy, &aside))
        return NAN;
    const int slot = looked->n++ % N_LOOKED;
    looked->share[slot] = s;
    margins_of(&run->memory, &aside, looked->margin[slot]);
    if (looked->margin[slot][k] < 0.0) {
        looked->beyond = s;
        memcpy(looked->y, y, sizeof y);
        memcpy(looked->dy, dy, sizeof dy);
        looked->aside = aside;
    }
    return looked->margin[slot][k];
}

/* Shares, ascending, and what a margin is there. */
enum { NEAREST = 4, MOST_ALONG = N_STAGES + N_LOOKED + ROOT_STEPS + 4 };
typedef struct {
    int n;
    double x[MOST_ALONG], f[MOST_ALONG];
} Along;

/* One more, unless its share is among them or its margin no number. */
static void note_along(Along *at, double x, double f)
{
    int i = at->n;
    while (i > 0 && at->x[i - 1] > x)
        i--;
    if (!isfinite(f) || (i > 0 && at->x[i - 1] == x) || at->n == MOST_ALONG)
        return;
    for (int j = at->n; j > i; j--)
        at->x[j] = at->x[j - 1], at->f[j] = at->f[j - 1];
    at->x[i] = x;
    at->f[i] = f;
    at->n++;
}

/* The polynomial x(f) through n places, at f = 0 (Neville). */
static double inverse_zero(const double *x, const double *f, int n)
{
    double to[NEAREST];
    for (int i = 0; i < n; i++)
        to[i] = x[i];
    for (int m = 1; m < n; m++)
        for (int i = 0; i + m < n; i++)
            to[i] = (f[i + m] * to[i] - f[i] * to[i + 1]) / (f[i + m] - f[i]);
    return to[0];
}

/* Where the margin crosses zero between two shares of different signs, by places around, as far as it falls there. */
static double guess_zero(const Along *at, double low, double high)
{
    int i = 0, j;
    while (i + 1 < at->n && !(at->x[i] >= low && at->f[i] >= 0.0 && at->f[i + 1] < 0.0))
        i++;
    if (i + 1 >= at->n || at->x[i + 1] > high)
        return 0.5 * (low + high);
    for (j = i + 1; j - i + 1 < NEAREST;) {
        const int left = i > 0 && at->f[i - 1] > at->f[i], right = j + 1 < at->n && at->f[j + 1] < at->f[j];
        if (left && (!right || at->f[i - 1] <= -at->f[j + 1]))
            i--;
        else if (right)
            j++;
        else
            break;
    }
    for (; j > i; j--) { /* of fewer, where they lead astray */
        const double s = inverse_zero(at->x + i, at->f + i, j - i + 1);
        if (s > low && s < high)
            return s;
        i += j - i > 1 && at->f[i] >= -at->f[j];
    }
    return 0.5 * (low + high);
}

/* What is known of margin k along the step: its ends, where it was looked at; about the same are its stages. */
static void along_step(const Run *run, const Step *step, int k, int with_stages, Along *at)
{
    const Looked *looked = &run->looked;
    at->n = 0;
    for (int i = looked->n; i > 0 && i > looked->n - N_LOOKED; i--)
        note_along(at, looked->share[(i - 1) % N_LOOKED], looked->margin[(i - 1) % N_LOOKED][k]);
    note_along(at, 0.0, margin(&run->memory, &run->aside, k));
    note_along(at, 1.0, margin(&run->memory, &step->aside, k));
    for (int i = 0; i < (with_stages ? step->n_seen : 0); i++)
        note_along(at, step->node[i], step->seen[i][k]);
}

/* About where margin k crosses zero between two shares, by what is known of it. */
static double about_where(const Run *run, const Step *step, int k, double low, double high)
{
    Along at;
    along_step(run, step, k, 1, &at);
    return guess_zero(&at, low, high);
}

/* The share to which a zero is located: 4 ulp of the time, or a tick. */
static double root_width(const Run *run, const Step *step)
{
    return max_of(4.0 * DBL_EPSILON * fabs(step->t), run->tick) / step->h;
}

/*
 * A share at which margin k is below zero, next to the first one, from a bracket of it: by inverse interpolation, each
 * look a little across the zero that is expected; over as soon as a look tells what was told before it, or the bracket
 * is as narrow.
 */
static double root(Run *run, const Step *step, int k, double low, double at_low, double high, double at_high,
    const Parameters *p)
{
    const double close = root_width(run, step), across = ACROSS * close;
    double before = INFINITY;
    Along at;
    for (int i = 0; i < ROOT_STEPS && high - low > close; i++) {
        if (i < 2) { /* a stage's sign may be another than the interpolant's: it tells only where to look first */
            along_step(run, step, k, i == 0, &at);
            note_along(&at, low, at_low);
            note_along(&at, high, at_high);
        }
        const double zero = guess_zero(&at, low, high);
        if (fabs(zero - before) < across && high - zero < 2.0 * across)
            break;
        double s = zero + across < high ? zero + across : zero - across;
        if (!(s > low) || i % 8 == 7)
            s = 0.5 * (low + high);
        const double now = margin_at(run, step, s, k, p);
        note_along(&at, s, now);
        before = isfinite(now) ? zero : INFINITY; /* what is no number tells nothing of the zero */
        if (now >= 0.0)
            low = s, at_low = now;
        else
            high = s, at_high = now;
    }
    return high;
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

/* The least margin k around s, where it is `best`, within `width` to both sides; stops as soon as it is below zero. */
static double dip(Run *run, const Step *step, int k, double *s, double width, double best, const Parameters *p)
{
    for (; width > 1e-6 && best >= shallow(p, k) && *s - width >= 0.0 && *s + width <= 1.0; width *= 0.5) {
        const double left = margin_at(run, step, *s - width, k, p), right = margin_at(run, step, *s + width, k, p);
        const double bend = left - 2.0 * best + right;
        double at[3] = {*s - width, *s + width, *s}, value[3] = {left, right, best};
        if (bend > 0.0) {
            at[2] = min_of(at[1], max_of(at[0], *s + 0.5 * width * (left - right) / bend));
            value[2] = margin_at(run, step, at[2], k, p);
        }
        for (int j = 0; j < 3; j++)
            if (value[j] < best) {
                best = value[j];
                *s = at[j];
            }
        if (best > 8.0 * bend)
            break; /* the parabola stays clear of zero */
    }
    return best;
}

/* The first of equally spaced looks, and of the dips between them, that finds margin k below zero; 0: none. */
static double look_along(Run *run, const Step *step, int k, const Parameters *p, double *value)
{
    const double width = 1.0 / LOOKS;
    double before = INFINITY, last = margin(&run->memory, &run->aside, k);
    for (int i = 1; i <= LOOKS; i++) {
        const double now = i < LOOKS ? margin_at(run, step, i * width, k, p) : margin(&run->memory, &step->aside, k);
        if (i > 1 && last < before && last <= now) {
            double s = (i - 1) * width;
            *value = dip(run, step, k, &s, width, last, p);
            if (*value < shallow(p, k))
                return s;
        }
        if (now < (i < LOOKS ? shallow(p, k) : 0.0)) {
            *value = now;
            return i * width;
        }
        before = last;
        last = now;
    }
    return 0.0;
}
