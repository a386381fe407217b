/*
 * Events of the user: noted while the run goes on, looked for at its end.
 */
static void list_event(Run *run, int i, double t)
{
    if (run->n_events < N_IMPACTS) {
        run->event_t[run->n_events] = t;
        run->event[run->n_events++] = i;
    }
}

/* User event i at time t with the state there; whether it ends the run. */
static int note_event(Run *run, int i, double t, const double *now, const Parameters *p)
{
#if N_USER_EVENTS
    EventStates *at = event_states(run);
    if (run->n_events < N_IMPACTS)
        store_sample(run, t, now, p, run->n_events, at->y[0], at->latched[0], at->state[0]);
    list_event(run, i, t);
    return run->stop && event_stops[i];
#else
    (void)run, (void)i, (void)t, (void)now, (void)p;
    return 0;
#endif
}

/* User event i is no number at time t: told once a run, in the list of events behind all of them. */
static void note_no_number(Run *run, int i, double t)
{
    if (!run->no_number[i])
        list_event(run, i + N_USER_EVENTS, t);
    run->no_number[i] = 1;
}

/*
 * User events that something sudden led across their zeros, from what they were `before` (NULL: wherever they were);
 * whether one of them ends the run.
 */
static int note_leaps(Run *run, const double *before, const Parameters *p)
{
    int status = 0;
    for (int i = 0; i < N_USER_EVENTS; i++)
        if ((!before || !(before[i] * run->aside.event[i] > 0.0))
            && event_crosses(i, &run->memory.event_side[i], run->aside.event[i])
            && note_event(run, i, run->t, run->y, p))
            status = ENDED;
    return status;
}

#if N_USER_EVENTS
/*
 * Events whose zero is the end of the run: those that are zero there, or beyond it at once, as far as times are
 * located (tick, s). Returns ENDED where one of them ends the run.
 */
static int end_on_zeros(Run *run, double tick, const Parameters *p)
{
    int status = 0, zeros = 0;
    double y[N_Y], dy[N_Y];
    Aside aside;
    const double h = max_of(4.0 * DBL_EPSILON * fabs(run->t), tick);
    for (int i = 0; i < N_USER_EVENTS; i++)
        zeros |= run->memory.event_side[i] != 0;
    for (int k = 0; k < N_Y; k++)
        y[k] = run->y[k] + h * run->dy[k];
    if (!zeros || rates(run, run->t + h, y, p, dy, &aside))
        return 0;
    for (int i = 0; i < N_USER_EVENTS; i++)
        if (event_crosses(i, &run->memory.event_side[i], aside.event[i])
            && fabs(aside.event[i]) >= fabs(run->aside.event[i])
            && note_event(run, i, run->t, run->y, p))
            status = ENDED;
    return status;
}

#endif
