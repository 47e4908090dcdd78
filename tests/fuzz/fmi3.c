/* Calls of the functions of a native FMU of FMI 3.0 in any order, with any values: `bytes.h` says how.
 *
 * TYPES has a letter f, i, b or e (Float64, Int32, Boolean, Enumeration) per value reference, that of time among them,
 * SIZES the elements with commas between.
 */
#include "fmi3Functions.h"

#include "bytes.h"

static const char types[] = TYPES;
static const size_t sizes[] = {SIZES};

static void logger(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message)
{
    (void)environment, (void)status;
    if (strlen(category) == 0 || strlen(message) == 0) abort();
}

static fmi3ValueReference references[AT_ONCE];

/* So many value references, most of them of one type, which is returned, and of so many values together. */
static char choose(size_t *count, size_t *value_count)
{
    char type = "fibe"[below(4)];
    *count = below(AT_ONCE + 1);
    *value_count = 0;
    for (size_t i = 0; i < *count; i++) {
        fmi3ValueReference reference = choose_reference();
        if (reference < REFERENCES) {
            if (i == 0 && below(8)) type = types[reference];
            for (unsigned n = 1; n < REFERENCES && types[reference] != type; n++) reference = (reference + 1) % REFERENCES;
            *value_count += sizes[reference];
        }
        references[i] = reference;
    }
    if (below(8) == 0) *value_count = *value_count / 2 + below(5);
    return type;
}

/* As long as is said to the FMU, so that the sanitizer sees what is beyond. */
static void *make_values(char type, size_t size)
{
    return calloc(size ? size : 1, type == 'b' ? sizeof(fmi3Boolean) : type == 'i' ? sizeof(fmi3Int32) : 8);
}

static void get(fmi3Instance fmu)
{
    size_t count, size;
    const char type = choose(&count, &size);
    void *values = make_values(type, size);
    switch (type) {
    case 'f': fmi3GetFloat64(fmu, references, count, values, size); break;
    case 'i': fmi3GetInt32(fmu, references, count, values, size); break;
    case 'e': fmi3GetInt64(fmu, references, count, values, size); break;
    case 'b': fmi3GetBoolean(fmu, references, count, values, size); break;
    }
    free(values);
}

static void set(fmi3Instance fmu)
{
    size_t count, size;
    const char type = choose(&count, &size);
    void *values = make_values(type, size);
    for (size_t k = 0; k < size; k++) {
        switch (type) {
        case 'f': ((fmi3Float64 *)values)[k] = number(); break;
        case 'i': ((fmi3Int32 *)values)[k] = whole_number(); break;
        case 'e': ((fmi3Int64 *)values)[k] = below(2) ? whole_number() : INT64_MAX - (int64_t)below(2); break;
        case 'b': ((fmi3Boolean *)values)[k] = below(2); break;
        }
    }
    switch (type) {
    case 'f': fmi3SetFloat64(fmu, references, count, values, size); break;
    case 'i': fmi3SetInt32(fmu, references, count, values, size); break;
    case 'e': fmi3SetInt64(fmu, references, count, values, size); break;
    case 'b': fmi3SetBoolean(fmu, references, count, values, size); break;
    }
    free(values);
}

/* Types and modes that no block has. */
static void call_absent(fmi3Instance fmu)
{
    size_t length = 0;
    fmi3String text = "text";
    fmi3Binary binary = (fmi3Binary)"binary";
    fmi3Boolean flag = false;
    fmi3Float64 real = 0.0;
    references[0] = choose_reference();
    switch (below(8)) {
    case 0: fmi3GetString(fmu, references, below(2), &text, below(2)); break;
    case 1: fmi3SetString(fmu, references, below(2), &text, below(2)); break;
    case 2: fmi3GetBinary(fmu, references, below(2), &length, &binary, below(2)); break;
    case 3: fmi3SetBinary(fmu, references, below(2), &length, &binary, below(2)); break;
    case 4: fmi3SetClock(fmu, references, below(2), &flag); break;
    case 5: fmi3EnterEventMode(fmu); break;
    case 6: fmi3EnterConfigurationMode(fmu); break;
    case 7: fmi3UpdateDiscreteStates(fmu, &flag, &flag, &flag, &flag, &flag, &real); break;
    }
}

