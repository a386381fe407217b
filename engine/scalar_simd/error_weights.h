/* Error weights: the reciprocal tolerances by which errors of a step are multiplied. */
#include "speed.h"

/*
 * Add the magnitudes of the works of an accepted step to the energy scale of a run, J, which scales the tolerance of
 * works. y: the state at the step's end. is_accepted: mask of the runs whose step is accepted. Called before run->y is
 * replaced.
 */
static void update_energy_scale(IntegratorOf *run, Mask is_accepted, const Real *y)
{
    for (int k = 2 * N_X; k < 2 * N_X + N_WORK; k++) {
        const Real energy = run->norm.energy_scale + real_abs(y[k] - run->y[k]);
        run->norm.energy_scale = select_value(is_accepted, energy, run->norm.energy_scale);
    }
}

/*
 * Update the error weights of a run, 1/tolerance, after an accepted step. Tolerances of coordinates are fixed. Those of
 * velocities grow with the largest speed of their kind. Those of works grow with the energy scale, because the motion
 * does not depend on them. Weights of internal states are set once (methods/begin.c).
 */
static void update_error_weights(IntegratorOf *run)
{
    NormOf *norm = &run->norm;
    const Real lengths = norm->speed[0] + norm->speed_floor[0], angles = norm->speed[1] + norm->speed_floor[1];
    const Real of_speed[2] = {1.0 / lengths, 1.0 / angles};
    for (int k = 0; k < 2 * N_X; k++)
        norm->weight[k] = k < N_X ? norm->inverse_scale[k] : norm->inverse_scale[k] * of_speed[is_angle[k - N_X]];
    for (int k = 2 * N_X; k < 2 * N_X + N_WORK; k++)
        norm->weight[k] = 1.0 / (norm->work_scale * norm->energy_scale);
}
