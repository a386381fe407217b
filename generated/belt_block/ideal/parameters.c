/*
 * Fill all parameters of a run: given values or defaults, then derived parameters.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    p->belt_speed_ = is_given[0] ? given[0] : 0.1;  /* parameters.belt_speed */
    p->start_at_ = is_given[1] ? given[1] : 0.0;  /* parameters.start_at */
    p->block_mass_ = is_given[2] ? given[2] : 1.0;  /* bodies.block.mass */
    p->block_inertia_ = is_given[3] ? given[3] : 0.001;  /* bodies.block.inertia */
    p->alpha_ = is_given[4] ? given[4] : 50.0;  /* baumgarte.alpha */
    p->beta_ = is_given[5] ? given[5] : 50.0;  /* baumgarte.beta */
    p->guide_axis_x_ = is_given[6] ? given[6] : 1.0;  /* joints.guide.axis.x */
    p->wall_x_ = is_given[7] ? given[7] : -1.0;  /* ground.wall.x */
    p->spring_stiffness_ = is_given[8] ? given[8] : 100.0;  /* forces.spring.stiffness */
    p->spring_free_length_ = is_given[9] ? given[9] : 1.0;  /* forces.spring.free_length */
    p->rub_direction_x_ = is_given[10] ? given[10] : 1.0;  /* forces.rub.direction.x */
    p->rub_speed_ = is_given[11] ? given[11] : p->belt_speed_;  /* forces.rub.speed */
    p->rub_static_ = is_given[12] ? given[12] : 5.886;  /* forces.rub.static */
    p->rub_kinetic_ = is_given[13] ? given[13] : 3.924;  /* forces.rub.kinetic */
    p->set_block_x_ = is_given[14] ? given[14] : p->start_at_;  /* start.set.block.x */
    p->alpha_stick_ = is_given[15] ? given[15] : 50.0;  /* baumgarte.stick */

    /* derived */
    p->two_alpha_stick_ = 2.0*p->alpha_stick_;  /* 2 alpha of a stick */
    p->two_alpha_ = 2.0*p->alpha_;  /* 2 alpha */
    p->beta_squared_ = (p->beta_ * p->beta_);  /* beta^2 */
    p->inverse_block_mass_ = 1.0/p->block_mass_;  /* 1/M */
    p->tree_metric_guide_slide_ = max_of(0.0001*p->block_mass_, p->block_mass_);  /* of projections */
    p->inverse_tree_metric_guide_slide_ = 1.0/p->tree_metric_guide_slide_;  /* 1/M */
}
