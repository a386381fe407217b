/* The lowest indicator that fell through zero between two states; its value in `value`. */
static int changed(const Run *run, const Aside *after, double *value)
{
    int found = -1;
    *value = 0.0;
    for (int i = 0; i < N_FRICTIONS; i++) {
        const double now = indicator(&run->memory, after, i);
        if (now < *value && indicator(&run->memory, &run->aside, i) > now) {
            found = i;
            *value = now;
        }
    }
    return found;
}

/* Share of h at which the first change happens, the trial made anew up to there; 1 if none does, -1 on failure. */
static double friction_event(Run *run, double h, const Parameters *p, Trial *trial)
{
    double low = 0.0, high = 1.0, value;
    if (changed(run, &trial->aside, &value) < 0)
        return 1.0;
    const double close = max_of(4.0 * DBL_EPSILON * fabs(run->t) / h, 1e-12);
    for (int i = 0; i < 60 && high - low > close; i++) {
        const double share = 0.5 * (low + high);
        if (rk4_trial(run, share * h, p, trial))
            return -1.0;
        if (changed(run, &trial->aside, &value) < 0)
            low = share;
        else
            high = share;
    }
    return rk4_trial(run, high * h, p, trial) ? -1.0 : high;
}
