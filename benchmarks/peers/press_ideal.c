/*
 * The press without clearance, solved by hand-written C: 24 constraint equations in 24 absolute coordinates, Newton
 * with a dense LU at every output, velocities and accelerations from the same factors. What a careful user does who
 * wants the motion and has no generator.
 */
#include "../../tests/oracles/press_dense.c"

static int factor(double A[NQ][NQ], int pivot[NQ])
{
    for (int k = 0; k < NQ; k++) {
        int best = k;
        for (int i = k + 1; i < NQ; i++) if (fabs(A[i][k]) > fabs(A[best][k])) best = i;
        if (!(fabs(A[best][k]) > 1e-14)) return 1 + k;
        pivot[k] = best;
        if (best != k)
            for (int j = 0; j < NQ; j++) { const double x = A[k][j]; A[k][j] = A[best][j]; A[best][j] = x; }
        const double inverse = 1.0 / A[k][k];
        for (int i = k + 1; i < NQ; i++) {
            if (A[i][k] == 0.0) continue;
            const double f = A[i][k] *= inverse;
            for (int j = k + 1; j < NQ; j++) A[i][j] -= f * A[k][j];
        }
    }
    return 0;
}

static void substitute(double A[NQ][NQ], const int pivot[NQ], double b[NQ])
{
    for (int k = 0; k < NQ; k++) {
        const double x = b[pivot[k]];
        b[pivot[k]] = b[k]; b[k] = x;
    }
    for (int i = 0; i < NQ; i++) for (int j = 0; j < i; j++) b[i] -= A[i][j] * b[j];
    for (int i = NQ - 1; i >= 0; i--) {
        for (int j = i + 1; j < NQ; j++) b[i] -= A[i][j] * b[j];
        b[i] /= A[i][i];
    }
}

static void all_rows(const Press *p, double t, const double *q, const double *v,
                     double phi[NQ], double phi_q[NQ][NQ], double gamma[NQ], double phi_t[NQ])
{
    constraints(p, t, q, v, phi, phi_q, gamma, phi_t);
    memset(phi_q[NC], 0, sizeof(double) * (NQ - NC) * NQ);
    memset(phi_t + NC, 0, sizeof(double) * (NQ - NC));
    const double *l = p->length;
    pin(q, v, NC, L1, 0.5 * l[L1], L2, -0.5 * l[L2], 0.0, 0.0, phi, phi_q, gamma);
    pin(q, v, NC + 2, L4, 0.5 * l[L4], L3, -0.5 * l[L3], 0.0, 0.0, phi, phi_q, gamma);
}

/* rows[i] = (q, v, a) at i step, i = 0 ... count - 1; q[24] is a guess for t = 0. 0, or what went wrong. */
int ideal_run(const Press *p, double step, long count, const double *guess, double *rows)
{
    double q[NQ], v[NQ] = { 0 }, a[NQ] = { 0 }, phi[NQ], phi_q[NQ][NQ], gamma[NQ], phi_t[NQ];
    int pivot[NQ], bad;
    memcpy(q, guess, sizeof q);
    for (long i = 0; i < count; i++) {
        const double t = (double)i * step;
        for (int j = 0; j < NQ && i; j++) q[j] += step * (v[j] + 0.5 * step * a[j]);
        for (int pass = 0;; pass++) {
            double worst = 0.0;
            all_rows(p, t, q, v, phi, phi_q, gamma, phi_t);
            if ((bad = factor(phi_q, pivot))) return bad;
            for (int j = 0; j < NQ; j++) worst = fmax(worst, fabs(phi[j]));
            if (worst < 1e-13) break;
            if (pass == 20) return -1;
            substitute(phi_q, pivot, phi);
            for (int j = 0; j < NQ; j++) q[j] -= phi[j];
        }
        for (int j = 0; j < NQ; j++) v[j] = -phi_t[j];
        substitute(phi_q, pivot, v);
        double unused[NQ], other[NQ][NQ];
        all_rows(p, t, q, v, unused, other, gamma, phi_t);  /* gamma at the velocities just found */
        memcpy(a, gamma, sizeof a);
        substitute(phi_q, pivot, a);
        double *row = rows + 3 * NQ * i;
        memcpy(row, q, sizeof q); memcpy(row + NQ, v, sizeof v); memcpy(row + 2 * NQ, a, sizeof a);
    }
    return 0;
}
