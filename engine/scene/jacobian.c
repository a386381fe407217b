/* Exact Jacobian of the state equation, from the linearized equations of motion. */

/*
 * Compute x = -column of the derivative of the residuals by the integrated state (columns 0 ... N_Y - 1) or by t (N_Y).
 * Returns 0 if all entries are zero, as for the works.
 */
static int residual_column(const Linear *lin, int column, const double *gain, double stick, double *x)
{
    int found = 0;
    for (int i = 0; i < N_NODES; i++)
        x[i] = 0.0;
    for (int i = 0; i < N_RESIDUAL && column < N_Y; i++) {
        const LinearEntry *at = &residual_entries[i];
        if (at->column == column) {
            x[at->row] -= at->sign * lin->value[at->value];
            found = 1;
        }
    }
    /* Baumgarte: beta^2 Phi_q, 2 alpha Phi_q; a stick has no beta */
    for (int i = 0; i < N_PHI_Q && column < 2 * N_X; i++) {
        const LinearEntry *at = &phi_q_entries[i];
        if (at->column == column % N_X && (column >= N_X || at->row < N_X + N_LOOPS)) {
            x[at->row] -= (at->row < N_X + N_LOOPS ? gain[column / N_X] : stick) * at->sign * lin->value[at->value];
            found = 1;
        }
    }
    for (int i = 0; i < N_RESIDUAL_T && column == N_Y; i++) {
        x[residual_t_entries[i].row] -= residual_t_entries[i].sign * lin->value[residual_t_entries[i].value];
        found = 1;
    }
    return found;
}

/*
 * Compute a column of the Jacobian from x, the change of accelerations, multipliers and rates of inner states. stride:
 * distance of entries in `out`.
 */
static void jacobian_column(const Linear *lin, int column, const double *x, double *out, long stride)
{
    for (int k = 0; k < N_X; k++) {
        out[k * stride] = column == N_X + k ? 1.0 : 0.0;
        out[(N_X + k) * stride] = x[k];
    }
    for (int w = 0; w < N_WORK; w++)
        out[(2 * N_X + w) * stride] = 0.0;
    for (int k = 0; k < N_STATES; k++)
        out[(FIRST_STATE + k) * stride] = x[N_NODES - N_STATES + k];
    for (int i = 0; i < N_POWER_ROW; i++) {
        const LinearEntry *at = &power_row_entries[i];
        out[(2 * N_X + at->row) * stride] += at->sign * lin->value[at->value] * x[at->column];
    }
    for (int i = 0; i < N_POWER; i++) {
        const LinearEntry *at = &power_entries[i];
        if (at->column == column)
            out[(2 * N_X + at->row) * stride] += at->sign * lin->value[at->value];
    }
    for (int i = 0; i < N_POWER_T && column == N_Y; i++) {
        const LinearEntry *at = &power_t_entries[i];
        out[(2 * N_X + at->row) * stride] += at->sign * lin->value[at->value];
    }
}

/*
 * Linearize a state and factorize Newton's matrix. Returns 0, the number of a pivot of dynamics(), or -1 - the node of
 * newton_factor().
 */
static int linearized(double t, const double *y, const double *discrete, const Parameters *p, double eta, Linear *lin)
{
    DiscreteState now = {0};
    RhsOutputs rhs;
    double dy[N_Y];
    read_discrete_state(discrete, &now);
#if N_CHAIN
    solve_driven_loops(t, y + FIRST_STATE, &now, p); /* the guess follows the works */
#endif
    int status = motion(t, y, &now, p, dy, &rhs);
    if (!status)
        status = linearize_state(t, y, &now, p, dy + N_X, &rhs, lin);
    return status ? status : -newton_factor(eta, lin);
}

/*
 * Compute J = df/dy, row by row (N_Y x N_Y), and f_t of the state equation: a linear solve per column, with the factors
 * of the KKT matrix. Contacts, branches and modes of friction are frozen. Inner states are read from `discrete` only.
 * Returns a status.
 */
int gudgeon_jacobian(double t, const double *y, const double *discrete, const double *p, double *J, double *f_t)
{
    Linear lin;
    const double gain[2] = {baumgarte_beta_squared((const Parameters *)p), baumgarte_two_alpha((const Parameters *)p)};
    const int status = linearized(t, y, discrete, (const Parameters *)p, 0.0, &lin);
    if (status)
        return status;
    for (int column = 0; column <= N_Y; column++) {
        double x[N_NODES];
        if (residual_column(&lin, column, gain, stick_gain((const Parameters *)p), x))
            newton_substitute(&lin, x);
        jacobian_column(&lin, column, x, column < N_Y ? J + column : f_t, column < N_Y ? N_Y : 1);
    }
    return 0;
}

/* Solve (1/eta - J) u = r + s f_t at a state. Returns a status. */
int gudgeon_newton(double t, const double *y, const double *discrete, const double *p, double eta, double s,
    const double *r, double *u)
{
    Linear lin;
    const int status = linearized(t, y, discrete, (const Parameters *)p, eta, &lin);
    if (status)
        return status;
    newton_solve(&lin, eta, s, r, u);
    return 0;
}
