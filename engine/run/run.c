/* Begin of a run, its right-hand side, and what is recorded at accepted states: peaks, residuals, samples. */
#include "run.h"
#include "../watch/zeros.h"
#include "../both/one.h"

#include "../both/states.h"

/*
 * Evaluate the right-hand side with the inner states of contact laws, for given rigid contact forces. The laws read
 * their inner states from the contact states; the rates of these follow the works in dy. Return 0 or the status.
 */
static int motion_with_inner_states(
    double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dy, RhsOutputs *rhs)
{
    copy_inner_states(discrete, y);
    const int status = motion(t, y, discrete, p, dy, rhs);
    copy_inner_rates(rhs, dy);
    return status;
}

#if N_RIGID
#include "../scene/contact_forces.h"
#endif

/*
 * Evaluate the right-hand side of a run at (t, y): rates dy and the other outputs rhs. Forces of closed rigid contacts
 * are included. Return 0, STOPPED after a cancellation, or the vanished pivot.
 */
static int rates(Integrator *run, double t, const double *y, const Parameters *p, double *dy, RhsOutputs *rhs)
{
    count_evaluations(run, 1);
    if (is_cancelled(&run->cancellation))
        return STOPPED;
#if N_RIGID
    int joint[N_RIGID];
    const int n = list_closed(&run->discrete, joint);
    count_evaluations(run, n ? n + 1 : 0);
    return rates_in_contact(motion_with_inner_states, N_Y, t, y, &run->discrete, p, dy, rhs);
#else
    return motion_with_inner_states(t, y, &run->discrete, p, dy, rhs);
#endif
}

#include "joint_maxima.h"
#include "contacts.c"
#include "envelope.c"

/* Return whether a penetration exceeds the range of validity of the contact laws, a tenth of the radius. */
static int is_outside_model(const Integrator *run, const Parameters *p)
{
    for (int i = 0; i < N_CLEARANCES; i++)
        if (run->rhs.clearance[i].delta > deepest(p, i))
            return 1;
    return 0;
}

/*
 * Update peaks, residuals and the ratio deltadot/deltadot_minus at an accepted state. Return 0, NOT_FINITE, OUTSIDE, or
 * the status of accept_state().
 */
static int record_accepted_state(Integrator *run, const Parameters *p)
{
    const RhsOutputs *rhs = &run->rhs;
    double sum = 0.0;
    for (int k = 0; k < N_Y; k++)
        sum += run->dy[k] + run->y[k];
    const int lost = accept_state(run->t, run->y, &run->discrete, p, rhs, &run->residuals.phi_max,
        &run->residuals.phi_dot_max);
    if (lost)
        return lost;
    for (int i = 0; i < N_CLEARANCES; i++)
        update_joint_peaks(run, i);
    if (run->envelope.rows)
        extend_envelope(run);
    return !isfinite(sum) ? NOT_FINITE : is_outside_model(run, p) ? OUTSIDE : 0;
}

/* Store the state of all bodies, the discrete state and the contact codes at time t as row i of the samples. */
static void store_sample(const Integrator *run, double t, const double *now, const Parameters *p, long i, double *y,
    double *latched, signed char *state)
{
    enum { MEMORY = AT_LEAST_ONE(N_DISCRETE), JOINTS = AT_LEAST_ONE(N_CLEARANCES) };
    to_absolute(t, now, &run->discrete, p, y + i * N_S);
    for (int k = 0; k < N_CLEARANCES; k++) {
        latched[i * MEMORY + k] = run->discrete.contact[k].closed ? run->discrete.contact[k].deltadot_minus : NAN;
        state[i * JOINTS + k] = (signed char)(!run->discrete.contact[k].closed ? CODE_FREE
            : run->contacts.is_compressing[k] ? CODE_IMPACT : CODE_CONTACT);
    }
    for (int k = 0; k < N_FRICTIONS; k++)
        latched[i * MEMORY + N_CLEARANCES + k] = run->discrete.mode[k];
    for (int k = 0; k < N_STATES; k++)
        latched[i * MEMORY + N_DISCRETE - N_STATES + k] = now[FIRST_STATE + k];
}

