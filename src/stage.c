#include "stage.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "device.h"
#include "status.h"
#include "step/step.h"

#define STATE ROLE_LINEAR, ROLE_ROTATIONAL, ROLE_GEOMETRY, ROLE_FORCES, ROLE_UNIFORMS
#define LISTS ROLE_SPANS, ROLE_NEIGHBOURS, ROLE_STATUS, ROLE_MEMBERS, ROLE_ACTIVE, ROLE_NODES, ROLE_EXTRA, ROLE_WAKE
#define RESTS ROLE_UNIFORMS, ROLE_CLOCK, ROLE_SLOTS, ROLE_STATUS, ROLE_CONTACTS, ROLE_TOUCHING, ROLE_GRIPS, ROLE_ISLANDS

const carom_stage_def carom_stages[STAGE_COUNT] = {
	[STAGE_AABB] = {"aabb", NULL, "aabb", 7, 1, {STATE, ROLE_VERTICES, ROLE_CLOCK, ROLE_AABB}},
	[STAGE_OVERLAP] = {"overlap", NULL, "overlap", 3, 2, {ROLE_AABB, ROLE_FILTERS, ROLE_TILES, ROLE_OVERLAP, ROLE_TILES}},
	[STAGE_TOI_FIRST] = {"toi", NULL, "toi_first", 10, 2,
		{STATE, ROLE_VERTICES, ROLE_CLOCK, ROLE_TILES, ROLE_OVERLAP, ROLE_OVERLAP_BEFORE, ROLE_HIT_TIMES, ROLE_TILE_HITS}},
	[STAGE_TOI_NEXT] = {"toi", NULL, "toi_next", 11, 2,
		{STATE, ROLE_VERTICES, ROLE_CLOCK, ROLE_TILES, ROLE_OVERLAP, ROLE_OVERLAP_BEFORE, ROLE_HIT_TIMES, ROLE_HIT_TIMES, ROLE_TILE_HITS}},
	[STAGE_WALLS] = {"walls", NULL, "walls", 7, 1, {STATE, ROLE_VERTICES, ROLE_CLOCK, ROLE_WALLS}},
	[STAGE_REDUCE] = {"reduce", NULL, "reduce", 1, 1, {ROLE_REDUCED, ROLE_REDUCED}},
	[STAGE_REDUCE_TILES] = {"reduce", NULL, "reduce_tiles", 1, 1, {ROLE_REDUCED, ROLE_REDUCED}},
	[STAGE_FIRST] = {"first", NULL, "first", 4, 1, {ROLE_REDUCED, ROLE_WALLS, ROLE_UNIFORMS, ROLE_CLOCK, ROLE_CLOCK}},
	[STAGE_IMPULSE] = {"impulse", NULL, "impulse", 8, 1, {STATE, ROLE_VERTICES, ROLE_CLOCK, ROLE_FRICTION, ROLE_IMPULSE}},
	[STAGE_NO_COLLISION] = {"forward", "no_collision", "forward_no_collision", 6, 2, {STATE, ROLE_CLOCK, ROLE_LINEAR, ROLE_ROTATIONAL}},
	[STAGE_COLLISION] = {"forward", "collision", "forward_collision", 7, 2, {STATE, ROLE_CLOCK, ROLE_IMPULSE, ROLE_LINEAR, ROLE_ROTATIONAL}},
	[STAGE_LOAD] = {"slots", NULL, "slots_load", 5, 3, {STATE, ROLE_SLOTS, ROLE_NEED, ROLE_PLACES}},
	[STAGE_CHANGE] = {"slots", NULL, "slots_change", 8, 1,
		{ROLE_UNIFORMS, ROLE_CHANGES, ROLE_PLACES, ROLE_SLOTS, ROLE_REACH, ROLE_STATUS, ROLE_WAKE, ROLE_MOVERS, ROLE_FORCES}},
	[STAGE_ADD] = {"slots", NULL, "slots_add", 13, 0,
		{ROLE_UNIFORMS, ROLE_CHANGES, ROLE_SLOTS, ROLE_NEED, ROLE_PLACES, ROLE_REACH, ROLE_STATUS, ROLE_WAKE, ROLE_MOVERS, ROLE_SPANS, ROLE_EXTRA,
			ROLE_OWNERS, ROLE_PARENTS}},
	[STAGE_REMOVE] = {"slots", NULL, "slots_remove", 10, 0,
		{ROLE_CHANGES, ROLE_SLOTS, ROLE_PLACES, ROLE_REACH, ROLE_STATUS, ROLE_WAKE, ROLE_MOVERS, ROLE_SPANS, ROLE_NEIGHBOURS, ROLE_EXTRA}},
	[STAGE_PUSH] = {"slots", NULL, "slots_push", 7, 0, {ROLE_UNIFORMS, ROLE_FORCES, ROLE_SLOTS, ROLE_REACH, ROLE_STATUS, ROLE_WAKE, ROLE_MOVERS}},
	[STAGE_DRIVE] = {"slots", NULL, "slots_drive", 5, 0, {ROLE_CHANGES, ROLE_PLACES, ROLE_JOINTS, ROLE_TOUCHING, ROLE_ISLANDS}},
	[STAGE_PICK] = {"slots", NULL, "slots_pick", 3, 0, {ROLE_PLACES, ROLE_SLOTS, ROLE_CHANGES}},
	[STAGE_PACE] = {"neighbours", NULL, "neighbours_pace", 3, 0, {ROLE_UNIFORMS, ROLE_SLOTS, ROLE_STATUS}},
	[STAGE_REACH] = {"neighbours", NULL, "neighbours_reach", 6, 0, {ROLE_OUTLINES, ROLE_SLOTS, ROLE_NEED, ROLE_STATUS, ROLE_SPANS, ROLE_CELLS}},
	[STAGE_CELLS] = {"neighbours", NULL, "neighbours_cells", 2, 0, {ROLE_STATUS, ROLE_CELLS}},
	[STAGE_SORT] = {"neighbours", NULL, "neighbours_sort", 6, 7,
		{ROLE_OUTLINES, ROLE_SLOTS, ROLE_NEED, ROLE_STATUS, ROLE_SPANS, ROLE_CELLS, ROLE_SLOTS, ROLE_NEED, ROLE_REACH, ROLE_MEMBERS, ROLE_OWNERS,
			ROLE_PARENTS, ROLE_PLACES}},
	[STAGE_NEAR] = {"neighbours", NULL, "neighbours_near", 10, 0,
		{ROLE_SLOTS, ROLE_FILTERS, ROLE_REACH, ROLE_STATUS, ROLE_CELLS, ROLE_SPANS, ROLE_NEIGHBOURS, ROLE_NODES, ROLE_MEMBERS, ROLE_EXTRA}},
	[STAGE_GATHER] = {"neighbours", NULL, "neighbours_gather", 5, 0, {ROLE_STATUS, ROLE_SPANS, ROLE_NEIGHBOURS, ROLE_NODES, ROLE_MEMBERS}},
	[STAGE_MEND] = {"neighbours", NULL, "neighbours_mend", 10, 0,
		{ROLE_SLOTS, ROLE_FILTERS, ROLE_REACH, ROLE_STATUS, ROLE_CELLS, ROLE_SPANS, ROLE_NEIGHBOURS, ROLE_MOVERS, ROLE_EXTRA, ROLE_WAKE}},
	[STAGE_SEEK] = {"events", NULL, "events_seek", 15, 0,
		{ROLE_OUTLINES, ROLE_UNIFORMS, ROLE_CLOCK, ROLE_SLOTS, LISTS, ROLE_OWNERS, ROLE_PARENTS, ROLE_TOUCHING}},
	[STAGE_RELEASE] = {"events", NULL, "events_release", 17, 0,
		{ROLE_OUTLINES, ROLE_UNIFORMS, ROLE_CLOCK, ROLE_SLOTS, LISTS, ROLE_WORK, ROLE_REACH, ROLE_NEED, ROLE_OWNERS, ROLE_PARENTS}},
	[STAGE_PAIR] = {"events", NULL, "events_pair", 15, 0,
		{ROLE_OUTLINES, ROLE_UNIFORMS, ROLE_CLOCK, ROLE_SLOTS, LISTS, ROLE_WORK, ROLE_OWNERS, ROLE_PARENTS}},
	[STAGE_MUSTER] = {"events", NULL, "events_muster", 15, 0,
		{ROLE_OUTLINES, ROLE_UNIFORMS, ROLE_CLOCK, ROLE_SLOTS, LISTS, ROLE_WORK, ROLE_OWNERS, ROLE_PARENTS}},
	[STAGE_RESOLVE] = {"events", NULL, "events_resolve", 22, 0,
		{ROLE_OUTLINES, ROLE_UNIFORMS, ROLE_CLOCK, ROLE_SLOTS, LISTS, ROLE_WORK, ROLE_REACH, ROLE_NEED, ROLE_FRICTION, ROLE_OWNERS, ROLE_PARENTS,
			ROLE_HITS, ROLE_SHOCKS, ROLE_TOUCHING, ROLE_CONTACTS}},
	[STAGE_CHECK] = {"events", NULL, "events_check", 15, 0,
		{ROLE_OUTLINES, ROLE_UNIFORMS, ROLE_CLOCK, ROLE_SLOTS, LISTS, ROLE_WORK, ROLE_OWNERS, ROLE_PARENTS}},
	[STAGE_SETTLE] = {"settle", NULL, "events_settle", 3, 1, {ROLE_UNIFORMS, ROLE_CLOCK, ROLE_STATUS, ROLE_CLOCK}},
	[STAGE_DRIFT] = {"drift", NULL, "drift", 14, 0,
		{ROLE_UNIFORMS, ROLE_CLOCK, ROLE_SLOTS, ROLE_REACH, ROLE_STATUS, ROLE_MEMBERS, ROLE_WORK, ROLE_OWNERS, ROLE_PARENTS, ROLE_SPANS, ROLE_WAKE,
			ROLE_MOVERS, ROLE_HITS, ROLE_FRICTION}},
	[STAGE_UNLOAD] = {"slots", NULL, "slots_unload", 2, 2, {ROLE_SLOTS, ROLE_PLACES, ROLE_LINEAR, ROLE_ROTATIONAL}},
	[STAGE_CONTACTS_BEGIN] = {"contacts", NULL, "contacts_begin", 3, 0, {ROLE_UNIFORMS, ROLE_CLOCK, ROLE_STATUS}},
	[STAGE_CONTACTS_FIND] = {"contacts", NULL, "contacts_find", 24, 0,
		{ROLE_OUTLINES, ROLE_UNIFORMS, ROLE_CLOCK, ROLE_SLOTS, LISTS, ROLE_CONTACTS, ROLE_TOUCHING, ROLE_OWNERS, ROLE_PARENTS, ROLE_PUSHES,
			ROLE_FRICTION, ROLE_GRIPS, ROLE_WARM_SPANS, ROLE_ISLANDS, ROLE_PLACES, ROLE_JOINTS, ROLE_JOINED}},
	[STAGE_CONTACTS_JOIN] = {"contacts", NULL, "contacts_join", 15, 0,
		{RESTS, ROLE_LOADS, ROLE_WARM, ROLE_WARM_SPANS, ROLE_PUSHES, ROLE_JOINTS, ROLE_JOINED, ROLE_PLACES}},
	[STAGE_CONTACTS_ITERATE] = {"contacts", NULL, "contacts_iterate", 12, 0, {RESTS, ROLE_LOADS, ROLE_PLACES, ROLE_JOINTS, ROLE_JOINED}},
	[STAGE_CONTACTS_APPLY] = {"contacts", NULL, "contacts_apply", 13, 0, {RESTS, ROLE_REACH, ROLE_WAKE, ROLE_MOVERS, ROLE_NEED, ROLE_PLACES}},
	[STAGE_CONTACTS_RELEASE] = {"contacts", NULL, "contacts_release", 17, 0,
		{RESTS, ROLE_PUSHES, ROLE_REACH, ROLE_WAKE, ROLE_MOVERS, ROLE_WARM, ROLE_WARM_SPANS, ROLE_PLACES, ROLE_JOINTS, ROLE_JOINED}},
	[STAGE_SLEEP_BEGIN] = {"sleep", NULL, "sleep_begin", 13, 0, {RESTS, ROLE_PUSHES, ROLE_REACH, ROLE_WAKE, ROLE_MOVERS, ROLE_PLACES}},
	[STAGE_SLEEP_END] = {"sleep", NULL, "sleep_end", 6, 0, {ROLE_CHANGES, ROLE_PLACES, ROLE_SLOTS, ROLE_STATUS, ROLE_TOUCHING, ROLE_ISLANDS}},
	[STAGE_VERTICES] = {"vertices", NULL, "vertices", 7, 1,
		{ROLE_STREAM, ROLE_LINEAR, ROLE_ROTATIONAL, ROLE_TRANSFORMS, ROLE_GEOMETRY, ROLE_VERTICES, ROLE_VIEW, ROLE_PLACED}},
	[STAGE_SHAPES] = {"shapes", NULL, "shapes", 4, 3, {ROLE_DRAWS, ROLE_MARKS, ROLE_PLACED, ROLE_VIEW, ROLE_BOXES, ROLE_SHAPES, ROLE_EDGES}},
	[STAGE_BIN_COUNT] = {"bins", NULL, "bin_count", 2, 1, {ROLE_BOXES, ROLE_FRAME, ROLE_BIN_COUNTS}},
	[STAGE_BIN_SUM] = {"bins", NULL, "bin_sum", 2, 2, {ROLE_BIN_COUNTS, ROLE_FRAME, ROLE_BIN_OFFSETS, ROLE_BIN_TOTALS}},
	[STAGE_BIN_ROWS] = {"bins", NULL, "bin_rows", 3, 2, {ROLE_BOXES, ROLE_FRAME, ROLE_BIN_TOTALS, ROLE_BIN_OFFSETS, ROLE_ROW_LIST}},
	[STAGE_BIN_TILES] = {"bins", NULL, "bin_tiles", 3, 2, {ROLE_FRAME, ROLE_BIN_TOTALS, ROLE_ROW_LIST, ROLE_TILE_ENDS, ROLE_TILE_LIST}},
	[STAGE_PIXELS] = {"pixels", NULL, "pixels", 6, 1,
		{ROLE_SHAPES, ROLE_EDGES, ROLE_FRAME, ROLE_TILE_ENDS, ROLE_TILE_LIST, ROLE_LIGHT, ROLE_PICTURE}},
};

