/*
 * The classical Runge-Kutta method of order 4 with fixed step (W. Kutta, Z. Math. Phys. 46, 1901), and
 * what is watched while it runs: onsets and separations of joints with play, peaks, residuals.
 */
enum { N_EVENTS = 256, NOT_FINITE = -2, EVENTS_FULL = -3, CHATTERING = -4, MAX_PARTS = 50 };

typedef struct {
    double t_on, t_off, deltadot, F_peak, t_peak;
    int joint;
} Impact;

typedef struct {
    double t, y[N_Y], dy[N_Y];
    Aside aside;
    Memory memory;
    Impact open[1];      /* the contact going on in each joint */
    int compressing[1];  /* from onset until the penetration first stops growing */
    double F_peak[1], t_peak[1], e_max[1];
    Impact impacts[N_EVENTS];
    int n_impacts, ready, status;
    long steps, evaluations, onsets, grazes, ratio_outside, switches;
    double phi_max, phi_dot_max, ratio_min, ratio_max;
} Run;

static int rates(Run *run, double t, const double *y, const Parameters *p, double *dy, Aside *aside)
{
    run->evaluations++;
    return state_equation(t, y, &run->memory, p, dy, aside);
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

/* Onset: remember the impact velocity, not below its floor. */
static void close_joint(Run *run, int i, double t, double deltadot, double floor)
{
    run->memory.latch[i].closed = 1;
    run->memory.latch[i].deltadot_minus = max_of(deltadot, floor);
    run->compressing[i] = 1;
    run->onsets++;
    run->open[i] = (Impact){t, NAN, run->memory.latch[i].deltadot_minus, 0.0, t, i};
}

/* Separation: the contact goes into the list that Python fetches. */
static void open_joint(Run *run, int i, double t)
{
    run->memory.latch[i].closed = 0;
    run->open[i].t_off = t;
    if (run->n_impacts < N_EVENTS) /* more in one step than the list holds: only where friction cuts it in parts */
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

/* Peaks, residuals and the ratio deltadot/deltadot_minus at an accepted state. */
static int watch(Run *run)
{
    const Aside *aside = &run->aside;
    double sum = 0.0;
    for (int k = 0; k < N_Y; k++)
        sum += run->dy[k] + run->y[k];
    for (int r = 0; r < N_ROWS; r++) {
        run->phi_max = max_of(fabs(aside->phi[r]), run->phi_max);
        run->phi_dot_max = max_of(fabs(aside->phi_dot[r]), run->phi_dot_max);
    }
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Clearance *joint = &aside->clearance[i];
        const double F = hypot(joint->F_n, joint->F_t);
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
    return isfinite(sum) ? 0 : NOT_FINITE;
}

/* Where a step would lead: the new state, its right-hand side, and which joints touched on the way. */
typedef struct {
    double y[N_Y], dy[N_Y];
    Aside aside;
    unsigned char touched[1];
} Trial;

/*
 * k1 = f(t, y), k2 = f(t + h/2, y + h/2 k1), k3 = f(t + h/2, y + h/2 k2), k4 = f(t + h, y + h k3),
 * y + h/6 (k1 + 2 k2 + 2 k3 + k4). k1 is left over from the step before.
 */
static int rk4_trial(Run *run, double h, const Parameters *p, Trial *trial)
{
    static const double reach[3] = {0.5, 0.5, 1.0}, weight[3] = {1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
    double y[N_Y], k[N_Y];
    const double *slope = run->dy;
    for (int i = 0; i < N_CLEARANCES; i++)
        trial->touched[i] = 0;
    for (int j = 0; j < N_Y; j++)
        trial->y[j] = run->y[j] + h / 6.0 * run->dy[j];
    for (int stage = 0; stage < 3; stage++) {
        for (int j = 0; j < N_Y; j++)
            y[j] = run->y[j] + reach[stage] * h * slope[j];
        const int status = rates(run, run->t + reach[stage] * h, y, p, k, &trial->aside);
        if (status)
            return status;
        for (int j = 0; j < N_Y; j++)
            trial->y[j] += weight[stage] * h * k[j];
        for (int i = 0; i < N_CLEARANCES; i++)
            trial->touched[i] |= trial->aside.clearance[i].delta > 0.0;
        slope = k;
    }
    return rates(run, run->t + h, trial->y, p, trial->dy, &trial->aside);
}

/* No friction that may stick: a step never ends early. */
static double friction_event(Run *run, double h, const Parameters *p, const Trial *trial)
{
    (void)run, (void)h, (void)p, (void)trial;
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

/* The first right-hand side; a start inside contact is in contact, friction begins as its slip says. */
static int begin(Run *run, const Parameters *p)
{
    const unsigned char touched[1] = {0};
    int status = rates(run, run->t, run->y, p, run->dy, &run->aside);
    if (!status)
        status = begin_friction(run, p);
    if (!status && update_latches(run, run->t, 0.0, run->aside.clearance, run->aside.clearance, touched, p))
        status = rates(run, run->t, run->y, p, run->dy, &run->aside);
    run->ready = 1;
    return status ? status : watch(run);
}

/* Takes a trial as the new state; latches follow from the gaps at both of its ends. */
static int accept(Run *run, double h, double t_new, const Trial *trial, const Parameters *p)
{
    const double t = run->t;
    const Aside before = run->aside;
    run->t = t_new;
    for (int j = 0; j < N_Y; j++) {
        run->y[j] = trial->y[j];
        run->dy[j] = trial->dy[j];
    }
    run->aside = trial->aside;
    int status = 0;
    if (update_latches(run, t, h, before.clearance, run->aside.clearance, trial->touched, p))
        status = rates(run, t_new, run->y, p, run->dy, &run->aside);
    return status ? status : watch(run);
}

/* One step to t_new; where friction changes on the way, in parts that end there. */
static int rk4_step(Run *run, double h, double t_new, const Parameters *p)
{
    Trial trial;
    run->steps++;
    for (int part = 0; part < MAX_PARTS; part++) {
        const int status = rk4_trial(run, h, p, &trial);
        if (status)
            return status;
        const double share = friction_event(run, h, p, &trial);
        if (share >= 1.0)
            return accept(run, h, t_new, &trial, p);
        int failed = share < 0.0 ? NOT_FINITE : accept(run, share * h, run->t + share * h, &trial, p);
        if (!failed)
            failed = switch_friction(run, p);
        if (failed)
            return failed;
        h = t_new - run->t;
        if (!(h > 0.0))
            return 0;
    }
    return CHATTERING;
}

size_t gudgeon_run_size(void) { return sizeof(Run); }

void gudgeon_run_start(void *memory, double t, const double *y, const double *latched)
{
    Run *run = memory;
    *run = (Run){.t = t, .ratio_min = INFINITY, .ratio_max = -INFINITY};
    for (int k = 0; k < N_Y; k++)
        run->y[k] = y[k];
    read_memory(latched, &run->memory);
    for (int i = 0; i < N_CLEARANCES; i++)
        run->open[i] = (Impact){t, NAN, latched[i], 0.0, t, i};
}

/* The codes with which an earlier run ended: whether a contact that goes on is still being compressed. */
void gudgeon_run_codes(void *memory, const signed char *state)
{
    Run *run = memory;
    for (int i = 0; i < N_CLEARANCES; i++)
        run->compressing[i] = state[i] == 1;
}

/*
 * `count` steps from t0 + first h towards t0 + total h = t1, or fewer when the list of impacts is full.
 * Returns 0, EVENTS_FULL, NOT_FINITE or the pivot that vanished; `taken` steps were made.
 */
int gudgeon_run_steps(void *memory, const double *parameters, double t0, double t1, long total, long first, long count,
    long *taken)
{
    Run *run = memory;
    const Parameters *p = (const Parameters *)parameters;
    const double h = (t1 - t0) / (double)total;
    int status = run->ready ? 0 : begin(run, p);
    *taken = 0;
    while (!status && *taken < count) {
        if (run->n_impacts > 0 && run->n_impacts > N_EVENTS - 1)
            return EVENTS_FULL;
        const long i = first + *taken + 1;
        status = rk4_step(run, h, i == total ? t1 : t0 + (double)i * h, p);
        ++*taken;
    }
    return status;
}

/* State, accelerations, latches and codes (0 free, 1 impact, 2 contact) of the moment. */
void gudgeon_run_sample(const void *memory, double *y, double *a, double *latched, signed char *state)
{
    const Run *run = memory;
    for (int k = 0; k < N_Y; k++)
        y[k] = run->y[k];
    for (int k = 0; k < N_Q; k++)
        a[k] = run->dy[N_Q + k];
    for (int i = 0; i < N_CLEARANCES; i++) {
        latched[i] = run->memory.latch[i].closed ? run->memory.latch[i].deltadot_minus : NAN;
        state[i] = (signed char)(run->memory.latch[i].closed ? 2 - run->compressing[i] : 0);
    }
    for (int i = 0; i < N_FRICTIONS; i++)
        latched[N_CLEARANCES + i] = run->memory.mode[i];
}

/* Fetches and empties the list of impacts: 5 numbers each, and the joint; with `last` the open ones too. */
int gudgeon_run_impacts(void *memory, int last, double *numbers, int *joints)
{
    Run *run = memory;
    for (int i = 0; last && i < N_CLEARANCES; i++)
        if (run->memory.latch[i].closed && run->n_impacts < N_EVENTS)
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
