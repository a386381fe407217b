/*
 * Continuation of the motion at singular positions, where constraint equations depend on each other for a moment.
 * Multipliers are unbounded there, and rounding errors are amplified by the inverse of the distance, squared in the
 * accelerations. The motion itself passes smoothly on its branch. The right-hand side is therefore interpolated by a
 * polynomial through regular states on both sides, along the linkage's path through the state.
 */
#if CONTINUES
#include <string.h>

enum { SIDE_NODES = TREE ? 5 : 6, WIDE = 2, WIDER = 4 };
#define MAX_CLOSING_MOVE 0.1 /* rad: largest projection of a stage onto the constraints */
#define NODE_TURN (TREE ? 1e-2 : 2e-2) /* rad: motion of the fastest angle between nodes; doubled in later passes */
#define CONTINUATION_TOL 1e-7 /* of the accelerations: largest difference of the polynomials of the last two degrees */
#define WIDE_TURN 4e-2 /* the same for smooth motion: rounding at distant nodes is amplified less */
#define WIDE_TOL 1e-10

/*
 * Project a state onto the closures and compute its right-hand side. far: the largest allowed sum of the steps, rad.
 * Returns a status; LOST if the projection is too long or does not converge.
 */
static int close_state(
    double t, double *y, DiscreteState *discrete, const Parameters *p, double far, double *dy, RhsOutputs *rhs)
{
    double moved = 0.0, before = INFINITY;
    for (int pass = 0; pass < 6; pass++) {
        double dq[N_X], dv[N_X], worst, step = 0.0;
        const int status = closing_here(t, y, discrete, p, dq, dv, &worst);
        if (status)
            return status;
        for (int k = 0; k < N_X; k++) {
            y[k] -= dq[k];
            y[N_X + k] -= dv[k];
            step = is_angle[k] ? max_of(step, fabs(dq[k])) : step;
        }
        moved += step;
        if (!(moved <= far))
            return LOST;
        if (worst < 1e-15 || (worst < 1e-12 && worst > 0.5 * before))
            return motion_here(t, y, discrete, p, dy, rhs);
        before = worst;
    }
    return LOST;
}

/* The continued motion: closed state, rates (`lower`: accelerations by the polynomial of lower degree), multipliers. */
typedef struct {
    double y[2 * N_X], dy[N_Y], lower[N_X], lambda[AT_LEAST_ONE(N_LOOPS)];
} ContinuedMotion;

/* Add the contribution of a node at distance k to the interpolated motion. */
static void add_interpolation_node(
    int k, const double *y, const double *dy, const RhsOutputs *rhs, ContinuedMotion *sum)
{
    const double weight = weight_at(SIDE_NODES, k), lower = k < SIDE_NODES ? weight_at(SIDE_NODES - 1, k) : 0.0;
    for (int i = 0; i < 2 * N_X; i++)
        sum->y[i] += weight * y[i];
    for (int i = 0; i < N_Y; i++)
        sum->dy[i] += weight * dy[i];
    for (int i = 0; i < N_X; i++)
        sum->lower[i] += lower * dy[N_X + i];
    for (int i = 0; i < N_LOOPS; i++)
        sum->lambda[i] += weight * rhs->lambda[i];
}

/* Return whether the accelerations by the polynomials of the last two degrees agree within `to` of their size. */
static int has_converged(const double *y, const ContinuedMotion *sum, double to)
{
    double most[2] = {0.0, 0.0}, apart[2] = {0.0, 0.0};
    for (int k = 0; k < N_X; k++) {
        const int kind = is_angle[k];
        const double a = sum->dy[N_X + k], v = y[N_X + k];
        most[kind] = max_of(most[kind], fabs(a) + (kind ? v * v : 0.0));
        apart[kind] = max_of(apart[kind], fabs(a - sum->lower[k]));
    }
    return apart[0] <= to * most[0] && apart[1] <= to * most[1];
}

