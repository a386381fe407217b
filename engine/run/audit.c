/*
 * The audit of a run: checks of accepted steps by equations that the integration does not use. Each check compares a
 * value with a limit that follows from the tolerance. A value above AUDIT_FAILS limits ends the run (AUDITED).
 *
 * This file owns the checks of one state; check_step_end() calls them at the end of each step. methods/audit_step.c
 * checks the inside of steps. The audit changes only its own record.
 */
#define AUDIT_MIN_PENETRATION 4e-13      /* m: contacts with less penetration carry a negligible force */
#define AUDIT_MAX_DEPTH 10.0       /* tolerances: allowed violation of a gap, or of a slip in its mode */
#define AUDIT_MIN_SPEED_FRACTION 1e-3 /* of the smallest relevant speed: slower bodies rest */
#define AUDIT_ROUNDING 1e-9    /* of the size, or speed: rounding of the constraint equations */
#define AUDIT_ACCELERATION 1e-6 /* of the largest term: allowed difference of both accelerations */
#define AUDIT_MIN_TIME_ULPS 64.0 /* of the time: shorter times between compared velocities are rounding */
#define AUDIT_DIFFERENCE_STEPS 1e3 /* steps of the integrator that count as a time scale of motion and drives */
#define AUDIT_BALANCE 1e-8     /* of force over mass: smaller accelerations are less accurate */
#define AUDIT_CLOSURE_TOL 1e-9     /* of the size: error of positions that accelerations must not depend on */
#define AUDIT_LOOP_ULPS 1024.0    /* roundings to which kinematically determined loops are closed */
#define AUDIT_NOISE_FRACTION 1e-9       /* of its largest magnitude, below which the sign of a function is rounding */
#define AUDIT_ZERO_FRACTION 1e-3        /* of the value at the step's beginning: a smaller one is a zero, not a pole */
#define AUDIT_LOCATED 4.0      /* event tolerances, and ulp of the time, within which an event is located */
#define AUDIT_FORCE 1e-3       /* of a force: allowed error of a force that ends a contact or stick */
#define AUDIT_FIXED_STEP_TOL 1e-8       /* the tolerance that stands in for that of a fixed step */
/* successive steps on a wrong branch that count; steps after which the magnitude of a function is known */
enum { AUDIT_WRONG_STEPS = 3, AUDIT_MIN_STEPS = 20 };

static int is_above_uncertainty(Integrator *run, double t, const double *y, const RhsOutputs *rhs, int k,
    const Parameters *p);

/*
 * Return a pseudo-random number in (0, 1) and advance the generator in `audit`. The linear congruential sequence is the
 * same in every run. Used to select the steps and states that are checked inside.
 */
static double draw_random_number(Audit *audit)
{
    audit->random = audit->random * 1664525u + 1013904223u;
    return ((audit->random >> 8) + 0.5) / 16777216.0;
}

/* Return whether errors control the step length; 0 in runs with steps of fixed length. */
static int has_step_size_control(const Integrator *run) { return run->control.fixed <= 0.0; }

/*
 * Return the relative tolerance to which the audit refers: that of step-size control, or AUDIT_FIXED_STEP_TOL for steps
 * of fixed length. Used for the limits of all checks.
 */
static double get_audit_tolerance(const Integrator *run) { return has_step_size_control(run) ? get_rtol(run)
    : AUDIT_FIXED_STEP_TOL; }

/*
 * Return the size of the mechanism in m, as stored by start_audit(): the largest distance of a point from the origin of
 * its body. Used as scale of lengths.
 */
static double get_mechanism_size(const Integrator *run) { return run->audit.mechanism_size; }

/*
 * Replace the record of a check by a violation if value/limit exceeds the recorded multiple. A NaN counts as infinite.
 * A multiple of zero is stored without time and index. A multiple above AUDIT_FAILS sets audit->status to AUDITED. t:
 * time in s; index: as in record_check(), which calls it.
 */
