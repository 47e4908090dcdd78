/* Simulates a frozen run (frozen_run.py) of one FMU of FMI 3.0 through the loop, without Python; prints its record. */
#include "library.c"

#include <stdio.h>

#include "fmi3Functions.h"
#include "frozen_run.h"

static void log_message(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message)
{
    (void)environment, (void)status, (void)category;
    fprintf(stderr, "%s\n", message);
}

/* The functions that a run of a self-contained FMU calls, by their numbers. */
static const uintptr_t functions[] = {FUNCTIONS};

int main(int count, char **arguments)
{
    if (count != 2) return 2;
    const fmi3Instance instance = fmi3InstantiateCoSimulation(
        "frozen", arguments[1], NULL, false, true, false, false, NULL, 0, NULL, log_message, NULL);
    if (instance == NULL) return 3;
    for (uint64_t *row = run_program_instructions; row < run_program_instructions + COLUMNS * INSTRUCTIONS; row += COLUMNS) {
        if (row[INSTANCE] == 0) continue;
        row[INSTANCE] = (uint64_t)(uintptr_t)instance;
        row[ADDRESS] = functions[row[ADDRESS]];
    }
    uint64_t *const table = run_fmi3_transfers_functions;
    for (size_t number = 0; number < sizeof functions / sizeof *functions; number++) table[number] = functions[number];
    const int64_t rows = perilune_fly(&run);
    printf("%lld", (long long)run.buffers.outcome[ENDING]);
    for (int64_t c = 0; c < run.recording.slots_rows; c++) {
        for (int64_t row = 0; row < rows; row++) {
            uint64_t bits;
            memcpy(&bits, &run.recording.record[c * run.recording.record_columns + row], sizeof bits);
            printf(" %llx", (unsigned long long)bits);
        }
    }
    printf("\n");
    return 0;
}
