/*
 * Kinematic runs of a batch in SIMD lanes, one run per lane, each with its own steps. Lane by lane the operations are
 * those of a single run (tree.c, kinematic.c, works.c) in the same order. A step that is not regular is made again by
 * its run alone: where Newton's method fails, a change point is near, or a velocity jumps.
 */
#include "kinematic.h"
#include "../batch/lane_calls.h"

/* Position of several runs; no lane is interpolated. */
typedef struct {
    Lanes t, q[N_Q], v[N_Q], a[N_Q], phi, phi_dot, last_correction, s[N_X + 1], s_rate[N_X + 1], s_second[N_X + 1];
} LanePosition;

/* The runs in the lanes, -1: none. Works are those of the next sample, J; t1: its time, s; h: length of the step. */
typedef struct {
    const KinematicBatch *batch;
    const KinematicRunFunctions *single;
    KinematicRun *run[LANES];
    long index[LANES];
    LaneParameters p;
    LanePosition position;
    Lanes h, t1, extent, work[N_WORK];
} RunLanes;

/* Return the larger number of each lane; NaN if `value` is NaN. */
static inline Lanes get_larger_or_nan(Lanes largest, Lanes value)
{
    return select_value((value > largest) | (value != value), value, largest);
}

/* Return the maximum norm of a change or rate of q (N_Q) as an angle, as compute_angle_norm() of a single run. */
static Lanes compute_angle_norm(const Lanes *change, Lanes extent)
{
    Lanes largest = broadcast(0.0);
    for (int k = 0; k < N_Q; k++)
        largest = get_larger_or_nan(largest, k % 3 == 2 ? lanes_fabs(change[k]) : lanes_fabs(change[k]) / extent);
    return largest;
}

/* Return the size of a change of tree coordinate k, rad or fraction of the mechanism's size. */
static inline Lanes compute_coordinate_size(Lanes change, int k, Lanes extent)
{
    return is_angle[k] ? lanes_fabs(change) : lanes_fabs(change) / extent;
}

/* Return the time at which the drives are evaluated: just after t if their rates may jump. */
static inline Lanes get_lane_time_after_jump(Lanes t)
{
    return RATE_JUMPS ? t + lanes_max_of(32.0 * DBL_EPSILON * lanes_fabs(t), broadcast(1e-100)) : t;
}

/*
 * Solve the closures at times t by Newton's method from the guess in `position`, and compute the rates there. Return
 * the lanes in which it failed. correction: incremented by the corrections, in rad or fractions of the size.
 */
static LaneBits solve_lane_equations(const LaneParameters *p, Lanes extent, Lanes t, LanePosition *position,
    Lanes *correction)
{
    LaneBits is_active = ~(LaneBits){0}, is_failed = {0};
    Lanes before = broadcast(INFINITY), step[N_X + 1], rates[N_X + 1], phi;
    position->last_correction = broadcast(0.0);
    for (int i = 0; i < MAX_NEWTON && any_of(is_active); i++) {
        LaneBits rare = {0};
        Lanes size = broadcast(0.0);
        close_step(t, position->s, p, step, rates, &phi, &rare);
        for (int k = 0; k < N_X; k++) {
            size = get_larger_or_nan(size, compute_coordinate_size(step[k], k, extent));
            position->s_rate[k] = select_value(is_active, rates[k], position->s_rate[k]);
        }
        position->phi = select_value(is_active, phi, position->phi);
        position->last_correction = select_value(is_active, size, position->last_correction);
        is_failed |= is_active & (rare | (size != size));
        is_active &= ~(is_failed | (size < NEWTON_ROUNDING) | ((size < NEWTON_CLOSED) & (size >= 0.5 * before)));
        for (int k = 0; k < N_X; k++)
            position->s[k] = select_value(is_active, position->s[k] - step[k], position->s[k]);
        *correction = select_value(is_active, *correction + size, *correction);
        before = select_value(is_active, size, before);
    }
    return is_failed | (is_active & ~(before < NEWTON_CLOSED));
}

/*
 * Solve the whole positions at times t from the near positions `start`. Return the lanes in which that failed.
 * correction: set to the corrections of the first guesses.
 */
