/*
 * A step of a method that chooses its length, tried for several runs. Where in a lane a pivot vanishes or a number
 * ceases to be finite, its own run tries it again (methods/); what follows from a step is every run's own.
 */
#include "lane_motion.c"
#include "../both/distance.h"

static void forget_stages(LaneStep *step)
{
    step->n_seen = 0;
    for (int k = 0; k < N_MARGINS; k++)
        step->lowest[k] = all_of(INFINITY);
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
#if IMPLICIT_STAGES && !TAYLOR
    step->missed = run->newton.missed;
#else
    step->missed = (LaneBits){0};
#endif
    step->lost = run->memory.rare & ~step->missed;
    step->taken = ~(step->error > run->control.accept) & ~step->lost & ~step->missed;
    run->memory.rare = (LaneBits){0};
    return !any_of(step->taken);
}

static int finish_step(LaneRun *run, LaneStep *step, const LaneParameters *p)
{
    Lanes before[N_Y];
    run->memory.rare |= not_finite(step->y, NULL, N_Y);
    memcpy(before, step->y, sizeof before);
    project_rows(run, step->t + step->h, step->y, p);
    run->memory.rare |= distance_from_rows(run, before, step->y) > FAR_FROM_ROWS;
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

static Lanes square_of_force(const LaneAside *aside, int i)
{
    return aside->clearance[i].F_n * aside->clearance[i].F_n + aside->clearance[i].F_t * aside->clearance[i].F_t;
}

static void note_stage(const LaneRun *run, LaneStep *step, const LaneAside *aside, double node)
{
    Lanes *const seen = step->seen[step->n_seen];
    note_margins(run, aside, seen);
    for (int k = 0; k < N_MARGINS; k++)
        step->lowest[k] = lanes_min_of(step->lowest[k], seen[k]);
    step->node[step->n_seen++] = node;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Lanes rate = aside->clearance[i].deltadot;
        step->rate[i][0] = lanes_min_of(step->rate[i][0], rate);
        step->rate[i][1] = lanes_max_of(step->rate[i][1], rate);
        seen[SEEN_FORCES + i] = square_of_force(aside, i);
        seen[SEEN_RATES + i] = rate;
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
    linearize(run->t, run->y, run->y + N_X, &run->memory, p, run->dy + N_X, &run->aside, &run->newton.linear,
        &run->memory.rare);
    newton_factor(hg, &run->newton.linear, &run->memory.rare);
    return 0;
}

#include "../both/dop853.h"
#include "../both/runge_kutta.h"
#include "../both/rodas5p.h"

#if IMPLICIT_STAGES
/* As those of methods/radau.c. */
static int make_pair(LaneRun *run, Lanes eta, Lanes eta_i, LaneComplexLinear *pair)
{
    pair->p = run->newton.linear.p;
    pair->value = run->newton.linear.value;
    newton_factor_complex(eta, eta_i, pair, &run->memory.rare);
    return 0;
}

static void look_around(LaneRun *run) { (void)run; } /* gather_past has */

static void count_rates(LaneRun *run, LaneBits active, int n)
{
    run->newton.asked += pick(active, all_of(n), all_of(0.0));
}

static void begin_pass(LaneRun *run, LaneStep *step, LaneBits active, int n)
{
    count_rates(run, active, n);
    step->n_seen = 0;
    for (int k = 0; k < N_MARGINS; k++)
        step->lowest[k] = pick(active, all_of(INFINITY), step->lowest[k]);
    for (int k = 0; k < 2 * N_X && N_WATCHED > 0; k++) {
        step->least[k] = pick(active, all_of(INFINITY), step->least[k]);
        step->most[k] = pick(active, all_of(-INFINITY), step->most[k]);
    }
    for (int i = 0; i < N_CLEARANCES; i++) {
        step->rate[i][0] = pick(active, all_of(INFINITY), step->rate[i][0]);
        step->rate[i][1] = pick(active, all_of(-INFINITY), step->rate[i][1]);
    }
}

/* What a lane sees that has found its stages stays as it is. */
static void note_pass(LaneRun *run, LaneStep *step, LaneBits active, const Lanes *y, const LaneAside *aside,
    double node)
{
    Lanes margins[AT_LEAST_ONE(N_MARGINS)], *const seen = step->seen[step->n_seen];
    note_margins(run, aside, margins);
    for (int j = 0; j < N_MARGINS; j++) {
        seen[j] = pick(active, margins[j], seen[j]);
        step->lowest[j] = pick(active, lanes_min_of(step->lowest[j], margins[j]), step->lowest[j]);
    }
    step->node[step->n_seen++] = node;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Lanes rate = aside->clearance[i].deltadot, *const old = step->rate[i];
        const Lanes low = lanes_min_of(old[0], rate), high = lanes_max_of(old[1], rate);
        step->rate[i][0] = pick(active, low, old[0]);
        step->rate[i][1] = pick(active, high, old[1]);
        seen[SEEN_FORCES + i] = pick(active, square_of_force(aside, i), seen[SEEN_FORCES + i]);
        seen[SEEN_RATES + i] = pick(active, rate, seen[SEEN_RATES + i]);
    }
    for (int k = 0; k < 2 * N_X && N_WATCHED > 0; k++) {
        step->least[k] = pick(active, lanes_min_of(step->least[k], y[k]), step->least[k]);
        step->most[k] = pick(active, lanes_max_of(step->most[k], y[k]), step->most[k]);
    }
}

