/*
 * Impacts and closed contacts of rigid surfaces with Newton's restitution. Velocities jump where a gap closes; a closed
 * contact lasts until its force is zero. One linear complementarity problem (scene/contact_forces.h) determines all
 * contacts of one time: impulses (r = u + e u, u the approach rate) and forces (r = delta'').
 * J. J. Moreau, in: Nonsmooth Mechanics and Applications (1988); F. Pfeiffer, C. Glocker, Multibody Dynamics with
 * Unilateral Contacts (1996).
 */
#if N_RIGID
#define TOUCHING_GAP_FRACTION 1e-10 /* times the clearance: surfaces with a smaller gap touch */
#define RATIO_TOL 1e-8    /* relative difference up to which ratios of successive passes are one geometric ratio */
enum { MAX_IMPACT_PASSES = 1000, N_LISTED_PASSES = 8, MAX_SEPARATIONS = 12 };

/*
 * Return the event function of a contact, non-negative while it stays open or closed: gap of an open contact in m,
 * pressing force of a closed rigid contact in N, penetration of a closed compliant one in m.
 */
static double evaluate_contact_event_function(const DiscreteState *discrete, const RhsOutputs *rhs, int joint)
{
    const Clearance *clearance = &rhs->clearance[joint];
    if (!discrete->contact[joint].closed)
        return -clearance->delta;
    return !is_compliant(joint) ? -clearance->F_n : clearance->delta;
}

/*
 * Return whether the rigid surfaces of a joint touch: the gap is at most TOUCHING_GAP_FRACTION clearances, or the
 * contact is closed. Joints with compliant surfaces return 0.
 */
static int is_rigid_joint_touching(const Integrator *run, int joint, const Parameters *p)
{
    const int has_no_gap = run->rhs.clearance[joint].delta >= -TOUCHING_GAP_FRACTION * radial_clearance(p, joint);
    return !is_compliant(joint) && (has_no_gap || run->discrete.contact[joint].closed);
}

/*
 * Return the step length in s within which no open rigid joint moves by more than half its clearance. Free flight is so
 * smooth that a longer step could leave the bearing and return. Gap rates are those of the run's state and, if `step`
 * is not NULL, also of its stages. Infinite without an open rigid joint. Called before each step, and after it with its
 * stages.
 */
static double compute_flight_step_limit(const Integrator *run, const Step *step, const Parameters *p)
{
    double limit = INFINITY;
    for (int i = 0; i < N_CLEARANCES; i++) {
        double rate = fabs(run->rhs.clearance[i].deltadot);
        if (is_compliant(i) || run->discrete.contact[i].closed)
            continue;
        if (step)
            rate = max_of(rate, max_of(fabs(step->gap_rate_range[i][0]), fabs(step->gap_rate_range[i][1])));
        limit = min_of(limit, 0.5 * radial_clearance(p, i) / rate);
    }
    return limit;
}

/*
 * Compute the Delassus operator of the listed contacts at the current state of the run (response to unit contact
 * forces). Count the evaluations; return a status.
 */
static int compute_current_delassus(Integrator *run, const Parameters *p, Delassus *contacts)
{
    count_evaluations(run, 1 + contacts->n);
    return compute_delassus(evaluate_motion_with_internal_states, N_Y, run->t, run->y, &run->discrete, p, contacts);
}

/*
 * Add the velocity jumps of normal impulses (N s) and of friction impulses to run->y. The energy that they dissipate is
 * subtracted from the work of the joints; the work of drives balances the kinetic energy. approach_speed: of each
 * contact before the impact, m/s. Called by resolve_impact().
 */
