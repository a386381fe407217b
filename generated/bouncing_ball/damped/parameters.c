/*
 * Every number of a run: slots given or by default, then what follows from them.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    p->height = is_given[0] ? given[0] : 1.0;  /* parameters.height */
    p->ball_mass = is_given[1] ? given[1] : 0.092;  /* bodies.ball.mass */
    p->ball_inertia = is_given[2] ? given[2] : 7.212800000000001e-06;  /* bodies.ball.inertia */
    p->alpha = is_given[3] ? given[3] : 50.0;  /* baumgarte.alpha */
    p->beta = is_given[4] ? given[4] : 50.0;  /* baumgarte.beta */
    p->floor_radius = is_given[5] ? given[5] : p->height + 0.014;  /* bearings.floor.radius */
    p->floor_clearance = is_given[6] ? given[6] : p->height;  /* bearings.floor.clearance */
    p->floor_length = is_given[7] ? given[7] : 0.01;  /* bearings.floor.length */
    p->steel_E = is_given[8] ? given[8] : 206000000000.0;  /* materials.steel.E */
    p->steel_nu = is_given[9] ? given[9] : 0.3;  /* materials.steel.nu */
    p->damped_normal_stiffness = is_given[10] ? given[10] : 140000000.0;  /* contacts.damped.normal.stiffness */
    p->damped_normal_exponent = is_given[11] ? given[11] : 1.5;  /* contacts.damped.normal.exponent */
    p->damped_normal_restitution = is_given[12] ? given[12] : 0.8;  /* contacts.damped.normal.restitution */
    p->velocity_floor = is_given[13] ? given[13] : 1e-06;  /* contacts.damped.velocity_floor */
    p->gravity_y = is_given[14] ? given[14] : -9.81;  /* gravity.y */

    /* derived */
    p->R_j_floor = -p->floor_clearance + p->floor_radius;  /* journal radius */
    p->damped_floor_hysteresis = 1.5 - 1.5*p->damped_normal_restitution;  /* hysteresis damping factor a */
    p->weight_ball_y = p->ball_mass*p->gravity_y;  /* weight */
    p->two_alpha = 2.0*p->alpha;  /* 2 alpha */
    p->beta_squared = (p->beta * p->beta);  /* beta^2 */
    p->inverse_ball_mass = 1.0/p->ball_mass;  /* 1/M */
    p->inverse_ball_inertia = 1.0/p->ball_inertia;  /* 1/M */
}

/* Radial clearance of joint i with play, m. */
double radial_clearance(const Parameters *p, int i)
{
    (void)p;
    switch (i) {
    case 0:
        return p->floor_clearance;
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
        return (1.0/10.0)*p->floor_radius;
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

