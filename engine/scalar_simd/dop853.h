/*
 * A trial step of the explicit Runge-Kutta method DOP853: stages, error, end, and the dense output. A rejected step has
 * no end. E. Hairer, S. P. Norsett, G. Wanner, Solving ODEs I (1993), section II.10.
 */
static const double dop853_node[] = {0.0, 0.05260015195876773, 0.0789002279381516, 0.1183503419072274,
    0.2816496580927726, 0.3333333333333333, 0.25, 0.3076923076923077, 0.6512820512820513, 0.6, 0.8571428571428571,
    1.0, 1.0, 0.1, 0.2, 0.7777777777777778};

enum { DOP853_STAGES = 12, DOP853_DENSE_STAGES = 3 /* additional stages of the dense output */ };

/*
 * Compute the state y = y0 + h sum_j a_sj k_j (N_Y) of stage s (1 ... 15) of DOP853; 12 is the end of the step, 13 to
 * 15 are for the dense output.
 */
static void dop853_compute_stage(int s, Real h, const Real *y0, Real (*k)[N_Y], Real *y)
{
    switch (s) {
    case 1:
        for (int i = 0; i < N_Y; i++)
            y[i] = y0[i] + h * (0.05260015195876773 * k[0][i]);
        break;
    case 2:
        for (int i = 0; i < N_Y; i++)
            y[i] = y0[i] + h * (0.0197250569845379 * k[0][i] + 0.0591751709536137 * k[1][i]);
        break;
    case 3:
        for (int i = 0; i < N_Y; i++)
            y[i] = y0[i] + h * (0.02958758547680685 * k[0][i] + 0.08876275643042054 * k[2][i]);
        break;
    case 4:
        for (int i = 0; i < N_Y; i++)
            y[i] = y0[i] + h * (0.2413651341592667 * k[0][i] - 0.8845494793282861 * k[2][i]
                + 0.924834003261792 * k[3][i]);
        break;
    case 5:
        for (int i = 0; i < N_Y; i++)
            y[i] = y0[i] + h * (0.037037037037037035 * k[0][i] + 0.17082860872947386 * k[3][i]
                + 0.12546768756682242 * k[4][i]);
        break;
    case 6:
        for (int i = 0; i < N_Y; i++)
            y[i] = y0[i] + h * (0.037109375 * k[0][i] + 0.17025221101954405 * k[3][i] + 0.06021653898045596 * k[4][i]
                - 0.017578125 * k[5][i]);
        break;
    case 7:
        for (int i = 0; i < N_Y; i++)
            y[i] = y0[i] + h * (0.03709200011850479 * k[0][i] + 0.17038392571223998 * k[3][i]
                + 0.10726203044637328 * k[4][i] - 0.015319437748624402 * k[5][i] + 0.008273789163814023 * k[6][i]);
        break;
    case 8:
        for (int i = 0; i < N_Y; i++)
            y[i] = y0[i] + h * (0.6241109587160757 * k[0][i] - 3.3608926294469414 * k[3][i]
                - 0.868219346841726 * k[4][i] + 27.59209969944671 * k[5][i] + 20.154067550477894 * k[6][i]
                - 43.48988418106996 * k[7][i]);
        break;
    case 9:
        for (int i = 0; i < N_Y; i++)
            y[i] = y0[i] + h * (0.47766253643826434 * k[0][i] - 2.4881146199716677 * k[3][i]
                - 0.590290826836843 * k[4][i] + 21.230051448181193 * k[5][i] + 15.279233632882423 * k[6][i]
                - 33.28821096898486 * k[7][i] - 0.020331201708508627 * k[8][i]);
        break;
    case 10:
        for (int i = 0; i < N_Y; i++)
            y[i] = y0[i] + h * (-0.9371424300859873 * k[0][i] + 5.186372428844064 * k[3][i]
                + 1.0914373489967295 * k[4][i] - 8.149787010746927 * k[5][i] - 18.52006565999696 * k[6][i]
                + 22.739487099350505 * k[7][i] + 2.4936055526796523 * k[8][i] - 3.0467644718982196 * k[9][i]);
        break;
    case 11:
        for (int i = 0; i < N_Y; i++)
            y[i] = y0[i] + h * (2.273310147516538 * k[0][i] - 10.53449546673725 * k[3][i]
                - 2.0008720582248625 * k[4][i] - 17.9589318631188 * k[5][i] + 27.94888452941996 * k[6][i]
                - 2.8589982771350235 * k[7][i] - 8.87285693353063 * k[8][i] + 12.360567175794303 * k[9][i]
                + 0.6433927460157636 * k[10][i]);
        break;
    case 12:
        for (int i = 0; i < N_Y; i++)
            y[i] = y0[i] + h * (0.054293734116568765 * k[0][i] + 4.450312892752409 * k[5][i]
                + 1.8915178993145003 * k[6][i] - 5.801203960010585 * k[7][i] + 0.3111643669578199 * k[8][i]
                - 0.1521609496625161 * k[9][i] + 0.20136540080403034 * k[10][i] + 0.04471061572777259 * k[11][i]);
        break;
    case 13:
        for (int i = 0; i < N_Y; i++)
            y[i] = y0[i] + h * (0.056167502283047954 * k[0][i] + 0.25350021021662483 * k[6][i]
                - 0.2462390374708025 * k[7][i] - 0.12419142326381637 * k[8][i] + 0.15329179827876568 * k[9][i]
                + 0.00820105229563469 * k[10][i] + 0.007567897660545699 * k[11][i] - 0.008298 * k[12][i]);
        break;
    case 14:
        for (int i = 0; i < N_Y; i++)
            y[i] = y0[i] + h * (0.03183464816350214 * k[0][i] + 0.028300909672366776 * k[5][i]
                + 0.053541988307438566 * k[6][i] - 0.05492374857139099 * k[7][i] - 0.00010834732869724932 * k[10][i]
                + 0.0003825710908356584 * k[11][i] - 0.00034046500868740456 * k[12][i] + 0.1413124436746325 * k[13][i]);
        break;
    case 15:
        for (int i = 0; i < N_Y; i++)
            y[i] = y0[i] + h * (-0.42889630158379194 * k[0][i] - 4.697621415361164 * k[5][i]
                + 7.683421196062599 * k[6][i] + 4.06898981839711 * k[7][i] + 0.3567271874552811 * k[8][i]
                - 0.0013990241651590145 * k[12][i] + 2.9475147891527724 * k[13][i] - 9.15095847217987 * k[14][i]);
        break;
    }
}

