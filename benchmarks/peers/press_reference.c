/*
 * Reference solution of the dry nine-bar press: the equations of press_dense.c in long double, by the extrapolated
 * midpoint rule of order 12 with a fixed step. W. B. Gragg; R. Bulirsch, J. Stoer, Numer. Math. 8 (1966) 1-13.
 *
 * Onset, separation and every bend of the friction law (|slip| = v0, v1) end a step: its length is the root found
 * by repeating the step with another length, so that no interpolant enters. It shares no integrator with any peer.
 */
#include <math.h>
#include <stddef.h>
#include <string.h>
#include <time.h>
#include <tgmath.h>
#define double long double
#include "../../tests/oracles/press_dense.c"
#undef double

typedef long double real;
enum { N = 48, COLUMNS = 6, LEVELS = 4 };

typedef struct {
    Press press;
    real y[N], stored[2];
    real since[2];             /* of the last onset, s */
    int closed[2], region[2];  /* region: how many of the levels -v1, -v0, v0, v1 the slip is above */
} Motion;

static int rhs(const Motion *m, real t, const real *y, real *dy)
{
    Contact contact[2];
    return press_rhs(&m->press, t, y, m->stored, dy, NULL, contact);
}

/* One step of length h from m->y. */
static int extrapolate(const Motion *m, real t, real h, real *out)
{
    real f0[N], f[N], table[COLUMNS][N];
    int bad = rhs(m, t, m->y, f0);
    for (int j = 0; j < COLUMNS && !bad; j++) {
        const int n = 2 * (j + 1);
        const real s = h / n;
        real before[N], now[N];
        memcpy(before, m->y, sizeof before);
        for (int i = 0; i < N; i++) now[i] = before[i] + s * f0[i];
        for (int k = 1; k < n && !bad; k++) {
            bad = rhs(m, t + k * s, now, f);
            for (int i = 0; i < N; i++) { const real z = before[i] + 2 * s * f[i]; before[i] = now[i]; now[i] = z; }
        }
        if (!bad) bad = rhs(m, t + h, now, f);
        for (int i = 0; i < N; i++) {
            real value = (now[i] + before[i] + s * f[i]) / 2;
            for (int k = 1; k <= j; k++) {  /* Aitken and Neville; table[i] holds the last row */
                const real q = (real)n / (2 * (j + 1 - k)), old = table[k-1][i];
                table[k-1][i] = value;
                value += (value - old) / (q * q - 1);
            }
            table[j][i] = value;
        }
    }
    memcpy(out, table[COLUMNS-1], sizeof(real) * N);
    return bad;
}

/* delta, its rate and the slip of joint k, by the contact of press_dense.c. */
static void gap(const Motion *m, const real *y, int k, real out[3])
{
    const int pair[2][2] = { { L1, L2 }, { L4, L3 } };
    const int i = 3 * pair[k][0], j = 3 * pair[k][1];
    const real hi = m->press.length[pair[k][0]] / 2, hj = m->press.length[pair[k][1]] / 2, *v = y + NQ;
    const real ci = hi * cos(y[i+2]), si = hi * sin(y[i+2]), cj = hj * cos(y[j+2]), sj = hj * sin(y[j+2]);
    const real ex = y[j] - cj - y[i] - ci, ey = y[j+1] - sj - y[i+1] - si, e = hypot(ex, ey);
    const real ux = v[j] + v[j+2] * sj - v[i] + v[i+2] * si, uy = v[j+1] - v[j+2] * cj - v[i+1] - v[i+2] * ci;
    const real Ri = m->press.radius, Rj = Ri - m->press.clearance, delta = e - m->press.clearance;
    out[0] = delta;
    out[1] = e > 0 ? (ux * ex + uy * ey) / e : 0;
    out[2] = e > 0 ? (uy * ex - ux * ey) / e + v[j+2] * (Rj - delta / 2) - v[i+2] * (Ri + delta / 2) : 0;
}

static real level(const Motion *m, int r)
{
    const real all[LEVELS] = { -m->press.v1, -m->press.v0, m->press.v0, m->press.v1 };
    return all[r];
}

/* What can happen next at joint k: 0 its contact changes; -1, +1 its slip leaves the region below, above.
 * Positive values: it has happened. */
static real passed(const Motion *m, const real *y, int k, int kind)
{
    real g[3];
    gap(m, y, k, g);
    if (kind == 0) return m->closed[k] ? -g[0] : g[0];
    if (!m->closed[k]) return -1;
    if (kind < 0) return m->region[k] > 0 ? level(m, m->region[k] - 1) - g[2] : -1;
    return m->region[k] < LEVELS ? g[2] - level(m, m->region[k]) : -1;
}

