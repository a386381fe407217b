/*
 * slider-crank mechanism with play in the slider's pin
 * mechanism slider_crank, scene dry, from the YAML with sha256
 * 52f6801b39dd5254c93c6a7ff0cd2fd997c0c61da653b6931830147ebd09225b
 *
 * Sizes and small tables of this scene that the engine needs, and all parameters of a run.
 */
#ifndef GUDGEON_MODEL_H
#define GUDGEON_MODEL_H

#define N_Q 9                   /* coordinates of all bodies */
#define N_ROWS 7                /* constraint equations of the motion */
#define N_ALL_ROWS 9            /* constraint equations of the closed linkage */
#define N_JOINTS 3              /* joints without play */
#define N_DRIVES 1              /* drives */
#define N_CLEARANCES 1          /* joints with play */
#define LAW_STATES 0            /* internal states of the laws of a joint with play, at most */
#define N_FRICTIONS 0           /* friction elements, which may stick */
#define N_SWITCHES 5            /* switching functions of min, max, abs and sign */
#define N_USER_EVENTS 0         /* expressions whose zeros are events */
#define N_SERIES 0              /* results of force elements */
#define INTEGRATES 1            /* 1: integrated; 0: no degree of freedom, drives determine positions */
#define TREE 1                  /* 1: tree coordinates; 0: coordinates of all bodies */
#define POSITIONS_IN_TREE 0     /* the same for kinematic analysis */
#define N_X 2                   /* coordinates that are integrated */
#define N_LOOPS 0               /* constraint equations of these */
#define N_DEPENDENT 0           /* dependent coordinates, which drives determine through loops */
#define N_DEPENDENT_VALUES 0    /* these, and cosines and sines of their angles */
#define SMOOTH_DRIVEN_LOOPS 0   /* 1: drives of driven loops have no switching functions */
#define TREE_PIVOTS 0           /* statuses of pivots before those of driven loops */
#define HAS_ABSOLUTE_FALLBACK 0 /* 1: if a pivot vanishes, absolute coordinates are used */
#define LARGEST_BLOCK 0         /* constraint equations that are solved together */
#define N_VALUES 21             /* values of the linearized equations */
#define N_FACTORS 4             /* values of their factors L and U */
#define IMPLICIT_STAGES 0       /* 1: there are methods that solve all stages together */
#define HAS_LANES 1             /* runs in vector lanes */
#define DRIVE_IMPULSES 0        /* 1: rates of drives may jump, and there are degrees of freedom */
#define RATE_JUMPS 0            /* 1: the rate of a drive may jump */
#define N_MONITORED 0           /* monitored switching functions and user events */
#define KNOWN_BOUNDS 0          /* 1: bounds of monitored functions over ranges of the state are known */
#define MONITORS_STATE 0        /* 1: the bounds depend on the state, not only on time */
#define N_TERMS 0               /* terms that depend on time only, whose changes a step may miss */
#define N_TRANSIENTS 0          /* the first of these: transients that a step of any motion may miss */
#define N_GUESS 2               /* coordinates that the start gives as guesses */
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
static const int guess_coordinate[] = {5, 6};
static const int set_coordinate[] = {0};
static const int rate_coordinate[] = {0};
static const int drive_row[] = {8};
static const unsigned char row_is_length[] = {1, 1, 1, 1, 1, 1, 1, 0, 0};
static const int motion_row[] = {0, 1, 2, 3, 6, 7, 8};
static const int phi_q_first[] = {0, 2, 4, 8, 12, 15, 18, 19, 20, 21};
static const short phi_q_column[] = {0, 2, 1, 2, 0, 2, 3, 5, 1, 2, 4, 5, 3, 5, 6, 4, 5, 7, 7, 8, 2};
static const unsigned char is_angle[] = {0, 1};
static const unsigned char film_joint[] = {0};
static const short monitored_event[] = {0};
static const short monitored_index[] = {-1, -1, -1, -1, -1, -1};
static const unsigned char is_continuous_switch[] = {1, 1, 1, 1, 1};
static const int friction_of_pivot[] = {0};

/* The engine reads no further: scenes that have all this in common share its code. */

