/*
 * Changes at an event: contacts begin or end, switching functions change branch, friction changes mode. A drive whose
 * rate jumps moves the linkage by an impulse.
 */
#define ONSET_ORDER 3.5 /* order of the error of a first step in a contact, whose force begins as delta^n */

/*
 * Update the branches of all active switching functions except `crossed` (-1: none), which was just switched, and
 * evaluate the right-hand side.
 */
static int update_branches(Integrator *run, int crossed, const Parameters *p)
{
    return update_branches_at(run, run->t, run->y, run->dy, &run->rhs, crossed, p);
}

#if N_USER_EVENTS && N_SWITCHES
/*
 * Update the branches just after an event, except that of the switching function `crossed`. Functions that jump at one
 * time, as a mod of a mod, have zeros of several switching functions there; between these zeros event functions have
 * values that they never take.
 */
static int update_branches_after_event(Integrator *run, int crossed, const Parameters *p)
{
    const double h = event_location_tolerance(run);
    double branch[N_SWITCHES], y[N_Y], dy[N_Y];
    RhsOutputs beyond;
    memcpy(branch, run->discrete.branch, sizeof branch);
    for (int k = 0; k < N_Y; k++)
        y[k] = run->y[k] + h * run->dy[k];
    const int status = update_branches_at(run, run->t + h, y, dy, &beyond, crossed, p);
    if (status || !memcmp(branch, run->discrete.branch, sizeof branch))
        return status;
    return rates(run, run->t, run->y, p, run->dy, &run->rhs);
}

/* Return whether event function i keeps its sign at a zero, because branches have changed there since `before`. */
static int has_unchanged_sign(Integrator *run, int i, const double *before, const Parameters *p)
{
    double value[N_USER_EVENTS];
    return memcmp(before, run->discrete.branch, sizeof run->discrete.branch)
        && !evaluate_events_ahead(run, run->t, event_location_tolerance(run), run->y, run->dy, p, value)
        && run->discrete.event_sign[i] * value[i] > 0.0;
}
#else
/* Return 0: the scene has no user-defined events with switching functions. */
static int update_branches_after_event(Integrator *run, int crossed, const Parameters *p)
{
    return (void)run, (void)crossed, (void)p, 0;
}

/* Return 0: the scene has no user-defined events with switching functions. */
static int has_unchanged_sign(Integrator *run, int i, const double *before, const Parameters *p)
{
    return (void)run, (void)i, (void)before, (void)p, 0;
}
#endif

/* Return the number of closed contacts. */
static int count_closed(const Integrator *run)
{
    int count = 0;
    for (int i = 0; i < N_CLEARANCES; i++)
        count += run->discrete.contact[i].closed;
    return count;
}

/*
 * Begin or end the contact of joint i, and select the first step length that follows. floor: smallest approach speed,
 * m/s.
 */
static void cross_contact(Integrator *run, int i, double floor)
{
    const int opens = run->discrete.contact[i].closed;
    if (opens)
        open_joint(run, i, run->t);
    else
        close_joint(run, i, run->t, run->rhs.clearance[i].deltadot, floor);
    set_first_length(run, &run->control.after_contact[count_closed(run)][opens], opens ? 0.0 : ONSET_ORDER);
    discard_stiff_length(run);
}

/*
 * Apply the change of event function k that reached zero: the contact of a joint, or the branch of a switching
 * function.
 */
static void cross_event(Integrator *run, int k, const Parameters *p)
{
    if (k < N_CLEARANCES && !gives(k))
        return; /* update_contacts() changes all rigid contacts */
    if (k < N_CLEARANCES)
        cross_contact(run, k, min_approach_speed(p, k));
    else if (k < N_CLEARANCES + N_SWITCHES) {
        const int switch_index = k - N_CLEARANCES;
        run->discrete.branch[switch_index] *= -1.0;
        set_first_length(run, &run->control.after_switch[switch_index][run->discrete.branch[switch_index] > 0.0], 0.0);
    }
}

