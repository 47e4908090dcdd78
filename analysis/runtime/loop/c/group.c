/* Consecutive runs without a return to the interpreter. */

static void set_inputs(const Run *run, const RunGroup *group, int64_t number)
{
    const int64_t reals = group->real_position_rows, wholes = group->whole_position_rows;
    const int64_t faults = group->fault_value_columns;
    for (int64_t v = 0; v < reals; v++) run->settings.real[group->real_position[v]] = group->real[number * reals + v];
    for (int64_t w = 0; w < wholes; w++) {
        run->settings.whole[group->whole_position[w]] = group->whole[number * wholes + w];
    }
    for (int64_t f = 0; f < faults; f++) {
        const int64_t at = number * faults + f;
        run->program.fault_window[2 * f] = group->fault_window[2 * at];
        run->program.fault_window[2 * f + 1] = group->fault_window[2 * at + 1];
        run->program.fault_value[f] = group->fault_value[at];
    }
}

/* Simulate the runs of a group, each from the start; return the number of simulated runs. The record must be large
 * enough for all. A run that does not complete is the last. */
EXPORT int64_t perilune_fly_group(const Run *first, const RunGroup *group)
{
    Run run = *first;
    for (int64_t number = 0; number < group->ends_rows; number++) {
        set_inputs(&run, group, number);
        run.recording.offset = perilune_fly(&run);
        run.span.reset = true;
        group->ends[number] = run.recording.offset;
        group->endings[number] = run.buffers.outcome[ENDING];
        if (group->endings[number] != STOP_TIME && group->endings[number] != FINISHED) return number + 1;
    }
    return group->ends_rows;
}
