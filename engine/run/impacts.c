/*
 * Impacts and closed contacts of rigid surfaces with Newton's restitution. Velocities jump where a gap closes; a closed
 * contact lasts until its force is zero. One linear complementarity problem (scene/contact_forces.h) determines all
 * contacts of one time: impulses (r = u + e u, u the approach rate) and forces (r = delta'').
 * J. J. Moreau, in: Nonsmooth Mechanics and Applications (1988); F. Pfeiffer, C. Glocker, Multibody Dynamics with
 * Unilateral Contacts (1996).
 */
#if N_RIGID
#define TOUCHING 1e-10 /* times the clearance: surfaces with a smaller gap touch */
#define RATIO_TOL 1e-8    /* relative difference up to which ratios of successive passes are one geometric ratio */
enum { MAX_PASSES = 1000, LISTED_PASSES = 8, MAX_SEPARATIONS = 12 };

/*
 * Return the event function of the contact of joint i: gap of an open contact in m, force of a closed rigid contact in
 * N. It is non-negative while the contact stays as it is.
 */
static double contact_event_function(const DiscreteState *discrete, const RhsOutputs *rhs, int i)
{
    const Clearance *joint = &rhs->clearance[i];
    if (!discrete->contact[i].closed)
        return -joint->delta;
    return !gives(i) ? -joint->F_n : joint->delta;
}

/* Return whether the rigid surfaces of joint i touch: the gap is within TOUCHING or the contact is closed. */
static int is_touching_at(const Integrator *run, int i, const Parameters *p)
{
    const int near = run->rhs.clearance[i].delta >= -TOUCHING * radial_clearance(p, i);
    return !gives(i) && (near || run->discrete.contact[i].closed);
}

/*
 * Return the step length in s within which no open rigid joint moves by more than half its clearance. Free flight is so
 * smooth that a longer step could leave the bearing and return. Rates are those of the state and, if `step` is given,
 * of its stages.
 */
static double flight_step_limit(const Integrator *run, const Step *step, const Parameters *p)
{
    double least = INFINITY;
    for (int i = 0; i < N_CLEARANCES; i++) {
        double rate = fabs(run->rhs.clearance[i].deltadot);
        if (gives(i) || run->discrete.contact[i].closed)
            continue;
        if (step)
            rate = max_of(rate, max_of(fabs(step->rate[i][0]), fabs(step->rate[i][1])));
        least = min_of(least, 0.5 * radial_clearance(p, i) / rate);
    }
    return least;
}

/* Compute the Delassus operator of the listed contacts at the present state of the run. */
static int compute_present_delassus(Integrator *run, const Parameters *p, Delassus *contacts)
{
    count_evaluations(run, 1 + contacts->n);
    return compute_delassus(motion_with_inner_states, N_Y, run->t, run->y, &run->discrete, p, contacts);
}

/*
 * Add the velocity jumps of contact and friction impulses (N s) to the state, and their lost energy to the work of the
 * joints. meeting: approach speeds, m/s.
 */
static void apply_impulses(Integrator *run, const Delassus *impact, const double *impulse, const double *meeting,
    const FrictionImpulses *friction, const Parameters *p)
{
    const double energy = kinetic_energy(run, p);
    double lost = 0.0;
    for (int k = 0; k < impact->n; k++) {
        double change = 0.0;
        for (int j = 0; j < impact->n; j++)
            change += impact->D[k][j] * impulse[j];
        lost += impulse[k] * (meeting[k] - 0.5 * change); /* impulse times mean gap rate */
        for (int i = 0; i < N_X; i++)
            run->y[N_X + i] += impact->way[k][N_X + i] * impulse[k];
    }
    lost += apply_friction_impulses(friction, impulse, run->y);
    run->y[2 * N_X + 2] -= lost;
    run->y[2 * N_X] += kinetic_energy(run, p) - energy + lost; /* work of drives, which keep their motion */
}

/*
 * Resolve one joint impact of all contacts that touch: those that approach, and those that rest. Rebounds slower than
 * the threshold v_0 are set to zero. Only friction between the surfaces that meet takes part (run/frictional_impact.c).
 * With `limit`, the limit of a sequence of impacts, every touching joint takes part with restitution 0. *approach: the
 * sum of impulse times approach speed in J, 0 if no joint was struck.
 */
