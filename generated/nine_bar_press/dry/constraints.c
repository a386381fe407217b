/*
 * The diagonal of the mass matrix M (n) in absolute coordinates.
 */
void mass_matrix(const Parameters *p, double *m)
{
    /* M */
    m[0] = p->L1_mass_;
    m[1] = p->L1_mass_;
    m[2] = p->L1_inertia_;
    m[3] = p->L2_mass_;
    m[4] = p->L2_mass_;
    m[5] = p->L2_inertia_;
    m[6] = p->L3_mass_;
    m[7] = p->L3_mass_;
    m[8] = p->L3_inertia_;
    m[9] = p->L4_mass_;
    m[10] = p->L4_mass_;
    m[11] = p->L4_inertia_;
    m[12] = p->L6_mass_;
    m[13] = p->L6_mass_;
    m[14] = p->L6_inertia_;
    m[15] = p->L7_mass_;
    m[16] = p->L7_mass_;
    m[17] = p->L7_inertia_;
    m[18] = p->L8_mass_;
    m[19] = p->L8_mass_;
    m[20] = p->L8_inertia_;
    m[21] = p->S9_mass_;
    m[22] = p->S9_mass_;
    m[23] = p->S9_inertia_;
}

/*
 * Phi(q, t) of the closed linkage; m and rad. Rows marked 'open' or 'redundant' do not constrain the motion.
 */
