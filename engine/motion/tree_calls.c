/* Compute positions and velocities of all bodies from tree coordinates. */
void gudgeon_expand(double t, const double *q, const double *v, const double *p, double *all_q, double *all_v)
{
    expand(t, q, v, (const Parameters *)p, all_q, all_v);
}

/* Compute tree coordinates and their rates from positions and velocities of all bodies. */
void gudgeon_reduce(double t, const double *all_q, const double *all_v, const double *p, double *q, double *v)
{
    reduce_state(t, all_q, all_v, (const Parameters *)p, q, v);
}

/*
 * Compute accelerations of the tree coordinates, multipliers of the closures and powers. discrete: N_DISCRETE numbers
 * of a sample. Returns a status.
 */
int gudgeon_reduced_rhs(double t, const double *q, const double *v, const double *discrete, const double *p, double *a,
    double *lambda, double *power)
{
    DiscreteState now = {0};
    RhsOutputs rhs;
    read_discrete_state(discrete, &now);
    const int status = reduced_dynamics(t, q, v, &now, (const Parameters *)p, a, &rhs);
    for (int r = 0; r < N_LOOPS; r++)
        lambda[r] = rhs.lambda[r];
    for (int k = 0; k < N_WORK; k++)
        power[k] = rhs.power[k];
    return status;
}

/* Compute the closures Phi_s and their rates. */
void gudgeon_closures(double t, const double *q, const double *v, const double *p, double *phi, double *phi_dot)
{
    closures(t, q, (const Parameters *)p, phi);
    closure_rates(t, q, v, (const Parameters *)p, phi_dot);
}

/* Compute the smallest step x in the norm of M_s with Phi_s x = r. Returns a status. */
int gudgeon_reduced_project(double t, const double *q, const double *r, const double *p, double *x)
{
    return reduced_project(t, q, r, (const Parameters *)p, x);
}

#if RESCUED
/* Compute the accelerations by the equations of all bodies, as where a pivot vanishes, at any state; for tests. */
int gudgeon_reduced_rescue(
    double t, const double *q, const double *v, const double *discrete, const double *p, double *a)
{
    DiscreteState now = {0};
    RhsOutputs rhs;
    read_discrete_state(discrete, &now);
    return solve_by_absolute(t, q, v, &now, (const Parameters *)p, a, &rhs);
}

#endif
/*
 * Evaluate the reduced right-hand side `count` times for benchmarks; each call depends on the one before. Returns a sum
 * that keeps the calls.
 */
double gudgeon_time_reduced(long count, double t, const double *q, const double *v, const double *discrete,
    const double *p)
{
    double a[N_X + 1] = {0.0}, moved[N_X + 1], sum = 0.0;
    DiscreteState now = {0};
    RhsOutputs rhs;
    read_discrete_state(discrete, &now);
    for (int k = 0; k < N_X; k++)
        moved[k] = q[k];
    for (long i = 0; i < count; i++) {
        reduced_dynamics(t, moved, v, &now, (const Parameters *)p, a, &rhs);
        sum += a[0];
        moved[0] = q[0] + 1e-300 * sum;
    }
    return sum;
}
