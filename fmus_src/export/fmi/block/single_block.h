/* The model of an FMU that is one block: its declared starts, its steps at sample instants. */
#ifndef SINGLE_BLOCK_H
#define SINGLE_BLOCK_H

#include "instance.h"
#include "sampling.h"

static void get_starts(Block *block)
{
    *block = STARTS;
}

static COLD Status refuse_step(Component *component, double h, double period)
{
    char h_text[REPR_SIZE];
    char period_text[REPR_SIZE];
    component->now.mode = MODE_ERROR;
    return fail(component,
        "StepError: communication step %s s holds more than one sample of sample_period %s s; "
        "use a communication step no longer than the period, or a longer period",
        python_repr(h, h_text), python_repr(period, period_text));
}

/* Advance from t to t + h; a sampled block steps at its sample instants only. */
static Status advance(Component *component, double t, double h)
{
    Snapshot *now = &component->now;
    const double period = model_sample_period(&now->block);
    switch (count_samples(&now->tick, now->start_time, period, t + h)) {
        case NO_SAMPLE: return STATUS_OK;
        case SEVERAL_SAMPLES: return refuse_step(component, h, period);
        case ONE_SAMPLE: break;
    }
    Fault fault = NO_FAULT;
    model_step(&now->block, &fault, t, h);
    return fault.what == NULL ? STATUS_OK : end_step_with_fault(component, &fault, t, h);
}

#endif
