/* Contacts: their begins and ends on straight lines and parabolas, their list and its fetching, their peaks. */
#include "part.h"

static Integrator run;
static const Parameters p = {.radius = 1.0};

/* The joint touches, or lets go, at time t with the rate deltadot. */
static void changes(double t, double deltadot)
{
    run.t = t;
    run.rhs.clearance[0].deltadot = deltadot;
    toggle_contact(&run, 0, min_approach_speed(&p, 0));
}

static void begins_and_ends(void)
{
    const Contacts *contacts = &run.contacts;
    changes(2.0, 1.0);
    CHECK(run.discrete.contact[0].closed && contacts->ongoing[0].t_on == 2.0 && contacts->ongoing[0].deltadot == 1.0);
    CHECK(contacts->onsets == 1 && contacts->is_compressing[0]);
    update_compression(&run, 0, -1.0);
    CHECK(!contacts->is_compressing[0]);
    changes(7.5, -2.0);
    CHECK(!run.discrete.contact[0].closed && contacts->n_records == 1);
    CHECK(contacts->records[0].t_on == 2.0 && contacts->records[0].t_off == 7.5);

    /* the rate of an onset is at least the floor of the law */
    changes(8.0, 1e-9);
    CHECK(contacts->ongoing[0].deltadot == min_approach_speed(&p, 0));

    /* a run that begins deep in its wall is in contact, and one that begins beside it is free */
    run.discrete.contact[0].closed = 0;
    run.rhs.clearance[0] = (Clearance){.delta = 0.5, .deltadot = -3.0};
    CHECK(initialize_compliant_contacts(&run, &p) && run.discrete.contact[0].closed
        && contacts->ongoing[0].deltadot == 3.0);
    run.rhs.clearance[0].delta = -0.5;
    CHECK(initialize_compliant_contacts(&run, &p) && !run.discrete.contact[0].closed
        && !initialize_compliant_contacts(&run, &p));
    run.contacts.n_records = 1;
    changes(8.0, 1.0);
}

static void peaks(void)
{
    double height;
    CHECK(find_cubic_maximum(0.0, 1.0, 0.0, -1.0, &height) == 0.5 && CLOSE(height, 0.25, 1e-16)); /* s (1 - s) */
    update_peak_force(&run, 0, 1.0, 5.0);
    update_peak_force(&run, 0, 2.0, 4.0);
    CHECK(run.contacts.F_peak[0] == 5.0 && run.contacts.t_peak[0] == 1.0);
    update_contact_peak_force(&run, 0, 2.0, 4.0);
    CHECK(run.contacts.ongoing[0].F_peak == 4.0 && run.contacts.ongoing[0].t_peak == 2.0);

    /* deltadot/deltadot_minus of a contact that lasts, outside of [-1, 1] once */
    run.discrete.contact[0].deltadot_minus = 2.0;
    run.rhs.clearance[0] = (Clearance){.F_n = 3.0, .F_t = 4.0, .e = 0.5, .deltadot = 1.0};
    update_joint_peaks(&run, 0);
    run.rhs.clearance[0].deltadot = -3.0;
    update_joint_peaks(&run, 0);
    CHECK(run.contacts.ratio_max == 0.5 && run.contacts.ratio_min == -1.5 && run.contacts.ratio_outside == 1.0);
    CHECK(run.contacts.ongoing[0].F_peak == 5.0 && run.contacts.e_max[0] == 0.5);
}

static void lists(void)
{
    double numbers[N_IMPACT_COLUMNS * (LISTED_IMPACTS + 1)];
    int joints[LISTED_IMPACTS + 1];
    update_peak_force(&run, 0, 3.25, 9.0);
    update_largest_eccentricity(&run, 0, 0.75);
    CHECK(!append_contact(&run, &(ContactRecord){3.0, 3.5, 1.0, 9.0, 3.25, 0}));
    CHECK(run.contacts.n_records == 2 && run.contacts.F_peak[0] == 9.0 && run.contacts.e_max[0] == 0.75);
    CHECK(gudgeon_run_impacts(&run, 0, 1, numbers, joints) == 1); /* the oldest first */
    CHECK(CLOSE(numbers[IMPACT_t_off], 7.5, 1e-14) && run.contacts.n_records == 1);
    CHECK(gudgeon_run_impacts(&run, 1, 10, numbers, joints) == 2); /* with the one that lasts, once */
    CHECK(numbers[IMPACT_F_peak] == 9.0 && isnan(numbers[N_IMPACT_COLUMNS + IMPACT_t_off]));
    CHECK(gudgeon_run_impacts(&run, 1, 10, numbers, joints) == 0);

    /* an impulse is added to the last one of the same joint at the same time */
    const ContactRecord bounce = {run.t, run.t, 1.0, 2.0, run.t, 0};
    CHECK(!append_impact(&run, &bounce, 0, 1) && !append_impact(&run, &bounce, 1, 0));
    CHECK(run.contacts.n_records == 1 && run.contacts.records[0].F_peak == 4.0);
    while (run.contacts.n_records < LISTED_IMPACTS)
        CHECK(!append_contact(&run, &bounce));
    CHECK(has_full_buffers(&run) && append_contact(&run, &bounce) == CHATTERING
        && run.contacts.n_records == LISTED_IMPACTS);
}

int main(void)
{
    const double latched[N_DISCRETE] = {NAN};
    initialize_contacts(&run, 0.0, latched);
    CHECK(run.contacts.e_max[0] == -INFINITY && run.contacts.ratio_min == INFINITY);
    begins_and_ends();
    peaks();
    lists();
    return failures;
}
