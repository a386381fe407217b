/*
 * Fill all parameters of a run: given values or defaults, then derived parameters.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    p->length_ = is_given[0] ? given[0] : 1.0;  /* parameters.length */
    p->mass_ = is_given[1] ? given[1] : 1.0;  /* parameters.mass */
    p->inertia_ = is_given[2] ? given[2] : (1.0/12.0)*(p->length_ * p->length_)*p->mass_;  /* parameters.inertia */
    p->crank0_mass_ = is_given[3] ? given[3] : p->mass_;  /* bodies.crank0.mass */
    p->crank0_inertia_ = is_given[4] ? given[4] : p->inertia_;  /* bodies.crank0.inertia */
    p->crank1_mass_ = is_given[5] ? given[5] : p->mass_;  /* bodies.crank1.mass */
    p->crank1_inertia_ = is_given[6] ? given[6] : p->inertia_;  /* bodies.crank1.inertia */
    p->crank2_mass_ = is_given[7] ? given[7] : p->mass_;  /* bodies.crank2.mass */
    p->crank2_inertia_ = is_given[8] ? given[8] : p->inertia_;  /* bodies.crank2.inertia */
    p->coupler1_mass_ = is_given[9] ? given[9] : p->mass_;  /* bodies.coupler1.mass */
    p->coupler1_inertia_ = is_given[10] ? given[10] : p->inertia_;  /* bodies.coupler1.inertia */
    p->coupler2_mass_ = is_given[11] ? given[11] : p->mass_;  /* bodies.coupler2.mass */
    p->coupler2_inertia_ = is_given[12] ? given[12] : p->inertia_;  /* bodies.coupler2.inertia */
    p->crank0_length_ = is_given[13] ? given[13] : p->length_;  /* bodies.crank0.length */
    p->crank1_length_ = is_given[14] ? given[14] : p->length_;  /* bodies.crank1.length */
    p->crank2_length_ = is_given[15] ? given[15] : p->length_;  /* bodies.crank2.length */
    p->coupler1_length_ = is_given[16] ? given[16] : p->length_;  /* bodies.coupler1.length */
    p->coupler2_length_ = is_given[17] ? given[17] : p->length_;  /* bodies.coupler2.length */
    p->alpha_ = is_given[18] ? given[18] : 50.0;  /* baumgarte.alpha */
    p->beta_ = is_given[19] ? given[19] : 50.0;  /* baumgarte.beta */
    p->O1_x_ = is_given[20] ? given[20] : p->length_;  /* ground.O1.x */
    p->O2_x_ = is_given[21] ? given[21] : 2.0*p->length_;  /* ground.O2.x */
    p->gravity_y_ = is_given[22] ? given[22] : -9.81;  /* gravity.y */
    p->guess_crank1_theta_ = is_given[23] ? given[23] : PI/2.0;  /* start.guess.crank1.theta */
    p->guess_crank2_theta_ = is_given[24] ? given[24] : PI/2.0;  /* start.guess.crank2.theta */
    p->guess_coupler1_theta_ = is_given[25] ? given[25] : 0.0;  /* start.guess.coupler1.theta */
    p->guess_coupler2_theta_ = is_given[26] ? given[26] : 0.0;  /* start.guess.coupler2.theta */
    p->set_crank0_theta_ = is_given[27] ? given[27] : PI/2.0;  /* start.set.crank0.theta */
    p->rates_crank0_omega_ = is_given[28] ? given[28] : -1.0;  /* start.rates.crank0.omega */

    /* derived */
    p->crank0_head_s_x_ = 0.5*p->crank0_length_;  /* point from the centre of mass */
    p->crank1_head_s_x_ = 0.5*p->crank1_length_;  /* point from the centre of mass */
    p->crank2_head_s_x_ = 0.5*p->crank2_length_;  /* point from the centre of mass */
    p->coupler1_head_s_x_ = 0.5*p->coupler1_length_;  /* point from the centre of mass */
    p->coupler2_head_s_x_ = 0.5*p->coupler2_length_;  /* point from the centre of mass */
    p->weight_crank0_y_ = p->crank0_mass_*p->gravity_y_;  /* weight */
    p->weight_crank1_y_ = p->crank1_mass_*p->gravity_y_;  /* weight */
    p->weight_crank2_y_ = p->crank2_mass_*p->gravity_y_;  /* weight */
    p->weight_coupler1_y_ = p->coupler1_mass_*p->gravity_y_;  /* weight */
    p->weight_coupler2_y_ = p->coupler2_mass_*p->gravity_y_;  /* weight */
    /* J and m s^2 of its joints */
    p->crank2_turning_ = 2.0*(p->crank2_head_s_x_ * p->crank2_head_s_x_)*p->crank2_mass_ + p->crank2_inertia_;
    /* J and m s^2 of its joints */
    p->crank0_turning_ = 2.0*(p->crank0_head_s_x_ * p->crank0_head_s_x_)*p->crank0_mass_ + p->crank0_inertia_;
    /* J and m s^2 of its joints */
    p->coupler1_turning_ = 2.0*(p->coupler1_head_s_x_ * p->coupler1_head_s_x_)*p->coupler1_mass_ + p->coupler1_inertia_;
    /* J and m s^2 of its joints */
    p->coupler2_turning_ = 2.0*(p->coupler2_head_s_x_ * p->coupler2_head_s_x_)*p->coupler2_mass_ + p->coupler2_inertia_;
    /* J and m s^2 of its joints */
    p->crank1_turning_ = 2.0*(p->crank1_head_s_x_ * p->crank1_head_s_x_)*p->crank1_mass_ + p->crank1_inertia_;
    p->two_alpha_ = 2.0*p->alpha_;  /* 2 alpha */
    p->beta_squared_ = (p->beta_ * p->beta_);  /* beta^2 */
    p->mobility_B1_x_ = 1.0/p->crank1_mass_ + 1.0/p->coupler1_mass_;  /* 1/m of the bodies of a row */
    p->mobility_B2_x_ = 1.0/p->crank2_mass_ + 1.0/p->coupler2_mass_;  /* 1/m of the bodies of a row */
    p->crank0_head_span_x_ = 2.0*p->crank0_head_s_x_;  /* vector in its frame */
    p->crank1_head_span_x_ = 2.0*p->crank1_head_s_x_;  /* vector in its frame */
    p->coupler2_head_span_x_ = 2.0*p->coupler2_head_s_x_;  /* vector in its frame */
    p->crank2_head_span_x_ = 2.0*p->crank2_head_s_x_;  /* vector in its frame */
    p->coupler1_head_span_x_ = 2.0*p->coupler1_head_s_x_;  /* vector in its frame */
    /* sum of m w.w */
    p->inertia_crank0_crank0_ = p->coupler1_mass_*(p->crank0_head_span_x_ * p->crank0_head_span_x_)
        + (p->crank0_head_s_x_ * p->crank0_head_s_x_)*p->crank0_mass_;
    /* sum of m w.w */
    p->inertia_crank1_crank1_ = p->coupler2_mass_*(p->crank1_head_span_x_ * p->crank1_head_span_x_)
        + (p->crank1_head_s_x_ * p->crank1_head_s_x_)*p->crank1_mass_;
    p->inertia_crank2_crank2_ = (p->crank2_head_s_x_ * p->crank2_head_s_x_)*p->crank2_mass_;  /* sum of m w.w */
    p->inertia_crank0_coupler1_ = p->coupler1_head_s_x_*p->coupler1_mass_*p->crank0_head_span_x_;  /* sum of m w.w */
    /* sum of m w.w */
    p->inertia_coupler1_coupler1_ = (p->coupler1_head_s_x_ * p->coupler1_head_s_x_)*p->coupler1_mass_;
    p->inertia_crank1_coupler2_ = p->coupler2_head_s_x_*p->coupler2_mass_*p->crank1_head_span_x_;  /* sum of m w.w */
    /* sum of m w.w */
    p->inertia_coupler2_coupler2_ = (p->coupler2_head_s_x_ * p->coupler2_head_s_x_)*p->coupler2_mass_;
    p->mass_crank0_crank0_ = p->crank0_inertia_ + p->inertia_crank0_crank0_;  /* constant of M */
    p->mass_crank1_crank1_ = p->crank1_inertia_ + p->inertia_crank1_crank1_;  /* constant of M */
    p->mass_crank2_crank2_ = p->crank2_inertia_ + p->inertia_crank2_crank2_;  /* constant of M */
    p->mass_coupler1_coupler1_ = p->coupler1_inertia_ + p->inertia_coupler1_coupler1_;  /* constant of M */
    p->mass_coupler2_coupler2_ = p->coupler2_inertia_ + p->inertia_coupler2_coupler2_;  /* constant of M */
    /* weight */
    p->weight_crank0_across_ = p->coupler1_mass_*p->crank0_head_span_x_*p->gravity_y_
        + p->crank0_head_s_x_*p->crank0_mass_*p->gravity_y_;
    /* weight */
    p->weight_crank1_across_ = p->coupler2_mass_*p->crank1_head_span_x_*p->gravity_y_
        + p->crank1_head_s_x_*p->crank1_mass_*p->gravity_y_;
    p->weight_crank2_across_ = p->crank2_head_s_x_*p->crank2_mass_*p->gravity_y_;  /* weight */
    p->weight_coupler1_across_ = p->coupler1_head_s_x_*p->coupler1_mass_*p->gravity_y_;  /* weight */
    p->weight_coupler2_across_ = p->coupler2_head_s_x_*p->coupler2_mass_*p->gravity_y_;  /* weight */
    p->inverse_mass_crank2_crank2_ = 1.0/p->mass_crank2_crank2_;  /* 1/M */
    p->inverse_mass_coupler2_coupler2_ = 1.0/p->mass_coupler2_coupler2_;  /* 1/M */
    p->inverse_mass_crank0_crank0_ = 1.0/p->mass_crank0_crank0_;  /* 1/M */
    /* of projections */
    p->mass_of_all_ = p->coupler1_mass_ + p->coupler2_mass_ + p->crank0_mass_ + p->crank1_mass_ + p->crank2_mass_;
    /* of projections */
    p->tree_metric_crank0_theta_ = max_of(0.0002*(p->crank0_head_s_x_ * p->crank0_head_s_x_)*p->mass_of_all_,
        p->mass_crank0_crank0_);
    /* of projections */
    p->tree_metric_crank1_theta_ = max_of(0.0002*(p->crank1_head_s_x_ * p->crank1_head_s_x_)*p->mass_of_all_,
        p->mass_crank1_crank1_);
    /* of projections */
    p->tree_metric_crank2_theta_ = max_of(0.0002*(p->crank2_head_s_x_ * p->crank2_head_s_x_)*p->mass_of_all_,
        p->mass_crank2_crank2_);
    /* of projections */
    p->tree_metric_coupler1_theta_ = max_of(0.0002*(p->coupler1_head_s_x_ * p->coupler1_head_s_x_)*p->mass_of_all_,
        p->mass_coupler1_coupler1_);
    /* of projections */
    p->tree_metric_coupler2_theta_ = max_of(0.0002*(p->coupler2_head_s_x_ * p->coupler2_head_s_x_)*p->mass_of_all_,
        p->mass_coupler2_coupler2_);
    p->inverse_tree_metric_crank2_theta_ = 1.0/p->tree_metric_crank2_theta_;  /* 1/M */
    p->inverse_tree_metric_crank0_theta_ = 1.0/p->tree_metric_crank0_theta_;  /* 1/M */
    p->inverse_tree_metric_coupler2_theta_ = 1.0/p->tree_metric_coupler2_theta_;  /* 1/M */
}
