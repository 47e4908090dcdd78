/* Strings of FMI 2.0, passed between FMUs as rows of bytes. */

static void reset_texts(const Texts *texts)
{
    const size_t size = (size_t)(texts->rows_rows * texts->rows_columns);
    if (size != 0) memcpy(texts->rows, texts->initial, size);
}

/* Copy a String that an FMU returned to its row. A String that is too long becomes the outcome. */
static bool keep_text(const Texts *texts, int64_t t, int64_t *outcome)
{
    uint8_t *const row = POINTER(texts->address[t]);
    const size_t room = (size_t)texts->rows_columns;
    if (texts->given[t] == 0) {
        row[0] = '\0';
        return true;
    }
    strncpy((char *)row, POINTER(texts->given[t]), room);
    if (row[room - 1] == '\0') return true;
    outcome[ENDING] = TOO_LONG;
    outcome[SUBJECT] = t;
    return false;
}

/* Execute an instruction on Strings; return the fmi2Status. */
static int exchange_text(const uint64_t *row, const Texts *texts, int64_t *outcome)
{
    const uint64_t function = row[ADDRESS], first = row[FIRST], count = row[COUNT];
    if (row[CODE] == COPY_TEXT) {
        strncpy(POINTER(texts->address[first]), POINTER(texts->address[row[ADDRESS]]), (size_t)texts->rows_columns);
        return 0;
    }
    const void *const texts_of_call = row[CODE] == SET_TEXT ? texts->address + first : texts->given + first;
    const int status = exchange(function, row[INSTANCE], texts->reference + first, count, texts_of_call);
    if (row[CODE] == SET_TEXT || !is_well(status)) return status;
    for (uint64_t t = first; t < first + count; t++) {
        if (!keep_text(texts, (int64_t)t, outcome)) break;
    }
    return status;
}
