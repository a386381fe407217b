/*
 * The audit of a run inside its steps (run/audit.c): at a random point of some steps, at every event that ends a step,
 * and in steps much longer than the one before. Checks: defect of the dense output, gaps, branches. At random points in
 * addition: all constraint equations, accelerations by the equations of all bodies, film forces.
 */
#define AUDIT_LONGER 8.0 /* times the step before: longer steps are always checked */
#define AUDIT_RATE 1e-3 /* of the largest rate: allowed error of rates */
#define AUDIT_CHANGE 0.1 /* of their change over the step: allowed error of rates */
#define AUDIT_SLIP 1e-9 /* m/s: smaller slips of sticking friction count as zero */
#define AUDIT_DRIFT 1e2 /* tolerances: allowed sum of errors of rates */
#define AUDIT_BOUNDED 10.0 /* tolerances: allowed error of a step limited by stability */
#define AUDIT_DEFECT 1e4 /* tolerances: allowed defect of the dense output */
#define AUDIT_LONGEST 1.5 /* times the longest measured step: longer steps are measured */
#define AUDIT_SHORT 1e-3 /* of the longest step: shorter ones near a pole do not define the scale of events */
#define AUDIT_FIRST 0.25 /* of the interval between drawn steps: the first one */
#define AUDIT_SHARE 0.008 /* of the evaluations of a run: cost of the checks of drawn steps */
#define AUDIT_COST 8.0   /* typical evaluations of one check */
#define AUDIT_ITERATIONS 4.0 /* evaluations of an iterated stage */
#define AUDIT_LEAST_STAGES 8.0 /* smallest number of evaluations of a step */
/* bisections that locate a zero; points inside a step */
enum { AUDIT_HALVINGS = 30, AUDIT_INSIDE = 4 };

/*
 * Return the defect of rates `rate` against `dy` at a state y of a step in multiples of its limit, 0 if it is not the
 * largest so far. A stiff component within its tolerance may have any rate: there h times the difference is divided by
 * 1 - h J.
 */
static double scaled_defect(Integrator *run, const Step *step, const double *y, const double *rate, const double *dy,
    const Parameters *p)
{
    const double known = max_of(run->audit.record[CHECK_defect].worst, 0.0), h = step->h;
    const int rows = has_films() ? N_X : 2 * N_X; /* check_forces() checks velocities with films */
    const ErrorNorm *norm = &run->norm;
    const double lengths = norm->speed[0] + norm->speed_floor[0], angles = norm->speed[1] + norm->speed_floor[1];
    const double fast[2] = {1.0 / lengths, 1.0 / angles};
    double missed[N_Y] = {0.0}, off[N_Y] = {0.0}, defect = known, least;
    for (int k = 0; k < rows; k++) {
        missed[k] = rate[k] - dy[k];
        off[k] = h * missed[k];
    }
    for (int pass = 0; pass < 2; pass++) {
        defect = known, least = known * AUDIT_DEFECT;
        for (int k = 0; k < rows; k++) {
            const double weight = norm->inverse_scale[k] * (k < N_X ? 1.0 : fast[is_angle[k % N_X]]); /* audit_weight */
            const double size = fabs(off[k]) * weight;
            if (size <= least)
                continue;
            const double limit = AUDIT_DEFECT + AUDIT_DIGITS * (fabs(y[k]) + fabs(h * dy[k])) * weight;
            if (size > defect * limit)
                defect = size / limit, least = size * AUDIT_DEFECT / limit;
        }
        if (pass || defect <= 1.0 || !step->method->stiff || has_films() || factor_newton_matrix(run, h, p))
            break;
        newton_solve(&run->newton.linear, h, 0.0, missed, off);
    }
    return defect > known ? defect : 0.0;
}

/*
 * Check the rates of the dense output against the right-hand side, positions and velocities separately. Steps so short
 * that the tolerance allows any error accumulate errors if the method is inconsistent. The limit is a fraction of the
 * largest rate and of the change of rates, plus errors that add up to few tolerances over the time passed. Iterations
 * leave a fraction of a tolerance in every step. An explicit step limited by stability has errors of some tolerances.
 */
static void check_rate(Integrator *run, const Step *step, double t, const double *y, const double *rate,
    const double *dy, const Parameters *p)
{
    for (int part = 0; part < (has_films() ? 1 : 2); part++) {
        const double slip = N_FRICTIONS ? AUDIT_SLIP / (part ? step->h : 1.0) : 0.0;
        const double passed = max_of(min_of(fabs(t), step->h * (double)(run->counts.steps + 1)), step->h);
        const int bounded = !step->method->stiff && run->choice.stability > 1.0;
        double off = 0.0, most = 0.0, allowed = max_of(AUDIT_DRIFT / passed, bounded ? AUDIT_BOUNDED / step->h : 0.0);
        for (int k = part * N_X; k < (part + 1) * N_X; k++) {
            const double weight = audit_weight(run, k), change = fabs(step->dy[k] - run->dy[k]);
            off = max_of(off, fabs(rate[k] - dy[k]) * weight);
            most = max_of(most, (fabs(dy[k]) + (part ? 0.0 : fabs(step->h * dy[N_X + k]))) * weight);
            allowed = max_of(allowed, (AUDIT_CHANGE * change + AUDIT_DIGITS * fabs(y[k]) / step->h + slip) * weight);
        }
        if (off <= AUDIT_RATE * most + allowed || !is_at_drive_jump(run, step, p))
            record_check(&run->audit, CHECK_rate, off, AUDIT_RATE * most + allowed, t, -1);
    }
}

