/* Start of a run by any method: tolerances, speed scales, branches of switching functions, signs of event functions. */
#if N_USER_EVENTS
/*
 * Set the signs of user-defined events that are still zero at the start, without recording an event. They follow from
 * values at 1e-6, 1e-4 and 1e-2 of the first step length after it, extrapolated along the rates. Return 0, or the
 * status if already the first evaluation fails. Called last when the integration begins.
 */
static int set_initial_event_signs(Integrator *run, const Parameters *p)
{
    for (double fraction = 1e-6; fraction < 0.1; fraction *= 100.0) {
        double value[N_USER_EVENTS];
        int has_unset_sign = 0;
        for (int i = 0; i < N_USER_EVENTS; i++)
            has_unset_sign |= run->discrete.event_sign[i] == 0;
        const double ahead = fraction * run->control.h; /* s */
        const int status =
            has_unset_sign ? extrapolate_event_functions(run, run->t, ahead, run->y, run->dy, p, value) : 0;
        if (status || !has_unset_sign)
            return fraction > 1e-6 ? 0 : status;
        for (int i = 0; i < N_USER_EVENTS; i++)
            if (run->discrete.event_sign[i] == 0)
                detect_event_crossing(i, &run->discrete.event_sign[i], value[i]);
    }
    return 0;
}
#else
/* Return the status 0: the scene has no user-defined events. */
static inline int set_initial_event_signs(Integrator *run, const Parameters *p) { return (void)run, (void)p, 0; }
#endif

/*
 * Return the largest rate in 1/s at which the state crosses the smallest relevant length or angle (min_size), by speeds
 * and accelerations. It is the maximum over the coordinates of |v| / min_size and sqrt(|a| / min_size), with the
 * accelerations in `dy`.
 */
static double find_fastest_rate(const Integrator *run, const double *dy)
{
    double rate = 0.0;
    for (int k = 0; k < N_X; k++) {
        const double min_size = run->norm.min_size[is_angle[k]], a = fabs(dy[N_X + k]);
        rate = max_of(rate, max_of(fabs(run->y[N_X + k]) / min_size, sqrt(a / min_size)));
    }
    return rate;
}

#define MIN_START_RATE 1e-5   /* 1/s: slower motion counts as rest */
#define MAX_RATES_PER_RUN 1e6 /* higher rates may come from a second rate of a drive unbounded at the start */

/*
 * Set the smallest relevant speeds of lengths and angles, to which tolerances of velocities are relative for slow
 * motion. They are 0.01 of the speed that crosses the smallest relevant length at the fastest rate of the start. An
 * extreme rate is evaluated again just after the start, as it may be unbounded there. If the start hardly moves, as
 * before a transient, the time left in the run (`remaining_time`, s) determines them. speed_rounded, for rounding, is
 * independent of it.
 */
static void set_speed_floors(Integrator *run, double remaining_time, const Parameters *p)
{
    double rate = find_fastest_rate(run, run->dy), dy[N_Y];
    RhsOutputs rhs;
    if (rate * remaining_time > MAX_RATES_PER_RUN
        && !evaluate_run_rhs(run, run->t + remaining_time / MAX_RATES_PER_RUN, run->y, p, dy, &rhs))
        rate = min_of(rate, find_fastest_rate(run, dy));
    for (int kind = 0; kind < 2; kind++) {
        run->norm.speed_floor[kind] = run->norm.min_size[kind]
            * (rate * remaining_time > 1e-3 ? 0.01 * rate : 1.0 / remaining_time);
        run->norm.speed_rounded[kind] = run->norm.min_size[kind]
            * (rate > MIN_START_RATE ? 0.01 * rate : 1.0 / remaining_time);
    }
}

/*
 * Return whether any compliant contact is closed at the start of a run. The first step is then fitted as at an onset.
 */
static int is_starting_in_contact(const Integrator *run)
{
    int is_closed_contact = 0;
    for (int i = 0; i < N_CLEARANCES; i++)
        is_closed_contact |= is_compliant(i) && run->discrete.contact[i].closed;
    return is_closed_contact;
}

/*
 * Set the error weights of the internal states of contact laws, such as bristle deflections, once at the start. They
 * are relative to the deflection at which a joint slides, or treated as lengths if that is 0. Nothing is done in scenes
 * without internal states.
 */
