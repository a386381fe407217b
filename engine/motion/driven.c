/*
 * The motion of a tree with driven loops, whose coordinates are functions of time; without driven loops, the calls of
 * its kernels.
 */
#if N_CHAIN
/*
 * Compute the rates dy of the integrated state y: independent tree coordinates, their rates, works. Coordinates of
 * driven loops are evaluated at t. Returns a status.
 */
int motion_here(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dy, RhsOutputs *rhs)
{
    TreeState at;
    int status = tree_state(t, y, discrete, p, &at);
    if (status)
        return status;
#if !SMOOTH_CHAINS
    loop_switches(t, at.q, discrete, p, rhs->g);
#endif
#ifdef N_IDLE
    for (int i = 0; i < N_IDLE; i++)
        rhs->g[idle[i]] = NAN; /* these switching functions are not in use */
#endif
    status = reduced_dynamics(t, at.q, at.v, discrete, p, dy + N_X, rhs);
    for (int k = 0; k < N_X; k++)
        dy[k] = y[N_X + k];
    for (int k = 0; k < N_WORK; k++)
        dy[2 * N_X + k] = rhs->power[k];
    return status;
}

/* Evaluate the contacts of joints with play at a state, without accelerations. Returns a status. */
int evaluate_contacts(double t, const double *y, DiscreteState *discrete, const Parameters *p, RhsOutputs *rhs)
{
    TreeState at;
    const int status = tree_state(t, y, discrete, p, &at);
    if (status)
        return status;
#if !SMOOTH_CHAINS
    loop_switches(t, at.q, discrete, p, rhs->g);
#endif
    return reduced_dynamics(t, at.q, at.v, discrete, p, NULL, rhs);
}

/*
 * Compute the driven loops at a time at which a loop lies flat, so that its closures do not determine it. They are
 * extrapolated from the nearest regular time, or taken from the last accepted state if there is none.
 */
static void extrapolate_flat_chains(
    double t, const double *y, const DiscreteState *discrete, const Parameters *p, TreeState *at)
{
    double fastest = 1e-300;
    for (int k = 0; k < N_CHAIN; k++)
        fastest = max_of(fastest, fabs(discrete->chain.v[k]));
    for (double e = 1e-7; e < 0.05; e *= 10.0)
        for (int branch = -1; branch <= 1; branch += 2) {
            const double h = branch * e / fastest;
            DiscreteState now = *discrete;
            if (tree_state(t - h, y, &now, p, at))
                continue;
            for (int k = 0; k < N_CHAIN; k++) {
                at->q[N_X + k] += h * (at->v[N_X + k] + 0.5 * h * at->v[N_X + N_CHAIN + k]);
                at->v[N_X + k] += h * at->v[N_X + N_CHAIN + k];
            }
            chain_directions(t, at->q, discrete, p, at->q);
            return;
        }
    restore_chains(&discrete->chain, at);
}

/* Compute the state of all bodies, (q, v, works), from the integrated state y. */
void to_absolute(double t, const double *y, const DiscreteState *discrete, const Parameters *p, double *all)
{
    TreeState at;
    DiscreteState now = *discrete;
    if (tree_state(t, y, &now, p, &at))
        extrapolate_flat_chains(t, y, discrete, p, &at);
    expand(t, at.q, at.v, p, all, all + N_Q);
    for (int k = 0; k < N_WORK; k++)
        all[2 * N_Q + k] = y[2 * N_X + k];
}

/*
 * Compute the integrated state y from the state of all bodies (q, v, works), and the positions of the driven loops in
 * `discrete`.
 */
void from_absolute(double t, const double *all, DiscreteState *discrete, const Parameters *p, double *y)
{
    TreeState at;
    reduce_state(t, all, all + N_Q, p, at.q, at.v);
    solve_driven_loops(t, at.q + N_X, discrete, p);
    for (int k = 0; k < N_X; k++) {
        y[k] = at.q[k];
        y[N_X + k] = at.v[k];
    }
    for (int k = 0; k < N_WORK; k++)
        y[2 * N_X + k] = all[2 * N_Q + k];
}

/* Compute the steps dq, dv that return a state to the closures, and the largest residual `worst`. Returns a status. */
int closing_here(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dq, double *dv,
    double *worst)
{
    TreeState at;
    const int status = tree_state(t, y, discrete, p, &at);
    return status ? status : closing_step(t, at.q, at.v, discrete, p, dq, dv, worst);
}

/* Linearize the equations of motion at a state with accelerations a. Returns a status. */
int linearize_state(double t, const double *y, DiscreteState *discrete, const Parameters *p, const double *a,
    const RhsOutputs *rhs, Linear *lin)
{
    TreeState at;
    const int status = tree_state(t, y, discrete, p, &at);
    if (status)
        return status;
    chain_third(t, at.q, at.v, discrete, p, at.v + N_X + 2 * N_CHAIN);
    linearize(t, at.q, at.v, discrete, p, a, rhs, lin);
    return 0;
}

/*
 * Accept a state: update the maxima of |Phi| and |Phi_dot|. Driven loops are followed from here on. Returns a status.
 */
int accept_state(double t, const double *y, DiscreteState *discrete, const Parameters *p, const RhsOutputs *rhs,
    double *phi_max, double *phi_dot_max)
{
    TreeState at;
    (void)rhs;
    int status = tree_state(t, y, discrete, p, &at);
    if (!status)
        status = accept_chains(t, &at, discrete, p);
    if (status)
        return status;
    double phi[N_LOOPS + 1], phi_dot[N_LOOPS + 1];
    closures(t, at.q, p, phi);
    closure_rates(t, at.q, at.v, p, phi_dot);
    for (int r = 0; r < N_LOOPS; r++) {
        *phi_max = max_of(fabs(phi[r]), *phi_max);
        *phi_dot_max = max_of(fabs(phi_dot[r]), *phi_dot_max);
    }
    return 0;
}

#else
/*
 * Compute the steps dq, dv that return a state (q, v) to the closures, and the largest residual `worst`. Returns a
 * status.
 */
int closing_here(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dq, double *dv,
    double *worst)
{
    return closing_step(t, y, y + N_X, discrete, p, dq, dv, worst);
}

/* Linearize the equations of motion at a state (q, v) with accelerations a. Returns a status. */
int linearize_state(double t, const double *y, DiscreteState *discrete, const Parameters *p, const double *a,
    const RhsOutputs *rhs, Linear *lin)
{
    linearize(t, y, y + N_X, discrete, p, a, rhs, lin);
    return 0;
}
#endif
