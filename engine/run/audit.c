/*
 * The audit of a run: checks of accepted steps by equations that the integration does not use. Each check compares a
 * value with a limit that follows from the tolerance. A value above AUDIT_FAILS limits ends the run (AUDITED).
 *
 * This file owns the checks of one state; audit_state() calls them at the end of each step. methods/audit_step.c checks
 * the inside of steps. The audit changes only its own record.
 */
#define AUDIT_GRAZE 4e-13      /* m: contacts with less penetration carry a negligible force */
#define AUDIT_DEPTH 10.0       /* tolerances that an open joint may penetrate */
#define AUDIT_REST 1e-3 /* of the smallest relevant speed: slower bodies rest */
#define AUDIT_ROUNDING 1e-9    /* of the size, or speed: rounding of the constraint equations */
#define AUDIT_ACCELERATION 1e-6 /* of the largest term: allowed difference of both accelerations */
#define AUDIT_BALANCE 1e-8     /* of force over mass: smaller accelerations are less accurate */
#define AUDIT_CLOSURE 1e-9     /* of the size: error of positions that accelerations must not depend on */
#define AUDIT_CLOSED 1024.0    /* roundings to which kinematically determined loops are closed */
#define AUDIT_NOISE 1e-9       /* of its largest magnitude, below which the sign of a function is rounding */
#define AUDIT_ZERO 1e-3        /* of the value at the step's beginning: a smaller one is a zero, not a pole */
#define AUDIT_LOCATED 4.0      /* event tolerances, and ulp of the time, within which an event is located */
#define AUDIT_FIXED 1e-8       /* the tolerance that stands in for that of a fixed step */
/* successive steps on a wrong branch that count; steps after which the magnitude of a function is known */
enum { AUDIT_WRONG = 3, AUDIT_SETTLED = 20 };

static int is_resolved(Integrator *run, double t, const double *y, const RhsOutputs *rhs, int k, const Parameters *p);

/* Return a pseudo-random number in (0, 1) from a sequence that is the same in every run. */
static double draw_random(Audit *audit)
{
    audit->random = audit->random * 1664525u + 1013904223u;
    return ((audit->random >> 8) + 0.5) / 16777216.0;
}

/* Return whether the tolerance controls the step length. */
static int has_tolerance(const Integrator *run) { return run->control.fixed <= 0.0; }

/* Return the relative tolerance to which the audit refers, that of a fixed step being AUDIT_FIXED. */
static double audit_tolerance(const Integrator *run) { return has_tolerance(run) ? tolerance_of(run) : AUDIT_FIXED; }

/* Return the size of the mechanism, m. */
static double mechanism_size(const Integrator *run) { return run->audit.size; }

/*
 * Record a value of a check that exceeds the largest one so far relative to its limit. A multiple above AUDIT_FAILS
 * sets the status AUDITED.
 */
static void record_larger(Audit *audit, int check, double value, double limit, double t, int where)
{
    AuditRecord *known = &audit->record[check];
    const double multiple = value / max_of(limit, 1e-300);
    if (!(multiple > known->worst) && multiple == multiple)
        return;
    *known = (AuditRecord){multiple == multiple ? multiple : INFINITY, t, where};
    if (multiple == 0.0) /* one of many zeros: its time is irrelevant */
        *known = (AuditRecord){0.0, 0.0, -1};
    if (!(known->worst <= AUDIT_FAILS))
        audit->status = AUDITED;
}

/*
 * Record the value of a check with its limit at time t, if it is the largest so far. where: number of the joint,
 * constraint equation, body coordinate, switching function or event, -1: none.
 */
static void record_check(Audit *audit, int check, double value, double limit, double t, int where)
{
    if (!(value <= audit->record[check].worst * limit))
        record_larger(audit, check, value, limit, t, where);
}

