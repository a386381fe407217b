/*
 * Initial conditions (assembly) nearest to a guess: a closed configuration (closing.c), then velocities of minimum norm
 * in the mass matrix. This is the regular case; 1 is returned where Newton's method leads far away or fails, and the
 * search in Python decides.
 */
#include "closing.c"
#include "start.h"

#define MAX_ANGLE_CHANGE 0.5 /* rad: a larger change of a guessed angle needs the search in Python (closure.py) */
/* the same of a guessed position, as a fraction of the size (assembly/guess_warnings.py) */
#define MAX_POSITION_CHANGE 0.2
#define MIN_MIRRORED_CHANGE 0.1 /* of both limits: for larger changes the mirrored configurations are tried */
#define MIN_START_INERTIA 1e-9 /* of m size^2: smallest moment of inertia in the norm (sizes.py) */
#define MIN_DISTANCE_REDUCTION 1e-5 /* smallest relative difference of distances for a nearer configuration */

/* Return a new workspace, which free() releases, or NULL if memory is short. size: of the mechanism, m. */
static StartWorkspace *allocate_start_workspace(double size, Cancellation *cancellation)
{
    StartWorkspace *workspace = calloc(1, sizeof(StartWorkspace));
    if (workspace) {
        workspace->size = size;
        workspace->cancellation = cancellation;
    }
    return workspace;
}

/*
 * Return the radius in m that bounds the search for a start: the maximum of the mechanism's size, |x| and |y| of all
 * positions in q, and the length residuals at q. workspace->residual is overwritten.
 */
static double compute_search_radius(StartWorkspace *workspace, double t, const Parameters *p, const double *q)
{
    double largest = workspace->size;
    compute_start_residuals(workspace, t, q, p);
    for (int equation = 0; equation < N_ALL_ROWS; equation++)
        if (row_is_length[equation])
            largest = max_of(largest, fabs(workspace->residual[equation] * workspace->size));
    for (int k = 0; k < N_Q; k++)
        if (k % 3 != 2)
            largest = max_of(largest, fabs(q[k]));
    return largest;
}

/*
 * Initialize the workspace of a start from the parameters: guess, prescribed coordinates and rates, weights of
 * coordinates, scales of columns and rows. They are those of the search in Python. workspace->size must be set before.
 *   Weights: 1e-2 of an angle without a guess, 1e-4/size of a position; 1 and 1/size of guessed ones. If the guess
 *     consists of points (GUESSED_POINTS), no coordinate counts as guessed.
 *   Scales: 1/weight of a column; 1/size of a row in m, 1 of a row in rad.
 *   max_squared_distance: infinite, no closed configuration is known.
 */
static void initialize_start_workspace(StartWorkspace *workspace, const Parameters *p)
{
    start_values(p, workspace->guess, workspace->prescribed, workspace->rates);
    for (int k = 0; k < N_Q; k++)
        workspace->weight[k] = k % 3 == 2 ? 1e-2 : 1e-4 / workspace->size;
    for (int i = 0; i < N_GUESS && !GUESSED_POINTS; i++)
        workspace->weight[guess_coordinate[i]] = guess_coordinate[i] % 3 == 2 ? 1.0 : 1.0 / workspace->size;
    for (int k = 0; k < N_Q; k++)
        workspace->column_scale[k] = 1.0 / workspace->weight[k];
    for (int equation = 0; equation < N_ALL_ROWS + N_SET; equation++) {
        const int is_length = equation < N_ALL_ROWS ? row_is_length[equation]
            : set_coordinate[equation - N_ALL_ROWS] % 3 != 2;
        workspace->row_scale[equation] = is_length ? 1.0 / workspace->size : 1.0;
    }
    workspace->max_squared_distance = INFINITY;
}

/*
 * Initialize the workspace and set q to the guess and the prescribed coordinates (others 0), with the angles that
 * equations without positions determine. Store q as reference of distances, and the search radius. Return 1 if those
 * equations depend on each other, else 0.
 */
