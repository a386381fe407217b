/* An instance of the FMU: its parameters and start, the engine's steps to a time, and the outputs at a state. */
enum {
    SLICE = 4000,
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
    double given[FMU_SLOTS], p[FMU_NUMBERS], motion[FMU_NUMBERS];
    unsigned char is_given[FMU_SLOTS];
    double t, t_end, rtol;
    int phase, rtol_given; /* phase of the enum; whether the tolerance was set as a parameter */
    double y[N_S], latched[FMU_AT_LEAST(N_DISCRETE)], a[FMU_AT_LEAST(N_Q)];
    signed char state[FMU_AT_LEAST(N_CLEARANCES)];
    int moved, begun, ended; /* outputs are not up to date; the run has begun; an event has ended it */
    Outputs out;
#if FMU_EXCHANGE
    int exchange; /* whether the importer integrates */
    double x[N_Y], nominal[N_Y], extent;
    DiscreteState discrete;
#endif
    size_t size;
    void *run;
} Model;

/* Log a message with the instance's name. Returns fmi3Error. */
static fmi3Status log_error(const Model *m, const char *what)
{
    char text[700];
    snprintf(text, sizeof text, "%s: %s", m->name, what);
    if (m->log_message)
        m->log_message(m->environment, fmi3Error, "logStatusError", text);
    return fmi3Error;
}

/* Log a message with the time and, if `status` is one of the engine, its reason. Returns fmi3Error. */
static fmi3Status log_failure(const Model *m, const char *what, int status)
{
    char text[600];
    const char *why = status == OUTSIDE ? ": a journal or corner is deeper in its wall than its law is good for"
        : status == LOST ? ": a free journal or corner lies outside its walls"
        : status == CHATTERING ? ": contacts, frictions or corners change without end"
        : status == STALLED || status == TOO_SMALL ? ": no step is small enough"
        : status == NOT_FINITE || status == UNBOUNDED ? ": it is no longer finite"
        : status == FRICTION_INCONSISTENT ? ": friction jams a contact" : "";
    if (status)
        snprintf(text, sizeof text, "%s at t = %.9g s%s (status %d)", what, m->t, why, status);
    else
        snprintf(text, sizeof text, "%s at t = %.9g s", what, m->t);
    return log_error(m, text);
}

#include "conditions.c"
#if INTEGRATES
/* Integrate to time t, which ends a step. Returns a status. */
static int advance_to(Model *m, double t);
#endif
#if FMU_EXCHANGE
static int nominals_at_start(Model *m, const double *least);
#endif

