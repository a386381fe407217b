/*
 * Curves through points: cubic splines, whose tables are in the scene's curves.c, with their derivatives, bounds and
 * switching points. Outside its range a curve is NaN; within rounding of the range the last piece continues.
 */
#ifndef GUDGEON_CURVES_H
#define GUDGEON_CURVES_H

/* A curve of `pieces` cubic polynomials; repeats: whether it is periodic. */
typedef struct {
    int pieces, repeats;
    const double *x;      /* where they begin, and where the last one ends */
    const double (*c)[4]; /* of each: y = c0 + h (c1 + h (c2 + h c3)), h from its beginning */
} Curve;

static const double CURVE_MARGIN = 1e-9; /* of the range */

/* Return the index of the piece that contains x, or of the outermost one. */
static inline int curve_piece(const Curve *f, double x)
{
    int low = 0, high = f->pieces;
    while (high - low > 1) {
        const int middle = low + (high - low) / 2;
        if (x < f->x[middle])
            high = middle;
        else
            low = middle;
    }
    return low;
}

/* Return the derivative of order 0 ... 3 of a piece at h from its beginning. */
static inline double curve_in_piece(const double *c, int order, double h)
{
    switch (order) {
    case 0:
        return c[0] + h * (c[1] + h * (c[2] + h * c[3]));
    case 1:
        return c[1] + h * (2.0 * c[2] + h * (3.0 * c[3]));
    case 2:
        return 2.0 * c[2] + h * (6.0 * c[3]);
    default:
        return 6.0 * c[3];
    }
}

/* Return x reduced to the range of a periodic curve. */
static inline double curve_turned(const Curve *f, double x)
{
    const double first = f->x[0], length = f->x[f->pieces] - first;
    return f->repeats ? x - length * floor((x - first) / length) : x;
}

/* Return the branch of a piece: alternating 1 and -1. */
static inline double curve_branch(int piece) { return piece % 2 ? -1.0 : 1.0; }

/*
 * Return a curve (order 0) or its derivative of order 1 to 3 at x. On a frozen branch, a piece of the other branch is
 * replaced by the polynomial of its nearer neighbour.
 */
static inline double curve_at(const Curve *f, int order, double x, double branch)
{
    const double first = f->x[0], last = f->x[f->pieces], allowance = CURVE_MARGIN * (last - first);
    x = curve_turned(f, x);
    if (!(x >= first - allowance && x <= last + allowance))
        return NAN;
    int k = curve_piece(f, x);
    double from = f->x[k];
    if (branch * curve_branch(k) < 0.0 && x - from < f->x[k + 1] - x) {
        from = k > 0 ? f->x[k - 1] : f->repeats ? f->x[f->pieces - 1] - (last - first) : from;
        k = k > 0 ? k - 1 : f->repeats ? f->pieces - 1 : k;
    } else if (branch * curve_branch(k) < 0.0 && (k + 1 < f->pieces || f->repeats)) {
        from = f->x[k + 1];
        k = k + 1 < f->pieces ? k + 1 : 0;
    }
    return curve_in_piece(f->c[k], order, x - from);
}

/*
 * Return a function whose zeros are the knots between pieces; its sign is the branch of the piece, its slope there is 1
 * over the length.
 */
static inline double knots_at(const Curve *f, double x)
{
    x = curve_turned(f, x);
    const int k = curve_piece(f, x), begins = k > 0 || f->repeats, ends = k + 1 < f->pieces || f->repeats;
    const double length = f->x[k + 1] - f->x[k];
    return curve_branch(k) * (begins ? (x - f->x[k]) / length : 1.0) * (ends ? (f->x[k + 1] - x) / length : 1.0);
}

#define curve(which, order, x) curve_at(&curves[which], order, x, 0.0)
#define curve_on(which, order, x, branch) curve_at(&curves[which], order, x, branch)
#define knots(which, x) knots_at(&curves[which], x)

