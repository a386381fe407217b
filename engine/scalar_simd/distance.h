/* Measures of a trial step: its stiffness (length times spectral radius), and its drift from the constraints. */
#define MAX_CONSTRAINT_DRIFT 10.0 /* tolerances: largest distance of a step's end from the constraint equations */
#define ROUNDING_DIGITS 1e-10 /* of a coordinate or velocity: changes that may be rounding */

/*
 * Return the distance of a step's end from the constraint equations, in tolerances: the largest scaled change of q and
 * v by its projection. y_before, y_after: states before and after projection. Changes below ROUNDING_DIGITS of a
 * component count as rounding. Return 0 without closures.
 */
static Real compute_constraint_distance(const IntegratorOf *run, const Real *y_before, const Real *y_after)
{
    Real distance = make_real(0.0);
    for (int k = 0; k < 2 * N_X && N_LOOPS > 0; k++)
        distance = real_max((real_abs(y_after[k] - y_before[k]) - ROUNDING_DIGITS * real_abs(y_after[k]))
            * run->norm.weight[k], distance);
    return distance;
}

/*
 * Return the index in the state (N_Y) of component k (0 ... N_MOTION - 1) on which the motion depends: coordinates,
 * velocities and internal states of contact laws. The works are skipped, as nothing depends on them.
 */
static inline int get_motion_index(int k) { return k < 2 * N_X ? k : k + N_WORK; }

/*
 * Store the stiffness estimate h rho of a tried step, its length times the spectral radius that its stages show. 0: no
 * estimate. Read by switch_method_after_step().
 */
static inline void store_stiffness_estimate(IntegratorOf *run, Real h_rho) { run->choice.h_rho = h_rho; }

/*
 * Estimate and store h rho, the stiffness of an explicit step, from two states at its end: that of the step, and that
 * of the last stage, stage_y with rates stage_rates. h rho is h times the ratio of the differences of rates and of
 * states. Both are measured in the weighted maximum norm of the components on which the motion depends. It is 0 where
 * the two states do not differ.
 */
static inline void estimate_stiffness_at_end(IntegratorOf *run, const StepOf *step, Real h, const Real *stage_y,
    const Real *stage_rates)
{
    Real change = make_real(0.0), distance = make_real(0.0);
    for (int k = 0; k < N_MOTION; k++) {
        const int i = get_motion_index(k);
        const Real weight = run->norm.weight[i];
        change = real_max(real_abs(step->dy[i] - stage_rates[i]) * weight, change);
        distance = real_max(real_abs(step->y[i] - stage_y[i]) * weight, distance);
    }
    store_stiffness_estimate(run, select_value(distance > MIN_RESOLVED, h * change / distance, make_real(0.0)));
}
