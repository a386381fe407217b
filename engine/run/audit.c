/*
 * The audit of a run: checks of accepted steps by equations that the integration does not use. Each check compares a
 * value with a limit that follows from the tolerance. A value above AUDIT_FAILS limits ends the run (AUDITED).
 *
 * Here are the checks of one state; audit_state is called at the end of each step. methods/audit_step.c checks the
 * inside of steps. The audit changes nothing but its own record.
 */
#define AUDIT_GRAZE 4e-13      /* m: so shallow a contact bears no force worth the name */
#define AUDIT_DEPTH 10.0       /* tolerances that an open joint may penetrate */
#define AUDIT_REST 1e-3 /* of a speed that counts: what is slower rests */
#define AUDIT_ROUNDING 1e-9    /* of the size, or speed: closer than this rows are not known */
#define AUDIT_ACCELERATION 1e-6 /* of the largest term, that two ways to the accelerations may differ by */
#define AUDIT_BALANCE 1e-8     /* of a force on a mass: accelerations that are smaller are known less well */
#define AUDIT_CLOSURE 1e-9     /* of the size: error of positions that accelerations must not depend on */
#define AUDIT_CLOSED 1024.0    /* roundings that a chain of driven bodies is closed to */
#define AUDIT_NOISE 1e-9       /* of its largest magnitude, below which the sign of a function is rounding */
#define AUDIT_ZERO 1e-3        /* of its value at the beginning of a step: smaller ones are a zero, and no pole */
#define AUDIT_LOCATED 4.0      /* event tolerances, and ulp of the time, within which an event is located */
#define AUDIT_FIXED 1e-8       /* the tolerance that stands in for that of a fixed step */
/* steps in a row that end on the wrong side of a switching function; after which its magnitude is known */
enum { AUDIT_WRONG = 3, AUDIT_SETTLED = 20 };

static int is_resolved(Integrator *run, double t, const double *y, const RhsOutputs *rhs, int k, const Parameters *p);

/* A number in (0, 1) that looks random: the same in every run. */
static double draw(Audit *audit)
{
    audit->random = audit->random * 1664525u + 1013904223u;
    return ((audit->random >> 8) + 0.5) / 16777216.0;
}

/* Whether steps are as long as a tolerance allows. */
static int has_tolerance(const Integrator *run) { return run->control.fixed <= 0.0; }

static double audit_tolerance(const Integrator *run) { return has_tolerance(run) ? tolerance_of(run) : AUDIT_FIXED; }

static double size_of(const Integrator *run) { return run->audit.size; }

static void record_larger(Audit *audit, int check, double value, double limit, double t, int where)
{
    AuditRecord *known = &audit->record[check];
    const double multiple = value / max_of(limit, 1e-300);
    if (!(multiple > known->worst) && multiple == multiple)
        return;
    *known = (AuditRecord){multiple == multiple ? multiple : INFINITY, t, where};
    if (multiple == 0.0) /* the first of many: its time says nothing */
        *known = (AuditRecord){0.0, 0.0, -1};
    if (!(known->worst <= AUDIT_FAILS))
        audit->status = AUDITED;
}

static void record(Audit *audit, int check, double value, double limit, double t, int where)
{
    if (!(value <= audit->record[check].worst * limit))
        record_larger(audit, check, value, limit, t, where);
}

/*
 * The largest violation so far of the rows that each accepted step looks at: closures of the tree, or all rows. What a
 * run begins with, off its constraints, is no fault of its steps.
 */
static void check_closed(Integrator *run)
{
    if (drifts(run))
        return;
    double limit = max_of(audit_tolerance(run) * run->norm.least[0], AUDIT_ROUNDING * size_of(run));
    if (run->counts.steps <= 1)
        run->audit.phi_start = run->residuals.phi_max;
    const double off = run->residuals.phi_max > run->audit.phi_start ? run->residuals.phi_max : 0.0;
    for (int k = 0; k < N_X && !(off < limit); k++)
        limit = max_of(limit, is_angle[k] ? 0.0 : AUDIT_ROUNDING * fabs(run->y[k]));
    record(&run->audit, CHECK_position, off, limit, run->t, -1);
}

