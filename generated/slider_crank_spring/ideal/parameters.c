/*
 * Every number of a run: slots given or by default, then what follows from them.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    p->crank_mass = is_given[0] ? given[0] : 1.0;  /* bodies.crank.mass */
    p->crank_inertia = is_given[1] ? given[1] : 1.0;  /* bodies.crank.inertia */
    p->rod_mass = is_given[2] ? given[2] : 1.0;  /* bodies.rod.mass */
    p->rod_inertia = is_given[3] ? given[3] : 2.0;  /* bodies.rod.inertia */
    p->crank_length = is_given[4] ? given[4] : 0.5;  /* bodies.crank.length */
    p->crank_points_middle_x = is_given[5] ? given[5] : 0.25;  /* bodies.crank.points.middle.x */
    p->rod_points_crankpin_x = is_given[6] ? given[6] : -1.0;  /* bodies.rod.points.crankpin.x */
    p->rod_points_middle_x = is_given[7] ? given[7] : -0.5;  /* bodies.rod.points.middle.x */
    p->rod_points_tip_x = is_given[8] ? given[8] : 1.0;  /* bodies.rod.points.tip.x */
    p->alpha = is_given[9] ? given[9] : 50.0;  /* baumgarte.alpha */
    p->beta = is_given[10] ? given[10] : 50.0;  /* baumgarte.beta */
    p->slider_direction_x = is_given[11] ? given[11] : 1.0;  /* joints.slider.direction.x */
    p->coil_stiffness = is_given[12] ? given[12] : 1.0;  /* forces.coil.stiffness */
    p->coil_free_length = is_given[13] ? given[13] : 1.0;  /* forces.coil.free_length */
    p->coil_damping = is_given[14] ? given[14] : 1.0;  /* forces.coil.damping */
    p->push_value_x = is_given[15] ? given[15] : 1.0;  /* forces.push.value.x */
    p->guess_rod_theta = is_given[16] ? given[16] : -PI/6.0;  /* start.guess.rod.theta */
    p->guess_rod_x = is_given[17] ? given[17] : 0.87;  /* start.guess.rod.x */
    p->set_crank_theta = is_given[18] ? given[18] : PI/2.0;  /* start.set.crank.theta */
    p->rates_crank_omega = is_given[19] ? given[19] : 0.0;  /* start.rates.crank.omega */

    /* derived */
    p->two_alpha = 2.0*p->alpha;  /* 2 alpha */
    p->beta_squared = (p->beta * p->beta);  /* beta^2 */
    p->inverse_rod_mass = 1.0/p->rod_mass;  /* 1/M */
    p->inverse_crank_mass = 1.0/p->crank_mass;  /* 1/M */
    p->inverse_crank_inertia = 1.0/p->crank_inertia;  /* 1/M */
    p->inverse_rod_inertia = 1.0/p->rod_inertia;  /* 1/M */
    p->rod_com_span_x = -p->rod_points_crankpin_x;  /* vector in its frame */
    p->rod_middle_span_x = -p->rod_points_crankpin_x + p->rod_points_middle_x;  /* vector in its frame */
    p->rod_tip_span_x = -p->rod_points_crankpin_x + p->rod_points_tip_x;  /* vector in its frame */
    p->inertia_crank_crank = (p->crank_length * p->crank_length)*p->rod_mass;  /* sum of m w.w */
    p->inertia_crank_rod = p->crank_length*p->rod_com_span_x*p->rod_mass;  /* sum of m w.w */
    p->inertia_rod_rod = (p->rod_com_span_x * p->rod_com_span_x)*p->rod_mass;  /* sum of m w.w */
    p->mass_crank_crank = p->crank_inertia + p->inertia_crank_crank;  /* constant of M */
    p->mass_rod_rod = p->inertia_rod_rod + p->rod_inertia;  /* constant of M */
    p->inverse_mass_crank_crank = 1.0/p->mass_crank_crank;  /* 1/M */
}