void constraints(const double t, const double *q, const Parameters *p, double *phi)
{
    /* coordinates, velocities, time */
    const double L1_x_ = q[0];
    const double L1_y_ = q[1];
    const double L1_theta_ = q[2];
    const double L2_x_ = q[3];
    const double L2_y_ = q[4];
    const double L2_theta_ = q[5];
    const double L3_x_ = q[6];
    const double L3_y_ = q[7];
    const double L3_theta_ = q[8];
    const double L4_x_ = q[9];
    const double L4_y_ = q[10];
    const double L4_theta_ = q[11];
    const double L6_x_ = q[12];
    const double L6_y_ = q[13];
    const double L6_theta_ = q[14];
    const double L7_x_ = q[15];
    const double L7_y_ = q[16];
    const double L7_theta_ = q[17];
    const double L8_x_ = q[18];
    const double L8_y_ = q[19];
    const double L8_theta_ = q[20];
    const double S9_x_ = q[21];
    const double S9_y_ = q[22];
    const double S9_theta_ = q[23];

    /* directions, arms, drives */
    const double cos_theta_L1_ = cos(L1_theta_);
    const double sin_theta_L1_ = sin(L1_theta_);
    const double arm_L1_head_x_ = p->L1_head_s_x_*cos_theta_L1_;
    const double arm_L1_head_y_ = p->L1_head_s_x_*sin_theta_L1_;
    const double cos_theta_L4_ = cos(L4_theta_);
    const double sin_theta_L4_ = sin(L4_theta_);
    const double arm_L4_head_x_ = p->L4_head_s_x_*cos_theta_L4_;
    const double arm_L4_head_y_ = p->L4_head_s_x_*sin_theta_L4_;
    const double cos_theta_L2_ = cos(L2_theta_);
    const double sin_theta_L2_ = sin(L2_theta_);
    const double arm_L2_head_x_ = p->L2_head_s_x_*cos_theta_L2_;
    const double arm_L2_head_y_ = p->L2_head_s_x_*sin_theta_L2_;
    const double cos_theta_L3_ = cos(L3_theta_);
    const double sin_theta_L3_ = sin(L3_theta_);
    const double arm_L3_head_x_ = p->L3_head_s_x_*cos_theta_L3_;
    const double arm_L3_head_y_ = p->L3_head_s_x_*sin_theta_L3_;
    const double cos_theta_L7_ = cos(L7_theta_);
    const double sin_theta_L7_ = sin(L7_theta_);
    const double arm_L7_head_x_ = p->L7_head_s_x_*cos_theta_L7_;
    const double arm_L7_head_y_ = p->L7_head_s_x_*sin_theta_L7_;
    const double cos_theta_L6_ = cos(L6_theta_);
    const double sin_theta_L6_ = sin(L6_theta_);
    const double arm_L6_head_x_ = p->L6_head_s_x_*cos_theta_L6_;
    const double arm_L6_head_y_ = p->L6_head_s_x_*sin_theta_L6_;
    const double cos_theta_L8_ = cos(L8_theta_);
    const double sin_theta_L8_ = sin(L8_theta_);
    const double arm_L8_head_x_ = p->L8_head_s_x_*cos_theta_L8_;
    const double arm_L8_head_y_ = p->L8_head_s_x_*sin_theta_L8_;
    const double crank1_value_ = p->omega_*t - 0.689754120388159;
    const double crank4_value_ = p->omega4_*t + 3.4814082589530893;

    /* rows */
    phi[0] = -L1_x_ + arm_L1_head_x_;  /* O1.x, m */
    phi[1] = -L1_y_ + arm_L1_head_y_;  /* O1.y, m */
    phi[2] = -L4_x_ + arm_L4_head_x_;  /* O4.x, m */
    phi[3] = -L4_y_ + p->O4_y_ + arm_L4_head_y_;  /* O4.y, m */
    phi[4] = L1_x_ - L2_x_ + arm_L1_head_x_ + arm_L2_head_x_;  /* A.x, m; open, A has play */
    phi[5] = L1_y_ - L2_y_ + arm_L1_head_y_ + arm_L2_head_y_;  /* A.y, m; open, A has play */
    phi[6] = -L3_x_ + L4_x_ + arm_L3_head_x_ + arm_L4_head_x_;  /* B.x, m; open, B has play */
    phi[7] = -L3_y_ + L4_y_ + arm_L3_head_y_ + arm_L4_head_y_;  /* B.y, m; open, B has play */
    phi[8] = L2_x_ - L7_x_ + arm_L2_head_x_ + arm_L7_head_x_;  /* P2.x, m */
    phi[9] = L2_y_ - L7_y_ + arm_L2_head_y_ + arm_L7_head_y_;  /* P2.y, m */
    phi[10] = L3_x_ - L7_x_ + arm_L3_head_x_ + arm_L7_head_x_;  /* P3.x, m */
    phi[11] = L3_y_ - L7_y_ + arm_L3_head_y_ + arm_L7_head_y_;  /* P3.y, m */
    phi[12] = -L6_x_ + L7_x_ - arm_L6_head_x_ + arm_L7_head_x_;  /* Q6.x, m */
    phi[13] = -L6_y_ + L7_y_ - arm_L6_head_y_ + arm_L7_head_y_;  /* Q6.y, m */
    phi[14] = L7_x_ - L8_x_ + arm_L7_head_x_ + arm_L8_head_x_;  /* Q8.x, m */
    phi[15] = L7_y_ - L8_y_ + arm_L7_head_y_ + arm_L8_head_y_;  /* Q8.y, m */
    phi[16] = -L6_x_ + p->O6_x_ + arm_L6_head_x_;  /* O6.x, m */
    phi[17] = -L6_y_ + arm_L6_head_y_;  /* O6.y, m */
    phi[18] = L8_x_ - S9_x_ + arm_L8_head_x_;  /* slider.x, m */
    phi[19] = L8_y_ - S9_y_ + arm_L8_head_y_;  /* slider.y, m */
    phi[20] = p->O6_x_ - S9_x_;  /* guide.offset, m */
    phi[21] = S9_theta_ - PI/2.0;  /* guide.angle, rad */
    phi[22] = L1_theta_ - crank1_value_;  /* crank1, rad */
    phi[23] = L4_theta_ - crank4_value_;  /* crank4, rad */
}

/*
 * The Jacobian Phi_q of the closed linkage, dense, row by row; zero entries are not written.
 */
