/*
 * The start nearest to a guess: a closed configuration (closing.c), then the velocities that are least in the norm of
 * M. This is the regular case; 1 is returned where Newton's method leads far away or fails, and the search in Python
 * decides.
 */
#include "closing.c"
#include "start.h"

#define FAR 0.5      /* rad: a larger change of a guessed angle needs the search in Python (closure.py) */
#define APART 0.2    /* the same of a guessed position, as a fraction of the size (followed.py) */
#define MIRRORED 0.1 /* of both: for larger changes the mirrored configuration is tried */
#define SMALL_INERTIA 1e-9 /* of m size^2: least moment of inertia in the norm (sizes.py) */
#define NEARER 1e-5  /* least relative difference of distances for a nearer configuration */

/* Return the largest distance from the origin, m, that drives, set coordinates and guess require; at least the size. */
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

/* Initialize the workspace: values of the start, weights of coordinates and scales of equations as in Python. */
static void begin_start(Closing *w, const Parameters *p)
{
    start_values(p, w->guess, w->set, w->rates);
    for (int k = 0; k < N_Q; k++)
        w->weight[k] = k % 3 == 2 ? 1e-2 : 1e-4 / w->size;
    for (int i = 0; i < N_GUESS && !GUESSED_POINTS; i++)
        w->weight[guess_place[i]] = guess_place[i] % 3 == 2 ? 1.0 : 1.0 / w->size;
    for (int k = 0; k < N_Q; k++)
        w->over_weight[k] = 1.0 / w->weight[k];
    for (int r = 0; r < N_ALL_ROWS + N_SET; r++) {
        const int is_length = r < N_ALL_ROWS ? row_is_length[r] : set_place[r - N_ALL_ROWS] % 3 != 2;
        w->over_row[r] = is_length ? 1.0 / w->size : 1.0;
    }
    w->nearest = INFINITY;
}

/* Set q to the guess, with the angles that equations without lengths determine. Returns 1 on failure. */
static int first_guess(Closing *w, double t, const Parameters *p, double *q)
{
    begin_start(w, p);
    for (int k = 0; k < N_Q; k++)
        q[k] = 0.0;
    for (int i = 0; i < N_GUESS; i++)
        q[guess_place[i]] = w->guess[i];
    for (int i = 0; i < N_SET; i++)
        q[set_place[i]] = w->set[i];
    if (place_angles(w, t, p, q))
        return 1;
    for (int k = 0; k < N_Q; k++)
        w->placed[k] = q[k];
    w->reach = farthest_place(w, t, p, q);
    return 0;
}

/*
 * Return the largest change of a guessed angle or position, relative to the limit beyond which the search in Python
 * decides.
 */
static double strayed(const Closing *w, const double *q)
{
    double worst = 0.0, off[N_Q] = {0.0};
    for (int i = 0; i < N_GUESS; i++)
        off[guess_place[i]] = q[guess_place[i]] - w->placed[guess_place[i]];
    for (int k = 0; k < N_Q; k += 3) {
        const double away = hypot(off[k], off[k + 1]), from = hypot(w->placed[k], w->placed[k + 1]);
        worst = max_of(max_of(away / (APART * max_of(w->size, from)), fabs(off[k + 2]) / FAR), worst);
    }
    return worst;
}

/* Return whether all positions are within 1000 times the reach: the iteration has not diverged. */
static int is_near(const Closing *w, const double *q)
{
    int near = 1;
    for (int k = 0; k < N_Q; k++)
        near &= k % 3 == 2 || fabs(q[k]) < 1e3 * w->reach;
    return near;
}

/* Reduce angles to within half a turn of the guess. Returns 1 if equations depend on the number of turns. */
static int unwind(Closing *w, double t, const Parameters *p, double *q)
{
    int wound = 0;
    for (int k = 2; k < N_Q; k += 3) {
        const double turns = rint((q[k] - w->placed[k]) / (2.0 * PI));
        wound |= turns != 0.0;
        q[k] -= 2.0 * PI * turns;
    }
    return wound && !rows_closed(w, open_rows(w, t, q, p));
}

/*
 * Replace q by the nearest of three closed configurations: q, the one beyond the guess with guessed coordinates
 * mirrored, and the one with all coordinates mirrored.
 */
static void nearer(Closing *w, double t, const Parameters *p, double *q)
{
    if (strayed(w, q) < MIRRORED)
        return;
    for (int k = 0; k < N_Q; k++) {
        w->first[k] = q[k];
        w->beyond[k] = 2.0 * w->placed[k] - q[k];
    }
    for (int all = 0; all < 2; all++) {
        w->nearest = (1.0 - NEARER) * (1.0 - NEARER) * distance(w, q);
        for (int k = 0; k < N_Q; k++)
            w->other[k] = all ? w->beyond[k] : w->first[k];
        for (int i = 0; i < N_GUESS; i++)
            w->other[guess_place[i]] = w->beyond[guess_place[i]];
        for (int i = 0; i < N_SET; i++)
            w->other[set_place[i]] = w->set[i];
        if (place_angles(w, t, p, w->other) || close_rows(w, t, p, w->other) || !is_near(w, w->other)
            || unwind(w, t, p, w->other) || !(distance(w, w->other) < w->nearest))
            continue;
        for (int k = 0; k < N_Q; k++)
            q[k] = w->other[k];
    }
}

