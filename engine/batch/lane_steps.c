/*
 * Steps of rk4 for several runs: those on which nothing happens but motion. One on which in any lane a contact begins
 * or ends, a watched expression crosses zero, a pivot vanishes or a number ceases to be finite is made by the single
 * runs themselves (methods/rk4.c), each for its own.
 */
#include "lane_motion.c"

static void close_state(LaneRun *run, Lanes t, Lanes *y, const LaneParameters *p) { project_rows(run, t, y, p); }

#define TrialOf LaneTrial
#define Touched LaneBits
#include "../both/rk4_trial.h"
#include "../both/watch.h"
#if N_USER_EVENTS
#include "../both/speed.h"
#endif

/*
 * Lanes in which a contact begins, ends or is touched within the step, may be (as may_touch of methods/rk4_inside.c
 * has it) or goes too deep, or an event's expression changes its side, is zero or no number.
 */
static LaneBits happens(const LaneRun *run, double h, const LaneTrial *trial, const LaneParameters *p)
{
    LaneBits some = {0};
    for (int i = 0; i < N_CLEARANCES; i++) {
        const LaneClearance *a = &run->aside.clearance[i], *b = &trial->aside.clearance[i];
        const LaneBits turns = (a->deltadot > 0.0) & (b->deltadot < 0.0);
        if (any_of(turns)) {
            const Lanes x = (b->delta - a->delta - b->deltadot * h) / (a->deltadot - b->deltadot);
            some |= turns & ~is_closed(&run->memory.latch[i]) & (a->delta + a->deltadot * x > 0.0);
        }
        const Lanes delta = trial->aside.clearance[i].delta;
        const LaneBits closed = is_closed(&run->memory.latch[i]);
        some |= (closed & (delta < 0.0)) | (~closed & (trial->touched[i] | (delta >= 0.0)));
        some |= delta > lane_deepest(p, i);
    }
    for (int i = 0; i < N_USER_EVENTS; i++) {
        const Lanes value = trial->aside.event[i], side = run->memory.event_side[i];
        some |= ~(((value > 0.0) & (side > 0.0)) | ((value < 0.0) & (side < 0.0)));
    }
    return some;
}

/*
 * One step of all lanes. Returns the lanes in which something rare is met; where there are any, or it is to be kept,
 * `before` is the run as it was.
 */
static LaneBits lane_step(LaneRun *run, double h, double t_new, const LaneParameters *p, int keep, LaneRun *before)
{
    LaneTrial trial;
    const Lanes evaluations = run->counts.evaluations;
    run->memory.rare = (LaneBits){0};
    rk4_trial(run, h, p, &trial);
    run->memory.rare |= not_finite(trial.dy, trial.y, N_Y) | happens(run, h, &trial, p);
    if (keep || any_of(run->memory.rare)) {
        *before = *run;
        before->counts.evaluations = evaluations;
    }
    for (int j = 0; j < N_Y; j++) {
        run->y[j] = trial.y[j];
        run->dy[j] = trial.dy[j];
    }
#if N_USER_EVENTS
    note_speed(run);
#endif
    run->t = all_of(t_new);
    run->counts.steps += 1.0;
    for (int i = 0; i < N_CLEARANCES; i++) {
        watch_turn(run, i, h, &run->aside.clearance[i], &trial.aside.clearance[i]);
        note_turn(run, i, trial.aside.clearance[i].deltadot);
    }
    run->aside = trial.aside;
    accept_state(run->t, run->y, &run->memory, p, &run->aside, &run->residuals.phi_max, &run->residuals.phi_dot_max);
    for (int i = 0; i < N_CLEARANCES; i++)
        watch_joint(run, i);
    return run->memory.rare;
}
