/* The bits of one FMU as a checksum, to be compiled together with it: the same by every compiler, on every processor.
 *
 *     checksum_fmu GUID KINDS CAUSALITIES STEP COUNT
 *
 * KINDS has a letter r, i or b (Real, Integer, Boolean) per value reference, CAUSALITIES a letter p, i, o or l
 * (parameter, input, output, local). Inputs are random; a step that fails is followed by a reset. All variables of all
 * steps enter the checksum (Fowler, Noll and Vo's FNV-1a). Prints it, and how many steps failed.
 */
#include <stdio.h>
#include <stdlib.h>

#include "drive_fmu.h"

static uint64_t checksum = UINT64_C(14695981039346656037);

static double number(void)
{
    const double sizes[] = {1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1e3, 1e4};
    return ((double)draw(1 << 30) / (1 << 29) - 1.0) * sizes[draw(sizeof sizes / sizeof sizes[0])];
}

static void add_variable(fmi2Component fmu, fmi2ValueReference reference, char kind)
{
    Value value;
    get(fmu, reference, kind, &value);
    if (kind == 'r' && value.real != value.real) value.real = 0.0; /* the sign of a NaN is the processor's */
    for (size_t i = 0; i < sizeof value; i++) checksum = (checksum ^ value.bytes[i]) * UINT64_C(1099511628211);
}

static fmi2Status initialise(fmi2Component fmu)
{
    fmi2SetupExperiment(fmu, fmi2False, 0.0, 0.0, fmi2False, 0.0);
    fmi2EnterInitializationMode(fmu);
    return fmi2ExitInitializationMode(fmu);
}

int main(int count, char **words)
{
    if (count != 6) return 2;
    const char *kinds = words[2], *causalities = words[3];
    const double step = atof(words[4]);
    const fmi2CallbackFunctions silent = {NULL, NULL, NULL, NULL, NULL};
    fmi2Component fmu = fmi2Instantiate("fmu", fmi2CoSimulation, words[1], NULL, &silent, fmi2False, fmi2False);
    if (fmu == NULL || initialise(fmu) != fmi2OK) return 1;
    int failed = 0;
    for (int n = 0, since = 0; n < atoi(words[5]); n++, since++) {
        for (size_t i = 0; kinds[i] != '\0'; i++) {
            if (causalities[i] != 'i' || draw(4) != 0) continue;
            const Value value = draw_value(kinds[i]);
            set(fmu, (fmi2ValueReference)i, kinds[i], &value);
        }
        const fmi2Status status = fmi2DoStep(fmu, since * step, step, fmi2True);
        for (size_t i = 0; kinds[i] != '\0'; i++) add_variable(fmu, (fmi2ValueReference)i, kinds[i]);
        if (status == fmi2OK) continue;
        failed++;
        since = -1;
        if (fmi2Reset(fmu) != fmi2OK || initialise(fmu) != fmi2OK) return 1;
    }
    printf("%016" PRIx64 " %d\n", checksum, failed);
    fmi2FreeInstance(fmu);
    return 0;
}
