/*
 * Works along a kinematic motion: powers over the steps that follow it, impulses where velocities jump.
 */
/* Powers at a place, and the accelerations of all bodies; a status as that of settle. */
static int powers(Course *course, Position *here, double *power)
{
    RhsOutputs rhs;
#if POSITIONS_IN_TREE
    double a[N_X + 1];
    const int status = solve_motion(course, here, a, &rhs);
#else
    const int status = solve_motion(course, here, here->a, &rhs);
#endif
    for (int k = 0; k < N_WORK; k++)
        power[k] = rhs.power[k];
    return status;
}

/*
 * Works between two places that are one step apart: quadrature of Gauss and Legendre with three nodes. `jumped`: the
 * velocities change by more than the accelerations on the way say, so that the rate of a drive jumps, or nearly so.
 * NOT_FINITE where a power is none, at `work[0]`.
 */
static int work_between(Course *course, const Position *a, const Position *b, double least, double *work, int *jumped)
{
    static const double node[] = {-0.7745966692414834, 0.0, 0.7745966692414834};
    static const double weight[] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
    const double half = 0.5 * (b->t - a->t);
    double missed[N_Q], scale = 0.0;
    for (int k = 0; k < N_Q; k++)
        missed[k] = b->v[k] - a->v[k];
    for (int i = 0; i < 3; i++) {
        Position at;
        double power[N_WORK], moved;
        int status = bracket_point_at(course, a->t + half * (1.0 + node[i]), a, &at, &moved);
        if (!status)
            status = powers(course, &at, power);
        if (status)
            return status;
        for (int k = 0; k < N_WORK; k++) {
            if (!isfinite(power[k])) {
                work[0] = at.t;
                return NOT_FINITE;
            }
            work[k] += half * weight[i] * power[k];
        }
        for (int k = 0; k < N_Q; k++)
            missed[k] -= half * weight[i] * at.a[k];
        scale = larger(scale, half * turn_of(at.a, course->extent));
    }
    const double most = turn_of(missed, course->extent);
    /* or an acceleration is none: a rate of no bounded slope */
    *jumped = !(scale <= DBL_MAX) || (most > least && most > 1e-6 * scale);
    return 0;
}

/* Of all bodies, J. */
static double kinetic_energy_at(const Parameters *p, const Position *at)
{
    double m[N_Q], sum = 0.0;
    mass_matrix(p, m);
    for (int k = 0; k < N_Q; k++)
        sum += 0.5 * m[k] * at->v[k] * at->v[k];
    return sum;
}

/*
 * The same, halved where velocities jump until nothing is left to halve: what kinetic energy gains there is the work
 * of the impulse with which the drives change the velocities. `halvings` are left for the whole step.
 */
static int work_across(Course *course, const Position *a, const Position *b, double least, int *halvings, double *work)
{
    double part[N_WORK] = {0.0}, moved;
    int jumped = 0;
    int status = work_between(course, a, b, least, part, &jumped);
    const double t = a->t + 0.5 * (b->t - a->t);
    const int wide = t > a->t && t < b->t;
    if (status == NOT_FINITE)
        work[0] = part[0];
    if ((status > 0 || status == NEWTON_FAILED) && wide && *halvings > 0)
        jumped = 1; /* a node at a change point */
    else if (status)
        return status;
    if (jumped && wide && *halvings > 0) {
        Position middle;
        --*halvings;
        status = place_near(course, t, a, &middle, &moved);
        if (!status)
            status = work_across(course, a, &middle, least, halvings, work);
        return status ? status : work_across(course, &middle, b, least, halvings, work);
    }
    if (jumped && !wide)
        part[0] = kinetic_energy_at(course->p, b) - kinetic_energy_at(course->p, a);
    if (!isfinite(part[0])) {
        work[0] = t;
        return NOT_FINITE;
    }
    for (int k = 0; k < N_WORK; k++)
        work[k] += part[k];
    return 0;
}

/* Of one step; speeds that change by less than a billionth of what they are do not jump. */
static int work_of_step(Course *course, const Position *a, const Position *b, double *work)
{
    int halvings = MAX_SPLITS;
    const double speed = larger(turn_of(a->v, course->extent), turn_of(b->v, course->extent));
    return work_across(course, a, b, 1e-12 + 1e-9 * speed, &halvings, work);
}

/* Works from the first of n + 1 samples on, (n + 1) x N_WORK, of which the first row is given. */
int gudgeon_kinematic_works(void *integrator, long n, const double *t, const double *parameters, const double *q,
    const double *v, double *work, long *done)
{
    Course *course = integrator;
    Position here = course->work;
    course->p = (const Parameters *)parameters;
    *done = 0;
    int status = course->work_begun ? 0 : begin_near(course, t[0], q, v, &here);
    for (long i = 0; i < n && !status; i++) {
        Stride stride = {t[i + 1] - t[i], 0};
        double *sum = work + (i + 1) * N_WORK;
        for (int k = 0; k < N_WORK; k++)
            sum[k] = work[i * N_WORK + k];
        while (here.t < t[i + 1] && !status) {
            const Position before = here;
            status = step_on(course, &stride, t[i + 1], &here);
            if (!status)
                status = work_of_step(course, &before, &here, sum);
        }
        *done = i + !status;
    }
    course->work = here;
    course->work_begun = 1;
    if (status == NOT_FINITE)
        course->work.t = work[(*done + 1) * N_WORK];
    return status;
}
