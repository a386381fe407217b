/*
 * Closing a linkage by Newton's steps, each the smallest that closes the linearized rows, as the runtime does it
 * (closure.py). Where rows depend on each other, or no step helps, 1 is returned.
 */
#include "../run/asked.h"
#include "calls.h"

#ifndef N_APART /* few starts say where journals are: Phi of these joints is -e, behind set, its rate behind rates */
#define N_APART 0
static const int apart_row[] = {0};
#endif

#define HELD_FROM 1e-6 /* below this norm a factor serves the next steps too, as long as they close a tenth */
#define NO_MORE 1e-14   /* of the norm, times how far from the origin the linkage is: rounding, mostly */

enum {
    N_START_ROWS = N_ALL_ROWS + (N_SET > N_RATES ? N_SET : N_RATES),
    N_NORMAL = N_START_ROWS > N_Q ? N_START_ROWS : N_Q, MAX_CLOSING = 60
};

/* Rows that are solved together, those of the normal matrix: which of them meet a coordinate, where its factor is not
 * 0. Of the first step coordinates take their place. */
typedef struct {
    int n;
    short row[N_NORMAL + 1], meets[N_Q][N_START_ROWS + 1], n_meets[N_Q];
    short filled[N_NORMAL + 1][N_NORMAL + 1], n_filled[N_NORMAL + 1];
} System;

/* Rows of the linearized system with what each must still give, columns over their weights; a normal matrix, its upper
 * half, and the reciprocals of its factor's diagonal. */
typedef struct {
    double size, reach, weight[N_Q], step[N_Q], placed[N_Q];
    double first[N_Q], beyond[N_Q], other[N_Q];
    double guess[N_GUESS + 1], set[N_SET + N_APART + 1], rates[N_RATES + N_APART + 1];
    double row[N_START_ROWS + 1][N_Q], rest[N_START_ROWS + 1], over_row[N_START_ROWS + 1], over_weight[N_Q];
    double normal[N_NORMAL + 1][N_NORMAL + 1], over_pivot[N_NORMAL + 1], right[N_NORMAL + 1];
    unsigned char has[N_NORMAL + 1][N_NORMAL + 1];
    System first_step, all, some;
    double nearest; /* what is as far as this from the guess, squared, is not looked for */
    int dependent;  /* rows that depend on others are left out: they close with them, or the rest says so */
    Asked *asked;
} Closing;

/* Where row r has something: a row of joints and drives meets a few coordinates of many, one of `set` its own. */
static int places_of(int r, const int *own, int *place)
{
    int n = 0;
    if (r >= N_ALL_ROWS)
        place[n++] = own[r - N_ALL_ROWS];
    else
        for (int e = phi_q_first[r]; e < phi_q_first[r + 1]; e++)
            place[n++] = phi_q_place[e];
    return n;
}

/* Where the factor of a normal matrix is not 0, from where the matrix is not: `has`, above its diagonal. */
static void fill(Closing *w, System *of)
{
    for (int k = 0; k < of->n; k++) {
        short *place = of->filled[k];
        int many = 0;
        for (int i = k + 1; i < of->n; i++)
            if (w->has[k][i])
                place[many++] = (short)i;
        of->n_filled[k] = (short)many;
        for (int a = 0; a < many; a++)
            for (int b = a + 1; b < many; b++)
                w->has[place[a]][place[b]] = 1;
    }
}

static void clear_pattern(Closing *w, int n)
{
    for (int i = 0; i < n; i++)
        for (int j = i; j < n; j++)
            w->has[i][j] = 0;
}

/* Which rows meet where: only those with a coordinate in common have a product. `own`: of the rows behind all. */
static void find_meetings(Closing *w, System *of, const int *own)
{
    int place[N_Q];
    for (int k = 0; k < N_Q; k++)
        of->n_meets[k] = 0;
    for (int i = 0; i < of->n; i++) {
        const int n = places_of(of->row[i], own, place);
        for (int a = 0; a < n; a++)
            of->meets[place[a]][of->n_meets[place[a]]++] = (short)i;
    }
    clear_pattern(w, of->n);
    for (int k = 0; k < N_Q; k++)
        for (int a = 0; a < of->n_meets[k]; a++)
            for (int b = a + 1; b < of->n_meets[k]; b++)
                w->has[of->meets[k][a]][of->meets[k][b]] = 1;
    fill(w, of);
}

/* Rows 0 ... n - 1. */
static void rows_together(Closing *w, System *of, int n, const int *own)
{
    of->n = n;
    for (int r = 0; r < n; r++)
        of->row[r] = (short)r;
    find_meetings(w, of, own);
}

