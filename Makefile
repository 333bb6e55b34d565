# Seam2D. `make help` lists what there is to do.
#
# Layout: every .cpp under common/ goes into libseam-common.a; server/, client/ and render/ each hold
# one program's files with main in main.cpp (render/ holds the mains of seam-measure, seam-export,
# seam-import, seam-view and seam-log too, client/swarm/, client/top/ and client/front/ those of
# seam-swarm, seam-top and seam); tests/ is one GoogleTest program, tests/lab/ is seam-lab, which
# alone has server and clients in one process.
# libseam.a, for other programs, is common/, server/, client/ and client/embed/ without their mains; libseam2d.so is
# the same behind a C interface. client/python/ is the Python module.
# lcmtypes/*.lcm become headers under build/gen/, hardened by lcmtypes/harden.awk.

# All cores, unless -j says otherwise.
ifeq ($(filter -j%,$(MAKEFLAGS)),)
MAKEFLAGS += -j$(shell nproc)
endif

BUILD ?= release
PREFIX ?= /usr/local
OUT := build/$(BUILD)
GEN := build/gen

CXX ?= g++
# The fastest linker that is installed; lld is not tried: it comes with a clang, whose version must fit.
LINKER := $(firstword $(foreach linker,mold gold,$(if $(shell command -v ld.$(linker)),-fuse-ld=$(linker))))
WARN := -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror
# What a program linked with the objects needs too.
INSTRUMENT_asan := -fsanitize=address,undefined
INSTRUMENT_tsan := -fsanitize=thread
INSTRUMENT_coverage := --coverage
# By clang++ alone (make fuzz).
INSTRUMENT_fuzz := -fsanitize=fuzzer-no-link,address,undefined
CXXFLAGS_release := -O2
# Optimising the tests themselves takes a third of the time to compile them; what they test is optimised.
TEST_CXXFLAGS_release := -O1
CXXFLAGS_debug := -O0 -g
# Without checks that take a quarter of the time to compile: what they would find ends the program here too, or is
# nothing to this processor.
CXXFLAGS_asan := -O1 -g1 $(INSTRUMENT_asan) -fno-sanitize=null,alignment,object-size,vptr -fno-sanitize-recover=all \
	-fno-omit-frame-pointer
TEST_CXXFLAGS_asan := -O0
CXXFLAGS_fuzz := -O1 -g1 $(INSTRUMENT_fuzz) -fno-sanitize-recover=all -fno-omit-frame-pointer
CXXFLAGS_tsan := -O1 -g1 $(INSTRUMENT_tsan)
# Signals and threads end programs at any time: counters are added atomically.
CXXFLAGS_coverage := -O1 -g1 $(INSTRUMENT_coverage) -fprofile-update=atomic
ifeq ($(CXXFLAGS_$(BUILD)),)
$(error BUILD must be release, debug, asan, tsan, coverage or fuzz, not "$(BUILD)")
endif
EIGEN := /usr/include/eigen3
# -ffp-contract=off is part of the determinism contract: no fused multiply-add. So is -fno-tree-slp-vectorize: with
# -march=x86-64-v3 g++ 12 fuses there all the same (make hashes).
ALL_CXXFLAGS := -std=c++17 $(CXXFLAGS_$(BUILD)) -ffp-contract=off -fno-tree-slp-vectorize $(WARN) -MMD -MP -I. \
	-isystem $(EIGEN) -isystem /usr/include/freetype2 -pthread $(CXXFLAGS)
# What goes into libraries can be part of a shared one; calls inside of it stay direct.
LIBRARY_CXXFLAGS := -fPIC -fvisibility=hidden
# Only common/codec/ reads generated headers (tests/style/layering_test.cpp).
CODEC_CXXFLAGS := -isystem $(GEN)
LIBS := -llcm -lbox2d -lfmt -lsodium -lzstd -pthread -Wl,--push-state,--as-needed -lsqlite3 -lcurl -Wl,--pop-state
RENDER_LIBS := -lOSMesa -lpng -lfreetype -lz -ltinyxml2
SERVER_LIBS := -llua5.4

# Debian packages: build/.deps-NAME stands for DEBS_NAME being installed.
DEBS_build := g++ make pkg-config liblcm-dev liblcm-bin libbox2d-dev libeigen3-dev libosmesa6-dev \
	liblua5.4-dev libcli11-dev libtoml11-dev libfmt-dev libpng-dev zlib1g-dev libzstd-dev libfreetype-dev \
	fonts-dejavu-core libgtest-dev libsodium-dev libsqlite3-dev libcurl4-openssl-dev nlohmann-json3-dev libtinyxml2-dev iproute2 util-linux
DEBS_report := gnuplot-nox
DEBS_test := python3
# For the tests of the fleet's directory in etcd; without it they are skipped.
DEBS_fleet := etcd-server
# The Python of these packages, also where another one comes first in PATH.
PYTHON3 ?= /usr/bin/python3
DEBS_python := python3 libpython3-dev pybind11-dev python3-numpy
DEBS_deb := dpkg-dev
# For the tests that open a review page; without it they are skipped. It is 2 minutes, so CI alone installs it.
DEBS_browser := chromium
DEBS_coverage := gcovr
# promtool, for the test of the alerts; without it that is skipped.
DEBS_alerts := prometheus
DEBS_spy := liblcm-java libjchart2d-java $(if $(shell command -v javac),,default-jdk)
DEBS_format := clang-format git
DEBS_hashes := clang
DEBS_fuzz := clang libclang-rt-dev
DEBS_lint := clang-tidy git

# All .cpp below a folder.
below = $(sort $(shell find $(1) -name '*.cpp'))
MAINS := server/main.cpp server/token/main.cpp server/relay/main.cpp client/main.cpp client/swarm/main.cpp client/top/main.cpp client/front/main.cpp render/main.cpp render/measure_main.cpp render/export_main.cpp render/import_main.cpp render/view_main.cpp render/log_main.cpp tests/lab/main.cpp tests/fuzz/fuzz_main.cpp
SOURCES := $(call below,common server client render tests)