static LaneBits solve_lane_positions(const LaneParameters *p, Lanes extent, Lanes t, const LanePosition *start,
    LanePosition *position, Lanes *correction)
{
    const Lanes h = t - start->t;
    Lanes largest = broadcast(0.0);
    LaneBits rare = {0};
    for (int k = 0; k < N_X; k++)
        largest = get_larger_or_nan(largest, compute_coordinate_size(0.5 * h * h * start->s_second[k], k, extent));
    const Lanes half_h = select_value(largest <= MAX_SECOND_RATE_MOVE, 0.5 * h, broadcast(0.0));
    *correction = broadcast(0.0);
    position->t = t;
    for (int k = 0; k < N_X; k++) {
        const Lanes by_second_rate = select_value(half_h != 0.0, half_h * start->s_second[k], broadcast(0.0));
        position->s[k] = start->s[k] + h * (start->s_rate[k] + by_second_rate);
    }
    const Lanes t_after_jump = get_lane_time_after_jump(t);
    const LaneBits is_failed = solve_lane_equations(p, extent, t_after_jump, position, correction);
    compute_body_motion(t_after_jump, position->s, position->s_rate, p, position->s_second, position->q, position->v,
        position->a, &position->phi_dot, &rare);
    return is_failed | rare;
}

/* Return the largest difference of positions b from a plus the trapezoidal rule, as in a single run, rad. */
static Lanes compute_trapezoidal_error(const LanePosition *a, const LanePosition *b, Lanes extent)
{
    const Lanes half = 0.5 * (b->t - a->t), fraction = 1.0 / extent;
    Lanes largest[2] = {broadcast(0.0), broadcast(0.0)}; /* lengths, angles */
    for (int k = 0; k < N_Q; k++)
        largest[k % 3 == 2] = get_larger_or_nan(largest[k % 3 == 2],
            lanes_fabs(b->q[k] - a->q[k] - half * (a->v[k] + b->v[k])));
    return get_larger_or_nan(largest[1], largest[0] * fraction);
}

/* Return the lanes in which the last correction of Newton's method is larger than rounding of the coordinates. */
static LaneBits find_ill_conditioned_lanes(const LanePosition *position)
{
    Lanes size = broadcast(1.0);
    for (int k = 2; k < N_Q; k += 3)
        size = get_larger_or_nan(size, lanes_fabs(position->q[k]));
    return ~(position->last_correction <= MIN_PASS_CORRECTION * DBL_EPSILON * size);
}

/*
 * Add the works between positions a and b, one step apart, to `work`, J, in the lanes of `is_accepted`. Return the
 * lanes in which that failed, a power is not finite, or velocities jump.
 */
static LaneBits integrate_lane_works(const LaneParameters *p, Lanes extent, const LanePosition *a,
    const LanePosition *b, LaneBits is_accepted, Lanes *work)
{
    const Lanes half = 0.5 * (b->t - a->t);
    const Lanes speed = get_larger_or_nan(compute_angle_norm(a->v, extent), compute_angle_norm(b->v, extent));
    Lanes velocity_defect[N_Q], interval_work[N_WORK], scale = broadcast(0.0);
    LaneBits is_irregular = {0};
    for (int k = 0; k < N_Q; k++)
        velocity_defect[k] = b->v[k] - a->v[k];
    for (int k = 0; k < N_WORK; k++)
        interval_work[k] = broadcast(0.0);
    for (int i = 0; i < N_WORK_NODES; i++) {
        LanePosition node;
        LaneDiscreteState discrete = {.least = broadcast(0.0)};
        LaneRhsOutputs rhs;
        Lanes correction, acceleration[N_X + 1];
        is_irregular |=
            solve_lane_positions(p, extent, a->t + half * (1.0 + work_node[i]), a, &node, &correction);
        reduced_dynamics(get_lane_time_after_jump(node.t), node.s, node.s_rate, &discrete, p, acceleration, &rhs,
            &discrete.rare);
        is_irregular |= discrete.rare;
        for (int k = 0; k < N_WORK; k++) {
            is_irregular |= ~(lanes_fabs(rhs.power[k]) <= DBL_MAX);
            interval_work[k] += half * work_weight[i] * rhs.power[k];
        }
        for (int k = 0; k < N_Q; k++)
            velocity_defect[k] -= half * work_weight[i] * node.a[k];
        scale = get_larger_or_nan(scale, half * compute_angle_norm(node.a, extent));
    }
    const Lanes jump = compute_angle_norm(velocity_defect, extent);
    const Lanes min_jump = MIN_VELOCITY_JUMP + VELOCITY_ROUNDING * speed;
    is_irregular |= ~(scale <= DBL_MAX) | ((jump > min_jump) & (jump > MIN_JUMP_RATIO * scale));
    is_irregular |= ~(lanes_fabs(interval_work[0]) <= DBL_MAX);
    for (int k = 0; k < N_WORK; k++)
        work[k] = select_value(is_accepted & ~is_irregular, work[k] + interval_work[k], work[k]);
    return is_irregular;
}

