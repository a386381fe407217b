/*
 * Every number of a run: slots given or by default, then what follows from them.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    p->omega = is_given[0] ? given[0] : 2.0*PI;  /* parameters.omega */
    p->crank_mass = is_given[1] ? given[1] : 0.031;  /* bodies.crank.mass */
    p->crank_inertia = is_given[2] ? given[2] : 5.2e-06;  /* bodies.crank.inertia */
    p->coupler_mass = is_given[3] ? given[3] : 0.094;  /* bodies.coupler.mass */
    p->coupler_inertia = is_given[4] ? given[4] : 0.000116;  /* bodies.coupler.inertia */
    p->rocker_mass = is_given[5] ? given[5] : 0.063;  /* bodies.rocker.mass */
    p->rocker_inertia = is_given[6] ? given[6] : 3.5e-05;  /* bodies.rocker.inertia */
    p->crank_length = is_given[7] ? given[7] : 0.04;  /* bodies.crank.length */
    p->coupler_length = is_given[8] ? given[8] : 0.12;  /* bodies.coupler.length */
    p->coupler_points_tracer_x = is_given[9] ? given[9] : 0.06;  /* bodies.coupler.points.tracer.x */
    p->coupler_points_tracer_y = is_given[10] ? given[10] : 0.05;  /* bodies.coupler.points.tracer.y */
    p->rocker_length = is_given[11] ? given[11] : 0.08;  /* bodies.rocker.length */
    p->alpha = is_given[12] ? given[12] : 50.0;  /* baumgarte.alpha */
    p->beta = is_given[13] ? given[13] : 50.0;  /* baumgarte.beta */
    p->B0_x = is_given[14] ? given[14] : 0.1;  /* ground.B0.x */
    p->gravity_y = is_given[15] ? given[15] : -9.81;  /* gravity.y */
    p->guess_coupler_theta = is_given[16] ? given[16] : PI/9.0;  /* start.guess.coupler.theta */
    p->guess_rocker_theta = is_given[17] ? given[17] : 4.0*PI/9.0;  /* start.guess.rocker.theta */

    /* derived */
    p->crank_head_s_x = 0.5*p->crank_length;  /* point from the centre of mass */
    p->coupler_head_s_x = 0.5*p->coupler_length;  /* point from the centre of mass */
    p->coupler_tracer_s_x = -0.5*p->coupler_length + p->coupler_points_tracer_x;  /* point from the centre of mass */
    p->rocker_head_s_x = 0.5*p->rocker_length;  /* point from the centre of mass */
    p->weight_crank_y = p->crank_mass*p->gravity_y;  /* weight */
    p->weight_coupler_y = p->coupler_mass*p->gravity_y;  /* weight */
    p->weight_rocker_y = p->gravity_y*p->rocker_mass;  /* weight */
    p->two_alpha = 2.0*p->alpha;  /* 2 alpha */
    p->beta_squared = (p->beta * p->beta);  /* beta^2 */
    p->inverse_crank_mass = 1.0/p->crank_mass;  /* 1/M */
    p->inverse_coupler_mass = 1.0/p->coupler_mass;  /* 1/M */
    p->inverse_rocker_mass = 1.0/p->rocker_mass;  /* 1/M */
    p->inverse_coupler_inertia = 1.0/p->coupler_inertia;  /* 1/M */
    p->inverse_rocker_inertia = 1.0/p->rocker_inertia;  /* 1/M */
    p->inverse_crank_inertia = 1.0/p->crank_inertia;  /* 1/M */
    p->crank_head_span_x = 2.0*p->crank_head_s_x;  /* vector in its frame */
    p->coupler_head_span_x = 2.0*p->coupler_head_s_x;  /* vector in its frame */
    p->rocker_head_span_x = 2.0*p->rocker_head_s_x;  /* vector in its frame */
    /* sum of m w.w */
    p->inertia_crank_crank = p->coupler_mass*(p->crank_head_span_x * p->crank_head_span_x)
        + (p->crank_head_s_x * p->crank_head_s_x)*p->crank_mass;
    p->inertia_crank_coupler = p->coupler_head_s_x*p->coupler_mass*p->crank_head_span_x;  /* sum of m w.w */
    p->inertia_coupler_coupler = (p->coupler_head_s_x * p->coupler_head_s_x)*p->coupler_mass;  /* sum of m w.w */
    p->inertia_rocker_rocker = (p->rocker_head_s_x * p->rocker_head_s_x)*p->rocker_mass;  /* sum of m w.w */
    p->mass_motor_motor = p->crank_inertia + p->inertia_crank_crank;  /* constant of M */
    p->mass_coupler_coupler = p->coupler_inertia + p->inertia_coupler_coupler;  /* constant of M */
    p->mass_rocker_rocker = p->inertia_rocker_rocker + p->rocker_inertia;  /* constant of M */
    /* weight */
    p->weight_crank__across = p->coupler_mass*p->crank_head_span_x*p->gravity_y
        + p->crank_head_s_x*p->crank_mass*p->gravity_y;
    p->weight_coupler__across = p->coupler_head_s_x*p->coupler_mass*p->gravity_y;  /* weight */
    p->weight_rocker__across = p->gravity_y*p->rocker_head_s_x*p->rocker_mass;  /* weight */
    p->inverse_mass_rocker_rocker = 1.0/p->mass_rocker_rocker;  /* 1/M */
    p->inverse_mass_coupler_coupler = 1.0/p->mass_coupler_coupler;  /* 1/M */
}