# The objects of sources. Two thirds of a build is parsing headers, so the sources of a folder are compiled together
# (UNITY=0: each by itself): $(OUT)/unity/FOLDER.cpp includes those that are no tests, FOLDER-tests.cpp the tests.
UNITY ?= 1
alone = $(patsubst %.cpp,$(OUT)/%.o,$(1))
folders = $(patsubst %/,%,$(sort $(dir $(1))))
tests_of = $(filter %_test.cpp,$(1))
unit_names = $(call folders,$(filter-out %_test.cpp,$(1))) $(addsuffix -tests,$(call folders,$(tests_of)))
units = $(call alone,$(filter $(MAINS),$(1))) $(patsubst %,$(OUT)/unity/%.o,$(call unit_names,$(filter-out $(MAINS),$(1))))
obj = $(if $(filter 0,$(UNITY)),$(alone),$(units))
UNITS := $(call unit_names,$(filter-out $(MAINS),$(SOURCES)))
COMMON := $(call obj,$(filter common/%,$(SOURCES)))
SERVER := $(call obj,$(filter-out $(MAINS) server/relay/%,$(filter server/%,$(SOURCES))))
# A client of a server, and a server of watchers.
RELAY := $(call obj,$(filter-out $(MAINS),$(filter server/relay/%,$(SOURCES))))
# The programs beside a player's: what a load test and a view of the server's load have in common with it.
WATCHERS := $(call obj,$(filter-out $(MAINS),$(filter client/swarm/% client/top/%,$(SOURCES))))
TOP := $(call obj,$(filter-out $(MAINS),$(filter client/top/%,$(SOURCES))))
FRONT := $(call obj,$(filter-out $(MAINS),$(filter client/front/%,$(SOURCES))))
# What has server and clients in one process, for other programs: behind C++, C and Python.
EMBED := $(call obj,$(filter client/embed/%,$(SOURCES)))
PYTHON := $(call obj,$(filter client/python/%,$(SOURCES)))
CLIENT := $(filter-out $(WATCHERS) $(FRONT) $(EMBED) $(PYTHON),$(call obj,$(filter-out $(MAINS),$(filter client/%,$(SOURCES)))))
RENDER := $(call obj,$(filter-out $(MAINS),$(filter render/%,$(SOURCES))))
EXPORT := $(call obj,$(filter render/export/%,$(SOURCES))) $(call alone,render/canvas/shapes.cpp render/canvas/figure.cpp)
MEASURE := $(call obj,$(filter render/measure/%,$(SOURCES))) $(call alone,render/playback/format.cpp)
LOG := $(call obj,$(filter render/log/%,$(SOURCES)))
IMPORT := $(call obj,$(filter render/import/%,$(SOURCES))) $(EXPORT)
LAB := $(call obj,$(filter-out $(MAINS) %_test.cpp,$(filter tests/lab/%,$(SOURCES))))
# What seam-lab has from the tests.
LAB_SUPPORT := $(call obj,tests/support/plan/plain_scene.cpp $(filter tests/support/soak/%,$(SOURCES)))
FUZZ := $(filter-out %_test.cpp $(MAINS),$(filter tests/fuzz/%,$(SOURCES)))
TEST_SOURCES := $(filter %_test.cpp tests/support/%,$(filter tests/%,$(SOURCES))) $(FUZZ)
TESTS := $(call obj,$(TEST_SOURCES))
LIBRARY := $(COMMON) $(SERVER) $(CLIENT) $(EMBED) $(PYTHON)
# Everything that may be compiled: the units, and each source alone.
OBJECTS_ALONE := $(call alone,$(SOURCES))
OBJECTS := $(OBJECTS_ALONE) $(UNITS:%=$(OUT)/unity/%.o)
CODEC := $(filter $(OUT)/common/codec/% $(OUT)/unity/common/codec%,$(OBJECTS))
PROGRAMS := $(addprefix $(OUT)/,seam seam-server seam-token seam-relay seam-client seam-swarm seam-top seam-render seam-measure seam-export seam-import seam-view seam-log seam-lab)
LCM_TYPES := $(sort $(wildcard lcmtypes/*.lcm))
VERSION := $(shell sed -n 's/.*kVersion = "\(.*\)".*/\1/p' common/base/version.h)

# Processes and long simulations: what `make check-fast` leaves out.
slow = $(filter tests/process/% $(foreach s,$(1),$(if $(findstring /slow/,$(s)),$(s))),$(1))
# The tests that SEAM_SOAK multiplies (tests/support/soak.h).
SOAKED := *Cluster*:Authority*:*TopologyUnder*:SceneFuzz*:Codec*:FeatherOutline*
SOAK ?= 300

.DEFAULT_GOAL := all
.DELETE_ON_ERROR:
.PHONY: all fuzz check check-includes objects core-tests docs help deps demo fleet-demo bench report relief spy test tests hashes sanitize check-fast run-tests coverage soak format \
	lint compile_commands.json install install-built python wheel deb clean force

all: build/.deps-build $(PROGRAMS) $(OUT)/share/.stamp build/share/seam2d/scenes   ## build the programs

help:                                ## this list
	@echo "make targets (BUILD=release|debug|asan|tsan, default release; PREFIX=/usr/local):"
	@sed -n 's/^\([a-z][a-z._-]*\):.*## \(.*\)/  \1	\2/p' Makefile | expand -t 26

# $(call install_missing,PACKAGES): installs those that are missing, one make at a time.
define install_missing
@mkdir -p build; exec 9>build/.deps.lock; flock 9; \
missing=""; for p in $(1); do \
  dpkg-query -W -f='$${Status}' $$p 2>/dev/null | grep -q "ok installed" || missing="$$missing $$p"; done; \
if [ -n "$$missing" ]; then \
  command -v apt-get >/dev/null || { echo "make deps: this is not Debian; please install:$$missing" >&2; exit 1; }; \
  SUDO=""; [ "$$(id -u)" = 0 ] || SUDO=sudo; \
  [ -z "$$SUDO" ] || command -v sudo >/dev/null || { echo "make deps: not root and no sudo; as root run: apt-get install$$missing" >&2; exit 1; }; \
  echo "installing:$$missing"; \
  { $$SUDO apt-get update -qq && $$SUDO env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $$missing; } >/dev/null 9>&- \
  || { echo "make deps: apt-get failed; by hand: apt-get install$$missing" >&2; exit 1; }; fi
endef

deps:                                ## install the Debian packages that are missing
	$(call install_missing,$(DEBS_build) $(DEBS_report))

# Looked at once, and again when the lists above may have changed.
build/.deps-%: Makefile
	$(call install_missing,$(DEBS_$*))
	@touch $@
.PRECIOUS: build/.deps-%

$(GEN)/.stamp: $(LCM_TYPES) lcmtypes/harden.awk Makefile | build/.deps-build
	@rm -rf $(GEN) && mkdir -p $(GEN)
	lcm-gen --cpp --cpp-std c++11 --cpp-hpath $(GEN) $(LCM_TYPES)
	@for h in $(GEN)/seam/*.hpp; do awk -f lcmtypes/harden.awk $$h > $$h.tmp && mv $$h.tmp $$h || exit 1; done
	@for h in $(GEN)/seam/*_t.hpp; do echo "#include \"seam/$${h##*/}\""; done > $(GEN)/seam/all_types.hpp
	@echo '#define SEAM_LCM_TYPES(Do) $(patsubst %,Do(%),$(basename $(notdir $(LCM_TYPES))))' >> $(GEN)/seam/all_types.hpp
	@touch $@

# What every object is made with. Written when it differs, so that other flags rebuild everything,
# and an interrupted rebuild goes on where it was.
FLAGS := $(strip $(CXX) $(ALL_CXXFLAGS) $(CODEC_CXXFLAGS) $(TEST_CXXFLAGS_$(BUILD)) $(LIBRARY_CXXFLAGS) $(LDFLAGS))
ifneq ($(file <$(OUT)/.flags),$(FLAGS))
$(OUT)/.flags: force
endif
$(OUT)/.flags:
	@mkdir -p $(@D)
	@printf '%s\n' '$(subst ','\'',$(FLAGS))' > $@

