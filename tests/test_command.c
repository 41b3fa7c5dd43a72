/* The carom command from outside: what it says, what it writes, and its exit codes. How it is called is in test_calls.c.
 * SPDX-License-Identifier: MIT */
#include "command.h"

static void devices_and_stages_are_listed(void **state)
{
	(void)state;
	check("$C devices", 0, "");
	assert_non_null(strstr(call.out, ", the default\n"));
	assert_non_null(strstr(call.out, "works"));
	check("$C stages", 0, "");
	assert_non_null(strstr(call.out, "step       first_impact"));
	assert_non_null(strstr(call.out, "toi        bisection            yes      yes      yes     \n"));
	assert_non_null(strstr(call.out, "events     clusters             yes      yes      no       default\n"));
	assert_non_null(strstr(call.out, "default"));
	check("$C stages >/dev/full", 1, "standard output can't be written");
}

/* ---- Runs ---- */

/* A run of 40 steps with all its outputs; what it prints is its hash. */
static void check_outputs(const char *device)
{
	char line[512], stats[65536], hash[32], png[64];
	snprintf(line, sizeof line,
		"$C run scenes/mixed.json --steps 40 --out $D/state.json --png=$D/picture.png --stats $D/table.csv "
		"--hash --size 320x180 --inset -2,-2,4,4 --device %s",
		device);
	check(line, 0, "40 steps");
	assert_int_equal(strlen(call.out), 17);
	assert_int_equal(strspn(call.out, "0123456789abcdef"), 16);
	snprintf(hash, sizeof hash, "%.20s", call.out);
	assert_null(strchr(call.err, '\r')); /* no bar where there is no terminal */
	read_into("table.csv", stats, sizeof stats);
	assert_int_equal(strncmp(stats,
						 "step,time_s,advanced_s,hits,kinetic_energy_j,potential_energy_j,momentum_x,momentum_y,"
						 "angular_momentum,max_penetration_m,held,ruled\n1,",
						 122),
		0);
	int lines = 0;
	for (const char *at = stats; *at; at++)
		lines += *at == '\n';
	assert_int_equal(lines, 41);
	read_into("picture.png", png, sizeof png);
	assert_memory_equal(png, "\x89PNG\r\n\x1A\n", 8);
	check("$C run $D/state.json --steps 0 --hash --quiet --device cpu", 0, NULL);
	assert_string_equal(call.out, hash);
	assert_string_equal(call.err, "");
	/* neither rows, frames, the chunks they make, nor stopping and resuming change a bit */
	snprintf(line, sizeof line, "$C run scenes/mixed.json --steps 40 --hash --device %s", device);
	check(line, 0, NULL);
	assert_string_equal(call.out, hash);
	snprintf(line, sizeof line, "$C run scenes/mixed.json --steps 40 --frames $D/frames --fps 500 --size 64x36 --hash --device %s", device);
	check(line, 0, "frames into");
	assert_string_equal(call.out, hash);
	snprintf(line, sizeof line,
		"$C run scenes/mixed.json --steps 15 --quiet --out $D/half.json --device %s && "
		"$C run $D/half.json --steps 25 --quiet --hash --device %s",
		device, device);
	check(line, 0, "");
	assert_string_equal(call.out, hash);
	check("rm -r $D/frames $D/*.json $D/*.csv $D/*.png", 0, "");
}

static void outputs_are_written_on_the_cpu(void **state)
{
	(void)state;
	check_outputs("cpu");
}

static void outputs_are_written_on_opencl(void **state)
{
	(void)state;
	if (!has_opencl())
		skip();
	check_outputs("opencl");
	check_outputs("opencl --storage buffer");
}

