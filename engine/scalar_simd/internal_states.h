/*
 * Copy internal states of contact laws, such as deflections of bristles, between the integrated state and contacts.
 */

/*
 * Copy the internal states of contact laws from state y to the contact states, where the laws read them. Does nothing
 * without such states.
 */
static inline void copy_internal_states(DiscreteStateOf *discrete, const Real *y)
{
#if LAW_STATES
    for (int k = 0; k < N_STATES; k++)
        discrete->contact[k / LAW_STATES].state[k % LAW_STATES] = y[FIRST_STATE + k];
#else
    (void)discrete, (void)y;
#endif
}

/*
 * Copy the rates of the internal states of contact laws from the contacts in `rhs` to dy. Does nothing without such
 * states.
 */
static inline void copy_internal_state_rates(const RhsOutputsOf *rhs, Real *dy)
{
#if LAW_STATES
    for (int k = 0; k < N_STATES; k++)
        dy[FIRST_STATE + k] = rhs->clearance[k / LAW_STATES].state_rate[k % LAW_STATES];
#else
    (void)rhs, (void)dy;
#endif
}
