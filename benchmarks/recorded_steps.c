/* Steps the block of an FMU of FMI 2 with recorded inputs, for `benchmarks.guidance_cost`, and prints the time of each
 * step, us, first that of the initialisation. BLOCK is the C of the FMU, RECORDING a header that guidance_cost writes;
 * callgrind counts in `counted`. */

#include BLOCK
#include RECORDING

#include <stdlib.h>
#include <time.h>

static void log_message(void *e, const char *name, fmi2Status s, const char *c, const char *text, ...)
{
    (void)e, (void)c;
    fprintf(stderr, "%s: status %d: %s\n", name, s, text);
}

static void check(fmi2Status status)
{
    if (status != fmi2OK) exit(1);
}

/* The initialisation for k = 0, else step k. */
__attribute__((noinline)) fmi2Status counted(fmi2Component block, size_t k)
{
    return k == 0 ? fmi2ExitInitializationMode(block) : fmi2DoStep(block, (double)(k - 1) * STEP, STEP, fmi2True);
}

int main(void)
{
    const fmi2CallbackFunctions callbacks = {log_message, calloc, free, NULL, NULL};
    fmi2Component block = fmi2Instantiate("block", fmi2CoSimulation, MODEL_GUID, "", &callbacks, fmi2False, fmi2False);
    if (block == NULL) return 1;
    check(fmi2SetupExperiment(block, fmi2False, 0.0, 0.0, fmi2False, 0.0));
    check(fmi2SetReal(block, REALS, sizeof REALS / sizeof *REALS, REAL_VALUES));
    check(fmi2SetInteger(block, INTEGERS, sizeof INTEGERS / sizeof *INTEGERS, INTEGER_VALUES));
    check(fmi2SetBoolean(block, BOOLEANS, sizeof BOOLEANS / sizeof *BOOLEANS, BOOLEAN_VALUES));
    check(fmi2SetReal(block, INPUTS, sizeof INPUTS / sizeof *INPUTS, ROWS[0]));
    check(fmi2EnterInitializationMode(block));
    for (size_t k = 0; k <= sizeof ROWS / sizeof *ROWS; k++) {
        struct timespec begin, end;
        if (k > 0) check(fmi2SetReal(block, INPUTS, sizeof INPUTS / sizeof *INPUTS, ROWS[k - 1]));
        clock_gettime(CLOCK_MONOTONIC, &begin);
        check(counted(block, k));
        clock_gettime(CLOCK_MONOTONIC, &end);
        printf("%.3f\n", (end.tv_sec - begin.tv_sec) * 1e6 + (end.tv_nsec - begin.tv_nsec) * 1e-3);
    }
    fmi2FreeInstance(block);
    return 0;
}