static int initialize_guess(StartWorkspace *workspace, double t, const Parameters *p, double *q)
{
    initialize_start_workspace(workspace, p);
    for (int k = 0; k < N_Q; k++)
        q[k] = 0.0;
    for (int i = 0; i < N_GUESS; i++)
        q[guess_coordinate[i]] = workspace->guess[i];
    for (int i = 0; i < N_SET; i++)
        q[set_coordinate[i]] = workspace->prescribed[i];
    if (solve_independent_angles(workspace, t, p, q))
        return 1;
    for (int k = 0; k < N_Q; k++)
        workspace->reference[k] = q[k];
    workspace->radius = compute_search_radius(workspace, t, p, q);
    return 0;
}

/*
 * Return the largest change of a guessed angle or position from the guess to q, as a fraction of MAX_ANGLE_CHANGE or
 * MAX_POSITION_CHANGE. From 1 on the search in Python decides.
 */
static double compute_change_from_guess(const StartWorkspace *workspace, const double *q)
{
    double largest = 0.0, change[N_Q] = {0.0};
    for (int i = 0; i < N_GUESS; i++)
        change[guess_coordinate[i]] = q[guess_coordinate[i]] - workspace->reference[guess_coordinate[i]];
    for (int k = 0; k < N_Q; k += 3) {
        const double distance = hypot(change[k], change[k + 1]),
            radius = hypot(workspace->reference[k], workspace->reference[k + 1]);
        largest = max_of(max_of(distance / (MAX_POSITION_CHANGE * max_of(workspace->size, radius)),
            fabs(change[k + 2]) / MAX_ANGLE_CHANGE), largest);
    }
    return largest;
}

/*
 * Return whether the coordinates x and y of all bodies in q are below 1000 times the search radius, workspace->radius
 * (m): the iteration has not diverged. Angles are not tested.
 */
static int are_translations_bounded(const StartWorkspace *workspace, const double *q)
{
    int are_bounded = 1;
    for (int k = 0; k < N_Q; k++)
        are_bounded &= k % 3 == 2 || fabs(q[k]) < 1e3 * workspace->radius;
    return are_bounded;
}

/*
 * Reduce angles in q to within half a turn of the guess. Return 1 if the equations are then no longer closed, because
 * they depend on the number of turns; else 0. Called for mirrored configurations.
 */
static int remove_full_turns(StartWorkspace *workspace, double t, const Parameters *p, double *q)
{
    int has_turned = 0;
    for (int k = 2; k < N_Q; k += 3) {
        const double n_turns = rint((q[k] - workspace->reference[k]) / (2.0 * PI));
        has_turned |= n_turns != 0.0;
        q[k] -= 2.0 * PI * n_turns;
    }
    return has_turned && !are_residuals_rounding(workspace, compute_start_residuals(workspace, t, q, p));
}

/*
 * Replace q by the nearest to the guess of three closed configurations: q, the one with guessed coordinates mirrored at
 * the guess, and the one with all coordinates mirrored; prescribed coordinates keep their values. q stays if its change
 * from the guess is below MIN_MIRRORED_CHANGE. A mirrored configuration is closed anew and reduced by full turns. It is
 * taken only if its distance is smaller by the fraction MIN_DISTANCE_REDUCTION; it is omitted if it does not close or
 * leaves the bounds. Called after a configuration is closed.
 */
static void select_nearest_start(StartWorkspace *workspace, double t, const Parameters *p, double *q)
{
    if (compute_change_from_guess(workspace, q) < MIN_MIRRORED_CHANGE)
        return;
    for (int k = 0; k < N_Q; k++) {
        workspace->first_solution[k] = q[k];
        workspace->mirrored[k] = 2.0 * workspace->reference[k] - q[k];
    }
    for (int mirrors_all = 0; mirrors_all < 2; mirrors_all++) {
        workspace->max_squared_distance = (1.0 - MIN_DISTANCE_REDUCTION) * (1.0 - MIN_DISTANCE_REDUCTION)
            * compute_squared_distance_from_guess(workspace, q);
        for (int k = 0; k < N_Q; k++)
            workspace->trial[k] = mirrors_all ? workspace->mirrored[k] : workspace->first_solution[k];
        for (int i = 0; i < N_GUESS; i++)
            workspace->trial[guess_coordinate[i]] = workspace->mirrored[guess_coordinate[i]];
        for (int i = 0; i < N_SET; i++)
            workspace->trial[set_coordinate[i]] = workspace->prescribed[i];
        if (solve_independent_angles(workspace, t, p, workspace->trial)
            || solve_closure(workspace, t, p, workspace->trial)
            || !are_translations_bounded(workspace, workspace->trial)
            || remove_full_turns(workspace, t, p, workspace->trial)
            || !(compute_squared_distance_from_guess(workspace, workspace->trial)
                < workspace->max_squared_distance))
            continue;
        for (int k = 0; k < N_Q; k++)
            q[k] = workspace->trial[k];
    }
}

