/*
 * The table of integration methods. The file of a method defines how a step is tried and interpolated; its last lines
 * are the Method that methods/adaptive.c and the dense output use. A new method is included and listed here. An
 * explicit Runge-Kutta method needs only its coefficients (methods/runge_kutta.c).
 */
#include <string.h>

/* An integration method: its functions, and the constants of its error estimate, stability and dense output. */
struct Method {
    const char *name;                                           /* name as in runtime/contract/methods.py */
    int (*try)(Integrator *, double h, const Parameters *, Step *); /* computes a step of length h with its error */
    int (*dense)(Integrator *, const Parameters *, Step *);            /* computes the dense output of a step */
    void (*interpolate)(const Integrator *, const Step *, double fraction, double *y);
    const struct Tableau *tableau; /* coefficients of an explicit method, methods/runge_kutta.c */
    int uses_baumgarte_terms;               /* whether Baumgarte's terms replace the projection onto the constraints */
    int lane_method;          /* its code in lanes (METHOD_..., run/run.h) */
    double power;             /* exponent of the step-size control: 1 / (order of the error estimate + 1) */
    int stiff;                /* whether it uses the Jacobian */
    double rejected_h_rho, limiting_h_rho; /* h rho above which steps are rejected; stability limits the steps */
    int stages, dense_stages; /* stages of a step, additional stages of its dense output (batch/) */
    int degree, reversed;     /* of y0 + s (d0 + (1 - s) (d1 + s (d2 + ...))); bit k: d_k comes with 1 - s, not s */
    const double *error_nodes;      /* fractions of a step, ascending, of its error estimate */
    int n_error_nodes;
    double max_error_fraction; /* of a stiff method: fraction with the largest error of its dense output */
    const EndRateWeights *end_rates; /* of a stiff method: rates of its dense output at the ends, from stages */
    int controls_length;           /* whether the method itself chooses the length of a step */
};

/* Number of elements of an array. */
#define COUNT_OF(table) ((int)(sizeof(table) / sizeof *(table)))

#include "dop853.c"
#include "rodas5p.c"
#if IMPLICIT_STAGES
#include "radau.c"
#endif
#include "taylor.c"
#include "runge_kutta.c"

/* All methods; gudgeon_method() returns the index of a method. */
static const Method *const METHODS[] = {
    &dop853, &rodas5p, &rk4, &dopri5,
#if IMPLICIT_STAGES
    &radau5, &radau9,
#endif
#if TAYLOR
    &taylor,
#endif
};
#define EXPLICIT_METHOD (&dop853) /* explicit method of the automatic choice if a run begins with the stiff one */

/*
 * Return whether the method of a run stabilizes the constraints by Baumgarte's terms instead of projecting its steps.
 */
static int uses_baumgarte_terms(const Integrator *run) { return run->choice.method->uses_baumgarte_terms; }

/*
 * Return the index of the method with this name ("dopri5") for gudgeon_adaptive_setup(), -1 if the library has no such
 * method.
 */
int gudgeon_method(const char *name)
{
    for (int i = 0; i < COUNT_OF(METHODS); i++)
        if (!strcmp(METHODS[i]->name, name))
            return i;
    return -1;
}

/*
 * Return the method of the same name in this library; NULL if `method` is NULL. A run may have begun in another library
 * of the same code, whose pointers are other ones. The method must exist here.
 */
static const Method *find_method_in_library(const Method *method)
{
    return method ? METHODS[gudgeon_method(method->name)] : NULL;
}

/* Copy n state vectors (N_Y) of one lane, stored with a stride of `lanes` numbers, into `target`. */
static void copy_states_from_lane(const double *lane, int lanes, int n, double (*target)[N_Y])
{
    for (int k = 0; k < n; k++)
        for (int i = 0; i < N_Y; i++)
            target[k][i] = lane[(k * N_Y + i) * lanes];
}

static void discard_dense_samples(Integrator *run); /* watch/roots.c */

/*
 * Compute the dense output (continuous extension) of a step unless it exists. Return 0, or the status if an additional
 * stage is not computable. A failure is stored and returned again. If the step was computed in lanes, its dense output
 * or its stages are copied from there. Stored samples of the dense output are discarded.
 */
static int compute_dense_output(Integrator *run, const Parameters *p, Step *step)
{
    const int is_in_lane = step->dense_ready == IN_LANE;
    if (step->dense_ready == IN_RUN)
        return 0;
    if (step->dense_ready == FAILED)
        return step->dense_status;
    step->dense_ready = IN_RUN;
    discard_dense_samples(run);
    if (is_in_lane) {
        copy_states_from_lane(step->dense_lane, step->lanes, N_DENSE, step->dense);
        count_evaluations(run, step->method->dense_stages);
        return 0;
    }
    if (step->stages_lane)
        copy_states_from_lane(step->stages_lane, step->lanes, step->method->stages, step->k);
    step->stages_lane = NULL;
    step->dense_status = step->method->dense(run, p, step);
    if (step->dense_status)
        step->dense_ready = FAILED;
    return step->dense_status;
}
