/* The nine-bar press with play in joints A and B, written by hand: what a careful user does without a generator.
 *
 * 24 absolute coordinates, the source's 20 rows (Eq. 19), a dense 44x44 system
 *     [M  Phi_q^T] [a     ]   [g                                    ]
 *     [Phi_q    0] [lambda] = [gamma - 2 alpha Phi_dot - beta^2 Phi ]
 * solved by Gaussian elimination with partial pivoting. It is the oracle of the golden values and the
 * peer of the run-time comparison, so it shares nothing with the product.
 * Source: X. Chen, S. Gao, T. Wang, Nonlinear Dynamics, doi 10.1007/s11071-022-07478-4 (Eqs. 1-19).
 * SI throughout. y = (q, v): 48 numbers.
 */
#include <math.h>
#include <stddef.h>
#include <string.h>
#include <time.h>

enum { NB = 8, NQ = 24, NC = 20, NK = 44 };
enum { L1, L2, L3, L4, L6, L7, L8, S9 };

/* Mirrored, field by field, by tests/oracles/press_dense.py. */
typedef struct {
    double length[NB];   /* length[S9] is not used */
    double mass[NB];
    double inertia[NB];
    double l5, hx, hy, gravity;
    double theta1, theta4, omega1, omega4;
    double alpha, beta;                /* Baumgarte, 1/s */
    double radius, clearance, width;   /* bearing radius, radial clearance, axial length, m */
    double young, poisson;             /* of both parts */
    double exponent, restitution;      /* n, c_e */
    double mu, v0, v1;                 /* modified Coulomb */
    double floor;                      /* least impact velocity that an onset stores, m/s */
    double viscosity, transition;      /* Pa s, e0 in m */
    double conformal;                  /* 0: K with "+", as printed; 1: "-" */
    double film;                       /* 0: dry; 1: lubricated with dry contact beyond the film */
    double common_point;               /* 0: forces at each surface's Q_k; 1: both in the middle of the penetration */
} Press;

/* One joint with play: forces on the journal (second body), ground axes. */
typedef struct {
    double fx, fy;             /* N, sum of dry force and film */
    double moment_i, moment_j; /* N m about the centres of mass of bearing body and journal body */
    double e, delta, deltadot; /* m, m, m/s */
    double ratio;              /* delta_dot / stored impact velocity; 1 while none is stored */
} Contact;

static void dry_force(const Press *p, double e, const double n[2], const double t[2], double vn, double vr_t,
                      double wi, double wj, double stored, double *fn, double *ft, double *ri, double *rj, double *ratio)
{
    const double Ri = p->radius, Rj = p->radius - p->clearance, delta = e - p->clearance;
    const double sigma = (1.0 - p->poisson * p->poisson) / p->young;
    const double sign = p->conformal != 0.0 ? -1.0 : 1.0;
    const double K = 4.0 / (3.0 * 2.0 * sigma) * sqrt(Ri * Rj / (Ri + sign * Rj));
    (void)n; (void)t;
    *ratio = stored > 0.0 ? vn / stored : 1.0;
    double f = K * pow(delta, p->exponent)
             * (1.0 + 0.75 * (1.0 - p->restitution * p->restitution) * *ratio);
    if (f < 0.0) f = 0.0;
    *ri = p->common_point != 0.0 ? Ri + 0.5 * delta : Ri;
    *rj = p->common_point != 0.0 ? Rj - 0.5 * delta : Rj;
    const double slip = vr_t + wj * *rj - wi * *ri;
    double cd = (fabs(slip) - p->v0) / (p->v1 - p->v0);
    cd = cd < 0.0 ? 0.0 : cd > 1.0 ? 1.0 : cd;
    *fn = f;
    *ft = slip > 0.0 ? -p->mu * cd * f : p->mu * cd * f;
}

