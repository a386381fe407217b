/*
 * A scene as an FMU: functions of FMI 3 that create, initialize, step and free an instance. The file "fmu.h", written
 * with the scene, contains parameters, start and the locations of outputs. In co-simulation the engine integrates, and
 * a communication point ends a step. In model exchange (exchange.c) the importer integrates.
 */
#include "model.h"
#include "engine/scene/kernels.h"
#include "engine/scene/calls.h"
#include "fmi3.h"
#include "fmu.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "instance.c"

/* Return the version of FMI, "3.0". */
FMI3_EXPORT const char *fmi3GetVersion(void) { return "3.0"; }

/* Accept and ignore the settings of debug logging (FMI 3): only errors are logged. */
FMI3_EXPORT fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean is_enabled, size_t n,
    const fmi3String categories[])
{
    return (void)instance, (void)is_enabled, (void)n, (void)categories, fmi3OK;
}

/*
 * Create an instance with default settings and a copy of its name. Return NULL if the instantiation token is wrong,
 * which is logged, or memory is exhausted.
 */
static Model *create_instance(fmi3String name, fmi3String token, fmi3InstanceEnvironment environment,
    fmi3LogMessageCallback log_message)
{
    if (!token || strcmp(token, FMU_TOKEN)) {
        if (log_message)
            log_message(environment, fmi3Error, "logStatusError", "the instantiation token is that of another model");
        return NULL;
    }
    Model *model = calloc(1, sizeof(Model));
    if (!model)
        return NULL;
    const size_t length = strlen(name ? name : "") + 1;
    model->name = malloc(length);
    if (!model->name) {
        free(model);
        return NULL;
    }
    memcpy(model->name, name ? name : "", length);
    model->environment = environment;
    model->log_message = log_message;
    model->rtol = FMU_RTOL;
    model->t_end = TIME_CONSTANT;
    return model;
}

/*
 * Create an instance for co-simulation (FMI 3). Return NULL if the token is wrong or memory is exhausted. Other
 * arguments are ignored: the FMU has neither event mode nor early return.
 */
FMI3_EXPORT fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources,
    fmi3Boolean visible, fmi3Boolean logs, fmi3Boolean has_event_mode, fmi3Boolean returns_early,
    const fmi3ValueReference required[], size_t n, fmi3InstanceEnvironment environment,
    fmi3LogMessageCallback log_message, fmi3IntermediateUpdateCallback update)
{
    (void)resources, (void)visible, (void)logs, (void)has_event_mode, (void)returns_early, (void)required, (void)n;
    (void)update;
    return create_instance(name, token, environment, log_message);
}

/* Create an instance for model exchange (FMI 3). Return NULL if the scene does not support it or the token is wrong. */
FMI3_EXPORT fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources,
    fmi3Boolean visible, fmi3Boolean logs, fmi3InstanceEnvironment environment, fmi3LogMessageCallback log_message)
{
    (void)resources, (void)visible, (void)logs;
#if FMU_EXCHANGE
    Model *model = create_instance(name, token, environment, log_message);
    if (model)
        model->exchange = 1;
    return model;
#else
    return (void)name, (void)token, (void)environment, (void)log_message, NULL;
#endif
}

/* Return NULL: scheduled execution (FMI 3) is not supported. */
FMI3_EXPORT fmi3Instance fmi3InstantiateScheduledExecution(fmi3String name) { return (void)name, NULL; }

/* Free an instance with its run (FMI 3). NULL is ignored. */
FMI3_EXPORT void fmi3FreeInstance(fmi3Instance instance)
{
    Model *model = instance;
    if (!model)
        return;
    free(model->run);
    free(model->name);
    free(model);
}

/*
 * Enter initialization mode (FMI 3): set start and end times, s, and the importer's tolerance, at least 1e-14, unless
 * one was set as a parameter. Without a stop time the end is TIME_CONSTANT after the start. Return an error in any
 * other phase than after instantiation or a reset.
 */
FMI3_EXPORT fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean has_tolerance,
    fmi3Float64 tolerance, fmi3Float64 start, fmi3Boolean has_stop, fmi3Float64 stop)
{
    Model *model = instance;
    if (model->phase != SETTING)
        return log_error(model, "initialization mode is entered once, after instantiation or a reset");
    model->phase = INITIALIZING;
    model->has_begun = 0; /* outputs may have been requested before */
    model->t = start;
    model->t_end = has_stop ? stop : start + TIME_CONSTANT;
    if (has_tolerance && tolerance > 0.0 && tolerance < 1.0 && !model->rtol_given)
        model->rtol = fmax(tolerance, 1e-14);
    return fmi3OK;
}

/*
 * Leave initialization mode and begin the run, unless outputs were requested before (FMI 3). Return an error if the
 * mode was not entered or the run cannot begin.
 */
FMI3_EXPORT fmi3Status fmi3ExitInitializationMode(fmi3Instance instance)
{
    Model *model = instance;
    if (model->phase != INITIALIZING)
        return log_error(model, "initialization mode was not entered");
    if (!model->has_begun && begin_instance_run(model))
        return fmi3Error;
    model->phase = RUNNING;
    return fmi3OK;
}

/* Accept the end of a simulation (FMI 3); nothing is freed. */
FMI3_EXPORT fmi3Status fmi3Terminate(fmi3Instance instance) { return (void)instance, fmi3OK; }

/*
 * Reset an instance to its state after instantiation: parameters, tolerance, phase and time (FMI 3). The memory of the
 * run is kept until the next one begins.
 */
FMI3_EXPORT fmi3Status fmi3Reset(fmi3Instance instance)
{
    Model *model = instance;
    memset(model->is_set, 0, sizeof model->is_set);
    model->rtol = FMU_RTOL;
    model->has_begun = model->has_ended = model->rtol_given = 0;
    model->phase = SETTING;
    model->t = 0.0;
    return fmi3OK;
}

/*
 * Integrate an instance from t, its current time, to t + h (s), a communication point (FMI 3). last_time: time reached.
 * terminate: whether an event ended the run; the state then no longer changes. Return an error outside a run, for h <=
 * 0 or another t, and if the integration fails.
 */
FMI3_EXPORT fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 t, fmi3Float64 h, fmi3Boolean cannot_return,
    fmi3Boolean *event_needed, fmi3Boolean *terminate, fmi3Boolean *returns_early, fmi3Float64 *last_time)
{
    Model *model = instance;
    (void)cannot_return;
    *event_needed = *terminate = *returns_early = false;
    *last_time = model->t;
    if (model->phase != RUNNING)
        return log_error(model, "steps are allowed only after initialization");
    if (!(h > 0.0) || fabs(t - model->t) > 1e-9 * fmax(1.0, fabs(t)))
        return log_error_with_status(model, "a step must begin where the last one ended and be longer than 0", 0);
    const double end = t + h;
    const int status = model->has_ended ? 0 : integrate_instance(model, end);
    if (status)
        return log_error_with_status(model, "the motion cannot be followed", status);
    model->t = *last_time = end;
    model->outputs_outdated = 1;
    *terminate = model->has_ended;
    return fmi3OK;
}

#include "exchange.c"
#include "values.c"
#include "unsupported.c"
