/* Step control: lengths against the formulas at the head of methods/step_length.c. */
#include "part.h"

static Integrator run;
static Step step;

/* An accepted step of length 1 with this error after one with the error `before`: the ratio of the next length. */
static double growth(double error, double before)
{
    start_step_control(&run, 0.0);
    run.control.error_before = before;
    step.h = run.control.h = 1.0;
    step.error = error;
    choose_next_length(&run, &step, 0, 1);
    return run.control.h;
}

/* A refused step of length h with this error: the share to try next. */
static double shrinks_to(double h, double error)
{
    run.control.attempt.h = h;
    step.error = error;
    return compute_shrink_factor(&run, &step);
}

int main(void)
{
    set_method_choice(&run, gudgeon_method("dop853"), 0);
    initialize_root_finding(&run);
    step.method = run.choice.method;
    const double power = step.method->power;

    /* the PI controller, within its limits, and at them */
    CHECK(CLOSE(growth(0.5, 0.1), 0.9 * pow(0.5, -0.8 * power) * pow(0.1, 0.2 * power), 1e-3));
    CHECK(CLOSE(growth(1.0, 1.0), 0.9, 1e-3));
    CHECK(growth(1e-30, 1.0) == MAX_GROWTH);
    CHECK(run.control.error_before == MIN_LAST_ERROR);
    step.has_zero_bracket = 1;
    CHECK(growth(1e-30, 1.0) == MAX_GROWTH_EVENTS);
    step.has_zero_bracket = 0;

    /* stability bounds an explicit step */
    store_stiffness_estimate(&run, 2.0 * step.method->limiting_h_rho);
    CHECK(CLOSE(growth(1e-6, 1e-4), 0.5 * STABLE_GROWTH, 1e-12));
    store_stiffness_estimate(&run, 0.0);

    /* where errors are h^(1/power), lengths converge to the fixed point of the formula: 0.9 e^(-0.6 power) = 1 */
    double h = 0.1;
    start_step_control(&run, 0.0);
    for (int k = 0; k < 100; k++) {
        step.h = run.control.h = h;
        step.error = pow(h, 1.0 / power);
        choose_next_length(&run, &step, 0, 1);
        h = run.control.h;
    }
    CHECK(CLOSE(pow(h, 1.0 / power), pow(0.9, 1.0 / (0.6 * power)), 1e-2));

    /* a refused step: by the method's order, then by the order 3 that the errors of two of them show */
    run.control.attempt = (Attempt){.h = 1.0};
    CHECK(CLOSE(shrinks_to(1.0, 100.0), 0.9 * pow(100.0, -power), 1e-3));
    CHECK(CLOSE(shrinks_to(0.5, 12.5), 0.9 * pow(12.5, -1.0 / 3.0), 1e-3));
    run.control.attempt = (Attempt){.h = 1.0};
    CHECK(shrinks_to(1.0, 1e30) == MIN_SHRINK);
    run.control.attempt = (Attempt){.h = 1.0};
    CHECK(shrinks_to(1.0, 0.9) == MAX_SHRINK);

    /* fixed lengths: the last step ends where the run does */
    start_step_control(&run, 0.3);
    CHECK(!(1e300 > run.control.max_accepted_error));
    run.t = 0.0;
    open_attempt(&run, 1.0, &(Parameters){.radius = 1.0});
    CHECK(run.control.attempt.h == 0.3 && run.control.attempt.is_open);
    run.t = 0.4; /* behind an event: to the end of the grid */
    open_attempt(&run, 1.0, &(Parameters){.radius = 1.0});
    CHECK(CLOSE(run.control.attempt.h, 0.2, 1e-15) && run.control.attempt.end == 0.6);
    run.t = 0.9;
    open_attempt(&run, 1.0, &(Parameters){.radius = 1.0});
    CHECK(CLOSE(run.control.attempt.h, 1.0 - run.t, 1e-15) && run.control.attempt.end == 1.0);
    close_attempt(&run);
    CHECK(!run.control.attempt.is_open);

    /* the length that fits after an event is kept in its place, and begins the next such step */
    double *known = &run.control.after_contact[1][0];
    start_step_control(&run, 0.0);
    set_next_step_length(&run, 1.0);
    set_first_step(&run, known, 0.0);
    CHECK(run.control.h == 1.0);
    step.h = 0.1;
    step.error = 1.0;
    choose_next_length(&run, &step, 0, 1);
    CHECK(CLOSE(*known, 0.09, 1e-4));
    set_next_step_length(&run, 1.0);
    set_first_step(&run, known, 0.0);
    CHECK(run.control.h == *known);
    return failures;
}