/* Pinkus-Sternlicht, both branches with k |eps_dot| = kd so that nothing is divided by eps_dot. */
static void film_force(const Press *p, double e, double vn, double vr_t, double wi, double wj, double *fr, double *ft)
{
    const double c = p->clearance, Rj = p->radius - c;
    const double S = 6.0 * p->viscosity * Rj * Rj * Rj * p->width / (c * c);
    double eps = e / c;
    if (eps > 0.9999) eps = 0.9999;
    const double epsdot = vn / c, psidot = vr_t / e, ws = wi + wj - 2.0 * psidot;
    const double s2 = 1.0 - eps * eps, s = sqrt(s2), a = fabs(epsdot);
    const double kd = s * sqrt(0.25 * ws * ws + epsdot * epsdot / (eps * eps));
    if (kd == 0.0) { *fr = *ft = 0.0; return; }
    const double g = (epsdot >= 0.0 ? kd + 3.0 * a : kd) / (kd + 1.5 * a);
    const double h = epsdot >= 0.0 ? M_PI * a * g : -M_PI * a * g;
    *fr = -S / (s2 * s) * (4.0 * kd * eps * eps / (2.0 + eps * eps) + h);
    *ft = S * M_PI * eps * ws / ((2.0 + eps * eps) * s) * g;
}

/* Bearing at the head of body bi, journal at the tail of body bj. */
static void joint_with_play(const Press *p, const double *q, const double *v, int bi, int bj, double stored, Contact *out)
{
    const double ci = cos(q[3*bi+2]), si = sin(q[3*bi+2]), cj = cos(q[3*bj+2]), sj = sin(q[3*bj+2]);
    const double hi = 0.5 * p->length[bi], hj = 0.5 * p->length[bj];
    const double wi = v[3*bi+2], wj = v[3*bj+2];
    const double ai[2] = { hi * ci, hi * si }, aj[2] = { -hj * cj, -hj * sj };
    const double ex = q[3*bj] + aj[0] - q[3*bi] - ai[0], ey = q[3*bj+1] + aj[1] - q[3*bi+1] - ai[1];
    const double ux = v[3*bj] - wj * aj[1] - v[3*bi] + wi * ai[1], uy = v[3*bj+1] + wj * aj[0] - v[3*bi+1] - wi * ai[0];
    const double e = hypot(ex, ey);
    const double n[2] = { e > 1e-12 ? ex / e : 1.0, e > 1e-12 ? ey / e : 0.0 }, t[2] = { -n[1], n[0] };
    const double vn = ux * n[0] + uy * n[1], vt = ux * t[0] + uy * t[1], delta = e - p->clearance;
    double fr = 0.0, ft = 0.0;               /* film: acts at the journal's centre on both bodies */
    double fn = 0.0, fs = 0.0, ri = 0.0, rj = 0.0, ratio = 1.0, fraction = 0.0;
    if (delta > 0.0) dry_force(p, e, n, t, vn, vt, wi, wj, stored, &fn, &fs, &ri, &rj, &ratio);
    if (p->film != 0.0) {
        fraction = delta <= 0.0 ? 0.0 : delta >= p->transition ? 1.0 : delta / p->transition;
        if (e > 1e-12) film_force(p, e, vn, vt, wi, wj, &fr, &ft);
        else {
            const double c = p->clearance, R = p->radius - c;
            const double B = M_PI * 6.0 * p->viscosity * R * R * R * p->width / (c * c * c);
            fr = -B * vn; ft = -B * vt;
        }
        fr *= 1.0 - fraction; ft *= 1.0 - fraction; fn *= fraction; fs *= fraction;
    }
    const double filmx = fr * n[0] + ft * t[0], filmy = fr * n[1] + ft * t[1];
    const double dryx = -fn * n[0] + fs * t[0], dryy = -fn * n[1] + fs * t[1];
    const double jx = ai[0] + ex, jy = ai[1] + ey;  /* journal centre, seen from the bearing body */
    out->fx = filmx + dryx;
    out->fy = filmy + dryy;
    out->moment_j = aj[0] * filmy - aj[1] * filmx + (aj[0] + rj * n[0]) * dryy - (aj[1] + rj * n[1]) * dryx;
    out->moment_i = -(jx * filmy - jy * filmx) - ((ai[0] + ri * n[0]) * dryy - (ai[1] + ri * n[1]) * dryx);
    out->e = e; out->delta = delta; out->deltadot = vn; out->ratio = ratio;
}

