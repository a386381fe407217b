/*
 * 2-DOF nine-bar press with play in joints A and B
 * mechanism nine_bar_press, scene dry, from the YAML with sha256
 * 7728bd5042c3c8cedecd3281c75feb638c729a0a8b05887c6f05c5482d45768f
 *
 * Sizes and small tables of this scene that the engine needs, and all parameters of a run.
 */
#ifndef GUDGEON_MODEL_H
#define GUDGEON_MODEL_H

#define N_Q 24                  /* coordinates of all bodies */
#define N_ROWS 20               /* constraint equations of the motion */
#define N_ALL_ROWS 24           /* constraint equations of the closed linkage */
#define N_JOINTS 9              /* joints without play */
#define N_DRIVES 2              /* drives */
#define N_CLEARANCES 2          /* joints with play */
#define LAW_STATES 0            /* internal states of the laws of a joint with play, at most */
#define N_FRICTIONS 0           /* friction elements, which may stick */
#define N_SWITCHES 10           /* switching functions of min, max, abs and sign */
#define N_USER_EVENTS 0         /* expressions whose zeros are events */
#define N_SERIES 0              /* results of force elements */
#define INTEGRATES 1            /* 1: integrated; 0: no degree of freedom, drives determine positions */
#define TREE 1                  /* 1: tree coordinates; 0: coordinates of all bodies */
#define POSITIONS_IN_TREE 0     /* the same for kinematic analysis */
#define N_X 5                   /* coordinates that are integrated */
#define N_LOOPS 1               /* constraint equations of these */
#define N_DEPENDENT 0           /* dependent coordinates, which drives determine through loops */
#define N_DEPENDENT_VALUES 0    /* these, and cosines and sines of their angles */
#define SMOOTH_DRIVEN_LOOPS 0   /* 1: drives of driven loops have no switching functions */
#define TREE_PIVOTS 0           /* statuses of pivots before those of driven loops */
#define HAS_ABSOLUTE_FALLBACK 1 /* 1: if a pivot vanishes, absolute coordinates are used */
#define LARGEST_BLOCK 0         /* constraint equations that are solved together */
#define N_VALUES 67             /* values of the linearized equations */
#define N_FACTORS 21            /* values of their factors L and U */
#define IMPLICIT_STAGES 0       /* 1: there are methods that solve all stages together */
#define HAS_LANES 1             /* runs in vector lanes */
#define DRIVE_IMPULSES 0        /* 1: rates of drives may jump, and there are degrees of freedom */
#define RATE_JUMPS 0            /* 1: the rate of a drive may jump */
#define N_MONITORED 0           /* monitored switching functions and user events */
#define KNOWN_BOUNDS 0          /* 1: bounds of monitored functions over ranges of the state are known */
#define MONITORS_STATE 0        /* 1: the bounds depend on the state, not only on time */
#define N_TERMS 0               /* terms that depend on time only, whose changes a step may miss */
#define N_TRANSIENTS 0          /* the first of these: transients that a step of any motion may miss */
#define N_GUESS 5               /* coordinates that the start gives as guesses */
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
static const int guess_coordinate[] = {5, 8, 14, 17, 20};
static const int set_coordinate[] = {0};
static const int rate_coordinate[] = {0};
static const int drive_row[] = {22, 23};
static const unsigned char row_is_length[] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0};
static const int motion_row[] = {0, 1, 2, 3, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23};
static const int phi_q_first[] = {0, 2, 4, 6, 8, 12, 16, 20, 24, 28, 32, 36, 40, 44, 48, 52, 56, 58, 60, 63, 66, 67,
    68, 69, 70};
static const short phi_q_column[] = {0, 2, 1, 2, 9, 11, 10, 11, 0, 2, 3, 5, 1, 2, 4, 5, 9, 11, 6, 8, 10, 11, 7, 8, 3,
    5, 15, 17, 4, 5, 16, 17, 6, 8, 15, 17, 7, 8, 16, 17, 15, 17, 12, 14, 16, 17, 13, 14, 15, 17, 18, 20, 16, 17, 19,
    20, 12, 14, 13, 14, 18, 20, 21, 19, 20, 22, 21, 23, 2, 11};
static const unsigned char is_angle[] = {1, 1, 1, 1, 1};
static const unsigned char film_joint[] = {0, 0};
static const short monitored_event[] = {0};
static const short monitored_index[] = {-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1};
static const unsigned char is_continuous_switch[] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
static const int friction_of_pivot[] = {0};

/* The engine reads no further: scenes that have all this in common share its code. */

