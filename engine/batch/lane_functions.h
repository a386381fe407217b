/* Elementary functions of SIMD vectors; each lane gives the result of the function for one number. */
#ifndef GUDGEON_LANE_FUNCTIONS_H
#define GUDGEON_LANE_FUNCTIONS_H
#include "../scene/function_table.h"

/* Maximum or minimum of two numbers; a NaN in x is propagated, and of two equal ones the result is x. */
#if defined(__GNUC__) && !defined(__clang__) && defined(__AVX512F__)
#define EXTREME_OF(name, beyond) (Lanes)__builtin_ia32_##name##pd512_mask(y, x, x, (char)-1, 4)
#elif defined(__GNUC__) && !defined(__clang__) && defined(__AVX__)
#define EXTREME_OF(name, beyond) (Lanes)__builtin_ia32_##name##pd256(y, x)
#elif defined(__GNUC__) && !defined(__clang__) && defined(__SSE2__)
#define EXTREME_OF(name, beyond) (Lanes)__builtin_ia32_##name##pd(y, x)
#else
#define EXTREME_OF(name, beyond) select_value(x beyond y, y, x)
#endif
/* Return the maximum of two numbers in each lane, as max_of(). */
static inline Lanes lanes_max_of(Lanes x, Lanes y) { return EXTREME_OF(max, <); }
/* Return the minimum of two numbers in each lane, as min_of(). */
static inline Lanes lanes_min_of(Lanes x, Lanes y) { return EXTREME_OF(min, >); }
#undef EXTREME_OF
/* Return the sign of each lane as sign_of(): 1, -1, or x itself for zero and NaN. */
static inline Lanes lanes_sign_of(Lanes x)
{
    return select_value(x > 0.0, broadcast(1.0), select_value(x < 0.0, broadcast(-1.0), x));
}
/* Return the absolute value of each lane. */
static inline Lanes lanes_fabs(Lanes x) { return (Lanes)((LaneBits)x & 0x7fffffffffffffffLL); }

/* Return a mod b of each lane by floored division, as mod_of(): 0 or with the sign of b, and |result| <= |b|. */
static inline Lanes lanes_mod_of(Lanes a, Lanes b)
{
    for (int k = 0; k < LANES; k++)
        a[k] = mod_of(a[k], b[k]);
    return a;
}
/*
 * Return mod(a, b) on a frozen branch of each lane, as mod_on_branch(): the even (1) or odd (-1) periods continued by
 * half a period; 0: not frozen.
 */
static inline Lanes lanes_mod_on_branch(Lanes a, Lanes b, Lanes branch)
{
    for (int k = 0; k < LANES; k++)
        a[k] = mod_on_branch(a[k], b[k], branch[k]);
    return a;
}
/*
 * Return the switching function of mod(a, b) of each lane, as mod_switching_function(): zero at the multiples of b,
 * positive in even and negative in odd periods.
 */
static inline Lanes lanes_mod_switching_function(Lanes a, Lanes b)
{
    for (int k = 0; k < LANES; k++)
        a[k] = mod_switching_function(a[k], b[k]);
    return a;
}

/* Return a point slightly larger than x in each lane, for a difference quotient, as slightly_above(). */
static inline Lanes lanes_slightly_above(Lanes x) { return x + 1e-9 * (1.0 + lanes_fabs(x)); }
/* Return a point slightly smaller than x in each lane, for a difference quotient, as slightly_below(). */
static inline Lanes lanes_slightly_below(Lanes x) { return x - 1e-9 * (1.0 + lanes_fabs(x)); }
/*
 * Return the derivative of each lane if it is finite, else the difference quotient (value_after - value_before) /
 * distance, as finite_slope().
 */
static inline Lanes lanes_finite_slope(Lanes derivative, Lanes value_after, Lanes value_before, Lanes distance)
{
    return select_value(lanes_fabs(derivative) < INFINITY, derivative, (value_after - value_before) / distance);
}

