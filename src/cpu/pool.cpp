#include "cpu/pool.hpp"

#include <algorithm>
#include <exception>
#include <new>

namespace carom::cpu {

constexpr uint32_t most_threads = 256; /* a mistyped number should not take the machine down */
constexpr int32_t chunks_a_thread = 2; /* at least, so that all end at about the same time */
constexpr int most_yields = 100;       /* some 50 us */

Pool::Pool(uint32_t threads)
{
	if (threads == 0)
		threads = std::thread::hardware_concurrency();
	threads = std::clamp(threads, 1u, most_threads);
	workers.reserve(threads - 1);
	try {
		while (workers.size() + 1 < threads)
			workers.emplace_back(&Pool::serve, this);
	} catch (const std::exception &) {
		/* There are no more threads to be had; the caller can do all the work. */
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

/* What is awaited often comes at once, as stage follows stage: sooner than a thread that sleeps can be woken. */
template <typename Condition> void Pool::wait_awake(Condition condition)
{
	for (int i = 0; i < most_yields && !condition(); i++)
		std::this_thread::yield();
}

void Pool::run(int32_t rows, int32_t chunk, const Work &work)
{
	const int32_t least = std::max(chunk / 8, 1), shares = chunks_a_thread * static_cast<int32_t>(workers.size() + 1);
	if (rows <= least || workers.empty()) {
		if (rows > 0)
			work(0, rows);
		return;
	}
	{
		std::lock_guard<std::mutex> lock(mutex);
		job = &work;
		chunk_size = std::clamp(rows / shares, least, chunk);
		left = rows;
		failed = false;
		jobs++;
	}
	wake.notify_all();
	take_chunks(work);
	wait_awake([this] { return busy == 0; });
	std::unique_lock<std::mutex> lock(mutex);
	job = nullptr; /* who wakes only now is not waited for */
	idle.wait(lock, [this] { return busy == 0; });
	if (failed)
		throw std::bad_alloc();
}

void Pool::take_chunks(const Work &work)
{
	for (;;) {
		int32_t end = left.fetch_sub(chunk_size);
		if (end <= 0)
			return;
		try {
			work(std::max(end - chunk_size, 0), end);
		} catch (const std::exception &) {
			failed = true;
		}
	}
}

void Pool::serve()
{
	uint64_t seen = 0;
	for (;;) {
		wait_awake([&] { return closing || jobs != seen; });
		std::unique_lock<std::mutex> lock(mutex);
		wake.wait(lock, [&] { return closing || (job && jobs != seen); });
		if (closing)
			return;
		seen = jobs;
		busy++;
		const Work &work = *job;
		lock.unlock();
		take_chunks(work);
		lock.lock();
		if (--busy == 0)
			idle.notify_one();
	}
}

}
