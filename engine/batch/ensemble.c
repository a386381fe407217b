/*
 * The time loop of one run and of ensembles, one run after the other: start, steps and report of each without Python.
 * Several threads may work on one Batch, each on its own runs with its own Integrator. Results do not depend
 * on the other runs.
 */
#include "batch.h"
#include "../scene/start.h"

/* Return whether the batch is ending; called as the poll of a cancellation token. */
static int is_batch_ending(void *context) { return *((const Batch *)context)->ending; }

/*
 * Start the polling of a run's cancellation token. A callback of the batch is called every batch->poll_interval s,
 * first after that interval, because the caller polls before it calls C. Without a callback, the token asks every
 * POLL_INTERVAL_S whether the batch is ending.
 */
static void start_batch_polling(const Batch *batch, Cancellation *cancellation)
{
    if (batch->is_stop_requested) {
        start_polling(cancellation, batch->is_stop_requested, batch->context, batch->poll_interval);
        skip_first_poll(cancellation);
    } else
        start_polling(cancellation, is_batch_ending, (void *)batch, POLL_INTERVAL_S);
}

/*
 * Return whether the start (q, v) of run j can be copied to run i: it was computed here, is closed, and has the same
 * data (time, size of the mechanism, start parameters). j = -1 and j = i give 0.
 */
static int has_equal_start(const Batch *batch, long i, long j)
{
    const int is_closed = j >= 0 && j != i && batch->phase[j] != NEW && batch->status[j] != NOT_CLOSED
        && batch->status[j] != STOPPED;
    return is_closed && !batch->started[j] && batch->size[j] == batch->size[i]
        && get_sample_times(batch, j)[0] == get_sample_times(batch, i)[0]
        && has_equal_start_parameters((const Parameters *)(batch->p + i * batch->numbers),
            (const Parameters *)(batch->p + j * batch->numbers));
}

/*
 * Compute the start (q, v) of run i into batch->start. If one of n other runs (`candidates`, -1: none) has an equal
 * start, its start is copied instead. Return nonzero if the linkage cannot be closed here, a velocity is not finite, or
 * on cancellation; else 0.
 */
static int compute_run_start(const Batch *batch, long i, const long *candidates, int n, Cancellation *cancellation)
{
    double *start = batch->start + i * 2 * N_Q, residual;
    for (int k = 0; k < n; k++)
        if (has_equal_start(batch, i, candidates[k])) {
            memcpy(start, batch->start + candidates[k] * 2 * N_Q, 2 * N_Q * sizeof(double));
            return 0;
        }
    const double *p = batch->p + i * batch->numbers;
    return compute_start(get_sample_times(batch, i)[0], p, batch->size[i], start, start + N_Q, &residual, cancellation)
        || !all_finite(start + N_Q, N_Q);
}

/*
 * Begin run i in the memory `run`: initial state, unless batch->started[i], discrete states, audit, envelope,
 * cancellation, whether events may end the run, method. Return 0, STOPPED or NOT_CLOSED. candidates: n runs whose start
 * may be copied (compute_run_start()). The step record belongs to the thread, so that its buffer is set again.
 */
static int start_run(const Batch *batch, long i, const long *candidates, int n, Integrator *run)
{
    double *start = batch->start + i * 2 * N_Q, y[N_S] = {0.0};
    Cancellation cancellation;
    start_batch_polling(batch, &cancellation);
    const double t0 = get_sample_times(batch, i)[0];
    if (!batch->started[i] && compute_run_start(batch, i, candidates, n, &cancellation))
        return cancellation.stop ? STOPPED : NOT_CLOSED;
    for (int k = 0; k < 2 * N_Q; k++)
        y[k] = start[k];
    const StepRecord step_record = run->step_record; /* belongs to the thread, not to one run */
    gudgeon_run_start(run, batch->p_motion + i * batch->numbers, t0, y,
        batch->initial_discrete_states + i * AT_LEAST_ONE(N_DISCRETE));
    run->run_number = i + 1;
    gudgeon_run_set_record_buffer(run, step_record.rows, step_record.capacity);
    restore_compression_flags(run, batch->codes + i * AT_LEAST_ONE(N_CLEARANCES));
    gudgeon_run_enable_end_events(run, batch->stop);
    start_audit(run, batch->audit, batch->size[i]);
    if (batch->envelope)
        start_envelope(run, (EnvelopeRow *)batch->envelope + i * batch->envelope_capacity, batch->envelope_capacity);
    start_batch_polling(batch, &run->cancellation);
    gudgeon_adaptive_setup(run, batch->choice, batch->automatic, batch->scale + i * AT_LEAST_ONE(2 * N_X),
        batch->min_size + 2 * i, batch->fixed ? batch->step[i] : 0.0);
    return 0;
}

/*
 * Store the current state of `run` (y, discrete states, contact codes) as sample k of run i in the arrays of the batch.
 * Called for the last sample of a run that ends early.
 */
