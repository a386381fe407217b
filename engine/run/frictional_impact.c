/*
 * Friction in impacts between rigid surfaces. The impact without friction has already set the separation speeds by the
 * restitution. Tangential impulses P_t bring the slip after the impact to rest, as far as |P_t| <= c_d P_n allows;
 * normal impulses P_n change with P_t so that no separation speed does. Let v be the slip after an impact without
 * rebound: P_t adds P_t v + P_t G_t P_t/2 to the kinetic energy, and is reduced where that sum would be positive.
 * A. Chatterjee, A. Ruina, Journal of Applied Mechanics 65 (1998) 939-951, doi 10.1115/1.2791938: their tangential
 * restitution between -1 and 1 is chosen here, for several contacts at once.
 */
#if N_RIGID_WITH_FRICTION
#define INCONSISTENT_RATIO 10.0 /* ratio to the forces without friction that only an inconsistency reaches */
enum { MAX_SWEEPS = 1000 };

/* Tangential impulses of the contacts of an impact, and the response of gap rates, slips and velocities to them. */
typedef struct {
    int n;                         /* number of contacts of the impact */
    double P[N_RIGID];             /* the impulses, N s */
    double before[N_RIGID];        /* slip, m/s */
    double plastic[N_RIGID];       /* slip after an impact without rebound and friction, m/s */
    double after[N_RIGID];         /* slip after the impact with rebound, without friction, m/s */
    double mu[N_RIGID];            /* F_t/F_n of the friction law there */
    double gap_rate[N_RIGID][N_RIGID]; /* change of deltadot of the row per unit P of the column, 1/kg */
    double slip[N_RIGID][N_RIGID]; /* change of the slip of the row per unit P of the column, 1/kg */
    double normal[N_RIGID][N_RIGID]; /* normal impulse per unit P that keeps separation speeds unchanged */
    double velocity[N_RIGID][N_X];      /* change of velocities per unit P */
} FrictionImpulses;

/*
 * Set all contacts of a discrete state to be frictionless (`is_frictionless`), and their prescribed tangential forces
 * (`tangential_force`) to zero. Called for impacts and the projection of contacts, on a copy or on a state that is
 * restored.
 */
static void disable_friction(DiscreteState *discrete)
{
    for (int i = 0; i < N_CLEARANCES; i++) {
        discrete->contact[i].is_frictionless = 1;
        discrete->contact[i].tangential_force = 0.0;
    }
}

/*
 * Return FRICTION_INCONSISTENT if a run that stalls has frictionally inconsistent contacts (Painleve paradox), else
 * default_status. Friction then lets their forces grow without bound, or leaves them none.
 *
 * The criterion: with friction the largest contact force exceeds INCONSISTENT_RATIO times that without friction, or a
 * contact loses its force (F. Genot, B. Brogliato, European Journal of Mechanics A/Solids 18 (1999) 653-677). Called
 * when a run stalls or its step size underflows.
 */
static int diagnose_stall(const Integrator *run, int default_status, const Parameters *p)
{
    double force[2][N_RIGID], max_force[2] = {0.0, 0.0};
    int has_lost_force = 0;
    for (int is_frictionless = 0; is_frictionless < 2; is_frictionless++) {
        DiscreteState discrete = run->discrete;
        Delassus contacts;
        contacts.n = list_closed_contacts(&discrete, contacts.joint);
        if (is_frictionless)
            disable_friction(&discrete);
        if (compute_delassus(evaluate_motion_with_internal_states, N_Y, run->t, run->y, &discrete, p, &contacts))
            return default_status;
        solve_contact_subset(&contacts, NULL, contacts.r, force[is_frictionless]);
        for (int k = 0; k < contacts.n; k++) {
            max_force[is_frictionless] = max_of(max_force[is_frictionless], fabs(force[is_frictionless][k]));
            /* the others took all of D */
            has_lost_force |= is_frictionless && force[0][k] == 0.0 && force[1][k] != 0.0;
        }
    }
    return has_lost_force || max_force[0] > INCONSISTENT_RATIO * max_force[1] ? FRICTION_INCONSISTENT : default_status;
}

