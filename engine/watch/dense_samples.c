/*
 * Search for switching points and user events in a step by sampling, for functions without interval bounds. They depend
 * on forces or on driven loops. Stages of a long step may miss an oscillation. Where a function may have a zero, it is
 * sampled on the dense output; a step that does not resolve it is repeated shorter. Scenes with bounds use watched.c.
 * Monitored functions are the N_MONITORED event functions that are searched: switching functions and user events;
 * monitored_event[i] is the number of function i among all event functions.
 */
#if N_MONITORED
/* Evaluate the outputs rhs of the right-hand side at a state y and time t (s); rates and status are discarded. */
static void evaluate_rhs_outputs(Integrator *run, double t, const double *y, const Parameters *p, RhsOutputs *rhs)
{
    double dy[N_Y];
    (void)evaluate_run_rhs(run, t, y, p, dy, rhs);
}

/*
 * Return whether an event function may have a zero in the step: the minimum of its samples at ends and stages is less
 * than the range of the samples. *value_range: that range, maximum minus minimum.
 */
static int may_have_zero(const Integrator *run, const Step *step, int event, double *value_range)
{
    const double start = compute_event_value(&run->discrete, &run->rhs, event),
                 end = compute_event_value(&run->discrete, &step->rhs, event);
    double smallest = min_of(start, end), largest = max_of(start, end); /* the end may lie outside of the domain */
    const StageValues stages = get_stage_values(step, event);
    for (int i = 0; i < step->n_stored_stages; i++) {
        smallest = min_of(smallest, read_stage(stages, i));
        largest = max_of(largest, read_stage(stages, i));
    }
    *value_range = largest - smallest;
    return smallest < *value_range;
}

/*
 * Estimate by how much each monitored function changes if all coordinates and velocities at the beginning of a step are
 * raised by one error tolerance at once: uncertainty (N_MONITORED), by one evaluation. Smaller values cannot be
 * resolved. Called by is_step_unresolved() for the allowed error of samples.
 */
static void estimate_tolerance_uncertainty(Integrator *run, const Step *step, const Parameters *p,
    double *uncertainty)
{
    double y[N_Y];
    RhsOutputs rhs;
    for (int k = 0; k < N_Y; k++)
        y[k] = run->y[k] + (k < 2 * N_X ? 1.0 / run->norm.weight[k] : 0.0);
    evaluate_rhs_outputs(run, step->t, y, p, &rhs);
    for (int i = 0; i < N_MONITORED; i++)
        uncertainty[i] = fabs(
            compute_event_value(&run->discrete, &rhs, monitored_event[i])
                - compute_event_value(&run->discrete, &run->rhs, monitored_event[i]));
}

/*
 * Estimate the interpolation error at the end f[0] of n_intervals + 1 samples f[0], f[stride], ...; stride 1 runs
 * forwards from f[0], -1 backwards. It is |difference of order k|/2^k with k = 4, or n_intervals if less. Return 0 for
 * n_intervals = 0. Called for the samples before and for those after a jump.
 */
static double estimate_end_error(const double *f, int stride, int n_intervals)
{
    const int order = n_intervals < 4 ? n_intervals : 4;
    double difference[5] = {0.0};
    for (int k = 0; k <= order; k++)
        difference[k] = f[k * stride];
    for (int i = 0; i < order; i++)
        for (int k = order; k > i; k--)
            difference[k] -= difference[k - 1];
    return order > 0 ? fabs(difference[order]) / (1 << order) : 0.0;
}

/*
 * Return the largest difference between `samples` (N_SAMPLES + 1) and cubics through every second sample. The function
 * may jump between samples jump_index and jump_index + 1: stencils across are left out, and the errors at both ends are
 * added. N_SAMPLES: no jump.
 */
