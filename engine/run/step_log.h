/*
 * The log of steps: what is counted, residuals, and whether time still advances. Owns Counts, Residuals and Progress.
 */
#ifndef GUDGEON_STEP_LOG_H
#define GUDGEON_STEP_LOG_H

enum {
    MAX_NO_ADVANCE = 200 + 2 * N_EVENT_FUNCTIONS, /* steps in a row that an event ends where they begin */
    MAX_SHORT_STEPS = 2000 /* steps in a row that are too short to lead anywhere */
};

static inline void count_evaluations(Integrator *run, long n) { run->counts.evaluations += n; }

/* Back to a number from before: what output needs is not integration. */
static inline void restore_evaluations(Integrator *run, long evaluations) { run->counts.evaluations = evaluations; }

static inline void count_step(Integrator *run, int stiff)
{
    run->counts.steps++;
    run->counts.stiff_steps += stiff;
}
static inline void count_rejected(Integrator *run) { run->counts.rejected++; }
static inline void count_jacobian(Integrator *run) { run->counts.jacobians++; }
static inline void count_switch(Integrator *run) { run->counts.switches++; }

static inline void set_phi_dot_max(Integrator *run, double phi_dot) { run->residuals.phi_dot_max = phi_dot; }

/* What ended a step (-1: nothing), and whether that was right at its beginning. */
static inline void record_step_end(Integrator *run, int event, int no_advance)
{
    run->progress.no_advance = no_advance ? run->progress.no_advance + 1 : 0;
    run->progress.ended[event < 0 ? N_EVENT_FUNCTIONS : event]++;
}

static inline int is_chattering(const Integrator *run) { return run->progress.no_advance > MAX_NO_ADVANCE; }

/* Whether so many steps were too short that speeds grow beyond all bounds, as at a dead centre. */
static inline int note_short_step(Integrator *run, int crawls)
{
    run->progress.short_steps = crawls ? run->progress.short_steps + 1 : 0;
    return run->progress.short_steps > MAX_SHORT_STEPS;
}

/* Whether the run no longer advances; what ends its steps is counted anew with each look at its pace. */
static inline int stalls(Integrator *run, double t_end)
{
    const int stalled = has_stalled(&run->progress.monitor, run->t, t_end);
    for (int k = 0; k < N_EVENT_FUNCTIONS && !stalled && run->progress.monitor.steps % MONITOR_STEPS == 1; k++)
        run->progress.ended[k] = 0;
    return stalled;
}

#endif
