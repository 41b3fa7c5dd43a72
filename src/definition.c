/* What a world is made from: the defaults, and what is allowed. */
#include "definition.h"

#include "device.h"
#include "layout.h"
#include "status.h"

carom_world_def carom_default_world_def(void)
{
	carom_world_def def = {.time_step = 1.0f / 60.0f, .restitution = 1.0f, .epsilon = 3.814697265625e-6f /* 2^-18 */};
	return def;
}

carom_status carom_check_world_def(const carom_world_def *def, carom_error *error)
{
	if (!(def->time_step >= LEAST_STEP) || !isfinite(def->time_step))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "time_step: found %.9g, must be finite and at least 1.17549435e-38 (s)",
			(double)def->time_step);
	if (!carom_is_finite(def->gravity))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "gravity: must be two finite numbers (m/s^2)");
	if (!(def->restitution >= 0.0f && def->restitution <= 1.0f))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "restitution: found %g, must be from 0 to 1", (double)def->restitution);
	if (!carom_is_friction(def->friction))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "friction: found %g, must be from 0 to 1000", (double)def->friction);
	if (!carom_is_friction(def->rolling_friction))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "rolling_friction: found %g, must be from 0 to 1000", (double)def->rolling_friction);
	if (!carom_is_damping(def->linear_damping))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "linear_damping: found %g, must be finite and at least 0 (1/s)",
			(double)def->linear_damping);
	if (!carom_is_damping(def->angular_damping))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "angular_damping: found %g, must be finite and at least 0 (1/s)",
			(double)def->angular_damping);
	if (!(def->epsilon >= 2.384185791015625e-7f && def->epsilon <= 0.5f))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "epsilon: found %g, must be from 2^-22 to 0.5 (of a step)", (double)def->epsilon);
	if (def->storage != CAROM_STORAGE_AUTO && def->storage != CAROM_STORAGE_IMAGE && def->storage != CAROM_STORAGE_BUFFER)
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "storage: found %d, must be CAROM_STORAGE_AUTO, _IMAGE or _BUFFER", (int)def->storage);
	if (def->threads > CAROM_MOST_THREADS)
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "threads: found %u, must be from 1 to %d, or 0 for one a core", (unsigned)def->threads,
			CAROM_MOST_THREADS);
	if (def->has_room && (!carom_is_finite(def->room_min) || !carom_is_finite(def->room_max)))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "room: min and max must be two finite numbers each (m)");
	if (def->has_room && !(def->room_min.x < def->room_max.x && def->room_min.y < def->room_max.y))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "room: min (%g, %g) must be below max (%g, %g)", (double)def->room_min.x,
			(double)def->room_min.y, (double)def->room_max.x, (double)def->room_max.y);
	return CAROM_OK;
}
