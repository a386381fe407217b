/*
 * Contacts of joints with play: their onsets, separations, list and force peaks. Together with run/joint_maxima.h this
 * file owns Contacts (run/run.h).
 */

#define SHALLOW_RIGID (8.0 * DBL_EPSILON) /* times the clearance: every impact of rigid surfaces has an impulse */

/* Return the negative penetration in m that counts as rounding at joint k: an event function above it has no sign. */
static double penetration_rounding(const Parameters *p, int k)
{
    return gives(k) ? -min_of(SHALLOW, 1e-10 * deepest(p, k)) : -SHALLOW_RIGID * radial_clearance(p, k);
}

/* Set the integrated inner states of the contact laws of joint i to zero when its contact begins or ends. */
static void reset_inner_states(Integrator *run, int i)
{
    for (int k = 0; k < LAW_STATES; k++)
        run->y[FIRST_STATE + i * LAW_STATES + k] = 0.0;
}

/* Start the record of the contact of joint i at time t (s) with approach speed deltadot (m/s). */
static void begin_contact(Integrator *run, int i, double t, double deltadot)
{
    run->contacts.open[i] = (Impact){t, NAN, deltadot, 0.0, t, i};
}

/* Initialize the contacts, ratios and peaks of a new run at time t; latched: the stored approach speeds, m/s. */
static void start_contacts(Integrator *run, double t, const double *latched)
{
    run->contacts.ratio_min = INFINITY;
    run->contacts.ratio_max = -INFINITY;
    for (int i = 0; i < N_CLEARANCES; i++) {
        begin_contact(run, i, t, latched[i]);
        run->contacts.e_max[i] = -INFINITY; /* of a slider's corner it may stay below 0 */
    }
}

/* Set which contacts are still being compressed from the contact codes with which an earlier run ended. */
static void set_contact_codes(Integrator *run, const signed char *state)
{
    for (int i = 0; i < N_CLEARANCES; i++)
        run->contacts.is_compressing[i] = state[i] == CODE_IMPACT;
}

/*
 * Append a contact to the list that Python fetches. For an impact without duration F_peak is the impulse in N s. Return
 * CHATTERING if the list is full.
 */
static int list_contact(Integrator *run, const Impact *contact)
{
    if (run->contacts.n_impacts >= LISTED_IMPACTS)
        return CHATTERING;
    run->contacts.impacts[run->contacts.n_impacts++] = *contact;
    return 0;
}

/*
 * Append an impact of rigid surfaces to the list; begins: its joint was free. With `add`, add its impulse to the last
 * row of the same joint at this time, if there is one. Return CHATTERING if the list is full.
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

/* Raise the largest force of joint i in this run to F (N) at time t (s), if F is larger. */
static inline void raise_force(Integrator *run, int i, double t, double F)
{
    if (F > run->contacts.F_peak[i]) {
        run->contacts.F_peak[i] = F;
        run->contacts.t_peak[i] = t;
    }
}

/* Raise the largest force of the contact that lasts in joint i to F (N) at time t (s), if F is larger. */
static inline void raise_contact_force(Integrator *run, int i, double t, double F)
{
    if (run->discrete.contact[i].closed && F > run->contacts.open[i].F_peak) {
        run->contacts.open[i].F_peak = F;
        run->contacts.open[i].t_peak = t;
    }
}

/* Raise the largest eccentricity of joint i to e (m), if e is larger. */
static inline void raise_eccentricity(Integrator *run, int i, double e)
{
    run->contacts.e_max[i] = max_of(e, run->contacts.e_max[i]);
}

/* Store whether the force of joint i rises at the end of the step. */
static inline void set_rising(Integrator *run, int i, int rises) { run->contacts.is_rising[i] = rises; }

/* Begin the contact of joint i at its onset and store the approach speed deltadot (m/s), raised to `floor`. */
static void close_joint(Integrator *run, int i, double t, double deltadot, double floor)
{
    run->discrete.contact[i].closed = 1;
    run->discrete.contact[i].deltadot_minus = max_of(deltadot, floor);
    run->contacts.is_compressing[i] = 1;
    run->contacts.is_rising[i] = 1;
    reset_inner_states(run, i);
    run->contacts.onsets++;
    begin_contact(run, i, t, run->discrete.contact[i].deltadot_minus);
}

/* End the contact of joint i at its separation and append the contact to the list that Python fetches. */
static void open_joint(Integrator *run, int i, double t)
{
    run->discrete.contact[i].closed = 0;
    reset_inner_states(run, i);
    run->contacts.open[i].t_off = t;
    list_contact(run, &run->contacts.open[i]);
}

/*
 * Close or open the contact of rigid joint i. A closed contact takes its approach speed from the impact listed at this
 * time. Return 0, or CHATTERING if the list is full.
 */
static inline int set_contact_closed(Integrator *run, int i, int closes)
{
    ContactState *contact = &run->discrete.contact[i];
    const int was = contact->closed;
    contact->closed = closes;
    if (closes == was)
        return 0;
    run->contacts.is_compressing[i] = 0;
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
 * Close and open contacts at the start of a run from gaps and gap rates, and return whether any changed. The approach
 * speed of a closed contact is at least |deltadot| (estimate_approach_speed). A penetration within rounding
 * counts as free while the journal leaves the wall.
 */
static int begin_contacts_of_start(Integrator *run, const Parameters *p)
{
    int changed = 0;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Clearance *now = &run->rhs.clearance[i];
        const int closed = run->discrete.contact[i].closed;
        const int touches = now->delta >= 0.0 && (now->delta > -penetration_rounding(p, i) || now->deltadot > 0.0);
        if (!gives(i)) /* rigid contacts change at events only (run/impacts.c) */
            continue;
        if (!closed && touches)
            close_joint(run, i, run->t, fabs(now->deltadot), min_approach_speed(p, i));
        else if (closed && now->delta < 0.0)
            open_joint(run, i, run->t);
        changed |= closed != run->discrete.contact[i].closed;
        update_compression(run, i, now->deltadot);
    }
    return changed;
}

/*
 * Move the oldest contacts, at most `capacity`, from the list into numbers (rows of ImpactColumn) and joints, and
 * return their number. With `last`, the contacts that still last are appended: no step may follow.
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
