# The score: every figure that IRIS promises. What other programs measure is collected first, one text file each.

FIGURES   = $(abspath $(OUT))/figures
SCORE_OBJ := $(patsubst %.c,$(OUT)/%.o,$(wildcard tools/score/*.c))
CROSS_GAP = $(shell for t in arm-none-eabi-gcc qemu-system-arm; do command -v $$t > /dev/null || echo $$t; done)

$(OUT)/iris-score: $(SCORE_OBJ) $(LIB)
	$(SAY)
	$(Q)$(CC) $(BASE) -o $@ $(filter %.o %.a,$^) $(LDFLAGS) -lm

score: $(OUT)/iris-score figures ## measures every figure IRIS promises, as a table (ONLY=part, PICTURES=dir: with what was found drawn in)
	$(if $(PICTURES),@mkdir -p $(PICTURES))
	@$< --figures $(FIGURES) $(if $(ONLY),--only $(ONLY)) $(if $(PICTURES),--pictures $(PICTURES))

figures: $(OUT)/iris-demo $(if $(CROSS_GAP),,$(COUNTER))
	@rm -rf $(FIGURES)
	@mkdir -p $(FIGURES)
	@$< --out $(FIGURES)/drive-pictures > $(FIGURES)/drive || true
	@$< --quick --blank > $(FIGURES)/blank || true
	@$< --quick --floor > $(FIGURES)/drive-floor || true
	@$< --quick --walls > $(FIGURES)/walls || true
ifneq ($(CROSS_GAP),)
	@for f in 1-M4 2-M0 size; do echo 'skipped: no $(CROSS_GAP) (make deps)' > $(FIGURES)/$$f; done
else
	+@$(M4) OPT=$(OPT) RESULTS=$(FIGURES) RESULT=1-M4 count-target
	+@$(M0) OPT=$(OPT) RESULTS=$(FIGURES) MACHINE=mps2-an385 RESULT=2-M0 count-target
	+@$(M0) SIZED=$(FIGURES) CORE=M0 weigh
	@awk '$$1 == "follower" { print $$3, $$1 }' $(FIGURES)/M0 > $(FIGURES)/size
endif
.PHONY: score figures

# tests/score.sh runs behind the tests of the same build folders.
verify-scripts: $(OUT)/iris-score figures
layer-scripts: layer-cortex-m4 layer-cortex-m0
