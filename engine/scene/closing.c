/*
 * Assembly (closing) of a linkage by Newton's method with minimum-norm steps of the linearized constraint equations.
 * The same method is in Python (closure.py). Returns 1 where equations depend on each other, or no step improves.
 */
#include "shortest_step.c"

#define MAX_REUSE_NORM 1e-6 /* below this norm a factorization is reused while steps reduce the norm tenfold */
#define CLOSING_ROUNDING 1e-14  /* of the norm, times the distance of the linkage from the origin: rounding */

enum { MAX_CLOSING_ITERATIONS = 60 };

/* Results of Newton's method that does not close the equations. */
enum { NOT_CLOSED_BY_NEWTON = 1, DEPENDENT_EQUATIONS = 2 };

/*
 * Compute the residuals of the start into workspace->residual: -Phi (with the prescribed eccentricities of journals),
 * then the differences from the prescribed coordinates, each multiplied by its row scale. Return their Euclidean norm.
 */
static double compute_start_residuals(StartWorkspace *workspace, double t, const double *q, const Parameters *p)
{
    double sum = 0.0;
    constraints(t, q, p, workspace->residual);
    for (int k = 0; k < N_ECCENTRICITIES; k++)
        workspace->residual[eccentricity_row[k]] += workspace->prescribed[N_SET + k];
    for (int r = 0; r < N_ALL_ROWS; r++)
        workspace->residual[r] = -workspace->residual[r];
    for (int i = 0; i < N_SET; i++)
        workspace->residual[N_ALL_ROWS + i] = workspace->prescribed[i] - q[set_coordinate[i]];
    for (int r = 0; r < N_ALL_ROWS + N_SET; r++) {
        workspace->residual[r] *= workspace->row_scale[r];
        sum += workspace->residual[r] * workspace->residual[r];
    }
    return sqrt(sum);
}

/*
 * Compute the linearized equations workspace->row (Phi_q, then the prescribed coordinates), multiplied by row and
 * column scales, and the residuals. Return the norm of the residuals.
 */
OPTIMIZE_SIZE static double linearize_start_equations(
    StartWorkspace *workspace, double t, const double *q, const Parameters *p)
{
    jacobian(t, q, p, &workspace->row[0][0]);
    for (int row = 0; row < N_ALL_ROWS; row++)
        for (int entry = phi_q_first[row]; entry < phi_q_first[row + 1]; entry++)
            workspace->row[row][phi_q_column[entry]] *= workspace->row_scale[row]
                * workspace->column_scale[phi_q_column[entry]];
    for (int k = 0; k < N_SET; k++)
        workspace->row[N_ALL_ROWS + k][set_coordinate[k]] = workspace->row_scale[N_ALL_ROWS + k]
            * workspace->column_scale[set_coordinate[k]];
    return compute_start_residuals(workspace, t, q, p);
}

/*
 * Solve for the angles in q that equations without positions determine (drives, sliders), by one minimum-norm linear
 * step. Return 1 if these equations depend on each other, else 0.
 */
OPTIMIZE_SIZE static int solve_independent_angles(StartWorkspace *workspace, double t, const Parameters *p, double *q)
{
    int coordinates[N_Q];
    linearize_start_equations(workspace, t, q, p);
    workspace->subset.n = 0;
    for (int row = 0; row < N_ALL_ROWS + N_SET; row++) {
        int has_position = 0;
        const int n = list_coordinates_of_equation(row, set_coordinate, coordinates);
        for (int i = 0; i < n; i++)
            has_position |= coordinates[i] % 3 != 2 && workspace->row[row][coordinates[i]] != 0.0;
        if (!has_position)
            workspace->subset.row[workspace->subset.n++] = (short)row;
    }
    compute_normal_pattern(workspace, &workspace->subset, set_coordinate);
    if (factorize_equations(workspace, &workspace->subset))
        return 1;
    compute_minimum_norm_step(workspace, &workspace->subset);
    for (int k = 0; k < N_Q; k++)
        q[k] += workspace->step[k] * workspace->column_scale[k];
    return 0;
}

/* Return the squared weighted distance of q from the guess; full turns of angles are not removed. */
static double compute_squared_distance_from_guess(const StartWorkspace *workspace, const double *q)
{
    double sum = 0.0;
    for (int k = 0; k < N_Q; k++)
        sum += (q[k] - workspace->reference[k]) * workspace->weight[k] * (q[k] - workspace->reference[k])
            * workspace->weight[k];
    return sum;
}

