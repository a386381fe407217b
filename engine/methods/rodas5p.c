/*
 * Rodas5P: a Rosenbrock method of order 5 with the exact Jacobian, L-stable, dense output of order 4.
 * G. Steinebach, BIT 63:27 (2023). (1/(h gamma) - J) u_i = f(y + sum a_ij u_j) + sum c_ij/h u_j + d_i h f_t.
 */

#define RODAS5P_GAMMA 0.21193756319429014
static const double rodas5p_node[] = {0.0, 0.6358126895828704, 0.4095798393397535, 0.9769306725060716,
    0.4288403609558664, 1.0, 1.0, 1.0};
static const double rodas5p_time[] = {0.21193756319429014, -0.42387512638858027, -0.3384627126235924,
    1.8046452872882734, 2.325825639765069, 0.0, 0.0, 0.0};
/* Shares of a step, in their order, at which it is evaluated. */
static const double rodas5p_heard[] = {0.0, 0.4095798393397535, 0.4288403609558664, 0.6358126895828704,
    0.9769306725060716, 1.0};

/* Where stage s > 0 is evaluated: y0 + sum a_sj u_j. */
static void rodas5p_stage(int s, const double *y0, double (*k)[N_Y], double *y)
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

/* Its right-hand side: f + sum c_sj/h u_j. */
static void rodas5p_right(int s, double h, const double *f, double (*k)[N_Y], double *r)
{
    const double by = 1.0 / h;
    switch (s) {
    case 0:
        for (int i = 0; i < N_Y; i++)
            r[i] = f[i];
        break;
    case 1:
        for (int i = 0; i < N_Y; i++)
            r[i] = f[i] + by * (-14.155112264123755 * k[0][i]);
        break;
    case 2:
        for (int i = 0; i < N_Y; i++)
            r[i] = f[i] + by * (-17.97296035885952 * k[0][i] - 2.859693295451294 * k[1][i]);
        break;
    case 3:
        for (int i = 0; i < N_Y; i++)
            r[i] = f[i] + by * (147.12150275711716 * k[0][i] - 1.41221402718213 * k[1][i]
                + 71.68940251302358 * k[2][i]);
        break;
    case 4:
        for (int i = 0; i < N_Y; i++)
            r[i] = f[i] + by * (165.43517024871676 * k[0][i] - 0.4592823456491126 * k[1][i]
                + 42.90938336958603 * k[2][i] - 5.961986721573306 * k[3][i]);
        break;
    case 5:
        for (int i = 0; i < N_Y; i++)
            r[i] = f[i] + by * (24.854864614690072 * k[0][i] - 3.0009227002832186 * k[1][i]
                + 47.4931110020768 * k[2][i] + 5.5814197821558125 * k[3][i] - 0.6610691825249471 * k[4][i]);
        break;
    case 6:
        for (int i = 0; i < N_Y; i++)
            r[i] = f[i] + by * (30.91273214028599 * k[0][i] - 3.1208243349937974 * k[1][i]
                + 77.79954646070892 * k[2][i] + 34.28646028294783 * k[3][i] - 19.097331116725623 * k[4][i]
                - 28.087943162872662 * k[5][i]);
        break;
    case 7:
        for (int i = 0; i < N_Y; i++)
            r[i] = f[i] + by * (37.80277123390563 * k[0][i] - 3.2571969029072276 * k[1][i]
                + 112.26918849496327 * k[2][i] + 66.9347231244047 * k[3][i] - 40.06618937091002 * k[4][i]
                - 54.66780262877968 * k[5][i] - 9.48861652309627 * k[6][i]);
        break;
    }
}

