/* Functions of a library of lanes that Python calls; Python reads these declarations too. */
#ifndef GUDGEON_LANE_CALLS_H
#define GUDGEON_LANE_CALLS_H

#pragma GCC visibility push(protected)

int gudgeon_lane_count(void);
int gudgeon_lanes(const void *batch, const void *single, void *const *run, long *number);

#pragma GCC visibility pop

#endif
