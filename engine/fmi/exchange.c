/*
 * FMI model exchange, in which the importing program integrates the state: coordinates, velocities, works of forces.
 * Contacts begin and end as events, with penetrations as event indicators. Closed loops are projected as an event when
 * they have drifted.
 */
#if FMU_EXCHANGE
#define MAX_DRIFT 1e-11 /* of the mechanism's size or 1 rad: drift at which closures are projected */

/*
 * Reverse the branches of switching functions whose values have the opposite sign: of those that are continuous at
 * their switching point (`is_continuous_switch`), or of all (`includes_all`). Return whether any changed.
 */
static int flip_violated_branches(Model *model, const RhsOutputs *rhs, int includes_all)
{
    int has_changed = 0;
    for (int k = 0; k < N_SWITCHES; k++)
        if ((includes_all || is_continuous_switch[k]) && model->discrete.branch[k] * rhs->g[k] < 0.0) {
            model->discrete.branch[k] = -model->discrete.branch[k];
            has_changed = 1;
        }
    return has_changed;
}

/*
 * Compute the rates dx and outputs rhs at the current state of an instance. Return 0 or a status. Between events,
 * contacts and branches of expressions are frozen, so that the importer integrates a smooth function.
 *
 * Branches of contact laws, which are continuous at their switching point, follow the state in up to six passes, and
 * stay changed. A slip near a switching point would otherwise cause repeated events.
 */
static int evaluate_exchange_rates(Model *model, double *dx, RhsOutputs *rhs)
{
    int status = 0, changed = 1;
    for (int pass = 0; pass < 6 && changed && !status; pass++) {
        DiscreteState discrete_state = model->discrete;
        status = compute_motion_rates(model->t, model->x, &discrete_state, (const Parameters *)model->p, dx, rhs);
        changed = discrete_state.is_frozen && flip_violated_branches(model, rhs, 0);
    }
    return status;
}

/*
 * Raise the nominal of each velocity to the largest current speed of its kind (length or angle), and those of works and
 * internal states to the kinetic energy, J. Nominals are never lowered. Return whether any was raised.
 */
static int raise_nominals(Model *model)
{
    double mass[N_Q], absolute_state[N_S], energy = 0.0;
    int is_raised = 0;
    mass_matrix((const Parameters *)model->p, mass);
    convert_integrated_to_absolute(model->t, model->x, &model->discrete, (const Parameters *)model->p, absolute_state);
    for (int k = 0; k < N_Q; k++)
        energy += 0.5 * mass[k] * absolute_state[N_Q + k] * absolute_state[N_Q + k];
    for (int k = N_X; k < N_Y; k++) {
        double nominal = model->nominal[k];
        for (int i = 0; i < N_X && k < 2 * N_X; i++)
            if (fmu_is_angle[i] == fmu_is_angle[k - N_X])
                nominal = fmax(nominal, fabs(model->x[N_X + i]));
        nominal = k < 2 * N_X ? nominal : fmax(nominal, energy);
        is_raised |= nominal > model->nominal[k];
        model->nominal[k] = nominal;
    }
    return is_raised;
}

/*
 * Set the nominals of all states at the start, as in methods/begin.c. Return 0 or the status of the rates. min_scale:
 * smallest relevant length (m) and angle, the nominals of coordinates. Those of velocities are 1 % of the speed that
 * covers it in the time scale of the start, or in the time left if the start is at rest. Those of works are the energy
 * at these speeds. All are then raised by raise_nominals().
 */
static int set_initial_nominals(Model *model, const double *min_scale)
{
    double dx[N_Y], mass[N_Q], rate = 0.0, energy = 0.0;
    RhsOutputs rhs;
    const int status = evaluate_exchange_rates(model, dx, &rhs);
    for (int k = 0; k < N_X && !status; k++) {
        const double scale = min_scale[fmu_is_angle[k]];
        rate = fmax(rate, fmax(fabs(dx[k]) / scale, sqrt(fabs(dx[N_X + k]) / scale)));
    }
    rate = rate * (model->t_end - model->t) > 1e-3 ? 0.01 * rate : 1.0 / fmax(model->t_end - model->t, 1e-100);
    mass_matrix((const Parameters *)model->p, mass);
    for (int k = 0; k < N_Q; k++)
        energy += 0.5 * mass[k] * min_scale[k % 3 == 2] * rate * min_scale[k % 3 == 2] * rate;
    for (int k = 0; k < N_Y; k++) {
        const double scale = k < 2 * N_X ? min_scale[fmu_is_angle[k % N_X]] : 0.0;
        model->nominal[k] = k < N_X ? scale : k < 2 * N_X ? scale * rate : energy;
    }
    raise_nominals(model);
    return status;
}