static void store_current_state_as_sample(const Batch *batch, long i, long k, Integrator *run)
{
    const long row = get_first_row(batch, i) + k;
    store_sample(run, run->t, run->y, (const Parameters *)(batch->p_motion + i * batch->numbers), 0,
        batch->y + row * N_S, batch->discrete_states + row * AT_LEAST_ONE(N_DISCRETE),
        batch->state + row * AT_LEAST_ONE(N_CLEARANCES));
}

/*
 * Return the index k > 0 of the first sample of run i whose q or v is not finite (a force was undefined between the
 * stages); 0: none. No sample is checked twice: batch->checked is updated.
 */
static long find_nonfinite_sample(const Batch *batch, long i)
{
    for (long k = batch->checked[i]; k < batch->done[i]; k++) {
        if (k > 0 && !all_finite(batch->y + (get_first_row(batch, i) + k) * N_S, 2 * N_Q))
            return k;
        batch->checked[i] = k + 1;
    }
    return 0;
}

/*
 * Make at most `max_steps` steps of run i, and store its samples and its time. Return the status of
 * gudgeon_adaptive_run().
 */
static int make_steps(const Batch *batch, long i, long max_steps, Integrator *run)
{
    const double *p = batch->p_motion + i * batch->numbers, *t = get_sample_times(batch, i);
    const long row = get_first_row(batch, i), n = batch->n_requested[i];
    double *y = batch->y + row * N_S, *discrete_states = batch->discrete_states + row * AT_LEAST_ONE(N_DISCRETE);
    signed char *state = batch->state + row * AT_LEAST_ONE(N_CLEARANCES);
    const int status = gudgeon_adaptive_run(run, p, n, t, max_steps, y, discrete_states, state, batch->done + i);
    batch->t_last[i] = run->t;
    return status;
}

/*
 * Remove sample k > 0 of run i, which is not finite, and all later ones. Set the number of samples to k, the last state
 * to a copy of sample k - 1, and the time at which the run ended to that of sample k.
 */
static void truncate_samples(const Batch *batch, long i, long k)
{
    batch->done[i] = k;
    batch->t_last[i] = get_sample_times(batch, i)[k];
    memcpy(batch->last + i * N_S, batch->y + (get_first_row(batch, i) + k - 1) * N_S, N_S * sizeof(double));
}

/*
 * Store the current state as the last sample of run i, which replaces samples that are not earlier. After an event that
 * ends the run (status ENDED), samples less than the resolution before it are replaced too: 32 DBL_EPSILON of the
 * times, or at most 1e-11 s or 1e-10 of the duration.
 */
static void store_last_sample(const Batch *batch, long i, int status, Integrator *run)
{
    const double *times = get_sample_times(batch, i), t_end = get_end_time(batch, i);
    const double tolerance = status != ENDED ? 0.0
        : max_of(32.0 * DBL_EPSILON * max_of(fabs(times[0]), fabs(t_end)),
            min_of(1e-11, 1e-10 * (t_end - times[0]))); /* resolution() of runtime/integrators/trajectory.py */
    while (batch->done[i] > 0 && times[batch->done[i] - 1] >= run->t - tolerance)
        batch->done[i]--;
    store_current_state_as_sample(batch, i, batch->done[i]++, run);
}

/*
 * End run i: write its report, audit, peaks and progress, its last state, and its status into the batch; its phase
 * becomes OVER. If a sample is not finite, later samples are removed and the status is NOT_FINITE. If the run ended
 * early without an error, its last state becomes a sample: for ENDED and STALLED always, for STOPPED only if the run
 * has a sample.
 */
static void end_run(const Batch *batch, long i, int status, Integrator *run)
{
    double *last = batch->last + i * N_S, discrete_states[AT_LEAST_ONE(N_DISCRETE)];
    signed char state[AT_LEAST_ONE(N_CLEARANCES)];
    const long first_nonfinite = find_nonfinite_sample(batch, i);
    gudgeon_run_sample(run, batch->p_motion + i * batch->numbers, last, discrete_states, state);
    report_audit(run, batch->audit_values + N_CHECKS * i, batch->audit_times + N_CHECKS * i,
        batch->audit_locations + N_CHECKS * i);
    gudgeon_run_report(run, batch->t_last + i, batch->counts + N_COUNTS * i, batch->residuals + N_RESIDUALS * i,
        batch->peaks + N_PEAK * AT_LEAST_ONE(N_CLEARANCES) * i);
    report_stall_monitor(run, batch->time_gain + i, batch->monitored_steps + 2 * i, batch->ended + N_STEP_ENDS * i);
    if (batch->envelope)
        batch->n_envelope_rows[i] = count_envelope_rows(run);
    if (first_nonfinite)
        truncate_samples(batch, i, first_nonfinite);
    else if (status == ENDED || status == STALLED || (status == STOPPED && batch->done[i] > 0))
        store_last_sample(batch, i, status, run);
    batch->status[i] = first_nonfinite ? NOT_FINITE : status;
    batch->phase[i] = OVER;
}

