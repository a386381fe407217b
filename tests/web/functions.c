/* The functions of engine/scene/functions.h over arrays, for test_functions.py: natively and in Node. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include "engine/scene/functions.h"

enum { POWER, EXPONENTIAL, LOGARITHM, SINE, COSINE, ARCSINE };

void values(int which, long n, const double *x, const double *y, double *out)
{
    for (long i = 0; i < n; i++)
        out[i] = which == POWER ? pow(x[i], y[i])
            : which == EXPONENTIAL ? exp(x[i])
            : which == LOGARITHM ? log(x[i])
            : which == SINE ? sin(x[i])
            : which == COSINE ? cos(x[i])
            : asin(x[i]);
}
