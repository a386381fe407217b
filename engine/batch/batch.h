/* A batch of runs, as many.c and Python know it. */
#ifndef GUDGEON_BATCH_H
#define GUDGEON_BATCH_H
#include "../scene/calls.h"

enum {
    NOT_YET = 0, UNTRIED = 1, TRIED = 2,  /* of a step: none is wanted yet; what others did of it */
    MISSED = 3                            /* they tried it, and did not find its stages */
};

#define GLANCE 0.02 /* s between two looks at whether the batch is ending */

/* Times of run i, the last of them, and the first row of its samples. */
static inline const double *times_of(const Batch *b, long i) { return b->t + i * b->apart; }
static inline double t_end_of(const Batch *b, long i) { return times_of(b, i)[b->wanted[i] - 1]; }
static inline long rows_of(const Batch *b, long i) { return b->place[i] * b->samples; }

/* A joint's latch (closed: 0 or 1), the sides of events: what the kernels and rk4 remember. */
typedef struct {
    double closed, deltadot_minus;
#if LAW_STATES
    double state[LAW_STATES];
#endif
} MovingLatch;

/* What is carried from one step of rk4 to the next, of one run; of several side by side: LaneRun of lanes.h. */
#define Number double
#define Flag long long
typedef struct {
#include "moving.h"
    struct {
        MovingLatch latch[AT_LEAST_ONE(N_CLEARANCES)];
        double event_side[AT_LEAST_ONE(N_USER_EVENTS)];
    } memory;
} Moving;
#undef Number
#undef Flag

/* What one run does by itself, for those who move several at once. */
typedef struct {
    int (*begin)(const Batch *b, long i, const long *others, int n, void *run); /* others: beside it, -1: none */
    int (*steps)(const Batch *b, long i, long limit, void *run);
    void (*samples)(const Batch *b, long i, const Moving *before, void *run); /* of a step that is made */
    void (*end)(const Batch *b, long i, int status, void *run);
    void (*give)(const void *run, Moving *state);
    void (*take)(void *run, const Moving *state);
    int (*jumps)(const Batch *b, long i, double t0, double t1); /* whether a drive's rate does so between two times */
    int (*goes_on)(const Batch *b, long i, int tried, void *run); /* to its next step: GOES_ON, LISTS or RUN_OVER */
    long (*unseen)(const void *run); /* steps that it may make before it looks at its pace; 0 where each is told of */
} Single;

#endif
