/* The model of an FMU that is one block: its declared starts, its steps at sample instants. */
#ifndef SINGLE_BLOCK_H
#define SINGLE_BLOCK_H

#include "instance.h"
#include "sampling.h"

static void get_starts(Block *block)
{
    *block = STARTS;
}

/* A block's parameters are all set from outside, and all are used. */
static void pass_parameters(Block *block, Fault *fault)
{
    (void)block, (void)fault;
}

static bool is_used(const Block *block, uint32_t offset)
{
    (void)block, (void)offset;
    return true;
}

static COLD Status refuse_step(Component *component, double h, double period)
{
    char h_text[REPR_SIZE];
    char period_text[REPR_SIZE];
    component->now.mode = MODE_ERROR;
    return fail(component,
        "StepError: communication step %s s holds more than %d samples of sample_period %s s; "
        "use a shorter communication step, or a longer period",
        python_repr(h, h_text), STEP_LIMIT, python_repr(period, period_text));
}

static COLD Status refuse_integration(Component *component, double h, double longest)
{
    char h_text[REPR_SIZE];
    char longest_text[REPR_SIZE];
    component->now.mode = MODE_ERROR;
    return fail(component,
        "StepError: communication step %s s holds more than %d integration steps of %s s; "
        "use a shorter communication step, or a longer internal_step",
        python_repr(h, h_text), STEP_LIMIT, python_repr(longest, longest_text));
}

/* Step at each of the sample instants up to the time `end` from the one before, as an importer that steps by the period
 * and holds its inputs. Apart from the usual path, so that a step with one instant tests nothing more. */
static COLD Status take_samples(Component *component, double h, double period, double end)
{
    Snapshot *now = &component->now;
    const double margin = SAMPLE_TOLERANCE * period + TIME_TOLERANCE * fabs(end);
    const double last = (end + margin - now->start_time) / period;
    const double longest = model_integration_step(&now->block);
    if (last - (double)now->tick >= STEP_LIMIT + 1.0) return refuse_step(component, h, period);
    if (h > STEP_LIMIT * longest) return refuse_integration(component, h, longest);
    while (now->tick < (int64_t)last) {
        const double t = now->start_time + (double)now->tick * period;
        now->tick += 1;
        Fault fault = NO_FAULT;
        model_step(&now->block, &fault, t, period);
        if (fault.what != NULL) return end_step_with_fault(component, &fault, t, period);
    }
    return STATUS_OK;
}

/* Advance from t to t + h; a sampled block steps at its sample instants only, at each of them. */
static Status advance(Component *component, double t, double h)
{
    Snapshot *now = &component->now;
    const double period = model_sample_period(&now->block);
    switch (count_samples(&now->tick, now->start_time, period, t + h)) {
        case NO_SAMPLE: return STATUS_OK;
        case SEVERAL_SAMPLES: return take_samples(component, h, period, t + h);
        case ONE_SAMPLE: break;
    }
    const double longest = model_integration_step(&now->block);
    if (h > STEP_LIMIT * longest) return refuse_integration(component, h, longest);
    Fault fault = NO_FAULT;
    model_step(&now->block, &fault, t, h);
    return fault.what == NULL ? STATUS_OK : end_step_with_fault(component, &fault, t, h);
}

#endif
