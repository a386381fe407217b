/* Where no rows are dependent for a moment, or what is held changes: the motion as it is computed at a state itself. */
int motion(double t, const double *y, Memory *memory, const Parameters *p, double *dy, Aside *aside)
{
    return motion_here(t, y, memory, p, dy, aside);
}

int closing_of_state(double t, const double *y, Memory *memory, const Parameters *p, double *dq, double *dv,
    double *worst)
{
    return closing_here(t, y, memory, p, dq, dv, worst);
}
