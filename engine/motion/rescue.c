/*
 * Where a pivot vanishes: the accelerations of the absolute formulation, which finds out which rows depend on
 * others, and of them those of the tree. Rare and out of the way of the fast path.
 */
int solve_by_absolute(double t, const double *q, const double *v, const DiscreteState *discrete, const Parameters *p,
    double *a, RhsOutputs *rhs)
{
    double all_q[N_Q], all_v[N_Q], all_a[N_Q];
    RhsOutputs whole;
    DiscreteState now = *discrete;
    now.held = 0; /* corners of the scene have other numbers there */
    expand(t, q, v, p, all_q, all_v);
    const int status = dynamics(t, all_q, all_v, &now, p, all_a, &whole);
    if (discrete->least > NEARLY_SINGULAR && status == NEAR)
        return NEAR;
    if (discrete->least > NEARLY_SINGULAR && status != STOPPED) { /* no singular position: as it would be solved anyway
                                                                   */
        now = *discrete;
        now.least = NEARLY_SINGULAR;
        now.least_size = VANISHING;
        return reduced_dynamics(t, q, v, &now, p, a, rhs);
    }
    reduce_accelerations(t, all_q, all_v, all_a, p, a);
    tree_multipliers(whole.lambda, rhs->lambda);
    return status;
}
