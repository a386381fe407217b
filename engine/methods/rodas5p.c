/*
 * Rodas5P: a Rosenbrock method of order 5 with the exact Jacobian, L-stable, dense output of order 4.
 * G. Steinebach, BIT 63:27 (2023). (1/(h gamma) - J) u_i = f(y + sum a_ij u_j) + sum c_ij/h u_j + d_i h f_t.
 */

/*
 * Factorize Newton's matrix 1 - hg J at the run's state, hg = h gamma in s, after linearizing the equations there once.
 * Return 0, the status of the linearization, or NOT_FINITE if the matrix is singular. The linearization is stored until
 * discard_linearization(), and counts once, also if a lane computed it before.
 */
static int factor_newton_matrix(Integrator *run, double hg, const Parameters *p)
{
    if (run->newton.ready != IN_RUN) {
        copy_internal_states(&run->discrete, run->y);
        const int status = linearize_state(run->t, run->y, &run->discrete, p, run->dy + N_X, &run->rhs,
            &run->newton.linear);
        if (status)
            return status;
        if (!run->newton.ready)
            count_jacobian(run);
        run->newton.ready = IN_RUN;
    }
    return newton_factor(hg, &run->newton.linear) ? NOT_FINITE : 0;
}

/* Discard the stored linearization of a run, because its state changes. */
static void discard_linearization(Integrator *run) { run->newton.ready = 0; }

#include "../scalar_simd/rodas5p.h"

/* Fractions of a step, ascending, at which the method evaluates the equations. */
static const double rodas5p_error_nodes[] = {0.0, 0.4095798393397535, 0.4288403609558664, 0.6358126895828704,
    0.9769306725060716, 1.0};

/* Weights of the stages for h times the rates of the dense output at the beginning of a step. */
#define RODAS5P_BEGINS 25.948786856663858, -2.5579724845846235, 10.433815404888879, -2.3679251022685204, \
    0.524948541321073, 1.1241088310450404, 0.4272876194431874, -0.17202221070155493

/* Compute the dense output of order 4 of a step of rodas5p from its eight stages. Return 0. */
static int rodas5p_compute_dense_output(Integrator *run, const Parameters *p, Step *step)
{
    (void)p;
    static const double b[] = {RODAS5P_BEGINS};
    double (*const k)[N_Y] = step->k;
    for (int i = 0; i < N_Y; i++) {
        step->dense[0][i] = step->y[i] - run->y[i];
        step->dense[1][i] = b[0] * k[0][i] + b[1] * k[1][i] + b[2] * k[2][i] + b[3] * k[3][i] + b[4] * k[4][i]
            + b[5] * k[5][i] + b[6] * k[6][i] + b[7] * k[7][i];
        step->dense[2][i] = -9.91568850695171 * k[0][i] - 0.9689944594115154 * k[1][i] + 3.0438037242978453 * k[2][i]
            - 24.495224566215796 * k[3][i] + 20.176138334709044 * k[4][i] + 15.98066361424651 * k[5][i]
            - 6.789040303419874 * k[6][i] - 6.710236069923372 * k[7][i];
        step->dense[3][i] = 11.419903575922262 * k[0][i] + 2.8879645146136994 * k[1][i] + 72.92137995996029 * k[2][i]
            + 80.12511834622643 * k[3][i] - 52.072871366152654 * k[4][i] - 59.78993625266729 * k[5][i]
            - 0.15582684282751913 * k[6][i] + 4.883087185713722 * k[7][i];
    }
    return 0;
}

/* Compute the state y (N_Y) at fraction s of a step of rodas5p from its dense output, which must have been computed. */
static void rodas5p_interpolate(const Integrator *run, const Step *step, double s, double *y)
{
    const double (*d)[N_Y] = (const double (*)[N_Y])step->dense;
    for (int i = 0; i < N_Y; i++)
        y[i] = run->y[i] + s * (d[0][i] + (1.0 - s) * (d[1][i] + s * (d[2][i] + s * d[3][i])));
}

/* Rates of the dense output of rodas5p at the beginning of a step. */
static const EndRateWeights rodas5p_end_rates = {
    .begin = {RODAS5P_BEGINS}, .n_begin = RODAS5P_STAGES, .begin_weight_of_end = 1.0};

/* The Rosenbrock method rodas5p. */
static const Method rodas5p = {.name = "rodas5p",
    .try = rodas5p_try_step,
    .dense = rodas5p_compute_dense_output,
    .interpolate = rodas5p_interpolate,
    .power = 0.2,
    .stiff = 1,
    .lane_method = METHOD_RODAS5P,
    .rejected_h_rho = INFINITY,
    .limiting_h_rho = INFINITY,
    .stages = RODAS5P_STAGES,
    .degree = 4,
    .reversed = 0x2,
    .error_nodes = rodas5p_error_nodes,
    .n_error_nodes = COUNT_OF(rodas5p_error_nodes),
    .max_error_fraction = 0.5,
    .end_rates = &rodas5p_end_rates};
