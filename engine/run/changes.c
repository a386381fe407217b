/*
 * Event handling: changes of discrete states at an event. Contacts begin or end, switching functions change branch,
 * friction changes mode. A drive whose rate jumps moves the linkage by an impulse.
 */
#define ONSET_ORDER 3.5 /* order of the error of a first step in a contact, whose force begins as delta^n */

/*
 * Update the branches of all active switching functions at the current state until they agree with the signs, and
 * evaluate the right-hand side there into run->dy and run->rhs (update_branches_at()). crossed_switch: function that
 * was just switched and keeps its branch, -1: none. Return 0 or the status of the right-hand side. Called after events
 * and at the start of a run.
 */
static int update_branches_at_current_state(Integrator *run, int crossed_switch, const Parameters *p)
{
    return update_branches_at(run, run->t, run->y, run->dy, &run->rhs, crossed_switch, p);
}

#if N_USER_EVENTS && N_SWITCHES
/*
 * Update the branches of switching functions to those just after an event, at the current state extrapolated by the
 * location tolerance. crossed_switch keeps its branch, -1: none. If a branch changed, the right-hand side at the
 * current state is evaluated again. Return a status.
 *
 * Functions that jump at one time, as a mod of a mod, have zeros of several switching functions there. Between these
 * zeros event functions have values that they never take.
 */
static int update_branches_after_event(Integrator *run, int crossed_switch, const Parameters *p)
{
    const double h = compute_event_location_tolerance(run);
    double branch[N_SWITCHES], y[N_Y], dy[N_Y];
    RhsOutputs rhs_after;
    memcpy(branch, run->discrete.branch, sizeof branch);
    for (int k = 0; k < N_Y; k++)
        y[k] = run->y[k] + h * run->dy[k];
    const int status = update_branches_at(run, run->t + h, y, dy, &rhs_after, crossed_switch, p);
    if (status || !memcmp(branch, run->discrete.branch, sizeof branch))
        return status;
    return evaluate_run_rhs(run, run->t, run->y, p, run->dy, &run->rhs);
}

/*
 * Return whether a user-defined event function has the same sign just after its zero as before, because branches have
 * changed there. apply_event() then does not count the zero as an event: the sign is not reversed and nothing is
 * recorded. The function is evaluated one event location tolerance later, along the rates, and compared with the stored
 * event_sign. branches_before: branches of the switching functions before the event. Return 0 if no branch has changed
 * or the evaluation fails.
 */
static int has_equal_sign_after_event(Integrator *run, int event, const double *branches_before, const Parameters *p)
{
    double value[N_USER_EVENTS];
    return memcmp(branches_before, run->discrete.branch, sizeof run->discrete.branch)
        && !extrapolate_event_functions(run, run->t, compute_event_location_tolerance(run), run->y, run->dy, p, value)
        && run->discrete.event_sign[event] * value[event] > 0.0;
}
#else
/* Return the status 0: the scene has no user-defined events that depend on switching functions. */
static int update_branches_after_event(Integrator *run, int crossed_switch, const Parameters *p)
{
    return (void)run, (void)crossed_switch, (void)p, 0;
}

/* Return 0, the signs differ: the scene has no user-defined events that depend on switching functions. */
static int has_equal_sign_after_event(Integrator *run, int event, const double *branches_before, const Parameters *p)
{
    return (void)run, (void)event, (void)branches_before, (void)p, 0;
}
#endif

/* Return the number of joints with play whose contact is closed. */
static int count_closed_contacts(const Integrator *run)
{
    int count = 0;
    for (int i = 0; i < N_CLEARANCES; i++)
        count += run->discrete.contact[i].closed;
    return count;
}

/*
 * Open the contact of a joint if it is closed, else close it, at the current time. min_speed: smallest stored approach
 * speed, m/s. Return 0, or CHATTERING if the list of contacts is full.
 *
 * Also set the length of the next step to the one stored for this kind of event: by number of closed contacts, onset or
 * separation. The stored length of the stiff method is discarded. Called at the zero of the event function of a
 * compliant contact.
 */
