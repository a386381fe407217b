/*
 * Steps that need no action of their run: no sample lies in them, nothing is observed, no closure is projected. They
 * are accepted in the lanes as accept_step() of methods/adaptive.c does. Their run is updated later, before its next
 * call.
 */
#define QUIET (TAYLOR && !N_LOOPS && !N_USER_EVENTS && !N_WATCHED && !N_PULSES && !DRIVE_IMPULSES)

#if QUIET
#include "../both/error_weights.h"

/* Of each lane: the time of its run's next sample and its end, s; the longest step of the last series, s. */
typedef struct {
    Lanes sample, t_end, reach;
    LaneBits open;                    /* whether steps may be accepted here */
    long steps[LANES], unseen[LANES]; /* steps accepted here; allowed number */
    int here[LANES];                  /* whether the lane has the run's state */
} Quiet;

/* Load the part of run i's state into lane k that only steps accepted in the lanes need. */
static void load_quiet_lane(
    Quiet *quiet, LaneIntegrator *x, int k, const Batch *b, long i, const Single *one, const Integrator *run)
{
    const double *t = times_of(b, i);
    quiet->sample[k] = t[b->done[i]];
    quiet->t_end[k] = t_end_of(b, i);
    quiet->steps[k] = 0;
    quiet->unseen[k] = run->control.fixed > 0.0 || run->control.attempt.again ? 0 : one->unseen(run);
    quiet->open[k] = -(quiet->unseen[k] > 0);
    quiet->here[k] = 1;
    x->norm.energy_scale[k] = run->norm.energy_scale;
    x->norm.work_scale[k] = run->norm.work_scale;
    for (int kind = 0; kind < 2; kind++) {
        x->norm.speed[kind][k] = run->norm.speed[kind];
        x->norm.speed_floor[kind][k] = run->norm.speed_floor[kind];
        x->norm.least[kind][k] = run->norm.least[kind];
    }
    for (int j = 0; j < 2 * N_X; j++)
        x->norm.inverse_scale[j][k] = run->norm.inverse_scale[j];
}

/* Return the scale of the times of steps for rounding, s, as open_attempt() does. */
static Lanes scale_of(const Quiet *quiet, const LaneIntegrator *x)
{
    return lanes_max_of(lanes_min_of(lanes_fabs(quiet->t_end), all_of(MAX_RUN_SCALE_S)), lanes_fabs(x->t));
}

/* Accept the tried steps that need no action of their run, and choose the next lengths h. Returns their lanes. */
static LaneBits accept_quiet_steps(Quiet *quiet, LaneIntegrator *x, const LaneStep *step, Lanes *h)
{
    const Lanes t = x->t + step->h;
    const LaneBits now = quiet->open & step->taken & (step->error <= x->control.accept) & (t < quiet->sample)
        & (step->h < quiet->t_end - x->t) & (step->h >= SHORT_STEP_FRACTION * scale_of(quiet, x))
        & ~not_finite(step->y, step->dy, N_Y);
    add_works(x, now, step->y);
    for (int j = 0; j < N_Y; j++) {
        x->y[j] = pick(now, step->y[j], x->y[j]);
        x->dy[j] = pick(now, step->dy[j], x->dy[j]);
    }
    for (int j = 0; j < N_WORK; j++)
        x->rhs.power[j] = pick(now, step->rhs.power[j], x->rhs.power[j]);
    x->t = pick(now, t, x->t);
    update_speeds(x);
    update_error_weights(x);
    quiet->reach = pick(now, x->series.reach, quiet->reach);
    const Lanes left = quiet->t_end - x->t, next = TAYLOR_AHEAD * x->series.reach;
    *h = pick(now, pick(next > left * EQUAL_LENGTH_RATIO, left, next), *h);
    for (int k = 0; k < LANES; k++) {
        quiet->steps[k] -= now[k];
        quiet->open[k] = -(quiet->steps[k] < quiet->unseen[k]);
    }
    return now;
}

/* Copy the steps accepted in lane k to its run, which continues with a step of length h. */
static void unload_quiet_lane(Quiet *quiet, const LaneIntegrator *x, int k, double h, Integrator *run)
{
    const long steps = quiet->steps[k];
    quiet->here[k] = 0;
    if (!steps)
        return;
    for (int j = 0; j < N_Y; j++) {
        run->y[j] = x->y[j][k];
        run->dy[j] = x->dy[j][k];
        run->norm.weight[j] = x->norm.weight[j][k];
    }
    for (int j = 0; j < N_WORK; j++)
        run->rhs.power[j] = x->rhs.power[j][k];
    run->t = x->t[k];
    run->norm.energy_scale = x->norm.energy_scale[k];
    run->norm.speed[0] = x->norm.speed[0][k];
    run->norm.speed[1] = x->norm.speed[1][k];
    run->counts.steps += steps;
    run->counts.evaluations += 2 * steps - !!run->series.ready;
    run->progress.ended[N_EVENT_FUNCTIONS] += steps;
    run->progress.monitor.steps += steps;
    run->choice.since += (int)steps;
    run->choice.n_against = run->progress.no_advance = run->progress.short_steps = run->newton.ready =
        run->series.ready = 0;
    run->discrete.held = 1;
    run->choice.stability = 0.0;
    run->series.reach = quiet->reach[k];
    run->control.h = TAYLOR_AHEAD * run->series.reach;
    run->control.attempt = (Attempt){.h = h, .longest = h, .left = quiet->t_end[k] - run->t,
        .far = scale_of(quiet, x)[k], .open = 1};
}
#endif
