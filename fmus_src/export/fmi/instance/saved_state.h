/* Complete state of an instance: saved, restored, and as bytes, alike in all versions of FMI.
 *
 * The bytes are words of 8 in the machine's order: a hash of the GUID, mode, unsettled, tick,
 * start_time, time, then one word per variable's element in order of declaration (a double,
 * an int64, or 0 and 1).
 */
#ifndef SAVED_STATE_H
#define SAVED_STATE_H

#include "instance.h"

#define HEADER_WORDS 6
#define WORD_COUNT (HEADER_WORDS + ELEMENT_COUNT)
#define WORD_SIZE sizeof(int64_t)
#define LAST_TICK (INT64_C(1) << 53) /* beyond, the time of a sample is no exact product */

typedef unsigned char Byte;

/* What an FMU state points to. */
typedef struct SavedState {
    uint64_t model; /* tells the states of other FMUs apart */
    Snapshot snapshot;
} SavedState;

/* FNV-1a of the GUID. */
static uint64_t model_hash(void)
{
    uint64_t hash = UINT64_C(14695981039346656037);
    for (const char *next = MODEL_GUID; *next != '\0'; next++) {
        hash = (hash ^ (uint64_t)(unsigned char)*next) * UINT64_C(1099511628211);
    }
    return hash;
}

/* STATUS_OK where a state is one of this FMU. */
static Status check_state(const Component *component, const char *function, const SavedState *state)
{
    const Status status = check_mode(component, function, MODE_ANY);
    if (status != STATUS_OK) return status;
    if (state == NULL) return fail(component, "%s: FMUstate is NULL", function);
    if (state->model != model_hash()) return fail(component, "%s: FMUstate is not one of this FMU", function);
    return STATUS_OK;
}

/* Space for a state: the one at `place`, or a new one. NULL with a message where there is none: the state of another FMU
 * has other room. */
static SavedState *state_space(const Component *component, const char *function, void **place)
{
    SavedState *state = (SavedState *)*place;
    if (state != NULL && state->model != model_hash()) {
        fail(component, "%s: FMUstate is one of another FMU, which cannot be overwritten; pass a NULL state", function);
        return NULL;
    }
    if (state == NULL) *place = state = (SavedState *)calloc(1, sizeof(SavedState));
    if (state == NULL) fail(component, "%s: out of memory", function);
    return state;
}

static Status save_state(Component *component, const char *function, void **place)
{
    const Status status = check_mode(component, function, MODE_ANY);
    if (status != STATUS_OK) return status;
    if (place == NULL) return fail(component, "%s: FMUstate is NULL", function);
    SavedState *state = state_space(component, function, place);
    if (state == NULL) return STATUS_ERROR;
    state->model = model_hash();
    state->snapshot = component->now;
    return STATUS_OK;
}

static Status restore_state(Component *component, const char *function, const SavedState *state)
{
    const Status status = check_state(component, function, state);
    if (status == STATUS_OK) component->now = state->snapshot;
    return status;
}

static Status free_state(const Component *component, const char *function, void **place)
{
    const Status status = check_mode(component, function, MODE_ANY);
    if (status != STATUS_OK || place == NULL) return status;
    free(*place);
    *place = NULL;
    return STATUS_OK;
}

static Status serialised_size(
    const Component *component, const char *function, const SavedState *state, size_t *size)
{
    const Status status = check_state(component, function, state);
    if (status != STATUS_OK) return status;
    if (size == NULL) return fail(component, "%s: size is NULL", function);
    *size = WORD_COUNT * WORD_SIZE;
    return STATUS_OK;
}

static Byte *put_int(Byte *next, int64_t value)
{
    memcpy(next, &value, WORD_SIZE);
    return next + WORD_SIZE;
}

static Byte *put_double(Byte *next, double value)
{
    memcpy(next, &value, WORD_SIZE);
    return next + WORD_SIZE;
}

static int64_t int_at(const Byte *bytes, size_t word)
{
    int64_t value;
    memcpy(&value, bytes + word * WORD_SIZE, WORD_SIZE);
    return value;
}

static double double_at(const Byte *bytes, size_t word)
{
    double value;
    memcpy(&value, bytes + word * WORD_SIZE, WORD_SIZE);
    return value;
}

static Status serialise(
    const Component *component, const char *function, const SavedState *state, Byte bytes[], size_t size)
{
    const Status status = check_state(component, function, state);
    if (status != STATUS_OK) return status;
    if (bytes == NULL || size < WORD_COUNT * WORD_SIZE) {
        return fail(component, "%s: serializedState is NULL or shorter than the state", function);
    }
    const Snapshot *snapshot = &state->snapshot;
    Byte *next = put_int(bytes, (int64_t)state->model);
    next = put_int(next, snapshot->mode);
    next = put_int(next, snapshot->unsettled);
    next = put_int(next, snapshot->tick);
    next = put_double(next, snapshot->start_time);
    next = put_double(next, snapshot->time);
    for (size_t i = 0; i < ELEMENT_COUNT; i++) {
        const void *value = (const char *)&snapshot->block + ELEMENTS[i].offset;
        switch (ELEMENTS[i].traits & KIND_ANY) {
            case KIND_REAL: next = put_double(next, *(const double *)value); break;
            case KIND_INTEGER: next = put_int(next, *(const int64_t *)value); break;
            case KIND_BOOLEAN: next = put_int(next, *(const bool *)value); break;
        }
    }
    return STATUS_OK;
}

static bool is_mode(int64_t value)
{
    return value == MODE_INSTANTIATED || value == MODE_INITIALIZATION || value == MODE_STEP
        || value == MODE_TERMINATED || value == MODE_ERROR;
}

/* Whether the header is one that `serialise` writes for this FMU. */
static bool is_header(const Byte *bytes)
{
    const int64_t tick = int_at(bytes, 3);
    return (uint64_t)int_at(bytes, 0) == model_hash() && is_mode(int_at(bytes, 1)) && tick >= 0 && tick <= LAST_TICK;
}

static Status deserialise(
    const Component *component, const char *function, const Byte bytes[], size_t size, void **place)
{
    const Status status = check_mode(component, function, MODE_ANY);
    if (status != STATUS_OK) return status;
    if (bytes == NULL || place == NULL) return fail(component, "%s: an argument is NULL", function);
    if (size != WORD_COUNT * WORD_SIZE || !is_header(bytes)) {
        return fail(component, "%s: the bytes are not a state of this FMU", function);
    }
    SavedState *state = state_space(component, function, place);
    if (state == NULL) return STATUS_ERROR;
    Snapshot *snapshot = &state->snapshot;
    state->model = model_hash();
    snapshot->mode = (Mode)int_at(bytes, 1);
    snapshot->unsettled = int_at(bytes, 2) != 0;
    snapshot->tick = int_at(bytes, 3);
    snapshot->start_time = double_at(bytes, 4);
    snapshot->time = double_at(bytes, 5);
    for (size_t i = 0; i < ELEMENT_COUNT; i++) {
        void *value = (char *)&snapshot->block + ELEMENTS[i].offset;
        const size_t word = HEADER_WORDS + i;
        switch (ELEMENTS[i].traits & KIND_ANY) {
            case KIND_REAL: *(double *)value = double_at(bytes, word); break;
            case KIND_INTEGER: *(int64_t *)value = int_at(bytes, word); break;
            case KIND_BOOLEAN: *(bool *)value = int_at(bytes, word) != 0; break;
        }
    }
    return STATUS_OK;
}

#endif
