/* Steps that jump over a pulse: terms of time alone that act between stages (time_terms.c). */
#if N_PULSES
#define HARMLESS_DEFECT 30.0 /* of the tolerance, that a term may change over a whole step */

typedef struct {
    Integrator *run;
    Step *step;
    const Parameters *p;
} Look;

/* Whether the right-hand side is, at this share of the step, the rate of the step's interpolant. */
static int satisfies_equations(void *context, double fraction, int sure)
{
    (void)sure; /* looked at anyway */
    const Look *look = context;
    Integrator *run = look->run;
    Step *step = look->step;
    const double apart = 1e-4 * min_of(fraction, 1.0 - fraction);
    double before[N_Y], y[N_Y], after[N_Y], dy[N_Y], most = 0.0;
    RhsOutputs rhs;
    if (make_dense(run, look->p, step))
        return 0;
    interpolate(run, step, fraction - apart, before);
    interpolate(run, step, fraction, y);
    interpolate(run, step, fraction + apart, after);
    if (rates(run, step->t + fraction * step->h, y, look->p, dy, &rhs))
        return 0;
    for (int k = 0; k < N_EVENT_FUNCTIONS; k++) /* what holds friction or a rigid contact may let go without a motion
                                                   yet */
        if (is_contact_force_function(run, k) && event_function(&run->discrete, &rhs, k) < 0.0)
            return 0;
    for (int k = 0; k < N_Y; k++)
        most = max_of(most, fabs(step->h * dy[k] - (after[k] - before[k]) / (2.0 * apart)) * run->norm.weight[k]);
    return most < HARMLESS_DEFECT;
}

/* Where a step misses what a term of time does; 0: nowhere. */
static double missed_transient(Integrator *run, Step *step, const Parameters *p)
{
    Look look = {run, step, p};
    return undersampled_term(
        step->t, step->h, step->method->error_nodes, step->method->n_error_nodes, satisfies_equations, &look, p);
}
#else
static double missed_transient(const Integrator *run, const Step *step, const Parameters *p)
{
    (void)run, (void)step, (void)p;
    return 0.0;
}
#endif