/* Set the discrete state of an instance (model->discrete) from the one of its last sample (model->sampled_discrete). */
static void set_discrete_state_from_sample(Model *model)
{
    read_discrete_state(model->sampled_discrete, &model->discrete);
}

/*
 * Convert the state of an instance: in model exchange from the integrated state x to the absolute state y, in
 * co-simulation from y to x. In co-simulation the discrete state of the last sample is read first.
 */
static void synchronize_states(Model *model)
{
    if (model->exchange) {
        convert_integrated_to_absolute(model->t, model->x, &model->discrete, (const Parameters *)model->p, model->y);
    } else {
        set_discrete_state_from_sample(model);
        convert_absolute_to_integrated(model->t, model->y, &model->discrete, (const Parameters *)model->p, model->x);
    }
}

/*
 * Return the largest position drift of the closures: the correction that closes them, in rad or relative to the
 * mechanism's size. Return 0 without closures; -1 if a closure depends on others. With is_projected, positions and
 * velocities are also projected onto the closures, in three passes.
 */
static double compute_closure_drift(Model *model, int is_projected)
{
    double drift = 0.0;
    for (int pass = 0; pass < (is_projected ? 3 : 1) && N_LOOPS > 0; pass++) {
        double dq[N_X], dv[N_X], residual;
        DiscreteState discrete_state = model->discrete;
        if (compute_correction(model->t, model->x, &discrete_state, (const Parameters *)model->p, dq, dv, &residual))
            return -1.0;
        for (int k = 0; k < N_X; k++) {
            drift = fmax(drift, fabs(dq[k]) / (fmu_is_angle[k] ? 1.0 : model->extent));
            if (is_projected) {
                model->x[k] -= dq[k];
                model->x[N_X + k] -= dv[k];
            }
        }
    }
    return drift;
}

/*
 * Return event indicator k of model exchange: a penetration (m), or the value of a switching function with a jump; its
 * branch if it is not in use (NaN). rhs: outputs of the right-hand side at the current state.
 */
static double get_event_indicator(const Model *model, const RhsOutputs *rhs, int k)
{
    if (k < N_CLEARANCES)
        return rhs->clearance[k].delta;
    const int switch_index = fmu_jumps[k - N_CLEARANCES];
    return isnan(rhs->g[switch_index]) ? model->discrete.branch[switch_index] : rhs->g[switch_index];
}

/*
 * Replace the values of switching functions that are exactly zero in rhs by their values 1e-9 of the time later (at
 * least 1e-12 s). Return 0 or a status. dx: rates of the current state, along which the state is extrapolated. The
 * state and time of the instance are restored.
 */
static int resolve_zero_switching_functions(Model *model, const double *dx, RhsOutputs *rhs)
{
    int status = 0, has_zero = 0;
    double x[N_Y], unused_rates[N_Y];
    const double t = model->t, time_offset = 1e-9 * fmax(1e-3, fabs(t));
    RhsOutputs later;
    for (int k = 0; k < N_SWITCHES; k++)
        has_zero |= rhs->g[k] == 0.0;
    if (!has_zero)
        return 0;
    memcpy(x, model->x, sizeof x);
    for (int k = 0; k < 2 * N_X; k++)
        model->x[k] += time_offset * dx[k];
    model->t = t + time_offset;
    status = evaluate_exchange_rates(model, unused_rates, &later);
    memcpy(model->x, x, sizeof x);
    model->t = t;
    for (int k = 0; k < N_SWITCHES && !status; k++)
        if (rhs->g[k] == 0.0)
            rhs->g[k] = later.g[k];
    return status;
}

/*
 * Compute the new discrete states of an instance at an event (event update of FMI): contacts once, then branches.
 * Return 0 or a status.
 *
 * A contact is closed where the penetration is positive, or zero and not decreasing; its approach speed is stored at an
 * onset. The contact code becomes CODE_IMPACT or CODE_FREE. Branches that change as a consequence are updated in up to
 * six passes (event iteration). Contacts and branches are then frozen.
 */
