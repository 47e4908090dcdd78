/* The model of an FMU that is a system of blocks: a communication step is one or several whole steps of the system.
 *
 * The file around the wrapper defines SYSTEM_STEP (s), and a Block with `start_time` (s), `point`, the number of steps
 * since then, and `has_finished`, behind which no step changes anything; model_step takes one step from there.
 */
#ifndef SYSTEM_STEPS_H
#define SYSTEM_STEPS_H

#include "instance.h"

static COLD Status refuse_length(Component *component, double h)
{
    char h_text[REPR_SIZE];
    char step_text[REPR_SIZE];
    component->now.mode = MODE_ERROR;
    return fail(component,
        "StepError: the communication step of %s s is no whole number of the system's steps of %s s; use a multiple",
        python_repr(h, h_text), python_repr(SYSTEM_STEP, step_text));
}

static Status advance(Component *component, double t, double h)
{
    Block *system = &component->now.block;
    const double count = floor(h / SYSTEM_STEP + 0.5);
    if (count < 1.0 || fabs(h - count * SYSTEM_STEP) > POINT_TOLERANCE * SYSTEM_STEP) return refuse_length(component, h);
    for (double taken = 0.0; taken < count && !system->has_finished; taken += 1.0) {
        const double begin = system->start_time + (double)system->point * SYSTEM_STEP;
        const double expected = t + taken * SYSTEM_STEP; /* by an importer whose steps may all be a little too long */
        if (fabs(expected - begin) > POINT_TOLERANCE * SYSTEM_STEP + TIME_TOLERANCE * fabs(begin)) {
            component->now.time = begin;
            return refuse_point(component, expected);
        }
        Fault fault = NO_FAULT;
        model_step(system, &fault);
        if (fault.what != NULL) return end_step_with_fault(component, &fault, begin, SYSTEM_STEP);
    }
    return STATUS_OK;
}

#endif
