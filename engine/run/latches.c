/*
 * Contacts of joints with play: onsets and separations from gap and approach at both ends of a step, their list, their
 * peaks. Together with both/watch.h this file owns Contacts (run.h).
 */

#define SHALLOW_RIGID (8.0 * DBL_EPSILON) /* of the clearance: each blow of surfaces that do not give has an impulse */

/* How far below zero a joint's margin lies without a meaning, m. */
static double shallow(const Parameters *p, int k)
{
    return gives(k) ? -min_of(SHALLOW, 1e-10 * deepest(p, k)) : -SHALLOW_RIGID * radial_clearance(p, k);
}

/* Parameter s in [0, 1] at which the cubic through (d0, h r0) and (d1, h r1) crosses zero; its slope in `rate`. */
static double crossing(double d0, double r0, double d1, double r1, double h, double *rate)
{
    double low = 0.0, high = 1.0, s = 0.5;
    for (int i = 0; i < 60; i++) {
        s = 0.5 * (low + high);
        const double u = 1.0 - s;
        const double d = u * u * (1.0 + 2.0 * s) * d0 + s * u * u * h * r0 + s * s * (3.0 - 2.0 * s) * d1
            - s * s * u * h * r1;
        if ((d >= 0.0) == (d1 >= 0.0))
            high = s;
        else
            low = s;
    }
    *rate = 6.0 * s * (1.0 - s) * (d1 - d0) / h + (1.0 - s) * (1.0 - 3.0 * s) * r0 + s * (3.0 * s - 2.0) * r1;
    return s;
}

/* Inner states of the laws of a joint: what they gathered at these rates within h. */
static void bend(Run *run, int i, double h, const Clearance *now)
{
#if LAW_STATES
    for (int k = 0; k < LAW_STATES; k++)
        run->y[FIRST_STATE + i * LAW_STATES + k] = h > 0.0 ? h * now->state_rate[k] : 0.0;
#else
    (void)run, (void)i, (void)h, (void)now;
#endif
}

/* Begin the contact of joint i that lasts from time t on. */
static void begin_contact(Run *run, int i, double t, double deltadot)
{
    run->contacts.open[i] = (Impact){t, NAN, deltadot, 0.0, t, i};
}

static void start_contacts(Run *run, double t, const double *latched)
{
    run->contacts.ratio_min = INFINITY;
    run->contacts.ratio_max = -INFINITY;
    for (int i = 0; i < N_CLEARANCES; i++) {
        begin_contact(run, i, t, latched[i]);
        run->contacts.e_max[i] = -INFINITY; /* of a slider's corner it may stay below 0 */
    }
}

/* The codes with which an earlier run ended: whether a contact that goes on is still being compressed. */
static void set_contact_codes(Run *run, const signed char *state)
{
    for (int i = 0; i < N_CLEARANCES; i++)
        run->contacts.compressing[i] = state[i] == CODE_IMPACT;
}

/* Add a contact to the list that Python fetches; for an impact without a duration F_peak is the impulse, N s. */
static int list_contact(Run *run, const Impact *contact)
{
    if (run->contacts.n_impacts >= LISTED_IMPACTS)
        return CHATTERING;
    run->contacts.impacts[run->contacts.n_impacts++] = *contact;
    return 0;
}

/*
 * List an impact; `begins`: its joint was free. With `add` its impulse is added to the last row of the same joint at
 * this time, if there is one.
 */
static inline int list_impact(Run *run, const Impact *impact, int add, int begins)
{
    Impact *list = run->contacts.impacts;
    run->contacts.onsets += begins;
    for (int k = run->contacts.n_impacts - 1; k >= 0 && add && list[k].t_on == run->t; k--)
        if (list[k].joint == impact->joint && list[k].t_off == run->t) {
            list[k].F_peak += impact->F_peak;
            return 0;
        }
    return list_contact(run, impact);
}

/* Raise the largest force so far of joint i; of its contact that lasts; its largest eccentricity. */
static inline void raise_force(Run *run, int i, double t, double F)
{
    if (F > run->contacts.F_peak[i]) {
        run->contacts.F_peak[i] = F;
        run->contacts.t_peak[i] = t;
    }
}
static inline void raise_contact_force(Run *run, int i, double t, double F)
{
    if (run->memory.latch[i].closed && F > run->contacts.open[i].F_peak) {
        run->contacts.open[i].F_peak = F;
        run->contacts.open[i].t_peak = t;
    }
}
static inline void raise_eccentricity(Run *run, int i, double e)
{
    run->contacts.e_max[i] = max_of(e, run->contacts.e_max[i]);
}

static inline void set_rising(Run *run, int i, int rises) { run->contacts.rising[i] = rises; }

/* List a contact that begins and ends inside a step, with the eccentricity e. */
static void list_graze(Run *run, const Impact *graze, double e)
{
    run->contacts.onsets++;
    raise_eccentricity(run, graze->joint, e);
    raise_force(run, graze->joint, graze->t_peak, graze->F_peak);
    list_contact(run, graze);
}

