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
 * Pinkus and Sternlicht: long journal bearing, half film.
 * root = sqrt(1 - epsilon^2)
 * W = sqrt(w_n^2 + w_t^2)
 * factor = 3*epsilon*w_n/(2*(W*root + 3*epsilon*abs(w_n)/2 + 1.0e-150)) + 1
 * F_r = -S*(4*W*epsilon*root/(epsilon^2 + 2) + pi*factor*w_n)/root^3
 * F_t = -2*pi*S*factor*w_t/(root*(epsilon^2 + 2))
 * T0 = 0
 * epsilon: eccentricity ratio e/c; w_n: radial squeeze velocity over c; w_t: tangential squeeze velocity over c.
 * Source: O. Pinkus, B. Sternlicht, Theory of Hydrodynamic Lubrication (1961), sign corrected.
 * Valid: a long bearing (L/D >> 1); the law agrees with Guembel's half film where |omega_s| >> |d epsilon/dt|.
 * Properties: above epsilon = 0.9999 the force is evaluated at 0.9999.
 * Options: as_printed: False, shear: False, angular_velocity: absolute.
 * S: film factor 6 mu R_j^3 L/c^2.
 */
static inline void pinkus_sternlicht(double epsilon, double w_n, double w_t, double S, const double *branch, double *g,
    int corner, double *F_r_out, double *F_t_out, double *T0_out)
{
    const double root = sqrt(1.0 - (epsilon * epsilon));
    const double W = sqrt((w_n * w_n) + (w_t * w_t));
    const double side_1 = branch_of(branch, g, corner, w_n);
    const double factor = 1.5*epsilon*w_n/(W*root + 1.5*epsilon*side_1*w_n + 1e-150) + 1.0;
    const double inverse_root = 1.0/root;
    const double inverse_sum = 1.0/((epsilon * epsilon) + 2.0);
    *F_r_out = -(inverse_root * inverse_root * inverse_root)*S*(4.0*W*epsilon*inverse_sum*root + PI*factor*w_n);
    *F_t_out = -2.0*PI*factor*inverse_root*inverse_sum*S*w_t;
    *T0_out = 0.0;
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
    lankarani_nikravesh(max_of(delta, 0.0), ratio, p->oil_normal_exponent_, p->oil_pin_K_, p->oil_pin_hysteresis_,
        branch, g, 0, &F_n);
    double F_along_t_dry;
    modified_coulomb(F_n, v_t, p->oil_friction_mu_, p->oil_friction_v0_, p->oil_pin_friction_slope_, branch, g, 1,
        &F_along_t_dry);
    const double M_i_dry = -F_along_t_dry*a_i;
    const double M_j_dry = F_along_t_dry*a_j;
    return (PinForce){-F_n, F_along_t_dry, M_i_dry, M_j_dry, v_t};
}

/*
 * Force of the film in joint A (physics.md, section 4), finite at every e, since epsilon is capped.
 * Effective squeeze velocity w = de - (omega_i + omega_j)/2 z x e, over the film's clearance.
 */
static inline PinForce film_A_(double e, double deltadot, double de_t, double omega_i, double omega_j,
    const Parameters *p, const double *branch, double *g)
{
    const double side_6 = branch_of(branch, g, 6, -e*p->inverse_pin_clearance_ + 0.9999);
    double epsilon;
    if (side_6 < 0.0)
        epsilon = 0.9999;
    else
        epsilon = e*p->inverse_pin_clearance_;
    const double w_n = deltadot*p->inverse_pin_clearance_;
    const double w_t = p->inverse_pin_clearance_*(de_t - 0.5*e*(omega_i + omega_j));
    double F_r, F_along_t_film, T0;
    pinkus_sternlicht(epsilon, w_n, w_t, p->oil_pin_S_, branch, g, 5, &F_r, &F_along_t_film, &T0);
    (void)T0; /* read only with shear */
    const double M_i_film = -F_along_t_film*e;
    const double M_j_film = 0.0;
    return (PinForce){F_r, F_along_t_film, M_i_film, M_j_film, 0.0};
}

