/* Checks of the parameters of an FMU instance: conditions of the mechanism file, finite values, clearances. */

/* Return whether `value relation bound` is true, for a relation "<", "<=", ">" or ">="; 0 if a number is NaN. */
static int is_relation_satisfied(const char *relation, double value, double bound)
{
    if (relation[1] == '=' && value == bound)
        return 1;
    return relation[0] == '<' ? value < bound : value > bound;
}

/*
 * Write " with parameters.c = -0.0001 m" into `text` of `size` bytes: all entries of the section `parameters` that the
 * importer has set, separated by ", ". The text is empty if the value number value_index depends on no parameter. The
 * listed parameters need not be those on which it depends. Parameters that no longer fit are omitted. Used in messages
 * about invalid values.
 */
static void format_set_parameters(const Model *model, int value_index, char *text, size_t size)
{
    const char *before = " with ";
    text[0] = 0;
    for (int k = 0; fmu_parameters[value_index].depends_on_parameters && k < FMU_N_PARAMETERS; k++)
        if (model->is_set[k] && !strncmp(fmu_parameters[k].address, "parameters.", 11) && strlen(text) + 100 < size) {
            const size_t n = strlen(text);
            snprintf(text + n, size - n, "%s%s = %.6g%s%s", before, fmu_parameters[k].address, model->p[k],
                fmu_parameters[k].unit[0] ? " " : "", fmu_parameters[k].unit);
            before = ", ";
        }
}

/*
 * Check all parameters of an instance. Return 1 if they are valid; otherwise log an error about the first invalid one
 * and return 0. Checked are the conditions of fmu.h, that all numbers are finite, and that clearances exceed
 * FMU_MIN_RELATIVE_CLEARANCE times the mechanism's size (`size`, m). Called when a run begins.
 */
static int validate_parameters(const Model *model, double size)
{
    char text[600], set_parameters[250];
    for (int k = 0; k < FMU_CONDITIONS; k++) {
        const int value_index = fmu_conditions[k].parameter;
        double bound = fmu_conditions[k].bound;
        for (int i = 0; i < fmu_conditions[k].count; i++)
            bound += model->p[fmu_bounds[fmu_conditions[k].first + i]];
        if (!isfinite(model->p[value_index]) || !isfinite(bound)
            || is_relation_satisfied(fmu_conditions[k].relation, model->p[value_index], bound))
            continue;
        format_set_parameters(model, value_index, set_parameters, sizeof set_parameters);
        const char *unit = fmu_parameters[value_index].unit;
        int n = snprintf(text, sizeof text, "%s is %.6g%s%s%s: %s", fmu_parameters[value_index].address,
            model->p[value_index], unit[0] ? " " : "", unit, set_parameters, fmu_conditions[k].message);
        if (fmu_conditions[k].count && n > 0 && (size_t)n < sizeof text)
            snprintf(text + n, sizeof text - (size_t)n, ", here %s %.6g", fmu_conditions[k].relation, bound);
        return log_error(model, text), 0;
    }
    for (int k = 0; k < FMU_VALUES && FMU_N_PARAMETERS; k++) {
        if (isfinite(model->p[k]))
            continue;
        if (k < FMU_N_PARAMETERS) {
            format_set_parameters(model, k, set_parameters, sizeof set_parameters);
            snprintf(text, sizeof text, "%s is %g%s: not finite", fmu_parameters[k].address, model->p[k],
                set_parameters);
        } else {
            snprintf(text, sizeof text, "a number of the equations that follows from these parameters is %g",
                model->p[k]);
        }
        return log_error(model, text), 0;
    }
    for (int k = 0; k < FMU_CLEARANCES; k++)
        if (model->p[fmu_clearances[k]] < FMU_MIN_RELATIVE_CLEARANCE * size) {
            snprintf(text, sizeof text, "the clearance of %s is %g m, below the rounding of doubles at the "
                "mechanism's size (%.3g m); expected %.2g m at least", fmu_joints[k], model->p[fmu_clearances[k]],
                size, FMU_MIN_RELATIVE_CLEARANCE * size);
            return log_error(model, text), 0;
        }
    return 1;
}
