/*
 * Fill all parameters of a run: given values or defaults, then derived parameters.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    p->length_ = is_given[0] ? given[0] : 1.0;  /* parameters.length */
    p->half_mass_ = is_given[1] ? given[1] : 0.0005;  /* parameters.half_mass */
    p->r_ = is_given[2] ? given[2] : 0.1;  /* parameters.r */
    p->omega_ = is_given[3] ? given[3] : 10.0;  /* parameters.omega */
    p->axle_mass_ = is_given[4] ? given[4] : 2.0*p->half_mass_;  /* bodies.axle.mass */
    p->axle_inertia_ = is_given[5] ? given[5] : 0.5*p->half_mass_*(p->length_ * p->length_);  /* bodies.axle.inertia */
    p->road_mass_ = is_given[6] ? given[6] : 1.0;  /* bodies.road.mass */
    p->road_inertia_ = is_given[7] ? given[7] : 1.0;  /* bodies.road.inertia */
    p->axle_length_ = is_given[8] ? given[8] : p->length_;  /* bodies.axle.length */
    p->road_length_ = is_given[9] ? given[9] : p->length_;  /* bodies.road.length */
    p->alpha_ = is_given[10] ? given[10] : 50.0;  /* baumgarte.alpha */
    p->beta_ = is_given[11] ? given[11] : 50.0;  /* baumgarte.beta */
    p->slot_direction_y_ = is_given[12] ? given[12] : 1.0;  /* joints.slot.direction.y */
    p->gravity_y_ = is_given[13] ? given[13] : -1.0;  /* gravity.y */
    p->left_stiffness_ = is_given[14] ? given[14] : 1.0;  /* forces.left.stiffness */
    p->left_free_length_ = is_given[15] ? given[15] : 0.5;  /* forces.left.free_length */
    p->right_stiffness_ = is_given[16] ? given[16] : 1.0;  /* forces.right.stiffness */
    p->right_free_length_ = is_given[17] ? given[17] : 0.5;  /* forces.right.free_length */
    p->set_axle_y_ = is_given[18] ? given[18] : 0.5;  /* start.set.axle.y */
    p->set_axle_theta_ = is_given[19] ? given[19] : 0.0;  /* start.set.axle.theta */
    p->rates_axle_vy_ = is_given[20] ? given[20] : 0.0;  /* start.rates.axle.vy */
    p->rates_axle_omega_ = is_given[21] ? given[21] : 0.0;  /* start.rates.axle.omega */

    /* derived */
    p->axle_head_s_x_ = 0.5*p->axle_length_;  /* point from the centre of mass */
    p->road_head_s_x_ = 0.5*p->road_length_;  /* point from the centre of mass */
    p->weight_axle_y_ = p->axle_mass_*p->gravity_y_;  /* weight */
    p->weight_road_y_ = p->road_mass_*p->gravity_y_;  /* weight */
    /* J and m s^2 of its joints */
    p->axle_turning_ = (p->axle_head_s_x_ * p->axle_head_s_x_)*p->axle_mass_ + p->axle_inertia_;
    p->two_alpha_ = 2.0*p->alpha_;  /* 2 alpha */
    p->beta_squared_ = (p->beta_ * p->beta_);  /* beta^2 */
    p->inverse_axle_mass_ = 1.0/p->axle_mass_;  /* 1/M */
    p->axle_tail_span_x_ = -p->axle_head_s_x_;  /* vector in its frame */
    p->road_head_span_x_ = 2.0*p->road_head_s_x_;  /* vector in its frame */
    p->inertia_road_road_ = (p->road_head_s_x_ * p->road_head_s_x_)*p->road_mass_;  /* sum of m w.w */
    p->mass_bump_bump_ = p->inertia_road_road_ + p->road_inertia_;  /* constant of M */
    p->weight_road_across_ = p->road_head_s_x_*p->road_mass_*p->gravity_y_;  /* weight */
    p->inverse_axle_inertia_ = 1.0/p->axle_inertia_;  /* 1/M */
    p->mass_of_all_ = p->axle_mass_ + p->road_mass_;  /* of projections */
    p->tree_metric_axle_x_ = max_of(0.0001*p->mass_of_all_, p->axle_mass_);  /* of projections */
    /* of projections */
    p->tree_metric_axle_theta_ = max_of(0.0001*(p->axle_head_s_x_ * p->axle_head_s_x_)*p->mass_of_all_,
        p->axle_inertia_);
    p->inverse_tree_metric_axle_x_ = 1.0/p->tree_metric_axle_x_;  /* 1/M */
    p->inverse_tree_metric_axle_theta_ = 1.0/p->tree_metric_axle_theta_;  /* 1/M */
}
