/* The closed linkage in tree coordinates. */
#define MAX_BEND 0.05 /* rad, or share of the mechanism's size, that second rates may add to a first guess */

/* Powers, accelerations of the tree. A status counts on behind the closures: it is that of the rescue, `dynamics`. */
static int solve_motion(Course *course, const Position *here, double *a, RhsOutputs *rhs)
{
    const DiscreteState discrete = {.token = &course->cancellation};
    const int status = reduced_dynamics(beyond_jump(here->t), here->s, here->s_rate, &discrete, course->p, a, rhs);
    return status > 0 ? N_LOOPS + status : status;
}

/*
 * Newton on the closures until the step is rounding or no longer shrinks; the rates belong to the positions. Steps
 * are measured in rad, slides as shares of the mechanism's size; `moved` is the way from the first guess.
 */
static int close_linkage(const Course *course, double t, Position *at, double *moved)
{
    double step[N_X + 1], before = INFINITY;
    at->left = 0.0;
    for (int i = 0; i < MAX_NEWTON; i++) {
        double size = 0.0;
        const int status = close_step(t, at->s, course->p, step, at->s_rate, &at->phi);
        if (status)
            return status;
        for (int k = 0; k < N_X; k++)
            size = larger(size, fabs(step[k]) / (is_angle[k] ? 1.0 : course->extent));
        if (isnan(size))
            return NEWTON_FAILED;
        at->left = size;
        if (size < 4e-15 || (size < 1e-9 && size >= 0.5 * before))
            return 0;
        for (int k = 0; k < N_X; k++)
            at->s[k] -= step[k];
        *moved += size;
        before = size;
    }
    return before < 1e-9 ? 0 : NEWTON_FAILED;
}

/*
 * Whether second rates lead further than a first guess may: near an instant at which a drive's second rate is unbounded
 * they do not describe the motion over a whole step.
 */
static int is_unbounded(const Position *from, double h, double extent)
{
    double most = 0.0;
    for (int k = 0; k < N_X; k++)
        most = larger(most, fabs(0.5 * h * h * from->s_second[k]) / (is_angle[k] ? 1.0 : extent));
    return !(most <= MAX_BEND);
}

/* From one place to another near by: first guess s + h s' + h^2 s''/2, or s + h s' where s'' is unbounded. */
static int bracket_point_at(const Course *course, double t, const Position *from, Position *to, double *moved)
{
    const double h = t - from->t, bend = is_unbounded(from, h, course->extent) ? 0.0 : 0.5 * h;
    *moved = 0.0;
    to->t = t;
    to->interpolated = 0;
    for (int k = 0; k < N_X; k++)
        to->s[k] = from->s[k] + h * (from->s_rate[k] + (bend != 0.0 ? bend * from->s_second[k] : 0.0));
    const double then = beyond_jump(t);
    const int status = close_linkage(course, then, to, moved);
    return status ? status
        : arrive(then, to->s, to->s_rate, course->p, to->s_second, to->q, to->v, to->a, &to->phi_dot);
}

/* A place has all that a sample needs. */
static int update_modes(const Course *course, const Position *here) { return (void)course, (void)here, 0; }

/* A given position; where closures depend on each other the equations of motion may still tell its accelerations. */
static int begin(Course *course, double t, const double *q, const double *v, Position *here)
{
    const Parameters *p = course->p;
    double step[N_X + 1], rates[N_X + 1];
    here->t = t;
    here->left = 0.0;
    here->interpolated = 0;
    reduce_state(t, q, v, p, here->s, here->s_rate);
    if (!close_step(beyond_jump(t), here->s, p, step, rates, &here->phi)
        && !arrive(beyond_jump(t), here->s, here->s_rate, p, here->s_second, here->q, here->v, here->a, &here->phi_dot))
        return 0;
    RhsOutputs rhs;
    here->left = INFINITY;
    memcpy(here->q, q, sizeof here->q);
    memcpy(here->v, v, sizeof here->v);
    for (int k = 0; k < N_X; k++)
        here->s_second[k] = 0.0;
    here->phi = here->phi_dot = 0.0;
    const int status =
        dynamics(t, q, v, &(DiscreteState){.token = &course->cancellation, USUAL_SHARES}, p, here->a, &rhs);
    return status > 0 ? N_LOOPS + status : status;
}