static int update_contacts_and_branches(Model *model)
{
    double dx[N_Y];
    RhsOutputs rhs;
    int status = evaluate_exchange_rates(model, dx, &rhs), changed = 1;
    for (int i = 0; i < N_CLEARANCES && !status; i++) {
        const Clearance *joint = &rhs.clearance[i];
        const int was_touching = !isnan(model->sampled_discrete[i]);
        /* at exactly zero the rate decides */
        const int is_touching = joint->delta > 0.0 || (joint->delta == 0.0 && joint->deltadot >= 0.0);
        if (was_touching == is_touching)
            continue;
        const double min_speed = min_approach_speed((const Parameters *)model->p, i);
        model->sampled_discrete[i] = is_touching ? fmax(joint->deltadot, min_speed) : NAN;
        model->contact_codes[i] = is_touching ? CODE_IMPACT : CODE_FREE; /* an impact ends at a completed step */
    }
    if (!status)
        status = resolve_zero_switching_functions(model, dx, &rhs);
    for (int k = 0; k < N_SWITCHES && !status; k++)
        model->discrete.branch[k] = rhs.g[k] < 0.0 ? -1.0 : 1.0;
    set_discrete_state_from_sample(model);
    model->discrete.is_frozen = 1;
    for (int pass = 0; pass < 6 && changed && !status; pass++) {
        status = evaluate_exchange_rates(model, dx, &rhs);
        changed = !status && flip_violated_branches(model, &rhs, 1);
    }
    return status;
}

/* Enter event mode (FMI 3); no action is needed. */
FMI3_EXPORT fmi3Status fmi3EnterEventMode(fmi3Instance instance) { return (void)instance, fmi3OK; }
/* Enter continuous-time mode (FMI 3); no action is needed. */
FMI3_EXPORT fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance instance) { return (void)instance, fmi3OK; }

/*
 * Update contacts and branches, and project the closures, at an event (FMI 3). Return fmi3OK, or an error if the
 * right-hand side cannot be evaluated. No further update, end or time event is requested. values_changed: whether the
 * projection changed states; nominals_changed: whether nominals were raised.
 */
FMI3_EXPORT fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *needs_update,
    fmi3Boolean *terminate, fmi3Boolean *nominals_changed, fmi3Boolean *values_changed,
    fmi3Boolean *has_next_event_time, fmi3Float64 *next_event_time)
{
    Model *model = instance;
    /* before the projection, which may move a located indicator back across zero */
    const int status = update_contacts_and_branches(model);
    const double drift = compute_closure_drift(model, 1);
    *needs_update = *terminate = *has_next_event_time = false;
    *nominals_changed = !status && raise_nominals(model);
    *next_event_time = INFINITY;
    *values_changed = drift != 0.0;
    model->outputs_outdated = 1;
    return status ? log_error_with_status(model, "the motion cannot be followed", status) : fmi3OK;
}

/*
 * Mark contacts whose penetration no longer grows as past compression, after a step of the importer (FMI 3). Request
 * event mode if the closures have drifted by more than MAX_DRIFT. Always return fmi3OK.
 */
FMI3_EXPORT fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance, fmi3Boolean cannot_return,
    fmi3Boolean *enters_event_mode, fmi3Boolean *terminate)
{
    Model *model = instance;
    double dx[N_Y];
    RhsOutputs rhs;
    (void)cannot_return;
    if (N_CLEARANCES && !evaluate_exchange_rates(model, dx, &rhs))
        for (int i = 0; i < N_CLEARANCES; i++)
            if (model->contact_codes[i] == CODE_IMPACT && rhs.clearance[i].deltadot <= 0.0)
                model->contact_codes[i] = CODE_CONTACT;
    *enters_event_mode = compute_closure_drift(model, 0) > MAX_DRIFT;
    *terminate = false;
    return fmi3OK;
}

/* Set the time of an instance, s (FMI 3). Outputs are evaluated again when needed. */
FMI3_EXPORT fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64 t)
{
    Model *model = instance;
    model->t = t;
    model->outputs_outdated = 1;
    return fmi3OK;
}

