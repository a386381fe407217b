/* Copying of runs to and from SIMD lanes: one lane of the vector registers holds one run during a trial step. */
#include "lane_local_steps.c"

/*
 * Number of runs under way. If runs may use different methods, several runs share a lane, so that most lanes contain a
 * run that needs the most frequent method.
 */
#if TAYLOR
enum { MAX_GROUP_RUNS = LANES };
#else
enum { MAX_GROUP_RUNS = 4 * LANES };
#endif

/* Several runs under way in lanes: their integrators, numbers and next steps, and the data of the lanes. */
typedef struct {
    const Batch *batch;
    const SingleRunFunctions *one;
    Integrator *run[MAX_GROUP_RUNS];
    long number[MAX_GROUP_RUNS]; /* -1: free */
    int kind[MAX_GROUP_RUNS];    /* method of the next step of each run; -1: none */
    int loaded[LANES];    /* run whose parameters a lane holds; -1: none */
    LaneParameters p;
    Lanes h; /* lengths of the next steps, s */
#if LOCAL_STEPS
    LocalSteps local_steps;
#endif
    LaneIntegrator x;
    LaneStep step;
} LaneGroup;
/* Number of bytes of a Flow that are zero at the beginning. */
#if TAYLOR
#define CLEARED_BYTES (offsetof(LaneGroup, x) + offsetof(LaneIntegrator, series.terms))
#else
#define CLEARED_BYTES sizeof(LaneGroup)
#endif

/* Return whether place i of the runs under way is in use. */
static int has_run(const LaneGroup *group, int i) { return group->number[i] >= 0; }

/*
 * Load the parameters of the run in place i into lane k, unless they are there. If place i is free, the lane repeats
 * another run under way, so that its numbers are finite; its results are not used.
 */
static void load_lane_parameters(LaneGroup *group, int k, int i)
{
    for (int j = 0; j < MAX_GROUP_RUNS && !has_run(group, i); j++)
        i = has_run(group, j) ? j : i;
    if (group->loaded[k] == i)
        return;
    const double *p = group->batch->p_motion + group->number[i] * group->batch->numbers;
    for (long j = 0; j < group->batch->numbers; j++)
        ((Lanes *)&group->p)[j][k] = p[j];
    group->loaded[k] = i;
}

#if IMPLICIT_STAGES && !TAYLOR
/* Load the iteration history of a run into lane k: first guesses of the stages follow from it. */
static void gather_history(LaneIntegrator *x, int k, Integrator *run)
{
    update_iteration_history(run);
    x->newton.last_h[k] = run->newton.last_h;
    x->newton.convergence_rate[k] = run->newton.convergence_rate;
    x->newton.force_found[k] = run->newton.force_found;
    x->newton.continues[k] = -run->newton.continues;
    for (int j = 0; j < N_Y; j++) {
        x->newton.before_y[j][k] = run->newton.before_y[j];
        x->newton.before_dy[j][k] = run->newton.before_dy[j];
    }
}
#endif

/*
 * Load the state of lane k's run at the beginning of a step, and the length of the step, into the lane. Does nothing if
 * the lane holds the newest state, because it accepted the last step itself (lane_local_steps.c).
 */
static void gather_state(LaneGroup *group, int k)
{
    Integrator *run = group->run[group->loaded[k]];
    LaneIntegrator *x = &group->x;
#if LOCAL_STEPS
    if (has_run(group, k) && group->local_steps.here[k])
        return;
    if (has_run(group, k))
        load_local_steps(&group->local_steps, x, k, group->batch, group->number[k], group->one, run);
#endif
    group->h[k] = run->control.attempt.h;
    x->t[k] = run->t;
    x->control.accept[k] = run->control.accept;
    for (int j = 0; j < N_Y; j++) {
        x->y[j][k] = run->y[j];
        x->norm.weight[j][k] = run->norm.weight[j];
    }
#if TAYLOR
    x->series.order = run->series.order;
    x->control.fixed = run->control.fixed;
#else
    for (int j = 0; j < N_Y; j++)
        x->dy[j][k] = run->dy[j];
    for (int i = 0; i < N_LOOPS; i++)
        x->rhs.lambda[i][k] = run->rhs.lambda[i];
#if IMPLICIT_STAGES
    if (run->control.attempt.lane >= BY_RADAU5)
        gather_history(x, k, run);
#endif
#endif
    for (int i = 0; i < N_CLEARANCES; i++) {
        x->discrete.contact[i].closed[k] = run->discrete.contact[i].closed;
        x->discrete.contact[i].deltadot_minus[k] = run->discrete.contact[i].deltadot_minus;
        x->rhs.clearance[i].Fx[k] = run->rhs.clearance[i].Fx;
        x->rhs.clearance[i].Fy[k] = run->rhs.clearance[i].Fy;
        x->rhs.clearance[i].moment_first[k] = run->rhs.clearance[i].moment_first;
        x->rhs.clearance[i].moment_second[k] = run->rhs.clearance[i].moment_second;
    }
    for (int i = 0; i < N_SWITCHES; i++)
        x->discrete.branch[i][k] = run->discrete.branch[i];
    for (int i = 0; i < N_USER_EVENTS; i++)
        x->discrete.event_sign[i][k] = run->discrete.event_sign[i];
}

/*
 * Copy the right-hand side's outputs of lane k to those of a single run, `rhs`. Outputs that lanes do not have become
 * 0.
 */
