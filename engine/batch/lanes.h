/*
 * Types and arithmetic of SIMD vectors with one run per lane, by extensions of gcc and clang. Lane by lane the
 * operations are those of a single run in the same order, so that results are the same to the last bit. Functions that
 * only the library has are called for one lane after the other.
 */
#ifndef GUDGEON_LANES_H
#define GUDGEON_LANES_H
#if INTEGRATES
#include "../run/run.h"
#endif
#include <float.h>
#include <math.h>
#include <string.h>
#include <time.h>

/* Whether this library makes its steps by Taylor series; another one of the same scene has the other methods. */
#ifndef LANE_SERIES
#define LANE_SERIES 0
#endif

#if defined(__AVX512F__)
enum { LANES = 8 };
#elif defined(__AVX__)
enum { LANES = 4 };
#else
enum { LANES = 2 };
#endif
typedef double Lanes __attribute__((vector_size(8 * LANES)));
typedef long long LaneBits __attribute__((vector_size(8 * LANES)));

/* Return a vector with x in all lanes. */
static inline Lanes broadcast(double x) { return x - (Lanes){0.0}; }

/* Return a in the lanes of the mask, b in the others. */
static inline Lanes select_value(LaneBits mask, Lanes a, Lanes b)
{
    return (Lanes)(((LaneBits)a & mask) | ((LaneBits)b & ~mask));
}

/* Return the complement of a mask. */
static inline LaneBits invert_mask(LaneBits mask) { return ~mask; }

/* Return whether a mask contains any lane. */
static inline int any_of(LaneBits mask)
{
#if defined(__GNUC__) && !defined(__clang__) && defined(__AVX512DQ__)
    return __builtin_ia32_cvtq2mask512(mask) != 0;
#elif defined(__GNUC__) && !defined(__clang__) && defined(__AVX__) && !defined(__AVX512F__)
    return __builtin_ia32_movmskpd256((Lanes)mask) != 0;
#else
    long long some = 0;
    for (int k = 0; k < LANES; k++)
        some |= mask[k];
    return some != 0;
#endif
}

#include "lane_functions.h"

/* Frozen branches, and values of the switching functions, of all lanes. A kinematic analysis freezes no branches. */
#if INTEGRATES
#define frozen_branches(discrete) (discrete)->branch
#else
#define frozen_branches(discrete) ((void)(discrete), (const Lanes *)NULL)
#endif
#define reported_branches(rhs) (rhs)->g

/*
 * Return the active branch of switching function k in each lane: the frozen one, or the sign of `value` if `branch` is
 * NULL. g[k] is set to `value`.
 */
static inline Lanes lanes_branch_of(const Lanes *branch, Lanes *g, int k, Lanes value)
{
    g[k] = value;
    return branch ? branch[k] : lanes_sign_of(value);
}

/* Mark switching functions first to last - 1 as not in use, by NaN. */
static inline void mark_switches_unused(Lanes *g, int first, int last)
{
    for (int k = first; k < last; k++)
        g[k] = broadcast(NAN);
}

/*
 * Copy the values g[k] of switching functions first to last - 1 to film_switches[k], and mark them in g as not in use.
 * Called by the function of a joint with play before its dry contact writes to g; merge_switches() then selects.
 */
static inline void move_film_switches(Lanes *g, Lanes *film_switches, int first, int last)
{
    for (int k = first; k < last; k++)
        film_switches[k] = g[k];
    mark_switches_unused(g, first, last);
}

/*
 * Combine the switching functions first to last - 1 of a joint with film and contact, in g. Where the joint is free,
 * they are those of its film; where it touches, those of the contact. In the lanes of `is_mixed`, functions that the
 * contact does not use are those of the film.
 */
static inline void merge_switches(Lanes *g, const Lanes *film_switches, int first, int last,
    LaneBits is_touching_mask, LaneBits is_mixed)
{
    for (int k = first; k < last; k++) {
        const Lanes touching_switch = select_value(is_mixed & (g[k] != g[k]), film_switches[k], g[k]);
        g[k] = select_value(is_touching_mask, touching_switch, film_switches[k]);
    }
}

/* Types and operations that the text of scalar_simd/ uses for lanes. */
#define Real Lanes
#define Mask LaneBits
#define IntegratorOf LaneIntegrator
#define DiscreteStateOf LaneDiscreteState
#define RhsOutputsOf LaneRhsOutputs
#define ClearanceOf LaneClearance
#define ParametersOf LaneParameters
#define StepOf LaneStep
#define NormOf LaneNorm
#define ComplexLinearOf LaneComplexLinear
/* Return a constant in all lanes. */
static inline Lanes make_real(double x) { return broadcast(x); }
/* Return the larger number of each lane; a NaN in x is propagated. */
static inline Lanes real_max(Lanes x, Lanes y) { return lanes_max_of(x, y); }
/* Return the smaller number of each lane; a NaN in x is propagated. */
static inline Lanes real_min(Lanes x, Lanes y) { return lanes_min_of(x, y); }
/* Return |x| of each lane. */
static inline Lanes real_abs(Lanes x) { return lanes_fabs(x); }
/* Return the square root of each lane. */
static inline Lanes real_sqrt(Lanes x) { return lanes_sqrt(x); }
/* Return 2^x of each lane to 1e-4. */
static inline Lanes real_exp2(Lanes x) { return lanes_approx_exp2(x); }
/* Return log2 x of each lane to 1e-4. */
static inline Lanes real_log2(Lanes x) { return lanes_approx_log2(x); }
/* Compute sine and cosine of the angle (rad) of each lane; those of large angles are computed by the C library. */
static inline void compute_sine_and_cosine(Lanes angle, Lanes *sine, Lanes *cosine)
{
    LaneBits is_large = {0};
    compute_sines_and_cosines(angle, sine, cosine, &is_large);
    for (int k = 0; any_of(is_large) && k < LANES; k++) {
        (*sine)[k] = is_large[k] ? sin(angle[k]) : (*sine)[k];
        (*cosine)[k] = is_large[k] ? cos(angle[k]) : (*cosine)[k];
    }
}

