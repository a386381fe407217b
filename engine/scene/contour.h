/*
 * A contour: how much deeper than its circle a bearing is, from depths at equal angles over the circumference, the
 * first at 0. Between neighbours lies the polynomial of degree five that has at both their depths, slopes and second
 * derivatives, these as central differences: periodic, with a continuous second derivative, and its mean is theirs.
 */
#ifndef GUDGEON_CONTOUR_H
#define GUDGEON_CONTOUR_H

/* A derivative by the angle (rad): order 0, 1 or 2. */
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
