/*
 * One attempted step of a method that looks ahead: how near it came to what may end it, its tolerances, and its
 * end, brought back onto the constraints.
 */
#define ROWS_ROUNDED 2e-9  /* relative distance that may be rounding near a singular position */
enum { MAX_STRAYED = 4 }; /* attempts of a step that are refused for that */

/* Not negative while things go on as they are; NaN: does not act. */
static double event_function(const DiscreteState *discrete, const RhsOutputs *rhs, int k)
{
    if (k < N_CLEARANCES)
        return contact_event_function(discrete, rhs, k);
    k -= N_CLEARANCES;
    if (k < N_SWITCHES)
        return discrete->branch[k] * rhs->g[k];
    k -= N_SWITCHES;
    if (k < N_FRICTIONS)
        return friction_indicator(discrete, rhs, k);
    return discrete->event_sign[k - N_FRICTIONS] * rhs->event[k - N_FRICTIONS];
}

/* All of them. */
static void evaluate_event_functions(const DiscreteState *discrete, const RhsOutputs *rhs, double *out)
{
    for (int i = 0; i < N_CLEARANCES; i++)
        out[i] = contact_event_function(discrete, rhs, i);
    for (int k = 0; k < N_SWITCHES; k++)
        out[N_CLEARANCES + k] = discrete->branch[k] * rhs->g[k];
    for (int k = N_CLEARANCES + N_SWITCHES; k < N_EVENT_FUNCTIONS; k++)
        out[k] = event_function(discrete, rhs, k);
}

/* The tolerance of a step, as a share; 0 where its length is given. */
static double tolerance_of(const Integrator *run)
{
    return run->control.fixed > 0.0 ? 0.0 : 1.0 / run->norm.inverse_scale[2 * N_X - 1];
}

/* What the stages saw of one margin, or of another number: the first's, and how far apart the others' are. */
typedef struct {
    const double *first;
    int apart;
} StageValues;

static StageValues stage_values(const Step *step, int k)
{
    return step->seen_lane ? (StageValues){step->seen_lane + k * step->lanes, AT_LEAST_ONE(N_SEEN) * step->lanes}
        : (StageValues){&step->seen[0][k], AT_LEAST_ONE(N_SEEN)};
}

/* That of the i-th stage that was seen. */
static double stage_value(StageValues of, int i) { return of.first[i * of.apart]; }

static void forget_stages(Step *step)
{
    step->n_seen = 0;
    step->seen_lane = NULL;
    step->spread[0] = -1.0;
    step->swings = -1;
    for (int k = 0; k < N_EVENT_FUNCTIONS; k++)
        step->lowest[k] = INFINITY;
    for (int k = 0; k < 2 * N_X && N_WATCHED > 0; k++) {
        step->least[k] = INFINITY;
        step->most[k] = -INFINITY;
    }
    for (int k = 0; k < N_SWITCHES; k++)
        step->passed[k] = 0;
    for (int i = 0; i < N_CLEARANCES; i++) {
        step->rate[i][0] = INFINITY;
        step->rate[i][1] = -INFINITY;
    }
}

/* What a stage at `node` saw. */
static void record_stage(const Integrator *run, Step *step, const RhsOutputs *rhs, double node)
{
    double *const seen = step->seen[step->n_seen];
    evaluate_event_functions(&run->discrete, rhs, seen);
    for (int k = 0; k < N_EVENT_FUNCTIONS; k++)
        step->lowest[k] = seen[k] < step->lowest[k] ? seen[k] : step->lowest[k];
    step->node[step->n_seen++] = node;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Clearance *joint = &rhs->clearance[i];
        step->rate[i][0] = min_of(step->rate[i][0], joint->deltadot);
        step->rate[i][1] = max_of(step->rate[i][1], joint->deltadot);
        seen[SEEN_FORCES + i] = joint->F_n * joint->F_n + joint->F_t * joint->F_t;
        seen[SEEN_RATES + i] = joint->deltadot;
    }
}

