/* carom run: simulates a scene.
 * SPDX-License-Identifier: MIT */
#include "carom_run.h"

#include <string.h>

#define MAX_PICTURE_SIDE 16384u
#define DEFAULT_TIME 1.0
#define DEFAULT_FPS 30.0
#define MOST_FPS 1000000

/* ---- Options ---- */

static carom_status read_size(const char *text, void *target, carom_error *error)
{
	uint32_t *size = target;
	unsigned width = 0, height = 0;
	int length = 0;
	bool digits = strspn(text, "0123456789x") == strlen(text) && strlen(text) <= 11; /* no sign, no space, no overflow */
	if (!digits || sscanf(text, "%ux%u%n", &width, &height, &length) != 2 || text[length] || width < 1 || height < 1 || width > MAX_PICTURE_SIDE
		|| height > MAX_PICTURE_SIDE)
		return wrong(error, "found \"%s\"; allowed: WxH in pixels, each 1 to %u", text, MAX_PICTURE_SIDE);
	size[0] = width;
	size[1] = height;
	return CAROM_OK;
}

static carom_status read_inset(const char *text, void *target, carom_error *error)
{
	struct run_options *options = target;
	float numbers[4];
	if (read_floats(text, numbers, 4) != 4 || !(numbers[2] > 0) || !(numbers[3] > 0))
		return wrong(error, "found \"%s\"; allowed: X,Y,W,H in metres, the lower left corner and a size above 0", text);
	options->inset = (carom_inset){{numbers[0], numbers[1]}, {numbers[2], numbers[3]}};
	options->has_inset = true;
	return CAROM_OK;
}

static carom_status read_fps(const char *text, void *target, carom_error *error)
{
	double fps = 0;
	if (read_positive(text, &fps, error) != CAROM_OK || fps > MOST_FPS)
		return wrong(error, "found \"%s\"; allowed: a number above 0, at most %d", text, MOST_FPS);
	*(double *)target = fps;
	return CAROM_OK;
}

static carom_status read_steps(const char *text, void *target, carom_error *error)
{
	uint64_t steps = 0;
	if (read_count(text, &steps, error) != CAROM_OK || steps == NO_STEPS)
		return wrong(error, "found \"%s\"; allowed: a whole number from 0 to %llu", text, (unsigned long long)NO_STEPS - 1);
	*(uint64_t *)target = steps;
	return CAROM_OK;
}

static carom_status read_time(const char *text, void *target, carom_error *error)
{
	double seconds = 0;
	if (read_number(text, &seconds, error) != CAROM_OK || seconds < 0)
		return wrong(error, "found \"%s\"; allowed: seconds, 0 or more", text);
	*(double *)target = seconds;
	return CAROM_OK;
}

static const struct option options_table[] = {
	{"steps", "N", read_steps, offsetof(struct run_options, steps), "run N steps"},
	{"time", "SECONDS", read_time, offsetof(struct run_options, time),
		"run so many seconds of simulated time; 1 if neither --steps nor --time is given"},
	{"out", "STATE.json", read_output, offsetof(struct run_options, out), "write the last state as a scene that goes on with the same bits"},
	{"png", "FRAME.png", read_output, offsetof(struct run_options, png), "write a picture of the last state"},
	{"frames", "DIR", read_path, offsetof(struct run_options, frames),
		"write pictures at equal simulated times, DIR/frame_000000.png the first; DIR is made if missing; where the scene has neither camera nor "
		"room, all show what the first does"},
	{"states", "FILE.csv", read_output, offsetof(struct run_options, states),
		"write where all bodies are, and how fast, at the times of frames: a table with a row a body, or as FILE.npy an array of NumPy"},
	{"fps", "F", read_fps, offsetof(struct run_options, fps), "frames, or states, for a simulated second, at most 1000000; default 30"},
	{"stats", "FILE.csv", read_output, offsetof(struct run_options, stats),
		"write a table with a row a step: time, hits, energy, momenta, deepest penetration"},
	{"hits", "FILE.csv", read_output, offsetof(struct run_options, hits),
		"write a table with a row a hit: when, of what with what, where, the normal and the impulse"},
	{"hash", NULL, NULL, offsetof(struct run_options, hash), "print a 64-bit hash of the last state, 16 hexadecimal digits"},
	{"size", "WxH", read_size, offsetof(struct run_options, size), "pixels of the pictures; default 1280x720"},
	{"inset", "X,Y,W,H", read_inset, 0,
		"draw the part of the scene with this lower left corner and size, in metres, again, enlarged, in a corner of the "
		"pictures"},
	{NULL, NULL, NULL, 0, NULL},
};

