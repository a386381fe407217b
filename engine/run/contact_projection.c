/* Projection of closed contacts of rigid surfaces onto the gap zero, delta = 0. */
/*
 * Project positions onto delta = -gap (m, of each listed contact) and velocities of closed contacts onto deltadot = 0.
 * The change of the state y is the smallest in the norm of the mass matrix. Return 0 or the status of the motion.
 */
static int project_contacts(
    Integrator *run, double t, double *y, const Parameters *p, Delassus *contacts, const double *gap)
{
    unsigned char closed[N_RIGID];
    DiscreteState now = run->discrete;
    disable_friction(&now);
    for (int k = 0; k < contacts->n; k++) {
        ContactState *contact = &now.contact[contacts->joint[k]];
        closed[k] = (unsigned char)contact->closed;
        contact->closed = 1; /* closed: so that a contact force acts in it */
    }
    for (int pass = 0; pass < 3; pass++) {
        double dy[N_Y], depth[N_RIGID], rate[N_RIGID], x[N_RIGID], u[N_RIGID], worst = 0.0;
        RhsOutputs rhs;
        int status = compute_delassus(motion_with_inner_states, N_Y, t, y, &now, p, contacts);
        if (!status)
            status = motion_with_inner_states(t, y, &now, p, dy, &rhs);
        count_evaluations(run, contacts->n + 2);
        if (status)
            return status;
        for (int k = 0; k < contacts->n; k++) {
            const Clearance *joint = &rhs.clearance[contacts->joint[k]];
            depth[k] = joint->delta + gap[k];
            rate[k] = closed[k] ? joint->deltadot : 0.0;
            worst = max_of(worst, fabs(depth[k]) / radial_clearance(p, contacts->joint[k]));
        }
        solve_part(contacts, NULL, depth, x);
        solve_part(contacts, closed, rate, u);
        for (int k = 0; k < contacts->n; k++)
            for (int i = 0; i < N_X; i++) {
                y[i] += contacts->way[k][N_X + i] * x[k];
                y[N_X + i] += contacts->way[k][N_X + i] * u[k];
            }
        if (worst < 1e-14)
            break;
    }
    return 0;
}

/* Project a state y onto delta = 0 and deltadot = 0 of all closed contacts. */
static void project_closed_contacts(Integrator *run, double t, double *y, const Parameters *p)
{
    const double none[N_RIGID] = {0.0};
    Delassus contacts;
    contacts.n = list_closed(&run->discrete, contacts.joint);
    if (contacts.n)
        (void)project_contacts(run, t, y, p, &contacts, none);
}
