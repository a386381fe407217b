/*
 * Numbers that a scene does not take, as runtime/model/parameters.py refuses them: bounds of the file's numbers, what
 * is not finite, clearances that doubles do not tell from none.
 */
static int holds(const char *relation, double value, double bound)
{
    if (relation[1] == '=' && value == bound)
        return 1;
    return relation[0] == '<' ? value < bound : value > bound;
}

/* " with parameters.c = -0.0001 m", of a number that follows others: those that were given. */
static void said_with(const Model *m, int slot, char *text, size_t size)
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

static int allowed(const Model *m, double size)
{
    char text[600], with[250];
    for (int k = 0; k < FMU_CONDITIONS; k++) {
        const int slot = fmu_conditions[k].slot;
        double bound = fmu_conditions[k].bound;
        for (int i = 0; i < fmu_conditions[k].count; i++)
            bound += m->p[fmu_bounds[fmu_conditions[k].first + i]];
        if (!isfinite(m->p[slot]) || !isfinite(bound) || holds(fmu_conditions[k].relation, m->p[slot], bound))
            continue;
        said_with(m, slot, with, sizeof with);
        int n = snprintf(text, sizeof text, "%s is %.6g%s%s%s: %s", fmu_slots[slot].address, m->p[slot],
            fmu_slots[slot].unit[0] ? " " : "", fmu_slots[slot].unit, with, fmu_conditions[k].message);
        if (fmu_conditions[k].count && n > 0 && (size_t)n < sizeof text)
            snprintf(text + n, sizeof text - (size_t)n, ", here %s %.6g", fmu_conditions[k].relation, bound);
        return refuses(m, text), 0;
    }
    for (int k = 0; k < FMU_NUMBERS && FMU_SLOTS_USED; k++) {
        if (isfinite(m->p[k]))
            continue;
        if (k < FMU_SLOTS_USED) {
            said_with(m, k, with, sizeof with);
            snprintf(text, sizeof text, "%s is %g%s: not finite", fmu_slots[k].address, m->p[k], with);
        } else {
            snprintf(text, sizeof text, "a number of the equations that follows from these parameters is %g", m->p[k]);
        }
        return refuses(m, text), 0;
    }
    for (int k = 0; k < FMU_PLAYS; k++)
        if (m->p[fmu_plays[k]] < FMU_LEAST_CLEARANCE * size) {
            snprintf(text, sizeof text, "the clearance of %s is %g m, below what doubles tell apart at the "
                "mechanism's size (%.3g m); expected %.2g m at least", fmu_joints[k], m->p[fmu_plays[k]], size,
                FMU_LEAST_CLEARANCE * size);
            return refuses(m, text), 0;
        }
    return 1;
}
