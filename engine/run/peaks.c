/* Peaks of forces and eccentricities in joints with play between the ends of a step, from its dense output. */
enum { MAX_PARABOLAS = 20, MIN_INNER_STAGES = 2 /* with fewer stages inside, the dense output is evaluated */ };
#define MAX_BEND 0.25 /* of the last chord's slope: largest correction by a parabola that leaves the sign certain */
#define MIN_FORCE_CHANGE 0.1 /* of the force: smallest change since the last stage that shows a trend */
#define MAXIMUM_RATIO 1.001 /* ratio of a stage's force to those at both ends that shows a maximum between */
#define MAXIMUM_RATIO_STIFF 1.1 /* the same for stiff methods, whose stages have larger errors */
#define RIGID_FORCE_TOL 1e-6 /* relative accuracy of the largest force of a rigid contact */
#define PEAK_TOL 0.1 /* times rtol: relative accuracy of a largest force, within these limits: */
#define MIN_PEAK_TOL 1e-10
#define MAX_PEAK_TOL 1e-5

/* Record the force F (N) of joint i at time t (s) in the envelope and the peaks of run and contact. */
static void record_force(Integrator *run, int i, double t, double F)
{
    if (run->envelope.rows)
        extend_force_envelope(run, i, t, F);
    raise_force(run, i, t, F);
    raise_contact_force(run, i, t, F);
}

/*
 * Return the force in N of joint i at fraction s of a step, and record it with the eccentricity; 0 if it is undefined.
 */
static double evaluate_joint_force(Integrator *run, const Step *step, double s, int i, const Parameters *p)
{
    RhsOutputs rhs;
    int wrong = 0;
    for (int k = 0; k < N_SWITCHES; k++)
        rhs.g[k] = NAN; /* stays NaN for functions on which no joint force depends */
    int status = evaluate_contacts_in_step(run, step, s, p, &rhs);
    for (int k = 0; k < N_SWITCHES; k++)
        wrong |= run->discrete.branch[k] * rhs.g[k] < 0.0;
    if (!status && wrong) { /* a switching point was passed inside the step: use the other branch */
        const DiscreteState held = run->discrete;
        double y[N_Y], dy[N_Y];
        status = state_at(run, step, s, p, y, dy, &rhs);
        if (!status)
            status = update_branches_at(run, step->t + s * step->h, y, dy, &rhs, -1, p);
        run->discrete = held;
    }
    if (status)
        return 0.0;
    const double F = total_force(&rhs.clearance[i]);
    record_force(run, i, step->t + s * step->h, F);
    raise_eccentricity(run, i, rhs.clearance[i].e);
    return F;
}

/*
 * Return the fraction of the explicit stage before `fraction` with the largest force of joint i, or half of `fraction`.
 */
static double node_of_largest_force(const Step *step, double fraction, int i, double force)
{
    const StageValues forces = stage_values(step, STAGE_FORCES + i);
    double most = force * force, node = 0.5 * fraction;
    for (int k = 0; k < step->n_seen && !step->method->stiff; k++)
        if (step->node[k] > 0.0 && step->node[k] < fraction && stage_value(forces, k) > most)
            most = stage_value(forces, k), node = step->node[k];
    return node;
}

/*
 * Find the maximum of joint i's force inside a step up to `fraction` by parabolas through three points. before, after:
 * the forces at both ends, N. The search ends where the parabola predicts a gain below PEAK_TOL tolerances.
 */
static void find_inner_peak(Integrator *run, const Step *step, double fraction, int i, double before, double after,
    const Parameters *p)
{
    const double first = node_of_largest_force(step, fraction, i, max_of(before, after));
    const double fine = min_of(MAX_PEAK_TOL, max_of(MIN_PEAK_TOL, PEAK_TOL * tolerance_of(run)));
    double f[3] = {before, evaluate_joint_force(run, step, first, i, p), after};
    double x[3] = {0.0, first, fraction}, error = INFINITY;
    record_force(run, i, step->t, before);
    for (int n = 0; n < MAX_PARABOLAS; n++) {
        const double low = x[1] - x[0], high = x[2] - x[1], left = f[0] - f[1], right = f[2] - f[1];
        const double bend = right * low + left * high, rise = right * low * low - left * high * high;
        double top = left > right ? x[0] : x[2];
        if (bend < 0.0)
            top = x[1] - 0.5 * rise / bend;
        top = min_of(x[2] - 0.1 * high, max_of(x[0] + 0.1 * low, top));
        const double u = top - x[1], expected = f[1] + u * (rise + bend * u) / (low * high * (low + high));
        const double most = max_of(f[1], max_of(f[0], f[2]));
        if (bend < 0.0 && expected - most + 0.1 * error < fine * most)
            break;
        const double found = evaluate_joint_force(run, step, top, i, p);
        const int above = top > x[1], higher = found > f[1], end = above == higher ? 0 : 2;
        error = fabs(found - expected);
        x[end] = higher ? x[1] : top;
        f[end] = higher ? f[1] : found;
        if (higher)
            x[1] = top, f[1] = found;
    }
}

