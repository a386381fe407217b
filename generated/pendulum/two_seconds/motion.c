/* What is integrated: coordinates of the tree, their rates, works. */
static int motion(double t, const double *y, const Memory *memory, const Parameters *p, double *dy, Aside *aside)
{
    const int status = reduced_dynamics(t, y, y + N_X, memory, p, dy + N_X, aside);
    for (int k = 0; k < N_X; k++)
        dy[k] = y[N_X + k];
    for (int k = 0; k < N_WORK; k++)
        dy[2 * N_X + k] = aside->power[k];
    return status;
}

/* The state of all bodies, (q, v, work). */
static void to_absolute(double t, const double *y, const Memory *memory, const Parameters *p, double *all)
{
    (void)memory;
    expand(t, y, y + N_X, p, all, all + N_Q);
    for (int k = 0; k < N_WORK; k++)
        all[2 * N_Q + k] = y[2 * N_X + k];
}

static void from_absolute(double t, const double *all, Memory *memory, const Parameters *p, double *y)
{
    (void)memory;
    reduce_state(t, all, all + N_Q, p, y, y + N_X);
    for (int k = 0; k < N_WORK; k++)
        y[2 * N_X + k] = all[2 * N_Q + k];
}
