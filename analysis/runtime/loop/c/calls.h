/* Calls of FMU functions by address. They return the fmi2Status or fmi3Status. */
#ifndef CALLS_H
#define CALLS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "run.h"

#define POINTER(address) ((void *)(uintptr_t)(address))

static inline bool is_well(int status)
{
    return 0 <= status && status <= FMI_WARNING;
}

/* fmi2SetReal, fmi2GetString and similar functions, with contiguous references and values. */
static inline int exchange(
    uint64_t function, uint64_t instance, const uint32_t *references, uint64_t count, const void *values)
{
    typedef int Exchange(void *, const uint32_t *, size_t, const void *);
    return ((Exchange *)(uintptr_t)function)(POINTER(instance), references, (size_t)count, values);
}

/* fmi2DoStep, with the guarantee that no earlier state is restored (noSetFMUStatePriorToCurrentPoint). */
static inline int do_step(uint64_t function, uint64_t instance, double time, double step)
{
    typedef int DoStep(void *, double, double, int);
    return ((DoStep *)(uintptr_t)function)(POINTER(instance), time, step, 1);
}

/* fmi2Reset, fmi3EnterEventMode and other functions with the instance as their only argument. */
static inline int change_mode(uint64_t function, uint64_t instance)
{
    typedef int ChangeMode(void *);
    return ((ChangeMode *)(uintptr_t)function)(POINTER(instance));
}

/* fmi3SetFloat64 and similar functions; an array is one variable with several values. */
static inline int exchange_values(
    uint64_t function, uint64_t instance, const uint32_t *references, int64_t variables, const void *values, int64_t count)
{
    typedef int Exchange(void *, const uint32_t *, size_t, const void *, size_t);
    return ((Exchange *)(uintptr_t)function)(POINTER(instance), references, (size_t)variables, values, (size_t)count);
}

/* fmi3SetBinary, fmi3GetBinary. */
static inline int exchange_binaries(
    uint64_t function,
    uint64_t instance,
    const uint32_t *references,
    int64_t variables,
    uint64_t *sizes,
    const void *addresses,
    int64_t count)
{
    typedef int Exchange(void *, const uint32_t *, size_t, uint64_t *, const void *, size_t);
    return ((Exchange *)(uintptr_t)function)(
        POINTER(instance), references, (size_t)variables, sizes, addresses, (size_t)count);
}

/* fmi3DoStep, with the same guarantee; it sets the flags eventHandlingNeeded, terminateSimulation, earlyReturn. */
static inline int do_step_to_event(
    uint64_t function, uint64_t instance, double time, double step, bool *flags, double *last_time)
{
    typedef int DoStep(void *, double, double, bool, bool *, bool *, bool *, double *);
    return ((DoStep *)(uintptr_t)function)(
        POINTER(instance), time, step, true, &flags[0], &flags[1], &flags[2], last_time);
}

/* fmi3UpdateDiscreteStates; flags become discreteStatesNeedUpdate, terminateSimulation and three for other uses. */
static inline int update_discrete_states(uint64_t function, uint64_t instance, bool *flags, double *next_event)
{
    typedef int Update(void *, bool *, bool *, bool *, bool *, bool *, double *);
    return ((Update *)(uintptr_t)function)(
        POINTER(instance), &flags[0], &flags[1], &flags[2], &flags[3], &flags[4], next_event);
}

#endif
