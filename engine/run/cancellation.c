/* Polling of the cancellation token of a long computation, and the monitor whether time advances (cancellation.h). */
#include "cancellation.h"
#include <time.h>

enum { MAX_POLL_AFTER = 64, MAX_SLOW_CHECKS = 3, MIN_DOUBLED_STEPS = 1 << 18 };
#define MAX_REMAINING_SLOW_STEPS 1e8   /* estimated remaining steps at which a run that became slow is ended */
#define MAX_REMAINING_STEPS 1e11  /* the same at which any run is ended */
#define MIN_GAIN_RATIO 1e-3     /* of the earlier gain per step: slower steps count as slow */

/* Return the current time in s since the epoch, from the clock of the system, which may be set back. */
double read_clock(void)
{
    struct timespec now;
    timespec_get(&now, TIME_UTC);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/*
 * Call the caller's function if the polling interval has passed, and return whether the computation must stop now. A
 * deferred stop (defer_stop()) returns 0 until allow_stop(). Once a stop is requested, the function is not called
 * again.
 *
 * The number of right-hand sides between two readings of the clock, at most MAX_POLL_AFTER, is doubled or halved
 * according to their cost. Without a function, the clock is never read again. Called by is_cancelled() after that
 * number of right-hand sides, and within dense solvers.
 */
int poll_cancellation(Cancellation *cancellation)
{
    cancellation->count = 0;
    if (!cancellation->is_stop_requested)
        cancellation->poll_after = LONG_MAX;
    if (cancellation->is_stop_requested && !cancellation->stop) {
        const double wall_time = read_clock(), elapsed = wall_time - cancellation->last_reading;
        cancellation->last_reading = wall_time;
        if (elapsed < 0.1 * cancellation->poll_interval)
            cancellation->poll_after =
                cancellation->poll_after < MAX_POLL_AFTER / 2 ? 2 * cancellation->poll_after + 1 : MAX_POLL_AFTER;
        else if (elapsed > 0.5 * cancellation->poll_interval)
            cancellation->poll_after = (cancellation->poll_after + 1) / 2;
        if (wall_time >= cancellation->next_poll || elapsed < 0.0) {
            cancellation->stop = cancellation->is_stop_requested(cancellation->context) != 0;
            cancellation->last_reading = read_clock();
            cancellation->next_poll = cancellation->last_reading + cancellation->poll_interval;
        }
    }
    if (cancellation->stop)
        cancellation->poll_after = 0;
    return cancellation->stop && !cancellation->is_deferred;
}

/*
 * Initialize a cancellation token that calls is_stop_requested(context) every `poll_interval` seconds, first at the
 * next poll. A nonzero return value requests a stop. is_stop_requested NULL: never.
 */
void start_polling(Cancellation *cancellation, int (*is_stop_requested)(void *), void *context, double poll_interval)
{
    *cancellation = (Cancellation){
        .is_stop_requested = is_stop_requested, .context = context, .poll_interval = poll_interval};
}

/* Poll for the first time after a whole polling interval. Called if the caller has just polled. */
void skip_first_poll(Cancellation *cancellation)
{
    cancellation->next_poll = read_clock() + cancellation->poll_interval;
}

/*
 * Return the estimated number of steps from t to t_end (s), if each MONITOR_STEPS steps gain as much time as the last
 * ones.
 */
static double estimate_remaining_steps(const ProgressMonitor *monitor, double t, double t_end)
{
    return (t_end - t) / monitor->gain * MONITOR_STEPS;
}

/*
 * Update the monitor when the number of steps has doubled, and return whether that number grows exponentially with
 * time. The run then never ends, as where the frequency of a drive grows exponentially. Return 0 at all other steps.
 *
 * The criterion: the doubling gained no more time than the one N_DOUBLINGS before, steps have not become longer again,
 * and the extrapolated number of steps up to t_end (s) exceeds MAX_REMAINING_STEPS. The first MIN_DOUBLED_STEPS steps
 * never meet it.
 */
static int detect_exponential_step_count(ProgressMonitor *monitor, double t, double t_end)
{
    Doubling *doubling = &monitor->doubling;
    const double gain = t - doubling->t, steps = (double)monitor->steps, gain_before = doubling->gain[0];
    if (monitor->steps < doubling->next)
        return 0;
    doubling->t = t;
    for (int k = 1; k < N_DOUBLINGS; k++)
        doubling->gain[k - 1] = doubling->gain[k];
    doubling->gain[N_DOUBLINGS - 1] = gain;
    doubling->next = doubling->next ? 2 * monitor->steps : 1024;
    /* steps have not become longer again */
    const int slows = monitor->gain * steps <= 2.0 * gain * MONITOR_STEPS;
    return steps >= MIN_DOUBLED_STEPS && gain <= gain_before && slows
        && steps * exp2((t_end - t) / gain) > MAX_REMAINING_STEPS;
}

/*
 * Count a step that ends at time t (s) and return whether the run no longer advances towards t_end. Gains of time are
 * compared every MONITOR_STEPS steps. A comparison is slow in two cases: more than MAX_REMAINING_STEPS steps are
 * estimated to remain, or more than MAX_REMAINING_SLOW_STEPS, and the gain is below MIN_GAIN_RATIO of the mean of
 * earlier ones that were not slow. In the second case monitor->slowdown becomes 1, else 0.
 *
 * MAX_SLOW_CHECKS successive slow comparisons end the run, and so does a number of steps that grows exponentially with
 * time: monitor->slowdown is then GROWTH_DOUBLINGS. Steps that become longer again reset the count, because a fast
 * motion may decay. Called once per step.
 */
int detect_stall(ProgressMonitor *monitor, double t, double t_end)
{
    const long n_before = monitor->steps++;
    if (detect_exponential_step_count(monitor, t, t_end)) {
        monitor->slowdown = GROWTH_DOUBLINGS;
        return 1;
    }
    if (n_before % MONITOR_STEPS)
        return 0;
    const double gain_before = monitor->gain;
    monitor->gain = monitor->steps > 1 ? t - monitor->t : INFINITY;
    monitor->t = t;
    if (monitor->steps == 1)
        return 0;
    const double remaining_steps = estimate_remaining_steps(monitor, t, t_end);
    monitor->slowdown =
        remaining_steps > MAX_REMAINING_SLOW_STEPS
        && monitor->gain * (double)monitor->n_gains < MIN_GAIN_RATIO * monitor->gain_sum;
    if (remaining_steps > MAX_REMAINING_STEPS || monitor->slowdown) {
        monitor->n_slow_checks = monitor->gain > 1.1 * gain_before ? 0 : monitor->n_slow_checks + 1;
    } else {
        monitor->n_slow_checks = 0;
        monitor->gain_sum += monitor->gain;
        monitor->n_gains++;
    }
    return monitor->n_slow_checks >= MAX_SLOW_CHECKS;
}

/*
 * Return how many of the next calls of detect_stall() only count steps, without a comparison. It is the smaller of the
 * numbers of steps before doubling.next and before the next multiple of MONITOR_STEPS; 0: the next call compares. Used
 * by runs in lanes, which make these steps without the test.
 */
long count_steps_before_check(const ProgressMonitor *monitor)
{
    const long to_doubling = monitor->doubling.next - monitor->steps - 1;
    const long to_monitoring = monitor->steps % MONITOR_STEPS ? MONITOR_STEPS - monitor->steps % MONITOR_STEPS : 0;
    return to_doubling < 0 ? 0 : to_doubling < to_monitoring ? to_doubling : to_monitoring;
}
