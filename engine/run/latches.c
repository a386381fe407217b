/*
 * Onsets and separations of joints with play, from gap and approach at both ends of a step.
 */

#define SHALLOW_RIGID (8.0 * DBL_EPSILON) /* of the clearance: each blow of surfaces that do not give has an impulse */

/* How far below zero a joint's margin lies without a meaning, m. */
static double shallow(const Parameters *p, int k)
{
    return gives(k) ? -min_of(SHALLOW, 1e-10 * deepest(p, k)) : -SHALLOW_RIGID * radial_clearance(p, k);
}

/* Parameter s in [0, 1] at which the cubic through (d0, h r0) and (d1, h r1) crosses zero; its slope in `rate`. */
static double crossing(double d0, double r0, double d1, double r1, double h, double *rate)
{
    double low = 0.0, high = 1.0, s = 0.5;
    for (int i = 0; i < 60; i++) {
        s = 0.5 * (low + high);
        const double u = 1.0 - s;
        const double d = u * u * (1.0 + 2.0 * s) * d0 + s * u * u * h * r0 + s * s * (3.0 - 2.0 * s) * d1
            - s * s * u * h * r1;
        if ((d >= 0.0) == (d1 >= 0.0))
            high = s;
        else
            low = s;
    }
    *rate = 6.0 * s * (1.0 - s) * (d1 - d0) / h + (1.0 - s) * (1.0 - 3.0 * s) * r0 + s * (3.0 * s - 2.0) * r1;
    return s;
}

/* Inner states of the laws of a joint: what they gathered at these rates within h. */
static void bend(Run *run, int i, double h, const Clearance *now)
{
#if LAW_STATES
    for (int k = 0; k < LAW_STATES; k++)
        run->y[FIRST_STATE + i * LAW_STATES + k] = h > 0.0 ? h * now->state_rate[k] : 0.0;
#else
    (void)run, (void)i, (void)h, (void)now;
#endif
}

/* Onset: remember the impact velocity, not below its floor. */
static void close_joint(Run *run, int i, double t, double deltadot, double floor)
{
    run->memory.latch[i].closed = 1;
    run->memory.latch[i].deltadot_minus = max_of(deltadot, floor);
    run->compressing[i] = 1;
    run->rising[i] = 1;
    bend(run, i, 0.0, &run->aside.clearance[i]);
    run->onsets++;
    run->open[i] = (Impact){t, NAN, run->memory.latch[i].deltadot_minus, 0.0, t, i};
}

/* Separation: the contact goes into the list that Python fetches. */
static void open_joint(Run *run, int i, double t)
{
    run->memory.latch[i].closed = 0;
    bend(run, i, 0.0, &run->aside.clearance[i]);
    run->open[i].t_off = t;
    if (run->n_impacts < LISTED_IMPACTS) /* more in one step only where friction cuts it in parts */
        run->impacts[run->n_impacts++] = run->open[i];
}

/* Free, impact, contact from gap and approach at both ends of a step; 1 if any joint changed. */
static int update_latches(Run *run, double t, double h, const Clearance *before, const Clearance *after,
    const unsigned char *touched, const Parameters *p)
{
    int changed = 0;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const double d0 = before[i].delta, d1 = after[i].delta;
        double rate;
        if (!gives(i)) { /* these begin and end where they are located (impacts.c) */
            run->grazes += !run->memory.latch[i].closed && touched[i] && d1 < 0.0;
            continue;
        }
        /* a journal that leaves zero is free, whatever its penetration is rounded to */
        const int touches = d1 >= 0.0 && (d1 > -shallow(p, i) || after[i].deltadot > 0.0);
        if (!run->memory.latch[i].closed && touches) {
            const double s = d0 < 0.0 ? crossing(d0, before[i].deltadot, d1, after[i].deltadot, h, &rate) : 0.0;
            /* a run that begins in contact: at least as fast as its surfaces move (begin_in_contact) */
            close_joint(run, i, t + s * h, d0 < 0.0 ? rate : fabs(before[i].deltadot), slowest_impact(p, i));
            bend(run, i, (1.0 - s) * h, &after[i]);
            changed = 1;
        } else if (run->memory.latch[i].closed && d1 < 0.0) {
            open_joint(run, i, t + h * crossing(d0, before[i].deltadot, d1, after[i].deltadot, h, &rate));
            changed = 1;
        } else if (!run->memory.latch[i].closed && touched[i]) {
            run->grazes++; /* in and out again within one step */
            bend(run, i, 0.0, &after[i]);
        }
        note_turn(run, i, after[i].deltadot);
    }
    return changed;
}

