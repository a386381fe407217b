/* Whether time advances, and when a request to stop counts. */
#include "part.h"

static Run run;
static int asked, stop;

static int answer(void *whom)
{
    asked++;
    return *(int *)whom;
}

/* Steps of length h until the run stalls on the way to t_end; 0: it does not within `most`. */
static long steps_to_stall(double h, double t_end, long most)
{
    run = (Run){.t = 0.0};
    for (long k = 1; k <= most; k++) {
        run.t = (double)k * h;
        if (stalls(&run, t_end))
            return k;
    }
    return 0;
}

int main(void)
{
    /* three looks in a row, each after PACE_STEPS, at a pace that leaves more steps than can ever be made */
    CHECK(steps_to_stall(1e-9, 1e3, 1000000) == 3 * PACE_STEPS + 1);
    CHECK(steps_to_stall(1e-6, 1.0, 1000000) == 0);
    CHECK(unseen_steps(&run.progress.pace) < PACE_STEPS);

    /* an event at the beginning of each step */
    run = (Run){.t = 0.0};
    int stuck = 0;
    while (!is_stuck(&run) && stuck < 10 * MAX_STUCK)
        note_step_end(&run, 0, ++stuck);
    CHECK(stuck == MAX_STUCK + 1);
    CHECK(run.progress.ended[0] == stuck);
    note_step_end(&run, -1, 0);
    CHECK(run.progress.stuck == 0 && run.progress.ended[N_MARGINS] == 1);

    /* steps that lead nowhere */
    int crawls = 0;
    while (!note_crawl(&run, ++crawls))
        ;
    CHECK(crawls == MAX_CRAWL + 1);
    CHECK(!note_crawl(&run, 0) && !note_crawl(&run, 1));

    /* counters */
    count_step(&run, 1);
    count_evaluations(&run, 3);
    CHECK(run.counts.steps == 1 && run.counts.stiff_steps == 1 && run.counts.evaluations == 3);

    /* a request to stop: nobody asks at first, then it counts unless what is under way comes to its end */
    Asked token;
    set_asked(&token, answer, &stop, 0.0);
    for (int k = 0; k < 1000; k++)
        CHECK(!given_up(&token));
    CHECK(asked > 0 && asked <= 1000);
    stop = 1;
    defer_stop(&token);
    for (int k = 0; k < 1000; k++)
        CHECK(!given_up(&token));
    CHECK(token.stop);
    allow_stop(&token);
    CHECK(given_up(&token));
    return failures;
}
