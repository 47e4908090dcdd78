/* Drives one FMU of FMI 3.0 through right and wrong calls, to be compiled together with it under sanitizers.
 *
 *     drive_fmi3 TOKEN TYPES CAUSALITIES SIZES STEP COUNT
 *
 * TYPES has a letter f, i, b or e (Float64, Int32, Boolean, Enumeration) per value reference, CAUSALITIES a letter
 * p, i, o or l (parameter, input, output, local), SIZES the elements with commas between. Inputs are random, some of
 * them infinite or NaN. The sanitizers watch memory and arithmetic; this program watches the answers, and prints a
 * checksum of all values.
 */
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "fmi3Functions.h"

#define HEADER_SIZE 48 /* of a serialised state: six words before the variables */

static const char *token, *types, *causalities;
static size_t count;      /* of variables */
static size_t *sizes;     /* of each */
static size_t most, all;  /* elements of the largest variable, and of all together */
static double step;
static int failures;

#define EXPECT(wanted, call) expect(wanted, call, #call, __LINE__)

static void expect(fmi3Status wanted, fmi3Status actual, const char *call, int line)
{
    if (actual == wanted) return;
    printf("line %d: %s gave status %d instead of %d\n", line, call, (int)actual, (int)wanted);
    failures++;
}

static void check(int holds, const char *what)
{
    if (holds) return;
    printf("%s\n", what);
    failures++;
}

static size_t messages;

static void logger(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message)
{
    check(environment == &failures && status == fmi3Error && category[0] != '\0' && message[0] != '\0',
        "a message is incomplete");
    messages++;
}

/* ---- random values: Marsaglia's xorshift64*, 2003, with Vigna's factor ---- */

static uint64_t generator = UINT64_C(88172645463325252);

static uint64_t draw(uint64_t below)
{
    generator ^= generator >> 12;
    generator ^= generator << 25;
    generator ^= generator >> 27;
    return (generator * UINT64_C(2685821657736338717) >> 16) % below;
}

static double number(void)
{
    const double odd[] = {0.0, -0.0, 1.0, -1.0, 1e-310, 1e300, -1e308, INFINITY, -INFINITY, NAN};
    if (draw(200) == 0) return odd[draw(sizeof odd / sizeof odd[0])];
    return ldexp((double)draw(1 << 30) / (1 << 29) - 1.0, (int)draw(20) - 6);
}

/* ---- a variable by its type ---- */

typedef union Value {
    fmi3Float64 real;
    fmi3Int32 integer;
    fmi3Int64 wide;
    fmi3Boolean boolean;
    uint64_t word;
} Value;

typedef union Buffer {
    fmi3Float64 reals[1];
    fmi3Int32 integers[1];
    fmi3Int64 wides[1];
    fmi3Boolean booleans[1];
} Buffer;

static Buffer *buffer; /* exactly as long as the values of one call, so that the sanitizer sees what is beyond */

static size_t width(char type)
{
    return type == 'f' ? sizeof(fmi3Float64) : type == 'i' ? sizeof(fmi3Int32)
        : type == 'e' ? sizeof(fmi3Int64)    : sizeof(fmi3Boolean);
}

static void resize(char type, size_t size)
{
    free(buffer);
    buffer = calloc(size ? size : 1, width(type));
    if (buffer == NULL) exit(2);
}

static fmi3Status get(fmi3Instance fmu, fmi3ValueReference reference, char type, size_t size)
{
    resize(type, size);
    if (type == 'f') return fmi3GetFloat64(fmu, &reference, 1, buffer->reals, size);
    if (type == 'i') return fmi3GetInt32(fmu, &reference, 1, buffer->integers, size);
    if (type == 'e') return fmi3GetInt64(fmu, &reference, 1, buffer->wides, size);
    return fmi3GetBoolean(fmu, &reference, 1, buffer->booleans, size);
}

static fmi3Status set(fmi3Instance fmu, fmi3ValueReference reference, char type, size_t size)
{
    if (type == 'f') return fmi3SetFloat64(fmu, &reference, 1, buffer->reals, size);
    if (type == 'i') return fmi3SetInt32(fmu, &reference, 1, buffer->integers, size);
    if (type == 'e') return fmi3SetInt64(fmu, &reference, 1, buffer->wides, size);
    return fmi3SetBoolean(fmu, &reference, 1, buffer->booleans, size);
}

