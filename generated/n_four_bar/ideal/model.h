/*
 * N-four-bar, N = 2 (IFToMM A02)
 * mechanism n_four_bar, scene ideal, from the YAML with sha256
 * bb7f895f7916c5d685102528ff720e01752885680b9e942a96c78442e9eaf383
 *
 * Sizes and small tables of this scene that the engine needs, and all parameters of a run.
 */
#ifndef GUDGEON_MODEL_H
#define GUDGEON_MODEL_H

#define N_Q 15                  /* coordinates of all bodies */
#define N_ROWS 14               /* constraint equations of the motion */
#define N_ALL_ROWS 14           /* constraint equations of the closed linkage */
#define N_JOINTS 7              /* joints without play */
#define N_DRIVES 0              /* drives */
#define N_CLEARANCES 0          /* joints with play */
#define LAW_STATES 0            /* internal states of the laws of a joint with play, at most */
#define N_FRICTIONS 0           /* friction elements, which may stick */
#define N_SWITCHES 0            /* switching functions of min, max, abs and sign */
#define N_USER_EVENTS 0         /* expressions whose zeros are events */
#define N_SERIES 0              /* results of force elements */
#define INTEGRATES 1            /* 1: integrated; 0: no degree of freedom, drives determine positions */
#define TREE 1                  /* 1: tree coordinates; 0: coordinates of all bodies */
#define POSITIONS_IN_TREE 0     /* the same for kinematic analysis */
#define N_X 5                   /* coordinates that are integrated */
#define N_LOOPS 4               /* constraint equations of these */
#define N_DEPENDENT 0           /* dependent coordinates, which drives determine through loops */
#define N_DEPENDENT_VALUES 0    /* these, and cosines and sines of their angles */
#define SMOOTH_DRIVEN_LOOPS 0   /* 1: drives of driven loops have no switching functions */
#define TREE_PIVOTS 0           /* statuses of pivots before those of driven loops */
#define HAS_ABSOLUTE_FALLBACK 1 /* 1: if a pivot vanishes, absolute coordinates are used */
#define LARGEST_BLOCK 0         /* constraint equations that are solved together */
#define N_VALUES 45             /* values of the linearized equations */
#define N_FACTORS 41            /* values of their factors L and U */
#define IMPLICIT_STAGES 0       /* 1: there are methods that solve all stages together */
#define HAS_LANES 1             /* runs in vector lanes */
#define DRIVE_IMPULSES 0        /* 1: rates of drives may jump, and there are degrees of freedom */
#define RATE_JUMPS 0            /* 1: the rate of a drive may jump */
#define N_MONITORED 0           /* monitored switching functions and user events */
#define KNOWN_BOUNDS 0          /* 1: bounds of monitored functions over ranges of the state are known */
#define MONITORS_STATE 0        /* 1: the bounds depend on the state, not only on time */
#define N_TERMS 0               /* terms that depend on time only, whose changes a step may miss */
#define N_TRANSIENTS 0          /* the first of these: transients that a step of any motion may miss */
#define N_GUESS 4               /* coordinates that the start gives as guesses */
#define GUESSED_POINTS 0        /* 1: some guesses are coordinates of points */
#define N_SET 1                 /* coordinates that the start sets */
#define N_RATES 1               /* velocities that the start sets */

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
static const int guess_coordinate[] = {5, 8, 11, 14};
static const int set_coordinate[] = {2};
static const int rate_coordinate[] = {2};
static const int drive_row[] = {0};
static const unsigned char row_is_length[] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
static const int motion_row[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13};
static const int phi_q_first[] = {0, 2, 4, 6, 8, 10, 12, 16, 20, 24, 28, 32, 36, 40, 44};
static const short phi_q_column[] = {0, 2, 1, 2, 3, 5, 4, 5, 6, 8, 7, 8, 0, 2, 9, 11, 1, 2, 10, 11, 9, 11, 3, 5, 10,
    11, 4, 5, 3, 5, 12, 14, 4, 5, 13, 14, 12, 14, 6, 8, 13, 14, 7, 8};
static const unsigned char is_angle[] = {1, 1, 1, 1, 1};
static const unsigned char film_joint[] = {0};
static const short monitored_event[] = {0};
static const short monitored_index[] = {0};
static const unsigned char is_continuous_switch[] = {0};
static const int friction_of_pivot[] = {0};

/* The engine reads no further: scenes that have all this in common share its code. */

