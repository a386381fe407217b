/*
 * Closing a linkage by Newton's method; each step is the smallest that closes the linearized constraint equations, as
 * in Python (closure.py). Returns 1 where equations depend on each other, or no step improves.
 */
#include "shortest_step.c"

#define HELD_FROM 1e-6 /* below this norm a factorization is reused while steps reduce the norm tenfold */
#define NO_MORE 1e-14  /* of the norm, times the distance of the linkage from the origin: rounding */

enum { MAX_CLOSING = 60 };

/* Compute the residuals w->rest: -Phi and the differences from the set coordinates, scaled. Returns their norm. */
static double open_rows(Closing *w, double t, const double *q, const Parameters *p)
{
    double sum = 0.0;
    constraints(t, q, p, w->rest);
    for (int k = 0; k < N_APART; k++)
        w->rest[apart_row[k]] += w->set[N_SET + k];
    for (int r = 0; r < N_ALL_ROWS; r++)
        w->rest[r] = -w->rest[r];
    for (int i = 0; i < N_SET; i++)
        w->rest[N_ALL_ROWS + i] = w->set[i] - q[set_place[i]];
    for (int r = 0; r < N_ALL_ROWS + N_SET; r++) {
        w->rest[r] *= w->over_row[r];
        sum += w->rest[r] * w->rest[r];
    }
    return sqrt(sum);
}

/*
 * Compute the linearized equations w->row (Phi_q and the set coordinates), scaled by sizes and weights, and the
 * residuals. Returns the norm of the residuals.
 */
SELDOM static double linearized_rows(Closing *w, double t, const double *q, const Parameters *p)
{
    jacobian(t, q, p, &w->row[0][0]);
    for (int r = 0; r < N_ALL_ROWS; r++)
        for (int e = phi_q_first[r]; e < phi_q_first[r + 1]; e++)
            w->row[r][phi_q_place[e]] *= w->over_row[r] * w->over_weight[phi_q_place[e]];
    for (int i = 0; i < N_SET; i++)
        w->row[N_ALL_ROWS + i][set_place[i]] = w->over_row[N_ALL_ROWS + i] * w->over_weight[set_place[i]];
    return open_rows(w, t, q, p);
}

/*
 * Solve for the angles that equations without lengths determine (drives, sliders). Returns 1 if these depend on each
 * other.
 */
SELDOM static int place_angles(Closing *w, double t, const Parameters *p, double *q)
{
    int place[N_Q];
    linearized_rows(w, t, q, p);
    w->some.n = 0;
    for (int r = 0; r < N_ALL_ROWS + N_SET; r++) {
        int places = 0;
        const int n = places_of(r, set_place, place);
        for (int i = 0; i < n; i++)
            places |= place[i] % 3 != 2 && w->row[r][place[i]] != 0.0;
        if (!places)
            w->some.row[w->some.n++] = (short)r;
    }
    find_meetings(w, &w->some, set_place);
    if (factor_rows(w, &w->some))
        return 1;
    step_of_rows(w, &w->some);
    for (int k = 0; k < N_Q; k++)
        q[k] += w->step[k] * w->over_weight[k];
    return 0;
}

/* Return the squared weighted distance of q from the guess. */
static double distance(const Closing *w, const double *q)
{
    double sum = 0.0;
    for (int k = 0; k < N_Q; k++)
        sum += (q[k] - w->placed[k]) * w->weight[k] * (q[k] - w->placed[k]) * w->weight[k];
    return sum;
}

/* Return whether a norm of residuals is rounding only. */
static int rows_closed(const Closing *w, double norm) { return norm < 1e-10 + NO_MORE * w->reach / w->size; }

/*
 * Return whether Newton's steps lead to a configuration that is not nearer to the guess than the nearest known one.
 * fraction_left: the fraction of the residuals that the last step left; the following steps are smaller by as much.
 */
static int is_no_nearer(const Closing *w, const double *q, double fraction_left)
{
    double step = 0.0, away = 0.0;
    for (int k = 0; k < N_Q; k++) {
        const double off = q[k] - w->placed[k], turns = k % 3 == 2 ? rint(off / (2.0 * PI)) : 0.0; /* see unwind() */
        const double weighed = (off - 2.0 * PI * turns) * w->weight[k];
        step += w->step[k] * w->step[k];
        away += weighed * weighed;
    }
    return fraction_left < 0.1 && sqrt(away) - 4.0 * fraction_left * sqrt(step) > sqrt(w->nearest);
}

/*
 * Solve the constraint equations by Newton's method with line search; the first step is for positions only. Equations
 * closed to rounding leave q unchanged to the bit. Returns 1 if they are not closed or lead to nothing nearer.
 */
SELDOM static int close_rows(Closing *w, double t, const Parameters *p, double *q)
{
    const double rounding = NO_MORE * w->reach / w->size;
    double other[N_Q];
    int held = 0; /* factorization and equations are those of an earlier q */
    if (!w->all.n)
        rows_together(w, &w->all, N_ALL_ROWS + N_SET, set_place);
    double norm = linearized_rows(w, t, q, p);
    if (norm < rounding)
        return factor_rows(w, &w->all);
    if (nearest_step(w))
        return 1;
    for (int k = 0; k < N_Q; k++)
        q[k] += w->step[k] * w->over_weight[k];
    norm = open_rows(w, t, q, p);
    for (int i = 0; i < MAX_CLOSING; i++) {
        if (!held) {
            linearized_rows(w, t, q, p);
            if (factor_rows(w, &w->all))
                return 1;
        }
        step_of_rows(w, &w->all);
        double fraction = 1.0, left = norm;
        for (; fraction > (held ? 0.5 : 1e-4); fraction *= 0.5) {
            for (int k = 0; k < N_Q; k++)
                other[k] = q[k] + fraction * (w->step[k] * w->over_weight[k]);
            left = open_rows(w, t, other, p);
            if (left < (1.0 - 1e-4 * fraction) * norm)
                break;
        }
        if (!(fraction > (held ? 0.5 : 1e-4))) {
            if (!held || norm < rounding)
                break;
            held = 0;
            continue;
        }
        for (int k = 0; k < N_Q; k++)
            q[k] = other[k];
        if (fraction == 1.0 && is_no_nearer(w, q, left / norm))
            return 1;
        held = left < HELD_FROM && (left < 0.1 * norm || left < rounding);
        norm = left;
    }
    return !rows_closed(w, norm);
}
