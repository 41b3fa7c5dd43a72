/* What `carom run` writes: the last state, pictures, frames, tables.
 * SPDX-License-Identifier: MIT */
#include "carom_run.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- Before the run ---- */

carom_status allocate_pixels(const carom_render_def *render, uint8_t **pixels, carom_error *error)
{
	*pixels = malloc((size_t)render->width * render->height * 4);
	if (*pixels)
		return CAROM_OK;
	return out_of_memory(error, "there is not enough memory for a picture of %u x %u pixels", render->width, render->height);
}

static carom_status make_folder(const char *path, carom_error *error)
{
	struct stat there;
	if (mkdir(path, 0777) == 0 || (errno == EEXIST && stat(path, &there) == 0 && S_ISDIR(there.st_mode)))
		return CAROM_OK;
	wrong(error, "--frames: %s: can't be made a folder: %s", path, strerror(errno));
	error->status = CAROM_IO;
	return CAROM_IO;
}

static carom_status prepare_frames(struct run *run, carom_error *error)
{
	char path[4096];
	carom_status status = make_folder(run->options->frames, error);
	if (status == CAROM_OK)
		status = film_create(run->options->frames, &run->render, &run->film, error);
	if (status == CAROM_OK)
		status = film_path(run->film, 0, path, sizeof path, error);
	return status == CAROM_OK ? try_path(path, error) : status;
}

static void prepare_render(struct run *run)
{
	const struct run_options *options = run->options;
	run->render = carom_default_render_def();
	if (options->size[0])
		run->render.width = options->size[0], run->render.height = options->size[1];
	run->render.has_camera = run->has_camera;
	run->render.camera = run->camera;
	run->render.has_inset = options->has_inset;
	run->render.inset = options->inset;
}

carom_status prepare_outputs(struct run *run, carom_error *error)
{
	const struct run_options *options = run->options;
	carom_status status = options->out ? try_path(options->out, error) : CAROM_OK;
	if (status == CAROM_OK && options->png)
		status = try_path(options->png, error);
	prepare_render(run);
	if (status == CAROM_OK && options->frames)
		status = prepare_frames(run, error);
	if (status == CAROM_OK && options->png)
		status = allocate_pixels(&run->render, &run->pixels, error);
	if (status == CAROM_OK && options->stats)
		status = carom_file_create(options->stats, &run->stats_file, &run->stats, error);
	if (run->stats)
		fputs("step,time_s,advanced_s,hits,kinetic_energy_j,potential_energy_j,momentum_x,momentum_y,angular_momentum,max_penetration_m,held,ruled\n",
			run->stats);
	if (status == CAROM_OK && options->hits)
		status = carom_file_create(options->hits, &run->hits_file, &run->hits, error);
	if (run->hits)
		fputs("time_s,body,other,x_m,y_m,normal_x,normal_y,impulse_x_ns,impulse_y_ns,ruled\n", run->hits);
	if (status == CAROM_OK && options->states)
		status = states_create(options->states, &run->states, error);
	return status;
}

static bool is_seen(const carom_inset *part, const carom_camera *camera, const carom_render_def *render)
{
	const double high = (double)camera->height / 2, wide = high * render->width / render->height;
	const double x = (double)camera->center.x, y = (double)camera->center.y, left = (double)part->min.x, bottom = (double)part->min.y;
	return left < x + wide && left + (double)part->size.x > x - wide && bottom < y + high && bottom + (double)part->size.y > y - high;
}

carom_status prepare_camera(struct run *run, carom_error *error)
{
	const struct run_options *options = run->options;
	/* Frames that each looked for the bodies would follow them: what all do together would not be seen. */
	const bool is_to_stay = options->frames && !run->has_camera && !carom_world_get_def(run->world)->has_room;
	carom_camera camera;
	if (!is_to_stay && !options->has_inset)
		return CAROM_OK;
	carom_status status = carom_world_fit_camera(run->world, &run->render, &camera, error);
	if (status != CAROM_OK)
		return status;
	if (options->has_inset && !is_seen(&options->inset, &camera, &run->render))
		say(&options->common, "--inset: this part lies outside of the picture, which at the start shows %.6g m of height about (%.6g, %.6g)",
			(double)camera.height, (double)camera.center.x, (double)camera.center.y);
	if (is_to_stay) {
		run->render.has_camera = true;
		run->render.camera = camera;
		say(&options->common, "no camera and no room: the frames show where the bodies are at the start; a \"camera\" in the scene shows more");
	}
	return CAROM_OK;
}

/* ---- During the run ---- */

