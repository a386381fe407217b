/* What is integrated: the state equation itself, in absolute coordinates. */
int motion_here(double t, const double *y, Memory *memory, const Parameters *p, double *dy, Aside *aside)
{
    return state_equation(t, y, memory, p, dy, aside);
}

int play_here(double t, const double *y, Memory *memory, const Parameters *p, Aside *aside)
{
    double dy[N_Y];
    return state_equation(t, y, memory, p, dy, aside);
}

/* The state of all bodies, (q, v, work). */
void to_absolute(double t, const double *y, const Memory *memory, const Parameters *p, double *all)
{
    (void)t, (void)memory, (void)p;
    for (int k = 0; k < N_S; k++)
        all[k] = y[k];
}

void from_absolute(double t, const double *all, Memory *memory, const Parameters *p, double *y)
{
    (void)t, (void)memory, (void)p;
    for (int k = 0; k < N_S; k++)
        y[k] = all[k];
}

int accept_state(double t, const double *y, Memory *memory, const Parameters *p, const Aside *aside, double *phi_max,
    double *phi_dot_max)
{
    (void)t, (void)y, (void)memory, (void)p;
    for (int r = 0; r < N_ROWS; r++) {
        *phi_max = max_of(fabs(aside->phi[r]), *phi_max);
        *phi_dot_max = max_of(fabs(aside->phi_dot[r]), *phi_dot_max);
    }
    return 0;
}
