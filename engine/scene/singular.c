/*
 * Accelerations and multipliers where the equations of motion are nearly singular (a pivot almost vanishes). At a
 * singular position (links in line) rows of Phi_q depend on each other, and near it drift is amplified. A Gram-Schmidt
 * orthogonalization with pivoting on the rows of Phi_q M^(-1/2), applied twice, selects independent equations; the
 * others must agree with them. If they do not, only equations dependent to rounding are left out. If these disagree as
 * well, the constraints are contradictory and the pivot's number is returned. This path is seldom used and has dense
 * matrices.
 *
 * M is replaced by another norm for bodies with a small or zero moment of inertia (relative to m s^2) or a small mass.
 * The free motion then follows from M along an orthonormal basis Z of the null space: Z^T M Z z = Z^T (g - M a), with
 * the accelerations a so far.
 */
#define MIN_INERTIA 1e-3 /* of m s^2, s the longest arm of a joint: smallest moment of inertia in the norm */
#define MIN_MASS 1e-4    /* of the heaviest body: smallest mass in the norm */

enum { N_PADDED_ROWS = (AT_LEAST_ONE(N_ROWS) + 3) / 4 * 4 }; /* number of equations, rounded up to whole vectors */

/* Workspace of the orthogonalization. */
typedef struct {
    double basis[N_Q][N_Q];                   /* orthonormal basis of the rows so far, then of the null space */
    double row_remainder[N_Q][N_PADDED_ROWS]; /* (Phi_q M^(-1/2))^T: remainder of each row outside the basis */
    double lower[AT_LEAST_ONE(N_ROWS)][N_PADDED_ROWS]; /* row i = sum over k of lower[k][i] basis[k] */
    double is_unselected[N_PADDED_ROWS];             /* 1 of a row that is not in the basis, 0 of others */
    /* constraint Jacobian; square roots of the norm (or M); accelerations times root_norm; residuals of the rows */
    double phi_q[N_ALL_ROWS][N_Q], root_norm[N_Q], scaled_acceleration[N_Q], residual[AT_LEAST_ONE(N_ROWS)];
    double row_norm_squared[AT_LEAST_ONE(N_ROWS)];
    double magnitude[AT_LEAST_ONE(N_ROWS)];   /* of the terms of right-hand sides */
    /* M over the norm, (root of the norm)^-1 g, Z^T M Z and its solution */
    double mass_over_norm[N_Q], force[N_Q], null_space_mass[N_Q][N_Q], z[N_Q];
    int order[AT_LEAST_ONE(N_ROWS)], has_small_mass;
    Cancellation *cancellation;
} Workspace;

/* Return the scalar product of two vectors (N_Q), by three independent sums: x, y and angles. */
static double compute_dot_product(const double *a, const double *b)
{
    double x = 0.0, y = 0.0, theta = 0.0;
    for (int k = 0; k < N_Q; k += 3) {
        x += a[k] * b[k];
        y += a[k + 1] * b[k + 1];
        theta += a[k + 2] * b[k + 2];
    }
    return x + y + theta;
}

/*
 * Compute the scalar products of all rows (N_Q x N_PADDED_ROWS, stored by columns) with a vector (N_Q): products
 * (N_PADDED_ROWS).
 */
static void multiply_rows_by_vector(double (*restrict rows)[N_PADDED_ROWS], const double *vector,
    double *restrict products)
{
    for (int i = 0; i < N_PADDED_ROWS; i++)
        products[i] = 0.0;
    for (int k = 0; k < N_Q; k++) {
        const double factor = vector[k];
        for (int i = 0; i < N_PADDED_ROWS; i++)
            products[i] += rows[k][i] * factor;
    }
}

/* Compute the squared norms of all rows (N_Q x N_PADDED_ROWS, stored by columns): squares (N_PADDED_ROWS). */
static void compute_squared_norms(double (*restrict rows)[N_PADDED_ROWS], double *restrict squares)
{
    for (int i = 0; i < N_PADDED_ROWS; i++)
        squares[i] = 0.0;
    for (int k = 0; k < N_Q; k++)
        for (int i = 0; i < N_PADDED_ROWS; i++)
            squares[i] += rows[k][i] * rows[k][i];
}

/* Subtract factors[i] times a vector (N_Q) from each row i of a matrix (N_Q x N_PADDED_ROWS, stored by columns). */
static void subtract_from_rows(double (*restrict rows)[N_PADDED_ROWS], const double *vector,
    const double *restrict factors)
{
    for (int k = 0; k < N_Q; k++) {
        const double component = vector[k];
        for (int i = 0; i < N_PADDED_ROWS; i++)
            rows[k][i] -= factors[i] * component;
    }
}

