/*
 * Fill all parameters of a run: given values or defaults, then derived parameters.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    p->omega_ = is_given[0] ? given[0] : 2.0*PI;  /* parameters.omega */
    p->omega4_ = is_given[1] ? given[1] : -p->omega_;  /* parameters.omega4 */
    p->l5_ = is_given[2] ? given[2] : 0.3;  /* parameters.l5 */
    p->c_ = is_given[3] ? given[3] : 0.0003;  /* parameters.c */
    p->L1_mass_ = is_given[4] ? given[4] : 0.142;  /* bodies.L1.mass */
    p->L1_inertia_ = is_given[5] ? given[5] : 0.000303;  /* bodies.L1.inertia */
    p->L2_mass_ = is_given[6] ? given[6] : 0.284;  /* bodies.L2.mass */
    p->L2_inertia_ = is_given[7] ? given[7] : 0.001479;  /* bodies.L2.inertia */
    p->L3_mass_ = is_given[8] ? given[8] : 0.396;  /* bodies.L3.mass */
    p->L3_inertia_ = is_given[9] ? given[9] : 0.004042;  /* bodies.L3.inertia */
    p->L4_mass_ = is_given[10] ? given[10] : 0.142;  /* bodies.L4.mass */
    p->L4_inertia_ = is_given[11] ? given[11] : 0.0003029;  /* bodies.L4.inertia */
    p->L6_mass_ = is_given[12] ? given[12] : 0.204;  /* bodies.L6.mass */
    p->L6_inertia_ = is_given[13] ? given[13] : 0.003683;  /* bodies.L6.inertia */
    p->L7_mass_ = is_given[14] ? given[14] : 0.277;  /* bodies.L7.mass */
    p->L7_inertia_ = is_given[15] ? given[15] : 0.003076;  /* bodies.L7.inertia */
    p->L8_mass_ = is_given[16] ? given[16] : 0.341;  /* bodies.L8.mass */
    p->L8_inertia_ = is_given[17] ? given[17] : 0.002558;  /* bodies.L8.inertia */
    p->S9_mass_ = is_given[18] ? given[18] : 0.112;  /* bodies.S9.mass */
    p->S9_inertia_ = is_given[19] ? given[19] : 0.000232;  /* bodies.S9.inertia */
    p->L1_length_ = is_given[20] ? given[20] : 0.08;  /* bodies.L1.length */
    p->L2_length_ = is_given[21] ? given[21] : 0.25;  /* bodies.L2.length */
    p->L3_length_ = is_given[22] ? given[22] : 0.35;  /* bodies.L3.length */
    p->L4_length_ = is_given[23] ? given[23] : 0.08;  /* bodies.L4.length */
    p->L6_length_ = is_given[24] ? given[24] : 0.18;  /* bodies.L6.length */
    p->L7_length_ = is_given[25] ? given[25] : 0.247;  /* bodies.L7.length */
    p->L8_length_ = is_given[26] ? given[26] : 0.3;  /* bodies.L8.length */
    p->alpha_ = is_given[27] ? given[27] : 50.0;  /* baumgarte.alpha */
    p->beta_ = is_given[28] ? given[28] : 50.0;  /* baumgarte.beta */
    p->O4_y_ = is_given[29] ? given[29] : -p->l5_;  /* ground.O4.y */
    p->O6_x_ = is_given[30] ? given[30] : 0.5;  /* ground.O6.x */
    p->guide_axis_y_ = is_given[31] ? given[31] : 1.0;  /* joints.guide.axis.y */
    p->pin_radius_ = is_given[32] ? given[32] : 0.015;  /* bearings.pin.radius */
    p->pin_clearance_ = is_given[33] ? given[33] : p->c_;  /* bearings.pin.clearance */
    p->pin_length_ = is_given[34] ? given[34] : 0.04;  /* bearings.pin.length */
    p->aluminium_E_ = is_given[35] ? given[35] : 70000000000.0;  /* materials.aluminium.E */
    p->pin_bearing_material_E_ = is_given[36] ? given[36] : p->aluminium_E_;  /* bearings.pin.bearing_material.E */
    p->aluminium_nu_ = is_given[37] ? given[37] : 0.3;  /* materials.aluminium.nu */
    p->pin_bearing_material_nu_ = is_given[38] ? given[38] : p->aluminium_nu_;  /* bearings.pin.bearing_material.nu */
    p->pin_journal_material_E_ = is_given[39] ? given[39] : p->aluminium_E_;  /* bearings.pin.journal_material.E */
    p->pin_journal_material_nu_ = is_given[40] ? given[40] : p->aluminium_nu_;  /* bearings.pin.journal_material.nu */
    p->oil_normal_restitution_ = is_given[41] ? given[41] : 0.9;  /* contacts.oil.normal.restitution */
    p->oil_normal_exponent_ = is_given[42] ? given[42] : 1.5;  /* contacts.oil.normal.exponent */
    p->oil_friction_mu_ = is_given[43] ? given[43] : 0.15;  /* contacts.oil.friction.mu */
    p->oil_friction_v0_ = is_given[44] ? given[44] : 0.0001;  /* contacts.oil.friction.v0 */
    p->oil_friction_v1_ = is_given[45] ? given[45] : 0.001;  /* contacts.oil.friction.v1 */
    p->oil_film_viscosity_ = is_given[46] ? given[46] : 0.1;  /* contacts.oil.film.viscosity */
    p->velocity_floor_ = is_given[47] ? given[47] : 1e-06;  /* contacts.oil.velocity_floor */
    p->oil_transition_ = is_given[48] ? given[48] : 5e-06;  /* contacts.oil.transition */
    p->gravity_y_ = is_given[49] ? given[49] : -9.81;  /* gravity.y */
    p->steel_45_E_ = is_given[50] ? given[50] : 206000000000.0;  /* materials.steel_45.E */
    p->steel_45_nu_ = is_given[51] ? given[51] : 0.3;  /* materials.steel_45.nu */
    /* bearings.pin.bearing_material, from 0: aluminium, steel_45 */
    p->pin_bearing_material_ = is_given[52] ? given[52] : 0.0;
    /* bearings.pin.journal_material, from 0: aluminium, steel_45 */
    p->pin_journal_material_ = is_given[53] ? given[53] : 0.0;
    p->guess_L2_theta_ = is_given[54] ? given[54] : -79.0*PI/360.0;  /* start.guess.L2.theta */
    p->guess_L3_theta_ = is_given[55] ? given[55] : 39.0*PI/360.0;  /* start.guess.L3.theta */
    p->guess_L6_theta_ = is_given[56] ? given[56] : -PI/2.0;  /* start.guess.L6.theta */
    p->guess_L7_theta_ = is_given[57] ? given[57] : 7.0*PI/180.0;  /* start.guess.L7.theta */
    p->guess_L8_theta_ = is_given[58] ? given[58] : -PI/2.0;  /* start.guess.L8.theta */

    /* derived */
    p->L1_head_s_x_ = 0.5*p->L1_length_;  /* point from the centre of mass */
    p->L2_head_s_x_ = 0.5*p->L2_length_;  /* point from the centre of mass */
    p->L3_head_s_x_ = 0.5*p->L3_length_;  /* point from the centre of mass */
    p->L4_head_s_x_ = 0.5*p->L4_length_;  /* point from the centre of mass */
    p->L6_head_s_x_ = 0.5*p->L6_length_;  /* point from the centre of mass */
    p->L7_head_s_x_ = 0.5*p->L7_length_;  /* point from the centre of mass */
    p->L8_head_s_x_ = 0.5*p->L8_length_;  /* point from the centre of mass */
    p->R_j_pin_ = -p->pin_clearance_ + p->pin_radius_;  /* journal radius */
    /* contact stiffness */
    p->oil_pin_K_ = (4.0/3.0)*p->pin_bearing_material_E_*sqrt(p->R_j_pin_*p->pin_radius_/(p->R_j_pin_
        + p->pin_radius_))/((p->pin_bearing_material_E_/p->pin_journal_material_E_)*(1.0
        - (p->pin_journal_material_nu_ * p->pin_journal_material_nu_))
        + (1.0 - (p->pin_bearing_material_nu_ * p->pin_bearing_material_nu_)));
    /* hysteresis damping factor a */
    p->oil_pin_hysteresis_ = 0.75 - 0.75*(p->oil_normal_restitution_ * p->oil_normal_restitution_);
    p->oil_pin_friction_slope_ = 1.0/(-p->oil_friction_v0_ + p->oil_friction_v1_);  /* 1/(v1 - v0) */
    /* film factor 6 mu R_j^3 L/c^2 */
    p->oil_pin_S_ = 6.0*(p->R_j_pin_ * p->R_j_pin_ * p->R_j_pin_)*p->oil_film_viscosity_
        *p->pin_length_/(p->pin_clearance_ * p->pin_clearance_);
    p->weight_L1_y_ = p->L1_mass_*p->gravity_y_;  /* weight */
    p->weight_L2_y_ = p->L2_mass_*p->gravity_y_;  /* weight */
    p->weight_L3_y_ = p->L3_mass_*p->gravity_y_;  /* weight */
    p->weight_L4_y_ = p->L4_mass_*p->gravity_y_;  /* weight */
    p->weight_L6_y_ = p->L6_mass_*p->gravity_y_;  /* weight */
    p->weight_L7_y_ = p->L7_mass_*p->gravity_y_;  /* weight */
    p->weight_L8_y_ = p->L8_mass_*p->gravity_y_;  /* weight */
    p->weight_S9_y_ = p->S9_mass_*p->gravity_y_;  /* weight */
    /* J and m s^2 of its joints */
    p->L2_turning_ = 2.0*(p->L2_head_s_x_ * p->L2_head_s_x_)*p->L2_mass_ + p->L2_inertia_;
    /* J and m s^2 of its joints */
    p->L3_turning_ = 2.0*(p->L3_head_s_x_ * p->L3_head_s_x_)*p->L3_mass_ + p->L3_inertia_;
    /* J and m s^2 of its joints */
    p->L6_turning_ = 2.0*(p->L6_head_s_x_ * p->L6_head_s_x_)*p->L6_mass_ + p->L6_inertia_;
    /* J and m s^2 of its joints */
    p->L7_turning_ = 2.0*(p->L7_head_s_x_ * p->L7_head_s_x_)*p->L7_mass_ + p->L7_inertia_;
    /* J and m s^2 of its joints */
    p->L8_turning_ = 2.0*(p->L8_head_s_x_ * p->L8_head_s_x_)*p->L8_mass_ + p->L8_inertia_;
    p->two_alpha_ = 2.0*p->alpha_;  /* 2 alpha */
    p->beta_squared_ = (p->beta_ * p->beta_);  /* beta^2 */
    p->mobility_guide_offset_ = 1.0/p->S9_mass_;  /* 1/m of the bodies of a row */
    p->inverse_pin_clearance_ = 1.0/p->pin_clearance_;  /* 1/pin_clearance_ */
    p->inverse_oil_transition_ = 1.0/p->oil_transition_;  /* 1/oil_transition_ */
    p->L6_head_span_x_ = 2.0*p->L6_head_s_x_;  /* vector in its frame */
    p->L7_com_span_x_ = -p->L7_head_s_x_;  /* vector in its frame */
    p->L7_tail_span_x_ = -2.0*p->L7_head_s_x_;  /* vector in its frame */
    p->L2_com_span_x_ = -p->L2_head_s_x_;  /* vector in its frame */
    p->L3_com_span_x_ = -p->L3_head_s_x_;  /* vector in its frame */
    p->L8_head_span_x_ = 2.0*p->L8_head_s_x_;  /* vector in its frame */
    p->L1_head_span_x_ = 2.0*p->L1_head_s_x_;  /* vector in its frame */
    p->L2_tail_span_x_ = -2.0*p->L2_head_s_x_;  /* vector in its frame */
    p->L4_head_span_x_ = 2.0*p->L4_head_s_x_;  /* vector in its frame */
    p->L3_tail_span_x_ = -2.0*p->L3_head_s_x_;  /* vector in its frame */
    p->inertia_L1_L1_ = (p->L1_head_s_x_ * p->L1_head_s_x_)*p->L1_mass_;  /* sum of m w.w */
    /* sum of m w.w */
    p->inertia_L6_L6_ = p->L2_mass_*(p->L6_head_span_x_ * p->L6_head_span_x_)
        + p->L3_mass_*(p->L6_head_span_x_ * p->L6_head_span_x_) + (p->L6_head_span_x_ * p->L6_head_span_x_)*p->L7_mass_
        + (p->L6_head_span_x_ * p->L6_head_span_x_)*p->L8_mass_ + (p->L6_head_span_x_ * p->L6_head_span_x_)*p->S9_mass_
        + (p->L6_head_s_x_ * p->L6_head_s_x_)*p->L6_mass_;
    /* sum of m w.w */
    p->inertia_L6_L7_ = p->L2_mass_*p->L6_head_span_x_*p->L7_tail_span_x_
        + p->L3_mass_*p->L6_head_span_x_*p->L7_tail_span_x_ + p->L6_head_span_x_*p->L7_com_span_x_*p->L7_mass_;
    p->inertia_L6_L2_ = p->L2_com_span_x_*p->L2_mass_*p->L6_head_span_x_;  /* sum of m w.w */
    /* sum of m w.w */
    p->inertia_L7_L7_ = p->L2_mass_*(p->L7_tail_span_x_ * p->L7_tail_span_x_)
        + p->L3_mass_*(p->L7_tail_span_x_ * p->L7_tail_span_x_) + (p->L7_com_span_x_ * p->L7_com_span_x_)*p->L7_mass_;
    p->inertia_L7_L2_ = p->L2_com_span_x_*p->L2_mass_*p->L7_tail_span_x_;  /* sum of m w.w */
    p->inertia_L2_L2_ = (p->L2_com_span_x_ * p->L2_com_span_x_)*p->L2_mass_;  /* sum of m w.w */
    p->inertia_L6_L3_ = p->L3_com_span_x_*p->L3_mass_*p->L6_head_span_x_;  /* sum of m w.w */
    p->inertia_L7_L3_ = p->L3_com_span_x_*p->L3_mass_*p->L7_tail_span_x_;  /* sum of m w.w */
    p->inertia_L3_L3_ = (p->L3_com_span_x_ * p->L3_com_span_x_)*p->L3_mass_;  /* sum of m w.w */
    p->inertia_L4_L4_ = (p->L4_head_s_x_ * p->L4_head_s_x_)*p->L4_mass_;  /* sum of m w.w */
    /* sum of m w.w */
    p->inertia_L6_L8_ = p->L6_head_span_x_*p->L8_head_span_x_*p->S9_mass_
        + p->L6_head_span_x_*p->L8_head_s_x_*p->L8_mass_;
    /* sum of m w.w */
    p->inertia_L8_L8_ = (p->L8_head_span_x_ * p->L8_head_span_x_)*p->S9_mass_
        + (p->L8_head_s_x_ * p->L8_head_s_x_)*p->L8_mass_;
    p->mass_crank1_crank1_ = p->L1_inertia_ + p->inertia_L1_L1_;  /* constant of M */
    p->mass_L6_L6_ = p->L6_inertia_ + p->inertia_L6_L6_;  /* constant of M */
    p->mass_L7_L7_ = p->L7_inertia_ + p->inertia_L7_L7_;  /* constant of M */
    p->mass_L2_L2_ = p->L2_inertia_ + p->inertia_L2_L2_;  /* constant of M */
    p->mass_L3_L3_ = p->L3_inertia_ + p->inertia_L3_L3_;  /* constant of M */
    p->mass_crank4_crank4_ = p->L4_inertia_ + p->inertia_L4_L4_;  /* constant of M */
    p->mass_L8_L8_ = p->L8_inertia_ + p->inertia_L8_L8_;  /* constant of M */
    p->weight_L1_across_ = p->L1_head_s_x_*p->L1_mass_*p->gravity_y_;  /* weight */
    /* weight */
    p->weight_L6_across_ = p->L2_mass_*p->L6_head_span_x_*p->gravity_y_ + p->L3_mass_*p->L6_head_span_x_*p->gravity_y_
        + p->L6_head_span_x_*p->L7_mass_*p->gravity_y_ + p->L6_head_span_x_*p->L8_mass_*p->gravity_y_
        + p->L6_head_span_x_*p->S9_mass_*p->gravity_y_ + p->L6_head_s_x_*p->L6_mass_*p->gravity_y_;
    /* weight */
    p->weight_L7_across_ = p->L2_mass_*p->L7_tail_span_x_*p->gravity_y_ + p->L3_mass_*p->L7_tail_span_x_*p->gravity_y_
        + p->L7_com_span_x_*p->L7_mass_*p->gravity_y_;
    p->weight_L2_across_ = p->L2_com_span_x_*p->L2_mass_*p->gravity_y_;  /* weight */
    p->weight_L3_across_ = p->L3_com_span_x_*p->L3_mass_*p->gravity_y_;  /* weight */
    p->weight_L4_across_ = p->L4_head_s_x_*p->L4_mass_*p->gravity_y_;  /* weight */
    /* weight */
    p->weight_L8_across_ = p->L8_head_span_x_*p->S9_mass_*p->gravity_y_ + p->L8_head_s_x_*p->L8_mass_*p->gravity_y_;
    p->inverse_mass_L8_L8_ = 1.0/p->mass_L8_L8_;  /* 1/M */
    p->inverse_mass_L2_L2_ = 1.0/p->mass_L2_L2_;  /* 1/M */
    /* of projections */
    p->mass_of_all_ = p->L1_mass_ + p->L2_mass_ + p->L3_mass_ + p->L4_mass_ + p->L6_mass_ + p->L7_mass_ + p->L8_mass_
        + p->S9_mass_;
    /* of projections */
    p->tree_metric_L6_theta_ = max_of(0.0002*(p->L6_head_s_x_ * p->L6_head_s_x_)*p->mass_of_all_, p->mass_L6_L6_);
    /* of projections */
    p->tree_metric_L7_theta_ = max_of(0.0002*(p->L7_head_s_x_ * p->L7_head_s_x_)*p->mass_of_all_, p->mass_L7_L7_);
    /* of projections */
    p->tree_metric_L8_theta_ = max_of(0.0002*(p->L8_head_s_x_ * p->L8_head_s_x_)*p->mass_of_all_, p->mass_L8_L8_);
    /* of projections */
    p->tree_metric_L2_theta_ = max_of(0.0002*(p->L2_head_s_x_ * p->L2_head_s_x_)*p->mass_of_all_, p->mass_L2_L2_);
    /* of projections */
    p->tree_metric_L3_theta_ = max_of(0.0002*(p->L3_head_s_x_ * p->L3_head_s_x_)*p->mass_of_all_, p->mass_L3_L3_);
    p->inverse_tree_metric_L8_theta_ = 1.0/p->tree_metric_L8_theta_;  /* 1/M */
    p->inverse_tree_metric_L2_theta_ = 1.0/p->tree_metric_L2_theta_;  /* 1/M */
    /* of projections */
    p->film_mass_ = 1000000.0*p->L1_mass_ + 1000000.0*p->L2_mass_ + 1000000.0*p->L3_mass_ + 1000000.0*p->L4_mass_
        + 1000000.0*p->L6_mass_ + 1000000.0*p->L7_mass_ + 1000000.0*p->L8_mass_ + 1000000.0*p->S9_mass_;
}

/* Radial clearance of joint i with play, m. */
double radial_clearance(const Parameters *p, int i)
{
    (void)p;
    switch (i) {
    case 0:
        return p->pin_clearance_;
    case 1:
        return p->pin_clearance_;
    default:
        return 0.0;
    }
}

/* The penetration beyond which contact laws are not valid, m: a tenth of the bearing's radius. */
double max_valid_penetration(const Parameters *p, int i)
{
    (void)p;
    switch (i) {
    case 0:
        return (1.0/10.0)*p->pin_radius_;
    case 1:
        return (1.0/10.0)*p->pin_radius_;
    default:
        return 0.0;
    }
}

/* The smallest approach speed that is stored at an onset, m/s. */
double min_approach_speed(const Parameters *p, int i)
{
    (void)p;
    switch (i) {
    case 0:
        return p->velocity_floor_;
    case 1:
        return p->velocity_floor_;
    default:
        return 0.0;
    }
}

