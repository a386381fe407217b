/*
 * Kinematic runs of a batch in SIMD lanes, one run per lane, each with its own steps (lane_positions.c). A step that is
 * not regular (fails, is at a change point, has a velocity jump) is made again by its run with scalar code.
 */
#include "lane_positions.c"
#include "../batch/lane_calls.h"
#include "../scalar_simd/motion_series.h"

enum { BLOCK_ROWS = 16, CACHE_LINE_NUMBERS = 8 /* of a line of 64 bytes */ };

/*
 * The runs in the lanes, -1: none; has_run: their mask. t1: time of the next sample, s; h: length of the step. Works
 * are those of the next sample, J. next_state: next sample whose state is stored; steps_before_check: steps until the
 * next check of progress. Maxima and extremes are those of the samples so far (RunSamples). `positions` are the current
 * one and memory for the next one.
 *
 * Steps in which all runs reach their next samples are in lockstep: n_lockstep of them, limit at most, are not yet
 * counted in the runs. Their series, after the largest |a|, are the columns of `block`. next_times: times of the
 * samples after these steps, s.
 */
typedef struct {
    const KinematicBatch *batch;
    const KinematicRunFunctions *scalar_functions;
    KinematicRun *run[LANES];
    long index[LANES], next_state[LANES], steps_before_check[LANES], n_lockstep, limit;
    LaneParameters p;
    LanePosition positions[2], *position, *next;
    LaneBits has_run, are_finite;
    Lanes h, t1, extent, work[N_WORK], phi_max, phi_dot_max, largest_a, smallest_a, next_times[BLOCK_ROWS];
    Lanes block[MAX_MOTION_SERIES + 1][BLOCK_ROWS];
} RunLanes;

/*
 * Return the first sample from k on, of n, whose state is stored. It is k if all states are requested; else the next
 * sample that the audit draws, or the last one.
 */
static long find_next_state(const KinematicBatch *batch, long n, long k)
{
    long next = n - 1;
    if (batch->has_states || n <= batch->n_drawn)
        return k;
    for (long j = 0; j < batch->n_drawn; j++) {
        const long drawn = (long)((double)n * batch->drawn[j]);
        next = drawn >= k && drawn < next ? drawn : next;
    }
    return next;
}

/*
 * Copy the run in lane k to the lane: position, step length, works and extremes of its samples, time of the next
 * sample. Also set the next stored state and the steps until the next check of progress. Called after each scalar step.
 */
static void copy_run_to_lane(RunLanes *lanes, int k)
{
    const KinematicRun *run = lanes->run[k];
    const RunSamples *samples = &run->samples;
    const Position *from = &run->motion;
    LanePosition *to = lanes->position;
    for (int j = 0; j < N_Q; j++) {
        to->q[j][k] = from->q[j];
        to->v[j][k] = from->v[j];
    }
    for (int j = 0; j < N_X; j++) {
        to->s[j][k] = from->s[j];
        to->s_rate[j][k] = from->s_rate[j];
        to->s_second[j][k] = from->s_second[j];
        for (int order = 0; order < N_HIGHER; order++)
            to->s_higher[j][order][k] = from->s_higher[j][order];
    }
    to->t[k] = from->t;
    to->interval[k] = from->interval;
    lanes->h[k] = samples->step_length.h;
    lanes->t1[k] = samples->t[samples->done];
    for (int j = 0; j < N_WORK; j++)
        lanes->work[j][k] = samples->y[samples->done * N_S + 2 * N_Q + j];
    lanes->phi_max[k] = samples->phi_max;
    lanes->phi_dot_max[k] = samples->phi_dot_max;
    lanes->largest_a[k] = samples->largest_a;
    lanes->smallest_a[k] = samples->smallest_a;
    lanes->are_finite[k] = samples->are_finite ? -1 : 0;
    lanes->next_state[k] = find_next_state(lanes->batch, samples->n, samples->done);
    lanes->steps_before_check[k] = lanes->scalar_functions->count_steps_before_check(&run->monitor);
}

/* Copy the extremes of the samples (residuals, accelerations, finiteness) from lane k to its run. */
static void copy_extremes_to_run(const RunLanes *lanes, int k)
{
    RunSamples *samples = &lanes->run[k]->samples;
    samples->phi_max = lanes->phi_max[k];
    samples->phi_dot_max = lanes->phi_dot_max[k];
    samples->largest_a = lanes->largest_a[k];
    samples->smallest_a = lanes->smallest_a[k];
    samples->are_finite = lanes->are_finite[k] != 0;
}