/* A normal matrix without entries. */
static void clear_normal(Closing *w, const System *of)
{
    for (int k = 0; k < of->n; k++) {
        w->normal[k][k] = 0.0;
        for (int a = 0; a < of->n_filled[k]; a++)
            w->normal[k][of->filled[k][a]] = 0.0;
    }
}

/*
 * normal = U^T U by Cholesky's method, row by row, of its upper half, in place; 1 where a pivot has (nearly) vanished,
 * or nobody wants it.
 */
static int factor_normal(Closing *w, const System *of)
{
    double *whole = w->right; /* not yet in use */
    for (int k = 0; k < of->n; k++)
        whole[k] = w->normal[k][k];
    for (int k = 0; k < of->n; k++) {
        double *u = w->normal[k];
        const short *place = of->filled[k];
        const int many = of->n_filled[k], stands = u[k] > 1e-12 * whole[k];
        if (given_up(w->asked))
            return 1;
        if (!isfinite(whole[k]) || (!stands && !w->dependent))
            return 1;
        const double over = stands ? 1.0 / sqrt(u[k]) : 0.0; /* 0: so is its x */
        w->over_pivot[k] = over;
        for (int a = 0; a < many; a++)
            u[place[a]] *= over;
        for (int a = 0; a < many; a++) {
            const double factor = u[place[a]];
            double *below = w->normal[place[a]];
            for (int b = a; b < many; b++)
                below[place[b]] -= factor * u[place[b]];
        }
    }
    return 0;
}

/* normal x = right from its factor, x in `right`. */
static void solve_normal(Closing *w, const System *of)
{
    for (int k = 0; k < of->n; k++) {
        const double *u = w->normal[k];
        w->right[k] *= w->over_pivot[k];
        for (int a = 0; a < of->n_filled[k]; a++)
            w->right[of->filled[k][a]] -= u[of->filled[k][a]] * w->right[k];
    }
    for (int k = of->n - 1; k >= 0; k--) {
        for (int a = 0; a < of->n_filled[k]; a++)
            w->right[k] -= w->normal[k][of->filled[k][a]] * w->right[of->filled[k][a]];
        w->right[k] *= w->over_pivot[k];
    }
}

/* row row^T and its factor. */
static int factor_rows(Closing *w, const System *of)
{
    double entry[N_START_ROWS + 1];
    clear_normal(w, of);
    for (int k = 0; k < N_Q; k++) {
        const short *meets = of->meets[k];
        const int n = of->n_meets[k];
        for (int a = 0; a < n; a++)
            entry[a] = w->row[of->row[meets[a]]][k];
        for (int a = 0; a < n; a++)
            for (int b = a; b < n; b++)
                w->normal[meets[a]][meets[b]] += entry[a] * entry[b];
    }
    return factor_normal(w, of);
}

/* The shortest step with row step = rest, of rows whose factor is there: step = row^T x, row row^T x = rest. */
static void step_of_rows(Closing *w, const System *of)
{
    for (int i = 0; i < of->n; i++)
        w->right[i] = w->rest[of->row[i]];
    solve_normal(w, of);
    for (int k = 0; k < N_Q; k++) {
        w->step[k] = 0.0;
        for (int a = 0; a < of->n_meets[k]; a++)
            w->step[k] += w->row[of->row[of->meets[k][a]]][k] * w->right[of->meets[k][a]];
    }
}

/* The step that leaves the least of `rest`, damped a little: where Newton begins, no more. Of places alone. */
static int nearest_step(Closing *w)
{
    System *of = &w->first_step;
    double trace = 0.0;
    int place[N_Q], others[N_Q];
    if (!of->n) {
        of->n = N_Q;
        clear_pattern(w, N_Q);
        for (int r = 0; r < N_ALL_ROWS + N_SET; r++) {
            const int n = places_of(r, set_place, place);
            for (int i = 0; i < n; i++)
                for (int j = 0; j < n; j++)
                    w->has[place[i]][place[j]] = 1;
        }
        fill(w, of);
    }
    clear_normal(w, of);
    for (int i = 0; i < N_Q; i++)
        w->right[i] = 0.0;
    for (int r = 0; r < N_ALL_ROWS + N_SET; r++) {
        int many = 0;
        const int n = places_of(r, set_place, place);
        for (int i = 0; i < n; i++)
            if (place[i] % 3 != 2)
                others[many++] = place[i];
        for (int i = 0; i < many; i++) {
            const double entry = w->row[r][others[i]];
            w->right[others[i]] += entry * w->rest[r];
            for (int j = 0; j < many; j++)
                if (others[j] >= others[i])
                    w->normal[others[i]][others[j]] += entry * w->row[r][others[j]];
        }
    }
    for (int i = 0; i < N_Q; i++)
        trace += w->normal[i][i];
    for (int i = 0; i < N_Q; i++) {
        w->normal[i][i] += 1e-10 * trace + 1e-300;
        w->step[i] = w->right[i];
    }
    if (factor_normal(w, of))
        return 1;
    for (int i = 0; i < N_Q; i++)
        w->right[i] = w->step[i];
    solve_normal(w, of);
    for (int k = 0; k < N_Q; k++)
        w->step[k] = w->right[k];
    return 0;
}

