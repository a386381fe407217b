/*
 * The start nearest the guess, as the runtime seeks it: Newton's steps, each the smallest that closes the
 * linearized rows, then velocities least in the metric of M. This is the ordinary case only: where rows depend on
 * each other, or Newton leads far away or nowhere, 1 is returned and the search in Python decides.
 */
#include "../run/asked.h"
#include "calls.h"
#include "start.h"

#ifndef N_APART /* few starts say where journals are: Phi of these joints is -e, behind set, its rate behind rates */
#define N_APART 0
static const int apart_row[] = {0};
#endif

enum {
    N_START_ROWS = N_ALL_ROWS + (N_SET > N_RATES ? N_SET : N_RATES),
    N_NORMAL = N_START_ROWS > N_Q ? N_START_ROWS : N_Q, MAX_CLOSING = 60
};
#define FAR 0.5   /* rad: where a guessed angle turns further, a nearer configuration is sought (closure.py) */
#define APART 0.2 /* the same of a guessed place, as a share of the size (followed.py) */

/* Rows of the linearized system with what each must still give, columns over their weights; a normal matrix. */
typedef struct {
    double size, reach, weight[N_Q], step[N_Q], placed[N_Q];
    double guess[N_GUESS + 1], set[N_SET + N_APART + 1], rates[N_RATES + N_APART + 1];
    double row[N_START_ROWS + 1][N_Q], rest[N_START_ROWS + 1];
    double normal[N_NORMAL + 1][N_NORMAL + 1], right[N_NORMAL + 1];
    Asked *asked;
} Closing;

/* normal x = right by Cholesky's method, x in `right`; 1 where a pivot has (nearly) vanished, or nobody wants it. */
static int solve_normal(Closing *w, int n)
{
    for (int k = 0; k < n; k++) {
        const double whole = w->normal[k][k];
        if (given_up(w->asked))
            return 1;
        for (int i = k; i < n; i++) {
            double sum = w->normal[i][k];
            for (int j = 0; j < k; j++)
                sum -= w->normal[i][j] * w->normal[k][j];
            w->normal[i][k] = sum;
        }
        if (!(w->normal[k][k] > 1e-12 * whole) || !isfinite(whole))
            return 1;
        const double root = sqrt(w->normal[k][k]);
        for (int i = k; i < n; i++)
            w->normal[i][k] /= root;
    }
    for (int k = 0; k < n; k++) {
        for (int j = 0; j < k; j++)
            w->right[k] -= w->normal[k][j] * w->right[j];
        w->right[k] /= w->normal[k][k];
    }
    for (int k = n - 1; k >= 0; k--) {
        for (int j = k + 1; j < n; j++)
            w->right[k] -= w->normal[j][k] * w->right[j];
        w->right[k] /= w->normal[k][k];
    }
    return 0;
}

/* The shortest step with row step = rest: step = row^T x, row row^T x = rest. */
static int shortest_step(Closing *w, int rows)
{
    for (int i = 0; i < rows; i++) {
        w->right[i] = w->rest[i];
        for (int j = 0; j <= i; j++) {
            w->normal[i][j] = 0.0;
            for (int k = 0; k < N_Q; k++)
                w->normal[i][j] += w->row[i][k] * w->row[j][k];
        }
    }
    if (solve_normal(w, rows))
        return 1;
    for (int k = 0; k < N_Q; k++) {
        w->step[k] = 0.0;
        for (int i = 0; i < rows; i++)
            w->step[k] += w->row[i][k] * w->right[i];
    }
    return 0;
}

/* The step that leaves the least of `rest`, damped a little: where Newton begins, no more. */
static int nearest_step(Closing *w, int rows)
{
    double trace = 0.0;
    for (int i = 0; i < N_Q; i++) {
        w->right[i] = 0.0;
        for (int k = 0; k < rows; k++)
            w->right[i] += w->row[k][i] * w->rest[k];
        for (int j = 0; j <= i; j++) {
            w->normal[i][j] = 0.0;
            for (int k = 0; k < rows; k++)
                w->normal[i][j] += w->row[k][i] * w->row[k][j];
        }
        trace += w->normal[i][i];
    }
    for (int i = 0; i < N_Q; i++)
        w->normal[i][i] += 1e-10 * trace + 1e-300;
    if (solve_normal(w, N_Q))
        return 1;
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
            w->row[r][k] /= w->weight[k] * (is_length ? w->size : 1.0);
    }
    open_rows(w, t, q, p);
}

