/*
 * Coefficients of the Taylor series of a motion. At each order the sums over lower orders of all products are made
 * first, side by side, for they need nothing of each other; what is left of an order is linear (taylor.c of the scene).
 */
enum { TAYLOR_WIDE = 8, TAYLOR_ROWS = (TAYLOR + TAYLOR_WIDE - 1) / TAYLOR_WIDE };
typedef double Wide __attribute__((vector_size(8 * TAYLOR_WIDE)));

typedef union {
    TaylorFactors of;
    Wide row[TAYLOR_ROWS];
} TaylorRow;

/* Of every product: left_1 right_{k-1} + ... + left_{k-1} right_1, two sums, of odd and of even terms. */
static void taylor_sums(int k, const TaylorRow *left, const TaylorRow *right, TaylorRow *sum)
{
    for (int i = 0; i < TAYLOR_ROWS; i++) {
        Wide odd = {0.0}, even = {0.0};
        int j = 1;
        for (; j + 1 < k; j += 2) {
            odd += left[j].row[i] * right[k - j].row[i];
            even += left[j + 1].row[i] * right[k - j - 1].row[i];
        }
        if (j < k)
            odd += left[j].row[i] * right[k - j].row[i];
        sum->row[i] = odd + even;
    }
}

/*
 * c[k], k = 0 ... order: coefficients of what is integrated in powers of time from t on, where it is y. Returns 0, or
 * the number of the pivot that vanished.
 */
int taylor_series(double t, const double *y, const Parameters *p, int order, double (*c)[N_Y])
{
    static _Thread_local TaylorRow left[TAYLOR_ORDERS], right[TAYLOR_ORDERS];
    TaylorRow sum;
    TaylorValues at;
    double rate[N_X], power[N_WORK];
    for (int i = 0; i < N_Y; i++)
        c[0][i] = y[i];
    const int status = taylor_values(t, y, y + N_X, p, &at, rate, power);
    if (status)
        return status;
    for (int k = 0; k < order; k++) {
        const double share = 1.0 / (k + 1);
        if (k > 0) {
            const double of_time = k == 1 ? 1.0 : 0.0;
            taylor_sums(k, left, right, &sum);
            taylor_terms(k, 1.0 / k, of_time, c[k], c[k] + N_X, p, &at, &sum.of, rate, power, &left[k].of,
                &right[k].of);
        }
        for (int i = 0; i < N_X; i++) {
            c[k + 1][i] = share * c[k][N_X + i];
            c[k + 1][N_X + i] = share * rate[i];
        }
        for (int i = 0; i < N_WORK; i++)
            c[k + 1][2 * N_X + i] = share * power[i];
    }
    return 0;
}
