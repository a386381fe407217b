/*
 * Coordinates all_q (N_Q) and velocities all_v of all bodies at tree coordinates q and rates v.
 */
void expand(const double t, const double *q, const double *v, const Parameters *p, double *all_q, double *all_v)
{
    /* coordinates, velocities, time */
    const double L6_theta = q[0];
    const double L6_omega = v[0];
    const double L2_theta = q[1];
    const double L2_omega = v[1];
    const double L3_theta = q[2];
    const double L3_omega = v[2];
    const double L7_theta = q[3];
    const double L7_omega = v[3];
    const double L8_theta = q[4];
    const double L8_omega = v[4];

    /* directions, arms, drives */
    const double crank1_value = p->omega*t - 0.689754120388159;
    const double crank4_value = p->omega4*t + 3.4814082589530893;
    const Four angles_0 = {crank1_value, crank4_value, L6_theta, L2_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {L3_theta, L7_theta, L8_theta, L8_theta};
    Four sines_1, cosines_1;
    sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_L1 = cosines_0[0];
    const double sin_theta_L1 = sines_0[0];
    const double cos_theta_L4 = cosines_0[1];
    const double sin_theta_L4 = sines_0[1];
    const double cos_theta_L6 = cosines_0[2];
    const double sin_theta_L6 = sines_0[2];
    const double cos_theta_L2 = cosines_0[3];
    const double sin_theta_L2 = sines_0[3];
    const double cos_theta_L3 = cosines_1[0];
    const double sin_theta_L3 = sines_1[0];
    const double cos_theta_L7 = cosines_1[1];
    const double sin_theta_L7 = sines_1[1];
    const double cos_theta_L8 = cosines_1[2];
    const double sin_theta_L8 = sines_1[2];
    const double crank1_rate = p->omega;
    const double crank4_rate = p->omega4;
    const double span_L1_com_x = p->L1_head_s_x*cos_theta_L1;
    const double span_L1_com_y = p->L1_head_s_x*sin_theta_L1;
    const double L1_vx = -crank1_rate*span_L1_com_y;
    const double L1_vy = crank1_rate*span_L1_com_x;
    const double span_L4_com_x = p->L4_head_s_x*cos_theta_L4;
    const double span_L4_com_y = p->L4_head_s_x*sin_theta_L4;
    const double L4_vx = -crank4_rate*span_L4_com_y;
    const double L4_y = p->O4_y + span_L4_com_y;
    const double L4_vy = crank4_rate*span_L4_com_x;
    const double span_L6_com_x = p->L6_head_s_x*cos_theta_L6;
    const double span_L6_com_y = p->L6_head_s_x*sin_theta_L6;
    const double L6_x = p->O6_x + span_L6_com_x;
    const double L6_vx = -L6_omega*span_L6_com_y;
    const double L6_vy = L6_omega*span_L6_com_x;
    const double span_L1_head_x = p->L1_head_span_x*cos_theta_L1;
    const double span_L1_head_y = p->L1_head_span_x*sin_theta_L1;
    const double L1_head_vx = -crank1_rate*span_L1_head_y;
    const double L1_head_vy = crank1_rate*span_L1_head_x;
    const double span_L2_com_x = p->L2_head_s_x*cos_theta_L2;
    const double span_L2_com_y = p->L2_head_s_x*sin_theta_L2;
    const double L2_x = span_L1_head_x + span_L2_com_x;
    const double L2_vx = L1_head_vx - L2_omega*span_L2_com_y;
    const double L2_y = span_L1_head_y + span_L2_com_y;
    const double L2_vy = L1_head_vy + L2_omega*span_L2_com_x;
    const double span_L4_head_x = p->L4_head_span_x*cos_theta_L4;
    const double span_L4_head_y = p->L4_head_span_x*sin_theta_L4;
    const double L4_head_vx = -crank4_rate*span_L4_head_y;
    const double L4_head_y = p->O4_y + span_L4_head_y;
    const double L4_head_vy = crank4_rate*span_L4_head_x;
    const double span_L3_com_x = p->L3_head_s_x*cos_theta_L3;
    const double span_L3_com_y = p->L3_head_s_x*sin_theta_L3;
    const double L3_x = span_L3_com_x + span_L4_head_x;
    const double L3_vx = -L3_omega*span_L3_com_y + L4_head_vx;
    const double L3_y = L4_head_y + span_L3_com_y;
    const double L3_vy = L3_omega*span_L3_com_x + L4_head_vy;
    const double span_L6_head_x = p->L6_head_span_x*cos_theta_L6;
    const double span_L6_head_y = p->L6_head_span_x*sin_theta_L6;
    const double L6_head_x = p->O6_x + span_L6_head_x;
    const double L6_head_vx = -L6_omega*span_L6_head_y;
    const double L6_head_vy = L6_omega*span_L6_head_x;
    const double span_L7_com_x = p->L7_com_span_x*cos_theta_L7;
    const double span_L7_com_y = p->L7_com_span_x*sin_theta_L7;
    const double L7_x = L6_head_x + span_L7_com_x;
    const double L7_vx = L6_head_vx - L7_omega*span_L7_com_y;
    const double L7_y = span_L6_head_y + span_L7_com_y;
    const double L7_vy = L6_head_vy + L7_omega*span_L7_com_x;
    const double span_L8_com_x = p->L8_head_s_x*cos_theta_L8;
    const double span_L8_com_y = p->L8_head_s_x*sin_theta_L8;
    const double L8_x = L6_head_x + span_L8_com_x;
    const double L8_vx = L6_head_vx - L8_omega*span_L8_com_y;
    const double L8_y = span_L6_head_y + span_L8_com_y;
    const double L8_vy = L6_head_vy + L8_omega*span_L8_com_x;
    const double span_L8_head_x = p->L8_head_span_x*cos_theta_L8;
    const double span_L8_head_y = p->L8_head_span_x*sin_theta_L8;
    const double L8_head_x = L6_head_x + span_L8_head_x;
    const double L8_head_vx = L6_head_vx - L8_omega*span_L8_head_y;
    const double L8_head_y = span_L6_head_y + span_L8_head_y;
    const double L8_head_vy = L6_head_vy + L8_omega*span_L8_head_x;
    const double S9_theta = PI/2.0;
    const double S9_omega = 0.0;

    /* bodies */
    all_q[0] = span_L1_com_x;
    all_v[0] = L1_vx;
    all_q[1] = span_L1_com_y;
    all_v[1] = L1_vy;
    all_q[2] = crank1_value;
    all_v[2] = crank1_rate;
    all_q[3] = L2_x;
    all_v[3] = L2_vx;
    all_q[4] = L2_y;
    all_v[4] = L2_vy;
    all_q[5] = L2_theta;
    all_v[5] = L2_omega;
    all_q[6] = L3_x;
    all_v[6] = L3_vx;
    all_q[7] = L3_y;
    all_v[7] = L3_vy;
    all_q[8] = L3_theta;
    all_v[8] = L3_omega;
    all_q[9] = span_L4_com_x;
    all_v[9] = L4_vx;
    all_q[10] = L4_y;
    all_v[10] = L4_vy;
    all_q[11] = crank4_value;
    all_v[11] = crank4_rate;
    all_q[12] = L6_x;
    all_v[12] = L6_vx;
    all_q[13] = span_L6_com_y;
    all_v[13] = L6_vy;
    all_q[14] = L6_theta;
    all_v[14] = L6_omega;
    all_q[15] = L7_x;
    all_v[15] = L7_vx;
    all_q[16] = L7_y;
    all_v[16] = L7_vy;
    all_q[17] = L7_theta;
    all_v[17] = L7_omega;
    all_q[18] = L8_x;
    all_v[18] = L8_vx;
    all_q[19] = L8_y;
    all_v[19] = L8_vy;
    all_q[20] = L8_theta;
    all_v[20] = L8_omega;
    all_q[21] = L8_head_x;
    all_v[21] = L8_head_vx;
    all_q[22] = L8_head_y;
    all_v[22] = L8_head_vy;
    all_q[23] = S9_theta;
    all_v[23] = S9_omega;
}

/*
 * Tree coordinates s and their rates of an absolute state; what the tree does not have is not looked at.
 */
void reduce_state(const double t, const double *q, const double *v, const Parameters *p, double *s, double *s_rate)
{
    (void)t, (void)p;
    /* coordinates, velocities, time */
    const double L2_theta = q[5];
    const double L2_omega = v[5];
    const double L3_theta = q[8];
    const double L3_omega = v[8];
    const double L6_theta = q[14];
    const double L6_omega = v[14];
    const double L7_theta = q[17];
    const double L7_omega = v[17];
    const double L8_theta = q[20];
    const double L8_omega = v[20];

    /* tree coordinates */
    s[0] = L6_theta;  /* L6 */
    s_rate[0] = L6_omega;
    s[1] = L2_theta;  /* L2 */
    s_rate[1] = L2_omega;
    s[2] = L3_theta;  /* L3 */
    s_rate[2] = L3_omega;
    s[3] = L7_theta;  /* L7 */
    s_rate[3] = L7_omega;
    s[4] = L8_theta;  /* L8 */
    s_rate[4] = L8_omega;
}

/*
 * Their second rates a, from absolute all_a.
 */
void reduce_accelerations(const double t, const double *q, const double *v, const double *all_a, const Parameters *p,
    double *a)
{
    (void)t, (void)q, (void)v, (void)p;
    /* tree coordinates */
    a[0] = all_a[14];  /* L6 */
    a[1] = all_a[5];  /* L2 */
    a[2] = all_a[8];  /* L3 */
    a[3] = all_a[17];  /* L7 */
    a[4] = all_a[20];  /* L8 */
}

/*
 * Phi of the loop closures in tree coordinates; m and rad.
 */
void closures(const double t, const double *q, const Parameters *p, double *out)
{
    /* coordinates, velocities, time */
    const double L6_theta = q[0];
    const double L2_theta = q[1];
    const double L3_theta = q[2];
    const double L7_theta = q[3];
    const double L8_theta = q[4];

    /* directions, arms, drives */
    const double crank1_value = p->omega*t - 0.689754120388159;
    const double crank4_value = p->omega4*t + 3.4814082589530893;
    const Four angles_0 = {crank1_value, crank4_value, L6_theta, L2_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {L3_theta, L7_theta, L8_theta, L8_theta};
    Four sines_1, cosines_1;
    sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_L1 = cosines_0[0];
    const double sin_theta_L1 = sines_0[0];
    const double cos_theta_L4 = cosines_0[1];
    const double sin_theta_L4 = sines_0[1];
    const double cos_theta_L6 = cosines_0[2];
    const double sin_theta_L6 = sines_0[2];
    const double cos_theta_L2 = cosines_0[3];
    const double sin_theta_L2 = sines_0[3];
    const double cos_theta_L3 = cosines_1[0];
    const double sin_theta_L3 = sines_1[0];
    const double cos_theta_L7 = cosines_1[1];
    const double sin_theta_L7 = sines_1[1];
    const double cos_theta_L8 = cosines_1[2];
    const double span_L1_head_x = p->L1_head_span_x*cos_theta_L1;
    const double span_L1_head_y = p->L1_head_span_x*sin_theta_L1;
    const double span_L4_head_x = p->L4_head_span_x*cos_theta_L4;
    const double span_L4_head_y = p->L4_head_span_x*sin_theta_L4;
    const double span_L6_head_x = p->L6_head_span_x*cos_theta_L6;
    const double span_L6_head_y = p->L6_head_span_x*sin_theta_L6;
    const double span_L8_head_x = p->L8_head_span_x*cos_theta_L8;
    const double span_L2_head_x = p->L2_head_span_x*cos_theta_L2;
    const double span_L2_head_y = p->L2_head_span_x*sin_theta_L2;
    const double span_L3_head_x = p->L3_head_span_x*cos_theta_L3;
    const double span_L3_head_y = p->L3_head_span_x*sin_theta_L3;
    const double span_L7_tail_x = p->L7_tail_span_x*cos_theta_L7;
    const double span_L7_tail_y = p->L7_tail_span_x*sin_theta_L7;

    /* rows */
    out[0] = -span_L6_head_x - span_L8_head_x;  /* guide.offset */
    out[1] = span_L1_head_x + span_L2_head_x - span_L3_head_x - span_L4_head_x;  /* L2.head=L3.head.x */
    out[2] = -p->O4_y + span_L1_head_y + span_L2_head_y - span_L3_head_y - span_L4_head_y;  /* L2.head=L3.head.y */
    out[3] = -p->O6_x + span_L1_head_x + span_L2_head_x - span_L6_head_x - span_L7_tail_x;  /* P2.x */
    out[4] = span_L1_head_y + span_L2_head_y - span_L6_head_y - span_L7_tail_y;  /* P2.y */
}

/*
 * Its rate Phi_q v - nu.
 */
void closure_rates(const double t, const double *q, const double *v, const Parameters *p, double *out)
{
    /* coordinates, velocities, time */
    const double L6_theta = q[0];
    const double L6_omega = v[0];
    const double L2_theta = q[1];
    const double L2_omega = v[1];
    const double L3_theta = q[2];
    const double L3_omega = v[2];
    const double L7_theta = q[3];
    const double L7_omega = v[3];
    const double L8_theta = q[4];
    const double L8_omega = v[4];

    /* directions, arms, drives */
    const double crank1_value = p->omega*t - 0.689754120388159;
    const double crank4_value = p->omega4*t + 3.4814082589530893;
    const Four angles_0 = {crank1_value, crank4_value, L6_theta, L2_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {L3_theta, L7_theta, L8_theta, L8_theta};
    Four sines_1, cosines_1;
    sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_L1 = cosines_0[0];
    const double sin_theta_L1 = sines_0[0];
    const double cos_theta_L4 = cosines_0[1];
    const double sin_theta_L4 = sines_0[1];
    const double cos_theta_L6 = cosines_0[2];
    const double sin_theta_L6 = sines_0[2];
    const double cos_theta_L2 = cosines_0[3];
    const double sin_theta_L2 = sines_0[3];
    const double cos_theta_L3 = cosines_1[0];
    const double sin_theta_L3 = sines_1[0];
    const double cos_theta_L7 = cosines_1[1];
    const double sin_theta_L7 = sines_1[1];
    const double sin_theta_L8 = sines_1[2];
    const double crank1_rate = p->omega;
    const double crank4_rate = p->omega4;
    const double span_L1_head_x = p->L1_head_span_x*cos_theta_L1;
    const double span_L1_head_y = p->L1_head_span_x*sin_theta_L1;
    const double span_L4_head_x = p->L4_head_span_x*cos_theta_L4;
    const double span_L4_head_y = p->L4_head_span_x*sin_theta_L4;
    const double span_L6_head_x = p->L6_head_span_x*cos_theta_L6;
    const double span_L6_head_y = p->L6_head_span_x*sin_theta_L6;
    const double span_L8_head_y = p->L8_head_span_x*sin_theta_L8;
    const double span_L2_head_x = p->L2_head_span_x*cos_theta_L2;
    const double span_L2_head_y = p->L2_head_span_x*sin_theta_L2;
    const double span_L3_head_x = p->L3_head_span_x*cos_theta_L3;
    const double span_L3_head_y = p->L3_head_span_x*sin_theta_L3;
    const double span_L7_tail_x = p->L7_tail_span_x*cos_theta_L7;
    const double span_L7_tail_y = p->L7_tail_span_x*sin_theta_L7;

    /* rows */
    out[0] = L6_omega*span_L6_head_y + L8_omega*span_L8_head_y;  /* guide.offset */
    /* L2.head=L3.head.x */
    out[1] = -L2_omega*span_L2_head_y + L3_omega*span_L3_head_y - crank1_rate*span_L1_head_y
        + crank4_rate*span_L4_head_y;
    /* L2.head=L3.head.y */
    out[2] = L2_omega*span_L2_head_x - L3_omega*span_L3_head_x + crank1_rate*span_L1_head_x
        - crank4_rate*span_L4_head_x;
    /* P2.x */
    out[3] = -L2_omega*span_L2_head_y + L6_omega*span_L6_head_y + L7_omega*span_L7_tail_y - crank1_rate*span_L1_head_y;
    /* P2.y */
    out[4] = L2_omega*span_L2_head_x - L6_omega*span_L6_head_x - L7_omega*span_L7_tail_x + crank1_rate*span_L1_head_x;
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
    const double L6_theta = q[0];
    const double L6_omega = v[0];
    const double L2_theta = q[1];
    const double L2_omega = v[1];
    const double L3_theta = q[2];
    const double L3_omega = v[2];
    const double L7_theta = q[3];
    const double L7_omega = v[3];
    const double L8_theta = q[4];
    const double L8_omega = v[4];

    /* directions, arms, drives */
    const double crank1_value = p->omega*t - 0.689754120388159;
    const double crank4_value = p->omega4*t + 3.4814082589530893;
    const Four angles_0 = {crank1_value, crank4_value, L6_theta, L2_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {L3_theta, L7_theta, L8_theta, L8_theta};
    Four sines_1, cosines_1;
    sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_L1 = cosines_0[0];
    const double sin_theta_L1 = sines_0[0];
    const double cos_theta_L4 = cosines_0[1];
    const double sin_theta_L4 = sines_0[1];
    const double cos_theta_L6 = cosines_0[2];
    const double sin_theta_L6 = sines_0[2];
    const double cos_theta_L2 = cosines_0[3];
    const double sin_theta_L2 = sines_0[3];
    const double cos_theta_L3 = cosines_1[0];
    const double sin_theta_L3 = sines_1[0];
    const double cos_theta_L7 = cosines_1[1];
    const double sin_theta_L7 = sines_1[1];
    const double cos_theta_L8 = cosines_1[2];
    const double sin_theta_L8 = sines_1[2];
    const double crank1_rate = p->omega;
    const double crank1_acceleration = 0.0;
    const double crank4_rate = p->omega4;
    const double crank4_acceleration = 0.0;
    const double span_L1_head_x = p->L1_head_span_x*cos_theta_L1;
    const double span_L1_head_y = p->L1_head_span_x*sin_theta_L1;
    const double span_L4_head_x = p->L4_head_span_x*cos_theta_L4;
    const double span_L4_head_y = p->L4_head_span_x*sin_theta_L4;
    const double span_L6_head_x = p->L6_head_span_x*cos_theta_L6;
    const double span_L6_head_y = p->L6_head_span_x*sin_theta_L6;
    const double span_L8_head_x = p->L8_head_span_x*cos_theta_L8;
    const double span_L8_head_y = p->L8_head_span_x*sin_theta_L8;
    const double span_L2_head_x = p->L2_head_span_x*cos_theta_L2;
    const double span_L2_head_y = p->L2_head_span_x*sin_theta_L2;
    const double span_L3_head_x = p->L3_head_span_x*cos_theta_L3;
    const double span_L3_head_y = p->L3_head_span_x*sin_theta_L3;
    const double span_L7_tail_x = p->L7_tail_span_x*cos_theta_L7;
    const double span_L7_tail_y = p->L7_tail_span_x*sin_theta_L7;
    const double cos_L2_less_L1 = cos_theta_L1*cos_theta_L2 + sin_theta_L1*sin_theta_L2;
    const double sin_L2_less_L1 = cos_theta_L1*sin_theta_L2 - cos_theta_L2*sin_theta_L1;
    const double dot_L1_L2 = cos_L2_less_L1*p->inertia_L1_L2;
    const double cross_L1_L2 = p->inertia_L1_L2*sin_L2_less_L1;
    const double cos_L3_less_L4 = cos_theta_L3*cos_theta_L4 + sin_theta_L3*sin_theta_L4;
    const double sin_L3_less_L4 = -cos_theta_L3*sin_theta_L4 + cos_theta_L4*sin_theta_L3;
    const double dot_L4_L3 = cos_L3_less_L4*p->inertia_L4_L3;
    const double cross_L4_L3 = p->inertia_L4_L3*sin_L3_less_L4;
    const double cos_L7_less_L6 = cos_theta_L6*cos_theta_L7 + sin_theta_L6*sin_theta_L7;
    const double sin_L7_less_L6 = cos_theta_L6*sin_theta_L7 - cos_theta_L7*sin_theta_L6;
    const double dot_L6_L7 = cos_L7_less_L6*p->inertia_L6_L7;
    const double cross_L6_L7 = p->inertia_L6_L7*sin_L7_less_L6;
    const double cos_L8_less_L6 = cos_theta_L6*cos_theta_L8 + sin_theta_L6*sin_theta_L8;
    const double sin_L8_less_L6 = cos_theta_L6*sin_theta_L8 - cos_theta_L8*sin_theta_L6;
    const double dot_L6_L8 = cos_L8_less_L6*p->inertia_L6_L8;
    const double cross_L6_L8 = p->inertia_L6_L8*sin_L8_less_L6;

    /* status */
    int pivot = 0;

    /* constraints: gamma */
    const double rhs_guide_offset = -(L6_omega * L6_omega)*span_L6_head_x - (L8_omega * L8_omega)*span_L8_head_x;
    const double rhs_L2_head_L3_head_x = (L2_omega * L2_omega)*span_L2_head_x - (L3_omega * L3_omega)*span_L3_head_x
        + crank1_acceleration*span_L1_head_y + (crank1_rate * crank1_rate)*span_L1_head_x
        - crank4_acceleration*span_L4_head_y - (crank4_rate * crank4_rate)*span_L4_head_x;
    const double rhs_L2_head_L3_head_y = (L2_omega * L2_omega)*span_L2_head_y - (L3_omega * L3_omega)*span_L3_head_y
        - crank1_acceleration*span_L1_head_x + (crank1_rate * crank1_rate)*span_L1_head_y
        + crank4_acceleration*span_L4_head_x - (crank4_rate * crank4_rate)*span_L4_head_y;
    const double rhs_P2_x = (L2_omega * L2_omega)*span_L2_head_x - (L6_omega * L6_omega)*span_L6_head_x
        - (L7_omega * L7_omega)*span_L7_tail_x + crank1_acceleration*span_L1_head_y
        + (crank1_rate * crank1_rate)*span_L1_head_x;
    const double rhs_P2_y = (L2_omega * L2_omega)*span_L2_head_y - (L6_omega * L6_omega)*span_L6_head_y
        - (L7_omega * L7_omega)*span_L7_tail_y - crank1_acceleration*span_L1_head_x
        + (crank1_rate * crank1_rate)*span_L1_head_y;

    /* L D L^T of the KKT matrix */
    const double l_L2_head_L3_head_x__L3_theta = p->inverse_mass_L3_L3*span_L3_head_y;
    const double l_L2_head_L3_head_y__L3_theta = -p->inverse_mass_L3_L3*span_L3_head_x;
    const double l_L6_theta__L8_theta = dot_L6_L8*p->inverse_mass_L8_L8;
    const double l_guide_offset__L8_theta = p->inverse_mass_L8_L8*span_L8_head_y;
    const double l_L6_theta__L7_theta = dot_L6_L7*p->inverse_mass_L7_L7;
    const double l_P2_x__L7_theta = p->inverse_mass_L7_L7*span_L7_tail_y;
    const double l_P2_y__L7_theta = -p->inverse_mass_L7_L7*span_L7_tail_x;
    const double inverse_pivot_L6_theta = 1.0/(-dot_L6_L7*l_L6_theta__L7_theta - dot_L6_L8*l_L6_theta__L8_theta
        + p->mass_L6_L6);
    const double w_guide_offset__L6_theta = -dot_L6_L8*l_guide_offset__L8_theta + span_L6_head_y;
    const double l_guide_offset__L6_theta = inverse_pivot_L6_theta*w_guide_offset__L6_theta;
    const double w_P2_x__L6_theta = -dot_L6_L7*l_P2_x__L7_theta + span_L6_head_y;
    const double l_P2_x__L6_theta = inverse_pivot_L6_theta*w_P2_x__L6_theta;
    const double w_P2_y__L6_theta = -dot_L6_L7*l_P2_y__L7_theta - span_L6_head_x;
    const double l_P2_y__L6_theta = inverse_pivot_L6_theta*w_P2_y__L6_theta;
    const double scale_guide_offset = l_guide_offset__L6_theta*w_guide_offset__L6_theta
        + l_guide_offset__L8_theta*span_L8_head_y;
    if (!(scale_guide_offset > 0.0 && scale_guide_offset < INFINITY)) {
        pivot = 1;
        goto dependent;
    }
    const double inverse_pivot_guide_offset = 1.0/scale_guide_offset;
    const double w_P2_x__guide_offset = -l_P2_x__L6_theta*w_guide_offset__L6_theta;
    const double l_P2_x__guide_offset = -inverse_pivot_guide_offset*w_P2_x__guide_offset;
    const double w_P2_y__guide_offset = -l_P2_y__L6_theta*w_guide_offset__L6_theta;
    const double l_P2_y__guide_offset = -inverse_pivot_guide_offset*w_P2_y__guide_offset;
    const double l_L2_head_L3_head_x__L2_theta = -p->inverse_mass_L2_L2*span_L2_head_y;
    const double l_L2_head_L3_head_y__L2_theta = p->inverse_mass_L2_L2*span_L2_head_x;
    const double l_P2_x__L2_theta = -p->inverse_mass_L2_L2*span_L2_head_y;
    const double l_P2_y__L2_theta = p->inverse_mass_L2_L2*span_L2_head_x;
    const double scale_L2_head_L3_head_x = -l_L2_head_L3_head_x__L2_theta*span_L2_head_y
        + l_L2_head_L3_head_x__L3_theta*span_L3_head_y;
    const double scale_L2_head_L3_head_y = l_L2_head_L3_head_y__L2_theta*span_L2_head_x
        - l_L2_head_L3_head_y__L3_theta*span_L3_head_x;
    const double pivot_L2_head_L3_head_x__L2_head_L3_head_y = -l_L2_head_L3_head_y__L2_theta*span_L2_head_y
        + l_L2_head_L3_head_y__L3_theta*span_L3_head_y;
    const double determinant_L2_head_L3_head_x__L2_head_L3_head_y =
        -(pivot_L2_head_L3_head_x__L2_head_L3_head_y * pivot_L2_head_L3_head_x__L2_head_L3_head_y)
        + scale_L2_head_L3_head_x*scale_L2_head_L3_head_y;
    if (!(scale_L2_head_L3_head_x > 0.0 && scale_L2_head_L3_head_x < INFINITY)) {
        pivot = 2;
        goto dependent;
    }
    if (!(determinant_L2_head_L3_head_x__L2_head_L3_head_y > memory->least * scale_L2_head_L3_head_y
        * scale_L2_head_L3_head_x)) {
        pivot = 3;
        goto dependent;
    }
    const double size_L2_head_L3_head_x = scale_L2_head_L3_head_x + scale_L2_head_L3_head_y;
    if (!(scale_L2_head_L3_head_x > memory->least_size * size_L2_head_L3_head_x)) {
        pivot = 2;
        goto dependent;
    }
    if (!(determinant_L2_head_L3_head_x__L2_head_L3_head_y > memory->least_size * size_L2_head_L3_head_x
        * scale_L2_head_L3_head_x)) {
        pivot = 3;
        goto dependent;
    }
    const double inverse_L2_head_L3_head_x__L2_head_L3_head_y = -1.0/determinant_L2_head_L3_head_x__L2_head_L3_head_y;
    const double inverse_pivot_L2_head_L3_head_x = inverse_L2_head_L3_head_x__L2_head_L3_head_y*scale_L2_head_L3_head_y;
    const double inverse_pivot_L2_head_L3_head_y = inverse_L2_head_L3_head_x__L2_head_L3_head_y*scale_L2_head_L3_head_x;
    const double inverse_cross_L2_head_L3_head_x__L2_head_L3_head_y =
        -inverse_L2_head_L3_head_x__L2_head_L3_head_y*pivot_L2_head_L3_head_x__L2_head_L3_head_y;
    const double w_P2_x__L2_head_L3_head_x = l_P2_x__L2_theta*span_L2_head_y;
    const double w_P2_x__L2_head_L3_head_y = -l_P2_x__L2_theta*span_L2_head_x;
    const double l_P2_x__L2_head_L3_head_x = inverse_cross_L2_head_L3_head_x__L2_head_L3_head_y
        *w_P2_x__L2_head_L3_head_y + inverse_pivot_L2_head_L3_head_x*w_P2_x__L2_head_L3_head_x;
    const double l_P2_x__L2_head_L3_head_y = inverse_cross_L2_head_L3_head_x__L2_head_L3_head_y
        *w_P2_x__L2_head_L3_head_x + inverse_pivot_L2_head_L3_head_y*w_P2_x__L2_head_L3_head_y;
    const double w_P2_y__L2_head_L3_head_x = l_P2_y__L2_theta*span_L2_head_y;
    const double w_P2_y__L2_head_L3_head_y = -l_P2_y__L2_theta*span_L2_head_x;
    const double l_P2_y__L2_head_L3_head_x = inverse_cross_L2_head_L3_head_x__L2_head_L3_head_y
        *w_P2_y__L2_head_L3_head_y + inverse_pivot_L2_head_L3_head_x*w_P2_y__L2_head_L3_head_x;
    const double l_P2_y__L2_head_L3_head_y = inverse_cross_L2_head_L3_head_x__L2_head_L3_head_y
        *w_P2_y__L2_head_L3_head_x + inverse_pivot_L2_head_L3_head_y*w_P2_y__L2_head_L3_head_y;
    const double scale_P2_x = -l_P2_x__L2_theta*span_L2_head_y + l_P2_x__L6_theta*w_P2_x__L6_theta
        + l_P2_x__L7_theta*span_L7_tail_y;
    const double scale_P2_y = l_P2_y__L2_theta*span_L2_head_x + l_P2_y__L6_theta*w_P2_y__L6_theta
        - l_P2_y__L7_theta*span_L7_tail_x;
    const double pivot_P2_x = l_P2_x__L2_head_L3_head_x*w_P2_x__L2_head_L3_head_x
        + l_P2_x__L2_head_L3_head_y*w_P2_x__L2_head_L3_head_y + l_P2_x__guide_offset*w_P2_x__guide_offset + scale_P2_x;
    const double pivot_P2_y = l_P2_y__L2_head_L3_head_x*w_P2_y__L2_head_L3_head_x
        + l_P2_y__L2_head_L3_head_y*w_P2_y__L2_head_L3_head_y + l_P2_y__guide_offset*w_P2_y__guide_offset + scale_P2_y;
    const double pivot_P2_x__P2_y = l_P2_y__L2_head_L3_head_x*w_P2_x__L2_head_L3_head_x
        + l_P2_y__L2_head_L3_head_y*w_P2_x__L2_head_L3_head_y - l_P2_y__L2_theta*span_L2_head_y
        + l_P2_y__L6_theta*w_P2_x__L6_theta + l_P2_y__L7_theta*span_L7_tail_y
        + l_P2_y__guide_offset*w_P2_x__guide_offset;
    const double determinant_P2_x__P2_y = pivot_P2_x*pivot_P2_y - (pivot_P2_x__P2_y * pivot_P2_x__P2_y);
    if (!(pivot_P2_x > memory->least * scale_P2_x)) {
        pivot = 4;
        goto dependent;
    }
    if (!(determinant_P2_x__P2_y > memory->least * scale_P2_y * pivot_P2_x)) {
        pivot = 5;
        goto dependent;
    }
    const double size_P2_x = scale_P2_x + scale_P2_y;
    if (!(pivot_P2_x > memory->least_size * size_P2_x)) {
        pivot = 4;
        goto dependent;
    }
    if (!(determinant_P2_x__P2_y > memory->least_size * size_P2_x * pivot_P2_x)) {
        pivot = 5;
        goto dependent;
    }
    const double inverse_P2_x__P2_y = -1.0/determinant_P2_x__P2_y;
    const double inverse_pivot_P2_x = inverse_P2_x__P2_y*pivot_P2_y;
    const double inverse_pivot_P2_y = inverse_P2_x__P2_y*pivot_P2_x;
    const double inverse_cross_P2_x__P2_y = -inverse_P2_x__P2_y*pivot_P2_x__P2_y;

    /* forward substitution */
    const double z_L3_theta = cos_theta_L3*p->weight_L3__across - crank4_acceleration*dot_L4_L3
        - (crank4_rate * crank4_rate)*cross_L4_L3;
    const double z_L8_theta = -(L6_omega * L6_omega)*cross_L6_L8 + cos_theta_L8*p->weight_L8__across;
    const double z_L7_theta = -(L6_omega * L6_omega)*cross_L6_L7 + cos_theta_L7*p->weight_L7__across;
    const double z_L6_theta = (L7_omega * L7_omega)*cross_L6_L7 + (L8_omega * L8_omega)*cross_L6_L8
        + cos_theta_L6*p->weight_L6__across - l_L6_theta__L7_theta*z_L7_theta - l_L6_theta__L8_theta*z_L8_theta;
    const double z_guide_offset = -l_guide_offset__L6_theta*z_L6_theta - l_guide_offset__L8_theta*z_L8_theta
        + rhs_guide_offset;
    const double z_L2_theta = cos_theta_L2*p->weight_L2__across - crank1_acceleration*dot_L1_L2
        - (crank1_rate * crank1_rate)*cross_L1_L2;
    const double z_L2_head_L3_head_x = -l_L2_head_L3_head_x__L2_theta*z_L2_theta
        - l_L2_head_L3_head_x__L3_theta*z_L3_theta + rhs_L2_head_L3_head_x;
    const double z_L2_head_L3_head_y = -l_L2_head_L3_head_y__L2_theta*z_L2_theta
        - l_L2_head_L3_head_y__L3_theta*z_L3_theta + rhs_L2_head_L3_head_y;
    const double z_P2_x = -l_P2_x__L2_head_L3_head_x*z_L2_head_L3_head_x
        - l_P2_x__L2_head_L3_head_y*z_L2_head_L3_head_y - l_P2_x__L2_theta*z_L2_theta - l_P2_x__L6_theta*z_L6_theta
        - l_P2_x__L7_theta*z_L7_theta - l_P2_x__guide_offset*z_guide_offset + rhs_P2_x;
    const double z_P2_y = -l_P2_y__L2_head_L3_head_x*z_L2_head_L3_head_x
        - l_P2_y__L2_head_L3_head_y*z_L2_head_L3_head_y - l_P2_y__L2_theta*z_L2_theta - l_P2_y__L6_theta*z_L6_theta
        - l_P2_y__L7_theta*z_L7_theta - l_P2_y__guide_offset*z_guide_offset + rhs_P2_y;

    /* backward substitution */
    const double lambda_P2_y = inverse_cross_P2_x__P2_y*z_P2_x + inverse_pivot_P2_y*z_P2_y;
    const double lambda_P2_x = inverse_cross_P2_x__P2_y*z_P2_y + inverse_pivot_P2_x*z_P2_x;
    const double lambda_L2_head_L3_head_y = inverse_cross_L2_head_L3_head_x__L2_head_L3_head_y*z_L2_head_L3_head_x
        + inverse_pivot_L2_head_L3_head_y*z_L2_head_L3_head_y - l_P2_x__L2_head_L3_head_y*lambda_P2_x
        - l_P2_y__L2_head_L3_head_y*lambda_P2_y;
    const double lambda_L2_head_L3_head_x = inverse_cross_L2_head_L3_head_x__L2_head_L3_head_y*z_L2_head_L3_head_y
        + inverse_pivot_L2_head_L3_head_x*z_L2_head_L3_head_x - l_P2_x__L2_head_L3_head_x*lambda_P2_x
        - l_P2_y__L2_head_L3_head_x*lambda_P2_y;
    const double acceleration_L2_theta = p->inverse_mass_L2_L2*z_L2_theta
        - l_L2_head_L3_head_x__L2_theta*lambda_L2_head_L3_head_x
        - l_L2_head_L3_head_y__L2_theta*lambda_L2_head_L3_head_y - l_P2_x__L2_theta*lambda_P2_x
        - l_P2_y__L2_theta*lambda_P2_y;
    const double lambda_guide_offset = -inverse_pivot_guide_offset*z_guide_offset - l_P2_x__guide_offset*lambda_P2_x
        - l_P2_y__guide_offset*lambda_P2_y;
    const double acceleration_L6_theta = inverse_pivot_L6_theta*z_L6_theta - l_P2_x__L6_theta*lambda_P2_x
        - l_P2_y__L6_theta*lambda_P2_y - l_guide_offset__L6_theta*lambda_guide_offset;
    const double acceleration_L7_theta = -acceleration_L6_theta*l_L6_theta__L7_theta + p->inverse_mass_L7_L7*z_L7_theta
        - l_P2_x__L7_theta*lambda_P2_x - l_P2_y__L7_theta*lambda_P2_y;
    const double acceleration_L8_theta = -acceleration_L6_theta*l_L6_theta__L8_theta + p->inverse_mass_L8_L8*z_L8_theta
        - l_guide_offset__L8_theta*lambda_guide_offset;
    const double acceleration_L3_theta = p->inverse_mass_L3_L3*z_L3_theta
        - l_L2_head_L3_head_x__L3_theta*lambda_L2_head_L3_head_x
        - l_L2_head_L3_head_y__L3_theta*lambda_L2_head_L3_head_y;

    /* results */
    a[0] = acceleration_L6_theta;
    a[1] = acceleration_L2_theta;
    a[2] = acceleration_L3_theta;
    a[3] = acceleration_L7_theta;
    a[4] = acceleration_L8_theta;
    aside->lambda[0] = lambda_guide_offset;
    aside->lambda[1] = lambda_L2_head_L3_head_x;
    aside->lambda[2] = lambda_L2_head_L3_head_y;
    aside->lambda[3] = lambda_P2_x;
    aside->lambda[4] = lambda_P2_y;
    goto powers;

    /* a pivot vanished: rows depend on each other here */
    dependent:
    pivot = solve_by_absolute(t, q, v, memory, p, a, aside);
    powers:
    aside->power[0] = -aside->lambda[1]*(crank1_rate*span_L1_head_y - crank4_rate*span_L4_head_y)
        - aside->lambda[2]*(-crank1_rate*span_L1_head_x + crank4_rate*span_L4_head_x)
        - aside->lambda[3]*crank1_rate*span_L1_head_y + aside->lambda[4]*crank1_rate*span_L1_head_x
        + crank1_rate*(-(L2_omega * L2_omega)*cross_L1_L2 + a[1]*dot_L1_L2 - cos_theta_L1*p->weight_L1__across
        + crank1_acceleration*p->mass_crank1_crank1) + crank4_rate*(-(L3_omega * L3_omega)*cross_L4_L3 + a[2]*dot_L4_L3
        - cos_theta_L4*p->weight_L4__across + crank4_acceleration*p->mass_crank4_crank4);
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
    const double L6_theta = q[0];
    const double L2_theta = q[1];
    const double L3_theta = q[2];
    const double L7_theta = q[3];
    const double L8_theta = q[4];

    /* directions, arms, drives */
    const Four angles_0 = {L6_theta, L2_theta, L3_theta, L7_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {L8_theta, L8_theta, L8_theta, L8_theta};
    Four sines_1, cosines_1;
    sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_L6 = cosines_0[0];
    const double sin_theta_L6 = sines_0[0];
    const double cos_theta_L2 = cosines_0[1];
    const double sin_theta_L2 = sines_0[1];
    const double cos_theta_L3 = cosines_0[2];
    const double sin_theta_L3 = sines_0[2];
    const double cos_theta_L7 = cosines_0[3];
    const double sin_theta_L7 = sines_0[3];
    const double cos_theta_L8 = cosines_1[0];
    const double sin_theta_L8 = sines_1[0];
    const double span_L6_head_x = p->L6_head_span_x*cos_theta_L6;
    const double span_L6_head_y = p->L6_head_span_x*sin_theta_L6;
    const double span_L8_head_y = p->L8_head_span_x*sin_theta_L8;
    const double span_L2_head_x = p->L2_head_span_x*cos_theta_L2;
    const double span_L2_head_y = p->L2_head_span_x*sin_theta_L2;
    const double span_L3_head_x = p->L3_head_span_x*cos_theta_L3;
    const double span_L3_head_y = p->L3_head_span_x*sin_theta_L3;
    const double span_L7_tail_x = p->L7_tail_span_x*cos_theta_L7;
    const double span_L7_tail_y = p->L7_tail_span_x*sin_theta_L7;
    const double cos_L7_less_L6 = cos_theta_L6*cos_theta_L7 + sin_theta_L6*sin_theta_L7;
    const double dot_L6_L7 = cos_L7_less_L6*p->inertia_L6_L7;
    const double cos_L8_less_L6 = cos_theta_L6*cos_theta_L8 + sin_theta_L6*sin_theta_L8;
    const double dot_L6_L8 = cos_L8_less_L6*p->inertia_L6_L8;

    /* right-hand side */
    const double r_guide_offset = r[0];
    const double r_L2_head_L3_head_x = r[1];
    const double r_L2_head_L3_head_y = r[2];
    const double r_P2_x = r[3];
    const double r_P2_y = r[4];

    /* L D L^T of the KKT matrix */
    const double l_L2_head_L3_head_x__L3_theta = p->inverse_mass_L3_L3*span_L3_head_y;
    const double l_L2_head_L3_head_y__L3_theta = -p->inverse_mass_L3_L3*span_L3_head_x;
    const double l_L6_theta__L8_theta = dot_L6_L8*p->inverse_mass_L8_L8;
    const double l_guide_offset__L8_theta = p->inverse_mass_L8_L8*span_L8_head_y;
    const double l_L6_theta__L7_theta = dot_L6_L7*p->inverse_mass_L7_L7;
    const double l_P2_x__L7_theta = p->inverse_mass_L7_L7*span_L7_tail_y;
    const double l_P2_y__L7_theta = -p->inverse_mass_L7_L7*span_L7_tail_x;
    const double inverse_pivot_L6_theta = 1.0/(-dot_L6_L7*l_L6_theta__L7_theta - dot_L6_L8*l_L6_theta__L8_theta
        + p->mass_L6_L6);
    const double w_guide_offset__L6_theta = -dot_L6_L8*l_guide_offset__L8_theta + span_L6_head_y;
    const double l_guide_offset__L6_theta = inverse_pivot_L6_theta*w_guide_offset__L6_theta;
    const double w_P2_x__L6_theta = -dot_L6_L7*l_P2_x__L7_theta + span_L6_head_y;
    const double l_P2_x__L6_theta = inverse_pivot_L6_theta*w_P2_x__L6_theta;
    const double w_P2_y__L6_theta = -dot_L6_L7*l_P2_y__L7_theta - span_L6_head_x;
    const double l_P2_y__L6_theta = inverse_pivot_L6_theta*w_P2_y__L6_theta;
    const double scale_guide_offset = l_guide_offset__L6_theta*w_guide_offset__L6_theta
        + l_guide_offset__L8_theta*span_L8_head_y;
    if (!(scale_guide_offset > 0.0 && scale_guide_offset < INFINITY))
        return 1;
    const double inverse_pivot_guide_offset = 1.0/scale_guide_offset;
    const double w_P2_x__guide_offset = -l_P2_x__L6_theta*w_guide_offset__L6_theta;
    const double l_P2_x__guide_offset = -inverse_pivot_guide_offset*w_P2_x__guide_offset;
    const double w_P2_y__guide_offset = -l_P2_y__L6_theta*w_guide_offset__L6_theta;
    const double l_P2_y__guide_offset = -inverse_pivot_guide_offset*w_P2_y__guide_offset;
    const double l_L2_head_L3_head_x__L2_theta = -p->inverse_mass_L2_L2*span_L2_head_y;
    const double l_L2_head_L3_head_y__L2_theta = p->inverse_mass_L2_L2*span_L2_head_x;
    const double l_P2_x__L2_theta = -p->inverse_mass_L2_L2*span_L2_head_y;
    const double l_P2_y__L2_theta = p->inverse_mass_L2_L2*span_L2_head_x;
    const double scale_L2_head_L3_head_x = -l_L2_head_L3_head_x__L2_theta*span_L2_head_y
        + l_L2_head_L3_head_x__L3_theta*span_L3_head_y;
    const double scale_L2_head_L3_head_y = l_L2_head_L3_head_y__L2_theta*span_L2_head_x
        - l_L2_head_L3_head_y__L3_theta*span_L3_head_x;
    const double pivot_L2_head_L3_head_x__L2_head_L3_head_y = -l_L2_head_L3_head_y__L2_theta*span_L2_head_y
        + l_L2_head_L3_head_y__L3_theta*span_L3_head_y;
    const double determinant_L2_head_L3_head_x__L2_head_L3_head_y =
        -(pivot_L2_head_L3_head_x__L2_head_L3_head_y * pivot_L2_head_L3_head_x__L2_head_L3_head_y)
        + scale_L2_head_L3_head_x*scale_L2_head_L3_head_y;
    if (!(scale_L2_head_L3_head_x > 0.0 && scale_L2_head_L3_head_x < INFINITY))
        return 2;
    if (!(determinant_L2_head_L3_head_x__L2_head_L3_head_y > SINGULAR * scale_L2_head_L3_head_y
        * scale_L2_head_L3_head_x))
        return 3;
    const double size_L2_head_L3_head_x = scale_L2_head_L3_head_x + scale_L2_head_L3_head_y;
    if (!(scale_L2_head_L3_head_x > VANISHING * size_L2_head_L3_head_x))
        return 2;
    if (!(determinant_L2_head_L3_head_x__L2_head_L3_head_y > VANISHING * size_L2_head_L3_head_x
        * scale_L2_head_L3_head_x))
        return 3;
    const double inverse_L2_head_L3_head_x__L2_head_L3_head_y = -1.0/determinant_L2_head_L3_head_x__L2_head_L3_head_y;
    const double inverse_pivot_L2_head_L3_head_x = inverse_L2_head_L3_head_x__L2_head_L3_head_y*scale_L2_head_L3_head_y;
    const double inverse_pivot_L2_head_L3_head_y = inverse_L2_head_L3_head_x__L2_head_L3_head_y*scale_L2_head_L3_head_x;
    const double inverse_cross_L2_head_L3_head_x__L2_head_L3_head_y =
        -inverse_L2_head_L3_head_x__L2_head_L3_head_y*pivot_L2_head_L3_head_x__L2_head_L3_head_y;
    const double w_P2_x__L2_head_L3_head_x = l_P2_x__L2_theta*span_L2_head_y;
    const double w_P2_x__L2_head_L3_head_y = -l_P2_x__L2_theta*span_L2_head_x;
    const double l_P2_x__L2_head_L3_head_x = inverse_cross_L2_head_L3_head_x__L2_head_L3_head_y
        *w_P2_x__L2_head_L3_head_y + inverse_pivot_L2_head_L3_head_x*w_P2_x__L2_head_L3_head_x;
    const double l_P2_x__L2_head_L3_head_y = inverse_cross_L2_head_L3_head_x__L2_head_L3_head_y
        *w_P2_x__L2_head_L3_head_x + inverse_pivot_L2_head_L3_head_y*w_P2_x__L2_head_L3_head_y;
    const double w_P2_y__L2_head_L3_head_x = l_P2_y__L2_theta*span_L2_head_y;
    const double w_P2_y__L2_head_L3_head_y = -l_P2_y__L2_theta*span_L2_head_x;
    const double l_P2_y__L2_head_L3_head_x = inverse_cross_L2_head_L3_head_x__L2_head_L3_head_y
        *w_P2_y__L2_head_L3_head_y + inverse_pivot_L2_head_L3_head_x*w_P2_y__L2_head_L3_head_x;
    const double l_P2_y__L2_head_L3_head_y = inverse_cross_L2_head_L3_head_x__L2_head_L3_head_y
        *w_P2_y__L2_head_L3_head_x + inverse_pivot_L2_head_L3_head_y*w_P2_y__L2_head_L3_head_y;
    const double scale_P2_x = -l_P2_x__L2_theta*span_L2_head_y + l_P2_x__L6_theta*w_P2_x__L6_theta
        + l_P2_x__L7_theta*span_L7_tail_y;
    const double scale_P2_y = l_P2_y__L2_theta*span_L2_head_x + l_P2_y__L6_theta*w_P2_y__L6_theta
        - l_P2_y__L7_theta*span_L7_tail_x;
    const double pivot_P2_x = l_P2_x__L2_head_L3_head_x*w_P2_x__L2_head_L3_head_x
        + l_P2_x__L2_head_L3_head_y*w_P2_x__L2_head_L3_head_y + l_P2_x__guide_offset*w_P2_x__guide_offset + scale_P2_x;
    const double pivot_P2_y = l_P2_y__L2_head_L3_head_x*w_P2_y__L2_head_L3_head_x
        + l_P2_y__L2_head_L3_head_y*w_P2_y__L2_head_L3_head_y + l_P2_y__guide_offset*w_P2_y__guide_offset + scale_P2_y;
    const double pivot_P2_x__P2_y = l_P2_y__L2_head_L3_head_x*w_P2_x__L2_head_L3_head_x
        + l_P2_y__L2_head_L3_head_y*w_P2_x__L2_head_L3_head_y - l_P2_y__L2_theta*span_L2_head_y
        + l_P2_y__L6_theta*w_P2_x__L6_theta + l_P2_y__L7_theta*span_L7_tail_y
        + l_P2_y__guide_offset*w_P2_x__guide_offset;
    const double determinant_P2_x__P2_y = pivot_P2_x*pivot_P2_y - (pivot_P2_x__P2_y * pivot_P2_x__P2_y);
    if (!(pivot_P2_x > SINGULAR * scale_P2_x))
        return 4;
    if (!(determinant_P2_x__P2_y > SINGULAR * scale_P2_y * pivot_P2_x))
        return 5;
    const double size_P2_x = scale_P2_x + scale_P2_y;
    if (!(pivot_P2_x > VANISHING * size_P2_x))
        return 4;
    if (!(determinant_P2_x__P2_y > VANISHING * size_P2_x * pivot_P2_x))
        return 5;
    const double inverse_P2_x__P2_y = -1.0/determinant_P2_x__P2_y;
    const double inverse_pivot_P2_x = inverse_P2_x__P2_y*pivot_P2_y;
    const double inverse_pivot_P2_y = inverse_P2_x__P2_y*pivot_P2_x;
    const double inverse_cross_P2_x__P2_y = -inverse_P2_x__P2_y*pivot_P2_x__P2_y;

    /* forward substitution */
    const double step_z_P2_x = -l_P2_x__L2_head_L3_head_x*r_L2_head_L3_head_x
        - l_P2_x__L2_head_L3_head_y*r_L2_head_L3_head_y - l_P2_x__guide_offset*r_guide_offset + r_P2_x;
    const double step_z_P2_y = -l_P2_y__L2_head_L3_head_x*r_L2_head_L3_head_x
        - l_P2_y__L2_head_L3_head_y*r_L2_head_L3_head_y - l_P2_y__guide_offset*r_guide_offset + r_P2_y;

    /* backward substitution */
    const double step_lambda_P2_y = inverse_cross_P2_x__P2_y*step_z_P2_x + inverse_pivot_P2_y*step_z_P2_y;
    const double step_lambda_P2_x = inverse_cross_P2_x__P2_y*step_z_P2_y + inverse_pivot_P2_x*step_z_P2_x;
    const double step_lambda_L2_head_L3_head_y = inverse_cross_L2_head_L3_head_x__L2_head_L3_head_y*r_L2_head_L3_head_x
        + inverse_pivot_L2_head_L3_head_y*r_L2_head_L3_head_y - l_P2_x__L2_head_L3_head_y*step_lambda_P2_x
        - l_P2_y__L2_head_L3_head_y*step_lambda_P2_y;
    const double step_lambda_L2_head_L3_head_x = inverse_cross_L2_head_L3_head_x__L2_head_L3_head_y*r_L2_head_L3_head_y
        + inverse_pivot_L2_head_L3_head_x*r_L2_head_L3_head_x - l_P2_x__L2_head_L3_head_x*step_lambda_P2_x
        - l_P2_y__L2_head_L3_head_x*step_lambda_P2_y;
    const double step_acceleration_L2_theta = -l_L2_head_L3_head_x__L2_theta*step_lambda_L2_head_L3_head_x
        - l_L2_head_L3_head_y__L2_theta*step_lambda_L2_head_L3_head_y - l_P2_x__L2_theta*step_lambda_P2_x
        - l_P2_y__L2_theta*step_lambda_P2_y;
    const double step_lambda_guide_offset = -inverse_pivot_guide_offset*r_guide_offset
        - l_P2_x__guide_offset*step_lambda_P2_x - l_P2_y__guide_offset*step_lambda_P2_y;
    const double step_acceleration_L6_theta = -l_P2_x__L6_theta*step_lambda_P2_x - l_P2_y__L6_theta*step_lambda_P2_y
        - l_guide_offset__L6_theta*step_lambda_guide_offset;
    const double step_acceleration_L7_theta = -l_L6_theta__L7_theta*step_acceleration_L6_theta
        - l_P2_x__L7_theta*step_lambda_P2_x - l_P2_y__L7_theta*step_lambda_P2_y;
    const double step_acceleration_L8_theta = -l_L6_theta__L8_theta*step_acceleration_L6_theta
        - l_guide_offset__L8_theta*step_lambda_guide_offset;
    const double step_acceleration_L3_theta = -l_L2_head_L3_head_x__L3_theta*step_lambda_L2_head_L3_head_x
        - l_L2_head_L3_head_y__L3_theta*step_lambda_L2_head_L3_head_y;

    /* results */
    x[0] = step_acceleration_L6_theta;
    x[1] = step_acceleration_L2_theta;
    x[2] = step_acceleration_L3_theta;
    x[3] = step_acceleration_L7_theta;
    x[4] = step_acceleration_L8_theta;
    return 0;
}

/* Multipliers of the closures from those of the absolute rows. */
void tree_multipliers(const double *lambda, double *closing)
{
    (void)lambda, (void)closing;
    closing[0] = + lambda[20];
    closing[1] = - lambda[10];
    closing[2] = - lambda[11];
    closing[3] = + lambda[8] + lambda[10];
    closing[4] = + lambda[9] + lambda[11];
}
