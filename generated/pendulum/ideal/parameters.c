/*
 * Every number of a run: slots given or by default, then what follows from them.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    p->par_g = is_given[0] ? given[0] : 9.81;  /* parameters.g */
    p->length = is_given[1] ? given[1] : 1.0;  /* parameters.length */
    p->bob_mass = is_given[2] ? given[2] : 1.0;  /* bodies.bob.mass */
    p->bob_inertia = is_given[3] ? given[3] : 1.0;  /* bodies.bob.inertia */
    p->alpha = is_given[4] ? given[4] : 50.0;  /* baumgarte.alpha */
    p->beta = is_given[5] ? given[5] : 50.0;  /* baumgarte.beta */
    p->rod_length = is_given[6] ? given[6] : p->length;  /* joints.rod.length */
    p->gravity_y = is_given[7] ? given[7] : -p->par_g;  /* gravity.y */
    p->set_bob_x = is_given[8] ? given[8] : p->length;  /* start.set.bob.x */
    p->set_bob_theta = is_given[9] ? given[9] : 0.0;  /* start.set.bob.theta */
    p->rates_bob_omega = is_given[10] ? given[10] : 0.0;  /* start.rates.bob.omega */

    /* derived */
    p->rod_half_inverse_length = 0.5/p->rod_length;  /* of joint rod */
    p->weight_bob_y = p->bob_mass*p->gravity_y;  /* weight */
    p->two_alpha = 2.0*p->alpha;  /* 2 alpha */
    p->beta_squared = (p->beta * p->beta);  /* beta^2 */
    p->inverse_bob_inertia = 1.0/p->bob_inertia;  /* 1/M */
    p->inverse_bob_mass = 1.0/p->bob_mass;  /* 1/M */
}
