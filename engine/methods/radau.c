/*
 * Radau IIA, of orders 5 and 9: collocation at 3 and 5 points, L-stable. All stages of a step are found together by
 * simplified Newton iterations, which a change of basis splits into one real and one or two complex systems, each with
 * the matrix of a single stage. The error is that of an embedded formula of order 3 or 5, filtered by the real matrix.
 * E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, Springer (1996), section IV.8; the same, Stiff
 * differential equations solved by Radau methods, J. Comput. Appl. Math. 111 (1999) 93-111.
 */
enum { RADAU_STAGES = 5, RADAU_PAIRS = 2, RADAU_PATIENCE = 10 };
#define RADAU_ENOUGH 1e-2 /* of a step's tolerance: how well its stages are found */

/*
 * The inverse of Butcher's matrix is T diag(gamma, pairs) T^-1; a pair's columns of T go with real and imaginary part
 * of one number. Dense output: the collocation polynomial's coefficients from the stages.
 */
typedef struct {
    int stages;
    double node[RADAU_STAGES], gamma, pair[RADAU_PAIRS][2], to_stages[RADAU_STAGES][RADAU_STAGES],
        from_stages[RADAU_STAGES][RADAU_STAGES], error[RADAU_STAGES], dense[RADAU_STAGES][RADAU_STAGES];
} Radau;

static const Radau RADAU5 = {
    .stages = 3, .node = {0.15505102572168219, 0.64494897427831781, 1.0},
    .gamma = 3.6378342527444957, .pair = {{2.6810828736277521, 3.0504301992474106}},
    .to_stages = {{0.094438762488975241, -0.28251059004190842, -0.060058388210294849},
        {0.25021312296533331, 0.40825870458759986, 0.76588422551452388},
        {1.0, 2.0, 0.0}},
    .from_stages = {{4.1787185915519047, 0.32768282076106239, 0.52337644549944955},
        {-2.0893592957759524, -0.16384141038053119, 0.23831177725027523},
        {-0.25143631747289344, 1.2859634749278027, -0.29801960241411246}},
    .error = {-2.7623054547485994, 0.37993559825272888, -0.091629609865225789},
    .dense = {{0.0, 0.0, 1.0},
        {10.048809399827416, -1.3821427331607489, -0.66666666666666667},
        {-15.580782047249224, 8.9141153805825572, -3.3333333333333333}}};

static const Radau RADAU9 = {
    .stages = 5, .node = {0.057104196114517682, 0.27684301363812383, 0.58359043236891682, 0.86024013565621945, 1.0},
    .gamma = 6.2867047517292766, .pair = {{5.7009532986717894, 3.2102656003085499}, {3.6556943254635723, 6.5437368993600773}},
    .to_stages = {{0.013576867344947943, -0.022957030510459029, -0.028039717785750821, -0.020484095635817654, 0.095347754580591448},
        {0.0016179004017190875, -0.015337661498360326, 0.049417156853037054, 0.10034572903474212, -0.18866363836322287},
        {0.079157853347447208, 0.038796927997657902, 0.16360070740750234, -0.46107906808683589, 0.2054060907602518},
        {0.41225608268046145, 0.81520234256039813, 0.39936485577360505, 0.7557878044977225, 0.93348826066498872},
        {1.0, 2.0, 0.0, 2.0, 0.0}},
    .from_stages = {{27.697693775684088, 12.783337911304406, 3.2084893867134299, -0.95149041224891622, 0.7415504960259896},
        {-16.5209401067595, -8.6884767395317835, -0.086064531627002781, -0.049584888991271321, 0.26561405791915333},
        {-4.305721989937646, 4.8499957047644041, 0.95736431984843714, 1.20934600304247, -0.52373174396766871},
        {2.6720932189174558, 2.2968077838795805, -1.5181801617297121, 0.52533009511572943, -0.13638930593214814},
        {1.8740299037199024, -1.9924828681719423, -0.5222078208040094, 0.59204928406897424, -0.22495888507839018}},
    .error = {-4.4189977167963817, 0.57923485225667005, -0.19923756095346801, 0.094167483691945489, -0.031813168885493824},
    .dense = {{0.0, 0.0, 0.0, 0.0, 1.0},
        {27.780933944064637, -3.6414784980492132, 1.2525477211691187, -0.59200316718454287, -0.8},
        {-36.193358167658926, 10.611734614705874, -10.029661925319592, 18.811285478272644, -11.2},
        {-144.05356518917777, 63.630162942362741, -17.885204671340986, -5.2913930818439813, 5.6},
        {199.88739542347736, -127.022853068795, 92.10283313613322, -64.167375490815583, 25.2}}};

