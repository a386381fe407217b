/*
 * The data of a kinematic analysis of one run, and the functions of single runs that SIMD code for several runs
 * calls. KinematicBatch is declared in scene/calls.h, because Python fills it.
 */
#ifndef GUDGEON_KINEMATIC_H
#define GUDGEON_KINEMATIC_H
#include "../scene/calls.h"
#include "../run/cancellation.h"

enum { N_HIGHER = 3 }; /* terms of the third to fifth order */
/*
 * Newton iterations; halvings of a step; halvings of a step at velocity jumps, for its works; halvings of a step up to
 * which it is tested for transients.
 */
enum { MAX_NEWTON = 12, MAX_HALVINGS = 40, MAX_SPLITS = 400, MAX_HALVINGS_FOR_TRANSIENT = 30 };
#define MAX_SECOND_RATE_DISPLACEMENT 0.05 /* rad, or fraction of the size: largest effect of second rates on a guess */
#define MAX_HIGHER_ORDER_DISPLACEMENT 1e-3      /* the same: largest effect of terms of higher order */
#define MIN_PASS_CORRECTION 1e3   /* in DBL_EPSILON of the largest angle: larger last corrections are ill-conditioned */
#define MAX_STEP_ERROR 0.002      /* of the largest correction: largest difference from the trapezoidal rule */
#define STEP_DOUBLING_ERROR 0.1   /* of the error limit: below it, a halved step is doubled again */
#define NEWTON_ROUNDING 4e-15     /* rad, or fraction of the size: corrections that are rounding */
#define NEWTON_CLOSED 1e-9        /* the same: largest correction before the last one */
#define NEWTON_NEARLY_CLOSED 1e-8 /* the same: after such a correction, the next one is probably rounding */
#define MIN_VELOCITY_JUMP 1e-12   /* rad/s: smallest jump of velocities within a step */
#define VELOCITY_ROUNDING 1e-9    /* of the speed: smaller changes are not jumps */
#define MIN_JUMP_RATIO 1e-6       /* of the integral of the accelerations: the same */

/* Nodes and weights of the Gauss-Legendre quadrature of works, on [-1, 1]. */
enum { N_WORK_NODES = 3 };
static const double work_node[] = {-0.7745966692414834, 0.0, 0.7745966692414834};
static const double work_weight[] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};

/* The motion of all bodies at a time t, s; phi and phi_dot: the largest |Phi| and |Phi_dot| there. */
typedef struct {
    double t, q[N_Q], v[N_Q], a[N_Q], phi, phi_dot;
    double last_correction; /* last correction of Newton's method, rad or fraction of the mechanism's size */
    int is_interpolated;       /* at or near a change point (change_point.c) */
#if POSITIONS_IN_TREE
    double s[N_X + 1], s_rate[N_X + 1], s_second[N_X + 1]; /* the same in tree coordinates */
    double interval, s_higher[N_X + 1][N_HIGHER]; /* s since the position before, 0: none; terms (extrapolation.h) */
#endif
} Position;

/* The current length of steps, s, and how often it was halved. */
typedef struct {
    double h;
    int halvings;
} StepLength;

/*
 * The samples of run `index` of a batch: n times (s), states (q, v, works), accelerations, and the largest |a| of each
 * sample with the extremes of these; `done` samples are stored. Steps lead from sample to sample.
 */
typedef struct {
    const KinematicBatch *batch;
    long index, n, done, steps;
    const double *t;
    double *y, *a, *largest, largest_a, smallest_a;
    int are_finite;
    StepLength step_length;
    double phi_max, phi_dot_max, began; /* largest residuals; time of the clock, s */
} RunSamples;

/*
 * A kinematic analysis over several calls: parameters; the largest correction of a first guess (`max_correction`, rad
 * or fraction of the size); the mechanism's size (`extent`, m); its end, cancellation, progress; the positions of
 * motion and works.
 */
typedef struct {
    const Parameters *p;
    double max_correction, extent, t_end;
    Cancellation cancellation;
    ProgressMonitor monitor;
    Position motion, work;
    int has_motion_begun, has_work_begun;
    long n_interpolated;   /* samples that were interpolated at or near a change point */
    double t_interpolated; /* the first of them, s */
    int is_start_ill_conditioned; /* constraint equations depend on each other at the start, or nearly */
    double *step_record; /* rows of t, q, v at the ends of steps, fetched by Python; NULL: not recorded */
    long n_recorded, capacity;
    RunSamples samples; /* of a run of a batch */
} KinematicRun;

/* Functions of a single run of a batch, for the loop of several runs in lanes. */
typedef struct {
    int (*begin)(const KinematicBatch *batch, long i, KinematicRun *run); /* start and first sample; returns a status */
    int (*advance)(KinematicRun *run);       /* one step; returns a status */
    void (*end)(const KinematicBatch *batch, long i, KinematicRun *run, int status);
    int (*detect_stall)(ProgressMonitor *monitor, double t, double t_end);
    long (*count_steps_before_check)(const ProgressMonitor *monitor);
    int (*has_transient)(double t0, double t1, const Parameters *p); /* whether the step t0 to t1 hides a transient */
} KinematicRunFunctions;

#endif
