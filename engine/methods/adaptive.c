/*
 * Methods that choose their step (step_length.c): what a step that is accepted changes, events on its way, samples from
 * its interpolant.
 */
enum { MAX_AGAIN = 8 }; /* times that a step is taken again to end close behind an event */

/* Takes a step, or its part up to an event, as the new state. */
static int commit(Run *run, Step *step, double share, double t_new, int event, const Parameters *p)
{
    /* the interpolant is made already where the step ends early: its end may be replaced */
    int status = share < 1.0 ? state_at(run, step, share, p, step->y, step->dy, &step->aside) : 0;
    if (status)
        return status;
    inner_peaks(run, step, share, p);
    turn_passed(run, step);
    for (int k = 2 * N_X; k < 2 * N_X + N_WORK; k++)
        run->turned_over += fabs(step->y[k] - run->y[k]);
    for (int k = 0; k < N_Y; k++) {
        run->y[k] = step->y[k];
        run->dy[k] = step->dy[k];
    }
    run->aside = step->aside;
    run->stuck = event >= 0 && t_new - run->t < 1e-9 * step->h ? run->stuck + 1 : 0;
    run->t = t_new;
    run->steps++;
    run->stiff_steps += step->method->stiff;
    run->ended[event < 0 ? N_MARGINS : event]++;
    run->linear_ready = 0;
    note_speed(run);
    weigh(run);
    for (int i = 0; i < N_CLEARANCES; i++)
        if (run->memory.latch[i].closed && run->aside.clearance[i].deltadot <= 0.0)
            run->compressing[i] = 0;
    const double drift = run->phi_dot_max; /* at the corner of a drive rates are those before the impulse */
    status = watch(run, p);
    if (N_CORNERS > 0 && event >= N_CLEARANCES && event < N_CLEARANCES + N_SWITCHES)
        run->phi_dot_max = drift;
    if (!status && event < 0 && run->skip >= 0) { /* away from the corner, on whichever side */
        run->skip = -1;
        status = settle_sides(run, -1, p);
    }
    for (int i = 0; i < N_USER_EVENTS; i++) /* begun on a zero: wherever it went */
        if (run->memory.event_side[i] == 0)
            event_crosses(i, &run->memory.event_side[i], run->aside.event[i]);
    if (!status && event >= 0)
        status = run->stuck > MAX_STUCK + 2 * N_MARGINS ? CHATTERING : change(run, event, p);
    return status ? status : check_contacts(run, p);
}

/* The side of what is watched and begins on a zero: that to which it goes. */
static int leave_zeros(Run *run, const Parameters *p)
{
    int zeros = 0;
    for (int i = 0; i < N_USER_EVENTS; i++)
        zeros |= run->memory.event_side[i] == 0;
    if (!zeros)
        return 0;
    double y[N_Y], dy[N_Y];
    Aside aside;
    const double h = 1e-6 * run->h;
    for (int k = 0; k < N_Y; k++)
        y[k] = run->y[k] + h * run->dy[k];
    const int status = rates(run, run->t + h, y, p, dy, &aside);
    for (int i = 0; i < N_USER_EVENTS; i++)
        if (run->memory.event_side[i] == 0)
            event_crosses(i, &run->memory.event_side[i], aside.event[i]);
    return status;
}

/*
 * What a speed counts at least: a hundredth of what leads over the smallest length that matters in the shortest time
 * that the start's speeds and accelerations take for it. Only where these lead nowhere (a pulse is yet to come) the
 * run's own time has to tell.
 */
static void floor_speeds(Run *run, double left)
{
    double rate = 0.0;
    for (int k = 0; k < N_X; k++) {
        const double least = run->least[is_angle[k]], a = fabs(run->dy[N_X + k]);
        rate = max_of(rate, max_of(fabs(run->y[N_X + k]) / least, sqrt(a / least)));
    }
    for (int kind = 0; kind < 2; kind++)
        run->speed_floor[kind] = run->least[kind] * (rate * left > 1e-3 ? 0.01 * rate : 1.0 / left);
}

