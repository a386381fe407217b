/*
 * Curves through points: cubic splines, whose tables are in the scene's curves.c, with their derivatives, bounds and
 * switching points. Outside its range a curve is NaN; within rounding of the range the last piece continues.
 */
#ifndef GUDGEON_CURVES_H
#define GUDGEON_CURVES_H

/* A curve of `pieces` cubic polynomials; is_periodic: whether x repeats after its range. */
typedef struct {
    int pieces, is_periodic;
    const double *x;      /* where they begin, and where the last one ends */
    const double (*c)[4]; /* of each: y = c0 + h (c1 + h (c2 + h c3)), h from its beginning */
} Curve;

static const double CURVE_MARGIN = 1e-9; /* of the range */

/*
 * Return the index of the piece of a curve that contains x, by bisection; the first or last piece for x outside of the
 * range.
 */
static inline int find_curve_piece(const Curve *curve_table, double x)
{
    int low = 0, high = curve_table->pieces;
    while (high - low > 1) {
        const int middle = low + (high - low) / 2;
        if (x < curve_table->x[middle])
            high = middle;
        else
            low = middle;
    }
    return low;
}

/* Return the value (order 0) or the derivative of order 1 to 3 of one cubic piece at an offset from its beginning. */
static inline double evaluate_curve_piece(const double *coefficients, int order, double offset)
{
    switch (order) {
    case 0:
        return coefficients[0] + offset * (coefficients[1] + offset * (coefficients[2] + offset * coefficients[3]));
    case 1:
        return coefficients[1] + offset * (2.0 * coefficients[2] + offset * (3.0 * coefficients[3]));
    case 2:
        return 2.0 * coefficients[2] + offset * (6.0 * coefficients[3]);
    default:
        return 6.0 * coefficients[3];
    }
}

/* Return x moved by whole periods into the range of a periodic curve; other curves return x. */
static inline double reduce_to_period(const Curve *curve_table, double x)
{
    const double first = curve_table->x[0], length = curve_table->x[curve_table->pieces] - first;
    return curve_table->is_periodic ? x - length * floor((x - first) / length) : x;
}

/* Return the branch of a piece: alternating 1 and -1. */
static inline double get_piece_branch(int piece) { return piece % 2 ? -1.0 : 1.0; }

/*
 * Return a curve (order 0) or its derivative of order 1 to 3 at x. A periodic curve is evaluated at x reduced by whole
 * periods, and its first and last pieces are neighbours. Another curve is NAN outside of its range by more than
 * CURVE_MARGIN. branch: 0, or a frozen branch (1 or -1). A piece of the other branch is then replaced by the polynomial
 * of its nearer neighbour, if there is one.
 */
static inline double evaluate_curve(const Curve *curve_table, int order, double x, double branch)
{
    const double first = curve_table->x[0], last = curve_table->x[curve_table->pieces],
        allowance = CURVE_MARGIN * (last - first);
    x = reduce_to_period(curve_table, x);
    if (!(x >= first - allowance && x <= last + allowance))
        return NAN;
    int piece = find_curve_piece(curve_table, x);
    double begin = curve_table->x[piece];
    if (branch * get_piece_branch(piece) < 0.0 && x - begin < curve_table->x[piece + 1] - x) {
        begin = piece > 0 ? curve_table->x[piece - 1] : curve_table->is_periodic
            ? curve_table->x[curve_table->pieces - 1] - (last - first) : begin;
        piece = piece > 0 ? piece - 1 : curve_table->is_periodic ? curve_table->pieces - 1 : piece;
    } else if (branch * get_piece_branch(piece) < 0.0
        && (piece + 1 < curve_table->pieces || curve_table->is_periodic)) {
        begin = curve_table->x[piece + 1];
        piece = piece + 1 < curve_table->pieces ? piece + 1 : 0;
    }
    return evaluate_curve_piece(curve_table->c[piece], order, x - begin);
}

/*
 * Return the switching function of the knots of a curve at x: +-(x - x_k) (x_{k+1} - x)/L^2, a parabola in each piece k
 * of length L. Its zeros are the knots between pieces, its sign is the branch of the piece, and its slope at a knot is
 * 1/L. The factor of an end that does not repeat is left out.
 */
