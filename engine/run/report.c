/* The report of a run to Python: samples, counts, residuals, and whether contact and event lists must be fetched. */
#include <string.h>

/*
 * Store the current state of all bodies y (N_S), the discrete state (N_DISCRETE) and the contact codes (N_CLEARANCES)
 * of a run as one sample.
 */
void gudgeon_run_sample(const void *integrator, const double *p, double *y, double *discrete, signed char *codes)
{
    const Integrator *run = integrator;
    store_sample(run, run->t, run->y, (const Parameters *)p, 0, y, discrete, codes);
}

/*
 * Report the progress of a run for messages about a stall. Called when a run of a batch ends, whatever its status.
 *
 * advanced_time: time in s by which the last MONITOR_STEPS steps advanced. monitor_values[0]: MONITOR_STEPS;
 * monitor_values[1]: 1 if these steps are far shorter than earlier ones, 2 if their number grows exponentially with
 * time, else 0. ended_steps (N_STEP_ENDS): how many steps each kind of event ended since the last check; steps without
 * an event are not reported.
 */
static void report_stall_monitor(const Integrator *run, double *advanced_time, long *monitor_values, long *ended_steps)
{
    *advanced_time = run->progress.monitor.gain;
    monitor_values[0] = MONITOR_STEPS;
    monitor_values[1] = run->progress.monitor.slowdown;
    for (int k = 0; k < N_STEP_ENDS; k++)
        ended_steps[k] = 0;
    for (int k = 0; k < N_EVENT_FUNCTIONS; k++) {
        const int switch_index = k - N_CLEARANCES, friction = switch_index - N_SWITCHES;
        const int user_event = friction - N_FRICTIONS;
        const int end = user_event >= 0 ? END_EVENT : friction >= 0 ? END_FRICTION
            : switch_index >= 0 ? END_SWITCH : END_CONTACT;
        ended_steps[end] += run->progress.n_steps_ended[k];
    }
}

/* Return whether Python must fetch the lists of contacts and events, or the step record, before the run resumes. */
int gudgeon_run_has_full_buffers(const void *integrator) { return has_full_buffers(integrator); }

/*
 * Return the number of contacts and user-defined events that wait in the lists until Python fetches them, plus that of
 * contacts that still last. 0: there is nothing to fetch.
 */
int gudgeon_run_count_listed(const void *integrator)
{
    const Integrator *run = integrator;
    int count = run->contacts.n_records + run->events.n;
    for (int i = 0; i < N_CLEARANCES; i++)
        count += run->discrete.contact[i].closed;
    return count;
}

/*
 * Report the time t (s) of a run, its counts (Count), and its largest residuals and restitution ratios (Residual).
 * peaks (Peak): of each joint with play the largest force, its time, and the largest eccentricity.
 */
void gudgeon_run_report(const void *integrator, double *t, long *counts, double *residuals, double *peaks)
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
    residuals[RESIDUAL_phi_max] = run->residuals.phi_max;
    residuals[RESIDUAL_phi_dot_max] = run->residuals.phi_dot_max;
    residuals[RESIDUAL_ratio_min] = run->contacts.ratio_min;
    residuals[RESIDUAL_ratio_max] = run->contacts.ratio_max;
    residuals[RESIDUAL_speed_max] = run->norm.speed[0];
    residuals[RESIDUAL_omega_max] = run->norm.speed[1];
    for (int i = 0; i < N_CLEARANCES; i++, peaks += N_PEAK) {
        peaks[PEAK_F] = run->contacts.F_peak[i];
        peaks[PEAK_t] = run->contacts.t_peak[i];
        peaks[PEAK_e_max] = run->contacts.e_max[i];
    }
}
