/*
 * Peaks of joints with play at accepted states: forces, eccentricities, velocity ratios. Together with run/contacts.c
 * this file owns Contacts (run/run.h).
 */

/* Return the magnitude of the force of a joint with play, N. */
static inline double total_force(const Clearance *joint)
{
    return sqrt(joint->F_n * joint->F_n + joint->F_t * joint->F_t);
}

/* Return the length in m whose rate is deltadot: the eccentricity, or the penetration for a bearing with a contour. */
static inline double outward_coordinate(const Clearance *joint)
{
#ifdef CONTOURS
    return joint->delta;
#else
    return joint->e;
#endif
}

/* End the compression of joint i's contact if the penetration has stopped growing. */
static inline void update_compression(Integrator *run, int i, double deltadot)
{
    run->contacts.is_compressing[i] &= !(is_closed(&run->discrete.contact[i]) & (deltadot <= 0.0));
}

/* Update the peaks of joint i at an accepted state, and the extremes of deltadot/deltadot_minus of a contact. */
static inline void update_joint_peaks(Integrator *run, int i)
{
    const Clearance *joint = &run->rhs.clearance[i];
    const double F = total_force(joint);
    const int closed = is_closed(&run->discrete.contact[i]), higher = F > run->contacts.F_peak[i];
    run->contacts.e_max[i] = max_of(joint->e, run->contacts.e_max[i]);
    run->contacts.F_peak[i] = pick(higher, F, run->contacts.F_peak[i]);
    run->contacts.t_peak[i] = pick(higher, run->t, run->contacts.t_peak[i]);
    if (!closed)
        return;
    const int highest = closed & (F > run->contacts.open[i].F_peak);
    run->contacts.open[i].F_peak = pick(highest, F, run->contacts.open[i].F_peak);
    run->contacts.open[i].t_peak = pick(highest, run->t, run->contacts.open[i].t_peak);
    if (!gives(i))
        return; /* rigid contacts have no rate */
    const double ratio = joint->deltadot / run->discrete.contact[i].deltadot_minus;
    const int outside = (ratio < -1.0) | (ratio > 1.0);
    run->contacts.ratio_min = pick(closed & (ratio < run->contacts.ratio_min), ratio, run->contacts.ratio_min);
    run->contacts.ratio_max = pick(closed & (ratio > run->contacts.ratio_max), ratio, run->contacts.ratio_max);
    const double more = run->contacts.ratio_outside + 1.0;
    run->contacts.ratio_outside = pick(closed & outside, more, run->contacts.ratio_outside);
}
