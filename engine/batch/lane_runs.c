/*
 * Runs side by side: run[k] is the memory of number[k], which is -1 once that run has left. The lane of one that has
 * left mirrors another: what fills it must not be rare.
 */
#include "lane_calls.h"

typedef struct {
    const Batch *b;
    const Single *one;
    void *const *run;
    long number[LANES];
    LaneRun x;
    LaneParameters p;
    long made, rare; /* steps of all lanes, those of single runs among them */
} Side;

static void copy_lane(Lanes *x, size_t n, int to, int from)
{
    for (size_t j = 0; j < n; j++)
        x[j][to] = x[j][from];
}

static int first_of(const Side *side)
{
    int k = 0;
    while (k < LANES && side->number[k] < 0)
        k++;
    return k;
}

static int count_of(const Side *side)
{
    int count = 0;
    for (int k = 0; k < LANES; k++)
        count += side->number[k] >= 0;
    return count;
}

static void mirror(Side *side)
{
    const int from = first_of(side);
    for (int k = 0; k < LANES && from < LANES; k++) {
        if (side->number[k] >= 0)
            continue;
        copy_lane((Lanes *)&side->x, sizeof(LaneRun) / sizeof(Lanes), k, from);
        copy_lane((Lanes *)&side->p, sizeof(LaneParameters) / sizeof(Lanes), k, from);
    }
}

static void gather(Side *side, int k)
{
    Moving state;
    side->one->give(side->run[k], &state);
    for (size_t j = 0; j < sizeof state / sizeof(double); j++)
        ((LaneBits *)&side->x)[j][k] = ((const long long *)&state)[j];
    for (int i = 0; i < N_CLEARANCES; i++) {
        LaneClearance *joint = &side->x.aside.clearance[i];
        joint->e[k] = state.journal[i].e;
        joint->delta[k] = state.journal[i].delta;
        joint->deltadot[k] = state.journal[i].deltadot;
    }
}

static Moving state_of(const LaneRun *x, int k)
{
    Moving state;
    for (size_t j = 0; j < sizeof state / sizeof(double); j++)
        ((long long *)&state)[j] = ((const LaneBits *)x)[j][k];
    for (int i = 0; i < N_CLEARANCES; i++) {
        const LaneClearance *joint = &x->aside.clearance[i];
        state.journal[i].e = joint->e[k];
        state.journal[i].delta = joint->delta[k];
        state.journal[i].deltadot = joint->deltadot[k];
    }
    return state;
}

static void scatter(const Side *side, const LaneRun *x, int k)
{
    const Moving state = state_of(x, k);
    side->one->take(side->run[k], &state);
}

static const double *parameters_of(const Side *side, int k)
{
    return side->b->p_motion + side->number[k] * side->b->numbers;
}

/* Begins run k, unless it goes on, and makes its first sample; what cannot begin leaves. */
static void enter(Side *side, int k)
{
    const Batch *b = side->b;
    const long i = side->number[k];
    if (b->phase[i] == NEW) {
        b->status[i] = side->one->begin(b, i, side->number, LANES, side->run[k]);
        b->phase[i] = b->status[i] ? OVER : BEGUN;
        const int status = b->status[i] ? 0 : side->one->steps(b, i, 0, side->run[k]);
        if (status)
            side->one->end(b, i, status, side->run[k]);
        if (b->phase[i] == OVER) {
            side->number[k] = -1;
            return;
        }
    }
    for (long j = 0; j < b->numbers; j++)
        ((Lanes *)&side->p)[j][k] = parameters_of(side, k)[j];
    gather(side, k);
}

/*
 * The step of the rare lanes, which began at x, by their runs themselves. One whose lists are full leaves before it,
 * one that it ends leaves after it.
 */
static void single_steps(Side *side, LaneBits rare, const LaneRun *x)
{
    const Batch *b = side->b;
    for (int k = 0; k < LANES; k++) {
        const long i = side->number[k];
        if (i < 0 || !rare[k])
            continue;
        scatter(side, x, k);
        side->rare++;
        const int status = side->one->steps(b, i, 1, side->run[k]);
        if (!status) {
            gather(side, k);
            continue;
        }
        if (status != EVENTS_FULL)
            side->one->end(b, i, status, side->run[k]);
        side->number[k] = -1;
    }
    mirror(side);
}

/*
 * Lanes that make this step by themselves: in parts, where a drive's rate jumps on the way to t_new; the last one of
 * the run, beyond which events are looked for.
 */
static LaneBits alone(const Side *side, double h, double t_new)
{
    const Batch *b = side->b;
    const int last = N_USER_EVENTS > 0 && t_new >= t_end_of(b, side->number[first_of(side)]);
    LaneBits some = {0};
    for (int k = 0; k < LANES && (N_CORNERS > 0 || last); k++) {
        const double t = side->x.t[k];
        if (side->number[k] >= 0 && (last || side->one->jumps(b, side->number[k], t, max_of(t_new, t + h))))
            some[k] = -1;
    }
    return some;
}

/* One step of all lanes, with its samples. */
static void advance(Side *side)
{
    const Batch *b = side->b;
    const int first = first_of(side);
    const long i = side->number[first];
    double h;
    const double t_new = step_end(times_of(b, i)[0], t_end_of(b, i), b->step[i], side->x.counts.steps[first] + 1.0, &h);
    const int sampled = times_of(b, i)[b->done[i]] < t_new + h;
    LaneRun before;
    const LaneBits parted = alone(side, h, t_new);
    const LaneBits rare = parted | lane_step(&side->x, h, t_new, &side->p, sampled || any_of(parted), &before);
    side->made += LANES;
    for (int k = 0; sampled && k < LANES; k++) {
        if (side->number[k] < 0 || rare[k])
            continue;
        const Moving from = state_of(&before, k);
        scatter(side, &side->x, k);
        side->one->samples(b, side->number[k], &from, side->run[k]);
    }
    if (any_of(rare))
        single_steps(side, rare, &before);
}

int gudgeon_lane_count(void) { return LANES; }

/*
 * Runs number[k] (LANES of them, -1: none), which have the same step and times and have come equally far, each in a
 * memory of its own. Returns GOES_ON after `limit` steps, to be called again, or ALL_OVER: what is not over then goes
 * on alone from where it is (gudgeon_many), because it has come to its end, is the last, most steps are rare, or the
 * batch is ending.
 */
int gudgeon_lanes(const void *batch, const void *single, void *const *run, long *number)
{
    Side side = {.b = batch, .one = single, .run = run};
    const double before = lane_seconds();
    long left = side.b->limit;
    int entered = 0, together = 1;
    for (int k = 0; k < LANES; k++) {
        side.number[k] = number[k];
        entered += number[k] >= 0;
    }
    for (int k = 0; k < LANES; k++)
        if (number[k] >= 0)
            enter(&side, k);
    mirror(&side);
    while ((together = count_of(&side) > 1 && 2 * side.rare <= side.made + 64 * LANES) && left > 0) {
        const long i = side.number[first_of(&side)];
        if (side.b->done[i] == side.b->wanted[i] || *side.b->ending) {
            together = 0;
            break;
        }
        advance(&side);
        left--;
    }
    for (int k = 0; k < LANES; k++) {
        if (side.number[k] < 0)
            continue;
        scatter(&side, &side.x, k);
        side.b->t_last[side.number[k]] = side.x.t[k];
    }
    const double share = (lane_seconds() - before) / entered;
    for (int k = 0; k < LANES; k++) {
        if (number[k] >= 0)
            side.b->seconds[number[k]] += share;
        number[k] = side.number[k];
    }
    return together ? GOES_ON : ALL_OVER;
}
