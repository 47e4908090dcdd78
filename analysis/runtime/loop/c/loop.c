/* The co-simulation loop: it initialises the FMUs and executes the instructions of every communication step.
 *
 * reference_loop.py defines the meaning of a step in Python; here a step is a list of instructions on slots. Every
 * exchanged number has a slot, a double; Integers, Booleans and Enumerations of FMI 2.0 are converted to 32-bit
 * integers in an array of the same layout. Slots of a component with the same type and direction are contiguous, so
 * that one FMI call transfers them.
 */

/* Return true for infinite values and NaN. */
static inline bool is_unbounded(double value)
{
    return !(fabs(value) < INFINITY);
}

static inline bool fits_whole(double value)
{
    return INT32_MIN <= value && value <= INT32_MAX;
}

static COLD int64_t end_at(int64_t *outcome, int64_t ending, int64_t subject, uint64_t instruction, int64_t rows)
{
    outcome[ENDING] = ending;
    outcome[SUBJECT] = subject;
    outcome[INSTRUCTION] = (int64_t)instruction;
    return rows;
}

static void prepare_memory(const Run *run)
{
    const Buffers *const buffers = &run->buffers;
    memcpy(buffers->values, run->program.initial, (size_t)buffers->values_rows * sizeof(double));
    for (int64_t f = 0; f < buffers->frozen_rows; f++) buffers->frozen[f] = NAN;
    reset_texts(&buffers->texts);
    if (run->has_fmi3) {
        const Fmi3 *const fmi3 = &run->fmi3;
        reset_texts(&fmi3->binaries);
        memcpy(fmi3->sizes, fmi3->initial_sizes, (size_t)fmi3->sizes_rows * sizeof(uint64_t));
        memset(fmi3->stored.sent, 0, (size_t)buffers->values_rows * sizeof(uint64_t));
        memcpy(fmi3->stored.exact, fmi3->start, (size_t)buffers->values_rows * sizeof(uint64_t));
    }
}

/* Map the source of a connection by its table; return false if the table has no entry for it. */
static bool map_value(const Program *program, int64_t c, const double *values, double *mapped)
{
    const int64_t first = program->table[2 * c], end = first + program->table[2 * c + 1];
    const double value = values[program->source[c]];
    for (int64_t entry = first; entry < end; entry++) {
        if (program->table_from[entry] == value) {
            *mapped = program->table_to[entry];
            return true;
        }
    }
    *mapped = value;
    return isnan(program->table_from[end - 1]); /* a partial table leaves other values unchanged */
}

static void inject(const Run *run, int64_t f, double *values, double after, int64_t point)
{
    const Program *const program = &run->program;
    const int64_t slot = program->fault_slot[f], kind = program->fault_kind[f];
    const double value = program->fault_value[f];
    if (!(program->fault_window[2 * f] <= after && after < program->fault_window[2 * f + 1])) return;
    if (kind == OVERRIDE) {
        values[slot] = value;
    } else if (kind == BIAS) {
        values[slot] += value;
    } else if (kind == EXCITE) {
        const int64_t row = point - run->span.first;
        if (row < run->excitation_rows) values[slot] += run->excitation[row * run->excitation_columns + (int64_t)value];
    } else {
        double *const frozen = &run->buffers.frozen[f];
        if (isnan(*frozen)) *frozen = values[slot];
        values[slot] = *frozen;
    }
}

/* Execute an instruction that is rare in steps or systems; return the status of the FMU. */
static COLD int execute_rare(const Run *run, const uint64_t *row, double time, double after, int64_t point)
{
    const uint64_t code = row[CODE];
    if (code <= COPY_TEXT) return exchange_text(row, &run->buffers.texts, run->buffers.outcome);
    if (code < SET_TRANSFER) return begin(run, row);
    if (code < COPY_BINARY) return exchange_in_step(run, row, time, point);
    if (code < GIVE_PARAMETERS) return exchange_texts(run, row, after);
    return begin_fmi3(run, row);
}

