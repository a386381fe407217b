/*
 * Runs side by side by a method that chooses its step: each has time, length and error of its own. Steps are tried
 * together, whatever follows from one (methods/adaptive.c) is its own run's. A lane whose run is over is free for
 * another one, from the next call on.
 */
#include "lane_calls.h"
#include "lane_exchange.c"

enum { TOLD = ABREAST / LANES }; /* runs that are told of at once: a call of Python's is as long as several steps */

/* Whether place i is free from now on, what happened being one of those that Python is told of. */
static int leaves(Flow *flow, int i, int happened)
{
    if (happened == RUN_OVER)
        flow->number[i] = -1;
    flow->kind[i] = happened == RUN_OVER ? -1 : flow->run[i]->control.attempt.lane;
    return happened != GOES_ON;
}

/* Run i is where its lane is. */
static void unload_lane(Flow *flow, int i)
{
#if QUIET
    if (is_taken(flow, i) && flow->quiet.here[i])
        unload_quiet_lane(&flow->quiet, &flow->x, i, flow->h[i], flow->run[i]);
#else
    (void)flow, (void)i;
#endif
}

/* Run i goes on to its next step. Returns whether Python is to be told of it. */
static int resume_run(Flow *flow, int i, int tried, int *lists)
{
    const int happened = flow->one->goes_on(flow->b, flow->number[i], tried, flow->run[i]);
    *lists |= happened == LISTS;
    return leaves(flow, i, happened);
}

/* Whether run i wants a step by this method. */
static int needs_method(const Flow *flow, int i, int method) { return flow->kind[i] == method; }

/* In how many lanes one does. */
static int lanes_of_method(const Flow *flow, int method)
{
    int some[LANES] = {0}, count = 0;
    for (int i = 0; i < ABREAST; i++)
        some[i % LANES] |= needs_method(flow, i, method);
    for (int k = 0; k < LANES; k++)
        count += some[k];
    return count;
}

/* Seats a run in lane k that wants this method, that which sat there if it does; whether there is one. */
static int load_lane(Flow *flow, int k, int method)
{
    const int last = flow->seated[k], own = last >= 0 && last % LANES == k && is_taken(flow, last);
    int best = own ? last : k;
    for (int i = k; i < ABREAST && !needs_method(flow, best, method); i += LANES)
        best = needs_method(flow, i, method) || !is_taken(flow, best) ? i : best;
    project_contacts(flow, k, best);
    return flow->seated[k] % LANES == k && needs_method(flow, flow->seated[k], method);
}

/* Whether lane k leads a fixed step over an event: its own run does not hold branches there (open_attempt). */
static int leads_over(const Flow *flow, int k)
{
    int some = 0;
#if !TAYLOR
    Lanes event_functions[AT_LEAST_ONE(N_EVENT_FUNCTIONS)];
    if (!(flow->run[flow->seated[k]]->control.fixed > 0.0))
        return 0;
    record_event_functions(&flow->x, &flow->step.rhs, event_functions);
    for (int j = 0; j < N_EVENT_FUNCTIONS; j++)
        some |= event_functions[j][k] < 0.0 || flow->step.lowest[j][k] < 0.0;
#else
    (void)flow, (void)k;
#endif
    return some;
}

/* One step of one run in each lane is tried. Returns of how many runs Python is to be told. */
static int try_together(Flow *flow, int method, int *lists)
{
    int some = 0, wanted[LANES];
    LaneBits quiet = {0};
    for (int k = 0; k < LANES; k++) {
        wanted[k] = load_lane(flow, k, method);
        gather(flow, k);
    }
    try_lanes(&flow->x, method, flow->h, &flow->p, &flow->step);
#if QUIET
    quiet = accept_quiet_steps(&flow->quiet, &flow->x, &flow->step, &flow->h);
#endif
    for (int k = 0; k < LANES; k++) {
        if (!wanted[k] || quiet[k])
            continue;
        const int lost = flow->step.lost[k] || leads_over(flow, k);
        unload_lane(flow, k);
        if (!lost)
            scatter(flow, k, method);
        some += resume_run(flow, flow->seated[k], lost ? UNTRIED : flow->step.missed[k] ? MISSED : TRIED, lists);
    }
    return some;
}

/*
 * A step of runs that go by the method which the most lanes have one for: the others wait until theirs is that one.
 * Each for itself where no two lanes have.
 */
static int advance(Flow *flow, int *lists)
{
    int some = 0, most = 0, count[KINDS];
    for (int method = 0; method < KINDS; method++) {
        count[method] = lanes_of_method(flow, method);
        most = count[method] > count[most] ? method : most;
    }
    if (count[most] > 1)
        return try_together(flow, most, lists);
    for (int i = 0; i < ABREAST; i++) {
        if (!is_taken(flow, i))
            continue;
        unload_lane(flow, i);
        some += resume_run(flow, i, UNTRIED, lists);
    }
    return some;
}

/* Begins the run of place i, or goes on with it, up to where it wants a step. */
static int enter(Flow *flow, int i)
{
    const Batch *b = flow->b;
    const long run = flow->number[i];
    if (b->phase[run] == NEW) {
        b->status[run] = flow->one->begin(b, run, flow->number, ABREAST, flow->run[i]);
        b->phase[run] = b->status[run] ? OVER : BEGUN;
    }
    return leaves(flow, i, b->phase[run] == OVER ? RUN_OVER : flow->one->goes_on(b, run, NOT_YET, flow->run[i]));
}

static int count_of(const Flow *flow)
{
    int count = 0;
    for (int i = 0; i < ABREAST; i++)
        count += is_taken(flow, i);
    return count;
}

int gudgeon_lane_count(void) { return ABREAST; }

/*
 * Runs number[i] (ABREAST of them, -1: none), each in a memory of its own. Returns GOES_ON, to be called again, as soon
 * as some runs are over (number[i] is -1 then) or after `limit` steps of each; LISTS where the lists of one are full;
 * ALL_OVER where not two are left, or the batch is ending: what is not over then goes on alone (gudgeon_ensemble).
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
        flow.seated[k] = -1;
    for (int i = 0; i < ABREAST; i++)
        if (is_taken(&flow, i))
            some += enter(&flow, i);
    for (long left = flow.b->limit; some < TOLD && !lists && left > 0 && !*flow.b->ending; left--) {
        if (count_of(&flow) < 2)
            break;
        some += advance(&flow, &lists);
    }
    const double fraction = (lane_seconds() - before) / (entered > 0 ? entered : 1);
    for (int i = 0; i < ABREAST; i++) {
        unload_lane(&flow, i);
        if (number[i] >= 0)
            flow.b->seconds[number[i]] += fraction;
        if (is_taken(&flow, i))
            flow.b->t_last[flow.number[i]] = flow.run[i]->t;
        number[i] = flow.number[i];
    }
    return lists ? LISTS : (some || count_of(&flow) > 1) && !*flow.b->ending ? GOES_ON : ALL_OVER;
}
