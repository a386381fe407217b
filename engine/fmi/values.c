/* Get values: time, tolerance, parameters, outputs, states, rates, event indicators. */
FMI3_EXPORT fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference reference[], size_t n,
    fmi3Float64 value[], size_t n_values)
{
    Model *m = instance;
    if (n_values < n)
        return log_failure(m, "there are fewer values than variables", 0);
    for (size_t k = 0; k < n; k++) {
        const fmi3ValueReference r = reference[k];
        if (r == VR_TIME) {
            value[k] = m->t;
        } else if (r == VR_RTOL) {
            value[k] = m->rtol;
        } else if (r >= VR_PARAMETERS && r < VR_PARAMETERS + FMU_SLOTS_USED) {
            const int i = (int)(r - VR_PARAMETERS);
            value[k] = m->begun ? m->p[i] : m->is_given[i] ? m->given[i] : fmu_defaults[i];
        } else if (r >= VR_OUTPUTS && r < VR_OUTPUTS + FMU_OUTPUTS) {
            if (!m->begun && begin_run(m)) /* in initialization mode: outputs at the start */
                return fmi3Error;
            const int status = evaluate_outputs(m);
            if (status)
                return log_failure(m, "a constraint row depends on others", status);
            value[k] = value_of(m, fmu_outputs[r - VR_OUTPUTS][0], fmu_outputs[r - VR_OUTPUTS][1]);
#if FMU_EXCHANGE
        } else if (r >= VR_STATES && r < VR_STATES + N_Y) {
            if (!m->begun && begin_run(m))
                return fmi3Error;
            if (!m->exchange)
                convert_state(m);
            value[k] = m->x[r - VR_STATES];
        } else if ((r >= VR_RATES && r < VR_RATES + N_Y)
            || (r >= VR_INDICATORS && r < VR_INDICATORS + N_INDICATORS)) {
            double dx[N_Y];
            RhsOutputs rhs;
            if (!m->begun && begin_run(m))
                return fmi3Error;
            if (!m->exchange)
                convert_state(m);
            const int status = exchange_rates(m, dx, &rhs);
            if (status)
                return log_failure(m, "a constraint row depends on others", status);
            value[k] = r < VR_INDICATORS ? dx[r - VR_RATES] : indicator_of(m, &rhs, (int)(r - VR_INDICATORS));
#endif
        } else {
            return log_failure(m, "a variable that there is not", (int)r);
        }
    }
    return fmi3OK;
}

/* Set parameters or the tolerance, before initialization ends. */
FMI3_EXPORT fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference reference[], size_t n,
    const fmi3Float64 value[], size_t n_values)
{
    Model *m = instance;
    if (n_values < n)
        return log_failure(m, "there are fewer values than variables", 0);
    for (size_t k = 0; k < n; k++) {
        const fmi3ValueReference r = reference[k];
        const int slot = r >= VR_PARAMETERS && r < VR_PARAMETERS + FMU_SLOTS_USED ? (int)(r - VR_PARAMETERS) : -1;
        const char *name = r == VR_RTOL ? "relative_tolerance" : slot >= 0 ? fmu_slots[slot].address : NULL;
        char text[400];
        if (!name || (slot >= 0 && fmu_slots[slot].chosen))
            return log_failure(m, "a variable that there is not, or that is not set", (int)r);
        if (m->phase == RUNNING) { /* parameters are fixed during a run */
            snprintf(text, sizeof text, "%s is fixed: it is set before initialization ends", name);
            return log_error(m, text);
        }
        if (slot < 0 ? !(value[k] >= 1e-14 && value[k] < 1.0) : !isfinite(value[k])) {
            snprintf(text, sizeof text, "%s is %g: expected %s", name, value[k],
                slot < 0 ? ">= 1e-14 and < 1" : "a finite number");
            return log_error(m, text);
        }
        if (slot < 0) {
            m->rtol = value[k];
            m->rtol_given = 1;
        } else {
            m->given[slot] = value[k];
            m->is_given[slot] = value[k] != fmu_defaults[slot]; /* dependent defaults remain dependent */
        }
        m->begun = 0;
    }
    return fmi3OK;
}

/* Copy the state of an instance; its structs contain no pointers to themselves. */
FMI3_EXPORT fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *state)
{
    const Model *m = instance;
    if (!*state)
        *state = malloc(sizeof(Model) + sizeof(double));
    Model *copy = *state;
    if (!copy)
        return log_failure(m, "there is no memory", 0);
    *copy = *m;
    copy->run = NULL;
    if (m->run) {
        copy->run = malloc(m->size);
        if (!copy->run)
            return log_failure(m, "there is no memory", 0);
        memcpy(copy->run, m->run, m->size);
    }
    return fmi3OK;
}

/* Restore a copied state. */
FMI3_EXPORT fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state)
{
    Model *m = instance;
    const Model *copy = state;
    void *run = m->run;
    if (copy->run && !run)
        run = malloc(copy->size);
    if (copy->run && !run)
        return log_failure(m, "there is no memory", 0);
    const Model present = *m;
    *m = *copy;
    m->name = present.name;
    m->environment = present.environment;
    m->log_message = present.log_message;
    m->run = run;
    if (copy->run)
        memcpy(run, copy->run, copy->size);
    return fmi3OK;
}

/* Free a copied state. */
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

/* Get the number of bytes of a serialized state; it is valid for the same library only. */
FMI3_EXPORT fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState state, size_t *size)
{
    const Model *copy = state;
    (void)instance;
    *size = sizeof(Model) + (copy->run ? copy->size : 0);
    return fmi3OK;
}

/* Serialize a copied state. */
FMI3_EXPORT fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState state, uint8_t bytes[], size_t n)
{
    const Model *copy = state;
    size_t size = 0;
    fmi3SerializedFMUStateSize(instance, state, &size);
    if (n < size)
        return log_failure(instance, "there are fewer bytes than a state has", 0);
    memcpy(bytes, copy, sizeof(Model));
    if (copy->run)
        memcpy(bytes + sizeof(Model), copy->run, copy->size);
    return fmi3OK;
}

/* Restore a copied state from its bytes. */
FMI3_EXPORT fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const uint8_t bytes[], size_t n,
    fmi3FMUState *state)
{
    Model *copy = n < sizeof(Model) ? NULL : malloc(sizeof(Model));
    *state = NULL;
    if (!copy)
        return log_failure(instance, "these are not the bytes of a state", 0);
    memcpy(copy, bytes, sizeof(Model));
    if (copy->run) { /* the address is invalid; it shows only that a run existed */
        copy->run = n == sizeof(Model) + copy->size ? malloc(copy->size) : NULL;
        if (!copy->run) {
            free(copy);
            return log_failure(instance, "these are not the bytes of a state", 0);
        }
        memcpy(copy->run, bytes + sizeof(Model), copy->size);
    }
    *state = copy;
    return fmi3OK;
}
