/*
 * Change points: positions at which constraint equations depend on each other and two branches of the motion meet, such
 * as a parallelogram with all links in line. The equations determine neither position nor rates there, and are
 * ill-conditioned near it. The motion passes on the smooth branch, by polynomials in time through regular positions
 * before and after.
 */
enum { PASS_NODES = 4 /* on either side */, PASS_TRIES = 3, PASS_HALVINGS = 8 };
#define PASS_NODE_ANGLE 1e-2   /* rad, or fraction of the size: motion of the fastest coordinate between two nodes */
#define PASS_POSITION_TOL 1e-9 /* the same: largest difference of polynomials of two degrees */
#define PASS_RATE_TOL 1e-5  /* of the fastest rate: largest difference of a start from a branch */

/*
 * Return whether a position is ill-conditioned, as near a change point: the last Newton correction exceeds
 * MIN_PASS_CORRECTION DBL_EPSILON max(1, |angles|), or is NaN.
 */
static int is_ill_conditioned(const Position *position)
{
    double size = 1.0;
    for (int k = 2; k < N_Q; k += 3)
        size = get_larger_or_nan(size, fabs(position->q[k]));
    return !(position->last_correction <= MIN_PASS_CORRECTION * DBL_EPSILON * size);
}

/*
 * Follow the branch from the regular position `start` to time t, forwards or backwards, and compute `position` there,
 * complete as for a sample. The step is halved, up to PASS_HALVINGS times, while a solution fails, is too far from its
 * guess, or misses the trapezoidal rule of the velocities. Return 0 or a status.
 */
static int follow_branch(KinematicRun *run, double t, const Position *start, Position *position)
{
    double h = t - start->t;
    *position = *start;
    for (int halvings = 0; position->t != t;) {
        Position next;
        double correction;
        const int status = solve_position_at(run, fabs(h) < fabs(t - position->t) ? position->t + h : t, position,
            &next, &correction);
        if (status == STOPPED)
            return status;
        if (!status && correction <= run->max_correction
            && compute_trapezoidal_error(position, &next, run->extent) <= MAX_STEP_ERROR * run->max_correction) {
            *position = next;
            continue;
        }
        if (++halvings > PASS_HALVINGS)
            return status ? status : NEWTON_FAILED;
        h *= 0.5;
    }
    return complete_position(run, position);
}

/*
 * Compute 2 PASS_NODES regular positions of the branch of `start` on both sides of time t. Return 0 or a status. node[2
 * j] and node[2 j + 1] are j + 1 intervals d (s) before and after t.
 */
static int compute_branch_nodes(KinematicRun *run, double t, double d, const Position *start, Position *node)
{
    int status = follow_branch(run, t - d, start, &node[0]);
    if (!status)
        status = follow_branch(run, t + d, &node[0], &node[1]);
    for (int j = 2; j < 2 * PASS_NODES && !status; j++)
        status = follow_branch(run, t + (j % 2 ? 1 + j / 2 : -1 - j / 2) * d, &node[j - 2], &node[j]);
    return status;
}

/*
 * Return the value at the middle time of the polynomial (Lagrange) through one component of the first n nodes on either
 * side. component: address of that component in node[0]; in the other nodes it has the same offset.
 */
static double interpolate_at_middle(const Position *node, int n, const double *component)
{
    const size_t offset = (size_t)((const char *)component - (const char *)node);
    double sum = 0.0;
    for (int j = 0; j < 2 * n; j++)
        sum += compute_lagrange_weight(n, j / 2 + 1) * *(const double *)((const char *)&node[j] + offset);
    return sum;
}

/*
 * Interpolate `position` at time t, the middle of the 2 PASS_NODES nodes, and mark it as interpolated. phi is its
 * largest |Phi|; phi_dot is that of node[0]; last_correction is 0.
 */
