/*
 * No degree of freedom is left: at every time the drives say where everything is. Nothing is integrated; the motion
 * is followed from sample to sample so that it stays on its branch.
 */
#include "../run/asked.h"
#include "../scene/events.h"

enum { MAX_NEWTON = 12, MAX_HALVINGS = 40, MAX_SPLITS = 400, PULSE_HALVINGS = 30, NEWTON_FAILED = -1, NO_NUMBER = -2 };

/* A place on the way: the motion of all bodies at a time, the largest |Phi| and |Phi_dot| there. */
typedef struct {
    Asked *asked;
    double t, q[N_Q], v[N_Q], a[N_Q], phi, phi_dot;
#if POSITIONS_IN_TREE
    double s[N_X + 1], s_rate[N_X + 1], s_second[N_X + 1]; /* the same in tree coordinates */
#endif
} Place;

/* What a way is measured by (a share of the mechanism's size or rad; m), and the step that it has come down to. */
typedef struct {
    double reach, extent, h;
    int halvings;
} Stride;

/* A run of many calls: where it is to end, where its motion and its works are, whom it asks, its pace. */
typedef struct {
    double reach, extent, t_end;
    Asked asked;
    Pace pace;
    Place motion, work;
    int motion_begun, work_begun;
} Course;

size_t gudgeon_course_size(void) { return sizeof(Course); }

/* `reach` and `extent` as in Stride; `ask` is called with `whom` each `every` seconds (0: at each step). */
void gudgeon_course_begin(void *memory, double reach, double extent, double t_end, int (*ask)(void *), void *whom,
    double every)
{
    Course *course = memory;
    *course = (Course){.reach = reach, .extent = extent, .t_end = t_end};
    set_asked(&course->asked, ask, whom, every);
}

/* The motion is begun anew at the next call, from a row that is given there. */
void gudgeon_course_again(void *memory) { ((Course *)memory)->motion_begun = 0; }

/* How far motion and works got, s; s that its last steps gained, how many they are, whether they are far shorter. */
void gudgeon_course_pace(const void *memory, double *t, double *gained, long *steps)
{
    const Course *course = memory;
    t[0] = course->motion.t;
    t[1] = course->work_begun ? course->work.t : NAN;
    *gained = course->pace.gain;
    steps[0] = PACE_STEPS;
    steps[1] = course->pace.crawls;
}

/* The larger one; NaN stays. */
static double larger(double most, double x) { return x > most || isnan(x) ? x : most; }

#if POSITIONS_IN_TREE
#include "tree.c"
#else
#include "full.c"
#endif
/* What the trapezoidal rule leaves over between two places: the angle that it is worth (rad), lengths by the size. */
static double bend_between(const Place *a, const Place *b, double extent)
{
    const double half = 0.5 * (b->t - a->t), share = 1.0 / extent;
    double lengths = 0.0, angles = 0.0;
    for (int k = 0; k < N_Q; k += 3) {
        for (int c = k; c < k + 2; c++)
            lengths = larger(lengths, fabs(b->q[c] - a->q[c] - half * (a->v[c] + b->v[c])));
        angles = larger(angles, fabs(b->q[k + 2] - a->q[k + 2] - half * (a->v[k + 2] + b->v[k + 2])));
    }
    return larger(angles, lengths * share);
}

#if N_TERMS
static int only_wide_bounds(void *context, double share, int sure)
{
    (void)context, (void)share;
    return !sure;
}

/* Whether a drive or a force acts between the ends of a step and the nodes of its quadrature. */
static int hides_a_pulse(double t0, double t1, const Parameters *p)
{
    static const double place[] = {0.0, 0.1127016653792583, 0.5, 0.8872983346207417, 1.0};
    return unseen_term(t0, t1 - t0, place, 5, only_wide_bounds, NULL, p) > 0.0;
}
#else
static int hides_a_pulse(double t0, double t1, const Parameters *p)
{
    (void)t0, (void)t1, (void)p;
    return 0;
}
#endif

/*
 * One step along the same branch, to t1 at the furthest. Where Newton moves the first guess by more than the reach,
 * or the way bends more than its velocities say, the step is halved: another branch passes near dead centres as a
 * jump of positions that no velocity explains.
 */
