#include "latency.h"

#include "json.h"

/* Times up to 127 us have a bin each; beyond, every power of two has 64 bins. */
#define BINS 2048

static uint32_t bins[BINS];
static uint32_t count;
static int64_t largest_us;

static int bin_of(int64_t us)
{
    int shift = 0;
    while (us >> shift > 127) {
        shift++;
    }
    int bin = shift * 64 + (int)(us >> shift);
    return bin < BINS ? bin : BINS - 1;
}

/* The largest time in a bin. */
static int64_t end_of(int bin)
{
    int shift = bin < 128 ? 0 : bin / 64 - 1;
    int64_t end = ((int64_t)(bin - 64 * shift + 1) << shift) - 1;
    return end < largest_us ? end : largest_us;
}

void latency_add(int64_t us)
{
    us = us > 0 ? us : 0;
    bins[bin_of(us)]++;
    count++;
    largest_us = us > largest_us ? us : largest_us;
}

/* The time that so many of 100 do not exceed. */
static int64_t percentile(uint32_t percent)
{
    uint64_t wanted = ((uint64_t)count * percent + 99) / 100, seen = 0;
    int bin = 0;
    while (bin < BINS - 1 && (seen += bins[bin]) < wanted) {
        bin++;
    }
    return end_of(bin);
}

void latency_print(FILE *out, int json)
{
    static const char *const names[] = {"p50_us", "p90_us", "p99_us", "max_us"};
    static const uint32_t percents[] = {50, 90, 99, 100};
    if (count == 0) {
        return;
    }
    if (!json) {
        fprintf(out, "frame to command, us: p50 %lld  p90 %lld  p99 %lld  max %lld  (%u frames)\n",
                (long long)percentile(50), (long long)percentile(90), (long long)percentile(99),
                (long long)largest_us, (unsigned)count);
        return;
    }
    json_writer writer = json_to(out);
    json_open(&writer, '{');
    json_key(&writer, "frame_to_command");
    json_open(&writer, '{');
    json_key(&writer, "frames");
    json_integer(&writer, count);
    for (int i = 0; i < 4; i++) {
        json_key(&writer, names[i]);
        json_integer(&writer, percentile(percents[i]));
    }
    json_close(&writer, '}');
    json_close(&writer, '}');
}
