# Bytes of flash, RAM, and stack.

# Lines of: what core flash RAM stack, bytes. The firmware is all that is in flash: the example, the library, what the
# compiler calls, startup, and the emulator's hooks. Its stack is the deepest chain of calls, and as it was seen in a run. Its
# rows are the sensor's and, for each row of the frame, its runs. member is examples/firmware_machine.c, all in flash with it,
# and of RAM all that is static, but for the chunk, which is in flash.
SIZED := $(abspath $(BUILD))/sizes
SIZE   = $(CROSS_COMPILE)size $(1) | awk 'NR > 1 { print $$1 + $$2, $$2 + $$3 }'
CHAIN  = $$(tests/worst_stack target_reset $(OUT)/$(1).elf.ltrans0.ltrans.ci $(OUT)/runtime.ci | cut -d' ' -f1)
weigh: $(LIB) $(OUT)/firmware.elf $(OUT)/firmware_painted.elf $(OUT)/member.elf $(OUT)/lite.elf $(OUT)/runtime.ci
	@mkdir -p $(SIZED)
	@{ for f in $(CORE_SRC:%.c=%); do echo $$f $(CORE) $$($(call SIZE,$(OUT)/$$f.o)) -; done; \
	  echo lite $(CORE) $$($(call SIZE,$(OUT)/lite.elf)) -; \
	  echo follower $(CORE) $$($(call SIZE,$(OUT)/firmware.elf) | awk '{ print $$1, $$2 - $(STACK) }') $(call CHAIN,firmware); \
	  echo follower-seen $(CORE) $$($(call SIZE,$(OUT)/firmware.elf) | awk '{ print $$1, $$2 - $(STACK) }') \
	      $$(tests/target/run $(MACHINE) $(OUT)/firmware_painted.elf | sed -n 's/^stack 0*//p'); \
	  echo member $(CORE) $$($(call SIZE,$(OUT)/member.elf) | awk '{ print $$1, $$2 - $(STACK) }') $(call CHAIN,member); \
	  echo follower-rows $(CORE) 0 $$((160 + 120 * 4 * 5)) 0; } > $(SIZED)/$(CORE)
sizes:
	+@$(M0) CORE=M0 weigh
	+@$(M4) CORE=M4 weigh
size: sizes ## bytes of flash, RAM, and stack on a Cortex-M0 and M4 at -Os: every file, IRIS-Lite, the firmware follower, and a member of a team
	@tools/bench/sizes --table $(SIZED)/M0 $(SIZED)/M4
	@tools/bench/sizes --json $(SIZED)/M0 $(SIZED)/M4 > $(BUILD)/size.json
verify-size: sizes
	@tools/bench/sizes --tap $(SIZED)/M0 $(SIZED)/M4
.PHONY: size sizes verify-size weigh