/* Parameters in SI units: first those that a user may set, then those that prepare() derives. */
struct Parameters {
    double omega_;  /* parameters.omega, 1/s */
    double c_;  /* parameters.c, m */
    double crank_mass_;  /* bodies.crank.mass, kg */
    double crank_inertia_;  /* bodies.crank.inertia, kg*m^2 */
    double rod_mass_;  /* bodies.rod.mass, kg */
    double rod_inertia_;  /* bodies.rod.inertia, kg*m^2 */
    double slider_mass_;  /* bodies.slider.mass, kg */
    double slider_inertia_;  /* bodies.slider.inertia, kg*m^2 */
    double crank_length_;  /* bodies.crank.length, m */
    double rod_length_;  /* bodies.rod.length, m */
    double alpha_;  /* baumgarte.alpha, 1/s */
    double beta_;  /* baumgarte.beta, 1/s */
    double cylinder_axis_x_;  /* joints.cylinder.axis.x, 1 */
    double pin_radius_;  /* bearings.pin.radius, m */
    double pin_clearance_;  /* bearings.pin.clearance, m */
    double pin_length_;  /* bearings.pin.length, m */
    double steel_E_;  /* materials.steel.E, Pa */
    double steel_nu_;  /* materials.steel.nu, 1 */
    double dry_normal_restitution_;  /* contacts.dry.normal.restitution, 1 */
    double dry_normal_exponent_;  /* contacts.dry.normal.exponent, 1 */
    double dry_friction_mu_;  /* contacts.dry.friction.mu, 1 */
    double dry_friction_v0_;  /* contacts.dry.friction.v0, m/s */
    double dry_friction_v1_;  /* contacts.dry.friction.v1, m/s */
    double velocity_floor_;  /* contacts.dry.velocity_floor, m/s */
    double guess_rod_theta_;  /* start.guess.rod.theta, rad */
    double guess_slider_x_;  /* start.guess.slider.x, m */
    double crank_head_s_x_;  /* point from the centre of mass, m */
    double rod_head_s_x_;  /* point from the centre of mass, m */
    double R_j_pin_;  /* journal radius, m */
    double dry_pin_K_;  /* contact stiffness, N/m^1.5 */
    double dry_pin_hysteresis_;  /* hysteresis damping factor a, 1 */
    double dry_pin_friction_slope_;  /* 1/(v1 - v0), s/m */
    double rod_turning_;  /* J and m s^2 of its joints, kg*m^2 */
    double two_alpha_;  /* 2 alpha, 1/s */
    double beta_squared_;  /* beta^2, 1/s^2 */
    double inverse_slider_mass_;  /* 1/M, 1/kg */
    double crank_head_span_x_;  /* vector in its frame, m */
    double rod_head_span_x_;  /* vector in its frame, m */
    double inertia_crank_crank_;  /* sum of m w.w, kg*m^2 */
    double inertia_crank_rod_;  /* sum of m w.w, kg*m^2 */
    double inertia_rod_rod_;  /* sum of m w.w, kg*m^2 */
    double mass_motor_motor_;  /* constant of M, kg*m^2 */
    double mass_rod_rod_;  /* constant of M, kg*m^2 */
    double inverse_mass_rod_rod_;  /* 1/M, 1/(kg*m^2) */
    double mass_of_all_;  /* of projections, kg */
    double tree_metric_cylinder_slide_;  /* of projections, kg */
    double tree_metric_rod_theta_;  /* of projections, kg*m^2 */
    double inverse_tree_metric_cylinder_slide_;  /* 1/M, 1/kg */
    double inverse_tree_metric_rod_theta_;  /* 1/M, 1/(kg*m^2) */
};

/* Baumgarte's gains in Newton's matrix: 2 alpha and beta^2 of the constraints, 2 alpha of a sticking friction. */
static inline double baumgarte_two_alpha(const Parameters *p) { (void)p; return 0.0; }
static inline double baumgarte_beta_squared(const Parameters *p) { (void)p; return 0.0; }
static inline double stick_gain(const Parameters *p) { (void)p; return 0.0; }

#endif
