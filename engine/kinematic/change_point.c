/*
 * Change points: positions at which rows depend on each other and two branches of the motion meet, such as a
 * parallelogram with all links in one line. The rows alone tell neither the place nor its rates there, and near it they
 * tell them only roughly. The motion passes on the branch that is smooth: polynomials in time through regular places
 * before and after give the place.
 */
enum { PASS_NODES = 4 /* on either side */, PASS_TRIES = 3, PASS_HALVINGS = 8 };
#define PASS_TURN 1e-2   /* rad, or share of the mechanism's size, of the fastest coordinate between two nodes */
#define PASS_SMOOTH 1e-9 /* the same, that polynomials of two orders may differ */
#define PASS_RATES 1e-5  /* of the fastest rate, that the rates of a start may differ from those of a branch */
#define PASS_ROUGH 1e3   /* roundings of a coordinate that are left of Newton's method near such a position */

/* Whether Newton's method left more than rounding. */
static int is_rough(const Position *at)
{
    double size = 1.0;
    for (int k = 2; k < N_Q; k += 3)
        size = larger(size, fabs(at->q[k]));
    return !(at->left <= PASS_ROUGH * DBL_EPSILON * size);
}

/* From one regular place to another along the same branch, forwards or backwards in time. */
static int walk_to(Course *course, double t, const Position *from, Position *to)
{
    double h = t - from->t;
    *to = *from;
    for (int halvings = 0; to->t != t;) {
        Position next;
        double moved;
        const int status = bracket_point_at(course, fabs(h) < fabs(t - to->t) ? to->t + h : t, to, &next, &moved);
        if (status == STOPPED)
            return status;
        if (!status && moved <= course->reach && bend_between(to, &next, course->extent) <= 0.002 * course->reach) {
            *to = next;
            continue;
        }
        if (++halvings > PASS_HALVINGS)
            return status ? status : NEWTON_FAILED;
        h *= 0.5;
    }
    return update_modes(course, to);
}

/* node[2 j] and node[2 j + 1] lie j + 1 distances d before and after t. */
static int walk_to_nodes(Course *course, double t, double d, const Position *here, Position *node)
{
    int status = walk_to(course, t - d, here, &node[0]);
    if (!status)
        status = walk_to(course, t + d, &node[0], &node[1]);
    for (int j = 2; j < 2 * PASS_NODES && !status; j++)
        status = walk_to(course, t + (j % 2 ? 1 + j / 2 : -1 - j / 2) * d, &node[j - 2], &node[j]);
    return status;
}

/* The value in the middle of the polynomial through one number of the first n nodes on either side. */
static double middle_of(const Position *node, int n, const double *of_first)
{
    const size_t place = (size_t)((const char *)of_first - (const char *)node);
    double sum = 0.0;
    for (int j = 0; j < 2 * n; j++)
        sum += weight_at(n, j / 2 + 1) * *(const double *)((const char *)&node[j] + place);
    return sum;
}

static void interpolate_place(const Position *node, double t, const Parameters *p, Position *to)
{
    double phi[AT_LEAST_ONE(N_ALL_ROWS)];
    *to = node[0];
    to->t = t;
    to->interpolated = 1;
    to->left = 0.0;
    for (int k = 0; k < N_Q; k++) {
        to->q[k] = middle_of(node, PASS_NODES, &node->q[k]);
        to->v[k] = middle_of(node, PASS_NODES, &node->v[k]);
        to->a[k] = middle_of(node, PASS_NODES, &node->a[k]);
    }
#if POSITIONS_IN_TREE
    for (int k = 0; k < N_X; k++) {
        to->s[k] = middle_of(node, PASS_NODES, &node->s[k]);
        to->s_rate[k] = middle_of(node, PASS_NODES, &node->s_rate[k]);
        to->s_second[k] = middle_of(node, PASS_NODES, &node->s_second[k]);
    }
#endif
    constraints(beyond_jump(t), to->q, p, phi);
    to->phi = 0.0;
    for (int r = 0; r < N_ALL_ROWS; r++)
        to->phi = larger(to->phi, fabs(phi[r]));
}

/*
 * The place at t, at or near a change point, from `here` near by: on the branch that is smooth. 0, or why there is
 * none: nothing leads on, or what does is not smooth.
 */
static int pass_change_point(Course *course, double t, const Position *here, Position *to)
{
    const double fastest = turn_of(here->v, course->extent);
    double d = PASS_TURN / fastest;
    int status = NEWTON_FAILED;
    if (!(fastest > 0.0) || !(fabs(t - here->t) <= PASS_NODES * d))
        return status;
    for (int i = 0; i < PASS_TRIES && status != STOPPED; i++, d *= 0.125) {
        Position node[2 * PASS_NODES];
        double differs[N_Q];
        status = walk_to_nodes(course, t, d, here, node);
        if (status)
            continue;
        interpolate_place(node, t, course->p, to);
        for (int k = 0; k < N_Q; k++)
            differs[k] = to->q[k] - middle_of(node, PASS_NODES - 1, &node->q[k]);
        if (turn_of(differs, course->extent) <= PASS_SMOOTH)
            return 0;
        status = NEWTON_FAILED;
    }
    return status;
}

/* From one place to another near by, also where rows depend on each other there. */
static int place_near(Course *course, double t, const Position *from, Position *to, double *moved)
{
    const int status = bracket_point_at(course, t, from, to, moved);
    if (!status || status == STOPPED || pass_change_point(course, t, from, to))
        return status;
    *moved = 0.0;
    return 0;
}

/* A given place, also at a change point, where its velocities have to be those of one of the branches. */
static int begin_near(Course *course, double t, const double *q, const double *v, Position *here)
{
    Position passed;
    double differs[N_Q];
    const int status = begin(course, t, q, v, here);
    if (status < 0 || !is_rough(here) || pass_change_point(course, t, here, &passed))
        return status;
    for (int k = 0; k < N_Q; k++)
        differs[k] = passed.v[k] - v[k];
    if (!(turn_of(differs, course->extent) <= PASS_RATES * turn_of(here->v, course->extent)))
        return status;
    *here = passed;
    return 0;
}
