/* Copying of runs to and from SIMD lanes (gather and scatter). One lane holds one run during a trial step. */
#include "lane_local_steps.c"

/*
 * Number of current runs. If runs may use different methods, several runs share a lane, so that most lanes contain a
 * run that needs the most frequent method.
 */
#if LANE_SERIES
enum { MAX_GROUP_RUNS = LANES };
#else
enum { MAX_GROUP_RUNS = 4 * LANES };
#endif

/* Several current runs in lanes: their integrators, numbers and next steps, and the data of the lanes. */
typedef struct {
    const Batch *batch;
    const SingleRunFunctions *scalar_functions;
    Integrator *run[MAX_GROUP_RUNS];
    long run_number[MAX_GROUP_RUNS]; /* -1: free */
    int next_method[MAX_GROUP_RUNS]; /* method of the next step of each run; -1: none */
    int loaded_run[LANES];    /* run whose parameters a lane holds; -1: none */
    LaneParameters p;
    Lanes h; /* lengths of the next steps, s */
#if LANE_LOCAL_STEPS
    LaneLocalSteps local_steps;
#endif
    LaneIntegrator integrator;
    LaneStep step;
} LaneGroup;
/* Number of bytes of a LaneGroup that are zero at the beginning. */
#if LANE_SERIES
#define CLEARED_BYTES (offsetof(LaneGroup, integrator) + offsetof(LaneIntegrator, series.terms))
#else
#define CLEARED_BYTES offsetof(LaneGroup, step)
#endif

/* Return whether entry i of a group holds a run. */
static int has_run(const LaneGroup *group, int i) { return group->run_number[i] >= 0; }

/*
 * Load the parameters of the group's run i into lane k, and set loaded_run[k]; nothing if the lane holds them. If entry
 * i is free, the lane repeats another run, so that its numbers are finite; its results are not used.
 */
static void load_lane_parameters(LaneGroup *group, int k, int i)
{
    for (int j = 0; j < MAX_GROUP_RUNS && !has_run(group, i); j++)
        i = has_run(group, j) ? j : i;
    if (group->loaded_run[k] == i)
        return;
    const double *p = group->batch->p_motion + group->run_number[i] * group->batch->numbers;
    for (long j = 0; j < group->batch->numbers; j++)
        ((Lanes *)&group->p)[j][k] = p[j];
    group->loaded_run[k] = i;
}

#if IMPLICIT_STAGES && !LANE_SERIES
/*
 * Move the stage predictor of a run to its present step and load it into lane k: the start of the previous step and its
 * distance, from which first guesses of iterated stages (Radau IIA) are extrapolated. Also load the scales of film
 * forces and the smallest sizes of the state.
 */
static void gather_stage_predictor(LaneIntegrator *lanes, int k, Integrator *run)
{
    update_stage_predictor(run);
    lanes->newton.last_h[k] = run->newton.last_h;
    lanes->newton.convergence_rate[k] = run->newton.convergence_rate;
    lanes->newton.film_force_tol[k] = run->newton.film_force_tol;
    lanes->newton.can_extrapolate[k] = -run->newton.can_extrapolate;
    lanes->films.lightest_mass[k] = run->films.lightest_mass;
    for (int kind = 0; kind < 2; kind++)
        lanes->norm.min_size[kind][k] = run->norm.min_size[kind];
    for (int j = 0; j < N_Y; j++) {
        lanes->newton.previous_y[j][k] = run->newton.previous_y[j];
        lanes->newton.previous_dy[j][k] = run->newton.previous_dy[j];
    }
}
#endif

/*
 * Load the state of lane k's run at the beginning of a step, and the length of the step, into the lane. Does nothing if
 * the lane holds the newest state, because it accepted the last step itself (lane_local_steps.c). is_requested: whether
 * the run needs the step; else its results are ignored.
 */
