/* Writes the frames of `carom run`. To compress a picture takes longer than to simulate and draw it, so other threads do that
 * while the simulation goes on.
 * SPDX-License-Identifier: MIT */
#include "carom_run.h"

#include <pthread.h>
#include <stdlib.h>
#include <unistd.h>

#define MOST_WRITERS 16
#define MOST_MEMORY ((size_t)256 << 20) /* bytes of pictures; where two take more, there is one, and no other thread */
#define NO_FRAME UINT64_MAX

enum stage { FREE, DRAWN, TAKEN };

struct picture {
	uint8_t *pixels;
	uint64_t number; /* of the frame */
	enum stage stage;
};

struct film {
	const char *folder;
	const carom_render_def *render;
	pthread_t writers[MOST_WRITERS];
	struct picture pictures[MOST_WRITERS + 1];
	int writer_count, picture_count;
	uint64_t handed_over; /* frames */

	pthread_mutex_t mutex; /* of what follows, and of stages and numbers */
	pthread_cond_t changed;
	bool ends;
	uint64_t failed; /* the first frame that could not be written; NO_FRAME for none */
	carom_error error;
};

carom_status film_path(const struct film *film, uint64_t number, char *path, size_t size, carom_error *error)
{
	int length = snprintf(path, size, "%s/frame_%06llu.png", film->folder, (unsigned long long)number);
	return length < (int)size ? CAROM_OK : wrong(error, "--frames: the path is too long");
}

/* ---- Writers ---- */

static void write_picture(struct film *film, const struct picture *picture)
{
	char path[4096];
	carom_error error;
	carom_status status = film_path(film, picture->number, path, sizeof path, &error);
	if (status == CAROM_OK)
		status = carom_png_write(path, picture->pixels, film->render->width, film->render->height, &error);
	pthread_mutex_lock(&film->mutex);
	if (status != CAROM_OK && picture->number < film->failed) {
		film->failed = picture->number;
		film->error = error;
	}
	pthread_mutex_unlock(&film->mutex);
}

/* The earliest that is drawn and that nobody has taken, or NULL. What comes after one that failed is not written. */
static struct picture *next_drawn(struct film *film)
{
	struct picture *next = NULL;
	for (int k = 0; k < film->picture_count; k++) {
		struct picture *picture = &film->pictures[k];
		if (picture->stage == DRAWN && picture->number > film->failed)
			picture->stage = FREE;
		if (picture->stage == DRAWN && (!next || picture->number < next->number))
			next = picture;
	}
	return next;
}

static void *writer(void *context)
{
	struct film *film = context;
	pthread_mutex_lock(&film->mutex);
	for (;;) {
		struct picture *picture = next_drawn(film);
		if (!picture && film->ends)
			break;
		if (!picture) {
			pthread_cond_wait(&film->changed, &film->mutex);
			continue;
		}
		picture->stage = TAKEN;
		pthread_mutex_unlock(&film->mutex);
		write_picture(film, picture);
		pthread_mutex_lock(&film->mutex);
		picture->stage = FREE;
		pthread_cond_broadcast(&film->changed);
	}
	pthread_mutex_unlock(&film->mutex);
	return NULL;
}

/* ---- The film ---- */

static void begin_writers(struct film *film)
{
	const size_t size = (size_t)film->render->width * film->render->height * 4;
	const long cores = sysconf(_SC_NPROCESSORS_ONLN), room = (long)(MOST_MEMORY / size) - 1;
	const long most = cores < room ? cores : room;
	pthread_mutex_lock(&film->mutex);
	while (film->writer_count < most && film->writer_count < MOST_WRITERS) {
		film->pictures[film->picture_count].pixels = malloc(size);
		if (!film->pictures[film->picture_count].pixels)
			break;
		film->picture_count++;
		if (pthread_create(&film->writers[film->writer_count], NULL, writer, film))
			break;
		film->writer_count++;
	}
	pthread_mutex_unlock(&film->mutex);
}

carom_status film_create(const char *folder, const carom_render_def *render, struct film **film, carom_error *error)
{
	uint8_t *pixels;
	carom_status status = allocate_pixels(render, &pixels, error);
	if (status != CAROM_OK)
		return status;
	struct film *made = calloc(1, sizeof *made);
	if (!made) {
		free(pixels);
		return out_of_memory(error, "there is not enough memory for a film");
	}
	made->folder = folder;
	made->render = render;
	made->pictures[made->picture_count++].pixels = pixels;
	made->failed = NO_FRAME;
	pthread_mutex_init(&made->mutex, NULL);
	pthread_cond_init(&made->changed, NULL);
	*film = made;
	return CAROM_OK;
}

static carom_status failure(const struct film *film, carom_error *error)
{
	if (film->failed == NO_FRAME)
		return CAROM_OK;
	*error = film->error;
	return error->status;
}

static struct picture *first_free(struct film *film)
{
	for (int k = 0; k < film->picture_count; k++)
		if (film->pictures[k].stage == FREE)
			return &film->pictures[k];
	return NULL;
}

/* Waits until there is one. */
static struct picture *free_picture(struct film *film)
{
	struct picture *picture;
	while (!(picture = first_free(film)))
		pthread_cond_wait(&film->changed, &film->mutex);
	return picture;
}

carom_status film_add(struct film *film, carom_world *world, carom_error *error)
{
	if (film->handed_over == 1) /* there are to be several */
		begin_writers(film);
	pthread_mutex_lock(&film->mutex);
	struct picture *picture = free_picture(film);
	carom_status status = failure(film, error);
	pthread_mutex_unlock(&film->mutex);
	if (status == CAROM_OK)
		status = carom_world_render(world, film->render, picture->pixels, error);
	if (status != CAROM_OK)
		return status;
	picture->number = film->handed_over++;
	if (film->writer_count == 0) {
		write_picture(film, picture);
		return failure(film, error);
	}
	pthread_mutex_lock(&film->mutex);
	picture->stage = DRAWN;
	pthread_cond_broadcast(&film->changed);
	pthread_mutex_unlock(&film->mutex);
	return CAROM_OK;
}

carom_status film_finish(struct film *film, uint64_t *length, carom_error *error)
{
	pthread_mutex_lock(&film->mutex);
	film->ends = true;
	pthread_cond_broadcast(&film->changed);
	pthread_mutex_unlock(&film->mutex);
	while (film->writer_count > 0)
		pthread_join(film->writers[--film->writer_count], NULL);
	*length = film->handed_over < film->failed ? film->handed_over : film->failed;
	return failure(film, error);
}

void film_destroy(struct film *film)
{
	carom_error ignored;
	uint64_t length;
	if (!film)
		return;
	film_finish(film, &length, &ignored);
	for (int k = 0; k < film->picture_count; k++)
		free(film->pictures[k].pixels);
	pthread_cond_destroy(&film->changed);
	pthread_mutex_destroy(&film->mutex);
	free(film);
}
