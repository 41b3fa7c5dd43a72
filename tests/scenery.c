#include "scenery.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

const scenery_device scenery_devices[] = {
	{"cpu", CAROM_STORAGE_AUTO},
	{"opencl", CAROM_STORAGE_IMAGE},
	{"opencl", CAROM_STORAGE_BUFFER},
};
const size_t scenery_device_count = sizeof scenery_devices / sizeof *scenery_devices;

carom_world_def scenery_first_impact(void)
{
	carom_world_def def = carom_default_world_def();
	def.pipeline.step = "first_impact";
	return def;
}

static carom_world *kept[8]; /* without bodies */

/* Tests make worlds on several threads, too. */
static void keep_kernels(const carom_world_def *def)
{
	static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
	static size_t count;
	pthread_mutex_lock(&lock);
	carom_world **place = &kept[count % (sizeof kept / sizeof *kept)];
	if (count++ == 0)
		atexit(scenery_forget_kernels);
	carom_world_destroy(*place);
	*place = NULL;
	carom_world_create(def, place, NULL);
	pthread_mutex_unlock(&lock);
}

void scenery_forget_kernels(void)
{
	for (size_t i = 0; i < sizeof kept / sizeof *kept; i++) {
		carom_world_destroy(kept[i]);
		kept[i] = NULL;
	}
}

carom_world *scenery_world(const carom_world_def *def, const scenery_device *device)
{
	carom_world_def on_device = *def;
	carom_world *world = NULL;
	carom_error error = {0};
	carom_status status;
	on_device.device = device->name;
	on_device.storage = device->storage;
	status = carom_world_create(&on_device, &world, &error);
	if (status == CAROM_UNKNOWN_NAME && !getenv("CAROM_NO_SKIP")) {
		print_message("SKIPPED on %s: %s\n", device->name, error.text);
		return NULL;
	}
	scenery_check(status, &error);
	if (strcmp(device->name, "cpu") != 0)
		keep_kernels(&on_device);
	return world;
}

void scenery_check(carom_status status, const carom_error *error)
{
	if (status)
		fail_msg("%s: %s\n%s", carom_status_name(status), error->text, error->build_log);
}

float scenery_uniform(scenery_random *random, float low, float high)
{
	uint64_t z = random->state += 0x9E3779B97F4A7C15u; /* splitmix64 */
	z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
	z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
	return low + (high - low) * (float)((double)((z ^ (z >> 31)) >> 40) / 16777216.0);
}

/* Convex by construction: points at growing angles on an ellipse, cut short of where a turn could be lost. */
static const carom_vec2 irregular[5] = {{0.35f, -0.1f}, {0.2f, 0.25f}, {-0.1f, 0.33f}, {-0.36f, 0.02f}, {-0.05f, -0.3f}};

static carom_body_def body_of(scenery_random *random, scenery_shapes shapes)
{
	carom_body_def def = carom_default_body_def();
	float choice = shapes == SCENERY_CIRCLES ? 0.0f : scenery_uniform(random, shapes == SCENERY_POLYGONS ? 0.4f : 0.0f, 1.0f);
	def.radius = scenery_uniform(random, 0.3f, 0.5f);
	if (choice < 0.4f) {
		def.shape = CAROM_CIRCLE;
	} else if (choice < 0.85f) {
		def.shape = CAROM_REGULAR;
		def.sides = (uint32_t)scenery_uniform(random, 3.0f, 9.0f);
	} else {
		def.shape = CAROM_POLYGON;
		def.vertices = irregular;
		def.vertex_count = 5;
	}
	return def;
}