static void set_internal_state_weights(Integrator *run, const Parameters *p)
{
#if LAW_STATES
    const double length = is_angle[0] ? run->norm.min_size[0] / run->norm.min_size[1] : 1.0;
    for (int k = 0; k < N_STATES; k++) {
        const double deflection = breakaway(p, k / LAW_STATES);
        run->norm.weight[FIRST_STATE + k] = deflection > 0.0 ? run->norm.inverse_scale[2 * N_X - 1] / deflection
            : run->norm.inverse_scale[0] / length;
    }
#else
    (void)run, (void)p;
#endif
}

/*
 * Evaluate the first right-hand side, contacts and friction modes of a new run. Return 0 or the status. A start at or
 * just before a jump of a drive's rate is first projected onto the constraints after the jump, without work. Called
 * once, by begin_integration(), unless the run is resumed.
 */
static int initialize_run_at_start(Integrator *run, const Parameters *p)
{
    if (DRIVE_IMPULSES) {
        double absolute_state[N_S];
        convert_integrated_to_absolute(run->t, run->y, &run->discrete, p, absolute_state);
        if (has_drive_jump(run->t, get_jump_interval(run->t), absolute_state, absolute_state + N_Q, p))
            project_state(run, get_time_just_after(run->t), run->y, p);
    }
    const int status = initialize_discrete_state(run, p);
    if (DRIVE_IMPULSES)
        set_phi_dot_max(run, 0.0); /* rates are those after the jump */
    return status;
}

/*
 * Begin the integration of a run, or resume it: first right-hand side, contacts, friction modes, tolerances, jumps of
 * drives, signs of user-defined events, first step length. Contacts and branches are frozen from here on.
 * remaining_time: to the end of the run, s. Return 0 or the status.
 *
 * A first step length that is known already is kept; otherwise it is estimated and, in a closed contact, fitted as at
 * an onset. Methods that control their length begin with remaining_time.
 */
static int begin_integration(Integrator *run, double remaining_time, const Parameters *p)
{
    int status = run->ready ? 0 : initialize_run_at_start(run, p);
    set_time_resolution(run, remaining_time);
    set_film_mass_scale(run, p);
    freeze_branches(run);
    if (!status)
        status = update_branches_at_current_state(run, -1, p);
    set_speed_floors(run, remaining_time, p);
    update_speeds(run);
    /* error weights are its inverse */
    run->norm.energy_scale = max_of(compute_initial_energy_scale(run, p), MIN_RESOLVED / run->norm.work_scale);
    set_internal_state_weights(run, p);
    update_error_weights(run);
    if (!status)
        status = apply_drive_jumps_at_current_time(run, p); /* to the branches after the jumps */
    if (!status)
        status = initialize_event_signs(run, 0.0, p);
    if (!status && !(run->control.h > 0.0)) {
        status = estimate_initial_step(run, remaining_time, p);
        if (!status && is_starting_in_contact(run)) { /* the contact force may have just begun: as at an onset */
            set_first_step(run, &run->control.after_contact[count_closed_contacts(run)][0], ONSET_ORDER);
            status = fit_first_step_after_event(run, remaining_time, p);
        }
    }
    if (!status)
        status = set_initial_event_signs(run, p);
    if (run->choice.method->controls_length)
        set_next_step_length(run, remaining_time);
    return status;
}

/*
 * Set the method, the tolerances and the step-size control of a run, after gudgeon_run_start() and before its first
 * step. method: index from gudgeon_method(); stiff_method: index of the one to which the run may change, 0: none.
 *
 * scale (2 N_X): tolerances, of velocities relative to speed; without coordinates the relative tolerance alone (1).
 * min_size: smallest relevant length (m) and angle (rad). fixed_step: length of fixed steps, s; 0: step-size control.
 */
void gudgeon_adaptive_setup(void *integrator, int method, int stiff_method, const double *scale,
    const double *min_size, double fixed_step)
{
    Integrator *run = integrator;
    set_method_choice(run, method, stiff_method);
    start_step_control(run, fixed_step);
    initialize_root_finding(run);
    for (int k = 0; k < 2 * N_X; k++)
        run->norm.inverse_scale[k] = 1.0 / scale[k];
    const double velocity_tol = scale[N_X > 0 ? 2 * N_X - 1 : 0];
    run->norm.work_scale = max_of(1e-10, WORK_TOL * velocity_tol); /* smaller: rounding of summed works */
    run->norm.min_size[0] = min_size[0];
    run->norm.min_size[1] = min_size[1];
    set_series_order(run, velocity_tol);
}