/* -Phi, and what is still open of the start's set, over their sizes; the norm of both. */
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

/* Phi_q, and the rows of set, over their sizes and weights; rows of `rest` with them. */
static void linearized_rows(Closing *w, double t, const double *q, const Parameters *p)
{
    jacobian(t, q, p, &w->row[0][0]);
    for (int r = 0; r < N_ALL_ROWS; r++)
        for (int e = phi_q_first[r]; e < phi_q_first[r + 1]; e++)
            w->row[r][phi_q_place[e]] *= w->over_row[r] * w->over_weight[phi_q_place[e]];
    for (int i = 0; i < N_SET; i++)
        w->row[N_ALL_ROWS + i][set_place[i]] = w->over_row[N_ALL_ROWS + i] * w->over_weight[set_place[i]];
    open_rows(w, t, q, p);
}

/* Angles that rows alone determine (drives, sliders). */
static int place_angles(Closing *w, double t, const Parameters *p, double *q)
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

/* From the guess, by the weights of coordinates, squared. */
static double distance(const Closing *w, const double *q)
{
    double sum = 0.0;
    for (int k = 0; k < N_Q; k++)
        sum += (q[k] - w->placed[k]) * w->weight[k] * (q[k] - w->placed[k]) * w->weight[k];
    return sum;
}

/* Whether so much of the rows is none but rounding. */
static int rows_closed(const Closing *w, double norm) { return norm < 1e-10 + NO_MORE * w->reach / w->size; }

/*
 * Whether what Newton's steps lead to is no nearer to the guess than what is known: the last one left a small share of
 * the rows open, and those that follow are smaller by as much.
 */
static int is_no_nearer(const Closing *w, const double *q, double share_left)
{
    double step = 0.0;
    for (int k = 0; k < N_Q; k++)
        step += w->step[k] * w->step[k];
    return share_left < 0.1 && sqrt(distance(w, q)) - 4.0 * share_left * sqrt(step) > sqrt(w->nearest);
}

/* Newton with line search, positions put in first; ends where no step helps any more, or leads to nothing nearer. */
static int close_rows(Closing *w, double t, const Parameters *p, double *q)
{
    const double rounding = NO_MORE * w->reach / w->size;
    double other[N_Q];
    int held = 0; /* factor and rows are those of a place before */
    if (!w->all.n)
        rows_together(w, &w->all, N_ALL_ROWS + N_SET, set_place);
    linearized_rows(w, t, q, p);
    if (nearest_step(w))
        return 1;
    for (int k = 0; k < N_Q; k++)
        q[k] += w->step[k] * w->over_weight[k];
    double norm = open_rows(w, t, q, p);
    for (int i = 0; i < MAX_CLOSING; i++) {
        if (!held) {
            linearized_rows(w, t, q, p);
            if (factor_rows(w, &w->all))
                return 1;
        }
        step_of_rows(w, &w->all);
        double share = 1.0, left = norm;
        for (; share > (held ? 0.5 : 1e-4); share *= 0.5) {
            for (int k = 0; k < N_Q; k++)
                other[k] = q[k] + share * (w->step[k] * w->over_weight[k]);
            left = open_rows(w, t, other, p);
            if (left < (1.0 - 1e-4 * share) * norm)
                break;
        }
        if (!(share > (held ? 0.5 : 1e-4))) {
            if (!held || norm < rounding)
                break;
            held = 0;
            continue;
        }
        for (int k = 0; k < N_Q; k++)
            q[k] = other[k];
        if (share == 1.0 && is_no_nearer(w, q, left / norm))
            return 1;
        held = left < HELD_FROM && (left < 0.1 * norm || left < rounding);
        norm = left;
    }
    return !rows_closed(w, norm);
}