/*
 * Compute inverse_root (N_Q), the reciprocal square roots of the diagonal metric of velocities: the mass matrix with
 * moments of inertia of at least MIN_START_INERTIA m size^2.
 */
static void compute_metric_scaling(const StartWorkspace *workspace, const Parameters *p, double *inverse_root)
{
    double m[N_Q];
    mass_matrix(p, m);
    for (int k = 0; k < N_Q; k++) {
        const double min_inertia = k % 3 == 2 ? MIN_START_INERTIA * m[k - 1] * workspace->size * workspace->size : 0.0;
        inverse_root[k] = 1.0 / sqrt(max_of(m[k], min_inertia));
    }
}

/*
 * Compute the velocities v that satisfy Phi_q v = nu and the prescribed rates at q, of minimum norm in the metric M,
 * refined twice. At a jump of a drive, nu is the right limit. Return 1 if the equations depend on each other or are not
 * satisfied to 1e-10, else 0.
 */
OPTIMIZE_SIZE static int compute_start_velocities(StartWorkspace *workspace, double t, const Parameters *p,
    const double *q, double *v)
{
    double inverse_root[N_Q], required[N_START_ROWS + 1], largest = 0.0, largest_residual = 0.0;
    int coordinates[N_Q];
    compute_metric_scaling(workspace, p, inverse_root);
    for (int k = 0; k < N_Q; k++)
        v[k] = 0.0;
    select_leading_equations(workspace, &workspace->subset, N_ALL_ROWS + N_RATES, rate_coordinate);
    jacobian(t, q, p, &workspace->row[0][0]);
    velocity_rhs(get_time_after_jump(t), q, p, required);
    for (int k = 0; k < N_ECCENTRICITIES; k++)
        required[eccentricity_row[k]] -= workspace->rates[N_RATES + k];
    for (int i = 0; i < N_RATES; i++) {
        required[N_ALL_ROWS + i] = workspace->rates[i];
        workspace->row[N_ALL_ROWS + i][rate_coordinate[i]] = 1.0;
    }
    for (int equation = 0; equation < workspace->subset.n; equation++) {
        const int n = list_coordinates_of_equation(equation, rate_coordinate, coordinates);
        for (int i = 0; i < n; i++)
            workspace->row[equation][coordinates[i]] *= inverse_root[coordinates[i]];
        largest = max_of(largest, fabs(required[equation]));
    }
    if (factorize_equations(workspace, &workspace->subset))
        return 1;
    for (int pass = 0; pass <= 3; pass++) {
        largest_residual = 0.0;
        for (int equation = 0; equation < workspace->subset.n; equation++) {
            const int n = list_coordinates_of_equation(equation, rate_coordinate, coordinates);
            workspace->residual[equation] = required[equation];
            for (int i = 0; i < n; i++)
                workspace->residual[equation] -= workspace->row[equation][coordinates[i]] * v[coordinates[i]];
            largest_residual = max_of(largest_residual, fabs(workspace->residual[equation]));
        }
        if (pass == 3)
            break;
        compute_minimum_norm_step(workspace, &workspace->subset);
        for (int k = 0; k < N_Q; k++)
            v[k] += workspace->step[k];
    }
    for (int k = 0; k < N_Q; k++)
        v[k] *= inverse_root[k];
    return !(largest_residual <= 1e-10 * largest + MIN_RESOLVED);
}

/*
 * Compute the start nearest to the guess that the parameters contain. Outputs: coordinates q and velocities v (N_Q
 * each), and *residual, the largest |Phi| or deviation from a prescribed coordinate reached, m or rad. t: time, s;
 * size: of the mechanism, m. Return 0, or 1 if the search in Python must decide: the start does not close, is far from
 * the guess (compute_change_from_guess() of 1 or more) or out of bounds, has no velocities, was cancelled, guesses
 * points, or memory is short. Called for each run of a batch.
 */
