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

/* Return the version of FMI. */
FMI3_EXPORT const char *fmi3GetVersion(void) { return "3.0"; }

/* Accept and ignore the settings of debug logging. */
FMI3_EXPORT fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean on, size_t n, const fmi3String names[])
{
    return (void)instance, (void)on, (void)n, (void)names, fmi3OK;
}

/* Create an instance with default settings. Returns NULL if the token is wrong or memory is exhausted. */
static Model *create_instance(fmi3String name, fmi3String token, fmi3InstanceEnvironment environment,
    fmi3LogMessageCallback log_message)
{
    if (!token || strcmp(token, FMU_TOKEN)) {
        if (log_message)
            log_message(environment, fmi3Error, "logStatusError", "the token is that of another model");
        return NULL;
    }
    Model *m = calloc(1, sizeof(Model));
    if (!m)
        return NULL;
    const size_t length = strlen(name ? name : "") + 1;
    m->name = malloc(length);
    if (!m->name) {
        free(m);
        return NULL;
    }
    memcpy(m->name, name ? name : "", length);
    m->environment = environment;
    m->log_message = log_message;
    m->rtol = FMU_RTOL;
    m->t_end = TIME_CONSTANT;
    return m;
}

/* Create an instance for co-simulation. */
FMI3_EXPORT fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources,
    fmi3Boolean visible, fmi3Boolean logs, fmi3Boolean has_event_mode, fmi3Boolean returns_early,
    const fmi3ValueReference required[], size_t n, fmi3InstanceEnvironment environment,
    fmi3LogMessageCallback log_message, fmi3IntermediateUpdateCallback update)
{
    (void)resources, (void)visible, (void)logs, (void)has_event_mode, (void)returns_early, (void)required, (void)n;
    (void)update;
    return create_instance(name, token, environment, log_message);
}

/* Create an instance for model exchange; NULL if the scene does not support it. */
FMI3_EXPORT fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources,
    fmi3Boolean visible, fmi3Boolean logs, fmi3InstanceEnvironment environment, fmi3LogMessageCallback log_message)
{
    (void)resources, (void)visible, (void)logs;
#if FMU_EXCHANGE
    Model *m = create_instance(name, token, environment, log_message);
    if (m)
        m->exchange = 1;
    return m;
#else
    return (void)name, (void)token, (void)environment, (void)log_message, NULL;
#endif
}

/* Return NULL: scheduled execution is not supported. */
FMI3_EXPORT fmi3Instance fmi3InstantiateScheduledExecution(fmi3String name) { return (void)name, NULL; }

/* Free an instance. */
FMI3_EXPORT void fmi3FreeInstance(fmi3Instance instance)
{
    Model *m = instance;
    if (!m)
        return;
    free(m->run);
    free(m->name);
    free(m);
}

/*
 * Enter initialization mode: set start and end times and the importer's tolerance, unless one was set as a parameter.
 */
FMI3_EXPORT fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean has_tolerance,
    fmi3Float64 tolerance, fmi3Float64 start, fmi3Boolean has_stop, fmi3Float64 stop)
{
    Model *m = instance;
    if (m->phase != SETTING)
        return log_error(m, "initialization mode is entered once, after instantiation or a reset");
    m->phase = INITIALIZING;
    m->begun = 0; /* outputs may have been requested before */
    m->t = start;
    m->t_end = has_stop ? stop : start + TIME_CONSTANT;
    if (has_tolerance && tolerance > 0.0 && tolerance < 1.0 && !m->rtol_given)
        m->rtol = fmax(tolerance, 1e-14);
    return fmi3OK;
}

/* Leave initialization mode and begin the run. */
FMI3_EXPORT fmi3Status fmi3ExitInitializationMode(fmi3Instance instance)
{
    Model *m = instance;
    if (m->phase != INITIALIZING)
        return log_error(m, "initialization mode was not entered");
    if (!m->begun && begin_run(m))
        return fmi3Error;
    m->phase = RUNNING;
    return fmi3OK;
}

/* Accept the end of a simulation. */
FMI3_EXPORT fmi3Status fmi3Terminate(fmi3Instance instance) { return (void)instance, fmi3OK; }

/* Reset an instance to its state after instantiation. */
FMI3_EXPORT fmi3Status fmi3Reset(fmi3Instance instance)
{
    Model *m = instance;
    memset(m->is_given, 0, sizeof m->is_given);
    m->rtol = FMU_RTOL;
    m->begun = m->ended = m->rtol_given = 0;
    m->phase = SETTING;
    m->t = 0.0;
    return fmi3OK;
}

/* Integrate to t + h, a communication point; t must be the present time. */
FMI3_EXPORT fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 t, fmi3Float64 h, fmi3Boolean no_return,
    fmi3Boolean *event_needed, fmi3Boolean *terminate, fmi3Boolean *early, fmi3Float64 *last)
{
    Model *m = instance;
    (void)no_return;
    *event_needed = *terminate = *early = false;
    *last = m->t;
    if (m->phase != RUNNING)
        return log_error(m, "a step is made after initialization");
    if (!(h > 0.0) || fabs(t - m->t) > 1e-9 * fmax(1.0, fabs(t)))
        return log_failure(m, "a step begins where the last one ended, and is longer than 0", 0);
    const double end = t + h;
    const int status = m->ended ? 0 : advance_to(m, end);
    if (status)
        return log_failure(m, "the motion cannot be followed", status);
    m->t = *last = end;
    m->moved = 1;
    *terminate = m->ended;
    return fmi3OK;
}

#include "exchange.c"
#include "values.c"
#include "none.c"
