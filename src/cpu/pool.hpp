/* A few threads that wait for rows to work on. */
#ifndef CAROM_CPU_POOL_HPP
#define CAROM_CPU_POOL_HPP

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace carom::cpu {

class Pool
{
public:
	/* Rows `begin` to `end` - 1, on any thread; may throw where memory ends: then run does, when all threads are done. */
	using Work = std::function<void(int32_t begin, int32_t end)>;

	/* `threads` counts the caller too; 0: one a core. Where the system gives fewer there are fewer. */
	explicit Pool(uint32_t threads);
	~Pool();
	Pool(const Pool &) = delete;
	Pool &operator=(const Pool &) = delete;

	/* Does all `rows`, at most `chunk` at a time, and returns when they are done. Each thread begins with the same part of them in every job, whose memory
	 * it has near, and then helps others. The fewer are left the smaller the chunks, so that all threads end at about the same time. An eighth of a chunk
	 * should be worth waking another thread, some 2 us. The last rows of a part come first, for those of a triangle are the longest, and what is left at
	 * the end should be short. */
	void run(int32_t rows, int32_t chunk, const Work &work);

private:
	/* The part of a job that a thread begins with. */
	struct alignas(64) Range {
		int32_t begin = 0;
		std::atomic<int32_t> end{0}; /* behind the rows that nobody has taken */
	};

	void serve(size_t own);
	void open(const Work &work, int32_t rows, int32_t chunk);
	void close();
	bool join(uint32_t &seen);
	void leave();
	void take_chunks(size_t own);
	void take_chunks_of(Range &range);

	std::vector<std::thread> workers;
	/* Of a job; written before it is open. */
	const Work *job = nullptr;
	int32_t most = 0, least = 0; /* rows of a chunk */
	std::vector<Range> ranges;
	std::atomic<bool> failed{false};
	alignas(64) std::atomic<uint64_t> state{0}; /* number of the job, whether it is open, and how many workers are at it */
	/* Who has waited for long sleeps. */
	alignas(64) std::atomic<int32_t> sleepers{0};
	std::atomic<bool> caller_sleeps{false}, closing{false};
	std::mutex mutex;
	std::condition_variable wake, idle;
};

}

#endif
