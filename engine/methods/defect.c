/* Defect of the dense output: by how much the interpolant of a step fails the equations of motion between its ends. */

/*
 * Compute the rates of the dense output at fraction theta of a step. The nested polynomial is y0 + w0 (d0 + w1 (d1 +
 * ...)), each w being theta or 1 - theta; its derivative follows by Horner's scheme.
 */
static inline void interpolate_rates(const Step *step, double theta, int rows, double *restrict dy)
{
    const Method *method = step->method;
    double value = 1.0 / step->h, rate = 0.0; /* of a product of factors theta and 1 - theta */
    for (int i = 0; i < rows; i++)
        dy[i] = 0.0;
    for (int k = 0; k < method->degree; k++) {
        const int turned = method->turned >> k & 1;
        const double w = turned ? 1.0 - theta : theta, *of = step->dense[k];
        rate = rate * w + (turned ? -value : value);
        value *= w;
        for (int i = 0; i < rows; i++)
            dy[i] += rate * of[i];
    }
}

/* Return the largest film force in N, and in *where its joint, -1: none. */
static double largest_film_force(const RhsOutputs *rhs, int *where)
{
    double most = 0.0;
    *where = -1;
    for (int i = 0; i < N_CLEARANCES; i++)
        if (has_film(i) && total_force(&rhs->clearance[i]) > most)
            most = total_force(&rhs->clearance[i]), *where = i;
    return most;
}

#define RATE_ROUNDED (64.0 * DBL_EPSILON) /* relative rounding of velocities in the dense output */

/*
 * Return the relative error of film forces from the accelerations `dy` of a state and `rate` of the dense output there.
 * The scale is the acceleration of the lightest body by a film force `most` (N), or `part` of the largest acceleration
 * of its kind, if larger. Rounding of velocities over short steps is subtracted.
 */
static double relative_film_error(const Integrator *run, const Step *step, const double *rate, const double *dy,
    double most, double part)
{
    const double rounded = RATE_ROUNDED / step->h;
    double off[2] = {0.0, 0.0}, largest[2], fraction = 0.0;
    largest[0] = most / run->films.lightest;
    largest[1] = largest[0] * run->norm.least[1] / run->norm.least[0];
    for (int k = N_X; k < 2 * N_X && most > 0.0; k++) {
        const int kind = !!is_angle[k - N_X];
        off[kind] = max_of(off[kind], fabs(rate[k] - dy[k]) - rounded * fabs(run->y[k]));
        largest[kind] = max_of(largest[kind], part * max_of(fabs(run->dy[k]), max_of(fabs(rate[k]), fabs(dy[k]))));
    }
    for (int kind = 0; kind < 2; kind++)
        fraction = max_of(fraction, largest[kind] > 0.0 ? off[kind] / largest[kind] : 0.0);
    return fraction;
}

#define FILM_FORCE 1e4 /* times rtol: allowed relative error of a film force inside a step */
#define RODAS5P_FILM 3.0 /* factor for rodas5p, whose dense output has errors all along the step */
#define FILM_PART 0.03 /* of the largest acceleration: smaller effects of film forces are less accurate */
#define FILM_FADED 1e-3 /* of the largest film force of a run: smallest scale of film errors in the audit */
#define FILM_AUDIT 1e5 /* times rtol: limit in the audit, at least 1e-3; explicit methods: tenfold, no control */

/* Return the allowed relative error of film forces inside a step. */
static double film_limit(const Integrator *run) { return min_of(0.1, max_of(3e-5, FILM_FORCE * tolerance_of(run))); }

/* Return the limit of the relative error of film forces in the audit. */
static double film_audit_limit(const Integrator *run, const Step *step)
{
    return min_of(1.0, (step->method->stiff ? 1.0 : 10.0) * max_of(1e-3, FILM_AUDIT * tolerance_of(run)));
}

/*
 * Return the relative error of film forces at fraction theta of a step, -1 if the state is undefined. most: a film
 * force in N as a smallest scale.
 */
static double relative_film_error_at(Integrator *run, const Step *step, double theta, double most, const Parameters *p)
{
    double y[N_Y], dy[N_Y], rate[N_Y];
    int where;
    RhsOutputs rhs;
    if (state_at(run, step, theta, p, y, dy, &rhs))
        return -1.0;
    interpolate_rates(step, theta, 2 * N_X, rate);
    return relative_film_error(run, step, rate, dy, max_of(most, largest_film_force(&rhs, &where)), FILM_PART);
}

