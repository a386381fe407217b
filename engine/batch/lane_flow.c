/*
 * Time loop of several runs in lanes by a method with step-size control. Each run has its own time, length and error.
 * Steps are tried together; all consequences of a step (methods/adaptive.c) belong to its own run. The lane of a
 * finished run takes another run at the next call.
 */
#include "lane_calls.h"
#include "lane_exchange.c"

enum { MIN_REPORTED = ABREAST / LANES }; /* runs reported at once: a call from Python is as long as several steps */

/*
 * Update place i after its run returned `happened`; it is free if the run is over. Returns whether Python must be
 * called.
 */
static int update_place(Flow *flow, int i, int happened)
{
    if (happened == RUN_OVER)
        flow->number[i] = -1;
    flow->kind[i] = happened == RUN_OVER ? -1 : flow->run[i]->control.attempt.lane;
    return happened != GOES_ON;
}

/* Copy the state of a lane back to run i. */
static void unload_lane(Flow *flow, int i)
{
#if QUIET
    if (has_run(flow, i) && flow->quiet.here[i])
        unload_quiet_lane(&flow->quiet, &flow->x, i, flow->h[i], flow->run[i]);
#else
    (void)flow, (void)i;
#endif
}

/* Advance run i to its next step; tried: what the lanes did of the last one. Returns whether Python must be called. */
static int resume_run(Flow *flow, int i, int tried, int *lists)
{
    const int happened = flow->one->advance_single(flow->b, flow->number[i], tried, flow->run[i]);
    *lists |= happened == LISTS;
    return update_place(flow, i, happened);
}

/* Return whether the next step of run i needs this method. */
static int needs_method(const Flow *flow, int i, int method) { return flow->kind[i] == method; }

/* Return the number of lanes with a run that needs this method. */
static int lanes_of_method(const Flow *flow, int method)
{
    int some[LANES] = {0}, count = 0;
    for (int i = 0; i < ABREAST; i++)
        some[i % LANES] |= needs_method(flow, i, method);
    for (int k = 0; k < LANES; k++)
        count += some[k];
    return count;
}

/* Load a run that needs this method into lane k, preferring the run that is there. Returns whether there is one. */
static int load_lane(Flow *flow, int k, int method)
{
    const int last = flow->loaded[k], is_own = last >= 0 && last % LANES == k && has_run(flow, last);
    int best = is_own ? last : k;
    for (int i = k; i < ABREAST && !needs_method(flow, best, method); i += LANES)
        best = needs_method(flow, i, method) || !has_run(flow, best) ? i : best;
    load_parameters(flow, k, best);
    return flow->loaded[k] % LANES == k && needs_method(flow, flow->loaded[k], method);
}

/* Return whether a fixed step of lane k leads over an event; its run then repeats the step with its own branches. */
static int leads_over(const Flow *flow, int k)
{
    int some = 0;
#if !TAYLOR
    Lanes event_functions[AT_LEAST_ONE(N_EVENT_FUNCTIONS)];
    if (!(flow->run[flow->loaded[k]]->control.fixed > 0.0))
        return 0;
    record_event_functions(&flow->x, &flow->step.rhs, event_functions);
    for (int j = 0; j < N_EVENT_FUNCTIONS; j++)
        some |= event_functions[j][k] < 0.0 || flow->step.lowest[j][k] < 0.0;
#else
    (void)flow, (void)k;
#endif
    return some;
}

/* Try one step of one run in each lane. Returns the number of runs that Python must be told of. */
static int try_together(Flow *flow, int method, int *lists)
{
    int some = 0, requested[LANES];
    LaneBits quiet = {0};
    for (int k = 0; k < LANES; k++) {
        requested[k] = load_lane(flow, k, method);
        gather(flow, k);
    }
    try_lanes(&flow->x, method, flow->h, &flow->p, &flow->step);
#if QUIET
    quiet = accept_quiet_steps(&flow->quiet, &flow->x, &flow->step, &flow->h);
#endif
    for (int k = 0; k < LANES; k++) {
        if (!requested[k] || quiet[k])
            continue;
        const int lost = flow->step.lost[k] || leads_over(flow, k);
        unload_lane(flow, k);
        if (!lost)
            scatter(flow, k, method);
        some += resume_run(flow, flow->loaded[k], lost ? NOT_TRIED : flow->step.missed[k] ? MISSED : TRIED, lists);
    }
    return some;
}

