/*
 * The runs of a batch by rk4 with one step for all, several side by side (lanes.h). Steps on which nothing happens
 * but motion are made here; one on which in any lane a contact begins or ends, a watched expression crosses zero,
 * a pivot vanishes or a number ceases to be finite is made by the single runs themselves (rk4.c, many.c), each
 * for its own. A library of its own, compiled when it is first asked for.
 */
#include "model.h"
#include "batch.h"
#include "lanes.h"
#include <time.h>

enum { LANE_JOINTS = 1, LANE_EVENTS = 1, EVENTS_FULL = -3 };

typedef struct {
    Lanes height;
    Lanes ball_mass;
    Lanes ball_inertia;
    Lanes alpha;
    Lanes beta;
    Lanes floor_radius;
    Lanes floor_clearance;
    Lanes floor_length;
    Lanes steel_E;
    Lanes steel_nu;
    Lanes damped_normal_stiffness;
    Lanes damped_normal_exponent;
    Lanes damped_normal_restitution;
    Lanes velocity_floor;
    Lanes par_y;
    Lanes R_j_floor;
    Lanes damped_floor_hysteresis;
    Lanes weight_ball_y;
    Lanes two_alpha;
    Lanes beta_squared;
    Lanes inverse_ball_mass;
    Lanes inverse_ball_inertia;
} LaneParameters;

_Static_assert(sizeof(LaneParameters) / sizeof(Lanes) == sizeof(Parameters) / sizeof(double), "the same numbers");

typedef struct {
    Lanes t, steps, evaluations, y[N_Y], dy[N_Y];
    Lanes phi_max, phi_dot_max, ratio_min, ratio_max, ratio_outside;
    struct LaneLatch {
        Lanes closed, deltadot_minus, compressing; /* 0 or 1, m/s, 0 or 1 */
        Lanes e, delta, deltadot, F_peak, t_peak, e_max;
        Lanes F_open, t_open;                      /* peak of the contact that goes on */
    } latch[1];
    Lanes event_side[1];
} LaneRun;

typedef struct LaneLatch LaneLatch;

typedef struct {
    Lanes n, t, M_i, M_j;
} LanePinForce;

typedef struct {
    Lanes Fx, Fy, F_n, F_t, e, deltadot, delta, moment_first, moment_second, power;
} LaneClearance;

typedef struct {
    Lanes lambda[N_LOOPS + 1], power[N_WORK], event[LANE_EVENTS];
    LaneClearance clearance[LANE_JOINTS];
} LaneAside;

/*
 * Hertz contact with a given stiffness and hysteresis damping.
 * Source: H. Hertz (1881); K. H. Hunt, F. R. E. Crossley, J. Appl. Mech. 42 (1975) 440-445.
 * Valid: a point or a line contact whose stiffness is known; penetrations small against the radii.
 * Options: dissipation: hunt_crossley.
 */
static inline void normal_fall_force(Lanes delta, Lanes ratio, const LaneParameters *p, Lanes *F_n_out)
{
    /* parameters */
    const Lanes damped_normal_stiffness = p->damped_normal_stiffness;
    const Lanes damped_normal_exponent = p->damped_normal_exponent;
    const Lanes damped_floor_hysteresis = p->damped_floor_hysteresis;

    /* law of joint fall */
    const Lanes side_0 = lanes_sign_of(damped_floor_hysteresis*ratio + 1.0);
    *F_n_out = damped_normal_stiffness*lanes_pow(delta, damped_normal_exponent)*pick(side_0 < 0.0,
        all_of(0.0), damped_floor_hysteresis*ratio + 1.0);
}

/*
 * No friction in this joint.
 */
static inline void friction_fall_force(Lanes F_n, Lanes v_t, const LaneParameters *p, Lanes *F_t_out)
{
    (void)F_n;
    (void)v_t;
    (void)p;
    /* no friction law */
    *F_t_out = all_of(0.0);
}

