/*
 * Fast acceptance of steps of runs in SIMD lanes, where no sample, observer, event or check needs the step. They are
 * accepted in the lanes as accept_step() of methods/adaptive.c does. Their run is updated later, before its next call.
 * Such a step is called lane-local: it changes the vectors of its lane and not yet its run. Steps of different lanes
 * have different lengths in any case. Limits of these steps: batch/local_step_limits.c.
 */
#define LANE_LOCAL_STEPS \
    (!(LANE_SERIES && N_LOOPS) && !N_USER_EVENTS && !N_MONITORED && !N_TRANSIENTS && !DRIVE_IMPULSES)

#if LANE_LOCAL_STEPS
#include "../scalar_simd/error_weights.h"
#include "../scalar_simd/step_decisions.h"

/*
 * Of each lane: the time of its run's next sample and its end, s, and which steps may be accepted. Taylor series: their
 * longest step, s. Other methods: limits of the steps, and what a run keeps of its steps besides its state.
 */
typedef struct {
    Lanes next_sample, t_end;
    Lanes mean_length;               /* of the steps of the method, s (switch_method_after_step()) */
    LaneBits may_accept;             /* whether steps may be accepted here */
    long steps[LANES], max_local_steps[LANES]; /* steps accepted here; allowed number */
    int has_state[LANES]; /* whether the lane has the run's state */
#if LANE_SERIES
    Lanes max_step;
#else
    struct {
        STEP_LIMITS(Lanes)
    } limits;
    Lanes h, error_before, observed_order, last_step, n_opposing, opposing_length, h_rho, convergence_rate, evaluations;
    Lanes begin, phi_max, phi_dot_max; /* begin: of the last accepted step, s */
    Lanes film_error, film_h, film_steps; /* FilmErrors; steps since the measurement */
    Lanes e_max[AT_LEAST_ONE(N_CLEARANCES)], F_peak[AT_LEAST_ONE(N_CLEARANCES)], t_peak[AT_LEAST_ONE(N_CLEARANCES)];
    LaneBits is_rising[AT_LEAST_ONE(N_CLEARANCES)];
    Lanes switch_scale[AT_LEAST_ONE(N_SWITCHES)];
#endif
} LaneLocalSteps;

/* Return the magnitude of the times in each lane, s, for rounding, as open_attempt() does for a single run. */
static Lanes compute_time_scale(const LaneLocalSteps *local_steps, const LaneIntegrator *lanes)
{
    return lanes_max_of(lanes_min_of(lanes_fabs(local_steps->t_end), broadcast(MAX_RUN_SCALE_S)), lanes_fabs(lanes->t));
}

/*
 * Return the mask of the lanes whose tried step may be accepted in the lane and ends before the next sample and the end
 * of the run, is not too short and is finite.
 */
static LaneBits find_unsampled_steps(
    const LaneLocalSteps *local_steps, const LaneIntegrator *lanes, const LaneStep *step, Lanes t)
{
    return local_steps->may_accept & step->is_accepted & (step->error <= lanes->control.max_accepted_error)
        & (t < local_steps->next_sample) & (step->h < local_steps->t_end - lanes->t)
        & (step->h >= SHORT_STEP_FRACTION * compute_time_scale(local_steps, lanes))
        & ~find_nonfinite_lanes(step->y, step->dy, N_Y);
}

/*
 * Return the length h (s) of the next step in each lane. It is the remaining time of the run where h is longer, or
 * shorter by less than the factor EQUAL_LENGTH_RATIO.
 */
static Lanes limit_length_by_end(const LaneLocalSteps *local_steps, const LaneIntegrator *lanes, Lanes h)
{
    const Lanes remaining_time = local_steps->t_end - lanes->t;
    return select_value(h > remaining_time * EQUAL_LENGTH_RATIO, remaining_time, h);
}

/* Count the steps of the mask `accepted`, and clear may_accept in lanes with max_local_steps accepted steps. */
static void count_local_steps(LaneLocalSteps *local_steps, LaneBits accepted)
{
    for (int k = 0; k < LANES; k++) {
        local_steps->steps[k] -= accepted[k];
        local_steps->may_accept[k] = -(local_steps->steps[k] < local_steps->max_local_steps[k]);
    }
}

/*
 * Copy the error norm of a run into lane k: inverse scales and smallest sizes of the state, scales of energy, work and
 * speeds.
 */
