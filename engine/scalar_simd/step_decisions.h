/*
 * Decisions about a tried step that one run and runs in lanes make by the same operations: the length of the next step,
 * and bounds that exclude a contact inside the step. The constants are those of methods/step_length.c, watch/gaps.c and
 * run/peaks.c, which use this text for one run.
 */
#define SAFETY 0.9              /* [1] */
#define ERROR_EXPONENT 0.8      /* integral gain 0.6 + proportional gain 0.2 */
#define LAST_ERROR_EXPONENT 0.2 /* proportional gain */
#define MIN_LAST_ERROR 1e-4     /* tolerances: e' is at least as large, also before the first step [1] */
#define MIN_ERROR 1e-12         /* tolerances: e is at least as large */
#define MIN_GROWTH 0.3          /* smallest ratio of the lengths of two accepted steps; 0.333 in [1] */
#define MAX_GROWTH 6.0          /* largest ratio [1] */
#define STABLE_GROWTH 1.1       /* largest ratio of the next length to the longest stable one */
#define ORDER_DECAY 0.95        /* factor on the observed order of error growth after each step */
#define MEAN_LENGTH_WEIGHT 0.8       /* weight of the mean length of the steps before the last one */
#define MAX_FLIGHTS 2.0    /* of the time in which a journal crosses its bearing: longest step */
#define CURVATURE_SAFETY 2.0    /* factor on the largest second derivative of a gap that neighbouring stages show */
#define QUARTER_STAGE_DISTANCE 0.125       /* w/4 for neighbouring stages at most w of a step apart */
#define MAX_SMALL_FILM_ERROR 0.02 /* of the limit: below it at the ends, the error inside is measured rarely */
#define FILM_LENGTH_RATIO 1.5    /* times the last measured step: longer steps are measured */
#define MAX_UNMEASURED_FILM_STEPS 16.0    /* steps between two measurements */
#define FORCE_AHEAD 1e-4   /* of a step: length of the motion beyond its end that shows whether a force rises */
#define FILM_PEAK_RATIO 0.97 /* of the largest force of a film so far: smaller forces are not searched for a peak */
#define MAXIMUM_RATIO 1.001  /* ratio of a stage's force to those at both ends that shows a maximum between */
#define MAXIMUM_RATIO_STIFF 1.1 /* the same for stiff methods, whose stages have larger errors */

/*
 * Return the ratio of the next length to that of an accepted step with this error (tolerances), by the PI controller.
 * For h rho > 1 it is at most STABLE_GROWTH limiting_h_rho / (h rho), and for observed_order power > 1 at
 * most SAFETY error^(-1/observed_order). error_before: error of the step before. power, limiting_h_rho: numbers of the
 * method, its exponent of the step-size control and the h rho at which stability limits its steps. Limits of the ratio
 * itself are left to the caller.
 */
static inline Real compute_length_ratio(Real error, Real error_before, Real h_rho, Real observed_order, Real power,
    Real limiting_h_rho)
{
    Real ratio = SAFETY * real_exp2(power
        * (LAST_ERROR_EXPONENT * real_log2(error_before) - ERROR_EXPONENT * real_log2(error)));
    const Mask is_limited = h_rho > 1.0, is_stiffer = observed_order * power > 1.0;
    if (any_of(is_limited))
        ratio = select_value(is_limited, real_min(ratio, STABLE_GROWTH * limiting_h_rho / h_rho), ratio);
    if (any_of(is_stiffer)) {
        const Real by_order = SAFETY * real_exp2(-1.0 / observed_order * real_log2(error));
        ratio = select_value(is_stiffer, real_min(ratio, by_order), ratio);
    }
    return ratio;
}

/* Return the mean length of the steps of a method after one of length h (s); mean <= 0: there was none. */
static inline Real update_mean_length(Real mean, Real h)
{
    return select_value(mean > 0.0, MEAN_LENGTH_WEIGHT * mean + (1.0 - MEAN_LENGTH_WEIGHT) * h, h);
}

/*
 * Return the longest step in s by the time in which a journal that leaves the wall crosses its bearing. c: radial
 * clearance, m; delta (m) and deltadot (m/s, negative): of an open contact.
 */
static inline Real compute_flight_length(Real c, Real delta, Real deltadot)
{
    return MAX_FLIGHTS * real_max(c, 2.0 * c + delta) / -deltadot;
}

/*
 * Return whether the error of film forces inside a step of length h (s) is known to be small: it was at the last
 * measurement, film_error in a step of length film_h (s) n_steps before, and it is at the ends (end_error). Errors are
 * multiples of the limit.
 */
static inline Mask is_last_film_error_valid(Real end_error, Real h, Real film_error, Real film_h, Real n_steps)
{
    return (film_error < MAX_SMALL_FILM_ERROR) & (end_error < MAX_SMALL_FILM_ERROR)
        & (h < FILM_LENGTH_RATIO * film_h) & (n_steps < MAX_UNMEASURED_FILM_STEPS);
}

/*
 * Return a lower bound (m) of the event function of a contact between its samples at beginning, stages and end of a
 * step: the smallest sample, less QUARTER_STAGE_DISTANCE h (largest - smallest rate) CURVATURE_SAFETY / 2. It is an
 * estimate, because the second derivative between samples is estimated from the range of the rates. value_begin,
 * value_end (m), rate_begin, rate_end (m/s): the event function and its rate at both ends. Those of the stages are in
 * step->min_event_value and step->gap_rate_range.
 */
static inline Real compute_gap_lower_bound(const StepOf *step, int joint, Real value_begin, Real value_end,
    Real rate_begin, Real rate_end)
{
    const Real min_rate = real_min(step->gap_rate_range[joint][0], real_min(rate_begin, rate_end)),
        max_rate = real_max(step->gap_rate_range[joint][1], real_max(rate_begin, rate_end));
    const Real smallest = real_min(step->min_event_value[joint], real_min(value_begin, value_end));
    return smallest - QUARTER_STAGE_DISTANCE * step->h * (max_rate - min_rate) * CURVATURE_SAFETY / 2.0;
}
