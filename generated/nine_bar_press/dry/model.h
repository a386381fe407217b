/*
 * 2-DOF nine-bar press with play in joints A and B
 * mechanism nine_bar_press, scene dry, from the YAML with sha256 febebffbc57d813ee64233a43860a86e87c2f0ecff80a72653d127fbfd0f9a36
 *
 * Sizes, and the structs that the functions of this scene pass to each other.
 */
#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>

enum {
    N_Q = 24,                 /* coordinates */
    N_ROWS = 20,              /* constraint rows of the motion */
    N_ALL_ROWS = 24,          /* rows of the closed linkage */
    N_JOINTS = 9,            /* joints without play */
    N_DRIVES = 2,
    N_CLEARANCES = 2,        /* joints with play */
    N_FRICTIONS = 0,         /* slips that friction may hold */
    N_SWITCHES = 10,          /* corners of min, max, abs and sign */
    N_USER_EVENTS = 0,      /* expressions whose zeros are watched */
    N_SERIES = 0,            /* results of force elements */
    N_WORK = 3,               /* work of drives, of force elements, of clearance forces */
    N_S = 2 * N_Q + N_WORK,   /* state of all bodies: q, v, works */
    N_X = 5,                  /* coordinates that are integrated */
    N_LOOPS = 1,              /* constraint rows of these */
    N_Y = 2 * N_X + N_WORK
};

