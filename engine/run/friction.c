/*
 * Friction that may stick: where the slip comes to zero, or the force of stick to its limit, the step ends
 * and the mode changes. The place is the root of the indicator over the length of a trial step.
 */
#if N_FRICTIONS
#define ROUNDING 1e-12 /* m/s: of a slip that others hold at zero */
enum { MAX_TRIES = 8 + 4 * N_FRICTIONS };

/* Positive while friction goes on as it is: what is left of the limit in stick, slip in its direction. */
static double friction_indicator(const DiscreteState *discrete, const RhsOutputs *rhs, int i)
{
    const Friction *friction = &rhs->friction[i];
    if (discrete->mode[i] == MODE_HELD)
        return AT_REST - fabs(friction->v);
    if (discrete->mode[i] == 0.0)
        return friction->static_limit - fabs(friction->force);
    return discrete->mode[i] * friction->v + ROUNDING;
}

/*
 * The right-hand side with the present modes. A stick whose pivot vanishes is held at rest by others already (a
 * drive, another stick): rigid bodies do not tell its force, and it gets none.
 */
static int rates_of_modes(Integrator *run, const Parameters *p)
{
    int status = rates(run, run->t, run->y, p, run->dy, &run->rhs);
    for (int i = 0; i < N_FRICTIONS && status > N_LOOPS && status <= N_LOOPS + N_FRICTIONS; i++) {
        run->discrete.mode[friction_of_pivot[status - N_LOOPS - 1]] = MODE_HELD;
        status = rates(run, run->t, run->y, p, run->dy, &run->rhs);
    }
    return status;
}

/* What sticks, or slips from rest, is exactly at rest where modes change: else rounding decides what follows. */
static int begin_at_rest(Integrator *run, const Parameters *p)
{
    const DiscreteState known = run->discrete;
    for (int i = 0; i < N_FRICTIONS; i++)
        if (run->discrete.mode[i] != MODE_HELD && fabs(run->rhs.friction[i].v) <= AT_REST)
            run->discrete.mode[i] = 0.0;
    const int status = rates_of_modes(run, p);
    if (!status)
        (void)remove_slip_residuals(run, run->t, run->y, &run->rhs, p);
    run->discrete = known;
    return status;
}

/*
 * Puts right the mode that is most wrong: a stick beyond its limit, a slip from rest against its own rate. Where a
 * stick is beyond its limit and another one is held, that one helps before the first gives way.
 */
static int correct_worst_mode(Integrator *run)
{
    int worst = -1, held = -1;
    double most = 1e-9, mode = 0.0;
    for (int i = 0; i < N_FRICTIONS; i++) {
        const Friction *friction = &run->rhs.friction[i];
        const double now = run->discrete.mode[i];
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
        run->discrete.mode[mode != 0.0 && held >= 0 ? held : worst] = mode;
    return worst >= 0;
}

/* Modes that agree with each other: one that changes may load or unload the others at once. */
static int update_modes(Integrator *run, const Parameters *p)
{
    for (int i = 0; i < N_FRICTIONS; i++)
        if (run->discrete.mode[i] == MODE_HELD && fabs(run->rhs.friction[i].v) <= AT_REST)
            run->discrete.mode[i] = 0.0;
    for (int i = 0; i < MAX_TRIES; i++) {
        const int status = rates_of_modes(run, p);
        if (status || !correct_worst_mode(run))
            return status;
    }
    return CHATTERING;
}

/* At the end of a part: every friction whose indicator is used up changes its mode. */
static int switch_friction(Integrator *run, const Parameters *p)
{
    for (int i = 0; i < N_FRICTIONS; i++) {
        const Friction *friction = &run->rhs.friction[i];
        double *mode = &run->discrete.mode[i];
        if (friction_indicator(&run->discrete, &run->rhs, i) > 0.0)
            continue;
        count_switch(run);
        if (*mode == 0.0) /* the limit is reached: it slips against the force */
            *mode = friction->force > 0.0 ? -1.0 : 1.0;
        else
            *mode = *mode == MODE_HELD ? (friction->v > 0.0 ? 1.0 : -1.0) : 0.0;
    }
    const int status = begin_at_rest(run, p);
    return status ? status : update_modes(run, p);
}

/* A start that does not say its mode: the sign of the slip, or stick where there is none. */
static int begin_friction(Integrator *run, const Parameters *p)
{
    int unknown = 0;
    for (int i = 0; i < N_FRICTIONS; i++) {
        const double v = run->rhs.friction[i].v;
        if (!isnan(run->discrete.mode[i]))
            continue;
        unknown = 1;
        run->discrete.mode[i] = fabs(v) <= AT_REST ? 0.0 : v > 0.0 ? 1.0 : -1.0;
    }
    return unknown ? update_modes(run, p) : 0;
}

#if N_RIGID
static int update_friction_modes(Integrator *run, const Parameters *p) { return update_modes(run, p); }

/* The modes behind a blow: what it moves slips. */
static int modes_after_impact(Integrator *run, const Parameters *p)
{
    const int status = rates(run, run->t, run->y, p, run->dy, &run->rhs);
    for (int i = 0; i < N_FRICTIONS && !status; i++) {
        const double v = run->rhs.friction[i].v;
        if (fabs(v) > AT_REST)
            run->discrete.mode[i] = v > 0.0 ? 1.0 : -1.0;
    }
    return status;
}
#endif

#else
/* No friction that may stick. */
static inline double friction_indicator(const DiscreteState *discrete, const RhsOutputs *rhs, int i)
{
    (void)discrete, (void)rhs, (void)i;
    return 1.0;
}

static inline int rates_at_rest(Integrator *run, double t, double *y, const Parameters *p, double *dy, RhsOutputs *rhs)
{
    return rates(run, t, y, p, dy, rhs);
}

static inline void hold_slips(Integrator *run, double t, double *y, const Parameters *p)
{
    (void)run, (void)t, (void)y, (void)p;
}

static inline int switch_friction(Integrator *run, const Parameters *p)
{
    (void)run, (void)p;
    return 0;
}

static inline int begin_friction(Integrator *run, const Parameters *p)
{
    (void)run, (void)p;
    return 0;
}

#if N_RIGID
static inline int update_friction_modes(Integrator *run, const Parameters *p)
{
    (void)run, (void)p;
    return 0;
}

static inline int modes_after_impact(Integrator *run, const Parameters *p)
{
    (void)run, (void)p;
    return 0;
}
#endif
#endif
