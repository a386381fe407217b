/*
 * How near its zero a margin is located: as near as the tolerance of the run asks.
 */
#define AT_CONTACT 1e-6 /* of a step, behind the begin or end of a contact, at most */
#define AT_FIRST 1e-9   /* the same of a first contact */
#define BEFORE 0.3      /* tolerances of an impulse, that may be missed before a contact is found */
#define AT_CORNER 1e-2  /* of a step, behind a corner, at most */
#define NO_HARM 1e-4    /* of the tolerance, that its wrong branch may change a step by */

/* The share to which a zero is located: 4 ulp of the time, or a tick. */
static double root_width(const Run *run, const Step *step)
{
    return max_of(4.0 * DBL_EPSILON * fabs(step->t), run->tick) / step->h;
}

/* Whether margin k may be found behind its zero: of a contact that gives, of a corner where branches meet. */
static int may_lie_behind(const Run *run, int k)
{
    const int corner = k - N_CLEARANCES;
    if (run->fixed > 0.0 || watched_as[k] >= 0)
        return 0;
    return corner < 0 ? gives(k) : corner < N_SWITCHES && meets[corner];
}

/*
 * How far behind its zero the margin of a contact that gives may be found, as a share of a step. Forces may begin with
 * a jump: less than the tolerance of an impulse is missed, an impact being as long at least as the step with which one
 * began; where none has been, nothing is known of how long they are.
 */
static double reach_of_contact(const Run *run, const Step *step, int k)
{
    const double tolerance = tolerance_of(run), late = min_of(AT_CONTACT, tolerance * sqrt(tolerance));
    double known = INFINITY;
    if (run->memory.latch[k].closed)
        return late; /* the step is a part of the contact */
    for (int i = 0; i <= N_CLEARANCES; i++)
        known = run->after_contact[i][0] > 0.0 ? min_of(known, run->after_contact[i][0]) : known;
    if (known == INFINITY)
        return min_of(AT_FIRST, tolerance * tolerance);
    return min_of(late, BEFORE * tolerance * known / step->h);
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
        return reach_of_contact(run, step, k);
    return min_of(AT_CORNER, sqrt(NO_HARM * fabs(margin(&run->memory, &step->aside, k)) / (step->harm * falls)));
}