static int resolve_impact(Integrator *run, const Parameters *p, int pass, int limit, double *approach)
{
    Delassus impact = {0};
    FrictionImpulses friction;
    double meeting[N_RIGID], r[N_RIGID], impulse[N_RIGID];
    const DiscreteState known = run->discrete;
    const double least = gap_rate_rounding(run, p), gap = gap_rounding(run, p);
    int struck = 0;
    *approach = 0.0;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const double u = run->rhs.clearance[i].deltadot;
        const int meets_now = is_touching_at(run, i, p) && u > resting_speed_limit(least, p, i);
        if (!meets_now && !(is_touching_at(run, i, p) && (limit || u >= -resting_speed_limit(least, p, i))))
            continue;
        const double back = limit ? 0.0 : restitution_of(p, i) * u;
        meeting[impact.n] = u;
        r[impact.n] = meets_now && back > closing_speed_limit(run, p, i, gap) ? u + back : u;
        impact.joint[impact.n++] = i;
        run->discrete.contact[i].closed = 1;
        struck |= meets_now;
    }
    for (int i = 0; i < N_FRICTIONS; i++)
        run->discrete.mode[i] = MODE_HELD; /* without force: friction elements have no impulse */
    disable_friction(&run->discrete);
    int status = struck ? compute_present_delassus(run, p, &impact) : 0;
    status = !status && struck ? complementary(&impact, r, impulse) : status;
    status = !status && struck ? compute_friction_impulses(run, &impact, meeting, impulse, p, &friction) : status;
    run->discrete = known;
    if (status || !struck)
        return status;
    apply_impulses(run, &impact, impulse, meeting, &friction, p);
    update_slip_branches(run, p);
    for (int k = 0; k < impact.n && !status; k++) {
        const int i = impact.joint[k];
        const double u = meeting[k] > resting_speed_limit(least, p, i) ? meeting[k] : 0.0; /* 0: a resting contact */
        const Impact bounce = {run->t, run->t, u, impulse[k], run->t, i};
        if (impulse[k] > 0.0)
            status = list_impact(run, &bounce, pass >= LISTED_PASSES, !known.contact[i].closed);
        *approach += impulse[k] * u;
    }
    return status ? status : update_modes_after_impact(run, p);
}

/*
 * Find the active set of contacts: those that rest, or separate slower than the threshold, and carry a positive force.
 * Joint `opens` (-1: none) has just lost its force and stays open. Return 0, FRICTION_INCONSISTENT or another status.
 */
static int update_closed_contacts(Integrator *run, int opens, const Parameters *p)
{
    unsigned char rests[N_CLEARANCES], pushes[N_CLEARANCES] = {0};
    double force[N_RIGID];
    const DiscreteState known = run->discrete;
    const double least = gap_rate_rounding(run, p);
    Delassus contacts = {0};
    for (int i = 0; i < N_CLEARANCES; i++) {
        const double slow = max_of(threshold_of(p, i), least);
        rests[i] = i != opens && is_touching_at(run, i, p) && fabs(run->rhs.clearance[i].deltadot) <= slow;
        if (!gives(i))
            run->discrete.contact[i].closed = rests[i];
        if (rests[i])
            contacts.joint[contacts.n++] = i;
    }
    update_slip_branches(run, p);
    int status = contacts.n ? compute_present_delassus(run, p, &contacts) : 0;
    if (!status)
        status = is_frictionally_inconsistent(&contacts, 1, p) ? FRICTION_INCONSISTENT
                                                               : complementary(&contacts, contacts.r, force);
    for (int k = 0; k < contacts.n && !status; k++)
        pushes[contacts.joint[k]] = force[k] > 0.0;
    for (int i = 0; i < N_CLEARANCES; i++)
        run->discrete.contact[i].closed = known.contact[i].closed;
    for (int i = 0; i < N_CLEARANCES && !status; i++)
        if (!gives(i))
            status = set_contact_closed(run, i, pushes[i]);
    return status;
}

/*
 * Project closed contacts onto delta = 0 and give separating contacts a small gap, so that the next step can detect
 * their return.
 */
static int separate_contacts(Integrator *run, const Parameters *p)
{
    const double energy = kinetic_energy(run, p);
    double distance = gap_rounding(run, p);
    int status = 0, meets_again = 1;
    for (int pass = 0; pass < MAX_SEPARATIONS && meets_again && !status; pass++, distance *= 4.0) {
        double gap[N_RIGID];
        Delassus touching = {0};
        for (int i = 0; i < N_CLEARANCES; i++) {
            if (gives(i) || (!run->discrete.contact[i].closed && run->rhs.clearance[i].delta < -distance))
                continue;
            gap[touching.n] = run->discrete.contact[i].closed ? 0.0 : distance;
            touching.joint[touching.n++] = i;
        }
        status = touching.n ? project_contacts(run, run->t, run->y, p, &touching, gap) : 0;
        if (!status && touching.n)
            status = rates(run, run->t, run->y, p, run->dy, &run->rhs);
        meets_again = 0; /* distant points round by more; separating one contact may close another, as in a wedge */
        for (int i = 0; i < N_CLEARANCES && touching.n; i++)
            meets_again |= !gives(i) && !run->discrete.contact[i].closed && !(run->rhs.clearance[i].delta < 0.0);
    }
    run->y[2 * N_X + 2] += kinetic_energy(run, p) - energy; /* of separations slower than the threshold */
    return status;
}