/* Copy lane k to its run, which continues with scalar steps: position, works, step length, extremes of the samples. */
static void copy_lane_to_run(const RunLanes *lanes, int k)
{
    KinematicRun *run = lanes->run[k];
    Position *to = &run->motion;
    const LanePosition *from = lanes->position;
    to->t = from->t[k];
    to->is_interpolated = 0;
    to->phi = from->phi[k];
    to->phi_dot = from->phi_dot[k];
    to->last_correction = from->last_correction[k];
    for (int j = 0; j < N_Q; j++) {
        to->q[j] = from->q[j][k];
        to->v[j] = from->v[j][k];
        to->a[j] = from->a[j][k];
    }
    for (int j = 0; j < N_X; j++) {
        to->s[j] = from->s[j][k];
        to->s_rate[j] = from->s_rate[j][k];
        to->s_second[j] = from->s_second[j][k];
        for (int order = 0; order < N_HIGHER; order++)
            to->s_higher[j][order] = from->s_higher[j][order][k];
    }
    to->interval = from->interval[k];
    for (int j = 0; j < N_WORK; j++)
        run->samples.y[run->samples.done * N_S + 2 * N_Q + j] = lanes->work[j][k];
    run->samples.step_length.h = lanes->h[k];
    copy_extremes_to_run(lanes, k);
}

/*
 * Store q, v, works and a of lane k as the next sample of its run, if the state of that sample is stored: if it has
 * reached next_state[k], which then moves on.
 */
static void store_lane_sample_state(RunLanes *lanes, int k)
{
    const RunSamples *samples = &lanes->run[k]->samples;
    const LanePosition *from = lanes->position;
    const long sample = samples->done;
    double *y = samples->y + sample * N_S, *a = samples->a + sample * N_Q;
    if (sample < lanes->next_state[k])
        return;
    for (int j = 0; j < N_Q; j++) {
        y[j] = from->q[j][k];
        y[N_Q + j] = from->v[j][k];
        a[j] = from->a[j][k];
    }
    for (int j = 0; j < N_WORK; j++)
        y[2 * N_Q + j] = lanes->work[j][k];
    lanes->next_state[k] = find_next_state(lanes->batch, samples->n, sample + 1);
}

/*
 * Write the largest |a| and the requested series of the current positions to row `row` of the block. Update the
 * extremes of the samples in the lanes of `is_sample`. Accepted positions and velocities are finite; only accelerations
 * and works are tested.
 */
static void add_lane_samples(RunLanes *lanes, LaneBits is_sample, long row)
{
    const KinematicBatch *batch = lanes->batch;
    const LanePosition *at = lanes->position;
    Lanes largest = broadcast(0.0), largest_or_nan = broadcast(0.0);
    DirectionOf direction = {.body = -1};
    for (long j = 0; j < batch->n_series; j++) {
        const MotionSeries *series = &batch->series[j];
        const long body = series->body < 0 ? 0 : series->body;
        lanes->block[j + 1][row] =
            evaluate_motion_series(series, at->q + body, at->v + body, at->a + body, &lanes->p, &direction);
    }
    for (int j = 0; j < N_Q; j++) {
        largest = lanes_max_of(lanes_fabs(at->a[j]), largest);
        largest_or_nan = get_larger_or_nan(largest_or_nan, at->a[j]);
    }
    lanes->block[0][row] = largest;
    for (int j = 0; j < N_WORK; j++)
        largest_or_nan = get_larger_or_nan(largest_or_nan, lanes->work[j]);
    lanes->are_finite &= (largest_or_nan <= DBL_MAX) | ~is_sample;
    lanes->phi_max = select_value(is_sample, lanes_max_of(at->phi, lanes->phi_max), lanes->phi_max);
    lanes->phi_dot_max = select_value(is_sample, lanes_max_of(at->phi_dot, lanes->phi_dot_max), lanes->phi_dot_max);
    lanes->largest_a = select_value(is_sample, lanes_max_of(lanes->largest_a, largest), lanes->largest_a);
    lanes->smallest_a = select_value(is_sample, lanes_min_of(lanes->smallest_a, largest), lanes->smallest_a);
}

/*
 * Gather one lane: copy the first n rows of lane k in a column of the block to `values`, a result array of the lane's
 * run, and prefetch the memory of later rows, which is not in the CPU cache. The loop for n = BLOCK_ROWS has a fixed
 * length.
 */
static inline void gather_lane_column(const Lanes *column, int k, long n, double *values)
{
    if (n == BLOCK_ROWS)
        for (int row = 0; row < BLOCK_ROWS; row++)
            values[row] = column[row][k];
    else
        for (long row = 0; row < n; row++)
            values[row] = column[row][k];
    for (long row = 0; row < n; row += CACHE_LINE_NUMBERS)
        __builtin_prefetch(values + row + BLOCK_ROWS + CACHE_LINE_NUMBERS, 1);
}