static void draw_values(char type, size_t size)
{
    resize(type, size);
    for (size_t k = 0; k < size; k++) {
        if (type == 'f') buffer->reals[k] = number();
        if (type == 'i') buffer->integers[k] = (fmi3Int32)draw(5);
        if (type == 'e') buffer->wides[k] = (fmi3Int64)draw(5);
        if (type == 'b') buffer->booleans[k] = draw(2) == 1;
    }
}

static uint64_t checksum = UINT64_C(14695981039346656037); /* FNV-1a of all that was read; one NaN is as another */

static void add_to_checksum(char type, size_t size)
{
    for (size_t k = 0; k < size; k++) {
        Value value = {.word = 0};
        if (type == 'f') value.real = buffer->reals[k];
        if (type == 'f' && isnan(value.real)) value.word = 1;
        if (type == 'i') value.integer = buffer->integers[k];
        if (type == 'e') value.wide = buffer->wides[k];
        if (type == 'b') value.boolean = buffer->booleans[k];
        checksum = (checksum ^ value.word) * UINT64_C(1099511628211);
    }
}

/* All bytes of all variables; what cannot be read, after an overflow of 32 bits, is 0. */
static void read_all(fmi3Instance fmu, unsigned char *bytes)
{
    memset(bytes, 0, all * sizeof(Value));
    for (size_t i = 0; i < count; i++) {
        if (get(fmu, (fmi3ValueReference)i, types[i], sizes[i]) == fmi3OK) {
            memcpy(bytes, buffer, sizes[i] * width(types[i]));
            add_to_checksum(types[i], sizes[i]);
        }
        bytes += sizes[i] * sizeof(Value);
    }
}

/* ---- life cycle ---- */

static fmi3Instance instantiate(const char *name, const char *of, bool events, void *environment)
{
    return fmi3InstantiateCoSimulation(name, of, NULL, false, true, events, true, NULL, 0, environment,
        environment == NULL ? NULL : logger, NULL);
}

static fmi3Instance instance(void *environment)
{
    fmi3Instance fmu =
        instantiate("an instance with a name that is longer than what alignment leaves room for", token, false, environment);
    if (fmu == NULL) exit(2);
    return fmu;
}

static fmi3Status initialise(fmi3Instance fmu)
{
    EXPECT(fmi3OK, fmi3EnterInitializationMode(fmu, false, 0.0, 0.0, true, 1e6));
    return fmi3ExitInitializationMode(fmu);
}

static fmi3Status do_a_step(fmi3Instance fmu, double point, double size)
{
    fmi3Boolean event = true, end = true, early = true;
    fmi3Float64 time = -1.0;
    const fmi3Status status = fmi3DoStep(fmu, point, size, false, &event, &end, &early, &time);
    check(fmu == NULL || (!event && !end && !early && time >= 0.0), "a step reports an event, an end or no time");
    return status;
}

static void wrong_instantiation(void)
{
    check(instantiate(NULL, token, false, &failures) == NULL, "name NULL accepted");
    check(instantiate("", token, false, &failures) == NULL, "empty name accepted");
    check(instantiate("fmu", NULL, false, &failures) == NULL, "token NULL accepted");
    check(instantiate("fmu", "{1}", false, &failures) == NULL, "wrong token accepted");
    check(instantiate("fmu", "{1}", false, NULL) == NULL, "wrong token accepted");
    check(instantiate("fmu", token, true, &failures) == NULL, "event mode accepted");
    check(fmi3InstantiateModelExchange("fmu", token, NULL, false, true, &failures, logger) == NULL, "model exchange");
    check(fmi3InstantiateScheduledExecution("fmu", token, NULL, false, true, &failures, logger, NULL, NULL, NULL)
            == NULL, "scheduled execution");
}

