/* Pictures of worlds, drawn on the host from what carom.h tells of them: first the draw list, then its pixels.
 * SPDX-License-Identifier: MIT */
#include "angle.h"
#include "palette.h"
#include "raster.h"
#include "status.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MAX_SIDE 16384
#define FIT_MARGIN 1.06    /* the height that a default camera shows for each metre it must show */
#define EMPTY_HEIGHT 10.0  /* m, of the picture of a world with nothing in it */
#define SHOW_ANGLE_FROM 4  /* pixels of radius: a circle that is smaller has no room for its radius line */
#define THINNEST_LINE 1.25 /* pixels */
#define LINES_IN_SIDE 600  /* how many thin lines are as broad as the picture's shorter side, unless they were too thin */
#define PANEL_HEIGHT 0.4   /* of the picture's: the enlarged detail */
#define PANEL_WIDTH 0.45   /* of the picture's at most */
#define PANEL_MARGIN 0.025 /* of the picture's height */

typedef struct scene {
	carom_world *world;
	const carom_world_def *def;
	size_t count;
	carom_body_state *states;
} scene;

/* From the world to pixels. */
typedef struct view {
	double left, top; /* m, of the point at the pixels' origin */
	double scale;     /* pixels a metre */
	double line;      /* pixels, the breadth of thin lines */
	carom_pixels clip;
} view;

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
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "camera.center is (%g, %g): both must be finite",
			(double)camera->center.x, (double)camera->center.y);
	if (!(camera->height > 0) || !isfinite(camera->height))
		return carom_fail(
			error, CAROM_INVALID_ARGUMENT, "camera.height is %g: it must be above 0 and finite", (double)camera->height);
	return CAROM_OK;
}

static carom_status check_inset(const carom_inset *inset, carom_error *error)
{
	if (!is_finite_point(inset->min))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "inset.min is (%g, %g): both must be finite", (double)inset->min.x,
			(double)inset->min.y);
	if (!(inset->size.x > 0 && inset->size.y > 0) || !is_finite_point(inset->size))
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "inset.size is (%g, %g): both must be above 0 and finite",
			(double)inset->size.x, (double)inset->size.y);
	return CAROM_OK;
}

static carom_status check_arguments(
	const carom_world *world, const carom_render_def *def, const uint8_t *pixels, carom_error *error)
{
	if (!world || !def || !pixels)
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "%s is NULL", !world ? "world" : !def ? "def" : "pixels");
	if (def->width < 1 || def->width > MAX_SIDE || def->height < 1 || def->height > MAX_SIDE)
		return carom_fail(error, CAROM_INVALID_ARGUMENT, "the picture is %u x %u pixels: both must be 1 to %d",
			(unsigned)def->width, (unsigned)def->height, MAX_SIDE);
	carom_status status = def->has_camera ? check_camera(&def->camera, error) : CAROM_OK;
	if (status == CAROM_OK && def->has_inset)
		status = check_inset(&def->inset, error);
	return status;
}

/* ---- Bodies --------------------------------------------------------------------------------------------------- */

static bool is_drawable(const carom_body_state *state)
{
	return is_finite_point(state->position) && isfinite(state->angle);
}

/* The body's vertices, here in metres. */
static void place_vertices(const carom_body_info *body, const carom_body_state *state, carom_point *placed)
{
	double sine, cosine;
	carom_sincos((double)state->angle, &sine, &cosine);
	for (uint32_t k = 0; k < body->vertex_count; k++) {
		double x = (double)body->vertices[k].x, y = (double)body->vertices[k].y;
		placed[k].x = (double)state->position.x + (cosine * x - sine * y);
		placed[k].y = (double)state->position.y + (sine * x + cosine * y);
	}
}

static carom_point to_pixels(const view *v, double x, double y)
{
	return (carom_point){(x - v->left) * v->scale, (v->top - y) * v->scale};
}

static carom_paint paint_of(const view *v, const carom_body_info *body, uint32_t index)
{
	uint32_t fill = body->color;
	if (fill == CAROM_COLOR_AUTO)
		fill = body->is_static ? CAROM_COLOR_STATIC : carom_palette_color(index);
	return (carom_paint){fill, carom_darker_color(fill), v->line, 1};
}

static void draw_circle(
	carom_draw_list *list, const view *v, double radius, const carom_body_state *state, const carom_paint *paint)
{
	double sine, cosine, r = radius * v->scale;
	carom_point center = to_pixels(v, (double)state->position.x, (double)state->position.y);
	carom_draw_disc(list, v->clip, center, r, paint);
	if (r < SHOW_ANGLE_FROM)
		return;
	carom_sincos((double)state->angle, &sine, &cosine);
	double reach = r - v->line / 2;
	carom_point rim = {center.x + cosine * reach, center.y - sine * reach};
	carom_draw_line(list, v->clip, center, rim, v->line, paint->outline, (r - SHOW_ANGLE_FROM) / SHOW_ANGLE_FROM);
}