static double compute_interpolation_error(const double *samples, int jump_index)
{
    double largest = 0.0;
    for (int j = 3; j + 3 <= N_SAMPLES; j += 2)
        if (j + 3 <= jump_index || j - 3 > jump_index)
            largest = max_of(largest, fabs(samples[j]
                - (9.0 * (samples[j - 1] + samples[j + 1]) - samples[j - 3] - samples[j + 3]) / 16.0));
    if (jump_index >= N_SAMPLES)
        return largest;
    return max_of(largest, max_of(estimate_end_error(samples + jump_index, -1, jump_index),
        estimate_end_error(samples + jump_index + 1, 1, N_SAMPLES - jump_index - 1)));
}

/*
 * Return the interpolation error of `samples` (N_SAMPLES + 1) of a step, for the position of one jump of value or
 * slope that makes it smallest. A shorter step would not reduce that jump. Errors below `sufficient_error` end the
 * search.
 */
static double compute_resolution_error(const double *samples, double sufficient_error)
{
    double smallest = compute_interpolation_error(samples, N_SAMPLES);
    for (int jump = 0; jump < N_SAMPLES && smallest > sufficient_error; jump++)
        smallest = min_of(smallest, compute_interpolation_error(samples, jump));
    return smallest;
}

/*
 * Return whether samples of the dense output do not resolve a monitored function that may have a zero, so that the step
 * is too long. It is unresolved if cubics between the samples err by more than 0.05 of their range, or if the stages of
 * an explicit step have more than twice that range (aliasing). Stores the samples in step->sample, and in
 * step->may_be_zero which functions may have a zero. Return 0 without such a function, without dense output, or if
 * samples are as near as event times. Called for each tried step before it is accepted; such a step is repeated
 * shorter.
 */
static int is_step_unresolved(Integrator *run, Step *step, const Parameters *p)
{
    double range[N_MONITORED], uncertainties[N_MONITORED];
    step->has_zero_bracket = 0;
    for (int i = 0; i < N_MONITORED; i++) {
        step->may_be_zero[i] = (unsigned char)may_have_zero(run, step, monitored_event[i], &range[i]);
        step->has_zero_bracket |= step->may_be_zero[i];
    }
    if (!step->has_zero_bracket || compute_dense_output(run, p, step))
        return 0;
    for (int sample = 0; sample <= N_SAMPLES; sample++) {
        double y[N_Y];
        RhsOutputs rhs = sample < N_SAMPLES ? run->rhs : step->rhs;
        if (sample > 0 && sample < N_SAMPLES) {
            interpolate(run, step, (double)sample / N_SAMPLES, y);
            evaluate_rhs_outputs(run, step->t + (double)sample / N_SAMPLES * step->h, y, p, &rhs);
        }
        for (int i = 0; i < N_MONITORED; i++)
            step->sample[i][sample] = compute_event_value(&run->discrete, &rhs, monitored_event[i]);
    }
    if (N_SAMPLES * compute_event_time_tolerance(run, step) >= 1.0)
        return 0; /* the samples are as near as times can be (a pole, many jumps) */
    estimate_tolerance_uncertainty(run, step, p, uncertainties);
    for (int i = 0; i < N_MONITORED; i++) {
        double smallest = INFINITY, largest = -INFINITY;
        for (int sample = 0; sample <= N_SAMPLES; sample++) {
            smallest = min_of(smallest, step->sample[i][sample]);
            largest = max_of(largest, step->sample[i][sample]);
        }
        const double allowed = max_of(0.05 * (largest - smallest), 10.0 * uncertainties[i]),
                     error = compute_resolution_error(step->sample[i], allowed);
        /* stages with a far larger range than the samples: the samples are in step with an oscillation */
        const int is_aliased = range[i] > 2.0 * (largest - smallest) + 10.0 * uncertainties[i] && !step->method->stiff;
        if (step->may_be_zero[i] && (error > allowed || is_aliased) && smallest - error < 0.0)
            return 1;
    }
    return 0;
}

/*
 * Find the minimum of an event function near *fraction by parabolas over `width` on both sides, which is halved down to
 * 1e-6. *fraction is moved to the smallest value found, which is returned; smallest: the value there at the start. The
 * search ends at the first negative value, or if the parabola has no zero. Called if a parabola through three samples
 * comes near zero.
 */
