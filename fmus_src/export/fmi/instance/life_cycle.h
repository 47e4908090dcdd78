/* The life of an instance, from its creation to its last step. `function` is the one that was called, for messages. */
#ifndef LIFE_CYCLE_H
#define LIFE_CYCLE_H

#include "instance.h"
#include "kernel_self_test.h"
#include "start_values.h"

/* A new instance, or NULL with a message where the arguments or `refusal` are against it. Memory comes from calloc. */
static Component *create_instance(const char *function, const char *instance_name, const char *token,
    const char *token_name, Logger logger, Environment environment, const char *refusal)
{
    const char *name = instance_name == NULL ? "" : instance_name;
    Component *component = instance_of(calloc(1, sizeof(Component) + strlen(name) + 1));
    if (component == NULL) return NULL;
    component->logger = component->importers_logger = logger;
    component->environment = environment;
    strcpy(component->instance_name, name);
    const bool is_ours = token != NULL && strcmp(token, MODEL_GUID) == 0;
    if (name[strspn(name, " \t\r\n")] == '\0') refusal = "the instance name is NULL or blank";
    if (refusal == NULL) refusal = check_arithmetic();
    if (is_ours && refusal == NULL) {
        restart(component);
        return component;
    }
    if (is_ours) {
        fail(component, "%s: %s", function, refusal);
    } else {
        fail(component, "%s: the %s is not that of this binary, " MODEL_GUID "; unpack the FMU again", function,
            token_name);
    }
    free(component);
    return NULL;
}

/* Note when the simulation starts, and when it stops. */
static Status set_start(
    Component *component, const char *function, double start_time, bool stop_time_defined, double stop_time)
{
    if (!isfinite(start_time)) return fail(component, "%s: the start time is not finite", function);
    if (stop_time_defined && !(stop_time >= start_time)) {
        return fail(component, "%s: the stop time is before the start time", function);
    }
    component->stop_time = stop_time_defined ? stop_time : INFINITY;
    component->now.start_time = start_time;
    component->now.time = start_time;
    return STATUS_OK;
}

/* An element from one block to another. */
static void copy_element(Block *to, const Block *from, const Element *element)
{
    void *target = (char *)to + element->offset;
    const void *source = (const char *)from + element->offset;
    switch (element->traits & KIND_ANY) {
        case KIND_REAL: *(double *)target = *(const double *)source; break;
        case KIND_INTEGER: *(int64_t *)target = *(const int64_t *)source; break;
        case KIND_BOOLEAN: *(bool *)target = *(const bool *)source; break;
    }
}

/* Run the block's initialize from the declared starts of states and outputs. */
static Status settle(Component *component)
{
    Block starts;
    get_starts(&starts);
    for (size_t i = 0; i < ELEMENT_COUNT; i++) {
        if (ELEMENTS[i].traits & COMPUTED) copy_element(&component->now.block, &starts, &ELEMENTS[i]);
    }
    component->now.tick = 0;
    model_set_start_time(&component->now.block, component->now.start_time);
    Fault fault = NO_FAULT;
    pass_parameters(&component->now.block, &fault);
    if (fault.what != NULL) return end_with_fault(component, &fault, ", during initialisation");
    const Status status = check_start_values(component);
    if (status != STATUS_OK) return status;
    model_initialize(&component->now.block, &fault);
    if (fault.what != NULL) return end_with_fault(component, &fault, ", during initialisation");
    component->now.unsettled = false;
    return STATUS_OK;
}

static Status leave_initialisation(Component *component, const char *function)
{
    Status status = check_mode(component, function, MODE_INITIALIZATION);
    if (status == STATUS_OK && component->now.unsettled) status = settle(component);
    if (status == STATUS_OK) component->now.mode = MODE_STEP;
    return status;
}

static Status terminate(Component *component, const char *function)
{
    const Status status = check_mode(component, function, MODE_STEP);
    if (status == STATUS_OK) component->now.mode = MODE_TERMINATED;
    return status;
}

static Status reset(Component *component, const char *function)
{
    const Status status = check_mode(component, function, MODE_ANY);
    if (status == STATUS_OK) restart(component);
    return status;
}

/* Whether a call that says what is to be logged is right. There are errors alone to log. */
static Status check_logging(
    const Component *component, const char *function, size_t category_count, const char *const categories[])
{
    const Status status = check_mode(component, function, MODE_ANY);
    if (status != STATUS_OK) return status;
    if (category_count > 0 && categories == NULL) return fail(component, "%s: categories is NULL", function);
    for (size_t i = 0; i < category_count; i++) {
        if (categories[i] == NULL) return fail(component, "%s: category %zu is NULL", function, i);
    }
    return STATUS_OK;
}

/* One communication step from where the last one ended; past the stop time it has to be an error (FMI 2.0,
 * fmi2SetupExperiment; FMI 3.0, fmi3EnterInitializationMode). */
static inline Status do_step(Component *component, const char *function, double communication_point, double step_size)
{
    const Status status = check_mode(component, function, MODE_STEP);
    if (status != STATUS_OK) return status;
    if (!isfinite(communication_point + step_size) || step_size <= 0.0) { /* the sum of two finite ones may overflow */
        return fail(component, "%s: communication point and step size must be finite, the latter positive", function);
    }
    const double here = component->now.time;
    if (fabs(communication_point - here) > POINT_TOLERANCE * step_size + TIME_TOLERANCE * fabs(here)) {
        return refuse_point(component, communication_point);
    }
    const double end = communication_point + step_size;
    const double stop = component->stop_time;
    if (end > stop && end > stop + POINT_TOLERANCE * step_size + TIME_TOLERANCE * fabs(end)) {
        return refuse_end(component, end);
    }
    component->last_step = advance(component, communication_point, step_size);
    if (component->last_step == STATUS_OK) component->now.time = end;
    return component->last_step;
}

static COLD Status not_provided(const Component *component, const char *function)
{
    if (component == NULL) return STATUS_ERROR;
    return fail(component, "%s: this FMU does not provide it, see modelDescription.xml", function);
}

#endif
