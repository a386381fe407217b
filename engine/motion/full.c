/* The integrated state in absolute coordinates: right-hand side, conversions, accepted states. */

/*
 * Compute the rates dy of the integrated state y in absolute coordinates (q, v, works) and the outputs rhs. Return 0 or
 * a status. One of three definitions is compiled: this one without tree coordinates, motion/driven.c with driven loops,
 * scalar_simd/motion.h (MOTION) for other trees.
 */
int evaluate_rhs(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dy, RhsOutputs *rhs)
{
    return compute_absolute_rates(t, y, discrete, p, dy, rhs);
}

/*
 * Evaluate the contacts of joints with play at state y into rhs->clearance, by the whole right-hand side. Return 0 or a
 * status.
 */
int evaluate_contacts(double t, const double *y, DiscreteState *discrete, const Parameters *p, RhsOutputs *rhs)
{
    double dy[N_Y];
    return compute_absolute_rates(t, y, discrete, p, dy, rhs);
}

/* Copy the integrated state y to the state of all bodies, (q, v, works) in `absolute_state`: both are the same. */
void convert_integrated_to_absolute(double t, const double *y, const DiscreteState *discrete, const Parameters *p,
    double *absolute_state)
{
    (void)t, (void)discrete, (void)p;
    for (int k = 0; k < N_S; k++)
        absolute_state[k] = y[k];
}

/* Copy the state of all bodies, (q, v, works) in `absolute_state`, to the integrated state y: both are the same. */
void convert_absolute_to_integrated(double t, const double *absolute_state, DiscreteState *discrete,
    const Parameters *p, double *y)
{
    (void)t, (void)discrete, (void)p;
    for (int k = 0; k < N_S; k++)
        y[k] = absolute_state[k];
}

/*
 * Accept a state: update the maxima of the constraint violations |Phi| and |Phi_dot| by those in its outputs rhs.
 * Return 0. Called at the start and after each accepted step.
 */
int accept_state(double t, const double *y, DiscreteState *discrete, const Parameters *p, const RhsOutputs *rhs,
    double *phi_max, double *phi_dot_max)
{
    (void)t, (void)y, (void)discrete, (void)p;
    for (int r = 0; r < N_ROWS; r++) {
        *phi_max = max_of(fabs(rhs->phi[r]), *phi_max);
        *phi_dot_max = max_of(fabs(rhs->phi_dot[r]), *phi_dot_max);
    }
    return 0;
}
