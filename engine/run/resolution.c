/* The smallest gaps, rates of gaps and bounces of surfaces that do not give that rounding lets a run resolve. */
#define PARTED (16.0 * DBL_EPSILON) /* of how far out bodies are: so far apart surfaces are put that are to part */
#define LEAST_HEIGHT                                                                                                   \
    64.0 /* of that distance: a bounce that rises no higher is none, for separate_contacts() would feed it */
#define LEAST_FLIGHT 64.0 /* of the width to which blows are located, s: a shorter bounce is fed by that as well */
#define LOSSLESS 1e-3     /* of its energy: what a bounce loses at least, so that neither feeds it */
#define RESTING 1e-6   /* of the threshold: surfaces that close so slowly need no blow */
#define ROUNDED (1024.0 * DBL_EPSILON) /* of how fast bodies are: rates of gaps that are no larger are roundings */

/* The rates, m/s, up to which a gap has none: of those that have just been made 0 roundings are left. */
static double least_rate(const Integrator *run, const Parameters *p)
{
    double all[N_S], most = 0.0;
    to_absolute(run->t, run->y, &run->discrete, p, all);
    for (int k = 0; k < N_Q; k++)
        most = max_of(most, k % 3 < 2 ? fabs(all[N_Q + k]) : 0.0);
    return ROUNDED * most;
}

/* The roundings between which a gap is none, m. */
static double least_gap(const Integrator *run, const Parameters *p)
{
    double all[N_S], most = 0.0;
    to_absolute(run->t, run->y, &run->discrete, p, all);
    for (int k = 0; k < N_Q; k++)
        most = max_of(most, k % 3 < 2 ? fabs(all[k]) : 0.0);
    for (int i = 0; i < N_CLEARANCES; i++)
        most = max_of(most, radial_clearance(p, i));
    return PARTED * most;
}

/*
 * The parting speed, m/s, up to which contact i closes: v_0, or that of a bounce too low or too short to be resolved. A
 * blow that is located within a gap, or a time, away adds 2 g gap, or 2 g u time, to u^2: less than the (1 - e^2) u^2
 * that is lost.
 */
static double least_bounce(const Integrator *run, const Parameters *p, int i, double gap)
{
    const double pressed = max_of(outward_rate(&run->rhs.clearance[i]), 0.0), e = restitution_of(p, i);
    const double width = max_of(4.0 * DBL_EPSILON * fabs(run->t), run->roots.time_resolution);
    const double slow = 4.0 / max_of(LOSSLESS, 1.0 - e * e);
    const double height = max_of(LEAST_HEIGHT, slow) * gap, flight = max_of(LEAST_FLIGHT, slow) * width;
    return max_of(threshold_of(p, i), max_of(sqrt(2.0 * pressed * height), pressed * flight));
}

static double resting(double least, const Parameters *p, int i) { return max_of(RESTING * threshold_of(p, i), least); }
