/*
 * Kinematic analysis of a linkage without degrees of freedom: drives determine its position at every time. Nothing is
 * integrated. The motion is followed in steps from sample to sample, so that it remains on its branch.
 */
#include "../run/cancellation.h"

enum { MAX_NEWTON = 12, MAX_HALVINGS = 40, MAX_SPLITS = 400, PULSE_HALVINGS = 30 };

/* The motion of all bodies at a time t, s; phi and phi_dot: the largest |Phi| and |Phi_dot| there. */
typedef struct {
    double t, q[N_Q], v[N_Q], a[N_Q], phi, phi_dot;
    double last_correction;      /* last correction of Newton's method, rad or fraction of the mechanism's size */
    int interpolated; /* at or near a change point (change_point.c) */
#if POSITIONS_IN_TREE
    double s[N_X + 1], s_rate[N_X + 1], s_second[N_X + 1]; /* the same in tree coordinates */
#endif
} Position;

/* The current length of steps, s, and how often it was halved. */
typedef struct {
    double h;
    int halvings;
} StepLength;

/*
 * A kinematic analysis over several calls: parameters; the largest correction of a first guess (`reach`, rad or
 * fraction of the size); the mechanism's size (`extent`, m); its end, cancellation, progress; the positions of motion
 * and works.
 */
typedef struct {
    const Parameters *p;
    double reach, extent, t_end;
    Cancellation cancellation;
    ProgressMonitor monitor;
    Position motion, work;
    int motion_begun, work_begun;
    long passed;     /* samples that were interpolated at or near a change point */
    double t_passed; /* the first of them, s */
    double *step_record; /* rows of t, q, v at the ends of steps, fetched by Python; NULL: not recorded */
    long n_recorded, capacity;
} KinematicRun;

/* Return the size of the memory of a kinematic analysis, bytes. */
size_t gudgeon_kinematic_size(void) { return sizeof(KinematicRun); }

/*
 * Initialize a kinematic analysis. reach, extent: see KinematicRun. `ask` is called with `caller` every `every` seconds
 * (0: at each step) and cancels the analysis if it returns nonzero.
 */
void gudgeon_kinematic_begin(
    void *integrator, double reach, double extent, double t_end, int (*ask)(void *), void *caller, double every)
{
    KinematicRun *run = integrator;
    *run = (KinematicRun){.reach = reach, .extent = extent, .t_end = t_end};
    start_polling(&run->cancellation, ask, caller, every);
}

/* Begin the motion anew at the next call, from the position given there. */
void gudgeon_kinematic_restart(void *integrator) { ((KinematicRun *)integrator)->motion_begun = 0; }

/*
 * Report progress: times of motion and works (t[2], s), the time gained by the last steps (s), and the number of these
 * steps and whether they are far too short (steps[2]).
 */
void gudgeon_kinematic_progress(const void *integrator, double *t, double *gained, long *steps)
{
    const KinematicRun *run = integrator;
    t[0] = run->motion.t;
    t[1] = run->work_begun ? run->work.t : NAN;
    *gained = run->monitor.gain;
    steps[0] = MONITOR_STEPS;
    steps[1] = run->monitor.crawls;
}

/* Return how many samples were interpolated at or near a change point; t: the time of the first one, s. */
long gudgeon_kinematic_interpolated(const void *integrator, double *t)
{
    const KinematicRun *run = integrator;
    *t = run->t_passed;
    return run->passed;
}

/* Record positions at the ends of steps into `capacity` rows; NULL: stop recording. */
void gudgeon_kinematic_record(void *integrator, double *rows, long capacity)
{
    KinematicRun *run = integrator;
    run->step_record = rows;
    run->capacity = capacity;
    run->n_recorded = 0;
}

/* Return the number of rows recorded since the last call; the next row is written to the first one. */
long gudgeon_kinematic_recorded(void *integrator)
{
    KinematicRun *run = integrator;
    const long n = run->n_recorded;
    run->n_recorded = 0;
    return n;
}

/* Record a position, if recording is requested. */
static void record_position(KinematicRun *run, const Position *here)
{
    if (!run->step_record)
        return;
    double *row = run->step_record + (1 + 2 * N_Q) * run->n_recorded++;
    *row++ = here->t;
    memcpy(row, here->q, sizeof here->q);
    memcpy(row + N_Q, here->v, sizeof here->v);
}

/* Return the larger number; NaN is propagated. */
static double larger_or_nan(double most, double x) { return x > most || isnan(x) ? x : most; }

/*
 * Return the maximum norm of a change or rate of q as an angle (rad or rad/s); lengths are divided by the size
 * `extent`.
 */
static double angle_norm(const double *x, double extent)
{
    double most = 0.0;
    for (int k = 0; k < N_Q; k++)
        most = larger_or_nan(most, fabs(x[k]) / (k % 3 == 2 ? 1.0 : extent));
    return most;
}

