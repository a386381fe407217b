/*
 * Driven loops: coordinates that drives determine through loops. At every time Chebyshev's method solves their
 * closures, from their positions at the last accepted state. The motion thus keeps its branch, and the right-hand side
 * remains a function of time and state.
 */
enum { MAX_CHAIN_STEPS = 8, MAX_CHAIN_PARTS = 60, FLAT_NODES = 4 };
#define CHAIN_REACH 0.1    /* rad, or fraction of the size: longer moves are made in parts */
#define FLAT_TURN 1e-2     /* the same: motion of the fastest coordinate between nodes near a flat loop */
#define FLAT_SMOOTH 1e-8   /* the same: largest difference of polynomials through the nodes */
#define CHAIN_STRAIGHT 1e-3 /* the same: largest difference of positions from the integral of the rates */

/*
 * Solve the closures of the driven loops by Chebyshev's method, from the guess in q. Of two Newton steps, `bend` is the
 * second one; the error after it is about bend^2/step. If it is not much smaller than the first, no root is near (L. V.
 * Kantorovich). moved: the sum of the steps. Returns 0 or the number of a closure.
 */
static int close_chains(double t, double *q, const DiscreteState *discrete, const Parameters *p, double *moved)
{
    double step[N_CHAIN], bend[N_CHAIN];
    int row = 1;
    *moved = 0.0;
    chain_directions(t, q, discrete, p, q);
    for (int i = 0; i < MAX_CHAIN_STEPS; i++) {
        double size = 0.0, bent = 0.0, sum = 0.0;
        const int status = chain_step(t, q, discrete, p, step, bend, &row);
        if (status)
            return status;
        for (int k = 0; k < N_CHAIN; k++) {
            size = max_of(size, fabs(step[k]) * chain_share(p, k));
            bent = max_of(bent, fabs(bend[k]) * chain_share(p, k));
            sum += step[k];
            q[N_X + k] -= step[k];
        }
        *moved += size;
        if (size > TURN_SMALL) {
            chain_directions(t, q, discrete, p, q);
        } else {
            turn_directions(q, step, p);
        }
        if (!isfinite(sum) || bent > 0.25 * size)
            return row;
        /* the second step may vanish although the cube of the first is not negligible */
        if ((4.0 * bent * bent < 1e-17 * size && size * size * size < 1e-17) || size < 1e-15)
            return 0;
    }
    return *moved < 1e-9 ? 0 : row;
}

/* Store the driven loops' coordinates and two rates at time t. */
static inline void store_chains(double t, const TreeState *at, Chain *place)
{
    place->t = t;
    for (int k = 0; k < N_LED; k++)
        place->q[k] = at->q[N_X + k];
    for (int k = 0; k < 2 * N_CHAIN; k++)
        place->v[k] = at->v[N_X + k];
}

/* Restore stored coordinates and two rates; third rates are computed where they are needed. */
static void restore_chains(const Chain *from, TreeState *at)
{
    for (int k = 0; k < N_LED; k++)
        at->q[N_X + k] = from->q[k];
    for (int k = 0; k < 2 * N_CHAIN; k++)
        at->v[N_X + k] = from->v[k];
}

/*
 * Return the error of the Euler-Maclaurin rule between two times, h apart, for the driven loops' positions; lengths are
 * divided by the size.
 */
static double chain_position_error(double h, const Chain *a, const TreeState *b, const Parameters *p)
{
    const double *q = b->q + N_X, *rate = b->v + N_X, *second = rate + N_CHAIN;
    double most = 0.0;
    for (int k = 0; k < N_CHAIN; k++) {
        const double way = 0.5 * h * (a->v[k] + rate[k] + (1.0 / 6.0) * h * (a->v[N_CHAIN + k] - second[k]));
        most = max_of(most, chain_share(p, k) * fabs(q[k] - a->q[k] - way));
    }
    return most;
}

/*
 * Solve the driven loops at time t from their state at a near time. Returns 0, or the number of a closure if the branch
 * is not certain.
 */
static int move_chains(double t, const Chain *from, const DiscreteState *discrete, const Parameters *p, TreeState *at)
{
    const double h = t - from->t, *rate = from->v, *second = rate + N_CHAIN, *third = second + N_CHAIN;
    double moved;
    for (int k = 0; k < N_CHAIN; k++)
        at->q[N_X + k] = from->q[k] + h * (rate[k] + 0.5 * h * (second[k] + (1.0 / 3.0) * h * third[k]));
    int status = close_chains(t, at->q, discrete, p, &moved);
    if (!status)
        status = chain_rates(t, at->q, discrete, p, at->v);
    if (status)
        return status;
    return moved <= CHAIN_REACH && chain_position_error(h, from, at, p) <= CHAIN_STRAIGHT ? 0 : 1;
}

/*
 * Solve the driven loops at time t in parts, if one move is too long. Returns 0, or the number of a closure that cannot
 * be followed.
 */
