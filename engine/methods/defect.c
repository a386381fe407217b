/* Defect of the dense output: the residual of the equations of motion for the interpolant of a step. */

/*
 * Compute the first n rates dy of the dense output at fraction theta of a step by differentiate_dense_output(). The
 * dense output must have been computed.
 */
static inline void interpolate_rates(const Step *step, double theta, int n, double *restrict dy)
{
    differentiate_dense_output(step->h, (const double (*)[N_Y])step->dense, step->method->degree,
        step->method->reversed, theta, n, dy);
}

/*
 * Find the joint with the largest film force in `rhs` (magnitude, N). Return that force, and the number of the joint in
 * *joint; 0 and -1 if no film acts. Used by the audit to name the joint.
 */
static double find_joint_of_largest_film_force(const RhsOutputs *rhs, int *joint)
{
    double largest_force = 0.0;
    *joint = -1;
    for (int i = 0; i < N_CLEARANCES; i++)
        if (has_film(i) && compute_force_magnitude(&rhs->clearance[i]) > largest_force)
            largest_force = compute_force_magnitude(&rhs->clearance[i]), *joint = i;
    return largest_force;
}

#define FILM_ERROR_TOL 1e4 /* times rtol: allowed relative error of a film force inside a step */
#define RODAS5P_FILM_FACTOR 3.0 /* factor for rodas5p, whose dense output has errors all along the step */
#define MIN_FILM_FORCE_FRACTION 1e-3 /* of the largest film force of a run: smallest scale of film errors, audit */
#define FILM_AUDIT_TOL 1e5 /* times rtol: limit in the audit, at least 1e-3; explicit methods: tenfold, no control */

/* Return the allowed relative error of film forces inside a step: FILM_ERROR_TOL times rtol, between 3e-5 and 0.1. */
static double compute_film_error_limit(const Integrator *run)
{
    return min_of(0.1, max_of(3e-5, FILM_ERROR_TOL * get_rtol(run)));
}

/*
 * Return the limit of the relative error of film forces in the audit: FILM_AUDIT_TOL times rtol, at least 1e-3 and at
 * most 1. It is tenfold for explicit methods, whose film errors are not controlled.
 */
static double compute_film_audit_limit(const Integrator *run, const Step *step)
{
    return min_of(1.0, (step->method->stiff ? 1.0 : 10.0) * max_of(1e-3, FILM_AUDIT_TOL * get_rtol(run)));
}

/*
 * Return the relative error of film forces at fraction theta of a step, from one right-hand side at the interpolated
 * state. Return -1 if the state cannot be evaluated. min_force: smallest film force used as scale, N. The dense output
 * must have been computed.
 */
static double evaluate_relative_film_error(Integrator *run, const Step *step, double theta, double min_force,
    const Parameters *p)
{
    double y[N_Y], dy[N_Y], rate[N_Y];
    RhsOutputs rhs;
    if (evaluate_state_at(run, step, theta, p, y, dy, &rhs))
        return -1.0;
    interpolate_rates(step, theta, 2 * N_X, rate);
    return compute_relative_film_error(run, step, rate, dy, max_of(min_force, compute_largest_film_force(&rhs)),
        FILM_SCALE_FRACTION);
}

/*
 * Measure the error of film forces inside a step, at the fraction where its dense output is worst, in multiples of its
 * limit. The result is also stored in run->films with the step's length and number; for rodas5p it is
 * RODAS5P_FILM_FACTOR times as large. Return 0 if the dense output or the state there cannot be computed. A velocity
 * within its tolerance, times the damping of a thin film, may have any force.
 */
static double measure_film_error(Integrator *run, Step *step, const Parameters *p)
{
    const double force_at_ends =
        max_of(compute_largest_film_force(&step->rhs), compute_largest_film_force(&run->rhs));
    const double fraction = compute_dense_output(run, p, step)
        ? -1.0 : evaluate_relative_film_error(run, step, step->method->max_error_fraction, force_at_ends, p);
    if (fraction < 0.0)
        return 0.0;
    run->films.h = step->h, run->films.steps = run->counts.steps;
    run->films.error = fraction / compute_film_error_limit(run);
    if (step->method->lane_method == METHOD_RODAS5P)
        run->films.error *= RODAS5P_FILM_FACTOR;
    return run->films.error;
}

