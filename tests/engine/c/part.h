/*
 * The engine on the equation x'' = -x, with a joint whose penetration is x - offset: a test calls functions of a part.
 * What else a scene defines is declared but not defined, and no test calls it.
 */
#include "model.h"
#include "engine/engine.c"
#include <stdio.h>

#pragma weak compute_absolute_accelerations
#pragma weak accept_state
#pragma weak constraints
#pragma weak has_drive_jump
#pragma weak convert_absolute_to_integrated
#pragma weak jacobian
#pragma weak linearize_state
#pragma weak mass_matrix
#pragma weak evaluate_rhs
#pragma weak newton_factor
#pragma weak newton_solve
#pragma weak read_discrete_state
#pragma weak has_equal_start_parameters
#pragma weak start_values
#pragma weak convert_integrated_to_absolute
#pragma weak compute_velocity_residuals
#pragma weak velocity_rhs
#pragma weak gudgeon_audit_samples
#pragma weak gudgeon_evaluate
#pragma weak gudgeon_set_parameters

static int failures;
#define CHECK(mask) \
    ((mask) ? (void)0 : (void)(failures++, fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #mask)))
#define CLOSE(x, y, tolerance) (fabs((x) - (y)) <= (tolerance))

int compute_motion_rates(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dy, RhsOutputs *rhs)
{
    (void)t, (void)discrete;
    *rhs = (RhsOutputs){.clearance = {{.delta = y[0] - p->offset, .e = y[0], .deltadot = y[1]}}, .g = {NAN}};
    for (int k = 0; k < N_Y; k++)
        dy[k] = 0.0;
    dy[0] = y[1];
    dy[1] = -y[0];
    return 0;
}

int evaluate_contacts(double t, const double *y, DiscreteState *discrete, const Parameters *p, RhsOutputs *rhs)
{
    double dy[N_Y];
    return compute_motion_rates(t, y, discrete, p, dy, rhs);
}

double radial_clearance(const Parameters *p, int i) { return (void)i, p->radius; }
double max_valid_penetration(const Parameters *p, int i) { return (void)i, p->radius; }
double min_approach_speed(const Parameters *p, int i) { return (void)p, (void)i, 1e-3; }