/* Dry contact in joint fall, as in clearance.c. */
static inline LanePinForce dry_fall(Lanes delta, Lanes deltadot, Lanes de_t, Lanes omega_i, Lanes omega_j,
    const LaneLatch *latch, const LaneParameters *p)
{
    const Lanes ratio = pick(latch->closed > 0.0, deltadot / latch->deltadot_minus, all_of(1.0));
    const Lanes a_i = (0.5)*delta + p->floor_radius;
    const Lanes a_j = -0.5*delta + p->R_j_floor;
    const Lanes v_t = -a_i*omega_i + a_j*omega_j + de_t;
    Lanes F_n, F_along_t_dry;
    normal_fall_force(lanes_max_of(delta, all_of(0.0)), ratio, p, &F_n);
    friction_fall_force(F_n, v_t, p, &F_along_t_dry);
    const Lanes M_i_dry = -F_along_t_dry*a_i;
    const Lanes M_j_dry = F_along_t_dry*a_j;
    return (LanePinForce){-F_n, F_along_t_dry, M_i_dry, M_j_dry};
}

/* Joint fall: what each lane does not have is passed over where no lane has it. */
static void clearance_fall(Lanes e_x, Lanes e_y, Lanes de_x, Lanes de_y, Lanes omega_i, Lanes omega_j,
    const LaneLatch *latch, const LaneParameters *p, LaneClearance *out)
{
    const Lanes e = lanes_sqrt((e_x * e_x) + (e_y * e_y));
    const Lanes inverse_e = 1.0/e;
    const Lanes n_x = pick(e > 0.0, e_x*inverse_e, all_of(1.0));
    const Lanes n_y = pick(e > 0.0, e_y*inverse_e, all_of(0.0));
    const Lanes delta = e - p->floor_clearance;
    const Lanes deltadot = de_x*n_x + de_y*n_y;
    const Lanes de_t = -de_x*n_y + de_y*n_x;
    LanePinForce F = {all_of(0.0), all_of(0.0), all_of(0.0), all_of(0.0)};
    const LaneBits touching = delta > 0.0;
    if (any_of(touching)) {
        LanePinForce dry = dry_fall(delta, deltadot, de_t, omega_i, omega_j, latch, p);
        F.n = pick(touching, dry.n, F.n);
        F.t = pick(touching, dry.t, F.t);
        F.M_i = pick(touching, dry.M_i, F.M_i);
        F.M_j = pick(touching, dry.M_j, F.M_j);
    }
    *out = (LaneClearance){.Fx = F.n * n_x - F.t * n_y, .Fy = F.n * n_y + F.t * n_x, .F_n = F.n, .F_t = F.t, .e = e,
        .deltadot = deltadot, .delta = delta, .moment_first = F.M_i, .moment_second = F.M_j};
}

/*
 * Phi of the loop closures in tree coordinates; m and rad.
 */
static void closures(const Lanes t, const Lanes *q, const LaneParameters *p, Lanes *out, LaneBits *rare)
{
    (void)t;
    (void)q;
    (void)p;
    (void)out;
    (void)rare;

}

/*
 * Its rate Phi_q v - nu.
 */
static void closure_rates(const Lanes t, const Lanes *q, const Lanes *v, const LaneParameters *p, Lanes *out,
    LaneBits *rare)
{
    (void)t;
    (void)q;
    (void)v;
    (void)p;
    (void)out;
    (void)rare;

}

/*
 * Accelerations a of the tree's coordinates q, and the closures' multipliers in `aside`:
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma] with M, Phi_q, g in these coordinates; drifts are projected away.
 * Returns 0, or the number of the pivot that vanished where the rows contradict each other.
 */
