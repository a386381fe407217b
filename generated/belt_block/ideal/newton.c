/* The equations of motion linearized at a state, and Newton's matrix factorized. */
typedef struct {
    const Parameters *p;
    double value[8]; /* what linearize() found */
    double lu[10];    /* L, U and inverse pivots */
} Linear;

/*
 * The equations of motion linearized at a state, with the accelerations and multipliers that belong to it:
 * non-zeros of M, Phi_q, and of the derivatives of both equations and of the powers by q, v, t.
 */
static void linearize(const double t, const double *q, const double *v, const Memory *memory, const
    Parameters *p, const double *a, const Aside *aside, Linear *lin)
{
    (void)t;
    (void)a;
    /* coordinates, velocities, time */
    const double block_x = q[0];
    const double block_y = q[1];
    const double block_vx = v[0];

    /* parameters */
    const double wall_x = p->wall_x;
    const double spring_stiffness = p->spring_stiffness;
    const double spring_free_length = p->spring_free_length;
    const double rub_kinetic = p->rub_kinetic;

    /* directions, arms, drives */
    const double spring_span_x = block_x - wall_x;
    const double spring_length = sqrt((block_y * block_y) + (spring_span_x * spring_span_x));
    const double spring_force = spring_stiffness*(-spring_free_length + spring_length);
    const double spring_pull = spring_force/spring_length;

    /* friction: slip, or stick as a row */
    const double mode_rub_2 = memory->mode[0];
    const double stick_rub_2 = mode_rub_2 == 0.0 ? 1.0 : 0.0;
    const double sign_rub_2 = fabs(mode_rub_2) > 1.0 ? 0.0 : mode_rub_2;
    const double held_force_rub = stick_rub_2 != 0.0 ? aside->friction[0].force : 0.0;

    /* coordinates */
    const double inverse_denominator = 1.0/(spring_length + 1e-150);
    const double spring_length_by_block_y = block_y*inverse_denominator;
    const double spring_length_by_block_x = inverse_denominator*spring_span_x;
    const double spring_force_by_block_y = spring_length_by_block_y*spring_stiffness;
    const double spring_force_by_block_x = spring_length_by_block_x*spring_stiffness;
    const double inverse_spring_length = 1.0/spring_length;
    const double spring_pull_by_block_y = -(inverse_spring_length *
        inverse_spring_length)*spring_force*spring_length_by_block_y +
        inverse_spring_length*spring_force_by_block_y;
    const double spring_pull_by_block_x = -(inverse_spring_length *
        inverse_spring_length)*spring_force*spring_length_by_block_x +
        inverse_spring_length*spring_force_by_block_x;

    /* results */
    lin->value[0] = spring_pull_by_block_y*spring_span_x;
    lin->value[1] = spring_pull + spring_pull_by_block_x*spring_span_x;
    lin->value[2] = block_y*spring_pull_by_block_y + spring_pull;
    lin->value[3] = block_y*spring_pull_by_block_x;
    lin->value[4] = held_force_rub - rub_kinetic*sign_rub_2;
    lin->value[5] = -block_vx*stick_rub_2;
    lin->value[6] = stick_rub_2;
    lin->value[7] = 1.0;
    lin->p = p;
}

/*
 * L U of Newton's matrix at eta = h gamma (0: the KKT matrix), L with unit diagonal. Returns 0, or the
 * number of the node (coordinates, rows, sticks; from 1) whose pivot vanished or is not finite.
 */
