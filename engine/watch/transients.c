/* Rejection of steps that miss a pulse, a term of time alone that acts between the stages (time_terms.c). */
#if N_TRANSIENTS
#define MAX_DEFECT 30.0 /* of the tolerance: change of a step by a missed term that is accepted */

/* The step whose dense output is compared with the equations of motion. */
typedef struct {
    Integrator *run;
    Step *step;
    const Parameters *p;
} StepDefect;

/*
 * Return whether the right-hand side at a fraction of the step equals the rate of the dense output, within MAX_DEFECT
 * tolerances over the step: the step is accurate there. Callback of find_undersampled_term(); context: a StepDefect;
 * is_certain is not used. Return 0 if an evaluation fails, or if friction or a rigid contact may change its mode there.
 */
static int has_small_defect(void *context, double fraction, int is_certain)
{
    (void)is_certain;
    const StepDefect *defect = context;
    Integrator *run = defect->run;
    Step *step = defect->step;
    const double offset = 1e-4 * min_of(fraction, 1.0 - fraction);
    double before[N_Y], y[N_Y], after[N_Y], dy[N_Y], largest = 0.0;
    RhsOutputs rhs;
    if (compute_dense_output(run, defect->p, step))
        return 0;
    interpolate(run, step, fraction - offset, before);
    interpolate(run, step, fraction, y);
    interpolate(run, step, fraction + offset, after);
    if (evaluate_run_rhs(run, step->t + fraction * step->h, y, defect->p, dy, &rhs))
        return 0;
    /* friction or a rigid contact may change its mode before a motion begins */
    for (int k = 0; k < N_EVENT_FUNCTIONS; k++)
        if (is_force_or_slip_function(run, k) && compute_event_value(&run->discrete, &rhs, k) < 0.0)
            return 0;
    for (int k = 0; k < N_Y; k++)
        largest = max_of(largest, fabs(step->h * dy[k]
            - (after[k] - before[k]) / (2.0 * offset)) * run->norm.weight[k]);
    return largest < MAX_DEFECT;
}

/*
 * Return the fraction at which a tried step misses a transient of a term of time alone, between the nodes of its error
 * estimate; 0: nowhere. Called for each tried step; a step that misses one is repeated shorter.
 */
static double find_missed_transient(Integrator *run, Step *step, const Parameters *p)
{
    StepDefect defect = {run, step, p};
    return find_undersampled_term(
        step->t, step->h, step->method->error_nodes, step->method->n_error_nodes, has_small_defect, &defect, p);
}
#else
/* Return the fraction 0, no missed transient: the scene has no terms of time alone. */
static double find_missed_transient(const Integrator *run, const Step *step, const Parameters *p)
{
    (void)run, (void)step, (void)p;
    return 0.0;
}
#endif
