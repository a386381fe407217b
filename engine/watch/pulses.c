/* Steps that jump over a pulse: terms of time alone that act between stages (time_terms.c). */
#if N_PULSES
#define HARMLESS_DEFECT 30.0 /* of the tolerance, that a term may change over a whole step */

typedef struct {
    Run *run;
    Step *step;
    const Parameters *p;
} Look;

/* Whether the right-hand side is, at this share of the step, the rate of the step's interpolant. */
static int follows(void *context, double share, int sure)
{
    (void)sure; /* looked at anyway */
    const Look *look = context;
    Run *run = look->run;
    Step *step = look->step;
    const double apart = 1e-4 * min_of(share, 1.0 - share);
    double before[N_Y], y[N_Y], after[N_Y], dy[N_Y], most = 0.0;
    Aside aside;
    if (make_dense(run, look->p, step))
        return 0;
    interpolate(run, step, share - apart, before);
    interpolate(run, step, share, y);
    interpolate(run, step, share + apart, after);
    if (rates(run, step->t + share * step->h, y, look->p, dy, &aside))
        return 0;
    for (int k = 0; k < N_MARGINS; k++) /* what holds friction or a rigid contact may let go without a motion yet */
        if (follows_from_force(run, k) && margin(&run->memory, &aside, k) < 0.0)
            return 0;
    for (int k = 0; k < N_Y; k++)
        most = max_of(most, fabs(step->h * dy[k] - (after[k] - before[k]) / (2.0 * apart)) * run->norm.weight[k]);
    return most < HARMLESS_DEFECT;
}

/* Where a step misses what a term of time does; 0: nowhere. */
static double missed_pulse(Run *run, Step *step, const Parameters *p)
{
    Look look = {run, step, p};
    return unseen_term(step->t, step->h, step->method->heard, step->method->n_heard, follows, &look, p);
}
#else
static double missed_pulse(const Run *run, const Step *step, const Parameters *p)
{
    (void)run, (void)step, (void)p;
    return 0.0;
}
#endif
