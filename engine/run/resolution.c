/* Smallest gaps, gap rates and rebound speeds of rigid surfaces that rounding lets a run resolve. */
#define GAP_ROUNDING (16.0 * DBL_EPSILON) /* of the largest coordinate: gap to which separating surfaces are moved */
/* of the gap PARTED: separate_contacts() would add energy to bounces that rise less */
#define MIN_BOUNCE_HEIGHT 64.0
#define MIN_FLIGHT 64.0 /* of the time resolution of impacts: shorter bounces would gain energy as well */
#define MIN_ENERGY_LOSS 1e-3     /* smallest relative loss of energy of a bounce, so that neither error adds energy */
#define RESTING_FRACTION 1e-6   /* of the threshold: surfaces that close more slowly need no impact */
#define GAP_RATE_ROUNDING (1024.0 * DBL_EPSILON) /* of the largest velocity: smaller gap rates are rounding errors */

/* Return the gap rate in m/s below which it is rounding: rates that were just set to 0 keep such residuals. */
static double gap_rate_rounding(const Integrator *run, const Parameters *p)
{
    double all[N_S], most = 0.0;
    to_absolute(run->t, run->y, &run->discrete, p, all);
    for (int k = 0; k < N_Q; k++)
        most = max_of(most, k % 3 < 2 ? fabs(all[N_Q + k]) : 0.0);
    return GAP_RATE_ROUNDING * most;
}

/* Return the gap in m below which it is rounding, from the largest coordinate and clearance. */
static double gap_rounding(const Integrator *run, const Parameters *p)
{
    double all[N_S], most = 0.0;
    to_absolute(run->t, run->y, &run->discrete, p, all);
    for (int k = 0; k < N_Q; k++)
        most = max_of(most, k % 3 < 2 ? fabs(all[k]) : 0.0);
    for (int i = 0; i < N_CLEARANCES; i++)
        most = max_of(most, radial_clearance(p, i));
    return GAP_ROUNDING * most;
}

/*
 * Return the separation speed in m/s up to which contact i closes: v_0, or that of a bounce too low or too short to be
 * resolved. An error of an impact in gap g or time t adds 2 a g or 2 a u t to u^2, a being the acceleration. That must
 * be less than the (1 - e^2) u^2 that is lost.
 */
static double closing_speed_limit(const Integrator *run, const Parameters *p, int i, double gap)
{
    const double pressed = max_of(outward_rate(&run->rhs.clearance[i]), 0.0), e = restitution_of(p, i);
    const double width = max_of(4.0 * DBL_EPSILON * fabs(run->t), run->roots.time_resolution);
    const double slow = 4.0 / max_of(MIN_ENERGY_LOSS, 1.0 - e * e);
    const double height = max_of(MIN_BOUNCE_HEIGHT, slow) * gap, flight = max_of(MIN_FLIGHT, slow) * width;
    return max_of(threshold_of(p, i), max_of(sqrt(2.0 * pressed * height), pressed * flight));
}

/* Return the approach speed in m/s up to which contact i rests; least: the smallest gap rate above rounding. */
static double resting_speed_limit(double least, const Parameters *p, int i)
{
    return max_of(RESTING_FRACTION * threshold_of(p, i), least);
}