static int step_on(Stride *stride, double t1, const Parameters *p, Place *here)
{
    const double straight = 0.002 * stride->reach;
    for (;;) {
        Place there;
        double moved = 0.0, bent = 0.0;
        if (given_up(here->asked))
            return STOPPED;
        const double next = here->t + stride->h < t1 ? here->t + stride->h : t1;
        const int status = next > here->t ? place_at(next, p, stride->extent, here, &there, &moved) : NEWTON_FAILED;
        if (status == STOPPED)
            return status;
        const int near = !status && moved <= stride->reach;
        if (near)
            bent = bend_between(here, &there, stride->extent);
        if (near && bent <= straight && (stride->halvings > PULSE_HALVINGS || !hides_a_pulse(here->t, next, p))) {
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
static int advance(Course *course, double t1, const Parameters *p, Place *here, long *steps)
{
    Stride stride = {course->reach, course->extent, t1 - here->t, 0};
    while (here->t < t1) {
        const int status = step_on(&stride, t1, p, here);
        if (status)
            return status;
        ++*steps;
        if (creeps(&course->pace, here->t, course->t_end))
            return STALLED;
    }
    return settle(p, here);
}

/*
 * n samples at the given times; q, v and a have n + 1 rows, the first of q and v holds what is known at t[0]: the
 * start, or where the last call came to. `done` is the last row that is complete, whatever is returned.
 */
int gudgeon_kinematic(void *memory, long n, const double *t, const double *parameters, double *q, double *v, double *a,
    double *phi_max, double *phi_dot_max, long *steps, long *done)
{
    Course *course = memory;
    const Parameters *p = (const Parameters *)parameters;
    Place *here = &course->motion;
    *done = 0;
    for (long i = course->motion_begun; i <= n; i++) {
        here->asked = &course->asked;
        const int status = i > 0 ? advance(course, t[i], p, here, steps) : begin(t[0], q, v, p, here);
        if (status)
            return status;
        course->motion_begun = 1;
        for (int k = 0; k < N_Q; k++) {
            if (i > 0) {
                q[i * N_Q + k] = here->q[k];
                v[i * N_Q + k] = here->v[k];
            }
            a[i * N_Q + k] = here->a[k];
        }
        *phi_max = max_of(here->phi, *phi_max);
        *phi_dot_max = max_of(here->phi_dot, *phi_dot_max);
        *done = i;
    }
    return 0;
}

/* Powers at a place, and the accelerations of all bodies; a status as that of settle. */
static int powers(const Parameters *p, Place *here, double *power)
{
    Aside aside;
#if POSITIONS_IN_TREE
    double a[N_X + 1];
    const int status = solve_motion(p, here, a, &aside);
#else
    const int status = solve_motion(p, here, here->a, &aside);
#endif
    for (int k = 0; k < N_WORK; k++)
        power[k] = aside.power[k];
    return status;
}

/* A rate, as the angle that it is worth: lengths as shares of the mechanism's size. */
static double turn(const double *v, int k, double extent) { return k % 3 == 2 ? fabs(v[k]) : fabs(v[k]) / extent; }

/*
 * Works between two places that are one step apart: quadrature of Gauss and Legendre with three nodes. `jumped`: the
 * velocities change by more than the accelerations on the way say, so that the rate of a drive jumps, or nearly so.
 * NO_NUMBER where a power is none, at `work[0]`.
 */
static int work_between(const Parameters *p, double extent, const Place *a, const Place *b, double least, double *work,
    int *jumped)
{
    static const double node[] = {-0.7745966692414834, 0.0, 0.7745966692414834};
    static const double weight[] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
    const double half = 0.5 * (b->t - a->t);
    double missed[N_Q], most = 0.0, scale = 0.0;
    for (int k = 0; k < N_Q; k++)
        missed[k] = b->v[k] - a->v[k];
    for (int i = 0; i < 3; i++) {
        Place at;
        double power[N_WORK], moved;
        int status = place_at(a->t + half * (1.0 + node[i]), p, extent, a, &at, &moved);
        if (!status)
            status = powers(p, &at, power);
        if (status)
            return status;
        for (int k = 0; k < N_WORK; k++) {
            if (!isfinite(power[k])) {
                work[0] = at.t;
                return NO_NUMBER;
            }
            work[k] += half * weight[i] * power[k];
        }
        for (int k = 0; k < N_Q; k++) {
            missed[k] -= half * weight[i] * at.a[k];
            scale = larger(scale, half * turn(at.a, k, extent));
        }
    }
    for (int k = 0; k < N_Q; k++)
        most = larger(most, turn(missed, k, extent));
    /* or an acceleration is none: a rate of no bounded slope */
    *jumped = !(scale <= DBL_MAX) || (most > least && most > 1e-6 * scale);
    return 0;
}

/* Of all bodies, J. */
static double kinetic_energy_at(const Parameters *p, const Place *at)
{
    double m[N_Q], sum = 0.0;
    mass_matrix(p, m);
    for (int k = 0; k < N_Q; k++)
        sum += 0.5 * m[k] * at->v[k] * at->v[k];
    return sum;
}

/*
 * The same, halved where velocities jump until nothing is left to halve: what kinetic energy gains there is the work
 * of the impulse with which the drives change the velocities. `halvings` are left for the whole step.
 */
static int work_across(const Parameters *p, double extent, const Place *a, const Place *b, double least, int *halvings,
    double *work)
{
    double part[N_WORK] = {0.0}, moved;
    int jumped = 0;
    int status = work_between(p, extent, a, b, least, part, &jumped);
    const double t = a->t + 0.5 * (b->t - a->t);
    if (status == NO_NUMBER)
        work[0] = part[0];
    if (status)
        return status;
    const int wide = t > a->t && t < b->t;
    if (jumped && wide && *halvings > 0) {
        Place middle;
        --*halvings;
        status = place_at(t, p, extent, a, &middle, &moved);
        if (!status)
            status = work_across(p, extent, a, &middle, least, halvings, work);
        return status ? status : work_across(p, extent, &middle, b, least, halvings, work);
    }
    if (jumped && !wide)
        part[0] = kinetic_energy_at(p, b) - kinetic_energy_at(p, a);
    if (!isfinite(part[0])) {
        work[0] = t;
        return NO_NUMBER;
    }
    for (int k = 0; k < N_WORK; k++)
        work[k] += part[k];
    return 0;
}

/* Of one step; speeds that change by less than a billionth of what they are do not jump. */
static int work_of_step(const Parameters *p, double extent, const Place *a, const Place *b, double *work)
{
    int halvings = MAX_SPLITS;
    double speed = 0.0;
    for (int k = 0; k < N_Q; k++)
        speed = larger(speed, larger(turn(a->v, k, extent), turn(b->v, k, extent)));
    return work_across(p, extent, a, b, 1e-12 + 1e-9 * speed, &halvings, work);
}

/* Works from the first of n + 1 samples on, (n + 1) x N_WORK, of which the first row is given. */
int gudgeon_kinematic_works(void *memory, long n, const double *t, const double *parameters, const double *q,
    const double *v, double *work, long *done)
{
    Course *course = memory;
    const double extent = course->extent;
    const Parameters *p = (const Parameters *)parameters;
    Place here = course->work;
    here.asked = &course->asked;
    *done = 0;
    int status = course->work_begun ? 0 : begin(t[0], q, v, p, &here);
    for (long i = 0; i < n && !status; i++) {
        Stride stride = {course->reach, extent, t[i + 1] - t[i], 0};
        double *sum = work + (i + 1) * N_WORK;
        for (int k = 0; k < N_WORK; k++)
            sum[k] = work[i * N_WORK + k];
        while (here.t < t[i + 1] && !status) {
            const Place before = here;
            status = step_on(&stride, t[i + 1], p, &here);
            if (!status)
                status = work_of_step(p, extent, &before, &here, sum);
        }
        *done = i + !status;
    }
    course->work = here;
    course->work_begun = 1;
    if (status == NO_NUMBER)
        course->work.t = work[(*done + 1) * N_WORK];
    return status;
}
