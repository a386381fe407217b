/*
 * Step-size control, and the choice between the explicit and the stiff method.
 *
 * After a step with the error e, in tolerances, and one with the error e' before it, the next length is
 *     h SAFETY e^(-ERROR_EXPONENT power) e'^(LAST_ERROR_EXPONENT power),   power = 1 / (order of the estimate + 1).
 * This is the PI controller of K. Gustafsson, ACM Trans. Math. Softw. 17 (1991), 533-554, in the form of E. Hairer,
 * G. Wanner, Solving ODEs II (1996), section IV.2. Gustafsson recommends 0.7 and 0.4 for explicit methods.
 *
 * [1] E. Hairer, S. P. Norsett, G. Wanner, Solving ODEs I (1993), section II.4, and its code DOP853; [2] the code
 * RADAU5 of II, section IV.8. Constants without a source were chosen for gudgeon.
 */
#define SAFETY_ONSET 0.8        /* the same for the first step of a contact, whose error has a lower order */
#define MAX_GROWTH_EVENTS 2.0   /* largest ratio if a monitored function may have a zero in the step */
#define MAX_GROWTH_FIRST 5.0    /* largest ratio for the stored length of first steps after an event */
#define MIN_SHRINK 0.1          /* smallest ratio of the lengths of an attempt and the rejected one before */
#define MAX_SHRINK 0.9          /* largest ratio */
#define MIN_INFERRED_ORDER 2.0      /* smallest order inferred from the errors of two rejected attempts */
#define SHRINK_NEWTON 0.5       /* ratio if Newton's iteration failed [2] */
#define SHRINK_FAILED 0.25      /* ratio if a stage is not finite */
#define SHRINK_UNRESOLVED 0.25  /* ratio if the motion between the stages is not resolved */
#define FLIGHT_STEP_SLACK 1.5        /* times compute_flight_step_limit(): longer steps are rejected */
#define SHRINK_FLIGHT_STEP 0.5       /* ratio of the next attempt then */
#define TRANSIENT_PART 0.5          /* of the time up to a missed transient: length of the next attempt */
#define MIN_SEPARATION_FRACTION 0.1         /* of a step: an earlier separation does not shorten it */
enum { MIN_RETURN_STEPS = 8, MAX_RETURN_STEPS = 4096 /* successive steps until the stiff method is left */,
    LASTING_STEPS = 400 /* steps with a method after which the next return to it is as easy as the first */,
    RATE_ITERATIONS = 5, RECONSIDER_STEPS = 24, MAX_RECONSIDER_STEPS = 256 /* steps until a refused change is tested */,
    MAX_OPPOSING_STEPS = 3 /* successive steps against the explicit method until the first change */,
    MAX_OPPOSING_LIMIT = 1024 /* the same after changes that did not pay, at most about */,
    CHECK_STIFF_STEPS = 32 /* steps of the stiff method between comparisons of its length with the explicit one */,
    MIN_COMPARE_STEPS = 8, MAX_COMPARE_STEPS = 200 /* steps after a change: the lengths of both methods are compared */,
    MAX_REDUCTIONS = 12 /* reductions by four: what remains unresolved then is rounding */ };
#define FILM_ERROR_RATIO 0.7   /* largest ratio of the film errors of a shorter and a longer step without rounding */
#define MIN_TRANSIENT_FRACTION 1e-9     /* of the times: in shorter steps no transients are searched */
#define STIFF_COST 1.3             /* times a step of the explicit method: processor time of a stiff step */
#define MAX_OPPOSING_GROWTH 2.0    /* with films: ratio of step lengths up to which the stiff method is left */
#define STIFF_LENGTH_RATIO 0.8     /* of the stiff step length: an explicit step must be longer to be cheaper */
#define WORK_TOL 10.0    /* times rtol: allowed error of the works of a step relative to the energy throughput */
#define SEPARATION_MARGIN 1.05    /* of the estimated time to a separation: length of a step that ends after it */
#define MAX_EXPLICIT_STABILITY 2.5     /* h rho below which the explicit method is cheaper */
#define MAX_INFERRED_ORDER 30.0 /* largest order of error growth inferred from two steps */

