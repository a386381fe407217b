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

enum {
    N_START_ROWS = N_ALL_ROWS + (N_SET > N_RATES ? N_SET : N_RATES),
    N_NORMAL = N_START_ROWS > N_Q ? N_START_ROWS : N_Q, MAX_CLOSING = 60
};

/* Rows of the linearized system with what each must still give, columns over their weights; a normal matrix, its upper
 * half. */
typedef struct {
    double size, reach, weight[N_Q], step[N_Q], placed[N_Q];
    double first[N_Q], beyond[N_Q], other[N_Q];
    double guess[N_GUESS + 1], set[N_SET + N_APART + 1], rates[N_RATES + N_APART + 1];
    double row[N_START_ROWS + 1][N_Q], rest[N_START_ROWS + 1];
    double normal[N_NORMAL + 1][N_NORMAL + 1], whole[N_NORMAL + 1], right[N_NORMAL + 1];
    short filled[N_NORMAL + 1][N_NORMAL + 1], n_filled[N_NORMAL + 1]; /* of a factor: where its row is not 0 */
    short meets[N_Q][N_START_ROWS + 1], n_meets[N_Q];                 /* which rows meet a coordinate */
    int dependent; /* rows that depend on others are left out: they close with them, or the rest says so */
    Asked *asked;
} Closing;

/* Where row r has something: a row of joints and drives meets a few coordinates of many. Returns how many. */
static int places_of(const Closing *w, int r, short *place)
{
    int n = 0;
    for (int k = 0; k < N_Q; k++)
        if (w->row[r][k] != 0.0)
            place[n++] = (short)k;
    return n;
}

/*
 * normal = U^T U by Cholesky's method, row by row, of its upper half, in place; 1 where a pivot has (nearly) vanished,
 * or nobody wants it.
 */
