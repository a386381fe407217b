/* Directional derivatives of FMI 3. */

/* Compute directional derivatives by states: of rates by the exact Jacobian, of outputs by central differences. */
FMI3_EXPORT fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
    size_t n_unknowns, const fmi3ValueReference knowns[], size_t n_knowns, const fmi3Float64 seed[], size_t n_seed,
    fmi3Float64 sensitivity[], size_t n_sensitivity)
{
    Model *m = instance;
    double J[N_Y * N_Y], f_t[N_Y], along[N_Y] = {0.0}, kept[N_Y];
    int rates = 0;
    if (n_seed < n_knowns || n_sensitivity < n_unknowns)
        return log_failure(m, "there are fewer values than variables", 0);
    for (size_t k = 0; k < n_knowns; k++) {
        if (knowns[k] < VR_STATES || knowns[k] >= VR_STATES + N_Y)
            return log_failure(m, "derivatives by states are what there is", (int)knowns[k]);
        along[knowns[k] - VR_STATES] += seed[k];
    }
    if (!m->exchange)
        convert_state(m);
    for (size_t k = 0; k < n_unknowns; k++)
        rates |= unknowns[k] >= VR_RATES && unknowns[k] < VR_RATES + N_Y;
    const double *p = TREE ? m->motion : m->p; /* rates in tree coordinates have no Baumgarte terms */
    if (rates && gudgeon_jacobian(m->t, m->x, m->latched, p, J, f_t))
        return log_failure(m, "a constraint row depends on others", 0);
    for (size_t k = 0; k < n_unknowns; k++) {
        const fmi3ValueReference r = unknowns[k];
        sensitivity[k] = 0.0;
        if (r >= VR_RATES && r < VR_RATES + N_Y) {
            for (int j = 0; j < N_Y; j++)
                sensitivity[k] += J[(size_t)(r - VR_RATES) * N_Y + j] * along[j];
            continue;
        }
        if (!m->exchange || r < VR_OUTPUTS || r >= VR_OUTPUTS + FMU_OUTPUTS)
            return log_failure(m, "derivatives of rates and outputs are what there is", (int)r);
        double most = 0.0, ends[2];
        /* outputs are linear in works, which need no small step */
        for (int j = 0; j < N_Y && (j < 2 * N_X || most == 0.0); j++)
            most = fmax(most, fabs(along[j]) / m->nominal[j]);
        if (most == 0.0)
            continue;
        memcpy(kept, m->x, sizeof kept);
        for (int branch = 0; branch < 2; branch++) {
            const double h = (branch ? 1e-5 : -1e-5) / most;
            for (int j = 0; j < N_Y; j++)
                m->x[j] = kept[j] + h * along[j];
            m->moved = 1;
            const int status = evaluate_outputs(m);
            memcpy(m->x, kept, sizeof kept);
            m->moved = 1;
            if (status)
                return log_failure(m, "a constraint row depends on others", status);
            ends[branch] = value_of(m, fmu_outputs[r - VR_OUTPUTS][0], fmu_outputs[r - VR_OUTPUTS][1]);
        }
        sensitivity[k] = (ends[1] - ends[0]) * most / 2e-5;
    }
    return fmi3OK;
}
