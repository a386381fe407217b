/*
 * Right-hand side of scenes with driven loops: loops that drives determine kinematically, whose coordinates are
 * functions of time. Without driven loops, this file only calls the functions of the scene.
 */
#if N_DEPENDENT
/*
 * Compute the rates dy of the integrated state y: independent tree coordinates, their rates, works; and the outputs
 * rhs. Return 0 or a status. Coordinates of driven loops are not in y: they are solved for at time t.
 */
int evaluate_rhs(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dy, RhsOutputs *rhs)
{
    TreeState tree;
    int status = build_tree_state(t, y, discrete, p, &tree);
    if (status)
        return status;
#if !SMOOTH_DRIVEN_LOOPS
    evaluate_loop_switching_functions(t, tree.q, discrete, p, rhs->g);
#endif
#ifdef N_UNUSED_SWITCHES
    for (int i = 0; i < N_UNUSED_SWITCHES; i++)
        rhs->g[unused_switch[i]] = NAN; /* these switching functions are not in use */
#endif
    status = reduced_dynamics(t, tree.q, tree.v, discrete, p, dy + N_X, rhs);
    for (int k = 0; k < N_X; k++)
        dy[k] = y[N_X + k];
    for (int k = 0; k < N_WORK; k++)
        dy[2 * N_X + k] = rhs->power[k];
    return status;
}

/*
 * Evaluate the contacts of joints with play at state y into rhs->clearance, and the switching functions into rhs->g,
 * without solving for accelerations: reduced_dynamics() omits them if its argument `a` is NULL. Return 0 or a status.
 * Driven loops are solved at time t first.
 */
int evaluate_contacts(double t, const double *y, DiscreteState *discrete, const Parameters *p, RhsOutputs *rhs)
{
    TreeState tree;
    const int status = build_tree_state(t, y, discrete, p, &tree);
    if (status)
        return status;
#if !SMOOTH_DRIVEN_LOOPS
    evaluate_loop_switching_functions(t, tree.q, discrete, p, rhs->g);
#endif
    return reduced_dynamics(t, tree.q, tree.v, discrete, p, NULL, rhs);
}

/*
 * Compute the driven loops at a time t at which a loop is in a singular position (a dead centre), so that its closures
 * do not determine it. They are extrapolated from the nearest time at which they can be solved, within 0.05 of the
 * fastest coordinate's motion. If there is none, they are those of the last accepted state. The result is in `tree`.
 */
static void extrapolate_singular_loops(
    double t, const double *y, const DiscreteState *discrete, const Parameters *p, TreeState *tree)
{
    double fastest = 1e-300;
    for (int k = 0; k < N_DEPENDENT; k++)
        fastest = max_of(fastest, fabs(discrete->accepted_loops.v[k]));
    for (double e = 1e-7; e < 0.05; e *= 10.0)
        for (int sign = -1; sign <= 1; sign += 2) {
            const double h = sign * e / fastest;
            DiscreteState discrete_state = *discrete;
            if (build_tree_state(t - h, y, &discrete_state, p, tree))
                continue;
            for (int k = 0; k < N_DEPENDENT; k++) {
                tree->q[N_X + k] += h * (tree->v[N_X + k] + 0.5 * h * tree->v[N_X + N_DEPENDENT + k]);
                tree->v[N_X + k] += h * tree->v[N_X + N_DEPENDENT + k];
            }
            evaluate_loop_directions(t, tree->q, discrete, p, tree->q);
            return;
        }
    restore_driven_loops(&discrete->accepted_loops, tree);
}

/*
 * Compute the state of all bodies, (q, v, works) in `absolute_state`, from the integrated state y; driven loops are
 * solved at time t. If they cannot be solved, they are extrapolated (extrapolate_singular_loops()).
 */
void convert_integrated_to_absolute(double t, const double *y, const DiscreteState *discrete, const Parameters *p,
    double *absolute_state)
{
    TreeState tree;
    DiscreteState discrete_state = *discrete;
    if (build_tree_state(t, y, &discrete_state, p, &tree))
        extrapolate_singular_loops(t, y, discrete, p, &tree);
    expand(t, tree.q, tree.v, p, absolute_state, absolute_state + N_Q);
    for (int k = 0; k < N_WORK; k++)
        absolute_state[2 * N_Q + k] = y[2 * N_X + k];
}

