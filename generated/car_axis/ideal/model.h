/*
 * car axis on a bumpy road (IVP test set)
 * mechanism car_axis, scene ideal, from the YAML with sha256
 * d514a831ebebc4033738b0f4b026b3c5e03070e9416768c033d5b5af26acf694
 *
 * Sizes and small tables of this scene that the engine needs, and all parameters of a run.
 */
#ifndef GUDGEON_MODEL_H
#define GUDGEON_MODEL_H

#define N_Q 6                   /* coordinates of all bodies */
#define N_ROWS 4                /* constraint equations of the motion */
#define N_ALL_ROWS 4            /* constraint equations of the closed linkage */
#define N_JOINTS 2              /* joints without play */
#define N_DRIVES 1              /* drives */
#define N_CLEARANCES 0          /* joints with play */
#define LAW_STATES 0            /* internal states of the laws of a joint with play, at most */
#define N_FRICTIONS 0           /* friction elements, which may stick */
#define N_SWITCHES 0            /* switching functions of min, max, abs and sign */
#define N_USER_EVENTS 0         /* expressions whose zeros are events */
#define N_SERIES 4              /* results of force elements */
#define INTEGRATES 1            /* 1: integrated; 0: no degree of freedom, drives determine positions */
#define TREE 1                  /* 1: tree coordinates; 0: coordinates of all bodies */
#define POSITIONS_IN_TREE 0     /* the same for kinematic analysis */
#define N_X 3                   /* coordinates that are integrated */
#define N_LOOPS 1               /* constraint equations of these */
#define N_DEPENDENT 0           /* dependent coordinates, which drives determine through loops */
#define N_DEPENDENT_VALUES 0    /* these, and cosines and sines of their angles */
#define SMOOTH_DRIVEN_LOOPS 0   /* 1: drives of driven loops have no switching functions */
#define TREE_PIVOTS 0           /* statuses of pivots before those of driven loops */
#define HAS_ABSOLUTE_FALLBACK 1 /* 1: if a pivot vanishes, absolute coordinates are used */
#define LARGEST_BLOCK 0         /* constraint equations that are solved together */
#define N_VALUES 27             /* values of the linearized equations */
#define N_FACTORS 15            /* values of their factors L and U */
#define IMPLICIT_STAGES 0       /* 1: there are methods that solve all stages together */
#define HAS_LANES 1             /* runs in vector lanes */
#define DRIVE_IMPULSES 0        /* 1: rates of drives may jump, and there are degrees of freedom */
#define RATE_JUMPS 0            /* 1: the rate of a drive may jump */
#define N_MONITORED 0           /* monitored switching functions and user events */
#define KNOWN_BOUNDS 0          /* 1: bounds of monitored functions over ranges of the state are known */
#define MONITORS_STATE 0        /* 1: the bounds depend on the state, not only on time */
#define N_TERMS 4               /* terms that depend on time only, whose changes a step may miss */
#define N_TRANSIENTS 4          /* the first of these: transients that a step of any motion may miss */
#define N_GUESS 0               /* coordinates that the start gives as guesses */
#define GUESSED_POINTS 0        /* 1: some guesses are coordinates of points */
#define N_SET 2                 /* coordinates that the start sets */
#define N_RATES 2               /* velocities that the start sets */
#define TAYLOR 64               /* products of the Taylor series of the motion */

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
static const int set_coordinate[] = {1, 2};
static const int rate_coordinate[] = {1, 2};
static const int drive_row[] = {3};
static const unsigned char row_is_length[] = {1, 1, 1, 0};
static const int motion_row[] = {0, 1, 2, 3};
static const int phi_q_first[] = {0, 2, 4, 10, 11};
static const short phi_q_column[] = {3, 5, 4, 5, 0, 1, 2, 3, 4, 5, 5};
static const unsigned char is_angle[] = {0, 0, 1};
static const unsigned char film_joint[] = {0};
static const short monitored_event[] = {0};
static const short monitored_index[] = {0};
static const unsigned char is_continuous_switch[] = {0};
static const int friction_of_pivot[] = {0};

/* The engine reads no further: scenes that have all this in common share its code. */

/* Parameters in SI units: first those that a user may set, then those that prepare() derives. */
struct Parameters {
    double length_;  /* parameters.length, m */
    double half_mass_;  /* parameters.half_mass, kg */
    double r_;  /* parameters.r, m */
    double omega_;  /* parameters.omega, 1/s */
    double axle_mass_;  /* bodies.axle.mass, kg */
    double axle_inertia_;  /* bodies.axle.inertia, kg*m^2 */
    double road_mass_;  /* bodies.road.mass, kg */
    double road_inertia_;  /* bodies.road.inertia, kg*m^2 */
    double axle_length_;  /* bodies.axle.length, m */
    double road_length_;  /* bodies.road.length, m */
    double alpha_;  /* baumgarte.alpha, 1/s */
    double beta_;  /* baumgarte.beta, 1/s */
    double slot_direction_y_;  /* joints.slot.direction.y, 1 */
    double gravity_y_;  /* gravity.y, m/s^2 */
    double left_stiffness_;  /* forces.left.stiffness, N/m */
    double left_free_length_;  /* forces.left.free_length, m */
    double right_stiffness_;  /* forces.right.stiffness, N/m */
    double right_free_length_;  /* forces.right.free_length, m */
    double set_axle_y_;  /* start.set.axle.y, m */
    double set_axle_theta_;  /* start.set.axle.theta, rad */
    double rates_axle_vy_;  /* start.rates.axle.vy, m/s */
    double rates_axle_omega_;  /* start.rates.axle.omega, 1/s */
    double axle_head_s_x_;  /* point from the centre of mass, m */
    double road_head_s_x_;  /* point from the centre of mass, m */
    double weight_axle_y_;  /* weight, N */
    double weight_road_y_;  /* weight, N */
    double axle_turning_;  /* J and m s^2 of its joints, kg*m^2 */
    double two_alpha_;  /* 2 alpha, 1/s */
    double beta_squared_;  /* beta^2, 1/s^2 */
    double inverse_axle_mass_;  /* 1/M, 1/kg */
    double axle_tail_span_x_;  /* vector in its frame, m */
    double road_head_span_x_;  /* vector in its frame, m */
    double inertia_road_road_;  /* sum of m w.w, kg*m^2 */
    double mass_bump_bump_;  /* constant of M, kg*m^2 */
    double weight_road_across_;  /* weight, N*m */
    double inverse_axle_inertia_;  /* 1/M, 1/(kg*m^2) */
    double mass_of_all_;  /* of projections, kg */
    double tree_metric_axle_x_;  /* of projections, kg */
    double tree_metric_axle_theta_;  /* of projections, kg*m^2 */
    double inverse_tree_metric_axle_x_;  /* 1/M, 1/kg */
    double inverse_tree_metric_axle_theta_;  /* 1/M, 1/(kg*m^2) */
};

/* Baumgarte's gains in Newton's matrix: 2 alpha and beta^2 of the constraints, 2 alpha of a sticking friction. */
static inline double baumgarte_two_alpha(const Parameters *p) { (void)p; return 0.0; }
static inline double baumgarte_beta_squared(const Parameters *p) { (void)p; return 0.0; }
static inline double stick_gain(const Parameters *p) { (void)p; return 0.0; }

#endif