static void scatter_rhs(const LaneRhsOutputs *x, int k, RhsOutputs *rhs)
{
    for (int i = 0; i < N_LOOPS; i++)
        rhs->lambda[i] = x->lambda[i][k];
    for (int i = 0; i < N_WORK; i++)
        rhs->power[i] = x->power[i][k];
    for (int i = 0; i < N_CLEARANCES; i++) {
        const LaneClearance *from = &x->clearance[i];
        rhs->clearance[i] = (Clearance){.Fx = from->Fx[k], .Fy = from->Fy[k], .F_n = from->F_n[k],
            .F_t = from->F_t[k], .ex = from->ex[k], .ey = from->ey[k], .e = from->e[k],
            .deltadot = from->deltadot[k], .v_t = from->v_t[k], .moment_first = from->moment_first[k],
            .moment_second = from->moment_second[k], .delta = from->delta[k], .power = from->power[k]};
#if LAW_STATES
        for (int j = 0; j < LAW_STATES; j++)
            rhs->clearance[i].state_rate[j] = from->state_rate[j][k];
#endif
    }
    for (int i = 0; i < N_SWITCHES; i++)
        rhs->g[i] = x->g[i][k];
    for (int i = 0; i < N_USER_EVENTS; i++)
        rhs->event[i] = x->event[i][k];
}

/*
 * Copy an accepted step of lane k to a single run's step, as that run itself would have computed it. Stages, values at
 * stages and the dense output stay in the lane: the step points to them with the stride LANES.
 */
static void scatter_step(const LaneGroup *group, int k, Step *step)
{
    const LaneStep *x = &group->step;
    for (int j = 0; j < N_Y; j++) {
        step->y[j] = x->y[j][k];
        step->dy[j] = x->dy[j][k];
    }
    step->stages_lane = (const double *)x->k + k;
    step->dense_lane = (const double *)x->dense + k;
    step->stage_values_lane = (const double *)x->stage_values + k;
    step->dense_ready = x->dense_ready && !x->no_dense[k] ? IN_LANE : 0;
    step->lanes = LANES;
    step->n_stored_stages = x->n_stored_stages;
    for (int s = 0; s < x->n_stored_stages; s++)
        step->node[s] = x->node[s];
    for (int j = 0; j < N_EVENT_FUNCTIONS; j++)
        step->lowest[j] = x->lowest[j][k];
    for (int j = 0; j < N_SWITCHES; j++)
        step->passed[j] = 0;
    for (int i = 0; i < N_CLEARANCES; i++) {
        step->rate[i][0] = x->rate[i][0][k];
        step->rate[i][1] = x->rate[i][1][k];
    }
    for (int j = 0; j < 2 * N_X && N_WATCHED > 0; j++) {
        step->least[j] = x->least[j][k];
        step->most[j] = x->most[j][k];
    }
    scatter_rhs(&x->rhs, k, &step->rhs);
}

#if TAYLOR
/*
 * Copy the counts and the series of a trial step in lane k to its run; the terms stay in the lane. `method` is not
 * used.
 */
static void scatter_trial(const LaneGroup *group, int k, int method, Integrator *run)
{
    (void)method;
    run->counts.evaluations += !run->series.ready;
    run->series.ready = IN_LANE;
    run->series.lane = (const double *)group->x.series.terms + k;
    run->series.lanes = LANES;
    run->series.max_step = group->x.series.max_step[k];
    run->control.attempt.h = group->step.h[k];
}
#else
/*
 * Copy the counts and iteration data of a trial step by `method` in lane k to its run, as the run itself would have
 * counted them.
 */
static void scatter_trial(const LaneGroup *group, int k, int method, Integrator *run)
{
    static const int of[LANE_KINDS] = {[BY_DOP853] = DOP853_STAGES, [BY_RK4] = RK4_STAGES, [BY_DOPRI5] = DOPRI5_STAGES,
        [BY_RODAS5P] = RODAS5P_STAGES, [BY_RADAU5] = 3, [BY_RADAU9] = 5};
    const int stages = of[method];
    (void)group, (void)k;
    run->counts.evaluations += stages - 1;
#if IMPLICIT_STAGES
    if (method >= BY_RADAU5) {
        run->counts.evaluations += (long)group->x.newton.evaluations[k] - stages + 1;
        run->newton.convergence_rate = group->x.newton.convergence_rate[k];
    }
#endif
    if (method >= BY_RODAS5P && !run->newton.ready) {
        run->counts.jacobians++;
        run->newton.ready = IN_LANE;
    }
}
#endif

/*
 * Copy the result of a trial step by `method` in lane k to its run: time, length, error norm and counts. The stability
 * and the step itself are copied only if the lane accepted it.
 */
static void scatter_result(const LaneGroup *group, int k, int method)
{
    Integrator *run = group->run[group->loaded[k]];
    Step *step = &run->step;
    step->t = group->step.t[k];
    step->h = group->step.h[k];
    step->error = group->step.error[k];
    step->dense_ready = 0;
    scatter_trial(group, k, method, run);
#if TAYLOR
    const int counts = 1;
#else
    const int counts = group->step.taken[k] || method == BY_DOPRI5; /* its error needs the rates at the end */
#endif
    run->counts.evaluations += counts; /* a series may be rejected by its end only */
    if (!group->step.taken[k])
        return;
    run->choice.stability = group->x.choice.stability[k];
    scatter_step(group, k, step);
}
