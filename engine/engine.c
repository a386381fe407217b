/*
 * The time loops of a scene as one translation unit; the other unit is scene.c, which contains the derived equations.
 * Read run/run.h first, then methods/adaptive.c. The preprocessor omits what a scene does not need.
 */
#include "model.h"
#include "scene/kernels.h"
#include "run/cancellation.c"
#include "scene/start.c"
#if N_TERMS
#include "watch/time_terms.c"
#endif
#if INTEGRATES
#include "run/run.c"
#include "run/report.c"
#include "methods/step.c"
#include "run/audit.c"
#include "run/audit_state.c"
#include "methods/methods.c"
#include "watch/roots.c"
#include "methods/defect.c"
#include "watch/gaps.c"
#include "watch/forces.c"
#include "watch/transients.c"
#if N_MONITORED && KNOWN_BOUNDS
#include "watch/watched.c"
#else
#include "watch/dense_samples.c"
#endif
#include "watch/events.c"
#include "run/peaks.c"
#include "run/changes.c"
#include "methods/step_length.c"
#include "methods/first_step.c"
#include "methods/begin.c"
#include "methods/audit_error.c"
#include "methods/audit_step.c"
#include "methods/adaptive.c"
#include "batch/ensemble.c"
#include "batch/repeated_run.c"
#else
#include "kinematic/kinematic.c"
#include "kinematic/works.c"
#include "kinematic/ensemble.c"
#if N_USER_EVENTS
#include "kinematic/events.c"
#endif
#endif
