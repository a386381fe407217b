/*
 * Driven chains: coordinates that the drives determine through loops of their own. At every time Chebyshev's
 * method closes these loops, from where they were at the last state that was accepted: so the motion keeps its
 * branch, and the right-hand side stays a function of time and state.
 */
/*
 * Cosines and sines of all angles in the chains' closures, behind the coordinates in q.
 */
static void chain_directions(const double t, const double *q, const Memory *memory, const Parameters *p,
    double *out)
{
    (void)memory;
    /* coordinates, velocities, time */
    const double time = t;
    const double rod_theta = q[1];

    /* parameters */
    const double omega = p->omega;

    /* directions, arms, drives */
    const double motor_value = omega*time;

    /* directions */
    const Four angles_0 = {motor_value, rod_theta, rod_theta, rod_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    out[2] = cosines_0[0];  /* cos_theta_crank */
    out[3] = sines_0[0];  /* sin_theta_crank */
    out[4] = cosines_0[1];  /* cos_theta_rod */
    out[5] = sines_0[1];  /* sin_theta_rod */
}
/*
 * Newton's step of the driven chains' coordinates, Phi_c newton = Phi, and with it Chebyshev's of order 3,
 * step = newton + bend, Phi_c bend = Phi_cc[newton, newton]/2. `row`: the number, from 1, of the row with
 * the largest |Phi|. Returns 0, or the number of a row that depends on others here.
 */
static int chain_step(const double t, const double *q, const Memory *memory, const Parameters *p,
    double *step, double *bend, int *row)
{
    (void)t;
    (void)memory;
    /* coordinates, velocities, time */
    const double cos_theta_crank = q[2];
    const double cos_theta_rod = q[4];
    const double sin_theta_rod = q[5];

    /* parameters */
    const double crank_head_span_x = p->crank_head_span_x;
    const double rod_head_span_x = p->rod_head_span_x;

    /* directions, arms, drives */
    const double span_crank_head_x = cos_theta_crank*crank_head_span_x;
    const double span_rod_head_x = cos_theta_rod*rod_head_span_x;
    const double span_rod_head_y = rod_head_span_x*sin_theta_rod;

    /* closures of the chains */
    const double phi_guide_offset = -span_crank_head_x - span_rod_head_x;

    /* the largest */
    *row = 1;

    /* groups of rows that are solved one after the other */
    const double pivot_guide_offset = span_rod_head_y;
    const double size_guide_offset__rod_theta = fabs(span_rod_head_x) + fabs(span_rod_head_y);
    if (!(fabs(pivot_guide_offset) > 3.162277660168379e-07 * size_guide_offset__rod_theta)) return 1;
    const double inverse_guide_offset = 1.0/pivot_guide_offset;

    /* Newton's step */
    const double newton_rod_theta = inverse_guide_offset*phi_guide_offset;

    /* what the rows' curvature adds */
    const double bend_rod_theta = (0.5)*inverse_guide_offset*(newton_rod_theta *
        newton_rod_theta)*span_rod_head_x;
    step[0] = bend_rod_theta + newton_rod_theta;
    bend[0] = bend_rod_theta;
    return 0;
}
/*
 * First and second rates of the driven chains' coordinates, where these close their loops: Phi_c c' = nu,
 * Phi_c c'' = gamma. They go behind those of the other coordinates in v.
 * Returns 0, or the number of a row that depends on others here.
 */
static int chain_rates(const double t, const double *q, const Memory *memory, const Parameters *p, double *v)
{
    (void)t;
    (void)memory;
    /* coordinates, velocities, time */
    const double cos_theta_crank = q[2];
    const double sin_theta_crank = q[3];
    const double cos_theta_rod = q[4];
    const double sin_theta_rod = q[5];

    /* parameters */
    const double omega = p->omega;
    const double crank_head_span_x = p->crank_head_span_x;
    const double rod_head_span_x = p->rod_head_span_x;

    /* directions, arms, drives */
    const double motor_rate = omega;
    const double motor_acceleration = 0.0;
    const double span_crank_head_x = cos_theta_crank*crank_head_span_x;
    const double span_crank_head_y = crank_head_span_x*sin_theta_crank;
    const double span_rod_head_x = cos_theta_rod*rod_head_span_x;
    const double span_rod_head_y = rod_head_span_x*sin_theta_rod;

    /* groups of rows that are solved one after the other */
    const double pivot_guide_offset_2 = span_rod_head_y;
    const double size_guide_offset__rod_theta_2 = fabs(span_rod_head_x) + fabs(span_rod_head_y);
    if (!(fabs(pivot_guide_offset_2) > 3.162277660168379e-07 * size_guide_offset__rod_theta_2)) return 1;
    const double inverse_guide_offset_2 = 1.0/pivot_guide_offset_2;

    /* rates */
    const double rate_rod_theta = -inverse_guide_offset_2*motor_rate*span_crank_head_y;
    const double rod_omega = rate_rod_theta;

    /* second rates */
    const double second_rod_theta = inverse_guide_offset_2*(-motor_acceleration*span_crank_head_y -
        (motor_rate * motor_rate)*span_crank_head_x - (rod_omega * rod_omega)*span_rod_head_x);

    /* results */
    v[1] = rod_omega;
    v[2] = second_rod_theta;
    return 0;
}
/*
 * Third rates of the driven chains' coordinates: Phi_c c''' = d/dt (gamma - Phi_c c'') at the same c''.
 * Returns 0, or the number of a row that depends on others here.
 */
static int chain_third(const double t, const double *q, const double *v, const Memory *memory, const
    Parameters *p, double *out)
{
    (void)t;
    (void)memory;
    /* coordinates, velocities, time */
    const double rod_omega = v[1];
    const double cos_theta_crank = q[2];
    const double sin_theta_crank = q[3];
    const double cos_theta_rod = q[4];
    const double sin_theta_rod = q[5];
    const double rod_theta_second = v[2];

    /* parameters */
    const double omega = p->omega;
    const double crank_head_span_x = p->crank_head_span_x;
    const double rod_head_span_x = p->rod_head_span_x;

    /* directions, arms, drives */
    const double motor_rate = omega;
    const double motor_acceleration = 0.0;
    const double span_crank_head_x = cos_theta_crank*crank_head_span_x;
    const double span_crank_head_y = crank_head_span_x*sin_theta_crank;
    const double span_rod_head_x = cos_theta_rod*rod_head_span_x;
    const double span_rod_head_y = rod_head_span_x*sin_theta_rod;

    /* groups of rows that are solved one after the other */
    const double pivot_guide_offset_3 = span_rod_head_y;
    const double size_guide_offset__rod_theta_3 = fabs(span_rod_head_x) + fabs(span_rod_head_y);
    if (!(fabs(pivot_guide_offset_3) > 3.162277660168379e-07 * size_guide_offset__rod_theta_3)) return 1;
    const double inverse_guide_offset_3 = 1.0/pivot_guide_offset_3;

    /* third rates */
    const double span_crank_head_x_by_time = -motor_rate*span_crank_head_y;
    const double span_crank_head_y_by_time = motor_rate*span_crank_head_x;
    const double span_rod_head_x_by_time = -rod_omega*span_rod_head_y;
    const double span_rod_head_y_by_time = rod_omega*span_rod_head_x;
    const double third_rod_theta =
        inverse_guide_offset_3*(-2.0*motor_acceleration*motor_rate*span_crank_head_x -
        motor_acceleration*span_crank_head_y_by_time - (motor_rate * motor_rate)*span_crank_head_x_by_time -
        (rod_omega * rod_omega)*span_rod_head_x_by_time - 2.0*rod_omega*rod_theta_second*span_rod_head_x -
        rod_theta_second*span_rod_head_y_by_time);
    out[0] = third_rod_theta;
    return 0;
}


enum { MAX_CHAIN_STEPS = 8, MAX_CHAIN_PARTS = 60 };
#define CHAIN_REACH 0.1    /* rad, or share of the mechanism's size: a longer way to the root is made in parts */
#define CHAIN_STRAIGHT 1e-3 /* the same, that positions may differ from what rates at both ends of a part tell */

/* Everything that the tree's kernels read at one time: of driven chains directions, second and third rates too. */
typedef struct {
    double q[N_X + N_LED], v[N_X + 3 * N_CHAIN];
} TreeState;

#define TURN_SMALL 0.01 /* rad: below it the series of turn_back are exact to rounding */

/* Cosine and sine of an angle that became smaller by x. */
static inline void turn_back(double *direction, double x)
{
    const double z = x * x, c = direction[0], s = direction[1];
    const double sine = x * (1.0 - (1.0 / 6.0) * z * (1.0 - 0.05 * z));
    const double less = 0.5 * z * (1.0 - (1.0 / 12.0) * z * (1.0 - (1.0 / 30.0) * z));
    direction[0] = c + (s * sine - c * less);
    direction[1] = s - (c * sine + s * less);
}

/*
 * Chebyshev's method on the chains' closures. Of two steps that Newton would make the second is the bend, and what is
 * left behind it some bend^2/step; a bend that is not much smaller than its step belongs to no root near by
 * (L. V. Kantorovich). Returns 0, or the number of a closure; `moved` is the way.
 */
static int close_chains(double t, double *q, const Memory *memory, const Parameters *p, double *moved)
{
    const double share[] = {1.0};
    double step[N_CHAIN], bend[N_CHAIN];
    int row = 1;
    (void)p;
    *moved = 0.0;
    chain_directions(t, q, memory, p, q);
    for (int i = 0; i < MAX_CHAIN_STEPS; i++) {
        double size = 0.0, bent = 0.0, sum = 0.0;
        const int status = chain_step(t, q, memory, p, step, bend, &row);
        if (status)
            return status;
        for (int k = 0; k < N_CHAIN; k++) {
            size = max_of(size, fabs(step[k]) * share[k]);
            bent = max_of(bent, fabs(bend[k]) * share[k]);
            sum += step[k];
            q[N_X + k] -= step[k];
        }
        *moved += size;
        if (size > TURN_SMALL) {
            chain_directions(t, q, memory, p, q);
        } else {
            turn_back(q + 4, step[0]);
        }
        if (!isfinite(sum) || bent > 0.25 * size)
            return row;
        /* the bend may vanish where the cube of the step still counts */
        if ((4.0 * bent * bent < 1e-17 * size && size * size * size < 1e-17) || size < 1e-15)
            return 0;
    }
    return *moved < 1e-9 ? 0 : row;
}

/* A place of the chains, for the next time that it is asked for. */
static inline void note_chains(double t, const TreeState *at, Chain *place)
{
    place->t = t;
    for (int k = 0; k < N_LED; k++)
        place->q[k] = at->q[N_X + k];
    for (int k = 0; k < 2 * N_CHAIN; k++)
        place->v[k] = at->v[N_X + k];
}

/* The place of the chains from which they are followed, with third rates. */
static int keep_chains(double t, const TreeState *at, Memory *memory, const Parameters *p)
{
    note_chains(t, at, &memory->chain);
    const int status = chain_third(t, at->q, at->v, memory, p, memory->chain.v + 2 * N_CHAIN);
    memory->chain.failed = status;
    memory->recent = memory->chain;
    return status;
}

/* Such a place again; its third rates are asked for where they are needed. */
static void recall_chains(const Chain *from, TreeState *at)
{
    for (int k = 0; k < N_LED; k++)
        at->q[N_X + k] = from->q[k];
    for (int k = 0; k < 2 * N_CHAIN; k++)
        at->v[N_X + k] = from->v[k];
}

/* What Euler and Maclaurin's rule leaves over between two places, the most; lengths by the size. */
static double chain_bend(double h, const Chain *a, const TreeState *b, const Parameters *p)
{
    const double share[] = {1.0};
    const double *q = b->q + N_X, *rate = b->v + N_X, *second = rate + N_CHAIN;
    double most = 0.0;
    (void)p;
    for (int k = 0; k < N_CHAIN; k++) {
        const double way = 0.5 * h * (a->v[k] + rate[k] + (1.0 / 6.0) * h * (a->v[N_CHAIN + k] - second[k]));
        most = max_of(most, share[k] * fabs(q[k] - a->q[k] - way));
    }
    return most;
}

/* From one place of the chains to another near by; 0, or the number of a closure where the way is not certain. */
static int move_chains(double t, const Chain *from, const Memory *memory, const Parameters *p, TreeState *at)
{
    const double h = t - from->t, *rate = from->v, *second = rate + N_CHAIN, *third = second + N_CHAIN;
    double moved;
    for (int k = 0; k < N_CHAIN; k++)
        at->q[N_X + k] = from->q[k] + h * (rate[k] + 0.5 * h * (second[k] + (1.0 / 3.0) * h * third[k]));
    int status = close_chains(t, at->q, memory, p, &moved);
    if (!status)
        status = chain_rates(t, at->q, memory, p, at->v);
    if (status)
        return status;
    return moved <= CHAIN_REACH && chain_bend(h, from, at, p) <= CHAIN_STRAIGHT ? 0 : 1;
}

/* The chains at time t where one step there is too long: in parts; 0, or the number of a closure that cannot follow. */
static int follow_in_parts(double t, const Memory *memory, const Parameters *p, TreeState *at)
{
    Chain here = memory->chain;
    double h = 0.5 * (t - here.t);
    int status = 1;
    for (int part = 0; part < MAX_CHAIN_PARTS; part++) {
        const int last = fabs(h) >= fabs(t - here.t);
        const double next = last ? t : here.t + h;
        status = move_chains(next, &here, memory, p, at);
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
        chain_third(next, at->q, at->v, memory, p, here.v + 2 * N_CHAIN);
        h *= 2.0;
    }
    return status ? status : 1;
}

/*
 * The chains at time t, as they were found there the last time, or from the last state that was accepted. Returns 0,
 * or the number of a closure that cannot follow.
 */
static inline int follow_chains(double t, const Memory *memory, const Parameters *p, TreeState *at)
{
    if (memory->chain.failed)
        return memory->chain.failed;
    if (memory->recent.t == t) {
        recall_chains(&memory->recent, at);
        return 0;
    }
    return move_chains(t, &memory->chain, memory, p, at) ? follow_in_parts(t, memory, p, at) : 0;
}

/*
 * All that the tree's kernels read at (t, y); several stages of a method lie at one time. A status counts on behind
 * the pivots.
 */
static inline int tree_state(double t, const double *y, Memory *memory, const Parameters *p, TreeState *at)
{
    const int status = follow_chains(t, memory, p, at);
    if (!status && memory->recent.t != t)
        note_chains(t, at, &memory->recent);
    for (int k = 0; k < N_X; k++) {
        at->q[k] = y[k];
        at->v[k] = y[N_X + k];
    }
    return status ? 0 + status : 0;
}

/* The chains at t from a first guess (N_CHAIN) of their coordinates, as those from where they are followed. */
static void seat_chains(double t, const double *guess, Memory *memory, const Parameters *p)
{
    TreeState at = {0};
    double moved;
    for (int k = 0; k < N_CHAIN; k++)
        at.q[N_X + k] = guess[k];
    int status = close_chains(t, at.q, memory, p, &moved);
    if (!status)
        status = chain_rates(t, at.q, memory, p, at.v);
    const int last = keep_chains(t, &at, memory, p);
    memory->chain.failed = status ? status : last;
}

/* What is integrated: coordinates of the tree that are free, their rates, works. Driven chains are evaluated. */
static int motion(double t, const double *y, Memory *memory, const Parameters *p, double *dy, Aside *aside)
{
    TreeState at;
    int status = tree_state(t, y, memory, p, &at);
    if (status)
        return status;
    status = reduced_dynamics(t, at.q, at.v, memory, p, dy + N_X, aside);
    for (int k = 0; k < N_X; k++)
        dy[k] = y[N_X + k];
    for (int k = 0; k < N_WORK; k++)
        dy[2 * N_X + k] = aside->power[k];
    return status;
}

/*
 * The chains where they lie flat and nothing closes them: from a place so near that its rates tell the way to there.
 * If there is none, where they were a moment ago.
 */
static void beside_flat(double t, const double *y, const Memory *memory, const Parameters *p, TreeState *at)
{
    double fastest = 1e-300;
    for (int k = 0; k < N_CHAIN; k++)
        fastest = max_of(fastest, fabs(memory->chain.v[k]));
    for (double e = 1e-7; e < 0.05; e *= 10.0)
        for (int side = -1; side <= 1; side += 2) {
            const double h = side * e / fastest;
            Memory now = *memory;
            if (tree_state(t - h, y, &now, p, at))
                continue;
            for (int k = 0; k < N_CHAIN; k++) {
                at->q[N_X + k] += h * (at->v[N_X + k] + 0.5 * h * at->v[N_X + N_CHAIN + k]);
                at->v[N_X + k] += h * at->v[N_X + N_CHAIN + k];
            }
            chain_directions(t, at->q, memory, p, at->q);
            return;
        }
    recall_chains(&memory->chain, at);
}

/* The state of all bodies, (q, v, work). */
static void to_absolute(double t, const double *y, const Memory *memory, const Parameters *p, double *all)
{
    TreeState at;
    Memory now = *memory;
    if (tree_state(t, y, &now, p, &at))
        beside_flat(t, y, memory, p, &at);
    expand(t, at.q, at.v, p, all, all + N_Q);
    for (int k = 0; k < N_WORK; k++)
        all[2 * N_Q + k] = y[2 * N_X + k];
}

static void from_absolute(double t, const double *all, Memory *memory, const Parameters *p, double *y)
{
    TreeState at;
    reduce_state(t, all, all + N_Q, p, at.q, at.v);
    seat_chains(t, at.q + N_X, memory, p);
    for (int k = 0; k < N_X; k++) {
        y[k] = at.q[k];
        y[N_X + k] = at.v[k];
    }
    for (int k = 0; k < N_WORK; k++)
        y[2 * N_X + k] = all[2 * N_Q + k];
}

/*
 * Calls from outside into the reduced formulation; q and v are tree coordinates here. Behind those that are free q
 * holds a first guess of the driven chains' coordinates, which are closed first.
 */
static int outside_state(double t, const double *q, const double *v, Memory *memory, const Parameters *p, TreeState *at)
{
    double y[N_Y];
    for (int k = 0; k < N_X; k++) {
        y[k] = q[k];
        y[N_X + k] = v[k];
    }
    seat_chains(t, q + N_X, memory, p);
    return tree_state(t, y, memory, p, at);
}

void gudgeon_expand(double t, const double *q, const double *v, const double *p, double *all_q, double *all_v)
{
    Memory now = {0};
    TreeState at = {0};
    outside_state(t, q, v, &now, (const Parameters *)p, &at);
    expand(t, at.q, at.v, (const Parameters *)p, all_q, all_v);
}

void gudgeon_reduce(double t, const double *all_q, const double *all_v, const double *p, double *q, double *v)
{
    reduce_state(t, all_q, all_v, (const Parameters *)p, q, v);
}

int gudgeon_reduced_rhs(double t, const double *q, const double *v, const double *memory, const double *p, double *a,
    double *lambda, double *power)
{
    Memory now = {0};
    Aside aside;
    TreeState at;
    read_memory(memory, &now);
    int status = outside_state(t, q, v, &now, (const Parameters *)p, &at);
    if (status)
        return status;
    status = reduced_dynamics(t, at.q, at.v, &now, (const Parameters *)p, a, &aside);
    for (int r = 0; r < N_LOOPS; r++)
        lambda[r] = aside.lambda[r];
    for (int k = 0; k < N_WORK; k++)
        power[k] = aside.power[k];
    return status;
}

void gudgeon_closures(double t, const double *q, const double *v, const double *p, double *phi, double *phi_dot)
{
    Memory now = {0};
    TreeState at = {0};
    outside_state(t, q, v, &now, (const Parameters *)p, &at);
    closures(t, at.q, (const Parameters *)p, phi);
    closure_rates(t, at.q, at.v, (const Parameters *)p, phi_dot);
}

int gudgeon_reduced_project(double t, const double *q, const double *r, const double *p, double *x)
{
    Memory now = {0};
    TreeState at;
    const int status = outside_state(t, q, q, &now, (const Parameters *)p, &at);
    return status ? status : reduced_project(t, at.q, r, (const Parameters *)p, x);
}

/* The coordinates of the driven chains at t, from the guess in q (N_CHAIN), and three rates of each (3 N_CHAIN). */
int gudgeon_chains(double t, double *q, const double *p, double *v)
{
    Memory now = {0};
    seat_chains(t, q, &now, (const Parameters *)p);
    for (int k = 0; k < N_CHAIN; k++)
        q[k] = now.chain.q[k];
    for (int k = 0; k < 3 * N_CHAIN; k++)
        v[k] = now.chain.v[k];
    return now.chain.failed;
}

/*
 * The reduced right-hand side many times over, for benchmarks; each call waits for the one before. The chains are
 * closed from where they were a step earlier, in which the first of them turned by a tenth or so, each time anew.
 */
double gudgeon_time_reduced(long count, double t, const double *q, const double *v, const double *memory,
    const double *parameters)
{
    const Parameters *p = (const Parameters *)parameters;
    double dy[N_Y], y[N_Y], sum = 0.0;
    Memory now = {0};
    Aside aside;
    read_memory(memory, &now);
    seat_chains(t, q + N_X, &now, p);
    const double speed = hypot(now.chain.v[0], 1e-6), ahead = 0.1 / speed;
    for (int k = 0; k < N_X; k++) {
        y[k] = q[k];
        y[N_X + k] = v[k];
    }
    for (long i = 0; i < count; i++) {
        motion(t + (i % 2 ? ahead : 0.9 * ahead), y, &now, p, dy, &aside);
        sum += dy[N_X];
        y[0] = q[0] + 1e-300 * sum;
    }
    return sum;
}
