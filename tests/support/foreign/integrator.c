/* x' = u as an FMU by hand: no memory to be had of it, and no units. */
#include <stdlib.h>
#include "real_calls.h"

typedef struct { double value[2]; } Integrator; /* u, y */

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String place,
                              const fmi2CallbackFunctions *call, fmi2Boolean visible, fmi2Boolean logging)
{ return calloc(1, sizeof(Integrator)); }
void fmi2FreeInstance(fmi2Component c) { free(c); }
fmi2Status fmi2EnterInitializationMode(fmi2Component c) { ((Integrator *)c)->value[1] = 1.0; return fmi2OK; }
fmi2Status fmi2ExitInitializationMode(fmi2Component c) { return fmi2OK; }
fmi2Status fmi2Reset(fmi2Component c) { *(Integrator *)c = (Integrator){{0.0, 0.0}}; return fmi2OK; }
fmi2Status fmi2GetReal(fmi2Component c, References r, size_t n, fmi2Real v[])
{ for (size_t i = 0; i < n; i++) v[i] = ((Integrator *)c)->value[r[i]]; return fmi2OK; }
fmi2Status fmi2SetReal(fmi2Component c, References r, size_t n, const fmi2Real v[])
{ for (size_t i = 0; i < n; i++) ((Integrator *)c)->value[r[i]] = v[i]; return fmi2OK; }
fmi2Status fmi2DoStep(fmi2Component c, fmi2Real t, fmi2Real h, fmi2Boolean final)
{ double *v = ((Integrator *)c)->value; v[1] += h * v[0]; return fmi2OK; }