/* Return the scale of works at the start in J: the kinetic energy plus that of the smallest relevant speeds. */
static double initial_energy_scale(const Integrator *run, const Parameters *p)
{
    double m[N_Q], sum = kinetic_energy(run, p);
    mass_matrix(p, m);
    for (int k = 0; k < N_Q; k++)
        sum += 0.5 * m[k] * run->norm.speed_floor[k % 3 == 2] * run->norm.speed_floor[k % 3 == 2];
    return sum;
}

#if DRIVE_IMPULSES
/*
 * Set the branches of all switching functions to their signs at time `ahead`, just after the present time. The function
 * `crossed`, which was just switched, keeps its branch in the first pass: it changes only if other functions change it.
 */
static int update_branches_just_after(Integrator *run, double ahead, int crossed, const Parameters *p)
{
    double dy[N_Y];
    for (int pass = 0; pass < 6; pass++) {
        int changed = 0;
        RhsOutputs rhs;
        const int status = rates(run, ahead, run->y, p, dy, &rhs);
        if (status)
            return status;
        for (int k = 0; k < N_SWITCHES; k++)
            if ((k != crossed || pass > 0) && !isnan(rhs.g[k]) && (run->discrete.branch[k] < 0.0) != (rhs.g[k] < 0.0)) {
                run->discrete.branch[k] = -run->discrete.branch[k];
                changed = 1;
            }
        if (!changed)
            break;
    }
    return 0;
}

/*
 * Return whether the second rate of a drive is unbounded next to the present time, as that of (t - t0)^1.5 is at t0.
 * The test: at fixed state, accelerations change far more from here to `distance` (s) than from there to twice as far.
 */
static int is_unbounded(Integrator *run, double distance, const Parameters *p)
{
    const double offset[3] = {1e-5 * distance, distance, 2.0 * distance};
    DiscreteState free = run->discrete;
    double dy[3][N_Y], largest = 0.0;
    RhsOutputs rhs;
    int some = 0;
    free.held = 0;
    for (int i = 0; i < 3; i++)
        if (motion(run->t + offset[i], run->y, &free, p, dy[i], &rhs))
            return 0;
    for (int k = N_X; k < 2 * N_X; k++)
        largest = max_of(largest, fabs(dy[1][k]));
    for (int k = N_X; k < 2 * N_X; k++)
        some |= !(fabs(dy[0][k] - dy[1][k]) <= 20.0 * fabs(dy[1][k] - dy[2][k]) + 1e-9 * largest);
    return some;
}

/*
 * Pass the switching point of a drive with all others at the same time: first update branches, then apply the impulse
 * that changes velocities. Return 0, UNBOUNDED or another status.
 */
static int pass_drive_jump(Integrator *run, int switch_index, const Parameters *p)
{
    const double t = run->t, ahead = t + max_of(32.0 * DBL_EPSILON * fabs(t), 2.0 * run->roots.time_resolution);
    /* methods with step-size control approach in short steps; the time is known to a few time resolutions */
    const double distance = max_of(1e-6 * run->control.fixed, 4e5 * run->roots.time_resolution);
    if (run->control.fixed > 0.0 && (is_unbounded(run, -distance, p) || is_unbounded(run, distance, p)))
        return UNBOUNDED;
    int status = update_branches_just_after(run, ahead, switch_index, p);
    if (status)
        return status;
    const double before = kinetic_energy(run, p);
    apply_drive_impulse(run, p);
    if (kinetic_energy(run, p) == before)
        return update_branches(run, switch_index, p);
    status = update_branches_just_after(run, ahead, switch_index, p); /* branches that depend on the changed speeds */
    if (!status)
        status = rates(run, t, run->y, p, run->dy, &run->rhs);
    return status ? status : record_crossed_events(run, NULL, p);
}

/*
 * Apply the jump of a drive's rate at the start or end of a run, or just after it. Record user-defined events whose
 * zeros the impulse crosses.
 */
