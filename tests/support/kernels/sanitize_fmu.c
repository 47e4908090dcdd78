/* Drives one FMU through right and wrong calls, to be compiled together with it under sanitizers.
 *
 *     sanitize_fmu GUID KINDS CAUSALITIES STEP COUNT
 *
 * KINDS has a letter r, i or b (Real, Integer, Boolean) per value reference, CAUSALITIES a letter
 * p, i, o or l (parameter, input, output, local). Inputs are random, some of them infinite or NaN.
 * The sanitizers watch memory and arithmetic; this program watches the answers.
 */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "../native/checks.h"
#include "drive_fmu.h"

static const char *guid, *kinds, *causalities;
static size_t size; /* number of variables */
static double step;

/* Formats every message, as an importer would. */
static void logger(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status, fmi2String category,
    fmi2String message, ...)
{
    char text[2048];
    va_list arguments;
    va_start(arguments, message);
    vsnprintf(text, sizeof text, message, arguments);
    va_end(arguments);
    check(environment == &failures && instance != NULL && category[0] != '\0' && status == fmi2Error
            && text[0] != '\0', "a message lacks a part");
}

static const fmi2CallbackFunctions callbacks = {logger, NULL, NULL, NULL, &failures};
static const fmi2CallbackFunctions silent = {NULL, NULL, NULL, NULL, NULL};

static fmi2Component instance(const fmi2CallbackFunctions *functions)
{
    const char *name = "an instance with a name that is longer than what alignment leaves room for";
    fmi2Component fmu = fmi2Instantiate(name, fmi2CoSimulation, guid, NULL, functions, fmi2False, fmi2True);
    if (fmu == NULL) exit(2);
    return fmu;
}

/* ---- random values ---- */

static double uniform(double from, double to)
{
    return from + (to - from) * (double)draw(1 << 30) / (1 << 30);
}

static double number(void)
{
    const double odd[] = {0.0, -0.0, 1.0, -1.0, 1e-310, 1e300, -1e308, INFINITY, -INFINITY, NAN};
    if (draw(200) == 0) return odd[draw(sizeof odd / sizeof odd[0])];
    return uniform(-1.0, 1.0) * pow(10.0, uniform(-2.0, 4.0));
}

/* All variables' bytes; those of an instance after an error are the bytes left by its last step. */
static void read_all(fmi2Component fmu, Value *values)
{
    for (size_t i = 0; i < size; i++) get(fmu, (fmi2ValueReference)i, kinds[i], &values[i]);
}

/* ---- life cycle ---- */

static fmi2Status initialise(fmi2Component fmu)
{
    EXPECT(fmi2OK, fmi2SetupExperiment(fmu, fmi2False, 0.0, 0.0, fmi2True, 1e6));
    EXPECT(fmi2OK, fmi2EnterInitializationMode(fmu));
    return fmi2ExitInitializationMode(fmu);
}

/* A step with new inputs in both instances, which must agree to the last bit; fmi2OK or fmi2Error. */
static fmi2Status step_both(fmi2Component one, fmi2Component other, int n, Value *values, Value *other_values)
{
    for (size_t i = 0; i < size; i++) {
        if (causalities[i] != 'i') continue;
        const Value value = draw_value(kinds[i]);
        EXPECT(fmi2OK, set(one, (fmi2ValueReference)i, kinds[i], &value));
        EXPECT(fmi2OK, set(other, (fmi2ValueReference)i, kinds[i], &value));
    }
    const fmi2Status status = fmi2DoStep(one, n * step, step, fmi2False);
    EXPECT(status, fmi2DoStep(other, n * step, step, fmi2False));
    check(status == fmi2OK || status == fmi2Error, "a step ended with another status than OK or Error");
    fmi2Real time = 0.0, other_time = 0.0;
    EXPECT(fmi2OK, fmi2GetRealStatus(one, fmi2LastSuccessfulTime, &time));
    EXPECT(fmi2OK, fmi2GetRealStatus(other, fmi2LastSuccessfulTime, &other_time));
    check(time == other_time, "the times of two instances differ");
    read_all(one, values);
    read_all(other, other_values);
    check(memcmp(values, other_values, size * sizeof(Value)) == 0, "two instances differ");
    return status;
}

