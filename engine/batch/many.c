/*
 * The time loop of one run and of ensembles, one run after the other: start, steps and report of each without Python.
 * Several threads may work on one Batch, each on its own runs with its own Integrator. Results do not depend
 * on the other runs.
 */
#include "batch.h"
#include "../scene/start.h"

/* Return whether the batch is ending. */
static int is_ending(void *batch) { return *((const Batch *)batch)->ending; }

/* Set up the cancellation of a run's computations: by the callback of the batch, or when the batch is ending. */
static void request_cancellation_by(const Batch *b, Cancellation *cancellation)
{
    if (b->ask)
        start_polling(cancellation, b->ask, b->caller, b->every);
    else
        start_polling(cancellation, is_ending, (void *)b, POLL_INTERVAL_S);
}

/* Return whether run j has begun and its start was computed here from the same data as that of run i. */
static int begins_alike(const Batch *b, long i, long j)
{
    const int is_closed = j >= 0 && j != i && b->phase[j] != NEW && b->status[j] != NOT_CLOSED
        && b->status[j] != STOPPED;
    return is_closed && !b->started[j] && b->size[j] == b->size[i]
        && times_of(b, j)[0] == times_of(b, i)[0]
        && same_start((const Parameters *)(b->p + i * b->numbers), (const Parameters *)(b->p + j * b->numbers));
}

/*
 * Compute the start (q, v) of run i, or copy that of one of n other runs (-1: none) that begins alike. Returns nonzero
 * on failure.
 */
static int close_run(const Batch *b, long i, const long *others, int n, Cancellation *cancellation)
{
    double *start = b->start + i * 2 * N_Q, residual;
    for (int k = 0; k < n; k++)
        if (begins_alike(b, i, others[k])) {
            memcpy(start, b->start + others[k] * 2 * N_Q, 2 * N_Q * sizeof(double));
            return 0;
        }
    const double *p = b->p + i * b->numbers;
    return close_start(times_of(b, i)[0], p, b->size[i], start, start + N_Q, &residual, cancellation)
        || !all_finite(start + N_Q, N_Q);
}

/* Begin run i: start, discrete states, audit, envelope, method. Returns 0, STOPPED or NOT_CLOSED. */
static int start_run(const Batch *b, long i, const long *others, int n, Integrator *run)
{
    double *start = b->start + i * 2 * N_Q, y[N_S] = {0.0};
    Cancellation cancellation;
    request_cancellation_by(b, &cancellation);
    const double t0 = times_of(b, i)[0];
    if (!b->started[i] && close_run(b, i, others, n, &cancellation))
        return cancellation.stop ? STOPPED : NOT_CLOSED;
    for (int k = 0; k < 2 * N_Q; k++)
        y[k] = start[k];
    const StepRecord step_record = run->step_record; /* belongs to the thread, not to one run */
    gudgeon_run_start(run, b->p_motion + i * b->numbers, t0, y, b->remembered + i * AT_LEAST_ONE(N_DISCRETE));
    run->began = i + 1;
    gudgeon_run_record(run, step_record.rows, step_record.capacity);
    set_contact_codes(run, b->codes + i * AT_LEAST_ONE(N_CLEARANCES));
    gudgeon_run_stop(run, b->stop);
    start_audit(run, b->audit, b->size[i]);
    if (b->trace)
        start_envelope(run, (EnvelopeRow *)b->trace + i * b->trace_rows, b->trace_rows);
    request_cancellation_by(b, &run->cancellation);
    gudgeon_adaptive_setup(run, b->choice, b->automatic, b->scale + i * 2 * N_X, b->least + 2 * i,
        b->fixed ? b->step[i] : 0.0);
    return 0;
}

/* Store the present state as sample k of run i. */
static void take_sample(const Batch *b, long i, long k, Integrator *run)
{
    const long row = rows_of(b, i) + k;
    store_sample(run, run->t, run->y, (const Parameters *)(b->p_motion + i * b->numbers), 0, b->y + row * N_S,
        b->latched + row * AT_LEAST_ONE(N_DISCRETE), b->state + row * AT_LEAST_ONE(N_CLEARANCES));
}

