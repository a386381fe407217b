/* Steps of the computation of sine, logarithm, exponential and power (functions.h), for a number or a SIMD vector. */
/*
 * Reduce an angle x (rad) to r in [-pi/4, pi/4]: x = k pi/2 + r + error, where *error is the rounding error of r.
 * Return the last two bits of k, the quadrant.
 */
static inline PARTS_BITS PARTS_NAMED(quarters)(PARTS_OF x, PARTS_OF *r, PARTS_OF *error)
{
    const double shift = 6755399441055744.0;
    const PARTS_OF shifted = x * 0.63661977236758134308 + shift, quadrant = shifted - shift;
    const PARTS_OF first = x - quadrant * 1.57079632673412561417, part = quadrant * 6.07710050630396597660e-11,
        second = first - part;
    const PARTS_OF last = quadrant * 2.02226624879595063154e-21;
    *r = second - last;
    *error = second - *r - last + (first - second - part);
    return PARTS_NAMED(bits_of)(shifted) & 3;
}

/* Return sin(r + error) for |r| <= pi/4 and its rounding error, by fdlibm's polynomial. */
static inline PARTS_OF PARTS_NAMED(sine_near)(PARTS_OF r, PARTS_OF error)
{
    const PARTS_OF z = r * r, cube = z * r;
    const PARTS_OF high = 8.33333333332248946124e-03 + z * (-1.98412698298579493134e-04
        + z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)));
    return r - (z * (0.5 * error - cube * high) - error - cube * -1.66666666666666324348e-01);
}

/* Return cos(r + error) for |r| <= pi/4 and its rounding error, by fdlibm's polynomial. */
static inline PARTS_OF PARTS_NAMED(cosine_near)(PARTS_OF r, PARTS_OF error)
{
    const PARTS_OF z = r * r, half = 0.5 * z, less = 1.0 - half;
    const PARTS_OF high = z * (4.16666666666666019037e-02 + z * (-1.38888888888741095749e-03
        + z * (2.48015872894767294178e-05 + z * (-2.75573143513906633035e-07 + z * (2.08757232129817482790e-09
        + z * -1.13596475577881948265e-11)))));
    return less + (1.0 - less - half + (z * high - r * error));
}

/* Return x rounded to 26 bits of its significand: products of two such numbers are exact. */
static inline PARTS_OF PARTS_NAMED(upper_half)(PARTS_OF x)
{
    return PARTS_NAMED(of_bits)((PARTS_NAMED(bits_of)(x) + 0x4000000u) & 0xfffffffff8000000u);
}

/* Return x^(3/2) from x and its square root, with a correction of the rounding errors of root and product. */
static inline PARTS_OF PARTS_NAMED(three_halves)(PARTS_OF x, PARTS_OF root)
{
    const PARTS_OF x_high = PARTS_NAMED(upper_half)(x), x_low = x - x_high, product = x * root;
    const PARTS_OF s_high = PARTS_NAMED(upper_half)(root), s_low = root - s_high;
    const PARTS_OF left = x - s_high * s_high - 2.0 * s_high * s_low - s_low * s_low;
    return product + (x_high * s_high - product + x_high * s_low + x_low * s_high + x_low * s_low + 0.5 * root * left);
}

/* Return ln x of a normal positive x; *error: the rounding error of the result, to be added. */
static inline PARTS_OF PARTS_NAMED(log_in_parts)(PARTS_OF x, PARTS_OF *error)
{
    const PARTS_BITS x_bits = PARTS_NAMED(bits_of)(x), bits = x_bits - 0x3fe6100000000000u;
    const PARTS_OF c = PARTS_ENTRY(log_table, bits >> 45, 0), less = PARTS_ENTRY(log_table, bits >> 45, 1);
    const PARTS_OF least = PARTS_ENTRY(log_table, bits >> 45, 2), k = PARTS_POWER(bits);
    const PARTS_OF z = PARTS_NAMED(of_bits)(x_bits - (bits & 0xfff0000000000000u));
    const PARTS_OF z_high = PARTS_NAMED(upper_half)(z);
    const PARTS_OF r_high = z_high * c - 1.0, r_low = (z - z_high) * c, r = r_high + r_low;
    const PARTS_OF r_rest = r_high - r + r_low;
    const PARTS_OF sum = k * 0x1.62e42fefa38p-1 + less, near = sum + r;
    const PARTS_OF r_top = PARTS_NAMED(upper_half)(r_high); /* its square is exact */
    const PARTS_OF r_bottom = r_high - r_top + r_low;
    const PARTS_OF half = -0.5 * r, square = r * half, half_top = -0.5 * r_top, square_top = r_top * half_top;
    const PARTS_OF high = near + square_top;
    const PARTS_OF series = r * square * (-2.0 / 3.0 + r * 0.5
        + square * (0.8 + r * (-2.0 / 3.0) + square * (-8.0 / 7.0 + r)));
    const PARTS_OF low = k * 0x1.ef35793c7673p-45 + least + (sum - near + r) + r_rest + r_bottom * (half + half_top)
        + (near - high + square_top) + series;
    *error = high - (high + low) + low;
    return high + low;
}

/* Return exp(x + error) for |x| < 700 and a small error of x. */
static inline PARTS_OF PARTS_NAMED(exp_of_parts)(PARTS_OF x, PARTS_OF error)
{
    const double shift = 6755399441055744.0;
    const PARTS_OF shifted = x * 0x1.71547652b82fep7 + shift, k = shifted - shift;
    const PARTS_OF r = x - k * 0x1.62e42fefcp-8 + k * 0x1.c610ca86c3899p-44 + error, square = r * r;
    const PARTS_BITS whole = PARTS_NAMED(bits_of)(shifted), ahead = whole >> 7 << 52;
    const PARTS_BITS table_bits = PARTS_NAMED(bits_of)(PARTS_ENTRY(exp_table, whole, 0));
    const PARTS_OF power = PARTS_NAMED(of_bits)(table_bits + ahead);
    const PARTS_OF less = PARTS_ENTRY(exp_table, whole, 1) + r + square * (0.5 + r * (1.0 / 6.0))
        + square * square * (1.0 / 24.0 + r * (1.0 / 120.0));
    return power + power * less;
}

/* Return log2 x of a normal positive number to 1e-4, for step-size control. */
static inline PARTS_OF PARTS_NAMED(rough_log2)(PARTS_OF x)
{
    const PARTS_BITS x_bits = PARTS_NAMED(bits_of)(x),
        bits = x_bits - 0x3fe6a09e00000000u; /* z from 1/sqrt 2 to sqrt 2 */
    const PARTS_OF z = PARTS_NAMED(of_bits)(x_bits - (bits & 0xfff0000000000000u)), s = (z - 1.0) / (z + 1.0);
    return PARTS_POWER(bits) + s * (2.8853900817779268 + s * s * 0.9617966939259756);
}

/* Return 2^x to 1e-4, for step-size control; x within the range of exponents. */
static inline PARTS_OF PARTS_NAMED(rough_exp2)(PARTS_OF x)
{
    const double shift = 6755399441055744.0;
    const PARTS_OF shifted = x + shift, r = x - (shifted - shift);
    const PARTS_OF part = 1.0 + r * (0.6931471805599453 + r * (0.2402265069591007 + r * (0.0555041086648216
        + r * 0.0096181291076285)));
    return PARTS_NAMED(of_bits)(PARTS_NAMED(bits_of)(part) + (PARTS_NAMED(bits_of)(shifted) << 52));
}
