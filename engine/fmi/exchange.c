/*
 * Model exchange: the importer integrates the state of the engine's loops, tree coordinates (or those of all bodies),
 * velocities and works. Contacts begin and end as events, with penetrations as event indicators. Closed loops are
 * projected as an event when they have drifted.
 */
#if FMU_EXCHANGE
#define MAX_DRIFT 1e-11 /* of the mechanism's size or 1 rad: drift at which closures are projected */

/*
 * Change the branches of switching functions with the opposite sign: those whose branches meet, or `all`. Returns
 * whether any changed.
 */
static int update_branches(Model *m, const RhsOutputs *rhs, int all)
{
    int some = 0;
    for (int k = 0; k < N_SWITCHES; k++)
        if ((all || meets[k]) && m->discrete.branch[k] * rhs->g[k] < 0.0) {
            m->discrete.branch[k] = -m->discrete.branch[k];
            some = 1;
        }
    return some;
}

/*
 * Compute rates dx and contacts at the present state. Between events, contacts and branches of expressions are frozen,
 * so that the importer integrates a smooth function. Branches of contact laws meet and follow the state, because a slip
 * near a switching point would cause repeated events. Returns a status.
 */
static int exchange_rates(Model *m, double *dx, RhsOutputs *rhs)
{
    int status = 0, changed = 1;
    for (int pass = 0; pass < 6 && changed && !status; pass++) {
        DiscreteState now = m->discrete;
        status = motion(m->t, m->x, &now, (const Parameters *)m->p, dx, rhs);
        changed = now.held && update_branches(m, rhs, 0);
    }
    return status;
}

/*
 * Raise the nominals: to the largest velocity of a kind, of works to the kinetic energy. Returns whether any is larger
 * now.
 */
static int note_nominals(Model *m)
{
    double mass[N_Q], all[N_S], energy = 0.0;
    int more = 0;
    mass_matrix((const Parameters *)m->p, mass);
    to_absolute(m->t, m->x, &m->discrete, (const Parameters *)m->p, all);
    for (int k = 0; k < N_Q; k++)
        energy += 0.5 * mass[k] * all[N_Q + k] * all[N_Q + k];
    for (int k = N_X; k < N_Y; k++) {
        double most = m->nominal[k];
        for (int i = 0; i < N_X && k < 2 * N_X; i++)
            if (fmu_is_angle[i] == fmu_is_angle[k - N_X])
                most = fmax(most, fabs(m->x[N_X + i]));
        most = k < 2 * N_X ? most : fmax(most, energy);
        more |= most > m->nominal[k];
        m->nominal[k] = most;
    }
    return more;
}

/*
 * Set the nominals at the start, as in methods/begin.c: of coordinates the smallest length or angle that matters
 * (`least`); of velocities 1 % of the speed that covers it in the time scale of the start. Returns a status.
 */
static int nominals_at_start(Model *m, const double *least)
{
    double dx[N_Y], mass[N_Q], rate = 0.0, energy = 0.0;
    RhsOutputs rhs;
    const int status = exchange_rates(m, dx, &rhs);
    for (int k = 0; k < N_X && !status; k++) {
        const double way = least[fmu_is_angle[k]];
        rate = fmax(rate, fmax(fabs(dx[k]) / way, sqrt(fabs(dx[N_X + k]) / way)));
    }
    rate = rate * (m->t_end - m->t) > 1e-3 ? 0.01 * rate : 1.0 / fmax(m->t_end - m->t, 1e-100);
    mass_matrix((const Parameters *)m->p, mass);
    for (int k = 0; k < N_Q; k++)
        energy += 0.5 * mass[k] * least[k % 3 == 2] * rate * least[k % 3 == 2] * rate;
    for (int k = 0; k < N_Y; k++) {
        const double way = k < 2 * N_X ? least[fmu_is_angle[k % N_X]] : 0.0;
        m->nominal[k] = k < N_X ? way : k < 2 * N_X ? way * rate : energy;
    }
    note_nominals(m);
    return status;
}

/* Read the discrete state from that of the sample. */
static void read_contacts(Model *m) { read_discrete_state(m->latched, &m->discrete); }

/* Convert the integrated state to absolute coordinates in model exchange, and the other way in co-simulation. */
static void convert_state(Model *m)
{
    if (m->exchange) {
        to_absolute(m->t, m->x, &m->discrete, (const Parameters *)m->p, m->y);
    } else {
        read_contacts(m);
        from_absolute(m->t, m->y, &m->discrete, (const Parameters *)m->p, m->x);
    }
}

