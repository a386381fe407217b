/*
 * Fast acceptance of steps of runs in SIMD lanes, where no sample, observer or projection needs the step. They are
 * accepted in the lanes as accept_step() of methods/adaptive.c does. Their run is updated later, before its next call.
 */
#define LOCAL_STEPS (TAYLOR && !N_LOOPS && !N_USER_EVENTS && !N_WATCHED && !N_PULSES && !DRIVE_IMPULSES)

#if LOCAL_STEPS
#include "../scalar_simd/error_weights.h"

/* Of each lane: the time of its run's next sample and its end, s; the longest step of the last series, s. */
typedef struct {
    Lanes sample, t_end, max_step;
    LaneBits open;                    /* whether steps may be accepted here */
    long steps[LANES], max_local_steps[LANES]; /* steps accepted here; allowed number */
    int here[LANES];                  /* whether the lane has the run's state */
} LocalSteps;

/*
 * Load the part of run i's state into lane k that only steps accepted in the lane need: scales, limits, sample times.
 * The lane may accept as many steps as single->max_local_steps() returns; none with fixed steps or after a
 * rejected attempt.
 */
static void load_local_steps(
    LocalSteps *local_steps, LaneIntegrator *x, int k, const Batch *batch, long i, const SingleRunFunctions *single,
    const Integrator *run)
{
    const double *t = get_sample_times(batch, i);
    local_steps->sample[k] = t[batch->done[i]];
    local_steps->t_end[k] = get_end_time(batch, i);
    local_steps->steps[k] = 0;
    local_steps->max_local_steps[k] = run->control.fixed > 0.0 || run->control.attempt.again ? 0
        : single->max_local_steps(run);
    local_steps->open[k] = -(local_steps->max_local_steps[k] > 0);
    local_steps->here[k] = 1;
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

/* Return the magnitude of the times in each lane, s, for rounding, as open_attempt() does for a single run. */
static Lanes compute_time_scale(const LocalSteps *local_steps, const LaneIntegrator *x)
{
    return lanes_max_of(lanes_min_of(lanes_fabs(local_steps->t_end), all_of(MAX_RUN_SCALE_S)), lanes_fabs(x->t));
}

/*
 * Accept the tried steps that need no action of their run, and set the next lengths h of these lanes. Return their
 * mask. These steps end before the next sample and the end of the run, are not too short and are finite. State, speeds,
 * energy scale and error weights of the lanes are updated as after a single step.
 */
static LaneBits accept_local_steps(LocalSteps *local_steps, LaneIntegrator *x, const LaneStep *step, Lanes *h)
{
    const Lanes t = x->t + step->h;
    const LaneBits accepted = local_steps->open & step->taken & (step->error <= x->control.accept)
        & (t < local_steps->sample) & (step->h < local_steps->t_end - x->t)
        & (step->h >= SHORT_STEP_FRACTION * compute_time_scale(local_steps, x))
        & ~find_nonfinite_lanes(step->y, step->dy, N_Y);
    add_works(x, accepted, step->y);
    for (int j = 0; j < N_Y; j++) {
        x->y[j] = pick(accepted, step->y[j], x->y[j]);
        x->dy[j] = pick(accepted, step->dy[j], x->dy[j]);
    }
    for (int j = 0; j < N_WORK; j++)
        x->rhs.power[j] = pick(accepted, step->rhs.power[j], x->rhs.power[j]);
    x->t = pick(accepted, t, x->t);
    update_speeds(x);
    update_error_weights(x);
    local_steps->max_step = pick(accepted, x->series.max_step, local_steps->max_step);
    const Lanes left = local_steps->t_end - x->t, next = TAYLOR_AHEAD * x->series.max_step;
    *h = pick(accepted, pick(next > left * EQUAL_LENGTH_RATIO, left, next), *h);
    for (int k = 0; k < LANES; k++) {
        local_steps->steps[k] -= accepted[k];
        local_steps->open[k] = -(local_steps->steps[k] < local_steps->max_local_steps[k]);
    }
    return accepted;
}

/*
 * Copy the steps accepted in lane k to its run, with their counts, and open the run's next attempt with length h (s).
 * Copies nothing if the lane has accepted no step since it was loaded.
 */
static void flush_local_steps(LocalSteps *local_steps, const LaneIntegrator *x, int k, double h, Integrator *run)
{
    const long steps = local_steps->steps[k];
    local_steps->here[k] = 0;
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
    run->choice.n_contrary_steps = run->progress.no_advance = run->progress.short_steps = run->newton.ready =
        run->series.ready = 0;
    run->discrete.held = 1;
    run->choice.stability = 0.0;
    run->series.max_step = local_steps->max_step[k];
    run->control.h = TAYLOR_AHEAD * run->series.max_step;
    run->control.attempt = (Attempt){.h = h, .longest = h, .left = local_steps->t_end[k] - run->t,
        .far = compute_time_scale(local_steps, x)[k], .open = 1};
}
#endif