static carom_status write_picture(struct run *run, const char *path, carom_error *error)
{
	carom_status status = carom_world_render(run->world, &run->render, run->pixels, error);
	return status == CAROM_OK ? carom_png_write(path, run->pixels, run->render.width, run->render.height, error) : status;
}

double next_frame(const struct run *run)
{
	return run->film || run->states ? (double)run->frames_done / run->options->fps : INFINITY;
}

carom_status write_frame(struct run *run, carom_error *error)
{
	carom_status status = run->film ? film_add(run->film, run->world, error) : CAROM_OK;
	if (status == CAROM_OK && run->states) {
		status = states_add(run->states, run->world, error);
		if (status == CAROM_IO) { /* nothing can be added to it, in the end either */
			states_destroy(run->states);
			run->states = NULL;
		}
	}
	if (status == CAROM_OK)
		run->frames_done++;
	return status;
}

carom_status write_row(struct run *run, const carom_report *step, carom_error *error)
{
	carom_measure measure;
	carom_status status = carom_world_measure(run->world, &measure, error);
	if (status != CAROM_OK)
		return status;
	fprintf(run->stats, "%llu,%.12g,%.12g,%llu,%.12g,%.12g,%.12g,%.12g,%.12g,%.12g,%llu,%llu\n", (unsigned long long)run->total.steps,
		carom_world_time(run->world), step->advanced, (unsigned long long)step->hits, measure.kinetic_energy, measure.potential_energy,
		measure.momentum_x, measure.momentum_y, measure.angular_momentum, measure.max_penetration, (unsigned long long)step->held,
		(unsigned long long)step->ruled);
	return CAROM_OK;
}

static void write_hit(FILE *file, const carom_hit *hit)
{
	fprintf(file, "%.17g,%u,", hit->time, hit->body);
	print_other(file, hit->other);
	fprintf(file, ",%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%d\n", (double)hit->point.x, (double)hit->point.y, (double)hit->normal.x, (double)hit->normal.y,
		(double)hit->impulse.x, (double)hit->impulse.y, hit->is_ruled);
}

carom_status write_hits(struct run *run, carom_error *error)
{
	carom_hit hits[256];
	const size_t count = carom_world_hit_count(run->world), most = sizeof hits / sizeof *hits;
	for (size_t k = 0; k < count; k++) {
		if (k % most == 0) {
			const carom_status status = carom_world_get_hits(run->world, k, count - k < most ? count - k : most, hits, error);
			if (status != CAROM_OK)
				return status;
		}
		write_hit(run->hits, &hits[k % most]);
	}
	return CAROM_OK;
}

/* ---- After the run ---- */

static int tell(const struct run *run, carom_status status, const char *path, const carom_error *error)
{
	if (status != CAROM_OK)
		return report(error);
	say(&run->options->common, "wrote %s", path);
	return EXIT_DONE;
}

static int worse(int a, int b)
{
	return a == EXIT_DONE ? b : a;
}

/* A film would go on with what an earlier, longer run has left there. */
static void tell_frames(const struct run *run)
{
	const struct run_options *options = run->options;
	char next[4096];
	carom_error error;
	say(&options->common, "wrote %llu frames into %s", (unsigned long long)run->frames_done, options->frames);
	if (film_path(run->film, run->frames_done, next, sizeof next, &error) == CAROM_OK && access(next, F_OK) == 0)
		say(&options->common, "%s and what follows it were there before: remove them, or they become part of the film", next);
}

int write_outputs(struct run *run)
{
	const struct run_options *options = run->options;
	carom_error error;
	int code = EXIT_DONE;
	if (run->stats_file) {
		code = tell(run, carom_file_commit(run->stats_file, &error), options->stats, &error);
		run->stats_file = NULL;
	}
	if (run->hits_file) {
		code = worse(code, tell(run, carom_file_commit(run->hits_file, &error), options->hits, &error));
		run->hits_file = NULL;
	}
	if (run->states) {
		code = worse(code, tell(run, states_commit(run->states, &error), options->states, &error));
		run->states = NULL;
	}
	if (run->film && run->frames_done > 0)
		tell_frames(run);
	if (options->png)
		code = worse(code, tell(run, write_picture(run, options->png, &error), options->png, &error));
	if (options->out) {
		const carom_camera *camera = run->has_camera ? &run->camera : NULL;
		code = worse(code, tell(run, carom_world_write_scene(run->world, camera, options->out, &error), options->out, &error));
	}
	return code;
}

void destroy_outputs(struct run *run)
{
	carom_file_destroy(run->stats_file);
	carom_file_destroy(run->hits_file);
	states_destroy(run->states);
	film_destroy(run->film);
	free(run->pixels);
}
