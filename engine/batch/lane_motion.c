/* Right-hand side, corrections of loop closures, and projection onto the constraints, in SIMD lanes. */

/*
 * Set the limits of small pivots in all lanes, as for a single run with detection of singular positions. Lanes with
 * smaller pivots are added to discrete->needs_scalar: their scalar runs make the step.
 */
static inline void set_pivot_limits(LaneDiscreteState *discrete)
{
    discrete->min_pivot = broadcast(HAS_CONTINUATION ? NEAR_SINGULAR_PIVOT : NEARLY_SINGULAR);
    discrete->min_pivot_size = broadcast(HAS_CONTINUATION ? NEAR_SINGULAR_PIVOT : VANISHING);
}

/*
 * Compute the accelerations a and outputs rhs of all lanes by the reduced equations of motion. Always return 0: lanes
 * with a vanishing pivot are added to the mask discrete->needs_scalar.
 */
static inline int compute_lane_accelerations(Lanes t, const Lanes *q, const Lanes *v, LaneDiscreteState *discrete,
    const LaneParameters *p, Lanes *a, LaneRhsOutputs *rhs)
{
    set_pivot_limits(discrete);
    reduced_dynamics(t, q, v, discrete, p, a, rhs, &discrete->needs_scalar);
    return 0;
}

#define FUNCTION_LINKAGE static inline
#define MOTION evaluate_lane_rhs
#define REDUCED_DYNAMICS compute_lane_accelerations
#define CLOSURES(t, q, discrete, p, phi) closures(t, q, p, phi, &(discrete)->needs_scalar)
#define CLOSURE_RATES(t, q, v, discrete, p, phi_dot) closure_rates(t, q, v, p, phi_dot, &(discrete)->needs_scalar)
#include "../scalar_simd/motion.h"

/* Return the mask of the lanes in which the sum of n components of a (plus those of b, unless NULL) is not finite. */
static LaneBits find_nonfinite_lanes(const Lanes *a, const Lanes *b, int n)
{
    Lanes sum = broadcast(0.0);
    for (int k = 0; k < n; k++)
        sum += b ? a[k] + b[k] : a[k];
    return ~(lanes_fabs(sum) <= DBL_MAX);
}

#include "../scalar_simd/internal_states.h"

/*
 * Compute the rates dy of the integrated state y at times t (s) and the outputs rhs, in all lanes. Internal states of
 * contact laws are copied from y, their rates to dy. Always return 0: lanes in which the evaluation fails are added to
 * the mask run->discrete.needs_scalar.
 */
static int evaluate_run_rhs(
    LaneIntegrator *run, Lanes t, const Lanes *y, const LaneParameters *p, Lanes *dy, LaneRhsOutputs *rhs)
{
    copy_internal_states(&run->discrete, y);
    evaluate_lane_rhs(t, y, &run->discrete, p, dy, rhs);
    copy_internal_state_rates(rhs, dy);
    return 0;
}

/*
 * Compute the corrections dq, dv that close the constraints of all lanes, and their largest residuals. Return
 * `is_active`: which lanes are to be corrected. Active lanes without a finite correction are added to
 * discrete.needs_scalar.
 */
static LaneBits compute_closure_correction(LaneIntegrator *run, LaneBits is_active, Lanes t, const Lanes *y,
    const LaneParameters *p, Lanes *dq, Lanes *dv, Lanes *residual)
{
    set_pivot_limits(&run->discrete);
    compute_closure_step(t, y, y + N_X, &run->discrete, p, dq, dv, residual, &run->discrete.needs_scalar);
    run->discrete.needs_scalar |= is_active
        & (find_nonfinite_lanes(dq, NULL, N_X) | find_nonfinite_lanes(dv, NULL, N_X));
    return is_active;
}

#include "../scalar_simd/project.h"
