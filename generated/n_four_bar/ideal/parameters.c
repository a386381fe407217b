/*
 * Every number of a run: slots given or by default, then what follows from them.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    p->length = is_given[0] ? given[0] : 1.0;  /* parameters.length */
    p->mass = is_given[1] ? given[1] : 1.0;  /* parameters.mass */
    p->inertia = is_given[2] ? given[2] : (1.0/12.0)*(p->length * p->length)*p->mass;  /* parameters.inertia */
    p->crank0_mass = is_given[3] ? given[3] : p->mass;  /* bodies.crank0.mass */
    p->crank0_inertia = is_given[4] ? given[4] : p->inertia;  /* bodies.crank0.inertia */
    p->crank1_mass = is_given[5] ? given[5] : p->mass;  /* bodies.crank1.mass */
    p->crank1_inertia = is_given[6] ? given[6] : p->inertia;  /* bodies.crank1.inertia */
    p->crank2_mass = is_given[7] ? given[7] : p->mass;  /* bodies.crank2.mass */
    p->crank2_inertia = is_given[8] ? given[8] : p->inertia;  /* bodies.crank2.inertia */
    p->coupler1_mass = is_given[9] ? given[9] : p->mass;  /* bodies.coupler1.mass */
    p->coupler1_inertia = is_given[10] ? given[10] : p->inertia;  /* bodies.coupler1.inertia */
    p->coupler2_mass = is_given[11] ? given[11] : p->mass;  /* bodies.coupler2.mass */
    p->coupler2_inertia = is_given[12] ? given[12] : p->inertia;  /* bodies.coupler2.inertia */
    p->crank0_length = is_given[13] ? given[13] : p->length;  /* bodies.crank0.length */
    p->crank1_length = is_given[14] ? given[14] : p->length;  /* bodies.crank1.length */
    p->crank2_length = is_given[15] ? given[15] : p->length;  /* bodies.crank2.length */
    p->coupler1_length = is_given[16] ? given[16] : p->length;  /* bodies.coupler1.length */
    p->coupler2_length = is_given[17] ? given[17] : p->length;  /* bodies.coupler2.length */
    p->alpha = is_given[18] ? given[18] : 50.0;  /* baumgarte.alpha */
    p->beta = is_given[19] ? given[19] : 50.0;  /* baumgarte.beta */
    p->O1_x = is_given[20] ? given[20] : p->length;  /* ground.O1.x */
    p->O2_x = is_given[21] ? given[21] : 2.0*p->length;  /* ground.O2.x */
    p->gravity_y = is_given[22] ? given[22] : -9.81;  /* gravity.y */
    p->guess_crank1_theta = is_given[23] ? given[23] : PI/2.0;  /* start.guess.crank1.theta */
    p->guess_crank2_theta = is_given[24] ? given[24] : PI/2.0;  /* start.guess.crank2.theta */
    p->guess_coupler1_theta = is_given[25] ? given[25] : 0.0;  /* start.guess.coupler1.theta */
    p->guess_coupler2_theta = is_given[26] ? given[26] : 0.0;  /* start.guess.coupler2.theta */
    p->set_crank0_theta = is_given[27] ? given[27] : PI/2.0;  /* start.set.crank0.theta */
    p->rates_crank0_omega = is_given[28] ? given[28] : -1.0;  /* start.rates.crank0.omega */

    /* derived */
    p->crank0_head_s_x = 0.5*p->crank0_length;  /* point from the centre of mass */
    p->crank1_head_s_x = 0.5*p->crank1_length;  /* point from the centre of mass */
    p->crank2_head_s_x = 0.5*p->crank2_length;  /* point from the centre of mass */
    p->coupler1_head_s_x = 0.5*p->coupler1_length;  /* point from the centre of mass */
    p->coupler2_head_s_x = 0.5*p->coupler2_length;  /* point from the centre of mass */
    p->weight_crank0_y = p->crank0_mass*p->gravity_y;  /* weight */
    p->weight_crank1_y = p->crank1_mass*p->gravity_y;  /* weight */
    p->weight_crank2_y = p->crank2_mass*p->gravity_y;  /* weight */
    p->weight_coupler1_y = p->coupler1_mass*p->gravity_y;  /* weight */
    p->weight_coupler2_y = p->coupler2_mass*p->gravity_y;  /* weight */
    p->two_alpha = 2.0*p->alpha;  /* 2 alpha */
    p->beta_squared = (p->beta * p->beta);  /* beta^2 */
    p->inverse_crank0_mass = 1.0/p->crank0_mass;  /* 1/M */
    p->inverse_crank2_mass = 1.0/p->crank2_mass;  /* 1/M */
    p->inverse_coupler1_mass = 1.0/p->coupler1_mass;  /* 1/M */
    p->inverse_coupler2_mass = 1.0/p->coupler2_mass;  /* 1/M */
    p->inverse_crank1_mass = 1.0/p->crank1_mass;  /* 1/M */
    p->inverse_crank0_inertia = 1.0/p->crank0_inertia;  /* 1/M */
    p->inverse_crank2_inertia = 1.0/p->crank2_inertia;  /* 1/M */
    p->inverse_coupler1_inertia = 1.0/p->coupler1_inertia;  /* 1/M */
    p->inverse_coupler2_inertia = 1.0/p->coupler2_inertia;  /* 1/M */
    p->inverse_crank1_inertia = 1.0/p->crank1_inertia;  /* 1/M */
    p->crank0_head_span_x = 2.0*p->crank0_head_s_x;  /* vector in its frame */
    p->crank1_head_span_x = 2.0*p->crank1_head_s_x;  /* vector in its frame */
    p->coupler2_head_span_x = 2.0*p->coupler2_head_s_x;  /* vector in its frame */
    p->crank2_head_span_x = 2.0*p->crank2_head_s_x;  /* vector in its frame */
    p->coupler1_head_span_x = 2.0*p->coupler1_head_s_x;  /* vector in its frame */
    /* sum of m w.w */
    p->inertia_crank0_crank0 = p->coupler1_mass*(p->crank0_head_span_x * p->crank0_head_span_x)
        + (p->crank0_head_s_x * p->crank0_head_s_x)*p->crank0_mass;
    /* sum of m w.w */
    p->inertia_crank1_crank1 = p->coupler2_mass*(p->crank1_head_span_x * p->crank1_head_span_x)
        + (p->crank1_head_s_x * p->crank1_head_s_x)*p->crank1_mass;
    p->inertia_crank2_crank2 = (p->crank2_head_s_x * p->crank2_head_s_x)*p->crank2_mass;  /* sum of m w.w */
    p->inertia_crank0_coupler1 = p->coupler1_head_s_x*p->coupler1_mass*p->crank0_head_span_x;  /* sum of m w.w */
    p->inertia_coupler1_coupler1 = (p->coupler1_head_s_x * p->coupler1_head_s_x)*p->coupler1_mass;  /* sum of m w.w */
    p->inertia_crank1_coupler2 = p->coupler2_head_s_x*p->coupler2_mass*p->crank1_head_span_x;  /* sum of m w.w */
    p->inertia_coupler2_coupler2 = (p->coupler2_head_s_x * p->coupler2_head_s_x)*p->coupler2_mass;  /* sum of m w.w */
    p->mass_crank0_crank0 = p->crank0_inertia + p->inertia_crank0_crank0;  /* constant of M */
    p->mass_crank1_crank1 = p->crank1_inertia + p->inertia_crank1_crank1;  /* constant of M */
    p->mass_crank2_crank2 = p->crank2_inertia + p->inertia_crank2_crank2;  /* constant of M */
    p->mass_coupler1_coupler1 = p->coupler1_inertia + p->inertia_coupler1_coupler1;  /* constant of M */
    p->mass_coupler2_coupler2 = p->coupler2_inertia + p->inertia_coupler2_coupler2;  /* constant of M */
    /* weight */
    p->weight_crank0__across = p->coupler1_mass*p->crank0_head_span_x*p->gravity_y
        + p->crank0_head_s_x*p->crank0_mass*p->gravity_y;
    /* weight */
    p->weight_crank1__across = p->coupler2_mass*p->crank1_head_span_x*p->gravity_y
        + p->crank1_head_s_x*p->crank1_mass*p->gravity_y;
    p->weight_crank2__across = p->crank2_head_s_x*p->crank2_mass*p->gravity_y;  /* weight */
    p->weight_coupler1__across = p->coupler1_head_s_x*p->coupler1_mass*p->gravity_y;  /* weight */
    p->weight_coupler2__across = p->coupler2_head_s_x*p->coupler2_mass*p->gravity_y;  /* weight */
    p->inverse_mass_crank2_crank2 = 1.0/p->mass_crank2_crank2;  /* 1/M */
    p->inverse_mass_coupler2_coupler2 = 1.0/p->mass_coupler2_coupler2;  /* 1/M */
    p->inverse_mass_crank0_crank0 = 1.0/p->mass_crank0_crank0;  /* 1/M */
}
