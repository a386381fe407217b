/*
 * Removal of residual slip in friction elements that stick, to the accuracy with which their velocities are evaluated.
 */
#define MIN_SLIP 1e-15    /* m/s: smaller slips count as zero */
#define MAX_RESIDUAL_TOLERANCES 10.0 /* tolerances of a velocity up to which a slip is an error of the step */
#define MAX_RESIDUAL_SLIP 2e-9 /* m/s: slip up to which the beginning of stick is located */

/*
 * Return the change of the rate of slip i when its friction force reverses (mode 1 to -1), and in dy that of all rates.
 * 0: the change is unknown.
 */
static double slip_response(Integrator *run, double t, const double *y, int i, const Parameters *p, double *dy)
{
    double *mode = &run->discrete.mode[i], other[N_Y];
    const double known = *mode;
    RhsOutputs along, against;
    *mode = -1.0;
    int status = rates(run, t, y, p, dy, &along);
    *mode = 1.0;
    status = status ? status : rates(run, t, y, p, other, &against);
    *mode = known;
    for (int k = 0; k < N_Y; k++)
        dy[k] -= other[k];
    return status ? 0.0 : along.friction[i].rate - against.friction[i].rate;
}

/*
 * Return whether the velocity change `factor` * `direction` is a residual error of a step. The velocities are tested,
 * not the slip: a slip may be small because its lever arm is.
 */
static int is_slip_residual(const Integrator *run, const double *direction, double factor)
{
    int small = 1;
    for (int k = N_X; k < 2 * N_X; k++) {
        const double *least = run->norm.least;
        const double turns = least[0] > 0.0 ? least[1] / least[0] : 1.0; /* rad/m; rk4 does not know */
        const double located = is_angle[k - N_X] ? MAX_RESIDUAL_SLIP * turns : MAX_RESIDUAL_SLIP;
        const double tolerance = run->norm.weight[k] > 0.0 ? MAX_RESIDUAL_TOLERANCES / run->norm.weight[k] : 0.0;
        small &= fabs(direction[k] * factor) <= max_of(tolerance, located);
    }
    return small;
}

/*
 * Remove the residual slips of sticking friction by impulses of that friction and return whether there were any. The
 * impulse of one element leaves the others at rest.
 */
static int remove_slip_residuals(Integrator *run, double t, double *y, const RhsOutputs *rhs, const Parameters *p)
{
    int some = 0;
    for (int i = 0; i < N_FRICTIONS; i++) {
        double direction[N_Y];
        const double v = rhs->friction[i].v;
        if (run->discrete.mode[i] != 0.0 || fabs(v) <= MIN_SLIP)
            continue;
        const double response = slip_response(run, t, y, i, p, direction);
        if (!(response > 0.0) || !is_slip_residual(run, direction, v / response))
            continue;
        for (int k = N_X; k < 2 * N_X; k++)
            y[k] -= direction[k] * (v / response);
        some = 1;
    }
    return some;
}

/* Evaluate the right-hand side at a state after removing residual slips of sticking friction from y. */
static int evaluate_rates_at_rest(
    Integrator *run, double t, double *y, const Parameters *p, double *dy, RhsOutputs *rhs)
{
    const int status = rates(run, t, y, p, dy, rhs);
    return status || !remove_slip_residuals(run, t, y, rhs, p) ? status : rates(run, t, y, p, dy, rhs);
}

/* Remove residual slips of sticking friction from a state y. */
static void project_slips(Integrator *run, double t, double *y, const Parameters *p)
{
    double dy[N_Y];
    RhsOutputs rhs;
    int sticks = 0;
    for (int i = 0; i < N_FRICTIONS; i++)
        sticks |= run->discrete.mode[i] == 0.0;
    if (sticks)
        (void)evaluate_rates_at_rest(run, t, y, p, dy, &rhs);
}
