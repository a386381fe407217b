/*
 * Sine, cosine, logarithm, exponential and power within their ranges (functions.h), for a number or a SIMD vector. The
 * including file defines the type NUMBER_TYPE (double or Lanes), the type of its bits NUMBER_BITS, and
 * TYPED_NAME(name), the name of a function for that type (name or lanes_name). It also defines EXPONENT_OF(bits), the
 * binary exponent, and TABLE_ENTRY(table, bits, k), the entry of column k in the row of the last seven bits.
 */
/*
 * Reduce the argument x (rad, |x| < TURN_LIMIT = 1e5) to r in [-pi/4, pi/4]: x = k pi/2 + r + *error, the rounding
 * error of r. Return the last two bits of k, the quadrant. Larger x lose accuracy: callers use the C library for them.
 */
static inline NUMBER_BITS TYPED_NAME(reduce_angle)(NUMBER_TYPE x, NUMBER_TYPE *r, NUMBER_TYPE *error)
{
    const double shift = 6755399441055744.0;
    const NUMBER_TYPE shifted = x * 0.63661977236758134308 + shift, quadrant = shifted - shift;
    const NUMBER_TYPE first = x - quadrant * 1.57079632673412561417;
    const NUMBER_TYPE second_part = quadrant * 6.07710050630396597660e-11, difference = first - second_part;
    const NUMBER_TYPE last = quadrant * 2.02226624879595063154e-21;
    *r = difference - last;
    *error = difference - *r - last + (first - difference - second_part);
    return TYPED_NAME(to_bits)(shifted) & 3;
}

/* Return sin(r + error), |r| <= pi/4, by fdlibm's polynomial; error: the rounding error of r (reduce_angle()). */
static inline NUMBER_TYPE TYPED_NAME(sine_near_zero)(NUMBER_TYPE r, NUMBER_TYPE error)
{
    const NUMBER_TYPE z = r * r, cube = z * r;
    const NUMBER_TYPE higher_terms = 8.33333333332248946124e-03 + z * (-1.98412698298579493134e-04
        + z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)));
    return r - (z * (0.5 * error - cube * higher_terms) - error - cube * -1.66666666666666324348e-01);
}

/* Return cos(r + error), |r| <= pi/4, by fdlibm's polynomial; error: the rounding error of r (reduce_angle()). */
static inline NUMBER_TYPE TYPED_NAME(cosine_near_zero)(NUMBER_TYPE r, NUMBER_TYPE error)
{
    const NUMBER_TYPE z = r * r, half = 0.5 * z, one_minus_half = 1.0 - half;
    const NUMBER_TYPE higher_terms = z * (4.16666666666666019037e-02 + z * (-1.38888888888741095749e-03
        + z * (2.48015872894767294178e-05 + z * (-2.75573143513906633035e-07 + z * (2.08757232129817482790e-09
        + z * -1.13596475577881948265e-11)))));
    return one_minus_half + (1.0 - one_minus_half - half + (z * higher_terms - r * error));
}

/* Return x rounded to 26 bits of its significand: products of two such numbers are exact. */
static inline NUMBER_TYPE TYPED_NAME(round_to_26_bits)(NUMBER_TYPE x)
{
    return TYPED_NAME(from_bits)((TYPED_NAME(to_bits)(x) + 0x4000000u) & 0xfffffffff8000000u);
}

/*
 * Return x^(3/2) from x and its square root `root`, with a correction of the rounding errors of root and product: x
 * root + root (x - root^2) / 2. Products of halves of 26 bits are exact.
 */
static inline NUMBER_TYPE TYPED_NAME(power_three_halves)(NUMBER_TYPE x, NUMBER_TYPE root)
{
    const NUMBER_TYPE x_high = TYPED_NAME(round_to_26_bits)(x), x_low = x - x_high, product = x * root;
    const NUMBER_TYPE root_high = TYPED_NAME(round_to_26_bits)(root), root_low = root - root_high;
    const NUMBER_TYPE residual = x - root_high * root_high - 2.0 * root_high * root_low - root_low * root_low;
    return product
        + (x_high * root_high - product + x_high * root_low + x_low * root_high + x_low * root_low
            + 0.5 * root * residual);
}