# Tables of seam-lab name the commit that they were computed with.
COMMIT := $(shell git describe --always --dirty --abbrev=12 2>/dev/null || echo unknown)
BUILD_ID := $(OUT)/unity/tests/lab/experiment.o $(OUT)/tests/lab/experiment/build_id.o
ifneq ($(file <$(OUT)/.commit),$(COMMIT))
$(OUT)/.commit: force
endif
$(OUT)/.commit:
	@mkdir -p $(@D)
	@printf '%s\n' '$(COMMIT)' > $@
$(BUILD_ID): $(OUT)/.commit
$(BUILD_ID): private ALL_CXXFLAGS += -DSEAM_COMMIT='"$(COMMIT)"'

# Which sources there are: without it a deleted one would stay in what is linked.
ifneq ($(file <$(OUT)/.sources),$(SOURCES))
$(OUT)/.sources: force
endif
$(OUT)/.sources:
	@mkdir -p $(@D)
	@printf '%s\n' $(SOURCES) | OUT=$(OUT) MAINS='$(MAINS)' tests/units.sh
	@printf '%s\n' '$(SOURCES)' > $@
$(UNITS:%=$(OUT)/unity/%.cpp): | $(OUT)/.sources ;
$(PROGRAMS) $(addprefix $(OUT)/,seam-tests libseam.a libseam-common.a): $(OUT)/.sources
LINKED = $(filter-out %/.sources,$^)

$(CODEC): private ALL_CXXFLAGS += $(CODEC_CXXFLAGS)
$(CODEC): $(GEN)/.stamp
$(TESTS): private ALL_CXXFLAGS += $(TEST_CXXFLAGS_$(BUILD))
$(LIBRARY): private ALL_CXXFLAGS += $(LIBRARY_CXXFLAGS)
$(PYTHON): private ALL_CXXFLAGS += -isystem $(shell $(PYTHON3) -c 'import sysconfig; print(sysconfig.get_path("include"))')
$(PYTHON): build/.deps-python
# A class of a unit may have members of an unnamed namespace: the warning is for headers.
$(OUT)/unity/%.o: $(OUT)/unity/%.cpp $(OUT)/.flags | build/.deps-build
	$(CXX) $(ALL_CXXFLAGS) -Wno-subobject-linkage -include $(PRECOMPILED) -c $< -o $@
$(OUT)/%.o: %.cpp $(OUT)/.flags | build/.deps-build
	@mkdir -p $(@D)
	$(CXX) $(ALL_CXXFLAGS) $(if $(filter 0,$(UNITY)),,-include $(PRECOMPILED)) -c $< -o $@

# The headers that most units include, parsed once; tests have a second one, with GoogleTest and their own options,
# those that run a server and clients a third one, with the headers of both, and what goes into libraries a fourth one.
# UNITY=0 goes without, so that each file includes what it needs.
SESSION_TESTS := $(filter $(foreach f,client cluster embed fleet fuzz process relay server,$(OUT)/unity/tests/$(f)%),$(TESTS))
PRECOMPILED = $(OUT)/precompiled.h
$(TESTS): private PRECOMPILED = $(OUT)/precompiled-tests.h
$(SESSION_TESTS): private PRECOMPILED = $(OUT)/precompiled-sessions.h
$(LIBRARY): private PRECOMPILED = $(OUT)/precompiled-library.h
PRECOMPILED_ALL := $(OUT)/precompiled.h $(foreach n,library tests sessions,$(OUT)/precompiled-$(n).h)
PRECOMPILED_HEADERS := Eigen/Core algorithm array box2d/box2d.h cmath cstdint deque fmt/format.h functional map memory \
	numeric optional set sstream string unordered_map variant vector
