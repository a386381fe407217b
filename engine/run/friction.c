/*
 * Stick-slip: friction elements that can stick, their modes, and the changes of these modes at events. A step ends
 * where the slip reaches zero or the force of stick reaches its limit: at the zero of
 * evaluate_friction_event_function() on the step.
 *
 * Modes of an element (DiscreteState.mode): 0 sticks, with the force that keeps its slip at zero; 1 or -1 slips in that
 * direction against its kinetic force; MODE_CONSTRAINED (2) is at rest without a force, because drives or other
 * friction elements hold its slip at zero.
 */
#if N_FRICTIONS
#define MAX_STICK_RESIDUAL (10.0 * MAX_STICK_SPEED) /* m/s: of a sticking element, by errors of integration */
#define SLIP_ROUNDING 1e-12 /* m/s: rounding of a slip that other constraints hold at zero */
enum { MAX_MODE_PASSES = 8 + 4 * N_FRICTIONS };

/*
 * Return the event function of a friction element, positive while its mode (stick or slip) lasts. In stick: static
 * limit minus |force| in N. In slip: the slip velocity in its direction plus SLIP_ROUNDING, m/s. Held by other
 * constraints (MODE_CONSTRAINED): MAX_STICK_SPEED minus |slip|, m/s.
 */
static double evaluate_friction_event_function(const DiscreteState *discrete, const RhsOutputs *rhs, int element)
{
    const Friction *friction = &rhs->friction[element];
    if (discrete->mode[element] == MODE_CONSTRAINED)
        return MAX_STICK_SPEED - fabs(friction->v);
    if (discrete->mode[element] == 0.0)
        return friction->static_limit - fabs(friction->force);
    return discrete->mode[element] * friction->v + SLIP_ROUNDING;
}

/*
 * Evaluate the right-hand side at the current state with the current friction modes, into run->dy and run->rhs. A
 * sticking element whose pivot vanishes is already constrained by a drive or another sticking element: it becomes
 * MODE_CONSTRAINED, without force, and the evaluation is repeated. Return 0 or a status.
 */
static int evaluate_rates_with_friction_modes(Integrator *run, const Parameters *p)
{
    int status = evaluate_run_rhs(run, run->t, run->y, p, run->dy, &run->rhs);
    for (int i = 0; i < N_FRICTIONS && status > N_LOOPS && status <= N_LOOPS + N_FRICTIONS; i++) {
        run->discrete.mode[friction_of_pivot[status - N_LOOPS - 1]] = MODE_CONSTRAINED;
        status = evaluate_run_rhs(run, run->t, run->y, p, run->dy, &run->rhs);
    }
    return status;
}

/*
 * Remove the slip of elements with at most MAX_STICK_SPEED (m/s) by impulses of their friction, where modes change.
 * Otherwise rounding would decide the next mode. The discrete state is restored; velocities and the right-hand side
 * change. Return 0 or a status. Called by change_friction_modes() before the modes are iterated.
 */
static int remove_slips_at_rest(Integrator *run, const Parameters *p)
{
    const DiscreteState discrete = run->discrete;
    for (int i = 0; i < N_FRICTIONS; i++)
        if (run->discrete.mode[i] != MODE_CONSTRAINED && fabs(run->rhs.friction[i].v) <= MAX_STICK_SPEED)
            run->discrete.mode[i] = 0.0;
    const int status = evaluate_rates_with_friction_modes(run, p);
    if (!status)
        (void)remove_slip_residuals(run, run->t, run->y, &run->rhs, p);
    run->discrete = discrete;
    return status;
}

/*
 * Correct the friction mode with the largest violation (modes: DiscreteState in scene/types.h) and return whether there
 * was one. Violations are a sticking force beyond its limit (relative to it), or a slip from rest against its own rate
 * (1). A sticking element then slips against its force; a slipping one sticks; a constrained one (MODE_CONSTRAINED: at
 * rest, without force) slips in the direction of its rate. If an element would start to slip while another is
 * constrained without violation, the constrained one gets that slip direction instead, so that its force acts first.
 * Called in each pass of iterate_friction_modes() after the right-hand side.
 */
