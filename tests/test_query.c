/* carom query: its tables, where its rays come from, and what it refuses.
 * SPDX-License-Identifier: MIT */
#include "command.h"

/* A disc with a name that a table has to quote, and a box. */
static int make_scene(void **state)
{
	return make_folder(state)
		|| shell("cat >\"$D/s.json\" <<'E'\n"
				 "{\"format\": \"carom-scene/1\", \"time_step\": 0.125, \"room\": {\"min\": [-5, -5], \"max\": [5, 5]}, \"bodies\": [\n"
				 "{\"circle\": {\"radius\": 1}, \"name\": \"a \\\"disc\\\", red\", \"velocity\": [4, 0]},\n"
				 "{\"polygon\": {\"vertices\": [[-1, -1], [1, -1], [1, 1], [-1, 1]]}, \"position\": [3, 0], \"name\": \"box\", \"static\": true,\n"
				 "\"categories\": 6}]}\n"
				 "E\n"
				 "true");
}

static void check_table(const char *line, const char *table)
{
	check(line, 0, NULL);
	assert_string_equal(call.out, table);
	assert_string_equal(call.err, "");
}

#define RAYS "ray,met,part,x_m,y_m,normal_x,normal_y,name\n"

static void a_ray_meets_what_is_first(void **unused)
{
	(void)unused;
	check_table("$C query $D/s.json --ray 0,4,0,0", RAYS "1,0,0.75,0,1,0,1,\"a \"\"disc\"\", red\"\n");
	check_table("$C query $D/s.json --ray 0,4,0,0,0.5", RAYS "1,0,0.625,0,1,0,1,\"a \"\"disc\"\", red\"\n");
	check_table("$C query $D/s.json --ray=-4,-4,-4,4", RAYS "1,nothing,1,-4,4,0,0,\n");
	check_table("$C query - --ray -4,-4,-4,-6 <$D/s.json", RAYS "1,bottom,0.5,-4,-5,0,1,\n");
}

static void many_rays_come_from_a_file(void **unused)
{
	(void)unused;
	const char *table = RAYS "1,right,0.25,5,3,-1,0,\n2,1,0.5,3,1,0,1,box\n3,1,0.25,3,1,0,1,box\n4,left,0.5,-5,0,1,0,\n";
	check_table("printf 'from x,from y,to x,to y\\n4,3,8,3\\n3,3,3,-1\\r\\n\\n3,3,3,-1,1\\n-4,0,-6,0' >$D/rays.csv; $C query $D/s.json --rays "
				"$D/rays.csv",
		table);
	check_table("$C query $D/s.json --rays - <$D/rays.csv", table);
	check_table("$C query $D/s.json --rays /dev/null", RAYS);
	check_table("seq 100 | sed 's/.*/-4,-4,-4,-6/' >$D/rays.csv; $C query $D/s.json --rays $D/rays.csv | tail -n 1", "100,bottom,0.5,-4,-5,0,1,\n");
}

/* Not what it touches where it is, nor itself; a body that is not hit is not met. */
static void a_body_meets_what_is_first(void **unused)
{
	(void)unused;
	const char *const columns = "body,met,part,x_m,y_m,normal_x,normal_y,name\n";
	char table[256];
	snprintf(table, sizeof table, "%s0,1,0.25,2,0,-1,0,box\n", columns);
	check_table("$C query $D/s.json --move 0,4,0", table);
	snprintf(table, sizeof table, "%s1,0,0.25,1,0,1,0,\"a \"\"disc\"\", red\"\n", columns);
	check_table("$C query $D/s.json --move 1,-1,0", table);
	snprintf(table, sizeof table, "%s0,top,0.5,0,5,0,-1,\n", columns);
	check_table("$C query $D/s.json --move 0,0,8", table);
	snprintf(table, sizeof table, "%s1,nothing,1,3,3,0,0,\n", columns);
	check_table("$C query $D/s.json --move 1,3,3", table);
	check_table("$C query $D/s.json --move 0,3.5,0 --mask 1 | cut -d, -f 1-3", "body,met,part\n0,nothing,1\n");
	check_table("sed 's/\"categories\": 6/\"mask\": 0/' $D/s.json | $C query - --move 0,3.5,0 | cut -d, -f 1-3", "body,met,part\n0,nothing,1\n");
}

static void bodies_are_at_a_place(void **unused)
{
	(void)unused;
	check_table("$C query $D/s.json --point 0.5,0.5", "body,name\n0,\"a \"\"disc\"\", red\"\n");
	check_table("$C query $D/s.json --point 0.9,0.9", "body,name\n");
	check_table("$C query $D/s.json --box 0.5,-0.25,2,0.5", "body,name\n0,\"a \"\"disc\"\", red\"\n1,box\n");
	check_table("$C query $D/s.json --box 2,1,0,0", "body,name\n1,box\n");
	check_table("$C query $D/s.json --touching 0", "body,name\n");
	check_table("sed 's/\"position\": .3/\"position\": [1.9/' $D/s.json | $C query - --touching 0", "body,name\n1,box\n");
	check_table("sed 's/\"position\": .3/\"position\": [1.9/' $D/s.json | $C query - --touching 1", "body,name\n0,\"a \"\"disc\"\", red\"\n");
}

