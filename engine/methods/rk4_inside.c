/*
 * What lies between the ends of a step of rk4: samples, and contacts that begin and end there.
 */
enum { MAX_INSIDE = 60 }; /* places that are tried for a zero */

static void begin_step(Run *run)
{
    Beginning *from = &run->from;
    from->t = run->t;
    for (int k = 0; k < N_Y; k++) {
        from->y[k] = run->y[k];
        from->dy[k] = run->dy[k];
    }
    for (int i = 0; i < N_CLEARANCES; i++) {
        from->closed[i] = run->memory.latch[i].closed;
        from->compressing[i] = run->contacts.compressing[i];
    }
}

/* Latches and codes at time t within the step that began as `from` and led to the present state. */
static void latches_at(const Run *run, const Beginning *from, double t, double *latched, signed char *state)
{
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Latch *latch = &run->memory.latch[i];
        const int changed = !latch->closed != !from->closed[i];
        const int since = latch->closed ? t >= run->contacts.open[i].t_on : !(t < run->contacts.open[i].t_off);
        const int closed = changed && !since ? from->closed[i] : latch->closed;
        const int compressing = changed && since ? run->contacts.compressing[i] : from->compressing[i];
        latched[i] = closed ? latch->deltadot_minus : NAN;
        state[i] = (signed char)(closed ? 2 - compressing : 0);
    }
}

/*
 * The state at time t inside the step that began as `from` and led to the present state: the cubic through both ends
 * with their rates (C. Hermite, J. reine angew. Math. 84, 1878), which errs by O(h^4), on the constraints as ends of
 * steps are.
 */
static void state_inside(Run *run, const Beginning *from, double t, const Parameters *p, double *now)
{
    const double h = run->t - from->t, s = (t - from->t) / h, u = 1.0 - s;
    for (int k = 0; k < N_Y; k++)
        now[k] = u * u * ((1.0 + 2.0 * s) * from->y[k] + s * h * from->dy[k])
            + s * s * ((3.0 - 2.0 * s) * run->y[k] - u * h * run->dy[k]);
    close_state(run, t, now, p);
}

/* Samples inside the step that began as `from` and led to the present state. */
static void sample_inside(Run *run, const Beginning *from, const Parameters *p, const Samples *out)
{
    enum { MEMORY = AT_LEAST_ONE(N_MEMORY), JOINTS = AT_LEAST_ONE(N_CLEARANCES) };
    const double close = rounded(run->t, run->t - from->t);
    for (; *out->done < out->n && out->t[*out->done] < run->t - close; ++*out->done) {
        const double t = out->t[*out->done];
        double now[N_Y];
        state_inside(run, from, t, p, now);
        store_sample(run, t, now, p, *out->done, out->y, out->latched, out->state);
        latches_at(run, from, t, out->latched + *out->done * MEMORY, out->state + *out->done * JOINTS);
    }
}

/* Samples at the present state. */
static void sample_here(const Run *run, double h, const Parameters *p, const Samples *out)
{
    for (; *out->done < out->n && out->t[*out->done] <= run->t + rounded(run->t, h); ++*out->done)
        store_sample(run, run->t, run->y, p, *out->done, out->y, out->latched, out->state);
}

/*
 * Whether a step changes a contact, or a joint that is free at both ends may touch inside it: a stage did, or its
 * penetration first grows and then falls, and both tangents, below which it lies where it bends down, meet above zero.
 */
static int may_touch(const Run *run, double h, const Trial *trial)
{
    int some = 0;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Clearance *a = &run->aside.clearance[i], *b = &trial->aside.clearance[i];
        const double x = (b->delta - a->delta - b->deltadot * h) / (a->deltadot - b->deltadot);
        const int turns = a->deltadot > 0.0 && b->deltadot < 0.0 && a->delta + a->deltadot * x > 0.0;
        const int closed = run->memory.latch[i].closed, changes = closed ? b->delta < 0.0 : b->delta >= 0.0;
        some |= gives(i) && (changes || (!closed && (trial->touched[i] || turns)));
    }
    return some;
}

/* Joint i at time t inside the step that began as `from`. */
static Clearance joint_inside(Run *run, const Beginning *from, int i, double t, const Parameters *p)
{
    double now[N_Y], dy[N_Y];
    Aside aside;
    state_inside(run, from, t, p, now);
    if (rates(run, t, now, p, dy, &aside))
        return (Clearance){.delta = NAN, .deltadot = NAN};
    return aside.clearance[i];
}

/*
 * Where the penetration of joint i, or its rate, crosses zero between two times at which it is `low` and `high`, of
 * different signs: by the Illinois method (M. Dowell, P. Jarratt, BIT 11:168, 1971), on the side of the first time.
 */
static double zero_inside(Run *run, const Beginning *from, int i, int rate, double t, double low, double end,
    double high, const Parameters *p)
{
    const double close = rounded(run->t, run->t - from->t);
    int side = 0;
    for (int k = 0; k < MAX_INSIDE && fabs(end - t) > close && low != 0.0; k++) {
        const double middle = (t * high - end * low) / (high - low);
        const Clearance joint = joint_inside(run, from, i, middle, p);
        const double value = rate ? joint.deltadot : joint.delta;
        if ((value > 0.0) == (low > 0.0)) {
            high *= side > 0 ? 0.5 : 1.0;
            t = middle, low = value, side = 1;
        } else {
            low *= side < 0 ? 0.5 : 1.0;
            end = middle, high = value, side = -1;
        }
    }
    return t;
}

/* Lists a contact of joint i, free at both ends of the step, that begins and ends inside it, if there is one. */
static void locate_graze(Run *run, const Beginning *from, int i, const Clearance *before, const Parameters *p)
{
    const Clearance *after = &run->aside.clearance[i];
    if (!(before->deltadot > 0.0 && after->deltadot < 0.0))
        return;
    const double top = zero_inside(run, from, i, 1, from->t, before->deltadot, run->t, after->deltadot, p);
    const Clearance joint = joint_inside(run, from, i, top, p);
    if (!(joint.delta > -shallow(p, i)) || run->contacts.n_impacts >= LISTED_IMPACTS)
        return;
    const double on = zero_inside(run, from, i, 0, from->t, before->delta, top, joint.delta, p);
    const double off = zero_inside(run, from, i, 0, run->t, after->delta, top, joint.delta, p);
    const double rate = joint_inside(run, from, i, on, p).deltadot, F = total_force(&joint);
    list_graze(run, &(Impact){on, off, max_of(rate, slowest_impact(p, i)), F, top, i}, joint.e);
}

/*
 * Contacts inside the step that began as `from` and led to the present state: their begins and ends are those of the
 * motion that samples show.
 */
static void locate_inside(Run *run, const Beginning *from, const Clearance *before, const Parameters *p)
{
    const long evaluations = run->counts.evaluations;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const int closed = run->memory.latch[i].closed;
        const double low = before[i].delta, high = run->aside.clearance[i].delta;
        if (!gives(i))
            continue;
        if (!closed && !from->closed[i]) {
            locate_graze(run, from, i, &before[i], p);
        } else if (closed != from->closed[i] && (low > 0.0) != (high > 0.0)) {
            const double t = zero_inside(run, from, i, 0, closed ? from->t : run->t, closed ? low : high,
                closed ? run->t : from->t, closed ? high : low, p);
            move_contact(run, i, t);
        }
    }
    restore_evaluations(run, evaluations); /* output, not integration */
}
