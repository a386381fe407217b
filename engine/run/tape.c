/*
 * The tape: states along a run for what looks at every step (peaks of any series), the ends of steps and places between
 * them, in rows that Python fetches. Where something jumps both its sides are there, right beside it.
 */
enum {
    TAPE_ROW = N_TAPE_HEAD + N_S + AT_LEAST_ONE(N_MEMORY) + AT_LEAST_ONE(N_CLEARANCES), /* numbers in a row */
    TAPE_PARTS = 4,             /* of a step of a method that chooses it */
    TAPE_SPARE = 4 * TAPE_PARTS /* rows that a step needs at most */
};
#define BESIDE 1e-9 /* of a step, that a place right beside a jump is away from it */

/* Whether the next step may find no room for its rows. */
static int tape_full(const Run *run) { return run->tape.rows && run->tape.n > run->tape.capacity - TAPE_SPARE; }

/* A state of the run: whether something jumped since the row before, t, the state of all bodies, memory, codes. */
static void tape_row(Run *run, double t, const double *y, const Parameters *p)
{
    Tape *tape = &run->tape;
    signed char state[AT_LEAST_ONE(N_CLEARANCES)] = {0};
    if (!tape->rows || tape->n >= tape->capacity)
        return;
    double *row = tape->rows + TAPE_ROW * tape->n++, *memory = row + N_TAPE_HEAD + N_S;
    row[TAPE_JUMPED] = tape->jumped;
    row[TAPE_T] = t;
    store_sample(run, t, y, p, 0, row + N_TAPE_HEAD, memory, state);
    for (int i = 0; i < N_CLEARANCES; i++)
        memory[AT_LEAST_ONE(N_MEMORY) + i] = state[i];
    tape->jumped = 0;
}

static void mark_jump(Run *run, int jumped) { run->tape.jumped |= jumped; }

/* The present state, behind something that changed. */
static void tape_jump(Run *run, const Parameters *p)
{
    run->tape.jumped = 1;
    tape_row(run, run->t, run->y, p);
}

/* Room for so many rows, at least a few steps' worth. */
void gudgeon_run_tape(void *memory, double *rows, long capacity)
{
    ((Run *)memory)->tape = (Tape){.rows = rows, .capacity = capacity, .jumped = 1};
}

/* Rows since the last call; the next one is written to the first place. */
long gudgeon_run_taped(void *memory)
{
    Run *run = memory;
    const long n = run->tape.n;
    run->tape.n = 0;
    return n;
}
