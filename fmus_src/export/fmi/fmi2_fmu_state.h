/* Complete FMU state: saved, restored, and as bytes.
 *
 * The bytes are words of 8 in the machine's order: a hash of the GUID, mode, unsettled, tick,
 * start_time, time, then one word per variable's element in order of value references (a double,
 * an int64, or 0 and 1).
 */
#ifndef FMI2_FMU_STATE_H
#define FMI2_FMU_STATE_H

#define HEADER_WORDS 6
#define WORD_COUNT (HEADER_WORDS + ELEMENT_COUNT)
#define WORD_SIZE sizeof(int64_t)
#define LAST_TICK (INT64_C(1) << 53) /* beyond, the time of a sample is no exact product */

/* What fmi2FMUstate points to. */
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

/* fmi2OK where a state is one of this FMU. */
static fmi2Status check_state(const Component *component, const char *function, const SavedState *state)
{
    const fmi2Status status = check_mode(component, function, MODE_ANY);
    if (status != fmi2OK) return status;
    if (state == NULL) return fail(component, "%s: FMUstate is NULL", function);
    if (state->model != model_hash()) return fail(component, "%s: FMUstate is not one of this FMU", function);
    return fmi2OK;
}

/* Space for a state: the one given, or a new one. NULL when there is no memory. */
static SavedState *state_space(fmi2FMUstate *place)
{
    if (*place == NULL) *place = calloc(1, sizeof(SavedState));
    return *place;
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *place)
{
    Component *component = c;
    const fmi2Status status = check_mode(component, "fmi2GetFMUstate", MODE_ANY);
    if (status != fmi2OK) return status;
    if (place == NULL) return fail(component, "fmi2GetFMUstate: FMUstate is NULL");
    SavedState *state = state_space(place);
    if (state == NULL) return fail(component, "fmi2GetFMUstate: out of memory");
    state->model = model_hash();
    state->snapshot = component->now;
    return fmi2OK;
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate given)
{
    Component *component = c;
    const SavedState *state = given;
    const fmi2Status status = check_state(component, "fmi2SetFMUstate", state);
    if (status == fmi2OK) component->now = state->snapshot;
    return status;
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *place)
{
    const fmi2Status status = check_mode(c, "fmi2FreeFMUstate", MODE_ANY);
    if (status != fmi2OK || place == NULL) return status;
    free(*place);
    *place = NULL;
    return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate given, size_t *size)
{
    const fmi2Status status = check_state(c, "fmi2SerializedFMUstateSize", given);
    if (status != fmi2OK) return status;
    if (size == NULL) return fail(c, "fmi2SerializedFMUstateSize: size is NULL");
    *size = WORD_COUNT * WORD_SIZE;
    return fmi2OK;
}

static fmi2Byte *put_int(fmi2Byte *next, int64_t value)
{
    memcpy(next, &value, WORD_SIZE);
    return next + WORD_SIZE;
}

static fmi2Byte *put_double(fmi2Byte *next, double value)
{
    memcpy(next, &value, WORD_SIZE);
    return next + WORD_SIZE;
}

static int64_t int_at(const fmi2Byte *bytes, size_t word)
{
    int64_t value;
    memcpy(&value, bytes + word * WORD_SIZE, WORD_SIZE);
    return value;
}

static double double_at(const fmi2Byte *bytes, size_t word)
{
    double value;
    memcpy(&value, bytes + word * WORD_SIZE, WORD_SIZE);
    return value;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate given, fmi2Byte bytes[], size_t size)
{
    const SavedState *state = given;
    const fmi2Status status = check_state(c, "fmi2SerializeFMUstate", state);
    if (status != fmi2OK) return status;
    if (bytes == NULL || size < WORD_COUNT * WORD_SIZE) {
        return fail(c, "fmi2SerializeFMUstate: serializedState is NULL or shorter than the state");
    }
    const Snapshot *snapshot = &state->snapshot;
    fmi2Byte *next = put_int(bytes, (int64_t)state->model);
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
    return fmi2OK;
}

static bool is_mode(int64_t value)
{
    return value == MODE_INSTANTIATED || value == MODE_INITIALIZATION || value == MODE_STEP
        || value == MODE_TERMINATED || value == MODE_ERROR;
}

/* Whether the header is one that fmi2SerializeFMUstate writes for this FMU. */
static bool is_header(const fmi2Byte *bytes)
{
    const int64_t tick = int_at(bytes, 3);
    return (uint64_t)int_at(bytes, 0) == model_hash() && is_mode(int_at(bytes, 1)) && tick >= 0 && tick <= LAST_TICK;
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *place)
{
    Component *component = c;
    const fmi2Status status = check_mode(component, "fmi2DeSerializeFMUstate", MODE_ANY);
    if (status != fmi2OK) return status;
    if (bytes == NULL || place == NULL) return fail(component, "fmi2DeSerializeFMUstate: an argument is NULL");
    if (size != WORD_COUNT * WORD_SIZE || !is_header(bytes)) {
        return fail(component, "fmi2DeSerializeFMUstate: the bytes are not a state of this FMU");
    }
    SavedState *state = state_space(place);
    if (state == NULL) return fail(component, "fmi2DeSerializeFMUstate: out of memory");
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
    return fmi2OK;
}

#endif
