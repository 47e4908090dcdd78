/* What the strict FMU cannot do: importers look all functions up, so they exist, and refuse. Included at its end. */
#include "fmi3Functions.h"

typedef const fmi3ValueReference *References;
#define MISSING(name, ...) fmi3Status name(fmi3Instance instance, ##__VA_ARGS__) { ME; return refuse(me, __func__); }
fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean on, size_t n, const fmi3String categories[]) {
    return fmi3OK;
}
fmi3Instance fmi3InstantiateModelExchange(
    fmi3String a, fmi3String b, fmi3String c, fmi3Boolean d, fmi3Boolean e, fmi3InstanceEnvironment f,
    fmi3LogMessageCallback g) { return NULL; }
fmi3Instance fmi3InstantiateScheduledExecution(
    fmi3String a, fmi3String b, fmi3String c, fmi3Boolean d, fmi3Boolean e, fmi3InstanceEnvironment f,
    fmi3LogMessageCallback g, fmi3ClockUpdateCallback h, fmi3LockPreemptionCallback i, fmi3UnlockPreemptionCallback j) {
    return NULL;
}
MISSING(fmi3GetClock, References a, size_t b, fmi3Clock c[])
MISSING(fmi3SetClock, References a, size_t b, const fmi3Clock c[])
MISSING(fmi3GetNumberOfVariableDependencies, fmi3ValueReference a, size_t *b)
MISSING(fmi3GetVariableDependencies, fmi3ValueReference a, size_t b[], fmi3ValueReference c[], size_t d[],
        fmi3DependencyKind e[], size_t f)
MISSING(fmi3GetFMUState, fmi3FMUState *a)
MISSING(fmi3SetFMUState, fmi3FMUState a)
MISSING(fmi3FreeFMUState, fmi3FMUState *a)
MISSING(fmi3SerializedFMUStateSize, fmi3FMUState a, size_t *b)
MISSING(fmi3SerializeFMUState, fmi3FMUState a, fmi3Byte b[], size_t c)
MISSING(fmi3DeserializeFMUState, const fmi3Byte a[], size_t b, fmi3FMUState *c)
MISSING(fmi3GetDirectionalDerivative, References a, size_t b, References c, size_t d, const fmi3Float64 e[], size_t f,
        fmi3Float64 g[], size_t h)
MISSING(fmi3GetAdjointDerivative, References a, size_t b, References c, size_t d, const fmi3Float64 e[], size_t f,
        fmi3Float64 g[], size_t h)
MISSING(fmi3GetIntervalDecimal, References a, size_t b, fmi3Float64 c[], fmi3IntervalQualifier d[])
MISSING(fmi3GetIntervalFraction, References a, size_t b, fmi3UInt64 c[], fmi3UInt64 d[], fmi3IntervalQualifier e[])
MISSING(fmi3GetShiftDecimal, References a, size_t b, fmi3Float64 c[])
MISSING(fmi3GetShiftFraction, References a, size_t b, fmi3UInt64 c[], fmi3UInt64 d[])
MISSING(fmi3SetIntervalDecimal, References a, size_t b, const fmi3Float64 c[])
MISSING(fmi3SetIntervalFraction, References a, size_t b, const fmi3UInt64 c[], const fmi3UInt64 d[])
MISSING(fmi3SetShiftDecimal, References a, size_t b, const fmi3Float64 c[])
MISSING(fmi3SetShiftFraction, References a, size_t b, const fmi3UInt64 c[], const fmi3UInt64 d[])
MISSING(fmi3EvaluateDiscreteStates)
MISSING(fmi3EnterContinuousTimeMode)
MISSING(fmi3CompletedIntegratorStep, fmi3Boolean a, fmi3Boolean *b, fmi3Boolean *c)
MISSING(fmi3SetTime, fmi3Float64 a)
MISSING(fmi3SetContinuousStates, const fmi3Float64 a[], size_t b)
MISSING(fmi3GetContinuousStateDerivatives, fmi3Float64 a[], size_t b)
MISSING(fmi3GetEventIndicators, fmi3Float64 a[], size_t b)
MISSING(fmi3GetContinuousStates, fmi3Float64 a[], size_t b)
MISSING(fmi3GetNominalsOfContinuousStates, fmi3Float64 a[], size_t b)
MISSING(fmi3GetNumberOfEventIndicators, size_t *a)
MISSING(fmi3GetNumberOfContinuousStates, size_t *a)
MISSING(fmi3GetOutputDerivatives, References a, size_t b, const fmi3Int32 c[], fmi3Float64 d[], size_t e)
MISSING(fmi3ActivateModelPartition, fmi3ValueReference a, fmi3Float64 b)