static void set_logging(fmi3Instance fmu)
{
    const fmi3String categories[] = {"logAll", "logStatusError", "other", NULL};
    fmi3SetDebugLogging(fmu, below(4) != 0, below(3), below(8) ? &categories[below(3)] : NULL);
}

static void mangle_state(fmi3Instance fmu, fmi3FMUState *state)
{
    size_t size = 0;
    if (fmi3SerializedFMUStateSize(fmu, *state, &size) != fmi3OK) return;
    fmi3Byte *bytes = malloc(size);
    if (fmi3SerializeFMUState(fmu, *state, bytes, size) == fmi3OK) {
        size = mangle(bytes, size);
        bytes = realloc(bytes, size); /* so that the sanitizer sees what is beyond */
        fmi3DeserializeFMUState(fmu, bytes, size, state);
    }
    free(bytes);
}

static void step(fmi3Instance fmu, double *time)
{
    fmi3Boolean event = true, end = true, early = true;
    fmi3Float64 last = NAN;
    const double size = step_size(), point = below(8) ? *time : number();
    const fmi3Status status = fmi3DoStep(fmu, point, size, true, &event, &end, &early, &last);
    if (event || end || early) abort();
    if (status == fmi3OK && last != point + size) abort();
    if (status == fmi3OK) *time = last;
}

static fmi3Instance instantiate(const char *name, const char *token, bool events, bool logging)
{
    return fmi3InstantiateCoSimulation(
        name, token, NULL, false, logging, events, below(2), NULL, 0, NULL, below(8) ? logger : NULL, NULL);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fmi3Instance fmus[INSTANCES] = {NULL};
    fmi3FMUState states[STATES] = {NULL};
    double times[INSTANCES] = {0.0};
    next = data;
    left = size;
    while (left > 0) {
        const unsigned which = below(INSTANCES), state = below(STATES);
        fmi3Instance *fmu = &fmus[which];
        if (*fmu == NULL) {
            const char *name = below(16) ? "fmu" : below(2) ? "" : NULL;
            *fmu = instantiate(name, below(16) ? GUID : below(2) ? "other" : NULL, below(16) == 0, below(4) != 0);
            times[which] = 0.0;
            if (*fmu != NULL && below(4)) {
                fmi3EnterInitializationMode(*fmu, false, 0.0, 0.0, false, 0.0);
                if (below(4)) fmi3ExitInitializationMode(*fmu);
            }
            continue;
        }
        switch (below(18)) {
        case 0: {
            const double start = number();
            if (fmi3EnterInitializationMode(*fmu, below(2), number(), start, below(2), number()) == fmi3OK) times[which] = start;
            break;
        }
        case 1: fmi3ExitInitializationMode(*fmu); break;
        case 2: case 3: case 4: step(*fmu, &times[which]); break;
        case 5: case 6: case 7: set(*fmu); break;
        case 8: case 9: get(*fmu); break;
        case 10: call_absent(*fmu); break;
        case 11: set_logging(*fmu); break;
        case 12: fmi3GetFMUState(*fmu, &states[state]); break;
        case 13: if (states[state] != NULL) fmi3SetFMUState(*fmu, states[state]); break;
        case 14: if (states[state] != NULL) mangle_state(*fmu, &states[state]); break;
        case 15: fmi3Reset(*fmu); times[which] = 0.0; break;
        case 16: fmi3Terminate(*fmu); break;
        case 17: fmi3FreeInstance(*fmu); *fmu = NULL; break;
        }
    }
    fmi3Instance last = instantiate("last", GUID, false, false);
    for (size_t i = 0; i < STATES; i++) fmi3FreeFMUState(last, &states[i]);
    fmi3FreeInstance(last);
    for (size_t i = 0; i < INSTANCES; i++) fmi3FreeInstance(fmus[i]);
    return 0;
}