static int factor_normal(Closing *w, int n)
{
    for (int k = 0; k < n; k++)
        w->whole[k] = w->normal[k][k];
    for (int k = 0; k < n; k++) {
        double *u = w->normal[k];
        if (given_up(w->asked))
            return 1;
        if (!isfinite(w->whole[k]) || (!(u[k] > 1e-12 * w->whole[k]) && !w->dependent))
            return 1;
        if (!(u[k] > 1e-12 * w->whole[k])) {
            for (int i = k; i < n; i++)
                u[i] = 0.0;
            u[k] = INFINITY; /* its x is 0 */
            w->n_filled[k] = 0;
            continue;
        }
        const double root = sqrt(u[k]);
        short *place = w->filled[k];
        int many = 0;
        for (int i = k; i < n; i++)
            u[i] /= root;
        for (int i = k + 1; i < n; i++)
            if (u[i] != 0.0)
                place[many++] = (short)i;
        w->n_filled[k] = (short)many;
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
static void solve_normal(Closing *w, int n)
{
    for (int k = 0; k < n; k++) {
        const double *u = w->normal[k];
        w->right[k] /= u[k];
        for (int a = 0; a < w->n_filled[k]; a++)
            w->right[w->filled[k][a]] -= u[w->filled[k][a]] * w->right[k];
    }
    for (int k = n - 1; k >= 0; k--) {
        for (int a = 0; a < w->n_filled[k]; a++)
            w->right[k] -= w->normal[k][w->filled[k][a]] * w->right[w->filled[k][a]];
        w->right[k] /= w->normal[k][k];
    }
}

/* row row^T and its factor: only rows that meet a coordinate in common have a product. */
static int factor_rows(Closing *w, int rows)
{
    for (int k = 0; k < N_Q; k++)
        w->n_meets[k] = 0;
    for (int i = 0; i < rows; i++) {
        for (int j = i; j < rows; j++)
            w->normal[i][j] = 0.0;
        for (int k = 0; k < N_Q; k++)
            if (w->row[i][k] != 0.0)
                w->meets[k][w->n_meets[k]++] = (short)i;
    }
    for (int k = 0; k < N_Q; k++) {
        const short *row = w->meets[k];
        for (int a = 0; a < w->n_meets[k]; a++)
            for (int b = a; b < w->n_meets[k]; b++)
                w->normal[row[a]][row[b]] += w->row[row[a]][k] * w->row[row[b]][k];
    }
    return factor_normal(w, rows);
}

/* The shortest step with row step = rest, of rows whose factor is there: step = row^T x, row row^T x = rest. */
static void step_of_rows(Closing *w, int rows)
{
    for (int i = 0; i < rows; i++)
        w->right[i] = w->rest[i];
    solve_normal(w, rows);
    for (int k = 0; k < N_Q; k++)
        w->step[k] = 0.0;
    for (int i = 0; i < rows; i++)
        for (int k = 0; k < N_Q; k++)
            w->step[k] += w->row[i][k] * w->right[i];
}

static int shortest_step(Closing *w, int rows)
{
    if (factor_rows(w, rows))
        return 1;
    step_of_rows(w, rows);
    return 0;
}

/* The step that leaves the least of `rest`, damped a little: where Newton begins, no more. */
static int nearest_step(Closing *w, int rows)
{
    double trace = 0.0;
    short place[N_Q];
    for (int i = 0; i < N_Q; i++) {
        w->right[i] = 0.0;
        for (int j = i; j < N_Q; j++)
            w->normal[i][j] = 0.0;
    }
    for (int r = 0; r < rows; r++) {
        const int n = places_of(w, r, place);
        for (int i = 0; i < n; i++) {
            w->right[place[i]] += w->row[r][place[i]] * w->rest[r];
            for (int j = i; j < n; j++)
                w->normal[place[i]][place[j]] += w->row[r][place[i]] * w->row[r][place[j]];
        }
    }
    for (int i = 0; i < N_Q; i++)
        trace += w->normal[i][i];
    for (int i = 0; i < N_Q; i++)
        w->normal[i][i] += 1e-10 * trace + 1e-300;
    if (factor_normal(w, N_Q))
        return 1;
    solve_normal(w, N_Q);
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
        w->rest[r] /= row_is_length[r] ? -w->size : -1.0;
    for (int i = 0; i < N_SET; i++)
        w->rest[N_ALL_ROWS + i] = (w->set[i] - q[set_place[i]]) / (set_place[i] % 3 == 2 ? 1.0 : w->size);
    for (int r = 0; r < N_ALL_ROWS + N_SET; r++)
        sum += w->rest[r] * w->rest[r];
    return sqrt(sum);
}

/* Phi_q, and the rows of set, over their sizes and weights; rows of `rest` with them. */
static void linearized_rows(Closing *w, double t, const double *q, const Parameters *p)
{
    gudgeon_phi_q(t, q, (const double *)p, &w->row[0][0]);
    for (int i = 0; i < N_SET; i++)
        for (int k = 0; k < N_Q; k++)
            w->row[N_ALL_ROWS + i][k] = k == set_place[i] ? 1.0 : 0.0;
    for (int r = 0; r < N_ALL_ROWS + N_SET; r++) {
        const int is_length = r < N_ALL_ROWS ? row_is_length[r] : set_place[r - N_ALL_ROWS] % 3 != 2;
        for (int k = 0; k < N_Q; k++)
            if (w->row[r][k] != 0.0)
                w->row[r][k] /= w->weight[k] * (is_length ? w->size : 1.0);
    }
    open_rows(w, t, q, p);
}

/* Angles that rows alone determine (drives, sliders). */
static int place_angles(Closing *w, double t, const Parameters *p, double *q)
{
    int rows = 0;
    linearized_rows(w, t, q, p);
    for (int r = 0; r < N_ALL_ROWS + N_SET; r++) {
        int places = 0;
        for (int k = 0; k < N_Q; k++)
            places |= k % 3 != 2 && w->row[r][k] != 0.0;
        if (places)
            continue;
        for (int k = 0; k < N_Q; k++)
            w->row[rows][k] = w->row[r][k];
        w->rest[rows++] = w->rest[r];
    }
    if (shortest_step(w, rows))
        return 1;
    for (int k = 0; k < N_Q; k++)
        q[k] += w->step[k] / w->weight[k];
    return 0;
}

/* Whether so much of the rows is none but rounding. */
static int rows_closed(const Closing *w, double norm) { return norm < 1e-10 + 1e-14 * w->reach / w->size; }

/* Newton with line search, positions put in first; ends where no step helps any more. */
static int close_rows(Closing *w, double t, const Parameters *p, double *q)
{
    double other[N_Q], share = 1.0;
    linearized_rows(w, t, q, p);
    for (int r = 0; r < N_ALL_ROWS + N_SET; r++)
        for (int k = 2; k < N_Q; k += 3)
            w->row[r][k] = 0.0;
    if (nearest_step(w, N_ALL_ROWS + N_SET))
        return 1;
    for (int k = 0; k < N_Q; k++)
        q[k] += w->step[k] / w->weight[k];
    double norm = open_rows(w, t, q, p);
    for (int i = 0; i < MAX_CLOSING && share > 1e-4; i++) {
        linearized_rows(w, t, q, p);
        if (shortest_step(w, N_ALL_ROWS + N_SET))
            return 1;
        for (share = 1.0; share > 1e-4; share *= 0.5) {
            for (int k = 0; k < N_Q; k++)
                other[k] = q[k] + share * (w->step[k] / w->weight[k]);
            const double left = open_rows(w, t, other, p);
            if (left < (1.0 - 1e-4 * share) * norm) {
                norm = left;
                for (int k = 0; k < N_Q; k++)
                    q[k] = other[k];
                break;
            }
        }
    }
    return !rows_closed(w, norm);
}
