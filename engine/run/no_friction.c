/* No friction that may stick. */
#define AT_REST 0.0
enum { HELD = 2 };

static double indicator(const Memory *memory, const Aside *aside, int i)
{
    (void)memory, (void)aside, (void)i;
    return 1.0;
}

static int rates_at_rest(Run *run, double t, double *y, const Parameters *p, double *dy, Aside *aside)
{
    return rates(run, t, y, p, dy, aside);
}

static void hold_slips(Run *run, double t, double *y, const Parameters *p) { (void)run, (void)t, (void)y, (void)p; }

static int switch_friction(Run *run, const Parameters *p)
{
    (void)run, (void)p;
    return 0;
}

static int begin_friction(Run *run, const Parameters *p)
{
    (void)run, (void)p;
    return 0;
}

#if N_RIGID
static int settle_friction(Run *run, const Parameters *p)
{
    (void)run, (void)p;
    return 0;
}

static int slip_after_blow(Run *run, const Parameters *p)
{
    (void)run, (void)p;
    return 0;
}
#endif
