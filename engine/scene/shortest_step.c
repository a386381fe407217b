/*
 * Newton steps for linearized constraint equations: the minimum-norm step and the least-squares step. The minimum-norm
 * step follows from the normal equations, by sparse Cholesky factorization. The sparsity follows from the pattern of
 * Phi_q.
 */
#include "../run/cancellation.h"
#include "calls.h"

#if !N_ECCENTRICITIES
static const int eccentricity_row[] = {0};
#endif

enum {
    N_START_ROWS = N_ALL_ROWS + (N_SET > N_RATES ? N_SET : N_RATES),
    N_NORMAL = N_START_ROWS > N_Q ? N_START_ROWS : N_Q
};

/* The pattern of a normal matrix: its equations, those with an entry for each coordinate, the nonzeros of its factor.
 * For the least-squares step, coordinates replace equations. */
typedef struct {
    int n;
    short row[N_NORMAL + 1], equations_of[N_Q][N_START_ROWS + 1], n_equations_of[N_Q];
    short factor_entries[N_NORMAL + 1][N_NORMAL + 1], n_factor_entries[N_NORMAL + 1];
} EquationSystem;

/* Workspace of a start: linearized equations with residuals (columns divided by weights), a normal matrix (upper half)
 * and the reciprocal diagonal of its factor, guess and prescribed values, patterns. */
typedef struct {
    double size, radius, weight[N_Q], step[N_Q], reference[N_Q];
    double first_solution[N_Q], mirrored[N_Q], trial[N_Q];
    double guess[N_GUESS + 1], prescribed[N_SET + N_ECCENTRICITIES + 1], rates[N_RATES + N_ECCENTRICITIES + 1];
    double row[N_START_ROWS + 1][N_Q], residual[N_START_ROWS + 1], row_scale[N_START_ROWS + 1], column_scale[N_Q];
    double normal[N_NORMAL + 1][N_NORMAL + 1], inverse_pivot[N_NORMAL + 1], rhs[N_NORMAL + 1];
    unsigned char pattern[N_NORMAL + 1][N_NORMAL + 1];
    EquationSystem first_step, all, subset;
    double max_squared_distance; /* squared distance from the guess that a configuration must improve on */
    int dependent;  /* whether dependent equations are left out: the residuals show if they do not close */
    Cancellation *cancellation;
} StartWorkspace;

/*
 * List the coordinates with an entry in an equation of a start into `coordinates` (at most N_Q), and return their
 * number. Equations from N_ALL_ROWS on have one entry each, set_coordinates[equation - N_ALL_ROWS].
 */
static int list_coordinates_of_equation(int equation, const int *set_coordinates, int *coordinates)
{
    int count = 0;
    if (equation >= N_ALL_ROWS)
        coordinates[count++] = set_coordinates[equation - N_ALL_ROWS];
    else
        for (int entry = phi_q_first[equation]; entry < phi_q_first[equation + 1]; entry++)
            coordinates[count++] = phi_q_column[entry];
    return count;
}

/*
 * Compute the nonzeros of the Cholesky factor of a normal matrix (symbolic factorization) into `system`. The pattern in
 * the workspace (upper half) is completed by the fill-in.
 */
OPTIMIZE_SIZE static void compute_fill_in(StartWorkspace *workspace, EquationSystem *system)
{
    for (int k = 0; k < system->n; k++) {
        short *entries = system->factor_entries[k];
        int n_filled = 0;
        for (int i = k + 1; i < system->n; i++)
            if (workspace->pattern[k][i])
                entries[n_filled++] = (short)i;
        system->n_factor_entries[k] = (short)n_filled;
        for (int a = 0; a < n_filled; a++)
            for (int b = a + 1; b < n_filled; b++)
                workspace->pattern[entries[a]][entries[b]] = 1;
    }
}

/* Clear the pattern of an n x n matrix in the workspace (upper half). */
static void clear_pattern(StartWorkspace *workspace, int n)
{
    for (int i = 0; i < n; i++)
        for (int j = i; j < n; j++)
            workspace->pattern[i][j] = 0;
}

/*
 * Compute the pattern of the normal matrix row row^T of the equations of `system`, and the nonzeros of its factor. Two
 * equations have a nonzero if they have a common coordinate. set_coordinates: coordinates of the equations after the
 * constraint equations.
 */