#ifdef GUDGEON_LANES_H
/* Return curve_at() of each lane. */
static inline Lanes lanes_curve_at(const Curve *f, int order, Lanes x, Lanes branch)
{
    Lanes y = {0.0};
    for (int k = 0; k < LANES; k++)
        y[k] = curve_at(f, order, x[k], branch[k]);
    return y;
}

/* Return knots_at() of each lane. */
static inline Lanes lanes_knots_at(const Curve *f, Lanes x)
{
    Lanes y = {0.0};
    for (int k = 0; k < LANES; k++)
        y[k] = knots_at(f, x[k]);
    return y;
}

#define lanes_knots(which, x) lanes_knots_at(&curves[which], x)
#define lanes_curve(which, order, x) lanes_curve_at(&curves[which], order, x, all_of(0.0))
#define lanes_curve_on(which, order, x, branch) lanes_curve_at(&curves[which], order, x, branch)
#endif

#ifdef GUDGEON_RANGES_H
/* Extend the bounds least, most by a derivative of a piece at h. */
static inline void curve_take(const double *c, int order, double h, double *least, double *most)
{
    const double y = curve_in_piece(c, order, h);
    *least = min_of(*least, y);
    *most = max_of(*most, y);
}

/*
 * Extend the bounds by a derivative of a piece between two locations, measured from its beginning, and its extrema
 * between.
 */
static inline void curve_bounds_in(const double *c, int order, double from, double to, double *least, double *most)
{
    double turns[2] = {from, from};
    if (order == 0) {
        const double inner = c[2] * c[2] - 3.0 * c[1] * c[3], root = inner > 0.0 ? sqrt(inner) : 0.0;
        const double q = -(c[2] + (c[2] < 0.0 ? -root : root)); /* no digits are lost */
        turns[0] = q / (3.0 * c[3]);
        turns[1] = c[1] / q;
    } else if (order == 1)
        turns[0] = -c[2] / (3.0 * c[3]);
    curve_take(c, order, from, least, most);
    curve_take(c, order, to, least, most);
    for (int i = 0; i < 2; i++)
        if (turns[i] > from && turns[i] < to)
            curve_take(c, order, turns[i], least, most);
}

/*
 * Extend the bounds by a curve from lo to hi within its range. On a frozen branch only its pieces count, each up to
 * half of its neighbours.
 */
static inline void curve_bounds(
    const Curve *f, int order, double branch, double lo, double hi, double *least, double *most)
{
    const int end = f->pieces, middle = branch != 0.0;
    const int first = curve_piece(f, lo) - middle, last = curve_piece(f, hi) + middle;
    for (int i = first; i <= last; i++) {
        const int k = i < 0 ? end - 1 : i >= end ? 0 : i;
        const double shift = i < 0 ? f->x[0] - f->x[end] : i >= end ? f->x[end] - f->x[0] : 0.0;
        if ((k != i && !f->repeats) || branch * curve_branch(k) < 0.0)
            continue;
        const double begin = f->x[k] + shift, finish = f->x[k + 1] + shift, width = middle ? finish - begin : 0.0;
        const double below = k > 0 ? f->x[k] - f->x[k - 1] : f->x[end] - f->x[end - 1];
        const double above = k + 1 < end ? f->x[k + 2] - f->x[k + 1] : f->x[1] - f->x[0];
        const int open_below = k == 0 && !f->repeats, open_above = k == end - 1 && !f->repeats;
        const double from = open_below ? lo : max_of(lo, begin - (width > 0.0 ? 0.5 * below : 0.0));
        const double to = open_above ? hi : min_of(hi, finish + (width > 0.0 ? 0.5 * above : 0.0));
        if (from <= to)
            curve_bounds_in(f->c[k], order, from - begin, to - begin, least, most);
    }
}

