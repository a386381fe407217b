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
int poll_cancellation(Cancellation *token)
{
    token->count = 0;
    if (!token->ask)
        token->poll_after = LONG_MAX;
    if (token->ask && !token->stop) {
        const double now = seconds_now(), since = now - token->last;
        token->last = now;
        if (since < 0.1 * token->every)
            token->poll_after = token->poll_after < MAX_POLL_AFTER / 2 ? 2 * token->poll_after + 1 : MAX_POLL_AFTER;
        else if (since > 0.5 * token->every)
            token->poll_after = (token->poll_after + 1) / 2;
        if (now >= token->next || since < 0.0) {
            token->stop = token->ask(token->caller) != 0;
            token->last = seconds_now();
            token->next = token->last + token->every;
        }
    }
    if (token->stop)
        token->poll_after = 0;
    return token->stop && !token->hold;
}

/* Start polling `ask(caller)` every `every` seconds; ask NULL: never. */
void start_polling(Cancellation *token, int (*ask)(void *), void *caller, double every)
{
    *token = (Cancellation){.ask = ask, .caller = caller, .every = every};
}

/* Return the number of steps left until t_end at the gain of the last steps. */
static double count_remaining_steps(const ProgressMonitor *monitor, double t, double t_end)
{
    return (t_end - t) / monitor->gain * MONITOR_STEPS;
}

/*
 * Return whether steps shrink so fast that the end is never reached, as where a drive grows exponentially: doubling the
 * number of steps gains no more time than a doubling DOUBLINGS ago. The extrapolated number of steps must exceed
 * MAX_STEPS_LEFT.
 */
static int is_growing_exponentially(ProgressMonitor *monitor, double t, double t_end)
{
    Doubling *doubling = &monitor->doubling;
    const double gain = t - doubling->t, steps = (double)monitor->steps, earlier = doubling->gain[0];
    if (monitor->steps < doubling->next)
        return 0;
    doubling->t = t;
    for (int k = 1; k < DOUBLINGS; k++)
        doubling->gain[k - 1] = doubling->gain[k];
    doubling->gain[DOUBLINGS - 1] = gain;
    doubling->next = doubling->next ? 2 * monitor->steps : 1024;
    /* steps have not become longer again */
    const int slows = monitor->gain * steps <= 2.0 * gain * MONITOR_STEPS;
    return steps >= MIN_DOUBLED_STEPS && gain <= earlier && slows && steps * exp2((t_end - t) / gain) > MAX_STEPS_LEFT;
}

/*
 * Return, once at the end of each step, whether the run no longer advances. Short steps that become longer again are
 * given time: a fast motion may decay.
 */
int has_stalled(ProgressMonitor *monitor, double t, double t_end)
{
    const long before_it = monitor->steps++;
    if (is_growing_exponentially(monitor, t, t_end)) {
        monitor->crawls = GROWTH_DOUBLINGS;
        return 1;
    }
    if (before_it % MONITOR_STEPS)
        return 0;
    const double before = monitor->gain;
    monitor->gain = monitor->steps > 1 ? t - monitor->t : INFINITY;
    monitor->t = t;
    if (monitor->steps == 1)
        return 0;
    const double left = count_remaining_steps(monitor, t, t_end);
    monitor->crawls =
        left > MAX_STEPS_LEFT_SLOW && monitor->gain * (double)monitor->good < MIN_GAIN_RATIO * monitor->sum;
    if (left > MAX_STEPS_LEFT || monitor->crawls) {
        monitor->slow = monitor->gain > 1.1 * before ? 0 : monitor->slow + 1;
    } else {
        monitor->slow = 0;
        monitor->sum += monitor->gain;
        monitor->good++;
    }
    return monitor->slow >= MAX_SLOW_CHECKS;
}

/* Return how many of the next calls of has_stalled() only count. */
long steps_before_check(const ProgressMonitor *monitor)
{
    const long to_doubling = monitor->doubling.next - monitor->steps - 1;
    const long to_monitoring = monitor->steps % MONITOR_STEPS ? MONITOR_STEPS - monitor->steps % MONITOR_STEPS : 0;
    return to_doubling < 0 ? 0 : to_doubling < to_monitoring ? to_doubling : to_monitoring;
}
