/*
 * The uncertainty of event functions along a kinematic motion: by how much rounding moves them. A function that is
 * smaller has no sign. run/uncertainty.c has the same for motions that are integrated.
 */
#define ROUNDINGS 1024.0 /* ulp: rounding errors of the positions and velocities that Newton's method finds */
#define LEFT 16.0        /* steps of Newton's method, as it has left them, that positions may be wrong by */
#define AS_SEEN 16.0     /* times the differences that are seen, where rounding in a function may be all of them */

/* A place on the way with the values of what is watched. */
typedef struct {
    Place at;
    double event[N_USER_EVENTS];
} View;

static void look(const Parameters *p, View *view)
{
    Aside aside = {0};
    double a[N_Q];
    (void)solve_motion(p, &view->at, a, &aside); /* told before, where it cannot be solved */
    for (int i = 0; i < N_USER_EVENTS; i++)
        view->event[i] = aside.event[i];
}

#if POSITIONS_IN_TREE
enum { N_PLACE = N_X };
#define positions_of(place) ((place)->s)
#define rates_of(place) ((place)->s_rate)
#define is_turn(k) is_angle[k]

/* The step that Newton's method has left; rates that belong to the positions as they are. */
static int newton_step(Place *at, const Parameters *p, double *step)
{
    return close_step(beyond_jump(at->t), at->s, p, step, at->s_rate, &at->phi);
}
#else
enum { N_PLACE = N_Q };
#define positions_of(place) ((place)->q)
#define rates_of(place) ((place)->v)
#define is_turn(k) ((k) % 3 == 2)

static int newton_step(Place *at, const Parameters *p, double *step)
{
    double phi[AT_LEAST_ONE(N_ALL_ROWS)];
    constraints(beyond_jump(at->t), at->q, p, phi);
    const int status = project(beyond_jump(at->t), at->q, phi, p, step);
    return status ? status : velocities(beyond_jump(at->t), at->q, p, at->v);
}
#endif

/* The largest speeds, of lengths and of angles, each at least what the other one is at the size of the linkage. */
static void speeds_of(const Place *at, double extent, double *speed)
{
    speed[0] = speed[1] = 0.0;
    for (int k = 0; k < N_PLACE; k++)
        speed[is_turn(k)] = max_of(speed[is_turn(k)], fabs(rates_of(at)[k]));
    speed[0] = max_of(speed[0], extent * speed[1]);
    speed[1] = max_of(speed[1], speed[0] / extent);
}

/*
 * A place at positions that are wrong by so many ulp, by signs of a mask, with the velocities that belong to them.
 * Newton's last step tells of positions near a singular one, where rounding counts for more.
 */
static void disturb(const Place *here, double ulps, int mask, double extent, const Parameters *p, Place *other)
{
    double step[N_PLACE + 1], *q = positions_of(other);
    *other = *here;
    const int open = !newton_step(other, p, step);
    for (int k = 0; k < N_PLACE; k++) {
        const double size = ulps * DBL_EPSILON * max_of(is_turn(k) ? 1.0 : extent, fabs(q[k]));
        q[k] += (k & mask ? -1.0 : 1.0) * (size + (open && isfinite(step[k]) ? LEFT * fabs(step[k]) : 0.0));
    }
    if (newton_step(other, p, step))
        memcpy(rates_of(other), rates_of(here), N_PLACE * sizeof *q);
}

/*
 * By how much rounding errors of positions and velocities change each event function; 0 where they lead to a
 * pole. Some signs are tried, of neighbours the same and others.
 */
#if KNOWN_BOUNDS
static void uncertainty(const View *here, double extent, const Parameters *p, double *out)
{
    double of_q[N_Q] = {0.0}, of_v[N_Q] = {0.0}, speed[2];
    Range q[N_Q], v[N_Q], f[N_WATCHED];
    const double rounded = 4.0 * DBL_EPSILON * fabs(here->at.t);
    for (int mask = 0; mask < 8; mask = mask ? 2 * mask : 1) {
        Place other;
        disturb(&here->at, ROUNDINGS, mask, extent, p, &other);
#if POSITIONS_IN_TREE
        if (arrive(beyond_jump(other.t), other.s, other.s_rate, p, other.s_second, other.q, other.v, other.a,
                &other.phi))
            continue;
#endif
        for (int k = 0; k < N_Q; k++) {
            of_q[k] += fabs(other.q[k] - here->at.q[k]);
            of_v[k] += fabs(other.v[k] - here->at.v[k]);
        }
    }
    speeds_of(&here->at, extent, speed);
    for (int k = 0; k < N_Q; k++) {
        of_v[k] += ROUNDINGS * DBL_EPSILON * speed[k % 3 == 2];
        q[k] = (Range){here->at.q[k] - of_q[k], here->at.q[k] + of_q[k], 0.0, 0.0, 0};
        v[k] = (Range){here->at.v[k] - of_v[k], here->at.v[k] + of_v[k], 0.0, 0.0, 0};
    }
    watched_ranges((Range){here->at.t - rounded, here->at.t + rounded, 0.0, 0.0, 0}, q, v, &(Memory){0}, p, f);
    for (int i = 0; i < N_USER_EVENTS; i++) {
        const double width = f[N_WATCHED - N_USER_EVENTS + i].hi - f[N_WATCHED - N_USER_EVENTS + i].lo;
        out[i] = isfinite(width) ? 0.5 * width : 0.0;
    }
}
#else
static void uncertainty(const View *here, double extent, const Parameters *p, double *out)
{
    double speed[2];
    speeds_of(&here->at, extent, speed);
    for (int i = 0; i < N_USER_EVENTS; i++)
        out[i] = 0.0;
    for (int n = 0; n < 8; n++) {
        View other = *here;
        const int mask = (1 << n / 2) >> 1;
        if (n % 2)
            disturb(&here->at, ROUNDINGS / AS_SEEN, mask, extent, p, &other.at);
        for (int k = 0; k < N_PLACE && n % 2 == 0; k++)
            rates_of(&other.at)[k] += (k & mask ? -ROUNDINGS : ROUNDINGS) / AS_SEEN * DBL_EPSILON * speed[is_turn(k)];
        look(p, &other);
        for (int i = 0; i < N_USER_EVENTS; i++) {
            const double change = AS_SEEN * fabs(other.event[i] - here->event[i]);
            out[i] += isfinite(change) ? change : 0.0;
        }
    }
}
#endif

/* The value of event function i, last on `side`; 0 where it is below its uncertainty. */
static double resolved(const View *here, int i, int side, double extent, const Parameters *p)
{
    double error[N_USER_EVENTS];
    if (side * here->event[i] > 0.0)
        return here->event[i];
    uncertainty(here, extent, p, error);
    return fabs(here->event[i]) <= error[i] ? 0.0 : here->event[i];
}