static void frames_are_at_equal_times(void **state)
{
	(void)state;
	check("$C run scenes/billiard_break.json --time 0.1 --frames $D/frames --fps 50 --size 64x32 --png $D/last.png --device cpu", 0,
		"wrote 6 frames");
	assert_null(strstr(call.err, "before"));
	check("ls $D/frames", 0, "");
	assert_string_equal(call.out, "frame_000000.png\nframe_000001.png\nframe_000002.png\nframe_000003.png\nframe_000004.png\nframe_000005.png\n");
	check("cmp $D/last.png $D/frames/frame_000005.png && ! cmp -s $D/last.png $D/frames/frame_000004.png && rm $D/last.png", 0, "");
	check("$C run scenes/billiard_break.json --time 0.05 --frames $D/frames --fps 50 --size 64x32 --device cpu", 0,
		"frame_000003.png and what follows it were there before");
	check("rm -r $D/frames; mkdir -p $D/frames/frame_000003.png", 0, "");
	check("$C run scenes/mixed.json --time 0.2 --frames $D/frames --fps 50 --size 640x360 --device cpu", 1,
		"frame_000003.png: can't be written: Is a directory");
	assert_non_null(strstr(call.err, "wrote 3 frames"));
	check("rm -r $D/frames", 0, "");
}

/* A ball that falls in a scene without room and camera: the first picture is filled by it, and then it is gone. */
/* A ball of 30,000 m/s in a gap of a centimetre. */
static void what_was_held_is_said(void **state)
{
	(void)state;
	check("echo '{\"format\": \"carom-scene/1\", \"room\": {\"min\": [0, 0], \"max\": [2.01, 10]}, \"bodies\": "
		  "[{\"circle\": {\"radius\": 1}, \"position\": [1.005, 5], \"velocity\": [30000, 0]}]}' | $C run - --steps 3 --device cpu",
		0, "3 times a body was hit too often in a step, and held");
}

/* Drivers may be broken, and take their time. */
static void the_cpu_needs_no_driver(void **state)
{
	(void)state;
	check("LD_DEBUG=files $C run scenes/mixed.json --steps 1 --quiet --device cpu 2>&1 | grep libOpenCL", 1, "");
	assert_string_equal(call.out, "");
}

static void a_film_has_one_camera(void **state)
{
	(void)state;
	check("echo '{\"format\": \"carom-scene/1\", \"gravity\": [0, -10], \"bodies\": [{\"circle\": {\"radius\": 0.5}}]}' >$D/s.json; "
		  "$C run $D/s.json --time 1 --frames $D/f --fps 10 --size 32x32 --png $D/last.png --device cpu",
		0, "the frames show where the bodies are at the start; a \"camera\" in the scene shows more");
	check("cmp -s $D/f/frame_000000.png $D/f/frame_000001.png", 1, "");
	check("cmp -s $D/f/frame_000001.png $D/f/frame_000009.png", 1, "");
	check("cmp $D/f/frame_000009.png $D/last.png && cmp $D/f/frame_000009.png $D/f/frame_000010.png", 0, "");
	check("$C run $D/s.json --time 1 --png $D/last.png --size 32x32 --device cpu --quiet && cmp $D/f/frame_000000.png $D/last.png", 0, "");
	check("rm -r $D/f $D/s.json $D/last.png", 0, "");
}

/* Else its box is empty, and nobody knows why. */
static void an_inset_outside_the_picture_is_told(void **state)
{
	(void)state;
	check("$C run scenes/mixed.json --steps 0 --png $D/p.png --size 64x36 --inset 17,0,2,2 --device cpu", 0,
		"--inset: this part lies outside of the picture");
	check("$C run scenes/mixed.json --steps 0 --png $D/p.png --size 64x36 --inset 0,-12,2,2 --device cpu", 0, "shows 18.4 m of height about (0, 0)");
	check("$C run scenes/mixed.json --steps 0 --png $D/p.png --size 64x36 --inset 15,-10,2,2 --device cpu; rm $D/p.png", 0, NULL);
	assert_null(strstr(call.err, "--inset"));
}

static void a_scene_may_come_through_a_pipe(void **state)
{
	(void)state;
	char hash[32];
	check("$C generate --shape circle --count 16 | $C run - --steps 10 --hash --device cpu", 0, "/dev/stdin: 16 bodies");
	snprintf(hash, sizeof hash, "%.20s", call.out);
	check("$C generate --shape circle --count 16 --out $D/s.json --quiet && $C run $D/s.json --steps 10 --hash --quiet --device "
		  "cpu",
		0, "");
	assert_string_equal(call.out, hash);
	assert_string_equal(call.err, "");
	check("rm $D/s.json", 0, "");
}