/* Compute the bounds of a curve from lo to hi, which may exceed a period. */
static inline void curve_span(
    const Curve *f, int order, double branch, double lo, double hi, double *least, double *most)
{
    const double first = f->x[0], last = f->x[f->pieces], length = last - first;
    const double turns = f->repeats ? length * floor((lo - first) / length) : 0.0;
    *least = INFINITY;
    *most = -INFINITY;
    if (!f->repeats)
        curve_bounds(f, order, branch, lo, hi, least, most);
    else if (!(hi - lo < length))
        curve_bounds(f, order, branch, first, last, least, most);
    else {
        curve_bounds(f, order, branch, lo - turns, min_of(hi - turns, last), least, most);
        if (hi - turns > last)
            curve_bounds(f, order, branch, first, hi - turns - length, least, most);
    }
}

/* Return the part of x within the range of a curve; empty if there is none. */
static inline Range curve_range(const Curve *f, Range x)
{
    const double first = f->x[0], last = f->x[f->pieces], allowance = CURVE_MARGIN * (last - first);
    if (is_empty(x) || f->repeats)
        return x;
    if (!(x.hi >= first - allowance && x.lo <= last + allowance))
        return only(NAN);
    x.partly |= x.lo < first - allowance || x.hi > last + allowance;
    x.lo = max_of(x.lo, first - allowance);
    x.hi = min_of(x.hi, last + allowance);
    return x;
}

/* Return bounds of curve_at() and of its slope. */
static inline Range range_curve_at(const Curve *f, int order, Range x, Range branch)
{
    const double held = branch.lo == branch.hi ? branch.lo : 0.0;
    double lo, hi, least, most;
    x = curve_range(f, x);
    if (is_empty(x))
        return x;
    curve_span(f, order, held, x.lo, x.hi, &lo, &hi);
    if (order < 3)
        curve_span(f, order + 1, held, x.lo, x.hi, &least, &most);
    else
        most = lo < hi ? INFINITY : 0.0, least = -most;
    return lo <= hi ? apply_chain_rule(x, lo, hi, least, most) : range_curve_at(f, order, x, only(0.0));
}

/* Return bounds of knots_at(), a parabola in each piece. */
static inline Range range_knots_at(const Curve *f, Range x)
{
    const double first = f->x[0], last = f->x[f->pieces];
    const double turn = f->repeats ? (last - first) * floor((x.lo - first) / (last - first)) : 0.0;
    double lo = INFINITY, hi = -INFINITY, least = INFINITY, most = -INFINITY;
    if (is_empty(x))
        return x;
    if (f->repeats && !(x.hi - x.lo < last - first))
        return (Range){-1.0, 1.0, -INFINITY, INFINITY, x.partly};
    for (int i = curve_piece(f, x.lo - turn);; i++) {
        const int k = i % f->pieces;
        const double begin = f->x[k] + turn + (i >= f->pieces ? last - first : 0.0), length = f->x[k + 1] - f->x[k];
        const int begins = k > 0 || f->repeats, ends = k + 1 < f->pieces || f->repeats;
        const int highest = i >= 2 * f->pieces - 1 || (i + 1 >= f->pieces && !f->repeats);
        const double from = (max_of(x.lo, i == 0 ? x.lo : begin) - begin) / length;
        const double to = (highest ? x.hi - begin : min_of(x.hi - begin, length)) / length;
        const double c[4] = {begins ? 0.0 : 1.0, begins && ends ? 1.0 : begins ? 1.0 : ends ? -1.0 : 0.0,
            begins && ends ? -1.0 : 0.0, 0.0};
        const double branch = curve_branch(k), piece[4] = {branch * c[0], branch * c[1], branch * c[2], 0.0};
        const double slope[4] = {piece[1] / length, 2.0 * piece[2] / length, 0.0, 0.0};
        if (from <= to) {
            curve_bounds_in(piece, 0, from, to, &lo, &hi);
            curve_bounds_in(slope, 0, from, to, &least, &most);
        }
        if (highest || begin + length >= x.hi)
            break;
    }
    return apply_chain_rule(x, lo, hi, least, most);
}

#define range_curve(which, order, x) range_curve_at(&curves[which], order, x, only(0.0))
#define range_curve_on(which, order, x, branch) range_curve_at(&curves[which], order, x, branch)
#define range_knots(which, x) range_knots_at(&curves[which], x)
#endif

#endif
