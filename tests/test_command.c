/* The carom command from outside: exit codes, what it says, what it writes.
 * SPDX-License-Identifier: MIT */
#include "command.h"

/* ---- Calls ---- */

static void help_is_complete(void **state)
{
	(void)state;
	static const char *const names[] = {"run", "generate", "devices", "stages"};
	static const char *const run_options[] = {"--steps N", "--time SECONDS", "--out STATE.json", "--png FRAME.png", "--frames DIR", "--fps F",
		"--stats FILE.csv", "--hash", "--size WxH", "--inset X,Y,W,H", "--device NAME", "--storage KIND", "--set SLOT=NAME", "--quiet", "--help",
		"--version"};
	char line[64];
	check("$C --help", 0, "");
	assert_string_equal(call.err, "");
	for (size_t k = 0; k < COUNT(names); k++)
		assert_non_null(strstr(call.out, names[k]));
	for (size_t k = 0; k < COUNT(names); k++) {
		snprintf(line, sizeof line, "$C %s --help", names[k]);
		check(line, 0, "");
		assert_non_null(strstr(call.out, "--device NAME"));
		assert_string_equal(call.err, "");
	}
	check("$C run nothing.json --help", 0, "");
	for (size_t k = 0; k < COUNT(run_options); k++)
		assert_non_null(strstr(call.out, run_options[k]));
}

static void version_is_the_librarys(void **state)
{
	(void)state;
	char wanted[64];
	snprintf(wanted, sizeof wanted, "carom %s\n", carom_version());
	check("$C --version", 0, "");
	assert_string_equal(call.out, wanted);
	check("$C run --version", 0, "");
	assert_string_equal(call.out, wanted);
}

