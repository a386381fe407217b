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
    const double oil_pin_K = p->oil_pin_K;
    const double oil_pin_hysteresis = p->oil_pin_hysteresis;

    /* law of joint A */
    *F_n_out = max_of(pow(delta, oil_normal_exponent)*oil_pin_K*(oil_pin_hysteresis*ratio + 1.0), 0.0);
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
    const double oil_pin_friction_slope = p->oil_pin_friction_slope;

    /* law of joint A */
    *F_t_out = -F_n*oil_friction_mu*sign_of(v_t)*max_of(min_of(oil_pin_friction_slope*(-oil_friction_v0 +
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
    const double oil_pin_S = p->oil_pin_S;

    /* law of joint A */
    const double root = sqrt(1.0 - (epsilon * epsilon));
    const double W = sqrt((w_n * w_n) + (w_t * w_t));
    const double factor = (1.5)*epsilon*w_n/(W*root + (1.5)*epsilon*fabs(w_n) + 1e-300) + 1.0;
    *F_r_out = -oil_pin_S*(4.0*W*epsilon*root/((epsilon * epsilon) + 2.0) +
        3.141592653589793*factor*w_n)/(root * root * root);
    *F_t_out = -2.0*3.141592653589793*factor*oil_pin_S*w_t/(root*((epsilon * epsilon) + 2.0));
    *T0_out = 0.0;
}

/*
 * Dry contact in joint A, delta > 0 (physics.md, section 3).
 * Both bodies take the force at one point, in the middle of the penetration: a_i - a_j = e, so that
 * linear and angular momentum are conserved to rounding. F_n < 0 pushes the journal back.
 */
static inline PinForce dry_A(double delta, double deltadot, double de_t, double omega_i, double omega_j,
    const Latch *latch, const Parameters *p)
{
    /* before an onset is accepted the impact velocity is that of the stage itself: ratio 1 */
    const double ratio = latch->closed ? deltadot / latch->deltadot_minus : 1.0;
    const double a_i = (0.5)*delta + p->pin_radius;
    const double a_j = -0.5*delta + p->R_j_pin;
    const double v_t = -a_i*omega_i + a_j*omega_j + de_t;
    double F_n, F_along_t_dry;
    normal_A_force(delta, ratio, p, &F_n);
    friction_A_force(F_n, v_t, p, &F_along_t_dry);
    const double M_i_dry = -F_along_t_dry*a_i;
    const double M_j_dry = F_along_t_dry*a_j;
    return (PinForce){-F_n, F_along_t_dry, M_i_dry, M_j_dry, v_t};
}

/*
 * Film in joint A (physics.md, section 4), finite at e = 0 and, with epsilon capped, at every e.
 * Effective squeeze velocity w = de - (omega_i + omega_j)/2 z x e, over the film's clearance.
 */
static inline PinForce film_A(double e, double deltadot, double de_t, double omega_i, double omega_j,
    const Parameters *p)
{
    const double epsilon = min_of(e/p->pin_clearance, 0.9999);
    const double w_n = deltadot/p->pin_clearance;
    const double w_t = (de_t - 0.5*e*(omega_i + omega_j))/p->pin_clearance;
    double F_r, F_along_t_film, T0;
    film_A_force(epsilon, w_n, w_t, p, &F_r, &F_along_t_film, &T0);
    (void)T0; /* read only with shear */
    const double M_i_film = -F_along_t_film*e;
    const double M_j_film = 0.0;
    return (PinForce){F_r, F_along_t_film, M_i_film, M_j_film, 0.0};
}

/*
 * Joint A: film for e < c, dry contact for e > c + e_0, a linear blend between them
 * (the paper's Eq. 17).
 */
static void clearance_A(double e_x, double e_y, double de_x, double de_y, double omega_i, double omega_j,
    const Latch *latch, const Parameters *p, Clearance *out)
{
    const double e = sqrt((e_x * e_x) + (e_y * e_y));
    const double n_x = e > 0.0 ? e_x / e : 1.0;
    const double n_y = e > 0.0 ? e_y / e : 0.0;
    const double delta = e - p->pin_clearance;
    const double deltadot = de_x*n_x + de_y*n_y;
    const double de_t = -de_x*n_y + de_y*n_x;
    PinForce F = {0};
    const double share = max_of(min_of(delta/p->oil_transition, 1.0), 0.0);
    if (share < 1.0)
        F = film_A(e, deltadot, de_t, omega_i, omega_j, p);
    if (share > 0.0) {
        const PinForce dry = dry_A(delta, deltadot, de_t, omega_i, omega_j, latch, p);
        F.n += share * (dry.n - F.n);
        F.t += share * (dry.t - F.t);
        F.M_i += share * (dry.M_i - F.M_i);
        F.M_j += share * (dry.M_j - F.M_j);
        F.v_t = dry.v_t;
    }
    *out = (Clearance){.Fx = F.n * n_x - F.t * n_y, .Fy = F.n * n_y + F.t * n_x, .F_n = F.n, .F_t = F.t,
        .ex = e_x, .ey = e_y, .e = e, .deltadot = deltadot, .v_t = F.v_t,
        .moment_first = F.M_i, .moment_second = F.M_j, .delta = delta, .power = 0.0};
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
    const double oil_pin_K = p->oil_pin_K;
    const double oil_pin_hysteresis = p->oil_pin_hysteresis;

    /* law of joint B */
    *F_n_out = max_of(pow(delta, oil_normal_exponent)*oil_pin_K*(oil_pin_hysteresis*ratio + 1.0), 0.0);
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
    const double oil_pin_friction_slope = p->oil_pin_friction_slope;

    /* law of joint B */
    *F_t_out = -F_n*oil_friction_mu*sign_of(v_t)*max_of(min_of(oil_pin_friction_slope*(-oil_friction_v0 +
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
    const double oil_pin_S = p->oil_pin_S;

    /* law of joint B */
    const double root = sqrt(1.0 - (epsilon * epsilon));
    const double W = sqrt((w_n * w_n) + (w_t * w_t));
    const double factor = (1.5)*epsilon*w_n/(W*root + (1.5)*epsilon*fabs(w_n) + 1e-300) + 1.0;
    *F_r_out = -oil_pin_S*(4.0*W*epsilon*root/((epsilon * epsilon) + 2.0) +
        3.141592653589793*factor*w_n)/(root * root * root);
    *F_t_out = -2.0*3.141592653589793*factor*oil_pin_S*w_t/(root*((epsilon * epsilon) + 2.0));
    *T0_out = 0.0;
}

/*
 * Dry contact in joint B, delta > 0 (physics.md, section 3).
 * Both bodies take the force at one point, in the middle of the penetration: a_i - a_j = e, so that
 * linear and angular momentum are conserved to rounding. F_n < 0 pushes the journal back.
 */
static inline PinForce dry_B(double delta, double deltadot, double de_t, double omega_i, double omega_j,
    const Latch *latch, const Parameters *p)
{
    /* before an onset is accepted the impact velocity is that of the stage itself: ratio 1 */
    const double ratio = latch->closed ? deltadot / latch->deltadot_minus : 1.0;
    const double a_i = (0.5)*delta + p->pin_radius;
    const double a_j = -0.5*delta + p->R_j_pin;
    const double v_t = -a_i*omega_i + a_j*omega_j + de_t;
    double F_n, F_along_t_dry;
    normal_B_force(delta, ratio, p, &F_n);
    friction_B_force(F_n, v_t, p, &F_along_t_dry);
    const double M_i_dry = -F_along_t_dry*a_i;
    const double M_j_dry = F_along_t_dry*a_j;
    return (PinForce){-F_n, F_along_t_dry, M_i_dry, M_j_dry, v_t};
}

/*
 * Film in joint B (physics.md, section 4), finite at e = 0 and, with epsilon capped, at every e.
 * Effective squeeze velocity w = de - (omega_i + omega_j)/2 z x e, over the film's clearance.
 */
static inline PinForce film_B(double e, double deltadot, double de_t, double omega_i, double omega_j,
    const Parameters *p)
{
    const double epsilon = min_of(e/p->pin_clearance, 0.9999);
    const double w_n = deltadot/p->pin_clearance;
    const double w_t = (de_t - 0.5*e*(omega_i + omega_j))/p->pin_clearance;
    double F_r, F_along_t_film, T0;
    film_B_force(epsilon, w_n, w_t, p, &F_r, &F_along_t_film, &T0);
    (void)T0; /* read only with shear */
    const double M_i_film = -F_along_t_film*e;
    const double M_j_film = 0.0;
    return (PinForce){F_r, F_along_t_film, M_i_film, M_j_film, 0.0};
}

/*
 * Joint B: film for e < c, dry contact for e > c + e_0, a linear blend between them
 * (the paper's Eq. 17).
 */
static void clearance_B(double e_x, double e_y, double de_x, double de_y, double omega_i, double omega_j,
    const Latch *latch, const Parameters *p, Clearance *out)
{
    const double e = sqrt((e_x * e_x) + (e_y * e_y));
    const double n_x = e > 0.0 ? e_x / e : 1.0;
    const double n_y = e > 0.0 ? e_y / e : 0.0;
    const double delta = e - p->pin_clearance;
    const double deltadot = de_x*n_x + de_y*n_y;
    const double de_t = -de_x*n_y + de_y*n_x;
    PinForce F = {0};
    const double share = max_of(min_of(delta/p->oil_transition, 1.0), 0.0);
    if (share < 1.0)
        F = film_B(e, deltadot, de_t, omega_i, omega_j, p);
    if (share > 0.0) {
        const PinForce dry = dry_B(delta, deltadot, de_t, omega_i, omega_j, latch, p);
        F.n += share * (dry.n - F.n);
        F.t += share * (dry.t - F.t);
        F.M_i += share * (dry.M_i - F.M_i);
        F.M_j += share * (dry.M_j - F.M_j);
        F.v_t = dry.v_t;
    }
    *out = (Clearance){.Fx = F.n * n_x - F.t * n_y, .Fy = F.n * n_y + F.t * n_x, .F_n = F.n, .F_t = F.t,
        .ex = e_x, .ey = e_y, .e = e, .deltadot = deltadot, .v_t = F.v_t,
        .moment_first = F.M_i, .moment_second = F.M_j, .delta = delta, .power = 0.0};
}
