"""Constants of engine/boundary.h for Python: written by tools/declared.py."""

from typing import Final

AUDIT_FAILS: Final = 10.0
MIN_TOUCHING_PENETRATION: Final = 1e-13
MAX_STICK_SPEED: Final = 1e-9
TAYLOR_ORDERS_PER_E_FOLD: Final = 0.7
TAYLOR_TOLERANCE_RATIO: Final = 10.0

# enum Status
AUDITED: Final = -15
NOT_FOUND: Final = -14
FRICTION_INCONSISTENT: Final = -13
UNBOUNDED: Final = -12
STALLED: Final = -11
STOPPED: Final = -10
NOT_CLOSED: Final = -9
OUTSIDE: Final = -8
ENDED: Final = -7
LOST: Final = -6
TOO_SMALL: Final = -5
CHATTERING: Final = -4
EVENTS_FULL: Final = -3
NOT_FINITE: Final = -2
NEWTON_FAILED: Final = -1
EVENT_STOPS: Final = 1

# enum RunPhase
NEW: Final = 0
BEGUN: Final = 1
OVER: Final = 2

# enum BatchResult
BATCH_ENDED: Final = 0
BUFFERS_FULL: Final = 1
RUN_ENDED: Final = 2
CALL_AGAIN: Final = 3

# enum RepeatStage
SET_PARAMETERS: Final = 0
CHECK_POSITION: Final = 1
INTEGRATE: Final = 2

# enum RepeatResult
SERIES_READ: Final = 0
SERIES_UNREAD: Final = 1
NOT_VALID: Final = 2
NOT_FITTING: Final = 3
RUN_FAILED: Final = 4
NOT_CONFIRMED: Final = 5

# enum Relation
GREATER: Final = 0
GREATER_OR_EQUAL: Final = 1
LESS: Final = 2
LESS_OR_EQUAL: Final = 3

# enum ContactCode
CODE_FREE: Final = 0
CODE_IMPACT: Final = 1
CODE_CONTACT: Final = 2

# enum AuditLevel
AUDIT_OFF: Final = 0
AUDIT_ON: Final = 1
AUDIT_FULL: Final = 2

# enum AuditCheck
CHECK_defect: Final = 0
CHECK_gap: Final = 1
CHECK_free: Final = 2
CHECK_position: Final = 3
CHECK_velocity: Final = 4
CHECK_acceleration: Final = 5
CHECK_branch: Final = 6
CHECK_event: Final = 7
CHECK_force: Final = 8
CHECK_rate: Final = 9
CHECK_step: Final = 10
CHECK_mode: Final = 11
N_CHECKS: Final = 12
AUDIT_CHECK_NAMES = (
    "defect",
    "gap",
    "free",
    "position",
    "velocity",
    "acceleration",
    "branch",
    "event",
    "force",
    "rate",
    "step",
    "mode",
)

# enum FrictionMode
MODE_CONSTRAINED: Final = 2

# enum Capacity
MAX_LISTED: Final = 256

# enum MotionCapacity
MAX_MOTION_SERIES: Final = 64

# enum Count
COUNT_steps: Final = 0
COUNT_right_hand_sides: Final = 1
COUNT_onsets: Final = 2
COUNT_ratio_outside: Final = 3
COUNT_switches: Final = 4
COUNT_rejected: Final = 5
COUNT_jacobians: Final = 6
COUNT_stiff_steps: Final = 7
N_COUNTS: Final = 8
COUNT_NAMES = (
    "steps",
    "right_hand_sides",
    "onsets",
    "ratio_outside",
    "switches",
    "rejected",
    "jacobians",
    "stiff_steps",
)

# enum Residual
RESIDUAL_phi_max: Final = 0
RESIDUAL_phi_dot_max: Final = 1
RESIDUAL_ratio_min: Final = 2
RESIDUAL_ratio_max: Final = 3
RESIDUAL_speed_max: Final = 4
RESIDUAL_omega_max: Final = 5
N_RESIDUALS: Final = 6
RESIDUAL_NAMES = ("phi_max", "phi_dot_max", "ratio_min", "ratio_max", "speed_max", "omega_max")

