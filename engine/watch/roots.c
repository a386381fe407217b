/*
 * Where along a step a margin crosses zero: the step's interpolant, its roots, and dips that touch zero in between.
 */
enum { ROOT_STEPS = 100, LOOKS = 16 };
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

/* Where the parabola x(f) through three points, or the line through two, meets f = 0. */
static double inverse_zero(const double *x, const double *f, int n)
{
    const double a = f[0], b = f[1], c = f[2];
    const double line = x[0] - a * (x[1] - x[0]) / (b - a);
    if (n < 3 || a == c || b == c)
        return line;
    return x[0] * b * c / ((a - b) * (a - c)) + x[1] * a * c / ((b - a) * (b - c)) + x[2] * a * b / ((c - a) * (c - b));
}

/* The share to which a zero is located: 4 ulp of the time, or a tick. */
static double root_width(const Run *run, const Step *step)
{
    return max_of(4.0 * DBL_EPSILON * fabs(step->t), run->tick) / step->h;
}

/*
 * The first share at which margin k is below zero, from a bracket of it: inverse interpolation, a look just across
 * the root once it is known so well, and halving where neither helps.
 */
static double root(Run *run, const Step *step, int k, double low, double at_low, double high, double at_high,
    const Parameters *p)
{
    const double close = root_width(run, step);
    double x[3] = {low, high, 0.0}, f[3] = {at_low, at_high, 0.0};
    for (int i = 0; i < ROOT_STEPS && high - low > close; i++) {
        double s = inverse_zero(x, f, i + 2);
        if (!(s > low && s < high) || i % 12 == 11)
            s = 0.5 * (low + high);
        if (s - low < 2.0 * close)
            s = min_of(low + 0.9 * (high - low), s + 0.75 * close);
        else if (high - s < 2.0 * close)
            s = max_of(high - 0.9 * (high - low), s - 0.75 * close);
        const double now = margin_at(run, step, s, k, p);
        if (now >= 0.0)
            low = s;
        else
            high = s;
        x[2] = x[1], f[2] = f[1];
        x[1] = x[0], f[1] = f[0];
        x[0] = s, f[0] = now;
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
