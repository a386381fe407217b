/*
 * The diagonal of M (n).
 */
void mass_matrix(const Parameters *p, double *m)
{
    /* M */
    m[0] = p->L1_mass;
    m[1] = p->L1_mass;
    m[2] = p->L1_inertia;
    m[3] = p->L2_mass;
    m[4] = p->L2_mass;
    m[5] = p->L2_inertia;
    m[6] = p->L3_mass;
    m[7] = p->L3_mass;
    m[8] = p->L3_inertia;
    m[9] = p->L4_mass;
    m[10] = p->L4_mass;
    m[11] = p->L4_inertia;
    m[12] = p->L6_mass;
    m[13] = p->L6_mass;
    m[14] = p->L6_inertia;
    m[15] = p->L7_mass;
    m[16] = p->L7_mass;
    m[17] = p->L7_inertia;
    m[18] = p->L8_mass;
    m[19] = p->L8_mass;
    m[20] = p->L8_inertia;
    m[21] = p->S9_mass;
    m[22] = p->S9_mass;
    m[23] = p->S9_inertia;
}

/*
 * Phi(q, t) of the closed linkage; m and rad.
 */
void constraints(const double t, const double *q, const Parameters *p, double *phi)
{
    /* coordinates, velocities, time */
    const double L1_x = q[0];
    const double L1_y = q[1];
    const double L1_theta = q[2];
    const double L2_x = q[3];
    const double L2_y = q[4];
    const double L2_theta = q[5];
    const double L3_x = q[6];
    const double L3_y = q[7];
    const double L3_theta = q[8];
    const double L4_x = q[9];
    const double L4_y = q[10];
    const double L4_theta = q[11];
    const double L6_x = q[12];
    const double L6_y = q[13];
    const double L6_theta = q[14];
    const double L7_x = q[15];
    const double L7_y = q[16];
    const double L7_theta = q[17];
    const double L8_x = q[18];
    const double L8_y = q[19];
    const double L8_theta = q[20];
    const double S9_x = q[21];
    const double S9_y = q[22];
    const double S9_theta = q[23];

    /* directions, arms, drives */
    const double cos_theta_L1 = cos(L1_theta);
    const double sin_theta_L1 = sin(L1_theta);
    const double arm_L1_head_x = p->L1_head_s_x*cos_theta_L1;
    const double arm_L1_head_y = p->L1_head_s_x*sin_theta_L1;
    const double cos_theta_L4 = cos(L4_theta);
    const double sin_theta_L4 = sin(L4_theta);
    const double arm_L4_head_x = p->L4_head_s_x*cos_theta_L4;
    const double arm_L4_head_y = p->L4_head_s_x*sin_theta_L4;
    const double cos_theta_L2 = cos(L2_theta);
    const double sin_theta_L2 = sin(L2_theta);
    const double arm_L2_head_x = p->L2_head_s_x*cos_theta_L2;
    const double arm_L2_head_y = p->L2_head_s_x*sin_theta_L2;
    const double cos_theta_L3 = cos(L3_theta);
    const double sin_theta_L3 = sin(L3_theta);
    const double arm_L3_head_x = p->L3_head_s_x*cos_theta_L3;
    const double arm_L3_head_y = p->L3_head_s_x*sin_theta_L3;
    const double cos_theta_L7 = cos(L7_theta);
    const double sin_theta_L7 = sin(L7_theta);
    const double arm_L7_head_x = p->L7_head_s_x*cos_theta_L7;
    const double arm_L7_head_y = p->L7_head_s_x*sin_theta_L7;
    const double cos_theta_L6 = cos(L6_theta);
    const double sin_theta_L6 = sin(L6_theta);
    const double arm_L6_head_x = p->L6_head_s_x*cos_theta_L6;
    const double arm_L6_head_y = p->L6_head_s_x*sin_theta_L6;
    const double cos_theta_L8 = cos(L8_theta);
    const double sin_theta_L8 = sin(L8_theta);
    const double arm_L8_head_x = p->L8_head_s_x*cos_theta_L8;
    const double arm_L8_head_y = p->L8_head_s_x*sin_theta_L8;
    const double crank1_value = p->omega*t - 0.689754120388159;
    const double crank4_value = p->omega4*t + 3.4814082589530893;

    /* rows */
    phi[0] = -L1_x + arm_L1_head_x;  /* O1.x, m */
    phi[1] = -L1_y + arm_L1_head_y;  /* O1.y, m */
    phi[2] = -L4_x + arm_L4_head_x;  /* O4.x, m */
    phi[3] = -L4_y + p->O4_y + arm_L4_head_y;  /* O4.y, m */
    phi[4] = L1_x - L2_x + arm_L1_head_x + arm_L2_head_x;  /* A.x, m */
    phi[5] = L1_y - L2_y + arm_L1_head_y + arm_L2_head_y;  /* A.y, m */
    phi[6] = -L3_x + L4_x + arm_L3_head_x + arm_L4_head_x;  /* B.x, m */
    phi[7] = -L3_y + L4_y + arm_L3_head_y + arm_L4_head_y;  /* B.y, m */
    phi[8] = L2_x - L7_x + arm_L2_head_x + arm_L7_head_x;  /* P2.x, m */
    phi[9] = L2_y - L7_y + arm_L2_head_y + arm_L7_head_y;  /* P2.y, m */
    phi[10] = L3_x - L7_x + arm_L3_head_x + arm_L7_head_x;  /* P3.x, m */
    phi[11] = L3_y - L7_y + arm_L3_head_y + arm_L7_head_y;  /* P3.y, m */
    phi[12] = -L6_x + L7_x - arm_L6_head_x + arm_L7_head_x;  /* Q6.x, m */
    phi[13] = -L6_y + L7_y - arm_L6_head_y + arm_L7_head_y;  /* Q6.y, m */
    phi[14] = L7_x - L8_x + arm_L7_head_x + arm_L8_head_x;  /* Q8.x, m */
    phi[15] = L7_y - L8_y + arm_L7_head_y + arm_L8_head_y;  /* Q8.y, m */
    phi[16] = -L6_x + p->O6_x + arm_L6_head_x;  /* O6.x, m */
    phi[17] = -L6_y + arm_L6_head_y;  /* O6.y, m */
    phi[18] = L8_x - S9_x + arm_L8_head_x;  /* slider.x, m */
    phi[19] = L8_y - S9_y + arm_L8_head_y;  /* slider.y, m */
    phi[20] = p->O6_x - S9_x;  /* guide.offset, m */
    phi[21] = S9_theta - PI/2.0;  /* guide.angle, rad */
    phi[22] = L1_theta - crank1_value;  /* crank1, rad */
    phi[23] = L4_theta - crank4_value;  /* crank4, rad */
}