/* The first right-hand side, with contacts, friction and sides as the start has them, held from now on. */
static int begin_adaptive(Run *run, double left, const Parameters *p)
{
    int status = run->ready ? 0 : begin_run(run, p);
    run->tick = min_of(1e-12, 1e-11 * left);
    hold_sides(run);
    if (!status)
        status = settle_sides(run, -1, p);
    floor_speeds(run, left);
    note_speed(run);
    run->turned_over = energy_scale(run, p);
    weigh(run);
#if N_CORNERS
    if (!status)
        status = pass_jumps_here(run, p); /* to the sides that hold there */
#endif
#if N_USER_EVENTS
    if (!status)
        status = begin_beyond(run, run->tick, p);
#endif
    if (!status && !(run->h > 0.0))
        status = first_size(run, left, p);
    return status ? status : leave_zeros(run, p);
}

/*
 * method: that begins, as gudgeon_method counts; automatic: whether it may change; scale (2 N_X): tolerances, those of
 * velocities a unit of speed; least: the smallest length (m) and angle (rad) that matter.
 */
void gudgeon_adaptive_setup(void *memory, int method, int automatic, const double *scale, const double *least,
    double fixed)
{
    Run *run = memory;
    run->method = METHODS[method];
    run->automatic = automatic;
    run->patience = automatic && run->method->stiff ? 4 * PATIENCE : PATIENCE;
    run->fixed = fixed;
    run->error_before = 1e-4;
    run->crossed = run->skip = -1;
    run->accept = fixed > 0.0 ? INFINITY : 1.0;
    for (int k = 0; k < 2 * N_X; k++)
        run->inverse_scale[k] = 1.0 / scale[k];
    run->work_scale = max_of(1e-10, WORKS * scale[2 * N_X - 1]); /* below it a sum of works is rounded */
    run->least[0] = least[0];
    run->least[1] = least[1];
}

/* Samples of the step before `t_new`, from its interpolant. */
static int sample_step(Run *run, Step *step, double t_new, long n, const double *t, const Parameters *p,
    double *y, double *latched, signed char *state, long *done)
{
    const long evaluations = run->evaluations;
    while (*done < n && t[*done] < t_new) {
        double now[N_Y];
        const int status = make_dense(run, p, step);
        if (status)
            return status;
        interpolate(run, step, (t[*done] - step->t) / step->h, now);
        project_state(run, t[*done], now, p);
        store_sample(run, t[*done], now, p, *done, y, latched, state);
        ++*done;
    }
    run->evaluations = evaluations; /* samples are output, not integration */
    return 0;
}

/*
 * Rows of the tape inside a step, up to a share of it, before it is taken: the ends of parts, and right beside its own
 * ends where something changes there (`jumps`: at the last one).
 */
static int tape_step(Run *run, Step *step, double share, int jumps, const Parameters *p)
{
    const long evaluations = run->evaluations;
    const double located = max_of(64.0 * DBL_EPSILON * fabs(step->t), 4.0 * run->tick) / step->h;
    const double beside = max_of(BESIDE * share, located);
    if (!run->tape.rows)
        return 0;
    int status = make_dense(run, p, step);
    for (int k = !run->tape.jumped; k < TAPE_PARTS + jumps && !status; k++) {
        const double s = k == 0 ? beside : k == TAPE_PARTS ? share - beside : share * k / TAPE_PARTS;
        const double t = step->t + s * step->h;
        double now[N_Y];
        if (!(s > 0.0 && s < share && t > step->t))
            continue; /* so short a step is all beside the jump */
        interpolate(run, step, s, now);
        project_state(run, t, now, p);
        tape_row(run, t, now, p);
    }
    run->evaluations = evaluations; /* as of samples */
    return status;
}

/* The end of a step that is taken; where something changed there, it follows with the next step if there is one. */
static void tape_end(Run *run, int jumped, int is_last, const Parameters *p)
{
    run->tape.jumped |= jumped;
    if (!jumped || is_last)
        tape_row(run, run->t, run->y, p);
}

