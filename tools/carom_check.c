/* carom devices --check: the test suite in small, for a user's own device. A reference scene, which needs no file, is run by each step and drawn;
 * what comes out is compared with what came out everywhere else.
 * SPDX-License-Identifier: MIT */
#include "carom_check.h"

#include <inttypes.h>
#include <string.h>

/* Bodies of all kinds in a crowded room, with gravity, static and kinematic ones, ones that lose energy, and ones that pass through each other. */
enum { SIDE = 7, BODIES = SIDE * SIDE, STEERED = 23, RETURNS = 9, GOES = 30, WIDTH = 160, HEIGHT = 120 };

/* A plank on two posts, with boxes on it: it touches many, and all fall asleep. Then a ball falls on them. */
enum { BOXES = 16, PLANK = BOXES, BALL, POSTS, LYING = POSTS + 2 };

/* What a reference has. */
enum trait {
	RESTS = 1, /* all lose energy, and fall faster */
	LIES = 2,  /* it is the plank, else the crowd, */
	HOLDS = 4, /* of which many are joined, */
	DENTS = 8, /* or not convex */
};

/* What comes out, the same on every device that is exact. Numbers that change mean that results changed: tests/test_hashes.c guards the same. */
struct outcome {
	uint64_t state, hits, picture;
};

static const struct reference {
	const char *step, *what;
	uint64_t steps;
	unsigned traits; /* bits of enum trait */
	struct outcome expected;
} references[] = {
	{"events", "", 60, 0, {0xae6d85b586319664, 0x3000e89a16e84ce6, 0x2ba53121913d8b51}},
	{"contacts", "", 12, RESTS, {0x52cbb0c81598a876, 0xab2a6e8ec44b92d0, 0x2f8e0fa1e8603eb8}},
	{"contacts", " of many", 24, RESTS | LIES, {0xf6441dac8e82920f, 0x3bf936298a30ccd9, 0x9fcc07a637e06dbd}},
	{"contacts", " and joints", 12, RESTS | HOLDS, {0xeb13bf7849def3ae, 0xb996bb94cbbafce3, 0xd0120305fcdb5e23}},
	{"events", " and dents", 60, DENTS, {0x0ea0e2b479f0343f, 0x46a5376a7dd5ef02, 0xb84aa6f1d713135f}},
	{"contacts", " and dents", 12, RESTS | DENTS, {0xec2c3f78db8b366f, 0xbc97113912ea11aa, 0x93d511af33bcba35}},
	{"first_impact", "", 60, 0, {0xe443f056f109fad9, 0x7628f5ddae755cc8, 0x5be3f6b36ea95729}},
};

static const carom_vec2 kite[4] = {{0.375f, 0}, {0, 0.25f}, {-0.25f, 0}, {0, -0.25f}};

static const carom_vec2 cup[8] = {{-0.375f, -0.25f}, {0.375f, -0.25f}, {0.3125f, 0.3125f}, {0.1875f, 0.3125f}, {0.1875f, -0.0625f},
	{-0.125f, -0.125f}, {-0.25f, 0.25f}, {-0.375f, 0.25f}};
static const carom_vec2 star[8] = {
	{0.4375f, 0}, {0.125f, 0.125f}, {0, 0.4375f}, {-0.125f, 0.125f}, {-0.4375f, 0}, {-0.125f, -0.125f}, {0, -0.4375f}, {0.125f, -0.125f}};

/* Whole numbers and sums of powers of two, so that the scene is the same everywhere. */
static carom_body_def reference_body(int k, unsigned traits)
{
	carom_body_def body = carom_default_body_def();
	const int turn = (k * 37 + 11) % 64, shape = (k * 5) % 8;
	body.shape = shape < 3 ? CAROM_CIRCLE : shape < 6 ? CAROM_REGULAR : CAROM_POLYGON;
	body.radius = 0.25f + (float)(turn % 8) / 64;
	body.sides = (uint32_t)(3 + turn % 5);
	body.vertices = kite;
	body.vertex_count = 4;
	if (traits & DENTS && shape >= 3) {
		body.shape = CAROM_POLYGON;
		body.vertices = shape % 2 ? cup : star;
		body.vertex_count = 8;
	}
	body.position = (carom_vec2){(float)(k % SIDE - SIDE / 2), (float)(k / SIDE - SIDE / 2)};
	body.angle = (float)turn / 16;
	body.restitution = traits & RESTS ? 0 : k % 5 ? 1 : 0.5f;
	body.friction = (float)(k % 4) / 8;
	body.categories = k % 6 == 1 ? 2 : k % 6 == 2 ? 0x80000000 : CAROM_CATEGORIES;
	body.mask = k % 6 == 2 ? CAROM_MASK & ~2u : CAROM_MASK;
	body.is_static = k % 11 == 5;
	body.is_kinematic = k % 22 == 8;
	if (!body.is_static) {
		body.velocity = (carom_vec2){(float)((k * 29) % 64 - 32) / 8, (float)((k * 53) % 64 - 32) / 8};
		body.angular_velocity = (float)((k * 13) % 32 - 16) / 4;
		body.density = 1 + (float)(k % 3);
	}
	return body;
}

