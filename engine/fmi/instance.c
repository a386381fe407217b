/* An instance of the FMU: its parameters and start, integration to a given time, and outputs at a state. */
enum {
    MAX_STEPS_PER_CALL = 4000,
    SETTING = 0, INITIALIZING, RUNNING, /* parameters are set in the first two */
    N_INDICATORS = N_CLEARANCES + FMU_JUMPS /* in model exchange: contacts, switching points with a jump */
};
#define TIME_CONSTANT 1e3 /* s: end of a simulation without a stop time */

/* All results at a state, as gudgeon_evaluate() returns them. */
typedef struct {
    double a[FMU_AT_LEAST(N_Q)], multipliers[FMU_AT_LEAST(N_ROWS)],
        reactions[FMU_AT_LEAST(N_REACTION_COLUMNS * N_REACTIONS)], torques[FMU_AT_LEAST(N_DRIVES)],
        clearance[FMU_AT_LEAST(N_CLEARANCE_COLUMNS * N_CLEARANCES)],
        series[FMU_AT_LEAST(N_SERIES)], friction[FMU_AT_LEAST(N_FRICTION_COLUMNS * N_FRICTIONS)],
        energy[N_ENERGY], power[N_WORK], drift[N_DRIFT];
} Outputs;

/* The state of an instance. */
typedef struct {
    char *name;
    fmi3InstanceEnvironment environment;
    fmi3LogMessageCallback log_message;
    /* parameters set by the importer; values of all, and of the motion, without Baumgarte's gains */
    double set_values[FMU_PARAMETERS], p[FMU_VALUES], motion[FMU_VALUES];
    unsigned char is_set[FMU_PARAMETERS];
    double t, t_end, rtol;
    int phase, rtol_given; /* phase of the enum; whether the tolerance was set as a parameter */
    double y[N_S], sampled_discrete[FMU_AT_LEAST(N_DISCRETE)], a[FMU_AT_LEAST(N_Q)];
    signed char contact_codes[FMU_AT_LEAST(N_CLEARANCES)];
    int outputs_outdated, has_begun, has_ended; /* has_ended: an event has ended the run */
    Outputs out;
#if FMU_EXCHANGE
    int exchange; /* whether the importer integrates */
    double x[N_Y], nominal[N_Y], extent;
    DiscreteState discrete;
#endif
    size_t size;
    void *run;
} Model;

/*
 * Log an error `message` with the instance's name by the importer's callback; nothing is logged without a callback.
 * Return fmi3Error.
 */
static fmi3Status log_error(const Model *model, const char *message)
{
    char text[700];
    snprintf(text, sizeof text, "%s: %s", model->name, message);
    if (model->log_message)
        model->log_message(model->environment, fmi3Error, "logStatusError", text);
    return fmi3Error;
}

/*
 * Log an error `message` with the time and, if `status` is nonzero, "(status N)" and the reason of a status of the
 * engine. Return fmi3Error. Callers also pass the reference of a variable or a count as `status`.
 */
static fmi3Status log_error_with_status(const Model *model, const char *message, int status)
{
    char text[600];
    const char *reason = status == OUTSIDE ? ": a penetration exceeds the range of validity of its contact law"
        : status == LOST ? ": a joint whose contact is open penetrates its wall"
        : status == CHATTERING ? ": contacts, friction modes or branches change without end"
        : status == STALLED || status == TOO_SMALL ? ": the step length becomes too small"
        : status == NOT_FINITE || status == UNBOUNDED ? ": it is no longer finite"
        : status == FRICTION_INCONSISTENT ? ": friction makes contact forces inconsistent" : "";
    if (status)
        snprintf(text, sizeof text, "%s at t = %.9g s%s (status %d)", message, model->t, reason, status);
    else
        snprintf(text, sizeof text, "%s at t = %.9g s", message, model->t);
    return log_error(model, text);
}

#include "conditions.c"
#if INTEGRATES
static int integrate_instance(Model *model, double t);
#endif
#if FMU_EXCHANGE
static int set_initial_nominals(Model *model, const double *min_scale);
#endif

/*
 * Compute the parameters and the start of an instance, and begin its run there. Return fmi3OK, or an error that was
 * logged. Parameters are checked first. If the linkage does not close, it is continued from the start with the file's
 * parameters. A previous run of the instance is replaced. Called when initialization ends, or earlier if outputs are
 * requested.
 */
