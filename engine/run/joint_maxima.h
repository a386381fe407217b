/*
 * What is noted of joints with play at accepted states: peaks, eccentricities, ratios of velocities.
 */
static inline double total_force(const Clearance *joint)
{
    return sqrt(joint->F_n * joint->F_n + joint->F_t * joint->F_t);
}

/* What deltadot is the rate of: the eccentricity, or of a bearing with a contour the penetration. */
static inline double outward(const Clearance *joint)
{
#ifdef CONTOURS
    return joint->delta;
#else
    return joint->e;
#endif
}

/* From an onset until the penetration first stops growing a contact is compressed. */
static inline void note_turn(Integrator *run, int i, double deltadot)
{
    run->contacts.compressing[i] &= !(is_closed(&run->discrete.contact[i]) & (deltadot <= 0.0));
}

/* Peaks of joint i at an accepted state, and the ratio deltadot/deltadot_minus of a contact. */
static inline void watch_joint(Integrator *run, int i)
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
        return; /* no rate, so no ratio */
    const double ratio = joint->deltadot / run->discrete.contact[i].deltadot_minus;
    const int outside = (ratio < -1.0) | (ratio > 1.0);
    run->contacts.ratio_min = pick(closed & (ratio < run->contacts.ratio_min), ratio, run->contacts.ratio_min);
    run->contacts.ratio_max = pick(closed & (ratio > run->contacts.ratio_max), ratio, run->contacts.ratio_max);
    const double more = run->contacts.ratio_outside + 1.0;
    run->contacts.ratio_outside = pick(closed & outside, more, run->contacts.ratio_outside);
}
