/*
 * Accelerations and multipliers where a pivot nearly vanishes. At a singular position (links in line) rows of Phi_q
 * depend on each other, and near it drift is amplified. A Gram-Schmidt orthogonalization with pivoting on the rows of
 * Phi_q M^(-1/2), applied twice, selects independent equations; the others must agree with them. If they do not, only
 * equations dependent to rounding are left out. If these disagree as well, the constraints are contradictory and the
 * pivot's number is returned. This path is rare and uses dense matrices.
 *
 * M is replaced by another norm for bodies with a small or zero moment of inertia (relative to m s^2) or a small mass.
 * The free motion then follows from M along an orthonormal basis Z of the null space: Z^T M Z z = Z^T (g - M a), with
 * the accelerations a so far.
 */
#define LEAST_INERTIA 1e-3 /* of m s^2, s the longest arm of a joint: least moment of inertia in the norm */
#define LEAST_MASS 1e-4    /* of the heaviest body: least mass in the norm */

enum { N_BESIDE = (AT_LEAST_ONE(N_ROWS) + 3) / 4 * 4 }; /* number of equations, rounded up to whole vectors */

/* Workspace of the orthogonalization. */
typedef struct {
    double basis[N_Q][N_Q];                   /* orthonormal basis of the rows so far, then of the null space */
    double left[N_Q][N_BESIDE];               /* (Phi_q M^(-1/2))^T: remainder of each row outside the basis */
    double lower[AT_LEAST_ONE(N_ROWS)][N_BESIDE]; /* row i = sum over k of lower[k][i] basis[k] */
    double unused[N_BESIDE];                  /* 1 of a row that is not in the basis, 0 of others */
    double all[N_ALL_ROWS][N_Q], root[N_Q], y[N_Q], along[AT_LEAST_ONE(N_ROWS)], rest[AT_LEAST_ONE(N_ROWS)];
    double norm[AT_LEAST_ONE(N_ROWS)];
    /* M over the norm, its root^-1 g, Z^T M Z and its solution */
    double fraction[N_Q], force[N_Q], free[N_Q][N_Q], z[N_Q];
    int order[AT_LEAST_ONE(N_ROWS)], light;
    Cancellation *cancellation;
} Workspace;

/* Return the scalar product of two vectors (N_Q), by three independent sums. */
static double dot(const double *a, const double *b)
{
    double x = 0.0, y = 0.0, theta = 0.0;
    for (int k = 0; k < N_Q; k += 3) {
        x += a[k] * b[k];
        y += a[k + 1] * b[k + 1];
        theta += a[k + 2] * b[k + 2];
    }
    return x + y + theta;
}

/* Compute the products of all rows with a vector: sum[N_BESIDE]. */
static void dot_rows(double (*restrict rows)[N_BESIDE], const double *vector, double *restrict sum)
{
    for (int i = 0; i < N_BESIDE; i++)
        sum[i] = 0.0;
    for (int k = 0; k < N_Q; k++) {
        const double factor = vector[k];
        for (int i = 0; i < N_BESIDE; i++)
            sum[i] += rows[k][i] * factor;
    }
}

/* Compute the squared norms of all rows: sum[N_BESIDE]. */
static void square_rows(double (*restrict rows)[N_BESIDE], double *restrict sum)
{
    for (int i = 0; i < N_BESIDE; i++)
        sum[i] = 0.0;
    for (int k = 0; k < N_Q; k++)
        for (int i = 0; i < N_BESIDE; i++)
            sum[i] += rows[k][i] * rows[k][i];
}

/* Subtract along[i] times a vector from each row i. */
static void subtract_from_rows(double (*restrict rows)[N_BESIDE], const double *vector, const double *restrict along)
{
    for (int k = 0; k < N_Q; k++) {
        const double factor = vector[k];
        for (int i = 0; i < N_BESIDE; i++)
            rows[k][i] -= along[i] * factor;
    }
}

/* Remove the component along the newest basis vector from every row not yet used, twice because of rounding. */
static void remove_component(Workspace *w, int rank)
{
    const double *basis = w->basis[rank];
    for (int pass = 0; pass < 2; pass++) {
        double along[N_BESIDE];
        dot_rows(w->left, basis, along);
        for (int i = 0; i < N_BESIDE; i++) {
            along[i] *= w->unused[i];
            w->lower[rank][i] += along[i];
        }
        subtract_from_rows(w->left, basis, along);
    }
}

/*
 * Select independent rows, the largest remainder first, into w->order. least: squared relative remainder of a dependent
 * row. Returns their number, or -1 on cancellation.
 */
