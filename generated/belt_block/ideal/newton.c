/* The equations of motion linearized at a state, and Newton's matrix factorized. */
typedef struct {
    const Parameters *p;
    double value[5]; /* what linearize() found */
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
    (void)a;
    /* corners: the sides that are held, if any */
    const double *const side = memory->held ? memory->side : NULL;
    double g[N_SWITCHES + 1];

    /* coordinates, velocities, time */
    const double guide_slide = q[0];
    const double guide_slide_rate = v[0];

    /* parameters */
    const double wall_x = p->wall_x;
    const double spring_stiffness = p->spring_stiffness;
    const double spring_free_length = p->spring_free_length;
    const double rub_kinetic = p->rub_kinetic;

    /* directions, arms, drives */
    const double spring_span_x = guide_slide - wall_x;
    const double side_0 = side_of(side, g, 0, spring_span_x);
    const double spring_length = side_0*spring_span_x;
    const double spring_force = spring_stiffness*(-spring_free_length + spring_length);
    const double spring_pull = spring_force/spring_length;

    /* friction: slip, or stick as a row */
    const double mode_rub_2 = memory->mode[0];  /* 0 stick, 1 or -1 the sign of the slip, 2 held */
    const double stick_rub_2 = mode_rub_2 == 0.0 ? 1.0 : 0.0;
    const double sign_rub_2 = fabs(mode_rub_2) > 1.0 ? 0.0 : mode_rub_2;
    const double held_force_rub = stick_rub_2 != 0.0 ? aside->friction[0].force : 0.0;

    /* coordinates */
    const double spring_force_by_guide_slide = side_0*spring_stiffness;
    const double inverse_spring_length = 1.0/spring_length;
    const double spring_pull_by_guide_slide = -(inverse_spring_length *
        inverse_spring_length)*side_0*spring_force + inverse_spring_length*spring_force_by_guide_slide;

    /* results */
    lin->value[0] = spring_pull + spring_pull_by_guide_slide*spring_span_x;
    lin->value[1] = held_force_rub - rub_kinetic*sign_rub_2;
    lin->value[2] = -guide_slide_rate*stick_rub_2;
    lin->value[3] = stick_rub_2;
    lin->value[4] = 1.0;
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
    const double by_q_guide_slide_guide_slide = lin->value[0];
    const double is_stick_rub_2 = lin->value[3];

    /* parameters */
    const double block_mass = p->block_mass;

    /* matrix */
    const double n_guide_slide__guide_slide = block_mass + by_q_guide_slide_guide_slide*(eta * eta);

    /* L U */
    const double scale_guide_slide = n_guide_slide__guide_slide;
    if (!(fabs(scale_guide_slide) > 1e-13 * fabs(n_guide_slide__guide_slide))) return 1;
    const double inverse_pivot_guide_slide = 1.0/scale_guide_slide;
    lin->lu[0] = inverse_pivot_guide_slide;
    const double scale_rub_2 = -inverse_pivot_guide_slide;
    if (is_stick_rub_2 != 0.0 && !(fabs(scale_rub_2) > 1e-13 * fabs(scale_rub_2))) return 2;
    const double inverse_pivot_rub_2 = is_stick_rub_2 != 0.0 ? 1.0/scale_rub_2 : 0.0;
    lin->lu[1] = inverse_pivot_rub_2;
    return 0;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute(const Linear *lin, double *x)
{
    /* linearization */
    const double inverse_pivot_guide_slide = lin->lu[0];
    const double inverse_pivot_rub_2 = lin->lu[1];

    /* forward */
    const double b_guide_slide = x[0];
    const double b_rub = -b_guide_slide*inverse_pivot_guide_slide + x[1];

    /* backward */
    const double x_rub = b_rub*inverse_pivot_rub_2;
    x[1] = x_rub;
    const double x_guide_slide = inverse_pivot_guide_slide*(b_guide_slide - x_rub);
    x[0] = x_guide_slide;
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
    const double by_q_guide_slide_guide_slide = lin->value[0];
    const double power_v_1_guide_slide = lin->value[1];
    const double power_1_rub = lin->value[2];

    /* parameters */
    const double block_mass = p->block_mass;
    const double two_alpha_stick = p->two_alpha_stick;

    /* eta/kappa */
    const double eta_stick = eta/(eta*two_alpha_stick + 1.0);

    /* right-hand side */
    double x[2];
    x[0] = eta*(block_mass*r[1] - by_q_guide_slide_guide_slide*eta*r[0]);
    x[1] = eta_stick*r[1];
    newton_substitute(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[1] = x[0];
    u[2] = eta*r[2];
    u[3] = eta*(power_v_1_guide_slide*u[1] + r[3]) + power_1_rub*x[1];
    u[4] = eta*r[4];
}

/* Where a part of the linearization is in `value`. */
typedef struct {
    int row, column, value, sign;
} LinearEntry;
static const LinearEntry phi_q_entries[] = {
    {1, 0, 4, 1}
};
static const LinearEntry residual_entries[] = {
    {0, 0, 0, 1}
};
static const LinearEntry residual_t_entries[] = {
    {0, 0, 0, 0}
};
static const LinearEntry power_entries[] = {
    {1, 1, 1, 1}
};
static const LinearEntry power_row_entries[] = {
    {1, 1, 2, 1}
};
static const LinearEntry power_t_entries[] = {
    {0, 0, 0, 0}
};
enum {
    N_PHI_Q = 1,
    N_RESIDUAL = 1,
    N_RESIDUAL_T = 0,
    N_POWER = 1,
    N_POWER_ROW = 1,
    N_POWER_T = 0,
    N_NODES = 2,
};
/*
 * x = -column of R1_q, R1_v, R2_q, R2_v (columns 0 ... 2 N_X - 1) or of R1_t, R2_t (2 N_X); 0 if all
 * are zero.
 */
static int residual_column(const Linear *lin, int column, const double *gain, double stick, double *x)
{
    int found = 0;
    for (int i = 0; i < N_NODES; i++)
        x[i] = 0.0;
    for (int i = 0; i < N_RESIDUAL && column < 2 * N_X; i++) {
        const LinearEntry *at = &residual_entries[i];
        if (at->column == column) {
            x[at->row] -= at->sign * lin->value[at->value];
            found = 1;
        }
    }
    for (int i = 0; i < N_PHI_Q && column < 2 * N_X; i++) { /* Baumgarte: beta^2 Phi_q, 2 alpha Phi_q; a stick has no beta */
        const LinearEntry *at = &phi_q_entries[i];
        if (at->column == column % N_X && (column >= N_X || at->row < N_X + N_LOOPS)) {
            x[at->row] -= (at->row < N_X + N_LOOPS ? gain[column / N_X] : stick) * at->sign * lin->value[at->value];
            found = 1;
        }
    }
    for (int i = 0; i < N_RESIDUAL_T && column == 2 * N_X; i++) {
        x[residual_t_entries[i].row] -= residual_t_entries[i].sign * lin->value[residual_t_entries[i].value];
        found = 1;
    }
    return found;
}

/* The column of the Jacobian that follows from x, the change of accelerations and multipliers; `out` has a stride. */
static void jacobian_column(const Linear *lin, int column, const double *x, double *out, size_t stride)
{
    for (int k = 0; k < N_X; k++) {
        out[k * stride] = column == N_X + k ? 1.0 : 0.0;
        out[(N_X + k) * stride] = x[k];
    }
    for (int w = 0; w < N_WORK; w++)
        out[(2 * N_X + w) * stride] = 0.0;
    for (int i = 0; i < N_POWER_ROW; i++) {
        const LinearEntry *at = &power_row_entries[i];
        out[(2 * N_X + at->row) * stride] += at->sign * lin->value[at->value] * x[at->column];
    }
    for (int i = 0; i < N_POWER; i++)
        if (power_entries[i].column == column)
            out[(2 * N_X + power_entries[i].row) * stride] += power_entries[i].sign * lin->value[power_entries[i].value];
    for (int i = 0; i < N_POWER_T && column == 2 * N_X; i++)
        out[(2 * N_X + power_t_entries[i].row) * stride] += power_t_entries[i].sign * lin->value[power_t_entries[i].value];
}

/* A state linearized and Newton's matrix factorized: 0, a pivot of dynamics(), or -1 - a node of newton_factor(). */
static int linearized(double t, const double *y, const double *memory, const Parameters *p, double eta, Linear *lin)
{
    Memory now = {0};
    Aside aside;
    double dy[N_Y];
    read_memory(memory, &now);
    const int status = motion(t, y, &now, p, dy, &aside);
    if (status)
        return status;
    linearize(t, y, y + N_X, &now, p, dy + N_X, &aside, lin);
    return -newton_factor(eta, lin);
}

/*
 * J = df/dy, row by row (N_Y x N_Y), and f_t of the state equation: a linear solve a column, with the factors of the
 * KKT matrix. Contacts, corners and modes of friction stay as they are.
 */
int gudgeon_tree_jacobian(double t, const double *y, const double *memory, const double *p, double *J, double *f_t)
{
    Linear lin;
    const double gain[2] = {0.0, 0.0};
    const int status = linearized(t, y, memory, (const Parameters *)p, 0.0, &lin);
    if (status)
        return status;
    for (int column = 0; column <= 2 * N_X; column++) {
        double x[N_NODES];
        if (residual_column(&lin, column, gain, ((const Parameters *)p)->two_alpha_stick, x))
            newton_substitute(&lin, x);
        jacobian_column(&lin, column, x, column < 2 * N_X ? J + column : f_t, column < 2 * N_X ? N_Y : 1);
    }
    for (int k = 0; k < N_Y; k++) /* nothing depends on the works */
        for (int w = 0; w < N_WORK; w++)
            J[k * N_Y + 2 * N_X + w] = 0.0;
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