/* Check the largest constraint residual of all accepted steps so far. A residual of the start does not count. */
static void check_residuals(Integrator *run)
{
    if (drifts(run))
        return;
    double limit = max_of(audit_tolerance(run) * run->norm.least[0], AUDIT_ROUNDING * mechanism_size(run));
    if (run->counts.steps <= 1)
        run->audit.phi_start = run->residuals.phi_max;
    const double off = run->residuals.phi_max > run->audit.phi_start ? run->residuals.phi_max : 0.0;
    for (int k = 0; k < N_X && !(off < limit); k++)
        limit = max_of(limit, is_angle[k] ? 0.0 : AUDIT_ROUNDING * fabs(run->y[k]));
    record_check(&run->audit, CHECK_position, off, limit, run->t, -1);
}

/* Check the constraint equations, and with `rates_too` their velocities, at a state `all` of all bodies. */
static void check_constraints(Integrator *run, double t, const double *all, int rates_too, const Parameters *p)
{
    Audit *audit = &run->audit;
    if (drifts(run))
        return;
    double phi[AT_LEAST_ONE(N_ALL_ROWS)], missed[AT_LEAST_ONE(N_ALL_ROWS)], nu[AT_LEAST_ONE(N_ALL_ROWS)];
    double far[2] = {0.0, 0.0}, speed[2] = {0.0, 0.0};
    const double rtol = audit_tolerance(run), size = mechanism_size(run);
    for (int k = 0; k < N_Q; k++) {
        far[k % 3 == 2] = max_of(far[k % 3 == 2], fabs(all[k]));
        speed[k % 3 == 2] = max_of(speed[k % 3 == 2], fabs(all[N_Q + k]));
    }
    constraints(t, all, p, phi);
    for (int i = 0; i < N_ROWS; i++) {
        const int row = kept_row[i], length = row_is_length[row];
        const double play = length ? run->norm.least[0] : run->norm.least[1];
        const double limit = max_of(rtol * play, AUDIT_ROUNDING * (length ? size + far[0] : 1.0 + far[1]));
        record_check(audit, CHECK_position, fabs(phi[row]), limit, t, row);
    }
    if (!rates_too)
        return;
    const double least = max_of(AUDIT_REST * run->norm.speed_floor[0], 1e-300); /* m/s */
    const double fast = max_of(max_of(speed[0], size * speed[1]), least), ahead = 1e-5 * size / fast;
    velocity_residuals(t, all, all + N_Q, ahead, p, missed, nu);
    for (int i = 0; i < N_ROWS; i++) {
        const int row = kept_row[i];
        const double scale = max_of(row_is_length[row] ? fast : fast / max_of(size, 1e-300), fabs(nu[row]));
        const double most = row_is_length[row] ? far[0] + size * far[1] : far[1];
        const double rounding = 4.0 * DBL_EPSILON * most / ahead;
        record_check(audit, CHECK_velocity, fabs(missed[row]), max_of(rtol, 1e-8) * scale + rounding, t, row);
    }
}

#if TREE
/*
 * Compute the states of all bodies h (s) before and after time t, from velocities and accelerations `dy` at t. Return
 * the exact difference of both times in s.
 */
static double compute_states_near(const Integrator *run, double t, const double *y, const double *dy, double h,
    const Parameters *p, double (*near)[N_S])
{
    const double before = t - h, after = t + h;
    for (int branch = 0; branch < 2; branch++) {
        const double offset = branch ? after - t : before - t;
        double state[N_Y];
        for (int k = 0; k < N_X; k++) {
            state[k] = y[k] + offset * (y[N_X + k] + 0.5 * offset * dy[N_X + k]);
            state[N_X + k] = y[N_X + k] + offset * dy[N_X + k];
        }
        for (int k = 2 * N_X; k < N_Y; k++)
            state[k] = y[k];
        to_absolute(branch ? after : before, state, &run->discrete, p, near[branch]);
    }
    return after - before;
}

/*
 * Return whether the accelerations `a` of a state are too sensitive to be compared. Reasons: rates continued past a
 * singular position; changes of positions within rounding that alter `a` by 0.1 `fraction`; driven loops near a dead
 * centre, where changes of time within rounding do the same.
 */
