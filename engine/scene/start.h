/* The start in C, for those who begin runs by themselves (start.c tells what it returns). */
#ifndef GUDGEON_START_H
#define GUDGEON_START_H

int close_start(double t, const double *parameters, double size, double *q, double *v, double *residual,
    Cancellation *cancellation);

#endif
