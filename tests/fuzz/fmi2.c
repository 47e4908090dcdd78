/* Calls of the functions of a native FMU of FMI 2.0 in any order, with any values: `bytes.h` says how. */
#include <stdarg.h>

#include "fmi2Functions.h"

#include "bytes.h"

static void logger(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status, fmi2String category,
    fmi2String message, ...)
{
    char text[4096];
    va_list arguments;
    (void)environment, (void)instance, (void)status, (void)category;
    va_start(arguments, message);
    vsnprintf(text, sizeof text, message, arguments);
    va_end(arguments);
}

static const fmi2CallbackFunctions callbacks = {logger, calloc, free, NULL, NULL};
static fmi2ValueReference references[AT_ONCE];
static fmi2Real reals[AT_ONCE];
static fmi2Integer whole[AT_ONCE];
static fmi2String texts[AT_ONCE];

/* So many value references, most of them of the FMU. */
static size_t choose(void)
{
    const size_t count = below(AT_ONCE + 1);
    for (size_t i = 0; i < count; i++) {
        references[i] = choose_reference();
        reals[i] = number();
        whole[i] = whole_number();
        texts[i] = below(2) ? "" : "text";
    }
    return count;
}

static void mangle_state(fmi2Component fmu, fmi2FMUstate *state)
{
    size_t size = 0;
    if (fmi2SerializedFMUstateSize(fmu, *state, &size) != fmi2OK) return;
    fmi2Byte *bytes = malloc(size);
    if (fmi2SerializeFMUstate(fmu, *state, bytes, size) == fmi2OK) {
        size = mangle(bytes, size);
        bytes = realloc(bytes, size); /* so that the sanitizer sees what is beyond */
        fmi2DeSerializeFMUstate(fmu, bytes, size, state);
    }
    free(bytes);
}

static void step(fmi2Component fmu, double *time)
{
    const double size = step_size(), point = below(8) ? *time : number();
    if (fmi2DoStep(fmu, point, size, fmi2True) == fmi2OK) *time = point + size;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fmi2Component fmus[INSTANCES] = {NULL};
    fmi2FMUstate states[STATES] = {NULL};
    double times[INSTANCES] = {0.0};
    next = data;
    left = size;
    while (left > 0) {
        const unsigned which = below(INSTANCES), state = below(STATES);
        fmi2Component *fmu = &fmus[which];
        if (*fmu == NULL) {
            *fmu = fmi2Instantiate(below(16) ? "fmu" : "", fmi2CoSimulation, below(16) ? GUID : "other", NULL, &callbacks,
                fmi2False, fmi2True);
            times[which] = 0.0;
            if (*fmu != NULL && below(4)) {
                fmi2SetupExperiment(*fmu, fmi2False, 0.0, 0.0, fmi2False, 0.0);
                fmi2EnterInitializationMode(*fmu);
                if (below(4)) fmi2ExitInitializationMode(*fmu);
            }
            continue;
        }
        switch (below(18)) {
        case 0: fmi2SetupExperiment(*fmu, below(2), number(), number(), below(2), number()); break;
        case 1: fmi2EnterInitializationMode(*fmu); break;
        case 2: fmi2ExitInitializationMode(*fmu); break;
        case 3: case 4: case 5: step(*fmu, &times[which]); break;
        case 6: { const size_t count = choose(); fmi2SetReal(*fmu, references, count, reals); break; }
        case 7: { const size_t count = choose(); fmi2SetInteger(*fmu, references, count, whole); break; }
        case 8: { const size_t count = choose(); fmi2SetBoolean(*fmu, references, count, whole); break; }
        case 9: { const size_t count = choose(); fmi2SetString(*fmu, references, count, texts); break; }
        case 10: { const size_t count = choose(); fmi2GetReal(*fmu, references, count, reals); break; }
        case 11: {
            const size_t count = choose();
            fmi2GetInteger(*fmu, references, count, whole);
            fmi2GetBoolean(*fmu, references, count, whole);
            fmi2GetString(*fmu, references, count, texts);
            break;
        }
        case 12: fmi2GetFMUstate(*fmu, &states[state]); break;
        case 13: if (states[state] != NULL) fmi2SetFMUstate(*fmu, states[state]); break;
        case 14: if (states[state] != NULL) mangle_state(*fmu, &states[state]); break;
        case 15: fmi2Reset(*fmu); times[which] = 0.0; break;
        case 16: fmi2Terminate(*fmu); break;
        case 17: fmi2FreeInstance(*fmu); *fmu = NULL; break;
        }
    }
    fmi2Component last = fmi2Instantiate("last", fmi2CoSimulation, GUID, NULL, &callbacks, fmi2False, fmi2False);
    for (size_t i = 0; i < STATES; i++) fmi2FreeFMUstate(last, &states[i]);
    fmi2FreeInstance(last);
    for (size_t i = 0; i < INSTANCES; i++) if (fmus[i] != NULL) fmi2FreeInstance(fmus[i]);
    return 0;
}
