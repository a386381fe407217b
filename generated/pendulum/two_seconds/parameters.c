/*
 * Every number of a run: slots given or by default, then what follows from them.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    const double par_g = is_given[0] ? given[0] : 13.750371636040745;  /* parameters.g */
    p->par_g = par_g;
    const double length = is_given[1] ? given[1] : 1.0;  /* parameters.length */
    p->length = length;
    const double bob_mass = is_given[2] ? given[2] : 1.0;  /* bodies.bob.mass */
    p->bob_mass = bob_mass;
    const double bob_inertia = is_given[3] ? given[3] : 1.0;  /* bodies.bob.inertia */
    p->bob_inertia = bob_inertia;
    const double alpha = is_given[4] ? given[4] : 50.0;  /* baumgarte.alpha */
    p->alpha = alpha;
    const double beta = is_given[5] ? given[5] : 50.0;  /* baumgarte.beta */
    p->beta = beta;
    const double rod_length = is_given[6] ? given[6] : length;  /* joints.rod.length */
    p->rod_length = rod_length;
    const double par_y = is_given[7] ? given[7] : -par_g;  /* gravity.y */
    p->par_y = par_y;
    const double set_bob_x = is_given[8] ? given[8] : length;  /* start.set.bob.x */
    p->set_bob_x = set_bob_x;

    /* derived */
    const double rod_half_inverse_length = (0.5)/rod_length;  /* of joint rod */
    p->rod_half_inverse_length = rod_half_inverse_length;
    const double weight_bob_y = bob_mass*par_y;  /* weight */
    p->weight_bob_y = weight_bob_y;
    const double two_alpha = 2.0*alpha;  /* 2 alpha */
    p->two_alpha = two_alpha;
    const double beta_squared = (beta * beta);  /* beta^2 */
    p->beta_squared = beta_squared;
    const double inverse_bob_inertia = 1.0/bob_inertia;  /* 1/M */
    p->inverse_bob_inertia = inverse_bob_inertia;
    const double inverse_bob_mass = 1.0/bob_mass;  /* 1/M */
    p->inverse_bob_mass = inverse_bob_mass;
}
