/*
 * Peaks of forces and eccentricities in joints with play between the ends of a step, from its dense output. Inner: at a
 * time inside the step, not at its ends.
 */
enum { MAX_PARABOLAS = 20, MIN_INNER_STAGES = 2 /* with fewer stages inside, the dense output is evaluated */ };
#define MAX_SLOPE_CORRECTION 0.25 /* of the last chord's slope: with more by a parabola, the sign is uncertain */
#define MIN_FORCE_CHANGE 0.1 /* of the force: smallest change since the last stage that shows a trend */
#define RIGID_FORCE_TOL 1e-6 /* relative accuracy of the largest force of a rigid contact */
#define PEAK_TOL 0.1 /* times rtol: relative accuracy of a largest force, within these limits: */
#define MIN_PEAK_TOL 1e-10
#define MAX_PEAK_TOL 1e-5

/*
 * Record the force F (N) of a joint at time t (s) as possible peak of the run and of a closed contact. If there is an
 * envelope, extend it.
 */
static void record_force(Integrator *run, int joint, double t, double F)
{
    if (run->envelope.rows)
        extend_force_envelope(run, joint, t, F);
    update_peak_force(run, joint, t, F);
    update_contact_peak_force(run, joint, t, F);
}

/*
 * Return the force in N of a joint at a fraction of a step, from the dense output, and record it with the eccentricity
 * as possible maxima. If a switching function is on the wrong branch there, branches are updated for this evaluation
 * only. Return 0, without a record, if the evaluation fails. The dense output must have been computed.
 */
static double evaluate_and_record_joint_force(
    Integrator *run, const Step *step, double fraction, int joint, const Parameters *p)
{
    RhsOutputs rhs;
    int has_wrong_branch = 0;
    for (int k = 0; k < N_SWITCHES; k++)
        rhs.g[k] = NAN; /* stays NaN for functions on which no joint force depends */
    int status = evaluate_contacts_in_step(run, step, fraction, p, &rhs);
    for (int k = 0; k < N_SWITCHES; k++)
        has_wrong_branch |= run->discrete.branch[k] * rhs.g[k] < 0.0;
    if (!status && has_wrong_branch) { /* a switching point was passed inside the step: use the other branch */
        const DiscreteState discrete = run->discrete;
        double y[N_Y], dy[N_Y];
        status = evaluate_state_at(run, step, fraction, p, y, dy, &rhs);
        if (!status)
            status = update_branches_at(run, step->t + fraction * step->h, y, dy, &rhs, -1, p);
        run->discrete = discrete;
    }
    if (status)
        return 0.0;
    const double F = compute_force_magnitude(&rhs.clearance[joint]);
    record_force(run, joint, step->t + fraction * step->h, F);
    update_largest_eccentricity(run, joint, rhs.clearance[joint].e);
    return F;
}

/*
 * Return the node (fraction of the step) of the explicit stage inside (0, fraction) with the largest force of a joint,
 * if it exceeds min_force (N). Otherwise, and for stiff methods, return half of `fraction`.
 */
static double find_node_of_largest_force(const Step *step, double fraction, int joint, double min_force)
{
    const StageValues forces = get_stage_values(step, STAGE_FORCES + joint);
    double largest_square = min_force * min_force, node = 0.5 * fraction;
    for (int k = 0; k < step->n_stored_stages && !step->method->stiff; k++)
        if (step->node[k] > 0.0 && step->node[k] < fraction && read_stage(forces, k) > largest_square)
            largest_square = read_stage(forces, k), node = step->node[k];
    return node;
}

/*
 * Find the maximum of a joint's force inside a step up to `fraction` by parabolas through three points, and record
 * force_begin and each evaluated force. force_begin, force_end: the forces at both ends, N. The first middle point is
 * the integration node with the largest force. The search ends after MAX_PARABOLAS, or where the parabola predicts a
 * gain below the tolerance: PEAK_TOL rtol, clipped to MIN_PEAK_TOL..MAX_PEAK_TOL, relative to the largest force. Called
 * if a force rose before the step and falls at its end, or a stage exceeds both ends. The dense output must have been
 * computed.
 */
