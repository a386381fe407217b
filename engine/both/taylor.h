/*
 * A step by the motion's own series: how far it is good for, and the state there. Of one run a SeriesPart is so many
 * components of the state side by side, in lanes it is one of so many runs.
 */
enum { SERIES_PART = sizeof(SeriesPart) / sizeof(Real) };

/* The longest step whose last two terms are no larger than the tolerance. */
static Real taylor_reach(const RunOf *run)
{
    const int n = run->order;
    const Real *last = run->series[n], *before = run->series[n - 1];
    Real most = real_of(0.0), most_before = real_of(0.0);
    for (int i = 0; i < N_Y; i++) {
        most = real_max(most, real_abs(last[i]) * run->weight[i]);
        most_before = real_max(most_before, real_abs(before[i]) * run->weight[i]);
    }
    return real_exp2(-real_max(real_log2(most) / n, real_log2(most_before) / (n - 1)));
}

/* The state so long after that of the run: even powers and odd ones. */
static void taylor_at(const RunOf *run, Real h, Real *y)
{
    const int top = run->order - run->order % 2;
    const Real square = h * h;
    Real all[TAYLOR_Y];
    for (int i = 0; i < N_Y; i += SERIES_PART) {
        SeriesPart even = *(const SeriesPart *)(run->series[top] + i), odd = {0.0};
        if (top < run->order)
            odd = *(const SeriesPart *)(run->series[top + 1] + i);
        for (int k = top - 2; k >= 0; k -= 2) {
            even = *(const SeriesPart *)(run->series[k] + i) + square * even;
            odd = *(const SeriesPart *)(run->series[k + 1] + i) + square * odd;
        }
        *(SeriesPart *)(all + i) = even + h * odd;
    }
    for (int i = 0; i < N_Y; i++)
        y[i] = all[i];
}

/* A step of length h, or of the longest that the series is good for: with a fixed one nobody asks. */
static int taylor_step(RunOf *run, Real h, const ParametersOf *p, StepOf *step)
{
    const int free = !(run->fixed > 0.0);
    if (free)
        h = real_min(h, run->reach);
    step->t = run->t, step->h = h, step->dense_ready = 0;
    forget_stages(step);
    taylor_at(run, h, step->y);
    step->error = free ? h / run->reach : real_of(0.0); /* its root: accepted where it is one at most */
    run->stability = real_of(0.0);
    return is_refused(run, step) ? 0 : finish_step(run, step, p);
}
