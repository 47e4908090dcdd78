/* Definitions for the statements of fused steps: members of the run, and ends of a flight.
 *
 * After a failure `outcome` has the same content as after a failure in the loop.
 */
#define PARTS_OF(run) \
    const uint64_t *const instructions = (run)->program.instructions; \
    const uint32_t *const reference = (run)->program.reference; \
    const double *const fault_window = (run)->program.fault_window; \
    const double *const fault_value = (run)->program.fault_value; \
    const double *const drive_table = (run)->program.drive_table; \
    const int64_t drive_rows = (run)->program.drive_table_rows; \
    const int64_t drive_columns = (run)->program.drive_table_columns; \
    double *const values = (run)->buffers.values; \
    int32_t *const whole = (run)->buffers.whole; \
    double *const frozen = (run)->buffers.frozen; \
    int64_t *const outcome = (run)->buffers.outcome; \
    const volatile int64_t *const halt = (run)->buffers.halt; \
    const uint32_t *const text_reference = (run)->buffers.texts.reference; \
    char *const *const text_address = (char *const *)(run)->buffers.texts.address; \
    const char **const text_given = (const char **)(run)->buffers.texts.given; \
    const int64_t text_size = (run)->buffers.texts.rows_columns; \
    const double *const excitation = (run)->excitation; \
    const int64_t excitation_rows = (run)->excitation_rows; \
    const int64_t excitation_columns = (run)->excitation_columns; \
    double *const record = (run)->recording.record; \
    double *const times = (run)->recording.times; \
    const int64_t capacity = (run)->recording.record_columns; \
    const int64_t stride = (run)->recording.stride; \
    const int64_t first_point = (run)->span.first; \
    const int64_t last_point = (run)->span.last; \
    const double start = (run)->span.start; \
    const double step = (run)->span.step; \
    (void)instructions, (void)reference, (void)fault_window, (void)fault_value, (void)drive_table, (void)drive_rows; \
    (void)drive_columns, (void)whole, (void)frozen, (void)text_reference, (void)text_address, (void)text_given; \
    (void)text_size, (void)excitation, (void)excitation_rows, (void)excitation_columns, (void)first_point; \
    (void)record, (void)capacity

#define END(code, subject, number) \
    do { \
        outcome[0] = code; \
        outcome[1] = subject; \
        outcome[5] = number; \
        return rows; \
    } while (0)

/* True for an fmi2Status more severe than a warning, or unknown to FMI. */
#define CHECK(status, component, function, number) \
    do { \
        if (status > FMI_WARNING || status < 0) { \
            outcome[2] = function; \
            outcome[3] = status; \
            END(FAILED, component, number); \
        } \
    } while (0)

/* Return the first slot of a range with a value that is not finite. */
#define CHECK_FINITE(first, count, number) \
    do { \
        for (int64_t slot = first; slot < first + count; slot++) { \
            if (!(fabs(values[slot]) < INFINITY)) END(NONFINITE, slot, number); \
        } \
    } while (0)

/* Convert a number to an Integer or a Boolean; it must fit into 32 bits. */
#define WHOLE(slot, number) \
    do { \
        if (!(values[slot] >= INT32_MIN && values[slot] <= INT32_MAX)) END(NONFINITE, slot, number); \
        whole[slot] = (int32_t)values[slot]; \
    } while (0)

/* Copy a String that an FMU returned to its row. */
#define TAKE_TEXT(text, number) \
    do { \
        if (text_given[text] == NULL) \
            text_address[text][0] = '\0'; \
        else \
            strncpy(text_address[text], text_given[text], (size_t)text_size); \
        if (text_address[text][text_size - 1] != '\0') END(TOO_LONG, text, number); \
    } while (0)

/* Faults on slots, each active in its window [start, end) s. */
#define DURING(fault, statement) \
    if (fault_window[2 * (fault)] <= after && after < fault_window[2 * (fault) + 1]) statement
#define INJECT_OVERRIDE(fault, slot) DURING(fault, values[slot] = fault_value[fault])
#define INJECT_BIAS(fault, slot) DURING(fault, values[slot] += fault_value[fault])
#define INJECT_FREEZE(fault, slot) \
    DURING(fault, { \
        if (isnan(frozen[fault])) frozen[fault] = values[slot]; \
        values[slot] = frozen[fault]; \
    })
#define INJECT_EXCITE(fault, slot) \
    DURING(fault, if (point - first_point < excitation_rows) values[slot] += \
        excitation[(point - first_point) * excitation_columns + (int64_t)fault_value[fault]])
