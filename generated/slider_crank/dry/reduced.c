/*
 * Coordinates all_q (N_Q) and velocities all_v of all bodies at tree coordinates q and rates v.
 */
void expand(const double t, const double *q, const double *v, const Parameters *p, double *all_q, double *all_v)
{
    /* coordinates, velocities, time */
    const double cylinder_slide = q[0];
    const double cylinder_slide_rate = v[0];
    const double rod_theta = q[1];
    const double rod_omega = v[1];

    /* directions, arms, drives */
    const double motor_value = p->omega*t;
    const Four angles_0 = {motor_value, rod_theta, rod_theta, rod_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank = cosines_0[0];
    const double sin_theta_crank = sines_0[0];
    const double cos_theta_rod = cosines_0[1];
    const double sin_theta_rod = sines_0[1];
    const double motor_rate = p->omega;
    const double span_crank_com_x = cos_theta_crank*p->crank_head_s_x;
    const double span_crank_com_y = p->crank_head_s_x*sin_theta_crank;
    const double crank_vx = -motor_rate*span_crank_com_y;
    const double crank_vy = motor_rate*span_crank_com_x;
    const double slider_y = 0.0;
    const double slider_vy = 0.0;
    const double slider_theta = 0.0;
    const double slider_omega = 0.0;
    const double span_crank_head_x = cos_theta_crank*p->crank_head_span_x;
    const double span_crank_head_y = p->crank_head_span_x*sin_theta_crank;
    const double crank_head_vx = -motor_rate*span_crank_head_y;
    const double crank_head_vy = motor_rate*span_crank_head_x;
    const double span_rod_com_x = cos_theta_rod*p->rod_head_s_x;
    const double span_rod_com_y = p->rod_head_s_x*sin_theta_rod;
    const double rod_x = span_crank_head_x + span_rod_com_x;
    const double rod_vx = crank_head_vx - rod_omega*span_rod_com_y;
    const double rod_y = span_crank_head_y + span_rod_com_y;
    const double rod_vy = crank_head_vy + rod_omega*span_rod_com_x;

    /* bodies */
    all_q[0] = span_crank_com_x;
    all_v[0] = crank_vx;
    all_q[1] = span_crank_com_y;
    all_v[1] = crank_vy;
    all_q[2] = motor_value;
    all_v[2] = motor_rate;
    all_q[3] = rod_x;
    all_v[3] = rod_vx;
    all_q[4] = rod_y;
    all_v[4] = rod_vy;
    all_q[5] = rod_theta;
    all_v[5] = rod_omega;
    all_q[6] = cylinder_slide;
    all_v[6] = cylinder_slide_rate;
    all_q[7] = slider_y;
    all_v[7] = slider_vy;
    all_q[8] = slider_theta;
    all_v[8] = slider_omega;
}

/*
 * Tree coordinates s and their rates of an absolute state; what the tree does not have is not looked at.
 */
void reduce_state(const double t, const double *q, const double *v, const Parameters *p, double *s, double *s_rate)
{
    (void)t, (void)p;
    /* coordinates, velocities, time */
    const double rod_theta = q[5];
    const double rod_omega = v[5];
    const double slider_x = q[6];
    const double slider_vx = v[6];

    /* tree coordinates */
    s[0] = slider_x;  /* cylinder.slide */
    s_rate[0] = slider_vx;
    s[1] = rod_theta;  /* rod */
    s_rate[1] = rod_omega;
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
    /* corners: the sides that are held, if any */
    const double *const side = memory->held ? memory->side : NULL;
    double *const g = aside->g;

    /* coordinates, velocities, time */
    const double cylinder_slide = q[0];
    const double cylinder_slide_rate = v[0];
    const double rod_theta = q[1];
    const double rod_omega = v[1];

    /* directions, arms, drives */
    const double motor_value = p->omega*t;
    const Four angles_0 = {motor_value, rod_theta, rod_theta, rod_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank = cosines_0[0];
    const double sin_theta_crank = sines_0[0];
    const double cos_theta_rod = cosines_0[1];
    const double sin_theta_rod = sines_0[1];
    const double motor_rate = p->omega;
    const double motor_acceleration = 0.0;
    const double slider_omega = 0.0;
    const double span_crank_head_x = cos_theta_crank*p->crank_head_span_x;
    const double span_crank_head_y = p->crank_head_span_x*sin_theta_crank;
    const double crank_head_vx = -motor_rate*span_crank_head_y;
    const double crank_head_vy = motor_rate*span_crank_head_x;
    const double span_rod_head_x = cos_theta_rod*p->rod_head_span_x;
    const double span_rod_head_y = p->rod_head_span_x*sin_theta_rod;
    const double rod_head_x = span_crank_head_x + span_rod_head_x;
    const double rod_head_vx = crank_head_vx - rod_omega*span_rod_head_y;
    const double rod_head_y = span_crank_head_y + span_rod_head_y;
    const double rod_head_vy = crank_head_vy + rod_omega*span_rod_head_x;
    const double cos_rod_less_crank = cos_theta_crank*cos_theta_rod + sin_theta_crank*sin_theta_rod;
    const double sin_rod_less_crank = cos_theta_crank*sin_theta_rod - cos_theta_rod*sin_theta_crank;
    const double dot_crank_rod = cos_rod_less_crank*p->inertia_crank_rod;
    const double cross_crank_rod = p->inertia_crank_rod*sin_rod_less_crank;

    /* clearance joint wristpin */
    const double e_wristpin_x = cylinder_slide - rod_head_x;
    const double e_wristpin_y = -rod_head_y;
    const double edot_wristpin_x = cylinder_slide_rate - rod_head_vx;
    const double edot_wristpin_y = -rod_head_vy;
    clearance_wristpin(e_wristpin_x, e_wristpin_y, edot_wristpin_x, edot_wristpin_y, rod_omega, slider_omega,
        &memory->latch[0], p, side, g, &aside->clearance[0]);
    const double F_wristpin_x = aside->clearance[0].Fx;
    const double F_wristpin_y = aside->clearance[0].Fy;
    const double M_wristpin_first = aside->clearance[0].moment_first;
    const double M_wristpin_second = aside->clearance[0].moment_second;
    aside->clearance[0].power = F_wristpin_x*edot_wristpin_x + F_wristpin_y*edot_wristpin_y
        + M_wristpin_first*rod_omega + M_wristpin_second*slider_omega;

    /* forward substitution */
    const double z_rod_theta = F_wristpin_x*span_rod_head_y - F_wristpin_y*span_rod_head_x + M_wristpin_first
        - cross_crank_rod*(motor_rate * motor_rate) - dot_crank_rod*motor_acceleration;

    /* backward substitution */
    const double acceleration_rod_theta = p->inverse_mass_rod_rod*z_rod_theta;
    const double acceleration_cylinder_slide = F_wristpin_x*p->inverse_slider_mass;

    /* results */
    a[0] = acceleration_cylinder_slide;
    a[1] = acceleration_rod_theta;
    aside->power[0] = motor_rate*(-F_wristpin_x*span_crank_head_y + F_wristpin_y*span_crank_head_x + a[1]*dot_crank_rod
        - cross_crank_rod*(rod_omega * rod_omega) + p->mass_motor_motor*motor_acceleration);
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
    const double step_acceleration_rod_theta = 0.0;
    const double step_acceleration_cylinder_slide = 0.0;

    /* results */
    x[0] = step_acceleration_cylinder_slide;
    x[1] = step_acceleration_rod_theta;
    return 0;
}