/* Return the square root of each lane, by a vector instruction where there is one. */
static inline Lanes lanes_sqrt(Lanes x)
{
#if defined(__GNUC__) && !defined(__clang__) && defined(__AVX512F__)
    return (Lanes)__builtin_ia32_sqrtpd512_mask(x, x, (char)-1, 4);
#elif defined(__GNUC__) && !defined(__clang__) && defined(__AVX__)
    return (Lanes)__builtin_ia32_sqrtpd256(x);
#elif defined(__GNUC__) && !defined(__clang__) && defined(__SSE2__)
    return (Lanes)__builtin_ia32_sqrtpd(x);
#else
    Lanes y;
    for (int k = 0; k < LANES; k++)
        y[k] = sqrt(x[k]);
    return y;
#endif
}

#define LANE_AFTER_LANE(function) \
    static inline Lanes lanes_##function(Lanes x) \
    { \
        Lanes y = {0.0}; \
        for (int k = 0; k < LANES; k++) \
            y[k] = function(x[k]); \
        return y; \
    }
#define LANE_AFTER_LANE_OF_TWO(function) \
    static inline Lanes lanes_##function(Lanes a, Lanes b) \
    { \
        Lanes y = {0.0}; \
        for (int k = 0; k < LANES; k++) \
            y[k] = function(a[k], b[k]); \
        return y; \
    }
LANE_AFTER_LANE_FUNCTIONS(LANE_AFTER_LANE, LANE_AFTER_LANE_OF_TWO)

typedef unsigned long long LaneWords __attribute__((vector_size(8 * LANES)));
/* Return the bits of the number in each lane. */
static inline LaneWords lanes_to_bits(Lanes x) { return (LaneWords)x; }
/* Return the numbers with these bits in each lane. */
static inline Lanes lanes_from_bits(LaneWords bits) { return (Lanes)bits; }
/*
 * Look up a table of `width` columns in each lane (a gather): return the entry of column k in the row whose number is
 * in the last seven bits of the lane.
 */
static inline Lanes lanes_gather_table_entries(const double *table, int width, LaneWords bits, int k)
{
    Lanes result = {0.0};
    for (int lane = 0; lane < LANES; lane++)
        result[lane] = table[(bits[lane] & 127) * (size_t)width + (size_t)k];
    return result;
}
#define NUMBER_TYPE Lanes
#define NUMBER_BITS LaneWords
#define TYPED_NAME(name) lanes_##name
#define EXPONENT_OF(bits) __builtin_convertvector((LaneBits)(bits) >> 52, Lanes)
#define TABLE_ENTRY(table, bits, k) lanes_gather_table_entries(table[0], sizeof table[0] / sizeof(double), bits, k)
#include "../scene/elementary_functions.h"
#undef NUMBER_TYPE
#undef NUMBER_BITS
#undef TYPED_NAME
#undef EXPONENT_OF
#undef TABLE_ENTRY

/* Return sin x of each lane; lanes with |x| beyond TURN_LIMIT are computed by the C library. */
static inline Lanes lanes_sin(Lanes x)
{
    Lanes r, error;
    const LaneBits is_in_range = lanes_fabs(x) < TURN_LIMIT, k = (LaneBits)lanes_reduce_angle(x, &r, &error);
    Lanes result = select_value((k & 1) != 0, lanes_cosine_near_zero(r, error), lanes_sine_near_zero(r, error));
    result = select_value((k & 2) != 0, -result, result);
    for (int i = 0; any_of(~is_in_range) && i < LANES; i++)
        result[i] = is_in_range[i] ? result[i] : sin(x[i]);
    return result;
}

/* Return cos x of each lane; lanes with |x| beyond TURN_LIMIT are computed by the C library. */
static inline Lanes lanes_cos(Lanes x)
{
    Lanes r, error;
    const LaneBits is_in_range = lanes_fabs(x) < TURN_LIMIT, k = (LaneBits)lanes_reduce_angle(x, &r, &error);
    Lanes result = select_value((k & 1) != 0, lanes_sine_near_zero(r, error), lanes_cosine_near_zero(r, error));
    result = select_value(((k + 1) & 2) != 0, -result, result);
    for (int i = 0; any_of(~is_in_range) && i < LANES; i++)
        result[i] = is_in_range[i] ? result[i] : cos(x[i]);
    return result;
}

