/*
 * Lankarani and Nikravesh: Hertz stiffness with hysteresis damping.
 * Source: H. M. Lankarani, P. E. Nikravesh, J. Mech. Design 112 (1990) 369-376.
 * Valid: c_e near 1 (c_e = .9 delivers .91318); external spheres unless geometry is internal.
 * Options: geometry: external.
 */
static inline void normal_A_force(double delta, double ratio, const Parameters *p, double *F_n_out)
{
    /* parameters */
    const double dry_normal_exponent = p->dry_normal_exponent;
    const double A_K = p->A_K;
    const double A_hysteresis = p->A_hysteresis;

    /* law of joint A */
    *F_n_out = max_of(A_K*pow(delta, dry_normal_exponent)*(A_hysteresis*ratio + 1.0), 0.0);
}

/*
 * modified Coulomb friction.
 * Source: physics.md section 3, after J. A. C. Ambrosio.
 * Valid: sliding; creeps below v1 where Coulomb's law would stick.
 */
static inline void friction_A_force(double F_n, double v_t, const Parameters *p, double *F_t_out)
{
    /* parameters */
    const double dry_friction_mu = p->dry_friction_mu;
    const double dry_friction_v0 = p->dry_friction_v0;
    const double A_friction_slope = p->A_friction_slope;

    /* law of joint A */
    *F_t_out = -F_n*dry_friction_mu*sign_of(v_t)*max_of(min_of(A_friction_slope*(-dry_friction_v0 +
        fabs(v_t)), 1.0), 0.0);
}

/*
 * Dry contact in joint A, delta > 0 (physics.md, section 3).
 * Both bodies take the force at one point, in the middle of the penetration: a_i - a_j = e, so that
 * linear and angular momentum are conserved to rounding. F_n < 0 pushes the journal back.
 */
static inline void dry_A(double e, double deltadot, double edot_t, double omega_i, double omega_j,
    const Latch *latch, const Parameters *p, double *F_n, double *F_t, double *M_i, double *M_j, double *v_t)
{
    const double delta = e - p->pin_clearance;
    /* before an onset is accepted the impact velocity is that of the stage itself: ratio 1 */
    const double ratio = latch->closed ? deltadot / latch->deltadot_minus : 1.0;
    const double a_i = p->pin_radius + 0.5 * delta;
    const double a_j = p->R_j_pin - 0.5 * delta;
    double N;
    normal_A_force(delta, ratio, p, &N);
    *v_t = edot_t + omega_j * a_j - omega_i * a_i;
    friction_A_force(N, *v_t, p, F_t);
    *F_n = -N;
    *M_i = -a_i * *F_t;
    *M_j = a_j * *F_t;
}

/* Joint A: free while delta < 0, dry contact beyond. */
static void clearance_A(double ex, double ey, double edot_x, double edot_y, double omega_i, double omega_j,
    const Latch *latch, const Parameters *p, Clearance *out)
{
    const double e = sqrt(ex * ex + ey * ey);
    const double nx = e > 0.0 ? ex / e : 1.0; /* at e = 0 any direction will do: the force is isotropic there */
    const double ny = e > 0.0 ? ey / e : 0.0;
    const double deltadot = edot_x * nx + edot_y * ny;
    const double edot_t = edot_y * nx - edot_x * ny;
    const double delta = e - p->pin_clearance;
    double F_n = 0.0, F_t = 0.0, M_i = 0.0, M_j = 0.0, v_t = 0.0;
    if (delta > 0.0)
        dry_A(e, deltadot, edot_t, omega_i, omega_j, latch, p, &F_n, &F_t, &M_i, &M_j, &v_t);
    *out = (Clearance){.Fx = F_n * nx - F_t * ny, .Fy = F_n * ny + F_t * nx, .F_n = F_n, .F_t = F_t,
        .ex = ex, .ey = ey, .e = e, .deltadot = deltadot, .v_t = v_t,
        .moment_first = M_i, .moment_second = M_j, .delta = delta, .power = 0.0};
}