/* Guesses of the stages, less the beginning: as the last step's motion goes on, or as rates at the beginning lead. */
static void radau_guess(Run *run, const Radau *of, double h, double (*z)[N_Y])
{
    Past *now = &run->now, *past = &run->past;
    if (now->steps != run->steps || now->t != run->t) { /* another step begins */
        *past = *now;
        now->t = run->t;
        now->steps = run->steps;
        for (int i = 0; i < N_Y; i++) {
            now->y[i] = run->y[i];
            now->dy[i] = run->dy[i];
        }
    }
    const double H = now->t - past->t;
    const int goes_on = past->steps == run->steps - 1 && H > 0.0 && run->steps > 0 && !run->attempt.again;
    for (int s = 0; s < of->stages; s++) {
        const double c = of->node[s] * h;
        if (!goes_on) {
            for (int i = 0; i < N_Y; i++)
                z[s][i] = i < N_X ? c * (run->dy[i] + 0.5 * c * run->dy[N_X + i]) : c * run->dy[i];
            continue;
        }
        /* Hermite's cubic of rates, its integral: x beyond the end of the step before, which was H long */
        const double x = c / H;
        for (int i = 0; i < N_Y; i++) {
            const double y0 = past->y[i], y1 = now->y[i], d0 = H * past->dy[i], d1 = H * now->dy[i];
            const double two = 3.0 * (y0 - y1) + d0 + 2.0 * d1, three = 2.0 * (y0 - y1) + d0 + d1;
            z[s][i] = x * (d1 + x * (two + x * three));
        }
    }
}

/* One real system and the complex ones, factorized for a step. */
static int radau_factor(Run *run, const Radau *of, double h, ComplexLinear *pairs, Complex *eta, const Parameters *p)
{
    int status = make_linear(run, h / of->gamma, p);
    for (int k = 0; 2 * k + 1 < of->stages && !status; k++) {
        const double re = of->pair[k][0], im = of->pair[k][1], size = h / (re * re + im * im);
        __real__ eta[k] = re * size;
        __imag__ eta[k] = -im * size;
        pairs[k].p = run->linear.p;
        pairs[k].value = run->linear.value;
        status = newton_factor_complex(eta[k], &pairs[k]) ? NOT_FINITE : 0;
    }
    return status;
}

/* What an iteration adds to the stages, from their rates f and what they are now. */
static void radau_change(const Run *run, const Radau *of, double h, const ComplexLinear *pairs, const Complex *eta,
    double (*f)[N_Y], double (*z)[N_Y], double (*change)[N_Y])
{
    double w[RADAU_STAGES][N_Y], r[N_Y];
    const double by = 1.0 / h;
    double rest[RADAU_STAGES][N_Y];
    for (int k = 0; k < of->stages; k++)
        for (int i = 0; i < N_Y; i++) {
            double rate = 0.0, at = 0.0;
            for (int s = 0; s < of->stages; s++) {
                rate += of->from_stages[k][s] * f[s][i];
                at += of->from_stages[k][s] * z[s][i];
            }
            rest[k][i] = rate;
            w[k][i] = by * at;
        }
    for (int i = 0; i < N_Y; i++)
        r[i] = rest[0][i] - of->gamma * w[0][i];
    newton_solve(&run->linear, h / of->gamma, 0.0, r, rest[0]);
    for (int k = 0; 2 * k + 1 < of->stages; k++) {
        Complex rhs[N_Y], u[N_Y];
        const double re = of->pair[k][0], im = of->pair[k][1], *x = w[2 * k + 1], *y = w[2 * k + 2];
        for (int i = 0; i < N_Y; i++) {
            __real__ rhs[i] = rest[2 * k + 1][i] - (re * x[i] - im * y[i]);
            __imag__ rhs[i] = rest[2 * k + 2][i] - (re * y[i] + im * x[i]);
        }
        newton_solve_complex(&pairs[k], eta[k], 0.0, rhs, u);
        for (int i = 0; i < N_Y; i++) {
            rest[2 * k + 1][i] = __real__ u[i];
            rest[2 * k + 2][i] = __imag__ u[i];
        }
    }
    for (int s = 0; s < of->stages; s++)
        for (int i = 0; i < N_Y; i++) {
            change[s][i] = 0.0;
            for (int k = 0; k < of->stages; k++)
                change[s][i] += of->to_stages[s][k] * rest[k][i];
        }
}

