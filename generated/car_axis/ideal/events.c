/*
 * Events: contacts, corners of laws and expressions, and friction that may stick end a step where their margin
 * crosses zero. The place is the root of the step's interpolant; what is looked at is a range of signs, not a
 * crossing alone, so that a contact that starts again on the wrong side of zero is not lost.
 */
enum { ROOT_STEPS = 100, PEAK_STEPS = 12 };

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

/* State, projected, and right-hand side at share s of the step. */
static int state_at(Run *run, const Step *step, double s, const Parameters *p, double *y, double *dy, Aside *aside)
{
    if (step->stiff)
        rodas5p_interpolate(run, step, s, y);
    else
        dop853_interpolate(run, step, s, y);
    const double t = step->t + s * step->h;
    project_state(t, y, p);
    return rates(run, t, y, p, dy, aside);
}

static double margin_at(Run *run, const Step *step, double s, int k, const Parameters *p)
{
    double y[N_Y], dy[N_Y];
    Aside aside;
    return state_at(run, step, s, p, y, dy, &aside) ? NAN : margin(&run->memory, &aside, k);
}

/* The first share at which margin k is below zero, from a bracket of it: Illinois, then halving. */
static double root(Run *run, const Step *step, int k, double low, double at_low, double high, double at_high,
    const Parameters *p)
{
    const double close = fmax(0.5e-12, 2.0 * DBL_EPSILON * fabs(step->t)) / step->h;
    double below = at_high, above = at_low;
    for (int i = 0; i < ROOT_STEPS && high - low > close; i++) {
        double s = i < 40 ? low + (high - low) * above / (above - below) : 0.5 * (low + high);
        s = fmin(fmax(s, low + 0.5 * close), high - 0.5 * close);
        const double now = margin_at(run, step, s, k, p);
        if (!(now >= 0.0)) {
            high = s;
            below = now;
            above *= 0.5;
        } else {
            low = s;
            above = now;
            below *= 0.5;
        }
        if (!isfinite(above / (above - below)))
            above = 1.0, below = -1.0;
    }
    return high;
}

/* Whether a free joint may have touched and left again between what was looked at; its share of the step in `s`. */
static int may_graze(const Run *run, const Step *step, int i, double *s)
{
    const Clearance *before = &run->aside.clearance[i], *after = &step->aside.clearance[i];
    const double h = step->h, bend = (step->rate[i][1] - step->rate[i][0]) / h;
    double highest = fmax(before->delta, after->delta);
    *s = before->delta > after->delta ? 0.0 : 1.0;
    if (run->memory.latch[i].closed || !(before->deltadot > 0.0) || !(after->deltadot < 0.0))
        return 0;
    for (int j = 1; j < 16; j++) { /* the cubic through both ends */
        const double x = j / 16.0, u = 1.0 - x;
        const double d = u * u * (1.0 + 2.0 * x) * before->delta + x * u * u * h * before->deltadot
            + x * x * (3.0 - 2.0 * x) * after->delta - x * x * u * h * after->deltadot;
        if (d > highest) {
            highest = d;
            *s = x;
        }
    }
    return highest + bend * h * h / 64.0 > 0.0;
}

/* The share near s at which margin k is least, by parabolas; its value in `least`. */
static double lowest(Run *run, const Step *step, int k, double s, const Parameters *p, double *least)
{
    double width = 0.125, best = margin_at(run, step, s, k, p);
    for (int i = 0; i < PEAK_STEPS && best >= 0.0; i++) {
        const double a = fmax(s - width, 0.0), b = fmin(s + width, 1.0);
        const double left = margin_at(run, step, a, k, p), right = margin_at(run, step, b, k, p);
        if (left < best || right < best) {
            s = left < right ? a : b;
            best = fmin(left, right);
        } else {
            width *= 0.5;
        }
    }
    *least = best;
    return s;
}

/* The bracket's upper end for margin k: a share at which it is below zero; 0 if there is none. */
static double violated(Run *run, Step *step, int k, const Parameters *p, double *value)
{
    const double end = margin(&run->memory, &step->aside, k);
    double s = step->where[k];
    if (step->least[k] < 0.0 && s < 1.0 && make_dense(run, p, step) == 0) {
        *value = margin_at(run, step, s, k, p);
        if (*value < 0.0)
            return s;
    }
    *value = end;
    if (end < 0.0)
        return 1.0;
    if (k < N_CLEARANCES && may_graze(run, step, k, &s) && make_dense(run, p, step) == 0) {
        s = lowest(run, step, k, s, p, value);
        if (*value < 0.0)
            return s;
    }
    return 0.0;
}

/* The first share of the step at which something ends it, and what (-1: nothing, share 1). */
static double first_event(Run *run, Step *step, const Parameters *p, int *event)
{
    double first = 1.0;
    *event = -1;
    for (int k = 0; k < N_MARGINS; k++) {
        double at_high, at_low = margin(&run->memory, &run->aside, k), low = 0.0;
        double high = violated(run, step, k, p, &at_high);
        if (high == 0.0 || make_dense(run, p, step))
            continue;
        if (*event >= 0 && margin_at(run, step, first, k, p) >= 0.0)
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
    return first;
}

static void peak(Run *run, int i, double t, double F)
{
    if (F > run->F_peak[i]) {
        run->F_peak[i] = F;
        run->t_peak[i] = t;
    }
    if (run->memory.latch[i].closed && F > run->open[i].F_peak) {
        run->open[i].F_peak = F;
        run->open[i].t_peak = t;
    }
}

static double force_at(Run *run, const Step *step, double s, int i, const Parameters *p)
{
    double y[N_Y], dy[N_Y];
    Aside aside;
    if (state_at(run, step, s, p, y, dy, &aside))
        return 0.0;
    const double F = hypot(aside.clearance[i].F_n, aside.clearance[i].F_t);
    peak(run, i, step->t + s * step->h, F);
    return F;
}

/* Peaks of the joints' forces inside a step up to `share`: where a stage saw more than both ends. */
static void inner_peaks(Run *run, Step *step, double share, const Parameters *p)
{
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Clearance *a = &run->aside.clearance[i], *b = &step->aside.clearance[i];
        const double known = run->memory.latch[i].closed ? run->open[i].F_peak : run->F_peak[i];
        double s = step->F_node[i], width = 0.25, best;
        if (!(step->F[i] > fmax(hypot(a->F_n, a->F_t), hypot(b->F_n, b->F_t))) || step->F[i] < 0.9 * known || s > share)
            continue;
        if (make_dense(run, p, step))
            return;
        best = force_at(run, step, s, i, p);
        for (int j = 0; j < PEAK_STEPS && best > 0.0; j++) { /* the top of a parabola through three */
            const double low = fmax(s - width, 0.0), high = fmin(s + width, share);
            const double left = force_at(run, step, low, i, p), right = force_at(run, step, high, i, p);
            const double bend = (right - best) * (s - low) - (best - left) * (high - s);
            double top = left > right ? low : high, found = fmax(left, right);
            if (found <= best && bend < 0.0) {
                const double x = s - low, z = high - s;
                top = s + 0.5 * ((left - best) * z * z - (right - best) * x * x) / bend * -1.0;
                top = fmin(fmax(top, low), high);
                found = force_at(run, step, top, i, p);
            }
            const double moved = fabs(top - s);
            if (found > best) {
                best = found;
                s = top;
            }
            width = fmin(0.5 * width, fmax(2.0 * moved, 1e-4));
            if (width <= 1e-4)
                break;
        }
    }
}
