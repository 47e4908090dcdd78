/* An FMU of FMI 3.0 that counts how it is called, and refuses what the state machine of co-simulation does not allow. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi3Functions.h"

#define MOST 4
#define WIDE 9007199254740993 /* 2^53 + 1, which no double is */

enum { TIME, SIZE, GAIN, U, Y, D, EVENTS, ACCEPTED, EARLY, RETURNS, ROUNDS, END_AT, TROUBLE, WIDE_OUT, WIDER_OUT, WIDE_IN,
       WIDER_IN, MISMATCHES, TEXT_OUT, TEXT_IN, BLOB_OUT, BLOB_IN, SMALL_OUT, SMALL_IN, TOLERANCE, SINGLE_OUT, SINGLE_IN };
enum { FINE, FAILS, DISCARDS, DIES, STANDS_STILL, NEVER_SETTLES, TALKS, NO_TIME, NO_END, GOES_BACK,
       GOES_BEYOND };
typedef enum { INSTANTIATED, CONFIGURATION, INITIALIZATION, EVENT, STEP, ENDED, REFUSED } State;

typedef struct {
    State state;
    fmi3Boolean uses_events, may_return_early;
    fmi3InstanceEnvironment environment;
    fmi3LogMessageCallback log;
    fmi3IntermediateUpdateCallback update;
    uint64_t size;
    double time, gain[MOST], u[MOST], y[MOST], early, end_at, tolerance;
    float single_in[2];
    int32_t d, events, accepted, returns, rounds, mismatches, left, steps;
    int64_t trouble, wide_in;
    uint64_t wider_in;
    int8_t small_in;
    char text_out[40], text_in[100];
    uint8_t blob_out[3], blob_in[100];
    size_t blob_size;
} Instance;

static void start(Instance *me) {
    fmi3Boolean uses_events = me->uses_events, may_return_early = me->may_return_early;
    fmi3InstanceEnvironment environment = me->environment;
    fmi3LogMessageCallback log = me->log;
    fmi3IntermediateUpdateCallback update = me->update;
    memset(me, 0, sizeof *me);
    me->uses_events = uses_events, me->may_return_early = may_return_early;
    me->environment = environment, me->log = log, me->update = update;
    me->size = 2, me->end_at = 1e9, me->trouble = FINE, me->small_in = -50, me->wide_in = WIDE, me->wider_in = UINT64_MAX;
    strcpy(me->text_in, "step 0"), me->blob_in[2] = 255, me->blob_size = 3, me->single_in[1] = -1;
    for (int i = 0; i < MOST; i++) me->gain[i] = i + 1, me->u[i] = i == 0 ? 0.5 : 0.25;
}

static fmi3Status refuse(Instance *me, const char *what) {
    char message[200];
    snprintf(message, sizeof message, "%s is not allowed in state %d: 100%% sure", what, (int) me->state);
    me->log(me->environment, fmi3Error, "logStatusError", message);
    me->state = REFUSED;
    return fmi3Error;
}

#define IN(condition) if (!(condition)) return refuse(me, __func__)
#define ME Instance *me = (Instance *) instance
#define INTO(states) IN((1 << me->state) & (states))
#define S(state) (1 << state)

const char *fmi3GetVersion(void) { return "3.0"; }

fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logs, fmi3Boolean events,
    fmi3Boolean early, const fmi3ValueReference required[], size_t count, fmi3InstanceEnvironment environment,
    fmi3LogMessageCallback log, fmi3IntermediateUpdateCallback update) {
    if ((*token && strcmp(token, "by hand")) || (events && !HAS_EVENTS) || count || !name || !resources) return NULL;
    Instance *me = calloc(1, sizeof *me);
    me->uses_events = events, me->may_return_early = early;
    me->environment = environment, me->log = log, me->update = update;
    start(me);
    return me;
}

void fmi3FreeInstance(fmi3Instance instance) { free(instance); }

fmi3Status fmi3EnterConfigurationMode(fmi3Instance instance) {
    ME; INTO(S(INSTANTIATED));
    me->state = CONFIGURATION;
    return fmi3OK;
}

