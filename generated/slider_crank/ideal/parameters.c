/*
 * Every number of a run: slots given or by default, then what follows from them.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    p->omega = is_given[0] ? given[0] : 20.0*PI;  /* parameters.omega */
    p->c = is_given[1] ? given[1] : 0.0002;  /* parameters.c */
    p->crank_mass = is_given[2] ? given[2] : 0.3;  /* bodies.crank.mass */
    p->crank_inertia = is_given[3] ? given[3] : 0.0001;  /* bodies.crank.inertia */
    p->rod_mass = is_given[4] ? given[4] : 0.21;  /* bodies.rod.mass */
    p->rod_inertia = is_given[5] ? given[5] : 0.00025;  /* bodies.rod.inertia */
    p->slider_mass = is_given[6] ? given[6] : 0.14;  /* bodies.slider.mass */
    p->slider_inertia = is_given[7] ? given[7] : 0.0001;  /* bodies.slider.inertia */
    p->crank_length = is_given[8] ? given[8] : 0.05;  /* bodies.crank.length */
    p->rod_length = is_given[9] ? given[9] : 0.12;  /* bodies.rod.length */
    p->alpha = is_given[10] ? given[10] : 50.0;  /* baumgarte.alpha */
    p->beta = is_given[11] ? given[11] : 50.0;  /* baumgarte.beta */
    p->cylinder_axis_x = is_given[12] ? given[12] : 1.0;  /* joints.cylinder.axis.x */
    p->guess_rod_theta = is_given[13] ? given[13] : 0.0;  /* start.guess.rod.theta */
    p->guess_slider_x = is_given[14] ? given[14] : 0.17;  /* start.guess.slider.x */

    /* derived */
    p->crank_head_s_x = 0.5*p->crank_length;  /* point from the centre of mass */
    p->rod_head_s_x = 0.5*p->rod_length;  /* point from the centre of mass */
    p->two_alpha = 2.0*p->alpha;  /* 2 alpha */
    p->beta_squared = (p->beta * p->beta);  /* beta^2 */
    p->inverse_slider_mass = 1.0/p->slider_mass;  /* 1/M */
    p->inverse_slider_inertia = 1.0/p->slider_inertia;  /* 1/M */
    p->inverse_crank_mass = 1.0/p->crank_mass;  /* 1/M */
    p->inverse_rod_mass = 1.0/p->rod_mass;  /* 1/M */
    p->inverse_rod_inertia = 1.0/p->rod_inertia;  /* 1/M */
    p->inverse_crank_inertia = 1.0/p->crank_inertia;  /* 1/M */
    p->crank_head_span_x = 2.0*p->crank_head_s_x;  /* vector in its frame */
    p->rod_head_span_x = 2.0*p->rod_head_s_x;  /* vector in its frame */
    /* sum of m w.w */
    p->inertia_crank_crank = (p->crank_head_span_x * p->crank_head_span_x)*p->rod_mass
        + (p->crank_head_span_x * p->crank_head_span_x)*p->slider_mass
        + (p->crank_head_s_x * p->crank_head_s_x)*p->crank_mass;
    /* sum of m w.w */
    p->inertia_crank_rod = p->crank_head_span_x*p->rod_head_span_x*p->slider_mass
        + p->crank_head_span_x*p->rod_head_s_x*p->rod_mass;
    /* sum of m w.w */
    p->inertia_rod_rod = (p->rod_head_span_x * p->rod_head_span_x)*p->slider_mass
        + (p->rod_head_s_x * p->rod_head_s_x)*p->rod_mass;
    p->mass_motor_motor = p->crank_inertia + p->inertia_crank_crank;  /* constant of M */
    p->mass_rod_rod = p->inertia_rod_rod + p->rod_inertia;  /* constant of M */
    p->inverse_mass_rod_rod = 1.0/p->mass_rod_rod;  /* 1/M */
}
