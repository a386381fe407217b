/*
 * Peaks of joints with play at accepted states: forces, eccentricities, ratios of penetration rate to approach speed.
 * Together with run/contacts.c this file owns Contacts (run/run.h).
 */

/* Return the magnitude of the force of a joint with play, N, from its normal and tangential components. */
static inline double compute_force_magnitude(const Clearance *clearance)
{
    return sqrt(clearance->F_n * clearance->F_n + clearance->F_t * clearance->F_t);
}

/*
 * Return the length in m whose rate is deltadot: the eccentricity, or the penetration in a scene with a bearing
 * contour.
 */
static inline double get_outward_coordinate(const Clearance *clearance)
{
#ifdef CONTOURS
    return clearance->delta;
#else
    return clearance->e;
#endif
}

/*
 * Clear the flag is_compressing of a joint if its contact is closed and the penetration has stopped growing (deltadot
 * <= 0, m/s). The flag is never set here. Called at each accepted state.
 */
static inline void update_compression(Integrator *run, int joint, double deltadot)
{
    run->contacts.is_compressing[joint] &= !(is_closed(&run->discrete.contact[joint]) & (deltadot <= 0.0));
}

/*
 * Update the peaks of a joint with play at an accepted state: largest eccentricity (m) and force (N) of the run. A
 * closed contact also updates its own largest force; in compliant contacts also the extremes of
 * deltadot/deltadot_minus, whose values outside [-1, 1] are counted.
 */
static inline void update_joint_peaks(Integrator *run, int joint)
{
    const Clearance *clearance = &run->rhs.clearance[joint];
    const double F = compute_force_magnitude(clearance);
    const int closed = is_closed(&run->discrete.contact[joint]), higher = F > run->contacts.F_peak[joint];
    run->contacts.e_max[joint] = max_of(clearance->e, run->contacts.e_max[joint]);
    run->contacts.F_peak[joint] = select_value(higher, F, run->contacts.F_peak[joint]);
    run->contacts.t_peak[joint] = select_value(higher, run->t, run->contacts.t_peak[joint]);
    if (!closed)
        return;
    const int highest = closed & (F > run->contacts.ongoing[joint].F_peak);
    run->contacts.ongoing[joint].F_peak = select_value(highest, F, run->contacts.ongoing[joint].F_peak);
    run->contacts.ongoing[joint].t_peak = select_value(highest, run->t, run->contacts.ongoing[joint].t_peak);
    if (!is_compliant(joint))
        return; /* rigid contacts have no rate */
    const double ratio = clearance->deltadot / run->discrete.contact[joint].deltadot_minus;
    const int outside = (ratio < -1.0) | (ratio > 1.0);
    run->contacts.ratio_min = select_value(closed & (ratio < run->contacts.ratio_min), ratio, run->contacts.ratio_min);
    run->contacts.ratio_max = select_value(closed & (ratio > run->contacts.ratio_max), ratio, run->contacts.ratio_max);
    const double more = run->contacts.ratio_outside + 1.0;
    run->contacts.ratio_outside = select_value(closed & outside, more, run->contacts.ratio_outside);
}