/* Two rows: point (xi along body i's axis) minus point (xj along body j's axis); body -1 is the ground at (gx, gy). */
static void pin(const double *q, const double *v, int row, int i, double xi, int j, double xj, double gx, double gy,
                double phi[NC], double phi_q[NC][NQ], double gamma[NC])
{
    phi[row] = -gx; phi[row+1] = -gy; gamma[row] = gamma[row+1] = 0.0;
    for (int k = 0; k < 2; k++) {
        const int b = k ? j : i;
        const double sign = k ? -1.0 : 1.0, x = k ? xj : xi;
        if (b < 0) continue;
        const double c = sign * x * cos(q[3*b+2]), s = sign * x * sin(q[3*b+2]), w = v[3*b+2];
        phi[row]   += sign * q[3*b] + c;
        phi[row+1] += sign * q[3*b+1] + s;
        phi_q[row][3*b] = sign;     phi_q[row][3*b+2] = -s;
        phi_q[row+1][3*b+1] = sign; phi_q[row+1][3*b+2] = c;
        gamma[row] += c * w * w; gamma[row+1] += s * w * w;
    }
}

static void constraints(const Press *p, double t, const double *q, const double *v,
                        double phi[NC], double phi_q[NC][NQ], double gamma[NC], double phi_t[NC])
{
    double h[NB];
    for (int b = 0; b < NB; b++) h[b] = 0.5 * p->length[b];
    memset(phi_q, 0, sizeof(double) * NC * NQ);
    memset(phi_t, 0, sizeof(double) * NC);
    pin(q, v, 0, L1, -h[L1], -1, 0.0, 0.0, 0.0, phi, phi_q, gamma);
    pin(q, v, 2, L4, -h[L4], -1, 0.0, 0.0, -p->l5, phi, phi_q, gamma);
    pin(q, v, 4, L2, h[L2], L7, -h[L7], 0.0, 0.0, phi, phi_q, gamma);
    pin(q, v, 6, L3, h[L3], L7, -h[L7], 0.0, 0.0, phi, phi_q, gamma);
    pin(q, v, 8, L7, h[L7], L6, h[L6], 0.0, 0.0, phi, phi_q, gamma);
    pin(q, v, 10, L7, h[L7], L8, -h[L8], 0.0, 0.0, phi, phi_q, gamma);
    pin(q, v, 12, L6, -h[L6], -1, 0.0, p->hx, p->hy, phi, phi_q, gamma);
    pin(q, v, 14, L8, h[L8], S9, 0.0, 0.0, 0.0, phi, phi_q, gamma);
    phi[16] = q[3*S9] - p->hx;              phi_q[16][3*S9] = 1.0;
    phi[17] = q[3*S9+2] - M_PI / 2.0;       phi_q[17][3*S9+2] = 1.0;
    phi[18] = q[3*L1+2] - p->theta1 - p->omega1 * t; phi_q[18][3*L1+2] = 1.0; phi_t[18] = -p->omega1;
    phi[19] = q[3*L4+2] - p->theta4 - p->omega4 * t; phi_q[19][3*L4+2] = 1.0; phi_t[19] = -p->omega4;
    gamma[16] = gamma[17] = gamma[18] = gamma[19] = 0.0;
}

