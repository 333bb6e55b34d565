# Seam2D. `make help` lists what there is to do.
#
# Layout: every .cpp under common/ goes into libseam.a; server/, client/ and render/ each hold one
# program's files with main in main.cpp (render/ holds seam-measure's main too); tests/ is one
# GoogleTest program, tests/lab/ is seam-lab, which alone has server and clients in one process.
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
WARN := -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror
CXXFLAGS_release := -O2 -g1
CXXFLAGS_debug := -O0 -g
CXXFLAGS_asan := -O1 -g1 -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer
CXXFLAGS_tsan := -O1 -g1 -fsanitize=thread
ifeq ($(CXXFLAGS_$(BUILD)),)
$(error BUILD must be release, debug, asan or tsan, not "$(BUILD)")
endif
# -ffp-contract=off is part of the determinism contract: no fused multiply-add.
ALL_CXXFLAGS := -std=c++17 $(CXXFLAGS_$(BUILD)) -ffp-contract=off $(WARN) -MMD -MP -I. \
	-isystem $(GEN) -isystem /usr/include/eigen3 -isystem /usr/include/freetype2 -pthread $(CXXFLAGS)
LIBS := -llcm -lbox2d -lfmt -pthread
RENDER_LIBS := -lOSMesa -lpng -lfreetype
SERVER_LIBS := -llua5.4

DEBS := g++ make pkg-config liblcm-dev liblcm-bin libbox2d-dev libeigen3-dev libosmesa6-dev \
	liblua5.4-dev libcli11-dev libtoml11-dev libfmt-dev libpng-dev libfreetype-dev fonts-dejavu-core \
	libgtest-dev iproute2 util-linux

