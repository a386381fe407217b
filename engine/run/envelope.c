/* The envelope of forces and paths of joints with play: a bounded number of rows (EnvelopeRow) covers all steps. */
/* Extend the smallest and largest force of joint i in the current row by F (N) at time t (s). */
static void extend_force_envelope(Integrator *run, int i, double t, double F)
{
    double *columns = run->envelope.rows[run->envelope.row].joint[i];
    if (F < columns[ENVELOPE_F_low]) {
        columns[ENVELOPE_F_low] = F;
        columns[ENVELOPE_t_F_low] = t;
    }
    if (F > columns[ENVELOPE_F_high]) {
        columns[ENVELOPE_F_high] = F;
        columns[ENVELOPE_t_F_high] = t;
    }
}

/* Store the position of joint i's journal at time t as the outermost one of the current row, if it is. */
static void extend_path_envelope(Integrator *run, int i, double t, const Clearance *joint)
{
    double *columns = run->envelope.rows[run->envelope.row].joint[i];
    if (!(joint->e * joint->e
            > columns[ENVELOPE_ex_out] * columns[ENVELOPE_ex_out]
                + columns[ENVELOPE_ey_out] * columns[ENVELOPE_ey_out]))
        return;
    columns[ENVELOPE_ex_out] = joint->ex;
    columns[ENVELOPE_ey_out] = joint->ey;
    columns[ENVELOPE_t_out] = t;
}

/* Start the current row of the envelope without steps. */
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

/* Merge row a and the following row b into row `to`. */
static void merge_envelope_rows(EnvelopeRow *to, const EnvelopeRow *a, const EnvelopeRow *b)
{
    EnvelopeRow both = *b;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const double *first = a->joint[i];
        double *columns = both.joint[i];
        if (first[ENVELOPE_F_low] <= columns[ENVELOPE_F_low]) {
            columns[ENVELOPE_F_low] = first[ENVELOPE_F_low];
            columns[ENVELOPE_t_F_low] = first[ENVELOPE_t_F_low];
        }
        if (first[ENVELOPE_F_high] >= columns[ENVELOPE_F_high]) {
            columns[ENVELOPE_F_high] = first[ENVELOPE_F_high];
            columns[ENVELOPE_t_F_high] = first[ENVELOPE_t_F_high];
        }
        if (hypot(first[ENVELOPE_ex_out], first[ENVELOPE_ey_out])
            >= hypot(columns[ENVELOPE_ex_out], columns[ENVELOPE_ey_out])) {
            columns[ENVELOPE_ex_out] = first[ENVELOPE_ex_out];
            columns[ENVELOPE_ey_out] = first[ENVELOPE_ey_out];
            columns[ENVELOPE_t_out] = first[ENVELOPE_t_out];
        }
    }
    *to = both;
}

/* Extend the envelope by the present state as the end of a step. A full envelope is halved and its stride doubled. */
static void extend_envelope(Integrator *run)
{
    EnvelopeRow *row = &run->envelope.rows[run->envelope.row];
    row->t = run->t;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Clearance *joint = &run->rhs.clearance[i];
        double *columns = row->joint[i];
        extend_force_envelope(run, i, run->t, total_force(joint));
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

/* Start the envelope of a run in memory for an even number of rows. */
static void start_envelope(Integrator *run, EnvelopeRow *trace, long rows)
{
    run->envelope.rows = trace;
    run->envelope.n_rows = rows;
    run->envelope.stride = 1;
    begin_envelope_row(run);
}

/* Return the number of rows so far; the last row may cover fewer steps than the others. */
static long count_envelope_rows(const Integrator *run) { return run->envelope.row + (run->envelope.steps > 0); }