void jacobian(const double t, const double *q, const Parameters *p, double *phi_q)
{
    (void)t;
    /* coordinates, velocities, time */
    const double L1_theta_ = q[2];
    const double L2_theta_ = q[5];
    const double L3_theta_ = q[8];
    const double L4_theta_ = q[11];
    const double L6_theta_ = q[14];
    const double L7_theta_ = q[17];
    const double L8_theta_ = q[20];

    /* directions, arms, drives */
    const double cos_theta_L1_ = cos(L1_theta_);
    const double sin_theta_L1_ = sin(L1_theta_);
    const double arm_L1_head_x_ = p->L1_head_s_x_*cos_theta_L1_;
    const double arm_L1_head_y_ = p->L1_head_s_x_*sin_theta_L1_;
    const double cos_theta_L4_ = cos(L4_theta_);
    const double sin_theta_L4_ = sin(L4_theta_);
    const double arm_L4_head_x_ = p->L4_head_s_x_*cos_theta_L4_;
    const double arm_L4_head_y_ = p->L4_head_s_x_*sin_theta_L4_;
    const double cos_theta_L2_ = cos(L2_theta_);
    const double sin_theta_L2_ = sin(L2_theta_);
    const double arm_L2_head_x_ = p->L2_head_s_x_*cos_theta_L2_;
    const double arm_L2_head_y_ = p->L2_head_s_x_*sin_theta_L2_;
    const double cos_theta_L3_ = cos(L3_theta_);
    const double sin_theta_L3_ = sin(L3_theta_);
    const double arm_L3_head_x_ = p->L3_head_s_x_*cos_theta_L3_;
    const double arm_L3_head_y_ = p->L3_head_s_x_*sin_theta_L3_;
    const double cos_theta_L7_ = cos(L7_theta_);
    const double sin_theta_L7_ = sin(L7_theta_);
    const double arm_L7_head_x_ = p->L7_head_s_x_*cos_theta_L7_;
    const double arm_L7_head_y_ = p->L7_head_s_x_*sin_theta_L7_;
    const double cos_theta_L6_ = cos(L6_theta_);
    const double sin_theta_L6_ = sin(L6_theta_);
    const double arm_L6_head_x_ = p->L6_head_s_x_*cos_theta_L6_;
    const double arm_L6_head_y_ = p->L6_head_s_x_*sin_theta_L6_;
    const double cos_theta_L8_ = cos(L8_theta_);
    const double sin_theta_L8_ = sin(L8_theta_);
    const double arm_L8_head_x_ = p->L8_head_s_x_*cos_theta_L8_;
    const double arm_L8_head_y_ = p->L8_head_s_x_*sin_theta_L8_;

    /* non-zeros */
    phi_q[0] = -1.0;  /* d O1.x / d L1_x_ */
    phi_q[2] = -arm_L1_head_y_;  /* d O1.x / d L1_theta_ */
    phi_q[25] = -1.0;  /* d O1.y / d L1_y_ */
    phi_q[26] = arm_L1_head_x_;  /* d O1.y / d L1_theta_ */
    phi_q[57] = -1.0;  /* d O4.x / d L4_x_ */
    phi_q[59] = -arm_L4_head_y_;  /* d O4.x / d L4_theta_ */
    phi_q[82] = -1.0;  /* d O4.y / d L4_y_ */
    phi_q[83] = arm_L4_head_x_;  /* d O4.y / d L4_theta_ */
    phi_q[96] = 1.0;  /* d A.x / d L1_x_ */
    phi_q[98] = -arm_L1_head_y_;  /* d A.x / d L1_theta_ */
    phi_q[99] = -1.0;  /* d A.x / d L2_x_ */
    phi_q[101] = -arm_L2_head_y_;  /* d A.x / d L2_theta_ */
    phi_q[121] = 1.0;  /* d A.y / d L1_y_ */
    phi_q[122] = arm_L1_head_x_;  /* d A.y / d L1_theta_ */
    phi_q[124] = -1.0;  /* d A.y / d L2_y_ */
    phi_q[125] = arm_L2_head_x_;  /* d A.y / d L2_theta_ */
    phi_q[153] = 1.0;  /* d B.x / d L4_x_ */
    phi_q[155] = -arm_L4_head_y_;  /* d B.x / d L4_theta_ */
    phi_q[150] = -1.0;  /* d B.x / d L3_x_ */
    phi_q[152] = -arm_L3_head_y_;  /* d B.x / d L3_theta_ */
    phi_q[178] = 1.0;  /* d B.y / d L4_y_ */
    phi_q[179] = arm_L4_head_x_;  /* d B.y / d L4_theta_ */
    phi_q[175] = -1.0;  /* d B.y / d L3_y_ */
    phi_q[176] = arm_L3_head_x_;  /* d B.y / d L3_theta_ */
    phi_q[195] = 1.0;  /* d P2.x / d L2_x_ */
    phi_q[197] = -arm_L2_head_y_;  /* d P2.x / d L2_theta_ */
    phi_q[207] = -1.0;  /* d P2.x / d L7_x_ */
    phi_q[209] = -arm_L7_head_y_;  /* d P2.x / d L7_theta_ */
    phi_q[220] = 1.0;  /* d P2.y / d L2_y_ */
    phi_q[221] = arm_L2_head_x_;  /* d P2.y / d L2_theta_ */
    phi_q[232] = -1.0;  /* d P2.y / d L7_y_ */
    phi_q[233] = arm_L7_head_x_;  /* d P2.y / d L7_theta_ */
    phi_q[246] = 1.0;  /* d P3.x / d L3_x_ */
    phi_q[248] = -arm_L3_head_y_;  /* d P3.x / d L3_theta_ */
    phi_q[255] = -1.0;  /* d P3.x / d L7_x_ */
    phi_q[257] = -arm_L7_head_y_;  /* d P3.x / d L7_theta_ */
    phi_q[271] = 1.0;  /* d P3.y / d L3_y_ */
    phi_q[272] = arm_L3_head_x_;  /* d P3.y / d L3_theta_ */
    phi_q[280] = -1.0;  /* d P3.y / d L7_y_ */
    phi_q[281] = arm_L7_head_x_;  /* d P3.y / d L7_theta_ */
    phi_q[303] = 1.0;  /* d Q6.x / d L7_x_ */
    phi_q[305] = -arm_L7_head_y_;  /* d Q6.x / d L7_theta_ */
    phi_q[300] = -1.0;  /* d Q6.x / d L6_x_ */
    phi_q[302] = arm_L6_head_y_;  /* d Q6.x / d L6_theta_ */
    phi_q[328] = 1.0;  /* d Q6.y / d L7_y_ */
    phi_q[329] = arm_L7_head_x_;  /* d Q6.y / d L7_theta_ */
    phi_q[325] = -1.0;  /* d Q6.y / d L6_y_ */
    phi_q[326] = -arm_L6_head_x_;  /* d Q6.y / d L6_theta_ */
    phi_q[351] = 1.0;  /* d Q8.x / d L7_x_ */
    phi_q[353] = -arm_L7_head_y_;  /* d Q8.x / d L7_theta_ */
    phi_q[354] = -1.0;  /* d Q8.x / d L8_x_ */
    phi_q[356] = -arm_L8_head_y_;  /* d Q8.x / d L8_theta_ */
    phi_q[376] = 1.0;  /* d Q8.y / d L7_y_ */
    phi_q[377] = arm_L7_head_x_;  /* d Q8.y / d L7_theta_ */
    phi_q[379] = -1.0;  /* d Q8.y / d L8_y_ */
    phi_q[380] = arm_L8_head_x_;  /* d Q8.y / d L8_theta_ */
    phi_q[396] = -1.0;  /* d O6.x / d L6_x_ */
    phi_q[398] = -arm_L6_head_y_;  /* d O6.x / d L6_theta_ */
    phi_q[421] = -1.0;  /* d O6.y / d L6_y_ */
    phi_q[422] = arm_L6_head_x_;  /* d O6.y / d L6_theta_ */
    phi_q[450] = 1.0;  /* d slider.x / d L8_x_ */
    phi_q[452] = -arm_L8_head_y_;  /* d slider.x / d L8_theta_ */
    phi_q[453] = -1.0;  /* d slider.x / d S9_x_ */
    phi_q[475] = 1.0;  /* d slider.y / d L8_y_ */
    phi_q[476] = arm_L8_head_x_;  /* d slider.y / d L8_theta_ */
    phi_q[478] = -1.0;  /* d slider.y / d S9_y_ */
    phi_q[501] = -1.0;  /* d guide.offset / d S9_x_ */
    phi_q[527] = 1.0;  /* d guide.angle / d S9_theta_ */
    phi_q[530] = 1.0;  /* d crank1 / d L1_theta_ */
    phi_q[563] = 1.0;  /* d crank4 / d L4_theta_ */
}