static void draw_polygon(
	carom_draw_list *list, const view *v, const carom_body_info *body, const carom_body_state *state, const carom_paint *paint)
{
	carom_point points[CAROM_MAX_VERTICES];
	place_vertices(body, state, points);
	for (uint32_t k = 0; k < body->vertex_count; k++)
		points[k] = to_pixels(v, points[k].x, points[k].y);
	carom_draw_polygon(list, v->clip, points, body->vertex_count, paint);
}

/* Static bodies first: what moves lies over them. */
static carom_status draw_bodies(carom_draw_list *list, const scene *s, const view *v, bool is_static, carom_error *error)
{
	for (uint32_t k = 0; k < s->count; k++) {
		carom_body_info body;
		carom_status status = carom_world_get_body(s->world, k, &body, error);
		if (status != CAROM_OK)
			return status;
		if (body.is_static != is_static || !is_drawable(&s->states[k]))
			continue;
		carom_paint paint = paint_of(v, &body, k);
		if (body.vertices)
			draw_polygon(list, v, &body, &s->states[k], &paint);
		else
			draw_circle(list, v, (double)body.radius, &s->states[k], &paint);
	}
	return CAROM_OK;
}

/* ---- Room ----------------------------------------------------------------------------------------------------- */

/* Whole pixels, so that the box is crisp. */
static carom_pixels box_of(const view *v, const bounds *b)
{
	carom_point low = to_pixels(v, b->min_x, b->max_y), high = to_pixels(v, b->max_x, b->min_y);
	return (carom_pixels){
		carom_nearest_pixel(low.x), carom_nearest_pixel(low.y), carom_nearest_pixel(high.x), carom_nearest_pixel(high.y)};
}

static bounds room_of(const carom_world_def *def)
{
	return (bounds){(double)def->room_min.x, (double)def->room_min.y, (double)def->room_max.x, (double)def->room_max.y};
}

static void draw_ground(carom_draw_list *list, const scene *s, const view *v)
{
	carom_draw_box(list, v->clip, v->clip, s->def->has_room ? CAROM_COLOR_SURROUND : CAROM_COLOR_GROUND);
	if (!s->def->has_room)
		return;
	bounds room = room_of(s->def);
	carom_pixels inside = box_of(v, &room);
	carom_draw_frame(list, v->clip, inside, carom_nearest_pixel(1.5 * v->line), CAROM_COLOR_FRAME);
	carom_draw_box(list, v->clip, inside, CAROM_COLOR_GROUND);
}

static carom_status draw_scene(carom_draw_list *list, const scene *s, const view *v, carom_error *error)
{
	draw_ground(list, s, v);
	carom_status status = draw_bodies(list, s, v, true, error);
	return status == CAROM_OK ? draw_bodies(list, s, v, false, error) : status;
}

/* ---- Camera --------------------------------------------------------------------------------------------------- */

static void include(bounds *b, double x, double y, double radius)
{
	b->min_x = x - radius < b->min_x ? x - radius : b->min_x;
	b->min_y = y - radius < b->min_y ? y - radius : b->min_y;
	b->max_x = x + radius > b->max_x ? x + radius : b->max_x;
	b->max_y = y + radius > b->max_y ? y + radius : b->max_y;
}

