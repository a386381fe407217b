/*
 * Pulses: terms of the equations that hang on time alone, at rest wherever a step looks and active in between. Their
 * bounds over the gaps between its looks are known (ranges.h): where one goes beyond what both ends of a gap show by
 * more than a quarter of what the step has seen of it, that place is looked at.
 */

/* Terms over a part of the time from t on, h long. */
static void terms_over(double t, double h, double a, double b, const Parameters *p, Range *out)
{
    time_terms((Range){t + a * h, t + b * h, h, h, 0}, p, out);
}

#if N_PULSES
enum { N_PLACES = 16, GAP_PARTS = 64, MAX_HARMLESS = 4 };
#define UNSEEN 0.25 /* of what was seen of a term, that it may go beyond in a gap */

/* Whether what happens at a share of the step is nothing to speak of; `sure`: it is more than bounds that are wide. */
typedef int Harmless(void *context, double fraction, int sure);

/* A part of a gap; how far terms may go in it beyond what was seen, and how far they do so in its middle. */
typedef struct {
    double from, to, most, surely;
} GapPart;

/* `low` and `high`: terms at both ends of the gap, `slack`: what they may go beyond these. */
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

/* Whether every term goes one way only from share a to b. */
static int is_monotone(double t, double h, double a, double b, const Parameters *p)
{
    Range f[N_TERMS];
    int one_way = 1;
    terms_over(t, h, a, b, p, f);
    for (int k = 0; k < N_PULSES && one_way; k++)
        one_way = f[k].down >= 0.0 || f[k].up <= 0.0;
    return one_way;
}

/* A place between shares a and b where a term acts unseen, and not harmless; 0: none. The part that may hide most is
 * halved first. */
static double undersampled_in_interval(double t, double h, double a, double b, const Range *low, const Range *high,
    const double *slack, Harmless *harmless, void *context, const Parameters *p)
{
    GapPart parts[GAP_PARTS + 1];
    int n = 0, looks = 0;
    if (!is_monotone(t, h, a, b, p))
        parts[n++] = interval_part(t, h, a, b, low, high, slack, p);
    while (n > 0) {
        int k = 0;
        for (int i = 1; i < n; i++)
            k = parts[i].most > parts[k].most ? i : k;
        const GapPart part = parts[k];
        const double middle = 0.5 * (part.from + part.to);
        const int told = part.surely >= 0.5 * part.most || n == GAP_PARTS || !(part.from < middle && middle < part.to);
        if (!(part.most > 0.0) || looks == MAX_HARMLESS)
            return 0.0;
        if (told && !harmless(context, middle, part.surely >= 0.5 * part.most))
            return middle;
        looks += told;
        if (told) {
            parts[k] = parts[--n];
        } else {
            parts[k] = interval_part(t, h, part.from, middle, low, high, slack, p);
            parts[n++] = interval_part(t, h, middle, part.to, low, high, slack, p);
        }
    }
    return 0.0;
}

/* The first share of the time h from t on where a term acts unseen by looks at `place` (from 0 to 1); 0: none. */
static double undersampled_term(double t, double h, const double *place, int n, Harmless *harmless, void *context,
    const Parameters *p)
{
    Range at[N_PLACES][N_TERMS];
    double slack[N_PULSES], fraction = 0.0;
    if (is_monotone(t, h, 0.0, 1.0, p))
        return 0.0; /* what it does shows at its ends */
    for (int i = 0; i < n; i++)
        terms_over(t, h, place[i], place[i], p, at[i]);
    for (int k = 0; k < N_PULSES; k++) {
        double least = INFINITY, most = -INFINITY;
        for (int i = 0; i < n; i++) {
            least = min_of(least, at[i][k].lo);
            most = max_of(most, at[i][k].lo);
        }
        slack[k] = UNSEEN * (most - least);
    }
    for (int i = 1; i < n && fraction == 0.0; i++)
        fraction =
            undersampled_in_interval(t, h, place[i - 1], place[i], at[i - 1], at[i], slack, harmless, context, p);
    return fraction;
}
#endif
