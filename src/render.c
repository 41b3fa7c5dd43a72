/* Pictures of worlds: what is to be seen, and from where. The device draws it.
 * SPDX-License-Identifier: MIT */
#include "angle.h"
#include "canvas.h"
#include "layout.h"
#include "palette.h"
#include "status.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MAX_SIDE 16384
#define FIT_MARGIN 1.06    /* the height that a default camera shows for each metre it must show */
#define EMPTY_HEIGHT 10.0  /* m, of the picture of a world with nothing in it */
#define THINNEST_LINE 1.25 /* pixels */
#define LINES_IN_SIDE 600  /* how many thin lines are as broad as the picture's shorter side, unless they were too thin */
#define PANEL_HEIGHT 0.4   /* of the picture's: the enlarged detail */
#define PANEL_WIDTH 0.45   /* of the picture's at most */
#define PANEL_MARGIN 0.025 /* of the picture's height */

typedef struct bounds {
	double min_x, min_y, max_x, max_y; /* m */
} bounds;

carom_render_def carom_default_render_def(void)
{
	return (carom_render_def){.width = 1280, .height = 720};
}

/* ---- Arguments ------------------------------------------------------------------------------------------------ */

static bool is_finite_point(carom_vec2 v)
{
	return isfinite(v.x) && isfinite(v.y);
}

static carom_status check_camera(const carom_camera *camera, carom_error *error)
{
	if (!is_finite_point(camera->center))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "camera.center is (%g, %g): both must be finite", (double)camera->center.x,
			(double)camera->center.y);
	if (!(camera->height > 0) || !isfinite(camera->height))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "camera.height is %g: it must be above 0 and finite", (double)camera->height);
	return CAROM_OK;
}

static carom_status check_inset(const carom_inset *inset, carom_error *error)
{
	if (!is_finite_point(inset->min))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "inset.min is (%g, %g): both must be finite", (double)inset->min.x, (double)inset->min.y);
	if (!(inset->size.x > 0 && inset->size.y > 0) || !is_finite_point(inset->size))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "inset.size is (%g, %g): both must be above 0 and finite", (double)inset->size.x,
			(double)inset->size.y);
	return CAROM_OK;
}

static carom_status check_arguments(const carom_world *world, const carom_render_def *def, carom_error *error)
{
	GIVEN(world, error);
	GIVEN(def, error);
	if (def->width < 1 || def->width > MAX_SIDE || def->height < 1 || def->height > MAX_SIDE)
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "the picture is %u x %u pixels: both must be 1 to %d", (unsigned)def->width,
			(unsigned)def->height, MAX_SIDE);
	carom_status status = def->has_camera ? check_camera(&def->camera, error) : CAROM_OK;
	if (status == CAROM_OK && def->has_inset)
		status = check_inset(&def->inset, error);
	return status;
}

/* ---- Marks ---------------------------------------------------------------------------------------------------- */

static int32_t whole(double position) /* NaN becomes the least */
{
	return position > -FARTHEST ? (int32_t)(position < FARTHEST ? position : FARTHEST) : -FARTHEST;
}

/* The nearest pixel border; any value, not only those of an int. */
static int32_t nearest_pixel(double position)
{
	return whole(floor(position + 0.5));
}

static int32_t within(int32_t value, int32_t low, int32_t high)
{
	return value < low ? low : value > high ? high : value;
}

static carom_pixels clipped(carom_pixels box, carom_pixels clip)
{
	return (carom_pixels){
		within(box.x0, clip.x0, clip.x1), within(box.y0, clip.y0, clip.y1), within(box.x1, clip.x0, clip.x1), within(box.y1, clip.y0, clip.y1)};
}

static void draw_box(carom_layer *layer, carom_pixels clip, carom_pixels box, uint32_t color)
{
	carom_pixels seen = clipped(box, clip);
	if (seen.x0 < seen.x1 && seen.y0 < seen.y1)
		layer->marks[layer->mark_count++] = (carom_mark){seen.x0, seen.y0, seen.x1, seen.y1, 0, color};
}