static carom_status bodies_of(const scene *s, bounds *b, carom_error *error)
{
	*b = (bounds){HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
	for (uint32_t k = 0; k < s->count; k++) {
		carom_body_info body;
		carom_point placed[CAROM_MAX_VERTICES];
		carom_status status = carom_world_get_body(s->world, k, &body, error);
		if (status != CAROM_OK)
			return status;
		if (!is_drawable(&s->states[k]))
			continue;
		if (!body.vertices) {
			include(b, (double)s->states[k].position.x, (double)s->states[k].position.y, (double)body.radius);
			continue;
		}
		place_vertices(&body, &s->states[k], placed);
		for (uint32_t i = 0; i < body.vertex_count; i++)
			include(b, placed[i].x, placed[i].y, 0);
	}
	if (b->min_x > b->max_x)
		*b = (bounds){-EMPTY_HEIGHT / 2, -EMPTY_HEIGHT / 2, EMPTY_HEIGHT / 2, EMPTY_HEIGHT / 2};
	return CAROM_OK;
}

/* A view of `clip` that shows `height` metres about a point in its middle. */
static view look_at(double x, double y, double height, carom_pixels clip, double line)
{
	double scale = (clip.y1 - clip.y0) / height;
	return (view){x - (clip.x0 + clip.x1) / 2.0 / scale, y + (clip.y0 + clip.y1) / 2.0 / scale, scale, line, clip};
}

static carom_status main_view(const scene *s, const carom_render_def *def, view *v, carom_error *error)
{
	carom_pixels clip = {0, 0, (int32_t)def->width, (int32_t)def->height};
	double shorter = def->width < def->height ? def->width : def->height;
	double line = shorter > THINNEST_LINE * LINES_IN_SIDE ? shorter / LINES_IN_SIDE : THINNEST_LINE;
	if (def->has_camera) {
		const carom_camera *camera = &def->camera;
		*v = look_at((double)camera->center.x, (double)camera->center.y, (double)camera->height, clip, line);
		return CAROM_OK;
	}
	bounds b = room_of(s->def);
	carom_status status = s->def->has_room ? CAROM_OK : bodies_of(s, &b, error);
	if (status != CAROM_OK)
		return status;
	double wide = (b.max_x - b.min_x) * def->height / def->width, high = b.max_y - b.min_y;
	double height = FIT_MARGIN * (wide > high ? wide : high);
	/* A body so far out that its size is lost in its position has none here. */
	*v = look_at((b.min_x + b.max_x) / 2, (b.min_y + b.max_y) / 2, height > 0 ? height : EMPTY_HEIGHT, clip, line);
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
	*width = carom_nearest_pixel(wide > 1 ? wide : 1);
	*height = carom_nearest_pixel(high > 1 ? high : 1);
}

/* In the corner that is farthest from the detail; the upper right one where several are. */
static carom_pixels place_panel(const carom_pixels *picture, const carom_inset *inset, carom_pixels detail)
{
	int32_t width, height, margin = carom_nearest_pixel(PANEL_MARGIN * picture->y1);
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
static void join_boxes(carom_draw_list *list, carom_pixels clip, carom_pixels a, carom_pixels b, double breadth, uint32_t color)
{
	for (int corner = 0; corner < 4; corner++) {
		carom_point from = {corner & 1 ? a.x1 : a.x0, corner & 2 ? a.y1 : a.y0};
		carom_point to = {corner & 1 ? b.x1 : b.x0, corner & 2 ? b.y1 : b.y0};
		bool outward_x = corner & 1 ? to.x > from.x : to.x < from.x;
		bool outward_y = corner & 2 ? to.y > from.y : to.y < from.y;
		if (outward_x != outward_y)
			carom_draw_line(list, clip, from, to, breadth, color, 1);
	}
}

/* A pale casing keeps the accent apart from whatever bodies lie below it. */
static void mark_detail(carom_draw_list *list, const view *v, carom_pixels detail, carom_pixels panel)
{
	int32_t breadth = carom_nearest_pixel(1.5 * v->line), casing = carom_nearest_pixel(v->line);
	join_boxes(list, v->clip, detail, panel, v->line + 2 * casing, CAROM_COLOR_CASING);
	carom_draw_frame(list, v->clip, detail, breadth + casing, CAROM_COLOR_CASING);
	join_boxes(list, v->clip, detail, panel, v->line, CAROM_COLOR_ACCENT);
	carom_draw_frame(list, v->clip, detail, breadth, CAROM_COLOR_ACCENT);
	carom_draw_frame(list, v->clip, panel, breadth + casing, CAROM_COLOR_CASING);
	carom_draw_frame(list, v->clip, panel, breadth, CAROM_COLOR_ACCENT);
}

static carom_status draw_inset(carom_draw_list *list, const scene *s, const view *v, const carom_inset *inset, carom_error *error)
{
	bounds b = {(double)inset->min.x, (double)inset->min.y, (double)inset->min.x + (double)inset->size.x,
		(double)inset->min.y + (double)inset->size.y};
	carom_pixels detail = box_of(v, &b), panel = place_panel(&v->clip, inset, detail);
	double height = (b.max_x - b.min_x) * (panel.y1 - panel.y0) / (panel.x1 - panel.x0);
	view enlarged = look_at((b.min_x + b.max_x) / 2, (b.min_y + b.max_y) / 2, height, panel, v->line);
	mark_detail(list, v, detail, panel);
	enlarged.clip = carom_pixels_clip(panel, v->clip);
	return draw_scene(list, s, &enlarged, error);
}

/* ---- The picture ---------------------------------------------------------------------------------------------- */

static carom_status read_scene(carom_world *world, scene *s, carom_error *error)
{
	*s = (scene){.world = world, .def = carom_world_get_def(world), .count = carom_world_body_count(world)};
	if (s->count == 0)
		return CAROM_OK;
	s->states = malloc(s->count * sizeof *s->states);
	if (!s->states)
		return carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory for the states of %zu bodies", s->count);
	return carom_world_get_states(world, 0, s->count, s->states, error);
}

carom_status carom_world_render(carom_world *world, const carom_render_def *def, uint8_t *pixels, carom_error *error)
{
	carom_draw_list list = {0};
	scene s = {0};
	view v;
	carom_status status = check_arguments(world, def, pixels, error);
	if (status != CAROM_OK)
		return status;
	status = read_scene(world, &s, error);
	if (status == CAROM_OK)
		status = main_view(&s, def, &v, error);
	if (status == CAROM_OK)
		status = draw_scene(&list, &s, &v, error);
	if (status == CAROM_OK && def->has_inset)
		status = draw_inset(&list, &s, &v, &def->inset, error);
	if (status == CAROM_OK && list.out_of_memory)
		status = carom_fail(error, CAROM_OUT_OF_MEMORY, "no memory to draw %zu bodies", s.count);
	if (status == CAROM_OK) {
		memset(pixels, 255, (size_t)def->width * def->height * 4);
		carom_raster(&list, pixels, def->width);
	}
	carom_draw_list_free(&list);
	free(s.states);
	return status;
}