/* Wrong in every state of the life cycle. */
static void wrong_arguments(fmi3Instance fmu)
{
    const fmi3ValueReference time = (fmi3ValueReference)count, beyond[] = {time + 1, UINT32_MAX}, first = 0;
    const char all_types[] = "fibe";
    size_t length = 0;
    fmi3Byte byte = 0;
    fmi3FMUState state = NULL;
    fmi3String text = NULL;
    fmi3Boolean flag = false;
    fmi3Float64 real = 0.0;
    for (int k = 0; k < 4; k++) {
        const char type = all_types[k];
        draw_values(type, most);
        EXPECT(fmi3Error, set(NULL, 0, type, 1));
        EXPECT(fmi3Error, set(fmu, time, type, 1));
        if (type != 'f') EXPECT(fmi3Error, get(fmu, time, type, 1));
        EXPECT(fmi3Error, get(NULL, 0, type, 1));
        for (int j = 0; j < 2; j++) {
            EXPECT(fmi3Error, get(fmu, beyond[j], type, 1));
            EXPECT(fmi3Error, set(fmu, beyond[j], type, 1));
        }
        for (size_t i = 0; i < count; i++) {
            if (types[i] == type) { /* too few or too many values */
                EXPECT(fmi3Error, get(fmu, (fmi3ValueReference)i, type, sizes[i] + 1));
                EXPECT(fmi3Error, set(fmu, (fmi3ValueReference)i, type, sizes[i] - 1));
            } else {
                EXPECT(fmi3Error, get(fmu, (fmi3ValueReference)i, type, sizes[i]));
                EXPECT(fmi3Error, set(fmu, (fmi3ValueReference)i, type, sizes[i]));
            }
            if (types[i] == type && (causalities[i] == 'o' || causalities[i] == 'l')) {
                draw_values(type, sizes[i]);
                EXPECT(fmi3Error, set(fmu, (fmi3ValueReference)i, type, sizes[i]));
            }
        }
    }
    EXPECT(fmi3Error, fmi3GetFloat64(fmu, NULL, 1, &real, 1));
    EXPECT(fmi3Error, fmi3GetFloat64(fmu, &first, 1, NULL, 1));
    EXPECT(fmi3Error, fmi3SetFloat64(fmu, NULL, 1, &real, 1));
    EXPECT(fmi3Error, fmi3SetFloat64(fmu, &first, 1, NULL, 1));
    EXPECT(fmi3Error, fmi3GetString(fmu, &first, 1, &text, 1));
    EXPECT(fmi3Error, fmi3SetString(fmu, &first, 1, &text, 1));
    EXPECT(fmi3Error, fmi3GetBinary(fmu, &first, 1, &length, NULL, 1));
    EXPECT(fmi3Error, fmi3SetClock(fmu, &first, 1, &flag));
    EXPECT(fmi3Error, fmi3SetDebugLogging(fmu, true, 1, NULL));
    EXPECT(fmi3Error, fmi3SetDebugLogging(fmu, true, 1, &text));
    text = "logEverything";
    EXPECT(fmi3Error, fmi3SetDebugLogging(fmu, true, 1, &text));
    EXPECT(fmi3OK, fmi3SetDebugLogging(fmu, false, 0, NULL));
    const size_t before = messages;
    EXPECT(fmi3Error, do_a_step(fmu, 0.0, 0.0));
    check(messages == before, "a message without logging");
    text = "logStatusError";
    EXPECT(fmi3OK, fmi3SetDebugLogging(fmu, true, 1, &text));
    EXPECT(fmi3Error, do_a_step(fmu, 0.0, 0.0));
    check(messages == before + 1, "no message with logging");
    EXPECT(fmi3Error, fmi3EnterInitializationMode(fmu, false, 0.0, NAN, false, 0.0));
    EXPECT(fmi3Error, fmi3EnterInitializationMode(fmu, false, 0.0, 1.0, true, 0.0));
    EXPECT(fmi3Error, do_a_step(fmu, 0.0, 0.0));
    EXPECT(fmi3Error, do_a_step(fmu, 0.0, -step));
    EXPECT(fmi3Error, do_a_step(fmu, NAN, step));
    EXPECT(fmi3Error, do_a_step(fmu, 0.0, INFINITY));
    EXPECT(fmi3Error, do_a_step(NULL, 0.0, step));
    EXPECT(fmi3Error, fmi3DoStep(fmu, 0.0, step, false, NULL, &flag, &flag, &real));
    EXPECT(fmi3Error, fmi3DoStep(fmu, 0.0, step, false, &flag, &flag, &flag, NULL));
    EXPECT(fmi3Error, fmi3EnterEventMode(fmu));
    EXPECT(fmi3Error, fmi3EnterStepMode(fmu));
    EXPECT(fmi3Error, fmi3EnterConfigurationMode(fmu));
    EXPECT(fmi3Error, fmi3UpdateDiscreteStates(fmu, &flag, &flag, &flag, &flag, &flag, &real));
    EXPECT(fmi3Error, fmi3GetNumberOfContinuousStates(fmu, &length));
    EXPECT(fmi3Error, fmi3ActivateModelPartition(fmu, 0, 0.0));
    EXPECT(fmi3Error, fmi3GetDirectionalDerivative(fmu, &first, 1, &first, 1, &real, 1, &real, 1));
    EXPECT(fmi3Error, fmi3GetFMUState(fmu, NULL));
    EXPECT(fmi3Error, fmi3GetFMUState(NULL, &state));
    EXPECT(fmi3Error, fmi3SetFMUState(fmu, NULL));
    EXPECT(fmi3OK, fmi3FreeFMUState(fmu, NULL));
    EXPECT(fmi3OK, fmi3FreeFMUState(fmu, &state));
    EXPECT(fmi3Error, fmi3SerializedFMUStateSize(fmu, NULL, &length));
    EXPECT(fmi3Error, fmi3SerializeFMUState(fmu, NULL, &byte, 1));
    EXPECT(fmi3Error, fmi3DeserializeFMUState(fmu, &byte, 1, &state));
    EXPECT(fmi3Error, fmi3Terminate(NULL));
    EXPECT(fmi3Error, fmi3Reset(NULL));
}

