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

/*
 * L U of Newton's matrix at eta = h gamma (0: the KKT matrix), L with unit diagonal. Returns 0, or the
 * number of the node (coordinates, rows, sticks; from 1) whose pivot vanished or is not finite.
 * At complex eta: real and imaginary parts one behind the other.
 */
static void newton_factor_complex(Lanes eta, Lanes eta_i, LaneComplexLinear *lin, LaneBits *rare)
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
    const Lanes factor_1 = p->beta_squared*eta + p->two_alpha;
    const Lanes factor_2 = p->beta_squared*eta_i;
    const Lanes divisor_1 = eta*factor_1 - eta_i*factor_2 + 1.0;
    const Lanes divisor_2 = eta*factor_2 + eta_i*factor_1;
    const Lanes divisor_3 = 1.0/((divisor_1 * divisor_1) + (divisor_2 * divisor_2));
    const Lanes factor_3 = divisor_1*divisor_3;
    const Lanes factor_4 = -divisor_2*divisor_3;
    const Lanes eta_row = eta*factor_3 - eta_i*factor_4;
    const Lanes eta_row_i = eta*factor_4 + eta_i*factor_3;

    /* matrix */
    const Lanes n_OF_theta__OF_theta = by_q_OF_theta_OF_theta*((eta * eta) - (eta_i * eta_i)) + p->mass_OF_OF;
    const Lanes n_OF_theta__OF_theta_i = 2.0*by_q_OF_theta_OF_theta*eta*eta_i;
    const Lanes factor_5 = by_q_OF_theta_FE_theta*eta + by_v_OF_theta_FE_theta;
    const Lanes factor_6 = by_q_OF_theta_FE_theta*eta_i;
    const Lanes n_OF_theta__FE_theta = eta*factor_5 - eta_i*factor_6 + mass_OF_theta_FE_theta;
    const Lanes n_OF_theta__FE_theta_i = eta*factor_6 + eta_i*factor_5;
    const Lanes factor_7 = by_q_OF_theta_EG_theta*eta + by_v_OF_theta_EG_theta;
    const Lanes factor_8 = by_q_OF_theta_EG_theta*eta_i;
    const Lanes n_OF_theta__EG_theta = eta*factor_7 - eta_i*factor_8 + mass_OF_theta_EG_theta;
    const Lanes n_OF_theta__EG_theta_i = eta*factor_8 + eta_i*factor_7;
    const Lanes n_BDE_theta__BDE_theta = by_q_BDE_theta_BDE_theta*((eta * eta) - (eta_i * eta_i)) + p->mass_BDE_BDE;
    const Lanes n_BDE_theta__BDE_theta_i = 2.0*by_q_BDE_theta_BDE_theta*eta*eta_i;
    const Lanes factor_9 = by_q_BDE_theta_HE_theta*eta + by_v_BDE_theta_HE_theta;
    const Lanes factor_10 = by_q_BDE_theta_HE_theta*eta_i;
    const Lanes n_BDE_theta__HE_theta = eta*factor_9 - eta_i*factor_10 + mass_BDE_theta_HE_theta;
    const Lanes n_BDE_theta__HE_theta_i = eta*factor_10 + eta_i*factor_9;
    const Lanes n_AG_theta__AG_theta = by_q_AG_theta_AG_theta*((eta * eta) - (eta_i * eta_i)) + p->mass_AG_AG;
    const Lanes n_AG_theta__AG_theta_i = 2.0*by_q_AG_theta_AG_theta*eta*eta_i;
    const Lanes n_AH_theta__AH_theta = by_q_AH_theta_AH_theta*((eta * eta) - (eta_i * eta_i)) + p->mass_AH_AH;
    const Lanes n_AH_theta__AH_theta_i = 2.0*by_q_AH_theta_AH_theta*eta*eta_i;
    const Lanes factor_11 = by_q_FE_theta_OF_theta*eta + by_v_FE_theta_OF_theta;
    const Lanes factor_12 = by_q_FE_theta_OF_theta*eta_i;
    const Lanes n_FE_theta__OF_theta = eta*factor_11 - eta_i*factor_12 + mass_OF_theta_FE_theta;
    const Lanes n_FE_theta__OF_theta_i = eta*factor_12 + eta_i*factor_11;
    const Lanes n_FE_theta__FE_theta = by_q_FE_theta_FE_theta*((eta * eta) - (eta_i * eta_i)) + p->mass_FE_FE;
    const Lanes n_FE_theta__FE_theta_i = 2.0*by_q_FE_theta_FE_theta*eta*eta_i;
    const Lanes factor_13 = by_q_FE_theta_EG_theta*eta + by_v_FE_theta_EG_theta;
    const Lanes factor_14 = by_q_FE_theta_EG_theta*eta_i;
    const Lanes n_FE_theta__EG_theta = eta*factor_13 - eta_i*factor_14 + mass_FE_theta_EG_theta;
    const Lanes n_FE_theta__EG_theta_i = eta*factor_14 + eta_i*factor_13;
    const Lanes factor_15 = by_q_HE_theta_BDE_theta*eta + by_v_HE_theta_BDE_theta;
    const Lanes factor_16 = by_q_HE_theta_BDE_theta*eta_i;
    const Lanes n_HE_theta__BDE_theta = eta*factor_15 - eta_i*factor_16 + mass_BDE_theta_HE_theta;
    const Lanes n_HE_theta__BDE_theta_i = eta*factor_16 + eta_i*factor_15;
    const Lanes n_HE_theta__HE_theta = by_q_HE_theta_HE_theta*((eta * eta) - (eta_i * eta_i)) + p->mass_HE_HE;
    const Lanes n_HE_theta__HE_theta_i = 2.0*by_q_HE_theta_HE_theta*eta*eta_i;
    const Lanes factor_17 = by_q_EG_theta_OF_theta*eta + by_v_EG_theta_OF_theta;
    const Lanes factor_18 = by_q_EG_theta_OF_theta*eta_i;
    const Lanes n_EG_theta__OF_theta = eta*factor_17 - eta_i*factor_18 + mass_OF_theta_EG_theta;
    const Lanes n_EG_theta__OF_theta_i = eta*factor_18 + eta_i*factor_17;
    const Lanes factor_19 = by_q_EG_theta_FE_theta*eta + by_v_EG_theta_FE_theta;
    const Lanes factor_20 = by_q_EG_theta_FE_theta*eta_i;
    const Lanes n_EG_theta__FE_theta = eta*factor_19 - eta_i*factor_20 + mass_FE_theta_EG_theta;
    const Lanes n_EG_theta__FE_theta_i = eta*factor_20 + eta_i*factor_19;
    const Lanes n_EG_theta__EG_theta = by_q_EG_theta_EG_theta*((eta * eta) - (eta_i * eta_i)) + p->mass_EG_EG;
    const Lanes n_EG_theta__EG_theta_i = 2.0*by_q_EG_theta_EG_theta*eta*eta_i;
    const Lanes factor_21 = by_q_G_x_OF_theta*eta + by_v_G_x_OF_theta;
    const Lanes factor_22 = by_q_G_x_OF_theta*eta_i;
    const Lanes n_G_x__OF_theta = eta_row*factor_21 - eta_row_i*factor_22 + phi_G_x_OF_theta;
    const Lanes n_G_x__OF_theta_i = eta_row*factor_22 + eta_row_i*factor_21;
    const Lanes factor_23 = by_q_G_x_AG_theta*eta + by_v_G_x_AG_theta;
    const Lanes factor_24 = by_q_G_x_AG_theta*eta_i;
    const Lanes n_G_x__AG_theta = eta_row*factor_23 - eta_row_i*factor_24 + phi_G_x_AG_theta;
    const Lanes n_G_x__AG_theta_i = eta_row*factor_24 + eta_row_i*factor_23;
    const Lanes factor_25 = by_q_G_x_FE_theta*eta + by_v_G_x_FE_theta;
    const Lanes factor_26 = by_q_G_x_FE_theta*eta_i;
    const Lanes n_G_x__FE_theta = eta_row*factor_25 - eta_row_i*factor_26 + phi_G_x_FE_theta;
    const Lanes n_G_x__FE_theta_i = eta_row*factor_26 + eta_row_i*factor_25;
    const Lanes factor_27 = by_q_G_x_EG_theta*eta + by_v_G_x_EG_theta;
    const Lanes factor_28 = by_q_G_x_EG_theta*eta_i;
    const Lanes n_G_x__EG_theta = eta_row*factor_27 - eta_row_i*factor_28 + phi_G_x_EG_theta;
    const Lanes n_G_x__EG_theta_i = eta_row*factor_28 + eta_row_i*factor_27;
    const Lanes factor_29 = by_q_G_y_OF_theta*eta + by_v_G_y_OF_theta;
    const Lanes factor_30 = by_q_G_y_OF_theta*eta_i;
    const Lanes n_G_y__OF_theta = eta_row*factor_29 - eta_row_i*factor_30 + phi_G_y_OF_theta;
    const Lanes n_G_y__OF_theta_i = eta_row*factor_30 + eta_row_i*factor_29;
    const Lanes factor_31 = by_q_G_y_AG_theta*eta + by_v_G_y_AG_theta;
    const Lanes factor_32 = by_q_G_y_AG_theta*eta_i;
    const Lanes n_G_y__AG_theta = eta_row*factor_31 - eta_row_i*factor_32 + phi_G_y_AG_theta;
    const Lanes n_G_y__AG_theta_i = eta_row*factor_32 + eta_row_i*factor_31;
    const Lanes factor_33 = by_q_G_y_FE_theta*eta + by_v_G_y_FE_theta;
    const Lanes factor_34 = by_q_G_y_FE_theta*eta_i;
    const Lanes n_G_y__FE_theta = eta_row*factor_33 - eta_row_i*factor_34 + phi_G_y_FE_theta;
    const Lanes n_G_y__FE_theta_i = eta_row*factor_34 + eta_row_i*factor_33;
    const Lanes factor_35 = by_q_G_y_EG_theta*eta + by_v_G_y_EG_theta;
    const Lanes factor_36 = by_q_G_y_EG_theta*eta_i;
    const Lanes n_G_y__EG_theta = eta_row*factor_35 - eta_row_i*factor_36 + phi_G_y_EG_theta;
    const Lanes n_G_y__EG_theta_i = eta_row*factor_36 + eta_row_i*factor_35;
    const Lanes factor_37 = by_q_H_x_BDE_theta*eta + by_v_H_x_BDE_theta;
    const Lanes factor_38 = by_q_H_x_BDE_theta*eta_i;
    const Lanes n_H_x__BDE_theta = eta_row*factor_37 - eta_row_i*factor_38 + phi_H_x_BDE_theta;
    const Lanes n_H_x__BDE_theta_i = eta_row*factor_38 + eta_row_i*factor_37;
    const Lanes factor_39 = by_q_H_x_AH_theta*eta + by_v_H_x_AH_theta;
    const Lanes factor_40 = by_q_H_x_AH_theta*eta_i;
    const Lanes n_H_x__AH_theta = eta_row*factor_39 - eta_row_i*factor_40 + phi_H_x_AH_theta;
    const Lanes n_H_x__AH_theta_i = eta_row*factor_40 + eta_row_i*factor_39;
    const Lanes factor_41 = by_q_H_x_HE_theta*eta + by_v_H_x_HE_theta;
    const Lanes factor_42 = by_q_H_x_HE_theta*eta_i;
    const Lanes n_H_x__HE_theta = eta_row*factor_41 - eta_row_i*factor_42 + phi_H_x_HE_theta;
    const Lanes n_H_x__HE_theta_i = eta_row*factor_42 + eta_row_i*factor_41;
    const Lanes factor_43 = by_q_H_y_BDE_theta*eta + by_v_H_y_BDE_theta;
    const Lanes factor_44 = by_q_H_y_BDE_theta*eta_i;
    const Lanes n_H_y__BDE_theta = eta_row*factor_43 - eta_row_i*factor_44 + phi_H_y_BDE_theta;
    const Lanes n_H_y__BDE_theta_i = eta_row*factor_44 + eta_row_i*factor_43;
    const Lanes factor_45 = by_q_H_y_AH_theta*eta + by_v_H_y_AH_theta;
    const Lanes factor_46 = by_q_H_y_AH_theta*eta_i;
    const Lanes n_H_y__AH_theta = eta_row*factor_45 - eta_row_i*factor_46 + phi_H_y_AH_theta;
    const Lanes n_H_y__AH_theta_i = eta_row*factor_46 + eta_row_i*factor_45;
    const Lanes factor_47 = by_q_H_y_HE_theta*eta + by_v_H_y_HE_theta;
    const Lanes factor_48 = by_q_H_y_HE_theta*eta_i;
    const Lanes n_H_y__HE_theta = eta_row*factor_47 - eta_row_i*factor_48 + phi_H_y_HE_theta;
    const Lanes n_H_y__HE_theta_i = eta_row*factor_48 + eta_row_i*factor_47;
    const Lanes factor_49 = by_q_G_x_OF_theta*eta + by_v_G_x_OF_theta;
    const Lanes factor_50 = by_q_G_x_OF_theta*eta_i;
    const Lanes n_E3_x__OF_theta = eta_row*factor_49 - eta_row_i*factor_50 + phi_G_x_OF_theta;
    const Lanes n_E3_x__OF_theta_i = eta_row*factor_50 + eta_row_i*factor_49;
    const Lanes factor_51 = -by_q_H_x_BDE_theta*eta - by_v_H_x_BDE_theta;
    const Lanes factor_52 = -by_q_H_x_BDE_theta*eta_i;
    const Lanes n_E3_x__BDE_theta = eta_row*factor_51 - eta_row_i*factor_52 - phi_H_x_BDE_theta;
    const Lanes n_E3_x__BDE_theta_i = eta_row*factor_52 + eta_row_i*factor_51;
    const Lanes factor_53 = by_q_G_x_FE_theta*eta + by_v_G_x_FE_theta;
    const Lanes factor_54 = by_q_G_x_FE_theta*eta_i;
    const Lanes n_E3_x__FE_theta = eta_row*factor_53 - eta_row_i*factor_54 + phi_G_x_FE_theta;
    const Lanes n_E3_x__FE_theta_i = eta_row*factor_54 + eta_row_i*factor_53;
    const Lanes factor_55 = by_q_G_y_OF_theta*eta + by_v_G_y_OF_theta;
    const Lanes factor_56 = by_q_G_y_OF_theta*eta_i;
    const Lanes n_E3_y__OF_theta = eta_row*factor_55 - eta_row_i*factor_56 + phi_G_y_OF_theta;
    const Lanes n_E3_y__OF_theta_i = eta_row*factor_56 + eta_row_i*factor_55;
    const Lanes factor_57 = -by_q_H_y_BDE_theta*eta - by_v_H_y_BDE_theta;
    const Lanes factor_58 = -by_q_H_y_BDE_theta*eta_i;
    const Lanes n_E3_y__BDE_theta = eta_row*factor_57 - eta_row_i*factor_58 - phi_H_y_BDE_theta;
    const Lanes n_E3_y__BDE_theta_i = eta_row*factor_58 + eta_row_i*factor_57;
    const Lanes factor_59 = by_q_G_y_FE_theta*eta + by_v_G_y_FE_theta;
    const Lanes factor_60 = by_q_G_y_FE_theta*eta_i;
    const Lanes n_E3_y__FE_theta = eta_row*factor_59 - eta_row_i*factor_60 + phi_G_y_FE_theta;
    const Lanes n_E3_y__FE_theta_i = eta_row*factor_60 + eta_row_i*factor_59;

    /* L U */
    const Lanes scale_AG_theta = n_AG_theta__AG_theta;
    const Lanes scale_AG_theta_i = n_AG_theta__AG_theta_i;
    const Lanes size_1 = lanes_fabs(scale_AG_theta) + lanes_fabs(scale_AG_theta_i);
    const Lanes size_2 = lanes_fabs(n_AG_theta__AG_theta) + lanes_fabs(n_AG_theta__AG_theta_i);
    *rare |= ~(size_1 > SINGULAR * size_2);
    const Lanes divisor_4 = 1.0/((scale_AG_theta * scale_AG_theta) + (scale_AG_theta_i * scale_AG_theta_i));
    const Lanes inverse_pivot_AG_theta = divisor_4*scale_AG_theta;
    const Lanes inverse_pivot_AG_theta_i = -divisor_4*scale_AG_theta_i;
    lin->lu[0] = inverse_pivot_AG_theta;
    lin->lu[1] = inverse_pivot_AG_theta_i;
    const Lanes l_G_x__AG_theta = inverse_pivot_AG_theta*n_G_x__AG_theta - inverse_pivot_AG_theta_i*n_G_x__AG_theta_i;
    const Lanes l_G_x__AG_theta_3_i = inverse_pivot_AG_theta*n_G_x__AG_theta_i
        + inverse_pivot_AG_theta_i*n_G_x__AG_theta;
    lin->lu[2] = l_G_x__AG_theta;
    lin->lu[3] = l_G_x__AG_theta_3_i;
    const Lanes l_G_y__AG_theta = inverse_pivot_AG_theta*n_G_y__AG_theta - inverse_pivot_AG_theta_i*n_G_y__AG_theta_i;
    const Lanes l_G_y__AG_theta_3_i = inverse_pivot_AG_theta*n_G_y__AG_theta_i
        + inverse_pivot_AG_theta_i*n_G_y__AG_theta;
    lin->lu[4] = l_G_y__AG_theta;
    lin->lu[5] = l_G_y__AG_theta_3_i;
    const Lanes scale_AH_theta = n_AH_theta__AH_theta;
    const Lanes scale_AH_theta_i = n_AH_theta__AH_theta_i;
    const Lanes size_3 = lanes_fabs(scale_AH_theta) + lanes_fabs(scale_AH_theta_i);
    const Lanes size_4 = lanes_fabs(n_AH_theta__AH_theta) + lanes_fabs(n_AH_theta__AH_theta_i);
    *rare |= ~(size_3 > SINGULAR * size_4);
    const Lanes divisor_5 = 1.0/((scale_AH_theta * scale_AH_theta) + (scale_AH_theta_i * scale_AH_theta_i));
    const Lanes inverse_pivot_AH_theta = divisor_5*scale_AH_theta;
    const Lanes inverse_pivot_AH_theta_i = -divisor_5*scale_AH_theta_i;
    lin->lu[6] = inverse_pivot_AH_theta;
    lin->lu[7] = inverse_pivot_AH_theta_i;
    const Lanes l_H_x__AH_theta = inverse_pivot_AH_theta*n_H_x__AH_theta - inverse_pivot_AH_theta_i*n_H_x__AH_theta_i;
    const Lanes l_H_x__AH_theta_3_i = inverse_pivot_AH_theta*n_H_x__AH_theta_i
        + inverse_pivot_AH_theta_i*n_H_x__AH_theta;
    lin->lu[8] = l_H_x__AH_theta;
    lin->lu[9] = l_H_x__AH_theta_3_i;
    const Lanes l_H_y__AH_theta = inverse_pivot_AH_theta*n_H_y__AH_theta - inverse_pivot_AH_theta_i*n_H_y__AH_theta_i;
    const Lanes l_H_y__AH_theta_3_i = inverse_pivot_AH_theta*n_H_y__AH_theta_i
        + inverse_pivot_AH_theta_i*n_H_y__AH_theta;
    lin->lu[10] = l_H_y__AH_theta;
    lin->lu[11] = l_H_y__AH_theta_3_i;
    const Lanes scale_HE_theta = n_HE_theta__HE_theta;
    const Lanes scale_HE_theta_i = n_HE_theta__HE_theta_i;
    const Lanes size_5 = lanes_fabs(scale_HE_theta) + lanes_fabs(scale_HE_theta_i);
    const Lanes size_6 = lanes_fabs(n_HE_theta__HE_theta) + lanes_fabs(n_HE_theta__HE_theta_i);
    *rare |= ~(size_5 > SINGULAR * size_6);
    const Lanes divisor_6 = 1.0/((scale_HE_theta * scale_HE_theta) + (scale_HE_theta_i * scale_HE_theta_i));
    const Lanes inverse_pivot_HE_theta = divisor_6*scale_HE_theta;
    const Lanes inverse_pivot_HE_theta_i = -divisor_6*scale_HE_theta_i;
    lin->lu[12] = inverse_pivot_HE_theta;
    lin->lu[13] = inverse_pivot_HE_theta_i;
    const Lanes l_BDE_theta__HE_theta = inverse_pivot_HE_theta*n_BDE_theta__HE_theta
        - inverse_pivot_HE_theta_i*n_BDE_theta__HE_theta_i;
    const Lanes l_BDE_theta__HE_theta_3_i = inverse_pivot_HE_theta*n_BDE_theta__HE_theta_i
        + inverse_pivot_HE_theta_i*n_BDE_theta__HE_theta;
    lin->lu[14] = l_BDE_theta__HE_theta;
    lin->lu[15] = l_BDE_theta__HE_theta_3_i;
    lin->lu[16] = n_HE_theta__BDE_theta;
    lin->lu[17] = n_HE_theta__BDE_theta_i;
    const Lanes l_H_x__HE_theta = inverse_pivot_HE_theta*n_H_x__HE_theta - inverse_pivot_HE_theta_i*n_H_x__HE_theta_i;
    const Lanes l_H_x__HE_theta_3_i = inverse_pivot_HE_theta*n_H_x__HE_theta_i
        + inverse_pivot_HE_theta_i*n_H_x__HE_theta;
    lin->lu[18] = l_H_x__HE_theta;
    lin->lu[19] = l_H_x__HE_theta_3_i;
    const Lanes l_H_y__HE_theta = inverse_pivot_HE_theta*n_H_y__HE_theta - inverse_pivot_HE_theta_i*n_H_y__HE_theta_i;
    const Lanes l_H_y__HE_theta_3_i = inverse_pivot_HE_theta*n_H_y__HE_theta_i
        + inverse_pivot_HE_theta_i*n_H_y__HE_theta;
    lin->lu[20] = l_H_y__HE_theta;
    lin->lu[21] = l_H_y__HE_theta_3_i;
    const Lanes scale_BDE_theta = -l_BDE_theta__HE_theta*n_HE_theta__BDE_theta
        + l_BDE_theta__HE_theta_3_i*n_HE_theta__BDE_theta_i + n_BDE_theta__BDE_theta;
    const Lanes scale_BDE_theta_i = -l_BDE_theta__HE_theta*n_HE_theta__BDE_theta_i
        - l_BDE_theta__HE_theta_3_i*n_HE_theta__BDE_theta + n_BDE_theta__BDE_theta_i;
    const Lanes size_7 = lanes_fabs(scale_BDE_theta) + lanes_fabs(scale_BDE_theta_i);
    const Lanes size_8 = lanes_fabs(n_BDE_theta__BDE_theta) + lanes_fabs(n_BDE_theta__BDE_theta_i);
    *rare |= ~(size_7 > SINGULAR * size_8);
    const Lanes divisor_7 = 1.0/((scale_BDE_theta * scale_BDE_theta) + (scale_BDE_theta_i * scale_BDE_theta_i));
    const Lanes inverse_pivot_BDE_theta = divisor_7*scale_BDE_theta;
    const Lanes inverse_pivot_BDE_theta_3_i = -divisor_7*scale_BDE_theta_i;
    lin->lu[22] = inverse_pivot_BDE_theta;
    lin->lu[23] = inverse_pivot_BDE_theta_3_i;
    const Lanes factor_61 = -l_H_x__HE_theta*n_HE_theta__BDE_theta + l_H_x__HE_theta_3_i*n_HE_theta__BDE_theta_i
        + n_H_x__BDE_theta;
    const Lanes factor_62 = -l_H_x__HE_theta*n_HE_theta__BDE_theta_i - l_H_x__HE_theta_3_i*n_HE_theta__BDE_theta
        + n_H_x__BDE_theta_i;
    const Lanes l_H_x__BDE_theta = factor_61*inverse_pivot_BDE_theta - factor_62*inverse_pivot_BDE_theta_3_i;
    const Lanes l_H_x__BDE_theta_2_i = factor_61*inverse_pivot_BDE_theta_3_i + factor_62*inverse_pivot_BDE_theta;
    lin->lu[24] = l_H_x__BDE_theta;
    lin->lu[25] = l_H_x__BDE_theta_2_i;
    const Lanes u_BDE_theta__H_x = -l_BDE_theta__HE_theta*phi_H_x_HE_theta + phi_H_x_BDE_theta;
    const Lanes u_BDE_theta__H_x_i = -l_BDE_theta__HE_theta_3_i*phi_H_x_HE_theta;
    lin->lu[26] = u_BDE_theta__H_x;
    lin->lu[27] = u_BDE_theta__H_x_i;
    const Lanes factor_63 = -l_H_y__HE_theta*n_HE_theta__BDE_theta + l_H_y__HE_theta_3_i*n_HE_theta__BDE_theta_i
        + n_H_y__BDE_theta;
    const Lanes factor_64 = -l_H_y__HE_theta*n_HE_theta__BDE_theta_i - l_H_y__HE_theta_3_i*n_HE_theta__BDE_theta
        + n_H_y__BDE_theta_i;
    const Lanes l_H_y__BDE_theta = factor_63*inverse_pivot_BDE_theta - factor_64*inverse_pivot_BDE_theta_3_i;
    const Lanes l_H_y__BDE_theta_2_i = factor_63*inverse_pivot_BDE_theta_3_i + factor_64*inverse_pivot_BDE_theta;
    lin->lu[28] = l_H_y__BDE_theta;
    lin->lu[29] = l_H_y__BDE_theta_2_i;
    const Lanes u_BDE_theta__H_y = -l_BDE_theta__HE_theta*phi_H_y_HE_theta + phi_H_y_BDE_theta;
    const Lanes u_BDE_theta__H_y_i = -l_BDE_theta__HE_theta_3_i*phi_H_y_HE_theta;
    lin->lu[30] = u_BDE_theta__H_y;
    lin->lu[31] = u_BDE_theta__H_y_i;
    const Lanes l_E3_x__BDE_theta = inverse_pivot_BDE_theta*n_E3_x__BDE_theta
        - inverse_pivot_BDE_theta_3_i*n_E3_x__BDE_theta_i;
    const Lanes l_E3_x__BDE_theta_3_i = inverse_pivot_BDE_theta*n_E3_x__BDE_theta_i
        + inverse_pivot_BDE_theta_3_i*n_E3_x__BDE_theta;
    lin->lu[32] = l_E3_x__BDE_theta;
    lin->lu[33] = l_E3_x__BDE_theta_3_i;
    const Lanes l_E3_y__BDE_theta = inverse_pivot_BDE_theta*n_E3_y__BDE_theta
        - inverse_pivot_BDE_theta_3_i*n_E3_y__BDE_theta_i;
    const Lanes l_E3_y__BDE_theta_3_i = inverse_pivot_BDE_theta*n_E3_y__BDE_theta_i
        + inverse_pivot_BDE_theta_3_i*n_E3_y__BDE_theta;
    lin->lu[34] = l_E3_y__BDE_theta;
    lin->lu[35] = l_E3_y__BDE_theta_3_i;
    const Lanes scale_H_x = -l_H_x__AH_theta*phi_H_x_AH_theta - l_H_x__BDE_theta*u_BDE_theta__H_x
        + l_H_x__BDE_theta_2_i*u_BDE_theta__H_x_i - l_H_x__HE_theta*phi_H_x_HE_theta;
    const Lanes scale_H_x_3_i = -l_H_x__AH_theta_3_i*phi_H_x_AH_theta - l_H_x__BDE_theta*u_BDE_theta__H_x_i
        - l_H_x__BDE_theta_2_i*u_BDE_theta__H_x - l_H_x__HE_theta_3_i*phi_H_x_HE_theta;
    const Lanes size_9 = lanes_fabs(scale_H_x) + lanes_fabs(scale_H_x_3_i);
    *rare |= ~((size_9 > 0.0) & (size_9 < INFINITY));
    const Lanes divisor_8 = 1.0/((scale_H_x * scale_H_x) + (scale_H_x_3_i * scale_H_x_3_i));
    const Lanes inverse_pivot_H_x = divisor_8*scale_H_x;
    const Lanes inverse_pivot_H_x_3_i = -divisor_8*scale_H_x_3_i;
    lin->lu[36] = inverse_pivot_H_x;
    lin->lu[37] = inverse_pivot_H_x_3_i;
    const Lanes factor_65 = -l_H_y__AH_theta*phi_H_x_AH_theta - l_H_y__BDE_theta*u_BDE_theta__H_x
        + l_H_y__BDE_theta_2_i*u_BDE_theta__H_x_i - l_H_y__HE_theta*phi_H_x_HE_theta;
    const Lanes factor_66 = -l_H_y__AH_theta_3_i*phi_H_x_AH_theta - l_H_y__BDE_theta*u_BDE_theta__H_x_i
        - l_H_y__BDE_theta_2_i*u_BDE_theta__H_x - l_H_y__HE_theta_3_i*phi_H_x_HE_theta;
    const Lanes l_H_y__H_x = factor_65*inverse_pivot_H_x - factor_66*inverse_pivot_H_x_3_i;
    const Lanes l_H_y__H_x_i = factor_65*inverse_pivot_H_x_3_i + factor_66*inverse_pivot_H_x;
    lin->lu[38] = l_H_y__H_x;
    lin->lu[39] = l_H_y__H_x_i;
    const Lanes u_H_x__H_y = -l_H_x__AH_theta*phi_H_y_AH_theta - l_H_x__BDE_theta*u_BDE_theta__H_y
        + l_H_x__BDE_theta_2_i*u_BDE_theta__H_y_i - l_H_x__HE_theta*phi_H_y_HE_theta;
    const Lanes u_H_x__H_y_i = -l_H_x__AH_theta_3_i*phi_H_y_AH_theta - l_H_x__BDE_theta*u_BDE_theta__H_y_i
        - l_H_x__BDE_theta_2_i*u_BDE_theta__H_y - l_H_x__HE_theta_3_i*phi_H_y_HE_theta;
    lin->lu[40] = u_H_x__H_y;
    lin->lu[41] = u_H_x__H_y_i;
    const Lanes factor_67 = inverse_pivot_H_x*l_E3_x__BDE_theta - inverse_pivot_H_x_3_i*l_E3_x__BDE_theta_3_i;
    const Lanes factor_68 = inverse_pivot_H_x*l_E3_x__BDE_theta_3_i + inverse_pivot_H_x_3_i*l_E3_x__BDE_theta;
    const Lanes l_E3_x__H_x = -factor_67*u_BDE_theta__H_x + factor_68*u_BDE_theta__H_x_i;
    const Lanes l_E3_x__H_x_2_i = -factor_67*u_BDE_theta__H_x_i - factor_68*u_BDE_theta__H_x;
    lin->lu[42] = l_E3_x__H_x;
    lin->lu[43] = l_E3_x__H_x_2_i;
    const Lanes u_H_x__E3_x = l_H_x__BDE_theta*phi_H_x_BDE_theta;
    const Lanes u_H_x__E3_x_i = l_H_x__BDE_theta_2_i*phi_H_x_BDE_theta;
    lin->lu[44] = u_H_x__E3_x;
    lin->lu[45] = u_H_x__E3_x_i;
    const Lanes factor_69 = inverse_pivot_H_x*l_E3_y__BDE_theta - inverse_pivot_H_x_3_i*l_E3_y__BDE_theta_3_i;
    const Lanes factor_70 = inverse_pivot_H_x*l_E3_y__BDE_theta_3_i + inverse_pivot_H_x_3_i*l_E3_y__BDE_theta;
    const Lanes l_E3_y__H_x = -factor_69*u_BDE_theta__H_x + factor_70*u_BDE_theta__H_x_i;
    const Lanes l_E3_y__H_x_2_i = -factor_69*u_BDE_theta__H_x_i - factor_70*u_BDE_theta__H_x;
    lin->lu[46] = l_E3_y__H_x;
    lin->lu[47] = l_E3_y__H_x_2_i;
    const Lanes u_H_x__E3_y = l_H_x__BDE_theta*phi_H_y_BDE_theta;
    const Lanes u_H_x__E3_y_i = l_H_x__BDE_theta_2_i*phi_H_y_BDE_theta;
    lin->lu[48] = u_H_x__E3_y;
    lin->lu[49] = u_H_x__E3_y_i;
    const Lanes scale_H_y = -l_H_y__AH_theta*phi_H_y_AH_theta - l_H_y__BDE_theta*u_BDE_theta__H_y
        + l_H_y__BDE_theta_2_i*u_BDE_theta__H_y_i - l_H_y__HE_theta*phi_H_y_HE_theta;
    const Lanes scale_H_y_3_i = -l_H_y__AH_theta_3_i*phi_H_y_AH_theta - l_H_y__BDE_theta*u_BDE_theta__H_y_i
        - l_H_y__BDE_theta_2_i*u_BDE_theta__H_y - l_H_y__HE_theta_3_i*phi_H_y_HE_theta;
    const Lanes pivot_H_y = -l_H_y__H_x*u_H_x__H_y + l_H_y__H_x_i*u_H_x__H_y_i + scale_H_y;
    const Lanes pivot_H_y_i = -l_H_y__H_x*u_H_x__H_y_i - l_H_y__H_x_i*u_H_x__H_y + scale_H_y_3_i;
    const Lanes size_10 = lanes_fabs(pivot_H_y) + lanes_fabs(pivot_H_y_i);
    const Lanes size_11 = lanes_fabs(scale_H_y) + lanes_fabs(scale_H_y_3_i);
    *rare |= ~(size_10 > SINGULAR * size_11);
    const Lanes divisor_9 = 1.0/((pivot_H_y * pivot_H_y) + (pivot_H_y_i * pivot_H_y_i));
    const Lanes inverse_pivot_H_y = divisor_9*pivot_H_y;
    const Lanes inverse_pivot_H_y_3_i = -divisor_9*pivot_H_y_i;
    lin->lu[50] = inverse_pivot_H_y;
    lin->lu[51] = inverse_pivot_H_y_3_i;
    const Lanes factor_71 = -l_E3_x__BDE_theta*u_BDE_theta__H_y + l_E3_x__BDE_theta_3_i*u_BDE_theta__H_y_i
        - l_E3_x__H_x*u_H_x__H_y + l_E3_x__H_x_2_i*u_H_x__H_y_i;
    const Lanes factor_72 = -l_E3_x__BDE_theta*u_BDE_theta__H_y_i - l_E3_x__BDE_theta_3_i*u_BDE_theta__H_y
        - l_E3_x__H_x*u_H_x__H_y_i - l_E3_x__H_x_2_i*u_H_x__H_y;
    const Lanes l_E3_x__H_y = factor_71*inverse_pivot_H_y - factor_72*inverse_pivot_H_y_3_i;
    const Lanes l_E3_x__H_y_2_i = factor_71*inverse_pivot_H_y_3_i + factor_72*inverse_pivot_H_y;
    lin->lu[52] = l_E3_x__H_y;
    lin->lu[53] = l_E3_x__H_y_2_i;
    const Lanes u_H_y__E3_x = l_H_y__BDE_theta*phi_H_x_BDE_theta - l_H_y__H_x*u_H_x__E3_x + l_H_y__H_x_i*u_H_x__E3_x_i;
    const Lanes u_H_y__E3_x_i = l_H_y__BDE_theta_2_i*phi_H_x_BDE_theta - l_H_y__H_x*u_H_x__E3_x_i
        - l_H_y__H_x_i*u_H_x__E3_x;
    lin->lu[54] = u_H_y__E3_x;
    lin->lu[55] = u_H_y__E3_x_i;
    const Lanes factor_73 = -l_E3_y__BDE_theta*u_BDE_theta__H_y + l_E3_y__BDE_theta_3_i*u_BDE_theta__H_y_i
        - l_E3_y__H_x*u_H_x__H_y + l_E3_y__H_x_2_i*u_H_x__H_y_i;
    const Lanes factor_74 = -l_E3_y__BDE_theta*u_BDE_theta__H_y_i - l_E3_y__BDE_theta_3_i*u_BDE_theta__H_y
        - l_E3_y__H_x*u_H_x__H_y_i - l_E3_y__H_x_2_i*u_H_x__H_y;
    const Lanes l_E3_y__H_y = factor_73*inverse_pivot_H_y - factor_74*inverse_pivot_H_y_3_i;
    const Lanes l_E3_y__H_y_2_i = factor_73*inverse_pivot_H_y_3_i + factor_74*inverse_pivot_H_y;
    lin->lu[56] = l_E3_y__H_y;
    lin->lu[57] = l_E3_y__H_y_2_i;
    const Lanes u_H_y__E3_y = l_H_y__BDE_theta*phi_H_y_BDE_theta - l_H_y__H_x*u_H_x__E3_y + l_H_y__H_x_i*u_H_x__E3_y_i;
    const Lanes u_H_y__E3_y_i = l_H_y__BDE_theta_2_i*phi_H_y_BDE_theta - l_H_y__H_x*u_H_x__E3_y_i
        - l_H_y__H_x_i*u_H_x__E3_y;
    lin->lu[58] = u_H_y__E3_y;
    lin->lu[59] = u_H_y__E3_y_i;
    const Lanes scale_EG_theta = n_EG_theta__EG_theta;
    const Lanes scale_EG_theta_i = n_EG_theta__EG_theta_i;
    const Lanes size_12 = lanes_fabs(scale_EG_theta) + lanes_fabs(scale_EG_theta_i);
    const Lanes size_13 = lanes_fabs(n_EG_theta__EG_theta) + lanes_fabs(n_EG_theta__EG_theta_i);
    *rare |= ~(size_12 > SINGULAR * size_13);
    const Lanes divisor_10 = 1.0/((scale_EG_theta * scale_EG_theta) + (scale_EG_theta_i * scale_EG_theta_i));
    const Lanes inverse_pivot_EG_theta = divisor_10*scale_EG_theta;
    const Lanes inverse_pivot_EG_theta_i = -divisor_10*scale_EG_theta_i;
    lin->lu[60] = inverse_pivot_EG_theta;
    lin->lu[61] = inverse_pivot_EG_theta_i;
    const Lanes l_OF_theta__EG_theta = inverse_pivot_EG_theta*n_OF_theta__EG_theta
        - inverse_pivot_EG_theta_i*n_OF_theta__EG_theta_i;
    const Lanes l_OF_theta__EG_theta_3_i = inverse_pivot_EG_theta*n_OF_theta__EG_theta_i
        + inverse_pivot_EG_theta_i*n_OF_theta__EG_theta;
    lin->lu[62] = l_OF_theta__EG_theta;
    lin->lu[63] = l_OF_theta__EG_theta_3_i;
    lin->lu[64] = n_EG_theta__OF_theta;
    lin->lu[65] = n_EG_theta__OF_theta_i;
    const Lanes l_FE_theta__EG_theta = inverse_pivot_EG_theta*n_FE_theta__EG_theta
        - inverse_pivot_EG_theta_i*n_FE_theta__EG_theta_i;
    const Lanes l_FE_theta__EG_theta_3_i = inverse_pivot_EG_theta*n_FE_theta__EG_theta_i
        + inverse_pivot_EG_theta_i*n_FE_theta__EG_theta;
    lin->lu[66] = l_FE_theta__EG_theta;
    lin->lu[67] = l_FE_theta__EG_theta_3_i;
    lin->lu[68] = n_EG_theta__FE_theta;
    lin->lu[69] = n_EG_theta__FE_theta_i;
    const Lanes l_G_x__EG_theta = inverse_pivot_EG_theta*n_G_x__EG_theta - inverse_pivot_EG_theta_i*n_G_x__EG_theta_i;
    const Lanes l_G_x__EG_theta_3_i = inverse_pivot_EG_theta*n_G_x__EG_theta_i
        + inverse_pivot_EG_theta_i*n_G_x__EG_theta;
    lin->lu[70] = l_G_x__EG_theta;
    lin->lu[71] = l_G_x__EG_theta_3_i;
    const Lanes l_G_y__EG_theta = inverse_pivot_EG_theta*n_G_y__EG_theta - inverse_pivot_EG_theta_i*n_G_y__EG_theta_i;
    const Lanes l_G_y__EG_theta_3_i = inverse_pivot_EG_theta*n_G_y__EG_theta_i
        + inverse_pivot_EG_theta_i*n_G_y__EG_theta;
    lin->lu[72] = l_G_y__EG_theta;
    lin->lu[73] = l_G_y__EG_theta_3_i;
    const Lanes scale_OF_theta = -l_OF_theta__EG_theta*n_EG_theta__OF_theta
        + l_OF_theta__EG_theta_3_i*n_EG_theta__OF_theta_i + n_OF_theta__OF_theta;
    const Lanes scale_OF_theta_i = -l_OF_theta__EG_theta*n_EG_theta__OF_theta_i
        - l_OF_theta__EG_theta_3_i*n_EG_theta__OF_theta + n_OF_theta__OF_theta_i;
    const Lanes size_14 = lanes_fabs(scale_OF_theta) + lanes_fabs(scale_OF_theta_i);
    const Lanes size_15 = lanes_fabs(n_OF_theta__OF_theta) + lanes_fabs(n_OF_theta__OF_theta_i);
    *rare |= ~(size_14 > SINGULAR * size_15);
    const Lanes divisor_11 = 1.0/((scale_OF_theta * scale_OF_theta) + (scale_OF_theta_i * scale_OF_theta_i));
    const Lanes inverse_pivot_OF_theta = divisor_11*scale_OF_theta;
    const Lanes inverse_pivot_OF_theta_3_i = -divisor_11*scale_OF_theta_i;
    lin->lu[74] = inverse_pivot_OF_theta;
    lin->lu[75] = inverse_pivot_OF_theta_3_i;
    const Lanes factor_75 = -l_FE_theta__EG_theta*n_EG_theta__OF_theta
        + l_FE_theta__EG_theta_3_i*n_EG_theta__OF_theta_i + n_FE_theta__OF_theta;
    const Lanes factor_76 = -l_FE_theta__EG_theta*n_EG_theta__OF_theta_i
        - l_FE_theta__EG_theta_3_i*n_EG_theta__OF_theta + n_FE_theta__OF_theta_i;
    const Lanes l_FE_theta__OF_theta = factor_75*inverse_pivot_OF_theta - factor_76*inverse_pivot_OF_theta_3_i;
    const Lanes l_FE_theta__OF_theta_i = factor_75*inverse_pivot_OF_theta_3_i + factor_76*inverse_pivot_OF_theta;
    lin->lu[76] = l_FE_theta__OF_theta;
    lin->lu[77] = l_FE_theta__OF_theta_i;
    const Lanes u_OF_theta__FE_theta = -l_OF_theta__EG_theta*n_EG_theta__FE_theta
        + l_OF_theta__EG_theta_3_i*n_EG_theta__FE_theta_i + n_OF_theta__FE_theta;
    const Lanes u_OF_theta__FE_theta_i = -l_OF_theta__EG_theta*n_EG_theta__FE_theta_i
        - l_OF_theta__EG_theta_3_i*n_EG_theta__FE_theta + n_OF_theta__FE_theta_i;
    lin->lu[78] = u_OF_theta__FE_theta;
    lin->lu[79] = u_OF_theta__FE_theta_i;
    const Lanes factor_77 = -l_G_x__EG_theta*n_EG_theta__OF_theta + l_G_x__EG_theta_3_i*n_EG_theta__OF_theta_i
        + n_G_x__OF_theta;
    const Lanes factor_78 = -l_G_x__EG_theta*n_EG_theta__OF_theta_i - l_G_x__EG_theta_3_i*n_EG_theta__OF_theta
        + n_G_x__OF_theta_i;
    const Lanes l_G_x__OF_theta = factor_77*inverse_pivot_OF_theta - factor_78*inverse_pivot_OF_theta_3_i;
    const Lanes l_G_x__OF_theta_2_i = factor_77*inverse_pivot_OF_theta_3_i + factor_78*inverse_pivot_OF_theta;
    lin->lu[80] = l_G_x__OF_theta;
    lin->lu[81] = l_G_x__OF_theta_2_i;
    const Lanes u_OF_theta__G_x = -l_OF_theta__EG_theta*phi_G_x_EG_theta + phi_G_x_OF_theta;
    const Lanes u_OF_theta__G_x_i = -l_OF_theta__EG_theta_3_i*phi_G_x_EG_theta;
    lin->lu[82] = u_OF_theta__G_x;
    lin->lu[83] = u_OF_theta__G_x_i;
    const Lanes factor_79 = -l_G_y__EG_theta*n_EG_theta__OF_theta + l_G_y__EG_theta_3_i*n_EG_theta__OF_theta_i
        + n_G_y__OF_theta;
    const Lanes factor_80 = -l_G_y__EG_theta*n_EG_theta__OF_theta_i - l_G_y__EG_theta_3_i*n_EG_theta__OF_theta
        + n_G_y__OF_theta_i;
    const Lanes l_G_y__OF_theta = factor_79*inverse_pivot_OF_theta - factor_80*inverse_pivot_OF_theta_3_i;
    const Lanes l_G_y__OF_theta_2_i = factor_79*inverse_pivot_OF_theta_3_i + factor_80*inverse_pivot_OF_theta;
    lin->lu[84] = l_G_y__OF_theta;
    lin->lu[85] = l_G_y__OF_theta_2_i;
    const Lanes u_OF_theta__G_y = -l_OF_theta__EG_theta*phi_G_y_EG_theta + phi_G_y_OF_theta;
    const Lanes u_OF_theta__G_y_i = -l_OF_theta__EG_theta_3_i*phi_G_y_EG_theta;
    lin->lu[86] = u_OF_theta__G_y;
    lin->lu[87] = u_OF_theta__G_y_i;
    const Lanes l_E3_x__OF_theta = inverse_pivot_OF_theta*n_E3_x__OF_theta
        - inverse_pivot_OF_theta_3_i*n_E3_x__OF_theta_i;
    const Lanes l_E3_x__OF_theta_3_i = inverse_pivot_OF_theta*n_E3_x__OF_theta_i
        + inverse_pivot_OF_theta_3_i*n_E3_x__OF_theta;
    lin->lu[88] = l_E3_x__OF_theta;
    lin->lu[89] = l_E3_x__OF_theta_3_i;
    const Lanes l_E3_y__OF_theta = inverse_pivot_OF_theta*n_E3_y__OF_theta
        - inverse_pivot_OF_theta_3_i*n_E3_y__OF_theta_i;
    const Lanes l_E3_y__OF_theta_3_i = inverse_pivot_OF_theta*n_E3_y__OF_theta_i
        + inverse_pivot_OF_theta_3_i*n_E3_y__OF_theta;
    lin->lu[90] = l_E3_y__OF_theta;
    lin->lu[91] = l_E3_y__OF_theta_3_i;
    const Lanes scale_FE_theta = -l_FE_theta__EG_theta*n_EG_theta__FE_theta
        + l_FE_theta__EG_theta_3_i*n_EG_theta__FE_theta_i - l_FE_theta__OF_theta*u_OF_theta__FE_theta
        + l_FE_theta__OF_theta_i*u_OF_theta__FE_theta_i + n_FE_theta__FE_theta;
    const Lanes scale_FE_theta_i = -l_FE_theta__EG_theta*n_EG_theta__FE_theta_i
        - l_FE_theta__EG_theta_3_i*n_EG_theta__FE_theta - l_FE_theta__OF_theta*u_OF_theta__FE_theta_i
        - l_FE_theta__OF_theta_i*u_OF_theta__FE_theta + n_FE_theta__FE_theta_i;
    const Lanes size_16 = lanes_fabs(scale_FE_theta) + lanes_fabs(scale_FE_theta_i);
    const Lanes size_17 = lanes_fabs(n_FE_theta__FE_theta) + lanes_fabs(n_FE_theta__FE_theta_i);
    *rare |= ~(size_16 > SINGULAR * size_17);
    const Lanes divisor_12 = 1.0/((scale_FE_theta * scale_FE_theta) + (scale_FE_theta_i * scale_FE_theta_i));
    const Lanes inverse_pivot_FE_theta = divisor_12*scale_FE_theta;
    const Lanes inverse_pivot_FE_theta_3_i = -divisor_12*scale_FE_theta_i;
    lin->lu[92] = inverse_pivot_FE_theta;
    lin->lu[93] = inverse_pivot_FE_theta_3_i;
    const Lanes factor_81 = -l_G_x__EG_theta*n_EG_theta__FE_theta + l_G_x__EG_theta_3_i*n_EG_theta__FE_theta_i
        - l_G_x__OF_theta*u_OF_theta__FE_theta + l_G_x__OF_theta_2_i*u_OF_theta__FE_theta_i + n_G_x__FE_theta;
    const Lanes factor_82 = -l_G_x__EG_theta*n_EG_theta__FE_theta_i - l_G_x__EG_theta_3_i*n_EG_theta__FE_theta
        - l_G_x__OF_theta*u_OF_theta__FE_theta_i - l_G_x__OF_theta_2_i*u_OF_theta__FE_theta + n_G_x__FE_theta_i;
    const Lanes l_G_x__FE_theta = factor_81*inverse_pivot_FE_theta - factor_82*inverse_pivot_FE_theta_3_i;
    const Lanes l_G_x__FE_theta_2_i = factor_81*inverse_pivot_FE_theta_3_i + factor_82*inverse_pivot_FE_theta;
    lin->lu[94] = l_G_x__FE_theta;
    lin->lu[95] = l_G_x__FE_theta_2_i;
    const Lanes u_FE_theta__G_x = -l_FE_theta__EG_theta*phi_G_x_EG_theta - l_FE_theta__OF_theta*u_OF_theta__G_x
        + l_FE_theta__OF_theta_i*u_OF_theta__G_x_i + phi_G_x_FE_theta;
    const Lanes u_FE_theta__G_x_i = -l_FE_theta__EG_theta_3_i*phi_G_x_EG_theta - l_FE_theta__OF_theta*u_OF_theta__G_x_i
        - l_FE_theta__OF_theta_i*u_OF_theta__G_x;
    lin->lu[96] = u_FE_theta__G_x;
    lin->lu[97] = u_FE_theta__G_x_i;
    const Lanes factor_83 = -l_G_y__EG_theta*n_EG_theta__FE_theta + l_G_y__EG_theta_3_i*n_EG_theta__FE_theta_i
        - l_G_y__OF_theta*u_OF_theta__FE_theta + l_G_y__OF_theta_2_i*u_OF_theta__FE_theta_i + n_G_y__FE_theta;
    const Lanes factor_84 = -l_G_y__EG_theta*n_EG_theta__FE_theta_i - l_G_y__EG_theta_3_i*n_EG_theta__FE_theta
        - l_G_y__OF_theta*u_OF_theta__FE_theta_i - l_G_y__OF_theta_2_i*u_OF_theta__FE_theta + n_G_y__FE_theta_i;
    const Lanes l_G_y__FE_theta = factor_83*inverse_pivot_FE_theta - factor_84*inverse_pivot_FE_theta_3_i;
    const Lanes l_G_y__FE_theta_2_i = factor_83*inverse_pivot_FE_theta_3_i + factor_84*inverse_pivot_FE_theta;
    lin->lu[98] = l_G_y__FE_theta;
    lin->lu[99] = l_G_y__FE_theta_2_i;
    const Lanes u_FE_theta__G_y = -l_FE_theta__EG_theta*phi_G_y_EG_theta - l_FE_theta__OF_theta*u_OF_theta__G_y
        + l_FE_theta__OF_theta_i*u_OF_theta__G_y_i + phi_G_y_FE_theta;
    const Lanes u_FE_theta__G_y_i = -l_FE_theta__EG_theta_3_i*phi_G_y_EG_theta - l_FE_theta__OF_theta*u_OF_theta__G_y_i
        - l_FE_theta__OF_theta_i*u_OF_theta__G_y;
    lin->lu[100] = u_FE_theta__G_y;
    lin->lu[101] = u_FE_theta__G_y_i;
    const Lanes factor_85 = -l_E3_x__OF_theta*u_OF_theta__FE_theta + l_E3_x__OF_theta_3_i*u_OF_theta__FE_theta_i
        + n_E3_x__FE_theta;
    const Lanes factor_86 = -l_E3_x__OF_theta*u_OF_theta__FE_theta_i - l_E3_x__OF_theta_3_i*u_OF_theta__FE_theta
        + n_E3_x__FE_theta_i;
    const Lanes l_E3_x__FE_theta = factor_85*inverse_pivot_FE_theta - factor_86*inverse_pivot_FE_theta_3_i;
    const Lanes l_E3_x__FE_theta_3_i = factor_85*inverse_pivot_FE_theta_3_i + factor_86*inverse_pivot_FE_theta;
    lin->lu[102] = l_E3_x__FE_theta;
    lin->lu[103] = l_E3_x__FE_theta_3_i;
    const Lanes u_FE_theta__E3_x = -l_FE_theta__OF_theta*phi_G_x_OF_theta + phi_G_x_FE_theta;
    const Lanes u_FE_theta__E3_x_i = -l_FE_theta__OF_theta_i*phi_G_x_OF_theta;
    lin->lu[104] = u_FE_theta__E3_x;
    lin->lu[105] = u_FE_theta__E3_x_i;
    const Lanes factor_87 = -l_E3_y__OF_theta*u_OF_theta__FE_theta + l_E3_y__OF_theta_3_i*u_OF_theta__FE_theta_i
        + n_E3_y__FE_theta;
    const Lanes factor_88 = -l_E3_y__OF_theta*u_OF_theta__FE_theta_i - l_E3_y__OF_theta_3_i*u_OF_theta__FE_theta
        + n_E3_y__FE_theta_i;
    const Lanes l_E3_y__FE_theta = factor_87*inverse_pivot_FE_theta - factor_88*inverse_pivot_FE_theta_3_i;
    const Lanes l_E3_y__FE_theta_3_i = factor_87*inverse_pivot_FE_theta_3_i + factor_88*inverse_pivot_FE_theta;
    lin->lu[106] = l_E3_y__FE_theta;
    lin->lu[107] = l_E3_y__FE_theta_3_i;
    const Lanes u_FE_theta__E3_y = -l_FE_theta__OF_theta*phi_G_y_OF_theta + phi_G_y_FE_theta;
    const Lanes u_FE_theta__E3_y_i = -l_FE_theta__OF_theta_i*phi_G_y_OF_theta;
    lin->lu[108] = u_FE_theta__E3_y;
    lin->lu[109] = u_FE_theta__E3_y_i;
    const Lanes scale_G_x = -l_G_x__AG_theta*phi_G_x_AG_theta - l_G_x__EG_theta*phi_G_x_EG_theta
        - l_G_x__FE_theta*u_FE_theta__G_x + l_G_x__FE_theta_2_i*u_FE_theta__G_x_i - l_G_x__OF_theta*u_OF_theta__G_x
        + l_G_x__OF_theta_2_i*u_OF_theta__G_x_i;
    const Lanes scale_G_x_3_i = -l_G_x__AG_theta_3_i*phi_G_x_AG_theta - l_G_x__EG_theta_3_i*phi_G_x_EG_theta
        - l_G_x__FE_theta*u_FE_theta__G_x_i - l_G_x__FE_theta_2_i*u_FE_theta__G_x - l_G_x__OF_theta*u_OF_theta__G_x_i
        - l_G_x__OF_theta_2_i*u_OF_theta__G_x;
    const Lanes size_18 = lanes_fabs(scale_G_x) + lanes_fabs(scale_G_x_3_i);
    *rare |= ~((size_18 > 0.0) & (size_18 < INFINITY));
    const Lanes divisor_13 = 1.0/((scale_G_x * scale_G_x) + (scale_G_x_3_i * scale_G_x_3_i));
    const Lanes inverse_pivot_G_x = divisor_13*scale_G_x;
    const Lanes inverse_pivot_G_x_3_i = -divisor_13*scale_G_x_3_i;
    lin->lu[110] = inverse_pivot_G_x;
    lin->lu[111] = inverse_pivot_G_x_3_i;
    const Lanes factor_89 = -l_G_y__AG_theta*phi_G_x_AG_theta - l_G_y__EG_theta*phi_G_x_EG_theta
        - l_G_y__FE_theta*u_FE_theta__G_x + l_G_y__FE_theta_2_i*u_FE_theta__G_x_i - l_G_y__OF_theta*u_OF_theta__G_x
        + l_G_y__OF_theta_2_i*u_OF_theta__G_x_i;
    const Lanes factor_90 = -l_G_y__AG_theta_3_i*phi_G_x_AG_theta - l_G_y__EG_theta_3_i*phi_G_x_EG_theta
        - l_G_y__FE_theta*u_FE_theta__G_x_i - l_G_y__FE_theta_2_i*u_FE_theta__G_x - l_G_y__OF_theta*u_OF_theta__G_x_i
        - l_G_y__OF_theta_2_i*u_OF_theta__G_x;
    const Lanes l_G_y__G_x = factor_89*inverse_pivot_G_x - factor_90*inverse_pivot_G_x_3_i;
    const Lanes l_G_y__G_x_i = factor_89*inverse_pivot_G_x_3_i + factor_90*inverse_pivot_G_x;
    lin->lu[112] = l_G_y__G_x;
    lin->lu[113] = l_G_y__G_x_i;
    const Lanes u_G_x__G_y = -l_G_x__AG_theta*phi_G_y_AG_theta - l_G_x__EG_theta*phi_G_y_EG_theta
        - l_G_x__FE_theta*u_FE_theta__G_y + l_G_x__FE_theta_2_i*u_FE_theta__G_y_i - l_G_x__OF_theta*u_OF_theta__G_y
        + l_G_x__OF_theta_2_i*u_OF_theta__G_y_i;
    const Lanes u_G_x__G_y_i = -l_G_x__AG_theta_3_i*phi_G_y_AG_theta - l_G_x__EG_theta_3_i*phi_G_y_EG_theta
        - l_G_x__FE_theta*u_FE_theta__G_y_i - l_G_x__FE_theta_2_i*u_FE_theta__G_y - l_G_x__OF_theta*u_OF_theta__G_y_i
        - l_G_x__OF_theta_2_i*u_OF_theta__G_y;
    lin->lu[114] = u_G_x__G_y;
    lin->lu[115] = u_G_x__G_y_i;
    const Lanes factor_91 = -l_E3_x__FE_theta*u_FE_theta__G_x + l_E3_x__FE_theta_3_i*u_FE_theta__G_x_i
        - l_E3_x__OF_theta*u_OF_theta__G_x + l_E3_x__OF_theta_3_i*u_OF_theta__G_x_i;
    const Lanes factor_92 = -l_E3_x__FE_theta*u_FE_theta__G_x_i - l_E3_x__FE_theta_3_i*u_FE_theta__G_x
        - l_E3_x__OF_theta*u_OF_theta__G_x_i - l_E3_x__OF_theta_3_i*u_OF_theta__G_x;
    const Lanes l_E3_x__G_x = factor_91*inverse_pivot_G_x - factor_92*inverse_pivot_G_x_3_i;
    const Lanes l_E3_x__G_x_2_i = factor_91*inverse_pivot_G_x_3_i + factor_92*inverse_pivot_G_x;
    lin->lu[116] = l_E3_x__G_x;
    lin->lu[117] = l_E3_x__G_x_2_i;
    const Lanes u_G_x__E3_x = -l_G_x__FE_theta*u_FE_theta__E3_x + l_G_x__FE_theta_2_i*u_FE_theta__E3_x_i
        - l_G_x__OF_theta*phi_G_x_OF_theta;
    const Lanes u_G_x__E3_x_i = -l_G_x__FE_theta*u_FE_theta__E3_x_i - l_G_x__FE_theta_2_i*u_FE_theta__E3_x
        - l_G_x__OF_theta_2_i*phi_G_x_OF_theta;
    lin->lu[118] = u_G_x__E3_x;
    lin->lu[119] = u_G_x__E3_x_i;
    const Lanes factor_93 = -l_E3_y__FE_theta*u_FE_theta__G_x + l_E3_y__FE_theta_3_i*u_FE_theta__G_x_i
        - l_E3_y__OF_theta*u_OF_theta__G_x + l_E3_y__OF_theta_3_i*u_OF_theta__G_x_i;
    const Lanes factor_94 = -l_E3_y__FE_theta*u_FE_theta__G_x_i - l_E3_y__FE_theta_3_i*u_FE_theta__G_x
        - l_E3_y__OF_theta*u_OF_theta__G_x_i - l_E3_y__OF_theta_3_i*u_OF_theta__G_x;
    const Lanes l_E3_y__G_x = factor_93*inverse_pivot_G_x - factor_94*inverse_pivot_G_x_3_i;
    const Lanes l_E3_y__G_x_2_i = factor_93*inverse_pivot_G_x_3_i + factor_94*inverse_pivot_G_x;
    lin->lu[120] = l_E3_y__G_x;
    lin->lu[121] = l_E3_y__G_x_2_i;
    const Lanes u_G_x__E3_y = -l_G_x__FE_theta*u_FE_theta__E3_y + l_G_x__FE_theta_2_i*u_FE_theta__E3_y_i
        - l_G_x__OF_theta*phi_G_y_OF_theta;
    const Lanes u_G_x__E3_y_i = -l_G_x__FE_theta*u_FE_theta__E3_y_i - l_G_x__FE_theta_2_i*u_FE_theta__E3_y
        - l_G_x__OF_theta_2_i*phi_G_y_OF_theta;
    lin->lu[122] = u_G_x__E3_y;
    lin->lu[123] = u_G_x__E3_y_i;
    const Lanes scale_G_y = -l_G_y__AG_theta*phi_G_y_AG_theta - l_G_y__EG_theta*phi_G_y_EG_theta
        - l_G_y__FE_theta*u_FE_theta__G_y + l_G_y__FE_theta_2_i*u_FE_theta__G_y_i - l_G_y__OF_theta*u_OF_theta__G_y
        + l_G_y__OF_theta_2_i*u_OF_theta__G_y_i;
    const Lanes scale_G_y_3_i = -l_G_y__AG_theta_3_i*phi_G_y_AG_theta - l_G_y__EG_theta_3_i*phi_G_y_EG_theta
        - l_G_y__FE_theta*u_FE_theta__G_y_i - l_G_y__FE_theta_2_i*u_FE_theta__G_y - l_G_y__OF_theta*u_OF_theta__G_y_i
        - l_G_y__OF_theta_2_i*u_OF_theta__G_y;
    const Lanes pivot_G_y = -l_G_y__G_x*u_G_x__G_y + l_G_y__G_x_i*u_G_x__G_y_i + scale_G_y;
    const Lanes pivot_G_y_i = -l_G_y__G_x*u_G_x__G_y_i - l_G_y__G_x_i*u_G_x__G_y + scale_G_y_3_i;
    const Lanes size_19 = lanes_fabs(pivot_G_y) + lanes_fabs(pivot_G_y_i);
    const Lanes size_20 = lanes_fabs(scale_G_y) + lanes_fabs(scale_G_y_3_i);
    *rare |= ~(size_19 > SINGULAR * size_20);
    const Lanes divisor_14 = 1.0/((pivot_G_y * pivot_G_y) + (pivot_G_y_i * pivot_G_y_i));
    const Lanes inverse_pivot_G_y = divisor_14*pivot_G_y;
    const Lanes inverse_pivot_G_y_3_i = -divisor_14*pivot_G_y_i;
    lin->lu[124] = inverse_pivot_G_y;
    lin->lu[125] = inverse_pivot_G_y_3_i;
    const Lanes factor_95 = -l_E3_x__FE_theta*u_FE_theta__G_y + l_E3_x__FE_theta_3_i*u_FE_theta__G_y_i
        - l_E3_x__G_x*u_G_x__G_y + l_E3_x__G_x_2_i*u_G_x__G_y_i - l_E3_x__OF_theta*u_OF_theta__G_y
        + l_E3_x__OF_theta_3_i*u_OF_theta__G_y_i;
    const Lanes factor_96 = -l_E3_x__FE_theta*u_FE_theta__G_y_i - l_E3_x__FE_theta_3_i*u_FE_theta__G_y
        - l_E3_x__G_x*u_G_x__G_y_i - l_E3_x__G_x_2_i*u_G_x__G_y - l_E3_x__OF_theta*u_OF_theta__G_y_i
        - l_E3_x__OF_theta_3_i*u_OF_theta__G_y;
    const Lanes l_E3_x__G_y = factor_95*inverse_pivot_G_y - factor_96*inverse_pivot_G_y_3_i;
    const Lanes l_E3_x__G_y_2_i = factor_95*inverse_pivot_G_y_3_i + factor_96*inverse_pivot_G_y;
    lin->lu[126] = l_E3_x__G_y;
    lin->lu[127] = l_E3_x__G_y_2_i;
    const Lanes u_G_y__E3_x = -l_G_y__FE_theta*u_FE_theta__E3_x + l_G_y__FE_theta_2_i*u_FE_theta__E3_x_i
        - l_G_y__G_x*u_G_x__E3_x + l_G_y__G_x_i*u_G_x__E3_x_i - l_G_y__OF_theta*phi_G_x_OF_theta;
    const Lanes u_G_y__E3_x_i = -l_G_y__FE_theta*u_FE_theta__E3_x_i - l_G_y__FE_theta_2_i*u_FE_theta__E3_x
        - l_G_y__G_x*u_G_x__E3_x_i - l_G_y__G_x_i*u_G_x__E3_x - l_G_y__OF_theta_2_i*phi_G_x_OF_theta;
    lin->lu[128] = u_G_y__E3_x;
    lin->lu[129] = u_G_y__E3_x_i;
    const Lanes factor_97 = -l_E3_y__FE_theta*u_FE_theta__G_y + l_E3_y__FE_theta_3_i*u_FE_theta__G_y_i
        - l_E3_y__G_x*u_G_x__G_y + l_E3_y__G_x_2_i*u_G_x__G_y_i - l_E3_y__OF_theta*u_OF_theta__G_y
        + l_E3_y__OF_theta_3_i*u_OF_theta__G_y_i;
    const Lanes factor_98 = -l_E3_y__FE_theta*u_FE_theta__G_y_i - l_E3_y__FE_theta_3_i*u_FE_theta__G_y
        - l_E3_y__G_x*u_G_x__G_y_i - l_E3_y__G_x_2_i*u_G_x__G_y - l_E3_y__OF_theta*u_OF_theta__G_y_i
        - l_E3_y__OF_theta_3_i*u_OF_theta__G_y;
    const Lanes l_E3_y__G_y = factor_97*inverse_pivot_G_y - factor_98*inverse_pivot_G_y_3_i;
    const Lanes l_E3_y__G_y_2_i = factor_97*inverse_pivot_G_y_3_i + factor_98*inverse_pivot_G_y;
    lin->lu[130] = l_E3_y__G_y;
    lin->lu[131] = l_E3_y__G_y_2_i;
    const Lanes u_G_y__E3_y = -l_G_y__FE_theta*u_FE_theta__E3_y + l_G_y__FE_theta_2_i*u_FE_theta__E3_y_i
        - l_G_y__G_x*u_G_x__E3_y + l_G_y__G_x_i*u_G_x__E3_y_i - l_G_y__OF_theta*phi_G_y_OF_theta;
    const Lanes u_G_y__E3_y_i = -l_G_y__FE_theta*u_FE_theta__E3_y_i - l_G_y__FE_theta_2_i*u_FE_theta__E3_y
        - l_G_y__G_x*u_G_x__E3_y_i - l_G_y__G_x_i*u_G_x__E3_y - l_G_y__OF_theta_2_i*phi_G_y_OF_theta;
    lin->lu[132] = u_G_y__E3_y;
    lin->lu[133] = u_G_y__E3_y_i;
    const Lanes scale_E3_x = l_E3_x__BDE_theta*phi_H_x_BDE_theta - l_E3_x__FE_theta*u_FE_theta__E3_x
        + l_E3_x__FE_theta_3_i*u_FE_theta__E3_x_i - l_E3_x__OF_theta*phi_G_x_OF_theta;
    const Lanes scale_E3_x_3_i = l_E3_x__BDE_theta_3_i*phi_H_x_BDE_theta - l_E3_x__FE_theta*u_FE_theta__E3_x_i
        - l_E3_x__FE_theta_3_i*u_FE_theta__E3_x - l_E3_x__OF_theta_3_i*phi_G_x_OF_theta;
    const Lanes pivot_E3_x = -l_E3_x__G_x*u_G_x__E3_x + l_E3_x__G_x_2_i*u_G_x__E3_x_i - l_E3_x__G_y*u_G_y__E3_x
        + l_E3_x__G_y_2_i*u_G_y__E3_x_i - l_E3_x__H_x*u_H_x__E3_x + l_E3_x__H_x_2_i*u_H_x__E3_x_i
        - l_E3_x__H_y*u_H_y__E3_x + l_E3_x__H_y_2_i*u_H_y__E3_x_i + scale_E3_x;
    const Lanes pivot_E3_x_2_i = -l_E3_x__G_x*u_G_x__E3_x_i - l_E3_x__G_x_2_i*u_G_x__E3_x - l_E3_x__G_y*u_G_y__E3_x_i
        - l_E3_x__G_y_2_i*u_G_y__E3_x - l_E3_x__H_x*u_H_x__E3_x_i - l_E3_x__H_x_2_i*u_H_x__E3_x
        - l_E3_x__H_y*u_H_y__E3_x_i - l_E3_x__H_y_2_i*u_H_y__E3_x + scale_E3_x_3_i;
    const Lanes size_21 = lanes_fabs(pivot_E3_x) + lanes_fabs(pivot_E3_x_2_i);
    const Lanes size_22 = lanes_fabs(scale_E3_x) + lanes_fabs(scale_E3_x_3_i);
    *rare |= ~(size_21 > SINGULAR * size_22);
    const Lanes divisor_15 = 1.0/((pivot_E3_x * pivot_E3_x) + (pivot_E3_x_2_i * pivot_E3_x_2_i));
    const Lanes inverse_pivot_E3_x = divisor_15*pivot_E3_x;
    const Lanes inverse_pivot_E3_x_3_i = -divisor_15*pivot_E3_x_2_i;
    lin->lu[134] = inverse_pivot_E3_x;
    lin->lu[135] = inverse_pivot_E3_x_3_i;
    const Lanes factor_99 = l_E3_y__BDE_theta*phi_H_x_BDE_theta - l_E3_y__FE_theta*u_FE_theta__E3_x
        + l_E3_y__FE_theta_3_i*u_FE_theta__E3_x_i - l_E3_y__G_x*u_G_x__E3_x + l_E3_y__G_x_2_i*u_G_x__E3_x_i
        - l_E3_y__G_y*u_G_y__E3_x + l_E3_y__G_y_2_i*u_G_y__E3_x_i - l_E3_y__H_x*u_H_x__E3_x
        + l_E3_y__H_x_2_i*u_H_x__E3_x_i - l_E3_y__H_y*u_H_y__E3_x + l_E3_y__H_y_2_i*u_H_y__E3_x_i
        - l_E3_y__OF_theta*phi_G_x_OF_theta;
    const Lanes factor_100 = l_E3_y__BDE_theta_3_i*phi_H_x_BDE_theta - l_E3_y__FE_theta*u_FE_theta__E3_x_i
        - l_E3_y__FE_theta_3_i*u_FE_theta__E3_x - l_E3_y__G_x*u_G_x__E3_x_i - l_E3_y__G_x_2_i*u_G_x__E3_x
        - l_E3_y__G_y*u_G_y__E3_x_i - l_E3_y__G_y_2_i*u_G_y__E3_x - l_E3_y__H_x*u_H_x__E3_x_i
        - l_E3_y__H_x_2_i*u_H_x__E3_x - l_E3_y__H_y*u_H_y__E3_x_i - l_E3_y__H_y_2_i*u_H_y__E3_x
        - l_E3_y__OF_theta_3_i*phi_G_x_OF_theta;
    const Lanes l_E3_y__E3_x = -factor_100*inverse_pivot_E3_x_3_i + factor_99*inverse_pivot_E3_x;
    const Lanes l_E3_y__E3_x_i = factor_100*inverse_pivot_E3_x + factor_99*inverse_pivot_E3_x_3_i;
    lin->lu[136] = l_E3_y__E3_x;
    lin->lu[137] = l_E3_y__E3_x_i;
    const Lanes u_E3_x__E3_y = l_E3_x__BDE_theta*phi_H_y_BDE_theta - l_E3_x__FE_theta*u_FE_theta__E3_y
        + l_E3_x__FE_theta_3_i*u_FE_theta__E3_y_i - l_E3_x__G_x*u_G_x__E3_y + l_E3_x__G_x_2_i*u_G_x__E3_y_i
        - l_E3_x__G_y*u_G_y__E3_y + l_E3_x__G_y_2_i*u_G_y__E3_y_i - l_E3_x__H_x*u_H_x__E3_y
        + l_E3_x__H_x_2_i*u_H_x__E3_y_i - l_E3_x__H_y*u_H_y__E3_y + l_E3_x__H_y_2_i*u_H_y__E3_y_i
        - l_E3_x__OF_theta*phi_G_y_OF_theta;
    const Lanes u_E3_x__E3_y_i = l_E3_x__BDE_theta_3_i*phi_H_y_BDE_theta - l_E3_x__FE_theta*u_FE_theta__E3_y_i
        - l_E3_x__FE_theta_3_i*u_FE_theta__E3_y - l_E3_x__G_x*u_G_x__E3_y_i - l_E3_x__G_x_2_i*u_G_x__E3_y
        - l_E3_x__G_y*u_G_y__E3_y_i - l_E3_x__G_y_2_i*u_G_y__E3_y - l_E3_x__H_x*u_H_x__E3_y_i
        - l_E3_x__H_x_2_i*u_H_x__E3_y - l_E3_x__H_y*u_H_y__E3_y_i - l_E3_x__H_y_2_i*u_H_y__E3_y
        - l_E3_x__OF_theta_3_i*phi_G_y_OF_theta;
    lin->lu[138] = u_E3_x__E3_y;
    lin->lu[139] = u_E3_x__E3_y_i;
    const Lanes scale_E3_y = l_E3_y__BDE_theta*phi_H_y_BDE_theta - l_E3_y__FE_theta*u_FE_theta__E3_y
        + l_E3_y__FE_theta_3_i*u_FE_theta__E3_y_i - l_E3_y__OF_theta*phi_G_y_OF_theta;
    const Lanes scale_E3_y_3_i = l_E3_y__BDE_theta_3_i*phi_H_y_BDE_theta - l_E3_y__FE_theta*u_FE_theta__E3_y_i
        - l_E3_y__FE_theta_3_i*u_FE_theta__E3_y - l_E3_y__OF_theta_3_i*phi_G_y_OF_theta;
    const Lanes pivot_E3_y = -l_E3_y__E3_x*u_E3_x__E3_y + l_E3_y__E3_x_i*u_E3_x__E3_y_i - l_E3_y__G_x*u_G_x__E3_y
        + l_E3_y__G_x_2_i*u_G_x__E3_y_i - l_E3_y__G_y*u_G_y__E3_y + l_E3_y__G_y_2_i*u_G_y__E3_y_i
        - l_E3_y__H_x*u_H_x__E3_y + l_E3_y__H_x_2_i*u_H_x__E3_y_i - l_E3_y__H_y*u_H_y__E3_y
        + l_E3_y__H_y_2_i*u_H_y__E3_y_i + scale_E3_y;
    const Lanes pivot_E3_y_2_i = -l_E3_y__E3_x*u_E3_x__E3_y_i - l_E3_y__E3_x_i*u_E3_x__E3_y - l_E3_y__G_x*u_G_x__E3_y_i
        - l_E3_y__G_x_2_i*u_G_x__E3_y - l_E3_y__G_y*u_G_y__E3_y_i - l_E3_y__G_y_2_i*u_G_y__E3_y
        - l_E3_y__H_x*u_H_x__E3_y_i - l_E3_y__H_x_2_i*u_H_x__E3_y - l_E3_y__H_y*u_H_y__E3_y_i
        - l_E3_y__H_y_2_i*u_H_y__E3_y + scale_E3_y_3_i;
    const Lanes size_23 = lanes_fabs(pivot_E3_y) + lanes_fabs(pivot_E3_y_2_i);
    const Lanes size_24 = lanes_fabs(scale_E3_y) + lanes_fabs(scale_E3_y_3_i);
    *rare |= ~(size_23 > SINGULAR * size_24);
    const Lanes divisor_16 = 1.0/((pivot_E3_y * pivot_E3_y) + (pivot_E3_y_2_i * pivot_E3_y_2_i));
    const Lanes inverse_pivot_E3_y = divisor_16*pivot_E3_y;
    const Lanes inverse_pivot_E3_y_3_i = -divisor_16*pivot_E3_y_2_i;
    lin->lu[140] = inverse_pivot_E3_y;
    lin->lu[141] = inverse_pivot_E3_y_3_i;
}

