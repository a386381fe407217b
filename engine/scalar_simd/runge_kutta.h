/*
 * A trial step of an explicit Runge-Kutta method from its Butcher tableau, with its error and dense output. The
 * coefficients are in methods/runge_kutta.c. The dense output is y0 + s (d0 + (1 - s) (d1 + s (d2 + (1 - s) d3))). Here
 * d0 to d2 are Hermite's cubic through both ends with their rates.
 */
enum { RK4_STAGES = 4, DOPRI5_STAGES = 6, MAX_STAGES = 6 };

/* The Butcher tableau of an explicit Runge-Kutta method. */
typedef struct Tableau {
    int stages, estimates; /* estimates: whether there is an error estimate */
    double node[MAX_STAGES], a[MAX_STAGES][MAX_STAGES], weight[MAX_STAGES];
    double error[MAX_STAGES + 1];   /* of all stages and of the end: differences from the weights of lower order */
    double dense_weights[MAX_STAGES + 1]; /* of d3 / h; 0: the dense output is the cubic */
} Tableau;

/* The classical method of order 4: W. Kutta, Z. Math. Phys. 46 (1901), 435. */
static const Tableau classical = {.stages = RK4_STAGES, .node = {0.0, 0.5, 0.5, 1.0},
    .a = {{0.0}, {0.5}, {0.0, 0.5}, {0.0, 0.0, 1.0}}, .weight = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0}};

/*
 * Order 5 with an estimate of order 4: J. R. Dormand, P. J. Prince, J. Comput. Appl. Math. 6 (1980), 19-26. Its
 * interpolant is of order 4: E. Hairer, S. P. Norsett, G. Wanner, Solving ODEs I (1993), section II.6, code DOPRI5.
 */
static const Tableau dormand_prince = {.stages = DOPRI5_STAGES, .estimates = 1,
    .node = {0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0},
    .a = {{0.0}, {1.0 / 5.0}, {3.0 / 40.0, 9.0 / 40.0}, {44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0},
        {19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0},
        {9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0}},
    .weight = {35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0},
    .error = {71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0},
    .dense_weights = {-12715105075.0 / 11282082432.0, 0.0, 87487479700.0 / 32700410799.0, -10690763975.0 / 1880347072.0,
        701980252875.0 / 199316789632.0, -1453857185.0 / 822651844.0, 69997945.0 / 29380423.0}};

/*
 * Try a step of length h (s) by a Butcher tableau: stages, end and, if the tableau has an estimate, its error norm.
 * Return 0 or a status. The first stage has the rates at the end of the previous step (FSAL). A step that is accepted
 * also stores its stiffness estimate.
 */
static int runge_kutta_try_step(IntegratorOf *run, const Tableau *tableau, Real h, const ParametersOf *p, StepOf *step)
{
    Real y[N_Y], error = make_real(0.0);
    RhsOutputsOf rhs;
    step->t = run->t, step->h = h, step->dense_ready = 0, step->error = error;
    discard_stages(step);
    for (int i = 0; i < N_Y; i++)
        step->k[0][i] = run->dy[i];
    for (int s = 1; s <= tableau->stages; s++) {
        const double *const a = s < tableau->stages ? tableau->a[s] : tableau->weight;
        Real *const target = s < tableau->stages ? y : step->y;
        for (int i = 0; i < N_Y; i++) {
            Real slope = a[0] * step->k[0][i];
            for (int j = 1; j < s; j++)
                slope += a[j] * step->k[j][i];
            target[i] = run->y[i] + h * slope;
        }
        if (s == tableau->stages)
            break;
        const int status = evaluate_run_rhs(run, run->t + tableau->node[s] * h, y, p, step->k[s], &rhs);
        if (status)
            return status;
        record_stage(run, step, &rhs, tableau->node[s]);
        extend_stage_range(step, y);
    }
    const int status = finish_step(run, step, p);
    if (status)
        return status;
    for (int i = 0; i < N_Y && tableau->estimates; i++) {
        Real slope = tableau->error[tableau->stages] * step->dy[i];
        for (int j = 0; j < tableau->stages; j++)
            slope += tableau->error[j] * step->k[j][i];
        error = real_max(real_abs(h * slope) * run->norm.weight[i], error);
    }
    step->error = real_max(step->error, error);
    if (reject_nonfinite_error(run, step->error))
        return NOT_FINITE;
    if (decide_step_rejection(run, step))
        return 0;
    estimate_stiffness_at_end(run, step, h, y, step->k[tableau->stages - 1]);
    return 0;
}

/*
 * Compute the four coefficients step->dense of the dense output from the stages and both ends of a step. The fourth is
 * 0 for methods whose interpolant is Hermite's cubic.
 */
static inline void runge_kutta_compute_dense_output(const IntegratorOf *run, const Tableau *tableau, StepOf *step)
{
    for (int i = 0; i < N_Y; i++) {
        const Real change = step->y[i] - run->y[i];
        Real fourth = tableau->dense_weights[tableau->stages] * step->dy[i];
        for (int j = 0; j < tableau->stages; j++)
            fourth += tableau->dense_weights[j] * step->k[j][i];
        step->dense[0][i] = change;
        step->dense[1][i] = step->h * run->dy[i] - change;
        step->dense[2][i] = 2.0 * change - step->h * (step->dy[i] + run->dy[i]);
        step->dense[3][i] = step->h * fourth;
    }
}
