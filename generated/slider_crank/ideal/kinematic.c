/*
 * No degree of freedom is left: at every time the drives say where everything is. Nothing is integrated; the motion
 * is followed from sample to sample so that it stays on its branch.
 */
enum { MAX_NEWTON = 12, MAX_HALVINGS = 40, MAX_SPLITS = 400, PULSE_HALVINGS = 30, NEWTON_FAILED = -1, NO_NUMBER = -2 };

/* A place on the way: the motion of all bodies at a time, the largest |Phi| and |Phi_dot| there. */
typedef struct {
    Asked *asked;
    double t, q[N_Q], v[N_Q], a[N_Q], phi, phi_dot;
    double s[N_X + 1], s_rate[N_X + 1], s_second[N_X + 1]; /* the same in tree coordinates */
} Place;

/* What a way is measured by (a share of the mechanism's size or rad; m), and the step that it has come down to. */
typedef struct {
    double reach, extent, h;
    int halvings;
} Stride;

/* A run of many calls: where it is to end, where its motion and its works are, whom it asks, its pace. */
typedef struct {
    double reach, extent, t_end;
    Asked asked;
    Pace pace;
    Place motion, work;
    int motion_begun, work_begun;
} Course;

size_t gudgeon_course_size(void) { return sizeof(Course); }

/* `reach` and `extent` as in Stride; `ask` is called with `whom` each `every` seconds (0: at each step). */
void gudgeon_course_begin(void *memory, double reach, double extent, double t_end, int (*ask)(void *), void *whom,
    double every)
{
    Course *course = memory;
    *course = (Course){.reach = reach, .extent = extent, .t_end = t_end};
    set_asked(&course->asked, ask, whom, every);
}

/* The motion is begun anew at the next call, from a row that is given there. */
void gudgeon_course_again(void *memory) { ((Course *)memory)->motion_begun = 0; }

/* How far motion and works got, s; s that its last steps gained, how many they are, whether they are far shorter. */
void gudgeon_course_pace(const void *memory, double *t, double *gained, long *steps)
{
    const Course *course = memory;
    t[0] = course->motion.t;
    t[1] = course->work_begun ? course->work.t : NAN;
    *gained = course->pace.gain;
    steps[0] = PACE_STEPS;
    steps[1] = course->pace.crawls;
}

/* The larger one; NaN stays. */
static double larger(double most, double x) { return x > most || isnan(x) ? x : most; }

/*
 * Newton's step and the rates of the tree's coordinates q: Phi_q step = Phi, Phi_q rates = nu.
 * `worst`: the largest |Phi|. Returns 0, or the number of a row that depends on others here.
 */
