/* Calls of a native FMU's functions in any order, with any values: bytes say which.
 *
 * Compiled together with the FMU's source under sanitizers, by clang with libFuzzer, which looks for bytes that come
 * to other code, or with STANDALONE and random bytes:
 *
 *     fmi RUNS SEED
 *
 * GUID, STEP (s, the FMU's own) and VARIABLES (their number) are macros. The FMU may refuse whatever it likes; it
 * may not touch memory of others, divide by zero or convert what no integer holds.
 */
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi2Functions.h"

enum { INSTANCES = 2, STATES = 2, AT_ONCE = 6, LONGEST = 1 << 16, STEPS = 3 };

static const uint8_t *next;
static size_t left;

static unsigned below(unsigned limit)
{
    if (left == 0) return 0;
    left--;
    return *next++ % limit;
}

static double number(void)
{
    const double odd[] = {0.0, -0.0, 1.0, -1.0, 5e-324, 1e-310, 1e300, -1.7e308, INFINITY, -INFINITY, NAN, 2147483648.0};
    const unsigned kind = below(3);
    double value = 0.0;
    if (kind == 0) return odd[below(sizeof odd / sizeof odd[0])];
    if (kind == 1 || left < sizeof value) return (double)below(256) / 64.0 - 2.0;
    memcpy(&value, next, sizeof value);
    next += sizeof value;
    left -= sizeof value;
    return value;
}

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
static fmi2Byte bytes[LONGEST];

/* So many value references, most of them of the FMU. */
static size_t choose(void)
{
    const size_t count = below(AT_ONCE + 1);
    for (size_t i = 0; i < count; i++) {
        references[i] = below(16) == 0 ? 0xfffffff0u + below(16) : (below(256) * 256u + below(256)) % (VARIABLES + 1);
        reals[i] = number();
        whole[i] = below(4) == 0 ? INT32_MIN + (int)below(2) : (fmi2Integer)below(256) - 8;
        texts[i] = below(2) ? "" : "text";
    }
    return count;
}

static void mangle(fmi2Component fmu, fmi2FMUstate *state)
{
    size_t size = 0;
    if (fmi2SerializedFMUstateSize(fmu, *state, &size) != fmi2OK || size > LONGEST) return;
    if (fmi2SerializeFMUstate(fmu, *state, bytes, size) != fmi2OK) return;
    for (unsigned i = below(4); i > 0; i--) {
        const double value = number();
        const size_t word = (below(256) * 256u + below(256)) % (size / 8);
        if (below(2)) memcpy(bytes + 8 * word, &value, 8);
        else bytes[8 * word + below(8)] ^= (fmi2Byte)(1u << below(8));
    }
    fmi2DeSerializeFMUstate(fmu, bytes, below(8) ? size : size - below(9), state);
}

static void step(fmi2Component fmu, double *time)
{
    const double size = below(4) ? STEP * (1 + below(STEPS)) : below(4) ? number() : 1e300;
    const double point = below(8) ? *time : number();
    if (size > 1000.0 * STEP && isfinite(size) && size < 1e30) return; /* takes as long as it says */
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
        case 14: if (states[state] != NULL) mangle(*fmu, &states[state]); break;
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

#ifdef STANDALONE
int main(int count, char **arguments)
{
    static uint8_t random[600];
    uint64_t state = count > 2 ? strtoull(arguments[2], NULL, 10) * 2 + 1 : 1;
    for (long run = count > 1 ? atol(arguments[1]) : 1; run > 0; run--) {
        for (size_t i = 0; i < sizeof random; i++) {
            state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
            random[i] = (uint8_t)(state >> 56);
        }
        LLVMFuzzerTestOneInput(random, sizeof random);
    }
    return 0;
}
#endif
