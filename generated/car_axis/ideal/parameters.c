/*
 * Every number of a run: slots given or by default, then what follows from them.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    p->length = is_given[0] ? given[0] : 1.0;  /* parameters.length */
    p->half_mass = is_given[1] ? given[1] : 0.0005;  /* parameters.half_mass */
    p->par_r = is_given[2] ? given[2] : 0.1;  /* parameters.r */
    p->omega = is_given[3] ? given[3] : 10.0;  /* parameters.omega */
    p->axle_mass = is_given[4] ? given[4] : 2.0*p->half_mass;  /* bodies.axle.mass */
    p->axle_inertia = is_given[5] ? given[5] : 0.5*p->half_mass*(p->length * p->length);  /* bodies.axle.inertia */
    p->road_mass = is_given[6] ? given[6] : 1.0;  /* bodies.road.mass */
    p->road_inertia = is_given[7] ? given[7] : 1.0;  /* bodies.road.inertia */
    p->axle_length = is_given[8] ? given[8] : p->length;  /* bodies.axle.length */
    p->road_length = is_given[9] ? given[9] : p->length;  /* bodies.road.length */
    p->alpha = is_given[10] ? given[10] : 50.0;  /* baumgarte.alpha */
    p->beta = is_given[11] ? given[11] : 50.0;  /* baumgarte.beta */
    p->slot_direction_y = is_given[12] ? given[12] : 1.0;  /* joints.slot.direction.y */
    p->gravity_y = is_given[13] ? given[13] : -1.0;  /* gravity.y */
    p->left_stiffness = is_given[14] ? given[14] : 1.0;  /* forces.left.stiffness */
    p->left_free_length = is_given[15] ? given[15] : 0.5;  /* forces.left.free_length */
    p->right_stiffness = is_given[16] ? given[16] : 1.0;  /* forces.right.stiffness */
    p->right_free_length = is_given[17] ? given[17] : 0.5;  /* forces.right.free_length */
    p->set_axle_y = is_given[18] ? given[18] : 0.5;  /* start.set.axle.y */
    p->set_axle_theta = is_given[19] ? given[19] : 0.0;  /* start.set.axle.theta */
    p->rates_axle_vy = is_given[20] ? given[20] : 0.0;  /* start.rates.axle.vy */
    p->rates_axle_omega = is_given[21] ? given[21] : 0.0;  /* start.rates.axle.omega */

    /* derived */
    p->axle_head_s_x = 0.5*p->axle_length;  /* point from the centre of mass */
    p->road_head_s_x = 0.5*p->road_length;  /* point from the centre of mass */
    p->weight_axle_y = p->axle_mass*p->gravity_y;  /* weight */
    p->weight_road_y = p->gravity_y*p->road_mass;  /* weight */
    p->two_alpha = 2.0*p->alpha;  /* 2 alpha */
    p->beta_squared = (p->beta * p->beta);  /* beta^2 */
    p->inverse_axle_mass = 1.0/p->axle_mass;  /* 1/M */
    p->inverse_axle_inertia = 1.0/p->axle_inertia;  /* 1/M */
    p->inverse_road_mass = 1.0/p->road_mass;  /* 1/M */
    p->inverse_road_inertia = 1.0/p->road_inertia;  /* 1/M */
    p->axle_tail_span_x = -p->axle_head_s_x;  /* vector in its frame */
    p->road_head_span_x = 2.0*p->road_head_s_x;  /* vector in its frame */
    p->inertia_road_road = (p->road_head_s_x * p->road_head_s_x)*p->road_mass;  /* sum of m w.w */
    p->mass_bump_bump = p->inertia_road_road + p->road_inertia;  /* constant of M */
    p->weight_road__across = p->gravity_y*p->road_head_s_x*p->road_mass;  /* weight */
}
