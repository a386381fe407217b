/* The report of a run to Python: samples, counts, residuals, and whether lists must be fetched. */
#include <string.h>

/* Store the present state of all bodies, the discrete state and the contact codes as a sample. */
void gudgeon_run_sample(const void *integrator, const double *p, double *y, double *latched, signed char *state)
{
    const Integrator *run = integrator;
    store_sample(run, run->t, run->y, (const Parameters *)p, 0, y, latched, state);
}

/*
 * Report on a run that no longer advances. gained: time in s that the last MONITOR_STEPS steps gained. steps: that
 * number, and whether these steps are far shorter than earlier ones. ended (StepEnd): how many steps each kind of event
 * ended.
 */
static void report_monitor(const Integrator *run, double *gained, long *steps, long *ended)
{
    *gained = run->progress.monitor.gain;
    steps[0] = MONITOR_STEPS;
    steps[1] = run->progress.monitor.crawls;
    for (int k = 0; k < N_STEP_ENDS; k++)
        ended[k] = 0;
    for (int k = 0; k < N_EVENT_FUNCTIONS; k++) {
        const int switch_index = k - N_CLEARANCES, friction = switch_index - N_SWITCHES;
        const int user_event = friction - N_FRICTIONS;
        const int end = user_event >= 0 ? END_EVENT : friction >= 0 ? END_FRICTION
            : switch_index >= 0 ? END_SWITCH : END_CONTACT;
        ended[end] += run->progress.ended[k];
    }
}

/* Return whether Python must fetch the lists and the step record before the run resumes. */
int gudgeon_run_full(const void *integrator) { return has_full_lists(integrator); }

/* Return the number of events and contacts in the lists, including contacts that last. */
int gudgeon_run_listed(const void *integrator)
{
    const Integrator *run = integrator;
    int n = run->contacts.n_impacts + run->events.n;
    for (int i = 0; i < N_CLEARANCES; i++)
        n += run->discrete.contact[i].closed;
    return n;
}

/* Report the time (s), counts, residuals and ratios of a run, and three values (Peak) of each joint with play. */
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