/* Copy to lane k the time and works of the next sample of its run, and the length of the step. */
static void load_next_sample(RunLanes *lanes, int k)
{
    const RunSamples *samples = &lanes->run[k]->samples;
    const double *work = samples->y + samples->done * N_S + 2 * N_Q;
    lanes->h[k] = samples->stride.h;
    lanes->t1[k] = samples->t[samples->done];
    for (int j = 0; j < N_WORK; j++)
        lanes->work[j][k] = work[j];
}

/* Copy the position of run k to its lane, and what its next sample needs. */
static void load_lane(RunLanes *lanes, int k)
{
    const Position *from = &lanes->run[k]->motion;
    LanePosition *to = &lanes->position;
    for (int j = 0; j < N_Q; j++) {
        to->q[j][k] = from->q[j];
        to->v[j][k] = from->v[j];
    }
    for (int j = 0; j < N_X; j++) {
        to->s[j][k] = from->s[j];
        to->s_rate[j][k] = from->s_rate[j];
        to->s_second[j][k] = from->s_second[j];
    }
    to->t[k] = from->t;
    load_next_sample(lanes, k);
}

/* Copy from lane k to its run what a sample has: the motion of all bodies, its time, and the works. */
static void store_lane_sample(const RunLanes *lanes, int k)
{
    KinematicRun *run = lanes->run[k];
    Position *to = &run->motion;
    const LanePosition *from = &lanes->position;
    double *work = run->samples.y + run->samples.done * N_S + 2 * N_Q;
    to->t = from->t[k];
    to->interpolated = 0;
    to->phi = from->phi[k];
    to->phi_dot = from->phi_dot[k];
    for (int j = 0; j < N_Q; j++) {
        to->q[j] = from->q[j][k];
        to->v[j] = from->v[j][k];
        to->a[j] = from->a[j][k];
    }
    for (int j = 0; j < N_WORK; j++)
        work[j] = lanes->work[j][k];
}

/* Copy the whole position of lane k to its run, which goes on alone. */
static void store_lane(const RunLanes *lanes, int k)
{
    Position *to = &lanes->run[k]->motion;
    const LanePosition *from = &lanes->position;
    store_lane_sample(lanes, k);
    to->last_correction = from->last_correction[k];
    for (int j = 0; j < N_X; j++) {
        to->s[j] = from->s[j][k];
        to->s_rate[j] = from->s_rate[j][k];
        to->s_second[j] = from->s_second[j][k];
    }
    lanes->run[k]->samples.stride.h = lanes->h[k];
}

/* End the run in lane k with this status, and let the lane be free. */
static void end_lane(RunLanes *lanes, int k, int status)
{
    lanes->single->end(lanes->batch, lanes->index[k], lanes->run[k], status);
    lanes->index[k] = -1;
}

/* Return whether the run in lane k has stored all its samples. */
static int is_complete(const RunLanes *lanes, int k)
{
    return lanes->run[k]->samples.done == lanes->run[k]->samples.n;
}

/* Let the next of n runs that begin take lane k: `next` counts them. A run that fails at once is ended. */
static void fill_lane(RunLanes *lanes, int k, long n, const long *indices, long *next)
{
    const KinematicBatch *batch = lanes->batch;
    while (lanes->index[k] < 0 && *next < n && !*batch->ending) {
        const long i = indices[(*next)++];
        if (batch->phase[i] != NEW)
            continue;
        lanes->index[k] = i;
        for (long j = 0; j < batch->numbers; j++)
            ((Lanes *)&lanes->p)[j][k] = batch->p[i * batch->numbers + j];
        lanes->extent[k] = batch->size[i];
        const int status = lanes->single->begin(batch, i, lanes->run[k]);
        if (status || is_complete(lanes, k))
            end_lane(lanes, k, status);
        else
            load_lane(lanes, k);
    }
}

/*
 * Complete the step of lane k, of which `outcome` is what the lanes found: ACCEPTED, REJECTED (it is halved), or
 * IRREGULAR (the run makes it). is_harmless: its error is so small that a halved length may grow again.
 */
