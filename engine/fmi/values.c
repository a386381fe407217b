/* Values and states of an FMU instance: functions of FMI 3 that get, set, copy and serialize them. */

/*
 * Get the values of n variables: time, tolerance, parameters, outputs, states, rates, event indicators (FMI 3). In
 * initialization mode the run is begun first where outputs or states are requested. Return an error for an unknown
 * variable or an undefined output.
 */
FMI3_EXPORT fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference reference[], size_t n,
    fmi3Float64 value[], size_t n_values)
{
    Model *model = instance;
    if (n_values < n)
        return log_error_with_status(model, "there are fewer values than variables", 0);
    for (size_t k = 0; k < n; k++) {
        const fmi3ValueReference r = reference[k];
        if (r == VR_TIME) {
            value[k] = model->t;
        } else if (r == VR_RTOL) {
            value[k] = model->rtol;
        } else if (r >= VR_PARAMETERS && r < VR_PARAMETERS + FMU_N_PARAMETERS) {
            const int i = (int)(r - VR_PARAMETERS);
            value[k] = model->has_begun ? model->p[i] : model->is_set[i] ? model->set_values[i] : fmu_defaults[i];
        } else if (r >= VR_OUTPUTS && r < VR_OUTPUTS + FMU_OUTPUTS) {
            if (!model->has_begun && begin_instance_run(model)) /* in initialization mode: outputs at the start */
                return fmi3Error;
            const int status = evaluate_outputs(model);
            if (status)
                return log_error_with_status(model, "a constraint equation depends on others", status);
            value[k] = get_output(model, fmu_outputs[r - VR_OUTPUTS][0], fmu_outputs[r - VR_OUTPUTS][1]);
#if FMU_EXCHANGE
        } else if (r >= VR_STATES && r < VR_STATES + N_Y) {
            if (!model->has_begun && begin_instance_run(model))
                return fmi3Error;
            if (!model->exchange)
                synchronize_states(model);
            value[k] = model->x[r - VR_STATES];
        } else if ((r >= VR_RATES && r < VR_RATES + N_Y)
            || (r >= VR_INDICATORS && r < VR_INDICATORS + N_INDICATORS)) {
            double dx[N_Y];
            RhsOutputs rhs;
            if (!model->has_begun && begin_instance_run(model))
                return fmi3Error;
            if (!model->exchange)
                synchronize_states(model);
            const int status = evaluate_exchange_rates(model, dx, &rhs);
            if (status)
                return log_error_with_status(model, "a constraint equation depends on others", status);
            value[k] = r < VR_INDICATORS ? dx[r - VR_RATES]
                : get_event_indicator(model, &rhs, (int)(r - VR_INDICATORS));
#endif
        } else {
            return log_error_with_status(model, "unknown variable", (int)r);
        }
    }
    return fmi3OK;
}

/*
 * Set parameters or the tolerance before initialization ends (FMI 3). Return an error for other variables, for values
 * outside their range and during a run. A parameter set to its default counts as not set, so that defaults that depend
 * on other parameters are computed from them. A run that has begun must begin again.
 */
FMI3_EXPORT fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference reference[], size_t n,
    const fmi3Float64 value[], size_t n_values)
{
    Model *model = instance;
    if (n_values < n)
        return log_error_with_status(model, "there are fewer values than variables", 0);
    for (size_t k = 0; k < n; k++) {
        const fmi3ValueReference r = reference[k];
        const int parameter =
            r >= VR_PARAMETERS && r < VR_PARAMETERS + FMU_N_PARAMETERS ? (int)(r - VR_PARAMETERS) : -1;
        const char *name = r == VR_RTOL ? "relative_tolerance"
            : parameter >= 0 ? fmu_parameters[parameter].address : NULL;
        char text[400];
        if (!name || (parameter >= 0 && fmu_parameters[parameter].chosen))
            return log_error_with_status(model, "unknown variable, or one that cannot be set", (int)r);
        if (model->phase == RUNNING) { /* parameters are fixed during a run */
            snprintf(text, sizeof text, "%s is fixed: it is set before initialization ends", name);
            return log_error(model, text);
        }
        if (parameter < 0 ? !(value[k] >= 1e-14 && value[k] < 1.0) : !isfinite(value[k])) {
            snprintf(text, sizeof text, "%s is %g: expected %s", name, value[k],
                parameter < 0 ? ">= 1e-14 and < 1" : "a finite number");
            return log_error(model, text);
        }
        if (parameter < 0) {
            model->rtol = value[k];
            model->rtol_given = 1;
        } else {
            model->set_values[parameter] = value[k];
            model->is_set[parameter] = value[k] != fmu_defaults[parameter]; /* dependent defaults remain dependent */
        }
        model->has_begun = 0;
    }
    return fmi3OK;
}

