#include "cpu/pool.hpp"

#include "device.h"

#include <algorithm>
#include <exception>
#include <new>

namespace carom::cpu {

constexpr int32_t chunks_a_range = 2;        /* that what is left of it should make */
constexpr int most_yields = 50, polls = 500; /* some 50 us */

/* Of Pool::state: a job's number times `numbers`, `is_open`, and the workers at it. */
constexpr uint64_t is_open = uint64_t(1) << 31, numbers = uint64_t(1) << 32;

static uint32_t number_of(uint64_t state)
{
	return static_cast<uint32_t>(state / numbers);
}

static bool are_at_it(uint64_t state)
{
	return state % is_open != 0;
}

/* What is awaited often comes at once, as stage follows stage: sooner than a thread that sleeps can be woken. */
template <typename Condition> static void wait_awake(const Condition &condition)
{
	for (int i = 0; i < most_yields; i++) {
		for (int k = 0; k < polls; k++) {
			if (condition())
				return;
		}
		std::this_thread::yield();
	}
}

Pool::Pool(uint32_t threads)
{
	if (threads == 0)
		threads = std::thread::hardware_concurrency();
	threads = std::clamp<uint32_t>(threads, 1, CAROM_MOST_THREADS);
	ranges = std::vector<Range>(threads);
	workers.reserve(threads - 1);
	try {
		while (workers.size() + 1 < threads)
			workers.emplace_back(&Pool::serve, this, workers.size() + 1);
	} catch (const std::exception &) {
		/* There are no more threads to be had; the others do the work. */
	}
}

Pool::~Pool()
{
	{
		std::lock_guard<std::mutex> lock(mutex);
		closing = true;
	}
	wake.notify_all();
	for (std::thread &worker : workers)
		worker.join();
}

void Pool::run(int32_t rows, int32_t chunk, const Work &work)
{
	if (rows <= std::max(chunk / 8, 1) || workers.empty()) {
		for (int32_t begin = 0; begin < rows; begin += chunk) /* what is kept of a chunk is never more than that */
			work(begin, begin + std::min(chunk, rows - begin));
		return;
	}
	open(work, rows, chunk);
	take_chunks(0);
	close();
	if (failed)
		throw std::bad_alloc();
}

void Pool::open(const Work &work, int32_t rows, int32_t chunk)
{
	job = &work;
	most = chunk;
	least = std::max(chunk / 32, 1);
	const int64_t many = static_cast<int64_t>(ranges.size());
	int64_t i = 0;
	for (Range &range : ranges) {
		range.begin = static_cast<int32_t>(rows * i / many);
		range.end = static_cast<int32_t>(rows * ++i / many);
	}
	failed = false;
	state = number_of(state + numbers) * numbers + is_open;
	if (sleepers > 0) {
		std::lock_guard<std::mutex> lock(mutex); /* who has looked in vain does sleep by now */
		wake.notify_all();
	}
}

/* Nobody may join in any more; those who did are waited for. */
void Pool::close()
{
	const auto are_done = [this] { return !are_at_it(state); };
	state &= ~is_open;
	wait_awake(are_done);
	if (are_done())
		return;
	std::unique_lock<std::mutex> lock(mutex);
	caller_sleeps = true;
	idle.wait(lock, are_done);
	caller_sleeps = false;
}

/* True for each job once, if it is still open. */
bool Pool::join(uint32_t &seen)
{
	uint64_t now = state;
	while ((now & is_open) && number_of(now) != seen) {
		if (!state.compare_exchange_weak(now, now + 1))
			continue;
		seen = number_of(now);
		return true;
	}
	return false;
}

void Pool::leave()
{
	const uint64_t now = --state;
	if (!are_at_it(now) && caller_sleeps) {
		std::lock_guard<std::mutex> lock(mutex);
		idle.notify_one();
	}
}

/* First of its own range, then of those that others have not done. */
void Pool::take_chunks(size_t own)
{
	for (size_t i = 0; i < ranges.size(); i++)
		take_chunks_of(ranges[(own + i) % ranges.size()]);
}

void Pool::take_chunks_of(Range &range)
{
	int32_t end = range.end;
	while (end > range.begin) {
		const int32_t rest = end - range.begin, size = std::min(std::clamp(rest / chunks_a_range, least, most), rest);
		if (!range.end.compare_exchange_weak(end, end - size))
			continue;
		try {
			(*job)(end - size, end);
		} catch (const std::exception &) {
			failed = true;
		}
		end = range.end;
	}
}

void Pool::serve(size_t own)
{
	uint32_t seen = 0;
	bool has_joined = false;
	const auto is_needed = [&] { return closing || (has_joined = join(seen)); };
	for (;;) {
		wait_awake(is_needed);
		if (!has_joined && !closing) {
			std::unique_lock<std::mutex> lock(mutex);
			sleepers++;
			wake.wait(lock, is_needed);
			sleepers--;
		}
		if (!has_joined)
			return;
		take_chunks(own);
		leave();
		has_joined = false;
	}
}

}