static int follow_chains_in_parts(double t, const DiscreteState *discrete, const Parameters *p, TreeState *at)
{
    Chain here = discrete->chain;
    double h = 0.5 * (t - here.t);
    int status = 1;
    for (int part = 0; part < MAX_CHAIN_PARTS; part++) {
        const int last = fabs(h) >= fabs(t - here.t);
        const double next = last ? t : here.t + h;
        status = move_chains(next, &here, discrete, p, at);
        if (!status && last)
            return 0;
        if (status) {
            h *= 0.5;
            continue;
        }
        here.t = next;
        for (int k = 0; k < N_CHAIN; k++)
            here.q[k] = at->q[N_X + k];
        for (int k = 0; k < 2 * N_CHAIN; k++)
            here.v[k] = at->v[N_X + k];
        chain_third(next, at->q, at->v, discrete, p, here.v + 2 * N_CHAIN);
        h *= 2.0;
    }
    return status ? status : 1;
}

/*
 * Interpolate the driven loops at a time at which a loop lies flat and its closures do not determine it. Polynomials in
 * time pass through regular states before and after. Directions are not computed. Returns 0, or nonzero if the
 * polynomials do not agree.
 */
static int interpolate_flat_chains(double t, const DiscreteState *discrete, const Parameters *p, Chain *place)
{
    double fastest = 0.0, lower[N_CHAIN];
    int status = discrete->chain.failed;
    for (int k = 0; k < N_CHAIN; k++)
        fastest = max_of(fastest, fabs(discrete->chain.v[k]) * chain_share(p, k));
    if (status || !(fastest > 0.0))
        return 1;
    *place = (Chain){.t = t};
    for (int i = 0; i < N_CHAIN; i++)
        lower[i] = 0.0;
    for (int j = 0; j < 2 * FLAT_NODES && !status; j++) {
        const int k = j / 2 + 1;
        const double when = t + (j % 2 ? -k : k) * FLAT_TURN / fastest;
        TreeState at;
        if (move_chains(when, &discrete->chain, discrete, p, &at))
            status = follow_chains_in_parts(when, discrete, p, &at);
        if (!status)
            status = chain_third(when, at.q, at.v, discrete, p, at.v + N_X + 2 * N_CHAIN);
        for (int i = 0; i < N_CHAIN && !status; i++) {
            place->q[i] += weight_at(FLAT_NODES, k) * at.q[N_X + i];
            lower[i] += k < FLAT_NODES ? weight_at(FLAT_NODES - 1, k) * at.q[N_X + i] : 0.0;
        }
        for (int i = 0; i < 3 * N_CHAIN && !status; i++)
            place->v[i] += weight_at(FLAT_NODES, k) * at.v[N_X + i];
    }
    for (int i = 0; i < N_CHAIN && !status; i++)
        status = !(fabs(place->q[i] - lower[i]) * chain_share(p, i) <= FLAT_SMOOTH);
    return status;
}

/*
 * Store the driven loops of an accepted state, with third rates; they are followed from there. Returns 0, or the number
 * of a closure that fails.
 */
static int accept_chains(double t, const TreeState *at, DiscreteState *discrete, const Parameters *p)
{
    Chain place = {0}, flat;
    store_chains(t, at, &place);
    place.failed = chain_third(t, at->q, at->v, discrete, p, place.v + 2 * N_CHAIN);
    if (place.failed && !interpolate_flat_chains(t, discrete, p, &flat)) {
        for (int k = N_CHAIN; k < N_LED; k++)
            flat.q[k] = place.q[k];
        place = flat;
    }
    discrete->chain = discrete->recent = place;
    return place.failed;
}

/*
 * Compute the driven loops at time t: those found at that time before, or from the last accepted state. Returns 0, or
 * the number of a closure that cannot be followed.
 */
static inline int follow_chains(double t, const DiscreteState *discrete, const Parameters *p, TreeState *at)
{
    if (discrete->chain.failed)
        return discrete->chain.failed;
#if SMOOTH_CHAINS
    if (discrete->recent.t == t) {
        restore_chains(&discrete->recent, at);
        return 0;
    }
#endif
    if (!move_chains(t, &discrete->chain, discrete, p, at))
        return 0;
    const int status = follow_chains_in_parts(t, discrete, p, at);
    Chain flat;
    if (!status || interpolate_flat_chains(t, discrete, p, &flat))
        return status;
    restore_chains(&flat, at);
    chain_directions(t, at->q, discrete, p, at->q);
    return 0;
}

/*
 * Build all that the tree's kernels read at (t, y). Several stages of a method share a time. A positive status
 * is a closure of a driven loop, numbered after the TREE_PIVOTS pivots.
 */
static inline int tree_state(double t, const double *y, DiscreteState *discrete, const Parameters *p, TreeState *at)
{
    const int status = follow_chains(t, discrete, p, at);
#if SMOOTH_CHAINS
    if (!status && discrete->recent.t != t)
        store_chains(t, at, &discrete->recent);
#endif
    for (int k = 0; k < N_X; k++) {
        at->q[k] = y[k];
        at->v[k] = y[N_X + k];
    }
    return status ? TREE_PIVOTS + status : 0;
}

/* Solve the driven loops at t from a guess of their coordinates (N_CHAIN), and follow them from there. */
void solve_driven_loops(double t, const double *guess, DiscreteState *discrete, const Parameters *p)
{
    TreeState at = {0};
    double moved;
    for (int k = 0; k < N_CHAIN; k++)
        at.q[N_X + k] = guess[k];
    int status = close_chains(t, at.q, discrete, p, &moved);
    if (!status)
        status = chain_rates(t, at.q, discrete, p, at.v);
    const int last = accept_chains(t, &at, discrete, p);
    discrete->chain.failed = status ? status : last;
}
