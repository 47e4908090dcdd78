/* Instantiates one FMU, to be compiled together with it: instantiate_fmu GUID. Prints what it logs; 1 if it refuses. */
#include <stdarg.h>
#include <stdio.h>

#include "fmi2Functions.h"

static void logger(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status, fmi2String category,
    fmi2String message, ...)
{
    (void)environment;
    (void)instance;
    (void)status;
    (void)category;
    va_list arguments;
    va_start(arguments, message);
    vprintf(message, arguments);
    va_end(arguments);
    printf("\n");
}

int main(int count, char **words)
{
    const fmi2CallbackFunctions callbacks = {logger, NULL, NULL, NULL, NULL};
    if (count != 2) return 2;
    fmi2Component fmu = fmi2Instantiate("fmu", fmi2CoSimulation, words[1], NULL, &callbacks, fmi2False, fmi2False);
    if (fmu == NULL) return 1;
    fmi2FreeInstance(fmu);
    return 0;
}