static void apply_impulses(Integrator *run, const Delassus *impact, const double *impulse, const double *approach_speed,
    const FrictionImpulses *friction, const Parameters *p)
{
    const double energy = compute_kinetic_energy(run, p);
    double dissipated = 0.0;
    for (int k = 0; k < impact->n; k++) {
        double speed_change = 0.0;
        for (int j = 0; j < impact->n; j++)
            speed_change += impact->D[k][j] * impulse[j];
        dissipated += impulse[k] * (approach_speed[k] - 0.5 * speed_change); /* impulse times mean gap rate */
        for (int i = 0; i < N_X; i++)
            run->y[N_X + i] += impact->response[k][N_X + i] * impulse[k];
    }
    dissipated += apply_friction_impulses(friction, impulse, run->y);
    run->y[2 * N_X + 2] -= dissipated;
    run->y[2 * N_X] += compute_kinetic_energy(run, p) - energy
        + dissipated; /* work of drives, which keep their motion */
}

/*
 * Resolve one joint impact of all rigid contacts that touch: those that approach, and those that rest. Rebounds slower
 * than the threshold v_0 are set to zero. Friction acts only between these surfaces (run/frictional_impact.c).
 * use_joint_impact: resolve the limit of a sequence of impacts, in which every touching joint has restitution 0.
 * n_impacts_before: number of previous impacts at this time. *energy: sum of impulse times approach speed in J, 0 if no
 * joint approaches. Return a status.
 */
static int resolve_impact(
    Integrator *run, const Parameters *p, int n_impacts_before, int use_joint_impact, double *energy)
{
    Delassus impact = {0};
    FrictionImpulses friction;
    double approach_speed[N_RIGID], rebound_sum[N_RIGID], impulse[N_RIGID];
    const DiscreteState state_before = run->discrete;
    const double min_rate = compute_gap_rate_tolerance(run, p), gap = compute_gap_tolerance(run, p);
    int has_impact = 0;
    *energy = 0.0;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const double u = run->rhs.clearance[i].deltadot;
        const int approaches = is_rigid_joint_touching(run, i, p) && u > compute_resting_speed_limit(min_rate, p, i);
        if (!approaches && !(is_rigid_joint_touching(run, i, p)
            && (use_joint_impact || u >= -compute_resting_speed_limit(min_rate, p, i))))
            continue;
        const double rebound_speed = use_joint_impact ? 0.0 : restitution_of(p, i) * u;
        approach_speed[impact.n] = u;
        rebound_sum[impact.n] = approaches && rebound_speed > compute_closing_speed_limit(run, p, i, gap)
            ? u + rebound_speed
            : u;
        impact.joint[impact.n++] = i;
        run->discrete.contact[i].closed = 1;
        has_impact |= approaches;
    }
    for (int i = 0; i < N_FRICTIONS; i++)
        run->discrete.mode[i] = MODE_CONSTRAINED; /* without force: friction elements have no impulse */
    disable_friction(&run->discrete);
    int status = has_impact ? compute_current_delassus(run, p, &impact) : 0;
    status = !status && has_impact ? solve_complementarity(&impact, rebound_sum, impulse) : status;
    status = !status && has_impact ? compute_friction_impulses(run, &impact, approach_speed, impulse, p, &friction)
        : status;
    run->discrete = state_before;
    if (status || !has_impact)
        return status;
    apply_impulses(run, &impact, impulse, approach_speed, &friction, p);
    update_frozen_branches(run, p);
    for (int k = 0; k < impact.n && !status; k++) {
        const int i = impact.joint[k];
        const double u = approach_speed[k] > compute_resting_speed_limit(min_rate, p, i) ? approach_speed[k]
            : 0.0; /* 0: a resting contact */
        const ContactRecord listed = {run->t, run->t, u, impulse[k], run->t, i};
        if (impulse[k] > 0.0)
            status = append_impact(run, &listed, n_impacts_before >= N_LISTED_PASSES, !state_before.contact[i].closed);
        *energy += impulse[k] * u;
    }
    return status ? status : update_modes_after_impact(run, p);
}

/*
 * Find the active set of rigid contacts, and close and open them: closed are those that rest, or separate slower than
 * the threshold, and carry a positive force. opening_joint has just lost its force and stays open, -1: none. Return 0,
 * FRICTION_INCONSISTENT or another status. Called by update_contacts() after all impacts are resolved.
 */