/* Freeze the active branches of all switching functions as they are at the present state. */
static void freeze_branches(Integrator *run)
{
    for (int k = 0; k < N_SWITCHES; k++)
        run->discrete.branch[k] = run->rhs.g[k] < 0.0 ? -1.0 : 1.0;
    run->discrete.held = 1;
}

/*
 * Update the branches of all active switching functions at (t, y) until they agree with their signs, and evaluate the
 * right-hand side there. Switching function `fixed` (-1: none) keeps its branch. A function that becomes active may
 * have held the other branch, on which its value may be NaN.
 */
static int update_branches_at(
    Integrator *run, double t, const double *y, double *dy, RhsOutputs *rhs, int fixed, const Parameters *p)
{
    int status = 0, changed = 1;
    for (int pass = 0; pass < 6 && changed; pass++) {
        changed = 0;
        status = rates(run, t, y, p, dy, rhs);
        for (int k = 0; k < N_SWITCHES && status != STOPPED; k++)
            if (k != fixed && run->discrete.branch[k] * rhs->g[k] < 0.0) {
                run->discrete.branch[k] = -run->discrete.branch[k];
                changed = 1;
            }
    }
    return status;
}

/* Return the kinetic energy of all bodies at the present state, J. */
static double kinetic_energy(const Integrator *run, const Parameters *p)
{
    double m[N_Q], all[N_S], sum = 0.0;
    mass_matrix(p, m);
    to_absolute(run->t, run->y, &run->discrete, p, all);
    for (int k = 0; k < N_Q; k++)
        sum += 0.5 * m[k] * all[N_Q + k] * all[N_Q + k];
    return sum;
}

#include "step_record.c"
#if N_FRICTIONS
#include "slips.c"
#endif
#include "uncertainty.c"
#include "user_events.c"
#include "friction.c"
#if N_RIGID
#include "frictional_impact.c"
#include "contact_projection.c"
#include "resolution.c"
#endif
#include "impacts.c"

/* Return whether Python must fetch the lists and the step record before the next step. */
static int has_full_lists(const Integrator *run)
{
    return run->contacts.n_impacts >= MAX_LISTED || run->events.n >= MAX_LISTED || is_record_full(run);
}

/*
 * Return the effective mass in kg that the force of contact i moves, NaN if undefined. The force of contact i changes
 * the rate of deltadot, which is linear in the velocities. direction (N_X): the velocities that increase deltadot by
 * 1 m/s.
 */
static double effective_mass(Integrator *run, int i, double *direction, const Parameters *p)
{
    const double duration = 1e-3; /* s */
    double force[2], rate[2], y[N_Y], dy[2][N_Y], scrap[N_Y];
    RhsOutputs rhs;
    memcpy(y, run->y, sizeof y);
    for (int closed = 0; closed < 2; closed++) {
        run->discrete.contact[i].closed = (unsigned char)closed;
        run->discrete.contact[i].deltadot_minus = INFINITY; /* the contact force has no damping part */
        if (update_branches_at(run, run->t, run->y, dy[closed], &rhs, -1, p))
            return NAN;
        force[closed] = rhs.clearance[i].F_n;
        for (int k = N_X; k < 2 * N_X; k++)
            y[k] = run->y[k] + duration * dy[closed][k];
        if (rates(run, run->t, y, p, scrap, &rhs))
            return NAN;
        rate[closed] = rhs.clearance[i].deltadot;
    }
    const double pushed = (rate[1] - rate[0]) / duration;
    for (int k = 0; k < N_X; k++)
        direction[k] = (dy[1][N_X + k] - dy[0][N_X + k]) / pushed;
    return (force[1] - force[0]) / pushed;
}

/*
 * Estimate the approach speed of contact i, in which the run begins without a known onset. The contact is assumed to
 * have lost no energy since the onset: 1/2 m u^2 = 1/2 m deltadot^2 + F delta / (n + 1), with the elastic force F at
 * deltadot = 0 and the exponent n of a power law.
 */