/*
 * Right-hand side nu = -Phi_t of the velocity constraints Phi_q v = nu (closed linkage).
 */
void velocity_rhs(const double t, const double *q, const Parameters *p, double *nu)
{
    (void)t, (void)q;
    /* directions, arms, drives */
    const double crank1_rate_ = p->omega_;
    const double crank4_rate_ = p->omega4_;

    /* rows */
    nu[0] = 0.0;  /* O1.x, m/s */
    nu[1] = 0.0;  /* O1.y, m/s */
    nu[2] = 0.0;  /* O4.x, m/s */
    nu[3] = 0.0;  /* O4.y, m/s */
    nu[4] = 0.0;  /* A.x, m/s; open, A has play */
    nu[5] = 0.0;  /* A.y, m/s; open, A has play */
    nu[6] = 0.0;  /* B.x, m/s; open, B has play */
    nu[7] = 0.0;  /* B.y, m/s; open, B has play */
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
    nu[22] = crank1_rate_;  /* crank1, rad/s */
    nu[23] = crank4_rate_;  /* crank4, rad/s */
}

/*
 * Right-hand side gamma of the accelerations, Phi_q a = gamma (closed linkage).
 */
void acceleration_rhs(const double t, const double *q, const double *v, const Parameters *p, double *gamma_rows)
{
    (void)t;
    /* coordinates, velocities, time */
    const double L1_theta_ = q[2];
    const double L1_omega_ = v[2];
    const double L2_theta_ = q[5];
    const double L2_omega_ = v[5];
    const double L3_theta_ = q[8];
    const double L3_omega_ = v[8];
    const double L4_theta_ = q[11];
    const double L4_omega_ = v[11];
    const double L6_theta_ = q[14];
    const double L6_omega_ = v[14];
    const double L7_theta_ = q[17];
    const double L7_omega_ = v[17];
    const double L8_theta_ = q[20];
    const double L8_omega_ = v[20];

    /* directions, arms, drives */
    const double cos_theta_L1_ = cos(L1_theta_);
    const double sin_theta_L1_ = sin(L1_theta_);
    const double arm_L1_head_x_ = p->L1_head_s_x_*cos_theta_L1_;
    const double arm_L1_head_y_ = p->L1_head_s_x_*sin_theta_L1_;
    const double cos_theta_L4_ = cos(L4_theta_);
    const double sin_theta_L4_ = sin(L4_theta_);
    const double arm_L4_head_x_ = p->L4_head_s_x_*cos_theta_L4_;
    const double arm_L4_head_y_ = p->L4_head_s_x_*sin_theta_L4_;
    const double cos_theta_L2_ = cos(L2_theta_);
    const double sin_theta_L2_ = sin(L2_theta_);
    const double arm_L2_head_x_ = p->L2_head_s_x_*cos_theta_L2_;
    const double arm_L2_head_y_ = p->L2_head_s_x_*sin_theta_L2_;
    const double cos_theta_L3_ = cos(L3_theta_);
    const double sin_theta_L3_ = sin(L3_theta_);
    const double arm_L3_head_x_ = p->L3_head_s_x_*cos_theta_L3_;
    const double arm_L3_head_y_ = p->L3_head_s_x_*sin_theta_L3_;
    const double cos_theta_L7_ = cos(L7_theta_);
    const double sin_theta_L7_ = sin(L7_theta_);
    const double arm_L7_head_x_ = p->L7_head_s_x_*cos_theta_L7_;
    const double arm_L7_head_y_ = p->L7_head_s_x_*sin_theta_L7_;
    const double cos_theta_L6_ = cos(L6_theta_);
    const double sin_theta_L6_ = sin(L6_theta_);
    const double arm_L6_head_x_ = p->L6_head_s_x_*cos_theta_L6_;
    const double arm_L6_head_y_ = p->L6_head_s_x_*sin_theta_L6_;
    const double cos_theta_L8_ = cos(L8_theta_);
    const double sin_theta_L8_ = sin(L8_theta_);
    const double arm_L8_head_x_ = p->L8_head_s_x_*cos_theta_L8_;
    const double arm_L8_head_y_ = p->L8_head_s_x_*sin_theta_L8_;
    const double crank1_acceleration_ = 0.0;
    const double crank4_acceleration_ = 0.0;

    /* rows */
    gamma_rows[0] = (L1_omega_ * L1_omega_)*arm_L1_head_x_;  /* O1.x, m/s^2 */
    gamma_rows[1] = (L1_omega_ * L1_omega_)*arm_L1_head_y_;  /* O1.y, m/s^2 */
    gamma_rows[2] = (L4_omega_ * L4_omega_)*arm_L4_head_x_;  /* O4.x, m/s^2 */
    gamma_rows[3] = (L4_omega_ * L4_omega_)*arm_L4_head_y_;  /* O4.y, m/s^2 */
    /* A.x, m/s^2; open, A has play */
    gamma_rows[4] = (L1_omega_ * L1_omega_)*arm_L1_head_x_ + (L2_omega_ * L2_omega_)*arm_L2_head_x_;
    /* A.y, m/s^2; open, A has play */
    gamma_rows[5] = (L1_omega_ * L1_omega_)*arm_L1_head_y_ + (L2_omega_ * L2_omega_)*arm_L2_head_y_;
    /* B.x, m/s^2; open, B has play */
    gamma_rows[6] = (L3_omega_ * L3_omega_)*arm_L3_head_x_ + (L4_omega_ * L4_omega_)*arm_L4_head_x_;
    /* B.y, m/s^2; open, B has play */
    gamma_rows[7] = (L3_omega_ * L3_omega_)*arm_L3_head_y_ + (L4_omega_ * L4_omega_)*arm_L4_head_y_;
    gamma_rows[8] = (L2_omega_ * L2_omega_)*arm_L2_head_x_ + (L7_omega_ * L7_omega_)*arm_L7_head_x_;  /* P2.x, m/s^2 */
    gamma_rows[9] = (L2_omega_ * L2_omega_)*arm_L2_head_y_ + (L7_omega_ * L7_omega_)*arm_L7_head_y_;  /* P2.y, m/s^2 */
    gamma_rows[10] = (L3_omega_ * L3_omega_)*arm_L3_head_x_ + (L7_omega_ * L7_omega_)*arm_L7_head_x_;  /* P3.x, m/s^2 */
    gamma_rows[11] = (L3_omega_ * L3_omega_)*arm_L3_head_y_ + (L7_omega_ * L7_omega_)*arm_L7_head_y_;  /* P3.y, m/s^2 */
    /* Q6.x, m/s^2 */
    gamma_rows[12] = -(L6_omega_ * L6_omega_)*arm_L6_head_x_ + (L7_omega_ * L7_omega_)*arm_L7_head_x_;
    /* Q6.y, m/s^2 */
    gamma_rows[13] = -(L6_omega_ * L6_omega_)*arm_L6_head_y_ + (L7_omega_ * L7_omega_)*arm_L7_head_y_;
    gamma_rows[14] = (L7_omega_ * L7_omega_)*arm_L7_head_x_ + (L8_omega_ * L8_omega_)*arm_L8_head_x_;  /* Q8.x, m/s^2 */
    gamma_rows[15] = (L7_omega_ * L7_omega_)*arm_L7_head_y_ + (L8_omega_ * L8_omega_)*arm_L8_head_y_;  /* Q8.y, m/s^2 */
    gamma_rows[16] = (L6_omega_ * L6_omega_)*arm_L6_head_x_;  /* O6.x, m/s^2 */
    gamma_rows[17] = (L6_omega_ * L6_omega_)*arm_L6_head_y_;  /* O6.y, m/s^2 */
    gamma_rows[18] = (L8_omega_ * L8_omega_)*arm_L8_head_x_;  /* slider.x, m/s^2 */
    gamma_rows[19] = (L8_omega_ * L8_omega_)*arm_L8_head_y_;  /* slider.y, m/s^2 */
    gamma_rows[20] = 0.0;  /* guide.offset, m/s^2 */
    gamma_rows[21] = 0.0;  /* guide.angle, rad/s^2 */
    gamma_rows[22] = crank1_acceleration_;  /* crank1, rad/s^2 */
    gamma_rows[23] = crank4_acceleration_;  /* crank4, rad/s^2 */
}

