# The closed-loop demo: IRIS steers a simulated robot.

SIM_OBJ := $(patsubst %.c,$(OUT)/%.o,$(wildcard tools/sim/*.c))

$(OUT)/iris-demo: $(SIM_OBJ) $(LIB)
	$(CC) $(BASE) -o $@ $^ -lm
