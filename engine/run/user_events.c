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
        if ((!before || !have_same_sign(before[i], run->aside.event[i]))
            && event_crosses(i, &run->memory.event_side[i], run->aside.event[i])
            && note_event(run, i, run->t, run->y, p))
            status = ENDED;
    return status;
}

#if N_USER_EVENTS
/*
 * What lies right behind run->t, as far as times are located (tick, s): on the sides that are held (`here`), and on
 * those of there, which are held from now on (`beyond`).
 */
static int look_beyond(Run *run, double tick, const Parameters *p, Aside *here, Aside *beyond)
{
    const double h = max_of(4.0 * DBL_EPSILON * fabs(run->t), tick);
    double y[N_Y], dy[N_Y];
    for (int k = 0; k < N_Y; k++)
        y[k] = run->y[k] + h * run->dy[k];
    if (!run->memory.held)
        hold_sides(run);
    const int status = rates(run, run->t + h, y, p, dy, here);
    *beyond = *here;
    return status ? status : settle_at(run, run->t + h, y, dy, beyond, -1, p);
}

/* Whether event i is beyond its zero right behind run->t: it leaps there, or goes on from no further than that. */
static int is_beyond(const Run *run, int i, const Aside *here, const Aside *beyond)
{
    return have_same_sign(here->event[i], -beyond->event[i]) || fabs(here->event[i]) >= fabs(run->aside.event[i]);
}

/*
 * Events whose zero, or leap across it, is the end of the run, as far as times are located (tick, s). Returns ENDED
 * where one of them ends the run.
 */
static int end_on_zeros(Run *run, double tick, const Parameters *p)
{
    const Memory memory = run->memory;
    int status = 0;
    Aside here, beyond;
    if (look_beyond(run, tick, p, &here, &beyond)) {
        run->memory = memory;
        return 0;
    }
    run->memory = memory;
    for (int i = 0; i < N_USER_EVENTS; i++)
        if (event_crosses(i, &run->memory.event_side[i], beyond.event[i]) && is_beyond(run, i, &here, &beyond)
            && note_event(run, i, run->t, run->y, p))
            status = ENDED;
    return status;
}

/* A run that starts on a zero, or a leap, is beyond it: that was the end of what came before, and is not counted. */
static int begin_beyond(Run *run, double tick, const Parameters *p)
{
    Aside here, beyond;
    const Memory before = run->memory;
    int status = look_beyond(run, tick, p, &here, &beyond);
    for (int i = 0; i < N_USER_EVENTS && !status; i++)
        if (run->memory.event_side[i] * beyond.event[i] < 0.0 && is_beyond(run, i, &here, &beyond))
            run->memory.event_side[i] = (signed char)-run->memory.event_side[i];
    if (status || !memcmp(before.side, run->memory.side, sizeof before.side))
        return status;
    return rates(run, run->t, run->y, p, run->dy, &run->aside);
}

#endif