$(OUT)/precompiled-tests.h: PRECOMPILED_HEADERS += gtest/gtest.h filesystem fstream
$(OUT)/precompiled-sessions.h: PRECOMPILED_HEADERS += gtest/gtest.h filesystem fstream client/embed/cluster.h
$(PRECOMPILED_ALL): Makefile | build/.deps-build
	@mkdir -p $(@D)
	@printf '#include <%s>\n' $(PRECOMPILED_HEADERS) > $@
$(OUT)/precompiled-tests.h.gch $(OUT)/precompiled-sessions.h.gch: private ALL_CXXFLAGS += $(TEST_CXXFLAGS_$(BUILD))
$(OUT)/precompiled-library.h.gch: private ALL_CXXFLAGS += $(LIBRARY_CXXFLAGS)
$(PRECOMPILED_ALL:=.gch): %.gch: % $(OUT)/.flags
	$(CXX) $(ALL_CXXFLAGS) -x c++-header $< -o $@
ifneq ($(UNITY),0)
$(filter-out $(LIBRARY) $(TESTS),$(OBJECTS)): $(OUT)/precompiled.h.gch
$(LIBRARY): $(OUT)/precompiled-library.h.gch
$(filter-out $(SESSION_TESTS),$(TESTS)): $(OUT)/precompiled-tests.h.gch
$(SESSION_TESTS): $(OUT)/precompiled-sessions.h.gch
endif

# What the pages are made of is copied into the programs (render/page/assets.cpp).
$(OUT)/render/page/assets.o $(OUT)/unity/render/page.o: $(wildcard render/page/*.html render/page/*.css render/page/*.js)
$(OUT)/tests/lab/report/html/report_assets.o $(OUT)/unity/tests/lab/report/html.o: $(wildcard tests/lab/report/html/*.css tests/lab/report/html/*.js)

# Appended to nothing: two members may have the same name.
$(OUT)/libseam-common.a: $(COMMON)
$(OUT)/libseam.a: $(COMMON) $(SERVER) $(CLIENT) $(EMBED)
$(OUT)/%.a:
	@rm -f $@
	@ar qcs $@ $(LINKED)

LINK = $(CXX) $(ALL_CXXFLAGS) $(LINKER) $(LDFLAGS) $(LINKED)

# The C interface alone is seen from outside: client/embed/seam2d/seam2d.h.
SEAM2D_ABI := $(shell sed -n 's/^.define SEAM2D_ABI_VERSION //p' client/embed/seam2d/seam2d.h)
SHARED := $(OUT)/libseam2d.so.$(SEAM2D_ABI)
$(SHARED): $(EMBED) $(CLIENT) $(SERVER) $(OUT)/libseam-common.a
	$(LINK) -shared -Wl,-soname,$(@F) -Wl,-z,defs -Wl,--version-script=client/embed/seam2d.map $(LIBS) $(SERVER_LIBS) -o $@

# The Python module, for PYTHONPATH=$(OUT)/python. Its texts are beside what is compiled.
PYTHON_TEXTS := $(wildcard client/python/seam/*.py client/python/seam/*.pyi client/python/seam/py.typed)
$(OUT)/python/.stamp: $(OUT)/python/seam/_seam.so $(PYTHON_TEXTS)
	@cp $(PYTHON_TEXTS) $(@D)/seam/
	@touch $@
$(OUT)/python/seam/_seam.so: $(PYTHON) $(EMBED) $(CLIENT) $(SERVER) $(OUT)/libseam-common.a
	@mkdir -p $(@D)
	$(LINK) -shared $(LIBS) $(SERVER_LIBS) -o $@

python: build/.deps-build build/.deps-python $(OUT)/python/.stamp   ## the Python module: PYTHONPATH=build/release/python

wheel: python                        ## the Python module as a wheel for pip: out/wheel/
	$(PYTHON3) client/python/make_wheel.py $(OUT)/python $(VERSION) out/wheel

$(OUT)/seam: $(OUT)/client/front/main.o $(FRONT) $(OUT)/libseam-common.a
	$(LINK) $(LIBS) -o $@
$(OUT)/seam-server: $(OUT)/server/main.o $(SERVER) $(OUT)/libseam-common.a
	$(LINK) $(LIBS) $(SERVER_LIBS) -o $@
$(OUT)/seam-token: $(OUT)/server/token/main.o $(OUT)/libseam-common.a
	$(LINK) $(LIBS) -o $@
$(OUT)/seam-relay: $(OUT)/server/relay/main.o $(RELAY) $(SERVER) $(CLIENT) $(OUT)/libseam-common.a
	$(LINK) $(LIBS) $(SERVER_LIBS) -o $@
$(OUT)/seam-client: $(OUT)/client/main.o $(CLIENT) $(OUT)/libseam-common.a
	$(LINK) $(LIBS) -o $@
$(OUT)/seam-swarm: $(OUT)/client/swarm/main.o $(WATCHERS) $(CLIENT) $(OUT)/libseam-common.a
	$(LINK) $(LIBS) -o $@
$(OUT)/seam-top: $(OUT)/client/top/main.o $(TOP) $(OUT)/libseam-common.a
	$(LINK) $(LIBS) -o $@
$(OUT)/seam-render: $(OUT)/render/main.o $(RENDER) $(OUT)/libseam-common.a
	$(LINK) $(LIBS) $(RENDER_LIBS) -o $@
$(OUT)/seam-measure: $(OUT)/render/measure_main.o $(MEASURE) $(OUT)/libseam-common.a
	$(LINK) $(LIBS) -o $@
$(OUT)/seam-export: $(OUT)/render/export_main.o $(EXPORT) $(OUT)/libseam-common.a
	$(LINK) $(LIBS) -o $@
$(OUT)/seam-log: $(OUT)/render/log_main.o $(LOG) $(OUT)/libseam-common.a
	$(LINK) $(LIBS) -o $@
$(OUT)/seam-import: $(OUT)/render/import_main.o $(IMPORT) $(OUT)/libseam-common.a
	$(LINK) $(LIBS) -ltinyxml2 -o $@
$(OUT)/seam-view: $(OUT)/render/view_main.o $(RENDER) $(OUT)/libseam-common.a
	$(LINK) $(LIBS) $(RENDER_LIBS) -o $@
$(OUT)/seam-lab: $(OUT)/tests/lab/main.o $(LAB) $(LAB_SUPPORT) $(EMBED) $(SERVER) $(CLIENT) $(OUT)/libseam-common.a
	$(LINK) $(LIBS) $(SERVER_LIBS) -o $@
# The tests last: of an inline function that they use too the tested objects' copy is taken.
$(OUT)/seam-tests: $(COMMON) $(LAB) $(EMBED) $(RELAY) $(SERVER) $(CLIENT) $(WATCHERS) $(FRONT) $(RENDER) $(TESTS)
	$(LINK) $(LIBS) $(RENDER_LIBS) $(SERVER_LIBS) -lgtest -lgtest_main -o $@

# The tests of what reads from outside and keeps it, without long simulations, programs and pictures: a little
# more than half of the sources. The tests themselves are those of build/release: what they test is under the sanitizers.
CORE_TESTS := $(foreach f,base client codec fuzz net record scene server sync topology,$(filter \
	tests/$(f)/%_test.cpp,$(SOURCES))) $(filter tests/support/%,$(SOURCES)) $(FUZZ)
CORE_OBJECTS := $(patsubst $(OUT)/%,build/release/%,$(call obj,$(CORE_TESTS)))
core-tests: $(CORE_OBJECTS)
$(OUT)/seam-tests-core: $(COMMON) $(call alone,client/embed/cluster.cpp tests/lab/world/plan_worlds.cpp) $(WATCHERS) $(SERVER) $(CLIENT) $(CORE_OBJECTS)
	$(LINK) $(LIBS) $(SERVER_LIBS) -lgtest -lgtest_main -o $@

# Man pages, completion and the schema of scenes, by the programs themselves: from what parses their flags and scenes.
$(OUT)/share/.stamp: $(PROGRAMS) $(wildcard scenes/*.toml scenes/*/*.toml)
	@rm -rf $(@D) && mkdir -p $(addprefix $(@D)/,man bash zsh fish)
	@for p in $(notdir $(PROGRAMS)); do \
	  $(OUT)/$$p --generate man > $(@D)/man/$$p.1 && $(OUT)/$$p --generate bash > $(@D)/bash/$$p && \
	  $(OUT)/$$p --generate zsh > $(@D)/zsh/_$$p && $(OUT)/$$p --generate fish > $(@D)/fish/$$p.fish || exit 1; done
	@$(OUT)/seam-lab schema scenes/*.toml scenes/*/*.toml > $(@D)/seam.schema.json
	@touch $@