static void record_largest_violation(Audit *audit, int check, double value, double limit, double t, int index)
{
    AuditRecord *record = &audit->record[check];
    const double multiple = value / max_of(limit, 1e-300);
    if (!(multiple > record->max_ratio) && multiple == multiple)
        return;
    *record = (AuditRecord){multiple == multiple ? multiple : INFINITY, t, index};
    if (multiple == 0.0) /* one of many zeros: its time is irrelevant */
        *record = (AuditRecord){0.0, 0.0, -1};
    if (!(record->max_ratio <= AUDIT_FAILS))
        audit->status = AUDITED;
}

/*
 * Record the value of a check (CHECK_...) at time t (s) with its limit, if value/limit is the largest so far. index:
 * number of the joint, constraint equation, body coordinate, switching function or event; -1: none. A ratio above
 * AUDIT_FAILS sets the status AUDITED.
 */
static void record_check(Audit *audit, int check, double value, double limit, double t, int index)
{
    if (!(value <= audit->record[check].max_ratio * limit))
        record_largest_violation(audit, check, value, limit, t, index);
}

/*
 * Check the largest residual |Phi| of all accepted steps so far against its limit, and record CHECK_position. Called at
 * the end of each step. A residual that is not larger than that of the start and the first step counts as zero. Methods
 * with Baumgarte's terms instead of projection (uses_baumgarte_terms()) are not checked.
 */
static void check_constraint_residuals(Integrator *run)
{
    if (uses_baumgarte_terms(run))
        return;
    double limit = max_of(get_audit_tolerance(run) * run->norm.min_size[0], AUDIT_ROUNDING * get_mechanism_size(run));
    if (run->counts.steps <= 1)
        run->audit.phi_start = run->residuals.phi_max;
    const double residual = run->residuals.phi_max > run->audit.phi_start ? run->residuals.phi_max : 0.0;
    for (int k = 0; k < N_X && !(residual < limit); k++)
        limit = max_of(limit, is_angle[k] ? 0.0 : AUDIT_ROUNDING * fabs(run->y[k]));
    record_check(&run->audit, CHECK_position, residual, limit, run->t, -1);
}

/*
 * Check the constraint equations of all bodies at time t (s), and with `include_velocities` their velocity constraints
 * Phi_q v = nu. absolute_state (N_S): coordinates, velocities and works of all bodies. Each equation is recorded under
 * CHECK_position or CHECK_velocity. Methods without projection (uses_baumgarte_terms()) are not checked. Called at the
 * end of steps of scenes with driven loops, and at states inside steps.
 */
static void check_constraints(Integrator *run, double t, const double *absolute_state, int include_velocities,
    const Parameters *p)
{
    Audit *audit = &run->audit;
    if (uses_baumgarte_terms(run))
        return;
    double phi[AT_LEAST_ONE(N_ALL_ROWS)], velocity_residual[AT_LEAST_ONE(N_ALL_ROWS)], nu[AT_LEAST_ONE(N_ALL_ROWS)];
    double max_coordinate[2] = {0.0, 0.0}, max_speed[2] = {0.0, 0.0};
    const double rtol = get_audit_tolerance(run), size = get_mechanism_size(run);
    for (int k = 0; k < N_Q; k++) {
        max_coordinate[k % 3 == 2] = max_of(max_coordinate[k % 3 == 2], fabs(absolute_state[k]));
        max_speed[k % 3 == 2] = max_of(max_speed[k % 3 == 2], fabs(absolute_state[N_Q + k]));
    }
    constraints(t, absolute_state, p, phi);
    for (int i = 0; i < N_ROWS; i++) {
        const int row = motion_row[i], length = row_is_length[row];
        const double min_size = length ? run->norm.min_size[0] : run->norm.min_size[1];
        const double limit = max_of(rtol * min_size,
            AUDIT_ROUNDING * (length ? size + max_coordinate[0] : 1.0 + max_coordinate[1]));
        record_check(audit, CHECK_position, fabs(phi[row]), limit, t, row);
    }
    if (!include_velocities)
        return;
    const double min_speed = max_of(AUDIT_MIN_SPEED_FRACTION * run->norm.speed_floor[0], 1e-300); /* m/s */
    const double speed_scale = max_of(max_of(max_speed[0], size * max_speed[1]), min_speed),
        half_interval = 1e-5 * size / speed_scale;
    compute_velocity_residuals(t, absolute_state, absolute_state + N_Q, half_interval, p, velocity_residual, nu);
    for (int i = 0; i < N_ROWS; i++) {
        const int row = motion_row[i];
        const double scale = max_of(row_is_length[row] ? speed_scale : speed_scale / max_of(size, 1e-300),
            fabs(nu[row]));
        const double largest_coordinate =
            row_is_length[row] ? max_coordinate[0] + size * max_coordinate[1] : max_coordinate[1];
        const double rounding = 4.0 * DBL_EPSILON * largest_coordinate / half_interval;
        record_check(audit, CHECK_velocity, fabs(velocity_residual[row]), max_of(rtol, 1e-8) * scale + rounding, t,
            row);
    }
}

