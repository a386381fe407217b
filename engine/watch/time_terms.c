/*
 * Detection of undersampled transients (pulses): terms of time alone, constant at all nodes of a step and active
 * between them. Bounds over the intervals between the nodes are known (ranges.h). A term is checked where it exceeds
 * the values at both ends of an interval by more than a quarter of its range at all nodes.
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
enum { MAX_NODES = 16, MAX_INTERVAL_PARTS = 64, MAX_ACCURACY_TESTS = 4 };
#define MAX_UNSAMPLED_EXCESS 0.25 /* of a term's range at the nodes: allowed excess between them */

/* Return whether the step is accurate at a fraction of it. is_certain: a term changes there, not only by its bounds. */
typedef int AccuracyTest(void *context, double fraction, int is_certain);

/* A part of an interval between nodes; the excess of a term: the largest by its bounds, and that in its middle. */
typedef struct {
    double begin, end, max_excess, middle_excess;
} IntervalPart;

/*
 * Return the part [begin, end] of an interval with bounds of the excess of a term over its values at both nodes of the
 * interval. max_excess: the largest excess that the bounds of any term allow; middle_excess: that of the same term in
 * the middle of the part. Both are 0 if no term may exceed its values at the nodes by more than allowed_excess. begin,
 * end: fractions of the interval of length h (s) from t (s) on; terms_at_begin, terms_at_end (N_TERMS): values of the
 * terms at the left and the right node, with equal bounds lo and hi; allowed_excess: of each term. Called for each part
 * that find_undersampled_fraction() bisects.
 */
static IntervalPart bound_interval_part(double t, double h, double begin, double end, const Interval *terms_at_begin,
    const Interval *terms_at_end,
    const double *allowed_excess, const Parameters *p)
{
    IntervalPart part = {begin, end, 0.0, 0.0};
    Interval bound[N_TERMS], middle[N_TERMS];
    bound_time_terms(t, h, begin, end, p, bound);
    bound_time_terms(t, h, 0.5 * (begin + end), 0.5 * (begin + end), p, middle);
    for (int k = 0; k < N_TRANSIENTS; k++) {
        const double lower = min_of(terms_at_begin[k].lo, terms_at_end[k].lo) - allowed_excess[k],
            upper = max_of(terms_at_begin[k].lo, terms_at_end[k].lo) + allowed_excess[k];
        const double excess = max_of(bound[k].hi - upper, lower - bound[k].lo);
        if (excess > part.max_excess) {
            part.max_excess = excess;
            part.middle_excess = max_of(middle[k].lo - upper, lower - middle[k].lo);
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
 * begin, end: the nodes; terms_at_begin, terms_at_end: values of the terms there; allowed_excess: of each term. The
 * part with the largest excess is bisected first, until half of that excess is certain, or the part is as small as
 * allowed. There is_accurate(context, middle, is_certain) is called. Return 0 after MAX_ACCURACY_TESTS calls, if no
 * part has an excess, and for monotone terms.
 */
static double find_undersampled_fraction(double t, double h, double begin, double end, const Interval *terms_at_begin,
    const Interval *terms_at_end,
    const double *allowed_excess, AccuracyTest *is_accurate, void *context, const Parameters *p)
{
    IntervalPart parts[MAX_INTERVAL_PARTS + 1];
    int n = 0, n_tests = 0;
    if (!are_terms_monotone(t, h, begin, end, p))
        parts[n++] = bound_interval_part(t, h, begin, end, terms_at_begin, terms_at_end, allowed_excess, p);
    while (n > 0) {
        int k = 0;
        for (int i = 1; i < n; i++)
            k = parts[i].max_excess > parts[k].max_excess ? i : k;
        const IntervalPart part = parts[k];
        const double middle = 0.5 * (part.begin + part.end);
        const int is_tested =
            part.middle_excess >= 0.5 * part.max_excess || n == MAX_INTERVAL_PARTS
            || !(part.begin < middle && middle < part.end);
        if (!(part.max_excess > 0.0) || n_tests == MAX_ACCURACY_TESTS)
            return 0.0;
        if (is_tested && !is_accurate(context, middle, part.middle_excess >= 0.5 * part.max_excess))
            return middle;
        n_tests += is_tested;
        if (is_tested) {
            parts[k] = parts[--n];
        } else {
            parts[k] = bound_interval_part(t, h, part.begin, middle, terms_at_begin, terms_at_end, allowed_excess, p);
            parts[n++] = bound_interval_part(t, h, middle, part.end, terms_at_begin, terms_at_end, allowed_excess, p);
        }
    }
    return 0.0;
}

/*
 * Return the first fraction of an interval at which a term of time acts unsampled and the step is not accurate; 0:
 * none. The interval has the length h (s) from t (s) on; node: its n nodes (0 to 1), at which the term is sampled.
 * is_accurate(context, fraction, is_certain) decides the accuracy. Monotone terms change at the ends too, so that 0 is
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
        allowed_excess[k] = MAX_UNSAMPLED_EXCESS * (upper - lower);
    }
    for (int i = 1; i < n && fraction == 0.0; i++)
        fraction =
            find_undersampled_fraction(t, h, node[i - 1], node[i], term_at[i - 1], term_at[i], allowed_excess,
                is_accurate, context, p);
    return fraction;
}
#endif