static fmi3Status begin_instance_run(Model *model)
{
    double residual = 0.0, size = 0.0, *q = model->y, *v = model->y + N_Q;
    unsigned char is_set_without_baumgarte[FMU_PARAMETERS];
    double values_without_baumgarte[FMU_PARAMETERS];
    gudgeon_prepare(model->set_values, model->is_set, model->p);
    for (int k = 0; k < FMU_SIZES; k++) {
        const double x = model->p[fmu_sizes[k][0]], y = fmu_sizes[k][1] < 0 ? 0.0 : model->p[fmu_sizes[k][1]];
        size = fmax(size, sqrt(x * x + y * y)); /* the same bits as in sizes.py */
    }
    size = size > 0.0 ? size : 1.0;
    if (!validate_parameters(model, size))
        return fmi3Error;
    memcpy(is_set_without_baumgarte, model->is_set, sizeof is_set_without_baumgarte);
    memcpy(values_without_baumgarte, model->set_values, sizeof values_without_baumgarte);
    for (int k = 0; k < FMU_BAUMGARTE_GAINS; k++) {
        is_set_without_baumgarte[fmu_baumgarte_gains[k]] = 1;
        values_without_baumgarte[fmu_baumgarte_gains[k]] = 0.0;
    }
    gudgeon_prepare(values_without_baumgarte, is_set_without_baumgarte, model->motion);
    memset(model->y, 0, sizeof model->y);
    if (gudgeon_start(model->t, model->p, size, q, v, &residual)) {
        /* continue from the start with the file's parameters */
        int has_set_parameter = 0;
        memcpy(model->y, fmu_start, sizeof fmu_start);
        for (int k = 0; k < FMU_PARAMETERS; k++)
            has_set_parameter |= model->is_set[k];
        if (has_set_parameter && gudgeon_continuation(model->t, model->p, size, q, v))
            return log_error_with_status(model, "the linkage does not close with these parameters", 0);
    }
    for (int k = 0; k < N_DISCRETE; k++)
        model->sampled_discrete[k] = NAN;
    free(model->run);
#if INTEGRATES
    double min_scale[2], scale[FMU_AT_LEAST(2 * N_X)], length = INFINITY;
    model->size = gudgeon_run_size();
    model->run = calloc(1, model->size);
    if (!model->run)
        return log_error_with_status(model, "out of memory", 0);
    for (int k = 0; k < FMU_CLEARANCES; k++)
        if (model->p[fmu_clearances[k]] > 0.0)
            length = fmin(length, model->p[fmu_clearances[k]]);
    length = isfinite(length) ? length : size;
    min_scale[0] = length, min_scale[1] = length / size;
    for (int k = 0; k < N_X; k++) {
        scale[k] = model->rtol * (fmu_is_angle[k] ? min_scale[1] : length);
        scale[N_X + k] = FMU_HAS_FILM ? fmin(model->rtol, FMU_FILM_VELOCITY_TOL * min_scale[1]) : model->rtol;
    }
    if (N_X == 0)
        scale[0] = model->rtol;
    const int is_fine = model->rtol < FMU_FINE_RTOL;
    double y[N_S], sampled_discrete[FMU_AT_LEAST(N_DISCRETE)];
    memcpy(y, model->y, sizeof y);
    memcpy(sampled_discrete, model->sampled_discrete, sizeof sampled_discrete);
    /* first the contacts and modes of friction at the start, then the run itself */
    for (int start = 1; start >= 0; start--) {
        gudgeon_run_start(model->run, model->motion, model->t, y, sampled_discrete);
        gudgeon_run_enable_end_events(model->run, !start);
        gudgeon_adaptive_setup(model->run, gudgeon_method(is_fine ? FMU_FIRST_METHOD_FINE : FMU_FIRST_METHOD),
            FMU_AUTOMATIC ? gudgeon_method(is_fine ? FMU_STIFF_METHOD_FINE : FMU_STIFF_METHOD) : 0, scale, min_scale,
            0.0);
        const int status = start ? integrate_instance(model, model->t) : 0;
        if (status)
            return log_error_with_status(model, "the motion cannot begin", status);
    }
    model->has_ended = 0;
#if FMU_EXCHANGE
    model->extent = size;
    memset(&model->discrete, 0, sizeof model->discrete);
    read_discrete_state(model->sampled_discrete, &model->discrete);
    convert_absolute_to_integrated(model->t, model->y, &model->discrete, (const Parameters *)model->p, model->x);
    const int invalid = set_initial_nominals(model, min_scale);
    if (invalid)
        return log_error_with_status(model, "the motion cannot begin", invalid);
#endif
#else
    model->size = gudgeon_kinematic_size();
    model->run = calloc(1, model->size);
    if (!model->run)
        return log_error_with_status(model, "out of memory", 0);
    gudgeon_kinematic_begin(model->run, FMU_MAX_CORRECTION, size, model->t_end, NULL, NULL, INFINITY);
#endif
    model->has_begun = 1;
    model->outputs_outdated = 1;
    return fmi3OK;
}

