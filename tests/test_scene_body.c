/* Bodies are read from the text or by way of a tree: both must agree.
 * SPDX-License-Identifier: MIT */
#include "scenes.h"

#include <stdio.h>

#define CIRCLE "\"circle\": {\"radius\": 0.5}"

/* Whatever a JSON reader has to decide; each is put between the brackets of "bodies". */
static const char *const texts[] = {
	"",
	" ",
	"{" CIRCLE "}",
	"{" CIRCLE ", \"position\": [1, -2.5], \"velocity\": [0.1, -0.0], \"angle\": 3, \"angular_velocity\": -1e-3}",
	" { " CIRCLE " , \"mass\" : 3 } , \n\t{" CIRCLE ",\"density\":7.8,\"restitution\":0.25,\"friction\":1e-1,\"rolling_friction\":0.02,\"linear_"
	"damping\":0.5,\"angular_damping\":1e30,\"force\":[1,2],\"torque\":-0}\r\n",
	"{" CIRCLE ", \"static\": true}, {" CIRCLE ", \"static\": false}",
	"{" CIRCLE ", \"kinematic\": true, \"velocity\": [1, 2]}, {" CIRCLE ", \"kinematic\": false}",
	"{" CIRCLE ", \"color\": \"#c3f\", \"name\": \"a b\"}, {" CIRCLE ", \"color\": \"#01aBcD\", \"name\": \"\"}",
	"{" CIRCLE ", \"name\": \"\\u00e9\\n\"}, {" CIRCLE ", \"name\": \"\xC3\xA9 ]}\"}",
	"{\"regular\": {\"sides\": 5, \"radius\": 0.3}}, {\"regular\": {\"radius\": 1e0, \"sides\": 64.0}}",
	"{\"polygon\": {\"vertices\": [[0, 0], [1, 0], [0, 1]]}}, {\"polygon\": {\"vertices\": [[0,0],[1,0],[1,1],[0,1]]}, \"angle\": 0.1}",
	"{" CIRCLE ", \"position\": [123456789012345678901234567890, 1.00000000000000000000001]}",
	"{" CIRCLE ", \"position\": [1e-45, 3.40282347e38]}",
	"{" CIRCLE ", \"angle\": 9007199254740993}",
	"{" CIRCLE ", \"contacts\": []}, {" CIRCLE ", \"contacts\": [{\"body\": 0, \"normal\": [1, 0.5]}, {\"wall\": \"top\", \"normal\": [2, 3]}]}",
	"{" CIRCLE ", \"contacts\" : [ {\"friction\": [-1, -0.0], \"normal\": [0, 1e-9], \"wall\": \"left\"} ], \"name\": \"\\u00e9\"}",
	"{" CIRCLE ", \"categories\": 6, \"mask\": 4294967295}, {" CIRCLE ", \"mask\": 0.0, \"categories\": 2147483648}",
	/* what is wrong */
	"{" CIRCLE ", \"mask\": 4294967296}",
	"{" CIRCLE ", \"mask\": -1}",
	"{" CIRCLE ", \"categories\": 1.5}",
	"{" CIRCLE ", \"categories\": [1]}",
	"{}",
	"{" CIRCLE "},",
	",{" CIRCLE "}",
	"{" CIRCLE "} {" CIRCLE "}",
	"{" CIRCLE "}}",
	"{" CIRCLE,
	"{" CIRCLE ",}",
	"{" CIRCLE ", \"angle\": 1,}",
	"{" CIRCLE " \"angle\": 1}",
	"{" CIRCLE ", \"angle\" 1}",
	"{" CIRCLE ", \"angle\": 01}",
	"{" CIRCLE ", \"angle\": 1.}",
	"{" CIRCLE ", \"angle\": .5}",
	"{" CIRCLE ", \"angle\": +1}",
	"{" CIRCLE ", \"angle\": 0x10}",
	"{" CIRCLE ", \"angle\": 1e999}",
	"{" CIRCLE ", \"angle\": 3.5e38}",
	"{" CIRCLE ", \"angle\": NaN}",
	"{" CIRCLE ", \"angle\": \"1\"}",
	"{" CIRCLE ", \"angle\": 1, \"angle\": 1}",
	"{" CIRCLE ", \"angel\": 1}",
	"{" CIRCLE ", \"angl\": 1}",
	"{" CIRCLE ", \"angles\": 1}",
	"{" CIRCLE ", \"\": 1}",
	"{" CIRCLE ", angle: 1}",
	"{" CIRCLE ", \"position\": [1]}",
	"{" CIRCLE ", \"position\": [1, 2, 3]}",
	"{" CIRCLE ", \"position\": [1, 2}",
	"{" CIRCLE ", \"position\": [1 2]}",
	"{" CIRCLE ", \"position\": [1,, 2]}",
	"{" CIRCLE ", \"mass\": 1, \"density\": 1}",
	"{" CIRCLE ", \"mass\": 0}",
	"{" CIRCLE ", \"mass\": 1e-46}",
	"{" CIRCLE ", \"restitution\": 1.1}",
	"{" CIRCLE ", \"restitution\": -0.1}",
	"{" CIRCLE ", \"friction\": 1000.1}",
	"{" CIRCLE ", \"rolling_friction\": 1000.1}",
	"{" CIRCLE ", \"linear_damping\": -0.1}",
	"{" CIRCLE ", \"angular_damping\": 1e39}",
	"{" CIRCLE ", \"friction\": -0.1}",
	"{" CIRCLE ", \"static\": 1}",
	"{" CIRCLE ", \"static\": truely}",
	"{" CIRCLE ", \"static\": tru}",
	"{" CIRCLE ", \"color\": \"#12345\"}",
	"{" CIRCLE ", \"color\": \"red\"}",
	"{" CIRCLE ", \"color\": 5}",
	"{" CIRCLE ", \"name\": \"a\tb\"}",
	"{" CIRCLE ", \"name\": \"\xFF\"}",
	"{" CIRCLE ", \"name\": \"open}",
	"{" CIRCLE ", " CIRCLE "}",
	"{" CIRCLE ", \"regular\": {\"sides\": 3, \"radius\": 1}}",
	"{\"circle\": {}}",
	"{\"circle\": {\"radius\": 0}}",
	"{\"circle\": {\"radius\": 1, \"radius\": 1}}",
	"{\"circle\": 1}",
	"{\"regular\": {\"sides\": 3}}",
	"{\"regular\": {\"sides\": 3.5, \"radius\": 1}}",
	"{\"regular\": {\"sides\": 65, \"radius\": 1}}",
	"{\"polygon\": {\"vertices\": [[0, 0], [1, 0]]}}",
	"{\"polygon\": {\"vertices\": []}}",
	"{\"polygon\": {\"vertices\": [[0, 0], [1, 0], [0, 1],]}}",
	"{\"polygon\": {\"vertices\": [[0, 0], [1, 0], 1]}}",
	"{\"position\": [0, 0]}",
	"{" CIRCLE ", \"contacts\": {}}",
	"{" CIRCLE ", \"contacts\": [{\"wall\": \"left\", \"normal\": [1, 1]}, {\"wall\": \"up\", \"normal\": [1, 1]}]}",
	"{" CIRCLE ", \"contacts\": [{\"body\": 0, \"normal\": [1, 1]}]}",
	"{" CIRCLE ", \"contacts\": [{\"body\": 4294967295, \"normal\": [1, 1]}]}",
	"[]",
	"null",
	"/* */ {" CIRCLE "}",
};

