/* Instructions for FMUs of FMI 3.0: exchanges and steps, and the initialisation before a run. */

/* Return the addresses of the functions of an instruction's component. */
static const uint64_t *functions_of(const Run *run, const uint64_t *row)
{
    return run->fmi3.transfers.functions + (int64_t)row[COMPONENT] * run->fmi3.transfers.functions_columns;
}

static const int64_t *transfer_of(const Run *run, int64_t number)
{
    return run->fmi3.transfers.rows + TRANSFER_COLUMNS * number;
}

/* Execute an instruction of the communication step after `point`; return the fmi3Status. */
static int exchange_in_step(const Run *run, const uint64_t *row, double time, int64_t point)
{
    const uint64_t code = row[CODE], function = row[ADDRESS], instance = row[INSTANCE];
    const int64_t first = (int64_t)row[FIRST], count = (int64_t)row[COUNT];
    const StoredValues *const stored = &run->fmi3.stored;
    const double start = run->span.start, step = run->span.step;
    double *const values = run->buffers.values;
    int64_t *const outcome = run->buffers.outcome;
    outcome[FUNCTION_CALLED] = (int64_t)row[FUNCTION];
    if (code == SET_TRANSFER) {
        const int64_t *const transfer = transfer_of(run, first);
        if (transfer[KIND] != FLOAT64 || point < 0) { /* also in the initialisation, for comparison */
            to_stored(transfer[KIND], transfer[FIRST_VALUE], transfer[VALUES], values, stored, outcome);
            if (outcome[ENDING] != 0) return 0;
        }
        return exchange_transfer(run, function, instance, transfer);
    }
    if (code == GET_TRANSFER || code == READ_TRANSFER) {
        return get_transfer(run, function, instance, transfer_of(run, first), code == GET_TRANSFER);
    }
    if (code == COPY_EXACT) {
        for (int64_t i = 0; i < count; i++) {
            values[first + i] = values[(int64_t)row[ADDRESS] + i];
            stored->exact[first + i] = stored->exact[(int64_t)row[ADDRESS] + i];
        }
        return 0;
    }
    outcome[SUBJECT] = (int64_t)row[COMPONENT];
    if (code == SETTLE) {
        stored->time[1] = start;
        return settle(run, functions_of(run, row), instance);
    }
    const double end = start + (double)(point + 1) * step;
    if (count == 0) return step_to(run, functions_of(run, row), instance, time, step, end, first != 0);
    const double begin = start + (double)(point + 1 - count) * step;
    return step_to(run, functions_of(run, row), instance, begin, (double)count * step, end, first != 0);
}

/* Set the texts of a transfer in an FMU; return the fmi3Status. */
static int give_texts(const Run *run, uint64_t function, uint64_t instance, const int64_t *transfer)
{
    const uint32_t *const references = run->fmi3.transfers.reference + transfer[REFERENCE];
    const int64_t first = transfer[FIRST_VALUE], count = transfer[VALUES], variables = transfer[REFERENCES];
    if (transfer[KIND] == STRING) {
        return exchange_values(function, instance, references, variables, run->buffers.texts.address + first, count);
    }
    const uint64_t *const addresses = run->fmi3.binaries.address + first;
    return exchange_binaries(function, instance, references, variables, run->fmi3.sizes + first, addresses, count);
}

/* Get the texts of a transfer; return the fmi3Status. The outcome reports a text that is too long, a Binary as -1 - its
 * number. */
static int take_texts(const Run *run, uint64_t function, uint64_t instance, const int64_t *transfer)
{
    const uint32_t *const references = run->fmi3.transfers.reference + transfer[REFERENCE];
    const int64_t first = transfer[FIRST_VALUE], count = transfer[VALUES], variables = transfer[REFERENCES];
    int64_t *const outcome = run->buffers.outcome;
    if (transfer[KIND] == STRING) {
        const Texts *const texts = &run->buffers.texts;
        const int status = exchange_values(function, instance, references, variables, texts->given + first, count);
        for (int64_t t = first; is_well(status) && t < first + count; t++) {
            if (!keep_text(texts, t, outcome)) break;
        }
        return status;
    }
    const Texts *const binaries = &run->fmi3.binaries;
    uint64_t *const sizes = run->fmi3.sizes;
    const int status =
        exchange_binaries(function, instance, references, variables, sizes + first, binaries->given + first, count);
    if (!is_well(status)) return status;
    const uint64_t room = (uint64_t)binaries->rows_columns;
    for (int64_t t = first; t < first + count; t++) {
        if (sizes[t] > room) {
            outcome[ENDING] = TOO_LONG;
            outcome[SUBJECT] = -1 - t;
            break;
        }
        if (sizes[t] != 0) memcpy(binaries->rows + (uint64_t)t * room, POINTER(binaries->given[t]), (size_t)sizes[t]);
    }
    return status;
}

