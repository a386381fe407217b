/*
 * What a long computation asks on its way: whether it is still wanted, and whether it advances at all.
 */
#include "cancellation.h"
#include <time.h>

enum { MOST_UNSEEN = 64, MONITOR_TIMES = 3, LEAST_DOUBLED = 1 << 18 };
#define TOO_MANY 1e8   /* steps still to make, beyond which one that crawls is given up */
#define HOPELESS 1e11  /* the same, whatever the pace was before */
#define SHORT_STEP_RATIO 1e-3     /* of the pace before, that is a crawl */

double seconds_now(void)
{
    struct timespec now;
    timespec_get(&now, TIME_UTC);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Reads the clock and asks if a question is due; whether to give up. What costs much is looked at more often. */
int poll_cancellation(Cancellation *x)
{
    x->count = 0;
    if (!x->ask)
        x->poll_after = LONG_MAX;
    if (x->ask && !x->stop) {
        const double now = seconds_now(), since = now - x->last;
        x->last = now;
        if (since < 0.1 * x->every)
            x->poll_after = x->poll_after < MOST_UNSEEN / 2 ? 2 * x->poll_after + 1 : MOST_UNSEEN;
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

void start_cancellation(Cancellation *x, int (*ask)(void *), void *caller, double every)
{
    *x = (Cancellation){.ask = ask, .caller = caller, .every = every};
}

/* How many steps are left at the pace of the last ones. */
static double steps_left(const ProgressMonitor *x, double t, double t_end)
{
    return (t_end - t) / x->gain * MONITOR_STEPS;
}

/*
 * Whether something outruns all steps: where a drive grows at least exponentially, twice as many of them gain no more
 * time than a doubling did some doublings ago (methods may change meanwhile), so that so many doublings are left.
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
    /* its steps do not become longer again meanwhile */
    const int slows = monitor->gain * steps <= 2.0 * gain * MONITOR_STEPS;
    return steps >= LEAST_DOUBLED && gain <= earlier && slows && steps * exp2((t_end - t) / gain) > HOPELESS;
}

/*
 * Once a step, at its end: whether the run no longer advances. Steps that become longer again are given time, however
 * short they are: a fast motion that dies away is no standstill.
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
    x->crawls = left > TOO_MANY && x->gain * (double)x->good < SHORT_STEP_RATIO * x->sum;
    if (left > HOPELESS || x->crawls) {
        x->slow = x->gain > 1.1 * before ? 0 : x->slow + 1;
    } else {
        x->slow = 0;
        x->sum += x->gain;
        x->good++;
    }
    return x->slow >= MONITOR_TIMES;
}

/* How often in a row creeps() will do no more than count. */
long steps_before_check(const ProgressMonitor *x)
{
    const long to_doubling = x->doubling.next - x->steps - 1;
    const long to_look = x->steps % MONITOR_STEPS ? MONITOR_STEPS - x->steps % MONITOR_STEPS : 0;
    return to_doubling < 0 ? 0 : to_doubling < to_look ? to_doubling : to_look;
}
