/*
 * A step of a method that chooses its length, tried for several runs. Where in a lane a pivot vanishes or a number
 * ceases to be finite, its own run tries it again (methods/); what follows from a step is every run's own.
 */
#include "lane_motion.c"

static void forget_stages(LaneStep *step)
{
    step->n_seen = 0;
    for (int k = 0; k < 2 * N_X && N_WATCHED > 0; k++) {
        step->least[k] = all_of(INFINITY);
        step->most[k] = all_of(-INFINITY);
    }
    for (int i = 0; i < N_CLEARANCES; i++) {
        step->rate[i][0] = all_of(INFINITY);
        step->rate[i][1] = all_of(-INFINITY);
    }
}

/* From here on the step is that of the lanes which accept it. */
static int is_refused(LaneRun *run, LaneStep *step)
{
    step->lost = run->memory.rare;
    step->taken = ~(step->error > run->accept) & ~step->lost;
    run->memory.rare = (LaneBits){0};
    return !any_of(step->taken);
}

static int finish_step(LaneRun *run, LaneStep *step, const LaneParameters *p)
{
    run->memory.rare |= not_finite(step->y, NULL, N_Y);
    project_rows(run, step->t + step->h, step->y, p);
    rates(run, step->t + step->h, step->y, p, step->dy, &step->aside);
    run->memory.rare |= not_finite(step->dy, NULL, N_Y);
    return 0;
}

#if TAYLOR
#include "lane_series.c"
#else
/* Not negative while things go on as they are, as margins_of of step.c. */
static void note_margins(const LaneRun *run, const LaneAside *aside, Lanes *out)
{
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Lanes delta = aside->clearance[i].delta;
        out[i] = pick(is_closed(&run->memory.latch[i]), delta, -delta);
    }
    for (int k = 0; k < N_SWITCHES; k++)
        out[N_CLEARANCES + k] = run->memory.side[k] * aside->g[k];
    for (int k = 0; k < N_USER_EVENTS; k++)
        out[N_CLEARANCES + N_SWITCHES + k] = run->memory.event_side[k] * aside->event[k];
}

static void note_stage(const LaneRun *run, LaneStep *step, const LaneAside *aside, double node)
{
    note_margins(run, aside, step->seen[step->n_seen]);
    step->node[step->n_seen++] = node;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Lanes rate = aside->clearance[i].deltadot;
        step->rate[i][0] = lanes_min_of(step->rate[i][0], rate);
        step->rate[i][1] = lanes_max_of(step->rate[i][1], rate);
    }
}

static void note_state(LaneStep *step, const Lanes *y)
{
    for (int k = 0; k < 2 * N_X && N_WATCHED > 0; k++) {
        step->least[k] = lanes_min_of(step->least[k], y[k]);
        step->most[k] = lanes_max_of(step->most[k], y[k]);
    }
}

static int is_odd(LaneRun *run, Lanes error)
{
    run->memory.rare |= ~(lanes_fabs(error) <= DBL_MAX);
    return 0;
}

/* As make_linear of rodas5p.c. */
static int make_linear(LaneRun *run, Lanes hg, const LaneParameters *p)
{
    show_states(&run->memory, run->y);
    linearize(run->t, run->y, run->y + N_X, &run->memory, p, run->dy + N_X, &run->aside, &run->linear,
        &run->memory.rare);
    newton_factor(hg, &run->linear, &run->memory.rare);
    return 0;
}

#include "../both/dop853.h"
#include "../both/rodas5p.h"

static int method_try(LaneRun *run, int stiff, Lanes h, const LaneParameters *p, LaneStep *step)
{
    return stiff ? rodas5p_try(run, h, p, step) : dop853_try(run, h, p, step);
}
#endif

/* A step of length h of all lanes; where it is neither accepted nor lost its error alone tells. */
static void try_lanes(LaneRun *run, int stiff, Lanes h, const LaneParameters *p, LaneStep *step)
{
    run->memory.rare = (LaneBits){0};
    method_try(run, stiff, h, p, step);
    step->lost |= run->memory.rare & step->taken;
    step->taken &= ~step->lost;
}
