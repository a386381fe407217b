/*
 * Recurrences for the coefficients of the Taylor series of a motion, for one run or for several in SIMD lanes. At each
 * order, the sums over lower orders of all products are computed first, because they are independent of each other. The
 * rest of an order is linear (functions derived for the scene). For one run, a SeriesRow is a register of products, and
 * the derived functions fill a SeriesWide. In lanes, both are one product of several runs.
 */
#define SERIES_NOINLINE __attribute__((noinline)) /* the address of thread-local memory is found only once */
#if TAYLOR <= 8
#define SERIES_SUM static inline
#define SERIES_ORDERS __attribute__((noinline, flatten)) static /* the sums of few products stay in registers */
#else
#define SERIES_SUM SERIES_NOINLINE static
#define SERIES_ORDERS SERIES_NOINLINE static
#endif

enum {
    SERIES_WHOLE = sizeof(SeriesRow) > sizeof(SeriesWide) ? sizeof(SeriesRow) : sizeof(SeriesWide),
    SERIES_ROWS = (TAYLOR * sizeof(Real) + SERIES_WHOLE - 1) / SERIES_WHOLE * (SERIES_WHOLE / sizeof(SeriesRow)),
    SERIES_USED = (TAYLOR * sizeof(Real) + sizeof(SeriesRow) - 1) / sizeof(SeriesRow) /* rows with products */
};

/* The sums of all products, as the derived functions and as the loops read them. */
typedef union {
    TaylorFactors of;
    SeriesRow row[SERIES_ROWS];
} SeriesSums;

/*
 * Compute the inner terms of the Cauchy products of all pairs at orders k and k + 1, for even k, from orders below k.
 * sum: left_2 right_{k-2} + ... + left_{k-2} right_2. next_sum: left_2 right_{k-1} + ... + left_{k-1} right_2.
 * add_outer_products() adds the other two terms. Odd and even terms are summed separately, and those of order k - 1
 * come last: the processor computes most of the sums before these are known.
 */
SERIES_SUM void sum_inner_products(int k, SeriesRow (*left)[SERIES_ROWS], SeriesRow (*right)[SERIES_ROWS],
    SeriesRow *sum, SeriesRow *next_sum)
{
    for (int i = 0; i < SERIES_USED; i++) {
        SeriesRow now = {0.0}, now_even = {0.0}, then = {0.0}, then_even = {0.0}, after = right[k - 2][i];
        for (int j = 3; j < k - 2; j += 2) {
            const SeriesRow odd = left[j][i], even = left[j + 1][i], middle = right[k - j][i];
            then += odd * after;
            now += odd * middle;
            then_even += even * middle;
            after = right[k - j - 1][i];
            now_even += even * after;
        }
        if (k > 2) {
            now_even += left[2][i] * right[k - 2][i];
            then += left[k - 1][i] * right[2][i];
            then_even += left[2][i] * right[k - 1][i];
        }
        sum[i] = now + now_even;
        next_sum[i] = then + then_even;
    }
}

/*
 * Add the outer terms left_1 right_{k-1} and left_{k-1} right_1 of the Cauchy products to each sum of order k, which
 * sum_inner_products() left out. For k = 2 they are one term.
 */
SERIES_SUM void add_outer_products(int k, SeriesRow (*left)[SERIES_ROWS], SeriesRow (*right)[SERIES_ROWS],
    SeriesRow *sum)
{
    for (int i = 0; i < SERIES_USED; i++)
        sum[i] = (k > 2 ? sum[i] + left[k - 1][i] * right[1][i] : sum[i]) + left[1][i] * right[k - 1][i];
}

/*
 * Compute the series coefficients c[k + 1] of the state from those of order k, and the factors of order k. sum: of the
 * products of order k without their outer terms, which are added. Other arguments as in compute_series_orders().
 */
static void compute_series_order(int k, const ParametersOf *p, const TaylorValues *values, Real (*c)[TAYLOR_Y],
    SeriesRow (*left)[SERIES_ROWS], SeriesRow (*right)[SERIES_ROWS], SeriesSums *sum)
{
    Real *next = c[k + 1];
    if (k > 1)
        add_outer_products(k, left, right, sum->row);
    for (int i = 0; i < N_X; i++)
        next[i] = c[k][N_X + i] * make_real(1.0 / (k + 1));
    taylor_terms(make_real(k), make_real(1.0 / k), make_real(1.0 / (k + 1)), make_real(k == 1 ? 1.0 : 0.0), c[k],
        c[k] + N_X, p, values, &sum->of, next + N_X, next + 2 * N_X, (SeriesWide *)left[k], (SeriesWide *)right[k]);
}

/*
 * Compute the series coefficients c[k] of the state for k = 2 ... order, one order after the other. c[0], and
 * accelerations and powers in c[1], must be set; `values`: values of order 0 of all functions. left, right: memory for
 * the factors of all products.
 */
SERIES_ORDERS void compute_series_orders(const ParametersOf *p, const TaylorValues *values, int order,
    Real (*c)[TAYLOR_Y], SeriesRow (*left)[SERIES_ROWS], SeriesRow (*right)[SERIES_ROWS])
{
    SeriesSums sum = {0}, next_sum = {0};
    for (int i = 0; i < N_X; i++)
        c[1][i] = c[0][N_X + i];
    if (order > 1)
        compute_series_order(1, p, values, c, left, right, &sum);
    for (int k = 2; k < order; k += 2) {
        sum_inner_products(k, left, right, sum.row, next_sum.row);
        compute_series_order(k, p, values, c, left, right, &sum);
        if (k + 1 < order)
            compute_series_order(k + 1, p, values, c, left, right, &next_sum);
    }
}

/* Return the thread-local memory for the left and right factors of all products at all orders: [0] left, [1] right. */
static SeriesRow (*get_series_factors(void))[TAYLOR_ORDERS][SERIES_ROWS]
{
    static _Thread_local SeriesRow factors[2][TAYLOR_ORDERS][SERIES_ROWS];
    SeriesRow (*volatile address)[TAYLOR_ORDERS][SERIES_ROWS] = factors; /* else each function would find it anew */
    return address;
}
