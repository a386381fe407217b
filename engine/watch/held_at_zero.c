/*
 * Which values of watched functions mean nothing along a step: those below their uncertainty (run/uncertainty.c), as of
 * a velocity that something holds at zero. A step is not ended by their signs, nor searched for them.
 */
#define ENOUGH_PARTS 0.125 /* of a step, over which bounds tell whether they become narrower with it */

/*
 * How large margins are that mean nothing, at whichever end of a step that is less: by rounding, and by the tolerance
 * of an error of the state. They are found once they are asked for.
 */
typedef struct {
    int known;
    double rounding[N_WATCHED], tolerance[N_WATCHED], lowest[N_WATCHED]; /* its lower bound over the whole step */
} Noise;

static void find_noise(Run *run, const Step *step, Noise *noise, const Parameters *p)
{
    double error[2 * N_X + 1], at_end[N_WATCHED];
    if (noise->known)
        return;
    noise->known = 1;
    for (int k = 0; k < 2 * N_X; k++)
        error[k] = 1.0 / run->norm.weight[k];
    uncertainty(run, step->t, run->y, p, noise->rounding);
    error_of_watched(run, step->t, run->y, error, p, noise->tolerance);
    uncertainty(run, step->t + step->h, step->y, p, at_end);
    for (int i = 0; i < N_WATCHED; i++)
        noise->rounding[i] = min_of(noise->rounding[i], at_end[i]);
    error_of_watched(run, step->t + step->h, step->y, error, p, at_end);
    for (int i = 0; i < N_WATCHED; i++)
        noise->tolerance[i] = min_of(noise->tolerance[i], at_end[i]);
}

/* The state at share s of a step, on the constraints; that at its begin where the time alone is read. */
static void watched_state(Run *run, const Step *step, double s, const Parameters *p, double *y)
{
    memcpy(y, s < 1.0 ? run->y : step->y, N_Y * sizeof *y);
#if WATCHES_STATE
    if (s > 0.0 && s < 1.0) {
        interpolate(run, step, s, y);
        project_state(run, step->t + s * step->h, y, p);
    }
#else
    (void)p;
#endif
}

/* Whether margin i, of this value at share s of a step, is below its uncertainty there. */
static int is_noise(Run *run, const Step *step, double s, int i, double value, const Parameters *p)
{
    double y[N_Y], error[N_WATCHED];
    watched_state(run, step, s, p, y);
    uncertainty(run, step->t + s * step->h, y, p, error);
    return fabs(value) <= error[i];
}

/*
 * Whether a margin is taken as zero over a part: it is no larger than rounding at both ends, and its bounds are within
 * what the tolerance allows; or they are so wide because they do not know how its terms depend on each other, and
 * become narrower with the part, as those of a function do that hides nothing in it.
 */
static int is_held_at_zero(const Noise *noise, int i, Range f, double at_a, double at_b, double width)
{
    return fabs(at_a) <= noise->rounding[i] && fabs(at_b) <= noise->rounding[i] && !f.partly
        && (f.lo >= -noise->tolerance[i] || (width <= ENOUGH_PARTS && f.lo >= 4.0 * width * noise->lowest[i]));
}
