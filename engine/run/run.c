/* Start of a run, its right-hand side, and what is recorded at accepted states: peaks, residuals, samples. */
#include "run.h"
#include "../watch/zeros.h"
#include "../scalar_simd/scalar.h"

#include "../scalar_simd/internal_states.h"

/*
 * Evaluate the right-hand side at (t, y) with the internal states of contact laws (bristle deflections), for the rigid
 * contact forces stored in `discrete`. Internal states are copied from y into the contact states of `discrete`; their
 * rates follow the works in dy. Return 0 or the status.
 */
static int evaluate_motion_with_internal_states(
    double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dy, RhsOutputs *rhs)
{
    copy_internal_states(discrete, y);
    const int status = compute_motion_rates(t, y, discrete, p, dy, rhs);
    copy_internal_state_rates(rhs, dy);
    return status;
}

#if N_RIGID
#include "../scene/contact_forces.h"
#endif

/*
 * Evaluate the right-hand side of a run at (t, y): rates dy (N_Y) and the other outputs rhs. Forces of closed rigid
 * contacts are computed first. Evaluations are counted and the caller is polled for cancellation. Return 0, STOPPED
 * after a cancellation, or the number of the vanished pivot.
 */
static int evaluate_run_rhs(
    Integrator *run, double t, const double *y, const Parameters *p, double *dy, RhsOutputs *rhs)
{
    count_evaluations(run, 1);
    if (is_cancelled(&run->cancellation))
        return STOPPED;
#if N_RIGID
    int joint[N_RIGID];
    const int n = list_closed_contacts(&run->discrete, joint);
    count_evaluations(run, n ? n + 1 : 0);
    return compute_rates_in_contact(evaluate_motion_with_internal_states, N_Y, t, y, &run->discrete, p, dy, rhs);
#else
    return evaluate_motion_with_internal_states(t, y, &run->discrete, p, dy, rhs);
#endif
}

#include "joint_maxima.h"
#include "contacts.c"
#include "envelope.c"

/*
 * Return whether the penetration of any joint at the current state exceeds the range of validity of its contact laws: a
 * tenth of the radius, unless a law states it.
 */
static int is_outside_contact_laws(const Integrator *run, const Parameters *p)
{
    for (int i = 0; i < N_CLEARANCES; i++)
        if (run->rhs.clearance[i].delta > max_valid_penetration(p, i))
            return 1;
    return 0;
}

/*
 * Update the largest residuals |Phi| and |Phi_dot| of the closures so far with those of the current state. residuals:
 * these two, if the lane of an accepted step has computed them. NULL: accept_state() computes them, and stores driven
 * loops for later times. Return 0 or the status of accept_state().
 */
static int update_residuals(Integrator *run, const double *residuals, const Parameters *p)
{
    if (!residuals)
        return accept_state(run->t, run->y, &run->discrete, p, &run->rhs, &run->residuals.phi_max,
            &run->residuals.phi_dot_max);
    run->residuals.phi_max = max_of(residuals[0], run->residuals.phi_max);
    run->residuals.phi_dot_max = max_of(residuals[1], run->residuals.phi_dot_max);
    return 0;
}

/*
 * Update the peaks of all joints with play, the envelope and the residuals at an accepted state. Return 0, NOT_FINITE
 * if the state or its rates are not finite, OUTSIDE if a penetration exceeds the contact laws, or the status of
 * accept_state(). Called at the start and after each accepted step. residuals: see update_residuals().
 */
static int record_accepted_state(Integrator *run, const double *residuals, const Parameters *p)
{
    double sum = 0.0;
    for (int k = 0; k < N_Y; k++)
        sum += run->dy[k] + run->y[k];
    const int status = update_residuals(run, residuals, p);
    if (status)
        return status;
    for (int i = 0; i < N_CLEARANCES; i++)
        update_joint_peaks(run, i);
    if (run->envelope.rows)
        extend_envelope(run);
    return !isfinite(sum) ? NOT_FINITE : is_outside_contact_laws(run, p) ? OUTSIDE : 0;
}

/*
 * Store the state of all bodies, the discrete state and the contact codes at time t (s) in a row of the arrays y,
 * discrete and codes. state_vector (N_Y): integrated state. In `discrete`: approach speeds (NaN for open joints),
 * friction modes and internal states of laws. Called for output times, events, rows of the step record, and the end of
 * a run.
 */
