/*
 * The constants that the engine shares with its callers: statuses, and the sizes and columns of the arrays that the
 * functions of scene/calls.h read and fill. Python and JavaScript use the same names: tools/declared.py (`make
 * generated`) writes them into runtime/contract/boundary.py and runtime/web/boundary.js. Columns are in SI units.
 */
#ifndef GUDGEON_BOUNDARY_H
#define GUDGEON_BOUNDARY_H

/*
 * Status of a time loop and of the kinematic analysis. 0: the end was reached. Positive: the number of the pivot that
 * vanished, counted from 1.
 */
enum Status {
    NEWTON_FAILED = -1, /* kinematic analysis: Newton's method found no position */
    NOT_FINITE = -2,    /* a state or rate is not finite */
    EVENTS_FULL = -3,   /* the caller must fetch the lists of events and contacts before the run resumes */
    CHATTERING = -4,    /* events, impacts or modes change without an end at one time */
    TOO_SMALL = -5,     /* step size underflow */
    LOST = -6,          /* a free journal or slider is outside its walls: contact detection failed */
    ENDED = -7,         /* a user-defined event ended the run */
    OUTSIDE = -8,       /* a penetration exceeds the range of validity of its contact law */
    NOT_CLOSED = -9,    /* Python must compute the start of this run of a batch */
    STOPPED = -10,      /* the caller requested cancellation */
    STALLED = -11,      /* time no longer advances */
    UNBOUNDED = -12,    /* the second rate of a drive is unbounded, with fixed steps */
    FRICTION_INCONSISTENT = -13, /* no consistent contact force exists (Painleve) */
    NOT_FOUND = -14,    /* the iteration of the stages did not converge */
    AUDITED = -15,      /* a check of the audit failed */
    EVENT_STOPS = 1     /* of gudgeon_kinematic_events: an event ends the run */
};

/* Phases of a run in a batch. */
enum RunPhase { NEW, BEGUN, OVER };

/* Results of a call that advances the runs of a batch: all ended, lists are full, one ended, or more to do. */
enum BatchResult { BATCH_ENDED, BUFFERS_FULL, RUN_ENDED, CALL_AGAIN };

/* Stages at which gudgeon_repeat_run() begins. CHECK_POSITION: parameters and tolerances are set. */
enum RepeatStage { SET_PARAMETERS, CHECK_POSITION, INTEGRATE };

/*
 * Results of gudgeon_repeat_run(): the series are in `values`; Python must read them; parameter values are not valid;
 * the position violates constraint equations; the run failed; an audited sample exceeds a limit.
 */
enum RepeatResult { SERIES_READ, SERIES_UNREAD, NOT_VALID, NOT_FITTING, RUN_FAILED, NOT_CONFIRMED };

/* Relation of a parameter to the sum of others in a condition of the file. */
enum Relation { GREATER, GREATER_OR_EQUAL, LESS, LESS_OR_EQUAL };

/* Contact code of a joint with play in a sample: an impact lasts until the penetration first stops growing. */
enum ContactCode { CODE_FREE, CODE_IMPACT, CODE_CONTACT };

/* Levels of the audit. */
enum AuditLevel { AUDIT_OFF, AUDIT_ON, AUDIT_FULL };

/* Checks of the audit: each compares a value of an accepted step with its limit. */
enum AuditCheck {
    CHECK_defect,       /* the dense output against the right-hand side, between the ends of a step */
    CHECK_gap,          /* penetration of a joint, against the state of its contact */
    CHECK_free,         /* force of a joint, against the state of its contact */
    CHECK_position,     /* all constraint equations Phi = 0 of all bodies */
    CHECK_velocity,     /* all velocity constraints Phi_q v - nu = 0 of all bodies */
    CHECK_acceleration, /* accelerations of the reduced formulation against those of the full one */
    CHECK_branch,       /* active branches of switching functions against their signs */
    CHECK_event,        /* recorded user-defined events against the signs of their expressions */
    CHECK_force,        /* film forces against the accelerations of the dense output */
    CHECK_rate,         /* rates of the dense output, relative to the largest rate, for any step length */
    CHECK_step,         /* local error of a step from the integral of the defect of the dense output */
    CHECK_mode,         /* slip or force of a friction element, against its mode */
    N_CHECKS
};

/* Multiple of its limit at which a check of the audit ends the run. */
#define AUDIT_FAILS 10.0

/* Penetration in m below which surfaces of a joint with play do not count as touching. */
#define MIN_TOUCHING_PENETRATION 1e-13

/* Slip speed in m/s below which friction may stick. */
#define MAX_STICK_SPEED 1e-9

/* Orders of the series of Taylor's method per factor e of its tolerance, in scenes with more than eight products. */
#define TAYLOR_ORDERS_PER_E_FOLD 0.7

/* Tolerance of the method `auto` divided by that of its Taylor series, so that errors are at most those of dop853. */
#define TAYLOR_TOLERANCE_RATIO 10.0

