/* TAU y' = u - y as an FMU by hand, exact for an input held over a step: no memory to be had of it, no units. */
#include <math.h>
#include <stdlib.h>
#include "refused_calls.h"

typedef struct { double value[2]; } Lag; /* u, y */

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }
const char *fmi2GetVersion(void) { return fmi2Version; }
fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String place,
                              const fmi2CallbackFunctions *call, fmi2Boolean visible, fmi2Boolean logging)
{ return calloc(1, sizeof(Lag)); }
void fmi2FreeInstance(fmi2Component c) { free(c); }
fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String names[]) { return fmi2OK; }
fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean known, fmi2Real tolerance, fmi2Real start,
                               fmi2Boolean ends, fmi2Real stop) { return fmi2OK; }
fmi2Status fmi2EnterInitializationMode(fmi2Component c) { return fmi2OK; }
fmi2Status fmi2ExitInitializationMode(fmi2Component c) { return fmi2OK; }
fmi2Status fmi2Terminate(fmi2Component c) { return fmi2OK; }
fmi2Status fmi2Reset(fmi2Component c) { *(Lag *)c = (Lag){{0.0, 0.0}}; return fmi2OK; }
fmi2Status fmi2GetReal(fmi2Component c, References r, size_t n, fmi2Real v[])
{ for (size_t i = 0; i < n; i++) v[i] = ((Lag *)c)->value[r[i]]; return fmi2OK; }
fmi2Status fmi2SetReal(fmi2Component c, References r, size_t n, const fmi2Real v[])
{ for (size_t i = 0; i < n; i++) ((Lag *)c)->value[r[i]] = v[i]; return fmi2OK; }
fmi2Status fmi2GetInteger(fmi2Component c, References r, size_t n, fmi2Integer v[])
{ return n ? fmi2Error : fmi2OK; }
fmi2Status fmi2SetInteger(fmi2Component c, References r, size_t n, const fmi2Integer v[])
{ return n ? fmi2Error : fmi2OK; }
fmi2Status fmi2GetBoolean(fmi2Component c, References r, size_t n, fmi2Boolean v[])
{ return n ? fmi2Error : fmi2OK; }
fmi2Status fmi2SetBoolean(fmi2Component c, References r, size_t n, const fmi2Boolean v[])
{ return n ? fmi2Error : fmi2OK; }
fmi2Status fmi2DoStep(fmi2Component c, fmi2Real t, fmi2Real h, fmi2Boolean final)
{ double *v = ((Lag *)c)->value; v[1] = v[0] + exp(-h / TAU) * (v[1] - v[0]); return fmi2OK; }

NOT(fmi2GetString, References r, size_t n, fmi2String v[])
NOT(fmi2SetString, References r, size_t n, const fmi2String v[])
NOT(fmi2GetRealStatus, const fmi2StatusKind k, fmi2Real *v)
NOT(fmi2GetBooleanStatus, const fmi2StatusKind k, fmi2Boolean *v)
