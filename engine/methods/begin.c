/*
 * How a run by a method that chooses its step begins: tolerances, what counts as a speed, sides of what is watched.
 */
#if N_USER_EVENTS
/* The side of what is watched and begins on a zero: that to which it goes, as soon as that is known. */
static int set_initial_branches(Integrator *run, const Parameters *p)
{
    for (double fraction = 1e-6; fraction < 0.1; fraction *= 100.0) {
        double value[N_USER_EVENTS];
        int zeros = 0;
        for (int i = 0; i < N_USER_EVENTS; i++)
            zeros |= run->discrete.event_sign[i] == 0;
        const int status = zeros ? events_ahead(run, run->t, fraction * run->control.h, run->y, run->dy, p, value) : 0;
        if (status || !zeros)
            return fraction > 1e-6 ? 0 : status;
        for (int i = 0; i < N_USER_EVENTS; i++)
            if (run->discrete.event_sign[i] == 0)
                event_crosses(i, &run->discrete.event_sign[i], value[i]);
    }
    return 0;
}
#else
static inline int set_initial_branches(Integrator *run, const Parameters *p) { return (void)run, (void)p, 0; }
#endif

/* 1/s: over one time that speeds of the state and accelerations `dy` take for the smallest length that matters. */
static double fastest_rate(const Integrator *run, const double *dy)
{
    double rate = 0.0;
    for (int k = 0; k < N_X; k++) {
        const double least = run->norm.least[is_angle[k]], a = fabs(dy[N_X + k]);
        rate = max_of(rate, max_of(fabs(run->y[N_X + k]) / least, sqrt(a / least)));
    }
    return rate;
}

#define AT_ALL 1e-5   /* 1/s: what is slower does not move */
#define TOO_FAST 1e6 /* rates in the time of a run: more may be a drive whose second rate is unbounded at the start */

/*
 * What a speed counts at least: a hundredth of what leads over the smallest length that matters in the shortest time
 * that the start's speeds and accelerations take for it. Accelerations that are unbounded at the start are those right
 * after it. Only where these lead nowhere (a pulse is yet to come) the run's own time has to tell. Rounding is measured
 * by speeds that do not depend on how long the run is.
 */
static void set_speed_floors(Integrator *run, double left, const Parameters *p)
{
    double rate = fastest_rate(run, run->dy), dy[N_Y];
    RhsOutputs rhs;
    if (rate * left > TOO_FAST && !rates(run, run->t + left / TOO_FAST, run->y, p, dy, &rhs))
        rate = min_of(rate, fastest_rate(run, dy));
    for (int kind = 0; kind < 2; kind++) {
        run->norm.speed_floor[kind] = run->norm.least[kind] * (rate * left > 1e-3 ? 0.01 * rate : 1.0 / left);
        run->norm.speed_rounded[kind] = run->norm.least[kind] * (rate > AT_ALL ? 0.01 * rate : 1.0 / left);
    }
}

/* Whether a run begins in a contact whose surfaces give. */
static int begins_in_contact(const Integrator *run)
{
    int found = 0;
    for (int i = 0; i < N_CLEARANCES; i++)
        found |= gives(i) && run->discrete.contact[i].closed;
    return found;
}

/* Errors of inner states: relative to the deflection at which a joint slides, or as those of lengths where it is 0. */
static void set_inner_state_weights(Integrator *run, const Parameters *p)
{
#if LAW_STATES
    const double length = is_angle[0] ? run->norm.least[0] / run->norm.least[1] : 1.0;
    for (int k = 0; k < N_STATES; k++) {
        const double at = breakaway(p, k / LAW_STATES);
        run->norm.weight[FIRST_STATE + k] = at > 0.0 ? run->norm.inverse_scale[2 * N_X - 1] / at
            : run->norm.inverse_scale[0] / length;
    }
#else
    (void)run, (void)p;
#endif
}

/* A run; one that starts at a drive's jump, or right before it, beyond: on the rows that hold there, without work. */
static int begin_run(Integrator *run, const Parameters *p)
{
    if (DRIVE_IMPULSES) {
        double all[N_S];
        to_absolute(run->t, run->y, &run->discrete, p, all);
        if (drives_jump(run->t, all, all + N_Q, p))
            project_state(run, ahead_of(run->t), run->y, p);
    }
    const int status = begin(run, p);
    if (DRIVE_IMPULSES)
        set_phi_dot_max(run, 0.0); /* rates are those beyond the jump */
    return status;
}

/* The first right-hand side, with contacts, friction and sides as the start has them, held from now on. */
static int begin_adaptive(Integrator *run, double left, const Parameters *p)
{
    int status = run->ready ? 0 : begin_run(run, p);
    set_time_resolution(run, left);
    start_films(run, p);
    freeze_branches(run);
    if (!status)
        status = update_branches(run, -1, p);
    set_speed_floors(run, left, p);
    note_speed(run);
    /* weights are its inverse */
    run->norm.energy_scale = max_of(initial_energy_scale(run, p), MIN_RESOLVED / run->norm.work_scale);
    set_inner_state_weights(run, p);
    update_error_weights(run);
    if (!status)
        status = pass_drive_jumps_here(run, p); /* to the sides that hold there */
    if (!status)
        status = begin_beyond(run, 0.0, p);
    if (!status && !(run->control.h > 0.0)) {
        status = initial_step(run, left, p);
        if (!status && begins_in_contact(run)) { /* its force may have begun right before the start: as at an onset */
            set_first_length(run, &run->control.after_contact[count_closed(run)][0], ROUGH);
            status = first_step_after_event(run, left, p);
        }
    }
    if (!status)
        status = set_initial_branches(run, p);
    if (run->choice.method->own_length)
        set_length(run, left);
    return status;
}

/*
 * method: that begins, as gudgeon_method counts; automatic: the stiff one that it may change to, 0: it may not change;
 * scale (2 N_X): tolerances, those of velocities a unit of speed; least: the smallest length (m) and angle (rad) that
 * matter.
 */
void gudgeon_adaptive_setup(void *integrator, int method, int automatic, const double *scale, const double *least,
    double fixed)
{
    Integrator *run = integrator;
    start_choice(run, method, automatic);
    start_control(run, fixed);
    start_roots(run);
    for (int k = 0; k < 2 * N_X; k++)
        run->norm.inverse_scale[k] = 1.0 / scale[k];
    run->norm.work_scale = max_of(1e-10, WORKS * scale[2 * N_X - 1]); /* below it a sum of works is rounded */
    run->norm.least[0] = least[0];
    run->norm.least[1] = least[1];
    start_series(run, scale[2 * N_X - 1]);
}
