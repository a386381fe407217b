/*
 * Every number of a run: slots given or by default, then what follows from them.
 */
static void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    const double length = is_given[0] ? given[0] : 1.0;  /* parameters.length */
    p->length = length;
    const double mass = is_given[1] ? given[1] : 1.0;  /* parameters.mass */
    p->mass = mass;
    const double inertia = is_given[2] ? given[2] : (1.0/12.0)*(length * length)*mass;  /* parameters.inertia */
    p->inertia = inertia;
    const double crank0_mass = is_given[3] ? given[3] : mass;  /* bodies.crank0.mass */
    p->crank0_mass = crank0_mass;
    const double crank0_inertia = is_given[4] ? given[4] : inertia;  /* bodies.crank0.inertia */
    p->crank0_inertia = crank0_inertia;
    const double crank1_mass = is_given[5] ? given[5] : mass;  /* bodies.crank1.mass */
    p->crank1_mass = crank1_mass;
    const double crank1_inertia = is_given[6] ? given[6] : inertia;  /* bodies.crank1.inertia */
    p->crank1_inertia = crank1_inertia;
    const double crank2_mass = is_given[7] ? given[7] : mass;  /* bodies.crank2.mass */
    p->crank2_mass = crank2_mass;
    const double crank2_inertia = is_given[8] ? given[8] : inertia;  /* bodies.crank2.inertia */
    p->crank2_inertia = crank2_inertia;
    const double coupler1_mass = is_given[9] ? given[9] : mass;  /* bodies.coupler1.mass */
    p->coupler1_mass = coupler1_mass;
    const double coupler1_inertia = is_given[10] ? given[10] : inertia;  /* bodies.coupler1.inertia */
    p->coupler1_inertia = coupler1_inertia;
    const double coupler2_mass = is_given[11] ? given[11] : mass;  /* bodies.coupler2.mass */
    p->coupler2_mass = coupler2_mass;
    const double coupler2_inertia = is_given[12] ? given[12] : inertia;  /* bodies.coupler2.inertia */
    p->coupler2_inertia = coupler2_inertia;
    const double crank0_length = is_given[13] ? given[13] : length;  /* bodies.crank0.length */
    p->crank0_length = crank0_length;
    const double crank1_length = is_given[14] ? given[14] : length;  /* bodies.crank1.length */
    p->crank1_length = crank1_length;
    const double crank2_length = is_given[15] ? given[15] : length;  /* bodies.crank2.length */
    p->crank2_length = crank2_length;
    const double coupler1_length = is_given[16] ? given[16] : length;  /* bodies.coupler1.length */
    p->coupler1_length = coupler1_length;
    const double coupler2_length = is_given[17] ? given[17] : length;  /* bodies.coupler2.length */
    p->coupler2_length = coupler2_length;
    const double alpha = is_given[18] ? given[18] : 50.0;  /* baumgarte.alpha */
    p->alpha = alpha;
    const double beta = is_given[19] ? given[19] : 50.0;  /* baumgarte.beta */
    p->beta = beta;
    const double O1_x = is_given[20] ? given[20] : length;  /* ground.O1.x */
    p->O1_x = O1_x;
    const double O2_x = is_given[21] ? given[21] : 2.0*length;  /* ground.O2.x */
    p->O2_x = O2_x;
    const double par_y = is_given[22] ? given[22] : -9.81;  /* gravity.y */
    p->par_y = par_y;
    const double guess_crank1_theta = is_given[23] ? given[23] : 1.5707963267948966;  /* start.guess.crank1.theta */
    p->guess_crank1_theta = guess_crank1_theta;
    const double guess_crank2_theta = is_given[24] ? given[24] : 1.5707963267948966;  /* start.guess.crank2.theta */
    p->guess_crank2_theta = guess_crank2_theta;
    const double set_crank0_theta = is_given[25] ? given[25] : 1.5707963267948966;  /* start.set.crank0.theta */
    p->set_crank0_theta = set_crank0_theta;
    const double rates_crank0_omega = is_given[26] ? given[26] : -1.0;  /* start.rates.crank0.omega */
    p->rates_crank0_omega = rates_crank0_omega;

    /* derived */
    const double crank0_head_x = (0.5)*crank0_length;  /* point from the centre of mass */
    p->crank0_head_x = crank0_head_x;
    const double crank1_head_x = (0.5)*crank1_length;  /* point from the centre of mass */
    p->crank1_head_x = crank1_head_x;
    const double crank2_head_x = (0.5)*crank2_length;  /* point from the centre of mass */
    p->crank2_head_x = crank2_head_x;
    const double coupler1_head_x = (0.5)*coupler1_length;  /* point from the centre of mass */
    p->coupler1_head_x = coupler1_head_x;
    const double coupler2_head_x = (0.5)*coupler2_length;  /* point from the centre of mass */
    p->coupler2_head_x = coupler2_head_x;
    const double weight_crank0_y = crank0_mass*par_y;  /* weight */
    p->weight_crank0_y = weight_crank0_y;
    const double weight_crank1_y = crank1_mass*par_y;  /* weight */
    p->weight_crank1_y = weight_crank1_y;
    const double weight_crank2_y = crank2_mass*par_y;  /* weight */
    p->weight_crank2_y = weight_crank2_y;
    const double weight_coupler1_y = coupler1_mass*par_y;  /* weight */
    p->weight_coupler1_y = weight_coupler1_y;
    const double weight_coupler2_y = coupler2_mass*par_y;  /* weight */
    p->weight_coupler2_y = weight_coupler2_y;
    const double two_alpha = 2.0*alpha;  /* 2 alpha */
    p->two_alpha = two_alpha;
    const double beta_squared = (beta * beta);  /* beta^2 */
    p->beta_squared = beta_squared;
    const double inverse_crank0_mass = 1.0/crank0_mass;  /* 1/M */
    p->inverse_crank0_mass = inverse_crank0_mass;
    const double inverse_crank2_mass = 1.0/crank2_mass;  /* 1/M */
    p->inverse_crank2_mass = inverse_crank2_mass;
    const double inverse_coupler1_mass = 1.0/coupler1_mass;  /* 1/M */
    p->inverse_coupler1_mass = inverse_coupler1_mass;
    const double inverse_coupler2_mass = 1.0/coupler2_mass;  /* 1/M */
    p->inverse_coupler2_mass = inverse_coupler2_mass;
    const double inverse_crank1_mass = 1.0/crank1_mass;  /* 1/M */
    p->inverse_crank1_mass = inverse_crank1_mass;
    const double inverse_crank0_inertia = 1.0/crank0_inertia;  /* 1/M */
    p->inverse_crank0_inertia = inverse_crank0_inertia;
    const double inverse_crank2_inertia = 1.0/crank2_inertia;  /* 1/M */
    p->inverse_crank2_inertia = inverse_crank2_inertia;
    const double inverse_coupler1_inertia = 1.0/coupler1_inertia;  /* 1/M */
    p->inverse_coupler1_inertia = inverse_coupler1_inertia;
    const double inverse_coupler2_inertia = 1.0/coupler2_inertia;  /* 1/M */
    p->inverse_coupler2_inertia = inverse_coupler2_inertia;
    const double inverse_crank1_inertia = 1.0/crank1_inertia;  /* 1/M */
    p->inverse_crank1_inertia = inverse_crank1_inertia;
}

