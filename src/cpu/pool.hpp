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

	/* Does all `rows`, at most `chunk` at a time, and returns when they are done. Where there are few rows the chunks are smaller, but an
	 * eighth at least: that should be worth handing to another thread, some 2 us. The last rows come first, for those of a triangle are the
	 * longest, and what is left at the end should be short. */
	void run(int32_t rows, int32_t chunk, const Work &work);

private:
	void serve();
	void take_chunks(const Work &work);
	template <typename Condition> static void wait_awake(Condition condition);

	std::vector<std::thread> workers;
	std::mutex mutex;
	std::condition_variable wake, idle;
	const Work *job = nullptr; /* none: nobody may join in */
	std::atomic<uint64_t> jobs{0};
	std::atomic<size_t> busy{0};
	std::atomic<bool> closing{false};
	int32_t chunk_size = 0;
	std::atomic<int32_t> left{0}; /* rows that nobody has taken */
	std::atomic<bool> failed{false};
};

}

#endif