/*
 * Set the frozen branch of each switching function to the sign of its value, after velocities have jumped: friction in
 * closed contacts depends on the branches. At most six passes. Nothing happens if branches are not frozen or the
 * evaluation fails; the caller's next evaluation reports the failure.
 */
static void update_frozen_branches(Integrator *run, const Parameters *p)
{
    int changed = N_SWITCHES && run->discrete.is_frozen;
    for (int pass = 0; pass < 6 && changed; pass++) {
        double dy[N_Y];
        RhsOutputs rhs;
        changed = 0;
        count_evaluations(run, 1);
        if (evaluate_motion_with_internal_states(run->t, run->y, &run->discrete, p, dy, &rhs))
            return; /* the next evaluation reports the status */
        for (int k = 0; k < N_SWITCHES; k++)
            if (run->discrete.branch[k] * rhs.g[k] < 0.0) {
                run->discrete.branch[k] = -run->discrete.branch[k];
                changed = 1;
            }
    }
}

/*
 * Compute the slip (m/s) of each contact after normal impulses (N s), and mu = |F_t|/F_n of the friction laws there, 0
 * without an impulse. unit_force: normal force in N at which the laws are evaluated. Branches of friction laws follow
 * the slip. The state of the run is not changed. Return a status.
 */
static int compute_slips_after_impact(Integrator *run, const Delassus *impact, const double *impulse, double unit_force,
    const Parameters *p, double *slip, double *mu)
{
    double y[N_Y], dy[N_Y];
    DiscreteState discrete = run->discrete;
    RhsOutputs rhs;
    discrete.is_frozen = 0; /* branches of friction laws follow this slip */
    for (int i = 0; i < N_Y; i++)
        y[i] = run->y[i];
    for (int k = 0; k < impact->n; k++) {
        discrete.contact[impact->joint[k]].is_frictionless = 0;
        discrete.contact[impact->joint[k]].force = unit_force;
        for (int i = 0; i < N_X; i++)
            y[N_X + i] += impact->response[k][N_X + i] * impulse[k];
    }
    count_evaluations(run, 1);
    const int status = evaluate_motion_with_internal_states(run->t, y, &discrete, p, dy, &rhs);
    for (int k = 0; k < impact->n; k++) {
        const Clearance *joint = &rhs.clearance[impact->joint[k]];
        slip[k] = joint->v_t;
        mu[k] = impulse[k] > 0.0 ? fabs(joint->F_t) / unit_force : 0.0;
    }
    return status;
}

/*
 * Compute the change of gap rates, slips and velocities per unit of a tangential impulse in one contact, as column
 * `contact` of each matrix in `friction`. unit_impulse: the impulse of the difference quotient, N s; base_rates,
 * rhs_base: rates and outputs without it. Return a status. Called for each contact with friction of an impact.
 */
static int compute_tangential_response(Integrator *run, const Delassus *impact, int contact, const double *base_rates,
    const RhsOutputs *rhs_base, double unit_impulse, const Parameters *p, FrictionImpulses *friction)
{
    double rates_with_impulse[N_Y], y[N_Y];
    DiscreteState discrete = run->discrete;
    RhsOutputs rhs;
    discrete.contact[impact->joint[contact]].tangential_force = unit_impulse;
    count_evaluations(run, 2);
    int status = evaluate_motion_with_internal_states(run->t, run->y, &discrete, p, rates_with_impulse, &rhs);
    discrete.contact[impact->joint[contact]].tangential_force = 0.0;
    for (int i = 0; i < N_Y; i++)
        y[i] = run->y[i];
    for (int i = 0; i < N_X; i++) {
        friction->velocity[contact][i] = (rates_with_impulse[N_X + i] - base_rates[N_X + i]) / unit_impulse;
        y[N_X + i] += friction->velocity[contact][i] * unit_impulse;
    }
    status = status ? status : evaluate_motion_with_internal_states(run->t, y, &discrete, p, rates_with_impulse, &rhs);
    for (int k = 0; k < impact->n; k++) {
        const int i = impact->joint[k];
        friction->gap_rate[k][contact] = (rhs.clearance[i].deltadot - rhs_base->clearance[i].deltadot) / unit_impulse;
        friction->slip[k][contact] = (rhs.clearance[i].v_t - rhs_base->clearance[i].v_t) / unit_impulse;
    }
    return status;
}

