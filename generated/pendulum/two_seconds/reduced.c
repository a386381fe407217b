/*
 * Coordinates all_q (N_Q) and velocities all_v of all bodies at tree coordinates q and rates v.
 */
void expand(const double t, const double *q, const double *v, const Parameters *p, double *all_q, double *all_v)
{
    (void)t, (void)p;
    /* coordinates, velocities, time */
    const double bob_x = q[0];
    const double bob_x_rate = v[0];
    const double bob_y = q[1];
    const double bob_y_rate = v[1];
    const double bob_theta = q[2];
    const double bob_omega = v[2];

    /* bodies */
    all_q[0] = bob_x;
    all_v[0] = bob_x_rate;
    all_q[1] = bob_y;
    all_v[1] = bob_y_rate;
    all_q[2] = bob_theta;
    all_v[2] = bob_omega;
}

/*
 * Tree coordinates s and their rates of an absolute state; what the tree does not have is not looked at.
 */
void reduce_state(const double t, const double *q, const double *v, const Parameters *p, double *s, double *s_rate)
{
    (void)t, (void)p;
    /* coordinates, velocities, time */
    const double bob_x = q[0];
    const double bob_y = q[1];
    const double bob_theta = q[2];
    const double bob_vx = v[0];
    const double bob_vy = v[1];
    const double bob_omega = v[2];

    /* tree coordinates */
    s[0] = bob_x;  /* bob.x */
    s_rate[0] = bob_vx;
    s[1] = bob_y;  /* bob.y */
    s_rate[1] = bob_vy;
    s[2] = bob_theta;  /* bob */
    s_rate[2] = bob_omega;
}

/*
 * Their second rates a, from absolute all_a.
 */
void reduce_accelerations(const double t, const double *q, const double *v, const double *all_a, const Parameters *p,
    double *a)
{
    (void)t, (void)q, (void)v, (void)p;
    /* tree coordinates */
    a[0] = all_a[0];  /* bob.x */
    a[1] = all_a[1];  /* bob.y */
    a[2] = all_a[2];  /* bob */
}

/*
 * Phi of the loop closures in tree coordinates; m and rad.
 */
void closures(const double t, const double *q, const Parameters *p, double *out)
{
    (void)t;
    /* coordinates, velocities, time */
    const double bob_x = q[0];
    const double bob_y = q[1];

    /* rows */
    /* rod.length */
    out[0] = (bob_x * bob_x)*p->rod_half_inverse_length + (bob_y * bob_y)*p->rod_half_inverse_length
        - 0.5*p->rod_length;
}

/*
 * Its rate Phi_q v - nu.
 */
void closure_rates(const double t, const double *q, const double *v, const Parameters *p, double *out)
{
    (void)t;
    /* coordinates, velocities, time */
    const double bob_x = q[0];
    const double bob_x_rate = v[0];
    const double bob_y = q[1];
    const double bob_y_rate = v[1];

    /* rows */
    /* rod.length */
    out[0] = 2.0*bob_x*bob_x_rate*p->rod_half_inverse_length + 2.0*bob_y*bob_y_rate*p->rod_half_inverse_length;
}

/*
 * Accelerations a of the tree's coordinates q, and the closures' multipliers in `aside`:
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma] with M, Phi_q, g in these coordinates; drifts are projected away.
 * Returns 0, or the number of the pivot that vanished where the rows contradict each other.
 */