const carom_slot carom_slots[] = {
	{"step", offsetof(carom_pipeline, step), "events", USED_ALL},
	{"aabb", offsetof(carom_pipeline, aabb), "tight", USED_FIRST_IMPACT},
	{"overlap", offsetof(carom_pipeline, overlap), "all_pairs", USED_FIRST_IMPACT},
	{"inside", offsetof(carom_pipeline, inside), "naive", USED_ALL},
	{"toi", offsetof(carom_pipeline, toi), "circle_quadratic", USED_ALL},
	{"walls", offsetof(carom_pipeline, walls), "half_planes", USED_ALL},
	{"reduce", offsetof(carom_pipeline, reduce), "tiled", USED_FIRST_IMPACT},
	{"first", SIZE_MAX, "earliest", USED_FIRST_IMPACT},
	{"impulse", offsetof(carom_pipeline, impulse), "pair_exact", USED_ALL},
	{"slots", SIZE_MAX, "records", USED_EVENTS},
	{"neighbours", SIZE_MAX, "grid", USED_EVENTS},
	{"contacts", SIZE_MAX, "nesterov", USED_CONTACTS},
	{"sleep", SIZE_MAX, "islands", USED_CONTACTS},
	{"events", SIZE_MAX, "clusters", USED_EVENTS},
	{"settle", SIZE_MAX, "clock", USED_EVENTS},
	{"drift", SIZE_MAX, "last_event", USED_EVENTS},
	{"forward", SIZE_MAX, NULL, USED_FIRST_IMPACT},
	{"transforms", offsetof(carom_pipeline, transforms), "index", USED_PICTURES},
	{"vertices", offsetof(carom_pipeline, vertices), "option3", USED_PICTURES},
	{"shapes", SIZE_MAX, "convex", USED_PICTURES},
	{"bins", SIZE_MAX, "tiles", USED_PICTURES},
	{"pixels", SIZE_MAX, "distance", USED_PICTURES},
};
const size_t carom_slot_count = sizeof carom_slots / sizeof *carom_slots;

