/*
 * Contacts that begin and end between two looks: dips of a free joint's margin that touch zero.
 */
enum { LOOKS = 8, MOST_LOWEST = 20 }; /* evenly along a step; for the lowest place between two of them */

#define SHALLOW 1e-13 /* m, or 1e-10 of the depth that ends the model: a graze without a force worth the name */

/* How far below zero a joint's margin lies without a meaning, m. */
static double shallow(const Parameters *p, int k)
{
    return -min_of(SHALLOW, 1e-10 * deepest(p, k));
}

/* Of a free joint at a share of a step: penetration (m) and its rate (m/s). */
typedef struct {
    double s, delta, rate;
} Penetration;

/* The step's begin, its stages in the order of their nodes, its end. Returns how many. */
static int penetrations(const Run *run, const Step *step, int i, Penetration *all)
{
    const Seen margins = seen_of(step, i), rates = seen_of(step, SEEN_RATES + i);
    int n = 1;
    all[0] = (Penetration){0.0, run->aside.clearance[i].delta, run->aside.clearance[i].deltadot};
    for (int k = 0; k < step->n_seen; k++) {
        const Penetration now = {step->node[k], -seen_at(margins, k), seen_at(rates, k)};
        int at = n;
        if (!(now.s > 0.0 && now.s < 1.0))
            continue;
        for (n++; all[at - 1].s > now.s; at--)
            all[at] = all[at - 1];
        all[at] = now;
    }
    all[n++] = (Penetration){1.0, step->aside.clearance[i].delta, step->aside.clearance[i].deltadot};
    return n;
}

/* Whether the penetration may reach zero between neighbours of which the first has it grow and the second fall: where
 * it bends down throughout it lies below their tangents, and these below where they meet. */
static int has_hump(const Penetration *all, int n, double h)
{
    for (int k = 1; k < n; k++) {
        const Penetration a = all[k - 1], b = all[k];
        const double way = h * (b.s - a.s), bend = a.rate - b.rate;
        const double x = (b.delta - a.delta - b.rate * way) / bend; /* where they meet, s behind the first */
        const double top
            = x > 0.0 && x < way ? a.delta + a.rate * x : max_of(a.delta, b.delta) + 0.25 * bend * way;
        if (a.rate > 0.0 && b.rate < 0.0 && top > 0.0)
            return 1;
    }
    return 0;
}

/*
 * Whether a free joint may touch and leave between what was looked at: it turned round, so near that the way between
 * two looks can hide the contact. Stages lie beside the motion, those of stiff methods far from it: they are believed
 * that it turned once only where it did so by both ends, inwards at first and outwards at last.
 */
static int may_graze(const Run *run, const Step *step, int i)
{
    const Clearance *before = &run->aside.clearance[i], *after = &step->aside.clearance[i];
    const double outward = max_of(step->rate[i][1], max_of(after->deltadot, before->deltadot));
    const double inward = min_of(step->rate[i][0], min_of(after->deltadot, before->deltadot));
    const double nearest = max_of(-step->lowest[i], max_of(after->delta, before->delta));
    const int once = step->n_seen && !step->method->stiff && before->deltadot < 0.0 && after->deltadot > 0.0;
    Penetration all[N_STAGES + 2];
    return !run->memory.latch[i].closed && outward > 0.0 && inward < 0.0
        && nearest + (outward - inward) * step->h / 16.0 > 0.0
        && !(once && !has_hump(all, penetrations(run, step, i, all), step->h));
}

/*
 * The least margin k between two places of which the first falls and the second rises: at the lowest points of cubics
 * through both, which take the place of one; stops where it is so far below zero that it counts, or surely is not.
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

/* The first of equally spaced looks, and of the lowest places between them, that finds a free joint's margin k so
 * far below zero that it counts; 0: none. */
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
