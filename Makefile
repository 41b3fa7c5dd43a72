# Carom's build, for GNU make: `make help` lists what it can do.

BUILD ?= build
PREFIX ?= /usr/local
LIBDIR ?= $(PREFIX)/lib
PKG_CONFIG ?= pkg-config
CC_FOR_BUILD ?= $(CC)
DOXYGEN ?= doxygen
CAIRO ?= yes
BOX2D ?= $(call yes_if,$(PKG_CONFIG) --exists 'box2d >= 2.4' 'box2d < 3')
CHIPMUNK ?= $(call yes_if,printf '%s\n' '$(hash)include <chipmunk/chipmunk.h>' '$(hash)if CP_VERSION_MAJOR != 7' '$(hash)error' \
	'$(hash)endif' | $(CC) $(CPPFLAGS) -E -)
OPTIMIZE ?= -O3
WERROR ?= -Werror

# Until GCC 14 and LLVM 17 LeakSanitizer takes what lies before a thread's own memory for a header that glibc had until 2.24 if it lies at a certain place
# in its page, follows it, and now and then dies ("Tracer caught signal 11"): leaks are found without it.
LEAKS := detect_leaks=1:intercept_tls_get_addr=0

# Reports name files and lines, which are all of -g1; with all of -g a build takes half as long again.
ifeq ($(SANITIZE),thread)
override BUILD := $(BUILD)/sanitize-thread
OPTIMIZE := -O1 -g1
SANITIZERS := -fsanitize=thread -fno-omit-frame-pointer
else ifneq ($(SANITIZE),)
override BUILD := $(BUILD)/sanitize
OPTIMIZE := -O1 -g1
SANITIZERS := -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer
export ASAN_OPTIONS ?= $(LEAKS):detect_stack_use_after_return=1:strict_string_checks=1
export LSAN_OPTIONS ?= suppressions=tests/lsan.supp:print_suppressions=0
export UBSAN_OPTIONS ?= print_stacktrace=1
LOADED := $(BUILD)/tests/sanitize/loaded.o
endif

# As many jobs as there are cores, unless the user or a make above says otherwise.
ifeq ($(MAKELEVEL)$(filter -j%,$(MAKEFLAGS)),0)
MAKEFLAGS += -j$(shell nproc 2>/dev/null || getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1)
endif

# What is done in a line; V=1 shows the commands.
say = $(if $(V),,@printf '%-5s %s\n' $(1) $@;)

SYSTEM := $(shell uname -s)
VERSION_PARTS := $(foreach part,MAJOR MINOR PATCH,$(shell sed -n 's/^.define CAROM_VERSION_$(part) //p' include/carom.h))
ABI := $(firstword $(VERSION_PARTS))
empty :=
VERSION := $(subst $(empty) ,.,$(strip $(VERSION_PARTS)))

# yes where the command succeeds, else no
yes_if = $(if $(shell { $(1); } >/dev/null 2>&1 && echo yes),yes,no)
hash := \#

# ---- What there is: adding a file edits nothing here

