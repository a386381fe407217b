/*
 * Every number of a run: slots given or by default, then what follows from them.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    const double omega = is_given[0] ? given[0] : 188.49555921538757;  /* parameters.omega */
    p->omega = omega;
    const double tilt = is_given[1] ? given[1] : 1.3962634015954636;  /* parameters.tilt */
    p->tilt = tilt;
    const double crank_mass = is_given[2] ? given[2] : 0.05;  /* bodies.crank.mass */
    p->crank_mass = crank_mass;
    const double crank_inertia = is_given[3] ? given[3] : 1e-06;  /* bodies.crank.inertia */
    p->crank_inertia = crank_inertia;
    const double rod_mass = is_given[4] ? given[4] : 0.05;  /* bodies.rod.mass */
    p->rod_mass = rod_mass;
    const double rod_inertia = is_given[5] ? given[5] : 2e-05;  /* bodies.rod.inertia */
    p->rod_inertia = rod_inertia;
    const double table_mass = is_given[6] ? given[6] : 1.0;  /* bodies.table.mass */
    p->table_mass = table_mass;
    const double table_inertia = is_given[7] ? given[7] : 0.001;  /* bodies.table.inertia */
    p->table_inertia = table_inertia;
    const double arm_mass = is_given[8] ? given[8] : 0.06;  /* bodies.arm.mass */
    p->arm_mass = arm_mass;
    const double arm_inertia = is_given[9] ? given[9] : 7.2e-05;  /* bodies.arm.inertia */
    p->arm_inertia = arm_inertia;
    const double crank_length = is_given[10] ? given[10] : 0.01;  /* bodies.crank.length */
    p->crank_length = crank_length;
    const double rod_length = is_given[11] ? given[11] : 0.06;  /* bodies.rod.length */
    p->rod_length = rod_length;
    const double table_points_top_y = is_given[12] ? given[12] : 0.04;  /* bodies.table.points.top.y */
    p->table_points_top_y = table_points_top_y;
    const double arm_length = is_given[13] ? given[13] : 0.12;  /* bodies.arm.length */
    p->arm_length = arm_length;
    const double alpha = is_given[14] ? given[14] : 50.0;  /* baumgarte.alpha */
    p->alpha = alpha;
    const double beta = is_given[15] ? given[15] : 50.0;  /* baumgarte.beta */
    p->beta = beta;
    const double guide_axis_y = is_given[16] ? given[16] : 1.0;  /* joints.guide.axis.y */
    p->guide_axis_y = guide_axis_y;
    const double par_y = is_given[17] ? given[17] : -9.81;  /* gravity.y */
    p->par_y = par_y;
    const double guess_rod_theta = is_given[18] ? given[18] : 1.3962634015954636;  /* start.guess.rod.theta */
    p->guess_rod_theta = guess_rod_theta;
    const double set_arm_theta = is_given[19] ? given[19] : tilt;  /* start.set.arm.theta */
    p->set_arm_theta = set_arm_theta;

    /* derived */
    const double crank_head_x = (0.5)*crank_length;  /* point from the centre of mass */
    p->crank_head_x = crank_head_x;
    const double rod_head_x = (0.5)*rod_length;  /* point from the centre of mass */
    p->rod_head_x = rod_head_x;
    const double arm_head_x = (0.5)*arm_length;  /* point from the centre of mass */
    p->arm_head_x = arm_head_x;
    const double weight_crank_y = crank_mass*par_y;  /* weight */
    p->weight_crank_y = weight_crank_y;
    const double weight_rod_y = par_y*rod_mass;  /* weight */
    p->weight_rod_y = weight_rod_y;
    const double weight_table_y = par_y*table_mass;  /* weight */
    p->weight_table_y = weight_table_y;
    const double weight_arm_y = arm_mass*par_y;  /* weight */
    p->weight_arm_y = weight_arm_y;
    const double two_alpha = 2.0*alpha;  /* 2 alpha */
    p->two_alpha = two_alpha;
    const double beta_squared = (beta * beta);  /* beta^2 */
    p->beta_squared = beta_squared;
    const double inverse_arm_mass = 1.0/arm_mass;  /* 1/M */
    p->inverse_arm_mass = inverse_arm_mass;
    const double inverse_crank_mass = 1.0/crank_mass;  /* 1/M */
    p->inverse_crank_mass = inverse_crank_mass;
    const double inverse_rod_mass = 1.0/rod_mass;  /* 1/M */
    p->inverse_rod_mass = inverse_rod_mass;
    const double inverse_table_mass = 1.0/table_mass;  /* 1/M */
    p->inverse_table_mass = inverse_table_mass;
    const double inverse_arm_inertia = 1.0/arm_inertia;  /* 1/M */
    p->inverse_arm_inertia = inverse_arm_inertia;
    const double inverse_table_inertia = 1.0/table_inertia;  /* 1/M */
    p->inverse_table_inertia = inverse_table_inertia;
    const double inverse_rod_inertia = 1.0/rod_inertia;  /* 1/M */
    p->inverse_rod_inertia = inverse_rod_inertia;
    const double inverse_crank_inertia = 1.0/crank_inertia;  /* 1/M */
    p->inverse_crank_inertia = inverse_crank_inertia;
    const double crank_head_span_x = 2.0*crank_head_x;  /* vector in its frame */
    p->crank_head_span_x = crank_head_span_x;
    const double rod_head_span_x = 2.0*rod_head_x;  /* vector in its frame */
    p->rod_head_span_x = rod_head_span_x;
    const double table_top_x = -table_points_top_y;  /* vector in its frame */
    p->table_top_x = table_top_x;
    const double inertia_crank_crank = arm_mass*(crank_head_span_x * crank_head_span_x) + (crank_head_span_x *
        crank_head_span_x)*rod_mass + (crank_head_span_x * crank_head_span_x)*table_mass + (crank_head_x *
        crank_head_x)*crank_mass;  /* sum of m w.w */
    p->inertia_crank_crank = inertia_crank_crank;
    const double inertia_crank_rod = arm_mass*crank_head_span_x*rod_head_span_x +
        crank_head_span_x*rod_head_span_x*table_mass + crank_head_span_x*rod_head_x*rod_mass;  /* sum of m w.w */
    p->inertia_crank_rod = inertia_crank_rod;
    const double inertia_rod_rod = arm_mass*(rod_head_span_x * rod_head_span_x) + (rod_head_span_x *
        rod_head_span_x)*table_mass + (rod_head_x * rod_head_x)*rod_mass;  /* sum of m w.w */
    p->inertia_rod_rod = inertia_rod_rod;
    const double inertia_crank_arm = arm_head_x*arm_mass*crank_head_span_x;  /* sum of m w.w */
    p->inertia_crank_arm = inertia_crank_arm;
    const double inertia_rod_arm = arm_head_x*arm_mass*rod_head_span_x;  /* sum of m w.w */
    p->inertia_rod_arm = inertia_rod_arm;
    const double inertia_arm_arm = (arm_head_x * arm_head_x)*arm_mass;  /* sum of m w.w */
    p->inertia_arm_arm = inertia_arm_arm;
    const double mass_motor_motor = crank_inertia + inertia_crank_crank;  /* constant of M */
    p->mass_motor_motor = mass_motor_motor;
    const double mass_rod_rod = inertia_rod_rod + rod_inertia;  /* constant of M */
    p->mass_rod_rod = mass_rod_rod;
    const double mass_arm_arm = arm_inertia + inertia_arm_arm;  /* constant of M */
    p->mass_arm_arm = mass_arm_arm;
    const double weight_crank__across = arm_mass*crank_head_span_x*par_y + crank_head_span_x*par_y*rod_mass +
        crank_head_span_x*par_y*table_mass + crank_head_x*crank_mass*par_y;  /* weight */
    p->weight_crank__across = weight_crank__across;
    const double weight_rod__across = arm_mass*par_y*rod_head_span_x + par_y*rod_head_span_x*table_mass +
        par_y*rod_head_x*rod_mass;  /* weight */
    p->weight_rod__across = weight_rod__across;
    const double weight_arm__across = arm_head_x*arm_mass*par_y;  /* weight */
    p->weight_arm__across = weight_arm__across;
    const double inverse_mass_arm_arm = 1.0/mass_arm_arm;  /* 1/M */
    p->inverse_mass_arm_arm = inverse_mass_arm_arm;
}
