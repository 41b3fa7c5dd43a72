/* carom query: what is where in a scene.
 * SPDX-License-Identifier: MIT */
#include "carom_tool.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct query_options {
	struct common_options common;
	carom_ray ray;
	carom_vec2 min, max; /* of --box, or of --point, which is both */
	const char *rays;    /* the name of a file */
	carom_vec2 near, to; /* of --nearest, of --move */
	uint32_t body, mask; /* of --move and of --touching */
	bool has_ray, has_box, has_point, has_near, has_move, has_touching;
};

/* ---- Options ---- */

static bool take_ray(const char *text, carom_ray *ray)
{
	float numbers[5] = {0};
	const size_t count = read_floats(text, numbers, 5);
	*ray = (carom_ray){{numbers[0], numbers[1]}, {numbers[2], numbers[3]}, numbers[4]};
	return count >= 4 && ray->radius >= 0;
}

static carom_status read_ray(const char *text, void *target, carom_error *error)
{
	struct query_options *options = target;
	options->has_ray = take_ray(text, &options->ray);
	return options->has_ray ? CAROM_OK : wrong(error, "found \"%s\"; allowed: X,Y,X,Y in metres, from where to where, and ,RADIUS, 0 or more", text);
}

static carom_status read_box(const char *text, void *target, carom_error *error)
{
	struct query_options *options = target;
	float numbers[4];
	if (read_floats(text, numbers, 4) != 4 || !(numbers[2] >= 0) || !(numbers[3] >= 0))
		return wrong(error, "found \"%s\"; allowed: X,Y,W,H in metres, the lower left corner and a size, 0 or more", text);
	options->min = (carom_vec2){numbers[0], numbers[1]};
	options->max = (carom_vec2){numbers[0] + numbers[2], numbers[1] + numbers[3]};
	options->has_box = true;
	return CAROM_OK;
}

static carom_status take_point(const char *text, bool *is_given, carom_vec2 *point, carom_error *error)
{
	float numbers[2];
	if (read_floats(text, numbers, 2) != 2)
		return wrong(error, "found \"%s\"; allowed: X,Y in metres", text);
	*point = (carom_vec2){numbers[0], numbers[1]};
	*is_given = true;
	return CAROM_OK;
}

static carom_status read_point(const char *text, void *target, carom_error *error)
{
	struct query_options *options = target;
	const carom_status status = take_point(text, &options->has_point, &options->min, error);
	options->max = options->min;
	return status;
}

static carom_status read_near(const char *text, void *target, carom_error *error)
{
	struct query_options *options = target;
	return take_point(text, &options->has_near, &options->near, error);
}

static bool is_index(float number)
{
	return number >= 0 && number < (float)UINT32_MAX && number == floorf(number);
}

static carom_status read_move(const char *text, void *target, carom_error *error)
{
	struct query_options *options = target;
	float numbers[3];
	if (read_floats(text, numbers, 3) != 3 || !is_index(numbers[0]))
		return wrong(error, "found \"%s\"; allowed: BODY,X,Y: an index, and where to in metres", text);
	options->body = (uint32_t)numbers[0];
	options->to = (carom_vec2){numbers[1], numbers[2]};
	options->has_move = true;
	return CAROM_OK;
}

static carom_status read_touching(const char *text, void *target, carom_error *error)
{
	struct query_options *options = target;
	float number;
	if (read_floats(text, &number, 1) != 1 || !is_index(number))
		return wrong(error, "found \"%s\"; allowed: a body's index", text);
	options->body = (uint32_t)number;
	options->has_touching = true;
	return CAROM_OK;
}

