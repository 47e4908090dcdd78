/* What FMI 2.0 calls a status, a logger and its environment. */
#ifndef FMI2_TYPES_H
#define FMI2_TYPES_H

#include "fmi2Functions.h"
#include "kernel_math.h"

#include <stdio.h>

/* This copy of fmi2Functions.h adds no prefix to the names of functions, so ask its macros to do so. */
#ifdef FMI2_FUNCTION_PREFIX
#undef fmi2FullName
#define fmi2FullName(name) WITH_PREFIX(FMI2_FUNCTION_PREFIX, name)
#define WITH_PREFIX(prefix, name) JOINED(prefix, name)
#define JOINED(prefix, name) prefix##name
#endif

#define STATUS_OK fmi2OK
#define STATUS_ERROR fmi2Error

typedef fmi2Status Status;
typedef fmi2CallbackLogger Logger;
typedef fmi2ComponentEnvironment Environment;

/* The name of an element. */
static COLD void name_element(uint32_t element, char name[NAME_SIZE])
{
    snprintf(name, NAME_SIZE, "%s", NAMES[element]);
}

/* Hand a message to the importer. */
static COLD void log_error(Logger logger, Environment environment, const char *instance_name, const char *message)
{
    logger(environment, instance_name, fmi2Error, "logStatusError", "%s", message);
}

#endif
