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
#define INDEXED_LEVEL 6     /* of pictures with a palette: twice as long for 40 % less */

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

/* ---- Palettes: with one, a picture of few colours, like a chart, takes a third of the bytes */

#define MAX_COLORS 256
#define PLACES 1024 /* for colours by their hash; a power of two */

struct palette {
	int count; /* above MAX_COLORS: there are too many */
	png_color colors[MAX_COLORS];
	int16_t places[PLACES]; /* index of a colour, -1 for none */
};

/* The place of the pixel's colour, or the free one where it belongs. */
static size_t find_place(const struct palette *palette, const uint8_t *pixel)
{
	const uint32_t key = (uint32_t)pixel[0] << 16 | (uint32_t)pixel[1] << 8 | pixel[2];
	for (size_t place = key * 2654435761u >> 22;; place = (place + 1) % PLACES) {
		const png_color *color = &palette->colors[palette->places[place] < 0 ? 0 : palette->places[place]];
		if (palette->places[place] < 0 || (color->red == pixel[0] && color->green == pixel[1] && color->blue == pixel[2]))
			return place;
	}
}

static void find_palette(struct palette *palette, const uint8_t *pixels, size_t count)
{
	palette->count = 0;
	memset(palette->places, -1, sizeof palette->places);
	for (size_t k = 0; k < count && palette->count <= MAX_COLORS; k++, pixels += 4) {
		const size_t place = find_place(palette, pixels);
		if (palette->places[place] >= 0)
			continue;
		if (palette->count < MAX_COLORS) {
			palette->places[place] = (int16_t)palette->count;
			palette->colors[palette->count] = (png_color){pixels[0], pixels[1], pixels[2]};
		}
		palette->count++;
	}
}

static void index_row(const struct palette *palette, const uint8_t *pixels, uint8_t *row, uint32_t width)
{
	for (uint32_t x = 0; x < width; x++)
		row[x] = (uint8_t)palette->places[find_place(palette, pixels + (size_t)x * 4)];
}

/* Everything that may jump. It has no locals that change after setjmp, so that none is lost by the jump. `row` has room for a row of indices. */
static bool write_pixels(png_structp png, png_infop info, FILE *stream, const struct palette *palette, const uint8_t *pixels, uint8_t *row,
	uint32_t width, uint32_t height)
{
	const bool is_indexed = palette->count <= MAX_COLORS;
	errno = 0;
	if (setjmp(png_jmpbuf(png)))
		return false;
	png_init_io(png, stream);
	png_set_IHDR(png, info, width, height, 8, is_indexed ? PNG_COLOR_TYPE_PALETTE : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
		PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
	if (is_indexed)
		png_set_PLTE(png, info, palette->colors, palette->count);
	/* Flat colours: without filters such a picture is a tenth smaller and written three times as fast. */
	png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
	png_set_compression_level(png, is_indexed ? INDEXED_LEVEL : COMPRESSION_LEVEL);
	png_write_info(png, info);
	if (!is_indexed)
		png_set_filler(png, 0, PNG_FILLER_AFTER); /* skips the fourth byte: the picture is opaque */
	for (uint32_t y = 0; y < height; y++) {
		if (is_indexed)
			index_row(palette, pixels + (size_t)y * width * 4, row, width);
		png_write_row(png, is_indexed ? row : pixels + (size_t)y * width * 4);
	}
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
	struct palette *palette = calloc(1, sizeof *palette);
	uint8_t *row = malloc(width);
	bool written = false;
	if (png && palette && row)
		info = png_create_info_struct(png);
	if (info) {
		find_palette(palette, pixels, (size_t)width * height);
		written = write_pixels(png, info, stream, palette, pixels, row, width, height);
	}
	if (!info || (!written && complaint.no_memory)) {
		status = carom_fail(error, CAROM_OUT_OF_MEMORY, "%s: there is not enough memory to write a PNG", path);
	} else if (!written) {
		status = carom_fail(error, CAROM_IO, "%s: can't be written: %s%s%s; free some space or write elsewhere", path, complaint.text,
			complaint.number ? ": " : "", complaint.number ? carom_errno_text(complaint.number, reason, sizeof reason) : "");
	}
	png_destroy_write_struct(&png, &info);
	free(palette);
	free(row);
	return status;
}

carom_status carom_png_write(const char *path, const uint8_t *pixels, uint32_t width, uint32_t height, carom_error *error)
{
	carom_status status;
	carom_file *file = NULL;
	FILE *stream = NULL;
	GIVEN(path, error);
	GIVEN(pixels, error);
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
