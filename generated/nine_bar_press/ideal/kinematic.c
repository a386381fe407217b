/*
 * No degree of freedom is left: positions by Newton from the sample before, velocities by one linear
 * solve, each refined once. Nothing is integrated.
 */
enum { MAX_NEWTON = 12, MAX_HALVINGS = 40, NEWTON_FAILED = -1 };

static double largest(const double *x, int n)
{
    double most = 0.0;
    for (int k = 0; k < n; k++)
        most = fabs(x[k]) > most || isnan(x[k]) ? fabs(x[k]) : most;
    return most;
}

/* Newton on Phi(q, t) = 0 until the step no longer shrinks; `moved` is the way from the first guess. */
static int close_linkage(double t, const Parameters *p, double *q, double *moved)
{
    double phi[24], step[N_Q], before = INFINITY;
    *moved = 0.0;
    for (int i = 0; i < MAX_NEWTON; i++) {
        constraints(t, q, p, phi);
        const int status = project(t, q, phi, p, step);
        if (status)
            return status;
        for (int k = 0; k < N_Q; k++)
            q[k] -= step[k];
        const double size = largest(step, N_Q);
        *moved += size;
        if (isnan(size))
            return NEWTON_FAILED;
        if (size < 1e-9 && (size >= 0.5 * before || size < 1e-15))
            return 0;
        before = size;
    }
    return before < 1e-9 ? 0 : NEWTON_FAILED;
}

/* Phi_q v = nu by projection, with one step of refinement. */
static int velocities(double t, const double *q, const Parameters *p, double *v)
{
    double r[24], phi_q[24 * N_Q], step[N_Q];
    for (int k = 0; k < N_Q; k++)
        v[k] = 0.0;
    gudgeon_phi_q(t, q, (const double *)p, phi_q);
    for (int pass = 0; pass < 2; pass++) {
        velocity_rhs(t, q, p, r);
        for (int row = 0; row < N_ALL_ROWS; row++)
            for (int k = 0; k < N_Q; k++)
                r[row] -= phi_q[(size_t)row * N_Q + k] * v[k];
        const int status = project(t, q, r, p, step);
        if (status)
            return status;
        for (int k = 0; k < N_Q; k++)
            v[k] += step[k];
    }
    return 0;
}

/*
 * From (t0, q, v) to t1 along the same branch. The first guess is q + h v; where Newton moves an angle
 * or a length by more than `reach` the way is halved, so that it cannot land on another branch.
 */
static int follow(double t0, double t1, const Parameters *p, double reach, double *q, double *v, long *steps)
{
    double t = t0, h = t1 - t0;
    int halvings = 0;
    while (t < t1) {
        double guess[N_Q], rate[N_Q], moved;
        const double next = t + h < t1 ? t + h : t1;
        for (int k = 0; k < N_Q; k++)
            guess[k] = q[k] + (next - t) * v[k];
        int status = close_linkage(next, p, guess, &moved);
        if (!status && moved <= reach)
            status = velocities(next, guess, p, rate);
        if (status || moved > reach) {
            if (++halvings > MAX_HALVINGS)
                return status ? status : NEWTON_FAILED;
            h *= 0.5;
            continue;
        }
        ++*steps;
        t = next;
        for (int k = 0; k < N_Q; k++) {
            q[k] = guess[k];
            v[k] = rate[k];
        }
    }
    return 0;
}

/* n samples at the given times; q and v hold the start in front: n + 1 rows. */
int gudgeon_kinematic(long n, const double *t, const double *p, double reach, double *q, double *v, double *phi_max,
    double *phi_dot_max, long *steps, long *done)
{
    double phi[24];
    for (long i = 0; i < n; i++) {
        double *now = q + (i + 1) * N_Q, *rate = v + (i + 1) * N_Q;
        for (int k = 0; k < N_Q; k++) {
            now[k] = q[i * N_Q + k];
            rate[k] = v[i * N_Q + k];
        }
        *done = i;
        const int status = follow(t[i], t[i + 1], (const Parameters *)p, reach, now, rate, steps);
        if (status)
            return status;
        Aside aside;
        double a[N_Q];
        const int singular = dynamics(t[i + 1], now, rate, (const Parameters *)p, a, &aside);
        if (singular)
            return singular;
        constraints(t[i + 1], now, (const Parameters *)p, phi);
        *phi_max = max_of(largest(phi, N_ALL_ROWS), *phi_max);
        *phi_dot_max = max_of(largest(aside.phi_dot, N_ROWS), *phi_dot_max);
    }
    *done = n;
    return 0;
}
