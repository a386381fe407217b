/*
 * Fill all parameters of a run: given values or defaults, then derived parameters.
 */
void prepare(const double *given, const unsigned char *is_given, Parameters *p)
{
    /* slots */
    p->OF_mass_ = is_given[0] ? given[0] : 0.04325;  /* bodies.OF.mass */
    p->OF_inertia_ = is_given[1] ? given[1] : 2.194e-06;  /* bodies.OF.inertia */
    p->FE_mass_ = is_given[2] ? given[2] : 0.00365;  /* bodies.FE.mass */
    p->FE_inertia_ = is_given[3] ? given[3] : 4.41e-07;  /* bodies.FE.inertia */
    p->BDE_mass_ = is_given[4] ? given[4] : 0.02373;  /* bodies.BDE.mass */
    p->BDE_inertia_ = is_given[5] ? given[5] : 5.255e-06;  /* bodies.BDE.inertia */
    p->EG_mass_ = is_given[6] ? given[6] : 0.00706;  /* bodies.EG.mass */
    p->EG_inertia_ = is_given[7] ? given[7] : 5.667e-07;  /* bodies.EG.inertia */
    p->AG_mass_ = is_given[8] ? given[8] : 0.0705;  /* bodies.AG.mass */
    p->AG_inertia_ = is_given[9] ? given[9] : 1.169e-05;  /* bodies.AG.inertia */
    p->HE_mass_ = is_given[10] ? given[10] : 0.00706;  /* bodies.HE.mass */
    p->HE_inertia_ = is_given[11] ? given[11] : 5.667e-07;  /* bodies.HE.inertia */
    p->AH_mass_ = is_given[12] ? given[12] : 0.05498;  /* bodies.AH.mass */
    p->AH_inertia_ = is_given[13] ? given[13] : 1.912e-05;  /* bodies.AH.inertia */
    p->OF_points_O_x_ = is_given[14] ? given[14] : -0.00092;  /* bodies.OF.points.O.x */
    p->OF_points_F_x_ = is_given[15] ? given[15] : 0.00608;  /* bodies.OF.points.F.x */
    p->FE_points_E_x_ = is_given[16] ? given[16] : -0.0165;  /* bodies.FE.points.E.x */
    p->FE_points_F_x_ = is_given[17] ? given[17] : 0.0115;  /* bodies.FE.points.F.x */
    p->BDE_points_B_x_ = is_given[18] ? given[18] : -0.01043;  /* bodies.BDE.points.B.x */
    p->BDE_points_B_y_ = is_given[19] ? given[19] : 0.01874;  /* bodies.BDE.points.B.y */
    p->BDE_points_E_x_ = is_given[20] ? given[20] : -0.01043;  /* bodies.BDE.points.E.x */
    p->BDE_points_E_y_ = is_given[21] ? given[21] : -0.01626;  /* bodies.BDE.points.E.y */
    p->BDE_points_D_x_ = is_given[22] ? given[22] : 0.00957;  /* bodies.BDE.points.D.x */
    p->BDE_points_D_y_ = is_given[23] ? given[23] : 0.00074;  /* bodies.BDE.points.D.y */
    p->EG_points_G_y_ = is_given[24] ? given[24] : 0.00579;  /* bodies.EG.points.G.y */
    p->EG_points_E_y_ = is_given[25] ? given[25] : -0.01421;  /* bodies.EG.points.E.y */
    p->AG_points_A_x_ = is_given[26] ? given[26] : -0.02308;  /* bodies.AG.points.A.x */
    p->AG_points_A_y_ = is_given[27] ? given[27] : 0.00916;  /* bodies.AG.points.A.y */
    p->AG_points_G_x_ = is_given[28] ? given[28] : 0.01692;  /* bodies.AG.points.G.x */
    p->AG_points_G_y_ = is_given[29] ? given[29] : 0.00916;  /* bodies.AG.points.G.y */
    p->HE_points_H_x_ = is_given[30] ? given[30] : -0.00579;  /* bodies.HE.points.H.x */
    p->HE_points_E_x_ = is_given[31] ? given[31] : 0.01421;  /* bodies.HE.points.E.x */
    p->AH_points_A_x_ = is_given[32] ? given[32] : 0.00449;  /* bodies.AH.points.A.x */
    p->AH_points_A_y_ = is_given[33] ? given[33] : 0.01228;  /* bodies.AH.points.A.y */
    p->AH_points_H_x_ = is_given[34] ? given[34] : 0.00449;  /* bodies.AH.points.H.x */
    p->AH_points_H_y_ = is_given[35] ? given[35] : -0.02772;  /* bodies.AH.points.H.y */
    p->alpha_ = is_given[36] ? given[36] : 50.0;  /* baumgarte.alpha */
    p->beta_ = is_given[37] ? given[37] : 50.0;  /* baumgarte.beta */
    p->B_x_ = is_given[38] ? given[38] : -0.03635;  /* ground.B.x */
    p->B_y_ = is_given[39] ? given[39] : 0.03273;  /* ground.B.y */
    p->A_x_ = is_given[40] ? given[40] : -0.06934;  /* ground.A.x */
    p->A_y_ = is_given[41] ? given[41] : -0.00227;  /* ground.A.y */
    p->C_x_ = is_given[42] ? given[42] : 0.014;  /* ground.C.x */
    p->C_y_ = is_given[43] ? given[43] : 0.072;  /* ground.C.y */
    p->spring_stiffness_ = is_given[44] ? given[44] : 4530.0;  /* forces.spring.stiffness */
    p->spring_free_length_ = is_given[45] ? given[45] : 0.07785;  /* forces.spring.free_length */
    p->motor_value_ = is_given[46] ? given[46] : 0.033;  /* forces.motor.value */
    p->guess_FE_theta_ = is_given[47] ? given[47] : -0.0617138900142764;  /* start.guess.FE.theta */
    p->guess_BDE_theta_ = is_given[48] ? given[48] : 0.45527981916307037;  /* start.guess.BDE.theta */
    p->guess_EG_theta_ = is_given[49] ? given[49] : 0.710033369709727;  /* start.guess.EG.theta */
    p->guess_AG_theta_ = is_given[50] ? given[50] : 0.48736497954384256;  /* start.guess.AG.theta */
    p->guess_HE_theta_ = is_given[51] ? given[51] : 1.00787905438393;  /* start.guess.HE.theta */
    p->guess_AH_theta_ = is_given[52] ? given[52] : 1.23054744454982;  /* start.guess.AH.theta */
    p->set_OF_theta_ = is_given[53] ? given[53] : -0.06171389001427645;  /* start.set.OF.theta */

    /* derived */
    /* J and m s^2 of its joints */
    p->BDE_turning_ = p->BDE_inertia_ + p->BDE_mass_*(p->BDE_points_B_x_ * p->BDE_points_B_x_)
        + p->BDE_mass_*(p->BDE_points_B_y_ * p->BDE_points_B_y_)
        + p->BDE_mass_*(p->BDE_points_E_x_ * p->BDE_points_E_x_)
        + p->BDE_mass_*(p->BDE_points_E_y_ * p->BDE_points_E_y_);
    /* J and m s^2 of its joints */
    p->EG_turning_ = p->EG_inertia_ + p->EG_mass_*(p->EG_points_E_y_ * p->EG_points_E_y_)
        + p->EG_mass_*(p->EG_points_G_y_ * p->EG_points_G_y_);
    /* J and m s^2 of its joints */
    p->AG_turning_ = p->AG_inertia_ + p->AG_mass_*(p->AG_points_A_x_ * p->AG_points_A_x_)
        + p->AG_mass_*(p->AG_points_A_y_ * p->AG_points_A_y_) + p->AG_mass_*(p->AG_points_G_x_ * p->AG_points_G_x_)
        + p->AG_mass_*(p->AG_points_G_y_ * p->AG_points_G_y_);
    /* J and m s^2 of its joints */
    p->HE_turning_ = p->HE_inertia_ + p->HE_mass_*(p->HE_points_E_x_ * p->HE_points_E_x_)
        + p->HE_mass_*(p->HE_points_H_x_ * p->HE_points_H_x_);
    /* J and m s^2 of its joints */
    p->AH_turning_ = p->AH_inertia_ + p->AH_mass_*(p->AH_points_A_x_ * p->AH_points_A_x_)
        + p->AH_mass_*(p->AH_points_A_y_ * p->AH_points_A_y_) + p->AH_mass_*(p->AH_points_H_x_ * p->AH_points_H_x_)
        + p->AH_mass_*(p->AH_points_H_y_ * p->AH_points_H_y_);
    /* J and m s^2 of its joints */
    p->OF_turning_ = p->OF_inertia_ + p->OF_mass_*(p->OF_points_F_x_ * p->OF_points_F_x_)
        + p->OF_mass_*(p->OF_points_O_x_ * p->OF_points_O_x_);
    /* J and m s^2 of its joints */
    p->FE_turning_ = p->FE_inertia_ + p->FE_mass_*(p->FE_points_E_x_ * p->FE_points_E_x_)
        + p->FE_mass_*(p->FE_points_F_x_ * p->FE_points_F_x_);
    p->two_alpha_ = 2.0*p->alpha_;  /* 2 alpha */
    p->beta_squared_ = (p->beta_ * p->beta_);  /* beta^2 */
    p->mobility_E3_x_ = 1.0/p->FE_mass_ + 1.0/p->BDE_mass_;  /* 1/m of the bodies of a row */
    p->mobility_E4_x_ = 1.0/p->FE_mass_ + 1.0/p->EG_mass_;  /* 1/m of the bodies of a row */
    p->mobility_E6_x_ = 1.0/p->HE_mass_ + 1.0/p->FE_mass_;  /* 1/m of the bodies of a row */
    p->OF_com_span_x_ = -p->OF_points_O_x_;  /* vector in its frame */
    p->BDE_com_span_x_ = -p->BDE_points_B_x_;  /* vector in its frame */
    p->BDE_com_span_y_ = -p->BDE_points_B_y_;  /* vector in its frame */
    p->AG_com_span_x_ = -p->AG_points_A_x_;  /* vector in its frame */
    p->AG_com_span_y_ = -p->AG_points_A_y_;  /* vector in its frame */
    p->AH_com_span_x_ = -p->AH_points_A_x_;  /* vector in its frame */
    p->AH_com_span_y_ = -p->AH_points_A_y_;  /* vector in its frame */
    p->OF_F_span_x_ = p->OF_points_F_x_ - p->OF_points_O_x_;  /* vector in its frame */
    p->FE_com_span_x_ = -p->FE_points_F_x_;  /* vector in its frame */
    p->BDE_E_span_x_ = -p->BDE_points_B_x_ + p->BDE_points_E_x_;  /* vector in its frame */
    p->BDE_E_span_y_ = -p->BDE_points_B_y_ + p->BDE_points_E_y_;  /* vector in its frame */
    p->HE_com_span_x_ = -p->HE_points_E_x_;  /* vector in its frame */
    p->FE_E_span_x_ = p->FE_points_E_x_ - p->FE_points_F_x_;  /* vector in its frame */
    p->EG_com_span_y_ = -p->EG_points_E_y_;  /* vector in its frame */
    p->EG_G_span_y_ = -p->EG_points_E_y_ + p->EG_points_G_y_;  /* vector in its frame */
    p->AG_G_span_x_ = -p->AG_points_A_x_ + p->AG_points_G_x_;  /* vector in its frame */
    p->AG_G_span_y_ = -p->AG_points_A_y_ + p->AG_points_G_y_;  /* vector in its frame */
    p->HE_H_span_x_ = -p->HE_points_E_x_ + p->HE_points_H_x_;  /* vector in its frame */
    p->AH_H_span_x_ = -p->AH_points_A_x_ + p->AH_points_H_x_;  /* vector in its frame */
    p->AH_H_span_y_ = -p->AH_points_A_y_ + p->AH_points_H_y_;  /* vector in its frame */
    p->BDE_D_span_x_ = -p->BDE_points_B_x_ + p->BDE_points_D_x_;  /* vector in its frame */
    p->BDE_D_span_y_ = -p->BDE_points_B_y_ + p->BDE_points_D_y_;  /* vector in its frame */
    /* sum of m w.w */
    p->inertia_OF_OF_ = p->EG_mass_*(p->OF_F_span_x_ * p->OF_F_span_x_)
        + p->FE_mass_*(p->OF_F_span_x_ * p->OF_F_span_x_) + (p->OF_com_span_x_ * p->OF_com_span_x_)*p->OF_mass_;
    /* sum of m w.w */
    p->inertia_OF_FE_ = p->EG_mass_*p->FE_E_span_x_*p->OF_F_span_x_ + p->FE_com_span_x_*p->FE_mass_*p->OF_F_span_x_;
    /* sum of m w.w */
    p->inertia_FE_FE_ = p->EG_mass_*(p->FE_E_span_x_ * p->FE_E_span_x_)
        + (p->FE_com_span_x_ * p->FE_com_span_x_)*p->FE_mass_;
    /* sum of m w.w */
    p->inertia_BDE_BDE_ = (p->BDE_E_span_x_ * p->BDE_E_span_x_)*p->HE_mass_
        + (p->BDE_E_span_y_ * p->BDE_E_span_y_)*p->HE_mass_ + (p->BDE_com_span_x_ * p->BDE_com_span_x_)*p->BDE_mass_
        + (p->BDE_com_span_y_ * p->BDE_com_span_y_)*p->BDE_mass_;
    p->twist_OF_EG_ = p->EG_com_span_y_*p->EG_mass_*p->OF_F_span_x_;  /* sum of m wxw */
    p->twist_FE_EG_ = p->EG_com_span_y_*p->EG_mass_*p->FE_E_span_x_;  /* sum of m wxw */
    p->inertia_EG_EG_ = (p->EG_com_span_y_ * p->EG_com_span_y_)*p->EG_mass_;  /* sum of m w.w */
    /* sum of m w.w */
    p->inertia_AG_AG_ = (p->AG_com_span_x_ * p->AG_com_span_x_)*p->AG_mass_
        + (p->AG_com_span_y_ * p->AG_com_span_y_)*p->AG_mass_;
    p->inertia_BDE_HE_ = p->BDE_E_span_x_*p->HE_com_span_x_*p->HE_mass_;  /* sum of m w.w */
    p->twist_BDE_HE_ = -p->BDE_E_span_y_*p->HE_com_span_x_*p->HE_mass_;  /* sum of m wxw */
    p->inertia_HE_HE_ = (p->HE_com_span_x_ * p->HE_com_span_x_)*p->HE_mass_;  /* sum of m w.w */
    /* sum of m w.w */
    p->inertia_AH_AH_ = (p->AH_com_span_x_ * p->AH_com_span_x_)*p->AH_mass_
        + (p->AH_com_span_y_ * p->AH_com_span_y_)*p->AH_mass_;
    p->mass_OF_OF_ = p->OF_inertia_ + p->inertia_OF_OF_;  /* constant of M */
    p->mass_FE_FE_ = p->FE_inertia_ + p->inertia_FE_FE_;  /* constant of M */
    p->mass_BDE_BDE_ = p->BDE_inertia_ + p->inertia_BDE_BDE_;  /* constant of M */
    p->mass_EG_EG_ = p->EG_inertia_ + p->inertia_EG_EG_;  /* constant of M */
    p->mass_AG_AG_ = p->AG_inertia_ + p->inertia_AG_AG_;  /* constant of M */
    p->mass_HE_HE_ = p->HE_inertia_ + p->inertia_HE_HE_;  /* constant of M */
    p->mass_AH_AH_ = p->AH_inertia_ + p->inertia_AH_AH_;  /* constant of M */
    p->inverse_mass_AG_AG_ = 1.0/p->mass_AG_AG_;  /* 1/M */
    p->inverse_mass_AH_AH_ = 1.0/p->mass_AH_AH_;  /* 1/M */
    p->inverse_mass_HE_HE_ = 1.0/p->mass_HE_HE_;  /* 1/M */
    p->inverse_mass_EG_EG_ = 1.0/p->mass_EG_EG_;  /* 1/M */
    /* of projections */
    p->mass_of_all_ = p->AG_mass_ + p->AH_mass_ + p->BDE_mass_ + p->EG_mass_ + p->FE_mass_ + p->HE_mass_ + p->OF_mass_;
    /* of projections */
    p->tree_metric_OF_theta_ = max_of(0.0001*p->mass_of_all_*((p->OF_points_F_x_ * p->OF_points_F_x_)
        + (p->OF_points_O_x_ * p->OF_points_O_x_)), p->mass_OF_OF_);
    /* of projections */
    p->tree_metric_BDE_theta_ = max_of(0.0001*p->mass_of_all_*((p->BDE_points_B_x_ * p->BDE_points_B_x_)
        + (p->BDE_points_B_y_ * p->BDE_points_B_y_) + (p->BDE_points_E_x_ * p->BDE_points_E_x_)
        + (p->BDE_points_E_y_ * p->BDE_points_E_y_)), p->mass_BDE_BDE_);
    /* of projections */
    p->tree_metric_AG_theta_ = max_of(0.0001*p->mass_of_all_*((p->AG_points_A_x_ * p->AG_points_A_x_)
        + (p->AG_points_A_y_ * p->AG_points_A_y_) + (p->AG_points_G_x_ * p->AG_points_G_x_)
        + (p->AG_points_G_y_ * p->AG_points_G_y_)), p->mass_AG_AG_);
    /* of projections */
    p->tree_metric_AH_theta_ = max_of(0.0001*p->mass_of_all_*((p->AH_points_A_x_ * p->AH_points_A_x_)
        + (p->AH_points_A_y_ * p->AH_points_A_y_) + (p->AH_points_H_x_ * p->AH_points_H_x_)
        + (p->AH_points_H_y_ * p->AH_points_H_y_)), p->mass_AH_AH_);
    /* of projections */
    p->tree_metric_FE_theta_ = max_of(0.0001*p->mass_of_all_*((p->FE_points_E_x_ * p->FE_points_E_x_)
        + (p->FE_points_F_x_ * p->FE_points_F_x_)), p->mass_FE_FE_);
    /* of projections */
    p->tree_metric_HE_theta_ = max_of(0.0001*p->mass_of_all_*((p->HE_points_E_x_ * p->HE_points_E_x_)
        + (p->HE_points_H_x_ * p->HE_points_H_x_)), p->mass_HE_HE_);
    /* of projections */
    p->tree_metric_EG_theta_ = max_of(0.0001*p->mass_of_all_*((p->EG_points_E_y_ * p->EG_points_E_y_)
        + (p->EG_points_G_y_ * p->EG_points_G_y_)), p->mass_EG_EG_);
    p->inverse_tree_metric_AG_theta_ = 1.0/p->tree_metric_AG_theta_;  /* 1/M */
    p->inverse_tree_metric_AH_theta_ = 1.0/p->tree_metric_AH_theta_;  /* 1/M */
    p->inverse_tree_metric_HE_theta_ = 1.0/p->tree_metric_HE_theta_;  /* 1/M */
    p->inverse_tree_metric_EG_theta_ = 1.0/p->tree_metric_EG_theta_;  /* 1/M */
}
