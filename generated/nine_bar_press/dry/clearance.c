/*
 * Lankarani and Nikravesh: Hertz stiffness with hysteresis damping.
 * F_n = K*delta^exponent*max(0, hysteresis*ratio + 1)
 * delta: penetration; ratio: deltadot/deltadot_minus.
 * Source: H. M. Lankarani, P. E. Nikravesh, J. Mech. Design 112 (1990) 369-376.
 * Valid: values of c_e near 1: c_e = 0.9 delivers the restitution 0.91318.
 * Properties: the stiffness is that of external spheres, unless `geometry` is `internal`.
 * Options: geometry: external.
 * exponent: exponent of the penetration; K: contact stiffness; hysteresis: hysteresis damping factor a.
 */
static inline void lankarani_nikravesh(double delta, double ratio, double exponent, double K, double hysteresis,
    const double *branch, double *g, int corner, double *F_n_out)
{
    const double side_1 = branch_of(branch, g, corner, hysteresis*ratio + 1.0);
    double larger_1;
    if (side_1 < 0.0)
        larger_1 = 0.0;
    else
        larger_1 = hysteresis*ratio + 1.0;
    *F_n_out = pow(delta, exponent)*K*larger_1;
}

/*
 * modified Coulomb friction.
 * F_t = -F_n*mu*(-max(0, min(1, friction_slope*(-v0 - v_t))) + max(0, min(1, friction_slope*(-v0 + v_t))))
 * F_n: normal force; v_t: slip velocity.
 * Source: physics.md section 3, after J. A. C. Ambrosio.
 * Valid: sliding; below the slip v_1 the contact creeps where Coulomb's law would stick.
 * mu: coefficient of friction; v0: slip below which there is no friction; friction_slope: 1/(v1 - v0).
 */
static inline void modified_coulomb(double F_n, double v_t, double mu, double v0, double friction_slope,
    const double *branch, double *g, int corner, double *F_t_out)
{
    const double side_1 = branch_of(branch, g, corner, -friction_slope*(-v0 - v_t) + 1.0);
    double smaller_1;
    if (side_1 < 0.0)
        smaller_1 = 1.0;
    else
        smaller_1 = friction_slope*(-v0 - v_t);
    const double side_2 = branch_of(branch, g, corner + 1, smaller_1);
    const double side_3 = branch_of(branch, g, corner + 2, -friction_slope*(-v0 + v_t) + 1.0);
    double smaller_2;
    if (side_3 < 0.0)
        smaller_2 = 1.0;
    else
        smaller_2 = friction_slope*(-v0 + v_t);
    const double side_4 = branch_of(branch, g, corner + 3, smaller_2);
    double larger_1;
    if (side_2 < 0.0)
        larger_1 = 0.0;
    else
        larger_1 = smaller_1;
    double larger_2;
    if (side_4 < 0.0)
        larger_2 = 0.0;
    else
        larger_2 = smaller_2;
    *F_t_out = -F_n*mu*(-larger_1 + larger_2);
}

/*
 * Force of the dry contact in joint A (physics.md, section 3). It is zero for delta < 0, where a step
 * that ends at the separation may evaluate it.
 * It acts on both bodies at one point, in the middle of the penetration: a_i - a_j = e, so that linear and angular
 * momentum are conserved to rounding. F_n > 0 pushes the journal back: the returned force along n is -F_n.
 */
static inline PinForce dry_A_(double delta, double deltadot, double de_t, double omega_i, double omega_j,
    const ContactState *contact, const Parameters *p, const double *branch, double *g)
{
    /* before an onset is accepted, the approach speed deltadot_minus is the current deltadot: ratio 1 */
    const double ratio = contact->closed ? deltadot / contact->deltadot_minus : 1.0;
    const double a_i = 0.5*delta + p->pin_radius_;
    const double a_j = -0.5*delta + p->R_j_pin_;
    const double v_t = -a_i*omega_i + a_j*omega_j + de_t;
    double F_n;
    lankarani_nikravesh(max_of(delta, 0.0), ratio, p->dry_normal_exponent_, p->dry_pin_K_, p->dry_pin_hysteresis_,
        branch, g, 0, &F_n);
    double F_along_t_dry;
    modified_coulomb(F_n, v_t, p->dry_friction_mu_, p->dry_friction_v0_, p->dry_pin_friction_slope_, branch, g, 1,
        &F_along_t_dry);
    const double M_i_dry = -F_along_t_dry*a_i;
    const double M_j_dry = F_along_t_dry*a_j;
    return (PinForce){-F_n, F_along_t_dry, M_i_dry, M_j_dry, v_t};
}

