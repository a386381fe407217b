/*
 * Hertz contact with a given stiffness and hysteresis damping.
 * Source: H. Hertz (1881); K. H. Hunt, F. R. E. Crossley, J. Appl. Mech. 42 (1975) 440-445.
 * Valid: a point or a line contact whose stiffness is known; penetrations small against the radii.
 * Options: dissipation: none.
 */
static inline void normal_fall_force(double delta, double ratio, const Parameters *p, double *F_n_out)
{
    (void)ratio;
    /* parameters */
    const double elastic_normal_stiffness = p->elastic_normal_stiffness;
    const double elastic_normal_exponent = p->elastic_normal_exponent;

    /* law of joint fall */
    *F_n_out = max_of(pow(delta, elastic_normal_exponent)*elastic_normal_stiffness, 0.0);
}

/*
 * No friction in this joint.
 */
static inline void friction_fall_force(double F_n, double v_t, const Parameters *p, double *F_t_out)
{
    (void)F_n;
    (void)v_t;
    (void)p;
    /* no friction law */
    *F_t_out = 0.0;
}

/*
 * Dry contact in joint fall, delta > 0 (physics.md, section 3).
 * Both bodies take the force at one point, in the middle of the penetration: a_i - a_j = e, so that
 * linear and angular momentum are conserved to rounding. F_n < 0 pushes the journal back.
 */
static inline void dry_fall(double e, double deltadot, double edot_t, double omega_i, double omega_j,
    const Latch *latch, const Parameters *p, double *F_n, double *F_t, double *M_i, double *M_j, double *v_t)
{
    const double delta = e - p->floor_clearance;
    /* before an onset is accepted the impact velocity is that of the stage itself: ratio 1 */
    const double ratio = latch->closed ? deltadot / latch->deltadot_minus : 1.0;
    const double a_i = p->floor_radius + 0.5 * delta;
    const double a_j = p->R_j_floor - 0.5 * delta;
    double N;
    normal_fall_force(delta, ratio, p, &N);
    *v_t = edot_t + omega_j * a_j - omega_i * a_i;
    friction_fall_force(N, *v_t, p, F_t);
    *F_n = -N;
    *M_i = -a_i * *F_t;
    *M_j = a_j * *F_t;
}

/* Joint fall: free while delta < 0, dry contact beyond. */
static void clearance_fall(double ex, double ey, double edot_x, double edot_y, double omega_i, double omega_j,
    const Latch *latch, const Parameters *p, Clearance *out)
{
    const double e = sqrt(ex * ex + ey * ey);
    const double nx = e > 0.0 ? ex / e : 1.0; /* at e = 0 any direction will do: the force is isotropic there */
    const double ny = e > 0.0 ? ey / e : 0.0;
    const double deltadot = edot_x * nx + edot_y * ny;
    const double edot_t = edot_y * nx - edot_x * ny;
    const double delta = e - p->floor_clearance;
    double F_n = 0.0, F_t = 0.0, M_i = 0.0, M_j = 0.0, v_t = 0.0;
    if (delta > 0.0)
        dry_fall(e, deltadot, edot_t, omega_i, omega_j, latch, p, &F_n, &F_t, &M_i, &M_j, &v_t);
    *out = (Clearance){.Fx = F_n * nx - F_t * ny, .Fy = F_n * ny + F_t * nx, .F_n = F_n, .F_t = F_t,
        .ex = ex, .ey = ey, .e = e, .deltadot = deltadot, .v_t = v_t,
        .moment_first = M_i, .moment_second = M_j, .delta = delta, .power = 0.0};
}
