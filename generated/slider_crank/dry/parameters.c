/*
 * Fill all parameters of a run: given values or defaults, then derived parameters.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    p->omega_ = is_given[0] ? given[0] : 20.0*PI;  /* parameters.omega */
    p->c_ = is_given[1] ? given[1] : 0.0002;  /* parameters.c */
    p->crank_mass_ = is_given[2] ? given[2] : 0.3;  /* bodies.crank.mass */
    p->crank_inertia_ = is_given[3] ? given[3] : 0.0001;  /* bodies.crank.inertia */
    p->rod_mass_ = is_given[4] ? given[4] : 0.21;  /* bodies.rod.mass */
    p->rod_inertia_ = is_given[5] ? given[5] : 0.00025;  /* bodies.rod.inertia */
    p->slider_mass_ = is_given[6] ? given[6] : 0.14;  /* bodies.slider.mass */
    p->slider_inertia_ = is_given[7] ? given[7] : 0.0001;  /* bodies.slider.inertia */
    p->crank_length_ = is_given[8] ? given[8] : 0.05;  /* bodies.crank.length */
    p->rod_length_ = is_given[9] ? given[9] : 0.12;  /* bodies.rod.length */
    p->alpha_ = is_given[10] ? given[10] : 50.0;  /* baumgarte.alpha */
    p->beta_ = is_given[11] ? given[11] : 50.0;  /* baumgarte.beta */
    p->cylinder_axis_x_ = is_given[12] ? given[12] : 1.0;  /* joints.cylinder.axis.x */
    p->pin_radius_ = is_given[13] ? given[13] : 0.01;  /* bearings.pin.radius */
    p->pin_clearance_ = is_given[14] ? given[14] : p->c_;  /* bearings.pin.clearance */
    p->pin_length_ = is_given[15] ? given[15] : 0.02;  /* bearings.pin.length */
    p->steel_E_ = is_given[16] ? given[16] : 207000000000.0;  /* materials.steel.E */
    p->steel_nu_ = is_given[17] ? given[17] : 0.3;  /* materials.steel.nu */
    p->dry_normal_restitution_ = is_given[18] ? given[18] : 0.9;  /* contacts.dry.normal.restitution */
    p->dry_normal_exponent_ = is_given[19] ? given[19] : 1.5;  /* contacts.dry.normal.exponent */
    p->dry_friction_mu_ = is_given[20] ? given[20] : 0.03;  /* contacts.dry.friction.mu */
    p->dry_friction_v0_ = is_given[21] ? given[21] : 0.001;  /* contacts.dry.friction.v0 */
    p->dry_friction_v1_ = is_given[22] ? given[22] : 0.01;  /* contacts.dry.friction.v1 */
    p->velocity_floor_ = is_given[23] ? given[23] : 1e-06;  /* contacts.dry.velocity_floor */
    p->guess_rod_theta_ = is_given[24] ? given[24] : 0.0;  /* start.guess.rod.theta */
    p->guess_slider_x_ = is_given[25] ? given[25] : 0.17;  /* start.guess.slider.x */

    /* derived */
    p->crank_head_s_x_ = 0.5*p->crank_length_;  /* point from the centre of mass */
    p->rod_head_s_x_ = 0.5*p->rod_length_;  /* point from the centre of mass */
    p->R_j_pin_ = -p->pin_clearance_ + p->pin_radius_;  /* journal radius */
    /* contact stiffness */
    p->dry_pin_K_ = (2.0/3.0)*p->steel_E_*sqrt(p->R_j_pin_*p->pin_radius_/(p->R_j_pin_ + p->pin_radius_))/(1.0
        - (p->steel_nu_ * p->steel_nu_));
    /* hysteresis damping factor a */
    p->dry_pin_hysteresis_ = 0.75 - 0.75*(p->dry_normal_restitution_ * p->dry_normal_restitution_);
    p->dry_pin_friction_slope_ = 1.0/(-p->dry_friction_v0_ + p->dry_friction_v1_);  /* 1/(v1 - v0) */
    /* J and m s^2 of its joints */
    p->rod_turning_ = 2.0*(p->rod_head_s_x_ * p->rod_head_s_x_)*p->rod_mass_ + p->rod_inertia_;
    p->two_alpha_ = 2.0*p->alpha_;  /* 2 alpha */
    p->beta_squared_ = (p->beta_ * p->beta_);  /* beta^2 */
    p->inverse_slider_mass_ = 1.0/p->slider_mass_;  /* 1/M */
    p->crank_head_span_x_ = 2.0*p->crank_head_s_x_;  /* vector in its frame */
    p->rod_head_span_x_ = 2.0*p->rod_head_s_x_;  /* vector in its frame */
    /* sum of m w.w */
    p->inertia_crank_crank_ = (p->crank_head_span_x_ * p->crank_head_span_x_)*p->rod_mass_
        + (p->crank_head_s_x_ * p->crank_head_s_x_)*p->crank_mass_;
    p->inertia_crank_rod_ = p->crank_head_span_x_*p->rod_head_s_x_*p->rod_mass_;  /* sum of m w.w */
    p->inertia_rod_rod_ = (p->rod_head_s_x_ * p->rod_head_s_x_)*p->rod_mass_;  /* sum of m w.w */
    p->mass_motor_motor_ = p->crank_inertia_ + p->inertia_crank_crank_;  /* constant of M */
    p->mass_rod_rod_ = p->inertia_rod_rod_ + p->rod_inertia_;  /* constant of M */
    p->inverse_mass_rod_rod_ = 1.0/p->mass_rod_rod_;  /* 1/M */
    p->mass_of_all_ = p->crank_mass_ + p->rod_mass_ + p->slider_mass_;  /* of projections */
    p->tree_metric_cylinder_slide_ = max_of(0.0001*p->mass_of_all_, p->slider_mass_);  /* of projections */
    /* of projections */
    p->tree_metric_rod_theta_ = max_of(0.0002*p->mass_of_all_*(p->rod_head_s_x_ * p->rod_head_s_x_), p->mass_rod_rod_);
    p->inverse_tree_metric_cylinder_slide_ = 1.0/p->tree_metric_cylinder_slide_;  /* 1/M */
    p->inverse_tree_metric_rod_theta_ = 1.0/p->tree_metric_rod_theta_;  /* 1/M */
}

/* Radial clearance of joint i with play, m. */
double radial_clearance(const Parameters *p, int i)
{
    (void)p;
    switch (i) {
    case 0:
        return p->pin_clearance_;
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
        return (1.0/10.0)*p->pin_radius_;
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