/*
 * Mode of a dry_friction element: 0 stick, -1 or 1 the sign of its slip, MODE_CONSTRAINED at rest by drives or other
 * friction.
 */
enum FrictionMode { MODE_CONSTRAINED = 2 };

/* Number of events, and of contacts, at which the lists of a run count as full. */
enum Capacity { MAX_LISTED = 256 };

/* Largest number of series of the motion that kinematic runs of a batch store. */
enum MotionCapacity { MAX_MOTION_SERIES = 64 };

/*
 * Columns of the report of a run: counts, residuals with restitution ratios, and three values of each joint with play.
 */
enum Count {
    COUNT_steps, COUNT_right_hand_sides, COUNT_onsets, COUNT_ratio_outside, COUNT_switches,
    COUNT_rejected, COUNT_jacobians, COUNT_stiff_steps, N_COUNTS
};

/*
 * Columns of the largest residuals of a run, of the extremes of deltadot/deltadot_minus, and of the largest rates of
 * integrated lengths (m/s) and angles (rad/s) at the ends of steps.
 */
enum Residual {
    RESIDUAL_phi_max, RESIDUAL_phi_dot_max, RESIDUAL_ratio_min, RESIDUAL_ratio_max, RESIDUAL_speed_max,
    RESIDUAL_omega_max, N_RESIDUALS
};

/* Columns of the peak of a joint with play: largest force (N), its time (s), largest eccentricity (m). */
enum Peak { PEAK_F, PEAK_t, PEAK_e_max, N_PEAK };

/* Kinds of event that end the steps of a run that no longer advances. */
enum StepEnd { END_CONTACT, END_SWITCH, END_FRICTION, END_EVENT, N_STEP_ENDS };

/* Columns of a listed contact; the number of its joint is in an array of its own. */
enum ImpactColumn { IMPACT_t_on, IMPACT_t_off, IMPACT_deltadot, IMPACT_F_peak, IMPACT_t_peak, N_IMPACT_COLUMNS };

/*
 * First columns of a row of the step record; the state of all bodies, the discrete state and the contact codes follow.
 */
enum RecordColumn { RECORD_JUMPED, RECORD_T, N_RECORD_HEAD };

/* Columns of each joint with play in a row of the envelope; the row begins with its time. */
enum EnvelopeColumn {
    ENVELOPE_F_low, ENVELOPE_t_F_low, ENVELOPE_F_high, ENVELOPE_t_F_high, ENVELOPE_ex_out, ENVELOPE_ey_out,
    ENVELOPE_t_out, ENVELOPE_ex, ENVELOPE_ey, N_ENVELOPE_COLUMNS
};

/* Works that are integrated with the state: of drives, of force elements, of joints with play. */
enum Work { WORK_drives, WORK_forces, WORK_clearances, N_WORK };

/* Columns of a joint reaction in the results of gudgeon_evaluate: force in N, moment in N m. */
enum ReactionColumn { REACTION_Fx, REACTION_Fy, REACTION_M, N_REACTION_COLUMNS };

/* Columns of a joint with play in the results of gudgeon_evaluate. */
enum ClearanceColumn {
    CLEARANCE_Fx, CLEARANCE_Fy,
    CLEARANCE_Fn, /* positive: pushes the surfaces apart */
    CLEARANCE_Ft, CLEARANCE_ex, CLEARANCE_ey, CLEARANCE_e, CLEARANCE_deltadot, CLEARANCE_vt, CLEARANCE_delta,
    N_CLEARANCE_COLUMNS
};

/* Kinds of force on bodies, by the result that contains the force. */
enum BodyForceKind {
    FORCE_REACTION,   /* reactions */
    FORCE_CLEARANCE,  /* clearance: in a joint with play */
    FORCE_FRICTION,   /* friction: along a direction that is fixed in the first body */
    FORCE_SPRING,     /* series: along the line from one point to another */
    FORCE_COMPONENTS, /* series: two columns, x and y */
    FORCE_DRIVE,      /* torques: the moment of a drive */
    FORCE_MOMENT      /* series: a moment */
};

/* Columns of a friction element in the results of gudgeon_evaluate: force in N, slip speed in m/s. */
enum FrictionColumn { FRICTION_force, FRICTION_slip, N_FRICTION_COLUMNS };

/* Columns of the energies in the results of gudgeon_evaluate, J. */
enum Energy { ENERGY_kinetic, ENERGY_potential, N_ENERGY };

/* Columns of the largest constraint residuals in the results of gudgeon_evaluate. */
enum Drift { DRIFT_phi, DRIFT_phi_dot, N_DRIFT };

/* Value references of an FMU: the first reference of each kind of variable. */
enum ValueReference {
    VR_TIME = 0, VR_RTOL = 1, VR_PARAMETERS = 16, VR_OUTPUTS = 1 << 20, VR_STATES = 1 << 24, VR_RATES = 1 << 25,
    VR_INDICATORS = 1 << 26
};

#endif
