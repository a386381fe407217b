/*
 * The contour of a non-circular bearing: depths beyond its circle, m, at equal angles, the first at 0. Between
 * neighbours it is the polynomial of degree five (quintic Hermite spline) with their depths, slopes and second
 * derivatives, which are central differences. It is periodic with a continuous second derivative, and keeps the mean.
 */
#ifndef GUDGEON_CONTOUR_H
#define GUDGEON_CONTOUR_H

/*
 * Return the depth of a bearing contour in m at an angle (rad), or its derivative by the angle of order 1 or 2, by
 * quintic Hermite interpolation. depths: `count` depths at equal angles, the first at 0; they repeat after a turn. NAN
 * if the angle is not finite.
 */
static inline double evaluate_contour(const double *depths, int count, int order, double angle)
{
    const double turns = angle / (2.0 * PI), position = count * (turns - floor(turns)), per_angle = count / (2.0 * PI);
    if (!(position >= 0.0 && position <= count))
        return NAN;
    const int piece = position < count ? (int)position : count - 1, next = piece + 1 < count ? piece + 1 : 0;
    const double a = depths[piece > 0 ? piece - 1 : count - 1], b = depths[piece], c = depths[next];
    const double d = depths[next + 1 < count ? next + 1 : 0];
    const double s = position - piece, slope = 0.5 * (c - a), bend = (a - b) + (c - b), jump = 3.0 * (c - b) + (a - d);
    switch (order) {
    case 0:
        return b + s * (slope + s * (0.5 * bend + s * jump * (1.5 + s * (s - 2.5))));
    case 1:
        return per_angle * (slope + s * (bend + s * jump * (4.5 + s * (5.0 * s - 10.0))));
    default:
        return per_angle * per_angle * (bend + s * jump * (9.0 + s * (20.0 * s - 30.0)));
    }
}

#endif