/*
 * Phi_q of the closed linkage, dense, row by row; zeros kept.
 */
void jacobian(const double t, const double *q, const Parameters *p, double *phi_q)
{
    (void)t;
    /* coordinates, velocities, time */
    const double L1_theta = q[2];
    const double L2_theta = q[5];
    const double L3_theta = q[8];
    const double L4_theta = q[11];
    const double L6_theta = q[14];
    const double L7_theta = q[17];
    const double L8_theta = q[20];

    /* directions, arms, drives */
    const double cos_theta_L1 = cos(L1_theta);
    const double sin_theta_L1 = sin(L1_theta);
    const double arm_L1_head_x = p->L1_head_s_x*cos_theta_L1;
    const double arm_L1_head_y = p->L1_head_s_x*sin_theta_L1;
    const double cos_theta_L4 = cos(L4_theta);
    const double sin_theta_L4 = sin(L4_theta);
    const double arm_L4_head_x = p->L4_head_s_x*cos_theta_L4;
    const double arm_L4_head_y = p->L4_head_s_x*sin_theta_L4;
    const double cos_theta_L2 = cos(L2_theta);
    const double sin_theta_L2 = sin(L2_theta);
    const double arm_L2_head_x = p->L2_head_s_x*cos_theta_L2;
    const double arm_L2_head_y = p->L2_head_s_x*sin_theta_L2;
    const double cos_theta_L3 = cos(L3_theta);
    const double sin_theta_L3 = sin(L3_theta);
    const double arm_L3_head_x = p->L3_head_s_x*cos_theta_L3;
    const double arm_L3_head_y = p->L3_head_s_x*sin_theta_L3;
    const double cos_theta_L7 = cos(L7_theta);
    const double sin_theta_L7 = sin(L7_theta);
    const double arm_L7_head_x = p->L7_head_s_x*cos_theta_L7;
    const double arm_L7_head_y = p->L7_head_s_x*sin_theta_L7;
    const double cos_theta_L6 = cos(L6_theta);
    const double sin_theta_L6 = sin(L6_theta);
    const double arm_L6_head_x = p->L6_head_s_x*cos_theta_L6;
    const double arm_L6_head_y = p->L6_head_s_x*sin_theta_L6;
    const double cos_theta_L8 = cos(L8_theta);
    const double sin_theta_L8 = sin(L8_theta);
    const double arm_L8_head_x = p->L8_head_s_x*cos_theta_L8;
    const double arm_L8_head_y = p->L8_head_s_x*sin_theta_L8;

    /* non-zeros */
    phi_q[0] = -1.0;  /* d O1.x / d L1_x */
    phi_q[2] = -arm_L1_head_y;  /* d O1.x / d L1_theta */
    phi_q[25] = -1.0;  /* d O1.y / d L1_y */
    phi_q[26] = arm_L1_head_x;  /* d O1.y / d L1_theta */
    phi_q[57] = -1.0;  /* d O4.x / d L4_x */
    phi_q[59] = -arm_L4_head_y;  /* d O4.x / d L4_theta */
    phi_q[82] = -1.0;  /* d O4.y / d L4_y */
    phi_q[83] = arm_L4_head_x;  /* d O4.y / d L4_theta */
    phi_q[96] = 1.0;  /* d A.x / d L1_x */
    phi_q[98] = -arm_L1_head_y;  /* d A.x / d L1_theta */
    phi_q[99] = -1.0;  /* d A.x / d L2_x */
    phi_q[101] = -arm_L2_head_y;  /* d A.x / d L2_theta */
    phi_q[121] = 1.0;  /* d A.y / d L1_y */
    phi_q[122] = arm_L1_head_x;  /* d A.y / d L1_theta */
    phi_q[124] = -1.0;  /* d A.y / d L2_y */
    phi_q[125] = arm_L2_head_x;  /* d A.y / d L2_theta */
    phi_q[153] = 1.0;  /* d B.x / d L4_x */
    phi_q[155] = -arm_L4_head_y;  /* d B.x / d L4_theta */
    phi_q[150] = -1.0;  /* d B.x / d L3_x */
    phi_q[152] = -arm_L3_head_y;  /* d B.x / d L3_theta */
    phi_q[178] = 1.0;  /* d B.y / d L4_y */
    phi_q[179] = arm_L4_head_x;  /* d B.y / d L4_theta */
    phi_q[175] = -1.0;  /* d B.y / d L3_y */
    phi_q[176] = arm_L3_head_x;  /* d B.y / d L3_theta */
    phi_q[195] = 1.0;  /* d P2.x / d L2_x */
    phi_q[197] = -arm_L2_head_y;  /* d P2.x / d L2_theta */
    phi_q[207] = -1.0;  /* d P2.x / d L7_x */
    phi_q[209] = -arm_L7_head_y;  /* d P2.x / d L7_theta */
    phi_q[220] = 1.0;  /* d P2.y / d L2_y */
    phi_q[221] = arm_L2_head_x;  /* d P2.y / d L2_theta */
    phi_q[232] = -1.0;  /* d P2.y / d L7_y */
    phi_q[233] = arm_L7_head_x;  /* d P2.y / d L7_theta */
    phi_q[246] = 1.0;  /* d P3.x / d L3_x */
    phi_q[248] = -arm_L3_head_y;  /* d P3.x / d L3_theta */
    phi_q[255] = -1.0;  /* d P3.x / d L7_x */
    phi_q[257] = -arm_L7_head_y;  /* d P3.x / d L7_theta */
    phi_q[271] = 1.0;  /* d P3.y / d L3_y */
    phi_q[272] = arm_L3_head_x;  /* d P3.y / d L3_theta */
    phi_q[280] = -1.0;  /* d P3.y / d L7_y */
    phi_q[281] = arm_L7_head_x;  /* d P3.y / d L7_theta */
    phi_q[303] = 1.0;  /* d Q6.x / d L7_x */
    phi_q[305] = -arm_L7_head_y;  /* d Q6.x / d L7_theta */
    phi_q[300] = -1.0;  /* d Q6.x / d L6_x */
    phi_q[302] = arm_L6_head_y;  /* d Q6.x / d L6_theta */
    phi_q[328] = 1.0;  /* d Q6.y / d L7_y */
    phi_q[329] = arm_L7_head_x;  /* d Q6.y / d L7_theta */
    phi_q[325] = -1.0;  /* d Q6.y / d L6_y */
    phi_q[326] = -arm_L6_head_x;  /* d Q6.y / d L6_theta */
    phi_q[351] = 1.0;  /* d Q8.x / d L7_x */
    phi_q[353] = -arm_L7_head_y;  /* d Q8.x / d L7_theta */
    phi_q[354] = -1.0;  /* d Q8.x / d L8_x */
    phi_q[356] = -arm_L8_head_y;  /* d Q8.x / d L8_theta */
    phi_q[376] = 1.0;  /* d Q8.y / d L7_y */
    phi_q[377] = arm_L7_head_x;  /* d Q8.y / d L7_theta */
    phi_q[379] = -1.0;  /* d Q8.y / d L8_y */
    phi_q[380] = arm_L8_head_x;  /* d Q8.y / d L8_theta */
    phi_q[396] = -1.0;  /* d O6.x / d L6_x */
    phi_q[398] = -arm_L6_head_y;  /* d O6.x / d L6_theta */
    phi_q[421] = -1.0;  /* d O6.y / d L6_y */
    phi_q[422] = arm_L6_head_x;  /* d O6.y / d L6_theta */
    phi_q[450] = 1.0;  /* d slider.x / d L8_x */
    phi_q[452] = -arm_L8_head_y;  /* d slider.x / d L8_theta */
    phi_q[453] = -1.0;  /* d slider.x / d S9_x */
    phi_q[475] = 1.0;  /* d slider.y / d L8_y */
    phi_q[476] = arm_L8_head_x;  /* d slider.y / d L8_theta */
    phi_q[478] = -1.0;  /* d slider.y / d S9_y */
    phi_q[501] = -1.0;  /* d guide.offset / d S9_x */
    phi_q[527] = 1.0;  /* d guide.angle / d S9_theta */
    phi_q[530] = 1.0;  /* d crank1 / d L1_theta */
    phi_q[563] = 1.0;  /* d crank4 / d L4_theta */
}

