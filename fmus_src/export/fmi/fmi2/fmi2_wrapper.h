/* FMI 2.0 for co-simulation around one block.
 *
 * Included at the end of the block's own C file, which defines Block, STARTS, ELEMENTS, NAMES, MODEL_GUID,
 * the tolerances of sampling, and model_initialize, model_step, model_sample_period and
 * model_set_start_time. Nothing is global: instances are independent of one another and may run
 * in different threads.
 */
#ifndef FMI2_WRAPPER_H
#define FMI2_WRAPPER_H

#include "fmi2_types.h"

#ifndef HAS_FINISHED
#define HAS_FINISHED(component) fmi2False /* a block never asks for the end of the simulation */
#endif

#include "fmi2_fmu_state.h"
#include "fmi2_values.h"
#include "life_cycle.h"

const char *fmi2GetTypesPlatform(void)
{
    return fmi2TypesPlatform;
}

const char *fmi2GetVersion(void)
{
    return fmi2Version;
}

/* Errors are always logged. */
fmi2Status fmi2SetDebugLogging(
    fmi2Component c, fmi2Boolean logging_on, size_t category_count, const fmi2String categories[])
{
    (void)logging_on;
    return check_logging(instance_of(c), "fmi2SetDebugLogging", category_count, categories);
}

/* ---- creation and destruction ---- */

fmi2Component fmi2Instantiate(fmi2String instance_name, fmi2Type fmu_type, fmi2String guid,
    fmi2String resource_location, const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean logging_on)
{
    (void)resource_location;
    (void)visible;
    (void)logging_on;
    if (functions == NULL) return NULL; /* without a logger nobody can be told why */
    return create_instance("fmi2Instantiate", instance_name, guid, "GUID", functions->logger,
        functions->componentEnvironment,
        fmu_type == fmi2CoSimulation ? NULL : "this FMU is for co-simulation only");
}

void fmi2FreeInstance(fmi2Component c)
{
    free(c);
}

/* ---- life cycle ---- */

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean tolerance_defined, fmi2Real tolerance,
    fmi2Real start_time, fmi2Boolean stop_time_defined, fmi2Real stop_time)
{
    (void)tolerance_defined;
    (void)tolerance;
    Component *component = instance_of(c);
    const fmi2Status status = check_mode(component, "fmi2SetupExperiment", MODE_INSTANTIATED);
    if (status != fmi2OK) return status;
    return set_start(component, "fmi2SetupExperiment", start_time, stop_time_defined, stop_time);
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
    Component *component = instance_of(c);
    const fmi2Status status = check_mode(component, "fmi2EnterInitializationMode", MODE_INSTANTIATED);
    if (status == fmi2OK) component->now.mode = MODE_INITIALIZATION;
    return status;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
    return leave_initialisation(instance_of(c), "fmi2ExitInitializationMode");
}

fmi2Status fmi2Terminate(fmi2Component c)
{
    return terminate(instance_of(c), "fmi2Terminate");
}

fmi2Status fmi2Reset(fmi2Component c)
{
    return reset(instance_of(c), "fmi2Reset");
}

/* ---- stepping ---- */

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real communication_point, fmi2Real step_size,
    fmi2Boolean no_set_fmu_state_prior_to_current_point)
{
    (void)no_set_fmu_state_prior_to_current_point;
    return do_step(instance_of(c), "fmi2DoStep", communication_point, step_size);
}

fmi2Status fmi2CancelStep(fmi2Component c)
{
    Component *component = instance_of(c);
    if (component == NULL) return fmi2Error;
    return fail(component, "fmi2CancelStep: no step is under way; steps end before fmi2DoStep returns");
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value)
{
    Component *component = instance_of(c);
    if (component == NULL || value == NULL) return fmi2Error;
    if (kind != fmi2DoStepStatus) return fmi2Discard;
    *value = component->last_step;
    return fmi2OK;
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
    Component *component = instance_of(c);
    if (component == NULL || value == NULL) return fmi2Error;
    if (kind != fmi2LastSuccessfulTime) return fmi2Discard;
    *value = component->now.time;
    return fmi2OK;
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
{
    const Component *component = instance_of(c);
    if (component == NULL || value == NULL) return fmi2Error;
    if (kind != fmi2Terminated) return fmi2Discard;
    *value = HAS_FINISHED(component);
    return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value)
{
    (void)kind;
    return c == NULL || value == NULL ? fmi2Error : fmi2Discard; /* FMI 2.0 defines no such status */
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value)
{
    (void)kind;
    return c == NULL || value == NULL ? fmi2Error : fmi2Discard; /* only for steps under way */
}

#endif
