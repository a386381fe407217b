/*
 * Surfaces that do not give (Newton's restitution): velocities jump where a gap closes, a contact that lasts is held
 * closed until its force is used up. All contacts of one time go by one linear complementarity problem
 * (contact_forces.h), of impulses (r = u + e u where surfaces meet at the rate u) and of forces (r = delta'').
 * J. J. Moreau, in: Nonsmooth Mechanics and Applications (1988); F. Pfeiffer, C. Glocker, Multibody Dynamics with
 * Unilateral Contacts (1996).
 */
#if N_RIGID
#define TOUCHING 1e-10 /* of the clearance: surfaces that are no further apart touch */
#define STEADY 1e-8    /* two ratios of what successive passes take that differ by no more are one geometric ratio */
enum { MAX_PASSES = 1000, LISTED_PASSES = 8, MAX_APART = 12 };

/* Not negative while things go on as they are: the gap of a free joint, m, the force of a closed contact, N. */
static double contact_event_function(const DiscreteState *discrete, const RhsOutputs *rhs, int i)
{
    const Clearance *joint = &rhs->clearance[i];
    if (!discrete->contact[i].closed)
        return -joint->delta;
    return !gives(i) ? -joint->F_n : joint->delta;
}

static int is_touching_at(const Integrator *run, int i, const Parameters *p)
{
    const int near = run->rhs.clearance[i].delta >= -TOUCHING * radial_clearance(p, i);
    return !gives(i) && (near || run->discrete.contact[i].closed);
}

/*
 * A step in which no free journal goes further towards its wall, or from it, than half its clearance: flights are so
 * smooth that a step could else lead out of the bearing and back. Seconds from rates now, less what stages saw of them.
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

static int delassus_here(Integrator *run, const Parameters *p, Delassus *contacts)
{
    count_evaluations(run, 1 + contacts->n);
    return compute_delassus(motion_of_laws, N_Y, run->t, run->y, &run->discrete, p, contacts);
}

/* Impulses: what they change in the velocities, their work, and what is listed of them. */
static void apply_impulses(Integrator *run, const Delassus *impact, const double *impulse, const double *meeting,
    const Rub *rub, const Parameters *p)
{
    const double energy = kinetic_energy(run, p);
    double lost = 0.0;
    for (int k = 0; k < impact->n; k++) {
        double change = 0.0;
        for (int j = 0; j < impact->n; j++)
            change += impact->D[k][j] * impulse[j];
        lost += impulse[k] * (meeting[k] - 0.5 * change); /* the impulse by the mean rate of the gap */
        for (int i = 0; i < N_X; i++)
            run->y[N_X + i] += impact->way[k][N_X + i] * impulse[k];
    }
    lost += apply_friction_impulses(rub, impulse, run->y);
    run->y[2 * N_X + 2] -= lost;
    run->y[2 * N_X] += kinetic_energy(run, p) - energy + lost; /* what drives hold moves on as before */
}

/*
 * Every joint that touches and closes at a rate gets its impulse, and with it each that rests, closed or not yet: one
 * blow. A parting that would be slower than the threshold is none. No friction has a part in it but that of the
 * surfaces that meet (frictional_impact.c). In the limit of a sequence of impacts every joint that touches takes part,
 * with a restitution of 0. *approach: the sum of impulse times approach speed, J, 0 if no joint was struck.
 */
static int resolve_impact(Integrator *run, const Parameters *p, int pass, int limit, double *approach)
{
    Delassus impact = {0};
    Rub rub;
    double meeting[N_RIGID], r[N_RIGID], impulse[N_RIGID];
    const DiscreteState known = run->discrete;
    const double least = least_rate(run, p), gap = least_gap(run, p);
    int struck = 0;
    *approach = 0.0;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const double u = run->rhs.clearance[i].deltadot;
        const int meets_now = is_touching_at(run, i, p) && u > resting(least, p, i);
        if (!meets_now && !(is_touching_at(run, i, p) && (limit || u >= -resting(least, p, i))))
            continue;
        const double back = limit ? 0.0 : restitution_of(p, i) * u;
        meeting[impact.n] = u;
        r[impact.n] = meets_now && back > least_bounce(run, p, i, gap) ? u + back : u;
        impact.joint[impact.n++] = i;
        run->discrete.contact[i].closed = 1;
        struck |= meets_now;
    }
    for (int i = 0; i < N_FRICTIONS; i++)
        run->discrete.mode[i] = 2.0; /* none: it has a force, not an impulse */
    without_friction(&run->discrete);
    int status = struck ? delassus_here(run, p, &impact) : 0;
    status = !status && struck ? complementary(&impact, r, impulse) : status;
    status = !status && struck ? friction_impulses(run, &impact, meeting, impulse, p, &rub) : status;
    run->discrete = known;
    if (status || !struck)
        return status;
    apply_impulses(run, &impact, impulse, meeting, &rub, p);
    update_slip_branches(run, p);
    for (int k = 0; k < impact.n && !status; k++) {
        const int i = impact.joint[k];
        const double u = meeting[k] > resting(least, p, i) ? meeting[k] : 0.0; /* it rests, and is pressed */
        const Impact bounce = {run->t, run->t, u, impulse[k], run->t, i};
        if (impulse[k] > 0.0)
            status = list_impact(run, &bounce, pass >= LISTED_PASSES, !known.contact[i].closed);
        *approach += impulse[k] * u;
    }
    return status ? status : modes_after_impact(run, p);
}

