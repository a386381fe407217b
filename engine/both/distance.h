/*
 * What is measured of a step that is tried: how stiff the equations are in it, and how far it ends from the constraint
 * equations before it is projected, an error that no estimate sees.
 */
#define FAR_FROM_ROWS 10.0 /* tolerances, that the end of a step may lie from the rows; as a rule it is less than one */
#define DIGITS_OF_ROWS 1e-10 /* of a coordinate or velocity: that may be rounding, of what flies off many tolerances */

/* How far the end of a step lay from the rows, in tolerances, by what it was and what it is now that it is closed. */
static Real distance_from_rows(const IntegratorOf *run, const Real *before, const Real *y)
{
    Real most = real_of(0.0);
    for (int k = 0; k < 2 * N_X && N_LOOPS > 0; k++)
        most = real_max((real_abs(y[k] - before[k]) - DIGITS_OF_ROWS * real_abs(y[k])) * run->norm.weight[k], most);
    return most;
}

/* Where in a state the motion's k-th part is, of N_FELT: coordinates, velocities, inner states of laws. */
static inline int felt(int k) { return k < 2 * N_X ? k : k + N_WORK; }

/* h rho: the length of a step times the largest rate at which its stages saw rates change. */
static inline void note_stability(IntegratorOf *run, Real stability) { run->choice.stability = stability; }
