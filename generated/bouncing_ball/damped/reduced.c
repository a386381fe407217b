/*
 * Coordinates all_q (N_Q) and velocities all_v of all bodies at tree coordinates q and rates v.
 */
void expand(const double t, const double *q, const double *v, const Parameters *p, double *all_q, double *all_v)
{
    (void)t, (void)p;
    /* coordinates, velocities, time */
    const double ball_x = q[0];
    const double ball_x_rate = v[0];
    const double ball_y = q[1];
    const double ball_y_rate = v[1];
    const double ball_theta = q[2];
    const double ball_omega = v[2];

    /* bodies */
    all_q[0] = ball_x;
    all_v[0] = ball_x_rate;
    all_q[1] = ball_y;
    all_v[1] = ball_y_rate;
    all_q[2] = ball_theta;
    all_v[2] = ball_omega;
}

/*
 * Tree coordinates s and their rates of an absolute state; what the tree does not have is not looked at.
 */
void reduce_state(const double t, const double *q, const double *v, const Parameters *p, double *s, double *s_rate)
{
    (void)t, (void)p;
    /* coordinates, velocities, time */
    const double ball_x = q[0];
    const double ball_y = q[1];
    const double ball_theta = q[2];
    const double ball_vx = v[0];
    const double ball_vy = v[1];
    const double ball_omega = v[2];

    /* tree coordinates */
    s[0] = ball_x;  /* ball.x */
    s_rate[0] = ball_vx;
    s[1] = ball_y;  /* ball.y */
    s_rate[1] = ball_vy;
    s[2] = ball_theta;  /* ball */
    s_rate[2] = ball_omega;
}

/*
 * Phi of the loop closures in tree coordinates; m and rad.
 */
void closures(const double t, const double *q, const Parameters *p, double *out)
{
    (void)t, (void)q, (void)p, (void)out;
    /* this scene has none */
}

/*
 * Its rate Phi_q v - nu.
 */
void closure_rates(const double t, const double *q, const double *v, const Parameters *p, double *out)
{
    (void)t, (void)q, (void)v, (void)p, (void)out;
    /* this scene has none */
}

/*
 * Accelerations a of the tree's coordinates q, and the closures' multipliers in `aside`:
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma] with M, Phi_q, g in these coordinates; drifts are projected away.
 * Returns 0, or the number of the pivot that vanished where the rows contradict each other.
 */
int reduced_dynamics(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    double *a, Aside *aside)
{
    (void)t;
    /* corners: the sides that are held, if any */
    const double *const side = memory->held ? memory->side : NULL;
    double *const g = aside->g;

    /* coordinates, velocities, time */
    const double ball_x = q[0];
    const double ball_x_rate = v[0];
    const double ball_y = q[1];
    const double ball_y_rate = v[1];
    const double ball_omega = v[2];

    /* clearance joint fall */
    const double e_fall_x = ball_x;
    const double e_fall_y = ball_y;
    const double edot_fall_x = ball_x_rate;
    const double edot_fall_y = ball_y_rate;
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

/*
 * The smallest x (n), measured by M, with Phi_q x = r; Newton's step, velocities. r holds all rows of
 * the closed linkage, redundant ones are not looked at.
 * Returns 0, or the number of the pivot that vanished.
 */
int reduced_project(const double t, const double *q, const double *r, const Parameters *p, double *x)
{
    (void)t, (void)q, (void)r, (void)p;
    /* backward substitution */
    const double step_acceleration_ball_theta = 0.0;
    const double step_acceleration_ball_y = 0.0;
    const double step_acceleration_ball_x = 0.0;

    /* results */
    x[0] = step_acceleration_ball_x;
    x[1] = step_acceleration_ball_y;
    x[2] = step_acceleration_ball_theta;
    return 0;
}