/* Return the mask of the lanes in which x is positive, finite and not subnormal. */
static inline LaneBits lanes_is_normal(Lanes x) { return (x >= DBL_MIN) & (x <= DBL_MAX); }

/* Return exp x of each lane; lanes with |x| of 700 and more are computed by the C library. */
static inline Lanes lanes_exp(Lanes x)
{
    const LaneBits is_in_range = lanes_fabs(x) < 700.0;
    Lanes result = lanes_exp_with_error(select_value(is_in_range, x, broadcast(0.0)), broadcast(0.0));
    for (int k = 0; any_of(~is_in_range) && k < LANES; k++)
        result[k] = is_in_range[k] ? result[k] : exp(x[k]);
    return result;
}

/* Return ln x of each lane; lanes in which x is not a positive normal number are computed by the C library. */
static inline Lanes lanes_log(Lanes x)
{
    const LaneBits is_in_range = lanes_is_normal(x);
    Lanes error, result = lanes_log_with_error(select_value(is_in_range, x, broadcast(1.0)), &error);
    for (int k = 0; any_of(~is_in_range) && k < LANES; k++)
        result[k] = is_in_range[k] ? result[k] : log(x[k]);
    return result;
}

/*
 * Return x^y of each lane as raise_to_power(): exponents 0.5 and 1.5 by square roots, others by exp(y ln x), arguments
 * out of range by the C library. The result is 0 for x = 0 and y > 0, as in the law of an open contact.
 */
static inline Lanes lanes_pow(Lanes x, Lanes y)
{
    const LaneBits is_zero = ((LaneBits)x == 0) & (y > 0.0); /* as in a law of an open contact */
    const LaneBits normal = lanes_is_normal(x) & (lanes_fabs(y) < 0x1p60);
    const LaneBits is_root = (x > 1e-150) & (x < 1e150) & ((y == 1.5) | (y == 0.5));
    const Lanes root = lanes_sqrt(select_value(is_root, x, broadcast(1.0)));
    const Lanes half_power = select_value(y == 0.5, root, lanes_power_three_halves(x, root));
    const Lanes by_root = select_value(is_zero, broadcast(0.0), half_power);
    if (!any_of(~(is_root | is_zero)))
        return by_root;
    Lanes error;
    const Lanes log_x = lanes_log_with_error(select_value(normal, x, broadcast(1.0)), &error);
    const Lanes x_high = lanes_round_to_26_bits(log_x), y_high = lanes_round_to_26_bits(y), high = y_high * x_high;
    const LaneBits is_in_range = normal & (lanes_fabs(high) < 690.0);
    const Lanes low = (y - y_high) * x_high + y * (log_x - x_high + error);
    const Lanes by_exponential = lanes_exp_with_error(select_value(is_in_range, high, broadcast(0.0)), low);
    Lanes result = select_value(is_root | is_zero, by_root, by_exponential);
    for (int k = 0; any_of(~(is_in_range | is_zero)) && k < LANES; k++)
        result[k] = (is_in_range | is_zero)[k] ? result[k] : pow(x[k], y[k]);
    return result;
}

/*
 * Compute sine and cosine of the angle (rad) in each lane. Lanes with angles beyond TURN_LIMIT are not valid; they are
 * added to the mask `needs_scalar`.
 */
static inline void compute_sines_and_cosines(Lanes angle, Lanes *sine, Lanes *cosine, LaneBits *needs_scalar)
{
#define SINES_OF Lanes
#define SINES_BITS LaneBits
#define BITS_OF(x) ((LaneBits)(x))
#define OF_BITS(x) ((Lanes)(x))
#include "../scene/sines.h"
#undef SINES_OF
#undef SINES_BITS
#undef BITS_OF
#undef OF_BITS
    *needs_scalar |= ~small;
}

#endif
