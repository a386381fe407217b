/*
 * Taylor's method: the motion's own series, of an order that follows from the tolerance, as long as its last two terms
 * stay below it. Its polynomial is the interpolant.
 * A. Jorba, M. Zou, A software package for the numerical integration of ODEs by means of high-order Taylor methods,
 * Experimental Mathematics 14 (2005), section 3.
 */
#define TAYLOR_EFFORT 0.7 /* orders by e-fold of the tolerance */
enum { TAYLOR_LEAST = 4 };

static const double taylor_heard[] = {0.0};

/* By the tolerance of a step, as a share: lengths, angles and speeds have it in common. */
static int taylor_order(double share)
{
    const double wanted = ceil(1.0 - TAYLOR_EFFORT * log(share));
    return wanted > TAYLOR_ORDERS ? TAYLOR_ORDERS : wanted < TAYLOR_LEAST ? TAYLOR_LEAST : (int)wanted;
}

/* The longest step whose last two terms are no larger than the tolerance. */
static double taylor_reach(const Run *run)
{
    const int n = run->order;
    const double *last = run->series[n], *before = run->series[n - 1];
    double most = 0.0, most_before = 0.0;
    for (int i = 0; i < N_Y; i++) {
        most = max_of(most, fabs(last[i]) * run->weight[i]);
        most_before = max_of(most_before, fabs(before[i]) * run->weight[i]);
    }
    return exp(-max_of(log(most) / n, log(most_before) / (n - 1)));
}

/* The series at the state of the run, and how far it is good for; once for all steps that are tried there. */
static int taylor_expand(Run *run, const Parameters *p)
{
    if (run->series_ready)
        return 0;
    const int n = run->order, status = taylor_series(run->t, run->y, p, n, run->series);
    if (status)
        return status;
    run->evaluations++;
    run->reach = taylor_reach(run);
    run->series_ready = 1;
    return 0;
}

/* The state so long after that of the run: even powers and odd ones, components side by side. */
static void taylor_at(const Run *run, double h, double *y)
{
    typedef double Side __attribute__((vector_size(64), aligned(8)));
    const int top = run->order - run->order % 2;
    const double square = h * h;
    double all[TAYLOR_Y];
    for (int i = 0; i < TAYLOR_Y; i += 8) {
        Side even = *(const Side *)(run->series[top] + i), odd = {0.0};
        if (top < run->order)
            odd = *(const Side *)(run->series[top + 1] + i);
        for (int k = top - 2; k >= 0; k -= 2) {
            even = *(const Side *)(run->series[k] + i) + square * even;
            odd = *(const Side *)(run->series[k + 1] + i) + square * odd;
        }
        *(Side *)(all + i) = even + h * odd;
    }
    for (int i = 0; i < N_Y; i++)
        y[i] = all[i];
}

static int taylor_try(Run *run, double h, const Parameters *p, Step *step)
{
    const int status = taylor_expand(run, p);
    if (status || !all_finite(run->series[run->order], N_Y)) {
        step->method = &dop853; /* links in one line: its right-hand sides know a way */
        return dop853_try(run, h, p, step);
    }
    if (run->fixed <= 0.0 && h > run->reach)
        run->attempt.h = h = run->reach;
    step->t = run->t, step->h = h, step->dense_ready = 0;
    forget_stages(step);
    taylor_at(run, h, step->y);
    step->error = run->fixed > 0.0 ? 0.0 : h / run->reach; /* its root: accepted where it is one at most */
    run->stability = 0.0;
    return finish_step(run, step, p);
}

/* The series in shares of the step: who looks for bounds reads it. */
static int taylor_dense(Run *run, const Parameters *p, Step *step)
{
    double power = step->h;
    (void)p;
    for (int k = 1; k <= TAYLOR_ORDERS; k++, power *= step->h)
        for (int i = 0; i < N_Y; i++)
            step->dense[k - 1][i] = k <= run->order ? run->series[k][i] * power : 0.0;
    return 0;
}

static void taylor_interpolate(const Run *run, const Step *step, double s, double *y)
{
    taylor_at(run, s * step->h, y);
}

static const Method taylor = {.name = "taylor", .try = taylor_try, .dense = taylor_dense,
    .interpolate = taylor_interpolate, .power = 0.0, .unstable = INFINITY, .bounded = INFINITY,
    .degree = TAYLOR_ORDERS, .heard = taylor_heard, .n_heard = COUNT_OF(taylor_heard), .own_length = 1};
