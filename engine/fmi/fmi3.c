/*
 * A scene as an FMU for co-simulation: FMI 3's functions over the calls of scene/calls.h. "fmu.h" beside it is written
 * with the scene: its numbers, its start, and where each output is. The time loops are the engine's own; a
 * communication point ends a step.
 */
#include "model.h"
#include "engine/scene/calls.h"
#include "fmi3.h"
#include "fmu.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { VR_TIME = 0, VR_RTOL = 1, VR_PARAMETERS = 16, VR_OUTPUTS = 1 << 20, SLICE = 4000 };
#define TIME_CONSTANT 1e3 /* s: an end that nobody has said */

typedef struct {
    double a[FMU_AT_LEAST(N_Q)], multipliers[FMU_AT_LEAST(N_ROWS)], reactions[FMU_AT_LEAST(3 * N_JOINTS)],
        torques[FMU_AT_LEAST(N_DRIVES)], clearance[FMU_AT_LEAST(10 * N_CLEARANCES)],
        series[FMU_AT_LEAST(N_SERIES)], friction[FMU_AT_LEAST(2 * N_FRICTIONS)], energy[2], power[3], drift[2];
} Followed;

typedef struct {
    char *name;
    fmi3InstanceEnvironment environment;
    fmi3LogMessageCallback tell;
    double given[FMU_SLOTS], p[FMU_NUMBERS], motion[FMU_NUMBERS];
    unsigned char is_given[FMU_SLOTS];
    double t, t_end, rtol;
    double y[N_S], latched[FMU_AT_LEAST(N_MEMORY)], a[FMU_AT_LEAST(N_Q)];
    signed char state[FMU_AT_LEAST(N_CLEARANCES)];
    int moved, begun, ended; /* whether outputs are of another state; the run has begun; an event has ended it */
    Followed out;
    size_t size;
    void *run;
} Model;

static fmi3Status fails(const Model *m, const char *what, int status)
{
    char text[300];
    snprintf(text, sizeof text, "%s: %s at t = %.9g s (status %d)", m->name, what, m->t, status);
    if (m->tell)
        m->tell(m->environment, fmi3Error, "logStatusError", text);
    return fmi3Error;
}

/* Numbers of the run, the start that closes the linkage, and a run that begins there. */
static fmi3Status begin(Model *m)
{
    double residual = 0.0, size = 0.0, *q = m->y, *v = m->y + N_Q;
    unsigned char projected[FMU_SLOTS];
    double still[FMU_SLOTS];
    gudgeon_prepare(m->given, m->is_given, m->p);
    memcpy(projected, m->is_given, sizeof projected);
    memcpy(still, m->given, sizeof still);
    for (int k = 0; k < FMU_GAINS; k++) {
        projected[fmu_gains[k]] = 1;
        still[fmu_gains[k]] = 0.0;
    }
    gudgeon_prepare(still, projected, m->motion);
    for (int k = 0; k < FMU_SIZES; k++)
        size = fmax(size, fabs(m->p[fmu_sizes[k]]));
    size = size > 0.0 ? size : 1.0;
    memset(m->y, 0, sizeof m->y);
    if (gudgeon_start(m->t, m->p, size, q, v, &residual)) { /* from where it closes with the file's numbers */
        int some = 0;
        memcpy(m->y, fmu_start, sizeof fmu_start);
        for (int k = 0; k < FMU_SLOTS; k++)
            some |= m->is_given[k];
        if (some && gudgeon_follow(m->t, m->p, size, q, v))
            return fails(m, "the linkage does not close with these parameters", 0);
    }
    for (int k = 0; k < N_MEMORY; k++)
        m->latched[k] = NAN;
    free(m->run);
#if INTEGRATES
    double least[2], scale[2 * N_X], length = INFINITY;
    m->size = gudgeon_run_size();
    m->run = calloc(1, m->size);
    if (!m->run)
        return fails(m, "there is no memory", 0);
    for (int k = 0; k < FMU_PLAYS; k++)
        if (m->p[fmu_plays[k]] > 0.0)
            length = fmin(length, m->p[fmu_plays[k]]);
    length = isfinite(length) ? length : size;
    least[0] = length, least[1] = length / size;
    for (int k = 0; k < N_X; k++) {
        scale[k] = m->rtol * (fmu_is_angle[k] ? least[1] : length);
        scale[N_X + k] = FMU_FILM ? fmin(m->rtol, FMU_FELT * least[1]) : m->rtol;
    }
    const int fine = m->rtol < FMU_FINE;
    gudgeon_run_start(m->run, m->motion, m->t, m->y, m->latched);
    gudgeon_run_stop(m->run, 1);
    gudgeon_adaptive_setup(m->run, gudgeon_method(fine ? FMU_BEGINS_FINE : FMU_BEGINS),
        FMU_AUTOMATIC ? gudgeon_method(fine ? FMU_STIFF_FINE : FMU_STIFF) : 0, scale, least, 0.0);
#else
    m->size = gudgeon_course_size();
    m->run = calloc(1, m->size);
    if (!m->run)
        return fails(m, "there is no memory", 0);
    gudgeon_course_begin(m->run, FMU_REACH, size, m->t_end, NULL, NULL, INFINITY);
#endif
    m->begun = 1;
    m->moved = 1;
    return fmi3OK;
}

