# IRIS - `make help` explains every target.
# Set on the command line: PORT=generic|sse|avx2|neon|cortexm|helium  OS=linux|none  CROSS_COMPILE=prefix-  ARCH=-mcpu=...
#                          PROFILE=lite (what microcontrollers need, src/lite.mk)
#                          CHECKED=1 (sanitizers)  OPT=-Os  PREFIX=/usr/local  DESTDIR=  IRIS_DATA=path  BUILD=folder  V=1 (whole commands)

CC      := $(if $(filter default,$(origin CC)),$(CROSS_COMPILE)gcc,$(CC))
CXX     := $(if $(filter default,$(origin CXX)),$(CROSS_COMPILE)g++,$(CXX))
AR      := $(CROSS_COMPILE)ar
TARGET  := $(shell $(CC) -dumpmachine)
OS      ?= $(if $(findstring linux,$(TARGET)),linux,none)
PROFILE ?= full
BUILD   ?= build
OPT     ?= -O2
PREFIX  ?= /usr/local
DESTDIR ?=
ARCH    ?=

# What of a list this machine's processor lacks, as Linux names it; all of it where nobody can say.
cpu_lacks = $(shell for f in $(1); do grep -qw $$f /proc/cpuinfo 2> /dev/null || echo $$f; done)
CPU_sse   := ssse3 sse4_1 sse4_2
CPU_avx2  := $(CPU_sse) avx2 bmi2 movbe abm

# The best port of what the compiler's target promises; a native build also asks this processor. ARM's ports are for little-endian.
ifeq ($(PORT),)
  MACROS   := $(shell $(CC) $(ARCH) $(CFLAGS) -dM -E -x c /dev/null)
  promises  = $(filter $(1),$(MACROS))
  native_has = $(if $(CROSS_COMPILE),,$(if $(call cpu_lacks,$(1)),,yes))
  ifneq ($(call promises,__ARM_BIG_ENDIAN __AARCH64EB__),)
    override PORT := generic
  else ifneq ($(findstring none-eabi,$(TARGET)),)
    override PORT := $(if $(call promises,__ARM_FEATURE_MVE),helium,$(if $(call promises,__ARM_FEATURE_DSP),cortexm,generic))
  else ifneq ($(findstring x86_64,$(TARGET)),)
    override PORT := $(if $(or $(call promises,__AVX2__),$(call native_has,$(CPU_avx2))),avx2,$(if \
                       $(or $(call promises,__SSE4_1__),$(call native_has,$(CPU_sse))),sse,generic))
  else
    override PORT := $(if $(or $(call promises,__ARM_NEON),$(and $(findstring arm,$(TARGET)),$(call native_has,neon))),neon,generic)
  endif
endif

