/* Works of forces and drives along a kinematic motion: quadrature of the powers, and impulses at velocity jumps. */

/*
 * Compute the powers (N_WORK), W, of forces and drives at a position. Outside tree coordinates (POSITIONS_IN_TREE = 0)
 * the accelerations are stored in position->a, too. Return the status of solve_accelerations().
 */
static int compute_powers(KinematicRun *run, Position *position, double *power)
{
    RhsOutputs rhs;
#if POSITIONS_IN_TREE
    double a[N_X + 1];
    const int status = solve_accelerations(run, position, a, &rhs);
#else
    const int status = solve_accelerations(run, position, position->a, &rhs);
#endif
    for (int k = 0; k < N_WORK; k++)
        power[k] = rhs.power[k];
    return status;
}

/*
 * Add the works between positions a and b, one step apart, to `work`, J, by Gauss-Legendre quadrature with three nodes.
 * has_jump: set to 1 if velocities change by more than the integral of the accelerations, because the rate of a drive
 * jumps, or if accelerations are not finite. min_jump: smaller differences are rounding, rad/s. Return 0, a status, or
 * NOT_FINITE if a power is undefined, with its time in work[0].
 */
static int integrate_work(
    KinematicRun *run, const Position *a, const Position *b, double min_jump, double *work, int *has_jump)
{
    const double half = 0.5 * (b->t - a->t);
    double velocity_defect[N_Q], scale = 0.0;
    for (int k = 0; k < N_Q; k++)
        velocity_defect[k] = b->v[k] - a->v[k];
    for (int i = 0; i < N_WORK_NODES; i++) {
        Position node_position;
        double power[N_WORK], correction;
        int status = solve_position_at(run, a->t + half * (1.0 + work_node[i]), a, &node_position, &correction);
        if (!status)
            status = compute_powers(run, &node_position, power);
        if (status)
            return status;
        for (int k = 0; k < N_WORK; k++) {
            if (!isfinite(power[k])) {
                work[0] = node_position.t;
                return NOT_FINITE;
            }
            work[k] += half * work_weight[i] * power[k];
        }
        for (int k = 0; k < N_Q; k++)
            velocity_defect[k] -= half * work_weight[i] * node_position.a[k];
        scale = get_larger_or_nan(scale, half * compute_scaled_max_norm(node_position.a, run->extent));
    }
    const double jump = compute_scaled_max_norm(velocity_defect, run->extent);
    /* or an acceleration is undefined: the slope of a rate is unbounded */
    *has_jump = !(scale <= DBL_MAX) || (jump > min_jump && jump > MIN_JUMP_RATIO * scale);
    return 0;
}

/* Return the kinetic energy of all bodies at a position, J. */
static double compute_kinetic_energy(const Parameters *p, const Position *position)
{
    double m[N_Q], sum = 0.0;
    mass_matrix(p, m);
    for (int k = 0; k < N_Q; k++)
        sum += 0.5 * m[k] * position->v[k] * position->v[k];
    return sum;
}

/*
 * Add the works between positions a and b to `work`, J, by bisection to intervals without a velocity jump or failed
 * node. If the interval of a jump is no longer divisible, the gain of kinetic energy is the drives' work, work[0].
 * halvings: number left for the whole step; at 0, jumps are ignored. Return 0 or a status. With NOT_FINITE, work[0] is
 * the time of the undefined power.
 */
static int integrate_work_over_jumps(
    KinematicRun *run, const Position *a, const Position *b, double min_jump, int *halvings, double *work)
{
    double interval_work[N_WORK] = {0.0}, correction;
    int has_jump = 0;
    int status = integrate_work(run, a, b, min_jump, interval_work, &has_jump);
    const double t = a->t + 0.5 * (b->t - a->t);
    const int is_divisible = t > a->t && t < b->t;
    if (status == NOT_FINITE)
        work[0] = interval_work[0];
    if ((status > 0 || status == NEWTON_FAILED) && is_divisible && *halvings > 0)
        has_jump = 1; /* a node at a change point */
    else if (status)
        return status;
    if (has_jump && is_divisible && *halvings > 0) {
        Position middle;
        --*halvings;
        status = solve_position_over_change_point(run, t, a, &middle, &correction);
        if (!status)
            status = integrate_work_over_jumps(run, a, &middle, min_jump, halvings, work);
        return status ? status : integrate_work_over_jumps(run, &middle, b, min_jump, halvings, work);
    }
    if (has_jump && !is_divisible)
        interval_work[0] = compute_kinetic_energy(run->p, b) - compute_kinetic_energy(run->p, a);
    if (!isfinite(interval_work[0])) {
        work[0] = t;
        return NOT_FINITE;
    }
    for (int k = 0; k < N_WORK; k++)
        work[k] += interval_work[k];
    return 0;
}

/*
 * Add the works of one step from position a to b to `work`, J. At velocity jumps the step is halved, MAX_SPLITS times
 * in all. Changes of less than VELOCITY_ROUNDING of the speed are not jumps. Return 0 or a status.
 */
static int integrate_work_of_step(KinematicRun *run, const Position *a, const Position *b, double *work)
{
    int halvings = MAX_SPLITS;
    const double speed = get_larger_or_nan(compute_scaled_max_norm(a->v, run->extent),
        compute_scaled_max_norm(b->v, run->extent));
    return integrate_work_over_jumps(run, a, b, MIN_VELOCITY_JUMP + VELOCITY_ROUNDING * speed, &halvings, work);
}

/*
 * Compute the works at n + 1 samples, (n + 1) x N_WORK in J, of which the first row is given. The motion is followed
 * again from the first sample q, v, or from the end of the last call. done: the last complete row. Return 0 or a
 * status. After NOT_FINITE, gudgeon_kinematic_progress() returns the time of the undefined power.
 */
int gudgeon_kinematic_works(void *analysis, long n, const double *t, const double *parameters, const double *q,
    const double *v, double *work, long *done)
{
    KinematicRun *run = analysis;
    Position position = run->work;
    run->p = (const Parameters *)parameters;
    *done = 0;
    int status = run->has_work_begun ? 0 : set_initial_position(run, t[0], q, v, &position);
    for (long i = 0; i < n && !status; i++) {
        StepLength step_length = {t[i + 1] - t[i], 0};
        double *sum = work + (i + 1) * N_WORK;
        for (int k = 0; k < N_WORK; k++)
            sum[k] = work[i * N_WORK + k];
        while (position.t < t[i + 1] && !status) {
            const Position before = position;
            status = make_step(run, &step_length, t[i + 1], &position);
            if (!status)
                status = integrate_work_of_step(run, &before, &position, sum);
        }
        *done = i + !status;
    }
    run->work = position;
    run->has_work_begun = 1;
    if (status == NOT_FINITE)
        run->work.t = work[(*done + 1) * N_WORK];
    return status;
}
