/*
 * Continuation of the motion at singular positions, where constraint equations depend on each other for a moment.
 * Multipliers are unbounded there, and rounding errors are amplified by the inverse of the distance, squared in the
 * accelerations. The motion itself passes smoothly on its branch. The right-hand side is therefore interpolated by a
 * polynomial through regular states on both sides, along the linkage's path through the state.
 */
#if HAS_CONTINUATION
#include <string.h>

enum { N_SIDE_NODES = TREE ? 5 : 6, N_WIDE_PASSES = 2, N_NARROW_PASSES = 4 };
#define MAX_CLOSING_DISPLACEMENT 0.1 /* rad: largest projection of a stage onto the constraints */
#define NODE_ANGLE (TREE ? 1e-2 : 2e-2) /* rad: motion of the fastest angle between nodes; doubled in later passes */
#define CONTINUATION_TOL 1e-7 /* of the accelerations: largest difference of the polynomials of the last two degrees */
#define WIDE_NODE_ANGLE 4e-2 /* the same for smooth motion: rounding at distant nodes is amplified less */
#define WIDE_TOL 1e-10

/*
 * Project state y in place onto the closures by at most six Newton steps, and compute its rates dy and outputs rhs
 * there. max_step_sum: largest allowed sum of the steps of angles, rad. Return 0 or a status; LOST if the projection is
 * longer or does not converge, with y changed.
 */
static int project_and_evaluate_state(
    double t, double *y, DiscreteState *discrete, const Parameters *p, double max_step_sum, double *dy, RhsOutputs *rhs)
{
    double step_sum = 0.0, before = INFINITY;
    for (int pass = 0; pass < 6; pass++) {
        double dq[N_X], dv[N_X], residual, step = 0.0;
        const int status = compute_projection_step(t, y, discrete, p, dq, dv, &residual);
        if (status)
            return status;
        for (int k = 0; k < N_X; k++) {
            y[k] -= dq[k];
            y[N_X + k] -= dv[k];
            step = is_angle[k] ? max_of(step, fabs(dq[k])) : step;
        }
        step_sum += step;
        if (!(step_sum <= max_step_sum))
            return LOST;
        if (residual < 1e-15 || (residual < 1e-12 && residual > 0.5 * before))
            return evaluate_rhs(t, y, discrete, p, dy, rhs);
        before = residual;
    }
    return LOST;
}

/* The continued motion: closed state, rates (`lower`: accelerations by the polynomial of lower degree), multipliers. */
typedef struct {
    double y[2 * N_X], dy[N_Y], lower[N_X], lambda[AT_LEAST_ONE(N_LOOPS)];
} ContinuedMotion;

/*
 * Add the contribution of a node, a regular state y with rates and multipliers, to `interpolated_motion`.
 * node_distance: distance of the node from the singular position in nodes, 1 ... N_SIDE_NODES, the same on both sides,
 * which have equal weights. The accelerations `lower` of the polynomial of lower degree, which leaves out the last
 * nodes, serve as error estimate (has_interpolation_converged()).
 */
static void add_interpolation_node(
    int node_distance, const double *y, const double *dy, const RhsOutputs *rhs, ContinuedMotion *interpolated_motion)
{
    const double weight = compute_lagrange_weight(N_SIDE_NODES, node_distance),
                 lower = node_distance < N_SIDE_NODES ? compute_lagrange_weight(N_SIDE_NODES - 1, node_distance) : 0.0;
    for (int i = 0; i < 2 * N_X; i++)
        interpolated_motion->y[i] += weight * y[i];
    for (int i = 0; i < N_Y; i++)
        interpolated_motion->dy[i] += weight * dy[i];
    for (int i = 0; i < N_X; i++)
        interpolated_motion->lower[i] += lower * dy[N_X + i];
    for (int i = 0; i < N_LOOPS; i++)
        interpolated_motion->lambda[i] += weight * rhs->lambda[i];
}

