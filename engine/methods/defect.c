/*
 * Defect of the dense output: by how much the interpolant of a step fails the equations of motion between its ends.
 */

/*
 * Rates of the interpolant at fraction theta of a step, whose coefficients are made: of the nested polynomial
 * y0 + w0 (d0 + w1 (d1 + ...)), each w being theta or 1 - theta, and of its derivative by Horner's scheme.
 */
static void interpolate_rates(const Step *step, double theta, double *dy)
{
    const Method *method = step->method;
    for (int i = 0; i < N_Y; i++) {
        double value = 0.0, slope = 0.0;
        for (int k = method->degree - 1; k >= 0; k--) {
            const int turned = method->turned >> k & 1;
            const double sum = step->dense[k][i] + value, w = turned ? 1.0 - theta : theta;
            slope = w * slope + (turned ? -sum : sum);
            value = w * sum;
        }
        dy[i] = slope / step->h;
    }
}
