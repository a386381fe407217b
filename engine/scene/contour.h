/*
 * The contour of a non-circular bearing: depths beyond its circle, m, given at equal angles, the first at 0. Between
 * neighbours it is the polynomial of degree five with their depths, slopes and second derivatives, which are central
 * differences. It is periodic with a continuous second derivative, and keeps the mean.
 */
#ifndef GUDGEON_CONTOUR_H
#define GUDGEON_CONTOUR_H

/*
 * Return the depth of a contour at an angle (rad), or its first or second derivative by the angle (order 0, 1, 2). NAN
 * if the angle is not finite.
 */
static inline double contour(const double *depth, int count, int order, double angle)
{
    const double turns = angle / (2.0 * PI), x = count * (turns - floor(turns)), per_angle = count / (2.0 * PI);
    if (!(x >= 0.0 && x <= count))
        return NAN;
    const int k = x < count ? (int)x : count - 1, next = k + 1 < count ? k + 1 : 0;
    const double a = depth[k > 0 ? k - 1 : count - 1], b = depth[k], c = depth[next];
    const double d = depth[next + 1 < count ? next + 1 : 0];
    const double s = x - k, slope = 0.5 * (c - a), bend = (a - b) + (c - b), rest = 3.0 * (c - b) + (a - d);
    switch (order) {
    case 0:
        return b + s * (slope + s * (0.5 * bend + s * rest * (1.5 + s * (s - 2.5))));
    case 1:
        return per_angle * (slope + s * (bend + s * rest * (4.5 + s * (5.0 * s - 10.0))));
    default:
        return per_angle * per_angle * (bend + s * rest * (9.0 + s * (20.0 * s - 30.0)));
    }
}

#endif
