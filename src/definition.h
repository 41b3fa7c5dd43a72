/* What a world may be made from. */
#ifndef CAROM_DEFINITION_H
#define CAROM_DEFINITION_H

#include <math.h>

#include "carom.h"

static inline bool carom_is_finite(carom_vec2 v)
{
	return isfinite(v.x) && isfinite(v.y);
}

/* May it be a coefficient of friction, or of rolling friction? */
static inline bool carom_is_friction(float number)
{
	return number >= 0.0f && number <= CAROM_MAX_FRICTION;
}

/* May it be a damping, 1/s? */
static inline bool carom_is_damping(float number)
{
	return number >= 0.0f && isfinite(number);
}

/* CAROM_INVALID_ARGUMENT names the field that is out of range; of names nothing is asked. */
carom_status carom_check_world_def(const carom_world_def *def, carom_error *error);

#endif
