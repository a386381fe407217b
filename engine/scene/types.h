/*
 * Structs that the functions of a scene and of the engine exchange: discrete states, contacts, outputs of the
 * right-hand side, linearized equations. Sizes are those of model.h, which is read first.
 */
#ifndef GUDGEON_TYPES_H
#define GUDGEON_TYPES_H
#include <float.h>
#include <limits.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include "../boundary.h"

/* Number of a parameter of a run: Parameters has numbers only. */
#define PARAMETER_INDEX(name) ((int)(offsetof(Parameters, name) / sizeof(double)))
#define AT_LEAST_ONE(n) ((n) > 0 ? (n) : 1) /* length of an array, which may not be 0 in C */

enum {
    N_STATES = N_CLEARANCES * LAW_STATES, /* internal states of laws, joint by joint, after the works in y */
    N_DISCRETE = N_CLEARANCES + N_FRICTIONS + N_STATES,
    N_S = 2 * N_Q + N_WORK,            /* state of all bodies: q, v, works */
    N_Y = 2 * N_X + N_WORK + N_STATES, /* state that is integrated */
    N_MOTION = N_Y - N_WORK,             /* components on which the motion depends: all but the works */
    FIRST_STATE = 2 * N_X + N_WORK     /* index of the first internal state in it */
};

/*
 * Orders of a Taylor series: at most, for the smallest tolerance, and per factor e of the tolerance. Sums of few
 * products take less time than the other operations of an order. More orders, and longer steps, are then cheaper.
 */
#if TAYLOR && TAYLOR <= 8
enum { TAYLOR_ORDERS = 38 };
#define ORDERS_PER_E_FOLD 1.0
#else
enum { TAYLOR_ORDERS = 27 };
#define ORDERS_PER_E_FOLD TAYLOR_ORDERS_PER_E_FOLD
#endif

enum {
    TAYLOR_Y = (N_Y + 7) / 8 * 8       /* numbers of an order: those of N_Y, in whole vectors */
};

enum {
    NEAR_SINGULAR = -20
}; /* status of functions: a pivot is so small that the motion is continued from both sides (continuation.c) */

/*
 * Cancellation of a long computation (cancellation.c): is_stop_requested(context) is polled every
 * `poll_interval` seconds; NULL: it cannot be cancelled. The clock is read once in `poll_after` right-hand sides, and
 * within a dense system. Written by: run/cancellation.h, run/cancellation.c.
 */
typedef struct {
    int (*is_stop_requested)(void *context); /* nonzero: stop */
    void *context;
    double poll_interval, last_reading, next_poll; /* s; interval, time of the last reading, time of the next poll */
    long count, poll_after;
    int stop, is_deferred; /* cancelled; cancellation is deferred until the current operation ends */
} Cancellation;

/* Whether the surfaces of joint i with play are compliant. If rigid, velocities jump and a contact is a constraint. */
#if N_RIGID
#define is_compliant(i) (!rigid_joint[i])
#else
#define is_compliant(i) ((void)(i), 1)
#endif

/* Whether the law of joint i with play has a film: its force acts without a contact. */
#if N_CLEARANCES
#define has_film(i) (film_joint[i])
#else
#define has_film(i) ((void)(i), 0)
#endif

int poll_cancellation(Cancellation *x);

/* The contact state of a joint with play; deltadot_minus: approach speed at the last onset, m/s. */
typedef struct {
    int closed;
    double deltadot_minus;
#if LAW_STATES
    double state[LAW_STATES]; /* internal states of its laws at the evaluated state */
#endif
#if N_RIGID
    double force; /* N, of rigid surfaces: the force that keeps a closed contact closed (contact_forces.h) */
#endif
#if N_RIGID_WITH_FRICTION
    int is_frictionless;     /* no friction but tangential_force: for impacts and the projection of contacts */
    double tangential_force; /* N, along t on the second body */
#endif
} ContactState;

#if N_DEPENDENT
/* Coordinates that the drives determine through loops, and three rates of each, at a time. */
typedef struct {
    double t, q[N_DEPENDENT_VALUES], v[3 * N_DEPENDENT];
    int failed; /* 0, or a closure that was at a dead centre there */
} DrivenLoops;

/* All that the tree's kernels read at one time: with directions, second and third rates of driven loops. */
typedef struct {
    double q[N_X + N_DEPENDENT_VALUES], v[N_X + 3 * N_DEPENDENT];
} TreeState;

#endif
/*
 * Discrete states: contact states, branches of switching functions, and the mode of each friction: 0 stick, 1 or -1 the
 * sign of its slip, 2 no force, because others hold the slip at zero. While `is_frozen`, contacts and branches are
 * frozen as they are here, whatever the state is.
 */