OPTIMIZE_SIZE static void compute_normal_pattern(StartWorkspace *workspace, EquationSystem *system,
    const int *set_coordinates)
{
    int coordinates[N_Q];
    for (int k = 0; k < N_Q; k++)
        system->n_equations_of[k] = 0;
    for (int i = 0; i < system->n; i++) {
        const int n = list_coordinates_of_equation(system->row[i], set_coordinates, coordinates);
        for (int a = 0; a < n; a++)
            system->equations_of[coordinates[a]][system->n_equations_of[coordinates[a]]++] = (short)i;
    }
    clear_pattern(workspace, system->n);
    for (int k = 0; k < N_Q; k++)
        for (int a = 0; a < system->n_equations_of[k]; a++)
            for (int b = a + 1; b < system->n_equations_of[k]; b++)
                workspace->pattern[system->equations_of[k][a]][system->equations_of[k][b]] = 1;
    compute_fill_in(workspace, system);
}

/*
 * Set a system to the equations 0 ... n - 1 and compute its pattern. set_coordinates: coordinates of the equations
 * after the constraint equations.
 */
static void select_leading_equations(
    StartWorkspace *workspace, EquationSystem *system, int n, const int *set_coordinates)
{
    system->n = n;
    for (int equation = 0; equation < n; equation++)
        system->row[equation] = (short)equation;
    compute_normal_pattern(workspace, system, set_coordinates);
}

/* Set the nonzeros of the normal matrix of a system to zero. */
static void clear_normal_matrix(StartWorkspace *workspace, const EquationSystem *system)
{
    for (int k = 0; k < system->n; k++) {
        workspace->normal[k][k] = 0.0;
        for (int a = 0; a < system->n_factor_entries[k]; a++)
            workspace->normal[k][system->factor_entries[k][a]] = 0.0;
    }
}

/*
 * Factorize the normal matrix U^T U of a system by sparse Cholesky factorization, by rows of its upper half, in place.
 * Return 1 if a pivot is not finite or at most 1e-12 of its diagonal entry, or on cancellation; else 0. With
 * workspace->dependent, equations with a small pivot are left out instead.
 */
OPTIMIZE_SIZE static int factorize_normal_matrix(StartWorkspace *workspace, const EquationSystem *system)
{
    double *diagonal = workspace->rhs; /* not yet in use */
    for (int k = 0; k < system->n; k++)
        diagonal[k] = workspace->normal[k][k];
    for (int k = 0; k < system->n; k++) {
        double *u = workspace->normal[k];
        const short *entries = system->factor_entries[k];
        const int n_filled = system->n_factor_entries[k], is_pivot = u[k] > 1e-12 * diagonal[k];
        if (is_cancelled(workspace->cancellation))
            return 1;
        if (!isfinite(diagonal[k]) || (!is_pivot && !workspace->dependent))
            return 1;
        const double inverse_pivot = is_pivot ? 1.0 / sqrt(u[k]) : 0.0; /* 0: its unknown is 0 */
        workspace->inverse_pivot[k] = inverse_pivot;
        for (int a = 0; a < n_filled; a++)
            u[entries[a]] *= inverse_pivot;
        for (int a = 0; a < n_filled; a++) {
            const double factor = u[entries[a]];
            double *below = workspace->normal[entries[a]];
            for (int b = a; b < n_filled; b++)
                below[entries[b]] -= factor * u[entries[b]];
        }
    }
    return 0;
}

/*
 * Solve the factorized normal system of equations by forward and back substitution in workspace->rhs: right-hand side
 * on entry, solution on return.
 */
static void solve_normal_system(StartWorkspace *workspace, const EquationSystem *system)
{
    for (int k = 0; k < system->n; k++) {
        const double *u = workspace->normal[k];
        workspace->rhs[k] *= workspace->inverse_pivot[k];
        for (int a = 0; a < system->n_factor_entries[k]; a++)
            workspace->rhs[system->factor_entries[k][a]] -= u[system->factor_entries[k][a]] * workspace->rhs[k];
    }
    for (int k = system->n - 1; k >= 0; k--) {
        for (int a = 0; a < system->n_factor_entries[k]; a++)
            workspace->rhs[k] -= workspace->normal[k][system->factor_entries[k][a]]
                * workspace->rhs[system->factor_entries[k][a]];
        workspace->rhs[k] *= workspace->inverse_pivot[k];
    }
}

/*
 * Compute and factorize the normal matrix row row^T of the equations of a system. Return the result of
 * factorize_normal_matrix(): 1 for dependent equations or on cancellation, else 0.
 */
static int factorize_equations(StartWorkspace *workspace, const EquationSystem *system)
{
    double entry[N_START_ROWS + 1];
    clear_normal_matrix(workspace, system);
    for (int k = 0; k < N_Q; k++) {
        const short *equations = system->equations_of[k];
        const int n = system->n_equations_of[k];
        for (int a = 0; a < n; a++)
            entry[a] = workspace->row[system->row[equations[a]]][k];
        for (int a = 0; a < n; a++)
            for (int b = a; b < n; b++)
                workspace->normal[equations[a]][equations[b]] += entry[a] * entry[b];
    }
    return factorize_normal_matrix(workspace, system);
}

