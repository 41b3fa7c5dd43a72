/* Kernels that are kept in the folder CAROM_CACHE: built once, and built anew wherever something is wrong with a file. A file that is written gets another
 * inode, so `ls -i` tells whether kernels were built.
 * SPDX-License-Identifier: MIT */
#include "command.h"

/* R is the run, and draws, so that there are two programs: the step's and the picture's. */
static const char prefix[] = "R='run scenes/billiard_break.json --steps 20 --device opencl --png /dev/null --hash --quiet'; ";
static char expected[64]; /* what it prints without a cache */
static bool with_opencl;

static int look(void **state)
{
	char line[256];
	if (make_folder(state))
		return -1;
	with_opencl = has_opencl();
	if (with_opencl) {
		snprintf(line, sizeof line, "%s $C $R", prefix);
		check(line, 0, NULL);
		snprintf(expected, sizeof expected, "%.63s", call.out);
	}
	return 0;
}

static void run(const char *line)
{
	char text[1024];
	snprintf(text, sizeof text, "%s %s", prefix, line);
	check(text, 0, NULL);
	assert_string_equal(call.out, expected);
	assert_string_equal(call.err, "");
}

/* There are two files, and it is noted which; they are those that were noted. */
#define TWO_KEPT "ls -i $D/cache >$D/before && test $(ls -A $D/cache | wc -l) -eq 2"
#define KEPT "ls -i $D/cache | cmp -s - $D/before"

/* From an empty folder. */
static int begin(void **state)
{
	(void)state;
	if (!with_opencl)
		return 0;
	check("rm -rf $D/cache", 0, NULL);
	run("CAROM_CACHE=$D/cache $C $R");
	check(TWO_KEPT, 0, NULL);
	return 0;
}

static void kernels_are_built_once(void **unused)
{
	(void)unused;
	if (!with_opencl)
		skip();
	check("test -n \"$(find $D/cache -type d -perm 700)\"", 0, NULL);
	run("CAROM_CACHE=$D/cache $C $R");
	check(KEPT, 0, NULL);
	run("CAROM_CACHE= $C $R");
}

/* F is one file, G the other. */
static void broken_files_are_replaced(void **unused)
{
	(void)unused;
	static const char *const ways[] = {": >$F", "head -c 1000 $G >$F", "head -c 200000 $G >$F", "printf xyz | dd of=$F bs=1 seek=200000 conv=notrunc",
		"printf x >>$F", "cat $F >$D/copy; cat $G >$F", "head -c 9000000 /dev/zero >$F", "rm $F", "rm $F; ln -s nowhere $F"};
	if (!with_opencl)
		skip();
	for (size_t i = 0; i < COUNT(ways); i++) {
		char line[512];
		snprintf(line, sizeof line, "set -- $D/cache/*; F=$1; G=$2; ln -f $F $D/held; %s", ways[i]); /* so that no other file gets its inode */
		check(line, 0, NULL);
		run("CAROM_CACHE=$D/cache $C $R");
		if (shell(KEPT) == 0)
			fail_msg("after %s nothing was written", ways[i]);
		check("ls -i $D/cache >$D/before", 0, NULL);
		run("CAROM_CACHE=$D/cache $C $R");
		check(KEPT, 0, NULL);
	}
}

static void what_is_no_folder_is_none(void **unused)
{
	(void)unused;
	static const char *const folders[] = {"$D/file", "/dev/null", "$D/none/cache", "$(printf %05000d 0)"};
	if (!with_opencl)
		skip();
	check("echo text >$D/file", 0, NULL);
	for (size_t i = 0; i < COUNT(folders); i++) {
		char line[128];
		snprintf(line, sizeof line, "CAROM_CACHE=%s $C $R", folders[i]);
		run(line);
	}
	check("test text = $(cat $D/file) && test ! -e $D/none", 0, NULL);
	check("set -- $D/cache/*; rm $1; mkdir $1; ls -i $D/cache >$D/before", 0, NULL);
	run("CAROM_CACHE=$D/cache $C $R");
	check(KEPT, 0, NULL);
}

static void other_sources_are_other_files(void **unused)
{
	(void)unused;
	if (!with_opencl)
		skip();
	check("cp -r kernels $D/kernels && echo '/* changed */' >>$D/kernels/light.h", 0, NULL); /* of pictures */
	run("CAROM_KERNEL_DIR=$D/kernels CAROM_CACHE=$D/cache $C $R");
	check("test $(ls -A $D/cache | wc -l) -eq 3", 0, NULL);
	run("CAROM_CACHE=$D/cache $C $R --storage image");
	run("CAROM_CACHE=$D/cache $C $R --storage buffer");
	check("test $(ls -A $D/cache | wc -l) -eq 5", 0, NULL);
}

static void many_may_use_it_at_once(void **unused)
{
	(void)unused;
	if (!with_opencl)
		skip();
	check("rm -r $D/cache", 0, NULL);
	run("for i in 1 2 3 4 5 6; do CAROM_CACHE=$D/cache $C $R >$D/many$i 2>&1 & done; wait; cat $D/many* | sort -u");
	check(TWO_KEPT, 0, NULL);
	run("CAROM_CACHE=$D/cache $C $R");
	check(KEPT, 0, NULL);
}

int main(void)
{
	const struct CMUnitTest tests[] = {cmocka_unit_test_setup(kernels_are_built_once, begin),
		cmocka_unit_test_setup(broken_files_are_replaced, begin), cmocka_unit_test_setup(what_is_no_folder_is_none, begin),
		cmocka_unit_test_setup(other_sources_are_other_files, begin), cmocka_unit_test_setup(many_may_use_it_at_once, begin)};
	return cmocka_run_group_tests_name("cache", tests, look, remove_folder);
}