fmi3Status fmi3ExitConfigurationMode(fmi3Instance instance) {
    ME; INTO(S(CONFIGURATION));
    me->state = INSTANTIATED;
    return fmi3OK;
}

fmi3Status fmi3EnterInitializationMode(
    fmi3Instance instance, fmi3Boolean known, fmi3Float64 tolerance, fmi3Float64 begin, fmi3Boolean ends, fmi3Float64 end) {
    ME; INTO(S(INSTANTIATED));
    me->state = INITIALIZATION, me->time = begin, me->tolerance = known ? tolerance : -1;
    return fmi3OK;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
    ME; INTO(S(INITIALIZATION));
    if (CLAMPS_ROUNDS && me->rounds > 2) me->rounds = 2;
    me->state = me->uses_events ? EVENT : STEP, me->left = me->rounds;
    return fmi3OK;
}

fmi3Status fmi3EnterEventMode(fmi3Instance instance) {
    ME; INTO(S(STEP));
    IN(me->uses_events);
    me->state = EVENT, me->events++, me->left = me->rounds;
    return fmi3OK;
}

fmi3Status fmi3UpdateDiscreteStates(
    fmi3Instance instance, fmi3Boolean *more, fmi3Boolean *ends, fmi3Boolean *nominals, fmi3Boolean *values,
    fmi3Boolean *defined, fmi3Float64 *next) {
    ME; INTO(S(EVENT));
    me->accepted = me->d;
    *more = me->trouble == NEVER_SETTLES || me->left-- > 0, *ends = me->d < 0;
    *nominals = *values = *defined = fmi3False, *next = 0;
    return fmi3OK;
}

fmi3Status fmi3EnterStepMode(fmi3Instance instance) {
    ME; INTO(S(EVENT));
    IN(me->left < 0);
    me->state = STEP;
    return fmi3OK;
}

static void compare(Instance *me) {
    char text[40];
    uint8_t blob[3] = {0, (uint8_t) me->steps, 255};
    snprintf(text, sizeof text, "step %d", me->steps);
    me->mismatches += me->wide_in != WIDE + me->steps;
    me->mismatches += me->wider_in != UINT64_MAX - (uint64_t) me->steps;
    me->mismatches += strcmp(me->text_in, text) != 0;
    me->mismatches += me->blob_size != 3 || memcmp(me->blob_in, blob, 3) != 0;
    me->mismatches += me->small_in != (int8_t) (me->steps % 100 - 50);
    me->mismatches += me->single_in[0] != 0.1f * (float) me->steps || me->single_in[1] != -1.0f;
}

fmi3Status fmi3DoStep(
    fmi3Instance instance, fmi3Float64 begin, fmi3Float64 step, fmi3Boolean forgets, fmi3Boolean *event, fmi3Boolean *ends,
    fmi3Boolean *early, fmi3Float64 *last) {
    ME; INTO(S(STEP));
    double end = begin + step, difference = begin - me->time;
    IN(step > 0 && forgets && difference < 1e-9 && difference > -1e-9);
    fmi3Boolean asked = fmi3True;
    double until = 0;
    *event = *ends = *early = fmi3False, *last = begin;
    if (me->update == NULL) asked = fmi3False;
    else me->update(me->environment, begin, fmi3False, fmi3True, fmi3True, fmi3True, &asked, &until);
    if (asked) return fmi3Fatal;
    if (me->trouble == FAILS || me->trouble == DISCARDS || me->trouble == DIES) {
        me->log(me->environment, fmi3Error, "logStatusError", "as asked for");
        return me->trouble == FAILS ? fmi3Error : me->trouble == DISCARDS ? fmi3Discard : fmi3Fatal;
    }
    if (me->trouble == TALKS) me->log(me->environment, fmi3Warning, "logEvents", "100% of a %s");
    if (me->may_return_early && (me->trouble == STANDS_STILL || me->trouble >= NO_TIME)) {
        *early = fmi3True;
        if (me->trouble == NO_TIME) *last = NAN;
        if (me->trouble == NO_END) *last = INFINITY;
        if (me->trouble == GOES_BACK) *last = begin - 0.125;
        if (me->trouble == GOES_BEYOND) *last = end + 0.125;
        return fmi3OK;
    }
    if (me->may_return_early && me->early > 0 && step > me->early + 1e-9) {
        end = begin + me->early, *early = *event = fmi3True;
        me->returns++;
    }
    if (me->end_at < end) end = me->end_at, *early = *ends = fmi3True;
    for (int i = 0; i < MOST; i++) me->y[i] += (end - begin) * me->gain[i] * me->u[i];
    me->time = *last = end;
    if (!*early) compare(me), me->steps++;
    return fmi3OK;
}

