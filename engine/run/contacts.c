/*
 * Contacts of joints with play: their onsets, separations, list and force peaks. Together with run/joint_maxima.h this
 * file owns Contacts (run/run.h).
 */

#define RIGID_GAP_ROUNDING (8.0 * DBL_EPSILON) /* times the clearance: every impact of rigid surfaces has an impulse */

/*
 * Return the threshold in m (negative) below which the event function of a joint's gap has reached zero: above it, its
 * sign is rounding. For compliant surfaces it is minus 1e-10 of the largest valid penetration, MIN_TOUCHING_PENETRATION
 * at most; for rigid ones minus RIGID_GAP_ROUNDING clearances. Used in the search for zeros of gaps, after events, and
 * at the start for contacts that touch.
 */
static double compute_gap_event_threshold(const Parameters *p, int joint)
{
    return is_compliant(joint) ? -min_of(MIN_TOUCHING_PENETRATION, 1e-10 * max_valid_penetration(p, joint))
        : -RIGID_GAP_ROUNDING * radial_clearance(p, joint);
}

/*
 * Set the integrated internal states of the contact laws of a joint (bristle deflections) to zero in run->y, when its
 * contact begins or ends. Nothing happens in scenes without internal states.
 */
static void reset_internal_states(Integrator *run, int joint)
{
    for (int k = 0; k < LAW_STATES; k++)
        run->y[FIRST_STATE + joint * LAW_STATES + k] = 0.0;
}

/*
 * Start the record of the contact that begins in a joint at time t (s) with approach speed deltadot (m/s), with a peak
 * force of zero.
 */
static void start_contact_record(Integrator *run, int joint, double t, double deltadot)
{
    run->contacts.ongoing[joint] = (ContactRecord){t, NAN, deltadot, 0.0, t, joint};
}

/*
 * Initialize the contact records, restitution ratios and peaks of a new run at time t (s). approach_speed
 * (N_CLEARANCES): stored approach speeds, m/s, NaN for open joints. Contact states (closed or open) are not set here.
 */
static void initialize_contacts(Integrator *run, double t, const double *approach_speed)
{
    run->contacts.ratio_min = INFINITY;
    run->contacts.ratio_max = -INFINITY;
    for (int i = 0; i < N_CLEARANCES; i++) {
        start_contact_record(run, i, t, approach_speed[i]);
        run->contacts.e_max[i] = -INFINITY; /* of a slider's corner it may stay below 0 */
    }
}

/*
 * Set is_compressing of each joint from the contact codes (N_CLEARANCES) at the end of an earlier run: 1 for
 * CODE_IMPACT, else 0. Called whenever a batch starts or resumes a run.
 */
static void restore_compression_flags(Integrator *run, const signed char *codes)
{
    for (int i = 0; i < N_CLEARANCES; i++)
        run->contacts.is_compressing[i] = codes[i] == CODE_IMPACT;
}

/*
 * Append a copy of a contact to the list that Python fetches. Return 0, or CHATTERING if the list is full; the contact
 * is then dropped. F_peak is a force in N, or the impulse in N s of an impact without duration.
 */
static int append_contact(Integrator *run, const ContactRecord *contact)
{
    if (run->contacts.n_records >= LISTED_IMPACTS)
        return CHATTERING;
    run->contacts.records[run->contacts.n_records++] = *contact;
    return 0;
}

/*
 * Append an impact of rigid surfaces to the list, and count an onset if its joint was open (`is_onset`). Its F_peak is
 * the impulse, N s. With `may_merge`, the impulse is added to the last row of the same joint at this time instead, if
 * there is one. Return 0, or CHATTERING if the list is full. Called for each contact of an impact with a positive
 * impulse.
 */
static inline int append_impact(Integrator *run, const ContactRecord *impact, int may_merge, int is_onset)
{
    ContactRecord *list = run->contacts.records;
    run->contacts.onsets += is_onset;
    for (int k = run->contacts.n_records - 1; k >= 0 && may_merge && list[k].t_on == run->t; k--)
        if (list[k].joint == impact->joint && list[k].t_off == run->t) {
            list[k].F_peak += impact->F_peak;
            return 0;
        }
    return append_contact(run, impact);
}

/* Update the peak force of a joint in this run: store F (N) and time t (s) if F is larger. Called by record_force(). */
static inline void update_peak_force(Integrator *run, int joint, double t, double F)
{
    if (F > run->contacts.F_peak[joint]) {
        run->contacts.F_peak[joint] = F;
        run->contacts.t_peak[joint] = t;
    }
}

/*
 * Update the peak force of the contact that lasts in a joint: store F (N) and time t (s) if F is larger. An open joint
 * is left unchanged. Called by record_force().
 */
static inline void update_contact_peak_force(Integrator *run, int joint, double t, double F)
{
    if (run->discrete.contact[joint].closed && F > run->contacts.ongoing[joint].F_peak) {
        run->contacts.ongoing[joint].F_peak = F;
        run->contacts.ongoing[joint].t_peak = t;
    }
}

/* Update the largest eccentricity of a joint in this run: store e (m) if it is larger. */
static inline void update_largest_eccentricity(Integrator *run, int joint, double e)
{
    run->contacts.e_max[joint] = max_of(e, run->contacts.e_max[joint]);
}

/* Store whether the force of a joint rises at the end of the step, for the search of peaks in the next step. */
static inline void set_force_rising(Integrator *run, int joint,
    int is_rising) { run->contacts.is_rising[joint] = is_rising; }

