/*
 * Every number of a run: slots given or by default, then what follows from them.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    const double omega = is_given[0] ? given[0] : 6.283185307179586;  /* parameters.omega */
    p->omega = omega;
    const double crank_mass = is_given[1] ? given[1] : 0.031;  /* bodies.crank.mass */
    p->crank_mass = crank_mass;
    const double crank_inertia = is_given[2] ? given[2] : 5.2e-06;  /* bodies.crank.inertia */
    p->crank_inertia = crank_inertia;
    const double coupler_mass = is_given[3] ? given[3] : 0.094;  /* bodies.coupler.mass */
    p->coupler_mass = coupler_mass;
    const double coupler_inertia = is_given[4] ? given[4] : 0.000116;  /* bodies.coupler.inertia */
    p->coupler_inertia = coupler_inertia;
    const double rocker_mass = is_given[5] ? given[5] : 0.063;  /* bodies.rocker.mass */
    p->rocker_mass = rocker_mass;
    const double rocker_inertia = is_given[6] ? given[6] : 3.5e-05;  /* bodies.rocker.inertia */
    p->rocker_inertia = rocker_inertia;
    const double crank_length = is_given[7] ? given[7] : 0.04;  /* bodies.crank.length */
    p->crank_length = crank_length;
    const double coupler_length = is_given[8] ? given[8] : 0.12;  /* bodies.coupler.length */
    p->coupler_length = coupler_length;
    const double coupler_points_tracer_x = is_given[9] ? given[9] : 0.06;  /* bodies.coupler.points.tracer.x */
    p->coupler_points_tracer_x = coupler_points_tracer_x;
    const double coupler_points_tracer_y = is_given[10] ? given[10] : 0.05;  /* bodies.coupler.points.tracer.y */
    p->coupler_points_tracer_y = coupler_points_tracer_y;
    const double rocker_length = is_given[11] ? given[11] : 0.08;  /* bodies.rocker.length */
    p->rocker_length = rocker_length;
    const double alpha = is_given[12] ? given[12] : 50.0;  /* baumgarte.alpha */
    p->alpha = alpha;
    const double beta = is_given[13] ? given[13] : 50.0;  /* baumgarte.beta */
    p->beta = beta;
    const double B0_x = is_given[14] ? given[14] : 0.1;  /* ground.B0.x */
    p->B0_x = B0_x;
    const double par_y = is_given[15] ? given[15] : -9.81;  /* gravity.y */
    p->par_y = par_y;
    const double guess_coupler_theta = is_given[16] ? given[16] : 0.3490658503988659;  /* start.guess.coupler.theta */
    p->guess_coupler_theta = guess_coupler_theta;
    const double guess_rocker_theta = is_given[17] ? given[17] : 1.3962634015954636;  /* start.guess.rocker.theta */
    p->guess_rocker_theta = guess_rocker_theta;

    /* derived */
    const double crank_head_x = (0.5)*crank_length;  /* point from the centre of mass */
    p->crank_head_x = crank_head_x;
    const double coupler_head_x = (0.5)*coupler_length;  /* point from the centre of mass */
    p->coupler_head_x = coupler_head_x;
    const double coupler_tracer_x = -0.5*coupler_length + coupler_points_tracer_x;  /* point from the centre of mass */
    p->coupler_tracer_x = coupler_tracer_x;
    const double rocker_head_x = (0.5)*rocker_length;  /* point from the centre of mass */
    p->rocker_head_x = rocker_head_x;
    const double weight_crank_y = crank_mass*par_y;  /* weight */
    p->weight_crank_y = weight_crank_y;
    const double weight_coupler_y = coupler_mass*par_y;  /* weight */
    p->weight_coupler_y = weight_coupler_y;
    const double weight_rocker_y = par_y*rocker_mass;  /* weight */
    p->weight_rocker_y = weight_rocker_y;
    const double two_alpha = 2.0*alpha;  /* 2 alpha */
    p->two_alpha = two_alpha;
    const double beta_squared = (beta * beta);  /* beta^2 */
    p->beta_squared = beta_squared;
    const double inverse_crank_mass = 1.0/crank_mass;  /* 1/M */
    p->inverse_crank_mass = inverse_crank_mass;
    const double inverse_coupler_mass = 1.0/coupler_mass;  /* 1/M */
    p->inverse_coupler_mass = inverse_coupler_mass;
    const double inverse_rocker_mass = 1.0/rocker_mass;  /* 1/M */
    p->inverse_rocker_mass = inverse_rocker_mass;
    const double inverse_coupler_inertia = 1.0/coupler_inertia;  /* 1/M */
    p->inverse_coupler_inertia = inverse_coupler_inertia;
    const double inverse_rocker_inertia = 1.0/rocker_inertia;  /* 1/M */
    p->inverse_rocker_inertia = inverse_rocker_inertia;
    const double inverse_crank_inertia = 1.0/crank_inertia;  /* 1/M */
    p->inverse_crank_inertia = inverse_crank_inertia;
    const double crank_head_span_x = 2.0*crank_head_x;  /* vector in its frame */
    p->crank_head_span_x = crank_head_span_x;
    const double coupler_head_span_x = 2.0*coupler_head_x;  /* vector in its frame */
    p->coupler_head_span_x = coupler_head_span_x;
    const double rocker_head_span_x = 2.0*rocker_head_x;  /* vector in its frame */
    p->rocker_head_span_x = rocker_head_span_x;
    const double inertia_crank_crank = coupler_mass*(crank_head_span_x * crank_head_span_x) + (crank_head_x *
        crank_head_x)*crank_mass;  /* sum of m w.w */
    p->inertia_crank_crank = inertia_crank_crank;
    const double inertia_crank_coupler = coupler_head_x*coupler_mass*crank_head_span_x;  /* sum of m w.w */
    p->inertia_crank_coupler = inertia_crank_coupler;
    const double inertia_coupler_coupler = (coupler_head_x * coupler_head_x)*coupler_mass;  /* sum of m w.w */
    p->inertia_coupler_coupler = inertia_coupler_coupler;
    const double inertia_rocker_rocker = (rocker_head_x * rocker_head_x)*rocker_mass;  /* sum of m w.w */
    p->inertia_rocker_rocker = inertia_rocker_rocker;
    const double mass_motor_motor = crank_inertia + inertia_crank_crank;  /* constant of M */
    p->mass_motor_motor = mass_motor_motor;
    const double mass_coupler_coupler = coupler_inertia + inertia_coupler_coupler;  /* constant of M */
    p->mass_coupler_coupler = mass_coupler_coupler;
    const double mass_rocker_rocker = inertia_rocker_rocker + rocker_inertia;  /* constant of M */
    p->mass_rocker_rocker = mass_rocker_rocker;
    const double weight_crank__across = coupler_mass*crank_head_span_x*par_y + crank_head_x*crank_mass*par_y;  /* weight */
    p->weight_crank__across = weight_crank__across;
    const double weight_coupler__across = coupler_head_x*coupler_mass*par_y;  /* weight */
    p->weight_coupler__across = weight_coupler__across;
    const double weight_rocker__across = par_y*rocker_head_x*rocker_mass;  /* weight */
    p->weight_rocker__across = weight_rocker__across;
    const double inverse_mass_rocker_rocker = 1.0/mass_rocker_rocker;  /* 1/M */
    p->inverse_mass_rocker_rocker = inverse_mass_rocker_rocker;
    const double inverse_mass_coupler_coupler = 1.0/mass_coupler_coupler;  /* 1/M */
    p->inverse_mass_coupler_coupler = inverse_mass_coupler_coupler;
}
