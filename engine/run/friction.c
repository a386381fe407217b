/*
 * Friction that may stick: its modes, and their changes at events. A step ends where the slip reaches zero or the force
 * of stick reaches its limit: at the zero of friction_event_function() on the step.
 */
#if N_FRICTIONS
#define ROUNDING 1e-12 /* m/s: rounding of a slip that other constraints hold at zero */
enum { MAX_TRIES = 8 + 4 * N_FRICTIONS };

/*
 * Return the event function of friction element i, positive while its mode lasts: static limit minus |force| in stick
 * (N), slip in its direction otherwise (m/s).
 */
static double friction_event_function(const DiscreteState *discrete, const RhsOutputs *rhs, int i)
{
    const Friction *friction = &rhs->friction[i];
    if (discrete->mode[i] == MODE_HELD)
        return AT_REST - fabs(friction->v);
    if (discrete->mode[i] == 0.0)
        return friction->static_limit - fabs(friction->force);
    return discrete->mode[i] * friction->v + ROUNDING;
}

/*
 * Evaluate the right-hand side with the present friction modes. A sticking element whose pivot vanishes is already held
 * by a drive or another sticking element: its force is indeterminate, and it becomes MODE_HELD without force.
 */
static int evaluate_rates_of_modes(Integrator *run, const Parameters *p)
{
    int status = rates(run, run->t, run->y, p, run->dy, &run->rhs);
    for (int i = 0; i < N_FRICTIONS && status > N_LOOPS && status <= N_LOOPS + N_FRICTIONS; i++) {
        run->discrete.mode[friction_of_pivot[status - N_LOOPS - 1]] = MODE_HELD;
        status = rates(run, run->t, run->y, p, run->dy, &run->rhs);
    }
    return status;
}

/*
 * Set the slip of elements that stick or start to slip to exactly zero where modes change. Otherwise rounding would
 * decide the next mode.
 */
static int begin_at_rest(Integrator *run, const Parameters *p)
{
    const DiscreteState known = run->discrete;
    for (int i = 0; i < N_FRICTIONS; i++)
        if (run->discrete.mode[i] != MODE_HELD && fabs(run->rhs.friction[i].v) <= AT_REST)
            run->discrete.mode[i] = 0.0;
    const int status = evaluate_rates_of_modes(run, p);
    if (!status)
        (void)remove_slip_residuals(run, run->t, run->y, &run->rhs, p);
    run->discrete = known;
    return status;
}

/*
 * Correct the friction mode with the largest violation and return whether there was one. Violations are a sticking
 * force beyond its limit, or a slip from rest against its own rate. If an element would start to slip while another is
 * held, the held one slips instead, so that its force helps first.
 */
static int correct_worst_mode(Integrator *run)
{
    int worst = -1, held = -1;
    double largest = 1e-9, mode = 0.0;
    for (int i = 0; i < N_FRICTIONS; i++) {
        const Friction *friction = &run->rhs.friction[i];
        const double now = run->discrete.mode[i];
        double violation = 0.0, next = 0.0;
        if (now == 0.0) {
            violation = (fabs(friction->force) - friction->static_limit) / (friction->static_limit + 1e-300);
            next = friction->force > 0.0 ? -1.0 : 1.0;
        } else if (fabs(friction->v) <= AT_REST && fabs(friction->rate) > AT_REST) {
            violation = now == MODE_HELD || now * friction->rate < 0.0 ? 1.0 : 0.0;
            next = now != MODE_HELD ? 0.0 : friction->rate > 0.0 ? 1.0 : -1.0;
        }
        held = now == MODE_HELD && violation == 0.0 ? i : held;
        if (violation > largest) {
            worst = i;
            largest = violation;
            mode = next;
        }
    }
    if (worst >= 0)
        run->discrete.mode[mode != 0.0 && held >= 0 ? held : worst] = mode;
    return worst >= 0;
}

/*
 * Iterate the friction modes to a consistent set, since a change of one mode loads or unloads the others at once.
 * Return CHATTERING if there is none within MAX_TRIES.
 */
static int update_modes(Integrator *run, const Parameters *p)
{
    for (int i = 0; i < N_FRICTIONS; i++)
        if (run->discrete.mode[i] == MODE_HELD && fabs(run->rhs.friction[i].v) <= AT_REST)
            run->discrete.mode[i] = 0.0;
    for (int i = 0; i < MAX_TRIES; i++) {
        const int status = evaluate_rates_of_modes(run, p);
        if (status || !correct_worst_mode(run))
            return status;
    }
    return CHATTERING;
}

/* Change the mode of each friction element whose event function has reached zero, then update all modes. */
static int change_friction_modes(Integrator *run, const Parameters *p)
{
    for (int i = 0; i < N_FRICTIONS; i++) {
        const Friction *friction = &run->rhs.friction[i];
        double *mode = &run->discrete.mode[i];
        if (friction_event_function(&run->discrete, &run->rhs, i) > 0.0)
            continue;
        count_mode_change(run);
        if (*mode == 0.0) /* the limit is reached: it slips against the force */
            *mode = friction->force > 0.0 ? -1.0 : 1.0;
        else
            *mode = *mode == MODE_HELD ? (friction->v > 0.0 ? 1.0 : -1.0) : 0.0;
    }
    const int status = begin_at_rest(run, p);
    return status ? status : update_modes(run, p);
}

/* Set the modes that a start does not specify: the sign of the slip, or stick where the slip is zero. */
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
/* Iterate the friction modes to a consistent set while rigid contacts change. */
static int update_friction_modes(Integrator *run, const Parameters *p) { return update_modes(run, p); }

/* Set the friction modes after an impact: an element that the impact moves slips. */
static int update_modes_after_impact(Integrator *run, const Parameters *p)
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
/* Return a positive value: the scene has no friction that may stick. */
static inline double friction_event_function(const DiscreteState *discrete, const RhsOutputs *rhs, int i)
{
    (void)discrete, (void)rhs, (void)i;
    return 1.0;
}

/* Evaluate the right-hand side: the scene has no sticking friction whose slip must be removed. */
static inline int evaluate_rates_at_rest(
    Integrator *run, double t, double *y, const Parameters *p, double *dy, RhsOutputs *rhs)
{
    return rates(run, t, y, p, dy, rhs);
}

/* Leave the state unchanged: the scene has no friction that may stick. */
static inline void project_slips(Integrator *run, double t, double *y, const Parameters *p)
{
    (void)run, (void)t, (void)y, (void)p;
}

/* Return 0: the scene has no friction that may stick. */
static inline int change_friction_modes(Integrator *run, const Parameters *p)
{
    (void)run, (void)p;
    return 0;
}

/* Return 0: the scene has no friction modes to start with. */
static inline int begin_friction(Integrator *run, const Parameters *p)
{
    (void)run, (void)p;
    return 0;
}

#if N_RIGID
/* Return 0: the scene has no friction modes to update. */
static inline int update_friction_modes(Integrator *run, const Parameters *p)
{
    (void)run, (void)p;
    return 0;
}

/* Return 0: the scene has no friction modes that an impact changes. */
static inline int update_modes_after_impact(Integrator *run, const Parameters *p)
{
    (void)run, (void)p;
    return 0;
}
#endif
#endif
