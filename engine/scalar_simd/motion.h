/* The right-hand side in tree coordinates, and the constraint residuals of accepted states. */

/*
 * Compute the rates dy of the integrated state y: tree coordinates, their rates, works. Return 0 or a status. rhs:
 * outputs of the right-hand side in addition. Defined as evaluate_rhs() for one run, as evaluate_lane_rhs() for lanes.
 */
FUNCTION_LINKAGE int MOTION(Real t, const Real *y, DiscreteStateOf *discrete, const ParametersOf *p, Real *dy,
    RhsOutputsOf *rhs)
{
    const int status = REDUCED_DYNAMICS(t, y, y + N_X, discrete, p, dy + N_X, rhs);
#ifdef N_UNUSED_SWITCHES
    for (int i = 0; i < N_UNUSED_SWITCHES; i++)
        rhs->g[unused_switch[i]] = make_real(NAN); /* these switching functions are not in use */
#endif
    for (int k = 0; k < N_X; k++)
        dy[k] = y[N_X + k];
    for (int k = 0; k < N_WORK; k++)
        dy[2 * N_X + k] = rhs->power[k];
    return status;
}

/*
 * Update the maxima of |Phi| and |Phi_dot| of the closures, *phi_max and *phi_dot_max, by an accepted state. Return 0.
 */
FUNCTION_LINKAGE int accept_state(Real t, const Real *y, DiscreteStateOf *discrete, const ParametersOf *p,
    const RhsOutputsOf *rhs, Real *phi_max, Real *phi_dot_max)
{
    Real phi[N_LOOPS + 1], phi_dot[N_LOOPS + 1];
    (void)discrete, (void)rhs;
    CLOSURES(t, y, discrete, p, phi);
    CLOSURE_RATES(t, y, y + N_X, discrete, p, phi_dot);
    for (int r = 0; r < N_LOOPS; r++) {
        *phi_max = real_max(real_abs(phi[r]), *phi_max);
        *phi_dot_max = real_max(real_abs(phi_dot[r]), *phi_dot_max);
    }
    return 0;
}
