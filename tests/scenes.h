/* A scene that has everything, and short ways to scenes and worlds.
 * SPDX-License-Identifier: MIT */
#ifndef CAROM_TESTS_SCENES_H
#define CAROM_TESTS_SCENES_H

#include "carom.h"
#include "count.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const char everything[] =
	"\xEF\xBB\xBF{ \"pipeline\": { \"toi\": \"bisection\", \"epsilon\": 0.0009765625, \"iterations\": 3 },\n"
	"\t\"bodies\": [ {\"circle\": {\"radius\": 0.1}, \"position\": [-3, 1e-7], \"velocity\": [0.1, -0.2], \"angle\": -0.3,\n"
	"  \"angular_velocity\": 1e-3, \"density\": 7.8, \"restitution\": 0.25, \"force\": [0.1, 0], \"torque\": -0.7,\n"
	"  \"color\": \"#c3f\", \"name\": \"a \\\"quoted\\\" \\\\ \\u0001 \\n \\u00e9 \\ud83c\\udfb1 ]}\"},\n"
	"  {\"regular\": {\"sides\": 5, \"radius\": 0.3}, \"position\": [2, 2], \"mass\": 0.17, \"color\": \"#012345\"},\n"
	"  {\"polygon\": {\"vertices\": [[5, 5], [5, 6], [6.5, 6.1], [6.7, 5.2]]}, \"position\": [-0.0, 3.3], \"angle\": 3.1},\n"
	"  {\"polygon\": {\"vertices\": [[-1, -0.1], [1, -0.1], [1, 0.1], [-1, 0.1]]}, \"position\": [0, -3], \"static\": true, \"categories\": "
	"2147483649,\n"
	"  \"mask\": 0}], \"format\": \"carom-scene/1\", \"camera\": {\"center\": [0.1, -0.1], \"height\": 7}, \"time_step\": 0.01,\n"
	"\"gravity\": [-0, -9.81], \"restitution\": 0.9, \"room\": {\"min\": [-4, -4], \"max\": [4, 4.1]} }";

static inline carom_scene *parse(const char *text, size_t length)
{
	carom_scene *scene = NULL;
	carom_error error = {0};
	if (carom_scene_parse(text, length, "memory", &scene, &error) != CAROM_OK)
		fail_msg("%s", error.text);
	return scene;
}

static inline carom_world *world_of(carom_scene *scene)
{
	carom_world *world = NULL;
	carom_error error = {0};
	scene->world.device = "cpu";
	if (carom_scene_create_world(scene, &world, &error) != CAROM_OK)
		fail_msg("%s", error.text);
	return world;
}

#endif