# enum Peak
PEAK_F: Final = 0
PEAK_t: Final = 1
PEAK_e_max: Final = 2
N_PEAK: Final = 3
PEAK_NAMES = ("F", "t", "e_max")

# enum StepEnd
END_CONTACT: Final = 0
END_SWITCH: Final = 1
END_FRICTION: Final = 2
END_EVENT: Final = 3
N_STEP_ENDS: Final = 4
STEP_END_NAMES = ("CONTACT", "SWITCH", "FRICTION", "EVENT")

# enum ImpactColumn
IMPACT_t_on: Final = 0
IMPACT_t_off: Final = 1
IMPACT_deltadot: Final = 2
IMPACT_F_peak: Final = 3
IMPACT_t_peak: Final = 4
N_IMPACT_COLUMNS: Final = 5
IMPACT_COLUMN_NAMES = ("t_on", "t_off", "deltadot", "F_peak", "t_peak")

# enum RecordColumn
RECORD_JUMPED: Final = 0
RECORD_T: Final = 1
N_RECORD_HEAD: Final = 2
RECORD_COLUMN_NAMES = ("JUMPED", "T")

# enum EnvelopeColumn
ENVELOPE_F_low: Final = 0
ENVELOPE_t_F_low: Final = 1
ENVELOPE_F_high: Final = 2
ENVELOPE_t_F_high: Final = 3
ENVELOPE_ex_out: Final = 4
ENVELOPE_ey_out: Final = 5
ENVELOPE_t_out: Final = 6
ENVELOPE_ex: Final = 7
ENVELOPE_ey: Final = 8
N_ENVELOPE_COLUMNS: Final = 9
ENVELOPE_COLUMN_NAMES = ("F_low", "t_F_low", "F_high", "t_F_high", "ex_out", "ey_out", "t_out", "ex", "ey")

# enum Work
WORK_drives: Final = 0
WORK_forces: Final = 1
WORK_clearances: Final = 2
N_WORK: Final = 3
WORK_NAMES = ("drives", "forces", "clearances")

# enum ReactionColumn
REACTION_Fx: Final = 0
REACTION_Fy: Final = 1
REACTION_M: Final = 2
N_REACTION_COLUMNS: Final = 3
REACTION_COLUMN_NAMES = ("Fx", "Fy", "M")

# enum ClearanceColumn
CLEARANCE_Fx: Final = 0
CLEARANCE_Fy: Final = 1
CLEARANCE_Fn: Final = 2
CLEARANCE_Ft: Final = 3
CLEARANCE_ex: Final = 4
CLEARANCE_ey: Final = 5
CLEARANCE_e: Final = 6
CLEARANCE_deltadot: Final = 7
CLEARANCE_vt: Final = 8
CLEARANCE_delta: Final = 9
N_CLEARANCE_COLUMNS: Final = 10
CLEARANCE_COLUMN_NAMES = ("Fx", "Fy", "Fn", "Ft", "ex", "ey", "e", "deltadot", "vt", "delta")

# enum BodyForceKind
FORCE_REACTION: Final = 0
FORCE_CLEARANCE: Final = 1
FORCE_FRICTION: Final = 2
FORCE_SPRING: Final = 3
FORCE_COMPONENTS: Final = 4
FORCE_DRIVE: Final = 5
FORCE_MOMENT: Final = 6

# enum FrictionColumn
FRICTION_force: Final = 0
FRICTION_slip: Final = 1
N_FRICTION_COLUMNS: Final = 2
FRICTION_COLUMN_NAMES = ("force", "slip")

# enum Energy
ENERGY_kinetic: Final = 0
ENERGY_potential: Final = 1
N_ENERGY: Final = 2
ENERGY_NAMES = ("kinetic", "potential")

# enum Drift
DRIFT_phi: Final = 0
DRIFT_phi_dot: Final = 1
N_DRIFT: Final = 2
DRIFT_NAMES = ("phi", "phi_dot")

# enum ValueReference
VR_TIME: Final = 0
VR_RTOL: Final = 1
VR_PARAMETERS: Final = 16
VR_OUTPUTS: Final = 1048576
VR_STATES: Final = 16777216
VR_RATES: Final = 33554432
VR_INDICATORS: Final = 67108864
