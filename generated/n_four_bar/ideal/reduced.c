/*
 * Coordinates all_q (N_Q) and velocities all_v of all bodies at tree coordinates q and rates v.
 */
void expand(const double t, const double *q, const double *v, const Parameters *p, double *all_q, double *all_v)
{
    (void)t;
    /* coordinates, velocities, time */
    const double crank0_theta = q[0];
    const double crank0_omega = v[0];
    const double crank1_theta = q[1];
    const double crank1_omega = v[1];
    const double crank2_theta = q[2];
    const double crank2_omega = v[2];
    const double coupler1_theta = q[3];
    const double coupler1_omega = v[3];
    const double coupler2_theta = q[4];
    const double coupler2_omega = v[4];

    /* directions, arms, drives */
    const Four angles_0 = {crank0_theta, crank1_theta, crank2_theta, coupler1_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {coupler2_theta, coupler2_theta, coupler2_theta, coupler2_theta};
    Four sines_1, cosines_1;
    sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_crank0 = cosines_0[0];
    const double sin_theta_crank0 = sines_0[0];
    const double cos_theta_crank1 = cosines_0[1];
    const double sin_theta_crank1 = sines_0[1];
    const double cos_theta_crank2 = cosines_0[2];
    const double sin_theta_crank2 = sines_0[2];
    const double cos_theta_coupler1 = cosines_0[3];
    const double sin_theta_coupler1 = sines_0[3];
    const double cos_theta_coupler2 = cosines_1[0];
    const double sin_theta_coupler2 = sines_1[0];
    const double span_crank0_com_x = cos_theta_crank0*p->crank0_head_s_x;
    const double span_crank0_com_y = p->crank0_head_s_x*sin_theta_crank0;
    const double crank0_vx = -crank0_omega*span_crank0_com_y;
    const double crank0_vy = crank0_omega*span_crank0_com_x;
    const double span_crank1_com_x = cos_theta_crank1*p->crank1_head_s_x;
    const double span_crank1_com_y = p->crank1_head_s_x*sin_theta_crank1;
    const double crank1_x = p->O1_x + span_crank1_com_x;
    const double crank1_vx = -crank1_omega*span_crank1_com_y;
    const double crank1_vy = crank1_omega*span_crank1_com_x;
    const double span_crank2_com_x = cos_theta_crank2*p->crank2_head_s_x;
    const double span_crank2_com_y = p->crank2_head_s_x*sin_theta_crank2;
    const double crank2_x = p->O2_x + span_crank2_com_x;
    const double crank2_vx = -crank2_omega*span_crank2_com_y;
    const double crank2_vy = crank2_omega*span_crank2_com_x;
    const double span_crank0_head_x = cos_theta_crank0*p->crank0_head_span_x;
    const double span_crank0_head_y = p->crank0_head_span_x*sin_theta_crank0;
    const double crank0_head_vx = -crank0_omega*span_crank0_head_y;
    const double crank0_head_vy = crank0_omega*span_crank0_head_x;
    const double span_coupler1_com_x = cos_theta_coupler1*p->coupler1_head_s_x;
    const double span_coupler1_com_y = p->coupler1_head_s_x*sin_theta_coupler1;
    const double coupler1_x = span_coupler1_com_x + span_crank0_head_x;
    const double coupler1_vx = -coupler1_omega*span_coupler1_com_y + crank0_head_vx;
    const double coupler1_y = span_coupler1_com_y + span_crank0_head_y;
    const double coupler1_vy = coupler1_omega*span_coupler1_com_x + crank0_head_vy;
    const double span_crank1_head_x = cos_theta_crank1*p->crank1_head_span_x;
    const double span_crank1_head_y = p->crank1_head_span_x*sin_theta_crank1;
    const double crank1_head_x = p->O1_x + span_crank1_head_x;
    const double crank1_head_vx = -crank1_omega*span_crank1_head_y;
    const double crank1_head_vy = crank1_omega*span_crank1_head_x;
    const double span_coupler2_com_x = cos_theta_coupler2*p->coupler2_head_s_x;
    const double span_coupler2_com_y = p->coupler2_head_s_x*sin_theta_coupler2;
    const double coupler2_x = crank1_head_x + span_coupler2_com_x;
    const double coupler2_vx = -coupler2_omega*span_coupler2_com_y + crank1_head_vx;
    const double coupler2_y = span_coupler2_com_y + span_crank1_head_y;
    const double coupler2_vy = coupler2_omega*span_coupler2_com_x + crank1_head_vy;

    /* bodies */
    all_q[0] = span_crank0_com_x;
    all_v[0] = crank0_vx;
    all_q[1] = span_crank0_com_y;
    all_v[1] = crank0_vy;
    all_q[2] = crank0_theta;
    all_v[2] = crank0_omega;
    all_q[3] = crank1_x;
    all_v[3] = crank1_vx;
    all_q[4] = span_crank1_com_y;
    all_v[4] = crank1_vy;
    all_q[5] = crank1_theta;
    all_v[5] = crank1_omega;
    all_q[6] = crank2_x;
    all_v[6] = crank2_vx;
    all_q[7] = span_crank2_com_y;
    all_v[7] = crank2_vy;
    all_q[8] = crank2_theta;
    all_v[8] = crank2_omega;
    all_q[9] = coupler1_x;
    all_v[9] = coupler1_vx;
    all_q[10] = coupler1_y;
    all_v[10] = coupler1_vy;
    all_q[11] = coupler1_theta;
    all_v[11] = coupler1_omega;
    all_q[12] = coupler2_x;
    all_v[12] = coupler2_vx;
    all_q[13] = coupler2_y;
    all_v[13] = coupler2_vy;
    all_q[14] = coupler2_theta;
    all_v[14] = coupler2_omega;
}

/*
 * Tree coordinates s and their rates of an absolute state; what the tree does not have is not looked at.
 */
void reduce_state(const double t, const double *q, const double *v, const Parameters *p, double *s, double *s_rate)
{
    (void)t, (void)p;
    /* coordinates, velocities, time */
    const double crank0_theta = q[2];
    const double crank0_omega = v[2];
    const double crank1_theta = q[5];
    const double crank1_omega = v[5];
    const double crank2_theta = q[8];
    const double crank2_omega = v[8];
    const double coupler1_theta = q[11];
    const double coupler1_omega = v[11];
    const double coupler2_theta = q[14];
    const double coupler2_omega = v[14];

    /* tree coordinates */
    s[0] = crank0_theta;  /* crank0 */
    s_rate[0] = crank0_omega;
    s[1] = crank1_theta;  /* crank1 */
    s_rate[1] = crank1_omega;
    s[2] = crank2_theta;  /* crank2 */
    s_rate[2] = crank2_omega;
    s[3] = coupler1_theta;  /* coupler1 */
    s_rate[3] = coupler1_omega;
    s[4] = coupler2_theta;  /* coupler2 */
    s_rate[4] = coupler2_omega;
}

/*
 * Their second rates a, from absolute all_a.
 */
void reduce_accelerations(const double t, const double *q, const double *v, const double *all_a, const Parameters *p,
    double *a)
{
    (void)t, (void)q, (void)v, (void)p;
    /* tree coordinates */
    a[0] = all_a[2];  /* crank0 */
    a[1] = all_a[5];  /* crank1 */
    a[2] = all_a[8];  /* crank2 */
    a[3] = all_a[11];  /* coupler1 */
    a[4] = all_a[14];  /* coupler2 */
}

/*
 * Phi of the loop closures in tree coordinates; m and rad.
 */
void closures(const double t, const double *q, const Parameters *p, double *out)
{
    (void)t;
    /* coordinates, velocities, time */
    const double crank0_theta = q[0];
    const double crank1_theta = q[1];
    const double crank2_theta = q[2];
    const double coupler1_theta = q[3];
    const double coupler2_theta = q[4];

    /* directions, arms, drives */
    const Four angles_0 = {crank0_theta, crank1_theta, crank2_theta, coupler1_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {coupler2_theta, coupler2_theta, coupler2_theta, coupler2_theta};
    Four sines_1, cosines_1;
    sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_crank0 = cosines_0[0];
    const double sin_theta_crank0 = sines_0[0];
    const double cos_theta_crank1 = cosines_0[1];
    const double sin_theta_crank1 = sines_0[1];
    const double cos_theta_crank2 = cosines_0[2];
    const double sin_theta_crank2 = sines_0[2];
    const double cos_theta_coupler1 = cosines_0[3];
    const double sin_theta_coupler1 = sines_0[3];
    const double cos_theta_coupler2 = cosines_1[0];
    const double sin_theta_coupler2 = sines_1[0];
    const double span_crank0_head_x = cos_theta_crank0*p->crank0_head_span_x;
    const double span_crank0_head_y = p->crank0_head_span_x*sin_theta_crank0;
    const double span_crank1_head_x = cos_theta_crank1*p->crank1_head_span_x;
    const double span_crank1_head_y = p->crank1_head_span_x*sin_theta_crank1;
    const double span_coupler2_head_x = cos_theta_coupler2*p->coupler2_head_span_x;
    const double span_coupler2_head_y = p->coupler2_head_span_x*sin_theta_coupler2;
    const double span_crank2_head_x = cos_theta_crank2*p->crank2_head_span_x;
    const double span_crank2_head_y = p->crank2_head_span_x*sin_theta_crank2;
    const double span_coupler1_head_x = cos_theta_coupler1*p->coupler1_head_span_x;
    const double span_coupler1_head_y = p->coupler1_head_span_x*sin_theta_coupler1;

    /* rows */
    out[0] = p->O1_x - p->O2_x + span_coupler2_head_x + span_crank1_head_x - span_crank2_head_x;  /* B2.x */
    out[1] = span_coupler2_head_y + span_crank1_head_y - span_crank2_head_y;  /* B2.y */
    out[2] = -p->O1_x + span_coupler1_head_x + span_crank0_head_x - span_crank1_head_x;  /* B1.x */
    out[3] = span_coupler1_head_y + span_crank0_head_y - span_crank1_head_y;  /* B1.y */
}

/*
 * Its rate Phi_q v - nu.
 */
void closure_rates(const double t, const double *q, const double *v, const Parameters *p, double *out)
{
    (void)t;
    /* coordinates, velocities, time */
    const double crank0_theta = q[0];
    const double crank0_omega = v[0];
    const double crank1_theta = q[1];
    const double crank1_omega = v[1];
    const double crank2_theta = q[2];
    const double crank2_omega = v[2];
    const double coupler1_theta = q[3];
    const double coupler1_omega = v[3];
    const double coupler2_theta = q[4];
    const double coupler2_omega = v[4];

    /* directions, arms, drives */
    const Four angles_0 = {crank0_theta, crank1_theta, crank2_theta, coupler1_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {coupler2_theta, coupler2_theta, coupler2_theta, coupler2_theta};
    Four sines_1, cosines_1;
    sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_crank0 = cosines_0[0];
    const double sin_theta_crank0 = sines_0[0];
    const double cos_theta_crank1 = cosines_0[1];
    const double sin_theta_crank1 = sines_0[1];
    const double cos_theta_crank2 = cosines_0[2];
    const double sin_theta_crank2 = sines_0[2];
    const double cos_theta_coupler1 = cosines_0[3];
    const double sin_theta_coupler1 = sines_0[3];
    const double cos_theta_coupler2 = cosines_1[0];
    const double sin_theta_coupler2 = sines_1[0];
    const double span_crank0_head_x = cos_theta_crank0*p->crank0_head_span_x;
    const double span_crank0_head_y = p->crank0_head_span_x*sin_theta_crank0;
    const double span_crank1_head_x = cos_theta_crank1*p->crank1_head_span_x;
    const double span_crank1_head_y = p->crank1_head_span_x*sin_theta_crank1;
    const double span_coupler2_head_x = cos_theta_coupler2*p->coupler2_head_span_x;
    const double span_coupler2_head_y = p->coupler2_head_span_x*sin_theta_coupler2;
    const double span_crank2_head_x = cos_theta_crank2*p->crank2_head_span_x;
    const double span_crank2_head_y = p->crank2_head_span_x*sin_theta_crank2;
    const double span_coupler1_head_x = cos_theta_coupler1*p->coupler1_head_span_x;
    const double span_coupler1_head_y = p->coupler1_head_span_x*sin_theta_coupler1;

    /* rows */
    /* B2.x */
    out[0] = -coupler2_omega*span_coupler2_head_y - crank1_omega*span_crank1_head_y + crank2_omega*span_crank2_head_y;
    /* B2.y */
    out[1] = coupler2_omega*span_coupler2_head_x + crank1_omega*span_crank1_head_x - crank2_omega*span_crank2_head_x;
    /* B1.x */
    out[2] = -coupler1_omega*span_coupler1_head_y - crank0_omega*span_crank0_head_y + crank1_omega*span_crank1_head_y;
    /* B1.y */
    out[3] = coupler1_omega*span_coupler1_head_x + crank0_omega*span_crank0_head_x - crank1_omega*span_crank1_head_x;
}

/*
 * Accelerations a of the tree's coordinates q, and the closures' multipliers in `aside`:
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma] with M, Phi_q, g in these coordinates; drifts are projected away.
 * Returns 0, or the number of the pivot that vanished where the rows contradict each other.
 */
int reduced_dynamics(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    double *a, Aside *aside)
{
    /* coordinates, velocities, time */
    const double crank0_theta = q[0];
    const double crank0_omega = v[0];
    const double crank1_theta = q[1];
    const double crank1_omega = v[1];
    const double crank2_theta = q[2];
    const double crank2_omega = v[2];
    const double coupler1_theta = q[3];
    const double coupler1_omega = v[3];
    const double coupler2_theta = q[4];
    const double coupler2_omega = v[4];

    /* directions, arms, drives */
    const Four angles_0 = {crank0_theta, crank1_theta, crank2_theta, coupler1_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {coupler2_theta, coupler2_theta, coupler2_theta, coupler2_theta};
    Four sines_1, cosines_1;
    sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_crank0 = cosines_0[0];
    const double sin_theta_crank0 = sines_0[0];
    const double cos_theta_crank1 = cosines_0[1];
    const double sin_theta_crank1 = sines_0[1];
    const double cos_theta_crank2 = cosines_0[2];
    const double sin_theta_crank2 = sines_0[2];
    const double cos_theta_coupler1 = cosines_0[3];
    const double sin_theta_coupler1 = sines_0[3];
    const double cos_theta_coupler2 = cosines_1[0];
    const double sin_theta_coupler2 = sines_1[0];
    const double span_crank0_head_x = cos_theta_crank0*p->crank0_head_span_x;
    const double span_crank0_head_y = p->crank0_head_span_x*sin_theta_crank0;
    const double span_crank1_head_x = cos_theta_crank1*p->crank1_head_span_x;
    const double span_crank1_head_y = p->crank1_head_span_x*sin_theta_crank1;
    const double span_coupler2_head_x = cos_theta_coupler2*p->coupler2_head_span_x;
    const double span_coupler2_head_y = p->coupler2_head_span_x*sin_theta_coupler2;
    const double span_crank2_head_x = cos_theta_crank2*p->crank2_head_span_x;
    const double span_crank2_head_y = p->crank2_head_span_x*sin_theta_crank2;
    const double span_coupler1_head_x = cos_theta_coupler1*p->coupler1_head_span_x;
    const double span_coupler1_head_y = p->coupler1_head_span_x*sin_theta_coupler1;
    const double cos_coupler1_less_crank0 = cos_theta_coupler1*cos_theta_crank0 + sin_theta_coupler1*sin_theta_crank0;
    const double sin_coupler1_less_crank0 = -cos_theta_coupler1*sin_theta_crank0 + cos_theta_crank0*sin_theta_coupler1;
    const double dot_crank0_coupler1 = cos_coupler1_less_crank0*p->inertia_crank0_coupler1;
    const double cross_crank0_coupler1 = p->inertia_crank0_coupler1*sin_coupler1_less_crank0;
    const double cos_coupler2_less_crank1 = cos_theta_coupler2*cos_theta_crank1 + sin_theta_coupler2*sin_theta_crank1;
    const double sin_coupler2_less_crank1 = -cos_theta_coupler2*sin_theta_crank1 + cos_theta_crank1*sin_theta_coupler2;
    const double dot_crank1_coupler2 = cos_coupler2_less_crank1*p->inertia_crank1_coupler2;
    const double cross_crank1_coupler2 = p->inertia_crank1_coupler2*sin_coupler2_less_crank1;

    /* status */
    int pivot = 0;

    /* constraints: gamma */
    const double rhs_B2_x = (coupler2_omega * coupler2_omega)*span_coupler2_head_x
        + (crank1_omega * crank1_omega)*span_crank1_head_x - (crank2_omega * crank2_omega)*span_crank2_head_x;
    const double rhs_B2_y = (coupler2_omega * coupler2_omega)*span_coupler2_head_y
        + (crank1_omega * crank1_omega)*span_crank1_head_y - (crank2_omega * crank2_omega)*span_crank2_head_y;
    const double rhs_B1_x = (coupler1_omega * coupler1_omega)*span_coupler1_head_x
        + (crank0_omega * crank0_omega)*span_crank0_head_x - (crank1_omega * crank1_omega)*span_crank1_head_x;
    const double rhs_B1_y = (coupler1_omega * coupler1_omega)*span_coupler1_head_y
        + (crank0_omega * crank0_omega)*span_crank0_head_y - (crank1_omega * crank1_omega)*span_crank1_head_y;

    /* L D L^T of the KKT matrix */
    const double l_B2_x__crank2_theta = p->inverse_mass_crank2_crank2*span_crank2_head_y;
    const double l_B2_y__crank2_theta = -p->inverse_mass_crank2_crank2*span_crank2_head_x;
    const double l_B2_x__coupler2_theta = -p->inverse_mass_coupler2_coupler2*span_coupler2_head_y;
    const double l_B2_y__coupler2_theta = p->inverse_mass_coupler2_coupler2*span_coupler2_head_x;
    const double l_crank1_theta__coupler2_theta = dot_crank1_coupler2*p->inverse_mass_coupler2_coupler2;
    const double scale_B2_x = -l_B2_x__coupler2_theta*span_coupler2_head_y + l_B2_x__crank2_theta*span_crank2_head_y;
    const double scale_B2_y = l_B2_y__coupler2_theta*span_coupler2_head_x - l_B2_y__crank2_theta*span_crank2_head_x;
    const double pivot_B2_x__B2_y = -l_B2_y__coupler2_theta*span_coupler2_head_y
        + l_B2_y__crank2_theta*span_crank2_head_y;
    const double determinant_B2_x__B2_y = -(pivot_B2_x__B2_y * pivot_B2_x__B2_y) + scale_B2_x*scale_B2_y;
    if (!(scale_B2_x > 0.0 && scale_B2_x < INFINITY)) {
        pivot = 1;
        goto dependent;
    }
    if (!(determinant_B2_x__B2_y > EARLY * scale_B2_y * scale_B2_x)) {
        pivot = 2;
        goto dependent;
    }
    const double size_B2_x = scale_B2_x + scale_B2_y;
    if (!(scale_B2_x > memory->least_size * size_B2_x)) {
        pivot = 1;
        goto dependent;
    }
    if (!(determinant_B2_x__B2_y > memory->least_size * size_B2_x * scale_B2_x)) {
        pivot = 2;
        goto dependent;
    }
    const double inverse_B2_x__B2_y = -1.0/determinant_B2_x__B2_y;
    const double inverse_pivot_B2_x = inverse_B2_x__B2_y*scale_B2_y;
    const double inverse_pivot_B2_y = inverse_B2_x__B2_y*scale_B2_x;
    const double inverse_cross_B2_x__B2_y = -inverse_B2_x__B2_y*pivot_B2_x__B2_y;
    const double w_crank1_theta__B2_x = l_crank1_theta__coupler2_theta*span_coupler2_head_y - span_crank1_head_y;
    const double w_crank1_theta__B2_y = -l_crank1_theta__coupler2_theta*span_coupler2_head_x + span_crank1_head_x;
    const double l_crank1_theta__B2_x = inverse_cross_B2_x__B2_y*w_crank1_theta__B2_y
        + inverse_pivot_B2_x*w_crank1_theta__B2_x;
    const double l_crank1_theta__B2_y = inverse_cross_B2_x__B2_y*w_crank1_theta__B2_x
        + inverse_pivot_B2_y*w_crank1_theta__B2_y;
    const double inverse_pivot_crank1_theta = 1.0/(-dot_crank1_coupler2*l_crank1_theta__coupler2_theta
        - l_crank1_theta__B2_x*w_crank1_theta__B2_x - l_crank1_theta__B2_y*w_crank1_theta__B2_y
        + p->mass_crank1_crank1);
    const double l_B1_x__crank1_theta = inverse_pivot_crank1_theta*span_crank1_head_y;
    const double l_B1_y__crank1_theta = -inverse_pivot_crank1_theta*span_crank1_head_x;
    const double l_coupler1_theta__crank0_theta = dot_crank0_coupler1*p->inverse_mass_crank0_crank0;
    const double l_B1_x__crank0_theta = -p->inverse_mass_crank0_crank0*span_crank0_head_y;
    const double l_B1_y__crank0_theta = p->inverse_mass_crank0_crank0*span_crank0_head_x;
    const double inverse_pivot_coupler1_theta = 1.0/(-dot_crank0_coupler1*l_coupler1_theta__crank0_theta
        + p->mass_coupler1_coupler1);
    const double w_B1_x__coupler1_theta = -dot_crank0_coupler1*l_B1_x__crank0_theta - span_coupler1_head_y;
    const double l_B1_x__coupler1_theta = inverse_pivot_coupler1_theta*w_B1_x__coupler1_theta;
    const double w_B1_y__coupler1_theta = -dot_crank0_coupler1*l_B1_y__crank0_theta + span_coupler1_head_x;
    const double l_B1_y__coupler1_theta = inverse_pivot_coupler1_theta*w_B1_y__coupler1_theta;
    const double scale_B1_x = l_B1_x__coupler1_theta*w_B1_x__coupler1_theta - l_B1_x__crank0_theta*span_crank0_head_y
        + l_B1_x__crank1_theta*span_crank1_head_y;
    const double scale_B1_y = l_B1_y__coupler1_theta*w_B1_y__coupler1_theta + l_B1_y__crank0_theta*span_crank0_head_x
        - l_B1_y__crank1_theta*span_crank1_head_x;
    const double pivot_B1_x__B1_y = l_B1_y__coupler1_theta*w_B1_x__coupler1_theta
        - l_B1_y__crank0_theta*span_crank0_head_y + l_B1_y__crank1_theta*span_crank1_head_y;
    const double determinant_B1_x__B1_y = -(pivot_B1_x__B1_y * pivot_B1_x__B1_y) + scale_B1_x*scale_B1_y;
    if (!(scale_B1_x > 0.0 && scale_B1_x < INFINITY)) {
        pivot = 3;
        goto dependent;
    }
    if (!(determinant_B1_x__B1_y > memory->least * scale_B1_y * scale_B1_x)) {
        pivot = 4;
        goto dependent;
    }
    const double size_B1_x = scale_B1_x + scale_B1_y;
    if (!(scale_B1_x > memory->least_size * size_B1_x)) {
        pivot = 3;
        goto dependent;
    }
    if (!(determinant_B1_x__B1_y > memory->least_size * size_B1_x * scale_B1_x)) {
        pivot = 4;
        goto dependent;
    }
    const double inverse_B1_x__B1_y = -1.0/determinant_B1_x__B1_y;
    const double inverse_pivot_B1_x = inverse_B1_x__B1_y*scale_B1_y;
    const double inverse_pivot_B1_y = inverse_B1_x__B1_y*scale_B1_x;
    const double inverse_cross_B1_x__B1_y = -inverse_B1_x__B1_y*pivot_B1_x__B1_y;

    /* forward substitution */
    const double z_crank2_theta = cos_theta_crank2*p->weight_crank2__across;
    const double z_coupler2_theta = cos_theta_coupler2*p->weight_coupler2__across
        - (crank1_omega * crank1_omega)*cross_crank1_coupler2;
    const double z_B2_x = -l_B2_x__coupler2_theta*z_coupler2_theta - l_B2_x__crank2_theta*z_crank2_theta + rhs_B2_x;
    const double z_B2_y = -l_B2_y__coupler2_theta*z_coupler2_theta - l_B2_y__crank2_theta*z_crank2_theta + rhs_B2_y;
    const double z_crank1_theta = cos_theta_crank1*p->weight_crank1__across
        + (coupler2_omega * coupler2_omega)*cross_crank1_coupler2 - l_crank1_theta__B2_x*z_B2_x
        - l_crank1_theta__B2_y*z_B2_y - l_crank1_theta__coupler2_theta*z_coupler2_theta;
    const double z_crank0_theta = cos_theta_crank0*p->weight_crank0__across
        + (coupler1_omega * coupler1_omega)*cross_crank0_coupler1;
    const double z_coupler1_theta = cos_theta_coupler1*p->weight_coupler1__across
        - (crank0_omega * crank0_omega)*cross_crank0_coupler1 - l_coupler1_theta__crank0_theta*z_crank0_theta;
    const double z_B1_x = -l_B1_x__coupler1_theta*z_coupler1_theta - l_B1_x__crank0_theta*z_crank0_theta
        - l_B1_x__crank1_theta*z_crank1_theta + rhs_B1_x;
    const double z_B1_y = -l_B1_y__coupler1_theta*z_coupler1_theta - l_B1_y__crank0_theta*z_crank0_theta
        - l_B1_y__crank1_theta*z_crank1_theta + rhs_B1_y;

    /* backward substitution */
    const double lambda_B1_y = inverse_cross_B1_x__B1_y*z_B1_x + inverse_pivot_B1_y*z_B1_y;
    const double lambda_B1_x = inverse_cross_B1_x__B1_y*z_B1_y + inverse_pivot_B1_x*z_B1_x;
    const double acceleration_coupler1_theta = inverse_pivot_coupler1_theta*z_coupler1_theta
        - l_B1_x__coupler1_theta*lambda_B1_x - l_B1_y__coupler1_theta*lambda_B1_y;
    const double acceleration_crank0_theta = -acceleration_coupler1_theta*l_coupler1_theta__crank0_theta
        + p->inverse_mass_crank0_crank0*z_crank0_theta - l_B1_x__crank0_theta*lambda_B1_x
        - l_B1_y__crank0_theta*lambda_B1_y;
    const double acceleration_crank1_theta = inverse_pivot_crank1_theta*z_crank1_theta
        - l_B1_x__crank1_theta*lambda_B1_x - l_B1_y__crank1_theta*lambda_B1_y;
    const double lambda_B2_y = -acceleration_crank1_theta*l_crank1_theta__B2_y + inverse_cross_B2_x__B2_y*z_B2_x
        + inverse_pivot_B2_y*z_B2_y;
    const double lambda_B2_x = -acceleration_crank1_theta*l_crank1_theta__B2_x + inverse_cross_B2_x__B2_y*z_B2_y
        + inverse_pivot_B2_x*z_B2_x;
    const double acceleration_coupler2_theta = -acceleration_crank1_theta*l_crank1_theta__coupler2_theta
        + p->inverse_mass_coupler2_coupler2*z_coupler2_theta - l_B2_x__coupler2_theta*lambda_B2_x
        - l_B2_y__coupler2_theta*lambda_B2_y;
    const double acceleration_crank2_theta = p->inverse_mass_crank2_crank2*z_crank2_theta
        - l_B2_x__crank2_theta*lambda_B2_x - l_B2_y__crank2_theta*lambda_B2_y;

    /* results */
    a[0] = acceleration_crank0_theta;
    a[1] = acceleration_crank1_theta;
    a[2] = acceleration_crank2_theta;
    a[3] = acceleration_coupler1_theta;
    a[4] = acceleration_coupler2_theta;
    aside->lambda[0] = lambda_B2_x;
    aside->lambda[1] = lambda_B2_y;
    aside->lambda[2] = lambda_B1_x;
    aside->lambda[3] = lambda_B1_y;
    goto powers;

    /* a pivot vanished: rows depend on each other here */
    dependent:
    pivot = solve_by_absolute(t, q, v, memory, p, a, aside);
    powers:
    aside->power[0] = 0.0;
    aside->power[1] = 0.0;
    aside->power[2] = 0.0;
    return pivot;
}

/*
 * The smallest x (n), measured by M, with Phi_q x = r; Newton's step, velocities. r holds all rows of
 * the closed linkage, redundant ones are not looked at.
 * Returns 0, or the number of the pivot that vanished.
 */
int reduced_project(const double t, const double *q, const double *r, const Parameters *p, double *x)
{
    (void)t;
    /* coordinates, velocities, time */
    const double crank0_theta = q[0];
    const double crank1_theta = q[1];
    const double crank2_theta = q[2];
    const double coupler1_theta = q[3];
    const double coupler2_theta = q[4];

    /* directions, arms, drives */
    const Four angles_0 = {crank0_theta, crank1_theta, crank2_theta, coupler1_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {coupler2_theta, coupler2_theta, coupler2_theta, coupler2_theta};
    Four sines_1, cosines_1;
    sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_crank0 = cosines_0[0];
    const double sin_theta_crank0 = sines_0[0];
    const double cos_theta_crank1 = cosines_0[1];
    const double sin_theta_crank1 = sines_0[1];
    const double cos_theta_crank2 = cosines_0[2];
    const double sin_theta_crank2 = sines_0[2];
    const double cos_theta_coupler1 = cosines_0[3];
    const double sin_theta_coupler1 = sines_0[3];
    const double cos_theta_coupler2 = cosines_1[0];
    const double sin_theta_coupler2 = sines_1[0];
    const double span_crank0_head_x = cos_theta_crank0*p->crank0_head_span_x;
    const double span_crank0_head_y = p->crank0_head_span_x*sin_theta_crank0;
    const double span_crank1_head_x = cos_theta_crank1*p->crank1_head_span_x;
    const double span_crank1_head_y = p->crank1_head_span_x*sin_theta_crank1;
    const double span_coupler2_head_x = cos_theta_coupler2*p->coupler2_head_span_x;
    const double span_coupler2_head_y = p->coupler2_head_span_x*sin_theta_coupler2;
    const double span_crank2_head_x = cos_theta_crank2*p->crank2_head_span_x;
    const double span_crank2_head_y = p->crank2_head_span_x*sin_theta_crank2;
    const double span_coupler1_head_x = cos_theta_coupler1*p->coupler1_head_span_x;
    const double span_coupler1_head_y = p->coupler1_head_span_x*sin_theta_coupler1;
    const double cos_coupler1_less_crank0 = cos_theta_coupler1*cos_theta_crank0 + sin_theta_coupler1*sin_theta_crank0;
    const double dot_crank0_coupler1 = cos_coupler1_less_crank0*p->inertia_crank0_coupler1;
    const double cos_coupler2_less_crank1 = cos_theta_coupler2*cos_theta_crank1 + sin_theta_coupler2*sin_theta_crank1;
    const double dot_crank1_coupler2 = cos_coupler2_less_crank1*p->inertia_crank1_coupler2;

    /* right-hand side */
    const double r_B2_x = r[0];
    const double r_B2_y = r[1];
    const double r_B1_x = r[2];
    const double r_B1_y = r[3];

    /* L D L^T of the KKT matrix */
    const double l_B2_x__crank2_theta = p->inverse_mass_crank2_crank2*span_crank2_head_y;
    const double l_B2_y__crank2_theta = -p->inverse_mass_crank2_crank2*span_crank2_head_x;
    const double l_coupler1_theta__crank0_theta = dot_crank0_coupler1*p->inverse_mass_crank0_crank0;
    const double l_B1_x__crank0_theta = -p->inverse_mass_crank0_crank0*span_crank0_head_y;
    const double l_B1_y__crank0_theta = p->inverse_mass_crank0_crank0*span_crank0_head_x;
    const double inverse_pivot_coupler1_theta = 1.0/(-dot_crank0_coupler1*l_coupler1_theta__crank0_theta
        + p->mass_coupler1_coupler1);
    const double w_B1_x__coupler1_theta = -dot_crank0_coupler1*l_B1_x__crank0_theta - span_coupler1_head_y;
    const double l_B1_x__coupler1_theta = inverse_pivot_coupler1_theta*w_B1_x__coupler1_theta;
    const double w_B1_y__coupler1_theta = -dot_crank0_coupler1*l_B1_y__crank0_theta + span_coupler1_head_x;
    const double l_B1_y__coupler1_theta = inverse_pivot_coupler1_theta*w_B1_y__coupler1_theta;
    const double l_crank1_theta__coupler2_theta = dot_crank1_coupler2*p->inverse_mass_coupler2_coupler2;
    const double l_B2_x__coupler2_theta = -p->inverse_mass_coupler2_coupler2*span_coupler2_head_y;
    const double l_B2_y__coupler2_theta = p->inverse_mass_coupler2_coupler2*span_coupler2_head_x;
    const double inverse_pivot_crank1_theta = 1.0/(-dot_crank1_coupler2*l_crank1_theta__coupler2_theta
        + p->mass_crank1_crank1);
    const double w_B2_x__crank1_theta = -dot_crank1_coupler2*l_B2_x__coupler2_theta - span_crank1_head_y;
    const double l_B2_x__crank1_theta = inverse_pivot_crank1_theta*w_B2_x__crank1_theta;
    const double w_B2_y__crank1_theta = -dot_crank1_coupler2*l_B2_y__coupler2_theta + span_crank1_head_x;
    const double l_B2_y__crank1_theta = inverse_pivot_crank1_theta*w_B2_y__crank1_theta;
    const double l_B1_x__crank1_theta = inverse_pivot_crank1_theta*span_crank1_head_y;
    const double l_B1_y__crank1_theta = -inverse_pivot_crank1_theta*span_crank1_head_x;
    const double scale_B2_x = -l_B2_x__coupler2_theta*span_coupler2_head_y + l_B2_x__crank1_theta*w_B2_x__crank1_theta
        + l_B2_x__crank2_theta*span_crank2_head_y;
    const double scale_B2_y = l_B2_y__coupler2_theta*span_coupler2_head_x + l_B2_y__crank1_theta*w_B2_y__crank1_theta
        - l_B2_y__crank2_theta*span_crank2_head_x;
    const double pivot_B2_x__B2_y = -l_B2_y__coupler2_theta*span_coupler2_head_y
        + l_B2_y__crank1_theta*w_B2_x__crank1_theta + l_B2_y__crank2_theta*span_crank2_head_y;
    const double determinant_B2_x__B2_y = -(pivot_B2_x__B2_y * pivot_B2_x__B2_y) + scale_B2_x*scale_B2_y;
    if (!(scale_B2_x > 0.0 && scale_B2_x < INFINITY))
        return 1;
    if (!(determinant_B2_x__B2_y > SINGULAR * scale_B2_y * scale_B2_x))
        return 2;
    const double size_B2_x = scale_B2_x + scale_B2_y;
    if (!(scale_B2_x > VANISHING * size_B2_x))
        return 1;
    if (!(determinant_B2_x__B2_y > VANISHING * size_B2_x * scale_B2_x))
        return 2;
    const double inverse_B2_x__B2_y = -1.0/determinant_B2_x__B2_y;
    const double inverse_pivot_B2_x = inverse_B2_x__B2_y*scale_B2_y;
    const double inverse_pivot_B2_y = inverse_B2_x__B2_y*scale_B2_x;
    const double inverse_cross_B2_x__B2_y = -inverse_B2_x__B2_y*pivot_B2_x__B2_y;
    const double w_B1_x__B2_x = -l_B1_x__crank1_theta*w_B2_x__crank1_theta;
    const double w_B1_x__B2_y = -l_B1_x__crank1_theta*w_B2_y__crank1_theta;
    const double l_B1_x__B2_x = inverse_cross_B2_x__B2_y*w_B1_x__B2_y + inverse_pivot_B2_x*w_B1_x__B2_x;
    const double l_B1_x__B2_y = inverse_cross_B2_x__B2_y*w_B1_x__B2_x + inverse_pivot_B2_y*w_B1_x__B2_y;
    const double w_B1_y__B2_x = -l_B1_y__crank1_theta*w_B2_x__crank1_theta;
    const double w_B1_y__B2_y = -l_B1_y__crank1_theta*w_B2_y__crank1_theta;
    const double l_B1_y__B2_x = inverse_cross_B2_x__B2_y*w_B1_y__B2_y + inverse_pivot_B2_x*w_B1_y__B2_x;
    const double l_B1_y__B2_y = inverse_cross_B2_x__B2_y*w_B1_y__B2_x + inverse_pivot_B2_y*w_B1_y__B2_y;
    const double scale_B1_x = l_B1_x__coupler1_theta*w_B1_x__coupler1_theta - l_B1_x__crank0_theta*span_crank0_head_y
        + l_B1_x__crank1_theta*span_crank1_head_y;
    const double scale_B1_y = l_B1_y__coupler1_theta*w_B1_y__coupler1_theta + l_B1_y__crank0_theta*span_crank0_head_x
        - l_B1_y__crank1_theta*span_crank1_head_x;
    const double pivot_B1_x = l_B1_x__B2_x*w_B1_x__B2_x + l_B1_x__B2_y*w_B1_x__B2_y + scale_B1_x;
    const double pivot_B1_y = l_B1_y__B2_x*w_B1_y__B2_x + l_B1_y__B2_y*w_B1_y__B2_y + scale_B1_y;
    const double pivot_B1_x__B1_y = l_B1_y__B2_x*w_B1_x__B2_x + l_B1_y__B2_y*w_B1_x__B2_y
        + l_B1_y__coupler1_theta*w_B1_x__coupler1_theta - l_B1_y__crank0_theta*span_crank0_head_y
        + l_B1_y__crank1_theta*span_crank1_head_y;
    const double determinant_B1_x__B1_y = pivot_B1_x*pivot_B1_y - (pivot_B1_x__B1_y * pivot_B1_x__B1_y);
    if (!(pivot_B1_x > SINGULAR * scale_B1_x))
        return 3;
    if (!(determinant_B1_x__B1_y > SINGULAR * scale_B1_y * pivot_B1_x))
        return 4;
    const double size_B1_x = scale_B1_x + scale_B1_y;
    if (!(pivot_B1_x > VANISHING * size_B1_x))
        return 3;
    if (!(determinant_B1_x__B1_y > VANISHING * size_B1_x * pivot_B1_x))
        return 4;
    const double inverse_B1_x__B1_y = -1.0/determinant_B1_x__B1_y;
    const double inverse_pivot_B1_x = inverse_B1_x__B1_y*pivot_B1_y;
    const double inverse_pivot_B1_y = inverse_B1_x__B1_y*pivot_B1_x;
    const double inverse_cross_B1_x__B1_y = -inverse_B1_x__B1_y*pivot_B1_x__B1_y;

    /* forward substitution */
    const double step_z_B1_x = -l_B1_x__B2_x*r_B2_x - l_B1_x__B2_y*r_B2_y + r_B1_x;
    const double step_z_B1_y = -l_B1_y__B2_x*r_B2_x - l_B1_y__B2_y*r_B2_y + r_B1_y;

    /* backward substitution */
    const double step_lambda_B1_y = inverse_cross_B1_x__B1_y*step_z_B1_x + inverse_pivot_B1_y*step_z_B1_y;
    const double step_lambda_B1_x = inverse_cross_B1_x__B1_y*step_z_B1_y + inverse_pivot_B1_x*step_z_B1_x;
    const double step_lambda_B2_y = inverse_cross_B2_x__B2_y*r_B2_x + inverse_pivot_B2_y*r_B2_y
        - l_B1_x__B2_y*step_lambda_B1_x - l_B1_y__B2_y*step_lambda_B1_y;
    const double step_lambda_B2_x = inverse_cross_B2_x__B2_y*r_B2_y + inverse_pivot_B2_x*r_B2_x
        - l_B1_x__B2_x*step_lambda_B1_x - l_B1_y__B2_x*step_lambda_B1_y;
    const double step_acceleration_crank1_theta = -l_B1_x__crank1_theta*step_lambda_B1_x
        - l_B1_y__crank1_theta*step_lambda_B1_y - l_B2_x__crank1_theta*step_lambda_B2_x
        - l_B2_y__crank1_theta*step_lambda_B2_y;
    const double step_acceleration_coupler2_theta = -l_B2_x__coupler2_theta*step_lambda_B2_x
        - l_B2_y__coupler2_theta*step_lambda_B2_y - l_crank1_theta__coupler2_theta*step_acceleration_crank1_theta;
    const double step_acceleration_coupler1_theta = -l_B1_x__coupler1_theta*step_lambda_B1_x
        - l_B1_y__coupler1_theta*step_lambda_B1_y;
    const double step_acceleration_crank0_theta = -l_B1_x__crank0_theta*step_lambda_B1_x
        - l_B1_y__crank0_theta*step_lambda_B1_y - l_coupler1_theta__crank0_theta*step_acceleration_coupler1_theta;
    const double step_acceleration_crank2_theta = -l_B2_x__crank2_theta*step_lambda_B2_x
        - l_B2_y__crank2_theta*step_lambda_B2_y;

    /* results */
    x[0] = step_acceleration_crank0_theta;
    x[1] = step_acceleration_crank1_theta;
    x[2] = step_acceleration_crank2_theta;
    x[3] = step_acceleration_coupler1_theta;
    x[4] = step_acceleration_coupler2_theta;
    return 0;
}

/* Multipliers of the closures from those of the absolute rows. */
void tree_multipliers(const double *lambda, double *closing)
{
    (void)lambda, (void)closing;
    closing[0] = + lambda[12];
    closing[1] = + lambda[13];
    closing[2] = + lambda[8];
    closing[3] = + lambda[9];
}
