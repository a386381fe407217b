/*
 * Transients in terms of time alone: pulses that are at rest at all nodes of a step and active between them. Bounds
 * over the intervals between the nodes are known (ranges.h). A term is checked where it exceeds the values at both ends
 * of an interval by more than a quarter of its range at all nodes.
 */

/* Compute bounds of all terms of time over fractions a to b of the interval of length h from t on: out[N_TERMS]. */
static void terms_over(double t, double h, double a, double b, const Parameters *p, Range *out)
{
    time_terms((Range){t + a * h, t + b * h, h, h, 0}, p, out);
}

#if N_PULSES
enum { MAX_NODES = 16, GAP_PARTS = 64, MAX_HARMLESS_CHECKS = 4 };
#define MAX_UNSEEN_CHANGE 0.25 /* of a term's range at the nodes: allowed excess between them */

/* Return whether the step is accurate at a fraction of it. sure: a term certainly changes there. */
typedef int Harmless(void *context, double fraction, int sure);

/* A part of an interval between nodes; the excess of terms by their bounds, and the certain one in its middle. */
typedef struct {
    double from, to, most, surely;
} GapPart;

/*
 * Return the excess of the terms over a part of an interval. low, high: terms at both ends of the interval; slack:
 * allowed excess of each.
 */
static GapPart interval_part(double t, double h, double from, double to, const Range *low, const Range *high,
    const double *slack, const Parameters *p)
{
    GapPart part = {from, to, 0.0, 0.0};
    Range f[N_TERMS], middle[N_TERMS];
    terms_over(t, h, from, to, p, f);
    terms_over(t, h, 0.5 * (from + to), 0.5 * (from + to), p, middle);
    for (int k = 0; k < N_PULSES; k++) {
        const double least = min_of(low[k].lo, high[k].lo) - slack[k], top = max_of(low[k].lo, high[k].lo) + slack[k];
        const double excess = max_of(f[k].hi - top, least - f[k].lo);
        if (excess > part.most) {
            part.most = excess;
            part.surely = max_of(middle[k].lo - top, least - middle[k].lo);
        }
    }
    return part;
}

/* Return whether every term is monotone from fraction a to b. */
static int is_monotone(double t, double h, double a, double b, const Parameters *p)
{
    Range f[N_TERMS];
    int one_way = 1;
    terms_over(t, h, a, b, p, f);
    for (int k = 0; k < N_PULSES && one_way; k++)
        one_way = f[k].down >= 0.0 || f[k].up <= 0.0;
    return one_way;
}

/*
 * Return a fraction between nodes a and b at which a term acts unseen and the step is not accurate; 0: none. The part
 * with the largest excess is bisected first.
 */
static double undersampled_in_interval(double t, double h, double a, double b, const Range *low, const Range *high,
    const double *slack, Harmless *harmless, void *context, const Parameters *p)
{
    GapPart parts[GAP_PARTS + 1];
    int n = 0, n_checks = 0;
    if (!is_monotone(t, h, a, b, p))
        parts[n++] = interval_part(t, h, a, b, low, high, slack, p);
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
        if (is_known && !harmless(context, middle, part.surely >= 0.5 * part.most))
            return middle;
        n_checks += is_known;
        if (is_known) {
            parts[k] = parts[--n];
        } else {
            parts[k] = interval_part(t, h, part.from, middle, low, high, slack, p);
            parts[n++] = interval_part(t, h, middle, part.to, low, high, slack, p);
        }
    }
    return 0.0;
}

/*
 * Return the first fraction of the interval of length h from t on at which a term acts unseen between n nodes (0 to 1),
 * and the step is not accurate; 0: none.
 */
static double undersampled_term(double t, double h, const double *node, int n, Harmless *harmless, void *context,
    const Parameters *p)
{
    Range at[MAX_NODES][N_TERMS];
    double slack[N_PULSES], fraction = 0.0;
    if (is_monotone(t, h, 0.0, 1.0, p))
        return 0.0; /* its change shows at both ends */
    for (int i = 0; i < n; i++)
        terms_over(t, h, node[i], node[i], p, at[i]);
    for (int k = 0; k < N_PULSES; k++) {
        double least = INFINITY, most = -INFINITY;
        for (int i = 0; i < n; i++) {
            least = min_of(least, at[i][k].lo);
            most = max_of(most, at[i][k].lo);
        }
        slack[k] = MAX_UNSEEN_CHANGE * (most - least);
    }
    for (int i = 1; i < n && fraction == 0.0; i++)
        fraction =
            undersampled_in_interval(t, h, node[i - 1], node[i], at[i - 1], at[i], slack, harmless, context, p);
    return fraction;
}
#endif