static inline double evaluate_knot_switch(const Curve *curve_table, double x)
{
    x = reduce_to_period(curve_table, x);
    const int piece = find_curve_piece(curve_table, x);
    const int has_left_knot = piece > 0 || curve_table->is_periodic;
    const int has_right_knot = piece + 1 < curve_table->pieces || curve_table->is_periodic;
    const double length = curve_table->x[piece + 1] - curve_table->x[piece];
    return get_piece_branch(piece) * (has_left_knot ? (x - curve_table->x[piece]) / length : 1.0)
        * (has_right_knot ? (curve_table->x[piece + 1] - x) / length : 1.0);
}

#define curve(which, order, x) evaluate_curve(&curves[which], order, x, 0.0)
#define curve_on(which, order, x, branch) evaluate_curve(&curves[which], order, x, branch)
#define knots(which, x) evaluate_knot_switch(&curves[which], x)

#ifdef GUDGEON_LANES_H
/*
 * Return a curve, or its derivative of an order (0, 1, ...), at x in each lane, as evaluate_curve(). branch: the frozen
 * branch of the piece, 0: not frozen.
 */
static inline Lanes evaluate_curve_in_lanes(const Curve *curve_table, int order, Lanes x, Lanes branch)
{
    Lanes y = {0.0};
    for (int k = 0; k < LANES; k++)
        y[k] = evaluate_curve(curve_table, order, x[k], branch[k]);
    return y;
}

/*
 * Return the switching function of the knots of a curve at x in each lane, as evaluate_knot_switch(): 0 at a knot
 * between two pieces, with a sign that alternates from piece to piece.
 */
static inline Lanes evaluate_knot_switch_in_lanes(const Curve *curve_table, Lanes x)
{
    Lanes y = {0.0};
    for (int k = 0; k < LANES; k++)
        y[k] = evaluate_knot_switch(curve_table, x[k]);
    return y;
}

#define lanes_knots(which, x) evaluate_knot_switch_in_lanes(&curves[which], x)
#define lanes_curve(which, order, x) evaluate_curve_in_lanes(&curves[which], order, x, broadcast(0.0))
#define lanes_curve_on(which, order, x, branch) evaluate_curve_in_lanes(&curves[which], order, x, branch)
#endif

#ifdef GUDGEON_RANGES_H
/* Extend the bounds *lower, *upper by the derivative of an order of one piece at an offset from its beginning. */
static inline void extend_bounds_by_value(const double *coefficients, int order, double offset, double *lower,
    double *upper)
{
    const double y = evaluate_curve_piece(coefficients, order, offset);
    *lower = min_of(*lower, y);
    *upper = max_of(*upper, y);
}

/*
 * Extend the bounds *lower, *upper by the derivative of an order of one cubic piece between two offsets `begin` and
 * `end` from its beginning: its values at both and its local extrema between.
 */
static inline void extend_bounds_in_piece(const double *coefficients, int order, double begin, double end,
    double *lower,
    double *upper)
{
    double extrema[2] = {begin, begin};
    if (order == 0) {
        const double inner = coefficients[2] * coefficients[2] - 3.0 * coefficients[1] * coefficients[3],
            root = inner > 0.0 ? sqrt(inner) : 0.0;
        const double q = -(coefficients[2] + (coefficients[2] < 0.0 ? -root : root)); /* no digits are lost */
        extrema[0] = q / (3.0 * coefficients[3]);
        extrema[1] = coefficients[1] / q;
    } else if (order == 1)
        extrema[0] = -coefficients[2] / (3.0 * coefficients[3]);
    extend_bounds_by_value(coefficients, order, begin, lower, upper);
    extend_bounds_by_value(coefficients, order, end, lower, upper);
    for (int i = 0; i < 2; i++)
        if (extrema[i] > begin && extrema[i] < end)
            extend_bounds_by_value(coefficients, order, extrema[i], lower, upper);
}

