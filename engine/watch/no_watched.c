/* No corners of the user's expressions, and no events. */
static int is_unresolved(const Run *run, const Step *step, const Parameters *p)
{
    (void)run, (void)step, (void)p;
    return 0;
}

static void look_inside(const Run *run, const Step *step, const Parameters *p)
{
    (void)run, (void)step, (void)p;
}

static double first_look(const Run *run, const Step *step, int i, const Parameters *p, double *value)
{
    (void)run, (void)step, (void)i, (void)p;
    return *value = 0.0;
}
