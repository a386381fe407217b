/*
 * Forces of closed rigid contacts (Newton's restitution), which keep e = c. Accelerations are affine in these forces F.
 * The right-hand side without them and with each alone gives delta'' = r - D F, with the Delassus operator D, and the
 * rates a + way F.
 */
#ifndef GUDGEON_CONTACT_FORCES_H
#define GUDGEON_CONTACT_FORCES_H

enum { MAX_RATES = N_S > N_Y ? N_S : N_Y };
#define DEPENDENT 1e-10 /* of D's diagonal: a smaller pivot belongs to a contact that depends on others */

#if N_RUBBED
enum { RUBS = 1 };
#else
enum { RUBS = 0 };
#endif

/* Compute the rates of a state (state_rates() or motion()); returns a status. */
typedef int RatesOf(
    double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dy, RhsOutputs *rhs);

/* The Delassus operator of n closed contacts, and the rates that unit contact forces cause. */
typedef struct {
    int n, joint[N_RIGID];
    double r[N_RIGID];                /* delta'' without forces, m/s^2 */
    double D[N_RIGID][N_RIGID];       /* -d(delta_i'')/dF_j, 1/kg */
    double way[N_RIGID][MAX_RATES];  /* change of all rates by a unit force, each unit a newton */
} Delassus;

/* Return delta'' of a joint, m/s^2, from e . e'' + e' . e' = e e'' + e'^2; of a corner at a wall it is known. */
static double outward_rate(const Clearance *joint)
{
#ifdef WALLS
    if (joint->at_wall)
        return joint->half_square_rate;
#endif
    return (joint->half_square_rate - joint->deltadot * joint->deltadot) / joint->e;
}

/* List the closed rigid contacts in `joint`. Returns their number. */
static int list_closed(const DiscreteState *discrete, int *joint)
{
    int n = 0;
    for (int i = 0; i < N_CLEARANCES; i++)
        if (!gives(i) && discrete->contact[i].closed)
            joint[n++] = i;
    return n;
}

/* Return a force, N, whose effect on the accelerations of these bodies is not lost in rounding. */
static double unit_force(const Delassus *contacts, const Parameters *p)
{
    double m[N_Q], mass = 0.0, most = 1.0;
    mass_matrix(p, m);
    for (int k = 0; k < N_Q; k += 3)
        mass += m[k];
    for (int k = 0; k < contacts->n; k++)
        most = max_of(most, fabs(contacts->r[k]));
    return mass * most;
}

/*
 * Compute r, D and `way` of the listed contacts, which `discrete` has closed, by n + 1 right-hand sides. Their forces
 * in `discrete` are 0 afterwards. Returns a status.
 */
static int compute_delassus(RatesOf *rates_of, int size, double t, const double *y, DiscreteState *discrete,
    const Parameters *p, Delassus *contacts)
{
    double base[MAX_RATES], pushed[MAX_RATES];
    RhsOutputs rhs;
    for (int k = 0; k < contacts->n; k++)
        discrete->contact[contacts->joint[k]].force = 0.0;
    int status = rates_of(t, y, discrete, p, base, &rhs);
    for (int k = 0; k < contacts->n; k++)
        contacts->r[k] = outward_rate(&rhs.clearance[contacts->joint[k]]);
    const double unit = unit_force(contacts, p);
    for (int j = 0; j < contacts->n && !status; j++) {
        ContactState *contact = &discrete->contact[contacts->joint[j]];
        contact->force = unit;
        status = rates_of(t, y, discrete, p, pushed, &rhs);
        contact->force = 0.0;
        for (int k = 0; k < contacts->n; k++)
            contacts->D[k][j] = (contacts->r[k] - outward_rate(&rhs.clearance[contacts->joint[k]])) / unit;
        for (int k = 0; k < size; k++)
            contacts->way[j][k] = (pushed[k] - base[k]) / unit;
    }
    return status;
}

/*
 * Solve D x = r in the contacts with part[i] (NULL: all) by Gaussian elimination with diagonal pivoting. x = 0 in the
 * others and in dependent contacts. Returns whether a pivot is negative beyond rounding; that needs friction, because D
 * is symmetric without it.
 */
