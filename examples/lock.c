/* Locks on to a colored object and follows it: teach, then a call per frame. Here the "camera" paints a red ball that moves
 * to the right behind a post. */
#include <stdio.h>

#include "iris/xt/lock.h"

enum { W = 160, H = 120, R = 8 };

static uint16_t frame[W * H]; /* RGB565, as small cameras send it */
static iris_signatures signatures;
static iris_lock lock;
static IRIS_SCRATCH_BUFFER(memory, IRIS_LOCK_SCRATCH_BYTES(W, H));

static void camera(int at_x, int at_y)
{
    for (int i = 0; i < W * H; i++) {
        int x = i % W, dx = x - at_x, dy = i / W - at_y;
        int is_post = x >= 80 && x < 100, is_ball = dx * dx + dy * dy <= R * R;
        frame[i] = is_post ? 0x52AA : is_ball ? 0xC145 : 0xAD55;
    }
}

int main(void)
{
    static const char *const states[] = {"lost", "predicted", "found"};
    iris_scratch scratch;
    iris_image image;
    iris_lock_result ball;
    int x = 30, wrong = 0;
    camera(x, 60);
    if (iris_image_wrap(&image, frame, sizeof frame, (iris_size){W, H}, 0, IRIS_RGB565) ||
        iris_scratch_init(&scratch, memory.memory, sizeof memory.memory) ||
        iris_lock_init(&lock, (iris_size){W, H}, &signatures, 0, NULL) ||
        iris_lock_teach(&ball, &lock, &image, (iris_rect){x - R, 60 - R, 2 * R + 1, 2 * R + 1}, &scratch)) {
        return 1;
    }
    while (x < W - 20) {
        x += 6;
        camera(x, 60);
        if (iris_lock_frame(&ball, &lock, &image, &scratch)) {
            return 1;
        }
        printf("%-9s id %d age %2d at %5.1f, %.1f\n", states[ball.state], (int)ball.id, (int)ball.age,
               ball.x_q16 / 65536.0, ball.y_q16 / 65536.0);
        wrong += (x < 70 || x > 110) && ball.state != IRIS_LOCK_FOUND;
    }
    return wrong > 0 || ball.id != 1;
}
