/* The functions of a Radau step, compiled for 3 and for 5 stages (radau.h). */

/*
 * Guess the stages, relative to the beginning: extrapolate the motion of the last step, or integrate the rates at the
 * beginning.
 */
static void RADAU(guess)(const IntegratorOf *run, Real h, Real (*z)[N_Y])
{
    const Real H = run->newton.last_h;
    for (int i = 0; i < N_Y; i++) {
        /* Hermite's cubic, beyond the end of the step before, which was H long */
        const Real way = run->newton.before_y[i] - run->y[i], d0 = H * run->newton.before_dy[i], d1 = H * run->dy[i];
        const Real two = 3.0 * way + d0 + 2.0 * d1, three = 2.0 * way + d0 + d1;
        for (int s = 0; s < RADAU_STAGES; s++) {
            const Real t = RADAU_TABLE.node[s] * h, x = t / H;
            const Real led = i < N_X ? t * (run->dy[i] + 0.5 * t * run->dy[N_X + i]) : t * run->dy[i];
            z[s][i] = pick(run->newton.continues, x * (d1 + x * (two + x * three)), led);
        }
    }
}

/* Factorize the real matrix and the complex ones for a step of length h. Returns a status. */
static int RADAU(factor)(IntegratorOf *run, Real h, ComplexLinearOf *pairs, const ParametersOf *p)
{
    int status = factor_newton_matrix(run, h * (1.0 / RADAU_TABLE.gamma), p);
    for (int k = 0; 2 * k + 1 < RADAU_STAGES && !status; k++) {
        const double re = RADAU_TABLE.pair[k][0], im = RADAU_TABLE.pair[k][1], square = re * re + im * im;
        status = factor_complex_matrix(run, h * (re / square), h * (-im / square), &pairs[k]);
    }
    return status;
}

