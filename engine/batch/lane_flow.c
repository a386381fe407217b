/*
 * Time loop of several runs in SIMD lanes, one run per lane, by a method with step-size control. Each run has its own
 * time, length and error. Steps are tried together; all consequences of a step (methods/adaptive.c) belong to its own
 * run. The lane of a finished run takes another run at the next call.
 */
#include "lane_calls.h"
#include "lane_exchange.c"

/*
 * Number of runs that must wait for Python before it is called. A call costs as much as tens of steps, because Python's
 * code is not in the caches of the processor. Where several runs share a lane, the other runs of the lane continue.
 */
enum { MIN_REPORTED = LANE_SERIES ? 1 : MAX_GROUP_RUNS / 4 };

/*
 * Store the method that the group's run i needs next, after a call for that run returned `result`. After RUN_ENDED its
 * entry becomes free. Return whether Python must be called: unless `result` is CALL_AGAIN.
 */
static int record_run_result(LaneGroup *group, int i, int result)
{
    if (result == RUN_ENDED)
        group->run_number[i] = -1;
    group->next_method[i] = result == RUN_ENDED ? -1 : group->run[i]->control.attempt.lane_method;
    return result != CALL_AGAIN;
}

/*
 * Copy the steps that the lane of run i of the group accepted itself to that run, before it is used. Nothing happens if
 * the lane contains another run or no state.
 */
static void flush_lane(LaneGroup *group, int i)
{
#if LANE_LOCAL_STEPS
    const int k = i % LANES;
    if (group->loaded_run[k] == i && group->local_steps.has_state[k])
        flush_lane_local_steps(&group->local_steps, &group->integrator, k, group->h[k], group->run[i]);
#else
    (void)group, (void)i;
#endif
}

/*
 * Advance run i of the group to its next attempt at a step, by completing the last one, or trying it first.
 * trial_result: what the lanes did of that step (NOT_TRIED, TRIED, STAGES_FAILED). *buffers_full is set if the run's
 * lists of contacts or events are full. Return whether Python must be called.
 */
static int advance_run_to_next_step(LaneGroup *group, int i, int trial_result, int *buffers_full)
{
    const int result =
        group->scalar_functions->advance_single(group->batch, group->run_number[i], trial_result, group->run[i]);
    *buffers_full |= result == BUFFERS_FULL;
    return record_run_result(group, i, result);
}

/* Return whether the next step of run i of the group is by this method (METHOD_DOP853, ...). */
static int needs_method(const LaneGroup *group, int i, int method) { return group->next_method[i] == method; }

/*
 * Count, for each method, the lanes that have a run whose next step is by that method (count, N_LANE_METHODS of them).
 * Run i belongs to lane i % LANES; a lane with several such runs counts once. The lanes of the method taylor are in one
 * library (LANE_SERIES), those of all other methods in another one. Methods of the other library count 0: the functions
 * for single runs make their steps.
 */
static void count_lanes_of_methods(const LaneGroup *group, int *count)
{
    unsigned char has_lane[N_LANE_METHODS + 1][LANES] = {0}; /* the row after the last: runs without a next step */
    for (int i = 0; i < MAX_GROUP_RUNS; i++)
        has_lane[group->next_method[i] < 0 ? N_LANE_METHODS : group->next_method[i]][i % LANES] = 1;
    for (int method = 0; method < N_LANE_METHODS; method++) {
        count[method] = 0;
        for (int k = 0; k < LANES && (method == METHOD_TAYLOR) == LANE_SERIES; k++)
            count[method] += has_lane[method][k];
    }
}

/*
 * Load a run whose next step is by `method` into lane k, preferably the run that the lane holds. Candidates are the
 * runs k, k + LANES, and so on. If none of these needs the method, any run is repeated in the lane. Return whether the
 * lane has a run that needs the step.
 */
