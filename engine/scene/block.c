/* LU factorization and solution of a small dense block of equations, of at most LARGEST_BLOCK unknowns. */
/*
 * Factorize the n x n matrix A (by rows) in place by LU factorization with scaled partial pivoting; pivot_rows: the
 * order of the rows. Return 1 if a pivot is at most 1e-12 of the largest entry of its row, else 0. Called by emitted
 * code for blocks of more than two unknowns.
 */
int factor_block(int n, double *A, int *pivot_rows)
{
    double scale[LARGEST_BLOCK];
    for (int i = 0; i < n; i++) {
        pivot_rows[i] = i;
        scale[i] = 0.0;
        for (int j = 0; j < n; j++)
            scale[i] = max_of(scale[i], fabs(A[i * n + j]));
    }
    for (int k = 0; k < n; k++) {
        double largest = 0.0;
        int pivot = k;
        for (int i = k; i < n; i++) {
            const double ratio = fabs(A[pivot_rows[i] * n + k]) / scale[pivot_rows[i]];
            if (ratio > largest) {
                largest = ratio;
                pivot = i;
            }
        }
        if (!(largest > 1e-12))
            return 1;
        const int row = pivot_rows[pivot];
        pivot_rows[pivot] = pivot_rows[k];
        pivot_rows[k] = row;
        for (int i = k + 1; i < n; i++) {
            double *below = A + pivot_rows[i] * n;
            below[k] /= A[row * n + k];
            for (int j = k + 1; j < n; j++)
                below[j] -= below[k] * A[row * n + j];
        }
    }
    return 0;
}

/*
 * Solve A x = b by forward and back substitution with the factors and the row order of factor_block(). x: b on entry,
 * the solution on return. Called by emitted code.
 */
void solve_block(int n, const double *A, const int *pivot_rows, double *x)
{
    double z[LARGEST_BLOCK];
    for (int k = 0; k < n; k++) {
        z[k] = x[pivot_rows[k]];
        for (int j = 0; j < k; j++)
            z[k] -= A[pivot_rows[k] * n + j] * z[j];
    }
    for (int k = n - 1; k >= 0; k--) {
        for (int j = k + 1; j < n; j++)
            z[k] -= A[pivot_rows[k] * n + j] * x[j];
        x[k] = z[k] / A[pivot_rows[k] * n + k];
    }
}
