/*
 * Position analysis of driven loops: closed loops of a linkage whose coordinates drives alone determine. At every time
 * Chebyshev's method solves their closures (loop-closure equations), from their positions at the last accepted state.
 * The motion thus keeps its branch, and the right-hand side remains a function of time and state.
 */
enum { MAX_LOOP_ITERATIONS = 8, MAX_LOOP_PARTS = 60, SINGULAR_NODES = 4 };
#define MAX_LOOP_DISPLACEMENT 0.1    /* rad, or fraction of the size: longer moves are made in parts */
#define SINGULAR_NODE_DISPLACEMENT 1e-2 /* the same: motion of the fastest coordinate from node to node */
#define INTERPOLATION_TOL 1e-8   /* the same: largest difference of polynomials through the nodes */
#define LOOP_POSITION_TOL 1e-3 /* the same: largest difference of positions from the integral of the rates */
#define MAX_SECOND_STEP_RATIO 0.25  /* second to first Newton step of an iteration near a root */
#define LOOP_ERROR_ROUNDING 1e-17   /* the same: errors of a position that are below rounding */
#define MIN_LOOP_STEP 1e-15         /* the same: a smaller step is rounding */
#define MAX_UNCONVERGED_SUM 1e-9    /* the same: sum of steps that is accepted without convergence */

/*
 * Solve the closures of the driven loops at time t by Chebyshev's method, from the guess in q. Only q[N_X] and later
 * elements are replaced: the loops' coordinates and directions. *step_sum: sum over iterations of the largest first
 * step, rad or fraction of the size.
 *
 * An iteration consists of two Newton steps; the error after it is about second_step^2/step. If the second exceeds
 * MAX_SECOND_STEP_RATIO of the first, no root is near (L. V. Kantorovich). Return 0 if that error and the cube of the
 * first step are below LOOP_ERROR_ROUNDING, if the step is below MIN_LOOP_STEP, or if *step_sum < MAX_UNCONVERGED_SUM
 * after all MAX_LOOP_ITERATIONS iterations. Otherwise return the number of a closure.
 */
static int solve_loop_closures(double t, double *q, const DiscreteState *discrete, const Parameters *p,
    double *step_sum)
{
    double step[N_DEPENDENT], second_step[N_DEPENDENT];
    int row = 1;
    *step_sum = 0.0;
    evaluate_loop_directions(t, q, discrete, p, q);
    for (int i = 0; i < MAX_LOOP_ITERATIONS; i++) {
        double size = 0.0, second_size = 0.0, sum = 0.0;
        const int status = compute_loop_step(t, q, discrete, p, step, second_step, &row);
        if (status)
            return status;
        for (int k = 0; k < N_DEPENDENT; k++) {
            size = max_of(size, fabs(step[k]) * get_loop_step_scale(p, k));
            second_size = max_of(second_size, fabs(second_step[k]) * get_loop_step_scale(p, k));
            sum += step[k];
            q[N_X + k] -= step[k];
        }
        *step_sum += size;
        if (size > MAX_SERIES_ANGLE) {
            evaluate_loop_directions(t, q, discrete, p, q);
        } else {
            turn_directions(q, step, p);
        }
        if (!isfinite(sum) || second_size > MAX_SECOND_STEP_RATIO * size)
            return row;
        /* the second step may vanish although the cube of the first is not negligible */
        const int is_second_negligible = 4.0 * second_size * second_size < LOOP_ERROR_ROUNDING * size;
        if ((is_second_negligible && size * size * size < LOOP_ERROR_ROUNDING) || size < MIN_LOOP_STEP)
            return 0;
    }
    return *step_sum < MAX_UNCONVERGED_SUM ? 0 : row;
}

/* Store the driven loops' coordinates and two rates at time t from `tree` in `loops`. */
static inline void store_driven_loops(double t, const TreeState *tree, DrivenLoops *loops)
{
    loops->t = t;
    for (int k = 0; k < N_DEPENDENT_VALUES; k++)
        loops->q[k] = tree->q[N_X + k];
    for (int k = 0; k < 2 * N_DEPENDENT; k++)
        loops->v[k] = tree->v[N_X + k];
}

/* Copy stored coordinates and two rates of the driven loops to `tree`. Third rates are not copied. */
static void restore_driven_loops(const DrivenLoops *stored_loops, TreeState *tree)
{
    for (int k = 0; k < N_DEPENDENT_VALUES; k++)
        tree->q[N_X + k] = stored_loops->q[k];
    for (int k = 0; k < 2 * N_DEPENDENT; k++)
        tree->v[N_X + k] = stored_loops->v[k];
}

/*
 * Return the largest difference of the driven loops' positions in tree_after from their Euler-Maclaurin integral from
 * loops_before, h (s) earlier. In rad; lengths are divided by the size of the mechanism. Used to detect a change of
 * branch.
 */