/* Copy n rows of the block in lane k, largest |a| and series, to the next n samples of its run. */
static void copy_lane_samples(const RunLanes *lanes, int k, long n)
{
    const KinematicBatch *batch = lanes->batch;
    const RunSamples *samples = &lanes->run[k]->samples;
    const long row = samples->index * batch->samples + samples->done;
    gather_lane_column(lanes->block[0], k, n, samples->largest + samples->done);
    for (long j = 0; j < batch->n_series; j++)
        gather_lane_column(lanes->block[j + 1], k, n, batch->values[j] + row);
}

/*
 * Add the n_lockstep steps that all lanes made together to the counts of their runs, copy their samples from the block,
 * and reset n_lockstep.
 */
static void count_lockstep_steps(RunLanes *lanes)
{
    const long n = lanes->n_lockstep;
    lanes->n_lockstep = 0;
    for (int k = 0; k < LANES && n; k++) {
        if (lanes->index[k] < 0)
            continue;
        copy_lane_samples(lanes, k, n);
        lanes->run[k]->samples.done += n;
        lanes->run[k]->samples.steps += n;
        lanes->run[k]->monitor.steps += n;
        lanes->steps_before_check[k] -= n;
    }
}

/*
 * Return how many steps in lockstep (one step to one sample in all lanes) may be made before the runs must be treated
 * one by one, BLOCK_ROWS at most. The limits are a stored state, a check of progress and the last sample; 0 if a step
 * is halved.
 */
static long find_lockstep_limit(const RunLanes *lanes)
{
    long limit = BLOCK_ROWS;
    for (int k = 0; k < LANES; k++) {
        if (lanes->index[k] < 0)
            continue;
        const RunSamples *samples = &lanes->run[k]->samples;
        const long to_state = lanes->next_state[k] - samples->done, to_end = samples->n - 1 - samples->done;
        limit = to_state < limit ? to_state : limit;
        limit = to_end < limit ? to_end : limit;
        limit = lanes->steps_before_check[k] < limit ? lanes->steps_before_check[k] : limit;
        limit = samples->step_length.halvings ? 0 : limit;
    }
    return limit;
}

/*
 * Begin a block of steps in lockstep: set its limit, and the times of the samples up to there; a lane without a run
 * keeps t1. Vectors of times are written in advance, since reading a vector that has just been written lane by lane
 * stalls.
 */
static void begin_lockstep_block(RunLanes *lanes)
{
    lanes->limit = find_lockstep_limit(lanes);
    for (int k = 0; k < LANES; k++) {
        const RunSamples *samples = &lanes->run[k]->samples;
        for (long row = 0; row < lanes->limit; row++)
            lanes->next_times[row][k] = lanes->index[k] < 0 ? lanes->t1[k] : samples->t[samples->done + row + 1];
    }
}

/* End the run in lane k with a status, and free the lane. */
static void end_run_in_lane(RunLanes *lanes, int k, int status)
{
    lanes->scalar_functions->end(lanes->batch, lanes->index[k], lanes->run[k], status);
    lanes->index[k] = -1;
    lanes->has_run[k] = 0;
}

/* Return whether the run in lane k has stored all its samples. */
static int has_all_samples(const RunLanes *lanes, int k)
{
    return lanes->run[k]->samples.done == lanes->run[k]->samples.n;
}

/*
 * Begin the next run in lane k if the lane is free; *next counts the n runs in `indices`. Runs that have begun before
 * (phase not NEW) are skipped. Runs that fail or end with their first sample are ended at once, and the following one
 * is tried. No run begins if the batch is ending.
 */
static void begin_next_run_in_lane(RunLanes *lanes, int k, long n, const long *indices, long *next)
{
    const KinematicBatch *batch = lanes->batch;
    while (lanes->index[k] < 0 && *next < n && !*batch->ending) {
        const long i = indices[(*next)++];
        if (batch->phase[i] != NEW)
            continue;
        lanes->index[k] = i;
        lanes->has_run[k] = -1;
        for (long j = 0; j < batch->numbers; j++)
            ((Lanes *)&lanes->p)[j][k] = batch->p[i * batch->numbers + j];
        lanes->extent[k] = batch->size[i];
        const int status = lanes->scalar_functions->begin(batch, i, lanes->run[k]);
        if (status || has_all_samples(lanes, k))
            end_run_in_lane(lanes, k, status);
        else
            copy_run_to_lane(lanes, k);
    }
}

