/* FMI 2.0: complete FMU state, saved, restored, and as bytes. */
#ifndef FMI2_FMU_STATE_H
#define FMI2_FMU_STATE_H

#include "saved_state.h"

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *place)
{
    return save_state(instance_of(c), "fmi2GetFMUstate", place);
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate given)
{
    return restore_state(instance_of(c), "fmi2SetFMUstate", (const SavedState *)given);
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *place)
{
    return free_state(instance_of(c), "fmi2FreeFMUstate", place);
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate given, size_t *size)
{
    return serialised_size(instance_of(c), "fmi2SerializedFMUstateSize", (const SavedState *)given, size);
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate given, fmi2Byte bytes[], size_t size)
{
    return serialise(instance_of(c), "fmi2SerializeFMUstate", (const SavedState *)given, (Byte *)bytes, size);
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *place)
{
    return deserialise(instance_of(c), "fmi2DeSerializeFMUstate", (const Byte *)bytes, size, place);
}

#endif
