/*
 * Friction that may stick: where the slip comes to zero, or the force of stick to its limit, the step ends
 * and the mode changes. The place is the root of the indicator over the length of a trial step.
 */
#if N_FRICTIONS
#define ROUNDING 1e-12 /* m/s: of a slip that others hold at zero */
enum { MAX_TRIES = 8 + 4 * N_FRICTIONS };

/* Positive while friction goes on as it is: what is left of the limit in stick, slip in its direction. */
static double indicator(const Memory *memory, const Aside *aside, int i)
{
    const Friction *friction = &aside->friction[i];
    if (memory->mode[i] == MODE_HELD)
        return AT_REST - fabs(friction->v);
    if (memory->mode[i] == 0.0)
        return friction->static_limit - fabs(friction->force);
    return memory->mode[i] * friction->v + ROUNDING;
}

/*
 * The right-hand side with the present modes. A stick whose pivot vanishes is held at rest by others already (a
 * drive, another stick): rigid bodies do not tell its force, and it gets none.
 */
static int rates_of_modes(Run *run, const Parameters *p)
{
    int status = rates(run, run->t, run->y, p, run->dy, &run->aside);
    for (int i = 0; i < N_FRICTIONS && status > N_LOOPS && status <= N_LOOPS + N_FRICTIONS; i++) {
        run->memory.mode[friction_of_pivot[status - N_LOOPS - 1]] = MODE_HELD;
        status = rates(run, run->t, run->y, p, run->dy, &run->aside);
    }
    return status;
}

/* What sticks, or slips from rest, is exactly at rest where modes change: else rounding decides what follows. */
static int begin_at_rest(Run *run, const Parameters *p)
{
    const Memory known = run->memory;
    for (int i = 0; i < N_FRICTIONS; i++)
        if (run->memory.mode[i] != MODE_HELD && fabs(run->aside.friction[i].v) <= AT_REST)
            run->memory.mode[i] = 0.0;
    const int status = rates_of_modes(run, p);
    if (!status)
        (void)stop_slips(run, run->t, run->y, &run->aside, p);
    run->memory = known;
    return status;
}

/*
 * Puts right the mode that is most wrong: a stick beyond its limit, a slip from rest against its own rate. Where a
 * stick is beyond its limit and another one is held, that one helps before the first gives way.
 */
static int mend_modes(Run *run)
{
    int worst = -1, held = -1;
    double most = 1e-9, mode = 0.0;
    for (int i = 0; i < N_FRICTIONS; i++) {
        const Friction *friction = &run->aside.friction[i];
        const double now = run->memory.mode[i];
        double wrong = 0.0, next = 0.0;
        if (now == 0.0) {
            wrong = (fabs(friction->force) - friction->static_limit) / (friction->static_limit + 1e-300);
            next = friction->force > 0.0 ? -1.0 : 1.0;
        } else if (fabs(friction->v) <= AT_REST && fabs(friction->rate) > AT_REST) {
            wrong = now == MODE_HELD || now * friction->rate < 0.0 ? 1.0 : 0.0;
            next = now != MODE_HELD ? 0.0 : friction->rate > 0.0 ? 1.0 : -1.0;
        }
        held = now == MODE_HELD && wrong == 0.0 ? i : held;
        if (wrong > most) {
            worst = i;
            most = wrong;
            mode = next;
        }
    }
    if (worst >= 0)
        run->memory.mode[mode != 0.0 && held >= 0 ? held : worst] = mode;
    return worst >= 0;
}

/* Modes that agree with each other: one that changes may load or unload the others at once. */
static int settle(Run *run, const Parameters *p)
{
    for (int i = 0; i < N_FRICTIONS; i++)
        if (run->memory.mode[i] == MODE_HELD && fabs(run->aside.friction[i].v) <= AT_REST)
            run->memory.mode[i] = 0.0;
    for (int i = 0; i < MAX_TRIES; i++) {
        const int status = rates_of_modes(run, p);
        if (status || !mend_modes(run))
            return status;
    }
    return CHATTERING;
}

/* At the end of a part: every friction whose indicator is used up changes its mode. */
static int switch_friction(Run *run, const Parameters *p)
{
    for (int i = 0; i < N_FRICTIONS; i++) {
        const Friction *friction = &run->aside.friction[i];
        double *mode = &run->memory.mode[i];
        if (indicator(&run->memory, &run->aside, i) > 0.0)
            continue;
        count_switch(run);
        if (*mode == 0.0) /* the limit is reached: it slips against the force */
            *mode = friction->force > 0.0 ? -1.0 : 1.0;
        else
            *mode = *mode == MODE_HELD ? (friction->v > 0.0 ? 1.0 : -1.0) : 0.0;
    }
    const int status = begin_at_rest(run, p);
    return status ? status : settle(run, p);
}

/* A start that does not say its mode: the sign of the slip, or stick where there is none. */
static int begin_friction(Run *run, const Parameters *p)
{
    int unknown = 0;
    for (int i = 0; i < N_FRICTIONS; i++) {
        const double v = run->aside.friction[i].v;
        if (!isnan(run->memory.mode[i]))
            continue;
        unknown = 1;
        run->memory.mode[i] = fabs(v) <= AT_REST ? 0.0 : v > 0.0 ? 1.0 : -1.0;
    }
    return unknown ? settle(run, p) : 0;
}

#if N_RIGID
static int settle_friction(Run *run, const Parameters *p) { return settle(run, p); }

/* The modes behind a blow: what it moves slips. */
static int slip_after_blow(Run *run, const Parameters *p)
{
    const int status = rates(run, run->t, run->y, p, run->dy, &run->aside);
    for (int i = 0; i < N_FRICTIONS && !status; i++) {
        const double v = run->aside.friction[i].v;
        if (fabs(v) > AT_REST)
            run->memory.mode[i] = v > 0.0 ? 1.0 : -1.0;
    }
    return status;
}
#endif

#else
/* No friction that may stick. */
static inline double indicator(const Memory *memory, const Aside *aside, int i)
{
    (void)memory, (void)aside, (void)i;
    return 1.0;
}

static inline int rates_at_rest(Run *run, double t, double *y, const Parameters *p, double *dy, Aside *aside)
{
    return rates(run, t, y, p, dy, aside);
}

static inline void hold_slips(Run *run, double t, double *y, const Parameters *p)
{
    (void)run, (void)t, (void)y, (void)p;
}

static inline int switch_friction(Run *run, const Parameters *p)
{
    (void)run, (void)p;
    return 0;
}

static inline int begin_friction(Run *run, const Parameters *p)
{
    (void)run, (void)p;
    return 0;
}

#if N_RIGID
static inline int settle_friction(Run *run, const Parameters *p)
{
    (void)run, (void)p;
    return 0;
}

static inline int slip_after_blow(Run *run, const Parameters *p)
{
    (void)run, (void)p;
    return 0;
}
#endif
#endif