/* Joint A: force on the journal; zero for delta < 0, dry contact for delta > 0, frozen over a step. */
static void clearance_A_(double e_x, double e_y, double de_x, double de_y, double omega_i, double omega_j,
    const ContactState *contact, const Parameters *p, const double *branch, double *g, Clearance *out)
{
    const double e = sqrt((e_x * e_x) + (e_y * e_y));
    const double inverse_e = 1.0/e;
    const double n_x = e > 0.0 ? e_x*inverse_e : 1.0;
    const double n_y = e > 0.0 ? e_y*inverse_e : 0.0;
    const double delta = e - p->pin_clearance_;
    const double deltadot = de_x*n_x + de_y*n_y;
    const double de_t = -de_x*n_y + de_y*n_x;
    PinForce F = {0};
    for (int k = 0; k < 5; k++)
        g[k] = NAN; /* without contact no switching function is active */
    if (branch ? contact->closed : delta > 0.0)
        F = dry_A_(delta, deltadot, de_t, omega_i, omega_j, contact, p, branch, g);
    *out = (Clearance){.Fx = F.n * n_x - F.t * n_y, .Fy = F.n * n_y + F.t * n_x, .F_n = F.n, .F_t = F.t,
        .ex = e_x, .ey = e_y, .e = e, .deltadot = deltadot, .v_t = F.v_t,
        .moment_first = F.M_i, .moment_second = F.M_j, .delta = delta, .power = 0.0};
}

/*
 * Force of the dry contact in joint B (physics.md, section 3). It is zero for delta < 0, where a step
 * that ends at the separation may evaluate it.
 * It acts on both bodies at one point, in the middle of the penetration: a_i - a_j = e, so that linear and angular
 * momentum are conserved to rounding. F_n > 0 pushes the journal back: the returned force along n is -F_n.
 */
static inline PinForce dry_B_(double delta, double deltadot, double de_t, double omega_i, double omega_j,
    const ContactState *contact, const Parameters *p, const double *branch, double *g)
{
    /* before an onset is accepted, the approach speed deltadot_minus is the current deltadot: ratio 1 */
    const double ratio = contact->closed ? deltadot / contact->deltadot_minus : 1.0;
    const double a_i = 0.5*delta + p->pin_radius_;
    const double a_j = -0.5*delta + p->R_j_pin_;
    const double v_t = -a_i*omega_i + a_j*omega_j + de_t;
    double F_n;
    lankarani_nikravesh(max_of(delta, 0.0), ratio, p->dry_normal_exponent_, p->dry_pin_K_, p->dry_pin_hysteresis_,
        branch, g, 5, &F_n);
    double F_along_t_dry;
    modified_coulomb(F_n, v_t, p->dry_friction_mu_, p->dry_friction_v0_, p->dry_pin_friction_slope_, branch, g, 6,
        &F_along_t_dry);
    const double M_i_dry = -F_along_t_dry*a_i;
    const double M_j_dry = F_along_t_dry*a_j;
    return (PinForce){-F_n, F_along_t_dry, M_i_dry, M_j_dry, v_t};
}

/* Joint B: force on the journal; zero for delta < 0, dry contact for delta > 0, frozen over a step. */
static void clearance_B_(double e_x, double e_y, double de_x, double de_y, double omega_i, double omega_j,
    const ContactState *contact, const Parameters *p, const double *branch, double *g, Clearance *out)
{
    const double e = sqrt((e_x * e_x) + (e_y * e_y));
    const double inverse_e = 1.0/e;
    const double n_x = e > 0.0 ? e_x*inverse_e : 1.0;
    const double n_y = e > 0.0 ? e_y*inverse_e : 0.0;
    const double delta = e - p->pin_clearance_;
    const double deltadot = de_x*n_x + de_y*n_y;
    const double de_t = -de_x*n_y + de_y*n_x;
    PinForce F = {0};
    for (int k = 5; k < 10; k++)
        g[k] = NAN; /* without contact no switching function is active */
    if (branch ? contact->closed : delta > 0.0)
        F = dry_B_(delta, deltadot, de_t, omega_i, omega_j, contact, p, branch, g);
    *out = (Clearance){.Fx = F.n * n_x - F.t * n_y, .Fy = F.n * n_y + F.t * n_x, .F_n = F.n, .F_t = F.t,
        .ex = e_x, .ey = e_y, .e = e, .deltadot = deltadot, .v_t = F.v_t,
        .moment_first = F.M_i, .moment_second = F.M_j, .delta = delta, .power = 0.0};
}