static int toggle_contact(Integrator *run, int joint, double min_speed)
{
    const int was_closed = run->discrete.contact[joint].closed;
    int status = 0;
    if (was_closed)
        status = open_contact(run, joint, run->t);
    else
        close_contact(run, joint, run->t, run->rhs.clearance[joint].deltadot, min_speed);
    set_first_step(run, &run->control.after_contact[count_closed_contacts(run)][was_closed], was_closed ? 0.0
        : ONSET_ORDER);
    discard_stiff_step_length(run);
    restart_unstable_steps(run);
    return status;
}

/*
 * Apply the change of an event function that reached zero: the contact of a joint with compliant surfaces begins or
 * ends, or a switching function changes its branch. Also set the length of the next step to the one stored for this
 * kind of event. Rigid contacts change in update_contacts(). Functions of friction and user-defined events change
 * nothing here. Return 0 or the status of toggle_contact(). Called by apply_event() for each function that has reached
 * zero.
 */
static int toggle_contact_or_branch(Integrator *run, int event_function, const Parameters *p)
{
    if (event_function < N_CLEARANCES && !is_compliant(event_function))
        return 0; /* update_contacts() changes all rigid contacts */
    if (event_function < N_CLEARANCES)
        return toggle_contact(run, event_function, min_approach_speed(p, event_function));
    if (event_function < N_CLEARANCES + N_SWITCHES) {
        const int switch_index = event_function - N_CLEARANCES;
        run->discrete.branch[switch_index] *= -1.0;
        set_first_step(run, &run->control.after_switch[switch_index][run->discrete.branch[switch_index] > 0.0], 0.0);
    }
    return 0;
}

/*
 * Return the scale of works at the start in J: the kinetic energy plus that of all bodies at the smallest relevant
 * speeds (speed_floor). Called once, when a run begins.
 */
static double compute_initial_energy_scale(const Integrator *run, const Parameters *p)
{
    double m[N_Q], sum = compute_kinetic_energy(run, p);
    mass_matrix(p, m);
    for (int k = 0; k < N_Q; k++)
        sum += 0.5 * m[k] * run->norm.speed_floor[k % 3 == 2] * run->norm.speed_floor[k % 3 == 2];
    return sum;
}

#if DRIVE_IMPULSES
/*
 * Set the branches of all switching functions to their signs at time t_after (s), just after the current time, with the
 * current coordinates. A NaN keeps its branch. crossed_switch was just switched and keeps its branch in the first pass:
 * it changes only if other functions change it; -1: none. At most six passes. Return 0 or the status of the right-hand
 * side, which is not stored. Called before and after the impulse of a drive.
 */
static int update_branches_just_after(Integrator *run, double t_after, int crossed_switch, const Parameters *p)
{
    double dy[N_Y];
    for (int pass = 0; pass < 6; pass++) {
        int changed = 0;
        RhsOutputs rhs;
        const int status = evaluate_run_rhs(run, t_after, run->y, p, dy, &rhs);
        if (status)
            return status;
        for (int k = 0; k < N_SWITCHES; k++)
            if ((k != crossed_switch || pass > 0) && !isnan(rhs.g[k])
                && (run->discrete.branch[k] < 0.0) != (rhs.g[k] < 0.0)) {
                run->discrete.branch[k] = -run->discrete.branch[k];
                changed = 1;
            }
        if (!changed)
            break;
    }
    return 0;
}

/*
 * Return whether the second time derivative of a drive is unbounded next to the current time, as that of (t - t0)^1.5
 * is at t0. At fixed coordinates, accelerations then change more than 20 times as much from here to `time_offset` (s,
 * negative: before) as from there to twice as far. Return 0 if an evaluation fails. Called at jumps of drives in runs
 * with steps of fixed length.
 */
static int is_drive_rate_unbounded(Integrator *run, double time_offset, const Parameters *p)
{
    const double offset[3] = {1e-5 * time_offset, time_offset, 2.0 * time_offset};
    DiscreteState unfrozen = run->discrete;
    double dy[3][N_Y], largest = 0.0;
    RhsOutputs rhs;
    int is_unbounded_rate = 0;
    unfrozen.is_frozen = 0;
    for (int i = 0; i < 3; i++)
        if (compute_motion_rates(run->t + offset[i], run->y, &unfrozen, p, dy[i], &rhs))
            return 0;
    for (int k = N_X; k < 2 * N_X; k++)
        largest = max_of(largest, fabs(dy[1][k]));
    for (int k = N_X; k < 2 * N_X; k++)
        is_unbounded_rate |= !(fabs(dy[0][k] - dy[1][k]) <= 20.0 * fabs(dy[1][k] - dy[2][k]) + 1e-9 * largest);
    return is_unbounded_rate;
}