/* Every number of a run, in SI: first the slots that a user may set, then what prepare() derives. */
typedef struct {    double omega;  /* parameters.omega */    double omega4;  /* parameters.omega4 */    double l5;  /* parameters.l5 */    double c;  /* parameters.c */    double L1_mass;  /* bodies.L1.mass */    double L1_inertia;  /* bodies.L1.inertia */    double L2_mass;  /* bodies.L2.mass */    double L2_inertia;  /* bodies.L2.inertia */    double L3_mass;  /* bodies.L3.mass */    double L3_inertia;  /* bodies.L3.inertia */    double L4_mass;  /* bodies.L4.mass */    double L4_inertia;  /* bodies.L4.inertia */    double L6_mass;  /* bodies.L6.mass */    double L6_inertia;  /* bodies.L6.inertia */    double L7_mass;  /* bodies.L7.mass */    double L7_inertia;  /* bodies.L7.inertia */    double L8_mass;  /* bodies.L8.mass */    double L8_inertia;  /* bodies.L8.inertia */    double S9_mass;  /* bodies.S9.mass */    double S9_inertia;  /* bodies.S9.inertia */    double L1_length;  /* bodies.L1.length */    double L2_length;  /* bodies.L2.length */    double L3_length;  /* bodies.L3.length */    double L4_length;  /* bodies.L4.length */    double L6_length;  /* bodies.L6.length */    double L7_length;  /* bodies.L7.length */    double L8_length;  /* bodies.L8.length */    double alpha;  /* baumgarte.alpha */    double beta;  /* baumgarte.beta */    double O4_y;  /* ground.O4.y */    double O6_x;  /* ground.O6.x */    double guide_axis_y;  /* joints.guide.axis.y */    double pin_radius;  /* bearings.pin.radius */    double pin_clearance;  /* bearings.pin.clearance */    double pin_length;  /* bearings.pin.length */    double aluminium_E;  /* materials.aluminium.E */    double aluminium_nu;  /* materials.aluminium.nu */    double dry_normal_restitution;  /* contacts.dry.normal.restitution */    double dry_normal_exponent;  /* contacts.dry.normal.exponent */    double dry_friction_mu;  /* contacts.dry.friction.mu */    double dry_friction_v0;  /* contacts.dry.friction.v0 */    double dry_friction_v1;  /* contacts.dry.friction.v1 */    double velocity_floor;  /* contacts.dry.velocity_floor */    double par_y;  /* gravity.y */    double guess_L2_theta;  /* start.guess.L2.theta */    double guess_L3_theta;  /* start.guess.L3.theta */    double guess_L6_theta;  /* start.guess.L6.theta */    double guess_L7_theta;  /* start.guess.L7.theta */    double guess_L8_theta;  /* start.guess.L8.theta */    double L1_head_x;  /* point from the centre of mass */    double L2_head_x;  /* point from the centre of mass */    double L3_head_x;  /* point from the centre of mass */    double L4_head_x;  /* point from the centre of mass */    double L6_head_x;  /* point from the centre of mass */    double L7_head_x;  /* point from the centre of mass */    double L8_head_x;  /* point from the centre of mass */    double R_j_pin;  /* journal radius */    double dry_pin_K;  /* contact stiffness */    double dry_pin_hysteresis;  /* hysteresis damping factor a */    double dry_pin_friction_slope;  /* 1/(v1 - v0) */    double weight_L1_y;  /* weight */    double weight_L2_y;  /* weight */    double weight_L3_y;  /* weight */    double weight_L4_y;  /* weight */    double weight_L6_y;  /* weight */    double weight_L7_y;  /* weight */    double weight_L8_y;  /* weight */    double weight_S9_y;  /* weight */    double two_alpha;  /* 2 alpha */    double beta_squared;  /* beta^2 */    double inverse_L1_mass;  /* 1/M */    double inverse_L2_mass;  /* 1/M */    double inverse_L3_mass;  /* 1/M */    double inverse_L4_mass;  /* 1/M */    double inverse_S9_mass;  /* 1/M */    double inverse_S9_inertia;  /* 1/M */    double inverse_L2_inertia;  /* 1/M */    double inverse_L3_inertia;  /* 1/M */    double inverse_L6_mass;  /* 1/M */    double inverse_L8_mass;  /* 1/M */    double inverse_L1_inertia;  /* 1/M */    double inverse_L4_inertia;  /* 1/M */    double inverse_L6_inertia;  /* 1/M */    double inverse_L7_mass;  /* 1/M */    double inverse_L8_inertia;  /* 1/M */    double inverse_L7_inertia;  /* 1/M */    double L6_head_span_x;  /* vector in its frame */    double L7_com_span_x;  /* vector in its frame */    double L7_tail_span_x;  /* vector in its frame */    double L2_com_span_x;  /* vector in its frame */    double L3_com_span_x;  /* vector in its frame */    double L8_head_span_x;  /* vector in its frame */    double L1_head_span_x;  /* vector in its frame */    double L2_tail_span_x;  /* vector in its frame */    double L4_head_span_x;  /* vector in its frame */    double L3_tail_span_x;  /* vector in its frame */    double inertia_L1_L1;  /* sum of m w.w */    double inertia_L6_L6;  /* sum of m w.w */    double inertia_L6_L7;  /* sum of m w.w */    double inertia_L6_L2;  /* sum of m w.w */    double inertia_L7_L7;  /* sum of m w.w */    double inertia_L7_L2;  /* sum of m w.w */    double inertia_L2_L2;  /* sum of m w.w */    double inertia_L6_L3;  /* sum of m w.w */    double inertia_L7_L3;  /* sum of m w.w */    double inertia_L3_L3;  /* sum of m w.w */    double inertia_L4_L4;  /* sum of m w.w */    double inertia_L6_L8;  /* sum of m w.w */    double inertia_L8_L8;  /* sum of m w.w */    double mass_crank1_crank1;  /* constant of M */    double mass_L6_L6;  /* constant of M */    double mass_L7_L7;  /* constant of M */    double mass_L2_L2;  /* constant of M */    double mass_L3_L3;  /* constant of M */    double mass_crank4_crank4;  /* constant of M */    double mass_L8_L8;  /* constant of M */    double weight_L1__across;  /* weight */    double weight_L6__across;  /* weight */    double weight_L7__across;  /* weight */    double weight_L2__across;  /* weight */    double weight_L3__across;  /* weight */    double weight_L4__across;  /* weight */    double weight_L8__across;  /* weight */    double inverse_mass_L8_L8;  /* 1/M */    double inverse_mass_L2_L2;  /* 1/M */} Parameters;

enum { STOPPED = -10, STALLED = -11 }; /* statuses: no longer wanted; no longer advances */

/*
 * Whom a long computation asks now and then whether it is still wanted (asked.c): `ask` each `every` seconds, NULL:
 * nobody. The clock is read once in `look` right-hand sides, and within a dense system.
 */
typedef struct {
    int (*ask)(void *whom); /* nonzero: stop */
    void *whom;
    double every, last, next; /* s; when the clock was read, when the next question is due */
    long count, look;
    int stop, hold; /* not wanted any more; what is under way comes to its end first */
} Asked;

/* What a joint with play remembers: the impact velocity of its last onset. */
typedef struct {
    int closed;
    double deltadot_minus;
} Latch;

