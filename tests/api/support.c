#include "support.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { GUARD_BYTES = 64, GUARD_VALUE = 0x5A, FRESH_VALUE = 0xA5, RELEASED_VALUE = 0xDD, MAX_ALIGNMENT = 64 };

/* Unity prints the message at once, so one buffer is enough. */
static char message[512];

void support_expect(pbmpm_result expected, pbmpm_result actual, const char *call, unsigned line)
{
    if (actual == expected)
        return;
    snprintf(message, sizeof message, "%s gave %s instead of %s (\"%s\")", call, pbmpm_result_name(actual),
             pbmpm_result_name(expected), pbmpm_last_error());
    UNITY_TEST_FAIL(line, message);
}

void support_refused(pbmpm_result actual, const char *call, unsigned line)
{
    if (actual == PBMPM_ERROR_INVALID_ARGUMENT || actual == PBMPM_ERROR_UNSUPPORTED)
        return;
    snprintf(message, sizeof message, "%s gave %s instead of a refusal", call, pbmpm_result_name(actual));
    UNITY_TEST_FAIL(line, message);
}

void support_skip_without_isa(void)
{
    const char *wanted = getenv("PBMPM_ISA");
    const pbmpm_isa active = pbmpm_active_isa();
    if (!wanted || !*wanted)
        return;
    const char *active_name = active == PBMPM_ISA_SSE4 ? "sse4" : active == PBMPM_ISA_AVX2 ? "avx2" : active == PBMPM_ISA_AVX512 ? "avx512" : active == PBMPM_ISA_NEON ? "neon" : "none";
    if (strcmp(wanted, active_name) != 0) {
        printf("SKIPPED: PBMPM_ISA=%s, but this CPU has no more than %s\n", wanted, active_name);
        exit(SUPPORT_SKIPPED);
    }
}

uint32_t random_next(uint32_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 17;
    *state ^= *state << 5;
    return *state;
}

float random_float(uint32_t *state, float low, float high)
{
    return low + (high - low) * (float)(random_next(state) >> 8) / 16777216.0f;
}

/* ---- allocator ---- */

static void note_thread(ledger *book)
{
    const unsigned long self = (unsigned long)pthread_self();
    if (!book->thread)
        book->thread = self;
    book->wrong_threads += book->thread != self;
}

bool ledger_refuses(ledger *book)
{
    book->calls++;
    const bool refuses = book->fail_at && (book->calls == book->fail_at || (book->sticky && book->calls > book->fail_at));
    book->failures += refuses;
    return refuses;
}

/* Layout of a block: one header of MAX_ALIGNMENT bytes that holds the size, the caller's bytes, the guard. */
static void *ledger_allocate(size_t size, size_t alignment, void *user)
{
    ledger *book = user;
    note_thread(book);
    book->bad_alignments += alignment == 0 || (alignment & (alignment - 1)) != 0 || alignment > MAX_ALIGNMENT;
    if (ledger_refuses(book)) return NULL;
    unsigned char *block = host_allocate(MAX_ALIGNMENT + size + GUARD_BYTES, MAX_ALIGNMENT);
    if (!block)
        return NULL;
    memcpy(block, &size, sizeof size);
    memset(block + MAX_ALIGNMENT, FRESH_VALUE, size);
    memset(block + MAX_ALIGNMENT + size, GUARD_VALUE, GUARD_BYTES);
    book->live_blocks++;
    book->live_bytes += size;
    if (book->live_bytes > book->peak_bytes)
        book->peak_bytes = book->live_bytes;
    return block + MAX_ALIGNMENT;
}

static void ledger_release(void *memory, size_t size, void *user)
{
    ledger *book = user;
    unsigned char *block = (unsigned char *)memory - MAX_ALIGNMENT;
    size_t real_size;
    note_thread(book);
    memcpy(&real_size, block, sizeof real_size);
    book->bad_sizes += real_size != size;
    bool intact = true;
    for (size_t i = 0; i < GUARD_BYTES; i++)
        intact = intact && block[MAX_ALIGNMENT + real_size + i] == GUARD_VALUE;
    book->overruns += !intact;
    book->releases++;
    book->live_blocks--;
    book->live_bytes -= real_size;
    memset(block + MAX_ALIGNMENT, RELEASED_VALUE, real_size);
    host_release(block);
}

const pbmpm_allocator *ledger_allocator(ledger *book)
{
    book->allocator = (pbmpm_allocator){sizeof book->allocator, ledger_allocate, ledger_release, book};
    return &book->allocator;
}

void ledger_expect_clean(const ledger *book, const char *label)
{
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(0, book->live_blocks, label);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(0, book->live_bytes, label);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(0, book->bad_sizes, label);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(0, book->bad_alignments, label);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(0, book->overruns, label);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(0, book->wrong_threads, label);
}

/* ---- snapshots ---- */