/* Compute the reciprocal square roots of the norm's diagonal: M with a least moment of inertia. */
static void over_root_of_metric(const Closing *w, const Parameters *p, double *over_root)
{
    double m[N_Q];
    mass_matrix(p, m);
    for (int k = 0; k < N_Q; k++) {
        const double least = k % 3 == 2 ? SMALL_INERTIA * m[k - 1] * w->size * w->size : 0.0;
        over_root[k] = 1.0 / sqrt(max_of(m[k], least));
    }
}

/*
 * Compute the velocities that satisfy Phi_q v = nu and the set rates, least in the norm of M, refined twice. Returns 1
 * on failure.
 */
SELDOM static int first_velocities(Closing *w, double t, const Parameters *p, const double *q, double *v)
{
    double over_root[N_Q], required[N_START_ROWS + 1], most = 0.0, worst = 0.0;
    int place[N_Q];
    over_root_of_metric(w, p, over_root);
    for (int k = 0; k < N_Q; k++)
        v[k] = 0.0;
    rows_together(w, &w->some, N_ALL_ROWS + N_RATES, rate_place);
    jacobian(t, q, p, &w->row[0][0]);
    velocity_rhs(after_jump(t), q, p, required);
    for (int k = 0; k < N_APART; k++)
        required[apart_row[k]] -= w->rates[N_RATES + k];
    for (int i = 0; i < N_RATES; i++) {
        required[N_ALL_ROWS + i] = w->rates[i];
        w->row[N_ALL_ROWS + i][rate_place[i]] = 1.0;
    }
    for (int r = 0; r < w->some.n; r++) {
        const int n = places_of(r, rate_place, place);
        for (int i = 0; i < n; i++)
            w->row[r][place[i]] *= over_root[place[i]];
        most = max_of(most, fabs(required[r]));
    }
    if (factor_rows(w, &w->some))
        return 1;
    for (int pass = 0; pass <= 3; pass++) {
        worst = 0.0;
        for (int r = 0; r < w->some.n; r++) {
            const int n = places_of(r, rate_place, place);
            w->rest[r] = required[r];
            for (int i = 0; i < n; i++)
                w->rest[r] -= w->row[r][place[i]] * v[place[i]];
            worst = max_of(worst, fabs(w->rest[r]));
        }
        if (pass == 3)
            break;
        step_of_rows(w, &w->some);
        for (int k = 0; k < N_Q; k++)
            v[k] += w->step[k];
    }
    for (int k = 0; k < N_Q; k++)
        v[k] *= over_root[k];
    return !(worst <= 1e-10 * most + MIN_RESOLVED);
}

/*
 * Compute the start q, v nearest to the guess. size: the mechanism's size, m; residual: largest |Phi|. Returns 0, or 1
 * if the search in Python must decide.
 */
int close_start(
    double t, const double *parameters, double size, double *q, double *v, double *residual, Cancellation *cancellation)
{
    const Parameters *p = (const Parameters *)parameters;
    Closing *w = GUESSED_POINTS ? NULL : calloc(1, sizeof(Closing));
    if (!w)
        return 1;
    w->size = size;
    w->cancellation = cancellation;
    int status = first_guess(w, t, p, q) || close_rows(w, t, p, q);
    if (!status && strayed(w, q) < 1.0)
        nearer(w, t, p, q);
    status = status || !(strayed(w, q) < 1.0) || !is_near(w, q); /* another branch may be nearer */
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

/* Compute the start q, v as close_start(), without cancellation. */
int gudgeon_start(double t, const double *parameters, double size, double *q, double *v, double *residual)
{
    Cancellation no_cancellation = {0};
    return close_start(t, parameters, size, q, v, residual, &no_cancellation);
}

/*
 * Continue a closed start q to other parameters: Newton's method from q, then velocities v. Equations may depend on
 * each other. Returns 0, 1 if it does not close, or 2 if it has no velocities. The caller checks that q remains near.
 */
int gudgeon_continuation(double t, const double *parameters, double size, double *q, double *v)
{
    const Parameters *p = (const Parameters *)parameters;
    Cancellation no_cancellation = {0};
    Closing *w = calloc(1, sizeof(Closing));
    if (!w)
        return 1;
    w->size = size;
    w->cancellation = &no_cancellation;
    w->dependent = 1;
    begin_start(w, p);
    w->reach = farthest_place(w, t, p, q);
    int status = close_rows(w, t, p, q);
    if (!status && first_velocities(w, t, p, q, v))
        status = 2;
    free(w);
    return status;
}
