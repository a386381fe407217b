/* Parts of a trial step of any method: values at its stages, event functions, error weights, projection of its end. */
#define CONSTRAINT_ROUNDING 2e-9  /* relative constraint residual that may be rounding near a singular position */
enum { MAX_DRIFT_REJECTIONS = 4 }; /* attempts of a step rejected for their distance from the constraints */

/*
 * Return event function k at a state: non-negative while the discrete state stays valid, NaN if it is inactive. The
 * zero of the function is the event. Order of k: contacts, switching functions, friction elements, user-defined events.
 * rhs: outputs of the right-hand side at the state.
 */
static double compute_event_value(const DiscreteState *discrete, const RhsOutputs *rhs, int k)
{
    if (k < N_CLEARANCES)
        return evaluate_contact_event_function(discrete, rhs, k);
    k -= N_CLEARANCES;
    if (k < N_SWITCHES)
        return discrete->branch[k] * rhs->g[k];
    k -= N_SWITCHES;
    if (k < N_FRICTIONS)
        return evaluate_friction_event_function(discrete, rhs, k);
    return discrete->event_sign[k - N_FRICTIONS] * rhs->event[k - N_FRICTIONS];
}

/* Compute all event functions of a state into out (N_EVENT_FUNCTIONS), in the order of compute_event_value(). */
static void evaluate_event_functions(const DiscreteState *discrete, const RhsOutputs *rhs, double *out)
{
    for (int i = 0; i < N_CLEARANCES; i++)
        out[i] = evaluate_contact_event_function(discrete, rhs, i);
    for (int k = 0; k < N_SWITCHES; k++)
        out[N_CLEARANCES + k] = discrete->branch[k] * rhs->g[k];
    for (int k = N_CLEARANCES + N_SWITCHES; k < N_EVENT_FUNCTIONS; k++)
        out[k] = compute_event_value(discrete, rhs, k);
}

/* Return the relative tolerance of the steps of a run (that of the last velocity), 0 for fixed steps. */
static double get_rtol(const Integrator *run)
{
    return run->control.fixed > 0.0 ? 0.0 : 1.0 / run->norm.inverse_scale[2 * N_X - 1];
}

/* Values of one event function, or another stored value, at the stages of a step: first value and stride. */
typedef struct {
    const double *first;
    int stride;
} StageValues;

/*
 * Return the location of the values number k at all stages of a step: an event function, or STAGE_FORCES and later.
 * They are in the lane if the step was computed in lanes. read_stage() reads them.
 */
static StageValues get_stage_values(const Step *step, int k)
{
    return step->stage_values_lane
        ? (StageValues){step->stage_values_lane + k * step->lanes, AT_LEAST_ONE(N_STAGE_VALUES) * step->lanes}
        : (StageValues){&step->stage_values[0][k], AT_LEAST_ONE(N_STAGE_VALUES)};
}

/* Return the value of the i-th stage from `values`, a result of get_stage_values(). */
static double read_stage(StageValues values, int i) { return values.first[i * values.stride]; }

/* Return component i of stage s (a rate or an increment) of a step, from the lane if the step was computed in lanes. */
static inline double read_stage_component(const Step *step, int s, int i)
{
    return step->stages_lane ? step->stages_lane[(s * N_Y + i) * step->lanes] : step->k[s][i];
}

/* Discard all that is stored of the stages of a step: values, extrema, crossed switching points, range of the state. */
static void discard_stages(Step *step)
{
    step->n_stored_stages = 0;
    step->stage_values_lane = NULL;
    step->term_range[0] = -1.0;
    step->may_force_oscillate = -1;
    for (int k = 0; k < N_EVENT_FUNCTIONS; k++)
        step->min_event_value[k] = INFINITY;
    for (int k = 0; k < 2 * N_X && N_MONITORED > 0; k++) {
        step->min_state[k] = INFINITY;
        step->max_state[k] = -INFINITY;
    }
    for (int k = 0; k < N_SWITCHES; k++)
        step->is_ignored[k] = 0;
    for (int i = 0; i < N_CLEARANCES; i++) {
        step->gap_rate_range[i][0] = INFINITY;
        step->gap_rate_range[i][1] = -INFINITY;
    }
}

/*
 * Store the event functions, squared forces and gap rates of a stage at fraction `node` of a step, and update their
 * extrema. rhs: outputs of the right-hand side at the stage. Increments step->n_stored_stages.
 */
static void record_stage(const Integrator *run, Step *step, const RhsOutputs *rhs, double node)
{
    double *const values = step->stage_values[step->n_stored_stages];
    evaluate_event_functions(&run->discrete, rhs, values);
    for (int k = 0; k < N_EVENT_FUNCTIONS; k++)
        step->min_event_value[k] = values[k] < step->min_event_value[k] ? values[k] : step->min_event_value[k];
    step->node[step->n_stored_stages++] = node;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Clearance *joint = &rhs->clearance[i];
        step->gap_rate_range[i][0] = min_of(step->gap_rate_range[i][0], joint->deltadot);
        step->gap_rate_range[i][1] = max_of(step->gap_rate_range[i][1], joint->deltadot);
        values[STAGE_FORCES + i] = joint->F_n * joint->F_n + joint->F_t * joint->F_t;
        values[STAGE_GAP_RATES + i] = joint->deltadot;
    }
}

/*
 * Extend the range of the coordinates and velocities in a step by those of a stage y; only if functions are monitored.
 */
static void extend_stage_range(Step *step, const double *y)
{
    for (int k = 0; k < 2 * N_X && N_MONITORED > 0; k++) {
        step->min_state[k] = min_of(step->min_state[k], y[k]);
        step->max_state[k] = max_of(step->max_state[k], y[k]);
    }
}

