/* Writes where all bodies are, at the times of frames: a table, or an array of NumPy, which is read in a fraction of the time.
 * SPDX-License-Identifier: MIT */
#include "carom_run.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#define NUMBERS 6  /* of a body */
#define HEADER 128 /* bytes; NumPy's data begin at a multiple of 64 */

_Static_assert(sizeof(carom_body_state) == NUMBERS * sizeof(float), "a body's numbers lie in the array as they do here");

struct states {
	const char *path; /* the caller's */
	carom_file *file;
	FILE *stream;
	bool is_array;
	uint64_t frames;
	size_t count;             /* bodies */
	carom_body_state *bodies; /* NULL before the first frame */
};

/* NumPy's format, version 1.0: the magic, the length of what follows, and that as text. How many frames there are is known in the end. */
static void put_header(const struct states *states)
{
	const int length = HEADER - 10;
	char text[HEADER];
	snprintf(text, sizeof text, "{'descr': '%cf4', 'fortran_order': False, 'shape': (%llu, %zu, %d), }",
		__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? '<' : '>', (unsigned long long)states->frames, states->count, NUMBERS);
	fprintf(states->stream, "\x93NUMPY\x01%c%c%c%-*s\n", 0, length, 0, length - 1, text);
}

carom_status states_create(const char *path, struct states **states, carom_error *error)
{
	struct states *made = calloc(1, sizeof *made);
	if (!made)
		return out_of_memory(error, "there is not enough memory for --states");
	const char *const end = strrchr(path, '.');
	carom_status status = carom_file_create(path, &made->file, &made->stream, error);
	made->path = path;
	made->is_array = end && strcmp(end, ".npy") == 0;
	if (status == CAROM_OK && made->is_array && fseek(made->stream, 0, SEEK_SET) != 0)
		status = wrong(error, "--states: %s: an array can't go through a pipe, for its head is written in the end; a name without .npy is a table",
			path);
	if (status != CAROM_OK) {
		states_destroy(made);
		return status;
	}
	if (made->is_array)
		put_header(made);
	else
		fputs("time_s,body,x_m,y_m,angle_rad,velocity_x_m_s,velocity_y_m_s,angular_velocity_rad_s\n", made->stream);
	*states = made;
	return CAROM_OK;
}

/* Of a write: there is no use in going on. */
static carom_status fail(const struct states *states, carom_error *error)
{
	wrong(error, "--states: %s: can't be written: %s; what was there before stays", states->path, strerror(errno ? errno : ENOSPC));
	error->status = CAROM_IO;
	return CAROM_IO;
}

static void put_row(FILE *stream, double time, size_t body, const carom_body_state *state)
{
	fprintf(stream, "%.12g,%zu,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", time, body, (double)state->position.x, (double)state->position.y,
		(double)state->angle, (double)state->velocity.x, (double)state->velocity.y, (double)state->angular_velocity);
}

carom_status states_add(struct states *states, carom_world *world, carom_error *error)
{
	if (!states->bodies) {
		states->count = carom_world_body_count(world);
		states->bodies = malloc((states->count + 1) * sizeof *states->bodies);
		if (!states->bodies)
			return out_of_memory(error, "there is not enough memory for the states of %zu bodies", states->count);
	}
	carom_status status = states->count > 0 ? carom_world_get_states(world, 0, states->count, states->bodies, error) : CAROM_OK;
	if (status != CAROM_OK)
		return status;
	states->frames++;
	errno = 0;
	if (states->is_array)
		fwrite(states->bodies, sizeof *states->bodies, states->count, states->stream);
	for (size_t k = 0; !states->is_array && k < states->count; k++)
		put_row(states->stream, carom_world_time(world), k, &states->bodies[k]);
	return ferror(states->stream) ? fail(states, error) : CAROM_OK;
}

carom_status states_commit(struct states *states, carom_error *error)
{
	carom_status status = CAROM_OK;
	if (states->is_array) {
		errno = 0;
		if (fflush(states->stream) != 0 || fseek(states->stream, 0, SEEK_SET) != 0)
			status = fail(states, error);
		else
			put_header(states);
	}
	if (status == CAROM_OK) {
		status = carom_file_commit(states->file, error);
		states->file = NULL;
	}
	states_destroy(states);
	return status;
}

void states_destroy(struct states *states)
{
	if (!states)
		return;
	carom_file_destroy(states->file);
	free(states->bodies);
	free(states);
}
