/*
 * Lankarani and Nikravesh: Hertz stiffness with hysteresis damping.
 * Source: H. M. Lankarani, P. E. Nikravesh, J. Mech. Design 112 (1990) 369-376.
 * Valid: c_e near 1 (c_e = .9 delivers .91318); external spheres unless geometry is internal.
 * Options: geometry: external.
 */
static inline void normal_A_force(double delta, double ratio, const Parameters *p, double *F_n_out)
{
    /* parameters */
    const double oil_normal_exponent = p->oil_normal_exponent;
    const double A_K = p->A_K;
    const double A_hysteresis = p->A_hysteresis;

    /* law of joint A */
    *F_n_out = max_of(A_K*pow(delta, oil_normal_exponent)*(A_hysteresis*ratio + 1.0), 0.0);
}

/*
 * modified Coulomb friction.
 * Source: physics.md section 3, after J. A. C. Ambrosio.
 * Valid: sliding; creeps below v1 where Coulomb's law would stick.
 */
static inline void friction_A_force(double F_n, double v_t, const Parameters *p, double *F_t_out)
{
    /* parameters */
    const double oil_friction_mu = p->oil_friction_mu;
    const double oil_friction_v0 = p->oil_friction_v0;
    const double A_friction_slope = p->A_friction_slope;

    /* law of joint A */
    *F_t_out = -F_n*oil_friction_mu*sign_of(v_t)*max_of(min_of(A_friction_slope*(-oil_friction_v0 +
        fabs(v_t)), 1.0), 0.0);
}

/*
 * Pinkus and Sternlicht: long journal bearing, half film.
 * Source: O. Pinkus, B. Sternlicht, Theory of Hydrodynamic Lubrication (1961), sign corrected.
 * Valid: long bearing (L/D >> 1); follows Guembel's film for |omega_s| >> |d epsilon/dt|; epsilon capped at .9999.
 * Options: as_printed: False, shear: False, angular_velocity: absolute.
 */
static inline void film_A_force(double epsilon, double w_n, double w_t, const Parameters *p, double *F_r_out,
    double *F_t_out, double *T0_out)
{
    /* parameters */
    const double A_S = p->A_S;

    /* law of joint A */
    const double root = sqrt(1.0 - (epsilon * epsilon));
    const double W = sqrt((w_n * w_n) + (w_t * w_t));
    const double factor = (3.0/2.0)*epsilon*w_n/(W*root + (3.0/2.0)*epsilon*fabs(w_n) + 1e-300) + 1.0;
    *F_r_out = -A_S*(4.0*W*epsilon*root/((epsilon * epsilon) + 2.0) + 3.141592653589793*factor*w_n)/(root *
        root * root);
    *F_t_out = -2.0*3.141592653589793*A_S*factor*w_t/(root*((epsilon * epsilon) + 2.0));
    *T0_out = 0.0;
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

/*
 * Film in joint A (physics.md, section 4), finite at e = 0 and, with epsilon capped, at every e.
 * Effective squeeze velocity w = edot - (omega_i + omega_j)/2 z x e, over the film's clearance.
 */
static inline void film_A(double e, double deltadot, double edot_t, double omega_i, double omega_j,
    const Parameters *p, double *F_n, double *F_t, double *M_i, double *M_j)
{
    const double c = p->pin_clearance;
    const double epsilon = min_of(e / c, 0.9999);
    const double w_n = deltadot / c;
    const double w_t = (edot_t - 0.5 * (omega_i + omega_j) * e) / c;
    double T0;
    film_A_force(epsilon, w_n, w_t, p, F_n, F_t, &T0);
    *M_j = T0 * 0.0;
    *M_i = -e * *F_t;
}

/*
 * Joint A: film for e < c, dry contact for e > c + e_0, a linear blend between them
 * (the paper's Eq. 17).
 */
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
    const double dry_share = max_of(min_of(delta / p->oil_transition, 1.0), 0.0);
    if (dry_share < 1.0)
        film_A(e, deltadot, edot_t, omega_i, omega_j, p, &F_n, &F_t, &M_i, &M_j);
    if (dry_share > 0.0) {
        double dry_n, dry_t, dry_i, dry_j;
        dry_A(e, deltadot, edot_t, omega_i, omega_j, latch, p, &dry_n, &dry_t, &dry_i, &dry_j, &v_t);
        F_n += dry_share * (dry_n - F_n);
        F_t += dry_share * (dry_t - F_t);
        M_i += dry_share * (dry_i - M_i);
        M_j += dry_share * (dry_j - M_j);
    }
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
    const double oil_normal_exponent = p->oil_normal_exponent;
    const double A_K = p->A_K;
    const double A_hysteresis = p->A_hysteresis;

    /* law of joint B */
    *F_n_out = max_of(A_K*pow(delta, oil_normal_exponent)*(A_hysteresis*ratio + 1.0), 0.0);
}

