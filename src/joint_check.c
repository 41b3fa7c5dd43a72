/* What a joint may be: errors name it, and the field. */
#include <math.h>

#include "status.h"
#include "world.h"

#define FARTHEST_ANCHOR 1e9f  /* m */
#define SHORTEST_PART 0.01f   /* of the bodies' radii, a rod */
#define STIFFEST 1e12f        /* N/m, and N s/m */
#define FASTEST_MOTOR 1e9f    /* rad/s */
#define STRONGEST_MOTOR 1e30f /* N m */
#define TWO_PI 6.28318531f

carom_status carom_joint_check_parties(const carom_world *world, size_t k, const carom_joint *joint, carom_error *error)
{
	const carom_body *bodies = carom_world_bodies(world);
	if ((int)joint->kind < CAROM_REVOLUTE || (int)joint->kind > CAROM_SLIDER)
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "joints[%zu].kind: found %d, must be one of carom_joint_kind", k, (int)joint->kind);
	if (joint->body >= world->body_count)
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "joints[%zu].body: found %u, the world has %zu bodies", k, joint->body, world->body_count);
	if (joint->other != CAROM_GROUND && (joint->other < 0 || (size_t)joint->other >= world->body_count || (uint32_t)joint->other == joint->body))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "joints[%zu].other: found %d, must be the index of another one of %zu bodies", k,
			(int)joint->other, world->body_count);
	if (!carom_is_dynamic(&bodies[joint->body]) && (joint->other == CAROM_GROUND || !carom_is_dynamic(&bodies[joint->other])))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "joints[%zu]: one of the two must be dynamic, and body %u is %s", k, joint->body,
			bodies[joint->body].is_static ? "static" : "kinematic");
	return CAROM_OK;
}

static bool may_be_anchor(carom_vec2 v)
{
	return fabsf(v.x) <= FARTHEST_ANCHOR && fabsf(v.y) <= FARTHEST_ANCHOR;
}

bool carom_joint_turns(const carom_joint *joint)
{
	return joint->kind == CAROM_REVOLUTE || joint->kind == CAROM_SLIDER;
}

/* A shorter rod has no way that it is sure of. A spring that is none has no force, either. */
static float least_length(const carom_world *world, const carom_joint *joint)
{
	const carom_body *bodies = carom_world_bodies(world);
	if (joint->kind == CAROM_SPRING)
		return 0.0f;
	return SHORTEST_PART * (bodies[joint->body].bound + (joint->other == CAROM_GROUND ? 0.0f : bodies[joint->other].bound));
}

/* What only a joint of that kind has: others leave it as it is by default. */
static carom_status check_kind(size_t k, const carom_joint *joint, carom_error *error)
{
	const struct {
		const char *name, *kind;
		bool is_said, may_be;
	} fields[] = {
		{"stiffness", "CAROM_SPRING", joint->stiffness != 0.0f, joint->kind == CAROM_SPRING},
		{"damping", "CAROM_SPRING", joint->damping != 0.0f, joint->kind == CAROM_SPRING},
		{"axis", "CAROM_SLIDER", joint->axis != 0.0f, joint->kind == CAROM_SLIDER},
		{"motor_speed", "CAROM_REVOLUTE or CAROM_SLIDER", joint->motor_speed != 0.0f, carom_joint_turns(joint)},
		{"motor_torque", "CAROM_REVOLUTE or CAROM_SLIDER", joint->motor_torque != 0.0f, carom_joint_turns(joint)},
		{"has_stops", "CAROM_REVOLUTE or CAROM_SLIDER", joint->has_stops, carom_joint_turns(joint)},
	};
	for (size_t i = 0; i < sizeof fields / sizeof *fields; i++)
		if (fields[i].is_said && !fields[i].may_be)
			return carom_fail(error, CAROM_INVALID_ARGUMENT, "joints[%zu].%s: only a joint of kind %s has it", k, fields[i].name, fields[i].kind);
	return CAROM_OK;
}

static carom_status check_range(size_t k, const char *name, float value, float least, float most, const char *unit, carom_error *error)
{
	if (value >= least && value <= most)
		return CAROM_OK;
	return carom_fail(error, CAROM_INVALID_ARGUMENT, "joints[%zu].%s: found %g, must be a number from %g to %g (%s)", k, name, (double)value,
		(double)least, (double)most, unit);
}

/* Motors, stops and springs. */
static carom_status check_drive(size_t k, const carom_joint *joint, carom_error *error)
{
	const float lower = joint->lower_angle, upper = joint->upper_angle;
	TRY(check_kind(k, joint, error));
	TRY(check_range(k, "stiffness", joint->stiffness, 0.0f, STIFFEST, "N/m", error));
	TRY(check_range(k, "damping", joint->damping, 0.0f, STIFFEST, "N s/m", error));
	if (joint->kind == CAROM_SPRING && joint->stiffness == 0.0f && joint->damping == 0.0f)
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "joints[%zu].stiffness: a spring must have that, or damping, above 0", k);
	TRY(check_range(k, "axis", joint->axis, -TWO_PI, TWO_PI, "rad", error));
	TRY(check_range(k, "motor_speed", joint->motor_speed, -FASTEST_MOTOR, FASTEST_MOTOR, "rad/s", error));
	TRY(check_range(k, "motor_torque", joint->motor_torque, 0.0f, STRONGEST_MOTOR, "N m", error));
	if (!joint->has_stops)
		return CAROM_OK;
	TRY(check_range(k, "lower_angle", lower, -TWO_PI, TWO_PI, "rad", error));
	TRY(check_range(k, "upper_angle", upper, -TWO_PI, TWO_PI, "rad", error));
	if (!(upper >= lower && (double)upper - (double)lower < (double)TWO_PI))
		return carom_fail(error, CAROM_INVALID_ARGUMENT,
			"joints[%zu].upper_angle: found %g, must be from lower_angle (%g) on, and less than 2 pi above", k, (double)upper, (double)lower);
	return CAROM_OK;
}

carom_status carom_joint_check_numbers(const carom_world *world, size_t k, const carom_joint *joint, carom_error *error)
{
	const carom_vec2 anchors[] = {joint->anchor, joint->other_anchor};
	static const char *const anchor_names[] = {"anchor", "other_anchor"};
	for (int side = 0; side < 2; side++)
		if (!may_be_anchor(anchors[side]))
			return carom_fail(error, CAROM_INVALID_ARGUMENT, "joints[%zu].%s: found (%g, %g), must be two numbers from -1e9 to 1e9 (m)", k,
				anchor_names[side], (double)anchors[side].x, (double)anchors[side].y);
	if (!carom_joint_turns(joint) && !(joint->length >= least_length(world, joint) && joint->length <= FARTHEST_ANCHOR))
		return carom_fail(error, CAROM_INVALID_ARGUMENT,
			"joints[%zu].length: found %g, must be a number from %g%s, to 1e9 (m); where it is not given it is from anchor to other_anchor", k,
			(double)joint->length, (double)least_length(world, joint), joint->kind == CAROM_SPRING ? "" : ", a hundredth of the bodies' radii");
	TRY(check_drive(k, joint, error));
	if (!isfinite(joint->force[0]) || !isfinite(joint->force[1]))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "joints[%zu].force: must be two finite numbers (N)", k);
	if (!isfinite(joint->torque[0]) || !isfinite(joint->torque[1]))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "joints[%zu].torque: must be two finite numbers (N m)", k);
	return CAROM_OK;
}