/* Compute the parameters and the start, and begin the run there. */
static fmi3Status begin_run(Model *m)
{
    double residual = 0.0, size = 0.0, *q = m->y, *v = m->y + N_Q;
    unsigned char projected[FMU_SLOTS];
    double still[FMU_SLOTS];
    gudgeon_prepare(m->given, m->is_given, m->p);
    for (int k = 0; k < FMU_SIZES; k++) {
        const double x = m->p[fmu_sizes[k][0]], y = fmu_sizes[k][1] < 0 ? 0.0 : m->p[fmu_sizes[k][1]];
        size = fmax(size, sqrt(x * x + y * y)); /* the same bits as in sizes.py */
    }
    size = size > 0.0 ? size : 1.0;
    if (!are_parameters_valid(m, size))
        return fmi3Error;
    memcpy(projected, m->is_given, sizeof projected);
    memcpy(still, m->given, sizeof still);
    for (int k = 0; k < FMU_GAINS; k++) {
        projected[fmu_gains[k]] = 1;
        still[fmu_gains[k]] = 0.0;
    }
    gudgeon_prepare(still, projected, m->motion);
    memset(m->y, 0, sizeof m->y);
    if (gudgeon_start(m->t, m->p, size, q, v, &residual)) { /* continue from the start with the file's parameters */
        int some = 0;
        memcpy(m->y, fmu_start, sizeof fmu_start);
        for (int k = 0; k < FMU_SLOTS; k++)
            some |= m->is_given[k];
        if (some && gudgeon_continuation(m->t, m->p, size, q, v))
            return log_failure(m, "the linkage does not close with these parameters", 0);
    }
    for (int k = 0; k < N_DISCRETE; k++)
        m->latched[k] = NAN;
    free(m->run);
#if INTEGRATES
    double least[2], scale[2 * N_X], length = INFINITY;
    m->size = gudgeon_run_size();
    m->run = calloc(1, m->size);
    if (!m->run)
        return log_failure(m, "there is no memory", 0);
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
    double y[N_S], latched[FMU_AT_LEAST(N_DISCRETE)];
    memcpy(y, m->y, sizeof y);
    memcpy(latched, m->latched, sizeof latched);
    /* first the contacts and modes of friction at the start, then the run itself */
    for (int start = 1; start >= 0; start--) {
        gudgeon_run_start(m->run, m->motion, m->t, y, latched);
        gudgeon_run_stop(m->run, !start);
        gudgeon_adaptive_setup(m->run, gudgeon_method(fine ? FMU_BEGINS_FINE : FMU_BEGINS),
            FMU_AUTOMATIC ? gudgeon_method(fine ? FMU_STIFF_FINE : FMU_STIFF) : 0, scale, least, 0.0);
        const int status = start ? advance_to(m, m->t) : 0;
        if (status)
            return log_failure(m, "the motion cannot begin", status);
    }
    m->ended = 0;
#if FMU_EXCHANGE
    m->extent = size;
    memset(&m->discrete, 0, sizeof m->discrete);
    read_discrete_state(m->latched, &m->discrete);
    from_absolute(m->t, m->y, &m->discrete, (const Parameters *)m->p, m->x);
    const int odd = nominals_at_start(m, least);
    if (odd)
        return log_failure(m, "the motion cannot begin", odd);
#endif
#else
    m->size = gudgeon_kinematic_size();
    m->run = calloc(1, m->size);
    if (!m->run)
        return log_failure(m, "there is no memory", 0);
    gudgeon_kinematic_begin(m->run, FMU_REACH, size, m->t_end, NULL, NULL, INFINITY);
#endif
    m->begun = 1;
    m->moved = 1;
    return fmi3OK;
}

#if INTEGRATES
/* Empty the lists of contacts and events of a run: an FMU reports neither. */
static void discard_lists(void *run)
{
    double numbers[N_IMPACT_COLUMNS], t, y[N_S], latched[FMU_AT_LEAST(N_DISCRETE)];
    signed char state[FMU_AT_LEAST(N_CLEARANCES)];
    int number;
    while (gudgeon_run_impacts(run, 0, 1, numbers, &number)
        || gudgeon_run_events(run, 1, &t, &number, y, latched, state))
        continue;
}

/* To t, a step ends there. */
static int advance_to(Model *m, double t)
{
    long done = 0;
    int status = 0;
    while (!status && done < 1) {
        status = gudgeon_adaptive_run(m->run, m->motion, 1, &t, SLICE, m->y, m->latched, m->state, &done);
        if (status == EVENTS_FULL) {
            discard_lists(m->run);
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
/* Follow the kinematic motion and its works to time t. Returns a status. */
static int advance_to(Model *m, double t)
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

#if FMU_EXCHANGE
static void convert_state(Model *m);
#endif

/* Evaluate all outputs at the present state, unless they are up to date. Returns a status. */
static int evaluate_outputs(Model *m)
{
    long failed = 0;
    Outputs *o = &m->out;
    const double t = FMU_BEYOND ? m->t + fmax(32.0 * 2.220446049250313e-16 * fabs(m->t), 1e-100) : m->t;
    if (!m->moved)
        return 0;
    m->moved = 0;
#if FMU_EXCHANGE
    convert_state(m);
#endif
    return gudgeon_evaluate(1, &t, m->y, m->y + N_Q, m->latched, m->p, o->a, o->multipliers, o->reactions, o->torques,
        o->clearance, o->series, o->friction, o->energy, o->power, o->drift, &failed);
}

/* Return an output: column of a part of the results; part < 0: contact codes. */
static double value_of(const Model *m, int part, int column)
{
    const Outputs *o = &m->out;
    const double *const parts[] = {m->y, m->y + N_Q, m->y + 2 * N_Q, m->latched, o->a, o->multipliers, o->reactions,
        o->torques, o->clearance, o->series, o->friction, o->energy, o->power, o->drift};
    return part < 0 ? m->state[column] : parts[part][column];
}