static void a_body_is_nearest(void **unused)
{
	(void)unused;
	const char *const columns = "body,distance_m,x_m,y_m,normal_x,normal_y,name\n";
	char table[256];
	snprintf(table, sizeof table, "%s0,2,-1,0,-1,0,\"a \"\"disc\"\", red\"\n", columns);
	check_table("$C query $D/s.json --nearest -3,0", table);
	snprintf(table, sizeof table, "%s1,5,4,1,0.600000024,0.800000012,box\n", columns);
	check_table("$C query $D/s.json --nearest 7,5", table);
	snprintf(table, sizeof table, "%s1,0,2.5,0.5,0,0,box\n", columns);
	check_table("$C query $D/s.json --nearest 2.5,0.5", table);
	check_table("echo '{\"format\": \"carom-scene/1\", \"bodies\": []}' | $C query - --nearest 0,0", columns);
}

static void bodies_are_left_out(void **unused)
{
	(void)unused;
	check_table("$C query $D/s.json --ray 4,0,0,0 --mask 1 | cut -d, -f 1-5", "ray,met,part,x_m,y_m\n1,0,0.75,1,0\n");
	check_table("$C query $D/s.json --box -5,-5,10,10 --mask 0x1 | cut -d, -f 1", "body\n0\n");
	check_table("$C query $D/s.json --box -5,-5,10,10 --mask 4 | cut -d, -f 1", "body\n1\n");
	check_table("$C query $D/s.json --box -5,-5,10,10 --mask 0xFFFFffff | cut -d, -f 1", "body\n0\n1\n");
	check_table("$C query $D/s.json --box -5,-5,10,10 --mask 8", "body,name\n");
}

/* What runs is asked as any scene is. */
static void a_state_is_a_scene(void **unused)
{
	(void)unused;
	check_table("$C run $D/s.json --steps 1 --device cpu --quiet --out - | $C query - --ray -4,0,4,0 | cut -d, -f 1-5",
		"ray,met,part,x_m,y_m\n1,0,0.4375,-0.5,0\n");
}

static void wrong_questions_are_errors(void **unused)
{
	(void)unused;
	check("$C query", 2, "query: SCENE.json is missing");
	check("$C query $D/s.json", 2, "nothing is asked; give one of --ray, --rays, --move, --box, --point, --touching and --nearest");
	check("$C query $D/s.json --point 0,0 --ray 0,0,1,1", 2, "several things are asked at once");
	check("$C query $D/s.json --ray 0,0,1", 2, "--ray: found \"0,0,1\"; allowed: X,Y,X,Y");
	check("$C query $D/s.json --ray 0,0,1,1,-1", 2, "--ray: found");
	check("$C query $D/s.json --ray 0,0,1,1,1,1", 2, "--ray: found");
	check("$C query $D/s.json --ray 0,0,1,nan", 2, "--ray: found");
	check("$C query $D/s.json --point 0", 2, "--point: found \"0\"; allowed: X,Y");
	check("$C query $D/s.json --nearest 0,1,2", 2, "--nearest: found \"0,1,2\"; allowed: X,Y");
	check("$C query $D/s.json --nearest 0,1 --point 0,1", 2, "several things are asked at once");
	check("$C query $D/s.json --move 0,1", 2, "--move: found \"0,1\"; allowed: BODY,X,Y");
	check("$C query $D/s.json --move 0.5,1,1", 2, "--move: found");
	check("$C query $D/s.json --move 2,1,1", 2, "--move: there is no body 2; the scene has 2");
	check("$C query $D/s.json --touching=-1", 2, "--touching: found \"-1\"; allowed: a body's index");
	check("$C query $D/s.json --touching 1 --move 1,0,0", 2, "several things are asked at once");
	check("$C query $D/s.json --box 0,0,-1,1", 2, "--box: found \"0,0,-1,1\"; allowed: X,Y,W,H");
	static const char *const masks[] = {"", "-1", "4294967296", "0x", "0x1G", "0x100000000", "1.5", "1 ", "99999999999999999999"};
	for (size_t i = 0; i < COUNT(masks); i++) {
		char line[128];
		snprintf(line, sizeof line, "$C query $D/s.json --point 0,0 --mask '%s'", masks[i]);
		check(line, 2, "--mask: ");
	}
	check("$C query $D/s.json --box 3e38,0,3e38,1", 2, "box: found");
	check("printf 'a,b\\n0,0,1,1\\n0,0,1\\n' | $C query $D/s.json --rays -", 2, "/dev/stdin:3: found \"0,0,1\"");
	check("printf '0,0,1\\n' | $C query $D/s.json --rays -", 2, "/dev/stdin:1: found \"0,0,1\"");
	check("printf '0,0,1,1\\n0,0,1,%0600d\\n' 1 | $C query $D/s.json --rays -", 2, "/dev/stdin:2: found \"0,0,1,000");
	check("$C query $D/s.json --rays $D/none.csv", 2, "none.csv: No such file");
	check("$C query $D/s.json --rays $D", 2, "Is a directory");
	check("$C query $D/none.json --point 0,0", 2, "none.json");
	check("$C query - --rays - <$D/s.json", 2, "the scene and --rays are the same");
	check("$C query $D/s.json --rays $D/s.json", 2, "the scene and --rays are the same");
	check("$C query $D/s.json --point 0,0 --device cpu", 2, "--device: no such option");
	if (access("/dev/full", W_OK) == 0)
		check("$C query $D/s.json --point 0,0 >/dev/full", 1, "standard output can't be written");
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test(a_ray_meets_what_is_first), cmocka_unit_test(many_rays_come_from_a_file),
		cmocka_unit_test(a_body_meets_what_is_first), cmocka_unit_test(bodies_are_at_a_place), cmocka_unit_test(a_body_is_nearest),
		cmocka_unit_test(bodies_are_left_out), cmocka_unit_test(a_state_is_a_scene), cmocka_unit_test(wrong_questions_are_errors)};
	return cmocka_run_group_tests_name("query", tests, make_scene, remove_folder);
}
