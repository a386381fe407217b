/*
 * The state equation y' = f(t, y) with y = (q, v, work), and everything that is computed from a state.
 */
static int state_equation(double t, const double *y, const DiscreteState *discrete, const Parameters *p, double *dy,
    RhsOutputs *rhs)
{
    const int status = dynamics(t, y, y + N_Q, discrete, p, dy + N_Q, rhs);
    for (int k = 0; k < N_Q; k++)
        dy[k] = y[N_Q + k];
    for (int k = 0; k < N_WORK; k++)
        dy[2 * N_Q + k] = rhs->power[k];
    return status;
}

#if N_RIGID
#include "contact_forces.h"

static int state_rates(
    double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dy, RhsOutputs *rhs)
{
    return state_equation(t, y, discrete, p, dy, rhs);
}

/* At a sample: with the forces of its closed contacts. */
static int rates_at(
    double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dy, RhsOutputs *rhs)
{
    return rates_in_contact(state_rates, N_S, t, y, discrete, p, dy, rhs);
}
#else
static int rates_at(
    double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dy, RhsOutputs *rhs)
{
    return state_equation(t, y, discrete, p, dy, rhs);
}
#endif

/* The memory of a sample: impact velocities, NaN where a joint is open; then the modes of friction. */
void read_discrete_state(const double *sample, DiscreteState *discrete)
{
    for (int i = 0; i < N_CLEARANCES; i++) {
        discrete->contact[i].closed = !isnan(sample[i]);
        discrete->contact[i].deltadot_minus = sample[i];
#if N_RUBBED
        discrete->contact[i].smooth = 0;
#endif
    }
    for (int i = 0; i < N_FRICTIONS; i++)
        discrete->mode[i] = sample[N_CLEARANCES + i];
#if LAW_STATES
    for (int k = 0; k < N_STATES; k++)
        discrete->contact[k / LAW_STATES].state[k % LAW_STATES] =
            isnan(sample[N_DISCRETE - N_STATES + k]) ? 0.0 : sample[N_DISCRETE - N_STATES + k];
#endif
    for (int i = 0; i < N_USER_EVENTS; i++)
        discrete->event_sign[i] = 0;
    discrete->held = 0;
    discrete->token = NULL;
    discrete->least = NEARLY_SINGULAR;
    discrete->least_size = VANISHING;
}

void gudgeon_prepare(const double *given, const unsigned char *is_given, double *p)
{
    prepare(given, is_given, (Parameters *)p);
}

/* The same of several runs, a row each. */
void gudgeon_prepare_runs(long runs, long slots, const double *given, const unsigned char *is_given, double *p)
{
    for (long i = 0; i < runs; i++)
        prepare(given + i * slots, is_given + i * slots, (Parameters *)p + i);
}

void gudgeon_mass(const double *p, double *m) { mass_matrix((const Parameters *)p, m); }

void gudgeon_phi(double t, const double *q, const double *p, double *phi)
{
    constraints(t, q, (const Parameters *)p, phi);
}

void gudgeon_phi_q(double t, const double *q, const double *p, double *phi_q)
{
    for (long k = 0; k < (long)N_ALL_ROWS * N_Q; k++)
        phi_q[k] = 0.0;
    jacobian(t, q, (const Parameters *)p, phi_q);
}

void gudgeon_nu(double t, const double *q, const double *p, double *nu)
{
    velocity_rhs(t, q, (const Parameters *)p, nu);
}

void gudgeon_gamma(double t, const double *q, const double *v, const double *p, double *gamma_rows)
{
    acceleration_rhs(t, q, v, (const Parameters *)p, gamma_rows);
}

void gudgeon_start_values(const double *p, double *guess, double *set, double *rates)
{
    start_values((const Parameters *)p, guess, set, rates);
}

int gudgeon_rhs(double t, const double *y, const double *discrete, const double *p, double *dy)
{
    DiscreteState now = {0};
    RhsOutputs rhs;
    read_discrete_state(discrete, &now);
    return rates_at(t, y, &now, (const Parameters *)p, dy, &rhs);
}

/* The same right-hand side many times over, for benchmarks; the sum keeps the calls alive. */
double gudgeon_time_rhs(long count, double t, const double *y, const double *discrete, const double *p)
{
    double dy[N_S], moved[N_S], sum = 0.0;
    for (int k = 0; k < N_S; k++)
        moved[k] = y[k];
    for (long i = 0; i < count; i++) {
        gudgeon_rhs(t, moved, discrete, p, dy);
        sum += dy[N_Q];
        moved[0] = y[0] + 1e-300 * sum; /* the next call waits for this one */
    }
    return sum;
}

#ifdef WALLS
/*
 * Of each guide with play the sum of its corners' forces on the slider, N, and their moment about the slider's point,
 * N m: that is in the middle between the first corner and the last, which lie opposite each other.
 */
