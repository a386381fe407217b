/*
 * A run: the state that a method moves forward, and what is watched on the way: onsets and separations of
 * joints with play, peaks, residuals.
 */
enum {
    N_IMPACTS = 256, MAX_PARTS = 50,
    NOT_FINITE = -2, EVENTS_FULL = -3, CHATTERING = -4, TOO_SMALL = -5, LOST = -6, ENDED = -7, OUTSIDE = -8
};

typedef struct {
    double t_on, t_off, deltadot, F_peak, t_peak;
    int joint;
} Impact;

/*
 * What a picture needs of every step, in bounded room: a row tells of `stride` steps in a row; where the room is used
 * up, two rows become one. Of each joint with play the least and the largest force and when, where the journal was
 * furthest out and when, and where it was at the end of the row.
 */
typedef struct {
    double F_low, t_low, F_high, t_high, x_out, y_out, t_out, x, y; /* N, s, m: in this order for Python's Trace */
} Trail;

typedef struct {
    double t; /* end of the row's last step */
    Trail joint[1];
} TraceRow;

/* A step that was tried: contacts and the sides of corners are held while it is made. */
enum {
    N_MARGINS = N_CLEARANCES + N_SWITCHES + N_FRICTIONS + N_USER_EVENTS, /* what may end a step, in this order */
    N_STAGES = 16, N_DENSE = 7, N_WATCHED = 0, N_LOOKS = 16
};

typedef struct {
    double t, h, error;
    double y[N_Y], dy[N_Y];                  /* at the end */
    Aside aside;
    double k[N_STAGES][N_Y];                 /* rates or increments of the stages */
    double dense[N_DENSE][N_Y];
    int dense_ready, stiff;
    int n_seen;                              /* stages so far, their nodes and margins */
    double node[N_STAGES], seen[N_STAGES][1];
    double look[1][N_LOOKS + 1]; /* margins of what is watched, evenly along the step (watched.c) */
    unsigned char passed[1]; /* corners that this step crosses without harm */
    double from[1], to[1], below[1]; /* where a zero of it was found */
    double least[2 * N_X + 1], most[2 * N_X + 1];   /* of the state at stages, where something is watched */
    unsigned char near[1], looked;
    double rate[1][2];   /* smallest and largest d delta/dt of the stages */
} Step;

/* What a step began with. */
typedef struct {
    double t, y[N_Y], dy[N_Y];
    int closed[1], compressing[1];
} Beginning;

static const unsigned char is_angle[] = {0, 0, 1};

typedef struct {
    double t, y[N_Y], dy[N_Y];
    Aside aside;
    Memory memory;
    Asked asked;
    Impact open[1];      /* the contact going on in each joint */
    int compressing[1];  /* from onset until the penetration first stops growing */
    double F_peak[1], t_peak[1], e_max[1];
    Impact impacts[N_IMPACTS];
    double event_t[N_IMPACTS];
    unsigned char no_number[1];  /* whether an event was told to be none */
    double tick; /* s, to which times of events are told apart; less where the whole run is short */
    int pole; /* whether the event that ends a step is no zero but a pole */
    int event[N_IMPACTS], n_events, stop; /* user events found; whether they may end the run */
    int n_impacts, ready;
    TraceRow *trace; /* nobody wants one: NULL; the row that is being filled, of `trace_rows`, and steps in it */
    long trace_row, trace_rows, trace_steps, trace_stride;
    Beginning from; /* of rk4's step, where samples lie within it */
    long steps, evaluations, onsets, grazes, ratio_outside, switches, rejected, jacobians, stiff_steps;
    double phi_max, phi_dot_max, ratio_min, ratio_max;
    /* of methods that choose their step (adaptive.c) */
    double h, fixed, accept, stability, error_before, h_first[2], *first, h_stiff, t_crossed, pace, inverse_scale[2 * N_X + 1], least[2], speed[2], speed_floor[2];
    double weight[N_Y]; /* what errors are multiplied by: 1 / tolerance */
    double work_scale, turned_over; /* tolerance of works as a share of the energy (J) that was turned over so far */
    int rising[1]; /* whether a joint's force rose at the end of the last step */
    Pace advance;
    long ended[N_MARGINS + 1]; /* steps that each margin ended, since the pace was taken */
    int crossed, skip, choice, stiff, votes, patience, since, stuck, crawl, linear_ready;
    Linear linear;
    Step step;
} Run;

