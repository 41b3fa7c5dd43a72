/* What was measured: as text beside the paper's figures, and as CSV with a row a measurement.
 * SPDX-License-Identifier: MIT */
#include "carom_bench.h"

#include <inttypes.h>
#include <string.h>

/* ---- Text ---- */

const char *bench_format(double number, char *text, size_t size)
{
	int decimals = 2;
	for (double limit = 1; number > 0 && decimals < 6 && number < limit; limit /= 10)
		decimals++;
	snprintf(text, size, "%.*f", number >= 100 ? 0 : number >= 10 ? 1 : decimals, number);
	return text;
}

const char *bench_format_ratio(double ratio, char *text, size_t size)
{
	snprintf(text, size, "%.*f", ratio >= 100 ? 0 : ratio >= 10 ? 1 : 2, ratio);
	return text;
}

void bench_print_device(const char *what, const carom_device_info *device)
{
	printf("%s: %s%s%s%s%s%s, ", what, device->platform, *device->platform ? ": " : "", device->name, *device->version ? " (" : "", device->version,
		*device->version ? ")" : "");
	if (device->is_opencl) {
		printf("%u compute units, textures in %s\n", (unsigned)device->compute_units, device->uses_images ? "images" : "buffers");
	} else {
		printf("%u cores\n", (unsigned)device->compute_units);
	}
}

static void print_cell(const struct bench_result *result, const struct bench_row *row, const struct bench_column *column, size_t index)
{
	char median[32], least[32], most[32], spread[72], paper[32] = "-", ratio[32] = "-", over[32];
	struct bench_summary sum = bench_summarize(result, row, column, index);
	bench_format(sum.spread.median, median, sizeof median);
	snprintf(spread, sizeof spread, "%s - %s", bench_format(sum.spread.least, least, sizeof least), bench_format(sum.spread.most, most, sizeof most));
	if (sum.paper > 0)
		bench_format(sum.paper, paper, sizeof paper);
	if (sum.paper > 0 && sum.spread.median > 0)
		bench_format_ratio(sum.paper / sum.spread.median, ratio, sizeof ratio);
	snprintf(over, sizeof over, "%" PRIu64 "%s", row->repetitions, row->repetitions < REPETITIONS ? ", scaled" : "");
	printf("%8u  %-20s%10s  %-22s%10s%14s  %s\n", (unsigned)row->bodies, column->label, median, spread, paper, ratio, over);
}

static bool is_measured(const struct bench_row *row)
{
	for (size_t k = 0; k < MAX_COLUMNS; k++) {
		if (row->cells[k].measured)
			return true;
	}
	return false;
}

static void print_part(const struct bench_result *result, size_t index)
{
	const struct bench_part *part = &result->table->parts[index];
	printf("\n%s\n", part->title);
	printf("%8s  %-20s%10s  %-22s%10s%14s  %s\n", "bodies", "", "Carom, s", "least - most", "paper, s", "paper / Carom", "repetitions");
	for (size_t i = 0; i < result->row_count; i++) {
		const struct bench_row *row = &result->rows[index][i];
		for (size_t k = 0; k < part->column_count; k++) {
			if (row->cells[k].measured)
				print_cell(result, row, &part->columns[k], k);
		}
		if (i + 1 < result->row_count && part->column_count > 1 && is_measured(row))
			putchar('\n');
	}
}

static bool has_left_out(const struct bench_result *result)
{
	for (size_t part = 0; part < result->table->part_count; part++) {
		for (size_t k = 0; k < result->table->parts[part].column_count; k++) {
			if (!result->rows[part][0].cells[k].measured)
				return true;
		}
	}
	return false;
}

static void print_reading(const struct bench_result *result)
{
	printf("Carom: the median of %zu runs, with the least and the most.\n"
		   "scaled: fewer repetitions than 1,000 were measured; of steps a few at every 100th or 200th of 1,000.\n"
		   "All alternatives go on from the same states. A ratio above 1 means that Carom is faster.\n"
		   "The paper: NVIDIA GeForce 7900 GS; its CPU figures: Intel Core 2 Duo, 1.86 GHz.\n",
		result->runs);
}

