/* A line on the terminal that tells how far a run is.
 * SPDX-License-Identifier: MIT */
#include "carom_run.h"

#include <string.h>
#include <unistd.h>

#define INTERVAL 0.2 /* s between two drawings */
#define BAR 24       /* characters */

void begin_progress(struct progress *progress, bool quiet)
{
	progress->shown = !quiet && isatty(STDERR_FILENO);
	progress->drawn = false;
	progress->begun = progress->last = wall_seconds();
}

static const char *format_duration(double seconds, char *text, size_t size)
{
	if (!(seconds < 360000)) {
		snprintf(text, size, "> 100 h");
	} else {
		unsigned whole = (unsigned)seconds;
		if (whole >= 3600) {
			snprintf(text, size, "%u:%02u:%02u", whole / 3600, whole / 60 % 60, whole % 60);
		} else {
			snprintf(text, size, "%u:%02u", whole / 60, whole % 60);
		}
	}
	return text;
}

void show_progress(struct progress *progress, double done, uint64_t steps, double simulated)
{
	char left[16];
	double now = wall_seconds(), elapsed = now - progress->begun;
	if (!progress->shown || now - progress->last < INTERVAL)
		return;
	if (done > 1)
		done = 1;
	double rest = done > 0 ? elapsed * (1 - done) / done : 1e9;
	int filled = (int)(done * BAR);
	fprintf(stderr, "\r[%.*s%.*s] %3.0f%%  %llu steps  %.4g s  %.3g steps/s  %s left\033[K", filled, "########################", BAR - filled,
		"........................", done * 100, (unsigned long long)steps, simulated, (double)steps / elapsed,
		format_duration(rest, left, sizeof left));
	fflush(stderr);
	progress->last = now;
	progress->drawn = true;
}

void end_progress(struct progress *progress)
{
	if (progress->drawn)
		fputs("\r\033[K", stderr);
	progress->drawn = false;
}