static void interpolate_position(const Position *node, double t, const Parameters *p, Position *position)
{
    double phi[AT_LEAST_ONE(N_ALL_ROWS)];
    *position = node[0];
    position->t = t;
    position->is_interpolated = 1;
    position->last_correction = 0.0;
    for (int k = 0; k < N_Q; k++) {
        position->q[k] = interpolate_at_middle(node, PASS_NODES, &node->q[k]);
        position->v[k] = interpolate_at_middle(node, PASS_NODES, &node->v[k]);
        position->a[k] = interpolate_at_middle(node, PASS_NODES, &node->a[k]);
    }
#if POSITIONS_IN_TREE
    position->interval = 0.0;
    for (int k = 0; k < N_X; k++) {
        position->s[k] = interpolate_at_middle(node, PASS_NODES, &node->s[k]);
        position->s_rate[k] = interpolate_at_middle(node, PASS_NODES, &node->s_rate[k]);
        position->s_second[k] = interpolate_at_middle(node, PASS_NODES, &node->s_second[k]);
    }
#endif
    constraints(get_time_after_jump(t), position->q, p, phi);
    position->phi = 0.0;
    for (int r = 0; r < N_ALL_ROWS; r++)
        position->phi = get_larger_or_nan(position->phi, fabs(phi[r]));
}

/*
 * Compute the position at time t, at or near a change point, by interpolation on the smooth branch that leads there
 * from `start`. Up to PASS_TRIES node distances are tried, the first in which the fastest body turns by
 * PASS_NODE_ANGLE, each an eighth of the one before. Return 0, STOPPED, or the status of the last attempt.
 * NEWTON_FAILED: `start` is at rest or more than PASS_NODES nodes away, or the polynomials of two degrees differ by
 * more than PASS_POSITION_TOL.
 */
static int pass_change_point(KinematicRun *run, double t, const Position *start, Position *position)
{
    const double fastest = compute_scaled_max_norm(start->v, run->extent);
    double d = PASS_NODE_ANGLE / fastest;
    int status = NEWTON_FAILED;
    if (!(fastest > 0.0) || !(fabs(t - start->t) <= PASS_NODES * d))
        return status;
    for (int i = 0; i < PASS_TRIES && status != STOPPED; i++, d *= 0.125) {
        Position node[2 * PASS_NODES];
        double difference[N_Q];
        status = compute_branch_nodes(run, t, d, start, node);
        if (status)
            continue;
        interpolate_position(node, t, run->p, position);
        for (int k = 0; k < N_Q; k++)
            difference[k] = position->q[k] - interpolate_at_middle(node, PASS_NODES - 1, &node->q[k]);
        if (compute_scaled_max_norm(difference, run->extent) <= PASS_POSITION_TOL)
            return 0;
        status = NEWTON_FAILED;
    }
    return status;
}

/*
 * Solve the position at time t from the near position `start`; if that fails, interpolate it over a change point by
 * pass_change_point(). correction: set to the sum of Newton's corrections; 0 if interpolated. Return 0, or the status
 * of Newton's method if both fail.
 */
static int solve_position_over_change_point(KinematicRun *run, double t, const Position *start, Position *position,
    double *correction)
{
    const int status = solve_position_at(run, t, start, position, correction);
    if (!status || status == STOPPED || pass_change_point(run, t, start, position))
        return status;
    *correction = 0.0;
    return 0;
}

/*
 * Set `position` at time t to a state q, v (N_Q each), also at a change point. Also sets run->is_start_ill_conditioned.
 * If it is, the smooth branch replaces the state, provided that its velocities agree with v to PASS_RATE_TOL. Return 0
 * or a status. Called before the first step, and before each search for events.
 */
static int set_initial_position(KinematicRun *run, double t, const double *q, const double *v, Position *position)
{
    Position branch_position;
    double difference[N_Q];
    const int status = initialize_position(run, t, q, v, position);
    run->is_start_ill_conditioned = is_ill_conditioned(position);
    if (status < 0 || !run->is_start_ill_conditioned || pass_change_point(run, t, position, &branch_position))
        return status;
    for (int k = 0; k < N_Q; k++)
        difference[k] = branch_position.v[k] - v[k];
    if (!(compute_scaled_max_norm(difference, run->extent)
        <= PASS_RATE_TOL * compute_scaled_max_norm(position->v, run->extent)))
        return status;
    *position = branch_position;
    return 0;
}