/* Each on another, without a gap. */
static carom_body_def lying_body(int k)
{
	static const carom_vec2 plank[4] = {{-3, -0.125f}, {3, -0.125f}, {3, 0.125f}, {-3, 0.125f}},
							post[4] = {{-0.25f, -0.9375f}, {0.25f, -0.9375f}, {0.25f, 0.9375f}, {-0.25f, 0.9375f}},
							box[4] = {{-0.125f, -0.125f}, {0.125f, -0.125f}, {0.125f, 0.125f}, {-0.125f, 0.125f}};
	carom_body_def body = carom_default_body_def();
	body.shape = k == BALL ? CAROM_CIRCLE : CAROM_POLYGON;
	body.radius = 0.25f;
	body.vertices = k < PLANK ? box : k == PLANK ? plank : post;
	body.vertex_count = 4;
	body.is_static = k >= POSTS;
	body.position = k < PLANK ? (carom_vec2){(float)(2 * k - BOXES + 1) * 0.1875f, -1.75f}
		: k == PLANK          ? (carom_vec2){0, -2}
		: k == BALL           ? (carom_vec2){0.5f, -0.5f}
							  : (carom_vec2){k == POSTS ? -2.5f : 2.5f, -3.0625f};
	body.friction = 0.5f;
	return body;
}

/* What only some kinds have. */
static void drive(carom_joint *joint, int k)
{
	if (joint->kind == CAROM_SPRING) {
		joint->stiffness = k % 20 == 6 ? 8 : 4096;
		joint->damping = 0.25f;
	}
	if (joint->kind == CAROM_REVOLUTE || joint->kind == CAROM_SLIDER) {
		joint->motor_speed = 3;
		joint->motor_torque = k % 3 ? 0.5f : 0;
		joint->has_stops = k % 4 > 0;
		joint->lower_angle = k % 8 == 2 ? -0.75f : 0;
		joint->upper_angle = k % 8 == 2 ? 1.25f : 0;
	}
	if (joint->kind == CAROM_SLIDER)
		joint->axis = 0.75f;
}

/* Joints of all kinds in the crowd, from every other body to the next one. */
static carom_status join(carom_world *world, const carom_body_def *bodies, carom_error *error)
{
	carom_joint joints[BODIES];
	size_t count = 0;
	for (int k = 0; k + 1 < BODIES; k += 2) {
		if ((bodies[k].is_static || bodies[k].is_kinematic) && (bodies[k + 1].is_static || bodies[k + 1].is_kinematic))
			continue;
		joints[count] = carom_default_joint();
		joints[count].kind = (carom_joint_kind)(k / 2 % 5);
		joints[count].body = (uint32_t)k;
		joints[count].other = k % 14 == 12 ? CAROM_GROUND : k + 1;
		joints[count].anchor = (carom_vec2){0.25f, 0};
		joints[count].other_anchor = k % 14 == 12 ? (carom_vec2){3, (float)(k % 8) / 2 - 2} : (carom_vec2){-0.25f, 0.125f};
		joints[count].length = 0.5f;
		joints[count].collides = k % 3 == 0;
		drive(&joints[count], k);
		count++;
	}
	return carom_world_set_joints(world, count, joints, error);
}

static carom_world_def reference_def(const carom_world_def *where, const struct reference *reference)
{
	carom_world_def def = *where;
	def.has_room = true;
	def.room_min = (carom_vec2){-4, -4};
	def.room_max = (carom_vec2){4, 4};
	def.gravity = (carom_vec2){reference->traits & LIES ? 0 : 0.5f, reference->traits & RESTS ? -16 : -2};
	def.restitution = reference->traits & RESTS ? 0 : 0.75f;
	def.friction = 0.25f;
	def.rolling_friction = 0.125f;
	def.linear_damping = reference->traits & RESTS ? 0.5f : 0;
	def.angular_damping = reference->traits & RESTS ? 0.25f : 0;
	def.keep_hits = true;
	return def;
}

