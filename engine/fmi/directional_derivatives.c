/* Directional derivatives of rates and outputs of an FMU by its states (FMI 3). */

/*
 * Compute directional derivatives with respect to states: of rates by the exact Jacobian, of outputs by central
 * differences (FMI 3). Return an error if knowns are not states, or unknowns neither rates nor, in model exchange,
 * outputs.
 */
FMI3_EXPORT fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
    size_t n_unknowns, const fmi3ValueReference knowns[], size_t n_knowns, const fmi3Float64 seed[], size_t n_seed,
    fmi3Float64 sensitivity[], size_t n_sensitivity)
{
    Model *model = instance;
    double J[N_Y * N_Y], f_t[N_Y], direction[N_Y] = {0.0}, x[N_Y];
    int rates = 0;
    if (n_seed < n_knowns || n_sensitivity < n_unknowns)
        return log_error_with_status(model, "there are fewer values than variables", 0);
    for (size_t k = 0; k < n_knowns; k++) {
        if (knowns[k] < VR_STATES || knowns[k] >= VR_STATES + N_Y)
            return log_error_with_status(model, "derivatives are with respect to states only", (int)knowns[k]);
        direction[knowns[k] - VR_STATES] += seed[k];
    }
    if (!model->exchange)
        synchronize_states(model);
    for (size_t k = 0; k < n_unknowns; k++)
        rates |= unknowns[k] >= VR_RATES && unknowns[k] < VR_RATES + N_Y;
    const double *p = TREE ? model->motion : model->p; /* rates in tree coordinates have no Baumgarte terms */
    if (rates && gudgeon_jacobian(model->t, model->x, model->sampled_discrete, p, J, f_t))
        return log_error_with_status(model, "a constraint equation depends on others", 0);
    for (size_t k = 0; k < n_unknowns; k++) {
        const fmi3ValueReference reference = unknowns[k];
        sensitivity[k] = 0.0;
        if (reference >= VR_RATES && reference < VR_RATES + N_Y) {
            for (int j = 0; j < N_Y; j++)
                sensitivity[k] += J[(size_t)(reference - VR_RATES) * N_Y + j] * direction[j];
            continue;
        }
        if (!model->exchange || reference < VR_OUTPUTS || reference >= VR_OUTPUTS + FMU_OUTPUTS)
            return log_error_with_status(
                model, "derivatives are those of rates and of exchanged outputs only", (int)reference);
        double largest_ratio = 0.0, end_values[2];
        /* outputs are linear in works, which need no small step */
        for (int j = 0; j < N_Y && (j < 2 * N_X || largest_ratio == 0.0); j++)
            largest_ratio = fmax(largest_ratio, fabs(direction[j]) / model->nominal[j]);
        if (largest_ratio == 0.0)
            continue;
        memcpy(x, model->x, sizeof x);
        for (int end = 0; end < 2; end++) {
            const double h = (end ? 1e-5 : -1e-5) / largest_ratio;
            for (int j = 0; j < N_Y; j++)
                model->x[j] = x[j] + h * direction[j];
            model->outputs_outdated = 1;
            const int status = evaluate_outputs(model);
            memcpy(model->x, x, sizeof x);
            model->outputs_outdated = 1;
            if (status)
                return log_error_with_status(model, "a constraint equation depends on others", status);
            const int *const output = fmu_outputs[reference - VR_OUTPUTS];
            end_values[end] = get_output(model, output[0], output[1]);
        }
        sensitivity[k] = (end_values[1] - end_values[0]) * largest_ratio / 2e-5;
    }
    return fmi3OK;
}