/*
 * Remove the component along the newest basis vector, number `rank`, from the remainder of every row not yet in the
 * basis, twice because of rounding. The components are added to workspace->lower.
 */
static void remove_basis_component(Workspace *workspace, int rank)
{
    const double *basis = workspace->basis[rank];
    for (int pass = 0; pass < 2; pass++) {
        double components[N_PADDED_ROWS];
        multiply_rows_by_vector(workspace->row_remainder, basis, components);
        for (int i = 0; i < N_PADDED_ROWS; i++) {
            components[i] *= workspace->is_unselected[i];
            workspace->lower[rank][i] += components[i];
        }
        subtract_from_rows(workspace->row_remainder, basis, components);
    }
}

/*
 * Select independent rows into workspace->order by Gram-Schmidt with pivoting, the largest relative remainder first,
 * and compute the basis. pivot_tol_squared: squared relative remainder below which a row is dependent. Return the rank,
 * or -1 on cancellation.
 */
static int select_independent_rows(Workspace *workspace, double pivot_tol_squared)
{
    int rank = 0;
    for (; rank < N_ROWS; rank++) {
        if (workspace->cancellation && poll_cancellation(workspace->cancellation))
            return -1;
        int pivot = rank;
        double largest = 0.0, square[N_PADDED_ROWS];
        compute_squared_norms(workspace->row_remainder, square);
        for (int i = rank; i < N_ROWS; i++) {
            const double relative_square =
                square[workspace->order[i]] / workspace->row_norm_squared[workspace->order[i]];
            if (relative_square > largest) {
                largest = relative_square;
                pivot = i;
            }
        }
        if (!(largest > pivot_tol_squared))
            break;
        const int row = workspace->order[pivot];
        workspace->order[pivot] = workspace->order[rank];
        workspace->order[rank] = row;
        const double length = sqrt(square[row]);
        for (int k = 0; k < N_Q; k++)
            workspace->basis[rank][k] = workspace->row_remainder[k][row] / length;
        workspace->lower[rank][row] = length;
        workspace->is_unselected[row] = 0.0;
        remove_basis_component(workspace, rank);
    }
    return rank;
}

/*
 * Compute the diagonal norm that replaces the mass matrix where masses or moments of inertia are small. It is at least
 * MIN_MASS of the largest mass; for angles at least MIN_INERTIA m s^2, where s is the longest lever arm of the body in
 * a constraint equation, or 1e-300 without an arm. workspace->root_norm is M on entry and the square roots of the norm
 * on return; mass_over_norm: M over the norm; null_space_mass[0]: the norm; has_small_mass: whether any is small.
 * Called by initialize_workspace().
 */
static void compute_mass_norm(Workspace *workspace)
{
    double heaviest = 0.0;
    for (int k = 0; k < N_Q; k++)
        heaviest = k % 3 < 2 ? max_of(heaviest, workspace->root_norm[k]) : heaviest;
    for (int k = 0; k < N_Q; k++) {
        double arm_squared = 0.0, mass = k % 3 < 2 ? max_of(workspace->root_norm[k], MIN_MASS * heaviest)
            : workspace->root_norm[k];
        for (int i = 0; i < N_ROWS && k % 3 == 2; i++) {
            const double *row = workspace->phi_q[motion_row[i]];
            if (row[k - 2] != 0.0 || row[k - 1] != 0.0)
                arm_squared = max_of(arm_squared, row[k] * row[k]);
        }
        if (k % 3 == 2)
            mass = max_of(mass, arm_squared > 0.0 ? MIN_INERTIA * workspace->null_space_mass[0][k - 1] * arm_squared
                : 1e-300);
        workspace->mass_over_norm[k] = workspace->root_norm[k] / mass;
        workspace->has_small_mass |= workspace->mass_over_norm[k] < 1.0;
        workspace->null_space_mass[0][k] = mass;
    }
    for (int k = 0; k < N_Q; k++)
        workspace->root_norm[k] = sqrt(workspace->null_space_mass[0][k]);
}

/*
 * Initialize the workspace before a selection of independent equations: rows of Phi_q scaled by the square roots of the
 * norm (root_norm), their order, and the right-hand sides rhs - Phi_q M^-1 g. Accelerations are scaled inversely
 * (scaled_acceleration); each row is its own remainder as long as the basis is empty. If a mass or moment of inertia is
 * small (workspace->has_small_mass), M^-1 g is left out of them; add_free_motion() adds the free motion later. force:
 * g; rhs: right-hand sides of the acceleration constraints. Called by solve_dependent_equations() for each pass.
 */
