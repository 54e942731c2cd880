# The tests. Every program and script here prints TAP; tests/tally counts the lines and prints the last one.

UNIT_SRC := $(filter-out tests/target/%,$(wildcard tests/*.c tests/xt/*.c tests/linux/*.c))
UNIT_BIN := $(UNIT_SRC:tests/%.c=$(OUT)/tests/%)

$(OUT)/tests/%: tests/%.c $(OSLIB) $(LIB)
	@mkdir -p $(@D)
	$(CC) $(USERWARN) $(BASE) -Iinclude -D_POSIX_C_SOURCE=200809L -D_DEFAULT_SOURCE -o $@ $^ -lcmocka -lm

unit: $(UNIT_BIN) ## builds and runs the CMocka tests of this PORT and these flags
	@tests/tally $(UNIT_BIN)
.PHONY: unit
