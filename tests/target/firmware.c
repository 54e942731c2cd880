/* The follower as a product would ship it: what `make size` weighs. Prints one sentence per frame. */
#include "course.h"
#include "follower.h"
#include "target.h"

int main(void)
{
    if (follower_start()) {
        return 1;
    }
    for (int32_t frame = 0; frame < 10; frame++) {
        course_set(20 + 10 * frame, 0);
        const char *sentence = follower_frame(course_row, (uint32_t)frame * 33);
        if (!sentence) {
            return 1;
        }
        target_print(sentence);
    }
    return 0;
}
