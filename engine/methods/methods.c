/*
 * The methods. A file of each says how a step is tried and what lies between its ends; its last lines are all that
 * adaptive.c, and what looks inside steps, ask of it. A new one is included and listed here; of an explicit
 * Runge-Kutta method nothing is needed but its coefficients (runge_kutta.c).
 */
#include <string.h>

struct Method {
    const char *name;                                           /* as in runtime/contract/methods.py */
    int (*try)(Integrator *, double h, const Parameters *, Step *); /* a step of length h into Step, with its error */
    int (*dense)(Integrator *, const Parameters *, Step *);            /* makes the interpolant of an accepted one */
    void (*interpolate)(const Integrator *, const Step *, double fraction, double *y);
    const struct Tableau *tableau; /* of runge_kutta.c */
    int drifts;               /* whether Baumgarte's terms keep the rows, and no step is projected onto them */
    int lane;                 /* which of those that lanes know (run.h) */
    double power;             /* of the error, that a step's length goes by: 1 / (order of the estimate + 1) */
    int stiff;                /* whether it takes the Jacobian */
    double unstable, bounded; /* h rho beyond which no step is taken; at which stability bounds its steps */
    int stages, more;         /* that a try makes, that its interpolant makes besides (batch/) */
    int degree, turned;       /* of y0 + s (d0 + (1 - s) (d1 + s (d2 + ...))); bit k: d_k comes with 1 - s, not s */
    const double *error_nodes;      /* shares of a step, in their order, at which its error hears of the equations */
    int n_error_nodes;
    double between;           /* of a stiff one: the share of a step at which its interpolant errs most */
    double begins[8], begins_end; /* h times its rates at a step's begin, by stages and by y - y0 */
    double ends[4], ends_end; /* the same at its end, where stages are found by iterations */
    int n_begins, n_ends;
    int own_length;           /* whether a step that is tried is made as long as it may be */
};
#define COUNT_OF(table) ((int)(sizeof(table) / sizeof *(table)))

#include "dop853.c"
#include "rodas5p.c"
#if IMPLICIT_STAGES
#include "radau.c"
#endif
#include "taylor.c"
#include "runge_kutta.c"

static const Method *const METHODS[] = {
    &dop853, &rodas5p, &rk4, &dopri5,
#if IMPLICIT_STAGES
    &radau5, &radau9,
#endif
#if TAYLOR
    &taylor,
#endif
};
#define EXPLICIT (&dop853)  /* what the automatic choice is between, and the run's `implicit` */

static int drifts(const Integrator *run) { return run->choice.method->drifts; }

/* A method's number, as gudgeon_adaptive_setup takes it; -1: none has that name. */
int gudgeon_method(const char *name)
{
    for (int i = 0; i < COUNT_OF(METHODS); i++)
        if (!strcmp(METHODS[i]->name, name))
            return i;
    return -1;
}

/* What others have found of a step that they tried. */
static void copy_from_lane(const double *lane, int lanes, int rows, double (*to)[N_Y])
{
    for (int k = 0; k < rows; k++)
        for (int i = 0; i < N_Y; i++)
            to[k][i] = lane[(k * N_Y + i) * lanes];
}

static void forget_samples(Integrator *run); /* watch/roots.c */

/* The interpolant of a step, made once. 0, or why there is none: a stage of its own may not be computable. */
static int make_dense(Integrator *run, const Parameters *p, Step *step)
{
    const int there = step->dense_ready == ELSEWHERE;
    if (step->dense_ready == HERE)
        return 0;
    if (step->dense_ready == FAILED)
        return step->dense_status;
    step->dense_ready = HERE;
    forget_samples(run);
    if (there) {
        copy_from_lane(step->dense_lane, step->lanes, N_DENSE, step->dense);
        count_evaluations(run, step->method->more);
        return 0;
    }
    if (step->stages_lane)
        copy_from_lane(step->stages_lane, step->lanes, step->method->stages, step->k);
    step->stages_lane = NULL;
    step->dense_status = step->method->dense(run, p, step);
    if (step->dense_status)
        step->dense_ready = FAILED;
    return step->dense_status;
}
