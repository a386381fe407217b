/* The functions of a Radau step, compiled for 3 and for 5 stages (radau.h). */

/*
 * Guess the stages z of a step of length h (s), relative to its beginning, as the start of Newton's iteration. If the
 * step continues the last one (newton.can_extrapolate), its Hermite cubic is extrapolated. Else the rates at the
 * beginning are integrated, for positions with accelerations.
 */
static void RADAU(guess_stages)(const IntegratorOf *run, Real h, Real (*z)[N_Y])
{
    const Real H = run->newton.last_h;
    for (int i = 0; i < N_Y; i++) {
        /* Hermite's cubic, beyond the end of the step before, which was H long */
        const Real distance = run->newton.previous_y[i] - run->y[i];
        const Real d0 = H * run->newton.previous_dy[i], d1 = H * run->dy[i];
        const Real c2 = 3.0 * distance + d0 + 2.0 * d1, c3 = 2.0 * distance + d0 + d1;
        for (int s = 0; s < RADAU_STAGES; s++) {
            const Real t = RADAU_TABLE.node[s] * h, x = t / H;
            const Real by_rates = i < N_X ? t * (run->dy[i] + 0.5 * t * run->dy[N_X + i]) : t * run->dy[i];
            z[s][i] = select_value(run->newton.can_extrapolate, x * (d1 + x * (c2 + x * c3)), by_rates);
        }
    }
}

/*
 * Factorize Newton's matrix for a step of length h (s): the real one in run->newton.linear, and the complex ones,
 * `complex_matrices` (1 or 2). Return 0 or a status.
 */
static int RADAU(factor_matrices)(IntegratorOf *run, Real h, ComplexLinearOf *complex_matrices, const ParametersOf *p)
{
    int status = factor_newton_matrix(run, h * (1.0 / RADAU_TABLE.gamma), p);
    for (int k = 0; 2 * k + 1 < RADAU_STAGES && !status; k++) {
        const double re = RADAU_TABLE.pair[k][0], im = RADAU_TABLE.pair[k][1], square = re * re + im * im;
        status = factor_complex_matrix(run, h * (re / square), h * (-im / square), &complex_matrices[k]);
    }
    return status;
}

/*
 * Compute the correction `change` of the stages z by one simplified Newton iteration from their rates f: one real and
 * one or two complex linear solutions. h: step length, s; complex_matrices: from factor_matrices().
 */
static void RADAU(compute_newton_correction)(const IntegratorOf *run, Real h, const ComplexLinearOf *complex_matrices,
    Real (*f)[N_Y], Real (*z)[N_Y], Real (*change)[N_Y])
{
    Real w[RADAU_STAGES][N_Y], r[RADAU_STAGES][N_Y], right_side[2 * N_Y], u[2 * N_Y];
    const Real inverse_h = 1.0 / h;
    for (int k = 0; k < RADAU_STAGES; k++) {
        const double *row = RADAU_TABLE.from_stages[k];
        for (int i = 0; i < N_Y; i++) {
            r[k][i] = row[0] * f[0][i] + row[1] * f[1][i] + row[2] * f[2][i];
            w[k][i] = row[0] * z[0][i] + row[1] * z[1][i] + row[2] * z[2][i];
        }
#if RADAU_STAGES > 3
        for (int i = 0; i < N_Y; i++) {
            r[k][i] += row[3] * f[3][i] + row[4] * f[4][i];
            w[k][i] += row[3] * z[3][i] + row[4] * z[4][i];
        }
#endif
        for (int i = 0; i < N_Y; i++)
            w[k][i] *= inverse_h;
    }
    for (int i = 0; i < N_Y; i++)
        r[0][i] -= RADAU_TABLE.gamma * w[0][i];
    newton_solve(&run->newton.linear, h * (1.0 / RADAU_TABLE.gamma), make_real(0.0), r[0], w[0]);
    for (int k = 0; 2 * k + 1 < RADAU_STAGES; k++) {
        const double re = RADAU_TABLE.pair[k][0], im = RADAU_TABLE.pair[k][1], square = re * re + im * im;
        Real *const x = w[2 * k + 1], *const y = w[2 * k + 2];
        for (int i = 0; i < N_Y; i++) {
            right_side[2 * i] = r[2 * k + 1][i] - (re * x[i] - im * y[i]);
            right_side[2 * i + 1] = r[2 * k + 2][i] - (re * y[i] + im * x[i]);
        }
        newton_solve_complex(&complex_matrices[k], h * (re / square), h * (-im / square), right_side, u);
        for (int i = 0; i < N_Y; i++) {
            x[i] = u[2 * i];
            y[i] = u[2 * i + 1];
        }
    }
    for (int s = 0; s < RADAU_STAGES; s++) {
        const double *row = RADAU_TABLE.to_stages[s];
        for (int i = 0; i < N_Y; i++)
            change[s][i] = row[0] * w[0][i] + row[1] * w[1][i] + row[2] * w[2][i];
#if RADAU_STAGES > 3
        for (int i = 0; i < N_Y; i++)
            change[s][i] += row[3] * w[3][i] + row[4] * w[4][i];
#endif
    }
}