#if INTEGRATES
/* To t, a step ends there. */
static int advance(Model *m, double t)
{
    long done = 0;
    int status = 0;
    while (!status && done < 1) {
        status = gudgeon_adaptive_run(m->run, m->motion, 1, &t, SLICE, m->y, m->latched, m->state, &done);
        if (status == EVENTS_FULL) {
            const size_t rows = 256 * (size_t)(N_S + FMU_AT_LEAST(N_MEMORY) + 8);
            double *room = malloc(rows * sizeof(double)); /* contacts and events so far: nobody asks for them here */
            if (!room)
                return EVENTS_FULL;
            gudgeon_run_impacts(m->run, 0, room, (int *)(room + 256 * 5));
            gudgeon_run_events(m->run, room, (int *)(room + 256), room + 512, room + 512 + 256 * N_S,
                (signed char *)(room + 512 + 256 * (N_S + FMU_AT_LEAST(N_MEMORY))));
            free(room);
            status = 0;
        }
    }
    if (status == ENDED) {
        gudgeon_run_sample(m->run, m->motion, m->y, m->latched, m->state);
        m->ended = 1;
        status = 0;
    }
    return status;
}
#else
static int advance(Model *m, double t)
{
    double rows[2] = {m->t, t}, q[2 * N_Q], v[2 * N_Q], a[2 * N_Q], work[2 * N_WORK], phi[2] = {0.0, 0.0};
    long steps = 0, done = 0;
    memcpy(q, m->y, N_Q * sizeof(double));
    memcpy(v, m->y + N_Q, N_Q * sizeof(double));
    memcpy(a, m->a, N_Q * sizeof(double));
    memcpy(work, m->y + 2 * N_Q, N_WORK * sizeof(double));
    int status = gudgeon_kinematic(m->run, 1, rows, m->p, q, v, a, phi, phi + 1, &steps, &done);
    if (!status)
        status = gudgeon_kinematic_works(m->run, 1, rows, m->p, q, v, work, &done);
    if (!status) {
        memcpy(m->y, q + N_Q, N_Q * sizeof(double));
        memcpy(m->y + N_Q, v + N_Q, N_Q * sizeof(double));
        memcpy(m->a, a + N_Q, N_Q * sizeof(double));
        memcpy(m->y + 2 * N_Q, work + N_WORK, N_WORK * sizeof(double));
    }
    return status;
}
#endif

/* Everything that follows from the state. */
static int follow(Model *m)
{
    long failed = 0;
    Followed *o = &m->out;
    const double t = FMU_BEYOND ? m->t + fmax(32.0 * 2.220446049250313e-16 * fabs(m->t), 1e-100) : m->t;
    if (!m->moved)
        return 0;
    m->moved = 0;
    return gudgeon_evaluate(1, &t, m->y, m->y + N_Q, m->latched, m->p, o->a, o->multipliers, o->reactions, o->torques,
        o->clearance, o->series, o->friction, o->energy, o->power, o->drift, &failed);
}

