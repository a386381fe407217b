/*
 * Coefficients of the Taylor series of a motion. At each order the sums over lower orders of all products are made
 * first, side by side, for they need nothing of each other; what is left of an order is linear (taylor.c of the scene).
 */
enum { TAYLOR_ROWS = (TAYLOR * sizeof(double) + sizeof(Wide) - 1) / sizeof(Wide) };

typedef union {
    TaylorFactors of;
    Wide row[TAYLOR_ROWS];
} TaylorSums;

/* Of every product: left_1 right_{k-1} + ... + left_{k-1} right_1, two sums, of odd and of even terms. */
static void taylor_sums(int k, Wide (*left)[TAYLOR_ROWS], Wide (*right)[TAYLOR_ROWS], Wide *sum)
{
    for (int i = 0; i < TAYLOR_ROWS; i++) {
        Wide odd = {0.0}, even = {0.0};
        int j = 1;
        for (; j + 1 < k; j += 2) {
            odd += left[j][i] * right[k - j][i];
            even += left[j + 1][i] * right[k - j - 1][i];
        }
        if (j < k)
            odd += left[j][i] * right[k - j][i];
        sum[i] = odd + even;
    }
}

/*
 * c[k], k = 0 ... order: coefficients of what is integrated in powers of time from t on, where it is y. Returns 0, or
 * the number of the pivot that vanished.
 */
int taylor_series(double t, const double *y, const Parameters *p, int order, double (*c)[N_Y])
{
    static _Thread_local Wide factors[2][TAYLOR_ORDERS][TAYLOR_ROWS];
    Wide (*const left)[TAYLOR_ROWS] = factors[0], (*const right)[TAYLOR_ROWS] = factors[1];
    TaylorSums sum;
    TaylorValues at;
    for (int i = 0; i < N_Y; i++)
        c[0][i] = y[i];
    const int status = taylor_values(t, y, y + N_X, p, &at, c[1] + N_X, c[1] + 2 * N_X);
    if (status)
        return status;
    for (int i = 0; i < N_X; i++)
        c[1][i] = c[0][N_X + i];
    for (int k = 1; k < order; k++) {
        double *next = c[k + 1];
        taylor_sums(k, left, right, sum.row);
        taylor_terms(k, 1.0 / k, 1.0 / (k + 1), k == 1 ? 1.0 : 0.0, c[k], c[k] + N_X, p, &at, &sum.of, next + N_X,
            next + 2 * N_X, next, left[k], right[k]);
    }
    return 0;
}