static int load_run_into_lane(LaneGroup *group, int k, int method)
{
    const int last = group->loaded_run[k], is_of_lane = last >= 0 && last % LANES == k && has_run(group, last);
    int best = is_of_lane ? last : k;
    for (int i = k; i < MAX_GROUP_RUNS && !needs_method(group, best, method); i += LANES)
        best = needs_method(group, i, method) || !has_run(group, best) ? i : best;
    if (last >= 0 && (last != best || !needs_method(group, best, method)))
        flush_lane(group, last);
    load_lane_parameters(group, k, best);
    return group->loaded_run[k] % LANES == k && needs_method(group, group->loaded_run[k], method);
}

/*
 * Return whether a step of fixed length in lane k contains an event: an event function is negative at its end or at a
 * stage. Its run then repeats the step and locates the event. Always 0 for steps of variable length and series.
 */
static int has_event_in_fixed_step(const LaneGroup *group, int k)
{
    int has_event = 0;
#if !LANE_SERIES
    Lanes event_functions[AT_LEAST_ONE(N_EVENT_FUNCTIONS)];
    if (!(group->run[group->loaded_run[k]]->control.fixed > 0.0))
        return 0;
    evaluate_lane_event_functions(&group->integrator, &group->step.rhs, event_functions);
    for (int j = 0; j < N_EVENT_FUNCTIONS; j++)
        has_event |= event_functions[j][k] < 0.0 || group->step.min_event_value[j][k] < 0.0;
#else
    (void)group, (void)k;
#endif
    return has_event;
}

/*
 * Try one step by `method` of one run in each lane, and advance those runs to their next steps. Lanes without such a
 * run are computed, but ignored. Steps without events or other actions of the scalar code are accepted in the lane. A
 * step that fails in a lane or contains an event is made by the scalar code, in advance_run_to_next_step(). Return the
 * number of runs that Python must be called for. *buffers_full is set to 1 if a run has no room for further contacts,
 * events or recorded steps: Python must fetch them first.
 */
static int try_lane_steps(LaneGroup *group, int method, int *buffers_full)
{
    int n_reported = 0, requested[LANES];
    LaneBits local_steps = {0}, is_requested = {0};
    for (int k = 0; k < LANES; k++) {
        requested[k] = load_run_into_lane(group, k, method);
        is_requested[k] = -requested[k];
        gather_state(group, k, requested[k]);
    }
    try_step_in_lanes(&group->integrator, method, group->h, &group->p, &group->step);
#if LANE_LOCAL_STEPS
    local_steps = accept_lane_local_steps(
        &group->local_steps, &group->integrator, method, is_requested, &group->step, &group->p, &group->h);
#else
    (void)is_requested;
#endif
    for (int k = 0; k < LANES; k++) {
        if (!requested[k] || local_steps[k])
            continue;
        const int needs_single_run = group->step.is_failed[k] || has_event_in_fixed_step(group, k);
        flush_lane(group, group->loaded_run[k]);
        if (!needs_single_run)
            scatter_result(group, k, method);
        const int trial = needs_single_run ? NOT_TRIED : group->step.has_no_stages[k] ? STAGES_FAILED : TRIED;
        n_reported += advance_run_to_next_step(group, group->loaded_run[k], trial, buffers_full);
    }
    return n_reported;
}

/*
 * Advance the runs that need the most frequent method, counted by lanes, by one step; the other runs wait. If no two
 * lanes share a method, each run makes its own step outside the lanes. Return the number of runs that Python must be
 * called for. *buffers_full is set if the lists of one are full.
 */
static int advance_lane_group(LaneGroup *group, int *buffers_full)
{
    int n_reported = 0, best_method = 0, count[N_LANE_METHODS];
    count_lanes_of_methods(group, count);
    for (int method = 0; method < N_LANE_METHODS; method++)
        best_method = count[method] > count[best_method] ? method : best_method;
    if (count[best_method] > 1)
        return try_lane_steps(group, best_method, buffers_full);
    for (int i = 0; i < MAX_GROUP_RUNS; i++) {
        if (!has_run(group, i))
            continue;
        flush_lane(group, i);
        n_reported += advance_run_to_next_step(group, i, NOT_TRIED, buffers_full);
    }
    return n_reported;
}

