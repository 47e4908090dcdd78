/* What programs that drive an FMU of FMI 2.0 share: a variable by its reference and kind: r, i or b (Real, Integer,
 * Boolean).
 */
#include <string.h>

#include "../native/random.h"
#include "fmi2Functions.h"

typedef union Value {
    fmi2Real real;
    fmi2Integer integer;
    fmi2Boolean boolean;
    unsigned char bytes[8];
} Value;

static double number(void); /* each program's own, of the sizes that it tries */

static Value draw_value(char kind)
{
    Value value;
    memset(&value, 0, sizeof value);
    if (kind == 'r') value.real = number();
    if (kind == 'i') value.integer = (fmi2Integer)draw(5);
    if (kind == 'b') value.boolean = (fmi2Boolean)draw(2);
    return value;
}

static fmi2Status get(fmi2Component fmu, fmi2ValueReference reference, char kind, Value *value)
{
    memset(value, 0, sizeof *value);
    if (kind == 'r') return fmi2GetReal(fmu, &reference, 1, &value->real);
    if (kind == 'i') return fmi2GetInteger(fmu, &reference, 1, &value->integer);
    return fmi2GetBoolean(fmu, &reference, 1, &value->boolean);
}

static fmi2Status set(fmi2Component fmu, fmi2ValueReference reference, char kind, const Value *value)
{
    if (kind == 'r') return fmi2SetReal(fmu, &reference, 1, &value->real);
    if (kind == 'i') return fmi2SetInteger(fmu, &reference, 1, &value->integer);
    return fmi2SetBoolean(fmu, &reference, 1, &value->boolean);
}
