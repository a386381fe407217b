/*
 * Every number of a run: slots given or by default, then what follows from them.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    p->omega = is_given[0] ? given[0] : 2.0*PI;  /* parameters.omega */
    p->omega4 = is_given[1] ? given[1] : -p->omega;  /* parameters.omega4 */
    p->l5 = is_given[2] ? given[2] : 0.3;  /* parameters.l5 */
    p->c = is_given[3] ? given[3] : 0.0003;  /* parameters.c */
    p->L1_mass = is_given[4] ? given[4] : 0.142;  /* bodies.L1.mass */
    p->L1_inertia = is_given[5] ? given[5] : 0.000303;  /* bodies.L1.inertia */
    p->L2_mass = is_given[6] ? given[6] : 0.284;  /* bodies.L2.mass */
    p->L2_inertia = is_given[7] ? given[7] : 0.001479;  /* bodies.L2.inertia */
    p->L3_mass = is_given[8] ? given[8] : 0.396;  /* bodies.L3.mass */
    p->L3_inertia = is_given[9] ? given[9] : 0.004042;  /* bodies.L3.inertia */
    p->L4_mass = is_given[10] ? given[10] : 0.142;  /* bodies.L4.mass */
    p->L4_inertia = is_given[11] ? given[11] : 0.0003029;  /* bodies.L4.inertia */
    p->L6_mass = is_given[12] ? given[12] : 0.204;  /* bodies.L6.mass */
    p->L6_inertia = is_given[13] ? given[13] : 0.003683;  /* bodies.L6.inertia */
    p->L7_mass = is_given[14] ? given[14] : 0.277;  /* bodies.L7.mass */
    p->L7_inertia = is_given[15] ? given[15] : 0.003076;  /* bodies.L7.inertia */
    p->L8_mass = is_given[16] ? given[16] : 0.341;  /* bodies.L8.mass */
    p->L8_inertia = is_given[17] ? given[17] : 0.002558;  /* bodies.L8.inertia */
    p->S9_mass = is_given[18] ? given[18] : 0.112;  /* bodies.S9.mass */
    p->S9_inertia = is_given[19] ? given[19] : 0.000232;  /* bodies.S9.inertia */
    p->L1_length = is_given[20] ? given[20] : 0.08;  /* bodies.L1.length */
    p->L2_length = is_given[21] ? given[21] : 0.25;  /* bodies.L2.length */
    p->L3_length = is_given[22] ? given[22] : 0.35;  /* bodies.L3.length */
    p->L4_length = is_given[23] ? given[23] : 0.08;  /* bodies.L4.length */
    p->L6_length = is_given[24] ? given[24] : 0.18;  /* bodies.L6.length */
    p->L7_length = is_given[25] ? given[25] : 0.247;  /* bodies.L7.length */
    p->L8_length = is_given[26] ? given[26] : 0.3;  /* bodies.L8.length */
    p->alpha = is_given[27] ? given[27] : 50.0;  /* baumgarte.alpha */
    p->beta = is_given[28] ? given[28] : 50.0;  /* baumgarte.beta */
    p->O4_y = is_given[29] ? given[29] : -p->l5;  /* ground.O4.y */
    p->O6_x = is_given[30] ? given[30] : 0.5;  /* ground.O6.x */
    p->guide_axis_y = is_given[31] ? given[31] : 1.0;  /* joints.guide.axis.y */
    p->gravity_y = is_given[32] ? given[32] : -9.81;  /* gravity.y */
    p->guess_L2_theta = is_given[33] ? given[33] : -79.0*PI/360.0;  /* start.guess.L2.theta */
    p->guess_L3_theta = is_given[34] ? given[34] : 39.0*PI/360.0;  /* start.guess.L3.theta */
    p->guess_L6_theta = is_given[35] ? given[35] : -PI/2.0;  /* start.guess.L6.theta */
    p->guess_L7_theta = is_given[36] ? given[36] : 7.0*PI/180.0;  /* start.guess.L7.theta */
    p->guess_L8_theta = is_given[37] ? given[37] : -PI/2.0;  /* start.guess.L8.theta */

    /* derived */
    p->L1_head_s_x = 0.5*p->L1_length;  /* point from the centre of mass */
    p->L2_head_s_x = 0.5*p->L2_length;  /* point from the centre of mass */
    p->L3_head_s_x = 0.5*p->L3_length;  /* point from the centre of mass */
    p->L4_head_s_x = 0.5*p->L4_length;  /* point from the centre of mass */
    p->L6_head_s_x = 0.5*p->L6_length;  /* point from the centre of mass */
    p->L7_head_s_x = 0.5*p->L7_length;  /* point from the centre of mass */
    p->L8_head_s_x = 0.5*p->L8_length;  /* point from the centre of mass */
    p->weight_L1_y = p->L1_mass*p->gravity_y;  /* weight */
    p->weight_L2_y = p->L2_mass*p->gravity_y;  /* weight */
    p->weight_L3_y = p->L3_mass*p->gravity_y;  /* weight */
    p->weight_L4_y = p->L4_mass*p->gravity_y;  /* weight */
    p->weight_L6_y = p->L6_mass*p->gravity_y;  /* weight */
    p->weight_L7_y = p->L7_mass*p->gravity_y;  /* weight */
    p->weight_L8_y = p->L8_mass*p->gravity_y;  /* weight */
    p->weight_S9_y = p->S9_mass*p->gravity_y;  /* weight */
    p->two_alpha = 2.0*p->alpha;  /* 2 alpha */
    p->beta_squared = (p->beta * p->beta);  /* beta^2 */
    p->inverse_S9_mass = 1.0/p->S9_mass;  /* 1/M */
    p->inverse_S9_inertia = 1.0/p->S9_inertia;  /* 1/M */
    p->inverse_L1_mass = 1.0/p->L1_mass;  /* 1/M */
    p->inverse_L2_mass = 1.0/p->L2_mass;  /* 1/M */
    p->inverse_L3_mass = 1.0/p->L3_mass;  /* 1/M */
    p->inverse_L4_mass = 1.0/p->L4_mass;  /* 1/M */
    p->inverse_L6_mass = 1.0/p->L6_mass;  /* 1/M */
    p->inverse_L8_mass = 1.0/p->L8_mass;  /* 1/M */
    p->inverse_L2_inertia = 1.0/p->L2_inertia;  /* 1/M */
    p->inverse_L3_inertia = 1.0/p->L3_inertia;  /* 1/M */
    p->inverse_L6_inertia = 1.0/p->L6_inertia;  /* 1/M */
    p->inverse_L8_inertia = 1.0/p->L8_inertia;  /* 1/M */
    p->inverse_L7_mass = 1.0/p->L7_mass;  /* 1/M */
    p->inverse_L1_inertia = 1.0/p->L1_inertia;  /* 1/M */
    p->inverse_L4_inertia = 1.0/p->L4_inertia;  /* 1/M */
    p->inverse_L7_inertia = 1.0/p->L7_inertia;  /* 1/M */
    p->L1_head_span_x = 2.0*p->L1_head_s_x;  /* vector in its frame */
    p->L4_head_span_x = 2.0*p->L4_head_s_x;  /* vector in its frame */
    p->L6_head_span_x = 2.0*p->L6_head_s_x;  /* vector in its frame */
    p->L7_com_span_x = -p->L7_head_s_x;  /* vector in its frame */
    p->L8_head_span_x = 2.0*p->L8_head_s_x;  /* vector in its frame */
    p->L2_head_span_x = 2.0*p->L2_head_s_x;  /* vector in its frame */
    p->L3_head_span_x = 2.0*p->L3_head_s_x;  /* vector in its frame */
    p->L7_tail_span_x = -2.0*p->L7_head_s_x;  /* vector in its frame */
    /* sum of m w.w */
    p->inertia_L1_L1 = (p->L1_head_span_x * p->L1_head_span_x)*p->L2_mass
        + (p->L1_head_s_x * p->L1_head_s_x)*p->L1_mass;
    p->inertia_L1_L2 = p->L1_head_span_x*p->L2_head_s_x*p->L2_mass;  /* sum of m w.w */
    p->inertia_L2_L2 = (p->L2_head_s_x * p->L2_head_s_x)*p->L2_mass;  /* sum of m w.w */
    /* sum of m w.w */
    p->inertia_L4_L4 = p->L3_mass*(p->L4_head_span_x * p->L4_head_span_x)
        + (p->L4_head_s_x * p->L4_head_s_x)*p->L4_mass;
    p->inertia_L4_L3 = p->L3_head_s_x*p->L3_mass*p->L4_head_span_x;  /* sum of m w.w */
    p->inertia_L3_L3 = (p->L3_head_s_x * p->L3_head_s_x)*p->L3_mass;  /* sum of m w.w */
    /* sum of m w.w */
    p->inertia_L6_L6 = (p->L6_head_span_x * p->L6_head_span_x)*p->L7_mass
        + (p->L6_head_span_x * p->L6_head_span_x)*p->L8_mass + (p->L6_head_span_x * p->L6_head_span_x)*p->S9_mass
        + (p->L6_head_s_x * p->L6_head_s_x)*p->L6_mass;
    p->inertia_L6_L7 = p->L6_head_span_x*p->L7_com_span_x*p->L7_mass;  /* sum of m w.w */
    p->inertia_L7_L7 = (p->L7_com_span_x * p->L7_com_span_x)*p->L7_mass;  /* sum of m w.w */
    /* sum of m w.w */
    p->inertia_L6_L8 = p->L6_head_span_x*p->L8_head_span_x*p->S9_mass + p->L6_head_span_x*p->L8_head_s_x*p->L8_mass;
    /* sum of m w.w */
    p->inertia_L8_L8 = (p->L8_head_span_x * p->L8_head_span_x)*p->S9_mass
        + (p->L8_head_s_x * p->L8_head_s_x)*p->L8_mass;
    p->mass_crank1_crank1 = p->L1_inertia + p->inertia_L1_L1;  /* constant of M */
    p->mass_L2_L2 = p->L2_inertia + p->inertia_L2_L2;  /* constant of M */
    p->mass_crank4_crank4 = p->L4_inertia + p->inertia_L4_L4;  /* constant of M */
    p->mass_L3_L3 = p->L3_inertia + p->inertia_L3_L3;  /* constant of M */
    p->mass_L6_L6 = p->L6_inertia + p->inertia_L6_L6;  /* constant of M */
    p->mass_L7_L7 = p->L7_inertia + p->inertia_L7_L7;  /* constant of M */
    p->mass_L8_L8 = p->L8_inertia + p->inertia_L8_L8;  /* constant of M */
    /* weight */
    p->weight_L1__across = p->L1_head_span_x*p->L2_mass*p->gravity_y + p->L1_head_s_x*p->L1_mass*p->gravity_y;
    p->weight_L2__across = p->L2_head_s_x*p->L2_mass*p->gravity_y;  /* weight */
    /* weight */
    p->weight_L4__across = p->L3_mass*p->L4_head_span_x*p->gravity_y + p->L4_head_s_x*p->L4_mass*p->gravity_y;
    p->weight_L3__across = p->L3_head_s_x*p->L3_mass*p->gravity_y;  /* weight */
    /* weight */
    p->weight_L6__across = p->L6_head_span_x*p->L7_mass*p->gravity_y + p->L6_head_span_x*p->L8_mass*p->gravity_y
        + p->L6_head_span_x*p->S9_mass*p->gravity_y + p->L6_head_s_x*p->L6_mass*p->gravity_y;
    p->weight_L7__across = p->L7_com_span_x*p->L7_mass*p->gravity_y;  /* weight */
    /* weight */
    p->weight_L8__across = p->L8_head_span_x*p->S9_mass*p->gravity_y + p->L8_head_s_x*p->L8_mass*p->gravity_y;
    p->inverse_mass_L3_L3 = 1.0/p->mass_L3_L3;  /* 1/M */
    p->inverse_mass_L8_L8 = 1.0/p->mass_L8_L8;  /* 1/M */
    p->inverse_mass_L7_L7 = 1.0/p->mass_L7_L7;  /* 1/M */
    p->inverse_mass_L2_L2 = 1.0/p->mass_L2_L2;  /* 1/M */
}