/*
 * Apply the jump of a drive's rate at the zero of its switching function: update branches, then add the impulse that
 * changes velocities. If no velocity changes, only branches are updated; else crossed user-defined events are recorded.
 * With steps of fixed length, return UNBOUNDED if the second rate of a drive is unbounded there. Return 0, ENDED if an
 * event ends the run, or another status.
 */
static int apply_drive_jump(Integrator *run, int switch_index, const Parameters *p)
{
    const double t = run->t, t_after = t + max_of(32.0 * DBL_EPSILON * fabs(t), 2.0 * run->roots.time_resolution);
    /* methods with step-size control approach in short steps; the time is known to a few time resolutions */
    const double distance = max_of(1e-6 * run->control.fixed, 4e5 * run->roots.time_resolution);
    if (run->control.fixed > 0.0 && (is_drive_rate_unbounded(run, -distance, p)
        || is_drive_rate_unbounded(run, distance, p)))
        return UNBOUNDED;
    int status = update_branches_just_after(run, t_after, switch_index, p);
    if (status)
        return status;
    const double energy_before = compute_kinetic_energy(run, p);
    apply_drive_impulse(run, p);
    if (compute_kinetic_energy(run, p) == energy_before) {
        status = update_branches_at_current_state(run, switch_index, p);
        return status ? status : correct_modes_after_jump(run, p);
    }
    status = update_branches_just_after(run, t_after, switch_index, p); /* branches that depend on the changed speeds */
    if (!status)
        status = evaluate_run_rhs(run, t, run->y, p, run->dy, &run->rhs);
    if (!status)
        status = correct_modes_after_jump(run, p);
    return status ? status : record_crossed_events(run, NULL, p);
}

/*
 * Apply jumps of the rates of drives at the current time. Nothing happens unless a branch differs just after that time.
 * Otherwise apply the impulse, resolve the impacts it causes and record the user-defined events that it crosses. Return
 * 0, ENDED if an event ends the run, or another status. Called at the start and end of a run, and at each end of fixed
 * steps.
 */
static int apply_drive_jumps_at_current_time(Integrator *run, const Parameters *p)
{
    double branches_before[N_SWITCHES + 1];
    int has_changed = 0;
    for (int k = 0; k < N_SWITCHES; k++)
        branches_before[k] = run->discrete.branch[k];
    int status = update_branches_just_after(run, get_time_just_after(run->t), -1, p);
    for (int k = 0; k < N_SWITCHES; k++)
        has_changed |= branches_before[k] != run->discrete.branch[k];
    if (status || !has_changed)
        return status;
    apply_drive_impulse(run, p);
    status = update_branches_just_after(run, get_time_just_after(run->t), -1, p);
    if (!status)
        status = evaluate_run_rhs(run, run->t, run->y, p, run->dy, &run->rhs);
    if (!status)
        status = correct_modes_after_jump(run, p);
    if (!status)
        status = update_contacts(run, -1, p);
    return status ? status : record_crossed_events(run, NULL, p);
}
#else
/*
 * Update branches after the zero of a switching function: no drive of the scene has a rate that jumps. Return a status.
 */
static inline int apply_drive_jump(Integrator *run, int switch_index, const Parameters *p)
{
    return update_branches_at_current_state(run, switch_index, p);
}

/* Return the status 0: no drive of the scene has a rate that jumps. */
static inline int apply_drive_jumps_at_current_time(Integrator *run, const Parameters *p)
{
    return (void)run, (void)p, 0;
}
#endif

/*
 * Complete the change of branch of a switching function that ended the step. apply_drive_jump() applies the jump of a
 * drive and updates the other branches; suppress_repeated_switch() suppresses a repeated zero in the next step. The
 * branch of switch_index itself has been changed before (toggle_contact_or_branch()). Return 0 or a status. Called by
 * apply_event().
 */
