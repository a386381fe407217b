/* Checks of the parameters of an FMU instance: conditions of the mechanism file, finite values, clearances. */

/* Return whether `value relation bound` is true, for a relation "<", "<=", ">" or ">=". */
static int is_relation_satisfied(const char *relation, double value, double bound)
{
    if (relation[1] == '=' && value == bound)
        return 1;
    return relation[0] == '<' ? value < bound : value > bound;
}

/*
 * Write " with parameters.c = -0.0001 m" for a value that depends on given parameters into `text` of `size` bytes, else
 * an empty text. value_index: index of the value. Parameters that no longer fit are omitted.
 */
static void format_given_values(const Model *model, int value_index, char *text, size_t size)
{
    const char *before = " with ";
    text[0] = 0;
    for (int k = 0; fmu_slots[value_index].follows && k < FMU_SLOTS_USED; k++)
        if (model->is_given[k] && !strncmp(fmu_slots[k].address, "parameters.", 11) && strlen(text) + 100 < size) {
            const size_t n = strlen(text);
            snprintf(text + n, size - n, "%s%s = %.6g%s%s", before, fmu_slots[k].address, model->p[k],
                fmu_slots[k].unit[0] ? " " : "", fmu_slots[k].unit);
            before = ", ";
        }
}

/*
 * Return whether all parameters of an instance are valid; otherwise log an error about the first invalid one and return
 * 0. Checked are the conditions of fmu.h, that all numbers are finite, and that clearances exceed rounding. size: the
 * mechanism's size, m.
 */
static int are_parameters_valid(const Model *model, double size)
{
    char text[600], given_values[250];
    for (int k = 0; k < FMU_CONDITIONS; k++) {
        const int value_index = fmu_conditions[k].slot;
        double bound = fmu_conditions[k].bound;
        for (int i = 0; i < fmu_conditions[k].count; i++)
            bound += model->p[fmu_bounds[fmu_conditions[k].first + i]];
        if (!isfinite(model->p[value_index]) || !isfinite(bound)
            || is_relation_satisfied(fmu_conditions[k].relation, model->p[value_index], bound))
            continue;
        format_given_values(model, value_index, given_values, sizeof given_values);
        const char *unit = fmu_slots[value_index].unit;
        int n = snprintf(text, sizeof text, "%s is %.6g%s%s%s: %s", fmu_slots[value_index].address,
            model->p[value_index], unit[0] ? " " : "", unit, given_values, fmu_conditions[k].message);
        if (fmu_conditions[k].count && n > 0 && (size_t)n < sizeof text)
            snprintf(text + n, sizeof text - (size_t)n, ", here %s %.6g", fmu_conditions[k].relation, bound);
        return log_error(model, text), 0;
    }
    for (int k = 0; k < FMU_NUMBERS && FMU_SLOTS_USED; k++) {
        if (isfinite(model->p[k]))
            continue;
        if (k < FMU_SLOTS_USED) {
            format_given_values(model, k, given_values, sizeof given_values);
            snprintf(text, sizeof text, "%s is %g%s: not finite", fmu_slots[k].address, model->p[k], given_values);
        } else {
            snprintf(text, sizeof text, "a number of the equations that follows from these parameters is %g",
                model->p[k]);
        }
        return log_error(model, text), 0;
    }
    for (int k = 0; k < FMU_PLAYS; k++)
        if (model->p[fmu_plays[k]] < FMU_LEAST_CLEARANCE * size) {
            snprintf(text, sizeof text, "the clearance of %s is %g m, below the rounding of doubles at the "
                "mechanism's size (%.3g m); expected %.2g m at least", fmu_joints[k], model->p[fmu_plays[k]],
                size, FMU_LEAST_CLEARANCE * size);
            return log_error(model, text), 0;
        }
    return 1;
}