/*
 * Return whether Python must fetch records of a run: impacts, events, recorded steps, or contacts that are still
 * closed.
 */
static int has_unfetched_records(const Integrator *run)
{
    int has_records = run->contacts.n_records > 0 || run->events.n > 0 || run->step_record.n > 0;
    for (int k = 0; k < N_CLEARANCES; k++)
        has_records = has_records || run->discrete.contact[k].closed;
    return has_records;
}

/*
 * Integrate the runs *current to end - 1 of a batch, one after the other, in the memory `integrator`. If the batch is
 * ending, current runs end at once and no run begins. Return one of
 *   BATCH_ENDED: all these runs have ended;
 *   BUFFERS_FULL: fetch contacts, events and recorded steps of run *current, which then continues;
 *   RUN_ENDED: fetch the rest of them; run *current is over, call again with the next run;
 *   CALL_AGAIN: the run has made `limit` steps and continues.
 */
int gudgeon_ensemble(const void *batch_data, void *integrator, long *current, long end)
{
    const Batch *batch = batch_data;
    Integrator *run = integrator;
    for (; *current < end; ++*current) {
        const long i = *current;
        if (batch->phase[i] == NEW && !*batch->ending) {
            const long before = run->run_number - 1;
            batch->status[i] = start_run(batch, i, &before, 1, run);
            batch->phase[i] = batch->status[i] ? OVER : BEGUN;
        }
        if (batch->phase[i] != BEGUN)
            continue;
        const double before = read_clock();
        const int status = *batch->ending && batch->done[i] < batch->n_requested[i] ? STOPPED
            : make_steps(batch, i, batch->limit, run);
        batch->seconds[i] += read_clock() - before;
        const int is_over = status != EVENTS_FULL && (status || batch->done[i] == batch->n_requested[i]);
        if (!is_over && !find_nonfinite_sample(batch, i))
            return status ? BUFFERS_FULL : CALL_AGAIN;
        end_run(batch, i, status, run);
        if (has_unfetched_records(run))
            return RUN_ENDED;
    }
    return BATCH_ENDED;
}
#if HAS_LANES

/* Begin run i for a library of lanes, by start_run(). Return its status. */
static int begin_single_run(const Batch *batch, long i, const long *candidates, int n, void *run)
{
    return start_run(batch, i, candidates, n, run);
}

/* Return the pointers to the times and samples of run i in the arrays of the batch. */
static Samples get_sample_arrays(const Batch *batch, long i)
{
    const long row = get_first_row(batch, i);
    return (Samples){
        .n = batch->n_requested[i], .done = batch->done + i, .t = get_sample_times(batch, i), .y = batch->y + row * N_S,
        .discrete_states = batch->discrete_states + row * AT_LEAST_ONE(N_DISCRETE),
        .contact_codes = batch->state + row * AT_LEAST_ONE(N_CLEARANCES)
    };
}

/*
 * Complete the last step of run i and open the first attempt at its next one, run->control.attempt, for a library of
 * lanes. trial_result: what the lanes did of run->step. NOT_TRIED: it is tried here; TRIED: the lanes computed it;
 * STAGES_FAILED: its stages were not found; NO_TRIAL: there is none. After a rejected step the next attempt is open,
 * shorter or by the other method. Return CALL_AGAIN if an attempt is open, BUFFERS_FULL if the lists of contacts or
 * events are full, or RUN_ENDED after end_run().
 */
static int advance_single_run(const Batch *batch, long i, int trial_result, void *integrator)
{
    Integrator *run = integrator;
    const Parameters *p = (const Parameters *)(batch->p_motion + i * batch->numbers);
    const Samples samples = get_sample_arrays(batch, i);
    int status = 0;
    if (trial_result != NO_TRIAL) {
        run->step.method = run->choice.method;
        if (trial_result != NOT_TRIED)
            complete_singular_policy(run);
        const int trial_status = trial_result == TRIED ? 0 : trial_result == STAGES_FAILED ? NOT_FOUND
            : try_step(run, p, &run->step);
        if (!accept_or_retry_step(run, trial_status, p, &run->step, &status))
            return CALL_AGAIN;
        close_attempt(run);
        if (!status)
            status = accept_step(run, p, &samples);
    }
    if (!status && begin_step(run, 0, p, &samples, &status))
        return CALL_AGAIN;
    batch->t_last[i] = run->t;
    if (status == EVENTS_FULL)
        return BUFFERS_FULL;
    end_run(batch, i, status, run);
    return RUN_ENDED;
}

#include "local_step_limits.c"

/*
 * Return the table of function pointers (SingleRunFunctions) of a single run that a library of lanes calls: begin,
 * advance, limits of local steps.
 */
const void *gudgeon_single_run_functions(void)
{
    static const SingleRunFunctions single = {begin_single_run, advance_single_run, get_local_step_limits};
    return &single;
}
#endif