/* After `read` the rest is the scene: standard input is not opened anew. */
static void a_scene_may_be_what_is_left_of_a_file(void **state)
{
	(void)state;
	check("{ echo first; cat scenes/mixed.json; } >$D/s.json; { read x; $C run - --steps 0 --quiet; } <$D/s.json", 0, "");
	check("rm $D/s.json; $C run - <&-", 2, "/dev/stdin: can't be read: Bad file descriptor");
}

static void standard_output_is_gone_on_with(void **state)
{
	(void)state;
	check("echo first >$D/t; $C run scenes/mixed.json --steps 2 --stats /dev/stdout --quiet --device cpu >>$D/t; cut -c 1-9 $D/t", 0, "");
	assert_string_equal(call.out, "first\nstep,time\n1,0.01666\n2,0.03333\n");
	check("ln -s /dev/stdout $D/l; $C run scenes/mixed.json --steps 2 --out $D/l --hash --quiet --device cpu >$D/t; tail -n 1 $D/t >$D/h; "
		  "sed '$d' $D/t >$D/s; $C run $D/s --steps 0 --hash --quiet --device cpu | cmp - $D/h",
		0, "");
	check("test -L $D/l; $C run scenes/mixed.json --steps 2 --out - --quiet --device cpu | cmp - $D/s", 0, "");
	check("$C run scenes/mixed.json --steps 2 --out - --stats - --quiet --device cpu | tail -n +4 | cmp - $D/s", 0, "");
	check("$C run scenes/mixed.json --steps 2 --out - --stats - --hash --quiet --device cpu >$D/t; head -c 4 $D/t; tail -n 1 $D/t | cmp - $D/h", 0,
		"");
	assert_string_equal(call.out, "step");
	check("$C generate --shape circle --count 9 --out - --quiet >$D/t; $C generate --shape circle --count 9 --quiet | cmp - $D/t", 0, "");
	check("rm $D/l $D/t $D/h $D/s", 0, "");
}

/* What bodies have, and the step does nothing with, is no error, but said. */
static void what_does_nothing_is_said(void **unused)
{
	(void)unused;
	check("printf '%s' '{\"format\": \"carom-scene/1\", \"rolling_friction\": 0.1, \"angular_damping\": 1, '"
		  "'\"bodies\": [{\"circle\": {\"radius\": 1}}]}' >$D/brakes.json",
		0, NULL);
	check("$C run $D/brakes.json --device cpu --steps 1", 0, "rolling_friction does nothing by the step events");
	check("$C run $D/brakes.json --device cpu --steps 1 --set step=first_impact", 0, "angular_damping do nothing by the step first_impact");
	check("$C run $D/brakes.json --device cpu --steps 1 --set step=contacts 2>&1 | grep -c nothing", 1, NULL);
}

/* A row a hit: when, of whom with whom, where and how. Calls, frames, rows of the steps change none. */
static void hits_are_told(void **state)
{
	(void)state;
	check("$C run scenes/newtons_cradle.json --time 1.5 --hits - --quiet --device cpu | cut -d, -f2-3,6-10", 0, "");
	assert_string_equal(call.out,
		"body,other,normal_x,normal_y,impulse_x_ns,impulse_y_ns,ruled\n1,0,1,-0,0.0628318563,-0,0\n2,1,1,-0,0.0628318563,-0,0\n"
		"3,2,1,-0,0.0628318563,-0,0\n4,3,1,-0,0.0628318563,-0,0\n5,4,1,-0,0.0628318563,-0,0\n5,right,-1,0,-0.125663713,0,0\n");
	check("$C run scenes/mixed.json --steps 600 --hits $D/h --device cpu", 0, "h\n");
	check("$C run scenes/mixed.json --steps 600 --hits $D/i --stats $D/t --frames $D/frames --fps 1 --size 64x36 --quiet --device cpu; cut -d, -f2- "
		  "$D/h >$D/s; "
		  "cut -d, -f2- $D/i | cmp - $D/s && sed 1d $D/h | wc -l; cut -d, -f4 $D/t | awk '{ n += $1 } END { print n }'",
		0, "");
	const unsigned long rows = strtoul(call.out, NULL, 10);
	assert_true(rows > 500 && strtoul(strchr(call.out, '\n'), NULL, 10) == rows);
	check("$C run scenes/mixed.json --steps 1 --hits - --stats /dev/stdout", 2, "--stats and --hits: both tables go to /dev/stdout");
	check("$C run scenes/mixed.json --steps 1 --hits $D/t --stats $D/t", 2,
		"two of --out, --png, --stats, --hits, --states and --frames write there");
	check("cp scenes/mixed.json $D/i; $C run $D/i --steps 1 --hits $D/i", 2, "--hits would replace the scene");
	check("$C run scenes/mixed.json --steps 60 --hits /dev/full --device cpu", 1, "/dev/full: can't be written");
	check("rm -r $D/frames $D/h $D/i $D/t $D/s", 0, "");
}