/*
 * Begin the contact of a joint with compliant surfaces at time t (s). The approach speed deltadot (m/s), raised to
 * min_speed, is stored in the contact state; the contact starts in compression with a rising force. Internal states of
 * the laws restart at zero, and the onset is counted.
 */
static void close_contact(Integrator *run, int joint, double t, double deltadot, double min_speed)
{
    run->discrete.contact[joint].closed = 1;
    run->discrete.contact[joint].deltadot_minus = max_of(deltadot, min_speed);
    run->contacts.is_compressing[joint] = 1;
    run->contacts.is_rising[joint] = 1;
    reset_internal_states(run, joint);
    run->contacts.onsets++;
    start_contact_record(run, joint, t, run->discrete.contact[joint].deltadot_minus);
}

/*
 * End the contact of a joint with compliant surfaces at time t (s), reset the internal states of its laws, and append
 * the contact to the list that Python fetches. Return 0, or CHATTERING if the list is full.
 */
static int open_contact(Integrator *run, int joint, double t)
{
    run->discrete.contact[joint].closed = 0;
    reset_internal_states(run, joint);
    run->contacts.ongoing[joint].t_off = t;
    return append_contact(run, &run->contacts.ongoing[joint]);
}

/*
 * Close or open the contact of a joint with rigid surfaces at the current time. A closed contact takes its approach
 * speed from the impact listed at this time, else 0. An opened contact is appended to the list. Nothing happens if the
 * contact does not change. Return 0, or CHATTERING if the list is full. Called by update_closed_contacts() for each
 * rigid joint.
 */
static inline int set_rigid_contact(Integrator *run, int joint, int is_closed)
{
    ContactState *contact = &run->discrete.contact[joint];
    const int was_closed = contact->closed;
    contact->closed = is_closed;
    if (is_closed == was_closed)
        return 0;
    run->contacts.is_compressing[joint] = 0;
    if (is_closed) {
        contact->deltadot_minus = 0.0;
        for (int k = run->contacts.n_records - 1; k >= 0 && run->contacts.records[k].t_on == run->t; k--)
            if (run->contacts.records[k].joint == joint)
                contact->deltadot_minus = run->contacts.records[k].deltadot;
        start_contact_record(run, joint, run->t, contact->deltadot_minus);
        return 0;
    }
    run->contacts.ongoing[joint].t_off = run->t;
    return append_contact(run, &run->contacts.ongoing[joint]);
}

/*
 * Close and open contacts of compliant surfaces at the start of a run from gaps and gap rates, and return whether any
 * changed. The stored approach speed of a closed contact is at least |deltadot|; estimate_approach_speed() improves it.
 * A penetration within rounding (compute_gap_event_threshold()) counts as open while the journal leaves the wall. Rigid
 * contacts are left unchanged. update_compression() is called for each compliant contact. Called once, when a run
 * begins.
 */
static int initialize_compliant_contacts(Integrator *run, const Parameters *p)
{
    int changed = 0;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Clearance *clearance = &run->rhs.clearance[i];
        const int was_closed = run->discrete.contact[i].closed;
        const int touches = clearance->delta >= 0.0
            && (clearance->delta > -compute_gap_event_threshold(p, i) || clearance->deltadot > 0.0);
        if (!is_compliant(i)) /* rigid contacts change at events only (run/impacts.c) */
            continue;
        if (!was_closed && touches)
            close_contact(run, i, run->t, fabs(clearance->deltadot), min_approach_speed(p, i));
        else if (was_closed && clearance->delta < 0.0)
            (void)open_contact(run, i, run->t); /* the list of a new run is empty */
        changed |= was_closed != run->discrete.contact[i].closed;
        update_compression(run, i, clearance->deltadot);
    }
    return changed;
}

/* Remove all contacts from the list, whose records the caller does not need. */
static void discard_contacts(Integrator *run) { run->contacts.n_records = 0; }

/*
 * Move the oldest contacts, at most `capacity`, from the list into `values` (rows of ImpactColumn) and `joints` (their
 * numbers), and return how many were moved. With `include_open`, the contacts that still last are appended once with
 * t_off = NaN; no step may follow.
 */
int gudgeon_run_impacts(void *integrator, int include_open, int capacity, double *values, int *joints)
{
    const Integrator *run = integrator;
    Contacts *contacts = &((Integrator *)integrator)->contacts;
    for (int i = 0; include_open && !contacts->ongoing_listed && i < N_CLEARANCES; i++)
        if (run->discrete.contact[i].closed)
            contacts->records[contacts->n_records++] = contacts->ongoing[i];
    contacts->ongoing_listed = include_open;
    const int n = contacts->n_records < capacity ? contacts->n_records : capacity;
    for (int i = 0; i < n; i++, values += N_IMPACT_COLUMNS) {
        const ContactRecord *impact = &contacts->records[i];
        values[IMPACT_t_on] = impact->t_on;
        values[IMPACT_t_off] = impact->t_off;
        values[IMPACT_deltadot] = impact->deltadot;
        values[IMPACT_F_peak] = impact->F_peak;
        values[IMPACT_t_peak] = impact->t_peak;
        joints[i] = impact->joint;
    }
    contacts->n_records -= n;
    memmove(contacts->records, contacts->records + n, (size_t)contacts->n_records * sizeof contacts->records[0]);
    return n;
}
