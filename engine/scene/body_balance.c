/*
 * The Newton-Euler equations of single bodies, from reported forces and a table of what acts where. Of the derived
 * equations only results enter: accelerations, forces and moments. Used by the audit of samples; owns no state.
 */
enum { N_BODIES = N_Q / 3 };
#define MIN_DIVISOR 1e-300 /* smallest divisor, N, N m or m */

/* Results of gudgeon_evaluate() at one sample. */
typedef struct {
    const double *a, *reactions, *torques, *clearance, *series, *friction;
} ReportedForces;

/*
 * Residuals of the equations of each body, N and N m, and the largest terms at all samples so far: mass times
 * acceleration or force (N), moment (N m), arm (m).
 */
typedef struct {
    double force[AT_LEAST_ONE(N_BODIES)], moment[AT_LEAST_ONE(N_BODIES)];
    double largest_force, largest_moment, longest_arm;
} BodyResiduals;

/* Write the ground coordinates of a point to x (2), m. q: coordinates of all bodies. */
static void locate_body_point(const BodyPoint *point, const double *q, const double *p, double *x)
{
    const double along = point->x >= 0 ? point->sign_x * p[point->x] : 0.0;
    const double across = point->y >= 0 ? point->sign_y * p[point->y] : 0.0;
    x[0] = along;
    x[1] = across;
    if (point->body >= 0) {
        const double *body = q + 3 * point->body, c = cos(body[2]), s = sin(body[2]);
        x[0] = body[0] + c * along - s * across;
        x[1] = body[1] + s * along + c * across;
    }
}

/* Write force and moment of a force on its second body to wrench (3), N and N m. */
static void read_wrench(
    const BodyForce *force, const double *q, const double *p, const ReportedForces *reported, double *wrench)
{
    const long k = force->column;
    wrench[0] = wrench[1] = wrench[2] = 0.0;
    if (force->kind == FORCE_REACTION) {
        memcpy(wrench, reported->reactions + N_REACTION_COLUMNS * k, 3 * sizeof(double));
    } else if (force->kind == FORCE_CLEARANCE) {
        wrench[0] = reported->clearance[N_CLEARANCE_COLUMNS * k + CLEARANCE_Fx];
        wrench[1] = reported->clearance[N_CLEARANCE_COLUMNS * k + CLEARANCE_Fy];
    } else if (force->kind == FORCE_FRICTION) {
        double u[2];
        for (int axis = 0; axis < 2; axis++)
            u[axis] = force->direction[axis] >= 0 ? p[force->direction[axis]] : force->component[axis];
        const double theta = force->first >= 0 ? q[3 * force->first + 2] : 0.0;
        const double magnitude = reported->friction[N_FRICTION_COLUMNS * k + FRICTION_force] / hypot(u[0], u[1]);
        wrench[0] = magnitude * (cos(theta) * u[0] - sin(theta) * u[1]);
        wrench[1] = magnitude * (sin(theta) * u[0] + cos(theta) * u[1]);
    } else if (force->kind == FORCE_SPRING) {
        double from[2], to[2];
        locate_body_point(&force->from, q, p, from);
        locate_body_point(&force->at, q, p, to);
        const double magnitude = reported->series[k] / max_of(hypot(from[0] - to[0], from[1] - to[1]), MIN_DIVISOR);
        wrench[0] = magnitude * (from[0] - to[0]);
        wrench[1] = magnitude * (from[1] - to[1]);
    } else if (force->kind == FORCE_COMPONENTS) {
        wrench[0] = reported->series[k];
        wrench[1] = reported->series[k + 1];
    } else {
        wrench[2] = force->kind == FORCE_DRIVE ? reported->torques[k] : reported->series[k];
    }
}

/*
 * Subtract a force from the sums (3) of a body: force, N, and moment about its centre of mass, N m. sign: 1 on the
 * second body, -1 on the first. Forces of joints with play have no moment here.
 */