/*
 * Return whether a norm of residuals is rounding only: below 1e-10 plus CLOSING_ROUNDING times the search radius over
 * the size.
 */
static int are_residuals_rounding(const StartWorkspace *workspace, double residual_norm)
{
    return residual_norm < 1e-10 + CLOSING_ROUNDING * workspace->radius / workspace->size;
}

/*
 * Return whether Newton's steps converge to a configuration that is no nearer to the guess than the nearest known one,
 * workspace->max_squared_distance. remaining_fraction: the fraction of the residuals that the last step left; the
 * following steps are smaller by as much. Return 0 if it is 0.1 or more: slow convergence is inconclusive.
 */
static int is_not_nearer_to_guess(const StartWorkspace *workspace, const double *q, double remaining_fraction)
{
    double step_squared = 0.0, distance_squared = 0.0;
    for (int k = 0; k < N_Q; k++) {
        const double difference = q[k] - workspace->reference[k];
        const double n_turns = k % 3 == 2 ? rint(difference / (2.0 * PI)) : 0.0; /* see remove_full_turns() */
        const double scaled = (difference - 2.0 * PI * n_turns) * workspace->weight[k];
        step_squared += workspace->step[k] * workspace->step[k];
        distance_squared += scaled * scaled;
    }
    return remaining_fraction < 0.1
        && sqrt(distance_squared) - 4.0 * remaining_fraction * sqrt(step_squared)
            > sqrt(workspace->max_squared_distance);
}

/*
 * Solve the constraint equations for q by Newton's method with line search; the first step is for positions only.
 * Factorizations are reused near the solution. Equations closed to rounding leave q unchanged to the bit. Return
 * NOT_CLOSED_BY_NEWTON also if they lead to no configuration nearer to the guess, DEPENDENT_EQUATIONS also on
 * cancellation; else 0.
 */
OPTIMIZE_SIZE static int solve_closure(StartWorkspace *workspace, double t, const Parameters *p, double *q)
{
    const double rounding = CLOSING_ROUNDING * workspace->radius / workspace->size;
    double q_trial[N_Q];
    int is_reused = 0; /* factorization and equations are those of an earlier q */
    if (!workspace->all.n)
        select_leading_equations(workspace, &workspace->all, N_ALL_ROWS + N_SET, set_coordinate);
    double norm = linearize_start_equations(workspace, t, q, p);
    if (norm < rounding) /* also at a double root, where equations depend on each other */
        return 0;
    if (compute_least_squares_step(workspace))
        return DEPENDENT_EQUATIONS;
    for (int k = 0; k < N_Q; k++)
        q[k] += workspace->step[k] * workspace->column_scale[k];
    norm = compute_start_residuals(workspace, t, q, p);
    for (int i = 0; i < MAX_CLOSING_ITERATIONS; i++) {
        if (!is_reused) {
            linearize_start_equations(workspace, t, q, p);
            if (factorize_equations(workspace, &workspace->all))
                return DEPENDENT_EQUATIONS;
        }
        compute_minimum_norm_step(workspace, &workspace->all);
        double fraction = 1.0, norm_trial = norm;
        for (; fraction > (is_reused ? 0.5 : 1e-4); fraction *= 0.5) {
            for (int k = 0; k < N_Q; k++)
                q_trial[k] = q[k] + fraction * (workspace->step[k] * workspace->column_scale[k]);
            norm_trial = compute_start_residuals(workspace, t, q_trial, p);
            if (norm_trial < (1.0 - 1e-4 * fraction) * norm)
                break;
        }
        if (!(fraction > (is_reused ? 0.5 : 1e-4))) {
            if (!is_reused || norm < rounding)
                break;
            is_reused = 0;
            continue;
        }
        for (int k = 0; k < N_Q; k++)
            q[k] = q_trial[k];
        if (fraction == 1.0 && is_not_nearer_to_guess(workspace, q, norm_trial / norm))
            return NOT_CLOSED_BY_NEWTON;
        is_reused = norm_trial < MAX_REUSE_NORM && (norm_trial < 0.1 * norm || norm_trial < rounding);
        norm = norm_trial;
    }
    return are_residuals_rounding(workspace, norm) ? 0 : NOT_CLOSED_BY_NEWTON;
}
