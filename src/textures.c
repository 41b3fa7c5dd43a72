/* The textures of the state [2], and their way to the device and back. */
#include <stdlib.h>
#include <string.h>

#include "layout.h"
#include "status.h"
#include "world.h"

uint32_t carom_row_width(uint32_t items)
{
	return items < ROW_SIZE ? items : ROW_SIZE;
}

uint32_t carom_row_count(uint32_t items)
{
	return items < ROW_SIZE ? 1 : (items + ROW_SIZE - 1) >> ROW_LOG2;
}

uint32_t carom_capacity(size_t items)
{
	uint32_t capacity = TILE;
	while (capacity < items)
		capacity *= 2;
	return capacity;
}

static carom_texel_format format_of(carom_role role)
{
	if ((role >= ROLE_BIN_COUNTS && role <= ROLE_TILE_LIST) || (role >= ROLE_MEMBERS && role <= ROLE_STATUS) || role == ROLE_NEED
		|| role == ROLE_FILTERS || role == ROLE_TOUCHING || role == ROLE_ISLANDS || role == ROLE_WARM_SPANS || role == ROLE_JOINED)
		return TEXELS_LIST;
	if (role == ROLE_OUTLINES || role == ROLE_SLOTS || role == ROLE_CHANGES || role == ROLE_REACH || role == ROLE_WORK || role == ROLE_BOXES
		|| role == ROLE_SHAPES || role == ROLE_EDGES || role == ROLE_LIGHT || role == ROLE_CONTACTS || role == ROLE_GRIPS || role == ROLE_LOADS
		|| role == ROLE_PUSHES || role == ROLE_WARM || role == ROLE_JOINTS || role == ROLE_HITS || role == ROLE_SHOCKS)
		return TEXELS_RECORD;
	return role == ROLE_OVERLAP || role == ROLE_TILES || role == ROLE_PICTURE ? TEXELS_BYTE : TEXELS_FLOAT;
}

static const char *const names[ROLE_COUNT] = {
	[ROLE_LINEAR] = "Linear",
	[ROLE_ROTATIONAL] = "Rotational",
	[ROLE_GEOMETRY] = "Geometry",
	[ROLE_FORCES] = "Forces",
	[ROLE_FRICTION] = "Friction",
	[ROLE_FILTERS] = "Filters",
	[ROLE_VERTICES] = "Vertices",
	[ROLE_UNIFORMS] = "Uniforms",
	[ROLE_CLOCK] = "Clock",
	[ROLE_AABB] = "AABB",
	[ROLE_TILES] = "Tiles",
	[ROLE_OVERLAP] = "Overlap",
	[ROLE_OVERLAP_BEFORE] = "Overlap",
	[ROLE_HIT_TIMES] = "HitTimes",
	[ROLE_TILE_HITS] = "TileHits",
	[ROLE_WALLS] = "Walls",
	[ROLE_REDUCED] = "Reduced",
	[ROLE_IMPULSE] = "Impulse",
	[ROLE_OUTLINES] = "Outlines",
	[ROLE_SLOTS] = "Slots",
	[ROLE_NEED] = "Need",
	[ROLE_CHANGES] = "Changes",
	[ROLE_REACH] = "Reach",
	[ROLE_WORK] = "Work",
	[ROLE_MEMBERS] = "Members",
	[ROLE_PLACES] = "Places",
	[ROLE_OWNERS] = "Owners",
	[ROLE_PARENTS] = "Parents",
	[ROLE_ACTIVE] = "Active",
	[ROLE_SPANS] = "Spans",
	[ROLE_NEIGHBOURS] = "Neighbours",
	[ROLE_NODES] = "Nodes",
	[ROLE_EXTRA] = "Extra",
	[ROLE_MOVERS] = "Movers",
	[ROLE_WAKE] = "Wake",
	[ROLE_CELLS] = "Cells",
	[ROLE_STATUS] = "Status",
	[ROLE_HITS] = "Hits",
	[ROLE_CONTACTS] = "Contacts",
	[ROLE_GRIPS] = "Grips",
	[ROLE_TOUCHING] = "Touching",
	[ROLE_ISLANDS] = "Islands",
	[ROLE_SHOCKS] = "Shocks",
	[ROLE_LOADS] = "Loads",
	[ROLE_PUSHES] = "Pushes",
	[ROLE_WARM] = "Warm",
	[ROLE_WARM_SPANS] = "WarmSpans",
	[ROLE_JOINTS] = "Joints",
	[ROLE_JOINED] = "Joined",
	[ROLE_STREAM] = "Stream",
	[ROLE_TRANSFORMS] = "Transforms",
	[ROLE_VIEW] = "View",
	[ROLE_PLACED] = "Placed",
	[ROLE_DRAWS] = "Draws",
	[ROLE_MARKS] = "Marks",
	[ROLE_BOXES] = "Boxes",
	[ROLE_SHAPES] = "Shapes",
	[ROLE_EDGES] = "Edges",
	[ROLE_FRAME] = "Frame",
	[ROLE_BIN_COUNTS] = "BinCounts",
	[ROLE_BIN_OFFSETS] = "BinOffsets",
	[ROLE_BIN_TOTALS] = "BinTotals",
	[ROLE_ROW_LIST] = "RowList",
	[ROLE_TILE_ENDS] = "TileEnds",
	[ROLE_TILE_LIST] = "TileList",
	[ROLE_LIGHT] = "Light",
	[ROLE_PICTURE] = "Picture",
};

