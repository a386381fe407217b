/*
 * Fill all parameters of a run: given values or defaults, then derived parameters.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    p->omega_ = is_given[0] ? given[0] : 2.0*PI;  /* parameters.omega */
    p->crank_mass_ = is_given[1] ? given[1] : 0.031;  /* bodies.crank.mass */
    p->crank_inertia_ = is_given[2] ? given[2] : 5.2e-06;  /* bodies.crank.inertia */
    p->coupler_mass_ = is_given[3] ? given[3] : 0.094;  /* bodies.coupler.mass */
    p->coupler_inertia_ = is_given[4] ? given[4] : 0.000116;  /* bodies.coupler.inertia */
    p->rocker_mass_ = is_given[5] ? given[5] : 0.063;  /* bodies.rocker.mass */
    p->rocker_inertia_ = is_given[6] ? given[6] : 3.5e-05;  /* bodies.rocker.inertia */
    p->crank_length_ = is_given[7] ? given[7] : 0.04;  /* bodies.crank.length */
    p->coupler_length_ = is_given[8] ? given[8] : 0.12;  /* bodies.coupler.length */
    p->coupler_points_tracer_x_ = is_given[9] ? given[9] : 0.06;  /* bodies.coupler.points.tracer.x */
    p->coupler_points_tracer_y_ = is_given[10] ? given[10] : 0.05;  /* bodies.coupler.points.tracer.y */
    p->rocker_length_ = is_given[11] ? given[11] : 0.08;  /* bodies.rocker.length */
    p->alpha_ = is_given[12] ? given[12] : 50.0;  /* baumgarte.alpha */
    p->beta_ = is_given[13] ? given[13] : 50.0;  /* baumgarte.beta */
    p->B0_x_ = is_given[14] ? given[14] : 0.1;  /* ground.B0.x */
    p->gravity_y_ = is_given[15] ? given[15] : -9.81;  /* gravity.y */
    p->guess_coupler_theta_ = is_given[16] ? given[16] : PI/9.0;  /* start.guess.coupler.theta */
    p->guess_rocker_theta_ = is_given[17] ? given[17] : 4.0*PI/9.0;  /* start.guess.rocker.theta */

    /* derived */
    p->crank_head_s_x_ = 0.5*p->crank_length_;  /* point from the centre of mass */
    p->coupler_head_s_x_ = 0.5*p->coupler_length_;  /* point from the centre of mass */
    p->coupler_tracer_s_x_ = -0.5*p->coupler_length_ + p->coupler_points_tracer_x_;  /* point from the centre of mass */
    p->rocker_head_s_x_ = 0.5*p->rocker_length_;  /* point from the centre of mass */
    p->weight_crank_y_ = p->crank_mass_*p->gravity_y_;  /* weight */
    p->weight_coupler_y_ = p->coupler_mass_*p->gravity_y_;  /* weight */
    p->weight_rocker_y_ = p->rocker_mass_*p->gravity_y_;  /* weight */
    /* J and m s^2 of its joints */
    p->coupler_turning_ = 2.0*(p->coupler_head_s_x_ * p->coupler_head_s_x_)*p->coupler_mass_ + p->coupler_inertia_;
    /* J and m s^2 of its joints */
    p->rocker_turning_ = 2.0*(p->rocker_head_s_x_ * p->rocker_head_s_x_)*p->rocker_mass_ + p->rocker_inertia_;
    p->two_alpha_ = 2.0*p->alpha_;  /* 2 alpha */
    p->beta_squared_ = (p->beta_ * p->beta_);  /* beta^2 */
    p->mobility_B_x_ = 1.0/p->rocker_mass_ + 1.0/p->coupler_mass_;  /* 1/m of the bodies of a row */
    p->crank_head_span_x_ = 2.0*p->crank_head_s_x_;  /* vector in its frame */
    p->coupler_head_span_x_ = 2.0*p->coupler_head_s_x_;  /* vector in its frame */
    p->rocker_head_span_x_ = 2.0*p->rocker_head_s_x_;  /* vector in its frame */
    /* sum of m w.w */
    p->inertia_crank_crank_ = p->coupler_mass_*(p->crank_head_span_x_ * p->crank_head_span_x_)
        + (p->crank_head_s_x_ * p->crank_head_s_x_)*p->crank_mass_;
    p->inertia_crank_coupler_ = p->coupler_head_s_x_*p->coupler_mass_*p->crank_head_span_x_;  /* sum of m w.w */
    p->inertia_coupler_coupler_ = (p->coupler_head_s_x_ * p->coupler_head_s_x_)*p->coupler_mass_;  /* sum of m w.w */
    p->inertia_rocker_rocker_ = (p->rocker_head_s_x_ * p->rocker_head_s_x_)*p->rocker_mass_;  /* sum of m w.w */
    p->mass_motor_motor_ = p->crank_inertia_ + p->inertia_crank_crank_;  /* constant of M */
    p->mass_coupler_coupler_ = p->coupler_inertia_ + p->inertia_coupler_coupler_;  /* constant of M */
    p->mass_rocker_rocker_ = p->inertia_rocker_rocker_ + p->rocker_inertia_;  /* constant of M */
    /* weight */
    p->weight_crank_across_ = p->coupler_mass_*p->crank_head_span_x_*p->gravity_y_
        + p->crank_head_s_x_*p->crank_mass_*p->gravity_y_;
    p->weight_coupler_across_ = p->coupler_head_s_x_*p->coupler_mass_*p->gravity_y_;  /* weight */
    p->weight_rocker_across_ = p->rocker_head_s_x_*p->rocker_mass_*p->gravity_y_;  /* weight */
    p->inverse_mass_rocker_rocker_ = 1.0/p->mass_rocker_rocker_;  /* 1/M */
    p->inverse_mass_coupler_coupler_ = 1.0/p->mass_coupler_coupler_;  /* 1/M */
    p->mass_of_all_ = p->coupler_mass_ + p->crank_mass_ + p->rocker_mass_;  /* of projections */
    /* of projections */
    p->tree_metric_rocker_theta_ = max_of(0.0002*p->mass_of_all_*(p->rocker_head_s_x_ * p->rocker_head_s_x_),
        p->mass_rocker_rocker_);
    /* of projections */
    p->tree_metric_coupler_theta_ = max_of(0.0002*(p->coupler_head_s_x_ * p->coupler_head_s_x_)*p->mass_of_all_,
        p->mass_coupler_coupler_);
    p->inverse_tree_metric_rocker_theta_ = 1.0/p->tree_metric_rocker_theta_;  /* 1/M */
    p->inverse_tree_metric_coupler_theta_ = 1.0/p->tree_metric_coupler_theta_;  /* 1/M */
}
