/* Functions of a library of lanes that Python calls; Python reads these declarations too. */
#ifndef GUDGEON_LANE_CALLS_H
#define GUDGEON_LANE_CALLS_H

#pragma GCC visibility push(protected)

int gudgeon_lane_count(void);
void gudgeon_kinematic_lanes(
    const void *batch, const void *scalar_functions, void *const *run, long n, const long *indices);
int gudgeon_lanes(const void *batch, const void *scalar_functions, void *const *run, long *run_number);

#pragma GCC visibility pop

#endif