static void initialize_workspace(Workspace *workspace, double t, const double *q, const Parameters *p,
    const double *force,
    const double *rhs)
{
    *workspace = (Workspace){0};
    mass_matrix(p, workspace->root_norm);
    jacobian(t, q, p, &workspace->phi_q[0][0]);
    compute_mass_norm(workspace);
    for (int k = 0; k < N_Q; k++) {
        workspace->force[k] = force[k] / workspace->root_norm[k];
        workspace->scaled_acceleration[k] = workspace->has_small_mass ? 0.0 : workspace->force[k];
    }
    for (int i = 0; i < N_ROWS; i++) {
        double row[N_Q];
        workspace->order[i] = i;
        workspace->is_unselected[i] = 1.0;
        for (int k = 0; k < N_Q; k++)
            row[k] = workspace->row_remainder[k][i] = workspace->phi_q[motion_row[i]][k] / workspace->root_norm[k];
        workspace->row_norm_squared[i] = compute_dot_product(row, row) + 1e-300;
        workspace->residual[i] = rhs[i] - compute_dot_product(row, workspace->scaled_acceleration);
        workspace->magnitude[i] = fabs(rhs[i]) + sqrt(workspace->row_norm_squared[i]
            * compute_dot_product(workspace->scaled_acceleration,
                workspace->scaled_acceleration)); /* its size, for the comparison below */
    }
}

/*
 * Complete the orthonormal basis from `rank` to N_Q vectors, by a basis of the null space. Each next one is the
 * coordinate direction with the largest remainder, orthogonalized twice. Called by add_free_motion().
 */
static void complete_basis(Workspace *workspace, int rank)
{
    for (; rank < N_Q; rank++) {
        double *next = workspace->basis[rank], largest = -1.0;
        int coordinate = 0;
        for (int j = 0; j < N_Q; j++) {
            double remainder = 1.0;
            for (int k = 0; k < rank; k++)
                remainder -= workspace->basis[k][j] * workspace->basis[k][j];
            if (remainder > largest) {
                largest = remainder;
                coordinate = j;
            }
        }
        for (int j = 0; j < N_Q; j++)
            next[j] = j == coordinate;
        for (int pass = 0; pass < 2; pass++)
            for (int k = 0; k < rank; k++) {
                const double component = compute_dot_product(next, workspace->basis[k]);
                for (int j = 0; j < N_Q; j++)
                    next[j] -= component * workspace->basis[k][j];
            }
        const double length = sqrt(compute_dot_product(next, next));
        for (int j = 0; j < N_Q; j++)
            next[j] /= length;
    }
}

/*
 * Add the motion in the null space of the constraints to the accelerations workspace->scaled_acceleration, and compute
 * the right-hand sides of the multipliers. Called where the norm is not the mass matrix; rank: number of independent
 * rows. Return 0 if M is singular there (the Cholesky factorization of Z^T M Z fails), else 1.
 */
static int add_free_motion(Workspace *workspace, int rank)
{
    complete_basis(workspace, rank);
    for (int i = rank; i < N_Q; i++) { /* Z^T M Z and Z^T (g - M y), by Cholesky's method */
        double *row = workspace->null_space_mass[i];
        workspace->z[i] = compute_dot_product(workspace->basis[i], workspace->force);
        for (int k = 0; k < N_Q; k++)
            workspace->z[i] -=
                workspace->basis[i][k] * workspace->mass_over_norm[k] * workspace->scaled_acceleration[k];
        for (int j = rank; j <= i; j++) {
            row[j] = 0.0;
            for (int k = 0; k < N_Q; k++)
                row[j] += workspace->basis[i][k] * workspace->mass_over_norm[k] * workspace->basis[j][k];
        }
        const double diagonal = row[i];
        for (int j = rank; j <= i; j++) {
            for (int k = rank; k < j; k++)
                row[j] -= row[k] * workspace->null_space_mass[j][k];
            row[j] = j < i ? row[j] / workspace->null_space_mass[j][j] : row[j];
            workspace->z[i] -= j < i ? row[j] * workspace->z[j] : 0.0;
        }
        if (!(row[i] > 1e-14 * diagonal))
            return 0;
        row[i] = sqrt(row[i]);
        workspace->z[i] /= row[i];
    }
    for (int i = N_Q - 1; i >= rank; i--) {
        for (int j = i + 1; j < N_Q; j++)
            workspace->z[i] -= workspace->null_space_mass[j][i] * workspace->z[j];
        workspace->z[i] /= workspace->null_space_mass[i][i];
        for (int k = 0; k < N_Q; k++)
            workspace->scaled_acceleration[k] += workspace->z[i] * workspace->basis[i][k];
    }
    for (int i = 0; i < rank; i++) {
        double sum = -compute_dot_product(workspace->basis[i], workspace->force);
        for (int k = 0; k < N_Q; k++)
            sum += workspace->basis[i][k] * workspace->mass_over_norm[k] * workspace->scaled_acceleration[k];
        workspace->residual[workspace->order[i]] = sum;
    }
    return 1;
}

