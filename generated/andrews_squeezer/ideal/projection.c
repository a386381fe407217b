/*
 * The smallest dq and dv (n), measured by M, with Phi_q dq = Phi and Phi_q dv = Phi_dot, to be subtracted.
 * `worst`: the largest |Phi|. Returns 0, or the number of the pivot that vanished.
 */
static int closing_step(const double t, const double *q, const double *v, const Memory *memory, const
    Parameters *p, double *dq, double *dv, double *worst)
{
    (void)t;
    (void)memory;
    /* coordinates, velocities, time */
    const double OF_theta = q[0];
    const double OF_omega = v[0];
    const double BDE_theta = q[1];
    const double BDE_omega = v[1];
    const double AG_theta = q[2];
    const double AG_omega = v[2];
    const double AH_theta = q[3];
    const double AH_omega = v[3];
    const double FE_theta = q[4];
    const double FE_omega = v[4];
    const double HE_theta = q[5];
    const double HE_omega = v[5];
    const double EG_theta = q[6];
    const double EG_omega = v[6];

    /* parameters */
    const double B_x = p->B_x;
    const double B_y = p->B_y;
    const double A_x = p->A_x;
    const double A_y = p->A_y;
    const double OF_F_span_x = p->OF_F_span_x;
    const double BDE_E_span_x = p->BDE_E_span_x;
    const double BDE_E_span_y = p->BDE_E_span_y;
    const double FE_E_span_x = p->FE_E_span_x;
    const double EG_G_span_y = p->EG_G_span_y;
    const double AG_G_span_x = p->AG_G_span_x;
    const double AG_G_span_y = p->AG_G_span_y;
    const double HE_H_span_x = p->HE_H_span_x;
    const double AH_H_span_x = p->AH_H_span_x;
    const double AH_H_span_y = p->AH_H_span_y;
    const double inertia_OF_FE = p->inertia_OF_FE;
    const double twist_OF_EG = p->twist_OF_EG;
    const double twist_FE_EG = p->twist_FE_EG;
    const double inertia_BDE_HE = p->inertia_BDE_HE;
    const double twist_BDE_HE = p->twist_BDE_HE;
    const double mass_OF_OF = p->mass_OF_OF;
    const double mass_FE_FE = p->mass_FE_FE;
    const double mass_BDE_BDE = p->mass_BDE_BDE;
    const double inverse_mass_AG_AG = p->inverse_mass_AG_AG;
    const double inverse_mass_AH_AH = p->inverse_mass_AH_AH;
    const double inverse_mass_HE_HE = p->inverse_mass_HE_HE;
    const double inverse_mass_EG_EG = p->inverse_mass_EG_EG;

    /* directions, arms, drives */
    const Four angles_0 = {OF_theta, BDE_theta, AG_theta, AH_theta};
    Four sines_0, cosines_0;
    sines_and_cosines(&angles_0, &sines_0, &cosines_0);
    const Four angles_1 = {FE_theta, HE_theta, EG_theta, EG_theta};
    Four sines_1, cosines_1;
    sines_and_cosines(&angles_1, &sines_1, &cosines_1);
    const double cos_theta_OF = cosines_0[0];
    const double sin_theta_OF = sines_0[0];
    const double cos_theta_BDE = cosines_0[1];
    const double sin_theta_BDE = sines_0[1];
    const double cos_theta_AG = cosines_0[2];
    const double sin_theta_AG = sines_0[2];
    const double cos_theta_AH = cosines_0[3];
    const double sin_theta_AH = sines_0[3];
    const double cos_theta_FE = cosines_1[0];
    const double sin_theta_FE = sines_1[0];
    const double cos_theta_HE = cosines_1[1];
    const double sin_theta_HE = sines_1[1];
    const double cos_theta_EG = cosines_1[2];
    const double sin_theta_EG = sines_1[2];
    const double span_OF_F_x = OF_F_span_x*cos_theta_OF;
    const double span_OF_F_y = OF_F_span_x*sin_theta_OF;
    const double span_BDE_E_x = BDE_E_span_x*cos_theta_BDE - BDE_E_span_y*sin_theta_BDE;
    const double span_BDE_E_y = BDE_E_span_x*sin_theta_BDE + BDE_E_span_y*cos_theta_BDE;
    const double span_FE_E_x = FE_E_span_x*cos_theta_FE;
    const double span_FE_E_y = FE_E_span_x*sin_theta_FE;
    const double span_EG_G_x = -EG_G_span_y*sin_theta_EG;
    const double span_EG_G_y = EG_G_span_y*cos_theta_EG;
    const double span_AG_G_x = AG_G_span_x*cos_theta_AG - AG_G_span_y*sin_theta_AG;
    const double span_AG_G_y = AG_G_span_x*sin_theta_AG + AG_G_span_y*cos_theta_AG;
    const double span_HE_H_x = HE_H_span_x*cos_theta_HE;
    const double span_HE_H_y = HE_H_span_x*sin_theta_HE;
    const double span_AH_H_x = AH_H_span_x*cos_theta_AH - AH_H_span_y*sin_theta_AH;
    const double span_AH_H_y = AH_H_span_x*sin_theta_AH + AH_H_span_y*cos_theta_AH;
    const double cos_FE_less_OF = cos_theta_FE*cos_theta_OF + sin_theta_FE*sin_theta_OF;
    const double dot_OF_FE = cos_FE_less_OF*inertia_OF_FE;
    const double sin_EG_less_OF = -cos_theta_EG*sin_theta_OF + cos_theta_OF*sin_theta_EG;
    const double dot_OF_EG = -sin_EG_less_OF*twist_OF_EG;
    const double sin_EG_less_FE = -cos_theta_EG*sin_theta_FE + cos_theta_FE*sin_theta_EG;
    const double dot_FE_EG = -sin_EG_less_FE*twist_FE_EG;
    const double cos_HE_less_BDE = cos_theta_BDE*cos_theta_HE + sin_theta_BDE*sin_theta_HE;
    const double sin_HE_less_BDE = cos_theta_BDE*sin_theta_HE - cos_theta_HE*sin_theta_BDE;
    const double dot_BDE_HE = cos_HE_less_BDE*inertia_BDE_HE - sin_HE_less_BDE*twist_BDE_HE;

    /* Phi and Phi_dot */
    const double phi_G_x = -A_x - span_AG_G_x + span_EG_G_x + span_FE_E_x + span_OF_F_x;
    const double phi_dot_G_x = AG_omega*span_AG_G_y - EG_omega*span_EG_G_y - FE_omega*span_FE_E_y -
        OF_omega*span_OF_F_y;
    const double phi_G_y = -A_y - span_AG_G_y + span_EG_G_y + span_FE_E_y + span_OF_F_y;
    const double phi_dot_G_y = -AG_omega*span_AG_G_x + EG_omega*span_EG_G_x + FE_omega*span_FE_E_x +
        OF_omega*span_OF_F_x;
    const double phi_H_x = -A_x + B_x - span_AH_H_x + span_BDE_E_x + span_HE_H_x;
    const double phi_dot_H_x = AH_omega*span_AH_H_y - BDE_omega*span_BDE_E_y - HE_omega*span_HE_H_y;
    const double phi_H_y = -A_y + B_y - span_AH_H_y + span_BDE_E_y + span_HE_H_y;
    const double phi_dot_H_y = -AH_omega*span_AH_H_x + BDE_omega*span_BDE_E_x + HE_omega*span_HE_H_x;
    const double phi_E3_x = -B_x - span_BDE_E_x + span_FE_E_x + span_OF_F_x;
    const double phi_dot_E3_x = BDE_omega*span_BDE_E_y - FE_omega*span_FE_E_y - OF_omega*span_OF_F_y;
    const double phi_E3_y = -B_y - span_BDE_E_y + span_FE_E_y + span_OF_F_y;
    const double phi_dot_E3_y = -BDE_omega*span_BDE_E_x + FE_omega*span_FE_E_x + OF_omega*span_OF_F_x;

    /* L D L^T of the KKT matrix */
    const double l_G_x__AG_theta_4 = inverse_mass_AG_AG*span_AG_G_y;
    const double l_G_y__AG_theta_4 = -inverse_mass_AG_AG*span_AG_G_x;
    const double l_H_x__AH_theta_4 = inverse_mass_AH_AH*span_AH_H_y;
    const double l_H_y__AH_theta_4 = -inverse_mass_AH_AH*span_AH_H_x;
    const double l_BDE_theta__HE_theta_4 = dot_BDE_HE*inverse_mass_HE_HE;
    const double l_H_x__HE_theta_4 = -inverse_mass_HE_HE*span_HE_H_y;
    const double l_H_y__HE_theta_4 = inverse_mass_HE_HE*span_HE_H_x;
    const double inverse_pivot_BDE_theta_4 = 1.0/(-dot_BDE_HE*l_BDE_theta__HE_theta_4 + mass_BDE_BDE);
    const double w_H_x__BDE_theta_2 = -dot_BDE_HE*l_H_x__HE_theta_4 - span_BDE_E_y;
    const double l_H_x__BDE_theta_3 = inverse_pivot_BDE_theta_4*w_H_x__BDE_theta_2;
    const double w_H_y__BDE_theta_2 = -dot_BDE_HE*l_H_y__HE_theta_4 + span_BDE_E_x;
    const double l_H_y__BDE_theta_3 = inverse_pivot_BDE_theta_4*w_H_y__BDE_theta_2;
    const double l_E3_x__BDE_theta_4 = inverse_pivot_BDE_theta_4*span_BDE_E_y;
    const double l_E3_y__BDE_theta_4 = -inverse_pivot_BDE_theta_4*span_BDE_E_x;
    const double scale_H_x_4 = l_H_x__AH_theta_4*span_AH_H_y + l_H_x__BDE_theta_3*w_H_x__BDE_theta_2 -
        l_H_x__HE_theta_4*span_HE_H_y;
    const double scale_H_y_4 = -l_H_y__AH_theta_4*span_AH_H_x + l_H_y__BDE_theta_3*w_H_y__BDE_theta_2 +
        l_H_y__HE_theta_4*span_HE_H_x;
    const double pivot_H_x__H_y_3 = l_H_y__AH_theta_4*span_AH_H_y + l_H_y__BDE_theta_3*w_H_x__BDE_theta_2 -
        l_H_y__HE_theta_4*span_HE_H_y;
    const double determinant_H_x__H_y_3 = -(pivot_H_x__H_y_3 * pivot_H_x__H_y_3) + scale_H_x_4*scale_H_y_4;
    if (!(scale_H_x_4 > 1e-10 * scale_H_x_4)) return 1;
    if (!(determinant_H_x__H_y_3 > 1e-10 * scale_H_y_4 * scale_H_x_4)) return 2;
    const double size_H_x_3 = scale_H_x_4 + scale_H_y_4;
    if (!(scale_H_x_4 > 1e-10 * size_H_x_3)) return 1;
    if (!(determinant_H_x__H_y_3 > 1e-10 * size_H_x_3 * scale_H_x_4)) return 2;
    const double inverse_H_x__H_y_3 = -1.0/determinant_H_x__H_y_3;
    const double inverse_pivot_H_x_4 = inverse_H_x__H_y_3*scale_H_y_4;
    const double inverse_pivot_H_y_4 = inverse_H_x__H_y_3*scale_H_x_4;
    const double inverse_cross_H_x__H_y_3 = -inverse_H_x__H_y_3*pivot_H_x__H_y_3;
    const double w_E3_x__H_x_2 = -l_E3_x__BDE_theta_4*w_H_x__BDE_theta_2;
    const double w_E3_x__H_y_2 = -l_E3_x__BDE_theta_4*w_H_y__BDE_theta_2;
    const double l_E3_x__H_x_3 = inverse_cross_H_x__H_y_3*w_E3_x__H_y_2 + inverse_pivot_H_x_4*w_E3_x__H_x_2;
    const double l_E3_x__H_y_3 = inverse_cross_H_x__H_y_3*w_E3_x__H_x_2 + inverse_pivot_H_y_4*w_E3_x__H_y_2;
    const double w_E3_y__H_x_2 = -l_E3_y__BDE_theta_4*w_H_x__BDE_theta_2;
    const double w_E3_y__H_y_2 = -l_E3_y__BDE_theta_4*w_H_y__BDE_theta_2;
    const double l_E3_y__H_x_3 = inverse_cross_H_x__H_y_3*w_E3_y__H_y_2 + inverse_pivot_H_x_4*w_E3_y__H_x_2;
    const double l_E3_y__H_y_3 = inverse_cross_H_x__H_y_3*w_E3_y__H_x_2 + inverse_pivot_H_y_4*w_E3_y__H_y_2;
    const double l_OF_theta__EG_theta_4 = dot_OF_EG*inverse_mass_EG_EG;
    const double l_FE_theta__EG_theta_4 = dot_FE_EG*inverse_mass_EG_EG;
    const double l_G_x__EG_theta_4 = -inverse_mass_EG_EG*span_EG_G_y;
    const double l_G_y__EG_theta_4 = inverse_mass_EG_EG*span_EG_G_x;
    const double pivot_OF_theta_3 = -dot_OF_EG*l_OF_theta__EG_theta_4 + mass_OF_OF;
    const double pivot_FE_theta_3 = -dot_FE_EG*l_FE_theta__EG_theta_4 + mass_FE_FE;
    const double pivot_OF_theta__FE_theta_3 = -dot_OF_EG*l_FE_theta__EG_theta_4 + dot_OF_FE;
    const double determinant_OF_theta__FE_theta_3 = pivot_FE_theta_3*pivot_OF_theta_3 -
        (pivot_OF_theta__FE_theta_3 * pivot_OF_theta__FE_theta_3);
    const double inverse_OF_theta__FE_theta_3 = 1.0/determinant_OF_theta__FE_theta_3;
    const double inverse_pivot_OF_theta_4 = inverse_OF_theta__FE_theta_3*pivot_FE_theta_3;
    const double inverse_pivot_FE_theta_4 = inverse_OF_theta__FE_theta_3*pivot_OF_theta_3;
    const double inverse_cross_OF_theta__FE_theta_3 =
        -inverse_OF_theta__FE_theta_3*pivot_OF_theta__FE_theta_3;
    const double w_G_x__OF_theta_2 = -dot_OF_EG*l_G_x__EG_theta_4 - span_OF_F_y;
    const double w_G_x__FE_theta_2 = -dot_FE_EG*l_G_x__EG_theta_4 - span_FE_E_y;
    const double l_G_x__OF_theta_3 = inverse_cross_OF_theta__FE_theta_3*w_G_x__FE_theta_2 +
        inverse_pivot_OF_theta_4*w_G_x__OF_theta_2;
    const double l_G_x__FE_theta_3 = inverse_cross_OF_theta__FE_theta_3*w_G_x__OF_theta_2 +
        inverse_pivot_FE_theta_4*w_G_x__FE_theta_2;
    const double w_G_y__OF_theta_2 = -dot_OF_EG*l_G_y__EG_theta_4 + span_OF_F_x;
    const double w_G_y__FE_theta_2 = -dot_FE_EG*l_G_y__EG_theta_4 + span_FE_E_x;
    const double l_G_y__OF_theta_3 = inverse_cross_OF_theta__FE_theta_3*w_G_y__FE_theta_2 +
        inverse_pivot_OF_theta_4*w_G_y__OF_theta_2;
    const double l_G_y__FE_theta_3 = inverse_cross_OF_theta__FE_theta_3*w_G_y__OF_theta_2 +
        inverse_pivot_FE_theta_4*w_G_y__FE_theta_2;
    const double l_E3_x__OF_theta_4 = -inverse_cross_OF_theta__FE_theta_3*span_FE_E_y -
        inverse_pivot_OF_theta_4*span_OF_F_y;
    const double l_E3_x__FE_theta_4 = -inverse_cross_OF_theta__FE_theta_3*span_OF_F_y -
        inverse_pivot_FE_theta_4*span_FE_E_y;
    const double l_E3_y__OF_theta_4 = inverse_cross_OF_theta__FE_theta_3*span_FE_E_x +
        inverse_pivot_OF_theta_4*span_OF_F_x;
    const double l_E3_y__FE_theta_4 = inverse_cross_OF_theta__FE_theta_3*span_OF_F_x +
        inverse_pivot_FE_theta_4*span_FE_E_x;
    const double scale_G_x_4 = l_G_x__AG_theta_4*span_AG_G_y - l_G_x__EG_theta_4*span_EG_G_y +
        l_G_x__FE_theta_3*w_G_x__FE_theta_2 + l_G_x__OF_theta_3*w_G_x__OF_theta_2;
    const double scale_G_y_4 = -l_G_y__AG_theta_4*span_AG_G_x + l_G_y__EG_theta_4*span_EG_G_x +
        l_G_y__FE_theta_3*w_G_y__FE_theta_2 + l_G_y__OF_theta_3*w_G_y__OF_theta_2;
    const double pivot_G_x__G_y_3 = l_G_y__AG_theta_4*span_AG_G_y - l_G_y__EG_theta_4*span_EG_G_y +
        l_G_y__FE_theta_3*w_G_x__FE_theta_2 + l_G_y__OF_theta_3*w_G_x__OF_theta_2;
    const double determinant_G_x__G_y_3 = -(pivot_G_x__G_y_3 * pivot_G_x__G_y_3) + scale_G_x_4*scale_G_y_4;
    if (!(scale_G_x_4 > 1e-10 * scale_G_x_4)) return 3;
    if (!(determinant_G_x__G_y_3 > 1e-10 * scale_G_y_4 * scale_G_x_4)) return 4;
    const double size_G_x_3 = scale_G_x_4 + scale_G_y_4;
    if (!(scale_G_x_4 > 1e-10 * size_G_x_3)) return 3;
    if (!(determinant_G_x__G_y_3 > 1e-10 * size_G_x_3 * scale_G_x_4)) return 4;
    const double inverse_G_x__G_y_3 = -1.0/determinant_G_x__G_y_3;
    const double inverse_pivot_G_x_4 = inverse_G_x__G_y_3*scale_G_y_4;
    const double inverse_pivot_G_y_4 = inverse_G_x__G_y_3*scale_G_x_4;
    const double inverse_cross_G_x__G_y_3 = -inverse_G_x__G_y_3*pivot_G_x__G_y_3;
    const double w_E3_x__G_x_2 = -l_E3_x__FE_theta_4*w_G_x__FE_theta_2 - l_E3_x__OF_theta_4*w_G_x__OF_theta_2;
    const double w_E3_x__G_y_2 = -l_E3_x__FE_theta_4*w_G_y__FE_theta_2 - l_E3_x__OF_theta_4*w_G_y__OF_theta_2;
    const double l_E3_x__G_x_3 = inverse_cross_G_x__G_y_3*w_E3_x__G_y_2 + inverse_pivot_G_x_4*w_E3_x__G_x_2;
    const double l_E3_x__G_y_3 = inverse_cross_G_x__G_y_3*w_E3_x__G_x_2 + inverse_pivot_G_y_4*w_E3_x__G_y_2;
    const double w_E3_y__G_x_2 = -l_E3_y__FE_theta_4*w_G_x__FE_theta_2 - l_E3_y__OF_theta_4*w_G_x__OF_theta_2;
    const double w_E3_y__G_y_2 = -l_E3_y__FE_theta_4*w_G_y__FE_theta_2 - l_E3_y__OF_theta_4*w_G_y__OF_theta_2;
    const double l_E3_y__G_x_3 = inverse_cross_G_x__G_y_3*w_E3_y__G_y_2 + inverse_pivot_G_x_4*w_E3_y__G_x_2;
    const double l_E3_y__G_y_3 = inverse_cross_G_x__G_y_3*w_E3_y__G_x_2 + inverse_pivot_G_y_4*w_E3_y__G_y_2;
    const double scale_E3_x_4 = l_E3_x__BDE_theta_4*span_BDE_E_y - l_E3_x__FE_theta_4*span_FE_E_y -
        l_E3_x__OF_theta_4*span_OF_F_y;
    const double scale_E3_y_4 = -l_E3_y__BDE_theta_4*span_BDE_E_x + l_E3_y__FE_theta_4*span_FE_E_x +
        l_E3_y__OF_theta_4*span_OF_F_x;
    const double pivot_E3_x_3 = l_E3_x__G_x_3*w_E3_x__G_x_2 + l_E3_x__G_y_3*w_E3_x__G_y_2 +
        l_E3_x__H_x_3*w_E3_x__H_x_2 + l_E3_x__H_y_3*w_E3_x__H_y_2 + scale_E3_x_4;
    const double pivot_E3_y_3 = l_E3_y__G_x_3*w_E3_y__G_x_2 + l_E3_y__G_y_3*w_E3_y__G_y_2 +
        l_E3_y__H_x_3*w_E3_y__H_x_2 + l_E3_y__H_y_3*w_E3_y__H_y_2 + scale_E3_y_4;
    const double pivot_E3_x__E3_y_3 = l_E3_y__BDE_theta_4*span_BDE_E_y - l_E3_y__FE_theta_4*span_FE_E_y +
        l_E3_y__G_x_3*w_E3_x__G_x_2 + l_E3_y__G_y_3*w_E3_x__G_y_2 + l_E3_y__H_x_3*w_E3_x__H_x_2 +
        l_E3_y__H_y_3*w_E3_x__H_y_2 - l_E3_y__OF_theta_4*span_OF_F_y;
    const double determinant_E3_x__E3_y_3 = pivot_E3_x_3*pivot_E3_y_3 - (pivot_E3_x__E3_y_3 *
        pivot_E3_x__E3_y_3);
    if (!(pivot_E3_x_3 > 1e-10 * scale_E3_x_4)) return 5;
    if (!(determinant_E3_x__E3_y_3 > 1e-10 * scale_E3_y_4 * pivot_E3_x_3)) return 6;
    const double size_E3_x_3 = scale_E3_x_4 + scale_E3_y_4;
    if (!(pivot_E3_x_3 > 1e-10 * size_E3_x_3)) return 5;
    if (!(determinant_E3_x__E3_y_3 > 1e-10 * size_E3_x_3 * pivot_E3_x_3)) return 6;
    const double inverse_E3_x__E3_y_3 = -1.0/determinant_E3_x__E3_y_3;
    const double inverse_pivot_E3_x_4 = inverse_E3_x__E3_y_3*pivot_E3_y_3;
    const double inverse_pivot_E3_y_4 = inverse_E3_x__E3_y_3*pivot_E3_x_3;
    const double inverse_cross_E3_x__E3_y_3 = -inverse_E3_x__E3_y_3*pivot_E3_x__E3_y_3;

    /* forward substitution */
    const double dq_z_E3_x = -l_E3_x__G_x_3*phi_G_x - l_E3_x__G_y_3*phi_G_y - l_E3_x__H_x_3*phi_H_x -
        l_E3_x__H_y_3*phi_H_y + phi_E3_x;
    const double dq_z_E3_y = -l_E3_y__G_x_3*phi_G_x - l_E3_y__G_y_3*phi_G_y - l_E3_y__H_x_3*phi_H_x -
        l_E3_y__H_y_3*phi_H_y + phi_E3_y;

    /* backward substitution */
    const double dq_lambda_E3_y = dq_z_E3_x*inverse_cross_E3_x__E3_y_3 + dq_z_E3_y*inverse_pivot_E3_y_4;
    const double dq_lambda_E3_x = dq_z_E3_x*inverse_pivot_E3_x_4 + dq_z_E3_y*inverse_cross_E3_x__E3_y_3;
    const double dq_lambda_G_y = -dq_lambda_E3_x*l_E3_x__G_y_3 - dq_lambda_E3_y*l_E3_y__G_y_3 +
        inverse_cross_G_x__G_y_3*phi_G_x + inverse_pivot_G_y_4*phi_G_y;
    const double dq_lambda_G_x = -dq_lambda_E3_x*l_E3_x__G_x_3 - dq_lambda_E3_y*l_E3_y__G_x_3 +
        inverse_cross_G_x__G_y_3*phi_G_y + inverse_pivot_G_x_4*phi_G_x;
    const double dq_acceleration_FE_theta = -dq_lambda_E3_x*l_E3_x__FE_theta_4 -
        dq_lambda_E3_y*l_E3_y__FE_theta_4 - dq_lambda_G_x*l_G_x__FE_theta_3 - dq_lambda_G_y*l_G_y__FE_theta_3;
    const double dq_acceleration_OF_theta = -dq_lambda_E3_x*l_E3_x__OF_theta_4 -
        dq_lambda_E3_y*l_E3_y__OF_theta_4 - dq_lambda_G_x*l_G_x__OF_theta_3 - dq_lambda_G_y*l_G_y__OF_theta_3;
    const double dq_acceleration_EG_theta = -dq_acceleration_FE_theta*l_FE_theta__EG_theta_4 -
        dq_acceleration_OF_theta*l_OF_theta__EG_theta_4 - dq_lambda_G_x*l_G_x__EG_theta_4 -
        dq_lambda_G_y*l_G_y__EG_theta_4;
    const double dq_lambda_H_y = -dq_lambda_E3_x*l_E3_x__H_y_3 - dq_lambda_E3_y*l_E3_y__H_y_3 +
        inverse_cross_H_x__H_y_3*phi_H_x + inverse_pivot_H_y_4*phi_H_y;
    const double dq_lambda_H_x = -dq_lambda_E3_x*l_E3_x__H_x_3 - dq_lambda_E3_y*l_E3_y__H_x_3 +
        inverse_cross_H_x__H_y_3*phi_H_y + inverse_pivot_H_x_4*phi_H_x;
    const double dq_acceleration_BDE_theta = -dq_lambda_E3_x*l_E3_x__BDE_theta_4 -
        dq_lambda_E3_y*l_E3_y__BDE_theta_4 - dq_lambda_H_x*l_H_x__BDE_theta_3 -
        dq_lambda_H_y*l_H_y__BDE_theta_3;
    const double dq_acceleration_HE_theta = -dq_acceleration_BDE_theta*l_BDE_theta__HE_theta_4 -
        dq_lambda_H_x*l_H_x__HE_theta_4 - dq_lambda_H_y*l_H_y__HE_theta_4;
    const double dq_acceleration_AH_theta = -dq_lambda_H_x*l_H_x__AH_theta_4 -
        dq_lambda_H_y*l_H_y__AH_theta_4;
    const double dq_acceleration_AG_theta = -dq_lambda_G_x*l_G_x__AG_theta_4 -
        dq_lambda_G_y*l_G_y__AG_theta_4;

    /* forward substitution */
    const double dv_z_E3_x = -l_E3_x__G_x_3*phi_dot_G_x - l_E3_x__G_y_3*phi_dot_G_y -
        l_E3_x__H_x_3*phi_dot_H_x - l_E3_x__H_y_3*phi_dot_H_y + phi_dot_E3_x;
    const double dv_z_E3_y = -l_E3_y__G_x_3*phi_dot_G_x - l_E3_y__G_y_3*phi_dot_G_y -
        l_E3_y__H_x_3*phi_dot_H_x - l_E3_y__H_y_3*phi_dot_H_y + phi_dot_E3_y;

    /* backward substitution */
    const double dv_lambda_E3_y = dv_z_E3_x*inverse_cross_E3_x__E3_y_3 + dv_z_E3_y*inverse_pivot_E3_y_4;
    const double dv_lambda_E3_x = dv_z_E3_x*inverse_pivot_E3_x_4 + dv_z_E3_y*inverse_cross_E3_x__E3_y_3;
    const double dv_lambda_G_y = -dv_lambda_E3_x*l_E3_x__G_y_3 - dv_lambda_E3_y*l_E3_y__G_y_3 +
        inverse_cross_G_x__G_y_3*phi_dot_G_x + inverse_pivot_G_y_4*phi_dot_G_y;
    const double dv_lambda_G_x = -dv_lambda_E3_x*l_E3_x__G_x_3 - dv_lambda_E3_y*l_E3_y__G_x_3 +
        inverse_cross_G_x__G_y_3*phi_dot_G_y + inverse_pivot_G_x_4*phi_dot_G_x;
    const double dv_acceleration_FE_theta = -dv_lambda_E3_x*l_E3_x__FE_theta_4 -
        dv_lambda_E3_y*l_E3_y__FE_theta_4 - dv_lambda_G_x*l_G_x__FE_theta_3 - dv_lambda_G_y*l_G_y__FE_theta_3;
    const double dv_acceleration_OF_theta = -dv_lambda_E3_x*l_E3_x__OF_theta_4 -
        dv_lambda_E3_y*l_E3_y__OF_theta_4 - dv_lambda_G_x*l_G_x__OF_theta_3 - dv_lambda_G_y*l_G_y__OF_theta_3;
    const double dv_acceleration_EG_theta = -dv_acceleration_FE_theta*l_FE_theta__EG_theta_4 -
        dv_acceleration_OF_theta*l_OF_theta__EG_theta_4 - dv_lambda_G_x*l_G_x__EG_theta_4 -
        dv_lambda_G_y*l_G_y__EG_theta_4;
    const double dv_lambda_H_y = -dv_lambda_E3_x*l_E3_x__H_y_3 - dv_lambda_E3_y*l_E3_y__H_y_3 +
        inverse_cross_H_x__H_y_3*phi_dot_H_x + inverse_pivot_H_y_4*phi_dot_H_y;
    const double dv_lambda_H_x = -dv_lambda_E3_x*l_E3_x__H_x_3 - dv_lambda_E3_y*l_E3_y__H_x_3 +
        inverse_cross_H_x__H_y_3*phi_dot_H_y + inverse_pivot_H_x_4*phi_dot_H_x;
    const double dv_acceleration_BDE_theta = -dv_lambda_E3_x*l_E3_x__BDE_theta_4 -
        dv_lambda_E3_y*l_E3_y__BDE_theta_4 - dv_lambda_H_x*l_H_x__BDE_theta_3 -
        dv_lambda_H_y*l_H_y__BDE_theta_3;
    const double dv_acceleration_HE_theta = -dv_acceleration_BDE_theta*l_BDE_theta__HE_theta_4 -
        dv_lambda_H_x*l_H_x__HE_theta_4 - dv_lambda_H_y*l_H_y__HE_theta_4;
    const double dv_acceleration_AH_theta = -dv_lambda_H_x*l_H_x__AH_theta_4 -
        dv_lambda_H_y*l_H_y__AH_theta_4;
    const double dv_acceleration_AG_theta = -dv_lambda_G_x*l_G_x__AG_theta_4 -
        dv_lambda_G_y*l_G_y__AG_theta_4;

    /* results */
    dq[0] = dq_acceleration_OF_theta;
    dv[0] = dv_acceleration_OF_theta;
    dq[1] = dq_acceleration_BDE_theta;
    dv[1] = dv_acceleration_BDE_theta;
    dq[2] = dq_acceleration_AG_theta;
    dv[2] = dv_acceleration_AG_theta;
    dq[3] = dq_acceleration_AH_theta;
    dv[3] = dv_acceleration_AH_theta;
    dq[4] = dq_acceleration_FE_theta;
    dv[4] = dv_acceleration_FE_theta;
    dq[5] = dq_acceleration_HE_theta;
    dv[5] = dv_acceleration_HE_theta;
    dq[6] = dq_acceleration_EG_theta;
    dv[6] = dv_acceleration_EG_theta;
    *worst = 0.0;
    *worst = max_of(*worst, fabs(phi_G_x));
    *worst = max_of(*worst, fabs(phi_G_y));
    *worst = max_of(*worst, fabs(phi_H_x));
    *worst = max_of(*worst, fabs(phi_H_y));
    *worst = max_of(*worst, fabs(phi_E3_x));
    *worst = max_of(*worst, fabs(phi_E3_y));
    return 0;
}
