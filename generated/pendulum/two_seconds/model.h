/*
 * simple pendulum (IFToMM A01)
 * mechanism pendulum, scene two_seconds, from the YAML with sha256
 * d09c146d2f0ceb546a548752eb1ee149e813b0f702dbe45fcda93bffb2b3e75d
 *
 * Sizes and small tables of this scene that the engine needs, and all parameters of a run.
 */
#ifndef GUDGEON_MODEL_H
#define GUDGEON_MODEL_H

#define N_Q 3                 /* coordinates of all bodies */
#define N_ROWS 1              /* constraint rows of the motion */
#define N_ALL_ROWS 1          /* rows of the closed linkage */
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
#define N_X 3                 /* coordinates that are integrated */
#define N_LOOPS 1             /* constraint rows of these */
#define N_DEPENDENT 0         /* coordinates that drives determine through loops */
#define N_LED 0               /* these, cosines and sines of angles */
#define SMOOTH_DRIVEN_LOOPS 0 /* their drives have no corners */
#define TREE_PIVOTS 0         /* statuses of driven loops follow these */
#define RESCUED 1             /* pivots may vanish: all bodies' equations help */
#define LARGEST_BLOCK 0       /* rows that are solved together */
#define N_VALUES 7            /* of the linearized equations */
#define N_FACTORS 5           /* of their factors L and U */
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
#define N_SET 2               /* those that it sets */
#define N_RATES 1             /* velocities that it sets */
#define TAYLOR 6              /* products of the Taylor series of the motion */

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
static const int set_place[] = {0, 2};
static const int rate_place[] = {2};
static const int drive_row[] = {0};
static const unsigned char row_is_length[] = {1};
static const int kept_row[] = {0};
static const int phi_q_first[] = {0, 2};
static const short phi_q_place[] = {0, 1};
static const unsigned char is_angle[] = {0, 0, 1};
static const unsigned char film_joint[] = {0};
static const short watched[] = {0};
static const short watched_as[] = {0};
static const unsigned char meets[] = {0};
static const int friction_of_pivot[] = {0};

/* The engine reads no further: scenes that have all this in common share its code. */

/* Parameters in SI units: first those that a user may set, then those that prepare() derives. */
struct Parameters {
    double g_;  /* parameters.g, m/s^2 */
    double length_;  /* parameters.length, m */
    double bob_mass_;  /* bodies.bob.mass, kg */
    double bob_inertia_;  /* bodies.bob.inertia, kg*m^2 */
    double alpha_;  /* baumgarte.alpha, 1/s */
    double beta_;  /* baumgarte.beta, 1/s */
    double rod_length_;  /* joints.rod.length, m */
    double gravity_y_;  /* gravity.y, m/s^2 */
    double set_bob_x_;  /* start.set.bob.x, m */
    double set_bob_theta_;  /* start.set.bob.theta, rad */
    double rates_bob_omega_;  /* start.rates.bob.omega, 1/s */
    double rod_half_inverse_length_;  /* of joint rod, 1/m */
    double weight_bob_y_;  /* weight, N */
    double two_alpha_;  /* 2 alpha, 1/s */
    double beta_squared_;  /* beta^2, 1/s^2 */
    double inverse_bob_mass_;  /* 1/M, 1/kg */
    double inverse_bob_inertia_;  /* 1/M, 1/(kg*m^2) */
    double tree_metric_bob_x_;  /* of projections, kg */
    double inverse_tree_metric_bob_x_;  /* 1/M, 1/kg */
};

/* Baumgarte's gains in Newton's matrix: 2 alpha and beta^2 of the constraints, 2 alpha of a sticking friction. */
static inline double baumgarte_two_alpha(const Parameters *p) { (void)p; return 0.0; }
static inline double baumgarte_beta_squared(const Parameters *p) { (void)p; return 0.0; }
static inline double stick_gain(const Parameters *p) { (void)p; return 0.0; }

#endif
