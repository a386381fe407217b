/*
 * The nine-bar press as hand-written C for other solvers: right-hand side, its Jacobian by forward differences, gaps of
 * both joints with play, and a whole run by CVODE.
 *
 * The equations are those of press_dense.c, taken as they stand: 48 numbers y = (q, v), dense 44x44 system.
 */
#include "../../tests/oracles/press_dense.c"

/* A run's data and its counters. `array` is SUNDIALS' N_VGetArrayPointer; NULL where plain arrays are passed. */
typedef struct {
    Press press;
    double stored[2];       /* impact velocities, m/s; <= 0 while none is stored */
    long calls;             /* right-hand sides, those of differences included */
    double *(*array)(void *);
    double *(*matrix)(void *);
} Peer;

int peer_rhs(Peer *peer, double t, const double *y, double *dy)
{
    Contact contact[2];
    peer->calls++;
    return press_rhs(&peer->press, t, y, peer->stored, dy, NULL, contact);
}

/* d(dy)/dy by columns, J[48 j + i]; 48 right-hand sides beside f = dy(y). Increments as a user sets them:
 * sqrt(eps) times the size, and at least what a clearance of tenths of a millimetre wants. */
int peer_jacobian(Peer *peer, double t, const double *y, const double *f, double *J)
{
    double z[48];
    memcpy(z, y, sizeof z);
    for (int j = 0; j < 48; j++) {
        const double h = 1.5e-8 * fmax(fabs(y[j]), j < NQ ? 1e-3 : 1e-1);
        z[j] = y[j] + h;
        const double step = z[j] - y[j];
        const int bad = peer_rhs(peer, t, z, J + 48 * j);
        if (bad) return bad;
        for (int i = 0; i < 48; i++) J[48*j+i] = (J[48*j+i] - f[i]) / step;
        z[j] = y[j];
    }
    return 0;
}

/* Penetration, its rate and the slip of the surfaces at A and B, without a solve: out = (delta, delta_dot, slip),
 * each for A and B; the slip is that of press_dense.c, at one point in the middle of the penetration. */
void peer_gaps(const Peer *peer, const double *y, double out[6])
{
    const int pair[2][2] = { { L1, L2 }, { L4, L3 } };
    for (int k = 0; k < 2; k++) {
        const int i = 3 * pair[k][0], j = 3 * pair[k][1];
        const double hi = 0.5 * peer->press.length[pair[k][0]], hj = 0.5 * peer->press.length[pair[k][1]];
        const double *v = y + NQ, ci = hi * cos(y[i+2]), si = hi * sin(y[i+2]);
        const double cj = hj * cos(y[j+2]), sj = hj * sin(y[j+2]);
        const double ex = y[j] - cj - y[i] - ci, ey = y[j+1] - sj - y[i+1] - si, e = hypot(ex, ey);
        const double ux = v[j] + v[j+2] * sj - v[i] + v[i+2] * si, uy = v[j+1] - v[j+2] * cj - v[i+1] - v[i+2] * ci;
        out[k] = e - peer->press.clearance;
        out[2+k] = e > 0.0 ? (ux * ex + uy * ey) / e : 0.0;
        const double Ri = peer->press.radius, Rj = Ri - peer->press.clearance, half = 0.5 * out[k];
        out[4+k] = e > 0.0 ? (uy * ex - ux * ey) / e + v[j+2] * (Rj - half) - v[i+2] * (Ri + half) : 0.0;
    }
}

double peer_seconds_per_rhs(const Peer *peer, double t, const double *y, int batch, int repeats)
{
    return press_seconds_per_rhs(&peer->press, t, y, batch, repeats);
}

/* The signatures that CVODE calls; nothing of SUNDIALS' headers is needed for them. */
int peer_cvode_rhs(double t, void *y, void *dy, void *data)
{
    Peer *peer = data;
    return peer_rhs(peer, t, peer->array(y), peer->array(dy)) ? 1 : 0;
}

int peer_cvode_jacobian(double t, void *y, void *f, void *J, void *data, void *a, void *b, void *c)
{
    Peer *peer = data;
    (void)a; (void)b; (void)c;
    return peer_jacobian(peer, t, peer->array(y), peer->array(f), peer->matrix(J)) ? 1 : 0;
}

/* Root functions of CVODE: the penetrations of A and B. */
int peer_cvode_gaps(double t, void *y, double *g, void *data)
{
    Peer *peer = data;
    double out[6];
    (void)t;
    peer_gaps(peer, peer->array(y), out);
    g[0] = out[0]; g[1] = out[1];
    return 0;
}
