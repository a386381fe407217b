/*
 * Measures of a trial step: its stiffness, and the distance of its end from the constraint equations before the
 * projection, an error that no estimate contains.
 */
#define MAX_CONSTRAINT_DRIFT 10.0 /* tolerances: largest distance of a step's end from the constraint equations */
#define ROUNDING_DIGITS 1e-10 /* of a coordinate or velocity: changes that may be rounding */

/*
 * Return the distance of a step's end from the constraint equations, in tolerances, from the states before and after
 * its projection.
 */
static Real distance_from_constraints(const IntegratorOf *run, const Real *before, const Real *y)
{
    Real most = real_of(0.0);
    for (int k = 0; k < 2 * N_X && N_LOOPS > 0; k++)
        most = real_max((real_abs(y[k] - before[k]) - ROUNDING_DIGITS * real_abs(y[k])) * run->norm.weight[k], most);
    return most;
}

/*
 * Return the index in the state of component k (0 ... N_MOTION - 1) on which the motion depends. These are coordinates,
 * velocities and inner states of laws, but no works.
 */
static inline int felt(int k) { return k < 2 * N_X ? k : k + N_WORK; }

/* Store h rho: the length of a step times the largest rate that its stages show. */
static inline void record_stability(IntegratorOf *run, Real stability) { run->choice.stability = stability; }

/*
 * Store h rho of an explicit step from two states at its end: that of the step, and the state y of the last stage,
 * whose rates are `rates`. It is 0 where the two states do not differ.
 */
static inline void record_end_stability(IntegratorOf *run, const StepOf *step, Real h, const Real *y, const Real *rates)
{
    Real change = real_of(0.0), way = real_of(0.0);
    for (int k = 0; k < N_MOTION; k++) {
        const int i = felt(k);
        const Real by = run->norm.weight[i];
        change = real_max(real_abs(step->dy[i] - rates[i]) * by, change);
        way = real_max(real_abs(step->y[i] - y[i]) * by, way);
    }
    record_stability(run, pick(way > MIN_RESOLVED, h * change / way, real_of(0.0)));
}