static int update_closed_contacts(Integrator *run, int opening_joint, const Parameters *p)
{
    unsigned char is_resting[N_CLEARANCES], has_force[N_CLEARANCES] = {0};
    double force[N_RIGID];
    const DiscreteState state_before = run->discrete;
    const double min_rate = compute_gap_rate_tolerance(run, p);
    Delassus contacts = {0};
    for (int i = 0; i < N_CLEARANCES; i++) {
        const double speed_limit = max_of(threshold_of(p, i), min_rate);
        is_resting[i] = i != opening_joint && is_rigid_joint_touching(run, i, p)
            && fabs(run->rhs.clearance[i].deltadot) <= speed_limit;
        if (!is_compliant(i))
            run->discrete.contact[i].closed = is_resting[i];
        if (is_resting[i])
            contacts.joint[contacts.n++] = i;
    }
    update_frozen_branches(run, p);
    int status = contacts.n ? compute_current_delassus(run, p, &contacts) : 0;
    if (!status)
        status = has_frictional_inconsistency(&contacts, 1, p) ? FRICTION_INCONSISTENT
                                                               : solve_complementarity(&contacts, contacts.r, force);
    for (int k = 0; k < contacts.n && !status; k++)
        has_force[contacts.joint[k]] = force[k] > 0.0;
    for (int i = 0; i < N_CLEARANCES; i++)
        run->discrete.contact[i].closed = state_before.contact[i].closed;
    for (int i = 0; i < N_CLEARANCES && !status; i++)
        if (!is_compliant(i))
            status = set_rigid_contact(run, i, has_force[i]);
    return status;
}

/*
 * Project closed rigid contacts onto delta = 0 and give touching open ones a gap of compute_gap_tolerance(), so that
 * the next step can detect their return. The gap is quadrupled in up to MAX_SEPARATIONS passes, because separating one
 * contact may close another. The change of kinetic energy is added to the work of the joints. Return a status. Called
 * by update_contacts() after the active set is known.
 */
static int separate_contacts(Integrator *run, const Parameters *p)
{
    const double energy = compute_kinetic_energy(run, p);
    double distance = compute_gap_tolerance(run, p);
    int status = 0, has_contact = 1;
    for (int pass = 0; pass < MAX_SEPARATIONS && has_contact && !status; pass++, distance *= 4.0) {
        double gap[N_RIGID];
        Delassus touching = {0};
        for (int i = 0; i < N_CLEARANCES; i++) {
            if (is_compliant(i) || (!run->discrete.contact[i].closed && run->rhs.clearance[i].delta < -distance))
                continue;
            gap[touching.n] = run->discrete.contact[i].closed ? 0.0 : distance;
            touching.joint[touching.n++] = i;
        }
        status = touching.n ? project_contacts(run, run->t, run->y, p, &touching, gap) : 0;
        if (!status && touching.n)
            status = evaluate_run_rhs(run, run->t, run->y, p, run->dy, &run->rhs);
        has_contact = 0; /* distant points round by more; separating one contact may close another, as in a wedge */
        for (int i = 0; i < N_CLEARANCES && touching.n; i++)
            has_contact |= !is_compliant(i) && !run->discrete.contact[i].closed && !(run->rhs.clearance[i].delta < 0.0);
    }
    run->y[2 * N_X + 2] += compute_kinetic_energy(run, p) - energy; /* of separations slower than the threshold */
    return status;
}

/*
 * Resolve impacts at the current time until no rigid surfaces approach; return 0, CHATTERING or another status. One
 * impact may make other surfaces approach, and these the first ones again, as in a wedge. Two contacts with the
 * Delassus operator G approach in turn at chi[n+1] = (1 + c_e) kappa chi[n] - c_e chi[n-1], where kappa = -G12/sqrt(G11
 * G22), and chi is the approach speed over sqrt(G11) or sqrt(G22). If (1 + c_e) kappa < 2 sqrt(c_e) some chi is
 * negative: the sequence ends. Otherwise the chi tend to a geometric sequence that never ends. Its limit has no
 * approach speed left and the impulses sum = G^-1 u: the joint impact of all touching contacts with c_e = 0. That
 * impact is solved directly once the ratio is steady, or after MAX_IMPACT_PASSES. Called by update_contacts() at each
 * event, also if nothing approaches.
 */