static double compute_loop_position_error(double h, const DrivenLoops *loops_before, const TreeState *tree_after,
    const Parameters *p)
{
    const double *q = tree_after->q + N_X, *rate = tree_after->v + N_X, *second = rate + N_DEPENDENT;
    double largest_error = 0.0;
    for (int k = 0; k < N_DEPENDENT; k++) {
        const double distance = 0.5 * h * (loops_before->v[k] + rate[k]
            + (1.0 / 6.0) * h * (loops_before->v[N_DEPENDENT + k] - second[k]));
        largest_error = max_of(largest_error, get_loop_step_scale(p, k) * fabs(q[k] - loops_before->q[k] - distance));
    }
    return largest_error;
}

/*
 * Solve the positions and the first and second rates of the driven loops at time t, from their state `loops_before` at
 * a near time. The guess is the Taylor series of third order from there. Return 0, the number of a closure that cannot
 * be solved, or 1 if the branch is not certain.
 *
 * The branch is certain if the steps of solve_loop_closures() sum up to at most MAX_LOOP_DISPLACEMENT, and the
 * positions agree with the integral of the rates within LOOP_POSITION_TOL.
 */
static int advance_driven_loops(double t, const DrivenLoops *loops_before, const DiscreteState *discrete,
    const Parameters *p, TreeState *tree)
{
    const double h = t - loops_before->t, *rate = loops_before->v;
    const double *second = rate + N_DEPENDENT, *third = second + N_DEPENDENT;
    double step_sum;
    for (int k = 0; k < N_DEPENDENT; k++)
        tree->q[N_X + k] = loops_before->q[k] + h * (rate[k] + 0.5 * h * (second[k] + (1.0 / 3.0) * h * third[k]));
    int status = solve_loop_closures(t, tree->q, discrete, p, &step_sum);
    if (!status)
        status = compute_loop_rates(t, tree->q, discrete, p, tree->v);
    if (status)
        return status;
    return step_sum <= MAX_LOOP_DISPLACEMENT
        && compute_loop_position_error(h, loops_before, tree, p) <= LOOP_POSITION_TOL ? 0 : 1;
}

/*
 * Solve the driven loops at time t from the last accepted state in parts. The length of a part is halved where
 * advance_driven_loops() fails, and doubled after a success. Return 0, or the number of a closure that cannot be
 * followed in MAX_LOOP_PARTS parts. The result is in `tree`; `discrete` is not changed.
 */
static int follow_driven_loops_in_parts(double t, const DiscreteState *discrete, const Parameters *p, TreeState *tree)
{
    DrivenLoops start = discrete->accepted_loops;
    double h = 0.5 * (t - start.t);
    int status = 1;
    for (int part = 0; part < MAX_LOOP_PARTS; part++) {
        const int last = fabs(h) >= fabs(t - start.t);
        const double next = last ? t : start.t + h;
        status = advance_driven_loops(next, &start, discrete, p, tree);
        if (!status && last)
            return 0;
        if (status) {
            h *= 0.5;
            continue;
        }
        start.t = next;
        for (int k = 0; k < N_DEPENDENT; k++)
            start.q[k] = tree->q[N_X + k];
        for (int k = 0; k < 2 * N_DEPENDENT; k++)
            start.v[k] = tree->v[N_X + k];
        compute_third_loop_rates(next, tree->q, tree->v, discrete, p, start.v + 2 * N_DEPENDENT);
        h *= 2.0;
    }
    return status ? status : 1;
}

/*
 * Interpolate the driven loops at a time at which a loop is in a singular position (a dead centre: links in one line),
 * where its closures do not determine it. One Lagrange polynomial in time passes through SINGULAR_NODES regular states
 * on either side of t, spaced so that the fastest loop coordinate moves by SINGULAR_NODE_DISPLACEMENT. Positions and
 * all three rates are interpolated into `loops`; its directions are not set. Return 0, or nonzero if nothing moves, a
 * node cannot be solved, or the polynomial through one node fewer on either side deviates by more than
 * INTERPOLATION_TOL.
 */
