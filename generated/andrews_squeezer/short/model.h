/*
 * Andrews' squeezing mechanism (seven-body mechanism)
 * mechanism andrews_squeezer, scene short, from the YAML with sha256
 * 1c3db5e51a3ab9f4757a755acb104f9d9388381b52f465279942f3630ecf5c24
 *
 * Sizes and small tables of this scene that the engine needs, and all parameters of a run.
 */
#ifndef GUDGEON_MODEL_H
#define GUDGEON_MODEL_H

#define N_Q 21                  /* coordinates of all bodies */
#define N_ROWS 20               /* constraint equations of the motion */
#define N_ALL_ROWS 20           /* constraint equations of the closed linkage */
#define N_JOINTS 10             /* joints without play */
#define N_DRIVES 0              /* drives */
#define N_CLEARANCES 0          /* joints with play */
#define LAW_STATES 0            /* internal states of the laws of a joint with play, at most */
#define N_FRICTIONS 0           /* friction elements, which may stick */
#define N_SWITCHES 0            /* switching functions of min, max, abs and sign */
#define N_USER_EVENTS 0         /* expressions whose zeros are events */
#define N_SERIES 3              /* results of force elements */
#define INTEGRATES 1            /* 1: integrated; 0: no degree of freedom, drives determine positions */
#define TREE 1                  /* 1: tree coordinates; 0: coordinates of all bodies */
#define POSITIONS_IN_TREE 0     /* the same for kinematic analysis */
#define N_X 7                   /* coordinates that are integrated */
#define N_LOOPS 6               /* constraint equations of these */
#define N_DEPENDENT 0           /* dependent coordinates, which drives determine through loops */
#define N_DEPENDENT_VALUES 0    /* these, and cosines and sines of their angles */
#define SMOOTH_DRIVEN_LOOPS 0   /* 1: drives of driven loops have no switching functions */
#define TREE_PIVOTS 0           /* statuses of pivots before those of driven loops */
#define HAS_ABSOLUTE_FALLBACK 1 /* 1: if a pivot vanishes, absolute coordinates are used */
#define LARGEST_BLOCK 0         /* constraint equations that are solved together */
#define N_VALUES 70             /* values of the linearized equations */
#define N_FACTORS 71            /* values of their factors L and U */
#define IMPLICIT_STAGES 0       /* 1: there are methods that solve all stages together */
#define HAS_LANES 1             /* runs in vector lanes */
#define DRIVE_IMPULSES 0        /* 1: rates of drives may jump, and there are degrees of freedom */
#define RATE_JUMPS 0            /* 1: the rate of a drive may jump */
#define N_MONITORED 0           /* monitored switching functions and user events */
#define KNOWN_BOUNDS 0          /* 1: bounds of monitored functions over ranges of the state are known */
#define MONITORS_STATE 0        /* 1: the bounds depend on the state, not only on time */
#define N_TERMS 0               /* terms that depend on time only, whose changes a step may miss */
#define N_TRANSIENTS 0          /* the first of these: transients that a step of any motion may miss */
#define N_GUESS 6               /* coordinates that the start gives as guesses */
#define GUESSED_POINTS 0        /* 1: some guesses are coordinates of points */
#define N_SET 1                 /* coordinates that the start sets */
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
static const int guess_coordinate[] = {5, 8, 11, 14, 17, 20};
static const int set_coordinate[] = {2};
static const int rate_coordinate[] = {0};
static const int drive_row[] = {0};
static const unsigned char row_is_length[] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
static const int motion_row[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19};
static const int phi_q_first[] = {0, 2, 4, 6, 8, 10, 12, 14, 16, 20, 24, 28, 32, 36, 40, 44, 48, 52, 56, 60, 64};
static const short phi_q_column[] = {0, 2, 1, 2, 6, 8, 7, 8, 12, 14, 13, 14, 18, 20, 19, 20, 0, 2, 3, 5, 1, 2, 4, 5, 3,
    5, 6, 8, 4, 5, 7, 8, 3, 5, 9, 11, 4, 5, 10, 11, 3, 5, 15, 17, 4, 5, 16, 17, 9, 11, 12, 14, 10, 11, 13, 14, 15, 17,
    18, 20, 16, 17, 19, 20};
static const unsigned char is_angle[] = {1, 1, 1, 1, 1, 1, 1};
static const unsigned char film_joint[] = {0};
static const short monitored_event[] = {0};
static const short monitored_index[] = {0};
static const unsigned char is_continuous_switch[] = {0};
static const int friction_of_pivot[] = {0};

/* The engine reads no further: scenes that have all this in common share its code. */