/*
 * Return whether the film forces at an event at `fraction` of a step have a larger error than
 * compute_film_error_limit() allows. evaluate_relative_film_error() estimates the error: it compares the rates of the
 * dense output with those of the right-hand side at the same state. That state is the start of the next step: if 1 is
 * returned, find_event_of_step() repeats the step to end just after the event. Always 0 for explicit methods and
 * without films.
 */
static int has_inaccurate_film_force_at_event(Integrator *run, const Step *step, double fraction, const Parameters *p)
{
    return has_films() && step->method->stiff && evaluate_relative_film_error(run, step, fraction, 0.0,
        p) > compute_film_error_limit(run);
}


/*
 * Return the error of film forces at both ends of a step in multiples of its limit, without evaluating a right-hand
 * side, by compute_film_error_at_ends(). Return 0 for explicit methods and without films. scale_fraction: fraction of
 * the largest acceleration that is the smallest scale of the error. For scale_fraction = FILM_SCALE_FRACTION, lanes
 * with a Radau method have computed it. It does not replace measure_film_error(), which evaluates the state inside the
 * step and was measured up to 37 times as large, for errors far below the limit.
 */
static double estimate_film_error_at_ends(const Integrator *run, const Step *step, double scale_fraction)
{
    if (!step->method->stiff || !has_films())
        return 0.0;
    const int is_computed_in_lane =
        step->stage_values_lane && step->method->lane_method >= METHOD_RADAU5 && scale_fraction == FILM_SCALE_FRACTION;
    return (is_computed_in_lane ? step->film_error
        : compute_film_error_at_ends(run, step, step->method->end_rates, scale_fraction))
        / compute_film_error_limit(run);
}

/*
 * Return whether the errors of film forces need not be measured inside this step: a stiff step with films is measured
 * unless they are known to be small. end_error: that at the ends of the step, in limits. Always 1 for explicit methods
 * and without films.
 *
 * The last measured error and end_error must be below MAX_SMALL_FILM_ERROR. Errors are measured at least every
 * MAX_UNMEASURED_FILM_STEPS steps, in steps FILM_LENGTH_RATIO longer than the last measured one, and in the first step
 * after an event. Called before a step is accepted.
 */
static int can_skip_film_error(const Integrator *run, const Step *step, double end_error)
{
    if (!step->method->stiff || !has_films())
        return 1;
    return is_last_film_error_valid(end_error, step->h, run->films.error, run->films.h,
        (double)(run->counts.steps - run->films.steps)) && !run->control.stored_first_length;
}

/*
 * Return whether a step passes over a film force that decays or rises at its beginning, so that it must be shortened.
 * end_error: result of estimate_film_error_at_ends() with FILM_SCALE_FRACTION; if it exceeds 1, it must also exceed 1
 * with a scale_fraction of 1.
 */
static int has_unresolved_film_force(const Integrator *run, const Step *step, double end_error)
{
    return end_error > 1.0 && estimate_film_error_at_ends(run, step, 1.0) > 1.0;
}

/* Return the smallest non-zero mass of a body, kg; infinity if no body has mass. */
static double find_lightest_mass(const Parameters *p)
{
    double m[N_Q], lightest = INFINITY;
    mass_matrix(p, m);
    for (int k = 0; k < N_Q; k += 3)
        lightest = m[k] > 0.0 ? min_of(lightest, m[k]) : lightest;
    return lightest;
}

/*
 * Set run->films.lightest_mass (kg), by which errors of film forces are scaled: the smallest mass of a body, infinity
 * without films. Called when the integration begins.
 */
static void set_film_mass_scale(Integrator *run, const Parameters *p)
{
    run->films.lightest_mass = has_films() ? find_lightest_mass(p) : INFINITY;
}