# The scenes by name for built programs that run in another folder, as for installed ones.
build/share/seam2d/scenes:
	@mkdir -p $(@D) && ln -sfn ../../../scenes $@

# An example of a page to look through: three methods on one network.
docs/review.html: $(PROGRAMS)
	@mkdir -p $(OUT)/review
	@for method in 'buffer rollback' 'buffer interleave' strict; do set -- $$method; \
	  $(OUT)/seam-lab run crossing --mode $$1 $${2:+--reconcile $$2} --impair demo --no-floor --force \
	    -o $(OUT)/review/$${2:-strict}.lcm >/dev/null || exit 1; done
	$(OUT)/seam-render --page $(OUT)/review/rollback.lcm $(OUT)/review/interleave.lcm $(OUT)/review/strict.lcm \
	  --force -o $@

docs: $(OUT)/share/.stamp docs/review.html   ## man pages and completion (build/release/share/), an example of a review page

# The test of golden hashes alone, with only what steps a world (tests/hashes.sh).
WORLD := $(call obj,$(foreach room,base scene topology physics stages,$(filter common/$(room)/%,$(SOURCES))))
$(OUT)/seam-hashes: $(OUT)/tests/physics/determinism_test.o $(WORLD)
	$(LINK) $(LIBS) -lgtest -lgtest_main -o $@

# The folder of tests of a room: tests/sync of common/sync and of common/sync/reach. The tests of a room below server
# and client link without them.
ifneq ($(ROOM),)
ROOM_FOLDER := $(shell d='$(patsubst tests/%,%,$(patsubst common/%,%,$(ROOM:/=)))'; \
	while [ "$$d" != . ] && [ ! -d "tests/$$d" ]; do d=$$(dirname "$$d"); done; [ "$$d" = . ] || echo "tests/$$d")