void carom_textures_drop(carom_world *world, carom_role role)
{
	carom_pair *pair = &world->textures[role];
	if (pair->back != pair->front)
		world->device->kind->destroy(world->device, pair->back);
	world->device->kind->destroy(world->device, pair->front);
	*pair = (carom_pair){NULL, NULL};
}

carom_status carom_textures_create(carom_world *world, carom_role role, bool pair, uint32_t width, uint32_t height, const float fill[4],
	carom_error *error)
{
	carom_pair *textures = &world->textures[role];
	carom_textures_drop(world, role);
	TRY(world->device->kind->create(world->device, names[role], format_of(role), width, height, fill, &textures->front, error));
	if (!pair)
		textures->back = textures->front;
	return pair ? world->device->kind->create(world->device, names[role], format_of(role), width, height, fill, &textures->back, error) : CAROM_OK;
}

carom_status carom_textures_wrap(carom_world *world, carom_role role, uint32_t width, uint32_t height, void *texels, carom_error *error)
{
	carom_pair *textures = &world->textures[role];
	carom_textures_drop(world, role);
	TRY(world->device->kind->wrap(world->device, names[role], width, height, texels, &textures->front, error));
	textures->back = textures->front;
	return CAROM_OK;
}

carom_status carom_levels_create(carom_world *world, int level, uint32_t size, const float fill[4], carom_error *error)
{
	carom_texture **texture = &world->levels[level];
	world->device->kind->destroy(world->device, *texture);
	*texture = NULL;
	return world->device->kind->create(world->device, names[ROLE_REDUCED], format_of(ROLE_REDUCED), size, size, fill, texture, error);
}

void carom_textures_destroy(carom_world *world)
{
	/* these two name textures of other roles, and own none */
	world->textures[ROLE_REDUCED] = world->textures[ROLE_OVERLAP_BEFORE] = (carom_pair){NULL, NULL};
	for (int role = 0; role < ROLE_COUNT; role++)
		carom_textures_drop(world, (carom_role)role);
	for (int i = 0; i < CAROM_MAX_LEVELS; i++) {
		world->device->kind->destroy(world->device, world->levels[i]);
		world->levels[i] = NULL;
	}
	world->capacity = world->vertex_capacity = world->polygon_capacity = world->filter_room = world->friction_room = 0;
	world->bodies_current = world->prepared = false;
	world->newest &= PLACE_HOST;
	world->canvas = (carom_canvas){0};
}

