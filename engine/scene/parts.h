/* Text of functions: logarithm and exponential in parts (functions.h), of a number or of several side by side. */
/* x rounded to 26 bits: products of two such numbers are exact, and what is left of 1 - e is as small as e. */
static inline PARTS_OF PARTS_NAMED(upper_half)(PARTS_OF x)
{
    return PARTS_NAMED(of_bits)((PARTS_NAMED(bits_of)(x) + 0x4000000u) & 0xfffffffff8000000u);
}

/* log x, the rest beyond its rounding in `rest`; x is normal and positive. */
static inline PARTS_OF PARTS_NAMED(log_in_parts)(PARTS_OF x, PARTS_OF *rest)
{
    const PARTS_BITS own = PARTS_NAMED(bits_of)(x), bits = own - 0x3fe6100000000000u;
    const PARTS_OF c = PARTS_ENTRY(log_table, bits >> 45, 0), less = PARTS_ENTRY(log_table, bits >> 45, 1);
    const PARTS_OF least = PARTS_ENTRY(log_table, bits >> 45, 2), k = PARTS_POWER(bits);
    const PARTS_OF z = PARTS_NAMED(of_bits)(own - (bits & 0xfff0000000000000u)), z_high = PARTS_NAMED(upper_half)(z);
    const PARTS_OF r_high = z_high * c - 1.0, r_low = (z - z_high) * c, r = r_high + r_low;
    const PARTS_OF r_rest = r_high - r + r_low;
    const PARTS_OF sum = k * 0x1.62e42fefa38p-1 + less, near = sum + r;
    const PARTS_OF r_top = PARTS_NAMED(upper_half)(r_high), r_bottom = r_high - r_top + r_low; /* the square of the first is exact */
    const PARTS_OF half = -0.5 * r, square = r * half, half_top = -0.5 * r_top, square_top = r_top * half_top;
    const PARTS_OF high = near + square_top;
    const PARTS_OF series = r * square * (-2.0 / 3.0 + r * 0.5
        + square * (0.8 + r * (-2.0 / 3.0) + square * (-8.0 / 7.0 + r)));
    const PARTS_OF low = k * 0x1.ef35793c7673p-45 + least + (sum - near + r) + r_rest + r_bottom * (half + half_top)
        + (near - high + square_top) + series;
    *rest = high - (high + low) + low;
    return high + low;
}

/* e^(x + rest) for |x| < 700 and a small rest. */
static inline PARTS_OF PARTS_NAMED(exp_of_parts)(PARTS_OF x, PARTS_OF rest)
{
    const double shift = 6755399441055744.0;
    const PARTS_OF shifted = x * 0x1.71547652b82fep7 + shift, k = shifted - shift;
    const PARTS_OF r = x - k * 0x1.62e42fefcp-8 + k * 0x1.c610ca86c3899p-44 + rest, square = r * r;
    const PARTS_BITS whole = PARTS_NAMED(bits_of)(shifted), ahead = whole >> 7 << 52;
    const PARTS_OF power = PARTS_NAMED(of_bits)(PARTS_NAMED(bits_of)(PARTS_ENTRY(exp_table, whole, 0)) + ahead);
    const PARTS_OF less = PARTS_ENTRY(exp_table, whole, 1) + r + square * (0.5 + r * (1.0 / 6.0))
        + square * square * (1.0 / 24.0 + r * (1.0 / 120.0));
    return power + power * less;
}