/* Compute the Newton correction of the stages z from their rates f. */
static void RADAU(change)(const IntegratorOf *run, Real h, const ComplexLinearOf *pairs, Real (*f)[N_Y], Real (*z)[N_Y],
    Real (*change)[N_Y])
{
    Real w[RADAU_STAGES][N_Y], r[RADAU_STAGES][N_Y], both[2 * N_Y], u[2 * N_Y];
    const Real by = 1.0 / h;
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
            w[k][i] *= by;
    }
    for (int i = 0; i < N_Y; i++)
        r[0][i] -= RADAU_TABLE.gamma * w[0][i];
    newton_solve(&run->newton.linear, h * (1.0 / RADAU_TABLE.gamma), real_of(0.0), r[0], w[0]);
    for (int k = 0; 2 * k + 1 < RADAU_STAGES; k++) {
        const double re = RADAU_TABLE.pair[k][0], im = RADAU_TABLE.pair[k][1], square = re * re + im * im;
        Real *const x = w[2 * k + 1], *const y = w[2 * k + 2];
        for (int i = 0; i < N_Y; i++) {
            both[2 * i] = r[2 * k + 1][i] - (re * x[i] - im * y[i]);
            both[2 * i + 1] = r[2 * k + 2][i] - (re * y[i] + im * x[i]);
        }
        newton_solve_complex(&pairs[k], h * (re / square), h * (-im / square), both, u);
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
 * Compute the rates f of the stages z and, for active runs, store the data of the stages. force_change: the largest
 * change of a film force since the previous iteration, relative to the largest force in this step. Returns a status.
 */
static int RADAU(rates)(IntegratorOf *run, Real h, Mask active, Real (*z)[N_Y], const ParametersOf *p, StepOf *step,
    Real (*f)[N_Y], Real (*force)[RADAU_STAGES][2], Real *force_change)
{
    Real y[N_Y], most[AT_LEAST_ONE(N_CLEARANCES)], change[AT_LEAST_ONE(N_CLEARANCES)];
    RhsOutputsOf rhs;
    begin_iteration(run, step, active, RADAU_STAGES);
    for (int i = 0; i < N_CLEARANCES; i++) {
        most[i] = real_abs(run->rhs.clearance[i].Fx) + real_abs(run->rhs.clearance[i].Fy);
        change[i] = real_of(0.0);
    }
    for (int s = 0; s < RADAU_STAGES; s++) {
        for (int i = 0; i < N_Y; i++)
            y[i] = run->y[i] + z[s][i];
        const int status = rates(run, run->t + RADAU_TABLE.node[s] * h, y, p, f[s], &rhs);
        if (status)
            return status;
        record_pass(run, step, active, y, &rhs, RADAU_TABLE.node[s]);
        for (int i = 0; i < N_CLEARANCES; i++) {
            const Real Fx = rhs.clearance[i].Fx, Fy = rhs.clearance[i].Fy;
            if (!has_film(i))
                continue;
            change[i] = real_max(real_abs(Fx - force[i][s][0]) + real_abs(Fy - force[i][s][1]), change[i]);
            most[i] = real_max(real_abs(Fx) + real_abs(Fy), most[i]);
            force[i][s][0] = Fx;
            force[i][s][1] = Fy;
        }
    }
    *force_change = real_of(0.0);
    for (int i = 0; i < N_CLEARANCES; i++)
        if (has_film(i))
            *force_change = real_max(change[i] / real_max(most[i], real_of(DBL_MIN)), *force_change);
    return 0;
}

/*
 * Find the stages of a step, in step->k, by simplified Newton iterations. lost: where they are not found. Returns a
 * status.
 */
static int RADAU(stages)(IntegratorOf *run, Real h, const ComplexLinearOf *pairs, const ParametersOf *p, StepOf *step,
    Mask *lost)
{
    Real f[RADAU_STAGES][N_Y], change[RADAU_STAGES][N_Y], before = real_of(1.0), force_change;
    Real force[AT_LEAST_ONE(N_CLEARANCES)][RADAU_STAGES][2] = {0};
    /* the convergence rate of an earlier step is less certain for this one: power 3/4 */
    const Real known = real_sqrt(run->newton.falls) * real_sqrt(real_sqrt(run->newton.falls));
    Real falls = pick(run->newton.falls > 0.0, known, real_of(0.5));
    Real (*const z)[N_Y] = step->k;
    /* rounding bounds the accuracy of the stages; with fixed steps the iteration goes down to it */
    Real rounded = real_of(0.0);
    for (int i = 0; i < N_Y; i++)
        rounded = real_max(real_abs(run->y[i]) * run->norm.weight[i], rounded);
    rounded *= RADAU_ROUNDED;
    const Real enough = real_max(pick(run->control.accept <= DBL_MAX, real_of(RADAU_ENOUGH), rounded), rounded);
    Mask active = is_not((Mask){0});
    *lost = (Mask){0};
    const int controlled = any_of(run->control.accept <= DBL_MAX);
    const int patience = controlled ? RADAU_PATIENCE : RADAU_STUBBORN;
    const double hope = controlled ? 0.9 : 2.0; /* a fixed step may begin with a bad guess */
    for (int pass = 0; pass < patience && any_of(active); pass++) {
        const int status = RADAU(rates)(run, h, active, z, p, step, f, force, &force_change);
        if (status)
            return status;
        RADAU(change)(run, h, pairs, f, z, change);
        Real way = real_of(0.0);
        for (int s = 0; s < RADAU_STAGES; s++)
            for (int i = 0; i < N_Y; i++) {
                z[s][i] = pick(active, z[s][i] + change[s][i], z[s][i]);
                way = real_max(real_abs(change[s][i]) * run->norm.weight[i], way);
            }
        way = pick(active, way, real_of(0.0));
        if (is_not_a_number(run, way))
            return NOT_FINITE;
        Mask found = active & (way <= rounded);
        if (pass > 0)
            falls = pick(active & is_not(found), way / before, falls);
        /* a film force is linear in the velocity by sectors of its direction: the first change may miss the sector */
        if (pass > has_films()) {
            /* the change no longer decreases */
            found |= active & is_not(falls < 0.9) & (way <= RADAU_NOISE * rounded)
                & (force_change <= run->newton.force_found);
            *lost |= active & is_not(found | (falls < hope));
            active &= found | (falls < hope);
        }
        found |= active & (falls * way <= enough * (1.0 - falls))
            & (falls * force_change <= run->newton.force_found * (1.0 - falls));
        run->newton.falls = pick(found, real_max(falls, real_of(1e-3)), run->newton.falls);
        active &= is_not(found);
        before = pick(active, way, real_of(1.0));
    }
    *lost |= active;
    return 0;
}

/*
 * Return the scaled error of a step, from rates dy at its beginning and the contribution `bend` of its stages; u: the
 * error of each component.
 */
static Real RADAU(error)(const IntegratorOf *run, Real h, const Real *dy, const Real *bend, Real *r, Real *u)
{
    Real most = real_of(0.0);
    for (int i = 0; i < N_Y; i++)
        r[i] = dy[i] + bend[i];
    newton_solve(&run->newton.linear, h * (1.0 / RADAU_TABLE.gamma), real_of(0.0), r, u);
    for (int i = 0; i < N_Y; i++)
        most = real_max(real_abs(u[i]) * run->norm.weight[i], most);
    return most;
}

/* Try a step of length h: stages, error and, if it is accepted, its end. Returns a status. */
static int RADAU(try)(IntegratorOf *run, Real h, const ParametersOf *p, StepOf *step)
{
    const Real by = RADAU_TABLE.gamma / h;
    Real r[N_Y], u[N_Y], bend[N_Y], change = real_of(0.0), way = real_of(0.0);
    ComplexLinearOf pairs[RADAU_STAGES / 2];
    Mask lost;
    step->t = run->t, step->h = h, step->dense_ready = 0;
    int status = RADAU(factor)(run, h, pairs, p);
    if (status)
        return status;
    load_iteration_history(run);
    RADAU(guess)(run, h, step->k);
    status = RADAU(stages)(run, h, pairs, p, step, &lost);
    if (!status)
        status = mark_missed_stages(run, lost);
    if (status)
        return status;
    for (int i = 0; i < N_Y; i++) {
        bend[i] = real_of(0.0);
        for (int s = 0; s < RADAU_STAGES; s++)
            bend[i] += RADAU_TABLE.error[s] * step->k[s][i];
        bend[i] *= by;
        step->y[i] = run->y[i] + step->k[RADAU_STAGES - 1][i];
    }
    step->error = RADAU(error)(run, h, run->dy, bend, r, u);
    for (int k = 0; k < N_MOTION; k++) { /* J u = u/eta - r */
        const int i = felt(k);
        change = real_max(real_abs(by * u[i] - r[i]) * run->norm.weight[i], change);
        way = real_max(real_abs(u[i]) * run->norm.weight[i], way);
    }
    record_stability(run, pick(way > MIN_RESOLVED, h * change / way, real_of(0.0)));
    const Mask large = step->error > run->control.accept;
    if (any_of(large)) { /* repeat at the state with the error: this filters stiff components */
        Real y[N_Y], dy[N_Y];
        RhsOutputsOf rhs;
        for (int i = 0; i < N_Y; i++)
            y[i] = run->y[i] + u[i];
        status = rates(run, run->t, y, p, dy, &rhs);
        if (status)
            return status;
        count_stage_rates(run, large, 1);
        step->error = pick(large, RADAU(error)(run, h, dy, bend, r, u), step->error);
    }
    if (is_not_a_number(run, step->error))
        return NOT_FINITE;
    return is_step_refused(run, step) ? 0 : finish_step(run, step, p);
}