/* Move the begin of the contact that lasts in joint i, or the end of the last one of a joint that is free. */
static void move_contact(Run *run, int i, double t)
{
    const int closed = run->memory.latch[i].closed;
    *(closed ? &run->contacts.open[i].t_on : &run->contacts.open[i].t_off) = t;
    for (int k = run->contacts.n_impacts - 1; !closed && k >= 0; k--)
        if (run->contacts.impacts[k].joint == i) {
            run->contacts.impacts[k].t_off = t;
            break;
        }
}

/* Onset: remember the impact velocity, not below its floor. */
static void close_joint(Run *run, int i, double t, double deltadot, double floor)
{
    run->memory.latch[i].closed = 1;
    run->memory.latch[i].deltadot_minus = max_of(deltadot, floor);
    run->contacts.compressing[i] = 1;
    run->contacts.rising[i] = 1;
    bend(run, i, 0.0, &run->aside.clearance[i]);
    run->contacts.onsets++;
    begin_contact(run, i, t, run->memory.latch[i].deltadot_minus);
}

/* Separation: the contact goes into the list that Python fetches. */
static void open_joint(Run *run, int i, double t)
{
    run->memory.latch[i].closed = 0;
    bend(run, i, 0.0, &run->aside.clearance[i]);
    run->contacts.open[i].t_off = t;
    list_contact(run, &run->contacts.open[i]); /* it is full only where friction cuts a step in parts */
}

/* Close, or open, rigid joint i. */
static inline int turn_contact(Run *run, int i, int closes)
{
    Latch *latch = &run->memory.latch[i];
    const int was = latch->closed;
    latch->closed = closes;
    if (closes == was)
        return 0;
    run->contacts.compressing[i] = 0;
    if (closes) {
        latch->deltadot_minus = 0.0;
        for (int k = run->contacts.n_impacts - 1; k >= 0 && run->contacts.impacts[k].t_on == run->t; k--)
            if (run->contacts.impacts[k].joint == i)
                latch->deltadot_minus = run->contacts.impacts[k].deltadot;
        begin_contact(run, i, run->t, latch->deltadot_minus);
        return 0;
    }
    run->contacts.open[i].t_off = run->t;
    return list_contact(run, &run->contacts.open[i]);
}

/* Free, impact, contact from gap and approach at both ends of a step; 1 if any joint changed. */
static int update_latches(Run *run, double t, double h, const Clearance *before, const Clearance *after,
    const unsigned char *touched, const Parameters *p)
{
    int changed = 0;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const double d0 = before[i].delta, d1 = after[i].delta;
        double rate;
        if (!gives(i)) { /* these begin and end where they are located (impacts.c) */
            run->contacts.grazes += !run->memory.latch[i].closed && touched[i] && d1 < 0.0;
            continue;
        }
        /* a journal that leaves zero is free, whatever its penetration is rounded to */
        const int touches = d1 >= 0.0 && (d1 > -shallow(p, i) || after[i].deltadot > 0.0);
        if (!run->memory.latch[i].closed && touches) {
            const double s = d0 < 0.0 ? crossing(d0, before[i].deltadot, d1, after[i].deltadot, h, &rate) : 0.0;
            /* a run that begins in contact: at least as fast as its surfaces move (begin_in_contact) */
            close_joint(run, i, t + s * h, d0 < 0.0 ? rate : fabs(before[i].deltadot), slowest_impact(p, i));
            bend(run, i, (1.0 - s) * h, &after[i]);
            changed = 1;
        } else if (run->memory.latch[i].closed && d1 < 0.0) {
            open_joint(run, i, t + h * crossing(d0, before[i].deltadot, d1, after[i].deltadot, h, &rate));
            changed = 1;
        } else if (!run->memory.latch[i].closed && touched[i]) {
            run->contacts.grazes++; /* in and out again within one step */
            bend(run, i, 0.0, &after[i]);
        }
        note_turn(run, i, after[i].deltadot);
    }
    return changed;
}

/*
 * Moves the oldest contacts, at most `capacity`, from the list into rows of these arrays (ImpactColumn); returns how
 * many. With `last` those that still go on follow: no step is made after it.
 */
int gudgeon_run_impacts(void *memory, int last, int capacity, double *numbers, int *joints)
{
    const Run *run = memory;
    Contacts *contacts = &((Run *)memory)->contacts;
    for (int i = 0; last && !contacts->open_listed && i < N_CLEARANCES; i++)
        if (run->memory.latch[i].closed)
            contacts->impacts[contacts->n_impacts++] = contacts->open[i];
    contacts->open_listed = last;
    const int n = contacts->n_impacts < capacity ? contacts->n_impacts : capacity;
    for (int i = 0; i < n; i++, numbers += N_IMPACT_COLUMNS) {
        const Impact *impact = &contacts->impacts[i];
        numbers[IMPACT_t_on] = impact->t_on;
        numbers[IMPACT_t_off] = impact->t_off;
        numbers[IMPACT_deltadot] = impact->deltadot;
        numbers[IMPACT_F_peak] = impact->F_peak;
        numbers[IMPACT_t_peak] = impact->t_peak;
        joints[i] = impact->joint;
    }
    contacts->n_impacts -= n;
    memmove(contacts->impacts, contacts->impacts + n, (size_t)contacts->n_impacts * sizeof contacts->impacts[0]);
    return n;
}