bool carom_stage_runs_groups(carom_stage stage)
{
	return stage == STAGE_REMOVE || stage == STAGE_PACE || stage == STAGE_CELLS || stage == STAGE_MEND || stage == STAGE_RESOLVE
		|| (stage >= STAGE_BIN_COUNT && stage <= STAGE_BIN_TILES);
}

bool carom_stage_draws(carom_stage stage)
{
	return stage >= STAGE_VERTICES && stage <= STAGE_PIXELS;
}

static const carom_slot *slot_named(const char *name)
{
	for (size_t i = 0; i < carom_slot_count; i++)
		if (!strcmp(carom_slots[i].name, name))
			return &carom_slots[i];
	return NULL;
}

bool carom_slot_draws(const char *name)
{
	const carom_slot *slot = slot_named(name);
	return slot && slot->usage == USED_PICTURES;
}

/* The index-th alternative of a slot, whichever side has it; NULL past the last. */
static const char *alternative_at(const carom_slot *slot, size_t index)
{
	size_t known = 0;
	const char *name;
	if (!strcmp(slot->name, "step"))
		return index < carom_step_count ? carom_steps[index]->name : NULL;
	for (; (name = carom_cl_alternative(slot->name, known)); known++)
		if (known == index)
			return name;
	for (size_t i = 0; (name = carom_cpu_alternative(slot->name, i)); i++)
		if (!carom_cl_has_alternative(slot->name, name) && known++ == index)
			return name;
	return NULL;
}

