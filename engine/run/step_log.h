/*
 * Counts of a run, its constraint residuals, and the test whether time still advances. This file owns Counts, Residuals
 * and Progress (run/run.h).
 */
#ifndef GUDGEON_STEP_LOG_H
#define GUDGEON_STEP_LOG_H

enum {
    MAX_NO_ADVANCE = 200 + 2 * N_EVENT_FUNCTIONS, /* successive steps that an event ends at their beginning */
    MAX_SHORT_STEPS = 2000 /* successive steps that are too short to advance */
};

/* Add n evaluations of the right-hand side to the counts of a run; n may be negative. */
static inline void count_evaluations(Integrator *run, long n) { run->counts.evaluations += n; }

/* Restore an earlier number of evaluations: those for output do not count as integration. */
static inline void restore_evaluations(Integrator *run, long evaluations) { run->counts.evaluations = evaluations; }

/* Count an accepted step, also as a stiff step if its method is stiff. */
static inline void count_step(Integrator *run, int is_stiff)
{
    run->counts.steps++;
    run->counts.stiff_steps += is_stiff;
}

/* Count a rejected step. */
static inline void count_rejected_step(Integrator *run) { run->counts.rejected++; }

/* Count a linearization (Jacobian) of the equations of motion. */
static inline void count_jacobian(Integrator *run) { run->counts.jacobians++; }

/* Count a change between stick and slip of a friction element. */
static inline void count_mode_change(Integrator *run) { run->counts.switches++; }

/*
 * Set the largest residual |Phi_dot| of the velocity constraints so far; also to a smaller value, after the jump of a
 * drive.
 */
static inline void set_phi_dot_max(Integrator *run, double phi_dot) { run->residuals.phi_dot_max = phi_dot; }

/*
 * Count the event function that ended a step (-1: none). is_at_beginning: whether it ended the step at its beginning;
 * such successive steps are counted as well, for is_chattering(). Any other step resets that count.
 */
static inline void count_step_end(Integrator *run, int event, int is_at_beginning)
{
    run->progress.no_advance = is_at_beginning ? run->progress.no_advance + 1 : 0;
    run->progress.n_steps_ended[event < 0 ? N_EVENT_FUNCTIONS : event]++;
}

/* Return whether more than MAX_NO_ADVANCE successive steps were ended by events at their beginning. */
static inline int is_chattering(const Integrator *run) { return run->progress.no_advance > MAX_NO_ADVANCE; }

/*
 * Count successive steps that are too short to advance (`is_short`), and return whether they exceed MAX_SHORT_STEPS.
 * Speeds then grow without bound, as at a dead centre. A longer step resets the count. Called once for each accepted
 * step.
 */
static inline int detect_short_step_stall(Integrator *run, int is_short)
{
    run->progress.short_steps = is_short ? run->progress.short_steps + 1 : 0;
    return run->progress.short_steps > MAX_SHORT_STEPS;
}

/*
 * Count a step in the progress monitor and return whether the run no longer advances towards t_end (s), by
 * detect_stall(). When the monitor starts to compare MONITOR_STEPS new steps, the counts of the event functions that
 * ended steps restart; a stall keeps them for the report. Called before each step of a method with step-size control.
 */
static inline int detect_run_stall(Integrator *run, double t_end)
{
    const int stalled = detect_stall(&run->progress.monitor, run->t, t_end);
    for (int k = 0; k < N_EVENT_FUNCTIONS && !stalled && run->progress.monitor.steps % MONITOR_STEPS == 1; k++)
        run->progress.n_steps_ended[k] = 0;
    return stalled;
}

#endif