/*
 * Return the index of the first sample of run i that is not finite, because a force is undefined between the stages; 0:
 * none. No sample is checked twice.
 */
static long first_odd(const Batch *b, long i)
{
    for (long k = b->checked[i]; k < b->done[i]; k++) {
        if (k > 0 && !all_finite(b->y + (rows_of(b, i) + k) * N_S, 2 * N_Q))
            return k;
        b->checked[i] = k + 1;
    }
    return 0;
}

/* Make at most `limit` steps of run i and store its samples. Returns a status. */
static int advance_run(const Batch *b, long i, long limit, Integrator *run)
{
    const double *p = b->p_motion + i * b->numbers, *t = times_of(b, i);
    const long row = rows_of(b, i), n = b->wanted[i];
    double *y = b->y + row * N_S, *latched = b->latched + row * AT_LEAST_ONE(N_DISCRETE);
    signed char *state = b->state + row * AT_LEAST_ONE(N_CLEARANCES);
    const int status = gudgeon_adaptive_run(run, p, n, t, limit, y, latched, state, b->done + i);
    b->t_last[i] = run->t;
    return status;
}

/* Remove sample k of run i, which is not finite, and all later ones. */
static void take_back(const Batch *b, long i, long k)
{
    b->done[i] = k;
    b->t_last[i] = times_of(b, i)[k];
    memcpy(b->last + i * N_S, b->y + (rows_of(b, i) + k - 1) * N_S, N_S * sizeof(double));
}

/* Store the present state as the last sample of run i, in place of samples that are not earlier. */
static void close_samples(const Batch *b, long i, int status, Integrator *run)
{
    const double *times = times_of(b, i), t_end = t_end_of(b, i);
    const double apart = status != ENDED ? 0.0
        : max_of(32.0 * DBL_EPSILON * max_of(fabs(times[0]), fabs(t_end)),
            min_of(1e-11, 1e-10 * (t_end - times[0]))); /* resolution() of runtime/integrators/trajectory.py */
    while (b->done[i] > 0 && times[b->done[i] - 1] >= run->t - apart)
        b->done[i]--;
    take_sample(b, i, b->done[i]++, run);
}

/* End run i: write its report, and its last state if it ended early without an error. */
static void end_run(const Batch *b, long i, int status, Integrator *run)
{
    double *last = b->last + i * N_S, latched[AT_LEAST_ONE(N_DISCRETE)];
    signed char state[AT_LEAST_ONE(N_CLEARANCES)];
    const long odd = first_odd(b, i);
    gudgeon_run_sample(run, b->p_motion + i * b->numbers, last, latched, state);
    report_audit(run, b->audited + N_CHECKS * i, b->audited_t + N_CHECKS * i, b->audited_where + N_CHECKS * i);
    gudgeon_run_report(run, b->t_last + i, b->counts + N_COUNTS * i, b->residuals + N_RESIDUALS * i,
        b->peaks + N_PEAK * AT_LEAST_ONE(N_CLEARANCES) * i);
    report_monitor(run, b->gained + i, b->paced + 2 * i, b->ended + N_STEP_ENDS * i);
    if (b->trace)
        b->traced[i] = count_envelope_rows(run);
    if (odd)
        take_back(b, i, odd);
    else if (status == ENDED || status == STALLED || (status == STOPPED && b->done[i] > 0))
        close_samples(b, i, status, run);
    b->status[i] = odd ? NOT_FINITE : status;
    b->phase[i] = OVER;
}

/* Return whether contacts, events or recorded states of a run wait to be fetched. */
static int has_lists(const Integrator *run)
{
    int some = run->contacts.n_impacts > 0 || run->events.n > 0 || run->step_record.n > 0;
    for (int k = 0; k < N_CLEARANCES; k++)
        some = some || run->discrete.contact[k].closed;
    return some;
}

