# IRIS-Lite, the subset for microcontrollers: the sources of `make PROFILE=lite`, by concept. The headers are those of the
# whole library; what they declare and Lite does not have is listed below, and a program that calls it does not link.

of = $(patsubst %,src/$(1)/%.c,$(2))
LITE_SRC := \
  $(call of,foundation,status image scratch fixed border views rows color hsl hsl_range nv12 bayer quadtree command \
                       kernel kernel_camera kernel_color kernel_morph kernel_taps) \
  $(call of,xt/mask,threshold otsu morph morph_mask morph_near morph_step) \
  $(call of,xt/tone,histogram_gray) \
  $(call of,xt/follow,follow follow_full follow_signature follow_floor follow_runs follow_choose follow_spans follow_bend \
                      follow_shape follow_lane steer) \
  $(call of,xt/line,regress_rows hough hough_peaks hough_clip) \
  $(call of,xt/blob,blob blob_mask blob_shape blob_table lock lock_look lock_choose lock_teach \
                    signature signature_cells signature_table signature_teach signature_thin) \
  $(call of,xt/filter,convolve convolve_rows rank_one)

# A port with vectors leans on any of the plain bodies, where a row ends. The linker takes what is called.
LITE_SRC += $(if $(filter generic,$(PORT)),,$(filter-out $(LITE_SRC),$(wildcard src/foundation/kernel*.c)))

# Whose functions Lite promises, but for these.
LITE_HEADERS := $(addprefix include/iris/,$(addsuffix .h, \
    status image scratch fixed border color nv12 bayer quadtree command \
    xt/threshold xt/follow xt/steer xt/blob xt/lock xt/signature xt/convolve xt/morph xt/hough))
# rows and views of HSL; the follower's other estimator; masks by the weights of generated kernels
LITE_WITHOUT := iris_color_convert iris_color_row iris_follow_use_hough \
    $(addprefix iris_kernel_,roberts sobel prewitt isotropic laplacian box gaussian log unsharp)
# More than Lite is for, from sources that it needs: a program that calls one of them links, and pays for it, but they are
# neither promised nor weighed.
LITE_BESIDE := iris_color_from_hsl iris_nv12_crop iris_morph_gradient iris_morph_tophat iris_morph_blackhat \
    iris_hough_vote_edges iris_hough_votes_beyond_chance
LITE_FUNCTIONS = $(filter-out $(LITE_WITHOUT) $(LITE_BESIDE),$(shell tests/declared $(LITE_HEADERS)))

# The examples and the tests that call nothing else.
LITE_EXAMPLES := $(addprefix examples/,firmware_follow.c follow.c lock.c)
LITE_TESTS    := $(addprefix tests/,$(addsuffix .c,image fixed border quadtree command xt/threshold xt/steer xt/morph xt/hough))