/* ContactState of several runs. */
typedef struct {
    Lanes closed, deltadot_minus;
#if LAW_STATES
    Lanes state[LAW_STATES];
#endif
} LaneContactState;

/* DiscreteState of several runs. */
typedef struct {
    LaneContactState contact[AT_LEAST_ONE(N_CLEARANCES)];
    Lanes event_sign[AT_LEAST_ONE(N_USER_EVENTS)];
    Lanes branch[AT_LEAST_ONE(N_SWITCHES)];
    LaneBits needs_scalar; /* mask of the lanes whose step the scalar code of their runs must make */
    Lanes min_pivot, min_pivot_size;
} LaneDiscreteState;

/* PinForce of several runs. */
typedef struct {
    Lanes n, t, M_i, M_j, v_t;
#if LAW_STATES
    Lanes state_rate[LAW_STATES];
#endif
} LanePinForce;

/* Clearance of several runs. */
typedef struct {
    Lanes Fx, Fy, F_n, F_t, e, deltadot, delta, moment_first, moment_second, power;
    Lanes ex, ey, v_t;
#if LAW_STATES
    Lanes state_rate[LAW_STATES];
#endif
} LaneClearance;

/* RhsOutputs of several runs. */
typedef struct {
    Lanes lambda[N_LOOPS + 1], power[N_WORK], event[AT_LEAST_ONE(N_USER_EVENTS)];
    LaneClearance clearance[AT_LEAST_ONE(N_CLEARANCES)];
    Lanes g[AT_LEAST_ONE(N_SWITCHES)];
} LaneRhsOutputs;

/* Return the lanes whose contact is closed. */
static inline LaneBits is_closed(const LaneContactState *contact) { return contact->closed > 0.0; }

/* Return the mask of the lanes whose joint has a dry contact: its contact state is closed. `delta` is not used. */
static inline LaneBits is_touching(const LaneContactState *contact, Lanes delta)
{
    (void)delta;
    return is_closed(contact);
}

#if INTEGRATES
/*
 * Return the wall time since the epoch, s. It measures what steps of a batch in lanes and in scalar code cost, and
 * jumps if the clock is set.
 */
static double read_wall_time(void)
{
    struct timespec now;
    timespec_get(&now, TIME_UTC);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Linear of several runs: the linearized equations and Newton's matrix. */
typedef struct {
    const struct LaneParameters *p;
    Lanes value[AT_LEAST_ONE(N_VALUES)], lu[AT_LEAST_ONE(N_FACTORS)];
} LaneLinear;

#if IMPLICIT_STAGES
/* ComplexLinear of several runs. */
typedef struct {
    const struct LaneParameters *p;
    const Lanes *value;
    Lanes lu[2 * AT_LEAST_ONE(N_FACTORS)];
} LaneComplexLinear;
#endif

/* ErrorNorm of several runs. */
typedef struct {
    Lanes weight[N_Y], min_size[2], energy_scale, work_scale, speed[2], speed_floor[2], inverse_scale[2 * N_X + 1];
} LaneNorm;

/* Integrator of several runs: the data with which a trial step begins. */
typedef struct {
    Lanes t, y[N_Y], dy[N_Y];
    struct {
        Lanes h_rho;
    } choice;
    LaneNorm norm;
    struct {
        Lanes max_accepted_error;
        double fixed; /* length of fixed steps, s; 0: step-size control */
    } control;
    LaneDiscreteState discrete;
    LaneRhsOutputs rhs;
#if LANE_SERIES
    struct {
        int order; /* the same in all lanes: a batch has one tolerance; so have the next two */
        double strictness, defect_weight;
        Lanes max_step, growth, rounding_errors[N_Y], end_rounding_errors[N_Y];
        Lanes terms[TAYLOR_ORDERS + 1][TAYLOR_Y]; /* last member: it is large and filled by each trial */
    } series;
#else
    struct {
        Lanes lightest_mass;
    } films;
    struct {
        LaneLinear linear;
#if IMPLICIT_STAGES
        Lanes last_h, previous_y[N_Y], previous_dy[N_Y], convergence_rate, film_force_tol;
        Lanes evaluations; /* right-hand sides of the trial step */
        LaneBits can_extrapolate, has_no_stages;
#endif
    } newton;
#endif
} LaneIntegrator;

/*
 * Step of several runs, with masks of lanes: lanes that accept it, that leave it to their run,
 * that did not find its stages, and that have no dense output.
 */
typedef struct {
    Lanes t, h, error, y[N_Y], dy[N_Y], k[N_STAGES][N_Y];
    LaneRhsOutputs rhs;
    Lanes dense[N_DENSE][N_Y];
    int dense_ready, n_stored_stages;
    double node[N_STAGES];
    Lanes stage_values[N_STAGES][AT_LEAST_ONE(N_STAGE_VALUES)], min_event_value[AT_LEAST_ONE(N_EVENT_FUNCTIONS)],
        gap_rate_range[AT_LEAST_ONE(N_CLEARANCES)][2];
    Lanes residual[2]; /* largest |Phi| and |Phi_dot| of the closures at the end */
    Lanes film_error;  /* with Radau: error of film forces at the ends */
    Lanes min_state[2 * N_X + 1], max_state[2 * N_X + 1];
    LaneBits is_accepted, is_failed, has_no_stages, has_no_dense;
} LaneStep;
#endif

#endif