#if TREE
/*
 * Compute the states of all bodies at t - h and t + h (s) from the state y and its rates dy at t. Coordinates are
 * extrapolated quadratically and velocities linearly; works and internal states of laws stay. neighbours[0],
 * neighbours[1]: the results. Return the exact difference of both times in s, which rounding makes different from 2 h.
 * Used by check_accelerations() for central differences.
 */
static double compute_neighbouring_states(const Integrator *run, double t, const double *y, const double *dy, double h,
    const Parameters *p, double (*neighbours)[N_S])
{
    const double before = t - h, after = t + h;
    for (int side = 0; side < 2; side++) {
        const double offset = side ? after - t : before - t;
        double state[N_Y];
        for (int k = 0; k < N_X; k++) {
            state[k] = y[k] + offset * (y[N_X + k] + 0.5 * offset * dy[N_X + k]);
            state[N_X + k] = y[N_X + k] + offset * dy[N_X + k];
        }
        for (int k = 2 * N_X; k < N_Y; k++)
            state[k] = y[k];
        convert_integrated_to_absolute(side ? after : before, state, &run->discrete, p, neighbours[side]);
    }
    return after - before;
}

/*
 * Return whether the accelerations `a` (N_Q) of a state are too sensitive to be compared. Called only after a
 * difference of accelerations exceeds its limit. Reasons:
 *   - the motion is continued past a singular position;
 *   - random changes of positions within rounding, and of the time where drives determine loops, change `a` by 0.1
 *       relative_difference of acceleration_scale;
 *   - the perturbed accelerations cannot be computed.
 */
static int is_comparison_ill_conditioned(Integrator *run, double t, const double *y, const double *a,
    const double *acceleration_scale,
    double relative_difference, const Parameters *p)
{
    double state[N_Y], absolute_state[N_S], a_perturbed[N_Q], rate[N_Y], force;
    DiscreteState discrete = run->discrete;
    RhsOutputs rhs;
    if (evaluate_rhs(t, y, &discrete, p, rate, &rhs))
        return 1; /* near a singular position rates are continued from both sides */
    const double size = get_mechanism_size(run);
    for (int k = 0; k < N_Y; k++)
        state[k] = k < N_X
            ? y[k] + AUDIT_CLOSURE_TOL * (is_angle[k] ? 1.0 : size) * (2.0 * draw_random_number(&run->audit) - 1.0)
            : y[k];
    const double t_perturbed = N_DEPENDENT ? t * (1.0 - AUDIT_LOOP_ULPS * DBL_EPSILON) : t;
    convert_integrated_to_absolute(t_perturbed, state, &run->discrete, p, absolute_state);
    if (compute_absolute_accelerations(t_perturbed, absolute_state, &run->discrete, p, a_perturbed, &force))
        return 1;
    for (int k = 0; k < N_Q; k++)
        if (!(fabs(a_perturbed[k] - a[k]) < 0.1 * relative_difference * acceleration_scale[k]))
            return 1;
    return 0;
}
#endif

/*
 * Check the accelerations in the rates dy of the reduced formulation against those from the equations of all bodies.
 * Reduced accelerations are converted to all bodies by differences of velocities, (v(t + h) - v(t - h))/(2 h). If
 * second differences show that h is too long, h is reduced. It is at most a hundredth of the integrator's step
 * (step_length, s), which resolves the drives. The check is omitted in very short steps, near a singular
 * position, at a jump of a drive, after very many turns, and in scenes without a reduced formulation.
 * absolute_state (N_S): the state of all bodies at t. Called at states inside selected steps.
 */
