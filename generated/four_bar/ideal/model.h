/*
 * four-bar linkage, a crank-rocker
 * mechanism four_bar, scene ideal, from the YAML with sha256
 * b12d3de1bc7dd85432a1c63d8fb244c85309101a992a6a1060cd5bf3197df8f8
 *
 * Sizes and small tables of this scene that the engine needs, and all parameters of a run.
 */
#ifndef GUDGEON_MODEL_H
#define GUDGEON_MODEL_H

#define N_Q 9                   /* coordinates of all bodies */
#define N_ROWS 9                /* constraint equations of the motion */
#define N_ALL_ROWS 9            /* constraint equations of the closed linkage */
#define N_JOINTS 4              /* joints without play */
#define N_DRIVES 1              /* drives */
#define N_CLEARANCES 0          /* joints with play */
#define LAW_STATES 0            /* internal states of the laws of a joint with play, at most */
#define N_FRICTIONS 0           /* friction elements, which may stick */
#define N_SWITCHES 0            /* switching functions of min, max, abs and sign */
#define N_USER_EVENTS 0         /* expressions whose zeros are events */
#define N_SERIES 0              /* results of force elements */
#define INTEGRATES 0            /* 1: integrated; 0: no degree of freedom, drives determine positions */
#define TREE 1                  /* 1: tree coordinates; 0: coordinates of all bodies */
#define POSITIONS_IN_TREE 1     /* the same for kinematic analysis */
#define N_X 2                   /* coordinates that are integrated */
#define N_LOOPS 2               /* constraint equations of these */
#define N_DEPENDENT 0           /* dependent coordinates, which drives determine through loops */
#define N_DEPENDENT_VALUES 0    /* these, and cosines and sines of their angles */
#define SMOOTH_DRIVEN_LOOPS 0   /* 1: drives of driven loops have no switching functions */
#define TREE_PIVOTS 0           /* statuses of pivots before those of driven loops */
#define HAS_ABSOLUTE_FALLBACK 1 /* 1: if a pivot vanishes, absolute coordinates are used */
#define LARGEST_BLOCK 2         /* constraint equations that are solved together */
#define N_VALUES 0              /* values of the linearized equations */
#define N_FACTORS 0             /* values of their factors L and U */
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
static const int guess_coordinate[] = {5, 8};
static const int set_coordinate[] = {0};
static const int rate_coordinate[] = {0};
static const int drive_row[] = {8};
static const unsigned char row_is_length[] = {1, 1, 1, 1, 1, 1, 1, 1, 0};
static const int motion_row[] = {0, 1, 2, 3, 4, 5, 6, 7, 8};
static const int phi_q_first[] = {0, 2, 4, 8, 12, 16, 20, 22, 24, 25};
static const short phi_q_column[] = {0, 2, 1, 2, 0, 2, 3, 5, 1, 2, 4, 5, 3, 5, 6, 8, 4, 5, 7, 8, 6, 8, 7, 8, 2};
static const unsigned char is_angle[] = {1, 1};
static const unsigned char film_joint[] = {0};

/* The engine reads no further: scenes that have all this in common share its code. */

/* Parameters in SI units: first those that a user may set, then those that prepare() derives. */
struct Parameters {
    double omega_;  /* parameters.omega, 1/s */
    double crank_mass_;  /* bodies.crank.mass, kg */
    double crank_inertia_;  /* bodies.crank.inertia, kg*m^2 */
    double coupler_mass_;  /* bodies.coupler.mass, kg */
    double coupler_inertia_;  /* bodies.coupler.inertia, kg*m^2 */
    double rocker_mass_;  /* bodies.rocker.mass, kg */
    double rocker_inertia_;  /* bodies.rocker.inertia, kg*m^2 */
    double crank_length_;  /* bodies.crank.length, m */
    double coupler_length_;  /* bodies.coupler.length, m */
    double coupler_points_tracer_x_;  /* bodies.coupler.points.tracer.x, m */
    double coupler_points_tracer_y_;  /* bodies.coupler.points.tracer.y, m */
    double rocker_length_;  /* bodies.rocker.length, m */
    double alpha_;  /* baumgarte.alpha, 1/s */
    double beta_;  /* baumgarte.beta, 1/s */
    double B0_x_;  /* ground.B0.x, m */
    double gravity_y_;  /* gravity.y, m/s^2 */
    double guess_coupler_theta_;  /* start.guess.coupler.theta, rad */
    double guess_rocker_theta_;  /* start.guess.rocker.theta, rad */
    double crank_head_s_x_;  /* point from the centre of mass, m */
    double coupler_head_s_x_;  /* point from the centre of mass, m */
    double coupler_tracer_s_x_;  /* point from the centre of mass, m */
    double rocker_head_s_x_;  /* point from the centre of mass, m */
    double weight_crank_y_;  /* weight, N */
    double weight_coupler_y_;  /* weight, N */
    double weight_rocker_y_;  /* weight, N */
    double coupler_turning_;  /* J and m s^2 of its joints, kg*m^2 */
    double rocker_turning_;  /* J and m s^2 of its joints, kg*m^2 */
    double two_alpha_;  /* 2 alpha, 1/s */
    double beta_squared_;  /* beta^2, 1/s^2 */
    double mobility_B_x_;  /* 1/m of the bodies of a row, 1/kg */
    double crank_head_span_x_;  /* vector in its frame, m */
    double coupler_head_span_x_;  /* vector in its frame, m */
    double rocker_head_span_x_;  /* vector in its frame, m */
    double inertia_crank_crank_;  /* sum of m w.w, kg*m^2 */
    double inertia_crank_coupler_;  /* sum of m w.w, kg*m^2 */
    double inertia_coupler_coupler_;  /* sum of m w.w, kg*m^2 */
    double inertia_rocker_rocker_;  /* sum of m w.w, kg*m^2 */
    double mass_motor_motor_;  /* constant of M, kg*m^2 */
    double mass_coupler_coupler_;  /* constant of M, kg*m^2 */
    double mass_rocker_rocker_;  /* constant of M, kg*m^2 */
    double weight_crank_across_;  /* weight, N*m */
    double weight_coupler_across_;  /* weight, N*m */
    double weight_rocker_across_;  /* weight, N*m */
    double inverse_mass_rocker_rocker_;  /* 1/M, 1/(kg*m^2) */
    double inverse_mass_coupler_coupler_;  /* 1/M, 1/(kg*m^2) */
    double mass_of_all_;  /* of projections, kg */
    double tree_metric_rocker_theta_;  /* of projections, kg*m^2 */
    double tree_metric_coupler_theta_;  /* of projections, kg*m^2 */
    double inverse_tree_metric_rocker_theta_;  /* 1/M, 1/(kg*m^2) */
    double inverse_tree_metric_coupler_theta_;  /* 1/M, 1/(kg*m^2) */
};

#endif