/*
 * Which contacts that rest, or part slower than the threshold, are closed: those that must push. Joint `opens` (-1:
 * none) has just ceased to.
 */
static int update_closed_contacts(Integrator *run, int opens, const Parameters *p)
{
    unsigned char rests[N_CLEARANCES], pushes[N_CLEARANCES] = {0};
    double force[N_RIGID];
    const DiscreteState known = run->discrete;
    const double least = least_rate(run, p);
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
    int status = contacts.n ? delassus_here(run, p, &contacts) : 0;
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

/* Closed contacts exactly at e = c, and what touches and parts a little apart: the next step looks for its return. */
static int separate_contacts(Integrator *run, const Parameters *p)
{
    const double energy = kinetic_energy(run, p);
    double apart = least_gap(run, p);
    int status = 0, meets_again = 1;
    for (int pass = 0; pass < MAX_APART && meets_again && !status; pass++, apart *= 4.0) {
        double gap[N_RIGID];
        Delassus touching = {0};
        for (int i = 0; i < N_CLEARANCES; i++) {
            if (gives(i) || (!run->discrete.contact[i].closed && run->rhs.clearance[i].delta < -apart))
                continue;
            gap[touching.n] = run->discrete.contact[i].closed ? 0.0 : apart;
            touching.joint[touching.n++] = i;
        }
        status = touching.n ? project_contacts(run, run->t, run->y, p, &touching, gap) : 0;
        if (!status && touching.n)
            status = rates(run, run->t, run->y, p, run->dy, &run->rhs);
        meets_again = 0; /* corners far out are rounded by more; one put apart may make another meet, as in a wedge */
        for (int i = 0; i < N_CLEARANCES && touching.n; i++)
            meets_again |= !gives(i) && !run->discrete.contact[i].closed && !(run->rhs.clearance[i].delta < 0.0);
    }
    run->y[2 * N_X + 2] += kinetic_energy(run, p) - energy; /* of partings slower than the threshold */
    return status;
}

/*
 * Impacts until no surfaces meet. An impact may make other surfaces meet, and these the first ones again: a wedge. Two
 * contacts with the Delassus operator D that strike in turn approach at x[n+1] = (1 + e) k x[n] - e x[n-1], where
 * k = -D12/sqrt(D11 D22), x scaled by sqrt(D). If (1 + e) k < 2 sqrt(e) some x is negative: the sequence ends.
 * Otherwise the x tend to a geometric sequence that never ends. Its limit has no approach left and the impulses that
 * add up to this, sum = D^-1 u: the joint impact of all contacts that touch with e = 0, which is solved directly
 * once the ratio is steady, or after MAX_PASSES.
 */
static int resolve_impacts(Integrator *run, const Parameters *p)
{
    double sizes[5] = {0.0}; /* of the last passes, J */
    int limit = 0, status = rates(run, run->t, run->y, p, run->dy, &run->rhs);
    for (int pass = 0; pass < 2 * MAX_PASSES && !status; pass++) {
        memmove(sizes, sizes + 1, sizeof sizes - sizeof *sizes);
        status = resolve_impact(run, p, pass, limit, &sizes[4]);
        if (status || !(sizes[4] > 0.0))
            return status;
        status = rates(run, run->t, run->y, p, run->dy, &run->rhs);
        const double first = sizes[2] / sizes[0], second = sizes[4] / sizes[2]; /* every second: contacts may differ */
        limit |= pass >= MAX_PASSES || (pass >= 4 && second < 1.0 && fabs(second - first) < STEADY * second);
    }
    return status ? status : CHATTERING;
}

/*
 * Where contacts may change: blows until none meets, then which contacts rest, then the right-hand side of what
 * follows. `event`: the margin that ended the step, -1 of none.
 */
static int update_contacts(Integrator *run, int event, const Parameters *p)
{
    const int opens = event >= 0 && event < N_CLEARANCES && !gives(event) && run->discrete.contact[event].closed;
    int status = resolve_impacts(run, p);
    for (int pass = 0; pass < 2 && !status; pass++) { /* forces of stick follow those of contacts, and these them */
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

/* A start that touches: what meets there is struck, what rests is closed. One that lies outside its bearing is none. */
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
/* All surfaces give: penetration says where contacts begin and end. */
static inline double contact_event_function(const DiscreteState *discrete, const RhsOutputs *rhs, int i)
{
    return discrete->contact[i].closed ? rhs->clearance[i].delta : -rhs->clearance[i].delta;
}

static inline void hold_contacts(Integrator *run, double t, double *y, const Parameters *p)
{
    (void)run, (void)t, (void)y, (void)p;
}

static inline double flight_step_limit(const Integrator *run, const Step *step, const Parameters *p)
{
    return (void)run, (void)step, (void)p, INFINITY;
}

static inline int diagnose_stall(const Integrator *run, int otherwise, const Parameters *p)
{
    return (void)run, (void)p, otherwise;
}

static inline int update_contacts(Integrator *run, int event, const Parameters *p)
{
    (void)run, (void)event, (void)p;
    return 0;
}

static inline int begin_contacts(Integrator *run, const Parameters *p)
{
    (void)run, (void)p;
    return 0;
}
#endif