/*
 * Extend the bounds *lower, *upper by a curve or its derivative (order) from x_lower to x_upper, within its range. On a
 * frozen branch (1 or -1) only the pieces of that branch count, each extended to the middle of its neighbours; branch
 * 0: all pieces.
 */
static inline void extend_bounds_by_curve(
    const Curve *curve_table, int order, double branch, double x_lower, double x_upper, double *lower, double *upper)
{
    const int end = curve_table->pieces, middle = branch != 0.0;
    const int first = find_curve_piece(curve_table, x_lower) - middle,
        last = find_curve_piece(curve_table, x_upper) + middle;
    for (int i = first; i <= last; i++) {
        const int k = i < 0 ? end - 1 : i >= end ? 0 : i;
        const double shift = i < 0 ? curve_table->x[0] - curve_table->x[end] : i >= end
            ? curve_table->x[end] - curve_table->x[0] : 0.0;
        if ((k != i && !curve_table->is_periodic) || branch * get_piece_branch(k) < 0.0)
            continue;
        const double begin = curve_table->x[k] + shift, finish = curve_table->x[k + 1] + shift, width = middle
            ? finish - begin : 0.0;
        const double length_before = k > 0 ? curve_table->x[k] - curve_table->x[k - 1]
            : curve_table->x[end] - curve_table->x[end - 1];
        const double length_after = k + 1 < end ? curve_table->x[k + 2] - curve_table->x[k + 1]
            : curve_table->x[1] - curve_table->x[0];
        const int open_below = k == 0 && !curve_table->is_periodic;
        const int open_above = k == end - 1 && !curve_table->is_periodic;
        const double from = open_below ? x_lower : max_of(x_lower, begin - (width > 0.0 ? 0.5 * length_before : 0.0));
        const double to = open_above ? x_upper : min_of(x_upper, finish + (width > 0.0 ? 0.5 * length_after : 0.0));
        if (from <= to)
            extend_bounds_in_piece(curve_table->c[k], order, from - begin, to - begin, lower, upper);
    }
}

/*
 * Compute the bounds *lower, *upper of a curve or its derivative from x_lower to x_upper, which may exceed a period of
 * a periodic curve. If no piece of the branch is in the interval, lower > upper.
 */
static inline void compute_curve_bounds(
    const Curve *curve_table, int order, double branch, double x_lower, double x_upper, double *lower, double *upper)
{
    const double first = curve_table->x[0], last = curve_table->x[curve_table->pieces], length = last - first;
    const double period_offset = curve_table->is_periodic ? length * floor((x_lower - first) / length) : 0.0;
    *lower = INFINITY;
    *upper = -INFINITY;
    if (!curve_table->is_periodic)
        extend_bounds_by_curve(curve_table, order, branch, x_lower, x_upper, lower, upper);
    else if (!(x_upper - x_lower < length))
        extend_bounds_by_curve(curve_table, order, branch, first, last, lower, upper);
    else {
        extend_bounds_by_curve(curve_table, order, branch, x_lower - period_offset,
            min_of(x_upper - period_offset, last), lower, upper);
        if (x_upper - period_offset > last)
            extend_bounds_by_curve(curve_table, order, branch, first, x_upper - period_offset - length, lower, upper);
    }
}

/*
 * Return the part of x within the range of a curve, extended at both ends by CURVE_MARGIN of its length: all of x for a
 * periodic curve, empty if there is none. The result may be undefined if x exceeds the extended range.
 */
static inline Interval restrict_to_curve_range(const Curve *curve_table, Interval x)
{
    const double first = curve_table->x[0], last = curve_table->x[curve_table->pieces],
        allowance = CURVE_MARGIN * (last - first);
    if (is_empty(x) || curve_table->is_periodic)
        return x;
    if (!(x.hi >= first - allowance && x.lo <= last + allowance))
        return make_interval(NAN);
    x.may_be_undefined |= x.lo < first - allowance || x.hi > last + allowance;
    x.lo = max_of(x.lo, first - allowance);
    x.hi = min_of(x.hi, last + allowance);
    return x;
}

