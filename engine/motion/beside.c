/*
 * At a singular position rows depend on each other for a moment: forces are unbounded there, and beside it rounding of
 * positions and velocities is blown up by the inverse of the distance, squared in the accelerations. The motion itself
 * goes through smoothly, on the branch on which it came. So near by it is continued from both sides: what is wanted is
 * a smooth function along the linkage's way through the state, known at places on either side where all is regular,
 * and a polynomial through these tells it here. As sparse as everywhere else, and without the rounding.
 */
#if CONTINUES
#include <string.h>

enum { SIDE_NODES = TREE ? 5 : 6, WIDE = 2, WIDER = 4 };
#define LARGEST_WAY 0.1 /* rad, of a stage back onto the constraints */
#define NODE_TURN (TREE ? 1e-2 : 2e-2) /* rad, of the fastest angle, between places; then twice that, and so on */
#define CONTINUED_TO 1e-7 /* share of the accelerations by which the last two polynomials may differ */
#define WIDE_TURN 4e-2 /* the same where the motion is as smooth as that: rounding of far places is blown up less */
#define WIDE_TO 1e-10

/* A place on the way: closed, its right-hand side. 0, or why it is none; `far`: the longest way to there. */
static int place_beside(double t, double *y, Memory *memory, const Parameters *p, double far, double *dy, Aside *aside)
{
    double moved = 0.0, before = INFINITY;
    for (int pass = 0; pass < 6; pass++) {
        double dq[N_X], dv[N_X], worst, step = 0.0;
        const int status = closing_here(t, y, memory, p, dq, dv, &worst);
        if (status)
            return status;
        for (int k = 0; k < N_X; k++) {
            y[k] -= dq[k];
            y[N_X + k] -= dv[k];
            step = is_angle[k] ? max_of(step, fabs(dq[k])) : step;
        }
        moved += step;
        if (!(moved <= far))
            return LOST;
        if (worst < 1e-15 || (worst < 1e-12 && worst > 0.5 * before))
            return motion_here(t, y, memory, p, dy, aside);
        before = worst;
    }
    return LOST;
}

/* What is continued: the closed state, its rates, multipliers. */
typedef struct {
    double y[2 * N_X], dy[N_Y], lower[N_X], lambda[AT_LEAST_ONE(N_LOOPS)];
} Continued;

static void add_place(int k, const double *y, const double *dy, const Aside *aside, Continued *sum)
{
    const double weight = weight_at(SIDE_NODES, k), lower = k < SIDE_NODES ? weight_at(SIDE_NODES - 1, k) : 0.0;
    for (int i = 0; i < 2 * N_X; i++)
        sum->y[i] += weight * y[i];
    for (int i = 0; i < N_Y; i++)
        sum->dy[i] += weight * dy[i];
    for (int i = 0; i < N_X; i++)
        sum->lower[i] += lower * dy[N_X + i];
    for (int i = 0; i < N_LOOPS; i++)
        sum->lambda[i] += weight * aside->lambda[i];
}

/* Whether the polynomials of the last two degrees agree. */
static int agrees(const double *y, const Continued *sum, double to)
{
    double most[2] = {0.0, 0.0}, apart[2] = {0.0, 0.0};
    for (int k = 0; k < N_X; k++) {
        const int kind = is_angle[k];
        const double a = sum->dy[N_X + k], v = y[N_X + k];
        most[kind] = max_of(most[kind], fabs(a) + (kind ? v * v : 0.0));
        apart[kind] = max_of(apart[kind], fabs(a - sum->lower[k]));
    }
    return apart[0] <= to * most[0] && apart[1] <= to * most[1];
}