/* ---- wrong calls ---- */

static void wrong_instantiation(void)
{
    const char *name = "fmu";
    check(fmi2Instantiate(name, fmi2CoSimulation, guid, NULL, NULL, 0, 0) == NULL, "callbacks NULL accepted");
    check(fmi2Instantiate(NULL, fmi2CoSimulation, guid, NULL, &callbacks, 0, 0) == NULL, "name NULL accepted");
    check(fmi2Instantiate(name, fmi2CoSimulation, NULL, NULL, &callbacks, 0, 0) == NULL, "GUID NULL accepted");
    check(fmi2Instantiate(name, fmi2CoSimulation, "{1}", NULL, &callbacks, 0, 0) == NULL, "wrong GUID accepted");
    check(fmi2Instantiate(name, fmi2CoSimulation, "{1}", NULL, &silent, 0, 0) == NULL, "wrong GUID accepted");
    check(fmi2Instantiate(name, fmi2ModelExchange, guid, NULL, &callbacks, 0, 0) == NULL, "model exchange accepted");
}

/* Wrong in every state of the life cycle. */
static void wrong_arguments(fmi2Component fmu)
{
    const fmi2ValueReference beyond[] = {(fmi2ValueReference)size, UINT32_MAX};
    const fmi2ValueReference first = 0;
    const char all_kinds[] = "rib";
    size_t length = 0;
    fmi2Status status;
    fmi2String text = NULL;
    fmi2FMUstate state = NULL;
    fmi2Byte byte = 0;
    Value value = draw_value('r');
    for (int k = 0; k < 3; k++) {
        EXPECT(fmi2Error, get(NULL, 0, all_kinds[k], &value));
        EXPECT(fmi2Error, set(NULL, 0, all_kinds[k], &value));
        for (int j = 0; j < 2; j++) {
            EXPECT(fmi2Error, get(fmu, beyond[j], all_kinds[k], &value));
            EXPECT(fmi2Error, set(fmu, beyond[j], all_kinds[k], &value));
        }
        for (size_t i = 0; i < size; i++) {
            if (kinds[i] == all_kinds[k] && causalities[i] != 'o' && causalities[i] != 'l') continue;
            if (kinds[i] != all_kinds[k]) EXPECT(fmi2Error, get(fmu, (fmi2ValueReference)i, all_kinds[k], &value));
            EXPECT(fmi2Error, set(fmu, (fmi2ValueReference)i, all_kinds[k], &value));
        }
    }
    EXPECT(fmi2Error, fmi2GetReal(fmu, NULL, 1, &value.real));
    EXPECT(fmi2Error, fmi2GetReal(fmu, &first, 1, NULL));
    EXPECT(fmi2Error, fmi2GetInteger(fmu, NULL, 1, &value.integer));
    EXPECT(fmi2Error, fmi2GetBoolean(fmu, &first, 1, NULL));
    EXPECT(fmi2Error, fmi2SetReal(fmu, NULL, 1, &value.real));
    EXPECT(fmi2Error, fmi2SetReal(fmu, &first, 1, NULL));
    EXPECT(fmi2Error, fmi2SetInteger(fmu, &first, 1, NULL));
    EXPECT(fmi2Error, fmi2SetBoolean(fmu, NULL, 1, &value.boolean));
    EXPECT(fmi2Error, fmi2GetString(fmu, &first, 1, &text));
    EXPECT(fmi2Error, fmi2SetString(fmu, &first, 1, &text));
    EXPECT(fmi2Error, fmi2SetDebugLogging(fmu, fmi2True, 1, NULL));
    EXPECT(fmi2Error, fmi2SetDebugLogging(fmu, fmi2True, 1, &text));
    EXPECT(fmi2OK, fmi2SetDebugLogging(fmu, fmi2True, 0, NULL));
    EXPECT(fmi2Error, fmi2SetupExperiment(fmu, fmi2False, 0.0, NAN, fmi2False, 0.0));
    EXPECT(fmi2Error, fmi2SetupExperiment(fmu, fmi2False, 0.0, 1.0, fmi2True, 0.0));
    EXPECT(fmi2Error, fmi2DoStep(fmu, 0.0, 0.0, fmi2True));
    EXPECT(fmi2Error, fmi2DoStep(fmu, 0.0, -step, fmi2True));
    EXPECT(fmi2Error, fmi2DoStep(fmu, NAN, step, fmi2True));
    EXPECT(fmi2Error, fmi2DoStep(fmu, 0.0, INFINITY, fmi2True));
    EXPECT(fmi2Error, fmi2DoStep(NULL, 0.0, step, fmi2True));
    EXPECT(fmi2Error, fmi2CancelStep(fmu));
    EXPECT(fmi2Error, fmi2GetStatus(fmu, fmi2DoStepStatus, NULL));
    EXPECT(fmi2Discard, fmi2GetStatus(fmu, fmi2PendingStatus, &status));
    EXPECT(fmi2Error, fmi2GetRealStatus(NULL, fmi2LastSuccessfulTime, &value.real));
    EXPECT(fmi2Error, fmi2GetBooleanStatus(fmu, fmi2Terminated, NULL));
    EXPECT(fmi2Discard, fmi2GetIntegerStatus(fmu, fmi2PendingStatus, &value.integer));
    EXPECT(fmi2Discard, fmi2GetStringStatus(fmu, fmi2PendingStatus, &text));
    EXPECT(fmi2Error, fmi2GetDirectionalDerivative(fmu, &first, 1, &first, 1, &value.real, &value.real));
    EXPECT(fmi2Error, fmi2SetRealInputDerivatives(fmu, &first, 1, &value.integer, &value.real));
    EXPECT(fmi2Error, fmi2GetRealOutputDerivatives(fmu, &first, 1, &value.integer, &value.real));
    EXPECT(fmi2Error, fmi2GetFMUstate(fmu, NULL));
    EXPECT(fmi2Error, fmi2GetFMUstate(NULL, &state));
    EXPECT(fmi2Error, fmi2SetFMUstate(fmu, NULL));
    EXPECT(fmi2OK, fmi2FreeFMUstate(fmu, NULL));
    EXPECT(fmi2OK, fmi2FreeFMUstate(fmu, &state));
    EXPECT(fmi2Error, fmi2SerializedFMUstateSize(fmu, NULL, &length));
    EXPECT(fmi2Error, fmi2SerializeFMUstate(fmu, NULL, &byte, 1));
    EXPECT(fmi2Error, fmi2DeSerializeFMUstate(fmu, NULL, 0, &state));
    EXPECT(fmi2Error, fmi2DeSerializeFMUstate(fmu, &byte, 1, &state));
    EXPECT(fmi2Error, fmi2DeSerializeFMUstate(fmu, &byte, 0, NULL));
    EXPECT(fmi2Error, fmi2Terminate(NULL));
    EXPECT(fmi2Error, fmi2Reset(NULL));
}