static void subtract_wrench(const BodyForce *force, double sign, long body, const double *q, const double *p,
    const double *wrench, const BodyForceTable *table, BodyResiduals *residuals, double *sums)
{
    double x[2], moment;
    sums[0] -= sign * wrench[0];
    sums[1] -= sign * wrench[1];
    if (force->kind == FORCE_CLEARANCE)
        return;
    locate_body_point(&force->at, q, p, x);
    const double arm_x = x[0] - q[3 * body], arm_y = x[1] - q[3 * body + 1];
    moment = wrench[2] + arm_x * wrench[1] - arm_y * wrench[0];
    sums[2] -= sign * moment;
    residuals->longest_arm = max_of(residuals->longest_arm, hypot(arm_x, arm_y));
    if (table->has_known_moments[body])
        residuals->largest_moment = max_of(residuals->largest_moment, fabs(moment));
}

/*
 * Raise the residuals of all bodies to those at a sample: m a - m g - sum F and J alpha - sum(M + r x F). They stay 0
 * for bodies whose forces or moments are not all known. m: masses (N_Q). The largest terms are updated.
 */
static void add_body_residuals(const BodyForceTable *table, const double *q, const double *p, const double *m,
    const ReportedForces *reported, BodyResiduals *residuals)
{
    double sums[3 * AT_LEAST_ONE(N_BODIES)], wrench[3];
    for (int k = 0; k < N_Q; k++) {
        const double inertia = m[k] * reported->a[k];
        residuals->largest_force = k % 3 < 2 ? max_of(residuals->largest_force, fabs(inertia))
            : residuals->largest_force;
        sums[k] = inertia - (k % 3 < 2 && table->gravity[k % 3] >= 0 ? m[k] * p[table->gravity[k % 3]] : 0.0);
    }
    for (long i = 0; i < table->n_forces; i++) {
        const BodyForce *force = table->forces + i;
        read_wrench(force, q, p, reported, wrench);
        residuals->largest_force = max_of(residuals->largest_force, max_of(fabs(wrench[0]), fabs(wrench[1])));
        if (force->first >= 0)
            subtract_wrench(force, -1.0, force->first, q, p, wrench, table, residuals, sums + 3 * force->first);
        if (force->second >= 0)
            subtract_wrench(force, 1.0, force->second, q, p, wrench, table, residuals, sums + 3 * force->second);
    }
    for (int body = 0; body < N_BODIES; body++) {
        if (table->has_known_forces[body])
            residuals->force[body] = max_of(residuals->force[body],
                max_of(fabs(sums[3 * body]), fabs(sums[3 * body + 1])));
        if (table->has_known_moments[body])
            residuals->moment[body] = max_of(residuals->moment[body], fabs(sums[3 * body + 2]));
    }
}

/* Return the residual of a body's equations, relative to the largest force or moment of all bodies and samples. */
static double compute_relative_residual(const BodyResiduals *residuals, int body)
{
    const double force = max_of(residuals->largest_force, MIN_DIVISOR);
    const double moment = max_of(max_of(residuals->largest_moment, force * residuals->longest_arm), MIN_DIVISOR);
    return max_of(residuals->force[body] / force, residuals->moment[body] / moment);
}

/*
 * Compute the residuals (n, N_BODIES) of the Newton-Euler equations of single bodies at n samples q (n, N_Q), relative
 * to the largest force or moment of all bodies and samples. The other arrays are results of gudgeon_evaluate(), with a
 * row for each sample.
 */
void gudgeon_body_residuals(long n, const BodyForceTable *table, const double *q, const double *parameters,
    const double *a, const double *reactions, const double *torques, const double *clearance, const double *series,
    const double *friction, double *relative_residuals)
{
    double m[AT_LEAST_ONE(N_Q)];
    BodyResiduals residuals = {0};
    mass_matrix((const Parameters *)parameters, m);
    for (int pass = 0; pass < 2; pass++) /* the first pass finds the largest terms */
        for (long i = 0; i < n; i++) {
            const ReportedForces reported = {a + i * N_Q, reactions + i * N_REACTION_COLUMNS * N_REACTIONS,
                torques + i * N_DRIVES, clearance + i * N_CLEARANCE_COLUMNS * N_CLEARANCES, series + i * N_SERIES,
                friction + i * N_FRICTION_COLUMNS * N_FRICTIONS};
            memset(residuals.force, 0, sizeof residuals.force);
            memset(residuals.moment, 0, sizeof residuals.moment);
            add_body_residuals(table, q + i * N_Q, parameters, m, &reported, &residuals);
            for (int body = 0; pass && body < N_BODIES; body++)
                relative_residuals[i * N_BODIES + body] = compute_relative_residual(&residuals, body);
        }
}
