/* Where a step of rk4 ends because friction or a rigid contact changes. */
#if N_FRICTIONS || N_RIGID
/* The lowest indicator of friction that fell through zero between two states, or any rigid contact's; its value. */
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
#if N_RIGID
    for (int i = 0; i < N_CLEARANCES && found < 0; i++) {
        const double now = !gives(i) ? contact_margin(&run->memory, after, i) : 0.0;
        if (now < 0.0 && contact_margin(&run->memory, &run->aside, i) > now) {
            found = N_FRICTIONS + i;
            *value = now;
        }
    }
#endif
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
        if (rk4_try(run, share * h, p, trial))
            return -1.0;
        if (changed(run, &trial->aside, &value) < 0)
            low = share;
        else
            high = share;
    }
    return rk4_try(run, high * h, p, trial) ? -1.0 : high;
}

#else
/* No friction that may stick, no rigid contact: a step never ends early. */
static inline double friction_event(Run *run, double h, const Parameters *p, const Trial *trial)
{
    (void)run, (void)h, (void)p, (void)trial;
    return 1.0;
}
#endif