/*
 * Lankarani and Nikravesh: Hertz stiffness with hysteresis damping.
 * Source: H. M. Lankarani, P. E. Nikravesh, J. Mech. Design 112 (1990) 369-376.
 * Valid: c_e near 1 (c_e = .9 delivers .91318); external spheres unless geometry is internal.
 * Options: geometry: external.
 */
static inline void normal_B_force(double delta, double ratio, const Parameters *p, double *F_n_out)
{
    /* parameters */
    const double dry_normal_exponent = p->dry_normal_exponent;
    const double A_K = p->A_K;
    const double A_hysteresis = p->A_hysteresis;

    /* law of joint B */
    *F_n_out = max_of(A_K*pow(delta, dry_normal_exponent)*(A_hysteresis*ratio + 1.0), 0.0);
}

/*
 * modified Coulomb friction.
 * Source: physics.md section 3, after J. A. C. Ambrosio.
 * Valid: sliding; creeps below v1 where Coulomb's law would stick.
 */
static inline void friction_B_force(double F_n, double v_t, const Parameters *p, double *F_t_out)
{
    /* parameters */
    const double dry_friction_mu = p->dry_friction_mu;
    const double dry_friction_v0 = p->dry_friction_v0;
    const double A_friction_slope = p->A_friction_slope;

    /* law of joint B */
    *F_t_out = -F_n*dry_friction_mu*sign_of(v_t)*max_of(min_of(A_friction_slope*(-dry_friction_v0 +
        fabs(v_t)), 1.0), 0.0);
}

/*
 * Dry contact in joint B, delta > 0 (physics.md, section 3).
 * Both bodies take the force at one point, in the middle of the penetration: a_i - a_j = e, so that
 * linear and angular momentum are conserved to rounding. F_n < 0 pushes the journal back.
 */
static inline void dry_B(double e, double deltadot, double edot_t, double omega_i, double omega_j,
    const Latch *latch, const Parameters *p, double *F_n, double *F_t, double *M_i, double *M_j, double *v_t)
{
    const double delta = e - p->pin_clearance;
    /* before an onset is accepted the impact velocity is that of the stage itself: ratio 1 */
    const double ratio = latch->closed ? deltadot / latch->deltadot_minus : 1.0;
    const double a_i = p->pin_radius + 0.5 * delta;
    const double a_j = p->R_j_pin - 0.5 * delta;
    double N;
    normal_B_force(delta, ratio, p, &N);
    *v_t = edot_t + omega_j * a_j - omega_i * a_i;
    friction_B_force(N, *v_t, p, F_t);
    *F_n = -N;
    *M_i = -a_i * *F_t;
    *M_j = a_j * *F_t;
}

/* Joint B: free while delta < 0, dry contact beyond. */
static void clearance_B(double ex, double ey, double edot_x, double edot_y, double omega_i, double omega_j,
    const Latch *latch, const Parameters *p, Clearance *out)
{
    const double e = sqrt(ex * ex + ey * ey);
    const double nx = e > 0.0 ? ex / e : 1.0; /* at e = 0 any direction will do: the force is isotropic there */
    const double ny = e > 0.0 ? ey / e : 0.0;
    const double deltadot = edot_x * nx + edot_y * ny;
    const double edot_t = edot_y * nx - edot_x * ny;
    const double delta = e - p->pin_clearance;
    double F_n = 0.0, F_t = 0.0, M_i = 0.0, M_j = 0.0, v_t = 0.0;
    if (delta > 0.0)
        dry_B(e, deltadot, edot_t, omega_i, omega_j, latch, p, &F_n, &F_t, &M_i, &M_j, &v_t);
    *out = (Clearance){.Fx = F_n * nx - F_t * ny, .Fy = F_n * ny + F_t * nx, .F_n = F_n, .F_t = F_t,
        .ex = ex, .ey = ey, .e = e, .deltadot = deltadot, .v_t = v_t,
        .moment_first = M_i, .moment_second = M_j, .delta = delta, .power = 0.0};
}
