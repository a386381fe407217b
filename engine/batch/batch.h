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

/*
 * Limits within which a step needs no action of its run, so that the lanes may accept it (batch/lane_local_steps.c). A
 * type argument gives the same limits for one run (double) or for several (vectors).
 *   power              of the method: exponent of the step-size control
 *   limiting_h_rho     of the method: h rho at which stability limits the steps
 *   unstable           h rho above which a step is rejected
 *   min_rho, max_rho   h rho below or above which a step speaks against its method
 *   max_opposing       number of such steps at which the method changes
 *   max_length         s: longest step whose error need not be measured
 *   max_ratio          largest ratio of the lengths of two successive steps that are not measured
 *   film_error         relative error of film forces that is the limit inside a step
 *   peak_ratio         ratio of a stage's force to those at both ends that shows a maximum
 *   residual           m, rad: largest residual |Phi| that leaves the audit as it is
 *   gap, clearance     m, of each joint with play: error of the dense output of its gap; its radial clearance
 */
#define STEP_LIMITS(Number) \
    Number power, limiting_h_rho, unstable, min_rho, max_rho, max_opposing, max_length, max_ratio, film_error, \
        peak_ratio, residual, gap[AT_LEAST_ONE(N_CLEARANCES)], clearance[AT_LEAST_ONE(N_CLEARANCES)];

/* Limits of the steps of one run that lanes accept, and their largest number until the run needs a call. */
typedef struct {
    struct {
        STEP_LIMITS(double)
    } limits;
    long max_steps;
} LocalStepLimits;

/* Functions of a single run, for the time loop of several runs in lanes. */
typedef struct {
    /* begin run i; candidates: n runs under way, -1: none; returns a status */
    int (*begin)(const Batch *batch, long i, const long *candidates, int n, void *run);
    /* advance run i to its next step; returns CALL_AGAIN, BUFFERS_FULL or RUN_ENDED */
    int (*advance_single)(const Batch *batch, long i, int trial_result, void *run);
    /* limits of steps without a call; p: parameters of the run */
    void (*get_local_step_limits)(const void *run, const double *p, LocalStepLimits *limits);
} SingleRunFunctions;

#endif
