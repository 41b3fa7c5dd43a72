/* The stages of the CPU device.
 *
 * src/cpu/<slot>/<name>.cpp defines `extern const Stage <slot>_<name>`, one alternative of one slot; the build finds it by
 * its file name and lists it in `stages`. Everything of a stage is a template on the scalar with two instances: float is
 * the product, double the tests' oracle. */
#ifndef CAROM_CPU_STAGES_HPP
#define CAROM_CPU_STAGES_HPP

#include <atomic>

#include "cpu/numbers.hpp"
#include "cpu/pool.hpp"
#include "cpu/texture.hpp"
#include "stage.h"

namespace carom::cpu {

template <typename T> struct Convex;

/* Is the point, in the polygon's frame, strictly inside? */
template <typename T> using InsideTest = bool (*)(const Convex<T> &polygon, const Vec<T> &point);

template <typename T> struct Job;

/* Where some bodies are. */
template <typename T> struct Transforms {
	static constexpr int32_t many = 64;
	int32_t body[many];
	T x[many], y[many], angle[many];
};

/* What the step events asks of alternatives, as functions; null where an alternative has none. */
template <typename T> struct Pair;
template <typename T> struct HitTime;
template <typename T> struct Wall;
template <typename T> struct Collision;
template <typename T> struct Impulses;
template <typename T> struct SearchRules {
	T epsilon, iterations;
};
template <typename T> struct Functions {
	HitTime<T> (*pair_time)(const Pair<T> &pair, const SearchRules<T> &rules) = nullptr;
	HitTime<T> (*wall_time)(const Convex<T> &body, const Wall<T> &wall) = nullptr;
	Impulses<T> (*impulses)(const Collision<T> &collision) = nullptr;
};

/* Sets all but the bodies. */
template <typename T> using FindTransforms = void (*)(const Job<T> &job, Transforms<T> &transforms, int32_t count);

/* One run of a kernel. */
template <typename T> struct Job {
	const Texture *const *textures; /* those of the stage's definition */
	const int32_t *domain;
	Pool &pool;
	InsideTest<T> inside; /* of the chosen alternatives, these two */
	FindTransforms<T> find_transforms;
	const Functions<T> &functions;
	std::atomic<uint64_t> *reads; /* of texels; null where they are not counted */

	Texels<T> texels(int index) const { return Texels<T>(*textures[index]); }
	Bytes bytes(int index) const { return Bytes(*textures[index]); }
	int32_t *list(int index) const { return static_cast<int32_t *>(textures[index]->memory.get()); }
	/* Four numbers a record, side by side. */
	T *records(int index) const { return static_cast<T *>(textures[index]->memory.get()); }
};

/* Where the textures are that most kernels begin with. */
enum : int { FROM_LINEAR, FROM_ROTATIONAL, FROM_GEOMETRY, FROM_FORCES, FROM_UNIFORMS, STATE_COUNT };

template <typename T> using Run = void (*)(const Job<T> &job);

struct Kernel {
	carom_stage stage;
	Run<float> run;
	Run<double> run_double;
};

struct Stage {
	const char *slot, *name;
	Kernel kernels[8]; /* those without a function are none */
	InsideTest<float> inside;
	InsideTest<double> inside_double;
	FindTransforms<float> find_transforms = nullptr;
	FindTransforms<double> find_transforms_double = nullptr;
	Functions<float> functions = {};
	Functions<double> functions_double = {};
};

/* Sorted by slot and name; ends with a null pointer. */
extern const Stage *const stages[];

}

#endif