/* The scene that is read may be where the state goes. */
static void a_state_may_replace_its_scene(void **state)
{
	(void)state;
	check("cp scenes/mixed.json $D/s; for i in 1 2; do $C run $D/s --steps 2 --out $D/s --quiet --device cpu; done; "
		  "$C run $D/s --steps 0 --hash --quiet --device cpu >$D/h; $C run scenes/mixed.json --steps 4 --hash --quiet --device cpu | cmp - $D/h",
		0, "");
	check("rm $D/s $D/h", 0, "");
}

/* What is closed is an error, and no file that is opened takes its place. */
static void a_closed_output_is_an_error(void **state)
{
	(void)state;
	check("$C run scenes/mixed.json --time 1e9 --device cpu --out /dev/fd/9", 1, "/dev/fd/9: can't be written: Bad file descriptor");
	check("$C run scenes/mixed.json --steps 1 --device cpu --quiet --hash --stats $D/t >&-", 1, "standard output can't be written: Bad file");
	check("wc -l <$D/t; rm $D/t", 0, "");
	assert_string_equal(call.out, "2\n");
}

/* The reader opens it once. */
static void a_named_pipe_may_be_written(void **state)
{
	(void)state;
	check("mkfifo $D/p; cat $D/p >$D/s & timeout 60 $C run scenes/mixed.json --steps 1 --device cpu --out $D/p && wait && "
		  "$C run $D/s --steps 0 --device cpu; code=$?; : <>$D/p; rm $D/p $D/s; exit $code",
		0, "");
}

static void failures_exit_with_1_and_keep_the_old(void **state)
{
	(void)state;
	check("echo old >$D/old", 0, "");
	check("$C run scenes/mixed.json --steps 1 --device cpu --out $D/old --png $D/no/p.png", 1, "no/p.png: can't be written: No such file");
	check("$C run scenes/mixed.json --time 1e9 --device cpu --out $D", 1, "can't be written: Is a directory");
	check("$C run scenes/mixed.json --steps 1 --device cpu --frames $D/old", 1, "can't be made a folder");
	check("cat $D/old", 0, "");
	assert_string_equal(call.out, "old\n");
	check("rm $D/old; ls $D", 0, "");
	assert_string_equal(call.out, "err\nout\n");
	if (access("/dev/full", W_OK) != 0)
		return;
	check("$C run scenes/mixed.json --steps 1 --device cpu --out /dev/full", 1, "/dev/full: can't be written: No space left");
	check("$C run scenes/mixed.json --steps 1 --device cpu --png /dev/full", 1, "/dev/full: can't be written");
	check("$C run scenes/mixed.json --steps 1 --device cpu --stats /dev/full", 1, "/dev/full: can't be written");
	check("$C run scenes/mixed.json --steps 1 --device cpu --hash --quiet >/dev/full", 1, "standard output can't be written");
	check("$C generate --shape circle --count 100 --out /dev/full", 1, "/dev/full: can't be written");
}