static int solve_part(const Delassus *contacts, const unsigned char *part, const double *r, double *x)
{
    const int n = contacts->n;
    double A[N_RIGID][N_RIGID + 1];
    int is_jammed = 0, solved = 0, order[N_RIGID] = {0};
    unsigned char left[N_RIGID] = {0};
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++)
            A[i][j] = contacts->D[i][j];
        A[i][n] = r[i];
        left[i] = part ? part[i] : 1;
        x[i] = 0.0;
    }
    for (;;) {
        int next = -1;
        for (int i = 0; i < n; i++)
            if (left[i] && A[i][i] > DEPENDENT * contacts->D[i][i] && (next < 0 || A[i][i] > A[next][next]))
                next = i;
        if (next < 0)
            break;
        left[next] = 0;
        order[solved++] = next;
        for (int i = 0; i < n; i++) {
            const double fraction = left[i] ? A[i][next] / A[next][next] : 0.0;
            for (int j = 0; j <= n && fraction != 0.0; j++)
                A[i][j] -= fraction * A[next][j];
        }
    }
    for (int i = 0; i < n; i++)
        is_jammed |= left[i] && A[i][i] < -DEPENDENT * fabs(contacts->D[i][i]);
    for (int k = solved - 1; k >= 0; k--) {
        const int i = order[k];
        double sum = A[i][n];
        for (int l = k + 1; l < solved; l++)
            sum -= A[i][order[l]] * x[order[l]];
        x[i] = sum / A[i][i];
    }
    return is_jammed;
}

/*
 * Solve the linear complementarity problem x >= 0, D x - r >= 0, x (D x - r) = 0 by Murty's least-index pivoting (K. G.
 * Murty, Linear Algebra Appl. 9 (1974) 65-108). Sets of contacts that jam by friction are excluded. Returns 0,
 * FRICTION_INCONSISTENT if all other sets fail, or CHATTERING.
 */
static inline int complementary(const Delassus *contacts, const double *r, double *x)
{
    unsigned char pushes[N_RIGID] = {0};
    double size = 0.0;
    int some = 0;
    for (int k = 0; k < contacts->n; k++)
        size = max_of(size, fabs(r[k]));
    for (long i = 0; i < 1000L << (N_RIGID < 10 ? N_RIGID : 10); i++) {
        int turned = -1;
        const int is_jammed = solve_part(contacts, pushes, r, x) && RUBS;
        some |= is_jammed;
        for (int k = 0; k < contacts->n && turned < 0; k++) {
            double left = -r[k];
            for (int j = 0; j < contacts->n; j++)
                left += contacts->D[k][j] * x[j];
            if (is_jammed ? pushes[k] : pushes[k] ? x[k] * contacts->D[k][k] < -1e-14 * size : left < -1e-12 * size)
                turned = k;
        }
        if (turned < 0)
            return 0;
        pushes[turned] = !pushes[turned];
    }
    return some ? FRICTION_INCONSISTENT : CHATTERING;
}

#if N_RUBBED
/*
 * Return whether a normal force in some closed contact, with its friction, brings the surfaces nearer (P. Painleve,
 * 1895). needed: consider only contacts that need a force.
 */
static int is_frictionally_inconsistent(const Delassus *contacts, int needed, const Parameters *p)
{
    double m[N_Q], mass = 0.0;
    mass_matrix(p, m);
    for (int k = 0; k < N_Q; k += 3)
        mass += m[k];
    for (int k = 0; k < contacts->n; k++)
        if (contacts->D[k][k] * mass < -DEPENDENT && (!needed || contacts->r[k] > 0.0))
            return 1;
    return 0;
}
#else
/* Return 0: without friction no diagonal entry of D is negative. */
static inline int is_frictionally_inconsistent(const Delassus *contacts, int needed, const Parameters *p)
{
    return (void)contacts, (void)needed, (void)p, 0;
}
#endif

/*
 * Compute the rates of a state with the forces of its closed contacts, which are stored in `discrete`. Returns a
 * status.
 */
static int rates_in_contact(RatesOf *rates_of, int size, double t, const double *y, DiscreteState *discrete,
    const Parameters *p, double *dy, RhsOutputs *rhs)
{
    Delassus contacts;
    contacts.n = list_closed(discrete, contacts.joint);
    if (contacts.n) {
        double force[N_RIGID];
        const int status = compute_delassus(rates_of, size, t, y, discrete, p, &contacts);
        if (status)
            return status;
        if (is_frictionally_inconsistent(&contacts, 0, p))
            return FRICTION_INCONSISTENT;
        if (solve_part(&contacts, NULL, contacts.r, force) && RUBS)
            return FRICTION_INCONSISTENT; /* together they are inconsistent */
        for (int k = 0; k < contacts.n; k++)
            discrete->contact[contacts.joint[k]].force = force[k];
    }
    return rates_of(t, y, discrete, p, dy, rhs);
}

#endif
