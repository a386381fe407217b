/* No friction that may stick: a step never ends early. */
static double friction_event(Run *run, double h, const Parameters *p, const Trial *trial)
{
    (void)run, (void)h, (void)p, (void)trial;
    return 1.0;
}