/* Gaussian elimination with partial pivoting, rows swapped in place. 0, or 1 + the column without a pivot. */
static int solve(double A[NK][NK], double b[NK])
{
    for (int k = 0; k < NK; k++) {
        int best = k;
        for (int i = k + 1; i < NK; i++) if (fabs(A[i][k]) > fabs(A[best][k])) best = i;
        if (!(fabs(A[best][k]) > 1e-14)) return 1 + k;
        if (best != k) {
            for (int j = k; j < NK; j++) { const double x = A[k][j]; A[k][j] = A[best][j]; A[best][j] = x; }
            const double x = b[k]; b[k] = b[best]; b[best] = x;
        }
        const double inverse = 1.0 / A[k][k];
        for (int i = k + 1; i < NK; i++) {
            if (A[i][k] == 0.0) continue;
            const double f = A[i][k] * inverse;
            for (int j = k + 1; j < NK; j++) A[i][j] -= f * A[k][j];
            b[i] -= f * b[k];
        }
    }
    for (int i = NK - 1; i >= 0; i--) {
        double x = b[i];
        for (int j = i + 1; j < NK; j++) x -= A[i][j] * b[j];
        b[i] = x / A[i][i];
    }
    return 0;
}

/* dy = (v, a) (48), lambda (20), contacts of A and B; stored[2]: impact velocities, <= 0 while none is stored. */
int press_rhs(const Press *p, double t, const double y[48], const double stored[2],
              double dy[48], double lambda[20], Contact contact[2])
{
    const double *q = y, *v = y + NQ;
    double phi[NC], phi_q[NC][NQ], gamma[NC], phi_t[NC];
    double A[NK][NK], b[NK];
    memset(A, 0, sizeof A);
    memset(b, 0, sizeof b);
    constraints(p, t, q, v, phi, phi_q, gamma, phi_t);
    for (int k = 0; k < NB; k++) {
        A[3*k][3*k] = A[3*k+1][3*k+1] = p->mass[k];
        A[3*k+2][3*k+2] = p->inertia[k];
        b[3*k+1] = -p->mass[k] * p->gravity;
    }
    for (int i = 0; i < NC; i++) {
        double rate = phi_t[i];
        for (int j = 0; j < NQ; j++) {
            A[NQ+i][j] = A[j][NQ+i] = phi_q[i][j];
            rate += phi_q[i][j] * v[j];
        }
        b[NQ+i] = gamma[i] - 2.0 * p->alpha * rate - p->beta * p->beta * phi[i];
    }
    const int pair[2][2] = { { L1, L2 }, { L4, L3 } };
    for (int k = 0; k < 2; k++) {
        const int bi = pair[k][0], bj = pair[k][1];
        joint_with_play(p, q, v, bi, bj, stored[k], &contact[k]);
        b[3*bj] += contact[k].fx;   b[3*bj+1] += contact[k].fy;   b[3*bj+2] += contact[k].moment_j;
        b[3*bi] -= contact[k].fx;   b[3*bi+1] -= contact[k].fy;   b[3*bi+2] += contact[k].moment_i;
    }
    const int bad = solve(A, b);
    if (bad) return bad;
    memcpy(dy, v, sizeof(double) * NQ);
    memcpy(dy + NQ, b, sizeof(double) * NQ);
    if (lambda) memcpy(lambda, b + NQ, sizeof(double) * NC);
    return 0;
}

int press_constraints(const Press *p, double t, const double y[48], double phi[20], double phi_dot[20])
{
    double phi_q[NC][NQ], gamma[NC], phi_t[NC];
    constraints(p, t, y, y + NQ, phi, phi_q, gamma, phi_t);
    for (int i = 0; i < NC; i++) {
        phi_dot[i] = phi_t[i];
        for (int j = 0; j < NQ; j++) phi_dot[i] += phi_q[i][j] * y[NQ+j];
    }
    return 0;
}

/* What a run remembers of one joint. Times are those of accepted steps; onset is interpolated. */
typedef struct {
    double first_contact, first_peak, peak, stored;
    int onsets, closed;
} Watch;

/* Classical RK4, fixed step. A step that begins free uses ratio 1 in all its stages; when it ends with
 * delta >= 0 the onset is accepted and delta_dot at that end is stored until delta < 0 at a later end.
 * Every `every` steps (and at the start) writes t, y, a, and per joint fx, fy, e into rows of 1 + 48 + 24 + 6. */