/* Right arguments, wrong moment. */
static void wrong_moments(void)
{
    fmi3Instance fmu = instance(&failures);
    wrong_arguments(fmu);
    EXPECT(fmi3OK, get(fmu, 0, types[0], sizes[0]));
    EXPECT(fmi3Error, fmi3ExitInitializationMode(fmu));
    EXPECT(fmi3Error, do_a_step(fmu, 0.0, step));
    EXPECT(fmi3Error, fmi3Terminate(fmu));
    EXPECT(fmi3OK, fmi3EnterInitializationMode(fmu, false, 0.0, 0.0, false, 0.0));
    wrong_arguments(fmu);
    EXPECT(fmi3OK, get(fmu, 0, types[0], sizes[0]));
    EXPECT(fmi3Error, do_a_step(fmu, 0.0, step));
    EXPECT(fmi3OK, fmi3ExitInitializationMode(fmu));
    wrong_arguments(fmu);
    EXPECT(fmi3Error, fmi3ExitInitializationMode(fmu));
    for (size_t i = 0; i < count; i++) {
        if (causalities[i] != 'p') continue;
        EXPECT(fmi3OK, get(fmu, (fmi3ValueReference)i, types[i], sizes[i]));
        EXPECT(fmi3Error, set(fmu, (fmi3ValueReference)i, types[i], sizes[i]));
    }
    EXPECT(fmi3OK, fmi3Terminate(fmu));
    wrong_arguments(fmu);
    EXPECT(fmi3Error, do_a_step(fmu, 0.0, step));
    EXPECT(fmi3OK, fmi3Reset(fmu));
    EXPECT(fmi3OK, initialise(fmu));
    fmi3FreeInstance(fmu);
    fmi3FreeInstance(NULL);
}

/* ---- states ---- */

