# The closed-loop demo: IRIS steers a simulated robot.

SIM_OBJ := $(patsubst %.c,$(OUT)/%.o,$(wildcard tools/sim/*.c))

$(OUT)/iris-demo: $(SIM_OBJ) $(LIB)
	$(SAY)
	$(Q)$(CC) $(BASE) -o $@ $(filter %.o %.a,$^) $(LDFLAGS) -lm

demo: $(OUT)/iris-demo ## drives a simulated robot around a track by its camera alone
	$< --out $(BUILD)/demo

walls: $(OUT)/iris-demo ## drives it around a walled course: maps it by disparities, and finds the robot in the map (a picture)
	$< --walls --out $(BUILD)/walls

# The course's frames, as they are and enlarged, play as a camera.
LATENCY_RATES ?= 30 100
latency: all $(OUT)/iris-demo ## time from a frame until its command, by percentiles: rendered frames as a camera, LATENCY_RATES="30 100"
	@rm -rf $(BUILD)/latency
	@$(OUT)/iris-demo --frames $(BUILD)/latency/160x120
	@mkdir $(BUILD)/latency/640x480
	@$(TOOL) convert --resize 640x480 $(BUILD)/latency/160x120 -o $(BUILD)/latency/640x480
	@for size in 160x120 640x480; do for rate in $(LATENCY_RATES); do printf '%s at %3d/s  ' $$size $$rate; \
	    $(TOOL) follow --camera $(BUILD)/latency/$$size --rate $$rate --timing 2>&1 > /dev/null | grep '^frame to'; done; done
# A few of them for tests elsewhere, enlarged: in BUILD/course/large.
course: all $(OUT)/iris-demo
	@$(OUT)/iris-demo --frames $(BUILD)/course/small --count 7
	@mkdir -p $(BUILD)/course/large
	@$(TOOL) convert --resize 640x480 $(BUILD)/course/small -o $(BUILD)/course/large
.PHONY: demo walls latency course

verify-scripts: $(OUT)/iris-demo
