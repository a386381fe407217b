/* Declaration of the function in C that computes the start of a motion (start.c), for runs without Python. */
#ifndef GUDGEON_START_H
#define GUDGEON_START_H

int compute_start(double t, const double *parameters, double size, double *q, double *v, double *residual,
    Cancellation *cancellation);

#endif
