/* Steps a native FMU without Python: step_fmu LIBRARY GUID STEP COUNT OUTPUT_REFERENCE...
 * Prints one line per communication point: time and the outputs, digits enough for every bit.
 */
#include <dlfcn.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "fmi2FunctionTypes.h"

static void logger(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status, fmi2String category,
    fmi2String message, ...)
{
    (void)environment;
    va_list arguments;
    va_start(arguments, message);
    fprintf(stderr, "%s: %d: %s: ", instance, (int)status, category);
    vfprintf(stderr, message, arguments);
    va_end(arguments);
}

static void *function(void *library, const char *name)
{
    void *found = dlsym(library, name);
    if (found == NULL) {
        fprintf(stderr, "%s\n", dlerror());
        exit(1);
    }
    return found;
}

static void check(fmi2Status status)
{
    if (status != fmi2OK) exit(1);
}

int main(int count, char **words)
{
    void *library = count > 5 ? dlopen(words[1], RTLD_NOW) : NULL;
    if (library == NULL) return 2;
    const double step = atof(words[3]);
    const fmi2CallbackFunctions callbacks = {logger, NULL, NULL, NULL, NULL};
    fmi2InstantiateTYPE *instantiate = (fmi2InstantiateTYPE *)function(library, "fmi2Instantiate");
    fmi2GetRealTYPE *get_real = (fmi2GetRealTYPE *)function(library, "fmi2GetReal");
    fmi2DoStepTYPE *do_step = (fmi2DoStepTYPE *)function(library, "fmi2DoStep");
    fmi2Component fmu = instantiate("fmu", fmi2CoSimulation, words[2], NULL, &callbacks, fmi2False, fmi2False);
    if (fmu == NULL) return 1;
    check(((fmi2SetupExperimentTYPE *)function(library, "fmi2SetupExperiment"))(fmu, 0, 0.0, 0.0, 0, 0.0));
    check(((fmi2EnterInitializationModeTYPE *)function(library, "fmi2EnterInitializationMode"))(fmu));
    check(((fmi2ExitInitializationModeTYPE *)function(library, "fmi2ExitInitializationMode"))(fmu));
    for (int n = 0; n <= atoi(words[4]); n++) {
        if (n > 0) check(do_step(fmu, (n - 1) * step, step, fmi2True));
        printf("%.17g", n * step);
        for (int i = 5; i < count; i++) {
            const fmi2ValueReference reference = (fmi2ValueReference)atoi(words[i]);
            double value;
            check(get_real(fmu, &reference, 1, &value));
            printf(" %.17g", value);
        }
        printf("\n");
    }
    check(((fmi2TerminateTYPE *)function(library, "fmi2Terminate"))(fmu));
    ((fmi2FreeInstanceTYPE *)function(library, "fmi2FreeInstance"))(fmu);
    return 0;
}