/*
 * nu = -Phi_t: Phi_q v = nu.
 */
void velocity_rhs(const double t, const double *q, const Parameters *p, double *nu)
{
    (void)t, (void)q;
    /* directions, arms, drives */
    const double crank1_rate = p->omega;
    const double crank4_rate = p->omega4;

    /* rows */
    nu[0] = 0.0;  /* O1.x, m/s */
    nu[1] = 0.0;  /* O1.y, m/s */
    nu[2] = 0.0;  /* O4.x, m/s */
    nu[3] = 0.0;  /* O4.y, m/s */
    nu[4] = 0.0;  /* A.x, m/s */
    nu[5] = 0.0;  /* A.y, m/s */
    nu[6] = 0.0;  /* B.x, m/s */
    nu[7] = 0.0;  /* B.y, m/s */
    nu[8] = 0.0;  /* P2.x, m/s */
    nu[9] = 0.0;  /* P2.y, m/s */
    nu[10] = 0.0;  /* P3.x, m/s */
    nu[11] = 0.0;  /* P3.y, m/s */
    nu[12] = 0.0;  /* Q6.x, m/s */
    nu[13] = 0.0;  /* Q6.y, m/s */
    nu[14] = 0.0;  /* Q8.x, m/s */
    nu[15] = 0.0;  /* Q8.y, m/s */
    nu[16] = 0.0;  /* O6.x, m/s */
    nu[17] = 0.0;  /* O6.y, m/s */
    nu[18] = 0.0;  /* slider.x, m/s */
    nu[19] = 0.0;  /* slider.y, m/s */
    nu[20] = 0.0;  /* guide.offset, m/s */
    nu[21] = 0.0;  /* guide.angle, rad/s */
    nu[22] = crank1_rate;  /* crank1, rad/s */
    nu[23] = crank4_rate;  /* crank4, rad/s */
}

