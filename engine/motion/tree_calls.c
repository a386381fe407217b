/* Functions that Python calls to evaluate the motion in tree coordinates, without loops that drives determine. */

/* Compute positions and velocities of all bodies (N_Q each) from tree coordinates q and rates v (N_X each). */
void gudgeon_expand(double t, const double *q, const double *v, const double *p, double *all_q, double *all_v)
{
    expand(t, q, v, (const Parameters *)p, all_q, all_v);
}

/* Compute tree coordinates q and rates v (N_X each) from positions and velocities of all bodies (N_Q each). */
void gudgeon_reduce(double t, const double *all_q, const double *all_v, const double *p, double *q, double *v)
{
    reduce_state(t, all_q, all_v, (const Parameters *)p, q, v);
}

/*
 * Compute accelerations a of the tree coordinates, multipliers of the closures and powers at a state. Return 0 or a
 * status. discrete: discrete state as in a sample (N_DISCRETE numbers); a: N_X, lambda: N_LOOPS, power: N_WORK.
 */
int gudgeon_reduced_rhs(double t, const double *q, const double *v, const double *discrete, const double *p, double *a,
    double *lambda, double *power)
{
    DiscreteState discrete_state = {0};
    RhsOutputs rhs;
    read_discrete_state(discrete, &discrete_state);
    const int status = reduced_dynamics(t, q, v, &discrete_state, (const Parameters *)p, a, &rhs);
    for (int r = 0; r < N_LOOPS; r++)
        lambda[r] = rhs.lambda[r];
    for (int k = 0; k < N_WORK; k++)
        power[k] = rhs.power[k];
    return status;
}

/* Compute the residuals phi of the closures and their rates phi_dot (N_LOOPS each) at a state. */
void gudgeon_closures(double t, const double *q, const double *v, const double *p, double *phi, double *phi_dot)
{
    closures(t, q, (const Parameters *)p, phi);
    closure_rates(t, q, v, (const Parameters *)p, phi_dot);
}

/*
 * Compute the smallest step x (N_X) in the norm of the tree's mass matrix M_s with Phi_s x = r. Return 0 or a status.
 */
int gudgeon_reduced_project(double t, const double *q, const double *r, const double *p, double *x)
{
    return reduced_project(t, q, r, (const Parameters *)p, x);
}

#if HAS_ABSOLUTE_FALLBACK
/*
 * Compute the tree accelerations a by the equations of all bodies at any state; for tests. Return 0 or a status. The
 * engine uses this fallback only where a pivot vanishes. discrete: as for gudgeon_reduced_rhs().
 */
int gudgeon_accelerations_by_absolute_equations(
    double t, const double *q, const double *v, const double *discrete, const double *p, double *a)
{
    DiscreteState discrete_state = {0};
    RhsOutputs rhs;
    read_discrete_state(discrete, &discrete_state);
    return solve_by_absolute_equations(t, q, v, &discrete_state, (const Parameters *)p, a, &rhs);
}

#endif
/*
 * Evaluate the reduced right-hand side `count` times for benchmarks, each time at a state that depends on the result
 * before. Return a sum of results, which keeps the compiler from omitting calls.
 */
double gudgeon_time_reduced(long count, double t, const double *q, const double *v, const double *discrete,
    const double *p)
{
    double a[N_X + 1] = {0.0}, q_perturbed[N_X + 1], sum = 0.0;
    DiscreteState discrete_state = {0};
    RhsOutputs rhs;
    read_discrete_state(discrete, &discrete_state);
    for (int k = 0; k < N_X; k++)
        q_perturbed[k] = q[k];
    for (long i = 0; i < count; i++) {
        reduced_dynamics(t, q_perturbed, v, &discrete_state, (const Parameters *)p, a, &rhs);
        sum += a[0];
        q_perturbed[0] = q[0] + 1e-300 * sum;
    }
    return sum;
}