/* Replace the methods that a run stores by those of this library, when a call continues a run of another library. */
static void relink_methods(Integrator *run)
{
    run->choice.method = find_method_in_library(run->choice.method);
    run->choice.explicit = find_method_in_library(run->choice.explicit);
    run->choice.implicit = find_method_in_library(run->choice.implicit);
}

/*
 * Set the first method of a run by its index from gudgeon_method(), and the stiff method to which it may change: its
 * index, or 0 if the method never changes. A run that begins with the stiff method returns to dop853, after 4
 * MIN_RETURN_STEPS steps that oppose the stiff method instead of MIN_RETURN_STEPS.
 */
static void set_method_choice(Integrator *run, int method, int stiff_method)
{
    run->choice.method = METHODS[method];
    run->choice.explicit = METHODS[method]->stiff ? EXPLICIT_METHOD : METHODS[method];
    run->choice.automatic = stiff_method > 0;
    run->choice.implicit = METHODS[stiff_method];
    run->choice.max_opposing_steps = MAX_OPPOSING_STEPS;
    run->choice.return_steps = stiff_method && METHODS[method]->stiff ? 4 * MIN_RETURN_STEPS : MIN_RETURN_STEPS;
}

/*
 * Start the step-size control of a run at its current time, which also becomes the origin of the grid of fixed steps.
 * fixed_step: length of all steps, s, which are accepted with any error; 0: steps with an error norm of at most 1 are
 * accepted, and the first length is estimated later. The error before the first step counts as MIN_LAST_ERROR. The
 * choice of the method (set_method_choice()) is not changed.
 */
static void start_step_control(Integrator *run, double fixed_step)
{
    run->control.fixed = run->control.h = fixed_step;
    run->control.fixed_steps_origin = run->t;
    run->control.error_before = MIN_LAST_ERROR;
    run->control.max_accepted_error = fixed_step > 0.0 ? INFINITY : 1.0;
}

/*
 * Change the method of a run from the explicit to the stiff one, or back, and reset the counters of the automatic
 * choice. On the way back, the length of the stiff method is stored as h_stiff; else h_stiff and the mean length of the
 * stiff method become 0. After a method that controls its length, the next length is that of the last step. If the
 * explicit method was used for at most LASTING_STEPS steps, the next return needs twice as many steps. Also called when
 * the matrix of the stiff method is singular.
 */
static void change_method(Integrator *run)
{
    const int stiff = run->choice.method->stiff;
    if (!stiff)
        run->choice.return_steps = run->choice.steps_since_change > LASTING_STEPS ? MIN_RETURN_STEPS
            : run->choice.return_steps < MAX_RETURN_STEPS ? 2 * run->choice.return_steps : run->choice.return_steps;
    run->control.h_stiff = stiff ? run->control.h : 0.0;
    if (run->choice.method->controls_length)
        set_next_step_length(run, run->step.h); /* not the much larger limit of the next attempt */
    run->choice.method = stiff ? run->choice.explicit : run->choice.implicit;
    if (!stiff)
        run->choice.mean_length[1] = 0.0;
    run->choice.n_opposing_steps = run->choice.n_unstable_steps = 0;
    run->choice.steps_since_change = 0;
}

/*
 * Estimate rho, the largest rate of the motion near the run's state in 1/s (spectral radius), by nonlinear power
 * iteration with RATE_ITERATIONS + 1 right-hand sides; 0: unknown. The method is that of B. P. Sommeijer, L. F.
 * Shampine, J. G. Verwer, J. Comput. Appl. Math. 88 (1998), 315-326. Stages of a stiff method do not show a fast mode
 * at rest, which makes an explicit step unstable.
 */
