# Measuring: instructions (exact, under QEMU's plugin interface), time on this machine, and bytes of flash and RAM.

COUNTER := $(abspath $(BUILD))/libicnt.so
RESULTS := $(abspath $(BUILD))/bench
BENCH    = $(addprefix $(OUT)/tools/bench/,$(addsuffix .o,$(1)))

$(COUNTER): tools/bench/icnt.c
	@mkdir -p $(@D)
	gcc $(USERWARN) -O2 -shared -fPIC -o $@ $<
$(OUT)/bench-count: $(call BENCH,cases count stdout) $(LIB)
	$(SAY)
	$(Q)$(CC) $(BASE) -o $@ $(filter %.o %.a,$^)
$(OUT)/bench-time: $(call BENCH,cases time) $(LIB)
	$(SAY)
	$(Q)$(CC) $(BASE) -o $@ $(filter %.o %.a,$^)
$(OUT)/bench-kernels: $(call BENCH,kernels time) $(LIB)
	$(SAY)
	$(Q)$(CC) $(BASE) -o $@ $(filter %.o %.a,$^)
$(OUT)/bench.elf: STACK := 16384
$(OUT)/bench.elf: $(call BENCH,cases count) $(START) $(LIB)
	$(SAY)
	$(Q)$(CC) $(BASE) $(LINK) -o $@ $(filter %.o %.a,$^)

# RESULT names the column. A count and the line that names it belong together by their order.
count-target: $(OUT)/bench.elf
	@QEMU_FLAGS="-plugin $(COUNTER),out=$(OUT)/counts" tests/target/run $(MACHINE) $< > $(OUT)/cases
	@paste -d' ' $(OUT)/counts $(OUT)/cases | awk '{ $$1 = sprintf("%.2f", $$1 / $$2); $$2 = ""; print }' > $(RESULTS)/$(RESULT)
count-user: $(OUT)/bench-count
	@$(firstword $(RUNNER)) -plugin $(COUNTER),out=$(OUT)/counts $(wordlist 2,99,$(RUNNER)) $< > $(OUT)/cases
	@paste -d' ' $(OUT)/counts $(OUT)/cases | awk '{ $$1 = sprintf("%.2f", $$1 / $$2); $$2 = ""; print }' > $(RESULTS)/$(RESULT)
time-host: $(OUT)/bench-time
	@$< > $(RESULTS)/$(RESULT)
time-kernels: $(OUT)/bench-kernels
	@$< > $(RESULTS)/$(RESULT)

# ARMv6-M code of the M0 is counted on a board with an M3, which runs it too and has room for a frame.
bench: $(COUNTER) ## instructions per pixel on M4, M0, and AArch64 (exact), nanoseconds per pixel on this machine
	@rm -rf $(RESULTS)
	@mkdir -p $(RESULTS)
	+@$(M4) OPT=$(OPT) RESULT=1-M4 count-target
	+@$(M0) OPT=$(OPT) MACHINE=mps2-an385 RESULT=2-M0 count-target
	+@$(A64) RESULT=3-AArch64 count-user
	+@$(NATIVE) RESULT=4-host-ns time-host
	@echo 'Frames of 160x120, compiled with $(OPT).'
	@tools/bench/table $(RESULTS)/*

bench-kernels: ## nanoseconds per pixel on this machine, plain C beside this PORT
	@rm -rf $(RESULTS)
	@mkdir -p $(RESULTS)
	+@$(NATIVE) PORT=generic RESULT=1-generic time-kernels
	+@$(NATIVE) RESULT=2-$(PORT) time-kernels
	@echo 'Frames of 640x480, compiled with $(OPT).'
	@tools/bench/table $(RESULTS)/*

size: ## bytes of flash and RAM on a Cortex-M0 at -Os: every file of the library, and the firmware follower
	+@$(M0) weigh
weigh: $(LIB) $(OUT)/firmware.elf
	@$(CROSS_COMPILE)size $(LIB) | awk 'NR > 1 { printf "%6d %5d  %s\n", $$1 + $$2, $$2 + $$3, $$6; f += $$1 + $$2; r += $$2 + $$3 } \
	    BEGIN { print " flash   RAM" } END { printf "%6d %5d  libiris.a, all of it\n", f, r }'
	@$(CROSS_COMPILE)size $(OUT)/firmware.elf | awk -v stack=$(STACK) 'NR > 1 { \
	    printf "%6d %5d  the firmware follower, 160x120, with C library and startup; and %d of stack\n", $$1 + $$2, $$2 + $$3 - stack, stack }'
.PHONY: size weigh bench bench-kernels count-target count-user time-host time-kernels