void carom_swap(carom_world *world, carom_role role)
{
	carom_pair *pair = &world->textures[role];
	carom_texture *front = pair->front;
	pair->front = pair->back;
	pair->back = front;
}

bool carom_is_gpu(const carom_world *world)
{
	return world->device->info.is_opencl && !world->device->info.is_cpu;
}

carom_status carom_run(carom_world *world, carom_stage stage, int32_t x, int32_t y, int32_t z, int32_t w, carom_error *error)
{
	const carom_stage_def *def = &carom_stages[stage];
	carom_texture *textures[CAROM_MAX_TEXTURES];
	const int32_t domain[4] = {x, y, z, w};
	for (int i = 0; i < def->input_count + def->output_count; i++) {
		const carom_pair *pair = &world->textures[def->textures[i]];
		textures[i] = i < def->input_count ? pair->front : pair->back;
	}
	return world->device->kind->run(world->device, stage, textures, domain, error);
}

/* Texels of Vertices: those of polygons, as the host has them, come first. */
uint32_t carom_polygon_texels(const carom_world *world)
{
	return (uint32_t)(world->vertices.used / (2 * sizeof(carom_vec2)));
}

/* The textures that every step has. */
static carom_status create_all(carom_world *world, uint32_t capacity, uint32_t vertex_capacity, carom_error *error)
{
	static const float zero[4] = {0};
	static const struct {
		carom_role role;
		bool pair;
	} a_body[] = {{ROLE_LINEAR, true}, {ROLE_ROTATIONAL, true}, {ROLE_GEOMETRY, false}, {ROLE_FORCES, false}};
	const bool pairs = world->step->pairs;
	carom_status status = CAROM_OK;
	for (size_t i = 0; !status && i < sizeof a_body / sizeof *a_body; i++)
		status = carom_textures_create(world, a_body[i].role, a_body[i].pair && pairs, carom_row_width(capacity), carom_row_count(capacity), zero,
			error);
	if (!status)
		status = carom_textures_create(world, ROLE_VERTICES, false, carom_row_width(vertex_capacity), carom_row_count(vertex_capacity), zero, error);
	if (!status)
		status = carom_textures_create(world, ROLE_UNIFORMS, false, UNIFORMS_WIDTH, 1, zero, error);
	if (!status)
		status = carom_textures_create(world, ROLE_CLOCK, true, CLOCK_WIDTH, 1, zero, error);
	return status;
}

uint64_t carom_textures_memory(size_t body_count, size_t vertex_count, bool pairs)
{
	const uint32_t capacity = carom_capacity(body_count);
	uint64_t texels = (uint64_t)capacity * (pairs ? 7 : 5) + carom_capacity((vertex_count + body_count) / 2);
	return 16 * (texels + UNIFORMS_WIDTH + 2 * CLOCK_WIDTH);
}

/* Moves the state between the host's arrays and the front textures, whole rows at a time. */
static carom_status transfer(carom_world *world, bool down, carom_error *error)
{
	const carom_role roles[2] = {ROLE_LINEAR, ROLE_ROTATIONAL};
	const carom_array *arrays[2] = {&world->linear, &world->rotational};
	uint32_t rows = carom_row_count((uint32_t)world->body_count), width = carom_row_width(world->capacity);
	size_t size = world->body_count * 4 * sizeof(float);
	carom_status status = CAROM_OK;
	float *texels;
	if (!size)
		return CAROM_OK;
	texels = calloc((size_t)rows * width, 4 * sizeof *texels);
	if (!texels)
		return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory to move the state of %zu bodies", world->body_count);
	for (int i = 0; !status && i < 2; i++) {
		carom_texture *texture = world->textures[roles[i]].front;
		if (down) {
			status = world->device->kind->download(world->device, texture, rows, texels, error);
			if (!status)
				memcpy(arrays[i]->items, texels, size);
		} else {
			memcpy(texels, arrays[i]->items, size);
			status = world->device->kind->upload(world->device, texture, rows, texels, error);
		}
	}
	free(texels);
	return status;
}