static double estimate_largest_rate(Integrator *run, const Parameters *p)
{
    double direction[N_Y], y[N_Y], dy[N_Y], growth[2] = {0.0, 0.0};
    RhsOutputs rhs;
    for (int k = 0; k < N_Y; k++)
        direction[k] = (k % 2 ? -1.0 : 1.0) / run->norm.weight[k];
    for (int n = 0; n <= RATE_ITERATIONS; n++) {
        double size = 0.0;
        for (int k = 2 * N_X; k < FIRST_STATE; k++)
            direction[k] = 0.0; /* no rate depends on the works */
        for (int k = 0; k < N_Y; k++)
            size = max_of(size, fabs(direction[k]) * run->norm.weight[k]);
        growth[n % 2] = size; /* over two iterations: a vibration alternates between positions and velocities */
        for (int k = 0; k < N_Y; k++)
            y[k] = run->y[k] + direction[k] / size;
        if (!(size > 0.0 && isfinite(size)) || evaluate_run_rhs(run, run->t, y, p, dy, &rhs))
            return 0.0;
        for (int k = 0; k < N_Y; k++)
            direction[k] = dy[k] - run->dy[k];
    }
    return sqrt(growth[0] * growth[1]);
}

/*
 * Update the mean length of recent steps of the method with one of length h (s), and return whether the stiff method
 * does not pay: its mean is less than STIFF_COST times that of the explicit steps before. The test is made
 * MIN_COMPARE_STEPS steps after the change and each CHECK_STIFF_STEPS steps.
 */
static int detect_slow_stiff_method(MethodChoice *choice, double h)
{
    double *mean = &choice->mean_length[!!choice->method->stiff];
    *mean = update_mean_length(*mean, h);
    return choice->method->stiff && choice->steps_since_change % CHECK_STIFF_STEPS == MIN_COMPARE_STEPS
        && choice->mean_length[1] < STIFF_COST * choice->mean_length[0];
}

/*
 * Count whether the accepted step speaks against its method, and switch the method of an automatic run after enough
 * such steps. The explicit method is left when stability limits its steps, or its steps are shorter than those of the
 * stiff one. The stiff method is left when stability would not limit explicit steps, by an estimate of rho (spectral
 * radius of the Jacobian, 1/s), or when its steps do not pay; the next switch to it then needs twice as many steps.
 * With films it is not left while its steps still grow (MAX_OPPOSING_GROWTH). A refused switch waits RECONSIDER_STEPS,
 * from the explicit method as many steps as since the last one, if more. Called after each accepted step.
 */
static void switch_method_after_step(Integrator *run, const Parameters *p)
{
    /* the stiff method's stages give a lower bound of rho: soon after a change, compare the step lengths too */
    const int slower = run->choice.steps_since_change > MIN_COMPARE_STEPS
        && run->choice.steps_since_change < MAX_COMPARE_STEPS
        && run->control.h < STIFF_LENGTH_RATIO * run->control.h_stiff;
    const int stiff = run->choice.method->stiff;
    const double stability = run->choice.h_rho;
    if (detect_slow_stiff_method(&run->choice, run->step.h) && run->choice.automatic) {
        run->choice.max_opposing_steps *= run->choice.max_opposing_steps < MAX_OPPOSING_LIMIT ? 2 : 1;
        run->choice.rho = 0.0;
        change_method(run);
        return;
    }
    const int against = stiff ? stability < MAX_EXPLICIT_STABILITY
        : stability > run->choice.method->limiting_h_rho || slower || run->choice.n_opposing_steps < 0 /* waits */;
    run->choice.n_opposing_steps = against ? run->choice.n_opposing_steps + 1 : 0;
    run->choice.steps_since_change++;
    if (run->choice.n_opposing_steps == 1)
        run->choice.opposing_length = run->step.h;
    const int n_needed = stiff ? run->choice.return_steps : run->choice.max_opposing_steps;
    if (!run->choice.automatic || run->choice.n_opposing_steps < n_needed)
        return;
    if (stiff && has_films() && run->control.h > MAX_OPPOSING_GROWTH * run->choice.opposing_length) {
        run->choice.n_opposing_steps = 0; /* its steps still grow, as after the start: their stiffness will show */
        return;
    }
    const int is_estimated = stiff || run->choice.method->controls_length;
    const double rate = is_estimated ? estimate_largest_rate(run, p) : 0.0;
    if (stiff ? rate * run->control.h < MAX_EXPLICIT_STABILITY : is_limited_by_stability(run, rate))
        change_method(run);
    else
        run->choice.n_opposing_steps = stiff ? -RECONSIDER_STEPS
            : -(int)min_of(MAX_RECONSIDER_STEPS, max_of(RECONSIDER_STEPS, run->choice.steps_since_change));
    run->choice.rho = rate;
}

