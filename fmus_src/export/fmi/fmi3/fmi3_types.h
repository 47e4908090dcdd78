/* What FMI 3.0 calls a status, a logger and its environment. */
#ifndef FMI3_TYPES_H
#define FMI3_TYPES_H

#include "fmi3Functions.h"
#include "kernel_math.h"

#include <stdio.h>

#define STATUS_OK fmi3OK
#define STATUS_ERROR fmi3Error

typedef fmi3Status Status;
typedef fmi3LogMessageCallback Logger;
typedef fmi3InstanceEnvironment Environment;

/* The name of an element, as FMI 2.0 has it. */
static COLD void name_element(uint32_t element, char name[NAME_SIZE])
{
    size_t number = 0;
    while (VARIABLES[number].first + VARIABLES[number].size <= element) number++;
    const uint32_t columns = VARIABLES[number].columns, place = element - VARIABLES[number].first;
    if (columns == 0) {
        snprintf(name, NAME_SIZE, "%s", NAMES[number]);
    } else if (columns == 1) {
        snprintf(name, NAME_SIZE, "%s[%u]", NAMES[number], place + 1);
    } else {
        snprintf(name, NAME_SIZE, "%s[%u,%u]", NAMES[number], place / columns + 1, place % columns + 1);
    }
}

/* Hand a message to the importer, who knows the instance by its environment. */
static COLD void log_error(Logger logger, Environment environment, const char *instance_name, const char *message)
{
    (void)instance_name;
    logger(environment, fmi3Error, "logStatusError", message);
}

#endif
