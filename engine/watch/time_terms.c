/*
 * Detection of pulses: terms of time alone that are at rest at all nodes of a step and active between them. Bounds over
 * the intervals between the nodes are known (ranges.h). A term is checked where it exceeds the values at both ends of
 * an interval by more than a quarter of its range at all nodes.
 */

/*
 * Compute bounds (N_TERMS) of all terms of time alone over the fractions `begin` to `end` of the interval of length h
 * (s) from t (s) on.
 */
static void bound_time_terms(double t, double h, double begin, double end, const Parameters *p, Range *bounds)
{
    time_terms((Range){t + begin * h, t + end * h, h, h, 0}, p, bounds);
}

#if N_PULSES
enum { MAX_NODES = 16, GAP_PARTS = 64, MAX_HARMLESS_CHECKS = 4 };
#define MAX_UNSEEN_CHANGE 0.25 /* of a term's range at the nodes: allowed excess between them */

/* Return whether the step is accurate at a fraction of it. sure: a term certainly changes there. */
typedef int AccuracyTest(void *context, double fraction, int sure);

/* A part of an interval between nodes; the excess of terms by their bounds, and the certain one in its middle. */
typedef struct {
    double from, to, most, surely;
} GapPart;

/*
 * Return the part [begin, end], fractions of an interval, with the largest excess of a term over its values at both
 * ends of the interval between two nodes. term_low, term_high: terms at these ends; slack: allowed excess of each term.
 * The excess is bounded, and certain in the middle of the part. Called for each part that find_undersampled_fraction()
 * bisects.
 */
static GapPart build_gap_part(double t, double h, double begin, double end, const Range *term_low,
    const Range *term_high,
    const double *slack, const Parameters *p)
{
    GapPart part = {begin, end, 0.0, 0.0};
    Range bound[N_TERMS], middle[N_TERMS];
    bound_time_terms(t, h, begin, end, p, bound);
    bound_time_terms(t, h, 0.5 * (begin + end), 0.5 * (begin + end), p, middle);
    for (int k = 0; k < N_PULSES; k++) {
        const double lower = min_of(term_low[k].lo, term_high[k].lo) - slack[k],
            upper = max_of(term_low[k].lo, term_high[k].lo) + slack[k];
        const double excess = max_of(bound[k].hi - upper, lower - bound[k].lo);
        if (excess > part.most) {
            part.most = excess;
            part.surely = max_of(middle[k].lo - upper, lower - middle[k].lo);
        }
    }
    return part;
}

/*
 * Return whether every term of time that may be a pulse is monotone over the fractions `begin` to `end` of the interval
 * of length h (s) from t (s) on, by bounds of its slope.
 */
static int is_monotone(double t, double h, double begin, double end, const Parameters *p)
{
    Range bound[N_TERMS];
    int monotone = 1;
    bound_time_terms(t, h, begin, end, p, bound);
    for (int k = 0; k < N_PULSES && monotone; k++)
        monotone = bound[k].down >= 0.0 || bound[k].up <= 0.0;
    return monotone;
}

/*
 * Return a fraction between the neighbouring nodes `begin` and `end` at which a term of time acts although it is at
 * rest at both, and the step is not accurate; 0: none. The part with the largest excess is bisected first.
 * is_accurate(context, ...) is called at most MAX_HARMLESS_CHECKS times. term_low, term_high: terms at both nodes;
 * slack: allowed excess of each.
 */
static double find_undersampled_fraction(double t, double h, double begin, double end, const Range *term_low,
    const Range *term_high,
    const double *slack, AccuracyTest *is_accurate, void *context, const Parameters *p)
{
    GapPart parts[GAP_PARTS + 1];
    int n = 0, n_checks = 0;
    if (!is_monotone(t, h, begin, end, p))
        parts[n++] = build_gap_part(t, h, begin, end, term_low, term_high, slack, p);
    while (n > 0) {
        int k = 0;
        for (int i = 1; i < n; i++)
            k = parts[i].most > parts[k].most ? i : k;
        const GapPart part = parts[k];
        const double middle = 0.5 * (part.from + part.to);
        const int is_known =
            part.surely >= 0.5 * part.most || n == GAP_PARTS || !(part.from < middle && middle < part.to);
        if (!(part.most > 0.0) || n_checks == MAX_HARMLESS_CHECKS)
            return 0.0;
        if (is_known && !is_accurate(context, middle, part.surely >= 0.5 * part.most))
            return middle;
        n_checks += is_known;
        if (is_known) {
            parts[k] = parts[--n];
        } else {
            parts[k] = build_gap_part(t, h, part.from, middle, term_low, term_high, slack, p);
            parts[n++] = build_gap_part(t, h, middle, part.to, term_low, term_high, slack, p);
        }
    }
    return 0.0;
}

/*
 * Return the first fraction of the interval of length h (s) from t (s) on at which a term of time acts between its n
 * nodes (0 to 1) without showing at them, and the step is not accurate there; 0: none. is_accurate(context, fraction,
 * sure) decides the accuracy. Monotone terms show at both ends, so that 0 is returned at once. Called for steps of
 * integrators and of kinematic analyses.
 */
static double find_undersampled_term(double t, double h, const double *node, int n, AccuracyTest *is_accurate,
    void *context,
    const Parameters *p)
{
    Range term_at[MAX_NODES][N_TERMS];
    double slack[N_PULSES], fraction = 0.0;
    if (is_monotone(t, h, 0.0, 1.0, p))
        return 0.0; /* its change shows at both ends */
    for (int i = 0; i < n; i++)
        bound_time_terms(t, h, node[i], node[i], p, term_at[i]);
    for (int k = 0; k < N_PULSES; k++) {
        double lower = INFINITY, upper = -INFINITY;
        for (int i = 0; i < n; i++) {
            lower = min_of(lower, term_at[i][k].lo);
            upper = max_of(upper, term_at[i][k].lo);
        }
        slack[k] = MAX_UNSEEN_CHANGE * (upper - lower);
    }
    for (int i = 1; i < n && fraction == 0.0; i++)
        fraction =
            find_undersampled_fraction(t, h, node[i - 1], node[i], term_at[i - 1], term_at[i], slack, is_accurate,
                context, p);
    return fraction;
}
#endif