typedef struct {
    ContactState contact[AT_LEAST_ONE(N_CLEARANCES)];
    double mode[AT_LEAST_ONE(N_FRICTIONS)];
    double branch[AT_LEAST_ONE(N_SWITCHES)];
    signed char event_sign[AT_LEAST_ONE(N_USER_EVENTS)]; /* last sign of each user event; 0: none yet */
    int is_frozen;
    Cancellation *token; /* NULL: no cancellation */
    int singular_policy;                  /* policy near a singular position, one of those below */
    double min_pivot, min_pivot_size; /* fraction of a pivot, of one or two equations, below which they are dependent */
#if N_DEPENDENT
    DrivenLoops accepted_loops, latest_loops; /* driven loops at the last accepted state; at the last evaluated time */
#endif
} DiscreteState;
/* Whether runs continue the motion at singular positions (continuation.c): scenes whose equations do not change. */
#if INTEGRATES && N_LOOPS && !N_FRICTIONS && !N_RIGID
#define HAS_CONTINUATION 1
#else
#define HAS_CONTINUATION 0
#endif
enum {
    SINGULAR_CONTINUE, /* continue the motion from both sides */
    SINGULAR_DETECT,   /* report NEAR_SINGULAR */
    SINGULAR_PROJECT,  /* project every state, and continue; NEAR_SINGULAR if that fails */
    SINGULAR_PROJECT_OR_IGNORE,  /* the same; as SINGULAR_IGNORE if that fails */
    SINGULAR_IGNORE  /* no test */
};
/* `min_pivot` of such a run: about the squared angle to the singular position */
#define NEAR_SINGULAR_PIVOT (TREE ? 1e-5 : 1e-4)
#define DEFAULT_PIVOT_LIMITS .min_pivot = NEARLY_SINGULAR, .min_pivot_size = VANISHING

/* Friction at one state: slip and its rate, surface speed, force on the second body along it, limit at stick. */
typedef struct {
    double v, rate, speed, force, static_limit;
} Friction;

#ifdef WALLS
#define N_REACTIONS (N_JOINTS + WALLS)
#else
#define N_REACTIONS N_JOINTS
#endif

/* A joint with play at one state; the force acts on the second body (journal or slider), ground axes. */
typedef struct {
    double Fx, Fy;                       /* N */
    double F_n, F_t;                     /* along n = e/|e|, negative in compression; along t = n turned by +90 deg */
    double ex, ey, e, deltadot, v_t;     /* m, m/s */
    double moment_first, moment_second;  /* about each body's pin centre, N*m */
    double delta, power;                 /* m, W */
#ifdef WALLS
    double from_x, from_y;               /* from the guide's point to the centre of a corner's radius, m */
#endif
#if LAW_STATES
    double state_rate[LAW_STATES];       /* of the laws' internal states, each unit a second */
#endif
#if N_RIGID
    double half_square_second_derivative;             /* e . e'' + e' . e', m^2/s^2; of rigid surfaces */
#ifdef WALLS
    int at_wall;                         /* then half_square_second_derivative is delta'' itself, m/s^2 */
#endif
#endif
} Clearance;

/* The force of a joint with play along n and t on the second body, moments about both bodies' points, slip. */
typedef struct {
    double n, t, M_i, M_j, v_t;
#if LAW_STATES
    double state_rate[LAW_STATES];
#endif
} PinForce;

/* Outputs of dynamics() in addition to the accelerations. Arrays without elements have length one. */
typedef struct {
    double lambda[AT_LEAST_ONE(N_ROWS)];
    double phi[AT_LEAST_ONE(N_ROWS)], phi_dot[AT_LEAST_ONE(N_ROWS)];
    double power[N_WORK];
    Clearance clearance[AT_LEAST_ONE(N_CLEARANCES)];
    Friction friction[AT_LEAST_ONE(N_FRICTIONS)];
    double g[AT_LEAST_ONE(N_SWITCHES)]; /* switching functions; NaN: not in use */
    double event[AT_LEAST_ONE(N_USER_EVENTS)]; /* values of the user events */
} RhsOutputs;

/* The equations of motion linearized at a state, and Newton's matrix factorized. */
typedef struct {
    const Parameters *p;
    double value[AT_LEAST_ONE(N_VALUES)]; /* entries, by linearize() */
    double lu[AT_LEAST_ONE(N_FACTORS)];   /* L, U and inverse pivots */
} Linear;

#if IMPLICIT_STAGES
/* Newton's matrix at a complex h gamma: real and imaginary parts alternate. */
typedef struct {
    const Parameters *p;
    const double *value; /* entries of the Linear from which it is built */
    double lu[2 * AT_LEAST_ONE(N_FACTORS)];
} ComplexLinear;
#endif

/* An entry of a linearized matrix: its row and column, its index in `value`, its sign. */
typedef struct {
    int row, column, value, sign;
} LinearEntry;

#endif
