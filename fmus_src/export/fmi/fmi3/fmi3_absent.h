/* FMI 3.0: what a block does not have. Importers look all functions up, so they exist, and refuse. */
#ifndef FMI3_ABSENT_H
#define FMI3_ABSENT_H

#include "life_cycle.h"

/* ---- other interface types ---- */

static COLD fmi3Instance refuse_interface(
    const char *function, fmi3InstanceEnvironment environment, fmi3LogMessageCallback log_message)
{
    char message[MESSAGE_SIZE];
    snprintf(message, sizeof message, "%s: this FMU is for co-simulation only", function);
    if (log_message != NULL) log_error(log_message, environment, "", message);
    return NULL;
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String instance_name, fmi3String token, fmi3String resource_path,
    fmi3Boolean visible, fmi3Boolean logging_on, fmi3InstanceEnvironment environment,
    fmi3LogMessageCallback log_message)
{
    (void)instance_name, (void)token, (void)resource_path, (void)visible, (void)logging_on;
    return refuse_interface("fmi3InstantiateModelExchange", environment, log_message);
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String instance_name, fmi3String token, fmi3String resource_path,
    fmi3Boolean visible, fmi3Boolean logging_on, fmi3InstanceEnvironment environment,
    fmi3LogMessageCallback log_message, fmi3ClockUpdateCallback clock_update,
    fmi3LockPreemptionCallback lock_preemption, fmi3UnlockPreemptionCallback unlock_preemption)
{
    (void)instance_name, (void)token, (void)resource_path, (void)visible, (void)logging_on;
    (void)clock_update, (void)lock_preemption, (void)unlock_preemption;
    return refuse_interface("fmi3InstantiateScheduledExecution", environment, log_message);
}

/* ---- variables of types that no block has: only an empty list of them can be right ---- */

static Status no_variables(
    const Component *component, const char *function, const char *type, int allowed, size_t count)
{
    const Status status = check_mode(component, function, allowed);
    if (status == STATUS_OK && count > 0) return fail(component, "%s: there are no %s variables", function, type);
    return status;
}

#define NO_VARIABLES(Type)                                                                                            \
    fmi3Status fmi3Get##Type(fmi3Instance instance, const fmi3ValueReference references[], size_t count,              \
        fmi3##Type values[], size_t value_count)                                                                      \
    {                                                                                                                 \
        (void)references, (void)values, (void)value_count;                                                            \
        return no_variables(instance_of(instance), "fmi3Get" #Type, #Type, MODE_ANY, count);                          \
    }                                                                                                                 \
    fmi3Status fmi3Set##Type(fmi3Instance instance, const fmi3ValueReference references[], size_t count,              \
        const fmi3##Type values[], size_t value_count)                                                                \
    {                                                                                                                 \
        (void)references, (void)values, (void)value_count;                                                            \
        return no_variables(instance_of(instance), "fmi3Set" #Type, #Type, MODE_SETTABLE, count);                     \
    }

NO_VARIABLES(Float32)
NO_VARIABLES(Int8)
NO_VARIABLES(UInt8)
NO_VARIABLES(Int16)
NO_VARIABLES(UInt16)
NO_VARIABLES(UInt32)
NO_VARIABLES(UInt64)
NO_VARIABLES(String)

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference references[], size_t count, size_t sizes[],
    fmi3Binary values[], size_t value_count)
{
    (void)references, (void)sizes, (void)values, (void)value_count;
    return no_variables(instance_of(instance), "fmi3GetBinary", "Binary", MODE_ANY, count);
}

fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference references[], size_t count,
    const size_t sizes[], const fmi3Binary values[], size_t value_count)
{
    (void)references, (void)sizes, (void)values, (void)value_count;
    return no_variables(instance_of(instance), "fmi3SetBinary", "Binary", MODE_SETTABLE, count);
}

fmi3Status fmi3GetClock(
    fmi3Instance instance, const fmi3ValueReference references[], size_t count, fmi3Clock values[])
{
    (void)references, (void)values;
    return no_variables(instance_of(instance), "fmi3GetClock", "Clock", MODE_ANY, count);
}

fmi3Status fmi3SetClock(
    fmi3Instance instance, const fmi3ValueReference references[], size_t count, const fmi3Clock values[])
{
    (void)references, (void)values;
    return no_variables(instance_of(instance), "fmi3SetClock", "Clock", MODE_SETTABLE, count);
}

/* ---- dependencies of elements, derivatives: modelDescription.xml declares none of these ---- */

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance, fmi3ValueReference reference, size_t *count)
{
    (void)reference, (void)count;
    return not_provided(instance_of(instance), "fmi3GetNumberOfVariableDependencies");
}

fmi3Status fmi3GetVariableDependencies(fmi3Instance instance, fmi3ValueReference dependent, size_t elements[],
    fmi3ValueReference independents[], size_t independent_elements[], fmi3DependencyKind kinds[], size_t count)
{
    (void)dependent, (void)elements, (void)independents, (void)independent_elements, (void)kinds, (void)count;
    return not_provided(instance_of(instance), "fmi3GetVariableDependencies");
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
    size_t unknown_count, const fmi3ValueReference knowns[], size_t known_count, const fmi3Float64 seed[],
    size_t seed_count, fmi3Float64 sensitivity[], size_t sensitivity_count)
{
    (void)unknowns, (void)unknown_count, (void)knowns, (void)known_count;
    (void)seed, (void)seed_count, (void)sensitivity, (void)sensitivity_count;
    return not_provided(instance_of(instance), "fmi3GetDirectionalDerivative");
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[], size_t unknown_count,
    const fmi3ValueReference knowns[], size_t known_count, const fmi3Float64 seed[], size_t seed_count,
    fmi3Float64 sensitivity[], size_t sensitivity_count)
{
    (void)unknowns, (void)unknown_count, (void)knowns, (void)known_count;
    (void)seed, (void)seed_count, (void)sensitivity, (void)sensitivity_count;
    return not_provided(instance_of(instance), "fmi3GetAdjointDerivative");
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance, const fmi3ValueReference references[], size_t count,
    const fmi3Int32 orders[], fmi3Float64 values[], size_t value_count)
{
    (void)references, (void)count, (void)orders, (void)values, (void)value_count;
    return not_provided(instance_of(instance), "fmi3GetOutputDerivatives");
}

#endif