/* The stages of a step, in step->k. *lost: they were not found. */
static int radau_stages(Run *run, const Radau *of, double h, const ComplexLinear *pairs, const Complex *eta,
    const Parameters *p, Step *step, int *lost)
{
    double y[N_Y], f[RADAU_STAGES][N_Y], change[RADAU_STAGES][N_Y], before = 0.0;
    double falls = run->now.falls > 0.0 ? run->now.falls : 0.5;
    double (*z)[N_Y] = step->k;
    *lost = 0;
    for (int pass = 0; pass < RADAU_PATIENCE; pass++) {
        forget_stages(step);
        for (int s = 0; s < of->stages; s++) {
            Aside aside;
            for (int i = 0; i < N_Y; i++)
                y[i] = run->y[i] + z[s][i];
            const int status = rates(run, run->t + of->node[s] * h, y, p, f[s], &aside);
            if (status)
                return status;
            note_state(step, y);
            note_stage(run, step, &aside, of->node[s]);
        }
        radau_change(run, of, h, pairs, eta, f, z, change);
        double way = 0.0;
        for (int s = 0; s < of->stages; s++)
            for (int i = 0; i < N_Y; i++) {
                z[s][i] += change[s][i];
                way = max_of(fabs(change[s][i]) * run->weight[i], way);
            }
        if (!isfinite(way))
            return NOT_FINITE;
        if (pass > 0) {
            falls = way / before;
            if (!(falls < 0.9))
                break;
        }
        before = way;
        if (falls / (1.0 - falls) * way <= RADAU_ENOUGH) {
            run->now.falls = max_of(falls, 1e-3);
            return 0;
        }
    }
    *lost = 1;
    return 0;
}

static int radau_try(Run *run, const Radau *of, double h, const Parameters *p, Step *step)
{
    const double hg = h / of->gamma, by = of->gamma / h;
    double r[N_Y], u[N_Y], bend[N_Y], change = 0.0, way = 0.0;
    ComplexLinear pairs[RADAU_PAIRS];
    Complex eta[RADAU_PAIRS];
    int lost;
    step->t = run->t, step->h = h, step->dense_ready = 0;
    int status = radau_factor(run, of, h, pairs, eta, p);
    if (status)
        return status;
    radau_guess(run, of, h, step->k);
    status = radau_stages(run, of, h, pairs, eta, p, step, &lost);
    if (status)
        return status;
    if (lost) {
        step->error = 16.0;
        return 0;
    }
    step->error = 0.0;
    for (int i = 0; i < N_Y; i++) {
        bend[i] = 0.0;
        for (int s = 0; s < of->stages; s++)
            bend[i] += of->error[s] * step->k[s][i];
        bend[i] *= by;
        r[i] = run->dy[i] + bend[i];
        step->y[i] = run->y[i] + step->k[of->stages - 1][i];
    }
    newton_solve(&run->linear, hg, 0.0, r, u);
    for (int i = 0; i < 2 * N_X; i++) {
        change = max_of(fabs(by * u[i] - r[i]) * run->weight[i], change);
        way = max_of(fabs(u[i]) * run->weight[i], way);
    }
    run->stability = way > 0.0 ? h * change / way : 0.0;
    for (int i = 0; i < N_Y; i++)
        step->error = max_of(fabs(u[i]) * run->weight[i], step->error);
    if (step->error > run->accept && isfinite(step->error)) { /* once more: less of what is stiff and not wrong */
        double y[N_Y];
        Aside aside;
        for (int i = 0; i < N_Y; i++)
            y[i] = run->y[i] + u[i];
        status = rates(run, run->t, y, p, r, &aside);
        if (status)
            return status;
        for (int i = 0; i < N_Y; i++)
            r[i] += bend[i];
        newton_solve(&run->linear, hg, 0.0, r, u);
        step->error = 0.0;
        for (int i = 0; i < N_Y; i++)
            step->error = max_of(fabs(u[i]) * run->weight[i], step->error);
    }
    if (is_odd(run, step->error))
        return NOT_FINITE;
    return is_refused(run, step) ? 0 : finish_step(run, step, p);
}