ifeq ($(ROOM_FOLDER),)
$(error make check: $(ROOM) has no folder of tests; ROOM is one of $(patsubst tests/%/,%,$(wildcard tests/*/)))
endif
ROOM_SOURCES := $(filter $(ROOM_FOLDER)/%,$(SOURCES))
ROOM_TESTS := $(call obj,$(filter-out $(call slow,$(ROOM_SOURCES)),$(ROOM_SOURCES)))
ROOM_USES := $(shell grep -lE '"(server|client|render|tests/lab|tests/support/[a-z_]+)/|tests/support/($(subst $() ,|,$(patsubst \
	tests/support/%,%,$(shell grep -lE '"(server|client|render|tests/lab)/' tests/support/*.h))))"' $(ROOM_SOURCES))
ROOM_NEEDS := $(call obj,$(filter $(if $(ROOM_USES),tests/support/%,$(wildcard tests/support/*.cpp)),$(SOURCES))) \
	$(if $(ROOM_USES),$(LAB) $(EMBED) $(RELAY) $(SERVER) $(CLIENT) $(WATCHERS) $(FRONT) $(RENDER))
ROOM_PROGRAM := $(OUT)/seam-tests-$(subst /,-,$(ROOM_FOLDER:tests/%=%))
$(ROOM_PROGRAM): $(sort $(ROOM_TESTS) $(ROOM_NEEDS)) $(OUT)/libseam-common.a
	$(LINK) $(LIBS) $(if $(ROOM_USES),$(RENDER_LIBS) $(SERVER_LIBS)) -lgtest -lgtest_main -o $@

check: build/.deps-build $(ROOM_PROGRAM)   ## ROOM=common/sync: build and run the tests of that room
	SEAM_BIN=$(OUT) $(ROOM_PROGRAM) --gtest_brief=1
else
check:
	@echo 'make check ROOM=FOLDER: the tests of one room, such as common/sync; all of them: make test' >&2; exit 2
endif

# A module with a sanitizer does not load into Python.
tests: build/.deps-build build/.deps-report build/.deps-test all $(OUT)/seam-tests $(OUT)/libseam.a $(SHARED) \
	$(if $(INSTRUMENT_$(BUILD)),,python)   ## build the tests

run-tests = SEAM_BIN=$(OUT) $(OUT)/seam-tests $(if $(FILTER),--gtest_filter='$(FILTER)')

test: tests                          ## build and run all tests (tests/run.sh), or FILTER='Suite.*'
	$(if $(FILTER),$(run-tests),tests/run.sh $(OUT))

sanitize:                            ## the tests of what reads from outside, under asan and ubsan: twenty minutes
	@$(MAKE) --no-print-directory BUILD=release build/.deps-build core-tests
	@$(MAKE) --no-print-directory BUILD=asan build/asan/seam-tests-core
	tests/run.sh build/asan seam-tests-core

FAST_TESTS := $(call obj,$(filter-out $(call slow,$(TEST_SOURCES)),$(TEST_SOURCES)))
$(OUT)/seam-tests-fast: $(COMMON) $(LAB) $(EMBED) $(RELAY) $(SERVER) $(CLIENT) $(WATCHERS) $(FRONT) $(RENDER) $(FAST_TESTS)
	$(LINK) $(LIBS) $(RENDER_LIBS) $(SERVER_LIBS) -lgtest -lgtest_main -o $@

check-fast: all $(OUT)/seam-tests-fast   ## build and run the tests that take no processes or long simulations
	SEAM_BIN=$(OUT) $(OUT)/seam-tests-fast --gtest_brief=1

check-includes: $(GEN)/.stamp build/.deps-python   ## compile each source by itself: does it include what it needs? ten minutes
	@$(MAKE) --no-print-directory -k UNITY=0 OUT=build/includes CXXFLAGS='$(CXXFLAGS) -fsyntax-only' objects
objects: $(OBJECTS_ALONE)

SECONDS ?= 600
fuzz: build/.deps-fuzz               ## TARGET='scene log' SECONDS=600: fuzz what reads from outside, in out/fuzz/; HOLE=1: find planted faults
	@$(MAKE) --no-print-directory BUILD=fuzz CXX=clang++ WARN=-w build/fuzz/seam-fuzz
	SEAM_FUZZ_HOLE=$(HOLE) tests/fuzz/fuzz.sh build/fuzz/seam-fuzz out/fuzz$(if $(HOLE),-hole) $(SECONDS) $(TARGET)
$(OUT)/seam-fuzz: $(call alone,tests/fuzz/fuzz_main.cpp client/embed/cluster.cpp) $(call obj,$(FUZZ)) $(SERVER) $(CLIENT) $(OUT)/libseam-common.a
	$(LINK) -fsanitize=fuzzer $(LIBS) $(SERVER_LIBS) -lgtest -o $@

soak: FILTER := $(SOAKED)
soak: tests                          ## SOAK=300: so many times the seeds of cluster and fuzz tests: half an hour
	SEAM_SOAK=$(SOAK) $(run-tests)

hashes: build/.deps-build build/.deps-hashes   ## golden hashes by g++ and clang++, -O0, -O2 and -march=x86-64-v3: all the same?
	MAKE='$(MAKE)' CXX='$(CXX)' tests/hashes.sh build/hashes

# No gate: what fails is named and the table comes all the same. What libgcov itself has to say goes
# to a file, since tests read stderr.
coverage: build/.deps-coverage       ## tests (or FILTER) under gcov: covered lines of each folder
	@$(MAKE) --no-print-directory BUILD=coverage tests
	@find build/coverage -name '*.gcda' -delete
	-@GCOV_ERROR_FILE='$(CURDIR)/build/coverage/gcov.log' $(MAKE) --no-print-directory BUILD=coverage test
	@gcovr --root . --object-directory build/coverage --filter '(common|server|client|render)/' \
	  --csv build/coverage/lines.csv build/coverage
	@awk -F, 'NR > 1 { d = $$1; sub(/\/[^\/]*$$/, "", d); all[d] += $$2; hit[d] += $$3; A += $$2; H += $$3 } \
	  END { for (d in all) printf "%-28s %5d of %5d lines  %5.1f %%\n", d, hit[d], all[d], 100 * hit[d] / all[d] | "sort"; \
	  close("sort"); printf "%-28s %5d of %5d lines  %5.1f %%\n", "all", H, A, 100 * H / A }' build/coverage/lines.csv

format: build/.deps-format           ## lay out every source by .clang-format
	git ls-files '*.h' '*.cpp' | xargs clang-format -i

lint: build/.deps-lint compile_commands.json $(GEN)/.stamp   ## clang-tidy by .clang-tidy: advice, no gate (FILES=...)
	@$(if $(FILES),echo $(FILES),git ls-files '*.cpp') | xargs -n 4 -P $(shell nproc) clang-tidy -p . --quiet 2>/dev/null \
	  | sed -u 's|^$(CURDIR)/||; s|^\./||' | awk '/(warning|error): / && !seen[$$0]++ { print; fflush() }'

# For clangd, clang-tidy and editors.
compile_commands.json:               ## how each .cpp is compiled, for editors
	@printf '%s\n' $(SOURCES) | awk -v dir='$(CURDIR)' -v out='$(OUT)' \
	  -v command='$(subst ','\'',$(subst ",\\",$(subst \,\\\\,$(strip $(CXX) $(ALL_CXXFLAGS)))))' \
	  'BEGIN { print "[" } { object = $$0; sub(/cpp$$/, "o", object); \
	  gen = ($$0 ~ /^common\/codec\//) ? " $(CODEC_CXXFLAGS)" : ""; \
	  printf "%s{\"directory\": \"%s\", \"file\": \"%s\", \"command\": \"%s%s -c %s -o %s/%s\"}", \
	    (NR > 1 ? ",\n" : ""), dir, $$0, command, gen, $$0, out, object } END { print "\n]" }' > $@

demo: all                            ## run the main job and draw it, into out/demo/
	SEAM_BIN=$(OUT) tests/demo.sh out/demo

fleet-demo: build/.deps-fleet build/.deps-report all   ## a room on three servers with etcd: one is killed, one drained; drawn in out/fleet/
	SEAM_BIN=$(OUT) tests/fleet_demo.sh out/fleet

bench: all                           ## cost of a step beside Box2D, hard cases: out/bench/
	@mkdir -p out/bench
	$(OUT)/seam-lab overhead -o out/bench/overhead.csv --force
	$(OUT)/seam-lab physics --grid quick -o out/bench/physics.csv --force

# Java is for this alone: `make spy` installs it, `install` and `deb` take the jar along where it is there already.
SPY := build/spy
LCM_JAR ?= /usr/share/java/lcm.jar
JAR := $(if $(and $(shell command -v javac),$(wildcard $(LCM_JAR))),$(SPY)/seam-types.jar)
$(SPY)/seam-types.jar: $(LCM_TYPES) | build/.deps-build $(if $(filter spy,$(MAKECMDGOALS)),build/.deps-spy)
	@rm -rf $(SPY) && mkdir -p $(SPY)/source $(SPY)/classes
	lcm-gen --java --jpath $(SPY)/source $(LCM_TYPES)
	javac -nowarn -cp $(LCM_JAR) -d $(SPY)/classes $(SPY)/source/seam/*.java
	jar cf $@ -C $(SPY)/classes .

spy: $(SPY)/seam-types.jar           ## lcm-spy with the messages' types: builds a jar, starts it where there is a display
	@echo 'With a display, and a room or a log on the bus (docs/recordings.md):'
	@echo '  export CLASSPATH=$(CURDIR)/$(SPY)/seam-types.jar JAVA_TOOL_OPTIONS=-XX:+IgnoreUnrecognizedVMOptions'
	@echo '  lcm-spy                          # what is on the bus: rates, fields, plots'
	@echo '  lcm-logplayer-gui session.lcm    # plays a log, with a slider'
	@if [ -n "$$DISPLAY" ]; then echo 'starting lcm-spy; its window ends it'; \
	  CLASSPATH='$(CURDIR)/$(SPY)/seam-types.jar' JAVA_TOOL_OPTIONS=-XX:+IgnoreUnrecognizedVMOptions lcm-spy; fi

# QUICK=1: fewer seeds and settings, in two minutes.
report: build/.deps-report all       ## speed against error: all the measurements, into out/report/ (QUICK=1)
	SEAM_BIN=$(OUT) FORCE=$(FORCE) FILL="$(FILL)" tests/report.sh out/report $(if $(QUICK),quick)

# QUICK=1: fewer players and seeds. FILL=docs/server.md puts the tables into that page.
relief: build/.deps-report all       ## what distribution takes off the server, beside its bars: out/relief/ (QUICK=1)
	$(OUT)/seam-lab relief $(if $(QUICK),--quick) -o out/relief/data/relief
	$(OUT)/seam-lab report out/relief/data -o out/relief $(if $(FILL),--markdown $(FILL))

install: all python $(OUT)/libseam.a $(SHARED) $(JAR)   ## programs, library, headers, Python, docs under PREFIX (DESTDIR)
	@$(MAKE) --no-print-directory install-built

DEST := $(DESTDIR)$(PREFIX)
# Where Debian's Python looks, below /usr and elsewhere.
PYTHON_SITE = $(DEST)/lib/python3$(if $(filter-out /usr,$(PREFIX)),.$(shell $(PYTHON3) -c 'import sys; print(sys.version_info[1])'))/dist-packages
define PKG_CONFIG_FILE
prefix=$${pcfiledir}/../..
libdir=$${prefix}/lib
includedir=$${prefix}/include

Name: seam2d
Description: A distributed 2D physics runtime: server, client, world, for C++
Version: $(VERSION)
Cflags: -std=c++17 -ffp-contract=off -pthread -I$${includedir} -I$(EIGEN)
Libs: -L$${libdir} -lseam $(LIBS) $(SERVER_LIBS) $(INSTRUMENT_$(BUILD))
endef
define PKG_CONFIG_FILE_C
prefix=$${pcfiledir}/../..
libdir=$${prefix}/lib
includedir=$${prefix}/include

Name: seam2d-c
Description: A distributed 2D physics runtime: world and session, for C
Version: $(VERSION)
Cflags: -I$${includedir}
Libs: -L$${libdir} -lseam2d
endef
define CMAKE_FILE
get_filename_component(seam2d_PREFIX "$${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
include(CMakeFindDependencyMacro)
find_dependency(Threads)
if(NOT TARGET seam2d::seam2d)
  add_library(seam2d::seam2d STATIC IMPORTED)  # C++
  set_target_properties(seam2d::seam2d PROPERTIES
    IMPORTED_LOCATION "$${seam2d_PREFIX}/lib/libseam.a"
    INTERFACE_INCLUDE_DIRECTORIES "$${seam2d_PREFIX}/include;$(EIGEN)"
    INTERFACE_COMPILE_FEATURES cxx_std_17
    INTERFACE_COMPILE_OPTIONS "-ffp-contract=off"
    INTERFACE_LINK_LIBRARIES "$(subst $() ,;,$(patsubst -l%,%,$(filter -l%,$(LIBS) $(SERVER_LIBS))));Threads::Threads;$(INSTRUMENT_$(BUILD))")
  add_library(seam2d::c SHARED IMPORTED)  # C
  set_target_properties(seam2d::c PROPERTIES
    IMPORTED_LOCATION "$${seam2d_PREFIX}/lib/$(notdir $(SHARED))"
    IMPORTED_SONAME "$(notdir $(SHARED))"
    INTERFACE_INCLUDE_DIRECTORIES "$${seam2d_PREFIX}/include")
endif()
endef
define CMAKE_VERSION_FILE
set(PACKAGE_VERSION "$(VERSION)")
if(PACKAGE_FIND_VERSION VERSION_EQUAL PACKAGE_VERSION)
  set(PACKAGE_VERSION_EXACT TRUE)
endif()
if(NOT PACKAGE_FIND_VERSION VERSION_GREATER PACKAGE_VERSION)
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
endif()
endef

install-built: export TEXT = $(PKG_CONFIG_FILE)
install-built: export TEXT_C = $(PKG_CONFIG_FILE_C)
install-built: export CMAKE_TEXT = $(CMAKE_FILE)
install-built: export CMAKE_VERSION_TEXT = $(CMAKE_VERSION_FILE)
install-built:                       ## the same, of what is built: builds nothing
	install -d '$(DEST)/bin' '$(DEST)/lib/pkgconfig' '$(DEST)/share/seam2d/scenes/hard'
	install -d '$(DEST)/share/seam2d/scenes/exact'
	install -s -m 755 $(PROGRAMS) '$(DEST)/bin'
	install -m 644 scenes/*.toml '$(DEST)/share/seam2d/scenes'
	install -m 644 scenes/hard/*.toml '$(DEST)/share/seam2d/scenes/hard'
	install -m 644 scenes/exact/*.toml '$(DEST)/share/seam2d/scenes/exact'
	install -d '$(DEST)/share/seam2d/cluster' '$(DEST)/share/seam2d/lcmtypes'
	install -m 755 tests/lab/shards/seam-sweep-parallel tests/lab/shards/seam-sweep.sbatch '$(DEST)/share/seam2d/cluster'
	install -m 644 $(LCM_TYPES) '$(DEST)/share/seam2d/lcmtypes'
	$(OUT)/seam-log types > '$(DEST)/share/seam2d/lcmtypes/fingerprints.txt'
	@if [ -e $(SPY)/seam-types.jar ]; then install -d '$(DEST)/share/java' && \
	  install -m 644 $(SPY)/seam-types.jar '$(DEST)/share/java'; fi
	install -d '$(DEST)/share/seam2d/deploy'
	install -m 644 server/deploy/* '$(DEST)/share/seam2d/deploy'
	sed -i 's|/usr/local|$(PREFIX)|g' '$(DEST)/share/seam2d/deploy/seam-server@.service'
	install -m 644 $(OUT)/libseam.a '$(DEST)/lib'
	strip --strip-debug '$(DEST)/lib/libseam.a'
	install -s -m 644 $(SHARED) '$(DEST)/lib'
	ln -sf $(notdir $(SHARED)) '$(DEST)/lib/libseam2d.so'
	install -d '$(DEST)/share/man/man1' '$(DEST)/share/bash-completion/completions'
	install -d '$(DEST)/share/zsh/site-functions' '$(DEST)/share/fish/vendor_completions.d'
	install -m 644 $(OUT)/share/seam.schema.json '$(DEST)/share/seam2d'
	install -m 644 $(OUT)/share/man/*.1 '$(DEST)/share/man/man1'
	install -m 644 $(OUT)/share/bash/* '$(DEST)/share/bash-completion/completions'
	install -m 644 $(OUT)/share/zsh/* '$(DEST)/share/zsh/site-functions'
	install -m 644 $(OUT)/share/fish/* '$(DEST)/share/fish/vendor_completions.d'
	CXX='$(CXX)' EIGEN='$(EIGEN)' client/embed/install_headers.sh '$(DEST)/include'
	@echo "$$TEXT" > '$(DEST)/lib/pkgconfig/seam2d.pc'
	@echo "$$TEXT_C" > '$(DEST)/lib/pkgconfig/seam2d-c.pc'
	install -d '$(DEST)/lib/cmake/seam2d' '$(DEST)/share/doc/seam2d'
	@echo "$$CMAKE_TEXT" > '$(DEST)/lib/cmake/seam2d/seam2d-config.cmake'
	@echo "$$CMAKE_VERSION_TEXT" > '$(DEST)/lib/cmake/seam2d/seam2d-config-version.cmake'
	install -m 644 README.md CHANGELOG.md docs/*.md '$(DEST)/share/doc/seam2d'
	install -m 644 LICENSE '$(DEST)/share/doc/seam2d/copyright'
	@if [ -e $(OUT)/python/.stamp ]; then install -d '$(PYTHON_SITE)/seam' && \
	  install -m 644 $(PYTHON_TEXTS) '$(PYTHON_SITE)/seam' && \
	  install -s -m 644 $(OUT)/python/seam/_seam.so '$(PYTHON_SITE)/seam'; fi

deb: build/.deps-deb all python $(OUT)/libseam.a $(SHARED) $(JAR)   ## Debian packages of programs, library and Python: out/deb/
	MAKE='$(MAKE)' PYTHON3='$(PYTHON3)' BUILD='$(BUILD)' VERSION='$(VERSION)' client/embed/make_deb.sh out/deb

clean:                               ## remove build/ and out/
	rm -rf build out

-include $(wildcard $(OBJECTS:.o=.d) $(PRECOMPILED_ALL:=.d))