/* Return the order of a step's error in its length: that of its method, or the lower first_step_order of an onset. */
static double compute_error_order(const Integrator *run, const Step *step)
{
    const double order = 1.0 / step->method->power;
    return run->control.stored_first_length && run->control.first_step_order > 0.0
        ? min_of(run->control.first_step_order, order)
                                                                     : order;
}

/* Return x^n for x > 0 with a relative error of 1e-4, which is enough for step lengths. */
static double approximate_power(double x, double n) { return approx_exp2(n * approx_log2(x)); }

/* Return the error norm of a step, at least MIN_ERROR, so that a length can be computed from it. */
static double get_bounded_error(const Step *step) { return max_of(MIN_ERROR, step->error); }

/*
 * Return the factor SAFETY e^(-1/k), clipped to MIN_SHRINK..MAX_SHRINK, from the length of a rejected step to that of
 * the next attempt; its error e is proportional to h^k. If length and error fell since an attempt rejected before, both
 * give k = log(e'/e) / log(h'/h), between MIN_INFERRED_ORDER and 1/power. Otherwise k is compute_error_order(). The
 * rejected length, its error and its end are stored in the run.
 */
static double compute_shrink_factor(Integrator *run, const Step *step)
{
    Attempt *attempt = &run->control.attempt;
    double order = compute_error_order(run, step);
    if (attempt->rejected_h > attempt->h && isfinite(attempt->error) && attempt->error > step->error)
        order = min_of(1.0 / step->method->power,
            max_of(MIN_INFERRED_ORDER, log(attempt->error / step->error) / log(attempt->rejected_h / attempt->h)));
    attempt->rejected_h = attempt->h;
    attempt->error = step->error;
    run->control.rejected_length = attempt->h;
    run->control.rejected_end = run->t + attempt->h;
    return min_of(MAX_SHRINK, max_of(MIN_SHRINK, SAFETY * approximate_power(step->error, -1.0 / order)));
}

/*
 * Store the length that would have fitted for the first step after an event, for the next event of the same kind. Does
 * nothing if the step is not a first one. After an onset the allowed error of straight motion is stored too. The mark
 * of a first step (control.stored_first_length) is then cleared.
 */
static void record_first_step_length(Integrator *run, const Step *step)
{
    if (!run->control.stored_first_length)
        return;
    const double safe = run->control.first_step_order > 0.0 ? SAFETY_ONSET : SAFETY;
    const double fits = safe * approximate_power(get_bounded_error(step), -1.0 / compute_error_order(run, step));
    *run->control.stored_first_length = step->h * min_of(MAX_GROWTH_FIRST, max_of(MIN_GROWTH, fits));
    if (run->control.first_step_order > 0.0 && run->control.onset_error_per_s > 0.0)
        run->control.onset[!!step->method->stiff] = run->control.onset_error_per_s
            * approximate_power(*run->control.stored_first_length, run->control.first_step_order - 1.0);
    run->control.stored_first_length = NULL;
}

/*
 * Update the order of error growth seen in rejected attempts, by which the next step may grow: log(e'/e) / log(h'/h) of
 * the rejected (') and the accepted length h and error e, at most MAX_INFERRED_ORDER. In stiff motion that order can be
 * far higher than the method's. was_rejected: whether an attempt at this step was rejected, which then updates the
 * stored order. The order decays by ORDER_DECAY with each step.
 */
