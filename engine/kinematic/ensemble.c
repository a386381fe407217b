/*
 * Kinematic runs of a batch, one after the other: start, motion, works, and checks of each, without Python. Several
 * threads may work on one KinematicBatch (scene/calls.h), each on its own runs with its own KinematicRun. Results do
 * not depend on the other runs.
 */
#define ENDING_POLL_INTERVAL_S 0.02 /* s between two polls whether the batch is ending */
#define OUTLIER_RATIO 100.0 /* accelerations: largest over median (_yield_unbounded_sample_note in result_builder.py) */

/*
 * Return whether a run is cancelled: the batch is ending, or it must be short (KinematicBatch.must_be_short). Called as
 * the poll of its cancellation token.
 */
static int is_batch_ending(void *context)
{
    const KinematicBatch *batch = context;
    return *batch->ending || batch->must_be_short;
}

/* Return the row in which works accumulate, J: those of the next sample of a run. */
static double *get_current_works(const RunSamples *samples) { return samples->y + samples->done * N_S + 2 * N_Q; }

/*
 * Return the largest |a| of N_Q accelerations, of positions (m/s^2) and angles (rad/s^2) alike; NaN components are
 * skipped. Called for each sample: has_acceleration_outlier() compares the samples.
 */
static double find_largest_acceleration(const double *a)
{
    double largest = 0.0;
    for (int j = 0; j < N_Q; j++)
        largest = max_of(fabs(a[j]), largest);
    return largest;
}

/* Evaluate the requested series of motion at sample k, with the position q, v, a (N_Q each), into batch->values. */
static void store_series(const KinematicRun *run, long k, const double *q, const double *v, const double *a)
{
    const KinematicBatch *batch = run->samples.batch;
    const long one = 1, row = run->samples.index * batch->samples + k;
    for (long j = 0; j < batch->n_series; j++) {
        const long body = batch->series[j].body < 0 ? 0 : batch->series[j].body;
        gudgeon_motion_series(&batch->series[j], 1, &one, q + body, v + body, a + body, (const double *)run->p,
            batch->numbers, batch->values[j] + row);
    }
}

/*
 * Store the current position as the next sample of the run (state, accelerations, series, extremes), whose works are
 * stored already. The works continue in the next row, and the next step is as long as the time to the next sample. q,
 * v: those of the position; at the start, the initial ones.
 */
static void store_run_sample(KinematicRun *run, const double *q, const double *v)
{
    RunSamples *samples = &run->samples;
    const long k = samples->done++;
    double *y = samples->y + k * N_S, *a = samples->a + k * N_Q;
    accumulate_sample_statistics(run, samples->t[k], &run->motion, &samples->phi_max, &samples->phi_dot_max);
    memcpy(y, q, N_Q * sizeof *q);
    memcpy(y + N_Q, v, N_Q * sizeof *v);
    memcpy(a, run->motion.a, N_Q * sizeof *a);
    store_series(run, k, y, y + N_Q, a);
    samples->are_finite = samples->are_finite && all_finite(y, N_S) && all_finite(a, N_Q);
    const double largest = samples->largest[k] = find_largest_acceleration(a);
    samples->largest_a = max_of(samples->largest_a, largest);
    samples->smallest_a = min_of(samples->smallest_a, largest);
    if (samples->done == samples->n)
        return;
    memcpy(y + N_S + 2 * N_Q, y + 2 * N_Q, N_WORK * sizeof *y);
    samples->step_length = (StepLength){samples->t[k + 1] - run->motion.t, 0};
}

/*
 * Compute the initial state (q, v) of run i, unless batch->started[i]. Return 0, STOPPED on cancellation, or NOT_CLOSED
 * if the search in Python must decide.
 */
static int compute_kinematic_run_start(const KinematicBatch *batch, long i, double t, Cancellation *cancellation)
{
    double *start = batch->start + i * 2 * N_Q, residual;
    if (batch->started[i])
        return 0;
    if (!compute_start(t, batch->p + i * batch->numbers, batch->size[i], start, start + N_Q, &residual, cancellation)
        && all_finite(start + N_Q, N_Q))
        return 0;
    return cancellation->stop ? STOPPED : NOT_CLOSED;
}

/*
 * Begin run i in the memory `run`: compute the initial state, set batch->started[i], store the first sample. Return 0
 * or a status.
 */
static int begin_kinematic_run(const KinematicBatch *batch, long i, KinematicRun *run)
{
    const long row = batch->sample_block[i] * batch->samples;
    const double *t = batch->t + i * batch->time_stride, *start = batch->start + i * 2 * N_Q;
    gudgeon_kinematic_begin(run, batch->max_correction, batch->size[i], t[batch->n_requested[i] - 1], is_batch_ending,
        (void *)batch, ENDING_POLL_INTERVAL_S);
    run->p = (const Parameters *)(batch->p + i * batch->numbers);
    run->samples = (RunSamples){
        .batch = batch, .index = i, .n = batch->n_requested[i], .t = t, .y = batch->y + row * N_S,
        .a = batch->a + row * N_Q, .largest = batch->largest_a + row, .smallest_a = INFINITY, .are_finite = 1,
        .began = read_clock()
    };
    int status = compute_kinematic_run_start(batch, i, t[0], &run->cancellation);
    batch->started[i] = !status;
    if (!status)
        status = set_initial_position(run, t[0], start, start + N_Q, &run->motion);
    if (status)
        return status;
    for (int j = 0; j < N_WORK; j++)
        get_current_works(&run->samples)[j] = 0.0;
    store_run_sample(run, start, start + N_Q);
    return 0;
}