static void record_peak_within_step(Integrator *run, const Step *step, double fraction, int joint, double force_begin,
    double force_end,
    const Parameters *p)
{
    const double node = find_node_of_largest_force(step, fraction, joint, max_of(force_begin, force_end));
    const double tolerance = min_of(MAX_PEAK_TOL, max_of(MIN_PEAK_TOL, PEAK_TOL * get_rtol(run)));
    double f[3] = {force_begin, evaluate_and_record_joint_force(run, step, node, joint, p), force_end};
    double x[3] = {0.0, node, fraction}, error = INFINITY;
    record_force(run, joint, step->t, force_begin);
    for (int n = 0; n < MAX_PARABOLAS; n++) {
        const double width_left = x[1] - x[0], width_right = x[2] - x[1], drop_left = f[0] - f[1],
            drop_right = f[2] - f[1];
        const double curvature = drop_right * width_left + drop_left * width_right,
            rise = drop_right * width_left * width_left - drop_left * width_right * width_right;
        double x_peak = drop_left > drop_right ? x[0] : x[2];
        if (curvature < 0.0)
            x_peak = x[1] - 0.5 * rise / curvature;
        x_peak = min_of(x[2] - 0.1 * width_right, max_of(x[0] + 0.1 * width_left, x_peak));
        const double offset = x_peak - x[1], expected = f[1]
            + offset * (rise + curvature * offset) / (width_left * width_right * (width_left + width_right));
        const double largest = max_of(f[1], max_of(f[0], f[2]));
        if (curvature < 0.0 && expected - largest + 0.1 * error < tolerance * largest)
            break;
        const double force = evaluate_and_record_joint_force(run, step, x_peak, joint, p);
        const int above = x_peak > x[1], higher = force > f[1], end = above == higher ? 0 : 2;
        error = fabs(force - expected);
        x[end] = higher ? x[1] : x_peak;
        f[end] = higher ? f[1] : force;
        if (higher)
            x[1] = x_peak, f[1] = force;
    }
}

#if N_RIGID
/*
 * Return whether the stages of an explicit step show that the force of a contact only rises or only falls between
 * force_begin and force_end (N). The test uses a bound on the second derivative from the stages. Return 0 for stiff
 * methods, fewer than MIN_STAGES samples, a part of a step (fraction < 1), and terms of time that may oscillate between
 * stages.
 */
static int is_force_monotone(Step *step, double fraction, int joint, double force_begin, double force_end,
    const Parameters *p)
{
    Sample all[N_STAGES + 2];
    const StageValues forces = get_stage_values(step, STAGE_FORCES + joint);
    const Sample begin = {0.0, force_begin * force_begin, NAN}, end = {1.0, force_end * force_end, NAN};
    const int n = collect_stage_samples(step, begin, end, forces, all);
    const double curvature = bound_second_derivative(all, n);
    int rises = 0, falls = 0;
    for (int k = 1; k < n; k++) {
        const double w = all[k].s - all[k - 1].s, slope = (all[k].f - all[k - 1].f) / w;
        rises += slope - 0.5 * curvature * w > 0.0;
        falls += slope + 0.5 * curvature * w < 0.0;
    }
    return fraction == 1.0 && !step->method->stiff && n >= MIN_STAGES && (rises == n - 1 || falls == n - 1)
        && !may_terms_oscillate_between_stages(step, all, n, p);
}

/*
 * Find and record the largest force of a rigid contact inside a step up to `fraction`. The force may rise and fall
 * while the motion hardly changes. The step is therefore bisected (watch/forces.c) until no part can exceed the largest
 * force by RIGID_FORCE_TOL, at most MAX_BISECTIONS deep and with about MAX_FORCE_SAMPLES evaluations.
 *
 * force_begin, force_end: forces at both ends, N; the first is always recorded. The search is omitted if the stages
 * show a monotone force, or without dense output.
 */
