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
    p->pin_radius = is_given[32] ? given[32] : 0.015;  /* bearings.pin.radius */
    p->pin_clearance = is_given[33] ? given[33] : p->c;  /* bearings.pin.clearance */
    p->pin_length = is_given[34] ? given[34] : 0.04;  /* bearings.pin.length */
    p->aluminium_E = is_given[35] ? given[35] : 70000000000.0;  /* materials.aluminium.E */
    p->pin_bearing_material_E = is_given[36] ? given[36] : p->aluminium_E;  /* bearings.pin.bearing_material.E */
    p->aluminium_nu = is_given[37] ? given[37] : 0.3;  /* materials.aluminium.nu */
    p->pin_bearing_material_nu = is_given[38] ? given[38] : p->aluminium_nu;  /* bearings.pin.bearing_material.nu */
    p->pin_journal_material_E = is_given[39] ? given[39] : p->aluminium_E;  /* bearings.pin.journal_material.E */
    p->pin_journal_material_nu = is_given[40] ? given[40] : p->aluminium_nu;  /* bearings.pin.journal_material.nu */
    p->dry_normal_restitution = is_given[41] ? given[41] : 0.9;  /* contacts.dry.normal.restitution */
    p->dry_normal_exponent = is_given[42] ? given[42] : 1.5;  /* contacts.dry.normal.exponent */
    p->dry_friction_mu = is_given[43] ? given[43] : 0.15;  /* contacts.dry.friction.mu */
    p->dry_friction_v0 = is_given[44] ? given[44] : 0.0001;  /* contacts.dry.friction.v0 */
    p->dry_friction_v1 = is_given[45] ? given[45] : 0.001;  /* contacts.dry.friction.v1 */
    p->velocity_floor = is_given[46] ? given[46] : 1e-06;  /* contacts.dry.velocity_floor */
    p->gravity_y = is_given[47] ? given[47] : -9.81;  /* gravity.y */
    p->steel_45_E = is_given[48] ? given[48] : 206000000000.0;  /* materials.steel_45.E */
    p->steel_45_nu = is_given[49] ? given[49] : 0.3;  /* materials.steel_45.nu */
    /* bearings.pin.bearing_material, from 0: aluminium, steel_45 */
    p->pin_bearing_material = is_given[50] ? given[50] : 0.0;
    /* bearings.pin.journal_material, from 0: aluminium, steel_45 */
    p->pin_journal_material = is_given[51] ? given[51] : 0.0;
    p->guess_L2_theta = is_given[52] ? given[52] : -79.0*PI/360.0;  /* start.guess.L2.theta */
    p->guess_L3_theta = is_given[53] ? given[53] : 39.0*PI/360.0;  /* start.guess.L3.theta */
    p->guess_L6_theta = is_given[54] ? given[54] : -PI/2.0;  /* start.guess.L6.theta */
    p->guess_L7_theta = is_given[55] ? given[55] : 7.0*PI/180.0;  /* start.guess.L7.theta */
    p->guess_L8_theta = is_given[56] ? given[56] : -PI/2.0;  /* start.guess.L8.theta */

    /* derived */
    p->L1_head_s_x = 0.5*p->L1_length;  /* point from the centre of mass */
    p->L2_head_s_x = 0.5*p->L2_length;  /* point from the centre of mass */
    p->L3_head_s_x = 0.5*p->L3_length;  /* point from the centre of mass */
    p->L4_head_s_x = 0.5*p->L4_length;  /* point from the centre of mass */
    p->L6_head_s_x = 0.5*p->L6_length;  /* point from the centre of mass */
    p->L7_head_s_x = 0.5*p->L7_length;  /* point from the centre of mass */
    p->L8_head_s_x = 0.5*p->L8_length;  /* point from the centre of mass */
    p->R_j_pin = -p->pin_clearance + p->pin_radius;  /* journal radius */
    /* contact stiffness */
    p->dry_pin_K = (4.0/3.0)*p->pin_bearing_material_E*sqrt(p->R_j_pin*p->pin_radius/(p->R_j_pin
        + p->pin_radius))/((p->pin_bearing_material_E/p->pin_journal_material_E)*(1.0
        - (p->pin_journal_material_nu * p->pin_journal_material_nu))
        + (1.0 - (p->pin_bearing_material_nu * p->pin_bearing_material_nu)));
    /* hysteresis damping factor a */
    p->dry_pin_hysteresis = 0.75 - 0.75*(p->dry_normal_restitution * p->dry_normal_restitution);
    p->dry_pin_friction_slope = 1.0/(-p->dry_friction_v0 + p->dry_friction_v1);  /* 1/(v1 - v0) */
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
    p->inverse_L1_mass = 1.0/p->L1_mass;  /* 1/M */
    p->inverse_L2_mass = 1.0/p->L2_mass;  /* 1/M */
    p->inverse_L3_mass = 1.0/p->L3_mass;  /* 1/M */
    p->inverse_L4_mass = 1.0/p->L4_mass;  /* 1/M */
    p->inverse_S9_mass = 1.0/p->S9_mass;  /* 1/M */
    p->inverse_S9_inertia = 1.0/p->S9_inertia;  /* 1/M */
    p->inverse_L2_inertia = 1.0/p->L2_inertia;  /* 1/M */
    p->inverse_L3_inertia = 1.0/p->L3_inertia;  /* 1/M */
    p->inverse_L6_mass = 1.0/p->L6_mass;  /* 1/M */
    p->inverse_L8_mass = 1.0/p->L8_mass;  /* 1/M */
    p->inverse_L1_inertia = 1.0/p->L1_inertia;  /* 1/M */
    p->inverse_L4_inertia = 1.0/p->L4_inertia;  /* 1/M */
    p->inverse_L6_inertia = 1.0/p->L6_inertia;  /* 1/M */
    p->inverse_L7_mass = 1.0/p->L7_mass;  /* 1/M */
    p->inverse_L8_inertia = 1.0/p->L8_inertia;  /* 1/M */
    p->inverse_L7_inertia = 1.0/p->L7_inertia;  /* 1/M */
    p->L6_head_span_x = 2.0*p->L6_head_s_x;  /* vector in its frame */
    p->L7_com_span_x = -p->L7_head_s_x;  /* vector in its frame */
    p->L7_tail_span_x = -2.0*p->L7_head_s_x;  /* vector in its frame */
    p->L2_com_span_x = -p->L2_head_s_x;  /* vector in its frame */
    p->L3_com_span_x = -p->L3_head_s_x;  /* vector in its frame */
    p->L8_head_span_x = 2.0*p->L8_head_s_x;  /* vector in its frame */
    p->L1_head_span_x = 2.0*p->L1_head_s_x;  /* vector in its frame */
    p->L2_tail_span_x = -2.0*p->L2_head_s_x;  /* vector in its frame */
    p->L4_head_span_x = 2.0*p->L4_head_s_x;  /* vector in its frame */
    p->L3_tail_span_x = -2.0*p->L3_head_s_x;  /* vector in its frame */
    p->inertia_L1_L1 = (p->L1_head_s_x * p->L1_head_s_x)*p->L1_mass;  /* sum of m w.w */
    /* sum of m w.w */
    p->inertia_L6_L6 = p->L2_mass*(p->L6_head_span_x * p->L6_head_span_x)
        + p->L3_mass*(p->L6_head_span_x * p->L6_head_span_x) + (p->L6_head_span_x * p->L6_head_span_x)*p->L7_mass
        + (p->L6_head_span_x * p->L6_head_span_x)*p->L8_mass + (p->L6_head_span_x * p->L6_head_span_x)*p->S9_mass
        + (p->L6_head_s_x * p->L6_head_s_x)*p->L6_mass;
    /* sum of m w.w */
    p->inertia_L6_L7 = p->L2_mass*p->L6_head_span_x*p->L7_tail_span_x + p->L3_mass*p->L6_head_span_x*p->L7_tail_span_x
        + p->L6_head_span_x*p->L7_com_span_x*p->L7_mass;
    p->inertia_L6_L2 = p->L2_com_span_x*p->L2_mass*p->L6_head_span_x;  /* sum of m w.w */
    /* sum of m w.w */
    p->inertia_L7_L7 = p->L2_mass*(p->L7_tail_span_x * p->L7_tail_span_x)
        + p->L3_mass*(p->L7_tail_span_x * p->L7_tail_span_x) + (p->L7_com_span_x * p->L7_com_span_x)*p->L7_mass;
    p->inertia_L7_L2 = p->L2_com_span_x*p->L2_mass*p->L7_tail_span_x;  /* sum of m w.w */
    p->inertia_L2_L2 = (p->L2_com_span_x * p->L2_com_span_x)*p->L2_mass;  /* sum of m w.w */
    p->inertia_L6_L3 = p->L3_com_span_x*p->L3_mass*p->L6_head_span_x;  /* sum of m w.w */
    p->inertia_L7_L3 = p->L3_com_span_x*p->L3_mass*p->L7_tail_span_x;  /* sum of m w.w */
    p->inertia_L3_L3 = (p->L3_com_span_x * p->L3_com_span_x)*p->L3_mass;  /* sum of m w.w */
    p->inertia_L4_L4 = (p->L4_head_s_x * p->L4_head_s_x)*p->L4_mass;  /* sum of m w.w */
    /* sum of m w.w */
    p->inertia_L6_L8 = p->L6_head_span_x*p->L8_head_span_x*p->S9_mass + p->L6_head_span_x*p->L8_head_s_x*p->L8_mass;
    /* sum of m w.w */
    p->inertia_L8_L8 = (p->L8_head_span_x * p->L8_head_span_x)*p->S9_mass
        + (p->L8_head_s_x * p->L8_head_s_x)*p->L8_mass;
    p->mass_crank1_crank1 = p->L1_inertia + p->inertia_L1_L1;  /* constant of M */
    p->mass_L6_L6 = p->L6_inertia + p->inertia_L6_L6;  /* constant of M */
    p->mass_L7_L7 = p->L7_inertia + p->inertia_L7_L7;  /* constant of M */
    p->mass_L2_L2 = p->L2_inertia + p->inertia_L2_L2;  /* constant of M */
    p->mass_L3_L3 = p->L3_inertia + p->inertia_L3_L3;  /* constant of M */
    p->mass_crank4_crank4 = p->L4_inertia + p->inertia_L4_L4;  /* constant of M */
    p->mass_L8_L8 = p->L8_inertia + p->inertia_L8_L8;  /* constant of M */
    p->weight_L1__across = p->L1_head_s_x*p->L1_mass*p->gravity_y;  /* weight */
    /* weight */
    p->weight_L6__across = p->L2_mass*p->L6_head_span_x*p->gravity_y + p->L3_mass*p->L6_head_span_x*p->gravity_y
        + p->L6_head_span_x*p->L7_mass*p->gravity_y + p->L6_head_span_x*p->L8_mass*p->gravity_y
        + p->L6_head_span_x*p->S9_mass*p->gravity_y + p->L6_head_s_x*p->L6_mass*p->gravity_y;
    /* weight */
    p->weight_L7__across = p->L2_mass*p->L7_tail_span_x*p->gravity_y + p->L3_mass*p->L7_tail_span_x*p->gravity_y
        + p->L7_com_span_x*p->L7_mass*p->gravity_y;
    p->weight_L2__across = p->L2_com_span_x*p->L2_mass*p->gravity_y;  /* weight */
    p->weight_L3__across = p->L3_com_span_x*p->L3_mass*p->gravity_y;  /* weight */
    p->weight_L4__across = p->L4_head_s_x*p->L4_mass*p->gravity_y;  /* weight */
    /* weight */
    p->weight_L8__across = p->L8_head_span_x*p->S9_mass*p->gravity_y + p->L8_head_s_x*p->L8_mass*p->gravity_y;
    p->inverse_mass_L8_L8 = 1.0/p->mass_L8_L8;  /* 1/M */
    p->inverse_mass_L2_L2 = 1.0/p->mass_L2_L2;  /* 1/M */
}

/* Radial clearance of joint i with play, m. */
double radial_clearance(const Parameters *p, int i)
{
    (void)p;
    switch (i) {
    case 0:
        return p->pin_clearance;
    case 1:
        return p->pin_clearance;
    default:
        return 0.0;
    }
}

/* The penetration beyond which contact laws mean nothing, m: a tenth of the bearing's radius. */
double deepest(const Parameters *p, int i)
{
    (void)p;
    switch (i) {
    case 0:
        return (1.0/10.0)*p->pin_radius;
    case 1:
        return (1.0/10.0)*p->pin_radius;
    default:
        return 0.0;
    }
}

/* The least velocity that counts as that of an impact, m/s. */
double slowest_impact(const Parameters *p, int i)
{
    (void)p;
    switch (i) {
    case 0:
        return p->velocity_floor;
    case 1:
        return p->velocity_floor;
    default:
        return 0.0;
    }
}

