/*
 * Factorize A (n x n, by rows) in place; order: the pivot rows. Pivots are compared relative to the largest entry of
 * their row. Returns 1 if only rounding is left of a pivot, else 0.
 */
int factor_block(int n, double *A, int *order)
{
    double scale[LARGEST_BLOCK];
    for (int i = 0; i < n; i++) {
        order[i] = i;
        scale[i] = 0.0;
        for (int j = 0; j < n; j++)
            scale[i] = max_of(scale[i], fabs(A[i * n + j]));
    }
    for (int k = 0; k < n; k++) {
        double most = 0.0;
        int best = k;
        for (int i = k; i < n; i++) {
            const double part = fabs(A[order[i] * n + k]) / scale[order[i]];
            if (part > most) {
                most = part;
                best = i;
            }
        }
        if (!(most > 1e-12))
            return 1;
        const int row = order[best];
        order[best] = order[k];
        order[k] = row;
        for (int i = k + 1; i < n; i++) {
            double *below = A + order[i] * n;
            below[k] /= A[row * n + k];
            for (int j = k + 1; j < n; j++)
                below[j] -= below[k] * A[row * n + j];
        }
    }
    return 0;
}

/* Solve A x = b with the factors of factor_block(). x: b on entry, the solution on return. */
void solve_block(int n, const double *A, const int *order, double *x)
{
    double z[LARGEST_BLOCK];
    for (int k = 0; k < n; k++) {
        z[k] = x[order[k]];
        for (int j = 0; j < k; j++)
            z[k] -= A[order[k] * n + j] * z[j];
    }
    for (int k = n - 1; k >= 0; k--) {
        for (int j = k + 1; j < n; j++)
            z[k] -= A[order[k] * n + j] * x[j];
        x[k] = z[k] / A[order[k] * n + k];
    }
}