static const uint64_t empty_hash = 0xcbf29ce484222325u; /* FNV-1a */

static uint64_t hash_byte(uint64_t hash, uint8_t byte)
{
	return (hash ^ byte) * 0x100000001b3u;
}

static uint64_t hash_of(const uint8_t *bytes, size_t size)
{
	uint64_t hash = empty_hash;
	for (size_t i = 0; i < size; i++)
		hash = hash_byte(hash, bytes[i]);
	return hash;
}

/* As the bytes of a little-endian number. */
static uint64_t hash_bits(uint64_t hash, uint64_t bits)
{
	for (int k = 0; k < 8; k++)
		hash = hash_byte(hash, (uint8_t)(bits >> 8 * k));
	return hash;
}

static uint64_t hash_pair(uint64_t hash, carom_vec2 pair)
{
	uint32_t x, y;
	memcpy(&x, &pair.x, sizeof x);
	memcpy(&y, &pair.y, sizeof y);
	return hash_bits(hash, (uint64_t)y << 32 | x);
}

static uint64_t hash_hits(uint64_t hash, const carom_world *world)
{
	carom_hit hit;
	for (size_t k = 0; carom_world_get_hits(world, k, 1, &hit, NULL) == CAROM_OK; k++) {
		uint64_t time;
		memcpy(&time, &hit.time, sizeof time);
		hash = hash_bits(hash_bits(hash, time), (uint64_t)(uint32_t)hit.other << 32 | hit.body);
		hash = hash_pair(hash_pair(hash_pair(hash, hit.point), hit.normal), hit.impulse);
	}
	return hash;
}

/* One goes another way, and the next is pushed. */
static carom_status steer(carom_world *world, carom_error *error)
{
	carom_body_state state;
	carom_status status = carom_world_get_states(world, STEERED, 1, &state, error);
	if (status)
		return status;
	state.velocity = (carom_vec2){-state.velocity.y, state.velocity.x};
	state.angular_velocity += 1;
	status = carom_world_set_states(world, STEERED, 1, &state, error);
	if (!status && carom_world_joint_count(world) > 0)
		status = carom_world_set_motor(world, 0, -4, 1, error);
	return status ? status : carom_world_set_force(world, STEERED + 1, (carom_vec2){2, -1}, 0.5f, error);
}

/* Two go, and one of them comes back, behind the others. */
static carom_status change_roster(carom_world *world, unsigned traits, carom_error *error)
{
	const uint32_t gone[] = {RETURNS, GOES};
	carom_body_def body = reference_body(RETURNS, traits);
	carom_body_state state;
	carom_status status = carom_world_get_states(world, RETURNS, 1, &state, error);
	if (!status)
		status = carom_world_remove(world, gone, sizeof gone / sizeof *gone, error);
	if (status)
		return status;
	body.position = state.position;
	body.angle = state.angle;
	body.velocity = state.velocity;
	body.angular_velocity = state.angular_velocity;
	return carom_world_add(world, &body, 1, NULL, error);
}

/* Half of it, then the other half; between them bodies of the crowd are steered, go and come. */
static carom_status run_halves(carom_world *world, const struct reference *reference, uint64_t *hits, carom_error *error)
{
	const uint64_t steps = reference->steps;
	carom_status status = carom_world_step(world, steps / 2, NULL, error);
	*hits = hash_hits(empty_hash, world);
	if (!status && !(reference->traits & LIES))
		status = steer(world, error);
	if (!status && !(reference->traits & LIES))
		status = change_roster(world, reference->traits, error);
	if (!status)
		status = carom_world_step(world, steps - steps / 2, NULL, error);
	*hits = hash_hits(*hits, world);
	return status;
}

static carom_status run_reference(carom_world *world, const struct reference *reference, struct outcome *found, carom_error *error)
{
	static uint8_t pixels[4 * WIDTH * HEIGHT];
	carom_body_def bodies[BODIES];
	const int count = reference->traits & LIES ? LYING : BODIES;
	carom_render_def def = carom_default_render_def();
	carom_status status;
	for (int k = 0; k < count; k++)
		bodies[k] = reference->traits & LIES ? lying_body(k) : reference_body(k, reference->traits);
	def.width = WIDTH;
	def.height = HEIGHT;
	status = carom_world_add(world, bodies, (size_t)count, NULL, error);
	if (!status && reference->traits & HOLDS)
		status = join(world, bodies, error);
	if (!status)
		status = run_halves(world, reference, &found->hits, error);
	if (!status)
		status = carom_world_hash(world, &found->state, error);
	if (!status)
		status = carom_world_render(world, &def, pixels, error);
	found->picture = hash_of(pixels, sizeof pixels);
	return status;
}

