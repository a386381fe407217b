/*
 * What is asked of a run from outside: samples, and lists that are fetched.
 */
#include <string.h>

void gudgeon_run_sample(const void *memory, const double *p, double *y, double *latched, signed char *state)
{
    const Run *run = memory;
    store_sample(run, run->t, run->y, (const Parameters *)p, 0, y, latched, state);
}

void gudgeon_run_stop(void *memory, int stop) { ((Run *)memory)->stop = stop; }

/* `ask` is called with `whom` each `every` seconds (0: at each right-hand side); the run stops where it says so. */
void gudgeon_run_asks(void *memory, int (*ask)(void *), void *whom, double every)
{
    set_asked(&((Run *)memory)->asked, ask, whom, every);
}

/*
 * Of a run that no longer advances: s that its last PACE_STEPS steps gained, how many these are, whether they are far
 * shorter than those before; how many of them ended at contacts, corners of forces, frictions, events of the user.
 */
void gudgeon_run_pace(const void *memory, double *gained, long *steps, long *ended)
{
    const Run *run = memory;
    *gained = run->advance.gain;
    steps[0] = PACE_STEPS;
    steps[1] = run->advance.crawls;
    for (int k = 0; k < 4; k++)
        ended[k] = 0;
    for (int k = 0; k < N_MARGINS; k++) {
        const int corner = k - N_CLEARANCES, friction = corner - N_SWITCHES, user_event = friction - N_FRICTIONS;
        ended[(corner >= 0) + (friction >= 0) + (user_event >= 0)] += run->ended[k];
    }
}

/* Whether the run goes on only when its lists and its tape have been fetched. */
int gudgeon_run_full(const void *memory) { return lists_full(memory); }

/* How many contacts, those that go on among them, and events the lists have. */
int gudgeon_run_listed(const void *memory)
{
    const Run *run = memory;
    int n = run->n_impacts + run->n_events;
    for (int i = 0; i < N_CLEARANCES; i++)
        n += run->memory.latch[i].closed;
    return n;
}

/* Fetches and empties the list of user events, with the states there as rows of samples. */
int gudgeon_run_events(void *memory, double *t, int *event, double *y, double *latched, signed char *state)
{
    Run *run = memory;
    const int n = run->n_events;
    for (int i = 0; i < n; i++) {
        t[i] = run->event_t[i];
        event[i] = run->event[i];
    }
#if N_USER_EVENTS
    const EventStates *at = event_states(run);
    memcpy(y, at->y, (size_t)n * sizeof at->y[0]);
    memcpy(latched, at->latched, (size_t)n * sizeof at->latched[0]);
    memcpy(state, at->state, (size_t)n * sizeof at->state[0]);
#else
    (void)y, (void)latched, (void)state;
#endif
    run->n_events = 0;
    return n;
}

/* Fetches and empties the list of impacts: 5 numbers each, and the joint; with `last` the open ones too. */
int gudgeon_run_impacts(void *memory, int last, double *numbers, int *joints)
{
    Run *run = memory;
    for (int i = 0; last && i < N_CLEARANCES; i++)
        if (run->memory.latch[i].closed && run->n_impacts < N_IMPACTS)
            run->impacts[run->n_impacts++] = run->open[i];
    const int n = run->n_impacts;
    for (int i = 0; i < n; i++) {
        const Impact *impact = &run->impacts[i];
        numbers[5 * i] = impact->t_on;
        numbers[5 * i + 1] = impact->t_off;
        numbers[5 * i + 2] = impact->deltadot;
        numbers[5 * i + 3] = impact->F_peak;
        numbers[5 * i + 4] = impact->t_peak;
        joints[i] = impact->joint;
    }
    run->n_impacts = 0;
    return n;
}

void gudgeon_run_report(const void *memory, double *t, long *counts, double *numbers, double *peaks)
{
    const Run *run = memory;
    *t = run->t;
    counts[0] = run->steps;
    counts[1] = run->evaluations;
    counts[2] = run->onsets;
    counts[3] = run->grazes;
    counts[4] = (long)run->ratio_outside;
    counts[5] = run->switches;
    counts[6] = run->rejected;
    counts[7] = run->jacobians;
    counts[8] = run->stiff_steps;
    numbers[0] = run->phi_max;
    numbers[1] = run->phi_dot_max;
    numbers[2] = run->ratio_min;
    numbers[3] = run->ratio_max;
    for (int i = 0; i < N_CLEARANCES; i++) {
        peaks[3 * i] = run->F_peak[i];
        peaks[3 * i + 1] = run->t_peak[i];
        peaks[3 * i + 2] = run->e_max[i];
    }
}