/* How far from the origin (m) drives, the start's set and its guess ask bodies to be: the size, at least. */
static double farthest_place(Closing *w, double t, const Parameters *p, const double *q)
{
    double reach = w->size;
    open_rows(w, t, q, p);
    for (int r = 0; r < N_ALL_ROWS; r++)
        if (row_is_length[r])
            reach = max_of(reach, fabs(w->rest[r] * w->size));
    for (int k = 0; k < N_Q; k++)
        if (k % 3 != 2)
            reach = max_of(reach, fabs(q[k]));
    return reach;
}

/* Coordinates weigh as in the runtime; the guess, with angles that rows alone determine (drives, sliders). */
static int first_guess(Closing *w, double t, const Parameters *p, double *q)
{
    int rows = 0;
    start_values(p, w->guess, w->set, w->rates);
    for (int k = 0; k < N_Q; k++) {
        w->weight[k] = k % 3 == 2 ? 1e-2 : 1e-4 / w->size;
        q[k] = 0.0;
    }
    for (int i = 0; i < N_GUESS; i++) {
        w->weight[guess_place[i]] = guess_place[i] % 3 == 2 ? 1.0 : 1.0 / w->size;
        q[guess_place[i]] = w->guess[i];
    }
    for (int i = 0; i < N_SET; i++)
        q[set_place[i]] = w->set[i];
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
        w->placed[k] = q[k] += w->step[k] / w->weight[k];
    w->reach = farthest_place(w, t, p, q);
    return 0;
}

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
    return !(norm < 1e-10 + 1e-14 * w->reach / w->size);
}

/* Phi_q v = nu and the start's rates, least in the metric of M; refined twice. */
static int first_velocities(Closing *w, double t, const Parameters *p, const double *q, double *v)
{
    enum { ROWS = N_ALL_ROWS + N_RATES };
    double root[N_Q], most = 0.0, worst = 0.0;
    mass_matrix(p, root);
    for (int k = 0; k < N_Q; k++) {
        root[k] = sqrt(root[k]);
        v[k] = 0.0;
    }
    for (int pass = 0; pass <= 3; pass++) {
        gudgeon_phi_q(t, q, (const double *)p, &w->row[0][0]);
        velocity_rhs(beyond_jump(t), q, p, w->rest);
        for (int k = 0; k < N_APART; k++)
            w->rest[apart_row[k]] -= w->rates[N_RATES + k];
        for (int i = 0; i < N_RATES; i++) {
            w->rest[N_ALL_ROWS + i] = w->rates[i];
            for (int k = 0; k < N_Q; k++)
                w->row[N_ALL_ROWS + i][k] = k == rate_place[i] ? 1.0 : 0.0;
        }
        most = worst = 0.0;
        for (int r = 0; r < ROWS; r++) {
            most = max_of(most, fabs(w->rest[r]));
            for (int k = 0; k < N_Q; k++) {
                w->rest[r] -= w->row[r][k] * v[k];
                w->row[r][k] /= root[k];
            }
            worst = max_of(worst, fabs(w->rest[r]));
        }
        if (pass == 3)
            break;
        if (shortest_step(w, ROWS))
            return 1;
        for (int k = 0; k < N_Q; k++)
            v[k] += w->step[k] / root[k];
    }
    return !(worst <= 1e-10 * most);
}

/* `size` of the mechanism (m) scales lengths. 0: q and v are the start, |Phi| at most `residual`; 1: see above. */
int close_start(double t, const double *parameters, double size, double *q, double *v, double *residual, Asked *asked)
{
    const Parameters *p = (const Parameters *)parameters;
    Closing *w = GUESSED_POINTS ? NULL : calloc(1, sizeof(Closing));
    if (!w)
        return 1;
    w->size = size;
    w->asked = asked;
    int status = first_guess(w, t, p, q) || close_rows(w, t, p, q);
    for (int i = 0; i < N_GUESS; i++) { /* far from the guess: another branch may be nearer */
        const int k = guess_place[i];
        const double may = k % 3 == 2 ? FAR : APART * max_of(size, fabs(w->placed[k]));
        status |= !(fabs(q[k] - w->placed[k]) < may);
    }
    for (int k = 0; k < N_Q; k++)
        if (k % 3 != 2 && !(fabs(q[k]) < 1e3 * w->reach))
            status = 1;
    status = status || first_velocities(w, t, p, q, v);
    open_rows(w, t, q, p);
    *residual = 0.0;
    for (int r = 0; r < N_ALL_ROWS + N_SET; r++) {
        const int is_length = r < N_ALL_ROWS ? row_is_length[r] : set_place[r - N_ALL_ROWS] % 3 != 2;
        *residual = max_of(*residual, fabs(w->rest[r]) * (is_length ? size : 1.0));
    }
    free(w);
    return status;
}

int gudgeon_start(double t, const double *parameters, double size, double *q, double *v, double *residual)
{
    Asked nobody = {0};
    return close_start(t, parameters, size, q, v, residual, &nobody);
}