/*
 * Compute the rates f of the stages z and, for active runs, record the data of the stages in `step`. Return 0 or a
 * status. force: film forces (x, y) of each joint and stage, updated. force_change: set to the largest change of a film
 * force since the previous iteration, relative to the largest force in this step.
 */
static int RADAU(evaluate_stages)(IntegratorOf *run, Real h, Mask is_active, Real (*z)[N_Y], const ParametersOf *p,
    StepOf *step, Real (*f)[N_Y], Real (*force)[RADAU_STAGES][2], Real *force_change)
{
    Real y[N_Y], largest[AT_LEAST_ONE(N_CLEARANCES)], change[AT_LEAST_ONE(N_CLEARANCES)];
    RhsOutputsOf rhs;
    begin_stage_iteration(run, step, is_active, RADAU_STAGES);
    for (int i = 0; i < N_CLEARANCES; i++) {
        largest[i] = real_abs(run->rhs.clearance[i].Fx) + real_abs(run->rhs.clearance[i].Fy);
        change[i] = make_real(0.0);
    }
    for (int s = 0; s < RADAU_STAGES; s++) {
        for (int i = 0; i < N_Y; i++)
            y[i] = run->y[i] + z[s][i];
        const int status = evaluate_run_rhs(run, run->t + RADAU_TABLE.node[s] * h, y, p, f[s], &rhs);
        if (status)
            return status;
        record_newton_stage(run, step, is_active, y, &rhs, RADAU_TABLE.node[s]);
        for (int i = 0; i < N_CLEARANCES; i++) {
            const Real Fx = rhs.clearance[i].Fx, Fy = rhs.clearance[i].Fy;
            if (!has_film(i))
                continue;
            change[i] = real_max(real_abs(Fx - force[i][s][0]) + real_abs(Fy - force[i][s][1]), change[i]);
            largest[i] = real_max(real_abs(Fx) + real_abs(Fy), largest[i]);
            force[i][s][0] = Fx;
            force[i][s][1] = Fy;
        }
    }
    *force_change = make_real(0.0);
    for (int i = 0; i < N_CLEARANCES; i++)
        if (has_film(i))
            *force_change = real_max(change[i] / real_max(largest[i], make_real(DBL_MIN)), *force_change);
    return 0;
}

/*
 * Solve for the stages of a step of length h, in step->k, by simplified Newton iterations from the guess there. Return
 * 0 or a status. has_failed: set to the mask of runs in which they are not found. An iteration ends when the errors of
 * stages and film forces are below a part of the tolerance, or are rounding. It fails if it converges too slowly. With
 * fixed steps it goes down to rounding. Also stores the convergence rate.
 */
static int RADAU(solve_stages)(IntegratorOf *run, Real h, const ComplexLinearOf *complex_matrices,
    const ParametersOf *p, StepOf *step, Mask *has_failed)
{
    Real f[RADAU_STAGES][N_Y], change[RADAU_STAGES][N_Y], before = make_real(1.0), force_change;
    Real force[AT_LEAST_ONE(N_CLEARANCES)][RADAU_STAGES][2] = {0};
    /* the convergence rate of an earlier step is less certain for this one: power 3/4 */
    const Real last_rate = real_sqrt(run->newton.convergence_rate) * real_sqrt(real_sqrt(run->newton.convergence_rate));
    Real convergence_rate = select_value(run->newton.convergence_rate > 0.0, last_rate, make_real(0.5));
    Real (*const z)[N_Y] = step->k;
    /* rounding bounds the accuracy of the stages; with fixed steps the iteration goes down to it */
    Real rounding = make_real(0.0);
    for (int i = 0; i < N_Y; i++)
        rounding = real_max(real_abs(run->y[i]) * run->norm.weight[i], rounding);
    rounding *= RADAU_ROUNDING;
    const Real tolerance =
        select_value(run->control.max_accepted_error <= DBL_MAX, make_real(RADAU_STAGE_TOL), rounding);
    const Real max_error = real_max(tolerance, rounding);
    Mask is_active = invert_mask((Mask){0});
    *has_failed = (Mask){0};
    const int controlled = any_of(run->control.max_accepted_error <= DBL_MAX);
    const int max_passes = controlled ? RADAU_MAX_ITERATIONS : RADAU_MAX_FIXED_ITERATIONS;
    const double max_ratio = controlled ? 0.9 : 2.0; /* a fixed step may begin with a bad guess */
    for (int pass = 0; pass < max_passes && any_of(is_active); pass++) {
        const int status = RADAU(evaluate_stages)(run, h, is_active, z, p, step, f, force, &force_change);
        if (status)
            return status;
        RADAU(compute_newton_correction)(run, h, complex_matrices, f, z, change);
        Real distance = make_real(0.0);
        for (int s = 0; s < RADAU_STAGES; s++)
            for (int i = 0; i < N_Y; i++) {
                z[s][i] = select_value(is_active, z[s][i] + change[s][i], z[s][i]);
                distance = real_max(real_abs(change[s][i]) * run->norm.weight[i], distance);
            }
        distance = select_value(is_active, distance, make_real(0.0));
        if (reject_nonfinite_error(run, distance))
            return NOT_FINITE;
        Mask is_found = is_active & (distance <= rounding);
        if (pass > 0)
            convergence_rate = select_value(is_active & invert_mask(is_found), distance / before, convergence_rate);
        /* a film force is linear in the velocity by sectors of its direction: the first change may miss the sector */
        if (pass > has_films()) {
            /* the change no longer decreases */
            is_found |= is_active & invert_mask(convergence_rate < 0.9) & (distance <= RADAU_MAX_NOISE_RATIO * rounding)
                & (force_change <= run->newton.film_force_tol);
            *has_failed |= is_active & invert_mask(is_found | (convergence_rate < max_ratio));
            is_active &= is_found | (convergence_rate < max_ratio);
        }
        is_found |= is_active & (convergence_rate * distance <= max_error * (1.0 - convergence_rate))
            & (convergence_rate * force_change <= run->newton.film_force_tol * (1.0 - convergence_rate));
        run->newton.convergence_rate = select_value(is_found, real_max(convergence_rate, make_real(1e-3)),
            run->newton.convergence_rate);
        is_active &= invert_mask(is_found);
        before = select_value(is_active, distance, make_real(1.0));
    }
    *has_failed |= is_active;
    return 0;
}

