/* The equations of motion linearized at a state, and Newton's matrix factorized. */
typedef struct {
    const Parameters *p;
    double value[1]; /* what linearize() found */
    double lu[2];    /* L, U and inverse pivots */
} Linear;

/*
 * The equations of motion linearized at a state, with the accelerations and multipliers that belong to it:
 * non-zeros of M, Phi_q, and of the derivatives of both equations and of the powers by q, v, t.
 */
static void linearize(const double t, const double *q, const double *v, const Memory *memory, const
    Parameters *p, const double *a, const Aside *aside, Linear *lin)
{
    (void)t;
    (void)q;
    (void)v;
    (void)memory;
    (void)a;
    (void)aside;
    /* results */
    lin->value[0] = -1.0;
    lin->p = p;
}

/*
 * L U of Newton's matrix at eta = h gamma (0: the KKT matrix), L with unit diagonal. Returns 0, or the
 * number of the node (coordinates, rows, sticks; from 1) whose pivot vanished or is not finite.
 */
static int newton_factor(double eta, Linear *lin)
{
    (void)eta;
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* parameters */
    const double inverse_ball_mass = p->inverse_ball_mass;

    /* L U */
    const double scale_fall_x_2 = -inverse_ball_mass;
    if (!(fabs(scale_fall_x_2) > 1e-08 * fabs(scale_fall_x_2)))
        return 4;
    const double inverse_pivot_fall_x_2 = 1.0/scale_fall_x_2;
    lin->lu[0] = inverse_pivot_fall_x_2;
    const double scale_fall_y_2 = -inverse_ball_mass;
    if (!(fabs(scale_fall_y_2) > 1e-08 * fabs(scale_fall_y_2)))
        return 5;
    const double inverse_pivot_fall_y_2 = 1.0/scale_fall_y_2;
    lin->lu[1] = inverse_pivot_fall_y_2;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute(const Linear *lin, double *x)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double inverse_pivot_fall_x_2 = lin->lu[0];
    const double inverse_pivot_fall_y_2 = lin->lu[1];

    /* parameters */
    const double inverse_ball_inertia = p->inverse_ball_inertia;
    const double inverse_ball_mass = p->inverse_ball_mass;

    /* forward */
    const double b_ball_theta = x[2];
    const double b_ball_x = x[0];
    const double b_fall_x = b_ball_x*inverse_ball_mass + x[3];
    const double b_ball_y = x[1];
    const double b_fall_y = b_ball_y*inverse_ball_mass + x[4];

    /* backward */
    const double x_fall_y = b_fall_y*inverse_pivot_fall_y_2;
    x[4] = x_fall_y;
    const double x_ball_y = inverse_ball_mass*(b_ball_y + x_fall_y);
    x[1] = x_ball_y;
    const double x_fall_x = b_fall_x*inverse_pivot_fall_x_2;
    x[3] = x_fall_x;
    const double x_ball_x = inverse_ball_mass*(b_ball_x + x_fall_x);
    x[0] = x_ball_x;
    const double x_ball_theta = b_ball_theta*inverse_ball_inertia;
    x[2] = x_ball_theta;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
static void newton_solve(const Linear *lin, double eta, double s, const double *r, double *u)
{
    (void)s;
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* parameters */
    const double ball_mass = p->ball_mass;
    const double ball_inertia = p->ball_inertia;
    const double two_alpha = p->two_alpha;
    const double beta_squared = p->beta_squared;

    /* eta/kappa */
    const double eta_row = eta/(eta*(beta_squared*eta + two_alpha) + 1.0);

    /* right-hand side */
    double x[5];
    const double shifted_ball_x = -beta_squared*eta*r[0] + r[3];
    const double shifted_ball_y = -beta_squared*eta*r[1] + r[4];
    x[0] = ball_mass*eta*r[3];
    x[1] = ball_mass*eta*r[4];
    x[2] = ball_inertia*eta*r[5];
    x[3] = -eta_row*shifted_ball_x;
    x[4] = -eta_row*shifted_ball_y;
    newton_substitute(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[3] = x[0];
    u[1] = eta*(r[1] + x[1]);
    u[4] = x[1];
    u[2] = eta*(r[2] + x[2]);
    u[5] = x[2];
    u[6] = eta*r[6];
    u[7] = eta*r[7];
    u[8] = eta*r[8];
}

/* Where a part of the linearization is in `value`. */
typedef struct {
    int row, column, value, sign;
} LinearEntry;
static const LinearEntry phi_q_entries[] = {
    {3, 0, 0, 1}, {4, 1, 0, 1}
};
static const LinearEntry residual_entries[] = {
    {0, 0, 0, 0}
};
static const LinearEntry residual_t_entries[] = {
    {0, 0, 0, 0}
};
static const LinearEntry power_entries[] = {
    {0, 0, 0, 0}
};
static const LinearEntry power_row_entries[] = {
    {0, 0, 0, 0}
};
static const LinearEntry power_t_entries[] = {
    {0, 0, 0, 0}
};
enum {
    N_PHI_Q = 2,
    N_RESIDUAL = 0,
    N_RESIDUAL_T = 0,
    N_POWER = 0,
    N_POWER_ROW = 0,
    N_POWER_T = 0,
    N_NODES = 5,
};
/*
 * x = -column of R1_q, R1_v, R2_q, R2_v (columns 0 ... 2 N_Q - 1) or of R1_t, R2_t (2 N_Q); 0 if all
 * are zero.
 */
static int residual_column(const Linear *lin, int column, const double *gain, double *x)
{
    int found = 0;
    for (int i = 0; i < N_NODES; i++)
        x[i] = 0.0;
    for (int i = 0; i < N_RESIDUAL && column < 2 * N_Q; i++) {
        const LinearEntry *at = &residual_entries[i];
        if (at->column == column) {
            x[at->row] -= at->sign * lin->value[at->value];
            found = 1;
        }
    }
    for (int i = 0; i < N_PHI_Q && column < 2 * N_Q; i++) { /* Baumgarte: beta^2 Phi_q, 2 alpha Phi_q; a stick has no beta */
        const LinearEntry *at = &phi_q_entries[i];
        if (at->column == column % N_Q && (column >= N_Q || at->row < N_Q + N_ROWS)) {
            x[at->row] -= gain[column / N_Q] * at->sign * lin->value[at->value];
            found = 1;
        }
    }
    for (int i = 0; i < N_RESIDUAL_T && column == 2 * N_Q; i++) {
        x[residual_t_entries[i].row] -= residual_t_entries[i].sign * lin->value[residual_t_entries[i].value];
        found = 1;
    }
    return found;
}

/* The column of the Jacobian that follows from x, the change of accelerations and multipliers; `out` has a stride. */
static void jacobian_column(const Linear *lin, int column, const double *x, double *out, size_t stride)
{
    for (int k = 0; k < N_Q; k++) {
        out[k * stride] = column == N_Q + k ? 1.0 : 0.0;
        out[(N_Q + k) * stride] = x[k];
    }
    for (int w = 0; w < N_WORK; w++)
        out[(2 * N_Q + w) * stride] = 0.0;
    for (int i = 0; i < N_POWER_ROW; i++) {
        const LinearEntry *at = &power_row_entries[i];
        out[(2 * N_Q + at->row) * stride] += at->sign * lin->value[at->value] * x[at->column];
    }
    for (int i = 0; i < N_POWER; i++)
        if (power_entries[i].column == column)
            out[(2 * N_Q + power_entries[i].row) * stride] += power_entries[i].sign * lin->value[power_entries[i].value];
    for (int i = 0; i < N_POWER_T && column == 2 * N_Q; i++)
        out[(2 * N_Q + power_t_entries[i].row) * stride] += power_t_entries[i].sign * lin->value[power_t_entries[i].value];
}

/* A state linearized and Newton's matrix factorized: 0, a pivot of dynamics(), or -1 - a node of newton_factor(). */
static int linearized(double t, const double *y, const double *memory, const Parameters *p, double eta, Linear *lin)
{
    Memory now;
    Aside aside;
    double dy[N_Y];
    read_memory(memory, &now);
    const int status = state_equation(t, y, &now, p, dy, &aside);
    if (status)
        return status;
    linearize(t, y, y + N_Q, &now, p, dy + N_Q, &aside, lin);
    return -newton_factor(eta, lin);
}

/*
 * J = df/dy, row by row (N_Y x N_Y), and f_t of the state equation: a linear solve a column, with the factors of the
 * KKT matrix. Contacts, corners and modes of friction stay as they are.
 */
int gudgeon_jacobian(double t, const double *y, const double *memory, const double *p, double *J, double *f_t)
{
    Linear lin;
    const double gain[2] = {((const Parameters *)p)->beta_squared, ((const Parameters *)p)->two_alpha};
    const int status = linearized(t, y, memory, (const Parameters *)p, 0.0, &lin);
    if (status)
        return status;
    for (int column = 0; column <= 2 * N_Q; column++) {
        double x[N_NODES];
        if (residual_column(&lin, column, gain, x))
            newton_substitute(&lin, x);
        jacobian_column(&lin, column, x, column < 2 * N_Q ? J + column : f_t, column < 2 * N_Q ? N_Y : 1);
    }
    for (int k = 0; k < N_Y; k++) /* nothing depends on the works */
        for (int w = 0; w < N_WORK; w++)
            J[k * N_Y + 2 * N_Q + w] = 0.0;
    return 0;
}

/* (1/eta - J) u = r + s f_t at a state. */
int gudgeon_newton(double t, const double *y, const double *memory, const double *p, double eta, double s,
    const double *r, double *u)
{
    Linear lin;
    const int status = linearized(t, y, memory, (const Parameters *)p, eta, &lin);
    if (status)
        return status;
    newton_solve(&lin, eta, s, r, u);
    return 0;
}
