/* Cancellation of a long computation by its caller, and the monitor of its progress. */
#ifndef GUDGEON_CANCELLATION_H
#define GUDGEON_CANCELLATION_H

enum { MONITOR_STEPS = 32768, N_DOUBLINGS = 4, GROWTH_DOUBLINGS = 2 };

/* Time gained (s) by the last doublings of the number of steps, and the number of steps of the next check. */
typedef struct {
    double t, gain[N_DOUBLINGS];
    long next;
} Doubling;

/*
 * The monitor of a run's progress: time gained by the last MONITOR_STEPS steps, sum and number of gains while the run
 * advanced, and number of successive checks without progress.
 */
typedef struct {
    double t, gain, gain_sum; /* s: start of these steps; gain of the last ones; sum of good gains */
    long steps, n_gains; /* n_gains: number of good gains */
    /* number of successive slow checks; 1: far slower than before, GROWTH_DOUBLINGS: exponential growth, else 0 */
    int n_slow_checks, slowdown;
    Doubling doubling;
} ProgressMonitor;

double read_clock(void);
void start_polling(Cancellation *cancellation, int (*is_stop_requested)(void *), void *context, double poll_interval);
void skip_first_poll(Cancellation *cancellation);
int detect_stall(ProgressMonitor *monitor, double t, double t_end);
long count_steps_before_check(const ProgressMonitor *monitor);

/*
 * Defer requests to stop: is_cancelled() and poll_cancellation() return 0 until allow_stop(). Called before a step is
 * committed.
 */
static inline void defer_stop(Cancellation *cancellation) { cancellation->is_deferred = 1; }

/* End the deferral of defer_stop(): from now on a request to stop, also one that was deferred, is obeyed. */
static inline void allow_stop(Cancellation *cancellation) { cancellation->is_deferred = 0; }

/*
 * Count one right-hand side and return whether the computation must stop. The caller's function is polled
 * (poll_cancellation()) only after `poll_after` right-hand sides; in between the result is 0. Called at each right-hand
 * side.
 */
static inline int is_cancelled(Cancellation *cancellation)
{
    return ++cancellation->count > cancellation->poll_after && poll_cancellation(cancellation);
}

#endif
