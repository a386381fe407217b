/*
 * Lankarani and Nikravesh: Hertz stiffness with hysteresis damping.
 * Source: H. M. Lankarani, P. E. Nikravesh, J. Mech. Design 112 (1990) 369-376.
 * Valid: c_e near 1 (c_e = .9 delivers .91318); external spheres unless geometry is internal.
 * Options: geometry: external.
 */
static inline void normal_A_force(double delta, double ratio, const Parameters *p, const double *side,
    double *g, double *F_n_out)
{
    /* parameters */
    const double oil_normal_exponent = p->oil_normal_exponent;
    const double oil_pin_K = p->oil_pin_K;
    const double oil_pin_hysteresis = p->oil_pin_hysteresis;

    /* law of joint A */
    const double side_0 = side_of(side, g, 0, oil_pin_hysteresis*ratio + 1.0);
    *F_n_out = pow(delta, oil_normal_exponent)*oil_pin_K*(side_0 < 0.0 ? 0.0 : oil_pin_hysteresis*ratio +
        1.0);
}

/*
 * modified Coulomb friction.
 * Source: physics.md section 3, after J. A. C. Ambrosio.
 * Valid: sliding; creeps below v1 where Coulomb's law would stick.
 */
static inline void friction_A_force(double F_n, double v_t, const Parameters *p, const double *side,
    double *g, double *F_t_out)
{
    /* parameters */
    const double oil_friction_mu = p->oil_friction_mu;
    const double oil_friction_v0 = p->oil_friction_v0;
    const double oil_pin_friction_slope = p->oil_pin_friction_slope;

    /* law of joint A */
    const double side_1 = side_of(side, g, 1, -oil_pin_friction_slope*(-oil_friction_v0 - v_t) + 1.0);
    const double side_2 = side_of(side, g, 2, (side_1 < 0.0 ? 1.0 : oil_pin_friction_slope*(-oil_friction_v0 -
        v_t)));
    const double side_3 = side_of(side, g, 3, -oil_pin_friction_slope*(-oil_friction_v0 + v_t) + 1.0);
    const double side_4 = side_of(side, g, 4, (side_3 < 0.0 ? 1.0 : oil_pin_friction_slope*(-oil_friction_v0 +
        v_t)));
    *F_t_out = -F_n*oil_friction_mu*(-(side_2 < 0.0 ? 0.0 : (side_1 < 0.0 ? 1.0 :
        oil_pin_friction_slope*(-oil_friction_v0 - v_t))) + (side_4 < 0.0 ? 0.0 : (side_3 < 0.0 ? 1.0 :
        oil_pin_friction_slope*(-oil_friction_v0 + v_t))));
}

/*
 * Pinkus and Sternlicht: long journal bearing, half film.
 * Source: O. Pinkus, B. Sternlicht, Theory of Hydrodynamic Lubrication (1961), sign corrected.
 * Valid: long bearing (L/D >> 1); follows Guembel's film for |omega_s| >> |d epsilon/dt|; epsilon capped at .9999.
 * Options: as_printed: False, shear: False, angular_velocity: absolute.
 */
static inline void film_A_force(double epsilon, double w_n, double w_t, const Parameters *p, const
    double *side, double *g, double *F_r_out, double *F_t_out, double *T0_out)
{
    /* parameters */
    const double oil_pin_S = p->oil_pin_S;

    /* law of joint A */
    const double root = sqrt(1.0 - (epsilon * epsilon));
    const double W = sqrt((w_n * w_n) + (w_t * w_t));
    const double side_5 = side_of(side, g, 5, w_n);
    const double factor = (1.5)*epsilon*w_n/(W*root + (1.5)*epsilon*side_5*w_n + 1e-150) + 1.0;
    const double inverse_root = 1.0/root;
    const double inverse_sum = 1.0/((epsilon * epsilon) + 2.0);
    *F_r_out = -(inverse_root * inverse_root * inverse_root)*oil_pin_S*(4.0*W*epsilon*inverse_sum*root +
        3.141592653589793*factor*w_n);
    *F_t_out = -2.0*3.141592653589793*factor*inverse_root*inverse_sum*oil_pin_S*w_t;
    *T0_out = 0.0;
}

/*
 * Dry contact in joint A (physics.md, section 3); none for delta < 0, where a step may look that ends
 * at the separation.
 * Both bodies take the force at one point, in the middle of the penetration: a_i - a_j = e, so that
 * linear and angular momentum are conserved to rounding. F_n < 0 pushes the journal back.
 */
