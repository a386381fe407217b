/*
 * The log of steps: what is counted, residuals, and whether time still advances. Owns Counts, Residuals and Progress.
 */
#ifndef GUDGEON_STEP_LOG_H
#define GUDGEON_STEP_LOG_H

enum {
    MAX_STUCK = 200 + 2 * N_MARGINS, /* steps in a row that an event ends where they begin */
    MAX_CRAWL = 2000 /* steps in a row that are too short to lead anywhere */
};

static inline void count_evaluations(Run *run, long n) { run->counts.evaluations += n; }

/* Back to a number from before: what output needs is not integration. */
static inline void restore_evaluations(Run *run, long evaluations) { run->counts.evaluations = evaluations; }

static inline void count_step(Run *run, int stiff)
{
    run->counts.steps++;
    run->counts.stiff_steps += stiff;
}
static inline void count_rejected(Run *run) { run->counts.rejected++; }
static inline void count_jacobian(Run *run) { run->counts.jacobians++; }
static inline void count_switch(Run *run) { run->counts.switches++; }

static inline void set_phi_dot_max(Run *run, double phi_dot) { run->residuals.phi_dot_max = phi_dot; }

/* What ended a step (-1: nothing), and whether that was right at its beginning. */
static inline void note_step_end(Run *run, int event, int stuck)
{
    run->progress.stuck = stuck ? run->progress.stuck + 1 : 0;
    run->progress.ended[event < 0 ? N_MARGINS : event]++;
}

static inline int is_stuck(const Run *run) { return run->progress.stuck > MAX_STUCK; }

/* Whether so many steps were too short that speeds grow beyond all bounds, as at a dead centre. */
static inline int note_crawl(Run *run, int crawls)
{
    run->progress.crawl = crawls ? run->progress.crawl + 1 : 0;
    return run->progress.crawl > MAX_CRAWL;
}

/* Whether the run no longer advances; what ends its steps is counted anew with each look at its pace. */
static inline int stalls(Run *run, double t_end)
{
    const int stalled = creeps(&run->progress.pace, run->t, t_end);
    for (int k = 0; k < N_MARGINS && !stalled && run->progress.pace.steps % PACE_STEPS == 1; k++)
        run->progress.ended[k] = 0;
    return stalled;
}

#endif
