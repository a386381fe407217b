/*
 * Fill all parameters of a run: given values or defaults, then derived parameters.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    p->omega_ = is_given[0] ? given[0] : 60.0*PI;  /* parameters.omega */
    p->tilt_ = is_given[1] ? given[1] : 4.0*PI/9.0;  /* parameters.tilt */
    p->crank_mass_ = is_given[2] ? given[2] : 0.05;  /* bodies.crank.mass */
    p->crank_inertia_ = is_given[3] ? given[3] : 1e-06;  /* bodies.crank.inertia */
    p->rod_mass_ = is_given[4] ? given[4] : 0.05;  /* bodies.rod.mass */
    p->rod_inertia_ = is_given[5] ? given[5] : 2e-05;  /* bodies.rod.inertia */
    p->table_mass_ = is_given[6] ? given[6] : 1.0;  /* bodies.table.mass */
    p->table_inertia_ = is_given[7] ? given[7] : 0.001;  /* bodies.table.inertia */
    p->arm_mass_ = is_given[8] ? given[8] : 0.06;  /* bodies.arm.mass */
    p->arm_inertia_ = is_given[9] ? given[9] : 7.2e-05;  /* bodies.arm.inertia */
    p->crank_length_ = is_given[10] ? given[10] : 0.01;  /* bodies.crank.length */
    p->rod_length_ = is_given[11] ? given[11] : 0.06;  /* bodies.rod.length */
    p->table_points_top_y_ = is_given[12] ? given[12] : 0.04;  /* bodies.table.points.top.y */
    p->arm_length_ = is_given[13] ? given[13] : 0.12;  /* bodies.arm.length */
    p->alpha_ = is_given[14] ? given[14] : 50.0;  /* baumgarte.alpha */
    p->beta_ = is_given[15] ? given[15] : 50.0;  /* baumgarte.beta */
    p->guide_axis_y_ = is_given[16] ? given[16] : 1.0;  /* joints.guide.axis.y */
    p->gravity_y_ = is_given[17] ? given[17] : -9.81;  /* gravity.y */
    p->guess_rod_theta_ = is_given[18] ? given[18] : 4.0*PI/9.0;  /* start.guess.rod.theta */
    p->set_arm_theta_ = is_given[19] ? given[19] : p->tilt_;  /* start.set.arm.theta */

    /* derived */
    p->crank_head_s_x_ = 0.5*p->crank_length_;  /* point from the centre of mass */
    p->rod_head_s_x_ = 0.5*p->rod_length_;  /* point from the centre of mass */
    p->arm_head_s_x_ = 0.5*p->arm_length_;  /* point from the centre of mass */
    p->weight_crank_y_ = p->crank_mass_*p->gravity_y_;  /* weight */
    p->weight_rod_y_ = p->rod_mass_*p->gravity_y_;  /* weight */
    p->weight_table_y_ = p->table_mass_*p->gravity_y_;  /* weight */
    p->weight_arm_y_ = p->arm_mass_*p->gravity_y_;  /* weight */
    /* J and m s^2 of its joints */
    p->arm_turning_ = (p->arm_head_s_x_ * p->arm_head_s_x_)*p->arm_mass_ + p->arm_inertia_;
    /* J and m s^2 of its joints */
    p->rod_turning_ = 2.0*(p->rod_head_s_x_ * p->rod_head_s_x_)*p->rod_mass_ + p->rod_inertia_;
    p->two_alpha_ = 2.0*p->alpha_;  /* 2 alpha */
    p->beta_squared_ = (p->beta_ * p->beta_);  /* beta^2 */
    p->mobility_guide_offset_ = 1.0/p->table_mass_;  /* 1/m of the bodies of a row */
    p->crank_head_span_x_ = 2.0*p->crank_head_s_x_;  /* vector in its frame */
    p->rod_head_span_x_ = 2.0*p->rod_head_s_x_;  /* vector in its frame */
    /* sum of m w.w */
    p->inertia_crank_crank_ = p->arm_mass_*(p->crank_head_span_x_ * p->crank_head_span_x_)
        + (p->crank_head_span_x_ * p->crank_head_span_x_)*p->rod_mass_
        + (p->crank_head_span_x_ * p->crank_head_span_x_)*p->table_mass_
        + (p->crank_head_s_x_ * p->crank_head_s_x_)*p->crank_mass_;
    /* sum of m w.w */
    p->inertia_crank_rod_ = p->arm_mass_*p->crank_head_span_x_*p->rod_head_span_x_
        + p->crank_head_span_x_*p->rod_head_span_x_*p->table_mass_
        + p->crank_head_span_x_*p->rod_head_s_x_*p->rod_mass_;
    /* sum of m w.w */
    p->inertia_rod_rod_ = p->arm_mass_*(p->rod_head_span_x_ * p->rod_head_span_x_)
        + (p->rod_head_span_x_ * p->rod_head_span_x_)*p->table_mass_
        + (p->rod_head_s_x_ * p->rod_head_s_x_)*p->rod_mass_;
    p->inertia_crank_arm_ = p->arm_head_s_x_*p->arm_mass_*p->crank_head_span_x_;  /* sum of m w.w */
    p->inertia_rod_arm_ = p->arm_head_s_x_*p->arm_mass_*p->rod_head_span_x_;  /* sum of m w.w */
    p->inertia_arm_arm_ = (p->arm_head_s_x_ * p->arm_head_s_x_)*p->arm_mass_;  /* sum of m w.w */
    p->mass_motor_motor_ = p->crank_inertia_ + p->inertia_crank_crank_;  /* constant of M */
    p->mass_rod_rod_ = p->inertia_rod_rod_ + p->rod_inertia_;  /* constant of M */
    p->mass_arm_arm_ = p->arm_inertia_ + p->inertia_arm_arm_;  /* constant of M */
    /* weight */
    p->weight_crank_across_ = p->arm_mass_*p->crank_head_span_x_*p->gravity_y_
        + p->crank_head_span_x_*p->rod_mass_*p->gravity_y_ + p->crank_head_span_x_*p->table_mass_*p->gravity_y_
        + p->crank_head_s_x_*p->crank_mass_*p->gravity_y_;
    /* weight */
    p->weight_rod_across_ = p->arm_mass_*p->rod_head_span_x_*p->gravity_y_
        + p->rod_head_span_x_*p->table_mass_*p->gravity_y_ + p->rod_head_s_x_*p->rod_mass_*p->gravity_y_;
    p->weight_arm_across_ = p->arm_head_s_x_*p->arm_mass_*p->gravity_y_;  /* weight */
    p->inverse_mass_arm_arm_ = 1.0/p->mass_arm_arm_;  /* 1/M */
    p->mass_of_all_ = p->arm_mass_ + p->crank_mass_ + p->rod_mass_ + p->table_mass_;  /* of projections */
    /* of projections */
    p->tree_metric_arm_theta_ = max_of(0.0001*(p->arm_head_s_x_ * p->arm_head_s_x_)*p->mass_of_all_, p->mass_arm_arm_);
    p->inverse_tree_metric_arm_theta_ = 1.0/p->tree_metric_arm_theta_;  /* 1/M */
}
