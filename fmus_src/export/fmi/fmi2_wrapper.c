/* FMI 2.0 for co-simulation around one block.
 *
 * Included at the end of the block's own C file, which defines Block, STARTS, ELEMENTS, NAMES, MODEL_GUID,
 * the tolerances of sampling, and model_initialize, model_step, model_sample_period and
 * model_set_start_time. Nothing is global: instances are independent of one another and may run
 * in different threads.
 */
#include "fmi2_component.h"
#include "fmi2_fmu_state.h"
#include "fmi2_values.h"
#include "kernel_self_test.h"

const char *fmi2GetTypesPlatform(void)
{
    return fmi2TypesPlatform;
}

const char *fmi2GetVersion(void)
{
    return fmi2Version;
}

/* Errors are always logged and there is nothing else to log. */
fmi2Status fmi2SetDebugLogging(
    fmi2Component c, fmi2Boolean logging_on, size_t category_count, const fmi2String categories[])
{
    (void)logging_on;
    Component *component = c;
    const fmi2Status status = check_mode(component, "fmi2SetDebugLogging", MODE_ANY);
    if (status != fmi2OK) return status;
    if (category_count > 0 && categories == NULL) return fail(component, "fmi2SetDebugLogging: categories is NULL");
    for (size_t i = 0; i < category_count; i++) {
        if (categories[i] == NULL) return fail(component, "fmi2SetDebugLogging: category %zu is NULL", i);
    }
    return fmi2OK;
}

/* ---- creation and destruction ---- */

/* Memory comes from calloc: modelDescription.xml says canNotUseMemoryManagementFunctions. */
fmi2Component fmi2Instantiate(fmi2String instance_name, fmi2Type fmu_type, fmi2String guid,
    fmi2String resource_location, const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean logging_on)
{
    (void)resource_location;
    (void)visible;
    (void)logging_on;
    if (functions == NULL || instance_name == NULL) return NULL;
    Component *component = calloc(1, sizeof(Component) + strlen(instance_name));
    if (component == NULL) return NULL;
    component->logger = functions->logger;
    component->environment = functions->componentEnvironment;
    strcpy(component->instance_name, instance_name);
    const char *refusal = NULL;
    if (instance_name[0] == '\0') refusal = "the instance name is empty";
    if (fmu_type != fmi2CoSimulation) refusal = "this FMU is for co-simulation only";
    if (guid == NULL || strcmp(guid, MODEL_GUID) != 0) {
        refusal = "the GUID is not that of this binary, " MODEL_GUID "; unpack the FMU again";
    }
    if (refusal == NULL) refusal = check_arithmetic();
    if (refusal != NULL) {
        fail(component, "fmi2Instantiate: %s", refusal);
        free(component);
        return NULL;
    }
    restart(component);
    return component;
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
    Component *component = c;
    const fmi2Status status = check_mode(component, "fmi2SetupExperiment", MODE_INSTANTIATED);
    if (status != fmi2OK) return status;
    if (!isfinite(start_time)) return fail(component, "fmi2SetupExperiment: the start time is not finite");
    if (stop_time_defined && !(stop_time >= start_time)) {
        return fail(component, "fmi2SetupExperiment: the stop time is before the start time");
    }
    component->now.start_time = start_time;
    component->now.time = start_time;
    return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
    Component *component = c;
    const fmi2Status status = check_mode(component, "fmi2EnterInitializationMode", MODE_INSTANTIATED);
    if (status == fmi2OK) component->now.mode = MODE_INITIALIZATION;
    return status;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
    Component *component = c;
    fmi2Status status = check_mode(component, "fmi2ExitInitializationMode", MODE_INITIALIZATION);
    if (status == fmi2OK && component->now.unsettled) status = settle(component);
    if (status == fmi2OK) component->now.mode = MODE_STEP;
    return status;
}

fmi2Status fmi2Terminate(fmi2Component c)
{
    Component *component = c;
    const fmi2Status status = check_mode(component, "fmi2Terminate", MODE_STEP);
    if (status == fmi2OK) component->now.mode = MODE_TERMINATED;
    return status;
}

fmi2Status fmi2Reset(fmi2Component c)
{
    Component *component = c;
    const fmi2Status status = check_mode(component, "fmi2Reset", MODE_ANY);
    if (status == fmi2OK) restart(component);
    return status;
}

/* ---- stepping ---- */

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real communication_point, fmi2Real step_size,
    fmi2Boolean no_set_fmu_state_prior_to_current_point)
{
    (void)no_set_fmu_state_prior_to_current_point;
    Component *component = c;
    const fmi2Status status = check_mode(component, "fmi2DoStep", MODE_STEP);
    if (status != fmi2OK) return status;
    if (!isfinite(communication_point) || !isfinite(step_size) || step_size <= 0.0) {
        return fail(component, "fmi2DoStep: communication point and step size must be finite, the latter positive");
    }
    const double here = component->now.time;
    if (fabs(communication_point - here) > POINT_TOLERANCE * step_size + TIME_TOLERANCE * fabs(here)) {
        return refuse_point(component, communication_point);
    }
    component->last_step = advance(component, communication_point, step_size);
    if (component->last_step == fmi2OK) component->now.time = communication_point + step_size;
    return component->last_step;
}

fmi2Status fmi2CancelStep(fmi2Component c)
{
    Component *component = c;
    if (component == NULL) return fmi2Error;
    return fail(component, "fmi2CancelStep: no step is under way; steps end before fmi2DoStep returns");
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value)
{
    Component *component = c;
    if (component == NULL || value == NULL) return fmi2Error;
    if (kind != fmi2DoStepStatus) return fmi2Discard;
    *value = component->last_step;
    return fmi2OK;
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
    Component *component = c;
    if (component == NULL || value == NULL) return fmi2Error;
    if (kind != fmi2LastSuccessfulTime) return fmi2Discard;
    *value = component->now.time;
    return fmi2OK;
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
{
    if (c == NULL || value == NULL) return fmi2Error;
    if (kind != fmi2Terminated) return fmi2Discard;
    *value = fmi2False; /* a block never asks for the end of the simulation */
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
