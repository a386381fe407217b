/*
 * Lankarani and Nikravesh: Hertz stiffness with hysteresis damping.
 * Source: H. M. Lankarani, P. E. Nikravesh, J. Mech. Design 112 (1990) 369-376.
 * Valid: c_e near 1 (c_e = .9 delivers .91318); external spheres unless geometry is internal.
 * Options: geometry: external.
 */
static inline void normal_wristpin_force(double delta, double ratio, const Parameters *p, const double *side,
    double *g, double *F_n_out)
{
    /* parameters */
    const double dry_normal_exponent = p->dry_normal_exponent;
    const double dry_pin_K = p->dry_pin_K;
    const double dry_pin_hysteresis = p->dry_pin_hysteresis;

    /* law of joint wristpin */
    const double side_0 = side_of(side, g, 0, dry_pin_hysteresis*ratio + 1.0);
    *F_n_out = pow(delta, dry_normal_exponent)*dry_pin_K*(side_0 < 0.0 ? 0.0 : dry_pin_hysteresis*ratio +
        1.0);
}

/*
 * modified Coulomb friction.
 * Source: physics.md section 3, after J. A. C. Ambrosio.
 * Valid: sliding; creeps below v1 where Coulomb's law would stick.
 */
static inline void friction_wristpin_force(double F_n, double v_t, const Parameters *p, const double *side,
    double *g, double *F_t_out)
{
    /* parameters */
    const double dry_friction_mu = p->dry_friction_mu;
    const double dry_friction_v0 = p->dry_friction_v0;
    const double dry_pin_friction_slope = p->dry_pin_friction_slope;

    /* law of joint wristpin */
    const double side_1 = side_of(side, g, 1, -dry_pin_friction_slope*(-dry_friction_v0 - v_t) + 1.0);
    const double side_2 = side_of(side, g, 2, (side_1 < 0.0 ? 1.0 : dry_pin_friction_slope*(-dry_friction_v0 -
        v_t)));
    const double side_3 = side_of(side, g, 3, -dry_pin_friction_slope*(-dry_friction_v0 + v_t) + 1.0);
    const double side_4 = side_of(side, g, 4, (side_3 < 0.0 ? 1.0 : dry_pin_friction_slope*(-dry_friction_v0 +
        v_t)));
    *F_t_out = -F_n*dry_friction_mu*(-(side_2 < 0.0 ? 0.0 : (side_1 < 0.0 ? 1.0 :
        dry_pin_friction_slope*(-dry_friction_v0 - v_t))) + (side_4 < 0.0 ? 0.0 : (side_3 < 0.0 ? 1.0 :
        dry_pin_friction_slope*(-dry_friction_v0 + v_t))));
}

/*
 * Dry contact in joint wristpin (physics.md, section 3); none for delta < 0, where a step may look that ends
 * at the separation.
 * Both bodies take the force at one point, in the middle of the penetration: a_i - a_j = e, so that
 * linear and angular momentum are conserved to rounding. F_n < 0 pushes the journal back.
 */
static inline PinForce dry_wristpin(double delta, double deltadot, double de_t, double omega_i, double omega_j,
    const Latch *latch, const Parameters *p, const double *side, double *g)
{
    /* before an onset is accepted the impact velocity is that of the stage itself: ratio 1 */
    const double ratio = latch->closed ? deltadot / latch->deltadot_minus : 1.0;
    const double a_i = (0.5)*delta + p->pin_radius;
    const double a_j = -0.5*delta + p->R_j_pin;
    const double v_t = -a_i*omega_i + a_j*omega_j + de_t;
    double F_n, F_along_t_dry;
    normal_wristpin_force(max_of(delta, 0.0), ratio, p, side, g, &F_n);
    friction_wristpin_force(F_n, v_t, p, side, g, &F_along_t_dry);
    const double M_i_dry = -F_along_t_dry*a_i;
    const double M_j_dry = F_along_t_dry*a_j;
    return (PinForce){-F_n, F_along_t_dry, M_i_dry, M_j_dry, v_t};
}

/* Joint wristpin: free while delta < 0, dry contact beyond; a step holds what it began with. */
static void clearance_wristpin(double e_x, double e_y, double de_x, double de_y, double omega_i, double omega_j,
    const Latch *latch, const Parameters *p, const double *side, double *g, Clearance *out)
{
    const double e = sqrt((e_x * e_x) + (e_y * e_y));
    const double inverse_e = 1.0/e;
    const double n_x = e > 0.0 ? e_x*inverse_e : 1.0;
    const double n_y = e > 0.0 ? e_y*inverse_e : 0.0;
    const double delta = e - p->pin_clearance;
    const double deltadot = de_x*n_x + de_y*n_y;
    const double de_t = -de_x*n_y + de_y*n_x;
    PinForce F = {0};
    for (int k = 0; k < 5; k++)
        g[k] = NAN; /* without contact nothing switches */
    if (side ? latch->closed : delta > 0.0)
        F = dry_wristpin(delta, deltadot, de_t, omega_i, omega_j, latch, p, side, g);
    *out = (Clearance){.Fx = F.n * n_x - F.t * n_y, .Fy = F.n * n_y + F.t * n_x, .F_n = F.n, .F_t = F.t,
        .ex = e_x, .ey = e_y, .e = e, .deltadot = deltadot, .v_t = F.v_t,
        .moment_first = F.M_i, .moment_second = F.M_j, .delta = delta, .power = 0.0};
}