static int close_step(const double t, const double *q, const Parameters *p, double *step, double *rates,
    double *worst)
{
    /* coordinates, velocities, time */
    const double time = t;
    const double rod_theta = q[0];

    /* parameters */
    const double omega = p->omega;
    const double crank_head_span_x = p->crank_head_span_x;
    const double rod_head_span_x = p->rod_head_span_x;

    /* directions, arms, drives */
    const double motor_value = omega*time;
    const Four angles_0 = {motor_value, rod_theta, rod_theta, rod_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank = cosines_0[0];
    const double sin_theta_crank = sines_0[0];
    const double cos_theta_rod = cosines_0[1];
    const double sin_theta_rod = sines_0[1];
    const double motor_rate = omega;
    const double span_crank_head_x = cos_theta_crank*crank_head_span_x;
    const double span_crank_head_y = crank_head_span_x*sin_theta_crank;
    const double span_rod_head_x = cos_theta_rod*rod_head_span_x;
    const double span_rod_head_y = rod_head_span_x*sin_theta_rod;

    /* closures */
    const double phi_cylinder_offset = span_crank_head_y + span_rod_head_y;

    /* groups of rows that are solved one after the other */
    const double pivot_cylinder_offset = span_rod_head_x;
    const double size_cylinder_offset__rod_theta = fabs(span_rod_head_x) + fabs(span_rod_head_y);
    if (!(fabs(pivot_cylinder_offset) > 3.162277660168379e-07 * size_cylinder_offset__rod_theta)) return 1;
    const double inverse_cylinder_offset = 1.0/pivot_cylinder_offset;

    /* Newton's step */
    const double step_rod_theta = inverse_cylinder_offset*phi_cylinder_offset;

    /* rates */
    const double rate_rod_theta = -inverse_cylinder_offset*motor_rate*span_crank_head_x;

    /* results */
    step[0] = step_rod_theta;
    rates[0] = rate_rod_theta;
    *worst = 0.0;
    *worst = max_of(*worst, fabs(phi_cylinder_offset));
    return 0;
}

/*
 * Accelerations a of the tree's coordinates q with rates v, and with them the motion of all bodies:
 * all_q, all_v, all_a (N_Q). `worst`: the largest |Phi_q v - nu|.
 * Returns 0, or the number of a row that depends on others here; all_q and all_v are known also then.
 */
static int arrive(const double t, const double *q, const double *v, const Parameters *p, double *a,
    double *all_q, double *all_v, double *all_a, double *worst)
{
    /* coordinates, velocities, time */
    const double time = t;
    const double rod_theta = q[0];
    const double rod_omega = v[0];

    /* parameters */
    const double omega = p->omega;
    const double crank_head_x = p->crank_head_x;
    const double rod_head_x = p->rod_head_x;
    const double crank_head_span_x = p->crank_head_span_x;
    const double rod_head_span_x = p->rod_head_span_x;

    /* directions, arms, drives */
    const double motor_value = omega*time;
    const Four angles_0 = {motor_value, rod_theta, rod_theta, rod_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const double cos_theta_crank = cosines_0[0];
    const double sin_theta_crank = sines_0[0];
    const double cos_theta_rod = cosines_0[1];
    const double sin_theta_rod = sines_0[1];
    const double motor_rate = omega;
    const double motor_acceleration = 0.0;
    const double span_crank_com_x = cos_theta_crank*crank_head_x;
    const double span_crank_com_y = crank_head_x*sin_theta_crank;
    const double crank_vx = -motor_rate*span_crank_com_y;
    const double crank_vy = motor_rate*span_crank_com_x;
    const double span_crank_head_x = cos_theta_crank*crank_head_span_x;
    const double span_crank_head_y = crank_head_span_x*sin_theta_crank;
    const double crank_head_vx = -motor_rate*span_crank_head_y;
    const double crank_head_vy = motor_rate*span_crank_head_x;
    const double span_rod_com_x = cos_theta_rod*rod_head_x;
    const double span_rod_com_y = rod_head_x*sin_theta_rod;
    const double rod_x = span_crank_head_x + span_rod_com_x;
    const double rod_vx = crank_head_vx - rod_omega*span_rod_com_y;
    const double rod_y = span_crank_head_y + span_rod_com_y;
    const double rod_vy = crank_head_vy + rod_omega*span_rod_com_x;
    const double span_rod_head_x = cos_theta_rod*rod_head_span_x;
    const double span_rod_head_y = rod_head_span_x*sin_theta_rod;
    const double rod_head_x_2 = span_crank_head_x + span_rod_head_x;
    const double rod_head_vx = crank_head_vx - rod_omega*span_rod_head_y;
    const double rod_head_y = span_crank_head_y + span_rod_head_y;
    const double rod_head_vy = crank_head_vy + rod_omega*span_rod_head_x;
    const double slider_theta = 0.0;
    const double slider_omega = 0.0;

    /* positions and velocities of the bodies */
    all_q[0] = span_crank_com_x;
    all_v[0] = crank_vx;
    all_q[1] = span_crank_com_y;
    all_v[1] = crank_vy;
    all_q[2] = motor_value;
    all_v[2] = motor_rate;
    all_q[3] = rod_x;
    all_v[3] = rod_vx;
    all_q[4] = rod_y;
    all_v[4] = rod_vy;
    all_q[5] = rod_theta;
    all_v[5] = rod_omega;
    all_q[6] = rod_head_x_2;
    all_v[6] = rod_head_vx;
    all_q[7] = rod_head_y;
    all_v[7] = rod_head_vy;
    all_q[8] = slider_theta;
    all_v[8] = slider_omega;

    /* rates of the closures */
    const double phi_dot_cylinder_offset = motor_rate*span_crank_head_x + rod_omega*span_rod_head_x;
    *worst = 0.0;
    *worst = max_of(*worst, fabs(phi_dot_cylinder_offset));

    /* groups of rows that are solved one after the other */
    const double pivot_cylinder_offset_2 = span_rod_head_x;
    const double size_cylinder_offset__rod_theta_2 = fabs(span_rod_head_x) + fabs(span_rod_head_y);
    if (!(fabs(pivot_cylinder_offset_2) > 3.162277660168379e-07 * size_cylinder_offset__rod_theta_2)) return 1;
    const double inverse_cylinder_offset_2 = 1.0/pivot_cylinder_offset_2;

    /* accelerations */
    const double second_rod_theta = inverse_cylinder_offset_2*(-motor_acceleration*span_crank_head_x +
        (motor_rate * motor_rate)*span_crank_head_y + (rod_omega * rod_omega)*span_rod_head_y);
    a[0] = second_rod_theta;
    all_a[0] = -motor_acceleration*span_crank_com_y - (motor_rate * motor_rate)*span_crank_com_x;
    all_a[1] = motor_acceleration*span_crank_com_x - (motor_rate * motor_rate)*span_crank_com_y;
    all_a[2] = motor_acceleration;
    all_a[3] = -motor_acceleration*span_crank_head_y - (motor_rate * motor_rate)*span_crank_head_x -
        (rod_omega * rod_omega)*span_rod_com_x - second_rod_theta*span_rod_com_y;
    all_a[4] = motor_acceleration*span_crank_head_x - (motor_rate * motor_rate)*span_crank_head_y - (rod_omega
        * rod_omega)*span_rod_com_y + second_rod_theta*span_rod_com_x;
    all_a[5] = second_rod_theta;
    all_a[6] = -motor_acceleration*span_crank_head_y - (motor_rate * motor_rate)*span_crank_head_x -
        (rod_omega * rod_omega)*span_rod_head_x - second_rod_theta*span_rod_head_y;
    all_a[7] = motor_acceleration*span_crank_head_x - (motor_rate * motor_rate)*span_crank_head_y - (rod_omega
        * rod_omega)*span_rod_head_y + second_rod_theta*span_rod_head_x;
    all_a[8] = 0.0;
    return 0;
}

static const unsigned char is_angle[] = {1};

/* Powers, and accelerations of the tree. A status counts on behind the closures: it is that of the rescue, `dynamics`. */
static int solve_motion(const Parameters *p, const Place *here, double *a, Aside *aside)
{
    const int status = reduced_dynamics(here->t, here->s, here->s_rate, &(Memory){.asked = here->asked}, p, a, aside);
    return status > 0 ? N_LOOPS + status : status;
}

/*
 * Newton on the closures until the step is rounding or no longer shrinks; the rates belong to the positions. Steps
 * are measured in rad, slides as shares of the mechanism's size; `moved` is the way from the first guess.
 */
static int close_linkage(double t, const Parameters *p, double extent, Place *at, double *moved)
{
    double step[N_X + 1], before = INFINITY;
    for (int i = 0; i < MAX_NEWTON; i++) {
        double size = 0.0;
        const int status = close_step(t, at->s, p, step, at->s_rate, &at->phi);
        if (status)
            return status;
        for (int k = 0; k < N_X; k++)
            size = larger(size, fabs(step[k]) / (is_angle[k] ? 1.0 : extent));
        if (isnan(size))
            return NEWTON_FAILED;
        if (size < 4e-15 || (size < 1e-9 && size >= 0.5 * before))
            return 0;
        for (int k = 0; k < N_X; k++)
            at->s[k] -= step[k];
        *moved += size;
        before = size;
    }
    return before < 1e-9 ? 0 : NEWTON_FAILED;
}

/* From one place to another near by: first guess s + h s' + h^2 s''/2. */
static int place_at(double t, const Parameters *p, double extent, const Place *from, Place *to, double *moved)
{
    const double h = t - from->t;
    *moved = 0.0;
    to->asked = from->asked;
    to->t = t;
    for (int k = 0; k < N_X; k++)
        to->s[k] = from->s[k] + h * (from->s_rate[k] + 0.5 * h * from->s_second[k]);
    const int status = close_linkage(t, p, extent, to, moved);
    return status ? status : arrive(t, to->s, to->s_rate, p, to->s_second, to->q, to->v, to->a, &to->phi_dot);
}

/* A place has all that a sample needs. */
static int settle(const Parameters *p, Place *here)
{
    (void)p;
    (void)here;
    return 0;
}

/* A given position; where closures depend on each other the equations of motion may still tell its accelerations. */
static int begin(double t, const double *q, const double *v, const Parameters *p, Place *here)
{
    double step[N_X + 1], rates[N_X + 1];
    here->t = t;
    reduce_state(t, q, v, p, here->s, here->s_rate);
    if (!close_step(t, here->s, p, step, rates, &here->phi)
        && !arrive(t, here->s, here->s_rate, p, here->s_second, here->q, here->v, here->a, &here->phi_dot))
        return 0;
    Aside aside;
    for (int k = 0; k < N_Q; k++) {
        here->q[k] = q[k];
        here->v[k] = v[k];
    }
    for (int k = 0; k < N_X; k++)
        here->s_second[k] = 0.0;
    here->phi = here->phi_dot = 0.0;
    const int status = dynamics(t, q, v, &(Memory){.asked = here->asked}, p, here->a, &aside);
    return status > 0 ? N_LOOPS + status : status;
}

/* What the trapezoidal rule leaves over between two places: the angle that it is worth (rad), lengths by the size. */
static double bend_between(const Place *a, const Place *b, double extent)
{
    const double half = 0.5 * (b->t - a->t), share = 1.0 / extent;
    double lengths = 0.0, angles = 0.0;
    for (int k = 0; k < N_Q; k += 3) {
        for (int c = k; c < k + 2; c++)
            lengths = larger(lengths, fabs(b->q[c] - a->q[c] - half * (a->v[c] + b->v[c])));
        angles = larger(angles, fabs(b->q[k + 2] - a->q[k + 2] - half * (a->v[k + 2] + b->v[k + 2])));
    }
    return larger(angles, lengths * share);
}

static int hides_a_pulse(double t0, double t1, const Parameters *p)
{
    (void)t0, (void)t1, (void)p;
    return 0;
}

/*
 * One step along the same branch, to t1 at the furthest. Where Newton moves the first guess by more than the reach,
 * or the way bends more than its velocities say, the step is halved: another branch passes near dead centres as a
 * jump of positions that no velocity explains.
 */
static int step_on(Stride *stride, double t1, const Parameters *p, Place *here)
{
    const double straight = 0.002 * stride->reach;
    for (;;) {
        Place there;
        double moved = 0.0, bent = 0.0;
        if (given_up(here->asked))
            return STOPPED;
        const double next = here->t + stride->h < t1 ? here->t + stride->h : t1;
        const int status = next > here->t ? place_at(next, p, stride->extent, here, &there, &moved) : NEWTON_FAILED;
        if (status == STOPPED)
            return status;
        const int near = !status && moved <= stride->reach;
        if (near)
            bent = bend_between(here, &there, stride->extent);
        if (near && bent <= straight && (stride->halvings > PULSE_HALVINGS || !hides_a_pulse(here->t, next, p))) {
            *here = there;
            if (stride->halvings > 0 && bent < 0.1 * straight) { /* it grows with h cubed */
                stride->h *= 2.0;
                stride->halvings--;
            }
            return 0;
        }
        if (++stride->halvings > MAX_HALVINGS || !(next > here->t))
            return status ? status : NEWTON_FAILED;
        stride->h *= 0.5;
    }
}

/* To t1, in steps; a run whose pace is watched. */
static int advance(Course *course, double t1, const Parameters *p, Place *here, long *steps)
{
    Stride stride = {course->reach, course->extent, t1 - here->t, 0};
    while (here->t < t1) {
        const int status = step_on(&stride, t1, p, here);
        if (status)
            return status;
        ++*steps;
        if (creeps(&course->pace, here->t, course->t_end))
            return STALLED;
    }
    return settle(p, here);
}

/*
 * n samples at the given times; q, v and a have n + 1 rows, the first of q and v holds what is known at t[0]: the
 * start, or where the last call came to. `done` is the last row that is complete, whatever is returned.
 */
int gudgeon_kinematic(void *memory, long n, const double *t, const double *parameters, double *q, double *v, double *a,
    double *phi_max, double *phi_dot_max, long *steps, long *done)
{
    Course *course = memory;
    const Parameters *p = (const Parameters *)parameters;
    Place *here = &course->motion;
    *done = 0;
    for (long i = course->motion_begun; i <= n; i++) {
        here->asked = &course->asked;
        const int status = i > 0 ? advance(course, t[i], p, here, steps) : begin(t[0], q, v, p, here);
        if (status)
            return status;
        course->motion_begun = 1;
        for (int k = 0; k < N_Q; k++) {
            if (i > 0) {
                q[i * N_Q + k] = here->q[k];
                v[i * N_Q + k] = here->v[k];
            }
            a[i * N_Q + k] = here->a[k];
        }
        *phi_max = max_of(here->phi, *phi_max);
        *phi_dot_max = max_of(here->phi_dot, *phi_dot_max);
        *done = i;
    }
    return 0;
}

/* Powers at a place, and the accelerations of all bodies; a status as that of settle. */
static int powers(const Parameters *p, Place *here, double *power)
{
    Aside aside;
    double a[N_X + 1];
    const int status = solve_motion(p, here, a, &aside);
    for (int k = 0; k < N_WORK; k++)
        power[k] = aside.power[k];
    return status;
}

/* A rate, as the angle that it is worth: lengths as shares of the mechanism's size. */
static double turn(const double *v, int k, double extent) { return k % 3 == 2 ? fabs(v[k]) : fabs(v[k]) / extent; }

/*
 * Works between two places that are one step apart: quadrature of Gauss and Legendre with three nodes. `jumped`: the
 * velocities change by more than the accelerations on the way say, so that the rate of a drive jumps, or nearly so.
 * NO_NUMBER where a power is none, at `work[0]`.
 */
static int work_between(const Parameters *p, double extent, const Place *a, const Place *b, double least, double *work,
    int *jumped)
{
    static const double node[] = {-0.7745966692414834, 0.0, 0.7745966692414834};
    static const double weight[] = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
    const double half = 0.5 * (b->t - a->t);
    double missed[N_Q], most = 0.0, scale = 0.0;
    for (int k = 0; k < N_Q; k++)
        missed[k] = b->v[k] - a->v[k];
    for (int i = 0; i < 3; i++) {
        Place at;
        double power[N_WORK], moved;
        int status = place_at(a->t + half * (1.0 + node[i]), p, extent, a, &at, &moved);
        if (!status)
            status = powers(p, &at, power);
        if (status)
            return status;
        for (int k = 0; k < N_WORK; k++) {
            if (!isfinite(power[k])) {
                work[0] = at.t;
                return NO_NUMBER;
            }
            work[k] += half * weight[i] * power[k];
        }
        for (int k = 0; k < N_Q; k++) {
            missed[k] -= half * weight[i] * at.a[k];
            scale = larger(scale, half * turn(at.a, k, extent));
        }
    }
    for (int k = 0; k < N_Q; k++)
        most = larger(most, turn(missed, k, extent));
    /* or an acceleration is none: a rate of no bounded slope */
    *jumped = !(scale <= DBL_MAX) || (most > least && most > 1e-6 * scale);
    return 0;
}

/* Of all bodies, J. */
static double kinetic_energy_at(const Parameters *p, const Place *at)
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
static int work_across(const Parameters *p, double extent, const Place *a, const Place *b, double least, int *halvings,
    double *work)
{
    double part[N_WORK] = {0.0}, moved;
    int jumped = 0;
    int status = work_between(p, extent, a, b, least, part, &jumped);
    const double t = a->t + 0.5 * (b->t - a->t);
    if (status == NO_NUMBER)
        work[0] = part[0];
    if (status)
        return status;
    const int wide = t > a->t && t < b->t;
    if (jumped && wide && *halvings > 0) {
        Place middle;
        --*halvings;
        status = place_at(t, p, extent, a, &middle, &moved);
        if (!status)
            status = work_across(p, extent, a, &middle, least, halvings, work);
        return status ? status : work_across(p, extent, &middle, b, least, halvings, work);
    }
    if (jumped && !wide)
        part[0] = kinetic_energy_at(p, b) - kinetic_energy_at(p, a);
    if (!isfinite(part[0])) {
        work[0] = t;
        return NO_NUMBER;
    }
    for (int k = 0; k < N_WORK; k++)
        work[k] += part[k];
    return 0;
}

/* Of one step; speeds that change by less than a billionth of what they are do not jump. */
static int work_of_step(const Parameters *p, double extent, const Place *a, const Place *b, double *work)
{
    int halvings = MAX_SPLITS;
    double speed = 0.0;
    for (int k = 0; k < N_Q; k++)
        speed = larger(speed, larger(turn(a->v, k, extent), turn(b->v, k, extent)));
    return work_across(p, extent, a, b, 1e-12 + 1e-9 * speed, &halvings, work);
}

/* Works from the first of n + 1 samples on, (n + 1) x N_WORK, of which the first row is given. */
int gudgeon_kinematic_works(void *memory, long n, const double *t, const double *parameters, const double *q,
    const double *v, double *work, long *done)
{
    Course *course = memory;
    const double extent = course->extent;
    const Parameters *p = (const Parameters *)parameters;
    Place here = course->work;
    here.asked = &course->asked;
    *done = 0;
    int status = course->work_begun ? 0 : begin(t[0], q, v, p, &here);
    for (long i = 0; i < n && !status; i++) {
        Stride stride = {course->reach, extent, t[i + 1] - t[i], 0};
        double *sum = work + (i + 1) * N_WORK;
        for (int k = 0; k < N_WORK; k++)
            sum[k] = work[i * N_WORK + k];
        while (here.t < t[i + 1] && !status) {
            const Place before = here;
            status = step_on(&stride, t[i + 1], p, &here);
            if (!status)
                status = work_of_step(p, extent, &before, &here, sum);
        }
        *done = i + !status;
    }
    course->work = here;
    course->work_begun = 1;
    if (status == NO_NUMBER)
        course->work.t = work[(*done + 1) * N_WORK];
    return status;
}
