/*
 * The tape: states along a run for what looks at every step (peaks of any series), the ends of steps and places between
 * them, in rows that Python fetches. Where something jumps both its sides are there, right beside it.
 */
enum {
    TAPE_ROW = N_TAPE_HEAD + N_S + AT_LEAST_ONE(N_DISCRETE) + AT_LEAST_ONE(N_CLEARANCES), /* numbers in a row */
    TAPE_PARTS = 4,             /* of a step of a method that chooses it */
    TAPE_SPARE = 4 * TAPE_PARTS /* rows that a step needs at most */
};
#define BESIDE 1e-9 /* of a step, that a place right beside a jump is away from it */

/* Whether the next step may find no room for its rows. */
static int is_record_full(const Integrator *run)
{
    return run->step_record.rows && run->step_record.n > run->step_record.capacity - TAPE_SPARE;
}

/* A state of the run: whether something jumped since the row before, t, the state of all bodies, memory, codes. */
static void record_state(Integrator *run, double t, const double *y, const Parameters *p)
{
    StepRecord *step_record = &run->step_record;
    signed char state[AT_LEAST_ONE(N_CLEARANCES)] = {0};
    if (!step_record->rows || step_record->n >= step_record->capacity)
        return;
    double *row = step_record->rows + TAPE_ROW * step_record->n++, *discrete = row + N_TAPE_HEAD + N_S;
    row[TAPE_JUMPED] = step_record->jumped;
    row[TAPE_T] = t;
    store_sample(run, t, y, p, 0, row + N_TAPE_HEAD, discrete, state);
    for (int i = 0; i < N_CLEARANCES; i++)
        discrete[AT_LEAST_ONE(N_DISCRETE) + i] = state[i];
    step_record->jumped = 0;
}

static void mark_jump(Integrator *run, int jumped) { run->step_record.jumped |= jumped; }

/* The present state, behind something that changed. */
static void record_after_jump(Integrator *run, const Parameters *p)
{
    run->step_record.jumped = 1;
    record_state(run, run->t, run->y, p);
}

/* Room for so many rows, at least a few steps' worth. */
void gudgeon_run_record(void *integrator, double *rows, long capacity)
{
    ((Integrator *)integrator)->step_record = (StepRecord){.rows = rows, .capacity = capacity, .jumped = 1};
}

/* Rows since the last call; the next one is written to the first place. */
long gudgeon_run_recorded(void *integrator)
{
    Integrator *run = integrator;
    const long n = run->step_record.n;
    run->step_record.n = 0;
    return n;
}
