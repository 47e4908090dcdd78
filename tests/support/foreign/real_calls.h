/* What the small FMUs of this folder have alike: no variables but Reals, and calls that have nothing to do. */
#include "refused_calls.h"

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }
const char *fmi2GetVersion(void) { return fmi2Version; }
fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String names[]) { return fmi2OK; }
fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean known, fmi2Real tolerance, fmi2Real start,
                               fmi2Boolean ends, fmi2Real stop) { return fmi2OK; }
fmi2Status fmi2Terminate(fmi2Component c) { return fmi2OK; }
fmi2Status fmi2GetInteger(fmi2Component c, References r, size_t n, fmi2Integer v[])
{ return n ? fmi2Error : fmi2OK; }
fmi2Status fmi2SetInteger(fmi2Component c, References r, size_t n, const fmi2Integer v[])
{ return n ? fmi2Error : fmi2OK; }
fmi2Status fmi2GetBoolean(fmi2Component c, References r, size_t n, fmi2Boolean v[])
{ return n ? fmi2Error : fmi2OK; }
fmi2Status fmi2SetBoolean(fmi2Component c, References r, size_t n, const fmi2Boolean v[])
{ return n ? fmi2Error : fmi2OK; }

NOT(fmi2GetString, References r, size_t n, fmi2String v[])
NOT(fmi2SetString, References r, size_t n, const fmi2String v[])
NOT(fmi2GetRealStatus, const fmi2StatusKind k, fmi2Real *v)
NOT(fmi2GetBooleanStatus, const fmi2StatusKind k, fmi2Boolean *v)