/* Parameters in SI units: first those that a user may set, then those that prepare() derives. */
struct Parameters {
    double OF_mass_;  /* bodies.OF.mass, kg */
    double OF_inertia_;  /* bodies.OF.inertia, kg*m^2 */
    double FE_mass_;  /* bodies.FE.mass, kg */
    double FE_inertia_;  /* bodies.FE.inertia, kg*m^2 */
    double BDE_mass_;  /* bodies.BDE.mass, kg */
    double BDE_inertia_;  /* bodies.BDE.inertia, kg*m^2 */
    double EG_mass_;  /* bodies.EG.mass, kg */
    double EG_inertia_;  /* bodies.EG.inertia, kg*m^2 */
    double AG_mass_;  /* bodies.AG.mass, kg */
    double AG_inertia_;  /* bodies.AG.inertia, kg*m^2 */
    double HE_mass_;  /* bodies.HE.mass, kg */
    double HE_inertia_;  /* bodies.HE.inertia, kg*m^2 */
    double AH_mass_;  /* bodies.AH.mass, kg */
    double AH_inertia_;  /* bodies.AH.inertia, kg*m^2 */
    double OF_points_O_x_;  /* bodies.OF.points.O.x, m */
    double OF_points_F_x_;  /* bodies.OF.points.F.x, m */
    double FE_points_E_x_;  /* bodies.FE.points.E.x, m */
    double FE_points_F_x_;  /* bodies.FE.points.F.x, m */
    double BDE_points_B_x_;  /* bodies.BDE.points.B.x, m */
    double BDE_points_B_y_;  /* bodies.BDE.points.B.y, m */
    double BDE_points_E_x_;  /* bodies.BDE.points.E.x, m */
    double BDE_points_E_y_;  /* bodies.BDE.points.E.y, m */
    double BDE_points_D_x_;  /* bodies.BDE.points.D.x, m */
    double BDE_points_D_y_;  /* bodies.BDE.points.D.y, m */
    double EG_points_G_y_;  /* bodies.EG.points.G.y, m */
    double EG_points_E_y_;  /* bodies.EG.points.E.y, m */
    double AG_points_A_x_;  /* bodies.AG.points.A.x, m */
    double AG_points_A_y_;  /* bodies.AG.points.A.y, m */
    double AG_points_G_x_;  /* bodies.AG.points.G.x, m */
    double AG_points_G_y_;  /* bodies.AG.points.G.y, m */
    double HE_points_H_x_;  /* bodies.HE.points.H.x, m */
    double HE_points_E_x_;  /* bodies.HE.points.E.x, m */
    double AH_points_A_x_;  /* bodies.AH.points.A.x, m */
    double AH_points_A_y_;  /* bodies.AH.points.A.y, m */
    double AH_points_H_x_;  /* bodies.AH.points.H.x, m */
    double AH_points_H_y_;  /* bodies.AH.points.H.y, m */
    double alpha_;  /* baumgarte.alpha, 1/s */
    double beta_;  /* baumgarte.beta, 1/s */
    double B_x_;  /* ground.B.x, m */
    double B_y_;  /* ground.B.y, m */
    double A_x_;  /* ground.A.x, m */
    double A_y_;  /* ground.A.y, m */
    double C_x_;  /* ground.C.x, m */
    double C_y_;  /* ground.C.y, m */
    double spring_stiffness_;  /* forces.spring.stiffness, N/m */
    double spring_free_length_;  /* forces.spring.free_length, m */
    double motor_value_;  /* forces.motor.value, N*m */
    double guess_FE_theta_;  /* start.guess.FE.theta, rad */
    double guess_BDE_theta_;  /* start.guess.BDE.theta, rad */
    double guess_EG_theta_;  /* start.guess.EG.theta, rad */
    double guess_AG_theta_;  /* start.guess.AG.theta, rad */
    double guess_HE_theta_;  /* start.guess.HE.theta, rad */
    double guess_AH_theta_;  /* start.guess.AH.theta, rad */
    double set_OF_theta_;  /* start.set.OF.theta, rad */
    double BDE_turning_;  /* J and m s^2 of its joints, kg*m^2 */
    double EG_turning_;  /* J and m s^2 of its joints, kg*m^2 */
    double AG_turning_;  /* J and m s^2 of its joints, kg*m^2 */
    double HE_turning_;  /* J and m s^2 of its joints, kg*m^2 */
    double AH_turning_;  /* J and m s^2 of its joints, kg*m^2 */
    double OF_turning_;  /* J and m s^2 of its joints, kg*m^2 */
    double FE_turning_;  /* J and m s^2 of its joints, kg*m^2 */
    double two_alpha_;  /* 2 alpha, 1/s */
    double beta_squared_;  /* beta^2, 1/s^2 */
    double mobility_E3_x_;  /* 1/m of the bodies of a row, 1/kg */
    double mobility_E4_x_;  /* 1/m of the bodies of a row, 1/kg */
    double mobility_E6_x_;  /* 1/m of the bodies of a row, 1/kg */
    double OF_com_span_x_;  /* vector in its frame, m */
    double BDE_com_span_x_;  /* vector in its frame, m */
    double BDE_com_span_y_;  /* vector in its frame, m */
    double AG_com_span_x_;  /* vector in its frame, m */
    double AG_com_span_y_;  /* vector in its frame, m */
    double AH_com_span_x_;  /* vector in its frame, m */
    double AH_com_span_y_;  /* vector in its frame, m */
    double OF_F_span_x_;  /* vector in its frame, m */
    double FE_com_span_x_;  /* vector in its frame, m */
    double BDE_E_span_x_;  /* vector in its frame, m */
    double BDE_E_span_y_;  /* vector in its frame, m */
    double HE_com_span_x_;  /* vector in its frame, m */
    double FE_E_span_x_;  /* vector in its frame, m */
    double EG_com_span_y_;  /* vector in its frame, m */
    double EG_G_span_y_;  /* vector in its frame, m */
    double AG_G_span_x_;  /* vector in its frame, m */
    double AG_G_span_y_;  /* vector in its frame, m */
    double HE_H_span_x_;  /* vector in its frame, m */
    double AH_H_span_x_;  /* vector in its frame, m */
    double AH_H_span_y_;  /* vector in its frame, m */
    double BDE_D_span_x_;  /* vector in its frame, m */
    double BDE_D_span_y_;  /* vector in its frame, m */
    double inertia_OF_OF_;  /* sum of m w.w, kg*m^2 */
    double inertia_OF_FE_;  /* sum of m w.w, kg*m^2 */
    double inertia_FE_FE_;  /* sum of m w.w, kg*m^2 */
    double inertia_BDE_BDE_;  /* sum of m w.w, kg*m^2 */
    double twist_OF_EG_;  /* sum of m wxw, kg*m^2 */
    double twist_FE_EG_;  /* sum of m wxw, kg*m^2 */
    double inertia_EG_EG_;  /* sum of m w.w, kg*m^2 */
    double inertia_AG_AG_;  /* sum of m w.w, kg*m^2 */
    double inertia_BDE_HE_;  /* sum of m w.w, kg*m^2 */
    double twist_BDE_HE_;  /* sum of m wxw, kg*m^2 */
    double inertia_HE_HE_;  /* sum of m w.w, kg*m^2 */
    double inertia_AH_AH_;  /* sum of m w.w, kg*m^2 */
    double mass_OF_OF_;  /* constant of M, kg*m^2 */
    double mass_FE_FE_;  /* constant of M, kg*m^2 */
    double mass_BDE_BDE_;  /* constant of M, kg*m^2 */
    double mass_EG_EG_;  /* constant of M, kg*m^2 */
    double mass_AG_AG_;  /* constant of M, kg*m^2 */
    double mass_HE_HE_;  /* constant of M, kg*m^2 */
    double mass_AH_AH_;  /* constant of M, kg*m^2 */
    double inverse_mass_AG_AG_;  /* 1/M, 1/(kg*m^2) */
    double inverse_mass_AH_AH_;  /* 1/M, 1/(kg*m^2) */
    double inverse_mass_HE_HE_;  /* 1/M, 1/(kg*m^2) */
    double inverse_mass_EG_EG_;  /* 1/M, 1/(kg*m^2) */
    double mass_of_all_;  /* of projections, kg */
    double tree_metric_OF_theta_;  /* of projections, kg*m^2 */
    double tree_metric_BDE_theta_;  /* of projections, kg*m^2 */
    double tree_metric_AG_theta_;  /* of projections, kg*m^2 */
    double tree_metric_AH_theta_;  /* of projections, kg*m^2 */
    double tree_metric_FE_theta_;  /* of projections, kg*m^2 */
    double tree_metric_HE_theta_;  /* of projections, kg*m^2 */
    double tree_metric_EG_theta_;  /* of projections, kg*m^2 */
    double inverse_tree_metric_AG_theta_;  /* 1/M, 1/(kg*m^2) */
    double inverse_tree_metric_AH_theta_;  /* 1/M, 1/(kg*m^2) */
    double inverse_tree_metric_HE_theta_;  /* 1/M, 1/(kg*m^2) */
    double inverse_tree_metric_EG_theta_;  /* 1/M, 1/(kg*m^2) */
};

/* Baumgarte's gains in Newton's matrix: 2 alpha and beta^2 of the constraints, 2 alpha of a sticking friction. */
static inline double baumgarte_two_alpha(const Parameters *p) { (void)p; return 0.0; }
static inline double baumgarte_beta_squared(const Parameters *p) { (void)p; return 0.0; }
static inline double stick_gain(const Parameters *p) { (void)p; return 0.0; }

#endif
