/*
 * What errors are measured by: speeds so far, and what follows from them.
 */
#include "speed.h"

/*
 * Tolerances of coordinates are given; those of velocities grow with the largest speed so far, those of works with
 * the energy that was turned over: nothing in the motion feels them, but a balance of energy does.
 */
static void weigh(RunOf *run)
{
    const Real lengths = run->speed[0] + run->speed_floor[0], angles = run->speed[1] + run->speed_floor[1];
    const Real of_speed[2] = {1.0 / lengths, 1.0 / angles};
    for (int k = 0; k < 2 * N_X; k++)
        run->weight[k] = k < N_X ? run->inverse_scale[k] : run->inverse_scale[k] * of_speed[is_angle[k - N_X]];
    for (int k = 2 * N_X; k < 2 * N_X + N_WORK; k++)
        run->weight[k] = 1.0 / (run->work_scale * run->turned_over);
    for (int k = FIRST_STATE; k < N_Y; k++) /* deflections, as lengths are */
        run->weight[k] = is_angle[0] ? run->inverse_scale[0] * (run->least[1] / run->least[0]) : run->inverse_scale[0];
}
