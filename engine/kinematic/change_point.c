/*
 * Change points: positions at which constraint equations depend on each other and two branches of the motion meet, such
 * as a parallelogram with all links in line. The equations determine neither position nor rates there, and are
 * ill-conditioned near it. The motion passes on the smooth branch, by polynomials in time through regular positions
 * before and after.
 */
enum { PASS_NODES = 4 /* on either side */, PASS_TRIES = 3, PASS_HALVINGS = 8 };
#define PASS_TURN 1e-2   /* rad, or fraction of the size: motion of the fastest coordinate between two nodes */
#define PASS_SMOOTH 1e-9 /* the same: largest difference of polynomials of two degrees */
#define PASS_RATES 1e-5  /* of the fastest rate: largest difference of a start from a branch */
#define PASS_ROUGH 1e3   /* ulp of a coordinate: smallest last correction near such a position */

/* Return whether the last correction of Newton's method is larger than rounding, as near a change point. */
static int is_ill_conditioned(const Position *at)
{
    double size = 1.0;
    for (int k = 2; k < N_Q; k += 3)
        size = larger_or_nan(size, fabs(at->q[k]));
    return !(at->last_correction <= PASS_ROUGH * DBL_EPSILON * size);
}

/* Follow the branch from one regular position to time t, forwards or backwards. Returns a status. */
static int follow_to(KinematicRun *run, double t, const Position *from, Position *to)
{
    double h = t - from->t;
    *to = *from;
    for (int halvings = 0; to->t != t;) {
        Position next;
        double moved;
        const int status = solve_position_at(run, fabs(h) < fabs(t - to->t) ? to->t + h : t, to, &next, &moved);
        if (status == STOPPED)
            return status;
        if (!status && moved <= run->reach && trapezoidal_error(to, &next, run->extent) <= 0.002 * run->reach) {
            *to = next;
            continue;
        }
        if (++halvings > PASS_HALVINGS)
            return status ? status : NEWTON_FAILED;
        h *= 0.5;
    }
    return complete_position(run, to);
}

/*
 * Compute 2 PASS_NODES regular positions: node[2 j] and node[2 j + 1] are j + 1 intervals d (s) before and after t.
 * Returns a status.
 */
static int follow_to_nodes(KinematicRun *run, double t, double d, const Position *here, Position *node)
{
    int status = follow_to(run, t - d, here, &node[0]);
    if (!status)
        status = follow_to(run, t + d, &node[0], &node[1]);
    for (int j = 2; j < 2 * PASS_NODES && !status; j++)
        status = follow_to(run, t + (j % 2 ? 1 + j / 2 : -1 - j / 2) * d, &node[j - 2], &node[j]);
    return status;
}

/*
 * Return the value at the middle of the polynomial through one number of the first n nodes on either side. of_first:
 * address of that number in the first node.
 */
static double interpolate_middle(const Position *node, int n, const double *of_first)
{
    const size_t place = (size_t)((const char *)of_first - (const char *)node);
    double sum = 0.0;
    for (int j = 0; j < 2 * n; j++)
        sum += weight_at(n, j / 2 + 1) * *(const double *)((const char *)&node[j] + place);
    return sum;
}

/* Interpolate the position at time t from the nodes on both sides, with its largest |Phi|. */
static void interpolate_position(const Position *node, double t, const Parameters *p, Position *to)
{
    double phi[AT_LEAST_ONE(N_ALL_ROWS)];
    *to = node[0];
    to->t = t;
    to->interpolated = 1;
    to->last_correction = 0.0;
    for (int k = 0; k < N_Q; k++) {
        to->q[k] = interpolate_middle(node, PASS_NODES, &node->q[k]);
        to->v[k] = interpolate_middle(node, PASS_NODES, &node->v[k]);
        to->a[k] = interpolate_middle(node, PASS_NODES, &node->a[k]);
    }
#if POSITIONS_IN_TREE
    for (int k = 0; k < N_X; k++) {
        to->s[k] = interpolate_middle(node, PASS_NODES, &node->s[k]);
        to->s_rate[k] = interpolate_middle(node, PASS_NODES, &node->s_rate[k]);
        to->s_second[k] = interpolate_middle(node, PASS_NODES, &node->s_second[k]);
    }
#endif
    constraints(after_jump(t), to->q, p, phi);
    to->phi = 0.0;
    for (int r = 0; r < N_ALL_ROWS; r++)
        to->phi = larger_or_nan(to->phi, fabs(phi[r]));
}

/*
 * Compute the position at time t, at or near a change point, on the smooth branch that leads there from `here`. Returns
 * 0, or a status if no branch continues, or the polynomials do not agree.
 */
static int pass_change_point(KinematicRun *run, double t, const Position *here, Position *to)
{
    const double fastest = angle_norm(here->v, run->extent);
    double d = PASS_TURN / fastest;
    int status = NEWTON_FAILED;
    if (!(fastest > 0.0) || !(fabs(t - here->t) <= PASS_NODES * d))
        return status;
    for (int i = 0; i < PASS_TRIES && status != STOPPED; i++, d *= 0.125) {
        Position node[2 * PASS_NODES];
        double differs[N_Q];
        status = follow_to_nodes(run, t, d, here, node);
        if (status)
            continue;
        interpolate_position(node, t, run->p, to);
        for (int k = 0; k < N_Q; k++)
            differs[k] = to->q[k] - interpolate_middle(node, PASS_NODES - 1, &node->q[k]);
        if (angle_norm(differs, run->extent) <= PASS_SMOOTH)
            return 0;
        status = NEWTON_FAILED;
    }
    return status;
}

/* Solve the position at time t from a near one, also at a change point. Returns a status. */
static int solve_position_near(KinematicRun *run, double t, const Position *from, Position *to, double *moved)
{
    const int status = solve_position_at(run, t, from, to, moved);
    if (!status || status == STOPPED || pass_change_point(run, t, from, to))
        return status;
    *moved = 0.0;
    return 0;
}

/*
 * Begin at given q and v (N_Q), also at a change point, where the velocities must be those of the smooth branch.
 * Returns a status.
 */
static int set_position_near(KinematicRun *run, double t, const double *q, const double *v, Position *here)
{
    Position passed;
    double differs[N_Q];
    const int status = set_position(run, t, q, v, here);
    if (status < 0 || !is_ill_conditioned(here) || pass_change_point(run, t, here, &passed))
        return status;
    for (int k = 0; k < N_Q; k++)
        differs[k] = passed.v[k] - v[k];
    if (!(angle_norm(differs, run->extent) <= PASS_RATES * angle_norm(here->v, run->extent)))
        return status;
    *here = passed;
    return 0;
}
