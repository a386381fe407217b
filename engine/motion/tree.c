/*
 * What is integrated where bodies form a tree: its coordinates, their rates, works.
 */
#include "../both/one.h"

#define IN_BOTH
#define REDUCED_DYNAMICS reduced_dynamics
#define CLOSURES(t, q, memory, p, phi) closures(t, q, p, phi)
#define CLOSURE_RATES(t, q, v, memory, p, phi_dot) closure_rates(t, q, v, p, phi_dot)
#include "../both/motion.h"

/* The state of all bodies, (q, v, work). */
void to_absolute(double t, const double *y, const Memory *memory, const Parameters *p, double *all)
{
    (void)memory;
    expand(t, y, y + N_X, p, all, all + N_Q);
    for (int k = 0; k < N_WORK; k++)
        all[2 * N_Q + k] = y[2 * N_X + k];
}

void from_absolute(double t, const double *all, Memory *memory, const Parameters *p, double *y)
{
    (void)memory;
    reduce_state(t, all, all + N_Q, p, y, y + N_X);
    for (int k = 0; k < N_WORK; k++)
        y[2 * N_X + k] = all[2 * N_Q + k];
}

int closing_of_state(double t, const double *y, Memory *memory, const Parameters *p, double *dq, double *dv,
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