/*
 * gamma: Phi_q a = gamma.
 */
void acceleration_rhs(const double t, const double *q, const double *v, const Parameters *p, double *gamma_rows)
{
    (void)t;
    /* coordinates, velocities, time */
    const double L1_theta = q[2];
    const double L1_omega = v[2];
    const double L2_theta = q[5];
    const double L2_omega = v[5];
    const double L3_theta = q[8];
    const double L3_omega = v[8];
    const double L4_theta = q[11];
    const double L4_omega = v[11];
    const double L6_theta = q[14];
    const double L6_omega = v[14];
    const double L7_theta = q[17];
    const double L7_omega = v[17];
    const double L8_theta = q[20];
    const double L8_omega = v[20];

    /* directions, arms, drives */
    const double cos_theta_L1 = cos(L1_theta);
    const double sin_theta_L1 = sin(L1_theta);
    const double arm_L1_head_x = p->L1_head_s_x*cos_theta_L1;
    const double arm_L1_head_y = p->L1_head_s_x*sin_theta_L1;
    const double cos_theta_L4 = cos(L4_theta);
    const double sin_theta_L4 = sin(L4_theta);
    const double arm_L4_head_x = p->L4_head_s_x*cos_theta_L4;
    const double arm_L4_head_y = p->L4_head_s_x*sin_theta_L4;
    const double cos_theta_L2 = cos(L2_theta);
    const double sin_theta_L2 = sin(L2_theta);
    const double arm_L2_head_x = p->L2_head_s_x*cos_theta_L2;
    const double arm_L2_head_y = p->L2_head_s_x*sin_theta_L2;
    const double cos_theta_L3 = cos(L3_theta);
    const double sin_theta_L3 = sin(L3_theta);
    const double arm_L3_head_x = p->L3_head_s_x*cos_theta_L3;
    const double arm_L3_head_y = p->L3_head_s_x*sin_theta_L3;
    const double cos_theta_L7 = cos(L7_theta);
    const double sin_theta_L7 = sin(L7_theta);
    const double arm_L7_head_x = p->L7_head_s_x*cos_theta_L7;
    const double arm_L7_head_y = p->L7_head_s_x*sin_theta_L7;
    const double cos_theta_L6 = cos(L6_theta);
    const double sin_theta_L6 = sin(L6_theta);
    const double arm_L6_head_x = p->L6_head_s_x*cos_theta_L6;
    const double arm_L6_head_y = p->L6_head_s_x*sin_theta_L6;
    const double cos_theta_L8 = cos(L8_theta);
    const double sin_theta_L8 = sin(L8_theta);
    const double arm_L8_head_x = p->L8_head_s_x*cos_theta_L8;
    const double arm_L8_head_y = p->L8_head_s_x*sin_theta_L8;
    const double crank1_acceleration = 0.0;
    const double crank4_acceleration = 0.0;

    /* rows */
    gamma_rows[0] = (L1_omega * L1_omega)*arm_L1_head_x;  /* O1.x, m/s^2 */
    gamma_rows[1] = (L1_omega * L1_omega)*arm_L1_head_y;  /* O1.y, m/s^2 */
    gamma_rows[2] = (L4_omega * L4_omega)*arm_L4_head_x;  /* O4.x, m/s^2 */
    gamma_rows[3] = (L4_omega * L4_omega)*arm_L4_head_y;  /* O4.y, m/s^2 */
    gamma_rows[4] = (L1_omega * L1_omega)*arm_L1_head_x + (L2_omega * L2_omega)*arm_L2_head_x;  /* A.x, m/s^2 */
    gamma_rows[5] = (L1_omega * L1_omega)*arm_L1_head_y + (L2_omega * L2_omega)*arm_L2_head_y;  /* A.y, m/s^2 */
    gamma_rows[6] = (L3_omega * L3_omega)*arm_L3_head_x + (L4_omega * L4_omega)*arm_L4_head_x;  /* B.x, m/s^2 */
    gamma_rows[7] = (L3_omega * L3_omega)*arm_L3_head_y + (L4_omega * L4_omega)*arm_L4_head_y;  /* B.y, m/s^2 */
    gamma_rows[8] = (L2_omega * L2_omega)*arm_L2_head_x + (L7_omega * L7_omega)*arm_L7_head_x;  /* P2.x, m/s^2 */
    gamma_rows[9] = (L2_omega * L2_omega)*arm_L2_head_y + (L7_omega * L7_omega)*arm_L7_head_y;  /* P2.y, m/s^2 */
    gamma_rows[10] = (L3_omega * L3_omega)*arm_L3_head_x + (L7_omega * L7_omega)*arm_L7_head_x;  /* P3.x, m/s^2 */
    gamma_rows[11] = (L3_omega * L3_omega)*arm_L3_head_y + (L7_omega * L7_omega)*arm_L7_head_y;  /* P3.y, m/s^2 */
    gamma_rows[12] = -(L6_omega * L6_omega)*arm_L6_head_x + (L7_omega * L7_omega)*arm_L7_head_x;  /* Q6.x, m/s^2 */
    gamma_rows[13] = -(L6_omega * L6_omega)*arm_L6_head_y + (L7_omega * L7_omega)*arm_L7_head_y;  /* Q6.y, m/s^2 */
    gamma_rows[14] = (L7_omega * L7_omega)*arm_L7_head_x + (L8_omega * L8_omega)*arm_L8_head_x;  /* Q8.x, m/s^2 */
    gamma_rows[15] = (L7_omega * L7_omega)*arm_L7_head_y + (L8_omega * L8_omega)*arm_L8_head_y;  /* Q8.y, m/s^2 */
    gamma_rows[16] = (L6_omega * L6_omega)*arm_L6_head_x;  /* O6.x, m/s^2 */
    gamma_rows[17] = (L6_omega * L6_omega)*arm_L6_head_y;  /* O6.y, m/s^2 */
    gamma_rows[18] = (L8_omega * L8_omega)*arm_L8_head_x;  /* slider.x, m/s^2 */
    gamma_rows[19] = (L8_omega * L8_omega)*arm_L8_head_y;  /* slider.y, m/s^2 */
    gamma_rows[20] = 0.0;  /* guide.offset, m/s^2 */
    gamma_rows[21] = 0.0;  /* guide.angle, rad/s^2 */
    gamma_rows[22] = crank1_acceleration;  /* crank1, rad/s^2 */
    gamma_rows[23] = crank4_acceleration;  /* crank4, rad/s^2 */
}

