/* Sample instants: which steps of a sampled block are steps, and which are not.
 *
 * SAMPLE_TOLERANCE and TIME_TOLERANCE, defined before, are those of fmus_src/runtime.py.
 */
#ifndef SAMPLING_H
#define SAMPLING_H

#include "kernel_math.h"

typedef enum Samples { NO_SAMPLE, ONE_SAMPLE, SEVERAL_SAMPLES } Samples;

/* How many samples of a block with this period (s; 0: it steps at every communication point) are due in a step to the
 * time `end` (s). One is added to `tick`, the number of those before. */
static inline Samples count_samples(int64_t *tick, double start_time, double period, double end)
{
    if (!(period > 0.0)) return ONE_SAMPLE;
    const double margin = SAMPLE_TOLERANCE * period + TIME_TOLERANCE * fabs(end);
    const double due = start_time + (double)(*tick + 1) * period;
    if (end < due - margin) return NO_SAMPLE;
    if (end >= due + period - margin) return SEVERAL_SAMPLES;
    *tick += 1;
    return ONE_SAMPLE;
}

#endif