#if INTEGRATES
/*
 * Empty the lists of contacts and user-defined events of a run when they are full, so that the run can continue: an FMU
 * reports neither.
 */
static void discard_contacts_and_events(void *run)
{
    double numbers[N_IMPACT_COLUMNS], t, y[N_S], sampled_discrete[FMU_AT_LEAST(N_DISCRETE)];
    signed char contact_codes[FMU_AT_LEAST(N_CLEARANCES)];
    int number;
    while (gudgeon_run_impacts(run, 0, 1, numbers, &number)
        || gudgeon_run_events(run, 1, &t, &number, y, sampled_discrete, contact_codes))
        continue;
}

/*
 * Integrate the run of an instance to time t (s), which ends a step. Return 0 or a status. Full lists of contacts and
 * events are emptied. After an event that ends the run, its state is copied, model->has_ended is set and 0 is returned.
 * model->t is set by the caller.
 */
static int integrate_instance(Model *model, double t)
{
    long done = 0;
    int status = 0;
    while (!status && done < 1) {
        status = gudgeon_adaptive_run(model->run, model->motion, 1, &t, MAX_STEPS_PER_CALL, model->y,
            model->sampled_discrete, model->contact_codes, &done);
        if (status == EVENTS_FULL) {
            discard_contacts_and_events(model->run);
            status = 0;
        }
    }
    if (status == ENDED) {
        gudgeon_run_sample(model->run, model->motion, model->y, model->sampled_discrete, model->contact_codes);
        model->has_ended = 1;
        status = 0;
    }
    return status;
}
#else
/*
 * Follow the kinematic motion and its works from the time of an instance to time t (s), in a scene without degrees of
 * freedom. Return 0 or a status. The state of the instance is changed only without a failure; model->t is set by the
 * caller.
 */
static int integrate_instance(Model *model, double t)
{
    double rows[2] = {model->t, t}, q[2 * N_Q], v[2 * N_Q], a[2 * N_Q], work[2 * N_WORK], phi[2] = {0.0, 0.0};
    long steps = 0, done = 0;
    memcpy(q, model->y, N_Q * sizeof(double));
    memcpy(v, model->y + N_Q, N_Q * sizeof(double));
    memcpy(a, model->a, N_Q * sizeof(double));
    memcpy(work, model->y + 2 * N_Q, N_WORK * sizeof(double));
    int status = gudgeon_kinematic(model->run, 1, rows, model->p, q, v, a, phi, phi + 1, &steps, &done);
    if (!status)
        status = gudgeon_kinematic_works(model->run, 1, rows, model->p, q, v, work, &done);
    if (!status) {
        memcpy(model->y, q + N_Q, N_Q * sizeof(double));
        memcpy(model->y + N_Q, v + N_Q, N_Q * sizeof(double));
        memcpy(model->a, a + N_Q, N_Q * sizeof(double));
        memcpy(model->y + 2 * N_Q, work + N_WORK, N_WORK * sizeof(double));
    }
    return status;
}
#endif

#if FMU_EXCHANGE
static void synchronize_states(Model *model);
#endif

/*
 * Evaluate all outputs at the current state of an instance into model->out, unless they are up to date. Return 0 or a
 * status. As the rates, they have no Baumgarte terms in the reduced formulation.
 */
static int evaluate_outputs(Model *model)
{
    long failed = 0;
    Outputs *o = &model->out;
    if (!model->outputs_outdated)
        return 0;
    model->outputs_outdated = 0;
#if FMU_EXCHANGE
    synchronize_states(model);
#endif
    return gudgeon_evaluate(1, &model->t, model->y, model->y + N_Q, model->sampled_discrete,
        TREE ? model->motion : model->p, o->a, o->multipliers, o->reactions, o->torques, o->clearance, o->series,
        o->friction, o->energy, o->power, o->drift, &failed);
}

/*
 * Return an output of an instance: entry `column` of the result array number `array_index`, in the order of arrays[] in
 * the body: 0 to 2 for coordinates, velocities and works, ..., 13 for the drift. array_index < 0: the contact code of
 * joint `column`. Both numbers come from the table fmu_outputs of the FMU.
 */
static double get_output(const Model *model, int array_index, int column)
{
    const Outputs *o = &model->out;
    const double *const arrays[] = {model->y, model->y + N_Q, model->y + 2 * N_Q, model->sampled_discrete, o->a,
        o->multipliers, o->reactions, o->torques, o->clearance, o->series, o->friction, o->energy, o->power, o->drift};
    return array_index < 0 ? model->contact_codes[column] : arrays[array_index][column];
}