static int stages_lost(LaneRun *run, LaneBits lost)
{
    run->newton.missed = lost & ~run->memory.rare;
    return 0;
}

#include "../both/radau.h"
#endif

static int method_try(LaneRun *run, int method, Lanes h, const LaneParameters *p, LaneStep *step)
{
#if IMPLICIT_STAGES
    run->newton.asked = all_of(0.0);
    run->newton.missed = (LaneBits){0};
    if (method == BY_RADAU5)
        return radau5_try(run, h, p, step);
    if (method == BY_RADAU9)
        return radau9_try(run, h, p, step);
#endif
    if (method == BY_RK4 || method == BY_DOPRI5)
        return runge_kutta_try(run, method == BY_RK4 ? &classical : &dormand_prince, h, p, step);
    return method == BY_RODAS5P ? rodas5p_try(run, h, p, step) : dop853_try(run, h, p, step);
}
#endif

#if !TAYLOR
/* In how many lanes something may end the step that they accept, as far as stages and its end tell. */
static int count_ends(const LaneRun *run, const LaneStep *step)
{
    Lanes margins[AT_LEAST_ONE(N_MARGINS)];
    LaneBits some = {0};
    int count = 0;
    note_margins(run, &step->aside, margins);
    for (int j = 0; j < N_MARGINS; j++)
        some |= (margins[j] < 0.0) | (step->lowest[j] < 0.0);
    some &= step->taken;
    for (int k = 0; k < LANES; k++)
        count -= (int)some[k];
    return count;
}

/* The interpolant of the explicit method, where more than one lane will ask for it; whatever is odd stays its run's. */
static void make_dense(LaneRun *run, const LaneParameters *p, LaneStep *step)
{
    const LaneBits rare = run->memory.rare;
    if (!any_of(step->taken) || count_ends(run, step) < 2)
        return;
    run->memory.rare = (LaneBits){0};
    dop853_dense(run, p, step);
    step->no_dense = run->memory.rare;
    for (int k = 0; k < N_DENSE; k++)
        step->no_dense |= not_finite(step->dense[k], NULL, N_Y);
    step->dense_ready = 1;
    run->memory.rare = rare;
}
#endif

/* A step of length h of all lanes; where it is neither accepted nor lost its error alone tells. */
static void try_lanes(LaneRun *run, int method, Lanes h, const LaneParameters *p, LaneStep *step)
{
    run->memory.rare = (LaneBits){0};
    method_try(run, method, h, p, step);
    step->lost |= run->memory.rare & step->taken;
    step->taken &= ~step->lost;
#if !TAYLOR
    if (method == BY_DOP853)
        make_dense(run, p, step);
#endif
}
