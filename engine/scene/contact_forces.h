/*
 * Forces of closed contacts of rigid surfaces (Newton's restitution), which keep the gap at zero. Accelerations are
 * affine in these forces F. The right-hand side without them and with each alone determines delta'' = r - G F, with the
 * Delassus operator G, the member D, and the rates a + response F.
 */
#ifndef GUDGEON_CONTACT_FORCES_H
#define GUDGEON_CONTACT_FORCES_H

enum { MAX_RATES = N_S > N_Y ? N_S : N_Y };
#define DEPENDENT_PIVOT 1e-10 /* of D's diagonal: a smaller pivot belongs to a contact that depends on others */

#if N_RIGID_WITH_FRICTION
enum { HAS_FRICTION = 1 };
#else
enum { HAS_FRICTION = 0 };
#endif

/* Compute the rates of a state (evaluate_state_rates() or compute_motion_rates()); returns a status. */
typedef int RatesOf(
    double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dy, RhsOutputs *rhs);

/* The Delassus operator of n closed contacts, and the rates that unit contact forces cause. */
typedef struct {
    int n, joint[N_RIGID];
    double r[N_RIGID];                /* delta'' without forces, m/s^2 */
    double D[N_RIGID][N_RIGID];       /* -d(delta_i'')/dF_j, 1/kg */
    double response[N_RIGID][MAX_RATES];  /* change of all rates by a unit force, each unit a newton */
} Delassus;

/*
 * Return delta'' of a joint in m/s^2, the acceleration of its penetration, from e . e'' + e' . e' = e e'' + e'^2. For a
 * corner at a wall it is known without that division by e.
 */
static double compute_penetration_acceleration(const Clearance *clearance)
{
#ifdef WALLS
    if (clearance->at_wall)
        return clearance->half_square_second_derivative;
#endif
    return (clearance->half_square_second_derivative - clearance->deltadot * clearance->deltadot) / clearance->e;
}

/*
 * List the numbers of the joints with a closed rigid contact in `joints`, in increasing order, and return how many
 * there are.
 */
static int list_closed_contacts(const DiscreteState *discrete, int *joints)
{
    int n = 0;
    for (int i = 0; i < N_CLEARANCES; i++)
        if (!is_compliant(i) && discrete->contact[i].closed)
            joints[n++] = i;
    return n;
}

/*
 * Return the unit force of the Delassus operator in N, whose effect on accelerations is not lost in rounding: the mass
 * of all bodies times the largest |r|, at least 1 m/s^2.
 */
static double choose_unit_force(const Delassus *contacts, const Parameters *p)
{
    double m[N_Q], mass = 0.0, acceleration = 1.0;
    mass_matrix(p, m);
    for (int k = 0; k < N_Q; k += 3)
        mass += m[k];
    for (int k = 0; k < contacts->n; k++)
        acceleration = max_of(acceleration, fabs(contacts->r[k]));
    return mass * acceleration;
}

/*
 * Compute the Delassus operator D of the listed contacts, which `discrete` has closed, their delta'' without forces, r,
 * and the `response` of all n_rates rates to unit forces. evaluate_rates() is called n + 1 times at (t, y). The contact
 * forces in `discrete` are 0 afterwards. Return the status of the evaluations.
 */
static int compute_delassus(RatesOf *evaluate_rates, int n_rates, double t, const double *y, DiscreteState *discrete,
    const Parameters *p, Delassus *contacts)
{
    double rates_without_force[MAX_RATES], rates_with_force[MAX_RATES];
    RhsOutputs rhs;
    for (int k = 0; k < contacts->n; k++)
        discrete->contact[contacts->joint[k]].force = 0.0;
    int status = evaluate_rates(t, y, discrete, p, rates_without_force, &rhs);
    for (int k = 0; k < contacts->n; k++)
        contacts->r[k] = compute_penetration_acceleration(&rhs.clearance[contacts->joint[k]]);
    const double unit_force = choose_unit_force(contacts, p);
    for (int column = 0; column < contacts->n && !status; column++) {
        ContactState *contact = &discrete->contact[contacts->joint[column]];
        contact->force = unit_force;
        status = evaluate_rates(t, y, discrete, p, rates_with_force, &rhs);
        contact->force = 0.0;
        for (int k = 0; k < contacts->n; k++)
            contacts->D[k][column] = (contacts->r[k]
                - compute_penetration_acceleration(&rhs.clearance[contacts->joint[k]])) / unit_force;
        for (int k = 0; k < n_rates; k++)
            contacts->response[column][k] = (rates_with_force[k] - rates_without_force[k]) / unit_force;
    }
    return status;
}

/*
 * Solve D x = r in the contacts with is_included[i] (NULL: all) by Gaussian elimination with diagonal pivoting. x = 0
 * in the others and in dependent contacts. Return whether a pivot is negative beyond rounding, which only friction can
 * cause: without it D is positive semidefinite. Called for forces, impulses and projections of contacts.
 */
