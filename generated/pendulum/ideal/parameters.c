/*
 * Fill all parameters of a run: given values or defaults, then derived parameters.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    p->g_ = is_given[0] ? given[0] : 9.81;  /* parameters.g */
    p->length_ = is_given[1] ? given[1] : 1.0;  /* parameters.length */
    p->bob_mass_ = is_given[2] ? given[2] : 1.0;  /* bodies.bob.mass */
    p->bob_inertia_ = is_given[3] ? given[3] : 1.0;  /* bodies.bob.inertia */
    p->alpha_ = is_given[4] ? given[4] : 50.0;  /* baumgarte.alpha */
    p->beta_ = is_given[5] ? given[5] : 50.0;  /* baumgarte.beta */
    p->rod_length_ = is_given[6] ? given[6] : p->length_;  /* joints.rod.length */
    p->gravity_y_ = is_given[7] ? given[7] : -p->g_;  /* gravity.y */
    p->set_bob_x_ = is_given[8] ? given[8] : p->length_;  /* start.set.bob.x */
    p->set_bob_theta_ = is_given[9] ? given[9] : 0.0;  /* start.set.bob.theta */
    p->rates_bob_omega_ = is_given[10] ? given[10] : 0.0;  /* start.rates.bob.omega */

    /* derived */
    p->rod_half_inverse_length_ = 0.5/p->rod_length_;  /* of joint rod */
    p->weight_bob_y_ = p->bob_mass_*p->gravity_y_;  /* weight */
    p->two_alpha_ = 2.0*p->alpha_;  /* 2 alpha */
    p->beta_squared_ = (p->beta_ * p->beta_);  /* beta^2 */
    p->inverse_bob_mass_ = 1.0/p->bob_mass_;  /* 1/M */
    p->inverse_bob_inertia_ = 1.0/p->bob_inertia_;  /* 1/M */
    p->tree_metric_bob_x_ = max_of(0.0001*p->bob_mass_, p->bob_mass_);  /* of projections */
    p->inverse_tree_metric_bob_x_ = 1.0/p->tree_metric_bob_x_;  /* 1/M */
}
