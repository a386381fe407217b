/*
 * The step record: states along a run for peaks of any series, in rows that Python fetches. Rows are the ends of steps
 * and points between them. At a jump there are two rows, just before and just after.
 */
enum {
    RECORD_ROW = N_RECORD_HEAD + N_S + AT_LEAST_ONE(N_DISCRETE) + AT_LEAST_ONE(N_CLEARANCES), /* numbers in a row */
    RECORD_INTERVALS = 4,             /* parts of a step, whose ends are recorded */
    MAX_ROWS_PER_STEP = 4 * RECORD_INTERVALS /* largest number of rows of one step */
};
#define JUMP_OFFSET 1e-9 /* of a step: distance of the rows just before and after a jump */

/* Return whether the step record may lack space for the rows of the next step; 0 without a record. */
static int is_record_full(const Integrator *run)
{
    return run->step_record.rows && run->step_record.n > run->step_record.capacity - MAX_ROWS_PER_STEP;
}

/*
 * Append a row with a state y at time t (s) to the step record: jump mark, t, state of all bodies, discrete state,
 * contact codes. Then clear the jump mark. Nothing happens without a record or if it is full.
 */
static void append_record_row(Integrator *run, double t, const double *y, const Parameters *p)
{
    StepRecord *step_record = &run->step_record;
    signed char contact_codes[AT_LEAST_ONE(N_CLEARANCES)] = {0};
    if (!step_record->rows || step_record->n >= step_record->capacity)
        return;
    double *row = step_record->rows + RECORD_ROW * step_record->n++, *discrete = row + N_RECORD_HEAD + N_S;
    row[RECORD_JUMPED] = step_record->jumped;
    row[RECORD_T] = t;
    store_sample(run, t, y, p, 0, row + N_RECORD_HEAD, discrete, contact_codes);
    for (int i = 0; i < N_CLEARANCES; i++)
        discrete[AT_LEAST_ONE(N_DISCRETE) + i] = contact_codes[i];
    step_record->jumped = 0;
}

/* If `jumped`, mark that something jumped before the next row of the step record; 0 leaves an earlier mark. */
static void mark_jump_before_next_row(Integrator *run, int jumped) { run->step_record.jumped |= jumped; }

/*
 * Append a row with the current state to the step record, marked as the state just after a jump. Called when a run
 * begins or is resumed.
 */
static void append_row_after_jump(Integrator *run, const Parameters *p)
{
    run->step_record.jumped = 1;
    append_record_row(run, run->t, run->y, p);
}

/*
 * Start the step record in the caller's memory `rows` for `capacity` rows, at least MAX_ROWS_PER_STEP. Its first row is
 * marked as a jump. rows NULL: no record.
 */
void gudgeon_run_set_record_buffer(void *integrator, double *rows, long capacity)
{
    ((Integrator *)integrator)->step_record = (StepRecord){.rows = rows, .capacity = capacity, .jumped = 1};
}

/*
 * Return the number of rows recorded since the last call, and continue to record from the first row of the memory: the
 * caller must read the rows first.
 */
long gudgeon_run_recorded(void *integrator)
{
    Integrator *run = integrator;
    const long count = run->step_record.n;
    run->step_record.n = 0;
    return count;
}
