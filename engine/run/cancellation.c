/* Polling of the caller of a long computation, and the test whether time still advances (run/cancellation.h). */
#include "cancellation.h"
#include <time.h>

enum { MAX_POLL_AFTER = 64, MAX_SLOW_CHECKS = 3, MIN_DOUBLED_STEPS = 1 << 18 };
#define MAX_STEPS_LEFT_SLOW 1e8   /* steps left at which a run that became slow is ended */
#define MAX_STEPS_LEFT 1e11  /* steps left at which any run is ended */
#define MIN_GAIN_RATIO 1e-3     /* of the earlier gain per step: slower steps count as slow */

/* Return the present time of the clock, s. */
double seconds_now(void)
{
    struct timespec now;
    timespec_get(&now, TIME_UTC);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/*
 * Ask the caller whether to stop, if the interval has passed, and return whether the computation must stop now. The
 * number of right-hand sides between readings of the clock adapts to their cost.
 */
int poll_cancellation(Cancellation *x)
{
    x->count = 0;
    if (!x->ask)
        x->poll_after = LONG_MAX;
    if (x->ask && !x->stop) {
        const double now = seconds_now(), since = now - x->last;
        x->last = now;
        if (since < 0.1 * x->every)
            x->poll_after = x->poll_after < MAX_POLL_AFTER / 2 ? 2 * x->poll_after + 1 : MAX_POLL_AFTER;
        else if (since > 0.5 * x->every)
            x->poll_after = (x->poll_after + 1) / 2;
        if (now >= x->next || since < 0.0) {
            x->stop = x->ask(x->caller) != 0;
            x->last = seconds_now();
            x->next = x->last + x->every;
        }
    }
    if (x->stop)
        x->poll_after = 0;
    return x->stop && !x->hold;
}

/* Start polling `ask(caller)` every `every` seconds; ask NULL: never. */
void start_cancellation(Cancellation *x, int (*ask)(void *), void *caller, double every)
{
    *x = (Cancellation){.ask = ask, .caller = caller, .every = every};
}

/* Return the number of steps left until t_end at the gain of the last steps. */
static double steps_left(const ProgressMonitor *x, double t, double t_end)
{
    return (t_end - t) / x->gain * MONITOR_STEPS;
}

/*
 * Return whether steps shrink so fast that the end is never reached, as where a drive grows exponentially: doubling the
 * number of steps gains no more time than a doubling DOUBLINGS ago. The extrapolated number of steps must exceed
 * MAX_STEPS_LEFT.
 */
static int grows_exponentially(ProgressMonitor *monitor, double t, double t_end)
{
    Doubling *x = &monitor->doubling;
    const double gain = t - x->t, steps = (double)monitor->steps, earlier = x->gain[0];
    if (monitor->steps < x->next)
        return 0;
    x->t = t;
    for (int k = 1; k < DOUBLINGS; k++)
        x->gain[k - 1] = x->gain[k];
    x->gain[DOUBLINGS - 1] = gain;
    x->next = x->next ? 2 * monitor->steps : 1024;
    /* steps have not become longer again */
    const int slows = monitor->gain * steps <= 2.0 * gain * MONITOR_STEPS;
    return steps >= MIN_DOUBLED_STEPS && gain <= earlier && slows && steps * exp2((t_end - t) / gain) > MAX_STEPS_LEFT;
}

/*
 * Return, once at the end of each step, whether the run no longer advances. Short steps that become longer again are
 * given time: a fast motion may decay.
 */
int has_stalled(ProgressMonitor *x, double t, double t_end)
{
    const long before_it = x->steps++;
    if (grows_exponentially(x, t, t_end)) {
        x->crawls = GROWTH_DOUBLINGS;
        return 1;
    }
    if (before_it % MONITOR_STEPS)
        return 0;
    const double before = x->gain;
    x->gain = x->steps > 1 ? t - x->t : INFINITY;
    x->t = t;
    if (x->steps == 1)
        return 0;
    const double left = steps_left(x, t, t_end);
    x->crawls = left > MAX_STEPS_LEFT_SLOW && x->gain * (double)x->good < MIN_GAIN_RATIO * x->sum;
    if (left > MAX_STEPS_LEFT || x->crawls) {
        x->slow = x->gain > 1.1 * before ? 0 : x->slow + 1;
    } else {
        x->slow = 0;
        x->sum += x->gain;
        x->good++;
    }
    return x->slow >= MAX_SLOW_CHECKS;
}

/* Return how many of the next calls of has_stalled() only count. */
long steps_before_check(const ProgressMonitor *x)
{
    const long to_doubling = x->doubling.next - x->steps - 1;
    const long to_look = x->steps % MONITOR_STEPS ? MONITOR_STEPS - x->steps % MONITOR_STEPS : 0;
    return to_doubling < 0 ? 0 : to_doubling < to_look ? to_doubling : to_look;
}
