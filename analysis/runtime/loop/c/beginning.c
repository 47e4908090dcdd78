/* Instructions executed once before a run: parameters, modes, and the check that FMUs accepted their parameters. */

#define LOSS 1e-6 /* permitted relative error of a Real, from single precision or conversion to another unit */

static bool is_near(double stored, double requested)
{
    return stored == requested || fabs(stored - requested) <= LOSS * fabs(requested) ||
           (isnan(stored) && isnan(requested));
}

static bool is_same_text(uint64_t stored, uint64_t requested)
{
    return stored != 0 && strcmp(POINTER(stored), POINTER(requested)) == 0;
}

/* Return the first parameter that an FMU of FMI 2.0 did not accept, -1 if it accepted all. */
static int64_t first_refused(const Run *run, uint64_t code, int64_t first, int64_t count)
{
    const Settings *const given = &run->settings, *const stored = &run->buffers.read_back;
    for (int64_t p = first; p < first + count; p++) {
        const bool is_taken = code == READ_BACK         ? is_near(stored->real[p], given->real[p])
                              : code == WHOLE_READ_BACK ? stored->whole[p] == given->whole[p]
                                                        : is_same_text(stored->text[p], given->text[p]);
        if (!is_taken) return p;
    }
    return -1;
}

/* Return the values of an instruction's parameters, in the array of their type. */
static const void *values_of(const Settings *settings, uint64_t type, int64_t first)
{
    if (type == PARAMETERS) return settings->real + first;
    if (type == WHOLE_PARAMETERS) return settings->whole + first;
    return settings->text + first;
}

static int set_up_experiment(const Run *run, const uint64_t *row)
{
    const double tolerance = run->program.tolerance[row[COMPONENT]];
    const bool known = !isnan(tolerance), ends = isfinite(run->span.stop);
    const double allowed = known ? tolerance : 0.0, stop = ends ? run->span.stop : 0.0;
    if (row[CODE] == SETUP) {
        typedef int SetupExperiment(void *, int, double, double, int, double);
        return ((SetupExperiment *)(uintptr_t)row[ADDRESS])(
            POINTER(row[INSTANCE]), known, allowed, run->span.start, ends, stop);
    }
    typedef int EnterInitializationMode(void *, bool, double, double, bool, double);
    return ((EnterInitializationMode *)(uintptr_t)row[ADDRESS])(
        POINTER(row[INSTANCE]), known, allowed, run->span.start, ends, stop);
}

/* Execute an instruction of the initialisation; return the fmi2Status. A rejected parameter becomes the outcome. */
static int begin(const Run *run, const uint64_t *row)
{
    const uint64_t code = row[CODE];
    const int64_t first = (int64_t)row[FIRST];
    if (code == SETUP) return set_up_experiment(run, row);
    if (code == MODE) return change_mode(row[ADDRESS], row[INSTANCE]);
    const bool reads = code >= READ_BACK;
    const Settings *const settings = reads ? &run->buffers.read_back : &run->settings;
    const void *const values = values_of(settings, reads ? code - READ_BACK + PARAMETERS : code, first);
    const uint32_t *const references = run->program.parameter_reference + first;
    const int status = exchange(row[ADDRESS], row[INSTANCE], references, row[COUNT], values);
    if (!reads || !is_well(status)) return status;
    const int64_t refused = first_refused(run, code, first, (int64_t)row[COUNT]);
    if (refused >= 0) {
        run->buffers.outcome[ENDING] = NOT_TAKEN;
        run->buffers.outcome[SUBJECT] = refused;
    }
    return status;
}
