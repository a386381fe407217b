/* Text of a struct: what is carried from one step of rk4 to the next, by the names that a run has for it. */
Number t;
struct {
    Number steps, evaluations;
} counts;
Number y[N_Y], dy[N_Y];
#if N_USER_EVENTS
struct {
    Number speed[2];
} norm;
#endif
struct {
    Number phi_max, phi_dot_max;
} residuals;
struct {
    Number ratio_min, ratio_max, ratio_outside;
    Number F_peak[AT_LEAST_ONE(N_CLEARANCES)], t_peak[AT_LEAST_ONE(N_CLEARANCES)], e_max[AT_LEAST_ONE(N_CLEARANCES)];
    struct {
        Number F_peak, t_peak; /* of the contact that lasts */
    } open[AT_LEAST_ONE(N_CLEARANCES)];
    Flag compressing[AT_LEAST_ONE(N_CLEARANCES)]; /* 0 or -1 */
} contacts;
struct {
    Number e, delta, deltadot; /* at the end of the last step */
} journal[AT_LEAST_ONE(N_CLEARANCES)];
