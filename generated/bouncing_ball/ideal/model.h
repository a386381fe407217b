/*
 * Bouncing ball, Hertz contact with hysteresis damping
 * mechanism bouncing_ball, scene ideal, from the YAML with sha256
 * d59abd4d40e94d675ef5ed7a7d8ab966ee77d724aa6a7ad36058811fdec5cf94
 *
 * Sizes and small tables of this scene that the engine needs, and all parameters of a run.
 */
#ifndef GUDGEON_MODEL_H
#define GUDGEON_MODEL_H

#define N_Q 3                 /* coordinates of all bodies */
#define N_ROWS 2              /* constraint rows of the motion */
#define N_ALL_ROWS 2          /* rows of the closed linkage */
#define N_JOINTS 1            /* joints without play */
#define N_DRIVES 0            /* drives */
#define N_CLEARANCES 0        /* joints with play */
#define LAW_STATES 0          /* internal states of the laws of a joint with play, at most */
#define N_FRICTIONS 0         /* slips that friction may hold */
#define N_SWITCHES 0          /* corners of min, max, abs and sign */
#define N_USER_EVENTS 0       /* expressions whose zeros are watched */
#define N_SERIES 0            /* results of force elements */
#define INTEGRATES 1          /* 1; 0: no freedom is left, positions follow from the drives */
#define TREE 1                /* 1: in coordinates of a tree of bodies; 0: in those of all bodies */
#define POSITIONS_IN_TREE 0   /* the same, where they follow */
#define N_X 1                 /* coordinates that are integrated */
#define N_LOOPS 0             /* constraint rows of these */
#define N_DEPENDENT 0         /* coordinates that drives determine through loops */
#define N_LED 0               /* these, cosines and sines of angles */
#define SMOOTH_DRIVEN_LOOPS 0 /* their drives have no corners */
#define TREE_PIVOTS 0         /* statuses of driven loops follow these */
#define RESCUED 0             /* pivots may vanish: all bodies' equations help */
#define LARGEST_BLOCK 0       /* rows that are solved together */
#define N_VALUES 0            /* of the linearized equations */
#define N_FACTORS 0           /* of their factors L and U */
#define IMPLICIT_STAGES 0     /* 1: there are methods that find their stages together */
#define HAS_LANES 1           /* runs go side by side */
#define DRIVE_IMPULSES 0      /* drives' rates may jump, and something is free to move */
#define RATE_JUMPS 0          /* the rate of some drive may jump */
#define N_WATCHED 0           /* corners of expressions, and events */
#define KNOWN_BOUNDS 0        /* bounds of what is watched are known over ranges of the state */
#define WATCHES_STATE 0       /* they hang on more than time */
#define N_TERMS 0             /* terms of time alone, which may hide within a step */
#define N_PULSES 0            /* of these, the first: those that may in a step of any motion */
#define N_GUESS 0             /* coordinates that the start guesses */
#define GUESSED_POINTS 0      /* some of them are those of points */
#define N_SET 0               /* those that it sets */
#define N_RATES 0             /* velocities that it sets */
#define TAYLOR 1              /* products of the Taylor series of the motion */

/* Thresholds of pivots: a constraint equation is dependent if less than this fraction of its pivot is left: */
#define SINGULAR 1e-13                        /* where it depends on others */
#define NEARLY_SINGULAR 1e-08                 /* where it nearly does */
#define VANISHING 1e-10                       /* where one of a joint's two rows vanishes: links in one line */
#define EARLY 1e-05                           /* of two rows that are solved before all of their coordinates */
#define LIGHT_PIVOT 0.001                     /* of what turns with an angle, where its inertia is too small for it */
#define SINGULAR_SQUARE 3.162277660168379e-07 /* of as many rows as unknowns: the root of SINGULAR */

typedef struct Parameters Parameters; /* all parameters of a run */

#include "engine/scene/types.h"
#include "engine/scene/numbers.h"

static const signed char event_direction[] = {0};
static const unsigned char event_stops[] = {0};
static const int guess_place[] = {0};
static const int set_place[] = {0};
static const int rate_place[] = {0};
static const int drive_row[] = {0};
static const unsigned char row_is_length[] = {1, 1};
static const int kept_row[] = {0, 1};
static const int phi_q_first[] = {0, 1, 2};
static const short phi_q_place[] = {0, 1};
static const unsigned char is_angle[] = {1};
static const unsigned char film_joint[] = {0};
static const short watched[] = {0};
static const short watched_as[] = {0};
static const unsigned char meets[] = {0};
static const int friction_of_pivot[] = {0};

/* The engine reads no further: scenes that have all this in common share its code. */

/* Parameters in SI units: first those that a user may set, then those that prepare() derives. */
struct Parameters {
    double height_;  /* parameters.height, m */
    double ball_mass_;  /* bodies.ball.mass, kg */
    double ball_inertia_;  /* bodies.ball.inertia, kg*m^2 */
    double alpha_;  /* baumgarte.alpha, 1/s */
    double beta_;  /* baumgarte.beta, 1/s */
    double gravity_y_;  /* gravity.y, m/s^2 */
    double weight_ball_y_;  /* weight, N */
    double two_alpha_;  /* 2 alpha, 1/s */
    double beta_squared_;  /* beta^2, 1/s^2 */
    double inverse_ball_inertia_;  /* 1/M, 1/(kg*m^2) */
};

/* Baumgarte's gains in Newton's matrix: 2 alpha and beta^2 of the constraints, 2 alpha of a sticking friction. */
static inline double baumgarte_two_alpha(const Parameters *p) { (void)p; return 0.0; }
static inline double baumgarte_beta_squared(const Parameters *p) { (void)p; return 0.0; }
static inline double stick_gain(const Parameters *p) { (void)p; return 0.0; }

#endif