int press_rk4(const Press *p, double t0, double y[48], double step, long steps, long every, double *rows, Watch watch[2])
{
    double k1[48], k2[48], k3[48], k4[48], z[48], stored[2] = { watch[0].stored, watch[1].stored };
    Contact contact[2];
    double before[2] = { -1.0, -1.0 };
    for (long i = 0;; i++) {
        const double t = t0 + (double)i * step;
        int bad = press_rhs(p, t, y, stored, k1, NULL, contact);
        if (bad) return bad;
        int again = 0;
        for (int k = 0; k < 2; k++) {
            Watch *w = &watch[k];
            const double delta = contact[k].delta, rate = contact[k].deltadot;
            if (!w->closed && delta >= 0.0) {
                w->closed = 1; w->onsets++;
                stored[k] = rate > p->floor ? rate : p->floor;
                again = 1;
                if (isnan(w->first_contact)) w->first_contact = t - (i ? step * delta / (delta - before[k]) : 0.0);
            } else if (w->closed && delta < 0.0) { w->closed = 0; stored[k] = 0.0; }
            before[k] = delta;
        }
        if (again && (bad = press_rhs(p, t, y, stored, k1, NULL, contact))) return bad;
        for (int k = 0; k < 2; k++) {
            const double f = hypot(contact[k].fx, contact[k].fy);
            if (f > watch[k].peak) watch[k].peak = f;
            if (watch[k].onsets == 1 && watch[k].closed && !(f <= watch[k].first_peak)) watch[k].first_peak = f;
        }
        if (rows && i % every == 0) {
            double *row = rows + (i / every) * 79;
            row[0] = t;
            memcpy(row + 1, y, sizeof(double) * 48);
            memcpy(row + 49, k1 + NQ, sizeof(double) * 24);
            for (int k = 0; k < 2; k++) {
                row[73 + 3*k] = contact[k].fx; row[74 + 3*k] = contact[k].fy; row[75 + 3*k] = contact[k].e;
            }
        }
        if (i == steps) break;
        for (int j = 0; j < 48; j++) z[j] = y[j] + 0.5 * step * k1[j];
        if ((bad = press_rhs(p, t + 0.5 * step, z, stored, k2, NULL, contact))) return bad;
        for (int j = 0; j < 48; j++) z[j] = y[j] + 0.5 * step * k2[j];
        if ((bad = press_rhs(p, t + 0.5 * step, z, stored, k3, NULL, contact))) return bad;
        for (int j = 0; j < 48; j++) z[j] = y[j] + step * k3[j];
        if ((bad = press_rhs(p, t + step, z, stored, k4, NULL, contact))) return bad;
        for (int j = 0; j < 48; j++) y[j] += step / 6.0 * (k1[j] + 2.0 * (k2[j] + k3[j]) + k4[j]);
    }
    watch[0].stored = stored[0]; watch[1].stored = stored[1];
    return 0;
}

/* Least time of one right-hand side over `repeats` batches, in seconds. */
double press_seconds_per_rhs(const Press *p, double t, const double y[48], int batch, int repeats)
{
    double best = INFINITY, dy[48], lambda[20], z[48];
    const double stored[2] = { 0.1, 0.1 };
    Contact contact[2];
    memcpy(z, y, sizeof z);
    for (int r = 0; r < repeats; r++) {
        struct timespec a, b;
        clock_gettime(CLOCK_MONOTONIC, &a);
        for (int i = 0; i < batch; i++) { press_rhs(p, t, z, stored, dy, lambda, contact); z[0] = y[0] + 1e-30 * dy[24]; }
        clock_gettime(CLOCK_MONOTONIC, &b);
        const double s = ((double)(b.tv_sec - a.tv_sec) + 1e-9 * (double)(b.tv_nsec - a.tv_nsec)) / batch;
        if (s < best) best = s;
    }
    return best;
}
