/*
 * Functions of expressions of which C needs nothing but the library's function, its domain and its derivative: written
 * by `make tables` from runtime/language/functions.py.
 */
#ifndef GUDGEON_FUNCTION_TABLE_H
#define GUDGEON_FUNCTION_TABLE_H

/* The library has no vectors of them. */
#define LANE_AFTER_LANE_FUNCTIONS(OF_ONE, OF_TWO) \
    OF_ONE(tan) \
    OF_ONE(asin) \
    OF_ONE(acos) \
    OF_ONE(atan) \
    OF_TWO(atan2) \
    OF_ONE(sinh) \
    OF_ONE(cosh) \
    OF_ONE(tanh) \
    OF_ONE(asinh) \
    OF_ONE(acosh) \
    OF_ONE(atanh)

/*
 * RISING(name, from, to, extremum, slope): a function that rises from `from` to `to`, with its derivative at x. The
 * derivative rises or falls on each side of `extremum`; NAN: on the whole domain.
 */
#define RISING_FUNCTIONS(RISING) \
    RISING(asin, -1.0, 1.0, 0.0, 1.0/sqrt(1.0 - (x * x))) \
    RISING(atan, -INFINITY, INFINITY, 0.0, 1.0/((x * x) + 1.0)) \
    RISING(sinh, -INFINITY, INFINITY, 0.0, cosh(x)) \
    RISING(tanh, -INFINITY, INFINITY, 0.0, 1.0 / pow(cosh(x), 2.0)) \
    RISING(asinh, -INFINITY, INFINITY, 0.0, 1.0/sqrt((x * x) + 1.0)) \
    RISING(acosh, 1.0, INFINITY, NAN, 1.0/sqrt((x * x) - 1.0)) \
    RISING(atanh, -1.0, 1.0, 0.0, 1.0/(1.0 - (x * x)))

#endif
