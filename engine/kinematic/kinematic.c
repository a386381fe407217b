/*
 * No degree of freedom is left: at every time the drives say where everything is. Nothing is integrated; the motion
 * is followed from sample to sample so that it stays on its branch.
 */
#include "../run/cancellation.h"

enum { MAX_NEWTON = 12, MAX_HALVINGS = 40, MAX_SPLITS = 400, PULSE_HALVINGS = 30 };

/* A place on the way: the motion of all bodies at a time, the largest |Phi| and |Phi_dot| there. */
typedef struct {
    double t, q[N_Q], v[N_Q], a[N_Q], phi, phi_dot;
    double left;      /* of Newton's method: its last step, rad or share of the mechanism's size */
    int interpolated; /* at or near a change point (change_point.c) */
#if POSITIONS_IN_TREE
    double s[N_X + 1], s_rate[N_X + 1], s_second[N_X + 1]; /* the same in tree coordinates */
#endif
} Position;

/* The step that a way has come down to. */
typedef struct {
    double h;
    int halvings;
} Stride;

/*
 * A run of many calls: the parameters of a call, what a way is measured by (a share of the mechanism's size or rad; m),
 * where it is to end, where its motion and its works are, whom it asks, its pace.
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
    double *step_record; /* rows of t, q, v at the ends of steps, which Python fetches; nobody wants any: NULL */
    long taped, capacity;
} Course;

size_t gudgeon_kinematic_size(void) { return sizeof(Course); }

/* `reach` and `extent` as in Course; `ask` is called with `caller` each `every` seconds (0: at each step). */
void gudgeon_kinematic_begin(
    void *integrator, double reach, double extent, double t_end, int (*ask)(void *), void *caller, double every)
{
    Course *course = integrator;
    *course = (Course){.reach = reach, .extent = extent, .t_end = t_end};
    start_cancellation(&course->cancellation, ask, caller, every);
}

/* The motion is begun anew at the next call, from a row that is given there. */
void gudgeon_kinematic_restart(void *integrator) { ((Course *)integrator)->motion_begun = 0; }

/* How far motion and works got, s; s that its last steps gained, how many they are, whether they are far shorter. */
void gudgeon_kinematic_progress(const void *integrator, double *t, double *gained, long *steps)
{
    const Course *course = integrator;
    t[0] = course->motion.t;
    t[1] = course->work_begun ? course->work.t : NAN;
    *gained = course->monitor.gain;
    steps[0] = MONITOR_STEPS;
    steps[1] = course->monitor.crawls;
}

/* How many samples so far were interpolated at or near a change point, and the time of the first, s. */
long gudgeon_kinematic_interpolated(const void *integrator, double *t)
{
    const Course *course = integrator;
    *t = course->t_passed;
    return course->passed;
}

/* Room for so many rows of the tape; NULL: none is wanted any more. */
void gudgeon_kinematic_record(void *integrator, double *rows, long capacity)
{
    Course *course = integrator;
    course->step_record = rows;
    course->capacity = capacity;
    course->taped = 0;
}

/* Rows since the last call; the next one is written to the first place. */
long gudgeon_kinematic_recorded(void *integrator)
{
    Course *course = integrator;
    const long n = course->taped;
    course->taped = 0;
    return n;
}

static void tape_place(Course *course, const Position *here)
{
    if (!course->step_record)
        return;
    double *row = course->step_record + (1 + 2 * N_Q) * course->taped++;
    *row++ = here->t;
    memcpy(row, here->q, sizeof here->q);
    memcpy(row + N_Q, here->v, sizeof here->v);
}

/* The larger one; NaN stays. */
static double larger(double most, double x) { return x > most || isnan(x) ? x : most; }

/* A change of q, or a rate of it, as the angle that it is worth: positions as shares of the mechanism's size. */
static double turn_of(const double *x, double extent)
{
    double most = 0.0;
    for (int k = 0; k < N_Q; k++)
        most = larger(most, fabs(x[k]) / (k % 3 == 2 ? 1.0 : extent));
    return most;
}

