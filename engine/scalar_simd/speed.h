/* Largest speeds of a run so far, of lengths and of angles, which scale the tolerances of velocities. */

/* Update the largest speeds of lengths and of angles so far with the velocities of a run. */
static void update_speeds(IntegratorOf *run)
{
    for (int k = 0; k < N_X; k++)
        run->norm.speed[is_angle[k]] = real_max(run->norm.speed[is_angle[k]], real_abs(run->y[N_X + k]));
}
