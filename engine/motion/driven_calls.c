/*
 * Build the state that the tree's kernels read from q and v of a call; driven loops are solved at t. Returns a status.
 */
static int close_tree_state(
    double t, const double *q, const double *v, DiscreteState *discrete, const Parameters *p, TreeState *at)
{
    double y[N_Y];
    for (int k = 0; k < N_X; k++) {
        y[k] = q[k];
        y[N_X + k] = v[k];
    }
    solve_driven_loops(t, q + N_X, discrete, p);
    return tree_state(t, y, discrete, p, at);
}

/* Compute positions and velocities of all bodies from tree coordinates. */
void gudgeon_expand(double t, const double *q, const double *v, const double *p, double *all_q, double *all_v)
{
    DiscreteState now = {0};
    TreeState at = {0};
    close_tree_state(t, q, v, &now, (const Parameters *)p, &at);
    expand(t, at.q, at.v, (const Parameters *)p, all_q, all_v);
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
    TreeState at;
    read_discrete_state(discrete, &now);
    int status = close_tree_state(t, q, v, &now, (const Parameters *)p, &at);
    if (status)
        return status;
    status = reduced_dynamics(t, at.q, at.v, &now, (const Parameters *)p, a, &rhs);
    for (int r = 0; r < N_LOOPS; r++)
        lambda[r] = rhs.lambda[r];
    for (int k = 0; k < N_WORK; k++)
        power[k] = rhs.power[k];
    return status;
}

/* Compute the closures Phi_s and their rates. */
void gudgeon_closures(double t, const double *q, const double *v, const double *p, double *phi, double *phi_dot)
{
    DiscreteState now = {0};
    TreeState at = {0};
    close_tree_state(t, q, v, &now, (const Parameters *)p, &at);
    closures(t, at.q, (const Parameters *)p, phi);
    closure_rates(t, at.q, at.v, (const Parameters *)p, phi_dot);
}

/* Compute the smallest step x in the norm of M_s with Phi_s x = r. Returns a status. */
int gudgeon_reduced_project(double t, const double *q, const double *r, const double *p, double *x)
{
    DiscreteState now = {0};
    TreeState at;
    const int status = close_tree_state(t, q, q, &now, (const Parameters *)p, &at);
    return status ? status : reduced_project(t, at.q, r, (const Parameters *)p, x);
}

#if RESCUED
/* Compute the accelerations by the equations of all bodies, as where a pivot vanishes, at any state; for tests. */
int gudgeon_reduced_rescue(
    double t, const double *q, const double *v, const double *discrete, const double *p, double *a)
{
    DiscreteState now = {0};
    RhsOutputs rhs;
    TreeState at;
    read_discrete_state(discrete, &now);
    const int status = close_tree_state(t, q, v, &now, (const Parameters *)p, &at);
    return status ? status : solve_by_absolute(t, at.q, at.v, &now, (const Parameters *)p, a, &rhs);
}

#endif
/*
 * Solve the driven loops at t from the guess in q (N_CHAIN); v: three rates of each coordinate (3 N_CHAIN). Returns 0
 * or the number of a closure.
 */
int gudgeon_chains(double t, double *q, const double *p, double *v)
{
    DiscreteState now = {0};
    solve_driven_loops(t, q, &now, (const Parameters *)p);
    for (int k = 0; k < N_CHAIN; k++)
        q[k] = now.chain.q[k];
    for (int k = 0; k < 3 * N_CHAIN; k++)
        v[k] = now.chain.v[k];
    return now.chain.failed;
}

/*
 * Evaluate the reduced right-hand side `count` times for benchmarks; each call depends on the one before. Driven loops
 * are solved anew each time, from a time at which the first of them differed by about 0.1 rad. Returns a sum that keeps
 * the calls.
 */
double gudgeon_time_reduced(long count, double t, const double *q, const double *v, const double *discrete,
    const double *parameters)
{
    const Parameters *p = (const Parameters *)parameters;
    double dy[N_Y], y[N_Y], sum = 0.0;
    DiscreteState now = {0};
    RhsOutputs rhs;
    read_discrete_state(discrete, &now);
    solve_driven_loops(t, q + N_X, &now, p);
    const double speed = hypot(now.chain.v[0], 1e-6), ahead = 0.1 / speed;
    for (int k = 0; k < N_X; k++) {
        y[k] = q[k];
        y[N_X + k] = v[k];
    }
    for (long i = 0; i < count; i++) {
        motion(t + (i % 2 ? ahead : 0.9 * ahead), y, &now, p, dy, &rhs);
        sum += dy[N_X];
        y[0] = q[0] + 1e-300 * sum;
    }
    return sum;
}
