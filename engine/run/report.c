/*
 * What is asked of a run from outside: samples, and lists that are fetched.
 */
#include <string.h>

void gudgeon_run_sample(const void *integrator, const double *p, double *y, double *latched, signed char *state)
{
    const Integrator *run = integrator;
    store_sample(run, run->t, run->y, (const Parameters *)p, 0, y, latched, state);
}

/*
 * Of a run that no longer advances: s that its last MONITOR_STEPS steps gained, how many these are, whether they are
 * far shorter than those before; how many of them ended at contacts, corners of forces, frictions, events of the user.
 */
static void report_monitor(const Integrator *run, double *gained, long *steps, long *ended)
{
    *gained = run->progress.monitor.gain;
    steps[0] = MONITOR_STEPS;
    steps[1] = run->progress.monitor.crawls;
    for (int k = 0; k < N_STEP_ENDS; k++)
        ended[k] = 0;
    for (int k = 0; k < N_EVENT_FUNCTIONS; k++) {
        const int corner = k - N_CLEARANCES, friction = corner - N_SWITCHES, user_event = friction - N_FRICTIONS;
        const int end = user_event >= 0 ? END_EVENT : friction >= 0 ? END_FRICTION
            : corner >= 0 ? END_SWITCH : END_CONTACT;
        ended[end] += run->progress.ended[k];
    }
}

/* Whether the run goes on only when its lists and its tape have been fetched. */
int gudgeon_run_full(const void *integrator) { return lists_full(integrator); }

/* How many contacts, those that go on among them, and events the lists have. */
int gudgeon_run_listed(const void *integrator)
{
    const Integrator *run = integrator;
    int n = run->contacts.n_impacts + run->events.n;
    for (int i = 0; i < N_CLEARANCES; i++)
        n += run->discrete.contact[i].closed;
    return n;
}

void gudgeon_run_report(const void *integrator, double *t, long *counts, double *numbers, double *peaks)
{
    const Integrator *run = integrator;
    *t = run->t;
    counts[COUNT_steps] = run->counts.steps;
    counts[COUNT_right_hand_sides] = run->counts.evaluations;
    counts[COUNT_onsets] = run->contacts.onsets;
    counts[COUNT_ratio_outside] = (long)run->contacts.ratio_outside;
    counts[COUNT_switches] = run->counts.switches;
    counts[COUNT_rejected] = run->counts.rejected;
    counts[COUNT_jacobians] = run->counts.jacobians;
    counts[COUNT_stiff_steps] = run->counts.stiff_steps;
    numbers[RESIDUAL_phi_max] = run->residuals.phi_max;
    numbers[RESIDUAL_phi_dot_max] = run->residuals.phi_dot_max;
    numbers[RESIDUAL_ratio_min] = run->contacts.ratio_min;
    numbers[RESIDUAL_ratio_max] = run->contacts.ratio_max;
    for (int i = 0; i < N_CLEARANCES; i++, peaks += N_PEAK) {
        peaks[PEAK_F] = run->contacts.F_peak[i];
        peaks[PEAK_t] = run->contacts.t_peak[i];
        peaks[PEAK_e_max] = run->contacts.e_max[i];
    }
}