static int pass_drive_jumps_here(Integrator *run, const Parameters *p)
{
    double before[N_SWITCHES + 1];
    int some = 0;
    for (int k = 0; k < N_SWITCHES; k++)
        before[k] = run->discrete.branch[k];
    int status = update_branches_just_after(run, just_after(run->t), -1, p);
    for (int k = 0; k < N_SWITCHES; k++)
        some |= before[k] != run->discrete.branch[k];
    if (status || !some)
        return status;
    apply_drive_impulse(run, p);
    status = update_branches_just_after(run, just_after(run->t), -1, p);
    if (!status)
        status = rates(run, run->t, run->y, p, run->dy, &run->rhs);
    if (!status)
        status = update_contacts(run, -1, p);
    return status ? status : record_crossed_events(run, NULL, p);
}
#else
/* Update branches: no drive of the scene has a rate that jumps. */
static inline int pass_drive_jump(Integrator *run, int switch_index, const Parameters *p)
{
    return update_branches(run, switch_index, p);
}

/* Return 0: no drive of the scene has a rate that jumps. */
static inline int pass_drive_jumps_here(Integrator *run, const Parameters *p) { return (void)run, (void)p, 0; }
#endif

/*
 * Change the branch of switching function `switch_index` at its zero, apply the impulse of a drive, and suppress a
 * repeated zero.
 */
static int change_branch(Integrator *run, int switch_index, const Parameters *p)
{
    double before[N_Y];
    memcpy(before, run->dy, sizeof before);
    const int status = pass_drive_jump(run, switch_index, p);
    suppress_repeated_switch(run, switch_index, before);
    return status;
}

/* Record the forces of contacts that begin now: a force that begins with a jump may be largest at its onset. */
static void record_onset_forces(Integrator *run)
{
    for (int i = 0; i < N_CLEARANCES; i++)
        if (run->discrete.contact[i].closed && run->contacts.open[i].t_on == run->t && gives(i))
            record_force(run, i, run->t, total_force(&run->rhs.clearance[i]));
}

/*
 * Apply all changes at an event and evaluate the right-hand side after them. Every event function of a contact or
 * switching point that has reached zero changes, then contacts, friction and user-defined events. Changes that lead
 * other user-defined events across their zeros record these. Return 0, ENDED or another status.
 */
static int apply_event(Integrator *run, int event, const Parameters *p)
{
    double before[AT_LEAST_ONE(N_USER_EVENTS)], branch[AT_LEAST_ONE(N_SWITCHES)];
    const StateBeforeEvent held = copy_before_event(run);
    memcpy(branch, run->discrete.branch, sizeof branch);
    for (int i = 0; i < N_USER_EVENTS; i++)
        before[i] = run->rhs.event[i];
    for (int k = 0; k < N_CLEARANCES + N_SWITCHES; k++)
        if (k == event
            || (k < N_CLEARANCES && event_function(&run->discrete, &run->rhs, k) < penetration_rounding(p, k)))
            cross_event(run, k, p);
    const int switch_index = event - N_CLEARANCES, friction = switch_index - N_SWITCHES;
    const int user_event = friction - N_FRICTIONS;
    int status = switch_index >= 0 && friction < 0 ? change_branch(run, switch_index, p) : update_branches(run, -1, p);
    if (!status && switch_index >= 0)
        status = update_branches_after_event(run, friction < 0 ? switch_index : -1, p);
    if (!status)
        record_onset_forces(run);
    if (!status && friction >= 0 && user_event < 0)
        status = change_friction_modes(run, p);
    if (!status && user_event < 0)
        status = update_contacts(run, event, p);
    if (!status && user_event >= 0 && !has_unchanged_sign(run, user_event, branch, p)
        && reverse_event_sign(run, user_event) && !run->events.pole
        && record_user_event(run, user_event, run->t, run->y, p))
        status = ENDED;
    const int ended = !status || status == ENDED ? record_crossed_events(run, before, p) : 0;
    const int held_now = !status || status == ENDED ? record_arrivals_at_zero(run, &held, 1e-4 * run->control.h, p) : 0;
    return ended ? ended : held_now ? held_now : status;
}

/* Return LOST if an open contact has a penetration beyond its tolerance: contact detection has failed; otherwise 0. */
static int check_contacts(const Integrator *run, const Parameters *p)
{
    for (int i = 0; i < N_CLEARANCES; i++)
        if (!run->discrete.contact[i].closed
            && run->rhs.clearance[i].delta > min_of(1e-9, 1e-6 * deepest(p, i)) + 1e-3 * radial_clearance(p, i))
            return LOST;
    return 0;
}
