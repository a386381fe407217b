/*
 * Coefficients of the Taylor series of a motion. At each order, the sums over lower orders of all products are computed
 * first, because they are independent of each other. The rest of an order is linear (functions derived for the scene).
 * For one run, a SeriesRow is a register of products, and the derived functions fill a SeriesWide. In lanes, both are
 * one product of several runs.
 */
#define SERIES_APART __attribute__((noinline)) /* the address of thread-local memory is found once, not at each order */

enum {
    SERIES_PAIR = 2 * sizeof(SeriesRow), /* products are processed in independent pairs */
    SERIES_WHOLE = SERIES_PAIR > sizeof(SeriesWide) ? SERIES_PAIR : sizeof(SeriesWide),
    SERIES_ROWS = (TAYLOR * sizeof(Real) + SERIES_WHOLE - 1) / SERIES_WHOLE * (SERIES_WHOLE / sizeof(SeriesRow))
};

/* The sums of all products, as the derived functions and as the loops read them. */
typedef union {
    TaylorFactors of;
    SeriesRow row[SERIES_ROWS];
} SeriesSums;

/*
 * Compute of every product left_1 right_{k-1} + ... + left_{k-1} right_1 (sum), and of order k + 1 all terms but left_1
 * right_k and left_k right_1 (next).
 */
SERIES_APART static void series_sums(int k, SeriesRow (*left)[SERIES_ROWS], SeriesRow (*right)[SERIES_ROWS],
    SeriesRow *sum, SeriesRow *next)
{
    for (int i = 0; i < SERIES_ROWS; i += 2) {
        SeriesRow before = right[k - 1][i], now = left[1][i] * before, then = {0.0};
        SeriesRow before_b = right[k - 1][i + 1], now_b = left[1][i + 1] * before_b, then_b = {0.0};
        for (int j = 2; j < k; j++) {
            const SeriesRow factor = left[j][i], factor_b = left[j][i + 1];
            then += factor * before;
            then_b += factor_b * before_b;
            before = right[k - j][i];
            before_b = right[k - j][i + 1];
            now += factor * before;
            now_b += factor_b * before_b;
        }
        sum[i] = now, sum[i + 1] = now_b;
        next[i] = then, next[i + 1] = then_b;
    }
}

/* Add the two terms of order k that series_sums() left out. */
SERIES_APART static void series_rest(int k, SeriesRow (*left)[SERIES_ROWS], SeriesRow (*right)[SERIES_ROWS],
    SeriesRow *sum)
{
    for (int i = 0; i < SERIES_ROWS; i++)
        sum[i] += left[1][i] * right[k - 1][i] + left[k - 1][i] * right[1][i];
}

/* Compute c[k], k = 2 ... order, from c[0], the accelerations and powers in c[1], and the values `at` of order 0. */
SERIES_APART static void series_orders(const ParametersOf *p, const TaylorValues *at, int order, Real (*c)[TAYLOR_Y],
    SeriesRow (*left)[SERIES_ROWS], SeriesRow (*right)[SERIES_ROWS])
{
    SeriesSums sum[2] = {0};
    for (int i = 0; i < N_X; i++)
        c[1][i] = c[0][N_X + i];
    for (int k = 1; k < order; k++) {
        Real *next = c[k + 1];
        if (k % 2 == 0)
            series_sums(k, left, right, sum[0].row, sum[1].row);
        else if (k > 1)
            series_rest(k, left, right, sum[1].row);
        for (int i = 0; i < N_X; i++)
            next[i] = c[k][N_X + i] * real_of(1.0 / (k + 1));
        taylor_terms(real_of(k), real_of(1.0 / k), real_of(1.0 / (k + 1)), real_of(k == 1 ? 1.0 : 0.0), c[k],
            c[k] + N_X, p, at, &sum[k % 2].of, next + N_X, next + 2 * N_X, (SeriesWide *)left[k],
            (SeriesWide *)right[k]);
    }
}

/* Return the thread-local memory for the factors of all products. */
static SeriesRow (*series_factors(void))[TAYLOR_ORDERS][SERIES_ROWS]
{
    static _Thread_local SeriesRow factors[2][TAYLOR_ORDERS][SERIES_ROWS];
    return factors;
}