void scenery_bodies(scenery_random *random, scenery_shapes shapes, size_t count, float pitch, float speed, carom_body_def *defs)
{
	size_t side = 1;
	while (side * side < count)
		side++;
	for (size_t i = 0; i < count; i++) {
		carom_body_def def = body_of(random, shapes);
		float x = (float)(i % side) - 0.5f * (float)(side - 1), y = (float)(i / side) - 0.5f * (float)(side - 1);
		def.position = (carom_vec2){
			x * pitch + scenery_uniform(random, -0.1f, 0.1f) * pitch, y * pitch + scenery_uniform(random, -0.1f, 0.1f) * pitch};
		def.angle = scenery_uniform(random, -3.0f, 3.0f);
		def.is_static = scenery_uniform(random, 0.0f, 1.0f) < 0.1f;
		if (!def.is_static) {
			def.velocity = (carom_vec2){scenery_uniform(random, -speed, speed), scenery_uniform(random, -speed, speed)};
			def.angular_velocity = shapes == SCENERY_CIRCLES ? 0.0f : scenery_uniform(random, -speed, speed);
			def.density = scenery_uniform(random, 0.5f, 2.0f);
		}
		defs[i] = def;
	}
	for (size_t i = count; i > 1; i--) {
		size_t k = (size_t)scenery_uniform(random, 0.0f, (float)i);
		carom_body_def def = defs[i - 1];
		defs[i - 1] = defs[k];
		defs[k] = def;
	}
}

void scenery_drive(scenery_random *random, size_t count, float speed, carom_body_def *defs)
{
	for (size_t i = 0; i < count; i++) {
		if (!defs[i].is_static || scenery_uniform(random, 0.0f, 1.0f) < 0.3f)
			continue;
		defs[i].is_static = false;
		defs[i].is_kinematic = true;
		defs[i].velocity = (carom_vec2){scenery_uniform(random, -speed, speed), scenery_uniform(random, -speed, speed)};
		defs[i].angular_velocity = defs[i].shape == CAROM_CIRCLE ? 0.0f : scenery_uniform(random, -speed, speed);
	}
}

void scenery_filter(scenery_random *random, carom_body_def *def)
{
	static const uint32_t bits[3] = {1u, 1u << 15, 1u << 31};
	const int first = (int)scenery_uniform(random, 0.0f, 3.0f), second = (int)scenery_uniform(random, 0.0f, 3.0f);
	def->categories = bits[first] | bits[second];
	for (int k = 0; k < 3; k++)
		if (scenery_uniform(random, 0.0f, 1.0f) < 0.3f)
			def->mask &= ~bits[k];
}

uint64_t scenery_hash(const uint8_t *bytes, size_t size)
{
	uint64_t hash = 14695981039346656037u;
	for (size_t k = 0; k < size; k++)
		hash = (hash ^ bytes[k]) * 1099511628211u;
	return hash;
}

carom_body_def scenery_circle(float x, float y, float vx, float vy, float radius)
{
	carom_body_def def = carom_default_body_def();
	def.shape = CAROM_CIRCLE;
	def.radius = radius;
	def.position = (carom_vec2){x, y};
	def.velocity = (carom_vec2){vx, vy};
	return def;
}

carom_body_def scenery_box(float x, float y, float vx, float vy, float width, float height)
{
	static carom_vec2 corners[32][4]; /* the library copies them at carom_world_add, before so many more are made */
	static int next;
	carom_vec2 *c = corners[next++ % 32];
	carom_body_def def = carom_default_body_def();
	c[0] = (carom_vec2){-0.5f * width, -0.5f * height};
	c[1] = (carom_vec2){0.5f * width, -0.5f * height};
	c[2] = (carom_vec2){0.5f * width, 0.5f * height};
	c[3] = (carom_vec2){-0.5f * width, 0.5f * height};
	def.shape = CAROM_POLYGON;
	def.vertices = c;
	def.vertex_count = 4;
	def.position = (carom_vec2){x, y};
	def.velocity = (carom_vec2){vx, vy};
	return def;
}

carom_world *scenery_crowd(const scenery_device *device, uint64_t seed, uint32_t threads)
{
	carom_world_def def = carom_default_world_def();
	carom_body_def bodies[SCENERY_CROWD];
	scenery_random random = {seed};
	carom_error error;
	def.has_room = true;
	def.room_min = (carom_vec2){-5.0f, -5.0f};
	def.room_max = (carom_vec2){5.0f, 5.0f};
	def.gravity = (carom_vec2){0.5f, -1.0f};
	def.threads = threads;
	scenery_bodies(&random, SCENERY_MIXED, SCENERY_CROWD, 1.25f, 3.0f, bodies);
	carom_world *world = scenery_world(&def, device);
	if (world)
		scenery_check(carom_world_add(world, bodies, SCENERY_CROWD, NULL, &error), &error);
	return world;
}
