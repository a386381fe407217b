/*
 * Inner states of contact laws in the integrated state: internal state variables of a law, such as deflections of
 * bristles.
 */

/*
 * Copy the inner states of contact laws from state y to the contact states, where the laws read them; nothing without
 * such states.
 */
static inline void copy_inner_states(DiscreteStateOf *discrete, const Real *y)
{
#if LAW_STATES
    for (int k = 0; k < N_STATES; k++)
        discrete->contact[k / LAW_STATES].state[k % LAW_STATES] = y[FIRST_STATE + k];
#else
    (void)discrete, (void)y;
#endif
}

/* Copy the rates of the inner states of contact laws from the contacts in `rhs` to dy; nothing without such states. */
static inline void copy_inner_rates(const RhsOutputsOf *rhs, Real *dy)
{
#if LAW_STATES
    for (int k = 0; k < N_STATES; k++)
        dy[FIRST_STATE + k] = rhs->clearance[k / LAW_STATES].state_rate[k % LAW_STATES];
#else
    (void)rhs, (void)dy;
#endif
}