/* Check the rates that a step used at its end against the right-hand side. */
static void check_end(Integrator *run, Step *step, const Parameters *p)
{
    double dy[N_Y];
    RhsOutputs rhs;
    if (has_tolerance(run) && !rates(run, step->t + step->h, step->y, p, dy, &rhs))
        record_check(&run->audit, CHECK_defect, scaled_defect(run, step, step->y, step->dy, dy, p), 1.0,
            step->t + step->h, -1);
}

/* Check film forces by the accelerations that they cause, except in steps that begin or end at a jump of a drive. */
static void check_forces(Integrator *run, const Step *step, double t, const RhsOutputs *rhs, const double *rate,
    const double *dy, const Parameters *p)
{
    int where;
    if (!has_films())
        return;
    double most = largest_film_force(rhs, &where);
    for (int i = 0; i < N_CLEARANCES; i++)
        most = has_film(i) ? max_of(most, FILM_FADED * run->contacts.F_peak[i]) : most;
    const double fraction = relative_film_error(run, step, rate, dy, most, 1.0), limit = film_audit_limit(run, step);
    if (where >= 0 && has_tolerance(run) && run->counts.steps > 0
        && (fraction <= limit || !is_at_drive_jump(run, step, p)))
        record_check(&run->audit, CHECK_force, fraction, limit, t, where);
}

/* Check a state at fraction theta of a step; drawn: at a random point, with an additional check. */
static void check_state_inside(Integrator *run, Step *step, double theta, int drawn, const double *y, const double *dy,
    const RhsOutputs *rhs, const Parameters *p)
{
    const double t = step->t + theta * step->h;
    double rate[2 * N_X];
    interpolate_rates(step, theta, 2 * N_X, rate);
    const double defect = has_tolerance(run) ? scaled_defect(run, step, y, rate, dy, p) : 0.0;
    if (has_tolerance(run) && (defect <= 1.0 || !is_at_drive_jump(run, step, p)))
        record_check(&run->audit, CHECK_defect, defect, 1.0, t, -1);
    if (drawn && has_tolerance(run) && !N_CLEARANCES) /* rates in contacts change quickly inside a step */
        check_rate(run, step, t, y, rate, dy, p);
    check_forces(run, step, t, rhs, rate, dy, p);
    check_joints(run, t, rhs, p);
    check_branches(run, step, t, y, rhs, p);
}

/*
 * Check the state at fraction theta of a step from its dense output; drawn: at a random point, with additional checks.
 */
static void check_inside(Integrator *run, Step *step, double theta, int drawn, const Parameters *p)
{
    const double t = step->t + theta * step->h;
    double y[N_Y], dy[N_Y], all[N_S];
    RhsOutputs rhs;
    if (compute_dense_output(run, p, step))
        return;
    if (run->counts.steps == 0) { /* the first step projects a start that violates the constraints */
        interpolate(run, step, theta, y);
        if (rates(run, t, y, p, dy, &rhs))
            return;
    } else if (state_at(run, step, theta, p, y, dy, &rhs))
        return; /* states after an event may be undefined */
    check_state_inside(run, step, theta, drawn, y, dy, &rhs, p);
    if (!drawn)
        return;
    to_absolute(t, y, &run->discrete, p, all);
    check_constraints(run, t, all, !RATE_JUMPS, p);
    if (is_branch_consistent(run, &rhs))
        check_accelerations(run, t, y, dy, all, p);
}

/* Return whether user-defined event i changes sign in a step at a zero, and not at a pole, by bisection. */
static int event_has_zero(Integrator *run, Step *step, double fraction, int i, const Parameters *p)
{
    double low = 0.0, high = fraction, y[N_Y], dy[N_Y];
    const double before = run->rhs.event[i], after = step->rhs.event[i];
    double nearest = INFINITY;
    RhsOutputs rhs;
    for (int n = 0; n < AUDIT_HALVINGS && compute_dense_output(run, p, step) == 0; n++) {
        const double middle = 0.5 * (low + high);
        if (state_at(run, step, middle, p, y, dy, &rhs))
            return 0;
        nearest = fabs(rhs.event[i]);
        if (rhs.event[i] * before > 0.0)
            low = middle;
        else
            high = middle;
    }
    return nearest < 0.01 * min_of(fabs(before), fabs(after));
}