ifeq ($(wildcard port/cpu/$(PORT)/iris_port.h),)
  $(error PORT=$(PORT) is unknown, there are: $(notdir $(patsubst %/,%,$(dir $(wildcard port/cpu/*/iris_port.h)))))
endif
RUNS_sse := x86_64%
RUNS_avx2 := x86_64%
RUNS_neon := aarch64% arm-linux%
RUNS_cortexm := arm-none%
RUNS_helium := arm-none%
ifneq ($(RUNS_$(PORT)),)
  ifeq ($(filter $(RUNS_$(PORT)),$(TARGET)),)
    $(error PORT=$(PORT) is for $(subst %,,$(RUNS_$(PORT))), and $(CC) makes code for $(TARGET))
  endif
endif
# A port may build on another one, whose iris_port.h it includes.
PORTS_USED := $(PORT) $(shell sed -n 's|^.include "../\([a-z0-9]*\)/iris_port.h"|\1|p' port/cpu/$(PORT)/iris_port.h)
ifeq ($(filter full lite,$(PROFILE)),)
  $(error PROFILE=$(PROFILE) is unknown, there are: full lite)
endif

# The library is integers only, and -mgeneral-regs-only holds it to that. Tools, examples and tests see include/ only
# and may use floating point. Sanitizers enlarge frames, as other levels of optimization do, so frames are checked without.
comma    := ,
WARN     := -Wall -Wextra -Wconversion -Wshadow -Wvla $(if $(CHECKED),,$(if $(filter -O2 -Os,$(firstword $(OPT))),-Wframe-larger-than=1024)) -Werror -std=c99 -pedantic
CXXWARN  := -Wall -Wextra -Wconversion -Wshadow -Werror -std=c++17
USERWARN := -Wall -Wextra -Wshadow -Wvla -Werror -std=c99 -pedantic
# MinGW's stat of 64 bits knows no folder by a name that ends with a slash.
POSIX    := -D_POSIX_C_SOURCE=200809L -D_DEFAULT_SOURCE $(if $(findstring mingw,$(TARGET)),,-D_FILE_OFFSET_BITS=64)
INTEGER  := $(if $(filter s390x%,$(TARGET)),-msoft-float,-mgeneral-regs-only)
# GCC aligns the stack of Windows to 16 bytes only, whatever it takes to lie there: AVX2 must move it as it lies.
PORTISA_generic := $(INTEGER)
PORTISA_sse     := -march=x86-64-v2
PORTISA_avx2    := -march=x86-64-v3$(if $(findstring mingw,$(TARGET)), -Wa$(comma)-muse-unaligned-vector-move)
PORTISA_neon    := $(if $(filter arm%,$(TARGET)),-mfpu=neon)
PORTISA         := $(PORTISA_$(PORT))
# The plain bodies of row kernels, too, are made with all that a port with vectors may use, and with -O3 where -O2 is asked
# for: what the compiler does well needs no code of ours. PORT=generic holds the same sources to integer registers.
KERNELISA := $(if $(filter sse avx2 neon helium,$(PORT)),$(if $(filter -O2,$(OPT)),-O3) $(PORTISA),$(INTEGER))
SANITIZE := $(if $(CHECKED),-fsanitize=$(if $(FUZZER),fuzzer-no-link$(comma))address$(comma)undefined \
              -fno-sanitize-recover=all -fno-omit-frame-pointer -g -DIRIS_CHECKED)
CFLAGS   ?=
LDFLAGS  ?=
BASE      = $(OPT) $(CFLAGS) $(SANITIZE) $(ARCH) -ffunction-sections -fdata-sections -MMD -MP
INCLUDES := -Iinclude -Iport/cpu/$(PORT)

# Libraries of the system that the shims use when pkg-config finds them; a cross build names its own PKG_CONFIG.
# For each, a folder of port/os: named by the library's major version, 0 without it.
PKG_CONFIG  ?= $(if $(CROSS_COMPILE),false,pkg-config)
system_has   = $(if $(filter linux,$(OS)),$(shell $(PKG_CONFIG) --modversion $(1) 2> /dev/null))
GPIOD       := $(call system_has,libgpiod)
LIBCAMERA   := $(if $(shell command -v $(CXX)),$(call system_has,libcamera))
MOSQUITTO   := $(call system_has,libmosquitto)
SHIMS       := gpiod$(or $(firstword $(subst ., ,$(GPIOD))),0) libcamera$(if $(LIBCAMERA),,0) mosquitto$(if $(MOSQUITTO),1,0)
SYSTEM_PKGS := $(if $(GPIOD),libgpiod) $(if $(LIBCAMERA),libcamera) $(if $(MOSQUITTO),libmosquitto)
SYSTEM_LIBS := $(if $(strip $(SYSTEM_PKGS)),-Wl$(comma)--as-needed $(shell $(PKG_CONFIG) --libs $(SYSTEM_PKGS)) $(if $(LIBCAMERA),-lstdc++))
system_flags = $(if $(strip $(SYSTEM_PKGS)),$(shell $(PKG_CONFIG) --cflags $(SYSTEM_PKGS) | sed 's/-I/-isystem /g'))

# What is made, by name; V=1 shows the whole commands, -s nothing.
SAY = $(if $(V)$(findstring s,$(firstword -$(MAKEFLAGS))),,@echo '  $@')
Q   = $(if $(V),,@)

# One build folder per port, OS, profile, compiler and flags.
FLAGS := $(CC) $(shell $(CC) -dumpversion) $(BASE) $(WARN) $(USERWARN) $(POSIX) $(INTEGER) $(PORTISA) $(KERNELISA) $(LDFLAGS) $(SYSROOT) $(SHIMS) $(GPIOD) $(LIBCAMERA) $(MOSQUITTO)
KEY   := $(shell printf '%s' "$(FLAGS)" | cksum | cut -d' ' -f1)
OUT   := $(BUILD)/$(PORT)-$(OS)-$(PROFILE)-$(TARGET)-$(KEY)
HOST  := $(if $(CROSS_COMPILE),,yes)
# What the tool needs of a system to run on; without one there is no tool.
HOSTED := $(if $(findstring none-eabi,$(TARGET)),,$(if $(findstring mingw,$(TARGET)),windows,posix))
EXE    := $(if $(filter windows,$(HOSTED)),.exe)

include src/lite.mk
CORE_SRC := $(if $(filter lite,$(PROFILE)),$(LITE_SRC),$(wildcard src/foundation/*.c src/xt/*/*.c src/3d/*/*.c src/osiris/*.c src/runtime/*.c src/borg/*.c))
PORT_SRC := $(wildcard $(PORTS_USED:%=port/cpu/%/*.c))
OS_SRC   := $(wildcard port/os/$(OS)/*.c $(SHIMS:%=port/os/$(OS)/%/*.c))
# C++ allocates: in an archive of its own, so that the promises of the other ones stay whole.
CXX_SRC  := $(if $(LIBCAMERA),$(wildcard port/os/$(OS)/libcamera/*.cpp))
TOOL_SRC := $(if $(and $(HOSTED),$(filter full,$(PROFILE))),$(wildcard tools/iris/*.c tools/iris/$(OS)/*.c tools/iris/$(HOSTED)/*.c))

CORE_OBJ := $(CORE_SRC:%.c=$(OUT)/%.o)
PORT_OBJ := $(PORT_SRC:%.c=$(OUT)/%.o)
OS_OBJ   := $(OS_SRC:%.c=$(OUT)/%.o)
CXX_OBJ  := $(CXX_SRC:%.cpp=$(OUT)/%.o)
TOOL_OBJ := $(TOOL_SRC:%.c=$(OUT)/%.o)

LIB    := $(OUT)/libiris.a
CXXLIB := $(if $(CXX_SRC),$(OUT)/libiris-libcamera.a)
OSLIB  := $(CXXLIB) $(if $(OS_SRC),$(OUT)/libiris-$(OS).a)
TOOL   := $(if $(TOOL_SRC),$(OUT)/iris$(EXE))

.PHONY: all help lib examples install uninstall clean
.DELETE_ON_ERROR:

all: lib $(TOOL) ## builds the library and the command line tool (build/iris)
	$(if $(and $(HOST),$(TOOL)),@ln -sf $(OUT:$(BUILD)/%=%)/iris $(BUILD)/iris)

lib: $(LIB) $(OSLIB)

help: ## prints this text
	@grep -hE '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/^([a-z-]+):.*## (.*)/  \1\t\2/' | expand -t 16
	@sed -n 's/^# \(Set on.*\)/\n\1/p; s/^#  *\(PROFILE.*\|CHECKED.*\)/                         \1/p' Makefile

# The list of objects: an archive is made anew when a source has come or gone.
$(OUT)/members: FORCE
	@mkdir -p $(@D)
	@echo "$(CORE_OBJ) $(PORT_OBJ) $(OS_OBJ) $(CXX_OBJ) $(TOOL_OBJ)" | cmp -s - $@ || \
	    echo "$(CORE_OBJ) $(PORT_OBJ) $(OS_OBJ) $(CXX_OBJ) $(TOOL_OBJ)" > $@
FORCE:
.PHONY: FORCE

$(LIB): $(CORE_OBJ) $(PORT_OBJ) $(OUT)/members
	@rm -f $@
	$(SAY)
	$(Q)$(AR) rcs $@ $(filter %.o,$^)

$(OUT)/libiris-$(OS).a: $(OS_OBJ) $(OUT)/members
	@rm -f $@
	$(SAY)
	$(Q)$(AR) rcs $@ $(filter %.o,$^)

$(OUT)/libiris-libcamera.a: $(CXX_OBJ) $(OUT)/members
	@rm -f $@
	$(SAY)
	$(Q)$(AR) rcs $@ $(filter %.o,$^)

$(OUT)/iris$(EXE): $(TOOL_OBJ) $(OSLIB) $(LIB)
	$(SAY)
	$(Q)$(CC) $(BASE) -o $@ $(filter %.c %.o %.a,$^) $(LDFLAGS) $(SYSTEM_LIBS) -lm

$(OUT)/src/%.o: src/%.c
	@mkdir -p $(@D)
	$(SAY)
	$(Q)$(CC) $(WARN) $(BASE) $(INTEGER) $(INCLUDES) -fstack-usage -c -o $@ $<

# A % stands for at least one letter, of kernel.o too.
$(OUT)/src/foundation/kerne%.o: INTEGER := $(KERNELISA)

$(OUT)/port/cpu/%.o: port/cpu/%.c
	@mkdir -p $(@D)
	$(SAY)
	$(Q)$(CC) $(WARN) $(BASE) $(PORTISA) $(INCLUDES) -Isrc/foundation -fstack-usage -c -o $@ $<

$(OUT)/port/os/%.o: port/os/%.c
	@mkdir -p $(@D)
	$(SAY)
	$(Q)$(CC) $(WARN) $(BASE) $(INTEGER) $(INCLUDES) $(POSIX) $(system_flags) -fstack-usage -c -o $@ $<

$(OUT)/port/os/%.o: port/os/%.cpp
	@mkdir -p $(@D)
	$(SAY)
	$(Q)$(CXX) $(CXXWARN) $(BASE) $(INCLUDES) $(POSIX) $(system_flags) -fstack-usage -c -o $@ $<

$(OUT)/tools/%.o: tools/%.c
	@mkdir -p $(@D)
	$(SAY)
	$(Q)$(CC) $(USERWARN) $(BASE) -Iinclude $(POSIX) -c -o $@ $<

# Examples: one program per file.
EXAMPLES := $(patsubst examples/%.c,$(OUT)/examples/%$(EXE),$(if $(filter lite,$(PROFILE)),$(LITE_EXAMPLES),$(wildcard examples/*.c)))
examples: $(EXAMPLES) ## builds every program under examples/
$(OUT)/examples/%$(EXE): examples/%.c $(OSLIB) $(LIB)
	@mkdir -p $(@D)
	$(SAY)
	$(Q)$(CC) $(USERWARN) $(BASE) -Iinclude $(POSIX) -o $@ $(filter %.c %.o %.a,$^) $(LDFLAGS) $(SYSTEM_LIBS)

include tests/tests.mk
include $(wildcard tools/*/*.mk)

VERSION := $(shell sed -n 's/.*IRIS_VERSION_TEXT *"\(.*\)"/\1/p' include/iris/version.h)
HEADERS := $(shell cd include && find iris -name '*.h' | sort)
INSTALL := $(DESTDIR)$(PREFIX)

install: all ## installs headers, libraries, pkg-config file, tool and man page (PREFIX, DESTDIR)
	@for h in $(HEADERS); do install -D -m 644 include/$$h "$(INSTALL)/include/$$h" || exit 1; done
	@for l in $(LIB) $(OSLIB); do install -D -m 644 $$l "$(INSTALL)/lib/$${l##*/}" || exit 1; done
	@mkdir -p "$(INSTALL)/lib/pkgconfig"
	@printf '%s\n' 'prefix=$(or $(PREFIX),$${pcfiledir}/../..)' 'includedir=$${prefix}/include' 'libdir=$${prefix}/lib' '' 'Name: IRIS' \
	    'Description: machine vision in integers for small robots' 'Version: $(VERSION)' \
	    'Cflags: -I$${includedir}' 'Libs: -L$${libdir} $(patsubst lib%.a,-l%,$(notdir $(OSLIB))) -liris$(if $(SYSTEM_LIBS), $(SYSTEM_LIBS))' \
	    > "$(INSTALL)/lib/pkgconfig/iris.pc"
	$(if $(TOOL),@install -D -m 755 $(TOOL) "$(INSTALL)/bin/iris$(EXE)")
	$(if $(TOOL),@install -D -m 644 tools/iris/iris.1 "$(INSTALL)/share/man/man1/iris.1")

uninstall: ## removes what install put there
	rm -rf "$(INSTALL)/include/iris"
	rm -f "$(INSTALL)/lib/libiris.a" "$(INSTALL)/lib/libiris-$(OS).a" "$(INSTALL)/lib/libiris-libcamera.a" "$(INSTALL)/lib/pkgconfig/iris.pc"
	rm -f "$(INSTALL)/bin/iris$(EXE)" "$(INSTALL)/share/man/man1/iris.1"

clean: ## removes the build folder
	rm -rf $(BUILD)

-include $(shell find $(OUT) -name '*.d' 2>/dev/null)