static int rates(Run *run, double t, const double *y, const Parameters *p, double *dy, Aside *aside)
{
    run->evaluations++;
    if (given_up(&run->asked))
        return STOPPED;
    return motion(t, y, &run->memory, p, dy, aside);
}

/* Parameter s in [0, 1] at which the cubic through (d0, h r0) and (d1, h r1) crosses zero; its slope in `rate`. */
static double crossing(double d0, double r0, double d1, double r1, double h, double *rate)
{
    double low = 0.0, high = 1.0, s = 0.5;
    for (int i = 0; i < 60; i++) {
        s = 0.5 * (low + high);
        const double u = 1.0 - s;
        const double d = u * u * (1.0 + 2.0 * s) * d0 + s * u * u * h * r0 + s * s * (3.0 - 2.0 * s) * d1 - s * s * u * h * r1;
        if ((d >= 0.0) == (d1 >= 0.0))
            high = s;
        else
            low = s;
    }
    *rate = 6.0 * s * (1.0 - s) * (d1 - d0) / h + (1.0 - s) * (1.0 - 3.0 * s) * r0 + s * (3.0 * s - 2.0) * r1;
    return s;
}

/* Place in (0, 1) and height of the top of the cubic through (d0, r0) and (d1, r1), slopes r0 > 0 > r1. */
static double cubic_top(double d0, double r0, double d1, double r1, double *height)
{
    const double b = 3.0 * (d1 - d0) - 2.0 * r0 - r1, c = r0 + r1 - 2.0 * (d1 - d0);
    const double s = r0 / (sqrt(b * b - 3.0 * c * r0) - b);
    *height = d0 + s * (r0 + s * (b + s * c));
    return s;
}

/* Onset: remember the impact velocity, not below its floor. */
static void close_joint(Run *run, int i, double t, double deltadot, double floor)
{
    run->memory.latch[i].closed = 1;
    run->memory.latch[i].deltadot_minus = max_of(deltadot, floor);
    run->compressing[i] = 1;
    run->rising[i] = 1;
    run->onsets++;
    run->open[i] = (Impact){t, NAN, run->memory.latch[i].deltadot_minus, 0.0, t, i};
}

/* Separation: the contact goes into the list that Python fetches. */
static void open_joint(Run *run, int i, double t)
{
    run->memory.latch[i].closed = 0;
    run->open[i].t_off = t;
    if (run->n_impacts < N_IMPACTS) /* more in one step than the list holds: only where friction cuts it in parts */
        run->impacts[run->n_impacts++] = run->open[i];
}

/* Free, impact, contact from gap and approach at both ends of a step; 1 if any joint changed. */
static int update_latches(Run *run, double t, double h, const Clearance *before, const Clearance *after,
    const unsigned char *touched, const Parameters *p)
{
    const double floors[] = {0.0};
    int changed = 0;
    (void)p;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const double d0 = before[i].delta, d1 = after[i].delta;
        double rate;
        if (!run->memory.latch[i].closed && d1 >= 0.0) {
            const double s = d0 < 0.0 ? crossing(d0, before[i].deltadot, d1, after[i].deltadot, h, &rate) : 0.0;
            close_joint(run, i, t + s * h, d0 < 0.0 ? rate : before[i].deltadot, floors[i]);
            changed = 1;
        } else if (run->memory.latch[i].closed && d1 < 0.0) {
            open_joint(run, i, t + h * crossing(d0, before[i].deltadot, d1, after[i].deltadot, h, &rate));
            changed = 1;
        } else if (!run->memory.latch[i].closed && touched[i]) {
            run->grazes++; /* in and out again within one step */
        }
        if (run->memory.latch[i].closed && after[i].deltadot <= 0.0)
            run->compressing[i] = 0;
    }
    return changed;
}

/* A journal deeper in its bearing than a tenth of the radius: contact laws mean nothing there. */
static int outside_model(const Run *run, const Parameters *p)
{
    const double deepest[] = {0.0};
    (void)p;
    for (int i = 0; i < N_CLEARANCES; i++)
        if (run->aside.clearance[i].delta > deepest[i])
            return 1;
    return 0;
}

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

