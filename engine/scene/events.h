/* Events of the user: when one is crossed. */
#ifndef GUDGEON_EVENTS_H
#define GUDGEON_EVENTS_H

/*
 * Whether expression i, seen last on `side` of zero (1 or -1; 0: nowhere yet), has crossed to `value`; `side` is
 * where it is then. A zero itself lies on neither side.
 */
static inline int event_crosses(int i, signed char *side, double value)
{
    const int from = *side, to = (value > 0.0) - (value < 0.0);
    if (to)
        *side = (signed char)to;
    return from * to < 0 && event_direction[i] * to >= 0;
}

#endif
