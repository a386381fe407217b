/* Smallest gaps, gap rates and rebound speeds of rigid surfaces that a run can resolve in double precision. */
#define GAP_ROUNDING (16.0 * DBL_EPSILON) /* of the largest coordinate: gap to which separating surfaces are moved */
/* of the gap PARTED: separate_contacts() would add energy to bounces that rise less */
#define MIN_BOUNCE_HEIGHT 64.0
#define MIN_FLIGHT 64.0 /* of the time resolution of impacts: shorter bounces would gain energy as well */
#define MIN_ENERGY_LOSS 1e-3     /* smallest relative loss of energy of a bounce, so that neither error adds energy */
#define RESTING_FRACTION 1e-6   /* of the threshold: surfaces that close more slowly need no impact */
#define GAP_RATE_ROUNDING (1024.0 * DBL_EPSILON) /* of the largest velocity: smaller gap rates are rounding errors */

/*
 * Return the gap rate in m/s below which it is rounding: GAP_RATE_ROUNDING of the largest velocity component of a body.
 * Rates that were just set to 0 keep such residuals. Used for rigid contacts.
 */
static double compute_gap_rate_tolerance(const Integrator *run, const Parameters *p)
{
    double absolute_state[N_S], max_speed = 0.0;
    convert_integrated_to_absolute(run->t, run->y, &run->discrete, p, absolute_state);
    for (int k = 0; k < N_Q; k++)
        max_speed = max_of(max_speed, k % 3 < 2 ? fabs(absolute_state[N_Q + k]) : 0.0);
    return GAP_RATE_ROUNDING * max_speed;
}

/*
 * Return the gap in m below which it is rounding: GAP_ROUNDING of the largest coordinate of a body or clearance. Used
 * for rigid contacts.
 */
static double compute_gap_tolerance(const Integrator *run, const Parameters *p)
{
    double absolute_state[N_S], max_length = 0.0;
    convert_integrated_to_absolute(run->t, run->y, &run->discrete, p, absolute_state);
    for (int k = 0; k < N_Q; k++)
        max_length = max_of(max_length, k % 3 < 2 ? fabs(absolute_state[k]) : 0.0);
    for (int i = 0; i < N_CLEARANCES; i++)
        max_length = max_of(max_length, radial_clearance(p, i));
    return GAP_ROUNDING * max_length;
}

/*
 * Return the separation speed in m/s up to which a rigid contact closes: its threshold v_0, or that of a bounce too low
 * or too short to be resolved. min_gap: resolution of gaps, m (compute_gap_tolerance()).
 *
 * An error of an impact in gap g or time t adds 2 a g or 2 a u t to u^2, a being the acceleration. That must be less
 * than the (1 - e^2) u^2 that is lost.
 */
static double compute_closing_speed_limit(const Integrator *run, const Parameters *p, int joint, double min_gap)
{
    const double acceleration = max_of(compute_penetration_acceleration(&run->rhs.clearance[joint]), 0.0),
        e = restitution_of(p, joint);
    const double time_error = max_of(4.0 * DBL_EPSILON * fabs(run->t), run->roots.time_resolution);
    const double factor = 4.0 / max_of(MIN_ENERGY_LOSS, 1.0 - e * e);
    const double height = max_of(MIN_BOUNCE_HEIGHT, factor) * min_gap, flight = max_of(MIN_FLIGHT, factor) * time_error;
    return max_of(threshold_of(p, joint), max_of(sqrt(2.0 * acceleration * height), acceleration * flight));
}

/*
 * Return the approach speed in m/s up to which a rigid contact counts as resting and needs no impact: RESTING_FRACTION
 * of its threshold, at least min_rate, the smallest gap rate above rounding.
 */
static double compute_resting_speed_limit(double min_rate, const Parameters *p, int joint)
{
    return max_of(RESTING_FRACTION * threshold_of(p, joint), min_rate);
}