/*
 * Values of the file's start: guesses, set values, then rates; those of journals follow.
 */
void start_values(const Parameters *p, double *guess, double *set, double *rates)
{
    (void)set, (void)rates;
    /* start */
    guess[0] = p->guess_L2_theta_;  /* start.guess.L2.theta */
    guess[1] = p->guess_L3_theta_;  /* start.guess.L3.theta */
    guess[2] = p->guess_L6_theta_;  /* start.guess.L6.theta */
    guess[3] = p->guess_L7_theta_;  /* start.guess.L7.theta */
    guess[4] = p->guess_L8_theta_;  /* start.guess.L8.theta */
}

/*
 * Reactions (Fx, Fy, M on the second body at the joint's point, its part of -Phi_q^T lambda),
 * drive torques on the driven body, kinetic and potential energy.
 */
void outputs(const double t, const double *q, const double *v, const Parameters *p, const double *lambda,
    double *reactions, double *torques, double *series, double *energy)
{
    (void)t, (void)series;
    /* coordinates, velocities, time */
    const double L1_y_ = q[1];
    const double L1_vx_ = v[0];
    const double L1_vy_ = v[1];
    const double L1_omega_ = v[2];
    const double L2_y_ = q[4];
    const double L2_vx_ = v[3];
    const double L2_vy_ = v[4];
    const double L2_omega_ = v[5];
    const double L3_y_ = q[7];
    const double L3_vx_ = v[6];
    const double L3_vy_ = v[7];
    const double L3_omega_ = v[8];
    const double L4_y_ = q[10];
    const double L4_vx_ = v[9];
    const double L4_vy_ = v[10];
    const double L4_omega_ = v[11];
    const double L6_y_ = q[13];
    const double L6_vx_ = v[12];
    const double L6_vy_ = v[13];
    const double L6_omega_ = v[14];
    const double L7_y_ = q[16];
    const double L7_vx_ = v[15];
    const double L7_vy_ = v[16];
    const double L7_omega_ = v[17];
    const double L8_y_ = q[19];
    const double L8_vx_ = v[18];
    const double L8_vy_ = v[19];
    const double L8_omega_ = v[20];
    const double S9_y_ = q[22];
    const double S9_vx_ = v[21];
    const double S9_vy_ = v[22];
    const double S9_omega_ = v[23];

    /* multipliers */
    const double multiplier_O1_x_ = lambda[0];
    const double multiplier_O1_y_ = lambda[1];
    const double multiplier_O4_x_ = lambda[2];
    const double multiplier_O4_y_ = lambda[3];
    const double multiplier_P2_x_ = lambda[4];
    const double multiplier_P2_y_ = lambda[5];
    const double multiplier_P3_x_ = lambda[6];
    const double multiplier_P3_y_ = lambda[7];
    const double multiplier_Q6_x_ = lambda[8];
    const double multiplier_Q6_y_ = lambda[9];
    const double multiplier_Q8_x_ = lambda[10];
    const double multiplier_Q8_y_ = lambda[11];
    const double multiplier_O6_x_ = lambda[12];
    const double multiplier_O6_y_ = lambda[13];
    const double multiplier_slider_x_ = lambda[14];
    const double multiplier_slider_y_ = lambda[15];
    const double multiplier_guide_offset_ = lambda[16];
    const double multiplier_guide_angle_ = lambda[17];
    const double multiplier_crank1_ = lambda[18];
    const double multiplier_crank4_ = lambda[19];

    /* reactions */
    reactions[0] = multiplier_O1_x_;  /* O1.Fx */
    reactions[1] = multiplier_O1_y_;  /* O1.Fy */
    reactions[2] = 0.0;  /* O1.M */
    reactions[3] = multiplier_O4_x_;  /* O4.Fx */
    reactions[4] = multiplier_O4_y_;  /* O4.Fy */
    reactions[5] = 0.0;  /* O4.M */
    reactions[6] = multiplier_P2_x_;  /* P2.Fx */
    reactions[7] = multiplier_P2_y_;  /* P2.Fy */
    reactions[8] = 0.0;  /* P2.M */
    reactions[9] = multiplier_P3_x_;  /* P3.Fx */
    reactions[10] = multiplier_P3_y_;  /* P3.Fy */
    reactions[11] = 0.0;  /* P3.M */
    reactions[12] = multiplier_Q6_x_;  /* Q6.Fx */
    reactions[13] = multiplier_Q6_y_;  /* Q6.Fy */
    reactions[14] = 0.0;  /* Q6.M */
    reactions[15] = multiplier_Q8_x_;  /* Q8.Fx */
    reactions[16] = multiplier_Q8_y_;  /* Q8.Fy */
    reactions[17] = 0.0;  /* Q8.M */
    reactions[18] = multiplier_O6_x_;  /* O6.Fx */
    reactions[19] = multiplier_O6_y_;  /* O6.Fy */
    reactions[20] = 0.0;  /* O6.M */
    reactions[21] = multiplier_slider_x_;  /* slider.Fx */
    reactions[22] = multiplier_slider_y_;  /* slider.Fy */
    reactions[23] = 0.0;  /* slider.M */
    reactions[24] = multiplier_guide_offset_;  /* guide.Fx */
    reactions[25] = 0.0;  /* guide.Fy */
    reactions[26] = -multiplier_guide_angle_;  /* guide.M */
    torques[0] = -multiplier_crank1_;  /* crank1 */
    torques[1] = -multiplier_crank4_;  /* crank4 */

    /* energy */
    energy[0] = 0.5*p->L1_inertia_*(L1_omega_ * L1_omega_) + 0.5*p->L1_mass_*(L1_vx_ * L1_vx_)
        + 0.5*p->L1_mass_*(L1_vy_ * L1_vy_) + 0.5*p->L2_inertia_*(L2_omega_ * L2_omega_)
        + 0.5*p->L2_mass_*(L2_vx_ * L2_vx_) + 0.5*p->L2_mass_*(L2_vy_ * L2_vy_)
        + 0.5*p->L3_inertia_*(L3_omega_ * L3_omega_) + 0.5*p->L3_mass_*(L3_vx_ * L3_vx_)
        + 0.5*p->L3_mass_*(L3_vy_ * L3_vy_) + 0.5*p->L4_inertia_*(L4_omega_ * L4_omega_)
        + 0.5*p->L4_mass_*(L4_vx_ * L4_vx_) + 0.5*p->L4_mass_*(L4_vy_ * L4_vy_)
        + 0.5*p->L6_inertia_*(L6_omega_ * L6_omega_) + 0.5*p->L6_mass_*(L6_vx_ * L6_vx_)
        + 0.5*p->L6_mass_*(L6_vy_ * L6_vy_) + 0.5*p->L7_inertia_*(L7_omega_ * L7_omega_)
        + 0.5*p->L7_mass_*(L7_vx_ * L7_vx_) + 0.5*p->L7_mass_*(L7_vy_ * L7_vy_)
        + 0.5*p->L8_inertia_*(L8_omega_ * L8_omega_) + 0.5*p->L8_mass_*(L8_vx_ * L8_vx_)
        + 0.5*p->L8_mass_*(L8_vy_ * L8_vy_) + 0.5*p->S9_inertia_*(S9_omega_ * S9_omega_)
        + 0.5*p->S9_mass_*(S9_vx_ * S9_vx_) + 0.5*p->S9_mass_*(S9_vy_ * S9_vy_);
    energy[1] = -p->L1_mass_*L1_y_*p->gravity_y_ - p->L2_mass_*L2_y_*p->gravity_y_ - p->L3_mass_*L3_y_*p->gravity_y_
        - p->L4_mass_*L4_y_*p->gravity_y_ - p->L6_mass_*L6_y_*p->gravity_y_ - p->L7_mass_*L7_y_*p->gravity_y_
        - p->L8_mass_*L8_y_*p->gravity_y_ - p->S9_mass_*S9_y_*p->gravity_y_;
}