/* Return ln x of a normal positive x; *error: the rounding error of the result, to be added. */
static inline NUMBER_TYPE TYPED_NAME(log_with_error)(NUMBER_TYPE x, NUMBER_TYPE *error)
{
    const NUMBER_BITS x_bits = TYPED_NAME(to_bits)(x), bits = x_bits - 0x3fe6100000000000u;
    const NUMBER_TYPE c = TABLE_ENTRY(log_table, bits >> 45, 0), minus_log_c = TABLE_ENTRY(log_table, bits >> 45, 1);
    const NUMBER_TYPE minus_log_c_rest = TABLE_ENTRY(log_table, bits >> 45, 2), k = EXPONENT_OF(bits);
    const NUMBER_TYPE z = TYPED_NAME(from_bits)(x_bits - (bits & 0xfff0000000000000u));
    const NUMBER_TYPE z_high = TYPED_NAME(round_to_26_bits)(z);
    const NUMBER_TYPE r_high = z_high * c - 1.0, r_low = (z - z_high) * c, r = r_high + r_low;
    const NUMBER_TYPE r_rest = r_high - r + r_low;
    const NUMBER_TYPE sum = k * 0x1.62e42fefa38p-1 + minus_log_c, first_sum = sum + r;
    const NUMBER_TYPE r_top = TYPED_NAME(round_to_26_bits)(r_high); /* its square is exact */
    const NUMBER_TYPE r_bottom = r_high - r_top + r_low;
    const NUMBER_TYPE half = -0.5 * r, square = r * half, half_top = -0.5 * r_top, square_top = r_top * half_top;
    const NUMBER_TYPE high = first_sum + square_top;
    const NUMBER_TYPE series = r * square * (-2.0 / 3.0 + r * 0.5
        + square * (0.8 + r * (-2.0 / 3.0) + square * (-8.0 / 7.0 + r)));
    const NUMBER_TYPE low = k * 0x1.ef35793c7673p-45 + minus_log_c_rest + (sum - first_sum + r) + r_rest
        + r_bottom * (half + half_top) + (first_sum - high + square_top) + series;
    *error = high - (high + low) + low;
    return high + low;
}

/* Return exp(x + error) for |x| < 700 and a small error of x. */
static inline NUMBER_TYPE TYPED_NAME(exp_with_error)(NUMBER_TYPE x, NUMBER_TYPE error)
{
    const double shift = 6755399441055744.0;
    const NUMBER_TYPE shifted = x * 0x1.71547652b82fep7 + shift, k = shifted - shift;
    const NUMBER_TYPE r = x - k * 0x1.62e42fefcp-8 + k * 0x1.c610ca86c3899p-44 + error, square = r * r;
    const NUMBER_BITS index_bits = TYPED_NAME(to_bits)(shifted), exponent_bits = index_bits >> 7 << 52;
    const NUMBER_BITS table_bits = TYPED_NAME(to_bits)(TABLE_ENTRY(exp_table, index_bits, 0));
    const NUMBER_TYPE power = TYPED_NAME(from_bits)(table_bits + exponent_bits);
    const NUMBER_TYPE change = TABLE_ENTRY(exp_table, index_bits, 1) + r + square * (0.5 + r * (1.0 / 6.0))
        + square * square * (1.0 / 24.0 + r * (1.0 / 120.0));
    return power + power * change;
}

/* Return log2 x of a normal positive number to 1e-4, for step-size control. */
static inline NUMBER_TYPE TYPED_NAME(approx_log2)(NUMBER_TYPE x)
{
    const NUMBER_BITS x_bits = TYPED_NAME(to_bits)(x),
        bits = x_bits - 0x3fe6a09e00000000u; /* z from 1/sqrt 2 to sqrt 2 */
    const NUMBER_TYPE z = TYPED_NAME(from_bits)(x_bits - (bits & 0xfff0000000000000u)), s = (z - 1.0) / (z + 1.0);
    return EXPONENT_OF(bits) + s * (2.8853900817779268 + s * s * 0.9617966939259756);
}

/* Return 2^x to 1e-4, for step-size control; x within the range of exponents. */
static inline NUMBER_TYPE TYPED_NAME(approx_exp2)(NUMBER_TYPE x)
{
    const double shift = 6755399441055744.0;
    const NUMBER_TYPE shifted = x + shift, r = x - (shifted - shift);
    const NUMBER_TYPE fraction_power = 1.0 + r * (0.6931471805599453 + r * (0.2402265069591007 + r * (0.0555041086648216
        + r * 0.0096181291076285)));
    const NUMBER_BITS exponent_bits = TYPED_NAME(to_bits)(shifted) << 52;
    return TYPED_NAME(from_bits)(TYPED_NAME(to_bits)(fraction_power) + exponent_bits);
}