/*
 * Resolve impacts until no surfaces approach; return 0, CHATTERING or another status. One impact may make other
 * surfaces approach, and these the first ones again, as in a wedge. Two contacts with the Delassus operator D that
 * strike in turn approach at x[n+1] = (1 + e) k x[n] - e x[n-1], where k = -D12/sqrt(D11 D22), x scaled by sqrt(D). If
 * (1 + e) k < 2 sqrt(e) some x is negative: the sequence ends. Otherwise the x tend to a geometric sequence that never
 * ends. Its limit has no approach speed left and the impulses sum = D^-1 u: the joint impact of all touching contacts
 * with e = 0. That impact is solved directly once the ratio is steady, or after MAX_PASSES.
 */
static int resolve_impacts(Integrator *run, const Parameters *p)
{
    double sizes[5] = {0.0}; /* impulse times approach speed of the last passes, J */
    int limit = 0, status = rates(run, run->t, run->y, p, run->dy, &run->rhs);
    for (int pass = 0; pass < 2 * MAX_PASSES && !status; pass++) {
        memmove(sizes, sizes + 1, sizeof sizes - sizeof *sizes);
        status = resolve_impact(run, p, pass, limit, &sizes[4]);
        if (status || !(sizes[4] > 0.0))
            return status;
        status = rates(run, run->t, run->y, p, run->dy, &run->rhs);
        const double first = sizes[2] / sizes[0], second = sizes[4] / sizes[2]; /* of two passes: contacts alternate */
        limit |= pass >= MAX_PASSES || (pass >= 4 && second < 1.0 && fabs(second - first) < RATIO_TOL * second);
    }
    return status ? status : CHATTERING;
}

/*
 * Resolve impacts, update the active set of contacts and the friction modes, and evaluate the right-hand side after
 * them. event: the event function that ended the step, -1: none.
 */
static int update_contacts(Integrator *run, int event, const Parameters *p)
{
    const int opens = event >= 0 && event < N_CLEARANCES && !gives(event) && run->discrete.contact[event].closed;
    int status = resolve_impacts(run, p);
    for (int pass = 0; pass < 2 && !status; pass++) { /* forces of stick and of contacts depend on each other */
        status = update_closed_contacts(run, opens ? event : -1, p);
        if (!status)
            status = update_friction_modes(run, p);
        if (!N_FRICTIONS)
            break;
    }
    if (!status)
        status = separate_contacts(run, p);
    return status ? status : update_branches_at(run, run->t, run->y, run->dy, &run->rhs, -1, p);
}

/*
 * Resolve impacts and close resting contacts at a start where surfaces touch. Return LOST if a journal is outside its
 * bearing.
 */
static int begin_contacts(Integrator *run, const Parameters *p)
{
    int some = 0;
    for (int i = 0; i < N_CLEARANCES; i++) {
        if (gives(i) || run->discrete.contact[i].closed)
            continue;
        if (run->rhs.clearance[i].delta > 1e-6 * radial_clearance(p, i))
            return LOST;
        some |= is_touching_at(run, i, p);
    }
    return some ? update_contacts(run, -1, p) : 0;
}

#else
/*
 * Return the event function of the contact of joint i in m: the gap of an open contact, the penetration of a closed
 * one.
 */
static inline double contact_event_function(const DiscreteState *discrete, const RhsOutputs *rhs, int i)
{
    return discrete->contact[i].closed ? rhs->clearance[i].delta : -rhs->clearance[i].delta;
}

/* Leave the state unchanged: the scene has no rigid contacts. */
static inline void project_closed_contacts(Integrator *run, double t, double *y, const Parameters *p)
{
    (void)run, (void)t, (void)y, (void)p;
}

/* Return infinity: the scene has no rigid contacts that limit the step. */
static inline double flight_step_limit(const Integrator *run, const Step *step, const Parameters *p)
{
    return (void)run, (void)step, (void)p, INFINITY;
}

/* Return the status `otherwise`: the scene has no rigid contacts that could be inconsistent. */
static inline int diagnose_stall(const Integrator *run, int otherwise, const Parameters *p)
{
    return (void)run, (void)p, otherwise;
}

/* Return 0: the scene has no rigid contacts. */
static inline int update_contacts(Integrator *run, int event, const Parameters *p)
{
    (void)run, (void)event, (void)p;
    return 0;
}

/* Return 0: the scene has no rigid contacts. */
static inline int begin_contacts(Integrator *run, const Parameters *p)
{
    (void)run, (void)p;
    return 0;
}
#endif