#if N_RIGID
/* Return whether the stages of an explicit step show that the force of contact i only rises or only falls. */
static int is_force_monotone(Step *step, double fraction, int i, double before, double after, const Parameters *p)
{
    Sample all[N_STAGES + 2];
    const StageValues forces = stage_values(step, STAGE_FORCES + i);
    const Sample begin = {0.0, before * before, NAN}, end = {1.0, after * after, NAN};
    const int n = values_of_stages(step, begin, end, forces, all);
    const double bend = max_second_derivative(all, n);
    int rises = 0, falls = 0;
    for (int k = 1; k < n; k++) {
        const double w = all[k].s - all[k - 1].s, slope = (all[k].f - all[k - 1].f) / w;
        rises += slope - 0.5 * bend * w > 0.0;
        falls += slope + 0.5 * bend * w < 0.0;
    }
    return fraction == 1.0 && !step->method->stiff && n >= MIN_STAGES && (rises == n - 1 || falls == n - 1)
        && !may_oscillate_between_stages(step, all, n, p);
}

/*
 * Find the largest force of rigid contact i inside a step up to `fraction`. The force may rise and fall while the
 * motion hardly changes. The step is therefore bisected (watch/forces.c) until no part can exceed the largest force.
 */
static void find_rigid_peak(
    Integrator *run, Step *step, double fraction, int i, double before, double after, const Parameters *p)
{
    const double middle = 0.5 * fraction;
    Sampled part[MAX_BISECTIONS + 1];
    Sample from = {0.0, before, NAN};
    record_force(run, i, step->t, before);
    if (is_force_monotone(step, fraction, i, before, after, p) || compute_dense_output(run, p, step))
        return;
    part[0] =
        (Sampled){{middle, evaluate_joint_force(run, step, middle, i, p), NAN}, {fraction, after, NAN}, INFINITY};
    for (int n = 1, samples = 1; n > 0;) {
        const Sampled now = part[n - 1];
        const double known = max_of(run->contacts.open[i].F_peak, after) * (1.0 + RIGID_FORCE_TOL);
        const double w = now.end.s - from.s;
        const double slope = 0.5 * (now.end.f - from.f), bend = from.f - 2.0 * now.middle.f + now.end.f;
        const double top = bend < 0.0 && fabs(slope) < -bend ? now.middle.f - 0.5 * slope * slope / bend
            : max_of(from.f, now.end.f);
        const int clear = !(top + now.error > known) && !may_oscillate_between(step, from.s, now.end.s, p);
        if (clear || n > MAX_BISECTIONS || samples > MAX_FORCE_SAMPLES) {
            from = now.end;
            n--;
            continue;
        }
        const double s[2] = {from.s + 0.25 * w, now.end.s - 0.25 * w};
        const Sample left = {s[0], evaluate_joint_force(run, step, s[0], i, p), NAN};
        const Sample right = {s[1], evaluate_joint_force(run, step, s[1], i, p), NAN};
        const double error = error_of_halves(from, now, left, right);
        part[n - 1] = (Sampled){right, now.end, error};
        part[n++] = (Sampled){left, now.middle, error};
        samples += 2;
    }
}
#endif

/*
 * Return the position in (0, 1) of the maximum of the cubic through (d0, d1) with end slopes r0 > 0 > r1; *height: its
 * value.
 */