static int independent_rows(Workspace *w, double least)
{
    int rank = 0;
    for (; rank < N_ROWS; rank++) {
        if (w->cancellation && poll_cancellation(w->cancellation))
            return -1;
        int best = rank;
        double most = 0.0, square[N_BESIDE];
        square_rows(w->left, square);
        for (int i = rank; i < N_ROWS; i++) {
            const double left = square[w->order[i]] / w->norm[w->order[i]];
            if (left > most) {
                most = left;
                best = i;
            }
        }
        if (!(most > least))
            break;
        const int chosen = w->order[best];
        w->order[best] = w->order[rank];
        w->order[rank] = chosen;
        const double length = sqrt(square[chosen]);
        for (int k = 0; k < N_Q; k++)
            w->basis[rank][k] = w->left[k][chosen] / length;
        w->lower[rank][chosen] = length;
        w->unused[chosen] = 0.0;
        remove_component(w, rank);
    }
    return rank;
}

/* Compute the norm that replaces M where masses or moments of inertia are small; `light`: whether any is. */
static void compute_norm(Workspace *w)
{
    double heaviest = 0.0;
    for (int k = 0; k < N_Q; k++)
        heaviest = k % 3 < 2 ? max_of(heaviest, w->root[k]) : heaviest;
    for (int k = 0; k < N_Q; k++) {
        double arm = 0.0, counts = k % 3 < 2 ? max_of(w->root[k], LEAST_MASS * heaviest) : w->root[k];
        for (int i = 0; i < N_ROWS && k % 3 == 2; i++) {
            const double *row = w->all[kept_row[i]];
            if (row[k - 2] != 0.0 || row[k - 1] != 0.0)
                arm = max_of(arm, row[k] * row[k]);
        }
        if (k % 3 == 2)
            counts = max_of(counts, arm > 0.0 ? LEAST_INERTIA * w->free[0][k - 1] * arm : 1e-300);
        w->fraction[k] = w->root[k] / counts;
        w->light |= w->fraction[k] < 1.0;
        w->free[0][k] = counts;
    }
    for (int k = 0; k < N_Q; k++)
        w->root[k] = sqrt(w->free[0][k]);
}

/* Fill the workspace: rows scaled by the norm, and their right-hand sides rhs - Phi_q M^-1 g. */
static void fill_workspace(Workspace *w, double t, const double *q, const Parameters *p, const double *force,
    const double *rhs)
{
    *w = (Workspace){0};
    mass_matrix(p, w->root);
    jacobian(t, q, p, &w->all[0][0]);
    compute_norm(w);
    for (int k = 0; k < N_Q; k++) {
        w->force[k] = force[k] / w->root[k];
        w->y[k] = w->light ? 0.0 : w->force[k];
    }
    for (int i = 0; i < N_ROWS; i++) {
        double row[N_Q];
        w->order[i] = i;
        w->unused[i] = 1.0;
        for (int k = 0; k < N_Q; k++)
            row[k] = w->left[k][i] = w->all[kept_row[i]][k] / w->root[k];
        w->norm[i] = dot(row, row) + 1e-300;
        w->rest[i] = rhs[i] - dot(row, w->y);
        w->along[i] = fabs(rhs[i]) + sqrt(w->norm[i] * dot(w->y, w->y)); /* its size, for the comparison below */
    }
}

/* Complete the orthonormal basis beyond `rank`: each time from the coordinate with the largest remainder. */
static void complete_basis(Workspace *w, int rank)
{
    for (; rank < N_Q; rank++) {
        double *next = w->basis[rank], most = -1.0;
        int best = 0;
        for (int j = 0; j < N_Q; j++) {
            double left = 1.0;
            for (int k = 0; k < rank; k++)
                left -= w->basis[k][j] * w->basis[k][j];
            if (left > most) {
                most = left;
                best = j;
            }
        }
        for (int j = 0; j < N_Q; j++)
            next[j] = j == best;
        for (int pass = 0; pass < 2; pass++)
            for (int k = 0; k < rank; k++) {
                const double along = dot(next, w->basis[k]);
                for (int j = 0; j < N_Q; j++)
                    next[j] -= along * w->basis[k][j];
            }
        const double length = sqrt(dot(next, next));
        for (int j = 0; j < N_Q; j++)
            next[j] /= length;
    }
}

/*
 * Add the motion in the null space of the constraints to y, and compute the right-hand sides of the multipliers.
 * Returns 0 if M is singular there.
 */
