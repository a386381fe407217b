/*
 * Forces between surfaces that do not give (Newton's restitution): in a closed contact whatever keeps e = c. All
 * accelerations are affine in these forces, so the right-hand side without them, and with each of them alone, tells
 * delta'' = r - D F and the rates a + way F: with the joints, drives and sticks that there are.
 */
#ifndef GUDGEON_CONTACT_FORCES_H
#define GUDGEON_CONTACT_FORCES_H

enum { MOST_RATES = N_S > N_Y ? N_S : N_Y };
#define DEPENDENT 1e-10 /* of D's diagonal: less is left of a contact that others hold already */

#if N_RUBBED
enum { RUBS = 1 };
#else
enum { RUBS = 0 };
#endif

typedef int RatesOf(
    double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dy, RhsOutputs *rhs);

/* How contacts answer to a unit force in each of them. */
typedef struct {
    int n, joint[N_RIGID];
    double r[N_RIGID];                /* delta'' without forces, m/s^2 */
    double D[N_RIGID][N_RIGID];       /* what a force in column j takes from that of row i, 1/kg */
    double way[N_RIGID][MOST_RATES];  /* rates that it adds, each unit a newton */
} Delassus;

/* delta'' from e . e'' + e' . e' = e e'' + e'^2; of a corner at a wall it is known. */
static double outward_rate(const Clearance *joint)
{
#ifdef WALLS
    if (joint->at_wall)
        return joint->half_square_rate;
#endif
    return (joint->half_square_rate - joint->deltadot * joint->deltadot) / joint->e;
}

static int list_closed(const DiscreteState *discrete, int *joint)
{
    int n = 0;
    for (int i = 0; i < N_CLEARANCES; i++)
        if (!gives(i) && discrete->contact[i].closed)
            joint[n++] = i;
    return n;
}

/* A force that bodies of these masses notice beside such accelerations, N: what is added is not lost in rounding. */
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

/* Fills the answer of the listed contacts, which `discrete` has closed; their forces are 0 then. */
static int compute_delassus(RatesOf *rates_of, int size, double t, const double *y, DiscreteState *discrete,
    const Parameters *p, Delassus *contacts)
{
    double base[MOST_RATES], pushed[MOST_RATES];
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
 * D x = r in the contacts that take part (NULL: all), x = 0 in the others and in those that depend on what was solved
 * before (Gauss's elimination, the largest diagonal first). Returns whether a pivot is negative beside rounding:
 * with friction only, for without it D is symmetric.
 */
static int solve_part(const Delassus *contacts, const unsigned char *part, const double *r, double *x)
{
    const int n = contacts->n;
    double A[N_RIGID][N_RIGID + 1];
    int wedged = 0, solved = 0, order[N_RIGID] = {0};
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
        wedged |= left[i] && A[i][i] < -DEPENDENT * fabs(contacts->D[i][i]);
    for (int k = solved - 1; k >= 0; k--) {
        const int i = order[k];
        double sum = A[i][n];
        for (int l = k + 1; l < solved; l++)
            sum -= A[i][order[l]] * x[order[l]];
        x[i] = sum / A[i][i];
    }
    return wedged;
}

/*
 * x of the complementarity problem x >= 0, D x - r >= 0, x (D x - r) = 0: contacts are turned round one by one, the
 * least number first, until none pulls and none is violated (K. G. Murty, Linear Algebra Appl. 9 (1974) 65-108).
 * Contacts that wedge together (FRICTION_INCONSISTENT, if nothing else is found) are none that push together.
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
        const int wedged = solve_part(contacts, pushes, r, x) && RUBS;
        some |= wedged;
        for (int k = 0; k < contacts->n && turned < 0; k++) {
            double left = -r[k];
            for (int j = 0; j < contacts->n; j++)
                left += contacts->D[k][j] * x[j];
            if (wedged ? pushes[k] : pushes[k] ? x[k] * contacts->D[k][k] < -1e-14 * size : left < -1e-12 * size)
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
 * A closed contact in which a normal force, by the friction that goes with it, brings the surfaces nearer (P. Painleve,
 * 1895); `needed`: only where it is needed. Without friction no diagonal is negative.
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
static inline int is_frictionally_inconsistent(const Delassus *contacts, int needed, const Parameters *p)
{
    return (void)contacts, (void)needed, (void)p, 0;
}
#endif

/* The right-hand side with the forces that closed contacts need; they are left in `discrete`. */
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
            return FRICTION_INCONSISTENT; /* each of them alone is not, together they wedge */
        for (int k = 0; k < contacts.n; k++)
            discrete->contact[contacts.joint[k]].force = force[k];
    }
    return rates_of(t, y, discrete, p, dy, rhs);
}

#endif