/*
 * Compute the minimum-norm step that satisfies row step = residual from the factorized equations of a system: step =
 * row^T x, where row row^T x = residual. The result is workspace->step (N_Q); workspace->rhs is overwritten.
 */
static void compute_minimum_norm_step(StartWorkspace *workspace, const EquationSystem *system)
{
    for (int i = 0; i < system->n; i++)
        workspace->rhs[i] = workspace->residual[system->row[i]];
    solve_normal_system(workspace, system);
    for (int k = 0; k < N_Q; k++) {
        workspace->step[k] = 0.0;
        for (int a = 0; a < system->n_equations_of[k]; a++)
            workspace->step[k] += workspace->row[system->row[system->equations_of[k][a]]][k]
                * workspace->rhs[system->equations_of[k][a]];
    }
}

/*
 * Compute the pattern of row^T row into `system`, and the nonzeros of its factor. Two coordinates have a nonzero if an
 * equation contains both.
 */
static void compute_coordinate_pattern(StartWorkspace *workspace, EquationSystem *system)
{
    int coordinates[N_Q];
    system->n = N_Q;
    clear_pattern(workspace, N_Q);
    for (int equation = 0; equation < N_ALL_ROWS + N_SET; equation++) {
        const int n = list_coordinates_of_equation(equation, set_coordinate, coordinates);
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++)
                workspace->pattern[coordinates[i]][coordinates[j]] = 1;
    }
    compute_fill_in(workspace, system);
}

/*
 * Compute the matrix row^T row of all equations in workspace->normal (upper half), for positions only; rows of angles
 * stay zero.
 */
static void compute_position_matrix(StartWorkspace *workspace, const EquationSystem *system)
{
    int coordinates[N_Q];
    clear_normal_matrix(workspace, system);
    for (int equation = 0; equation < N_ALL_ROWS + N_SET; equation++) {
        const int n = list_coordinates_of_equation(equation, set_coordinate, coordinates);
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n && coordinates[i] % 3 != 2; j++)
                if (coordinates[j] % 3 != 2 && coordinates[j] >= coordinates[i])
                    workspace->normal[coordinates[i]][coordinates[j]] += workspace->row[equation][coordinates[i]]
                        * workspace->row[equation][coordinates[j]];
    }
}

/*
 * Compute row^T (residual - row step) - damping step in workspace->rhs, the right-hand side of the least-squares step,
 * for positions only.
 */
static void compute_position_rhs(StartWorkspace *workspace, double damping)
{
    int coordinates[N_Q];
    for (int k = 0; k < N_Q; k++)
        workspace->rhs[k] = -damping * workspace->step[k];
    for (int equation = 0; equation < N_ALL_ROWS + N_SET; equation++) {
        const int n = list_coordinates_of_equation(equation, set_coordinate, coordinates);
        double residual = workspace->residual[equation];
        for (int i = 0; i < n; i++)
            residual -= workspace->row[equation][coordinates[i]] * workspace->step[coordinates[i]];
        for (int i = 0; i < n; i++)
            if (coordinates[i] % 3 != 2)
                workspace->rhs[coordinates[i]] += workspace->row[equation][coordinates[i]] * residual;
    }
}

/*
 * Compute the damped least-squares step of positions (Levenberg-Marquardt), with which Newton's method begins, into
 * workspace->step; angles stay. It is refined once: along directions without equations the damped matrix has six digits
 * only. Return 1 if the factorization fails, else 0.
 */
static int compute_least_squares_step(StartWorkspace *workspace)
{
    EquationSystem *system = &workspace->first_step;
    double trace = 0.0;
    if (!system->n)
        compute_coordinate_pattern(workspace, system);
    compute_position_matrix(workspace, system);
    for (int k = 0; k < N_Q; k++)
        trace += workspace->normal[k][k];
    const double damping = 1e-10 * trace + 1e-300;
    for (int k = 0; k < N_Q; k++) {
        workspace->normal[k][k] += damping;
        workspace->step[k] = 0.0;
    }
    if (factorize_normal_matrix(workspace, system))
        return 1;
    for (int pass = 0; pass < 2; pass++) {
        compute_position_rhs(workspace, damping);
        solve_normal_system(workspace, system);
        for (int k = 0; k < N_Q; k++)
            workspace->step[k] += workspace->rhs[k];
    }
    return 0;
}