static double cubic_maximum(double d0, double r0, double d1, double r1, double *height)
{
    const double b = 3.0 * (d1 - d0) - 2.0 * r0 - r1, c = r0 + r1 - 2.0 * (d1 - d0);
    const double s = r0 / (sqrt(b * b - 3.0 * c * r0) - b);
    *height = d0 + s * (r0 + s * (b + s * c));
    return s;
}

/*
 * Find the largest eccentricity of joint i inside a step up to `fraction`, if the journal turns back inside the step.
 */
static void find_largest_eccentricity(Integrator *run, Step *step, double fraction, int i, const Parameters *p)
{
    Clearance low = run->rhs.clearance[i], high = step->rhs.clearance[i];
    double from = 0.0, to = fraction;
    for (int n = 0; n < 6 && low.deltadot > 0.0 && high.deltadot < 0.0; n++) {
        const double h = (to - from) * step->h;
        double top;
        const double round = low.e - outward_coordinate(&low); /* 0 without a contour */
        const double s = from
            + (to - from)
                * cubic_maximum(outward_coordinate(&low), h * low.deltadot,
                    outward_coordinate(&high), h * high.deltadot, &top);
        RhsOutputs rhs;
        if (top + round < run->contacts.e_max[i] - 0.01 * fabs(run->contacts.e_max[i])
            || compute_dense_output(run, p, step) || evaluate_contacts_in_step(run, step, s, p, &rhs))
            return;
        const Clearance *now = &rhs.clearance[i];
        if (run->envelope.rows)
            extend_path_envelope(run, i, step->t + s * step->h, now);
        raise_eccentricity(run, i, now->e);
        if (fabs(outward_coordinate(now) - top) < 1e-9 * fabs(top + round))
            return;
        if (now->deltadot > 0.0)
            from = s, low = *now;
        else
            to = s, high = *now;
    }
}

/*
 * Return whether joint i's force rises (1) or falls (-1) at a fraction of an explicit step, from the last two stages
 * before it. 0: the parabola through them leaves the sign uncertain, or the method is stiff.
 */
static int force_trend(const Step *step, double fraction, int i, double after)
{
    double s[2] = {-1.0, -1.0}, f[2] = {NAN, NAN};
    const StageValues forces = stage_values(step, STAGE_FORCES + i);
    for (int k = 0; k < step->n_seen && !step->method->stiff; k++) {
        const double node = step->node[k];
        if (!(node < 0.99 * fraction && node > s[1]) || node == s[0])
            continue;
        const int last = node > s[0];
        const double square = stage_value(forces, k);
        s[1] = last ? s[0] : node, f[1] = last ? f[0] : square;
        s[0] = last ? node : s[0], f[0] = last ? square : f[0];
    }
    f[0] = sqrt(f[0]), f[1] = sqrt(f[1]);
    const double slope = (after - f[0]) / (fraction - s[0]);
    const double bend = (slope - (f[0] - f[1]) / (s[0] - s[1])) * (fraction - s[0]) / (fraction - s[1]);
    const int clear = fabs(bend) < MAX_BEND * fabs(slope) && fabs(slope) * (fraction - s[0]) > MIN_FORCE_CHANGE * after;
    return clear ? (slope > 0.0) - (slope < 0.0) : 0;
}

/*
 * Determine the trend of forces whose `trends` entry is 0 by a very short step along the motion. Return 0 or the
 * status.
 */
static int extrapolate_trends(Integrator *run, const Step *step, double fraction, const double *after, int *trends,
    const Parameters *p)
{
    double x[N_Y];
    RhsOutputs rhs;
    const double e = 1e-4 * fraction * step->h;
    for (int k = 0; k < N_Y; k++)
        x[k] = step->y[k] + e * step->dy[k];
    const int status = play(run, step->t + fraction * step->h + e, x, p, &rhs);
    for (int i = 0; i < N_CLEARANCES && !status; i++)
        if (!trends[i])
            trends[i] = total_force(&rhs.clearance[i]) > after[i] ? 1 : -1;
    return status;
}

/*
 * Return whether the force of joint i may exceed both end values inside a step up to `fraction`. The estimate is the
 * parabola through both ends and the first stage beyond.
 */