/*
 * Return the largest |P| of one direction that satisfies |P| <= mu times the normal impulse, N s. normal_impulse: at P
 * = 0; normal_per_tangential: its change per unit of |P|. Infinite if the normal impulse grows at least as fast as the
 * limit; 0 without a normal impulse.
 */
static double compute_impulse_limit(double mu, double normal_impulse, double normal_per_tangential)
{
    if (normal_impulse <= 0.0)
        return 0.0;
    return mu * normal_per_tangential < 1.0 ? mu * normal_impulse / (1.0 - mu * normal_per_tangential) : INFINITY;
}

/*
 * Compute the tangential impulses friction->P (N s) of all contacts by Gauss-Seidel sweeps: each contact brings its
 * slip to rest or reaches its friction limit. Afterwards one common factor scales all P, if a limit or the energy still
 * requires that: friction never adds energy. impulse: normal impulses without friction, N s. The sweeps end when P is
 * steady, or after MAX_SWEEPS.
 */
static void solve_friction_impulses(const Delassus *impact, const double *impulse, FrictionImpulses *friction)
{
    const int n = impact->n;
    double S[N_RIGID][N_RIGID], size = 0.0, change = INFINITY, fraction = 1.0, dissipated = 0.0, quadratic = 0.0;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            S[i][j] = friction->slip[i][j];
            for (int k = 0; k < n; k++)
                S[i][j] -= friction->gap_rate[k][i] * friction->normal[k][j];
        }
    for (int sweep = 0; sweep < MAX_SWEEPS && change > 1e-15 * size; sweep++) {
        change = 0.0;
        for (int i = 0; i < n; i++) {
            double slip = friction->after[i], rest = impulse[i];
            if (friction->mu[i] <= 0.0 || S[i][i] <= DEPENDENT_PIVOT * friction->slip[i][i])
                continue;
            for (int j = 0; j < n; j++) {
                slip += j != i ? S[i][j] * friction->P[j] : 0.0;
                rest += j != i ? friction->normal[i][j] * friction->P[j] : 0.0;
            }
            const double direction = slip > 0.0 ? -1.0 : 1.0;
            const double largest = compute_impulse_limit(friction->mu[i], rest, direction * friction->normal[i][i]);
            const double next = direction * min_of(fabs(slip) / S[i][i], largest);
            change = max_of(change, fabs(next - friction->P[i]));
            size = max_of(size, fabs(next));
            friction->P[i] = next;
        }
    }
    for (int i = 0; i < n; i++) {
        double more = 0.0;
        for (int j = 0; j < n; j++) {
            more += friction->normal[i][j] * friction->P[j];
            quadratic += friction->P[i] * S[i][j] * friction->P[j];
        }
        dissipated -= friction->P[i] * friction->plastic[i];
        const double over = fabs(friction->P[i]) - friction->mu[i] * more;
        if (friction->P[i] != 0.0 && over > friction->mu[i] * impulse[i])
            fraction = min_of(fraction, friction->mu[i] * impulse[i] / over);
        if (impulse[i] + fraction * more < 0.0)
            fraction = min_of(fraction, impulse[i] / -more);
    }
    fraction = quadratic > 0.0 ? max_of(min_of(fraction, 2.0 * dissipated / quadratic), 0.0) : fraction;
    for (int i = 0; i < n; i++)
        friction->P[i] *= fraction;
}

/*
 * Compute the tangential impulses P of an impact into `friction`, and add the normal impulses that they cause to
 * `impulse` (N s), which stays >= 0. approach_speed: of each contact, m/s; impact: the Delassus operator of the
 * contacts. Return 0 or the status of the motion. Called by resolve_impact() after the impulses without friction are
 * known.
 */
