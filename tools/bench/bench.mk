# Measuring: time on this machine, and instructions (exact, under QEMU's plugin interface).

COUNTER := $(abspath $(BUILD))/libicnt.so
RESULTS := $(abspath $(BUILD))/bench
BENCH_OBJ = $(addprefix $(OUT)/tools/bench/,$(addsuffix .o,$(1)))

$(COUNTER): tools/bench/icnt.c
	@mkdir -p $(@D)
	gcc $(USERWARN) -O2 -shared -fPIC -o $@ $<
BENCH_CASES := $(patsubst tools/bench/%.c,%,$(wildcard tools/bench/*_cases.c)) frame modules
$(OUT)/bench-count: $(call BENCH_OBJ,$(BENCH_CASES) count stdout) $(LIB)
	$(SAY)
	$(Q)$(CC) $(BASE) -o $@ $(filter %.o %.a,$^)
$(OUT)/bench-time: $(call BENCH_OBJ,$(BENCH_CASES) time) $(LIB)
	$(SAY)
	$(Q)$(CC) $(BASE) -o $@ $(filter %.o %.a,$^)
$(OUT)/bench.elf: STACK := 16384
$(OUT)/bench.elf: $(call BENCH_OBJ,$(BENCH_CASES) count) $(START) $(LIB)
	$(SAY)
	$(Q)$(CC) $(BASE) $(LINK) -o $@ $(filter %.o %.a,$^)

PEERS_OBJ := $(patsubst %.c,$(OUT)/%.o,$(wildcard tools/bench/peers/*.c))
$(PEERS_OBJ): BASE += -Itools/bench
$(OUT)/bench-peers: $(PEERS_OBJ) $(call BENCH_OBJ,frame) $(LIB)
	$(SAY)
	$(Q)$(CC) $(BASE) -o $@ $(filter %.o %.a,$^)

# RESULT names the column. A count and the line that names it belong together by their order.
count-target: $(OUT)/bench.elf
	@QEMU_FLAGS="-plugin $(COUNTER),out=$(OUT)/counts" tests/target/run $(MACHINE) $< > $(OUT)/cases || { tail -1 $(OUT)/cases; false; }
	@paste -d' ' $(OUT)/counts $(OUT)/cases | awk '{ $$1 = sprintf("%.2f", $$1 / $$2); $$2 = ""; print }' > $(RESULTS)/$(RESULT)
count-user: $(OUT)/bench-count
	@$(firstword $(RUNNER)) -plugin $(COUNTER),out=$(OUT)/counts $(wordlist 2,99,$(RUNNER)) $< > $(OUT)/cases || { tail -1 $(OUT)/cases; false; }
	@paste -d' ' $(OUT)/counts $(OUT)/cases | awk '{ $$1 = sprintf("%.2f", $$1 / $$2); $$2 = ""; print }' > $(RESULTS)/$(RESULT)
time-program: $(OUT)/bench-time
	@ln -sf $(abspath $<) $(RESULTS)/time-$(PORT)

# On a busy machine, too, this machine's ports can be compared: they take turns, and the clock is processor time.
SIZES  ?= 640x480
BENCH  ?=
NATIVES := $(filter-out $(EMULATED),$(PORTS))
bench: ## nanoseconds and bytes per pixel of every operation, for this machine's ports: SIZES=640x480,... BENCH=part of a name
	@mkdir -p $(RESULTS)
	+@for port in $(NATIVES); do $(NATIVE) PORT=$$port time-program || exit 1; done
	@tools/bench/times $(BUILD)/bench.json "$(SIZES)" "$(BENCH)" $(foreach p,$(NATIVES),$(p)=$(RESULTS)/time-$(p))

# ARMv6-M code of the M0 is counted on a board with an M3, which runs it too and has room for a frame. What is not
# installed has no column.
ON       = $(if $(shell for t in $(1); do command -v $$t > /dev/null || echo $$t; done),true,$(2))
METAL    = $(call ON,arm-none-eabi-gcc qemu-system-arm,$(1))
A64_USER = $(call ON,aarch64-linux-gnu-gcc qemu-aarch64,$(1))
A32_USER = $(call ON,arm-linux-gnueabihf-gcc qemu-arm,$(1))
TELL     = if [ -t 2 ]; then printf '%-40s\r' "$(1)" >&2; fi
insns: $(COUNTER) ## instructions per pixel of every operation on every ARM that is emulated here, exact: BENCH=part of a name
	@rm -rf $(RESULTS)/[1-9]-*
	@mkdir -p $(RESULTS)
	+@$(call TELL,M0); $(call METAL,$(M0) OPT=$(OPT) MACHINE=mps2-an385 RESULT=1-M0 count-target)
	+@$(call TELL,M4); $(call METAL,$(M4) OPT=$(OPT) RESULT=2-M4 count-target)
	+@$(call TELL,M55); $(if $(M55),$(call METAL,$(M55) OPT=$(OPT) RESULT=3-M55 count-target))
	+@$(call TELL,ARMv7); $(call A32_USER,$(A32) PORT=generic RESULT=4-A32 count-user)
	+@$(call TELL,ARMv7 neon); $(call A32_USER,$(A32) RESULT=5-A32-neon count-user)
	+@$(call TELL,AArch64); $(call A64_USER,$(A64) PORT=generic RESULT=6-A64 count-user)
	+@$(call TELL,AArch64 neon); $(call A64_USER,$(A64) RESULT=7-A64-neon count-user)
	@$(call TELL)
	@echo 'Instructions, frames of 160x120, compiled with $(OPT)'
	@tools/bench/table "$(BENCH)" $(RESULTS)/[1-9]-*

# The same operations beside OpenCV's on the same pictures. Its wheels are kept in the cache folder.
PEER_VERSION ?= 5.* 4.*
bench-peers: $(OUT)/bench-peers ## IRIS beside OpenCV's wheels from PyPI: every operation both have, SIZES=640x480,... BENCH=part of a name
	@pythons=$$(tools/bench/peers/wheels "$(CACHE)/peers" $(PEER_VERSION:%='%')) && set -- $$pythons && \
	    PYTHONDONTWRITEBYTECODE=1 "$$1" tools/bench/peers/peers.py --iris $< --port $(PORT) --sizes $(SIZES) \
	    --only "$(BENCH)" --work $(BUILD)/peers --json $(BUILD)/peers.json "$$@"

# tests/bench.sh runs behind the tests of the same build folder.
verify-scripts: $(OUT)/bench-time $(OUT)/bench-peers

# A line per kernel: instructions per pixel (nanoseconds, on this machine) of the compiler's code and of ours, and the ratio.
GAIN = awk '{ plain[$$3] += $$1; port[$$3] += $$2; n[$$3]++ } END { for (k in n) { r = plain[k] / port[k]; \
        printf "%-32s %8.3f %8.3f %6.2fx%s\n", k, plain[k] / n[k], port[k] / n[k], r, r < 1.3 ? "  earns too little" : "" } }' | sort
gain-time: $(OUT)/kernel_gain
	@$(RUNNER) $< --time | $(GAIN)
gain-count: $(COUNTER) $(OUT)/kernel_gain
	@$(firstword $(RUNNER)) -plugin $(COUNTER),out=$(OUT)/counts $(wordlist 2,99,$(RUNNER)) $(OUT)/kernel_gain > $(OUT)/cases
	@paste -d' ' $(OUT)/counts $(OUT)/cases | awk 'NR % 2 { plain = $$1; next } { print plain / 640, $$1 / 640, $$2 }' | $(GAIN)
gain: ## what every kernel of a port is worth beside the compiler's code for its plain body
	@echo 'x86-64, $(PORT): nanoseconds per pixel'
	+@$(NATIVE) PORT=$(PORT) gain-time
	@echo 'AArch64, neon: instructions per pixel'
	+@$(call ON,aarch64-linux-gnu-gcc qemu-aarch64,$(A64) gain-count)
	@echo 'ARMv7-A, neon: instructions per pixel'
	+@$(call ON,arm-linux-gnueabihf-gcc qemu-arm,$(A32) gain-count)
.PHONY: gain gain-time gain-count bench insns bench-peers count-target count-user time-program
