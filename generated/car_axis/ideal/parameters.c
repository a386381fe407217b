/*
 * Every number of a run: slots given or by default, then what follows from them.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    const double length = is_given[0] ? given[0] : 1.0;  /* parameters.length */
    p->length = length;
    const double half_mass = is_given[1] ? given[1] : 0.0005;  /* parameters.half_mass */
    p->half_mass = half_mass;
    const double par_r = is_given[2] ? given[2] : 0.1;  /* parameters.r */
    p->par_r = par_r;
    const double omega = is_given[3] ? given[3] : 10.0;  /* parameters.omega */
    p->omega = omega;
    const double axle_mass = is_given[4] ? given[4] : 2.0*half_mass;  /* bodies.axle.mass */
    p->axle_mass = axle_mass;
    const double axle_inertia = is_given[5] ? given[5] : (0.5)*half_mass*(length * length);  /* bodies.axle.inertia */
    p->axle_inertia = axle_inertia;
    const double road_mass = is_given[6] ? given[6] : 1.0;  /* bodies.road.mass */
    p->road_mass = road_mass;
    const double road_inertia = is_given[7] ? given[7] : 1.0;  /* bodies.road.inertia */
    p->road_inertia = road_inertia;
    const double axle_length = is_given[8] ? given[8] : length;  /* bodies.axle.length */
    p->axle_length = axle_length;
    const double road_length = is_given[9] ? given[9] : length;  /* bodies.road.length */
    p->road_length = road_length;
    const double alpha = is_given[10] ? given[10] : 50.0;  /* baumgarte.alpha */
    p->alpha = alpha;
    const double beta = is_given[11] ? given[11] : 50.0;  /* baumgarte.beta */
    p->beta = beta;
    const double slot_direction_y = is_given[12] ? given[12] : 1.0;  /* joints.slot.direction.y */
    p->slot_direction_y = slot_direction_y;
    const double par_y = is_given[13] ? given[13] : -1.0;  /* gravity.y */
    p->par_y = par_y;
    const double left_stiffness = is_given[14] ? given[14] : 1.0;  /* forces.left.stiffness */
    p->left_stiffness = left_stiffness;
    const double left_free_length = is_given[15] ? given[15] : 0.5;  /* forces.left.free_length */
    p->left_free_length = left_free_length;
    const double right_stiffness = is_given[16] ? given[16] : 1.0;  /* forces.right.stiffness */
    p->right_stiffness = right_stiffness;
    const double right_free_length = is_given[17] ? given[17] : 0.5;  /* forces.right.free_length */
    p->right_free_length = right_free_length;
    const double set_axle_y = is_given[18] ? given[18] : 0.5;  /* start.set.axle.y */
    p->set_axle_y = set_axle_y;

    /* derived */
    const double axle_head_x = (0.5)*axle_length;  /* point from the centre of mass */
    p->axle_head_x = axle_head_x;
    const double road_head_x = (0.5)*road_length;  /* point from the centre of mass */
    p->road_head_x = road_head_x;
    const double weight_axle_y = axle_mass*par_y;  /* weight */
    p->weight_axle_y = weight_axle_y;
    const double weight_road_y = par_y*road_mass;  /* weight */
    p->weight_road_y = weight_road_y;
    const double two_alpha = 2.0*alpha;  /* 2 alpha */
    p->two_alpha = two_alpha;
    const double beta_squared = (beta * beta);  /* beta^2 */
    p->beta_squared = beta_squared;
    const double inverse_axle_mass = 1.0/axle_mass;  /* 1/M */
    p->inverse_axle_mass = inverse_axle_mass;
    const double inverse_axle_inertia = 1.0/axle_inertia;  /* 1/M */
    p->inverse_axle_inertia = inverse_axle_inertia;
    const double inverse_road_mass = 1.0/road_mass;  /* 1/M */
    p->inverse_road_mass = inverse_road_mass;
    const double inverse_road_inertia = 1.0/road_inertia;  /* 1/M */
    p->inverse_road_inertia = inverse_road_inertia;
    const double axle_tail_span_x = -axle_head_x;  /* vector in its frame */
    p->axle_tail_span_x = axle_tail_span_x;
    const double road_head_span_x = 2.0*road_head_x;  /* vector in its frame */
    p->road_head_span_x = road_head_span_x;
    const double inertia_road_road = (road_head_x * road_head_x)*road_mass;  /* sum of m w.w */
    p->inertia_road_road = inertia_road_road;
    const double mass_bump_bump = inertia_road_road + road_inertia;  /* constant of M */
    p->mass_bump_bump = mass_bump_bump;
    const double weight_road__across = par_y*road_head_x*road_mass;  /* weight */
    p->weight_road__across = weight_road__across;
}