/*
 * x (all nodes) holds b and becomes the solution of N x = b.
 * At complex eta: real and imaginary parts one behind the other.
 */
static void newton_substitute_complex(const LaneComplexLinear *lin, Lanes *x)
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
    const Lanes inverse_pivot_AG_theta_i = lin->lu[1];
    const Lanes l_G_x__AG_theta = lin->lu[2];
    const Lanes l_G_x__AG_theta_3_i = lin->lu[3];
    const Lanes l_G_y__AG_theta = lin->lu[4];
    const Lanes l_G_y__AG_theta_3_i = lin->lu[5];
    const Lanes inverse_pivot_AH_theta = lin->lu[6];
    const Lanes inverse_pivot_AH_theta_i = lin->lu[7];
    const Lanes l_H_x__AH_theta = lin->lu[8];
    const Lanes l_H_x__AH_theta_3_i = lin->lu[9];
    const Lanes l_H_y__AH_theta = lin->lu[10];
    const Lanes l_H_y__AH_theta_3_i = lin->lu[11];
    const Lanes inverse_pivot_HE_theta = lin->lu[12];
    const Lanes inverse_pivot_HE_theta_i = lin->lu[13];
    const Lanes l_BDE_theta__HE_theta = lin->lu[14];
    const Lanes l_BDE_theta__HE_theta_3_i = lin->lu[15];
    const Lanes n_HE_theta__BDE_theta = lin->lu[16];
    const Lanes n_HE_theta__BDE_theta_i = lin->lu[17];
    const Lanes l_H_x__HE_theta = lin->lu[18];
    const Lanes l_H_x__HE_theta_3_i = lin->lu[19];
    const Lanes l_H_y__HE_theta = lin->lu[20];
    const Lanes l_H_y__HE_theta_3_i = lin->lu[21];
    const Lanes inverse_pivot_BDE_theta = lin->lu[22];
    const Lanes inverse_pivot_BDE_theta_3_i = lin->lu[23];
    const Lanes l_H_x__BDE_theta = lin->lu[24];
    const Lanes l_H_x__BDE_theta_2_i = lin->lu[25];
    const Lanes u_BDE_theta__H_x = lin->lu[26];
    const Lanes u_BDE_theta__H_x_i = lin->lu[27];
    const Lanes l_H_y__BDE_theta = lin->lu[28];
    const Lanes l_H_y__BDE_theta_2_i = lin->lu[29];
    const Lanes u_BDE_theta__H_y = lin->lu[30];
    const Lanes u_BDE_theta__H_y_i = lin->lu[31];
    const Lanes l_E3_x__BDE_theta = lin->lu[32];
    const Lanes l_E3_x__BDE_theta_3_i = lin->lu[33];
    const Lanes l_E3_y__BDE_theta = lin->lu[34];
    const Lanes l_E3_y__BDE_theta_3_i = lin->lu[35];
    const Lanes inverse_pivot_H_x = lin->lu[36];
    const Lanes inverse_pivot_H_x_3_i = lin->lu[37];
    const Lanes l_H_y__H_x = lin->lu[38];
    const Lanes l_H_y__H_x_i = lin->lu[39];
    const Lanes u_H_x__H_y = lin->lu[40];
    const Lanes u_H_x__H_y_i = lin->lu[41];
    const Lanes l_E3_x__H_x = lin->lu[42];
    const Lanes l_E3_x__H_x_2_i = lin->lu[43];
    const Lanes u_H_x__E3_x = lin->lu[44];
    const Lanes u_H_x__E3_x_i = lin->lu[45];
    const Lanes l_E3_y__H_x = lin->lu[46];
    const Lanes l_E3_y__H_x_2_i = lin->lu[47];
    const Lanes u_H_x__E3_y = lin->lu[48];
    const Lanes u_H_x__E3_y_i = lin->lu[49];
    const Lanes inverse_pivot_H_y = lin->lu[50];
    const Lanes inverse_pivot_H_y_3_i = lin->lu[51];
    const Lanes l_E3_x__H_y = lin->lu[52];
    const Lanes l_E3_x__H_y_2_i = lin->lu[53];
    const Lanes u_H_y__E3_x = lin->lu[54];
    const Lanes u_H_y__E3_x_i = lin->lu[55];
    const Lanes l_E3_y__H_y = lin->lu[56];
    const Lanes l_E3_y__H_y_2_i = lin->lu[57];
    const Lanes u_H_y__E3_y = lin->lu[58];
    const Lanes u_H_y__E3_y_i = lin->lu[59];
    const Lanes inverse_pivot_EG_theta = lin->lu[60];
    const Lanes inverse_pivot_EG_theta_i = lin->lu[61];
    const Lanes l_OF_theta__EG_theta = lin->lu[62];
    const Lanes l_OF_theta__EG_theta_3_i = lin->lu[63];
    const Lanes n_EG_theta__OF_theta = lin->lu[64];
    const Lanes n_EG_theta__OF_theta_i = lin->lu[65];
    const Lanes l_FE_theta__EG_theta = lin->lu[66];
    const Lanes l_FE_theta__EG_theta_3_i = lin->lu[67];
    const Lanes n_EG_theta__FE_theta = lin->lu[68];
    const Lanes n_EG_theta__FE_theta_i = lin->lu[69];
    const Lanes l_G_x__EG_theta = lin->lu[70];
    const Lanes l_G_x__EG_theta_3_i = lin->lu[71];
    const Lanes l_G_y__EG_theta = lin->lu[72];
    const Lanes l_G_y__EG_theta_3_i = lin->lu[73];
    const Lanes inverse_pivot_OF_theta = lin->lu[74];
    const Lanes inverse_pivot_OF_theta_3_i = lin->lu[75];
    const Lanes l_FE_theta__OF_theta = lin->lu[76];
    const Lanes l_FE_theta__OF_theta_i = lin->lu[77];
    const Lanes u_OF_theta__FE_theta = lin->lu[78];
    const Lanes u_OF_theta__FE_theta_i = lin->lu[79];
    const Lanes l_G_x__OF_theta = lin->lu[80];
    const Lanes l_G_x__OF_theta_2_i = lin->lu[81];
    const Lanes u_OF_theta__G_x = lin->lu[82];
    const Lanes u_OF_theta__G_x_i = lin->lu[83];
    const Lanes l_G_y__OF_theta = lin->lu[84];
    const Lanes l_G_y__OF_theta_2_i = lin->lu[85];
    const Lanes u_OF_theta__G_y = lin->lu[86];
    const Lanes u_OF_theta__G_y_i = lin->lu[87];
    const Lanes l_E3_x__OF_theta = lin->lu[88];
    const Lanes l_E3_x__OF_theta_3_i = lin->lu[89];
    const Lanes l_E3_y__OF_theta = lin->lu[90];
    const Lanes l_E3_y__OF_theta_3_i = lin->lu[91];
    const Lanes inverse_pivot_FE_theta = lin->lu[92];
    const Lanes inverse_pivot_FE_theta_3_i = lin->lu[93];
    const Lanes l_G_x__FE_theta = lin->lu[94];
    const Lanes l_G_x__FE_theta_2_i = lin->lu[95];
    const Lanes u_FE_theta__G_x = lin->lu[96];
    const Lanes u_FE_theta__G_x_i = lin->lu[97];
    const Lanes l_G_y__FE_theta = lin->lu[98];
    const Lanes l_G_y__FE_theta_2_i = lin->lu[99];
    const Lanes u_FE_theta__G_y = lin->lu[100];
    const Lanes u_FE_theta__G_y_i = lin->lu[101];
    const Lanes l_E3_x__FE_theta = lin->lu[102];
    const Lanes l_E3_x__FE_theta_3_i = lin->lu[103];
    const Lanes u_FE_theta__E3_x = lin->lu[104];
    const Lanes u_FE_theta__E3_x_i = lin->lu[105];
    const Lanes l_E3_y__FE_theta = lin->lu[106];
    const Lanes l_E3_y__FE_theta_3_i = lin->lu[107];
    const Lanes u_FE_theta__E3_y = lin->lu[108];
    const Lanes u_FE_theta__E3_y_i = lin->lu[109];
    const Lanes inverse_pivot_G_x = lin->lu[110];
    const Lanes inverse_pivot_G_x_3_i = lin->lu[111];
    const Lanes l_G_y__G_x = lin->lu[112];
    const Lanes l_G_y__G_x_i = lin->lu[113];
    const Lanes u_G_x__G_y = lin->lu[114];
    const Lanes u_G_x__G_y_i = lin->lu[115];
    const Lanes l_E3_x__G_x = lin->lu[116];
    const Lanes l_E3_x__G_x_2_i = lin->lu[117];
    const Lanes u_G_x__E3_x = lin->lu[118];
    const Lanes u_G_x__E3_x_i = lin->lu[119];
    const Lanes l_E3_y__G_x = lin->lu[120];
    const Lanes l_E3_y__G_x_2_i = lin->lu[121];
    const Lanes u_G_x__E3_y = lin->lu[122];
    const Lanes u_G_x__E3_y_i = lin->lu[123];
    const Lanes inverse_pivot_G_y = lin->lu[124];
    const Lanes inverse_pivot_G_y_3_i = lin->lu[125];
    const Lanes l_E3_x__G_y = lin->lu[126];
    const Lanes l_E3_x__G_y_2_i = lin->lu[127];
    const Lanes u_G_y__E3_x = lin->lu[128];
    const Lanes u_G_y__E3_x_i = lin->lu[129];
    const Lanes l_E3_y__G_y = lin->lu[130];
    const Lanes l_E3_y__G_y_2_i = lin->lu[131];
    const Lanes u_G_y__E3_y = lin->lu[132];
    const Lanes u_G_y__E3_y_i = lin->lu[133];
    const Lanes inverse_pivot_E3_x = lin->lu[134];
    const Lanes inverse_pivot_E3_x_3_i = lin->lu[135];
    const Lanes l_E3_y__E3_x = lin->lu[136];
    const Lanes l_E3_y__E3_x_i = lin->lu[137];
    const Lanes u_E3_x__E3_y = lin->lu[138];
    const Lanes u_E3_x__E3_y_i = lin->lu[139];
    const Lanes inverse_pivot_E3_y = lin->lu[140];
    const Lanes inverse_pivot_E3_y_3_i = lin->lu[141];

    /* forward */
    const Lanes b_AG_theta = x[4];
    const Lanes b_AG_theta_i = x[5];
    const Lanes b_AH_theta = x[6];
    const Lanes b_AH_theta_i = x[7];
    const Lanes b_HE_theta = x[10];
    const Lanes b_HE_theta_i = x[11];
    const Lanes b_BDE_theta = -b_HE_theta*l_BDE_theta__HE_theta + b_HE_theta_i*l_BDE_theta__HE_theta_3_i + x[2];
    const Lanes b_BDE_theta_i = -b_HE_theta*l_BDE_theta__HE_theta_3_i - b_HE_theta_i*l_BDE_theta__HE_theta + x[3];
    const Lanes b_H_x = -b_AH_theta*l_H_x__AH_theta + b_AH_theta_i*l_H_x__AH_theta_3_i - b_BDE_theta*l_H_x__BDE_theta
        + b_BDE_theta_i*l_H_x__BDE_theta_2_i - b_HE_theta*l_H_x__HE_theta + b_HE_theta_i*l_H_x__HE_theta_3_i + x[18];
    const Lanes b_H_x_i = -b_AH_theta*l_H_x__AH_theta_3_i - b_AH_theta_i*l_H_x__AH_theta
        - b_BDE_theta*l_H_x__BDE_theta_2_i - b_BDE_theta_i*l_H_x__BDE_theta - b_HE_theta*l_H_x__HE_theta_3_i
        - b_HE_theta_i*l_H_x__HE_theta + x[19];
    const Lanes b_H_y = -b_AH_theta*l_H_y__AH_theta + b_AH_theta_i*l_H_y__AH_theta_3_i - b_BDE_theta*l_H_y__BDE_theta
        + b_BDE_theta_i*l_H_y__BDE_theta_2_i - b_HE_theta*l_H_y__HE_theta + b_HE_theta_i*l_H_y__HE_theta_3_i
        - b_H_x*l_H_y__H_x + b_H_x_i*l_H_y__H_x_i + x[20];
    const Lanes b_H_y_i = -b_AH_theta*l_H_y__AH_theta_3_i - b_AH_theta_i*l_H_y__AH_theta
        - b_BDE_theta*l_H_y__BDE_theta_2_i - b_BDE_theta_i*l_H_y__BDE_theta - b_HE_theta*l_H_y__HE_theta_3_i
        - b_HE_theta_i*l_H_y__HE_theta - b_H_x*l_H_y__H_x_i - b_H_x_i*l_H_y__H_x + x[21];
    const Lanes b_EG_theta = x[12];
    const Lanes b_EG_theta_i = x[13];
    const Lanes b_OF_theta = -b_EG_theta*l_OF_theta__EG_theta + b_EG_theta_i*l_OF_theta__EG_theta_3_i + x[0];
    const Lanes b_OF_theta_i = -b_EG_theta*l_OF_theta__EG_theta_3_i - b_EG_theta_i*l_OF_theta__EG_theta + x[1];
    const Lanes b_FE_theta = -b_EG_theta*l_FE_theta__EG_theta + b_EG_theta_i*l_FE_theta__EG_theta_3_i
        - b_OF_theta*l_FE_theta__OF_theta + b_OF_theta_i*l_FE_theta__OF_theta_i + x[8];
    const Lanes b_FE_theta_i = -b_EG_theta*l_FE_theta__EG_theta_3_i - b_EG_theta_i*l_FE_theta__EG_theta
        - b_OF_theta*l_FE_theta__OF_theta_i - b_OF_theta_i*l_FE_theta__OF_theta + x[9];
    const Lanes b_G_x = -b_AG_theta*l_G_x__AG_theta + b_AG_theta_i*l_G_x__AG_theta_3_i - b_EG_theta*l_G_x__EG_theta
        + b_EG_theta_i*l_G_x__EG_theta_3_i - b_FE_theta*l_G_x__FE_theta + b_FE_theta_i*l_G_x__FE_theta_2_i
        - b_OF_theta*l_G_x__OF_theta + b_OF_theta_i*l_G_x__OF_theta_2_i + x[14];
    const Lanes b_G_x_i = -b_AG_theta*l_G_x__AG_theta_3_i - b_AG_theta_i*l_G_x__AG_theta
        - b_EG_theta*l_G_x__EG_theta_3_i - b_EG_theta_i*l_G_x__EG_theta - b_FE_theta*l_G_x__FE_theta_2_i
        - b_FE_theta_i*l_G_x__FE_theta - b_OF_theta*l_G_x__OF_theta_2_i - b_OF_theta_i*l_G_x__OF_theta + x[15];
    const Lanes b_G_y = -b_AG_theta*l_G_y__AG_theta + b_AG_theta_i*l_G_y__AG_theta_3_i - b_EG_theta*l_G_y__EG_theta
        + b_EG_theta_i*l_G_y__EG_theta_3_i - b_FE_theta*l_G_y__FE_theta + b_FE_theta_i*l_G_y__FE_theta_2_i
        - b_G_x*l_G_y__G_x + b_G_x_i*l_G_y__G_x_i - b_OF_theta*l_G_y__OF_theta + b_OF_theta_i*l_G_y__OF_theta_2_i
        + x[16];
    const Lanes b_G_y_i = -b_AG_theta*l_G_y__AG_theta_3_i - b_AG_theta_i*l_G_y__AG_theta
        - b_EG_theta*l_G_y__EG_theta_3_i - b_EG_theta_i*l_G_y__EG_theta - b_FE_theta*l_G_y__FE_theta_2_i
        - b_FE_theta_i*l_G_y__FE_theta - b_G_x*l_G_y__G_x_i - b_G_x_i*l_G_y__G_x - b_OF_theta*l_G_y__OF_theta_2_i
        - b_OF_theta_i*l_G_y__OF_theta + x[17];
    const Lanes b_E3_x = -b_BDE_theta*l_E3_x__BDE_theta + b_BDE_theta_i*l_E3_x__BDE_theta_3_i
        - b_FE_theta*l_E3_x__FE_theta + b_FE_theta_i*l_E3_x__FE_theta_3_i - b_G_x*l_E3_x__G_x + b_G_x_i*l_E3_x__G_x_2_i
        - b_G_y*l_E3_x__G_y + b_G_y_i*l_E3_x__G_y_2_i - b_H_x*l_E3_x__H_x + b_H_x_i*l_E3_x__H_x_2_i - b_H_y*l_E3_x__H_y
        + b_H_y_i*l_E3_x__H_y_2_i - b_OF_theta*l_E3_x__OF_theta + b_OF_theta_i*l_E3_x__OF_theta_3_i + x[22];
    const Lanes b_E3_x_i = -b_BDE_theta*l_E3_x__BDE_theta_3_i - b_BDE_theta_i*l_E3_x__BDE_theta
        - b_FE_theta*l_E3_x__FE_theta_3_i - b_FE_theta_i*l_E3_x__FE_theta - b_G_x*l_E3_x__G_x_2_i - b_G_x_i*l_E3_x__G_x
        - b_G_y*l_E3_x__G_y_2_i - b_G_y_i*l_E3_x__G_y - b_H_x*l_E3_x__H_x_2_i - b_H_x_i*l_E3_x__H_x
        - b_H_y*l_E3_x__H_y_2_i - b_H_y_i*l_E3_x__H_y - b_OF_theta*l_E3_x__OF_theta_3_i - b_OF_theta_i*l_E3_x__OF_theta
        + x[23];
    const Lanes b_E3_y = -b_BDE_theta*l_E3_y__BDE_theta + b_BDE_theta_i*l_E3_y__BDE_theta_3_i - b_E3_x*l_E3_y__E3_x
        + b_E3_x_i*l_E3_y__E3_x_i - b_FE_theta*l_E3_y__FE_theta + b_FE_theta_i*l_E3_y__FE_theta_3_i - b_G_x*l_E3_y__G_x
        + b_G_x_i*l_E3_y__G_x_2_i - b_G_y*l_E3_y__G_y + b_G_y_i*l_E3_y__G_y_2_i - b_H_x*l_E3_y__H_x
        + b_H_x_i*l_E3_y__H_x_2_i - b_H_y*l_E3_y__H_y + b_H_y_i*l_E3_y__H_y_2_i - b_OF_theta*l_E3_y__OF_theta
        + b_OF_theta_i*l_E3_y__OF_theta_3_i + x[24];
    const Lanes b_E3_y_i = -b_BDE_theta*l_E3_y__BDE_theta_3_i - b_BDE_theta_i*l_E3_y__BDE_theta - b_E3_x*l_E3_y__E3_x_i
        - b_E3_x_i*l_E3_y__E3_x - b_FE_theta*l_E3_y__FE_theta_3_i - b_FE_theta_i*l_E3_y__FE_theta
        - b_G_x*l_E3_y__G_x_2_i - b_G_x_i*l_E3_y__G_x - b_G_y*l_E3_y__G_y_2_i - b_G_y_i*l_E3_y__G_y
        - b_H_x*l_E3_y__H_x_2_i - b_H_x_i*l_E3_y__H_x - b_H_y*l_E3_y__H_y_2_i - b_H_y_i*l_E3_y__H_y
        - b_OF_theta*l_E3_y__OF_theta_3_i - b_OF_theta_i*l_E3_y__OF_theta + x[25];

    /* backward */
    const Lanes x_E3_y = b_E3_y*inverse_pivot_E3_y - b_E3_y_i*inverse_pivot_E3_y_3_i;
    const Lanes x_E3_y_i = b_E3_y*inverse_pivot_E3_y_3_i + b_E3_y_i*inverse_pivot_E3_y;
    x[24] = x_E3_y;
    x[25] = x_E3_y_i;
    const Lanes factor_1 = b_E3_x - u_E3_x__E3_y*x_E3_y + u_E3_x__E3_y_i*x_E3_y_i;
    const Lanes factor_2 = b_E3_x_i - u_E3_x__E3_y*x_E3_y_i - u_E3_x__E3_y_i*x_E3_y;
    const Lanes x_E3_x = factor_1*inverse_pivot_E3_x - factor_2*inverse_pivot_E3_x_3_i;
    const Lanes x_E3_x_i = factor_1*inverse_pivot_E3_x_3_i + factor_2*inverse_pivot_E3_x;
    x[22] = x_E3_x;
    x[23] = x_E3_x_i;
    const Lanes factor_3 = b_G_y - u_G_y__E3_x*x_E3_x + u_G_y__E3_x_i*x_E3_x_i - u_G_y__E3_y*x_E3_y
        + u_G_y__E3_y_i*x_E3_y_i;
    const Lanes factor_4 = b_G_y_i - u_G_y__E3_x*x_E3_x_i - u_G_y__E3_x_i*x_E3_x - u_G_y__E3_y*x_E3_y_i
        - u_G_y__E3_y_i*x_E3_y;
    const Lanes x_G_y = factor_3*inverse_pivot_G_y - factor_4*inverse_pivot_G_y_3_i;
    const Lanes x_G_y_i = factor_3*inverse_pivot_G_y_3_i + factor_4*inverse_pivot_G_y;
    x[16] = x_G_y;
    x[17] = x_G_y_i;
    const Lanes factor_5 = b_G_x - u_G_x__E3_x*x_E3_x + u_G_x__E3_x_i*x_E3_x_i - u_G_x__E3_y*x_E3_y
        + u_G_x__E3_y_i*x_E3_y_i - u_G_x__G_y*x_G_y + u_G_x__G_y_i*x_G_y_i;
    const Lanes factor_6 = b_G_x_i - u_G_x__E3_x*x_E3_x_i - u_G_x__E3_x_i*x_E3_x - u_G_x__E3_y*x_E3_y_i
        - u_G_x__E3_y_i*x_E3_y - u_G_x__G_y*x_G_y_i - u_G_x__G_y_i*x_G_y;
    const Lanes x_G_x = factor_5*inverse_pivot_G_x - factor_6*inverse_pivot_G_x_3_i;
    const Lanes x_G_x_i = factor_5*inverse_pivot_G_x_3_i + factor_6*inverse_pivot_G_x;
    x[14] = x_G_x;
    x[15] = x_G_x_i;
    const Lanes factor_7 = b_FE_theta - u_FE_theta__E3_x*x_E3_x + u_FE_theta__E3_x_i*x_E3_x_i - u_FE_theta__E3_y*x_E3_y
        + u_FE_theta__E3_y_i*x_E3_y_i - u_FE_theta__G_x*x_G_x + u_FE_theta__G_x_i*x_G_x_i - u_FE_theta__G_y*x_G_y
        + u_FE_theta__G_y_i*x_G_y_i;
    const Lanes factor_8 = b_FE_theta_i - u_FE_theta__E3_x*x_E3_x_i - u_FE_theta__E3_x_i*x_E3_x
        - u_FE_theta__E3_y*x_E3_y_i - u_FE_theta__E3_y_i*x_E3_y - u_FE_theta__G_x*x_G_x_i - u_FE_theta__G_x_i*x_G_x
        - u_FE_theta__G_y*x_G_y_i - u_FE_theta__G_y_i*x_G_y;
    const Lanes x_FE_theta = factor_7*inverse_pivot_FE_theta - factor_8*inverse_pivot_FE_theta_3_i;
    const Lanes x_FE_theta_i = factor_7*inverse_pivot_FE_theta_3_i + factor_8*inverse_pivot_FE_theta;
    x[8] = x_FE_theta;
    x[9] = x_FE_theta_i;
    const Lanes factor_9 = b_OF_theta - phi_G_x_OF_theta*x_E3_x - phi_G_y_OF_theta*x_E3_y
        - u_OF_theta__FE_theta*x_FE_theta + u_OF_theta__FE_theta_i*x_FE_theta_i - u_OF_theta__G_x*x_G_x
        + u_OF_theta__G_x_i*x_G_x_i - u_OF_theta__G_y*x_G_y + u_OF_theta__G_y_i*x_G_y_i;
    const Lanes factor_10 = b_OF_theta_i - phi_G_x_OF_theta*x_E3_x_i - phi_G_y_OF_theta*x_E3_y_i
        - u_OF_theta__FE_theta*x_FE_theta_i - u_OF_theta__FE_theta_i*x_FE_theta - u_OF_theta__G_x*x_G_x_i
        - u_OF_theta__G_x_i*x_G_x - u_OF_theta__G_y*x_G_y_i - u_OF_theta__G_y_i*x_G_y;
    const Lanes x_OF_theta = -factor_10*inverse_pivot_OF_theta_3_i + factor_9*inverse_pivot_OF_theta;
    const Lanes x_OF_theta_i = factor_10*inverse_pivot_OF_theta + factor_9*inverse_pivot_OF_theta_3_i;
    x[0] = x_OF_theta;
    x[1] = x_OF_theta_i;
    const Lanes factor_11 = b_EG_theta - n_EG_theta__FE_theta*x_FE_theta + n_EG_theta__FE_theta_i*x_FE_theta_i
        - n_EG_theta__OF_theta*x_OF_theta + n_EG_theta__OF_theta_i*x_OF_theta_i - phi_G_x_EG_theta*x_G_x
        - phi_G_y_EG_theta*x_G_y;
    const Lanes factor_12 = b_EG_theta_i - n_EG_theta__FE_theta*x_FE_theta_i - n_EG_theta__FE_theta_i*x_FE_theta
        - n_EG_theta__OF_theta*x_OF_theta_i - n_EG_theta__OF_theta_i*x_OF_theta - phi_G_x_EG_theta*x_G_x_i
        - phi_G_y_EG_theta*x_G_y_i;
    const Lanes x_EG_theta = factor_11*inverse_pivot_EG_theta - factor_12*inverse_pivot_EG_theta_i;
    const Lanes x_EG_theta_i = factor_11*inverse_pivot_EG_theta_i + factor_12*inverse_pivot_EG_theta;
    x[12] = x_EG_theta;
    x[13] = x_EG_theta_i;
    const Lanes factor_13 = b_H_y - u_H_y__E3_x*x_E3_x + u_H_y__E3_x_i*x_E3_x_i - u_H_y__E3_y*x_E3_y
        + u_H_y__E3_y_i*x_E3_y_i;
    const Lanes factor_14 = b_H_y_i - u_H_y__E3_x*x_E3_x_i - u_H_y__E3_x_i*x_E3_x - u_H_y__E3_y*x_E3_y_i
        - u_H_y__E3_y_i*x_E3_y;
    const Lanes x_H_y = factor_13*inverse_pivot_H_y - factor_14*inverse_pivot_H_y_3_i;
    const Lanes x_H_y_i = factor_13*inverse_pivot_H_y_3_i + factor_14*inverse_pivot_H_y;
    x[20] = x_H_y;
    x[21] = x_H_y_i;
    const Lanes factor_15 = b_H_x - u_H_x__E3_x*x_E3_x + u_H_x__E3_x_i*x_E3_x_i - u_H_x__E3_y*x_E3_y
        + u_H_x__E3_y_i*x_E3_y_i - u_H_x__H_y*x_H_y + u_H_x__H_y_i*x_H_y_i;
    const Lanes factor_16 = b_H_x_i - u_H_x__E3_x*x_E3_x_i - u_H_x__E3_x_i*x_E3_x - u_H_x__E3_y*x_E3_y_i
        - u_H_x__E3_y_i*x_E3_y - u_H_x__H_y*x_H_y_i - u_H_x__H_y_i*x_H_y;
    const Lanes x_H_x = factor_15*inverse_pivot_H_x - factor_16*inverse_pivot_H_x_3_i;
    const Lanes x_H_x_i = factor_15*inverse_pivot_H_x_3_i + factor_16*inverse_pivot_H_x;
    x[18] = x_H_x;
    x[19] = x_H_x_i;
    const Lanes factor_17 = b_BDE_theta + phi_H_x_BDE_theta*x_E3_x + phi_H_y_BDE_theta*x_E3_y - u_BDE_theta__H_x*x_H_x
        + u_BDE_theta__H_x_i*x_H_x_i - u_BDE_theta__H_y*x_H_y + u_BDE_theta__H_y_i*x_H_y_i;
    const Lanes factor_18 = b_BDE_theta_i + phi_H_x_BDE_theta*x_E3_x_i + phi_H_y_BDE_theta*x_E3_y_i
        - u_BDE_theta__H_x*x_H_x_i - u_BDE_theta__H_x_i*x_H_x - u_BDE_theta__H_y*x_H_y_i - u_BDE_theta__H_y_i*x_H_y;
    const Lanes x_BDE_theta = factor_17*inverse_pivot_BDE_theta - factor_18*inverse_pivot_BDE_theta_3_i;
    const Lanes x_BDE_theta_i = factor_17*inverse_pivot_BDE_theta_3_i + factor_18*inverse_pivot_BDE_theta;
    x[2] = x_BDE_theta;
    x[3] = x_BDE_theta_i;
    const Lanes factor_19 = b_HE_theta - n_HE_theta__BDE_theta*x_BDE_theta + n_HE_theta__BDE_theta_i*x_BDE_theta_i
        - phi_H_x_HE_theta*x_H_x - phi_H_y_HE_theta*x_H_y;
    const Lanes factor_20 = b_HE_theta_i - n_HE_theta__BDE_theta*x_BDE_theta_i - n_HE_theta__BDE_theta_i*x_BDE_theta
        - phi_H_x_HE_theta*x_H_x_i - phi_H_y_HE_theta*x_H_y_i;
    const Lanes x_HE_theta = factor_19*inverse_pivot_HE_theta - factor_20*inverse_pivot_HE_theta_i;
    const Lanes x_HE_theta_i = factor_19*inverse_pivot_HE_theta_i + factor_20*inverse_pivot_HE_theta;
    x[10] = x_HE_theta;
    x[11] = x_HE_theta_i;
    const Lanes factor_21 = b_AH_theta - phi_H_x_AH_theta*x_H_x - phi_H_y_AH_theta*x_H_y;
    const Lanes factor_22 = b_AH_theta_i - phi_H_x_AH_theta*x_H_x_i - phi_H_y_AH_theta*x_H_y_i;
    const Lanes x_AH_theta = factor_21*inverse_pivot_AH_theta - factor_22*inverse_pivot_AH_theta_i;
    const Lanes x_AH_theta_i = factor_21*inverse_pivot_AH_theta_i + factor_22*inverse_pivot_AH_theta;
    x[6] = x_AH_theta;
    x[7] = x_AH_theta_i;
    const Lanes factor_23 = b_AG_theta - phi_G_x_AG_theta*x_G_x - phi_G_y_AG_theta*x_G_y;
    const Lanes factor_24 = b_AG_theta_i - phi_G_x_AG_theta*x_G_x_i - phi_G_y_AG_theta*x_G_y_i;
    const Lanes x_AG_theta = factor_23*inverse_pivot_AG_theta - factor_24*inverse_pivot_AG_theta_i;
    const Lanes x_AG_theta_i = factor_23*inverse_pivot_AG_theta_i + factor_24*inverse_pivot_AG_theta;
    x[4] = x_AG_theta;
    x[5] = x_AG_theta_i;
}