#if POSITIONS_IN_TREE
#include "tree.c"
#else
#include "full.c"
#endif
/* What the trapezoidal rule leaves over between two places: the angle that it is worth (rad), lengths by the size. */
static double bend_between(const Position *a, const Position *b, double extent)
{
    const double half = 0.5 * (b->t - a->t), fraction = 1.0 / extent;
    double lengths = 0.0, angles = 0.0;
    for (int k = 0; k < N_Q; k += 3) {
        for (int c = k; c < k + 2; c++)
            lengths = larger(lengths, fabs(b->q[c] - a->q[c] - half * (a->v[c] + b->v[c])));
        angles = larger(angles, fabs(b->q[k + 2] - a->q[k + 2] - half * (a->v[k + 2] + b->v[k + 2])));
    }
    return larger(angles, lengths * fraction);
}

#include "change_point.c"

#if N_PULSES
static int only_wide_bounds(void *context, double fraction, int sure)
{
    (void)context, (void)fraction;
    return !sure;
}

/* Whether a drive or a force acts between the ends of a step and the nodes of its quadrature. */
static int hides_transient(double t0, double t1, const Parameters *p)
{
    static const double place[] = {0.0, 0.1127016653792583, 0.5, 0.8872983346207417, 1.0};
    return undersampled_term(t0, t1 - t0, place, 5, only_wide_bounds, NULL, p) > 0.0;
}
#else
static int hides_transient(double t0, double t1, const Parameters *p)
{
    (void)t0, (void)t1, (void)p;
    return 0;
}
#endif

/* Whether all rows are numbers at a time: a drive may be none there. */
static int rows_are_numbers(double t, const Position *here, const Parameters *p)
{
    double phi[N_ALL_ROWS];
    constraints(t, here->q, p, phi);
    return all_finite(phi, N_ALL_ROWS);
}

/*
 * One step along the same branch, to t1 at the furthest. Where Newton moves the first guess by more than the reach,
 * or the way bends more than its velocities say, the step is halved: another branch passes near dead centres as a
 * jump of positions that no velocity explains.
 */
static int step_on(Course *course, Stride *stride, double t1, Position *here)
{
    const double straight = 0.002 * course->reach;
    for (;;) {
        Position there, passed;
        double moved = 0.0, bent = 0.0;
        if (given_up(&course->cancellation))
            return STOPPED;
        const double next = here->t + stride->h < t1 ? here->t + stride->h : t1;
        const int status = next > here->t ? bracket_point_at(course, next, here, &there, &moved) : NEWTON_FAILED;
        if (status == STOPPED)
            return status;
        if ((status || (next == t1 && is_rough(&there))) && next > here->t && rows_are_numbers(next, here, course->p)
            && !pass_change_point(course, next, here, &passed)) {
            *here = passed;
            return 0;
        }
        const int near = !status && moved <= course->reach;
        if (near)
            bent = bend_between(here, &there, course->extent);
        if (near && bent <= straight
            && (stride->halvings > PULSE_HALVINGS || !hides_transient(here->t, next, course->p))) {
            *here = there;
            if (stride->halvings > 0 && bent < 0.1 * straight) { /* it grows with h cubed */
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

/* To t1, in steps; a run whose pace is watched. */
static int advance(Course *course, double t1, Position *here, long *steps)
{
    Stride stride = {t1 - here->t, 0};
    while (here->t < t1) {
        if (course->step_record && course->taped == course->capacity)
            return EVENTS_FULL;
        const int status = step_on(course, &stride, t1, here);
        if (status)
            return status;
        ++*steps;
        tape_place(course, here);
        if (has_stalled(&course->monitor, here->t, course->t_end))
            return STALLED;
    }
    return update_modes(course, here);
}

/*
 * n samples at the given times; q, v and a have n + 1 rows, the first of q and v holds what is known at t[0]: the
 * start, or where the last call came to. `done` is the last row that is complete, whatever is returned.
 */
int gudgeon_kinematic(void *integrator, long n, const double *t, const double *parameters, double *q, double *v,
    double *a, double *phi_max, double *phi_dot_max, long *steps, long *done)
{
    Course *course = integrator;
    Position *here = &course->motion;
    course->p = (const Parameters *)parameters;
    *done = 0;
    for (long i = course->motion_begun; i <= n; i++) {
        const int status = i > 0 ? advance(course, t[i], here, steps) : begin_near(course, t[0], q, v, here);
        if (status)
            return status;
        course->motion_begun = 1;
        if (here->interpolated && !course->passed++)
            course->t_passed = t[i];
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
