/* What all API tests share: checks of results, a watching allocator, snapshots of a world, access to views. */
#ifndef PBMPM_TESTS_API_SUPPORT_H
#define PBMPM_TESTS_API_SUPPORT_H

#include <stdbool.h>

#include <pbmpm/pbmpm.h>
#include <unity.h>

#include "host.h"

/** Fails the test at this line unless `call` gives `expected`; names both results, and the library's message. */
#define EXPECT(expected, call) support_expect((expected), (call), #call, __LINE__)
#define OK(call) EXPECT(PBMPM_OK, call)

/** Fails unless `call` is refused as INVALID_ARGUMENT or UNSUPPORTED: for values outside an enum, where both are right. */
#define REFUSED(call) support_refused((call), #call, __LINE__)

void support_expect(pbmpm_result expected, pbmpm_result actual, const char *call, unsigned line);
void support_refused(pbmpm_result actual, const char *call, unsigned line);

/** Ends the test with exit code SUPPORT_SKIPPED when PBMPM_ISA asks for kernels that this CPU does not have. */
enum { SUPPORT_SKIPPED = 77 };
void support_skip_without_isa(void);

/** A repeatable stream of 32-bit numbers (xorshift). */
uint32_t random_next(uint32_t *state);
float random_float(uint32_t *state, float low, float high);

/* ---- allocator that watches, and fails on request ---- */

/** Counts what a world takes and gives back. Fresh memory is filled with 0xA5, released memory with 0xDD, and each
 *  block has a guard behind it. It has to outlive its worlds, also when a failed check ends the test: make it static. */
typedef struct ledger {
    uint64_t calls;        /**< allocations asked for */
    uint64_t releases;
    uint64_t live_blocks;
    uint64_t live_bytes;
    uint64_t peak_bytes;
    uint64_t failures;     /**< refused on request */
    uint64_t fail_at;      /**< the call (counting from 1) to refuse; 0: none */
    bool sticky;           /**< also refuse every later call */
    uint64_t bad_sizes;    /**< releases with another size than asked for */
    uint64_t bad_alignments; /**< requests that are no power of two up to 64 */
    uint64_t overruns;     /**< guards found overwritten */
    uint64_t wrong_threads; /**< calls from another thread than the first one */
    unsigned long thread;  /**< the first caller */
    pbmpm_allocator allocator; /**< that keeps this book */
} ledger;

/** For pbmpm_world_def; part of the book. */
const pbmpm_allocator *ledger_allocator(ledger *book);

/** Counts an allocation; whether it is to be refused. For memory that is asked for in another way. */
bool ledger_refuses(ledger *book);

/** Fails unless everything was given back, with the right sizes and intact guards. */
void ledger_expect_clean(const ledger *book, const char *label);

/* ---- snapshot of everything that can be read back ---- */

typedef struct snapshot {
    uint64_t hash;
    uint64_t generation;
    uint32_t count;
    pbmpm_stats stats;
    pbmpm_settings settings;
} snapshot;

snapshot snapshot_take(pbmpm_world_id world);
void snapshot_expect_same(const snapshot *before, pbmpm_world_id world, const char *label);

/* ---- views ---- */

pbmpm_view view_of(pbmpm_world_id world, pbmpm_field field);
float view_float(const pbmpm_view *view, uint32_t row, uint32_t component);
uint32_t view_uint(const pbmpm_view *view, uint32_t row, uint32_t component);
uint32_t world_count(pbmpm_world_id world);
uint64_t world_hash(pbmpm_world_id world);
pbmpm_stats world_stats(pbmpm_world_id world);

/** A hash of positions, velocities and J by particle (index of its identifier), whatever their order in memory. */
uint64_t world_hash_unordered(pbmpm_world_id world);

/** Events of one kind that the world keeps: how many entries, and (unless null) the first of them. */
uint32_t world_events_of(pbmpm_world_id world, pbmpm_event_kind kind, pbmpm_event *first);

/** Fails unless every float of the fields position, velocity, affine velocity and J is finite. */
void world_expect_finite(pbmpm_world_id world, const char *label);

#endif