static void record_rigid_peak(
    Integrator *run, Step *step, double fraction, int joint, double force_begin, double force_end, const Parameters *p)
{
    const double middle = 0.5 * fraction;
    SampledPart part[MAX_BISECTIONS + 1];
    Sample from = {0.0, force_begin, NAN};
    record_force(run, joint, step->t, force_begin);
    if (is_force_monotone(step, fraction, joint, force_begin, force_end, p) || compute_dense_output(run, p, step))
        return;
    part[0] =
        (SampledPart){{middle, evaluate_and_record_joint_force(run, step, middle, joint, p), NAN},
            {fraction, force_end, NAN}, INFINITY};
    for (int n = 1, samples = 1; n > 0;) {
        const SampledPart current_part = part[n - 1];
        const double largest_known = max_of(run->contacts.ongoing[joint].F_peak, force_end) * (1.0 + RIGID_FORCE_TOL);
        const double width = current_part.end.s - from.s;
        const double slope = 0.5 * (current_part.end.f - from.f);
        const double curvature = from.f - 2.0 * current_part.middle.f + current_part.end.f;
        const double parabola_maximum = curvature < 0.0 && fabs(slope) < -curvature
            ? current_part.middle.f - 0.5 * slope * slope / curvature : max_of(from.f, current_part.end.f);
        const int is_clear = !(parabola_maximum + current_part.error > largest_known)
            && !may_terms_oscillate_between(step, from.s, current_part.end.s, p);
        if (is_clear || n > MAX_BISECTIONS || samples > MAX_FORCE_SAMPLES) {
            from = current_part.end;
            n--;
            continue;
        }
        const double fractions[2] = {from.s + 0.25 * width, current_part.end.s - 0.25 * width};
        const Sample left = {fractions[0], evaluate_and_record_joint_force(run, step, fractions[0], joint, p), NAN};
        const Sample right = {fractions[1], evaluate_and_record_joint_force(run, step, fractions[1], joint, p), NAN};
        const double error = estimate_error_of_halves(from, current_part, left, right);
        part[n - 1] = (SampledPart){right, current_part.end, error};
        part[n++] = (SampledPart){left, current_part.middle, error};
        samples += 2;
    }
}
#endif

/*
 * Return the position in (0, 1) of the maximum of a cubic (Hermite interpolation), given by values and slopes at both
 * ends. Slopes are per unit interval, slope_0 > 0 > slope_1. *height: the value of the cubic at the maximum.
 */
static double find_cubic_maximum(double value_0, double slope_0, double value_1, double slope_1, double *height)
{
    const double b = 3.0 * (value_1 - value_0) - 2.0 * slope_0 - slope_1,
        c = slope_0 + slope_1 - 2.0 * (value_1 - value_0);
    const double s = slope_0 / (sqrt(b * b - 3.0 * c * slope_0) - b);
    *height = value_0 + s * (slope_0 + s * (b + s * c));
    return s;
}

/*
 * Find the largest eccentricity of a joint inside a step up to `fraction` by at most six cubics, and record each
 * evaluated one in the peaks and the envelope. Nothing happens unless the gap rate changes from outward to inward, if
 * the cubic stays more than 1 % below the largest known eccentricity, or if the evaluation fails.
 */
static void record_largest_eccentricity(Integrator *run, Step *step, double fraction, int joint, const Parameters *p)
{
    if (!(run->rhs.clearance[joint].deltadot > 0.0 && step->rhs.clearance[joint].deltadot < 0.0))
        return;
    Clearance clearance_low = run->rhs.clearance[joint], clearance_high = step->rhs.clearance[joint];
    double low_fraction = 0.0, high_fraction = fraction;
    for (int n = 0; n < 6 && clearance_low.deltadot > 0.0 && clearance_high.deltadot < 0.0; n++) {
        const double h = (high_fraction - low_fraction) * step->h;
        double cubic_maximum;
        /* 0 without a contour */
        const double contour_offset = clearance_low.e - get_outward_coordinate(&clearance_low);
        const double s = low_fraction
            + (high_fraction - low_fraction)
                * find_cubic_maximum(get_outward_coordinate(&clearance_low), h * clearance_low.deltadot,
                    get_outward_coordinate(&clearance_high), h * clearance_high.deltadot, &cubic_maximum);
        RhsOutputs rhs;
        if (cubic_maximum + contour_offset < run->contacts.e_max[joint] - 0.01 * fabs(run->contacts.e_max[joint])
            || compute_dense_output(run, p, step) || evaluate_contacts_in_step(run, step, s, p, &rhs))
            return;
        const Clearance *clearance = &rhs.clearance[joint];
        if (run->envelope.rows)
            extend_path_envelope(run, joint, step->t + s * step->h, clearance);
        update_largest_eccentricity(run, joint, clearance->e);
        if (fabs(get_outward_coordinate(clearance) - cubic_maximum) < 1e-9 * fabs(cubic_maximum + contour_offset))
            return;
        if (clearance->deltadot > 0.0)
            low_fraction = s, clearance_low = *clearance;
        else
            high_fraction = s, clearance_high = *clearance;
    }
}