static void check_accelerations(Integrator *run, double t, double step_length, const double *y, const double *dy,
    const double *absolute_state, const Parameters *p)
{
#if TREE
    const double size = get_mechanism_size(run);
    double a[N_Q], m[N_Q], scale[N_Q], neighbours[2][N_S], force, rate = 0.0, largest[2] = {0.0, 0.0};
    if (run->discrete.singular_policy != SINGULAR_CONTINUE
        || compute_absolute_accelerations(t, absolute_state, &run->discrete, p, a, &force))
        return; /* near a singular position both lose digits */
    for (int k = 0; k < N_Q; k++) {
        const double unit = k % 3 == 2 ? 1.0 : size;
        rate = max_of(rate, max_of(fabs(absolute_state[N_Q + k]) / unit, sqrt(fabs(a[k]) / unit)));
    }
    for (int k = 2; k < N_Q; k += 3)
        if (DBL_EPSILON * fabs(absolute_state[k]) > 1e-3 * AUDIT_ACCELERATION)
            return; /* so large an angle has lost too many digits */
    for (int k = 0; k < N_Q; k++)
        largest[k % 3 == 2] = max_of(largest[k % 3 == 2], max_of(fabs(a[k]), rate * fabs(absolute_state[N_Q + k])));
    mass_matrix(p, m);
    for (int k = 0; k < N_Q; k++) { /* forces in balance leave accelerations that are rounding */
        const double rounding = m[k] > 0.0 ? AUDIT_BALANCE * force * (k % 3 == 2 ? size : 1.0) / m[k] : 0.0;
        scale[k] = max_of(max_of(largest[k % 3 == 2], rounding), DBL_MIN / DBL_EPSILON);
    }
    for (double fraction = 1e-5; fraction > 1e-8 && rate > 0.0; fraction *= 0.03) {
        const double h = fraction * min_of(1.0 / rate, AUDIT_DIFFERENCE_STEPS * step_length);
        if (h < AUDIT_MIN_TIME_ULPS * DBL_EPSILON * fabs(t))
            return;
        for (int k = 0; k < N_Q; k++)
            if (DBL_EPSILON * fabs(absolute_state[N_Q + k]) > 0.1 * AUDIT_ACCELERATION * h * scale[k])
                return; /* differences of velocities are rounding */
        double largest_difference = 0.0, second_difference = 0.0;
        int index = 0;
        const double interval = compute_neighbouring_states(run, t, y, dy, h, p, neighbours);
        for (int k = 0; k < N_Q; k++) {
            const double before = neighbours[0][N_Q + k], after = neighbours[1][N_Q + k];
            const double difference = fabs(a[k] - (after - before) / interval) / scale[k];
            second_difference = max_of(second_difference,
                fabs(after - 2.0 * absolute_state[N_Q + k] + before) / h / scale[k]);
            if (!(difference <= largest_difference))
                largest_difference = difference, index = k;
        }
        if (second_difference < 1e-4) {
            /* at a jump of a drive the step holds the old branch, the bodies have the new one */
            if (largest_difference > AUDIT_ACCELERATION
                && (has_drive_jump(t, get_jump_interval(t), absolute_state, absolute_state + N_Q, p)
                    || is_comparison_ill_conditioned(run, t, y, a, scale, largest_difference, p)))
                return;
            record_check(&run->audit, CHECK_acceleration, largest_difference, AUDIT_ACCELERATION, t, index);
            return;
        }
    }
#else
    (void)run, (void)t, (void)step_length, (void)y, (void)dy, (void)absolute_state, (void)p;
#endif
}

/*
 * Return the error in m that the tolerance, rounding and the location of events at time t (s) allow for the penetration
 * of a joint, whose values there are `clearance`. Limit of the check of gaps.
 */