/* The length in (0, h] at which `passed` is zero: regula falsi with the Illinois change, each trial a full step. */
static int locate(const Motion *m, real t, real h, int k, int kind, real *root)
{
    real a = 0, b = h, y[N], ga = passed(m, m->y, k, kind), gb;
    int bad = extrapolate(m, t, h, y), branch = 0;
    gb = passed(m, y, k, kind);
    if (ga >= 0) { *root = 0; return bad; }
    for (int pass = 0; pass < 60 && b - a > 1e-19L && !bad; pass++) {
        const real s = (a * gb - b * ga) / (gb - ga);
        if ((bad = extrapolate(m, t, s, y))) break;
        const real g = passed(m, y, k, kind);
        if (g == 0) { a = b = s; break; }
        if (g > 0) { if (b - s < 1e-20L) pass = 60; b = s; gb = g; if (branch == 1) ga /= 2; branch = 1; }
        else       { if (s - a < 1e-20L) pass = 60; a = s; ga = g; if (branch == -1) gb /= 2; branch = -1; }
    }
    *root = b;
    return bad;
}

static void apply_event(Motion *m, real t, int k, int kind, real *onsets, int *count, int most)
{
    real g[3];
    gap(m, m->y, k, g);
    if (kind != 0) { m->region[k] += kind; return; }
    m->closed[k] = !m->closed[k];
    m->stored[k] = m->closed[k] ? (g[1] > m->press.floor ? g[1] : m->press.floor) : 0;
    if (!m->closed[k]) return;
    m->since[k] = t;
    for (m->region[k] = 0; m->region[k] < LEVELS && g[2] > level(m, m->region[k]);) m->region[k]++;
    if (*count < most) { real *row = onsets + 3 * (*count)++; row[0] = k; row[1] = t; row[2] = m->stored[k]; }
}

/* delta^n bends at delta = 0 as t^n does: no order of a method helps there. So steps grow from SHORTEST by doubling
 * after an onset, and halve what is left before a separation. `slope`: the longest where friction follows the slip
 * (v0 < |slip| < v1), a rate of some 1e5 1/s. */
static real graded(const Motion *m, real t, real h, real slope)
{
    const real shortest = 1e-9L;
    for (int k = 0; k < 2; k++) {
        real g[3];
        if (!m->closed[k]) continue;
        gap(m, m->y, k, g);
        h = fmin(h, fmax(shortest, t - m->since[k]));
        if (m->region[k] == 1 || m->region[k] == 3) h = fmin(h, slope);
        if (g[1] < 0) h = fmin(h, fmax(shortest, -g[0] / g[1] / 2));
    }
    return h;
}

/* From t to t + h, through whatever happens between. */
static int advance(Motion *m, real t, real h, real *onsets, int *count, int most)
{
    const real end = t + h, slope = h / 8, near = 1e-8L;
    while (end - t > 1e-19L) {
        real y[N], length = graded(m, t, end - t, slope), first = length;
        int joint = -1, what = 0, bad = extrapolate(m, t, length, y);
        for (int k = 0; k < 2 && !bad; k++) for (int kind = -1; kind <= 1 && !bad; kind++) {
            real root;
            if (passed(m, y, k, kind) <= 0) continue;
            bad = locate(m, t, length, k, kind, &root);
            if (root <= first) { first = root; joint = k; what = kind; }
        }
        if (joint >= 0 && first > near) { first *= 0.75L; joint = -1; }  /* stages of a long step look past the bend */
        if (!bad && (joint >= 0 || first < length)) bad = extrapolate(m, t, first, y);
        if (bad) return bad;
        memcpy(m->y, y, sizeof y);
        t += first;
        if (joint >= 0) apply_event(m, t, joint, what, onsets, count, most);
    }
    return 0;
}

/* `data`: the 24 + 26 numbers of Press in order; y0[48]; rows (outputs, 48); onsets (most, 3): joint, t, stored.
 * The number of onsets, or -1 where a step failed. */
int reference_run(const double *data, const double *y0, double t_end, int outputs, int steps,
                  double *rows, double *onsets, int most)
{
    Motion m;
    real found[3 * 256], *field = (real *)&m.press;
    int count = 0;
    memset(&m, 0, sizeof m);
    for (size_t i = 0; i < sizeof(Press) / sizeof(real); i++) field[i] = data[i];
    for (int i = 0; i < N; i++) m.y[i] = rows[i] = y0[i];
    if (most > 256) most = 256;
    for (int row = 1; row < outputs; row++) {
        const real t0 = (real)t_end * (row - 1) / (outputs - 1), h = (real)t_end / (outputs - 1) / steps;
        for (int s = 0; s < steps; s++) if (advance(&m, t0 + s * h, h, found, &count, most)) return -1;
        for (int i = 0; i < N; i++) rows[N * row + i] = (double)m.y[i];
    }
    for (int i = 0; i < 3 * count; i++) onsets[i] = (double)found[i];
    return count;
}
