/*
 * Every number of a run: slots given or by default, then what follows from them.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    const double omega = is_given[0] ? given[0] : 62.83185307179586;  /* parameters.omega */
    p->omega = omega;
    const double c = is_given[1] ? given[1] : 0.0002;  /* parameters.c */
    p->c = c;
    const double crank_mass = is_given[2] ? given[2] : 0.3;  /* bodies.crank.mass */
    p->crank_mass = crank_mass;
    const double crank_inertia = is_given[3] ? given[3] : 0.0001;  /* bodies.crank.inertia */
    p->crank_inertia = crank_inertia;
    const double rod_mass = is_given[4] ? given[4] : 0.21;  /* bodies.rod.mass */
    p->rod_mass = rod_mass;
    const double rod_inertia = is_given[5] ? given[5] : 0.00025;  /* bodies.rod.inertia */
    p->rod_inertia = rod_inertia;
    const double slider_mass = is_given[6] ? given[6] : 0.14;  /* bodies.slider.mass */
    p->slider_mass = slider_mass;
    const double slider_inertia = is_given[7] ? given[7] : 0.0001;  /* bodies.slider.inertia */
    p->slider_inertia = slider_inertia;
    const double crank_length = is_given[8] ? given[8] : 0.05;  /* bodies.crank.length */
    p->crank_length = crank_length;
    const double rod_length = is_given[9] ? given[9] : 0.12;  /* bodies.rod.length */
    p->rod_length = rod_length;
    const double alpha = is_given[10] ? given[10] : 50.0;  /* baumgarte.alpha */
    p->alpha = alpha;
    const double beta = is_given[11] ? given[11] : 50.0;  /* baumgarte.beta */
    p->beta = beta;
    const double cylinder_axis_x = is_given[12] ? given[12] : 1.0;  /* joints.cylinder.axis.x */
    p->cylinder_axis_x = cylinder_axis_x;
    const double pin_radius = is_given[13] ? given[13] : 0.01;  /* bearings.pin.radius */
    p->pin_radius = pin_radius;
    const double pin_clearance = is_given[14] ? given[14] : c;  /* bearings.pin.clearance */
    p->pin_clearance = pin_clearance;
    const double pin_length = is_given[15] ? given[15] : 0.02;  /* bearings.pin.length */
    p->pin_length = pin_length;
    const double steel_E = is_given[16] ? given[16] : 207000000000.0;  /* materials.steel.E */
    p->steel_E = steel_E;
    const double steel_nu = is_given[17] ? given[17] : 0.3;  /* materials.steel.nu */
    p->steel_nu = steel_nu;
    const double dry_normal_restitution = is_given[18] ? given[18] : 0.9;  /* contacts.dry.normal.restitution */
    p->dry_normal_restitution = dry_normal_restitution;
    const double dry_normal_exponent = is_given[19] ? given[19] : 1.5;  /* contacts.dry.normal.exponent */
    p->dry_normal_exponent = dry_normal_exponent;
    const double dry_friction_mu = is_given[20] ? given[20] : 0.03;  /* contacts.dry.friction.mu */
    p->dry_friction_mu = dry_friction_mu;
    const double dry_friction_v0 = is_given[21] ? given[21] : 0.001;  /* contacts.dry.friction.v0 */
    p->dry_friction_v0 = dry_friction_v0;
    const double dry_friction_v1 = is_given[22] ? given[22] : 0.01;  /* contacts.dry.friction.v1 */
    p->dry_friction_v1 = dry_friction_v1;
    const double velocity_floor = is_given[23] ? given[23] : 1e-06;  /* contacts.dry.velocity_floor */
    p->velocity_floor = velocity_floor;
    const double guess_slider_x = is_given[24] ? given[24] : 0.17;  /* start.guess.slider.x */
    p->guess_slider_x = guess_slider_x;

    /* derived */
    const double crank_head_x = (0.5)*crank_length;  /* point from the centre of mass */
    p->crank_head_x = crank_head_x;
    const double rod_head_x = (0.5)*rod_length;  /* point from the centre of mass */
    p->rod_head_x = rod_head_x;
    const double R_j_pin = -pin_clearance + pin_radius;  /* journal radius */
    p->R_j_pin = R_j_pin;
    const double dry_pin_K = (2.0/3.0)*steel_E*sqrt(R_j_pin*pin_radius/(R_j_pin + pin_radius))/(1.0 -
        (steel_nu * steel_nu));  /* contact stiffness */
    p->dry_pin_K = dry_pin_K;
    const double dry_pin_hysteresis = 0.75 - 0.75*(dry_normal_restitution * dry_normal_restitution);  /* hysteresis damping factor a */
    p->dry_pin_hysteresis = dry_pin_hysteresis;
    const double dry_pin_friction_slope = 1.0/(-dry_friction_v0 + dry_friction_v1);  /* 1/(v1 - v0) */
    p->dry_pin_friction_slope = dry_pin_friction_slope;
    const double two_alpha = 2.0*alpha;  /* 2 alpha */
    p->two_alpha = two_alpha;
    const double beta_squared = (beta * beta);  /* beta^2 */
    p->beta_squared = beta_squared;
    const double inverse_slider_mass = 1.0/slider_mass;  /* 1/M */
    p->inverse_slider_mass = inverse_slider_mass;
    const double inverse_rod_mass = 1.0/rod_mass;  /* 1/M */
    p->inverse_rod_mass = inverse_rod_mass;
    const double inverse_slider_inertia = 1.0/slider_inertia;  /* 1/M */
    p->inverse_slider_inertia = inverse_slider_inertia;
    const double inverse_crank_mass = 1.0/crank_mass;  /* 1/M */
    p->inverse_crank_mass = inverse_crank_mass;
    const double inverse_rod_inertia = 1.0/rod_inertia;  /* 1/M */
    p->inverse_rod_inertia = inverse_rod_inertia;
    const double inverse_crank_inertia = 1.0/crank_inertia;  /* 1/M */
    p->inverse_crank_inertia = inverse_crank_inertia;
    const double crank_head_span_x = 2.0*crank_head_x;  /* vector in its frame */
    p->crank_head_span_x = crank_head_span_x;
    const double rod_head_span_x = 2.0*rod_head_x;  /* vector in its frame */
    p->rod_head_span_x = rod_head_span_x;
    const double inertia_crank_crank = (crank_head_span_x * crank_head_span_x)*rod_mass + (crank_head_x *
        crank_head_x)*crank_mass;  /* sum of m w.w */
    p->inertia_crank_crank = inertia_crank_crank;
    const double inertia_crank_rod = crank_head_span_x*rod_head_x*rod_mass;  /* sum of m w.w */
    p->inertia_crank_rod = inertia_crank_rod;
    const double inertia_rod_rod = (rod_head_x * rod_head_x)*rod_mass;  /* sum of m w.w */
    p->inertia_rod_rod = inertia_rod_rod;
    const double mass_motor_motor = crank_inertia + inertia_crank_crank;  /* constant of M */
    p->mass_motor_motor = mass_motor_motor;
    const double mass_rod_rod = inertia_rod_rod + rod_inertia;  /* constant of M */
    p->mass_rod_rod = mass_rod_rod;
    const double inverse_mass_rod_rod = 1.0/mass_rod_rod;  /* 1/M */
    p->inverse_mass_rod_rod = inverse_mass_rod_rod;
}
