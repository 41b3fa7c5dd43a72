/* Box2D 2.4 beside Carom: the only file that knows it.
 * SPDX-License-Identifier: MIT */
#include "carom_peer.h"

#include <box2d/box2d.h>

#include <new>
#include <vector>

namespace {

constexpr int velocity_iterations = 8, position_iterations = 3; /* as its manual and its samples have them */

struct World {
	b2World world;
	std::vector<b2Body *> bodies;
	const float time_step;

	explicit World(const peer_scene &scene) : world(b2Vec2(scene.gravity.x, scene.gravity.y)), time_step(scene.time_step) {}
};

/* The package's: 2.4.1 calls itself 2.4.0. */
const char *version()
{
	return BOX2D_VERSION;
}

void add_shape(b2Body *body, const b2Shape *shape, float restitution, float friction)
{
	b2FixtureDef fixture;
	fixture.shape = shape;
	fixture.density = 1;
	fixture.friction = friction;
	fixture.restitution = restitution;
	if (restitution >= 1)
		fixture.restitutionThreshold = 0; /* else slow hits would lose their speed */
	body->CreateFixture(&fixture);
}

void add_walls(b2World &world, b2Vec2 least, b2Vec2 most, float restitution, float friction)
{
	b2BodyDef def;
	b2Body *body = world.CreateBody(&def);
	const b2Vec2 middle = 0.5f * (least + most), half = 0.5f * (most - least);
	const float thick = PEER_WALL / 2;
	for (float side : {-1.0f, 1.0f}) {
		b2PolygonShape box;
		box.SetAsBox(thick, half.y + PEER_WALL, middle + b2Vec2(side * (half.x + thick), 0), 0);
		add_shape(body, &box, restitution, friction);
		box.SetAsBox(half.x + PEER_WALL, thick, middle + b2Vec2(0, side * (half.y + thick)), 0);
		add_shape(body, &box, restitution, friction);
	}
}

/* Its own Set() welds vertices nearer than 2.5 mm: a thinner wall would be lost. These are convex and counter-clockwise already. */
b2PolygonShape polygon_of(const carom_body_info &info)
{
	b2PolygonShape polygon;
	polygon.m_count = b2Min<int32>(static_cast<int32>(info.vertex_count), b2_maxPolygonVertices);
	for (int32 k = 0; k < polygon.m_count; k++)
		polygon.m_vertices[k].Set(info.vertices[k].x, info.vertices[k].y);
	for (int32 k = 0; k < polygon.m_count; k++) {
		polygon.m_normals[k] = b2Cross(polygon.m_vertices[(k + 1) % polygon.m_count] - polygon.m_vertices[k], 1.0f);
		polygon.m_normals[k].Normalize();
	}
	return polygon;
}

void add_shape_of(b2Body *body, const carom_body_info &info)
{
	if (info.shape == CAROM_CIRCLE) {
		b2CircleShape circle;
		circle.m_radius = info.radius;
		add_shape(body, &circle, info.restitution, info.friction);
		return;
	}
	const b2PolygonShape polygon = polygon_of(info);
	add_shape(body, &polygon, info.restitution, info.friction);
}

b2Body *add_body(b2World &world, const carom_body_info &info, const carom_body_state &state, bool bullet)
{
	b2BodyDef def;
	def.type = info.is_static ? b2_staticBody : info.is_kinematic ? b2_kinematicBody : b2_dynamicBody;
	def.bullet = bullet;
	def.position.Set(state.position.x, state.position.y);
	def.angle = state.angle;
	def.linearVelocity.Set(state.velocity.x, state.velocity.y);
	def.angularVelocity = state.angular_velocity;
	b2Body *body = world.CreateBody(&def);
	add_shape_of(body, info);
	if (def.type != b2_dynamicBody)
		return body;
	b2MassData mass;
	mass.mass = info.mass;
	mass.center.SetZero();
	mass.I = info.inertia;
	body->SetMassData(&mass);
	return body;
}

void *create(const peer_scene *scene)
{
	World *made = nullptr;
	try {
		made = new World(*scene);
		made->bodies.reserve(scene->count);
	} catch (const std::bad_alloc &) {
		delete made;
		return nullptr;
	}
	made->world.SetAllowSleeping(false);
	add_walls(made->world, {scene->room_min.x, scene->room_min.y}, {scene->room_max.x, scene->room_max.y}, scene->restitution, scene->friction);
	for (size_t k = 0; k < scene->count; k++) {
		made->bodies.push_back(add_body(made->world, scene->bodies[k], scene->states[k], scene->bullets));
		made->bodies.back()->GetUserData().pointer = k + 1; /* of the walls' it is 0 */
	}
	return made;
}

void step(void *world)
{
	World *made = static_cast<World *>(world);
	made->world.Step(made->time_step, velocity_iterations, position_iterations);
}

void get_states(const void *world, carom_body_state *states)
{
	for (const b2Body *body : static_cast<const World *>(world)->bodies) {
		const b2Vec2 at = body->GetPosition(), velocity = body->GetLinearVelocity();
		*states++ = {{at.x, at.y}, body->GetAngle(), {velocity.x, velocity.y}, body->GetAngularVelocity()};
	}
}

class Nearest : public b2RayCastCallback
{
public:
	int32_t body = -1;

private:
	float ReportFixture(b2Fixture *fixture, const b2Vec2 &point, const b2Vec2 &normal, float part) override
	{
		(void)point, (void)normal;
		body = static_cast<int32_t>(fixture->GetBody()->GetUserData().pointer) - 1;
		return part; /* nothing beyond is of interest */
	}
};

int32_t cast(const void *world, carom_vec2 from, carom_vec2 to)
{
	Nearest nearest;
	static_cast<const World *>(world)->world.RayCast(&nearest, {from.x, from.y}, {to.x, to.y});
	return nearest.body;
}

void destroy(void *world)
{
	delete static_cast<World *>(world);
}

}

const peer peer_box2d = {
	"Box2D",
	"8 velocity and 3 position iterations, as in its manual, and no threshold of a restitution of 1; else its defaults",
	version,
	create,
	step,
	get_states,
	cast,
	destroy,
};