/*
 * Joint A: film for e < c, dry contact for e > c + e_0, a linear blend between them
 * (the paper's Eq. 17); frozen over a step.
 */
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
    for (int k = 0; k < 8; k++)
        g[k] = NAN; /* a part that does not act has no active switching function */
    if (!(branch ? contact->closed : delta > 0.0)) {
        const PinForce F = film_A_(e, deltadot, de_t, omega_i, omega_j, p, branch, g);
        *out = (Clearance){.Fx = F.n * n_x - F.t * n_y, .Fy = F.n * n_y + F.t * n_x, .F_n = F.n, .F_t = F.t,
        .ex = e_x, .ey = e_y, .e = e, .deltadot = deltadot, .v_t = F.v_t,
        .moment_first = F.M_i, .moment_second = F.M_j, .delta = delta, .power = 0.0};
        return;
    }
    const double side_7 = branch_of(branch, g, 7, -delta*p->inverse_oil_transition_ + 1.0);
    double share;
    if (side_7 < 0.0)
        share = 1.0;
    else
        share = delta*p->inverse_oil_transition_;
    PinForce F = dry_A_(delta, deltadot, de_t, omega_i, omega_j, contact, p, branch, g);
    if (share < 1.0) {
        const PinForce film = film_A_(e, deltadot, de_t, omega_i, omega_j, p, branch, g);
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
    lankarani_nikravesh(max_of(delta, 0.0), ratio, p->oil_normal_exponent_, p->oil_pin_K_, p->oil_pin_hysteresis_,
        branch, g, 8, &F_n);
    double F_along_t_dry;
    modified_coulomb(F_n, v_t, p->oil_friction_mu_, p->oil_friction_v0_, p->oil_pin_friction_slope_, branch, g, 9,
        &F_along_t_dry);
    const double M_i_dry = -F_along_t_dry*a_i;
    const double M_j_dry = F_along_t_dry*a_j;
    return (PinForce){-F_n, F_along_t_dry, M_i_dry, M_j_dry, v_t};
}

/*
 * Force of the film in joint B (physics.md, section 4), finite at every e, since epsilon is capped.
 * Effective squeeze velocity w = de - (omega_i + omega_j)/2 z x e, over the film's clearance.
 */
static inline PinForce film_B_(double e, double deltadot, double de_t, double omega_i, double omega_j,
    const Parameters *p, const double *branch, double *g)
{
    const double side_14 = branch_of(branch, g, 14, -e*p->inverse_pin_clearance_ + 0.9999);
    double epsilon;
    if (side_14 < 0.0)
        epsilon = 0.9999;
    else
        epsilon = e*p->inverse_pin_clearance_;
    const double w_n = deltadot*p->inverse_pin_clearance_;
    const double w_t = p->inverse_pin_clearance_*(de_t - 0.5*e*(omega_i + omega_j));
    double F_r, F_along_t_film, T0;
    pinkus_sternlicht(epsilon, w_n, w_t, p->oil_pin_S_, branch, g, 13, &F_r, &F_along_t_film, &T0);
    (void)T0; /* read only with shear */
    const double M_i_film = -F_along_t_film*e;
    const double M_j_film = 0.0;
    return (PinForce){F_r, F_along_t_film, M_i_film, M_j_film, 0.0};
}

/*
 * Joint B: film for e < c, dry contact for e > c + e_0, a linear blend between them
 * (the paper's Eq. 17); frozen over a step.
 */
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
    for (int k = 8; k < 16; k++)
        g[k] = NAN; /* a part that does not act has no active switching function */
    if (!(branch ? contact->closed : delta > 0.0)) {
        const PinForce F = film_B_(e, deltadot, de_t, omega_i, omega_j, p, branch, g);
        *out = (Clearance){.Fx = F.n * n_x - F.t * n_y, .Fy = F.n * n_y + F.t * n_x, .F_n = F.n, .F_t = F.t,
        .ex = e_x, .ey = e_y, .e = e, .deltadot = deltadot, .v_t = F.v_t,
        .moment_first = F.M_i, .moment_second = F.M_j, .delta = delta, .power = 0.0};
        return;
    }
    const double side_15 = branch_of(branch, g, 15, -delta*p->inverse_oil_transition_ + 1.0);
    double share;
    if (side_15 < 0.0)
        share = 1.0;
    else
        share = delta*p->inverse_oil_transition_;
    PinForce F = dry_B_(delta, deltadot, de_t, omega_i, omega_j, contact, p, branch, g);
    if (share < 1.0) {
        const PinForce film = film_B_(e, deltadot, de_t, omega_i, omega_j, p, branch, g);
        F.n += (1.0 - share) * (film.n - F.n);
        F.t += (1.0 - share) * (film.t - F.t);
        F.M_i += (1.0 - share) * (film.M_i - F.M_i);
        F.M_j += (1.0 - share) * (film.M_j - F.M_j);
    }
    *out = (Clearance){.Fx = F.n * n_x - F.t * n_y, .Fy = F.n * n_y + F.t * n_x, .F_n = F.n, .F_t = F.t,
        .ex = e_x, .ey = e_y, .e = e, .deltadot = deltadot, .v_t = F.v_t,
        .moment_first = F.M_i, .moment_second = F.M_j, .delta = delta, .power = 0.0};
}
