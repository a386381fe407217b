/* The motion of a tree with driven chains, which are evaluated; without them the state is read as it is. */
#if N_CHAIN
/* What is integrated: coordinates of the tree that are free, their rates, works. Driven chains are evaluated. */
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
        rhs->g[idle[i]] = NAN; /* they do not act */
#endif
    status = reduced_dynamics(t, at.q, at.v, discrete, p, dy + N_X, rhs);
    for (int k = 0; k < N_X; k++)
        dy[k] = y[N_X + k];
    for (int k = 0; k < N_WORK; k++)
        dy[2 * N_X + k] = rhs->power[k];
    return status;
}

int play_here(double t, const double *y, DiscreteState *discrete, const Parameters *p, RhsOutputs *rhs)
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
 * The chains where they lie flat and nothing closes them: from a place so near that its rates tell the way to there.
 * If there is none, where they were a moment ago.
 */
static void beside_flat(double t, const double *y, const DiscreteState *discrete, const Parameters *p, TreeState *at)
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
    recall_chains(&discrete->chain, at);
}

/* The state of all bodies, (q, v, work). */
void to_absolute(double t, const double *y, const DiscreteState *discrete, const Parameters *p, double *all)
{
    TreeState at;
    DiscreteState now = *discrete;
    if (tree_state(t, y, &now, p, &at))
        beside_flat(t, y, discrete, p, &at);
    expand(t, at.q, at.v, p, all, all + N_Q);
    for (int k = 0; k < N_WORK; k++)
        all[2 * N_Q + k] = y[2 * N_X + k];
}

void from_absolute(double t, const double *all, DiscreteState *discrete, const Parameters *p, double *y)
{
    TreeState at;
    reduce_state(t, all, all + N_Q, p, at.q, at.v);
    seat_chains(t, at.q + N_X, discrete, p);
    for (int k = 0; k < N_X; k++) {
        y[k] = at.q[k];
        y[N_X + k] = at.v[k];
    }
    for (int k = 0; k < N_WORK; k++)
        y[2 * N_X + k] = all[2 * N_Q + k];
}

int closing_here(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dq, double *dv,
    double *worst)
{
    TreeState at;
    const int status = tree_state(t, y, discrete, p, &at);
    return status ? status : closing_step(t, at.q, at.v, discrete, p, dq, dv, worst);
}

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

int accept_state(double t, const double *y, DiscreteState *discrete, const Parameters *p, const RhsOutputs *rhs,
    double *phi_max, double *phi_dot_max)
{
    TreeState at; /* from here on the driven chains are followed */
    (void)rhs;
    int status = tree_state(t, y, discrete, p, &at);
    if (!status)
        status = keep_chains(t, &at, discrete, p);
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
/* No chains are driven: the kernels read the state as it is, q, then v. */
int closing_here(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dq, double *dv,
    double *worst)
{
    return closing_step(t, y, y + N_X, discrete, p, dq, dv, worst);
}

int linearize_state(double t, const double *y, DiscreteState *discrete, const Parameters *p, const double *a,
    const RhsOutputs *rhs, Linear *lin)
{
    linearize(t, y, y + N_X, discrete, p, a, rhs, lin);
    return 0;
}
#endif