/* Continue the motion at a state near a singular position from both sides. Returns whether the polynomials agree. */
static int continue_motion(
    double t, const double *y, const DiscreteState *discrete, const Parameters *p, ContinuedMotion *sum)
{
    double fastest = 0.0;
    for (int k = 0; k < N_X; k++)
        fastest = is_angle[k] ? max_of(fastest, fabs(y[N_X + k])) : fastest;
    if (!(fastest > 0.0 && fastest < INFINITY))
        return 0;
    for (int pass = -WIDE; pass < WIDER; pass++) {
        const double turn = pass < 0 ? WIDE_TURN * ldexp(1.0, -WIDE - pass) : NODE_TURN * ldexp(1.0, pass);
        int status = discrete->token && poll_cancellation(discrete->token) ? STOPPED : 0;
        *sum = (ContinuedMotion){0};
        for (int k = 1; k <= SIDE_NODES && !status; k++)
            for (int branch = -1; branch <= 1 && !status; branch += 2) {
                const double h = branch * k * turn / fastest;
                double there[N_Y], dy[N_Y];
                DiscreteState now = *discrete;
                RhsOutputs rhs;
                for (int i = 0; i < N_Y; i++)
                    there[i] = y[i] + (i < N_X ? h * y[N_X + i] : 0.0);
                status = close_state(t + (N_DRIVES ? h : 0.0), there, &now, p, 0.5 * k * turn, dy, &rhs);
                add_interpolation_node(k, there, dy, &rhs, sum);
            }
        if (!status && has_converged(y, sum, pass < 0 ? WIDE_TOL : CONTINUATION_TOL))
            return 1;
        if (status == STOPPED)
            return 0;
    }
    return 0;
}

/* Return a discrete state whose pivots need only be large enough for a division. */
static DiscreteState with_usual_pivot_limits(const DiscreteState *discrete)
{
    DiscreteState now = *discrete;
    now.least = NEARLY_SINGULAR;
    now.least_size = VANISHING;
    return now;
}

/* Copy the continued motion at a state into rates dy and the right-hand side's outputs. Returns 0. */
static int copy_continued_motion(const double *y, const ContinuedMotion *at, double *dy, RhsOutputs *rhs)
{
    for (int k = 0; k < N_X; k++) {
        dy[k] = y[N_X + k];
        dy[N_X + k] = at->dy[N_X + k];
    }
    for (int k = 0; k < N_WORK; k++)
        dy[2 * N_X + k] = rhs->power[k] = at->dy[2 * N_X + k];
    for (int k = 0; k < N_LOOPS; k++)
        rhs->lambda[k] = at->lambda[k];
    return 0;
}

/*
 * Compute the rates of the integrated state. Near a singular position, the policy in `discrete` decides: project the
 * state, continue the motion, or report NEAR. Returns a status.
 */
int motion(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dy, RhsOutputs *rhs)
{
    ContinuedMotion at;
    if (discrete->singular_policy == SINGULAR_PROJECT || discrete->singular_policy == SINGULAR_PROJECT_OR_IGNORE) {
        double there[N_Y];
        memcpy(there, y, sizeof there);
        if (!close_state(t, there, discrete, p, MAX_CLOSING_MOVE, dy, rhs)) {
            for (int k = 0; k < N_X; k++)
                dy[k] = y[N_X + k];
            return 0;
        }
    }
    const int status = motion_here(t, y, discrete, p, dy, rhs);
    const int open = discrete->singular_policy == SINGULAR_PROJECT
        || discrete->singular_policy == SINGULAR_PROJECT_OR_IGNORE; /* near enough that it cannot be closed */
    if (discrete->singular_policy == SINGULAR_DETECT || (status != NEAR && (status || !open)))
        return status;
    if (continue_motion(t, y, discrete, p, &at))
        return copy_continued_motion(y, &at, dy, rhs);
    if (discrete->singular_policy == SINGULAR_PROJECT)
        return NEAR;
    DiscreteState now = with_usual_pivot_limits(discrete);
    return motion_here(t, y, &now, p, dy, rhs);
}

/*
 * Compute the steps dq, dv that return a state to the closures; near a singular position, those to the continued state.
 * Returns a status.
 */
int closing_of_state(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dq, double *dv,
    double *worst)
{
    int status = closing_here(t, y, discrete, p, dq, dv, worst);
    if (!status || discrete->singular_policy == SINGULAR_IGNORE || discrete->singular_policy == SINGULAR_DETECT)
        return status;
    double dy[N_Y];
    RhsOutputs rhs;
    ContinuedMotion at;
    DiscreteState now = *discrete;
    if (motion_here(t, y, &now, p, dy, &rhs) != NEAR || !continue_motion(t, y, discrete, p, &at)) {
        now = with_usual_pivot_limits(discrete);
        return closing_here(t, y, &now, p, dq, dv, worst);
    }
    for (int k = 0; k < N_X; k++) {
        dq[k] = y[k] - at.y[k];
        dv[k] = y[N_X + k] - at.y[N_X + k];
    }
    *worst = 0.0; /* one pass is enough */
    return 0;
}

#else
/* Compute the rates of the integrated state at the state itself: the scene has no continuation. Returns a status. */
int motion(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dy, RhsOutputs *rhs)
{
    return motion_here(t, y, discrete, p, dy, rhs);
}

/* Compute the steps dq, dv that return a state to the closures, at the state itself. Returns a status. */
int closing_of_state(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dq, double *dv,
    double *worst)
{
    return closing_here(t, y, discrete, p, dq, dv, worst);
}
#endif