static void reduced_dynamics(const Lanes t, const Lanes *q, const Lanes *v, const LaneRun *memory, const
    LaneParameters *p, Lanes *a, LaneAside *aside, LaneBits *rare)
{
    (void)t;
    (void)rare;
    /* coordinates, velocities, time */
    const Lanes ball_x = q[0];
    const Lanes ball_x_rate = v[0];
    const Lanes ball_y = q[1];
    const Lanes ball_y_rate = v[1];
    const Lanes ball_omega = v[2];

    /* parameters */
    const Lanes weight_ball_y = p->weight_ball_y;
    const Lanes inverse_ball_mass = p->inverse_ball_mass;
    const Lanes inverse_ball_inertia = p->inverse_ball_inertia;

    /* clearance joint fall */
    const Lanes e_fall_x = ball_x;
    const Lanes e_fall_y = ball_y;
    const Lanes edot_fall_x = ball_x_rate;
    const Lanes edot_fall_y = ball_y_rate;
    clearance_fall(e_fall_x, e_fall_y, edot_fall_x, edot_fall_y, all_of(0.0), ball_omega, &memory->latch[0], p, &aside->clearance[0]);
    const Lanes F_fall_x = aside->clearance[0].Fx;
    const Lanes F_fall_y = aside->clearance[0].Fy;
    const Lanes M_fall_second = aside->clearance[0].moment_second;
    aside->clearance[0].power = F_fall_x*edot_fall_x + F_fall_y*edot_fall_y + M_fall_second*ball_omega;

    /* forward substitution */
    const Lanes z_ball_y = F_fall_y + weight_ball_y;

    /* backward substitution */
    const Lanes acceleration_ball_theta = M_fall_second*inverse_ball_inertia;
    const Lanes acceleration_ball_y = inverse_ball_mass*z_ball_y;
    const Lanes acceleration_ball_x = F_fall_x*inverse_ball_mass;

    /* results */
    a[0] = acceleration_ball_x;
    a[1] = acceleration_ball_y;
    a[2] = acceleration_ball_theta;
    aside->power[0] = all_of(0.0);
    aside->power[1] = all_of(0.0);
    aside->power[2] = aside->clearance[0].power;
}

/*
 * The smallest dq and dv (n), measured by M, with Phi_q dq = Phi and Phi_q dv = Phi_dot, to be subtracted.
 * `worst`: the largest |Phi|. Returns 0, or the number of the pivot that vanished.
 */
static void closing_step(const Lanes t, const Lanes *q, const Lanes *v, const LaneRun *memory, const
    LaneParameters *p, Lanes *dq, Lanes *dv, Lanes *worst, LaneBits *rare)
{
    (void)t;
    (void)q;
    (void)v;
    (void)memory;
    (void)p;
    (void)rare;
    /* backward substitution */
    const Lanes dq_acceleration_ball_theta = all_of(0.0);
    const Lanes dq_acceleration_ball_y = all_of(0.0);
    const Lanes dq_acceleration_ball_x = all_of(0.0);

    /* backward substitution */
    const Lanes dv_acceleration_ball_theta = all_of(0.0);
    const Lanes dv_acceleration_ball_y = all_of(0.0);
    const Lanes dv_acceleration_ball_x = all_of(0.0);

    /* results */
    dq[0] = dq_acceleration_ball_x;
    dv[0] = dv_acceleration_ball_x;
    dq[1] = dq_acceleration_ball_y;
    dv[1] = dv_acceleration_ball_y;
    dq[2] = dq_acceleration_ball_theta;
    dv[2] = dv_acceleration_ball_theta;
    *worst = all_of(0.0);
}

static void motion(Lanes t, const Lanes *y, const LaneRun *x, const LaneParameters *p, Lanes *dy, LaneAside *aside,
    LaneBits *rare)
{
    reduced_dynamics(t, y, y + N_X, x, p, dy + N_X, aside, rare);
    for (int k = 0; k < N_X; k++)
        dy[k] = y[N_X + k];
    for (int k = 0; k < N_WORK; k++)
        dy[2 * N_X + k] = aside->power[k];
}

static LaneBits not_finite(const Lanes *a, const Lanes *b, int n)
{
    Lanes sum = all_of(0.0);
    for (int k = 0; k < n; k++)
        sum += b ? a[k] + b[k] : a[k];
    return ~(lanes_fabs(sum) <= DBL_MAX);
}

/* As project_state of step.c: each lane is left as it is once it is closed. */
static void project_state(Lanes t, Lanes *y, const LaneRun *x, const LaneParameters *p, LaneBits *rare)
{
    LaneBits open = ~(LaneBits){0};
    for (int pass = 0; pass < 3 && N_LOOPS > 0 && any_of(open); pass++) {
        Lanes dq[N_X], dv[N_X], worst;
        closing_step(t, y, y + N_X, x, p, dq, dv, &worst, rare);
        *rare |= open & (not_finite(dq, NULL, N_X) | not_finite(dv, NULL, N_X));
        for (int k = 0; k < N_X; k++) {
            y[k] = pick(open, y[k] - dq[k], y[k]);
            y[N_X + k] = pick(open, y[N_X + k] - dv[k], y[N_X + k]);
        }
        open &= ~(worst < 1e-15);
    }
}

