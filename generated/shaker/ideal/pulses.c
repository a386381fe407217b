/* Steps that jump over a pulse: terms of time alone that act between stages (time_terms.c). */
static double missed_pulse(const Run *run, const Step *step, const Parameters *p)
{
    (void)run, (void)step, (void)p;
    return 0.0;
}

