/*
 * Taylor's method: the motion's own series, of an order that follows from the tolerance, as long as its last two terms
 * stay below it. Its polynomial is the interpolant.
 * A. Jorba, M. Zou, A software package for the numerical integration of ODEs by means of high-order Taylor methods,
 * Experimental Mathematics 14 (2005), section 3.
 */
#define TAYLOR_EFFORT 0.5 /* orders by e-fold of the tolerance */
enum { TAYLOR_LEAST = 4 };

static const double taylor_heard[] = {0.0};

/* By the tolerance of a step, as a share: lengths, angles and speeds have it in common. */
static int taylor_order(double share)
{
    const double wanted = ceil(1.0 - TAYLOR_EFFORT * log(share));
    return wanted > TAYLOR_ORDERS ? TAYLOR_ORDERS : wanted < TAYLOR_LEAST ? TAYLOR_LEAST : (int)wanted;
}

/* The longest step whose term of order k is no larger than the tolerance. */
static double taylor_reach(const Run *run, int k)
{
    double most = 0.0;
    for (int i = 0; i < N_Y; i++)
        most = max_of(most, fabs(run->series[k][i]) * run->weight[i]);
    return most > 0.0 ? pow(most, -1.0 / k) : INFINITY;
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
    run->reach = min_of(taylor_reach(run, n - 1), taylor_reach(run, n));
    run->series_ready = 1;
    return 0;
}

static int taylor_try(Run *run, double h, const Parameters *p, Step *step)
{
    const int status = taylor_expand(run, p);
    if (status || !all_finite(run->series[run->order], N_Y)) {
        step->method = &dop853; /* links in one line: its right-hand sides know a way */
        return dop853_try(run, h, p, step);
    }
    const int n = run->order;
    if (run->fixed <= 0.0 && h > run->reach)
        run->attempt.h = h = run->reach;
    step->t = run->t, step->h = h, step->dense_ready = 1;
    forget_stages(step);
    double power = h;
    for (int k = 1; k <= TAYLOR_ORDERS; k++, power *= h)
        for (int i = 0; i < N_Y; i++)
            step->dense[k - 1][i] = k <= n ? run->series[k][i] * power : 0.0;
    for (int i = 0; i < N_Y; i++) {
        double sum = 0.0;
        for (int k = n; k > 0; k--)
            sum += step->dense[k - 1][i];
        step->y[i] = run->y[i] + sum;
    }
    const double share = run->fixed > 0.0 ? 0.0 : h / run->reach;
    step->error = pow(share, n);
    run->stability = 0.0;
    return finish_step(run, step, p);
}

static int taylor_dense(Run *run, const Parameters *p, Step *step)
{
    return (void)run, (void)p, (void)step, 0; /* it is there with the step */
}

static void taylor_interpolate(const Run *run, const Step *step, double s, double *y)
{
    for (int i = 0; i < N_Y; i++) {
        double sum = 0.0;
        for (int k = run->order; k > 0; k--)
            sum = s * (sum + step->dense[k - 1][i]);
        y[i] = run->y[i] + sum;
    }
}

static const Method taylor = {.name = "taylor", .try = taylor_try, .dense = taylor_dense,
    .interpolate = taylor_interpolate, .power = 0.0, .unstable = INFINITY, .bounded = INFINITY,
    .degree = TAYLOR_ORDERS, .heard = taylor_heard, .n_heard = COUNT_OF(taylor_heard), .own_length = 1};