/*
 * Copy an instance with the memory of its run into *state (FMI 3), which is allocated if it is NULL. The structs
 * contain no pointers to themselves. Return an error if memory is exhausted.
 */
FMI3_EXPORT fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *state)
{
    const Model *model = instance;
    if (!*state)
        *state = malloc(sizeof(Model) + sizeof(double));
    Model *copy = *state;
    if (!copy)
        return log_error_with_status(model, "out of memory", 0);
    *copy = *model;
    copy->run = NULL;
    if (model->run) {
        copy->run = malloc(model->size);
        if (!copy->run)
            return log_error_with_status(model, "out of memory", 0);
        memcpy(copy->run, model->run, model->size);
    }
    return fmi3OK;
}

/* Restore a copied state; name and callbacks of the instance remain (FMI 3). Return an error if memory is exhausted. */
FMI3_EXPORT fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state)
{
    Model *model = instance;
    const Model *copy = state;
    void *run = model->run;
    if (copy->run && !run)
        run = malloc(copy->size);
    if (copy->run && !run)
        return log_error_with_status(model, "out of memory", 0);
    const Model current = *model;
    *model = *copy;
    model->name = current.name;
    model->environment = current.environment;
    model->log_message = current.log_message;
    model->run = run;
    if (copy->run)
        memcpy(run, copy->run, copy->size);
    return fmi3OK;
}

/* Free a copied state with the memory of its run, and set *state to NULL (FMI 3). NULL is ignored. */
FMI3_EXPORT fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *state)
{
    (void)instance;
    if (state && *state) {
        free(((Model *)*state)->run);
        free(*state);
        *state = NULL;
    }
    return fmi3OK;
}

/* Get the number of bytes of a serialized state (FMI 3); it is valid for the same library only. */
FMI3_EXPORT fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState state, size_t *size)
{
    const Model *copy = state;
    (void)instance;
    *size = sizeof(Model) + (copy->run ? copy->size : 0);
    return fmi3OK;
}

/* Serialize a copied state into n bytes (FMI 3). Return an error if n is less than fmi3SerializedFMUStateSize(). */
FMI3_EXPORT fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState state, uint8_t bytes[], size_t n)
{
    const Model *copy = state;
    size_t size = 0;
    fmi3SerializedFMUStateSize(instance, state, &size);
    if (n < size)
        return log_error_with_status(instance, "the serialized state needs more bytes", 0);
    memcpy(bytes, copy, sizeof(Model));
    if (copy->run)
        memcpy(bytes + sizeof(Model), copy->run, copy->size);
    return fmi3OK;
}

/*
 * Restore a copied state from its n bytes, in newly allocated memory (FMI 3). Return an error, with *state = NULL, if
 * the number of bytes does not fit or memory is exhausted.
 */
FMI3_EXPORT fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const uint8_t bytes[], size_t n,
    fmi3FMUState *state)
{
    Model *copy = n < sizeof(Model) ? NULL : malloc(sizeof(Model));
    *state = NULL;
    if (!copy)
        return log_error_with_status(instance, "the bytes are not a serialized state of this FMU", 0);
    memcpy(copy, bytes, sizeof(Model));
    if (copy->run) { /* the address is invalid; it shows only that a run existed */
        copy->run = n == sizeof(Model) + copy->size ? malloc(copy->size) : NULL;
        if (!copy->run) {
            free(copy);
            return log_error_with_status(instance, "the bytes are not a serialized state of this FMU", 0);
        }
        memcpy(copy->run, bytes + sizeof(Model), copy->size);
    }
    *state = copy;
    return fmi3OK;
}
