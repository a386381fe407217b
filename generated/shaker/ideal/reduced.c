/*
 * Coordinates all_q (N_Q) and velocities all_v of all bodies at tree coordinates q and rates v.
 */
void expand(const double t, const double *q, const double *v, const Parameters *p, double *all_q, double *all_v)
{
    /* coordinates, velocities, time */
    const double rod_theta = q[1];
    const double rod_omega = v[1];
    const double arm_theta = q[0];
    const double arm_omega = v[0];
    const double cos_theta_crank = q[2];
    const double sin_theta_crank = q[3];
    const double cos_theta_rod = q[4];
    const double sin_theta_rod = q[5];

    /* directions, arms, drives */
    const Four angles_0 = {arm_theta, arm_theta, arm_theta, arm_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_arm = cosines_0[0];
    const double sin_theta_arm = sines_0[0];
    const double motor_value = p->omega*t;
    const double motor_rate = p->omega;
    const double span_crank_com_x = cos_theta_crank*p->crank_head_s_x;
    const double span_crank_com_y = p->crank_head_s_x*sin_theta_crank;
    const double crank_vx = -motor_rate*span_crank_com_y;
    const double crank_vy = motor_rate*span_crank_com_x;
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
    const double span_rod_head_x = cos_theta_rod*p->rod_head_span_x;
    const double span_rod_head_y = p->rod_head_span_x*sin_theta_rod;
    const double rod_head_x = span_crank_head_x + span_rod_head_x;
    const double rod_head_vx = crank_head_vx - rod_omega*span_rod_head_y;
    const double rod_head_y = span_crank_head_y + span_rod_head_y;
    const double rod_head_vy = crank_head_vy + rod_omega*span_rod_head_x;
    const double table_theta = 0.0;
    const double table_omega = 0.0;
    const double table_top_y = rod_head_y + p->table_points_top_y;
    const double span_arm_com_x = p->arm_head_s_x*cos_theta_arm;
    const double span_arm_com_y = p->arm_head_s_x*sin_theta_arm;
    const double arm_x = rod_head_x + span_arm_com_x;
    const double arm_vx = -arm_omega*span_arm_com_y + rod_head_vx;
    const double arm_y = span_arm_com_y + table_top_y;
    const double arm_vy = arm_omega*span_arm_com_x + rod_head_vy;

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
    all_q[6] = rod_head_x;
    all_v[6] = rod_head_vx;
    all_q[7] = rod_head_y;
    all_v[7] = rod_head_vy;
    all_q[8] = table_theta;
    all_v[8] = table_omega;
    all_q[9] = arm_x;
    all_v[9] = arm_vx;
    all_q[10] = arm_y;
    all_v[10] = arm_vy;
    all_q[11] = arm_theta;
    all_v[11] = arm_omega;
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
    const double arm_theta = q[11];
    const double arm_omega = v[11];

    /* tree coordinates */
    s[0] = arm_theta;  /* arm */
    s_rate[0] = arm_omega;
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
    (void)t, (void)memory;
    /* coordinates, velocities, time */
    const double rod_omega = v[1];
    const double arm_theta = q[0];
    const double arm_omega = v[0];
    const double cos_theta_crank = q[2];
    const double sin_theta_crank = q[3];
    const double cos_theta_rod = q[4];
    const double sin_theta_rod = q[5];
    const double rod_theta_second = v[2];

    /* directions, arms, drives */
    const Four angles_0 = {arm_theta, arm_theta, arm_theta, arm_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_arm = cosines_0[0];
    const double sin_theta_arm = sines_0[0];
    const double motor_rate = p->omega;
    const double motor_acceleration = 0.0;
    const double cos_rod_less_crank = cos_theta_crank*cos_theta_rod + sin_theta_crank*sin_theta_rod;
    const double sin_rod_less_crank = cos_theta_crank*sin_theta_rod - cos_theta_rod*sin_theta_crank;
    const double dot_crank_rod = cos_rod_less_crank*p->inertia_crank_rod;
    const double cross_crank_rod = p->inertia_crank_rod*sin_rod_less_crank;
    const double cos_arm_less_crank = cos_theta_arm*cos_theta_crank + sin_theta_arm*sin_theta_crank;
    const double sin_arm_less_crank = -cos_theta_arm*sin_theta_crank + cos_theta_crank*sin_theta_arm;
    const double dot_crank_arm = cos_arm_less_crank*p->inertia_crank_arm;
    const double cross_crank_arm = p->inertia_crank_arm*sin_arm_less_crank;
    const double cos_arm_less_rod = cos_theta_arm*cos_theta_rod + sin_theta_arm*sin_theta_rod;
    const double sin_arm_less_rod = -cos_theta_arm*sin_theta_rod + cos_theta_rod*sin_theta_arm;
    const double dot_rod_arm = cos_arm_less_rod*p->inertia_rod_arm;
    const double cross_rod_arm = p->inertia_rod_arm*sin_arm_less_rod;

    /* forward substitution */
    const double z_arm_theta = cos_theta_arm*p->weight_arm__across - cross_crank_arm*(motor_rate * motor_rate)
        - cross_rod_arm*(rod_omega * rod_omega) - dot_crank_arm*motor_acceleration - dot_rod_arm*rod_theta_second;

    /* backward substitution */
    const double acceleration_arm_theta = p->inverse_mass_arm_arm*z_arm_theta;

    /* results */
    a[0] = acceleration_arm_theta;
    aside->power[0] = motor_rate*(a[0]*dot_crank_arm - (arm_omega * arm_omega)*cross_crank_arm
        - cos_theta_crank*p->weight_crank__across - cross_crank_rod*(rod_omega * rod_omega)
        + dot_crank_rod*rod_theta_second + p->mass_motor_motor*motor_acceleration)
        + rod_omega*(a[0]*dot_rod_arm - (arm_omega * arm_omega)*cross_rod_arm - cos_theta_rod*p->weight_rod__across
        + cross_crank_rod*(motor_rate * motor_rate) + dot_crank_rod*motor_acceleration
        + p->mass_rod_rod*rod_theta_second);
    aside->power[1] = 0.0;
    aside->power[2] = 0.0;
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
    const double step_acceleration_arm_theta = 0.0;

    /* results */
    x[0] = step_acceleration_arm_theta;
    return 0;
}

/*
 * Cosines and sines of all angles in the chains' closures, behind the coordinates in q.
 */
void chain_directions(const double t, const double *q, const Memory *memory, const Parameters *p, double *out)
{
    (void)memory;
    /* coordinates, velocities, time */
    const double rod_theta = q[1];

    /* directions, arms, drives */
    const double motor_value = p->omega*t;

    /* directions */
    const Four angles_0 = {motor_value, rod_theta, rod_theta, rod_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    out[2] = cosines_0[0];  /* cos_theta_crank */
    out[3] = sines_0[0];  /* sin_theta_crank */
    out[4] = cosines_0[1];  /* cos_theta_rod */
    out[5] = sines_0[1];  /* sin_theta_rod */
}

/*
 * Newton's step of the driven chains' coordinates, Phi_c newton = Phi, and with it Chebyshev's of order 3,
 * step = newton + bend, Phi_c bend = Phi_cc[newton, newton]/2. `row`: the number, from 1, of the row with
 * the largest |Phi|. Returns 0, or the number of a row that depends on others here.
 */
int chain_step(const double t, const double *q, const Memory *memory, const Parameters *p, double *step, double *bend,
    int *row)
{
    (void)t, (void)memory;
    /* coordinates, velocities, time */
    const double cos_theta_crank = q[2];
    const double cos_theta_rod = q[4];
    const double sin_theta_rod = q[5];

    /* directions, arms, drives */
    const double span_crank_head_x = cos_theta_crank*p->crank_head_span_x;
    const double span_rod_head_x = cos_theta_rod*p->rod_head_span_x;
    const double span_rod_head_y = p->rod_head_span_x*sin_theta_rod;

    /* closures of the chains */
    const double phi_guide_offset = -span_crank_head_x - span_rod_head_x;

    /* the largest */
    *row = 1;

    /* groups of rows that are solved one after the other */
    const double pivot_guide_offset = span_rod_head_y;
    const double size_guide_offset__rod_theta = fabs(span_rod_head_x) + fabs(span_rod_head_y);
    if (!(fabs(pivot_guide_offset) > SINGULAR_SQUARE * size_guide_offset__rod_theta))
        return 1;
    const double inverse_guide_offset = 1.0/pivot_guide_offset;

    /* Newton's step */
    const double newton_rod_theta = inverse_guide_offset*phi_guide_offset;

    /* what the rows' curvature adds */
    const double bend_rod_theta = 0.5*inverse_guide_offset*(newton_rod_theta * newton_rod_theta)*span_rod_head_x;
    step[0] = bend_rod_theta + newton_rod_theta;
    bend[0] = bend_rod_theta;
    return 0;
}

/*
 * First and second rates of the driven chains' coordinates, where these close their loops: Phi_c c' = nu,
 * Phi_c c'' = gamma. They go behind those of the other coordinates in v.
 * Returns 0, or the number of a row that depends on others here.
 */
int chain_rates(const double t, const double *q, const Memory *memory, const Parameters *p, double *v)
{
    (void)t, (void)memory;
    /* coordinates, velocities, time */
    const double cos_theta_crank = q[2];
    const double sin_theta_crank = q[3];
    const double cos_theta_rod = q[4];
    const double sin_theta_rod = q[5];

    /* directions, arms, drives */
    const double motor_rate = p->omega;
    const double motor_acceleration = 0.0;
    const double span_crank_head_x = cos_theta_crank*p->crank_head_span_x;
    const double span_crank_head_y = p->crank_head_span_x*sin_theta_crank;
    const double span_rod_head_x = cos_theta_rod*p->rod_head_span_x;
    const double span_rod_head_y = p->rod_head_span_x*sin_theta_rod;

    /* groups of rows that are solved one after the other */
    const double pivot_guide_offset = span_rod_head_y;
    const double size_guide_offset__rod_theta = fabs(span_rod_head_x) + fabs(span_rod_head_y);
    if (!(fabs(pivot_guide_offset) > SINGULAR_SQUARE * size_guide_offset__rod_theta))
        return 1;
    const double inverse_guide_offset = 1.0/pivot_guide_offset;

    /* rates */
    const double rate_rod_theta = -inverse_guide_offset*motor_rate*span_crank_head_y;
    const double rod_omega = rate_rod_theta;

    /* second rates */
    const double second_rod_theta = inverse_guide_offset*(-motor_acceleration*span_crank_head_y
        - (motor_rate * motor_rate)*span_crank_head_x - (rod_omega * rod_omega)*span_rod_head_x);

    /* results */
    v[1] = rod_omega;
    v[2] = second_rod_theta;
    return 0;
}

/*
 * Third rates of the driven chains' coordinates: Phi_c c''' = d/dt (gamma - Phi_c c'') at the same c''.
 * Returns 0, or the number of a row that depends on others here.
 */
int chain_third(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    double *out)
{
    (void)t, (void)memory;
    /* coordinates, velocities, time */
    const double rod_omega = v[1];
    const double cos_theta_crank = q[2];
    const double sin_theta_crank = q[3];
    const double cos_theta_rod = q[4];
    const double sin_theta_rod = q[5];
    const double rod_theta_second = v[2];

    /* directions, arms, drives */
    const double motor_rate = p->omega;
    const double motor_acceleration = 0.0;
    const double span_crank_head_x = cos_theta_crank*p->crank_head_span_x;
    const double span_crank_head_y = p->crank_head_span_x*sin_theta_crank;
    const double span_rod_head_x = cos_theta_rod*p->rod_head_span_x;
    const double span_rod_head_y = p->rod_head_span_x*sin_theta_rod;

    /* groups of rows that are solved one after the other */
    const double pivot_guide_offset = span_rod_head_y;
    const double size_guide_offset__rod_theta = fabs(span_rod_head_x) + fabs(span_rod_head_y);
    if (!(fabs(pivot_guide_offset) > SINGULAR_SQUARE * size_guide_offset__rod_theta))
        return 1;
    const double inverse_guide_offset = 1.0/pivot_guide_offset;

    /* third rates */
    const double span_crank_head_x_by_time = -motor_rate*span_crank_head_y;
    const double span_crank_head_y_by_time = motor_rate*span_crank_head_x;
    const double span_rod_head_x_by_time = -rod_omega*span_rod_head_y;
    const double span_rod_head_y_by_time = rod_omega*span_rod_head_x;
    const double third_rod_theta = inverse_guide_offset*(-2.0*motor_acceleration*motor_rate*span_crank_head_x
        - motor_acceleration*span_crank_head_y_by_time - (motor_rate * motor_rate)*span_crank_head_x_by_time
        - (rod_omega * rod_omega)*span_rod_head_x_by_time - 2.0*rod_omega*rod_theta_second*span_rod_head_x
        - rod_theta_second*span_rod_head_y_by_time);
    out[0] = third_rod_theta;
    return 0;
}

/* What a step of coordinate k is multiplied by to be a number. */
double chain_share(const Parameters *p, int k)
{
    (void)p;
    switch (k) {
    case 0:
        return 1.0;
    default:
        return 1.0;
    }
}

/* Directions in q turned by a step of the coordinates. */
void turn_directions(double *q, const double *step, const Parameters *p)
{
    (void)p;
    turn_back(q + 4, step[0]);
}
