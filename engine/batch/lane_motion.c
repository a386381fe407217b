/* Set the limits of pivots in all lanes; near a singular position the single runs make the step. */
static inline void singular_thresholds(LaneDiscreteState *discrete)
{
    discrete->least = all_of(CONTINUES ? NEARBY : NEARLY_SINGULAR);
    discrete->least_size = all_of(CONTINUES ? NEARBY : VANISHING);
}

/* Compute the accelerations of all lanes; lanes with a vanishing pivot are marked as rare. */
static inline int lane_dynamics(Lanes t, const Lanes *q, const Lanes *v, LaneDiscreteState *discrete,
    const LaneParameters *p, Lanes *a, LaneRhsOutputs *rhs)
{
    singular_thresholds(discrete);
    reduced_dynamics(t, q, v, discrete, p, a, rhs, &discrete->rare);
    return 0;
}

#define IN_BOTH static inline
#define MOTION motion
#define REDUCED_DYNAMICS lane_dynamics
#define CLOSURES(t, q, discrete, p, phi) closures(t, q, p, phi, &(discrete)->rare)
#define CLOSURE_RATES(t, q, v, discrete, p, phi_dot) closure_rates(t, q, v, p, phi_dot, &(discrete)->rare)
#include "../both/motion.h"

/* Return the lanes in which a sum of n components of a (and b, if not NULL) is not finite. */
static LaneBits not_finite(const Lanes *a, const Lanes *b, int n)
{
    Lanes sum = all_of(0.0);
    for (int k = 0; k < n; k++)
        sum += b ? a[k] + b[k] : a[k];
    return ~(lanes_fabs(sum) <= DBL_MAX);
}

#include "../both/states.h"

/* Compute the rates dy of all lanes. */
static int rates(LaneIntegrator *run, Lanes t, const Lanes *y, const LaneParameters *p, Lanes *dy, LaneRhsOutputs *rhs)
{
    copy_inner_states(&run->discrete, y);
    motion(t, y, &run->discrete, p, dy, rhs);
    copy_inner_rates(rhs, dy);
    return 0;
}

/* Compute the steps dq, dv to the closures; lanes without one are marked as rare. Returns `open`. */
static LaneBits has_closing_step(LaneIntegrator *run, LaneBits open, Lanes t, const Lanes *y, const LaneParameters *p,
    Lanes *dq, Lanes *dv, Lanes *worst)
{
    singular_thresholds(&run->discrete);
    closing_step(t, y, y + N_X, &run->discrete, p, dq, dv, worst, &run->discrete.rare);
    run->discrete.rare |= open & (not_finite(dq, NULL, N_X) | not_finite(dv, NULL, N_X));
    return open;
}

#include "../both/project.h"
