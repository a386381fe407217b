/* The audit of a run at the end of each step (run/audit.c), and the functions that start and report the audit. */

/*
 * Check a user-defined event at the end of a step, and record CHECK_event. The violation is infinite in two cases.
 * First, a zero in the step is not in the list of events: one that check_event_zeros() found (has_zero), or, at the
 * event that ends the step, a value that falls below AUDIT_ZERO_FRACTION of its size before. Second, rounding around
 * zero is listed as AUDIT_WRONG_STEPS successive events. n_events_before: number of events in the list before the step.
 * Clears has_zero, and was_nonzero_since_event after a listed event. Called by check_step_end() for each user-defined
 * event.
 */
static void check_user_event(Integrator *run, int event, int n_events_before)
{
    Audit *audit = &run->audit;
    const double value_before = audit->event_before[event], value_after = run->rhs.event[event];
    const int is_end_event = audit->end_event == event
        && fabs(value_before) > AUDIT_NOISE_FRACTION * audit->event_scale[event]
        && fabs(value_after) < AUDIT_ZERO_FRACTION * fabs(value_before) && event_direction[event] * value_before <= 0.0;
    int is_recorded = 0;
    for (int k = n_events_before; k < run->events.n; k++)
        is_recorded |= run->events.number[k] == event;
    record_check(audit, CHECK_event, 0.0, 1.0, run->t, event);
    if ((is_end_event || audit->has_zero[event]) && !is_recorded)
        record_check(audit, CHECK_event, INFINITY, 1.0, run->t, event);
    if (is_recorded)
        audit->n_rounding_events[event] =
            audit->was_nonzero_since_event[event] ? 0 : audit->n_rounding_events[event] + 1;
    if (audit->n_rounding_events[event] >= AUDIT_WRONG_STEPS)
        record_check(audit, CHECK_event, INFINITY, 1.0, run->t, event);
    audit->was_nonzero_since_event[event] = is_recorded ? 0 : audit->was_nonzero_since_event[event];
    audit->has_zero[event] = 0;
}

/*
 * Check the frozen branches at the end of a step: count the successive steps that each switching function ends on the
 * wrong branch by more than 0.001 of its largest magnitude. Any other step restarts the count. After AUDIT_WRONG_STEPS
 * such steps, CHECK_branch is recorded with the limit 1e-4 of that magnitude, if the value exceeds its uncertainty.
 * Suppressed functions are not counted. Updates the largest magnitudes of the functions.
 */
static void check_branches_at_step_end(Integrator *run, const Parameters *p)
{
    Audit *audit = &run->audit;
    double g[AT_LEAST_ONE(N_SWITCHES)], smallest = 0.0;
    for (int k = 0; k < N_SWITCHES; k++)
        g[k] = run->discrete.branch[k] * run->rhs.g[k];
    for (int k = 0; k < N_SWITCHES; k++)
        audit->switch_scale[k] = max_of(audit->switch_scale[k], fabs(g[k]));
    for (int k = 0; k < N_SWITCHES; k++)
        smallest = min_of(smallest, g[k]);
    if (!(smallest < 0.0)) {
        memset(audit->n_wrong_steps, 0, sizeof audit->n_wrong_steps);
        return;
    }
    for (int k = 0; k < N_SWITCHES; k++) {
        if (!(g[k] < -1e-3 * audit->switch_scale[k]) || k == run->roots.suppressed_switch) {
            audit->n_wrong_steps[k] = 0;
            continue;
        }
        audit->n_wrong_steps[k] = (unsigned char)min_of(audit->n_wrong_steps[k] + 1, 100);
        if (audit->n_wrong_steps[k] >= AUDIT_WRONG_STEPS
            && is_above_uncertainty(run, run->t, run->y, &run->rhs, N_CLEARANCES + k, p))
            record_check(audit, CHECK_branch, -g[k], 1e-4 * audit->switch_scale[k], run->t, k);
    }
}

/*
 * Check the end of an accepted and committed step by the run-time checks of the audit:
 * - residuals of the constraint equations;
 * - gaps of joints with play against the stored contact states;
 * - with dependent coordinates (N_DEPENDENT), the residuals of all constraint equations in the absolute state;
 * - zero forces in open joints;
 * - branches of the switching functions, only while they are frozen (kept over a step);
 * - user-defined events. n_events_before: number of events in the list before the step.
 * Return 0, also if the audit is off, or AUDITED once any check has failed.
 */
static int check_step_end(Integrator *run, int n_events_before, const Parameters *p)
{
    Audit *audit = &run->audit;
    if (!audit->level)
        return 0;
    check_constraint_residuals(run);
    check_gaps(run, run->t, &run->rhs, p);
#if N_DEPENDENT
    double absolute_state[N_S];
    convert_integrated_to_absolute(run->t, run->y, &run->discrete, p, absolute_state);
    check_constraints(run, run->t, absolute_state, 0, p);
#endif
    check_forces_of_open_joints(run);
    if (N_SWITCHES > 0 && run->discrete.is_frozen) {
        record_check(audit, CHECK_branch, 0.0, 1.0, run->t, -1);
        check_branches_at_step_end(run, p);
    }
    for (int i = 0; i < N_USER_EVENTS; i++)
        check_user_event(run, i, n_events_before);
    audit->end_event = -1;
    return audit->status;
}

/*
 * Initialize the audit of a run before its first step: no check has a record, and the random numbers restart, the same
 * in every run. level: AuditLevel, AUDIT_OFF: no audit; size: of the mechanism, m.
 */
static void start_audit(Integrator *run, int level, double size)
{
    run->audit = (Audit){.level = level, .mechanism_size = size, .random = 1u, .next_audited_step = 2};
    for (int k = 0; k < N_CHECKS; k++)
        run->audit.record[k] = (AuditRecord){-1.0, 0.0, -1};
}

/*
 * Copy the record of each check (N_CHECKS) for Python: its largest multiple of the limit (< 0: not checked), the time
 * (s), and the index of the joint, equation or event there (-1: none). Called when a run of a batch ends.
 */
static void report_audit(const Integrator *run, double *multiples, double *t, int *index)
{
    for (int k = 0; k < N_CHECKS; k++) {
        multiples[k] = run->audit.record[k].max_ratio;
        t[k] = run->audit.record[k].t;
        index[k] = run->audit.record[k].index;
    }
}
