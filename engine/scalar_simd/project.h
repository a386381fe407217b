/* Projection of a state onto the constraint equations. */

#include "compensated_sum.h"

/*
 * Subtract a correction from a component *y of the state where the mask is true. *rounding_error: accumulated rounding
 * error of *y, to which the new one is added; NULL: none is accumulated.
 */
static inline void subtract_correction(Mask is_active, Real correction, Real *y, Real *rounding_error)
{
    Real after = *y;
    const Real error = add_compensated(&after, -correction);
    *y = select_value(is_active, after, *y);
    if (rounding_error)
        *rounding_error = select_value(is_active, *rounding_error + error, *rounding_error);
}

/*
 * Project state y in place onto Phi = 0 and Phi_dot = 0, by the smallest changes of q and v in the norm of M. Up to
 * three Newton passes are made, until the residual is below 1e-15; velocities use the corrected positions. If the
 * corrections cannot be computed, as with links in line, the state is left as it is. rounding_errors (N_Y): accumulated
 * ones of y; NULL: none are accumulated.
 */
static void project_onto_constraints(IntegratorOf *run, Real t, Real *y, Real *rounding_errors, const ParametersOf *p)
{
    Mask is_active = invert_mask((Mask){0});
    for (int pass = 0; pass < 3 && N_LOOPS > 0; pass++) {
        Real dq[N_X], dv[N_X], residual;
        is_active = compute_closure_correction(run, is_active, t, y, p, dq, dv, &residual);
        if (!any_of(is_active))
            return;
        for (int k = 0; k < N_X; k++) {
            subtract_correction(is_active, dq[k], &y[k], rounding_errors ? &rounding_errors[k] : NULL);
            subtract_correction(is_active, dv[k], &y[N_X + k], rounding_errors ? &rounding_errors[N_X + k] : NULL);
        }
        is_active &= invert_mask(residual < 1e-15);
        if (!any_of(is_active))
            return;
    }
}
