/*
 * Interface to a batch of runs, and functions of a single run that SIMD code for several runs calls. Struct Batch is
 * declared in scene/calls.h, because Python fills it.
 */
#ifndef GUDGEON_BATCH_H
#define GUDGEON_BATCH_H
#include "../scene/calls.h"

enum {
    NO_TRIAL = 0, NOT_TRIED = 1, TRIED = 2,  /* of a step: none is requested yet; not tried in the lanes; tried there */
    STAGES_FAILED = 3                            /* tried in the lanes, and its stages were not found */
};

#define POLL_INTERVAL_S 0.02 /* s between two polls whether the batch is ending */

/* Return the first of the sample times of run i, s. */
static inline const double *get_sample_times(const Batch *batch, long i) { return batch->t + i * batch->time_stride; }
/* Return the last of the sample times of run i, s. */
static inline double get_end_time(const Batch *batch, long i)
{
    return get_sample_times(batch, i)[batch->n_requested[i] - 1];
}
/* Return the row of the batch's arrays of samples at which those of run i begin. */
static inline long get_first_row(const Batch *batch, long i) { return batch->sample_block[i] * batch->samples; }

/* Functions of a single run, for the time loop of several runs in lanes. */
typedef struct {
    /* begin run i; candidates: n runs under way, -1: none; returns a status */
    int (*begin)(const Batch *batch, long i, const long *candidates, int n, void *run);
    /* advance run i to its next step; returns GOES_ON, LISTS or RUN_OVER */
    int (*advance_single)(const Batch *batch, long i, int trial_result, void *run);
    long (*max_local_steps)(const void *run); /* steps before its next check of progress; 0: each is reported */
} SingleRunFunctions;

#endif
