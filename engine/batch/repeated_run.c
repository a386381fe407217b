/*
 * A run that is repeated with other parameter values, in one call: parameters, tolerances, start, integration, audit of
 * samples and requested series. Arrays and tables are those of a RepeatedRun, which Python fills once. Read ensemble.c
 * first, whose time loop integrates the run.
 */

/* Return the size of the mechanism in m: the largest distance of a point from its body's origin; 1 if it is 0. */
static double compute_mechanism_size(const ToleranceTable *table, const double *p)
{
    double largest = 0.0;
    for (long i = 0; i < table->n_points; i++) {
        const long *point = table->points + 2 * i;
        const double x = p[point[0]], y = point[1] >= 0 ? p[point[1]] : 0.0, square = x * x + y * y;
        if (square > largest)
            largest = square;
    }
    return largest > 0.0 ? sqrt(largest) : 1.0;
}

/* Return the radial clearance in m, a row of table->clearances, at the shallowest point of its contour. */
static double compute_min_clearance(const long *clearance, const double *p)
{
    double depth = clearance[2] ? INFINITY : 0.0;
    for (long k = clearance[1]; k < clearance[1] + clearance[2]; k++)
        depth = p[k] < depth ? p[k] : depth;
    return p[clearance[0]] + depth;
}

/*
 * Compute the error tolerances of a run from its parameters p: `scale` (2 n_coordinates, at least 1), min_size (L, L/S)
 * and `size` S in m; see adaptive.py. Return whether all clearances are large enough for doubles.
 */
int gudgeon_compute_tolerances(const ToleranceTable *table, const double *p, double *scale, double *min_size,
    double *size)
{
    const double S = compute_mechanism_size(table, p);
    const long n = table->n_coordinates;
    double L = INFINITY;
    int is_resolved = 1;
    for (long i = 0; i < table->n_clearances; i++) {
        const double c = p[table->clearances[3 * i]];
        const double min_clearance = compute_min_clearance(table->clearances + 3 * i, p);
        is_resolved = is_resolved && !(min_clearance < table->min_relative_clearance * S);
        L = c > 0.0 && c < L ? c : L;
    }
    L = L < INFINITY ? L : S;
    const double ratio = L / S, film_error = table->max_film_speed_error * L / S;
    for (long k = 0; k < n; k++) {
        scale[k] = table->is_angle[k] ? table->rtol * ratio : table->rtol * L;
        scale[n + k] = film_error < table->rtol ? film_error : table->rtol;
    }
    if (!n)
        scale[0] = table->rtol;
    min_size[0] = L;
    min_size[1] = ratio;
    *size = S;
    return is_resolved;
}

/*
 * Set the parameters of row i from the values x, or check those in the row if x is NULL, and compute its tolerances.
 * Return whether the parameters are valid.
 */
int gudgeon_set_repeated_run(const RepeatedRun *repeated, long i, const double *x)
{
    const Batch *batch = repeated->batch;
    double *p = batch->p + i * batch->numbers, *p_motion = batch->p_motion + i * batch->numbers;
    return gudgeon_set_parameters(repeated->parameters, x, p, p_motion)
        && gudgeon_compute_tolerances(repeated->tolerances, p, batch->scale + i * AT_LEAST_ONE(2 * N_X),
            batch->min_size + 2 * i, batch->size + i);
}

/* Return whether the position to resume from in row i violates no constraint equation by more than max_violation. */
static int is_position_consistent(const RepeatedRun *repeated, long i)
{
    const Batch *batch = repeated->batch;
    double phi[AT_LEAST_ONE(N_ALL_ROWS)];
    constraints(get_sample_times(batch, i)[0], batch->start + i * 2 * N_Q,
        (const Parameters *)(batch->p + i * batch->numbers), phi);
    for (int r = 0; r < N_ROWS; r++) {
        const int row = motion_row[r];
        if (!(fabs(phi[row]) <= repeated->max_violation * (row_is_length[row] ? batch->size[i] : 1.0)))
            return 0;
    }
    return 1;
}

/* Integrate row i of the batch from start to end; full lists of contacts and events are discarded. */
static void integrate_repeated_run(const Batch *batch, Integrator *run, long i)
{
    long current = i;
    batch->phase[i] = NEW;
    batch->done[i] = batch->checked[i] = 0;
    while (current == i) {
        const int result = gudgeon_ensemble(batch, run, &current, i + 1);
        if (result == RUN_ENDED)
            return;
        if (result == BUFFERS_FULL) {
            discard_contacts(run);
            discard_user_events(run);
        }
    }
}

/*
 * Audit samples of row i that has ended by gudgeon_audit_samples(): the drawn ones, or all if there are no more. In a
 * short run every second one is drawn. A state to resume from is not audited if there are other samples. Return whether
 * an error exceeds its limit; errors that are not finite are found by other checks.
 */