static int newton_factor(double eta, Linear *lin)
{
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double by_q_block_x_block_y = lin->value[0];
    const double by_q_block_x_block_x = lin->value[1];
    const double by_q_block_y_block_y = lin->value[2];
    const double by_q_block_y_block_x = lin->value[3];
    const double is_stick_rub_2 = lin->value[6];

    /* parameters */
    const double block_mass = p->block_mass;
    const double inverse_block_inertia = p->inverse_block_inertia;

    /* matrix */
    const double n_block_x__block_x = block_mass + by_q_block_x_block_x*(eta * eta);
    const double n_block_x__block_y = by_q_block_x_block_y*(eta * eta);
    const double n_block_y__block_x = by_q_block_y_block_x*(eta * eta);
    const double n_block_y__block_y = block_mass + by_q_block_y_block_y*(eta * eta);

    /* L U */
    const double scale_guide_angle_2 = -inverse_block_inertia;
    if (!(fabs(scale_guide_angle_2) > 1e-13 * fabs(scale_guide_angle_2)))
        return 5;
    const double inverse_pivot_guide_angle_2 = 1.0/scale_guide_angle_2;
    lin->lu[0] = inverse_pivot_guide_angle_2;
    const double scale_block_x = n_block_x__block_x;
    if (!(fabs(scale_block_x) > 1e-13 * fabs(n_block_x__block_x)))
        return 1;
    const double inverse_pivot_block_x = 1.0/scale_block_x;
    lin->lu[1] = inverse_pivot_block_x;
    const double l_block_y__block_x = inverse_pivot_block_x*n_block_y__block_x;
    lin->lu[2] = l_block_y__block_x;
    lin->lu[3] = n_block_x__block_y;
    const double scale_block_y = -l_block_y__block_x*n_block_x__block_y + n_block_y__block_y;
    if (!(fabs(scale_block_y) > 1e-13 * fabs(n_block_y__block_y)))
        return 2;
    const double inverse_pivot_block_y = 1.0/scale_block_y;
    lin->lu[4] = inverse_pivot_block_y;
    const double l_rub__block_y = -inverse_pivot_block_x*inverse_pivot_block_y*n_block_x__block_y;
    lin->lu[5] = l_rub__block_y;
    const double scale_guide_offset_2 = -inverse_pivot_block_y;
    if (!(fabs(scale_guide_offset_2) > 1e-13 * fabs(scale_guide_offset_2)))
        return 4;
    const double inverse_pivot_guide_offset_2 = 1.0/scale_guide_offset_2;
    lin->lu[6] = inverse_pivot_guide_offset_2;
    const double l_rub__guide_offset = -inverse_pivot_guide_offset_2*l_rub__block_y;
    lin->lu[7] = l_rub__guide_offset;
    const double u_guide_offset__rub = inverse_pivot_block_y*l_block_y__block_x;
    lin->lu[8] = u_guide_offset__rub;
    const double scale_rub_2 = -inverse_pivot_block_x + l_block_y__block_x*l_rub__block_y;
    const double pivot_rub = -l_rub__guide_offset*u_guide_offset__rub + scale_rub_2;
    if (is_stick_rub_2 != 0.0 && !(fabs(pivot_rub) > 1e-13 * fabs(scale_rub_2)))
        return 6;
    const double inverse_pivot_rub_2 = is_stick_rub_2 != 0.0 ? 1.0 / pivot_rub : 0.0;
    lin->lu[9] = inverse_pivot_rub_2;
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
    const double inverse_pivot_guide_angle_2 = lin->lu[0];
    const double inverse_pivot_block_x = lin->lu[1];
    const double l_block_y__block_x = lin->lu[2];
    const double n_block_x__block_y = lin->lu[3];
    const double inverse_pivot_block_y = lin->lu[4];
    const double l_rub__block_y = lin->lu[5];
    const double inverse_pivot_guide_offset_2 = lin->lu[6];
    const double l_rub__guide_offset = lin->lu[7];
    const double u_guide_offset__rub = lin->lu[8];
    const double inverse_pivot_rub_2 = lin->lu[9];

    /* parameters */
    const double inverse_block_inertia = p->inverse_block_inertia;

    /* forward */
    const double b_block_theta = x[2];
    const double b_guide_angle = -b_block_theta*inverse_block_inertia + x[4];
    const double b_block_x = x[0];
    const double b_block_y = -b_block_x*l_block_y__block_x + x[1];
    const double b_guide_offset = -b_block_y*inverse_pivot_block_y + x[3];
    const double b_rub = -b_block_x*inverse_pivot_block_x - b_block_y*l_rub__block_y -
        b_guide_offset*l_rub__guide_offset + x[5];

    /* backward */
    const double x_rub = b_rub*inverse_pivot_rub_2;
    x[5] = x_rub;
    const double x_guide_offset = inverse_pivot_guide_offset_2*(b_guide_offset - u_guide_offset__rub*x_rub);
    x[3] = x_guide_offset;
    const double x_block_y = inverse_pivot_block_y*(b_block_y + l_block_y__block_x*x_rub - x_guide_offset);
    x[1] = x_block_y;
    const double x_block_x = inverse_pivot_block_x*(b_block_x - n_block_x__block_y*x_block_y - x_rub);
    x[0] = x_block_x;
    const double x_guide_angle = b_guide_angle*inverse_pivot_guide_angle_2;
    x[4] = x_guide_angle;
    const double x_block_theta = inverse_block_inertia*(b_block_theta - x_guide_angle);
    x[2] = x_block_theta;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
static void newton_solve(const Linear *lin, double eta, double s, const double *r, double *u)
{
    (void)s;
    /* numbers of the run */
    const Parameters *const p = lin->p;

    /* linearization */
    const double by_q_block_x_block_y = lin->value[0];
    const double by_q_block_x_block_x = lin->value[1];
    const double by_q_block_y_block_y = lin->value[2];
    const double by_q_block_y_block_x = lin->value[3];
    const double power_v_1_block_x = lin->value[4];
    const double power_1_rub = lin->value[5];

    /* parameters */
    const double block_mass = p->block_mass;
    const double block_inertia = p->block_inertia;
    const double two_alpha = p->two_alpha;
    const double beta_squared = p->beta_squared;

    /* eta/kappa */
    const double eta_row = eta/(eta*(beta_squared*eta + two_alpha) + 1.0);
    const double eta_stick = eta/(eta*two_alpha + 1.0);

    /* right-hand side */
    double x[6];
    const double shifted_block_y = -beta_squared*eta*r[1] + r[4];
    const double shifted_block_theta = -beta_squared*eta*r[2] + r[5];
    x[0] = eta*(block_mass*r[3] - by_q_block_x_block_x*eta*r[0] - by_q_block_x_block_y*eta*r[1]);
    x[1] = eta*(block_mass*r[4] - by_q_block_y_block_x*eta*r[0] - by_q_block_y_block_y*eta*r[1]);
    x[2] = block_inertia*eta*r[5];
    x[3] = eta_row*shifted_block_y;
    x[4] = eta_row*shifted_block_theta;
    x[5] = eta_stick*r[3];
    newton_substitute(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[3] = x[0];
    u[1] = eta*(r[1] + x[1]);
    u[4] = x[1];
    u[2] = eta*(r[2] + x[2]);
    u[5] = x[2];
    u[6] = eta*r[6];
    u[7] = eta*(power_v_1_block_x*u[3] + r[7]) + power_1_rub*x[5];
    u[8] = eta*r[8];
}

/* Where a part of the linearization is in `value`. */
typedef struct {
    int row, column, value, sign;
} LinearEntry;
static const LinearEntry phi_q_entries[] = {
    {3, 1, 7, 1}, {4, 2, 7, 1}, {5, 0, 7, 1}
};
static const LinearEntry residual_entries[] = {
    {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 1, 2, 1}, {1, 0, 3, 1}
};
static const LinearEntry residual_t_entries[] = {
    {0, 0, 0, 0}
};
static const LinearEntry power_entries[] = {
    {1, 3, 4, 1}
};
static const LinearEntry power_row_entries[] = {
    {1, 5, 5, 1}
};
static const LinearEntry power_t_entries[] = {
    {0, 0, 0, 0}
};
enum {
    N_PHI_Q = 3,
    N_RESIDUAL = 4,
    N_RESIDUAL_T = 0,
    N_POWER = 1,
    N_POWER_ROW = 1,
    N_POWER_T = 0,
    N_NODES = 6,
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
