/* What no FMU of this folder can do: calls that FMI 2.0 wants to be there and lets an FMU refuse. */
#include "fmi2Functions.h"

typedef const fmi2ValueReference *References;
#define NOT(name, ...) fmi2Status name(fmi2Component c, __VA_ARGS__) { return fmi2Error; }
fmi2Status fmi2CancelStep(fmi2Component c) { return fmi2Error; }
NOT(fmi2GetFMUstate, fmi2FMUstate *s)
NOT(fmi2SetFMUstate, fmi2FMUstate s)
NOT(fmi2FreeFMUstate, fmi2FMUstate *s)
NOT(fmi2SerializedFMUstateSize, fmi2FMUstate s, size_t *n)
NOT(fmi2SerializeFMUstate, fmi2FMUstate s, fmi2Byte b[], size_t n)
NOT(fmi2DeSerializeFMUstate, const fmi2Byte b[], size_t n, fmi2FMUstate *s)
NOT(fmi2GetDirectionalDerivative, References u, size_t n, References k, size_t m, const fmi2Real d[], fmi2Real v[])
NOT(fmi2SetRealInputDerivatives, References r, size_t n, const fmi2Integer order[], const fmi2Real v[])
NOT(fmi2GetRealOutputDerivatives, References r, size_t n, const fmi2Integer order[], fmi2Real v[])
NOT(fmi2GetStatus, const fmi2StatusKind k, fmi2Status *v)
NOT(fmi2GetIntegerStatus, const fmi2StatusKind k, fmi2Integer *v)
NOT(fmi2GetStringStatus, const fmi2StatusKind k, fmi2String *v)
