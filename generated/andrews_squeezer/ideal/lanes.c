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
    Lanes OF_mass;
    Lanes OF_inertia;
    Lanes FE_mass;
    Lanes FE_inertia;
    Lanes BDE_mass;
    Lanes BDE_inertia;
    Lanes EG_mass;
    Lanes EG_inertia;
    Lanes AG_mass;
    Lanes AG_inertia;
    Lanes HE_mass;
    Lanes HE_inertia;
    Lanes AH_mass;
    Lanes AH_inertia;
    Lanes OF_points_O_x;
    Lanes OF_points_F_x;
    Lanes FE_points_E_x;
    Lanes FE_points_F_x;
    Lanes BDE_points_B_x;
    Lanes BDE_points_B_y;
    Lanes BDE_points_E_x;
    Lanes BDE_points_E_y;
    Lanes BDE_points_D_x;
    Lanes BDE_points_D_y;
    Lanes EG_points_G_y;
    Lanes EG_points_E_y;
    Lanes AG_points_A_x;
    Lanes AG_points_A_y;
    Lanes AG_points_G_x;
    Lanes AG_points_G_y;
    Lanes HE_points_H_x;
    Lanes HE_points_E_x;
    Lanes AH_points_A_x;
    Lanes AH_points_A_y;
    Lanes AH_points_H_x;
    Lanes AH_points_H_y;
    Lanes alpha;
    Lanes beta;
    Lanes B_x;
    Lanes B_y;
    Lanes A_x;
    Lanes A_y;
    Lanes C_x;
    Lanes C_y;
    Lanes spring_stiffness;
    Lanes spring_free_length;
    Lanes motor_value;
    Lanes guess_FE_theta;
    Lanes guess_BDE_theta;
    Lanes guess_EG_theta;
    Lanes guess_AG_theta;
    Lanes guess_HE_theta;
    Lanes guess_AH_theta;
    Lanes set_OF_theta;
    Lanes two_alpha;
    Lanes beta_squared;
    Lanes inverse_OF_mass;
    Lanes inverse_BDE_mass;
    Lanes inverse_EG_mass;
    Lanes inverse_AG_mass;
    Lanes inverse_HE_mass;
    Lanes inverse_AH_mass;
    Lanes inverse_OF_inertia;
    Lanes inverse_FE_mass;
    Lanes inverse_BDE_inertia;
    Lanes inverse_EG_inertia;
    Lanes inverse_AG_inertia;
    Lanes inverse_HE_inertia;
    Lanes inverse_AH_inertia;
    Lanes inverse_FE_inertia;
    Lanes OF_com_span_x;
    Lanes BDE_com_span_x;
    Lanes BDE_com_span_y;
    Lanes AG_com_span_x;
    Lanes AG_com_span_y;
    Lanes AH_com_span_x;
    Lanes AH_com_span_y;
    Lanes OF_F_span_x;
    Lanes FE_com_span_x;
    Lanes BDE_E_span_x;
    Lanes BDE_E_span_y;
    Lanes HE_com_span_x;
    Lanes FE_E_span_x;
    Lanes EG_com_span_y;
    Lanes EG_G_span_y;
    Lanes AG_G_span_x;
    Lanes AG_G_span_y;
    Lanes HE_H_span_x;
    Lanes AH_H_span_x;
    Lanes AH_H_span_y;
    Lanes BDE_D_span_x;
    Lanes BDE_D_span_y;
    Lanes inertia_OF_OF;
    Lanes inertia_OF_FE;
    Lanes inertia_FE_FE;
    Lanes inertia_BDE_BDE;
    Lanes twist_OF_EG;
    Lanes twist_FE_EG;
    Lanes inertia_EG_EG;
    Lanes inertia_AG_AG;
    Lanes inertia_BDE_HE;
    Lanes twist_BDE_HE;
    Lanes inertia_HE_HE;
    Lanes inertia_AH_AH;
    Lanes mass_OF_OF;
    Lanes mass_FE_FE;
    Lanes mass_BDE_BDE;
    Lanes mass_EG_EG;
    Lanes mass_AG_AG;
    Lanes mass_HE_HE;
    Lanes mass_AH_AH;
    Lanes inverse_mass_AG_AG;
    Lanes inverse_mass_AH_AH;
    Lanes inverse_mass_HE_HE;
    Lanes inverse_mass_EG_EG;
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
    const Lanes OF_theta = q[0];
    const Lanes BDE_theta = q[1];
    const Lanes AG_theta = q[2];
    const Lanes AH_theta = q[3];
    const Lanes FE_theta = q[4];
    const Lanes HE_theta = q[5];
    const Lanes EG_theta = q[6];

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(OF_theta, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(BDE_theta, &sines_1, &cosines_1, rare);
    Lanes sines_2, cosines_2;
    sines_and_cosines(AG_theta, &sines_2, &cosines_2, rare);
    Lanes sines_3, cosines_3;
    sines_and_cosines(AH_theta, &sines_3, &cosines_3, rare);
    Lanes sines_4, cosines_4;
    sines_and_cosines(FE_theta, &sines_4, &cosines_4, rare);
    Lanes sines_5, cosines_5;
    sines_and_cosines(HE_theta, &sines_5, &cosines_5, rare);
    Lanes sines_6, cosines_6;
    sines_and_cosines(EG_theta, &sines_6, &cosines_6, rare);
    const Lanes cos_theta_OF = cosines_0;
    const Lanes sin_theta_OF = sines_0;
    const Lanes cos_theta_BDE = cosines_1;
    const Lanes sin_theta_BDE = sines_1;
    const Lanes cos_theta_AG = cosines_2;
    const Lanes sin_theta_AG = sines_2;
    const Lanes cos_theta_AH = cosines_3;
    const Lanes sin_theta_AH = sines_3;
    const Lanes cos_theta_FE = cosines_4;
    const Lanes sin_theta_FE = sines_4;
    const Lanes cos_theta_HE = cosines_5;
    const Lanes sin_theta_HE = sines_5;
    const Lanes cos_theta_EG = cosines_6;
    const Lanes sin_theta_EG = sines_6;
    const Lanes span_OF_F_x = p->OF_F_span_x*cos_theta_OF;
    const Lanes span_OF_F_y = p->OF_F_span_x*sin_theta_OF;
    const Lanes span_BDE_E_x = p->BDE_E_span_x*cos_theta_BDE - p->BDE_E_span_y*sin_theta_BDE;
    const Lanes span_BDE_E_y = p->BDE_E_span_x*sin_theta_BDE + p->BDE_E_span_y*cos_theta_BDE;
    const Lanes span_FE_E_x = p->FE_E_span_x*cos_theta_FE;
    const Lanes span_FE_E_y = p->FE_E_span_x*sin_theta_FE;
    const Lanes span_EG_G_x = -p->EG_G_span_y*sin_theta_EG;
    const Lanes span_EG_G_y = p->EG_G_span_y*cos_theta_EG;
    const Lanes span_AG_G_x = p->AG_G_span_x*cos_theta_AG - p->AG_G_span_y*sin_theta_AG;
    const Lanes span_AG_G_y = p->AG_G_span_x*sin_theta_AG + p->AG_G_span_y*cos_theta_AG;
    const Lanes span_HE_H_x = p->HE_H_span_x*cos_theta_HE;
    const Lanes span_HE_H_y = p->HE_H_span_x*sin_theta_HE;
    const Lanes span_AH_H_x = p->AH_H_span_x*cos_theta_AH - p->AH_H_span_y*sin_theta_AH;
    const Lanes span_AH_H_y = p->AH_H_span_x*sin_theta_AH + p->AH_H_span_y*cos_theta_AH;

    /* rows */
    out[0] = -p->A_x - span_AG_G_x + span_EG_G_x + span_FE_E_x + span_OF_F_x;  /* G.x */
    out[1] = -p->A_y - span_AG_G_y + span_EG_G_y + span_FE_E_y + span_OF_F_y;  /* G.y */
    out[2] = -p->A_x + p->B_x - span_AH_H_x + span_BDE_E_x + span_HE_H_x;  /* H.x */
    out[3] = -p->A_y + p->B_y - span_AH_H_y + span_BDE_E_y + span_HE_H_y;  /* H.y */
    out[4] = -p->B_x - span_BDE_E_x + span_FE_E_x + span_OF_F_x;  /* E3.x */
    out[5] = -p->B_y - span_BDE_E_y + span_FE_E_y + span_OF_F_y;  /* E3.y */
}

/*
 * Its rate Phi_q v - nu.
 */