static int correct_worst_friction_mode(Integrator *run)
{
    int element = -1, constrained_element = -1;
    double largest = 1e-9, mode = 0.0;
    for (int i = 0; i < N_FRICTIONS; i++) {
        const Friction *friction = &run->rhs.friction[i];
        const double mode_now = run->discrete.mode[i];
        double violation = 0.0, mode_next = 0.0;
        if (mode_now == 0.0) {
            violation = (fabs(friction->force) - friction->static_limit) / (friction->static_limit + 1e-300);
            mode_next = friction->force > 0.0 ? -1.0 : 1.0;
        } else if (fabs(friction->v) <= MAX_STICK_SPEED && fabs(friction->rate) > MAX_STICK_SPEED) {
            violation = mode_now == MODE_CONSTRAINED || mode_now * friction->rate < 0.0 ? 1.0 : 0.0;
            mode_next = mode_now != MODE_CONSTRAINED ? 0.0 : friction->rate > 0.0 ? 1.0 : -1.0;
        }
        constrained_element = mode_now == MODE_CONSTRAINED && violation == 0.0 ? i : constrained_element;
        if (violation > largest) {
            element = i;
            largest = violation;
            mode = mode_next;
        }
    }
    if (element >= 0)
        run->discrete.mode[mode != 0.0 && constrained_element >= 0 ? constrained_element : element] = mode;
    return element >= 0;
}

/*
 * Iterate the friction modes to a consistent set (a complementarity problem of stick and slip) and evaluate the
 * right-hand side. A change of one mode loads or unloads the others at once. Held elements at rest may stick again.
 * Return 0, CHATTERING if MAX_MODE_PASSES passes find no set, or another status. Called after each change of modes, at
 * the start and after impacts.
 */
static int iterate_friction_modes(Integrator *run, const Parameters *p)
{
    for (int i = 0; i < N_FRICTIONS; i++)
        if (run->discrete.mode[i] == MODE_CONSTRAINED && fabs(run->rhs.friction[i].v) <= MAX_STICK_SPEED)
            run->discrete.mode[i] = 0.0;
    for (int i = 0; i < MAX_MODE_PASSES; i++) {
        const int status = evaluate_rates_with_friction_modes(run, p);
        if (status || !correct_worst_friction_mode(run))
            return status;
    }
    return CHATTERING;
}

/*
 * Change the mode of each friction element whose event function is not positive, count these changes, then iterate all
 * modes to a consistent set. Stick changes to slip against the force; slip changes to stick; a constrained element
 * slips. Return 0 or a status. Called at an event of friction.
 */
static int change_friction_modes(Integrator *run, const Parameters *p)
{
    for (int i = 0; i < N_FRICTIONS; i++) {
        const Friction *friction = &run->rhs.friction[i];
        double *mode = &run->discrete.mode[i];
        if (evaluate_friction_event_function(&run->discrete, &run->rhs, i) > 0.0)
            continue;
        count_mode_change(run);
        if (*mode == 0.0) /* the limit is reached: it slips against the force */
            *mode = friction->force > 0.0 ? -1.0 : 1.0;
        else
            *mode = *mode == MODE_CONSTRAINED ? (friction->v > 0.0 ? 1.0 : -1.0) : 0.0;
    }
    const int status = remove_slips_at_rest(run, p);
    return status ? status : iterate_friction_modes(run, p);
}

/*
 * Set the modes that contradict the slips in run->rhs: an element with a slip above max_slip (m/s) slips in its
 * direction; others keep their mode. Return whether a mode changed.
 */
static int set_modes_by_slips(Integrator *run, double max_slip)
{
    int has_changed = 0;
    for (int i = 0; i < N_FRICTIONS; i++) {
        const double v = run->rhs.friction[i].v, direction = v > 0.0 ? 1.0 : -1.0;
        if (!(fabs(v) > max_slip) || run->discrete.mode[i] == direction)
            continue;
        run->discrete.mode[i] = direction;
        has_changed = 1;
    }
    return has_changed;
}

#if DRIVE_IMPULSES
/*
 * Correct the modes after a jump of velocities from the slips in run->rhs, and iterate all modes to a consistent set.
 * The slip of a sticking element may differ from zero by MAX_STICK_RESIDUAL. If no mode contradicts its slip, nothing
 * is evaluated. Return 0 or a status.
 */
