/*
 * DOP853: the explicit method of order 8 of Dormand and Prince with dense output of order 7.
 * E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I (1993), section II.5.
 */

#include "../both/dop853.h"

/* Shares of a step, in their order, at which the estimate of its error hears of the equations. */
static const double dop853_heard[] = {0.0, 0.25, 0.3076923076923077, 0.3333333333333333, 0.6, 0.6512820512820513,
    0.8571428571428571, 1.0};

/* Three more stages, then the coefficients of the interpolant. */
static int dop853_dense(Run *run, const Parameters *p, Step *step)
{
    double (*k)[N_Y] = step->k;
    const double h = step->h;
    for (int i = 0; i < N_Y; i++)
        k[DOP853_STAGES][i] = step->dy[i];
    for (int s = DOP853_STAGES + 1; s < N_STAGES; s++) {
        double y[N_Y];
        Aside aside;
        dop853_stage(s, h, run->y, k, y);
        const int status = rates(run, step->t + dop853_node[s] * h, y, p, k[s], &aside);
        if (status)
            return status;
    }
    for (int i = 0; i < N_Y; i++) {
        const double change = step->y[i] - run->y[i];
        step->dense[0][i] = change;
        step->dense[1][i] = h * run->dy[i] - change;
        step->dense[2][i] = 2.0 * change - h * (step->dy[i] + run->dy[i]);
        step->dense[3][i] = h * (-8.428938276109013 * k[0][i] + 0.5667149535193777 * k[5][i]
            - 3.0689499459498917 * k[6][i] + 2.38466765651207 * k[7][i] + 2.117034582445028 * k[8][i]
            - 0.871391583777973 * k[9][i] + 2.2404374302607883 * k[10][i] + 0.6315787787694688 * k[11][i]
            - 0.08899033645133331 * k[12][i] + 18.148505520854727 * k[13][i] - 9.194632392478356 * k[14][i]
            - 4.436036387594894 * k[15][i]);
        step->dense[4][i] = h * (10.427508642579134 * k[0][i] + 242.28349177525817 * k[5][i]
            + 165.20045171727028 * k[6][i] - 374.5467547226902 * k[7][i] - 22.113666853125306 * k[8][i]
            + 7.733432668472264 * k[9][i] - 30.674084731089398 * k[10][i] - 9.332130526430229 * k[11][i]
            + 15.697238121770845 * k[12][i] - 31.139403219565178 * k[13][i] - 9.35292435884448 * k[14][i]
            + 35.81684148639408 * k[15][i]);
        step->dense[5][i] = h * (19.985053242002433 * k[0][i] - 387.0373087493518 * k[5][i]
            - 189.17813819516758 * k[6][i] + 527.8081592054236 * k[7][i] - 11.57390253995963 * k[8][i]
            + 6.8812326946963 * k[9][i] - 1.0006050966910838 * k[10][i] + 0.7777137798053443 * k[11][i]
            - 2.778205752353508 * k[12][i] - 60.19669523126412 * k[13][i] + 84.32040550667716 * k[14][i]
            + 11.99229113618279 * k[15][i]);
        step->dense[6][i] = h * (-25.69393346270375 * k[0][i] - 154.18974869023643 * k[5][i]
            - 231.5293791760455 * k[6][i] + 357.6391179106141 * k[7][i] + 93.40532418362432 * k[8][i]
            - 37.45832313645163 * k[9][i] + 104.0996495089623 * k[10][i] + 29.8402934266605 * k[11][i]
            - 43.53345659001114 * k[12][i] + 96.32455395918828 * k[13][i] - 39.17726167561544 * k[14][i]
            - 149.72683625798564 * k[15][i]);
    }
    return 0;
}

static void dop853_interpolate(const Run *run, const Step *step, double s, double *y)
{
    const double (*d)[N_Y] = (const double (*)[N_Y])step->dense;
    const double u = 1.0 - s;
    for (int i = 0; i < N_Y; i++)
        y[i] = run->y[i] + s * (d[0][i] + u * (d[1][i] + s * (d[2][i] + u * (d[3][i] + s * (d[4][i]
            + u * (d[5][i] + s * d[6][i]))))));
}

/* At h rho = 5.65 the estimate of order 5 vanishes for a decaying mode, at 6.4 the mode grows (both are zeros of
 * polynomials that follow from the coefficients). */
static const Method dop853 = {.name = "dop853", .try = dop853_try, .dense = dop853_dense,
    .interpolate = dop853_interpolate, .power = 0.125, .unstable = 4.8, .bounded = 4.0, .degree = 7, .turned = 0x2a,
    .heard = dop853_heard, .n_heard = COUNT_OF(dop853_heard)};
