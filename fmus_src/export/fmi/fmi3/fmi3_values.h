/* FMI 3.0: getting and setting variables, whole arrays, by value reference. */
#ifndef FMI3_VALUES_H
#define FMI3_VALUES_H

#include "life_cycle.h"

#define VARIABLE_COUNT (sizeof VARIABLES / sizeof VARIABLES[0])
#define TIME_REFERENCE VARIABLE_COUNT

static const char *type_name(VariableType type)
{
    switch (type) {
        case TYPE_FLOAT64: return "Float64";
        case TYPE_INT32: return "Int32";
        case TYPE_BOOLEAN: return "Boolean";
        case TYPE_ENUMERATION: return "Enumeration, which has the functions of Int64";
    }
    return "unknown";
}

static COLD Status refuse_reference(const Component *component, const char *function, fmi3ValueReference reference)
{
    return fail(component, "%s: there is no variable with value reference %u", function, reference);
}

static COLD Status refuse_type(const Component *component, const char *function, fmi3ValueReference reference)
{
    const bool is_time = reference == TIME_REFERENCE;
    const VariableType type = is_time ? TYPE_FLOAT64 : VARIABLES[reference].type;
    return fail(component, "%s: %s is of type %s", function, is_time ? "time" : NAMES[reference], type_name(type));
}

static COLD Status refuse_sizes(const Component *component, const char *function, size_t elements, size_t values)
{
    return fail(component, "%s: the variables have %zu elements, nValues is %zu", function, elements, values);
}

static COLD Status refuse_null(const Component *component, const char *function, const void *references)
{
    return fail(component, "%s: %s is NULL", function, references == NULL ? "valueReferences" : "values");
}

/* STATUS_OK where values of this type may be read, settled if initialisation is under way; before, those of the start. */
static inline Status prepare_get(Component *component, const char *function, VariableType type,
    const fmi3ValueReference references[], size_t count, const void *values, size_t value_count)
{
    const Status status = check_mode(component, function, MODE_ANY);
    if (status != STATUS_OK) return status;
    if (count > 0 && (references == NULL || values == NULL)) return refuse_null(component, function, references);
    size_t elements = 0;
    for (size_t i = 0; i < count; i++) {
        if (references[i] > TIME_REFERENCE) return refuse_reference(component, function, references[i]);
        const bool is_time = references[i] == TIME_REFERENCE;
        const VariableType actual = is_time ? TYPE_FLOAT64 : VARIABLES[references[i]].type;
        if (actual != type) return refuse_type(component, function, references[i]);
        elements += is_time ? 1 : VARIABLES[references[i]].size;
    }
    if (elements != value_count) return refuse_sizes(component, function, elements, value_count);
    if (component->now.unsettled && component->now.mode == MODE_INITIALIZATION) return settle(component);
    return STATUS_OK;
}

/* The first element of a variable in the instance. */
static inline void *elements_of(fmi3Instance instance, fmi3ValueReference reference)
{
    return (char *)&instance_of(instance)->now.block + ELEMENTS[VARIABLES[reference].first].offset;
}

/* Set variables of which some are tunable parameters, between steps. */
static COLD Status tune(Component *component, const char *function, VariableType type,
    const fmi3ValueReference references[], size_t count, const void *values)
{
    const Block before = component->now.block;
    size_t next = 0;
    for (size_t i = 0; i < count; i++) {
        void *to = elements_of(component, references[i]);
        for (uint32_t k = 0; k < VARIABLES[references[i]].size; k++, next++) {
            switch (type) {
                case TYPE_FLOAT64: ((double *)to)[k] = ((const fmi3Float64 *)values)[next]; break;
                case TYPE_INT32: ((int64_t *)to)[k] = ((const fmi3Int32 *)values)[next]; break;
                case TYPE_ENUMERATION: ((int64_t *)to)[k] = ((const fmi3Int64 *)values)[next]; break;
                case TYPE_BOOLEAN: ((bool *)to)[k] = ((const fmi3Boolean *)values)[next]; break;
            }
        }
    }
    return accept_tuned(component, function, &before);
}

/* STATUS_OK where all the variables may be set now: a wrong one leaves the others as they are. Tunable parameters are set
 * already then. */