/*
 * Count the accepted step of lane k, and store its end as a sample if it reaches t1[k]. The sample's series and largest
 * |a| are row 0 of lanes->block, by add_lane_samples(). Then t1 and h of the lane are set for the next sample, without
 * halvings. Progress is checked only after every steps_before_check[k] steps. Return 0 or STALLED.
 */
static int accept_lane_step(RunLanes *lanes, int k)
{
    KinematicRun *run = lanes->run[k];
    RunSamples *samples = &run->samples;
    const double t = lanes->position->t[k];
    samples->steps++;
    if (lanes->steps_before_check[k] > 0) {
        lanes->steps_before_check[k]--;
        run->monitor.steps++;
    } else if (lanes->scalar_functions->detect_stall(&run->monitor, t, run->t_end)) {
        return STALLED;
    } else {
        lanes->steps_before_check[k] = lanes->scalar_functions->count_steps_before_check(&run->monitor);
    }
    if (t < lanes->t1[k])
        return 0;
    store_lane_sample_state(lanes, k);
    copy_lane_samples(lanes, k, 1);
    samples->done++;
    if (samples->done < samples->n) {
        lanes->t1[k] = samples->t[samples->done];
        lanes->h[k] = lanes->t1[k] - t;
        samples->step_length.halvings = 0;
    }
    return 0;
}

/* How a trial step of a lane ended. */
enum Outcome { ACCEPTED, REJECTED, IRREGULAR };

/*
 * Complete the step of lane k by its outcome: ACCEPTED: count it; REJECTED: halve it; IRREGULAR, or MAX_HALVINGS
 * reached: make it again as a scalar step of its run. A run that fails or has all samples is ended. may_double: the
 * error is so small that a halved step length is doubled again.
 */
static void complete_lane_step(RunLanes *lanes, int k, enum Outcome outcome, int may_double)
{
    StepLength *step_length = &lanes->run[k]->samples.step_length;
    if (outcome == REJECTED && step_length->halvings < MAX_HALVINGS) {
        step_length->halvings++;
        lanes->h[k] *= 0.5;
        return;
    }
    if (outcome == ACCEPTED && step_length->halvings > 0 && may_double) {
        lanes->h[k] *= 2.0;
        step_length->halvings--;
    }
    if (outcome != ACCEPTED)
        copy_lane_to_run(lanes, k);
    const int status =
        outcome == ACCEPTED ? accept_lane_step(lanes, k) : lanes->scalar_functions->advance(lanes->run[k]);
    const int is_over = status || has_all_samples(lanes, k);
    if (is_over && outcome == ACCEPTED)
        copy_extremes_to_run(lanes, k);
    if (is_over)
        end_run_in_lane(lanes, k, status);
    else if (outcome != ACCEPTED)
        copy_run_to_lane(lanes, k);
}

/*
 * Make the next positions the current ones in the lanes of `is_accepted`; the other lanes keep their positions.
 * Pointers are exchanged, so that `next` holds free memory.
 */
static void accept_next_positions(RunLanes *lanes, LaneBits is_accepted)
{
    LanePosition *const next = lanes->next;
    for (long j = 0; j < (long)(sizeof *next / sizeof(Lanes)) && any_of(~is_accepted); j++)
        ((Lanes *)next)[j] = select_value(is_accepted, ((Lanes *)next)[j], ((Lanes *)lanes->position)[j]);
    lanes->next = lanes->position;
    lanes->position = next;
}

/*
 * Complete a step that is not in lockstep (some run is not accepted or reaches no sample): count earlier steps in
 * lockstep, accept positions, store samples, and complete the step of each run. The arguments are masks of lanes.
 * Irregular steps are made by the scalar code; lanes neither accepted nor irregular are rejected. may_double: the next
 * step may have twice the length. Lanes without a run are skipped.
 */
static void complete_lane_steps(RunLanes *lanes, LaneBits is_accepted, LaneBits is_irregular, LaneBits is_sample,
    LaneBits may_double)
{
    count_lockstep_steps(lanes);
    accept_next_positions(lanes, is_accepted);
    if (any_of(is_sample))
        add_lane_samples(lanes, is_sample, 0);
    for (int k = 0; k < LANES; k++)
        if (lanes->index[k] >= 0)
            complete_lane_step(lanes, k, is_irregular[k] ? IRREGULAR : is_accepted[k] ? ACCEPTED : REJECTED,
                may_double[k] != 0);
}

