/*
 * The same system where a pivot (nearly) vanishes: at a singular position (links in one line) rows of
 * Phi_q depend on each other for a moment, and beside it any drift would be blown up. Gram-Schmidt with
 * pivoting on the rows of Phi_q M^(-1/2), twice over, keeps the independent ones; the others must agree
 * with them. If they do not, only what is dependent to rounding is left out; if that does not agree
 * either, the constraints contradict each other and the pivot's number is returned. Rare, dense, and
 * out of the way of the fast path.
 *
 * Of a body whose moment of inertia is small beside m s^2, or 0, or whose mass is small beside another's, M is no
 * measure: another one stands for it. What the rows leave free then follows from M along an orthonormal basis Z of it:
 * Z^T M Z z = Z^T (g - M a) of the a so far.
 */
#define LEAST_INERTIA 1e-3 /* of m s^2, s the longest arm of a joint: the least that an inertia counts in the measure */
#define LEAST_MASS 1e-4    /* of the heaviest body: the same of a mass */

enum { N_BESIDE = (AT_LEAST_ONE(N_ROWS) + 3) / 4 * 4 }; /* rows side by side, in whole vectors of the processor */

typedef struct {
    double basis[N_Q][N_Q];                   /* orthonormal rows found so far, then what they leave free */
    double left[N_Q][N_BESIDE];               /* (Phi_q M^(-1/2))^T: of each row what the basis does not give */
    double lower[AT_LEAST_ONE(N_ROWS)][N_BESIDE]; /* row i = sum over k of lower[k][i] basis[k] */
    double unused[N_BESIDE];                  /* 1 of a row that is not in the basis, 0 of others */
    double all[N_ALL_ROWS][N_Q], root[N_Q], y[N_Q], along[AT_LEAST_ONE(N_ROWS)], rest[AT_LEAST_ONE(N_ROWS)];
    double norm[AT_LEAST_ONE(N_ROWS)];
    /* M over the measure, M^(-1/2) g, Z^T M Z and its solution */
    double fraction[N_Q], force[N_Q], free[N_Q][N_Q], z[N_Q];
    int order[AT_LEAST_ONE(N_ROWS)], light;
    Cancellation *cancellation;
} Workspace;

/* Three sums, of x, y and theta, for an addition waits for the one before it. */
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

/* Products of all rows with a vector, side by side; their squares. Each sum is in the order of coordinates. */
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

static void square_rows(double (*restrict rows)[N_BESIDE], double *restrict sum)
{
    for (int i = 0; i < N_BESIDE; i++)
        sum[i] = 0.0;
    for (int k = 0; k < N_Q; k++)
        for (int i = 0; i < N_BESIDE; i++)
            sum[i] += rows[k][i] * rows[k][i];
}

/* Takes from all rows what `along` has of a vector. */
static void subtract_from_rows(double (*restrict rows)[N_BESIDE], const double *vector, const double *restrict along)
{
    for (int k = 0; k < N_Q; k++) {
        const double factor = vector[k];
        for (int i = 0; i < N_BESIDE; i++)
            rows[k][i] -= along[i] * factor;
    }
}

/* Takes the component along the newest basis vector from every row not yet used, twice for its rounding. */
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

/* Orders the rows, the largest remainder first; returns how many are independent, -1: it is no longer wanted. */
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

/* The measure instead of M in `root`, where masses or moments of inertia are small; `light`: there are such. */
static void measure(Workspace *w)
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

/* Rows scaled by M^(-1/2), and what each must still give: rhs - Phi_q M^-1 g. */
static void fill_workspace(Workspace *w, double t, const double *q, const Parameters *p, const double *force,
    const double *rhs)
{
    *w = (Workspace){0};
    mass_matrix(p, w->root);
    jacobian(t, q, p, &w->all[0][0]);
    measure(w);
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

/* Basis vectors beyond `rank`: what is left of the coordinate of which most is left, one after the other. */
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

/* y with what the rows leave free, and what the multipliers follow from; 0 where M is singular there. */
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

/* y and lambda by the rows that are independent to `least`; 1 if the others agree to `tolerance`, else 0 or STOPPED. */
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

/* a and lambda; `rhs` holds gamma - 2 alpha Phi_dot - beta^2 Phi, `force` is g. */
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
