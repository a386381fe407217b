/* Return whether `value relation bound` is true. */
static int is_satisfied(const char *relation, double value, double bound)
{
    if (relation[1] == '=' && value == bound)
        return 1;
    return relation[0] == '<' ? value < bound : value > bound;
}

/* Write " with parameters.c = -0.0001 m" for a value that depends on given parameters, else an empty text. */
static void format_given_values(const Model *m, int slot, char *text, size_t size)
{
    const char *before = " with ";
    text[0] = 0;
    for (int k = 0; fmu_slots[slot].follows && k < FMU_SLOTS_USED; k++)
        if (m->is_given[k] && !strncmp(fmu_slots[k].address, "parameters.", 11) && strlen(text) + 100 < size) {
            const size_t n = strlen(text);
            snprintf(text + n, size - n, "%s%s = %.6g%s%s", before, fmu_slots[k].address, m->p[k],
                fmu_slots[k].unit[0] ? " " : "", fmu_slots[k].unit);
            before = ", ";
        }
}

/* Return whether all parameters are valid; otherwise log a message. size: the mechanism's size, m. */
static int are_parameters_valid(const Model *m, double size)
{
    char text[600], with[250];
    for (int k = 0; k < FMU_CONDITIONS; k++) {
        const int slot = fmu_conditions[k].slot;
        double bound = fmu_conditions[k].bound;
        for (int i = 0; i < fmu_conditions[k].count; i++)
            bound += m->p[fmu_bounds[fmu_conditions[k].first + i]];
        if (!isfinite(m->p[slot]) || !isfinite(bound) || is_satisfied(fmu_conditions[k].relation, m->p[slot], bound))
            continue;
        format_given_values(m, slot, with, sizeof with);
        int n = snprintf(text, sizeof text, "%s is %.6g%s%s%s: %s", fmu_slots[slot].address, m->p[slot],
            fmu_slots[slot].unit[0] ? " " : "", fmu_slots[slot].unit, with, fmu_conditions[k].message);
        if (fmu_conditions[k].count && n > 0 && (size_t)n < sizeof text)
            snprintf(text + n, sizeof text - (size_t)n, ", here %s %.6g", fmu_conditions[k].relation, bound);
        return log_error(m, text), 0;
    }
    for (int k = 0; k < FMU_NUMBERS && FMU_SLOTS_USED; k++) {
        if (isfinite(m->p[k]))
            continue;
        if (k < FMU_SLOTS_USED) {
            format_given_values(m, k, with, sizeof with);
            snprintf(text, sizeof text, "%s is %g%s: not finite", fmu_slots[k].address, m->p[k], with);
        } else {
            snprintf(text, sizeof text, "a number of the equations that follows from these parameters is %g", m->p[k]);
        }
        return log_error(m, text), 0;
    }
    for (int k = 0; k < FMU_PLAYS; k++)
        if (m->p[fmu_plays[k]] < FMU_LEAST_CLEARANCE * size) {
            snprintf(text, sizeof text, "the clearance of %s is %g m, below what doubles tell apart at the "
                "mechanism's size (%.3g m); expected %.2g m at least", fmu_joints[k], m->p[fmu_plays[k]], size,
                FMU_LEAST_CLEARANCE * size);
            return log_error(m, text), 0;
        }
    return 1;
}
