/* FMI 3.0: complete FMU state, saved, restored, and as bytes. */
#ifndef FMI3_FMU_STATE_H
#define FMI3_FMU_STATE_H

#include "saved_state.h"

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *place)
{
    return save_state(instance_of(instance), "fmi3GetFMUState", place);
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState given)
{
    return restore_state(instance_of(instance), "fmi3SetFMUState", (const SavedState *)given);
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *place)
{
    return free_state(instance_of(instance), "fmi3FreeFMUState", place);
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState given, size_t *size)
{
    return serialised_size(instance_of(instance), "fmi3SerializedFMUStateSize", (const SavedState *)given, size);
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState given, fmi3Byte bytes[], size_t size)
{
    return serialise(instance_of(instance), "fmi3SerializeFMUState", (const SavedState *)given, bytes, size);
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte bytes[], size_t size, fmi3FMUState *place)
{
    return deserialise(instance_of(instance), "fmi3DeserializeFMUState", bytes, size, place);
}

#endif
