/*
 * Switching points of the user's expressions and user events along a step, for functions without bounds. They depend on
 * forces or on driven loops. Stages of a long step may miss an oscillation. Where a function may have a zero, it is
 * sampled on the dense output; a step that does not resolve it is repeated shorter. Scenes with bounds use watched.c.
 */
#if N_WATCHED
/* Evaluate the right-hand side's outputs at a state; its rates and status are discarded. */
static void sample_dense_output(Integrator *run, double t, const double *y, const Parameters *p, RhsOutputs *rhs)
{
    double dy[N_Y];
    (void)rates(run, t, y, p, dy, rhs);
}

/*
 * Return whether event function k may have a zero in the step: its smallest sample is less than the range of its
 * samples.
 */
static int may_have_zero(const Integrator *run, const Step *step, int k, double *range)
{
    const double start = event_function(&run->discrete, &run->rhs, k),
                 end = event_function(&run->discrete, &step->rhs, k);
    double least = min_of(start, end), most = max_of(start, end); /* the end may lie outside of the domain */
    const StageValues seen = stage_values(step, k);
    for (int i = 0; i < step->n_seen; i++) {
        least = min_of(least, stage_value(seen, i));
        most = max_of(most, stage_value(seen, i));
    }
    *range = most - least;
    return least < *range;
}

/*
 * Estimate by how much each watched function changes if the state changes by one error tolerance. Smaller values cannot
 * be resolved.
 */
static void event_function_uncertainty(Integrator *run, const Step *step, const Parameters *p, double *change)
{
    double y[N_Y];
    RhsOutputs rhs;
    for (int k = 0; k < N_Y; k++)
        y[k] = run->y[k] + (k < 2 * N_X ? 1.0 / run->norm.weight[k] : 0.0);
    sample_dense_output(run, step->t, y, p, &rhs);
    for (int i = 0; i < N_WATCHED; i++)
        change[i] = fabs(
            event_function(&run->discrete, &rhs, watched[i]) - event_function(&run->discrete, &run->rhs, watched[i]));
}

/* Estimate the interpolation error at an end by the difference of order 4 at most: f[0], f[out], ..., f[n out]. */
static double end_error(const double *f, int out, int n)
{
    const int order = n < 4 ? n : 4;
    double d[5] = {0.0};
    for (int k = 0; k <= order; k++)
        d[k] = f[k * out];
    for (int i = 0; i < order; i++)
        for (int k = order; k > i; k--)
            d[k] -= d[k - 1];
    return order > 0 ? fabs(d[order]) / (1 << order) : 0.0;
}

/*
 * Return the largest difference between the samples and cubics through every second sample. Stencils across the
 * interval after sample `at` are left out, because the function may jump there; N_SAMPLES: none.
 */
static double interpolation_error(const double *f, int at)
{
    double worst = 0.0;
    for (int j = 3; j + 3 <= N_SAMPLES; j += 2)
        if (j + 3 <= at || j - 3 > at)
            worst = max_of(worst, fabs(f[j] - (9.0 * (f[j - 1] + f[j + 1]) - f[j - 3] - f[j + 3]) / 16.0));
    if (at >= N_SAMPLES)
        return worst;
    return max_of(worst, max_of(end_error(f + at, -1, at), end_error(f + at + 1, 1, N_SAMPLES - at - 1)));
}

/*
 * Return the interpolation error of the samples of a step; for a function with a jump of value or slope, on both sides
 * of the jump. A shorter step would not reduce that jump. Errors below `enough` end the search.
 */
static double resolution_error(const double *f, double enough)
{
    double least = interpolation_error(f, N_SAMPLES);
    for (int at = 0; at < N_SAMPLES && least > enough; at++)
        least = min_of(least, interpolation_error(f, at));
    return least;
}