/* Return the scaled error of a step by Hairer's combination of the estimates of orders 5 and 3, in the maximum norm. */
static Real dop853_estimate_error(const IntegratorOf *run, const StepOf *step)
{
    const Real (*k)[N_Y] = (const Real (*)[N_Y])step->k;
    Real error_5 = make_real(0.0), error_3 = make_real(0.0);
    for (int i = 0; i < N_Y; i++) {
        const Real weight = run->norm.weight[i];
        const Real sum_5 = 0.01312004499419488 * k[0][i] - 1.2251564463762044 * k[5][i]
            - 0.4957589496572502 * k[6][i] + 1.6643771824549864 * k[7][i] - 0.35032884874997366 * k[8][i]
            + 0.3341791187130175 * k[9][i] + 0.08192320648511571 * k[10][i] - 0.022355307863886294 * k[11][i];
        const Real sum_3 = -0.18980075407240762 * k[0][i] + 4.450312892752409 * k[5][i]
            + 1.8915178993145003 * k[6][i] - 5.801203960010585 * k[7][i] - 0.4226823213237919 * k[8][i]
            - 0.1521609496625161 * k[9][i] + 0.20136540080403034 * k[10][i] + 0.02265179219836082 * k[11][i];
        error_5 = real_max(real_abs(sum_5) * weight, error_5);
        error_3 = real_max(real_abs(sum_3) * weight, error_3);
    }
    const Real squares = error_5 * error_5 + 0.01 * error_3 * error_3;
    return select_value(squares > 0.0, real_abs(step->h) * error_5 * error_5 / real_sqrt(squares), error_5);
}

/*
 * Try a step of length h (s) by DOP853: stages, error norm and, if the error is accepted, its end and its stiffness
 * estimate. Return 0 or a status. A rejected step has an error but no end. Called with the rates run->dy at the
 * beginning.
 */
