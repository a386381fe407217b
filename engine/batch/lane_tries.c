/*
 * A trial step of a method with step-size control for several runs in SIMD lanes. Where a pivot vanishes in a lane or a
 * number is not finite, its own run repeats the step (methods/). All consequences of a step belong to its run.
 */
#include "lane_motion.c"
#include "../scalar_simd/distance.h"

/* Discard what is stored of the stages of the previous step in all lanes: values, extrema, range of the state. */
static void discard_stages(LaneStep *step)
{
    step->n_stored_stages = 0;
    for (int k = 0; k < N_EVENT_FUNCTIONS; k++)
        step->min_event_value[k] = broadcast(INFINITY);
    for (int k = 0; k < 2 * N_X && N_MONITORED > 0; k++) {
        step->min_state[k] = broadcast(INFINITY);
        step->max_state[k] = broadcast(-INFINITY);
    }
    for (int i = 0; i < N_CLEARANCES; i++) {
        step->gap_rate_range[i][0] = broadcast(INFINITY);
        step->gap_rate_range[i][1] = broadcast(-INFINITY);
    }
}

/*
 * Set the masks of the lanes that accept the step, that fail, and whose stages were not found. Return whether no lane
 * accepts it. Failing lanes, those in needs_scalar, leave the step to the scalar code; that mask is then reset.
 */
static int decide_step_rejection(LaneIntegrator *run, LaneStep *step)
{
#if IMPLICIT_STAGES && !LANE_SERIES
    step->has_no_stages = run->newton.has_no_stages;
#else
    step->has_no_stages = (LaneBits){0};
#endif
    step->is_failed = run->discrete.needs_scalar & ~step->has_no_stages;
    step->is_accepted = ~(step->error > run->control.max_accepted_error) & ~step->is_failed & ~step->has_no_stages;
    run->discrete.needs_scalar = (LaneBits){0};
    return !any_of(step->is_accepted);
}

/* Rounding errors (N_Y) of the state at the end of a tried step; NULL: not known. */
#if LANE_SERIES
#define END_ROUNDING(run) ((run)->series.end_rounding_errors)
#else
#define END_ROUNDING(run) NULL
#endif

/*
 * Project the end of a step onto the constraints and compute the rates and the residuals of the closures there, in all
 * lanes. Return 0. Lanes with a large projection or numbers that are not finite are marked in needs_scalar.
 */
static int finish_step(LaneIntegrator *run, LaneStep *step, const LaneParameters *p)
{
    Lanes before[N_Y];
    run->discrete.needs_scalar |= find_nonfinite_lanes(step->y, NULL, N_Y);
    memcpy(before, step->y, sizeof before);
    project_onto_constraints(run, step->t + step->h, step->y, END_ROUNDING(run), p);
    run->discrete.needs_scalar |= compute_constraint_distance(run, before, step->y) > MAX_CONSTRAINT_DRIFT;
    evaluate_run_rhs(run, step->t + step->h, step->y, p, step->dy, &step->rhs);
    run->discrete.needs_scalar |= find_nonfinite_lanes(step->dy, NULL, N_Y);
    step->residual[0] = step->residual[1] = broadcast(0.0);
    accept_state(step->t + step->h, step->y, &run->discrete, p, &step->rhs, &step->residual[0], &step->residual[1]);
    return 0;
}

#if LANE_SERIES
#include "lane_series.c"
#else
/*
 * Compute the event functions of all lanes into out, in the order of evaluate_event_functions(): non-negative until an
 * event.
 */
static void evaluate_lane_event_functions(const LaneIntegrator *run, const LaneRhsOutputs *rhs, Lanes *out)
{
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Lanes delta = rhs->clearance[i].delta;
        out[i] = select_value(is_closed(&run->discrete.contact[i]), delta, -delta);
    }
    for (int k = 0; k < N_SWITCHES; k++)
        out[N_CLEARANCES + k] = run->discrete.branch[k] * rhs->g[k];
    for (int k = 0; k < N_USER_EVENTS; k++)
        out[N_CLEARANCES + N_SWITCHES + k] = run->discrete.event_sign[k] * rhs->event[k];
}

/* Return the squared contact force of joint i in all lanes, N^2. */
static Lanes compute_squared_force(const LaneRhsOutputs *rhs, int i)
{
    return rhs->clearance[i].F_n * rhs->clearance[i].F_n + rhs->clearance[i].F_t * rhs->clearance[i].F_t;
}

