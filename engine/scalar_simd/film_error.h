/*
 * Error of film forces at both ends of a step: the accelerations of its dense output against those of the equations of
 * motion, relative to the acceleration that the largest film force gives the lightest body.
 */
#define RATE_ROUNDING (64.0 * DBL_EPSILON) /* relative rounding of velocities in the dense output */
#define FILM_SCALE_FRACTION 0.03 /* of the largest acceleration: smaller effects of film forces are less accurate */

/*
 * Weights by which h times the rates of a stiff method's dense output at an end of a step follow from its stages, and
 * the weight of y - y0. n_end = 0: the rates at the end are those of the equations.
 */
typedef struct {
    double begin[8], begin_weight_of_end, end[4], end_weight_of_end;
    int n_begin, n_end;
} EndRateWeights;

/* Return the largest film force of all joints, N; 0 if no film acts. */
static Real compute_largest_film_force(const RhsOutputsOf *rhs)
{
    Real largest = make_real(0.0);
    for (int i = 0; i < N_CLEARANCES; i++) {
        const ClearanceOf *joint = &rhs->clearance[i];
        if (!has_film(i))
            continue;
        const Real force = real_sqrt(joint->F_n * joint->F_n + joint->F_t * joint->F_t);
        largest = select_value(force > largest, force, largest);
    }
    return largest;
}

/*
 * Return the relative error of film forces: the difference of the accelerations `dy` of a state and `rate` of the dense
 * output. The scale is the acceleration of the lightest body by `film_force` (N), or `scale_fraction` of the largest
 * acceleration of the same kind (length or angle) if that is larger. Rounding of velocities over the step is
 * subtracted. The result is 0 if film_force is 0.
 */
static Real compute_relative_film_error(const IntegratorOf *run, const StepOf *step, const Real *rate, const Real *dy,
    Real film_force, double scale_fraction)
{
    const Real rate_rounding = RATE_ROUNDING / step->h;
    Real difference[2] = {make_real(0.0), make_real(0.0)}, largest[2], fraction = make_real(0.0);
    largest[0] = film_force / run->films.lightest_mass;
    largest[1] = largest[0] * run->norm.min_size[1] / run->norm.min_size[0];
    for (int k = N_X; k < 2 * N_X; k++) {
        const int kind = !!is_angle[k - N_X];
        difference[kind] = real_max(difference[kind], real_abs(rate[k] - dy[k]) - rate_rounding * real_abs(run->y[k]));
        largest[kind] = real_max(largest[kind], scale_fraction * real_max(real_abs(run->dy[k]),
            real_max(real_abs(rate[k]), real_abs(dy[k]))));
    }
    for (int kind = 0; kind < 2; kind++)
        fraction = real_max(fraction,
            select_value(largest[kind] > 0.0, difference[kind] / largest[kind], make_real(0.0)));
    return select_value(film_force > 0.0, fraction, make_real(0.0));
}

/*
 * Compute the rates of the velocities (`rate`, N_X ... 2 N_X - 1) of a stiff method's dense output at one end of a
 * step. They are (sum of stage_weights times the n stages + end_weight (y - y0)) / h.
 */
static void compute_end_rates(const IntegratorOf *run, const StepOf *step, const double *stage_weights, int n,
    double end_weight, Real *rate)
{
    for (int i = N_X; i < 2 * N_X; i++) {
        Real sum = end_weight * (step->y[i] - run->y[i]);
        for (int s = 0; s < n; s++)
            sum += stage_weights[s] * read_stage_component(step, s, i);
        rate[i] = sum / step->h;
    }
}

/*
 * Compute the first n rates dy of a dense output at fraction theta of a step of length h (s), by differentiating its
 * polynomial. The nested polynomial is y0 + w0 (d0 + w1 (d1 + ...)) of this degree, each w being theta or 1 - theta
 * (bit k of `reversed`).
 */
static inline void differentiate_dense_output(Real h, const Real (*dense)[N_Y], int degree, int reversed, double theta,
    int n, Real *restrict dy)
{
    Real value = 1.0 / h, rate = make_real(0.0); /* of a product of factors theta and 1 - theta */
    for (int i = 0; i < n; i++)
        dy[i] = make_real(0.0);
    for (int k = 0; k < degree; k++) {
        const int is_reversed = reversed >> k & 1;
        const double w = is_reversed ? 1.0 - theta : theta;
        const Real *coefficients = dense[k];
        rate = rate * w + (is_reversed ? -value : value);
        value *= w;
        for (int i = 0; i < n; i++)
            dy[i] += rate * coefficients[i];
    }
}

/*
 * Return the relative error of film forces at both ends of a step of a stiff method. At the beginning it is the error
 * of the dense output, at the end that of the iteration of velocities. scale_fraction: see
 * compute_relative_film_error().
 */
static Real compute_film_error_at_ends(const IntegratorOf *run, const StepOf *step, const EndRateWeights *weights,
    double scale_fraction)
{
    const Real film_force = compute_largest_film_force(&step->rhs);
    Real rate[N_Y];
    compute_end_rates(run, step, weights->begin, weights->n_begin, weights->begin_weight_of_end, rate);
    Real fraction = compute_relative_film_error(run, step, rate, run->dy, film_force, scale_fraction);
    if (weights->n_end) {
        compute_end_rates(run, step, weights->end, weights->n_end, weights->end_weight_of_end, rate);
        fraction =
            real_max(fraction, compute_relative_film_error(run, step, rate, step->dy, film_force, scale_fraction));
    }
    return fraction;
}
