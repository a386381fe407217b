/*
 * Steps that come near a singular position (motion/beside.c). Off the constraints, where stages lie, the right-hand
 * side may be continued in more than one way, and a method has its order if it meets one of them in all of a step. So
 * a step is first tried as ever, and where it meets such a position again with all stages brought back onto the
 * constraints; where that cannot be had, as if nobody had looked.
 */
#if CONTINUES
enum { MOST_SKIPPED = 6 }; /* its power of two: steps for which nobody looks, once some were in vain */

static void take_way(Run *run, int way)
{
    run->memory.way = way;
    run->memory.least = way == AS_EVER ? NEARLY_SINGULAR : NEARBY;
    run->memory.least_size = way == AS_EVER ? VANISHING : NEARBY;
}

/* Before a step is tried. */
static void first_way(Run *run) { take_way(run, run->near.unlooked ? AS_EVER : TELLS); }

/* Once it was, with this status: whether it is to be tried again, another way. */
static int other_way(Run *run, int status)
{
    const int way = run->memory.way;
    if (status == NEAR) {
        take_way(run, way == TELLS ? CLOSES : AS_EVER);
        return 1;
    }
    if (way != AS_EVER)
        take_way(run, way == TELLS ? AT_ONCE : CLOSED);
    if (way != AS_EVER) {
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
static inline void way_as_usual(Run *run)
{
    first_way(run);
    other_way(run, 0);
}
#else
static inline void way_as_usual(Run *run) { (void)run; }
static void first_way(Run *run) { (void)run; }
static int other_way(Run *run, int status) { return (void)run, (void)status, 0; }
#endif
