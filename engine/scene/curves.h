/*
 * Curves through points: cubic splines, whose tables the scene's curves.c holds. Outside its range a curve is no number;
 * so far beyond as arguments may be by rounding, its last piece goes on.
 */
#ifndef GUDGEON_CURVES_H
#define GUDGEON_CURVES_H

typedef struct {
    int pieces, repeats;
    const double *x;      /* where they begin, and where the last one ends */
    const double (*c)[4]; /* of each: y = c0 + h (c1 + h (c2 + h c3)), h from where it begins */
} Curve;

static const double CURVE_MARGIN = 1e-9; /* of the range */

/* The piece in which x lies, or the outermost one. */
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

/* A derivative within a piece. */
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

/* A curve (order 0) or its first, second or third derivative. */
static inline double curve_at(const Curve *f, int order, double x)
{
    const double first = f->x[0], last = f->x[f->pieces], margin = CURVE_MARGIN * (last - first);
    if (f->repeats)
        x = x - (last - first) * floor((x - first) / (last - first));
    else if (!(x >= first - margin && x <= last + margin))
        return NAN;
    const int k = curve_piece(f, x);
    return curve_in_piece(f->c[k], order, x - f->x[k]);
}

#define curve(which, order, x) curve_at(&curves[which], order, x)

#ifdef GUDGEON_LANES_H
static inline Lanes lanes_curve_at(const Curve *f, int order, Lanes x)
{
    Lanes y = {0.0};
    for (int k = 0; k < LANES; k++)
        y[k] = curve_at(f, order, x[k]);
    return y;
}

#define lanes_curve(which, order, x) lanes_curve_at(&curves[which], order, x)
#endif

#ifdef GUDGEON_RANGES_H
/* Takes in what a derivative is at h. */
static inline void curve_take(const double *c, int order, double h, double *least, double *most)
{
    const double y = curve_in_piece(c, order, h);
    *least = min_of(*least, y);
    *most = max_of(*most, y);
}

/* Takes in what it is from lo to hi within the range: at both ends of a piece, and where its slope vanishes. */
static inline void curve_bounds(const Curve *f, int order, double lo, double hi, double *least, double *most)
{
    for (int k = curve_piece(f, lo); k < f->pieces && (k == 0 || f->x[k] <= hi); k++) {
        const double *c = f->c[k];
        const double from = k == 0 ? lo - f->x[k] : max_of(lo - f->x[k], 0.0);
        const double to = k == f->pieces - 1 ? hi - f->x[k] : min_of(hi, f->x[k + 1]) - f->x[k];
        curve_take(c, order, from, least, most);
        curve_take(c, order, to, least, most);
        if (order == 0) {
            const double inner = c[2] * c[2] - 3.0 * c[1] * c[3], root = inner > 0.0 ? sqrt(inner) : 0.0;
            const double q = -(c[2] + (c[2] < 0.0 ? -root : root)); /* no digits are lost */
            const double one = q / (3.0 * c[3]), other = c[1] / q;
            if (one > from && one < to)
                curve_take(c, order, one, least, most);
            if (other > from && other < to)
                curve_take(c, order, other, least, most);
        } else if (order == 1) {
            const double h = -c[2] / (3.0 * c[3]);
            if (h > from && h < to)
                curve_take(c, order, h, least, most);
        }
    }
}

/* The same of a range that may go round. */
static inline void curve_span(const Curve *f, int order, double lo, double hi, double *least, double *most)
{
    const double first = f->x[0], last = f->x[f->pieces], length = last - first;
    const double turns = f->repeats ? length * floor((lo - first) / length) : 0.0;
    *least = INFINITY;
    *most = -INFINITY;
    if (!f->repeats)
        curve_bounds(f, order, lo, hi, least, most);
    else if (!(hi - lo < length))
        curve_bounds(f, order, first, last, least, most);
    else {
        curve_bounds(f, order, lo - turns, min_of(hi - turns, last), least, most);
        if (hi - turns > last)
            curve_bounds(f, order, first, hi - turns - length, least, most);
    }
}

static inline Range range_curve_at(const Curve *f, int order, Range x)
{
    const double first = f->x[0], last = f->x[f->pieces], margin = CURVE_MARGIN * (last - first);
    double lo, hi, least, most;
    if (is_empty(x) || !(f->repeats || (x.hi >= first - margin && x.lo <= last + margin)))
        return only(NAN);
    if (!f->repeats) {
        x.partly |= x.lo < first - margin || x.hi > last + margin;
        x.lo = max_of(x.lo, first - margin);
        x.hi = min_of(x.hi, last + margin);
    }
    curve_span(f, order, x.lo, x.hi, &lo, &hi);
    if (order < 3)
        curve_span(f, order + 1, x.lo, x.hi, &least, &most);
    else
        most = lo < hi ? INFINITY : 0.0, least = -most;
    return through(x, lo, hi, least, most);
}

#define range_curve(which, order, x) range_curve_at(&curves[which], order, x)
#endif

#endif