enum Outcome { ACCEPTED, REJECTED, IRREGULAR };
static void complete_lane_step(RunLanes *lanes, int k, enum Outcome outcome, int is_harmless)
{
    KinematicRun *run = lanes->run[k];
    StepLength *stride = &run->samples.stride;
    if (outcome == REJECTED && stride->halvings < MAX_HALVINGS) {
        stride->halvings++;
        lanes->h[k] *= 0.5;
        return;
    }
    if (outcome == ACCEPTED && stride->halvings > 0 && is_harmless) {
        lanes->h[k] *= 2.0;
        stride->halvings--;
    }
    if (outcome == ACCEPTED && lanes->position.t[k] < lanes->t1[k])
        run->motion.t = lanes->position.t[k];
    else if (outcome == ACCEPTED)
        store_lane_sample(lanes, k);
    else
        store_lane(lanes, k);
    const long n_done = run->samples.done;
    const int status = outcome == ACCEPTED ? lanes->single->accept(run)
        : lanes->single->advance(run);
    if (status || is_complete(lanes, k))
        end_lane(lanes, k, status);
    else if (outcome != ACCEPTED)
        load_lane(lanes, k);
    else if (run->samples.done > n_done)
        load_next_sample(lanes, k);
}

/* Try one step in all lanes, and complete it for each run. */
static void advance_lanes(RunLanes *lanes)
{
    const KinematicBatch *batch = lanes->batch;
    const double max_correction = batch->max_correction, max_error = MAX_STEP_ERROR * max_correction;
    const LanePosition *const position = &lanes->position;
    LanePosition next_position;
    Lanes correction;
    const Lanes sum = position->t + lanes->h, next = select_value(sum < lanes->t1, sum, lanes->t1);
    LaneBits is_irregular = ~(next > position->t)
        | solve_lane_positions(&lanes->p, lanes->extent, next, position, &next_position, &correction);
    is_irregular |= (next == lanes->t1) & find_ill_conditioned_lanes(&next_position);
    const Lanes error = compute_trapezoidal_error(position, &next_position, lanes->extent);
    LaneBits is_accepted = ~is_irregular & (correction <= max_correction) & (error <= max_error);
    for (int k = 0; N_PULSES && k < LANES; k++)
        if (lanes->index[k] >= 0 && is_accepted[k] && lanes->run[k]->samples.stride.halvings <= PULSE_HALVINGS
            && lanes->single->has_transient(position->t[k], next[k], lanes->run[k]->p))
            is_accepted[k] = 0;
    if (any_of(is_accepted))
        is_irregular |= is_accepted
            & integrate_lane_works(&lanes->p, lanes->extent, position, &next_position, is_accepted, lanes->work);
    is_accepted &= ~is_irregular;
    if (any_of(~is_accepted)) {
        for (long j = 0; j < (long)(sizeof next_position / sizeof(Lanes)); j++)
            ((Lanes *)&lanes->position)[j] =
                select_value(is_accepted, ((Lanes *)&next_position)[j], ((Lanes *)&lanes->position)[j]);
    } else {
        lanes->position = next_position;
    }
    for (int k = 0; k < LANES; k++)
        if (lanes->index[k] >= 0)
            complete_lane_step(lanes, k, is_irregular[k] ? IRREGULAR : is_accepted[k] ? ACCEPTED : REJECTED,
                error[k] < HARMLESS_STEP_ERROR * max_error);
}

/* Return the number of lanes with a run. */
static int count_runs(const RunLanes *lanes)
{
    int count = 0;
    for (int k = 0; k < LANES; k++)
        count += lanes->index[k] >= 0;
    return count;
}

/* Return the number of runs that gudgeon_kinematic_lanes() computes together. */
int gudgeon_lane_count(void) { return LANES; }

/*
 * Compute n runs of a batch, whose indices are given, in lanes, each in one of the memories run[LANES]. single: the
 * functions that gudgeon_single_run_functions() returns. The last run in the lanes is completed alone. If the batch is
 * ending, runs under way end at once, and no run begins.
 */
void gudgeon_kinematic_lanes(const void *batch, const void *single, void *const *run, long n, const long *indices)
{
    RunLanes lanes;
    memset(&lanes, 0, sizeof lanes);
    lanes.batch = batch, lanes.single = single;
    lanes.extent = broadcast(1.0);
    long next = 0;
    for (int k = 0; k < LANES; k++) {
        lanes.run[k] = run[k];
        lanes.index[k] = -1;
    }
    do {
        for (int k = 0; k < LANES; k++)
            fill_lane(&lanes, k, n, indices, &next);
        if (count_runs(&lanes) > 1 && !*lanes.batch->ending)
            advance_lanes(&lanes);
    } while ((count_runs(&lanes) > 1 || next < n) && !*lanes.batch->ending);
    for (int k = 0; k < LANES; k++) {
        int status = 0;
        if (lanes.index[k] < 0)
            continue;
        store_lane(&lanes, k);
        while (!status && lanes.run[k]->samples.done < lanes.run[k]->samples.n)
            status = lanes.single->advance(lanes.run[k]);
        lanes.single->end(lanes.batch, lanes.index[k], lanes.run[k], status);
    }
}
