/*
 * Every number of a run: slots given or by default, then what follows from them.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    p->omega = is_given[0] ? given[0] : 60.0*PI;  /* parameters.omega */
    p->tilt = is_given[1] ? given[1] : 4.0*PI/9.0;  /* parameters.tilt */
    p->crank_mass = is_given[2] ? given[2] : 0.05;  /* bodies.crank.mass */
    p->crank_inertia = is_given[3] ? given[3] : 1e-06;  /* bodies.crank.inertia */
    p->rod_mass = is_given[4] ? given[4] : 0.05;  /* bodies.rod.mass */
    p->rod_inertia = is_given[5] ? given[5] : 2e-05;  /* bodies.rod.inertia */
    p->table_mass = is_given[6] ? given[6] : 1.0;  /* bodies.table.mass */
    p->table_inertia = is_given[7] ? given[7] : 0.001;  /* bodies.table.inertia */
    p->arm_mass = is_given[8] ? given[8] : 0.06;  /* bodies.arm.mass */
    p->arm_inertia = is_given[9] ? given[9] : 7.2e-05;  /* bodies.arm.inertia */
    p->crank_length = is_given[10] ? given[10] : 0.01;  /* bodies.crank.length */
    p->rod_length = is_given[11] ? given[11] : 0.06;  /* bodies.rod.length */
    p->table_points_top_y = is_given[12] ? given[12] : 0.04;  /* bodies.table.points.top.y */
    p->arm_length = is_given[13] ? given[13] : 0.12;  /* bodies.arm.length */
    p->alpha = is_given[14] ? given[14] : 50.0;  /* baumgarte.alpha */
    p->beta = is_given[15] ? given[15] : 50.0;  /* baumgarte.beta */
    p->guide_axis_y = is_given[16] ? given[16] : 1.0;  /* joints.guide.axis.y */
    p->gravity_y = is_given[17] ? given[17] : -9.81;  /* gravity.y */
    p->guess_rod_theta = is_given[18] ? given[18] : 4.0*PI/9.0;  /* start.guess.rod.theta */
    p->set_arm_theta = is_given[19] ? given[19] : p->tilt;  /* start.set.arm.theta */

    /* derived */
    p->crank_head_s_x = 0.5*p->crank_length;  /* point from the centre of mass */
    p->rod_head_s_x = 0.5*p->rod_length;  /* point from the centre of mass */
    p->arm_head_s_x = 0.5*p->arm_length;  /* point from the centre of mass */
    p->weight_crank_y = p->crank_mass*p->gravity_y;  /* weight */
    p->weight_rod_y = p->gravity_y*p->rod_mass;  /* weight */
    p->weight_table_y = p->gravity_y*p->table_mass;  /* weight */
    p->weight_arm_y = p->arm_mass*p->gravity_y;  /* weight */
    p->two_alpha = 2.0*p->alpha;  /* 2 alpha */
    p->beta_squared = (p->beta * p->beta);  /* beta^2 */
    p->inverse_arm_mass = 1.0/p->arm_mass;  /* 1/M */
    p->inverse_crank_mass = 1.0/p->crank_mass;  /* 1/M */
    p->inverse_rod_mass = 1.0/p->rod_mass;  /* 1/M */
    p->inverse_table_mass = 1.0/p->table_mass;  /* 1/M */
    p->inverse_arm_inertia = 1.0/p->arm_inertia;  /* 1/M */
    p->inverse_table_inertia = 1.0/p->table_inertia;  /* 1/M */
    p->inverse_rod_inertia = 1.0/p->rod_inertia;  /* 1/M */
    p->inverse_crank_inertia = 1.0/p->crank_inertia;  /* 1/M */
    p->crank_head_span_x = 2.0*p->crank_head_s_x;  /* vector in its frame */
    p->rod_head_span_x = 2.0*p->rod_head_s_x;  /* vector in its frame */
    /* sum of m w.w */
    p->inertia_crank_crank = p->arm_mass*(p->crank_head_span_x * p->crank_head_span_x)
        + (p->crank_head_span_x * p->crank_head_span_x)*p->rod_mass
        + (p->crank_head_span_x * p->crank_head_span_x)*p->table_mass
        + (p->crank_head_s_x * p->crank_head_s_x)*p->crank_mass;
    /* sum of m w.w */
    p->inertia_crank_rod = p->arm_mass*p->crank_head_span_x*p->rod_head_span_x
        + p->crank_head_span_x*p->rod_head_span_x*p->table_mass + p->crank_head_span_x*p->rod_head_s_x*p->rod_mass;
    /* sum of m w.w */
    p->inertia_rod_rod = p->arm_mass*(p->rod_head_span_x * p->rod_head_span_x)
        + (p->rod_head_span_x * p->rod_head_span_x)*p->table_mass + (p->rod_head_s_x * p->rod_head_s_x)*p->rod_mass;
    p->inertia_crank_arm = p->arm_head_s_x*p->arm_mass*p->crank_head_span_x;  /* sum of m w.w */
    p->inertia_rod_arm = p->arm_head_s_x*p->arm_mass*p->rod_head_span_x;  /* sum of m w.w */
    p->inertia_arm_arm = (p->arm_head_s_x * p->arm_head_s_x)*p->arm_mass;  /* sum of m w.w */
    p->mass_motor_motor = p->crank_inertia + p->inertia_crank_crank;  /* constant of M */
    p->mass_rod_rod = p->inertia_rod_rod + p->rod_inertia;  /* constant of M */
    p->mass_arm_arm = p->arm_inertia + p->inertia_arm_arm;  /* constant of M */
    /* weight */
    p->weight_crank__across = p->arm_mass*p->crank_head_span_x*p->gravity_y
        + p->crank_head_span_x*p->gravity_y*p->rod_mass + p->crank_head_span_x*p->gravity_y*p->table_mass
        + p->crank_head_s_x*p->crank_mass*p->gravity_y;
    /* weight */
    p->weight_rod__across = p->arm_mass*p->gravity_y*p->rod_head_span_x + p->gravity_y*p->rod_head_span_x*p->table_mass
        + p->gravity_y*p->rod_head_s_x*p->rod_mass;
    p->weight_arm__across = p->arm_head_s_x*p->arm_mass*p->gravity_y;  /* weight */
    p->inverse_mass_arm_arm = 1.0/p->mass_arm_arm;  /* 1/M */
}
