/*
 * The right-hand side of several runs, and the way back onto the constraints.
 */
/* Beside a singular position the single runs go on alone. */
static inline void ask_of_pivots(LaneMemory *memory)
{
    memory->least = all_of(CONTINUES ? NEARBY : NEARLY_SINGULAR);
    memory->least_size = all_of(CONTINUES ? NEARBY : VANISHING);
}

static inline int lane_dynamics(Lanes t, const Lanes *q, const Lanes *v, LaneMemory *memory, const LaneParameters *p,
    Lanes *a, LaneAside *aside)
{
    ask_of_pivots(memory);
    reduced_dynamics(t, q, v, memory, p, a, aside, &memory->rare);
    return 0;
}

#define IN_BOTH static inline
#define MOTION motion
#define REDUCED_DYNAMICS lane_dynamics
#define CLOSURES(t, q, memory, p, phi) closures(t, q, p, phi, &(memory)->rare)
#define CLOSURE_RATES(t, q, v, memory, p, phi_dot) closure_rates(t, q, v, p, phi_dot, &(memory)->rare)
#include "../both/motion.h"

static LaneBits not_finite(const Lanes *a, const Lanes *b, int n)
{
    Lanes sum = all_of(0.0);
    for (int k = 0; k < n; k++)
        sum += b ? a[k] + b[k] : a[k];
    return ~(lanes_fabs(sum) <= DBL_MAX);
}

#include "../both/states.h"

static int rates(LaneRun *run, Lanes t, const Lanes *y, const LaneParameters *p, Lanes *dy, LaneAside *aside)
{
    show_states(&run->memory, y);
    motion(t, y, &run->memory, p, dy, aside);
    rates_of_states(aside, dy);
    return 0;
}

static LaneBits can_close(LaneRun *run, LaneBits open, Lanes t, const Lanes *y, const LaneParameters *p, Lanes *dq,
    Lanes *dv, Lanes *worst)
{
    ask_of_pivots(&run->memory);
    closing_step(t, y, y + N_X, &run->memory, p, dq, dv, worst, &run->memory.rare);
    run->memory.rare |= open & (not_finite(dq, NULL, N_X) | not_finite(dv, NULL, N_X));
    return open;
}

#include "../both/project.h"
