/*
 * Bouncing ball, Hertz contact with hysteresis damping
 * mechanism bouncing_ball, scene ideal, from the YAML with sha256 ddbbdb569d27e2af35adb5d783bcae0a9ce6a8f16cf6d94e2fb65a4b9090f7b4
 *
 * Sizes, and the structs that the functions of this scene pass to each other.
 */
#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>

enum {
    N_Q = 3,                 /* coordinates */
    N_ROWS = 2,              /* constraint rows of the motion */
    N_ALL_ROWS = 2,          /* rows of the closed linkage */
    N_JOINTS = 1,            /* joints without play */
    N_DRIVES = 0,
    N_CLEARANCES = 0,        /* joints with play */
    N_FRICTIONS = 0,         /* slips that friction may hold */
    N_SWITCHES = 0,          /* corners of min, max, abs and sign */
    N_USER_EVENTS = 0,      /* expressions whose zeros are watched */
    N_SERIES = 0,            /* results of force elements */
    N_WORK = 3,               /* work of drives, of force elements, of clearance forces */
    N_S = 2 * N_Q + N_WORK,   /* state of all bodies: q, v, works */
    N_X = 1,                  /* coordinates that are integrated */
    N_LOOPS = 0,              /* constraint rows of these */
    N_Y = 2 * N_X + N_WORK
};

/* Every number of a run, in SI: first the slots that a user may set, then what prepare() derives. */
typedef struct {    double height;  /* parameters.height */    double ball_mass;  /* bodies.ball.mass */    double ball_inertia;  /* bodies.ball.inertia */    double alpha;  /* baumgarte.alpha */    double beta;  /* baumgarte.beta */    double par_y;  /* gravity.y */    double weight_ball_y;  /* weight */    double two_alpha;  /* 2 alpha */    double beta_squared;  /* beta^2 */    double inverse_ball_inertia;  /* 1/M */    double inverse_ball_mass;  /* 1/M */} Parameters;

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
    Latch latch[1];
    double mode[1];
    double side[1];
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
    double lambda[2];
    double phi[2], phi_dot[2];
    double power[N_WORK];
    Clearance clearance[1];
    Friction friction[1];
    double g[1]; /* switching functions; NaN: does not act */
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
