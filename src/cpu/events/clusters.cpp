#include "cpu/queue.hpp"
#include "cpu/sleep.hpp"

#include <algorithm>
#include <vector>

namespace carom::cpu {

/* The hits that a step begins with, of bodies that are awake: those of which it is not known that they go on without a hit. */
template <typename T> class Seek
{
public:
	/* A hit, and its body's slot. */
	struct Seed {
		int32_t slot, partner;
		typename Bodies<T>::Found hit;
	};

	Seek(const Job<T> &job, std::vector<Seed> &room)
		: clusters(job, 12), touching(reinterpret_cast<const Touching *>(job.list(14))), any_sleep(clusters.status[STATUS_SLEEPERS] > 0),
		  round(job.domain[2]), age(clusters.status[STATUS_AGE]), until(slice_end<T>(clusters.status, 0)), sieve(clusters.ahead), seeds(room)
	{
		seeds.clear();
	}

	void run(int32_t begin, int32_t end)
	{
		int32_t awake[block], count;
		for (int32_t s = begin; s < end;) {
			for (count = 0; s < end && count < block; s++)
				if (is_awake(s)) {
					awake[count++] = s;
					clusters.fetch_span(s);
				}
			look(awake, count);
		}
		sieve.sift(meet());
		if (!seeds.empty())
			activate();
	}

private:
	static constexpr int32_t block = 64; /* slots */

	auto meet()
	{
		return [this](int32_t s, int32_t other, const Approach<T> &approach) { pair(s, other, approach); };
	}

	void look(const int32_t *awake, int32_t count)
	{
		const Slot<T> *const slots = clusters.slots; /* not known to stay as they are, else, where the sieve is written to */
		const T length = clusters.length, ahead = clusters.ahead;
		for (int32_t k = 0; k < count; k++) {
			if (k + 4 < count)
				clusters.fetch_list(awake[k + 4]);
			if (k + 2 < count)
				clusters.fetch_neighbours(awake[k + 2], clusters.watched_end(awake[k + 2]));
			const int32_t s = awake[k];
			const Disc<T> disc(slots[s], length);
			if (age == 0)
				clusters.wakes[s].changed = 0; /* which nobody reads in this step */
			const int32_t changed = clusters.wakes[s].changed, last = clusters.watched_end(s);
			clusters.wake_at(s, clusters.ahead + 1);
			const bool is_still = lies(s);
			if (!is_still && !clusters.stays_inside(s, Trajectory<T>(clusters.slots[s]), clusters.ahead + 1))
				walls(s);
			clusters.each_neighbour(s, last, [&](int32_t other, bool is_first) {
				const int32_t other_changed = age > 0 ? clusters.wakes[other].changed : 0;
				if ((is_first ? changed < other_changed : changed <= other_changed) || (is_still && lies(other)))
					return;
				sieve.add(s, other, Between<T>(disc, Disc<T>(slots[other], length), ahead));
				if (sieve.is_full())
					sieve.sift(meet());
			});
		}
	}

	/* Sleeps, or where some do, is static: meets no other such one in this step. */
	bool lies(int32_t s) const { return any_sleep && (touching[s].asleep != 0 || clusters.slots[s].is_static()); }

	bool is_awake(int32_t s) const { return age == 0 || clusters.wakes[s].next <= age; }

	void pair(int32_t s, int32_t other, const Approach<T> &approach)
	{
		const Slot<T> &slot = clusters.slots[s], &other_slot = clusters.slots[other];
		const Outlook<T> outlook(approach, slot, {slot, clusters.length}, other_slot, {other_slot, clusters.length});
		if (!outlook.may_touch) {
			clusters.wake_before(s, outlook.earliest);
			return;
		}
		Convex<T> a, b;
		clusters.fill(s, Trajectory<T>(slot), other, Trajectory<T>(other_slot), a, b);
		const T apart = clusters.ahead > 0 ? steps_apart(a, b, clusters.ahead + 1) : T(0);
		clusters.wake_before(s, larger(outlook.earliest, apart));
		if (apart > 0)
			return;
		const auto hit = clusters.pair_time(a, b, T(0), T(1));
		if (!(hit.time <= 1))
			return;
		if (slot.is_dynamic())
			seeds.push_back({s, other, hit});
		if (other_slot.is_dynamic())
			seeds.push_back({other, s, hit});
		if (slot.is_dynamic() && other_slot.is_dynamic() && hit.time <= until)
			clusters.unite(s, other);
	}

	void walls(int32_t s)
	{
		int32_t wall;
		const auto hit = clusters.wall_time(s, Trajectory<T>(clusters.slots[s]), &wall);
		clusters.wake_before(s, T(1));
		if (hit.time <= 1)
			seeds.push_back({s, -1 - wall, hit});
	}

	/* Bodies with a hit get numbers, by which others may ask for them when the kernel has ended. All at once: to count where all threads count costs as
	 * much as the search for a hit. */
	void activate()
	{
		int32_t *const status = clusters.status;
		int32_t k = fetch_add(&status[STATUS_FOUND], static_cast<int32_t>(seeds.size()));
		for (const Seed &seed : seeds)
			keep(k++, seed);
		const auto has_number = [this](const Seed &seed) {
			return __atomic_load_n(&clusters.owners[seed.slot], __ATOMIC_RELAXED) != -1 || !clusters.take(seed.slot, -2);
		};
		seeds.erase(std::remove_if(seeds.begin(), seeds.end(), has_number), seeds.end());
		int32_t id = fetch_add(&status[STATUS_ACTIVE], static_cast<int32_t>(seeds.size()));
		for (const Seed &seed : seeds) {
			clusters.active[id] = seed.slot;
			clusters.members[id].owner = id;
			clusters.members[id].round = round;
			__atomic_store_n(&clusters.owners[seed.slot], id++, __ATOMIC_RELEASE);
		}
		if (__atomic_load_n(&status[STATUS_ROUND], __ATOMIC_RELAXED) < round)
			__atomic_store_n(&status[STATUS_ROUND], round, __ATOMIC_RELAXED);
	}

	/* In double (the tests' oracle) times have no room here, and are found again. */
	void keep(int32_t k, const Seed &seed)
	{
		int32_t *const first = &clusters.spans[seed.slot].found;
		if (sizeof(T) != sizeof(float) || k >= clusters.status[STATUS_NODE_ROOM] * NODE_WIDTH / FOUND_WIDTH) {
			__atomic_store_n(first, FOUND_NO_ROOM, __ATOMIC_RELAXED);
			return;
		}
		const float time = static_cast<float>(seed.hit.time);
		clusters.found[k] = {seed.partner, as_bits(seed.hit.is_pause ? -time : time), __atomic_exchange_n(first, k, __ATOMIC_RELAXED)};
	}

	const Clusters<T> clusters;
	const Touching *const touching; /* where any sleep */
	const bool any_sleep;
	const int32_t round, age;
	const T until; /* the end of the first slice */
	Sieve<T> sieve;
	std::vector<Seed> &seeds;
};

template <typename T> static void seek(const Job<T> &job)
{
	const Clusters<T> clusters(job, 12);
	if (!clusters.ready() || clusters.status[STATUS_UNDER_WAY])
		return;
	clusters.status[STATUS_BEGUN] = job.domain[2];
	clusters.status[STATUS_SLICE] = clusters.status[STATUS_SAVED] = 0;
	job.pool.run(job.domain[3], 512, [&](int32_t begin, int32_t end) {
		static thread_local std::vector<typename Seek<T>::Seed> room;
		Seek<T>(job, room).run(begin, end);
	});
}

/* The number of the body that a number is to hit, -1 if that has none. */
template <typename T> static int32_t partner_number(const Clusters<T> &clusters, const Work<T> *work, int32_t id)
{
	const int32_t other = static_cast<int32_t>(work[id].next[NEXT_PARTNER]);
	return other < 0 ? -1 : clusters.owners[other];
}

/* Has its partner been hit by another cluster since the number saw its next event? */
template <typename T> static bool is_over(const Clusters<T> &clusters, const Work<T> *work, int32_t id)
{
	const int32_t other_id = partner_number(clusters, work, id);
	return other_id >= 0 && clusters.members[other_id].events != clusters.members[id].seen;
}

/* What was hit in a slice that is done, if the step has another: it falls apart, unless it lies in a pile. Its numbers are nobody's, but for those that hit something
 * in the next one, and all is kept as it is. */
template <typename T> static void release(const Job<T> &job)
{
	const Clusters<T> clusters(job, 15);
	const Ways<T> ways(clusters, job.records(13), job.list(14));
	int32_t *const status = clusters.status;
	Member *const members = clusters.members;
	Work<T> *const work = reinterpret_cast<Work<T> *>(job.records(12));
	const int32_t round = job.domain[2], numbers = status[STATUS_NUMBERS], count = std::min(status[STATUS_ACTIVE], numbers);
	if (status[STATUS_ROUND] != round - 1 || is_last_slice(status))
		return;
	status[STATUS_ROUND] = status[STATUS_BEGUN] = round;
	status[STATUS_SAVED] = count;
	status[STATUS_SLICE]++;
	const T until = clusters.until();
	job.pool.run(count, 512, [&](int32_t begin, int32_t end) {
		for (int32_t id = begin; id < end; id++) {
			const int32_t s = clusters.active[id];
			if (s < 0)
				continue;
			Member &member = members[id];
			T *const next = work[id].next;
			if (member.events > 0)
				ways.until(until, s, work[id].trajectory(clusters.slots[s]));
			if (next[NEXT_TIME] <= until && is_over(clusters, work, id))
				next[NEXT_TIME] = NEXT_UNKNOWN;
			if (member.owner < 0 || !members[member.owner].pile)
				member.owner = next[NEXT_TIME] <= until ? id : -1;
			member.round = member.owner == id ? round : 0;
			member.hits = member.ruled = 0;
			member.head = -1;
			member.begun = member.events;
			work[id].empty_box();
			clusters.parents[s] = clusters.active[member.owner < 0 ? id : member.owner];
			members[numbers + id] = member;
			work[numbers + id] = work[id];
		}
	});
}

/* As a slice begins that is not the first, bodies that hit each other in it are in one cluster, and with a pile those that it hits in the step. */
template <typename T> static void pair(const Job<T> &job)
{
	const Clusters<T> clusters(job, 13);
	const Work<T> *const work = reinterpret_cast<const Work<T> *>(job.records(12));
	if (clusters.status[STATUS_BEGUN] != job.domain[2] || clusters.status[STATUS_SLICE] == 0)
		return;
	job.pool.run(clusters.status[STATUS_SAVED], 512, [&](int32_t begin, int32_t end) {
		for (int32_t id = begin; id < end; id++) {
			const T time = work[id].next[NEXT_TIME];
			if (clusters.active[id] < 0 || clusters.members[id].owner < 0 || time == NEXT_UNKNOWN || !(time <= 1))
				continue;
			const int32_t other_id = partner_number(clusters, work, id);
			if (other_id >= 0 && clusters.members[other_id].owner >= 0)
				clusters.unite(clusters.active[id], clusters.active[other_id]);
		}
	});
}

/* Clusters that are to be done in this round begin anew, those that are in conflict as one. */
template <typename T> static void muster(const Job<T> &job)
{
	const Clusters<T> clusters(job, 13);
	int32_t *const status = clusters.status;
	Member *const members = clusters.members;
	Work<T> *const work = reinterpret_cast<Work<T> *>(job.records(12));
	const int32_t round = job.domain[2];
	if (status[STATUS_ROUND] != round)
		return;
	status[STATUS_SEEDS] = std::min(status[STATUS_ACTIVE], status[STATUS_NUMBERS]);
	job.pool.run(status[STATUS_SEEDS], 512, [&](int32_t begin, int32_t end) {
		Tally lost{};
		for (int32_t id = begin; id < end; id++) {
			Member &member = members[id];
			if (clusters.active[id] < 0 || member.owner < 0 || members[member.owner].round != round)
				continue;
			const int32_t root = clusters.owners[clusters.root_of(clusters.active[id])];
			lost += {-member.hits, -member.ruled, -clusters.was_held(id, work), clusters.events_of(id)};
			clusters.go_back(id, work);
			member.owner = root;
			member.link = __atomic_exchange_n(&members[root].head, id, __ATOMIC_RELAXED);
		}
		lost.add_to(status);
	});
}

/* Is what numbers' turns read to be fetched before? What is of few is in caches, and in a later round of a step most have no turn. */
template <typename T> static bool fetches(const Clusters<T> &clusters, int32_t count, int32_t round)
{
	return count >= 4096 && round == clusters.status[STATUS_BEGUN];
}

/* While one number's turn is, what those after it look at is fetched, of their neighbours only half, or all. */
template <typename T> [[gnu::always_inline]] static inline void fetch_active(const Clusters<T> &clusters, int32_t id, int32_t count, bool half)
{
	const auto slot_of = [&](int32_t number) { return number < count ? clusters.active[number] : -1; };
	if (const int32_t s = slot_of(id + 6); s >= 0)
		clusters.fetch_span(s);
	if (const int32_t s = slot_of(id + 4); s >= 0)
		clusters.fetch_list(s);
	if (const int32_t s = slot_of(id + 2); s >= 0)
		clusters.fetch_neighbours(s, half ? clusters.spans[s].half : clusters.spans[s].end);
}

template <typename T> static void resolve(const Job<T> &job)
{
	const Clusters<T> clusters(job, 16);
	const Rubs<T> rubs(job.texels(1), job.texels(15));
	const int32_t round = job.domain[2];
	if (clusters.status[STATUS_ROUND] < round)
		return;
	Work<T> *work = reinterpret_cast<Work<T> *>(job.records(12));
	const Ways<T> ways(clusters, job.records(13), job.list(14));
	const Hits<T> hits(job.records(18), job.list(6));
	const JointPoints<T> joints{reinterpret_cast<const Touching *>(job.list(20)), reinterpret_cast<const Points<T> *>(job.records(21))};
	const int32_t count = clusters.status[STATUS_SEEDS];
	const bool is_to_fetch = fetches(clusters, count, round);
	job.pool.run(count, 64, [&](int32_t begin, int32_t end) {
		static thread_local std::vector<int32_t> room;
		Tally tally{};
		for (int32_t id = begin; id < end; id++) {
			const Member &member = clusters.members[id];
			if (is_to_fetch)
				fetch_active(clusters, id, count, false);
			if (__atomic_load_n(&member.head, __ATOMIC_RELAXED) >= 0 && __atomic_load_n(&member.round, __ATOMIC_RELAXED) == round)
				tally += Queue<T>(clusters, rubs, work, ways, hits, joints, id, round, room).run();
		}
		tally.add_to(clusters.status);
	});
}

/* What two bodies that different clusters changed in a slice come to. */
enum class Meeting { none, later, conflict };

template <typename T>
static Meeting meeting(const Clusters<T> &clusters, const Work<T> *work, int32_t s, int32_t id, int32_t other, int32_t other_id, T until)
{
	const Work<T> &a = work[id], &b = work[other_id];
	const Slot<T> &slot = clusters.slots[s], &other_slot = clusters.slots[other];
	const T reach = slot.radius() + other_slot.radius();
	const bool are_apart = a.box[0] - reach > b.box[2] || a.box[2] + reach < b.box[0] || a.box[1] - reach > b.box[3] || a.box[3] + reach < b.box[1];
	if (are_apart && !(until < 1))
		return Meeting::none;
	if (!are_apart && (clusters.events_of(id) > 1 || clusters.events_of(other_id) > 1))
		return Meeting::conflict;
	const Disc<T> disc(slot, a.place, a.time, a.held > 0, clusters.length), other_disc(other_slot, b.place, b.time, b.held > 0, clusters.length);
	if (!Approach<T>(between(disc, other_disc, T(0)), T(0)).may_touch())
		return Meeting::none;
	const T time = clusters.pair_time(s, a.trajectory(slot), other, b.trajectory(other_slot)).time;
	if (!(time <= 1))
		return Meeting::none;
	return time <= until ? Meeting::conflict : Meeting::later;
}

template <typename T> static void check_one(const Clusters<T> &clusters, Work<T> *work, int32_t id, int32_t round)
{
	const Member *members = clusters.members;
	const int32_t s = clusters.active[id], owner = members[id].owner;
	const auto round_of = [&](int32_t leader) { return __atomic_load_n(&members[leader].round, __ATOMIC_RELAXED); };
	if (s < 0 || owner < 0 || clusters.events_of(id) == 0 || round_of(owner) != round)
		return;
	const T until = clusters.until();
	const Span &span = clusters.spans[s];
	/* Of a pair that was changed in the slice one at least was done in this round, and finds the other; in the slice's first round both were, and one look is enough. In a
	 * later slice a body that was changed before is to be told, too. */
	const bool is_half = round == clusters.status[STATUS_BEGUN] && clusters.status[STATUS_SAVED] == 0;
	clusters.each_neighbour(s, is_half ? span.half : span.end, [&](int32_t other, bool) {
		const int32_t other_id = clusters.owners[other];
		if (other_id < 0 || members[other_id].events == 0 || members[other_id].owner == owner)
			return;
		const int32_t theirs = members[other_id].owner;
		if (theirs >= 0 && round_of(theirs) > round)
			return;
		const Meeting what = clusters.events_of(other_id) > 0 ? meeting(clusters, work, s, id, other, other_id, until) : Meeting::none;
		if (what == Meeting::conflict)
			clusters.conflict(owner, theirs, round);
		else if (what == Meeting::later)
			work[id].next[NEXT_TIME] = NEXT_UNKNOWN;
		clusters.rouse(s), clusters.rouse(other); /* neither knew of the other's change */
	});
}

template <typename T> static void check(const Job<T> &job)
{
	const Clusters<T> clusters(job, 13);
	Work<T> *work = reinterpret_cast<Work<T> *>(job.records(12));
	const int32_t round = job.domain[2];
	if (clusters.status[STATUS_ROUND] < round)
		return;
	const int32_t count = std::min(clusters.status[STATUS_ACTIVE], clusters.status[STATUS_NUMBERS]);
	const bool is_to_fetch = fetches(clusters, count, round);
	job.pool.run(count, 64, [&](int32_t begin, int32_t end) {
		for (int32_t id = begin; id < end; id++) {
			if (is_to_fetch)
				fetch_active(clusters, id, count, true);
			check_one(clusters, work, id, round);
		}
	});
}

extern const Stage events_clusters;
const Stage events_clusters{"events", "clusters",
	{{STAGE_SEEK, seek<float>, seek<double>}, {STAGE_RELEASE, release<float>, release<double>}, {STAGE_PAIR, pair<float>, pair<double>},
		{STAGE_MUSTER, muster<float>, muster<double>}, {STAGE_RESOLVE, resolve<float>, resolve<double>}, {STAGE_CHECK, check<float>, check<double>}},
	nullptr, nullptr};

}