/* The textures of the state, where the slots have a newer one. */
static carom_status unload(carom_world *world, carom_error *error)
{
	TRY(carom_changes_send(world, error));
	return world->newest & PLACE_SLOTS && !(world->newest & PLACE_TEXTURES) ? world->step->unload(world, error) : CAROM_OK;
}

typedef struct capacities {
	uint32_t bodies, vertices, polygons;
} capacities;

static capacities wanted(const carom_world *world, size_t body_count, size_t circle_count)
{
	const uint32_t polygons = carom_polygon_texels(world);
	return (capacities){carom_capacity(body_count), carom_capacity(polygons + circle_count), polygons ? carom_capacity(polygons) : 0};
}

/* Also if half of it would do: where bodies come and go there is no end of making textures else. */
static bool fits(uint32_t has, uint32_t wants)
{
	return has == wants || has == 2 * wants;
}

bool carom_textures_fit(const carom_world *world, size_t body_count, size_t circle_count)
{
	const capacities all = wanted(world, body_count, circle_count);
	return fits(world->capacity, all.bodies) && fits(world->vertex_capacity, all.vertices) && fits(world->polygon_capacity, all.polygons);
}

static carom_status create_anew(carom_world *world, carom_error *error)
{
	const capacities all = wanted(world, world->body_count, world->circle_count);
	carom_textures_destroy(world);
	const carom_status status = create_all(world, all.bodies, all.vertices, error);
	if (status) {
		carom_textures_destroy(world);
		return status;
	}
	world->capacity = all.bodies;
	world->vertex_capacity = all.vertices;
	world->polygon_capacity = all.polygons;
	return CAROM_OK;
}

static carom_status hold(carom_world *world, carom_error *error)
{
	if (!carom_textures_fit(world, world->body_count, world->circle_count))
		TRY(create_anew(world, error));
	if (!world->slots_current)
		world->newest &= ~(unsigned)PLACE_SLOTS;
	TRY(carom_textures_send(world, error));
	world->slots_current = true;
	if (!(world->newest & PLACE_TEXTURES))
		TRY(transfer(world, false, error));
	world->newest |= PLACE_TEXTURES;
	return CAROM_OK;
}

carom_status carom_textures_hold(carom_world *world, carom_error *error)
{
	carom_status status = unload(world, error);
	return status || (world->bodies_current && world->newest & PLACE_TEXTURES) ? status : hold(world, error);
}

bool carom_bodies_are_known(const carom_world *world)
{
	return world->newest & PLACE_SLOTS ? world->slots_current : world->newest & PLACE_TEXTURES && world->bodies_current;
}

void carom_load_anew(carom_world *world)
{
	world->bodies_current = world->slots_current = false;
}

carom_status carom_textures_update(carom_world *world, carom_error *error)
{
	carom_status status;
	if (world->prepared && carom_bodies_are_known(world))
		return carom_changes_send(world, error);
	status = carom_textures_hold(world, error);
	if (status || world->prepared)
		return status;
	status = carom_textures_fetch(world, error); /* or preparing, where it fails, would lose the state */
	if (!status)
		status = carom_contacts_fetch(world, error);
	if (status)
		return status;
	status = world->step->prepare(world, error);
	if (status)
		carom_textures_destroy(world);
	world->prepared = !status;
	return status;
}

carom_status carom_textures_fetch(carom_world *world, carom_error *error)
{
	carom_status status;
	if (world->newest & PLACE_HOST)
		return CAROM_OK;
	status = unload(world, error);
	if (!status)
		status = transfer(world, true, error);
	if (!status)
		world->newest |= PLACE_HOST;
	return status;
}