static int resolve_impacts(Integrator *run, const Parameters *p)
{
    double energies[5] = {0.0}; /* impulse times approach speed of the last passes, J */
    int use_joint_impact = 0, status = evaluate_run_rhs(run, run->t, run->y, p, run->dy, &run->rhs);
    for (int pass = 0; pass < 2 * MAX_IMPACT_PASSES && !status; pass++) {
        memmove(energies, energies + 1, sizeof energies - sizeof *energies);
        status = resolve_impact(run, p, pass, use_joint_impact, &energies[4]);
        if (status || !(energies[4] > 0.0))
            return status;
        status = evaluate_run_rhs(run, run->t, run->y, p, run->dy, &run->rhs);
        const double ratio_before = energies[2] / energies[0],
            ratio = energies[4] / energies[2]; /* of two passes: contacts alternate */
        use_joint_impact |= pass >= MAX_IMPACT_PASSES
            || (pass >= 4 && ratio < 1.0 && fabs(ratio - ratio_before) < RATIO_TOL * ratio);
    }
    return status ? status : CHATTERING;
}

/*
 * Resolve impacts, update the active set of rigid contacts and the friction modes, and evaluate the right-hand side
 * after them. event: the event function that ended the step; if it is that of a closed rigid contact, this contact
 * opens; -1: none. Called at each event and at jumps of drives. Return a status.
 */
static int update_contacts(Integrator *run, int event, const Parameters *p)
{
    const int is_opening = event >= 0 && event < N_CLEARANCES && !is_compliant(event)
        && run->discrete.contact[event].closed;
    int status = resolve_impacts(run, p);
    for (int pass = 0; pass < 2 && !status; pass++) { /* forces of stick and of contacts depend on each other */
        status = update_closed_contacts(run, is_opening ? event : -1, p);
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
 * Resolve impacts and close resting rigid contacts at the start of a run, if surfaces of an open contact touch. Return
 * 0, LOST if a penetration exceeds 1e-6 clearances, or another status.
 */
static int initialize_rigid_contacts(Integrator *run, const Parameters *p)
{
    int has_touching = 0;
    for (int i = 0; i < N_CLEARANCES; i++) {
        if (is_compliant(i) || run->discrete.contact[i].closed)
            continue;
        if (run->rhs.clearance[i].delta > 1e-6 * radial_clearance(p, i))
            return LOST;
        has_touching |= is_rigid_joint_touching(run, i, p);
    }
    return has_touching ? update_contacts(run, -1, p) : 0;
}

#else
/*
 * Return the event function of a contact in m, non-negative while it stays open or closed: the gap of an open contact,
 * the penetration of a closed one.
 */
static inline double evaluate_contact_event_function(const DiscreteState *discrete, const RhsOutputs *rhs, int joint)
{
    return discrete->contact[joint].closed ? rhs->clearance[joint].delta : -rhs->clearance[joint].delta;
}

/* Leave the state unchanged: the scene has no rigid contacts. */
static inline void project_closed_contacts(Integrator *run, double t, double *y, const Parameters *p)
{
    (void)run, (void)t, (void)y, (void)p;
}

/* Return infinity: the scene has no rigid contacts that limit the step. */
static inline double compute_flight_step_limit(const Integrator *run, const Step *step, const Parameters *p)
{
    return (void)run, (void)step, (void)p, INFINITY;
}

/* Return default_status: the scene has no rigid contacts that could be inconsistent. */
static inline int diagnose_stall(const Integrator *run, int default_status, const Parameters *p)
{
    return (void)run, (void)p, default_status;
}

/* Return the status 0: the scene has no rigid contacts. */
static inline int update_contacts(Integrator *run, int event, const Parameters *p)
{
    (void)run, (void)event, (void)p;
    return 0;
}

/* Return the status 0: the scene has no rigid contacts. */
static inline int initialize_rigid_contacts(Integrator *run, const Parameters *p)
{
    (void)run, (void)p;
    return 0;
}
#endif
