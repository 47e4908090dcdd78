/* Drives one FMU of FMI 3.0 through right and wrong calls, to be compiled together with it under sanitizers.
 *
 *     drive_fmi3 TOKEN TYPES CAUSALITIES SIZES STEP COUNT
 *
 * TYPES has a letter f, i, b or e (Float64, Int32, Boolean, Enumeration) per value reference, CAUSALITIES a letter
 * p, i, o or l (parameter, input, output, local), SIZES the elements with commas between. Inputs are random, some of
 * them infinite or NaN. The sanitizers watch memory and arithmetic; this program watches the answers, and prints a
 * checksum of all values.
 */
#include "checks.h"
#include "drive_fmi3_values.h"

static const char *token, *causalities;
static double step;
static size_t messages;

static void logger(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message)
{
    check(environment == &failures && status == fmi3Error && category[0] != '\0' && message[0] != '\0',
        "a message is incomplete");
    messages++;
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
    messages = 0;
    check(instantiate(NULL, token, false, &failures) == NULL, "name NULL accepted");
    check(instantiate("", token, false, &failures) == NULL, "empty name accepted");
    check(instantiate("fmu", NULL, false, &failures) == NULL, "token NULL accepted");
    check(instantiate("fmu", "{1}", false, &failures) == NULL, "wrong token accepted");
    check(instantiate("fmu", "{1}", false, NULL) == NULL, "wrong token accepted");
    check(instantiate("fmu", token, true, &failures) == NULL, "event mode accepted");
    check(fmi3InstantiateModelExchange("fmu", token, NULL, false, true, &failures, logger) == NULL, "model exchange");
    check(fmi3InstantiateScheduledExecution("fmu", token, NULL, false, true, &failures, logger, NULL, NULL, NULL)
            == NULL, "scheduled execution");
    check(messages == 7, "an instantiation is refused without a message");
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
        draw_values(type, largest);
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
        if (causalities[i] != 'p' && causalities[i] != 't') continue; /* t: a tunable one */
        EXPECT(fmi3OK, get(fmu, (fmi3ValueReference)i, types[i], sizes[i]));
        EXPECT(causalities[i] == 't' ? fmi3OK : fmi3Error, set(fmu, (fmi3ValueReference)i, types[i], sizes[i]));
    }
    EXPECT(fmi3OK, fmi3Terminate(fmu));
    wrong_arguments(fmu);
    EXPECT(fmi3Error, do_a_step(fmu, 0.0, step));
    EXPECT(fmi3OK, fmi3Reset(fmu));
    EXPECT(fmi3OK, fmi3EnterInitializationMode(fmu, false, 0.0, 0.0, true, 0.5 * step));
    EXPECT(fmi3OK, fmi3ExitInitializationMode(fmu));
    EXPECT(fmi3Error, do_a_step(fmu, 0.0, step)); /* past the stop time */
    EXPECT(fmi3OK, fmi3Reset(fmu));
    EXPECT(fmi3OK, initialise(fmu));
    fmi3FreeInstance(fmu);
    fmi3FreeInstance(NULL);
}

/* ---- states ---- */

/* A state as bytes and back; bytes cut off, foreign or spoilt. */
static void states(fmi3Instance fmu, unsigned char *before, unsigned char *after)
{
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
        spoil(bytes, length);
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
        largest = sizes[i] > largest ? sizes[i] : largest;
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
