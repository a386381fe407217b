/*
 * Fast acceptance of steps of runs in SIMD lanes, where no sample, observer or projection needs the step. They are
 * accepted in the lanes as accept_step() of methods/adaptive.c does. Their run is updated later, before its next call.
 * Such a step is called lane-local: it changes the vectors of its lane and not yet its run. Steps of different lanes
 * have different lengths in any case.
 */
#define LANE_LOCAL_STEPS (LANE_SERIES && !N_LOOPS && !N_USER_EVENTS && !N_WATCHED && !N_TRANSIENTS && !DRIVE_IMPULSES)

#if LANE_LOCAL_STEPS
#include "../scalar_simd/error_weights.h"

/* Of each lane: the time of its run's next sample and its end, s; the longest step of the last series, s. */
typedef struct {
    Lanes next_sample, t_end, max_step;
    LaneBits may_accept;             /* whether steps may be accepted here */
    long steps[LANES], max_local_steps[LANES]; /* steps accepted here; allowed number */
    int has_state[LANES]; /* whether the lane has the run's state */
} LaneLocalSteps;

/*
 * Load the part of run i's state into lane k that only steps accepted in the lane need: scales, limits, sample times.
 * The lane may accept as many steps as single->max_local_steps() returns; none with fixed steps or after a
 * rejected attempt.
 */
static void load_lane_local_steps(
    LaneLocalSteps *local_steps, LaneIntegrator *lanes, int k, const Batch *batch, long i,
    const SingleRunFunctions *single, const Integrator *run)
{
    const double *t = get_sample_times(batch, i);
    local_steps->next_sample[k] = t[batch->done[i]];
    local_steps->t_end[k] = get_end_time(batch, i);
    local_steps->steps[k] = 0;
    local_steps->max_local_steps[k] = run->control.fixed > 0.0 || run->control.attempt.again
        || run->control.attempt.lane != BY_TAYLOR ? 0 : single->max_local_steps(run);
    local_steps->may_accept[k] = -(local_steps->max_local_steps[k] > 0);
    local_steps->has_state[k] = 1;
    lanes->choice.mean_length[k] = run->choice.mean_length[0];
    lanes->norm.energy_scale[k] = run->norm.energy_scale;
    lanes->norm.work_scale[k] = run->norm.work_scale;
    for (int kind = 0; kind < 2; kind++) {
        lanes->norm.speed[kind][k] = run->norm.speed[kind];
        lanes->norm.speed_floor[kind][k] = run->norm.speed_floor[kind];
        lanes->norm.min_size[kind][k] = run->norm.min_size[kind];
    }
    for (int j = 0; j < 2 * N_X; j++)
        lanes->norm.inverse_scale[j][k] = run->norm.inverse_scale[j];
}

/* Return the magnitude of the times in each lane, s, for rounding, as open_attempt() does for a single run. */
static Lanes compute_time_scale(const LaneLocalSteps *local_steps, const LaneIntegrator *lanes)
{
    return lanes_max_of(lanes_min_of(lanes_fabs(local_steps->t_end), broadcast(MAX_RUN_SCALE_S)), lanes_fabs(lanes->t));
}

/*
 * Accept the tried steps of Taylor series that need no action of their run, and return the mask of their lanes. These
 * steps end before the next sample and the end of the run, are not too short and are finite. State, speeds, energy
 * scale and error weights of the lanes are updated as after a single step. The next length h is TAYLOR_AHEAD of the
 * series' longest step, or the rest of the run. may_accept is cleared in lanes with max_local_steps accepted steps.
 */