/*
 * Make a step of the runs that need the method most lanes have a run for; the other runs wait. If no two lanes share a
 * method, each run makes its own step. Returns the number of runs that Python must be told of.
 */
static int advance_lanes(Flow *flow, int *lists)
{
    int some = 0, most = 0, count[LANE_KINDS];
    for (int method = 0; method < LANE_KINDS; method++) {
        count[method] = lanes_of_method(flow, method);
        most = count[method] > count[most] ? method : most;
    }
    if (count[most] > 1)
        return try_together(flow, most, lists);
    for (int i = 0; i < ABREAST; i++) {
        if (!has_run(flow, i))
            continue;
        unload_lane(flow, i);
        some += resume_run(flow, i, NOT_TRIED, lists);
    }
    return some;
}

/* Begin or resume the run of place i, up to its next step. Returns whether Python must be called. */
static int enter_run(Flow *flow, int i)
{
    const Batch *b = flow->b;
    const long run = flow->number[i];
    if (b->phase[run] == NEW) {
        b->status[run] = flow->one->begin(b, run, flow->number, ABREAST, flow->run[i]);
        b->phase[run] = b->status[run] ? OVER : BEGUN;
    }
    return update_place(
        flow, i, b->phase[run] == OVER ? RUN_OVER : flow->one->advance_single(b, run, NOT_YET, flow->run[i]));
}

/* Return the number of runs under way. */
static int count_runs(const Flow *flow)
{
    int count = 0;
    for (int i = 0; i < ABREAST; i++)
        count += has_run(flow, i);
    return count;
}

/* Return the number of runs that a call of gudgeon_lanes() integrates together. */
int gudgeon_lane_count(void) { return ABREAST; }

/*
 * Integrate the runs number[i] (ABREAST of them, -1: none), each with its own Integrator run[i]. Returns GOES_ON, to be
 * called again, if runs are over (number[i] = -1) or after `limit` steps; LISTS if the lists of a run are full;
 * ALL_OVER if fewer than two runs are left or the batch is ending. Unfinished runs then continue alone
 * (gudgeon_ensemble).
 */
int gudgeon_lanes(const void *batch, const void *single, void *const *run, long *number)
{
    Flow flow;
    memset(&flow, 0, FLOW_BEGINS);
    flow.b = batch, flow.one = single;
    const double before = lane_seconds();
    int some = 0, lists = 0, entered = 0;
    for (int i = 0; i < ABREAST; i++) {
        flow.run[i] = run[i];
        flow.number[i] = number[i];
        flow.kind[i] = -1;
        entered += number[i] >= 0;
    }
    for (int k = 0; k < LANES; k++)
        flow.loaded[k] = -1;
    for (int i = 0; i < ABREAST; i++)
        if (has_run(&flow, i))
            some += enter_run(&flow, i);
    for (long left = flow.b->limit; some < MIN_REPORTED && !lists && left > 0 && !*flow.b->ending; left--) {
        if (count_runs(&flow) < 2)
            break;
        some += advance_lanes(&flow, &lists);
    }
    const double fraction = (lane_seconds() - before) / (entered > 0 ? entered : 1);
    for (int i = 0; i < ABREAST; i++) {
        unload_lane(&flow, i);
        if (number[i] >= 0)
            flow.b->seconds[number[i]] += fraction;
        if (has_run(&flow, i))
            flow.b->t_last[flow.number[i]] = flow.run[i]->t;
        number[i] = flow.number[i];
    }
    return lists ? LISTS : (some || count_runs(&flow) > 1) && !*flow.b->ending ? GOES_ON : ALL_OVER;
}
