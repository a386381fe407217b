/*
 * Coefficients of the Taylor series of a motion. At each order the sums over lower orders of all products are made
 * first, side by side, for they need nothing of each other; what is left of an order is linear (taylor.c of the scene).
 */
enum { TAYLOR_ROWS = (TAYLOR * sizeof(double) + sizeof(Wide) - 1) / sizeof(Wide) };

typedef union {
    TaylorFactors of;
    Wide row[TAYLOR_ROWS];
} TaylorSums;

/*
 * Of every product: left_1 right_{k-1} + ... + left_{k-1} right_1, and of order k + 1 what is known of it already: all
 * but left_1 right_k and left_k right_1.
 */
static void taylor_sums(int k, Wide (*left)[TAYLOR_ROWS], Wide (*right)[TAYLOR_ROWS], Wide *sum, Wide *next)
{
    for (int i = 0; i < TAYLOR_ROWS; i++) {
        Wide now = {0.0}, then = {0.0}, before = right[k - 1][i];
        now += left[1][i] * before;
        for (int j = 2; j < k; j++) {
            const Wide factor = left[j][i];
            then += factor * before;
            before = right[k - j][i];
            now += factor * before;
        }
        sum[i] = now;
        next[i] = then;
    }
}

/* What was left open of an order. */
static void taylor_rest(int k, Wide (*left)[TAYLOR_ROWS], Wide (*right)[TAYLOR_ROWS], Wide *sum)
{
    for (int i = 0; i < TAYLOR_ROWS; i++)
        sum[i] += left[1][i] * right[k - 1][i] + left[k - 1][i] * right[1][i];
}

/*
 * c[k], k = 0 ... order: coefficients of what is integrated in powers of time from t on, where it is y. Returns 0, or
 * the number of the pivot that vanished.
 */
int taylor_series(double t, const double *y, const Parameters *p, int order, double (*c)[TAYLOR_Y])
{
    static _Thread_local Wide factors[2][TAYLOR_ORDERS][TAYLOR_ROWS];
    Wide (*const left)[TAYLOR_ROWS] = factors[0], (*const right)[TAYLOR_ROWS] = factors[1];
    TaylorSums sum[2] = {0};
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
        if (k % 2 == 0)
            taylor_sums(k, left, right, sum[0].row, sum[1].row);
        else if (k > 1)
            taylor_rest(k, left, right, sum[1].row);
        taylor_terms(k, 1.0 / k, 1.0 / (k + 1), k == 1 ? 1.0 : 0.0, c[k], c[k] + N_X, p, &at, &sum[k % 2].of,
            next + N_X, next + 2 * N_X, next, left[k], right[k]);
    }
    return 0;
}