/*
 * Lanes in which a contact begins, ends or is touched within the step or goes too deep, or an event's expression
 * changes its side, is zero or no number.
 */
static LaneBits happens(const LaneRun *x, const LaneAside *aside, const LaneBits *touched, const LaneParameters *p)
{
    const Lanes deepest[] = {(1.0/10.0)*p->floor_radius};
    LaneBits some = {0};
    (void)p;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Lanes delta = aside->clearance[i].delta;
        const LaneBits closed = x->latch[i].closed > 0.0;
        some |= (closed & (delta < 0.0)) | (~closed & (touched[i] | (delta >= 0.0))) | (delta > deepest[i]);
    }
    for (int i = 0; i < N_USER_EVENTS; i++) {
        const Lanes value = aside->event[i], side = x->event_side[i];
        some |= ~(((value > 0.0) & (side > 0.0)) | ((value < 0.0) & (side < 0.0)));
    }
    return some;
}

/* Height of the top of the cubic, as cubic_top of run.c, where the journal turned back within the step; else 0. */
static Lanes top_of(Lanes d0, Lanes r0, Lanes d1, Lanes r1, LaneBits turned)
{
    const Lanes b = 3.0 * (d1 - d0) - 2.0 * r0 - r1, c = r0 + r1 - 2.0 * (d1 - d0);
    const Lanes s = r0 / (lanes_sqrt(b * b - 3.0 * c * r0) - b);
    return pick(turned, d0 + s * (r0 + s * (b + s * c)), all_of(0.0));
}

/* Peaks of one joint. */
static void watch_force(LaneRun *x, int i, const LaneClearance *joint)
{
    const LaneBits closed = x->latch[i].closed > 0.0;
    const Lanes F_peak = x->latch[i].F_peak, F_open = x->latch[i].F_open;
    const Lanes F = lanes_sqrt(joint->F_n * joint->F_n + joint->F_t * joint->F_t);
    const LaneBits higher = F > F_peak, higher_open = closed & (F > F_open);
    x->latch[i].F_peak = pick(higher, F, F_peak);
    x->latch[i].t_peak = pick(higher, x->t, x->latch[i].t_peak);
    x->latch[i].F_open = pick(higher_open, F, F_open);
    x->latch[i].t_open = pick(higher_open, x->t, x->latch[i].t_open);
}

/* As accept of rk4.c, update_latches and watch of run.c where nothing happens. */
static void watch(LaneRun *x, const LaneAside *aside, double h, const Lanes *phi, const Lanes *phi_dot)
{
    for (int r = 0; r < N_LOOPS; r++) {
        x->phi_max = lanes_max_of(lanes_fabs(phi[r]), x->phi_max);
        x->phi_dot_max = lanes_max_of(lanes_fabs(phi_dot[r]), x->phi_dot_max);
    }
    for (int i = 0; i < N_CLEARANCES; i++) {
        const LaneClearance *joint = &aside->clearance[i];
        const Lanes e = x->latch[i].e, rate = x->latch[i].deltadot;
        const LaneBits closed = x->latch[i].closed > 0.0, turned = (rate > 0.0) & (joint->deltadot < 0.0);
        if (any_of(turned))
            x->latch[i].e_max =
                lanes_max_of(top_of(e, h * rate, joint->e, h * joint->deltadot, turned), x->latch[i].e_max);
        x->latch[i].e = joint->e;
        x->latch[i].delta = joint->delta;
        x->latch[i].deltadot = joint->deltadot;
        x->latch[i].e_max = lanes_max_of(joint->e, x->latch[i].e_max);
        watch_force(x, i, joint);
        if (!any_of(closed))
            continue;
        const Lanes ratio = joint->deltadot / x->latch[i].deltadot_minus;
        x->latch[i].compressing = pick(closed & (joint->deltadot <= 0.0), all_of(0.0), x->latch[i].compressing);
        x->ratio_min = pick(closed & (ratio < x->ratio_min), ratio, x->ratio_min);
        x->ratio_max = pick(closed & (ratio > x->ratio_max), ratio, x->ratio_max);
        x->ratio_outside = pick(closed & ((ratio < -1.0) | (ratio > 1.0)), x->ratio_outside + 1.0, x->ratio_outside);
    }
}