KERNELS := $(sort $(wildcard kernels/*.h kernels/*/*.cl))
STAGES := $(sort $(wildcard src/cpu/*/*.cpp))
LIBRARY := $(sort $(wildcard src/*.c src/step/*.c src/cl/*.c src/cpu/*.cpp)) $(STAGES)
COMMAND := $(sort $(filter-out tools/carom_peer_%,$(wildcard tools/carom*.c)))
ifeq ($(CAIRO),no)
COMMAND := $(filter-out tools/carom_plot%.c,$(COMMAND)) tools/without_cairo.c
endif
# The engines beside Carom in `carom bench scale`, `tunnel`, `heap` and `rays`, where they are installed.
BOX2D := $(BOX2D)
CHIPMUNK := $(CHIPMUNK)
COMMAND += $(if $(filter no,$(BOX2D)),tools/without_box2d.c,tools/carom_peer_box2d.cpp)
COMMAND += $(if $(filter no,$(CHIPMUNK)),tools/without_chipmunk.c,tools/carom_peer_chipmunk.c)
TESTS := $(sort $(wildcard tests/test_*.c))
ifeq ($(SYSTEM),Darwin) # whose linker can't wrap calls; `check` says so
TESTS := $(filter-out tests/test_faults_%,$(TESTS))
endif
HELPERS := $(filter-out $(TESTS),$(sort $(wildcard tests/*.c)))
# What makes calls fail, for tests/test_faults_*.
FAULTS := $(sort $(wildcard tests/faults/*.c tests/faults/*.cpp))
# What is fed made-up input: by libFuzzer, or by replay.c, which has the main that libFuzzer brings itself.
FUZZERS := $(sort $(wildcard tests/fuzz/fuzz_*.c))
FUZZ_HELPERS := $(filter-out $(FUZZERS) tests/fuzz/replay.c,$(sort $(wildcard tests/fuzz/*.c)))

object = $(patsubst %,$(BUILD)/%.o,$(basename $(1)))
LIBRARY_OBJECTS := $(call object,$(LIBRARY)) $(BUILD)/kernels.o $(BUILD)/cpu_stages.o
COMMAND_OBJECTS := $(call object,$(COMMAND))
TEST_PROGRAMS := $(patsubst %.c,$(BUILD)/%,$(TESTS))
HELPER_OBJECTS := $(call object,$(HELPERS))
FUZZ_PROGRAMS := $(patsubst %.c,$(BUILD)/%,$(FUZZERS))
FUZZ_OBJECTS := $(call object,$(FUZZ_HELPERS) $(if $(LIBFUZZER),,tests/fuzz/replay.c))
OBJECTS := $(LIBRARY_OBJECTS) $(COMMAND_OBJECTS) $(call object,$(TESTS) $(FAULTS) $(FUZZERS)) $(HELPER_OBJECTS) $(FUZZ_OBJECTS)

# ---- Flags

system_includes = $(patsubst -I%,-isystem %,$(shell $(PKG_CONFIG) --cflags $(1) 2>/dev/null))
EIGEN := $(call system_includes,eigen3)
PACKAGES := $(call system_includes,libpng) $(call system_includes,jansson) $(call system_includes,OpenCL-Headers)
CMOCKA := $(call system_includes,cmocka)
CAIRO_INCLUDES := $(call system_includes,cairo)
CAIRO_LIBRARIES := $(if $(filter no,$(CAIRO)),,$(shell $(PKG_CONFIG) --libs cairo 2>/dev/null))
LIBRARIES := $(shell $(PKG_CONFIG) --libs libpng jansson 2>/dev/null) -ldl -lpthread -lm
BOX2D_INCLUDES := $(call system_includes,box2d) -DBOX2D_VERSION='"$(shell $(PKG_CONFIG) --modversion box2d 2>/dev/null)"'
PEER_LIBRARIES := $(if $(filter no,$(BOX2D)),,$(shell $(PKG_CONFIG) --libs box2d 2>/dev/null)) $(if $(filter no,$(CHIPMUNK)),,-lchipmunk)
CMOCKA_LIBRARIES := $(shell $(PKG_CONFIG) --libs cmocka 2>/dev/null)

# The same bits everywhere rests on these, so they come after what the user sets.
# (GCC 12's SLP vectoriser loses the rounding of (double)(float)x for pairs of numbers.)
EXACT := -fno-tree-slp-vectorize -ffp-contract=off -fno-fast-math -fno-math-errno -fno-trapping-math
# (Clang warns where it makes no vectors, as with sanitizers.)
WARNINGS := -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-pass-failed $(WERROR)
COMMON := $(OPTIMIZE) -fopenmp-simd -fPIC -fvisibility=hidden -pthread -MMD -MP $(SANITIZERS)
INCLUDES := -Iinclude -Isrc -Ikernels
C11 := -std=c11 -D_POSIX_C_SOURCE=200809L -D_XOPEN_SOURCE=700
ALL_CFLAGS = $(C11) $(COMMON) $(WARNINGS) -Wmissing-prototypes -Wstrict-prototypes \
	$(INCLUDES) $(PACKAGES) $(CPPFLAGS) $(CFLAGS) $(EXACT)
# (How vectors of numbers are passed is a matter of the library alone.)
ALL_CXXFLAGS = -std=c++17 $(COMMON) -fvisibility-inlines-hidden $(WARNINGS) -Wno-psabi $(INCLUDES) $(PACKAGES) $(CPPFLAGS) $(CXXFLAGS) $(EXACT)
# C++ with no CFLAGS: a compiler that links with -Ofast makes the whole process flush denormals.
LINK = $(CXX) -pthread $(SANITIZERS) $(LDFLAGS)

ifeq ($(SYSTEM),Darwin)
SHARED := -dynamiclib -Wl,-install_name,@rpath/libcarom.so.$(ABI) -Wl,-exported_symbol,_carom_*
else
SHARED := -shared -Wl,-soname,libcarom.so.$(ABI) -Wl,--version-script=$(BUILD)/exports.map $(if $(SANITIZERS),,-Wl,--no-undefined)
endif

# ---- Targets

all: $(BUILD)/carom $(BUILD)/libcarom.a $(BUILD)/libcarom.so

help:
	@echo 'make                 build the command, the static and the shared library into build/'
	@echo 'make demo            run scenes and write their pictures into build/demo/'
	@echo 'make check           build and run the tests and the checks of the source'
	@echo 'make static          ask Clang, clang-format, clang-tidy, cppcheck and doxygen what they find in the source'
	@echo 'make doc             render include/carom.h, the manual of the library, into build/doc/html/'
	@echo 'make check-threads   build and run what has threads with the thread sanitizer'
	@echo 'make conformance     run the tests on every OpenCL implementation that is installed, and from several compilers'
	@echo 'make fuzz            feed made-up scenes and calls to the library, with clang and libFuzzer, FUZZ_SECONDS=600 each'
	@echo 'make wild            run made-up worlds on every device and ask for one outcome, WILD_SECONDS=600, from world WILD_SEED=1 on'
	@echo 'make bench           measure the tables of the paper, scale, tunnel, heap and rays, and write them into build/bench/'
	@echo 'make pictures        draw the pictures of README.md into docs/'
	@echo 'make install         install below PREFIX=$(PREFIX), libraries into LIBDIR=PREFIX/lib, staged in DESTDIR='
	@echo 'make uninstall       remove what the same call of install installed'
	@echo 'make dist            pack what git has as $(BUILD)/dist/$(RELEASE).tar.gz'
	@echo 'make distcheck       build, install and try what is in it'
	@echo 'make clean           remove build/'
	@echo 'CAIRO=no             build the command without cairo, and so without the charts of `carom bench`'
	@echo 'BOX2D=no CHIPMUNK=no build it without these two, which `carom bench` measures beside Carom if they are installed'
	@echo 'SANITIZE=1           build into build/sanitize/ with the address and undefined behaviour sanitizers'
	@echo 'SANITIZE=thread      build into build/sanitize-thread/ with the thread sanitizer'
	@echo 'CC_FOR_BUILD=        compiles what runs while it is built, where CC= and CXX= compile for another machine'
	@echo 'V=1                  show the commands'
	@echo 'CC= CXX= CFLAGS= CXXFLAGS= CPPFLAGS= LDFLAGS= OPTIMIZE= WERROR=   as usual'

$(BUILD)/carom: $(COMMAND_OBJECTS) $(BUILD)/libcarom.a $(BUILD)/command.list
	$(call say,LINK) $(LINK) -o $@ $(filter %.o %.a,$^) $(CAIRO_LIBRARIES) $(PEER_LIBRARIES) $(LIBRARIES)

$(BUILD)/libcarom.a: $(LIBRARY_OBJECTS) $(BUILD)/library.list
	@rm -f $@
	$(call say,AR) $(AR) qcs $@ $(LIBRARY_OBJECTS)

$(BUILD)/libcarom.so: $(LIBRARY_OBJECTS) $(BUILD)/library.list $(BUILD)/exports.map
	$(call say,LINK) $(LINK) $(SHARED) -o $@ $(LIBRARY_OBJECTS) $(LIBRARIES)
	@ln -sf libcarom.so $@.$(ABI)

# The template instances of the C++ library would be exported without it.
$(BUILD)/exports.map: | $(BUILD)/needs
	@echo '{ global: carom_*; local: *; };' > $@

$(BUILD)/%.o: %.c $(BUILD)/flags | $(BUILD)/needs
	@mkdir -p $(@D)
	$(call say,CC) $(CC) $(ALL_CFLAGS) -c -o $@ $<

$(BUILD)/%.o: %.cpp $(BUILD)/flags | $(BUILD)/needs
	@mkdir -p $(@D)
	$(call say,CXX) $(CXX) $(ALL_CXXFLAGS) -c -o $@ $<

$(BUILD)/%.o: $(BUILD)/%.c $(BUILD)/flags
	$(call say,CC) $(CC) $(ALL_CFLAGS) -c -o $@ $<

$(BUILD)/%.o: $(BUILD)/%.cpp $(BUILD)/flags
	$(call say,CXX) $(CXX) $(ALL_CXXFLAGS) -c -o $@ $<

# Half of the time that most of the CPU device's files take to compile goes to headers that are not ours: these are read once. (Compilers take them for what the -include names,
# and where they can't they read that.)
FOREIGN := $(BUILD)/foreign.hpp

$(FOREIGN).gch: src/cpu/foreign.hpp $(BUILD)/flags | $(BUILD)/needs
	@cp $< $(FOREIGN)
	$(call say,CXX) $(CXX) $(ALL_CXXFLAGS) -x c++-header -o $@ $(FOREIGN)

OF_CPU := $(filter $(BUILD)/src/cpu/%,$(LIBRARY_OBJECTS)) $(BUILD)/cpu_stages.o
$(OF_CPU): private CXXFLAGS += -include $(FOREIGN)
$(OF_CPU): $(FOREIGN).gch

# Third parties and insides are kept out of where they don't belong by what is on the include path.
$(OF_CPU) $(FOREIGN).gch: private PACKAGES := $(EIGEN)
$(BUILD)/tools/%.o: private PACKAGES :=
$(BUILD)/tools/%.o: private INCLUDES := -Iinclude
$(call object,$(wildcard tools/carom_plot*.c)): private PACKAGES := $(CAIRO_INCLUDES)
$(BUILD)/tools/carom_peer_box2d.o: private PACKAGES := $(BOX2D_INCLUDES)
$(BUILD)/tests/%.o: private PACKAGES += $(CMOCKA)
$(BUILD)/tests/%.o: private INCLUDES += -Itests

# ---- Generated sources

$(BUILD)/embed: tools/embed.c $(BUILD)/flags | $(BUILD)/needs
	$(call say,CC) $(CC_FOR_BUILD) -std=c11 $(WARNINGS) -o $@ $<

$(BUILD)/kernels.c: $(BUILD)/embed $(KERNELS) $(BUILD)/kernels.list
	$(call say,EMBED) $(BUILD)/embed $@ $(KERNELS)

stage_name = $(subst /,_,$(patsubst src/cpu/%.cpp,%,$(1)))
STAGE_NAMES := $(call stage_name,$(STAGES))
$(BUILD)/cpu_stages.cpp: $(BUILD)/stages.list
	@{ echo '#include "cpu/stages.hpp"'; echo; echo 'namespace carom::cpu {'; echo; \
	for stage in $(STAGE_NAMES); do echo "extern const Stage $$stage;"; done; echo; \
	echo 'extern const Stage *const stages[] = {'; \
	for stage in $(STAGE_NAMES); do echo "	&$$stage,"; done; \
	echo '	nullptr,'; echo '};'; echo; echo '}'; } > $@

# ---- What a build depends on beside its files: written anew only when it changes

define remember
$(BUILD)/$(1): FORCE | $(BUILD)/needs
	@printf '%s\n' '$$(subst ','\'',$(2))' | cmp -s - $$@ || printf '%s\n' '$$(subst ','\'',$(2))' > $$@
endef
$(eval $(call remember,flags,$$(CC) $$(ALL_CFLAGS) $$(CXX) $$(ALL_CXXFLAGS) $$(EIGEN) $$(LINK) $$(LIBRARIES) $$(CAIRO_LIBRARIES) $$(BOX2D_INCLUDES) $$(PEER_LIBRARIES) $$(CC_FOR_BUILD)))
$(eval $(call remember,library.list,$$(LIBRARY)))
$(eval $(call remember,command.list,$$(COMMAND)))
$(eval $(call remember,kernels.list,$$(KERNELS)))
$(eval $(call remember,stages.list,$$(STAGES)))
$(eval $(call remember,helpers.list,$$(HELPERS) $$(FAULTS)))
$(eval $(call remember,fuzz.list,$$(FUZZ_OBJECTS)))

NEEDED_COMMANDS := $(firstword $(CC)) $(firstword $(CXX)) $(PKG_CONFIG)
need = { echo 'make: $(1) is missing: run tools/bootstrap' >&2; exit 1; }

$(BUILD)/needs:
	@for command in $(NEEDED_COMMANDS); do \
		command -v "$$command" >/dev/null 2>&1 || { echo "make: $$command is missing: run tools/bootstrap" >&2; exit 1; }; done
	@for package in libpng jansson eigen3 $(if $(filter no,$(CAIRO)),,cairo); do \
		$(PKG_CONFIG) --exists $$package || { echo "make: $$package is missing: run tools/bootstrap" >&2; exit 1; }; done
	@echo '#include <CL/cl.h>' | $(CC) $(PACKAGES) $(CPPFLAGS) -E -DCL_TARGET_OPENCL_VERSION=120 -x c - >/dev/null 2>&1 || $(call need,CL/cl.h)
	@mkdir -p $(@D)/tests && touch $@

$(BUILD)/tests/needs: | $(BUILD)/needs
	@$(PKG_CONFIG) --exists cmocka || $(call need,cmocka)
	@touch $@

# ---- Tests

$(call object,$(TESTS) $(HELPERS) $(FAULTS)): | $(BUILD)/tests/needs

$(filter $(BUILD)/tests/test_faults_%,$(TEST_PROGRAMS)): $(call object,$(FAULTS)) tests/faults/wrap
$(filter $(BUILD)/tests/test_faults_%,$(TEST_PROGRAMS)): private LDFLAGS += @tests/faults/wrap
# `carom devices`, as it is where devices are made up
$(BUILD)/tests/test_faults_inexact: $(call object,$(addprefix tools/carom_,devices check check_numbers options report))

$(TEST_PROGRAMS): %: %.o $(HELPER_OBJECTS) $(BUILD)/libcarom.a $(BUILD)/helpers.list
	$(call say,LINK) $(LINK) -o $@ $(filter %.o,$^) $(filter %.a,$^) $(CMOCKA_LIBRARIES) $(LIBRARIES)

$(FUZZ_PROGRAMS): %: %.o $(FUZZ_OBJECTS) $(BUILD)/libcarom.a $(BUILD)/fuzz.list
	$(call say,LINK) $(LINK) $(LIBFUZZER) -o $@ $(filter %.o %.a,$^) $(LIBRARIES)

# Under the address sanitizer
ifdef LOADED
$(BUILD)/carom $(TEST_PROGRAMS) $(FUZZ_PROGRAMS): $(LOADED)
$(BUILD)/carom $(TEST_PROGRAMS) $(FUZZ_PROGRAMS): private LDFLAGS += -rdynamic
endif

check: all $(TEST_PROGRAMS) $(FUZZ_PROGRAMS)
	$(if $(filter Darwin,$(SYSTEM)),@echo 'SKIPPED tests/test_faults_*: the linker of macOS has no --wrap')
	@CC='$(CC)' CXX='$(CXX)' MAKE='$(MAKE_COMMAND)' tools/check $(BUILD) $(TEST_PROGRAMS) $(FUZZ_PROGRAMS)

# ---- Fuzzing: what libFuzzer finds is kept in build/fuzz/found/, its corpus in build/fuzz/corpus/. FUZZ are more options for it.

FUZZ_CC ?= clang
FUZZ_CXX ?= clang++
FUZZ_SECONDS ?= 600
FUZZ_SEEDS_scene := tests/bad scenes
FUZZ_CHECKS := address,undefined,float-cast-overflow
FUZZ_IGNORED := $(addsuffix =tests/fuzz/third_parties.list,-fsanitize-ignorelist -fsanitize-coverage-ignorelist)

fuzz:
	@for command in $(FUZZ_CC) $(FUZZ_CXX); do \
		command -v "$$command" >/dev/null 2>&1 || { echo "make: $$command is missing: run tools/bootstrap --developer" >&2; exit 1; }; done
	@$(MAKE) --no-print-directory BUILD=$(BUILD)/fuzz CC='$(FUZZ_CC)' CXX='$(FUZZ_CXX)' OPTIMIZE='-O2 -g1' LIBFUZZER=-fsanitize=fuzzer \
		SANITIZERS='-fsanitize=fuzzer-no-link,$(FUZZ_CHECKS) -fno-sanitize-recover=all $(FUZZ_IGNORED)' fuzzers
	@$(MAKE) --no-print-directory $(patsubst tests/fuzz/fuzz_%.c,fuzz-%,$(FUZZERS))

fuzzers: $(FUZZ_PROGRAMS)

# Most inputs take milliseconds, but bodies that are in thousands of events a step, until they are held, take a minute under the sanitizers.
fuzz-%:
	@mkdir -p $(BUILD)/fuzz/found $(BUILD)/fuzz/corpus/$*
	ASAN_OPTIONS=$${ASAN_OPTIONS-$(LEAKS)} $(BUILD)/fuzz/tests/fuzz/fuzz_$* -max_total_time=$(FUZZ_SECONDS) -timeout=240 -rss_limit_mb=2048 \
		-max_len=4096 -print_final_stats=1 -artifact_prefix=$(BUILD)/fuzz/found/$*- $(FUZZ) $(addprefix -dict=,$(wildcard tests/fuzz/$*.dict)) \
		$(BUILD)/fuzz/corpus/$* $(wildcard tests/corpus/$*) $(FUZZ_SEEDS_$*) </dev/null

# ---- Worlds that nobody would make: the one of a WILD_SEED that failed is the first when it is asked for again.

WILD_SECONDS ?= 600
WILD_SEED ?= 1

wild: $(BUILD)/tests/test_events_wild
	CAROM_BUILD=$(BUILD) CAROM_WILD_SECONDS=$(WILD_SECONDS) CAROM_WILD_SEED=$(WILD_SEED) $<

ALL_INCLUDES := $(INCLUDES) -Itests $(PACKAGES) $(EIGEN) $(CMOCKA) $(CAIRO_INCLUDES) $(BOX2D_INCLUDES)
quoted = $(subst ','\'',$(1))

static:
	@C_FLAGS='$(C11) $(call quoted,$(ALL_INCLUDES))' CXX_FLAGS='-std=c++17 $(call quoted,$(ALL_INCLUDES))' sh tests/static.sh

doc:
	@command -v $(DOXYGEN) >/dev/null || { echo 'make doc: $(DOXYGEN) is not there: install the package doxygen, or all that tools/bootstrap --developer does' >&2; exit 1; }
	@mkdir -p $(BUILD)
	@CAROM_VERSION='$(VERSION)' CAROM_BUILD='$(BUILD)' $(DOXYGEN) tools/Doxyfile
	@echo '$(BUILD)/doc/html/index.html'

# Races that hide from a run show here, of the library and of the command, where other threads write the frames; and of joints, and of what rests.
check-threads:
	@$(MAKE) SANITIZE=thread run-threads

run-threads: $(BUILD)/tests/test_threads $(BUILD)/carom
	$<
	$(BUILD)/carom run scenes/mixed.json --device cpu --time 0.5 --frames $(BUILD)/film --fps 100 --size 320x180
	@rm -r $(BUILD)/film
	$(BUILD)/carom run scenes/drum.json --device cpu --steps 40
	$(BUILD)/carom run scenes/heap.json --device cpu --steps 100

# On every OpenCL implementation that is installed, and from several compilers; ROWS are those of tools/conformance, all by default.
conformance: all $(TEST_PROGRAMS)
	@MAKE='$(MAKE_COMMAND)' tools/conformance $(BUILD) $(ROWS)

# ---- The demo: scene, options of `carom run`, what the picture shows

define DEMO
triangles_1024 | --set step=first_impact --steps 400 --inset -2,-2,4,4 | 1,024 triangles after 400 hits, a part of them enlarged
circles_1024   | --time 2 --inset -2,-2,4,4 | 1,024 circles after two seconds, a part of them enlarged
heap           | --time 6                      | what fell into a box, and lies there
pyramid        | --time 3                      | boxes that stand on each other, and on a slope, because they rub
towers         | --time 3                      | towers of boxes that stand, and one that a ball hit
mixer          | --time 10                     | two paddles that turn in a heap, whatever lies in their way
sand           | --time 8                      | the same balls twice: below they have rolling friction, and stay in a heap
bridge         | --time 1.5                    | planks and a chain that are joined: the bridge bears what fell on it, and the ball has hit the boxes
car            | --time 6.4                    | a car with motors on springs, which has drawn a sled by a rope over bumps and through two gates
letters        | --time 6                      | letters in a bowl, and hooks that hang in hooks: none of them is convex
drum           | --time 9                      | a drum of bars that are fixed to each other, which a motor turns, and the balls that it mixes
sorter         | --time 1.8                    | red and blue bodies in one room, which pass through each other
mixed          | --time 2                      | circles and polygons in one room after two seconds
billiard_break | --time 1                      | a billiard break one second after the cue ball was struck
newtons_cradle | --time 1                      | Newton's cradle after one second: what went in on one side went out on the other
piston         | --time 18                     | a gas that a piston has pressed into half of its room
thin_wall      | --time 1                      | fast circles that did not tunnel through a thin wall
endef
export DEMO
demo_lines = printf '%s\n' "$$DEMO" | while IFS='|' read -r scene options shows; do set -- $$scene; scene=$$1; \
	png=$(BUILD)/demo/$$scene.png

demo: all
	@mkdir -p $(BUILD)/demo
	@$(demo_lines); $(BUILD)/carom run scenes/$$scene.json $$options --png $$png </dev/null || exit 1; done
	@echo; $(demo_lines); echo "$$png: $${shows# }"; done

# ---- The paper's tables, and Carom beside other engines. BENCH are more options for each call of `carom bench`.

BENCH_TABLES := table1 table2 table3 table4 table5 scale tunnel heap rays

bench: all
	@mkdir -p $(BUILD)/bench
	@status=0; $(foreach table,$(BENCH_TABLES),$(call bench_one,$(table)) || status=1; echo;) exit $$status

# tunnel, heap and rays have no chart
bench_one = $(BUILD)/carom bench $(1) --csv $(BUILD)/bench/$(1).csv \
	$(if $(filter no,$(CAIRO))$(filter tunnel heap rays,$(1)),,--plot $(BUILD)/bench/$(1).png) $(BENCH) </dev/null

# ---- The pictures of README.md: the charts are those that `make bench` drew last, if it did

pictures: all
	@mkdir -p docs
	$(BUILD)/carom run scenes/triangles_1024.json --set step=first_impact --steps 400 --inset -2,-2,4,4 --size 720x405 --png docs/triangles_1024.png
	$(BUILD)/carom run scenes/heap.json --time 6 --size 720x405 --png docs/heap.png
	$(BUILD)/carom run scenes/pyramid.json --time 3 --size 720x405 --png docs/pyramid.png
	$(BUILD)/carom run scenes/towers.json --time 3 --size 720x405 --png docs/towers.png
	$(BUILD)/carom run scenes/mixer.json --time 10 --size 720x405 --png docs/mixer.png
	$(BUILD)/carom run scenes/sand.json --time 8 --size 720x405 --png docs/sand.png
	$(BUILD)/carom run scenes/bridge.json --time 1.5 --size 720x405 --png docs/bridge.png
	$(BUILD)/carom run scenes/car.json --time 6.4 --size 720x405 --png docs/car.png
	$(BUILD)/carom run scenes/letters.json --time 6 --size 720x405 --png docs/letters.png
	$(BUILD)/carom run scenes/drum.json --time 9 --size 720x405 --png docs/drum.png
	$(BUILD)/carom run scenes/sorter.json --time 1.8 --size 720x405 --png docs/sorter.png
	$(BUILD)/carom run scenes/thin_wall.json --time 1 --fps 3 --size 480x264 --frames docs/thin_wall
	@for chart in scale table1 table2 table3 table4 table5; do \
		if [ -f $(BUILD)/bench/$$chart.png ]; then cp $(BUILD)/bench/$$chart.png docs/$$chart.png; fi; done

# ---- Installing

$(BUILD)/carom.pc: $(BUILD)/pc.list
	@printf '%s\n' 'prefix=$(PREFIX)' 'includedir=$${prefix}/include' 'libdir=$(patsubst $(PREFIX)/%,$${prefix}/%,$(LIBDIR))' '' 'Name: carom' \
		'Description: 2D rigid bodies with every hit at its exact time' 'Version: $(VERSION)' 'Cflags: -I$${includedir}' \
		'Libs: -L$${libdir} -lcarom' 'Requires.private: libpng jansson' 'Libs.private: -lstdc++ -ldl -lpthread -lm' > $@
$(eval $(call remember,pc.list,$$(PREFIX) $$(LIBDIR) $$(VERSION)))

install: all $(BUILD)/carom.pc
	install -d $(DESTDIR)$(PREFIX)/bin $(DESTDIR)$(PREFIX)/include $(DESTDIR)$(LIBDIR)/pkgconfig $(DESTDIR)$(PREFIX)/share/man/man1
	install -m 755 $(BUILD)/carom $(DESTDIR)$(PREFIX)/bin
	install -m 644 include/carom.h $(DESTDIR)$(PREFIX)/include
	install -m 644 $(BUILD)/libcarom.a $(DESTDIR)$(LIBDIR)
	install -m 755 $(BUILD)/libcarom.so $(DESTDIR)$(LIBDIR)/libcarom.so.$(VERSION)
	ln -sf libcarom.so.$(VERSION) $(DESTDIR)$(LIBDIR)/libcarom.so.$(ABI)
	ln -sf libcarom.so.$(ABI) $(DESTDIR)$(LIBDIR)/libcarom.so
	install -m 644 $(BUILD)/carom.pc $(DESTDIR)$(LIBDIR)/pkgconfig
	install -m 644 tools/carom.1 $(DESTDIR)$(PREFIX)/share/man/man1

uninstall:
	rm -f $(addprefix $(DESTDIR)$(PREFIX)/,bin/carom include/carom.h share/man/man1/carom.1) \
		$(addprefix $(DESTDIR)$(LIBDIR)/libcarom,.a .so .so.$(ABI) .so.$(VERSION)) $(DESTDIR)$(LIBDIR)/pkgconfig/carom.pc

# ---- The release: what git tracks, with the same bytes whenever it is made from the same commit

RELEASE := carom-$(VERSION)

dist:
	@git rev-parse --git-dir >/dev/null 2>&1 || { echo 'make: a release is made where git has the sources' >&2; exit 1; }
	@git diff --quiet HEAD || echo 'make: what is not committed is not in it' >&2
	@mkdir -p $(BUILD)/dist
	@git archive --format=tar --prefix=$(RELEASE)/ HEAD | gzip -9n > $(BUILD)/dist/$(RELEASE).tar.gz
	@cd $(BUILD)/dist && { sha256sum $(RELEASE).tar.gz 2>/dev/null || shasum -a 256 $(RELEASE).tar.gz; } > $(RELEASE).tar.gz.sha256
	@echo '$(BUILD)/dist/$(RELEASE).tar.gz'

distcheck: dist
	@CC='$(CC)' CXX='$(CXX)' MAKE='$(MAKE_COMMAND)' sh tests/dist.sh $(BUILD)/dist/$(RELEASE).tar.gz

clean:
	rm -rf $(BUILD)

FORCE:
.PHONY: all help check check-threads run-threads fuzz fuzzers wild conformance static doc demo bench pictures install uninstall dist distcheck clean FORCE
.SECONDARY:
.DELETE_ON_ERROR:
.DEFAULT_GOAL := all

-include $(OBJECTS:.o=.d)
