/* Stands for carom_plot*.c in a command built with CAIRO=no.
 * SPDX-License-Identifier: MIT */
#include "carom_plot.h"
#include "carom_tool.h"

carom_status plot_check(const char *path, carom_error *error)
{
	return wrong(error, "%.800s: this carom was built without cairo and draws no charts; --csv has the figures", path);
}

carom_status plot_write(struct plot_figure *figure, const char *path, carom_error *error)
{
	(void)figure;
	return plot_check(path, error);
}