/*
 * One step of all lanes, as rk4_trial and accept of rk4.c. Returns the lanes in which something rare is met; where
 * there are any, or it is to be kept, `before` is x as it was.
 */
static LaneBits lane_step(LaneRun *x, double h, double t_new, const LaneParameters *p, int keep, LaneRun *before)
{
    static const double reach[3] = {0.5, 0.5, 1.0}, weight[3] = {1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
    const double t = x->t[0];
    Lanes y[N_Y], k[N_Y], next[N_Y], phi[N_LOOPS + 1], phi_dot[N_LOOPS + 1];
    LaneBits rare = {0}, touched[LANE_JOINTS] = { {0} };
    LaneAside aside;
    for (int j = 0; j < N_Y; j++)
        next[j] = x->y[j] + h / 6.0 * x->dy[j];
    const Lanes *slope = x->dy;
    for (int stage = 0; stage < 3; stage++) {
        for (int j = 0; j < N_Y; j++)
            y[j] = x->y[j] + reach[stage] * h * slope[j];
        motion(all_of(t + reach[stage] * h), y, x, p, k, &aside, &rare);
        for (int j = 0; j < N_Y; j++)
            next[j] += weight[stage] * h * k[j];
        for (int i = 0; i < N_CLEARANCES; i++)
            touched[i] |= aside.clearance[i].delta > 0.0;
        slope = k;
    }
    project_state(all_of(t + h), next, x, p, &rare);
    motion(all_of(t + h), next, x, p, k, &aside, &rare);
    closures(all_of(t_new), next, p, phi, &rare);
    closure_rates(all_of(t_new), next, next + N_X, p, phi_dot, &rare);
    rare |= not_finite(k, next, N_Y) | happens(x, &aside, touched, p);
    if (keep || any_of(rare))
        *before = *x;
    for (int j = 0; j < N_Y; j++) {
        x->y[j] = next[j];
        x->dy[j] = k[j];
    }
    x->t = all_of(t_new);
    x->steps += 1.0;
    x->evaluations += 4.0;
    watch(x, &aside, h, phi, phi_dot);
    return rare;
}
/*
 * Runs side by side: run[k] is the memory of number[k], which is -1 once that run has left. The lane of one that has
 * left mirrors another: what fills it must not be rare.
 */
typedef struct {
    const Batch *b;
    const Single *one;
    void *const *run;
    long number[LANES];
    LaneRun x;
    LaneParameters p;
    long made, rare; /* steps of all lanes, those of single runs among them */
} Side;

static void copy_lane(Lanes *x, size_t n, int to, int from)
{
    for (size_t j = 0; j < n; j++)
        x[j][to] = x[j][from];
}

static int first_of(const Side *side)
{
    int k = 0;
    while (k < LANES && side->number[k] < 0)
        k++;
    return k;
}

static int count_of(const Side *side)
{
    int count = 0;
    for (int k = 0; k < LANES; k++)
        count += side->number[k] >= 0;
    return count;
}

static void mirror(Side *side)
{
    const int from = first_of(side);
    for (int k = 0; k < LANES && from < LANES; k++) {
        if (side->number[k] >= 0)
            continue;
        copy_lane((Lanes *)&side->x, sizeof(LaneRun) / sizeof(Lanes), k, from);
        copy_lane((Lanes *)&side->p, sizeof(LaneParameters) / sizeof(Lanes), k, from);
    }
}

static void gather(Side *side, int k)
{
    Moving state;
    side->one->give(side->run[k], &state);
    for (size_t j = 0; j < sizeof state / sizeof(double); j++)
        ((Lanes *)&side->x)[j][k] = ((const double *)&state)[j];
}

static Moving state_of(const LaneRun *x, int k)
{
    Moving state;
    for (size_t j = 0; j < sizeof state / sizeof(double); j++)
        ((double *)&state)[j] = ((const Lanes *)x)[j][k];
    return state;
}

static void scatter(const Side *side, const LaneRun *x, int k)
{
    const Moving state = state_of(x, k);
    side->one->take(side->run[k], &state);
}

static const double *parameters_of(const Side *side, int k)
{
    return side->b->p_motion + side->number[k] * side->b->numbers;
}

/* Begins run k, unless it goes on, and makes its first sample; what cannot begin leaves. */
static void enter(Side *side, int k)
{
    const Batch *b = side->b;
    const long i = side->number[k];
    if (b->phase[i] == NEW) {
        b->status[i] = side->one->begin(b, i, side->run[k]);
        b->phase[i] = b->status[i] ? OVER : BEGUN;
        const int status = b->status[i] ? 0 : side->one->steps(b, i, 0, side->run[k]);
        if (status)
            side->one->end(b, i, status, side->run[k]);
        if (b->phase[i] == OVER) {
            side->number[k] = -1;
            return;
        }
    }
    for (long j = 0; j < b->numbers; j++)
        ((Lanes *)&side->p)[j][k] = parameters_of(side, k)[j];
    gather(side, k);
}

/*
 * The step of the rare lanes, which began at x, by their runs themselves. One whose lists are full leaves before it,
 * one that it ends leaves after it.
 */
static void single_steps(Side *side, LaneBits rare, const LaneRun *x)
{
    const Batch *b = side->b;
    for (int k = 0; k < LANES; k++) {
        const long i = side->number[k];
        if (i < 0 || !rare[k])
            continue;
        scatter(side, x, k);
        side->rare++;
        const int status = side->one->steps(b, i, 1, side->run[k]);
        if (!status) {
            gather(side, k);
            continue;
        }
        if (status != EVENTS_FULL)
            side->one->end(b, i, status, side->run[k]);
        side->number[k] = -1;
    }
    mirror(side);
}

/* One step of all lanes, with its samples. */
static void advance(Side *side)
{
    const Batch *b = side->b;
    const int first = first_of(side);
    const long i = side->number[first];
    double h;
    const double t_new = step_end(b->t[0], b->t[b->samples - 1], b->step[i], side->x.steps[first] + 1.0, &h);
    const int sampled = b->t[b->done[i]] < t_new + h;
    LaneRun before;
    const LaneBits rare = lane_step(&side->x, h, t_new, &side->p, sampled, &before);
    side->made += LANES;
    for (int k = 0; sampled && k < LANES; k++) {
        if (side->number[k] < 0 || rare[k])
            continue;
        const Moving from = state_of(&before, k);
        scatter(side, &side->x, k);
        side->one->samples(b, side->number[k], &from, side->run[k]);
    }
    if (any_of(rare))
        single_steps(side, rare, &before);
}

static double seconds_now(void)
{
    struct timespec now;
    timespec_get(&now, TIME_UTC);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

int gudgeon_lane_count(void) { return LANES; }

/*
 * Runs number[k] (LANES of them, -1: none), which have the same step and have come equally far, each in a memory of
 * its own. Returns GOES_ON after `limit` steps, to be called again, or ALL_OVER: what is not over then goes on alone
 * from where it is (gudgeon_many), because it has come to its end, is the last, most steps are rare, or the batch is
 * ending.
 */
int gudgeon_lanes(const void *batch, const void *single, void *const *run, long *number)
{
    Side side = {.b = batch, .one = single, .run = run};
    const double before = seconds_now();
    long left = side.b->limit;
    int entered = 0, together = 1;
    for (int k = 0; k < LANES; k++) {
        side.number[k] = number[k];
        entered += number[k] >= 0;
        if (number[k] >= 0)
            enter(&side, k);
    }
    mirror(&side);
    while ((together = count_of(&side) > 1 && 2 * side.rare <= side.made + 64 * LANES) && left > 0) {
        if (side.b->done[side.number[first_of(&side)]] == side.b->samples || *side.b->ending) {
            together = 0;
            break;
        }
        advance(&side);
        left--;
    }
    for (int k = 0; k < LANES; k++) {
        if (side.number[k] < 0)
            continue;
        scatter(&side, &side.x, k);
        side.b->t_last[side.number[k]] = side.x.t[k];
    }
    const double share = (seconds_now() - before) / entered;
    for (int k = 0; k < LANES; k++) {
        if (number[k] >= 0)
            side.b->seconds[number[k]] += share;
        number[k] = side.number[k];
    }
    return together ? GOES_ON : ALL_OVER;
}