/* Whether the run no longer advances; what ends its steps is counted anew with each look at its pace. */
static int stalls(Run *run, double t_end)
{
    const int stalled = creeps(&run->advance, run->t, t_end);
    for (int k = 0; k < N_MARGINS && !stalled && run->advance.steps % PACE_STEPS == 1; k++)
        run->ended[k] = 0;
    return stalled;
}

/*
 * The first event of a step that was accepted, as its share; 1 and -1 where there is none. A period of mod is held half
 * a period beyond its end: a step that reaches further ends on rows of another one, which its interpolant then leads
 * to. Taken again from before, it ends close behind the event, wherever that is.
 */
static int event_of_step(Run *run, double t_end, const Parameters *p, Step *step, double *share, int *event)
{
    int status = 0;
    *share = first_event(run, step, p, event);
#if PERIODS
    for (int k = 0; k < MAX_AGAIN && !status && *event >= 0 && 1.1 * *share < 1.0 && run->fixed <= 0.0; k++) {
        const double next = run->h, h = 1.1 * *share * step->h;
        if (h <= run->tick)
            break; /* it lies at the step's beginning, where no row is another one */
        run->h = h;
        status = accepted_step(run, t_end, p, step);
        run->h = next;
        if (!status)
            *share = first_event(run, step, p, event);
    }
#else
    (void)t_end;
#endif
    return status;
}

/*
 * Towards the last of n output times, at most `limit` steps: samples go to row `done` and on. Returns 0 (at the end,
 * or to be called again), EVENTS_FULL, STOPPED, or what went wrong. Whatever it returns, the run is at the end of a
 * whole step, with what changes there.
 */
int gudgeon_adaptive_run(void *memory, const double *parameters, long n, const double *t, long limit,
    double *y, double *latched, signed char *state, long *done)
{
    Run *run = memory;
    const Parameters *p = (const Parameters *)parameters;
    const double t_end = t[n - 1];
    const int begins = !run->memory.held;
    int status = begins ? begin_adaptive(run, t_end - run->t, p) : 0;
    if (!status && begins)
        tape_jump(run, p);
    run->tape.jumped |= begins;
    for (long i = 0; !status; i++) {
        while (*done < n && t[*done] <= run->t) {
            store_sample(run, run->t, run->y, p, *done, y, latched, state);
            ++*done;
        }
        if (*done == n || i == limit)
            return 0;
        if (run->asked.stop)
            return STOPPED;
        if (lists_full(run))
            return EVENTS_FULL;
        if (run->fixed <= 0.0 && stalls(run, t_end))
            return STALLED;
        Step *step = &run->step;
        status = accepted_step(run, t_end, p, step);
        if (status)
            break;
        choose(run);
        int event;
        double share;
        status = event_of_step(run, t_end, p, step, &share, &event);
        if (status)
            break;
        if (run->asked.stop)
            return STOPPED; /* what was found meanwhile means nothing */
        const double t_whole = step->h == t_end - run->t ? t_end : run->t + step->h;
        const double t_new = share < 1.0 ? run->t + share * step->h : t_whole;
        /* what is so near is at the event */
        const double close = event < 0 ? 0.0 : max_of(8.0 * DBL_EPSILON * fabs(t_new), 2.0 * run->tick);
        status = sample_step(run, step, t_new - close, n, t, p, y, latched, state, done);
        const int jumps = (event >= 0 && event < N_MARGINS - N_USER_EVENTS) || (N_CORNERS > 0 && t_new == t_end);
        if (!status)
            status = tape_step(run, step, share, jumps, p);
        run->asked.hold = 1;
#if N_CORNERS
        const double drift = run->phi_dot_max;
#endif
        if (!status)
            status = commit(run, step, share, t_new, event, p);
        run->memory.held = 1;
#if N_CORNERS
        if (!status && run->t == t_end) {
            run->phi_dot_max = drift; /* which branch a rate has at a jump's own time says nothing */
            status = pass_jumps_here(run, p);
        }
#endif
#if N_USER_EVENTS
        if (!status && run->t == t_end)
            status = end_on_zeros(run, run->tick, p);
#endif
        if (!status || status == ENDED)
            tape_end(run, jumps, status == ENDED || run->t == t_end, p);
        run->asked.hold = 0;
    }
    return status;
}