# All .cpp below a folder; and their objects.
below = $(sort $(shell find $(1) -name '*.cpp'))
obj = $(patsubst %.cpp,$(OUT)/%.o,$(1))
MAINS := server/main.cpp client/main.cpp render/main.cpp render/measure_main.cpp tests/lab/main.cpp
COMMON := $(call obj,$(call below,common))
SERVER := $(call obj,$(filter-out $(MAINS),$(call below,server)))
CLIENT := $(call obj,$(filter-out $(MAINS),$(call below,client)))
RENDER := $(call obj,$(filter-out $(MAINS),$(call below,render)))
LAB := $(call obj,$(filter-out $(MAINS) %_test.cpp,$(call below,tests/lab)))
TESTS := $(call obj,$(filter %_test.cpp tests/support/%,$(call below,tests)))
PROGRAMS := $(addprefix $(OUT)/,seam-server seam-client seam-render seam-measure seam-lab)
LCM_TYPES := $(sort $(wildcard lcmtypes/*.lcm))

.DEFAULT_GOAL := all
.PHONY: all help deps demo bench report test tests install clean

all: deps $(PROGRAMS)                ## build the programs

help:                                ## this list
	@echo "make targets (BUILD=release|debug|asan|tsan, default release; PREFIX=/usr/local):"
	@sed -n 's/^\([a-z]*\):.*## \(.*\)/  \1	\2/p' Makefile | expand -t 12

deps:                                ## install the Debian packages that are missing
	@missing=""; for p in $(DEBS); do \
	  dpkg-query -W -f='$${Status}' $$p 2>/dev/null | grep -q "ok installed" || missing="$$missing $$p"; done; \
	if [ -n "$$missing" ]; then \
	  command -v apt-get >/dev/null || { echo "make deps: this is not Debian; please install:$$missing" >&2; exit 1; }; \
	  SUDO=""; [ "$$(id -u)" = 0 ] || SUDO=sudo; \
	  [ -z "$$SUDO" ] || command -v sudo >/dev/null || { echo "make deps: not root and no sudo; as root run: apt-get install$$missing" >&2; exit 1; }; \
	  echo "installing:$$missing"; \
	  $$SUDO apt-get update -qq && $$SUDO env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $$missing >/dev/null \
	  || { echo "make deps: apt-get failed; by hand: apt-get install$$missing" >&2; exit 1; }; fi

$(GEN)/.stamp: $(LCM_TYPES) lcmtypes/harden.awk | deps
	@rm -rf $(GEN) && mkdir -p $(GEN)
	lcm-gen --cpp --cpp-std c++11 --cpp-hpath $(GEN) $(LCM_TYPES)
	@for h in $(GEN)/seam/*.hpp; do awk -f lcmtypes/harden.awk $$h > $$h.tmp && mv $$h.tmp $$h || exit 1; done
	@touch $@

$(OUT)/%.o: %.cpp $(GEN)/.stamp
	@mkdir -p $(@D)
	$(CXX) $(ALL_CXXFLAGS) -c $< -o $@

$(OUT)/libseam.a: $(COMMON)
	@rm -f $@
	@ar rcs $@ $^
$(OUT)/seam-server: $(OUT)/server/main.o $(SERVER) $(OUT)/libseam.a
	$(CXX) $(ALL_CXXFLAGS) $^ $(LIBS) $(SERVER_LIBS) -o $@
$(OUT)/seam-client: $(OUT)/client/main.o $(CLIENT) $(OUT)/libseam.a
	$(CXX) $(ALL_CXXFLAGS) $^ $(LIBS) -o $@
$(OUT)/seam-render: $(OUT)/render/main.o $(RENDER) $(OUT)/libseam.a
	$(CXX) $(ALL_CXXFLAGS) $^ $(LIBS) $(RENDER_LIBS) -o $@
$(OUT)/seam-measure: $(OUT)/render/measure_main.o $(OUT)/libseam.a
	$(CXX) $(ALL_CXXFLAGS) $^ $(LIBS) -o $@
$(OUT)/seam-lab: $(OUT)/tests/lab/main.o $(LAB) $(SERVER) $(CLIENT) $(OUT)/libseam.a
	$(CXX) $(ALL_CXXFLAGS) $^ $(LIBS) $(SERVER_LIBS) -o $@
$(OUT)/seam-tests: $(TESTS) $(LAB) $(SERVER) $(CLIENT) $(RENDER) $(OUT)/libseam.a
	$(CXX) $(ALL_CXXFLAGS) $^ $(LIBS) $(RENDER_LIBS) $(SERVER_LIBS) -lgtest -lgtest_main -o $@

tests: deps $(OUT)/seam-tests $(PROGRAMS)   ## build the tests

test: tests                          ## build and run all tests
	SEAM_BIN=$(OUT) $(OUT)/seam-tests

demo: all                            ## run the main job and draw it, into out/demo/
	SEAM_BIN=$(OUT) tests/demo.sh out/demo

bench: all                           ## cost of a step beside Box2D, hard cases: out/bench/
	@mkdir -p out/bench
	$(OUT)/seam-lab overhead -o out/bench/overhead.csv --force
	$(OUT)/seam-lab physics --grid quick -o out/bench/physics.csv --force

# QUICK=1: fewer seeds and settings, in two minutes.
report tests test: DEBS += gnuplot-nox
report: all                          ## speed against error: all the measurements, into out/report/ (QUICK=1)
	SEAM_BIN=$(OUT) FORCE=$(FORCE) tests/report.sh out/report $(if $(QUICK),quick)

install: all                         ## install the programs under PREFIX
	install -d $(DESTDIR)$(PREFIX)/bin $(DESTDIR)$(PREFIX)/share/seam2d/scenes
	install -m 755 $(PROGRAMS) $(DESTDIR)$(PREFIX)/bin
	install -d $(DESTDIR)$(PREFIX)/share/seam2d/scenes/hard
	install -m 644 $(wildcard scenes/*.toml) $(DESTDIR)$(PREFIX)/share/seam2d/scenes
	install -m 644 $(wildcard scenes/hard/*.toml) $(DESTDIR)$(PREFIX)/share/seam2d/scenes/hard

clean:                               ## remove build/ and out/
	rm -rf build out

-include $(shell find $(OUT) -name '*.d' 2>/dev/null)