static double compute_penetration_error_limit(const Integrator *run, double t, const Clearance *clearance, int joint,
    const Parameters *p)
{
    const double location_error = 4.0 * (run->roots.time_resolution
        + 8.0 * DBL_EPSILON * fabs(t)) * fabs(clearance->deltadot);
    const double min_rounding = max_of(AUDIT_MIN_PENETRATION, 64.0 * DBL_EPSILON * get_mechanism_size(run));
    const double rounding = max_of(1e-9 * radial_clearance(p, joint), min_rounding);
    return max_of(AUDIT_MAX_DEPTH * get_audit_tolerance(run) * run->norm.min_size[0], rounding) + location_error;
}

/*
 * Check the gap of each joint with play against the state of its contact, at a state with outputs `rhs`, and record
 * CHECK_gap: open contacts have no penetration, closed ones of compliant surfaces no gap, closed ones of rigid surfaces
 * neither. Values up to AUDIT_MIN_PENETRATION count as zero. Called at the end of each step and at states inside
 * selected steps.
 */
static void check_gaps(Integrator *run, double t, const RhsOutputs *rhs, const Parameters *p)
{
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Clearance *joint = &rhs->clearance[i];
        const double violation = !run->discrete.contact[i].closed ? joint->delta
            : is_compliant(i) ? -joint->delta : fabs(joint->delta);
        if (violation <= AUDIT_MIN_PENETRATION)
            record_check(&run->audit, CHECK_gap, 0.0, 1.0, t, i);
        else
            record_check(&run->audit, CHECK_gap, violation, compute_penetration_error_limit(run, t, joint, i, p), t, i);
    }
}

/*
 * Return the time in s within which an event is located: AUDIT_LOCATED times the time resolution plus 2 ulp of the
 * time. Also the distance from an event to a state just after it.
 */
static double compute_event_location_tolerance(const Integrator *run)
{
    return AUDIT_LOCATED * (run->roots.time_resolution + 2.0 * DBL_EPSILON * fabs(run->t));
}

static int compute_dense_output(Integrator *run, const Parameters *p, Step *step);
static int evaluate_state_at(
    Integrator *run, const Step *step, double fraction, const Parameters *p, double *y, double *dy, RhsOutputs *rhs);

/*
 * Return whether a switching function has just jumped to the wrong branch at time t (s) in a step. It was then on its
 * branch, or cannot be evaluated, one location tolerance earlier; return 1 also if that is before the step. A jump has
 * its full size at once, so that its value is no violation. Computes the dense output of the step. Called only for a
 * function that is on the wrong branch.
 */
static int has_jumped_at(Integrator *run, Step *step, double t, int switch_index, const Parameters *p)
{
    const double fraction = (t - compute_event_location_tolerance(run) - step->t) / step->h;
    double y[N_Y], dy[N_Y];
    RhsOutputs rhs;
    return fraction <= 0.0 || compute_dense_output(run, p, step)
        || evaluate_state_at(run, step, fraction, p, y, dy, &rhs)
        || run->discrete.branch[switch_index] * rhs.g[switch_index] >= 0.0;
}

/*
 * Check the frozen branches at a state inside a step, and record as CHECK_branch by how much each switching function is
 * on the wrong branch. Also update the largest magnitudes of the functions in the audit. Called at states inside the
 * steps that the audit selects.
 *
 * Not checked: the first AUDIT_MIN_STEPS steps, times just after the beginning, and functions that the step passes or
 * suppresses. Also omitted are functions that are continuous at their switching point (`is_continuous_switch`), values
 * below their uncertainty, and jumps that have just happened.
 */
static void check_frozen_branches(Integrator *run, Step *step, double t, const double *y, const RhsOutputs *rhs,
    const Parameters *p)
{
    if (N_SWITCHES > 0)
        record_check(&run->audit, CHECK_branch, 0.0, 1.0, t, -1);
    if (t <= run->t + compute_event_location_tolerance(run))
        return; /* functions that change at one time, as those of one mod, do so one after the other */
    for (int k = 0; k < N_SWITCHES; k++)
        run->audit.switch_scale[k] = max_of(run->audit.switch_scale[k], fabs(rhs->g[k]));
    for (int k = 0; k < N_SWITCHES && run->counts.steps > AUDIT_MIN_STEPS; k++) {
        const double g = run->discrete.branch[k] * rhs->g[k];
        if (!(g < 0.0) || step->is_ignored[k] || k == run->roots.suppressed_switch || is_continuous_switch[k]
            || !is_above_uncertainty(run, t, y, rhs, N_CLEARANCES + k, p))
            continue;
        const StageValues stages = get_stage_values(step, N_CLEARANCES + k);
        for (int n = 0; n < step->n_stored_stages; n++) /* at zeros that end steps the magnitude appears only inside */
            run->audit.switch_scale[k] = max_of(run->audit.switch_scale[k], fabs(read_stage(stages, n)));
        if (-g <= 1e-3 * run->audit.switch_scale[k] || !has_jumped_at(run, step, t, k, p))
            record_check(&run->audit, CHECK_branch, -g, 1e-3 * run->audit.switch_scale[k], t, k);
    }
}