int compute_start(
    double t, const double *parameters, double size, double *q, double *v, double *residual, Cancellation *cancellation)
{
    const Parameters *p = (const Parameters *)parameters;
    StartWorkspace *workspace = GUESSED_POINTS ? NULL : allocate_start_workspace(size, cancellation);
    if (!workspace)
        return 1;
    int status = initialize_guess(workspace, t, p, q) || solve_closure(workspace, t, p, q);
    if (!status && compute_change_from_guess(workspace, q) < 1.0)
        select_nearest_start(workspace, t, p, q);
    status = status || !(compute_change_from_guess(workspace, q) < 1.0)
        || !are_translations_bounded(workspace, q); /* another branch may be nearer */
    status = status || compute_start_velocities(workspace, t, p, q, v);
    compute_start_residuals(workspace, t, q, p);
    *residual = 0.0;
    for (int equation = 0; equation < N_ALL_ROWS + N_SET; equation++) {
        const int is_length = equation < N_ALL_ROWS ? row_is_length[equation]
            : set_coordinate[equation - N_ALL_ROWS] % 3 != 2;
        *residual = max_of(*residual, fabs(workspace->residual[equation]) * (is_length ? size : 1.0));
    }
    free(workspace);
    return status;
}

/*
 * Compute the start nearest to the guess that the parameters contain, by compute_start() without cancellation. Outputs:
 * coordinates q and velocities v (N_Q each), and *residual, the largest |Phi| or deviation from a prescribed coordinate
 * reached, m or rad. t: time, s; size: of the mechanism, m. Return 0, or 1 if the search in Python must decide: the
 * start does not close, is far from the guess, has no velocities, guesses points, or memory is short.
 */
int gudgeon_start(double t, const double *parameters, double size, double *q, double *v, double *residual)
{
    Cancellation no_cancellation = {0};
    return compute_start(t, parameters, size, q, v, residual, &no_cancellation);
}

/*
 * Close the configuration q (N_Q) by Newton's method, one of many starts of the search in Python. Angles follow first
 * where equations without positions determine them. size, radius: of the mechanism and of the search, m. Return 0, 1 if
 * it does not close (q: where the steps end), or 2 if equations depend on each other or memory is short.
 */
int gudgeon_close(double t, const double *parameters, double size, double radius, double *q)
{
    const Parameters *p = (const Parameters *)parameters;
    Cancellation no_cancellation = {0};
    StartWorkspace *workspace = allocate_start_workspace(size, &no_cancellation);
    if (!workspace)
        return DEPENDENT_EQUATIONS;
    workspace->radius = radius;
    initialize_start_workspace(workspace, p);
    const int status = solve_independent_angles(workspace, t, p, q) ? DEPENDENT_EQUATIONS
        : solve_closure(workspace, t, p, q);
    free(workspace);
    return status;
}

#if INTEGRATES
/*
 * Return whether the starts of two sets of parameters are equal: all parameters are, that the assembly reads. The sizes
 * of the mechanism are not compared.
 */
int gudgeon_has_equal_start(const double *p, const double *other)
{
    return has_equal_start_parameters((const Parameters *)p, (const Parameters *)other);
}
#endif

/*
 * Continue a closed start to other parameters. q: coordinates of the old start, replaced by Newton's method; v
 * (output): velocities there. size: of the mechanism, m. Equations may depend on each other. Return 0; 1 if q does not
 * close or memory is short; 2 if it has no velocities. The caller checks that q remains near its old value. It cannot
 * be cancelled.
 */
int gudgeon_continuation(double t, const double *parameters, double size, double *q, double *v)
{
    const Parameters *p = (const Parameters *)parameters;
    Cancellation no_cancellation = {0};
    StartWorkspace *workspace = allocate_start_workspace(size, &no_cancellation);
    if (!workspace)
        return 1;
    workspace->dependent = 1;
    initialize_start_workspace(workspace, p);
    workspace->radius = compute_search_radius(workspace, t, p, q);
    int status = solve_closure(workspace, t, p, q);
    if (!status && compute_start_velocities(workspace, t, p, q, v))
        status = 2;
    free(workspace);
    return status;
}