static double value_of(const Model *m, int part, int column)
{
    const Followed *o = &m->out;
    const double *const parts[] = {m->y, m->y + N_Q, m->y + 2 * N_Q, m->latched, o->a, o->multipliers, o->reactions,
        o->torques, o->clearance, o->series, o->friction, o->energy, o->power, o->drift};
    return part < 0 ? m->state[column] : parts[part][column];
}

FMI3_EXPORT const char *fmi3GetVersion(void) { return "3.0"; }

FMI3_EXPORT fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean on, size_t n, const fmi3String names[])
{
    return (void)instance, (void)on, (void)n, (void)names, fmi3OK;
}

FMI3_EXPORT fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources,
    fmi3Boolean visible, fmi3Boolean logs, fmi3Boolean has_event_mode, fmi3Boolean returns_early,
    const fmi3ValueReference required[], size_t n, fmi3InstanceEnvironment environment, fmi3LogMessageCallback tell,
    fmi3IntermediateUpdateCallback update)
{
    (void)resources, (void)visible, (void)logs, (void)has_event_mode, (void)returns_early, (void)required, (void)n;
    (void)update;
    if (!token || strcmp(token, FMU_TOKEN)) {
        if (tell)
            tell(environment, fmi3Error, "logStatusError", "the token is that of another model");
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
    m->tell = tell;
    m->rtol = FMU_RTOL;
    m->t_end = TIME_CONSTANT;
    return m;
}

FMI3_EXPORT fmi3Instance fmi3InstantiateModelExchange(fmi3String name) { return (void)name, NULL; }
FMI3_EXPORT fmi3Instance fmi3InstantiateScheduledExecution(fmi3String name) { return (void)name, NULL; }

FMI3_EXPORT void fmi3FreeInstance(fmi3Instance instance)
{
    Model *m = instance;
    if (!m)
        return;
    free(m->run);
    free(m->name);
    free(m);
}

FMI3_EXPORT fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean has_tolerance,
    fmi3Float64 tolerance, fmi3Float64 start, fmi3Boolean has_stop, fmi3Float64 stop)
{
    Model *m = instance;
    m->t = start;
    m->t_end = has_stop ? stop : start + TIME_CONSTANT;
    if (has_tolerance && tolerance > 0.0 && tolerance < 1.0)
        m->rtol = fmax(tolerance, 1e-14);
    return fmi3OK;
}

FMI3_EXPORT fmi3Status fmi3ExitInitializationMode(fmi3Instance instance)
{
    Model *m = instance;
    return m->begun ? fmi3OK : begin(m);
}

FMI3_EXPORT fmi3Status fmi3Terminate(fmi3Instance instance) { return (void)instance, fmi3OK; }

FMI3_EXPORT fmi3Status fmi3Reset(fmi3Instance instance)
{
    Model *m = instance;
    memset(m->is_given, 0, sizeof m->is_given);
    m->rtol = FMU_RTOL;
    m->begun = m->ended = 0;
    m->t = 0.0;
    return fmi3OK;
}

FMI3_EXPORT fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 t, fmi3Float64 h, fmi3Boolean no_return,
    fmi3Boolean *event_needed, fmi3Boolean *terminate, fmi3Boolean *early, fmi3Float64 *last)
{
    Model *m = instance;
    (void)no_return;
    *event_needed = *terminate = *early = false;
    *last = m->t;
    if (!(h > 0.0) || fabs(t - m->t) > 1e-9 * fmax(1.0, fabs(t)))
        return fails(m, "a step begins where the last one ended, and is longer than 0", 0);
    const double end = t + h;
    const int status = m->ended ? 0 : advance(m, end);
    if (status)
        return fails(m, "the motion cannot be followed", status);
    m->t = *last = end;
    m->moved = 1;
    *terminate = m->ended;
    return fmi3OK;
}

#include "values.c"
#include "none.c"