/* A state as bytes and back; bytes cut off, foreign or spoilt. */
static void states(fmi3Instance fmu, unsigned char *before, unsigned char *after)
{
    const int64_t extremes[] = {0, -1, INT64_MAX, INT64_MIN, INT64_C(1) << 53, INT64_C(0x7FF0000000000000), 1000};
    fmi3FMUState state = NULL, copy = NULL, spoilt = NULL;
    size_t length = 0;
    read_all(fmu, before);
    EXPECT(fmi3OK, fmi3GetFMUState(fmu, &state));
    EXPECT(fmi3OK, fmi3SerializedFMUStateSize(fmu, state, &length));
    check(length == HEADER_SIZE + 8 * all, "a state has another size");
    fmi3Byte *bytes = malloc(length);
    EXPECT(fmi3Error, fmi3SerializeFMUState(fmu, state, bytes, length - 1));
    EXPECT(fmi3OK, fmi3SerializeFMUState(fmu, state, bytes, length));
    EXPECT(fmi3Error, fmi3DeserializeFMUState(fmu, bytes, length - 1, &copy));
    EXPECT(fmi3OK, fmi3DeserializeFMUState(fmu, bytes, length, &copy));
    EXPECT(fmi3OK, fmi3SetFMUState(fmu, copy));
    read_all(fmu, after);
    check(memcmp(before, after, all * sizeof(Value)) == 0, "a serialised state differs");
    for (int n = 0; n < 20; n++) { /* whatever the bytes are, nothing undefined may follow */
        EXPECT(fmi3OK, fmi3SerializeFMUState(fmu, state, bytes, length));
        const size_t word = 1 + draw((draw(2) ? length : HEADER_SIZE) / 8 - 1);
        memcpy(bytes + 8 * word, &extremes[draw(sizeof extremes / sizeof extremes[0])], 8);
        if (fmi3DeserializeFMUState(fmu, bytes, length, &spoilt) != fmi3OK) continue;
        EXPECT(fmi3OK, fmi3SetFMUState(fmu, spoilt));
        read_all(fmu, after);
        fmi3Boolean flag;
        fmi3Float64 time;
        fmi3DoStep(fmu, 0.0, step, false, &flag, &flag, &flag, &time);
    }
    EXPECT(fmi3OK, fmi3SetFMUState(fmu, state));
    read_all(fmu, after);
    check(memcmp(before, after, all * sizeof(Value)) == 0, "a restored state differs");
    EXPECT(fmi3OK, fmi3FreeFMUState(fmu, &state));
    EXPECT(fmi3OK, fmi3FreeFMUState(fmu, &state));
    EXPECT(fmi3OK, fmi3FreeFMUState(fmu, &copy));
    EXPECT(fmi3OK, fmi3FreeFMUState(fmu, &spoilt));
    free(bytes);
}

/* Two instances step by step; after an error one is reset and the other is put back to a state. */
static void fly(int steps)
{
    fmi3Instance one = instance(&failures), other = instance(NULL);
    unsigned char *bytes = calloc(all, sizeof(Value)), *other_bytes = calloc(all, sizeof(Value));
    fmi3FMUState fresh = NULL;
    EXPECT(fmi3OK, fmi3GetFMUState(other, &fresh));
    int flown = 0;
    for (int flights = 0; flown < steps && flights < steps; flights++) {
        EXPECT(fmi3OK, fmi3Reset(one));
        EXPECT(fmi3OK, fmi3SetFMUState(other, fresh));
        EXPECT(fmi3OK, initialise(one));
        EXPECT(fmi3OK, initialise(other));
        fmi3Status status = fmi3OK;
        for (int n = 0; n < 50 && status == fmi3OK; n++) {
            for (size_t i = 0; i < count; i++) {
                if (causalities[i] != 'i') continue;
                draw_values(types[i], sizes[i]);
                EXPECT(fmi3OK, set(one, (fmi3ValueReference)i, types[i], sizes[i]));
                EXPECT(fmi3OK, set(other, (fmi3ValueReference)i, types[i], sizes[i]));
            }
            status = do_a_step(one, n * step, step);
            EXPECT(status, do_a_step(other, n * step, step));
            check(status == fmi3OK || status == fmi3Error, "a step ended with another status than OK or Error");
            read_all(one, bytes);
            read_all(other, other_bytes);
            check(memcmp(bytes, other_bytes, all * sizeof(Value)) == 0, "two instances differ");
            flown += status == fmi3OK;
            if (status == fmi3OK && draw(20) == 0) states(one, bytes, other_bytes);
        }
    }
    check(2 * flown > steps, "few steps succeed: this run says little");
    EXPECT(fmi3OK, fmi3FreeFMUState(other, &fresh));
    fmi3FreeInstance(one);
    fmi3FreeInstance(other);
    free(bytes);
    free(other_bytes);
}

int main(int argument_count, char **arguments)
{
    if (argument_count != 7) return 2;
    token = arguments[1];
    types = arguments[2];
    causalities = arguments[3];
    count = strlen(types);
    sizes = calloc(count, sizeof *sizes);
    char *next = arguments[4];
    for (size_t i = 0; i < count; i++) {
        sizes[i] = strtoul(next, &next, 10);
        next += *next == ',';
        most = sizes[i] > most ? sizes[i] : most;
        all += sizes[i];
    }
    step = atof(arguments[5]);
    check(strcmp(fmi3GetVersion(), "3.0") == 0, "the version is not 3.0");
    wrong_instantiation();
    wrong_moments();
    fly(atoi(arguments[6]));
    printf("checksum %016" PRIx64 "\n", checksum);
    free(buffer);
    free(sizes);
    return failures == 0 ? 0 : 1;
}
