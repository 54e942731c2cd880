/* Any messages at any times for an election and the post of a machine: what an election gives and holds stays within its
 * bounds, it acts only with all grants, and what both send can be written.
 */
#include <stdlib.h>
#include <string.h>

#include "iris/borg/election.h"
#include "iris/borg/post.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes);

enum { UNITS = 5, SENDERS = 3, TURN = 8 + (int)sizeof(borg_message) };

static void sent_is_good(const borg_message *message)
{
    uint8_t bytes[BORG_MESSAGE_BYTES];
    if (borg_message_write(bytes, message) != IRIS_OK) {
        abort();
    }
}

static int32_t count_of(uint32_t set)
{
    int32_t count = 0;
    for (; set != 0; set &= set - 1) {
        count++;
    }
    return count;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t bytes)
{
    const borg_election_config config = {{1, 2, 3, 1}, 1, UNITS, 2};
    borg_election e;
    borg_post post;
    borg_bidder *bidders = malloc(UNITS * sizeof *bidders);
    borg_sender *senders = malloc(SENDERS * sizeof *senders);
    borg_message message;
    borg_signal signal;
    uint32_t now = 0xFFFF0000u;
    (void)borg_election_init(&e, bidders, &config, now);
    (void)borg_post_init(&post, senders, SENDERS, &config.me);
    for (; bytes >= TURN; data += TURN, bytes -= TURN) {
        now += data[0] * (data[1] & 1 ? 1u : 100u);
        memcpy(&message, data + 8, sizeof message);
        message.kind %= 10;
        if (data[1] & 2) { /* one that concerns it */
            message.from = (borg_address){1, 2, data[2] & 3, data[3] % 8};
            message.is.vote.handler = message.is.vote.handler % 8 ? 1 : 2;
        }
        borg_election_hear(&e, &message, now);
        (void)borg_post_hear(&post, &message, now, &signal);
        if (data[4] % 16 == 0) {
            borg_election_begin(&e, data[5], data[6], now);
        } else if (data[4] % 64 == 1) {
            borg_election_leave(&e, now);
        }
        if (data[7] % 8 == 0) {
            const borg_signal own = {data[5] % BORG_SIGNAL_KINDS, 1, 2, data[6], 0};
            borg_post_send(&post, &own, now);
        }
        if (borg_election_step(&e, now, &message)) {
            sent_is_good(&message);
        }
        const uint32_t without = e.alive & ~1u & ~(uint32_t)e.granted & ~(uint32_t)e.graced;
        if (count_of(e.promised) > 2 || (borg_election_won(&e) && (without != 0 || !(e.promised & 1)))) {
            abort();
        }
        for (int i = 0; borg_post_next(&post, now, &message); i++) {
            sent_is_good(&message);
            if (i > SENDERS + BORG_POST_SLOTS) {
                abort(); /* it never ends */
            }
        }
    }
    free(bidders);
    free(senders);
    return 0;
}