/*
 * Return the drift of the closures, relative to the mechanism's size; with `moves` the state is projected onto them.
 * -1: a closure depends on others.
 */
static double drift_of_closures(Model *m, int moves)
{
    double most = 0.0;
    for (int pass = 0; pass < (moves ? 3 : 1) && N_LOOPS > 0; pass++) {
        double dq[N_X], dv[N_X], worst;
        DiscreteState now = m->discrete;
        if (closing_of_state(m->t, m->x, &now, (const Parameters *)m->p, dq, dv, &worst))
            return -1.0;
        for (int k = 0; k < N_X; k++) {
            most = fmax(most, fabs(dq[k]) / (fmu_is_angle[k] ? 1.0 : m->extent));
            if (moves) {
                m->x[k] -= dq[k];
                m->x[N_X + k] -= dv[k];
            }
        }
    }
    return most;
}

/* Return event indicator k: a penetration, or a switching function; its branch if it is not in use. */
static double indicator_of(const Model *m, const RhsOutputs *rhs, int k)
{
    if (k < N_CLEARANCES)
        return rhs->clearance[k].delta;
    const int corner = fmu_jumps[k - N_CLEARANCES];
    return isnan(rhs->g[corner]) ? m->discrete.branch[corner] : rhs->g[corner];
}

/* Replace switching functions that are exactly zero by their values a moment later. Returns a status. */
static int resolve_zero_branches(Model *m, const double *dx, RhsOutputs *rhs)
{
    int status = 0, some = 0;
    double x[N_Y], scrap[N_Y];
    const double t = m->t, moment = 1e-9 * fmax(1e-3, fabs(t));
    RhsOutputs later;
    for (int k = 0; k < N_SWITCHES; k++)
        some |= rhs->g[k] == 0.0;
    if (!some)
        return 0;
    memcpy(x, m->x, sizeof x);
    for (int k = 0; k < 2 * N_X; k++)
        m->x[k] += moment * dx[k];
    m->t = t + moment;
    status = exchange_rates(m, scrap, &later);
    memcpy(m->x, x, sizeof x);
    m->t = t;
    for (int k = 0; k < N_SWITCHES && !status; k++)
        if (rhs->g[k] == 0.0)
            rhs->g[k] = later.g[k];
    return status;
}

/* Update contacts and branches at an event, including branches that change as a consequence. Returns a status. */
static int update_modes(Model *m)
{
    double dx[N_Y];
    RhsOutputs rhs;
    int status = exchange_rates(m, dx, &rhs), changed = 1;
    for (int i = 0; i < N_CLEARANCES && !status; i++) {
        const Clearance *joint = &rhs.clearance[i];
        const int touches = !isnan(m->latched[i]);
        /* at exactly zero the rate decides */
        const int within = joint->delta > 0.0 || (joint->delta == 0.0 && joint->deltadot >= 0.0);
        if (touches == within)
            continue;
        const double least = min_approach_speed((const Parameters *)m->p, i);
        m->latched[i] = within ? fmax(joint->deltadot, least) : NAN;
        m->state[i] = within ? CODE_IMPACT : CODE_FREE; /* an impact ends at a completed step */
    }
    if (!status)
        status = resolve_zero_branches(m, dx, &rhs);
    for (int k = 0; k < N_SWITCHES && !status; k++)
        m->discrete.branch[k] = rhs.g[k] < 0.0 ? -1.0 : 1.0;
    read_contacts(m);
    m->discrete.held = 1;
    for (int pass = 0; pass < 6 && changed && !status; pass++) {
        status = exchange_rates(m, dx, &rhs);
        changed = !status && update_branches(m, &rhs, 1);
    }
    return status;
}

/* Enter event mode (FMI 3); no action is needed. */
FMI3_EXPORT fmi3Status fmi3EnterEventMode(fmi3Instance instance) { return (void)instance, fmi3OK; }
/* Enter continuous-time mode (FMI 3); no action is needed. */
FMI3_EXPORT fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance instance) { return (void)instance, fmi3OK; }

/* Update contacts and branches, and project the closures, at an event. */
FMI3_EXPORT fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *again, fmi3Boolean *terminate,
    fmi3Boolean *nominals, fmi3Boolean *values, fmi3Boolean *timed, fmi3Float64 *next)
{
    Model *m = instance;
    const int status = update_modes(m); /* before the projection, which may move a located indicator back across zero */
    const double open = drift_of_closures(m, 1);
    *again = *terminate = *timed = false;
    *nominals = !status && note_nominals(m);
    *next = INFINITY;
    *values = open != 0.0;
    m->moved = 1;
    return status ? log_failure(m, "the motion cannot be followed", status) : fmi3OK;
}