static void sum_corners(const Clearance *clearance, double *reaction)
{
    for (int k = 0; k < WALLS; k++, reaction += N_REACTION_COLUMNS) {
        const Clearance *own = clearance + first_corner[k];
        double Fx = 0.0, Fy = 0.0, M = 0.0;
        for (int i = 0; i < SLIDER_CORNERS; i++) {
            Fx += own[i].Fx;
            Fy += own[i].Fy;
            M -= own[i].moment_first;
        }
        const double x = 0.5 * (own[0].from_x + own[SLIDER_CORNERS - 1].from_x);
        const double y = 0.5 * (own[0].from_y + own[SLIDER_CORNERS - 1].from_y);
        reaction[REACTION_Fx] = Fx;
        reaction[REACTION_Fy] = Fy;
        reaction[REACTION_M] = M - (x * Fy - y * Fx);
    }
}
#endif

/*
 * Everything at n samples, but for arrays that are NULL; reactions, torques, series and energy belong together.
 * Returns 0 or the pivot that vanished, with the sample in `failed`.
 */
int gudgeon_evaluate(long n, const double *t, const double *q, const double *v, const double *discrete,
    const double *parameters, double *a, double *lambda, double *reactions, double *torques, double *clearance,
    double *series, double *friction, double *energy, double *power, double *drift, long *failed)
{
    const Parameters *p = (const Parameters *)parameters;
    for (long i = 0; i < n; i++) {
        DiscreteState now = {0};
        RhsOutputs rhs;
        double y[N_S] = {0.0}, dy[N_S];
        for (int k = 0; k < N_Q; k++) {
            y[k] = q[i * N_Q + k];
            y[N_Q + k] = v[i * N_Q + k];
        }
        read_discrete_state(discrete + i * N_DISCRETE, &now);
        const int status = rates_at(t[i], y, &now, p, dy, &rhs);
        if (status) {
            *failed = i;
            return status;
        }
        for (int k = 0; a && k < N_Q; k++)
            a[i * N_Q + k] = dy[N_Q + k];
        for (int k = 0; lambda && k < N_ROWS; k++)
            lambda[i * N_ROWS + k] = rhs.lambda[k];
        for (int k = 0; power && k < N_WORK; k++)
            power[i * N_WORK + k] = rhs.power[k];
        for (int k = 0; drift && k < N_DRIFT; k++)
            drift[N_DRIFT * i + k] = 0.0;
        for (int k = 0; drift && k < N_ROWS; k++) {
            double *out = drift + N_DRIFT * i;
            out[DRIFT_phi] = max_of(fabs(rhs.phi[k]), out[DRIFT_phi]);
            out[DRIFT_phi_dot] = max_of(fabs(rhs.phi_dot[k]), out[DRIFT_phi_dot]);
        }
        if (energy)
            outputs(t[i], y, y + N_Q, p, rhs.lambda, reactions + i * N_REACTION_COLUMNS * N_REACTIONS,
                torques + i * N_DRIVES, series + i * N_SERIES, energy + N_ENERGY * i);
#ifdef WALLS
        if (energy)
            sum_corners(rhs.clearance, reactions + N_REACTION_COLUMNS * (i * N_REACTIONS + N_JOINTS));
#endif
        for (int k = 0; friction && k < N_FRICTIONS; k++) {
            double *out = friction + (i * N_FRICTIONS + k) * N_FRICTION_COLUMNS;
            out[FRICTION_force] = rhs.friction[k].force;
            out[FRICTION_slip] = rhs.friction[k].v;
        }
        for (int k = 0; clearance && k < N_CLEARANCES; k++) {
            const Clearance *joint = &rhs.clearance[k];
            double *out = clearance + (i * N_CLEARANCES + k) * N_CLEARANCE_COLUMNS;
            out[CLEARANCE_Fx] = joint->Fx;
            out[CLEARANCE_Fy] = joint->Fy;
            out[CLEARANCE_Fn] = -joint->F_n;
            out[CLEARANCE_Ft] = joint->F_t;
            out[CLEARANCE_ex] = joint->ex;
            out[CLEARANCE_ey] = joint->ey;
            out[CLEARANCE_e] = joint->e;
            out[CLEARANCE_deltadot] = joint->deltadot;
            out[CLEARANCE_vt] = joint->v_t;
            out[CLEARANCE_delta] = joint->delta;
        }
    }
    return 0;
}

/* The same at samples of several runs, one behind the other: counts[i] of run i, by its row of `numbers` numbers. */
int gudgeon_evaluate_runs(long runs, const long *counts, const double *t, const double *q, const double *v,
    const double *discrete, const double *parameters, long numbers, double *a, double *lambda, double *reactions,
    double *torques, double *clearance, double *series, double *friction, double *energy, double *power, double *drift,
    long *failed)
{
#define FROM(array, width) ((array) ? (array) + first * (width) : NULL)
    for (long i = 0, first = 0; i < runs; first += counts[i++]) {
        const int status = gudgeon_evaluate(counts[i], t + first, q + first * N_Q, v + first * N_Q,
            discrete + first * N_DISCRETE, parameters + i * numbers, FROM(a, N_Q), FROM(lambda, N_ROWS),
            FROM(reactions, N_REACTION_COLUMNS * N_REACTIONS), FROM(torques, N_DRIVES),
            FROM(clearance, N_CLEARANCE_COLUMNS * N_CLEARANCES),
            FROM(series, N_SERIES), FROM(friction, N_FRICTION_COLUMNS * N_FRICTIONS), FROM(energy, N_ENERGY),
            FROM(power, N_WORK), FROM(drift, N_DRIFT), failed);
        if (status)
            return status;
    }
    return 0;
#undef FROM
}
