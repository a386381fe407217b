/*
 * What is noted of joints with play at accepted states: peaks, eccentricities, ratios of velocities.
 */
static inline Real total_force(const ClearanceOf *joint)
{
    return real_sqrt(joint->F_n * joint->F_n + joint->F_t * joint->F_t);
}

/* What deltadot is the rate of: the eccentricity, or of a bearing with a contour the penetration. */
static inline Real outward(const ClearanceOf *joint)
{
#ifdef CONTOURS
    return joint->delta;
#else
    return joint->e;
#endif
}

/* From an onset until the penetration first stops growing a contact is compressed. */
static inline void note_turn(RunOf *run, int i, Real deltadot)
{
    run->contacts.compressing[i] &= is_not(is_closed(&run->memory.latch[i]) & (deltadot <= 0.0));
}

/* Peaks of joint i at an accepted state, and the ratio deltadot/deltadot_minus of a contact. */
static inline void watch_joint(RunOf *run, int i)
{
    const ClearanceOf *joint = &run->aside.clearance[i];
    const Real F = total_force(joint);
    const Truth closed = is_closed(&run->memory.latch[i]), higher = F > run->contacts.F_peak[i];
    run->contacts.e_max[i] = real_max(joint->e, run->contacts.e_max[i]);
    run->contacts.F_peak[i] = pick(higher, F, run->contacts.F_peak[i]);
    run->contacts.t_peak[i] = pick(higher, run->t, run->contacts.t_peak[i]);
    if (!any_of(closed))
        return;
    const Truth highest = closed & (F > run->contacts.open[i].F_peak);
    run->contacts.open[i].F_peak = pick(highest, F, run->contacts.open[i].F_peak);
    run->contacts.open[i].t_peak = pick(highest, run->t, run->contacts.open[i].t_peak);
    if (!gives(i))
        return; /* no rate, so no ratio */
    const Real ratio = joint->deltadot / run->memory.latch[i].deltadot_minus;
    const Truth outside = (ratio < -1.0) | (ratio > 1.0);
    run->contacts.ratio_min = pick(closed & (ratio < run->contacts.ratio_min), ratio, run->contacts.ratio_min);
    run->contacts.ratio_max = pick(closed & (ratio > run->contacts.ratio_max), ratio, run->contacts.ratio_max);
    const Real more = run->contacts.ratio_outside + 1.0;
    run->contacts.ratio_outside = pick(closed & outside, more, run->contacts.ratio_outside);
}
