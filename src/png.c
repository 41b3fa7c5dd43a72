/* PNG through libpng, which is included here and nowhere else.
 * SPDX-License-Identifier: MIT */
#include "status.h"

#include <errno.h>
#include <png.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

#define MAX_SIDE 1000000u /* libpng's own limit, where it would stop with a less helpful sentence */

#define COMPRESSION_LEVEL 3 /* of 9: 6 takes twice as long for 8 % less */

/* What libpng said, kept until the file is dealt with. */
struct complaint {
	int number; /* errno, 0 if it was no system call */
	bool no_memory;
	char text[160];
};

static void on_error(png_structp png, png_const_charp text)
{
	struct complaint *complaint = png_get_error_ptr(png);
	complaint->number = errno;
	snprintf(complaint->text, sizeof complaint->text, "%s", text);
	longjmp(png_jmpbuf(png), 1);
}

/* libpng would not say that it was the memory that ended. */
static png_voidp allocate(png_structp png, png_alloc_size_t size)
{
	struct complaint *complaint = png_get_mem_ptr(png);
	void *memory = malloc(size);
	complaint->no_memory = complaint->no_memory || !memory;
	return memory;
}

static void release(png_structp png, png_voidp memory)
{
	(void)png;
	free(memory);
}

static void on_warning(png_structp png, png_const_charp text)
{
	(void)png;
	(void)text; /* the library never prints */
}

/* Everything that may jump. It has no locals that change after setjmp, so that none is lost by the jump. */
static bool write_pixels(png_structp png, png_infop info, FILE *stream, const uint8_t *pixels, uint32_t width, uint32_t height)
{
	errno = 0;
	if (setjmp(png_jmpbuf(png)))
		return false;
	png_init_io(png, stream);
	png_set_IHDR(png, info, width, height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
	/* Flat colours: without filters such a picture is a tenth smaller and written three times as fast. */
	png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
	png_set_compression_level(png, COMPRESSION_LEVEL);
	png_write_info(png, info);
	png_set_filler(png, 0, PNG_FILLER_AFTER); /* skips the fourth byte: the picture is opaque */
	for (uint32_t row = 0; row < height; row++)
		png_write_row(png, pixels + (size_t)row * width * 4);
	png_write_end(png, NULL);
	return true;
}

static carom_status encode(const char *path, FILE *stream, const uint8_t *pixels, uint32_t width, uint32_t height, carom_error *error)
{
	carom_status status = CAROM_OK;
	struct complaint complaint = {0, false, ""};
	char reason[128];
	png_infop info = NULL;
	png_structp png = png_create_write_struct_2(PNG_LIBPNG_VER_STRING, &complaint, on_error, on_warning, &complaint, allocate, release);
	bool written = false;
	if (png)
		info = png_create_info_struct(png);
	if (info)
		written = write_pixels(png, info, stream, pixels, width, height);
	if (!info || (!written && complaint.no_memory)) {
		status = carom_fail(error, CAROM_OUT_OF_MEMORY, "%s: there is not enough memory to write a PNG", path);
	} else if (!written) {
		status = carom_fail(error, CAROM_IO, "%s: can't be written: %s%s%s; free some space or write elsewhere", path, complaint.text,
			complaint.number ? ": " : "", complaint.number ? carom_errno_text(complaint.number, reason, sizeof reason) : "");
	}
	png_destroy_write_struct(&png, &info);
	return status;
}

carom_status carom_png_write(const char *path, const uint8_t *pixels, uint32_t width, uint32_t height, carom_error *error)
{
	carom_status status;
	carom_file *file = NULL;
	FILE *stream = NULL;
	if (!path || !pixels)
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "carom_png_write: no path or no pixels");
	if (width < 1 || width > MAX_SIDE || height < 1 || height > MAX_SIDE) {
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "carom_png_write: %u x %u pixels; a side has 1 to %u", width, height, MAX_SIDE);
	}
	status = carom_file_create(path, &file, &stream, error);
	if (status != CAROM_OK)
		return status;
	status = encode(path, stream, pixels, width, height, error);
	if (status == CAROM_OK)
		return carom_file_commit(file, error);
	carom_file_destroy(file);
	return status;
}