/*
 * Values of the start's guess, set and rates.
 */
void start_values(const Parameters *p, double *guess, double *set, double *rates)
{
    (void)set, (void)rates;
    /* start */
    guess[0] = p->guess_L2_theta;  /* start.guess.L2.theta */
    guess[1] = p->guess_L3_theta;  /* start.guess.L3.theta */
    guess[2] = p->guess_L6_theta;  /* start.guess.L6.theta */
    guess[3] = p->guess_L7_theta;  /* start.guess.L7.theta */
    guess[4] = p->guess_L8_theta;  /* start.guess.L8.theta */
}

/*
 * Reactions (Fx, Fy, M on the second body at the joint's point: its share of -Phi_q^T lambda),
 * drive torques on the driven body, kinetic and potential energy.
 */
void outputs(const double t, const double *q, const double *v, const Parameters *p, const double *lambda,
    double *reactions, double *torques, double *series, double *energy)
{
    (void)t, (void)series;
    /* coordinates, velocities, time */
    const double L1_y = q[1];
    const double L1_vx = v[0];
    const double L1_vy = v[1];
    const double L1_omega = v[2];
    const double L2_y = q[4];
    const double L2_vx = v[3];
    const double L2_vy = v[4];
    const double L2_omega = v[5];
    const double L3_y = q[7];
    const double L3_vx = v[6];
    const double L3_vy = v[7];
    const double L3_omega = v[8];
    const double L4_y = q[10];
    const double L4_vx = v[9];
    const double L4_vy = v[10];
    const double L4_omega = v[11];
    const double L6_y = q[13];
    const double L6_vx = v[12];
    const double L6_vy = v[13];
    const double L6_omega = v[14];
    const double L7_y = q[16];
    const double L7_vx = v[15];
    const double L7_vy = v[16];
    const double L7_omega = v[17];
    const double L8_y = q[19];
    const double L8_vx = v[18];
    const double L8_vy = v[19];
    const double L8_omega = v[20];
    const double S9_y = q[22];
    const double S9_vx = v[21];
    const double S9_vy = v[22];
    const double S9_omega = v[23];

    /* multipliers */
    const double multiplier_O1_x = lambda[0];
    const double multiplier_O1_y = lambda[1];
    const double multiplier_O4_x = lambda[2];
    const double multiplier_O4_y = lambda[3];
    const double multiplier_P2_x = lambda[4];
    const double multiplier_P2_y = lambda[5];
    const double multiplier_P3_x = lambda[6];
    const double multiplier_P3_y = lambda[7];
    const double multiplier_Q6_x = lambda[8];
    const double multiplier_Q6_y = lambda[9];
    const double multiplier_Q8_x = lambda[10];
    const double multiplier_Q8_y = lambda[11];
    const double multiplier_O6_x = lambda[12];
    const double multiplier_O6_y = lambda[13];
    const double multiplier_slider_x = lambda[14];
    const double multiplier_slider_y = lambda[15];
    const double multiplier_guide_offset = lambda[16];
    const double multiplier_guide_angle = lambda[17];
    const double multiplier_crank1 = lambda[18];
    const double multiplier_crank4 = lambda[19];

    /* reactions */
    reactions[0] = multiplier_O1_x;  /* O1.Fx */
    reactions[1] = multiplier_O1_y;  /* O1.Fy */
    reactions[2] = 0.0;  /* O1.M */
    reactions[3] = multiplier_O4_x;  /* O4.Fx */
    reactions[4] = multiplier_O4_y;  /* O4.Fy */
    reactions[5] = 0.0;  /* O4.M */
    reactions[6] = multiplier_P2_x;  /* P2.Fx */
    reactions[7] = multiplier_P2_y;  /* P2.Fy */
    reactions[8] = 0.0;  /* P2.M */
    reactions[9] = multiplier_P3_x;  /* P3.Fx */
    reactions[10] = multiplier_P3_y;  /* P3.Fy */
    reactions[11] = 0.0;  /* P3.M */
    reactions[12] = multiplier_Q6_x;  /* Q6.Fx */
    reactions[13] = multiplier_Q6_y;  /* Q6.Fy */
    reactions[14] = 0.0;  /* Q6.M */
    reactions[15] = multiplier_Q8_x;  /* Q8.Fx */
    reactions[16] = multiplier_Q8_y;  /* Q8.Fy */
    reactions[17] = 0.0;  /* Q8.M */
    reactions[18] = multiplier_O6_x;  /* O6.Fx */
    reactions[19] = multiplier_O6_y;  /* O6.Fy */
    reactions[20] = 0.0;  /* O6.M */
    reactions[21] = multiplier_slider_x;  /* slider.Fx */
    reactions[22] = multiplier_slider_y;  /* slider.Fy */
    reactions[23] = 0.0;  /* slider.M */
    reactions[24] = multiplier_guide_offset;  /* guide.Fx */
    reactions[25] = 0.0;  /* guide.Fy */
    reactions[26] = -multiplier_guide_angle;  /* guide.M */
    torques[0] = -multiplier_crank1;  /* crank1 */
    torques[1] = -multiplier_crank4;  /* crank4 */

    /* energy */
    energy[0] = 0.5*p->L1_inertia*(L1_omega * L1_omega) + 0.5*p->L1_mass*(L1_vx * L1_vx)
        + 0.5*p->L1_mass*(L1_vy * L1_vy) + 0.5*p->L2_inertia*(L2_omega * L2_omega) + 0.5*p->L2_mass*(L2_vx * L2_vx)
        + 0.5*p->L2_mass*(L2_vy * L2_vy) + 0.5*p->L3_inertia*(L3_omega * L3_omega) + 0.5*p->L3_mass*(L3_vx * L3_vx)
        + 0.5*p->L3_mass*(L3_vy * L3_vy) + 0.5*p->L4_inertia*(L4_omega * L4_omega) + 0.5*p->L4_mass*(L4_vx * L4_vx)
        + 0.5*p->L4_mass*(L4_vy * L4_vy) + 0.5*p->L6_inertia*(L6_omega * L6_omega) + 0.5*p->L6_mass*(L6_vx * L6_vx)
        + 0.5*p->L6_mass*(L6_vy * L6_vy) + 0.5*p->L7_inertia*(L7_omega * L7_omega) + 0.5*p->L7_mass*(L7_vx * L7_vx)
        + 0.5*p->L7_mass*(L7_vy * L7_vy) + 0.5*p->L8_inertia*(L8_omega * L8_omega) + 0.5*p->L8_mass*(L8_vx * L8_vx)
        + 0.5*p->L8_mass*(L8_vy * L8_vy) + 0.5*p->S9_inertia*(S9_omega * S9_omega) + 0.5*p->S9_mass*(S9_vx * S9_vx)
        + 0.5*p->S9_mass*(S9_vy * S9_vy);
    energy[1] = -p->L1_mass*L1_y*p->gravity_y - p->L2_mass*L2_y*p->gravity_y - p->L3_mass*L3_y*p->gravity_y
        - p->L4_mass*L4_y*p->gravity_y - p->L6_mass*L6_y*p->gravity_y - p->L7_mass*L7_y*p->gravity_y
        - p->L8_mass*L8_y*p->gravity_y - p->S9_mass*S9_y*p->gravity_y;
}

