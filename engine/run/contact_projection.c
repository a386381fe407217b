/* Projection of closed contacts of rigid surfaces onto the gap zero, delta = 0. */
/*
 * Project positions of the listed contacts onto delta = -gap, and velocities of those that are closed onto deltadot =
 * 0, by at most three Newton steps. contacts: lists the joints, its Delassus operator is overwritten; gaps: distance of
 * each listed contact, m.
 *
 * The change of the state y is the smallest in the norm of the mass matrix. Friction is switched off. Return 0 or the
 * status of the motion; y may then be changed in part. Called after impacts and when states of the dense output are
 * projected.
 */
static int project_contacts(
    Integrator *run, double t, double *y, const Parameters *p, Delassus *contacts, const double *gaps)
{
    unsigned char closed[N_RIGID];
    DiscreteState discrete = run->discrete;
    disable_friction(&discrete);
    for (int k = 0; k < contacts->n; k++) {
        ContactState *contact = &discrete.contact[contacts->joint[k]];
        closed[k] = (unsigned char)contact->closed;
        contact->closed = 1; /* closed: so that a contact force acts in it */
    }
    for (int pass = 0; pass < 3; pass++) {
        double dy[N_Y], depth[N_RIGID], rate[N_RIGID], x[N_RIGID], u[N_RIGID], largest_ratio = 0.0;
        RhsOutputs rhs;
        int status = compute_delassus(evaluate_motion_with_internal_states, N_Y, t, y, &discrete, p, contacts);
        if (!status)
            status = evaluate_motion_with_internal_states(t, y, &discrete, p, dy, &rhs);
        count_evaluations(run, contacts->n + 2);
        if (status)
            return status;
        for (int k = 0; k < contacts->n; k++) {
            const Clearance *joint = &rhs.clearance[contacts->joint[k]];
            depth[k] = joint->delta + gaps[k];
            rate[k] = closed[k] ? joint->deltadot : 0.0;
            largest_ratio = max_of(largest_ratio, fabs(depth[k]) / radial_clearance(p, contacts->joint[k]));
        }
        solve_contact_subset(contacts, NULL, depth, x);
        solve_contact_subset(contacts, closed, rate, u);
        for (int k = 0; k < contacts->n; k++)
            for (int i = 0; i < N_X; i++) {
                y[i] += contacts->response[k][N_X + i] * x[k];
                y[N_X + i] += contacts->response[k][N_X + i] * u[k];
            }
        if (largest_ratio < 1e-14)
            break;
    }
    return 0;
}

/*
 * Project a state y at time t in place onto delta = 0 and deltadot = 0 of all closed rigid contacts. Without closed
 * contacts y stays. A failure is ignored.
 */
static void project_closed_contacts(Integrator *run, double t, double *y, const Parameters *p)
{
    const double zero_gap[N_RIGID] = {0.0};
    Delassus contacts;
    contacts.n = list_closed_contacts(&run->discrete, contacts.joint);
    if (contacts.n)
        (void)project_contacts(run, t, y, p, &contacts, zero_gap);
}
