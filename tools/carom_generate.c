/* carom generate: a scene of many bodies.
 * SPDX-License-Identifier: MIT */
#include "carom_placement.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

struct generate_options {
	struct common_options common;
	const char *shape; /* as it was given, NULL if it was not */
	struct placement_def placement;
	uint64_t count;  /* 0 if not given */
	const char *out; /* NULL for standard output */
};

#define SHAPES "triangle, square, regular:K, star:K, circle, mixed"

static carom_status read_shape(const char *text, void *target, carom_error *error)
{
	struct generate_options *options = target;
	struct placement_def *placement = &options->placement;
	uint64_t sides = 0, points = 0;
	placement->mixed = strcmp(text, "mixed") == 0;
	if (strcmp(text, "triangle") == 0) {
		sides = 3;
	} else if (strcmp(text, "square") == 0) {
		sides = 4;
	} else if (strncmp(text, "regular:", 8) == 0) {
		if (read_count(text + 8, &sides, error) != CAROM_OK || sides < CAROM_MIN_VERTICES || sides > CAROM_MAX_VERTICES)
			return wrong(error, "found \"%s\"; allowed: regular:K with K sides, 3 to 64", text);
	} else if (strncmp(text, "star:", 5) == 0) {
		if (read_count(text + 5, &points, error) != CAROM_OK || points < 3 || points > CAROM_MAX_VERTICES / 2)
			return wrong(error, "found \"%s\"; allowed: star:K with K points, 3 to 32", text);
	} else if (!placement->mixed && strcmp(text, "circle") != 0) {
		return wrong(error, "found \"%s\"; allowed: " SHAPES, text);
	}
	placement->sides = (uint32_t)sides;
	placement->points = (uint32_t)points;
	options->shape = text;
	return CAROM_OK;
}

static carom_status read_body_count(const char *text, void *target, carom_error *error)
{
	uint64_t count = 0;
	if (read_count(text, &count, error) != CAROM_OK || count < 1 || count > MAX_PLACED)
		return wrong(error, "found \"%s\"; allowed: a whole number from 1 to %u", text, MAX_PLACED);
	*(uint64_t *)target = count;
	return CAROM_OK;
}

static carom_status read_speed(const char *text, void *target, carom_error *error)
{
	double speed = 0;
	if (read_number(text, &speed, error) != CAROM_OK || speed < 0)
		return wrong(error, "found \"%s\"; allowed: a number, 0 or more", text);
	*(double *)target = speed;
	return CAROM_OK;
}

static const struct option options_table[] = {
	{"shape", "SHAPE", read_shape, 0,
		"triangle, square, regular:K (K sides, 3 to 64), star:K (K points, 3 to 32; not convex), circle, or mixed: circles and regular polygons of "
		"3 to 6 sides in turn"},
	{"count", "N", read_body_count, offsetof(struct generate_options, count), "bodies, 1 to 4194304"},
	{"fill", "PART", read_positive, offsetof(struct generate_options, placement.fill),
		"area of the bodies / area of the room, above 0; how much fits is told above; default 0.25"},
	{"speed", "V", read_speed, offsetof(struct generate_options, placement.speed),
		"0 to 1e6: each velocity component is uniform in [-V, V] m/s, the angular velocity in [-V, V] rad/s (none for circles); default 2"},
	{"radius", "R", read_positive, offsetof(struct generate_options, placement.radius),
		"m, 1e-8 to 1e6, of circles and of the circles around polygons; default 0.5"},
	{"seed", "S", read_count, offsetof(struct generate_options, placement.seed), "the same seed gives the same scene on every machine; default 1"},
	{"out", "SCENE.json", read_output, offsetof(struct generate_options, out), "write the scene there; - is standard output, the default"},
	{NULL, NULL, NULL, 0, NULL},
};

static carom_status check_options(struct generate_options *options, carom_error *error)
{
	if (!options->shape)
		return wrong(error, "--shape is missing; allowed: " SHAPES);
	if (options->count == 0)
		return wrong(error, "--count is missing; allowed: a whole number from 1 to %u", MAX_PLACED);
	options->placement.count = (uint32_t)options->count;
	return CAROM_OK;
}