static int add_free_motion(Workspace *w, int rank)
{
    complete_basis(w, rank);
    for (int i = rank; i < N_Q; i++) { /* Z^T M Z and Z^T (g - M y), by Cholesky's method */
        double *row = w->free[i];
        w->z[i] = dot(w->basis[i], w->force);
        for (int k = 0; k < N_Q; k++)
            w->z[i] -= w->basis[i][k] * w->fraction[k] * w->y[k];
        for (int j = rank; j <= i; j++) {
            row[j] = 0.0;
            for (int k = 0; k < N_Q; k++)
                row[j] += w->basis[i][k] * w->fraction[k] * w->basis[j][k];
        }
        const double whole = row[i];
        for (int j = rank; j <= i; j++) {
            for (int k = rank; k < j; k++)
                row[j] -= row[k] * w->free[j][k];
            row[j] = j < i ? row[j] / w->free[j][j] : row[j];
            w->z[i] -= j < i ? row[j] * w->z[j] : 0.0;
        }
        if (!(row[i] > 1e-14 * whole))
            return 0;
        row[i] = sqrt(row[i]);
        w->z[i] /= row[i];
    }
    for (int i = N_Q - 1; i >= rank; i--) {
        for (int j = i + 1; j < N_Q; j++)
            w->z[i] -= w->free[j][i] * w->z[j];
        w->z[i] /= w->free[i][i];
        for (int k = 0; k < N_Q; k++)
            w->y[k] += w->z[i] * w->basis[i][k];
    }
    for (int i = 0; i < rank; i++) {
        double left = -dot(w->basis[i], w->force);
        for (int k = 0; k < N_Q; k++)
            left += w->basis[i][k] * w->fraction[k] * w->y[k];
        w->rest[w->order[i]] = left;
    }
    return 1;
}

/*
 * Compute y and lambda by the equations that are independent to `least`. Returns 1 if the others agree to `tolerance`,
 * 0 if not, or STOPPED.
 */
static int solve_independent(Workspace *w, double least, double tolerance, double *lambda)
{
    const int rank = independent_rows(w, least);
    if (rank < 0)
        return STOPPED;
    for (int k = 0; k < rank; k++) { /* forward: coordinates along the basis */
        const int row = w->order[k];
        const double along = w->rest[row] / w->lower[k][row];
        for (int i = 0; i < N_ROWS; i++) {
            w->along[i] += fabs(w->lower[k][i] * along);
            w->rest[i] -= i == row ? 0.0 : w->lower[k][i] * along;
        }
        w->rest[row] = along;
        for (int j = 0; j < N_Q; j++)
            w->y[j] += along * w->basis[k][j];
    }
    if (w->light && !add_free_motion(w, rank))
        return 0;
    for (int i = 0; i < N_ROWS; i++)
        lambda[i] = 0.0;
    for (int k = rank - 1; k >= 0; k--) { /* backward: multipliers of the independent rows */
        double value = w->rest[w->order[k]];
        for (int i = k + 1; i < rank; i++)
            value += w->lower[k][w->order[i]] * lambda[w->order[i]];
        lambda[w->order[k]] = -value / w->lower[k][w->order[k]];
    }
    int agree = 1;
    for (int i = rank; i < N_ROWS; i++)
        agree = agree && fabs(w->rest[w->order[i]]) <= tolerance * w->along[w->order[i]];
    return agree;
}

/*
 * Compute accelerations a and multipliers lambda where a pivot nearly vanishes. force: g; rhs: gamma - 2 alpha Phi_dot
 * - beta^2 Phi. Returns 0, NEAR if the motion is to be continued, STOPPED, or `pivot` if the constraints are
 * contradictory.
 */
int solve_dependent(double t, const double *q, const Parameters *p, const double *force, const double *rhs,
    double *a, double *lambda, int pivot, const DiscreteState *discrete)
{
    static const double least[] = {NEARLY_SINGULAR, SINGULAR}, tolerance[] = {1e-3, 1e-6};
    if (discrete->least > NEARLY_SINGULAR)
        return NEAR;
    Workspace *w = malloc(sizeof(Workspace));
    int status = pivot;
    for (int pass = 0; w && status && pass < 2; pass++) {
        fill_workspace(w, t, q, p, force, rhs);
        w->cancellation = discrete->token;
        status = solve_independent(w, least[pass], tolerance[pass], lambda);
        if (status == STOPPED)
            break;
        if (!status) {
            status = pivot;
            continue;
        }
        status = 0;
        for (int k = 0; k < N_Q; k++) {
            a[k] = w->y[k] / w->root[k];
            if (!isfinite(a[k]))
                status = pivot;
        }
    }
    free(w);
    return status;
}
