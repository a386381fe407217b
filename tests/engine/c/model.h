/*
 * Sizes and tables of no scene: one coordinate x without constraints, one joint with play whose surfaces give, one
 * switch. What the engine's parts are tested with; their closed forms stand in the tests.
 */
#ifndef GUDGEON_MODEL_H
#define GUDGEON_MODEL_H

#define N_Q 3
#define N_ROWS 0
#define N_ALL_ROWS 0
#define N_JOINTS 0
#define N_DRIVES 0
#define N_CLEARANCES 1
#define LAW_STATES 0
#define N_FRICTIONS 0
#define N_SWITCHES 1
#define N_USER_EVENTS 0
#define N_SERIES 0
#define INTEGRATES 1
#define TREE 1
#define POSITIONS_IN_TREE 0
#define N_X 1
#define N_LOOPS 0
#define N_DEPENDENT 0
#define N_DEPENDENT_VALUES 0
#define SMOOTH_DRIVEN_LOOPS 0
#define TREE_PIVOTS 0
#define HAS_ABSOLUTE_FALLBACK 0
#define LARGEST_BLOCK 0
#define N_VALUES 0
#define N_FACTORS 0
#define IMPLICIT_STAGES 0
#define HAS_LANES 0
#define DRIVE_IMPULSES 0
#define RATE_JUMPS 0
#define N_MONITORED 0
#define KNOWN_BOUNDS 0
#define MONITORS_STATE 0
#define N_TERMS 0
#define N_TRANSIENTS 0
#define N_GUESS 0
#define GUESSED_POINTS 0
#define N_SET 0
#define N_RATES 0
#define SINGULAR 1e-13
#define NEARLY_SINGULAR 1e-08
#define VANISHING 1e-10
#define EARLY 1e-05
#define LIGHT_PIVOT 0.001
#define SINGULAR_SQUARE 3.162277660168379e-07

typedef struct Parameters {
    double radius, offset; /* m: radial clearance; what is subtracted from x in the penetration */
} Parameters;

#include "engine/scene/types.h"
#include "engine/scene/numbers.h"

static const signed char event_direction[] = {0};
static const unsigned char event_stops[] = {0};
static const int guess_coordinate[] = {0};
static const int set_coordinate[] = {0};
static const int rate_coordinate[] = {0};
static const int drive_row[] = {0};
static const unsigned char row_is_length[] = {0};
static const int motion_row[] = {0};
static const int phi_q_first[] = {0};
static const short phi_q_column[] = {0};
static const unsigned char is_angle[] = {0};
static const unsigned char film_joint[] = {0};
static const short monitored_event[] = {0};
static const short monitored_index[] = {-1, -1};
static const unsigned char is_continuous_switch[] = {0};
static const int friction_of_pivot[] = {0};

static inline double baumgarte_two_alpha(const Parameters *p) { (void)p; return 0.0; }
static inline double baumgarte_beta_squared(const Parameters *p) { (void)p; return 0.0; }
static inline double stick_gain(const Parameters *p) { (void)p; return 0.0; }

#endif