static inline PinForce dry_A(double delta, double deltadot, double de_t, double omega_i, double omega_j,
    const Latch *latch, const Parameters *p, const double *side, double *g)
{
    /* before an onset is accepted the impact velocity is that of the stage itself: ratio 1 */
    const double ratio = latch->closed ? deltadot / latch->deltadot_minus : 1.0;
    const double a_i = (0.5)*delta + p->pin_radius;
    const double a_j = -0.5*delta + p->R_j_pin;
    const double v_t = -a_i*omega_i + a_j*omega_j + de_t;
    double F_n, F_along_t_dry;
    normal_A_force(max_of(delta, 0.0), ratio, p, side, g, &F_n);
    friction_A_force(F_n, v_t, p, side, g, &F_along_t_dry);
    const double M_i_dry = -F_along_t_dry*a_i;
    const double M_j_dry = F_along_t_dry*a_j;
    return (PinForce){-F_n, F_along_t_dry, M_i_dry, M_j_dry, v_t};
}

/*
 * Film in joint A (physics.md, section 4), finite at e = 0 and, with epsilon capped, at every e.
 * Effective squeeze velocity w = de - (omega_i + omega_j)/2 z x e, over the film's clearance.
 */
static inline PinForce film_A(double e, double deltadot, double de_t, double omega_i, double omega_j,
    const Parameters *p, const double *side, double *g)
{
    const double side_6 = side_of(side, g, 6, -e*p->inverse_pin_clearance + 0.9999);
    const double epsilon = (side_6 < 0.0 ? 0.9999 : e*p->inverse_pin_clearance);
    const double w_n = deltadot*p->inverse_pin_clearance;
    const double w_t = p->inverse_pin_clearance*(de_t - 0.5*e*(omega_i + omega_j));
    double F_r, F_along_t_film, T0;
    film_A_force(epsilon, w_n, w_t, p, side, g, &F_r, &F_along_t_film, &T0);
    (void)T0; /* read only with shear */
    const double M_i_film = -F_along_t_film*e;
    const double M_j_film = 0.0;
    return (PinForce){F_r, F_along_t_film, M_i_film, M_j_film, 0.0};
}

/*
 * Joint A: film for e < c, dry contact for e > c + e_0, a linear blend between them
 * (the paper's Eq. 17); a step holds what it began with.
 */
