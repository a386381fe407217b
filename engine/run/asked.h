/*
 * Whom a long computation asks (Asked), and its pace: whether it advances at all (asked.c).
 */
#ifndef GUDGEON_ASKED_H
#define GUDGEON_ASKED_H

enum { PACE_STEPS = 32768, DOUBLINGS = 4, OUTRUN = 2 };

/* What doubling the number of steps gained the last times (s), and the number at which it is looked at next. */
typedef struct {
    double t, gain[DOUBLINGS];
    long next;
} Doubling;

/*
 * The pace of a run: what PACE_STEPS of its steps gain, what they gained on the average while it advanced, and how
 * often in a row it did not.
 */
typedef struct {
    double t, gain, sum; /* s: where these steps began; what the last ones gained, and the good ones together */
    long steps, good;
    int slow, crawls;    /* how often in a row it was too slow; whether far slower than it was before, or OUTRUN */
    Doubling doubling;
} Pace;

double seconds_now(void);
void set_asked(Asked *x, int (*ask)(void *), void *whom, double every);
int creeps(Pace *x, double t, double t_end);
long unseen_steps(const Pace *x);

/* What is under way comes to its end before a request to stop counts; from now on it counts at once. */
static inline void defer_stop(Asked *x) { x->hold = 1; }
static inline void allow_stop(Asked *x) { x->hold = 0; }

/* Once each right-hand side: whether to give up. */
static inline int given_up(Asked *x) { return ++x->count > x->look && ask_now(x); }

#endif
