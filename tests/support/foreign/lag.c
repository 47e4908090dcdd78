/* TAU y' = u - y as an FMU by hand, exact for an input held over a step: no memory to be had of it, no units. */
#include <math.h>
#include <stdlib.h>
#include "real_calls.h"

typedef struct { double value[2]; } Lag; /* u, y */

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String place,
                              const fmi2CallbackFunctions *call, fmi2Boolean visible, fmi2Boolean logging)
{ return calloc(1, sizeof(Lag)); }
void fmi2FreeInstance(fmi2Component c) { free(c); }
fmi2Status fmi2EnterInitializationMode(fmi2Component c) { return fmi2OK; }
fmi2Status fmi2ExitInitializationMode(fmi2Component c) { return fmi2OK; }
fmi2Status fmi2Reset(fmi2Component c) { *(Lag *)c = (Lag){{0.0, 0.0}}; return fmi2OK; }
fmi2Status fmi2GetReal(fmi2Component c, References r, size_t n, fmi2Real v[])
{ for (size_t i = 0; i < n; i++) v[i] = ((Lag *)c)->value[r[i]]; return fmi2OK; }
fmi2Status fmi2SetReal(fmi2Component c, References r, size_t n, const fmi2Real v[])
{ for (size_t i = 0; i < n; i++) ((Lag *)c)->value[r[i]] = v[i]; return fmi2OK; }
fmi2Status fmi2DoStep(fmi2Component c, fmi2Real t, fmi2Real h, fmi2Boolean final)
{ double *v = ((Lag *)c)->value; v[1] = v[0] + exp(-h / TAU) * (v[1] - v[0]); return fmi2OK; }
