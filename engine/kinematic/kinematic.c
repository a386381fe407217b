/*
 * Kinematic analysis of a linkage without degrees of freedom: drives determine its position at every time. Nothing is
 * integrated. The motion is followed by numerical continuation, in steps with a predictor and Newton's method as
 * corrector, so that it remains on its branch.
 */
#include "kinematic.h"

/* Return the size of the memory of a kinematic analysis, bytes. */
size_t gudgeon_kinematic_size(void) { return sizeof(KinematicRun); }

/*
 * Initialize the memory of a kinematic analysis. max_correction: largest correction of a first guess, rad or fraction
 * of the size; extent: size of the mechanism, m; t_end: end of the run, s. The callback poll(context) is called every
 * poll_interval s (0: at each step) and cancels the analysis if it returns nonzero.
 */
void gudgeon_kinematic_begin(
    void *analysis, double max_correction, double extent, double t_end, int (*poll)(void *), void *context,
    double poll_interval)
{
    KinematicRun *run = analysis;
    *run = (KinematicRun){.max_correction = max_correction, .extent = extent, .t_end = t_end};
    start_polling(&run->cancellation, poll, context, poll_interval);
}

/* Let the next call of gudgeon_kinematic() begin a new motion from its row 0, instead of resuming the old one. */
void gudgeon_kinematic_restart(void *analysis) { ((KinematicRun *)analysis)->has_motion_begun = 0; }

/*
 * Return the progress of a kinematic analysis: times of motion and works (t[2], s; NaN: works not begun).
 * advanced_time: time by which the last steps advanced, s. steps[0]: the number of these steps; steps[1]: 1 if they are
 * far shorter than earlier ones, 2 if their number grows exponentially with time, else 0. Called after a failure.
 */
void gudgeon_kinematic_progress(const void *analysis, double *t, double *advanced_time, long *steps)
{
    const KinematicRun *run = analysis;
    t[0] = run->motion.t;
    t[1] = run->has_work_begun ? run->work.t : NAN;
    *advanced_time = run->monitor.gain;
    steps[0] = MONITOR_STEPS;
    steps[1] = run->monitor.slowdown;
}

/* Return how many samples were interpolated at or near a change point; t: the time of the first one, s. */
long gudgeon_kinematic_count_interpolated(const void *analysis, double *t)
{
    const KinematicRun *run = analysis;
    *t = run->t_interpolated;
    return run->n_interpolated;
}

/*
 * Start a step record: write the ends of the following steps into `rows`, an array for `capacity` rows of t, q and v (1
 * + 2 N_Q numbers). The next row is the first one; steps beyond `capacity` are not recorded before
 * gudgeon_kinematic_fetch_records() is called. NULL: stop recording.
 */
void gudgeon_kinematic_set_recording(void *analysis, double *rows, long capacity)
{
    KinematicRun *run = analysis;
    run->step_record = rows;
    run->capacity = capacity;
    run->n_recorded = 0;
}

/* Return the number of rows recorded since the last call, and reset it: the next row overwrites the first one. */
long gudgeon_kinematic_fetch_records(void *analysis)
{
    KinematicRun *run = analysis;
    const long n = run->n_recorded;
    run->n_recorded = 0;
    return n;
}

/* Append a position to the step record, a row of (t, q, v), if recording is requested. */
static void record_position(KinematicRun *run, const Position *position)
{
    if (!run->step_record)
        return;
    double *row = run->step_record + (1 + 2 * N_Q) * run->n_recorded++;
    *row++ = position->t;
    memcpy(row, position->q, sizeof position->q);
    memcpy(row + N_Q, position->v, sizeof position->v);
}

/* Return the maximum of two numbers; NaN if `value` is NaN. */
static double get_larger_or_nan(double largest, double value)
{
    return value > largest || isnan(value) ? value : largest;
}