fmi3Status fmi3Terminate(fmi3Instance instance) {
    ME; INTO(S(STEP) | S(EVENT));
    me->state = ENDED;
    return fmi3OK;
}

fmi3Status fmi3Reset(fmi3Instance instance) {
    ME; INTO(~S(REFUSED));
    start(me);
    me->state = INSTANTIATED;
    return fmi3OK;
}

#define GETTER S(INITIALIZATION) | S(EVENT) | S(STEP) | S(ENDED)
#define EXCHANGE(T, C) \
    static C *place##T(Instance *me, fmi3ValueReference vr, size_t *size); \
    fmi3Status fmi3Get##T(fmi3Instance instance, const fmi3ValueReference vr[], size_t n, C values[], size_t count) { \
        ME; INTO(GETTER | S(INSTANTIATED)); \
        size_t at = 0, size; \
        for (size_t i = 0; i < n; i++) { \
            if (HIDES_GAIN && vr[i] == GAIN) return fmi3Error; \
            C *from = place##T(me, vr[i], &size); \
            IN(from && at + size <= count); \
            memcpy(values + at, from, size * sizeof *values), at += size; \
        } \
        IN(at == count); \
        return fmi3OK; \
    } \
    fmi3Status fmi3Set##T(fmi3Instance instance, const fmi3ValueReference vr[], size_t n, const C values[], size_t count) { \
        ME; \
        size_t at = 0, size; \
        for (size_t i = 0; i < n; i++) { \
            C *to = place##T(me, vr[i], &size); \
            IN(to && at + size <= count && may_set(me, vr[i])); \
            memcpy(to, values + at, size * sizeof *values), at += size; \
        } \
        IN(at == count); \
        return fmi3OK; \
    }

static int may_set(Instance *me, fmi3ValueReference vr) {
    switch (vr) {
        case SIZE: return me->state == CONFIGURATION;
        case GAIN: case EARLY: case ROUNDS: case END_AT: case TROUBLE:
            return me->state == INSTANTIATED || me->state == INITIALIZATION;
        case U: case SINGLE_IN: return me->state != CONFIGURATION && me->state != ENDED;
        case D: case WIDE_IN: case WIDER_IN: case SMALL_IN: case TEXT_IN: case BLOB_IN:
            return me->state != CONFIGURATION && me->state != ENDED && (me->state != STEP || !me->uses_events || IS_LENIENT);
        default: return 0;
    }
}

EXCHANGE(Float64, fmi3Float64)
EXCHANGE(Float32, fmi3Float32)
EXCHANGE(Int8, fmi3Int8)
EXCHANGE(Int32, fmi3Int32)
EXCHANGE(Int64, fmi3Int64)
EXCHANGE(UInt64, fmi3UInt64)
EXCHANGE(UInt8, fmi3UInt8)
EXCHANGE(Int16, fmi3Int16)
EXCHANGE(UInt16, fmi3UInt16)
EXCHANGE(UInt32, fmi3UInt32)
EXCHANGE(Boolean, fmi3Boolean)

static double *placeFloat64(Instance *me, fmi3ValueReference vr, size_t *size) {
    *size = vr == GAIN || vr == U || vr == Y ? me->size : 1;
    switch (vr) {
        case TIME: return &me->time;
        case GAIN: return me->gain;
        case U: return me->u;
        case Y: return me->y;
        case EARLY: return &me->early;
        case END_AT: return &me->end_at;
        case TOLERANCE: return &me->tolerance;
        default: return NULL;
    }
}