/*
 * Store the values of a stage at fraction `node` of the step: event functions, squared contact forces and gap rates.
 * Update the lowest value of each event function, and the range (smallest and largest value) of each gap rate.
 */
static void record_stage(const LaneIntegrator *run, LaneStep *step, const LaneRhsOutputs *rhs, double node)
{
    Lanes *const values = step->stage_values[step->n_stored_stages];
    evaluate_lane_event_functions(run, rhs, values);
    for (int k = 0; k < N_EVENT_FUNCTIONS; k++)
        step->min_event_value[k] = lanes_min_of(step->min_event_value[k], values[k]);
    step->node[step->n_stored_stages++] = node;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Lanes rate = rhs->clearance[i].deltadot;
        step->gap_rate_range[i][0] = lanes_min_of(step->gap_rate_range[i][0], rate);
        step->gap_rate_range[i][1] = lanes_max_of(step->gap_rate_range[i][1], rate);
        values[STAGE_FORCES + i] = compute_squared_force(rhs, i);
        values[STAGE_GAP_RATES + i] = rate;
    }
}

/*
 * Extend the range of coordinates and velocities in the step by those of a stage y, in all lanes; only if functions are
 * monitored.
 */
static void extend_stage_range(LaneStep *step, const Lanes *y)
{
    for (int k = 0; k < 2 * N_X && N_MONITORED > 0; k++) {
        step->min_state[k] = lanes_min_of(step->min_state[k], y[k]);
        step->max_state[k] = lanes_max_of(step->max_state[k], y[k]);
    }
}

/*
 * Leave the steps whose error norm is not finite to the scalar code: add their lanes to the mask needs_scalar. Return
 * 0, no rejection, as the other lanes continue; the scalar function of this name (methods/step.c) rejects the step.
 */
static int reject_nonfinite_error(LaneIntegrator *run, Lanes error)
{
    run->discrete.needs_scalar |= ~(lanes_fabs(error) <= DBL_MAX);
    return 0;
}

/* Return component i of stage s (a rate or an increment) in all lanes. */
static inline Lanes read_stage_component(const LaneStep *step, int s, int i) { return step->k[s][i]; }

/*
 * Linearize the equations of all lanes and factorize Newton's matrix 1 - hg J, hg = h gamma in s. Return 0. Lanes with
 * a vanishing pivot are marked in needs_scalar.
 */
static int factor_newton_matrix(LaneIntegrator *run, Lanes hg, const LaneParameters *p)
{
    copy_internal_states(&run->discrete, run->y);
    linearize(run->t, run->y, run->y + N_X, &run->discrete, p, run->dy + N_X, &run->rhs, &run->newton.linear,
        &run->discrete.needs_scalar);
    newton_factor(hg, &run->newton.linear, &run->discrete.needs_scalar);
    return 0;
}

#include "../scalar_simd/dop853.h"
#include "../scalar_simd/runge_kutta.h"
#include "../scalar_simd/rodas5p.h"

#if IMPLICIT_STAGES
/*
 * Factorize Newton's matrix of a Radau method in all lanes, into `matrix`. eta + i eta_i (s): the step length divided
 * by a complex eigenvalue of the method's matrix. Return 0. Lanes with a vanishing pivot are marked in needs_scalar.
 * For single runs, the function of this name is in methods/radau.c.
 */
static int factor_complex_matrix(LaneIntegrator *run, Lanes eta, Lanes eta_i, LaneComplexLinear *matrix)
{
    matrix->p = run->newton.linear.p;
    matrix->value = run->newton.linear.value;
    newton_factor_complex(eta, eta_i, matrix, &run->discrete.needs_scalar);
    return 0;
}

/* Do nothing: gather_stage_predictor() has loaded the stage predictor of each lane. */
static void load_stage_predictor(LaneIntegrator *run) { (void)run; } /* gather_stage_predictor has */

/* Add n evaluations of the right-hand side to the counts of the active lanes. */
static void count_stage_evaluations(LaneIntegrator *run, LaneBits is_active, int n)
{
    run->newton.evaluations += select_value(is_active, broadcast(n), broadcast(0.0));
}