/*
 * Check that joints with compliant surfaces and without a film exert no force while their contact is open, and record
 * CHECK_free. The limit is 1e-6 of the joint's largest force so far. Called at the end of each step.
 */
static void check_forces_of_open_joints(Integrator *run)
{
    for (int i = 0; i < N_CLEARANCES; i++)
        if (!run->discrete.contact[i].closed && is_compliant(i) && !has_film(i))
            record_check(&run->audit, CHECK_free, compute_force_magnitude(&run->rhs.clearance[i]),
                max_of(1e-6 * run->contacts.F_peak[i], 1e-300), run->t, i);
}

/*
 * Check the forces of closed contacts of rigid surfaces at time t (s) of the step from run->t, with outputs `rhs`, and
 * record CHECK_free: they do not pull. The limit is AUDIT_FORCE of the force there or at the beginning. Called at the
 * end of each step and at states inside selected steps. Times just after the beginning are not checked: forces may have
 * jumped at the event there, and the next event then follows at once.
 */
static void check_rigid_forces(Integrator *run, double t, const RhsOutputs *rhs)
{
    for (int i = 0; i < N_CLEARANCES && t > run->t + compute_event_location_tolerance(run); i++) {
        const double F_n = rhs->clearance[i].F_n, scale = max_of(fabs(run->rhs.clearance[i].F_n), fabs(F_n));
        if (!is_compliant(i) && run->discrete.contact[i].closed)
            record_check(&run->audit, CHECK_free, max_of(F_n, 0.0), max_of(AUDIT_FORCE * scale, 1e-300), t, i);
    }
}

/*
 * Check the modes of friction elements that can stick at time t (s) of the step from run->t, with outputs `rhs`, and
 * record CHECK_mode. In slip there is no slip against the mode, in stick and MODE_CONSTRAINED none at all; slips may
 * err by AUDIT_MAX_DEPTH times the larger of MAX_STICK_SPEED and the tolerance of the largest speed. In stick the force
 * exceeds its static limit by at most AUDIT_FORCE of the limit there or at the beginning. Called with
 * check_rigid_forces(), and omitted at the same times.
 */
static void check_friction_modes(Integrator *run, double t, const RhsOutputs *rhs)
{
#if N_FRICTIONS
    const double speed = max_of(run->norm.speed[0], get_mechanism_size(run) * run->norm.speed[1]);
    const double min_slip = AUDIT_MAX_DEPTH * max_of(MAX_STICK_SPEED, get_audit_tolerance(run) * speed);
    const double location_tolerance = compute_event_location_tolerance(run);
    for (int i = 0; i < N_FRICTIONS && t > run->t + location_tolerance; i++) {
        const Friction *friction = &rhs->friction[i];
        const double mode = run->discrete.mode[i], v = friction->v;
        const double static_limit = max_of(friction->static_limit, run->rhs.friction[i].static_limit);
        const int has_slip = mode == 1.0 || mode == -1.0;
        record_check(&run->audit, CHECK_mode, has_slip ? max_of(-mode * v, 0.0) : fabs(v),
            min_slip + location_tolerance * fabs(friction->rate), t, i);
        if (mode == 0.0)
            record_check(&run->audit, CHECK_mode, max_of(fabs(friction->force) - friction->static_limit, 0.0),
                max_of(AUDIT_FORCE * static_limit, 1e-300), t, i);
    }
#else
    (void)run, (void)t, (void)rhs;
#endif
}