static int compute_friction_impulses(
    Integrator *run, const Delassus *impact, const double *approach_speed, double *impulse, const Parameters *p,
    FrictionImpulses *friction)
{
    double base_rates[N_Y], mass[N_Q], impulse_plastic[N_RIGID], mu_plastic[N_RIGID], unit_force = 0.0;
    unsigned char pushes[N_RIGID];
    RhsOutputs rhs_before;
    *friction = (FrictionImpulses){.n = impact->n};
    for (int k = 0; k < impact->n; k++)
        pushes[k] = impulse[k] > 0.0;
    mass_matrix(p, mass);
    for (int k = 0; k < N_Q; k += 3)
        unit_force += mass[k];
    for (int k = 0; k < impact->n; k++)
        run->discrete.contact[impact->joint[k]].force = 0.0;
    count_evaluations(run, 1);
    int status = evaluate_motion_with_internal_states(run->t, run->y, &run->discrete, p, base_rates, &rhs_before);
    solve_contact_subset(impact, pushes, approach_speed, impulse_plastic);
    status = status ? status : compute_slips_after_impact(run, impact, impulse_plastic, unit_force, p,
        friction->plastic, mu_plastic);
    status = status ? status : compute_slips_after_impact(run, impact, impulse, unit_force, p, friction->after,
        friction->mu);
    for (int j = 0; j < impact->n && !status; j++) {
        double column[N_RIGID], normal_change[N_RIGID];
        friction->before[j] = rhs_before.clearance[impact->joint[j]].v_t;
        if (friction->mu[j] <= 0.0)
            continue;
        status = compute_tangential_response(run, impact, j, base_rates, &rhs_before, unit_force, p, friction);
        for (int k = 0; k < impact->n; k++)
            column[k] = friction->gap_rate[k][j];
        solve_contact_subset(impact, pushes, column, normal_change);
        for (int k = 0; k < impact->n; k++)
            friction->normal[k][j] = normal_change[k];
    }
    if (status)
        return status;
    solve_friction_impulses(impact, impulse, friction);
    for (int k = 0; k < impact->n; k++)
        for (int j = 0; j < impact->n; j++)
            impulse[k] = max_of(impulse[k] + friction->normal[k][j] * friction->P[j], 0.0);
    return 0;
}

/*
 * Add the velocity changes of the tangential impulses to the state y, and return the energy in J that they dissipate:
 * -P . v_before, plus the work of the normal impulses at the changed gap rates, less half of P . G_t P. impulse: normal
 * impulses, N s, including those that friction causes. Called by apply_impulses() at each impact.
 */
static double apply_friction_impulses(const FrictionImpulses *friction, const double *impulse, double *y)
{
    double dissipated = 0.0;
    for (int j = 0; j < friction->n; j++) {
        dissipated -= friction->P[j] * friction->before[j];
        for (int k = 0; k < friction->n; k++)
            dissipated += friction->P[j]
                * (impulse[k] * friction->gap_rate[k][j] - 0.5 * friction->slip[k][j] * friction->P[k]);
        for (int i = 0; i < N_X; i++)
            y[N_X + i] += friction->velocity[j][i] * friction->P[j];
    }
    return dissipated;
}

#else
/* Placeholder of the tangential impulses in a scene without friction between rigid surfaces. */
typedef char FrictionImpulses;

/* Leave the discrete state unchanged: the scene has no friction between rigid surfaces. */
static inline void disable_friction(DiscreteState *discrete) { (void)discrete; }

/* Return default_status: without friction, contacts cannot be inconsistent. */
static inline int diagnose_stall(const Integrator *run, int default_status, const Parameters *p)
{
    return (void)run, (void)p, default_status;
}

/* Leave the branches unchanged: no friction between rigid surfaces depends on the slip. */
static inline void update_frozen_branches(Integrator *run, const Parameters *p) { (void)run, (void)p; }

/* Return the status 0: the scene has no friction between rigid surfaces. */
static inline int compute_friction_impulses(
    Integrator *run, const Delassus *impact, const double *approach_speed, double *impulse, const Parameters *p,
    FrictionImpulses *friction)
{
    (void)run, (void)impact, (void)approach_speed, (void)impulse, (void)p, (void)friction;
    return 0;
}

/* Return 0 J, nothing is dissipated: the scene has no friction between rigid surfaces. */
static inline double apply_friction_impulses(const FrictionImpulses *friction, const double *impulse, double *y)
{
    return (void)friction, (void)impulse, (void)y, 0.0;
}
#endif
