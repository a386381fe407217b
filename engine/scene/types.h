/*
 * What functions of a scene and of the engine hand to each other. Sizes are those of model.h, which is read first.
 */
#ifndef GUDGEON_TYPES_H
#define GUDGEON_TYPES_H
#include <float.h>
#include <limits.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include "../boundary.h"

#define AT_LEAST_ONE(n) ((n) > 0 ? (n) : 1) /* an array's length: C knows none of 0 */

enum {
    N_STATES = N_CLEARANCES * LAW_STATES, /* inner states of laws, joint by joint, behind the works in y */
    N_DISCRETE = N_CLEARANCES + N_FRICTIONS + N_STATES,
    N_S = 2 * N_Q + N_WORK,            /* state of all bodies: q, v, works */
    N_Y = 2 * N_X + N_WORK + N_STATES, /* state that is integrated */
    N_FELT = N_Y - N_WORK,             /* of it the motion feels these: all but the works */
    FIRST_STATE = 2 * N_X + N_WORK     /* where inner states are in it */
};

enum {
    TAYLOR_ORDERS = 26,                /* of a series, at most: what the smallest tolerance wants */
    TAYLOR_Y = (N_Y + 7) / 8 * 8       /* numbers of an order: those of N_Y, in whole vectors */
};

enum {
    NEAR = -20
}; /* of functions: a pivot is so small that the motion is continued from both sides (continuation.c) */

/*
 * Whom a long computation asks now and then whether it is still wanted (cancellation.c): `ask` each `every` seconds,
 * NULL: nobody. The clock is read once in `poll_after` right-hand sides, and within a dense system. Written by:
 * run/cancellation.h, run/cancellation.c.
 */
typedef struct {
    int (*ask)(void *caller); /* nonzero: stop */
    void *caller;
    double every, last, next; /* s; when the clock was read, when the next question is due */
    long count, poll_after;
    int stop, hold; /* not wanted any more; what is under way comes to its end first */
} Cancellation;

/* Whether the surfaces of joint i with play give: where they do not, velocities jump and a contact is a constraint. */
#if N_RIGID
#define gives(i) (!rigid_joint[i])
#else
#define gives(i) ((void)(i), 1)
#endif

/* Whether the law of joint i with play has a film: its force acts without a contact. */
#if N_CLEARANCES
#define has_film(i) (film_joint[i])
#else
#define has_film(i) ((void)(i), 0)
#endif

int poll_cancellation(Cancellation *x);

/* What a joint with play remembers: the impact velocity of its last onset. */
typedef struct {
    int closed;
    double deltadot_minus;
#if LAW_STATES
    double state[LAW_STATES]; /* of its laws, at the state that is looked at */
#endif
#if N_RIGID
    double force; /* N, of surfaces that do not give: what keeps a closed contact closed (contact_forces.h) */
#endif
#if N_RUBBED
    int smooth;   /* no friction but `along`: what a blow, or what puts a contact back, asks for */
    double along; /* N, along t on the second body */
#endif
} ContactState;

#if N_CHAIN
/* Coordinates that the drives determine through loops, and three rates of each, at a time. */
typedef struct {
    double t, q[N_LED], v[3 * N_CHAIN];
    int failed; /* 0, or a closure that was at a dead centre there */
} Chain;

/* Everything that the tree's kernels read at one time: of driven chains directions, second and third rates too. */
typedef struct {
    double q[N_X + N_LED], v[N_X + 3 * N_CHAIN];
} TreeState;

#endif
/*
 * What the right-hand side remembers beside the state: latches, and each friction's mode: 0 stick, 1 or -1 the
 * sign of its slip, 2 no force at all, where others hold the slip at zero. While it is `held`, contacts and the
 * sides of all corners stay as they are here, whatever the state says.
 */
typedef struct {
    ContactState contact[AT_LEAST_ONE(N_CLEARANCES)];
    double mode[AT_LEAST_ONE(N_FRICTIONS)];
    double branch[AT_LEAST_ONE(N_SWITCHES)];
    signed char event_sign[AT_LEAST_ONE(N_USER_EVENTS)]; /* of zero, where each expression was; 0: nowhere yet */
    int held;
    Cancellation *token; /* NULL: nobody */
    int singular_policy;                  /* what is done beside a singular position, one of those below */
    double least, least_size; /* share of a row, and of a joint's two, below which they are taken as dependent */
#if N_CHAIN
    Chain chain, recent; /* at the last state that was accepted; where they were found last */
#endif
} DiscreteState;
/* Where rows do not come and go, a run continues its motion from both sides of a singular position (continuation.c). */
#if INTEGRATES && N_LOOPS && !N_FRICTIONS && !N_RIGID
#define CONTINUES 1
#else
#define CONTINUES 0
#endif
enum {
    SINGULAR_CONTINUE, /* continued */
    SINGULAR_DETECT,   /* told as NEAR */
    SINGULAR_PROJECT,  /* everywhere on the closed linkage, and continued; NEAR where that cannot be had */
    SINGULAR_PROJECT_OR_IGNORE,  /* the same, but as ever where that cannot be had */
    SINGULAR_IGNORE  /* none is looked for */
};
#define NEARBY (TREE ? 1e-5 : 1e-4) /* `least` of such a run: the square of an angle to the position, or so */
#define USUAL_SHARES .least = NEARLY_SINGULAR, .least_size = VANISHING

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
    double F_n, F_t;                     /* along n = e/|e| and along t = n turned by +90 degrees */
    double ex, ey, e, deltadot, v_t;     /* m, m/s */
    double moment_first, moment_second;  /* about each body's pin centre, N*m */
    double delta, power;                 /* m, W */
#ifdef WALLS
    double from_x, from_y;               /* from the guide's point to the centre of a corner's radius, m */
#endif
#if LAW_STATES
    double state_rate[LAW_STATES];       /* of the laws' inner states, each unit a second */
#endif
#if N_RIGID
    double half_square_rate;             /* e . e'' + e' . e', m^2/s^2; where surfaces do not give */
#ifdef WALLS
    int at_wall;                         /* then half_square_rate is delta'' itself, m/s^2 */
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

/* What dynamics() computes beside the accelerations. Arrays of length one where there is none. */
typedef struct {
    double lambda[AT_LEAST_ONE(N_ROWS)];
    double phi[AT_LEAST_ONE(N_ROWS)], phi_dot[AT_LEAST_ONE(N_ROWS)];
    double power[N_WORK];
    Clearance clearance[AT_LEAST_ONE(N_CLEARANCES)];
    Friction friction[AT_LEAST_ONE(N_FRICTIONS)];
    double g[AT_LEAST_ONE(N_SWITCHES)]; /* switching functions; NaN: does not act */
    double event[AT_LEAST_ONE(N_USER_EVENTS)]; /* values of the expressions that are watched */
} RhsOutputs;

/* The equations of motion linearized at a state, and Newton's matrix factorized. */
typedef struct {
    const Parameters *p;
    double value[AT_LEAST_ONE(N_VALUES)]; /* what linearize() found */
    double lu[AT_LEAST_ONE(N_FACTORS)];   /* L, U and inverse pivots */
} Linear;

#if IMPLICIT_STAGES
/* The same matrix at a complex h gamma: numbers are real and imaginary parts one behind the other. */
typedef struct {
    const Parameters *p;
    const double *value; /* of the Linear that it is made of */
    double lu[2 * AT_LEAST_ONE(N_FACTORS)];
} ComplexLinear;
#endif

/* Where a part of the linearization is in `value`. */
typedef struct {
    int row, column, value, sign;
} LinearEntry;

#endif
