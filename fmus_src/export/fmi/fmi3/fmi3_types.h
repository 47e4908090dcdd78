/* What FMI 3.0 calls a status, a logger and its environment. */
#ifndef FMI3_TYPES_H
#define FMI3_TYPES_H

#include "fmi3Functions.h"
#include "kernel_math.h"

#define STATUS_OK fmi3OK
#define STATUS_ERROR fmi3Error

typedef fmi3Status Status;
typedef fmi3LogMessageCallback Logger;
typedef fmi3InstanceEnvironment Environment;

/* Hand a message to the importer, who knows the instance by its environment. */
static COLD void log_error(Logger logger, Environment environment, const char *instance_name, const char *message)
{
    (void)instance_name;
    logger(environment, fmi3Error, "logStatusError", message);
}

#endif
