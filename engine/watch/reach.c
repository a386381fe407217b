/*
 * How near its zero a margin is located: as near as the tolerance of the run asks.
 */
#define AT_ONSET 1e-9   /* of a step, behind the begin of a contact, at most */
#define AT_END 1e-6     /* the same behind its end */
#define AT_CORNER 1e-2  /* of a step, behind a corner, at most */
#define NO_HARM 1e-4    /* of the tolerance, that its wrong branch may change a step by */

/* The share to which a zero is located: 4 ulp of the time, or a tick. */
static double root_width(const Run *run, const Step *step)
{
    return max_of(4.0 * DBL_EPSILON * fabs(step->t), run->roots.tick) / step->h;
}

/* Whether margin k may be found behind its zero: of a contact that gives, of a corner where branches meet. */
static int may_lie_behind(const Run *run, int k)
{
    const int corner = k - N_CLEARANCES;
    if (run->control.fixed > 0.0 || watched_as[k] >= 0)
        return 0;
    return corner < 0 ? gives(k) : corner < N_SWITCHES && meets[corner];
}

/*
 * How far behind its zero the margin of a contact that gives may be found, as a share of a step. Forces may begin with
 * a jump, and how long a contact lasts is not known before it begins, nor by others: of one as short as the
 * tolerance's share of the step that finds its onset, the tolerance is missed. The step that finds an end is a part of
 * the contact.
 */
static double reach_of_contact(const Run *run, int k)
{
    const double tolerance = tolerance_of(run);
    return run->memory.latch[k].closed ? min_of(AT_END, tolerance * sqrt(tolerance))
        : min_of(AT_ONSET, tolerance * tolerance);
}

/*
 * How far behind its zero margin k may be found, which there falls by so much a share: of a corner, where branches
 * meet, as far as the wrong one does no harm. Rates differ in proportion to the margin, and what that does grows with
 * the square of the way: at the step's end they do so by what step->harm tells. 0: as near as zeros are told apart.
 */
static double reach_of(const Run *run, const Step *step, int k, double falls)
{
    if (!may_lie_behind(run, k))
        return 0.0;
    if (k < N_CLEARANCES)
        return reach_of_contact(run, k);
    return min_of(AT_CORNER, sqrt(NO_HARM * fabs(margin(&run->memory, &step->aside, k)) / (step->harm * falls)));
}
