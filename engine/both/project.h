/*
 * Project a state onto Phi = 0 and Phi_dot = 0 by the smallest changes of q and v in the norm of M, in up to three
 * passes; velocities use the corrected positions. A vanishing pivot (links in line) leaves the state unchanged.
 */
static void project_rows(IntegratorOf *run, Real t, Real *y, const ParametersOf *p)
{
    Mask open = is_not((Mask){0});
    for (int pass = 0; pass < 3 && N_LOOPS > 0; pass++) {
        Real dq[N_X], dv[N_X], worst;
        open = has_closing_step(run, open, t, y, p, dq, dv, &worst);
        if (!any_of(open))
            return;
        for (int k = 0; k < N_X; k++) {
            y[k] = pick(open, y[k] - dq[k], y[k]);
            y[N_X + k] = pick(open, y[N_X + k] - dv[k], y[N_X + k]);
        }
        open &= is_not(worst < 1e-15);
        if (!any_of(open))
            return;
    }
}