static void update_observed_order(Integrator *run, const Step *step, int was_rejected)
{
    const Attempt *attempt = &run->control.attempt;
    if (was_rejected && attempt->rejected_h > step->h && isfinite(attempt->error) && attempt->error > step->error)
        run->control.observed_order = min_of(MAX_INFERRED_ORDER,
            log(attempt->error / get_bounded_error(step)) / log(attempt->rejected_h / step->h));
    run->control.observed_order *= ORDER_DECAY;
}

/*
 * Set the length run->control.h of the next step after an accepted one, by the PI controller and its limits; store its
 * error and, after an event, its length. was_rejected: whether an attempt at this step was rejected; the length then
 * does not grow. is_full_length: whether the step ended before the end of the run; otherwise a small error does not
 * shorten the next step. Soon after a return to the explicit method, the rate rho estimated then limits the length too.
 * Methods that control their length only get its largest value.
 */
static void choose_next_length(Integrator *run, const Step *step, int was_rejected, int is_full_length)
{
    if (step->method->controls_length) { /* up to the largest length of the next attempt */
        run->control.h = was_rejected ? step->h : get_max_attempt_length(run);
        return;
    }
    const double error = get_bounded_error(step);
    const double known = run->choice.steps_since_change <= MIN_RETURN_STEPS ? run->choice.rho * step->h : 0.0;
    update_observed_order(run, step, was_rejected);
    double factor = compute_length_ratio(error, run->control.error_before, max_of(run->choice.h_rho, known),
        run->control.observed_order, step->method->power, step->method->limiting_h_rho);
    const double max_factor = was_rejected ? 1.0 /* [1] */ : step->has_zero_bracket ? MAX_GROWTH_EVENTS : MAX_GROWTH;
    factor = min_of(max_factor, max_of(MIN_GROWTH, factor));
    run->control.error_before = max_of(MIN_LAST_ERROR, error);
    record_first_step_length(run, step);
    if (step->h * factor > run->control.h || (is_full_length && run->roots.suppressed_switch < 0) || factor < 1.0)
        run->control.h = step->h * factor;
}

/*
 * Return the step length h (s), shortened to end just after the separation of a closed compliant contact if h would
 * reach beyond. The force is not smooth there. The time to separation is estimated by delta/|deltadot|. A separation in
 * the first MIN_SEPARATION_FRACTION of h does not shorten it.
 */
static double limit_length_by_separation(const Integrator *run, double h)
{
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Clearance *joint = &run->rhs.clearance[i];
        const double left = SEPARATION_MARGIN * joint->delta / -joint->deltadot;
        if (is_compliant(i) && run->discrete.contact[i].closed && joint->deltadot < 0.0 && left < h
            && left > MIN_SEPARATION_FRACTION * h)
            h = left;
    }
    return h;
}

/*
 * Return the step length h (s), limited to MAX_FLIGHTS times the time in which a journal that leaves the wall crosses
 * its bearing. Applies to open compliant contacts whose gap grows.
 */
static double limit_length_by_flight(const Integrator *run, double h, const Parameters *p)
{
    for (int i = 0; i < N_CLEARANCES; i++) {
        const Clearance *joint = &run->rhs.clearance[i];
        if (is_compliant(i) && !run->discrete.contact[i].closed && joint->deltadot < 0.0)
            h = min_of(h, compute_flight_length(radial_clearance(p, i), joint->delta, joint->deltadot));
    }
    return h;
}

/*
 * Return the step length h (s), limited in the first step after a switching point to the length last rejected for its
 * error, up to the end of that step. A switching point of forces changes the motion little; a small estimate of such a
 * long step would be chance.
 */
static double limit_length_by_rejection(const Integrator *run, double h)
{
    const int is_limited = is_first_after_switch(run) && run->t < run->control.rejected_end;
    return is_limited ? min_of(h, run->control.rejected_length) : h;
}

/*
 * Return the length in s of a fixed step from the run's time to the next point of the grid that begins with the run.
 * end_time: set to the time at the end of that step, at most t_end. The number of passed grid points,
 * control.n_grid_steps, is updated. An event in between does not move the grid: the step after it is shorter. A step
 * repeated to end just after an event has the length control.h.
 */
