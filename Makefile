# IRIS - `make help` explains every target.
# Set on the command line: PORT=generic|sse|neon  OS=linux|none  PROFILE=full|lite  CROSS_COMPILE=prefix-
#                          CHECKED=1 (sanitizers)  OPT=-Os  PREFIX=/usr/local  DESTDIR=  IRIS_DATA=path  BUILD=folder

CC      := $(if $(filter default,$(origin CC)),$(CROSS_COMPILE)gcc,$(CC))
AR      := $(CROSS_COMPILE)ar
TARGET  := $(shell $(CC) -dumpmachine)
OS      ?= $(if $(findstring linux,$(TARGET)),linux,none)
PROFILE ?= full
BUILD   ?= build
OPT     ?= -O2
PREFIX  ?= /usr/local
DESTDIR ?=

# The best port of the compiler's target; a native x86 build also asks this processor.
ifeq ($(origin PORT),undefined)
  ifneq ($(filter aarch64%,$(TARGET)),)
    PORT := neon
  else ifneq ($(filter x86_64%,$(TARGET)),)
    PORT := $(shell if [ -r /proc/cpuinfo ] && ! grep -qw sse4_2 /proc/cpuinfo; then echo generic; else echo sse; fi)
  else
    PORT := generic
  endif
  ifeq ($(wildcard port/cpu/$(PORT)/iris_port.h),)
    PORT := generic
  endif
endif

WARN     := -Wall -Wextra -Wconversion -Wshadow -Wvla -Wframe-larger-than=1024 -Werror -std=c99 -pedantic
INTEGER  := -mgeneral-regs-only
PORTISA  := $(if $(filter sse,$(PORT)),-march=x86-64-v2)
comma    := ,
SANITIZE := $(if $(CHECKED),-fsanitize=address$(comma)undefined -fsanitize=alignment -fno-sanitize-recover=all -g -DIRIS_CHECKED)
CFLAGS   ?=
BASE      = $(OPT) $(CFLAGS) $(SANITIZE) $(ARCH) -ffunction-sections -fdata-sections -MMD -MP
INCLUDES := -Iinclude -Iport/cpu/$(PORT)

KEY  := $(shell printf '%s' "$(CC) $(shell $(CC) -dumpversion) $(BASE) $(WARN)" | cksum | cut -d' ' -f1)
OUT  := $(BUILD)/$(PORT)-$(OS)-$(PROFILE)-$(TARGET)-$(KEY)
HOST := $(if $(CROSS_COMPILE),,yes)

CORE_SRC := $(wildcard src/foundation/*.c src/xt/*.c)
PORT_SRC := $(wildcard port/cpu/$(PORT)/*.c)
OS_SRC   := $(wildcard port/os/$(OS)/*.c)
TOOL_SRC := $(wildcard tools/iris/*.c)

CORE_OBJ := $(CORE_SRC:%.c=$(OUT)/%.o)
PORT_OBJ := $(PORT_SRC:%.c=$(OUT)/%.o)
OS_OBJ   := $(OS_SRC:%.c=$(OUT)/%.o)
TOOL_OBJ := $(TOOL_SRC:%.c=$(OUT)/%.o)

LIB    := $(OUT)/libiris.a
OSLIB  := $(if $(OS_SRC),$(OUT)/libiris-$(OS).a)

.PHONY: all help lib clean
.DELETE_ON_ERROR:

all: lib $(if $(TOOL_SRC),$(OUT)/iris) ## the library and the command line tool (build/iris)
	$(if $(and $(HOST),$(TOOL_SRC)),@ln -sf $(OUT:$(BUILD)/%=%)/iris $(BUILD)/iris)

lib: $(LIB) $(OSLIB)

help: ## this text
	@grep -hE '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/^([a-z-]+):.*## (.*)/  \1\t\2/' | expand -t 16
	@sed -n 's/^# \(Set on.*\)/\n\1/p; s/^#  *\(CHECKED.*\)/                         \1/p' Makefile

$(LIB): $(CORE_OBJ) $(PORT_OBJ)
	@rm -f $@
	$(AR) rcs $@ $^

$(OUT)/libiris-$(OS).a: $(OS_OBJ)
	@rm -f $@
	$(AR) rcs $@ $^

$(OUT)/iris: $(TOOL_OBJ) $(OSLIB) $(LIB)
	$(CC) $(BASE) -o $@ $^ -lm

$(OUT)/src/%.o: src/%.c
	@mkdir -p $(@D)
	$(CC) $(WARN) $(BASE) $(INTEGER) $(INCLUDES) -fstack-usage -c -o $@ $<

$(OUT)/port/cpu/%.o: port/cpu/%.c
	@mkdir -p $(@D)
	$(CC) $(WARN) $(BASE) $(PORTISA) $(INCLUDES) -Isrc/foundation -fstack-usage -c -o $@ $<

$(OUT)/port/os/%.o: port/os/%.c
	@mkdir -p $(@D)
	$(CC) $(WARN) $(BASE) $(INTEGER) $(INCLUDES) -D_POSIX_C_SOURCE=200809L -D_DEFAULT_SOURCE -c -o $@ $<

# Tools, examples and tests see include/ only; they may use floating point.
USERWARN := -Wall -Wextra -Wshadow -Wvla -Werror -std=c99 -pedantic
$(OUT)/tools/%.o: tools/%.c
	@mkdir -p $(@D)
	$(CC) $(USERWARN) $(BASE) -Iinclude -D_POSIX_C_SOURCE=200809L -c -o $@ $<

# Examples: one program per file.
EXAMPLES := $(patsubst examples/%.c,$(OUT)/examples/%,$(wildcard examples/*.c))
examples: $(EXAMPLES) ## every program under examples/
$(OUT)/examples/%: examples/%.c $(OSLIB) $(LIB)
	@mkdir -p $(@D)
	$(CC) $(USERWARN) $(BASE) -Iinclude -o $@ $^
.PHONY: examples

include tests/tests.mk

clean: ## removes the build folder
	rm -rf $(BUILD)

-include $(shell find $(OUT) -name '*.d' 2>/dev/null)
