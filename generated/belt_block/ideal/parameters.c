/*
 * Every number of a run: slots given or by default, then what follows from them.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    const double belt_speed = is_given[0] ? given[0] : 0.1;  /* parameters.belt_speed */
    p->belt_speed = belt_speed;
    const double start_at = is_given[1] ? given[1] : 0.0;  /* parameters.start_at */
    p->start_at = start_at;
    const double block_mass = is_given[2] ? given[2] : 1.0;  /* bodies.block.mass */
    p->block_mass = block_mass;
    const double block_inertia = is_given[3] ? given[3] : 0.001;  /* bodies.block.inertia */
    p->block_inertia = block_inertia;
    const double alpha = is_given[4] ? given[4] : 50.0;  /* baumgarte.alpha */
    p->alpha = alpha;
    const double beta = is_given[5] ? given[5] : 50.0;  /* baumgarte.beta */
    p->beta = beta;
    const double guide_axis_x = is_given[6] ? given[6] : 1.0;  /* joints.guide.axis.x */
    p->guide_axis_x = guide_axis_x;
    const double wall_x = is_given[7] ? given[7] : -1.0;  /* ground.wall.x */
    p->wall_x = wall_x;
    const double spring_stiffness = is_given[8] ? given[8] : 100.0;  /* forces.spring.stiffness */
    p->spring_stiffness = spring_stiffness;
    const double spring_free_length = is_given[9] ? given[9] : 1.0;  /* forces.spring.free_length */
    p->spring_free_length = spring_free_length;
    const double rub_direction_x = is_given[10] ? given[10] : 1.0;  /* forces.rub.direction.x */
    p->rub_direction_x = rub_direction_x;
    const double rub_speed = is_given[11] ? given[11] : belt_speed;  /* forces.rub.speed */
    p->rub_speed = rub_speed;
    const double rub_static = is_given[12] ? given[12] : 5.886;  /* forces.rub.static */
    p->rub_static = rub_static;
    const double rub_kinetic = is_given[13] ? given[13] : 3.924;  /* forces.rub.kinetic */
    p->rub_kinetic = rub_kinetic;
    const double set_block_x = is_given[14] ? given[14] : start_at;  /* start.set.block.x */
    p->set_block_x = set_block_x;
    const double alpha_stick = is_given[15] ? given[15] : 50.0;  /* baumgarte.stick */
    p->alpha_stick = alpha_stick;

    /* derived */
    const double two_alpha_stick = 2.0*alpha_stick;  /* 2 alpha of a stick */
    p->two_alpha_stick = two_alpha_stick;
    const double two_alpha = 2.0*alpha;  /* 2 alpha */
    p->two_alpha = two_alpha;
    const double beta_squared = (beta * beta);  /* beta^2 */
    p->beta_squared = beta_squared;
    const double inverse_block_mass = 1.0/block_mass;  /* 1/M */
    p->inverse_block_mass = inverse_block_mass;
    const double inverse_block_inertia = 1.0/block_inertia;  /* 1/M */
    p->inverse_block_inertia = inverse_block_inertia;
}
