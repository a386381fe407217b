/*
 * The classical Runge-Kutta method of order 4 with fixed step (W. Kutta, Z. Math. Phys. 46, 1901).
 * Constraints are closed after every step, or, in absolute coordinates, stabilised by Baumgarte's terms.
 */

#define TrialOf Trial
#define Touched unsigned char
#include "../both/rk4_trial.h"
/* A step that is tried, past singular positions as well. */
static int rk4_try(Run *run, double h, const Parameters *p, Trial *trial)
{
    int status;
    for (first_way_of_fixed(run); other_way(run, status = rk4_trial(run, h, p, trial));)
        ;
    return status;
}

#include "friction_events.c"

#include "rk4_inside.c"
/*
 * Takes a trial as the new state, whole, if it is a number; latches follow from the gaps at both of its ends. Samples
 * on the way are stored.
 */
static int accept(Run *run, double h, double t_new, const Trial *trial, const Parameters *p, const Samples *out)
{
    if (!all_finite(trial->y, N_Y) || !all_finite(trial->dy, N_Y))
        return NOT_FINITE;
    const double t = run->t;
    const int sampled = *out->done < out->n && out->t[*out->done] < t_new, touches = may_touch(run, h, trial);
    if (sampled || touches)
        begin_step(run);
    const Aside before = run->aside;
    run->t = t_new;
    for (int j = 0; j < N_Y; j++) {
        run->y[j] = trial->y[j];
        run->dy[j] = trial->dy[j];
    }
    run->aside = trial->aside;
#if N_USER_EVENTS
    note_speed(run);
#endif
    int status = 0;
    defer_stop(&run->cancellation);
    for (int i = 0; i < N_CLEARANCES; i++)
        watch_turn(run, i, h, &before.clearance[i], &run->aside.clearance[i]);
    if (update_latches(run, t, h, before.clearance, run->aside.clearance, trial->touched, p)) {
        mark_jump(run, 1);
        status = rates(run, t_new, run->y, p, run->dy, &run->aside);
    }
    if (!status)
        status = watch(run, p);
    if (!status && touches)
        locate_inside(run, &run->from, before.clearance, p);
    if (!status)
        tape_row(run, t_new, run->y, p);
    if (!status && sampled)
        sample_inside(run, &run->from, p, out);
    allow_stop(&run->cancellation);
    return status;
}

#include "rk4_events.c"

/* From t to `end` and, rounded as a stage's time is, not beyond it: there another branch begins. */
static inline double way_to(double t, double end)
{
    double h = end - t;
    while (t + h > end)
        h = nextafter(h, 0.0);
    return h;
}

#if N_CORNERS
/* Part of a step, to t_new; where friction or a rigid contact changes on the way, in parts that end there. */
static int rk4_part(Run *run, double h, double t_new, const Parameters *p, const Samples *out)
{
    Trial trial;
#else
/* One step to t_new; where friction or a rigid contact changes on the way, in parts that end there. */
static int rk4_step(Run *run, double h, double t_new, const Parameters *p, const Samples *out)
{
    Trial trial;
    count_step(run, 0);
    if (t_new - run->t < h * SAME_LENGTH) /* what is left of one in which lists were full */
        h = t_new - run->t;
#endif
    for (int part = 0; part < MAX_PARTS; part++) {
        const int status = rk4_try(run, h, p, &trial);
        if (status)
            return status;
        const double share = friction_event(run, h, p, &trial);
        if (run->cancellation.stop)
            return STOPPED;
        if (share >= 1.0) {
            const int ended = rk4_events(run, h, &trial, p, out);
            return ended ? ended : accept(run, h, t_new, &trial, p, out);
        }
        const int ended = share < 0.0 ? NOT_FINITE : rk4_events(run, share * h, &trial, p, out);
        int failed = ended ? ended : accept(run, share * h, run->t + share * h, &trial, p, out);
        defer_stop(&run->cancellation);
        const Held before = held_before(run);
        if (!failed)
            failed = switch_friction(run, p);
        if (!failed)
            failed = meet(run, used_up(run), p);
        if (!failed)
            failed = note_arrivals(run, &before, 1e-4 * h, p);
        if (!failed)
            tape_jump(run, p);
        allow_stop(&run->cancellation);
        if (failed)
            return failed;
        h = N_CORNERS ? way_to(run->t, t_new) : t_new - run->t;
        if (!(h > 0.0))
            return 0;
        if (lists_full(run))
            return EVENTS_FULL;
    }
    return CHATTERING;
}

#if N_CORNERS
#include "rk4_jumps.c"

#endif
/*
 * Steps of length `step` from t[0] towards the last of n output times, at most `limit`; samples go to row `done` and
 * on, and no step is made shorter for them. Returns 0 (at the end, or to be called again), EVENTS_FULL, or what went
 * wrong.
 */
int gudgeon_rk4_run(void *memory, const double *parameters, double step, long n, const double *t, long limit,
    double *y, double *latched, signed char *state, long *done)
{
    Run *run = memory;
    const Parameters *p = (const Parameters *)parameters;
    const Samples out = {.n = n, .done = done, .t = t, .y = y, .latched = latched, .state = state};
    const int begins = !run->ready;
    double h;
#if N_CORNERS
    int status = run->ready ? 0 : begin_run(run, p); /* at t[0], not the grid's number: a jump may lie between */
#else
    if (!run->ready)
        run->t = step_end(t[0], t[n - 1], step, 0.0, &h);
    int status = run->ready ? 0 : begin(run, p);
#endif
#if N_USER_EVENTS
    if (!status && begins)
        status = begin_beyond(run, step, p);
#endif
    if (!status && begins)
        tape_row(run, run->t, run->y, p);
    for (long i = 0; !status; i++) {
        sample_here(run, step, p, &out);
        if (*done == n || i == limit)
            return 0;
        const double t_new = step_end(t[0], t[n - 1], step, (double)run->counts.steps + 1.0, &h);
        if (run->cancellation.stop)
            return STOPPED;
        if (lists_full(run))
            return EVENTS_FULL;
        status = rk4_step(run, h, t_new, p, &out);
        if (status == EVENTS_FULL)
            take_back_step(run);
#if N_USER_EVENTS
        if (!status && t_new >= t[n - 1])
            status = end_on_zeros(run, step, p);
#endif
    }
    return status;
}