static int dop853_try_step(IntegratorOf *run, Real h, const ParametersOf *p, StepOf *step)
{
    Real y[N_Y];
    RhsOutputsOf rhs;
    step->t = run->t, step->h = h, step->dense_ready = 0;
    discard_stages(step);
    for (int i = 0; i < N_Y; i++)
        step->k[0][i] = run->dy[i];
    for (int s = 1; s < DOP853_STAGES; s++) {
        dop853_compute_stage(s, h, run->y, step->k, s + 1 < DOP853_STAGES ? y : step->y);
        if (s + 1 == DOP853_STAGES)
            for (int i = 0; i < N_Y; i++)
                y[i] = step->y[i];
        const int status = evaluate_run_rhs(run, run->t + dop853_node[s] * h, y, p, step->k[s], &rhs);
        if (status)
            return status;
        record_stage(run, step, &rhs, dop853_node[s]);
        extend_stage_range(step, y);
    }
    dop853_compute_stage(DOP853_STAGES, h, run->y, step->k, step->y);
    step->error = dop853_estimate_error(run, step);
    if (reject_nonfinite_error(run, step->error))
        return NOT_FINITE;
    if (decide_step_rejection(run, step))
        return 0;
    const int status_last = finish_step(run, step, p);
    if (status_last)
        return status_last;
    /* beyond about 6 the step is bounded by stability */
    estimate_stiffness_at_end(run, step, h, y, step->k[DOP853_STAGES - 1]);
    return 0;
}

/* Compute the three additional stages and the coefficients step->dense of the dense output. Return 0 or a status. */
static int dop853_compute_dense_output(IntegratorOf *run, const ParametersOf *p, StepOf *step)
{
    Real (*k)[N_Y] = step->k;
    const Real h = step->h;
    for (int i = 0; i < N_Y; i++)
        k[DOP853_STAGES][i] = step->dy[i];
    for (int s = DOP853_STAGES + 1; s <= DOP853_STAGES + DOP853_DENSE_STAGES; s++) {
        Real y[N_Y];
        RhsOutputsOf rhs;
        dop853_compute_stage(s, h, run->y, k, y);
        const int status = evaluate_run_rhs(run, step->t + dop853_node[s] * h, y, p, k[s], &rhs);
        if (status)
            return status;
    }
    for (int i = 0; i < N_Y; i++) {
        const Real change = step->y[i] - run->y[i];
        step->dense[0][i] = change;
        step->dense[1][i] = h * run->dy[i] - change;
        step->dense[2][i] = 2.0 * change - h * (step->dy[i] + run->dy[i]);
        step->dense[3][i] = h * (-8.428938276109013 * k[0][i] + 0.5667149535193777 * k[5][i]
            - 3.0689499459498917 * k[6][i] + 2.38466765651207 * k[7][i] + 2.117034582445028 * k[8][i]
            - 0.871391583777973 * k[9][i] + 2.2404374302607883 * k[10][i] + 0.6315787787694688 * k[11][i]
            - 0.08899033645133331 * k[12][i] + 18.148505520854727 * k[13][i] - 9.194632392478356 * k[14][i]
            - 4.436036387594894 * k[15][i]);
        step->dense[4][i] = h * (10.427508642579134 * k[0][i] + 242.28349177525817 * k[5][i]
            + 165.20045171727028 * k[6][i] - 374.5467547226902 * k[7][i] - 22.113666853125306 * k[8][i]
            + 7.733432668472264 * k[9][i] - 30.674084731089398 * k[10][i] - 9.332130526430229 * k[11][i]
            + 15.697238121770845 * k[12][i] - 31.139403219565178 * k[13][i] - 9.35292435884448 * k[14][i]
            + 35.81684148639408 * k[15][i]);
        step->dense[5][i] = h * (19.985053242002433 * k[0][i] - 387.0373087493518 * k[5][i]
            - 189.17813819516758 * k[6][i] + 527.8081592054236 * k[7][i] - 11.57390253995963 * k[8][i]
            + 6.8812326946963 * k[9][i] - 1.0006050966910838 * k[10][i] + 0.7777137798053443 * k[11][i]
            - 2.778205752353508 * k[12][i] - 60.19669523126412 * k[13][i] + 84.32040550667716 * k[14][i]
            + 11.99229113618279 * k[15][i]);
        step->dense[6][i] = h * (-25.69393346270375 * k[0][i] - 154.18974869023643 * k[5][i]
            - 231.5293791760455 * k[6][i] + 357.6391179106141 * k[7][i] + 93.40532418362432 * k[8][i]
            - 37.45832313645163 * k[9][i] + 104.0996495089623 * k[10][i] + 29.8402934266605 * k[11][i]
            - 43.53345659001114 * k[12][i] + 96.32455395918828 * k[13][i] - 39.17726167561544 * k[14][i]
            - 149.72683625798564 * k[15][i]);
    }
    return 0;
}