static void wrong_calls_exit_with_2(void **state)
{
	(void)state;
	static const struct {
		const char *line, *said;
	} calls[] = {
		{"$C", "the command is missing; allowed: run, generate, devices, stages"},
		{"$C rum", "rum: no such command; allowed: run, generate"},
		{"$C run", "SCENE.json is missing"},
		{"$C run scenes/mixed.json scenes/mixed.json", "one argument too many"},
		{"$C run scenes/mixed.json --step 3", "--step: no such option"},
		{"$C run scenes/mixed.json -s 3", "-s: no such option"},
		{"$C run scenes/mixed.json --steps", "--steps: the value is missing"},
		{"$C run scenes/mixed.json --steps -1", "--steps: found \"-1\"; allowed: a whole number"},
		{"$C run scenes/mixed.json --steps 1e3", "--steps: found \"1e3\"; allowed: a whole number"},
		{"$C run scenes/mixed.json --steps 99999999999999999999", "allowed: a whole number"},
		{"$C run scenes/mixed.json --steps 18446744073709551615", "allowed: a whole number from 0 to 18446744073709551614"},
		{"$C run scenes/mixed.json --time nan", "--time: found \"nan\"; allowed: seconds, 0 or more"},
		{"$C run scenes/mixed.json --steps 1 --time 1", "--steps and --time exclude each other"},
		{"$C run scenes/mixed.json --fps 25", "--fps needs --frames"},
		{"$C run scenes/mixed.json --frames $D/f --fps 0", "--fps: found \"0\"; allowed: a number above 0"},
		{"$C run scenes/mixed.json --size 640x480", "--size needs a picture"},
		{"$C run scenes/mixed.json --png $D/p.png --size 640", "--size: found \"640\"; allowed: WxH"},
		{"$C run scenes/mixed.json --png $D/p.png --size 0x480", "allowed: WxH in pixels, each 1 to 16384"},
		{"$C run scenes/mixed.json --png $D/p.png --inset 0,0,1", "--inset: found \"0,0,1\"; allowed: X,Y,W,H"},
		{"$C run scenes/mixed.json --png $D/p.png --inset 0,0,1,0", "allowed: X,Y,W,H"},
		{"$C run scenes/mixed.json --png $D/p.png --inset nan,0,1,1", "--inset: found \"nan,0,1,1\"; allowed: X,Y,W,H"},
		{"$C run scenes/mixed.json --png $D/p.png --inset 0,0,1e400,1", "--inset: found \"0,0,1e400,1\"; allowed: X,Y,W,H"},
		{"$C run scenes/mixed.json --frames $D/f --fps 1e308", "--fps: found \"1e308\"; allowed: a number above 0, at most 1000000"},
		{"$C run scenes/mixed.json --frames $D/f --fps inf", "--fps: found \"inf\"; allowed: a number above 0"},
		{"$C run scenes/mixed.json --time 1e400", "--time: found \"1e400\"; allowed: seconds, 0 or more"},
		{"$C run scenes/mixed.json --steps 1 --steps 2", "--steps: found twice; allowed: once"},
		{"$C run scenes/mixed.json --steps=1 --steps 1", "--steps: found twice; allowed: once"},
		{"$C run scenes/mixed.json --set toi=bisection --set toi=separating",
			"--set: found \"toi=bisection\" and \"toi=separating\"; allowed: one a slot"},
		{"$C run scenes/mixed.json --out --png", "--out: the value is missing: --out STATE.json"},
		{"$C run scenes/mixed.json --out ''", "--out: found nothing; allowed: a text that is not empty"},
		{"$C run scenes/mixed.json --out $D/a --png $D/a", "/a: two of --out, --png, --stats and --frames write there"},
		{"$C run scenes/mixed.json --out $D/a --png $D/./a", "/a: two of --out, --png, --stats and --frames write there"},
		{"ln -s a $D/l; $C run scenes/mixed.json --stats $D/a --png $D/l; code=$?; rm $D/l; exit $code", "/a: two of --out, --png, --stats and"},
		{"ln -s a $D/l; touch $D/a; $C run scenes/mixed.json --out $D/l --png $D/a; code=$?; rm $D/a $D/l; exit $code", "/a: two of --out, "},
		{"mkdir $D/f; $C run scenes/mixed.json --png $D/f/frame_000001.png --frames $D/./f; code=$?; rmdir $D/f; exit $code", "_000001.png: two of"},
		{"$C run scenes/mixed.json --out /dev/stdout --png $D/out", "two of --out, --png, --stats and --frames write there"},
		{"touch $D/a; ln $D/a $D/l; $C run scenes/mixed.json --out $D/l --png $D/a; code=$?; rm $D/a $D/l; exit $code", "/a: two of --out, "},
		{"$C run tests/bad/array.json --png tests/bad/../bad/array.json", "tests/bad/array.json: --png would replace the scene; only --out may"},
		{"ln -s $PWD/tests/bad/array.json $D/l; $C run tests/bad/array.json --stats $D/l; code=$?; rm $D/l; exit $code", "--stats would replace the"},
		{"$C run - --png tests/bad/array.json <tests/bad/array.json", "/dev/stdin: --png would replace the scene"},
		{"mkdir $D/f; : >$D/f/frame_1.png; $C run $D/f/frame_1.png --frames $D/f; code=$?; rm -r $D/f; exit $code", "--frames would replace the"},
		{"$C run scenes/mixed.json --frames -", "--frames: found \"-\", which would be standard output; allowed: a name; ./- is one"},
		{"$C bench table1 --csv $D/c --plot $D/./c", "/c: --csv and --plot write there; give each a name of its own"},
		{"$C bench all --csv $D/c-table2 --plot $D/c", "/c-table2: --csv and --plot write there"},
		{"$C bench table1 --csv -", "--csv: found \"-\", which would be standard output"},
		{"$C run scenes/mixed.json --quiet=yes", "--quiet takes no value"},
		{"$C run scenes/mixed.json --storage disk", "--storage: found \"disk\"; allowed: image, buffer"},
		{"$C run scenes/mixed.json --set toi", "--set: found \"toi\"; allowed: slot=alternative"},
		{"$C run scenes/mixed.json --set toi=guess", "circle_quadratic"},
		{"$C run scenes/mixed.json --set tio=bisection", "toi"},
		{"$C run scenes/mixed.json --device abacus", "abacus"},
		{"CAROM_DEVICE=abacus $C run scenes/mixed.json", "CAROM_DEVICE: there is no device 'abacus'"},
		{"$C run no/such/scene.json", "no/such/scene.json: can't be read: No such file"},
		{"$C run tests", "tests: can't be read: Is a directory"},
		{"$C run tests/bad/radius_negative.json", "bodies[1].circle.radius: found -1; allowed: a number above 0"},
		{"$C run tests/bad/polygon_concave.json", "bodies[1].polygon.vertices"},
		{"$C run /dev/zero", "/dev/zero:1:1: not valid JSON: found a NUL byte"},
		{"mkfifo $D/pipe && { echo '{' >$D/pipe & $C run $D/pipe; }; code=$?; rm $D/pipe; exit $code", "/pipe:2:0: not valid JSON"},
		{"printf '{\"a\": 1}\\0' | $C run -", "/dev/stdin:1:9: not valid JSON: found a NUL byte"},
		{"$C run - --steps 0", "/dev/stdin:1:0: not valid JSON"},
		{"$C generate --count 3", "--shape is missing"},
		{"$C generate --shape circle", "--count is missing"},
		{"$C generate --shape oval --count 3", "--shape: found \"oval\"; allowed: triangle, square, regular:K, circle, mixed"},
		{"$C generate --shape regular:2 --count 3", "allowed: regular:K with K sides, 3 to 64"},
		{"$C generate --shape circle --count 4194305", "--count: found \"4194305\"; allowed: a whole number from 1 to 4194304"},
		{"$C generate --shape circle --count 100 --fill 0.95", "can't be packed to a fill of 0.95; allowed: up to 0.7"},
		{"$C generate --shape circle --count 1e3", "--count: found \"1e3\"; allowed: a whole number from 1 to 4194304"},
		{"$C generate --shape circle --count -1", "--count: found \"-1\"; allowed: a whole number from 1 to 4194304"},
		{"$C generate --shape circle --count 1 --radius 1e-40", "--radius: found 1e-40; allowed: 1e-8 to 1e6"},
		{"$C generate --shape circle --count 1 --speed 1e40", "--speed: found 1e+40; allowed: 0 to 1e6"},
		{"$C generate --shape circle --count 1 --speed nan", "--speed: found \"nan\"; allowed: a number, 0 or more"},
		{"$C generate --shape circle --count 1 --seed -1", "--seed: found \"-1\"; allowed: a whole number"},
		{"$C generate --shape circle --count 100 --fill 0", "--fill: found \"0\"; allowed: a number above 0"},
		{"$C generate --shape circle --count 100 --fill 1e-20", "so wide that floats"},
		{"$C devices here", "one argument too many"},
	};
	for (size_t k = 0; k < COUNT(calls); k++) {
		check(calls[k].line, 2, calls[k].said);
		if (strncmp(call.err, "carom: ", 7) != 0 || *call.out)
			fail_msg("%s: stdout \"%s\", stderr \"%s\"", calls[k].line, call.out, call.err);
	}
}