static void put_body(FILE *stream, const carom_body_def *body)
{
	if (body->shape == CAROM_CIRCLE) {
		fprintf(stream, "{\"circle\": {\"radius\": %.9g}", (double)body->radius);
	} else if (body->shape == CAROM_POLYGON) {
		fputs("{\"polygon\": {\"vertices\": [", stream);
		for (uint32_t k = 0; k < body->vertex_count; k++)
			fprintf(stream, "%s[%.9g, %.9g]", k > 0 ? ", " : "", (double)body->vertices[k].x, (double)body->vertices[k].y);
		fputs("]}", stream);
	} else {
		fprintf(stream, "{\"regular\": {\"sides\": %u, \"radius\": %.9g}", (unsigned)body->sides, (double)body->radius);
	}
	fprintf(stream, ", \"position\": [%.9g, %.9g], \"velocity\": [%.9g, %.9g]", (double)body->position.x, (double)body->position.y,
		(double)body->velocity.x, (double)body->velocity.y);
	if (body->shape != CAROM_CIRCLE)
		fprintf(stream, ", \"angle\": %.9g, \"angular_velocity\": %.9g", (double)body->angle, (double)body->angular_velocity);
	putc('}', stream);
}

static void put_scene(FILE *stream, const carom_body_def *bodies, uint32_t count, double half)
{
	fprintf(stream, "{\n  \"format\": \"carom-scene/1\",\n  \"restitution\": 1,\n");
	fprintf(stream, "  \"room\": { \"min\": [%.9g, %.9g], \"max\": [%.9g, %.9g] },\n  \"bodies\": [", -half, -half, half, half);
	for (uint32_t k = 0; k < count; k++) {
		fputs(k ? ",\n    " : "\n    ", stream);
		put_body(stream, &bodies[k]);
	}
	fputs("\n  ]\n}\n", stream);
}

static int write_scene(const struct generate_options *options, const carom_body_def *bodies, double half)
{
	carom_error error;
	carom_file *file = NULL;
	FILE *stream = NULL;
	if (!options->out) {
		put_scene(stdout, bodies, options->placement.count, half);
		return finish_output();
	}
	catch_interruptions();
	if (carom_file_create(options->out, &file, &stream, &error) != CAROM_OK)
		return report(&error);
	put_scene(stream, bodies, options->placement.count, half);
	if (fail_interrupted(&error) != CAROM_OK) {
		carom_file_destroy(file);
		return interrupted_code(report(&error));
	}
	return carom_file_commit(file, &error) == CAROM_OK ? EXIT_DONE : report(&error);
}

static int generate_main(int argc, char **argv)
{
	struct generate_options options = {.placement = {.fill = 0.25, .speed = 2, .radius = 0.5, .seed = 1}};
	carom_body_def *bodies = NULL;
	float half = 0;
	carom_error error;
	int code = parse_options(&generate_command, argc, argv, &options.common);
	if (code >= 0)
		return code;
	if (check_options(&options, &error) != CAROM_OK || placement_create(&options.placement, &bodies, &half, &error) != CAROM_OK)
		return report(&error);
	code = write_scene(&options, bodies, (double)half);
	if (code == EXIT_DONE)
		say(&options.common, "%u bodies in a room of %.6g x %.6g m", (unsigned)options.placement.count, 2.0 * (double)half, 2.0 * (double)half);
	free(bodies);
	return code;
}

const struct command generate_command = {
	.name = "generate",
	.arguments = "",
	.summary = "Writes a scene of many moving bodies in a square room",
	.details = "\nThe bodies stand in random order, so that neighbours in the file are none in the room; no two touch,\n"
			   "and none touches a wall. --shape and --count must be given. How full a room can be depends on the\n"
			   "shape: the circles around the bodies must not touch either, which for many bodies allows a fill of\n"
			   "about 0.88 with circles and 0.36 with triangles.\n",
	.options = options_table,
	.main = generate_main,
};