/*
 * Positions by Hermite's quintic through both ends, where accelerations are known too; velocities are its derivative, or
 * as all else the collocation polynomial.
 */
static int radau_dense(Run *run, const Radau *of, Step *step)
{
    const double h = step->h;
    double (*d)[N_Y] = step->dense;
    for (int i = 0; i < N_Y; i++)
        for (int k = 0; k < RADAU_STAGES; k++) {
            d[k][i] = 0.0;
            for (int s = 0; s < of->stages && k < of->stages; s++)
                d[k][i] += of->dense[k][s] * (s < of->stages - 1 ? step->k[s][i] : step->y[i] - run->y[i]);
        }
    for (int i = 0; i < N_X; i++) {
        const int v = N_X + i;
        const double from = h * h * run->dy[v], to = h * h * step->dy[v];
        d[0][i] = step->y[i] - run->y[i];
        d[1][i] = h * run->y[v] - d[0][i];
        d[2][i] = d[0][i] - d[1][i] - h * step->y[v];
        d[3][i] = 0.5 * from + d[1][i] - d[2][i];
        d[4][i] = 0.5 * to + d[1][i] + 2.0 * d[2][i] - d[3][i];
        if (of->stages > 3)
            continue;
        d[0][v] = step->y[v] - run->y[v];
        d[1][v] = h * run->dy[v] - d[0][v];
        d[2][v] = d[0][v] - d[1][v] - h * step->dy[v];
        d[3][v] = 5.0 * d[4][i] / h;
    }
    return 0;
}

static void radau_interpolate(const Run *run, const Step *step, double s, double *y)
{
    const double (*d)[N_Y] = (const double (*)[N_Y])step->dense, r = 1.0 - s;
    for (int i = 0; i < N_Y; i++)
        y[i] = run->y[i] + s * (d[0][i] + r * (d[1][i] + s * (d[2][i] + r * (d[3][i] + s * d[4][i]))));
}

static const double radau5_heard[] = {0.0, 0.15505102572168219, 0.64494897427831781, 1.0};

static int radau5_try(Run *run, double h, const Parameters *p, Step *step)
{
    return radau_try(run, &RADAU5, h, p, step);
}

static int radau5_dense(Run *run, const Parameters *p, Step *step) { return (void)p, radau_dense(run, &RADAU5, step); }

static const Method radau5 = {.name = "radau5", .try = radau5_try, .dense = radau5_dense,
    .interpolate = radau_interpolate, .power = 0.25, .stiff = 1, .unstable = INFINITY, .bounded = INFINITY,
    .degree = 5, .turned = 0xA, .heard = radau5_heard, .n_heard = COUNT_OF(radau5_heard)};

static const double radau9_heard[] = {0.0, 0.057104196114517682, 0.27684301363812383, 0.58359043236891682, 0.86024013565621945, 1.0};

static int radau9_try(Run *run, double h, const Parameters *p, Step *step)
{
    return radau_try(run, &RADAU9, h, p, step);
}

static int radau9_dense(Run *run, const Parameters *p, Step *step) { return (void)p, radau_dense(run, &RADAU9, step); }

static const Method radau9 = {.name = "radau9", .try = radau9_try, .dense = radau9_dense,
    .interpolate = radau_interpolate, .power = 0.16666666666666666, .stiff = 1, .unstable = INFINITY, .bounded = INFINITY,
    .degree = 5, .turned = 0xA, .heard = radau9_heard, .n_heard = COUNT_OF(radau9_heard)};
