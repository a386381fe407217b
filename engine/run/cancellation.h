/*
 * Whom a long computation asks (Cancellation), and its pace: whether it advances at all (cancellation.c).
 */
#ifndef GUDGEON_CANCELLATION_H
#define GUDGEON_CANCELLATION_H

enum { MONITOR_STEPS = 32768, DOUBLINGS = 4, GROWTH_DOUBLINGS = 2 };

/* What doubling the number of steps gained the last times (s), and the number at which it is looked at next. */
typedef struct {
    double t, gain[DOUBLINGS];
    long next;
} Doubling;

/*
 * The pace of a run: what MONITOR_STEPS of its steps gain, what they gained on the average while it advanced, and how
 * often in a row it did not.
 */
typedef struct {
    double t, gain, sum; /* s: where these steps began; what the last ones gained, and the good ones together */
    long steps, good;
    /* how often in a row it was too slow; whether far slower than it was before, or GROWTH_DOUBLINGS */
    int slow, crawls;
    Doubling doubling;
} ProgressMonitor;

double seconds_now(void);
void start_cancellation(Cancellation *x, int (*ask)(void *), void *caller, double every);
int has_stalled(ProgressMonitor *x, double t, double t_end);
long steps_before_check(const ProgressMonitor *x);

/* What is under way comes to its end before a request to stop counts; from now on it counts at once. */
static inline void defer_stop(Cancellation *x) { x->hold = 1; }
static inline void allow_stop(Cancellation *x) { x->hold = 0; }

/* Once each right-hand side: whether to give up. */
static inline int given_up(Cancellation *x) { return ++x->count > x->poll_after && poll_cancellation(x); }

#endif