static void closure_rates(const Lanes t, const Lanes *q, const Lanes *v, const LaneParameters *p, Lanes *out,
    LaneBits *rare)
{
    (void)t;
    /* coordinates, velocities, time */
    const Lanes OF_theta = q[0];
    const Lanes OF_omega = v[0];
    const Lanes BDE_theta = q[1];
    const Lanes BDE_omega = v[1];
    const Lanes AG_theta = q[2];
    const Lanes AG_omega = v[2];
    const Lanes AH_theta = q[3];
    const Lanes AH_omega = v[3];
    const Lanes FE_theta = q[4];
    const Lanes FE_omega = v[4];
    const Lanes HE_theta = q[5];
    const Lanes HE_omega = v[5];
    const Lanes EG_theta = q[6];
    const Lanes EG_omega = v[6];

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(OF_theta, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(BDE_theta, &sines_1, &cosines_1, rare);
    Lanes sines_2, cosines_2;
    sines_and_cosines(AG_theta, &sines_2, &cosines_2, rare);
    Lanes sines_3, cosines_3;
    sines_and_cosines(AH_theta, &sines_3, &cosines_3, rare);
    Lanes sines_4, cosines_4;
    sines_and_cosines(FE_theta, &sines_4, &cosines_4, rare);
    Lanes sines_5, cosines_5;
    sines_and_cosines(HE_theta, &sines_5, &cosines_5, rare);
    Lanes sines_6, cosines_6;
    sines_and_cosines(EG_theta, &sines_6, &cosines_6, rare);
    const Lanes cos_theta_OF = cosines_0;
    const Lanes sin_theta_OF = sines_0;
    const Lanes cos_theta_BDE = cosines_1;
    const Lanes sin_theta_BDE = sines_1;
    const Lanes cos_theta_AG = cosines_2;
    const Lanes sin_theta_AG = sines_2;
    const Lanes cos_theta_AH = cosines_3;
    const Lanes sin_theta_AH = sines_3;
    const Lanes cos_theta_FE = cosines_4;
    const Lanes sin_theta_FE = sines_4;
    const Lanes cos_theta_HE = cosines_5;
    const Lanes sin_theta_HE = sines_5;
    const Lanes cos_theta_EG = cosines_6;
    const Lanes sin_theta_EG = sines_6;
    const Lanes span_OF_F_x = p->OF_F_span_x*cos_theta_OF;
    const Lanes span_OF_F_y = p->OF_F_span_x*sin_theta_OF;
    const Lanes span_BDE_E_x = p->BDE_E_span_x*cos_theta_BDE - p->BDE_E_span_y*sin_theta_BDE;
    const Lanes span_BDE_E_y = p->BDE_E_span_x*sin_theta_BDE + p->BDE_E_span_y*cos_theta_BDE;
    const Lanes span_FE_E_x = p->FE_E_span_x*cos_theta_FE;
    const Lanes span_FE_E_y = p->FE_E_span_x*sin_theta_FE;
    const Lanes span_EG_G_x = -p->EG_G_span_y*sin_theta_EG;
    const Lanes span_EG_G_y = p->EG_G_span_y*cos_theta_EG;
    const Lanes span_AG_G_x = p->AG_G_span_x*cos_theta_AG - p->AG_G_span_y*sin_theta_AG;
    const Lanes span_AG_G_y = p->AG_G_span_x*sin_theta_AG + p->AG_G_span_y*cos_theta_AG;
    const Lanes span_HE_H_x = p->HE_H_span_x*cos_theta_HE;
    const Lanes span_HE_H_y = p->HE_H_span_x*sin_theta_HE;
    const Lanes span_AH_H_x = p->AH_H_span_x*cos_theta_AH - p->AH_H_span_y*sin_theta_AH;
    const Lanes span_AH_H_y = p->AH_H_span_x*sin_theta_AH + p->AH_H_span_y*cos_theta_AH;

    /* rows */
    out[0] = AG_omega*span_AG_G_y - EG_omega*span_EG_G_y - FE_omega*span_FE_E_y - OF_omega*span_OF_F_y;  /* G.x */
    out[1] = -AG_omega*span_AG_G_x + EG_omega*span_EG_G_x + FE_omega*span_FE_E_x + OF_omega*span_OF_F_x;  /* G.y */
    out[2] = AH_omega*span_AH_H_y - BDE_omega*span_BDE_E_y - HE_omega*span_HE_H_y;  /* H.x */
    out[3] = -AH_omega*span_AH_H_x + BDE_omega*span_BDE_E_x + HE_omega*span_HE_H_x;  /* H.y */
    out[4] = BDE_omega*span_BDE_E_y - FE_omega*span_FE_E_y - OF_omega*span_OF_F_y;  /* E3.x */
    out[5] = -BDE_omega*span_BDE_E_x + FE_omega*span_FE_E_x + OF_omega*span_OF_F_x;  /* E3.y */
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
    const Lanes OF_theta = q[0];
    const Lanes OF_omega = v[0];
    const Lanes BDE_theta = q[1];
    const Lanes BDE_omega = v[1];
    const Lanes AG_theta = q[2];
    const Lanes AG_omega = v[2];
    const Lanes AH_theta = q[3];
    const Lanes AH_omega = v[3];
    const Lanes FE_theta = q[4];
    const Lanes FE_omega = v[4];
    const Lanes HE_theta = q[5];
    const Lanes HE_omega = v[5];
    const Lanes EG_theta = q[6];
    const Lanes EG_omega = v[6];

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(OF_theta, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(BDE_theta, &sines_1, &cosines_1, rare);
    Lanes sines_2, cosines_2;
    sines_and_cosines(AG_theta, &sines_2, &cosines_2, rare);
    Lanes sines_3, cosines_3;
    sines_and_cosines(AH_theta, &sines_3, &cosines_3, rare);
    Lanes sines_4, cosines_4;
    sines_and_cosines(FE_theta, &sines_4, &cosines_4, rare);
    Lanes sines_5, cosines_5;
    sines_and_cosines(HE_theta, &sines_5, &cosines_5, rare);
    Lanes sines_6, cosines_6;
    sines_and_cosines(EG_theta, &sines_6, &cosines_6, rare);
    const Lanes cos_theta_OF = cosines_0;
    const Lanes sin_theta_OF = sines_0;
    const Lanes cos_theta_BDE = cosines_1;
    const Lanes sin_theta_BDE = sines_1;
    const Lanes cos_theta_AG = cosines_2;
    const Lanes sin_theta_AG = sines_2;
    const Lanes cos_theta_AH = cosines_3;
    const Lanes sin_theta_AH = sines_3;
    const Lanes cos_theta_FE = cosines_4;
    const Lanes sin_theta_FE = sines_4;
    const Lanes cos_theta_HE = cosines_5;
    const Lanes sin_theta_HE = sines_5;
    const Lanes cos_theta_EG = cosines_6;
    const Lanes sin_theta_EG = sines_6;
    const Lanes span_OF_F_x = p->OF_F_span_x*cos_theta_OF;
    const Lanes span_OF_F_y = p->OF_F_span_x*sin_theta_OF;
    const Lanes span_BDE_E_x = p->BDE_E_span_x*cos_theta_BDE - p->BDE_E_span_y*sin_theta_BDE;
    const Lanes span_BDE_E_y = p->BDE_E_span_x*sin_theta_BDE + p->BDE_E_span_y*cos_theta_BDE;
    const Lanes span_FE_E_x = p->FE_E_span_x*cos_theta_FE;
    const Lanes span_FE_E_y = p->FE_E_span_x*sin_theta_FE;
    const Lanes span_EG_G_x = -p->EG_G_span_y*sin_theta_EG;
    const Lanes span_EG_G_y = p->EG_G_span_y*cos_theta_EG;
    const Lanes span_AG_G_x = p->AG_G_span_x*cos_theta_AG - p->AG_G_span_y*sin_theta_AG;
    const Lanes span_AG_G_y = p->AG_G_span_x*sin_theta_AG + p->AG_G_span_y*cos_theta_AG;
    const Lanes span_HE_H_x = p->HE_H_span_x*cos_theta_HE;
    const Lanes span_HE_H_y = p->HE_H_span_x*sin_theta_HE;
    const Lanes span_AH_H_x = p->AH_H_span_x*cos_theta_AH - p->AH_H_span_y*sin_theta_AH;
    const Lanes span_AH_H_y = p->AH_H_span_x*sin_theta_AH + p->AH_H_span_y*cos_theta_AH;
    const Lanes span_BDE_D_x = p->BDE_D_span_x*cos_theta_BDE - p->BDE_D_span_y*sin_theta_BDE;
    const Lanes span_BDE_D_y = p->BDE_D_span_x*sin_theta_BDE + p->BDE_D_span_y*cos_theta_BDE;
    const Lanes BDE_D_x = p->B_x + span_BDE_D_x;
    const Lanes BDE_D_y = p->B_y + span_BDE_D_y;
    const Lanes spring_span_x = BDE_D_x - p->C_x;
    const Lanes spring_span_y = BDE_D_y - p->C_y;
    const Lanes spring_length = lanes_sqrt((spring_span_x * spring_span_x) + (spring_span_y * spring_span_y));
    const Lanes spring_force = p->spring_stiffness*(-p->spring_free_length + spring_length);
    const Lanes spring_pull = spring_force/spring_length;
    const Lanes cos_FE_less_OF = cos_theta_FE*cos_theta_OF + sin_theta_FE*sin_theta_OF;
    const Lanes sin_FE_less_OF = -cos_theta_FE*sin_theta_OF + cos_theta_OF*sin_theta_FE;
    const Lanes dot_OF_FE = cos_FE_less_OF*p->inertia_OF_FE;
    const Lanes cross_OF_FE = p->inertia_OF_FE*sin_FE_less_OF;
    const Lanes cos_EG_less_OF = cos_theta_EG*cos_theta_OF + sin_theta_EG*sin_theta_OF;
    const Lanes sin_EG_less_OF = -cos_theta_EG*sin_theta_OF + cos_theta_OF*sin_theta_EG;
    const Lanes dot_OF_EG = -sin_EG_less_OF*p->twist_OF_EG;
    const Lanes cross_OF_EG = cos_EG_less_OF*p->twist_OF_EG;
    const Lanes cos_EG_less_FE = cos_theta_EG*cos_theta_FE + sin_theta_EG*sin_theta_FE;
    const Lanes sin_EG_less_FE = -cos_theta_EG*sin_theta_FE + cos_theta_FE*sin_theta_EG;
    const Lanes dot_FE_EG = -sin_EG_less_FE*p->twist_FE_EG;
    const Lanes cross_FE_EG = cos_EG_less_FE*p->twist_FE_EG;
    const Lanes cos_HE_less_BDE = cos_theta_BDE*cos_theta_HE + sin_theta_BDE*sin_theta_HE;
    const Lanes sin_HE_less_BDE = cos_theta_BDE*sin_theta_HE - cos_theta_HE*sin_theta_BDE;
    const Lanes dot_BDE_HE = cos_HE_less_BDE*p->inertia_BDE_HE - sin_HE_less_BDE*p->twist_BDE_HE;
    const Lanes cross_BDE_HE = cos_HE_less_BDE*p->twist_BDE_HE + p->inertia_BDE_HE*sin_HE_less_BDE;

    /* constraints: gamma */
    const Lanes rhs_G_x = -(AG_omega * AG_omega)*span_AG_G_x + (EG_omega * EG_omega)*span_EG_G_x
        + (FE_omega * FE_omega)*span_FE_E_x + (OF_omega * OF_omega)*span_OF_F_x;
    const Lanes rhs_G_y = -(AG_omega * AG_omega)*span_AG_G_y + (EG_omega * EG_omega)*span_EG_G_y
        + (FE_omega * FE_omega)*span_FE_E_y + (OF_omega * OF_omega)*span_OF_F_y;
    const Lanes rhs_H_x = -(AH_omega * AH_omega)*span_AH_H_x + (BDE_omega * BDE_omega)*span_BDE_E_x
        + (HE_omega * HE_omega)*span_HE_H_x;
    const Lanes rhs_H_y = -(AH_omega * AH_omega)*span_AH_H_y + (BDE_omega * BDE_omega)*span_BDE_E_y
        + (HE_omega * HE_omega)*span_HE_H_y;
    const Lanes rhs_E3_x = -(BDE_omega * BDE_omega)*span_BDE_E_x + (FE_omega * FE_omega)*span_FE_E_x
        + (OF_omega * OF_omega)*span_OF_F_x;
    const Lanes rhs_E3_y = -(BDE_omega * BDE_omega)*span_BDE_E_y + (FE_omega * FE_omega)*span_FE_E_y
        + (OF_omega * OF_omega)*span_OF_F_y;

    /* L D L^T of the KKT matrix */
    const Lanes l_G_x__AG_theta = p->inverse_mass_AG_AG*span_AG_G_y;
    const Lanes l_G_y__AG_theta = -p->inverse_mass_AG_AG*span_AG_G_x;
    const Lanes l_H_x__AH_theta = p->inverse_mass_AH_AH*span_AH_H_y;
    const Lanes l_H_y__AH_theta = -p->inverse_mass_AH_AH*span_AH_H_x;
    const Lanes l_H_x__HE_theta = -p->inverse_mass_HE_HE*span_HE_H_y;
    const Lanes l_H_y__HE_theta = p->inverse_mass_HE_HE*span_HE_H_x;
    const Lanes l_BDE_theta__HE_theta = dot_BDE_HE*p->inverse_mass_HE_HE;
    const Lanes scale_H_x = l_H_x__AH_theta*span_AH_H_y - l_H_x__HE_theta*span_HE_H_y;
    const Lanes scale_H_y = -l_H_y__AH_theta*span_AH_H_x + l_H_y__HE_theta*span_HE_H_x;
    const Lanes pivot_H_x__H_y = l_H_y__AH_theta*span_AH_H_y - l_H_y__HE_theta*span_HE_H_y;
    const Lanes determinant_H_x__H_y = -(pivot_H_x__H_y * pivot_H_x__H_y) + scale_H_x*scale_H_y;
    *rare |= ~((scale_H_x > 0.0) & (scale_H_x < INFINITY));
    *rare |= ~(determinant_H_x__H_y > EARLY * scale_H_y * scale_H_x);
    const Lanes size_H_x = scale_H_x + scale_H_y;
    *rare |= ~(scale_H_x > memory->least_size * size_H_x);
    *rare |= ~(determinant_H_x__H_y > memory->least_size * size_H_x * scale_H_x);
    const Lanes inverse_H_x__H_y = -1.0/determinant_H_x__H_y;
    const Lanes inverse_pivot_H_x = inverse_H_x__H_y*scale_H_y;
    const Lanes inverse_pivot_H_y = inverse_H_x__H_y*scale_H_x;
    const Lanes inverse_cross_H_x__H_y = -inverse_H_x__H_y*pivot_H_x__H_y;
    const Lanes w_BDE_theta__H_x = l_BDE_theta__HE_theta*span_HE_H_y - span_BDE_E_y;
    const Lanes w_BDE_theta__H_y = -l_BDE_theta__HE_theta*span_HE_H_x + span_BDE_E_x;
    const Lanes l_BDE_theta__H_x = inverse_cross_H_x__H_y*w_BDE_theta__H_y + inverse_pivot_H_x*w_BDE_theta__H_x;
    const Lanes l_BDE_theta__H_y = inverse_cross_H_x__H_y*w_BDE_theta__H_x + inverse_pivot_H_y*w_BDE_theta__H_y;
    const Lanes inverse_pivot_BDE_theta = 1.0/(-dot_BDE_HE*l_BDE_theta__HE_theta - l_BDE_theta__H_x*w_BDE_theta__H_x
        - l_BDE_theta__H_y*w_BDE_theta__H_y + p->mass_BDE_BDE);
    const Lanes l_E3_x__BDE_theta = inverse_pivot_BDE_theta*span_BDE_E_y;
    const Lanes l_E3_y__BDE_theta = -inverse_pivot_BDE_theta*span_BDE_E_x;
    const Lanes l_G_x__EG_theta = -p->inverse_mass_EG_EG*span_EG_G_y;
    const Lanes l_G_y__EG_theta = p->inverse_mass_EG_EG*span_EG_G_x;
    const Lanes l_OF_theta__EG_theta = dot_OF_EG*p->inverse_mass_EG_EG;
    const Lanes l_FE_theta__EG_theta = dot_FE_EG*p->inverse_mass_EG_EG;
    const Lanes scale_G_x = l_G_x__AG_theta*span_AG_G_y - l_G_x__EG_theta*span_EG_G_y;
    const Lanes scale_G_y = -l_G_y__AG_theta*span_AG_G_x + l_G_y__EG_theta*span_EG_G_x;
    const Lanes pivot_G_x__G_y = l_G_y__AG_theta*span_AG_G_y - l_G_y__EG_theta*span_EG_G_y;
    const Lanes determinant_G_x__G_y = -(pivot_G_x__G_y * pivot_G_x__G_y) + scale_G_x*scale_G_y;
    *rare |= ~((scale_G_x > 0.0) & (scale_G_x < INFINITY));
    *rare |= ~(determinant_G_x__G_y > EARLY * scale_G_y * scale_G_x);
    const Lanes size_G_x = scale_G_x + scale_G_y;
    *rare |= ~(scale_G_x > memory->least_size * size_G_x);
    *rare |= ~(determinant_G_x__G_y > memory->least_size * size_G_x * scale_G_x);
    const Lanes inverse_G_x__G_y = -1.0/determinant_G_x__G_y;
    const Lanes inverse_pivot_G_x = inverse_G_x__G_y*scale_G_y;
    const Lanes inverse_pivot_G_y = inverse_G_x__G_y*scale_G_x;
    const Lanes inverse_cross_G_x__G_y = -inverse_G_x__G_y*pivot_G_x__G_y;
    const Lanes w_OF_theta__G_x = l_OF_theta__EG_theta*span_EG_G_y - span_OF_F_y;
    const Lanes w_OF_theta__G_y = -l_OF_theta__EG_theta*span_EG_G_x + span_OF_F_x;
    const Lanes l_OF_theta__G_x = inverse_cross_G_x__G_y*w_OF_theta__G_y + inverse_pivot_G_x*w_OF_theta__G_x;
    const Lanes l_OF_theta__G_y = inverse_cross_G_x__G_y*w_OF_theta__G_x + inverse_pivot_G_y*w_OF_theta__G_y;
    const Lanes w_FE_theta__G_x = l_FE_theta__EG_theta*span_EG_G_y - span_FE_E_y;
    const Lanes w_FE_theta__G_y = -l_FE_theta__EG_theta*span_EG_G_x + span_FE_E_x;
    const Lanes l_FE_theta__G_x = inverse_cross_G_x__G_y*w_FE_theta__G_y + inverse_pivot_G_x*w_FE_theta__G_x;
    const Lanes l_FE_theta__G_y = inverse_cross_G_x__G_y*w_FE_theta__G_x + inverse_pivot_G_y*w_FE_theta__G_y;
    const Lanes pivot_OF_theta = -dot_OF_EG*l_OF_theta__EG_theta - l_OF_theta__G_x*w_OF_theta__G_x
        - l_OF_theta__G_y*w_OF_theta__G_y + p->mass_OF_OF;
    const Lanes pivot_FE_theta = -dot_FE_EG*l_FE_theta__EG_theta - l_FE_theta__G_x*w_FE_theta__G_x
        - l_FE_theta__G_y*w_FE_theta__G_y + p->mass_FE_FE;
    const Lanes pivot_OF_theta__FE_theta = -dot_OF_EG*l_FE_theta__EG_theta + dot_OF_FE
        - l_FE_theta__G_x*w_OF_theta__G_x - l_FE_theta__G_y*w_OF_theta__G_y;
    const Lanes determinant_OF_theta__FE_theta = pivot_FE_theta*pivot_OF_theta
        - (pivot_OF_theta__FE_theta * pivot_OF_theta__FE_theta);
    const Lanes inverse_OF_theta__FE_theta = 1.0/determinant_OF_theta__FE_theta;
    const Lanes inverse_pivot_OF_theta = inverse_OF_theta__FE_theta*pivot_FE_theta;
    const Lanes inverse_pivot_FE_theta = inverse_OF_theta__FE_theta*pivot_OF_theta;
    const Lanes inverse_cross_OF_theta__FE_theta = -inverse_OF_theta__FE_theta*pivot_OF_theta__FE_theta;
    const Lanes l_E3_x__OF_theta = -inverse_cross_OF_theta__FE_theta*span_FE_E_y - inverse_pivot_OF_theta*span_OF_F_y;
    const Lanes l_E3_x__FE_theta = -inverse_cross_OF_theta__FE_theta*span_OF_F_y - inverse_pivot_FE_theta*span_FE_E_y;
    const Lanes l_E3_y__OF_theta = inverse_cross_OF_theta__FE_theta*span_FE_E_x + inverse_pivot_OF_theta*span_OF_F_x;
    const Lanes l_E3_y__FE_theta = inverse_cross_OF_theta__FE_theta*span_OF_F_x + inverse_pivot_FE_theta*span_FE_E_x;
    const Lanes scale_E3_x = l_E3_x__BDE_theta*span_BDE_E_y - l_E3_x__FE_theta*span_FE_E_y
        - l_E3_x__OF_theta*span_OF_F_y;
    const Lanes scale_E3_y = -l_E3_y__BDE_theta*span_BDE_E_x + l_E3_y__FE_theta*span_FE_E_x
        + l_E3_y__OF_theta*span_OF_F_x;
    const Lanes pivot_E3_x__E3_y = l_E3_y__BDE_theta*span_BDE_E_y - l_E3_y__FE_theta*span_FE_E_y
        - l_E3_y__OF_theta*span_OF_F_y;
    const Lanes determinant_E3_x__E3_y = -(pivot_E3_x__E3_y * pivot_E3_x__E3_y) + scale_E3_x*scale_E3_y;
    *rare |= ~((scale_E3_x > 0.0) & (scale_E3_x < INFINITY));
    *rare |= ~(determinant_E3_x__E3_y > memory->least * scale_E3_y * scale_E3_x);
    const Lanes size_E3_x = scale_E3_x + scale_E3_y;
    *rare |= ~(scale_E3_x > memory->least_size * size_E3_x);
    *rare |= ~(determinant_E3_x__E3_y > memory->least_size * size_E3_x * scale_E3_x);
    const Lanes inverse_E3_x__E3_y = -1.0/determinant_E3_x__E3_y;
    const Lanes inverse_pivot_E3_x = inverse_E3_x__E3_y*scale_E3_y;
    const Lanes inverse_pivot_E3_y = inverse_E3_x__E3_y*scale_E3_x;
    const Lanes inverse_cross_E3_x__E3_y = -inverse_E3_x__E3_y*pivot_E3_x__E3_y;

    /* forward substitution */
    const Lanes z_HE_theta = -(BDE_omega * BDE_omega)*cross_BDE_HE;
    const Lanes z_H_x = -l_H_x__HE_theta*z_HE_theta + rhs_H_x;
    const Lanes z_H_y = -l_H_y__HE_theta*z_HE_theta + rhs_H_y;
    const Lanes z_BDE_theta = (HE_omega * HE_omega)*cross_BDE_HE - l_BDE_theta__HE_theta*z_HE_theta
        - l_BDE_theta__H_x*z_H_x - l_BDE_theta__H_y*z_H_y - span_BDE_D_x*spring_pull*spring_span_y
        + span_BDE_D_y*spring_pull*spring_span_x;
    const Lanes z_EG_theta = -(FE_omega * FE_omega)*cross_FE_EG - (OF_omega * OF_omega)*cross_OF_EG;
    const Lanes z_G_x = -l_G_x__EG_theta*z_EG_theta + rhs_G_x;
    const Lanes z_G_y = -l_G_y__EG_theta*z_EG_theta + rhs_G_y;
    const Lanes z_OF_theta = (EG_omega * EG_omega)*cross_OF_EG + (FE_omega * FE_omega)*cross_OF_FE
        - l_OF_theta__EG_theta*z_EG_theta - l_OF_theta__G_x*z_G_x - l_OF_theta__G_y*z_G_y + p->motor_value;
    const Lanes z_FE_theta = (EG_omega * EG_omega)*cross_FE_EG - (OF_omega * OF_omega)*cross_OF_FE
        - l_FE_theta__EG_theta*z_EG_theta - l_FE_theta__G_x*z_G_x - l_FE_theta__G_y*z_G_y;
    const Lanes z_E3_x = -l_E3_x__BDE_theta*z_BDE_theta - l_E3_x__FE_theta*z_FE_theta - l_E3_x__OF_theta*z_OF_theta
        + rhs_E3_x;
    const Lanes z_E3_y = -l_E3_y__BDE_theta*z_BDE_theta - l_E3_y__FE_theta*z_FE_theta - l_E3_y__OF_theta*z_OF_theta
        + rhs_E3_y;

    /* backward substitution */
    const Lanes lambda_E3_y = inverse_cross_E3_x__E3_y*z_E3_x + inverse_pivot_E3_y*z_E3_y;
    const Lanes lambda_E3_x = inverse_cross_E3_x__E3_y*z_E3_y + inverse_pivot_E3_x*z_E3_x;
    const Lanes acceleration_FE_theta = inverse_cross_OF_theta__FE_theta*z_OF_theta + inverse_pivot_FE_theta*z_FE_theta
        - l_E3_x__FE_theta*lambda_E3_x - l_E3_y__FE_theta*lambda_E3_y;
    const Lanes acceleration_OF_theta = inverse_cross_OF_theta__FE_theta*z_FE_theta + inverse_pivot_OF_theta*z_OF_theta
        - l_E3_x__OF_theta*lambda_E3_x - l_E3_y__OF_theta*lambda_E3_y;
    const Lanes lambda_G_y = -acceleration_FE_theta*l_FE_theta__G_y - acceleration_OF_theta*l_OF_theta__G_y
        + inverse_cross_G_x__G_y*z_G_x + inverse_pivot_G_y*z_G_y;
    const Lanes lambda_G_x = -acceleration_FE_theta*l_FE_theta__G_x - acceleration_OF_theta*l_OF_theta__G_x
        + inverse_cross_G_x__G_y*z_G_y + inverse_pivot_G_x*z_G_x;
    const Lanes acceleration_EG_theta = -acceleration_FE_theta*l_FE_theta__EG_theta
        - acceleration_OF_theta*l_OF_theta__EG_theta + p->inverse_mass_EG_EG*z_EG_theta - l_G_x__EG_theta*lambda_G_x
        - l_G_y__EG_theta*lambda_G_y;
    const Lanes acceleration_BDE_theta = inverse_pivot_BDE_theta*z_BDE_theta - l_E3_x__BDE_theta*lambda_E3_x
        - l_E3_y__BDE_theta*lambda_E3_y;
    const Lanes lambda_H_y = -acceleration_BDE_theta*l_BDE_theta__H_y + inverse_cross_H_x__H_y*z_H_x
        + inverse_pivot_H_y*z_H_y;
    const Lanes lambda_H_x = -acceleration_BDE_theta*l_BDE_theta__H_x + inverse_cross_H_x__H_y*z_H_y
        + inverse_pivot_H_x*z_H_x;
    const Lanes acceleration_HE_theta = -acceleration_BDE_theta*l_BDE_theta__HE_theta
        + p->inverse_mass_HE_HE*z_HE_theta - l_H_x__HE_theta*lambda_H_x - l_H_y__HE_theta*lambda_H_y;
    const Lanes acceleration_AH_theta = -l_H_x__AH_theta*lambda_H_x - l_H_y__AH_theta*lambda_H_y;
    const Lanes acceleration_AG_theta = -l_G_x__AG_theta*lambda_G_x - l_G_y__AG_theta*lambda_G_y;

    /* results */
    a[0] = acceleration_OF_theta;
    a[1] = acceleration_BDE_theta;
    a[2] = acceleration_AG_theta;
    a[3] = acceleration_AH_theta;
    a[4] = acceleration_FE_theta;
    a[5] = acceleration_HE_theta;
    a[6] = acceleration_EG_theta;
    aside->lambda[0] = lambda_G_x;
    aside->lambda[1] = lambda_G_y;
    aside->lambda[2] = lambda_H_x;
    aside->lambda[3] = lambda_H_y;
    aside->lambda[4] = lambda_E3_x;
    aside->lambda[5] = lambda_E3_y;

    /* a pivot vanished: rows depend on each other here */
    aside->power[0] = all_of(0.0);
    aside->power[1] = OF_omega*p->motor_value;
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
    const Lanes OF_theta = q[0];
    const Lanes OF_omega = v[0];
    const Lanes BDE_theta = q[1];
    const Lanes BDE_omega = v[1];
    const Lanes AG_theta = q[2];
    const Lanes AG_omega = v[2];
    const Lanes AH_theta = q[3];
    const Lanes AH_omega = v[3];
    const Lanes FE_theta = q[4];
    const Lanes FE_omega = v[4];
    const Lanes HE_theta = q[5];
    const Lanes HE_omega = v[5];
    const Lanes EG_theta = q[6];
    const Lanes EG_omega = v[6];

    /* directions, arms, drives */
    Lanes sines_0, cosines_0;
    sines_and_cosines(OF_theta, &sines_0, &cosines_0, rare);
    Lanes sines_1, cosines_1;
    sines_and_cosines(BDE_theta, &sines_1, &cosines_1, rare);
    Lanes sines_2, cosines_2;
    sines_and_cosines(AG_theta, &sines_2, &cosines_2, rare);
    Lanes sines_3, cosines_3;
    sines_and_cosines(AH_theta, &sines_3, &cosines_3, rare);
    Lanes sines_4, cosines_4;
    sines_and_cosines(FE_theta, &sines_4, &cosines_4, rare);
    Lanes sines_5, cosines_5;
    sines_and_cosines(HE_theta, &sines_5, &cosines_5, rare);
    Lanes sines_6, cosines_6;
    sines_and_cosines(EG_theta, &sines_6, &cosines_6, rare);
    const Lanes cos_theta_OF = cosines_0;
    const Lanes sin_theta_OF = sines_0;
    const Lanes cos_theta_BDE = cosines_1;
    const Lanes sin_theta_BDE = sines_1;
    const Lanes cos_theta_AG = cosines_2;
    const Lanes sin_theta_AG = sines_2;
    const Lanes cos_theta_AH = cosines_3;
    const Lanes sin_theta_AH = sines_3;
    const Lanes cos_theta_FE = cosines_4;
    const Lanes sin_theta_FE = sines_4;
    const Lanes cos_theta_HE = cosines_5;
    const Lanes sin_theta_HE = sines_5;
    const Lanes cos_theta_EG = cosines_6;
    const Lanes sin_theta_EG = sines_6;
    const Lanes span_OF_F_x = p->OF_F_span_x*cos_theta_OF;
    const Lanes span_OF_F_y = p->OF_F_span_x*sin_theta_OF;
    const Lanes span_BDE_E_x = p->BDE_E_span_x*cos_theta_BDE - p->BDE_E_span_y*sin_theta_BDE;
    const Lanes span_BDE_E_y = p->BDE_E_span_x*sin_theta_BDE + p->BDE_E_span_y*cos_theta_BDE;
    const Lanes span_FE_E_x = p->FE_E_span_x*cos_theta_FE;
    const Lanes span_FE_E_y = p->FE_E_span_x*sin_theta_FE;
    const Lanes span_EG_G_x = -p->EG_G_span_y*sin_theta_EG;
    const Lanes span_EG_G_y = p->EG_G_span_y*cos_theta_EG;
    const Lanes span_AG_G_x = p->AG_G_span_x*cos_theta_AG - p->AG_G_span_y*sin_theta_AG;
    const Lanes span_AG_G_y = p->AG_G_span_x*sin_theta_AG + p->AG_G_span_y*cos_theta_AG;
    const Lanes span_HE_H_x = p->HE_H_span_x*cos_theta_HE;
    const Lanes span_HE_H_y = p->HE_H_span_x*sin_theta_HE;
    const Lanes span_AH_H_x = p->AH_H_span_x*cos_theta_AH - p->AH_H_span_y*sin_theta_AH;
    const Lanes span_AH_H_y = p->AH_H_span_x*sin_theta_AH + p->AH_H_span_y*cos_theta_AH;
    const Lanes cos_FE_less_OF = cos_theta_FE*cos_theta_OF + sin_theta_FE*sin_theta_OF;
    const Lanes dot_OF_FE = cos_FE_less_OF*p->inertia_OF_FE;
    const Lanes sin_EG_less_OF = -cos_theta_EG*sin_theta_OF + cos_theta_OF*sin_theta_EG;
    const Lanes dot_OF_EG = -sin_EG_less_OF*p->twist_OF_EG;
    const Lanes sin_EG_less_FE = -cos_theta_EG*sin_theta_FE + cos_theta_FE*sin_theta_EG;
    const Lanes dot_FE_EG = -sin_EG_less_FE*p->twist_FE_EG;
    const Lanes cos_HE_less_BDE = cos_theta_BDE*cos_theta_HE + sin_theta_BDE*sin_theta_HE;
    const Lanes sin_HE_less_BDE = cos_theta_BDE*sin_theta_HE - cos_theta_HE*sin_theta_BDE;
    const Lanes dot_BDE_HE = cos_HE_less_BDE*p->inertia_BDE_HE - sin_HE_less_BDE*p->twist_BDE_HE;

    /* Phi and Phi_dot */
    const Lanes phi_G_x = -p->A_x - span_AG_G_x + span_EG_G_x + span_FE_E_x + span_OF_F_x;
    const Lanes phi_dot_G_x = AG_omega*span_AG_G_y - EG_omega*span_EG_G_y - FE_omega*span_FE_E_y - OF_omega*span_OF_F_y;
    const Lanes phi_G_y = -p->A_y - span_AG_G_y + span_EG_G_y + span_FE_E_y + span_OF_F_y;
    const Lanes phi_dot_G_y = -AG_omega*span_AG_G_x + EG_omega*span_EG_G_x + FE_omega*span_FE_E_x
        + OF_omega*span_OF_F_x;
    const Lanes phi_H_x = -p->A_x + p->B_x - span_AH_H_x + span_BDE_E_x + span_HE_H_x;
    const Lanes phi_dot_H_x = AH_omega*span_AH_H_y - BDE_omega*span_BDE_E_y - HE_omega*span_HE_H_y;
    const Lanes phi_H_y = -p->A_y + p->B_y - span_AH_H_y + span_BDE_E_y + span_HE_H_y;
    const Lanes phi_dot_H_y = -AH_omega*span_AH_H_x + BDE_omega*span_BDE_E_x + HE_omega*span_HE_H_x;
    const Lanes phi_E3_x = -p->B_x - span_BDE_E_x + span_FE_E_x + span_OF_F_x;
    const Lanes phi_dot_E3_x = BDE_omega*span_BDE_E_y - FE_omega*span_FE_E_y - OF_omega*span_OF_F_y;
    const Lanes phi_E3_y = -p->B_y - span_BDE_E_y + span_FE_E_y + span_OF_F_y;
    const Lanes phi_dot_E3_y = -BDE_omega*span_BDE_E_x + FE_omega*span_FE_E_x + OF_omega*span_OF_F_x;

    /* L D L^T of the KKT matrix */
    const Lanes l_G_x__AG_theta = p->inverse_mass_AG_AG*span_AG_G_y;
    const Lanes l_G_y__AG_theta = -p->inverse_mass_AG_AG*span_AG_G_x;
    const Lanes l_H_x__AH_theta = p->inverse_mass_AH_AH*span_AH_H_y;
    const Lanes l_H_y__AH_theta = -p->inverse_mass_AH_AH*span_AH_H_x;
    const Lanes l_BDE_theta__HE_theta = dot_BDE_HE*p->inverse_mass_HE_HE;
    const Lanes l_H_x__HE_theta = -p->inverse_mass_HE_HE*span_HE_H_y;
    const Lanes l_H_y__HE_theta = p->inverse_mass_HE_HE*span_HE_H_x;
    const Lanes inverse_pivot_BDE_theta = 1.0/(-dot_BDE_HE*l_BDE_theta__HE_theta + p->mass_BDE_BDE);
    const Lanes w_H_x__BDE_theta = -dot_BDE_HE*l_H_x__HE_theta - span_BDE_E_y;
    const Lanes l_H_x__BDE_theta = inverse_pivot_BDE_theta*w_H_x__BDE_theta;
    const Lanes w_H_y__BDE_theta = -dot_BDE_HE*l_H_y__HE_theta + span_BDE_E_x;
    const Lanes l_H_y__BDE_theta = inverse_pivot_BDE_theta*w_H_y__BDE_theta;
    const Lanes l_E3_x__BDE_theta = inverse_pivot_BDE_theta*span_BDE_E_y;
    const Lanes l_E3_y__BDE_theta = -inverse_pivot_BDE_theta*span_BDE_E_x;
    const Lanes scale_H_x = l_H_x__AH_theta*span_AH_H_y + l_H_x__BDE_theta*w_H_x__BDE_theta
        - l_H_x__HE_theta*span_HE_H_y;
    const Lanes scale_H_y = -l_H_y__AH_theta*span_AH_H_x + l_H_y__BDE_theta*w_H_y__BDE_theta
        + l_H_y__HE_theta*span_HE_H_x;
    const Lanes pivot_H_x__H_y = l_H_y__AH_theta*span_AH_H_y + l_H_y__BDE_theta*w_H_x__BDE_theta
        - l_H_y__HE_theta*span_HE_H_y;
    const Lanes determinant_H_x__H_y = -(pivot_H_x__H_y * pivot_H_x__H_y) + scale_H_x*scale_H_y;
    *rare |= ~((scale_H_x > 0.0) & (scale_H_x < INFINITY));
    *rare |= ~(determinant_H_x__H_y > memory->least_size * scale_H_y * scale_H_x);
    const Lanes size_H_x = scale_H_x + scale_H_y;
    *rare |= ~(scale_H_x > memory->least_size * size_H_x);
    *rare |= ~(determinant_H_x__H_y > memory->least_size * size_H_x * scale_H_x);
    const Lanes inverse_H_x__H_y = -1.0/determinant_H_x__H_y;
    const Lanes inverse_pivot_H_x = inverse_H_x__H_y*scale_H_y;
    const Lanes inverse_pivot_H_y = inverse_H_x__H_y*scale_H_x;
    const Lanes inverse_cross_H_x__H_y = -inverse_H_x__H_y*pivot_H_x__H_y;
    const Lanes w_E3_x__H_x = -l_E3_x__BDE_theta*w_H_x__BDE_theta;
    const Lanes w_E3_x__H_y = -l_E3_x__BDE_theta*w_H_y__BDE_theta;
    const Lanes l_E3_x__H_x = inverse_cross_H_x__H_y*w_E3_x__H_y + inverse_pivot_H_x*w_E3_x__H_x;
    const Lanes l_E3_x__H_y = inverse_cross_H_x__H_y*w_E3_x__H_x + inverse_pivot_H_y*w_E3_x__H_y;
    const Lanes w_E3_y__H_x = -l_E3_y__BDE_theta*w_H_x__BDE_theta;
    const Lanes w_E3_y__H_y = -l_E3_y__BDE_theta*w_H_y__BDE_theta;
    const Lanes l_E3_y__H_x = inverse_cross_H_x__H_y*w_E3_y__H_y + inverse_pivot_H_x*w_E3_y__H_x;
    const Lanes l_E3_y__H_y = inverse_cross_H_x__H_y*w_E3_y__H_x + inverse_pivot_H_y*w_E3_y__H_y;
    const Lanes l_OF_theta__EG_theta = dot_OF_EG*p->inverse_mass_EG_EG;
    const Lanes l_FE_theta__EG_theta = dot_FE_EG*p->inverse_mass_EG_EG;
    const Lanes l_G_x__EG_theta = -p->inverse_mass_EG_EG*span_EG_G_y;
    const Lanes l_G_y__EG_theta = p->inverse_mass_EG_EG*span_EG_G_x;
    const Lanes pivot_OF_theta = -dot_OF_EG*l_OF_theta__EG_theta + p->mass_OF_OF;
    const Lanes pivot_FE_theta = -dot_FE_EG*l_FE_theta__EG_theta + p->mass_FE_FE;
    const Lanes pivot_OF_theta__FE_theta = -dot_OF_EG*l_FE_theta__EG_theta + dot_OF_FE;
    const Lanes determinant_OF_theta__FE_theta = pivot_FE_theta*pivot_OF_theta
        - (pivot_OF_theta__FE_theta * pivot_OF_theta__FE_theta);
    const Lanes inverse_OF_theta__FE_theta = 1.0/determinant_OF_theta__FE_theta;
    const Lanes inverse_pivot_OF_theta = inverse_OF_theta__FE_theta*pivot_FE_theta;
    const Lanes inverse_pivot_FE_theta = inverse_OF_theta__FE_theta*pivot_OF_theta;
    const Lanes inverse_cross_OF_theta__FE_theta = -inverse_OF_theta__FE_theta*pivot_OF_theta__FE_theta;
    const Lanes w_G_x__OF_theta = -dot_OF_EG*l_G_x__EG_theta - span_OF_F_y;
    const Lanes w_G_x__FE_theta = -dot_FE_EG*l_G_x__EG_theta - span_FE_E_y;
    const Lanes l_G_x__OF_theta = inverse_cross_OF_theta__FE_theta*w_G_x__FE_theta
        + inverse_pivot_OF_theta*w_G_x__OF_theta;
    const Lanes l_G_x__FE_theta = inverse_cross_OF_theta__FE_theta*w_G_x__OF_theta
        + inverse_pivot_FE_theta*w_G_x__FE_theta;
    const Lanes w_G_y__OF_theta = -dot_OF_EG*l_G_y__EG_theta + span_OF_F_x;
    const Lanes w_G_y__FE_theta = -dot_FE_EG*l_G_y__EG_theta + span_FE_E_x;
    const Lanes l_G_y__OF_theta = inverse_cross_OF_theta__FE_theta*w_G_y__FE_theta
        + inverse_pivot_OF_theta*w_G_y__OF_theta;
    const Lanes l_G_y__FE_theta = inverse_cross_OF_theta__FE_theta*w_G_y__OF_theta
        + inverse_pivot_FE_theta*w_G_y__FE_theta;
    const Lanes l_E3_x__OF_theta = -inverse_cross_OF_theta__FE_theta*span_FE_E_y - inverse_pivot_OF_theta*span_OF_F_y;
    const Lanes l_E3_x__FE_theta = -inverse_cross_OF_theta__FE_theta*span_OF_F_y - inverse_pivot_FE_theta*span_FE_E_y;
    const Lanes l_E3_y__OF_theta = inverse_cross_OF_theta__FE_theta*span_FE_E_x + inverse_pivot_OF_theta*span_OF_F_x;
    const Lanes l_E3_y__FE_theta = inverse_cross_OF_theta__FE_theta*span_OF_F_x + inverse_pivot_FE_theta*span_FE_E_x;
    const Lanes scale_G_x = l_G_x__AG_theta*span_AG_G_y - l_G_x__EG_theta*span_EG_G_y + l_G_x__FE_theta*w_G_x__FE_theta
        + l_G_x__OF_theta*w_G_x__OF_theta;
    const Lanes scale_G_y = -l_G_y__AG_theta*span_AG_G_x + l_G_y__EG_theta*span_EG_G_x
        + l_G_y__FE_theta*w_G_y__FE_theta + l_G_y__OF_theta*w_G_y__OF_theta;
    const Lanes pivot_G_x__G_y = l_G_y__AG_theta*span_AG_G_y - l_G_y__EG_theta*span_EG_G_y
        + l_G_y__FE_theta*w_G_x__FE_theta + l_G_y__OF_theta*w_G_x__OF_theta;
    const Lanes determinant_G_x__G_y = -(pivot_G_x__G_y * pivot_G_x__G_y) + scale_G_x*scale_G_y;
    *rare |= ~((scale_G_x > 0.0) & (scale_G_x < INFINITY));
    *rare |= ~(determinant_G_x__G_y > memory->least_size * scale_G_y * scale_G_x);
    const Lanes size_G_x = scale_G_x + scale_G_y;
    *rare |= ~(scale_G_x > memory->least_size * size_G_x);
    *rare |= ~(determinant_G_x__G_y > memory->least_size * size_G_x * scale_G_x);
    const Lanes inverse_G_x__G_y = -1.0/determinant_G_x__G_y;
    const Lanes inverse_pivot_G_x = inverse_G_x__G_y*scale_G_y;
    const Lanes inverse_pivot_G_y = inverse_G_x__G_y*scale_G_x;
    const Lanes inverse_cross_G_x__G_y = -inverse_G_x__G_y*pivot_G_x__G_y;
    const Lanes w_E3_x__G_x = -l_E3_x__FE_theta*w_G_x__FE_theta - l_E3_x__OF_theta*w_G_x__OF_theta;
    const Lanes w_E3_x__G_y = -l_E3_x__FE_theta*w_G_y__FE_theta - l_E3_x__OF_theta*w_G_y__OF_theta;
    const Lanes l_E3_x__G_x = inverse_cross_G_x__G_y*w_E3_x__G_y + inverse_pivot_G_x*w_E3_x__G_x;
    const Lanes l_E3_x__G_y = inverse_cross_G_x__G_y*w_E3_x__G_x + inverse_pivot_G_y*w_E3_x__G_y;
    const Lanes w_E3_y__G_x = -l_E3_y__FE_theta*w_G_x__FE_theta - l_E3_y__OF_theta*w_G_x__OF_theta;
    const Lanes w_E3_y__G_y = -l_E3_y__FE_theta*w_G_y__FE_theta - l_E3_y__OF_theta*w_G_y__OF_theta;
    const Lanes l_E3_y__G_x = inverse_cross_G_x__G_y*w_E3_y__G_y + inverse_pivot_G_x*w_E3_y__G_x;
    const Lanes l_E3_y__G_y = inverse_cross_G_x__G_y*w_E3_y__G_x + inverse_pivot_G_y*w_E3_y__G_y;
    const Lanes scale_E3_x = l_E3_x__BDE_theta*span_BDE_E_y - l_E3_x__FE_theta*span_FE_E_y
        - l_E3_x__OF_theta*span_OF_F_y;
    const Lanes scale_E3_y = -l_E3_y__BDE_theta*span_BDE_E_x + l_E3_y__FE_theta*span_FE_E_x
        + l_E3_y__OF_theta*span_OF_F_x;
    const Lanes pivot_E3_x = l_E3_x__G_x*w_E3_x__G_x + l_E3_x__G_y*w_E3_x__G_y + l_E3_x__H_x*w_E3_x__H_x
        + l_E3_x__H_y*w_E3_x__H_y + scale_E3_x;
    const Lanes pivot_E3_y = l_E3_y__G_x*w_E3_y__G_x + l_E3_y__G_y*w_E3_y__G_y + l_E3_y__H_x*w_E3_y__H_x
        + l_E3_y__H_y*w_E3_y__H_y + scale_E3_y;
    const Lanes pivot_E3_x__E3_y = l_E3_y__BDE_theta*span_BDE_E_y - l_E3_y__FE_theta*span_FE_E_y
        + l_E3_y__G_x*w_E3_x__G_x + l_E3_y__G_y*w_E3_x__G_y + l_E3_y__H_x*w_E3_x__H_x + l_E3_y__H_y*w_E3_x__H_y
        - l_E3_y__OF_theta*span_OF_F_y;
    const Lanes determinant_E3_x__E3_y = pivot_E3_x*pivot_E3_y - (pivot_E3_x__E3_y * pivot_E3_x__E3_y);
    *rare |= ~(pivot_E3_x > memory->least_size * scale_E3_x);
    *rare |= ~(determinant_E3_x__E3_y > memory->least_size * scale_E3_y * pivot_E3_x);
    const Lanes size_E3_x = scale_E3_x + scale_E3_y;
    *rare |= ~(pivot_E3_x > memory->least_size * size_E3_x);
    *rare |= ~(determinant_E3_x__E3_y > memory->least_size * size_E3_x * pivot_E3_x);
    const Lanes inverse_E3_x__E3_y = -1.0/determinant_E3_x__E3_y;
    const Lanes inverse_pivot_E3_x = inverse_E3_x__E3_y*pivot_E3_y;
    const Lanes inverse_pivot_E3_y = inverse_E3_x__E3_y*pivot_E3_x;
    const Lanes inverse_cross_E3_x__E3_y = -inverse_E3_x__E3_y*pivot_E3_x__E3_y;

    /* forward substitution */
    const Lanes dq_z_E3_x = -l_E3_x__G_x*phi_G_x - l_E3_x__G_y*phi_G_y - l_E3_x__H_x*phi_H_x - l_E3_x__H_y*phi_H_y
        + phi_E3_x;
    const Lanes dq_z_E3_y = -l_E3_y__G_x*phi_G_x - l_E3_y__G_y*phi_G_y - l_E3_y__H_x*phi_H_x - l_E3_y__H_y*phi_H_y
        + phi_E3_y;

    /* backward substitution */
    const Lanes dq_lambda_E3_y = dq_z_E3_x*inverse_cross_E3_x__E3_y + dq_z_E3_y*inverse_pivot_E3_y;
    const Lanes dq_lambda_E3_x = dq_z_E3_x*inverse_pivot_E3_x + dq_z_E3_y*inverse_cross_E3_x__E3_y;
    const Lanes dq_lambda_G_y = -dq_lambda_E3_x*l_E3_x__G_y - dq_lambda_E3_y*l_E3_y__G_y
        + inverse_cross_G_x__G_y*phi_G_x + inverse_pivot_G_y*phi_G_y;
    const Lanes dq_lambda_G_x = -dq_lambda_E3_x*l_E3_x__G_x - dq_lambda_E3_y*l_E3_y__G_x
        + inverse_cross_G_x__G_y*phi_G_y + inverse_pivot_G_x*phi_G_x;
    const Lanes dq_acceleration_FE_theta = -dq_lambda_E3_x*l_E3_x__FE_theta - dq_lambda_E3_y*l_E3_y__FE_theta
        - dq_lambda_G_x*l_G_x__FE_theta - dq_lambda_G_y*l_G_y__FE_theta;
    const Lanes dq_acceleration_OF_theta = -dq_lambda_E3_x*l_E3_x__OF_theta - dq_lambda_E3_y*l_E3_y__OF_theta
        - dq_lambda_G_x*l_G_x__OF_theta - dq_lambda_G_y*l_G_y__OF_theta;
    const Lanes dq_acceleration_EG_theta = -dq_acceleration_FE_theta*l_FE_theta__EG_theta
        - dq_acceleration_OF_theta*l_OF_theta__EG_theta - dq_lambda_G_x*l_G_x__EG_theta - dq_lambda_G_y*l_G_y__EG_theta;
    const Lanes dq_lambda_H_y = -dq_lambda_E3_x*l_E3_x__H_y - dq_lambda_E3_y*l_E3_y__H_y
        + inverse_cross_H_x__H_y*phi_H_x + inverse_pivot_H_y*phi_H_y;
    const Lanes dq_lambda_H_x = -dq_lambda_E3_x*l_E3_x__H_x - dq_lambda_E3_y*l_E3_y__H_x
        + inverse_cross_H_x__H_y*phi_H_y + inverse_pivot_H_x*phi_H_x;
    const Lanes dq_acceleration_BDE_theta = -dq_lambda_E3_x*l_E3_x__BDE_theta - dq_lambda_E3_y*l_E3_y__BDE_theta
        - dq_lambda_H_x*l_H_x__BDE_theta - dq_lambda_H_y*l_H_y__BDE_theta;
    const Lanes dq_acceleration_HE_theta = -dq_acceleration_BDE_theta*l_BDE_theta__HE_theta
        - dq_lambda_H_x*l_H_x__HE_theta - dq_lambda_H_y*l_H_y__HE_theta;
    const Lanes dq_acceleration_AH_theta = -dq_lambda_H_x*l_H_x__AH_theta - dq_lambda_H_y*l_H_y__AH_theta;
    const Lanes dq_acceleration_AG_theta = -dq_lambda_G_x*l_G_x__AG_theta - dq_lambda_G_y*l_G_y__AG_theta;

    /* forward substitution */
    const Lanes dv_z_E3_x = -l_E3_x__G_x*phi_dot_G_x - l_E3_x__G_y*phi_dot_G_y - l_E3_x__H_x*phi_dot_H_x
        - l_E3_x__H_y*phi_dot_H_y + phi_dot_E3_x;
    const Lanes dv_z_E3_y = -l_E3_y__G_x*phi_dot_G_x - l_E3_y__G_y*phi_dot_G_y - l_E3_y__H_x*phi_dot_H_x
        - l_E3_y__H_y*phi_dot_H_y + phi_dot_E3_y;

    /* backward substitution */
    const Lanes dv_lambda_E3_y = dv_z_E3_x*inverse_cross_E3_x__E3_y + dv_z_E3_y*inverse_pivot_E3_y;
    const Lanes dv_lambda_E3_x = dv_z_E3_x*inverse_pivot_E3_x + dv_z_E3_y*inverse_cross_E3_x__E3_y;
    const Lanes dv_lambda_G_y = -dv_lambda_E3_x*l_E3_x__G_y - dv_lambda_E3_y*l_E3_y__G_y
        + inverse_cross_G_x__G_y*phi_dot_G_x + inverse_pivot_G_y*phi_dot_G_y;
    const Lanes dv_lambda_G_x = -dv_lambda_E3_x*l_E3_x__G_x - dv_lambda_E3_y*l_E3_y__G_x
        + inverse_cross_G_x__G_y*phi_dot_G_y + inverse_pivot_G_x*phi_dot_G_x;
    const Lanes dv_acceleration_FE_theta = -dv_lambda_E3_x*l_E3_x__FE_theta - dv_lambda_E3_y*l_E3_y__FE_theta
        - dv_lambda_G_x*l_G_x__FE_theta - dv_lambda_G_y*l_G_y__FE_theta;
    const Lanes dv_acceleration_OF_theta = -dv_lambda_E3_x*l_E3_x__OF_theta - dv_lambda_E3_y*l_E3_y__OF_theta
        - dv_lambda_G_x*l_G_x__OF_theta - dv_lambda_G_y*l_G_y__OF_theta;
    const Lanes dv_acceleration_EG_theta = -dv_acceleration_FE_theta*l_FE_theta__EG_theta
        - dv_acceleration_OF_theta*l_OF_theta__EG_theta - dv_lambda_G_x*l_G_x__EG_theta - dv_lambda_G_y*l_G_y__EG_theta;
    const Lanes dv_lambda_H_y = -dv_lambda_E3_x*l_E3_x__H_y - dv_lambda_E3_y*l_E3_y__H_y
        + inverse_cross_H_x__H_y*phi_dot_H_x + inverse_pivot_H_y*phi_dot_H_y;
    const Lanes dv_lambda_H_x = -dv_lambda_E3_x*l_E3_x__H_x - dv_lambda_E3_y*l_E3_y__H_x
        + inverse_cross_H_x__H_y*phi_dot_H_y + inverse_pivot_H_x*phi_dot_H_x;
    const Lanes dv_acceleration_BDE_theta = -dv_lambda_E3_x*l_E3_x__BDE_theta - dv_lambda_E3_y*l_E3_y__BDE_theta
        - dv_lambda_H_x*l_H_x__BDE_theta - dv_lambda_H_y*l_H_y__BDE_theta;
    const Lanes dv_acceleration_HE_theta = -dv_acceleration_BDE_theta*l_BDE_theta__HE_theta
        - dv_lambda_H_x*l_H_x__HE_theta - dv_lambda_H_y*l_H_y__HE_theta;
    const Lanes dv_acceleration_AH_theta = -dv_lambda_H_x*l_H_x__AH_theta - dv_lambda_H_y*l_H_y__AH_theta;
    const Lanes dv_acceleration_AG_theta = -dv_lambda_G_x*l_G_x__AG_theta - dv_lambda_G_y*l_G_y__AG_theta;

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
    *worst = lanes_max_of(all_of(0.0), lanes_fabs(phi_G_x));
    *worst = lanes_max_of(*worst, lanes_fabs(phi_G_y));
    *worst = lanes_max_of(*worst, lanes_fabs(phi_H_x));
    *worst = lanes_max_of(*worst, lanes_fabs(phi_H_y));
    *worst = lanes_max_of(*worst, lanes_fabs(phi_E3_x));
    *worst = lanes_max_of(*worst, lanes_fabs(phi_E3_y));
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
    const Lanes OF_theta = q[0];
    const Lanes OF_omega = v[0];
    const Lanes BDE_theta = q[1];
    const Lanes BDE_omega = v[1];
    const Lanes AG_theta = q[2];
    const Lanes AG_omega = v[2];
    const Lanes AH_theta = q[3];
    const Lanes AH_omega = v[3];
    const Lanes FE_theta = q[4];
    const Lanes FE_omega = v[4];
    const Lanes HE_theta = q[5];
    const Lanes HE_omega = v[5];
    const Lanes EG_theta = q[6];
    const Lanes EG_omega = v[6];
    const Lanes a_OF_theta = a[0];
    const Lanes a_BDE_theta = a[1];
    const Lanes a_AG_theta = a[2];
    const Lanes a_AH_theta = a[3];
    const Lanes a_FE_theta = a[4];
    const Lanes a_HE_theta = a[5];
    const Lanes a_EG_theta = a[6];
    const Lanes held_lambda_G_x = aside->lambda[0];
    const Lanes held_lambda_G_y = aside->lambda[1];
    const Lanes held_lambda_H_x = aside->lambda[2];
    const Lanes held_lambda_H_y = aside->lambda[3];
    const Lanes held_lambda_E3_x = aside->lambda[4];
    const Lanes held_lambda_E3_y = aside->lambda[5];

    /* directions, arms, drives */
    const Lanes cos_theta_OF = lanes_cos(OF_theta);
    const Lanes sin_theta_OF = lanes_sin(OF_theta);
    const Lanes cos_theta_BDE = lanes_cos(BDE_theta);
    const Lanes sin_theta_BDE = lanes_sin(BDE_theta);
    const Lanes cos_theta_AG = lanes_cos(AG_theta);
    const Lanes sin_theta_AG = lanes_sin(AG_theta);
    const Lanes cos_theta_AH = lanes_cos(AH_theta);
    const Lanes sin_theta_AH = lanes_sin(AH_theta);
    const Lanes cos_theta_FE = lanes_cos(FE_theta);
    const Lanes sin_theta_FE = lanes_sin(FE_theta);
    const Lanes cos_theta_HE = lanes_cos(HE_theta);
    const Lanes sin_theta_HE = lanes_sin(HE_theta);
    const Lanes cos_theta_EG = lanes_cos(EG_theta);
    const Lanes sin_theta_EG = lanes_sin(EG_theta);
    const Lanes span_OF_F_x = p->OF_F_span_x*cos_theta_OF;
    const Lanes span_OF_F_y = p->OF_F_span_x*sin_theta_OF;
    const Lanes span_BDE_E_x = p->BDE_E_span_x*cos_theta_BDE - p->BDE_E_span_y*sin_theta_BDE;
    const Lanes span_BDE_E_y = p->BDE_E_span_x*sin_theta_BDE + p->BDE_E_span_y*cos_theta_BDE;
    const Lanes span_FE_E_x = p->FE_E_span_x*cos_theta_FE;
    const Lanes span_FE_E_y = p->FE_E_span_x*sin_theta_FE;
    const Lanes span_EG_G_x = -p->EG_G_span_y*sin_theta_EG;
    const Lanes span_EG_G_y = p->EG_G_span_y*cos_theta_EG;
    const Lanes span_AG_G_x = p->AG_G_span_x*cos_theta_AG - p->AG_G_span_y*sin_theta_AG;
    const Lanes span_AG_G_y = p->AG_G_span_x*sin_theta_AG + p->AG_G_span_y*cos_theta_AG;
    const Lanes span_HE_H_x = p->HE_H_span_x*cos_theta_HE;
    const Lanes span_HE_H_y = p->HE_H_span_x*sin_theta_HE;
    const Lanes span_AH_H_x = p->AH_H_span_x*cos_theta_AH - p->AH_H_span_y*sin_theta_AH;
    const Lanes span_AH_H_y = p->AH_H_span_x*sin_theta_AH + p->AH_H_span_y*cos_theta_AH;
    const Lanes span_BDE_D_x = p->BDE_D_span_x*cos_theta_BDE - p->BDE_D_span_y*sin_theta_BDE;
    const Lanes span_BDE_D_y = p->BDE_D_span_x*sin_theta_BDE + p->BDE_D_span_y*cos_theta_BDE;
    const Lanes BDE_D_x = p->B_x + span_BDE_D_x;
    const Lanes BDE_D_y = p->B_y + span_BDE_D_y;
    const Lanes spring_span_x = BDE_D_x - p->C_x;
    const Lanes spring_span_y = BDE_D_y - p->C_y;
    const Lanes spring_length = lanes_sqrt((spring_span_x * spring_span_x) + (spring_span_y * spring_span_y));
    const Lanes spring_force = p->spring_stiffness*(-p->spring_free_length + spring_length);
    const Lanes spring_pull = spring_force/spring_length;
    const Lanes cos_FE_less_OF = cos_theta_FE*cos_theta_OF + sin_theta_FE*sin_theta_OF;
    const Lanes sin_FE_less_OF = -cos_theta_FE*sin_theta_OF + cos_theta_OF*sin_theta_FE;
    const Lanes dot_OF_FE = cos_FE_less_OF*p->inertia_OF_FE;
    const Lanes cross_OF_FE = p->inertia_OF_FE*sin_FE_less_OF;
    const Lanes cos_EG_less_OF = cos_theta_EG*cos_theta_OF + sin_theta_EG*sin_theta_OF;
    const Lanes sin_EG_less_OF = -cos_theta_EG*sin_theta_OF + cos_theta_OF*sin_theta_EG;
    const Lanes dot_OF_EG = -sin_EG_less_OF*p->twist_OF_EG;
    const Lanes cross_OF_EG = cos_EG_less_OF*p->twist_OF_EG;
    const Lanes cos_EG_less_FE = cos_theta_EG*cos_theta_FE + sin_theta_EG*sin_theta_FE;
    const Lanes sin_EG_less_FE = -cos_theta_EG*sin_theta_FE + cos_theta_FE*sin_theta_EG;
    const Lanes dot_FE_EG = -sin_EG_less_FE*p->twist_FE_EG;
    const Lanes cross_FE_EG = cos_EG_less_FE*p->twist_FE_EG;
    const Lanes cos_HE_less_BDE = cos_theta_BDE*cos_theta_HE + sin_theta_BDE*sin_theta_HE;
    const Lanes sin_HE_less_BDE = cos_theta_BDE*sin_theta_HE - cos_theta_HE*sin_theta_BDE;
    const Lanes dot_BDE_HE = cos_HE_less_BDE*p->inertia_BDE_HE - sin_HE_less_BDE*p->twist_BDE_HE;
    const Lanes cross_BDE_HE = cos_HE_less_BDE*p->twist_BDE_HE + p->inertia_BDE_HE*sin_HE_less_BDE;

    /* coordinates */
    const Lanes inverse_sum = 1.0/(spring_length + 1e-150);
    const Lanes spring_length_by_BDE_theta = inverse_sum*span_BDE_D_x*spring_span_y
        - inverse_sum*span_BDE_D_y*spring_span_x;
    const Lanes spring_force_by_BDE_theta = spring_length_by_BDE_theta*p->spring_stiffness;
    const Lanes inverse_spring_length = 1.0/spring_length;
    const Lanes spring_pull_by_BDE_theta = -(inverse_spring_length
        * inverse_spring_length)*spring_force*spring_length_by_BDE_theta
        + inverse_spring_length*spring_force_by_BDE_theta;

    /* results */
    lin->value[0] = dot_OF_FE;
    lin->value[1] = dot_OF_EG;
    lin->value[2] = dot_FE_EG;
    lin->value[3] = dot_BDE_HE;
    lin->value[4] = -span_OF_F_y;
    lin->value[5] = span_AG_G_y;
    lin->value[6] = -span_FE_E_y;
    lin->value[7] = -span_EG_G_y;
    lin->value[8] = span_OF_F_x;
    lin->value[9] = -span_AG_G_x;
    lin->value[10] = span_FE_E_x;
    lin->value[11] = span_EG_G_x;
    lin->value[12] = -span_BDE_E_y;
    lin->value[13] = span_AH_H_y;
    lin->value[14] = -span_HE_H_y;
    lin->value[15] = span_BDE_E_x;
    lin->value[16] = -span_AH_H_x;
    lin->value[17] = span_HE_H_x;
    lin->value[18] = -(AG_omega * AG_omega)*span_AG_G_y + AG_omega*span_AG_G_x*p->two_alpha + a_AG_theta*span_AG_G_x;
    lin->value[19] = (EG_omega * EG_omega)*span_EG_G_y - EG_omega*span_EG_G_x*p->two_alpha - a_EG_theta*span_EG_G_x;
    lin->value[20] = (FE_omega * FE_omega)*span_FE_E_y - FE_omega*span_FE_E_x*p->two_alpha - a_FE_theta*span_FE_E_x;
    lin->value[21] = (OF_omega * OF_omega)*span_OF_F_y - OF_omega*span_OF_F_x*p->two_alpha - a_OF_theta*span_OF_F_x;
    lin->value[22] = (AG_omega * AG_omega)*span_AG_G_x + AG_omega*span_AG_G_y*p->two_alpha + a_AG_theta*span_AG_G_y;
    lin->value[23] = -(EG_omega * EG_omega)*span_EG_G_x - EG_omega*span_EG_G_y*p->two_alpha - a_EG_theta*span_EG_G_y;
    lin->value[24] = -(FE_omega * FE_omega)*span_FE_E_x - FE_omega*span_FE_E_y*p->two_alpha - a_FE_theta*span_FE_E_y;
    lin->value[25] = -(OF_omega * OF_omega)*span_OF_F_x - OF_omega*span_OF_F_y*p->two_alpha - a_OF_theta*span_OF_F_y;
    lin->value[26] = -(AH_omega * AH_omega)*span_AH_H_y + AH_omega*span_AH_H_x*p->two_alpha + a_AH_theta*span_AH_H_x;
    lin->value[27] = (BDE_omega * BDE_omega)*span_BDE_E_y - BDE_omega*span_BDE_E_x*p->two_alpha
        - a_BDE_theta*span_BDE_E_x;
    lin->value[28] = (HE_omega * HE_omega)*span_HE_H_y - HE_omega*span_HE_H_x*p->two_alpha - a_HE_theta*span_HE_H_x;
    lin->value[29] = (AH_omega * AH_omega)*span_AH_H_x + AH_omega*span_AH_H_y*p->two_alpha + a_AH_theta*span_AH_H_y;
    lin->value[30] = -(BDE_omega * BDE_omega)*span_BDE_E_x - BDE_omega*span_BDE_E_y*p->two_alpha
        - a_BDE_theta*span_BDE_E_y;
    lin->value[31] = -(HE_omega * HE_omega)*span_HE_H_x - HE_omega*span_HE_H_y*p->two_alpha - a_HE_theta*span_HE_H_y;
    lin->value[32] = (EG_omega * EG_omega)*dot_OF_EG + (FE_omega * FE_omega)*dot_OF_FE + a_EG_theta*cross_OF_EG
        + a_FE_theta*cross_OF_FE + span_OF_F_x*(-held_lambda_E3_x - held_lambda_G_x)
        - span_OF_F_y*(held_lambda_E3_y + held_lambda_G_y);
    lin->value[33] = -(EG_omega * EG_omega)*dot_OF_EG - a_EG_theta*cross_OF_EG;
    lin->value[34] = -(FE_omega * FE_omega)*dot_OF_FE - a_FE_theta*cross_OF_FE;
    lin->value[35] = (HE_omega * HE_omega)*dot_BDE_HE + a_HE_theta*cross_BDE_HE
        + (span_BDE_D_x * span_BDE_D_x)*spring_pull - span_BDE_D_x*spring_pull*spring_span_x
        + (span_BDE_D_y * span_BDE_D_y)*spring_pull - span_BDE_D_y*spring_pull*spring_span_y
        + span_BDE_E_x*(held_lambda_E3_x - held_lambda_H_x) - span_BDE_E_y*(-held_lambda_E3_y + held_lambda_H_y)
        + spring_pull_by_BDE_theta*(span_BDE_D_x*spring_span_y - span_BDE_D_y*spring_span_x);
    lin->value[36] = -(HE_omega * HE_omega)*dot_BDE_HE - a_HE_theta*cross_BDE_HE;
    lin->value[37] = held_lambda_G_x*span_AG_G_x + held_lambda_G_y*span_AG_G_y;
    lin->value[38] = held_lambda_H_x*span_AH_H_x + held_lambda_H_y*span_AH_H_y;
    lin->value[39] = (EG_omega * EG_omega)*dot_FE_EG + (OF_omega * OF_omega)*dot_OF_FE + a_EG_theta*cross_FE_EG
        - a_OF_theta*cross_OF_FE + span_FE_E_x*(-held_lambda_E3_x - held_lambda_G_x)
        - span_FE_E_y*(held_lambda_E3_y + held_lambda_G_y);
    lin->value[40] = -(EG_omega * EG_omega)*dot_FE_EG - a_EG_theta*cross_FE_EG;
    lin->value[41] = -(OF_omega * OF_omega)*dot_OF_FE + a_OF_theta*cross_OF_FE;
    lin->value[42] = -(BDE_omega * BDE_omega)*dot_BDE_HE + a_BDE_theta*cross_BDE_HE;
    lin->value[43] = (BDE_omega * BDE_omega)*dot_BDE_HE - a_BDE_theta*cross_BDE_HE - held_lambda_H_x*span_HE_H_x
        - held_lambda_H_y*span_HE_H_y;
    lin->value[44] = -(FE_omega * FE_omega)*dot_FE_EG + a_FE_theta*cross_FE_EG;
    lin->value[45] = (FE_omega * FE_omega)*dot_FE_EG + (OF_omega * OF_omega)*dot_OF_EG - a_FE_theta*cross_FE_EG
        - a_OF_theta*cross_OF_EG - held_lambda_G_x*span_EG_G_x - held_lambda_G_y*span_EG_G_y;
    lin->value[46] = -(OF_omega * OF_omega)*dot_OF_EG + a_OF_theta*cross_OF_EG;
    lin->value[47] = 2.0*AG_omega*span_AG_G_x;
    lin->value[48] = -2.0*EG_omega*span_EG_G_x;
    lin->value[49] = -2.0*FE_omega*span_FE_E_x;
    lin->value[50] = -2.0*OF_omega*span_OF_F_x;
    lin->value[51] = 2.0*AG_omega*span_AG_G_y;
    lin->value[52] = -2.0*EG_omega*span_EG_G_y;
    lin->value[53] = -2.0*FE_omega*span_FE_E_y;
    lin->value[54] = -2.0*OF_omega*span_OF_F_y;
    lin->value[55] = 2.0*AH_omega*span_AH_H_x;
    lin->value[56] = -2.0*BDE_omega*span_BDE_E_x;
    lin->value[57] = -2.0*HE_omega*span_HE_H_x;
    lin->value[58] = 2.0*AH_omega*span_AH_H_y;
    lin->value[59] = -2.0*BDE_omega*span_BDE_E_y;
    lin->value[60] = -2.0*HE_omega*span_HE_H_y;
    lin->value[61] = -2.0*EG_omega*cross_OF_EG;
    lin->value[62] = -2.0*FE_omega*cross_OF_FE;
    lin->value[63] = -2.0*HE_omega*cross_BDE_HE;
    lin->value[64] = -2.0*EG_omega*cross_FE_EG;
    lin->value[65] = 2.0*OF_omega*cross_OF_FE;
    lin->value[66] = 2.0*BDE_omega*cross_BDE_HE;
    lin->value[67] = 2.0*FE_omega*cross_FE_EG;
    lin->value[68] = 2.0*OF_omega*cross_OF_EG;
    lin->value[69] = p->motor_value;
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
    const Lanes mass_OF_theta_FE_theta = lin->value[0];
    const Lanes mass_OF_theta_EG_theta = lin->value[1];
    const Lanes mass_FE_theta_EG_theta = lin->value[2];
    const Lanes mass_BDE_theta_HE_theta = lin->value[3];
    const Lanes phi_G_x_OF_theta = lin->value[4];
    const Lanes phi_G_x_AG_theta = lin->value[5];
    const Lanes phi_G_x_FE_theta = lin->value[6];
    const Lanes phi_G_x_EG_theta = lin->value[7];
    const Lanes phi_G_y_OF_theta = lin->value[8];
    const Lanes phi_G_y_AG_theta = lin->value[9];
    const Lanes phi_G_y_FE_theta = lin->value[10];
    const Lanes phi_G_y_EG_theta = lin->value[11];
    const Lanes phi_H_x_BDE_theta = lin->value[12];
    const Lanes phi_H_x_AH_theta = lin->value[13];
    const Lanes phi_H_x_HE_theta = lin->value[14];
    const Lanes phi_H_y_BDE_theta = lin->value[15];
    const Lanes phi_H_y_AH_theta = lin->value[16];
    const Lanes phi_H_y_HE_theta = lin->value[17];
    const Lanes by_q_G_x_AG_theta = lin->value[18];
    const Lanes by_q_G_x_EG_theta = lin->value[19];
    const Lanes by_q_G_x_FE_theta = lin->value[20];
    const Lanes by_q_G_x_OF_theta = lin->value[21];
    const Lanes by_q_G_y_AG_theta = lin->value[22];
    const Lanes by_q_G_y_EG_theta = lin->value[23];
    const Lanes by_q_G_y_FE_theta = lin->value[24];
    const Lanes by_q_G_y_OF_theta = lin->value[25];
    const Lanes by_q_H_x_AH_theta = lin->value[26];
    const Lanes by_q_H_x_BDE_theta = lin->value[27];
    const Lanes by_q_H_x_HE_theta = lin->value[28];
    const Lanes by_q_H_y_AH_theta = lin->value[29];
    const Lanes by_q_H_y_BDE_theta = lin->value[30];
    const Lanes by_q_H_y_HE_theta = lin->value[31];
    const Lanes by_q_OF_theta_OF_theta = lin->value[32];
    const Lanes by_q_OF_theta_EG_theta = lin->value[33];
    const Lanes by_q_OF_theta_FE_theta = lin->value[34];
    const Lanes by_q_BDE_theta_BDE_theta = lin->value[35];
    const Lanes by_q_BDE_theta_HE_theta = lin->value[36];
    const Lanes by_q_AG_theta_AG_theta = lin->value[37];
    const Lanes by_q_AH_theta_AH_theta = lin->value[38];
    const Lanes by_q_FE_theta_FE_theta = lin->value[39];
    const Lanes by_q_FE_theta_EG_theta = lin->value[40];
    const Lanes by_q_FE_theta_OF_theta = lin->value[41];
    const Lanes by_q_HE_theta_BDE_theta = lin->value[42];
    const Lanes by_q_HE_theta_HE_theta = lin->value[43];
    const Lanes by_q_EG_theta_FE_theta = lin->value[44];
    const Lanes by_q_EG_theta_EG_theta = lin->value[45];
    const Lanes by_q_EG_theta_OF_theta = lin->value[46];
    const Lanes by_v_G_x_AG_theta = lin->value[47];
    const Lanes by_v_G_x_EG_theta = lin->value[48];
    const Lanes by_v_G_x_FE_theta = lin->value[49];
    const Lanes by_v_G_x_OF_theta = lin->value[50];
    const Lanes by_v_G_y_AG_theta = lin->value[51];
    const Lanes by_v_G_y_EG_theta = lin->value[52];
    const Lanes by_v_G_y_FE_theta = lin->value[53];
    const Lanes by_v_G_y_OF_theta = lin->value[54];
    const Lanes by_v_H_x_AH_theta = lin->value[55];
    const Lanes by_v_H_x_BDE_theta = lin->value[56];
    const Lanes by_v_H_x_HE_theta = lin->value[57];
    const Lanes by_v_H_y_AH_theta = lin->value[58];
    const Lanes by_v_H_y_BDE_theta = lin->value[59];
    const Lanes by_v_H_y_HE_theta = lin->value[60];
    const Lanes by_v_OF_theta_EG_theta = lin->value[61];
    const Lanes by_v_OF_theta_FE_theta = lin->value[62];
    const Lanes by_v_BDE_theta_HE_theta = lin->value[63];
    const Lanes by_v_FE_theta_EG_theta = lin->value[64];
    const Lanes by_v_FE_theta_OF_theta = lin->value[65];
    const Lanes by_v_HE_theta_BDE_theta = lin->value[66];
    const Lanes by_v_EG_theta_FE_theta = lin->value[67];
    const Lanes by_v_EG_theta_OF_theta = lin->value[68];

    /* eta/kappa */
    const Lanes eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* matrix */
    const Lanes n_OF_theta__OF_theta = by_q_OF_theta_OF_theta*(eta * eta) + p->mass_OF_OF;
    const Lanes n_OF_theta__FE_theta = eta*(by_q_OF_theta_FE_theta*eta + by_v_OF_theta_FE_theta)
        + mass_OF_theta_FE_theta;
    const Lanes n_OF_theta__EG_theta = eta*(by_q_OF_theta_EG_theta*eta + by_v_OF_theta_EG_theta)
        + mass_OF_theta_EG_theta;
    const Lanes n_BDE_theta__BDE_theta = by_q_BDE_theta_BDE_theta*(eta * eta) + p->mass_BDE_BDE;
    const Lanes n_BDE_theta__HE_theta = eta*(by_q_BDE_theta_HE_theta*eta + by_v_BDE_theta_HE_theta)
        + mass_BDE_theta_HE_theta;
    const Lanes n_AG_theta__AG_theta = by_q_AG_theta_AG_theta*(eta * eta) + p->mass_AG_AG;
    const Lanes n_AH_theta__AH_theta = by_q_AH_theta_AH_theta*(eta * eta) + p->mass_AH_AH;
    const Lanes n_FE_theta__OF_theta = eta*(by_q_FE_theta_OF_theta*eta + by_v_FE_theta_OF_theta)
        + mass_OF_theta_FE_theta;
    const Lanes n_FE_theta__FE_theta = by_q_FE_theta_FE_theta*(eta * eta) + p->mass_FE_FE;
    const Lanes n_FE_theta__EG_theta = eta*(by_q_FE_theta_EG_theta*eta + by_v_FE_theta_EG_theta)
        + mass_FE_theta_EG_theta;
    const Lanes n_HE_theta__BDE_theta = eta*(by_q_HE_theta_BDE_theta*eta + by_v_HE_theta_BDE_theta)
        + mass_BDE_theta_HE_theta;
    const Lanes n_HE_theta__HE_theta = by_q_HE_theta_HE_theta*(eta * eta) + p->mass_HE_HE;
    const Lanes n_EG_theta__OF_theta = eta*(by_q_EG_theta_OF_theta*eta + by_v_EG_theta_OF_theta)
        + mass_OF_theta_EG_theta;
    const Lanes n_EG_theta__FE_theta = eta*(by_q_EG_theta_FE_theta*eta + by_v_EG_theta_FE_theta)
        + mass_FE_theta_EG_theta;
    const Lanes n_EG_theta__EG_theta = by_q_EG_theta_EG_theta*(eta * eta) + p->mass_EG_EG;
    const Lanes n_G_x__OF_theta = eta_row*(by_q_G_x_OF_theta*eta + by_v_G_x_OF_theta) + phi_G_x_OF_theta;
    const Lanes n_G_x__AG_theta = eta_row*(by_q_G_x_AG_theta*eta + by_v_G_x_AG_theta) + phi_G_x_AG_theta;
    const Lanes n_G_x__FE_theta = eta_row*(by_q_G_x_FE_theta*eta + by_v_G_x_FE_theta) + phi_G_x_FE_theta;
    const Lanes n_G_x__EG_theta = eta_row*(by_q_G_x_EG_theta*eta + by_v_G_x_EG_theta) + phi_G_x_EG_theta;
    const Lanes n_G_y__OF_theta = eta_row*(by_q_G_y_OF_theta*eta + by_v_G_y_OF_theta) + phi_G_y_OF_theta;
    const Lanes n_G_y__AG_theta = eta_row*(by_q_G_y_AG_theta*eta + by_v_G_y_AG_theta) + phi_G_y_AG_theta;
    const Lanes n_G_y__FE_theta = eta_row*(by_q_G_y_FE_theta*eta + by_v_G_y_FE_theta) + phi_G_y_FE_theta;
    const Lanes n_G_y__EG_theta = eta_row*(by_q_G_y_EG_theta*eta + by_v_G_y_EG_theta) + phi_G_y_EG_theta;
    const Lanes n_H_x__BDE_theta = eta_row*(by_q_H_x_BDE_theta*eta + by_v_H_x_BDE_theta) + phi_H_x_BDE_theta;
    const Lanes n_H_x__AH_theta = eta_row*(by_q_H_x_AH_theta*eta + by_v_H_x_AH_theta) + phi_H_x_AH_theta;
    const Lanes n_H_x__HE_theta = eta_row*(by_q_H_x_HE_theta*eta + by_v_H_x_HE_theta) + phi_H_x_HE_theta;
    const Lanes n_H_y__BDE_theta = eta_row*(by_q_H_y_BDE_theta*eta + by_v_H_y_BDE_theta) + phi_H_y_BDE_theta;
    const Lanes n_H_y__AH_theta = eta_row*(by_q_H_y_AH_theta*eta + by_v_H_y_AH_theta) + phi_H_y_AH_theta;
    const Lanes n_H_y__HE_theta = eta_row*(by_q_H_y_HE_theta*eta + by_v_H_y_HE_theta) + phi_H_y_HE_theta;
    const Lanes n_E3_x__OF_theta = eta_row*(by_q_G_x_OF_theta*eta + by_v_G_x_OF_theta) + phi_G_x_OF_theta;
    const Lanes n_E3_x__BDE_theta = eta_row*(-by_q_H_x_BDE_theta*eta - by_v_H_x_BDE_theta) - phi_H_x_BDE_theta;
    const Lanes n_E3_x__FE_theta = eta_row*(by_q_G_x_FE_theta*eta + by_v_G_x_FE_theta) + phi_G_x_FE_theta;
    const Lanes n_E3_y__OF_theta = eta_row*(by_q_G_y_OF_theta*eta + by_v_G_y_OF_theta) + phi_G_y_OF_theta;
    const Lanes n_E3_y__BDE_theta = eta_row*(-by_q_H_y_BDE_theta*eta - by_v_H_y_BDE_theta) - phi_H_y_BDE_theta;
    const Lanes n_E3_y__FE_theta = eta_row*(by_q_G_y_FE_theta*eta + by_v_G_y_FE_theta) + phi_G_y_FE_theta;

    /* L U */
    const Lanes scale_AG_theta = n_AG_theta__AG_theta;
    *rare |= ~(lanes_fabs(scale_AG_theta) > SINGULAR * lanes_fabs(n_AG_theta__AG_theta));
    const Lanes inverse_pivot_AG_theta = 1.0/scale_AG_theta;
    lin->lu[0] = inverse_pivot_AG_theta;
    const Lanes l_G_x__AG_theta = inverse_pivot_AG_theta*n_G_x__AG_theta;
    lin->lu[1] = l_G_x__AG_theta;
    const Lanes l_G_y__AG_theta = inverse_pivot_AG_theta*n_G_y__AG_theta;
    lin->lu[2] = l_G_y__AG_theta;
    const Lanes scale_AH_theta = n_AH_theta__AH_theta;
    *rare |= ~(lanes_fabs(scale_AH_theta) > SINGULAR * lanes_fabs(n_AH_theta__AH_theta));
    const Lanes inverse_pivot_AH_theta = 1.0/scale_AH_theta;
    lin->lu[3] = inverse_pivot_AH_theta;
    const Lanes l_H_x__AH_theta = inverse_pivot_AH_theta*n_H_x__AH_theta;
    lin->lu[4] = l_H_x__AH_theta;
    const Lanes l_H_y__AH_theta = inverse_pivot_AH_theta*n_H_y__AH_theta;
    lin->lu[5] = l_H_y__AH_theta;
    const Lanes scale_HE_theta = n_HE_theta__HE_theta;
    *rare |= ~(lanes_fabs(scale_HE_theta) > SINGULAR * lanes_fabs(n_HE_theta__HE_theta));
    const Lanes inverse_pivot_HE_theta = 1.0/scale_HE_theta;
    lin->lu[6] = inverse_pivot_HE_theta;
    const Lanes l_BDE_theta__HE_theta = inverse_pivot_HE_theta*n_BDE_theta__HE_theta;
    lin->lu[7] = l_BDE_theta__HE_theta;
    lin->lu[8] = n_HE_theta__BDE_theta;
    const Lanes l_H_x__HE_theta = inverse_pivot_HE_theta*n_H_x__HE_theta;
    lin->lu[9] = l_H_x__HE_theta;
    const Lanes l_H_y__HE_theta = inverse_pivot_HE_theta*n_H_y__HE_theta;
    lin->lu[10] = l_H_y__HE_theta;
    const Lanes scale_BDE_theta = -l_BDE_theta__HE_theta*n_HE_theta__BDE_theta + n_BDE_theta__BDE_theta;
    *rare |= ~(lanes_fabs(scale_BDE_theta) > SINGULAR * lanes_fabs(n_BDE_theta__BDE_theta));
    const Lanes inverse_pivot_BDE_theta = 1.0/scale_BDE_theta;
    lin->lu[11] = inverse_pivot_BDE_theta;
    const Lanes l_H_x__BDE_theta = inverse_pivot_BDE_theta*(-l_H_x__HE_theta*n_HE_theta__BDE_theta + n_H_x__BDE_theta);
    lin->lu[12] = l_H_x__BDE_theta;
    const Lanes u_BDE_theta__H_x = -l_BDE_theta__HE_theta*phi_H_x_HE_theta + phi_H_x_BDE_theta;
    lin->lu[13] = u_BDE_theta__H_x;
    const Lanes l_H_y__BDE_theta = inverse_pivot_BDE_theta*(-l_H_y__HE_theta*n_HE_theta__BDE_theta + n_H_y__BDE_theta);
    lin->lu[14] = l_H_y__BDE_theta;
    const Lanes u_BDE_theta__H_y = -l_BDE_theta__HE_theta*phi_H_y_HE_theta + phi_H_y_BDE_theta;
    lin->lu[15] = u_BDE_theta__H_y;
    const Lanes l_E3_x__BDE_theta = inverse_pivot_BDE_theta*n_E3_x__BDE_theta;
    lin->lu[16] = l_E3_x__BDE_theta;
    const Lanes l_E3_y__BDE_theta = inverse_pivot_BDE_theta*n_E3_y__BDE_theta;
    lin->lu[17] = l_E3_y__BDE_theta;
    const Lanes scale_H_x = -l_H_x__AH_theta*phi_H_x_AH_theta - l_H_x__BDE_theta*u_BDE_theta__H_x
        - l_H_x__HE_theta*phi_H_x_HE_theta;
    *rare |= ~((lanes_fabs(scale_H_x) > 0.0) & (lanes_fabs(scale_H_x) < INFINITY));
    const Lanes inverse_pivot_H_x = 1.0/scale_H_x;
    lin->lu[18] = inverse_pivot_H_x;
    const Lanes l_H_y__H_x = inverse_pivot_H_x*(-l_H_y__AH_theta*phi_H_x_AH_theta - l_H_y__BDE_theta*u_BDE_theta__H_x
        - l_H_y__HE_theta*phi_H_x_HE_theta);
    lin->lu[19] = l_H_y__H_x;
    const Lanes u_H_x__H_y = -l_H_x__AH_theta*phi_H_y_AH_theta - l_H_x__BDE_theta*u_BDE_theta__H_y
        - l_H_x__HE_theta*phi_H_y_HE_theta;
    lin->lu[20] = u_H_x__H_y;
    const Lanes l_E3_x__H_x = -inverse_pivot_H_x*l_E3_x__BDE_theta*u_BDE_theta__H_x;
    lin->lu[21] = l_E3_x__H_x;
    const Lanes u_H_x__E3_x = l_H_x__BDE_theta*phi_H_x_BDE_theta;
    lin->lu[22] = u_H_x__E3_x;
    const Lanes l_E3_y__H_x = -inverse_pivot_H_x*l_E3_y__BDE_theta*u_BDE_theta__H_x;
    lin->lu[23] = l_E3_y__H_x;
    const Lanes u_H_x__E3_y = l_H_x__BDE_theta*phi_H_y_BDE_theta;
    lin->lu[24] = u_H_x__E3_y;
    const Lanes scale_H_y = -l_H_y__AH_theta*phi_H_y_AH_theta - l_H_y__BDE_theta*u_BDE_theta__H_y
        - l_H_y__HE_theta*phi_H_y_HE_theta;
    const Lanes pivot_H_y = -l_H_y__H_x*u_H_x__H_y + scale_H_y;
    *rare |= ~(lanes_fabs(pivot_H_y) > SINGULAR * lanes_fabs(scale_H_y));
    const Lanes inverse_pivot_H_y = 1.0/pivot_H_y;
    lin->lu[25] = inverse_pivot_H_y;
    const Lanes l_E3_x__H_y = inverse_pivot_H_y*(-l_E3_x__BDE_theta*u_BDE_theta__H_y - l_E3_x__H_x*u_H_x__H_y);
    lin->lu[26] = l_E3_x__H_y;
    const Lanes u_H_y__E3_x = l_H_y__BDE_theta*phi_H_x_BDE_theta - l_H_y__H_x*u_H_x__E3_x;
    lin->lu[27] = u_H_y__E3_x;
    const Lanes l_E3_y__H_y = inverse_pivot_H_y*(-l_E3_y__BDE_theta*u_BDE_theta__H_y - l_E3_y__H_x*u_H_x__H_y);
    lin->lu[28] = l_E3_y__H_y;
    const Lanes u_H_y__E3_y = l_H_y__BDE_theta*phi_H_y_BDE_theta - l_H_y__H_x*u_H_x__E3_y;
    lin->lu[29] = u_H_y__E3_y;
    const Lanes scale_EG_theta = n_EG_theta__EG_theta;
    *rare |= ~(lanes_fabs(scale_EG_theta) > SINGULAR * lanes_fabs(n_EG_theta__EG_theta));
    const Lanes inverse_pivot_EG_theta = 1.0/scale_EG_theta;
    lin->lu[30] = inverse_pivot_EG_theta;
    const Lanes l_OF_theta__EG_theta = inverse_pivot_EG_theta*n_OF_theta__EG_theta;
    lin->lu[31] = l_OF_theta__EG_theta;
    lin->lu[32] = n_EG_theta__OF_theta;
    const Lanes l_FE_theta__EG_theta = inverse_pivot_EG_theta*n_FE_theta__EG_theta;
    lin->lu[33] = l_FE_theta__EG_theta;
    lin->lu[34] = n_EG_theta__FE_theta;
    const Lanes l_G_x__EG_theta = inverse_pivot_EG_theta*n_G_x__EG_theta;
    lin->lu[35] = l_G_x__EG_theta;
    const Lanes l_G_y__EG_theta = inverse_pivot_EG_theta*n_G_y__EG_theta;
    lin->lu[36] = l_G_y__EG_theta;
    const Lanes scale_OF_theta = -l_OF_theta__EG_theta*n_EG_theta__OF_theta + n_OF_theta__OF_theta;
    *rare |= ~(lanes_fabs(scale_OF_theta) > SINGULAR * lanes_fabs(n_OF_theta__OF_theta));
    const Lanes inverse_pivot_OF_theta = 1.0/scale_OF_theta;
    lin->lu[37] = inverse_pivot_OF_theta;
    const Lanes l_FE_theta__OF_theta = inverse_pivot_OF_theta*(-l_FE_theta__EG_theta*n_EG_theta__OF_theta
        + n_FE_theta__OF_theta);
    lin->lu[38] = l_FE_theta__OF_theta;
    const Lanes u_OF_theta__FE_theta = -l_OF_theta__EG_theta*n_EG_theta__FE_theta + n_OF_theta__FE_theta;
    lin->lu[39] = u_OF_theta__FE_theta;
    const Lanes l_G_x__OF_theta = inverse_pivot_OF_theta*(-l_G_x__EG_theta*n_EG_theta__OF_theta + n_G_x__OF_theta);
    lin->lu[40] = l_G_x__OF_theta;
    const Lanes u_OF_theta__G_x = -l_OF_theta__EG_theta*phi_G_x_EG_theta + phi_G_x_OF_theta;
    lin->lu[41] = u_OF_theta__G_x;
    const Lanes l_G_y__OF_theta = inverse_pivot_OF_theta*(-l_G_y__EG_theta*n_EG_theta__OF_theta + n_G_y__OF_theta);
    lin->lu[42] = l_G_y__OF_theta;
    const Lanes u_OF_theta__G_y = -l_OF_theta__EG_theta*phi_G_y_EG_theta + phi_G_y_OF_theta;
    lin->lu[43] = u_OF_theta__G_y;
    const Lanes l_E3_x__OF_theta = inverse_pivot_OF_theta*n_E3_x__OF_theta;
    lin->lu[44] = l_E3_x__OF_theta;
    const Lanes l_E3_y__OF_theta = inverse_pivot_OF_theta*n_E3_y__OF_theta;
    lin->lu[45] = l_E3_y__OF_theta;
    const Lanes scale_FE_theta = -l_FE_theta__EG_theta*n_EG_theta__FE_theta - l_FE_theta__OF_theta*u_OF_theta__FE_theta
        + n_FE_theta__FE_theta;
    *rare |= ~(lanes_fabs(scale_FE_theta) > SINGULAR * lanes_fabs(n_FE_theta__FE_theta));
    const Lanes inverse_pivot_FE_theta = 1.0/scale_FE_theta;
    lin->lu[46] = inverse_pivot_FE_theta;
    const Lanes l_G_x__FE_theta = inverse_pivot_FE_theta*(-l_G_x__EG_theta*n_EG_theta__FE_theta
        - l_G_x__OF_theta*u_OF_theta__FE_theta + n_G_x__FE_theta);
    lin->lu[47] = l_G_x__FE_theta;
    const Lanes u_FE_theta__G_x = -l_FE_theta__EG_theta*phi_G_x_EG_theta - l_FE_theta__OF_theta*u_OF_theta__G_x
        + phi_G_x_FE_theta;
    lin->lu[48] = u_FE_theta__G_x;
    const Lanes l_G_y__FE_theta = inverse_pivot_FE_theta*(-l_G_y__EG_theta*n_EG_theta__FE_theta
        - l_G_y__OF_theta*u_OF_theta__FE_theta + n_G_y__FE_theta);
    lin->lu[49] = l_G_y__FE_theta;
    const Lanes u_FE_theta__G_y = -l_FE_theta__EG_theta*phi_G_y_EG_theta - l_FE_theta__OF_theta*u_OF_theta__G_y
        + phi_G_y_FE_theta;
    lin->lu[50] = u_FE_theta__G_y;
    const Lanes l_E3_x__FE_theta = inverse_pivot_FE_theta*(-l_E3_x__OF_theta*u_OF_theta__FE_theta + n_E3_x__FE_theta);
    lin->lu[51] = l_E3_x__FE_theta;
    const Lanes u_FE_theta__E3_x = -l_FE_theta__OF_theta*phi_G_x_OF_theta + phi_G_x_FE_theta;
    lin->lu[52] = u_FE_theta__E3_x;
    const Lanes l_E3_y__FE_theta = inverse_pivot_FE_theta*(-l_E3_y__OF_theta*u_OF_theta__FE_theta + n_E3_y__FE_theta);
    lin->lu[53] = l_E3_y__FE_theta;
    const Lanes u_FE_theta__E3_y = -l_FE_theta__OF_theta*phi_G_y_OF_theta + phi_G_y_FE_theta;
    lin->lu[54] = u_FE_theta__E3_y;
    const Lanes scale_G_x = -l_G_x__AG_theta*phi_G_x_AG_theta - l_G_x__EG_theta*phi_G_x_EG_theta
        - l_G_x__FE_theta*u_FE_theta__G_x - l_G_x__OF_theta*u_OF_theta__G_x;
    *rare |= ~((lanes_fabs(scale_G_x) > 0.0) & (lanes_fabs(scale_G_x) < INFINITY));
    const Lanes inverse_pivot_G_x = 1.0/scale_G_x;
    lin->lu[55] = inverse_pivot_G_x;
    const Lanes l_G_y__G_x = inverse_pivot_G_x*(-l_G_y__AG_theta*phi_G_x_AG_theta - l_G_y__EG_theta*phi_G_x_EG_theta
        - l_G_y__FE_theta*u_FE_theta__G_x - l_G_y__OF_theta*u_OF_theta__G_x);
    lin->lu[56] = l_G_y__G_x;
    const Lanes u_G_x__G_y = -l_G_x__AG_theta*phi_G_y_AG_theta - l_G_x__EG_theta*phi_G_y_EG_theta
        - l_G_x__FE_theta*u_FE_theta__G_y - l_G_x__OF_theta*u_OF_theta__G_y;
    lin->lu[57] = u_G_x__G_y;
    const Lanes l_E3_x__G_x = inverse_pivot_G_x*(-l_E3_x__FE_theta*u_FE_theta__G_x - l_E3_x__OF_theta*u_OF_theta__G_x);
    lin->lu[58] = l_E3_x__G_x;
    const Lanes u_G_x__E3_x = -l_G_x__FE_theta*u_FE_theta__E3_x - l_G_x__OF_theta*phi_G_x_OF_theta;
    lin->lu[59] = u_G_x__E3_x;
    const Lanes l_E3_y__G_x = inverse_pivot_G_x*(-l_E3_y__FE_theta*u_FE_theta__G_x - l_E3_y__OF_theta*u_OF_theta__G_x);
    lin->lu[60] = l_E3_y__G_x;
    const Lanes u_G_x__E3_y = -l_G_x__FE_theta*u_FE_theta__E3_y - l_G_x__OF_theta*phi_G_y_OF_theta;
    lin->lu[61] = u_G_x__E3_y;
    const Lanes scale_G_y = -l_G_y__AG_theta*phi_G_y_AG_theta - l_G_y__EG_theta*phi_G_y_EG_theta
        - l_G_y__FE_theta*u_FE_theta__G_y - l_G_y__OF_theta*u_OF_theta__G_y;
    const Lanes pivot_G_y = -l_G_y__G_x*u_G_x__G_y + scale_G_y;
    *rare |= ~(lanes_fabs(pivot_G_y) > SINGULAR * lanes_fabs(scale_G_y));
    const Lanes inverse_pivot_G_y = 1.0/pivot_G_y;
    lin->lu[62] = inverse_pivot_G_y;
    const Lanes l_E3_x__G_y = inverse_pivot_G_y*(-l_E3_x__FE_theta*u_FE_theta__G_y - l_E3_x__G_x*u_G_x__G_y
        - l_E3_x__OF_theta*u_OF_theta__G_y);
    lin->lu[63] = l_E3_x__G_y;
    const Lanes u_G_y__E3_x = -l_G_y__FE_theta*u_FE_theta__E3_x - l_G_y__G_x*u_G_x__E3_x
        - l_G_y__OF_theta*phi_G_x_OF_theta;
    lin->lu[64] = u_G_y__E3_x;
    const Lanes l_E3_y__G_y = inverse_pivot_G_y*(-l_E3_y__FE_theta*u_FE_theta__G_y - l_E3_y__G_x*u_G_x__G_y
        - l_E3_y__OF_theta*u_OF_theta__G_y);
    lin->lu[65] = l_E3_y__G_y;
    const Lanes u_G_y__E3_y = -l_G_y__FE_theta*u_FE_theta__E3_y - l_G_y__G_x*u_G_x__E3_y
        - l_G_y__OF_theta*phi_G_y_OF_theta;
    lin->lu[66] = u_G_y__E3_y;
    const Lanes scale_E3_x = l_E3_x__BDE_theta*phi_H_x_BDE_theta - l_E3_x__FE_theta*u_FE_theta__E3_x
        - l_E3_x__OF_theta*phi_G_x_OF_theta;
    const Lanes pivot_E3_x = -l_E3_x__G_x*u_G_x__E3_x - l_E3_x__G_y*u_G_y__E3_x - l_E3_x__H_x*u_H_x__E3_x
        - l_E3_x__H_y*u_H_y__E3_x + scale_E3_x;
    *rare |= ~(lanes_fabs(pivot_E3_x) > SINGULAR * lanes_fabs(scale_E3_x));
    const Lanes inverse_pivot_E3_x = 1.0/pivot_E3_x;
    lin->lu[67] = inverse_pivot_E3_x;
    const Lanes l_E3_y__E3_x = inverse_pivot_E3_x*(l_E3_y__BDE_theta*phi_H_x_BDE_theta
        - l_E3_y__FE_theta*u_FE_theta__E3_x - l_E3_y__G_x*u_G_x__E3_x - l_E3_y__G_y*u_G_y__E3_x
        - l_E3_y__H_x*u_H_x__E3_x - l_E3_y__H_y*u_H_y__E3_x - l_E3_y__OF_theta*phi_G_x_OF_theta);
    lin->lu[68] = l_E3_y__E3_x;
    const Lanes u_E3_x__E3_y = l_E3_x__BDE_theta*phi_H_y_BDE_theta - l_E3_x__FE_theta*u_FE_theta__E3_y
        - l_E3_x__G_x*u_G_x__E3_y - l_E3_x__G_y*u_G_y__E3_y - l_E3_x__H_x*u_H_x__E3_y - l_E3_x__H_y*u_H_y__E3_y
        - l_E3_x__OF_theta*phi_G_y_OF_theta;
    lin->lu[69] = u_E3_x__E3_y;
    const Lanes scale_E3_y = l_E3_y__BDE_theta*phi_H_y_BDE_theta - l_E3_y__FE_theta*u_FE_theta__E3_y
        - l_E3_y__OF_theta*phi_G_y_OF_theta;
    const Lanes pivot_E3_y = -l_E3_y__E3_x*u_E3_x__E3_y - l_E3_y__G_x*u_G_x__E3_y - l_E3_y__G_y*u_G_y__E3_y
        - l_E3_y__H_x*u_H_x__E3_y - l_E3_y__H_y*u_H_y__E3_y + scale_E3_y;
    *rare |= ~(lanes_fabs(pivot_E3_y) > SINGULAR * lanes_fabs(scale_E3_y));
    const Lanes inverse_pivot_E3_y = 1.0/pivot_E3_y;
    lin->lu[70] = inverse_pivot_E3_y;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 */
static void newton_substitute(const LaneLinear *lin, Lanes *x)
{
    /* linearization */
    const Lanes phi_G_x_OF_theta = lin->value[4];
    const Lanes phi_G_x_AG_theta = lin->value[5];
    const Lanes phi_G_x_EG_theta = lin->value[7];
    const Lanes phi_G_y_OF_theta = lin->value[8];
    const Lanes phi_G_y_AG_theta = lin->value[9];
    const Lanes phi_G_y_EG_theta = lin->value[11];
    const Lanes phi_H_x_BDE_theta = lin->value[12];
    const Lanes phi_H_x_AH_theta = lin->value[13];
    const Lanes phi_H_x_HE_theta = lin->value[14];
    const Lanes phi_H_y_BDE_theta = lin->value[15];
    const Lanes phi_H_y_AH_theta = lin->value[16];
    const Lanes phi_H_y_HE_theta = lin->value[17];
    const Lanes inverse_pivot_AG_theta = lin->lu[0];
    const Lanes l_G_x__AG_theta = lin->lu[1];
    const Lanes l_G_y__AG_theta = lin->lu[2];
    const Lanes inverse_pivot_AH_theta = lin->lu[3];
    const Lanes l_H_x__AH_theta = lin->lu[4];
    const Lanes l_H_y__AH_theta = lin->lu[5];
    const Lanes inverse_pivot_HE_theta = lin->lu[6];
    const Lanes l_BDE_theta__HE_theta = lin->lu[7];
    const Lanes n_HE_theta__BDE_theta = lin->lu[8];
    const Lanes l_H_x__HE_theta = lin->lu[9];
    const Lanes l_H_y__HE_theta = lin->lu[10];
    const Lanes inverse_pivot_BDE_theta = lin->lu[11];
    const Lanes l_H_x__BDE_theta = lin->lu[12];
    const Lanes u_BDE_theta__H_x = lin->lu[13];
    const Lanes l_H_y__BDE_theta = lin->lu[14];
    const Lanes u_BDE_theta__H_y = lin->lu[15];
    const Lanes l_E3_x__BDE_theta = lin->lu[16];
    const Lanes l_E3_y__BDE_theta = lin->lu[17];
    const Lanes inverse_pivot_H_x = lin->lu[18];
    const Lanes l_H_y__H_x = lin->lu[19];
    const Lanes u_H_x__H_y = lin->lu[20];
    const Lanes l_E3_x__H_x = lin->lu[21];
    const Lanes u_H_x__E3_x = lin->lu[22];
    const Lanes l_E3_y__H_x = lin->lu[23];
    const Lanes u_H_x__E3_y = lin->lu[24];
    const Lanes inverse_pivot_H_y = lin->lu[25];
    const Lanes l_E3_x__H_y = lin->lu[26];
    const Lanes u_H_y__E3_x = lin->lu[27];
    const Lanes l_E3_y__H_y = lin->lu[28];
    const Lanes u_H_y__E3_y = lin->lu[29];
    const Lanes inverse_pivot_EG_theta = lin->lu[30];
    const Lanes l_OF_theta__EG_theta = lin->lu[31];
    const Lanes n_EG_theta__OF_theta = lin->lu[32];
    const Lanes l_FE_theta__EG_theta = lin->lu[33];
    const Lanes n_EG_theta__FE_theta = lin->lu[34];
    const Lanes l_G_x__EG_theta = lin->lu[35];
    const Lanes l_G_y__EG_theta = lin->lu[36];
    const Lanes inverse_pivot_OF_theta = lin->lu[37];
    const Lanes l_FE_theta__OF_theta = lin->lu[38];
    const Lanes u_OF_theta__FE_theta = lin->lu[39];
    const Lanes l_G_x__OF_theta = lin->lu[40];
    const Lanes u_OF_theta__G_x = lin->lu[41];
    const Lanes l_G_y__OF_theta = lin->lu[42];
    const Lanes u_OF_theta__G_y = lin->lu[43];
    const Lanes l_E3_x__OF_theta = lin->lu[44];
    const Lanes l_E3_y__OF_theta = lin->lu[45];
    const Lanes inverse_pivot_FE_theta = lin->lu[46];
    const Lanes l_G_x__FE_theta = lin->lu[47];
    const Lanes u_FE_theta__G_x = lin->lu[48];
    const Lanes l_G_y__FE_theta = lin->lu[49];
    const Lanes u_FE_theta__G_y = lin->lu[50];
    const Lanes l_E3_x__FE_theta = lin->lu[51];
    const Lanes u_FE_theta__E3_x = lin->lu[52];
    const Lanes l_E3_y__FE_theta = lin->lu[53];
    const Lanes u_FE_theta__E3_y = lin->lu[54];
    const Lanes inverse_pivot_G_x = lin->lu[55];
    const Lanes l_G_y__G_x = lin->lu[56];
    const Lanes u_G_x__G_y = lin->lu[57];
    const Lanes l_E3_x__G_x = lin->lu[58];
    const Lanes u_G_x__E3_x = lin->lu[59];
    const Lanes l_E3_y__G_x = lin->lu[60];
    const Lanes u_G_x__E3_y = lin->lu[61];
    const Lanes inverse_pivot_G_y = lin->lu[62];
    const Lanes l_E3_x__G_y = lin->lu[63];
    const Lanes u_G_y__E3_x = lin->lu[64];
    const Lanes l_E3_y__G_y = lin->lu[65];
    const Lanes u_G_y__E3_y = lin->lu[66];
    const Lanes inverse_pivot_E3_x = lin->lu[67];
    const Lanes l_E3_y__E3_x = lin->lu[68];
    const Lanes u_E3_x__E3_y = lin->lu[69];
    const Lanes inverse_pivot_E3_y = lin->lu[70];

    /* forward */
    const Lanes b_AG_theta = x[2];
    const Lanes b_AH_theta = x[3];
    const Lanes b_HE_theta = x[5];
    const Lanes b_BDE_theta = -b_HE_theta*l_BDE_theta__HE_theta + x[1];
    const Lanes b_H_x = -b_AH_theta*l_H_x__AH_theta - b_BDE_theta*l_H_x__BDE_theta - b_HE_theta*l_H_x__HE_theta + x[9];
    const Lanes b_H_y = -b_AH_theta*l_H_y__AH_theta - b_BDE_theta*l_H_y__BDE_theta - b_HE_theta*l_H_y__HE_theta
        - b_H_x*l_H_y__H_x + x[10];
    const Lanes b_EG_theta = x[6];
    const Lanes b_OF_theta = -b_EG_theta*l_OF_theta__EG_theta + x[0];
    const Lanes b_FE_theta = -b_EG_theta*l_FE_theta__EG_theta - b_OF_theta*l_FE_theta__OF_theta + x[4];
    const Lanes b_G_x = -b_AG_theta*l_G_x__AG_theta - b_EG_theta*l_G_x__EG_theta - b_FE_theta*l_G_x__FE_theta
        - b_OF_theta*l_G_x__OF_theta + x[7];
    const Lanes b_G_y = -b_AG_theta*l_G_y__AG_theta - b_EG_theta*l_G_y__EG_theta - b_FE_theta*l_G_y__FE_theta
        - b_G_x*l_G_y__G_x - b_OF_theta*l_G_y__OF_theta + x[8];
    const Lanes b_E3_x = -b_BDE_theta*l_E3_x__BDE_theta - b_FE_theta*l_E3_x__FE_theta - b_G_x*l_E3_x__G_x
        - b_G_y*l_E3_x__G_y - b_H_x*l_E3_x__H_x - b_H_y*l_E3_x__H_y - b_OF_theta*l_E3_x__OF_theta + x[11];
    const Lanes b_E3_y = -b_BDE_theta*l_E3_y__BDE_theta - b_E3_x*l_E3_y__E3_x - b_FE_theta*l_E3_y__FE_theta
        - b_G_x*l_E3_y__G_x - b_G_y*l_E3_y__G_y - b_H_x*l_E3_y__H_x - b_H_y*l_E3_y__H_y - b_OF_theta*l_E3_y__OF_theta
        + x[12];

    /* backward */
    const Lanes x_E3_y = b_E3_y*inverse_pivot_E3_y;
    x[12] = x_E3_y;
    const Lanes x_E3_x = inverse_pivot_E3_x*(b_E3_x - u_E3_x__E3_y*x_E3_y);
    x[11] = x_E3_x;
    const Lanes x_G_y = inverse_pivot_G_y*(b_G_y - u_G_y__E3_x*x_E3_x - u_G_y__E3_y*x_E3_y);
    x[8] = x_G_y;
    const Lanes x_G_x = inverse_pivot_G_x*(b_G_x - u_G_x__E3_x*x_E3_x - u_G_x__E3_y*x_E3_y - u_G_x__G_y*x_G_y);
    x[7] = x_G_x;
    const Lanes x_FE_theta = inverse_pivot_FE_theta*(b_FE_theta - u_FE_theta__E3_x*x_E3_x - u_FE_theta__E3_y*x_E3_y
        - u_FE_theta__G_x*x_G_x - u_FE_theta__G_y*x_G_y);
    x[4] = x_FE_theta;
    const Lanes x_OF_theta = inverse_pivot_OF_theta*(b_OF_theta - phi_G_x_OF_theta*x_E3_x - phi_G_y_OF_theta*x_E3_y
        - u_OF_theta__FE_theta*x_FE_theta - u_OF_theta__G_x*x_G_x - u_OF_theta__G_y*x_G_y);
    x[0] = x_OF_theta;
    const Lanes x_EG_theta = inverse_pivot_EG_theta*(b_EG_theta - n_EG_theta__FE_theta*x_FE_theta
        - n_EG_theta__OF_theta*x_OF_theta - phi_G_x_EG_theta*x_G_x - phi_G_y_EG_theta*x_G_y);
    x[6] = x_EG_theta;
    const Lanes x_H_y = inverse_pivot_H_y*(b_H_y - u_H_y__E3_x*x_E3_x - u_H_y__E3_y*x_E3_y);
    x[10] = x_H_y;
    const Lanes x_H_x = inverse_pivot_H_x*(b_H_x - u_H_x__E3_x*x_E3_x - u_H_x__E3_y*x_E3_y - u_H_x__H_y*x_H_y);
    x[9] = x_H_x;
    const Lanes x_BDE_theta = inverse_pivot_BDE_theta*(b_BDE_theta + phi_H_x_BDE_theta*x_E3_x
        + phi_H_y_BDE_theta*x_E3_y - u_BDE_theta__H_x*x_H_x - u_BDE_theta__H_y*x_H_y);
    x[1] = x_BDE_theta;
    const Lanes x_HE_theta = inverse_pivot_HE_theta*(b_HE_theta - n_HE_theta__BDE_theta*x_BDE_theta
        - phi_H_x_HE_theta*x_H_x - phi_H_y_HE_theta*x_H_y);
    x[5] = x_HE_theta;
    const Lanes x_AH_theta = inverse_pivot_AH_theta*(b_AH_theta - phi_H_x_AH_theta*x_H_x - phi_H_y_AH_theta*x_H_y);
    x[3] = x_AH_theta;
    const Lanes x_AG_theta = inverse_pivot_AG_theta*(b_AG_theta - phi_G_x_AG_theta*x_G_x - phi_G_y_AG_theta*x_G_y);
    x[2] = x_AG_theta;
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
    const Lanes mass_OF_theta_FE_theta = lin->value[0];
    const Lanes mass_OF_theta_EG_theta = lin->value[1];
    const Lanes mass_FE_theta_EG_theta = lin->value[2];
    const Lanes mass_BDE_theta_HE_theta = lin->value[3];
    const Lanes phi_G_x_OF_theta = lin->value[4];
    const Lanes phi_G_x_AG_theta = lin->value[5];
    const Lanes phi_G_x_FE_theta = lin->value[6];
    const Lanes phi_G_x_EG_theta = lin->value[7];
    const Lanes phi_G_y_OF_theta = lin->value[8];
    const Lanes phi_G_y_AG_theta = lin->value[9];
    const Lanes phi_G_y_FE_theta = lin->value[10];
    const Lanes phi_G_y_EG_theta = lin->value[11];
    const Lanes phi_H_x_BDE_theta = lin->value[12];
    const Lanes phi_H_x_AH_theta = lin->value[13];
    const Lanes phi_H_x_HE_theta = lin->value[14];
    const Lanes phi_H_y_BDE_theta = lin->value[15];
    const Lanes phi_H_y_AH_theta = lin->value[16];
    const Lanes phi_H_y_HE_theta = lin->value[17];
    const Lanes by_q_G_x_AG_theta = lin->value[18];
    const Lanes by_q_G_x_EG_theta = lin->value[19];
    const Lanes by_q_G_x_FE_theta = lin->value[20];
    const Lanes by_q_G_x_OF_theta = lin->value[21];
    const Lanes by_q_G_y_AG_theta = lin->value[22];
    const Lanes by_q_G_y_EG_theta = lin->value[23];
    const Lanes by_q_G_y_FE_theta = lin->value[24];
    const Lanes by_q_G_y_OF_theta = lin->value[25];
    const Lanes by_q_H_x_AH_theta = lin->value[26];
    const Lanes by_q_H_x_BDE_theta = lin->value[27];
    const Lanes by_q_H_x_HE_theta = lin->value[28];
    const Lanes by_q_H_y_AH_theta = lin->value[29];
    const Lanes by_q_H_y_BDE_theta = lin->value[30];
    const Lanes by_q_H_y_HE_theta = lin->value[31];
    const Lanes by_q_OF_theta_OF_theta = lin->value[32];
    const Lanes by_q_OF_theta_EG_theta = lin->value[33];
    const Lanes by_q_OF_theta_FE_theta = lin->value[34];
    const Lanes by_q_BDE_theta_BDE_theta = lin->value[35];
    const Lanes by_q_BDE_theta_HE_theta = lin->value[36];
    const Lanes by_q_AG_theta_AG_theta = lin->value[37];
    const Lanes by_q_AH_theta_AH_theta = lin->value[38];
    const Lanes by_q_FE_theta_FE_theta = lin->value[39];
    const Lanes by_q_FE_theta_EG_theta = lin->value[40];
    const Lanes by_q_FE_theta_OF_theta = lin->value[41];
    const Lanes by_q_HE_theta_BDE_theta = lin->value[42];
    const Lanes by_q_HE_theta_HE_theta = lin->value[43];
    const Lanes by_q_EG_theta_FE_theta = lin->value[44];
    const Lanes by_q_EG_theta_EG_theta = lin->value[45];
    const Lanes by_q_EG_theta_OF_theta = lin->value[46];

    /* eta/kappa */
    const Lanes eta_row = eta/(eta*(p->beta_squared*eta + p->two_alpha) + 1.0);

    /* right-hand side */
    Lanes x[13];
    const Lanes shifted_OF_theta = -p->beta_squared*eta*r[0] + r[7];
    const Lanes shifted_BDE_theta = -p->beta_squared*eta*r[1] + r[8];
    const Lanes shifted_AG_theta = -p->beta_squared*eta*r[2] + r[9];
    const Lanes shifted_AH_theta = -p->beta_squared*eta*r[3] + r[10];
    const Lanes shifted_FE_theta = -p->beta_squared*eta*r[4] + r[11];
    const Lanes shifted_HE_theta = -p->beta_squared*eta*r[5] + r[12];
    const Lanes shifted_EG_theta = -p->beta_squared*eta*r[6] + r[13];
    x[0] = eta*(-by_q_OF_theta_EG_theta*eta*r[6] - by_q_OF_theta_FE_theta*eta*r[4] - by_q_OF_theta_OF_theta*eta*r[0]
        + p->mass_OF_OF*r[7] + mass_OF_theta_EG_theta*r[13] + mass_OF_theta_FE_theta*r[11]);
    x[1] = eta*(-by_q_BDE_theta_BDE_theta*eta*r[1] - by_q_BDE_theta_HE_theta*eta*r[5] + p->mass_BDE_BDE*r[8]
        + mass_BDE_theta_HE_theta*r[12]);
    x[2] = eta*(-by_q_AG_theta_AG_theta*eta*r[2] + p->mass_AG_AG*r[9]);
    x[3] = eta*(-by_q_AH_theta_AH_theta*eta*r[3] + p->mass_AH_AH*r[10]);
    x[4] = eta*(-by_q_FE_theta_EG_theta*eta*r[6] - by_q_FE_theta_FE_theta*eta*r[4] - by_q_FE_theta_OF_theta*eta*r[0]
        + p->mass_FE_FE*r[11] + mass_FE_theta_EG_theta*r[13] + mass_OF_theta_FE_theta*r[7]);
    x[5] = eta*(-by_q_HE_theta_BDE_theta*eta*r[1] - by_q_HE_theta_HE_theta*eta*r[5] + mass_BDE_theta_HE_theta*r[8]
        + p->mass_HE_HE*r[12]);
    x[6] = eta*(-by_q_EG_theta_EG_theta*eta*r[6] - by_q_EG_theta_FE_theta*eta*r[4] - by_q_EG_theta_OF_theta*eta*r[0]
        + p->mass_EG_EG*r[13] + mass_FE_theta_EG_theta*r[11] + mass_OF_theta_EG_theta*r[7]);
    x[7] = eta_row*(-by_q_G_x_AG_theta*eta*r[2] - by_q_G_x_EG_theta*eta*r[6] - by_q_G_x_FE_theta*eta*r[4]
        - by_q_G_x_OF_theta*eta*r[0] + phi_G_x_AG_theta*shifted_AG_theta + phi_G_x_EG_theta*shifted_EG_theta
        + phi_G_x_FE_theta*shifted_FE_theta + phi_G_x_OF_theta*shifted_OF_theta);
    x[8] = eta_row*(-by_q_G_y_AG_theta*eta*r[2] - by_q_G_y_EG_theta*eta*r[6] - by_q_G_y_FE_theta*eta*r[4]
        - by_q_G_y_OF_theta*eta*r[0] + phi_G_y_AG_theta*shifted_AG_theta + phi_G_y_EG_theta*shifted_EG_theta
        + phi_G_y_FE_theta*shifted_FE_theta + phi_G_y_OF_theta*shifted_OF_theta);
    x[9] = eta_row*(-by_q_H_x_AH_theta*eta*r[3] - by_q_H_x_BDE_theta*eta*r[1] - by_q_H_x_HE_theta*eta*r[5]
        + phi_H_x_AH_theta*shifted_AH_theta + phi_H_x_BDE_theta*shifted_BDE_theta + phi_H_x_HE_theta*shifted_HE_theta);
    x[10] = eta_row*(-by_q_H_y_AH_theta*eta*r[3] - by_q_H_y_BDE_theta*eta*r[1] - by_q_H_y_HE_theta*eta*r[5]
        + phi_H_y_AH_theta*shifted_AH_theta + phi_H_y_BDE_theta*shifted_BDE_theta + phi_H_y_HE_theta*shifted_HE_theta);
    x[11] = eta_row*(-by_q_G_x_FE_theta*eta*r[4] - by_q_G_x_OF_theta*eta*r[0] + by_q_H_x_BDE_theta*eta*r[1]
        + phi_G_x_FE_theta*shifted_FE_theta + phi_G_x_OF_theta*shifted_OF_theta - phi_H_x_BDE_theta*shifted_BDE_theta);
    x[12] = eta_row*(-by_q_G_y_FE_theta*eta*r[4] - by_q_G_y_OF_theta*eta*r[0] + by_q_H_y_BDE_theta*eta*r[1]
        + phi_G_y_FE_theta*shifted_FE_theta + phi_G_y_OF_theta*shifted_OF_theta - phi_H_y_BDE_theta*shifted_BDE_theta);
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
    u[15] = eta*(p->motor_value*u[7] + r[15]);
    u[16] = eta*r[16];
}

#include "engine/batch/lane_tries.c"
#include "engine/batch/lane_flow.c"
#endif