static void assert_same_bytes(const void *a, const void *b, size_t size, const char *text)
{
	if (memcmp(a, b, size) != 0)
		fail_msg("read in two ways: %s", text);
}

static void assert_same_body(const carom_body_def *a, const carom_body_def *b, const char *text)
{
	carom_body_def x = *a, y = *b;
	assert_int_equal(!a->name, !b->name);
	if (a->name)
		assert_string_equal(a->name, b->name);
	assert_int_equal(!a->vertices, !b->vertices);
	if (a->vertices && b->vertices)
		assert_same_bytes(a->vertices, b->vertices, a->vertex_count * sizeof *a->vertices, text);
	assert_int_equal(x.shape, y.shape);
	assert_int_equal(x.is_static, y.is_static);
	assert_int_equal(x.is_kinematic, y.is_kinematic);
	assert_true(x.sides == y.sides && x.vertex_count == y.vertex_count && x.color == y.color);
	assert_true(x.categories == y.categories && x.mask == y.mask);
	const float numbers[2][15] = {{x.radius, x.position.x, x.position.y, x.velocity.x, x.velocity.y, x.angle, x.angular_velocity, x.density, x.mass,
									  x.restitution, x.friction, x.rolling_friction, x.linear_damping, x.angular_damping, x.torque},
		{y.radius, y.position.x, y.position.y, y.velocity.x, y.velocity.y, y.angle, y.angular_velocity, y.density, y.mass, y.restitution, y.friction,
			y.rolling_friction, y.linear_damping, y.angular_damping, y.torque}};
	assert_same_bytes(numbers[0], numbers[1], sizeof numbers[0], text);
	assert_same_bytes(&x.force, &y.force, sizeof x.force, text);
}

