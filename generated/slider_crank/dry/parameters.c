/*
 * Every number of a run: slots given or by default, then what follows from them.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    p->omega = is_given[0] ? given[0] : 20.0*PI;  /* parameters.omega */
    p->c = is_given[1] ? given[1] : 0.0002;  /* parameters.c */
    p->crank_mass = is_given[2] ? given[2] : 0.3;  /* bodies.crank.mass */
    p->crank_inertia = is_given[3] ? given[3] : 0.0001;  /* bodies.crank.inertia */
    p->rod_mass = is_given[4] ? given[4] : 0.21;  /* bodies.rod.mass */
    p->rod_inertia = is_given[5] ? given[5] : 0.00025;  /* bodies.rod.inertia */
    p->slider_mass = is_given[6] ? given[6] : 0.14;  /* bodies.slider.mass */
    p->slider_inertia = is_given[7] ? given[7] : 0.0001;  /* bodies.slider.inertia */
    p->crank_length = is_given[8] ? given[8] : 0.05;  /* bodies.crank.length */
    p->rod_length = is_given[9] ? given[9] : 0.12;  /* bodies.rod.length */
    p->alpha = is_given[10] ? given[10] : 50.0;  /* baumgarte.alpha */
    p->beta = is_given[11] ? given[11] : 50.0;  /* baumgarte.beta */
    p->cylinder_axis_x = is_given[12] ? given[12] : 1.0;  /* joints.cylinder.axis.x */
    p->pin_radius = is_given[13] ? given[13] : 0.01;  /* bearings.pin.radius */
    p->pin_clearance = is_given[14] ? given[14] : p->c;  /* bearings.pin.clearance */
    p->pin_length = is_given[15] ? given[15] : 0.02;  /* bearings.pin.length */
    p->steel_E = is_given[16] ? given[16] : 207000000000.0;  /* materials.steel.E */
    p->steel_nu = is_given[17] ? given[17] : 0.3;  /* materials.steel.nu */
    p->dry_normal_restitution = is_given[18] ? given[18] : 0.9;  /* contacts.dry.normal.restitution */
    p->dry_normal_exponent = is_given[19] ? given[19] : 1.5;  /* contacts.dry.normal.exponent */
    p->dry_friction_mu = is_given[20] ? given[20] : 0.03;  /* contacts.dry.friction.mu */
    p->dry_friction_v0 = is_given[21] ? given[21] : 0.001;  /* contacts.dry.friction.v0 */
    p->dry_friction_v1 = is_given[22] ? given[22] : 0.01;  /* contacts.dry.friction.v1 */
    p->velocity_floor = is_given[23] ? given[23] : 1e-06;  /* contacts.dry.velocity_floor */
    p->guess_rod_theta = is_given[24] ? given[24] : 0.0;  /* start.guess.rod.theta */
    p->guess_slider_x = is_given[25] ? given[25] : 0.17;  /* start.guess.slider.x */

    /* derived */
    p->crank_head_s_x = 0.5*p->crank_length;  /* point from the centre of mass */
    p->rod_head_s_x = 0.5*p->rod_length;  /* point from the centre of mass */
    p->R_j_pin = -p->pin_clearance + p->pin_radius;  /* journal radius */
    /* contact stiffness */
    p->dry_pin_K = (2.0/3.0)*p->steel_E*sqrt(p->R_j_pin*p->pin_radius/(p->R_j_pin + p->pin_radius))/(1.0
        - (p->steel_nu * p->steel_nu));
    /* hysteresis damping factor a */
    p->dry_pin_hysteresis = 0.75 - 0.75*(p->dry_normal_restitution * p->dry_normal_restitution);
    p->dry_pin_friction_slope = 1.0/(-p->dry_friction_v0 + p->dry_friction_v1);  /* 1/(v1 - v0) */
    p->two_alpha = 2.0*p->alpha;  /* 2 alpha */
    p->beta_squared = (p->beta * p->beta);  /* beta^2 */
    p->inverse_slider_mass = 1.0/p->slider_mass;  /* 1/M */
    p->inverse_rod_mass = 1.0/p->rod_mass;  /* 1/M */
    p->inverse_slider_inertia = 1.0/p->slider_inertia;  /* 1/M */
    p->inverse_crank_mass = 1.0/p->crank_mass;  /* 1/M */
    p->inverse_rod_inertia = 1.0/p->rod_inertia;  /* 1/M */
    p->inverse_crank_inertia = 1.0/p->crank_inertia;  /* 1/M */
    p->crank_head_span_x = 2.0*p->crank_head_s_x;  /* vector in its frame */
    p->rod_head_span_x = 2.0*p->rod_head_s_x;  /* vector in its frame */
    /* sum of m w.w */
    p->inertia_crank_crank = (p->crank_head_span_x * p->crank_head_span_x)*p->rod_mass
        + (p->crank_head_s_x * p->crank_head_s_x)*p->crank_mass;
    p->inertia_crank_rod = p->crank_head_span_x*p->rod_head_s_x*p->rod_mass;  /* sum of m w.w */
    p->inertia_rod_rod = (p->rod_head_s_x * p->rod_head_s_x)*p->rod_mass;  /* sum of m w.w */
    p->mass_motor_motor = p->crank_inertia + p->inertia_crank_crank;  /* constant of M */
    p->mass_rod_rod = p->inertia_rod_rod + p->rod_inertia;  /* constant of M */
    p->inverse_mass_rod_rod = 1.0/p->mass_rod_rod;  /* 1/M */
}

/* Radial clearance of joint i with play, m. */
double radial_clearance(const Parameters *p, int i)
{
    (void)p;
    switch (i) {
    case 0:
        return p->pin_clearance;
    default:
        return 0.0;
    }
}

/* The penetration beyond which contact laws mean nothing, m: a tenth of the bearing's radius. */
double deepest(const Parameters *p, int i)
{
    (void)p;
    switch (i) {
    case 0:
        return (1.0/10.0)*p->pin_radius;
    default:
        return 0.0;
    }
}

/* The least velocity that counts as that of an impact, m/s. */
double slowest_impact(const Parameters *p, int i)
{
    (void)p;
    switch (i) {
    case 0:
        return p->velocity_floor;
    default:
        return 0.0;
    }
}