/* Initialise and simulate; return the number of rows in the record. The outcome states how the run ended. */
EXPORT int64_t perilune_fly(const Run *run)
{
    const Program *const program = &run->program;
    const Recording *const recording = &run->recording;
    const uint64_t *const instructions = program->instructions;
    const uint32_t *const reference = program->reference;
    const int64_t *const phases = program->phases;
    double *const values = run->buffers.values;
    int32_t *const whole = run->buffers.whole;
    int64_t *const outcome = run->buffers.outcome;
    const volatile int64_t *const halt = run->buffers.halt;
    const double start = run->span.start, step = run->span.step;
    const int64_t parts = program->phases_rows - 1, last_point = run->span.last;
    int64_t rows = recording->offset, to_record = 0;
    int64_t n = run->span.first; /* -1: the initialisation */
    int64_t phase = n > 0 ? n % parts : 0;
    uint64_t k, end;
    double after;
    for (int word = 0; word <= INSTRUCTION; word++) outcome[word] = 0;
    if (n < 0) {
        prepare_memory(run);
        k = run->span.reset ? 0 : (uint64_t)program->reset_end;
        end = (uint64_t)phases[0];
        after = start;
    } else {
        k = (uint64_t)phases[phase];
        end = (uint64_t)phases[phase + 1];
        after = start + (double)n * step;
    }
    for (;;) {
        if (run->fused_steps != 0 && n >= 0) {
            return ((FusedSteps *)(uintptr_t)run->fused_steps)(run, n, rows, to_record);
        }
        const double time = after;
        after = start + (double)(n + 1) * step;
        outcome[POINT_REACHED] = n + 1;
        for (; k < end; k++) {
            const uint64_t *const row = instructions + COLUMNS * k;
            const uint64_t address = row[ADDRESS];
            const int64_t first = (int64_t)row[FIRST], count = (int64_t)row[COUNT];
            int status = 0;
            double doubt = 0.0; /* NaN once a non-finite value was read */
            switch (row[CODE]) {
            case COPY:
                for (int64_t i = 0; i < count; i++) values[first + i] = values[(int64_t)address + i];
                continue;
            case PUT_REAL:
                for (int64_t i = 0; i < count; i++) ((double *)POINTER(address))[i] = values[first + i];
                continue;
            case MOVE_REAL: {
                const int64_t origin = (int64_t)row[FUNCTION];
                for (int64_t i = 0; i < count; i++) {
                    ((double *)POINTER(address))[i] = values[first + i] = values[origin + i];
                }
                continue;
            }
            case TAKE_REAL:
                for (int64_t i = 0; i < count; i++) {
                    const double value = ((const double *)POINTER(address))[i];
                    values[first + i] = value;
                    doubt += value - value;
                }
                break;
            case SET_REAL:
                status = exchange(address, row[INSTANCE], reference + first, row[COUNT], values + first);
                break;
            case GET_REAL:
                status = exchange(address, row[INSTANCE], reference + first, row[COUNT], values + first);
                for (int64_t slot = first; slot < first + count; slot++) {
                    if (is_unbounded(values[slot])) doubt = NAN;
                }
                break;
            case TAKE_WHOLE: {
                bool fits = true;
                for (int64_t i = 0; i < count; i++) {
                    const int64_t number = ((const int64_t *)POINTER(address))[i];
                    values[first + i] = (double)number;
                    fits &= INT32_MIN <= number && number <= INT32_MAX;
                }
                k += fits; /* otherwise the next instruction calls the FMU, which rejects the number */
                continue;
            }
            case TAKE_BOOLEAN:
                for (int64_t i = 0; i < count; i++) values[first + i] = ((const uint8_t *)POINTER(address))[i];
                continue;
            case STEP:
                outcome[SUBJECT] = (int64_t)row[COMPONENT];
                if (count == 0) {
                    status = do_step(address, row[INSTANCE], time, step);
                } else {
                    const double begin = start + (double)(n + 1 - count) * step;
                    status = do_step(address, row[INSTANCE], begin, (double)count * step);
                }
                break;
            case GET_WHOLE:
                status = exchange(address, row[INSTANCE], reference + first, row[COUNT], whole + first);
                for (int64_t slot = first; slot < first + count; slot++) values[slot] = whole[slot];
                break;
            case SET_WHOLE:
                for (int64_t slot = first; slot < first + count; slot++) {
                    if (!fits_whole(values[slot])) return end_at(outcome, NONFINITE, slot, k, rows);
                    whole[slot] = (int32_t)values[slot];
                }
                status = exchange(address, row[INSTANCE], reference + first, row[COUNT], whole + first);
                break;
            case TRANSFORM:
                for (int64_t c = first; c < first + count; c++) {
                    values[program->target[c]] = values[program->source[c]] * program->factor[c] + program->offset[c];
                }
                continue;
            case ADD:
                for (int64_t c = first; c < first + count; c++) {
                    values[program->target[c]] += values[program->source[c]] * program->factor[c] + program->offset[c];
                }
                continue;
            case MAP:
                for (int64_t c = first; c < first + count; c++) {
                    if (!map_value(program, c, values, &values[program->target[c]])) {
                        return end_at(outcome, UNMAPPED, program->source[c], k, rows);
                    }
                }
                continue;
            case INJECT:
                for (int64_t f = first; f < first + count; f++) inject(run, f, values, after, n);
                continue;
            case DRIVE: {
                const int64_t driven = n + 1 + (int64_t)address, last = program->drive_table_rows - 1;
                const double *const inputs =
                    program->drive_table + (driven < last ? driven : last) * program->drive_table_columns;
                for (int64_t d = first; d < first + count; d++) values[program->drive_slot[d]] = inputs[d];
                continue;
            }
            case RESTORE_FLOATS:
                restore_default_floats();
                continue;
            default:
                status = execute_rare(run, row, time, after, n);
                if (outcome[ENDING] != 0) {
                    outcome[INSTRUCTION] = (int64_t)k;
                    return rows;
                }
            }
            if (!is_well(status)) {
                const uint64_t code = row[CODE];
                if (code < SET_TRANSFER || code >= GIVE_PARAMETERS) outcome[FUNCTION_CALLED] = (int64_t)row[FUNCTION];
                outcome[STATUS_RETURNED] = status;
                return end_at(outcome, FAILED, (int64_t)row[COMPONENT], k, rows);
            }
            if (doubt != 0.0) {
                for (int64_t slot = first; slot < first + count; slot++) {
                    if (is_unbounded(values[slot])) return end_at(outcome, NONFINITE, slot, k, rows);
                }
            }
        }
        n += 1;
        const bool has_finished = program->finished_slot >= 0 && values[program->finished_slot] != 0.0;
        const bool is_last = has_finished || n == last_point || *halt != 0;
        if (is_last || to_record == 0) {
            to_record = recording->stride;
            recording->times[rows] = after;
            for (int64_t c = 0; c < recording->slots_rows; c++) {
                recording->record[c * recording->record_columns + rows] = values[recording->slots[c]];
            }
            rows += 1;
        }
        to_record -= 1;
        if (is_last) {
            outcome[ENDING] = has_finished ? FINISHED : n == last_point ? STOP_TIME : INTERRUPTED;
            return rows;
        }
        if (n > 0) phase = phase + 1 < parts ? phase + 1 : 0;
        k = (uint64_t)phases[phase];
        end = (uint64_t)phases[phase + 1];
    }
}