/*
 * Compute accelerations workspace->scaled_acceleration and multipliers lambda (N_ROWS) by the independent equations;
 * dependent ones have lambda = 0. A row is independent if its remainder outside the rows already selected has a squared
 * norm above pivot_tol_squared, relative to the row. Return 1 if the dependent equations agree to `tolerance`, 0 if not
 * or if M is singular, or STOPPED on cancellation.
 */
static int solve_independent_equations(Workspace *workspace, double pivot_tol_squared, double tolerance, double *lambda)
{
    const int rank = select_independent_rows(workspace, pivot_tol_squared);
    if (rank < 0)
        return STOPPED;
    for (int k = 0; k < rank; k++) { /* forward: coordinates along the basis */
        const int row = workspace->order[k];
        const double component = workspace->residual[row] / workspace->lower[k][row];
        for (int i = 0; i < N_ROWS; i++) {
            workspace->magnitude[i] += fabs(workspace->lower[k][i] * component);
            workspace->residual[i] -= i == row ? 0.0 : workspace->lower[k][i] * component;
        }
        workspace->residual[row] = component;
        for (int j = 0; j < N_Q; j++)
            workspace->scaled_acceleration[j] += component * workspace->basis[k][j];
    }
    if (workspace->has_small_mass && !add_free_motion(workspace, rank))
        return 0;
    for (int i = 0; i < N_ROWS; i++)
        lambda[i] = 0.0;
    for (int k = rank - 1; k >= 0; k--) { /* backward: multipliers of the independent rows */
        double value = workspace->residual[workspace->order[k]];
        for (int i = k + 1; i < rank; i++)
            value += workspace->lower[k][workspace->order[i]] * lambda[workspace->order[i]];
        lambda[workspace->order[k]] = -value / workspace->lower[k][workspace->order[k]];
    }
    int is_consistent = 1;
    for (int i = rank; i < N_ROWS; i++)
        is_consistent = is_consistent && fabs(workspace->residual[workspace->order[i]]) <= tolerance
            * workspace->magnitude[workspace->order[i]];
    return is_consistent;
}

/*
 * Compute accelerations a and multipliers lambda where a pivot of the equations of motion nearly vanishes. force: g;
 * rhs: gamma - 2 alpha Phi_dot - beta^2 Phi; pivot: number of the pivot. Nearly dependent equations (NEARLY_SINGULAR)
 * are left out if they agree with the others; in a second pass only those dependent to rounding (SINGULAR). Return 0,
 * NEAR_SINGULAR if the motion is to be continued from both sides, STOPPED, or `pivot` if the constraints are
 * contradictory, accelerations are not finite, or memory is short. Called by the equations of motion after their
 * factorization has failed.
 */
int solve_dependent_equations(double t, const double *q, const Parameters *p, const double *force, const double *rhs,
    double *a, double *lambda, int pivot, const DiscreteState *discrete)
{
    static const double pivot_tols_squared[] = {NEARLY_SINGULAR, SINGULAR}, tolerances[] = {1e-3, 1e-6};
    if (discrete->min_pivot > NEARLY_SINGULAR)
        return NEAR_SINGULAR;
    Workspace *workspace = malloc(sizeof(Workspace));
    int status = pivot;
    for (int pass = 0; workspace && status && pass < 2; pass++) {
        initialize_workspace(workspace, t, q, p, force, rhs);
        workspace->cancellation = discrete->token;
        status = solve_independent_equations(workspace, pivot_tols_squared[pass], tolerances[pass], lambda);
        if (status == STOPPED)
            break;
        if (!status) {
            status = pivot;
            continue;
        }
        status = 0;
        for (int k = 0; k < N_Q; k++) {
            a[k] = workspace->scaled_acceleration[k] / workspace->root_norm[k];
            if (!isfinite(a[k]))
                status = pivot;
        }
    }
    free(workspace);
    return status;
}