/*
 * Try one step in all lanes, and complete it. A step is accepted if its Newton correction and trapezoidal error are
 * small and it hides no transient; works are integrated over accepted steps if requested. If all runs reach their next
 * sample (a step in lockstep), their counts are updated later, together, in count_lockstep_steps(): at the latest after
 * lanes->limit steps. Else complete_lane_steps() treats each run.
 */
static void advance_run_lanes(RunLanes *lanes)
{
    const KinematicBatch *batch = lanes->batch;
    const double max_correction = batch->max_correction, max_error = MAX_STEP_ERROR * max_correction;
    const LanePosition *const position = lanes->position;
    LanePosition *const next = lanes->next;
    if (!lanes->n_lockstep)
        begin_lockstep_block(lanes);
    const Lanes sum = position->t + lanes->h, t = select_value(sum < lanes->t1, sum, lanes->t1);
    Lanes correction;
    LaneBits is_irregular =
        ~(t > position->t) | solve_lane_positions(&lanes->p, lanes->extent, t, position, next, &correction);
    is_irregular |= (t == lanes->t1) & find_ill_conditioned_lanes(next);
    const Lanes error = compute_trapezoidal_error(position, next, lanes->extent);
    LaneBits is_accepted = ~is_irregular & (correction <= max_correction) & (error <= max_error);
    for (int k = 0; N_TRANSIENTS && k < LANES; k++)
        if (lanes->index[k] >= 0 && is_accepted[k]
            && lanes->run[k]->samples.step_length.halvings <= MAX_HALVINGS_FOR_TRANSIENT
            && lanes->scalar_functions->has_transient(position->t[k], t[k], lanes->run[k]->p))
            is_accepted[k] = 0;
    if (batch->has_works && any_of(is_accepted))
        is_irregular |= is_accepted
            & integrate_lane_works(&lanes->p, lanes->extent, position, next, is_accepted, lanes->work);
    is_accepted &= ~is_irregular;
    const LaneBits is_sample = is_accepted & ~(t < lanes->t1) & lanes->has_run;
    if (lanes->n_lockstep >= lanes->limit || any_of(lanes->has_run & ~is_sample)) {
        complete_lane_steps(lanes, is_accepted, is_irregular, is_sample, error < STEP_DOUBLING_ERROR * max_error);
        return;
    }
    accept_next_positions(lanes, is_accepted);
    add_lane_samples(lanes, is_sample, lanes->n_lockstep++);
    lanes->t1 = lanes->next_times[lanes->n_lockstep - 1];
    lanes->h = lanes->t1 - t;
    if (lanes->n_lockstep == lanes->limit)
        count_lockstep_steps(lanes);
}

/* Return the number of lanes with a run. */
static int count_active_lanes(const RunLanes *lanes)
{
    int count = 0;
    for (int k = 0; k < LANES; k++)
        count += lanes->index[k] >= 0;
    return count;
}

/* Return LANES, the number of runs that gudgeon_kinematic_lanes() computes together. */
int gudgeon_lane_count(void) { return LANES; }

/*
 * Compute n runs of a batch, whose indices are given, in lanes, each in one of the memories run[LANES].
 * scalar_functions: those that gudgeon_single_run_functions() returns. The last run in the lanes is completed by scalar
 * steps. If the batch is ending, the current runs end at once, and no run begins.
 */
void gudgeon_kinematic_lanes(
    const void *batch, const void *scalar_functions, void *const *run, long n, const long *indices)
{
    RunLanes lanes;
    memset(&lanes, 0, sizeof lanes);
    lanes.batch = batch, lanes.scalar_functions = scalar_functions;
    lanes.extent = broadcast(1.0);
    lanes.position = &lanes.positions[0], lanes.next = &lanes.positions[1];
    long next = 0;
    for (int k = 0; k < LANES; k++) {
        lanes.run[k] = run[k];
        lanes.index[k] = -1;
    }
    do {
        for (int k = 0; k < LANES; k++)
            begin_next_run_in_lane(&lanes, k, n, indices, &next);
        if (count_active_lanes(&lanes) > 1 && !*lanes.batch->ending)
            advance_run_lanes(&lanes);
    } while ((count_active_lanes(&lanes) > 1 || next < n) && !*lanes.batch->ending);
    count_lockstep_steps(&lanes);
    for (int k = 0; k < LANES; k++) {
        int status = 0;
        if (lanes.index[k] < 0)
            continue;
        copy_lane_to_run(&lanes, k);
        while (!status && lanes.run[k]->samples.done < lanes.run[k]->samples.n)
            status = lanes.scalar_functions->advance(lanes.run[k]);
        lanes.scalar_functions->end(lanes.batch, lanes.index[k], lanes.run[k], status);
    }
}