/*
 * Return bounds of evaluate_curve(curve_table, order, x, branch), the derivative of an order (0 ... 3) of a curve, and
 * of its slope along the step, by the chain rule with the slope of x. A branch that is not constant counts as 0.
 * Outside of the range it is empty, or may be undefined if x is partly outside. If no piece of the branch is in the
 * interval, all pieces count.
 */
static inline Interval bound_curve(const Curve *curve_table, int order, Interval x, Interval branch)
{
    const double frozen = branch.lo == branch.hi ? branch.lo : 0.0;
    double lower, upper, min_slope, max_slope;
    x = restrict_to_curve_range(curve_table, x);
    if (is_empty(x))
        return x;
    compute_curve_bounds(curve_table, order, frozen, x.lo, x.hi, &lower, &upper);
    if (order < 3)
        compute_curve_bounds(curve_table, order + 1, frozen, x.lo, x.hi, &min_slope, &max_slope);
    else
        max_slope = lower < upper ? INFINITY : 0.0, min_slope = -max_slope;
    return lower <= upper ? apply_chain_rule(x, lower, upper, min_slope, max_slope)
        : bound_curve(curve_table, order, x, make_interval(0.0));
}

/*
 * Return bounds of evaluate_knot_switch() and of its slope. This switching function is zero at the knots; in each piece
 * it is a parabola, or a line or constant at an end of the curve, with the sign of the piece's branch. Over a period or
 * more of a periodic curve the bounds are -1 and 1 with unbounded slope. Empty if x is.
 */
static inline Interval bound_knot_switch(const Curve *curve_table, Interval x)
{
    const double first = curve_table->x[0], last = curve_table->x[curve_table->pieces];
    const double shift = curve_table->is_periodic ? (last - first) * floor((x.lo - first) / (last - first)) : 0.0;
    double lower = INFINITY, upper = -INFINITY, min_slope = INFINITY, max_slope = -INFINITY;
    if (is_empty(x))
        return x;
    if (curve_table->is_periodic && !(x.hi - x.lo < last - first))
        return (Interval){-1.0, 1.0, -INFINITY, INFINITY, x.may_be_undefined};
    for (int i = find_curve_piece(curve_table, x.lo - shift);; i++) {
        const int k = i % curve_table->pieces;
        const double begin = curve_table->x[k] + shift + (i >= curve_table->pieces ? last - first : 0.0),
            length = curve_table->x[k + 1] - curve_table->x[k];
        const int has_left_knot = k > 0 || curve_table->is_periodic;
        const int has_right_knot = k + 1 < curve_table->pieces || curve_table->is_periodic;
        const int is_last = i >= 2 * curve_table->pieces - 1
            || (i + 1 >= curve_table->pieces && !curve_table->is_periodic);
        const double from = (max_of(x.lo, i == 0 ? x.lo : begin) - begin) / length;
        const double to = (is_last ? x.hi - begin : min_of(x.hi - begin, length)) / length;
        const double c[4] = {has_left_knot ? 0.0 : 1.0,
            has_left_knot && has_right_knot ? 1.0 : has_left_knot ? 1.0 : has_right_knot ? -1.0 : 0.0,
            has_left_knot && has_right_knot ? -1.0 : 0.0, 0.0};
        const double branch = get_piece_branch(k), piece[4] = {branch * c[0], branch * c[1], branch * c[2], 0.0};
        const double slope[4] = {piece[1] / length, 2.0 * piece[2] / length, 0.0, 0.0};
        if (from <= to) {
            extend_bounds_in_piece(piece, 0, from, to, &lower, &upper);
            extend_bounds_in_piece(slope, 0, from, to, &min_slope, &max_slope);
        }
        if (is_last || begin + length >= x.hi)
            break;
    }
    return apply_chain_rule(x, lower, upper, min_slope, max_slope);
}

#define interval_curve(which, order, x) bound_curve(&curves[which], order, x, make_interval(0.0))
#define interval_curve_on(which, order, x, branch) bound_curve(&curves[which], order, x, branch)
#define interval_knots(which, x) bound_knot_switch(&curves[which], x)
#endif

#endif
