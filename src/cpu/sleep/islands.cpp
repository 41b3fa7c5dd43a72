/* Who sleeps after a step, and who wakes since the host is about to change something. */
#include "cpu/still.hpp"

namespace carom::cpu {

/* After a step islands fall asleep that it left as they were, and bodies wake that something moved in their sleep. Or all wake, or it is forgotten that any slept. */
template <typename T> static void begin(const Job<T> &job)
{
	Rests<T> rests(job);
	rests.places = job.list(12);
	Slot<T> *slots = reinterpret_cast<Slot<T> *>(job.records(2));
	Kept<T> *kept = reinterpret_cast<Kept<T> *>(job.records(8));
	const Sleepers<T> sleepers{rests.touching, kept, rests.islands.parents, rests.status};
	const T length = whole_length(job.texels(1).fact(CLOCK_STEP, STEP_LENGTH), job.texels(0));
	const int32_t what = job.domain[3];
	if (what == SLEEP_BEGINS && (!rests.status[STATUS_BORNE] || rests.status[STATUS_PASS] > 0))
		return;
	const ReachKeeper<T> keeper(slots, job.records(9), rests.status, job.list(10), job.list(11), job.domain[2], job.texels(0));
	job.pool.run(job.domain[0], 256, [&](int32_t from, int32_t to) {
		for (int32_t s = from; s < to; s++) {
			const bool is_asleep = sleepers.sleeps(s);
			if (what == SLEEP_FORGOTTEN) {
				rests.touching[s].asleep = rests.touching[s].made = 0;
				continue;
			}
			if (is_asleep && (what == SLEEP_ENDS || !kept[s].stays(slots[s]))) {
				sleepers.wake(slots[s], s);
				sleepers.disturb(s);
				if (what == SLEEP_BEGINS)
					settle(rests, slots[s], s, rests.ground_of(s), kept, length);
			} else if (!is_asleep && what == SLEEP_BEGINS && rests.touching[s].count > 0 && !sleepers.is_disturbed(s))
				sleepers.fall_asleep(slots[s], s);
			if (is_asleep != sleepers.sleeps(s) && !rests.status[STATUS_STALE])
				keeper.pushed(s);
		}
	});
}

/* What the host changes wakes, with all of its island; what is static wakes all, for it moves, or begins to, where they may lean on it. */
template <typename T> static void end(const Job<T> &job)
{
	const Records<T> changes(job.records(0));
	const int32_t *places = job.list(1);
	const Slot<T> *slots = reinterpret_cast<const Slot<T> *>(job.records(2));
	int32_t *status = job.list(3);
	const Sleepers<T> sleepers{reinterpret_cast<Touching *>(job.list(4)), nullptr, job.list(5), status};
	for (int32_t k = 0; k < job.domain[0]; k++) {
		const int32_t s = places[static_cast<int32_t>(changes.of(CHANGES_WIDTH * k + CHANGES_TURN, CHANGE_BODY))];
		if (sleepers.sleeps(s)) {
			sleepers.disturb(s);
			sleepers.rouse(s);
		} else if (slots[s].is_static())
			status[STATUS_ROUSED] = 1;
	}
}

extern const Stage sleep_islands;
const Stage sleep_islands{
	"sleep", "islands", {{STAGE_SLEEP_BEGIN, begin<float>, begin<double>}, {STAGE_SLEEP_END, end<float>, end<double>}}, nullptr, nullptr};

}
