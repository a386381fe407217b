/*
 * Fill all parameters of a run: given values or defaults, then derived parameters.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    p->crank_mass_ = is_given[0] ? given[0] : 1.0;  /* bodies.crank.mass */
    p->crank_inertia_ = is_given[1] ? given[1] : 1.0;  /* bodies.crank.inertia */
    p->rod_mass_ = is_given[2] ? given[2] : 1.0;  /* bodies.rod.mass */
    p->rod_inertia_ = is_given[3] ? given[3] : 2.0;  /* bodies.rod.inertia */
    p->crank_length_ = is_given[4] ? given[4] : 0.5;  /* bodies.crank.length */
    p->crank_points_middle_x_ = is_given[5] ? given[5] : 0.25;  /* bodies.crank.points.middle.x */
    p->rod_points_crankpin_x_ = is_given[6] ? given[6] : -1.0;  /* bodies.rod.points.crankpin.x */
    p->rod_points_middle_x_ = is_given[7] ? given[7] : -0.5;  /* bodies.rod.points.middle.x */
    p->rod_points_tip_x_ = is_given[8] ? given[8] : 1.0;  /* bodies.rod.points.tip.x */
    p->alpha_ = is_given[9] ? given[9] : 50.0;  /* baumgarte.alpha */
    p->beta_ = is_given[10] ? given[10] : 50.0;  /* baumgarte.beta */
    p->slider_direction_x_ = is_given[11] ? given[11] : 1.0;  /* joints.slider.direction.x */
    p->coil_stiffness_ = is_given[12] ? given[12] : 1.0;  /* forces.coil.stiffness */
    p->coil_free_length_ = is_given[13] ? given[13] : 1.0;  /* forces.coil.free_length */
    p->coil_damping_ = is_given[14] ? given[14] : 1.0;  /* forces.coil.damping */
    p->push_value_x_ = is_given[15] ? given[15] : 1.0;  /* forces.push.value.x */
    p->guess_rod_theta_ = is_given[16] ? given[16] : -PI/6.0;  /* start.guess.rod.theta */
    p->guess_rod_x_ = is_given[17] ? given[17] : 0.87;  /* start.guess.rod.x */
    p->set_crank_theta_ = is_given[18] ? given[18] : PI/2.0;  /* start.set.crank.theta */
    p->rates_crank_omega_ = is_given[19] ? given[19] : 0.0;  /* start.rates.crank.omega */

    /* derived */
    /* J and m s^2 of its joints */
    p->crank_turning_ = p->crank_inertia_ + (p->crank_length_ * p->crank_length_)*p->crank_mass_;
    /* J and m s^2 of its joints */
    p->rod_turning_ = p->rod_inertia_ + p->rod_mass_*(p->rod_points_crankpin_x_ * p->rod_points_crankpin_x_);
    p->two_alpha_ = 2.0*p->alpha_;  /* 2 alpha */
    p->beta_squared_ = (p->beta_ * p->beta_);  /* beta^2 */
    p->mobility_slider_offset_ = 1.0/p->rod_mass_;  /* 1/m of the bodies of a row */
    p->rod_com_span_x_ = -p->rod_points_crankpin_x_;  /* vector in its frame */
    p->rod_middle_span_x_ = -p->rod_points_crankpin_x_ + p->rod_points_middle_x_;  /* vector in its frame */
    p->rod_tip_span_x_ = -p->rod_points_crankpin_x_ + p->rod_points_tip_x_;  /* vector in its frame */
    p->inertia_crank_crank_ = (p->crank_length_ * p->crank_length_)*p->rod_mass_;  /* sum of m w.w */
    p->inertia_crank_rod_ = p->crank_length_*p->rod_com_span_x_*p->rod_mass_;  /* sum of m w.w */
    p->inertia_rod_rod_ = (p->rod_com_span_x_ * p->rod_com_span_x_)*p->rod_mass_;  /* sum of m w.w */
    p->mass_crank_crank_ = p->crank_inertia_ + p->inertia_crank_crank_;  /* constant of M */
    p->mass_rod_rod_ = p->inertia_rod_rod_ + p->rod_inertia_;  /* constant of M */
    p->inverse_mass_crank_crank_ = 1.0/p->mass_crank_crank_;  /* 1/M */
    p->mass_of_all_ = p->crank_mass_ + p->rod_mass_;  /* of projections */
    /* of projections */
    p->tree_metric_crank_theta_ = max_of(0.0001*(p->crank_length_ * p->crank_length_)*p->mass_of_all_,
        p->mass_crank_crank_);
    /* of projections */
    p->tree_metric_rod_theta_ = max_of(0.0001*p->mass_of_all_*(p->rod_points_crankpin_x_ * p->rod_points_crankpin_x_),
        p->mass_rod_rod_);
    p->inverse_tree_metric_crank_theta_ = 1.0/p->tree_metric_crank_theta_;  /* 1/M */
}
