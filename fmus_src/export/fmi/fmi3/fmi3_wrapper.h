/* FMI 3.0 for co-simulation around one block.
 *
 * Included at the end of the block's own C file, which defines Block, STARTS, ELEMENTS, VARIABLES, NAMES, MODEL_GUID,
 * the tolerances of sampling, and model_initialize, model_step, model_sample_period and
 * model_set_start_time. Nothing is global: instances are independent of one another and may run
 * in different threads.
 */
#ifndef FMI3_WRAPPER_H
#define FMI3_WRAPPER_H

#include "fmi3_types.h"

#include "fmi3_absent.h"
#include "fmi3_absent_modes.h"
#include "fmi3_fmu_state.h"
#include "fmi3_values.h"
#include "life_cycle.h"

const char *fmi3GetVersion(void)
{
    return fmi3Version;
}

fmi3Status fmi3SetDebugLogging(
    fmi3Instance instance, fmi3Boolean logging_on, size_t category_count, const fmi3String categories[])
{
    Component *component = instance_of(instance);
    const Status status = check_logging(component, "fmi3SetDebugLogging", category_count, categories);
    if (status != STATUS_OK) return status;
    for (size_t i = 0; i < category_count; i++) {
        if (strcmp(categories[i], "logStatusError") != 0 && strcmp(categories[i], "logAll") != 0) {
            return fail(component, "fmi3SetDebugLogging: there is no log category %s", categories[i]);
        }
    }
    component->logger = logging_on ? component->importers_logger : NULL;
    return STATUS_OK;
}

/* ---- creation and destruction ---- */

/* Why there is no instance is logged in any case, as FMI says. */
fmi3Instance fmi3InstantiateCoSimulation(fmi3String instance_name, fmi3String token, fmi3String resource_path,
    fmi3Boolean visible, fmi3Boolean logging_on, fmi3Boolean event_mode_used, fmi3Boolean early_return_allowed,
    const fmi3ValueReference required_intermediate_variables[], size_t required_count,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log_message,
    fmi3IntermediateUpdateCallback intermediate_update)
{
    (void)resource_path, (void)visible, (void)early_return_allowed;
    (void)required_intermediate_variables, (void)required_count, (void)intermediate_update;
    Component *component = create_instance("fmi3InstantiateCoSimulation", instance_name, token, "instantiation token",
        log_message, environment, event_mode_used ? "this FMU has no event mode" : NULL);
    if (component != NULL && !logging_on) component->logger = NULL;
    return component;
}

void fmi3FreeInstance(fmi3Instance instance)
{
    free(instance);
}

/* ---- life cycle ---- */

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean tolerance_defined, fmi3Float64 tolerance,
    fmi3Float64 start_time, fmi3Boolean stop_time_defined, fmi3Float64 stop_time)
{
    (void)tolerance_defined, (void)tolerance;
    Component *component = instance_of(instance);
    Status status = check_mode(component, "fmi3EnterInitializationMode", MODE_INSTANTIATED);
    if (status == STATUS_OK) {
        status = set_start(component, "fmi3EnterInitializationMode", start_time, stop_time_defined, stop_time);
    }
    if (status == STATUS_OK) component->now.mode = MODE_INITIALIZATION;
    return status;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance)
{
    return leave_initialisation(instance_of(instance), "fmi3ExitInitializationMode");
}

fmi3Status fmi3Terminate(fmi3Instance instance)
{
    return terminate(instance_of(instance), "fmi3Terminate");
}

fmi3Status fmi3Reset(fmi3Instance instance)
{
    return reset(instance_of(instance), "fmi3Reset");
}

/* ---- stepping ---- */

/* No event, no end and no early return is ever reported. */
fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 communication_point, fmi3Float64 step_size,
    fmi3Boolean no_set_fmu_state_prior_to_current_point, fmi3Boolean *event_handling_needed,
    fmi3Boolean *terminate_simulation, fmi3Boolean *early_return, fmi3Float64 *last_successful_time)
{
    (void)no_set_fmu_state_prior_to_current_point;
    Component *component = instance_of(instance);
    if (component == NULL) return STATUS_ERROR;
    if (event_handling_needed == NULL || terminate_simulation == NULL || early_return == NULL
        || last_successful_time == NULL) {
        return fail(component, "fmi3DoStep: an argument is NULL");
    }
    const Status status = do_step(component, "fmi3DoStep", communication_point, step_size);
    *event_handling_needed = false;
    *terminate_simulation = false;
    *early_return = false;
    *last_successful_time = component->now.time;
    return status;
}

#endif