static void store_sample(const Integrator *run, double t, const double *state_vector, const Parameters *p, long row,
    double *y,
    double *discrete, signed char *codes)
{
    enum { N_COLUMNS = AT_LEAST_ONE(N_DISCRETE), JOINTS = AT_LEAST_ONE(N_CLEARANCES) };
    convert_integrated_to_absolute(t, state_vector, &run->discrete, p, y + row * N_S);
    for (int k = 0; k < N_CLEARANCES; k++) {
        discrete[row * N_COLUMNS + k] = run->discrete.contact[k].closed ? run->discrete.contact[k].deltadot_minus : NAN;
        codes[row * JOINTS + k] = (signed char)(!run->discrete.contact[k].closed ? CODE_FREE
            : run->contacts.is_compressing[k] ? CODE_IMPACT : CODE_CONTACT);
    }
    for (int k = 0; k < N_FRICTIONS; k++)
        discrete[row * N_COLUMNS + N_CLEARANCES + k] = run->discrete.mode[k];
    for (int k = 0; k < N_STATES; k++)
        discrete[row * N_COLUMNS + N_DISCRETE - N_STATES + k] = state_vector[FIRST_STATE + k];
}

/*
 * Set the branches of all switching functions to their signs at the current state, and freeze them and the contacts
 * (discrete.is_frozen). Called when a run begins, and before states just after the current time are evaluated.
 */
static void freeze_branches(Integrator *run)
{
    for (int k = 0; k < N_SWITCHES; k++)
        run->discrete.branch[k] = run->rhs.g[k] < 0.0 ? -1.0 : 1.0;
    run->discrete.is_frozen = 1;
}

/*
 * Update the branches of all active switching functions at (t, y) and evaluate the right-hand side there into dy and
 * rhs. Both are repeated until branches agree with the signs of the functions, at most six times. Inactive functions
 * (NaN) keep their branch, and so does fixed_switch; -1: none.
 *
 * A function that becomes active may have held the other branch, on which its value may be NaN. Return the status of
 * the last evaluation.
 */
static int update_branches_at(
    Integrator *run, double t, const double *y, double *dy, RhsOutputs *rhs, int fixed_switch, const Parameters *p)
{
    int status = 0, changed = 1;
    for (int pass = 0; pass < 6 && changed; pass++) {
        changed = 0;
        status = evaluate_run_rhs(run, t, y, p, dy, rhs);
        for (int k = 0; k < N_SWITCHES && status != STOPPED; k++)
            if (k != fixed_switch && run->discrete.branch[k] * rhs->g[k] < 0.0) {
                run->discrete.branch[k] = -run->discrete.branch[k];
                changed = 1;
            }
    }
    return status;
}