static carom_status read_mask(const char *text, void *target, carom_error *error)
{
	const bool is_hexadecimal = text[0] == '0' && text[1] == 'x';
	const char *digits = is_hexadecimal ? text + 2 : text;
	const size_t length = strspn(digits, is_hexadecimal ? "0123456789abcdefABCDEF" : "0123456789");
	const unsigned long long mask = length > 0 && length < 12 && !digits[length] ? strtoull(digits, NULL, is_hexadecimal ? 16 : 10) : ULLONG_MAX;
	if (mask > CAROM_MASK)
		return wrong(error, "found \"%s\"; allowed: a whole number from 0 to 4294967295, or 0x and as many bits in hexadecimal digits", text);
	*(uint32_t *)target = (uint32_t)mask;
	return CAROM_OK;
}

static const struct option options_table[] = {
	{"ray", "X,Y,X,Y[,RADIUS]", read_ray, 0, "what a ray from the first point to the second meets first, or a disc of this radius"},
	{"rays", "FILE.csv", read_input, offsetof(struct query_options, rays),
		"the same of many: a row X,Y,X,Y or X,Y,X,Y,RADIUS each; a first row that is no such row names the columns; - is standard input"},
	{"move", "BODY,X,Y", read_move, 0, "what this body of the scene meets first on its way straight to this place, without turning"},
	{"box", "X,Y,W,H", read_box, 0, "which bodies reach into the box with this lower left corner and size"},
	{"point", "X,Y", read_point, 0, "which bodies this point is in"},
	{"touching", "BODY", read_touching, 0, "which other bodies have a point in common with this body of the scene"},
	{"nearest", "X,Y", read_near, 0, "which body is nearest to this point"},
	{"mask", "BITS", read_mask, offsetof(struct query_options, mask), "only bodies of a category in these bits are there, as 6 or 0x6; default all"},
	{NULL, NULL, NULL, 0, NULL},
};

static carom_status check_options(const struct query_options *options, carom_error *error)
{
	const int asked = options->has_ray + (options->rays != NULL) + options->has_move + options->has_box + options->has_point + options->has_touching
		+ options->has_near;
	if (asked != 1)
		return wrong(error, "%s; give one of --ray, --rays, --move, --box, --point, --touching and --nearest",
			asked ? "several things are asked at once" : "nothing is asked");
	if (options->rays && (strcmp(options->rays, options->common.arguments[0]) == 0 || are_one_file(options->rays, options->common.arguments[0])))
		return wrong(error, "the scene and --rays are the same, %s; one of them may be a file", options->rays);
	return CAROM_OK;
}

/* ---- Rays ---- */

struct rays {
	carom_ray *items;
	size_t count, room;
};

static carom_status add_ray(struct rays *rays, carom_ray ray, carom_error *error)
{
	if (rays->count == rays->room) {
		const size_t room = rays->room ? 2 * rays->room : 64;
		carom_ray *items = realloc(rays->items, room * sizeof *items);
		if (!items)
			return out_of_memory(error, "there is not enough memory for %zu rays", room);
		rays->items = items;
		rays->room = room;
	}
	rays->items[rays->count++] = ray;
	return CAROM_OK;
}

static carom_status read_rows(FILE *file, const char *path, struct rays *rays, carom_error *error)
{
	char row[512];
	carom_status status = CAROM_OK;
	for (int line = 1; status == CAROM_OK && fgets(row, sizeof row, file); line++) {
		carom_ray ray;
		const bool is_whole = strchr(row, '\n') || feof(file);
		row[strcspn(row, "\r\n")] = '\0';
		if (is_whole && take_ray(row, &ray))
			status = add_ray(rays, ray, error);
		else if (row[0] && (line > 1 || !is_whole || strchr("+-.0123456789", row[0])))
			status = wrong(error, "%s:%d: found \"%.60s\"; allowed: X,Y,X,Y in metres, from where to where, and ,RADIUS, 0 or more", path, line, row);
	}
	if (status == CAROM_OK && ferror(file))
		status = wrong(error, "%s: %s", path, strerror(errno));
	return status;
}

