/* Calls of the carom command: its help, its version, and calls that are wrong.
 * SPDX-License-Identifier: MIT */
#include "command.h"

static void help_is_complete(void **state)
{
	(void)state;
	static const char *const names[] = {"run", "generate", "query", "devices", "stages"};
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
		assert_non_null(strstr(call.out, "--quiet"));
		assert_int_equal(strstr(call.out, "--device NAME") != NULL, !strcmp(names[k], "run") || !strcmp(names[k], "devices"));
		assert_string_equal(call.err, "");
	}
	check("$C generate --help | tr -s ' \\n' '  '", 0, "");
	assert_non_null(strstr(call.out, "--speed V 0 to 1e6:"));
	assert_non_null(strstr(call.out, "--radius R m, 1e-8 to 1e6,"));
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
		{"$C", "the command is missing; allowed: run, generate, query, devices, stages"},
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
		{"$C run scenes/mixed.json --time 0x10", "--time: found \"0x10\"; allowed: seconds, 0 or more"},
		{"$C run scenes/mixed.json --time ' 1'", "--time: found \" 1\"; allowed: seconds, 0 or more"},
		{"$C run scenes/mixed.json --time +1", "--time: found \"+1\"; allowed: seconds, 0 or more"},
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
		{"$C run scenes/mixed.json --png $D/p.png --inset 0,0,1,1,1", "--inset: found \"0,0,1,1,1\"; allowed: X,Y,W,H"},
		{"$C run scenes/mixed.json --png $D/p.png --inset '0, 0,1,1'", "--inset: found \"0, 0,1,1\"; allowed: X,Y,W,H"},
		{"$C run scenes/mixed.json --png $D/p.png --inset 0,0,0x1,1", "--inset: found \"0,0,0x1,1\"; allowed: X,Y,W,H"},
		{"$C run scenes/mixed.json --png $D/p.png --inset 0,1e39,1,1", "--inset: found \"0,1e39,1,1\"; allowed: X,Y,W,H"},
		{"$C run scenes/mixed.json --frames $D/f --fps 1e308", "--fps: found \"1e308\"; allowed: a number above 0, at most 1000000"},
		{"$C run scenes/mixed.json --frames $D/f --fps inf", "--fps: found \"inf\"; allowed: a number above 0"},
		{"$C run scenes/mixed.json --time 1e400", "--time: found \"1e400\"; allowed: seconds, 0 or more"},
		{"$C run scenes/mixed.json --steps 1 --steps 2", "--steps: found twice; allowed: once"},
		{"$C run scenes/mixed.json --steps=1 --steps 1", "--steps: found twice; allowed: once"},
		{"$C run scenes/mixed.json --set toi=bisection --set toi=separating",
			"--set: found \"toi=bisection\" and \"toi=separating\"; allowed: one a slot"},
		{"$C run scenes/mixed.json --out --png", "--out: the value is missing: --out STATE.json"},
		{"$C run scenes/mixed.json --out ''", "--out: found nothing; allowed: a text that is not empty"},
		{"$C run scenes/mixed.json --out $D/a --png $D/a", "/a: two of --out, --png, --stats, --hits, --states and --frames write there"},
		{"$C run scenes/mixed.json --out $D/a --png $D/./a", "/a: two of --out, --png, --stats, --hits, --states and --frames write there"},
		{"ln -s a $D/l; $C run scenes/mixed.json --stats $D/a --png $D/l; code=$?; rm $D/l; exit $code",
			"/a: two of --out, --png, --stats, --hits, --states and"},
		{"ln -s a $D/l; touch $D/a; $C run scenes/mixed.json --out $D/l --png $D/a; code=$?; rm $D/a $D/l; exit $code", "/a: two of --out, "},
		{"mkdir $D/f; $C run scenes/mixed.json --png $D/f/frame_000001.png --frames $D/./f; code=$?; rmdir $D/f; exit $code", "_000001.png: two of"},
		{"$C run scenes/mixed.json --out /dev/stdout --png $D/out", "two of --out, --png, --stats, --hits, --states and --frames write there"},
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
		{"$C run scenes/mixed.json --device abacus", "; `carom devices` tells more of them"},
		{"CAROM_DEVICE=abacus $C run scenes/mixed.json", "CAROM_DEVICE: there is no device 'abacus'"},
		{"$C run no/such/scene.json", "no/such/scene.json: can't be read: No such file"},
		{"$C run tests", "tests: can't be read: Is a directory"},
		{"$C run tests/bad/radius_negative.json", "bodies[1].circle.radius: found -1; allowed: a number above 0"},
		{"$C run tests/bad/polygon_touching_itself.json", "bodies[1].polygon.vertices: the polygon crosses or touches itself"},
		{"$C run /dev/zero", "/dev/zero:1:1: not valid JSON: found a NUL byte"},
		{"mkfifo $D/pipe && { echo '{' >$D/pipe & $C run $D/pipe; }; code=$?; rm $D/pipe; exit $code", "/pipe:2:0: not valid JSON"},
		{"printf '{\"a\": 1}\\0' | $C run -", "/dev/stdin:1:9: not valid JSON: found a NUL byte"},
		{"$C run - --steps 0", "/dev/stdin:1:0: not valid JSON"},
		{"$C generate --count 3", "--shape is missing"},
		{"$C generate --shape circle", "--count is missing"},
		{"$C generate --shape oval --count 3", "--shape: found \"oval\"; allowed: triangle, square, regular:K, star:K, circle, mixed"},
		{"$C generate --shape regular:2 --count 3", "allowed: regular:K with K sides, 3 to 64"},
		{"$C generate --shape star:33 --count 3", "allowed: star:K with K points, 3 to 32"},
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
		{"$C generate --shape circle --count 1 --set toi=bisection", "--set: no such option: `carom generate --help` lists them"},
		{"$C generate --shape circle --count 1 --device cpu", "--device: no such option: `carom generate --help` lists them"},
		{"$C stages --storage image", "--storage: no such option: `carom stages --help` lists them"},
		{"$C devices here", "one argument too many"},
		{"$C devices --device cpu", "--device and --storage need --check"},
		{"$C devices --storage image", "--device and --storage need --check"},
		{"$C devices --set toi=bisection", "--device, --storage and --set change nothing in the list"},
	};
	for (size_t k = 0; k < COUNT(calls); k++) {
		check(calls[k].line, 2, calls[k].said);
		if (strncmp(call.err, "carom: ", 7) != 0 || *call.out)
			fail_msg("%s: stdout \"%s\", stderr \"%s\"", calls[k].line, call.out, call.err);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(help_is_complete), cmocka_unit_test(version_is_the_librarys), cmocka_unit_test(wrong_calls_exit_with_2)};
	return cmocka_run_group_tests_name("calls", tests, make_folder, remove_folder);
}
