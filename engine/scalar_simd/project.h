/* Projection of a state onto the constraint equations. */

/*
 * Project state y in place onto Phi = 0 and Phi_dot = 0, by the smallest changes of q and v in the norm of M. Up to
 * three passes are made, until the residual is below 1e-15; velocities use the corrected positions. If the corrections
 * cannot be computed, as with links in line, the state is left as it is.
 */
static void project_onto_constraints(IntegratorOf *run, Real t, Real *y, const ParametersOf *p)
{
    Mask is_active = invert_mask((Mask){0});
    for (int pass = 0; pass < 3 && N_LOOPS > 0; pass++) {
        Real dq[N_X], dv[N_X], residual;
        is_active = find_closure_correction(run, is_active, t, y, p, dq, dv, &residual);
        if (!any_of(is_active))
            return;
        for (int k = 0; k < N_X; k++) {
            y[k] = select_value(is_active, y[k] - dq[k], y[k]);
            y[N_X + k] = select_value(is_active, y[N_X + k] - dv[k], y[N_X + k]);
        }
        is_active &= invert_mask(residual < 1e-15);
        if (!any_of(is_active))
            return;
    }
}