static bool is_right(const struct reference *reference, const char *storage, const char *what, uint64_t found, uint64_t expected)
{
	printf("    %s%s%s%s: %016" PRIx64, reference->step, reference->what, storage, what, found);
	if (found == expected)
		printf(", right\n");
	else
		printf(", WRONG: %016" PRIx64 " is right\n", expected);
	return found == expected;
}

/* One step on one storage; a failure of the device is told, and is as wrong as a wrong hash. */
static bool check_reference(const carom_world_def *where, const struct reference *reference, const char *storage)
{
	carom_world_def def = reference_def(where, reference);
	carom_world *world = NULL;
	carom_error error;
	struct outcome found = {0};
	const struct outcome *expected = &reference->expected;
	bool right = false;
	def.pipeline.step = reference->step;
	if (carom_world_create(&def, &world, &error) || run_reference(world, reference, &found, &error)) {
		printf("    %s%s%s: FAILED\n", reference->step, reference->what, storage);
		fflush(stdout);
		report(&error);
	} else {
		right = is_right(reference, storage, "", found.state, expected->state);
		right = is_right(reference, storage, ", its hits", found.hits, expected->hits) && right;
		right = is_right(reference, storage, ", drawn", found.picture, expected->picture) && right;
	}
	carom_world_destroy(world);
	return right;
}

static bool check_references(const carom_world_def *where, const char *storage)
{
	bool right = true;
	for (size_t i = 0; i < sizeof references / sizeof *references; i++)
		right = check_reference(where, &references[i], storage) && right;
	return right;
}

static bool check_storages(carom_world_def where, const carom_device_info *device)
{
	bool right = true;
	if (!device->is_opencl)
		return check_references(&where, "");
	if (where.storage != CAROM_STORAGE_BUFFER && device->has_images) {
		where.storage = CAROM_STORAGE_IMAGE;
		right = check_references(&where, " in images");
		where.storage = CAROM_STORAGE_AUTO;
	}
	if (where.storage != CAROM_STORAGE_IMAGE) {
		where.storage = CAROM_STORAGE_BUFFER;
		right = check_references(&where, " in buffers") && right;
	}
	return right;
}

/* Denormals are told, but no bodies are so small or so slow that it matters. */
static carom_status check_numbers(const carom_world_def *where, const carom_device_info *device, bool *right, carom_error *error)
{
	struct numbers_found found;
	carom_status status = find_numbers(where, &found, error);
	if (status)
		return status;
	printf("    quotients: %d of %d correctly rounded\n", found.quotients, found.count);
	if (device->is_opencl)
		printf("    square roots: %d of %d hits as on the CPU fallback\n", found.roots, found.hits);
	printf("    products and sums: %s\n", found.contracted ? "some are rounded once (contraction)" : "each is rounded");
	printf("    denormals: %s\n", found.denormals ? "kept" : "made 0");
	*right = found.quotients == found.count && found.roots == found.hits && !found.contracted;
	return CAROM_OK;
}

int check_device(const struct common_options *options, void (*print_device)(const carom_device_info *device))
{
	carom_world_def where = carom_default_world_def();
	carom_world *world = NULL;
	carom_device_info device;
	carom_error error;
	bool right;
	carom_status status = options->set_count ? wrong(&error, "--set: a check runs the default pipeline") : apply_options(options, &where, &error);
	if (!status)
		status = carom_world_create(&where, &world, &error);
	if (!status)
		status = carom_world_get_device(world, &device, &error);
	carom_world_destroy(world);
	if (status)
		return report(&error);
	print_device(&device);
	fflush(stdout);
	status = check_numbers(&where, &device, &right, &error);
	if (status)
		return report(&error);
	right = check_storages(where, &device) && right;
	printf("%s\n", right ? "right: the bits that every exact device gives" : "WRONG: results of this device can't be trusted to the last bit");
	return finish_output() == EXIT_DONE && right ? EXIT_DONE : EXIT_FAILED;
}
