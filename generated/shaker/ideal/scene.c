/* All files together, or with -DPART=1, 2, 3 those of a part: these are compiled side by side. */
#include "model.h"
#include "engine/scene/kernels.h"
#include "engine/scene/trigonometry.h"
#if !PART || PART == 1
#include "parameters.c"
#include "constraints.c"
#include "dynamics.c"
#endif
#if !PART || PART == 2
#include "reduced.c"
#endif
#if !PART || PART == 3
#include "newton.c"
#endif
#include "engine/scene/scene.c"