static int rodas5p_try(Run *run, double h, const Parameters *p, Step *step)
{
    const double hg = h * RODAS5P_GAMMA;
    double y[N_Y], f[N_Y], r[N_Y], before[N_Y];
    Aside aside;
    step->t = run->t, step->h = h, step->dense_ready = 0;
    forget_stages(step);
    if (!run->linear_ready) {
        show_states(&run->memory, run->y);
        const int lost = linearize_state(run->t, run->y, &run->memory, p, run->dy + N_X, &run->aside, &run->linear);
        if (lost)
            return lost;
        run->jacobians++;
        run->linear_ready = 1;
    }
    int status = newton_factor(hg, &run->linear) ? NOT_FINITE : 0;
    double change = 0.0, way = 0.0;
    for (int i = 0; i < N_Y; i++)
        f[i] = run->dy[i];
    for (int s = 0; s < 8 && !status; s++) {
        if (s > 0) {
            for (int i = 0; i < N_Y; i++)
                before[i] = f[i];
            rodas5p_stage(s, run->y, step->k, y);
            status = rates(run, run->t + rodas5p_node[s] * h, y, p, f, &aside);
            if (status)
                return status;
            note_stage(run, step, &aside, rodas5p_node[s]);
        }
        rodas5p_right(s, h, f, step->k, r);
        newton_solve(&run->linear, hg, h * rodas5p_time[s], r, step->k[s]);
        if (s == 7) /* the last two stages lie at one time: what f changes between them is J times their way */
            for (int i = 0; i < 2 * N_X; i++) {
                change = max_of(fabs(f[i] - before[i]) * run->weight[i], change);
                way = max_of(fabs(step->k[6][i]) * run->weight[i], way);
            }
    }
    if (status)
        return status;
    step->error = 0.0;
    for (int i = 0; i < N_Y; i++)
        step->y[i] = y[i] + step->k[7][i];
    for (int i = 0; i < N_Y; i++)
        step->error = max_of(fabs(step->k[7][i]) * run->weight[i], step->error);
    if (!isfinite(step->error))
        return NOT_FINITE;
    run->stability = way > 0.0 ? h * change / way : 0.0;
    return step->error > run->accept ? 0 : finish_step(run, step, p);
}

static int rodas5p_dense(Run *run, const Parameters *p, Step *step)
{
    (void)p;
    double (*const k)[N_Y] = step->k;
    for (int i = 0; i < N_Y; i++) {
        step->dense[0][i] = step->y[i] - run->y[i];
        step->dense[1][i] = 25.948786856663858 * k[0][i] - 2.5579724845846235 * k[1][i] + 10.433815404888879 * k[2][i]
            - 2.3679251022685204 * k[3][i] + 0.524948541321073 * k[4][i] + 1.1241088310450404 * k[5][i]
            + 0.4272876194431874 * k[6][i] - 0.17202221070155493 * k[7][i];
        step->dense[2][i] = -9.91568850695171 * k[0][i] - 0.9689944594115154 * k[1][i] + 3.0438037242978453 * k[2][i]
            - 24.495224566215796 * k[3][i] + 20.176138334709044 * k[4][i] + 15.98066361424651 * k[5][i]
            - 6.789040303419874 * k[6][i] - 6.710236069923372 * k[7][i];
        step->dense[3][i] = 11.419903575922262 * k[0][i] + 2.8879645146136994 * k[1][i] + 72.92137995996029 * k[2][i]
            + 80.12511834622643 * k[3][i] - 52.072871366152654 * k[4][i] - 59.78993625266729 * k[5][i]
            - 0.15582684282751913 * k[6][i] + 4.883087185713722 * k[7][i];
    }
    return 0;
}

static void rodas5p_interpolate(const Run *run, const Step *step, double s, double *y)
{
    const double (*d)[N_Y] = (const double (*)[N_Y])step->dense;
    for (int i = 0; i < N_Y; i++)
        y[i] = run->y[i] + s * (d[0][i] + (1.0 - s) * (d[1][i] + s * (d[2][i] + s * d[3][i])));
}

static const Method rodas5p = {.name = "rodas5p", .try = rodas5p_try, .dense = rodas5p_dense,
    .interpolate = rodas5p_interpolate, .power = 0.2, .stiff = 1, .unstable = INFINITY, .bounded = INFINITY,
    .degree = 4, .turned = 0x2, .heard = rodas5p_heard, .n_heard = COUNT_OF(rodas5p_heard)};