static bool has_kernels(const struct bench_table *table)
{
	for (size_t part = 0; part < table->part_count; part++) {
		for (size_t k = 0; k < table->parts[part].column_count; k++) {
			if (*table->parts[part].columns[k].kernels)
				return true;
		}
	}
	return false;
}

void bench_print(const struct bench_result *result)
{
	printf("%s\n", result->table->title);
	bench_print_device("device", &result->device);
	if (*result->fallback.name)
		bench_print_device("CPU fallback", &result->fallback);
	for (size_t part = 0; part < result->table->part_count; part++)
		print_part(result, part);
	putchar('\n');
	print_reading(result);
	if (has_kernels(result->table))
		printf("Kernels' times are %s.\n",
			result->device.is_opencl ? "OpenCL's, by profiling events: launching is not in them" : "by the wall clock");
	if (has_left_out(result))
		printf("What is named OpenCL was left out: the device chosen is none of OpenCL's.\n");
	fputs(result->table->notes, stdout);
}

/* ---- CSV ---- */

void bench_write_csv_header(FILE *stream)
{
	fputs("version,table,part,device,storage,bodies,shape,alternative,pipeline,iterations,run,repetitions,launches,seconds,"
		  "seconds_per_1000,paper_seconds_per_1000,energy_drift,max_overlap_m,copy_bytes_per_s,speed_m_per_s,passed,off_m,hits\n",
		stream);
}

/* Device names may have commas and quotes. */
void bench_put_text(FILE *stream, const char *text)
{
	putc('"', stream);
	for (; *text; text++) {
		if (*text == '"')
			putc('"', stream);
		putc(*text, stream);
	}
	fputs("\",", stream);
}

void bench_put_device(FILE *stream, const carom_device_info *device)
{
	char name[512];
	snprintf(name, sizeof name, "%s%s%s", device->platform, *device->platform ? ": " : "", device->name);
	bench_put_text(stream, name);
}

const char *bench_storage(const carom_device_info *device)
{
	if (!device->is_opencl)
		return "memory";
	return device->uses_images ? "image" : "buffer";
}

/* What the runs of a cell have in common, up to the run's number. */
static void put_cell(FILE *stream, const struct bench_result *result, size_t part, uint32_t bodies, const struct bench_column *column)
{
	const struct bench_subject *subject = &result->table->parts[part].subjects[column->subject];
	const carom_device_info *device = subject->place == PLACE_CPU ? &result->fallback : &result->device;
	fprintf(stream, "%s,%s,", carom_version(), result->table->name);
	bench_put_text(stream, result->table->parts[part].title);
	bench_put_device(stream, device);
	fprintf(stream, "%s,%u,%s,", bench_storage(device), (unsigned)bodies, subject->sides ? "triangle" : "circle");
	bench_put_text(stream, column->label);
	bench_put_text(stream, result->pipelines[part][column->subject]);
	fprintf(stream, "%u,", (unsigned)subject->iterations);
}

static void write_cell(FILE *stream, const struct bench_result *result, size_t part, const struct bench_row *row, size_t index)
{
	const struct bench_column *column = &result->table->parts[part].columns[index];
	const struct bench_cell *cell = &row->cells[index];
	double paper = bench_summarize(result, row, column, index).paper;
	for (size_t run = 0; cell->measured && run < result->runs; run++) {
		put_cell(stream, result, part, row->bodies, column);
		fprintf(stream, "%zu,%" PRIu64 ",%" PRIu64 ",%.9g,%.9g,", run + 1, row->repetitions, cell->launches, cell->seconds[run],
			cell->seconds[run] * REPETITIONS / (double)row->repetitions);
		if (paper > 0)
			fprintf(stream, "%.9g", paper);
		fputs(",,,,,,,\n", stream); /* what only scale, tunnel and heap have */
	}
}

void bench_write_csv(FILE *stream, const struct bench_result *result)
{
	for (size_t part = 0; part < result->table->part_count; part++) {
		for (size_t i = 0; i < result->row_count; i++) {
			for (size_t k = 0; k < result->table->parts[part].column_count; k++)
				write_cell(stream, result, part, &result->rows[part][i], k);
		}
	}
}