static int solve_contact_subset(const Delassus *contacts, const unsigned char *is_included, const double *r, double *x)
{
    const int n = contacts->n;
    double A[N_RIGID][N_RIGID + 1];
    int is_inconsistent = 0, n_solved = 0, pivots[N_RIGID] = {0};
    unsigned char is_remaining[N_RIGID] = {0};
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++)
            A[i][j] = contacts->D[i][j];
        A[i][n] = r[i];
        is_remaining[i] = is_included ? is_included[i] : 1;
        x[i] = 0.0;
    }
    for (;;) {
        int pivot = -1;
        for (int i = 0; i < n; i++)
            if (is_remaining[i] && A[i][i] > DEPENDENT_PIVOT * contacts->D[i][i]
                && (pivot < 0 || A[i][i] > A[pivot][pivot]))
                pivot = i;
        if (pivot < 0)
            break;
        is_remaining[pivot] = 0;
        pivots[n_solved++] = pivot;
        for (int i = 0; i < n; i++) {
            const double fraction = is_remaining[i] ? A[i][pivot] / A[pivot][pivot] : 0.0;
            for (int j = 0; j <= n && fraction != 0.0; j++)
                A[i][j] -= fraction * A[pivot][j];
        }
    }
    for (int i = 0; i < n; i++)
        is_inconsistent |= is_remaining[i] && A[i][i] < -DEPENDENT_PIVOT * fabs(contacts->D[i][i]);
    for (int k = n_solved - 1; k >= 0; k--) {
        const int i = pivots[k];
        double sum = A[i][n];
        for (int j = k + 1; j < n_solved; j++)
            sum -= A[i][pivots[j]] * x[pivots[j]];
        x[i] = sum / A[i][i];
    }
    return is_inconsistent;
}

/*
 * Solve the linear complementarity problem x >= 0, D x - r >= 0, x (D x - r) = 0 by Murty's least-index pivoting (K. G.
 * Murty, Linear Algebra Appl. 9 (1974) 65-108). Sets of contacts with a frictional inconsistency are excluded. Return
 * 0, FRICTION_INCONSISTENT if all other sets fail, or CHATTERING if the iteration does not end. Called for the impulses
 * of an impact and for the active set of contacts.
 */
static inline int solve_complementarity(const Delassus *contacts, const double *r, double *x)
{
    unsigned char is_active[N_RIGID] = {0};
    double scale = 0.0;
    int has_inconsistent_set = 0;
    for (int k = 0; k < contacts->n; k++)
        scale = max_of(scale, fabs(r[k]));
    for (long i = 0; i < 1000L << (N_RIGID < 10 ? N_RIGID : 10); i++) {
        int changed = -1;
        const int is_inconsistent = solve_contact_subset(contacts, is_active, r, x) && HAS_FRICTION;
        has_inconsistent_set |= is_inconsistent;
        for (int k = 0; k < contacts->n && changed < 0; k++) {
            double slack = -r[k];
            for (int j = 0; j < contacts->n; j++)
                slack += contacts->D[k][j] * x[j];
            if (is_inconsistent ? is_active[k] : is_active[k] ? x[k] * contacts->D[k][k] < -1e-14 * scale
                : slack < -1e-12 * scale)
                changed = k;
        }
        if (changed < 0)
            return 0;
        is_active[changed] = !is_active[changed];
    }
    return has_inconsistent_set ? FRICTION_INCONSISTENT : CHATTERING;
}

#if N_RIGID_WITH_FRICTION
/*
 * Return whether a normal force in some closed contact, with its friction, accelerates the surfaces towards each other
 * (P. Painleve, 1895): a diagonal entry of D is negative beyond rounding. only_approaching: consider only contacts that
 * need a force, r > 0.
 */
static int has_frictional_inconsistency(const Delassus *contacts, int only_approaching, const Parameters *p)
{
    double m[N_Q], mass = 0.0;
    mass_matrix(p, m);
    for (int k = 0; k < N_Q; k += 3)
        mass += m[k];
    for (int k = 0; k < contacts->n; k++)
        if (contacts->D[k][k] * mass < -DEPENDENT_PIVOT && (!only_approaching || contacts->r[k] > 0.0))
            return 1;
    return 0;
}
#else
/* Return 0, no inconsistency: without friction no diagonal entry of D is negative. */
static inline int has_frictional_inconsistency(const Delassus *contacts, int only_approaching, const Parameters *p)
{
    return (void)contacts, (void)only_approaching, (void)p, 0;
}
#endif

/*
 * Compute the rates dy and outputs rhs of a state with the forces of its closed rigid contacts, which are stored in
 * `discrete`. All closed contacts are active: D F = r is solved, and a negative F, a pull, is an event for the caller.
 * evaluate_rates: the right-hand side for given forces, with n_rates rates. Return 0, FRICTION_INCONSISTENT if D has a
 * negative diagonal entry or pivot, or the status of an evaluation. Called at each evaluation of the right-hand side of
 * a scene with rigid contacts.
 */
static int compute_rates_in_contact(RatesOf *evaluate_rates, int n_rates, double t, const double *y,
    DiscreteState *discrete, const Parameters *p, double *dy, RhsOutputs *rhs)
{
    Delassus contacts;
    contacts.n = list_closed_contacts(discrete, contacts.joint);
    if (contacts.n) {
        double force[N_RIGID];
        const int status = compute_delassus(evaluate_rates, n_rates, t, y, discrete, p, &contacts);
        if (status)
            return status;
        if (has_frictional_inconsistency(&contacts, 0, p))
            return FRICTION_INCONSISTENT;
        if (solve_contact_subset(&contacts, NULL, contacts.r, force) && HAS_FRICTION)
            return FRICTION_INCONSISTENT; /* together they are inconsistent */
        for (int k = 0; k < contacts.n; k++)
            discrete->contact[contacts.joint[k]].force = force[k];
    }
    return evaluate_rates(t, y, discrete, p, dy, rhs);
}

#endif