/* Peaks, residuals and the ratio deltadot/deltadot_minus at an accepted state. */
static int watch(Run *run, const Parameters *p)
{
    (void)p;
    const Aside *aside = &run->aside;
    double sum = 0.0;
    for (int k = 0; k < N_Y; k++)
        sum += run->dy[k] + run->y[k];
    double phi[N_LOOPS + 1], phi_dot[N_LOOPS + 1];
    closures(run->t, run->y, p, phi);
    closure_rates(run->t, run->y, run->y + N_X, p, phi_dot);
    for (int r = 0; r < N_LOOPS; r++) {
        run->phi_max = max_of(fabs(phi[r]), run->phi_max);
        run->phi_dot_max = max_of(fabs(phi_dot[r]), run->phi_dot_max);
    }
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Clearance *joint = &aside->clearance[i];
        const double F = total_force(joint);
        run->e_max[i] = max_of(joint->e, run->e_max[i]);
        if (F > run->F_peak[i]) {
            run->F_peak[i] = F;
            run->t_peak[i] = run->t;
        }
        if (run->memory.latch[i].closed) {
            const double ratio = joint->deltadot / run->memory.latch[i].deltadot_minus;
            run->ratio_min = ratio < run->ratio_min ? ratio : run->ratio_min;
            run->ratio_max = ratio > run->ratio_max ? ratio : run->ratio_max;
            run->ratio_outside += ratio < -1.0 || ratio > 1.0;
            if (F > run->open[i].F_peak) {
                run->open[i].F_peak = F;
                run->open[i].t_peak = run->t;
            }
        }
    }
    if (run->trace)
        trace_step(run);
    return !isfinite(sum) ? NOT_FINITE : outside_model(run, p) ? OUTSIDE : 0;
}

/* No friction that may stick. */
static double indicator(const Memory *memory, const Aside *aside, int i)
{
    (void)memory, (void)aside, (void)i;
    return 1.0;
}

static int switch_friction(Run *run, const Parameters *p)
{
    (void)run, (void)p;
    return 0;
}

static int begin_friction(Run *run, const Parameters *p)
{
    (void)run, (void)p;
    return 0;
}

/* User event i at time t; whether it ends the run. */
static int note_event(Run *run, int i, double t)
{
    if (run->n_events < N_IMPACTS) {
        run->event_t[run->n_events] = t;
        run->event[run->n_events++] = i;
    }
    return i < N_USER_EVENTS && run->stop && event_stops[i];
}

/* User event i is no number at time t: told once a run, in the list of events behind all of them. */
static void note_no_number(Run *run, int i, double t)
{
    if (!run->no_number[i])
        (void)note_event(run, i + N_USER_EVENTS, t);
    run->no_number[i] = 1;
}

/* Whether the next step may find more than the lists hold. */
static int lists_full(const Run *run)
{
    return run->n_impacts > N_IMPACTS - 1 || run->n_events > N_IMPACTS - 1;
}

/* The first right-hand side; a start inside contact is in contact, friction begins as its slip says. */
static int begin(Run *run, const Parameters *p)
{
    const unsigned char touched[1] = {0};
    int status = rates(run, run->t, run->y, p, run->dy, &run->aside);
    if (!status)
        status = begin_friction(run, p);
    if (!status && update_latches(run, run->t, 0.0, run->aside.clearance, run->aside.clearance, touched, p))
        status = rates(run, run->t, run->y, p, run->dy, &run->aside);
    for (int i = 0; i < N_USER_EVENTS; i++) {
        event_crosses(i, &run->memory.event_side[i], run->aside.event[i]);
        if (isnan(run->aside.event[i]) && !status)
            note_no_number(run, i, run->t);
    }
    run->ready = 1;
    return status ? status : watch(run, p);
}

size_t gudgeon_run_size(void) { return sizeof(Run); }

