/* What a scene file may hold of a body's joints, read as bodies are.
 * SPDX-License-Identifier: MIT */
#include "scene_json.h"

#include <math.h>
#include <string.h>

static const struct scene_range index_of_body = {0, INT32_MAX, false, "the index of another body"};

#define KINDS "\"revolute\", \"distance\", \"rope\", \"spring\" or \"slider\""

struct joint {
	carom_joint joint;
	const char *kind;
	uint32_t other;     /* UINT32_MAX: a place in the world */
	float lower, upper; /* rad, of the stops; NaN: none */
};

static struct joint begin(const carom_scene *scene)
{
	struct joint joint = {carom_default_joint(), NULL, UINT32_MAX, NAN, NAN};
	joint.joint.body = (uint32_t)scene->body_count;
	return joint;
}

static bool fit_kind(const char *name, carom_joint_kind *kind)
{
	for (int k = 0; k < SCENE_JOINT_KINDS; k++) {
		if (strcmp(name, scene_joint_kinds[k]) == 0) {
			*kind = (carom_joint_kind)k;
			return true;
		}
	}
	return false;
}

/* A key that can't be there, and what is allowed; NULL: all may be. */
static const char *find_misplaced(const struct joint *joint, const char **allowed)
{
	const carom_joint *given = &joint->joint;
	const bool is_spring = given->kind == CAROM_SPRING, is_slider = given->kind == CAROM_SLIDER, turns = is_slider || given->kind == CAROM_REVOLUTE;
	const bool has_lower = !isnan(joint->lower), has_upper = !isnan(joint->upper);
	static const char of_lines[] = "only with \"distance\", \"rope\" or \"spring\"", of_turns[] = "only with \"revolute\" or \"slider\"",
					  of_sliders[] = "only with \"slider\"", of_springs[] = "only with \"spring\"",
					  both[] = "lower_angle and upper_angle, or neither";
	const struct {
		const char *key, *allowed;
		bool is_misplaced;
	} rules[] = {
		{"length", of_lines, turns && !isnan(given->length)},
		{"motor_speed", of_turns, !turns && given->motor_speed != 0.0f},
		{"motor_torque", of_turns, !turns && given->motor_torque != 0.0f},
		{"lower_angle", of_turns, !turns && has_lower},
		{"upper_angle", of_turns, !turns && has_upper},
		{"axis", of_sliders, !is_slider && given->axis != 0.0f},
		{"stiffness", of_springs, !is_spring && given->stiffness != 0.0f},
		{"damping", of_springs, !is_spring && given->damping != 0.0f},
		{"lower_angle", both, has_lower && !has_upper},
		{"upper_angle", both, has_upper && !has_lower},
	};
	for (size_t i = 0; i < sizeof rules / sizeof *rules; i++) {
		*allowed = rules[i].allowed;
		if (rules[i].is_misplaced)
			return rules[i].key;
	}
	return NULL;
}

static const struct scene_field fields[] = {
	{"kind", scene_read_string, scene_quick_string, offsetof(struct joint, kind), NULL, true},
	{"body", scene_read_whole, scene_quick_whole, offsetof(struct joint, other), &index_of_body, false},
	{"anchor", scene_read_pair, scene_quick_pair, offsetof(struct joint, joint.anchor), &scene_any, false},
	{"other_anchor", scene_read_pair, scene_quick_pair, offsetof(struct joint, joint.other_anchor), &scene_any, false},
	{"length", scene_read_number, scene_quick_number, offsetof(struct joint, joint.length), &scene_damping, false},
	{"axis", scene_read_number, scene_quick_number, offsetof(struct joint, joint.axis), &scene_any, false},
	{"stiffness", scene_read_number, scene_quick_number, offsetof(struct joint, joint.stiffness), &scene_damping, false},
	{"damping", scene_read_number, scene_quick_number, offsetof(struct joint, joint.damping), &scene_damping, false},
	{"motor_speed", scene_read_number, scene_quick_number, offsetof(struct joint, joint.motor_speed), &scene_any, false},
	{"motor_torque", scene_read_number, scene_quick_number, offsetof(struct joint, joint.motor_torque), &scene_damping, false},
	{"lower_angle", scene_read_number, scene_quick_number, offsetof(struct joint, lower), &scene_any, false},
	{"upper_angle", scene_read_number, scene_quick_number, offsetof(struct joint, upper), &scene_any, false},
	{"collides", scene_read_flag, scene_quick_flag, offsetof(struct joint, joint.collides), NULL, false},
	{"force", scene_read_pair, scene_quick_pair, offsetof(struct joint, joint.force), &scene_any, false},
	{"torque", scene_read_pair, scene_quick_pair, offsetof(struct joint, joint.torque), &scene_any, false},
	SCENE_LAST_FIELD,
};

static bool add(carom_scene *scene, const struct joint *joint)
{
	carom_joint *joints = scene_grow(scene->joints, scene->joint_count, sizeof *joints);
	if (!joints)
		return false;
	scene->joints = joints;
	carom_joint *added = &joints[scene->joint_count++];
	*added = joint->joint;
	added->other = joint->other == UINT32_MAX ? CAROM_GROUND : (int32_t)joint->other;
	if (!isnan(joint->lower))
		added->has_stops = true, added->lower_angle = joint->lower, added->upper_angle = joint->upper;
	return true;
}

static carom_status read_one(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_range *range)
{
	struct joint joint = begin(reader->scene);
	(void)target;
	(void)range;
	carom_status status = scene_read_object(reader, place, value, &joint, fields);
	if (status != CAROM_OK)
		return status;
	if (!fit_kind(joint.kind, &joint.joint.kind))
		return scene_fail(reader, &(struct scene_place){place, "kind", 0}, "found \"%.40s\"; allowed: " KINDS, joint.kind);
	const char *allowed, *misplaced = find_misplaced(&joint, &allowed);
	if (misplaced)
		return scene_fail(reader, &(struct scene_place){place, misplaced, 0}, "found with \"%s\"; allowed: %s", joint.kind, allowed);
	return add(reader->scene, &joint) ? CAROM_OK : scene_fail_memory(reader);
}

static bool quick_one(struct scene_text *text)
{
	struct joint joint = begin(text->scene);
	const char *allowed;
	return scene_quick_object(text, &joint, fields) && fit_kind(joint.kind, &joint.joint.kind) && !find_misplaced(&joint, &allowed)
		&& add(text->scene, &joint);
}

carom_status scene_read_joints(struct scene_reader *reader, const struct scene_place *place, const json_t *value, void *target,
	const struct scene_range *range)
{
	if (!scene_is_array(value))
		return scene_fail_value(reader, place, value, "an array of joints");
	return scene_read_array(reader, place, value, target, 0, read_one, range);
}

bool scene_quick_joints(struct scene_text *text, void *target, const struct scene_range *range)
{
	(void)target;
	(void)range;
	return scene_quick_array(text, quick_one);
}
