/*
 * The functions that rk4 needs, for several runs side by side (engine/batch/lanes.h): the same operations with vectors
 * for numbers. A library of its own, compiled when a batch first asks for it.
 */
#include "model.h"
#include "engine/batch/batch.h"
#include "engine/batch/lanes.h"

/* Numbers of each run side by side, field by field those of Parameters in model.h: meanings, addresses, units too. */
typedef struct {
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
    (void)t, (void)memory;
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
    *rare |= ~(scale_H_x > VANISHING * size_H_x);
    *rare |= ~(determinant_H_x__H_y > VANISHING * size_H_x * scale_H_x);
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
    *rare |= ~(scale_G_x > VANISHING * size_G_x);
    *rare |= ~(determinant_G_x__G_y > VANISHING * size_G_x * scale_G_x);
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
    *rare |= ~(determinant_E3_x__E3_y > NEARLY_SINGULAR * scale_E3_y * scale_E3_x);
    const Lanes size_E3_x = scale_E3_x + scale_E3_y;
    *rare |= ~(scale_E3_x > VANISHING * size_E3_x);
    *rare |= ~(determinant_E3_x__E3_y > VANISHING * size_E3_x * scale_E3_x);
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
    (void)t, (void)memory;
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
    *rare |= ~(determinant_H_x__H_y > VANISHING * scale_H_y * scale_H_x);
    const Lanes size_H_x = scale_H_x + scale_H_y;
    *rare |= ~(scale_H_x > VANISHING * size_H_x);
    *rare |= ~(determinant_H_x__H_y > VANISHING * size_H_x * scale_H_x);
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
    *rare |= ~(determinant_G_x__G_y > VANISHING * scale_G_y * scale_G_x);
    const Lanes size_G_x = scale_G_x + scale_G_y;
    *rare |= ~(scale_G_x > VANISHING * size_G_x);
    *rare |= ~(determinant_G_x__G_y > VANISHING * size_G_x * scale_G_x);
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
    *rare |= ~(pivot_E3_x > VANISHING * scale_E3_x);
    *rare |= ~(determinant_E3_x__E3_y > VANISHING * scale_E3_y * pivot_E3_x);
    const Lanes size_E3_x = scale_E3_x + scale_E3_y;
    *rare |= ~(pivot_E3_x > VANISHING * size_E3_x);
    *rare |= ~(determinant_E3_x__E3_y > VANISHING * size_E3_x * pivot_E3_x);
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

#include "engine/batch/lane_steps.c"
#include "engine/batch/lane_runs.c"
