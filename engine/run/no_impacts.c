/* All surfaces give: penetration says where contacts begin and end. */
static double contact_margin(const Memory *memory, const Aside *aside, int i)
{
    return memory->latch[i].closed ? aside->clearance[i].delta : -aside->clearance[i].delta;
}

static void hold_contacts(Run *run, double t, double *y, const Parameters *p) { (void)run, (void)t, (void)y, (void)p; }

static double stride(const Run *run, const Step *step, const Parameters *p)
{
    return (void)run, (void)step, (void)p, INFINITY;
}

static int what_ends(const Run *run, int otherwise, const Parameters *p) { return (void)run, (void)p, otherwise; }

static int used_up(const Run *run) { return (void)run, -1; }

static int meet(Run *run, int event, const Parameters *p)
{
    (void)run, (void)event, (void)p;
    return 0;
}

static int begin_contacts(Run *run, const Parameters *p)
{
    (void)run, (void)p;
    return 0;
}