snapshot snapshot_take(pbmpm_world_id world)
{
    snapshot state;
    memset(&state, 0, sizeof state); /* compared bytewise, padding included */
    OK(pbmpm_world_hash(world, &state.hash));
    OK(pbmpm_world_generation(world, &state.generation));
    OK(pbmpm_particles_count(world, &state.count));
    state.stats.size = sizeof state.stats;
    OK(pbmpm_world_get_stats(world, &state.stats));
    state.settings.size = sizeof state.settings;
    OK(pbmpm_world_get_settings(world, &state.settings));
    return state;
}

void snapshot_expect_same(const snapshot *before, pbmpm_world_id world, const char *label)
{
    const snapshot after = snapshot_take(world);
    TEST_ASSERT_EQUAL_HEX64_MESSAGE(before->hash, after.hash, label);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(before->generation, after.generation, label);
    TEST_ASSERT_EQUAL_UINT32_MESSAGE(before->count, after.count, label);
    TEST_ASSERT_EQUAL_MEMORY_MESSAGE(&before->stats, &after.stats, sizeof after.stats, label);
    TEST_ASSERT_EQUAL_MEMORY_MESSAGE(&before->settings, &after.settings, sizeof after.settings, label);
}

/* ---- views ---- */

pbmpm_view view_of(pbmpm_world_id world, pbmpm_field field)
{
    pbmpm_view view = {.size = sizeof view};
    OK(pbmpm_particles_view(world, field, &view));
    return view;
}

static const void *view_element(const pbmpm_view *view, uint32_t row, uint32_t component)
{
    return (const char *)view->data + row * view->stride + (size_t)component * view->component_stride;
}

float view_float(const pbmpm_view *view, uint32_t row, uint32_t component)
{
    float value;
    memcpy(&value, view_element(view, row, component), sizeof value);
    return value;
}

uint32_t view_uint(const pbmpm_view *view, uint32_t row, uint32_t component)
{
    uint32_t value;
    memcpy(&value, view_element(view, row, component), sizeof value);
    return value;
}

uint32_t world_count(pbmpm_world_id world)
{
    uint32_t count = 0;
    OK(pbmpm_particles_count(world, &count));
    return count;
}

uint64_t world_hash(pbmpm_world_id world)
{
    uint64_t hash = 0;
    OK(pbmpm_world_hash(world, &hash));
    return hash;
}

uint64_t world_hash_unordered(pbmpm_world_id world)
{
    static const pbmpm_field fields[] = {PBMPM_POSITION, PBMPM_VELOCITY, PBMPM_VOLUME_RATIO};
    enum { FIELDS = sizeof fields / sizeof *fields };
    const pbmpm_view identity = view_of(world, PBMPM_PARTICLE);
    pbmpm_view views[FIELDS];
    uint64_t sum = 0;
    for (int f = 0; f < FIELDS; f++)
        views[f] = view_of(world, fields[f]);
    for (uint32_t row = 0; row < identity.count; row++) {
        uint64_t hash = 1469598103934665603u ^ view_uint(&identity, row, 0); /* FNV-1a, word by word */
        for (int f = 0; f < FIELDS; f++)
            for (uint32_t c = 0; c < views[f].components; c++)
                hash = (hash ^ view_uint(&views[f], row, c)) * 1099511628211u;
        sum += hash ^ hash >> 32;
    }
    return sum;
}

pbmpm_stats world_stats(pbmpm_world_id world)
{
    pbmpm_stats stats = {.size = sizeof stats};
    OK(pbmpm_world_get_stats(world, &stats));
    return stats;
}

uint32_t world_events_of(pbmpm_world_id world, pbmpm_event_kind kind, pbmpm_event *first)
{
    pbmpm_event events[PBMPM_MAX_EVENTS] = {{.size = sizeof *events}};
    uint32_t count = 0, found = 0;
    OK(pbmpm_world_events(world, events, PBMPM_MAX_EVENTS, &count, NULL));
    for (uint32_t i = 0; i < count; i++) {
        if (events[i].kind != kind)
            continue;
        if (found++ == 0 && first)
            *first = events[i];
    }
    return found;
}

void world_expect_finite(pbmpm_world_id world, const char *label)
{
    static const pbmpm_field fields[] = {PBMPM_POSITION, PBMPM_VELOCITY, PBMPM_AFFINE_VELOCITY, PBMPM_VOLUME_RATIO};
    for (size_t f = 0; f < sizeof fields / sizeof *fields; f++) {
        const pbmpm_view view = view_of(world, fields[f]);
        for (uint32_t i = 0; i < view.count; i++)
            for (uint32_t c = 0; c < view.components; c++)
                if (!isfinite(view_float(&view, i, c))) {
                    snprintf(message, sizeof message, "%s: field %d of particle %u is not finite", label, (int)fields[f], i);
                    TEST_FAIL_MESSAGE(message);
                }
    }
}