/* Right arguments, wrong moment. */
static void wrong_moments(void)
{
    Value value;
    fmi2Component fmu = instance(&callbacks);
    wrong_arguments(fmu);
    EXPECT(fmi2Error, get(fmu, 0, kinds[0], &value));
    EXPECT(fmi2Error, fmi2ExitInitializationMode(fmu));
    EXPECT(fmi2Error, fmi2DoStep(fmu, 0.0, step, fmi2True));
    EXPECT(fmi2Error, fmi2Terminate(fmu));
    EXPECT(fmi2OK, fmi2EnterInitializationMode(fmu));
    wrong_arguments(fmu);
    EXPECT(fmi2OK, get(fmu, 0, kinds[0], &value));
    EXPECT(fmi2Error, fmi2EnterInitializationMode(fmu));
    EXPECT(fmi2Error, fmi2SetupExperiment(fmu, fmi2False, 0.0, 0.0, fmi2False, 0.0));
    EXPECT(fmi2Error, fmi2DoStep(fmu, 0.0, step, fmi2True));
    EXPECT(fmi2OK, fmi2ExitInitializationMode(fmu));
    wrong_arguments(fmu);
    EXPECT(fmi2Error, fmi2ExitInitializationMode(fmu));
    for (size_t i = 0; i < size; i++) {
        if (causalities[i] != 'p' && causalities[i] != 't') continue; /* t: a tunable one */
        EXPECT(fmi2OK, get(fmu, (fmi2ValueReference)i, kinds[i], &value));
        EXPECT(causalities[i] == 't' ? fmi2OK : fmi2Error, set(fmu, (fmi2ValueReference)i, kinds[i], &value));
    }
    EXPECT(fmi2OK, fmi2Terminate(fmu));
    wrong_arguments(fmu);
    EXPECT(fmi2OK, get(fmu, 0, kinds[0], &value));
    EXPECT(fmi2Error, fmi2DoStep(fmu, 0.0, step, fmi2True));
    EXPECT(fmi2OK, fmi2Reset(fmu));
    EXPECT(fmi2OK, fmi2SetupExperiment(fmu, fmi2False, 0.0, 0.0, fmi2True, 0.5 * step));
    EXPECT(fmi2OK, fmi2EnterInitializationMode(fmu));
    EXPECT(fmi2OK, fmi2ExitInitializationMode(fmu));
    EXPECT(fmi2Error, fmi2DoStep(fmu, 0.0, step, fmi2True)); /* past the stop time */
    EXPECT(fmi2OK, fmi2Reset(fmu));
    EXPECT(fmi2OK, initialise(fmu));
    fmi2FreeInstance(fmu);
    fmi2FreeInstance(NULL);
}