/* Positions, and with `rates_too` velocities, of all rows of the motion at a state `all` of all bodies. */
static void check_rows(Integrator *run, double t, const double *all, int rates_too, const Parameters *p)
{
    Audit *audit = &run->audit;
    if (drifts(run))
        return;
    double phi[AT_LEAST_ONE(N_ALL_ROWS)], missed[AT_LEAST_ONE(N_ALL_ROWS)], nu[AT_LEAST_ONE(N_ALL_ROWS)];
    double far[2] = {0.0, 0.0}, speed[2] = {0.0, 0.0};
    const double rtol = audit_tolerance(run), size = size_of(run);
    for (int k = 0; k < N_Q; k++) {
        far[k % 3 == 2] = max_of(far[k % 3 == 2], fabs(all[k]));
        speed[k % 3 == 2] = max_of(speed[k % 3 == 2], fabs(all[N_Q + k]));
    }
    constraints(t, all, p, phi);
    for (int i = 0; i < N_ROWS; i++) {
        const int row = kept_row[i], length = row_is_length[row];
        const double play = length ? run->norm.least[0] : run->norm.least[1];
        const double limit = max_of(rtol * play, AUDIT_ROUNDING * (length ? size + far[0] : 1.0 + far[1]));
        record(audit, CHECK_position, fabs(phi[row]), limit, t, row);
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
        record(audit, CHECK_velocity, fabs(missed[row]), max_of(rtol, 1e-8) * scale + rounding, t, row);
    }
}

#if TREE
/*
 * States of all bodies about h (s) before and after a time, with velocities and accelerations `dy` as they are now.
 * Returns the time between them, to the bit.
 */
static double states_near(const Integrator *run, double t, const double *y, const double *dy, double h,
    const Parameters *p, double (*near)[N_S])
{
    const double before = t - h, after = t + h;
    for (int branch = 0; branch < 2; branch++) {
        const double way = branch ? after - t : before - t;
        double state[N_Y];
        for (int k = 0; k < N_X; k++) {
            state[k] = y[k] + way * (y[N_X + k] + 0.5 * way * dy[N_X + k]);
            state[N_X + k] = y[N_X + k] + way * dy[N_X + k];
        }
        for (int k = 2 * N_X; k < N_Y; k++)
            state[k] = y[k];
        to_absolute(branch ? after : before, state, &run->discrete, p, near[branch]);
    }
    return after - before;
}

/*
 * Whether rates are not those of the state itself, or small changes of positions change accelerations `a` as much; or,
 * where drives lead chains of bodies near a dead centre, changes of the time as small as roundings of the closures.
 */
static int is_sensitive(Integrator *run, double t, const double *y, const double *a, const double *scale,
    double fraction, const Parameters *p)
{
    double state[N_Y], all[N_S], other[N_Q], rate[N_Y], force;
    DiscreteState now = run->discrete;
    RhsOutputs rhs;
    if (motion_here(t, y, &now, p, rate, &rhs))
        return 1; /* near a singular position rates are continued from both sides of it */
    const double size = size_of(run);
    for (int k = 0; k < N_Y; k++)
        state[k] = k < N_X ? y[k] + AUDIT_CLOSURE * (is_angle[k] ? 1.0 : size) * (2.0 * draw(&run->audit) - 1.0) : y[k];
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
 * Accelerations `dy` of the tree against those that follow from the equations of all bodies. The tree's accelerations
 * of all bodies are differences of velocities, (v(t + h) - v(t - h))/(2 h). Where second differences say that h is too
 * long, as near a singular position, h is shorter, or nothing is compared. `all`: the state of all bodies.
 */
static void check_accelerations(Integrator *run, double t, const double *y, const double *dy, const double *all,
    const Parameters *p)
{
#if TREE
    const double size = size_of(run);
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
        const double between = states_near(run, t, y, dy, h, p, near);
        for (int k = 0; k < N_Q; k++) {
            const double before = near[0][N_Q + k], after = near[1][N_Q + k];
            const double off = fabs(a[k] - (after - before) / between) / scale[k];
            bend = max_of(bend, fabs(after - 2.0 * all[N_Q + k] + before) / h / scale[k]);
            if (!(off <= worst))
                worst = off, where = k;
        }
        if (bend < 1e-4) {
            /* where drives jump the step holds what they were, the bodies have what they are */
            if (worst > AUDIT_ACCELERATION
                && (drives_jump(t, all, all + N_Q, p) || is_sensitive(run, t, y, a, scale, worst, p)))
                return;
            record(&run->audit, CHECK_acceleration, worst, AUDIT_ACCELERATION, t, where);
            return;
        }
    }
#else
    (void)run, (void)t, (void)y, (void)dy, (void)all, (void)p;
#endif
}