static void estimate_approach_speed(Integrator *run, int i, const Parameters *p)
{
    const double deltadot = run->rhs.clearance[i].deltadot;
    double force[2], delta[2], direction[N_X], y[N_Y], dy[N_Y];
    DiscreteState known = run->discrete;
    RhsOutputs rhs;
    freeze_branches(run); /* frozen: an open contact stays open, wherever the journal is */
    const double mass = effective_mass(run, i, direction, p);
    memcpy(y, run->y, sizeof y);
    for (int part = 0; part < 2 && mass > 0.0; part++) {
        for (int k = 0; k < N_X; k++) {
            y[k] = run->y[k] - (part ? 0.1 * delta[0] * direction[k] : 0.0);
            y[N_X + k] = run->y[N_X + k] - deltadot * direction[k];
        }
        const int status = rates(run, run->t, y, p, dy, &rhs);
        force[part] = status ? NAN : fabs(rhs.clearance[i].F_n);
        delta[part] = rhs.clearance[i].delta;
    }
    if (mass > 0.0) {
        const double n = log(force[1] / force[0]) / log(delta[1] / delta[0]);
        const double onset = sqrt(deltadot * deltadot + 2.0 * force[0] * delta[0] / (n + 1.0) / mass);
        if (n > 0.0 && isfinite(onset))
            known.contact[i].deltadot_minus = max_of(known.contact[i].deltadot_minus, onset);
    }
    run->discrete = known;
    begin_contact(run, i, run->t, known.contact[i].deltadot_minus);
}

/*
 * Evaluate the first right-hand side of a run and set its contacts, friction modes and signs of user-defined events. A
 * start with penetration is in contact; friction begins with the mode of its slip.
 */
static int begin_state(Integrator *run, const Parameters *p)
{
    int status = rates(run, run->t, run->y, p, run->dy, &run->rhs);
    if (!status)
        status = begin_friction(run, p);
    const DiscreteState known = run->discrete;
    if (!status && begin_contacts_of_start(run, p)) {
        for (int i = 0; i < N_CLEARANCES; i++)
            if (run->discrete.contact[i].closed && !known.contact[i].closed && run->rhs.clearance[i].delta > 0.0)
                estimate_approach_speed(run, i, p);
        status = rates(run, run->t, run->y, p, run->dy, &run->rhs);
    }
    if (!status)
        status = begin_contacts(run, p);
    double value[AT_LEAST_ONE(N_USER_EVENTS)];
    evaluate_resolved_events(run, run->t, run->y, &run->rhs, p, value);
    for (int i = 0; i < N_USER_EVENTS; i++) {
        event_crosses(i, &run->discrete.event_sign[i], value[i]);
        if (isnan(run->rhs.event[i]) && !status)
            record_nan_event(run, i, run->t);
    }
    run->ready = 1;
    return status ? status : record_accepted_state(run, p);
}

/* Return the size of the memory of a run in bytes. */
size_t gudgeon_run_size(void)
{
#if N_USER_EVENTS
    return sizeof(Integrator) + sizeof(EventStates);
#else
    return sizeof(Integrator);
#endif
}

/* Initialize a run at time t (s) from the state y of all bodies and the discrete state `latched`, for parameters p. */
void gudgeon_run_start(void *integrator, const double *p, double t, const double *y, const double *latched)
{
    Integrator *run = integrator;
    *run = (Integrator){.t = t};
    from_absolute(t, y, &run->discrete, (const Parameters *)p, run->y);
    read_discrete_state(latched, &run->discrete);
    run->discrete.token = &run->cancellation;
    if (CONTINUES)
        run->discrete.least = run->discrete.least_size = NEARBY;
    for (int k = 0; k < N_STATES; k++) /* NaN at a new run: no inner states yet */
        run->y[FIRST_STATE + k] = isnan(latched[N_DISCRETE - N_STATES + k]) ? 0.0 : latched[N_DISCRETE - N_STATES + k];
    start_contacts(run, t, latched);
}