/*
 * Return whether the accelerations interpolated with the last two degrees agree within `tolerance` times their size.
 * Lengths and angles are compared separately; y: the state, whose squared angular rates count as accelerations.
 */
static int has_interpolation_converged(const double *y, const ContinuedMotion *interpolated_motion, double tolerance)
{
    double largest[2] = {0.0, 0.0}, difference[2] = {0.0, 0.0};
    for (int k = 0; k < N_X; k++) {
        const int kind = is_angle[k];
        const double a = interpolated_motion->dy[N_X + k], v = y[N_X + k];
        largest[kind] = max_of(largest[kind], fabs(a) + (kind ? v * v : 0.0));
        difference[kind] = max_of(difference[kind], fabs(a - interpolated_motion->lower[k]));
    }
    return difference[0] <= tolerance * largest[0] && difference[1] <= tolerance * largest[1];
}

/*
 * Interpolate the motion at state y near a singular position from regular states on both sides; the result is in
 * `interpolated_motion`. The states are on the linkage's path through y, at distances that are increased until the
 * polynomials agree. Return whether they do; 0 also if nothing rotates or the run is cancelled.
 */
static int continue_motion(
    double t, const double *y, const DiscreteState *discrete, const Parameters *p, ContinuedMotion *interpolated_motion)
{
    double fastest = 0.0;
    for (int k = 0; k < N_X; k++)
        fastest = is_angle[k] ? max_of(fastest, fabs(y[N_X + k])) : fastest;
    if (!(fastest > 0.0 && fastest < INFINITY))
        return 0;
    for (int pass = -N_WIDE_PASSES; pass < N_NARROW_PASSES; pass++) {
        const double node_angle =
            pass < 0 ? WIDE_NODE_ANGLE * ldexp(1.0, -N_WIDE_PASSES - pass) : NODE_ANGLE * ldexp(1.0, pass);
        int status = discrete->token && poll_cancellation(discrete->token) ? STOPPED : 0;
        *interpolated_motion = (ContinuedMotion){0};
        for (int k = 1; k <= N_SIDE_NODES && !status; k++)
            for (int sign = -1; sign <= 1 && !status; sign += 2) {
                const double h = sign * k * node_angle / fastest;
                double projected[N_Y], dy[N_Y];
                DiscreteState discrete_state = *discrete;
                RhsOutputs rhs;
                for (int i = 0; i < N_Y; i++)
                    projected[i] = y[i] + (i < N_X ? h * y[N_X + i] : 0.0);
                status = project_and_evaluate_state(t + (N_DRIVES ? h : 0.0), projected, &discrete_state, p,
                    0.5 * k * node_angle, dy, &rhs);
                add_interpolation_node(k, projected, dy, &rhs, interpolated_motion);
            }
        if (!status && has_interpolation_converged(y, interpolated_motion, pass < 0 ? WIDE_TOL : CONTINUATION_TOL))
            return 1;
        if (status == STOPPED)
            return 0;
    }
    return 0;
}

/*
 * Return a copy of a discrete state with the usual limits of pivots: these need only be large enough for a division, so
 * that near-singular positions are not detected.
 */
static DiscreteState copy_state_with_usual_pivot_limits(const DiscreteState *discrete)
{
    DiscreteState discrete_state = *discrete;
    discrete_state.min_pivot = NEARLY_SINGULAR;
    discrete_state.min_pivot_size = VANISHING;
    return discrete_state;
}

/*
 * Copy the interpolated motion at state y into rates dy and outputs rhs (powers, multipliers). Coordinates' rates are
 * the velocities in y. Return 0.
 */
static int copy_continued_motion(const double *y, const ContinuedMotion *continued_motion, double *dy, RhsOutputs *rhs)
{
    for (int k = 0; k < N_X; k++) {
        dy[k] = y[N_X + k];
        dy[N_X + k] = continued_motion->dy[N_X + k];
    }
    for (int k = 0; k < N_WORK; k++)
        dy[2 * N_X + k] = rhs->power[k] = continued_motion->dy[2 * N_X + k];
    for (int k = 0; k < N_LOOPS; k++)
        rhs->lambda[k] = continued_motion->lambda[k];
    return 0;
}