static int has_unconfirmed_sample(const RepeatedRun *repeated, long i)
{
    const Batch *batch = repeated->batch;
    const long n = batch->done[i], first = get_first_row(batch, i);
    const int is_short = batch->audit <= AUDIT_ON
        && batch->counts[N_COUNTS * i + COUNT_right_hand_sides] <= repeated->max_calls_of_short_run;
    const long stride = is_short ? 2 : 1, n_drawn = 8 / stride, n_audited = n_drawn < n ? n_drawn : n;
    for (long j = 0; batch->audit && j < n_audited; j++) {
        const long k = n_drawn < n ? (long)((double)n * repeated->drawn[stride * j]) : j;
        const double *y = batch->y + (first + k) * N_S;
        double error[4];
        if (repeated->is_resumed && k == 0 && n > 1)
            continue;
        gudgeon_audit_samples(1, get_sample_times(batch, i) + k, y, y + N_Q,
            batch->discrete_states + (first + k) * AT_LEAST_ONE(N_DISCRETE), batch->p_motion + i * batch->numbers,
            batch->size[i], error);
        for (int check = 0; check < 4; check++)
            if (error[check] > repeated->limit[check] && error[check] < INFINITY)
                return 1;
    }
    return 0;
}

/* Evaluate all samples of row i. Return a status. */
static int evaluate_repeated_run(const RepeatedRun *repeated, long i)
{
    static const long width[10] = {N_Q, N_ROWS, N_REACTION_COLUMNS * N_REACTIONS, N_DRIVES,
        N_CLEARANCE_COLUMNS * N_CLEARANCES, N_SERIES, N_FRICTION_COLUMNS * N_FRICTIONS, N_ENERGY, N_WORK, N_DRIFT};
    const Batch *batch = repeated->batch;
    const long first = get_first_row(batch, i);
    int status = 0;
    for (long k = 0; !status && k < batch->samples; k++) {
        const double *y = batch->y + (first + k) * N_S;
        double *to[10];
        long failed_sample;
        for (int part = 0; part < 10; part++)
            to[part] = repeated->evaluated[part] ? repeated->evaluated[part] + k * width[part] : NULL;
        status = gudgeon_evaluate(1, get_sample_times(batch, i) + k, y, y + N_Q,
            batch->discrete_states + (first + k) * AT_LEAST_ONE(N_DISCRETE), batch->p_motion + i * batch->numbers,
            to[0], to[1], to[2], to[3], to[4], to[5], to[6], to[7], to[8], to[9], &failed_sample);
    }
    return status;
}

/*
 * Store the series of row i in repeated->values, but those that Python computes. Return SERIES_READ, or SERIES_UNREAD
 * if the run has ended early or a sample cannot be evaluated.
 */
static int read_repeated_run(const RepeatedRun *repeated, long i)
{
    const Batch *batch = repeated->batch;
    const int is_complete = batch->done[i] == batch->samples && !batch->status[i];
    if (!repeated->is_read || !is_complete || (repeated->is_evaluated && evaluate_repeated_run(repeated, i)))
        return SERIES_UNREAD;
    double *value = repeated->values;
    for (long j = 0; j < repeated->n_series; j++) {
        const double *column = repeated->columns[i * repeated->n_series + j];
        for (long k = repeated->n_skipped; k < batch->samples; k++, value++)
            if (column)
                *value = column[k * repeated->strides[j]];
    }
    return SERIES_READ;
}

/*
 * Integrate the run in row i with the parameter values repeated->x, audit samples, and store its series. stage
 * (RepeatStage): what the caller has done before. Return a RepeatResult; the batch has the status of a failed run.
 */
int gudgeon_repeat_run(const RepeatedRun *repeated, void *integrator, long i, int stage)
{
    const Batch *batch = repeated->batch;
    if (stage == SET_PARAMETERS && !gudgeon_set_repeated_run(repeated, i, repeated->x))
        return NOT_VALID;
    if (stage < INTEGRATE && repeated->is_resumed && !is_position_consistent(repeated, i))
        return NOT_FITTING;
    integrate_repeated_run(batch, integrator, i);
    if (batch->status[i] && batch->status[i] != ENDED)
        return RUN_FAILED;
    return has_unconfirmed_sample(repeated, i) ? NOT_CONFIRMED : read_repeated_run(repeated, i);
}

/* Make the last sample of the run in row 0 the state from which the next one resumes. */
void gudgeon_resume_from_end(const RepeatedRun *repeated)
{
    const Batch *batch = repeated->batch;
    const long row = get_first_row(batch, 0) + batch->done[0] - 1;
    memcpy(batch->start, batch->y + row * N_S, 2 * N_Q * sizeof(double));
    memcpy(batch->initial_discrete_states, batch->discrete_states + row * AT_LEAST_ONE(N_DISCRETE),
        AT_LEAST_ONE(N_DISCRETE) * sizeof(double));
    memcpy(batch->codes, batch->state + row * AT_LEAST_ONE(N_CLEARANCES), AT_LEAST_ONE(N_CLEARANCES));
}
