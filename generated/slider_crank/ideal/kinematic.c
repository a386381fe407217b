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

/* The same of a change of q, positions as shares of the mechanism's size: the angle that it is worth (rad). */
static double largest_turn(const double *x, double size)
{
    double most = 0.0;
    for (int k = 0; k < N_Q; k++) {
        const double turn = fabs(x[k]) / (k % 3 == 2 ? 1.0 : size);
        most = turn > most || isnan(turn) ? turn : most;
    }
    return most;
}

/* Newton on Phi(q, t) = 0 until the step no longer shrinks; `moved` is the way from the first guess. */
static int close_linkage(double t, const Parameters *p, double extent, double *q, double *moved)
{
    double phi[9], step[N_Q], before = INFINITY;
    *moved = 0.0;
    for (int i = 0; i < MAX_NEWTON; i++) {
        constraints(t, q, p, phi);
        const int status = project(t, q, phi, p, step);
        if (status)
            return status;
        for (int k = 0; k < N_Q; k++)
            q[k] -= step[k];
        const double size = largest(step, N_Q);
        *moved += largest_turn(step, extent);
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
    double r[9], phi_q[9 * N_Q], step[N_Q];
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
 * From (t0, q, v) to t1 along the same branch. The first guess is q + h v; where Newton moves it by more than
 * `reach`, or the way bends more than its velocities say, the way is halved: another branch passes near dead
 * centres as a jump of positions that no velocity explains.
 */
static int follow(double t0, double t1, const Parameters *p, double reach, double extent, double *q, double *v,
    long *steps)
{
    const double straight = 0.002 * reach;
    double t = t0, h = t1 - t0;
    int halvings = 0;
    while (t < t1) {
        double guess[N_Q], rate[N_Q], bend[N_Q], moved, bent = 0.0;
        const double next = t + h < t1 ? t + h : t1;
        for (int k = 0; k < N_Q; k++)
            guess[k] = q[k] + (next - t) * v[k];
        int status = next > t ? close_linkage(next, p, extent, guess, &moved) : NEWTON_FAILED;
        const int near = !status && moved <= reach;
        if (near)
            status = velocities(next, guess, p, rate);
        if (near && !status) { /* what the trapezoidal rule leaves over */
            for (int k = 0; k < N_Q; k++)
                bend[k] = guess[k] - q[k] - 0.5 * (next - t) * (v[k] + rate[k]);
            bent = largest_turn(bend, extent);
        }
        if (status || !near || !(bent <= straight)) {
            if (++halvings > MAX_HALVINGS || !(next > t))
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
        if (halvings > 0 && bent < 0.1 * straight) { /* it grows with h cubed */
            h *= 2.0;
            halvings--;
        }
    }
    return 0;
}

/* n samples at the given times; q and v hold the start in front: n + 1 rows. */
int gudgeon_kinematic(long n, const double *t, const double *p, double reach, double extent, double *q, double *v,
    double *phi_max, double *phi_dot_max, long *steps, long *done)
{
    double phi[9];
    for (long i = 0; i < n; i++) {
        double *now = q + (i + 1) * N_Q, *rate = v + (i + 1) * N_Q;
        for (int k = 0; k < N_Q; k++) {
            now[k] = q[i * N_Q + k];
            rate[k] = v[i * N_Q + k];
        }
        *done = i;
        const int status = follow(t[i], t[i + 1], (const Parameters *)p, reach, extent, now, rate, steps);
        if (status)
            return status;
        Aside aside;
        double a[N_Q];
        const int singular = dynamics(t[i + 1], now, rate, &(Memory){0}, (const Parameters *)p, a, &aside);
        if (singular)
            return singular;
        constraints(t[i + 1], now, (const Parameters *)p, phi);
        *phi_max = max_of(largest(phi, N_ALL_ROWS), *phi_max);
        *phi_dot_max = max_of(largest(aside.phi_dot, N_ROWS), *phi_dot_max);
    }
    *done = n;
    return 0;
}