/* Return fmi3OK if n is the expected number of values; otherwise log an error and return fmi3Error. */
static fmi3Status check_value_count(const Model *model, size_t n, size_t expected)
{
    char text[100];
    if (n == expected)
        return fmi3OK;
    snprintf(text, sizeof text, "%zu values were given, expected %zu", n, expected);
    return log_error(model, text);
}

/* Set the integrated state x, n = N_Y values (FMI 3). Outputs are evaluated again when needed. */
FMI3_EXPORT fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 x[], size_t n)
{
    Model *model = instance;
    if (check_value_count(model, n, N_Y))
        return fmi3Error;
    memcpy(model->x, x, sizeof model->x);
    model->outputs_outdated = 1;
    return fmi3OK;
}

/*
 * Copy one number of each state (N_Y) from `source` to `value`. If n is another number, log an error and return
 * fmi3Error.
 */
static fmi3Status copy_state_values(const Model *model, const double *source, fmi3Float64 value[], size_t n)
{
    if (check_value_count(model, n, N_Y))
        return fmi3Error;
    memcpy(value, source, N_Y * sizeof *source);
    return fmi3OK;
}

/* Get the integrated state x, n = N_Y values (FMI 3). */
FMI3_EXPORT fmi3Status fmi3GetContinuousStates(fmi3Instance instance, fmi3Float64 x[], size_t n)
{
    return copy_state_values(instance, ((const Model *)instance)->x, x, n);
}

/*
 * Get the rates dx of the state, n = N_Y values (FMI 3). Return fmi3Discard if they are undefined or not finite, so
 * that the importer takes a shorter step; fmi3Error if n is wrong.
 */
FMI3_EXPORT fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance instance, fmi3Float64 dx[], size_t n)
{
    Model *model = instance;
    RhsOutputs rhs;
    if (check_value_count(model, n, N_Y))
        return fmi3Error;
    if (evaluate_exchange_rates(model, dx, &rhs))
        return fmi3Discard;
    for (int k = 0; k < N_Y; k++)
        if (!isfinite(dx[k]))
            return fmi3Discard;
    return fmi3OK;
}

/*
 * Get the event indicators z, n = N_INDICATORS values (FMI 3): penetrations, then switching functions with a jump.
 * Return fmi3Discard if the right-hand side cannot be evaluated.
 */
FMI3_EXPORT fmi3Status fmi3GetEventIndicators(fmi3Instance instance, fmi3Float64 z[], size_t n)
{
    Model *model = instance;
    double dx[N_Y];
    RhsOutputs rhs;
    if (check_value_count(model, n, N_INDICATORS))
        return fmi3Error;
    if (N_INDICATORS && evaluate_exchange_rates(model, dx, &rhs))
        return fmi3Discard;
    for (int k = 0; k < N_INDICATORS; k++)
        z[k] = get_event_indicator(model, &rhs, k);
    return fmi3OK;
}

/* Get the nominals of the states, n = N_Y values (FMI 3). */
FMI3_EXPORT fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance instance, fmi3Float64 nominal[], size_t n)
{
    return copy_state_values(instance, ((const Model *)instance)->nominal, nominal, n);
}

/* Get the number of continuous states, N_Y (FMI 3). */
FMI3_EXPORT fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance instance, size_t *n)
{
    return (void)instance, *n = N_Y, fmi3OK;
}

/* Get the number of event indicators, N_INDICATORS (FMI 3). */
FMI3_EXPORT fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance instance, size_t *n)
{
    return (void)instance, *n = N_INDICATORS, fmi3OK;
}

#include "directional_derivatives.c"
#else
FMI3_NONE(fmi3EnterEventMode) FMI3_NONE(fmi3UpdateDiscreteStates) FMI3_NONE(fmi3EnterContinuousTimeMode)
FMI3_NONE(fmi3CompletedIntegratorStep) FMI3_NONE(fmi3SetTime) FMI3_NONE(fmi3SetContinuousStates)
FMI3_NONE(fmi3GetContinuousStateDerivatives) FMI3_NONE(fmi3GetEventIndicators) FMI3_NONE(fmi3GetContinuousStates)
FMI3_NONE(fmi3GetNominalsOfContinuousStates) FMI3_NONE(fmi3GetNumberOfEventIndicators)
FMI3_NONE(fmi3GetNumberOfContinuousStates) FMI3_NONE(fmi3GetDirectionalDerivative)
#endif