/* A time that is a small part of a step is a step cut short, not none. */
static void any_time_can_be_run(void **state)
{
	(void)state;
	check("$C run scenes/mixed.json --time 1e-9 --device cpu", 0, " 0 hits, 1e-09 s simulated");
	check("sed 's|\"bodies\"|\"time_step\": 1e6, &|' scenes/newtons_cradle.json | $C run - --time 0.1 --device cpu", 0, " 0.1 s simulated");
	check("$C run scenes/mixed.json --time 1e-37 --out $D/s.json --quiet --device cpu && $C run $D/s.json --steps 1 --quiet --device cpu", 0, "");
	check("rm $D/s.json", 0, "");
}

static void an_interruption_writes_what_there_is(void **state)
{
	(void)state;
	char state_text[65536];
	check("$C run scenes/mixed.json --time 1e6 --device cpu --hash --out $D/state.json --stats $D/table.csv & pid=$!; sleep 1; "
		  "kill -TERM $pid; wait $pid",
		143, "interrupted after");
	assert_int_equal(strlen(call.out), 17);
	read_into("state.json", state_text, sizeof state_text);
	check("$C run $D/state.json --steps 1 --quiet --device cpu && tail -c 1 $D/table.csv", 0, "");
	assert_string_equal(call.out, "\n");
	check("rm $D/state.json $D/table.csv", 0, "");
}

/* A machine with an OpenCL loader and no driver, and one without a loader: two files that are no libraries stand for none. */
static void without_opencl_the_cpu_works(void **state)
{
	(void)state;
	static const char *const machines[] = {
		"mkdir -p $D/none && OCL_ICD_VENDORS=$D/none",
		"mkdir -p $D/broken && : >$D/broken/libOpenCL.so && : >$D/broken/libOpenCL.so.1 && LD_LIBRARY_PATH=$D/broken",
	};
	char line[512], hash[64];
	check("$C run scenes/thin_wall.json --steps 5 --hash --device cpu", 0, "runs on Carom: cpu");
	snprintf(hash, sizeof hash, "%.63s", call.out);
	for (size_t i = 0; i < COUNT(machines); i++) {
		snprintf(line, sizeof line, "%s $C run scenes/thin_wall.json --steps 5 --hash --device auto", machines[i]);
		check(line, 0, "runs on Carom: cpu");
		assert_string_equal(call.out, hash);
		snprintf(line, sizeof line, "%s $C run scenes/thin_wall.json --steps 5 --device opencl", machines[i]);
		check(line, 2, "there is no device 'opencl'; use auto, cpu, opencl or part of one of these names: 'cpu");
		assert_non_null(strstr(call.err, "no OpenCL device was found"));
		snprintf(line, sizeof line, "%s $C devices", machines[i]);
		check(line, 0, NULL);
		assert_ptr_equal(strstr(call.out, "Carom: cpu"), call.out);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(devices_and_stages_are_listed), cmocka_unit_test(outputs_are_written_on_the_cpu),
		cmocka_unit_test(outputs_are_written_on_opencl), cmocka_unit_test(frames_are_at_equal_times), cmocka_unit_test(what_was_held_is_said),
		cmocka_unit_test(the_cpu_needs_no_driver), cmocka_unit_test(a_film_has_one_camera), cmocka_unit_test(an_inset_outside_the_picture_is_told),
		cmocka_unit_test(a_scene_may_come_through_a_pipe), cmocka_unit_test(a_scene_may_be_what_is_left_of_a_file), cmocka_unit_test(hits_are_told),
		cmocka_unit_test(standard_output_is_gone_on_with), cmocka_unit_test(a_state_may_replace_its_scene),
		cmocka_unit_test(a_closed_output_is_an_error), cmocka_unit_test(a_named_pipe_may_be_written),
		cmocka_unit_test(failures_exit_with_1_and_keep_the_old), cmocka_unit_test(any_time_can_be_run), cmocka_unit_test(what_does_nothing_is_said),
		cmocka_unit_test(an_interruption_writes_what_there_is), cmocka_unit_test(without_opencl_the_cpu_works)};
	return cmocka_run_group_tests_name("command", tests, make_folder, remove_folder);
}