/* ---- states ---- */

/* A state as bytes and back; bytes cut off, foreign or spoilt. */
static void states(fmi2Component fmu)
{
    Value *before = calloc(size, sizeof(Value)), *after = calloc(size, sizeof(Value));
    fmi2FMUstate state = NULL, copy = NULL, spoilt = NULL;
    size_t length = 0;
    read_all(fmu, before);
    EXPECT(fmi2OK, fmi2GetFMUstate(fmu, &state));
    EXPECT(fmi2OK, fmi2GetFMUstate(fmu, &state)); /* into the same place */
    EXPECT(fmi2OK, fmi2SerializedFMUstateSize(fmu, state, &length));
    EXPECT(fmi2Error, fmi2SerializedFMUstateSize(fmu, state, NULL));
    fmi2Byte *bytes = malloc(length);
    EXPECT(fmi2Error, fmi2SerializeFMUstate(fmu, state, bytes, length - 1));
    EXPECT(fmi2Error, fmi2SerializeFMUstate(fmu, state, NULL, length));
    EXPECT(fmi2OK, fmi2SerializeFMUstate(fmu, state, bytes, length));
    EXPECT(fmi2Error, fmi2DeSerializeFMUstate(fmu, bytes, length - 1, &copy));
    EXPECT(fmi2OK, fmi2DeSerializeFMUstate(fmu, bytes, length, &copy));
    EXPECT(fmi2OK, fmi2SetFMUstate(fmu, copy));
    read_all(fmu, after);
    check(memcmp(before, after, size * sizeof(Value)) == 0, "a serialised state differs");
    for (int n = 0; n < 20; n++) { /* whatever the bytes hold, nothing undefined may follow */
        EXPECT(fmi2OK, fmi2SerializeFMUstate(fmu, state, bytes, length));
        spoil(bytes, length);
        if (fmi2DeSerializeFMUstate(fmu, bytes, length, &spoilt) != fmi2OK) continue;
        EXPECT(fmi2OK, fmi2SetFMUstate(fmu, spoilt));
        read_all(fmu, after);
        fmi2DoStep(fmu, 0.0, step, fmi2False);
    }
    memset(bytes, 0, length);
    EXPECT(fmi2Error, fmi2DeSerializeFMUstate(fmu, bytes, length, &copy));
    EXPECT(fmi2OK, fmi2SetFMUstate(fmu, state));
    read_all(fmu, after);
    check(memcmp(before, after, size * sizeof(Value)) == 0, "a restored state differs");
    EXPECT(fmi2OK, fmi2FreeFMUstate(fmu, &state));
    EXPECT(fmi2OK, fmi2FreeFMUstate(fmu, &state));
    EXPECT(fmi2OK, fmi2FreeFMUstate(fmu, &copy));
    EXPECT(fmi2OK, fmi2FreeFMUstate(fmu, &spoilt));
    free(bytes);
    free(before);
    free(after);
}