/*
 * Return whether a joint's force (force_end, N) rises (1) or falls (-1) at a fraction of an explicit step, from the
 * last two stages before it. Return 0 if the sign is uncertain: the parabola's correction exceeds MAX_SLOPE_CORRECTION
 * of the slope, or the change is below MIN_FORCE_CHANGE; also for stiff methods. Used to find forces that pass a
 * maximum in the step.
 */
static int estimate_force_trend(const Step *step, double fraction, int joint, double force_end)
{
    double s[2] = {-1.0, -1.0}, f[2] = {NAN, NAN};
    const StageValues forces = get_stage_values(step, STAGE_FORCES + joint);
    for (int k = 0; k < step->n_stored_stages && !step->method->stiff; k++) {
        const double node = step->node[k];
        if (!(node < 0.99 * fraction && node > s[1]) || node == s[0])
            continue;
        const int last = node > s[0];
        const double square = read_stage(forces, k);
        s[1] = last ? s[0] : node, f[1] = last ? f[0] : square;
        s[0] = last ? node : s[0], f[0] = last ? square : f[0];
    }
    f[0] = sqrt(f[0]), f[1] = sqrt(f[1]);
    const double slope = (force_end - f[0]) / (fraction - s[0]);
    const double correction = (slope - (f[0] - f[1]) / (s[0] - s[1])) * (fraction - s[0]) / (fraction - s[1]);
    const int clear = fabs(correction) < MAX_SLOPE_CORRECTION * fabs(slope)
        && fabs(slope) * (fraction - s[0]) > MIN_FORCE_CHANGE * force_end;
    return clear ? (slope > 0.0) - (slope < 0.0) : 0;
}

/*
 * Set the trend of each joint whose entry in `trends` is 0 by one evaluation 1e-4 of the step later, along the rates at
 * its end: 1 rises, -1 falls. force_end: the forces at the fraction of the step, N. Return 0 or the status of the
 * evaluation; the trends are then unchanged. Called if the stages leave a trend unknown.
 */
static int determine_force_trends(Integrator *run, const Step *step, double fraction, const double *force_end,
    int *trends,
    const Parameters *p)
{
    double y[N_Y];
    RhsOutputs rhs;
    const double duration = FORCE_AHEAD * fraction * step->h;
    for (int k = 0; k < N_Y; k++)
        y[k] = step->y[k] + duration * step->dy[k];
    const int status = evaluate_contacts_at(run, step->t + fraction * step->h + duration, y, p, &rhs);
    for (int i = 0; i < N_CLEARANCES && !status; i++)
        if (!trends[i])
            trends[i] = compute_force_magnitude(&rhs.clearance[i]) > force_end[i] ? 1 : -1;
    return status;
}

/*
 * Return whether the force of a joint may exceed both end values (N) inside a step up to `fraction`. The parabola
 * through both ends and the first stage after `fraction` decides; its curvature is multiplied by ERROR_SAFETY. Return 0
 * if the maximum would exceed the larger end value by less than MAXIMUM_RATIO - 1 of it. Return 1 if there is no such
 * stage.
 */
static int may_have_maximum_within_step(
    const Step *step, double fraction, int joint, double force_begin, double force_end)
{
    const StageValues forces = get_stage_values(step, STAGE_FORCES + joint);
    double node = INFINITY, force = NAN;
    for (int k = 0; k < step->n_stored_stages; k++)
        if (step->node[k] > fraction && step->node[k] < node)
            node = step->node[k], force = sqrt(read_stage(forces, k));
    const double curvature =
        2.0 * ((force - force_begin) / node - (force_end - force_begin) / fraction) / (node - fraction);
    const double curve = ERROR_SAFETY * fabs(curvature) * fraction * fraction;
    return !(fabs(force_end - force_begin) > 0.5 * curve
        || 0.125 * curve < (MAXIMUM_RATIO - 1.0) * max_of(force_begin, force_end));
}

/*
 * Return the largest known force in N of a joint inside a step up to `fraction`, from its stages; 0 without stages
 * inside. If a compliant contact continues, fewer than MIN_INNER_STAGES are inside and may_have_maximum_within_step()
 * is true, the force in the middle is evaluated on the dense output and recorded as well. force_begin, force_end:
 * forces at both ends, N.
 */