static int is_too_sensitive(Integrator *run, double t, const double *y, const double *a, const double *scale,
    double fraction, const Parameters *p)
{
    double state[N_Y], all[N_S], other[N_Q], rate[N_Y], force;
    DiscreteState now = run->discrete;
    RhsOutputs rhs;
    if (motion_here(t, y, &now, p, rate, &rhs))
        return 1; /* near a singular position rates are continued from both sides */
    const double size = mechanism_size(run);
    for (int k = 0; k < N_Y; k++)
        state[k] = k < N_X
            ? y[k] + AUDIT_CLOSURE * (is_angle[k] ? 1.0 : size) * (2.0 * draw_random(&run->audit) - 1.0) : y[k];
    const double near = N_CHAIN ? t * (1.0 - AUDIT_CLOSED * DBL_EPSILON) : t;
    to_absolute(near, state, &run->discrete, p, all);
    if (absolute_accelerations(near, all, &run->discrete, p, other, &force))
        return 1;
    for (int k = 0; k < N_Q; k++)
        if (!(fabs(other[k] - a[k]) < 0.1 * fraction * scale[k]))
            return 1;
    return 0;
}
#endif

/*
 * Check the accelerations `dy` of the reduced formulation against those from the equations of all bodies. Accelerations
 * of all bodies are differences of velocities, (v(t + h) - v(t - h))/(2 h). If second differences show that h is too
 * long, as near a singular position, h is reduced, or the check is omitted. all: the state of all bodies.
 */
static void check_accelerations(Integrator *run, double t, const double *y, const double *dy, const double *all,
    const Parameters *p)
{
#if TREE
    const double size = mechanism_size(run);
    double a[N_Q], m[N_Q], scale[N_Q], near[2][N_S], force, rate = 0.0, most[2] = {0.0, 0.0};
    if (run->discrete.singular_policy != SINGULAR_CONTINUE
        || absolute_accelerations(t, all, &run->discrete, p, a, &force))
        return; /* near a singular position both lose digits */
    for (int k = 0; k < N_Q; k++) {
        const double unit = k % 3 == 2 ? 1.0 : size;
        rate = max_of(rate, max_of(fabs(all[N_Q + k]) / unit, sqrt(fabs(a[k]) / unit)));
    }
    for (int k = 2; k < N_Q; k += 3)
        if (DBL_EPSILON * fabs(all[k]) > 1e-3 * AUDIT_ACCELERATION)
            return; /* so large an angle has lost too many digits */
    for (int k = 0; k < N_Q; k++)
        most[k % 3 == 2] = max_of(most[k % 3 == 2], max_of(fabs(a[k]), rate * fabs(all[N_Q + k])));
    mass_matrix(p, m);
    for (int k = 0; k < N_Q; k++) { /* forces in balance leave accelerations that are rounding */
        const double rounding = m[k] > 0.0 ? AUDIT_BALANCE * force * (k % 3 == 2 ? size : 1.0) / m[k] : 0.0;
        scale[k] = max_of(max_of(most[k % 3 == 2], rounding), 1e-300);
    }
    for (double fraction = 1e-5; fraction > 1e-8 && rate > 0.0; fraction *= 0.03) {
        const double h = fraction / rate;
        double worst = 0.0, bend = 0.0;
        int where = 0;
        const double between = compute_states_near(run, t, y, dy, h, p, near);
        for (int k = 0; k < N_Q; k++) {
            const double before = near[0][N_Q + k], after = near[1][N_Q + k];
            const double off = fabs(a[k] - (after - before) / between) / scale[k];
            bend = max_of(bend, fabs(after - 2.0 * all[N_Q + k] + before) / h / scale[k]);
            if (!(off <= worst))
                worst = off, where = k;
        }
        if (bend < 1e-4) {
            /* at a jump of a drive the step holds the old branch, the bodies have the new one */
            if (worst > AUDIT_ACCELERATION
                && (drives_jump(t, all, all + N_Q, p) || is_too_sensitive(run, t, y, a, scale, worst, p)))
                return;
            record_check(&run->audit, CHECK_acceleration, worst, AUDIT_ACCELERATION, t, where);
            return;
        }
    }
#else
    (void)run, (void)t, (void)y, (void)dy, (void)all, (void)p;
#endif
}