int reduced_dynamics(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    double *a, Aside *aside)
{
    /* coordinates, velocities, time */
    const double bob_x = q[0];
    const double bob_x_rate = v[0];
    const double bob_y = q[1];
    const double bob_y_rate = v[1];

    /* status */
    int pivot = 0;

    /* constraints: gamma */
    const double rhs_rod_length = -2.0*(bob_x_rate * bob_x_rate)*p->rod_half_inverse_length
        - 2.0*(bob_y_rate * bob_y_rate)*p->rod_half_inverse_length;

    /* L D L^T of the KKT matrix */
    const double w_rod_length__bob_x = 2.0*bob_x*p->rod_half_inverse_length;
    const double l_rod_length__bob_x = p->inverse_bob_mass*w_rod_length__bob_x;
    const double w_rod_length__bob_y = 2.0*bob_y*p->rod_half_inverse_length;
    const double l_rod_length__bob_y = p->inverse_bob_mass*w_rod_length__bob_y;
    const double scale_rod_length = l_rod_length__bob_x*w_rod_length__bob_x + l_rod_length__bob_y*w_rod_length__bob_y;
    if (!(scale_rod_length > 0.0 && scale_rod_length < INFINITY)) {
        pivot = 1;
        goto dependent;
    }
    const double inverse_pivot_rod_length = 1.0/scale_rod_length;

    /* forward substitution */
    const double z_rod_length = -l_rod_length__bob_y*p->weight_bob_y + rhs_rod_length;

    /* backward substitution */
    const double lambda_rod_length = -inverse_pivot_rod_length*z_rod_length;
    const double acceleration_bob_y = p->inverse_bob_mass*p->weight_bob_y - l_rod_length__bob_y*lambda_rod_length;
    const double acceleration_bob_x = -l_rod_length__bob_x*lambda_rod_length;
    const double acceleration_bob_theta = 0.0;

    /* results */
    a[0] = acceleration_bob_x;
    a[1] = acceleration_bob_y;
    a[2] = acceleration_bob_theta;
    aside->lambda[0] = lambda_rod_length;
    goto powers;

    /* a pivot vanished: rows depend on each other here */
    dependent:
    pivot = solve_by_absolute(t, q, v, memory, p, a, aside);
    powers:
    aside->power[0] = 0.0;
    aside->power[1] = 0.0;
    aside->power[2] = 0.0;
    return pivot;
}

/*
 * The smallest x (n), measured by M, with Phi_q x = r; Newton's step, velocities. r holds all rows of
 * the closed linkage, redundant ones are not looked at.
 * Returns 0, or the number of the pivot that vanished.
 */
int reduced_project(const double t, const double *q, const double *r, const Parameters *p, double *x)
{
    (void)t;
    /* coordinates, velocities, time */
    const double bob_x = q[0];
    const double bob_y = q[1];

    /* right-hand side */
    const double r_rod_length = r[0];

    /* L D L^T of the KKT matrix */
    const double w_rod_length__bob_x = 2.0*bob_x*p->rod_half_inverse_length;
    const double l_rod_length__bob_x = p->inverse_bob_mass*w_rod_length__bob_x;
    const double w_rod_length__bob_y = 2.0*bob_y*p->rod_half_inverse_length;
    const double l_rod_length__bob_y = p->inverse_bob_mass*w_rod_length__bob_y;
    const double scale_rod_length = l_rod_length__bob_x*w_rod_length__bob_x + l_rod_length__bob_y*w_rod_length__bob_y;
    if (!(scale_rod_length > 0.0 && scale_rod_length < INFINITY))
        return 1;
    const double inverse_pivot_rod_length = 1.0/scale_rod_length;

    /* backward substitution */
    const double step_lambda_rod_length = -inverse_pivot_rod_length*r_rod_length;
    const double step_acceleration_bob_y = -l_rod_length__bob_y*step_lambda_rod_length;
    const double step_acceleration_bob_x = -l_rod_length__bob_x*step_lambda_rod_length;
    const double step_acceleration_bob_theta = 0.0;

    /* results */
    x[0] = step_acceleration_bob_x;
    x[1] = step_acceleration_bob_y;
    x[2] = step_acceleration_bob_theta;
    return 0;
}

/* Multipliers of the closures from those of the absolute rows. */
void tree_multipliers(const double *lambda, double *closing)
{
    (void)lambda, (void)closing;
    closing[0] = + lambda[0];
}
