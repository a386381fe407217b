/*
 * What a picture needs of every step (TraceRow): kept while the run goes on.
 */
/* A force of joint i, at an end of a step or within it. */
static void trace_force(Run *run, int i, double t, double F)
{
    Trail *trail = &run->trace[run->trace_row].joint[i];
    if (F < trail->F_low) {
        trail->F_low = F;
        trail->t_low = t;
    }
    if (F > trail->F_high) {
        trail->F_high = F;
        trail->t_high = t;
    }
}

/* The same of a place, if it is the row's outermost. */
static void trace_place(Run *run, int i, double t, const Clearance *joint)
{
    Trail *trail = &run->trace[run->trace_row].joint[i];
    if (!(joint->e * joint->e > trail->x_out * trail->x_out + trail->y_out * trail->y_out))
        return;
    trail->x_out = joint->ex;
    trail->y_out = joint->ey;
    trail->t_out = t;
}

static void begin_trace_row(Run *run)
{
    run->trace_steps = 0;
    for (int i = 0; i < N_CLEARANCES; i++)
        run->trace[run->trace_row].joint[i] = (Trail){.F_low = INFINITY, .F_high = -INFINITY, .t_out = run->t};
}

/* Row b, which follows a, becomes part of it. */
static void join_rows(TraceRow *to, const TraceRow *a, const TraceRow *b)
{
    TraceRow both = *b;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Trail *first = &a->joint[i];
        Trail *trail = &both.joint[i];
        if (first->F_low <= trail->F_low) {
            trail->F_low = first->F_low;
            trail->t_low = first->t_low;
        }
        if (first->F_high >= trail->F_high) {
            trail->F_high = first->F_high;
            trail->t_high = first->t_high;
        }
        if (hypot(first->x_out, first->y_out) >= hypot(trail->x_out, trail->y_out)) {
            trail->x_out = first->x_out;
            trail->y_out = first->y_out;
            trail->t_out = first->t_out;
        }
    }
    *to = both;
}

/* The present state as the end of a step. */
static void trace_step(Run *run)
{
    TraceRow *row = &run->trace[run->trace_row];
    row->t = run->t;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Clearance *joint = &run->aside.clearance[i];
        Trail *trail = &row->joint[i];
        trace_force(run, i, run->t, total_force(joint));
        trace_place(run, i, run->t, joint);
        trail->x = joint->ex;
        trail->y = joint->ey;
    }
    if (++run->trace_steps < run->trace_stride)
        return;
    if (++run->trace_row == run->trace_rows) {
        run->trace_row /= 2;
        run->trace_stride *= 2;
        for (long i = 0; i < run->trace_row; i++)
            join_rows(run->trace + i, run->trace + 2 * i, run->trace + 2 * i + 1);
    }
    begin_trace_row(run);
}

/* Room for the trace of a run that is about to begin: an even number of rows. */
void gudgeon_run_trace(void *memory, double *trace, long rows)
{
    Run *run = memory;
    run->trace = (TraceRow *)trace;
    run->trace_rows = rows;
    run->trace_stride = 1;
    begin_trace_row(run);
}

/* Rows of the trace so far; the last one may tell of fewer steps than the others. */
long gudgeon_run_traced(const void *memory)
{
    const Run *run = memory;
    return run->trace_row + (run->trace_steps > 0);
}