static double refine_minimum(
    Integrator *run, const Step *step, int event, double *fraction, double width, double smallest, const Parameters *p)
{
    for (; width > 1e-6 && smallest >= 0.0 && *fraction - width >= 0.0 && *fraction + width <= 1.0; width *= 0.5) {
        const double left = evaluate_event_function_at(run, step, *fraction - width, event, p),
                     right = evaluate_event_function_at(run, step, *fraction + width, event, p);
        const double second_difference = left - 2.0 * smallest + right;
        double fractions[3] = {*fraction - width, *fraction + width, *fraction}, value[3] = {left, right, smallest};
        if (second_difference > 0.0) {
            fractions[2] = min_of(fractions[1],
                max_of(fractions[0], *fraction + 0.5 * width * (left - right) / second_difference));
            value[2] = evaluate_event_function_at(run, step, fractions[2], event, p);
        }
        for (int j = 0; j < 3; j++)
            if (value[j] < smallest) {
                smallest = value[j];
                *fraction = fractions[j];
            }
        if (smallest > 8.0 * second_difference)
            break; /* the parabola has no zero */
    }
    return smallest;
}

/*
 * Return the first fraction of the step at which a monitored function (switching function or user event) is negative,
 * and its value there in *value; 0: none, *value is then undefined. index: of the monitored function; functions without
 * a possible zero (step->may_be_zero) are not searched. Samples are tested in order; between them, the minimum of a
 * parabola that comes near zero is refined (refine_minimum()).
 */
static double find_first_negative_sample(Integrator *run, const Step *step, int index, const Parameters *p,
    double *value)
{
    const double *f = step->sample[index];
    for (int j = 1; j <= N_SAMPLES && step->may_be_zero[index]; j++) {
        const double second_difference = j > 1 ? f[j - 2] - 2.0 * f[j - 1] + f[j] : 0.0;
        if (second_difference > 0.0 && f[j - 2] > f[j - 1] && f[j - 1] <= f[j]) {
            const double offset = 0.5 * (f[j - 2] - f[j]) / second_difference,
                minimum = f[j - 1] - 0.5 * second_difference * offset * offset;
            double fraction = (j - 1 + offset) / N_SAMPLES;
            if (minimum < 0.1 * f[j - 1]) {
                *value = evaluate_event_function_at(run, step, fraction, monitored_event[index], p);
                *value = refine_minimum(run, step, monitored_event[index], &fraction, 0.5 / N_SAMPLES, *value, p);
                if (*value < 0.0)
                    return fraction;
            }
        }
        if (f[j] < 0.0) {
            *value = f[j];
            return (double)j / N_SAMPLES;
        }
    }
    return 0.0;
}

/*
 * Set the brackets of all monitored event functions to none (step->bracket_begin = 0). Nothing is evaluated here:
 * without interval bounds, find_first_negative_sample() searches the samples instead. Called by find_first_event().
 * With interval bounds, watched.c defines this function and finds the brackets.
 */
static void bracket_first_zeros(const Integrator *run, Step *step, const Parameters *p)
{
    (void)run, (void)p;
    for (int i = 0; i < N_MONITORED; i++)
        step->bracket_begin[i] = 0.0;
}

#else
/* Return 0, the step is resolved: the scene has no monitored functions. */
static inline int is_step_unresolved(const Integrator *run, const Step *step, const Parameters *p)
{
    (void)run, (void)step, (void)p;
    return 0;
}

/* Do nothing: the scene has no monitored functions. */
static inline void bracket_first_zeros(const Integrator *run, const Step *step, const Parameters *p)
{
    (void)run, (void)step, (void)p;
}

/* Return 0, no sample is negative, and set *value to 0: the scene has no monitored functions. */
static inline double find_first_negative_sample(
    const Integrator *run, const Step *step, int index, const Parameters *p, double *value)
{
    (void)run, (void)step, (void)index, (void)p;
    return *value = 0.0;
}
#endif