/* Four bands of whole pixels around `box`. */
static void draw_frame(carom_layer *layer, carom_pixels clip, carom_pixels box, int32_t breadth, uint32_t color)
{
	carom_pixels out = {box.x0 - breadth, box.y0 - breadth, box.x1 + breadth, box.y1 + breadth};
	draw_box(layer, clip, (carom_pixels){out.x0, out.y0, out.x1, box.y0}, color);
	draw_box(layer, clip, (carom_pixels){out.x0, box.y1, out.x1, out.y1}, color);
	draw_box(layer, clip, (carom_pixels){out.x0, box.y0, box.x0, box.y1}, color);
	draw_box(layer, clip, (carom_pixels){box.x1, box.y0, out.x1, box.y1}, color);
}

/* Whole pixels, so that the box is crisp. */
static carom_pixels box_of(const carom_layer *view, const bounds *b)
{
	return (carom_pixels){nearest_pixel((b->min_x - view->left) * view->scale), nearest_pixel((view->top - b->max_y) * view->scale),
		nearest_pixel((b->max_x - view->left) * view->scale), nearest_pixel((view->top - b->min_y) * view->scale)};
}

static bounds room_of(const carom_world_def *def)
{
	return (bounds){(double)def->room_min.x, (double)def->room_min.y, (double)def->room_max.x, (double)def->room_max.y};
}

static uint32_t ground_of(const carom_world_def *def)
{
	return def->has_room ? CAROM_COLOR_SURROUND : CAROM_COLOR_GROUND;
}

static void draw_room(carom_layer *layer, const carom_world_def *def)
{
	if (!def->has_room)
		return;
	bounds room = room_of(def);
	carom_pixels inside = box_of(layer, &room);
	draw_frame(layer, layer->clip, inside, nearest_pixel(1.5 * layer->line), CAROM_COLOR_FRAME);
	draw_box(layer, layer->clip, inside, CAROM_COLOR_GROUND);
}

/* ---- Camera --------------------------------------------------------------------------------------------------- */

static void include(bounds *b, double x, double y, double radius)
{
	b->min_x = x - radius < b->min_x ? x - radius : b->min_x;
	b->min_y = y - radius < b->min_y ? y - radius : b->min_y;
	b->max_x = x + radius > b->max_x ? x + radius : b->max_x;
	b->max_y = y + radius > b->max_y ? y + radius : b->max_y;
}

/* The body's vertices, where they are. */
static void include_polygon(bounds *b, const carom_body_info *body, const carom_body_state *state)
{
	double sine, cosine;
	carom_sincos((double)state->angle, &sine, &cosine);
	for (uint32_t k = 0; k < body->vertex_count; k++) {
		double x = (double)body->vertices[k].x, y = (double)body->vertices[k].y;
		include(b, (double)state->position.x + (cosine * x - sine * y), (double)state->position.y + (sine * x + cosine * y), 0);
	}
}

static carom_status include_body(bounds *b, carom_world *world, uint32_t index, const carom_body_state *state, carom_error *error)
{
	carom_body_info body;
	carom_status status = carom_world_get_body(world, index, &body, error);
	if (status != CAROM_OK || !is_finite_point(state->position) || !isfinite(state->angle))
		return status;
	if (body.vertices)
		include_polygon(b, &body, state);
	else
		include(b, (double)state->position.x, (double)state->position.y, (double)body.radius);
	return CAROM_OK;
}

/* The place in the world that it holds a body at, if that is one. */
static carom_status include_joint(bounds *b, carom_world *world, size_t index, carom_error *error)
{
	carom_joint joint;
	TRY(carom_world_get_joints(world, index, 1, &joint, error));
	if (joint.other == CAROM_GROUND)
		include(b, (double)joint.other_anchor.x, (double)joint.other_anchor.y, 0);
	return CAROM_OK;
}

