/*
 * Choice of the treatment of a step near a singular position of the linkage (motion/continuation.c). Off the
 * constraints, where stages lie, the right-hand side can be continued in several ways; a method keeps its order only if
 * the whole step uses one of them. A step is first tried with detection. Near a singular position it is repeated with
 * all stages projected onto the constraints, or, if that fails, without any treatment.
 */
#if HAS_CONTINUATION
enum { MAX_SKIPPED_LOG2 = 6 }; /* log2 of the largest number of steps without detection after failed attempts */

/*
 * Set the policy near singular positions (SINGULAR_...) in the discrete state, with its limits of small pivots: the
 * usual ones for SINGULAR_IGNORE, else NEAR_SINGULAR_PIVOT.
 */
static void set_singular_policy(Integrator *run, int policy)
{
    run->discrete.singular_policy = policy;
    run->discrete.min_pivot = policy == SINGULAR_IGNORE ? NEARLY_SINGULAR : NEAR_SINGULAR_PIVOT;
    run->discrete.min_pivot_size = policy == SINGULAR_IGNORE ? VANISHING : NEAR_SINGULAR_PIVOT;
}

/*
 * Set the policy of a new step before its first attempt: SINGULAR_DETECT, or SINGULAR_IGNORE while detection is
 * suspended.
 */
static void select_singular_policy(Integrator *run)
{
    set_singular_policy(run, run->near_singular.n_steps_without_detection ? SINGULAR_IGNORE : SINGULAR_DETECT);
}

/*
 * Return whether a step with this status must be repeated with another policy near singular positions, which is then
 * set. NEAR_SINGULAR repeats it: SINGULAR_PROJECT after SINGULAR_DETECT, else SINGULAR_IGNORE. Any other status ends
 * the attempts, and the policy of states outside steps follows from that of the step:
 *   SINGULAR_DETECT: no singular position; SINGULAR_CONTINUE;
 *   SINGULAR_PROJECT: SINGULAR_PROJECT_OR_IGNORE;
 *   SINGULAR_IGNORE: it stays. After a detected position, detection is suspended for 1, 3, 7, ... and at most
 *       2^MAX_SKIPPED_LOG2 - 1 steps; a step without detection counts as one of them.
 */
static int update_singular_policy(Integrator *run, int status)
{
    const int policy = run->discrete.singular_policy;
    if (status == NEAR_SINGULAR) {
        set_singular_policy(run, policy == SINGULAR_DETECT ? SINGULAR_PROJECT : SINGULAR_IGNORE);
        return 1;
    }
    if (policy != SINGULAR_IGNORE)
        set_singular_policy(run, policy == SINGULAR_DETECT ? SINGULAR_CONTINUE : SINGULAR_PROJECT_OR_IGNORE);
    if (policy != SINGULAR_IGNORE) {
        run->near_singular.n_failed = 0;
    } else if (run->near_singular.n_steps_without_detection) {
        run->near_singular.n_steps_without_detection--;
    } else {
        run->near_singular.n_failed += run->near_singular.n_failed < MAX_SKIPPED_LOG2;
        run->near_singular.n_steps_without_detection = (1L << run->near_singular.n_failed) - 1;
    }
    return 0;
}

/*
 * Update the policy near singular positions for an accepted step that met none, as if the step had been tried with it:
 * first select_singular_policy(), then update_singular_policy() with status 0. The policy of states outside steps is
 * then SINGULAR_CONTINUE after SINGULAR_DETECT, else SINGULAR_IGNORE, and one step fewer is without detection. Called
 * for steps that were computed in lanes.
 */
static inline void complete_singular_policy(Integrator *run)
{
    select_singular_policy(run);
    update_singular_policy(run, 0);
}
#else
/* Do nothing: the scene does not continue its motion past singular positions. */
static inline void complete_singular_policy(Integrator *run) { (void)run; }

/* Do nothing: the scene does not continue its motion past singular positions. */
static void select_singular_policy(Integrator *run) { (void)run; }

/* Return 0, the step is not repeated: the scene does not continue its motion past singular positions. */
static int update_singular_policy(Integrator *run, int status) { return (void)run, (void)status, 0; }
#endif