/*
 * Return the scaled maximum norm of a change or rate of q (N_Q), rad or rad/s; NaN is propagated. Lengths are divided
 * by the mechanism's size `extent`, m. Used for the works (works.c), for change points and for corrections.
 */
static double compute_scaled_max_norm(const double *change, double extent)
{
    double largest = 0.0;
    for (int k = 0; k < N_Q; k++)
        largest = get_larger_or_nan(largest, fabs(change[k]) / (k % 3 == 2 ? 1.0 : extent));
    return largest;
}

#if POSITIONS_IN_TREE
#include "tree.c"
#else
#include "full.c"
#endif
/*
 * Return the largest difference of positions b from a plus the trapezoidal rule of their velocities, rad; lengths are
 * divided by the mechanism's size `extent`, m. A large error shows that b is on another branch. NaN is propagated.
 */
static double compute_trapezoidal_error(const Position *a, const Position *b, double extent)
{
    const double half = 0.5 * (b->t - a->t), fraction = 1.0 / extent;
    double lengths = 0.0, angles = 0.0;
    for (int k = 0; k < N_Q; k += 3) {
        for (int c = k; c < k + 2; c++)
            lengths = get_larger_or_nan(lengths, fabs(b->q[c] - a->q[c] - half * (a->v[c] + b->v[c])));
        angles = get_larger_or_nan(angles, fabs(b->q[k + 2] - a->q[k + 2] - half * (a->v[k + 2] + b->v[k + 2])));
    }
    return get_larger_or_nan(angles, lengths * fraction);
}

#include "change_point.c"

#if N_TRANSIENTS
/*
 * Return whether a missed term of time can be ignored: only bounds show its excess, no sample does (is_certain = 0). A
 * callback of find_undersampled_term().
 */
static int is_term_negligible(void *context, double fraction, int is_certain)
{
    (void)context, (void)fraction;
    return !is_certain;
}

/*
 * Return whether the step from t0 to t1 (s) has an undersampled transient: a term of time alone acts only between the
 * five times at which ends and quadrature of works evaluate it. make_step() then halves the step.
 */
static int has_undersampled_transient(double t0, double t1, const Parameters *p)
{
    static const double node[] = {0.0, 0.1127016653792583, 0.5, 0.8872983346207417, 1.0};
    return find_undersampled_term(t0, t1 - t0, node, 5, is_term_negligible, NULL, p) > 0.0;
}
#else
/*
 * Return 0, no transient: the scene has no terms of time alone. Replaces the function above in such scenes, so that
 * make_step() halves no step because of a transient.
 */
static int has_undersampled_transient(double t0, double t1, const Parameters *p)
{
    (void)t0, (void)t1, (void)p;
    return 0;
}
#endif

/*
 * Return whether all constraint equations are finite at time t and the coordinates of `position`; an expression of a
 * drive may be undefined there.
 */
static int are_constraints_finite(double t, const Position *position, const Parameters *p)
{
    double phi[N_ALL_ROWS];
    constraints(t, position->q, p, phi);
    return all_finite(phi, N_ALL_ROWS);
}

/*
 * Make one step of `position` along the branch, of length step_length->h and to t1 at most. The step is halved while a
 * corrector or branch test fails: Newton's method fails or corrects the first guess by more than run->max_correction,
 * the trapezoidal error is too large (another branch), or the step hides a transient. Change points are passed by
 * pass_change_point(). After accurate steps a halved length is doubled again. Return 0, STOPPED, or a status after
 * MAX_HALVINGS.
 */
