/* The audit at the end of each step (run/audit.c), and the functions that start the audit and report its record. */

/*
 * Check user-defined event i at the end of a step before which `listed` events were recorded. Each zero must be
 * recorded, and rounding around zero must not be recorded repeatedly.
 */
static void check_event(Integrator *run, int i, int listed)
{
    Audit *audit = &run->audit;
    const double before = audit->event_before[i], now = run->rhs.event[i];
    const int ended = audit->ended == i && fabs(before) > AUDIT_NOISE * audit->event_scale[i]
        && fabs(now) < AUDIT_ZERO * fabs(before) && event_direction[i] * before <= 0.0;
    int found = 0;
    for (int k = listed; k < run->events.n; k++)
        found |= run->events.number[k] == i;
    record_check(audit, CHECK_event, 0.0, 1.0, run->t, i);
    if ((ended || audit->crossed[i]) && !found)
        record_check(audit, CHECK_event, INFINITY, 1.0, run->t, i);
    audit->noise[i] = found && !audit->away[i] ? audit->noise[i] + 1 : found ? 0 : audit->noise[i];
    if (audit->noise[i] >= AUDIT_WRONG)
        record_check(audit, CHECK_event, INFINITY, 1.0, run->t, i);
    audit->away[i] = found ? 0 : audit->away[i];
    audit->crossed[i] = 0;
}

/*
 * Check the frozen branches at the end of a step: distance on the wrong branch, and number of successive steps there.
 */
static void check_branches_at_end(Integrator *run, const Parameters *p)
{
    Audit *audit = &run->audit;
    double g[AT_LEAST_ONE(N_SWITCHES)], least = 0.0;
    for (int k = 0; k < N_SWITCHES; k++)
        g[k] = run->discrete.branch[k] * run->rhs.g[k];
    for (int k = 0; k < N_SWITCHES; k++)
        audit->switch_scale[k] = max_of(audit->switch_scale[k], fabs(g[k]));
    for (int k = 0; k < N_SWITCHES; k++)
        least = min_of(least, g[k]);
    if (!(least < 0.0)) {
        memset(audit->wrong, 0, sizeof audit->wrong);
        return;
    }
    for (int k = 0; k < N_SWITCHES; k++) {
        if (!(g[k] < -1e-3 * audit->switch_scale[k]) || k == run->roots.skip || meets[k]) {
            audit->wrong[k] = 0;
            continue;
        }
        audit->wrong[k] = (unsigned char)min_of(audit->wrong[k] + 1, 100);
        if (audit->wrong[k] >= AUDIT_WRONG && is_resolved(run, run->t, run->y, &run->rhs, N_CLEARANCES + k, p))
            record_check(audit, CHECK_branch, -g[k], 1e-4 * audit->switch_scale[k], run->t, k);
    }
}

/* Check the end of an accepted step, before which `listed` events were recorded. Return 0 or AUDITED. */
static int audit_state(Integrator *run, int listed, const Parameters *p)
{
    Audit *audit = &run->audit;
    if (!audit->level)
        return 0;
    check_residuals(run);
    check_joints(run, run->t, &run->rhs, p);
#if N_CHAIN
    double all[N_S];
    to_absolute(run->t, run->y, &run->discrete, p, all);
    check_constraints(run, run->t, all, 0, p);
#endif
    check_open_forces(run);
    if (N_SWITCHES > 0 && run->discrete.held) {
        record_check(audit, CHECK_branch, 0.0, 1.0, run->t, -1);
        check_branches_at_end(run, p);
    }
    for (int i = 0; i < N_USER_EVENTS; i++)
        check_event(run, i, listed);
    audit->ended = -1;
    return audit->status;
}

/* Start the audit of a run at a level (AUDIT_OFF: none); size: of the mechanism, m. */
static void start_audit(Integrator *run, int level, double size)
{
    run->audit = (Audit){.level = level, .size = size, .random = 1u, .due = 2};
    for (int k = 0; k < N_CHECKS; k++)
        run->audit.record[k] = (AuditRecord){-1.0, 0.0, -1};
}

/* Report for each check the largest multiple of its limit (< 0: not checked), its time (s) and its place. */
static void report_audit(const Integrator *run, double *worst, double *t, int *where)
{
    for (int k = 0; k < N_CHECKS; k++) {
        worst[k] = run->audit.record[k].worst;
        t[k] = run->audit.record[k].t;
        where[k] = run->audit.record[k].where;
    }
}
