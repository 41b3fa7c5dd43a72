/* Interruptions of the command: what was asked for is written, and can be gone on with; a second one ends it at once.
 * SPDX-License-Identifier: MIT */
#include "command.h"

#include <dirent.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/stat.h>
#include <time.h>

#define MOST_SECONDS 60 /* that anything is waited for: machines may be busy */

static void pause_shortly(void)
{
	const struct timespec time = {.tv_nsec = 5000000};
	nanosleep(&time, NULL);
}

/* Starts a shell line, which is to `exec` the command; what a shell runs in the background would ignore SIGINT. */
static pid_t start(const char *line)
{
	char text[4096];
	const char *build = getenv("CAROM_BUILD");
	snprintf(text, sizeof text, "C='%s/carom'; D='%s'; exec >\"$D/out\" 2>\"$D/err\" </dev/null; %s", build ? build : "build", call.folder, line);
	const pid_t process = fork();
	if (process == 0) {
		signal(SIGINT, SIG_DFL);
		signal(SIGTERM, SIG_DFL);
		signal(SIGHUP, SIG_DFL);
		execl("/bin/sh", "sh", "-c", text, (char *)NULL);
		_exit(127);
	}
	assert_true(process > 0);
	return process;
}

/* The status of waitpid. */
static int end_of(pid_t process)
{
	int status = 0;
	assert_int_equal(waitpid(process, &status, 0), process);
	read_into("out", call.out, sizeof call.out);
	read_into("err", call.err, sizeof call.err);
	return status;
}

static void give_up(pid_t process, const char *what)
{
	kill(process, SIGKILL);
	end_of(process);
	fail_msg("%s: it never came; the command said\n%s", what, call.err);
}

/* How many files have a name that begins so. */
static int count_files(const char *folder, const char *begins)
{
	DIR *opened = opendir(folder);
	const struct dirent *entry;
	int count = 0;
	while (opened && (entry = readdir(opened)))
		count += strncmp(entry->d_name, begins, strlen(begins)) == 0;
	if (opened)
		closedir(opened);
	return count;
}

static void wait_for_file(pid_t process, const char *within, const char *begins)
{
	char folder[128];
	snprintf(folder, sizeof folder, "%s/%s", call.folder, within);
	for (int k = 0; k < MOST_SECONDS * 200; k++) {
		if (count_files(folder, begins) > 0)
			return;
		pause_shortly();
	}
	give_up(process, begins);
}

static void assert_code(int status, int code)
{
	if (!WIFEXITED(status) || WEXITSTATUS(status) != code)
		fail_msg("expected exit code %d, got status %d and\n%s", code, status, call.err);
}

static void a_run_can_be_gone_on_with(const char *device, int number)
{
	char line[512], hash[32];
	unsigned long long steps = 0;
	snprintf(line, sizeof line,
		"exec $C run scenes/mixed.json --steps 100000000 --device %s --frames $D/film --png $D/p.png --stats $D/t.csv --states $D/a.npy "
		"--out $D/s.json --hash",
		device);
	const pid_t process = start(line);
	wait_for_file(process, "film", "frame_000001.png");
	kill(process, number);
	assert_code(end_of(process), 128 + number);
	const char *said = strstr(call.err, "interrupted after ");
	assert_non_null(said);
	assert_int_equal(sscanf(said, "interrupted after %llu steps", &steps), 1);
	assert_true(steps > 0);
	snprintf(hash, sizeof hash, "%.20s", call.out);
	snprintf(line, sizeof line, "$C run scenes/mixed.json --steps %llu --hash --quiet --device %s", steps, device);
	check(line, 0, "");
	assert_string_equal(call.out, hash);
	snprintf(line, sizeof line, "$C run scenes/mixed.json --steps %llu --hash --quiet --device %s", steps + 10, device);
	check(line, 0, "");
	snprintf(hash, sizeof hash, "%.20s", call.out);
	snprintf(line, sizeof line, "$C run $D/s.json --steps 10 --hash --quiet --device %s", device);
	check(line, 0, "");
	assert_string_equal(call.out, hash);
	snprintf(line, sizeof line, "test $(wc -l <$D/t.csv) -eq %llu && head -c 4 $D/p.png | tail -c 3", steps + 1);
	check(line, 0, "");
	assert_string_equal(call.out, "PNG");
	check("n=$(ls $D/film | wc -l); test $(wc -c <$D/a.npy) -eq $((128 + n * 111 * 24)) && head -c 128 $D/a.npy | grep -q \"($n, 111, 6)\"", 0, "");
	check("rm -r $D/film $D/p.png $D/t.csv $D/a.npy $D/s.json; ls $D", 0, "");
	assert_string_equal(call.out, "err\nout\n");
}

static void what_was_asked_for_is_written(void **state)
{
	(void)state;
	a_run_can_be_gone_on_with("cpu", SIGINT);
	a_run_can_be_gone_on_with("cpu", SIGTERM);
	a_run_can_be_gone_on_with("cpu", SIGHUP);
	if (has_opencl())
		a_run_can_be_gone_on_with("opencl", SIGINT);
}

/* Until there is something to read; that a writer came and went is nothing. */
static void wait_for_bytes(pid_t process, int descriptor)
{
	for (int k = 0; k < MOST_SECONDS * 200; k++) {
		struct pollfd pipe = {descriptor, POLLIN, 0};
		if (poll(&pipe, 1, 0) == 1 && pipe.revents & POLLIN)
			return;
		pause_shortly();
	}
	give_up(process, "the state");
}

/* The first is answered by writing into a pipe that nobody reads. */
static void a_second_one_ends_it_at_once(void **state)
{
	(void)state;
	char path[128];
	snprintf(path, sizeof path, "%s/pipe", call.folder);
	assert_int_equal(mkfifo(path, 0600), 0);
	const int pipe = open(path, O_RDONLY | O_NONBLOCK);
	assert_true(pipe >= 0);
	const pid_t process = start("exec $C run scenes/triangles_1024.json --steps 100000000 --device cpu --frames $D/film --out $D/pipe");
	wait_for_file(process, "film", "frame_000001.png");
	kill(process, SIGINT);
	wait_for_bytes(process, pipe);
	kill(process, SIGINT);
	const int status = end_of(process);
	assert_true(WIFSIGNALED(status) && WTERMSIG(status) == SIGINT);
	close(pipe);
	check("rm -r $D/film $D/pipe", 0, "");
}

/* Nothing of it is written: half a scene or table is none. */
static void the_other_commands_leave_files_alone(void **state)
{
	(void)state;
	static const char *const lines[] = {"exec $C generate --shape circle --count 200000 --out $D/new",
		"exec $C bench table1 --device cpu --sizes 64,128,256,512 --runs 9 --seconds 0.02 --csv $D/new"};
	for (size_t k = 0; k < COUNT(lines); k++) {
		const pid_t process = start(lines[k]);
		wait_for_file(process, "", "carom.tmp.");
		kill(process, SIGINT);
		assert_code(end_of(process), 130);
		assert_non_null(strstr(call.err, "interrupted"));
		assert_int_equal(count_files(call.folder, "new") + count_files(call.folder, "carom.tmp."), 0);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(what_was_asked_for_is_written), cmocka_unit_test(a_second_one_ends_it_at_once),
		cmocka_unit_test(the_other_commands_leave_files_alone)};
	return cmocka_run_group_tests_name("interrupt", tests, make_folder, remove_folder);
}
