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
static int place_beside(
    double t, double *y, DiscreteState *discrete, const Parameters *p, double far, double *dy, RhsOutputs *rhs)
{
    double moved = 0.0, before = INFINITY;
    for (int pass = 0; pass < 6; pass++) {
        double dq[N_X], dv[N_X], worst, step = 0.0;
        const int status = closing_here(t, y, discrete, p, dq, dv, &worst);
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
            return motion_here(t, y, discrete, p, dy, rhs);
        before = worst;
    }
    return LOST;
}

/* What is continued: the closed state, its rates, multipliers. */
typedef struct {
    double y[2 * N_X], dy[N_Y], lower[N_X], lambda[AT_LEAST_ONE(N_LOOPS)];
} Continued;

static void add_place(int k, const double *y, const double *dy, const RhsOutputs *rhs, Continued *sum)
{
    const double weight = weight_at(SIDE_NODES, k), lower = k < SIDE_NODES ? weight_at(SIDE_NODES - 1, k) : 0.0;
    for (int i = 0; i < 2 * N_X; i++)
        sum->y[i] += weight * y[i];
    for (int i = 0; i < N_Y; i++)
        sum->dy[i] += weight * dy[i];
    for (int i = 0; i < N_X; i++)
        sum->lower[i] += lower * dy[N_X + i];
    for (int i = 0; i < N_LOOPS; i++)
        sum->lambda[i] += weight * rhs->lambda[i];
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
static int continue_here(double t, const double *y, const DiscreteState *discrete, const Parameters *p, Continued *sum)
{
    double fastest = 0.0;
    for (int k = 0; k < N_X; k++)
        fastest = is_angle[k] ? max_of(fastest, fabs(y[N_X + k])) : fastest;
    if (!(fastest > 0.0 && fastest < INFINITY))
        return 0;
    for (int pass = -WIDE; pass < WIDER; pass++) {
        const double turn = pass < 0 ? WIDE_TURN * ldexp(1.0, -WIDE - pass) : NODE_TURN * ldexp(1.0, pass);
        int status = discrete->token && poll_cancellation(discrete->token) ? STOPPED : 0;
        *sum = (Continued){0};
        for (int k = 1; k <= SIDE_NODES && !status; k++)
            for (int branch = -1; branch <= 1 && !status; branch += 2) {
                const double h = branch * k * turn / fastest;
                double there[N_Y], dy[N_Y];
                DiscreteState now = *discrete;
                RhsOutputs rhs;
                for (int i = 0; i < N_Y; i++)
                    there[i] = y[i] + (i < N_X ? h * y[N_X + i] : 0.0);
                status = place_beside(t + (N_DRIVES ? h : 0.0), there, &now, p, 0.5 * k * turn, dy, &rhs);
                add_place(k, there, dy, &rhs, sum);
            }
        if (!status && agrees(y, sum, pass < 0 ? WIDE_TO : CONTINUED_TO))
            return 1;
        if (status == STOPPED)
            return 0;
    }
    return 0;
}

/* As the memory is, where no more is asked of pivots than that they can be divided by. */
static DiscreteState with_usual_shares(const DiscreteState *discrete)
{
    DiscreteState now = *discrete;
    now.least = NEARLY_SINGULAR;
    now.least_size = VANISHING;
    return now;
}

/* What is integrated, with what was found on the closed linkage or continued from beside it. */
static int handed_over(const double *y, const Continued *at, double *dy, RhsOutputs *rhs)
{
    for (int k = 0; k < N_X; k++) {
        dy[k] = y[N_X + k];
        dy[N_X + k] = at->dy[N_X + k];
    }
    for (int k = 0; k < N_WORK; k++)
        dy[2 * N_X + k] = rhs->power[k] = at->dy[2 * N_X + k];
    for (int k = 0; k < N_LOOPS; k++)
        rhs->lambda[k] = at->lambda[k];
    return 0;
}

int motion(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dy, RhsOutputs *rhs)
{
    Continued at;
    if (discrete->singular_policy == SINGULAR_PROJECT || discrete->singular_policy == SINGULAR_PROJECT_OR_IGNORE) {
        double there[N_Y];
        memcpy(there, y, sizeof there);
        if (!place_beside(t, there, discrete, p, LARGEST_WAY, dy, rhs)) {
            for (int k = 0; k < N_X; k++)
                dy[k] = y[N_X + k];
            return 0;
        }
    }
    const int status = motion_here(t, y, discrete, p, dy, rhs);
    const int open = discrete->singular_policy == SINGULAR_PROJECT
        || discrete->singular_policy == SINGULAR_PROJECT_OR_IGNORE; /* near enough that it cannot be closed */
    if (discrete->singular_policy == SINGULAR_DETECT || (status != NEAR && (status || !open)))
        return status;
    if (continue_here(t, y, discrete, p, &at))
        return handed_over(y, &at, dy, rhs);
    if (discrete->singular_policy == SINGULAR_PROJECT)
        return NEAR;
    DiscreteState now = with_usual_shares(discrete);
    return motion_here(t, y, &now, p, dy, rhs);
}

int closing_of_state(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dq, double *dv,
    double *worst)
{
    int status = closing_here(t, y, discrete, p, dq, dv, worst);
    if (!status || discrete->singular_policy == SINGULAR_IGNORE || discrete->singular_policy == SINGULAR_DETECT)
        return status;
    double dy[N_Y];
    RhsOutputs rhs;
    Continued at;
    DiscreteState now = *discrete;
    if (motion_here(t, y, &now, p, dy, &rhs) != NEAR || !continue_here(t, y, discrete, p, &at)) {
        now = with_usual_shares(discrete);
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
int motion(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dy, RhsOutputs *rhs)
{
    return motion_here(t, y, discrete, p, dy, rhs);
}

int closing_of_state(double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dq, double *dv,
    double *worst)
{
    return closing_here(t, y, discrete, p, dq, dv, worst);
}
#endif