#include "../scalar_simd/error_weights.h"
#include "../scalar_simd/step_decisions.h"

/*
 * Compute the corrections dq, dv (N_X) that close the constraints at state y, and their largest residual *residual.
 * Return whether they are finite. Return 0 without a computation if not `is_active`, and if the constraints cannot be
 * solved. y is not changed. In lanes, is_active is a mask.
 */
static int compute_closure_correction(Integrator *run, int is_active, double t, const double *y, const Parameters *p,
    double *dq, double *dv, double *residual)
{
    return is_active && !compute_correction(t, y, &run->discrete, p, dq, dv, residual) && all_finite(dq, N_X)
        && all_finite(dv, N_X);
}

#include "../scalar_simd/project.h"
#include "../scalar_simd/distance.h"
#include "../scalar_simd/film_error.h"
#include "singular_policy.c"

/*
 * Start the next step with the length that fitted after the previous event of this kind, *stored_length (s; 0: none
 * yet, the length stays). That step then updates *stored_length (record_first_step_length()). first_step_order: order
 * of the error of such a step, 0: that of the method.
 */
static void set_first_step(Integrator *run, double *stored_length, double first_step_order)
{
    if (*stored_length > 0.0)
        run->control.h = *stored_length;
    run->control.stored_first_length = stored_length;
    run->control.first_step_order = first_step_order;
}

/* Return whether the next step is the first one after a switching point: its stored length is one of after_switch. */
static inline int is_first_after_switch(const Integrator *run)
{
    return run->control.stored_first_length && run->control.stored_first_length >= &run->control.after_switch[0][0];
}

/* Set the length of the next step, s. */
static void set_next_step_length(Integrator *run, double h) { run->control.h = h; }

/* Set the length of the current attempt, s. */
static inline void set_attempt_step_length(Integrator *run, double h) { run->control.attempt.h = h; }

/* Store the length of the last step up to its end or its event, s. */
static void set_last_step_length(Integrator *run, double h) { run->control.last_step = h; }

/* Discard the stored step length of the stiff method after an event, to which it does not apply. */
static void discard_stiff_step_length(Integrator *run) { run->control.h_stiff = 0.0; }

/*
 * Restart the count of unstable steps, after a contact has begun or ended. Between frequent contacts, the steps of the
 * stiff method cannot become longer.
 */
static void restart_unstable_steps(Integrator *run) { run->choice.n_unstable_steps = 0; }

static int uses_baumgarte_terms(const Integrator *run); /* methods/methods.c */
static double *get_end_rounding(Integrator *run); /* methods/taylor.c */

/*
 * Project state y at time t in place onto the constraint equations, unless Baumgarte stabilization by the method
 * replaces that. If the projection cannot be computed, y stays. rounding_errors (N_Y): accumulated ones of y, updated;
 * NULL: none are accumulated.
 */
static void project_unless_stabilized(
    Integrator *run, double t, double *y, double *rounding_errors, const Parameters *p)
{
    if (!uses_baumgarte_terms(run))
        project_onto_constraints(run, t, y, rounding_errors, p);
}

/*
 * Project state y at time t in place onto the constraint equations, unless the method uses Baumgarte stabilization, and
 * onto the closed rigid contacts. Called for samples and states between the ends of steps.
 */
static void project_state(Integrator *run, double t, double *y, const Parameters *p)
{
    project_unless_stabilized(run, t, y, NULL, p);
    project_closed_contacts(run, t, y, p);
}

/*
 * Apply the impulse of a drive whose rate jumps: project the run's state onto the constraints, whose branches are those
 * after the jump. The gain of kinetic energy is added to the work of the drives.
 */
static inline void apply_drive_impulse(Integrator *run, const Parameters *p)
{
    const double before = compute_kinetic_energy(run, p);
    project_onto_constraints(run, run->t, run->y, NULL, p);
    run->y[2 * N_X] += compute_kinetic_energy(run, p) - before;
}

/* Return whether an attempt must be rejected because its error norm is not finite. */
static int reject_nonfinite_error(const Integrator *run, double error) { return (void)run, !isfinite(error); }

/* Return whether the error norm of a step exceeds the accepted one: 1, or infinity for fixed steps. */
static int decide_step_rejection(const Integrator *run, const Step *step)
{
    return step->error > run->control.max_accepted_error;
}

/*
 * Project the end of a tried step onto the constraints and closed contacts, and evaluate the right-hand side there,
 * into step->dy and step->rhs. Return 0, NOT_FINITE, or the status of the right-hand side.
 *
 * A projection by more than MAX_CONSTRAINT_DRIFT counts as error of the step: the estimate of Radau, filtered by the
 * Jacobian, may miss it near a singular position. It does not count in the first step, which closes the start, and
 * after MAX_DRIFT_REJECTIONS attempts, as rounding.
 */
static int finish_step(Integrator *run, Step *step, const Parameters *p)
{
    double before[N_Y];
    if (!all_finite(step->y, N_Y))
        return NOT_FINITE;
    memcpy(before, step->y, sizeof before);
    project_unless_stabilized(run, step->t + step->h, step->y, get_end_rounding(run), p);
    const double constraint_distance = compute_constraint_distance(run, before, step->y);
    if (constraint_distance > max_of(MAX_CONSTRAINT_DRIFT, CONSTRAINT_ROUNDING / get_rtol(run)) && run->counts.steps > 0
        && run->control.attempt.n_drift_rejections++ < MAX_DRIFT_REJECTIONS)
        step->error = max_of(step->error, constraint_distance);
    project_closed_contacts(run, step->t + step->h, step->y, p);
    const int status = evaluate_rates_without_residual_slips(run, step->t + step->h, step->y, p, step->dy, &step->rhs);
    return status ? status : all_finite(step->dy, N_Y) ? 0 : NOT_FINITE;
}