static void clearance_A(double e_x, double e_y, double de_x, double de_y, double omega_i, double omega_j,
    const Latch *latch, const Parameters *p, const double *side, double *g, Clearance *out)
{
    const double e = sqrt((e_x * e_x) + (e_y * e_y));
    const double inverse_e = 1.0/e;
    const double n_x = e > 0.0 ? e_x*inverse_e : 1.0;
    const double n_y = e > 0.0 ? e_y*inverse_e : 0.0;
    const double delta = e - p->pin_clearance;
    const double deltadot = de_x*n_x + de_y*n_y;
    const double de_t = -de_x*n_y + de_y*n_x;
    for (int k = 0; k < 8; k++)
        g[k] = NAN; /* what does not act does not switch */
    if (!(side ? latch->closed : delta > 0.0)) {
        const PinForce F = film_A(e, deltadot, de_t, omega_i, omega_j, p, side, g);
        *out = (Clearance){.Fx = F.n * n_x - F.t * n_y, .Fy = F.n * n_y + F.t * n_x, .F_n = F.n, .F_t = F.t,
        .ex = e_x, .ey = e_y, .e = e, .deltadot = deltadot, .v_t = F.v_t,
        .moment_first = F.M_i, .moment_second = F.M_j, .delta = delta, .power = 0.0};
        return;
    }
    const double side_7 = side_of(side, g, 7, -delta*p->inverse_oil_transition + 1.0);
    const double share = (side_7 < 0.0 ? 1.0 : delta*p->inverse_oil_transition);
    PinForce F = dry_A(delta, deltadot, de_t, omega_i, omega_j, latch, p, side, g);
    if (share < 1.0) {
        const PinForce film = film_A(e, deltadot, de_t, omega_i, omega_j, p, side, g);
        F.n += (1.0 - share) * (film.n - F.n);
        F.t += (1.0 - share) * (film.t - F.t);
        F.M_i += (1.0 - share) * (film.M_i - F.M_i);
        F.M_j += (1.0 - share) * (film.M_j - F.M_j);
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
static inline void normal_B_force(double delta, double ratio, const Parameters *p, const double *side,
    double *g, double *F_n_out)
{
    /* parameters */
    const double oil_normal_exponent = p->oil_normal_exponent;
    const double oil_pin_K = p->oil_pin_K;
    const double oil_pin_hysteresis = p->oil_pin_hysteresis;

    /* law of joint B */
    const double side_8 = side_of(side, g, 8, oil_pin_hysteresis*ratio + 1.0);
    *F_n_out = pow(delta, oil_normal_exponent)*oil_pin_K*(side_8 < 0.0 ? 0.0 : oil_pin_hysteresis*ratio +
        1.0);
}

/*
 * modified Coulomb friction.
 * Source: physics.md section 3, after J. A. C. Ambrosio.
 * Valid: sliding; creeps below v1 where Coulomb's law would stick.
 */
static inline void friction_B_force(double F_n, double v_t, const Parameters *p, const double *side,
    double *g, double *F_t_out)
{
    /* parameters */
    const double oil_friction_mu = p->oil_friction_mu;
    const double oil_friction_v0 = p->oil_friction_v0;
    const double oil_pin_friction_slope = p->oil_pin_friction_slope;

    /* law of joint B */
    const double side_9 = side_of(side, g, 9, -oil_pin_friction_slope*(-oil_friction_v0 - v_t) + 1.0);
    const double side_10 = side_of(side, g, 10, (side_9 < 0.0 ? 1.0 : oil_pin_friction_slope*(-oil_friction_v0
        - v_t)));
    const double side_11 = side_of(side, g, 11, -oil_pin_friction_slope*(-oil_friction_v0 + v_t) + 1.0);
    const double side_12 = side_of(side, g, 12, (side_11 < 0.0 ? 1.0 :
        oil_pin_friction_slope*(-oil_friction_v0 + v_t)));
    *F_t_out = -F_n*oil_friction_mu*(-(side_10 < 0.0 ? 0.0 : (side_9 < 0.0 ? 1.0 :
        oil_pin_friction_slope*(-oil_friction_v0 - v_t))) + (side_12 < 0.0 ? 0.0 : (side_11 < 0.0 ? 1.0 :
        oil_pin_friction_slope*(-oil_friction_v0 + v_t))));
}

/*
 * Pinkus and Sternlicht: long journal bearing, half film.
 * Source: O. Pinkus, B. Sternlicht, Theory of Hydrodynamic Lubrication (1961), sign corrected.
 * Valid: long bearing (L/D >> 1); follows Guembel's film for |omega_s| >> |d epsilon/dt|; epsilon capped at .9999.
 * Options: as_printed: False, shear: False, angular_velocity: absolute.
 */
static inline void film_B_force(double epsilon, double w_n, double w_t, const Parameters *p, const
    double *side, double *g, double *F_r_out, double *F_t_out, double *T0_out)
{
    /* parameters */
    const double oil_pin_S = p->oil_pin_S;

    /* law of joint B */
    const double root = sqrt(1.0 - (epsilon * epsilon));
    const double W = sqrt((w_n * w_n) + (w_t * w_t));
    const double side_13 = side_of(side, g, 13, w_n);
    const double factor = (1.5)*epsilon*w_n/(W*root + (1.5)*epsilon*side_13*w_n + 1e-150) + 1.0;
    const double inverse_root = 1.0/root;
    const double inverse_sum = 1.0/((epsilon * epsilon) + 2.0);
    *F_r_out = -(inverse_root * inverse_root * inverse_root)*oil_pin_S*(4.0*W*epsilon*inverse_sum*root +
        3.141592653589793*factor*w_n);
    *F_t_out = -2.0*3.141592653589793*factor*inverse_root*inverse_sum*oil_pin_S*w_t;
    *T0_out = 0.0;
}

/*
 * Dry contact in joint B (physics.md, section 3); none for delta < 0, where a step may look that ends
 * at the separation.
 * Both bodies take the force at one point, in the middle of the penetration: a_i - a_j = e, so that
 * linear and angular momentum are conserved to rounding. F_n < 0 pushes the journal back.
 */
static inline PinForce dry_B(double delta, double deltadot, double de_t, double omega_i, double omega_j,
    const Latch *latch, const Parameters *p, const double *side, double *g)
{
    /* before an onset is accepted the impact velocity is that of the stage itself: ratio 1 */
    const double ratio = latch->closed ? deltadot / latch->deltadot_minus : 1.0;
    const double a_i = (0.5)*delta + p->pin_radius;
    const double a_j = -0.5*delta + p->R_j_pin;
    const double v_t = -a_i*omega_i + a_j*omega_j + de_t;
    double F_n, F_along_t_dry;
    normal_B_force(max_of(delta, 0.0), ratio, p, side, g, &F_n);
    friction_B_force(F_n, v_t, p, side, g, &F_along_t_dry);
    const double M_i_dry = -F_along_t_dry*a_i;
    const double M_j_dry = F_along_t_dry*a_j;
    return (PinForce){-F_n, F_along_t_dry, M_i_dry, M_j_dry, v_t};
}

/*
 * Film in joint B (physics.md, section 4), finite at e = 0 and, with epsilon capped, at every e.
 * Effective squeeze velocity w = de - (omega_i + omega_j)/2 z x e, over the film's clearance.
 */
static inline PinForce film_B(double e, double deltadot, double de_t, double omega_i, double omega_j,
    const Parameters *p, const double *side, double *g)
{
    const double side_14 = side_of(side, g, 14, -e*p->inverse_pin_clearance + 0.9999);
    const double epsilon = (side_14 < 0.0 ? 0.9999 : e*p->inverse_pin_clearance);
    const double w_n = deltadot*p->inverse_pin_clearance;
    const double w_t = p->inverse_pin_clearance*(de_t - 0.5*e*(omega_i + omega_j));
    double F_r, F_along_t_film, T0;
    film_B_force(epsilon, w_n, w_t, p, side, g, &F_r, &F_along_t_film, &T0);
    (void)T0; /* read only with shear */
    const double M_i_film = -F_along_t_film*e;
    const double M_j_film = 0.0;
    return (PinForce){F_r, F_along_t_film, M_i_film, M_j_film, 0.0};
}

/*
 * Joint B: film for e < c, dry contact for e > c + e_0, a linear blend between them
 * (the paper's Eq. 17); a step holds what it began with.
 */
static void clearance_B(double e_x, double e_y, double de_x, double de_y, double omega_i, double omega_j,
    const Latch *latch, const Parameters *p, const double *side, double *g, Clearance *out)
{
    const double e = sqrt((e_x * e_x) + (e_y * e_y));
    const double inverse_e = 1.0/e;
    const double n_x = e > 0.0 ? e_x*inverse_e : 1.0;
    const double n_y = e > 0.0 ? e_y*inverse_e : 0.0;
    const double delta = e - p->pin_clearance;
    const double deltadot = de_x*n_x + de_y*n_y;
    const double de_t = -de_x*n_y + de_y*n_x;
    for (int k = 8; k < 16; k++)
        g[k] = NAN; /* what does not act does not switch */
    if (!(side ? latch->closed : delta > 0.0)) {
        const PinForce F = film_B(e, deltadot, de_t, omega_i, omega_j, p, side, g);
        *out = (Clearance){.Fx = F.n * n_x - F.t * n_y, .Fy = F.n * n_y + F.t * n_x, .F_n = F.n, .F_t = F.t,
        .ex = e_x, .ey = e_y, .e = e, .deltadot = deltadot, .v_t = F.v_t,
        .moment_first = F.M_i, .moment_second = F.M_j, .delta = delta, .power = 0.0};
        return;
    }
    const double side_15 = side_of(side, g, 15, -delta*p->inverse_oil_transition + 1.0);
    const double share = (side_15 < 0.0 ? 1.0 : delta*p->inverse_oil_transition);
    PinForce F = dry_B(delta, deltadot, de_t, omega_i, omega_j, latch, p, side, g);
    if (share < 1.0) {
        const PinForce film = film_B(e, deltadot, de_t, omega_i, omega_j, p, side, g);
        F.n += (1.0 - share) * (film.n - F.n);
        F.t += (1.0 - share) * (film.t - F.t);
        F.M_i += (1.0 - share) * (film.M_i - F.M_i);
        F.M_j += (1.0 - share) * (film.M_j - F.M_j);
    }
    *out = (Clearance){.Fx = F.n * n_x - F.t * n_y, .Fy = F.n * n_y + F.t * n_x, .F_n = F.n, .F_t = F.t,
        .ex = e_x, .ey = e_y, .e = e, .deltadot = deltadot, .v_t = F.v_t,
        .moment_first = F.M_i, .moment_second = F.M_j, .delta = delta, .power = 0.0};
}
