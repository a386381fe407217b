/*
 * Steps that come near a singular position (motion/continuation.c). Off the constraints, where stages lie, the
 * right-hand side may be continued in more than one way, and a method has its order if it meets one of them in all of a
 * step. So a step is first tried as ever, and where it meets such a position again with all stages brought back onto
 * the constraints; where that cannot be had, as if nobody had looked.
 */
#if CONTINUES
enum { MOST_SKIPPED = 6 }; /* its power of two: steps for which nobody looks, once some were in vain */

static void set_singular_policy(Integrator *run, int way)
{
    run->discrete.singular_policy = way;
    run->discrete.least = way == SINGULAR_IGNORE ? NEARLY_SINGULAR : NEARBY;
    run->discrete.least_size = way == SINGULAR_IGNORE ? VANISHING : NEARBY;
}

/* Before a step is tried. */
static void begin_singular_policy(Integrator *run)
{
    set_singular_policy(run, run->near.unlooked ? SINGULAR_IGNORE : SINGULAR_DETECT);
}

/* Once it was, with this status: whether it is to be tried again, another way. */
static int next_singular_policy(Integrator *run, int status)
{
    const int way = run->discrete.singular_policy;
    if (status == NEAR) {
        set_singular_policy(run, way == SINGULAR_DETECT ? SINGULAR_PROJECT : SINGULAR_IGNORE);
        return 1;
    }
    if (way != SINGULAR_IGNORE)
        set_singular_policy(run, way == SINGULAR_DETECT ? SINGULAR_CONTINUE : SINGULAR_PROJECT_OR_IGNORE);
    if (way != SINGULAR_IGNORE) {
        run->near.in_vain = 0;
    } else if (run->near.unlooked) {
        run->near.unlooked--;
    } else {
        run->near.in_vain += run->near.in_vain < MOST_SKIPPED;
        run->near.unlooked = (1L << run->near.in_vain) - 1;
    }
    return 0;
}

/* After a step that others have tried, and that met none. */
static inline void reset_singular_policy(Integrator *run)
{
    begin_singular_policy(run);
    next_singular_policy(run, 0);
}
#else
static inline void reset_singular_policy(Integrator *run) { (void)run; }
static void begin_singular_policy(Integrator *run) { (void)run; }
static int next_singular_policy(Integrator *run, int status) { return (void)run, (void)status, 0; }
#endif
