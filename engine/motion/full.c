/* Compute the rates of the state in absolute coordinates. Returns a status. */
int motion_here(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dy, RhsOutputs *rhs)
{
    return state_equation(t, y, discrete, p, dy, rhs);
}

/* Evaluate the contacts of joints with play at a state. Returns a status. */
int evaluate_contacts(double t, const double *y, DiscreteState *discrete, const Parameters *p, RhsOutputs *rhs)
{
    double dy[N_Y];
    return state_equation(t, y, discrete, p, dy, rhs);
}

/* Copy the integrated state to the state of all bodies, (q, v, works). */
void to_absolute(double t, const double *y, const DiscreteState *discrete, const Parameters *p, double *all)
{
    (void)t, (void)discrete, (void)p;
    for (int k = 0; k < N_S; k++)
        all[k] = y[k];
}

/* Copy the state of all bodies, (q, v, works), to the integrated state. */
void from_absolute(double t, const double *all, DiscreteState *discrete, const Parameters *p, double *y)
{
    (void)t, (void)discrete, (void)p;
    for (int k = 0; k < N_S; k++)
        y[k] = all[k];
}

/* Accept a state: update the maxima of |Phi| and |Phi_dot|. Returns a status. */
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
