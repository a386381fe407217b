/*
 * A trial step of Rodas5P, a Rosenbrock method of order 5 (G. Steinebach, BIT 63 (2023)): stages, error, end. A
 * rejected step has no end.
 */
enum { RODAS5P_STAGES = 8 };
#define RODAS5P_GAMMA 0.21193756319429014
static const double rodas5p_node[] = {0.0, 0.6358126895828704, 0.4095798393397535, 0.9769306725060716,
    0.4288403609558664, 1.0, 1.0, 1.0};
static const double rodas5p_time[] = {0.21193756319429014, -0.42387512638858027, -0.3384627126235924,
    1.8046452872882734, 2.325825639765069, 0.0, 0.0, 0.0};

/* Compute the state y = y0 + sum_j a_sj u_j (N_Y) of stage s, 1 ... 7, from the increments k of the earlier stages. */
static void rodas5p_compute_stage(int s, const Real *y0, Real (*k)[N_Y], Real *y)
{
    switch (s) {
    case 1:
        for (int i = 0; i < N_Y; i++)
            y[i] = y0[i] + (3.0 * k[0][i]);
        break;
    case 2:
        for (int i = 0; i < N_Y; i++)
            y[i] = y0[i] + (2.849394379747939 * k[0][i] + 0.45842242204463923 * k[1][i]);
        break;
    case 3:
        for (int i = 0; i < N_Y; i++)
            y[i] = y0[i] + (-6.954028509809101 * k[0][i] + 2.489845061869568 * k[1][i]
                - 10.358996098473584 * k[2][i]);
        break;
    case 4:
        for (int i = 0; i < N_Y; i++)
            y[i] = y0[i] + (2.8029986275628964 * k[0][i] + 0.5072464736228206 * k[1][i] - 0.3988312541770524 * k[2][i]
                - 0.04721187230404641 * k[3][i]);
        break;
    case 5:
        for (int i = 0; i < N_Y; i++)
            y[i] = y0[i] + (-7.502846399306121 * k[0][i] + 2.561846144803919 * k[1][i] - 11.627539656261098 * k[2][i]
                - 0.18268767659942256 * k[3][i] + 0.030198172008377946 * k[4][i]);
        break;
    case 6:
        for (int i = 0; i < N_Y; i++)
            y[i] = y0[i] + (-7.502846399306121 * k[0][i] + 2.561846144803919 * k[1][i] - 11.627539656261098 * k[2][i]
                - 0.18268767659942256 * k[3][i] + 0.030198172008377946 * k[4][i] + 1.0 * k[5][i]);
        break;
    case 7:
        for (int i = 0; i < N_Y; i++)
            y[i] = y0[i] + (-7.502846399306121 * k[0][i] + 2.561846144803919 * k[1][i] - 11.627539656261098 * k[2][i]
                - 0.18268767659942256 * k[3][i] + 0.030198172008377946 * k[4][i] + 1.0 * k[5][i] + 1.0 * k[6][i]);
        break;
    }
}

/*
 * Compute the right-hand side r = f + sum_j c_sj/h u_j of the linear system of stage s, 0 ... 7, from the rates f at
 * that stage and the increments k of the earlier stages.
 */
