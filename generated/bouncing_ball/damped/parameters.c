/*
 * Fill all parameters of a run: given values or defaults, then derived parameters.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    p->height_ = is_given[0] ? given[0] : 1.0;  /* parameters.height */
    p->ball_mass_ = is_given[1] ? given[1] : 0.092;  /* bodies.ball.mass */
    p->ball_inertia_ = is_given[2] ? given[2] : 7.212800000000001e-06;  /* bodies.ball.inertia */
    p->alpha_ = is_given[3] ? given[3] : 50.0;  /* baumgarte.alpha */
    p->beta_ = is_given[4] ? given[4] : 50.0;  /* baumgarte.beta */
    p->floor_radius_ = is_given[5] ? given[5] : p->height_ + 0.014;  /* bearings.floor.radius */
    p->floor_clearance_ = is_given[6] ? given[6] : p->height_;  /* bearings.floor.clearance */
    p->floor_length_ = is_given[7] ? given[7] : 0.01;  /* bearings.floor.length */
    p->steel_E_ = is_given[8] ? given[8] : 206000000000.0;  /* materials.steel.E */
    p->steel_nu_ = is_given[9] ? given[9] : 0.3;  /* materials.steel.nu */
    p->damped_normal_stiffness_ = is_given[10] ? given[10] : 140000000.0;  /* contacts.damped.normal.stiffness */
    p->damped_normal_exponent_ = is_given[11] ? given[11] : 1.5;  /* contacts.damped.normal.exponent */
    p->damped_normal_restitution_ = is_given[12] ? given[12] : 0.8;  /* contacts.damped.normal.restitution */
    p->velocity_floor_ = is_given[13] ? given[13] : 1e-06;  /* contacts.damped.velocity_floor */
    p->gravity_y_ = is_given[14] ? given[14] : -9.81;  /* gravity.y */

    /* derived */
    p->R_j_floor_ = -p->floor_clearance_ + p->floor_radius_;  /* journal radius */
    p->damped_floor_hysteresis_ = 1.5 - 1.5*p->damped_normal_restitution_;  /* hysteresis damping factor a */
    p->weight_ball_y_ = p->ball_mass_*p->gravity_y_;  /* weight */
    p->two_alpha_ = 2.0*p->alpha_;  /* 2 alpha */
    p->beta_squared_ = (p->beta_ * p->beta_);  /* beta^2 */
    p->inverse_ball_mass_ = 1.0/p->ball_mass_;  /* 1/M */
    p->inverse_ball_inertia_ = 1.0/p->ball_inertia_;  /* 1/M */
    p->tree_metric_ball_x_ = max_of(0.0001*p->ball_mass_, p->ball_mass_);  /* of projections */
    p->inverse_tree_metric_ball_x_ = 1.0/p->tree_metric_ball_x_;  /* 1/M */
}

/* Radial clearance of joint i with play, m. */
double radial_clearance(const Parameters *p, int i)
{
    (void)p;
    switch (i) {
    case 0:
        return p->floor_clearance_;
    default:
        return 0.0;
    }
}

/* The penetration beyond which contact laws are not valid, m: a tenth of the bearing's radius. */
double max_valid_penetration(const Parameters *p, int i)
{
    (void)p;
    switch (i) {
    case 0:
        return (1.0/10.0)*p->floor_radius_;
    default:
        return 0.0;
    }
}

/* The smallest approach speed that is stored at an onset, m/s. */
double min_approach_speed(const Parameters *p, int i)
{
    (void)p;
    switch (i) {
    case 0:
        return p->velocity_floor_;
    default:
        return 0.0;
    }
}

