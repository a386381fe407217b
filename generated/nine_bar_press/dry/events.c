/*
 * Events: contacts, corners of laws and expressions, and friction that may stick end a step where their margin
 * crosses zero. The place is the root of the step's interpolant; what is looked at is a range of signs, not a
 * crossing alone, so that a contact that starts again on the wrong side of zero is not lost.
 */
enum { ROOT_STEPS = 100, LOOKS = 16 };
#define SHALLOW 1e-13 /* m: a graze that gives no force worth the name */

static int make_dense(Run *run, const Parameters *p, Step *step)
{
    if (step->dense_ready)
        return 0;
    step->dense_ready = 1;
    if (!step->stiff)
        return dop853_dense(run, p, step);
    rodas5p_dense(run, step);
    return 0;
}

static void interpolate(const Run *run, const Step *step, double s, double *y)
{
    if (step->stiff)
        rodas5p_interpolate(run, step, s, y);
    else
        dop853_interpolate(run, step, s, y);
}

/* State, projected, and right-hand side at share s of the step. */
static int state_at(Run *run, const Step *step, double s, const Parameters *p, double *y, double *dy, Aside *aside)
{
    interpolate(run, step, s, y);
    const double t = step->t + s * step->h;
    project_state(run, t, y, p);
    return rates(run, t, y, p, dy, aside);
}

