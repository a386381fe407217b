/*
 * Where no chains are driven the kernels read the state as it is: q, then v.
 */
int closing_here(double t, const double *y, Memory *memory, const Parameters *p, double *dq, double *dv,
    double *worst)
{
    return closing_step(t, y, y + N_X, memory, p, dq, dv, worst);
}

int linearize_state(double t, const double *y, Memory *memory, const Parameters *p, const double *a,
    const Aside *aside, Linear *lin)
{
    linearize(t, y, y + N_X, memory, p, a, aside, lin);
    return 0;
}