static int32_t *placeInt32(Instance *me, fmi3ValueReference vr, size_t *size) {
    *size = 1;
    switch (vr) {
        case D: return &me->d;
        case EVENTS: return &me->events;
        case ACCEPTED: return &me->accepted;
        case RETURNS: return &me->returns;
        case ROUNDS: return &me->rounds;
        case MISMATCHES: return &me->mismatches;
        default: return NULL;
    }
}

static float *placeFloat32(Instance *me, fmi3ValueReference vr, size_t *size) {
    static float given[2];
    given[0] = 0.1f * (float) me->steps, given[1] = -1.0f, *size = 2;
    return vr == SINGLE_OUT ? given : vr == SINGLE_IN ? me->single_in : NULL;
}

static int8_t *placeInt8(Instance *me, fmi3ValueReference vr, size_t *size) {
    static int8_t small;
    small = (int8_t) (me->steps % 100 - 50), *size = 1;
    return vr == SMALL_OUT ? &small : vr == SMALL_IN ? &me->small_in : NULL;
}

static int64_t *placeInt64(Instance *me, fmi3ValueReference vr, size_t *size) {
    static int64_t wide;
    wide = WIDE + me->steps, *size = 1;
    return vr == WIDE_OUT ? &wide : vr == WIDE_IN ? &me->wide_in : vr == TROUBLE ? &me->trouble : NULL;
}

static uint64_t *placeUInt64(Instance *me, fmi3ValueReference vr, size_t *size) {
    static uint64_t wider;
    wider = UINT64_MAX - (uint64_t) me->steps, *size = 1;
    return vr == WIDER_OUT ? &wider : vr == WIDER_IN ? &me->wider_in : vr == SIZE ? &me->size : NULL;
}

#define NONE(T, C) static C *place##T(Instance *me, fmi3ValueReference vr, size_t *size) { return *size = 0, NULL; }
NONE(UInt8, uint8_t)
NONE(Int16, int16_t)
NONE(UInt16, uint16_t)
NONE(UInt32, uint32_t)
NONE(Boolean, bool)

fmi3Status fmi3GetString(fmi3Instance instance, const fmi3ValueReference vr[], size_t n, fmi3String values[], size_t count) {
    ME; INTO(GETTER);
    IN(n == 1 && count == 1 && vr[0] == TEXT_OUT);
    snprintf(me->text_out, sizeof me->text_out, "step %d", me->steps);
    values[0] = me->text_out;
    return fmi3OK;
}

fmi3Status fmi3SetString(
    fmi3Instance instance, const fmi3ValueReference vr[], size_t n, const fmi3String values[], size_t count) {
    ME;
    IN(n == 1 && count == 1 && vr[0] == TEXT_IN && may_set(me, vr[0]) && strlen(values[0]) < sizeof me->text_in);
    strcpy(me->text_in, values[0]);
    return fmi3OK;
}

fmi3Status fmi3GetBinary(
    fmi3Instance instance, const fmi3ValueReference vr[], size_t n, size_t sizes[], fmi3Binary values[], size_t count) {
    ME; INTO(GETTER);
    IN(n == 1 && count == 1 && vr[0] == BLOB_OUT);
    me->blob_out[0] = 0, me->blob_out[1] = (uint8_t) me->steps, me->blob_out[2] = 255;
    values[0] = me->blob_out, sizes[0] = BLOB_SIZE;
    return fmi3OK;
}

fmi3Status fmi3SetBinary(
    fmi3Instance instance, const fmi3ValueReference vr[], size_t n, const size_t sizes[], const fmi3Binary values[],
    size_t count) {
    ME;
    IN(n == 1 && count == 1 && vr[0] == BLOB_IN && may_set(me, vr[0]) && sizes[0] <= sizeof me->blob_in);
    memcpy(me->blob_in, values[0], sizes[0]), me->blob_size = sizes[0];
    return fmi3OK;
}

#include "refused_calls.h"
