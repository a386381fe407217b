/*
 * Every number of a run: slots given or by default, then what follows from them.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    const double height = is_given[0] ? given[0] : 1.0;  /* parameters.height */
    p->height = height;
    const double ball_mass = is_given[1] ? given[1] : 0.092;  /* bodies.ball.mass */
    p->ball_mass = ball_mass;
    const double ball_inertia = is_given[2] ? given[2] : 7.212800000000001e-06;  /* bodies.ball.inertia */
    p->ball_inertia = ball_inertia;
    const double alpha = is_given[3] ? given[3] : 50.0;  /* baumgarte.alpha */
    p->alpha = alpha;
    const double beta = is_given[4] ? given[4] : 50.0;  /* baumgarte.beta */
    p->beta = beta;
    const double floor_radius = is_given[5] ? given[5] : height + 0.014;  /* bearings.floor.radius */
    p->floor_radius = floor_radius;
    const double floor_clearance = is_given[6] ? given[6] : height;  /* bearings.floor.clearance */
    p->floor_clearance = floor_clearance;
    const double floor_length = is_given[7] ? given[7] : 0.01;  /* bearings.floor.length */
    p->floor_length = floor_length;
    const double steel_E = is_given[8] ? given[8] : 206000000000.0;  /* materials.steel.E */
    p->steel_E = steel_E;
    const double steel_nu = is_given[9] ? given[9] : 0.3;  /* materials.steel.nu */
    p->steel_nu = steel_nu;
    const double damped_normal_stiffness = is_given[10] ? given[10] : 140000000.0;  /* contacts.damped.normal.stiffness */
    p->damped_normal_stiffness = damped_normal_stiffness;
    const double damped_normal_exponent = is_given[11] ? given[11] : 1.5;  /* contacts.damped.normal.exponent */
    p->damped_normal_exponent = damped_normal_exponent;
    const double damped_normal_restitution = is_given[12] ? given[12] : 0.8;  /* contacts.damped.normal.restitution */
    p->damped_normal_restitution = damped_normal_restitution;
    const double velocity_floor = is_given[13] ? given[13] : 1e-06;  /* contacts.damped.velocity_floor */
    p->velocity_floor = velocity_floor;
    const double par_y = is_given[14] ? given[14] : -9.81;  /* gravity.y */
    p->par_y = par_y;

    /* derived */
    const double R_j_floor = -floor_clearance + floor_radius;  /* journal radius */
    p->R_j_floor = R_j_floor;
    const double damped_floor_hysteresis = 1.5 - 1.5*damped_normal_restitution;  /* hysteresis damping factor a */
    p->damped_floor_hysteresis = damped_floor_hysteresis;
    const double weight_ball_y = ball_mass*par_y;  /* weight */
    p->weight_ball_y = weight_ball_y;
    const double two_alpha = 2.0*alpha;  /* 2 alpha */
    p->two_alpha = two_alpha;
    const double beta_squared = (beta * beta);  /* beta^2 */
    p->beta_squared = beta_squared;
    const double inverse_ball_mass = 1.0/ball_mass;  /* 1/M */
    p->inverse_ball_mass = inverse_ball_mass;
    const double inverse_ball_inertia = 1.0/ball_inertia;  /* 1/M */
    p->inverse_ball_inertia = inverse_ball_inertia;
}
