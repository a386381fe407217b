/* Functions that Python calls to evaluate the motion in tree coordinates, with loops that drives determine. */

/*
 * Build the state `tree`, which the scene's functions read, from the coordinates q and rates v of a call from Python.
 * Driven loops are solved at time t from the guess of their coordinates after the N_X tree coordinates in q; the status
 * of this solution is ignored. Return 0 or the status of build_tree_state(), which solves them again.
 */
static int build_tree_state_from_call(
    double t, const double *q, const double *v, DiscreteState *discrete, const Parameters *p, TreeState *tree)
{
    double y[N_Y];
    for (int k = 0; k < N_X; k++) {
        y[k] = q[k];
        y[N_X + k] = v[k];
    }
    solve_driven_loops(t, q + N_X, discrete, p);
    return build_tree_state(t, y, discrete, p, tree);
}

/*
 * Compute positions and velocities of all bodies (N_Q each) from tree coordinates q and rates v. q contains a guess of
 * the coordinates of the driven loops after those of the tree; they are solved at t. A failure of that solution is
 * ignored.
 */
void gudgeon_expand(double t, const double *q, const double *v, const double *p, double *all_q, double *all_v)
{
    DiscreteState discrete_state = {0};
    TreeState tree = {0};
    build_tree_state_from_call(t, q, v, &discrete_state, (const Parameters *)p, &tree);
    expand(t, tree.q, tree.v, (const Parameters *)p, all_q, all_v);
}

/*
 * Compute tree coordinates q and rates v from positions and velocities of all bodies (N_Q each). Coordinates of driven
 * loops follow those of the tree in q and v.
 */
void gudgeon_reduce(double t, const double *all_q, const double *all_v, const double *p, double *q, double *v)
{
    reduce_state(t, all_q, all_v, (const Parameters *)p, q, v);
}

/*
 * Compute accelerations a of the tree coordinates, multipliers of the closures and powers at a state. Return 0 or a
 * status. Driven loops are solved at t. discrete: discrete state as in a sample (N_DISCRETE numbers); a: N_X, lambda:
 * N_LOOPS, power: N_WORK.
 */
int gudgeon_reduced_rhs(double t, const double *q, const double *v, const double *discrete, const double *p, double *a,
    double *lambda, double *power)
{
    DiscreteState discrete_state = {0};
    RhsOutputs rhs;
    TreeState tree;
    read_discrete_state(discrete, &discrete_state);
    int status = build_tree_state_from_call(t, q, v, &discrete_state, (const Parameters *)p, &tree);
    if (status)
        return status;
    status = reduced_dynamics(t, tree.q, tree.v, &discrete_state, (const Parameters *)p, a, &rhs);
    for (int r = 0; r < N_LOOPS; r++)
        lambda[r] = rhs.lambda[r];
    for (int k = 0; k < N_WORK; k++)
        power[k] = rhs.power[k];
    return status;
}

/*
 * Compute the residuals phi of the closures and their rates phi_dot (N_LOOPS each) at a state; driven loops are solved
 * at t. A failure of that solution is ignored.
 */
void gudgeon_closures(double t, const double *q, const double *v, const double *p, double *phi, double *phi_dot)
{
    DiscreteState discrete_state = {0};
    TreeState tree = {0};
    build_tree_state_from_call(t, q, v, &discrete_state, (const Parameters *)p, &tree);
    closures(t, tree.q, (const Parameters *)p, phi);
    closure_rates(t, tree.q, tree.v, (const Parameters *)p, phi_dot);
}

/*
 * Compute the smallest step x (N_X) in the norm of the tree's mass matrix M_s with Phi_s x = r. Return 0 or a status.
 * Driven loops are solved at t.
 */
int gudgeon_reduced_project(double t, const double *q, const double *r, const double *p, double *x)
{
    DiscreteState discrete_state = {0};
    TreeState tree;
    const int status = build_tree_state_from_call(t, q, q, &discrete_state, (const Parameters *)p, &tree);
    return status ? status : reduced_project(t, tree.q, r, (const Parameters *)p, x);
}

#if HAS_ABSOLUTE_FALLBACK
/*
 * Compute the tree accelerations a by the absolute equations, those of all bodies, at any state; for tests. Return 0 or
 * a status. The engine uses this fallback only where a pivot vanishes. discrete: as for gudgeon_reduced_rhs().
 */
int gudgeon_accelerations_by_absolute_equations(
    double t, const double *q, const double *v, const double *discrete, const double *p, double *a)
{
    DiscreteState discrete_state = {0};
    RhsOutputs rhs;
    TreeState tree;
    read_discrete_state(discrete, &discrete_state);
    const int status = build_tree_state_from_call(t, q, v, &discrete_state, (const Parameters *)p, &tree);
    return status ? status
        : solve_by_absolute_equations(t, tree.q, tree.v, &discrete_state, (const Parameters *)p, a, &rhs);
}

#endif
/*
 * Solve the driven loops at time t from the guess in q (N_DEPENDENT), which is replaced, and compute three rates of
 * each in v (3 N_DEPENDENT). Return 0 or the number of a closure that cannot be solved.
 */
int gudgeon_driven_loops(double t, double *q, const double *p, double *v)
{
    DiscreteState discrete_state = {0};
    solve_driven_loops(t, q, &discrete_state, (const Parameters *)p);
    for (int k = 0; k < N_DEPENDENT; k++)
        q[k] = discrete_state.accepted_loops.q[k];
    for (int k = 0; k < 3 * N_DEPENDENT; k++)
        v[k] = discrete_state.accepted_loops.v[k];
    return discrete_state.accepted_loops.failed;
}

/*
 * Evaluate the right-hand side `count` times for benchmarks, each time at a state that depends on the result before.
 * Driven loops are solved anew each time, from a time at which the first of them differed by about 0.1 rad. Return a
 * sum of results, which keeps the compiler from omitting calls.
 */
double gudgeon_time_reduced(long count, double t, const double *q, const double *v, const double *discrete,
    const double *parameters)
{
    const Parameters *p = (const Parameters *)parameters;
    double dy[N_Y], y[N_Y], sum = 0.0;
    DiscreteState discrete_state = {0};
    RhsOutputs rhs;
    read_discrete_state(discrete, &discrete_state);
    solve_driven_loops(t, q + N_X, &discrete_state, p);
    const double speed = hypot(discrete_state.accepted_loops.v[0], 1e-6), ahead = 0.1 / speed;
    for (int k = 0; k < N_X; k++) {
        y[k] = q[k];
        y[N_X + k] = v[k];
    }
    for (long i = 0; i < count; i++) {
        compute_motion_rates(t + (i % 2 ? ahead : 0.9 * ahead), y, &discrete_state, p, dy, &rhs);
        sum += dy[N_X];
        y[0] = q[0] + 1e-300 * sum;
    }
    return sum;
}
