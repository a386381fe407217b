/* The choice between the explicit method and the stiff one: how many steps lead to a change. */
#include "part.h"

static Integrator run;

/* Steps with this h rho until the method is another one; 0: it is not within `most`. */
static int steps_to_change(double stability, int most)
{
    const Method *method = run.choice.method;
    for (int k = 1; k <= most; k++) {
        store_stiffness_estimate(&run, stability);
        switch_method_after_step(&run, NULL);
        if (run.choice.method != method)
            return k;
    }
    return 0;
}

int main(void)
{
    const int explicit = gudgeon_method("dop853"), stiff = gudgeon_method("rodas5p");
    const double beyond = 2.0 * METHODS[explicit]->limiting_h_rho, below = 0.5 * MAX_EXPLICIT_STABILITY;

    set_method_choice(&run, explicit, 0);
    CHECK(steps_to_change(beyond, 1000) == 0); /* it may not change */

    set_method_choice(&run, explicit, stiff);
    CHECK(steps_to_change(below, 1000) == 0);
    CHECK(steps_to_change(beyond, 1000) == MAX_OPPOSING_STEPS);
    CHECK(run.choice.method == METHODS[stiff]);

    /* a step of the other kind in between begins the count anew */
    CHECK(steps_to_change(below, MIN_RETURN_STEPS - 1) == 0);
    CHECK(steps_to_change(2.0 * MAX_EXPLICIT_STABILITY, 1) == 0);
    CHECK(steps_to_change(below, 1000) == MIN_RETURN_STEPS);

    /* a return that did not last makes the next one twice as hard, up to a limit */
    for (int return_steps = 2 * MIN_RETURN_STEPS; return_steps <= MAX_RETURN_STEPS; return_steps *= 2) {
        CHECK(steps_to_change(beyond, 1000) == MAX_OPPOSING_STEPS);
        CHECK(steps_to_change(below, 2 * MAX_RETURN_STEPS) == return_steps);
    }
    CHECK(steps_to_change(beyond, 1000) == MAX_OPPOSING_STEPS);
    CHECK(steps_to_change(below, 2 * MAX_RETURN_STEPS) == MAX_RETURN_STEPS);

    /* one that lasted makes it as easy as the first */
    CHECK(steps_to_change(below, LASTING_STEPS) == 0);
    CHECK(steps_to_change(beyond, 1000) == MAX_OPPOSING_STEPS);
    CHECK(steps_to_change(below, 1000) == MIN_RETURN_STEPS);

    /* explicit steps that are too short beside the stiff ones from before lead back as well */
    run.control.h_stiff = 1.0;
    run.control.h = 0.5 * STIFF_LENGTH_RATIO;
    CHECK(steps_to_change(below, 1000) == MIN_COMPARE_STEPS + 1 + MAX_OPPOSING_STEPS);
    return failures;
}