/*
 * Begin run i of the group if it is new, or resume it, up to its first attempt at a step. A failed start is stored in
 * the batch's status. Return whether Python must be called.
 */
static int begin_or_resume_run(LaneGroup *group, int i)
{
    const Batch *batch = group->batch;
    const long run = group->run_number[i];
    if (batch->phase[run] == NEW) {
        batch->status[run] =
            group->scalar_functions->begin(batch, run, group->run_number, MAX_GROUP_RUNS, group->run[i]);
        batch->phase[run] = batch->status[run] ? OVER : BEGUN;
    }
    if (batch->phase[run] == OVER)
        return record_run_result(group, i, RUN_ENDED);
    return record_run_result(group, i, group->scalar_functions->advance_single(batch, run, NO_TRIAL, group->run[i]));
}

/* Return the number of runs in a group. */
static int count_group_runs(const LaneGroup *group)
{
    int count = 0;
    for (int i = 0; i < MAX_GROUP_RUNS; i++)
        count += has_run(group, i);
    return count;
}

/* Return MAX_GROUP_RUNS, the number of runs that a call of gudgeon_lanes() integrates together. */
int gudgeon_lane_count(void) { return MAX_GROUP_RUNS; }

/*
 * Integrate the runs run_number[i] (MAX_GROUP_RUNS of them, -1: none) of a batch together in lanes, each in its own
 * Integrator run[i]. scalar_functions: those that gudgeon_single_run_functions() returns. The wall time is shared
 * equally by the runs. Return one of
 *   CALL_AGAIN: runs are over (run_number[i] = -1), or `limit` steps are made;
 *   BUFFERS_FULL: fetch contacts, events and recorded steps of the runs, then call again;
 *   BATCH_ENDED: fewer than two runs are left, or the batch is ending; unfinished runs continue alone
 *       (gudgeon_ensemble()).
 */
int gudgeon_lanes(const void *batch, const void *scalar_functions, void *const *run, long *run_number)
{
    LaneGroup group;
    memset(&group, 0, CLEARED_BYTES);
    group.batch = batch, group.scalar_functions = scalar_functions;
    const double before = read_wall_time();
    int n_reported = 0, buffers_full = 0, entered = 0;
    for (int i = 0; i < MAX_GROUP_RUNS; i++) {
        group.run[i] = run[i];
        group.run_number[i] = run_number[i];
        group.next_method[i] = -1;
        entered += run_number[i] >= 0;
    }
    for (int k = 0; k < LANES; k++)
        group.loaded_run[k] = -1;
    for (int i = 0; i < MAX_GROUP_RUNS; i++)
        if (has_run(&group, i))
            n_reported += begin_or_resume_run(&group, i);
    for (long steps_left = group.batch->limit; n_reported < MIN_REPORTED && !buffers_full && steps_left > 0
        && !*group.batch->ending; steps_left--) {
        if (count_group_runs(&group) < 2)
            break;
        n_reported += advance_lane_group(&group, &buffers_full);
    }
    const double fraction = (read_wall_time() - before) / (entered > 0 ? entered : 1);
    for (int i = 0; i < MAX_GROUP_RUNS; i++) {
        flush_lane(&group, i);
        if (run_number[i] >= 0)
            group.batch->seconds[run_number[i]] += fraction;
        if (has_run(&group, i))
            group.batch->t_last[group.run_number[i]] = group.run[i]->t;
        run_number[i] = group.run_number[i];
    }
    const int continues = (n_reported || count_group_runs(&group) > 1) && !*group.batch->ending;
    return buffers_full ? BUFFERS_FULL : continues ? CALL_AGAIN : BATCH_ENDED;
}
