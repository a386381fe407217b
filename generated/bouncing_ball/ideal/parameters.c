/*
 * Every number of a run: slots given or by default, then what follows from them.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    const double height = is_given[0] ? given[0] : 1.0;  /* parameters.height */
    p->height = height;
    const double ball_mass = is_given[1] ? given[1] : 0.092;  /* bodies.ball.mass */
    p->ball_mass = ball_mass;
    const double ball_inertia = is_given[2] ? given[2] : 7.212800000000001e-06;  /* bodies.ball.inertia */
    p->ball_inertia = ball_inertia;
    const double alpha = is_given[3] ? given[3] : 50.0;  /* baumgarte.alpha */
    p->alpha = alpha;
    const double beta = is_given[4] ? given[4] : 50.0;  /* baumgarte.beta */
    p->beta = beta;
    const double par_y = is_given[5] ? given[5] : -9.81;  /* gravity.y */
    p->par_y = par_y;

    /* derived */
    const double weight_ball_y = ball_mass*par_y;  /* weight */
    p->weight_ball_y = weight_ball_y;
    const double two_alpha = 2.0*alpha;  /* 2 alpha */
    p->two_alpha = two_alpha;
    const double beta_squared = (beta * beta);  /* beta^2 */
    p->beta_squared = beta_squared;
    const double inverse_ball_inertia = 1.0/ball_inertia;  /* 1/M */
    p->inverse_ball_inertia = inverse_ball_inertia;
    const double inverse_ball_mass = 1.0/ball_mass;  /* 1/M */
    p->inverse_ball_mass = inverse_ball_mass;
}