/*
 * Return the scaled error norm of a step from rates dy at its beginning (y per s) and `stage_sum`, the linear
 * combination of the stages of the embedded formula, divided by h (y per s). Outputs: r = dy + stage_sum, and u, the
 * error of each component: r filtered by the real Newton matrix, u = (gamma/h I - J)^-1 r with gamma of
 * RADAU_TABLE.
 */
static Real RADAU(estimate_error)(const IntegratorOf *run, Real h, const Real *dy, const Real *stage_sum, Real *r,
    Real *u)
{
    Real largest = make_real(0.0);
    for (int i = 0; i < N_Y; i++)
        r[i] = dy[i] + stage_sum[i];
    newton_solve(&run->newton.linear, h * (1.0 / RADAU_TABLE.gamma), make_real(0.0), r, u);
    for (int i = 0; i < N_Y; i++)
        largest = real_max(real_abs(u[i]) * run->norm.weight[i], largest);
    return largest;
}

/*
 * Try a step of length h (s) by Radau IIA: stages, error norm and, if the error is accepted, its end. Return 0 or a
 * status. If Newton's method fails, the status rejects the step (NOT_FOUND; in lanes: a mask). A large error is
 * estimated again at the state with the error, which filters stiff components. Also stores the stiffness estimate h
 * rho.
 */
static int RADAU(try_step)(IntegratorOf *run, Real h, const ParametersOf *p, StepOf *step)
{
    const Real inverse_h = RADAU_TABLE.gamma / h;
    Real r[N_Y], u[N_Y], stage_sum[N_Y], change = make_real(0.0), distance = make_real(0.0);
    ComplexLinearOf complex_matrices[RADAU_STAGES / 2];
    Mask has_failed;
    step->t = run->t, step->h = h, step->dense_ready = 0;
    int status = RADAU(factor_matrices)(run, h, complex_matrices, p);
    if (status)
        return status;
    load_stage_predictor(run);
    RADAU(guess_stages)(run, h, step->k);
    status = RADAU(solve_stages)(run, h, complex_matrices, p, step, &has_failed);
    if (!status)
        status = mark_failed_stages(run, has_failed);
    if (status)
        return status;
    for (int i = 0; i < N_Y; i++) {
        stage_sum[i] = make_real(0.0);
        for (int s = 0; s < RADAU_STAGES; s++)
            stage_sum[i] += RADAU_TABLE.error[s] * step->k[s][i];
        stage_sum[i] *= inverse_h;
        step->y[i] = run->y[i] + step->k[RADAU_STAGES - 1][i];
    }
    step->error = RADAU(estimate_error)(run, h, run->dy, stage_sum, r, u);
    for (int k = 0; k < N_MOTION; k++) { /* J u = u/eta - r */
        const int i = get_motion_index(k);
        change = real_max(real_abs(inverse_h * u[i] - r[i]) * run->norm.weight[i], change);
        distance = real_max(real_abs(u[i]) * run->norm.weight[i], distance);
    }
    store_stiffness_estimate(run, select_value(distance > MIN_RESOLVED, h * change / distance, make_real(0.0)));
    const Mask large = step->error > run->control.max_accepted_error;
    if (any_of(large)) { /* repeat at the state with the error: this filters stiff components */
        Real y[N_Y], dy[N_Y];
        RhsOutputsOf rhs;
        for (int i = 0; i < N_Y; i++)
            y[i] = run->y[i] + u[i];
        status = evaluate_run_rhs(run, run->t, y, p, dy, &rhs);
        if (status)
            return status;
        count_stage_evaluations(run, large, 1);
        step->error = select_value(large, RADAU(estimate_error)(run, h, dy, stage_sum, r, u), step->error);
    }
    if (reject_nonfinite_error(run, step->error))
        return NOT_FINITE;
    return decide_step_rejection(run, step) ? 0 : finish_step(run, step, p);
}
