/*
 * Taylor's method: the motion's own series, of an order that follows from the tolerance, as long as its last terms
 * stay below it and its defect at the end of the step is small. Its polynomial is the interpolant.
 * A. Jorba, M. Zou, A software package for the numerical integration of ODEs by means of high-order Taylor methods,
 * Experimental Mathematics 14 (2005), section 3.
 */
#if TAYLOR
#define TAYLOR_EFFORT 0.7 /* orders by e-fold of the tolerance */
enum { TAYLOR_LEAST = 4 };

static const double taylor_error_nodes[] = {0.0};

/* By the tolerance of a step, as a share: lengths, angles and speeds have it in common. */
static int taylor_order(double fraction)
{
    const double wanted = ceil(1.0 - TAYLOR_EFFORT * log(fraction));
    return wanted > TAYLOR_ORDERS ? TAYLOR_ORDERS : wanted < TAYLOR_LEAST ? TAYLOR_LEAST : (int)wanted;
}

typedef double SeriesPart __attribute__((vector_size(REGISTER), aligned(8)));
/* A step whose error is known only at its end: a run looks at step->error afterwards. */
static void refuse_late(const Integrator *run, const Step *step) { (void)run, (void)step; }

/* The end of a step is made once more: both count as one, as in lanes. */
static void forget_end(Integrator *run) { count_evaluations(run, -1); }

#include "../both/taylor.h"

/* The series at the state of the run, and how far it is good for; once for all steps that are tried there. */
static int taylor_expand(Integrator *run, const Parameters *p)
{
    if (run->series.ready == HERE)
        return 0;
    const int n = run->series.order, status = taylor_series(run->t, run->y, p, n, run->series.terms);
    if (status)
        return status;
    count_evaluations(run, run->series.ready != ELSEWHERE);
    run->series.reach = taylor_reach(run);
    run->series.ready = HERE;
    return 0;
}

static int taylor_try(Integrator *run, double h, const Parameters *p, Step *step)
{
    const int status = taylor_expand(run, p);
    if (status || !all_finite(run->series.terms[run->series.order], N_Y)) {
        step->method = &dop853; /* links in one line: its right-hand sides know a way */
        return dop853_try(run, h, p, step);
    }
    const int ended = taylor_step(run, h, p, step);
    set_attempt(run, step->h);
    return ended;
}

/* The series of a step that was tried in a lane: all that is wanted of it is an end, until somebody looks inside. */
static void taylor_fetch(Integrator *run)
{
    const double *from = run->series.lane;
    if (run->series.ready != ELSEWHERE)
        return;
    for (int k = 0; k <= run->series.order; k++)
        for (int i = 0; i < N_Y; i++)
            run->series.terms[k][i] = from[(k * TAYLOR_Y + i) * run->series.lanes];
    run->series.ready = HERE;
}

/* The series in shares of the step: who looks for bounds reads it. */
static int taylor_dense(Integrator *run, const Parameters *p, Step *step)
{
    double power = step->h;
    (void)p;
    taylor_fetch(run);
    for (int k = 1; k <= TAYLOR_ORDERS; k++, power *= step->h)
        for (int i = 0; i < N_Y; i++)
            step->dense[k - 1][i] = k <= run->series.order ? run->series.terms[k][i] * power : 0.0;
    return 0;
}

static void taylor_interpolate(const Integrator *run, const Step *step, double s, double *y)
{
    taylor_at(run, s * step->h, y);
}

static const Method taylor = {.name = "taylor",
    .try = taylor_try,
    .dense = taylor_dense,
    .interpolate = taylor_interpolate,
    .power = 1.0 / TAYLOR_ORDERS,
    .unstable = INFINITY,
    .bounded = INFINITY,
    .degree = TAYLOR_ORDERS,
    .error_nodes = taylor_error_nodes,
    .n_error_nodes = COUNT_OF(taylor_error_nodes),
    .own_length = 1};

/* The tolerance of a step, as a share, determines the order. */
static void start_series(Integrator *run, double fraction) { run->series.order = taylor_order(fraction); }

/* From a new state on. */
static void forget_series(Integrator *run) { run->series.ready = 0; }

/* How long a step may be that is tried next: far enough to look ahead. */
static double length_ahead(const Integrator *run) { return TAYLOR_AHEAD * run->series.reach; }
#else
static inline void start_series(Integrator *run, double fraction) { (void)run, (void)fraction; }
static inline void forget_series(Integrator *run) { (void)run; }
static inline double length_ahead(const Integrator *run) { return (void)run, INFINITY; }
#endif
