/* Accelerations in tree coordinates from the equations of all bodies, where a pivot of the reduced ones vanishes. */

/*
 * Compute tree accelerations a and multipliers of the closures by the equations of all bodies, where a pivot of the
 * tree vanishes. Return 0 or a status.
 *
 * If near-singular positions are to be detected (discrete->min_pivot > NEARLY_SINGULAR), return NEAR_SINGULAR at one of
 * them; elsewhere the reduced equations are solved with the usual limits of pivots.
 */
int solve_by_absolute_equations(double t, const double *q, const double *v, const DiscreteState *discrete,
    const Parameters *p, double *a, RhsOutputs *rhs)
{
    double all_q[N_Q], all_v[N_Q], all_a[N_Q];
    RhsOutputs all_bodies;
    DiscreteState discrete_state = *discrete;
    discrete_state.is_frozen = 0; /* switching functions have other indices there */
    expand(t, q, v, p, all_q, all_v);
    const int status = dynamics(t, all_q, all_v, &discrete_state, p, all_a, &all_bodies);
    if (discrete->min_pivot > NEARLY_SINGULAR && status == NEAR_SINGULAR)
        return NEAR_SINGULAR;
    if (discrete->min_pivot > NEARLY_SINGULAR && status != STOPPED) {
        /* not a singular position: solve with the usual limits of pivots */
        discrete_state = *discrete;
        discrete_state.min_pivot = NEARLY_SINGULAR;
        discrete_state.min_pivot_size = VANISHING;
        return reduced_dynamics(t, q, v, &discrete_state, p, a, rhs);
    }
    reduce_accelerations(t, all_q, all_v, all_a, p, a);
    tree_multipliers(all_bodies.lambda, rhs->lambda);
    return status;
}