/* End impacts whose penetration decreases, and request an event if closures have drifted. */
FMI3_EXPORT fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance, fmi3Boolean no_return, fmi3Boolean *event,
    fmi3Boolean *terminate)
{
    Model *m = instance;
    double dx[N_Y];
    RhsOutputs rhs;
    (void)no_return;
    if (N_CLEARANCES && !exchange_rates(m, dx, &rhs))
        for (int i = 0; i < N_CLEARANCES; i++)
            if (m->state[i] == CODE_IMPACT && rhs.clearance[i].deltadot <= 0.0)
                m->state[i] = CODE_CONTACT;
    *event = drift_of_closures(m, 0) > MAX_DRIFT;
    *terminate = false;
    return fmi3OK;
}

/* Set the time, s. */
FMI3_EXPORT fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64 t)
{
    Model *m = instance;
    m->t = t;
    m->moved = 1;
    return fmi3OK;
}

/* Return an error if n is not the expected number of values. */
static fmi3Status check_count(const Model *m, size_t n, size_t expected)
{
    return n == expected ? fmi3OK : log_failure(m, "another number of values than there are", (int)n);
}

/* Set the integrated state, N_Y values. */
FMI3_EXPORT fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 x[], size_t n)
{
    Model *m = instance;
    if (check_count(m, n, N_Y))
        return fmi3Error;
    memcpy(m->x, x, sizeof m->x);
    m->moved = 1;
    return fmi3OK;
}

/* Copy one number of each state to `value`. */
static fmi3Status copy_state_values(const Model *m, const double *source, fmi3Float64 value[], size_t n)
{
    if (check_count(m, n, N_Y))
        return fmi3Error;
    memcpy(value, source, N_Y * sizeof *source);
    return fmi3OK;
}

/* Get the integrated state, N_Y values. */
FMI3_EXPORT fmi3Status fmi3GetContinuousStates(fmi3Instance instance, fmi3Float64 x[], size_t n)
{
    return copy_state_values(instance, ((const Model *)instance)->x, x, n);
}

/* Get the rates of the state; fmi3Discard if they are undefined, so that the importer takes a shorter step. */
FMI3_EXPORT fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance instance, fmi3Float64 dx[], size_t n)
{
    Model *m = instance;
    RhsOutputs rhs;
    if (check_count(m, n, N_Y))
        return fmi3Error;
    if (exchange_rates(m, dx, &rhs))
        return fmi3Discard;
    for (int k = 0; k < N_Y; k++)
        if (!isfinite(dx[k]))
            return fmi3Discard;
    return fmi3OK;
}

/* Get the event indicators. */
FMI3_EXPORT fmi3Status fmi3GetEventIndicators(fmi3Instance instance, fmi3Float64 z[], size_t n)
{
    Model *m = instance;
    double dx[N_Y];
    RhsOutputs rhs;
    if (check_count(m, n, N_INDICATORS))
        return fmi3Error;
    if (N_INDICATORS && exchange_rates(m, dx, &rhs))
        return fmi3Discard;
    for (int k = 0; k < N_INDICATORS; k++)
        z[k] = indicator_of(m, &rhs, k);
    return fmi3OK;
}

/* Get the nominals of the states. */
FMI3_EXPORT fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance instance, fmi3Float64 nominal[], size_t n)
{
    return copy_state_values(instance, ((const Model *)instance)->nominal, nominal, n);
}

/* Get the number of states, N_Y. */
FMI3_EXPORT fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance instance, size_t *n)
{
    return (void)instance, *n = N_Y, fmi3OK;
}

/* Get the number of event indicators. */
FMI3_EXPORT fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance instance, size_t *n)
{
    return (void)instance, *n = N_INDICATORS, fmi3OK;
}

#include "slopes.c"
#else
FMI3_NONE(fmi3EnterEventMode) FMI3_NONE(fmi3UpdateDiscreteStates) FMI3_NONE(fmi3EnterContinuousTimeMode)
FMI3_NONE(fmi3CompletedIntegratorStep) FMI3_NONE(fmi3SetTime) FMI3_NONE(fmi3SetContinuousStates)
FMI3_NONE(fmi3GetContinuousStateDerivatives) FMI3_NONE(fmi3GetEventIndicators) FMI3_NONE(fmi3GetContinuousStates)
FMI3_NONE(fmi3GetNominalsOfContinuousStates) FMI3_NONE(fmi3GetNumberOfEventIndicators)
FMI3_NONE(fmi3GetNumberOfContinuousStates) FMI3_NONE(fmi3GetDirectionalDerivative)
#endif