/* Open joints at a state do not penetrate. */
static void check_joints(Integrator *run, double t, const RhsOutputs *rhs, const Parameters *p)
{
    for (int i = 0; i < N_CLEARANCES && has_tolerance(run); i++) {
        const Clearance *joint = &rhs->clearance[i];
        if (run->discrete.contact[i].closed)
            continue;
        if (joint->delta <= AUDIT_GRAZE) {
            record(&run->audit, CHECK_gap, 0.0, 1.0, t, i);
            continue;
        }
        const double located = 4.0 * (run->roots.time_resolution + 8.0 * DBL_EPSILON * fabs(t)) * fabs(joint->deltadot);
        const double least = max_of(AUDIT_GRAZE, 64.0 * DBL_EPSILON * size_of(run));
        const double rounding = max_of(1e-9 * radial_clearance(p, i), least);
        const double limit = max_of(AUDIT_DEPTH * audit_tolerance(run) * run->norm.least[0], rounding) + located;
        record(&run->audit, CHECK_gap, max_of(joint->delta, 0.0), limit, t, i);
    }
}

/* How far behind its zero an event may be located, s. */
static double located_within(const Integrator *run)
{
    return AUDIT_LOCATED * (run->roots.time_resolution + 2.0 * DBL_EPSILON * fabs(run->t));
}

static int make_dense(Integrator *run, const Parameters *p, Step *step);
static int state_at(
    Integrator *run, const Step *step, double fraction, const Parameters *p, double *y, double *dy, RhsOutputs *rhs);

/*
 * Whether switching function k has just jumped to the wrong side at time t inside a step: as many event tolerances
 * before, it was on its side. Its zero is located no better, and a jump is as large there as anywhere.
 */
static int has_just_jumped(Integrator *run, Step *step, double t, int k, const Parameters *p)
{
    const double fraction = (t - located_within(run) - step->t) / step->h;
    double y[N_Y], dy[N_Y];
    RhsOutputs rhs;
    return fraction <= 0.0 || make_dense(run, p, step) || state_at(run, step, fraction, p, y, dy, &rhs)
        || run->discrete.branch[k] * rhs.g[k] >= 0.0;
}

/* Branches that a step holds, at a state inside it: how far each function lies on the wrong side. */
static void check_branches(Integrator *run, Step *step, double t, const double *y, const RhsOutputs *rhs,
    const Parameters *p)
{
    if (N_SWITCHES > 0)
        record(&run->audit, CHECK_branch, 0.0, 1.0, t, -1);
    if (t <= run->t + located_within(run))
        return; /* what changes at one time, as the values of functions of one mod, changes one after the other */
    for (int k = 0; k < N_SWITCHES; k++)
        run->audit.switch_scale[k] = max_of(run->audit.switch_scale[k], fabs(rhs->g[k]));
    for (int k = 0; k < N_SWITCHES && run->counts.steps > AUDIT_SETTLED; k++) {
        const double g = run->discrete.branch[k] * rhs->g[k];
        if (!(g < 0.0) || step->passed[k] || k == run->roots.skip || meets[k]
            || !is_resolved(run, t, y, rhs, N_CLEARANCES + k, p))
            continue;
        const StageValues seen = stage_values(step, N_CLEARANCES + k);
        for (int n = 0; n < step->n_seen; n++) /* where each step ends at a zero, its magnitude is seen inside alone */
            run->audit.switch_scale[k] = max_of(run->audit.switch_scale[k], fabs(stage_value(seen, n)));
        if (-g <= 1e-3 * run->audit.switch_scale[k] || !has_just_jumped(run, step, t, k, p))
            record(&run->audit, CHECK_branch, -g, 1e-3 * run->audit.switch_scale[k], t, k);
    }
}

/* Joints that are open bear no force. */
static void check_free(Integrator *run)
{
    for (int i = 0; i < N_CLEARANCES; i++)
        if (!run->discrete.contact[i].closed && gives(i) && !has_film(i))
            record(&run->audit, CHECK_free, total_force(&run->rhs.clearance[i]),
                max_of(1e-6 * run->contacts.F_peak[i], 1e-300), run->t, i);
}
