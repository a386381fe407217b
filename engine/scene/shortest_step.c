/*
 * Steps that close linearized constraint equations: the smallest such step, by the normal matrix of the equations, and
 * the least-squares step. The sparsity follows from the pattern of Phi_q.
 */
#include "../run/cancellation.h"
#include "calls.h"

#ifndef N_APART /* starts that set eccentricities e: Phi = -e is stored after `set`, its rate after `rates` */
#define N_APART 0
static const int apart_row[] = {0};
#endif

enum {
    N_START_ROWS = N_ALL_ROWS + (N_SET > N_RATES ? N_SET : N_RATES),
    N_NORMAL = N_START_ROWS > N_Q ? N_START_ROWS : N_Q
};

/* The pattern of a normal matrix: its equations, those with an entry for each coordinate, the nonzeros of its factor.
 * For the least-squares step coordinates take the place of equations. */
typedef struct {
    int n;
    short row[N_NORMAL + 1], meets[N_Q][N_START_ROWS + 1], n_meets[N_Q];
    short filled[N_NORMAL + 1][N_NORMAL + 1], n_filled[N_NORMAL + 1];
} System;

/* Workspace of a start: linearized equations with residuals (columns divided by weights), a normal matrix (upper half)
 * and the reciprocal diagonal of its factor, guess and set values, patterns. */
typedef struct {
    double size, reach, weight[N_Q], step[N_Q], placed[N_Q];
    double first[N_Q], beyond[N_Q], other[N_Q];
    double guess[N_GUESS + 1], set[N_SET + N_APART + 1], rates[N_RATES + N_APART + 1];
    double row[N_START_ROWS + 1][N_Q], rest[N_START_ROWS + 1], over_row[N_START_ROWS + 1], over_weight[N_Q];
    double normal[N_NORMAL + 1][N_NORMAL + 1], over_pivot[N_NORMAL + 1], right[N_NORMAL + 1];
    unsigned char has[N_NORMAL + 1][N_NORMAL + 1];
    System first_step, all, some;
    double nearest; /* squared distance from the guess that a configuration must improve on */
    int dependent;  /* whether dependent equations are left out: the residuals show if they do not close */
    Cancellation *cancellation;
} Closing;

/*
 * List the coordinates with an entry in equation r: a few for joints and drives; the set coordinate own[] for the
 * equations after these. Returns their number.
 */
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

/* Compute the nonzeros of the factor of a normal matrix from its pattern w->has (upper half). */
SELDOM static void fill(Closing *w, System *of)
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

/* Clear the pattern of an n x n matrix (upper half). */
static void clear_pattern(Closing *w, int n)
{
    for (int i = 0; i < n; i++)
        for (int j = i; j < n; j++)
            w->has[i][j] = 0;
}

/* Compute the pattern of the normal matrix row row^T: equations with a common coordinate. own: set coordinates. */
SELDOM static void find_meetings(Closing *w, System *of, const int *own)
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

/* Set a system to equations 0 ... n - 1 and compute its pattern. */
static void rows_together(Closing *w, System *of, int n, const int *own)
{
    of->n = n;
    for (int r = 0; r < n; r++)
        of->row[r] = (short)r;
    find_meetings(w, of, own);
}

/* Set the normal matrix to zero. */
static void clear_normal(Closing *w, const System *of)
{
    for (int k = 0; k < of->n; k++) {
        w->normal[k][k] = 0.0;
        for (int a = 0; a < of->n_filled[k]; a++)
            w->normal[k][of->filled[k][a]] = 0.0;
    }
}

/*
 * Factorize the normal matrix U^T U by Cholesky's method, by rows of its upper half, in place. Returns 1 if a pivot
 * nearly vanishes, or on cancellation.
 */
SELDOM static int factor_normal(Closing *w, const System *of)
{
    double *whole = w->right; /* not yet in use */
    for (int k = 0; k < of->n; k++)
        whole[k] = w->normal[k][k];
    for (int k = 0; k < of->n; k++) {
        double *u = w->normal[k];
        const short *place = of->filled[k];
        const int many = of->n_filled[k], stands = u[k] > 1e-12 * whole[k];
        if (is_cancelled(w->cancellation))
            return 1;
        if (!isfinite(whole[k]) || (!stands && !w->dependent))
            return 1;
        const double over = stands ? 1.0 / sqrt(u[k]) : 0.0; /* 0: its unknown is 0 */
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

/* Solve the factorized normal system; w->right: right-hand side on entry, solution on return. */
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

/* Compute and factorize the normal matrix row row^T. Returns 1 if a pivot nearly vanishes. */
static int factor_rows(Closing *w, const System *of)
{
    double entry[N_START_ROWS + 1];
    clear_normal(w, of);
    for (int k = 0; k < N_Q; k++) {
        const short *those = of->meets[k];
        const int n = of->n_meets[k];
        for (int a = 0; a < n; a++)
            entry[a] = w->row[of->row[those[a]]][k];
        for (int a = 0; a < n; a++)
            for (int b = a; b < n; b++)
                w->normal[those[a]][those[b]] += entry[a] * entry[b];
    }
    return factor_normal(w, of);
}

/* Compute the smallest step with row step = rest from the factorized equations: step = row^T x, row row^T x = rest. */
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

/* Compute the pattern of row^T row: coordinates with a common equation. */
static void find_pairs(Closing *w, System *of)
{
    int place[N_Q];
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

/* Compute row^T row for positions only, without angles. */
static void add_rows(Closing *w, const System *of)
{
    int place[N_Q];
    clear_normal(w, of);
    for (int r = 0; r < N_ALL_ROWS + N_SET; r++) {
        const int n = places_of(r, set_place, place);
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n && place[i] % 3 != 2; j++)
                if (place[j] % 3 != 2 && place[j] >= place[i])
                    w->normal[place[i]][place[j]] += w->row[r][place[i]] * w->row[r][place[j]];
    }
}

/* Compute row^T (rest - row step) - damping step in w->right, for positions only. */
static void add_rest(Closing *w, double damping)
{
    int place[N_Q];
    for (int k = 0; k < N_Q; k++)
        w->right[k] = -damping * w->step[k];
    for (int r = 0; r < N_ALL_ROWS + N_SET; r++) {
        const int n = places_of(r, set_place, place);
        double left = w->rest[r];
        for (int i = 0; i < n; i++)
            left -= w->row[r][place[i]] * w->step[place[i]];
        for (int i = 0; i < n; i++)
            if (place[i] % 3 != 2)
                w->right[place[i]] += w->row[r][place[i]] * left;
    }
}

/*
 * Compute the slightly damped least-squares step of positions, with which Newton's method begins. It is refined once:
 * along directions without equations the damped matrix has six digits only. Returns 1 on failure.
 */
static int nearest_step(Closing *w)
{
    System *of = &w->first_step;
    double trace = 0.0;
    if (!of->n)
        find_pairs(w, of);
    add_rows(w, of);
    for (int k = 0; k < N_Q; k++)
        trace += w->normal[k][k];
    const double damping = 1e-10 * trace + 1e-300;
    for (int k = 0; k < N_Q; k++) {
        w->normal[k][k] += damping;
        w->step[k] = 0.0;
    }
    if (factor_normal(w, of))
        return 1;
    for (int pass = 0; pass < 2; pass++) {
        add_rest(w, damping);
        solve_normal(w, of);
        for (int k = 0; k < N_Q; k++)
            w->step[k] += w->right[k];
    }
    return 0;
}