static bool is_frame(const char *path, const char *frames)
{
	char frame[4096];
	const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
	if (strncmp(name, "frame_", 6) != 0 || strcmp(name + 6 + strspn(name + 6, "0123456789"), ".png") != 0)
		return false;
	return snprintf(frame, sizeof frame, "%s/%s", frames, name) < (int)sizeof frame && are_one_file(path, frame);
}

/* What a run may write, by the options that ask for it; tables are side by side. */
enum { OUT, PNG, STATS, HITS, STATES, FRAMES, OUTPUTS };

static const char *const output_names[OUTPUTS] = {"--out", "--png", "--stats", "--hits", "--states", "--frames"};

struct outputs {
	const char *paths[OUTPUTS];
};

static struct outputs outputs_of(const struct run_options *options)
{
	return (struct outputs){{options->out, options->png, options->stats, options->hits, options->states, options->frames}};
}

/* Does an output go there, too? */
static bool is_output(const struct outputs *outputs, int k, const char *path)
{
	const char *const own = outputs->paths[k];
	return own && (k == FRAMES ? is_frame(path, own) : are_one_file(own, path));
}

/* Two outputs in one file: the first would be lost. */
static carom_status check_paths(const struct run_options *options, carom_error *error)
{
	const struct outputs outputs = outputs_of(options);
	const char *const *paths = outputs.paths;
	for (int k = 0; k < OUTPUTS; k++) {
		bool taken = paths[k] && is_output(&outputs, FRAMES, paths[k]);
		for (int i = 0; paths[k] && i < k; i++)
			taken = taken || is_output(&outputs, i, paths[k]);
		if (taken)
			return wrong(error, "%s: two of --out, --png, --stats, --hits, --states and --frames write there; give each a name of its own", paths[k]);
	}
	for (int k = STATS; k <= STATES; k++)
		for (int i = STATS; paths[k] && i < k; i++)
			if (paths[i] && are_one_stream(paths[i], paths[k]))
				return wrong(error, "%s and %s: both tables go to %s, row by row, where their rows would mix; write one to a file", output_names[i],
					output_names[k], paths[i]);
	return CAROM_OK;
}

/* A state may take the place of the scene that it came from; what is no scene may not. */
static carom_status check_scene_stays(const struct run_options *options, carom_error *error)
{
	const struct outputs outputs = outputs_of(options);
	const char *scene = options->common.arguments[0];
	for (int k = OUT + 1; k < OUTPUTS; k++)
		if (is_output(&outputs, k, scene))
			return wrong(error, "%s: %s would replace the scene; only --out may, which writes one", scene, output_names[k]);
	return CAROM_OK;
}

static carom_status check_options(struct run_options *options, carom_error *error)
{
	if (options->steps != NO_STEPS && options->time >= 0)
		return wrong(error, "--steps and --time exclude each other; give one of them");
	if (options->fps > 0 && !options->frames && !options->states)
		return wrong(error, "--fps needs --frames or --states");
	if ((options->size[0] || options->has_inset) && !options->png && !options->frames)
		return wrong(error, "%s needs a picture: --png or --frames", options->size[0] ? "--size" : "--inset");
	if (options->steps == NO_STEPS && options->time < 0)
		options->time = DEFAULT_TIME;
	if (options->fps <= 0)
		options->fps = DEFAULT_FPS;
	const carom_status status = check_paths(options, error);
	return status == CAROM_OK ? check_scene_stays(options, error) : status;
}

/* ---- What is said ---- */