static double compute_fixed_step_length(Integrator *run, double t_end, double *end_time)
{
    StepControl *control = &run->control;
    double h;
    for (;; control->n_grid_steps += 1.0) {
        *end_time =
            compute_step_end(control->fixed_steps_origin, t_end, control->fixed, control->n_grid_steps + 1.0, &h);
        if (*end_time > run->t || *end_time == t_end)
            break;
    }
    h = *end_time - run->t < h * EQUAL_LENGTH_RATIO ? *end_time - run->t : h;
    if (control->h >= h)
        return h;
    *end_time = run->t + control->h;
    return control->h;
}

/*
 * Open the attempts at the next step of a run towards t_end: set run->control.attempt with the first length to try. The
 * length is limited by contacts, flights, rejected lengths, a suppressed switching point and the end of the run. Fixed
 * steps do not freeze branches, except in scenes with jumps of drives. Without an error estimate, a branch held beyond
 * its end, as the force of a film, could grow without bound.
 */
static void open_attempt(Integrator *run, double t_end, const Parameters *p)
{
    const double left = t_end - run->t, far = max_of(min_of(fabs(t_end), MAX_RUN_SCALE_S), fabs(run->t));
    double h, end = t_end;
    if (run->control.fixed > 0.0) {
        h = compute_fixed_step_length(run, t_end, &end);
        run->discrete.is_frozen = DRIVE_IMPULSES; /* at the jump of a drive constraints have two rates */
    } else {
        h = run->roots.suppressed_switch >= 0 ? min_of(run->control.h, run->roots.suppression_length) : run->control.h;
        h = limit_length_by_flight(
            run, limit_length_by_separation(run, min_of(limit_length_by_rejection(run, h),
                compute_flight_step_limit(run, NULL, p))), p);
        h = h > left * EQUAL_LENGTH_RATIO ? left : h;
    }
    run->control.attempt = (Attempt){.h = h, .first_h = h, .remaining_time = left, .end = end, .time_magnitude = far,
        .is_open = 1, .lane_method = run->choice.method->lane_method, .film_error_norm = INFINITY};
}

/* Request another attempt of length run->control.attempt.h by the method that the run now has. Return 0: rejected. */
static int request_retry(Integrator *run)
{
    run->control.attempt.lane_method = run->choice.method->lane_method;
    return 0;
}

/*
 * Accept the tried step, whose computation returned `trial_status`, or request another attempt. Events are not
 * regarded. Return whether the step is accepted.
 * Checked are its error norm, film forces, stability, long flights, events unresolved by the stages, and missed
 * transients. If it is accepted, run->control.h is the length of the next step, or *status the cause of a failure. If
 * not, run->control.attempt holds the next attempt, maybe by another method. Fixed steps are always accepted, except to
 * repeat one without frozen branches.
 */
