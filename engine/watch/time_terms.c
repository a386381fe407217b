/*
 * Detection of pulses: terms of time alone that are at rest at all nodes of a step and active between them. Bounds over
 * the intervals between the nodes are known (ranges.h). A term is checked where it exceeds the values at both ends of
 * an interval by more than a quarter of its range at all nodes.
 */

/*
 * Compute bounds (N_TERMS) of all terms of time alone over a part of an interval. begin, end: fractions of the interval
 * of length h (s) from t (s) on.
 */
static void bound_time_terms(double t, double h, double begin, double end, const Parameters *p, Interval *bounds)
{
    time_terms((Interval){t + begin * h, t + end * h, h, h, 0}, p, bounds);
}

#if N_TRANSIENTS
enum { MAX_NODES = 16, MAX_INTERVAL_PARTS = 64, MAX_HARMLESS_CHECKS = 4 };
#define MAX_UNSEEN_CHANGE 0.25 /* of a term's range at the nodes: allowed excess between them */

/* Return whether the step is accurate at a fraction of it. is_certain: a term certainly changes there. */
typedef int AccuracyTest(void *context, double fraction, int is_certain);

/* A part of an interval between nodes; the excess of terms by their bounds, and the certain one in its middle. */
typedef struct {
    double from, to, most, surely;
} IntervalPart;

/*
 * Return the part [begin, end] of an interval with the largest excess of a term over its values at two nodes. begin,
 * end: fractions of the interval of length h (s) from t (s) on; term_low, term_high: terms at the nodes;
 * allowed_excess: of each term. The excess is bounded, and certain in the middle of the part. Called for each part that
 * find_undersampled_fraction() bisects.
 */
static IntervalPart build_interval_part(double t, double h, double begin, double end, const Interval *term_low,
    const Interval *term_high,
    const double *allowed_excess, const Parameters *p)
{
    IntervalPart part = {begin, end, 0.0, 0.0};
    Interval bound[N_TERMS], middle[N_TERMS];
    bound_time_terms(t, h, begin, end, p, bound);
    bound_time_terms(t, h, 0.5 * (begin + end), 0.5 * (begin + end), p, middle);
    for (int k = 0; k < N_TRANSIENTS; k++) {
        const double lower = min_of(term_low[k].lo, term_high[k].lo) - allowed_excess[k],
            upper = max_of(term_low[k].lo, term_high[k].lo) + allowed_excess[k];
        const double excess = max_of(bound[k].hi - upper, lower - bound[k].lo);
        if (excess > part.most) {
            part.most = excess;
            part.surely = max_of(middle[k].lo - upper, lower - middle[k].lo);
        }
    }
    return part;
}

/*
 * Return whether every term of time that may be a pulse is monotone over a part of an interval. begin, end: fractions
 * of the interval of length h (s) from t (s) on. Bounds of the slopes decide.
 */
static int are_terms_monotone(double t, double h, double begin, double end, const Parameters *p)
{
    Interval bound[N_TERMS];
    int monotone = 1;
    bound_time_terms(t, h, begin, end, p, bound);
    for (int k = 0; k < N_TRANSIENTS && monotone; k++)
        monotone = bound[k].min_slope >= 0.0 || bound[k].max_slope <= 0.0;
    return monotone;
}

/*
 * Return a fraction between two neighbouring nodes at which a term of time acts and the step is not accurate; 0: none.
 * begin, end: the nodes, at which the term is at rest; term_low, term_high: terms there; allowed_excess: of each term.
 * The part with the largest excess is bisected first. is_accurate(context, ...) is called at most MAX_HARMLESS_CHECKS
 * times.
 */
static double find_undersampled_fraction(double t, double h, double begin, double end, const Interval *term_low,
    const Interval *term_high,
    const double *allowed_excess, AccuracyTest *is_accurate, void *context, const Parameters *p)
{
    IntervalPart parts[MAX_INTERVAL_PARTS + 1];
    int n = 0, n_checks = 0;
    if (!are_terms_monotone(t, h, begin, end, p))
        parts[n++] = build_interval_part(t, h, begin, end, term_low, term_high, allowed_excess, p);
    while (n > 0) {
        int k = 0;
        for (int i = 1; i < n; i++)
            k = parts[i].most > parts[k].most ? i : k;
        const IntervalPart part = parts[k];
        const double middle = 0.5 * (part.from + part.to);
        const int is_known =
            part.surely >= 0.5 * part.most || n == MAX_INTERVAL_PARTS || !(part.from < middle && middle < part.to);
        if (!(part.most > 0.0) || n_checks == MAX_HARMLESS_CHECKS)
            return 0.0;
        if (is_known && !is_accurate(context, middle, part.surely >= 0.5 * part.most))
            return middle;
        n_checks += is_known;
        if (is_known) {
            parts[k] = parts[--n];
        } else {
            parts[k] = build_interval_part(t, h, part.from, middle, term_low, term_high, allowed_excess, p);
            parts[n++] = build_interval_part(t, h, middle, part.to, term_low, term_high, allowed_excess, p);
        }
    }
    return 0.0;
}

/*
 * Return the first fraction of an interval at which a term of time acts unseen and the step is not accurate; 0: none.
 * The interval has the length h (s) from t (s) on; node: its n nodes (0 to 1), at which the term does not show.
 * is_accurate(context, fraction, is_certain) decides the accuracy. Monotone terms show at both ends, so that 0 is
 * returned at once. Called for steps of integrators and of kinematic analyses.
 */
static double find_undersampled_term(double t, double h, const double *node, int n, AccuracyTest *is_accurate,
    void *context,
    const Parameters *p)
{
    Interval term_at[MAX_NODES][N_TERMS];
    double allowed_excess[N_TRANSIENTS], fraction = 0.0;
    if (are_terms_monotone(t, h, 0.0, 1.0, p))
        return 0.0; /* its change shows at both ends */
    for (int i = 0; i < n; i++)
        bound_time_terms(t, h, node[i], node[i], p, term_at[i]);
    for (int k = 0; k < N_TRANSIENTS; k++) {
        double lower = INFINITY, upper = -INFINITY;
        for (int i = 0; i < n; i++) {
            lower = min_of(lower, term_at[i][k].lo);
            upper = max_of(upper, term_at[i][k].lo);
        }
        allowed_excess[k] = MAX_UNSEEN_CHANGE * (upper - lower);
    }
    for (int i = 1; i < n && fraction == 0.0; i++)
        fraction =
            find_undersampled_fraction(t, h, node[i - 1], node[i], term_at[i - 1], term_at[i], allowed_excess,
                is_accurate, context, p);
    return fraction;
}
#endif
