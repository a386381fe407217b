/*
 * List of the engine files that are compiled with the functions derived for a scene. A scene's scene.c includes it
 * last, as a whole or in parts (PART): 1 functions in absolute coordinates, 2 in tree coordinates, 3 those of the
 * methods.
 */
#include "calls.h"
#if !PART || PART == 1
#include "calls.c"
#include "body_balance.c"
#include "audit_samples.c"
#if N_ROWS && !N_FRICTIONS && !N_RIGID
#include "singular.c"
#endif
#if LARGEST_BLOCK > 2
#include "block.c"
#endif
#if TREE && HAS_ABSOLUTE_FALLBACK
#include "../motion/absolute_fallback.c"
#endif
#if N_DEPENDENT
#include "../motion/driven_loops.c"
#endif
#if INTEGRATES && !TREE
#include "../motion/full.c"
#elif INTEGRATES && !N_DEPENDENT
#include "../motion/tree.c"
#endif
#if INTEGRATES
#include "../motion/driven.c"
#include "../motion/continuation.c"
#endif
#if N_DEPENDENT
#include "../motion/driven_calls.c"
#elif TREE
#include "../motion/tree_calls.c"
#endif
#endif
#if TAYLOR && (!PART || PART == 2)
#include "../motion/taylor.c"
#endif
#if INTEGRATES && (!PART || PART == 3)
#include "jacobian.c"
#endif