static int correct_modes_after_jump(Integrator *run, const Parameters *p)
{
    return set_modes_by_slips(run, MAX_STICK_RESIDUAL) ? iterate_friction_modes(run, p) : 0;
}
#endif

/*
 * Set the friction modes that a start does not specify (NaN): the sign of the slip, or stick if |slip| <=
 * MAX_STICK_SPEED. Modes that a start specifies are corrected if they contradict the slip, as after a change of
 * parameters. If any mode was set or corrected, iterate all modes to a consistent set. Return 0 or a status. Called
 * once, when a run begins.
 */
static int initialize_friction_modes(Integrator *run, const Parameters *p)
{
    int has_unknown = 0;
    for (int i = 0; i < N_FRICTIONS; i++) {
        const double v = run->rhs.friction[i].v;
        if (!isnan(run->discrete.mode[i]))
            continue;
        has_unknown = 1;
        run->discrete.mode[i] = fabs(v) <= MAX_STICK_SPEED ? 0.0 : v > 0.0 ? 1.0 : -1.0;
    }
    const int has_changed = set_modes_by_slips(run, MAX_STICK_RESIDUAL);
    return has_unknown || has_changed ? iterate_friction_modes(run, p) : 0;
}

#if N_RIGID
/*
 * Iterate the friction modes to a consistent set after rigid contacts changed (iterate_friction_modes()). Return 0 or a
 * status.
 */
static int update_friction_modes(Integrator *run, const Parameters *p) { return iterate_friction_modes(run, p); }

/*
 * Evaluate the right-hand side after an impact with the current modes of friction elements, then set the modes by its
 * slips: an element with a slip above MAX_STICK_SPEED slips in its direction, others keep their mode. run->dy and
 * run->rhs are not evaluated again with the new modes. Return 0, or the status of the evaluation; the modes are then
 * unchanged.
 */
static int update_modes_after_impact(Integrator *run, const Parameters *p)
{
    const int status = evaluate_run_rhs(run, run->t, run->y, p, run->dy, &run->rhs);
    if (!status)
        set_modes_by_slips(run, MAX_STICK_SPEED);
    return status;
}
#endif

#else
/* Return 1, no event: the scene has no friction that may stick. */
static inline double evaluate_friction_event_function(const DiscreteState *discrete, const RhsOutputs *rhs, int element)
{
    (void)discrete, (void)rhs, (void)element;
    return 1.0;
}

/*
 * Evaluate the right-hand side: the scene has no sticking friction whose slip must be removed. Return a status. Called
 * at the end of each step and at states of the dense output in the search for events (evaluate_state_at()).
 */
static inline int evaluate_rates_without_residual_slips(
    Integrator *run, double t, double *y, const Parameters *p, double *dy, RhsOutputs *rhs)
{
    return evaluate_run_rhs(run, t, y, p, dy, rhs);
}

/* Leave the state unchanged: the scene has no friction that may stick. */
static inline void project_slips(Integrator *run, double t, double *y, const Parameters *p)
{
    (void)run, (void)t, (void)y, (void)p;
}

/* Leave the friction modes unchanged, and return the status 0: the scene has no friction that may stick. */
static inline int change_friction_modes(Integrator *run, const Parameters *p)
{
    (void)run, (void)p;
    return 0;
}

/* Return the status 0: the scene has no friction modes to start with. */
static inline int initialize_friction_modes(Integrator *run, const Parameters *p)
{
    (void)run, (void)p;
    return 0;
}

#if DRIVE_IMPULSES
/* Return the status 0: the scene has no friction modes that a jump could contradict. */
static inline int correct_modes_after_jump(Integrator *run, const Parameters *p)
{
    (void)run, (void)p;
    return 0;
}
#endif

#if N_RIGID
/* Return the status 0: the scene has no friction modes to update. */
static inline int update_friction_modes(Integrator *run, const Parameters *p)
{
    (void)run, (void)p;
    return 0;
}

/* Return the status 0: the scene has no friction modes that an impact changes. */
static inline int update_modes_after_impact(Integrator *run, const Parameters *p)
{
    (void)run, (void)p;
    return 0;
}
#endif
#endif
