/*
 * Whether what a drive prescribes has no bounded second rate at time t, which lies at its corner, as (t - t0)^1.5 has
 * none at t0: from there to `apart` s beside it accelerations change far more than from there to twice as far, while
 * the state is the same.
 */
static int is_unbounded(Run *run, double t, double apart, const Parameters *p)
{
    const double beside = max_of(1e-6 * fabs(apart), 4.0 * DBL_EPSILON * fabs(t)); /* t may have the other side */
    const double way[4] = {0.0, apart < 0.0 ? -beside : beside, apart, 2.0 * apart};
    double dy[4][N_Y], here[N_CORNERS], there[N_CORNERS], most = 0.0;
    Aside aside;
    int some = 0;
    drive_corners(t, p, here);
    drive_corners(t + 2.0 * apart, p, there);
    if (is_crossed(here, there))
        return 0;
    for (int i = 0; i < 4; i++)
        if (rates(run, t + way[i], run->y, p, dy[i], &aside))
            return 0;
    for (int k = N_X; k < 2 * N_X; k++)
        most = max_of(most, fabs(dy[2][k]));
    for (int k = N_X; k < 2 * N_X; k++)
        some |= !isfinite(dy[0][k])
            || !(fabs(dy[1][k] - dy[2][k]) <= 20.0 * fabs(dy[2][k] - dy[3][k]) + 1e-9 * most);
    return some;
}

/* Beyond the jump of a drive's rate, at t; `apart` as of is_unbounded. */
static int pass_jump(Run *run, double t, double apart, const Parameters *p)
{
    run->t = t;
    defer_stop(&run->cancellation);
    pass_impulse(run, p);
    int status = rates(run, run->t, run->y, p, run->dy, &run->aside);
    if (!status && is_unbounded(run, t, apart, p))
        status = UNBOUNDED;
    if (!status)
        status = switch_friction(run, p); /* what sticks may be torn off, what slips turned round */
    if (!status)
        status = meet(run, -1, p);
    if (!status)
        status = note_leaps(run, NULL, p);
    if (!status)
        tape_jump(run, p);
    allow_stop(&run->cancellation);
    return status;
}

/* A part of a step, with samples where it begins: behind the last one of jumps that may be one number apart. */
static int rk4_part_beyond(Run *run, double h, double t_new, const Parameters *p, const Samples *out)
{
    sample_here(run, 0.0, p, out);
    return rk4_part(run, h, t_new, p, out);
}

/*
 * One step to t_new, in parts where a drive's rate jumps on the way: the grid stays as it was asked for. Jumps that are
 * rounded beyond its end, or begin it, lie at these. Where the lists are full between them it is not over, and what is
 * left of it follows at the next call.
 */
static int rk4_step(Run *run, double h, double t_new, const Parameters *p, const Samples *out)
{
    const double apart = 1e-6 * h;
    double before, after;
    int status = 0;
    if (t_new - run->t < h * SAME_LENGTH)
        h = t_new - run->t;
    count_step(run, 0);
    const double last = ahead_of(max_of(t_new, run->t + h));
    while (!status && next_jump(run->t, last, p, &before, &after)) {
        if (after > ahead_of(t_new)) { /* no stage may be rounded beyond it */
            h = way_to(run->t, t_new);
            break;
        }
        const double end = min_of(before, t_new);
        if (end > ahead_of(run->t) && is_unbounded(run, before, -apart, p)) {
            run->t = before;
            return UNBOUNDED;
        }
        if (end > ahead_of(run->t))
            status = rk4_part_beyond(run, way_to(run->t, end), end, p, out);
        if (!status)
            status = pass_jump(run, after, apart, p);
        h = way_to(run->t, t_new);
        if (!status && h > 0.0 && lists_full(run))
            return EVENTS_FULL;
        if (!status && h > 0.0 && run->cancellation.stop)
            return STOPPED;
    }
    if (!status && h > 0.0)
        status = rk4_part_beyond(run, h, t_new, p, out);
    run->t = min_of(run->t, t_new);
    return status;
}
