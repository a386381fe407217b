/*
 * First guess of a position by the polynomial of fifth order through two positions with two rates each, for one run or
 * for several runs in a vector. It is s + h s' + h^2 s''/2 plus the terms of higher order, which are computed here.
 */
#ifndef GUDGEON_EXTRAPOLATION_H
#define GUDGEON_EXTRAPOLATION_H

/* Coordinate, first and second rate at one time. */
typedef struct {
    Real s, rate, second;
} CoordinateOf;

/*
 * Compute the terms of order 3 to 5 (terms[3]) of the quintic Hermite polynomial P through positions a and b, one
 * interval g (s) apart, at one interval after b. It has the value, first and second rate of b at 0, and those of a at
 * -g.
 */
static inline void compute_higher_terms(Real interval, CoordinateOf a, CoordinateOf b, Real *terms)
{
    const Real g = interval;
    const Real defect = a.s - (b.s - g * (b.rate - 0.5 * g * b.second));
    const Real rate_defect = g * (a.rate - (b.rate - g * b.second));
    const Real second_defect = g * g * (a.second - b.second);
    terms[0] = -(0.5 * second_defect + 4.0 * rate_defect + 10.0 * defect);
    terms[1] = -(second_defect + 7.0 * rate_defect + 15.0 * defect);
    terms[2] = -(0.5 * second_defect + 3.0 * rate_defect + 6.0 * defect);
}

/*
 * Return the sum of the terms of order 3 to 5 at a distance of r intervals from the last position: r^3 (terms[0] + r
 * terms[1] + r^2 terms[2]).
 */
static inline Real sum_higher_terms(Real r, const Real *terms)
{
    return r * r * r * (terms[0] + r * (terms[1] + r * terms[2]));
}

#endif