static inline Status prepare_set(Component *component, const char *function, VariableType type,
    const fmi3ValueReference references[], size_t count, const void *values, size_t value_count)
{
    const Status status = check_mode(component, function, MODE_SETTABLE);
    if (status != STATUS_OK) return status;
    if (count > 0 && (references == NULL || values == NULL)) return refuse_null(component, function, references);
    const bool stepping = component->now.mode == MODE_STEP;
    const uint32_t trait = stepping ? SET_BETWEEN_STEPS : SET_BEFORE_STEPS;
    bool tunes = false;
    size_t elements = 0;
    for (size_t i = 0; i < count; i++) {
        const fmi3ValueReference reference = references[i];
        if (reference > TIME_REFERENCE) return refuse_reference(component, function, reference);
        if (reference == TIME_REFERENCE) return fail(component, "%s: time is the independent variable", function);
        if (VARIABLES[reference].type != type) return refuse_type(component, function, reference);
        const uint32_t traits = ELEMENTS[VARIABLES[reference].first].traits;
        if ((traits & trait) == 0) {
            if ((traits & TUNABLE) == 0) return refuse_set(component, function, reference, traits);
            tunes = true;
        }
        elements += VARIABLES[reference].size;
    }
    if (elements != value_count) return refuse_sizes(component, function, elements, value_count);
    if (tunes) return tune(component, function, type, references, count, values);
    if (!stepping) component->now.unsettled = true;
    return STATUS_OK;
}

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference references[], size_t count,
    fmi3Float64 values[], size_t value_count)
{
    Component *component = instance_of(instance);
    const Status status =
        prepare_get(component, "fmi3GetFloat64", TYPE_FLOAT64, references, count, values, value_count);
    if (status != STATUS_OK) return status;
    for (size_t i = 0; i < count; i++) {
        if (references[i] == TIME_REFERENCE) {
            *values++ = component->now.time;
            continue;
        }
        const double *from = (const double *)elements_of(instance, references[i]);
        for (uint32_t k = 0; k < VARIABLES[references[i]].size; k++) *values++ = from[k];
    }
    return STATUS_OK;
}

fmi3Status fmi3GetInt32(fmi3Instance instance, const fmi3ValueReference references[], size_t count,
    fmi3Int32 values[], size_t value_count)
{
    Component *component = instance_of(instance);
    const Status status = prepare_get(component, "fmi3GetInt32", TYPE_INT32, references, count, values, value_count);
    if (status != STATUS_OK) return status;
    for (size_t i = 0; i < count; i++) {
        const int64_t *from = (const int64_t *)elements_of(instance, references[i]);
        for (uint32_t k = 0; k < VARIABLES[references[i]].size; k++) {
            if (from[k] < INT32_MIN || from[k] > INT32_MAX) {
                return refuse_wide(component, references[i], from[k], "Int32");
            }
            *values++ = (fmi3Int32)from[k];
        }
    }
    return STATUS_OK;
}

/* The getter of a type whose values C makes of the block's elements, which are of the type `Stored`. */
#define GETTER(Type, TYPE, Stored)                                                                                    \
    fmi3Status fmi3Get##Type(fmi3Instance instance, const fmi3ValueReference references[], size_t count,              \
        fmi3##Type values[], size_t value_count)                                                                      \
    {                                                                                                                 \
        const Status status =                                                                                         \
            prepare_get(instance_of(instance), "fmi3Get" #Type, TYPE, references, count, values, value_count);        \
        if (status != STATUS_OK) return status;                                                                       \
        for (size_t i = 0; i < count; i++) {                                                                          \
            const Stored *from = (const Stored *)elements_of(instance, references[i]);                                \
            for (uint32_t k = 0; k < VARIABLES[references[i]].size; k++) *values++ = from[k];                         \
        }                                                                                                             \
        return STATUS_OK;                                                                                             \
    }

GETTER(Int64, TYPE_ENUMERATION, int64_t)
GETTER(Boolean, TYPE_BOOLEAN, bool)

#define SETTER(Type, TYPE, Stored)                                                                                    \
    fmi3Status fmi3Set##Type(fmi3Instance instance, const fmi3ValueReference references[], size_t count,              \
        const fmi3##Type values[], size_t value_count)                                                                \
    {                                                                                                                 \
        const Status status =                                                                                         \
            prepare_set(instance_of(instance), "fmi3Set" #Type, TYPE, references, count, values, value_count);        \
        if (status != STATUS_OK) return status;                                                                       \
        for (size_t i = 0; i < count; i++) {                                                                          \
            Stored *to = (Stored *)elements_of(instance, references[i]);                                              \
            for (uint32_t k = 0; k < VARIABLES[references[i]].size; k++) to[k] = *values++;                           \
        }                                                                                                             \
        return STATUS_OK;                                                                                             \
    }

SETTER(Float64, TYPE_FLOAT64, double)
SETTER(Int32, TYPE_INT32, int64_t)
SETTER(Int64, TYPE_ENUMERATION, int64_t)
SETTER(Boolean, TYPE_BOOLEAN, bool)

#endif