/* Return the kinetic energy of all bodies at the current state, J. */
static double compute_kinetic_energy(const Integrator *run, const Parameters *p)
{
    double mass[N_Q], absolute_state[N_S], sum = 0.0;
    mass_matrix(p, mass);
    convert_integrated_to_absolute(run->t, run->y, &run->discrete, p, absolute_state);
    for (int k = 0; k < N_Q; k++)
        sum += 0.5 * mass[k] * absolute_state[N_Q + k] * absolute_state[N_Q + k];
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

/* Return whether Python must fetch the lists of contacts and events, or the step record, before the next step. */
static int has_full_buffers(const Integrator *run)
{
    return run->contacts.n_records >= MAX_LISTED || run->events.n >= MAX_LISTED || is_record_full(run);
}

/*
 * Return the effective mass in kg that the force of a contact moves, NaN if an evaluation fails. The force changes the
 * rate of deltadot, which is linear in the velocities. direction (N_X): set to the velocities that increase deltadot by
 * 1 m/s. The contact state of the joint is left changed: the caller restores it. Used for the approach speed of
 * contacts in which a run begins.
 */
static double compute_effective_mass(Integrator *run, int joint, double *direction, const Parameters *p)
{
    const double duration = 1e-3; /* s */
    double force[2], rate[2], y[N_Y], dy[2][N_Y], dy_unused[N_Y];
    RhsOutputs rhs;
    memcpy(y, run->y, sizeof y);
    for (int closed = 0; closed < 2; closed++) {
        run->discrete.contact[joint].closed = (unsigned char)closed;
        run->discrete.contact[joint].deltadot_minus = INFINITY; /* the contact force has no damping part */
        if (update_branches_at(run, run->t, run->y, dy[closed], &rhs, -1, p))
            return NAN;
        force[closed] = rhs.clearance[joint].F_n;
        for (int k = N_X; k < 2 * N_X; k++)
            y[k] = run->y[k] + duration * dy[closed][k];
        if (evaluate_run_rhs(run, run->t, y, p, dy_unused, &rhs))
            return NAN;
        rate[closed] = rhs.clearance[joint].deltadot;
    }
    const double acceleration = (rate[1] - rate[0]) / duration;
    for (int k = 0; k < N_X; k++)
        direction[k] = (dy[1][N_X + k] - dy[0][N_X + k]) / acceleration;
    return (force[1] - force[0]) / acceleration;
}

/*
 * Estimate and store the approach speed of a contact in which the run begins without a known onset, and start its
 * record. The contact is assumed to have lost no energy since the onset: 1/2 m u^2 = 1/2 m deltadot^2 + F delta / (n +
 * 1), with the elastic force F at deltadot = 0 and the exponent n of a power law. The stored speed is only ever
 * increased; it stays if the estimate fails.
 */
static void estimate_approach_speed(Integrator *run, int joint, const Parameters *p)
{
    const double deltadot = run->rhs.clearance[joint].deltadot;
    double force[2], delta[2], direction[N_X], y[N_Y], dy[N_Y];
    DiscreteState discrete_before = run->discrete;
    RhsOutputs rhs;
    freeze_branches(run); /* frozen: an open contact stays open, wherever the journal is */
    const double mass = compute_effective_mass(run, joint, direction, p);
    memcpy(y, run->y, sizeof y);
    for (int sample = 0; sample < 2 && mass > 0.0; sample++) {
        for (int k = 0; k < N_X; k++) {
            y[k] = run->y[k] - (sample ? 0.1 * delta[0] * direction[k] : 0.0);
            y[N_X + k] = run->y[N_X + k] - deltadot * direction[k];
        }
        const int status = evaluate_run_rhs(run, run->t, y, p, dy, &rhs);
        force[sample] = status ? NAN : fabs(rhs.clearance[joint].F_n);
        delta[sample] = rhs.clearance[joint].delta;
    }
    if (mass > 0.0) {
        const double n = log(force[1] / force[0]) / log(delta[1] / delta[0]);
        const double onset = sqrt(deltadot * deltadot + 2.0 * force[0] * delta[0] / (n + 1.0) / mass);
        if (n > 0.0 && isfinite(onset))
            discrete_before.contact[joint].deltadot_minus = max_of(discrete_before.contact[joint].deltadot_minus,
                onset);
    }
    run->discrete = discrete_before;
    start_contact_record(run, joint, run->t, discrete_before.contact[joint].deltadot_minus);
}

/*
 * Evaluate the first right-hand side of a run, set its contacts, friction modes and signs of user-defined events, and
 * record the state. A start with penetration is in contact, with an estimated approach speed; friction begins with the
 * mode of its slip. Event functions that are NaN are recorded as events. Return 0 or a status. Called once, when the
 * memory of the run has been initialized.
 */
static int initialize_discrete_state(Integrator *run, const Parameters *p)
{
    int status = evaluate_run_rhs(run, run->t, run->y, p, run->dy, &run->rhs);
    if (!status)
        status = initialize_friction_modes(run, p);
    const DiscreteState discrete_before = run->discrete;
    if (!status && initialize_compliant_contacts(run, p)) {
        for (int i = 0; i < N_CLEARANCES; i++)
            if (run->discrete.contact[i].closed && !discrete_before.contact[i].closed
                && run->rhs.clearance[i].delta > 0.0)
                estimate_approach_speed(run, i, p);
        status = evaluate_run_rhs(run, run->t, run->y, p, run->dy, &run->rhs);
    }
    if (!status)
        status = initialize_rigid_contacts(run, p);
    double value[AT_LEAST_ONE(N_USER_EVENTS)];
    evaluate_significant_events(run, run->t, run->y, &run->rhs, p, value);
    for (int i = 0; i < N_USER_EVENTS; i++) {
        detect_event_crossing(i, &run->discrete.event_sign[i], value[i]);
        if (isnan(run->rhs.event[i]) && !status)
            record_nan_event(run, i, run->t);
    }
    run->ready = 1;
    return status ? status : record_accepted_state(run, NULL, p);
}

/*
 * Return the size of the memory of a run in bytes: the Integrator and, if the scene has user-defined events,
 * EventStates after it.
 */
size_t gudgeon_run_size(void)
{
#if N_USER_EVENTS
    return sizeof(Integrator) + sizeof(EventStates);
#else
    return sizeof(Integrator);
#endif
}

/*
 * Initialize the memory of a run at time t (s) for parameters p. y (N_S): state of all bodies; discrete (N_DISCRETE):
 * the discrete state as in a sample. NaN internal states, those of a new run, become zero. gudgeon_adaptive_setup() and
 * the first call of gudgeon_adaptive_run() complete the start.
 */
void gudgeon_run_start(void *integrator, const double *p, double t, const double *y, const double *discrete)
{
    Integrator *run = integrator;
    *run = (Integrator){.t = t};
    convert_absolute_to_integrated(t, y, &run->discrete, (const Parameters *)p, run->y);
    read_discrete_state(discrete, &run->discrete);
    run->discrete.token = &run->cancellation;
    if (HAS_CONTINUATION)
        run->discrete.min_pivot = run->discrete.min_pivot_size = NEAR_SINGULAR_PIVOT;
    for (int k = 0; k < N_STATES; k++) /* NaN at a new run: no internal states yet */
        run->y[FIRST_STATE + k] = isnan(discrete[N_DISCRETE - N_STATES + k]) ? 0.0
            : discrete[N_DISCRETE - N_STATES + k];
    initialize_contacts(run, t, discrete);
}
