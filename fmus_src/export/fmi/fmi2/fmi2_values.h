/* FMI 2.0: getting and setting variables by value reference. */
#ifndef FMI2_VALUES_H
#define FMI2_VALUES_H

#include "life_cycle.h"

static const char *kind_name(uint32_t kind)
{
    return kind == KIND_REAL ? "Real" : kind == KIND_INTEGER ? "Integer" : "Boolean";
}

/* Log why an element that lacks some of the traits is refused, and return fmi2Error. */
static COLD fmi2Status refuse(
    const Component *component, const char *function, uint32_t traits, fmi2ValueReference reference)
{
    if (reference >= ELEMENT_COUNT) {
        return fail(component, "%s: there is no variable with value reference %u", function, reference);
    }
    const Element element = ELEMENTS[reference];
    if ((element.traits & traits & KIND_ANY) == 0) {
        return fail(component, "%s: %s is of type %s", function, NAMES[reference], kind_name(element.traits & KIND_ANY));
    }
    return refuse_set(component, function, reference, element.traits);
}

static COLD fmi2Status refuse_null(const Component *component, const char *function, const void *references)
{
    return fail(component, "%s: %s is NULL", function, references == NULL ? "vr" : "value");
}

static inline bool has_traits(fmi2ValueReference reference, uint32_t traits)
{
    return reference < ELEMENT_COUNT && (ELEMENTS[reference].traits & traits) == traits;
}

/* Whether the references are those of elements side by side, all with the traits: what an importer asks for in every
 * step is, as a rule, and one test of the first then takes the place of one for each. */
static inline bool lie_alike(const fmi2ValueReference references[], size_t count, uint32_t traits)
{
    if (count == 0 || !has_traits(references[0], traits) || ELEMENTS[references[0]].alike < count) return false;
    uint32_t strays = 0;
    for (size_t i = 1; i < count; i++) strays |= references[i] ^ (references[0] + (uint32_t)i);
    return strays == 0;
}

/* fmi2OK where values may be read now, settled if initialisation is under way. */
static inline fmi2Status prepare_get(
    Component *component, const char *function, const fmi2ValueReference references[], size_t count, const void *values)
{
    const fmi2Status status = check_mode(component, function, MODE_READABLE);
    if (status != fmi2OK) return status;
    if (count > 0 && (references == NULL || values == NULL)) return refuse_null(component, function, references);
    if (component->now.unsettled && component->now.mode == MODE_INITIALIZATION) return settle(component);
    return fmi2OK;
}

static inline void *element_of(fmi2Component c, fmi2ValueReference reference)
{
    return (char *)&instance_of(c)->now.block + ELEMENTS[reference].offset;
}

/* Set elements of which some are tunable parameters, between steps. */
static COLD fmi2Status tune(Component *component, const char *function, Trait kind,
    const fmi2ValueReference references[], size_t count, const void *values)
{
    const Block before = component->now.block;
    for (size_t i = 0; i < count; i++) {
        void *to = element_of(component, references[i]);
        if (kind == KIND_REAL) *(double *)to = ((const fmi2Real *)values)[i];
        if (kind == KIND_INTEGER) *(int64_t *)to = ((const fmi2Integer *)values)[i];
        if (kind == KIND_BOOLEAN) *(bool *)to = ((const fmi2Boolean *)values)[i] != fmi2False;
    }
    return accept_tuned(component, function, &before);
}

/* fmi2OK where all the referenced elements may be set now: a wrong one leaves the others as they are. Tunable parameters
 * are set already then. */
static inline fmi2Status prepare_set(Component *component, const char *function, Trait kind,
    const fmi2ValueReference references[], size_t count, const void *values)
{
    const fmi2Status status = check_mode(component, function, MODE_SETTABLE);
    if (status != fmi2OK) return status;
    if (count > 0 && (references == NULL || values == NULL)) return refuse_null(component, function, references);
    const bool stepping = component->now.mode == MODE_STEP;
    const uint32_t traits = kind | (stepping ? SET_BETWEEN_STEPS : SET_BEFORE_STEPS);
    bool tunes = false;
    for (size_t i = 0; i < count; i++) {
        if (has_traits(references[i], traits)) continue;
        if (!has_traits(references[i], kind | TUNABLE)) return refuse(component, function, traits, references[i]);
        tunes = true;
    }
    if (tunes) return tune(component, function, kind, references, count, values);
    if (!stepping) component->now.unsettled = true;
    return fmi2OK;
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Real value[])
{
    const fmi2Status status = prepare_get(instance_of(c), "fmi2GetReal", vr, nvr, value);
    if (status != fmi2OK) return status;
    if (lie_alike(vr, nvr, KIND_REAL)) {
        const double *from = (const double *)element_of(c, vr[0]);
        for (size_t i = 0; i < nvr; i++) value[i] = from[i];
        return fmi2OK;
    }
    for (size_t i = 0; i < nvr; i++) {
        if (!has_traits(vr[i], KIND_REAL)) return refuse(instance_of(c), "fmi2GetReal", KIND_REAL, vr[i]);
        value[i] = *(const double *)element_of(c, vr[i]);
    }
    return fmi2OK;
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Integer value[])
{
    const fmi2Status status = prepare_get(instance_of(c), "fmi2GetInteger", vr, nvr, value);
    if (status != fmi2OK) return status;
    for (size_t i = 0; i < nvr; i++) {
        if (!has_traits(vr[i], KIND_INTEGER)) return refuse(instance_of(c), "fmi2GetInteger", KIND_INTEGER, vr[i]);
        const int64_t wide = *(const int64_t *)element_of(c, vr[i]);
        if (wide < INT32_MIN || wide > INT32_MAX) return refuse_wide(instance_of(c), vr[i], wide, "Integer");
        value[i] = (fmi2Integer)wide;
    }
    return fmi2OK;
}

fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Boolean value[])
{
    const fmi2Status status = prepare_get(instance_of(c), "fmi2GetBoolean", vr, nvr, value);
    if (status != fmi2OK) return status;
    for (size_t i = 0; i < nvr; i++) {
        if (!has_traits(vr[i], KIND_BOOLEAN)) return refuse(instance_of(c), "fmi2GetBoolean", KIND_BOOLEAN, vr[i]);
        value[i] = *(const bool *)element_of(c, vr[i]) ? fmi2True : fmi2False;
    }
    return fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Real value[])
{
    Component *component = instance_of(c);
    if (component != NULL && component->now.mode == MODE_STEP && vr != NULL && value != NULL
        && lie_alike(vr, nvr, KIND_REAL | SET_BETWEEN_STEPS)) {
        double *to = (double *)element_of(c, vr[0]);
        for (size_t i = 0; i < nvr; i++) to[i] = value[i];
        return fmi2OK;
    }
    const fmi2Status status = prepare_set(component, "fmi2SetReal", KIND_REAL, vr, nvr, value);
    if (status != fmi2OK) return status;
    for (size_t i = 0; i < nvr; i++) *(double *)element_of(c, vr[i]) = value[i];
    return fmi2OK;
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Integer value[])
{
    const fmi2Status status = prepare_set(instance_of(c), "fmi2SetInteger", KIND_INTEGER, vr, nvr, value);
    if (status != fmi2OK) return status;
    for (size_t i = 0; i < nvr; i++) *(int64_t *)element_of(c, vr[i]) = value[i];
    return fmi2OK;
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Boolean value[])
{
    const fmi2Status status = prepare_set(instance_of(c), "fmi2SetBoolean", KIND_BOOLEAN, vr, nvr, value);
    if (status != fmi2OK) return status;
    for (size_t i = 0; i < nvr; i++) *(bool *)element_of(c, vr[i]) = value[i] != fmi2False;
    return fmi2OK;
}

/* A block has no String variables, so only an empty list of them can be right. */
static fmi2Status no_strings(const Component *component, const char *function, int allowed, size_t count)
{
    const fmi2Status status = check_mode(component, function, allowed);
    if (status == fmi2OK && count > 0) return fail(component, "%s: there are no String variables", function);
    return status;
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2String value[])
{
    (void)vr;
    (void)value;
    return no_strings(instance_of(c), "fmi2GetString", MODE_READABLE, nvr);
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2String value[])
{
    (void)vr;
    (void)value;
    return no_strings(instance_of(c), "fmi2SetString", MODE_SETTABLE, nvr);
}

/* ---- not of FMI ---- */

#ifdef FMI2_FUNCTION_PREFIX
#define perilune_place fmi2FullName(perilune_place)
#endif

/* Where Booleans (kind 0; C's bool), Reals (1; doubles) or Integers (2; int64_t, which FMI's functions refuse beyond 32
 * bits) with these references lie side by side in the instance, all of which may be got or, with `set`, be set between
 * steps; else NULL. An importer in the same process may read and write them there between steps, which is what FMI's
 * functions do then. They stay there as long as the instance. */
#ifdef __cplusplus
extern "C"
#endif
FMI2_Export void *perilune_place(
    fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Integer kind, fmi2Boolean set)
{
    static const uint32_t kinds[] = {KIND_BOOLEAN, KIND_REAL, KIND_INTEGER};
    if (c == NULL || vr == NULL || kind < 0 || kind > 2) return NULL;
    return lie_alike(vr, nvr, kinds[kind] | (set ? SET_BETWEEN_STEPS : 0u)) ? element_of(c, vr[0]) : NULL;
}

/* ---- derivatives: modelDescription.xml declares none of these ---- */

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknown[], size_t unknown_count,
    const fmi2ValueReference known[], size_t known_count, const fmi2Real known_change[], fmi2Real unknown_change[])
{
    (void)unknown, (void)unknown_count, (void)known, (void)known_count, (void)known_change, (void)unknown_change;
    return not_provided(instance_of(c), "fmi2GetDirectionalDerivative");
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
    const fmi2Integer order[], const fmi2Real value[])
{
    (void)vr, (void)nvr, (void)order, (void)value;
    return not_provided(instance_of(c), "fmi2SetRealInputDerivatives");
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
    const fmi2Integer order[], fmi2Real value[])
{
    (void)vr, (void)nvr, (void)order, (void)value;
    return not_provided(instance_of(c), "fmi2GetRealOutputDerivatives");
}

#endif