static int may_have_inner_maximum(const Step *step, double fraction, int i, double before, double after)
{
    const StageValues forces = stage_values(step, STAGE_FORCES + i);
    double node = INFINITY, force = NAN;
    for (int k = 0; k < step->n_seen; k++)
        if (step->node[k] > fraction && step->node[k] < node)
            node = step->node[k], force = sqrt(stage_value(forces, k));
    const double bend = 2.0 * ((force - before) / node - (after - before) / fraction) / (node - fraction);
    const double curve = ERROR_SAFETY * fabs(bend) * fraction * fraction;
    return !(fabs(after - before) > 0.5 * curve || 0.125 * curve < (MAXIMUM_RATIO - 1.0) * max_of(before, after));
}

/*
 * Return the largest known force in N of joint i inside a step up to `fraction`: at its stages, or in the middle if a
 * contact continues and few stages are inside.
 */
static double largest_force_inside(Integrator *run, Step *step, double fraction, int i, const Parameters *p)
{
    const double before = total_force(&run->rhs.clearance[i]), after = total_force(&step->rhs.clearance[i]);
    double most = 0.0;
    int found = 0;
    const StageValues forces = stage_values(step, STAGE_FORCES + i);
    for (int k = 0; k < step->n_seen; k++)
        if (step->node[k] > 0.0 && step->node[k] < fraction) {
            most = max_of(most, stage_value(forces, k));
            found++;
        }
    if (found < MIN_INNER_STAGES && run->discrete.contact[i].closed && gives(i)
        && may_have_inner_maximum(step, fraction, i, before, after) && compute_dense_output(run, p, step) == 0)
        return max_of(sqrt(most), evaluate_joint_force(run, step, 0.5 * fraction, i, p));
    return sqrt(most);
}

/*
 * Return whether a contact law ceases to push at the end of a step: with the contact held closed, its force would pull.
 */
static int is_pulling_at_end(double before, double after) { return after < 1e-6 * before; }

/*
 * Find the peaks of all joints inside a step up to `fraction`, where a force near its largest rose before and now
 * falls.
 */
static void find_inner_peaks(Integrator *run, Step *step, double fraction, const Parameters *p)
{
    enum { LOW = 2 }; /* a force too small to be a peak */
    double before[AT_LEAST_ONE(N_CLEARANCES)], after[AT_LEAST_ONE(N_CLEARANCES)];
    int trends[AT_LEAST_ONE(N_CLEARANCES)], arches[AT_LEAST_ONE(N_CLEARANCES)], unknown = 0;
    for (int i = 0; i < N_CLEARANCES; i++) {
        find_largest_eccentricity(run, step, fraction, i, p);
        const Clearance *a = &run->rhs.clearance[i], *b = &step->rhs.clearance[i];
        const double known = run->discrete.contact[i].closed ? run->contacts.open[i].F_peak : run->contacts.F_peak[i];
        before[i] = total_force(a), after[i] = total_force(b);
        /* a contact's force may double in a step, a film's grows by some percent */
        const double share_of = run->discrete.contact[i].closed ? 0.9 : 0.97;
#if N_RIGID
        if (!gives(i) && run->discrete.contact[i].closed)
            find_rigid_peak(run, step, fraction, i, before[i], after[i], p);
#endif
        const int bears = run->discrete.contact[i].closed || has_film(i);
        const double ends = max_of(before[i], after[i]),
                     inside = bears ? largest_force_inside(run, step, fraction, i, p) : 0.0;
        arches[i] = gives(i) && inside > (step->method->stiff ? MAXIMUM_RATIO_STIFF : MAXIMUM_RATIO) * ends;
        const double largest = !gives(i) ? 0.0 : arches[i] ? inside : ends;
        const int near = largest > share_of * known && largest > 0.0;
        const int pulls = near && is_pulling_at_end(before[i], after[i]);
        trends[i] = !near ? LOW : pulls ? -1 : force_trend(step, fraction, i, after[i]);
        unknown |= !trends[i];
    }
    if (unknown && extrapolate_trends(run, step, fraction, after, trends, p))
        return;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const int turned = run->rhs.clearance[i].F_n * step->rhs.clearance[i].F_n < 0.0; /* it was zero in between */
        const int near = trends[i] != LOW, falls = near && trends[i] < 0;
        if (near && (((falls || turned) && run->contacts.is_rising[i]) || arches[i])
            && compute_dense_output(run, p, step) == 0)
            find_inner_peak(run, step, fraction, i, before[i], after[i], p);
        set_rising(run, i, !falls);
    }
}
