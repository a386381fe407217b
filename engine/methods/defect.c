/*
 * Defect of the dense output: by how much the interpolant of a step fails the equations of motion between its ends.
 */

/*
 * Rates of the interpolant at fraction theta of a step, whose coefficients are made: of the nested polynomial
 * y0 + w0 (d0 + w1 (d1 + ...)), each w being theta or 1 - theta, and of its derivative by Horner's scheme.
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

/*
 * Forces of films: accelerations `dy` that follow from a state inside a step differ from those of the interpolant,
 * `rate`, by the error of the forces there.
 */
/* The largest force of a film, N, and the joint that has it, -1 of none. */
static double largest_film_force(const RhsOutputs *rhs, int *where)
{
    double most = 0.0;
    *where = -1;
    for (int i = 0; i < N_CLEARANCES; i++)
        if (has_film(i) && total_force(&rhs->clearance[i]) > most)
            most = total_force(&rhs->clearance[i]), *where = i;
    return most;
}

#define RATE_ROUNDED (64.0 * DBL_EPSILON) /* of velocities, that a step's interpolant may err by rounding */

/*
 * A defect as a share of what a film's force, `most`, gives the lightest body, or of a part of the largest acceleration
 * of its kind if that is more. Of very short steps rates are differences of rounded velocities.
 */
static double film_share(const Integrator *run, const Step *step, const double *rate, const double *dy, double most,
    double part)
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

#define FILM_FORCE 1e4 /* times rtol: share of a film's force that may be wrong inside a step */
#define RODAS5P_FILM 3.0 /* times that: its interpolant errs all along the step, those of others between few nodes */
#define FILM_PART 0.03 /* of the largest acceleration: forces of films that give less are no better known */
#define FILM_FADED 1e-3 /* of the largest force of a film in a run: the audit measures errors of smaller ones by that */
#define FILM_AUDIT 1e5 /* the same of the audit, 1e-3 at least; ten times that of explicit methods, without control */

static double film_limit(const Integrator *run) { return min_of(0.1, max_of(3e-5, FILM_FORCE * tolerance_of(run))); }

static double film_audit_limit(const Integrator *run, const Step *step)
{
    return min_of(1.0, (step->method->stiff ? 1.0 : 10.0) * max_of(1e-3, FILM_AUDIT * tolerance_of(run)));
}

/* The share of films' forces that is wrong at a place inside a step; most: a force of theirs. -1: there is no state. */
static double film_share_at(Integrator *run, const Step *step, double theta, double most, const Parameters *p)
{
    double y[N_Y], dy[N_Y], rate[N_Y];
    int where;
    RhsOutputs rhs;
    if (state_at(run, step, theta, p, y, dy, &rhs))
        return -1.0;
    interpolate_rates(step, theta, 2 * N_X, rate);
    return film_share(run, step, rate, dy, max_of(most, largest_film_force(&rhs, &where)), FILM_PART);
}

/*
 * The error of films' forces inside a step, in multiples of their limit: where the interpolant errs most. A velocity
 * that is as good as the tolerance, times the damping of a thin film, may be any force.
 */
static double film_error(Integrator *run, Step *step, const Parameters *p)
{
    int where;
    const double ends = max_of(largest_film_force(&step->rhs, &where), largest_film_force(&run->rhs, &where));
    const double fraction = make_dense(run, p, step) ? -1.0 : film_share_at(run, step, step->method->between, ends, p);
    if (fraction < 0.0)
        return 0.0;
    run->films.h = step->h, run->films.steps = run->counts.steps;
    run->films.error = fraction / film_limit(run);
    if (step->method->lane == BY_RODAS5P)
        run->films.error *= RODAS5P_FILM;
    return run->films.error;
}

/*
 * Whether forces of films are wrong at an event inside a step: the error inside a step is measured at one place of the
 * whole step, and the state at the event is the start of what follows.
 */
static int misses_film_at(Integrator *run, const Step *step, double fraction, const Parameters *p)
{
    return has_films() && step->method->stiff && film_share_at(run, step, fraction, 0.0, p) > film_limit(run);
}

/* Rates of velocities of a stiff method's interpolant at an end of a step, by weights of its stages and of y - y0. */
static void rates_at_end(
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

#define FILM_SMALL 0.02 /* of the limit: with so small errors at the ends, that inside a step is seldom measured, */
#define FILM_LONGER 1.5 /* as long as steps are no longer than this times the one where it was */
enum { FILM_STEPS = 16 /* in each 16th */ };

/*
 * The error of films' forces at the ends of a step, in multiples of their limit, where it costs no right-hand side: at
 * its begin what the interpolant misses, at its end what iterations have left of a velocity. film_error has been seen
 * to be up to 37 times as large, of errors that were far below the limit.
 */
static double film_error_at_ends(const Integrator *run, const Step *step, double part)
{
    const Method *method = step->method;
    double rate[N_Y];
    int where;
    if (!method->stiff || !has_films())
        return 0.0;
    const double most = largest_film_force(&step->rhs, &where);
    rates_at_end(run, step, method->begins, method->n_begins, method->begins_end, rate);
    double fraction = film_share(run, step, rate, run->dy, most, part);
    if (method->n_ends) {
        rates_at_end(run, step, method->ends, method->n_ends, method->ends_end, rate);
        fraction = max_of(fraction, film_share(run, step, rate, step->dy, most, part));
    }
    return fraction / film_limit(run);
}

/* Whether errors of films' forces are so small, and were of late, that they need not be measured in this step. */
static int is_film_known(const Integrator *run, const Step *step, double at_ends)
{
    if (!step->method->stiff || !has_films())
        return 1;
    return run->films.error < FILM_SMALL && at_ends < FILM_SMALL && step->h < FILM_LONGER * run->films.h
        && !run->control.first && run->counts.steps - run->films.steps < FILM_STEPS;
}

/*
 * Whether a step that begins with a force of a film which fades at once, or rises, leads over that: where the
 * interpolant begins with other accelerations than the motion does, forces inside the step are wrong.
 */
static int misses_film(const Integrator *run, const Step *step, double at_ends)
{
    return at_ends > 1.0 && film_error_at_ends(run, step, 1.0) > 1.0;
}

/* The least mass of a body that has one, kg. */
static double lightest_mass(const Parameters *p)
{
    double m[N_Q], lightest = INFINITY;
    mass_matrix(p, m);
    for (int k = 0; k < N_Q; k += 3)
        lightest = m[k] > 0.0 ? min_of(lightest, m[k]) : lightest;
    return lightest;
}

static void start_films(Integrator *run, const Parameters *p)
{
    run->films.lightest = has_films() ? lightest_mass(p) : INFINITY;
}