static int interpolate_singular_loops(double t, const DiscreteState *discrete, const Parameters *p, DrivenLoops *loops)
{
    double fastest = 0.0, lower[N_DEPENDENT];
    int status = discrete->accepted_loops.failed;
    for (int k = 0; k < N_DEPENDENT; k++)
        fastest = max_of(fastest, fabs(discrete->accepted_loops.v[k]) * get_loop_step_scale(p, k));
    if (status || !(fastest > 0.0))
        return 1;
    *loops = (DrivenLoops){.t = t};
    for (int i = 0; i < N_DEPENDENT; i++)
        lower[i] = 0.0;
    for (int j = 0; j < 2 * SINGULAR_NODES && !status; j++) {
        const int k = j / 2 + 1;
        const double t_node = t + (j % 2 ? -k : k) * SINGULAR_NODE_DISPLACEMENT / fastest;
        TreeState tree;
        if (advance_driven_loops(t_node, &discrete->accepted_loops, discrete, p, &tree))
            status = follow_driven_loops_in_parts(t_node, discrete, p, &tree);
        if (!status)
            status = compute_third_loop_rates(t_node, tree.q, tree.v, discrete, p, tree.v + N_X + 2 * N_DEPENDENT);
        for (int i = 0; i < N_DEPENDENT && !status; i++) {
            loops->q[i] += compute_lagrange_weight(SINGULAR_NODES, k) * tree.q[N_X + i];
            lower[i] += k < SINGULAR_NODES ? compute_lagrange_weight(SINGULAR_NODES - 1, k) * tree.q[N_X + i] : 0.0;
        }
        for (int i = 0; i < 3 * N_DEPENDENT && !status; i++)
            loops->v[i] += compute_lagrange_weight(SINGULAR_NODES, k) * tree.v[N_X + i];
    }
    for (int i = 0; i < N_DEPENDENT && !status; i++)
        status = !(fabs(loops->q[i] - lower[i]) * get_loop_step_scale(p, i) <= INTERPOLATION_TOL);
    return status;
}

/*
 * Store the driven loops of an accepted state in `discrete`, with third rates; later times are solved from there. If
 * third rates cannot be solved, as in a singular position, the loops are interpolated. Return 0, or the number of a
 * closure that fails.
 */
static int accept_driven_loops(double t, const TreeState *tree, DiscreteState *discrete, const Parameters *p)
{
    DrivenLoops loops = {0}, interpolated;
    store_driven_loops(t, tree, &loops);
    loops.failed = compute_third_loop_rates(t, tree->q, tree->v, discrete, p, loops.v + 2 * N_DEPENDENT);
    if (loops.failed && !interpolate_singular_loops(t, discrete, p, &interpolated)) {
        for (int k = N_DEPENDENT; k < N_DEPENDENT_VALUES; k++)
            interpolated.q[k] = loops.q[k];
        loops = interpolated;
    }
    discrete->accepted_loops = discrete->latest_loops = loops;
    return loops.failed;
}

/*
 * Compute the driven loops at time t in `tree`, from the last accepted state; the loops of the last evaluated time are
 * reused at that time (SMOOTH_DRIVEN_LOOPS). They are solved in one move (advance_driven_loops()); if that fails, in
 * parts; if that fails too, interpolated past a singular position. Return 0, or the number of a closure that cannot be
 * followed; a failure stored by solve_driven_loops() is returned at once.
 */
static inline int follow_driven_loops(double t, const DiscreteState *discrete, const Parameters *p, TreeState *tree)
{
    if (discrete->accepted_loops.failed)
        return discrete->accepted_loops.failed;
#if SMOOTH_DRIVEN_LOOPS
    if (discrete->latest_loops.t == t) {
        restore_driven_loops(&discrete->latest_loops, tree);
        return 0;
    }
#endif
    if (!advance_driven_loops(t, &discrete->accepted_loops, discrete, p, tree))
        return 0;
    const int status = follow_driven_loops_in_parts(t, discrete, p, tree);
    DrivenLoops interpolated;
    if (!status || interpolate_singular_loops(t, discrete, p, &interpolated))
        return status;
    restore_driven_loops(&interpolated, tree);
    evaluate_loop_directions(t, tree->q, discrete, p, tree->q);
    return 0;
}

/*
 * Build all that the scene's functions read at (t, y) in `tree`: driven loops solved at t, and the independent
 * coordinates and rates of y. Without switching functions in the loops, they are solved once for the stages that share
 * a time. Return 0, or TREE_PIVOTS plus the number of a closure of a driven loop.
 */
static inline int build_tree_state(double t, const double *y, DiscreteState *discrete, const Parameters *p,
    TreeState *tree)
{
    const int status = follow_driven_loops(t, discrete, p, tree);
#if SMOOTH_DRIVEN_LOOPS
    if (!status && discrete->latest_loops.t != t)
        store_driven_loops(t, tree, &discrete->latest_loops);
#endif
    for (int k = 0; k < N_X; k++) {
        tree->q[k] = y[k];
        tree->v[k] = y[N_X + k];
    }
    return status ? TREE_PIVOTS + status : 0;
}

/*
 * Solve the driven loops at time t from a guess of their coordinates (N_DEPENDENT), and store them in `discrete`; later
 * times are solved from there. A failure is stored in discrete->accepted_loops.failed. Called where a run starts.
 */
void solve_driven_loops(double t, const double *guess, DiscreteState *discrete, const Parameters *p)
{
    TreeState tree = {0};
    double step_sum;
    for (int k = 0; k < N_DEPENDENT; k++)
        tree.q[N_X + k] = guess[k];
    int status = solve_loop_closures(t, tree.q, discrete, p, &step_sum);
    if (!status)
        status = compute_loop_rates(t, tree.q, discrete, p, tree.v);
    const int last = accept_driven_loops(t, &tree, discrete, p);
    discrete->accepted_loops.failed = status ? status : last;
}