/* Whether a start with these numbers is that with the others: what closing the linkage reads. */
int same_start(const Parameters *p, const Parameters *other)
{
    return same_number(p->L1_mass, other->L1_mass)
        && same_number(p->L1_inertia, other->L1_inertia)
        && same_number(p->L2_mass, other->L2_mass)
        && same_number(p->L2_inertia, other->L2_inertia)
        && same_number(p->L3_mass, other->L3_mass)
        && same_number(p->L3_inertia, other->L3_inertia)
        && same_number(p->L4_mass, other->L4_mass)
        && same_number(p->L4_inertia, other->L4_inertia)
        && same_number(p->L6_mass, other->L6_mass)
        && same_number(p->L6_inertia, other->L6_inertia)
        && same_number(p->L7_mass, other->L7_mass)
        && same_number(p->L7_inertia, other->L7_inertia)
        && same_number(p->L8_mass, other->L8_mass)
        && same_number(p->L8_inertia, other->L8_inertia)
        && same_number(p->S9_mass, other->S9_mass)
        && same_number(p->S9_inertia, other->S9_inertia)
        && same_number(p->omega, other->omega)
        && same_number(p->omega4, other->omega4)
        && same_number(p->L1_head_s_x, other->L1_head_s_x)
        && same_number(p->L2_head_s_x, other->L2_head_s_x)
        && same_number(p->L3_head_s_x, other->L3_head_s_x)
        && same_number(p->L4_head_s_x, other->L4_head_s_x)
        && same_number(p->L6_head_s_x, other->L6_head_s_x)
        && same_number(p->L7_head_s_x, other->L7_head_s_x)
        && same_number(p->L8_head_s_x, other->L8_head_s_x)
        && same_number(p->O4_y, other->O4_y)
        && same_number(p->O6_x, other->O6_x)
        && same_number(p->guess_L2_theta, other->guess_L2_theta)
        && same_number(p->guess_L3_theta, other->guess_L3_theta)
        && same_number(p->guess_L6_theta, other->guess_L6_theta)
        && same_number(p->guess_L7_theta, other->guess_L7_theta)
        && same_number(p->guess_L8_theta, other->guess_L8_theta);
}
