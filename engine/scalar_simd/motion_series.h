/*
 * Series of the motion: coordinates of bodies and points with their first and second time derivatives, for one sample
 * or for one sample of each run in a vector. All results compute these series here.
 */
#ifndef GUDGEON_MOTION_SERIES_H
#define GUDGEON_MOTION_SERIES_H

/* Sine and cosine of the angle of a body at a sample; body: index of its x in q, -1: none is known yet. */
typedef struct {
    long body;
    Real sine, cosine;
} DirectionOf;

/* Return the component of a point in the frame of its body: parameter k with a sign; 0 for k < 0. */
static inline Real get_point_component(const ParametersOf *p, long k, double sign)
{
    return k < 0 ? make_real(0.0) : sign * ((const Real *)p)[k];
}

/*
 * Return a series (coordinate of a body or point, or its first or second time derivative) at a sample. q, v, a:
 * position, velocity and acceleration (x, y, angle) of its body; v is read from order 1 on, a in order 2. A point of a
 * body has r_P = r + A(theta) s, a point of the ground r_P = s, constant in every order. direction: cached direction of
 * the last body, updated; begin each sample with body = -1.
 */
static inline Real evaluate_motion_series(const MotionSeries *series, const Real *q, const Real *v, const Real *a,
    const ParametersOf *p, DirectionOf *direction)
{
    const int axis = series->axis;
    if (series->body >= 0 && series->x < 0 && series->y < 0)
        return (series->order == 0 ? q : series->order == 1 ? v : a)[axis];
    const Real x = get_point_component(p, series->x, series->sign_x);
    const Real y = get_point_component(p, series->y, series->sign_y);
    if (series->body < 0)
        return axis ? y : x;
    if (direction->body != series->body)
        compute_sine_and_cosine(q[2], &direction->sine, &direction->cosine);
    direction->body = series->body;
    const Real arm_x = direction->cosine * x - direction->sine * y;
    const Real arm_y = direction->sine * x + direction->cosine * y;
    const Real arm = axis ? arm_y : arm_x, derivative = axis ? arm_x : -arm_y; /* d arm / d theta */
    if (series->order == 0)
        return q[axis] + arm;
    if (series->order == 1)
        return v[axis] + v[2] * derivative;
    return a[axis] + a[2] * derivative - v[2] * v[2] * arm;
}

#endif
