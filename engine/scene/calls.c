/*
 * The functions of calls.h that need no time loop: parameters, constraint equations, right-hand side, results at
 * samples. Arguments are C-contiguous arrays in SI units.
 */
/*
 * Compute the rates dy of the state y = (q, v, works) in absolute coordinates, and the outputs rhs. Contact forces are
 * inputs: those stored in `discrete`. Return a status.
 */
static int compute_absolute_rates(double t, const double *y, const DiscreteState *discrete, const Parameters *p,
    double *dy,
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

/*
 * Compute the rates dy of a state y in absolute coordinates with the contact forces stored in `discrete`, as a callback
 * of compute_rates_in_contact(), whose type RatesOf has a non-const `discrete`. Return a status.
 */
static int evaluate_state_rates(
    double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dy, RhsOutputs *rhs)
{
    return compute_absolute_rates(t, y, discrete, p, dy, rhs);
}

/*
 * Compute the rates dy of a state y in absolute coordinates, with the forces of its closed rigid contacts. These forces
 * are solved for and stored in `discrete`. Return a status.
 */
static int evaluate_rates_at(
    double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dy, RhsOutputs *rhs)
{
    return compute_rates_in_contact(evaluate_state_rates, N_S, t, y, discrete, p, dy, rhs);
}
#else
/*
 * Compute the rates dy and outputs rhs of a state y in absolute coordinates; the scene has no rigid contacts. Return a
 * status.
 */
static int evaluate_rates_at(
    double t, const double *y, DiscreteState *discrete, const Parameters *p, double *dy, RhsOutputs *rhs)
{
    return compute_absolute_rates(t, y, discrete, p, dy, rhs);
}
#endif

/*
 * Read the discrete state of a sample (N_DISCRETE numbers) into `discrete`: approach speeds (NaN for open joints),
 * friction modes, internal states of laws (NaN: zero). Branches are not frozen, signs of events are unknown, pivots
 * have their usual limits, and no cancellation is set. Called before each evaluation of a sample.
 */
void read_discrete_state(const double *sample, DiscreteState *discrete)
{
    for (int i = 0; i < N_CLEARANCES; i++) {
        discrete->contact[i].closed = !isnan(sample[i]);
        discrete->contact[i].deltadot_minus = sample[i];
#if N_RIGID_WITH_FRICTION
        discrete->contact[i].is_frictionless = 0;
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
    discrete->is_frozen = 0;
    discrete->token = NULL;
    discrete->min_pivot = NEARLY_SINGULAR;
    discrete->min_pivot_size = VANISHING;
}

#define MAX_SAMPLE_TIME_ERROR 4e-12 /* s: largest distance of a sample from the event whose state it has */
#define MIN_RELATIVE_JUMP 1e-6 /* of the rates: smaller differences are drift, not a jump */

/* Return how far the time t of a sample may be from that of its state, s: location of events, and rounding. */
static double compute_sample_time_error(double t)
{
    return MAX_SAMPLE_TIME_ERROR + (get_time_just_after(fabs(t)) - fabs(t));
}

/*
 * Return the time near t (s) at which the rates of drives belong to the velocities of a sample at t, whose coordinates
 * and velocities are q and v. phi_dot (N_ROWS): Phi_q v - nu at time t. It is just after t, unless a rate of a drive
 * jumps nearby and the velocities agree better with the rate at another time, up to compute_sample_time_error() before
 * or after t.
 */
static double find_time_of_velocities(
    double t, const double *q, const double *v, const double *phi_dot, const Parameters *p)
{
    const double max_distance = compute_sample_time_error(t);
    double nu_at_t[AT_LEAST_ONE(N_ALL_ROWS)], nu[AT_LEAST_ONE(N_ALL_ROWS)], least = INFINITY, chosen = t;
    double gamma[2][AT_LEAST_ONE(N_ALL_ROWS)], smooth = 0.0; /* change of rates without a jump */
    velocity_rhs(t, q, p, nu_at_t);
    for (int side = 0; side < 2; side++) {
        acceleration_rhs(t + (side ? max_distance : -max_distance), q, v, p, gamma[side]);
        for (int k = 0; k < N_ROWS; k++)
            smooth += 10.0 * max_distance * fabs(gamma[side][motion_row[k]]);
    }
    for (double distance = get_time_just_after(t) - t; distance <= max_distance;
         distance = max_of(2.0 * distance, 1e-15))
        for (int sign = 1; sign >= -1; sign -= 2) {
            double mismatch = 0.0, rate = 0.0;
            velocity_rhs(t + sign * distance, q, p, nu);
            for (int k = 0; k < N_ROWS; k++) {
                const double velocity = phi_dot[k] + nu_at_t[motion_row[k]];
                mismatch += fabs(velocity - nu[motion_row[k]]);
                rate += fabs(velocity) + fabs(nu[motion_row[k]]);
            }
            if (mismatch < 0.5 * least && least > MIN_RELATIVE_JUMP * rate + smooth) {
                least = mismatch;
                chosen = t + sign * distance;
            }
        }
    return chosen;
}

/*
 * Compute the rates dy and outputs rhs of the state y of a sample at time *t, which is set to the time of evaluation.
 * At a jump of a drive's rate or second rate, rounding and the location of events decide on which side of the jump a
 * sample's time is. The rates of drives are therefore those to which its velocities belong
 * (find_time_of_velocities()), and those after the jump of a second rate. Return a status. Called for each sample.
 */
static int evaluate_rates_at_sample(
    double *t, const double *y, DiscreteState *discrete, const Parameters *p, double *dy, RhsOutputs *rhs)
{
    DiscreteState unchanged;
    if (RATE_JUMPS)
        unchanged = *discrete;
    const int status = evaluate_rates_at(*t, y, discrete, p, dy, rhs);
    if (!RATE_JUMPS || !has_drive_jump(*t, compute_sample_time_error(*t), y, y + N_Q, p))
        return status;
    const double time = find_time_of_velocities(*t, y, y + N_Q, rhs->phi_dot, p);
    if (time == *t)
        return status;
    *t = time;
    *discrete = unchanged;
    return evaluate_rates_at(time, y, discrete, p, dy, rhs);
}

/*
 * Compute the parameters p from the values that are specified, in SI units: given_values[k] where is_given[k] is 1, its
 * default value or derived expression where it is 0.
 */
void gudgeon_prepare(const double *given_values, const unsigned char *is_given, double *p)
{
    prepare(given_values, is_given, (Parameters *)p);
}

/*
 * Compute the parameters p of n_runs runs, as gudgeon_prepare() does for one: specified values, and default values or
 * derived expressions for the others. given_values, is_given (n_runs x n_values): the values in SI units, and whether
 * each is specified. p (n_runs): one struct Parameters per run.
 */
void gudgeon_prepare_runs(long n_runs, long n_values, const double *given_values, const unsigned char *is_given,
    double *p)
{
    for (long i = 0; i < n_runs; i++)
        prepare(given_values + i * n_values, is_given + i * n_values, (Parameters *)p + i);
}

/* Return whether the parameters p satisfy a relation: a row of table->relations. */
static int is_relation_satisfied(const ParameterTable *table, const long *relation, const double *p)
{
    const double value = p[relation[1]];
    double bound = 0.0;
    for (long k = relation[2]; k < relation[3]; k++)
        bound += p[table->terms[k]];
    switch (relation[0]) {
    case GREATER:
        return value > bound;
    case GREATER_OR_EQUAL:
        return value >= bound;
    case LESS:
        return value < bound;
    default:
        return value <= bound;
    }
}

/*
 * Compute the parameters p of a prepared run, and p_motion of its motion, from the `values` of a call; other parameters
 * keep the values in table->given_values, their defaults or derived expressions. If p_motion is p, both have the same.
 * If `values` is NULL, only those in p are checked. Return whether all are valid: `values` are zero or normal numbers,
 * and parameters are within their limits and satisfy the relations of the file. At the first value that is not normal,
 * 0 is returned and p is not computed.
 */
int gudgeon_set_parameters(const ParameterTable *table, const double *values, double *p, double *p_motion)
{
    for (long i = 0; values && i < table->n_targets; i++) {
        const double value = values[table->targets[2 * i]];
        if (!isnormal(value) && value != 0.0)
            return 0;
        table->given_values[table->targets[2 * i + 1]] = value;
    }
    if (values)
        gudgeon_prepare(table->given_values, table->is_given, p);
    if (values && p_motion != p)
        gudgeon_prepare(table->given_values + table->n_given, table->is_given + table->n_given, p_motion);
    int is_valid = 1;
    for (long k = 0; k < table->n_parameters; k++)
        is_valid &= (table->lower[k] <= p[k]) & (p[k] <= table->upper[k]);
    for (long i = 0; is_valid && i < table->n_relations; i++)
        is_valid = is_relation_satisfied(table, table->relations + 4 * i, p);
    return is_valid;
}

/* Compute the diagonal of the mass matrix, m[N_Q]. */
void gudgeon_mass(const double *p, double *m) { mass_matrix((const Parameters *)p, m); }

/* Compute the residuals phi (N_ALL_ROWS) of all constraint equations Phi at time t and coordinates q. */
void gudgeon_phi(double t, const double *q, const double *p, double *phi)
{
    constraints(t, q, (const Parameters *)p, phi);
}

/* Compute the constraint Jacobian Phi_q (N_ALL_ROWS x N_Q), by rows, with its zeros. */
void gudgeon_phi_q(double t, const double *q, const double *p, double *phi_q)
{
    for (long k = 0; k < (long)N_ALL_ROWS * N_Q; k++)
        phi_q[k] = 0.0;
    jacobian(t, q, (const Parameters *)p, phi_q);
}

/* Compute nu (N_ALL_ROWS), the right-hand side of the velocity constraints Phi_q v = nu. */
void gudgeon_nu(double t, const double *q, const double *p, double *nu)
{
    velocity_rhs(t, q, (const Parameters *)p, nu);
}

/* Compute gamma (N_ALL_ROWS), the right-hand side of the acceleration constraints Phi_q a = gamma. */
void gudgeon_gamma(double t, const double *q, const double *v, const double *p, double *gamma_values)
{
    acceleration_rhs(t, q, v, (const Parameters *)p, gamma_values);
}

/*
 * Compute the values of a start from the parameters: initial guesses of coordinates (N_GUESS), prescribed coordinates
 * (N_SET) and prescribed velocities (N_RATES). In the last two arrays the prescribed eccentricities of journals and
 * sliders, and their rates, are stored after those of coordinates (N_ECCENTRICITIES each).
 */
void gudgeon_start_values(const double *p, double *guesses, double *set_coordinates, double *rates)
{
    start_values((const Parameters *)p, guesses, set_coordinates, rates);
}

/*
 * Compute the rates dy (N_S) of the state y in absolute coordinates, including forces of rigid contacts. discrete:
 * discrete state as in a sample (N_DISCRETE). Return a status.
 */
int gudgeon_rhs(double t, const double *y, const double *discrete, const double *p, double *dy)
{
    DiscreteState discrete_state = {0};
    RhsOutputs rhs;
    read_discrete_state(discrete, &discrete_state);
    return evaluate_rates_at(t, y, &discrete_state, (const Parameters *)p, dy, &rhs);
}

/*
 * Evaluate the right-hand side `count` times for benchmarks; the caller measures the time. Each call depends on the one
 * before, so that the compiler neither removes nor overlaps any. Return a sum of accelerations that depends on all
 * calls.
 */
double gudgeon_time_rhs(long count, double t, const double *y, const double *discrete, const double *p)
{
    double dy[N_S], y_changed[N_S], sum = 0.0;
    for (int k = 0; k < N_S; k++)
        y_changed[k] = y[k];
    for (long i = 0; i < count; i++) {
        gudgeon_rhs(t, y_changed, discrete, p, dy);
        sum += dy[N_Q];
        y_changed[0] = y[0] + 1e-300 * sum; /* the next call waits for this one */
    }
    return sum;
}

#ifdef WALLS
/*
 * Sum the contact forces at the corners of each slider in a guide with play (WALLS of them) into `reaction`: force in
 * N, and moment about the slider's point in N m. That point is the midpoint of the first and the last corner, which are
 * opposite.
 */
static void sum_corner_forces(const Clearance *corner_clearances, double *reaction)
{
    for (int k = 0; k < WALLS; k++, reaction += N_REACTION_COLUMNS) {
        const Clearance *corners = corner_clearances + first_corner[k];
        double Fx = 0.0, Fy = 0.0, M = 0.0;
        for (int i = 0; i < SLIDER_CORNERS; i++) {
            Fx += corners[i].Fx;
            Fy += corners[i].Fy;
            M -= corners[i].moment_first;
        }
        const double x = 0.5 * (corners[0].from_x + corners[SLIDER_CORNERS - 1].from_x);
        const double y = 0.5 * (corners[0].from_y + corners[SLIDER_CORNERS - 1].from_y);
        reaction[REACTION_Fx] = Fx;
        reaction[REACTION_Fy] = Fy;
        reaction[REACTION_M] = M - (x * Fy - y * Fx);
    }
}
#endif

/*
 * Compute the results at n samples into the arrays that are not NULL: accelerations, multipliers, columns of joints
 * with play and friction elements, powers, residuals (drift). Reactions, torques, series and energy belong together:
 * all or none are NULL. discrete: rows of N_DISCRETE. Rates of drives are those to which the velocities v belong
 * (evaluate_rates_at_sample()). parameters: those of the motion, with Baumgarte's gains only if the method uses them.
 * Return 0, or the number of a vanishing pivot with the index of the sample in *failed_sample; later samples are not
 * computed.
 */
int gudgeon_evaluate(long n, const double *t, const double *q, const double *v, const double *discrete,
    const double *parameters, double *a, double *lambda, double *reactions, double *torques, double *clearance,
    double *series, double *friction, double *energy, double *power, double *drift, long *failed_sample)
{
    const Parameters *p = (const Parameters *)parameters;
    for (long i = 0; i < n; i++) {
        DiscreteState discrete_state = {0};
        RhsOutputs rhs;
        double y[N_S] = {0.0}, dy[N_S], time = t[i];
        for (int k = 0; k < N_Q; k++) {
            y[k] = q[i * N_Q + k];
            y[N_Q + k] = v[i * N_Q + k];
        }
        read_discrete_state(discrete + i * N_DISCRETE, &discrete_state);
        const int status = evaluate_rates_at_sample(&time, y, &discrete_state, p, dy, &rhs);
        if (status) {
            *failed_sample = i;
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
            outputs(time, y, y + N_Q, p, rhs.lambda, reactions + i * N_REACTION_COLUMNS * N_REACTIONS,
                torques + i * N_DRIVES, series + i * N_SERIES, energy + N_ENERGY * i);
#ifdef WALLS
        if (energy)
            sum_corner_forces(rhs.clearance, reactions + N_REACTION_COLUMNS * (i * N_REACTIONS + N_JOINTS));
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

/*
 * Compute the results at samples of several runs, stored one after the other: counts[i] samples of run i, with its row
 * of n_parameters parameters. Arguments and status as gudgeon_evaluate(); *failed_sample counts within the run that
 * failed.
 */
int gudgeon_evaluate_runs(long n_runs, const long *counts, const double *t, const double *q, const double *v,
    const double *discrete, const double *parameters, long n_parameters, double *a, double *lambda, double *reactions,
    double *torques, double *clearance, double *series, double *friction, double *energy, double *power, double *drift,
    long *failed_sample)
{
#define FROM(array, width) ((array) ? (array) + first * (width) : NULL)
    for (long i = 0, first = 0; i < n_runs; first += counts[i++]) {
        const int status = gudgeon_evaluate(counts[i], t + first, q + first * N_Q, v + first * N_Q,
            discrete + first * N_DISCRETE, parameters + i * n_parameters, FROM(a, N_Q), FROM(lambda, N_ROWS),
            FROM(reactions, N_REACTION_COLUMNS * N_REACTIONS), FROM(torques, N_DRIVES),
            FROM(clearance, N_CLEARANCE_COLUMNS * N_CLEARANCES),
            FROM(series, N_SERIES), FROM(friction, N_FRICTION_COLUMNS * N_FRICTIONS), FROM(energy, N_ENERGY),
            FROM(power, N_WORK), FROM(drift, N_DRIFT), failed_sample);
        if (status)
            return status;
    }
    return 0;
#undef FROM
}

#include "../scalar_simd/scalar.h"

/* Compute sine and cosine of an angle (rad) by the operations of vectors of angles, so that both give the same bits. */
static void compute_sine_and_cosine(double angle, double *sine, double *cosine)
{
    const Four angles = {angle, angle, angle, angle};
    Four sines, cosines;
    compute_sines_and_cosines(&angles, &sines, &cosines);
    *sine = sines[0];
    *cosine = cosines[0];
}

#include "../scalar_simd/motion_series.h"

/*
 * Compute a series at samples of several runs, stored one after the other, into `values`: counts[i] samples of run i,
 * with its row of n_parameters parameters. q, v, a: rows of x, y and angle of the series' body, with their first and
 * second time derivatives; NULL where the series does not need them.
 */
void gudgeon_motion_series(const MotionSeries *series, long n_runs, const long *counts, const double *q,
    const double *v, const double *a, const double *parameters, long n_parameters, double *values)
{
    for (long i = 0, k = 0; i < n_runs; i++)
        for (const long end = k + counts[i]; k < end; k++) {
            DirectionOf direction = {.body = -1};
            values[k] = evaluate_motion_series(series, q ? q + 3 * k : NULL, v ? v + 3 * k : NULL,
                a ? a + 3 * k : NULL, (const Parameters *)(parameters + i * n_parameters), &direction);
        }
}