static carom_status read_rays(const struct query_options *options, struct rays *rays, carom_error *error)
{
	if (!options->rays)
		return add_ray(rays, options->ray, error);
	FILE *file = fopen(options->rays, "r");
	if (!file)
		return wrong(error, "%s: %s", options->rays, strerror(errno));
	const carom_status status = read_rows(file, options->rays, rays, error);
	fclose(file);
	return status;
}

/* ---- Tables ---- */

/* In quotes where it has what would end it. */
static void print_name(const char *name)
{
	const bool is_quoted = name && strpbrk(name, ",\"\r\n");
	putchar(',');
	if (is_quoted)
		putchar('"');
	for (; name && *name; name++) {
		if (*name == '"')
			putchar('"');
		putchar(*name);
	}
	puts(is_quoted ? "\"" : "");
}

static void print_name_of(const carom_world *world, uint32_t index)
{
	carom_body_info body = {.name = NULL};
	carom_world_get_body(world, index, &body, NULL);
	print_name(body.name);
}

static void print_hit(const carom_world *world, const carom_ray_hit *hit)
{
	if (hit->other == CAROM_NOTHING)
		printf("nothing");
	else
		print_other(stdout, hit->other);
	printf(",%.17g,%.9g,%.9g,%.9g,%.9g", hit->part, (double)hit->point.x, (double)hit->point.y, (double)hit->normal.x, (double)hit->normal.y);
	if (hit->other >= 0)
		print_name_of(world, (uint32_t)hit->other);
	else
		print_name(NULL);
}

static carom_status print_rays(const carom_world *world, const carom_snapshot *snapshot, const struct rays *rays, carom_error *error)
{
	puts("ray,met,part,x_m,y_m,normal_x,normal_y,name");
	for (size_t k = 0; k < rays->count; k++) {
		carom_ray_hit hit;
		const carom_status status = carom_snapshot_cast_rays(snapshot, 1, &rays->items[k], &hit, error);
		if (status != CAROM_OK)
			return status;
		printf("%zu,", k + 1);
		print_hit(world, &hit);
	}
	return CAROM_OK;
}

static carom_status print_move(const carom_world *world, const carom_snapshot *snapshot, const struct query_options *options,
	const carom_body_def *body, carom_error *error)
{
	carom_ray_hit hit;
	const carom_status status = carom_snapshot_cast_bodies(snapshot, 1, body, &options->to, &hit, error);
	if (status != CAROM_OK)
		return status;
	printf("body,met,part,x_m,y_m,normal_x,normal_y,name\n%u,", (unsigned)options->body);
	print_hit(world, &hit);
	return CAROM_OK;
}

/* `body` is NULL for a box or a point. */
static carom_status print_found(const carom_world *world, const carom_snapshot *snapshot, const struct query_options *options,
	const carom_body_def *body, carom_error *error)
{
	const size_t room = carom_world_body_count(world);
	uint32_t *indices = malloc(room * sizeof *indices + 1);
	size_t count = 0;
	carom_status status;
	if (!indices)
		return out_of_memory(error, "there is not enough memory for %zu bodies", room);
	if (body)
		status = carom_snapshot_find_touching(snapshot, body, indices, room, &count, error);
	else
		status = carom_snapshot_find(snapshot, options->min, options->max, indices, room, &count, error);
	if (status == CAROM_OK)
		puts("body,name");
	for (size_t k = 0; k < count; k++) {
		if (body && indices[k] == options->body)
			continue;
		printf("%u", (unsigned)indices[k]);
		print_name_of(world, indices[k]);
	}
	free(indices);
	return status;
}

static carom_status print_nearest(const carom_world *world, const carom_snapshot *snapshot, carom_vec2 point, carom_error *error)
{
	carom_nearest found;
	const carom_status status = carom_snapshot_find_nearest(snapshot, 1, &point, INFINITY, &found, error);
	if (status != CAROM_OK)
		return status;
	puts("body,distance_m,x_m,y_m,normal_x,normal_y,name");
	if (found.body == CAROM_NOTHING) /* there is no body */
		return CAROM_OK;
	printf("%d,%.17g,%.9g,%.9g,%.9g,%.9g", (int)found.body, found.distance, (double)found.point.x, (double)found.point.y, (double)found.normal.x,
		(double)found.normal.y);
	print_name_of(world, (uint32_t)found.body);
	return CAROM_OK;
}

