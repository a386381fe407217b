/*
 * Poles of event functions: there a sign changes without an event.
 */
#if N_USER_EVENTS
enum { FAR_PLACES = 4 };

/* Event functions at share s of a step, straight on beyond its end; 0 for those that are below their uncertainty. */
static int events_at(Run *run, const Step *step, double s, const Parameters *p, double *value)
{
    double y[N_Y], dy[N_Y];
    Aside aside;
    if (s > 1.0)
        return events_ahead(run, step->t + step->h, (s - 1.0) * step->h, step->y, step->dy, p, value);
    const int status = state_at(run, step, s, p, y, dy, &aside);
    if (!status)
        resolved_events(run, step->t + s * step->h, y, &aside, p, value);
    return status;
}

/*
 * Whether event function i changes its sign at a pole and not at a zero: it is larger where it was located than at the
 * first place behind that where it is larger than its uncertainty. One that jumps from one finite value to another is
 * as large near it as far from it. Places are those of the dense output: what drives move does not go straight on.
 */
static int is_pole(Run *run, const Step *step, double share, int i, const Parameters *p)
{
    double y[N_Y], dy[N_Y], value[N_USER_EVENTS], ahead = root_width(run, step);
    Aside aside;
    if (state_at(run, step, share, p, y, dy, &aside))
        return 0;
    for (int n = 0; n < FAR_PLACES && isfinite(aside.event[i]); n++) {
        ahead *= 64.0;
        if (!events_at(run, step, share + ahead, p, value) && value[i] != 0.0)
            return fabs(aside.event[i]) > 2.0 * fabs(value[i]);
    }
    return isinf(aside.event[i]);
}
#else
static inline int is_pole(Run *run, const Step *step, double share, int i, const Parameters *p)
{
    return (void)run, (void)step, (void)share, (void)i, (void)p, 0;
}
#endif
