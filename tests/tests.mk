# The tests. Every program and script here prints TAP; tests/tally counts the lines and prints the last one.
#
#   tests/*.c tests/{xt,3d,osiris,runtime,borg,linux}/*.c       CMocka, one program each
#   tests/kernels/*.c, tests/guarded/*.c     what tests/check_kernels.c knows of each row kernel
#   tests/calls/*.c                          what tests/random_calls.c knows of each operation
#   tests/digest/*.c                         one program: a digest per operation, the same list on every processor
#   tests/target/test_*.c                    bare metal, Unity, one firmware each; tests/target/bridge runs the host's tests there
#   tests/fuzz/*.c                           libFuzzer, one target each
#   tests/rig/{guest,real_time}/*.c *.sh     run in a virtual machine with real drivers (tests/rig/boot); so does tests/linux
#   tests/rig/soak/*.c *.sh                  run there for many minutes of its own clock
#   tests/check_*.sh                         the rules of the house; any other tests/*.sh is run with the host's tool

ifdef IRIS_DATA
  export IRIS_DATA := $(abspath $(IRIS_DATA))
endif
export RUNNER CROSS_COMPILE OUT

# --- one configuration: this PORT, this compiler, these flags ---

# tests/linux needs a kernel's own terminals: emulators of user programs do not know all of their calls.
UNIT_SRC := $(if $(filter lite,$(PROFILE)),$(LITE_TESTS),$(wildcard tests/*.c tests/xt/*.c tests/3d/*.c tests/osiris/*.c tests/runtime/*.c tests/borg/*.c $(if $(RUNNER),,tests/$(OS)/*.c)))
# LEFT_OUT names those that would take minutes under an emulator.
LEFT_OUT ?=
UNIT_SRC := $(filter-out $(LEFT_OUT:%=tests/%.c),$(UNIT_SRC))
UNIT_BIN := $(UNIT_SRC:tests/%.c=$(OUT)/tests/%$(EXE))
KERNELINC := -Isrc/foundation -Iport/cpu/$(PORT)
TESTINC   = -Iinclude -Itests $(if $(filter %/check_kernels$(EXE),$@),$(KERNELINC))
CMOCKAINC := $(if $(SYSROOT),-isystem $(SYSROOT)/usr/include)
CMOCKA   := $(CMOCKAINC) $(if $(SYSROOT),-L$(SYSROOT)/usr/lib/$(CROSS_COMPILE:%-=%)) -lcmocka

$(OUT)/tests/%$(EXE): tests/%.c $(OSLIB) $(LIB)
	@mkdir -p $(@D)
	$(SAY)
	$(Q)$(CC) $(USERWARN) $(BASE) $(TESTINC) $(POSIX) -o $@ $(filter %.c %.o,$^) $(filter %.a,$^) $(LDFLAGS) $(SYSTEM_LIBS) $(CMOCKA) -lm

$(OUT)/tests/%.o: tests/%.c
	@mkdir -p $(@D)
	$(SAY)
	$(Q)$(CC) $(USERWARN) $(BASE) $(TARGETINC) -Iinclude -c -o $@ $<

CALLS_OBJ := $(patsubst %.c,$(OUT)/%.o,$(wildcard tests/calls/*.c))
$(CALLS_OBJ): TARGETINC := -Itests $(CMOCKAINC)
$(OUT)/tests/random_calls$(EXE): $(CALLS_OBJ)

KERNEL_OBJ := $(patsubst %.c,$(OUT)/%.o,$(filter-out %/gain.c,$(wildcard tests/kernels/*.c)))
$(KERNEL_OBJ) $(OUT)/tests/kernels/gain.o: TARGETINC := -Itests $(KERNELINC) $(CMOCKAINC)
$(OUT)/tests/check_kernels$(EXE): $(KERNEL_OBJ) $(OUT)/tests/guarded/$(HOSTED).o
$(OUT)/tests/guarded/%.o: TARGETINC := $(POSIX)
$(OUT)/tests/kernels/gain.o: TARGETINC += -Itools/bench $(POSIX)

# What the port's kernels are worth beside the plain bodies as the compiler makes them.
$(OUT)/kernel_gain: $(OUT)/tests/kernels/gain.o $(KERNEL_OBJ) $(LIB)
	$(SAY)
	$(Q)$(CC) $(BASE) -o $@ $^ $(LDFLAGS) $(CMOCKA) -lm

DIGEST_OBJ  := $(patsubst %.c,$(OUT)/%.o,$(wildcard tests/digest/*.c))
DIGEST_HOST := $(OUT)/tests/digest/host.o
DIGEST      := $(if $(DIGEST_OBJ),$(OUT)/digest$(EXE))
$(OUT)/digest$(EXE): $(DIGEST_OBJ) $(LIB)
	$(SAY)
	$(Q)$(CC) $(BASE) -o $@ $(filter %.c %.o %.a,$^) $(LDFLAGS)

unit: $(UNIT_BIN) ## builds and runs the CMocka tests of this PORT and these flags
	@tests/programs $(UNIT_BIN) | tests/tally

.PHONY: unit verify verify-host verify-target
PURITY := $(if $(CHECKED),,@echo '# rules'; tests/check_purity.sh $(LIB) $(filter-out $(CXXLIB),$(OSLIB)); tests/check_stack.sh $(OUT))
verify-host: lib $(UNIT_BIN) $(DIGEST)
	@tests/programs $(UNIT_BIN)
	$(if $(LEFT_OUT),@for t in $(LEFT_OUT); do echo "ok - $$t # SKIP takes long here"; done)
	$(if $(DIGEST),@echo '# digests'; tests/check_digests.sh $(RUNNER) $(DIGEST))
	$(PURITY)

# PROFILE=lite: every function promised is there, and links without the rest of the library.
verify-lite: lib $(UNIT_BIN)
	@tests/programs $(UNIT_BIN)
	@tests/check_lite.sh $(LIB) $(LITE_FUNCTIONS) -- $(LITE_WITHOUT)
	$(PURITY)
.PHONY: verify-lite

# --- bare metal: MACHINE is one of QEMU's; UNITY_ROOT is a checkout of Unity, else tests/target/unity speaks its macros ---

# The boards' fast memory, and the large one of those that run the library's tests.
MEMORY_microbit         := FLASH=0x40000 RAM_AT=0x20000000 RAM=0x4000
MEMORY_mps2-an385       := FLASH=0x400000 RAM_AT=0x20000000 RAM=0x400000
MEMORY_mps2-an386       := FLASH=0x400000 RAM_AT=0x20000000 RAM=0x400000
MEMORY_mps3-an547       := FLASH=0x80000 RAM_AT=0x21000000 RAM=0x400000
LARGE_MEMORY_mps2-an386 := FLASH=0x400000 RAM_AT=0x21000000 RAM=0x1000000
LARGE_MEMORY_mps2-an385 := FLASH=0x400000 RAM_AT=0x21000000 RAM=0x1000000
LARGE_MEMORY_mps2-an500 := FLASH=0x400000 RAM_AT=0x60000000 RAM=0x1000000
LARGE_MEMORY_mps3-an547 := FLASH=0x80000 RAM_AT=0x60000000 RAM=0x2000000
MEMORY                   = $(MEMORY_$(MACHINE))
STACK ?= 2048
LINK   = -nostartfiles --specs=nano.specs -T tests/target/target.ld -Wl,--gc-sections \
         $(patsubst %,-Wl$(comma)--defsym=%,$(MEMORY) STACK=$(STACK))
UNITY_ROOT ?=
UNITY_SRC  := $(if $(UNITY_ROOT),$(UNITY_ROOT)/src,tests/target/unity)
UNITY      := -I$(UNITY_SRC)
TARGETINC  := -Itests/target $(UNITY) -DUNITY_INCLUDE_CONFIG_H

TARGET_OBJ := $(patsubst %.c,$(OUT)/%.o,$(wildcard tests/target/*.c))
START      := $(OUT)/tests/target/startup.o $(OUT)/tests/target/runtime.o
BOARD      := $(filter-out %/firmware.o %/team.o $(OUT)/tests/target/test_%,$(TARGET_OBJ))
FIRMWARE   := $(patsubst tests/target/%.c,$(OUT)/%.elf,$(wildcard tests/target/test_*.c))
.SECONDARY: $(TARGET_OBJ)
$(OUT)/tests/target/runtime.o: BASE += -fno-lto -fno-tree-loop-distribute-patterns # memcpy is not a loop that calls memcpy
# The example as firmware; and for the test of it with another main.
$(OUT)/firmware.elf: $(OUT)/firmware_follow.o $(OUT)/tests/target/firmware.o $(BOARD) $(LIB)
	$(SAY)
	$(Q)$(CC) $(BASE) $(LINK) -o $@ $(filter %.c %.o %.a,$^)
$(OUT)/firmware.elf: BASE += -fcallgraph-info=su
# One robot of a team.
$(OUT)/member.elf: $(OUT)/firmware_machine.o $(OUT)/tests/target/team.o $(BOARD) $(LIB)
	$(SAY)
	$(Q)$(CC) $(BASE) $(LINK) -o $@ $(filter %.c %.o %.a,$^)
$(OUT)/member.elf: BASE += -fcallgraph-info=su
$(OUT)/tests/target/team.o: TARGETINC += -Iinclude
$(OUT)/firmware_machine.o: examples/firmware_machine.c
	$(SAY)
	$(Q)$(CC) $(USERWARN) $(BASE) $(TARGETINC) -Iinclude -c -o $@ $<
$(OUT)/runtime.ci: tests/target/runtime.c # what is linked to it without being seen by the compiler
	$(Q)CCACHE_DISABLE=1 $(CC) $(filter-out -flto,$(BASE)) -fno-tree-loop-distribute-patterns -fcallgraph-info=su -c -o $(OUT)/runtime.o $<
	@test -e $@ # a cache of compilers may leave it out
$(OUT)/firmware_painted.elf: $(OUT)/firmware_follow.o $(OUT)/firmware_painted.o $(BOARD) $(LIB)
	$(SAY)
	$(Q)$(CC) $(BASE) $(LINK) -o $@ $(filter %.c %.o %.a,$^)
$(OUT)/firmware_painted.o: tests/target/firmware.c
	$(SAY)
	$(Q)$(CC) $(USERWARN) $(BASE) $(TARGETINC) -DTELL_STACK -c -o $@ $<
# All that IRIS-Lite promises, called by nobody.
$(OUT)/lite.elf: $(OUT)/tests/target/runtime.o $(LIB)
	$(SAY)
	$(Q)$(CC) $(BASE) -nostartfiles --specs=nano.specs -Wl,--gc-sections,-e,iris_status_text,-Ttext=0 -o $@ \
	    $(LITE_FUNCTIONS:%=-Wl,--require-defined=%) $(filter %.o %.a,$^)

$(OUT)/test_follow.elf: $(OUT)/follow_main.o
$(OUT)/follow_main.o: TARGETINC := -Dmain=follow_main
$(OUT)/firmware_follow.o $(OUT)/follow_main.o: examples/firmware_follow.c
	$(SAY)
	$(Q)$(CC) $(USERWARN) $(BASE) $(TARGETINC) -Iinclude -c -o $@ $<
$(OUT)/test_%.elf: $(OUT)/tests/target/test_%.o $(BOARD) $(OUT)/unity.o $(LIB)
	$(SAY)
	$(Q)$(CC) $(BASE) $(LINK) -o $@ $(filter %.o,$^) $(LIB)
$(OUT)/digest.elf: STACK := 3072 # fits a floor: solving equations takes more than looking at a frame
$(OUT)/digest.elf: $(filter-out $(DIGEST_HOST),$(DIGEST_OBJ)) $(START) $(LIB)
	$(SAY)
	$(Q)$(CC) $(BASE) $(LINK) -o $@ $(filter %.c %.o %.a,$^)
$(OUT)/unity.o: $(UNITY_SRC)/unity.c
	$(SAY)
	$(Q)$(CC) $(BASE) $(TARGETINC) -c -o $@ $<

# The tests of the host, CMocka's, on bare metal: as Unity's, with the C library for files, heap, and the doubles that they
# compare with. Without optimizing as a whole, which would take longer than all the tests.
# On 16 KB of a microbit those that fit.
MODULE_SRC := $(filter-out tests/check_kernels.c tests/random_calls.c tests/bmp_suite.c,$(wildcard tests/*.c tests/xt/*.c tests/3d/*.c tests/osiris/*.c tests/runtime/*.c tests/borg/*.c))
MODULE_LARGE := xt/blob xt/blob_shape# take 24 MB
MODULE_SLOW_mps2-an500 := hsl xt/birdseye xt/blur xt/contour xt/edge xt/floor# minutes under an emulator: the M55 runs them
MODULE_ONLY_microbit   := border command differential fixed image indicator nv12 pwm stream watchdog wide xt/floor_text xt/follow_signature xt/hitmiss \
                          xt/junction_latch xt/pursuit xt/steer xt/votes
MODULE_NAMES := $(or $(MODULE_ONLY_$(MACHINE)),$(filter-out $(MODULE_SLOW_$(MACHINE)),$(MODULE_SRC:tests/%.c=%)))
MODULE     := $(patsubst %,$(OUT)/module/%.elf,$(filter-out $(MODULE_LARGE),$(MODULE_NAMES)))
MODULE_LINK = $(subst --specs=nano.specs,--specs=rdimon.specs,$(LINK)) -fno-lto -Wl,--wrap=_sbrk -Wl,--defsym=end=link_bss_end
BRIDGE     := $(OUT)/module/cmocka.o $(OUT)/tests/target/startup.o $(OUT)/unity.o
BRIDGEINC  := -Itests/target/bridge $(TARGETINC)
$(OUT)/module/cmocka.o: tests/target/bridge/cmocka.c
	@mkdir -p $(@D)
	$(SAY)
	$(Q)$(CC) $(USERWARN) $(BASE) -fno-lto $(BRIDGEINC) -c -o $@ $<
$(OUT)/module/%.o: tests/%.c
	@mkdir -p $(@D)
	$(SAY)
	$(Q)$(CC) $(USERWARN) -Wno-format $(BASE) -fno-lto $(BRIDGEINC) -Iinclude -Itests -c -o $@ $<
$(OUT)/module/%.elf: STACK := $(if $(LARGE_MEMORY_$(MACHINE)),0x40000,3072)
$(OUT)/module/%.elf: MEMORY = $(or $(LARGE_MEMORY_$(MACHINE)),$(MEMORY_$(MACHINE)))
$(OUT)/module/%.elf: $(OUT)/module/%.o $(BRIDGE) $(LIB)
	$(SAY)
	$(Q)$(CC) $(BASE) $(MODULE_LINK) -o $@ $(filter %.o,$^) $(filter %.a,$^) -lm
# The row kernels. The microbit has no room for them: its code runs on the board with an M3.
KERNEL_BOARD := $(if $(filter microbit,$(MACHINE)),mps2-an385,$(MACHINE))
KERNEL_MODULE := $(OUT)/module/check_kernels.elf
$(KERNEL_MODULE): STACK := 0x40000
$(KERNEL_MODULE): MEMORY = $(LARGE_MEMORY_$(KERNEL_BOARD))
KERNEL_MODULE_OBJ := $(patsubst tests/%.c,$(OUT)/module/%.o,$(filter-out %/gain.c,$(wildcard tests/kernels/*.c)))
$(OUT)/module/check_kernels.o $(KERNEL_MODULE_OBJ): BRIDGEINC += $(KERNELINC)
$(OUT)/module/check_kernels.elf: $(KERNEL_MODULE_OBJ) $(OUT)/module/guarded/bare.o
verify-modules: $(MODULE)
	@for elf in $(MODULE); do TIMEOUT=300 tests/target/run $(MACHINE) $$elf --unity; done
	@for module in $(filter $(MODULE_LARGE),$(MODULE_NAMES)); do echo "ok - $$module # SKIP more memory than $(MACHINE) has"; done

verify-target: lib $(FIRMWARE) $(OUT)/member.elf $(KERNEL_MODULE) $(if $(DIGEST),$(OUT)/digest.elf)
	@for elf in $(FIRMWARE); do tests/target/run $(MACHINE) $$elf --unity; done
	@test "$$(tests/target/run $(MACHINE) $(OUT)/member.elf | tr -dc '0-9 ')" = ' 11 08 09 11 07 01 01' || printf 'not '; \
	    echo 'ok - a member of a team explores, goes, and stops'
	@tests/target/run $(KERNEL_BOARD) $(KERNEL_MODULE) --unity
	$(if $(DIGEST),@echo '# digests'; tests/check_digests.sh tests/target/run $(MACHINE) $(OUT)/digest.elf)
	$(PURITY)

# --- fuzzing: clang's libFuzzer over the whole library built with it ---

FUZZ_SRC := $(wildcard tests/fuzz/*.c)
FUZZ_BIN := $(FUZZ_SRC:tests/fuzz/%.c=$(OUT)/fuzz/%)
FUZZ_MAKE = $(MAKE) -s CC=clang CXX=clang++ CROSS_COMPILE= PORT=generic OPT=-O1 CHECKED=1 FUZZER=1
$(OUT)/fuzz/%: tests/fuzz/%.c $(OSLIB) $(LIB)
	@mkdir -p $(@D)
	$(SAY)
	$(Q)$(CC) $(USERWARN) $(BASE) -fsanitize=fuzzer -Iinclude -o $@ $(filter %.c %.o,$^) $(filter %.a,$^) $(LDFLAGS) $(FUZZ_LIBS)
$(OUT)/fuzz/calls: $(CALLS_OBJ)
$(OUT)/fuzz/calls: FUZZ_LIBS := -lcmocka

FUZZ_RUNS ?= 20000
FUZZ_TIME ?= 60
fuzz: ## fuzzes for FUZZ_TIME seconds each, or one target alone with FUZZ=name
	+@$(FUZZ_MAKE) fuzz-long
fuzz-long: $(if $(FUZZ),$(OUT)/fuzz/$(FUZZ),$(FUZZ_BIN))
	@tests/fuzz/run -max_total_time=$(FUZZ_TIME) $^ | tests/tally
verify-fuzz: $(FUZZ_BIN)
	@tests/fuzz/run -runs=$(FUZZ_RUNS) $^
.PHONY: fuzz fuzz-long verify-fuzz

# --- Linux: an arm64 kernel with real drivers in QEMU, which tests/rig/prepare makes and tests/rig/boot starts ---

# What speaks to the host (real_time) takes the host's time, all else the guest's own.
in_rig      = $(patsubst tests/%.c,$(OUT)/tests/%,$(1))
RIG_SRC    := $(wildcard tests/linux/*.c $(foreach d,real_time guest,tests/rig/$(d)/*.c tests/rig/$(d)/*.sh))
RIG_SLOW   := $(addprefix tests/rig/,$(addprefix real_time/,gpio_follow.c main_job.sh camera_commands.sh) guest/borg_networks.sh)
RIG_GPIO   := $(filter tests/linux/gpio% tests/rig/guest/gpio% tests/rig/real_time/gpio%,$(RIG_SRC))
RIG_SOAK   := $(wildcard tests/rig/soak/*.c tests/rig/soak/*.sh)
RUN        ?= tests/rig/real_time/rig.sh
RUN_SLOW   := $(filter tests/rig/real_time/%,$(RUN))
RUN_QUICK  := $(filter-out $(RUN_SLOW),$(RUN))
# What the scripts there need beside the tool. The simulator computes with doubles, for which the emulator takes minutes: a
# native build of its own renders the course.
RIG_AIDS   := $(OUT)/tests/rig/push_frames $(OUT)/host/course/small/truth.txt
$(OUT)/host/course/small/truth.txt: $(wildcard tools/sim/*)
	@env -i PATH="$$PATH" HOME="$$HOME" $(MAKE) -s BUILD=$(OUT)/host course
run-rig: all $(RIG_AIDS) $(filter $(OUT)/%,$(call in_rig,$(RUN)))
	$(if $(RUN_SLOW),@tests/rig/boot $(RIG) $(OUT) $(call in_rig,$(RUN_SLOW)))
	$(if $(RUN_QUICK),@tests/rig/boot --own-clock $(RIG) $(OUT) $(call in_rig,$(RUN_QUICK)))
	$(if $(RUN_LEFT),@for t in $(RUN_LEFT); do echo "ok - $$t # SKIP with sanitizers in the emulator it takes longer than it may"; done)
.PHONY: run-rig

# --- checks of the sources, examples, and the scripts of tests/*.sh ---

verify-house:
	@tests/check_layers.sh
	@tests/check_sizes.sh
	@tests/check_headers.sh

# Run in their own folder, without arguments and input.
verify-examples: $(EXAMPLES)
	@cd $(OUT)/examples && for e in $(notdir $(EXAMPLES)); do \
	    if timeout 60 ./$$e > $$e.log 2>&1 < /dev/null; then echo "ok - example $$e"; \
	    else echo "not ok - example $$e"; tail -5 $$e.log | sed 's/^/# /'; fi; done

SCRIPTS := $(filter-out tests/check_%,$(wildcard tests/*.sh))
verify-scripts: all
	@TIMEOUT=1200 tests/programs $(SCRIPTS)

# Windows programs, run by Wine: its server stays between them, so that none meets the end of the last one's. It needs the
# folder, which Wine itself would make later. The first program starts Wine's services, which stay, too, and would keep a
# pipe open that it writes to.
WINE_SCRIPTS := tests/tool.sh tests/tool_blobs.sh tests/tool_lock.sh tests/tool_pyramid.sh
$(OUT)/wine-iris: $(TOOL)
	@printf '#!/bin/sh\nexec %s "%s" "$$@"\n' '$(RUNNER)' '$(abspath $(TOOL))' > $@ && chmod +x $@
verify-windows: all $(OUT)/wine-iris
	@mkdir -p "$$WINEPREFIX" && { $(dir $(WINE))wineserver64 -p300 || true; }
	@$(RUNNER) cmd /c exit > /dev/null 2>&1 < /dev/null || true
	+@$(MAKE) -s verify-host
	@RUNNER= IRIS=$(OUT)/wine-iris NOT_HERE=tests/not_on_windows tests/programs $(WINE_SCRIPTS)
.PHONY: verify-house verify-examples verify-scripts verify-windows

# --- all of it: each layer is a make of its own, and no two of them share a build folder at the same time ---

TAP      := $(BUILD)/tap
JOBS      = $(if $(filter -j% --jobserver%,$(MAKEFLAGS)),,-j$(shell nproc 2>/dev/null || echo 2))
CACHE    := $(or $(XDG_CACHE_HOME),$(HOME)/.cache)/iris
A64_ROOT := $(CACHE)/arm64
A32_ROOT := $(CACHE)/armhf
BIG_ROOT := $(CACHE)/s390x
NATIVE   := $(MAKE) -s CHECKED= CROSS_COMPILE=
A64      := $(MAKE) -s CHECKED= CC=aarch64-linux-gnu-gcc CROSS_COMPILE=aarch64-linux-gnu- SYSROOT=$(A64_ROOT) OS=linux PORT=neon \
            RUNNER="qemu-aarch64 -L /usr/aarch64-linux-gnu -E LD_LIBRARY_PATH=$(A64_ROOT)/usr/lib/aarch64-linux-gnu"
A32      := $(MAKE) -s CHECKED= CC=arm-linux-gnueabihf-gcc CROSS_COMPILE=arm-linux-gnueabihf- SYSROOT=$(A32_ROOT) OS=linux PORT=neon \
            RUNNER="qemu-arm -L /usr/arm-linux-gnueabihf -E LD_LIBRARY_PATH=$(A32_ROOT)/usr/lib/arm-linux-gnueabihf"
# Big-endian. What it leaves out takes long and computes with numbers; the digests look at that, too.
BIG      := $(MAKE) -s CHECKED= CC=s390x-linux-gnu-gcc CROSS_COMPILE=s390x-linux-gnu- SYSROOT=$(BIG_ROOT) OS=linux PORT=generic \
            LEFT_OUT="check_kernels hsl xt/birdseye xt/blur xt/edge xt/floor xt/hough_circle xt/hough_directed xt/hough_shape \
                      xt/shape_match" \
            RUNNER="qemu-s390x -L /usr/s390x-linux-gnu -E LD_LIBRARY_PATH=$(BIG_ROOT)/usr/lib/s390x-linux-gnu"
# In the virtual machine. Its root is the sysroot, with libgpiod of API 1; libgpiod of API 2 lies in a folder of its own.
# Libraries there need others, in two folders.
RIG      := $(CACHE)/rig
RIG_NEEDS := aarch64-linux-gnu-gcc qemu-system-aarch64 python3 cpio $(RIG)/made-$(shell sed -n 's/^recipe=//p' tests/rig/prepare)
on_rig    = $(MAKE) -s CHECKED= CC=aarch64-linux-gnu-gcc CROSS_COMPILE=aarch64-linux-gnu- SYSROOT=$(RIG)/root OS=linux PORT=neon \
            LDFLAGS="$(patsubst %,-Wl$(comma)-rpath-link$(comma)$(RIG)/root%lib/aarch64-linux-gnu,/usr/ /)" \
            PKG_CONFIG="env PKG_CONFIG_SYSROOT_DIR=$(RIG)/root PKG_CONFIG_LIBDIR=$(1)$(RIG)/root/usr/lib/aarch64-linux-gnu/pkgconfig pkg-config"
ON_RIG   := $(call on_rig)
ON_RIG_2 := $(call on_rig,$(RIG)/root/opt/gpiod2/lib/pkgconfig:)
# Windows. The first program that Wine runs here makes a folder in the cache, which takes a while. Wine wants some addresses
# for itself: where a system gives them out at random, one start in some thousands finds one taken and ends, saying nothing.
WIN_ROOT := $(CACHE)/windows
WINE     := /usr/lib/wine/wine64
FIXED_ADDRESSES := $(if $(shell setarch -R true 2> /dev/null && echo yes),setarch -R )
WIN      := env WINEPREFIX=$(CACHE)/wine WINEDEBUG=-all WINEDLLOVERRIDES="winemenubuilder.exe,winedbg.exe,mscoree,mshtml=d" \
            $(MAKE) -s CHECKED= CC=x86_64-w64-mingw32-gcc CROSS_COMPILE=x86_64-w64-mingw32- SYSROOT=$(WIN_ROOT) OS=none PORT=sse \
            RUNNER="$(FIXED_ADDRESSES)$(WINE)"
# Firmware is small: optimized as a whole, without what moves and copies code for speed. Fat objects serve all other tools.
BARE     := $(MAKE) -s CHECKED= CC=arm-none-eabi-gcc CROSS_COMPILE=arm-none-eabi- OS=none
CORTEX   := $(BARE) OPT="-Os -fno-tree-loop-im -fno-tree-loop-optimize -fno-move-loop-invariants -fno-reorder-blocks -fipa-pta \
                 -fno-inline-small-functions -fconserve-stack -fno-ipa-modref -fno-forward-propagate -fno-tree-tail-merge \
                 -fno-tree-dominator-opts" \
            CFLAGS="-flto -flto-partition=one -ffat-lto-objects"
M4       := $(CORTEX) PORT=cortexm MACHINE=mps2-an386 ARCH="-mcpu=cortex-m4 -mthumb -mfloat-abi=soft"
M0       := $(CORTEX) PORT=generic MACHINE=microbit ARCH="-mcpu=cortex-m0 -mthumb"
# For speed, as vectors are for.
M55      := $(BARE) PORT=helium MACHINE=mps3-an547 ARCH="-mcpu=cortex-m55 -mthumb -mfloat-abi=hard"
# Doubles, which the library's tests compare with, are instructions of an M7.
M7       := $(BARE) PORT=cortexm MACHINE=mps2-an500 ARCH="-mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-d16"
CMOCKA_H := /usr/include/cmocka.h

define layer
LAYERS += $(1)
layer-$(1): $(2)
	+@tests/layer $(TAP)/$(1).tap "$(3)" $(4)
.PHONY: layer-$(1)
endef
# The ports of this machine's kind; those it does not run itself are run by an emulator of the best processor.
PORTS    := generic $(if $(findstring x86_64,$(TARGET)),sse avx2,$(filter-out generic,$(PORT)))
EMULATED := $(foreach p,$(filter sse avx2,$(PORTS)),$(if $(call cpu_lacks,$(CPU_$(p))),$(p)))
native    = $(NATIVE) PORT=$(1) $(if $(filter $(1),$(EMULATED)),RUNNER="qemu-x86_64 -cpu max")
$(eval $(call layer,house,,,$(NATIVE) verify-house))
$(foreach p,$(PORTS),$(eval $(call layer,$(p),,$(CMOCKA_H) $(if $(filter $(p),$(EMULATED)),qemu-x86_64),$(call native,$(p)) verify-host)))
CHECKED_PORTS := generic $(filter-out generic $(EMULATED),$(filter $(PORT),$(PORTS)))
$(foreach p,$(CHECKED_PORTS),$(eval $(call layer,$(p)-checked,,$(CMOCKA_H),$(NATIVE) CHECKED=1 PORT=$(p) verify-host)))
$(eval $(call layer,lite,,$(CMOCKA_H),$(NATIVE) PROFILE=lite PORT=generic verify-lite verify-examples))
$(eval $(call layer,aarch64,,aarch64-linux-gnu-gcc qemu-aarch64 $(A64_ROOT)/usr/include/cmocka.h,$(A64) verify-host))
$(eval $(call layer,armv7,,arm-linux-gnueabihf-gcc qemu-arm $(A32_ROOT)/usr/include/cmocka.h,$(A32) verify-host))
$(eval $(call layer,windows,,x86_64-w64-mingw32-gcc $(WINE) $(WIN_ROOT)/usr/include/cmocka.h,$(WIN) verify-windows))
$(eval $(call layer,big-endian,,s390x-linux-gnu-gcc qemu-s390x $(BIG_ROOT)/usr/include/cmocka.h,$(BIG) verify-host))
$(eval $(call layer,linux,,$(RIG_NEEDS),$(ON_RIG) run-rig RUN="$(RIG_SRC)"))
$(eval $(call layer,linux-checked,,$(RIG_NEEDS),$(ON_RIG) CHECKED=1 run-rig \
    RUN="$(filter-out $(RIG_SLOW),$(RIG_SRC))" RUN_LEFT="$(RIG_SLOW)"))
$(if $(RIG_SOAK),$(eval $(call layer,linux-soak,,$(RIG_NEEDS),$(ON_RIG) run-rig RUN="$(RIG_SOAK)")))
$(if $(RIG_GPIO),$(eval $(call layer,linux-gpiod2,,$(RIG_NEEDS) $(RIG)/root/opt/gpiod2,$(ON_RIG_2) run-rig RUN="$(RIG_GPIO)")))
$(eval $(call layer,cortex-m4,,arm-none-eabi-gcc qemu-system-arm,$(M4) verify-target))
$(eval $(call layer,cortex-m7,,arm-none-eabi-gcc qemu-system-arm,$(M7) verify-modules))
$(eval $(call layer,cortex-m0,,arm-none-eabi-gcc qemu-system-arm,$(M0) verify-target verify-modules))
$(eval $(call layer,cortex-m55,,arm-none-eabi-gcc qemu-system-arm,$(M55) verify-target verify-modules))
$(eval $(call layer,size,layer-cortex-m0 layer-cortex-m4,arm-none-eabi-gcc qemu-system-arm,$(MAKE) -s CHECKED= verify-size))
$(if $(FUZZ_SRC),$(eval $(call layer,fuzz,,clang $(CMOCKA_H),$(FUZZ_MAKE) verify-fuzz)))
$(if $(EXAMPLES),$(eval $(call layer,examples,$(if $(filter $(PORT),$(CHECKED_PORTS)),layer-$(PORT)-checked),,$(NATIVE) CHECKED=1 verify-examples)))
$(if $(SCRIPTS),$(eval $(call layer,scripts,$(if $(filter $(PORT),$(PORTS)),layer-$(PORT)),,$(NATIVE) verify-scripts)))
QUICK := house $(PORT) lite

golden: ## writes the list of golden digests anew: read the difference before committing it
	+@$(NATIVE) PORT=generic write-golden
write-golden: $(DIGEST)
	@GOLDEN=write tests/check_digests.sh $(DIGEST)

test: | $(filter deps,$(MAKECMDGOALS))
test: ## runs all tests; the last line counts passed, failed and skipped
	@rm -rf $(TAP)
	+@$(MAKE) --no-print-directory $(JOBS) $(LAYERS:%=layer-%)
	@tests/tally $(LAYERS:%=$(TAP)/%.tap)

test-quick: | $(filter deps,$(MAKECMDGOALS))
test-quick: ## runs the rules of the house and this port's tests, in about a minute
	@rm -rf $(TAP)
	+@$(MAKE) --no-print-directory $(JOBS) $(QUICK:%=layer-%)
	@tests/tally $(QUICK:%=$(TAP)/%.tap)

LINUX_LAYERS := $(filter linux linux-%,$(LAYERS))
test-linux: | $(filter deps,$(MAKECMDGOALS))
test-linux: ## runs the tests of cameras, GPIO, and serial ports on real drivers, in a virtual machine
	@rm -f $(LINUX_LAYERS:%=$(TAP)/%.tap)
	+@$(MAKE) --no-print-directory $(JOBS) $(LINUX_LAYERS:%=layer-%)
	@tests/tally $(LINUX_LAYERS:%=$(TAP)/%.tap)

rig: ## runs there what RUN names, such as "tests/rig/real_time/rig.sh tests/rig/guest/v4l2.c", and prints all that it says
	+@$(if $(GPIOD2),$(ON_RIG_2),$(ON_RIG)) CHECKED=$(CHECKED) RUN="$(RUN)" run-rig
.PHONY: test-linux rig

deps: ## installs what the tests need: Debian packages by apt; CMocka for other processors and a virtual machine in the cache folder
	@tests/deps $(CACHE)

SOURCES = $(shell find src include port tools examples tests -name '*.[ch]' -o -name '*.[ch]pp' | sort)
format: ## formats every source file
	clang-format -i $(SOURCES)

lint: ## runs clang-format, cppcheck and clang-tidy; all must be silent
	@tests/lint $(SOURCES)
.PHONY: test golden write-golden test-quick deps format lint
