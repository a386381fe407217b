/* Largest speeds of a run so far, of lengths and of angles, which scale the tolerances of velocities. */

/* Update norm.speed, the largest speeds of lengths [0] and of angles [1] so far, by the velocities of a run. */
static void update_speeds(IntegratorOf *run)
{
    for (int k = 0; k < N_X; k++)
        run->norm.speed[is_angle[k]] = real_max(run->norm.speed[is_angle[k]], real_abs(run->y[N_X + k]));
}