static bool is_convex(const carom_body_def *body)
{
	bool turns_left = false, turns_right = false;
	for (uint32_t k = 0; k < body->vertex_count; k++) {
		const carom_vec2 a = body->vertices[k], b = body->vertices[(k + 1) % body->vertex_count], c = body->vertices[(k + 2) % body->vertex_count];
		const double turn = ((double)b.x - (double)a.x) * ((double)c.y - (double)b.y) - ((double)b.y - (double)a.y) * ((double)c.x - (double)b.x);
		turns_left = turns_left || turn > 0;
		turns_right = turns_right || turn < 0;
	}
	return !(turns_left && turns_right);
}

/* As carom_world_memory counts them, at most. */
static size_t vertices_of(const carom_body_def *body)
{
	if (body->shape == CAROM_CIRCLE)
		return 1;
	if (body->shape == CAROM_REGULAR)
		return body->sides;
	return is_convex(body) ? body->vertex_count : 7 * (size_t)body->vertex_count;
}

static void say_scene(const struct common_options *options, const carom_scene *scene)
{
	char memory[32];
	size_t vertices = 0;
	for (size_t k = 0; k < scene->body_count; k++)
		vertices += vertices_of(&scene->bodies[k]);
	format_bytes(carom_world_memory(&scene->world, scene->body_count, vertices), memory, sizeof memory);
	say(options, "%s: %zu bodies, which take %s on the device", options->arguments[0], scene->body_count, memory);
}

static void say_device(const struct common_options *options, const carom_world *world)
{
	carom_device_info device;
	if (carom_world_get_device(world, &device, NULL) != CAROM_OK)
		return;
	say(options, "runs on %s%s%s%s%s", device.platform, *device.platform ? ": " : "", device.name,
		!device.is_opencl        ? ""
			: device.uses_images ? ", with images"
								 : ", with buffers",
		device.exact ? "" : ", which is not exact: other devices' results differ in the last bits");
}

/* Positions are centres of mass; a polygon given about another point is drawn elsewhere than its vertices say. */
static void say_recentred(const struct common_options *options, const carom_world *world)
{
	size_t count = 0, first = 0;
	carom_vec2 by = {0, 0};
	for (size_t k = 0; k < carom_world_body_count(world); k++) {
		carom_body_info body;
		if (carom_world_get_body(world, (uint32_t)k, &body, NULL) != CAROM_OK)
			return;
		if (body.recentred_by.x == 0 && body.recentred_by.y == 0)
			continue;
		if (count++ == 0) {
			first = k;
			by = body.recentred_by;
		}
	}
	if (count > 0)
		say(options, "vertices recentred on the centre of mass in %zu %s, first bodies[%zu], where it was (%.9g, %.9g)", count,
			count == 1 ? "body" : "bodies", first, (double)by.x, (double)by.y);
}

/* What bodies have, and the step does nothing with. */
static void say_unused(const struct common_options *options, const carom_world *world)
{
	const char *step = carom_pipeline_get(&carom_world_get_def(world)->pipeline, "step");
	bool rolls = false, damps = false;
	if (strcmp(step, "contacts") == 0) /* it does all */
		return;
	for (size_t k = 0; k < carom_world_body_count(world); k++) {
		carom_body_info body;
		if (carom_world_get_body(world, (uint32_t)k, &body, NULL) != CAROM_OK)
			return;
		rolls = rolls || body.rolling_friction > 0;
		damps = damps || body.linear_damping > 0 || body.angular_damping > 0;
	}
	if (rolls)
		say(options, "rolling_friction does nothing by the step %s; --set step=contacts has it", step);
	if (damps && strcmp(step, "first_impact") == 0)
		say(options, "linear_damping and angular_damping do nothing by the step %s; events and contacts have them", step);
}

static void say_done(const struct run *run)
{
	const carom_report *total = &run->total;
	say(&run->options->common, "%llu steps, %llu hits, %.6g s simulated in %.3g s (%.4g steps/s)", (unsigned long long)total->steps,
		(unsigned long long)total->hits, total->advanced, run->seconds, run->seconds > 0 ? (double)total->steps / run->seconds : 0.0);
	if (total->held > 0)
		say(&run->options->common, "%llu times a body was hit too often in a step, and held where it was until the end of it; --stats says when",
			(unsigned long long)total->held);
}

/* ---- The run ---- */

