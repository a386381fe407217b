/* Exact Jacobian of the state equation, from the linearized equations of motion. */

/*
 * Compute x (N_LINEAR_UNKNOWNS) = -column of the derivative of the residuals of the equations of motion by the
 * integrated state (columns 0 ... N_Y - 1) or by t (N_Y). baumgarte_gains: beta^2 and 2 alpha; stick_gain: the same
 * gain for sticking friction. Return 0 if all entries are zero, as for the works, else 1.
 */
static int compute_residual_column(const Linear *linearization, int column, const double *baumgarte_gains,
    double stick_gain,
    double *x)
{
    int is_nonzero = 0;
    for (int i = 0; i < N_LINEAR_UNKNOWNS; i++)
        x[i] = 0.0;
    for (int i = 0; i < N_RESIDUAL && column < N_Y; i++) {
        const LinearEntry *entry = &residual_entries[i];
        if (entry->column == column) {
            x[entry->row] -= entry->sign * linearization->value[entry->value];
            is_nonzero = 1;
        }
    }
    /* Baumgarte: beta^2 Phi_q, 2 alpha Phi_q; a stick has no beta */
    for (int i = 0; i < N_PHI_Q && column < 2 * N_X; i++) {
        const LinearEntry *entry = &phi_q_entries[i];
        if (entry->column == column % N_X && (column >= N_X || entry->row < N_X + N_LOOPS)) {
            x[entry->row] -= (entry->row < N_X + N_LOOPS ? baumgarte_gains[column / N_X] : stick_gain) * entry->sign
                * linearization->value[entry->value];
            is_nonzero = 1;
        }
    }
    for (int i = 0; i < N_RESIDUAL_T && column == N_Y; i++) {
        x[residual_t_entries[i].row] -= residual_t_entries[i].sign * linearization->value[residual_t_entries[i].value];
        is_nonzero = 1;
    }
    return is_nonzero;
}

/*
 * Compute a column of the Jacobian of the state equation (N_Y entries) from x (N_LINEAR_UNKNOWNS), the change of
 * accelerations, multipliers and rates of internal states. column: 0 ... N_Y - 1, or N_Y for the derivative by t.
 * stride: distance of successive values in column_values.
 */
static void compute_jacobian_column(const Linear *linearization, int column, const double *x,
    double *column_values, long stride)
{
    for (int k = 0; k < N_X; k++) {
        column_values[k * stride] = column == N_X + k ? 1.0 : 0.0;
        column_values[(N_X + k) * stride] = x[k];
    }
    for (int work = 0; work < N_WORK; work++)
        column_values[(2 * N_X + work) * stride] = 0.0;
    for (int k = 0; k < N_STATES; k++)
        column_values[(FIRST_STATE + k) * stride] = x[N_LINEAR_UNKNOWNS - N_STATES + k];
    for (int i = 0; i < N_POWER_ROW; i++) {
        const LinearEntry *entry = &power_row_entries[i];
        column_values[(2 * N_X + entry->row) * stride] += entry->sign * linearization->value[entry->value]
            * x[entry->column];
    }
    for (int i = 0; i < N_POWER; i++) {
        const LinearEntry *entry = &power_entries[i];
        if (entry->column == column)
            column_values[(2 * N_X + entry->row) * stride] += entry->sign * linearization->value[entry->value];
    }
    for (int i = 0; i < N_POWER_T && column == N_Y; i++) {
        const LinearEntry *entry = &power_t_entries[i];
        column_values[(2 * N_X + entry->row) * stride] += entry->sign * linearization->value[entry->value];
    }
}

/*
 * Linearize the equations of motion at a state and factorize Newton's matrix, with which (1/eta - J) u = r is solved
 * for accelerations and multipliers. eta: h gamma of the method, s; with 0 it is the KKT matrix, for the Jacobian J
 * alone. discrete: discrete state as in a sample. Return 0, the number of a vanished pivot of dynamics(), or minus the
 * number (from 1) of the coordinate, constraint equation, stick or internal state whose pivot vanished in
 * newton_factor().
 */
static int linearize_and_factorize_equations(double t, const double *y, const double *discrete, const Parameters *p,
    double eta, Linear *linearization)
{
    DiscreteState discrete_state = {0};
    RhsOutputs rhs;
    double dy[N_Y];
    read_discrete_state(discrete, &discrete_state);
#if N_DEPENDENT
    solve_driven_loops(t, y + FIRST_STATE, &discrete_state, p); /* the guess follows the works */
#endif
    int status = compute_motion_rates(t, y, &discrete_state, p, dy, &rhs);
    if (!status)
        status = linearize_state(t, y, &discrete_state, p, dy + N_X, &rhs, linearization);
    return status ? status : -newton_factor(eta, linearization);
}

/*
 * Compute the Jacobian J = df/dy, by rows (N_Y x N_Y), and f_t of the state equation: a linear solve per column, with
 * the factors of the KKT matrix. Contacts, branches and modes of friction are frozen. Internal states are read from
 * `discrete` only. Return 0, or the nonzero result of linearize_and_factorize_equations().
 */
int gudgeon_jacobian(double t, const double *y, const double *discrete, const double *p, double *J, double *f_t)
{
    Linear linearization;
    const double gain[2] = {baumgarte_beta_squared((const Parameters *)p), baumgarte_two_alpha((const Parameters *)p)};
    const int status = linearize_and_factorize_equations(t, y, discrete, (const Parameters *)p, 0.0, &linearization);
    if (status)
        return status;
    for (int column = 0; column <= N_Y; column++) {
        double x[N_LINEAR_UNKNOWNS];
        if (compute_residual_column(&linearization, column, gain, stick_gain((const Parameters *)p), x))
            newton_substitute(&linearization, x);
        compute_jacobian_column(&linearization, column, x, column < N_Y ? J + column : f_t, column < N_Y ? N_Y : 1);
    }
    return 0;
}

/*
 * Solve (1/eta - J) u = r + s f_t for u (N_Y) at a state, as a test of Newton's matrix. discrete: as in a sample.
 * Return 0, or the nonzero result of linearize_and_factorize_equations().
 */
int gudgeon_newton(double t, const double *y, const double *discrete, const double *p, double eta, double s,
    const double *r, double *u)
{
    Linear linearization;
    const int status = linearize_and_factorize_equations(t, y, discrete, (const Parameters *)p, eta, &linearization);
    if (status)
        return status;
    newton_solve(&linearization, eta, s, r, u);
    return 0;
}
