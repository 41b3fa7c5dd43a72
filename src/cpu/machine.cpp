#include "cpu/machine.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <thread>

namespace carom::cpu {

/* Linux, and not on every processor; where there is none the text stays empty. */
static void read_model(char *model, size_t size)
{
	std::FILE *file = std::fopen("/proc/cpuinfo", "r");
	if (!file)
		return;
	char line[512];
	while (model[0] == '\0' && std::fgets(line, sizeof line, file)) {
		const char *value = std::strchr(line, ':');
		if (!value || std::strncmp(line, "model name", 10) != 0)
			continue;
		value += 1 + std::strspn(value + 1, " \t");
		std::snprintf(model, size, "%.*s", static_cast<int>(std::strcspn(value, "\n")), value);
	}
	std::fclose(file);
}

static uint64_t physical_memory()
{
#ifdef _SC_PHYS_PAGES
	long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
	if (pages > 0 && size > 0)
		return static_cast<uint64_t>(pages) * static_cast<uint64_t>(size);
#endif
	return uint64_t(1) << 30;
}

void describe_machine(carom_device_info &info)
{
	char model[200] = "";
	read_model(model, sizeof model);
	std::snprintf(info.platform, sizeof info.platform, "Carom");
	std::snprintf(info.name, sizeof info.name, model[0] ? "cpu (%s)" : "cpu", model);
	std::snprintf(info.version, sizeof info.version, "%s", carom_version());
	unsigned cores = std::thread::hardware_concurrency();
	info.compute_units = cores > 0 ? cores : 1;
	info.memory = physical_memory();
}

}
