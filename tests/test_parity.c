/* Every alternative of every slot on every device: each stage is given the same random textures, and must give the bits of
 * the float instance on the CPU and the values of the double instance, its decisions too, outside a narrow band. */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "judge.h"

/* The step events has a free hand between its stages: it is judged by its results, in test_events.c and test_hashes.c. */
static bool is_of_events(const char *slot)
{
	return !strcmp(slot, "slots") || !strcmp(slot, "neighbours") || !strcmp(slot, "contacts") || !strcmp(slot, "sleep") || !strcmp(slot, "events")
		|| !strcmp(slot, "settle") || !strcmp(slot, "drift");
}

static void every_alternative_on_every_device(void **unused)
{
	(void)unused;
	carom_stage_info info;
	for (size_t i = 0; carom_stage_list(i, &info); i++) {
		if (!strcmp(info.slot, "step") || carom_slot_draws(info.slot) || is_of_events(info.slot))
			continue;
		assert_true(info.on_opencl && info.on_cpu);
		SCENERY_EACH_DEVICE(device) {
			judgement b;
			if (!judge(info.slot, info.alternative, device, 100 + i, &b))
				continue;
			print_message("%s %s on %s%s: %zu decisions, %zu disputed, %zu values and %zu bits differ\n", info.slot, info.alternative, device->name,
				device->storage == CAROM_STORAGE_IMAGE ? " images" : "", b.decisions, b.disputed, b.wrong_values, b.wrong_bits);
			assert_int_equal(b.wrong_bits, 0);
			assert_int_equal(b.wrong_values, 0);
			assert_true(b.decisions > 300);
			assert_true(b.disputed * 200 <= b.decisions); /* grazing pairs: float and double may see them differently */
		}
	}
}

static char *read_text(const char *path)
{
	FILE *file = fopen(path, "rb");
	char *text = calloc(1, 1 << 16);
	assert_non_null(file);
	assert_non_null(text);
	assert_true(fread(text, 1, (1 << 16) - 1, file) > 0);
	fclose(file);
	return text;
}

/* Writes kernels/impulse/pair_exact.cl into a folder of overrides, with `good` replaced by `bad`. */
static void break_kernel(const char *folder, const char *good, const char *bad)
{
	char path[512], *text = read_text("kernels/impulse/pair_exact.cl"), *place = strstr(text, good);
	FILE *file;
	assert_non_null(place);
	mkdir(folder, 0777);
	snprintf(path, sizeof path, "%s/impulse", folder);
	mkdir(path, 0777);
	snprintf(path, sizeof path, "%s/impulse/pair_exact.cl", folder);
	file = fopen(path, "wb");
	assert_non_null(file);
	fprintf(file, "%.*s%s%s", (int)(place - text), text, bad, place + strlen(good));
	fclose(file);
	free(text);
}

static const char *scratch_folder(char *folder, size_t size)
{
	const char *build = getenv("CAROM_BUILD");
	snprintf(folder, size, "%s/broken_kernels", build ? build : "build");
	return folder;
}

/* The judge must be able to say no: one kernel's impulses are a tenth too small. */
static void broken_kernel_is_rejected(void **unused)
{
	(void)unused;
	char folder[256];
	judgement b = {0};
	bool ran;
	break_kernel(scratch_folder(folder, sizeof folder), "gain0 / k00", "0.9f * gain0 / k00");
	setenv("CAROM_KERNEL_DIR", folder, 1);
	ran = judge("impulse", "pair_exact", &scenery_devices[1], 5, &b);
	unsetenv("CAROM_KERNEL_DIR");
	if (ran)
		assert_true(b.wrong_bits > 0 && b.wrong_values > 0);
}

/* A kernel that does not compile names the file and the line. */
static void build_error_has_the_log(void **unused)
{
	(void)unused;
	char folder[256];
	carom_world_def def = carom_default_world_def();
	carom_world *world = NULL;
	carom_error error;
	carom_status status;
	break_kernel(scratch_folder(folder, sizeof folder), "return", "retrun");
	setenv("CAROM_KERNEL_DIR", folder, 1);
	def.device = "opencl";
	status = carom_world_create(&def, &world, &error);
	unsetenv("CAROM_KERNEL_DIR");
	if (status == CAROM_UNKNOWN_NAME)
		return;
	assert_int_equal(status, CAROM_DEVICE);
	assert_non_null(strstr(error.build_log, "kernels/impulse/pair_exact.cl"));
	assert_int_not_equal(error.opencl_code, 0);
}

/* The whole step, a thousand times: one hash. */
static void one_hash_everywhere(void **unused)
{
	(void)unused;
	uint64_t hashes[8];
	size_t count = 0;
	SCENERY_EACH_DEVICE(device) {
		carom_world_def def = judge_arena("toi", "circle_quadratic");
		carom_world *world = scenery_world(&def, device);
		carom_error error;
		if (!world)
			continue;
		judge_fill(world, 11);
		scenery_check(carom_world_step(world, 1000, NULL, &error), &error);
		scenery_check(carom_world_hash(world, &hashes[count++], &error), &error);
		carom_world_destroy(world);
	}
	for (size_t i = 1; i < count; i++)
		assert_true(hashes[i] == hashes[0]);
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(every_alternative_on_every_device), cmocka_unit_test(broken_kernel_is_rejected),
		cmocka_unit_test(build_error_has_the_log), cmocka_unit_test(one_hash_everywhere)};
	return cmocka_run_group_tests_name("parity", tests, NULL, NULL);
}