#if POSITIONS_IN_TREE
#include "tree.c"
#else
#include "full.c"
#endif
/* Return the error of the trapezoidal rule for the positions between a and b, rad; lengths are divided by the size. */
static double trapezoidal_error(const Position *a, const Position *b, double extent)
{
    const double half = 0.5 * (b->t - a->t), fraction = 1.0 / extent;
    double lengths = 0.0, angles = 0.0;
    for (int k = 0; k < N_Q; k += 3) {
        for (int c = k; c < k + 2; c++)
            lengths = larger_or_nan(lengths, fabs(b->q[c] - a->q[c] - half * (a->v[c] + b->v[c])));
        angles = larger_or_nan(angles, fabs(b->q[k + 2] - a->q[k + 2] - half * (a->v[k + 2] + b->v[k + 2])));
    }
    return larger_or_nan(angles, lengths * fraction);
}

#include "change_point.c"

#if N_PULSES
/* Return whether a missed term of time is harmless: its excess is known by bounds only, not for certain. */
static int is_uncertain_term(void *context, double fraction, int sure)
{
    (void)context, (void)fraction;
    return !sure;
}

/* Return whether a term of time acts between the ends of a step and the nodes of its quadrature. */
static int hides_transient(double t0, double t1, const Parameters *p)
{
    static const double place[] = {0.0, 0.1127016653792583, 0.5, 0.8872983346207417, 1.0};
    return undersampled_term(t0, t1 - t0, place, 5, is_uncertain_term, NULL, p) > 0.0;
}
#else
/* Return 0: the scene has no terms of time alone. */
static int hides_transient(double t0, double t1, const Parameters *p)
{
    (void)t0, (void)t1, (void)p;
    return 0;
}
#endif

/* Return whether all constraint equations are finite at a time; an expression of a drive may be undefined. */
static int are_constraints_finite(double t, const Position *here, const Parameters *p)
{
    double phi[N_ALL_ROWS];
    constraints(t, here->q, p, phi);
    return all_finite(phi, N_ALL_ROWS);
}

/*
 * Make one step along the branch, to t1 at most. The step is halved if Newton's method corrects the first guess by more
 * than `reach`, or the positions do not agree with the velocities. Near a dead centre, another branch appears as such a
 * jump. Returns a status.
 */
static int make_step(KinematicRun *run, StepLength *stride, double t1, Position *here)
{
    const double straight = 0.002 * run->reach;
    for (;;) {
        Position there, passed;
        double moved = 0.0, bent = 0.0;
        if (is_cancelled(&run->cancellation))
            return STOPPED;
        const double next = here->t + stride->h < t1 ? here->t + stride->h : t1;
        const int status = next > here->t ? solve_position_at(run, next, here, &there, &moved) : NEWTON_FAILED;
        if (status == STOPPED)
            return status;
        if ((status || (next == t1 && is_ill_conditioned(&there))) && next > here->t
            && are_constraints_finite(next, here, run->p) && !pass_change_point(run, next, here, &passed)) {
            *here = passed;
            return 0;
        }
        const int near = !status && moved <= run->reach;
        if (near)
            bent = trapezoidal_error(here, &there, run->extent);
        if (near && bent <= straight
            && (stride->halvings > PULSE_HALVINGS || !hides_transient(here->t, next, run->p))) {
            *here = there;
            if (stride->halvings > 0 && bent < 0.1 * straight) { /* the error is proportional to h cubed */
                stride->h *= 2.0;
                stride->halvings--;
            }
            return 0;
        }
        if (++stride->halvings > MAX_HALVINGS || !(next > here->t))
            return status ? status : NEWTON_FAILED;
        stride->h *= 0.5;
    }
}

/*
 * Follow the motion to t1 in steps, record their ends and monitor progress. steps: incremented by their number. Returns
 * a status.
 */
static int advance(KinematicRun *run, double t1, Position *here, long *steps)
{
    StepLength stride = {t1 - here->t, 0};
    while (here->t < t1) {
        if (run->step_record && run->n_recorded == run->capacity)
            return EVENTS_FULL;
        const int status = make_step(run, &stride, t1, here);
        if (status)
            return status;
        ++*steps;
        record_position(run, here);
        if (has_stalled(&run->monitor, here->t, run->t_end))
            return STALLED;
    }
    return complete_position(run, here);
}

/*
 * Compute the motion at n samples. t: n + 1 times, s. q, v, a: n + 1 rows of N_Q; row 0 of q and v holds the start, or
 * the last sample of the previous call. phi_max, phi_dot_max: updated maxima. done: the last complete row, whatever
 * status is returned.
 */
int gudgeon_kinematic(void *integrator, long n, const double *t, const double *parameters, double *q, double *v,
    double *a, double *phi_max, double *phi_dot_max, long *steps, long *done)
{
    KinematicRun *run = integrator;
    Position *here = &run->motion;
    run->p = (const Parameters *)parameters;
    *done = 0;
    for (long i = run->motion_begun; i <= n; i++) {
        const int status = i > 0 ? advance(run, t[i], here, steps) : set_position_near(run, t[0], q, v, here);
        if (status)
            return status;
        run->motion_begun = 1;
        if (here->interpolated && !run->passed++)
            run->t_passed = t[i];
        if (i > 0) {
            memcpy(q + i * N_Q, here->q, sizeof here->q);
            memcpy(v + i * N_Q, here->v, sizeof here->v);
        }
        memcpy(a + i * N_Q, here->a, sizeof here->a);
        *phi_max = max_of(here->phi, *phi_max);
        *phi_dot_max = max_of(here->phi_dot, *phi_dot_max);
        *done = i;
    }
    return 0;
}
