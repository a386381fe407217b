/* Stage predictor: states and rates at the starts of this step and the previous one, for guesses of implicit stages. */
#ifndef GUDGEON_ITERATION_HISTORY_H
#define GUDGEON_ITERATION_HISTORY_H

#define FILM_FORCE_TOL 5e2 /* times rtol: relative accuracy of film forces when the iteration of stages ends */

/*
 * Update the stage predictor of a run before a step is tried: the stored starts of this step and of the previous one,
 * from which first guesses of the stages are extrapolated. At a new step the current start becomes the previous one; a
 * repeated attempt leaves both unchanged.
 *
 * Also set their distance last_h (s; 0 unless the last step was stored), the accuracy of film forces film_force_tol,
 * and can_extrapolate: whether last_h > 0 and no attempt at this step was rejected.
 */
static inline void update_stage_predictor(Integrator *run)
{
    StepStart *current = &run->newton.current_start;
    if (run->newton.n_recorded_steps != run->counts.steps || current->t != run->t) {
        const int is_next_step = run->newton.n_recorded_steps == run->counts.steps - 1 && run->counts.steps > 0;
        run->newton.previous_t = is_next_step ? current->t : run->t;
        for (int i = 0; i < N_Y; i++) {
            run->newton.previous_y[i] = current->y[i];
            run->newton.previous_dy[i] = current->dy[i];
            current->y[i] = run->y[i];
            current->dy[i] = run->dy[i];
        }
        current->t = run->t;
        run->newton.n_recorded_steps = run->counts.steps;
    }
    run->newton.last_h = run->t - run->newton.previous_t;
    run->newton.film_force_tol = min_of(1e-2, FILM_FORCE_TOL / run->norm.inverse_scale[2 * N_X - 1]);
    run->newton.can_extrapolate = run->newton.last_h > 0.0 && !run->control.attempt.was_rejected;
}

#endif
