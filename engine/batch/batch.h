/* A batch of runs, as many.c and Python know it. */
#ifndef GUDGEON_BATCH_H
#define GUDGEON_BATCH_H
#include "../scene/calls.h"

enum {
    NOT_YET = 0, UNTRIED = 1, TRIED = 2,  /* of a step: none is wanted yet; what others did of it */
    MISSED = 3                            /* they tried it, and did not find its stages */
};

#define POLL_INTERVAL_S 0.02 /* s between two looks at whether the batch is ending */

/* Times of run i, the last of them, and the first row of its samples. */
static inline const double *times_of(const Batch *b, long i) { return b->t + i * b->apart; }
static inline double t_end_of(const Batch *b, long i) { return times_of(b, i)[b->wanted[i] - 1]; }
static inline long rows_of(const Batch *b, long i) { return b->place[i] * b->samples; }

/* What one run does by itself, for those who move several at once. */
typedef struct {
    int (*begin)(const Batch *b, long i, const long *others, int n, void *run); /* others: beside it, -1: none */
    int (*goes_on)(const Batch *b, long i, int tried, void *run); /* to its next step: GOES_ON, LISTS or RUN_OVER */
    long (*unseen)(const void *run); /* steps that it may make before it looks at its pace; 0 where each is told of */
} Single;

#endif