static carom_status bodies_of(carom_world *world, bounds *b, carom_error *error)
{
	size_t count = carom_world_body_count(world);
	carom_body_state *states = malloc((count + 1) * sizeof *states);
	if (!states)
		return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory for the states of %zu bodies", count);
	carom_status status = carom_world_get_states(world, 0, count, states, error);
	*b = (bounds){HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
	for (uint32_t k = 0; status == CAROM_OK && k < count; k++)
		status = include_body(b, world, k, &states[k], error);
	for (size_t k = 0; status == CAROM_OK && k < carom_world_joint_count(world); k++)
		status = include_joint(b, world, k, error);
	if (b->min_x > b->max_x)
		*b = (bounds){-EMPTY_HEIGHT / 2, -EMPTY_HEIGHT / 2, EMPTY_HEIGHT / 2, EMPTY_HEIGHT / 2};
	free(states);
	return status;
}

/* A view of `clip` that shows `height` metres about a point in its middle. */
static void look_at(carom_layer *view, double x, double y, double height, carom_pixels clip, double line)
{
	double scale = (clip.y1 - clip.y0) / height;
	view->left = x - (clip.x0 + clip.x1) / 2.0 / scale;
	view->top = y + (clip.y0 + clip.y1) / 2.0 / scale;
	view->scale = scale;
	view->line = line;
	view->clip = clip;
}

/* A camera in double precision: nothing is rounded where none is given. */
typedef struct sight {
	double x, y, height; /* m */
} sight;

static carom_status find_sight(carom_world *world, const carom_render_def *def, sight *found, carom_error *error)
{
	const carom_world_def *world_def = carom_world_get_def(world);
	const carom_camera *camera = &def->camera;
	if (def->has_camera) {
		*found = (sight){(double)camera->center.x, (double)camera->center.y, (double)camera->height};
		return CAROM_OK;
	}
	bounds b = room_of(world_def);
	if (!world_def->has_room)
		TRY(bodies_of(world, &b, error));
	double wide = (b.max_x - b.min_x) * def->height / def->width, high = b.max_y - b.min_y;
	double height = FIT_MARGIN * (wide > high ? wide : high);
	/* A body so far out that its size is lost in its position has none here. */
	*found = (sight){(b.min_x + b.max_x) / 2, (b.min_y + b.max_y) / 2, height > 0 ? height : EMPTY_HEIGHT};
	return CAROM_OK;
}

carom_status carom_world_fit_camera(carom_world *world, const carom_render_def *def, carom_camera *camera, carom_error *error)
{
	sight found = {0};
	GIVEN(camera, error);
	TRY(check_arguments(world, def, error));
	TRY(find_sight(world, def, &found, error));
	*camera = (carom_camera){{(float)found.x, (float)found.y}, (float)fmax(FLT_MIN, fmin(found.height, FLT_MAX))};
	return CAROM_OK;
}

static carom_status main_view(carom_world *world, const carom_render_def *def, carom_layer *view, carom_error *error)
{
	carom_pixels clip = {0, 0, (int32_t)def->width, (int32_t)def->height};
	double shorter = def->width < def->height ? def->width : def->height;
	double line = shorter > THINNEST_LINE * LINES_IN_SIDE ? shorter / LINES_IN_SIDE : THINNEST_LINE;
	sight found = {0};
	TRY(find_sight(world, def, &found, error));
	look_at(view, found.x, found.y, found.height, clip, line);
	return CAROM_OK;
}

/* ---- Inset [figure 5] ----------------------------------------------------------------------------------------- */

static double distance_squared(carom_pixels a, carom_pixels b)
{
	double x = (a.x0 + a.x1 - b.x0 - b.x1) / 2.0, y = (a.y0 + a.y1 - b.y0 - b.y1) / 2.0;
	return x * x + y * y;
}

/* The size of the enlarged detail: of its own aspect, as near as whole pixels come. */
static void size_panel(const carom_pixels *picture, const carom_inset *inset, int32_t *width, int32_t *height)
{
	double aspect = (double)inset->size.x / (double)inset->size.y;
	double high = PANEL_HEIGHT * picture->y1, wide = high * aspect;
	if (wide > PANEL_WIDTH * picture->x1) {
		wide = PANEL_WIDTH * picture->x1;
		high = wide / aspect;
	}
	*width = nearest_pixel(wide > 1 ? wide : 1);
	*height = nearest_pixel(high > 1 ? high : 1);
}

/* In the corner that is farthest from the detail; the upper right one where several are. */
static carom_pixels place_panel(const carom_pixels *picture, const carom_inset *inset, carom_pixels detail)
{
	int32_t width, height, margin = nearest_pixel(PANEL_MARGIN * picture->y1);
	carom_pixels best = {0, 0, 0, 0};
	size_panel(picture, inset, &width, &height);
	for (int corner = 0; corner < 4; corner++) {
		int32_t x = corner & 1 ? margin : picture->x1 - margin - width;
		int32_t y = corner & 2 ? picture->y1 - margin - height : margin;
		carom_pixels panel = {x, y, x + width, y + height};
		if (corner == 0 || distance_squared(panel, detail) > distance_squared(best, detail))
			best = panel;
	}
	return best;
}

/* Joins those corners of two boxes whose lines meet neither box: the lines that go right and up or left and down (in
 * the corner's own sense) run along one side of the corner each. */
static void join_boxes(carom_layer *layer, carom_pixels a, carom_pixels b, double breadth, uint32_t color)
{
	for (int corner = 0; corner < 4; corner++) {
		carom_mark line = {corner & 1 ? a.x1 : a.x0, corner & 2 ? a.y1 : a.y0, corner & 1 ? b.x1 : b.x0, corner & 2 ? b.y1 : b.y0, breadth, color};
		bool outward_x = corner & 1 ? line.x1 > line.x0 : line.x1 < line.x0;
		bool outward_y = corner & 2 ? line.y1 > line.y0 : line.y1 < line.y0;
		if (outward_x != outward_y)
			layer->marks[layer->mark_count++] = line;
	}
}

/* A pale casing keeps the accent apart from whatever bodies lie below it. */
static void mark_detail(carom_layer *layer, const carom_layer *view, carom_pixels detail, carom_pixels panel)
{
	int32_t breadth = nearest_pixel(1.5 * view->line), casing = nearest_pixel(view->line);
	join_boxes(layer, detail, panel, view->line + 2 * casing, CAROM_COLOR_CASING);
	draw_frame(layer, view->clip, detail, breadth + casing, CAROM_COLOR_CASING);
	join_boxes(layer, detail, panel, view->line, CAROM_COLOR_ACCENT);
	draw_frame(layer, view->clip, detail, breadth, CAROM_COLOR_ACCENT);
	draw_frame(layer, view->clip, panel, breadth + casing, CAROM_COLOR_CASING);
	draw_frame(layer, view->clip, panel, breadth, CAROM_COLOR_ACCENT);
}

static void draw_inset(carom_layer *layer, const carom_layer *view, const carom_world_def *def, const carom_inset *inset)
{
	bounds b = {
		(double)inset->min.x, (double)inset->min.y, (double)inset->min.x + (double)inset->size.x, (double)inset->min.y + (double)inset->size.y};
	carom_pixels detail = box_of(view, &b), panel = place_panel(&view->clip, inset, detail);
	double height = (b.max_x - b.min_x) * (panel.y1 - panel.y0) / (panel.x1 - panel.x0);
	look_at(layer, (b.min_x + b.max_x) / 2, (b.min_y + b.max_y) / 2, height, panel, view->line);
	mark_detail(layer, view, detail, panel);
	layer->clip = clipped(panel, view->clip);
	draw_box(layer, layer->clip, layer->clip, ground_of(def));
	draw_room(layer, def);
}

/* ---- The picture ---------------------------------------------------------------------------------------------- */

carom_status carom_world_render(carom_world *world, const carom_render_def *def, uint8_t *pixels, carom_error *error)
{
	carom_layer layers[2] = {{.mark_count = 0}};
	TRY(check_arguments(world, def, error));
	GIVEN(pixels, error);
	TRY(main_view(world, def, &layers[0], error));
	const carom_world_def *world_def = carom_world_get_def(world);
	carom_picture picture = {def->width, def->height, ground_of(world_def), def->has_inset ? 2 : 1, layers};
	draw_room(&layers[0], world_def);
	if (def->has_inset)
		draw_inset(&layers[1], &layers[0], world_def, &def->inset);
	carom_status status = carom_rods_draw(world, picture.layer_count, layers, error);
	if (status == CAROM_OK)
		status = carom_canvas_draw(world, &picture, pixels, error);
	free(layers[0].rods);
	free(layers[1].rods);
	return status;
}
