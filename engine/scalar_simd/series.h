/*
 * Recurrences for the coefficients of the Taylor series of a motion, for one run or for several in SIMD lanes. At each
 * order, the sums over lower orders of all products are computed first, because they are independent of each other. The
 * rest of an order is linear (functions derived for the scene). For one run, a SeriesRow is a register of products, and
 * the derived functions fill a SeriesWide. In lanes, both are one product of several runs.
 */
#define SERIES_NOINLINE __attribute__((noinline)) /* the address of thread-local memory is found only once */

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
 * Compute the inner terms of the Cauchy products of all pairs at orders k and k + 1, from orders below k of both
 * factors. sum: left_1 right_{k-1} + ... + left_{k-1} right_1. next_sum: of order k + 1 all terms but left_1 right_k
 * and left_k right_1, which add_outer_products() adds.
 */
SERIES_NOINLINE static void sum_inner_products(int k, SeriesRow (*left)[SERIES_ROWS], SeriesRow (*right)[SERIES_ROWS],
    SeriesRow *sum, SeriesRow *next_sum)
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
        next_sum[i] = then, next_sum[i + 1] = then_b;
    }
}

/*
 * Add to each sum of order k the two terms left_1 right_{k-1} and left_{k-1} right_1 that sum_inner_products() left
 * out.
 */
SERIES_NOINLINE static void add_outer_products(int k, SeriesRow (*left)[SERIES_ROWS], SeriesRow (*right)[SERIES_ROWS],
    SeriesRow *sum)
{
    for (int i = 0; i < SERIES_ROWS; i++)
        sum[i] += left[1][i] * right[k - 1][i] + left[k - 1][i] * right[1][i];
}

/*
 * Compute the series coefficients c[k] of the state for k = 2 ... order, one order after the other. c[0], and
 * accelerations and powers in c[1], must be set; `values`: values of order 0 of all functions. left, right: memory for
 * the factors of all products.
 */
SERIES_NOINLINE static void compute_series_orders(const ParametersOf *p, const TaylorValues *values, int order,
    Real (*c)[TAYLOR_Y], SeriesRow (*left)[SERIES_ROWS], SeriesRow (*right)[SERIES_ROWS])
{
    SeriesSums sum[2] = {0};
    for (int i = 0; i < N_X; i++)
        c[1][i] = c[0][N_X + i];
    for (int k = 1; k < order; k++) {
        Real *next = c[k + 1];
        if (k % 2 == 0)
            sum_inner_products(k, left, right, sum[0].row, sum[1].row);
        else if (k > 1)
            add_outer_products(k, left, right, sum[1].row);
        for (int i = 0; i < N_X; i++)
            next[i] = c[k][N_X + i] * make_real(1.0 / (k + 1));
        taylor_terms(make_real(k), make_real(1.0 / k), make_real(1.0 / (k + 1)), make_real(k == 1 ? 1.0 : 0.0), c[k],
            c[k] + N_X, p, values, &sum[k % 2].of, next + N_X, next + 2 * N_X, (SeriesWide *)left[k],
            (SeriesWide *)right[k]);
    }
}

/* Return the thread-local memory for the left and right factors of all products at all orders. */
static SeriesRow (*get_series_factors(void))[TAYLOR_ORDERS][SERIES_ROWS]
{
    static _Thread_local SeriesRow factors[2][TAYLOR_ORDERS][SERIES_ROWS];
    return factors;
}