/*
 * Begin an iteration of n stages: count n evaluations, and reset the extrema over the stages in the active lanes. These
 * are the lowest event functions, the ranges of the gap rates, and that of the state if functions are monitored. The
 * number of stored stages becomes 0; stored values of inactive lanes remain.
 */
static void begin_stage_iteration(LaneIntegrator *run, LaneStep *step, LaneBits is_active, int n)
{
    count_stage_evaluations(run, is_active, n);
    step->n_stored_stages = 0;
    for (int k = 0; k < N_EVENT_FUNCTIONS; k++)
        step->min_event_value[k] = select_value(is_active, broadcast(INFINITY), step->min_event_value[k]);
    for (int k = 0; k < 2 * N_X && N_MONITORED > 0; k++) {
        step->min_state[k] = select_value(is_active, broadcast(INFINITY), step->min_state[k]);
        step->max_state[k] = select_value(is_active, broadcast(-INFINITY), step->max_state[k]);
    }
    for (int i = 0; i < N_CLEARANCES; i++) {
        step->gap_rate_range[i][0] = select_value(is_active, broadcast(INFINITY), step->gap_rate_range[i][0]);
        step->gap_rate_range[i][1] = select_value(is_active, broadcast(-INFINITY), step->gap_rate_range[i][1]);
    }
}

/*
 * Store the data of a stage at fraction `node` of the step in the active lanes: event functions, squared forces and gap
 * rates from the outputs `rhs` of the right-hand side, and their extremes over the stages. Lanes whose iteration has
 * converged (inactive) keep theirs. y: state at the stage; its smallest and largest components are kept if the scene
 * has monitored functions, otherwise y is not used. Called for each stage in each Newton iteration of the Radau
 * methods.
 */
static void record_newton_stage(LaneIntegrator *run, LaneStep *step, LaneBits is_active, const Lanes *y,
    const LaneRhsOutputs *rhs, double node)
{
    Lanes event_functions[AT_LEAST_ONE(N_EVENT_FUNCTIONS)], *const values = step->stage_values[step->n_stored_stages];
    evaluate_lane_event_functions(run, rhs, event_functions);
    for (int j = 0; j < N_EVENT_FUNCTIONS; j++) {
        values[j] = select_value(is_active, event_functions[j], values[j]);
        /* no change in lanes that keep their value */
        step->min_event_value[j] = lanes_min_of(step->min_event_value[j], values[j]);
    }
    step->node[step->n_stored_stages++] = node;
    for (int i = 0; i < N_CLEARANCES; i++) {
        Lanes *const rate = &values[STAGE_GAP_RATES + i];
        values[STAGE_FORCES + i] = select_value(is_active, compute_squared_force(rhs, i), values[STAGE_FORCES + i]);
        *rate = select_value(is_active, rhs->clearance[i].deltadot, *rate);
        step->gap_rate_range[i][0] = lanes_min_of(step->gap_rate_range[i][0], *rate);
        step->gap_rate_range[i][1] = lanes_max_of(step->gap_rate_range[i][1], *rate);
    }
    for (int k = 0; k < 2 * N_X && N_MONITORED > 0; k++) {
        step->min_state[k] = select_value(is_active, lanes_min_of(step->min_state[k], y[k]), step->min_state[k]);
        step->max_state[k] = select_value(is_active, lanes_max_of(step->max_state[k], y[k]), step->max_state[k]);
    }
}

/*
 * Store the mask of the lanes whose stages were not found (`has_failed`), except those marked in needs_scalar. Return
 * 0.
 */
static int mark_failed_stages(LaneIntegrator *run, LaneBits has_failed)
{
    run->newton.has_no_stages = has_failed & ~run->discrete.needs_scalar;
    return 0;
}

#include "../scalar_simd/film_error.h"
#include "../scalar_simd/radau.h"

/* Compute the error of film forces at the ends of a step by radau5 or radau9 in all lanes. */
static void compute_film_errors(const LaneIntegrator *run, int method, LaneStep *step)
{
    if (has_films() && any_of(step->is_accepted))
        step->film_error = compute_film_error_at_ends(run, step,
            method == METHOD_RADAU5 ? &radau5_end_rates : &radau9_end_rates, FILM_SCALE_FRACTION);
}
#endif