static double find_largest_force_within_step(
    Integrator *run, Step *step, double fraction, int joint, double force_begin, double force_end, const Parameters *p)
{
    double largest_square = 0.0;
    int n_inner = 0;
    const StageValues forces = get_stage_values(step, STAGE_FORCES + joint);
    for (int k = 0; k < step->n_stored_stages; k++)
        if (step->node[k] > 0.0 && step->node[k] < fraction) {
            largest_square = max_of(largest_square, read_stage(forces, k));
            n_inner++;
        }
    if (n_inner < MIN_INNER_STAGES && run->discrete.contact[joint].closed && is_compliant(joint)
        && may_have_maximum_within_step(step, fraction, joint, force_begin, force_end)
            && compute_dense_output(run, p, step) == 0)
        return max_of(sqrt(largest_square), evaluate_and_record_joint_force(run, step, 0.5 * fraction, joint, p));
    return sqrt(largest_square);
}

/*
 * Return whether the force of a joint vanishes at the end of a step: it is below 1e-6 of that at the beginning (both
 * N). In a closed contact the law would pull there, and the force is set to zero.
 */
static int has_tension_at_end(double force_before, double force_after) { return force_after < 1e-6 * force_before; }

/*
 * Find the peaks of forces and eccentricities of all joints inside an accepted step up to `fraction`, and record them.
 * Forces are searched where a stage exceeds both ends, or where a force near its largest value was rising and now
 * falls. Store which forces rise at the end. Without trends, because an evaluation fails, the search of forces is
 * omitted. Called after each accepted step.
 */
static void record_peaks_within_step(Integrator *run, Step *step, double fraction, const Parameters *p)
{
    enum { LOW = 2 }; /* a force too small to be a peak */
    double force_begin[AT_LEAST_ONE(N_CLEARANCES)], force_end[AT_LEAST_ONE(N_CLEARANCES)];
    int trends[AT_LEAST_ONE(N_CLEARANCES)], has_inner_peak[AT_LEAST_ONE(N_CLEARANCES)], has_unknown = 0;
    for (int i = 0; i < N_CLEARANCES; i++) {
        record_largest_eccentricity(run, step, fraction, i, p);
        const Clearance *a = &run->rhs.clearance[i], *b = &step->rhs.clearance[i];
        const double largest_known = run->discrete.contact[i].closed ? run->contacts.ongoing[i].F_peak
            : run->contacts.F_peak[i];
        force_begin[i] = compute_force_magnitude(a), force_end[i] = compute_force_magnitude(b);
        /* a contact's force may double in a step, a film's grows by some percent */
        const double min_ratio = run->discrete.contact[i].closed ? 0.9 : FILM_PEAK_RATIO;
#if N_RIGID
        if (!is_compliant(i) && run->discrete.contact[i].closed)
            record_rigid_peak(run, step, fraction, i, force_begin[i], force_end[i], p);
#endif
        const int has_force = run->discrete.contact[i].closed || has_film(i);
        const double larger_end = max_of(force_begin[i], force_end[i]);
        const double largest_inner = has_force
            ? find_largest_force_within_step(run, step, fraction, i, force_begin[i], force_end[i], p) : 0.0;
        has_inner_peak[i] = is_compliant(i) && largest_inner > (step->method->stiff ? MAXIMUM_RATIO_STIFF
            : MAXIMUM_RATIO) * larger_end;
        const double candidate = !is_compliant(i) ? 0.0 : has_inner_peak[i] ? largest_inner : larger_end;
        const int has_event_candidate = candidate > min_ratio * largest_known && candidate > 0.0;
        const int is_pulling = has_event_candidate && has_tension_at_end(force_begin[i], force_end[i]);
        trends[i] = !has_event_candidate ? LOW : is_pulling ? -1
            : estimate_force_trend(step, fraction, i, force_end[i]);
        has_unknown |= !trends[i];
    }
    if (has_unknown && determine_force_trends(run, step, fraction, force_end, trends, p))
        return;
    for (int i = 0; i < N_CLEARANCES; i++) {
        const int reverses = run->rhs.clearance[i].F_n * step->rhs.clearance[i].F_n < 0.0; /* it was zero in between */
        const int has_event_candidate = trends[i] != LOW, falls = has_event_candidate && trends[i] < 0;
        if (has_event_candidate && (((falls || reverses) && run->contacts.is_rising[i]) || has_inner_peak[i])
            && compute_dense_output(run, p, step) == 0)
            record_peak_within_step(run, step, fraction, i, force_begin[i], force_end[i], p);
        set_force_rising(run, i, !falls);
    }
}