/* Check that open joints do not penetrate at a state. */
static void check_joints(Integrator *run, double t, const RhsOutputs *rhs, const Parameters *p)
{
    for (int i = 0; i < N_CLEARANCES && has_tolerance(run); i++) {
        const Clearance *joint = &rhs->clearance[i];
        if (run->discrete.contact[i].closed)
            continue;
        if (joint->delta <= AUDIT_GRAZE) {
            record_check(&run->audit, CHECK_gap, 0.0, 1.0, t, i);
            continue;
        }
        const double located = 4.0 * (run->roots.time_resolution + 8.0 * DBL_EPSILON * fabs(t)) * fabs(joint->deltadot);
        const double least = max_of(AUDIT_GRAZE, 64.0 * DBL_EPSILON * mechanism_size(run));
        const double rounding = max_of(1e-9 * radial_clearance(p, i), least);
        const double limit = max_of(AUDIT_DEPTH * audit_tolerance(run) * run->norm.least[0], rounding) + located;
        record_check(&run->audit, CHECK_gap, max_of(joint->delta, 0.0), limit, t, i);
    }
}

/* Return the time in s within which an event is located after its zero. */
static double event_location_tolerance(const Integrator *run)
{
    return AUDIT_LOCATED * (run->roots.time_resolution + 2.0 * DBL_EPSILON * fabs(run->t));
}

static int compute_dense_output(Integrator *run, const Parameters *p, Step *step);
static int state_at(
    Integrator *run, const Step *step, double fraction, const Parameters *p, double *y, double *dy, RhsOutputs *rhs);

/*
 * Return whether switching function k has just jumped to the wrong branch at time t in a step: it was on its branch one
 * location tolerance earlier. A jump has its full size at once.
 */
static int has_just_jumped(Integrator *run, Step *step, double t, int k, const Parameters *p)
{
    const double fraction = (t - event_location_tolerance(run) - step->t) / step->h;
    double y[N_Y], dy[N_Y];
    RhsOutputs rhs;
    return fraction <= 0.0 || compute_dense_output(run, p, step) || state_at(run, step, fraction, p, y, dy, &rhs)
        || run->discrete.branch[k] * rhs.g[k] >= 0.0;
}

/* Check the frozen branches at a state inside a step: how far each switching function is on the wrong branch. */
static void check_branches(Integrator *run, Step *step, double t, const double *y, const RhsOutputs *rhs,
    const Parameters *p)
{
    if (N_SWITCHES > 0)
        record_check(&run->audit, CHECK_branch, 0.0, 1.0, t, -1);
    if (t <= run->t + event_location_tolerance(run))
        return; /* functions that change at one time, as those of one mod, do so one after the other */
    for (int k = 0; k < N_SWITCHES; k++)
        run->audit.switch_scale[k] = max_of(run->audit.switch_scale[k], fabs(rhs->g[k]));
    for (int k = 0; k < N_SWITCHES && run->counts.steps > AUDIT_SETTLED; k++) {
        const double g = run->discrete.branch[k] * rhs->g[k];
        if (!(g < 0.0) || step->passed[k] || k == run->roots.skip || meets[k]
            || !is_resolved(run, t, y, rhs, N_CLEARANCES + k, p))
            continue;
        const StageValues seen = stage_values(step, N_CLEARANCES + k);
        for (int n = 0; n < step->n_seen; n++) /* at zeros that end steps the magnitude appears only inside */
            run->audit.switch_scale[k] = max_of(run->audit.switch_scale[k], fabs(stage_value(seen, n)));
        if (-g <= 1e-3 * run->audit.switch_scale[k] || !has_just_jumped(run, step, t, k, p))
            record_check(&run->audit, CHECK_branch, -g, 1e-3 * run->audit.switch_scale[k], t, k);
    }
}

/* Check that open joints carry no force. */
static void check_open_forces(Integrator *run)
{
    for (int i = 0; i < N_CLEARANCES; i++)
        if (!run->discrete.contact[i].closed && gives(i) && !has_film(i))
            record_check(&run->audit, CHECK_free, total_force(&run->rhs.clearance[i]),
                max_of(1e-6 * run->contacts.F_peak[i], 1e-300), run->t, i);
}