/*
 * Count a step of a run, check its progress, and store its end as a sample if it reaches the time of the next one.
 * Return 0, STALLED or a status.
 */
static int accept_kinematic_step(KinematicRun *run)
{
    RunSamples *samples = &run->samples;
    samples->steps++;
    if (detect_stall(&run->monitor, run->motion.t, run->t_end))
        return STALLED;
    if (run->motion.t < samples->t[samples->done])
        return 0;
    const int status = complete_position(run, &run->motion);
    if (!status)
        store_run_sample(run, run->motion.q, run->motion.v);
    return status;
}

/*
 * Make one step of a run towards its next sample, add its works if they are requested, and accept it by
 * accept_kinematic_step() (counts, sample, progress). Return 0 or a status.
 */
static int advance_run(KinematicRun *run)
{
    const Position before = run->motion;
    const double t1 = run->samples.t[run->samples.done];
    int status = make_step(run, &run->samples.step_length, t1, &run->motion);
    if (!status && run->samples.batch->has_works)
        status = integrate_work_of_step(run, &before, &run->motion, get_current_works(&run->samples));
    return status ? status : accept_kinematic_step(run);
}

/*
 * Return whether a run has an outlier: the largest |a| of a sample may be more than OUTLIER_RATIO times the median of
 * all samples.
 */
static int has_acceleration_outlier(const RunSamples *samples)
{
    long n_small = 0;
    if (samples->largest_a <= OUTLIER_RATIO * samples->smallest_a)
        return 0;
    for (long k = 0; k < samples->n; k++)
        n_small += OUTLIER_RATIO * samples->largest[k] <= samples->largest_a;
    return 2 * n_small >= samples->n;
}

/*
 * Return whether a check of the audit finds an error beyond its limit in one of the drawn samples of run i, or in one
 * of all samples if these are not more than the draws. Errors that are NaN or infinite do not count: other checks
 * report them.
 */
static int has_audit_finding(const KinematicBatch *batch, long i, const RunSamples *samples)
{
    const double no_memory[AT_LEAST_ONE(N_DISCRETE)] = {NAN};
    const long n_drawn = batch->n_drawn < samples->n ? batch->n_drawn : samples->n;
    for (long j = 0; j < n_drawn; j++) {
        const long k = batch->n_drawn < samples->n ? (long)((double)samples->n * batch->drawn[j]) : j;
        const double *y = samples->y + k * N_S;
        double error[4];
        gudgeon_audit_samples(1, samples->t + k, y, y + N_Q, no_memory, batch->p + i * batch->numbers, batch->size[i],
            error);
        for (int check = 0; check < 4; check++)
            if (error[check] > batch->limit[check] && error[check] < INFINITY) /* others are of another check */
                return 1;
    }
    return 0;
}

/*
 * End run i: write its counts, residuals, status and phase into the batch. is_suspect is set if Python must check the
 * run: a failure, an ill-conditioned start, an interpolated sample, a value that is not finite, an acceleration
 * outlier, or a finding of the audit. A run that was stopped before its first sample becomes NEW again.
 */
static void end_kinematic_run(const KinematicBatch *batch, long i, KinematicRun *run, int status)
{
    const RunSamples *samples = &run->samples;
    batch->n_interpolated[i] = gudgeon_kinematic_count_interpolated(run, batch->t_interpolated + i);
    batch->is_suspect[i] = status || !samples->are_finite || run->is_start_ill_conditioned || run->n_interpolated
        || has_acceleration_outlier(samples) || has_audit_finding(batch, i, samples);
    batch->done[i] = samples->done;
    if (samples->done) {
        batch->t_last[i] = samples->t[samples->done - 1];
        batch->residuals[i * N_RESIDUALS + RESIDUAL_phi_max] = samples->phi_max;
        batch->residuals[i * N_RESIDUALS + RESIDUAL_phi_dot_max] = samples->phi_dot_max;
    }
    batch->counts[i * N_COUNTS + COUNT_steps] = samples->steps;
    batch->seconds[i] = read_clock() - samples->began;
    const int has_begun = status != STOPPED || samples->done;
    batch->status[i] = has_begun ? status : 0;
    batch->phase[i] = has_begun ? OVER : NEW;
}

/*
 * Compute n runs of a batch, whose indices are given, one after the other, in the memory `analysis`. Runs whose phase
 * is not NEW are skipped. If the batch is ending, the current run ends at once, and no run begins.
 */
void gudgeon_kinematic_ensemble(const void *batch_data, void *analysis, long n, const long *indices)
{
    const KinematicBatch *batch = batch_data;
    KinematicRun *run = analysis;
    for (long k = 0; k < n && !*batch->ending; k++) {
        if (batch->phase[indices[k]] != NEW)
            continue;
        int status = begin_kinematic_run(batch, indices[k], run);
        while (!status && run->samples.done < run->samples.n)
            status = advance_run(run);
        end_kinematic_run(batch, indices[k], run, status);
    }
}
#if HAS_LANES

/*
 * Return the table of function pointers (KinematicRunFunctions) of a single kinematic run that a library of lanes
 * calls.
 */
const void *gudgeon_single_run_functions(void)
{
    static const KinematicRunFunctions single = {begin_kinematic_run, advance_run, end_kinematic_run, detect_stall,
        count_steps_before_check, has_undersampled_transient};
    return &single;
}
#endif