/* Return whether samples do not resolve a watched function that may have a zero, so that the step is too long. */
static int is_unresolved(Integrator *run, Step *step, const Parameters *p)
{
    double range[N_WATCHED], change[N_WATCHED];
    step->has_zero_bracket = 0;
    for (int i = 0; i < N_WATCHED; i++) {
        step->near[i] = (unsigned char)may_have_zero(run, step, watched[i], &range[i]);
        step->has_zero_bracket |= step->near[i];
    }
    if (!step->has_zero_bracket || compute_dense_output(run, p, step))
        return 0;
    for (int j = 0; j <= N_SAMPLES; j++) {
        double y[N_Y];
        RhsOutputs rhs = j < N_SAMPLES ? run->rhs : step->rhs;
        if (j > 0 && j < N_SAMPLES) {
            interpolate(run, step, (double)j / N_SAMPLES, y);
            sample_dense_output(run, step->t + (double)j / N_SAMPLES * step->h, y, p, &rhs);
        }
        for (int i = 0; i < N_WATCHED; i++)
            step->sample[i][j] = event_function(&run->discrete, &rhs, watched[i]);
    }
    if (N_SAMPLES * event_time_tolerance(run, step) >= 1.0)
        return 0; /* the samples are as near as times can be (a pole, many jumps) */
    event_function_uncertainty(run, step, p, change);
    for (int i = 0; i < N_WATCHED; i++) {
        double least = INFINITY, most = -INFINITY;
        for (int j = 0; j <= N_SAMPLES; j++) {
            least = min_of(least, step->sample[i][j]);
            most = max_of(most, step->sample[i][j]);
        }
        const double allowed = max_of(0.05 * (most - least), 10.0 * change[i]),
                     missed = resolution_error(step->sample[i], allowed);
        /* stages with a far larger range than the samples: the samples are in step with an oscillation */
        const int is_aliased = range[i] > 2.0 * (most - least) + 10.0 * change[i] && !step->method->stiff;
        if (step->near[i] && (missed > allowed || is_aliased) && least - missed < 0.0)
            return 1;
    }
    return 0;
}

/*
 * Return the minimum of event function k near s, by parabolas over `width` on both sides; s is moved there. best: its
 * value at s. The search ends at the first negative value.
 */
static double refine_minimum(
    Integrator *run, const Step *step, int k, double *s, double width, double best, const Parameters *p)
{
    for (; width > 1e-6 && best >= 0.0 && *s - width >= 0.0 && *s + width <= 1.0; width *= 0.5) {
        const double left = event_function_at(run, step, *s - width, k, p),
                     right = event_function_at(run, step, *s + width, k, p);
        const double bend = left - 2.0 * best + right;
        double at[3] = {*s - width, *s + width, *s}, value[3] = {left, right, best};
        if (bend > 0.0) {
            at[2] = min_of(at[1], max_of(at[0], *s + 0.5 * width * (left - right) / bend));
            value[2] = event_function_at(run, step, at[2], k, p);
        }
        for (int j = 0; j < 3; j++)
            if (value[j] < best) {
                best = value[j];
                *s = at[j];
            }
        if (best > 8.0 * bend)
            break; /* the parabola has no zero */
    }
    return best;
}

/*
 * Return the first fraction at which watched function i is negative, by its samples and minima between them; 0: none.
 */
static double first_negative_sample(Integrator *run, const Step *step, int i, const Parameters *p, double *value)
{
    const double *f = step->sample[i];
    for (int j = 1; j <= N_SAMPLES && step->near[i]; j++) {
        const double bend = j > 1 ? f[j - 2] - 2.0 * f[j - 1] + f[j] : 0.0;
        if (bend > 0.0 && f[j - 2] > f[j - 1] && f[j - 1] <= f[j]) {
            const double way = 0.5 * (f[j - 2] - f[j]) / bend, lowest = f[j - 1] - 0.5 * bend * way * way;
            double at = (j - 1 + way) / N_SAMPLES;
            if (lowest < 0.1 * f[j - 1]) {
                *value = event_function_at(run, step, at, watched[i], p);
                *value = refine_minimum(run, step, watched[i], &at, 0.5 / N_SAMPLES, *value, p);
                if (*value < 0.0)
                    return at;
            }
        }
        if (f[j] < 0.0) {
            *value = f[j];
            return (double)j / N_SAMPLES;
        }
    }
    return 0.0;
}

/* Reset the brackets of the watched functions; their zeros are found from the samples. */
static void search_step(const Integrator *run, Step *step, const Parameters *p)
{
    (void)run, (void)p;
    for (int i = 0; i < N_WATCHED; i++)
        step->from[i] = 0.0;
}

#else
/* Return 0: the scene has no watched functions. */
static inline int is_unresolved(const Integrator *run, const Step *step, const Parameters *p)
{
    (void)run, (void)step, (void)p;
    return 0;
}

/* Do nothing: the scene has no watched functions. */
static inline void search_step(const Integrator *run, const Step *step, const Parameters *p)
{
    (void)run, (void)step, (void)p;
}

/* Return 0: the scene has no watched functions. */
static inline double first_negative_sample(
    const Integrator *run, const Step *step, int i, const Parameters *p, double *value)
{
    (void)run, (void)step, (void)i, (void)p;
    return *value = 0.0;
}
#endif