/* ---- flights ---- */

/* Parameters near their declared starts, the same in both instances, in every second flight. */
static void set_parameters(fmi2Component one, fmi2Component other, const Value *starts)
{
    if (draw(2) == 0) return;
    for (size_t i = 0; i < size; i++) {
        Value value = starts[i];
        if (causalities[i] != 'p' && causalities[i] != 't') continue;
        if (kinds[i] == 'r') value.real = value.real == 0.0 ? step * (double)draw(4) : value.real * uniform(0.5, 1.5);
        if (kinds[i] == 'i') value.integer += (fmi2Integer)draw(3);
        if (kinds[i] == 'b') value.boolean = (fmi2Boolean)draw(2);
        EXPECT(fmi2OK, set(one, (fmi2ValueReference)i, kinds[i], &value));
        EXPECT(fmi2OK, set(other, (fmi2ValueReference)i, kinds[i], &value));
    }
}

/* Two instances side by side; after an error one is reset and the other is put back to a state. */
static void fly(int count)
{
    fmi2Component one = instance(&callbacks), other = instance(&silent);
    Value *values = calloc(size, sizeof(Value)), *other_values = calloc(size, sizeof(Value));
    Value *starts = calloc(size, sizeof(Value));
    fmi2FMUstate fresh = NULL;
    EXPECT(fmi2OK, fmi2GetFMUstate(other, &fresh));
    EXPECT(fmi2OK, initialise(one));
    read_all(one, starts);
    int flights = 0, flown = 0;
    while (flown < count && flights++ < count) {
        EXPECT(fmi2OK, fmi2Reset(one));
        EXPECT(fmi2OK, fmi2SetFMUstate(other, fresh));
        set_parameters(one, other, starts);
        const fmi2Status status = initialise(one);
        EXPECT(status, initialise(other));
        if (status != fmi2OK) continue;
        const int steps = 1 + (int)draw(100);
        for (int n = 0; n < steps && step_both(one, other, n, values, other_values) == fmi2OK; n++) {
            flown++;
            if (draw(20) == 0) states(one);
        }
    }
    check(2 * flown > count, "few steps succeed: this run says little");
    EXPECT(fmi2OK, fmi2FreeFMUstate(other, &fresh));
    fmi2FreeInstance(one);
    fmi2FreeInstance(other);
    free(values);
    free(other_values);
    free(starts);
    printf("%d steps in %d flights\n", flown, flights);
}

int main(int argument_count, char **arguments)
{
    if (argument_count != 6) return 2;
    guid = arguments[1];
    kinds = arguments[2];
    causalities = arguments[3];
    size = strlen(kinds);
    step = atof(arguments[4]);
    wrong_instantiation();
    wrong_moments();
    fly(atoi(arguments[5]));
    return failures == 0 ? 0 : 1;
}
