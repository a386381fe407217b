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
    p->guess_rod_theta_ = is_given[13] ? given[13] : 0.0;  /* start.guess.rod.theta */
    p->guess_slider_x_ = is_given[14] ? given[14] : 0.17;  /* start.guess.slider.x */

    /* derived */
    p->crank_head_s_x_ = 0.5*p->crank_length_;  /* point from the centre of mass */
    p->rod_head_s_x_ = 0.5*p->rod_length_;  /* point from the centre of mass */
    /* J and m s^2 of its joints */
    p->rod_turning_ = 2.0*(p->rod_head_s_x_ * p->rod_head_s_x_)*p->rod_mass_ + p->rod_inertia_;
    p->two_alpha_ = 2.0*p->alpha_;  /* 2 alpha */
    p->beta_squared_ = (p->beta_ * p->beta_);  /* beta^2 */
    p->mobility_cylinder_offset_ = 1.0/p->slider_mass_;  /* 1/m of the bodies of a row */
    p->crank_head_span_x_ = 2.0*p->crank_head_s_x_;  /* vector in its frame */
    p->rod_head_span_x_ = 2.0*p->rod_head_s_x_;  /* vector in its frame */
    /* sum of m w.w */
    p->inertia_crank_crank_ = (p->crank_head_span_x_ * p->crank_head_span_x_)*p->rod_mass_
        + (p->crank_head_span_x_ * p->crank_head_span_x_)*p->slider_mass_
        + (p->crank_head_s_x_ * p->crank_head_s_x_)*p->crank_mass_;
    /* sum of m w.w */
    p->inertia_crank_rod_ = p->crank_head_span_x_*p->rod_head_span_x_*p->slider_mass_
        + p->crank_head_span_x_*p->rod_head_s_x_*p->rod_mass_;
    /* sum of m w.w */
    p->inertia_rod_rod_ = (p->rod_head_span_x_ * p->rod_head_span_x_)*p->slider_mass_
        + (p->rod_head_s_x_ * p->rod_head_s_x_)*p->rod_mass_;
    p->mass_motor_motor_ = p->crank_inertia_ + p->inertia_crank_crank_;  /* constant of M */
    p->mass_rod_rod_ = p->inertia_rod_rod_ + p->rod_inertia_;  /* constant of M */
    p->inverse_mass_rod_rod_ = 1.0/p->mass_rod_rod_;  /* 1/M */
    p->mass_of_all_ = p->crank_mass_ + p->rod_mass_ + p->slider_mass_;  /* of projections */
    /* of projections */
    p->tree_metric_rod_theta_ = max_of(0.0002*p->mass_of_all_*(p->rod_head_s_x_ * p->rod_head_s_x_), p->mass_rod_rod_);
    p->inverse_tree_metric_rod_theta_ = 1.0/p->tree_metric_rod_theta_;  /* 1/M */
}
