/* The envelope of forces and paths of joints with play: a bounded number of rows (EnvelopeRow) covers all steps. */
/*
 * Extend the smallest and largest force of a joint in the current row of the envelope by F (N) at time t (s). Called at
 * ends of steps and, by record_force(), at evaluations between them.
 */
static void extend_force_envelope(Integrator *run, int joint, double t, double F)
{
    double *columns = run->envelope.rows[run->envelope.row].joint[joint];
    if (F < columns[ENVELOPE_F_low]) {
        columns[ENVELOPE_F_low] = F;
        columns[ENVELOPE_t_F_low] = t;
    }
    if (F > columns[ENVELOPE_F_high]) {
        columns[ENVELOPE_F_high] = F;
        columns[ENVELOPE_t_F_high] = t;
    }
}

/*
 * Store the position of a joint's journal (ex, ey in m) at time t (s) in the current row of the envelope. Nothing
 * happens unless its eccentricity is the largest of that row.
 */
static void extend_path_envelope(Integrator *run, int joint, double t, const Clearance *clearance)
{
    double *columns = run->envelope.rows[run->envelope.row].joint[joint];
    if (!(clearance->e * clearance->e
            > columns[ENVELOPE_ex_out] * columns[ENVELOPE_ex_out]
                + columns[ENVELOPE_ey_out] * columns[ENVELOPE_ey_out]))
        return;
    columns[ENVELOPE_ex_out] = clearance->ex;
    columns[ENVELOPE_ey_out] = clearance->ey;
    columns[ENVELOPE_t_out] = t;
}

/*
 * Initialize the current row of the envelope, which covers no steps yet: smallest force infinite, largest -infinite,
 * eccentricity zero at the current time.
 */
static void begin_envelope_row(Integrator *run)
{
    run->envelope.steps = 0;
    for (int i = 0; i < N_CLEARANCES; i++) {
        double *columns = run->envelope.rows[run->envelope.row].joint[i];
        memset(columns, 0, N_ENVELOPE_COLUMNS * sizeof columns[0]);
        columns[ENVELOPE_F_low] = INFINITY;
        columns[ENVELOPE_F_high] = -INFINITY;
        columns[ENVELOPE_t_out] = run->t;
    }
}

/*
 * Merge two successive rows of the envelope into `merged_row`, which may be one of them: extremes of both, end position
 * and time of the second. Of equal extremes the first is kept.
 */
static void merge_envelope_rows(EnvelopeRow *merged_row, const EnvelopeRow *first_row, const EnvelopeRow *second_row)
{
    EnvelopeRow result = *second_row;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const double *from = first_row->joint[i];
        double *columns = result.joint[i];
        if (from[ENVELOPE_F_low] <= columns[ENVELOPE_F_low]) {
            columns[ENVELOPE_F_low] = from[ENVELOPE_F_low];
            columns[ENVELOPE_t_F_low] = from[ENVELOPE_t_F_low];
        }
        if (from[ENVELOPE_F_high] >= columns[ENVELOPE_F_high]) {
            columns[ENVELOPE_F_high] = from[ENVELOPE_F_high];
            columns[ENVELOPE_t_F_high] = from[ENVELOPE_t_F_high];
        }
        if (hypot(from[ENVELOPE_ex_out], from[ENVELOPE_ey_out])
            >= hypot(columns[ENVELOPE_ex_out], columns[ENVELOPE_ey_out])) {
            columns[ENVELOPE_ex_out] = from[ENVELOPE_ex_out];
            columns[ENVELOPE_ey_out] = from[ENVELOPE_ey_out];
            columns[ENVELOPE_t_out] = from[ENVELOPE_t_out];
        }
    }
    *merged_row = result;
}

/*
 * Extend the current row of the envelope by the current state, the end of a step, and begin the next row after `stride`
 * steps. If no row is left, each two rows are merged, the stride is doubled, and the row index is halved. Called at
 * each accepted state of a run with an envelope.
 */
static void extend_envelope(Integrator *run)
{
    EnvelopeRow *current = &run->envelope.rows[run->envelope.row];
    current->t = run->t;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Clearance *joint = &run->rhs.clearance[i];
        double *columns = current->joint[i];
        extend_force_envelope(run, i, run->t, compute_force_magnitude(joint));
        extend_path_envelope(run, i, run->t, joint);
        columns[ENVELOPE_ex] = joint->ex;
        columns[ENVELOPE_ey] = joint->ey;
    }
    if (++run->envelope.steps < run->envelope.stride)
        return;
    if (++run->envelope.row == run->envelope.n_rows) {
        run->envelope.row /= 2;
        run->envelope.stride *= 2;
        for (long i = 0; i < run->envelope.row; i++)
            merge_envelope_rows(run->envelope.rows + i, run->envelope.rows + 2 * i, run->envelope.rows + 2 * i + 1);
    }
    begin_envelope_row(run);
}

/* Start the envelope of a run in memory for n_rows rows, an even number. */
static void start_envelope(Integrator *run, EnvelopeRow *rows, long n_rows)
{
    run->envelope.rows = rows;
    run->envelope.n_rows = n_rows;
    run->envelope.stride = 1;
    begin_envelope_row(run);
}

/*
 * Return the number of rows so far, including the current one if it has steps; the last row may cover fewer steps than
 * the others.
 */
static long count_envelope_rows(const Integrator *run) { return run->envelope.row + (run->envelope.steps > 0); }
