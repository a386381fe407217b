/*
 * Every number of a run: slots given or by default, then what follows from them.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    const double crank_mass = is_given[0] ? given[0] : 1.0;  /* bodies.crank.mass */
    p->crank_mass = crank_mass;
    const double crank_inertia = is_given[1] ? given[1] : 1.0;  /* bodies.crank.inertia */
    p->crank_inertia = crank_inertia;
    const double rod_mass = is_given[2] ? given[2] : 1.0;  /* bodies.rod.mass */
    p->rod_mass = rod_mass;
    const double rod_inertia = is_given[3] ? given[3] : 2.0;  /* bodies.rod.inertia */
    p->rod_inertia = rod_inertia;
    const double crank_length = is_given[4] ? given[4] : 0.5;  /* bodies.crank.length */
    p->crank_length = crank_length;
    const double crank_points_middle_x = is_given[5] ? given[5] : 0.25;  /* bodies.crank.points.middle.x */
    p->crank_points_middle_x = crank_points_middle_x;
    const double rod_points_crankpin_x = is_given[6] ? given[6] : -1.0;  /* bodies.rod.points.crankpin.x */
    p->rod_points_crankpin_x = rod_points_crankpin_x;
    const double rod_points_middle_x = is_given[7] ? given[7] : -0.5;  /* bodies.rod.points.middle.x */
    p->rod_points_middle_x = rod_points_middle_x;
    const double rod_points_tip_x = is_given[8] ? given[8] : 1.0;  /* bodies.rod.points.tip.x */
    p->rod_points_tip_x = rod_points_tip_x;
    const double alpha = is_given[9] ? given[9] : 50.0;  /* baumgarte.alpha */
    p->alpha = alpha;
    const double beta = is_given[10] ? given[10] : 50.0;  /* baumgarte.beta */
    p->beta = beta;
    const double slider_direction_x = is_given[11] ? given[11] : 1.0;  /* joints.slider.direction.x */
    p->slider_direction_x = slider_direction_x;
    const double coil_stiffness = is_given[12] ? given[12] : 1.0;  /* forces.coil.stiffness */
    p->coil_stiffness = coil_stiffness;
    const double coil_free_length = is_given[13] ? given[13] : 1.0;  /* forces.coil.free_length */
    p->coil_free_length = coil_free_length;
    const double coil_damping = is_given[14] ? given[14] : 1.0;  /* forces.coil.damping */
    p->coil_damping = coil_damping;
    const double push_value_x = is_given[15] ? given[15] : 1.0;  /* forces.push.value.x */
    p->push_value_x = push_value_x;
    const double guess_rod_theta = is_given[16] ? given[16] : -0.5235987755982988;  /* start.guess.rod.theta */
    p->guess_rod_theta = guess_rod_theta;
    const double guess_rod_x = is_given[17] ? given[17] : 0.87;  /* start.guess.rod.x */
    p->guess_rod_x = guess_rod_x;
    const double set_crank_theta = is_given[18] ? given[18] : 1.5707963267948966;  /* start.set.crank.theta */
    p->set_crank_theta = set_crank_theta;

    /* derived */
    const double two_alpha = 2.0*alpha;  /* 2 alpha */
    p->two_alpha = two_alpha;
    const double beta_squared = (beta * beta);  /* beta^2 */
    p->beta_squared = beta_squared;
    const double inverse_rod_mass = 1.0/rod_mass;  /* 1/M */
    p->inverse_rod_mass = inverse_rod_mass;
    const double inverse_crank_mass = 1.0/crank_mass;  /* 1/M */
    p->inverse_crank_mass = inverse_crank_mass;
    const double inverse_crank_inertia = 1.0/crank_inertia;  /* 1/M */
    p->inverse_crank_inertia = inverse_crank_inertia;
    const double inverse_rod_inertia = 1.0/rod_inertia;  /* 1/M */
    p->inverse_rod_inertia = inverse_rod_inertia;
    const double rod_com_span_x = -rod_points_crankpin_x;  /* vector in its frame */
    p->rod_com_span_x = rod_com_span_x;
    const double rod_middle_span_x = -rod_points_crankpin_x + rod_points_middle_x;  /* vector in its frame */
    p->rod_middle_span_x = rod_middle_span_x;
    const double rod_tip_span_x = -rod_points_crankpin_x + rod_points_tip_x;  /* vector in its frame */
    p->rod_tip_span_x = rod_tip_span_x;
    const double inertia_crank_crank = (crank_length * crank_length)*rod_mass;  /* sum of m w.w */
    p->inertia_crank_crank = inertia_crank_crank;
    const double inertia_crank_rod = crank_length*rod_com_span_x*rod_mass;  /* sum of m w.w */
    p->inertia_crank_rod = inertia_crank_rod;
    const double inertia_rod_rod = (rod_com_span_x * rod_com_span_x)*rod_mass;  /* sum of m w.w */
    p->inertia_rod_rod = inertia_rod_rod;
    const double mass_crank_crank = crank_inertia + inertia_crank_crank;  /* constant of M */
    p->mass_crank_crank = mass_crank_crank;
    const double mass_rod_rod = inertia_rod_rod + rod_inertia;  /* constant of M */
    p->mass_rod_rod = mass_rod_rod;
    const double inverse_mass_crank_crank = 1.0/mass_crank_crank;  /* 1/M */
    p->inverse_mass_crank_crank = inverse_mass_crank_crank;
}