static void gather_state(LaneGroup *group, int k, int is_requested)
{
    Integrator *run = group->run[group->loaded_run[k]];
    LaneIntegrator *lanes = &group->integrator;
#if LANE_LOCAL_STEPS
    if (group->local_steps.has_state[k])
        return;
    group->local_steps.may_accept[k] = 0;
    if (is_requested)
        load_lane_local_steps(&group->local_steps, lanes, k, group->batch, group->run_number[group->loaded_run[k]],
            group->scalar_functions, run);
#else
    (void)is_requested;
#endif
    group->h[k] = run->control.attempt.h;
    lanes->t[k] = run->t;
    lanes->control.max_accepted_error[k] = run->control.max_accepted_error;
    for (int j = 0; j < N_Y; j++) {
        lanes->y[j][k] = run->y[j];
        lanes->norm.weight[j][k] = run->norm.weight[j];
    }
#if LANE_SERIES
    for (int j = 0; j < N_Y; j++)
        lanes->series.rounding_errors[j][k] = run->series.rounding_errors[j];
    lanes->series.order = run->series.order;
    lanes->series.strictness = run->series.strictness;
    lanes->series.defect_weight = run->series.defect_weight;
    lanes->control.fixed = run->control.fixed;
#else
    for (int j = 0; j < N_Y; j++)
        lanes->dy[j][k] = run->dy[j];
    for (int i = 0; i < N_LOOPS; i++)
        lanes->rhs.lambda[i][k] = run->rhs.lambda[i];
#if IMPLICIT_STAGES
    if (run->control.attempt.lane_method >= METHOD_RADAU5)
        gather_stage_predictor(lanes, k, run);
#endif
#endif
    for (int i = 0; i < N_CLEARANCES; i++) {
        lanes->discrete.contact[i].closed[k] = run->discrete.contact[i].closed;
        lanes->discrete.contact[i].deltadot_minus[k] = run->discrete.contact[i].deltadot_minus;
        lanes->rhs.clearance[i].Fx[k] = run->rhs.clearance[i].Fx;
        lanes->rhs.clearance[i].Fy[k] = run->rhs.clearance[i].Fy;
        lanes->rhs.clearance[i].moment_first[k] = run->rhs.clearance[i].moment_first;
        lanes->rhs.clearance[i].moment_second[k] = run->rhs.clearance[i].moment_second;
        lanes->rhs.clearance[i].F_n[k] = run->rhs.clearance[i].F_n;
        lanes->rhs.clearance[i].F_t[k] = run->rhs.clearance[i].F_t;
        lanes->rhs.clearance[i].delta[k] = run->rhs.clearance[i].delta;
        lanes->rhs.clearance[i].deltadot[k] = run->rhs.clearance[i].deltadot;
    }
    for (int i = 0; i < N_SWITCHES; i++)
        lanes->discrete.branch[i][k] = run->discrete.branch[i];
    for (int i = 0; i < N_USER_EVENTS; i++)
        lanes->discrete.event_sign[i][k] = run->discrete.event_sign[i];
}

/*
 * Copy the right-hand side's outputs of lane k to those of a single run, `rhs`. Outputs that lanes do not have become
 * 0.
 */
static void scatter_rhs(const LaneRhsOutputs *lane_rhs, int k, RhsOutputs *rhs)
{
    for (int i = 0; i < N_LOOPS; i++)
        rhs->lambda[i] = lane_rhs->lambda[i][k];
    for (int i = 0; i < N_WORK; i++)
        rhs->power[i] = lane_rhs->power[i][k];
    for (int i = 0; i < N_CLEARANCES; i++) {
        const LaneClearance *lane_joint = &lane_rhs->clearance[i];
        rhs->clearance[i] = (Clearance){.Fx = lane_joint->Fx[k], .Fy = lane_joint->Fy[k], .F_n = lane_joint->F_n[k],
            .F_t = lane_joint->F_t[k], .ex = lane_joint->ex[k], .ey = lane_joint->ey[k], .e = lane_joint->e[k],
            .deltadot = lane_joint->deltadot[k], .v_t = lane_joint->v_t[k], .power = lane_joint->power[k],
            .moment_first = lane_joint->moment_first[k], .moment_second = lane_joint->moment_second[k],
            .delta = lane_joint->delta[k]};
#if LAW_STATES
        for (int j = 0; j < LAW_STATES; j++)
            rhs->clearance[i].state_rate[j] = lane_joint->state_rate[j][k];
#endif
    }
    for (int i = 0; i < N_SWITCHES; i++)
        rhs->g[i] = lane_rhs->g[i][k];
    for (int i = 0; i < N_USER_EVENTS; i++)
        rhs->event[i] = lane_rhs->event[i][k];
}

/*
 * Copy an accepted step of lane k to a single run's step, as that run itself would have computed it: the end state and
 * its rates, right-hand side, rates of contacts, nodes, minima of event functions, bounds of the state. Stages, values
 * at stages and the dense output stay in the lane: the step points to them with the stride LANES. Clears
 * step->is_ignored. Time, length and error of the step are set by scatter_result(), the caller.
 */