/*
 * Try a step of length h (s) by `method` (a METHOD_ constant) in all lanes. Return 0 or a status, which the caller
 * ignores: lanes that fail are marked in masks. In the library of Taylor series, lane_series.c defines this function.
 */
static int try_method(LaneIntegrator *run, int method, Lanes h, const LaneParameters *p, LaneStep *step)
{
#if IMPLICIT_STAGES
    run->newton.evaluations = broadcast(0.0);
    run->newton.has_no_stages = (LaneBits){0};
    if (method == METHOD_RADAU5)
        return radau5_try_step(run, h, p, step);
    if (method == METHOD_RADAU9)
        return radau9_try_step(run, h, p, step);
#endif
    if (method == METHOD_RK4 || method == METHOD_DOPRI5)
        return runge_kutta_try_step(run, method == METHOD_RK4 ? &classical : &dormand_prince, h, p, step);
    return method == METHOD_RODAS5P ? rodas5p_try_step(run, h, p, step) : dop853_try_step(run, h, p, step);
}
#endif

#if !LANE_SERIES
/*
 * Return the number of right-hand sides of a trial step by `method` (BY_...) in each lane, without that at its end:
 * stages - 1 for explicit methods and rodas5p, counted per lane for radau5 and radau9. Not compiled for Taylor series.
 */
static Lanes count_trial_evaluations(const LaneIntegrator *run, int method)
{
    static const int n_stages[N_LANE_METHODS] = {[METHOD_DOP853] = DOP853_STAGES, [METHOD_RK4] = RK4_STAGES,
        [METHOD_DOPRI5] = DOPRI5_STAGES, [METHOD_RODAS5P] = RODAS5P_STAGES};
#if IMPLICIT_STAGES
    if (method >= METHOD_RADAU5)
        return run->newton.evaluations;
#endif
    (void)run;
    return broadcast(n_stages[method] - 1);
}

/*
 * Return the number of accepting lanes in which an event may end the step: an event function is negative at a stage or
 * the end.
 */
static int count_lanes_with_events(const LaneIntegrator *run, const LaneStep *step)
{
    Lanes event_functions[AT_LEAST_ONE(N_EVENT_FUNCTIONS)];
    LaneBits may_end = {0};
    int count = 0;
    evaluate_lane_event_functions(run, &step->rhs, event_functions);
    for (int j = 0; j < N_EVENT_FUNCTIONS; j++)
        may_end |= (event_functions[j] < 0.0) | (step->min_event_value[j] < 0.0);
    may_end &= step->is_accepted;
    for (int k = 0; k < LANES; k++)
        count -= (int)may_end[k];
    return count;
}

/*
 * Compute the dense output of a dop853 step in the lanes if more than one lane may need it for an event. Lanes in which
 * it fails are stored in step->has_no_dense: their runs compute it.
 */
static void compute_dense_output(LaneIntegrator *run, const LaneParameters *p, LaneStep *step)
{
    const LaneBits needs_scalar = run->discrete.needs_scalar;
    if (!any_of(step->is_accepted) || count_lanes_with_events(run, step) < 2)
        return;
    run->discrete.needs_scalar = (LaneBits){0};
    dop853_compute_dense_output(run, p, step);
    step->has_no_dense = run->discrete.needs_scalar;
    for (int k = 0; k < N_DENSE; k++)
        step->has_no_dense |= find_nonfinite_lanes(step->dense[k], NULL, N_Y);
    step->dense_ready = 1;
    run->discrete.needs_scalar = needs_scalar;
}
#endif

/*
 * Try a step of length h (s) by `method` in all lanes, and set the masks of lanes that accept or fail. With dop853 the
 * dense output may be computed too. In lanes that only reject the step, just the error is valid.
 */
static void try_step_in_lanes(LaneIntegrator *run, int method, Lanes h, const LaneParameters *p, LaneStep *step)
{
    run->discrete.needs_scalar = (LaneBits){0};
    try_method(run, method, h, p, step);
    step->is_failed |= run->discrete.needs_scalar & step->is_accepted;
    step->is_accepted &= ~step->is_failed;
#if !LANE_SERIES
    if (method == METHOD_DOP853)
        compute_dense_output(run, p, step);
#if IMPLICIT_STAGES
    if (method >= METHOD_RADAU5)
        compute_film_errors(run, method, step);
#endif
#endif
}