static const char *alternative_named(const carom_slot *slot, const char *wanted)
{
	const char *name;
	for (size_t i = 0; (name = alternative_at(slot, i)); i++)
		if (!strcmp(name, wanted))
			return name;
	return NULL;
}

/* Where the pipeline keeps a slot's choice; NULL where nothing is to choose. */
static const char **choice(carom_pipeline *pipeline, const carom_slot *slot)
{
	return slot->field == SIZE_MAX ? NULL : (const char **)(void *)((char *)pipeline + slot->field);
}

static void join(char *list, size_t size, const char *name)
{
	size_t used = strlen(list);
	snprintf(list + used, size - used, "%s%s", used ? ", " : "", name);
}

static carom_status unknown_slot(const char *name, carom_error *error)
{
	char list[256] = "";
	for (size_t i = 0; i < carom_slot_count; i++)
		if (carom_slots[i].field != SIZE_MAX)
			join(list, sizeof list, carom_slots[i].name);
	return carom_fail(error, CAROM_UNKNOWN_NAME, "there is no slot '%.64s' to choose for; the slots are %s", name, list);
}

static carom_status unknown_alternative(const carom_slot *slot, const char *wanted, carom_error *error)
{
	char list[256] = "";
	const char *name;
	for (size_t i = 0; (name = alternative_at(slot, i)); i++)
		join(list, sizeof list, name);
	return carom_fail(error, CAROM_UNKNOWN_NAME, "the slot '%s' has no alternative '%.64s'; it has %s", slot->name, wanted, list);
}