/*
 * Return the error of film forces inside a step in multiples of its limit, at the fraction where the dense output has
 * its largest error. A velocity within the tolerance, times the damping of a thin film, may give any force.
 */
static double measure_film_error(Integrator *run, Step *step, const Parameters *p)
{
    int where;
    const double ends = max_of(largest_film_force(&step->rhs, &where), largest_film_force(&run->rhs, &where));
    const double fraction = compute_dense_output(run, p, step)
        ? -1.0 : relative_film_error_at(run, step, step->method->between, ends, p);
    if (fraction < 0.0)
        return 0.0;
    run->films.h = step->h, run->films.steps = run->counts.steps;
    run->films.error = fraction / film_limit(run);
    if (step->method->lane == BY_RODAS5P)
        run->films.error *= RODAS5P_FILM;
    return run->films.error;
}

/*
 * Return whether film forces of a stiff method are wrong at an event at `fraction` of a step. The state there is the
 * start of the next step.
 */
static int has_wrong_film_force_at(Integrator *run, const Step *step, double fraction, const Parameters *p)
{
    return has_films() && step->method->stiff && relative_film_error_at(run, step, fraction, 0.0, p) > film_limit(run);
}

/*
 * Compute the rates of velocities of a stiff method's dense output at an end of a step. weight: of its n stages;
 * of_end: of y - y0.
 */
static void compute_end_rates(
    const Integrator *run, const Step *step, const double *weight, int n, double of_end, double *rate)
{
    const double *k = step->stages_lane ? step->stages_lane : step->k[0];
    const int stride = step->stages_lane ? step->lanes : 1;
    for (int i = N_X; i < 2 * N_X; i++) {
        rate[i] = of_end * (step->y[i] - run->y[i]);
        for (int s = 0; s < n; s++)
            rate[i] += weight[s] * k[(s * N_Y + i) * stride];
        rate[i] /= step->h;
    }
}

#define FILM_SMALL 0.02 /* of the limit: with smaller errors at the ends, the error inside is measured rarely */
#define FILM_LONGER 1.5 /* times the last measured step: longer steps are measured */
enum { FILM_STEPS = 16 /* steps between two measurements */ };

/*
 * Return the error of film forces at the ends of a step in multiples of the limit, without a right-hand side. At the
 * beginning it is the error of the dense output, at the end that of the iteration of velocities. measure_film_error()
 * was observed to be up to 37 times as large, for errors far below the limit.
 */
static double film_error_at_ends(const Integrator *run, const Step *step, double part)
{
    const Method *method = step->method;
    double rate[N_Y];
    int where;
    if (!method->stiff || !has_films())
        return 0.0;
    const double most = largest_film_force(&step->rhs, &where);
    compute_end_rates(run, step, method->begins, method->n_begin_weights, method->begin_weight_of_end, rate);
    double fraction = relative_film_error(run, step, rate, run->dy, most, part);
    if (method->n_end_weights) {
        compute_end_rates(run, step, method->ends, method->n_end_weights, method->end_weight_of_end, rate);
        fraction = max_of(fraction, relative_film_error(run, step, rate, step->dy, most, part));
    }
    return fraction / film_limit(run);
}

/* Return whether the errors of film forces are, and were recently, so small that this step need not be measured. */
static int is_film_error_small(const Integrator *run, const Step *step, double at_ends)
{
    if (!step->method->stiff || !has_films())
        return 1;
    return run->films.error < FILM_SMALL && at_ends < FILM_SMALL && step->h < FILM_LONGER * run->films.h
        && !run->control.first && run->counts.steps - run->films.steps < FILM_STEPS;
}

/*
 * Return whether a step passes over a film force that decays or rises at its beginning. Then the accelerations of the
 * dense output differ from those of the motion there.
 */
static int has_wrong_film_force(const Integrator *run, const Step *step, double at_ends)
{
    return at_ends > 1.0 && film_error_at_ends(run, step, 1.0) > 1.0;
}

/* Return the smallest non-zero mass of a body, kg. */
static double lightest_mass(const Parameters *p)
{
    double m[N_Q], lightest = INFINITY;
    mass_matrix(p, m);
    for (int k = 0; k < N_Q; k += 3)
        lightest = m[k] > 0.0 ? min_of(lightest, m[k]) : lightest;
    return lightest;
}

/* Set the smallest mass by which errors of film forces are scaled. */
static void start_films(Integrator *run, const Parameters *p)
{
    run->films.lightest = has_films() ? lightest_mass(p) : INFINITY;
}
