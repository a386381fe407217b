/*
 * The same system where a pivot vanishes: at a singular position (links in one line) rows of Phi_q
 * depend on each other for a moment. Gram-Schmidt with pivoting on the rows of Phi_q M^(-1/2), twice
 * over, keeps the independent ones; the others must agree with them, or the constraints contradict
 * each other and the pivot's number is returned. Rare, dense, and out of the way of the fast path.
 */
typedef struct {
    double basis[9][N_Q];             /* orthonormal rows found so far */
    double row[9][N_Q];               /* rows of Phi_q M^(-1/2), what is left of them */
    double lower[9][9];          /* row i = sum over k of lower[i][k] basis[k] */
    double all[N_ALL_ROWS][N_Q], root[N_Q], y[N_Q], along[9], rest[9];
    double norm[9];
    int order[9];
} Workspace;

static double dot(const double *a, const double *b)
{
    double sum = 0.0;
    for (int k = 0; k < N_Q; k++)
        sum += a[k] * b[k];
    return sum;
}

/* Takes the component along the newest basis vector from every row not yet used, twice for its rounding. */
static void remove_component(Workspace *w, int rank, int first)
{
    for (int i = first; i < N_ROWS; i++) {
        double *row = w->row[w->order[i]];
        for (int pass = 0; pass < 2; pass++) {
            const double along = dot(row, w->basis[rank]);
            w->lower[w->order[i]][rank] += along;
            for (int k = 0; k < N_Q; k++)
                row[k] -= along * w->basis[rank][k];
        }
    }
}

/* Orders the rows, the largest remainder first; returns how many are independent. */
static int independent_rows(Workspace *w)
{
    int rank = 0;
    for (; rank < N_ROWS; rank++) {
        int best = rank;
        double most = 0.0;
        for (int i = rank; i < N_ROWS; i++) {
            const double left = dot(w->row[w->order[i]], w->row[w->order[i]]) / w->norm[w->order[i]];
            if (left > most) {
                most = left;
                best = i;
            }
        }
        if (!(most > 1e-13))
            break;
        const int chosen = w->order[best];
        w->order[best] = w->order[rank];
        w->order[rank] = chosen;
        const double length = sqrt(dot(w->row[chosen], w->row[chosen]));
        for (int k = 0; k < N_Q; k++)
            w->basis[rank][k] = w->row[chosen][k] / length;
        w->lower[chosen][rank] = length;
        remove_component(w, rank, rank + 1);
    }
    return rank;
}

/* a and lambda by the independent rows; `rhs` holds gamma - 2 alpha Phi_dot - beta^2 Phi, `force` is g. */
static int solve_dependent(double t, const double *q, const Parameters *p, const double *force, const double *rhs,
    double *a, double *lambda, int pivot)
{
    static const int kept[] = {0, 1, 2, 3, 4, 5, 6, 7, 8};
    Workspace *w = calloc(1, sizeof(Workspace));
    if (!w)
        return pivot;
    mass_matrix(p, w->root);
    jacobian(t, q, p, &w->all[0][0]);
    for (int k = 0; k < N_Q; k++) {
        w->root[k] = sqrt(w->root[k]);
        w->y[k] = force[k] / w->root[k];
    }
    for (int i = 0; i < N_ROWS; i++) {
        w->order[i] = i;
        for (int k = 0; k < N_Q; k++)
            w->row[i][k] = w->all[kept[i]][k] / w->root[k];
        w->norm[i] = dot(w->row[i], w->row[i]) + 1e-300;
        w->rest[i] = rhs[i] - dot(w->row[i], w->y);
        w->along[i] = fabs(rhs[i]) + sqrt(w->norm[i] * dot(w->y, w->y)); /* its size, for the comparison below */
    }
    const int rank = independent_rows(w);
    int status = 0;
    for (int k = 0; k < rank; k++) { /* forward: coordinates along the basis */
        const int row = w->order[k];
        const double along = w->rest[row] / w->lower[row][k];
        for (int i = 0; i < N_ROWS; i++) {
            w->along[i] += fabs(w->lower[i][k] * along);
            w->rest[i] -= i == row ? 0.0 : w->lower[i][k] * along;
        }
        w->rest[row] = along;
        for (int j = 0; j < N_Q; j++)
            w->y[j] += along * w->basis[k][j];
    }
    for (int i = rank; i < N_ROWS; i++)
        if (!(fabs(w->rest[w->order[i]]) <= 1e-6 * w->along[w->order[i]]))
            status = pivot;
    for (int i = 0; i < N_ROWS; i++)
        lambda[i] = 0.0;
    for (int k = rank - 1; k >= 0; k--) { /* backward: multipliers of the independent rows */
        double value = w->rest[w->order[k]];
        for (int i = k + 1; i < rank; i++)
            value += w->lower[w->order[i]][k] * lambda[w->order[i]];
        lambda[w->order[k]] = -value / w->lower[w->order[k]][k];
    }
    for (int k = 0; k < N_Q; k++) {
        a[k] = w->y[k] / w->root[k];
        if (!isfinite(a[k]))
            status = pivot;
    }
    free(w);
    return status;
}
