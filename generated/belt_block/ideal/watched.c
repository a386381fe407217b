/*
 * Ranges of the scene's own corners and of what the user watches over ranges of t, q and v.
 */
void watched_ranges(const Range t, const Range *q, const Range *v, const Memory *memory, const Parameters *p,
    Range *out)
{
    (void)t, (void)v, (void)memory;
    /* coordinates, velocities, time */
    const Range guide_slide_ = q[0];

    /* directions, arms, drives */
    const Range spring_span_x_ = range_add(guide_slide_, range_times(only(-1.0), only(p->wall_x_)));
    out[0] = spring_span_x_;
}