static int accept_or_retry_step(Integrator *run, int trial_status, const Parameters *p, Step *step, int *status)
{
    const Method *method = step->method;
    Attempt *attempt = &run->control.attempt;
    const int is_fixed = run->control.fixed > 0.0;
    *status = trial_status;
    if (N_SWITCHES > 0 && is_fixed && trial_status == NOT_FINITE && run->discrete.is_frozen) {
        /* until the step is committed: a frozen branch may be NaN beyond its switching point */
        run->discrete.is_frozen = 0;
        return request_retry(run);
    }
    if (is_fixed && !trial_status)
        (void)is_step_unresolved(run, step, p); /* stores the samples in which events are searched */
    if (trial_status == STOPPED || is_fixed)
        return 1;
    const int is_within_tolerance = !trial_status && step->error <= run->control.max_accepted_error;
    const double end_error = is_within_tolerance ? estimate_film_error_at_ends(run, step, FILM_SCALE_FRACTION) : 0.0;
    if (is_within_tolerance && !can_skip_film_error(run, step, end_error)) {
        const double error = measure_film_error(run, step, p);
        if (!(error > FILM_ERROR_RATIO * attempt->film_error_norm)) /* not rounding */
            step->error = max_of(step->error, error);
        attempt->film_error_norm = error > run->control.max_accepted_error ? error : INFINITY;
    }
    const int is_accurate = !trial_status && step->error <= run->control.max_accepted_error;
    const double min_length = MIN_STEP_FRACTION * attempt->time_magnitude;
    if (is_accurate && !method->stiff && run->choice.h_rho > method->rejected_h_rho) {
        count_rejected_step(run);
        if (run->choice.automatic && !attempt->methods_failed
            && ++run->choice.n_unstable_steps >= run->choice.max_opposing_steps)
            change_method(run);
        else
            attempt->h *= method->limiting_h_rho / run->choice.h_rho;
        return request_retry(run);
    }
    if (is_accurate && FLIGHT_STEP_SLACK * compute_flight_step_limit(run, step, p) < attempt->h) {
        attempt->was_rejected = 1;
        count_rejected_step(run);
        attempt->h *= SHRINK_FLIGHT_STEP;
        return request_retry(run);
    }
    const int unresolved = is_accurate && is_step_unresolved(run, step, p);
    if (is_accurate && (unresolved || has_unresolved_film_force(run, step, end_error))
        && attempt->n_shortened++ < MAX_REDUCTIONS) {
        attempt->was_rejected = 1;
        count_rejected_step(run);
        attempt->h *= SHRINK_UNRESOLVED;
        return request_retry(run);
    }
    const double transient = is_accurate && attempt->h > MIN_TRANSIENT_FRACTION * attempt->time_magnitude
        ? find_missed_transient(run, step, p) : 0.0;
    if (transient > 0.0 && attempt->n_shortened++ < MAX_REDUCTIONS) {
        attempt->was_rejected = 1;
        count_rejected_step(run);
        attempt->h *= max_of(SHRINK_UNRESOLVED, TRANSIENT_PART * transient);
        return request_retry(run);
    }
    if (is_accurate) {
        choose_next_length(run, step, attempt->was_rejected, attempt->h < attempt->remaining_time);
        const int is_short = attempt->h < SHORT_STEP_FRACTION * attempt->time_magnitude;
        *status = detect_short_step_stall(run, is_short) ? diagnose_stall(run, TOO_SMALL, p) : 0;
        return 1;
    }
    attempt->was_rejected = 1;
    count_rejected_step(run);
    attempt->h *= trial_status == NOT_FOUND ? SHRINK_NEWTON : trial_status ? SHRINK_FAILED
        : compute_shrink_factor(run, step);
    if (attempt->h > min_length)
        return request_retry(run);
    if (N_SWITCHES > 0 && trial_status == NOT_FINITE && run->discrete.is_frozen) {
        run->discrete.is_frozen = 0;
        attempt->h = attempt->first_h;
        return request_retry(run);
    }
    if (!run->choice.automatic || !method->stiff || attempt->methods_failed++) {
        *status = trial_status ? trial_status : diagnose_stall(run, TOO_SMALL, p);
        return 1;
    }
    change_method(run); /* its matrix is singular with dependent constraints; the explicit method can continue */
    attempt->h = attempt->first_h;
    return request_retry(run);
}

/*
 * Compute one attempt at a step of length run->control.attempt.h by the run's method, into `step`. Return 0 or the
 * status; the error is not tested here. Near a singular position it is computed again with other policies
 * (update_singular_policy()).
 */
static int try_step(Integrator *run, const Parameters *p, Step *step)
{
    step->method = run->choice.method;
    step->stages_lane = NULL;
    int status;
    for (select_singular_policy(run);
         update_singular_policy(run, status = run->choice.method->try(run, run->control.attempt.h, p, step));)
        ;
    return status;
}

/* Close the attempts at a step after one of them was accepted. */
static void close_attempt(Integrator *run) { run->control.attempt.is_open = 0; }

/*
 * Try steps (shorter, or by another method) until one is accepted or fails, and close the attempts. Return 0 or the
 * status.
 */
static int find_accepted_step(Integrator *run, const Parameters *p, Step *step)
{
    int status;
    while (!accept_or_retry_step(run, try_step(run, p, step), p, step, &status))
        ;
    close_attempt(run);
    return status;
}