/* Set discrete inputs in event mode if one of them has changed; texts count as changed. Return the fmi3Status. */
static int set_events(const Run *run, const uint64_t *row)
{
    const uint64_t *const functions = functions_of(run, row);
    const uint64_t instance = row[INSTANCE];
    const int64_t first = (int64_t)row[FIRST], end = first + (int64_t)row[COUNT];
    int64_t *const outcome = run->buffers.outcome;
    bool changed = false;
    for (int64_t q = first; q < end; q++) {
        const int64_t *const transfer = transfer_of(run, q);
        changed |= transfer[KIND] >= STRING || to_stored(
            transfer[KIND], transfer[FIRST_VALUE], transfer[VALUES], run->buffers.values, &run->fmi3.stored, outcome);
    }
    if (!changed || outcome[ENDING] != 0) return 0;
    outcome[FUNCTION_CALLED] = ENTER_EVENT_MODE;
    int status = change_mode(functions[ENTER_EVENT_MODE], instance);
    for (int64_t q = first; is_well(status) && q < end; q++) {
        const int64_t *const transfer = transfer_of(run, q);
        outcome[FUNCTION_CALLED] = SETTERS + transfer[KIND];
        const uint64_t setter = functions[SETTERS + transfer[KIND]];
        status = transfer[KIND] >= STRING ? give_texts(run, setter, instance, transfer)
                                          : exchange_transfer(run, setter, instance, transfer);
    }
    return is_well(status) ? settle(run, functions, instance) : status;
}

/* Execute an instruction on texts or discrete inputs, in a communication step up to `after` (s). */
static int exchange_texts(const Run *run, const uint64_t *row, double after)
{
    const int64_t first = (int64_t)row[FIRST];
    int64_t *const outcome = run->buffers.outcome;
    outcome[FUNCTION_CALLED] = (int64_t)row[FUNCTION];
    if (row[CODE] == GIVE_TEXTS) return give_texts(run, row[ADDRESS], row[INSTANCE], transfer_of(run, first));
    if (row[CODE] == TAKE_TEXTS) return take_texts(run, row[ADDRESS], row[INSTANCE], transfer_of(run, first));
    if (row[CODE] == COPY_BINARY) {
        const Texts *const binaries = &run->fmi3.binaries;
        const size_t room = (size_t)binaries->rows_columns, size = (size_t)run->fmi3.sizes[row[ADDRESS]];
        run->fmi3.sizes[first] = size;
        if (size != 0) memcpy(binaries->rows + (size_t)first * room, binaries->rows + row[ADDRESS] * room, size);
        return 0;
    }
    outcome[SUBJECT] = (int64_t)row[COMPONENT];
    run->fmi3.stored.time[1] = after;
    return set_events(run, row);
}

/* Return the first parameter of a transfer that an FMU did not accept, -1 if it accepted all. */
static int64_t first_refused_of_transfer(const Run *run, const int64_t *transfer)
{
    static const size_t sizes[] = {
        [INT8] = 1, [UINT8] = 1, [INT16] = 2, [UINT16] = 2, [INT32] = 4, [UINT32] = 4, [INT64] = 8, [UINT64] = 8, [BOOLEAN] = 1,
    };
    const int64_t first = transfer[FIRST_VALUE], kind = transfer[KIND];
    const uint64_t *const given = run->fmi3.given + first, *const stored = run->fmi3.confirmed + first;
    for (int64_t i = 0; i < transfer[VALUES]; i++) {
        bool is_taken;
        if (kind == STRING) {
            is_taken = is_same_text(run->buffers.read_back.text[first + i], run->settings.text[first + i]);
        } else if (kind == FLOAT64) {
            is_taken = is_near(((const double *)stored)[i], ((const double *)given)[i]);
        } else if (kind == FLOAT32) {
            is_taken = is_near(((const float *)stored)[i], ((const float *)given)[i]);
        } else {
            const size_t at = sizes[kind] * (size_t)i;
            is_taken = memcmp((const char *)stored + at, (const char *)given + at, sizes[kind]) == 0;
        }
        if (!is_taken) return first + i;
    }
    return -1;
}

/* Execute an instruction of the initialisation; return the fmi3Status. A rejected parameter becomes the outcome. */
static int begin_fmi3(const Run *run, const uint64_t *row)
{
    if (row[CODE] == ENTER_INITIALIZATION) return set_up_experiment(run, row);
    const int64_t *const transfer = transfer_of(run, (int64_t)row[FIRST]);
    const bool gives = row[CODE] == GIVE_PARAMETERS;
    const int64_t first = transfer[FIRST_VALUE];
    const uint64_t *values = (gives ? run->fmi3.given : run->fmi3.confirmed) + first;
    if (transfer[KIND] == STRING) values = (gives ? run->settings.text : run->buffers.read_back.text) + first;
    const uint32_t *const references = run->fmi3.transfers.reference + transfer[REFERENCE];
    const int status =
        exchange_values(row[ADDRESS], row[INSTANCE], references, transfer[REFERENCES], values, transfer[VALUES]);
    if (gives || !is_well(status)) return status;
    const int64_t refused = first_refused_of_transfer(run, transfer);
    if (refused >= 0) {
        run->buffers.outcome[ENDING] = NOT_TAKEN;
        run->buffers.outcome[SUBJECT] = refused;
    }
    return status;
}