/* Return whether two sets of parameters have the same start: compare those that the assembly uses. */
int has_equal_start_parameters(const Parameters *p, const Parameters *other)
{
    return is_same_number(p->L1_mass_, other->L1_mass_)
        && is_same_number(p->L1_inertia_, other->L1_inertia_)
        && is_same_number(p->L2_mass_, other->L2_mass_)
        && is_same_number(p->L2_inertia_, other->L2_inertia_)
        && is_same_number(p->L3_mass_, other->L3_mass_)
        && is_same_number(p->L3_inertia_, other->L3_inertia_)
        && is_same_number(p->L4_mass_, other->L4_mass_)
        && is_same_number(p->L4_inertia_, other->L4_inertia_)
        && is_same_number(p->L6_mass_, other->L6_mass_)
        && is_same_number(p->L6_inertia_, other->L6_inertia_)
        && is_same_number(p->L7_mass_, other->L7_mass_)
        && is_same_number(p->L7_inertia_, other->L7_inertia_)
        && is_same_number(p->L8_mass_, other->L8_mass_)
        && is_same_number(p->L8_inertia_, other->L8_inertia_)
        && is_same_number(p->S9_mass_, other->S9_mass_)
        && is_same_number(p->S9_inertia_, other->S9_inertia_)
        && is_same_number(p->omega_, other->omega_)
        && is_same_number(p->omega4_, other->omega4_)
        && is_same_number(p->L1_head_s_x_, other->L1_head_s_x_)
        && is_same_number(p->L2_head_s_x_, other->L2_head_s_x_)
        && is_same_number(p->L3_head_s_x_, other->L3_head_s_x_)
        && is_same_number(p->L4_head_s_x_, other->L4_head_s_x_)
        && is_same_number(p->L6_head_s_x_, other->L6_head_s_x_)
        && is_same_number(p->L7_head_s_x_, other->L7_head_s_x_)
        && is_same_number(p->L8_head_s_x_, other->L8_head_s_x_)
        && is_same_number(p->O4_y_, other->O4_y_)
        && is_same_number(p->O6_x_, other->O6_x_)
        && is_same_number(p->guess_L2_theta_, other->guess_L2_theta_)
        && is_same_number(p->guess_L3_theta_, other->guess_L3_theta_)
        && is_same_number(p->guess_L6_theta_, other->guess_L6_theta_)
        && is_same_number(p->guess_L7_theta_, other->guess_L7_theta_)
        && is_same_number(p->guess_L8_theta_, other->guess_L8_theta_);
}