/* The motion at a state beside a singular position, from both sides. Whether it can be had. */
static int continue_here(double t, const double *y, const Memory *memory, const Parameters *p, Continued *sum)
{
    double fastest = 0.0;
    for (int k = 0; k < N_X; k++)
        fastest = is_angle[k] ? max_of(fastest, fabs(y[N_X + k])) : fastest;
    if (!(fastest > 0.0 && fastest < INFINITY))
        return 0;
    for (int pass = -WIDE; pass < WIDER; pass++) {
        const double turn = pass < 0 ? WIDE_TURN * ldexp(1.0, -WIDE - pass) : NODE_TURN * ldexp(1.0, pass);
        int status = memory->asked && ask_now(memory->asked) ? STOPPED : 0;
        *sum = (Continued){0};
        for (int k = 1; k <= SIDE_NODES && !status; k++)
            for (int side = -1; side <= 1 && !status; side += 2) {
                const double h = side * k * turn / fastest;
                double there[N_Y], dy[N_Y];
                Memory now = *memory;
                Aside aside;
                for (int i = 0; i < N_Y; i++)
                    there[i] = y[i] + (i < N_X ? h * y[N_X + i] : 0.0);
                status = place_beside(t + (N_DRIVES ? h : 0.0), there, &now, p, 0.5 * k * turn, dy, &aside);
                add_place(k, there, dy, &aside, sum);
            }
        if (!status && agrees(y, sum, pass < 0 ? WIDE_TO : CONTINUED_TO))
            return 1;
        if (status == STOPPED)
            return 0;
    }
    return 0;
}

/* As the memory is, where no more is asked of pivots than that they can be divided by. */
static Memory with_usual_shares(const Memory *memory)
{
    Memory now = *memory;
    now.least = NEARLY_SINGULAR;
    now.least_size = VANISHING;
    return now;
}

/* What is integrated, with what was found on the closed linkage or continued from beside it. */
static int handed_over(const double *y, const Continued *at, double *dy, Aside *aside)
{
    for (int k = 0; k < N_X; k++) {
        dy[k] = y[N_X + k];
        dy[N_X + k] = at->dy[N_X + k];
    }
    for (int k = 0; k < N_WORK; k++)
        dy[2 * N_X + k] = aside->power[k] = at->dy[2 * N_X + k];
    for (int k = 0; k < N_LOOPS; k++)
        aside->lambda[k] = at->lambda[k];
    return 0;
}

int motion(double t, const double *y, Memory *memory, const Parameters *p, double *dy, Aside *aside)
{
    Continued at;
    if (memory->way == CLOSES || memory->way == CLOSED) {
        double there[N_Y];
        memcpy(there, y, sizeof there);
        if (!place_beside(t, there, memory, p, LARGEST_WAY, dy, aside)) {
            for (int k = 0; k < N_X; k++)
                dy[k] = y[N_X + k];
            return 0;
        }
    }
    const int status = motion_here(t, y, memory, p, dy, aside);
    const int open = memory->way == CLOSES || memory->way == CLOSED; /* near enough that it cannot be closed */
    if (memory->way == TELLS || (status != NEAR && (status || !open)))
        return status;
    if (continue_here(t, y, memory, p, &at))
        return handed_over(y, &at, dy, aside);
    if (memory->way == CLOSES)
        return NEAR;
    Memory now = with_usual_shares(memory);
    return motion_here(t, y, &now, p, dy, aside);
}

int closing_of_state(double t, const double *y, Memory *memory, const Parameters *p, double *dq, double *dv,
    double *worst)
{
    int status = closing_here(t, y, memory, p, dq, dv, worst);
    if (!status || memory->way == AS_EVER || memory->way == TELLS)
        return status;
    double dy[N_Y];
    Aside aside;
    Continued at;
    Memory now = *memory;
    if (motion_here(t, y, &now, p, dy, &aside) != NEAR || !continue_here(t, y, memory, p, &at)) {
        now = with_usual_shares(memory);
        return closing_here(t, y, &now, p, dq, dv, worst);
    }
    for (int k = 0; k < N_X; k++) {
        dq[k] = y[k] - at.y[k];
        dv[k] = y[N_X + k] - at.y[N_X + k];
    }
    *worst = 0.0; /* once is enough */
    return 0;
}

#else
/* No rows are dependent for a moment, or what is held changes: the motion as it is computed at a state itself. */
int motion(double t, const double *y, Memory *memory, const Parameters *p, double *dy, Aside *aside)
{
    return motion_here(t, y, memory, p, dy, aside);
}

int closing_of_state(double t, const double *y, Memory *memory, const Parameters *p, double *dq, double *dv,
    double *worst)
{
    return closing_here(t, y, memory, p, dq, dv, worst);
}
#endif
