/*
 * Compute the tree's accelerations and the closures' multipliers by the equations of all bodies. Returns NEAR near a
 * singular position if that is to be reported, or a status.
 */
int solve_by_absolute(double t, const double *q, const double *v, const DiscreteState *discrete, const Parameters *p,
    double *a, RhsOutputs *rhs)
{
    double all_q[N_Q], all_v[N_Q], all_a[N_Q];
    RhsOutputs whole;
    DiscreteState now = *discrete;
    now.held = 0; /* switching functions have other indices there */
    expand(t, q, v, p, all_q, all_v);
    const int status = dynamics(t, all_q, all_v, &now, p, all_a, &whole);
    if (discrete->least > NEARLY_SINGULAR && status == NEAR)
        return NEAR;
    if (discrete->least > NEARLY_SINGULAR && status != STOPPED) {
        /* not a singular position: solve with the usual limits of pivots */
        now = *discrete;
        now.least = NEARLY_SINGULAR;
        now.least_size = VANISHING;
        return reduced_dynamics(t, q, v, &now, p, a, rhs);
    }
    reduce_accelerations(t, all_q, all_v, all_a, p, a);
    tree_multipliers(whole.lambda, rhs->lambda);
    return status;
}
