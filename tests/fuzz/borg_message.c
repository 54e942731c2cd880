/* Takes any bytes as a message: with the header's beginning and check made right, so that what stands in it is looked at.
 * What is accepted gives the same bytes again.
 */
#include <stdlib.h>
#include <string.h>

#include "iris/borg/message.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes)
{
    borg_message message;
    uint8_t made[BORG_MESSAGE_BYTES] = {0}, again[BORG_MESSAGE_BYTES];
    uint32_t sum = 2166136261u;
    uint8_t *exact = malloc(bytes + 1);
    memcpy(exact + 1, data, bytes);
    (void)borg_message_read(&message, exact + 1, bytes);
    free(exact);
    memcpy(made, data, bytes < sizeof made ? bytes : sizeof made);
    memcpy(made, "BM\1", 3);
    for (int i = 0; i < 44; i++) {
        sum = (sum ^ made[i]) * 16777619u;
    }
    for (int i = 0; i < 4; i++) {
        made[44 + i] = (uint8_t)(sum >> 8 * i);
    }
    if (borg_message_read(&message, made, sizeof made) == IRIS_OK &&
        (borg_message_write(again, &message) != IRIS_OK || memcmp(again, made, sizeof made) != 0)) {
        abort();
    }
    return 0;
}