static double margin_at(Run *run, const Step *step, double s, int k, const Parameters *p)
{
    double y[N_Y], dy[N_Y];
    Aside aside;
    return state_at(run, step, s, p, y, dy, &aside) ? NAN : margin(&run->memory, &aside, k);
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

/*
 * The first share at which margin k is below zero, from a bracket of it: inverse interpolation, a look just across
 * the root once it is known so well, and halving where neither helps.
 */
static double root(Run *run, const Step *step, int k, double low, double at_low, double high, double at_high,
    const Parameters *p)
{
    const double close = fmax(1e-12, 4.0 * DBL_EPSILON * fabs(step->t)) / step->h;
    double x[3] = {low, high, 0.0}, f[3] = {at_low, at_high, 0.0};
    for (int i = 0; i < ROOT_STEPS && high - low > close; i++) {
        double s = inverse_zero(x, f, i + 2);
        if (!(s > low && s < high) || i % 12 == 11)
            s = 0.5 * (low + high);
        if (s - low < 2.0 * close)
            s = fmin(s + 0.75 * close, low + 0.9 * (high - low));
        else if (high - s < 2.0 * close)
            s = fmax(s - 0.75 * close, high - 0.9 * (high - low));
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
    const double outward = fmax(fmax(before->deltadot, after->deltadot), step->rate[i][1]);
    const double inward = fmin(fmin(before->deltadot, after->deltadot), step->rate[i][0]);
    const double nearest = fmax(fmax(before->delta, after->delta), -least);
    return !run->memory.latch[i].closed && outward > 0.0 && inward < 0.0
        && nearest + (outward - inward) * step->h / 16.0 > 0.0;
}

/* The least margin k around s, where it is `best`, within `width` to both sides; stops as soon as it is below zero. */
static double dip(Run *run, const Step *step, int k, double *s, double width, double best, const Parameters *p)
{
    for (; width > 1e-6 && best >= -SHALLOW && *s - width >= 0.0 && *s + width <= 1.0; width *= 0.5) {
        const double left = margin_at(run, step, *s - width, k, p), right = margin_at(run, step, *s + width, k, p);
        const double bend = left - 2.0 * best + right;
        double at[3] = {*s - width, *s + width, *s}, value[3] = {left, right, best};
        if (bend > 0.0) {
            at[2] = fmin(fmax(*s + 0.5 * width * (left - right) / bend, at[0]), at[1]);
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
            if (*value < -SHALLOW)
                return s;
        }
        if (now < (i < LOOKS ? -SHALLOW : 0.0)) {
            *value = now;
            return i * width;
        }
        before = last;
        last = now;
    }
    return 0.0;
}

/* The stage at which margin k was smallest; -1: none was. */
static int nearest_stage(const Step *step, int k)
{
    int nearest = -1;
    double least = INFINITY;
    for (int i = 0; i < step->n_seen; i++)
        if (step->seen[k][i] < least) {
            least = step->seen[k][i];
            nearest = i;
        }
    return nearest;
}

/* Of n points the one nearest to x, on its right or left and not too close to it for a parabola; -1: none. */
static int neighbour(const double *points, int n, double x, int right)
{
    int found = -1;
    for (int i = 0; i < n; i++) {
        const double way = right ? points[i] - x : x - points[i];
        if (way > 0.02 && (found < 0 || way < fabs(points[found] - x)))
            found = i;
    }
    return found;
}

/*
 * A margin that dips below zero and comes back between two stages: where the parabola through the point nearest to
 * zero and its neighbours says that it may, the interpolant is looked at. 0: it does not.
 */
static double hidden_dip(Run *run, Step *step, int k, double end, const Parameters *p, double *value)
{
    double x[N_STAGES + 2] = {0.0, 1.0}, f[N_STAGES + 2] = {margin(&run->memory, &run->aside, k), end};
    const int n = step->n_seen + 2;
    int centre = f[1] < f[0];
    for (int i = 2; i < n; i++) {
        x[i] = step->node[i - 2], f[i] = step->seen[k][i - 2];
        if (f[i] < f[centre])
            centre = i;
    }
    int low = neighbour(x, n, x[centre], 0), high = neighbour(x, n, x[centre], 1);
    low = low < 0 ? neighbour(x, n, x[high], 1) : low;
    high = high < 0 ? neighbour(x, n, x[low], 0) : high;
    const double a = x[low] - x[centre], b = x[high] - x[centre];
    const double to_low = (f[low] - f[centre]) / a, to_high = (f[high] - f[centre]) / b;
    const double bend = (to_high - to_low) / (b - a), slope = to_low - bend * a;
    double at = x[centre] - 0.5 * slope / bend; /* the parabola's lowest place */
    if (!(bend > 0.0 && at - x[centre] > fmin(a, fmin(b, 0.0)) && at - x[centre] < fmax(a, fmax(b, 0.0)))
        || !(f[centre] - 0.25 * slope * slope / bend < 0.1 * f[centre]) || make_dense(run, p, step))
        return 0.0;
    *value = margin_at(run, step, at, k, p);
    *value = dip(run, step, k, &at, 0.25 * fabs(b - a), *value, p);
    return *value < 0.0 ? at : 0.0;
}

/* The bracket's upper end for margin k: a share at which it is below zero; 0 if there is none. */
static double violated(Run *run, Step *step, int k, const Parameters *p, double *value)
{
    const double start = margin(&run->memory, &run->aside, k), end = margin(&run->memory, &step->aside, k);
    const int nearest = nearest_stage(step, k);
    const double least = nearest < 0 ? INFINITY : step->seen[k][nearest], s = nearest < 0 ? 1.0 : step->node[nearest];
    if (k < N_CLEARANCES && may_graze(run, step, k, least) && make_dense(run, p, step) == 0)
        return look_along(run, step, k, p, value);
    if (least < 0.0 && s < 1.0 && make_dense(run, p, step) == 0) {
        *value = margin_at(run, step, s, k, p);
        if (*value < 0.0)
            return s;
    }
    *value = end;
    if (k >= N_CLEARANCES && end >= 0.0 && fmin(least, fmin(start, end)) < 0.25 * fmax(start, end))
        return hidden_dip(run, step, k, end, p, value);
    return end < 0.0 ? 1.0 : 0.0;
}

/* What was not seen at the stages but shows where an event was found crossed before it: the first of all. */
static double earlier_event(Run *run, const Step *step, double first, const Parameters *p, int *event)
{
    for (int again = 0; again < N_MARGINS && first > 0.0; again++) {
        double y[N_Y], dy[N_Y], at_high = 0.0;
        Aside aside;
        int found = -1;
        if (state_at(run, step, first, p, y, dy, &aside))
            return first;
        for (int k = 0; k < N_MARGINS; k++) {
            const double now = margin(&run->memory, &aside, k);
            if (k != *event && (run->skip < 0 || k != N_CLEARANCES + run->skip) && now < 0.0 && margin(&run->memory, &run->aside, k) >= 0.0) {
                found = k;
                at_high = now;
            }
        }
        if (found < 0)
            return first;
        const double s = root(run, step, found, 0.0, margin(&run->memory, &run->aside, found), first, at_high, p);
        if (!(s < first))
            return first;
        first = s;
        *event = found;
    }
    return first;
}

/* The first share of the step at which something ends it, and what (-1: nothing, share 1). */
static double first_event(Run *run, Step *step, const Parameters *p, int *event)
{
    double first = 1.0;
    *event = -1;
    for (int k = 0; k < N_MARGINS; k++) {
        if (run->skip >= 0 && k == N_CLEARANCES + run->skip)
            continue;
        double at_high, at_low = margin(&run->memory, &run->aside, k), low = 0.0;
        double high = violated(run, step, k, p, &at_high);
        if (high == 0.0 || make_dense(run, p, step))
            continue;
        if (*event >= 0 && high > first && margin_at(run, step, first, k, p) >= 0.0)
            continue; /* later than what was found */
        for (int j = 1; j < 4 && !(at_low >= 0.0); j++) { /* begun on the wrong side: does it come back first? */
            const double s = 0.25 * j * high, now = margin_at(run, step, s, k, p);
            if (now >= 0.0)
                low = s, at_low = now;
        }
        const double s = at_low >= 0.0 ? root(run, step, k, low, at_low, high, at_high, p) : 0.0;
        if (*event < 0 || s < first) {
            first = s;
            *event = k;
        }
    }
    return *event < 0 ? first : earlier_event(run, step, first, p, event);
}
