/*
 * Accelerations a (n) and multipliers in `aside` at a state:
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma - 2 alpha Phi_dot - beta^2 Phi]   (physics.md, section 1).
 * Returns 0, or the number of the pivot that vanished where the rows contradict each other.
 */
int dynamics(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p, double *a,
    Aside *aside)
{
    (void)t;
    /* corners: the sides that are held, if any */
    const double *const side = memory->held ? memory->side : NULL;
    double *const g = aside->g;

    /* coordinates, velocities, time */
    const double ball_x = q[0];
    const double ball_y = q[1];
    const double ball_vx = v[0];
    const double ball_vy = v[1];
    const double ball_omega = v[2];

    /* clearance joint fall */
    const double e_fall_x = ball_x;
    const double e_fall_y = ball_y;
    const double edot_fall_x = ball_vx;
    const double edot_fall_y = ball_vy;
    clearance_fall(e_fall_x, e_fall_y, edot_fall_x, edot_fall_y, 0, ball_omega, &memory->latch[0], p, side, g,
        &aside->clearance[0]);
    const double F_fall_x = aside->clearance[0].Fx;
    const double F_fall_y = aside->clearance[0].Fy;
    const double M_fall_second = aside->clearance[0].moment_second;
    aside->clearance[0].power = F_fall_x*edot_fall_x + F_fall_y*edot_fall_y + M_fall_second*ball_omega;

    /* forward substitution */
    const double z_ball_y = F_fall_y + p->weight_ball_y;

    /* backward substitution */
    const double acceleration_ball_theta = M_fall_second*p->inverse_ball_inertia;
    const double acceleration_ball_y = p->inverse_ball_mass*z_ball_y;
    const double acceleration_ball_x = F_fall_x*p->inverse_ball_mass;

    /* results */
    a[0] = acceleration_ball_x;
    a[1] = acceleration_ball_y;
    a[2] = acceleration_ball_theta;
    aside->power[0] = 0.0;
    aside->power[1] = 0.0;
    aside->power[2] = aside->clearance[0].power;
    return 0;
}
