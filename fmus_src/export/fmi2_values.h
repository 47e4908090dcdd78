/* Getting and setting variables by value reference. */
#ifndef FMI2_VALUES_H
#define FMI2_VALUES_H

static const char *kind_name(Kind kind)
{
    return kind == KIND_REAL ? "Real" : kind == KIND_INTEGER ? "Integer" : "Boolean";
}

/* fmi2OK where all references name variables of the kind. */
static fmi2Status check_references(const Component *component, const char *function, Kind kind,
    const fmi2ValueReference references[], size_t count, const void *values)
{
    if (count > 0 && (references == NULL || values == NULL)) {
        return fail(component, "%s: %s is NULL", function, references == NULL ? "vr" : "value");
    }
    for (size_t i = 0; i < count; i++) {
        const fmi2ValueReference reference = references[i];
        if (reference >= ELEMENT_COUNT) {
            return fail(component, "%s: there is no variable with value reference %u", function, reference);
        }
        if (ELEMENTS[reference].kind != kind) {
            return fail(component, "%s: %s is of type %s", function, ELEMENTS[reference].name,
                kind_name(ELEMENTS[reference].kind));
        }
    }
    return fmi2OK;
}

static fmi2Status prepare_get(Component *component, const char *function, Kind kind,
    const fmi2ValueReference references[], size_t count, const void *values)
{
    fmi2Status status = check_mode(component, function, MODE_READABLE);
    if (status == fmi2OK) status = check_references(component, function, kind, references, count, values);
    if (status == fmi2OK && component->now.unsettled && component->now.mode == MODE_INITIALIZATION) {
        status = settle(component);
    }
    return status;
}

static fmi2Status prepare_set(Component *component, const char *function, Kind kind,
    const fmi2ValueReference references[], size_t count, const void *values)
{
    fmi2Status status = check_mode(component, function, MODE_SETTABLE);
    if (status == fmi2OK) status = check_references(component, function, kind, references, count, values);
    if (status != fmi2OK) return status;
    for (size_t i = 0; i < count; i++) {
        const Element *element = &ELEMENTS[references[i]];
        if (element->role == ROLE_OUTPUT || element->role == ROLE_STATE) {
            return fail(component, "%s: %s is computed and cannot be set", function, element->name);
        }
        if (element->role == ROLE_PARAMETER && component->now.mode == MODE_STEP) {
            return fail(component, "%s: %s is a parameter, fixed after initialisation", function, element->name);
        }
    }
    if (component->now.mode != MODE_STEP) component->now.unsettled = true;
    return fmi2OK;
}

static void *element_of(Component *component, fmi2ValueReference reference)
{
    return (char *)&component->now.block + ELEMENTS[reference].offset;
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Real value[])
{
    const fmi2Status status = prepare_get(c, "fmi2GetReal", KIND_REAL, vr, nvr, value);
    if (status != fmi2OK) return status;
    for (size_t i = 0; i < nvr; i++) value[i] = *(const double *)element_of(c, vr[i]);
    return fmi2OK;
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Integer value[])
{
    Component *component = c;
    const fmi2Status status = prepare_get(c, "fmi2GetInteger", KIND_INTEGER, vr, nvr, value);
    if (status != fmi2OK) return status;
    for (size_t i = 0; i < nvr; i++) {
        const int64_t wide = *(const int64_t *)element_of(c, vr[i]);
        if (wide < INT32_MIN || wide > INT32_MAX) {
            component->now.mode = MODE_ERROR;
            return fail(component, "OverflowError: %s = %" PRId64 " exceeds an FMI Integer's 32 bits",
                ELEMENTS[vr[i]].name, wide);
        }
        value[i] = (fmi2Integer)wide;
    }
    return fmi2OK;
}

fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Boolean value[])
{
    const fmi2Status status = prepare_get(c, "fmi2GetBoolean", KIND_BOOLEAN, vr, nvr, value);
    if (status != fmi2OK) return status;
    for (size_t i = 0; i < nvr; i++) value[i] = *(const bool *)element_of(c, vr[i]) ? fmi2True : fmi2False;
    return fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Real value[])
{
    const fmi2Status status = prepare_set(c, "fmi2SetReal", KIND_REAL, vr, nvr, value);
    if (status != fmi2OK) return status;
    for (size_t i = 0; i < nvr; i++) *(double *)element_of(c, vr[i]) = value[i];
    return fmi2OK;
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Integer value[])
{
    const fmi2Status status = prepare_set(c, "fmi2SetInteger", KIND_INTEGER, vr, nvr, value);
    if (status != fmi2OK) return status;
    for (size_t i = 0; i < nvr; i++) *(int64_t *)element_of(c, vr[i]) = value[i];
    return fmi2OK;
}

fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Boolean value[])
{
    const fmi2Status status = prepare_set(c, "fmi2SetBoolean", KIND_BOOLEAN, vr, nvr, value);
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
    return no_strings(c, "fmi2GetString", MODE_READABLE, nvr);
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2String value[])
{
    (void)vr;
    (void)value;
    return no_strings(c, "fmi2SetString", MODE_SETTABLE, nvr);
}

/* ---- derivatives: modelDescription.xml declares none of these ---- */

static fmi2Status not_provided(const Component *component, const char *function)
{
    if (component == NULL) return fmi2Error;
    return fail(component, "%s: this FMU does not provide it, see modelDescription.xml", function);
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference unknown[], size_t unknown_count,
    const fmi2ValueReference known[], size_t known_count, const fmi2Real known_change[], fmi2Real unknown_change[])
{
    (void)unknown, (void)unknown_count, (void)known, (void)known_count, (void)known_change, (void)unknown_change;
    return not_provided(c, "fmi2GetDirectionalDerivative");
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
    const fmi2Integer order[], const fmi2Real value[])
{
    (void)vr, (void)nvr, (void)order, (void)value;
    return not_provided(c, "fmi2SetRealInputDerivatives");
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
    const fmi2Integer order[], fmi2Real value[])
{
    (void)vr, (void)nvr, (void)order, (void)value;
    return not_provided(c, "fmi2GetRealOutputDerivatives");
}

#endif