static void load_error_norm(LaneIntegrator *lanes, int k, const Integrator *run)
{
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

/* Copy the state of lane k, its scales of tolerances and the counts of `steps` steps to its run. */
static void flush_state(const LaneIntegrator *lanes, int k, long steps, Integrator *run)
{
    for (int j = 0; j < N_Y; j++) {
        run->y[j] = lanes->y[j][k];
        run->dy[j] = lanes->dy[j][k];
        run->norm.weight[j] = lanes->norm.weight[j][k];
    }
    run->t = lanes->t[k];
    run->norm.energy_scale = lanes->norm.energy_scale[k];
    run->norm.speed[0] = lanes->norm.speed[0][k];
    run->norm.speed[1] = lanes->norm.speed[1][k];
    run->counts.steps += steps;
    run->progress.n_steps_ended[N_EVENT_FUNCTIONS] += steps;
    run->progress.monitor.steps += steps;
    run->choice.steps_since_change += (int)steps;
    run->progress.no_advance = run->progress.short_steps = 0;
    run->discrete.is_frozen = 1;
}

#if LANE_SERIES
/* Do nothing: series need no other data of their run. */
static void load_controller_state(
    LaneLocalSteps *local_steps, int k, const LocalStepLimits *limits, const Integrator *run)
{
    (void)local_steps, (void)k, (void)limits, (void)run;
}

/*
 * Accept the tried steps of Taylor series that need no action of their run, in the lanes of the mask `requested`, and
 * return the mask of their lanes. A step with a sample, or with a stiffness estimate (h rho > 0), is not accepted.
 * State, speeds, energy scale and error weights of the lanes are updated as after a single step. The next length h is
 * TAYLOR_AHEAD of the series' longest step, or the rest of the run.
 */
static LaneBits accept_lane_local_steps(LaneLocalSteps *local_steps, LaneIntegrator *lanes, int method,
    LaneBits requested, LaneStep *step, const LaneParameters *p, Lanes *h)
{
    const Lanes t = lanes->t + step->h;
    const LaneBits accepted =
        requested & find_unsampled_steps(local_steps, lanes, step, t) & ~(lanes->choice.h_rho > 0.0);
    (void)method, (void)p;
    update_energy_scale(lanes, accepted, step->y);
    for (int j = 0; j < N_Y; j++) {
        lanes->series.rounding_errors[j] =
            select_value(accepted, lanes->series.end_rounding_errors[j], lanes->series.rounding_errors[j]);
        lanes->y[j] = select_value(accepted, step->y[j], lanes->y[j]);
        lanes->dy[j] = select_value(accepted, step->dy[j], lanes->dy[j]);
    }
    for (int j = 0; j < N_WORK; j++)
        lanes->rhs.power[j] = select_value(accepted, step->rhs.power[j], lanes->rhs.power[j]);
    lanes->t = select_value(accepted, t, lanes->t);
    local_steps->mean_length =
        select_value(accepted, update_mean_length(local_steps->mean_length, step->h), local_steps->mean_length);
    update_speeds(lanes);
    update_error_weights(lanes);
    local_steps->max_step = select_value(accepted, lanes->series.max_step, local_steps->max_step);
    *h = select_value(accepted, limit_length_by_end(local_steps, lanes, TAYLOR_AHEAD * lanes->series.max_step), *h);
    count_local_steps(local_steps, accepted);
    return accepted;
}

/*
 * Copy the steps by Taylor series accepted in lane k to its run, with their counts, rounding errors and longest valid
 * length, and open the run's next attempt with length h (s). The run's series and linearization are discarded. Copies
 * nothing if the lane has accepted no step since it was loaded; the lane is empty afterwards in any case.
 */
static void flush_lane_local_steps(
    LaneLocalSteps *local_steps, const LaneIntegrator *lanes, int k, double h, Integrator *run)
{
    const long steps = local_steps->steps[k];
    local_steps->has_state[k] = 0;
    if (!steps)
        return;
    flush_state(lanes, k, steps, run);
    for (int j = 0; j < N_Y; j++)
        run->series.rounding_errors[j] = lanes->series.rounding_errors[j][k];
    for (int j = 0; j < N_WORK; j++)
        run->rhs.power[j] = lanes->rhs.power[j][k];
    run->counts.evaluations += 2 * steps - !!run->series.ready;
    run->choice.n_opposing_steps = (int)min_of(0.0, (double)run->choice.n_opposing_steps + (double)steps);
    run->newton.ready = run->series.ready = 0;
    run->choice.h_rho = 0.0;
    run->choice.mean_length[0] = local_steps->mean_length[k];
    run->series.max_step = local_steps->max_step[k];
    run->control.h = TAYLOR_AHEAD * run->series.max_step;
    run->control.attempt = (Attempt){.h = h, .first_h = h, .remaining_time = local_steps->t_end[k] - run->t,
        .time_magnitude = compute_time_scale(local_steps, lanes)[k], .is_open = 1, .lane_method = METHOD_TAYLOR};
}
#else
#include "lane_controlled_steps.c"
#endif

/*
 * Load what lanes need to accept steps of run i into lane k: scales of tolerances, step limits, controller state, next
 * sample and end time. The lane may accept as many steps as the run's limits allow. It accepts none, and nothing is
 * loaded, with fixed steps, after a rejected attempt, or if the method belongs to the other library.
 */
static void load_lane_local_steps(
    LaneLocalSteps *local_steps, LaneIntegrator *lanes, int k, const Batch *batch, long i,
    const SingleRunFunctions *scalar_functions, const Integrator *run)
{
    const double *t = get_sample_times(batch, i);
    LocalStepLimits limits;
    scalar_functions->get_local_step_limits(run, batch->p_motion + i * batch->numbers, &limits);
    local_steps->steps[k] = 0;
    local_steps->max_local_steps[k] =
        (run->control.attempt.lane_method == METHOD_TAYLOR) == LANE_SERIES ? limits.max_steps : 0;
    local_steps->may_accept[k] = -(local_steps->max_local_steps[k] > 0);
    local_steps->has_state[k] = local_steps->max_local_steps[k] > 0;
    if (!local_steps->has_state[k])
        return;
    local_steps->mean_length[k] = run->choice.mean_length[run->control.attempt.lane_method >= METHOD_RODAS5P];
    local_steps->next_sample[k] = t[batch->done[i]];
    local_steps->t_end[k] = get_end_time(batch, i);
    load_error_norm(lanes, k, run);
    load_controller_state(local_steps, k, &limits, run);
}
#endif
