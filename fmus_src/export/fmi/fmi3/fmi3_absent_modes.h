/* FMI 3.0: modes, clocks and continuous states, which a block does not have. */
#ifndef FMI3_ABSENT_MODES_H
#define FMI3_ABSENT_MODES_H

#include "life_cycle.h"

/* A function of the instance alone. */
#define NOT_PROVIDED(name)                                                                                            \
    fmi3Status fmi3##name(fmi3Instance instance)                                                                      \
    {                                                                                                                 \
        return not_provided(instance_of(instance), "fmi3" #name);                                                     \
    }

NOT_PROVIDED(EnterConfigurationMode)
NOT_PROVIDED(ExitConfigurationMode)
NOT_PROVIDED(EnterEventMode)
NOT_PROVIDED(EnterStepMode)
NOT_PROVIDED(EnterContinuousTimeMode)
NOT_PROVIDED(EvaluateDiscreteStates)

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *need_update, fmi3Boolean *terminate_simulation,
    fmi3Boolean *nominals_changed, fmi3Boolean *states_changed, fmi3Boolean *next_event_time_defined,
    fmi3Float64 *next_event_time)
{
    (void)need_update, (void)terminate_simulation, (void)nominals_changed, (void)states_changed;
    (void)next_event_time_defined, (void)next_event_time;
    return not_provided(instance_of(instance), "fmi3UpdateDiscreteStates");
}

/* ---- clocks ---- */

fmi3Status fmi3GetIntervalDecimal(fmi3Instance instance, const fmi3ValueReference references[], size_t count,
    fmi3Float64 intervals[], fmi3IntervalQualifier qualifiers[])
{
    (void)references, (void)count, (void)intervals, (void)qualifiers;
    return not_provided(instance_of(instance), "fmi3GetIntervalDecimal");
}

fmi3Status fmi3GetIntervalFraction(fmi3Instance instance, const fmi3ValueReference references[], size_t count,
    fmi3UInt64 counters[], fmi3UInt64 resolutions[], fmi3IntervalQualifier qualifiers[])
{
    (void)references, (void)count, (void)counters, (void)resolutions, (void)qualifiers;
    return not_provided(instance_of(instance), "fmi3GetIntervalFraction");
}

fmi3Status fmi3GetShiftDecimal(
    fmi3Instance instance, const fmi3ValueReference references[], size_t count, fmi3Float64 shifts[])
{
    (void)references, (void)count, (void)shifts;
    return not_provided(instance_of(instance), "fmi3GetShiftDecimal");
}

fmi3Status fmi3GetShiftFraction(fmi3Instance instance, const fmi3ValueReference references[], size_t count,
    fmi3UInt64 counters[], fmi3UInt64 resolutions[])
{
    (void)references, (void)count, (void)counters, (void)resolutions;
    return not_provided(instance_of(instance), "fmi3GetShiftFraction");
}

fmi3Status fmi3SetIntervalDecimal(
    fmi3Instance instance, const fmi3ValueReference references[], size_t count, const fmi3Float64 intervals[])
{
    (void)references, (void)count, (void)intervals;
    return not_provided(instance_of(instance), "fmi3SetIntervalDecimal");
}

fmi3Status fmi3SetIntervalFraction(fmi3Instance instance, const fmi3ValueReference references[], size_t count,
    const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
{
    (void)references, (void)count, (void)counters, (void)resolutions;
    return not_provided(instance_of(instance), "fmi3SetIntervalFraction");
}

fmi3Status fmi3SetShiftDecimal(
    fmi3Instance instance, const fmi3ValueReference references[], size_t count, const fmi3Float64 shifts[])
{
    (void)references, (void)count, (void)shifts;
    return not_provided(instance_of(instance), "fmi3SetShiftDecimal");
}

fmi3Status fmi3SetShiftFraction(fmi3Instance instance, const fmi3ValueReference references[], size_t count,
    const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
{
    (void)references, (void)count, (void)counters, (void)resolutions;
    return not_provided(instance_of(instance), "fmi3SetShiftFraction");
}

fmi3Status fmi3ActivateModelPartition(fmi3Instance instance, fmi3ValueReference clock, fmi3Float64 activation_time)
{
    (void)clock, (void)activation_time;
    return not_provided(instance_of(instance), "fmi3ActivateModelPartition");
}

/* ---- model exchange ---- */

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance, fmi3Boolean no_set_fmu_state_prior_to_current_point,
    fmi3Boolean *enter_event_mode, fmi3Boolean *terminate_simulation)
{
    (void)no_set_fmu_state_prior_to_current_point, (void)enter_event_mode, (void)terminate_simulation;
    return not_provided(instance_of(instance), "fmi3CompletedIntegratorStep");
}

fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64 time)
{
    (void)time;
    return not_provided(instance_of(instance), "fmi3SetTime");
}

fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 states[], size_t count)
{
    (void)states, (void)count;
    return not_provided(instance_of(instance), "fmi3SetContinuousStates");
}

/* Doubles per continuous state or event indicator. */
#define NO_STATES(name)                                                                                               \
    fmi3Status fmi3Get##name(fmi3Instance instance, fmi3Float64 values[], size_t count)                               \
    {                                                                                                                 \
        (void)values, (void)count;                                                                                    \
        return not_provided(instance_of(instance), "fmi3Get" #name);                                                  \
    }

NO_STATES(ContinuousStateDerivatives)
NO_STATES(EventIndicators)
NO_STATES(ContinuousStates)
NO_STATES(NominalsOfContinuousStates)

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance instance, size_t *count)
{
    (void)count;
    return not_provided(instance_of(instance), "fmi3GetNumberOfEventIndicators");
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance instance, size_t *count)
{
    (void)count;
    return not_provided(instance_of(instance), "fmi3GetNumberOfContinuousStates");
}

#endif