static void devices_and_stages_are_listed(void **state)
{
	(void)state;
	check("$C devices", 0, "");
	assert_non_null(strstr(call.out, ", the default\n"));
	assert_non_null(strstr(call.out, "works"));
	check("$C stages", 0, "");
	assert_non_null(strstr(call.out, "step       first_impact"));
	assert_non_null(strstr(call.out, "toi"));
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
	check("$C generate --shape circle --count 9 --out - --quiet >$D/t; $C generate --shape circle --count 9 --quiet | cmp - $D/t", 0, "");
	check("rm $D/l $D/t $D/h $D/s", 0, "");
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
	const struct CMUnitTest tests[] = {cmocka_unit_test(help_is_complete), cmocka_unit_test(version_is_the_librarys),
		cmocka_unit_test(wrong_calls_exit_with_2), cmocka_unit_test(devices_and_stages_are_listed), cmocka_unit_test(outputs_are_written_on_the_cpu),
		cmocka_unit_test(outputs_are_written_on_opencl), cmocka_unit_test(frames_are_at_equal_times), cmocka_unit_test(a_film_has_one_camera),
		cmocka_unit_test(a_scene_may_come_through_a_pipe), cmocka_unit_test(a_scene_may_be_what_is_left_of_a_file),
		cmocka_unit_test(standard_output_is_gone_on_with), cmocka_unit_test(a_state_may_replace_its_scene),
		cmocka_unit_test(a_closed_output_is_an_error), cmocka_unit_test(a_named_pipe_may_be_written),
		cmocka_unit_test(failures_exit_with_1_and_keep_the_old), cmocka_unit_test(any_time_can_be_run),
		cmocka_unit_test(an_interruption_writes_what_there_is), cmocka_unit_test(without_opencl_the_cpu_works)};
	return cmocka_run_group_tests_name("command", tests, make_folder, remove_folder);
}