/* Return whether user-defined event i exceeds its uncertainty at the beginning of a step, or at its end (`end`). */
static int is_event_resolved(Integrator *run, const Step *step, int end, int i, const Parameters *p)
{
    const int k = N_EVENT_FUNCTIONS - N_USER_EVENTS + i;
    return end ? is_resolved(run, step->t + step->h, step->y, &step->rhs, k, p)
        : is_resolved(run, run->t, run->y, &run->rhs, k, p);
}

/* Record the magnitudes of user-defined events in a step before it is committed, and find zeros that end no step. */
static void check_event_zeros(Integrator *run, Step *step, double fraction, int event, const Parameters *p)
{
    Audit *audit = &run->audit;
    audit->ended = event - (N_EVENT_FUNCTIONS - N_USER_EVENTS);
    for (int i = 0; i < N_USER_EVENTS; i++) {
        const double before = run->rhs.event[i], after = step->rhs.event[i];
        const StageValues seen = stage_values(step, N_EVENT_FUNCTIONS - N_USER_EVENTS + i);
        double inside = fabs(after); /* the beginning may be a located pole */
        for (int k = 0; k < step->n_seen; k++)
            inside = max_of(inside, fabs(stage_value(seen, k)));
        if (step->h > AUDIT_SHORT * audit->longest && isfinite(inside))
            audit->event_scale[i] = max_of(audit->event_scale[i], inside);
        const double noise = AUDIT_NOISE * audit->event_scale[i];
        audit->away[i] |= max_of(fabs(before), inside) > noise;
        /* start_just_after() set the sign already */
        const int begins_beyond = run->counts.steps == 0 && run->discrete.event_sign[i] * after > 0.0;
        /* also from a pole, near which it grows and falls at once */
        const int far = fraction * step->h > event_location_tolerance(run);
        audit->event_before[i] = audit->ended == i && far && is_event_resolved(run, step, 0, i, p) ? before : 0.0;
        audit->crossed[i] = fraction >= 1.0 && audit->ended != i && !begins_beyond && before * after < 0.0
            && fabs(before) > noise && fabs(after) > noise && event_direction[i] * after >= 0.0
            && is_event_resolved(run, step, 0, i, p) && is_event_resolved(run, step, 1, i, p)
            && event_has_zero(run, step, fraction, i, p);
    }
}

/*
 * Return the mean number of steps between two drawn ones, which limits the cost of their checks. It depends on the
 * method alone, so that a run in a batch is checked at the same steps.
 */
static double mean_interval(const Method *method)
{
    const double evaluations = method->stages * (method->lane >= BY_RADAU5 ? AUDIT_ITERATIONS : 1.0);
    return AUDIT_COST / (AUDIT_SHARE * max_of(evaluations, AUDIT_LEAST_STAGES));
}

/*
 * Check the inside of an accepted step up to `fraction` before it is committed. The state at an event is known, and its
 * check needs no right-hand side.
 */
static void audit_step(Integrator *run, Step *step, double fraction, int event, const Parameters *p)
{
    Audit *audit = &run->audit;
    if (!audit->level)
        return;
    const long evaluations = run->counts.evaluations;
    const int dense_ready = step->dense_ready;
    const double h = fraction * step->h;
    const int all = audit->level == AUDIT_FULL, due = run->counts.steps >= audit->due;
    const int whole = fraction >= 1.0 && event < 0;
    const int is_longer = (h > AUDIT_LONGER * run->control.last_step || (whole && h > AUDIT_LONGEST * audit->longest))
        && !step->method->controls_length
        && ((double)audit->longer + 1.0) * mean_interval(step->method) < (double)run->counts.steps;
    const int by_turn = (int)(audit->turns % 2);
    const int drawn = all || (due && !by_turn), measured = all || is_longer || (due && by_turn);
    const int places = all ? AUDIT_INSIDE : drawn || (is_longer && !whole);
    check_event_zeros(run, step, fraction, event, p);
    const int ends = event >= 0 && fraction < 1.0;
    const int known = ends && run->counts.steps > 0 && run->roots.samples.beyond == fraction;
    if (known)
        check_state_inside(
            run, step, fraction, 0, run->roots.samples.y, run->roots.samples.dy, &run->roots.samples.rhs, p);
    if (places || (ends && !known) || measured) {
        const DiscreteState discrete = run->discrete;
        if (ends && !known)
            check_inside(run, step, fraction, 0, p);
        for (int k = 0; k < places; k++)
            check_inside(run, step, fraction * (k + draw_random(audit)) / places, drawn, p);
        if (drawn && fraction >= 1.0)
            check_end(run, step, p);
        if (measured && whole && has_tolerance(run))
            check_step_error(run, step, p);
        if (drawn || (due && whole)) {
            const double first = audit->turns++ ? 1.0 : AUDIT_FIRST;
            audit->due = run->counts.steps + 1 + (long)(2.0 * draw_random(audit) * first * mean_interval(step->method));
        }
        audit->longer += is_longer;
        run->discrete = discrete;
    }
    /* checks do not count as integration: the dense output is computed and counted again when needed */
    restore_evaluations(run, evaluations);
    step->dense_ready = dense_ready;
}