/*
 * Compute the rates dy of the integrated state y and the outputs rhs. Return 0 or a status. Near a singular position,
 * discrete->singular_policy decides: the state is projected and evaluated there, the motion is continued from both
 * sides, NEAR_SINGULAR is returned, or the state is evaluated without treatment. y is not changed.
 */
int compute_motion_rates(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dy,
    RhsOutputs *rhs)
{
    ContinuedMotion continued;
    if (discrete->singular_policy == SINGULAR_PROJECT || discrete->singular_policy == SINGULAR_PROJECT_OR_IGNORE) {
        double projected[N_Y];
        memcpy(projected, y, sizeof projected);
        if (!project_and_evaluate_state(t, projected, discrete, p, MAX_CLOSING_DISPLACEMENT, dy, rhs)) {
            for (int k = 0; k < N_X; k++)
                dy[k] = y[N_X + k];
            return 0;
        }
    }
    const int status = evaluate_rhs(t, y, discrete, p, dy, rhs);
    const int open = discrete->singular_policy == SINGULAR_PROJECT
        || discrete->singular_policy == SINGULAR_PROJECT_OR_IGNORE; /* near enough that it cannot be closed */
    if (discrete->singular_policy == SINGULAR_DETECT || (status != NEAR_SINGULAR && (status || !open)))
        return status;
    if (continue_motion(t, y, discrete, p, &continued))
        return copy_continued_motion(y, &continued, dy, rhs);
    if (discrete->singular_policy == SINGULAR_PROJECT)
        return NEAR_SINGULAR;
    DiscreteState discrete_state = copy_state_with_usual_pivot_limits(discrete);
    return evaluate_rhs(t, y, &discrete_state, p, dy, rhs);
}

/*
 * Compute the corrections dq, dv (N_X) of state y, to be subtracted, that close the loops (one Newton step), and the
 * largest residual *residual. Return 0 or a status. y is not changed.
 *
 * Near a singular position, by the policy in `discrete`, they are those to the continued state, with *residual = 0: one
 * pass is enough. If the motion cannot be continued there, the usual limits of pivots apply.
 */
int compute_correction(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dq, double *dv,
    double *residual)
{
    int status = compute_projection_step(t, y, discrete, p, dq, dv, residual);
    if (!status || discrete->singular_policy == SINGULAR_IGNORE || discrete->singular_policy == SINGULAR_DETECT)
        return status;
    double dy[N_Y];
    RhsOutputs rhs;
    ContinuedMotion continued;
    DiscreteState discrete_state = *discrete;
    if (evaluate_rhs(t, y, &discrete_state, p, dy, &rhs) != NEAR_SINGULAR
        || !continue_motion(t, y, discrete, p, &continued)) {
        discrete_state = copy_state_with_usual_pivot_limits(discrete);
        return compute_projection_step(t, y, &discrete_state, p, dq, dv, residual);
    }
    for (int k = 0; k < N_X; k++) {
        dq[k] = y[k] - continued.y[k];
        dv[k] = y[N_X + k] - continued.y[N_X + k];
    }
    *residual = 0.0; /* one pass is enough */
    return 0;
}

#else
/*
 * Compute the rates dy of the integrated state y and the outputs rhs; the scene has no continuation. Return 0 or a
 * status.
 */
int compute_motion_rates(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dy,
    RhsOutputs *rhs)
{
    return evaluate_rhs(t, y, discrete, p, dy, rhs);
}

/*
 * Compute the corrections dq, dv (N_X) of state y, to be subtracted, that close the loops, and the largest residual
 * *residual. Return 0 or a status. The scene has no continuation.
 */
int compute_correction(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dq, double *dv,
    double *residual)
{
    return compute_projection_step(t, y, discrete, p, dq, dv, residual);
}
#endif