/* `y` is a state of all bodies. */
void gudgeon_run_start(void *memory, const double *p, double t, const double *y, const double *latched)
{
    Run *run = memory;
    *run = (Run){.t = t, .ratio_min = INFINITY, .ratio_max = -INFINITY};
    from_absolute(t, y, &run->memory, (const Parameters *)p, run->y);
    read_memory(latched, &run->memory);
    run->memory.asked = &run->asked;
    for (int i = 0; i < N_CLEARANCES; i++)
        run->open[i] = (Impact){t, NAN, latched[i], 0.0, t, i};
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

/* The codes with which an earlier run ended: whether a contact that goes on is still being compressed. */
void gudgeon_run_codes(void *memory, const signed char *state)
{
    Run *run = memory;
    for (int i = 0; i < N_CLEARANCES; i++)
        run->compressing[i] = state[i] == 1;
}

/* State of all bodies, latches and codes (0 free, 1 impact, 2 contact) as row i of the samples. */
static void store_sample(const Run *run, double t, const double *now, const Parameters *p, long i, double *y,
    double *latched, signed char *state)
{
    enum { MEMORY = 1, JOINTS = 1 };
    to_absolute(t, now, &run->memory, p, y + i * N_S);
    for (int k = 0; k < N_CLEARANCES; k++) {
        latched[i * MEMORY + k] = run->memory.latch[k].closed ? run->memory.latch[k].deltadot_minus : NAN;
        state[i * JOINTS + k] = (signed char)(run->memory.latch[k].closed ? 2 - run->compressing[k] : 0);
    }
    for (int k = 0; k < N_FRICTIONS; k++)
        latched[i * MEMORY + N_CLEARANCES + k] = run->memory.mode[k];
}

void gudgeon_run_sample(const void *memory, const double *p, double *y, double *latched, signed char *state)
{
    const Run *run = memory;
    store_sample(run, run->t, run->y, (const Parameters *)p, 0, y, latched, state);
}

void gudgeon_run_stop(void *memory, int stop) { ((Run *)memory)->stop = stop; }

/* `ask` is called with `whom` each `every` seconds (0: at each right-hand side); the run stops where it says so. */
void gudgeon_run_asks(void *memory, int (*ask)(void *), void *whom, double every)
{
    set_asked(&((Run *)memory)->asked, ask, whom, every);
}

/*
 * Of a run that no longer advances: s that its last PACE_STEPS steps gained, how many these are, whether they are far
 * shorter than those before; how many of them ended at contacts, corners of forces, frictions, events of the user.
 */
void gudgeon_run_pace(const void *memory, double *gained, long *steps, long *ended)
{
    const Run *run = memory;
    *gained = run->advance.gain;
    steps[0] = PACE_STEPS;
    steps[1] = run->advance.crawls;
    for (int k = 0; k < 4; k++)
        ended[k] = 0;
    for (int k = 0; k < N_MARGINS; k++)
        ended[(k >= N_CLEARANCES) + (k >= N_CLEARANCES + N_SWITCHES) + (k >= N_CLEARANCES + N_SWITCHES + N_FRICTIONS)] +=
            run->ended[k];
}

/* Fetches and empties the list of user events. */
int gudgeon_run_events(void *memory, double *t, int *event)
{
    Run *run = memory;
    const int n = run->n_events;
    for (int i = 0; i < n; i++) {
        t[i] = run->event_t[i];
        event[i] = run->event[i];
    }
    run->n_events = 0;
    return n;
}

/* Fetches and empties the list of impacts: 5 numbers each, and the joint; with `last` the open ones too. */
int gudgeon_run_impacts(void *memory, int last, double *numbers, int *joints)
{
    Run *run = memory;
    for (int i = 0; last && i < N_CLEARANCES; i++)
        if (run->memory.latch[i].closed && run->n_impacts < N_IMPACTS)
            run->impacts[run->n_impacts++] = run->open[i];
    const int n = run->n_impacts;
    for (int i = 0; i < n; i++) {
        const Impact *impact = &run->impacts[i];
        numbers[5 * i] = impact->t_on;
        numbers[5 * i + 1] = impact->t_off;
        numbers[5 * i + 2] = impact->deltadot;
        numbers[5 * i + 3] = impact->F_peak;
        numbers[5 * i + 4] = impact->t_peak;
        joints[i] = impact->joint;
    }
    run->n_impacts = 0;
    return n;
}

void gudgeon_run_report(const void *memory, double *t, long *counts, double *numbers, double *peaks)
{
    const Run *run = memory;
    *t = run->t;
    counts[0] = run->steps;
    counts[1] = run->evaluations;
    counts[2] = run->onsets;
    counts[3] = run->grazes;
    counts[4] = run->ratio_outside;
    counts[5] = run->switches;
    counts[6] = run->rejected;
    counts[7] = run->jacobians;
    counts[8] = run->stiff_steps;
    numbers[0] = run->phi_max;
    numbers[1] = run->phi_dot_max;
    numbers[2] = run->ratio_min;
    numbers[3] = run->ratio_max;
    for (int i = 0; i < N_CLEARANCES; i++) {
        peaks[3 * i] = run->F_peak[i];
        peaks[3 * i + 1] = run->t_peak[i];
        peaks[3 * i + 2] = run->e_max[i];
    }
}