static int make_step(KinematicRun *run, StepLength *step_length, double t1, Position *position)
{
    const double max_error = MAX_STEP_ERROR * run->max_correction;
    for (;;) {
        Position next_position, position_past_change;
        double correction = 0.0, error = 0.0;
        if (is_cancelled(&run->cancellation))
            return STOPPED;
        const double next = position->t + step_length->h < t1 ? position->t + step_length->h : t1;
        const int status = next > position->t ? solve_position_at(run, next, position, &next_position, &correction)
            : NEWTON_FAILED;
        if (status == STOPPED)
            return status;
        if ((status || (next == t1 && is_ill_conditioned(&next_position))) && next > position->t
            && are_constraints_finite(next, position, run->p)
            && !pass_change_point(run, next, position, &position_past_change)) {
            *position = position_past_change;
            return 0;
        }
        const int is_near = !status && correction <= run->max_correction;
        if (is_near)
            error = compute_trapezoidal_error(position, &next_position, run->extent);
        if (is_near && error <= max_error
            && (step_length->halvings > MAX_HALVINGS_FOR_TRANSIENT
                || !has_undersampled_transient(position->t, next, run->p))) {
            *position = next_position;
            /* the error is proportional to h cubed */
            if (step_length->halvings > 0 && error < STEP_DOUBLING_ERROR * max_error) {
                step_length->h *= 2.0;
                step_length->halvings--;
            }
            return 0;
        }
        if (++step_length->halvings > MAX_HALVINGS || !(next > position->t))
            return status ? status : NEWTON_FAILED;
        step_length->h *= 0.5;
    }
}

/*
 * Follow the motion to time t1 in steps, record their ends, monitor progress, and complete the position at t1 for a
 * sample. steps: incremented by their number. Return 0, STALLED or a status, or EVENTS_FULL if the step record is full.
 */
static int follow_motion_to(KinematicRun *run, double t1, Position *position, long *steps)
{
    StepLength step_length = {t1 - position->t, 0};
    while (position->t < t1) {
        if (run->step_record && run->n_recorded == run->capacity)
            return EVENTS_FULL;
        const int status = make_step(run, &step_length, t1, position);
        if (status)
            return status;
        ++*steps;
        record_position(run, position);
        if (detect_stall(&run->monitor, position->t, run->t_end))
            return STALLED;
    }
    return complete_position(run, position);
}

/*
 * Update the statistics of a run by the sample at time t (s): maxima of |Phi| and |Phi_dot|, number and first time of
 * interpolated samples.
 */
static void accumulate_sample_statistics(KinematicRun *run, double t, const Position *position, double *phi_max,
    double *phi_dot_max)
{
    if (position->is_interpolated && !run->n_interpolated++)
        run->t_interpolated = t;
    *phi_max = max_of(position->phi, *phi_max);
    *phi_dot_max = max_of(position->phi_dot, *phi_dot_max);
}

/*
 * Compute the motion at n samples. t: n + 1 times, s; q, v, a: n + 1 rows of N_Q. Row 0 of q and v holds the initial
 * state, or the last sample of the previous call. The first call also writes row 0 of a and includes row 0 in the
 * maxima; a call that resumes the motion does not. phi_max, phi_dot_max: updated maxima. steps: incremented. done: the
 * last complete row, whatever status is returned. Return 0 or a status; after EVENTS_FULL the caller fetches the
 * records and calls again.
 */
int gudgeon_kinematic(void *analysis, long n, const double *t, const double *parameters, double *q, double *v,
    double *a, double *phi_max, double *phi_dot_max, long *steps, long *done)
{
    KinematicRun *run = analysis;
    Position *position = &run->motion;
    run->p = (const Parameters *)parameters;
    *done = 0;
    for (long i = run->has_motion_begun; i <= n; i++) {
        const int status = i > 0 ? follow_motion_to(run, t[i], position, steps)
            : set_initial_position(run, t[0], q, v, position);
        if (status)
            return status;
        run->has_motion_begun = 1;
        accumulate_sample_statistics(run, t[i], position, phi_max, phi_dot_max);
        if (i > 0) {
            memcpy(q + i * N_Q, position->q, sizeof position->q);
            memcpy(v + i * N_Q, position->v, sizeof position->v);
        }
        memcpy(a + i * N_Q, position->a, sizeof position->a);
        *done = i;
    }
    return 0;
}