/*
 * Integrate the runs *current to end - 1. Returns ALL_OVER; LISTS or RUN_OVER if contacts or events of run *current are
 * to be fetched, and it continues or is over; GOES_ON after `limit` steps. Call again, after RUN_OVER with the next
 * run. If the batch is ending, runs under way end at once and no run begins.
 */
int gudgeon_ensemble(const void *batch, void *integrator, long *current, long end)
{
    const Batch *b = batch;
    Integrator *run = integrator;
    for (; *current < end; ++*current) {
        const long i = *current;
        if (b->phase[i] == NEW && !*b->ending) {
            const long before = run->began - 1;
            b->status[i] = start_run(b, i, &before, 1, run);
            b->phase[i] = b->status[i] ? OVER : BEGUN;
        }
        if (b->phase[i] != BEGUN)
            continue;
        const double before = seconds_now();
        const int status = *b->ending && b->done[i] < b->wanted[i] ? STOPPED : advance_run(b, i, b->limit, run);
        b->seconds[i] += seconds_now() - before;
        const int is_over = status != EVENTS_FULL && (status || b->done[i] == b->wanted[i]);
        if (!is_over && !first_odd(b, i))
            return status ? LISTS : GOES_ON;
        end_run(b, i, status, run);
        if (has_lists(run))
            return RUN_OVER;
    }
    return ALL_OVER;
}
#if HAS_LANES

/* Begin run i for the lanes. */
static int begin_single(const Batch *b, long i, const long *others, int n, void *run)
{
    return start_run(b, i, others, n, run);
}

/* Return the arrays of run i's samples. */
static Samples samples_of(const Batch *b, long i)
{
    const long row = rows_of(b, i);
    return (Samples){
        .n = b->wanted[i], .done = b->done + i, .t = times_of(b, i), .y = b->y + row * N_S,
        .latched = b->latched + row * AT_LEAST_ONE(N_DISCRETE), .state = b->state + row * AT_LEAST_ONE(N_CLEARANCES)
    };
}

/*
 * Advance run i to its next step, run->control.attempt. tried: what the lanes did of the last step in run->step, which
 * is completed first; a step that they left untried is tried here. Returns GOES_ON, LISTS or RUN_OVER.
 */
static int next_single(const Batch *b, long i, int tried, void *integrator)
{
    Integrator *run = integrator;
    const Parameters *p = (const Parameters *)(b->p_motion + i * b->numbers);
    const Samples out = samples_of(b, i);
    int status = 0;
    if (tried != NOT_YET) {
        run->step.method = run->choice.method;
        if (tried != NOT_TRIED)
            reset_singular_policy(run);
        const int found = tried == TRIED ? 0 : tried == MISSED ? NOT_FOUND : try_step(run, p, &run->step);
        if (!is_step_accepted(run, found, p, &run->step, &status))
            return GOES_ON;
        close_attempt(run);
        if (!status)
            status = accept_step(run, p, &out);
    }
    if (!status && needs_step(run, 0, p, &out, &status))
        return GOES_ON;
    b->t_last[i] = run->t;
    if (status == EVENTS_FULL)
        return LISTS;
    end_run(b, i, status, run);
    return RUN_OVER;
}

/* Return the number of steps that a run may make in the lanes before its next check. */
static long unseen_single(const void *integrator)
{
    const Integrator *run = integrator;
    const long steps = run->step_record.rows || run->envelope.rows ? 0 : steps_before_check(&run->progress.monitor);
    const long checked = run->audit.level == AUDIT_FULL ? 0 : run->audit.due - run->counts.steps;
    return run->audit.level && checked < steps ? (checked > 0 ? checked : 0) : steps;
}

/* Return the functions of a single run for a library of lanes. */
const void *gudgeon_single(void)
{
    static const Single single = {begin_single, next_single, unseen_single};
    return &single;
}
#endif