/* Parameters in SI units: first those that a user may set, then those that prepare() derives. */
struct Parameters {
    double length_;  /* parameters.length, m */
    double mass_;  /* parameters.mass, kg */
    double inertia_;  /* parameters.inertia, kg*m^2 */
    double crank0_mass_;  /* bodies.crank0.mass, kg */
    double crank0_inertia_;  /* bodies.crank0.inertia, kg*m^2 */
    double crank1_mass_;  /* bodies.crank1.mass, kg */
    double crank1_inertia_;  /* bodies.crank1.inertia, kg*m^2 */
    double crank2_mass_;  /* bodies.crank2.mass, kg */
    double crank2_inertia_;  /* bodies.crank2.inertia, kg*m^2 */
    double coupler1_mass_;  /* bodies.coupler1.mass, kg */
    double coupler1_inertia_;  /* bodies.coupler1.inertia, kg*m^2 */
    double coupler2_mass_;  /* bodies.coupler2.mass, kg */
    double coupler2_inertia_;  /* bodies.coupler2.inertia, kg*m^2 */
    double crank0_length_;  /* bodies.crank0.length, m */
    double crank1_length_;  /* bodies.crank1.length, m */
    double crank2_length_;  /* bodies.crank2.length, m */
    double coupler1_length_;  /* bodies.coupler1.length, m */
    double coupler2_length_;  /* bodies.coupler2.length, m */
    double alpha_;  /* baumgarte.alpha, 1/s */
    double beta_;  /* baumgarte.beta, 1/s */
    double O1_x_;  /* ground.O1.x, m */
    double O2_x_;  /* ground.O2.x, m */
    double gravity_y_;  /* gravity.y, m/s^2 */
    double guess_crank1_theta_;  /* start.guess.crank1.theta, rad */
    double guess_crank2_theta_;  /* start.guess.crank2.theta, rad */
    double guess_coupler1_theta_;  /* start.guess.coupler1.theta, rad */
    double guess_coupler2_theta_;  /* start.guess.coupler2.theta, rad */
    double set_crank0_theta_;  /* start.set.crank0.theta, rad */
    double rates_crank0_omega_;  /* start.rates.crank0.omega, 1/s */
    double crank0_head_s_x_;  /* point from the centre of mass, m */
    double crank1_head_s_x_;  /* point from the centre of mass, m */
    double crank2_head_s_x_;  /* point from the centre of mass, m */
    double coupler1_head_s_x_;  /* point from the centre of mass, m */
    double coupler2_head_s_x_;  /* point from the centre of mass, m */
    double weight_crank0_y_;  /* weight, N */
    double weight_crank1_y_;  /* weight, N */
    double weight_crank2_y_;  /* weight, N */
    double weight_coupler1_y_;  /* weight, N */
    double weight_coupler2_y_;  /* weight, N */
    double crank2_turning_;  /* J and m s^2 of its joints, kg*m^2 */
    double crank0_turning_;  /* J and m s^2 of its joints, kg*m^2 */
    double coupler1_turning_;  /* J and m s^2 of its joints, kg*m^2 */
    double coupler2_turning_;  /* J and m s^2 of its joints, kg*m^2 */
    double crank1_turning_;  /* J and m s^2 of its joints, kg*m^2 */
    double two_alpha_;  /* 2 alpha, 1/s */
    double beta_squared_;  /* beta^2, 1/s^2 */
    double mobility_B1_x_;  /* 1/m of the bodies of a row, 1/kg */
    double mobility_B2_x_;  /* 1/m of the bodies of a row, 1/kg */
    double crank0_head_span_x_;  /* vector in its frame, m */
    double crank1_head_span_x_;  /* vector in its frame, m */
    double coupler2_head_span_x_;  /* vector in its frame, m */
    double crank2_head_span_x_;  /* vector in its frame, m */
    double coupler1_head_span_x_;  /* vector in its frame, m */
    double inertia_crank0_crank0_;  /* sum of m w.w, kg*m^2 */
    double inertia_crank1_crank1_;  /* sum of m w.w, kg*m^2 */
    double inertia_crank2_crank2_;  /* sum of m w.w, kg*m^2 */
    double inertia_crank0_coupler1_;  /* sum of m w.w, kg*m^2 */
    double inertia_coupler1_coupler1_;  /* sum of m w.w, kg*m^2 */
    double inertia_crank1_coupler2_;  /* sum of m w.w, kg*m^2 */
    double inertia_coupler2_coupler2_;  /* sum of m w.w, kg*m^2 */
    double mass_crank0_crank0_;  /* constant of M, kg*m^2 */
    double mass_crank1_crank1_;  /* constant of M, kg*m^2 */
    double mass_crank2_crank2_;  /* constant of M, kg*m^2 */
    double mass_coupler1_coupler1_;  /* constant of M, kg*m^2 */
    double mass_coupler2_coupler2_;  /* constant of M, kg*m^2 */
    double weight_crank0_across_;  /* weight, N*m */
    double weight_crank1_across_;  /* weight, N*m */
    double weight_crank2_across_;  /* weight, N*m */
    double weight_coupler1_across_;  /* weight, N*m */
    double weight_coupler2_across_;  /* weight, N*m */
    double inverse_mass_crank2_crank2_;  /* 1/M, 1/(kg*m^2) */
    double inverse_mass_coupler2_coupler2_;  /* 1/M, 1/(kg*m^2) */
    double inverse_mass_crank0_crank0_;  /* 1/M, 1/(kg*m^2) */
    double mass_of_all_;  /* of projections, kg */
    double tree_metric_crank0_theta_;  /* of projections, kg*m^2 */
    double tree_metric_crank1_theta_;  /* of projections, kg*m^2 */
    double tree_metric_crank2_theta_;  /* of projections, kg*m^2 */
    double tree_metric_coupler1_theta_;  /* of projections, kg*m^2 */
    double tree_metric_coupler2_theta_;  /* of projections, kg*m^2 */
    double inverse_tree_metric_crank2_theta_;  /* 1/M, 1/(kg*m^2) */
    double inverse_tree_metric_crank0_theta_;  /* 1/M, 1/(kg*m^2) */
    double inverse_tree_metric_coupler2_theta_;  /* 1/M, 1/(kg*m^2) */
};

/* Baumgarte's gains in Newton's matrix: 2 alpha and beta^2 of the constraints, 2 alpha of a sticking friction. */
static inline double baumgarte_two_alpha(const Parameters *p) { (void)p; return 0.0; }
static inline double baumgarte_beta_squared(const Parameters *p) { (void)p; return 0.0; }
static inline double stick_gain(const Parameters *p) { (void)p; return 0.0; }

#endif
