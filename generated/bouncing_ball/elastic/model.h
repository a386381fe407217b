/*
 * Bouncing ball, Hertz contact with hysteresis damping
 * mechanism bouncing_ball, scene elastic, from the YAML with sha256
 * 54aee18c268d8295e1d23cc5e44a71e8f579f0995457613e251d820fd3110d5a
 *
 * Sizes and small tables of this scene that the engine needs, and all parameters of a run.
 */
#ifndef GUDGEON_MODEL_H
#define GUDGEON_MODEL_H

#define N_Q 3                   /* coordinates of all bodies */
#define N_ROWS 0                /* constraint equations of the motion */
#define N_ALL_ROWS 2            /* constraint equations of the closed linkage */
#define N_JOINTS 0              /* joints without play */
#define N_DRIVES 0              /* drives */
#define N_CLEARANCES 1          /* joints with play */
#define LAW_STATES 0            /* internal states of the laws of a joint with play, at most */
#define N_FRICTIONS 0           /* friction elements, which may stick */
#define N_SWITCHES 0            /* switching functions of min, max, abs and sign */
#define N_USER_EVENTS 0         /* expressions whose zeros are events */
#define N_SERIES 0              /* results of force elements */
#define INTEGRATES 1            /* 1: integrated; 0: no degree of freedom, drives determine positions */
#define TREE 1                  /* 1: tree coordinates; 0: coordinates of all bodies */
#define POSITIONS_IN_TREE 0     /* the same for kinematic analysis */
#define N_X 3                   /* coordinates that are integrated */
#define N_LOOPS 0               /* constraint equations of these */
#define N_DEPENDENT 0           /* dependent coordinates, which drives determine through loops */
#define N_DEPENDENT_VALUES 0    /* these, and cosines and sines of their angles */
#define SMOOTH_DRIVEN_LOOPS 0   /* 1: drives of driven loops have no switching functions */
#define TREE_PIVOTS 0           /* statuses of pivots before those of driven loops */
#define HAS_ABSOLUTE_FALLBACK 0 /* 1: if a pivot vanishes, absolute coordinates are used */
#define LARGEST_BLOCK 0         /* constraint equations that are solved together */
#define N_VALUES 20             /* values of the linearized equations */
#define N_FACTORS 9             /* values of their factors L and U */
#define IMPLICIT_STAGES 0       /* 1: there are methods that solve all stages together */
#define HAS_LANES 1             /* runs in vector lanes */
#define DRIVE_IMPULSES 0        /* 1: rates of drives may jump, and there are degrees of freedom */
#define RATE_JUMPS 0            /* 1: the rate of a drive may jump */
#define N_MONITORED 0           /* monitored switching functions and user events */
#define KNOWN_BOUNDS 0          /* 1: bounds of monitored functions over ranges of the state are known */
#define MONITORS_STATE 0        /* 1: the bounds depend on the state, not only on time */
#define N_TERMS 0               /* terms that depend on time only, whose changes a step may miss */
#define N_TRANSIENTS 0          /* the first of these: transients that a step of any motion may miss */
#define N_GUESS 0               /* coordinates that the start gives as guesses */
#define GUESSED_POINTS 0        /* 1: some guesses are coordinates of points */
#define N_SET 0                 /* coordinates that the start sets */
#define N_RATES 0               /* velocities that the start sets */

/* Thresholds of pivots: a constraint equation is dependent if less than this fraction of its pivot is left: */
#define SINGULAR 1e-13                        /* if it depends on others */
#define NEARLY_SINGULAR 1e-08                 /* if it nearly depends on others */
#define VANISHING 1e-10                       /* if one of a joint's two pivots vanishes: links in one line */
#define EARLY 1e-05                           /* of two equations that are solved before all of their coordinates */
#define LIGHT_PIVOT 0.001                     /* of the bodies that turn with an angle, if their inertia is too small */
#define SINGULAR_SQUARE 3.162277660168379e-07 /* of as many equations as unknowns: the root of SINGULAR */

typedef struct Parameters Parameters; /* all parameters of a run */

#include "engine/scene/types.h"
#include "engine/scene/numbers.h"

static const signed char event_direction[] = {0};
static const unsigned char event_stops[] = {0};
static const int guess_coordinate[] = {0};
static const int set_coordinate[] = {0};
static const int rate_coordinate[] = {0};
static const int drive_row[] = {0};
static const unsigned char row_is_length[] = {1, 1};
static const int motion_row[] = {0};
static const int phi_q_first[] = {0, 1, 2};
static const short phi_q_column[] = {0, 1};
static const unsigned char is_angle[] = {0, 0, 1};
static const unsigned char film_joint[] = {0};
static const short monitored_event[] = {0};
static const short monitored_index[] = {-1};
static const unsigned char is_continuous_switch[] = {0};
static const int friction_of_pivot[] = {0};

/* The engine reads no further: scenes that have all this in common share its code. */

/* Parameters in SI units: first those that a user may set, then those that prepare() derives. */
struct Parameters {
    double height_;  /* parameters.height, m */
    double ball_mass_;  /* bodies.ball.mass, kg */
    double ball_inertia_;  /* bodies.ball.inertia, kg*m^2 */
    double alpha_;  /* baumgarte.alpha, 1/s */
    double beta_;  /* baumgarte.beta, 1/s */
    double floor_radius_;  /* bearings.floor.radius, m */
    double floor_clearance_;  /* bearings.floor.clearance, m */
    double floor_length_;  /* bearings.floor.length, m */
    double steel_E_;  /* materials.steel.E, Pa */
    double steel_nu_;  /* materials.steel.nu, 1 */
    double elastic_normal_stiffness_;  /* contacts.elastic.normal.stiffness, force at unit penetration, N/m^n */
    double elastic_normal_exponent_;  /* contacts.elastic.normal.exponent, 1 */
    double elastic_normal_restitution_;  /* contacts.elastic.normal.restitution, 1 */
    double velocity_floor_;  /* contacts.elastic.velocity_floor, m/s */
    double gravity_y_;  /* gravity.y, m/s^2 */
    double R_j_floor_;  /* journal radius, m */
    double weight_ball_y_;  /* weight, N */
    double two_alpha_;  /* 2 alpha, 1/s */
    double beta_squared_;  /* beta^2, 1/s^2 */
    double inverse_ball_mass_;  /* 1/M, 1/kg */
    double inverse_ball_inertia_;  /* 1/M, 1/(kg*m^2) */
    double tree_metric_ball_x_;  /* of projections, kg */
    double inverse_tree_metric_ball_x_;  /* 1/M, 1/kg */
};

/* Baumgarte's gains in Newton's matrix: 2 alpha and beta^2 of the constraints, 2 alpha of a sticking friction. */
static inline double baumgarte_two_alpha(const Parameters *p) { (void)p; return 0.0; }
static inline double baumgarte_beta_squared(const Parameters *p) { (void)p; return 0.0; }
static inline double stick_gain(const Parameters *p) { (void)p; return 0.0; }

#endif
