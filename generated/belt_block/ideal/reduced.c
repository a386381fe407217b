/*
 * Coordinates all_q (N_Q) and velocities all_v of all bodies at tree coordinates q and rates v.
 */
void expand(const double t, const double *q, const double *v, const Parameters *p, double *all_q, double *all_v)
{
    (void)t, (void)p;
    /* coordinates, velocities, time */
    const double guide_slide = q[0];
    const double guide_slide_rate = v[0];

    /* directions, arms, drives */
    const double block_y = 0.0;
    const double block_vy = 0.0;
    const double block_theta = 0.0;
    const double block_omega = 0.0;

    /* bodies */
    all_q[0] = guide_slide;
    all_v[0] = guide_slide_rate;
    all_q[1] = block_y;
    all_v[1] = block_vy;
    all_q[2] = block_theta;
    all_v[2] = block_omega;
}

/*
 * Tree coordinates s and their rates of an absolute state; what the tree does not have is not looked at.
 */
void reduce_state(const double t, const double *q, const double *v, const Parameters *p, double *s, double *s_rate)
{
    (void)t, (void)p;
    /* coordinates, velocities, time */
    const double block_x = q[0];
    const double block_vx = v[0];

    /* tree coordinates */
    s[0] = block_x;  /* guide.slide */
    s_rate[0] = block_vx;
}

/*
 * Phi of the loop closures in tree coordinates; m and rad.
 */
void closures(const double t, const double *q, const Parameters *p, double *out)
{
    (void)t, (void)q, (void)p, (void)out;
    /* this scene has none */
}

/*
 * Its rate Phi_q v - nu.
 */
void closure_rates(const double t, const double *q, const double *v, const Parameters *p, double *out)
{
    (void)t, (void)q, (void)v, (void)p, (void)out;
    /* this scene has none */
}

/*
 * Accelerations a of the tree's coordinates q, and the closures' multipliers in `aside`:
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma] with M, Phi_q, g in these coordinates; drifts are projected away.
 * Returns 0, or the number of the pivot that vanished where the rows contradict each other.
 */
int reduced_dynamics(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    double *a, Aside *aside)
{
    (void)t;
    /* corners: the sides that are held, if any */
    const double *const side = memory->held ? memory->side : NULL;
    double *const g = aside->g;

    /* coordinates, velocities, time */
    const double guide_slide = q[0];
    const double guide_slide_rate = v[0];

    /* directions, arms, drives */
    const double spring_span_x = guide_slide - p->wall_x;
    const double side_0 = side_of(side, g, 0, spring_span_x);
    const double spring_length = side_0*spring_span_x;
    const double spring_force = p->spring_stiffness*(-p->spring_free_length + spring_length);
    const double spring_pull = spring_force/spring_length;

    /* friction: slip, or stick as a row */
    const double slip_rub = guide_slide_rate - p->rub_speed;
    const double mode_rub = memory->mode[0];  /* 0 stick, 1 or -1 the sign of the slip, 2 held */
    const double stick_rub = mode_rub == 0.0 ? 1.0 : 0.0;
    const double sign_rub = fabs(mode_rub) > 1.0 ? 0.0 : mode_rub;
    const double kinetic_rub = -p->rub_kinetic*sign_rub;
    const double rhs_rub = -slip_rub*p->two_alpha_stick;
    aside->friction[0].v = slip_rub;
    aside->friction[0].static_limit = p->rub_static;
    aside->friction[0].speed = p->rub_speed;
    aside->friction[0].force = kinetic_rub;

    /* L D L^T of the KKT matrix */
    const double scale_rub = p->inverse_block_mass;
    if (stick_rub != 0.0 && !(scale_rub > 0.0 && scale_rub < INFINITY))
        return 1;
    const double inverse_pivot_rub = stick_rub != 0.0 ? 1.0/scale_rub : 0.0;

    /* forward substitution */
    const double z_guide_slide = kinetic_rub - spring_pull*spring_span_x;
    const double z_rub = -p->inverse_block_mass*z_guide_slide + rhs_rub;

    /* backward substitution */
    const double lambda_rub = -inverse_pivot_rub*z_rub;
    const double acceleration_guide_slide = -p->inverse_block_mass*lambda_rub + p->inverse_block_mass*z_guide_slide;

    /* results */
    a[0] = acceleration_guide_slide;
    aside->friction[0].rate = acceleration_guide_slide;
    if (stick_rub != 0.0)
        aside->friction[0].force = -lambda_rub;  /* stick of rub */
    aside->power[0] = 0.0;
    aside->power[1] = aside->friction[0].force*(aside->friction[0].speed + aside->friction[0].v);
    aside->power[2] = 0.0;
    return 0;
}

/*
 * Switching functions of the scene's own corners, in aside->g, and what the user watches, in aside->event.
 */
void watched_functions(const double t, const double *q, const double *v, const Memory *memory, const Parameters *p,
    Aside *aside)
{
    (void)t, (void)v, (void)memory;
    /* coordinates, velocities, time */
    const double guide_slide = q[0];

    /* directions, arms, drives */
    const double spring_span_x = guide_slide - p->wall_x;
    aside->g[0] = spring_span_x;
}

/*
 * The smallest x (n), measured by M, with Phi_q x = r; Newton's step, velocities. r holds all rows of
 * the closed linkage, redundant ones are not looked at.
 * Returns 0, or the number of the pivot that vanished.
 */
int reduced_project(const double t, const double *q, const double *r, const Parameters *p, double *x)
{
    (void)t, (void)q, (void)r, (void)p;
    /* backward substitution */
    const double step_acceleration_guide_slide = 0.0;

    /* results */
    x[0] = step_acceleration_guide_slide;
    return 0;
}