static void rodas5p_compute_stage_rhs(int s, Real h, const Real *f, Real (*k)[N_Y], Real *r)
{
    const Real inverse_h = 1.0 / h;
    switch (s) {
    case 0:
        for (int i = 0; i < N_Y; i++)
            r[i] = f[i];
        break;
    case 1:
        for (int i = 0; i < N_Y; i++)
            r[i] = f[i] + inverse_h * (-14.155112264123755 * k[0][i]);
        break;
    case 2:
        for (int i = 0; i < N_Y; i++)
            r[i] = f[i] + inverse_h * (-17.97296035885952 * k[0][i] - 2.859693295451294 * k[1][i]);
        break;
    case 3:
        for (int i = 0; i < N_Y; i++)
            r[i] = f[i] + inverse_h * (147.12150275711716 * k[0][i] - 1.41221402718213 * k[1][i]
                + 71.68940251302358 * k[2][i]);
        break;
    case 4:
        for (int i = 0; i < N_Y; i++)
            r[i] = f[i] + inverse_h * (165.43517024871676 * k[0][i] - 0.4592823456491126 * k[1][i]
                + 42.90938336958603 * k[2][i] - 5.961986721573306 * k[3][i]);
        break;
    case 5:
        for (int i = 0; i < N_Y; i++)
            r[i] = f[i] + inverse_h * (24.854864614690072 * k[0][i] - 3.0009227002832186 * k[1][i]
                + 47.4931110020768 * k[2][i] + 5.5814197821558125 * k[3][i] - 0.6610691825249471 * k[4][i]);
        break;
    case 6:
        for (int i = 0; i < N_Y; i++)
            r[i] = f[i] + inverse_h * (30.91273214028599 * k[0][i] - 3.1208243349937974 * k[1][i]
                + 77.79954646070892 * k[2][i] + 34.28646028294783 * k[3][i] - 19.097331116725623 * k[4][i]
                - 28.087943162872662 * k[5][i]);
        break;
    case 7:
        for (int i = 0; i < N_Y; i++)
            r[i] = f[i] + inverse_h * (37.80277123390563 * k[0][i] - 3.2571969029072276 * k[1][i]
                + 112.26918849496327 * k[2][i] + 66.9347231244047 * k[3][i] - 40.06618937091002 * k[4][i]
                - 54.66780262877968 * k[5][i] - 9.48861652309627 * k[6][i]);
        break;
    }
}

/*
 * Try a step of length h (s) by Rodas5P: stages, error norm and, if the error is accepted, its end. Return 0 or a
 * status. Each stage solves one linear system with the same Newton matrix. The error is the last increment. The
 * stiffness estimate h rho follows from the last two stages, which are at one time.
 */
static int rodas5p_try_step(IntegratorOf *run, Real h, const ParametersOf *p, StepOf *step)
{
    const Real hg = h * RODAS5P_GAMMA;
    Real y[N_Y], f[N_Y], r[N_Y], before[N_Y], change = make_real(0.0), distance = make_real(0.0);
    RhsOutputsOf rhs;
    step->t = run->t, step->h = h, step->dense_ready = 0;
    discard_stages(step);
    int status = factor_newton_matrix(run, hg, p);
    if (status)
        return status;
    for (int i = 0; i < N_Y; i++)
        f[i] = run->dy[i];
    for (int s = 0; s < RODAS5P_STAGES; s++) {
        if (s > 0) {
            for (int i = 0; i < N_Y; i++)
                before[i] = f[i];
            rodas5p_compute_stage(s, run->y, step->k, y);
            status = evaluate_run_rhs(run, run->t + rodas5p_node[s] * h, y, p, f, &rhs);
            if (status)
                return status;
            record_stage(run, step, &rhs, rodas5p_node[s]);
        }
        rodas5p_compute_stage_rhs(s, h, f, step->k, r);
        newton_solve(&run->newton.linear, hg, h * rodas5p_time[s], r, step->k[s]);
        if (s == 7) /* the last two stages are at one time: f changes between them by J times their difference */
            for (int k = 0; k < N_MOTION; k++) {
                const int i = get_motion_index(k);
                change = real_max(real_abs(f[i] - before[i]) * run->norm.weight[i], change);
                distance = real_max(real_abs(step->k[6][i]) * run->norm.weight[i], distance);
            }
    }
    step->error = make_real(0.0);
    for (int i = 0; i < N_Y; i++)
        step->y[i] = y[i] + step->k[7][i];
    for (int i = 0; i < N_Y; i++)
        step->error = real_max(real_abs(step->k[7][i]) * run->norm.weight[i], step->error);
    if (reject_nonfinite_error(run, step->error))
        return NOT_FINITE;
    store_stiffness_estimate(run, select_value(distance > MIN_RESOLVED, h * change / distance, make_real(0.0)));
    return decide_step_rejection(run, step) ? 0 : finish_step(run, step, p);
}