/*
 * modified Coulomb friction.
 * Source: physics.md section 3, after J. A. C. Ambrosio.
 * Valid: sliding; creeps below v1 where Coulomb's law would stick.
 */
static inline void friction_B_force(double F_n, double v_t, const Parameters *p, double *F_t_out)
{
    /* parameters */
    const double oil_friction_mu = p->oil_friction_mu;
    const double oil_friction_v0 = p->oil_friction_v0;
    const double A_friction_slope = p->A_friction_slope;

    /* law of joint B */
    *F_t_out = -F_n*oil_friction_mu*sign_of(v_t)*max_of(min_of(A_friction_slope*(-oil_friction_v0 +
        fabs(v_t)), 1.0), 0.0);
}

/*
 * Pinkus and Sternlicht: long journal bearing, half film.
 * Source: O. Pinkus, B. Sternlicht, Theory of Hydrodynamic Lubrication (1961), sign corrected.
 * Valid: long bearing (L/D >> 1); follows Guembel's film for |omega_s| >> |d epsilon/dt|; epsilon capped at .9999.
 * Options: as_printed: False, shear: False, angular_velocity: absolute.
 */
static inline void film_B_force(double epsilon, double w_n, double w_t, const Parameters *p, double *F_r_out,
    double *F_t_out, double *T0_out)
{
    /* parameters */
    const double A_S = p->A_S;

    /* law of joint B */
    const double root = sqrt(1.0 - (epsilon * epsilon));
    const double W = sqrt((w_n * w_n) + (w_t * w_t));
    const double factor = (3.0/2.0)*epsilon*w_n/(W*root + (3.0/2.0)*epsilon*fabs(w_n) + 1e-300) + 1.0;
    *F_r_out = -A_S*(4.0*W*epsilon*root/((epsilon * epsilon) + 2.0) + 3.141592653589793*factor*w_n)/(root *
        root * root);
    *F_t_out = -2.0*3.141592653589793*A_S*factor*w_t/(root*((epsilon * epsilon) + 2.0));
    *T0_out = 0.0;
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

/*
 * Film in joint B (physics.md, section 4), finite at e = 0 and, with epsilon capped, at every e.
 * Effective squeeze velocity w = edot - (omega_i + omega_j)/2 z x e, over the film's clearance.
 */
static inline void film_B(double e, double deltadot, double edot_t, double omega_i, double omega_j,
    const Parameters *p, double *F_n, double *F_t, double *M_i, double *M_j)
{
    const double c = p->pin_clearance;
    const double epsilon = min_of(e / c, 0.9999);
    const double w_n = deltadot / c;
    const double w_t = (edot_t - 0.5 * (omega_i + omega_j) * e) / c;
    double T0;
    film_B_force(epsilon, w_n, w_t, p, F_n, F_t, &T0);
    *M_j = T0 * 0.0;
    *M_i = -e * *F_t;
}

/*
 * Joint B: film for e < c, dry contact for e > c + e_0, a linear blend between them
 * (the paper's Eq. 17).
 */
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
    const double dry_share = max_of(min_of(delta / p->oil_transition, 1.0), 0.0);
    if (dry_share < 1.0)
        film_B(e, deltadot, edot_t, omega_i, omega_j, p, &F_n, &F_t, &M_i, &M_j);
    if (dry_share > 0.0) {
        double dry_n, dry_t, dry_i, dry_j;
        dry_B(e, deltadot, edot_t, omega_i, omega_j, latch, p, &dry_n, &dry_t, &dry_i, &dry_j, &v_t);
        F_n += dry_share * (dry_n - F_n);
        F_t += dry_share * (dry_t - F_t);
        M_i += dry_share * (dry_i - M_i);
        M_j += dry_share * (dry_j - M_j);
    }
    *out = (Clearance){.Fx = F_n * nx - F_t * ny, .Fy = F_n * ny + F_t * nx, .F_n = F_n, .F_t = F_t,
        .ex = ex, .ey = ey, .e = e, .deltadot = deltadot, .v_t = v_t,
        .moment_first = M_i, .moment_second = M_j, .delta = delta, .power = 0.0};
}