/*
 * Compute the integrated state y, except internal states of laws, from the state of all bodies, (q, v, works) in
 * `absolute_state`. The driven loops are solved at time t and stored in `discrete`; later times are solved from there.
 * A failure is stored in discrete->accepted_loops.failed.
 */
void convert_absolute_to_integrated(double t, const double *absolute_state, DiscreteState *discrete,
    const Parameters *p, double *y)
{
    TreeState tree;
    reduce_state(t, absolute_state, absolute_state + N_Q, p, tree.q, tree.v);
    solve_driven_loops(t, tree.q + N_X, discrete, p);
    for (int k = 0; k < N_X; k++) {
        y[k] = tree.q[k];
        y[N_X + k] = tree.v[k];
    }
    for (int k = 0; k < N_WORK; k++)
        y[2 * N_X + k] = absolute_state[2 * N_Q + k];
}

/*
 * Compute one Newton step of the projection of state y onto the loop closures: corrections dq, dv (N_X), to be
 * subtracted, and the largest residual *residual. Driven loops are solved at time t first. y is not changed. Return 0
 * or a status. Called by the continuation of the motion (continuation.c), also as the step of compute_correction() away
 * from singular positions.
 */
int compute_projection_step(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dq,
    double *dv, double *residual)
{
    TreeState tree;
    const int status = build_tree_state(t, y, discrete, p, &tree);
    return status ? status : compute_closure_step(t, tree.q, tree.v, discrete, p, dq, dv, residual);
}

/*
 * Linearize the equations of motion at state y with accelerations a (N_X) into `linear`, for Newton's matrix. Return 0
 * or the status of the driven loops.
 */
int linearize_state(double t, const double *y, DiscreteState *discrete, const Parameters *p, const double *a,
    const RhsOutputs *rhs, Linear *linear)
{
    TreeState tree;
    const int status = build_tree_state(t, y, discrete, p, &tree);
    if (status)
        return status;
    compute_third_loop_rates(t, tree.q, tree.v, discrete, p, tree.v + N_X + 2 * N_DEPENDENT);
    linearize(t, tree.q, tree.v, discrete, p, a, rhs, linear);
    return 0;
}

/*
 * Accept a state: update the maxima of |Phi| and |Phi_dot| of the closures. Return 0 or a status. Driven loops are
 * stored in `discrete`; later times are solved from there. Called at the start and after each accepted step.
 */
int accept_state(double t, const double *y, DiscreteState *discrete, const Parameters *p, const RhsOutputs *rhs,
    double *phi_max, double *phi_dot_max)
{
    TreeState tree;
    (void)rhs;
    int status = build_tree_state(t, y, discrete, p, &tree);
    if (!status)
        status = accept_driven_loops(t, &tree, discrete, p);
    if (status)
        return status;
    double phi[N_LOOPS + 1], phi_dot[N_LOOPS + 1];
    closures(t, tree.q, p, phi);
    closure_rates(t, tree.q, tree.v, p, phi_dot);
    for (int r = 0; r < N_LOOPS; r++) {
        *phi_max = max_of(fabs(phi[r]), *phi_max);
        *phi_dot_max = max_of(fabs(phi_dot[r]), *phi_dot_max);
    }
    return 0;
}

#else
/*
 * Compute one Newton step of the projection of state y onto the loop closures: corrections dq, dv (N_X), to be
 * subtracted, and the largest residual *residual. y is not changed. Return 0 or a status. The
 * scene has no driven loops: the step is that of compute_closure_step() of the scene. Called by the continuation
 * of the motion (continuation.c), also as the step of compute_correction() away from singular positions.
 */
int compute_projection_step(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dq,
    double *dv, double *residual)
{
    return compute_closure_step(t, y, y + N_X, discrete, p, dq, dv, residual);
}

/*
 * Linearize the equations of motion at state y with accelerations a (N_X) into `linear`, for Newton's matrix. Return 0.
 */
int linearize_state(double t, const double *y, DiscreteState *discrete, const Parameters *p, const double *a,
    const RhsOutputs *rhs, Linear *linear)
{
    linearize(t, y, y + N_X, discrete, p, a, rhs, linear);
    return 0;
}
#endif