/*
 * What the right-hand side remembers beside the state: latches, and each friction's mode: 0 stick, 1 or -1 the
 * sign of its slip, 2 no force at all, where others hold the slip at zero. While it is `held`, contacts and the
 * sides of all corners stay as they are here, whatever the state says.
 */
typedef struct {
    Latch latch[2];
    double mode[1];
    double side[10];
    signed char event_side[1]; /* of zero, where each watched expression was last; 0: nowhere yet */
    int held;
    Asked *asked; /* NULL: nobody */
} Memory;

/* Friction at one state: slip and its rate, surface speed, force on the second body along it, limit at stick. */
typedef struct {
    double v, rate, speed, force, static_limit;
} Friction;

/* A joint with play at one state; the force acts on the second body (journal), ground axes. */
typedef struct {
    double Fx, Fy;                       /* N */
    double F_n, F_t;                     /* along n = e/|e| and along t = n turned by +90 degrees */
    double ex, ey, e, deltadot, v_t;     /* m, m/s */
    double moment_first, moment_second;  /* about each body's pin centre, N*m */
    double delta, power;                 /* m, W */
} Clearance;

/* The force of a joint with play along n and t on the journal, moments about both pin centres, slip. */
typedef struct {
    double n, t, M_i, M_j, v_t;
} PinForce;

/* What dynamics() computes beside the accelerations. Arrays of length one where there is none. */
typedef struct {
    double lambda[20];
    double phi[20], phi_dot[20];
    double power[N_WORK];
    Clearance clearance[2];
    Friction friction[1];
    double g[10]; /* switching functions; NaN: does not act */
    double event[1]; /* values of the expressions that are watched */
} Aside;

/* The expressions that are watched: which way they are to cross zero (1 rising, -1 falling, 0 both), and what then. */
static const signed char event_direction[] = {0};
static const unsigned char event_stops[] = {0};

/*
 * Whether expression i, seen last on `side` of zero (1 or -1; 0: nowhere yet), has crossed to `value`; `side` is
 * where it is then. A zero itself lies on neither side.
 */
static inline int event_crosses(int i, signed char *side, double value)
{
    const int from = *side, to = (value > 0.0) - (value < 0.0);
    if (to)
        *side = (signed char)to;
    return from * to < 0 && event_direction[i] * to >= 0;
}

/* min, max, sign that keep a NaN in x. */
static inline double max_of(double x, double y) { return x < y ? y : x; }
static inline double min_of(double x, double y) { return x > y ? y : x; }
static inline double sign_of(double x) { return x > 0.0 ? 1.0 : (x < 0.0 ? -1.0 : x); }
static inline double total_force(const Clearance *joint) { return sqrt(joint->F_n * joint->F_n + joint->F_t * joint->F_t); }
/* How close (s) to the end t of a step of length h a sample is the end's own: both are sums of rounded numbers. */
static inline double rounded(double t, double h) { return 8.0 * DBL_EPSILON * fabs(t) + 1e-12 * h; }
/*
 * Time at which step i (1, 2, ...) of a fixed length ends, from the first of n output times, of which `done` are
 * stored, towards the last; `h` is its length. The last one ends at the last time and is the shorter for it. A step
 * that ends at an output but for rounding ends at it, and the next ones count from there, so that a run that goes on
 * from this output takes the same ones.
 */
static inline double step_end(const double *t, long n, long done, double step, double i, double *h)
{
    const double total = max_of(ceil((t[n - 1] - t[0]) / step * (1.0 - 1e-12)), 1.0);
    const double rest = t[n - 1] - t[0] - (total - 1.0) * step;
    *h = i < total || fabs(rest - step) < 1e-9 * step ? step : rest;
    if (!(i < total))
        return t[n - 1];
    const double last = t[done > 0 ? done - 1 : 0], count = rint((last - t[0]) / step);
    const int is_end = fabs(t[0] + count * step - last) <= rounded(last, step);
    const double end = is_end ? last + (i - count) * step : t[0] + i * step;
    return done < n && fabs(t[done] - end) <= rounded(end, step) ? t[done] : end;
}
/* The side of corner k: as it is held, or where g is. */
static inline double side_of(const double *side, double *g, int k, double value)
{
    g[k] = value;
    return side ? side[k] : sign_of(value);
}