/* Parameters in SI units: first those that a user may set, then those that prepare() derives. */
struct Parameters {
    double omega_;  /* parameters.omega, 1/s */
    double omega4_;  /* parameters.omega4, 1/s */
    double l5_;  /* parameters.l5, m */
    double c_;  /* parameters.c, m */
    double L1_mass_;  /* bodies.L1.mass, kg */
    double L1_inertia_;  /* bodies.L1.inertia, kg*m^2 */
    double L2_mass_;  /* bodies.L2.mass, kg */
    double L2_inertia_;  /* bodies.L2.inertia, kg*m^2 */
    double L3_mass_;  /* bodies.L3.mass, kg */
    double L3_inertia_;  /* bodies.L3.inertia, kg*m^2 */
    double L4_mass_;  /* bodies.L4.mass, kg */
    double L4_inertia_;  /* bodies.L4.inertia, kg*m^2 */
    double L6_mass_;  /* bodies.L6.mass, kg */
    double L6_inertia_;  /* bodies.L6.inertia, kg*m^2 */
    double L7_mass_;  /* bodies.L7.mass, kg */
    double L7_inertia_;  /* bodies.L7.inertia, kg*m^2 */
    double L8_mass_;  /* bodies.L8.mass, kg */
    double L8_inertia_;  /* bodies.L8.inertia, kg*m^2 */
    double S9_mass_;  /* bodies.S9.mass, kg */
    double S9_inertia_;  /* bodies.S9.inertia, kg*m^2 */
    double L1_length_;  /* bodies.L1.length, m */
    double L2_length_;  /* bodies.L2.length, m */
    double L3_length_;  /* bodies.L3.length, m */
    double L4_length_;  /* bodies.L4.length, m */
    double L6_length_;  /* bodies.L6.length, m */
    double L7_length_;  /* bodies.L7.length, m */
    double L8_length_;  /* bodies.L8.length, m */
    double alpha_;  /* baumgarte.alpha, 1/s */
    double beta_;  /* baumgarte.beta, 1/s */
    double O4_y_;  /* ground.O4.y, m */
    double O6_x_;  /* ground.O6.x, m */
    double guide_axis_y_;  /* joints.guide.axis.y, 1 */
    double pin_radius_;  /* bearings.pin.radius, m */
    double pin_clearance_;  /* bearings.pin.clearance, m */
    double pin_length_;  /* bearings.pin.length, m */
    double aluminium_E_;  /* materials.aluminium.E, Pa */
    double pin_bearing_material_E_;  /* bearings.pin.bearing_material.E, Pa */
    double aluminium_nu_;  /* materials.aluminium.nu, 1 */
    double pin_bearing_material_nu_;  /* bearings.pin.bearing_material.nu, 1 */
    double pin_journal_material_E_;  /* bearings.pin.journal_material.E, Pa */
    double pin_journal_material_nu_;  /* bearings.pin.journal_material.nu, 1 */
    double dry_normal_restitution_;  /* contacts.dry.normal.restitution, 1 */
    double dry_normal_exponent_;  /* contacts.dry.normal.exponent, 1 */
    double dry_friction_mu_;  /* contacts.dry.friction.mu, 1 */
    double dry_friction_v0_;  /* contacts.dry.friction.v0, m/s */
    double dry_friction_v1_;  /* contacts.dry.friction.v1, m/s */
    double velocity_floor_;  /* contacts.dry.velocity_floor, m/s */
    double gravity_y_;  /* gravity.y, m/s^2 */
    double steel_45_E_;  /* materials.steel_45.E, Pa */
    double steel_45_nu_;  /* materials.steel_45.nu, 1 */
    double pin_bearing_material_;  /* bearings.pin.bearing_material, 1 */
    double pin_journal_material_;  /* bearings.pin.journal_material, 1 */
    double guess_L2_theta_;  /* start.guess.L2.theta, rad */
    double guess_L3_theta_;  /* start.guess.L3.theta, rad */
    double guess_L6_theta_;  /* start.guess.L6.theta, rad */
    double guess_L7_theta_;  /* start.guess.L7.theta, rad */
    double guess_L8_theta_;  /* start.guess.L8.theta, rad */
    double L1_head_s_x_;  /* point from the centre of mass, m */
    double L2_head_s_x_;  /* point from the centre of mass, m */
    double L3_head_s_x_;  /* point from the centre of mass, m */
    double L4_head_s_x_;  /* point from the centre of mass, m */
    double L6_head_s_x_;  /* point from the centre of mass, m */
    double L7_head_s_x_;  /* point from the centre of mass, m */
    double L8_head_s_x_;  /* point from the centre of mass, m */
    double R_j_pin_;  /* journal radius, m */
    double dry_pin_K_;  /* contact stiffness, N/m^1.5 */
    double dry_pin_hysteresis_;  /* hysteresis damping factor a, 1 */
    double dry_pin_friction_slope_;  /* 1/(v1 - v0), s/m */
    double weight_L1_y_;  /* weight, N */
    double weight_L2_y_;  /* weight, N */
    double weight_L3_y_;  /* weight, N */
    double weight_L4_y_;  /* weight, N */
    double weight_L6_y_;  /* weight, N */
    double weight_L7_y_;  /* weight, N */
    double weight_L8_y_;  /* weight, N */
    double weight_S9_y_;  /* weight, N */
    double L2_turning_;  /* J and m s^2 of its joints, kg*m^2 */
    double L3_turning_;  /* J and m s^2 of its joints, kg*m^2 */
    double L6_turning_;  /* J and m s^2 of its joints, kg*m^2 */
    double L7_turning_;  /* J and m s^2 of its joints, kg*m^2 */
    double L8_turning_;  /* J and m s^2 of its joints, kg*m^2 */
    double two_alpha_;  /* 2 alpha, 1/s */
    double beta_squared_;  /* beta^2, 1/s^2 */
    double mobility_guide_offset_;  /* 1/m of the bodies of a row, 1/kg */
    double L6_head_span_x_;  /* vector in its frame, m */
    double L7_com_span_x_;  /* vector in its frame, m */
    double L7_tail_span_x_;  /* vector in its frame, m */
    double L2_com_span_x_;  /* vector in its frame, m */
    double L3_com_span_x_;  /* vector in its frame, m */
    double L8_head_span_x_;  /* vector in its frame, m */
    double L1_head_span_x_;  /* vector in its frame, m */
    double L2_tail_span_x_;  /* vector in its frame, m */
    double L4_head_span_x_;  /* vector in its frame, m */
    double L3_tail_span_x_;  /* vector in its frame, m */
    double inertia_L1_L1_;  /* sum of m w.w, kg*m^2 */
    double inertia_L6_L6_;  /* sum of m w.w, kg*m^2 */
    double inertia_L6_L7_;  /* sum of m w.w, kg*m^2 */
    double inertia_L6_L2_;  /* sum of m w.w, kg*m^2 */
    double inertia_L7_L7_;  /* sum of m w.w, kg*m^2 */
    double inertia_L7_L2_;  /* sum of m w.w, kg*m^2 */
    double inertia_L2_L2_;  /* sum of m w.w, kg*m^2 */
    double inertia_L6_L3_;  /* sum of m w.w, kg*m^2 */
    double inertia_L7_L3_;  /* sum of m w.w, kg*m^2 */
    double inertia_L3_L3_;  /* sum of m w.w, kg*m^2 */
    double inertia_L4_L4_;  /* sum of m w.w, kg*m^2 */
    double inertia_L6_L8_;  /* sum of m w.w, kg*m^2 */
    double inertia_L8_L8_;  /* sum of m w.w, kg*m^2 */
    double mass_crank1_crank1_;  /* constant of M, kg*m^2 */
    double mass_L6_L6_;  /* constant of M, kg*m^2 */
    double mass_L7_L7_;  /* constant of M, kg*m^2 */
    double mass_L2_L2_;  /* constant of M, kg*m^2 */
    double mass_L3_L3_;  /* constant of M, kg*m^2 */
    double mass_crank4_crank4_;  /* constant of M, kg*m^2 */
    double mass_L8_L8_;  /* constant of M, kg*m^2 */
    double weight_L1_across_;  /* weight, N*m */
    double weight_L6_across_;  /* weight, N*m */
    double weight_L7_across_;  /* weight, N*m */
    double weight_L2_across_;  /* weight, N*m */
    double weight_L3_across_;  /* weight, N*m */
    double weight_L4_across_;  /* weight, N*m */
    double weight_L8_across_;  /* weight, N*m */
    double inverse_mass_L8_L8_;  /* 1/M, 1/(kg*m^2) */
    double inverse_mass_L2_L2_;  /* 1/M, 1/(kg*m^2) */
    double mass_of_all_;  /* of projections, kg */
    double tree_metric_L6_theta_;  /* of projections, kg*m^2 */
    double tree_metric_L7_theta_;  /* of projections, kg*m^2 */
    double tree_metric_L8_theta_;  /* of projections, kg*m^2 */
    double tree_metric_L2_theta_;  /* of projections, kg*m^2 */
    double tree_metric_L3_theta_;  /* of projections, kg*m^2 */
    double inverse_tree_metric_L8_theta_;  /* 1/M, 1/(kg*m^2) */
    double inverse_tree_metric_L2_theta_;  /* 1/M, 1/(kg*m^2) */
};

/* Baumgarte's gains in Newton's matrix: 2 alpha and beta^2 of the constraints, 2 alpha of a sticking friction. */
static inline double baumgarte_two_alpha(const Parameters *p) { (void)p; return 0.0; }
static inline double baumgarte_beta_squared(const Parameters *p) { (void)p; return 0.0; }
static inline double stick_gain(const Parameters *p) { (void)p; return 0.0; }

#endif
