/*
 * Runs side by side by a method that chooses its step: each has time, length and error of its own. Steps are tried
 * together, whatever follows from one (methods/adaptive.c) is its own run's. A lane whose run is over is free for
 * another one, from the next call on.
 */
#include "lane_calls.h"
#include "lane_exchange.c"

/* Whether lane k is free from now on, what happened being one of those that Python is told of. */
static int leaves(Flow *flow, int k, int happened)
{
    if (happened == RUN_OVER)
        flow->number[k] = -1;
    return happened != GOES_ON;
}

/* Run k is where its lane is. */
static void put_down(Flow *flow, int k)
{
#if QUIET
    if (is_taken(flow, k) && flow->quiet.here[k])
        tell(&flow->quiet, &flow->x, k, flow->h[k], flow->run[k]);
#else
    (void)flow, (void)k;
#endif
}

/* One step of these lanes is tried. Returns whether Python is to be told of a run. */
static int try_together(Flow *flow, int stiff, const int *wanted, int *lists)
{
    int some = 0;
    LaneBits quiet = {0};
    for (int k = 0; k < LANES; k++)
        gather(flow, k);
    try_lanes(&flow->x, stiff, flow->h, &flow->p, &flow->step);
#if QUIET
    quiet = take_quietly(&flow->quiet, &flow->x, &flow->step, &flow->h);
#endif
    for (int k = 0; k < LANES; k++) {
        if (!wanted[k] || quiet[k])
            continue;
        const int lost = flow->step.lost[k] != 0;
        put_down(flow, k);
        if (!lost)
            scatter(flow, k, stiff);
        const int tried = lost ? UNTRIED : flow->step.missed[k] ? MISSED : TRIED;
        const int happened = flow->one->goes_on(flow->b, flow->number[k], tried, flow->run[k]);
        *lists |= happened == LISTS;
        some |= leaves(flow, k, happened);
    }
    return some;
}

/* One step of each run, of several at once where they go by the same method. */
static int advance(Flow *flow, int *lists)
{
    int some = 0, wanted[KINDS][LANES], count[KINDS] = {0};
    for (int k = 0; k < LANES; k++)
        for (int stiff = 0; stiff < KINDS; stiff++) {
            wanted[stiff][k] = is_taken(flow, k) && flow->run[k]->attempt.stiff == stiff;
            count[stiff] += wanted[stiff][k];
        }
    for (int stiff = 0; stiff < KINDS; stiff++) {
        if (count[stiff] > 1) {
            some |= try_together(flow, stiff, wanted[stiff], lists);
            continue;
        }
        for (int k = 0; k < LANES; k++) {
            if (!wanted[stiff][k])
                continue;
            put_down(flow, k);
            const int happened = flow->one->goes_on(flow->b, flow->number[k], UNTRIED, flow->run[k]);
            *lists |= happened == LISTS;
            some |= leaves(flow, k, happened);
        }
    }
    return some;
}

/* Begins run k, or goes on with it, up to where it wants a step. */
static int enter(Flow *flow, int k)
{
    const Batch *b = flow->b;
    const long i = flow->number[k];
    if (b->phase[i] == NEW) {
        b->status[i] = flow->one->begin(b, i, flow->run[k]);
        b->phase[i] = b->status[i] ? OVER : BEGUN;
    }
    return leaves(flow, k, b->phase[i] == OVER ? RUN_OVER : flow->one->goes_on(b, i, NOT_YET, flow->run[k]));
}

static int count_of(const Flow *flow)
{
    int count = 0;
    for (int k = 0; k < LANES; k++)
        count += is_taken(flow, k);
    return count;
}

int gudgeon_lane_count(void) { return LANES; }

/*
 * Runs number[k] (LANES of them, -1: none), each in a memory of its own. Returns GOES_ON, to be called again, as soon
 * as a run is over (number[k] is -1 then) or after `limit` steps of each; LISTS where the lists of one are full;
 * ALL_OVER where not two are left, or the batch is ending: what is not over then goes on alone (gudgeon_many).
 */
int gudgeon_lanes(const void *batch, const void *single, void *const *run, long *number)
{
    Flow flow;
    memset(&flow, 0, FLOW_BEGINS);
    flow.b = batch, flow.one = single;
    const double before = lane_seconds();
    int some = 0, lists = 0, entered = 0;
    for (int k = 0; k < LANES; k++) {
        flow.run[k] = run[k];
        flow.number[k] = number[k];
        entered += number[k] >= 0;
    }
    for (int k = 0; k < LANES; k++)
        if (is_taken(&flow, k))
            some |= enter(&flow, k);
    if (!some && count_of(&flow) > 1)
        gather_parameters(&flow);
    for (long left = flow.b->limit; !some && count_of(&flow) > 1 && left > 0 && !*flow.b->ending; left--)
        some = advance(&flow, &lists);
    const double share = (lane_seconds() - before) / (entered > 0 ? entered : 1);
    for (int k = 0; k < LANES; k++) {
        put_down(&flow, k);
        if (number[k] >= 0)
            flow.b->seconds[number[k]] += share;
        if (is_taken(&flow, k))
            flow.b->t_last[flow.number[k]] = flow.run[k]->t;
        number[k] = flow.number[k];
    }
    return lists ? LISTS : (some || count_of(&flow) > 1) && !*flow.b->ending ? GOES_ON : ALL_OVER;
}
