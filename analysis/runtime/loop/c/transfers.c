/* Numbers exchanged with FMUs of FMI 3.0 in their FMI types: complete variables of one type in one call.
 *
 * A slot is a double; values of other types are converted and stored in words of eight bytes, one for each slot, of
 * which a transfer fills the first ones. 64-bit integers are exchanged exactly: `exact` contains them in addition to
 * the slots, and is valid if its value, rounded to a double, equals the number in the slot.
 */

#define WIDE 9223372036854775808.0 /* 2^63 */

static void refuse_slot(int64_t *outcome, int64_t slot)
{
    outcome[ENDING] = NONFINITE;
    outcome[SUBJECT] = slot;
}

/* Convert slots to integers of a type, stored in words; return true if they changed. */
#define CONVERT(type, low, high) \
    do { \
        type *const numbers = (type *)(stored->sent + first); \
        for (int64_t i = 0; i < count; i++) { \
            const double number = values[first + i]; \
            if (!((low) <= number && number <= (high))) { \
                refuse_slot(outcome, first + i); \
                continue; \
            } \
            changed |= (double)numbers[i] != number; \
            numbers[i] = (type)number; \
        } \
    } while (0)

static bool convert_wide(int64_t slot, bool is_signed, const double *values, const StoredValues *stored, int64_t *outcome)
{
    const double number = values[slot];
    uint64_t exact = stored->exact[slot];
    if ((is_signed ? (double)(int64_t)exact : (double)exact) != number) {
        if (!((is_signed ? -WIDE : 0.0) <= number && number < (is_signed ? WIDE : 2.0 * WIDE))) {
            refuse_slot(outcome, slot);
            return false;
        }
        exact = number < WIDE ? (uint64_t)(int64_t)number : (uint64_t)number;
    }
    const bool changed = stored->sent[slot] != exact;
    stored->sent[slot] = exact;
    return changed;
}

/* Convert slots to the values for an FMU; return true if they changed. A value out of range becomes the outcome. */
static bool to_stored(
    int64_t kind, int64_t first, int64_t count, const double *values, const StoredValues *stored, int64_t *outcome)
{
    bool changed = false;
    switch (kind) {
    case FLOAT64:
        for (int64_t slot = first; slot < first + count; slot++) {
            uint64_t bits;
            memcpy(&bits, &values[slot], sizeof bits);
            changed |= stored->sent[slot] != bits;
            stored->sent[slot] = bits;
        }
        break;
    case FLOAT32: {
        float *const single = (float *)(stored->sent + first);
        for (int64_t i = 0; i < count; i++) {
            const float rounded = (float)values[first + i];
            if (!(fabsf(rounded) < INFINITY)) refuse_slot(outcome, first + i);
            changed |= single[i] != rounded;
            single[i] = rounded;
        }
        break;
    }
    case INT64:
    case UINT64:
        for (int64_t slot = first; slot < first + count; slot++) {
            changed |= convert_wide(slot, kind == INT64, values, stored, outcome);
        }
        break;
    case BOOLEAN: {
        uint8_t *const truths = (uint8_t *)(stored->sent + first);
        for (int64_t i = 0; i < count; i++) {
            const uint8_t truth = values[first + i] != 0.0;
            changed |= truths[i] != truth;
            truths[i] = truth;
        }
        break;
    }
    case INT8: CONVERT(int8_t, INT8_MIN, INT8_MAX); break;
    case UINT8: CONVERT(uint8_t, 0, UINT8_MAX); break;
    case INT16: CONVERT(int16_t, INT16_MIN, INT16_MAX); break;
    case UINT16: CONVERT(uint16_t, 0, UINT16_MAX); break;
    case INT32: CONVERT(int32_t, INT32_MIN, INT32_MAX); break;
    case UINT32: CONVERT(uint32_t, 0, UINT32_MAX); break;
    }
    return changed;
}

#define TAKE(type) \
    for (int64_t i = 0; i < count; i++) values[first + i] = (double)((const type *)(stored->sent + first))[i]

/* Convert the values returned by an FMU to slots. */
static void from_stored(int64_t kind, int64_t first, int64_t count, double *values, const StoredValues *stored)
{
    switch (kind) {
    case FLOAT32: TAKE(float); break;
    case INT64:
        TAKE(int64_t);
        memcpy(stored->exact + first, stored->sent + first, (size_t)count * sizeof(uint64_t));
        break;
    case UINT64:
        TAKE(uint64_t);
        memcpy(stored->exact + first, stored->sent + first, (size_t)count * sizeof(uint64_t));
        break;
    case BOOLEAN:
    case UINT8: TAKE(uint8_t); break;
    case INT8: TAKE(int8_t); break;
    case INT16: TAKE(int16_t); break;
    case UINT16: TAKE(uint16_t); break;
    case INT32: TAKE(int32_t); break;
    case UINT32: TAKE(uint32_t); break;
    }
}

/* Return the values of a transfer of numbers; for doubles these are the slots themselves. */
static void *values_of_transfer(const Run *run, const int64_t *transfer)
{
    if (transfer[KIND] == FLOAT64) return run->buffers.values + transfer[FIRST_VALUE];
    return run->fmi3.stored.sent + transfer[FIRST_VALUE];
}

/* Exchange the numbers of a transfer, which are already converted for a setter; return the fmi3Status. */
static int exchange_transfer(const Run *run, uint64_t function, uint64_t instance, const int64_t *transfer)
{
    const uint32_t *const references = run->fmi3.transfers.reference + transfer[REFERENCE];
    void *const values = values_of_transfer(run, transfer);
    return exchange_values(function, instance, references, transfer[REFERENCES], values, transfer[VALUES]);
}

/* Get numbers from an FMU; return the fmi3Status. With `checks`, a non-finite Float becomes the outcome. */
static int get_transfer(const Run *run, uint64_t function, uint64_t instance, const int64_t *transfer, bool checks)
{
    const int64_t first = transfer[FIRST_VALUE], count = transfer[VALUES], kind = transfer[KIND];
    double *const values = run->buffers.values;
    const int status = exchange_transfer(run, function, instance, transfer);
    if (kind != FLOAT64) from_stored(kind, first, count, values, &run->fmi3.stored);
    if (!checks || kind > FLOAT32 || !is_well(status)) return status;
    for (int64_t slot = first; slot < first + count; slot++) {
        if (!(fabs(values[slot]) < INFINITY)) {
            refuse_slot(run->buffers.outcome, slot);
            break;
        }
    }
    return status;
}