static void scatter_step(const LaneGroup *group, int k, Step *step)
{
    const LaneStep *lane_step = &group->step;
    for (int j = 0; j < N_Y; j++) {
        step->y[j] = lane_step->y[j][k];
        step->dy[j] = lane_step->dy[j][k];
    }
    step->stages_lane = (const double *)lane_step->k + k;
    step->dense_lane = (const double *)lane_step->dense + k;
    step->stage_values_lane = (const double *)lane_step->stage_values + k;
    step->dense_ready = lane_step->dense_ready && !lane_step->has_no_dense[k] ? IN_LANE : 0;
    step->lanes = LANES;
    for (int i = 0; i < 2; i++)
        step->residual[i] = lane_step->residual[i][k];
    step->film_error = lane_step->film_error[k];
    step->n_stored_stages = lane_step->n_stored_stages;
    for (int s = 0; s < lane_step->n_stored_stages; s++)
        step->node[s] = lane_step->node[s];
    for (int j = 0; j < N_EVENT_FUNCTIONS; j++)
        step->min_event_value[j] = lane_step->min_event_value[j][k];
    for (int j = 0; j < N_SWITCHES; j++)
        step->is_ignored[j] = 0;
    for (int i = 0; i < N_CLEARANCES; i++) {
        step->gap_rate_range[i][0] = lane_step->gap_rate_range[i][0][k];
        step->gap_rate_range[i][1] = lane_step->gap_rate_range[i][1][k];
    }
    for (int j = 0; j < 2 * N_X && N_MONITORED > 0; j++) {
        step->min_state[j] = lane_step->min_state[j][k];
        step->max_state[j] = lane_step->max_state[j][k];
    }
    scatter_rhs(&lane_step->rhs, k, &step->rhs);
}

#if LANE_SERIES
/*
 * Add the evaluations of a trial step by `method` in lane k to the counts of its run, as the run itself would have
 * counted them. Implicit methods count one Jacobian too, unless one was stored, and mark it as stored in the lane
 * (newton.ready). With iterated stages the convergence rate of Newton's method is copied.
 */
static void scatter_trial_counts(const LaneGroup *group, int k, int method, Integrator *run)
{
    (void)method;
    run->counts.evaluations += !run->series.ready;
    run->series.ready = IN_LANE;
    run->series.lane = (const double *)group->integrator.series.terms + k;
    run->series.lanes = LANES;
    for (int j = 0; j < N_Y; j++)
        run->series.end_rounding_errors[j] = group->integrator.series.end_rounding_errors[j][k];
    run->series.max_step = group->integrator.series.max_step[k];
    run->control.attempt.h = group->step.h[k];
}
#else
/*
 * Copy the count, the longest valid length and the rounding errors of a series step in lane k to its run. The terms of
 * the series stay in the lane: run->series points to them with the stride LANES. The attempt's length becomes that of
 * the step. `method` is not used.
 */
static void scatter_trial_counts(const LaneGroup *group, int k, int method, Integrator *run)
{
    run->counts.evaluations += (long)count_trial_evaluations(&group->integrator, method)[k];
#if IMPLICIT_STAGES
    if (method >= METHOD_RADAU5)
        run->newton.convergence_rate = group->integrator.newton.convergence_rate[k];
#endif
    if (method >= METHOD_RODAS5P && !run->newton.ready) {
        run->counts.jacobians++;
        run->newton.ready = IN_LANE;
    }
}
#endif

/*
 * Copy the result of a trial step by `method` in lane k to its run: time, length, error norm and counts. The stiffness
 * estimate and the step itself (scatter_step()) are copied only if the lane accepted it.
 */
static void scatter_result(const LaneGroup *group, int k, int method)
{
    Integrator *run = group->run[group->loaded_run[k]];
    Step *step = &run->step;
    step->t = group->step.t[k];
    step->h = group->step.h[k];
    step->error = group->step.error[k];
    step->dense_ready = 0;
    scatter_trial_counts(group, k, method, run);
#if LANE_SERIES
    const int counts_end = 1;
#else
    /* the error of dopri5 needs the rates at the end */
    const int counts_end = group->step.is_accepted[k] || method == METHOD_DOPRI5;
#endif
    run->counts.evaluations += counts_end; /* a series may be rejected by its end only */
    if (!group->step.is_accepted[k])
        return;
    run->choice.h_rho = group->integrator.choice.h_rho[k];
    scatter_step(group, k, step);
}