static int print_hash(struct run *run)
{
	carom_error error;
	uint64_t hash;
	if (carom_world_hash(run->world, &hash, &error) != CAROM_OK)
		return report(&error);
	printf("%016llx\n", (unsigned long long)hash);
	return finish_output();
}

/* Whatever comes in between, the state reached is written: it may have taken hours. */
static int run_world(struct run *run)
{
	carom_error error;
	carom_status status = simulate(run, &error);
	unsigned long long steps = run->total.steps;
	int code = EXIT_DONE;
	if (status != CAROM_OK && steps == 0)
		return report(&error);
	say_done(run);
	if (status != CAROM_OK)
		code = report(&error);
	if (run->interrupted) {
		fprintf(stderr, "carom: interrupted after %llu steps; what is written and printed is of the state then\n", steps);
	} else if (code != EXIT_DONE && (run->options->out || run->options->png)) {
		fprintf(stderr, "carom: what is written shows the last good state, after %llu steps\n", steps);
	}
	int written = write_outputs(run);
	if (code == EXIT_DONE)
		code = written;
	if (code == EXIT_DONE && run->options->hash)
		code = print_hash(run);
	return code == EXIT_DONE && run->interrupted ? interrupted_code(code) : code;
}

/* Destroys the scene, and that before the run: the world has what it needs, and of a million bodies two copies are enough. */
static int run_scene(const struct run_options *options, carom_scene *scene)
{
	struct run run = {.options = options, .has_camera = scene->has_camera, .camera = scene->camera};
	const struct common_options *common = &options->common;
	carom_error error;
	int code;
	carom_status status = apply_options(common, &scene->world, &error);
	scene->world.keep_hits = options->hits != NULL;
	if (status == CAROM_OK)
		status = prepare_outputs(&run, &error);
	if (status == CAROM_OK) {
		say_scene(common, scene);
		status = carom_scene_create_world(scene, &run.world, &error);
	}
	carom_scene_destroy(scene);
	if (status == CAROM_OK) {
		say_device(common, run.world);
		say_recentred(common, run.world);
		say_unused(common, run.world);
		status = prepare_camera(&run, &error);
	}
	code = status == CAROM_OK ? run_world(&run) : report(&error);
	destroy_outputs(&run);
	carom_world_destroy(run.world);
	return code;
}

static int run_main(int argc, char **argv)
{
	struct run_options options = {.steps = NO_STEPS, .time = -1};
	carom_scene *scene = NULL;
	carom_error error;
	int code = parse_options(&run_command, argc, argv, &options.common);
	if (code >= 0)
		return code;
	const char *path = options.common.arguments[0] = input_name(options.common.arguments[0]);
	if (check_options(&options, &error) != CAROM_OK)
		return report(&error);
	if (carom_scene_read(path, &scene, &error) != CAROM_OK)
		return report_input(&error);
	return run_scene(&options, scene);
}

const struct command run_command = {
	.name = "run",
	.arguments = "SCENE.json",
	.least_arguments = 1,
	.most_arguments = 1,
	.summary = "Simulates a scene and writes states, pictures and tables",
	.details = "\nSCENE.json is a file of the format carom-scene/1; - reads standard input.\n"
			   "As --out, --png, --stats, --hits or --states, - is standard output.\n"
			   "What several write there follows each other: the table (one of the three), the picture, the state, and the hash as the last line.\n"
			   "--out may write over SCENE.json: the state takes its place. No other output may, and each has a file of its own.\n"
			   "\nA step of `events` or `contacts` lasts the scene's time step; one of `first_impact` ends at the first\n"
			   "hit, so --steps counts those, and --time counts simulated seconds. With --time, the step before the end\n"
			   "or before a frame is cut short to end there.\n"
			   "With --steps no step is cut short, and a frame shows the end of the step that its time falls into.\n"
			   "\nOutputs are written when the run ends, also when a step fails: they then show the last good state, and\n"
			   "the exit code is 1. An interruption (SIGINT, SIGTERM) ends the run after the steps at hand: all that was\n"
			   "asked for is written and printed, of the state then, how many steps it had is said, and the exit code is\n"
			   "130 (143); a second one ends the process at once. A file is whole or as it was before.\n",
	.options = options_table,
	.makes_worlds = true,
	.main = run_main,
};