carom_status carom_pipeline_set(carom_pipeline *pipeline, const char *slot, const char *alternative, carom_error *error)
{
	GIVEN(pipeline, error);
	GIVEN(slot, error);
	GIVEN(alternative, error);
	const carom_slot *found = slot_named(slot);
	if (!found || found->field == SIZE_MAX)
		return unknown_slot(slot, error);
	const char *known = alternative_named(found, alternative);
	if (!known)
		return unknown_alternative(found, alternative, error);
	*choice(pipeline, found) = known;
	return CAROM_OK;
}

const char *carom_pipeline_get(const carom_pipeline *pipeline, const char *name)
{
	const carom_slot *slot = name ? slot_named(name) : NULL;
	carom_pipeline copy;
	const char **chosen;
	if (!pipeline || !slot)
		return NULL;
	copy = *pipeline;
	chosen = choice(&copy, slot);
	return chosen && *chosen ? *chosen : slot->standard;
}

carom_status carom_pipeline_resolve(const carom_pipeline *pipeline, carom_pipeline *resolved, carom_error *error)
{
	carom_pipeline result = {0};
	for (size_t i = 0; i < carom_slot_count; i++) {
		carom_status status;
		if (carom_slots[i].field == SIZE_MAX)
			continue;
		status = carom_pipeline_set(&result, carom_slots[i].name, carom_pipeline_get(pipeline, carom_slots[i].name), error);
		if (status)
			return status;
	}
	*resolved = result;
	return CAROM_OK;
}

bool carom_stage_list(size_t index, carom_stage_info *info)
{
	for (size_t i = 0; info && i < carom_slot_count; i++) {
		const carom_slot *slot = &carom_slots[i];
		bool is_step = !strcmp(slot->name, "step");
		const char *name;
		for (size_t k = 0; (name = alternative_at(slot, k)); k++) {
			if (index-- > 0)
				continue;
			info->slot = slot->name;
			info->alternative = name;
			info->is_default = !slot->standard || !strcmp(slot->standard, name);
			info->on_opencl = is_step || carom_cl_has_alternative(slot->name, name);
			info->on_cpu = is_step || carom_cpu_has_alternative(slot->name, name);
			return true;
		}
	}
	return false;
}
