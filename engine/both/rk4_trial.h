/* Where a step would lead: the new state, its right-hand side, and which joints touched on the way. */
typedef struct {
    Real y[N_Y], dy[N_Y];
    AsideOf aside;
    Touched touched[AT_LEAST_ONE(N_CLEARANCES)];
} TrialOf;

/*
 * k1 = f(t, y), k2 = f(t + h/2, y + h/2 k1), k3 = f(t + h/2, y + h/2 k2), k4 = f(t + h, y + h k3),
 * y + h/6 (k1 + 2 k2 + 2 k3 + k4). k1 is left over from the step before.
 */
static int rk4_trial(RunOf *run, double h, const ParametersOf *p, TrialOf *trial)
{
    static const double reach[3] = {0.5, 0.5, 1.0}, weight[3] = {1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
    Real y[N_Y], k[N_Y];
    const Real *slope = run->dy;
    for (int i = 0; i < N_CLEARANCES; i++)
        trial->touched[i] = (Touched){0};
    for (int j = 0; j < N_Y; j++)
        trial->y[j] = run->y[j] + h / 6.0 * run->dy[j];
    for (int stage = 0; stage < 3; stage++) {
        for (int j = 0; j < N_Y; j++)
            y[j] = run->y[j] + reach[stage] * h * slope[j];
        const int status = rates(run, run->t + reach[stage] * h, y, p, k, &trial->aside);
        if (status)
            return status;
        for (int j = 0; j < N_Y; j++)
            trial->y[j] += weight[stage] * h * k[j];
        for (int i = 0; i < N_CLEARANCES; i++)
            trial->touched[i] |= trial->aside.clearance[i].delta > 0.0;
        slope = k;
    }
    close_state(run, run->t + h, trial->y, p);
    return rates(run, run->t + h, trial->y, p, trial->dy, &trial->aside);
}