/*
 * (1/eta - J) u = r + s f_t with the factors of newton_factor at the same eta; r, u: q, v, works.
 * At complex eta: real and imaginary parts one behind the other.
 */
static void newton_solve_complex(const LaneComplexLinear *lin, Lanes eta, Lanes eta_i, const Lanes *r, Lanes *u)
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

    /* eta/kappa */
    const Lanes factor_1 = p->beta_squared*eta + p->two_alpha;
    const Lanes factor_2 = p->beta_squared*eta_i;
    const Lanes divisor_1 = eta*factor_1 - eta_i*factor_2 + 1.0;
    const Lanes divisor_2 = eta*factor_2 + eta_i*factor_1;
    const Lanes divisor_3 = 1.0/((divisor_1 * divisor_1) + (divisor_2 * divisor_2));
    const Lanes factor_3 = divisor_1*divisor_3;
    const Lanes factor_4 = -divisor_2*divisor_3;
    const Lanes eta_row = eta*factor_3 - eta_i*factor_4;
    const Lanes eta_row_i = eta*factor_4 + eta_i*factor_3;

    /* right-hand side */
    Lanes x[26];
    const Lanes shifted_OF_theta = -p->beta_squared*(eta*r[0] - eta_i*r[1]) + r[14];
    const Lanes shifted_OF_theta_i = -p->beta_squared*(eta*r[1] + eta_i*r[0]) + r[15];
    const Lanes shifted_BDE_theta = -p->beta_squared*(eta*r[2] - eta_i*r[3]) + r[16];
    const Lanes shifted_BDE_theta_i = -p->beta_squared*(eta*r[3] + eta_i*r[2]) + r[17];
    const Lanes shifted_AG_theta = -p->beta_squared*(eta*r[4] - eta_i*r[5]) + r[18];
    const Lanes shifted_AG_theta_i = -p->beta_squared*(eta*r[5] + eta_i*r[4]) + r[19];
    const Lanes shifted_AH_theta = -p->beta_squared*(eta*r[6] - eta_i*r[7]) + r[20];
    const Lanes shifted_AH_theta_i = -p->beta_squared*(eta*r[7] + eta_i*r[6]) + r[21];
    const Lanes shifted_FE_theta = -p->beta_squared*(eta*r[8] - eta_i*r[9]) + r[22];
    const Lanes shifted_FE_theta_i = -p->beta_squared*(eta*r[9] + eta_i*r[8]) + r[23];
    const Lanes shifted_HE_theta = -p->beta_squared*(eta*r[10] - eta_i*r[11]) + r[24];
    const Lanes shifted_HE_theta_i = -p->beta_squared*(eta*r[11] + eta_i*r[10]) + r[25];
    const Lanes shifted_EG_theta = -p->beta_squared*(eta*r[12] - eta_i*r[13]) + r[26];
    const Lanes shifted_EG_theta_i = -p->beta_squared*(eta*r[13] + eta_i*r[12]) + r[27];
    const Lanes factor_5 = -by_q_OF_theta_EG_theta*(eta*r[12] - eta_i*r[13])
        - by_q_OF_theta_FE_theta*(eta*r[8] - eta_i*r[9]) - by_q_OF_theta_OF_theta*(eta*r[0] - eta_i*r[1])
        + p->mass_OF_OF*r[14] + mass_OF_theta_EG_theta*r[26] + mass_OF_theta_FE_theta*r[22];
    const Lanes factor_6 = -by_q_OF_theta_EG_theta*(eta*r[13] + eta_i*r[12])
        - by_q_OF_theta_FE_theta*(eta*r[9] + eta_i*r[8]) - by_q_OF_theta_OF_theta*(eta*r[1] + eta_i*r[0])
        + p->mass_OF_OF*r[15] + mass_OF_theta_EG_theta*r[27] + mass_OF_theta_FE_theta*r[23];
    x[0] = eta*factor_5 - eta_i*factor_6;
    x[1] = eta*factor_6 + eta_i*factor_5;
    const Lanes factor_7 = -by_q_BDE_theta_BDE_theta*(eta*r[2] - eta_i*r[3])
        - by_q_BDE_theta_HE_theta*(eta*r[10] - eta_i*r[11]) + p->mass_BDE_BDE*r[16] + mass_BDE_theta_HE_theta*r[24];
    const Lanes factor_8 = -by_q_BDE_theta_BDE_theta*(eta*r[3] + eta_i*r[2])
        - by_q_BDE_theta_HE_theta*(eta*r[11] + eta_i*r[10]) + p->mass_BDE_BDE*r[17] + mass_BDE_theta_HE_theta*r[25];
    x[2] = eta*factor_7 - eta_i*factor_8;
    x[3] = eta*factor_8 + eta_i*factor_7;
    const Lanes factor_9 = -by_q_AG_theta_AG_theta*(eta*r[4] - eta_i*r[5]) + p->mass_AG_AG*r[18];
    const Lanes factor_10 = -by_q_AG_theta_AG_theta*(eta*r[5] + eta_i*r[4]) + p->mass_AG_AG*r[19];
    x[4] = eta*factor_9 - eta_i*factor_10;
    x[5] = eta*factor_10 + eta_i*factor_9;
    const Lanes factor_11 = -by_q_AH_theta_AH_theta*(eta*r[6] - eta_i*r[7]) + p->mass_AH_AH*r[20];
    const Lanes factor_12 = -by_q_AH_theta_AH_theta*(eta*r[7] + eta_i*r[6]) + p->mass_AH_AH*r[21];
    x[6] = eta*factor_11 - eta_i*factor_12;
    x[7] = eta*factor_12 + eta_i*factor_11;
    const Lanes factor_13 = -by_q_FE_theta_EG_theta*(eta*r[12] - eta_i*r[13])
        - by_q_FE_theta_FE_theta*(eta*r[8] - eta_i*r[9]) - by_q_FE_theta_OF_theta*(eta*r[0] - eta_i*r[1])
        + p->mass_FE_FE*r[22] + mass_FE_theta_EG_theta*r[26] + mass_OF_theta_FE_theta*r[14];
    const Lanes factor_14 = -by_q_FE_theta_EG_theta*(eta*r[13] + eta_i*r[12])
        - by_q_FE_theta_FE_theta*(eta*r[9] + eta_i*r[8]) - by_q_FE_theta_OF_theta*(eta*r[1] + eta_i*r[0])
        + p->mass_FE_FE*r[23] + mass_FE_theta_EG_theta*r[27] + mass_OF_theta_FE_theta*r[15];
    x[8] = eta*factor_13 - eta_i*factor_14;
    x[9] = eta*factor_14 + eta_i*factor_13;
    const Lanes factor_15 = -by_q_HE_theta_BDE_theta*(eta*r[2] - eta_i*r[3])
        - by_q_HE_theta_HE_theta*(eta*r[10] - eta_i*r[11]) + mass_BDE_theta_HE_theta*r[16] + p->mass_HE_HE*r[24];
    const Lanes factor_16 = -by_q_HE_theta_BDE_theta*(eta*r[3] + eta_i*r[2])
        - by_q_HE_theta_HE_theta*(eta*r[11] + eta_i*r[10]) + mass_BDE_theta_HE_theta*r[17] + p->mass_HE_HE*r[25];
    x[10] = eta*factor_15 - eta_i*factor_16;
    x[11] = eta*factor_16 + eta_i*factor_15;
    const Lanes factor_17 = -by_q_EG_theta_EG_theta*(eta*r[12] - eta_i*r[13])
        - by_q_EG_theta_FE_theta*(eta*r[8] - eta_i*r[9]) - by_q_EG_theta_OF_theta*(eta*r[0] - eta_i*r[1])
        + p->mass_EG_EG*r[26] + mass_FE_theta_EG_theta*r[22] + mass_OF_theta_EG_theta*r[14];
    const Lanes factor_18 = -by_q_EG_theta_EG_theta*(eta*r[13] + eta_i*r[12])
        - by_q_EG_theta_FE_theta*(eta*r[9] + eta_i*r[8]) - by_q_EG_theta_OF_theta*(eta*r[1] + eta_i*r[0])
        + p->mass_EG_EG*r[27] + mass_FE_theta_EG_theta*r[23] + mass_OF_theta_EG_theta*r[15];
    x[12] = eta*factor_17 - eta_i*factor_18;
    x[13] = eta*factor_18 + eta_i*factor_17;
    const Lanes factor_19 = -by_q_G_x_AG_theta*(eta*r[4] - eta_i*r[5]) - by_q_G_x_EG_theta*(eta*r[12] - eta_i*r[13])
        - by_q_G_x_FE_theta*(eta*r[8] - eta_i*r[9]) - by_q_G_x_OF_theta*(eta*r[0] - eta_i*r[1])
        + phi_G_x_AG_theta*shifted_AG_theta + phi_G_x_EG_theta*shifted_EG_theta + phi_G_x_FE_theta*shifted_FE_theta
        + phi_G_x_OF_theta*shifted_OF_theta;
    const Lanes factor_20 = -by_q_G_x_AG_theta*(eta*r[5] + eta_i*r[4]) - by_q_G_x_EG_theta*(eta*r[13] + eta_i*r[12])
        - by_q_G_x_FE_theta*(eta*r[9] + eta_i*r[8]) - by_q_G_x_OF_theta*(eta*r[1] + eta_i*r[0])
        + phi_G_x_AG_theta*shifted_AG_theta_i + phi_G_x_EG_theta*shifted_EG_theta_i
        + phi_G_x_FE_theta*shifted_FE_theta_i + phi_G_x_OF_theta*shifted_OF_theta_i;
    x[14] = eta_row*factor_19 - eta_row_i*factor_20;
    x[15] = eta_row*factor_20 + eta_row_i*factor_19;
    const Lanes factor_21 = -by_q_G_y_AG_theta*(eta*r[4] - eta_i*r[5]) - by_q_G_y_EG_theta*(eta*r[12] - eta_i*r[13])
        - by_q_G_y_FE_theta*(eta*r[8] - eta_i*r[9]) - by_q_G_y_OF_theta*(eta*r[0] - eta_i*r[1])
        + phi_G_y_AG_theta*shifted_AG_theta + phi_G_y_EG_theta*shifted_EG_theta + phi_G_y_FE_theta*shifted_FE_theta
        + phi_G_y_OF_theta*shifted_OF_theta;
    const Lanes factor_22 = -by_q_G_y_AG_theta*(eta*r[5] + eta_i*r[4]) - by_q_G_y_EG_theta*(eta*r[13] + eta_i*r[12])
        - by_q_G_y_FE_theta*(eta*r[9] + eta_i*r[8]) - by_q_G_y_OF_theta*(eta*r[1] + eta_i*r[0])
        + phi_G_y_AG_theta*shifted_AG_theta_i + phi_G_y_EG_theta*shifted_EG_theta_i
        + phi_G_y_FE_theta*shifted_FE_theta_i + phi_G_y_OF_theta*shifted_OF_theta_i;
    x[16] = eta_row*factor_21 - eta_row_i*factor_22;
    x[17] = eta_row*factor_22 + eta_row_i*factor_21;
    const Lanes factor_23 = -by_q_H_x_AH_theta*(eta*r[6] - eta_i*r[7]) - by_q_H_x_BDE_theta*(eta*r[2] - eta_i*r[3])
        - by_q_H_x_HE_theta*(eta*r[10] - eta_i*r[11]) + phi_H_x_AH_theta*shifted_AH_theta
        + phi_H_x_BDE_theta*shifted_BDE_theta + phi_H_x_HE_theta*shifted_HE_theta;
    const Lanes factor_24 = -by_q_H_x_AH_theta*(eta*r[7] + eta_i*r[6]) - by_q_H_x_BDE_theta*(eta*r[3] + eta_i*r[2])
        - by_q_H_x_HE_theta*(eta*r[11] + eta_i*r[10]) + phi_H_x_AH_theta*shifted_AH_theta_i
        + phi_H_x_BDE_theta*shifted_BDE_theta_i + phi_H_x_HE_theta*shifted_HE_theta_i;
    x[18] = eta_row*factor_23 - eta_row_i*factor_24;
    x[19] = eta_row*factor_24 + eta_row_i*factor_23;
    const Lanes factor_25 = -by_q_H_y_AH_theta*(eta*r[6] - eta_i*r[7]) - by_q_H_y_BDE_theta*(eta*r[2] - eta_i*r[3])
        - by_q_H_y_HE_theta*(eta*r[10] - eta_i*r[11]) + phi_H_y_AH_theta*shifted_AH_theta
        + phi_H_y_BDE_theta*shifted_BDE_theta + phi_H_y_HE_theta*shifted_HE_theta;
    const Lanes factor_26 = -by_q_H_y_AH_theta*(eta*r[7] + eta_i*r[6]) - by_q_H_y_BDE_theta*(eta*r[3] + eta_i*r[2])
        - by_q_H_y_HE_theta*(eta*r[11] + eta_i*r[10]) + phi_H_y_AH_theta*shifted_AH_theta_i
        + phi_H_y_BDE_theta*shifted_BDE_theta_i + phi_H_y_HE_theta*shifted_HE_theta_i;
    x[20] = eta_row*factor_25 - eta_row_i*factor_26;
    x[21] = eta_row*factor_26 + eta_row_i*factor_25;
    const Lanes factor_27 = -by_q_G_x_FE_theta*(eta*r[8] - eta_i*r[9]) - by_q_G_x_OF_theta*(eta*r[0] - eta_i*r[1])
        + by_q_H_x_BDE_theta*(eta*r[2] - eta_i*r[3]) + phi_G_x_FE_theta*shifted_FE_theta
        + phi_G_x_OF_theta*shifted_OF_theta - phi_H_x_BDE_theta*shifted_BDE_theta;
    const Lanes factor_28 = -by_q_G_x_FE_theta*(eta*r[9] + eta_i*r[8]) - by_q_G_x_OF_theta*(eta*r[1] + eta_i*r[0])
        + by_q_H_x_BDE_theta*(eta*r[3] + eta_i*r[2]) + phi_G_x_FE_theta*shifted_FE_theta_i
        + phi_G_x_OF_theta*shifted_OF_theta_i - phi_H_x_BDE_theta*shifted_BDE_theta_i;
    x[22] = eta_row*factor_27 - eta_row_i*factor_28;
    x[23] = eta_row*factor_28 + eta_row_i*factor_27;
    const Lanes factor_29 = -by_q_G_y_FE_theta*(eta*r[8] - eta_i*r[9]) - by_q_G_y_OF_theta*(eta*r[0] - eta_i*r[1])
        + by_q_H_y_BDE_theta*(eta*r[2] - eta_i*r[3]) + phi_G_y_FE_theta*shifted_FE_theta
        + phi_G_y_OF_theta*shifted_OF_theta - phi_H_y_BDE_theta*shifted_BDE_theta;
    const Lanes factor_30 = -by_q_G_y_FE_theta*(eta*r[9] + eta_i*r[8]) - by_q_G_y_OF_theta*(eta*r[1] + eta_i*r[0])
        + by_q_H_y_BDE_theta*(eta*r[3] + eta_i*r[2]) + phi_G_y_FE_theta*shifted_FE_theta_i
        + phi_G_y_OF_theta*shifted_OF_theta_i - phi_H_y_BDE_theta*shifted_BDE_theta_i;
    x[24] = eta_row*factor_29 - eta_row_i*factor_30;
    x[25] = eta_row*factor_30 + eta_row_i*factor_29;
    newton_substitute_complex(lin, x);

    /* solution */
    const Lanes factor_31 = r[0] + x[0];
    const Lanes factor_32 = r[1] + x[1];
    u[0] = eta*factor_31 - eta_i*factor_32;
    u[1] = eta*factor_32 + eta_i*factor_31;
    u[14] = x[0];
    u[15] = x[1];
    const Lanes factor_33 = r[2] + x[2];
    const Lanes factor_34 = r[3] + x[3];
    u[2] = eta*factor_33 - eta_i*factor_34;
    u[3] = eta*factor_34 + eta_i*factor_33;
    u[16] = x[2];
    u[17] = x[3];
    const Lanes factor_35 = r[4] + x[4];
    const Lanes factor_36 = r[5] + x[5];
    u[4] = eta*factor_35 - eta_i*factor_36;
    u[5] = eta*factor_36 + eta_i*factor_35;
    u[18] = x[4];
    u[19] = x[5];
    const Lanes factor_37 = r[6] + x[6];
    const Lanes factor_38 = r[7] + x[7];
    u[6] = eta*factor_37 - eta_i*factor_38;
    u[7] = eta*factor_38 + eta_i*factor_37;
    u[20] = x[6];
    u[21] = x[7];
    const Lanes factor_39 = r[8] + x[8];
    const Lanes factor_40 = r[9] + x[9];
    u[8] = eta*factor_39 - eta_i*factor_40;
    u[9] = eta*factor_40 + eta_i*factor_39;
    u[22] = x[8];
    u[23] = x[9];
    const Lanes factor_41 = r[10] + x[10];
    const Lanes factor_42 = r[11] + x[11];
    u[10] = eta*factor_41 - eta_i*factor_42;
    u[11] = eta*factor_42 + eta_i*factor_41;
    u[24] = x[10];
    u[25] = x[11];
    const Lanes factor_43 = r[12] + x[12];
    const Lanes factor_44 = r[13] + x[13];
    u[12] = eta*factor_43 - eta_i*factor_44;
    u[13] = eta*factor_44 + eta_i*factor_43;
    u[26] = x[12];
    u[27] = x[13];
    u[28] = eta*r[28] - eta_i*r[29];
    u[29] = eta*r[29] + eta_i*r[28];
    const Lanes factor_45 = p->motor_value*u[14] + r[30];
    const Lanes factor_46 = p->motor_value*u[15] + r[31];
    u[30] = eta*factor_45 - eta_i*factor_46;
    u[31] = eta*factor_46 + eta_i*factor_45;
    u[32] = eta*r[32] - eta_i*r[33];
    u[33] = eta*r[33] + eta_i*r[32];
}

#include "engine/batch/lane_tries.c"
#include "engine/batch/lane_flow.c"
#endif
