/*
 * Events of the user along a step of rk4: found by the signs at both of its ends, located by halving.
 */
/* Share of h at which watched expression i first lies beyond zero, by halving: the step is tried again up to there. */
static double rk4_crossing(Run *run, int i, double h, const Parameters *p)
{
    const double close = max_of(4.0 * DBL_EPSILON * fabs(run->t) / h, 1e-12);
    double low = 0.0, high = 1.0, error[AT_LEAST_ONE(N_WATCHED)];
    Trial trial, far;
    while (high - low > close) {
        const double share = 0.5 * (low + high);
        if (rk4_try(run, share * h, p, &trial) || run->memory.event_side[i] * trial.aside.event[i] < 0.0)
            high = share;
        else
            low = share;
    }
    /* a pole, where it grows towards the place to values that are larger than their uncertainty, is no zero */
    if (rk4_try(run, high * h, p, &trial) || rk4_try(run, (high + 64.0 * close) * h, p, &far)
        || !(fabs(trial.aside.event[i]) > 2.0 * fabs(far.aside.event[i])))
        return high;
    uncertainty(run, run->t + high * h, trial.y, p, error);
    return fabs(trial.aside.event[i]) > error[N_WATCHED - N_USER_EVENTS + i] ? INFINITY : high;
}

/* Whether expression i, zero at the end of a trial, is beyond it at once: the end of a run counts as the way to it. */
static int rk4_leaves_zero(Run *run, int i, double h, const Trial *trial, const Parameters *p)
{
#if N_USER_EVENTS
    signed char side = run->memory.event_side[i];
    double value[N_USER_EVENTS];
    return trial->aside.event[i] == 0.0 && !events_ahead(run, run->t + h, 1e-6 * h, trial->y, trial->dy, p, value)
        && event_crosses(i, &side, value[i]);
#else
    return (void)run, (void)i, (void)h, (void)trial, (void)p, 0;
#endif
}

/* User event i at a share of a step: the state is that of the step up to there, its contacts as the gaps are. */
static void rk4_note_event(Run *run, int i, double share, double h, const Parameters *p)
{
#if N_USER_EVENTS
    Trial at;
    const int k = run->events.n, lost = rk4_try(run, share * h, p, &at);
    for (int j = 0; lost && j < N_Y; j++)
        at.y[j] = NAN;
    (void)note_event(run, i, run->t + share * h, at.y, p);
    for (int j = 0; j < N_CLEARANCES && k < LISTED_EVENTS && !lost; j++) {
        const Clearance *gap = &at.aside.clearance[j];
        double *latched = &event_states(run)->latched[k][j];
        signed char *state = &event_states(run)->state[k][j];
        if (!gives(j))
            continue;
        if (gap->delta <= 0.0) {
            *latched = NAN;
            *state = CODE_FREE;
        } else if (*state == CODE_FREE) {
            *latched = gap->deltadot;
            *state = CODE_IMPACT;
        }
    }
#else
    (void)run, (void)i, (void)share, (void)h, (void)p;
#endif
}

/* User events on the way of a step; one that ends the run takes the step up to there. */
static int rk4_events(Run *run, double h, const Trial *trial, const Parameters *p, const Samples *out)
{
    double share[AT_LEAST_ONE(N_USER_EVENTS)], value[AT_LEAST_ONE(N_USER_EVENTS)], end = INFINITY;
    resolved_events(run, run->t + h, trial->y, &trial->aside, p, value);
    for (int i = 0; i < N_USER_EVENTS; i++) {
        signed char side = run->memory.event_side[i];
        share[i] = event_crosses(i, &side, value[i]) ? rk4_crossing(run, i, h, p) : INFINITY;
        if (rk4_leaves_zero(run, i, h, trial, p)) {
            share[i] = 1.0;
            run->memory.event_side[i] *= -1;
        }
        if (isnan(trial->aside.event[i]))
            note_no_number(run, i, run->t + h);
        if (run->events.stop && event_stops[i])
            end = min_of(end, share[i]);
    }
    if (run->cancellation.stop)
        return STOPPED; /* what was found meanwhile means nothing */
    defer_stop(&run->cancellation);
    for (int i = 0; i < N_USER_EVENTS; i++) {
        event_crosses(i, &run->memory.event_side[i], value[i]);
        if (share[i] <= end && isfinite(share[i]))
            rk4_note_event(run, i, share[i], h, p);
    }
    allow_stop(&run->cancellation);
    if (!isfinite(end))
        return 0;
    Trial last;
    const int status = rk4_try(run, end * h, p, &last);
    const int failed = status ? status : accept(run, end * h, run->t + end * h, &last, p, out);
    return failed ? failed : ENDED;
}
