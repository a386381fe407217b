/*
 * What is noted of joints with play at accepted states: peaks, eccentricities, ratios of velocities.
 */
static inline Real total_force(const ClearanceOf *joint)
{
    return real_sqrt(joint->F_n * joint->F_n + joint->F_t * joint->F_t);
}

/* Place in (0, 1) and height of the top of the cubic through (d0, r0) and (d1, r1), slopes r0 > 0 > r1. */
static inline Real cubic_top(Real d0, Real r0, Real d1, Real r1, Real *height)
{
    const Real b = 3.0 * (d1 - d0) - 2.0 * r0 - r1, c = r0 + r1 - 2.0 * (d1 - d0);
    const Real s = r0 / (real_sqrt(b * b - 3.0 * c * r0) - b);
    *height = d0 + s * (r0 + s * (b + s * c));
    return s;
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

/* The largest eccentricity of joint i within a step of length h, where it turned back in it. */
static inline void watch_turn(RunOf *run, int i, double h, const ClearanceOf *before, const ClearanceOf *after)
{
    const Truth turned = (before->deltadot > 0.0) & (after->deltadot < 0.0);
    Real top;
    if (!any_of(turned))
        return;
    const Real s = cubic_top(outward(before), h * before->deltadot, outward(after), h * after->deltadot, &top);
#ifdef CONTOURS
    top += (1.0 - s) * (before->e - before->delta) + s * (after->e - after->delta);
#else
    (void)s;
#endif
    run->contacts.e_max[i] = real_max(pick(turned, top, run->contacts.e_max[i]), run->contacts.e_max[i]);
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
