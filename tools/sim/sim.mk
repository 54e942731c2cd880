# The closed-loop demo: IRIS steers a simulated robot.

SIM_OBJ := $(patsubst %.c,$(OUT)/%.o,$(wildcard tools/sim/*.c))

$(OUT)/iris-demo: $(SIM_OBJ) $(LIB)
	$(SAY)
	$(Q)$(CC) $(BASE) -o $@ $(filter %.o %.a,$^) $(LDFLAGS) -lm

demo: $(OUT)/iris-demo ## drives a simulated robot around a track by its camera alone
	$< --out $(BUILD)/demo
.PHONY: demo

verify-scripts: $(OUT)/iris-demo
