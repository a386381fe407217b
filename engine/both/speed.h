/* Update the largest speeds of lengths and angles. */
static void update_speeds(IntegratorOf *run)
{
    for (int k = 0; k < N_X; k++)
        run->norm.speed[is_angle[k]] = real_max(run->norm.speed[is_angle[k]], real_abs(run->y[N_X + k]));
}
