/* Random numbers of the programs that drive an FMU: Marsaglia's xorshift64*, 2003, with Vigna's factor. */
#ifndef RANDOM_H
#define RANDOM_H

#include <inttypes.h>

static uint64_t generator = UINT64_C(88172645463325252);

static uint64_t draw(uint64_t below)
{
    generator ^= generator >> 12;
    generator ^= generator << 25;
    generator ^= generator >> 27;
    return (generator * UINT64_C(2685821657736338717) >> 16) % below;
}

#endif
