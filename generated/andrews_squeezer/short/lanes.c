/*
 * The functions that methods need, for several runs side by side (engine/batch/lanes.h): the same operations with
 * vectors for numbers. A library of its own, compiled when a batch first asks for it: as it is for rk4, with HELD for
 * methods that choose their step.
 */
#ifndef HELD
#define HELD 0
#endif
#include "model.h"
#include "engine/batch/batch.h"
#include "engine/batch/lanes.h"

/* Numbers of each run side by side, field by field those of Parameters in model.h: meanings, addresses, units too. */
typedef struct LaneParameters {
    Lanes OF_mass_;
    Lanes OF_inertia_;
    Lanes FE_mass_;
    Lanes FE_inertia_;
    Lanes BDE_mass_;
    Lanes BDE_inertia_;
    Lanes EG_mass_;
    Lanes EG_inertia_;
    Lanes AG_mass_;
    Lanes AG_inertia_;
    Lanes HE_mass_;
    Lanes HE_inertia_;
    Lanes AH_mass_;
    Lanes AH_inertia_;
    Lanes OF_points_O_x_;
    Lanes OF_points_F_x_;
    Lanes FE_points_E_x_;
    Lanes FE_points_F_x_;
    Lanes BDE_points_B_x_;
    Lanes BDE_points_B_y_;
    Lanes BDE_points_E_x_;
    Lanes BDE_points_E_y_;
    Lanes BDE_points_D_x_;
    Lanes BDE_points_D_y_;
    Lanes EG_points_G_y_;
    Lanes EG_points_E_y_;
    Lanes AG_points_A_x_;
    Lanes AG_points_A_y_;
    Lanes AG_points_G_x_;
    Lanes AG_points_G_y_;
    Lanes HE_points_H_x_;
    Lanes HE_points_E_x_;
    Lanes AH_points_A_x_;
    Lanes AH_points_A_y_;
    Lanes AH_points_H_x_;
    Lanes AH_points_H_y_;
    Lanes alpha_;
    Lanes beta_;
    Lanes B_x_;
    Lanes B_y_;
    Lanes A_x_;
    Lanes A_y_;
    Lanes C_x_;
    Lanes C_y_;
    Lanes spring_stiffness_;
    Lanes spring_free_length_;
    Lanes motor_value_;
    Lanes guess_FE_theta_;
    Lanes guess_BDE_theta_;
    Lanes guess_EG_theta_;
    Lanes guess_AG_theta_;
    Lanes guess_HE_theta_;
    Lanes guess_AH_theta_;
    Lanes set_OF_theta_;
    Lanes BDE_turning_;
    Lanes EG_turning_;
    Lanes AG_turning_;
    Lanes HE_turning_;
    Lanes AH_turning_;
    Lanes OF_turning_;
    Lanes FE_turning_;
    Lanes two_alpha_;
    Lanes beta_squared_;
    Lanes mobility_E3_x_;
    Lanes mobility_E4_x_;
    Lanes mobility_E6_x_;
    Lanes OF_com_span_x_;
    Lanes BDE_com_span_x_;
    Lanes BDE_com_span_y_;
    Lanes AG_com_span_x_;
    Lanes AG_com_span_y_;
    Lanes AH_com_span_x_;
    Lanes AH_com_span_y_;
    Lanes OF_F_span_x_;
    Lanes FE_com_span_x_;
    Lanes BDE_E_span_x_;
    Lanes BDE_E_span_y_;
    Lanes HE_com_span_x_;
    Lanes FE_E_span_x_;
    Lanes EG_com_span_y_;
    Lanes EG_G_span_y_;
    Lanes AG_G_span_x_;
    Lanes AG_G_span_y_;
    Lanes HE_H_span_x_;
    Lanes AH_H_span_x_;
    Lanes AH_H_span_y_;
    Lanes BDE_D_span_x_;
    Lanes BDE_D_span_y_;
    Lanes inertia_OF_OF_;
    Lanes inertia_OF_FE_;
    Lanes inertia_FE_FE_;
    Lanes inertia_BDE_BDE_;
    Lanes twist_OF_EG_;
    Lanes twist_FE_EG_;
    Lanes inertia_EG_EG_;
    Lanes inertia_AG_AG_;
    Lanes inertia_BDE_HE_;
    Lanes twist_BDE_HE_;
    Lanes inertia_HE_HE_;
    Lanes inertia_AH_AH_;
    Lanes mass_OF_OF_;
    Lanes mass_FE_FE_;
    Lanes mass_BDE_BDE_;
    Lanes mass_EG_EG_;
    Lanes mass_AG_AG_;
    Lanes mass_HE_HE_;
    Lanes mass_AH_AH_;
    Lanes inverse_mass_AG_AG_;
    Lanes inverse_mass_AH_AH_;
    Lanes inverse_mass_HE_HE_;
    Lanes inverse_mass_EG_EG_;
    Lanes tree_metric_OF_theta_;
    Lanes tree_metric_BDE_theta_;
    Lanes tree_metric_AG_theta_;
    Lanes tree_metric_AH_theta_;
    Lanes tree_metric_FE_theta_;
    Lanes tree_metric_HE_theta_;
    Lanes tree_metric_EG_theta_;
    Lanes inverse_tree_metric_AG_theta_;
    Lanes inverse_tree_metric_AH_theta_;
    Lanes inverse_tree_metric_HE_theta_;
    Lanes inverse_tree_metric_EG_theta_;
} LaneParameters;

_Static_assert(sizeof(LaneParameters) / sizeof(Lanes) == sizeof(Parameters) / sizeof(double), "the same numbers");

/* The penetration of joint i beyond which contact laws mean nothing, m. */
static inline Lanes lane_deepest(const LaneParameters *p, int i)
{
    (void)p;
    switch (i) {
    default:
        return all_of(0.0);
    }
}

/*
 * Phi of the loop closures in tree coordinates; m and rad.
 */