static int complete_branch_change(Integrator *run, int switch_index, const Parameters *p)
{
    double dy_before[N_Y];
    memcpy(dy_before, run->dy, sizeof dy_before);
    const int status = apply_drive_jump(run, switch_index, p);
    suppress_repeated_switch(run, switch_index, dy_before);
    return status;
}

/*
 * Record the forces of compliant contacts that begin at the current time as peaks: a force that begins with a jump may
 * be largest at its onset. Called by apply_event().
 */
static void record_onset_forces(Integrator *run)
{
    for (int i = 0; i < N_CLEARANCES; i++)
        if (run->discrete.contact[i].closed && run->contacts.ongoing[i].t_on == run->t && is_compliant(i))
            record_force(run, i, run->t, compute_force_magnitude(&run->rhs.clearance[i]));
}

/*
 * Apply all changes at an event and evaluate the right-hand side after them. event: number of the event function that
 * ended the step. The order: contact or branch of the event itself and every contact whose gap function is below
 * compute_gap_event_threshold(), branches, friction modes, rigid contacts, user-defined events.
 *
 * A user-defined event reverses its sign and is recorded if the direction counts; poles and functions with the same
 * sign just after it are not recorded. User-defined events that the other changes lead across zero are recorded too.
 * Return 0, ENDED if an event ends the run, or another status. Called after each accepted step that an event ended.
 */
static int apply_event(Integrator *run, int event, const Parameters *p)
{
    double values_before[AT_LEAST_ONE(N_USER_EVENTS)], branches_before[AT_LEAST_ONE(N_SWITCHES)];
    const StateBeforeEvent state_before = copy_state_before_event(run);
    memcpy(branches_before, run->discrete.branch, sizeof branches_before);
    for (int i = 0; i < N_USER_EVENTS; i++)
        values_before[i] = run->rhs.event[i];
    int status = 0;
    for (int k = 0; k < N_CLEARANCES + N_SWITCHES && !status; k++)
        if (k == event
            || (k < N_CLEARANCES
                && compute_event_value(&run->discrete, &run->rhs, k) < compute_gap_event_threshold(p, k)))
            status = toggle_contact_or_branch(run, k, p);
    const int switch_index = event - N_CLEARANCES, friction = switch_index - N_SWITCHES;
    const int user_event = friction - N_FRICTIONS;
    if (!status)
        status = switch_index >= 0 && friction < 0 ? complete_branch_change(run, switch_index, p)
            : update_branches_at_current_state(run, -1, p);
    if (!status && switch_index >= 0)
        status = update_branches_after_event(run, friction < 0 ? switch_index : -1, p);
    if (!status)
        record_onset_forces(run);
    if (!status && friction >= 0 && user_event < 0)
        status = change_friction_modes(run, p);
    if (!status && user_event < 0)
        status = update_contacts(run, event, p);
    if (!status && user_event >= 0 && !has_equal_sign_after_event(run, user_event, branches_before, p)
        && reverse_event_sign(run, user_event) && !run->events.pole
        && record_user_event(run, user_event, run->t, run->y, p))
        status = ENDED;
    const int crossed_status = !status || status == ENDED ? record_crossed_events(run, values_before, p) : 0;
    const int arrival_status = !status || status == ENDED
        ? record_events_at_constraint(run, &state_before, 1e-4 * run->control.h, p) : 0;
    return crossed_status ? crossed_status : arrival_status ? arrival_status : status;
}

/*
 * Return LOST if an open contact has a penetration beyond 0.001 of its radial clearance plus at most 1e-9 m, so that
 * contact detection has failed; otherwise 0. Called at accepted states.
 */
static int check_open_contacts(const Integrator *run, const Parameters *p)
{
    for (int i = 0; i < N_CLEARANCES; i++)
        if (!run->discrete.contact[i].closed
            && run->rhs.clearance[i].delta
                > min_of(1e-9, 1e-6 * max_valid_penetration(p, i)) + 1e-3 * radial_clearance(p, i))
            return LOST;
    return 0;
}
