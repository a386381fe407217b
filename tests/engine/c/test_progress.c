/* Whether time advances, and when a request to stop counts. */
#include "part.h"

static Integrator run;
static int cancellation, stop;

static int answer(void *caller)
{
    cancellation++;
    return *(int *)caller;
}

/* Steps of length h until the run stalls on the way to t_end; 0: it does not within `most`. */
static long steps_to_stall(double h, double t_end, long most)
{
    run = (Integrator){.t = 0.0};
    for (long k = 1; k <= most; k++) {
        run.t = (double)k * h;
        if (detect_run_stall(&run, t_end))
            return k;
    }
    return 0;
}

int main(void)
{
    /* three looks in a row, each after MONITOR_STEPS, at a pace that leaves more steps than can ever be made */
    CHECK(steps_to_stall(1e-9, 1e3, 1000000) == 3 * MONITOR_STEPS + 1);
    CHECK(steps_to_stall(1e-6, 1.0, 1000000) == 0);
    CHECK(count_steps_before_check(&run.progress.monitor) < MONITOR_STEPS);

    /* an event at the beginning of each step */
    run = (Integrator){.t = 0.0};
    int no_advance = 0;
    while (!is_chattering(&run) && no_advance < 10 * MAX_NO_ADVANCE)
        count_step_end(&run, 0, ++no_advance);
    CHECK(no_advance == MAX_NO_ADVANCE + 1);
    CHECK(run.progress.n_steps_ended[0] == no_advance);
    count_step_end(&run, -1, 0);
    CHECK(run.progress.no_advance == 0 && run.progress.n_steps_ended[N_EVENT_FUNCTIONS] == 1);

    /* steps that lead nowhere */
    int crawls = 0;
    while (!detect_short_step_stall(&run, ++crawls))
        ;
    CHECK(crawls == MAX_SHORT_STEPS + 1);
    CHECK(!detect_short_step_stall(&run, 0) && !detect_short_step_stall(&run, 1));

    /* counters */
    count_step(&run, 1);
    count_evaluations(&run, 3);
    CHECK(run.counts.steps == 1 && run.counts.stiff_steps == 1 && run.counts.evaluations == 3);

    /* a request to stop: nobody asks at first, then it counts unless what is under way comes to its end */
    Cancellation token;
    start_polling(&token, answer, &stop, 0.0);
    for (int k = 0; k < 1000; k++)
        CHECK(!is_cancelled(&token));
    CHECK(cancellation > 0 && cancellation <= 1000);
    stop = 1;
    defer_stop(&token);
    for (int k = 0; k < 1000; k++)
        CHECK(!is_cancelled(&token));
    CHECK(token.stop);
    allow_stop(&token);
    CHECK(is_cancelled(&token));
    return failures;
}