static LaneBits accept_lane_local_steps(
    LaneLocalSteps *local_steps, LaneIntegrator *lanes, const LaneStep *step, Lanes *h)
{
    const Lanes t = lanes->t + step->h;
    const LaneBits accepted = local_steps->may_accept & step->is_accepted & (step->error <= lanes->control.accept)
        & (t < local_steps->next_sample) & (step->h < local_steps->t_end - lanes->t)
        & ~(lanes->choice.h_rho > 0.0) & (step->h >= SHORT_STEP_FRACTION * compute_time_scale(local_steps, lanes))
        & ~find_nonfinite_lanes(step->y, step->dy, N_Y);
    update_energy_scale(lanes, accepted, step->y);
    for (int j = 0; j < N_Y; j++) {
        lanes->series.lost[j] = select_value(accepted, lanes->series.next_lost[j], lanes->series.lost[j]);
        lanes->y[j] = select_value(accepted, step->y[j], lanes->y[j]);
        lanes->dy[j] = select_value(accepted, step->dy[j], lanes->dy[j]);
    }
    for (int j = 0; j < N_WORK; j++)
        lanes->rhs.power[j] = select_value(accepted, step->rhs.power[j], lanes->rhs.power[j]);
    lanes->t = select_value(accepted, t, lanes->t);
    const Lanes mean = lanes->choice.mean_length;
    const Lanes updated = select_value(mean > 0.0, LENGTH_MEMORY * mean + (1.0 - LENGTH_MEMORY) * step->h, step->h);
    lanes->choice.mean_length = select_value(accepted, updated, mean);
    update_speeds(lanes);
    update_error_weights(lanes);
    local_steps->max_step = select_value(accepted, lanes->series.max_step, local_steps->max_step);
    const Lanes left = local_steps->t_end - lanes->t, next = TAYLOR_AHEAD * lanes->series.max_step;
    *h = select_value(accepted, select_value(next > left * EQUAL_LENGTH_RATIO, left, next), *h);
    for (int k = 0; k < LANES; k++) {
        local_steps->steps[k] -= accepted[k];
        local_steps->may_accept[k] = -(local_steps->steps[k] < local_steps->max_local_steps[k]);
    }
    return accepted;
}

/*
 * Copy the steps accepted in lane k to its run, with their counts, and open the run's next attempt with length h (s).
 * Copies nothing if the lane has accepted no step since it was loaded.
 */
static void flush_lane_local_steps(
    LaneLocalSteps *local_steps, const LaneIntegrator *lanes, int k, double h, Integrator *run)
{
    const long steps = local_steps->steps[k];
    local_steps->has_state[k] = 0;
    if (!steps)
        return;
    for (int j = 0; j < N_Y; j++) {
        run->y[j] = lanes->y[j][k];
        run->dy[j] = lanes->dy[j][k];
        run->norm.weight[j] = lanes->norm.weight[j][k];
        run->series.lost[j] = lanes->series.lost[j][k];
    }
    for (int j = 0; j < N_WORK; j++)
        run->rhs.power[j] = lanes->rhs.power[j][k];
    run->t = lanes->t[k];
    run->norm.energy_scale = lanes->norm.energy_scale[k];
    run->norm.speed[0] = lanes->norm.speed[0][k];
    run->norm.speed[1] = lanes->norm.speed[1][k];
    run->counts.steps += steps;
    run->counts.evaluations += 2 * steps - !!run->series.ready;
    run->progress.ended[N_EVENT_FUNCTIONS] += steps;
    run->progress.monitor.steps += steps;
    run->choice.since += (int)steps;
    run->choice.n_contrary_steps = run->progress.no_advance = run->progress.short_steps = run->newton.ready =
        run->series.ready = 0;
    run->discrete.is_frozen = 1;
    run->choice.h_rho = 0.0;
    run->choice.mean_length[0] = lanes->choice.mean_length[k];
    run->series.max_step = local_steps->max_step[k];
    run->control.h = TAYLOR_AHEAD * run->series.max_step;
    run->control.attempt = (Attempt){.h = h, .longest = h, .left = local_steps->t_end[k] - run->t,
        .far = compute_time_scale(local_steps, lanes)[k], .open = 1};
}
#endif