static void assert_same_contacts(const carom_scene *a, const carom_scene *b, const char *text)
{
	assert_int_equal(a->contact_count, b->contact_count);
	if (a->contact_count > 0)
		assert_same_bytes(a->contacts, b->contacts, a->contact_count * sizeof *a->contacts, text);
}

/* Where "bodies" is written with an escape, all of them are read by way of a tree. */
static carom_status parse_bodies(const char *key, const char *bodies, carom_scene **scene)
{
	char text[1024];
	int length = snprintf(text, sizeof text, "{\"format\": \"carom-scene/1\", \"%s\": [%s]}", key, bodies);
	char *cut = malloc((size_t)length); /* just as long, for the sanitizers to see a look beyond */
	assert_true(cut && length < (int)sizeof text);
	memcpy(cut, text, (size_t)length);
	*scene = NULL;
	carom_status status = carom_scene_parse(cut, (size_t)length, "memory", scene, NULL);
	free(cut);
	return status;
}

static void check_both_ways(const char *bodies)
{
	carom_scene *plain, *by_tree;
	carom_status status = parse_bodies("bodies", bodies, &plain), wanted = parse_bodies("\\u0062odies", bodies, &by_tree);
	if (status != wanted)
		fail_msg("%s, by way of a tree %s: %s", carom_status_name(status), carom_status_name(wanted), bodies);
	if (status == CAROM_OK) {
		assert_int_equal(plain->body_count, by_tree->body_count);
		for (size_t k = 0; k < plain->body_count; k++)
			assert_same_body(&plain->bodies[k], &by_tree->bodies[k], bodies);
		assert_same_contacts(plain, by_tree, bodies);
	}
	carom_scene_destroy(plain);
	carom_scene_destroy(by_tree);
}

static void both_ways_of_reading_agree(void **state)
{
	(void)state;
	for (size_t k = 0; k < COUNT(texts); k++)
		check_both_ways(texts[k]);
}

/* One character more, less or another. */
static void both_ways_agree_on_damaged_texts(void **state)
{
	static const char others[] = "{}[]\",:.-+e0 \\x\n";
	(void)state;
	for (size_t k = 0; k < 15; k++) {
		size_t length = strlen(texts[k]);
		for (size_t at = 0; at < length; at++) {
			char damaged[512];
			char other = others[(at + k) % (sizeof others - 1)];
			snprintf(damaged, sizeof damaged, "%.*s%s", (int)at, texts[k], texts[k] + at + 1);
			check_both_ways(damaged);
			snprintf(damaged, sizeof damaged, "%.*s%c%s", (int)at, texts[k], other, texts[k] + at);
			check_both_ways(damaged);
			snprintf(damaged, sizeof damaged, "%.*s%c%s", (int)at, texts[k], other, texts[k] + at + 1);
			check_both_ways(damaged);
		}
	}
}

/* Of a bar of ten metres, so thick: is it a body? */
static bool is_body(const char *thickness)
{
	char text[256];
	carom_scene *scene = NULL;
	carom_world *world = NULL;
	carom_error error;
	const int length = snprintf(text, sizeof text,
		"{\"format\": \"carom-scene/1\", \"bodies\": [{\"polygon\": {\"vertices\": [[0, 0], [10, 0], [10, %s], [0, %s]]}}]}", thickness, thickness);
	if (carom_scene_parse(text, (size_t)length, "bar", &scene, &error))
		fail_msg("%s", error.text);
	scene->world.device = "cpu";
	const carom_status status = carom_scene_create_world(scene, &world, &error);
	assert_true(status == CAROM_OK || strstr(error.text, "a millionth of its length"));
	carom_world_destroy(world);
	carom_scene_destroy(scene);
	return status == CAROM_OK;
}

static void bars_may_be_a_millionth_thick(void **unused)
{
	(void)unused;
	assert_true(is_body("1.01e-5"));
	assert_false(is_body("0.99e-5"));
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(bars_may_be_a_millionth_thick), cmocka_unit_test(both_ways_of_reading_agree),
		cmocka_unit_test(both_ways_agree_on_damaged_texts)};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