static carom_status print_answer(const carom_world *world, const carom_snapshot *snapshot, const struct query_options *options,
	const carom_scene *scene, const struct rays *rays, carom_error *error)
{
	if (options->has_ray || options->rays)
		return print_rays(world, snapshot, rays, error);
	if (options->has_near)
		return print_nearest(world, snapshot, options->near, error);
	if (!options->has_move && !options->has_touching)
		return print_found(world, snapshot, options, NULL, error);
	if (options->body >= scene->body_count)
		return wrong(error, "--%s: there is no body %u; the scene has %zu", options->has_move ? "move" : "touching", (unsigned)options->body,
			scene->body_count);
	const carom_body_def *body = &scene->bodies[options->body];
	return (options->has_move ? print_move : print_found)(world, snapshot, options, body, error);
}

/* ---- The command ---- */

static carom_status answer(const struct query_options *options, const carom_scene *scene, const struct rays *rays, carom_error *error)
{
	carom_world *world = NULL;
	carom_snapshot *snapshot = NULL;
	carom_status status = carom_scene_create_world(scene, &world, error);
	if (status == CAROM_OK)
		status = carom_snapshot_create_masked(world, options->mask, &snapshot, error);
	if (status == CAROM_OK)
		status = print_answer(world, snapshot, options, scene, rays, error);
	carom_snapshot_destroy(snapshot);
	carom_world_destroy(world);
	return status;
}

static int query_main(int argc, char **argv)
{
	struct query_options options = {.mask = CAROM_MASK};
	struct rays rays = {NULL, 0, 0};
	carom_scene *scene = NULL;
	carom_error error;
	int code = parse_options(&query_command, argc, argv, &options.common);
	if (code >= 0)
		return code;
	const char *path = options.common.arguments[0] = input_name(options.common.arguments[0]);
	carom_status status = check_options(&options, &error);
	if (status == CAROM_OK && (options.has_ray || options.rays))
		status = read_rays(&options, &rays, &error);
	if (status == CAROM_OK && carom_scene_read(path, &scene, &error) != CAROM_OK) {
		free(rays.items);
		return report_input(&error);
	}
	if (status == CAROM_OK) {
		scene->world.device = "cpu"; /* nothing moves */
		status = answer(&options, scene, &rays, &error);
	}
	code = status == CAROM_OK ? finish_output() : report(&error);
	carom_scene_destroy(scene);
	free(rays.items);
	return code;
}

const struct command query_command = {
	.name = "query",
	.arguments = "SCENE.json",
	.least_arguments = 1,
	.most_arguments = 1,
	.summary = "Prints what rays or bodies meet in a scene, or which bodies are at or near a place",
	.details = "\nSCENE.json is a file of the format carom-scene/1, as `carom run --out` writes one; - reads standard\n"
			   "input. One thing is asked at a time; the answer is a table:\n"
			   "\n--ray, --rays: ray (from 1), met (a body's index, a wall of the room: left, bottom, right, top, or\n"
			   "nothing), part (0 to 1, of the way), x_m, y_m (where they touch), normal_x, normal_y (from what is met),\n"
			   "name (of the body). What a ray touches where it begins it does not meet.\n"
			   "--move: body (its index), then the same columns. It meets what it may hit by its filter.\n"
			   "--box, --point, --touching: body (its index), name.\n"
			   "--nearest: body (of equally near ones the lowest index), distance_m (0 in it), x_m, y_m (its nearest\n"
			   "point), normal_x, normal_y (from there to the point asked for), name.\n",
	.options = options_table,
	.main = query_main,
};
