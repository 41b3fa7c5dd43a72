#include "cpu/joint.hpp"
#include "cpu/lanes.hpp"
#include "cpu/leaver.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

namespace carom::cpu {

constexpr int32_t chunk = 1024; /* slots */
constexpr int32_t ahead = 16;   /* so many later ones are fetched already */

template <typename T> static Slot<T> *slots_of(const Job<T> &job, int index)
{
	return reinterpret_cast<Slot<T> *>(job.records(index));
}

/* What gravity and a body's own force and torque, a texel of Forces, do to it. */
template <typename T> static void push(Slot<T> &slot, T gravity_x, T gravity_y, T force_x, T force_y, T torque)
{
	const T im = slot.mass[MASS_INVERSE];
	const bool moves = im > 0;
	slot.push[PUSH_X] = moves ? gravity_x + force_x * im : 0;
	slot.push[PUSH_Y] = moves ? gravity_y + force_y * im : 0;
	slot.push[PUSH_TORQUE] = moves ? torque * slot.mass[MASS_INVERSE_INERTIA] : 0;
}

/* A body as the host or the state tells of it, into the slot of its index. */
template <typename T> struct Newcomer {
	const T *linear, *rotational, *geometry, *forces;

	void fill(Slot<T> &slot, int32_t index, T gravity_x, T gravity_y) const
	{
		std::copy_n(linear, 4, slot.place);
		slot.turn[TURN_ANGLE] = rotational[ROTATIONAL_ANGLE];
		slot.turn[TURN_VELOCITY] = rotational[ROTATIONAL_VELOCITY];
		slot.turn[TURN_RADIUS] = rotational[ROTATIONAL_RADIUS];
		slot.turn[TURN_RESTITUTION] = forces[FORCES_RESTITUTION];
		slot.mass[MASS_INVERSE] = 1 / geometry[GEOMETRY_MASS];
		slot.mass[MASS_INVERSE_INERTIA] = 1 / geometry[GEOMETRY_INERTIA];
		slot.mass[MASS_FIRST] = 2 * geometry[GEOMETRY_FIRST];
		slot.mass[MASS_COUNT] = geometry[GEOMETRY_COUNT];
		push(slot, gravity_x, gravity_y, forces[FORCES_X], forces[FORCES_Y], forces[FORCES_TORQUE]);
		slot.push[PUSH_BODY] = static_cast<T>(index);
	}
};

template <typename T> static void load(const Job<T> &job)
{
	const State<T> state(job, 1);
	Slot<T> *slots = slots_of(job, STATE_COUNT);
	int32_t *need = job.list(STATE_COUNT + 1), *places = job.list(STATE_COUNT + 2);
	job.pool.run(job.domain[0], chunk, [&](int32_t begin, int32_t end) {
		for (int32_t i = begin; i < end; i++) {
			T texels[4][4];
			for (int32_t k = 0; k < 4; k++) {
				texels[0][k] = state.linear.of(i, k);
				texels[1][k] = state.rotational.of(i, k);
				texels[2][k] = state.geometry.of(i, k);
				texels[3][k] = state.forces.of(i, k);
			}
			const Newcomer<T> body{texels[0], texels[1], texels[2], texels[3]};
			body.fill(slots[i], i, state.world(WORLD_GRAVITY_X), state.world(WORLD_GRAVITY_Y));
			need[i] = 0;
			places[i] = i;
		}
	});
}

/* Bodies that come, behind the others: their slots are in no list yet. */
template <typename T> static void add(const Job<T> &job)
{
	const Texels<T> uniforms = job.texels(0);
	const Records<T> added(job.records(1));
	Slot<T> *slots = slots_of(job, 2);
	int32_t *need = job.list(3), *places = job.list(4), *extra = job.list(10), *owners = job.list(11), *parents = job.list(12);
	Box<T> *boxes = reinterpret_cast<Box<T> *>(job.records(5));
	Span *spans = reinterpret_cast<Span *>(job.list(9));
	const int32_t *status = job.list(6), first = job.domain[3];
	const ReachKeeper<T> keeper(slots, job.records(5), job.list(6), job.list(7), job.list(8), job.domain[2], uniforms);
	for (int32_t k = 0; k < job.domain[0]; k++) {
		const T *const texels = &added.of(ADDED_WIDTH * k, 0);
		const Newcomer<T> body{texels + 4 * ADDED_LINEAR, texels + 4 * ADDED_ROTATIONAL, texels + 4 * ADDED_GEOMETRY, texels + 4 * ADDED_FORCES};
		const int32_t s = first + k;
		body.fill(slots[s], s, uniforms.fact(UNIFORMS_WORLD, WORLD_GRAVITY_X), uniforms.fact(UNIFORMS_WORLD, WORLD_GRAVITY_Y));
		need[s] = 0;
		places[s] = parents[s] = s;
		owners[s] = extra[s] = -1;
		spans[s] = {0, 0, 0, FOUND_NONE};
		boxes[s] = Box<T>::nowhere();
		if (!status[STATUS_STALE])
			keeper.pushed(s);
	}
}

/* Bodies that go, and new indices of the others. */
template <typename T> static void remove(const Job<T> &job)
{
	const Records<T> removed(job.records(0));
	Slot<T> *slots = slots_of(job, 1);
	int32_t *places = job.list(2);
	Leaver<T> leaver(job);
	std::vector<int32_t> bodies(static_cast<size_t>(job.domain[2]));
	int32_t count = 0;
	for (size_t k = 0; k < bodies.size(); k++) {
		const int32_t record = static_cast<int32_t>(k);
		bodies[k] = static_cast<int32_t>(removed.of(record, REMOVED_BODY));
		count = static_cast<int32_t>(removed.of(record, REMOVED_LAST));
		leaver.leave(places[bodies[k]], count);
	}
	job.pool.run(count, chunk, [&](int32_t begin, int32_t end) {
		for (int32_t s = begin; s < end; s++) {
			const int32_t before = slots[s].body();
			const auto below = std::lower_bound(bodies.begin(), bodies.end(), before) - bodies.begin();
			const int32_t body = before - static_cast<int32_t>(below);
			slots[s].push[PUSH_BODY] = static_cast<T>(body);
			places[body] = s;
		}
	});
}

/* Some bodies, as the host has changed them between two steps. */
template <typename T> static void change(const Job<T> &job)
{
	const Texels<T> uniforms = job.texels(0), forces = job.texels(8);
	const Records<T> changes(job.records(1));
	const int32_t *places = job.list(2), *status = job.list(5);
	Slot<T> *slots = slots_of(job, 3);
	const ReachKeeper<T> keeper(slots, job.records(4), job.list(5), job.list(6), job.list(7), job.domain[2], uniforms);
	const T gravity_x = uniforms.fact(UNIFORMS_WORLD, WORLD_GRAVITY_X), gravity_y = uniforms.fact(UNIFORMS_WORLD, WORLD_GRAVITY_Y);
	const auto body_of = [&changes](int32_t k) { return static_cast<int32_t>(changes.of(CHANGES_WIDTH * k + CHANGES_TURN, CHANGE_BODY)); };
	job.pool.run(job.domain[0], chunk, [&](int32_t begin, int32_t end) {
		for (int32_t k = begin; k < end; k++) {
			__builtin_prefetch(&slots[places[body_of(std::min(k + ahead, end - 1))]], 1);
			const int32_t record = CHANGES_WIDTH * k, turn = record + CHANGES_TURN, body = body_of(k);
			const T *const f = &changes.of(record + CHANGES_FORCES, 0);
			Slot<T> &slot = slots[places[body]];
			if (changes.of(turn, CHANGE_MOVES) > 0) {
				std::copy_n(&changes.of(record + CHANGES_PLACE, 0), 4, slot.place);
				slot.turn[TURN_ANGLE] = changes.of(turn, CHANGE_ANGLE);
				slot.turn[TURN_VELOCITY] = changes.of(turn, CHANGE_VELOCITY);
			}
			push(slot, gravity_x, gravity_y, f[FORCES_X], f[FORCES_Y], f[FORCES_TORQUE]);
			forces.set(body & (ROW_SIZE - 1), body >> ROW_LOG2, f[FORCES_X], f[FORCES_Y], f[FORCES_TORQUE], f[FORCES_RESTITUTION]);
			if (!__atomic_load_n(&status[STATUS_STALE], __ATOMIC_RELAXED))
				keeper.pushed(places[body]);
		}
	});
}

/* All that move, once gravity or the time step is another one. */
template <typename T> static void push_all(const Job<T> &job)
{
	const Texels<T> uniforms = job.texels(0), forces = job.texels(1);
	Slot<T> *slots = slots_of(job, 2);
	const int32_t *status = job.list(4);
	const ReachKeeper<T> keeper(slots, job.records(3), job.list(4), job.list(5), job.list(6), job.domain[2], uniforms);
	const T gravity_x = uniforms.fact(UNIFORMS_WORLD, WORLD_GRAVITY_X), gravity_y = uniforms.fact(UNIFORMS_WORLD, WORLD_GRAVITY_Y);
	job.pool.run(job.domain[0], chunk, [&](int32_t begin, int32_t end) {
		for (int32_t s = begin; s < end; s++) {
			if (slots[s].is_static())
				continue;
			const int32_t body = slots[s].body();
			push(slots[s], gravity_x, gravity_y, forces.of(body, FORCES_X), forces.of(body, FORCES_Y), forces.of(body, FORCES_TORQUE));
			if (!__atomic_load_n(&status[STATUS_STALE], __ATOMIC_RELAXED))
				keeper.pushed(s);
		}
	});
}

/* Motors, as the host has changed them between two steps; what they turn is disturbed in its sleep. */
template <typename T> static void drive(const Job<T> &job)
{
	const Records<T> changes(job.records(0));
	const int32_t *places = job.list(1);
	const Joints<T> joints(job.records(2), nullptr);
	const Sleepers<T> sleepers{reinterpret_cast<Touching *>(job.list(3)), nullptr, job.list(4), nullptr};
	for (int32_t k = 0; k < job.domain[0]; k++) {
		Joint<T> &joint = joints.of(2 * static_cast<int32_t>(changes.of(k, DRIVEN_JOINT)));
		joint.drive[DRIVE_SPEED] = changes.of(k, DRIVEN_SPEED), joint.drive[DRIVE_TORQUE] = changes.of(k, DRIVEN_TORQUE);
		for (const T party : {joint.parties[JOINT_BODY], joint.parties[JOINT_OTHER]})
			if (party >= 0 && sleepers.sleeps(places[static_cast<int32_t>(party)]))
				sleepers.disturb(places[static_cast<int32_t>(party)]);
	}
}

/* The states of some, one after the other. */
template <typename T> static void pick(const Job<T> &job)
{
	const int32_t *places = job.list(0), first = job.domain[2];
	const Slot<T> *slots = slots_of(job, 1);
	const Records<T> states(job.records(2));
	job.pool.run(job.domain[0], chunk, [&](int32_t begin, int32_t end) {
		for (int32_t k = begin; k < end; k++) {
			const Slot<T> &slot = slots[places[first + k]];
			std::copy_n(slot.place, 4, &states.of(CHANGES_WIDTH * k + CHANGES_PLACE, 0));
			states.put(CHANGES_WIDTH * k + CHANGES_TURN, slot.turn[TURN_ANGLE], slot.turn[TURN_VELOCITY], static_cast<T>(first + k), 1);
		}
	});
}

/* Channels of `count` bodies that lie beside each other, four at most. */
template <typename T> static void put_channels(const Lanes<T> (&channels)[lane_count], const Texels<T> &to, int32_t first, int32_t count)
{
	for (int32_t c = 0; c < lane_count; c++)
		std::memcpy(&to.of(first, c), &channels[c], sizeof(T) * static_cast<size_t>(count));
}

/* The state lies channel by channel, in the order of the bodies: neighbours there are written together, wherever their slots are. */
template <typename T> static void unload(const Job<T> &job)
{
	const Slot<T> *slots = slots_of(job, 0);
	const int32_t *places = job.list(1), count = job.domain[0];
	const Texels<T> linear = job.texels(2), rotational = job.texels(3);
	job.pool.run((count + lane_count - 1) / lane_count, chunk / lane_count, [&](int32_t begin, int32_t end) {
		for (int32_t first = lane_count * begin; first < std::min(lane_count * end, count); first += lane_count) {
			Lanes<T> place[lane_count], turn[lane_count];
			for (int32_t k = 0; k < lane_count; k++) {
				const Slot<T> &slot = slots[places[std::min(first + k, count - 1)]];
				__builtin_prefetch(&slots[places[std::min(first + k + ahead, count - 1)]]);
				std::memcpy(&place[k], slot.place, sizeof place[k]);
				std::memcpy(&turn[k], slot.turn, sizeof turn[k]);
			}
			transpose<T>(place);
			transpose<T>(turn);
			static_assert(TURN_ANGLE == ROTATIONAL_ANGLE && TURN_VELOCITY == ROTATIONAL_VELOCITY && TURN_RADIUS == ROTATIONAL_RADIUS, "turn");
			turn[TURN_RESTITUTION] = Lanes<T>{};
			put_channels<T>(place, linear, first, std::min(lane_count, count - first));
			put_channels<T>(turn, rotational, first, std::min(lane_count, count - first));
		}
	});
}

extern const Stage slots_records;
const Stage slots_records{"slots", "records",
	{{STAGE_LOAD, load<float>, load<double>}, {STAGE_CHANGE, change<float>, change<double>}, {STAGE_ADD, add<float>, add<double>},
		{STAGE_REMOVE, remove<float>, remove<double>}, {STAGE_PUSH, push_all<float>, push_all<double>}, {STAGE_DRIVE, drive<float>, drive<double>},
		{STAGE_PICK, pick<float>, pick<double>}, {STAGE_UNLOAD, unload<float>, unload<double>}},
	nullptr, nullptr};

}
