/*
 * Every number of a run: slots given or by default, then what follows from them.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    p->OF_mass = is_given[0] ? given[0] : 0.04325;  /* bodies.OF.mass */
    p->OF_inertia = is_given[1] ? given[1] : 2.194e-06;  /* bodies.OF.inertia */
    p->FE_mass = is_given[2] ? given[2] : 0.00365;  /* bodies.FE.mass */
    p->FE_inertia = is_given[3] ? given[3] : 4.41e-07;  /* bodies.FE.inertia */
    p->BDE_mass = is_given[4] ? given[4] : 0.02373;  /* bodies.BDE.mass */
    p->BDE_inertia = is_given[5] ? given[5] : 5.255e-06;  /* bodies.BDE.inertia */
    p->EG_mass = is_given[6] ? given[6] : 0.00706;  /* bodies.EG.mass */
    p->EG_inertia = is_given[7] ? given[7] : 5.667e-07;  /* bodies.EG.inertia */
    p->AG_mass = is_given[8] ? given[8] : 0.0705;  /* bodies.AG.mass */
    p->AG_inertia = is_given[9] ? given[9] : 1.169e-05;  /* bodies.AG.inertia */
    p->HE_mass = is_given[10] ? given[10] : 0.00706;  /* bodies.HE.mass */
    p->HE_inertia = is_given[11] ? given[11] : 5.667e-07;  /* bodies.HE.inertia */
    p->AH_mass = is_given[12] ? given[12] : 0.05498;  /* bodies.AH.mass */
    p->AH_inertia = is_given[13] ? given[13] : 1.912e-05;  /* bodies.AH.inertia */
    p->OF_points_O_x = is_given[14] ? given[14] : -0.00092;  /* bodies.OF.points.O.x */
    p->OF_points_F_x = is_given[15] ? given[15] : 0.00608;  /* bodies.OF.points.F.x */
    p->FE_points_E_x = is_given[16] ? given[16] : -0.0165;  /* bodies.FE.points.E.x */
    p->FE_points_F_x = is_given[17] ? given[17] : 0.0115;  /* bodies.FE.points.F.x */
    p->BDE_points_B_x = is_given[18] ? given[18] : -0.01043;  /* bodies.BDE.points.B.x */
    p->BDE_points_B_y = is_given[19] ? given[19] : 0.01874;  /* bodies.BDE.points.B.y */
    p->BDE_points_E_x = is_given[20] ? given[20] : -0.01043;  /* bodies.BDE.points.E.x */
    p->BDE_points_E_y = is_given[21] ? given[21] : -0.01626;  /* bodies.BDE.points.E.y */
    p->BDE_points_D_x = is_given[22] ? given[22] : 0.00957;  /* bodies.BDE.points.D.x */
    p->BDE_points_D_y = is_given[23] ? given[23] : 0.00074;  /* bodies.BDE.points.D.y */
    p->EG_points_G_y = is_given[24] ? given[24] : 0.00579;  /* bodies.EG.points.G.y */
    p->EG_points_E_y = is_given[25] ? given[25] : -0.01421;  /* bodies.EG.points.E.y */
    p->AG_points_A_x = is_given[26] ? given[26] : -0.02308;  /* bodies.AG.points.A.x */
    p->AG_points_A_y = is_given[27] ? given[27] : 0.00916;  /* bodies.AG.points.A.y */
    p->AG_points_G_x = is_given[28] ? given[28] : 0.01692;  /* bodies.AG.points.G.x */
    p->AG_points_G_y = is_given[29] ? given[29] : 0.00916;  /* bodies.AG.points.G.y */
    p->HE_points_H_x = is_given[30] ? given[30] : -0.00579;  /* bodies.HE.points.H.x */
    p->HE_points_E_x = is_given[31] ? given[31] : 0.01421;  /* bodies.HE.points.E.x */
    p->AH_points_A_x = is_given[32] ? given[32] : 0.00449;  /* bodies.AH.points.A.x */
    p->AH_points_A_y = is_given[33] ? given[33] : 0.01228;  /* bodies.AH.points.A.y */
    p->AH_points_H_x = is_given[34] ? given[34] : 0.00449;  /* bodies.AH.points.H.x */
    p->AH_points_H_y = is_given[35] ? given[35] : -0.02772;  /* bodies.AH.points.H.y */
    p->alpha = is_given[36] ? given[36] : 50.0;  /* baumgarte.alpha */
    p->beta = is_given[37] ? given[37] : 50.0;  /* baumgarte.beta */
    p->B_x = is_given[38] ? given[38] : -0.03635;  /* ground.B.x */
    p->B_y = is_given[39] ? given[39] : 0.03273;  /* ground.B.y */
    p->A_x = is_given[40] ? given[40] : -0.06934;  /* ground.A.x */
    p->A_y = is_given[41] ? given[41] : -0.00227;  /* ground.A.y */
    p->C_x = is_given[42] ? given[42] : 0.014;  /* ground.C.x */
    p->C_y = is_given[43] ? given[43] : 0.072;  /* ground.C.y */
    p->spring_stiffness = is_given[44] ? given[44] : 4530.0;  /* forces.spring.stiffness */
    p->spring_free_length = is_given[45] ? given[45] : 0.07785;  /* forces.spring.free_length */
    p->motor_value = is_given[46] ? given[46] : 0.033;  /* forces.motor.value */
    p->guess_FE_theta = is_given[47] ? given[47] : -0.0617138900142764;  /* start.guess.FE.theta */
    p->guess_BDE_theta = is_given[48] ? given[48] : 0.45527981916307037;  /* start.guess.BDE.theta */
    p->guess_EG_theta = is_given[49] ? given[49] : 0.710033369709727;  /* start.guess.EG.theta */
    p->guess_AG_theta = is_given[50] ? given[50] : 0.48736497954384256;  /* start.guess.AG.theta */
    p->guess_HE_theta = is_given[51] ? given[51] : 1.00787905438393;  /* start.guess.HE.theta */
    p->guess_AH_theta = is_given[52] ? given[52] : 1.23054744454982;  /* start.guess.AH.theta */
    p->set_OF_theta = is_given[53] ? given[53] : -0.06171389001427645;  /* start.set.OF.theta */

    /* derived */
    p->two_alpha = 2.0*p->alpha;  /* 2 alpha */
    p->beta_squared = (p->beta * p->beta);  /* beta^2 */
    p->inverse_OF_mass = 1.0/p->OF_mass;  /* 1/M */
    p->inverse_BDE_mass = 1.0/p->BDE_mass;  /* 1/M */
    p->inverse_EG_mass = 1.0/p->EG_mass;  /* 1/M */
    p->inverse_AG_mass = 1.0/p->AG_mass;  /* 1/M */
    p->inverse_HE_mass = 1.0/p->HE_mass;  /* 1/M */
    p->inverse_AH_mass = 1.0/p->AH_mass;  /* 1/M */
    p->inverse_OF_inertia = 1.0/p->OF_inertia;  /* 1/M */
    p->inverse_FE_mass = 1.0/p->FE_mass;  /* 1/M */
    p->inverse_BDE_inertia = 1.0/p->BDE_inertia;  /* 1/M */
    p->inverse_EG_inertia = 1.0/p->EG_inertia;  /* 1/M */
    p->inverse_AG_inertia = 1.0/p->AG_inertia;  /* 1/M */
    p->inverse_HE_inertia = 1.0/p->HE_inertia;  /* 1/M */
    p->inverse_AH_inertia = 1.0/p->AH_inertia;  /* 1/M */
    p->inverse_FE_inertia = 1.0/p->FE_inertia;  /* 1/M */
    p->OF_com_span_x = -p->OF_points_O_x;  /* vector in its frame */
    p->BDE_com_span_x = -p->BDE_points_B_x;  /* vector in its frame */
    p->BDE_com_span_y = -p->BDE_points_B_y;  /* vector in its frame */
    p->AG_com_span_x = -p->AG_points_A_x;  /* vector in its frame */
    p->AG_com_span_y = -p->AG_points_A_y;  /* vector in its frame */
    p->AH_com_span_x = -p->AH_points_A_x;  /* vector in its frame */
    p->AH_com_span_y = -p->AH_points_A_y;  /* vector in its frame */
    p->OF_F_span_x = p->OF_points_F_x - p->OF_points_O_x;  /* vector in its frame */
    p->FE_com_span_x = -p->FE_points_F_x;  /* vector in its frame */
    p->BDE_E_span_x = -p->BDE_points_B_x + p->BDE_points_E_x;  /* vector in its frame */
    p->BDE_E_span_y = -p->BDE_points_B_y + p->BDE_points_E_y;  /* vector in its frame */
    p->HE_com_span_x = -p->HE_points_E_x;  /* vector in its frame */
    p->FE_E_span_x = p->FE_points_E_x - p->FE_points_F_x;  /* vector in its frame */
    p->EG_com_span_y = -p->EG_points_E_y;  /* vector in its frame */
    p->EG_G_span_y = -p->EG_points_E_y + p->EG_points_G_y;  /* vector in its frame */
    p->AG_G_span_x = -p->AG_points_A_x + p->AG_points_G_x;  /* vector in its frame */
    p->AG_G_span_y = -p->AG_points_A_y + p->AG_points_G_y;  /* vector in its frame */
    p->HE_H_span_x = -p->HE_points_E_x + p->HE_points_H_x;  /* vector in its frame */
    p->AH_H_span_x = -p->AH_points_A_x + p->AH_points_H_x;  /* vector in its frame */
    p->AH_H_span_y = -p->AH_points_A_y + p->AH_points_H_y;  /* vector in its frame */
    p->BDE_D_span_x = -p->BDE_points_B_x + p->BDE_points_D_x;  /* vector in its frame */
    p->BDE_D_span_y = -p->BDE_points_B_y + p->BDE_points_D_y;  /* vector in its frame */
    /* sum of m w.w */
    p->inertia_OF_OF = p->EG_mass*(p->OF_F_span_x * p->OF_F_span_x) + p->FE_mass*(p->OF_F_span_x * p->OF_F_span_x)
        + (p->OF_com_span_x * p->OF_com_span_x)*p->OF_mass;
    /* sum of m w.w */
    p->inertia_OF_FE = p->EG_mass*p->FE_E_span_x*p->OF_F_span_x + p->FE_com_span_x*p->FE_mass*p->OF_F_span_x;
    /* sum of m w.w */
    p->inertia_FE_FE = p->EG_mass*(p->FE_E_span_x * p->FE_E_span_x) + (p->FE_com_span_x * p->FE_com_span_x)*p->FE_mass;
    /* sum of m w.w */
    p->inertia_BDE_BDE = (p->BDE_E_span_x * p->BDE_E_span_x)*p->HE_mass
        + (p->BDE_E_span_y * p->BDE_E_span_y)*p->HE_mass + (p->BDE_com_span_x * p->BDE_com_span_x)*p->BDE_mass
        + (p->BDE_com_span_y * p->BDE_com_span_y)*p->BDE_mass;
    p->twist_OF_EG = p->EG_com_span_y*p->EG_mass*p->OF_F_span_x;  /* sum of m wxw */
    p->twist_FE_EG = p->EG_com_span_y*p->EG_mass*p->FE_E_span_x;  /* sum of m wxw */
    p->inertia_EG_EG = (p->EG_com_span_y * p->EG_com_span_y)*p->EG_mass;  /* sum of m w.w */
    /* sum of m w.w */
    p->inertia_AG_AG = (p->AG_com_span_x * p->AG_com_span_x)*p->AG_mass
        + (p->AG_com_span_y * p->AG_com_span_y)*p->AG_mass;
    p->inertia_BDE_HE = p->BDE_E_span_x*p->HE_com_span_x*p->HE_mass;  /* sum of m w.w */
    p->twist_BDE_HE = -p->BDE_E_span_y*p->HE_com_span_x*p->HE_mass;  /* sum of m wxw */
    p->inertia_HE_HE = (p->HE_com_span_x * p->HE_com_span_x)*p->HE_mass;  /* sum of m w.w */
    /* sum of m w.w */
    p->inertia_AH_AH = (p->AH_com_span_x * p->AH_com_span_x)*p->AH_mass
        + (p->AH_com_span_y * p->AH_com_span_y)*p->AH_mass;
    p->mass_OF_OF = p->OF_inertia + p->inertia_OF_OF;  /* constant of M */
    p->mass_FE_FE = p->FE_inertia + p->inertia_FE_FE;  /* constant of M */
    p->mass_BDE_BDE = p->BDE_inertia + p->inertia_BDE_BDE;  /* constant of M */
    p->mass_EG_EG = p->EG_inertia + p->inertia_EG_EG;  /* constant of M */
    p->mass_AG_AG = p->AG_inertia + p->inertia_AG_AG;  /* constant of M */
    p->mass_HE_HE = p->HE_inertia + p->inertia_HE_HE;  /* constant of M */
    p->mass_AH_AH = p->AH_inertia + p->inertia_AH_AH;  /* constant of M */
    p->inverse_mass_AG_AG = 1.0/p->mass_AG_AG;  /* 1/M */
    p->inverse_mass_AH_AH = 1.0/p->mass_AH_AH;  /* 1/M */
    p->inverse_mass_HE_HE = 1.0/p->mass_HE_HE;  /* 1/M */
    p->inverse_mass_EG_EG = 1.0/p->mass_EG_EG;  /* 1/M */
}