static void closures(const Lanes t, const Lanes *q, const LaneParameters *p, Lanes *out, LaneBits *rare)
{
    (void)t;
    /* coordinates, velocities, time */
    const Lanes OF_theta_ = q[0];
    const Lanes BDE_theta_ = q[1];
    const Lanes AG_theta_ = q[2];
    const Lanes AH_theta_ = q[3];
    const Lanes FE_theta_ = q[4];
    const Lanes HE_theta_ = q[5];
    const Lanes EG_theta_ = q[6];

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(OF_theta_, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(BDE_theta_, &sines_1, &cosines_1, rare);
    Lanes sines_2, cosines_2;
    sines_and_cosines(AG_theta_, &sines_2, &cosines_2, rare);
    Lanes sines_3, cosines_3;
    sines_and_cosines(AH_theta_, &sines_3, &cosines_3, rare);
    Lanes sines_4, cosines_4;
    sines_and_cosines(FE_theta_, &sines_4, &cosines_4, rare);
    Lanes sines_5, cosines_5;
    sines_and_cosines(HE_theta_, &sines_5, &cosines_5, rare);
    Lanes sines_6, cosines_6;
    sines_and_cosines(EG_theta_, &sines_6, &cosines_6, rare);
    const Lanes cos_theta_OF_ = cosines_0;
    const Lanes sin_theta_OF_ = sines_0;
    const Lanes cos_theta_BDE_ = cosines_1;
    const Lanes sin_theta_BDE_ = sines_1;
    const Lanes cos_theta_AG_ = cosines_2;
    const Lanes sin_theta_AG_ = sines_2;
    const Lanes cos_theta_AH_ = cosines_3;
    const Lanes sin_theta_AH_ = sines_3;
    const Lanes cos_theta_FE_ = cosines_4;
    const Lanes sin_theta_FE_ = sines_4;
    const Lanes cos_theta_HE_ = cosines_5;
    const Lanes sin_theta_HE_ = sines_5;
    const Lanes cos_theta_EG_ = cosines_6;
    const Lanes sin_theta_EG_ = sines_6;
    const Lanes span_OF_F_x_ = p->OF_F_span_x_*cos_theta_OF_;
    const Lanes span_OF_F_y_ = p->OF_F_span_x_*sin_theta_OF_;
    const Lanes span_BDE_E_x_ = p->BDE_E_span_x_*cos_theta_BDE_ - p->BDE_E_span_y_*sin_theta_BDE_;
    const Lanes span_BDE_E_y_ = p->BDE_E_span_x_*sin_theta_BDE_ + p->BDE_E_span_y_*cos_theta_BDE_;
    const Lanes span_FE_E_x_ = p->FE_E_span_x_*cos_theta_FE_;
    const Lanes span_FE_E_y_ = p->FE_E_span_x_*sin_theta_FE_;
    const Lanes span_EG_G_x_ = -p->EG_G_span_y_*sin_theta_EG_;
    const Lanes span_EG_G_y_ = p->EG_G_span_y_*cos_theta_EG_;
    const Lanes span_AG_G_x_ = p->AG_G_span_x_*cos_theta_AG_ - p->AG_G_span_y_*sin_theta_AG_;
    const Lanes span_AG_G_y_ = p->AG_G_span_x_*sin_theta_AG_ + p->AG_G_span_y_*cos_theta_AG_;
    const Lanes span_HE_H_x_ = p->HE_H_span_x_*cos_theta_HE_;
    const Lanes span_HE_H_y_ = p->HE_H_span_x_*sin_theta_HE_;
    const Lanes span_AH_H_x_ = p->AH_H_span_x_*cos_theta_AH_ - p->AH_H_span_y_*sin_theta_AH_;
    const Lanes span_AH_H_y_ = p->AH_H_span_x_*sin_theta_AH_ + p->AH_H_span_y_*cos_theta_AH_;

    /* rows */
    out[0] = -p->A_x_ - span_AG_G_x_ + span_EG_G_x_ + span_FE_E_x_ + span_OF_F_x_;  /* G.x */
    out[1] = -p->A_y_ - span_AG_G_y_ + span_EG_G_y_ + span_FE_E_y_ + span_OF_F_y_;  /* G.y */
    out[2] = -p->A_x_ + p->B_x_ - span_AH_H_x_ + span_BDE_E_x_ + span_HE_H_x_;  /* H.x */
    out[3] = -p->A_y_ + p->B_y_ - span_AH_H_y_ + span_BDE_E_y_ + span_HE_H_y_;  /* H.y */
    out[4] = -p->B_x_ - span_BDE_E_x_ + span_FE_E_x_ + span_OF_F_x_;  /* E3.x */
    out[5] = -p->B_y_ - span_BDE_E_y_ + span_FE_E_y_ + span_OF_F_y_;  /* E3.y */
}

/*
 * Its rate Phi_q v - nu.
 */
static void closure_rates(const Lanes t, const Lanes *q, const Lanes *v, const LaneParameters *p, Lanes *out,
    LaneBits *rare)
{
    (void)t;
    /* coordinates, velocities, time */
    const Lanes OF_theta_ = q[0];
    const Lanes OF_omega_ = v[0];
    const Lanes BDE_theta_ = q[1];
    const Lanes BDE_omega_ = v[1];
    const Lanes AG_theta_ = q[2];
    const Lanes AG_omega_ = v[2];
    const Lanes AH_theta_ = q[3];
    const Lanes AH_omega_ = v[3];
    const Lanes FE_theta_ = q[4];
    const Lanes FE_omega_ = v[4];
    const Lanes HE_theta_ = q[5];
    const Lanes HE_omega_ = v[5];
    const Lanes EG_theta_ = q[6];
    const Lanes EG_omega_ = v[6];

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(OF_theta_, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(BDE_theta_, &sines_1, &cosines_1, rare);
    Lanes sines_2, cosines_2;
    sines_and_cosines(AG_theta_, &sines_2, &cosines_2, rare);
    Lanes sines_3, cosines_3;
    sines_and_cosines(AH_theta_, &sines_3, &cosines_3, rare);
    Lanes sines_4, cosines_4;
    sines_and_cosines(FE_theta_, &sines_4, &cosines_4, rare);
    Lanes sines_5, cosines_5;
    sines_and_cosines(HE_theta_, &sines_5, &cosines_5, rare);
    Lanes sines_6, cosines_6;
    sines_and_cosines(EG_theta_, &sines_6, &cosines_6, rare);
    const Lanes cos_theta_OF_ = cosines_0;
    const Lanes sin_theta_OF_ = sines_0;
    const Lanes cos_theta_BDE_ = cosines_1;
    const Lanes sin_theta_BDE_ = sines_1;
    const Lanes cos_theta_AG_ = cosines_2;
    const Lanes sin_theta_AG_ = sines_2;
    const Lanes cos_theta_AH_ = cosines_3;
    const Lanes sin_theta_AH_ = sines_3;
    const Lanes cos_theta_FE_ = cosines_4;
    const Lanes sin_theta_FE_ = sines_4;
    const Lanes cos_theta_HE_ = cosines_5;
    const Lanes sin_theta_HE_ = sines_5;
    const Lanes cos_theta_EG_ = cosines_6;
    const Lanes sin_theta_EG_ = sines_6;
    const Lanes span_OF_F_x_ = p->OF_F_span_x_*cos_theta_OF_;
    const Lanes span_OF_F_y_ = p->OF_F_span_x_*sin_theta_OF_;
    const Lanes span_BDE_E_x_ = p->BDE_E_span_x_*cos_theta_BDE_ - p->BDE_E_span_y_*sin_theta_BDE_;
    const Lanes span_BDE_E_y_ = p->BDE_E_span_x_*sin_theta_BDE_ + p->BDE_E_span_y_*cos_theta_BDE_;
    const Lanes span_FE_E_x_ = p->FE_E_span_x_*cos_theta_FE_;
    const Lanes span_FE_E_y_ = p->FE_E_span_x_*sin_theta_FE_;
    const Lanes span_EG_G_x_ = -p->EG_G_span_y_*sin_theta_EG_;
    const Lanes span_EG_G_y_ = p->EG_G_span_y_*cos_theta_EG_;
    const Lanes span_AG_G_x_ = p->AG_G_span_x_*cos_theta_AG_ - p->AG_G_span_y_*sin_theta_AG_;
    const Lanes span_AG_G_y_ = p->AG_G_span_x_*sin_theta_AG_ + p->AG_G_span_y_*cos_theta_AG_;
    const Lanes span_HE_H_x_ = p->HE_H_span_x_*cos_theta_HE_;
    const Lanes span_HE_H_y_ = p->HE_H_span_x_*sin_theta_HE_;
    const Lanes span_AH_H_x_ = p->AH_H_span_x_*cos_theta_AH_ - p->AH_H_span_y_*sin_theta_AH_;
    const Lanes span_AH_H_y_ = p->AH_H_span_x_*sin_theta_AH_ + p->AH_H_span_y_*cos_theta_AH_;

    /* rows */
    /* G.x */
    out[0] = AG_omega_*span_AG_G_y_ - EG_omega_*span_EG_G_y_ - FE_omega_*span_FE_E_y_ - OF_omega_*span_OF_F_y_;
    /* G.y */
    out[1] = -AG_omega_*span_AG_G_x_ + EG_omega_*span_EG_G_x_ + FE_omega_*span_FE_E_x_ + OF_omega_*span_OF_F_x_;
    out[2] = AH_omega_*span_AH_H_y_ - BDE_omega_*span_BDE_E_y_ - HE_omega_*span_HE_H_y_;  /* H.x */
    out[3] = -AH_omega_*span_AH_H_x_ + BDE_omega_*span_BDE_E_x_ + HE_omega_*span_HE_H_x_;  /* H.y */
    out[4] = BDE_omega_*span_BDE_E_y_ - FE_omega_*span_FE_E_y_ - OF_omega_*span_OF_F_y_;  /* E3.x */
    out[5] = -BDE_omega_*span_BDE_E_x_ + FE_omega_*span_FE_E_x_ + OF_omega_*span_OF_F_x_;  /* E3.y */
}

/*
 * Accelerations a of the tree's coordinates q, and the closures' multipliers in `aside`:
 * [M Phi_q^T; Phi_q 0][a; lambda] = [g; gamma] with M, Phi_q, g in these coordinates; drifts are projected away.
 * Returns 0, or the number of the pivot that vanished where the rows contradict each other.
 */
static void reduced_dynamics(const Lanes t, const Lanes *q, const Lanes *v, const LaneMemory *memory,
    const LaneParameters *p, Lanes *a, LaneAside *aside, LaneBits *rare)
{
    (void)t;
    /* coordinates, velocities, time */
    const Lanes OF_theta_ = q[0];
    const Lanes OF_omega_ = v[0];
    const Lanes BDE_theta_ = q[1];
    const Lanes BDE_omega_ = v[1];
    const Lanes AG_theta_ = q[2];
    const Lanes AG_omega_ = v[2];
    const Lanes AH_theta_ = q[3];
    const Lanes AH_omega_ = v[3];
    const Lanes FE_theta_ = q[4];
    const Lanes FE_omega_ = v[4];
    const Lanes HE_theta_ = q[5];
    const Lanes HE_omega_ = v[5];
    const Lanes EG_theta_ = q[6];
    const Lanes EG_omega_ = v[6];

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(OF_theta_, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(BDE_theta_, &sines_1, &cosines_1, rare);
    Lanes sines_2, cosines_2;
    sines_and_cosines(AG_theta_, &sines_2, &cosines_2, rare);
    Lanes sines_3, cosines_3;
    sines_and_cosines(AH_theta_, &sines_3, &cosines_3, rare);
    Lanes sines_4, cosines_4;
    sines_and_cosines(FE_theta_, &sines_4, &cosines_4, rare);
    Lanes sines_5, cosines_5;
    sines_and_cosines(HE_theta_, &sines_5, &cosines_5, rare);
    Lanes sines_6, cosines_6;
    sines_and_cosines(EG_theta_, &sines_6, &cosines_6, rare);
    const Lanes cos_theta_OF_ = cosines_0;
    const Lanes sin_theta_OF_ = sines_0;
    const Lanes cos_theta_BDE_ = cosines_1;
    const Lanes sin_theta_BDE_ = sines_1;
    const Lanes cos_theta_AG_ = cosines_2;
    const Lanes sin_theta_AG_ = sines_2;
    const Lanes cos_theta_AH_ = cosines_3;
    const Lanes sin_theta_AH_ = sines_3;
    const Lanes cos_theta_FE_ = cosines_4;
    const Lanes sin_theta_FE_ = sines_4;
    const Lanes cos_theta_HE_ = cosines_5;
    const Lanes sin_theta_HE_ = sines_5;
    const Lanes cos_theta_EG_ = cosines_6;
    const Lanes sin_theta_EG_ = sines_6;
    const Lanes span_OF_F_x_ = p->OF_F_span_x_*cos_theta_OF_;
    const Lanes span_OF_F_y_ = p->OF_F_span_x_*sin_theta_OF_;
    const Lanes span_BDE_E_x_ = p->BDE_E_span_x_*cos_theta_BDE_ - p->BDE_E_span_y_*sin_theta_BDE_;
    const Lanes span_BDE_E_y_ = p->BDE_E_span_x_*sin_theta_BDE_ + p->BDE_E_span_y_*cos_theta_BDE_;
    const Lanes span_FE_E_x_ = p->FE_E_span_x_*cos_theta_FE_;
    const Lanes span_FE_E_y_ = p->FE_E_span_x_*sin_theta_FE_;
    const Lanes span_EG_G_x_ = -p->EG_G_span_y_*sin_theta_EG_;
    const Lanes span_EG_G_y_ = p->EG_G_span_y_*cos_theta_EG_;
    const Lanes span_AG_G_x_ = p->AG_G_span_x_*cos_theta_AG_ - p->AG_G_span_y_*sin_theta_AG_;
    const Lanes span_AG_G_y_ = p->AG_G_span_x_*sin_theta_AG_ + p->AG_G_span_y_*cos_theta_AG_;
    const Lanes span_HE_H_x_ = p->HE_H_span_x_*cos_theta_HE_;
    const Lanes span_HE_H_y_ = p->HE_H_span_x_*sin_theta_HE_;
    const Lanes span_AH_H_x_ = p->AH_H_span_x_*cos_theta_AH_ - p->AH_H_span_y_*sin_theta_AH_;
    const Lanes span_AH_H_y_ = p->AH_H_span_x_*sin_theta_AH_ + p->AH_H_span_y_*cos_theta_AH_;
    const Lanes span_BDE_D_x_ = p->BDE_D_span_x_*cos_theta_BDE_ - p->BDE_D_span_y_*sin_theta_BDE_;
    const Lanes span_BDE_D_y_ = p->BDE_D_span_x_*sin_theta_BDE_ + p->BDE_D_span_y_*cos_theta_BDE_;
    const Lanes BDE_D_x_ = p->B_x_ + span_BDE_D_x_;
    const Lanes BDE_D_y_ = p->B_y_ + span_BDE_D_y_;
    const Lanes spring_span_x_ = BDE_D_x_ - p->C_x_;
    const Lanes spring_span_y_ = BDE_D_y_ - p->C_y_;
    const Lanes spring_length_ = lanes_sqrt((spring_span_x_ * spring_span_x_) + (spring_span_y_ * spring_span_y_));
    const Lanes spring_force_ = p->spring_stiffness_*(-p->spring_free_length_ + spring_length_);
    const Lanes spring_pull_ = spring_force_/spring_length_;
    const Lanes cos_FE_less_OF_ = cos_theta_FE_*cos_theta_OF_ + sin_theta_FE_*sin_theta_OF_;
    const Lanes sin_FE_less_OF_ = -cos_theta_FE_*sin_theta_OF_ + cos_theta_OF_*sin_theta_FE_;
    const Lanes dot_OF_FE_ = cos_FE_less_OF_*p->inertia_OF_FE_;
    const Lanes cross_OF_FE_ = p->inertia_OF_FE_*sin_FE_less_OF_;
    const Lanes cos_EG_less_OF_ = cos_theta_EG_*cos_theta_OF_ + sin_theta_EG_*sin_theta_OF_;
    const Lanes sin_EG_less_OF_ = -cos_theta_EG_*sin_theta_OF_ + cos_theta_OF_*sin_theta_EG_;
    const Lanes dot_OF_EG_ = -sin_EG_less_OF_*p->twist_OF_EG_;
    const Lanes cross_OF_EG_ = cos_EG_less_OF_*p->twist_OF_EG_;
    const Lanes cos_EG_less_FE_ = cos_theta_EG_*cos_theta_FE_ + sin_theta_EG_*sin_theta_FE_;
    const Lanes sin_EG_less_FE_ = -cos_theta_EG_*sin_theta_FE_ + cos_theta_FE_*sin_theta_EG_;
    const Lanes dot_FE_EG_ = -sin_EG_less_FE_*p->twist_FE_EG_;
    const Lanes cross_FE_EG_ = cos_EG_less_FE_*p->twist_FE_EG_;
    const Lanes cos_HE_less_BDE_ = cos_theta_BDE_*cos_theta_HE_ + sin_theta_BDE_*sin_theta_HE_;
    const Lanes sin_HE_less_BDE_ = cos_theta_BDE_*sin_theta_HE_ - cos_theta_HE_*sin_theta_BDE_;
    const Lanes dot_BDE_HE_ = cos_HE_less_BDE_*p->inertia_BDE_HE_ - sin_HE_less_BDE_*p->twist_BDE_HE_;
    const Lanes cross_BDE_HE_ = cos_HE_less_BDE_*p->twist_BDE_HE_ + p->inertia_BDE_HE_*sin_HE_less_BDE_;

    /* constraints: gamma */
    const Lanes rhs_G_x_ = -(AG_omega_ * AG_omega_)*span_AG_G_x_ + (EG_omega_ * EG_omega_)*span_EG_G_x_
        + (FE_omega_ * FE_omega_)*span_FE_E_x_ + (OF_omega_ * OF_omega_)*span_OF_F_x_;
    const Lanes rhs_G_y_ = -(AG_omega_ * AG_omega_)*span_AG_G_y_ + (EG_omega_ * EG_omega_)*span_EG_G_y_
        + (FE_omega_ * FE_omega_)*span_FE_E_y_ + (OF_omega_ * OF_omega_)*span_OF_F_y_;
    const Lanes rhs_H_x_ = -(AH_omega_ * AH_omega_)*span_AH_H_x_ + (BDE_omega_ * BDE_omega_)*span_BDE_E_x_
        + (HE_omega_ * HE_omega_)*span_HE_H_x_;
    const Lanes rhs_H_y_ = -(AH_omega_ * AH_omega_)*span_AH_H_y_ + (BDE_omega_ * BDE_omega_)*span_BDE_E_y_
        + (HE_omega_ * HE_omega_)*span_HE_H_y_;
    const Lanes rhs_E3_x_ = -(BDE_omega_ * BDE_omega_)*span_BDE_E_x_ + (FE_omega_ * FE_omega_)*span_FE_E_x_
        + (OF_omega_ * OF_omega_)*span_OF_F_x_;
    const Lanes rhs_E3_y_ = -(BDE_omega_ * BDE_omega_)*span_BDE_E_y_ + (FE_omega_ * FE_omega_)*span_FE_E_y_
        + (OF_omega_ * OF_omega_)*span_OF_F_y_;

    /* L D L^T of the KKT matrix */
    *rare |= ~(p->mass_AG_AG_ > LIGHT_PIVOT * p->AG_turning_);
    const Lanes l_G_x_AG_theta_ = p->inverse_mass_AG_AG_*span_AG_G_y_;
    const Lanes l_G_y_AG_theta_ = -p->inverse_mass_AG_AG_*span_AG_G_x_;
    *rare |= ~(p->mass_AH_AH_ > LIGHT_PIVOT * p->AH_turning_);
    const Lanes l_H_x_AH_theta_ = p->inverse_mass_AH_AH_*span_AH_H_y_;
    const Lanes l_H_y_AH_theta_ = -p->inverse_mass_AH_AH_*span_AH_H_x_;
    *rare |= ~(p->mass_HE_HE_ > LIGHT_PIVOT * p->HE_turning_);
    const Lanes l_H_x_HE_theta_ = -p->inverse_mass_HE_HE_*span_HE_H_y_;
    const Lanes l_H_y_HE_theta_ = p->inverse_mass_HE_HE_*span_HE_H_x_;
    const Lanes l_BDE_theta_HE_theta_ = dot_BDE_HE_*p->inverse_mass_HE_HE_;
    const Lanes scale_H_x_ = l_H_x_AH_theta_*span_AH_H_y_ - l_H_x_HE_theta_*span_HE_H_y_;
    const Lanes scale_H_y_ = -l_H_y_AH_theta_*span_AH_H_x_ + l_H_y_HE_theta_*span_HE_H_x_;
    const Lanes pivot_H_x_H_y_ = l_H_y_AH_theta_*span_AH_H_y_ - l_H_y_HE_theta_*span_HE_H_y_;
    const Lanes determinant_H_x_H_y_ = -(pivot_H_x_H_y_ * pivot_H_x_H_y_) + scale_H_x_*scale_H_y_;
    *rare |= ~((scale_H_x_ > 0.0) & (scale_H_x_ < INFINITY));
    *rare |= ~(determinant_H_x_H_y_ > EARLY * scale_H_y_ * scale_H_x_);
    const Lanes size_H_x_ = scale_H_x_ + scale_H_y_;
    *rare |= ~(scale_H_x_ > memory->least_size * size_H_x_);
    *rare |= ~(determinant_H_x_H_y_ > memory->least_size * size_H_x_ * scale_H_x_);
    const Lanes inverse_H_x_H_y_ = -1.0/determinant_H_x_H_y_;
    const Lanes inverse_pivot_H_x_ = inverse_H_x_H_y_*scale_H_y_;
    const Lanes inverse_pivot_H_y_ = inverse_H_x_H_y_*scale_H_x_;
    const Lanes inverse_cross_H_x_H_y_ = -inverse_H_x_H_y_*pivot_H_x_H_y_;
    const Lanes w_BDE_theta_H_x_ = l_BDE_theta_HE_theta_*span_HE_H_y_ - span_BDE_E_y_;
    const Lanes w_BDE_theta_H_y_ = -l_BDE_theta_HE_theta_*span_HE_H_x_ + span_BDE_E_x_;
    const Lanes l_BDE_theta_H_x_ = inverse_cross_H_x_H_y_*w_BDE_theta_H_y_ + inverse_pivot_H_x_*w_BDE_theta_H_x_;
    const Lanes l_BDE_theta_H_y_ = inverse_cross_H_x_H_y_*w_BDE_theta_H_x_ + inverse_pivot_H_y_*w_BDE_theta_H_y_;
    const Lanes pivot_BDE_theta_ = -dot_BDE_HE_*l_BDE_theta_HE_theta_ - l_BDE_theta_H_x_*w_BDE_theta_H_x_
        - l_BDE_theta_H_y_*w_BDE_theta_H_y_ + p->mass_BDE_BDE_;
    *rare |= ~(pivot_BDE_theta_ > LIGHT_PIVOT * p->BDE_turning_);
    const Lanes inverse_pivot_BDE_theta_ = 1.0/pivot_BDE_theta_;
    const Lanes l_E3_x_BDE_theta_ = inverse_pivot_BDE_theta_*span_BDE_E_y_;
    const Lanes l_E3_y_BDE_theta_ = -inverse_pivot_BDE_theta_*span_BDE_E_x_;
    *rare |= ~(p->mass_EG_EG_ > LIGHT_PIVOT * p->EG_turning_);
    const Lanes l_G_x_EG_theta_ = -p->inverse_mass_EG_EG_*span_EG_G_y_;
    const Lanes l_G_y_EG_theta_ = p->inverse_mass_EG_EG_*span_EG_G_x_;
    const Lanes l_OF_theta_EG_theta_ = dot_OF_EG_*p->inverse_mass_EG_EG_;
    const Lanes l_FE_theta_EG_theta_ = dot_FE_EG_*p->inverse_mass_EG_EG_;
    const Lanes scale_G_x_ = l_G_x_AG_theta_*span_AG_G_y_ - l_G_x_EG_theta_*span_EG_G_y_;
    const Lanes scale_G_y_ = -l_G_y_AG_theta_*span_AG_G_x_ + l_G_y_EG_theta_*span_EG_G_x_;
    const Lanes pivot_G_x_G_y_ = l_G_y_AG_theta_*span_AG_G_y_ - l_G_y_EG_theta_*span_EG_G_y_;
    const Lanes determinant_G_x_G_y_ = -(pivot_G_x_G_y_ * pivot_G_x_G_y_) + scale_G_x_*scale_G_y_;
    *rare |= ~((scale_G_x_ > 0.0) & (scale_G_x_ < INFINITY));
    *rare |= ~(determinant_G_x_G_y_ > EARLY * scale_G_y_ * scale_G_x_);
    const Lanes size_G_x_ = scale_G_x_ + scale_G_y_;
    *rare |= ~(scale_G_x_ > memory->least_size * size_G_x_);
    *rare |= ~(determinant_G_x_G_y_ > memory->least_size * size_G_x_ * scale_G_x_);
    const Lanes inverse_G_x_G_y_ = -1.0/determinant_G_x_G_y_;
    const Lanes inverse_pivot_G_x_ = inverse_G_x_G_y_*scale_G_y_;
    const Lanes inverse_pivot_G_y_ = inverse_G_x_G_y_*scale_G_x_;
    const Lanes inverse_cross_G_x_G_y_ = -inverse_G_x_G_y_*pivot_G_x_G_y_;
    const Lanes w_OF_theta_G_x_ = l_OF_theta_EG_theta_*span_EG_G_y_ - span_OF_F_y_;
    const Lanes w_OF_theta_G_y_ = -l_OF_theta_EG_theta_*span_EG_G_x_ + span_OF_F_x_;
    const Lanes l_OF_theta_G_x_ = inverse_cross_G_x_G_y_*w_OF_theta_G_y_ + inverse_pivot_G_x_*w_OF_theta_G_x_;
    const Lanes l_OF_theta_G_y_ = inverse_cross_G_x_G_y_*w_OF_theta_G_x_ + inverse_pivot_G_y_*w_OF_theta_G_y_;
    const Lanes w_FE_theta_G_x_ = l_FE_theta_EG_theta_*span_EG_G_y_ - span_FE_E_y_;
    const Lanes w_FE_theta_G_y_ = -l_FE_theta_EG_theta_*span_EG_G_x_ + span_FE_E_x_;
    const Lanes l_FE_theta_G_x_ = inverse_cross_G_x_G_y_*w_FE_theta_G_y_ + inverse_pivot_G_x_*w_FE_theta_G_x_;
    const Lanes l_FE_theta_G_y_ = inverse_cross_G_x_G_y_*w_FE_theta_G_x_ + inverse_pivot_G_y_*w_FE_theta_G_y_;
    const Lanes pivot_OF_theta_ = -dot_OF_EG_*l_OF_theta_EG_theta_ - l_OF_theta_G_x_*w_OF_theta_G_x_
        - l_OF_theta_G_y_*w_OF_theta_G_y_ + p->mass_OF_OF_;
    const Lanes pivot_FE_theta_ = -dot_FE_EG_*l_FE_theta_EG_theta_ - l_FE_theta_G_x_*w_FE_theta_G_x_
        - l_FE_theta_G_y_*w_FE_theta_G_y_ + p->mass_FE_FE_;
    const Lanes pivot_OF_theta_FE_theta_ = -dot_OF_EG_*l_FE_theta_EG_theta_ + dot_OF_FE_
        - l_FE_theta_G_x_*w_OF_theta_G_x_ - l_FE_theta_G_y_*w_OF_theta_G_y_;
    const Lanes determinant_OF_theta_FE_theta_ = pivot_FE_theta_*pivot_OF_theta_
        - (pivot_OF_theta_FE_theta_ * pivot_OF_theta_FE_theta_);
    *rare |= ~(pivot_OF_theta_ > LIGHT_PIVOT * p->OF_turning_);
    *rare |= ~(determinant_OF_theta_FE_theta_ > LIGHT_PIVOT * p->FE_turning_ * pivot_OF_theta_);
    const Lanes inverse_OF_theta_FE_theta_ = 1.0/determinant_OF_theta_FE_theta_;
    const Lanes inverse_pivot_OF_theta_ = inverse_OF_theta_FE_theta_*pivot_FE_theta_;
    const Lanes inverse_pivot_FE_theta_ = inverse_OF_theta_FE_theta_*pivot_OF_theta_;
    const Lanes inverse_cross_OF_theta_FE_theta_ = -inverse_OF_theta_FE_theta_*pivot_OF_theta_FE_theta_;
    const Lanes l_E3_x_OF_theta_ = -inverse_cross_OF_theta_FE_theta_*span_FE_E_y_
        - inverse_pivot_OF_theta_*span_OF_F_y_;
    const Lanes l_E3_x_FE_theta_ = -inverse_cross_OF_theta_FE_theta_*span_OF_F_y_
        - inverse_pivot_FE_theta_*span_FE_E_y_;
    const Lanes l_E3_y_OF_theta_ = inverse_cross_OF_theta_FE_theta_*span_FE_E_x_ + inverse_pivot_OF_theta_*span_OF_F_x_;
    const Lanes l_E3_y_FE_theta_ = inverse_cross_OF_theta_FE_theta_*span_OF_F_x_ + inverse_pivot_FE_theta_*span_FE_E_x_;
    const Lanes scale_E3_x_ = l_E3_x_BDE_theta_*span_BDE_E_y_ - l_E3_x_FE_theta_*span_FE_E_y_
        - l_E3_x_OF_theta_*span_OF_F_y_;
    const Lanes scale_E3_y_ = -l_E3_y_BDE_theta_*span_BDE_E_x_ + l_E3_y_FE_theta_*span_FE_E_x_
        + l_E3_y_OF_theta_*span_OF_F_x_;
    const Lanes pivot_E3_x_E3_y_ = l_E3_y_BDE_theta_*span_BDE_E_y_ - l_E3_y_FE_theta_*span_FE_E_y_
        - l_E3_y_OF_theta_*span_OF_F_y_;
    const Lanes determinant_E3_x_E3_y_ = -(pivot_E3_x_E3_y_ * pivot_E3_x_E3_y_) + scale_E3_x_*scale_E3_y_;
    *rare |= ~((scale_E3_x_ > 0.0) & (scale_E3_x_ < INFINITY));
    *rare |= ~(determinant_E3_x_E3_y_ > memory->least * scale_E3_y_ * scale_E3_x_);
    const Lanes size_E3_x_ = scale_E3_x_ + scale_E3_y_;
    *rare |= ~(scale_E3_x_ > memory->least_size * size_E3_x_);
    *rare |= ~(determinant_E3_x_E3_y_ > memory->least_size * size_E3_x_ * scale_E3_x_);
    const Lanes inverse_E3_x_E3_y_ = -1.0/determinant_E3_x_E3_y_;
    const Lanes inverse_pivot_E3_x_ = inverse_E3_x_E3_y_*scale_E3_y_;
    const Lanes inverse_pivot_E3_y_ = inverse_E3_x_E3_y_*scale_E3_x_;
    const Lanes inverse_cross_E3_x_E3_y_ = -inverse_E3_x_E3_y_*pivot_E3_x_E3_y_;

    /* forward substitution */
    const Lanes z_HE_theta_ = -(BDE_omega_ * BDE_omega_)*cross_BDE_HE_;
    const Lanes z_H_x_ = -l_H_x_HE_theta_*z_HE_theta_ + rhs_H_x_;
    const Lanes z_H_y_ = -l_H_y_HE_theta_*z_HE_theta_ + rhs_H_y_;
    const Lanes z_BDE_theta_ = (HE_omega_ * HE_omega_)*cross_BDE_HE_ - l_BDE_theta_HE_theta_*z_HE_theta_
        - l_BDE_theta_H_x_*z_H_x_ - l_BDE_theta_H_y_*z_H_y_ - span_BDE_D_x_*spring_pull_*spring_span_y_
        + span_BDE_D_y_*spring_pull_*spring_span_x_;
    const Lanes z_EG_theta_ = -(FE_omega_ * FE_omega_)*cross_FE_EG_ - (OF_omega_ * OF_omega_)*cross_OF_EG_;
    const Lanes z_G_x_ = -l_G_x_EG_theta_*z_EG_theta_ + rhs_G_x_;
    const Lanes z_G_y_ = -l_G_y_EG_theta_*z_EG_theta_ + rhs_G_y_;
    const Lanes z_OF_theta_ = (EG_omega_ * EG_omega_)*cross_OF_EG_ + (FE_omega_ * FE_omega_)*cross_OF_FE_
        - l_OF_theta_EG_theta_*z_EG_theta_ - l_OF_theta_G_x_*z_G_x_ - l_OF_theta_G_y_*z_G_y_ + p->motor_value_;
    const Lanes z_FE_theta_ = (EG_omega_ * EG_omega_)*cross_FE_EG_ - (OF_omega_ * OF_omega_)*cross_OF_FE_
        - l_FE_theta_EG_theta_*z_EG_theta_ - l_FE_theta_G_x_*z_G_x_ - l_FE_theta_G_y_*z_G_y_;
    const Lanes z_E3_x_ = -l_E3_x_BDE_theta_*z_BDE_theta_ - l_E3_x_FE_theta_*z_FE_theta_ - l_E3_x_OF_theta_*z_OF_theta_
        + rhs_E3_x_;
    const Lanes z_E3_y_ = -l_E3_y_BDE_theta_*z_BDE_theta_ - l_E3_y_FE_theta_*z_FE_theta_ - l_E3_y_OF_theta_*z_OF_theta_
        + rhs_E3_y_;

    /* backward substitution */
    const Lanes lambda_E3_y_ = inverse_cross_E3_x_E3_y_*z_E3_x_ + inverse_pivot_E3_y_*z_E3_y_;
    const Lanes lambda_E3_x_ = inverse_cross_E3_x_E3_y_*z_E3_y_ + inverse_pivot_E3_x_*z_E3_x_;
    const Lanes acceleration_FE_theta_ = inverse_cross_OF_theta_FE_theta_*z_OF_theta_
        + inverse_pivot_FE_theta_*z_FE_theta_ - l_E3_x_FE_theta_*lambda_E3_x_ - l_E3_y_FE_theta_*lambda_E3_y_;
    const Lanes acceleration_OF_theta_ = inverse_cross_OF_theta_FE_theta_*z_FE_theta_
        + inverse_pivot_OF_theta_*z_OF_theta_ - l_E3_x_OF_theta_*lambda_E3_x_ - l_E3_y_OF_theta_*lambda_E3_y_;
    const Lanes lambda_G_y_ = -acceleration_FE_theta_*l_FE_theta_G_y_ - acceleration_OF_theta_*l_OF_theta_G_y_
        + inverse_cross_G_x_G_y_*z_G_x_ + inverse_pivot_G_y_*z_G_y_;
    const Lanes lambda_G_x_ = -acceleration_FE_theta_*l_FE_theta_G_x_ - acceleration_OF_theta_*l_OF_theta_G_x_
        + inverse_cross_G_x_G_y_*z_G_y_ + inverse_pivot_G_x_*z_G_x_;
    const Lanes acceleration_EG_theta_ = -acceleration_FE_theta_*l_FE_theta_EG_theta_
        - acceleration_OF_theta_*l_OF_theta_EG_theta_ + p->inverse_mass_EG_EG_*z_EG_theta_
        - l_G_x_EG_theta_*lambda_G_x_ - l_G_y_EG_theta_*lambda_G_y_;
    const Lanes acceleration_BDE_theta_ = inverse_pivot_BDE_theta_*z_BDE_theta_ - l_E3_x_BDE_theta_*lambda_E3_x_
        - l_E3_y_BDE_theta_*lambda_E3_y_;
    const Lanes lambda_H_y_ = -acceleration_BDE_theta_*l_BDE_theta_H_y_ + inverse_cross_H_x_H_y_*z_H_x_
        + inverse_pivot_H_y_*z_H_y_;
    const Lanes lambda_H_x_ = -acceleration_BDE_theta_*l_BDE_theta_H_x_ + inverse_cross_H_x_H_y_*z_H_y_
        + inverse_pivot_H_x_*z_H_x_;
    const Lanes acceleration_HE_theta_ = -acceleration_BDE_theta_*l_BDE_theta_HE_theta_
        + p->inverse_mass_HE_HE_*z_HE_theta_ - l_H_x_HE_theta_*lambda_H_x_ - l_H_y_HE_theta_*lambda_H_y_;
    const Lanes acceleration_AH_theta_ = -l_H_x_AH_theta_*lambda_H_x_ - l_H_y_AH_theta_*lambda_H_y_;
    const Lanes acceleration_AG_theta_ = -l_G_x_AG_theta_*lambda_G_x_ - l_G_y_AG_theta_*lambda_G_y_;

    /* results */
    a[0] = acceleration_OF_theta_;
    a[1] = acceleration_BDE_theta_;
    a[2] = acceleration_AG_theta_;
    a[3] = acceleration_AH_theta_;
    a[4] = acceleration_FE_theta_;
    a[5] = acceleration_HE_theta_;
    a[6] = acceleration_EG_theta_;
    aside->lambda[0] = lambda_G_x_;
    aside->lambda[1] = lambda_G_y_;
    aside->lambda[2] = lambda_H_x_;
    aside->lambda[3] = lambda_H_y_;
    aside->lambda[4] = lambda_E3_x_;
    aside->lambda[5] = lambda_E3_y_;

    /* a pivot vanished: rows depend on each other here */
    aside->power[0] = all_of(0.0);
    aside->power[1] = OF_omega_*p->motor_value_;
    aside->power[2] = all_of(0.0);
}

/*
 * The smallest dq and dv (n), measured by M, with Phi_q dq = Phi and Phi_q dv = Phi_dot, to be subtracted.
 * `worst`: the largest |Phi|. Returns 0, or the number of the pivot that vanished.
 */
static void closing_step(const Lanes t, const Lanes *q, const Lanes *v, const LaneMemory *memory,
    const LaneParameters *p, Lanes *dq, Lanes *dv, Lanes *worst, LaneBits *rare)
{
    (void)t;
    /* coordinates, velocities, time */
    const Lanes OF_theta_ = q[0];
    const Lanes OF_omega_ = v[0];
    const Lanes BDE_theta_ = q[1];
    const Lanes BDE_omega_ = v[1];
    const Lanes AG_theta_ = q[2];
    const Lanes AG_omega_ = v[2];
    const Lanes AH_theta_ = q[3];
    const Lanes AH_omega_ = v[3];
    const Lanes FE_theta_ = q[4];
    const Lanes FE_omega_ = v[4];
    const Lanes HE_theta_ = q[5];
    const Lanes HE_omega_ = v[5];
    const Lanes EG_theta_ = q[6];
    const Lanes EG_omega_ = v[6];

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(OF_theta_, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(BDE_theta_, &sines_1, &cosines_1, rare);
    Lanes sines_2, cosines_2;
    sines_and_cosines(AG_theta_, &sines_2, &cosines_2, rare);
    Lanes sines_3, cosines_3;
    sines_and_cosines(AH_theta_, &sines_3, &cosines_3, rare);
    Lanes sines_4, cosines_4;
    sines_and_cosines(FE_theta_, &sines_4, &cosines_4, rare);
    Lanes sines_5, cosines_5;
    sines_and_cosines(HE_theta_, &sines_5, &cosines_5, rare);
    Lanes sines_6, cosines_6;
    sines_and_cosines(EG_theta_, &sines_6, &cosines_6, rare);
    const Lanes cos_theta_OF_ = cosines_0;
    const Lanes sin_theta_OF_ = sines_0;
    const Lanes cos_theta_BDE_ = cosines_1;
    const Lanes sin_theta_BDE_ = sines_1;
    const Lanes cos_theta_AG_ = cosines_2;
    const Lanes sin_theta_AG_ = sines_2;
    const Lanes cos_theta_AH_ = cosines_3;
    const Lanes sin_theta_AH_ = sines_3;
    const Lanes cos_theta_FE_ = cosines_4;
    const Lanes sin_theta_FE_ = sines_4;
    const Lanes cos_theta_HE_ = cosines_5;
    const Lanes sin_theta_HE_ = sines_5;
    const Lanes cos_theta_EG_ = cosines_6;
    const Lanes sin_theta_EG_ = sines_6;
    const Lanes span_OF_F_x_ = p->OF_F_span_x_*cos_theta_OF_;
    const Lanes span_OF_F_y_ = p->OF_F_span_x_*sin_theta_OF_;
    const Lanes span_BDE_E_x_ = p->BDE_E_span_x_*cos_theta_BDE_ - p->BDE_E_span_y_*sin_theta_BDE_;
    const Lanes span_BDE_E_y_ = p->BDE_E_span_x_*sin_theta_BDE_ + p->BDE_E_span_y_*cos_theta_BDE_;
    const Lanes span_FE_E_x_ = p->FE_E_span_x_*cos_theta_FE_;
    const Lanes span_FE_E_y_ = p->FE_E_span_x_*sin_theta_FE_;
    const Lanes span_EG_G_x_ = -p->EG_G_span_y_*sin_theta_EG_;
    const Lanes span_EG_G_y_ = p->EG_G_span_y_*cos_theta_EG_;
    const Lanes span_AG_G_x_ = p->AG_G_span_x_*cos_theta_AG_ - p->AG_G_span_y_*sin_theta_AG_;
    const Lanes span_AG_G_y_ = p->AG_G_span_x_*sin_theta_AG_ + p->AG_G_span_y_*cos_theta_AG_;
    const Lanes span_HE_H_x_ = p->HE_H_span_x_*cos_theta_HE_;
    const Lanes span_HE_H_y_ = p->HE_H_span_x_*sin_theta_HE_;
    const Lanes span_AH_H_x_ = p->AH_H_span_x_*cos_theta_AH_ - p->AH_H_span_y_*sin_theta_AH_;
    const Lanes span_AH_H_y_ = p->AH_H_span_x_*sin_theta_AH_ + p->AH_H_span_y_*cos_theta_AH_;
    const Lanes cos_FE_less_OF_ = cos_theta_FE_*cos_theta_OF_ + sin_theta_FE_*sin_theta_OF_;
    const Lanes dot_OF_FE_ = cos_FE_less_OF_*p->inertia_OF_FE_;
    const Lanes sin_EG_less_OF_ = -cos_theta_EG_*sin_theta_OF_ + cos_theta_OF_*sin_theta_EG_;
    const Lanes dot_OF_EG_ = -sin_EG_less_OF_*p->twist_OF_EG_;
    const Lanes sin_EG_less_FE_ = -cos_theta_EG_*sin_theta_FE_ + cos_theta_FE_*sin_theta_EG_;
    const Lanes dot_FE_EG_ = -sin_EG_less_FE_*p->twist_FE_EG_;
    const Lanes cos_HE_less_BDE_ = cos_theta_BDE_*cos_theta_HE_ + sin_theta_BDE_*sin_theta_HE_;
    const Lanes sin_HE_less_BDE_ = cos_theta_BDE_*sin_theta_HE_ - cos_theta_HE_*sin_theta_BDE_;
    const Lanes dot_BDE_HE_ = cos_HE_less_BDE_*p->inertia_BDE_HE_ - sin_HE_less_BDE_*p->twist_BDE_HE_;

    /* Phi and Phi_dot */
    const Lanes phi_G_x_ = -p->A_x_ - span_AG_G_x_ + span_EG_G_x_ + span_FE_E_x_ + span_OF_F_x_;
    const Lanes phi_dot_G_x_ = AG_omega_*span_AG_G_y_ - EG_omega_*span_EG_G_y_ - FE_omega_*span_FE_E_y_
        - OF_omega_*span_OF_F_y_;
    const Lanes phi_G_y_ = -p->A_y_ - span_AG_G_y_ + span_EG_G_y_ + span_FE_E_y_ + span_OF_F_y_;
    const Lanes phi_dot_G_y_ = -AG_omega_*span_AG_G_x_ + EG_omega_*span_EG_G_x_ + FE_omega_*span_FE_E_x_
        + OF_omega_*span_OF_F_x_;
    const Lanes phi_H_x_ = -p->A_x_ + p->B_x_ - span_AH_H_x_ + span_BDE_E_x_ + span_HE_H_x_;
    const Lanes phi_dot_H_x_ = AH_omega_*span_AH_H_y_ - BDE_omega_*span_BDE_E_y_ - HE_omega_*span_HE_H_y_;
    const Lanes phi_H_y_ = -p->A_y_ + p->B_y_ - span_AH_H_y_ + span_BDE_E_y_ + span_HE_H_y_;
    const Lanes phi_dot_H_y_ = -AH_omega_*span_AH_H_x_ + BDE_omega_*span_BDE_E_x_ + HE_omega_*span_HE_H_x_;
    const Lanes phi_E3_x_ = -p->B_x_ - span_BDE_E_x_ + span_FE_E_x_ + span_OF_F_x_;
    const Lanes phi_dot_E3_x_ = BDE_omega_*span_BDE_E_y_ - FE_omega_*span_FE_E_y_ - OF_omega_*span_OF_F_y_;
    const Lanes phi_E3_y_ = -p->B_y_ - span_BDE_E_y_ + span_FE_E_y_ + span_OF_F_y_;
    const Lanes phi_dot_E3_y_ = -BDE_omega_*span_BDE_E_x_ + FE_omega_*span_FE_E_x_ + OF_omega_*span_OF_F_x_;

    /* L D L^T of the KKT matrix */
    const Lanes l_G_x_AG_theta_ = p->inverse_tree_metric_AG_theta_*span_AG_G_y_;
    const Lanes l_G_y_AG_theta_ = -p->inverse_tree_metric_AG_theta_*span_AG_G_x_;
    const Lanes l_H_x_AH_theta_ = p->inverse_tree_metric_AH_theta_*span_AH_H_y_;
    const Lanes l_H_y_AH_theta_ = -p->inverse_tree_metric_AH_theta_*span_AH_H_x_;
    const Lanes l_BDE_theta_HE_theta_ = dot_BDE_HE_*p->inverse_tree_metric_HE_theta_;
    const Lanes l_H_x_HE_theta_ = -p->inverse_tree_metric_HE_theta_*span_HE_H_y_;
    const Lanes l_H_y_HE_theta_ = p->inverse_tree_metric_HE_theta_*span_HE_H_x_;
    const Lanes inverse_pivot_BDE_theta_ = 1.0/(-dot_BDE_HE_*l_BDE_theta_HE_theta_ + p->tree_metric_BDE_theta_);
    const Lanes w_H_x_BDE_theta_ = -dot_BDE_HE_*l_H_x_HE_theta_ - span_BDE_E_y_;
    const Lanes l_H_x_BDE_theta_ = inverse_pivot_BDE_theta_*w_H_x_BDE_theta_;
    const Lanes w_H_y_BDE_theta_ = -dot_BDE_HE_*l_H_y_HE_theta_ + span_BDE_E_x_;
    const Lanes l_H_y_BDE_theta_ = inverse_pivot_BDE_theta_*w_H_y_BDE_theta_;
    const Lanes l_E3_x_BDE_theta_ = inverse_pivot_BDE_theta_*span_BDE_E_y_;
    const Lanes l_E3_y_BDE_theta_ = -inverse_pivot_BDE_theta_*span_BDE_E_x_;
    const Lanes scale_H_x_ = l_H_x_AH_theta_*span_AH_H_y_ + l_H_x_BDE_theta_*w_H_x_BDE_theta_
        - l_H_x_HE_theta_*span_HE_H_y_;
    const Lanes scale_H_y_ = -l_H_y_AH_theta_*span_AH_H_x_ + l_H_y_BDE_theta_*w_H_y_BDE_theta_
        + l_H_y_HE_theta_*span_HE_H_x_;
    const Lanes pivot_H_x_H_y_ = l_H_y_AH_theta_*span_AH_H_y_ + l_H_y_BDE_theta_*w_H_x_BDE_theta_
        - l_H_y_HE_theta_*span_HE_H_y_;
    const Lanes determinant_H_x_H_y_ = -(pivot_H_x_H_y_ * pivot_H_x_H_y_) + scale_H_x_*scale_H_y_;
    *rare |= ~((scale_H_x_ > 0.0) & (scale_H_x_ < INFINITY));
    *rare |= ~(determinant_H_x_H_y_ > memory->least_size * scale_H_y_ * scale_H_x_);
    const Lanes size_H_x_ = scale_H_x_ + scale_H_y_;
    *rare |= ~(scale_H_x_ > memory->least_size * size_H_x_);
    *rare |= ~(determinant_H_x_H_y_ > memory->least_size * size_H_x_ * scale_H_x_);
    const Lanes inverse_H_x_H_y_ = -1.0/determinant_H_x_H_y_;
    const Lanes inverse_pivot_H_x_ = inverse_H_x_H_y_*scale_H_y_;
    const Lanes inverse_pivot_H_y_ = inverse_H_x_H_y_*scale_H_x_;
    const Lanes inverse_cross_H_x_H_y_ = -inverse_H_x_H_y_*pivot_H_x_H_y_;
    const Lanes w_E3_x_H_x_ = -l_E3_x_BDE_theta_*w_H_x_BDE_theta_;
    const Lanes w_E3_x_H_y_ = -l_E3_x_BDE_theta_*w_H_y_BDE_theta_;
    const Lanes l_E3_x_H_x_ = inverse_cross_H_x_H_y_*w_E3_x_H_y_ + inverse_pivot_H_x_*w_E3_x_H_x_;
    const Lanes l_E3_x_H_y_ = inverse_cross_H_x_H_y_*w_E3_x_H_x_ + inverse_pivot_H_y_*w_E3_x_H_y_;
    const Lanes w_E3_y_H_x_ = -l_E3_y_BDE_theta_*w_H_x_BDE_theta_;
    const Lanes w_E3_y_H_y_ = -l_E3_y_BDE_theta_*w_H_y_BDE_theta_;
    const Lanes l_E3_y_H_x_ = inverse_cross_H_x_H_y_*w_E3_y_H_y_ + inverse_pivot_H_x_*w_E3_y_H_x_;
    const Lanes l_E3_y_H_y_ = inverse_cross_H_x_H_y_*w_E3_y_H_x_ + inverse_pivot_H_y_*w_E3_y_H_y_;
    const Lanes l_OF_theta_EG_theta_ = dot_OF_EG_*p->inverse_tree_metric_EG_theta_;
    const Lanes l_FE_theta_EG_theta_ = dot_FE_EG_*p->inverse_tree_metric_EG_theta_;
    const Lanes l_G_x_EG_theta_ = -p->inverse_tree_metric_EG_theta_*span_EG_G_y_;
    const Lanes l_G_y_EG_theta_ = p->inverse_tree_metric_EG_theta_*span_EG_G_x_;
    const Lanes pivot_OF_theta_ = -dot_OF_EG_*l_OF_theta_EG_theta_ + p->tree_metric_OF_theta_;
    const Lanes pivot_FE_theta_ = -dot_FE_EG_*l_FE_theta_EG_theta_ + p->tree_metric_FE_theta_;
    const Lanes pivot_OF_theta_FE_theta_ = -dot_OF_EG_*l_FE_theta_EG_theta_ + dot_OF_FE_;
    const Lanes determinant_OF_theta_FE_theta_ = pivot_FE_theta_*pivot_OF_theta_
        - (pivot_OF_theta_FE_theta_ * pivot_OF_theta_FE_theta_);
    const Lanes inverse_OF_theta_FE_theta_ = 1.0/determinant_OF_theta_FE_theta_;
    const Lanes inverse_pivot_OF_theta_ = inverse_OF_theta_FE_theta_*pivot_FE_theta_;
    const Lanes inverse_pivot_FE_theta_ = inverse_OF_theta_FE_theta_*pivot_OF_theta_;
    const Lanes inverse_cross_OF_theta_FE_theta_ = -inverse_OF_theta_FE_theta_*pivot_OF_theta_FE_theta_;
    const Lanes w_G_x_OF_theta_ = -dot_OF_EG_*l_G_x_EG_theta_ - span_OF_F_y_;
    const Lanes w_G_x_FE_theta_ = -dot_FE_EG_*l_G_x_EG_theta_ - span_FE_E_y_;
    const Lanes l_G_x_OF_theta_ = inverse_cross_OF_theta_FE_theta_*w_G_x_FE_theta_
        + inverse_pivot_OF_theta_*w_G_x_OF_theta_;
    const Lanes l_G_x_FE_theta_ = inverse_cross_OF_theta_FE_theta_*w_G_x_OF_theta_
        + inverse_pivot_FE_theta_*w_G_x_FE_theta_;
    const Lanes w_G_y_OF_theta_ = -dot_OF_EG_*l_G_y_EG_theta_ + span_OF_F_x_;
    const Lanes w_G_y_FE_theta_ = -dot_FE_EG_*l_G_y_EG_theta_ + span_FE_E_x_;
    const Lanes l_G_y_OF_theta_ = inverse_cross_OF_theta_FE_theta_*w_G_y_FE_theta_
        + inverse_pivot_OF_theta_*w_G_y_OF_theta_;
    const Lanes l_G_y_FE_theta_ = inverse_cross_OF_theta_FE_theta_*w_G_y_OF_theta_
        + inverse_pivot_FE_theta_*w_G_y_FE_theta_;
    const Lanes l_E3_x_OF_theta_ = -inverse_cross_OF_theta_FE_theta_*span_FE_E_y_
        - inverse_pivot_OF_theta_*span_OF_F_y_;
    const Lanes l_E3_x_FE_theta_ = -inverse_cross_OF_theta_FE_theta_*span_OF_F_y_
        - inverse_pivot_FE_theta_*span_FE_E_y_;
    const Lanes l_E3_y_OF_theta_ = inverse_cross_OF_theta_FE_theta_*span_FE_E_x_ + inverse_pivot_OF_theta_*span_OF_F_x_;
    const Lanes l_E3_y_FE_theta_ = inverse_cross_OF_theta_FE_theta_*span_OF_F_x_ + inverse_pivot_FE_theta_*span_FE_E_x_;
    const Lanes scale_G_x_ = l_G_x_AG_theta_*span_AG_G_y_ - l_G_x_EG_theta_*span_EG_G_y_
        + l_G_x_FE_theta_*w_G_x_FE_theta_ + l_G_x_OF_theta_*w_G_x_OF_theta_;
    const Lanes scale_G_y_ = -l_G_y_AG_theta_*span_AG_G_x_ + l_G_y_EG_theta_*span_EG_G_x_
        + l_G_y_FE_theta_*w_G_y_FE_theta_ + l_G_y_OF_theta_*w_G_y_OF_theta_;
    const Lanes pivot_G_x_G_y_ = l_G_y_AG_theta_*span_AG_G_y_ - l_G_y_EG_theta_*span_EG_G_y_
        + l_G_y_FE_theta_*w_G_x_FE_theta_ + l_G_y_OF_theta_*w_G_x_OF_theta_;
    const Lanes determinant_G_x_G_y_ = -(pivot_G_x_G_y_ * pivot_G_x_G_y_) + scale_G_x_*scale_G_y_;
    *rare |= ~((scale_G_x_ > 0.0) & (scale_G_x_ < INFINITY));
    *rare |= ~(determinant_G_x_G_y_ > memory->least_size * scale_G_y_ * scale_G_x_);
    const Lanes size_G_x_ = scale_G_x_ + scale_G_y_;
    *rare |= ~(scale_G_x_ > memory->least_size * size_G_x_);
    *rare |= ~(determinant_G_x_G_y_ > memory->least_size * size_G_x_ * scale_G_x_);
    const Lanes inverse_G_x_G_y_ = -1.0/determinant_G_x_G_y_;
    const Lanes inverse_pivot_G_x_ = inverse_G_x_G_y_*scale_G_y_;
    const Lanes inverse_pivot_G_y_ = inverse_G_x_G_y_*scale_G_x_;
    const Lanes inverse_cross_G_x_G_y_ = -inverse_G_x_G_y_*pivot_G_x_G_y_;
    const Lanes w_E3_x_G_x_ = -l_E3_x_FE_theta_*w_G_x_FE_theta_ - l_E3_x_OF_theta_*w_G_x_OF_theta_;
    const Lanes w_E3_x_G_y_ = -l_E3_x_FE_theta_*w_G_y_FE_theta_ - l_E3_x_OF_theta_*w_G_y_OF_theta_;
    const Lanes l_E3_x_G_x_ = inverse_cross_G_x_G_y_*w_E3_x_G_y_ + inverse_pivot_G_x_*w_E3_x_G_x_;
    const Lanes l_E3_x_G_y_ = inverse_cross_G_x_G_y_*w_E3_x_G_x_ + inverse_pivot_G_y_*w_E3_x_G_y_;
    const Lanes w_E3_y_G_x_ = -l_E3_y_FE_theta_*w_G_x_FE_theta_ - l_E3_y_OF_theta_*w_G_x_OF_theta_;
    const Lanes w_E3_y_G_y_ = -l_E3_y_FE_theta_*w_G_y_FE_theta_ - l_E3_y_OF_theta_*w_G_y_OF_theta_;
    const Lanes l_E3_y_G_x_ = inverse_cross_G_x_G_y_*w_E3_y_G_y_ + inverse_pivot_G_x_*w_E3_y_G_x_;
    const Lanes l_E3_y_G_y_ = inverse_cross_G_x_G_y_*w_E3_y_G_x_ + inverse_pivot_G_y_*w_E3_y_G_y_;
    const Lanes scale_E3_x_ = l_E3_x_BDE_theta_*span_BDE_E_y_ - l_E3_x_FE_theta_*span_FE_E_y_
        - l_E3_x_OF_theta_*span_OF_F_y_;
    const Lanes scale_E3_y_ = -l_E3_y_BDE_theta_*span_BDE_E_x_ + l_E3_y_FE_theta_*span_FE_E_x_
        + l_E3_y_OF_theta_*span_OF_F_x_;
    const Lanes pivot_E3_x_ = l_E3_x_G_x_*w_E3_x_G_x_ + l_E3_x_G_y_*w_E3_x_G_y_ + l_E3_x_H_x_*w_E3_x_H_x_
        + l_E3_x_H_y_*w_E3_x_H_y_ + scale_E3_x_;
    const Lanes pivot_E3_y_ = l_E3_y_G_x_*w_E3_y_G_x_ + l_E3_y_G_y_*w_E3_y_G_y_ + l_E3_y_H_x_*w_E3_y_H_x_
        + l_E3_y_H_y_*w_E3_y_H_y_ + scale_E3_y_;
    const Lanes pivot_E3_x_E3_y_ = l_E3_y_BDE_theta_*span_BDE_E_y_ - l_E3_y_FE_theta_*span_FE_E_y_
        + l_E3_y_G_x_*w_E3_x_G_x_ + l_E3_y_G_y_*w_E3_x_G_y_ + l_E3_y_H_x_*w_E3_x_H_x_ + l_E3_y_H_y_*w_E3_x_H_y_
        - l_E3_y_OF_theta_*span_OF_F_y_;
    const Lanes determinant_E3_x_E3_y_ = pivot_E3_x_*pivot_E3_y_ - (pivot_E3_x_E3_y_ * pivot_E3_x_E3_y_);
    *rare |= ~(pivot_E3_x_ > memory->least_size * scale_E3_x_);
    *rare |= ~(determinant_E3_x_E3_y_ > memory->least_size * scale_E3_y_ * pivot_E3_x_);
    const Lanes size_E3_x_ = scale_E3_x_ + scale_E3_y_;
    *rare |= ~(pivot_E3_x_ > memory->least_size * size_E3_x_);
    *rare |= ~(determinant_E3_x_E3_y_ > memory->least_size * size_E3_x_ * pivot_E3_x_);
    const Lanes inverse_E3_x_E3_y_ = -1.0/determinant_E3_x_E3_y_;
    const Lanes inverse_pivot_E3_x_ = inverse_E3_x_E3_y_*pivot_E3_y_;
    const Lanes inverse_pivot_E3_y_ = inverse_E3_x_E3_y_*pivot_E3_x_;
    const Lanes inverse_cross_E3_x_E3_y_ = -inverse_E3_x_E3_y_*pivot_E3_x_E3_y_;

    /* forward substitution */
    const Lanes dq_z_E3_x_ = -l_E3_x_G_x_*phi_G_x_ - l_E3_x_G_y_*phi_G_y_ - l_E3_x_H_x_*phi_H_x_ - l_E3_x_H_y_*phi_H_y_
        + phi_E3_x_;
    const Lanes dq_z_E3_y_ = -l_E3_y_G_x_*phi_G_x_ - l_E3_y_G_y_*phi_G_y_ - l_E3_y_H_x_*phi_H_x_ - l_E3_y_H_y_*phi_H_y_
        + phi_E3_y_;

    /* backward substitution */
    const Lanes dq_lambda_E3_y_ = dq_z_E3_x_*inverse_cross_E3_x_E3_y_ + dq_z_E3_y_*inverse_pivot_E3_y_;
    const Lanes dq_lambda_E3_x_ = dq_z_E3_x_*inverse_pivot_E3_x_ + dq_z_E3_y_*inverse_cross_E3_x_E3_y_;
    const Lanes dq_lambda_G_y_ = -dq_lambda_E3_x_*l_E3_x_G_y_ - dq_lambda_E3_y_*l_E3_y_G_y_
        + inverse_cross_G_x_G_y_*phi_G_x_ + inverse_pivot_G_y_*phi_G_y_;
    const Lanes dq_lambda_G_x_ = -dq_lambda_E3_x_*l_E3_x_G_x_ - dq_lambda_E3_y_*l_E3_y_G_x_
        + inverse_cross_G_x_G_y_*phi_G_y_ + inverse_pivot_G_x_*phi_G_x_;
    const Lanes dq_acceleration_FE_theta_ = -dq_lambda_E3_x_*l_E3_x_FE_theta_ - dq_lambda_E3_y_*l_E3_y_FE_theta_
        - dq_lambda_G_x_*l_G_x_FE_theta_ - dq_lambda_G_y_*l_G_y_FE_theta_;
    const Lanes dq_acceleration_OF_theta_ = -dq_lambda_E3_x_*l_E3_x_OF_theta_ - dq_lambda_E3_y_*l_E3_y_OF_theta_
        - dq_lambda_G_x_*l_G_x_OF_theta_ - dq_lambda_G_y_*l_G_y_OF_theta_;
    const Lanes dq_acceleration_EG_theta_ = -dq_acceleration_FE_theta_*l_FE_theta_EG_theta_
        - dq_acceleration_OF_theta_*l_OF_theta_EG_theta_ - dq_lambda_G_x_*l_G_x_EG_theta_
        - dq_lambda_G_y_*l_G_y_EG_theta_;
    const Lanes dq_lambda_H_y_ = -dq_lambda_E3_x_*l_E3_x_H_y_ - dq_lambda_E3_y_*l_E3_y_H_y_
        + inverse_cross_H_x_H_y_*phi_H_x_ + inverse_pivot_H_y_*phi_H_y_;
    const Lanes dq_lambda_H_x_ = -dq_lambda_E3_x_*l_E3_x_H_x_ - dq_lambda_E3_y_*l_E3_y_H_x_
        + inverse_cross_H_x_H_y_*phi_H_y_ + inverse_pivot_H_x_*phi_H_x_;
    const Lanes dq_acceleration_BDE_theta_ = -dq_lambda_E3_x_*l_E3_x_BDE_theta_ - dq_lambda_E3_y_*l_E3_y_BDE_theta_
        - dq_lambda_H_x_*l_H_x_BDE_theta_ - dq_lambda_H_y_*l_H_y_BDE_theta_;
    const Lanes dq_acceleration_HE_theta_ = -dq_acceleration_BDE_theta_*l_BDE_theta_HE_theta_
        - dq_lambda_H_x_*l_H_x_HE_theta_ - dq_lambda_H_y_*l_H_y_HE_theta_;
    const Lanes dq_acceleration_AH_theta_ = -dq_lambda_H_x_*l_H_x_AH_theta_ - dq_lambda_H_y_*l_H_y_AH_theta_;
    const Lanes dq_acceleration_AG_theta_ = -dq_lambda_G_x_*l_G_x_AG_theta_ - dq_lambda_G_y_*l_G_y_AG_theta_;

    /* forward substitution */
    const Lanes dv_z_E3_x_ = -l_E3_x_G_x_*phi_dot_G_x_ - l_E3_x_G_y_*phi_dot_G_y_ - l_E3_x_H_x_*phi_dot_H_x_
        - l_E3_x_H_y_*phi_dot_H_y_ + phi_dot_E3_x_;
    const Lanes dv_z_E3_y_ = -l_E3_y_G_x_*phi_dot_G_x_ - l_E3_y_G_y_*phi_dot_G_y_ - l_E3_y_H_x_*phi_dot_H_x_
        - l_E3_y_H_y_*phi_dot_H_y_ + phi_dot_E3_y_;

    /* backward substitution */
    const Lanes dv_lambda_E3_y_ = dv_z_E3_x_*inverse_cross_E3_x_E3_y_ + dv_z_E3_y_*inverse_pivot_E3_y_;
    const Lanes dv_lambda_E3_x_ = dv_z_E3_x_*inverse_pivot_E3_x_ + dv_z_E3_y_*inverse_cross_E3_x_E3_y_;
    const Lanes dv_lambda_G_y_ = -dv_lambda_E3_x_*l_E3_x_G_y_ - dv_lambda_E3_y_*l_E3_y_G_y_
        + inverse_cross_G_x_G_y_*phi_dot_G_x_ + inverse_pivot_G_y_*phi_dot_G_y_;
    const Lanes dv_lambda_G_x_ = -dv_lambda_E3_x_*l_E3_x_G_x_ - dv_lambda_E3_y_*l_E3_y_G_x_
        + inverse_cross_G_x_G_y_*phi_dot_G_y_ + inverse_pivot_G_x_*phi_dot_G_x_;
    const Lanes dv_acceleration_FE_theta_ = -dv_lambda_E3_x_*l_E3_x_FE_theta_ - dv_lambda_E3_y_*l_E3_y_FE_theta_
        - dv_lambda_G_x_*l_G_x_FE_theta_ - dv_lambda_G_y_*l_G_y_FE_theta_;
    const Lanes dv_acceleration_OF_theta_ = -dv_lambda_E3_x_*l_E3_x_OF_theta_ - dv_lambda_E3_y_*l_E3_y_OF_theta_
        - dv_lambda_G_x_*l_G_x_OF_theta_ - dv_lambda_G_y_*l_G_y_OF_theta_;
    const Lanes dv_acceleration_EG_theta_ = -dv_acceleration_FE_theta_*l_FE_theta_EG_theta_
        - dv_acceleration_OF_theta_*l_OF_theta_EG_theta_ - dv_lambda_G_x_*l_G_x_EG_theta_
        - dv_lambda_G_y_*l_G_y_EG_theta_;
    const Lanes dv_lambda_H_y_ = -dv_lambda_E3_x_*l_E3_x_H_y_ - dv_lambda_E3_y_*l_E3_y_H_y_
        + inverse_cross_H_x_H_y_*phi_dot_H_x_ + inverse_pivot_H_y_*phi_dot_H_y_;
    const Lanes dv_lambda_H_x_ = -dv_lambda_E3_x_*l_E3_x_H_x_ - dv_lambda_E3_y_*l_E3_y_H_x_
        + inverse_cross_H_x_H_y_*phi_dot_H_y_ + inverse_pivot_H_x_*phi_dot_H_x_;
    const Lanes dv_acceleration_BDE_theta_ = -dv_lambda_E3_x_*l_E3_x_BDE_theta_ - dv_lambda_E3_y_*l_E3_y_BDE_theta_
        - dv_lambda_H_x_*l_H_x_BDE_theta_ - dv_lambda_H_y_*l_H_y_BDE_theta_;
    const Lanes dv_acceleration_HE_theta_ = -dv_acceleration_BDE_theta_*l_BDE_theta_HE_theta_
        - dv_lambda_H_x_*l_H_x_HE_theta_ - dv_lambda_H_y_*l_H_y_HE_theta_;
    const Lanes dv_acceleration_AH_theta_ = -dv_lambda_H_x_*l_H_x_AH_theta_ - dv_lambda_H_y_*l_H_y_AH_theta_;
    const Lanes dv_acceleration_AG_theta_ = -dv_lambda_G_x_*l_G_x_AG_theta_ - dv_lambda_G_y_*l_G_y_AG_theta_;

    /* results */
    dq[0] = dq_acceleration_OF_theta_;
    dv[0] = dv_acceleration_OF_theta_;
    dq[1] = dq_acceleration_BDE_theta_;
    dv[1] = dv_acceleration_BDE_theta_;
    dq[2] = dq_acceleration_AG_theta_;
    dv[2] = dv_acceleration_AG_theta_;
    dq[3] = dq_acceleration_AH_theta_;
    dv[3] = dv_acceleration_AH_theta_;
    dq[4] = dq_acceleration_FE_theta_;
    dv[4] = dv_acceleration_FE_theta_;
    dq[5] = dq_acceleration_HE_theta_;
    dv[5] = dv_acceleration_HE_theta_;
    dq[6] = dq_acceleration_EG_theta_;
    dv[6] = dv_acceleration_EG_theta_;
    *worst = lanes_max_of(all_of(0.0), lanes_fabs(phi_G_x_));
    *worst = lanes_max_of(*worst, lanes_fabs(phi_G_y_));
    *worst = lanes_max_of(*worst, lanes_fabs(phi_H_x_));
    *worst = lanes_max_of(*worst, lanes_fabs(phi_H_y_));
    *worst = lanes_max_of(*worst, lanes_fabs(phi_E3_x_));
    *worst = lanes_max_of(*worst, lanes_fabs(phi_E3_y_));
}

#if !HELD
#include "engine/batch/lane_steps.c"
#include "engine/batch/lane_runs.c"
#else
/*
 * The equations of motion linearized at a state, with the accelerations and multipliers that belong to it:
 * non-zeros of M, Phi_q, and of the derivatives of both equations and of the powers by q, v, t.
 */
static void linearize(const Lanes t, const Lanes *q, const Lanes *v, const LaneMemory *memory, const LaneParameters *p,
    const Lanes *a, const LaneAside *aside, LaneLinear *lin, LaneBits *rare)
{
    (void)t, (void)memory, (void)rare;
    /* coordinates, velocities, time */
    const Lanes OF_theta_ = q[0];
    const Lanes OF_omega_ = v[0];
    const Lanes BDE_theta_ = q[1];
    const Lanes BDE_omega_ = v[1];
    const Lanes AG_theta_ = q[2];
    const Lanes AG_omega_ = v[2];
    const Lanes AH_theta_ = q[3];
    const Lanes AH_omega_ = v[3];
    const Lanes FE_theta_ = q[4];
    const Lanes FE_omega_ = v[4];
    const Lanes HE_theta_ = q[5];
    const Lanes HE_omega_ = v[5];
    const Lanes EG_theta_ = q[6];
    const Lanes EG_omega_ = v[6];
    const Lanes a_OF_theta_ = a[0];
    const Lanes a_BDE_theta_ = a[1];
    const Lanes a_AG_theta_ = a[2];
    const Lanes a_AH_theta_ = a[3];
    const Lanes a_FE_theta_ = a[4];
    const Lanes a_HE_theta_ = a[5];
    const Lanes a_EG_theta_ = a[6];
    const Lanes held_lambda_G_x_ = aside->lambda[0];
    const Lanes held_lambda_G_y_ = aside->lambda[1];
    const Lanes held_lambda_H_x_ = aside->lambda[2];
    const Lanes held_lambda_H_y_ = aside->lambda[3];
    const Lanes held_lambda_E3_x_ = aside->lambda[4];
    const Lanes held_lambda_E3_y_ = aside->lambda[5];

    /* directions, arms, drives */
    const Lanes cos_theta_OF_ = lanes_cos(OF_theta_);
    const Lanes sin_theta_OF_ = lanes_sin(OF_theta_);
    const Lanes cos_theta_BDE_ = lanes_cos(BDE_theta_);
    const Lanes sin_theta_BDE_ = lanes_sin(BDE_theta_);
    const Lanes cos_theta_AG_ = lanes_cos(AG_theta_);
    const Lanes sin_theta_AG_ = lanes_sin(AG_theta_);
    const Lanes cos_theta_AH_ = lanes_cos(AH_theta_);
    const Lanes sin_theta_AH_ = lanes_sin(AH_theta_);
    const Lanes cos_theta_FE_ = lanes_cos(FE_theta_);
    const Lanes sin_theta_FE_ = lanes_sin(FE_theta_);
    const Lanes cos_theta_HE_ = lanes_cos(HE_theta_);
    const Lanes sin_theta_HE_ = lanes_sin(HE_theta_);
    const Lanes cos_theta_EG_ = lanes_cos(EG_theta_);
    const Lanes sin_theta_EG_ = lanes_sin(EG_theta_);
    const Lanes span_OF_F_x_ = p->OF_F_span_x_*cos_theta_OF_;
    const Lanes span_OF_F_y_ = p->OF_F_span_x_*sin_theta_OF_;
    const Lanes span_BDE_E_x_ = p->BDE_E_span_x_*cos_theta_BDE_ - p->BDE_E_span_y_*sin_theta_BDE_;
    const Lanes span_BDE_E_y_ = p->BDE_E_span_x_*sin_theta_BDE_ + p->BDE_E_span_y_*cos_theta_BDE_;
    const Lanes span_FE_E_x_ = p->FE_E_span_x_*cos_theta_FE_;
    const Lanes span_FE_E_y_ = p->FE_E_span_x_*sin_theta_FE_;
    const Lanes span_EG_G_x_ = -p->EG_G_span_y_*sin_theta_EG_;
    const Lanes span_EG_G_y_ = p->EG_G_span_y_*cos_theta_EG_;
    const Lanes span_AG_G_x_ = p->AG_G_span_x_*cos_theta_AG_ - p->AG_G_span_y_*sin_theta_AG_;
    const Lanes span_AG_G_y_ = p->AG_G_span_x_*sin_theta_AG_ + p->AG_G_span_y_*cos_theta_AG_;
    const Lanes span_HE_H_x_ = p->HE_H_span_x_*cos_theta_HE_;
    const Lanes span_HE_H_y_ = p->HE_H_span_x_*sin_theta_HE_;
    const Lanes span_AH_H_x_ = p->AH_H_span_x_*cos_theta_AH_ - p->AH_H_span_y_*sin_theta_AH_;
    const Lanes span_AH_H_y_ = p->AH_H_span_x_*sin_theta_AH_ + p->AH_H_span_y_*cos_theta_AH_;
    const Lanes span_BDE_D_x_ = p->BDE_D_span_x_*cos_theta_BDE_ - p->BDE_D_span_y_*sin_theta_BDE_;
    const Lanes span_BDE_D_y_ = p->BDE_D_span_x_*sin_theta_BDE_ + p->BDE_D_span_y_*cos_theta_BDE_;
    const Lanes BDE_D_x_ = p->B_x_ + span_BDE_D_x_;
    const Lanes BDE_D_y_ = p->B_y_ + span_BDE_D_y_;
    const Lanes spring_span_x_ = BDE_D_x_ - p->C_x_;
    const Lanes spring_span_y_ = BDE_D_y_ - p->C_y_;
    const Lanes spring_length_ = lanes_sqrt((spring_span_x_ * spring_span_x_) + (spring_span_y_ * spring_span_y_));
    const Lanes spring_force_ = p->spring_stiffness_*(-p->spring_free_length_ + spring_length_);
    const Lanes spring_pull_ = spring_force_/spring_length_;
    const Lanes cos_FE_less_OF_ = cos_theta_FE_*cos_theta_OF_ + sin_theta_FE_*sin_theta_OF_;
    const Lanes sin_FE_less_OF_ = -cos_theta_FE_*sin_theta_OF_ + cos_theta_OF_*sin_theta_FE_;
    const Lanes dot_OF_FE_ = cos_FE_less_OF_*p->inertia_OF_FE_;
    const Lanes cross_OF_FE_ = p->inertia_OF_FE_*sin_FE_less_OF_;
    const Lanes cos_EG_less_OF_ = cos_theta_EG_*cos_theta_OF_ + sin_theta_EG_*sin_theta_OF_;
    const Lanes sin_EG_less_OF_ = -cos_theta_EG_*sin_theta_OF_ + cos_theta_OF_*sin_theta_EG_;
    const Lanes dot_OF_EG_ = -sin_EG_less_OF_*p->twist_OF_EG_;
    const Lanes cross_OF_EG_ = cos_EG_less_OF_*p->twist_OF_EG_;
    const Lanes cos_EG_less_FE_ = cos_theta_EG_*cos_theta_FE_ + sin_theta_EG_*sin_theta_FE_;
    const Lanes sin_EG_less_FE_ = -cos_theta_EG_*sin_theta_FE_ + cos_theta_FE_*sin_theta_EG_;
    const Lanes dot_FE_EG_ = -sin_EG_less_FE_*p->twist_FE_EG_;
    const Lanes cross_FE_EG_ = cos_EG_less_FE_*p->twist_FE_EG_;
    const Lanes cos_HE_less_BDE_ = cos_theta_BDE_*cos_theta_HE_ + sin_theta_BDE_*sin_theta_HE_;
    const Lanes sin_HE_less_BDE_ = cos_theta_BDE_*sin_theta_HE_ - cos_theta_HE_*sin_theta_BDE_;
    const Lanes dot_BDE_HE_ = cos_HE_less_BDE_*p->inertia_BDE_HE_ - sin_HE_less_BDE_*p->twist_BDE_HE_;
    const Lanes cross_BDE_HE_ = cos_HE_less_BDE_*p->twist_BDE_HE_ + p->inertia_BDE_HE_*sin_HE_less_BDE_;

    /* coordinates */
    const Lanes inverse_sum_ = 1.0/(spring_length_ + 1e-150);
    const Lanes spring_length_by_BDE_theta_ = inverse_sum_*span_BDE_D_x_*spring_span_y_
        - inverse_sum_*span_BDE_D_y_*spring_span_x_;
    const Lanes spring_force_by_BDE_theta_ = spring_length_by_BDE_theta_*p->spring_stiffness_;
    const Lanes inverse_spring_length_ = 1.0/spring_length_;
    const Lanes spring_pull_by_BDE_theta_ = -(inverse_spring_length_
        * inverse_spring_length_)*spring_force_*spring_length_by_BDE_theta_
        + inverse_spring_length_*spring_force_by_BDE_theta_;

    /* results */
    lin->value[0] = dot_OF_FE_;
    lin->value[1] = dot_OF_EG_;
    lin->value[2] = dot_FE_EG_;
    lin->value[3] = dot_BDE_HE_;
    lin->value[4] = -span_OF_F_y_;
    lin->value[5] = span_AG_G_y_;
    lin->value[6] = -span_FE_E_y_;
    lin->value[7] = -span_EG_G_y_;
    lin->value[8] = span_OF_F_x_;
    lin->value[9] = -span_AG_G_x_;
    lin->value[10] = span_FE_E_x_;
    lin->value[11] = span_EG_G_x_;
    lin->value[12] = -span_BDE_E_y_;
    lin->value[13] = span_AH_H_y_;
    lin->value[14] = -span_HE_H_y_;
    lin->value[15] = span_BDE_E_x_;
    lin->value[16] = -span_AH_H_x_;
    lin->value[17] = span_HE_H_x_;
    lin->value[18] = -(AG_omega_ * AG_omega_)*span_AG_G_y_ + AG_omega_*span_AG_G_x_*p->two_alpha_
        + a_AG_theta_*span_AG_G_x_;
    lin->value[19] = (EG_omega_ * EG_omega_)*span_EG_G_y_ - EG_omega_*span_EG_G_x_*p->two_alpha_
        - a_EG_theta_*span_EG_G_x_;
    lin->value[20] = (FE_omega_ * FE_omega_)*span_FE_E_y_ - FE_omega_*span_FE_E_x_*p->two_alpha_
        - a_FE_theta_*span_FE_E_x_;
    lin->value[21] = (OF_omega_ * OF_omega_)*span_OF_F_y_ - OF_omega_*span_OF_F_x_*p->two_alpha_
        - a_OF_theta_*span_OF_F_x_;
    lin->value[22] = (AG_omega_ * AG_omega_)*span_AG_G_x_ + AG_omega_*span_AG_G_y_*p->two_alpha_
        + a_AG_theta_*span_AG_G_y_;
    lin->value[23] = -(EG_omega_ * EG_omega_)*span_EG_G_x_ - EG_omega_*span_EG_G_y_*p->two_alpha_
        - a_EG_theta_*span_EG_G_y_;
    lin->value[24] = -(FE_omega_ * FE_omega_)*span_FE_E_x_ - FE_omega_*span_FE_E_y_*p->two_alpha_
        - a_FE_theta_*span_FE_E_y_;
    lin->value[25] = -(OF_omega_ * OF_omega_)*span_OF_F_x_ - OF_omega_*span_OF_F_y_*p->two_alpha_
        - a_OF_theta_*span_OF_F_y_;
    lin->value[26] = -(AH_omega_ * AH_omega_)*span_AH_H_y_ + AH_omega_*span_AH_H_x_*p->two_alpha_
        + a_AH_theta_*span_AH_H_x_;
    lin->value[27] = (BDE_omega_ * BDE_omega_)*span_BDE_E_y_ - BDE_omega_*span_BDE_E_x_*p->two_alpha_
        - a_BDE_theta_*span_BDE_E_x_;
    lin->value[28] = (HE_omega_ * HE_omega_)*span_HE_H_y_ - HE_omega_*span_HE_H_x_*p->two_alpha_
        - a_HE_theta_*span_HE_H_x_;
    lin->value[29] = (AH_omega_ * AH_omega_)*span_AH_H_x_ + AH_omega_*span_AH_H_y_*p->two_alpha_
        + a_AH_theta_*span_AH_H_y_;
    lin->value[30] = -(BDE_omega_ * BDE_omega_)*span_BDE_E_x_ - BDE_omega_*span_BDE_E_y_*p->two_alpha_
        - a_BDE_theta_*span_BDE_E_y_;
    lin->value[31] = -(HE_omega_ * HE_omega_)*span_HE_H_x_ - HE_omega_*span_HE_H_y_*p->two_alpha_
        - a_HE_theta_*span_HE_H_y_;
    lin->value[32] = (EG_omega_ * EG_omega_)*dot_OF_EG_ + (FE_omega_ * FE_omega_)*dot_OF_FE_ + a_EG_theta_*cross_OF_EG_
        + a_FE_theta_*cross_OF_FE_ + span_OF_F_x_*(-held_lambda_E3_x_ - held_lambda_G_x_)
        - span_OF_F_y_*(held_lambda_E3_y_ + held_lambda_G_y_);
    lin->value[33] = -(EG_omega_ * EG_omega_)*dot_OF_EG_ - a_EG_theta_*cross_OF_EG_;
    lin->value[34] = -(FE_omega_ * FE_omega_)*dot_OF_FE_ - a_FE_theta_*cross_OF_FE_;
    lin->value[35] = (HE_omega_ * HE_omega_)*dot_BDE_HE_ + a_HE_theta_*cross_BDE_HE_
        + (span_BDE_D_x_ * span_BDE_D_x_)*spring_pull_ - span_BDE_D_x_*spring_pull_*spring_span_x_
        + (span_BDE_D_y_ * span_BDE_D_y_)*spring_pull_ - span_BDE_D_y_*spring_pull_*spring_span_y_
        + span_BDE_E_x_*(held_lambda_E3_x_ - held_lambda_H_x_) - span_BDE_E_y_*(-held_lambda_E3_y_ + held_lambda_H_y_)
        + spring_pull_by_BDE_theta_*(span_BDE_D_x_*spring_span_y_ - span_BDE_D_y_*spring_span_x_);
    lin->value[36] = -(HE_omega_ * HE_omega_)*dot_BDE_HE_ - a_HE_theta_*cross_BDE_HE_;
    lin->value[37] = held_lambda_G_x_*span_AG_G_x_ + held_lambda_G_y_*span_AG_G_y_;
    lin->value[38] = held_lambda_H_x_*span_AH_H_x_ + held_lambda_H_y_*span_AH_H_y_;
    lin->value[39] = (EG_omega_ * EG_omega_)*dot_FE_EG_ + (OF_omega_ * OF_omega_)*dot_OF_FE_ + a_EG_theta_*cross_FE_EG_
        - a_OF_theta_*cross_OF_FE_ + span_FE_E_x_*(-held_lambda_E3_x_ - held_lambda_G_x_)
        - span_FE_E_y_*(held_lambda_E3_y_ + held_lambda_G_y_);
    lin->value[40] = -(EG_omega_ * EG_omega_)*dot_FE_EG_ - a_EG_theta_*cross_FE_EG_;
    lin->value[41] = -(OF_omega_ * OF_omega_)*dot_OF_FE_ + a_OF_theta_*cross_OF_FE_;
    lin->value[42] = -(BDE_omega_ * BDE_omega_)*dot_BDE_HE_ + a_BDE_theta_*cross_BDE_HE_;
    lin->value[43] = (BDE_omega_ * BDE_omega_)*dot_BDE_HE_ - a_BDE_theta_*cross_BDE_HE_ - held_lambda_H_x_*span_HE_H_x_
        - held_lambda_H_y_*span_HE_H_y_;
    lin->value[44] = -(FE_omega_ * FE_omega_)*dot_FE_EG_ + a_FE_theta_*cross_FE_EG_;
    lin->value[45] = (FE_omega_ * FE_omega_)*dot_FE_EG_ + (OF_omega_ * OF_omega_)*dot_OF_EG_ - a_FE_theta_*cross_FE_EG_
        - a_OF_theta_*cross_OF_EG_ - held_lambda_G_x_*span_EG_G_x_ - held_lambda_G_y_*span_EG_G_y_;
    lin->value[46] = -(OF_omega_ * OF_omega_)*dot_OF_EG_ + a_OF_theta_*cross_OF_EG_;
    lin->value[47] = 2.0*AG_omega_*span_AG_G_x_;
    lin->value[48] = -2.0*EG_omega_*span_EG_G_x_;
    lin->value[49] = -2.0*FE_omega_*span_FE_E_x_;
    lin->value[50] = -2.0*OF_omega_*span_OF_F_x_;
    lin->value[51] = 2.0*AG_omega_*span_AG_G_y_;
    lin->value[52] = -2.0*EG_omega_*span_EG_G_y_;
    lin->value[53] = -2.0*FE_omega_*span_FE_E_y_;
    lin->value[54] = -2.0*OF_omega_*span_OF_F_y_;
    lin->value[55] = 2.0*AH_omega_*span_AH_H_x_;
    lin->value[56] = -2.0*BDE_omega_*span_BDE_E_x_;
    lin->value[57] = -2.0*HE_omega_*span_HE_H_x_;
    lin->value[58] = 2.0*AH_omega_*span_AH_H_y_;
    lin->value[59] = -2.0*BDE_omega_*span_BDE_E_y_;
    lin->value[60] = -2.0*HE_omega_*span_HE_H_y_;
    lin->value[61] = -2.0*EG_omega_*cross_OF_EG_;
    lin->value[62] = -2.0*FE_omega_*cross_OF_FE_;
    lin->value[63] = -2.0*HE_omega_*cross_BDE_HE_;
    lin->value[64] = -2.0*EG_omega_*cross_FE_EG_;
    lin->value[65] = 2.0*OF_omega_*cross_OF_FE_;
    lin->value[66] = 2.0*BDE_omega_*cross_BDE_HE_;
    lin->value[67] = 2.0*FE_omega_*cross_FE_EG_;
    lin->value[68] = 2.0*OF_omega_*cross_OF_EG_;
    lin->value[69] = p->motor_value_;
    lin->p = p;
}

/*
 * L U of Newton's matrix at eta = h gamma (0: the KKT matrix), L with unit diagonal. Returns 0, or the
 * number of the node (coordinates, rows, sticks; from 1) whose pivot vanished or is not finite.
 */
static void newton_factor(Lanes eta, LaneLinear *lin, LaneBits *rare)
{
    /* numbers of the run */
    const LaneParameters *const p = lin->p;

    /* linearization */
    const Lanes mass_OF_theta_FE_theta_ = lin->value[0];
    const Lanes mass_OF_theta_EG_theta_ = lin->value[1];
    const Lanes mass_FE_theta_EG_theta_ = lin->value[2];
    const Lanes mass_BDE_theta_HE_theta_ = lin->value[3];
    const Lanes phi_G_x_OF_theta_ = lin->value[4];
    const Lanes phi_G_x_AG_theta_ = lin->value[5];
    const Lanes phi_G_x_FE_theta_ = lin->value[6];
    const Lanes phi_G_x_EG_theta_ = lin->value[7];
    const Lanes phi_G_y_OF_theta_ = lin->value[8];
    const Lanes phi_G_y_AG_theta_ = lin->value[9];
    const Lanes phi_G_y_FE_theta_ = lin->value[10];
    const Lanes phi_G_y_EG_theta_ = lin->value[11];
    const Lanes phi_H_x_BDE_theta_ = lin->value[12];
    const Lanes phi_H_x_AH_theta_ = lin->value[13];
    const Lanes phi_H_x_HE_theta_ = lin->value[14];
    const Lanes phi_H_y_BDE_theta_ = lin->value[15];
    const Lanes phi_H_y_AH_theta_ = lin->value[16];
    const Lanes phi_H_y_HE_theta_ = lin->value[17];
    const Lanes by_q_G_x_AG_theta_ = lin->value[18];
    const Lanes by_q_G_x_EG_theta_ = lin->value[19];
    const Lanes by_q_G_x_FE_theta_ = lin->value[20];
    const Lanes by_q_G_x_OF_theta_ = lin->value[21];
    const Lanes by_q_G_y_AG_theta_ = lin->value[22];
    const Lanes by_q_G_y_EG_theta_ = lin->value[23];
    const Lanes by_q_G_y_FE_theta_ = lin->value[24];
    const Lanes by_q_G_y_OF_theta_ = lin->value[25];
    const Lanes by_q_H_x_AH_theta_ = lin->value[26];
    const Lanes by_q_H_x_BDE_theta_ = lin->value[27];
    const Lanes by_q_H_x_HE_theta_ = lin->value[28];
    const Lanes by_q_H_y_AH_theta_ = lin->value[29];
    const Lanes by_q_H_y_BDE_theta_ = lin->value[30];
    const Lanes by_q_H_y_HE_theta_ = lin->value[31];
    const Lanes by_q_OF_theta_OF_theta_ = lin->value[32];
    const Lanes by_q_OF_theta_EG_theta_ = lin->value[33];
    const Lanes by_q_OF_theta_FE_theta_ = lin->value[34];
    const Lanes by_q_BDE_theta_BDE_theta_ = lin->value[35];
    const Lanes by_q_BDE_theta_HE_theta_ = lin->value[36];
    const Lanes by_q_AG_theta_AG_theta_ = lin->value[37];
    const Lanes by_q_AH_theta_AH_theta_ = lin->value[38];
    const Lanes by_q_FE_theta_FE_theta_ = lin->value[39];
    const Lanes by_q_FE_theta_EG_theta_ = lin->value[40];
    const Lanes by_q_FE_theta_OF_theta_ = lin->value[41];
    const Lanes by_q_HE_theta_BDE_theta_ = lin->value[42];
    const Lanes by_q_HE_theta_HE_theta_ = lin->value[43];
    const Lanes by_q_EG_theta_FE_theta_ = lin->value[44];
    const Lanes by_q_EG_theta_EG_theta_ = lin->value[45];
    const Lanes by_q_EG_theta_OF_theta_ = lin->value[46];
    const Lanes by_v_G_x_AG_theta_ = lin->value[47];
    const Lanes by_v_G_x_EG_theta_ = lin->value[48];
    const Lanes by_v_G_x_FE_theta_ = lin->value[49];
    const Lanes by_v_G_x_OF_theta_ = lin->value[50];
    const Lanes by_v_G_y_AG_theta_ = lin->value[51];
    const Lanes by_v_G_y_EG_theta_ = lin->value[52];
    const Lanes by_v_G_y_FE_theta_ = lin->value[53];
    const Lanes by_v_G_y_OF_theta_ = lin->value[54];
    const Lanes by_v_H_x_AH_theta_ = lin->value[55];
    const Lanes by_v_H_x_BDE_theta_ = lin->value[56];
    const Lanes by_v_H_x_HE_theta_ = lin->value[57];
    const Lanes by_v_H_y_AH_theta_ = lin->value[58];
    const Lanes by_v_H_y_BDE_theta_ = lin->value[59];
    const Lanes by_v_H_y_HE_theta_ = lin->value[60];
    const Lanes by_v_OF_theta_EG_theta_ = lin->value[61];
    const Lanes by_v_OF_theta_FE_theta_ = lin->value[62];
    const Lanes by_v_BDE_theta_HE_theta_ = lin->value[63];
    const Lanes by_v_FE_theta_EG_theta_ = lin->value[64];
    const Lanes by_v_FE_theta_OF_theta_ = lin->value[65];
    const Lanes by_v_HE_theta_BDE_theta_ = lin->value[66];
    const Lanes by_v_EG_theta_FE_theta_ = lin->value[67];
    const Lanes by_v_EG_theta_OF_theta_ = lin->value[68];

    /* eta/kappa */
    const Lanes eta_row = eta/(eta*(p->beta_squared_*eta + p->two_alpha_) + 1.0);

    /* matrix */
    const Lanes n_OF_theta_OF_theta_ = by_q_OF_theta_OF_theta_*(eta * eta) + p->mass_OF_OF_;
    const Lanes n_OF_theta_FE_theta_ = eta*(by_q_OF_theta_FE_theta_*eta + by_v_OF_theta_FE_theta_)
        + mass_OF_theta_FE_theta_;
    const Lanes n_OF_theta_EG_theta_ = eta*(by_q_OF_theta_EG_theta_*eta + by_v_OF_theta_EG_theta_)
        + mass_OF_theta_EG_theta_;
    const Lanes n_BDE_theta_BDE_theta_ = by_q_BDE_theta_BDE_theta_*(eta * eta) + p->mass_BDE_BDE_;
    const Lanes n_BDE_theta_HE_theta_ = eta*(by_q_BDE_theta_HE_theta_*eta + by_v_BDE_theta_HE_theta_)
        + mass_BDE_theta_HE_theta_;
    const Lanes n_AG_theta_AG_theta_ = by_q_AG_theta_AG_theta_*(eta * eta) + p->mass_AG_AG_;
    const Lanes n_AH_theta_AH_theta_ = by_q_AH_theta_AH_theta_*(eta * eta) + p->mass_AH_AH_;
    const Lanes n_FE_theta_OF_theta_ = eta*(by_q_FE_theta_OF_theta_*eta + by_v_FE_theta_OF_theta_)
        + mass_OF_theta_FE_theta_;
    const Lanes n_FE_theta_FE_theta_ = by_q_FE_theta_FE_theta_*(eta * eta) + p->mass_FE_FE_;
    const Lanes n_FE_theta_EG_theta_ = eta*(by_q_FE_theta_EG_theta_*eta + by_v_FE_theta_EG_theta_)
        + mass_FE_theta_EG_theta_;
    const Lanes n_HE_theta_BDE_theta_ = eta*(by_q_HE_theta_BDE_theta_*eta + by_v_HE_theta_BDE_theta_)
        + mass_BDE_theta_HE_theta_;
    const Lanes n_HE_theta_HE_theta_ = by_q_HE_theta_HE_theta_*(eta * eta) + p->mass_HE_HE_;
    const Lanes n_EG_theta_OF_theta_ = eta*(by_q_EG_theta_OF_theta_*eta + by_v_EG_theta_OF_theta_)
        + mass_OF_theta_EG_theta_;
    const Lanes n_EG_theta_FE_theta_ = eta*(by_q_EG_theta_FE_theta_*eta + by_v_EG_theta_FE_theta_)
        + mass_FE_theta_EG_theta_;
    const Lanes n_EG_theta_EG_theta_ = by_q_EG_theta_EG_theta_*(eta * eta) + p->mass_EG_EG_;
    const Lanes n_G_x_OF_theta_ = eta_row*(by_q_G_x_OF_theta_*eta + by_v_G_x_OF_theta_) + phi_G_x_OF_theta_;
    const Lanes n_G_x_AG_theta_ = eta_row*(by_q_G_x_AG_theta_*eta + by_v_G_x_AG_theta_) + phi_G_x_AG_theta_;
    const Lanes n_G_x_FE_theta_ = eta_row*(by_q_G_x_FE_theta_*eta + by_v_G_x_FE_theta_) + phi_G_x_FE_theta_;
    const Lanes n_G_x_EG_theta_ = eta_row*(by_q_G_x_EG_theta_*eta + by_v_G_x_EG_theta_) + phi_G_x_EG_theta_;
    const Lanes n_G_y_OF_theta_ = eta_row*(by_q_G_y_OF_theta_*eta + by_v_G_y_OF_theta_) + phi_G_y_OF_theta_;
    const Lanes n_G_y_AG_theta_ = eta_row*(by_q_G_y_AG_theta_*eta + by_v_G_y_AG_theta_) + phi_G_y_AG_theta_;
    const Lanes n_G_y_FE_theta_ = eta_row*(by_q_G_y_FE_theta_*eta + by_v_G_y_FE_theta_) + phi_G_y_FE_theta_;
    const Lanes n_G_y_EG_theta_ = eta_row*(by_q_G_y_EG_theta_*eta + by_v_G_y_EG_theta_) + phi_G_y_EG_theta_;
    const Lanes n_H_x_BDE_theta_ = eta_row*(by_q_H_x_BDE_theta_*eta + by_v_H_x_BDE_theta_) + phi_H_x_BDE_theta_;
    const Lanes n_H_x_AH_theta_ = eta_row*(by_q_H_x_AH_theta_*eta + by_v_H_x_AH_theta_) + phi_H_x_AH_theta_;
    const Lanes n_H_x_HE_theta_ = eta_row*(by_q_H_x_HE_theta_*eta + by_v_H_x_HE_theta_) + phi_H_x_HE_theta_;
    const Lanes n_H_y_BDE_theta_ = eta_row*(by_q_H_y_BDE_theta_*eta + by_v_H_y_BDE_theta_) + phi_H_y_BDE_theta_;
    const Lanes n_H_y_AH_theta_ = eta_row*(by_q_H_y_AH_theta_*eta + by_v_H_y_AH_theta_) + phi_H_y_AH_theta_;
    const Lanes n_H_y_HE_theta_ = eta_row*(by_q_H_y_HE_theta_*eta + by_v_H_y_HE_theta_) + phi_H_y_HE_theta_;
    const Lanes n_E3_x_OF_theta_ = eta_row*(by_q_G_x_OF_theta_*eta + by_v_G_x_OF_theta_) + phi_G_x_OF_theta_;
    const Lanes n_E3_x_BDE_theta_ = eta_row*(-by_q_H_x_BDE_theta_*eta - by_v_H_x_BDE_theta_) - phi_H_x_BDE_theta_;
    const Lanes n_E3_x_FE_theta_ = eta_row*(by_q_G_x_FE_theta_*eta + by_v_G_x_FE_theta_) + phi_G_x_FE_theta_;
    const Lanes n_E3_y_OF_theta_ = eta_row*(by_q_G_y_OF_theta_*eta + by_v_G_y_OF_theta_) + phi_G_y_OF_theta_;
    const Lanes n_E3_y_BDE_theta_ = eta_row*(-by_q_H_y_BDE_theta_*eta - by_v_H_y_BDE_theta_) - phi_H_y_BDE_theta_;
    const Lanes n_E3_y_FE_theta_ = eta_row*(by_q_G_y_FE_theta_*eta + by_v_G_y_FE_theta_) + phi_G_y_FE_theta_;

    /* L U */
    const Lanes scale_AG_theta_ = n_AG_theta_AG_theta_;
    *rare |= ~(lanes_fabs(scale_AG_theta_) > SINGULAR * lanes_fabs(n_AG_theta_AG_theta_));
    const Lanes inverse_pivot_AG_theta_ = 1.0/scale_AG_theta_;
    lin->lu[0] = inverse_pivot_AG_theta_;
    const Lanes l_G_x_AG_theta_ = inverse_pivot_AG_theta_*n_G_x_AG_theta_;
    lin->lu[1] = l_G_x_AG_theta_;
    const Lanes l_G_y_AG_theta_ = inverse_pivot_AG_theta_*n_G_y_AG_theta_;
    lin->lu[2] = l_G_y_AG_theta_;
    const Lanes scale_AH_theta_ = n_AH_theta_AH_theta_;
    *rare |= ~(lanes_fabs(scale_AH_theta_) > SINGULAR * lanes_fabs(n_AH_theta_AH_theta_));
    const Lanes inverse_pivot_AH_theta_ = 1.0/scale_AH_theta_;
    lin->lu[3] = inverse_pivot_AH_theta_;
    const Lanes l_H_x_AH_theta_ = inverse_pivot_AH_theta_*n_H_x_AH_theta_;
    lin->lu[4] = l_H_x_AH_theta_;
    const Lanes l_H_y_AH_theta_ = inverse_pivot_AH_theta_*n_H_y_AH_theta_;
    lin->lu[5] = l_H_y_AH_theta_;
    const Lanes scale_HE_theta_ = n_HE_theta_HE_theta_;
    *rare |= ~(lanes_fabs(scale_HE_theta_) > SINGULAR * lanes_fabs(n_HE_theta_HE_theta_));
    const Lanes inverse_pivot_HE_theta_ = 1.0/scale_HE_theta_;
    lin->lu[6] = inverse_pivot_HE_theta_;
    const Lanes l_BDE_theta_HE_theta_ = inverse_pivot_HE_theta_*n_BDE_theta_HE_theta_;
    lin->lu[7] = l_BDE_theta_HE_theta_;
    lin->lu[8] = n_HE_theta_BDE_theta_;
    const Lanes l_H_x_HE_theta_ = inverse_pivot_HE_theta_*n_H_x_HE_theta_;
    lin->lu[9] = l_H_x_HE_theta_;
    const Lanes l_H_y_HE_theta_ = inverse_pivot_HE_theta_*n_H_y_HE_theta_;
    lin->lu[10] = l_H_y_HE_theta_;
    const Lanes scale_BDE_theta_ = -l_BDE_theta_HE_theta_*n_HE_theta_BDE_theta_ + n_BDE_theta_BDE_theta_;
    *rare |= ~(lanes_fabs(scale_BDE_theta_) > SINGULAR * lanes_fabs(n_BDE_theta_BDE_theta_));
    const Lanes inverse_pivot_BDE_theta_ = 1.0/scale_BDE_theta_;
    lin->lu[11] = inverse_pivot_BDE_theta_;
    const Lanes l_H_x_BDE_theta_ = inverse_pivot_BDE_theta_*(-l_H_x_HE_theta_*n_HE_theta_BDE_theta_ + n_H_x_BDE_theta_);
    lin->lu[12] = l_H_x_BDE_theta_;
    const Lanes u_BDE_theta_H_x_ = -l_BDE_theta_HE_theta_*phi_H_x_HE_theta_ + phi_H_x_BDE_theta_;
    lin->lu[13] = u_BDE_theta_H_x_;
    const Lanes l_H_y_BDE_theta_ = inverse_pivot_BDE_theta_*(-l_H_y_HE_theta_*n_HE_theta_BDE_theta_ + n_H_y_BDE_theta_);
    lin->lu[14] = l_H_y_BDE_theta_;
    const Lanes u_BDE_theta_H_y_ = -l_BDE_theta_HE_theta_*phi_H_y_HE_theta_ + phi_H_y_BDE_theta_;
    lin->lu[15] = u_BDE_theta_H_y_;
    const Lanes l_E3_x_BDE_theta_ = inverse_pivot_BDE_theta_*n_E3_x_BDE_theta_;
    lin->lu[16] = l_E3_x_BDE_theta_;
    const Lanes l_E3_y_BDE_theta_ = inverse_pivot_BDE_theta_*n_E3_y_BDE_theta_;
    lin->lu[17] = l_E3_y_BDE_theta_;
    const Lanes scale_H_x_ = -l_H_x_AH_theta_*phi_H_x_AH_theta_ - l_H_x_BDE_theta_*u_BDE_theta_H_x_
        - l_H_x_HE_theta_*phi_H_x_HE_theta_;
    *rare |= ~((lanes_fabs(scale_H_x_) > 0.0) & (lanes_fabs(scale_H_x_) < INFINITY));
    const Lanes inverse_pivot_H_x_ = 1.0/scale_H_x_;
    lin->lu[18] = inverse_pivot_H_x_;
    const Lanes l_H_y_H_x_ = inverse_pivot_H_x_*(-l_H_y_AH_theta_*phi_H_x_AH_theta_ - l_H_y_BDE_theta_*u_BDE_theta_H_x_
        - l_H_y_HE_theta_*phi_H_x_HE_theta_);
    lin->lu[19] = l_H_y_H_x_;
    const Lanes u_H_x_H_y_ = -l_H_x_AH_theta_*phi_H_y_AH_theta_ - l_H_x_BDE_theta_*u_BDE_theta_H_y_
        - l_H_x_HE_theta_*phi_H_y_HE_theta_;
    lin->lu[20] = u_H_x_H_y_;
    const Lanes l_E3_x_H_x_ = -inverse_pivot_H_x_*l_E3_x_BDE_theta_*u_BDE_theta_H_x_;
    lin->lu[21] = l_E3_x_H_x_;
    const Lanes u_H_x_E3_x_ = l_H_x_BDE_theta_*phi_H_x_BDE_theta_;
    lin->lu[22] = u_H_x_E3_x_;
    const Lanes l_E3_y_H_x_ = -inverse_pivot_H_x_*l_E3_y_BDE_theta_*u_BDE_theta_H_x_;
    lin->lu[23] = l_E3_y_H_x_;
    const Lanes u_H_x_E3_y_ = l_H_x_BDE_theta_*phi_H_y_BDE_theta_;
    lin->lu[24] = u_H_x_E3_y_;
    const Lanes scale_H_y_ = -l_H_y_AH_theta_*phi_H_y_AH_theta_ - l_H_y_BDE_theta_*u_BDE_theta_H_y_
        - l_H_y_HE_theta_*phi_H_y_HE_theta_;
    const Lanes pivot_H_y_ = -l_H_y_H_x_*u_H_x_H_y_ + scale_H_y_;
    *rare |= ~(lanes_fabs(pivot_H_y_) > SINGULAR * lanes_fabs(scale_H_y_));
    const Lanes inverse_pivot_H_y_ = 1.0/pivot_H_y_;
    lin->lu[25] = inverse_pivot_H_y_;
    const Lanes l_E3_x_H_y_ = inverse_pivot_H_y_*(-l_E3_x_BDE_theta_*u_BDE_theta_H_y_ - l_E3_x_H_x_*u_H_x_H_y_);
    lin->lu[26] = l_E3_x_H_y_;
    const Lanes u_H_y_E3_x_ = l_H_y_BDE_theta_*phi_H_x_BDE_theta_ - l_H_y_H_x_*u_H_x_E3_x_;
    lin->lu[27] = u_H_y_E3_x_;
    const Lanes l_E3_y_H_y_ = inverse_pivot_H_y_*(-l_E3_y_BDE_theta_*u_BDE_theta_H_y_ - l_E3_y_H_x_*u_H_x_H_y_);
    lin->lu[28] = l_E3_y_H_y_;
    const Lanes u_H_y_E3_y_ = l_H_y_BDE_theta_*phi_H_y_BDE_theta_ - l_H_y_H_x_*u_H_x_E3_y_;
    lin->lu[29] = u_H_y_E3_y_;
    const Lanes scale_EG_theta_ = n_EG_theta_EG_theta_;
    *rare |= ~(lanes_fabs(scale_EG_theta_) > SINGULAR * lanes_fabs(n_EG_theta_EG_theta_));
    const Lanes inverse_pivot_EG_theta_ = 1.0/scale_EG_theta_;
    lin->lu[30] = inverse_pivot_EG_theta_;
    const Lanes l_OF_theta_EG_theta_ = inverse_pivot_EG_theta_*n_OF_theta_EG_theta_;
    lin->lu[31] = l_OF_theta_EG_theta_;
    lin->lu[32] = n_EG_theta_OF_theta_;
    const Lanes l_FE_theta_EG_theta_ = inverse_pivot_EG_theta_*n_FE_theta_EG_theta_;
    lin->lu[33] = l_FE_theta_EG_theta_;
    lin->lu[34] = n_EG_theta_FE_theta_;
    const Lanes l_G_x_EG_theta_ = inverse_pivot_EG_theta_*n_G_x_EG_theta_;
    lin->lu[35] = l_G_x_EG_theta_;
    const Lanes l_G_y_EG_theta_ = inverse_pivot_EG_theta_*n_G_y_EG_theta_;
    lin->lu[36] = l_G_y_EG_theta_;
    const Lanes scale_OF_theta_ = -l_OF_theta_EG_theta_*n_EG_theta_OF_theta_ + n_OF_theta_OF_theta_;
    *rare |= ~(lanes_fabs(scale_OF_theta_) > SINGULAR * lanes_fabs(n_OF_theta_OF_theta_));
    const Lanes inverse_pivot_OF_theta_ = 1.0/scale_OF_theta_;
    lin->lu[37] = inverse_pivot_OF_theta_;
    const Lanes l_FE_theta_OF_theta_ = inverse_pivot_OF_theta_*(-l_FE_theta_EG_theta_*n_EG_theta_OF_theta_
        + n_FE_theta_OF_theta_);
    lin->lu[38] = l_FE_theta_OF_theta_;
    const Lanes u_OF_theta_FE_theta_ = -l_OF_theta_EG_theta_*n_EG_theta_FE_theta_ + n_OF_theta_FE_theta_;
    lin->lu[39] = u_OF_theta_FE_theta_;
    const Lanes l_G_x_OF_theta_ = inverse_pivot_OF_theta_*(-l_G_x_EG_theta_*n_EG_theta_OF_theta_ + n_G_x_OF_theta_);
    lin->lu[40] = l_G_x_OF_theta_;
    const Lanes u_OF_theta_G_x_ = -l_OF_theta_EG_theta_*phi_G_x_EG_theta_ + phi_G_x_OF_theta_;
    lin->lu[41] = u_OF_theta_G_x_;
    const Lanes l_G_y_OF_theta_ = inverse_pivot_OF_theta_*(-l_G_y_EG_theta_*n_EG_theta_OF_theta_ + n_G_y_OF_theta_);
    lin->lu[42] = l_G_y_OF_theta_;
    const Lanes u_OF_theta_G_y_ = -l_OF_theta_EG_theta_*phi_G_y_EG_theta_ + phi_G_y_OF_theta_;
    lin->lu[43] = u_OF_theta_G_y_;
    const Lanes l_E3_x_OF_theta_ = inverse_pivot_OF_theta_*n_E3_x_OF_theta_;
    lin->lu[44] = l_E3_x_OF_theta_;
    const Lanes l_E3_y_OF_theta_ = inverse_pivot_OF_theta_*n_E3_y_OF_theta_;
    lin->lu[45] = l_E3_y_OF_theta_;
    const Lanes scale_FE_theta_ = -l_FE_theta_EG_theta_*n_EG_theta_FE_theta_
        - l_FE_theta_OF_theta_*u_OF_theta_FE_theta_ + n_FE_theta_FE_theta_;
    *rare |= ~(lanes_fabs(scale_FE_theta_) > SINGULAR * lanes_fabs(n_FE_theta_FE_theta_));
    const Lanes inverse_pivot_FE_theta_ = 1.0/scale_FE_theta_;
    lin->lu[46] = inverse_pivot_FE_theta_;
    const Lanes l_G_x_FE_theta_ = inverse_pivot_FE_theta_*(-l_G_x_EG_theta_*n_EG_theta_FE_theta_
        - l_G_x_OF_theta_*u_OF_theta_FE_theta_ + n_G_x_FE_theta_);
    lin->lu[47] = l_G_x_FE_theta_;
    const Lanes u_FE_theta_G_x_ = -l_FE_theta_EG_theta_*phi_G_x_EG_theta_ - l_FE_theta_OF_theta_*u_OF_theta_G_x_
        + phi_G_x_FE_theta_;
    lin->lu[48] = u_FE_theta_G_x_;
    const Lanes l_G_y_FE_theta_ = inverse_pivot_FE_theta_*(-l_G_y_EG_theta_*n_EG_theta_FE_theta_
        - l_G_y_OF_theta_*u_OF_theta_FE_theta_ + n_G_y_FE_theta_);
    lin->lu[49] = l_G_y_FE_theta_;
    const Lanes u_FE_theta_G_y_ = -l_FE_theta_EG_theta_*phi_G_y_EG_theta_ - l_FE_theta_OF_theta_*u_OF_theta_G_y_
        + phi_G_y_FE_theta_;
    lin->lu[50] = u_FE_theta_G_y_;
    const Lanes l_E3_x_FE_theta_ = inverse_pivot_FE_theta_*(-l_E3_x_OF_theta_*u_OF_theta_FE_theta_ + n_E3_x_FE_theta_);
    lin->lu[51] = l_E3_x_FE_theta_;
    const Lanes u_FE_theta_E3_x_ = -l_FE_theta_OF_theta_*phi_G_x_OF_theta_ + phi_G_x_FE_theta_;
    lin->lu[52] = u_FE_theta_E3_x_;
    const Lanes l_E3_y_FE_theta_ = inverse_pivot_FE_theta_*(-l_E3_y_OF_theta_*u_OF_theta_FE_theta_ + n_E3_y_FE_theta_);
    lin->lu[53] = l_E3_y_FE_theta_;
    const Lanes u_FE_theta_E3_y_ = -l_FE_theta_OF_theta_*phi_G_y_OF_theta_ + phi_G_y_FE_theta_;
    lin->lu[54] = u_FE_theta_E3_y_;
    const Lanes scale_G_x_ = -l_G_x_AG_theta_*phi_G_x_AG_theta_ - l_G_x_EG_theta_*phi_G_x_EG_theta_
        - l_G_x_FE_theta_*u_FE_theta_G_x_ - l_G_x_OF_theta_*u_OF_theta_G_x_;
    *rare |= ~((lanes_fabs(scale_G_x_) > 0.0) & (lanes_fabs(scale_G_x_) < INFINITY));
    const Lanes inverse_pivot_G_x_ = 1.0/scale_G_x_;
    lin->lu[55] = inverse_pivot_G_x_;
    const Lanes l_G_y_G_x_ = inverse_pivot_G_x_*(-l_G_y_AG_theta_*phi_G_x_AG_theta_ - l_G_y_EG_theta_*phi_G_x_EG_theta_
        - l_G_y_FE_theta_*u_FE_theta_G_x_ - l_G_y_OF_theta_*u_OF_theta_G_x_);
    lin->lu[56] = l_G_y_G_x_;
    const Lanes u_G_x_G_y_ = -l_G_x_AG_theta_*phi_G_y_AG_theta_ - l_G_x_EG_theta_*phi_G_y_EG_theta_
        - l_G_x_FE_theta_*u_FE_theta_G_y_ - l_G_x_OF_theta_*u_OF_theta_G_y_;
    lin->lu[57] = u_G_x_G_y_;
    const Lanes l_E3_x_G_x_ = inverse_pivot_G_x_*(-l_E3_x_FE_theta_*u_FE_theta_G_x_ - l_E3_x_OF_theta_*u_OF_theta_G_x_);
    lin->lu[58] = l_E3_x_G_x_;
    const Lanes u_G_x_E3_x_ = -l_G_x_FE_theta_*u_FE_theta_E3_x_ - l_G_x_OF_theta_*phi_G_x_OF_theta_;
    lin->lu[59] = u_G_x_E3_x_;
    const Lanes l_E3_y_G_x_ = inverse_pivot_G_x_*(-l_E3_y_FE_theta_*u_FE_theta_G_x_ - l_E3_y_OF_theta_*u_OF_theta_G_x_);
    lin->lu[60] = l_E3_y_G_x_;
    const Lanes u_G_x_E3_y_ = -l_G_x_FE_theta_*u_FE_theta_E3_y_ - l_G_x_OF_theta_*phi_G_y_OF_theta_;
    lin->lu[61] = u_G_x_E3_y_;
    const Lanes scale_G_y_ = -l_G_y_AG_theta_*phi_G_y_AG_theta_ - l_G_y_EG_theta_*phi_G_y_EG_theta_
        - l_G_y_FE_theta_*u_FE_theta_G_y_ - l_G_y_OF_theta_*u_OF_theta_G_y_;
    const Lanes pivot_G_y_ = -l_G_y_G_x_*u_G_x_G_y_ + scale_G_y_;
    *rare |= ~(lanes_fabs(pivot_G_y_) > SINGULAR * lanes_fabs(scale_G_y_));
    const Lanes inverse_pivot_G_y_ = 1.0/pivot_G_y_;
    lin->lu[62] = inverse_pivot_G_y_;
    const Lanes l_E3_x_G_y_ = inverse_pivot_G_y_*(-l_E3_x_FE_theta_*u_FE_theta_G_y_ - l_E3_x_G_x_*u_G_x_G_y_
        - l_E3_x_OF_theta_*u_OF_theta_G_y_);
    lin->lu[63] = l_E3_x_G_y_;
    const Lanes u_G_y_E3_x_ = -l_G_y_FE_theta_*u_FE_theta_E3_x_ - l_G_y_G_x_*u_G_x_E3_x_
        - l_G_y_OF_theta_*phi_G_x_OF_theta_;
    lin->lu[64] = u_G_y_E3_x_;
    const Lanes l_E3_y_G_y_ = inverse_pivot_G_y_*(-l_E3_y_FE_theta_*u_FE_theta_G_y_ - l_E3_y_G_x_*u_G_x_G_y_
        - l_E3_y_OF_theta_*u_OF_theta_G_y_);
    lin->lu[65] = l_E3_y_G_y_;
    const Lanes u_G_y_E3_y_ = -l_G_y_FE_theta_*u_FE_theta_E3_y_ - l_G_y_G_x_*u_G_x_E3_y_
        - l_G_y_OF_theta_*phi_G_y_OF_theta_;
    lin->lu[66] = u_G_y_E3_y_;
    const Lanes scale_E3_x_ = l_E3_x_BDE_theta_*phi_H_x_BDE_theta_ - l_E3_x_FE_theta_*u_FE_theta_E3_x_
        - l_E3_x_OF_theta_*phi_G_x_OF_theta_;
    const Lanes pivot_E3_x_ = -l_E3_x_G_x_*u_G_x_E3_x_ - l_E3_x_G_y_*u_G_y_E3_x_ - l_E3_x_H_x_*u_H_x_E3_x_
        - l_E3_x_H_y_*u_H_y_E3_x_ + scale_E3_x_;
    *rare |= ~(lanes_fabs(pivot_E3_x_) > SINGULAR * lanes_fabs(scale_E3_x_));
    const Lanes inverse_pivot_E3_x_ = 1.0/pivot_E3_x_;
    lin->lu[67] = inverse_pivot_E3_x_;
    const Lanes l_E3_y_E3_x_ = inverse_pivot_E3_x_*(l_E3_y_BDE_theta_*phi_H_x_BDE_theta_
        - l_E3_y_FE_theta_*u_FE_theta_E3_x_ - l_E3_y_G_x_*u_G_x_E3_x_ - l_E3_y_G_y_*u_G_y_E3_x_
        - l_E3_y_H_x_*u_H_x_E3_x_ - l_E3_y_H_y_*u_H_y_E3_x_ - l_E3_y_OF_theta_*phi_G_x_OF_theta_);
    lin->lu[68] = l_E3_y_E3_x_;
    const Lanes u_E3_x_E3_y_ = l_E3_x_BDE_theta_*phi_H_y_BDE_theta_ - l_E3_x_FE_theta_*u_FE_theta_E3_y_
        - l_E3_x_G_x_*u_G_x_E3_y_ - l_E3_x_G_y_*u_G_y_E3_y_ - l_E3_x_H_x_*u_H_x_E3_y_ - l_E3_x_H_y_*u_H_y_E3_y_
        - l_E3_x_OF_theta_*phi_G_y_OF_theta_;
    lin->lu[69] = u_E3_x_E3_y_;
    const Lanes scale_E3_y_ = l_E3_y_BDE_theta_*phi_H_y_BDE_theta_ - l_E3_y_FE_theta_*u_FE_theta_E3_y_
        - l_E3_y_OF_theta_*phi_G_y_OF_theta_;
    const Lanes pivot_E3_y_ = -l_E3_y_E3_x_*u_E3_x_E3_y_ - l_E3_y_G_x_*u_G_x_E3_y_ - l_E3_y_G_y_*u_G_y_E3_y_
        - l_E3_y_H_x_*u_H_x_E3_y_ - l_E3_y_H_y_*u_H_y_E3_y_ + scale_E3_y_;
    *rare |= ~(lanes_fabs(pivot_E3_y_) > SINGULAR * lanes_fabs(scale_E3_y_));
    const Lanes inverse_pivot_E3_y_ = 1.0/pivot_E3_y_;
    lin->lu[70] = inverse_pivot_E3_y_;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute(const LaneLinear *lin, Lanes *x)
{
    /* linearization */
    const Lanes phi_G_x_OF_theta_ = lin->value[4];
    const Lanes phi_G_x_AG_theta_ = lin->value[5];
    const Lanes phi_G_x_EG_theta_ = lin->value[7];
    const Lanes phi_G_y_OF_theta_ = lin->value[8];
    const Lanes phi_G_y_AG_theta_ = lin->value[9];
    const Lanes phi_G_y_EG_theta_ = lin->value[11];
    const Lanes phi_H_x_BDE_theta_ = lin->value[12];
    const Lanes phi_H_x_AH_theta_ = lin->value[13];
    const Lanes phi_H_x_HE_theta_ = lin->value[14];
    const Lanes phi_H_y_BDE_theta_ = lin->value[15];
    const Lanes phi_H_y_AH_theta_ = lin->value[16];
    const Lanes phi_H_y_HE_theta_ = lin->value[17];
    const Lanes inverse_pivot_AG_theta_ = lin->lu[0];
    const Lanes l_G_x_AG_theta_ = lin->lu[1];
    const Lanes l_G_y_AG_theta_ = lin->lu[2];
    const Lanes inverse_pivot_AH_theta_ = lin->lu[3];
    const Lanes l_H_x_AH_theta_ = lin->lu[4];
    const Lanes l_H_y_AH_theta_ = lin->lu[5];
    const Lanes inverse_pivot_HE_theta_ = lin->lu[6];
    const Lanes l_BDE_theta_HE_theta_ = lin->lu[7];
    const Lanes n_HE_theta_BDE_theta_ = lin->lu[8];
    const Lanes l_H_x_HE_theta_ = lin->lu[9];
    const Lanes l_H_y_HE_theta_ = lin->lu[10];
    const Lanes inverse_pivot_BDE_theta_ = lin->lu[11];
    const Lanes l_H_x_BDE_theta_ = lin->lu[12];
    const Lanes u_BDE_theta_H_x_ = lin->lu[13];
    const Lanes l_H_y_BDE_theta_ = lin->lu[14];
    const Lanes u_BDE_theta_H_y_ = lin->lu[15];
    const Lanes l_E3_x_BDE_theta_ = lin->lu[16];
    const Lanes l_E3_y_BDE_theta_ = lin->lu[17];
    const Lanes inverse_pivot_H_x_ = lin->lu[18];
    const Lanes l_H_y_H_x_ = lin->lu[19];
    const Lanes u_H_x_H_y_ = lin->lu[20];
    const Lanes l_E3_x_H_x_ = lin->lu[21];
    const Lanes u_H_x_E3_x_ = lin->lu[22];
    const Lanes l_E3_y_H_x_ = lin->lu[23];
    const Lanes u_H_x_E3_y_ = lin->lu[24];
    const Lanes inverse_pivot_H_y_ = lin->lu[25];
    const Lanes l_E3_x_H_y_ = lin->lu[26];
    const Lanes u_H_y_E3_x_ = lin->lu[27];
    const Lanes l_E3_y_H_y_ = lin->lu[28];
    const Lanes u_H_y_E3_y_ = lin->lu[29];
    const Lanes inverse_pivot_EG_theta_ = lin->lu[30];
    const Lanes l_OF_theta_EG_theta_ = lin->lu[31];
    const Lanes n_EG_theta_OF_theta_ = lin->lu[32];
    const Lanes l_FE_theta_EG_theta_ = lin->lu[33];
    const Lanes n_EG_theta_FE_theta_ = lin->lu[34];
    const Lanes l_G_x_EG_theta_ = lin->lu[35];
    const Lanes l_G_y_EG_theta_ = lin->lu[36];
    const Lanes inverse_pivot_OF_theta_ = lin->lu[37];
    const Lanes l_FE_theta_OF_theta_ = lin->lu[38];
    const Lanes u_OF_theta_FE_theta_ = lin->lu[39];
    const Lanes l_G_x_OF_theta_ = lin->lu[40];
    const Lanes u_OF_theta_G_x_ = lin->lu[41];
    const Lanes l_G_y_OF_theta_ = lin->lu[42];
    const Lanes u_OF_theta_G_y_ = lin->lu[43];
    const Lanes l_E3_x_OF_theta_ = lin->lu[44];
    const Lanes l_E3_y_OF_theta_ = lin->lu[45];
    const Lanes inverse_pivot_FE_theta_ = lin->lu[46];
    const Lanes l_G_x_FE_theta_ = lin->lu[47];
    const Lanes u_FE_theta_G_x_ = lin->lu[48];
    const Lanes l_G_y_FE_theta_ = lin->lu[49];
    const Lanes u_FE_theta_G_y_ = lin->lu[50];
    const Lanes l_E3_x_FE_theta_ = lin->lu[51];
    const Lanes u_FE_theta_E3_x_ = lin->lu[52];
    const Lanes l_E3_y_FE_theta_ = lin->lu[53];
    const Lanes u_FE_theta_E3_y_ = lin->lu[54];
    const Lanes inverse_pivot_G_x_ = lin->lu[55];
    const Lanes l_G_y_G_x_ = lin->lu[56];
    const Lanes u_G_x_G_y_ = lin->lu[57];
    const Lanes l_E3_x_G_x_ = lin->lu[58];
    const Lanes u_G_x_E3_x_ = lin->lu[59];
    const Lanes l_E3_y_G_x_ = lin->lu[60];
    const Lanes u_G_x_E3_y_ = lin->lu[61];
    const Lanes inverse_pivot_G_y_ = lin->lu[62];
    const Lanes l_E3_x_G_y_ = lin->lu[63];
    const Lanes u_G_y_E3_x_ = lin->lu[64];
    const Lanes l_E3_y_G_y_ = lin->lu[65];
    const Lanes u_G_y_E3_y_ = lin->lu[66];
    const Lanes inverse_pivot_E3_x_ = lin->lu[67];
    const Lanes l_E3_y_E3_x_ = lin->lu[68];
    const Lanes u_E3_x_E3_y_ = lin->lu[69];
    const Lanes inverse_pivot_E3_y_ = lin->lu[70];

    /* forward */
    const Lanes b_AG_theta_ = x[2];
    const Lanes b_AH_theta_ = x[3];
    const Lanes b_HE_theta_ = x[5];
    const Lanes b_BDE_theta_ = -b_HE_theta_*l_BDE_theta_HE_theta_ + x[1];
    const Lanes b_H_x_ = -b_AH_theta_*l_H_x_AH_theta_ - b_BDE_theta_*l_H_x_BDE_theta_ - b_HE_theta_*l_H_x_HE_theta_
        + x[9];
    const Lanes b_H_y_ = -b_AH_theta_*l_H_y_AH_theta_ - b_BDE_theta_*l_H_y_BDE_theta_ - b_HE_theta_*l_H_y_HE_theta_
        - b_H_x_*l_H_y_H_x_ + x[10];
    const Lanes b_EG_theta_ = x[6];
    const Lanes b_OF_theta_ = -b_EG_theta_*l_OF_theta_EG_theta_ + x[0];
    const Lanes b_FE_theta_ = -b_EG_theta_*l_FE_theta_EG_theta_ - b_OF_theta_*l_FE_theta_OF_theta_ + x[4];
    const Lanes b_G_x_ = -b_AG_theta_*l_G_x_AG_theta_ - b_EG_theta_*l_G_x_EG_theta_ - b_FE_theta_*l_G_x_FE_theta_
        - b_OF_theta_*l_G_x_OF_theta_ + x[7];
    const Lanes b_G_y_ = -b_AG_theta_*l_G_y_AG_theta_ - b_EG_theta_*l_G_y_EG_theta_ - b_FE_theta_*l_G_y_FE_theta_
        - b_G_x_*l_G_y_G_x_ - b_OF_theta_*l_G_y_OF_theta_ + x[8];
    const Lanes b_E3_x_ = -b_BDE_theta_*l_E3_x_BDE_theta_ - b_FE_theta_*l_E3_x_FE_theta_ - b_G_x_*l_E3_x_G_x_
        - b_G_y_*l_E3_x_G_y_ - b_H_x_*l_E3_x_H_x_ - b_H_y_*l_E3_x_H_y_ - b_OF_theta_*l_E3_x_OF_theta_ + x[11];
    const Lanes b_E3_y_ = -b_BDE_theta_*l_E3_y_BDE_theta_ - b_E3_x_*l_E3_y_E3_x_ - b_FE_theta_*l_E3_y_FE_theta_
        - b_G_x_*l_E3_y_G_x_ - b_G_y_*l_E3_y_G_y_ - b_H_x_*l_E3_y_H_x_ - b_H_y_*l_E3_y_H_y_
        - b_OF_theta_*l_E3_y_OF_theta_ + x[12];

    /* backward */
    const Lanes x_E3_y_ = b_E3_y_*inverse_pivot_E3_y_;
    x[12] = x_E3_y_;
    const Lanes x_E3_x_ = inverse_pivot_E3_x_*(b_E3_x_ - u_E3_x_E3_y_*x_E3_y_);
    x[11] = x_E3_x_;
    const Lanes x_G_y_ = inverse_pivot_G_y_*(b_G_y_ - u_G_y_E3_x_*x_E3_x_ - u_G_y_E3_y_*x_E3_y_);
    x[8] = x_G_y_;
    const Lanes x_G_x_ = inverse_pivot_G_x_*(b_G_x_ - u_G_x_E3_x_*x_E3_x_ - u_G_x_E3_y_*x_E3_y_ - u_G_x_G_y_*x_G_y_);
    x[7] = x_G_x_;
    const Lanes x_FE_theta_ = inverse_pivot_FE_theta_*(b_FE_theta_ - u_FE_theta_E3_x_*x_E3_x_
        - u_FE_theta_E3_y_*x_E3_y_ - u_FE_theta_G_x_*x_G_x_ - u_FE_theta_G_y_*x_G_y_);
    x[4] = x_FE_theta_;
    const Lanes x_OF_theta_ = inverse_pivot_OF_theta_*(b_OF_theta_ - phi_G_x_OF_theta_*x_E3_x_
        - phi_G_y_OF_theta_*x_E3_y_ - u_OF_theta_FE_theta_*x_FE_theta_ - u_OF_theta_G_x_*x_G_x_
        - u_OF_theta_G_y_*x_G_y_);
    x[0] = x_OF_theta_;
    const Lanes x_EG_theta_ = inverse_pivot_EG_theta_*(b_EG_theta_ - n_EG_theta_FE_theta_*x_FE_theta_
        - n_EG_theta_OF_theta_*x_OF_theta_ - phi_G_x_EG_theta_*x_G_x_ - phi_G_y_EG_theta_*x_G_y_);
    x[6] = x_EG_theta_;
    const Lanes x_H_y_ = inverse_pivot_H_y_*(b_H_y_ - u_H_y_E3_x_*x_E3_x_ - u_H_y_E3_y_*x_E3_y_);
    x[10] = x_H_y_;
    const Lanes x_H_x_ = inverse_pivot_H_x_*(b_H_x_ - u_H_x_E3_x_*x_E3_x_ - u_H_x_E3_y_*x_E3_y_ - u_H_x_H_y_*x_H_y_);
    x[9] = x_H_x_;
    const Lanes x_BDE_theta_ = inverse_pivot_BDE_theta_*(b_BDE_theta_ + phi_H_x_BDE_theta_*x_E3_x_
        + phi_H_y_BDE_theta_*x_E3_y_ - u_BDE_theta_H_x_*x_H_x_ - u_BDE_theta_H_y_*x_H_y_);
    x[1] = x_BDE_theta_;
    const Lanes x_HE_theta_ = inverse_pivot_HE_theta_*(b_HE_theta_ - n_HE_theta_BDE_theta_*x_BDE_theta_
        - phi_H_x_HE_theta_*x_H_x_ - phi_H_y_HE_theta_*x_H_y_);
    x[5] = x_HE_theta_;
    const Lanes x_AH_theta_ = inverse_pivot_AH_theta_*(b_AH_theta_ - phi_H_x_AH_theta_*x_H_x_
        - phi_H_y_AH_theta_*x_H_y_);
    x[3] = x_AH_theta_;
    const Lanes x_AG_theta_ = inverse_pivot_AG_theta_*(b_AG_theta_ - phi_G_x_AG_theta_*x_G_x_
        - phi_G_y_AG_theta_*x_G_y_);
    x[2] = x_AG_theta_;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 */
static void newton_solve(const LaneLinear *lin, Lanes eta, Lanes s, const Lanes *r, Lanes *u)
{
    (void)s;
    /* numbers of the run */
    const LaneParameters *const p = lin->p;

    /* linearization */
    const Lanes mass_OF_theta_FE_theta_ = lin->value[0];
    const Lanes mass_OF_theta_EG_theta_ = lin->value[1];
    const Lanes mass_FE_theta_EG_theta_ = lin->value[2];
    const Lanes mass_BDE_theta_HE_theta_ = lin->value[3];
    const Lanes phi_G_x_OF_theta_ = lin->value[4];
    const Lanes phi_G_x_AG_theta_ = lin->value[5];
    const Lanes phi_G_x_FE_theta_ = lin->value[6];
    const Lanes phi_G_x_EG_theta_ = lin->value[7];
    const Lanes phi_G_y_OF_theta_ = lin->value[8];
    const Lanes phi_G_y_AG_theta_ = lin->value[9];
    const Lanes phi_G_y_FE_theta_ = lin->value[10];
    const Lanes phi_G_y_EG_theta_ = lin->value[11];
    const Lanes phi_H_x_BDE_theta_ = lin->value[12];
    const Lanes phi_H_x_AH_theta_ = lin->value[13];
    const Lanes phi_H_x_HE_theta_ = lin->value[14];
    const Lanes phi_H_y_BDE_theta_ = lin->value[15];
    const Lanes phi_H_y_AH_theta_ = lin->value[16];
    const Lanes phi_H_y_HE_theta_ = lin->value[17];
    const Lanes by_q_G_x_AG_theta_ = lin->value[18];
    const Lanes by_q_G_x_EG_theta_ = lin->value[19];
    const Lanes by_q_G_x_FE_theta_ = lin->value[20];
    const Lanes by_q_G_x_OF_theta_ = lin->value[21];
    const Lanes by_q_G_y_AG_theta_ = lin->value[22];
    const Lanes by_q_G_y_EG_theta_ = lin->value[23];
    const Lanes by_q_G_y_FE_theta_ = lin->value[24];
    const Lanes by_q_G_y_OF_theta_ = lin->value[25];
    const Lanes by_q_H_x_AH_theta_ = lin->value[26];
    const Lanes by_q_H_x_BDE_theta_ = lin->value[27];
    const Lanes by_q_H_x_HE_theta_ = lin->value[28];
    const Lanes by_q_H_y_AH_theta_ = lin->value[29];
    const Lanes by_q_H_y_BDE_theta_ = lin->value[30];
    const Lanes by_q_H_y_HE_theta_ = lin->value[31];
    const Lanes by_q_OF_theta_OF_theta_ = lin->value[32];
    const Lanes by_q_OF_theta_EG_theta_ = lin->value[33];
    const Lanes by_q_OF_theta_FE_theta_ = lin->value[34];
    const Lanes by_q_BDE_theta_BDE_theta_ = lin->value[35];
    const Lanes by_q_BDE_theta_HE_theta_ = lin->value[36];
    const Lanes by_q_AG_theta_AG_theta_ = lin->value[37];
    const Lanes by_q_AH_theta_AH_theta_ = lin->value[38];
    const Lanes by_q_FE_theta_FE_theta_ = lin->value[39];
    const Lanes by_q_FE_theta_EG_theta_ = lin->value[40];
    const Lanes by_q_FE_theta_OF_theta_ = lin->value[41];
    const Lanes by_q_HE_theta_BDE_theta_ = lin->value[42];
    const Lanes by_q_HE_theta_HE_theta_ = lin->value[43];
    const Lanes by_q_EG_theta_FE_theta_ = lin->value[44];
    const Lanes by_q_EG_theta_EG_theta_ = lin->value[45];
    const Lanes by_q_EG_theta_OF_theta_ = lin->value[46];

    /* eta/kappa */
    const Lanes eta_row = eta/(eta*(p->beta_squared_*eta + p->two_alpha_) + 1.0);

    /* right-hand side */
    Lanes x[13];
    const Lanes shifted_OF_theta_ = -p->beta_squared_*eta*r[0] + r[7];
    const Lanes shifted_BDE_theta_ = -p->beta_squared_*eta*r[1] + r[8];
    const Lanes shifted_AG_theta_ = -p->beta_squared_*eta*r[2] + r[9];
    const Lanes shifted_AH_theta_ = -p->beta_squared_*eta*r[3] + r[10];
    const Lanes shifted_FE_theta_ = -p->beta_squared_*eta*r[4] + r[11];
    const Lanes shifted_HE_theta_ = -p->beta_squared_*eta*r[5] + r[12];
    const Lanes shifted_EG_theta_ = -p->beta_squared_*eta*r[6] + r[13];
    x[0] = eta*(-by_q_OF_theta_EG_theta_*eta*r[6] - by_q_OF_theta_FE_theta_*eta*r[4] - by_q_OF_theta_OF_theta_*eta*r[0]
        + p->mass_OF_OF_*r[7] + mass_OF_theta_EG_theta_*r[13] + mass_OF_theta_FE_theta_*r[11]);
    x[1] = eta*(-by_q_BDE_theta_BDE_theta_*eta*r[1] - by_q_BDE_theta_HE_theta_*eta*r[5] + p->mass_BDE_BDE_*r[8]
        + mass_BDE_theta_HE_theta_*r[12]);
    x[2] = eta*(-by_q_AG_theta_AG_theta_*eta*r[2] + p->mass_AG_AG_*r[9]);
    x[3] = eta*(-by_q_AH_theta_AH_theta_*eta*r[3] + p->mass_AH_AH_*r[10]);
    x[4] = eta*(-by_q_FE_theta_EG_theta_*eta*r[6] - by_q_FE_theta_FE_theta_*eta*r[4] - by_q_FE_theta_OF_theta_*eta*r[0]
        + p->mass_FE_FE_*r[11] + mass_FE_theta_EG_theta_*r[13] + mass_OF_theta_FE_theta_*r[7]);
    x[5] = eta*(-by_q_HE_theta_BDE_theta_*eta*r[1] - by_q_HE_theta_HE_theta_*eta*r[5] + mass_BDE_theta_HE_theta_*r[8]
        + p->mass_HE_HE_*r[12]);
    x[6] = eta*(-by_q_EG_theta_EG_theta_*eta*r[6] - by_q_EG_theta_FE_theta_*eta*r[4] - by_q_EG_theta_OF_theta_*eta*r[0]
        + p->mass_EG_EG_*r[13] + mass_FE_theta_EG_theta_*r[11] + mass_OF_theta_EG_theta_*r[7]);
    x[7] = eta_row*(-by_q_G_x_AG_theta_*eta*r[2] - by_q_G_x_EG_theta_*eta*r[6] - by_q_G_x_FE_theta_*eta*r[4]
        - by_q_G_x_OF_theta_*eta*r[0] + phi_G_x_AG_theta_*shifted_AG_theta_ + phi_G_x_EG_theta_*shifted_EG_theta_
        + phi_G_x_FE_theta_*shifted_FE_theta_ + phi_G_x_OF_theta_*shifted_OF_theta_);
    x[8] = eta_row*(-by_q_G_y_AG_theta_*eta*r[2] - by_q_G_y_EG_theta_*eta*r[6] - by_q_G_y_FE_theta_*eta*r[4]
        - by_q_G_y_OF_theta_*eta*r[0] + phi_G_y_AG_theta_*shifted_AG_theta_ + phi_G_y_EG_theta_*shifted_EG_theta_
        + phi_G_y_FE_theta_*shifted_FE_theta_ + phi_G_y_OF_theta_*shifted_OF_theta_);
    x[9] = eta_row*(-by_q_H_x_AH_theta_*eta*r[3] - by_q_H_x_BDE_theta_*eta*r[1] - by_q_H_x_HE_theta_*eta*r[5]
        + phi_H_x_AH_theta_*shifted_AH_theta_ + phi_H_x_BDE_theta_*shifted_BDE_theta_
        + phi_H_x_HE_theta_*shifted_HE_theta_);
    x[10] = eta_row*(-by_q_H_y_AH_theta_*eta*r[3] - by_q_H_y_BDE_theta_*eta*r[1] - by_q_H_y_HE_theta_*eta*r[5]
        + phi_H_y_AH_theta_*shifted_AH_theta_ + phi_H_y_BDE_theta_*shifted_BDE_theta_
        + phi_H_y_HE_theta_*shifted_HE_theta_);
    x[11] = eta_row*(-by_q_G_x_FE_theta_*eta*r[4] - by_q_G_x_OF_theta_*eta*r[0] + by_q_H_x_BDE_theta_*eta*r[1]
        + phi_G_x_FE_theta_*shifted_FE_theta_ + phi_G_x_OF_theta_*shifted_OF_theta_
        - phi_H_x_BDE_theta_*shifted_BDE_theta_);
    x[12] = eta_row*(-by_q_G_y_FE_theta_*eta*r[4] - by_q_G_y_OF_theta_*eta*r[0] + by_q_H_y_BDE_theta_*eta*r[1]
        + phi_G_y_FE_theta_*shifted_FE_theta_ + phi_G_y_OF_theta_*shifted_OF_theta_
        - phi_H_y_BDE_theta_*shifted_BDE_theta_);
    newton_substitute(lin, x);

    /* solution */
    u[0] = eta*(r[0] + x[0]);
    u[7] = x[0];
    u[1] = eta*(r[1] + x[1]);
    u[8] = x[1];
    u[2] = eta*(r[2] + x[2]);
    u[9] = x[2];
    u[3] = eta*(r[3] + x[3]);
    u[10] = x[3];
    u[4] = eta*(r[4] + x[4]);
    u[11] = x[4];
    u[5] = eta*(r[5] + x[5]);
    u[12] = x[5];
    u[6] = eta*(r[6] + x[6]);
    u[13] = x[6];
    u[14] = eta*r[14];
    u[15] = eta*(p->motor_value_*u[7] + r[15]);
    u[16] = eta*r[16];
}

#include "engine/batch/lane_tries.c"
#include "engine/batch/lane_flow.c"
#endif
