/* What a world may be made from. */
#ifndef CAROM_DEFINITION_H
#define CAROM_DEFINITION_H

#include <math.h>

#include "carom.h"

static inline bool carom_is_finite(carom_vec2 v)
{
	return isfinite(v.x) && isfinite(v.y);
}

/* CAROM_INVALID_ARGUMENT names the field that is out of range; of names nothing is asked. */
carom_status carom_check_world_def(const carom_world_def *def, carom_error *error);

#endif
