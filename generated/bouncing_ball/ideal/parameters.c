/*
 * Fill all parameters of a run: given values or defaults, then derived parameters.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    p->height_ = is_given[0] ? given[0] : 1.0;  /* parameters.height */
    p->ball_mass_ = is_given[1] ? given[1] : 0.092;  /* bodies.ball.mass */
    p->ball_inertia_ = is_given[2] ? given[2] : 7.212800000000001e-06;  /* bodies.ball.inertia */
    p->alpha_ = is_given[3] ? given[3] : 50.0;  /* baumgarte.alpha */
    p->beta_ = is_given[4] ? given[4] : 50.0;  /* baumgarte.beta */
    p->gravity_y_ = is_given[5] ? given[5] : -9.81;  /* gravity.y */

    /* derived */
    p->weight_ball_y_ = p->ball_mass_*p->gravity_y_;  /* weight */
    p->two_alpha_ = 2.0*p->alpha_;  /* 2 alpha */
    p->beta_squared_ = (p->beta_ * p->beta_);  /* beta^2 */
    p->inverse_ball_inertia_ = 1.0/p->ball_inertia_;  /* 1/M */
}