/* Where a stage was, if something is watched. */
static void record_stage_state(Step *step, const double *y)
{
    for (int k = 0; k < 2 * N_X && N_WATCHED > 0; k++) {
        step->least[k] = min_of(step->least[k], y[k]);
        step->most[k] = max_of(step->most[k], y[k]);
    }
}

#include "../both/error_weights.h"

/* The step that closes the rows at a state, if there is one. */
static int can_close(Integrator *run, int open, double t, const double *y, const Parameters *p, double *dq, double *dv,
    double *worst)
{
    return open && !closing_of_state(t, y, &run->discrete, p, dq, dv, worst) && all_finite(dq, N_X)
        && all_finite(dv, N_X);
}

#include "../both/project.h"
#include "../both/distance.h"
#include "singular_policy.c"

/* What follows begins with a step as long as fitted when the like of it began before: *known, 0 if it never did. */
static void set_first_length(Integrator *run, double *known, double rough)
{
    if (*known > 0.0)
        run->control.h = *known;
    run->control.first = known;
    run->control.rough = rough;
}

/* Whether the next step is the first one at a side of a corner. */
static inline int begins_at_switch(const Integrator *run)
{
    return run->control.first && run->control.first >= &run->control.after_switch[0][0];
}

/* The next step's length; that of the step that is tried now; that of the last one up to where it ended. */
static void set_length(Integrator *run, double h) { run->control.h = h; }
static inline void set_attempt(Integrator *run, double h) { run->control.attempt.h = h; }
static void set_last_step(Integrator *run, double h) { run->control.last_step = h; }

/* The stiff method's length from before an event says nothing about what follows. */
static void forget_stiff_length(Integrator *run) { run->control.h_stiff = 0.0; }

static int drifts(const Integrator *run); /* whether terms of the equations keep the rows instead (methods.c) */

/* Back onto the rows, if that is how they are kept. */
static void project_if_needed(Integrator *run, double t, double *y, const Parameters *p)
{
    if (!drifts(run))
        project_rows(run, t, y, p);
}

/* Back onto everything that is held. */
static void project_state(Integrator *run, double t, double *y, const Parameters *p)
{
    project_if_needed(run, t, y, p);
    hold_contacts(run, t, y, p);
}

/* A drive whose rate jumps moves the linkage by an impulse; its work is counted. */
static inline void apply_drive_impulse(Integrator *run, const Parameters *p)
{
    const double before = kinetic_energy(run, p);
    project_rows(run, run->t, run->y, p);
    run->y[2 * N_X] += kinetic_energy(run, p) - before;
}

/* Whether a step's error is no number; whether it is too large. */
static int is_not_a_number(const Integrator *run, double error) { return (void)run, !isfinite(error); }
static int is_refused(const Integrator *run, const Step *step) { return step->error > run->control.accept; }

/*
 * The end of a step: projected, with its right-hand side. What the projection moves is a part of the error. Where it is
 * many tolerances the estimate has missed something, as the one of Radau may near a singular position, whose Jacobian
 * filters it; the first step of a run also closes the start. What shorter steps do not mend is rounding.
 */
static int finish_step(Integrator *run, Step *step, const Parameters *p)
{
    double before[N_Y];
    if (!all_finite(step->y, N_Y))
        return NOT_FINITE;
    memcpy(before, step->y, sizeof before);
    project_if_needed(run, step->t + step->h, step->y, p);
    const double missed = distance_from_rows(run, before, step->y);
    if (missed > max_of(FAR_FROM_ROWS, ROWS_ROUNDED / tolerance_of(run)) && run->counts.steps > 0
        && run->control.attempt.strayed++ < MAX_STRAYED)
        step->error = max_of(step->error, missed);
    hold_contacts(run, step->t + step->h, step->y, p);
    const int status = rates_at_rest(run, step->t + step->h, step->y, p, step->dy, &step->rhs);
    return status ? status : all_finite(step->dy, N_Y) ? 0 : NOT_FINITE;
}
