/*
 * The numbers that the engine shares with its callers: statuses, and the sizes and columns of the arrays that functions
 * of scene/calls.h read and fill. Python and JavaScript use the same names: tools/declared.py (`make generated`) writes
 * them into runtime/contract/boundary.py and runtime/web/boundary.js. Columns are SI.
 */
#ifndef GUDGEON_BOUNDARY_H
#define GUDGEON_BOUNDARY_H

/* Status of a time loop, and of the kinematic analysis; 0: it reached its end, positive: the pivot that vanished. */
enum Status {
    NEWTON_FAILED = -1, /* kinematic analysis: no position was found */
    NOT_FINITE = -2,
    EVENTS_FULL = -3,   /* the lists are to be fetched before the run goes on */
    CHATTERING = -4, TOO_SMALL = -5, LOST = -6,
    ENDED = -7,         /* by an event of the user */
    OUTSIDE = -8,       /* a contact is deeper than its law holds */
    NOT_CLOSED = -9,    /* a run of a batch whose start is left to Python */
    STOPPED = -10,      /* the caller asked to stop */
    STALLED = -11, UNBOUNDED = -12, FRICTION_INCONSISTENT = -13, NOT_FOUND = -14, AUDITED = -15,
    EVENT_STOPS = 1     /* of gudgeon_kinematic_events: an event ends the run */
};

/* Phase of a run in a batch, and what a call that moves runs of a batch forward returns. */
enum RunPhase { NEW, BEGUN, OVER };
enum BatchResult { ALL_OVER, LISTS, RUN_OVER, GOES_ON };

/* Contact code of a joint with play in a sample: an impact lasts until the penetration first stops growing. */
enum ContactCode { CODE_FREE, CODE_IMPACT, CODE_CONTACT };

/* Levels of the audit, and its checks at steps. */
enum AuditLevel { AUDIT_OFF, AUDIT_ON, AUDIT_FULL };
enum AuditCheck {
    CHECK_defect,       /* the dense output against the right-hand side, between the ends of a step */
    CHECK_gap,          /* penetration of a joint that is not listed as in contact */
    CHECK_free,         /* force of a joint that is not in contact */
    CHECK_position,     /* all rows of Phi of all bodies */
    CHECK_velocity,     /* all rows of Phi_q v - nu of all bodies */
    CHECK_acceleration, /* accelerations of the tree against those of all bodies */
    CHECK_branch,       /* branches of switching functions against their signs */
    CHECK_event,        /* events that were recorded against the signs of their expressions */
    CHECK_force,        /* forces of films against accelerations of the dense output */
    CHECK_rate,         /* rates of the dense output, as a share of the largest, whatever the step's length */
    CHECK_step,         /* local errors of steps by the integral of the defect of the dense output */
    N_CHECKS
};

/* A check of the audit whose value is so many times its limit ends the run. */
#define AUDIT_FAILS 10.0

/* m: a joint with play has not touched where surfaces overlap by less. */
#define SHALLOW 1e-13

/* m/s: a slip below it may stick. */
#define AT_REST 1e-9

/* Mode of a dry_friction element: 0 sticks, -1 and 1 slip, and this one is held at rest by drives or other friction. */
enum FrictionMode { MODE_HELD = 2 };

/* Events and contacts that the lists of a run hold. */
enum Capacity { MAX_LISTED = 256 };

/* Report of a run: counts, residuals and ratios, three numbers of each joint with play. */
enum Count {
    COUNT_steps, COUNT_right_hand_sides, COUNT_onsets, COUNT_ratio_outside, COUNT_switches,
    COUNT_rejected, COUNT_jacobians, COUNT_stiff_steps, N_COUNTS
};
enum Residual { RESIDUAL_phi_max, RESIDUAL_phi_dot_max, RESIDUAL_ratio_min, RESIDUAL_ratio_max, N_RESIDUALS };
enum Peak { PEAK_F, PEAK_t, PEAK_e_max, N_PEAK };

/* What steps of a run that no longer advances ended at. */
enum StepEnd { END_CONTACT, END_SWITCH, END_FRICTION, END_EVENT, N_STEP_ENDS };

/* A listed contact, beside the number of its joint. */
enum ImpactColumn { IMPACT_t_on, IMPACT_t_off, IMPACT_deltadot, IMPACT_F_peak, IMPACT_t_peak, N_IMPACT_COLUMNS };

/* A row of the tape begins with these; the state of all bodies, memory and contact codes follow. */
enum TapeColumn { TAPE_JUMPED, TAPE_T, N_TAPE_HEAD };

/* A row of the trace begins with its time; so many numbers of each joint with play follow. */
enum TraceColumn {
    TRACE_F_low, TRACE_t_F_low, TRACE_F_high, TRACE_t_F_high, TRACE_ex_out, TRACE_ey_out, TRACE_t_out, TRACE_ex,
    TRACE_ey, N_TRACE_COLUMNS
};

/* Arrays of gudgeon_evaluate, at one sample. */
enum Work { WORK_drives, WORK_forces, WORK_clearances, N_WORK };
enum ReactionColumn { REACTION_Fx, REACTION_Fy, REACTION_M, N_REACTION_COLUMNS };
enum ClearanceColumn {
    CLEARANCE_Fx, CLEARANCE_Fy,
    CLEARANCE_Fn, /* positive: pushes the surfaces apart */
    CLEARANCE_Ft, CLEARANCE_ex, CLEARANCE_ey, CLEARANCE_e, CLEARANCE_deltadot, CLEARANCE_vt, CLEARANCE_delta,
    N_CLEARANCE_COLUMNS
};
enum FrictionColumn { FRICTION_force, FRICTION_slip, N_FRICTION_COLUMNS };
enum Energy { ENERGY_kinetic, ENERGY_potential, N_ENERGY };
enum Drift { DRIFT_phi, DRIFT_phi_dot, N_DRIFT };

/* Value references of an FMU: the first of each kind. */
enum ValueReference {
    VR_TIME = 0, VR_RTOL = 1, VR_PARAMETERS = 16, VR_OUTPUTS = 1 << 20, VR_STATES = 1 << 24, VR_RATES = 1 << 25,
    VR_INDICATORS = 1 << 26
};

#endif
