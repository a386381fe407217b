/*
 * What a picture needs of every step (EnvelopeRow): kept while the run goes on.
 */
/* A force of joint i, at an end of a step or within it. */
static void extend_force_envelope(Integrator *run, int i, double t, double F)
{
    double *trail = run->envelope.rows[run->envelope.row].joint[i];
    if (F < trail[TRACE_F_low]) {
        trail[TRACE_F_low] = F;
        trail[TRACE_t_F_low] = t;
    }
    if (F > trail[TRACE_F_high]) {
        trail[TRACE_F_high] = F;
        trail[TRACE_t_F_high] = t;
    }
}

/* The same of a place, if it is the row's outermost. */
static void extend_path_envelope(Integrator *run, int i, double t, const Clearance *joint)
{
    double *trail = run->envelope.rows[run->envelope.row].joint[i];
    if (!(joint->e * joint->e > trail[TRACE_ex_out] * trail[TRACE_ex_out] + trail[TRACE_ey_out] * trail[TRACE_ey_out]))
        return;
    trail[TRACE_ex_out] = joint->ex;
    trail[TRACE_ey_out] = joint->ey;
    trail[TRACE_t_out] = t;
}

static void begin_envelope_row(Integrator *run)
{
    run->envelope.steps = 0;
    for (int i = 0; i < N_CLEARANCES; i++) {
        double *trail = run->envelope.rows[run->envelope.row].joint[i];
        memset(trail, 0, N_TRACE_COLUMNS * sizeof trail[0]);
        trail[TRACE_F_low] = INFINITY;
        trail[TRACE_F_high] = -INFINITY;
        trail[TRACE_t_out] = run->t;
    }
}

/* Row b, which follows a, becomes part of it. */
static void merge_envelope_rows(EnvelopeRow *to, const EnvelopeRow *a, const EnvelopeRow *b)
{
    EnvelopeRow both = *b;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const double *first = a->joint[i];
        double *trail = both.joint[i];
        if (first[TRACE_F_low] <= trail[TRACE_F_low]) {
            trail[TRACE_F_low] = first[TRACE_F_low];
            trail[TRACE_t_F_low] = first[TRACE_t_F_low];
        }
        if (first[TRACE_F_high] >= trail[TRACE_F_high]) {
            trail[TRACE_F_high] = first[TRACE_F_high];
            trail[TRACE_t_F_high] = first[TRACE_t_F_high];
        }
        if (hypot(first[TRACE_ex_out], first[TRACE_ey_out]) >= hypot(trail[TRACE_ex_out], trail[TRACE_ey_out])) {
            trail[TRACE_ex_out] = first[TRACE_ex_out];
            trail[TRACE_ey_out] = first[TRACE_ey_out];
            trail[TRACE_t_out] = first[TRACE_t_out];
        }
    }
    *to = both;
}

/* The present state as the end of a step. */
static void extend_envelope(Integrator *run)
{
    EnvelopeRow *row = &run->envelope.rows[run->envelope.row];
    row->t = run->t;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Clearance *joint = &run->rhs.clearance[i];
        double *trail = row->joint[i];
        extend_force_envelope(run, i, run->t, total_force(joint));
        extend_path_envelope(run, i, run->t, joint);
        trail[TRACE_ex] = joint->ex;
        trail[TRACE_ey] = joint->ey;
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

/* Room for the trace of a run that is about to begin: an even number of rows. */
static void start_envelope(Integrator *run, EnvelopeRow *trace, long rows)
{
    run->envelope.rows = trace;
    run->envelope.n_rows = rows;
    run->envelope.stride = 1;
    begin_envelope_row(run);
}

/* Rows of the trace so far; the last one may tell of fewer steps than the others. */
static long count_envelope_rows(const Integrator *run) { return run->envelope.row + (run->envelope.steps > 0); }
