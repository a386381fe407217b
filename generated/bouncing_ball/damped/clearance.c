/*
 * Hertz contact with a choice of hysteresis damping.
 * F_n = delta^exponent*stiffness*max(0, hysteresis*ratio + 1)
 * delta: penetration; ratio: deltadot/deltadot_minus.
 * Source: H. Hertz (1881); K. H. Hunt, F. R. E. Crossley, J. Appl. Mech. 42 (1975) 440-445.
 * Valid: a point or a line contact whose stiffness is known, or a contact with the stiffness of spheres, at small
 * penetrations.
 * Options: dissipation: hunt_crossley, pulls: False.
 * stiffness: force at unit penetration, N/m^n; exponent: exponent of the penetration; hysteresis: hysteresis
 * damping factor a.
 */
static inline void hertz(double delta, double ratio, double stiffness, double exponent, double hysteresis,
    const double *branch, double *g, int corner, double *F_n_out)
{
    const double side_1 = branch_of(branch, g, corner, hysteresis*ratio + 1.0);
    double larger_1;
    if (side_1 < 0.0)
        larger_1 = 0.0;
    else
        larger_1 = hysteresis*ratio + 1.0;
    *F_n_out = stiffness*pow(delta, exponent)*larger_1;
}

/*
 * Force of the dry contact in joint fall (physics.md, section 3). It is zero for delta < 0, where a step
 * that ends at the separation may evaluate it.
 * It acts on both bodies at one point, in the middle of the penetration: a_i - a_j = e, so that linear and angular
 * momentum are conserved to rounding. F_n > 0 pushes the journal back: the returned force along n is -F_n.
 */
static inline PinForce dry_fall_(double delta, double deltadot, double de_t, double omega_i, double omega_j,
    const ContactState *contact, const Parameters *p, const double *branch, double *g)
{
    /* before an onset is accepted, the approach speed deltadot_minus is the current deltadot: ratio 1 */
    const double ratio = contact->closed ? deltadot / contact->deltadot_minus : 1.0;
    const double a_i = 0.5*delta + p->floor_radius_;
    const double a_j = -0.5*delta + p->R_j_floor_;
    const double v_t = -a_i*omega_i + a_j*omega_j + de_t;
    double F_n;
    hertz(max_of(delta, 0.0), ratio, p->damped_normal_stiffness_, p->damped_normal_exponent_,
        p->damped_floor_hysteresis_, branch, g, 0, &F_n);
    const double F_along_t_dry = 0.0; /* no friction */
    const double M_i_dry = -F_along_t_dry*a_i;
    const double M_j_dry = F_along_t_dry*a_j;
    return (PinForce){-F_n, F_along_t_dry, M_i_dry, M_j_dry, v_t};
}

/* Joint fall: force on the journal; zero for delta < 0, dry contact for delta > 0, frozen over a step. */
static void clearance_fall_(double e_x, double e_y, double de_x, double de_y, double omega_i, double omega_j,
    const ContactState *contact, const Parameters *p, const double *branch, double *g, Clearance *out)
{
    const double e = sqrt((e_x * e_x) + (e_y * e_y));
    const double inverse_e = 1.0/e;
    const double n_x = e > 0.0 ? e_x*inverse_e : 1.0;
    const double n_y = e > 0.0 ? e_y*inverse_e : 0.0;
    const double delta = e - p->floor_clearance_;
    const double deltadot = de_x*n_x + de_y*n_y;
    const double de_t = -de_x*n_y + de_y*n_x;
    PinForce F = {0};
    for (int k = 0; k < 1; k++)
        g[k] = NAN; /* without contact no switching function is active */
    if (branch ? contact->closed : delta > 0.0)
        F = dry_fall_(delta, deltadot, de_t, omega_i, omega_j, contact, p, branch, g);
    *out = (Clearance){.Fx = F.n * n_x - F.t * n_y, .Fy = F.n * n_y + F.t * n_x, .F_n = F.n, .F_t = F.t,
        .ex = e_x, .ey = e_y, .e = e, .deltadot = deltadot, .v_t = F.v_t,
        .moment_first = F.M_i, .moment_second = F.M_j, .delta = delta, .power = 0.0};
}
