/*
 * Contacts of joints with play: their onsets and separations, their list, their peaks. Together with run/joint_maxima.h
 * this file owns Contacts (run.h).
 */

#define SHALLOW_RIGID (8.0 * DBL_EPSILON) /* of the clearance: each blow of surfaces that do not give has an impulse */

/* How far below zero a joint's margin lies without a meaning, m. */
static double penetration_rounding(const Parameters *p, int k)
{
    return gives(k) ? -min_of(SHALLOW, 1e-10 * deepest(p, k)) : -SHALLOW_RIGID * radial_clearance(p, k);
}

/* Inner states of the laws of a joint, whose contact begins or ends: none is left. */
static void reset_inner_states(Integrator *run, int i)
{
    for (int k = 0; k < LAW_STATES; k++)
        run->y[FIRST_STATE + i * LAW_STATES + k] = 0.0;
}

/* Begin the contact of joint i that lasts from time t on. */
static void begin_contact(Integrator *run, int i, double t, double deltadot)
{
    run->contacts.open[i] = (Impact){t, NAN, deltadot, 0.0, t, i};
}

static void start_contacts(Integrator *run, double t, const double *latched)
{
    run->contacts.ratio_min = INFINITY;
    run->contacts.ratio_max = -INFINITY;
    for (int i = 0; i < N_CLEARANCES; i++) {
        begin_contact(run, i, t, latched[i]);
        run->contacts.e_max[i] = -INFINITY; /* of a slider's corner it may stay below 0 */
    }
}

/* The codes with which an earlier run ended: whether a contact that goes on is still being compressed. */
static void set_contact_codes(Integrator *run, const signed char *state)
{
    for (int i = 0; i < N_CLEARANCES; i++)
        run->contacts.compressing[i] = state[i] == CODE_IMPACT;
}

/* Add a contact to the list that Python fetches; for an impact without a duration F_peak is the impulse, N s. */
static int list_contact(Integrator *run, const Impact *contact)
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
static inline int list_impact(Integrator *run, const Impact *impact, int add, int begins)
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
static inline void raise_force(Integrator *run, int i, double t, double F)
{
    if (F > run->contacts.F_peak[i]) {
        run->contacts.F_peak[i] = F;
        run->contacts.t_peak[i] = t;
    }
}
static inline void raise_contact_force(Integrator *run, int i, double t, double F)
{
    if (run->discrete.contact[i].closed && F > run->contacts.open[i].F_peak) {
        run->contacts.open[i].F_peak = F;
        run->contacts.open[i].t_peak = t;
    }
}
static inline void raise_eccentricity(Integrator *run, int i, double e)
{
    run->contacts.e_max[i] = max_of(e, run->contacts.e_max[i]);
}

static inline void set_rising(Integrator *run, int i, int rises) { run->contacts.rising[i] = rises; }

/* Onset: remember the impact velocity, not below its floor. */
static void close_joint(Integrator *run, int i, double t, double deltadot, double floor)
{
    run->discrete.contact[i].closed = 1;
    run->discrete.contact[i].deltadot_minus = max_of(deltadot, floor);
    run->contacts.compressing[i] = 1;
    run->contacts.rising[i] = 1;
    reset_inner_states(run, i);
    run->contacts.onsets++;
    begin_contact(run, i, t, run->discrete.contact[i].deltadot_minus);
}

/* Separation: the contact goes into the list that Python fetches. */
static void open_joint(Integrator *run, int i, double t)
{
    run->discrete.contact[i].closed = 0;
    reset_inner_states(run, i);
    run->contacts.open[i].t_off = t;
    list_contact(run, &run->contacts.open[i]);
}

/* Close, or open, rigid joint i. */
static inline int set_contact_closed(Integrator *run, int i, int closes)
{
    ContactState *contact = &run->discrete.contact[i];
    const int was = contact->closed;
    contact->closed = closes;
    if (closes == was)
        return 0;
    run->contacts.compressing[i] = 0;
    if (closes) {
        contact->deltadot_minus = 0.0;
        for (int k = run->contacts.n_impacts - 1; k >= 0 && run->contacts.impacts[k].t_on == run->t; k--)
            if (run->contacts.impacts[k].joint == i)
                contact->deltadot_minus = run->contacts.impacts[k].deltadot;
        begin_contact(run, i, run->t, contact->deltadot_minus);
        return 0;
    }
    run->contacts.open[i].t_off = run->t;
    return list_contact(run, &run->contacts.open[i]);
}

/*
 * Contacts of a run that begins, from gaps and rates: at least as fast as surfaces move (begin_in_contact). A journal
 * that leaves zero is free, whatever its penetration is rounded to. Whether any joint changed.
 */
static int begin_contacts_of_start(Integrator *run, const Parameters *p)
{
    int changed = 0;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Clearance *now = &run->rhs.clearance[i];
        const int closed = run->discrete.contact[i].closed;
        const int touches = now->delta >= 0.0 && (now->delta > -penetration_rounding(p, i) || now->deltadot > 0.0);
        if (!gives(i)) /* these begin and end where they are located (impacts.c) */
            continue;
        if (!closed && touches)
            close_joint(run, i, run->t, fabs(now->deltadot), slowest_impact(p, i));
        else if (closed && now->delta < 0.0)
            open_joint(run, i, run->t);
        changed |= closed != run->discrete.contact[i].closed;
        note_turn(run, i, now->deltadot);
    }
    return changed;
}

/*
 * Moves the oldest contacts, at most `capacity`, from the list into rows of these arrays (ImpactColumn); returns how
 * many. With `last` those that still go on follow: no step is made after it.
 */
int gudgeon_run_impacts(void *integrator, int last, int capacity, double *numbers, int *joints)
{
    const Integrator *run = integrator;
    Contacts *contacts = &((Integrator *)integrator)->contacts;
    for (int i = 0; last && !contacts->open_listed && i < N_CLEARANCES; i++)
        if (run->discrete.contact[i].closed)
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
