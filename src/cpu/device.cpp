/* The CPU device: textures in the host's memory, and the stages in C++. Exceptions end here. */
#include "device.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <new>
#include <string>

#include "cpu/machine.hpp"
#include "cpu/pixels.hpp"
#include "cpu/stages.hpp"
#include "status.h"

namespace carom::cpu {

constexpr uint32_t longest_side = 32768;

/* What an alternative has for scalars of type T. */
template <typename T> struct Instance;

template <> struct Instance<float> {
	static Run<float> run(const Kernel &kernel) { return kernel.run; }
	static InsideTest<float> inside(const Stage &stage) { return stage.inside; }
	static FindTransforms<float> find_transforms(const Stage &stage) { return stage.find_transforms; }
	static const Functions<float> &functions(const Stage &stage) { return stage.functions; }
};

template <> struct Instance<double> {
	static Run<double> run(const Kernel &kernel) { return kernel.run_double; }
	static InsideTest<double> inside(const Stage &stage) { return stage.inside_double; }
	static FindTransforms<double> find_transforms(const Stage &stage) { return stage.find_transforms_double; }
	static const Functions<double> &functions(const Stage &stage) { return stage.functions_double; }
};

template <typename T> struct Device : carom_device {
	explicit Device(const carom_device_def &def) : carom_device{}, pool(def.threads), profiled(def.profile), counted(def.count_reads) {}

	Pool pool;
	const bool profiled, counted;
	std::atomic<uint64_t> reads{0};
	Run<T> kernels[STAGE_COUNT] = {};
	InsideTest<T> inside = nullptr;
	FindTransforms<T> find_transforms = nullptr;
	Functions<T> functions;
};

template <typename T> static Device<T> &of(carom_device *device)
{
	return *static_cast<Device<T> *>(device);
}

static Texture &of(carom_texture *texture)
{
	return *reinterpret_cast<Texture *>(texture);
}

static carom_status out_of_memory(carom_error *error, const char *for_what, const char *name)
{
	return carom_fail(error, CAROM_OUT_OF_MEMORY, "there is not enough memory for %s%s on the CPU", for_what, name);
}

static carom_status fail_texture(carom_error *error, carom_status status, const char *name, uint32_t width, uint32_t height, uint64_t bytes,
	const char *reason, unsigned long long allowed = 0)
{
	char why[128];
	std::snprintf(why, sizeof why, reason, allowed);
	return carom_fail(error, status, "%s, %u x %u texels (%llu KiB), can't be made: %s", name, width, height,
		static_cast<unsigned long long>((bytes + 1023) / 1024), why);
}

/* ---- Textures */

template <typename T> static size_t scalar_size(carom_texel_format format)
{
	return format == TEXELS_FLOAT || format == TEXELS_RECORD ? sizeof(T) : 1; /* a quarter of a texel: a list's have four bytes, too */
}

/* Every texel the same; all the rows are if one is. */
template <typename T> static void fill_rows(Texture &texture, const float fill[4])
{
	if (texture.format == TEXELS_RECORD) {
		T *record = static_cast<T *>(texture.memory.get());
		for (size_t left = size_t(texture.width) * texture.height; left > 0; left--, record += channel_count)
			std::copy(fill, fill + channel_count, record);
		return;
	}
	const int32_t width = static_cast<int32_t>(texture.width), height = static_cast<int32_t>(texture.height);
	for (int32_t y = 0; y < height; y++) {
		for (int32_t channel = 0; channel < 4; channel++) {
			if (texture.format != TEXELS_FLOAT) {
				for (int32_t x = 0; x < width; x++)
					Bytes(texture).row(y)[4 * x + channel] = static_cast<uint8_t>(fill[channel]);
			} else {
				T *row = Texels<T>(texture).row(y, channel);
				std::fill(row, row + width, static_cast<T>(fill[channel]));
			}
		}
	}
}

/* Zeros, from the beginning of a line of the caches on: records that are as long lie in one. */
static std::unique_ptr<void, Free> zeros(uint64_t bytes)
{
	constexpr size_t line = 64;
	char *memory = static_cast<char *>(std::calloc(1, bytes + line));
	const size_t skipped = memory ? line - reinterpret_cast<uintptr_t>(memory) % line : 0;
	return {memory ? memory + skipped : nullptr, Free{skipped, false}};
}

template <typename T>
static carom_status create(carom_device *device, const char *name, carom_texel_format format, uint32_t width, uint32_t height, const float fill[4],
	carom_texture **texture, carom_error *error)
{
	const uint64_t texels = uint64_t(width) * height, bytes = texels * channel_count * scalar_size<T>(format);
	const uint32_t longest = device->info.max_image_size;
	if (width < 1 || height < 1 || width > longest || height > longest)
		return fail_texture(error, CAROM_LIMIT, name, width, height, bytes, "a side has 1 to %llu on the CPU", longest);
	if (bytes > device->info.max_allocation)
		return fail_texture(error, CAROM_LIMIT, name, width, height, bytes, "one has at most %llu bytes on the CPU", device->info.max_allocation);
	std::unique_ptr<void, Free> memory = zeros(bytes);
	std::unique_ptr<Texture> made(new (std::nothrow) Texture{format, width, height, std::move(memory)});
	if (!made || !made->memory)
		return fail_texture(error, CAROM_OUT_OF_MEMORY, name, width, height, bytes, "there is not enough memory on the CPU");
	if (format == TEXELS_LIST || format == TEXELS_RECORD)
		carom_prefer_large_pages(made->memory.get(), bytes);
	if (std::any_of(fill, fill + 4, [](float channel) { return channel != 0; }))
		fill_rows<T>(*made, fill); /* else the pages stay the system's until they are written */
	*texture = reinterpret_cast<carom_texture *>(made.release());
	return CAROM_OK;
}

static carom_status wrap(carom_device *, const char *name, uint32_t width, uint32_t height, void *texels, carom_texture **texture, carom_error *error)
{
	std::unique_ptr<Texture> made(new (std::nothrow) Texture{TEXELS_BYTE, width, height, {texels, Free{0, true}}});
	if (!made)
		return out_of_memory(error, "the texture ", name);
	*texture = reinterpret_cast<carom_texture *>(made.release());
	return CAROM_OK;
}

static void destroy(carom_device *, carom_texture *texture)
{
	delete reinterpret_cast<Texture *>(texture);
}

static carom_status check_rows(const Texture &texture, uint32_t rows, carom_error *error)
{
	if (rows <= texture.height)
		return CAROM_OK;
	return carom_fail(error, CAROM_INVALID_ARGUMENT, "%u rows of a texture that has %u", rows, texture.height);
}

/* Copies rows between a texture and texels that have their channels side by side. */
template <typename T, typename Copy> static void copy_rows(const Texture &texture, uint32_t rows, Copy copy)
{
	size_t from = 0;
	for (int32_t y = 0; y < static_cast<int32_t>(rows); y++, from += channel_count * texture.width) {
		for (int32_t channel = 0; channel < 4; channel++) {
			T *row = Texels<T>(texture).row(y, channel);
			for (size_t x = 0; x < texture.width; x++)
				copy(row[x], from + channel_count * x + static_cast<size_t>(channel));
		}
	}
}

template <typename T> static carom_status upload(carom_device *, carom_texture *texture, uint32_t rows, const void *texels, carom_error *error)
{
	Texture &to = of(texture);
	if (carom_status status = check_rows(to, rows, error))
		return status;
	if (to.format == TEXELS_RECORD) {
		const float *numbers = static_cast<const float *>(texels);
		std::copy(numbers, numbers + channel_count * to.width * rows, static_cast<T *>(to.memory.get()));
	} else if (to.format != TEXELS_FLOAT) {
		std::memcpy(to.memory.get(), texels, channel_count * to.width * rows);
	} else {
		const float *numbers = static_cast<const float *>(texels);
		copy_rows<T>(to, rows, [=](T &number, size_t index) { number = numbers[index]; });
	}
	return CAROM_OK;
}

template <typename T> static carom_status download(carom_device *device, carom_texture *texture, uint32_t rows, void *texels, carom_error *error)
try {
	Texture &from = of(texture);
	if (carom_status status = check_rows(from, rows, error))
		return status;
	if (from.format == TEXELS_FLOAT) {
		T *numbers = static_cast<T *>(texels);
		copy_rows<T>(from, rows, [=](T &number, size_t index) { numbers[index] = number; });
		return CAROM_OK;
	}
	const size_t row = channel_count * scalar_size<T>(from.format) * from.width;
	const char *memory = static_cast<const char *>(from.memory.get());
	of<T>(device).pool.run(static_cast<int32_t>(rows), 64, [&](int32_t begin, int32_t end) { /* a picture is large */
		const size_t first = static_cast<size_t>(begin) * row;
		std::memcpy(static_cast<char *>(texels) + first, memory + first, static_cast<size_t>(end) * row - first);
	});
	return CAROM_OK;
} catch (const std::exception &) {
	return out_of_memory(error, "a copy", "");
}

/* ---- Running */

template <typename T> static bool has(const carom_device *device, carom_stage stage)
{
	return stage < STAGE_COUNT && static_cast<const Device<T> *>(device)->kernels[stage] != nullptr;
}

template <typename T> static void run_kernel(Device<T> &device, carom_stage stage, const Texture *const *textures, const int32_t *domain)
{
	using Clock = std::chrono::steady_clock;
	const Clock::time_point start = device.profiled ? Clock::now() : Clock::time_point();
	device.kernels[stage]({textures, domain, device.pool, device.inside, device.find_transforms, device.functions,
		device.counted ? &device.reads : nullptr});
	if (device.profiled) {
		device.times[stage].seconds += std::chrono::duration<double>(Clock::now() - start).count();
		device.times[stage].launches++;
	}
}

template <typename T>
static carom_status run(carom_device *device, carom_stage stage, carom_texture *const *textures, const int32_t domain[4], carom_error *error)
try {
	if (!has<T>(device, stage))
		return carom_fail(error, CAROM_DEVICE, "the CPU device has no kernel for stage %d", static_cast<int>(stage));
	const carom_stage_def &def = carom_stages[stage];
	const Texture *given[CAROM_MAX_TEXTURES] = {};
	for (int i = 0; i < def.input_count + def.output_count; i++)
		given[i] = &of(textures[i]);
	run_kernel(of<T>(device), stage, given, domain);
	return CAROM_OK;
} catch (const std::exception &) {
	return out_of_memory(error, "the stage ", carom_stages[stage].kernel);
}

static carom_status flush(carom_device *, carom_error *)
{
	return CAROM_OK;
}

/* The times are always up to date: nothing is still to be done when run returns. */
static void profile(carom_device *) {}

template <typename T> static carom_status reads(carom_device *device, uint64_t *texels, carom_error *)
{
	*texels = of<T>(device).reads.exchange(0);
	return CAROM_OK;
}

/* ---- Opening and closing */

template <typename T> static void close(carom_device *device)
{
	delete static_cast<Device<T> *>(device);
}

template <typename T>
static constexpr carom_device_class device_class{
	tile_width, tile_height, close<T>, create<T>, wrap, destroy, upload<T>, download<T>, has<T>, run<T>, flush, profile, reads<T>};

/* The alternative that fills the slot: some stages' is fixed, others' is the pipeline's. */
static bool is_chosen(const carom_pipeline &pipeline, const Stage &stage, const char *fixed)
{
	const char *name = fixed ? fixed : carom_pipeline_get(&pipeline, stage.slot);
	return !name || std::strcmp(name, stage.name) == 0;
}

template <typename T> static void add_functions(Functions<T> &all, const Functions<T> &of_stage)
{
	if (of_stage.pair_time)
		all.pair_time = of_stage.pair_time;
	if (of_stage.wall_time)
		all.wall_time = of_stage.wall_time;
	if (of_stage.impulses)
		all.impulses = of_stage.impulses;
}

template <typename T> static void choose(Device<T> &device, const carom_pipeline &pipeline)
{
	for (const Stage *const *stage = stages; *stage; stage++) {
		for (const Kernel &kernel : (*stage)->kernels) {
			if (kernel.run && is_chosen(pipeline, **stage, carom_stages[kernel.stage].alternative))
				device.kernels[kernel.stage] = Instance<T>::run(kernel);
		}
		if ((*stage)->inside && is_chosen(pipeline, **stage, nullptr))
			device.inside = Instance<T>::inside(**stage);
		if (is_chosen(pipeline, **stage, nullptr))
			add_functions(device.functions, Instance<T>::functions(**stage));
		if ((*stage)->find_transforms && is_chosen(pipeline, **stage, nullptr))
			device.find_transforms = Instance<T>::find_transforms(**stage);
	}
}

static carom_status unknown(carom_error *error, const carom_pipeline &pipeline, const char *slot)
{
	const char *name = carom_pipeline_get(&pipeline, slot);
	return carom_fail(error, CAROM_UNKNOWN_NAME, "the CPU device has no %s '%s'", slot, name ? name : "");
}

/* Not every alternative has them. */
static bool is_optional(int stage)
{
	return stage == STAGE_TOI_NEXT || stage == STAGE_REDUCE || stage == STAGE_REDUCE_TILES;
}

template <typename T> static carom_status check(const Device<T> &device, const carom_pipeline &pipeline, carom_error *error)
{
	for (int stage = 0; stage < STAGE_COUNT; stage++) {
		if (!device.kernels[stage] && !is_optional(stage))
			return unknown(error, pipeline, carom_stages[stage].slot);
	}
	if (!device.kernels[STAGE_REDUCE] && !device.kernels[STAGE_REDUCE_TILES])
		return unknown(error, pipeline, "reduce");
	if (!device.find_transforms)
		return unknown(error, pipeline, "transforms");
	return device.inside ? CAROM_OK : unknown(error, pipeline, "inside");
}

template <typename T> static carom_status open(const carom_device_def *def, carom_device **device, carom_error *error)
try {
	std::unique_ptr<Device<T>> opened(new Device<T>(*def));
	opened->kind = &device_class<T>;
	opened->storage = CAROM_STORAGE_BUFFER;
	carom_cpu_info(&opened->info);
	choose(*opened, def->pipeline);
	if (carom_status status = check(*opened, def->pipeline, error))
		return status;
	*device = opened.release();
	return CAROM_OK;
} catch (const std::exception &) {
	return out_of_memory(error, "threads", "");
}

}

/* ---- The border to C */

void carom_cpu_info(carom_device_info *info)
{
	std::memset(info, 0, sizeof *info);
	carom::cpu::describe_machine(*info);
	info->is_cpu = info->works = info->exact = true;
	info->max_allocation = info->memory / 2;
	info->max_image_size = carom::cpu::longest_side;
}

carom_status carom_cpu_open(const carom_device_def *def, carom_device **device, carom_error *error)
{
	return carom::cpu::open<float>(def, device, error);
}

carom_status carom_cpu_open_double(const carom_device_def *def, carom_device **device, carom_error *error)
{
	return carom::cpu::open<double>(def, device, error);
}

const char *carom_cpu_alternative(const char *slot, size_t index)
{
	for (const carom::cpu::Stage *const *stage = carom::cpu::stages; *stage; stage++) {
		if (std::strcmp((*stage)->slot, slot) == 0 && index-- == 0)
			return (*stage)->name;
	}
	return nullptr;
}

bool carom_cpu_has_alternative(const char *slot, const char *alternative)
{
	const char *name;
	for (size_t index = 0; (name = carom_cpu_alternative(slot, index)); index++) {
		if (std::strcmp(name, alternative) == 0)
			return true;
	}
	return false;
}
