/* The integrated state in tree coordinates (relative coordinates of joints): coordinates, rates, works of forces. */
#include "../scalar_simd/scalar.h"

#define FUNCTION_LINKAGE
#define MOTION evaluate_rhs /* defined in motion.h; other scenes: motion/full.c, motion/driven.c */
#define REDUCED_DYNAMICS reduced_dynamics
#define CLOSURES(t, q, discrete, p, phi) closures(t, q, p, phi)
#define CLOSURE_RATES(t, q, v, discrete, p, phi_dot) closure_rates(t, q, v, p, phi_dot)
#include "../scalar_simd/motion.h"

/*
 * Evaluate the contacts of joints with play at state y into rhs->clearance, without solving for accelerations. Return 0
 * or a status.
 */
int evaluate_contacts(double t, const double *y, DiscreteState *discrete, const Parameters *p, RhsOutputs *rhs)
{
    return reduced_dynamics(t, y, y + N_X, discrete, p, NULL, rhs);
}

/*
 * Compute the state of all bodies, (q, v, works) in `absolute_state`, from the integrated state y in tree coordinates.
 */
void convert_integrated_to_absolute(double t, const double *y, const DiscreteState *discrete, const Parameters *p,
    double *absolute_state)
{
    (void)discrete;
    expand(t, y, y + N_X, p, absolute_state, absolute_state + N_Q);
    for (int k = 0; k < N_WORK; k++)
        absolute_state[2 * N_Q + k] = y[2 * N_X + k];
}

/*
 * Compute the integrated state y = (s, ds/dt, works) in tree coordinates s from the state of all bodies, (q, v, works)
 * in `absolute_state`. Works are copied; internal states of laws in y are left unchanged. discrete: not used here, but
 * by the version for scenes with driven loops (motion/driven.c).
 */
void convert_absolute_to_integrated(double t, const double *absolute_state, DiscreteState *discrete,
    const Parameters *p, double *y)
{
    (void)discrete;
    reduce_state(t, absolute_state, absolute_state + N_Q, p, y, y + N_X);
    for (int k = 0; k < N_WORK; k++)
        y[2 * N_X + k] = absolute_state[2 * N_Q + k];
}
