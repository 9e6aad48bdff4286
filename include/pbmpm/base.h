/* pbmpm: results, identifiers, memory, threads, and what the library tells about itself. */
#ifndef PBMPM_BASE_H
#define PBMPM_BASE_H

#include <stddef.h>
#include <stdint.h>

#include "version.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Define PBMPM_STATIC where the static library is linked. */
#if defined(PBMPM_STATIC)
#define PBMPM_API
#elif defined(_WIN32) && defined(PBMPM_BUILDING_LIBRARY)
#define PBMPM_API __declspec(dllexport)
#elif defined(_WIN32)
#define PBMPM_API __declspec(dllimport)
#elif defined(PBMPM_BUILDING_LIBRARY) && defined(__GNUC__)
#define PBMPM_API __attribute__((visibility("default")))
#else
#define PBMPM_API
#endif

/* Threads. Any thread may call; different worlds know nothing of each other.
 *
 * Calls that only read share a world: any number of threads make them at once, and each gets what it would have got alone. They are
 *   those whose name has query, get, count, find, view, copy, impulse or is_valid;
 *   pbmpm_world_generation(), pbmpm_world_hash(), pbmpm_world_events(), pbmpm_world_step_done();
 *   pbmpm_world_debug_lines(), pbmpm_shape_mass(), pbmpm_rigid_begin();
 *   pbmpm_surface_extract() and pbmpm_surface_points(), one of them at a time;
 *   pbmpm_snapshot_size() and pbmpm_snapshot_save().
 * All others need the world for themselves; so do pbmpm_material_effective() and pbmpm_world_advice(), which try things out in it.
 * They are BUSY while a thread is inside any call on the world. Any call is BUSY while a thread is inside one of them.
 * No call waits for another. So a host steps its world only after its reading threads have returned. */

/** What a call came to. Zero is success; everything else left the world as it was before the call, except
 *  where the function says otherwise. Details: pbmpm_last_error(). */
typedef enum pbmpm_result {
    PBMPM_OK = 0,
    PBMPM_ERROR_INVALID_ARGUMENT = 1, /**< null pointer, NaN, infinity, or a value outside its documented range */
    PBMPM_ERROR_INVALID_ID = 2,       /**< null, stale, foreign or made-up identifier */
    PBMPM_ERROR_OUT_OF_MEMORY = 3,    /**< the allocator returned null, or the memory budget is used up */
    PBMPM_ERROR_CAPACITY = 4,         /**< more particles, materials, colliders or worlds than there is room for */
    PBMPM_ERROR_BUSY = 5,             /**< another thread is inside a call on the same world, and one of the two changes it; or a step of it runs in the background */
    PBMPM_ERROR_UNSUPPORTED_CPU = 6,  /**< the CPU has no SSE4.2 */
    PBMPM_ERROR_UNSUPPORTED = 7,      /**< a structure size, material or feature that this build does not know */
    PBMPM_ERROR_THREAD = 8,           /**< a worker thread could not be started */
    PBMPM_ERROR_IN_USE = 9,           /**< the object still has users (a material that particles refer to) */
    PBMPM_ERROR_FORKED = 10,          /**< the world belongs to the parent process; in the child only destroy works */
    PBMPM_ERROR_DAMAGED = 11,         /**< stored data is truncated or changed, or was never the library's */
    PBMPM_ERROR_FOREIGN = 12,         /**< stored data belongs to a world that was made in another way, or to another version */
    PBMPM_RESULT_FORCE32 = 0x7fffffff
} pbmpm_result;

/** A short constant name of a result ("PBMPM_ERROR_CAPACITY"); never null, never to be freed. Any thread. */
PBMPM_API const char *pbmpm_result_name(pbmpm_result result);

/** The message of the last call that failed on this thread, or an empty string. Valid until the next call that
 *  fails on this thread; never null. Any thread. */
PBMPM_API const char *pbmpm_last_error(void);

/** Identifiers are values of 8 bytes. All zero means "none". A generation is never used twice in a process (short
 *  of 2^32 objects). So a stale identifier, or one of another world, is refused. */
typedef struct pbmpm_world_id {
    uint32_t index;
    uint32_t generation;
} pbmpm_world_id;

/** A material of one world. */
typedef struct pbmpm_material_id {
    uint32_t index;
    uint32_t generation;
} pbmpm_material_id;

/** A collider of one world. */
typedef struct pbmpm_collider_id {
    uint32_t index;
    uint32_t generation;
} pbmpm_collider_id;

/** A particle of one world; it keeps it for life. */
typedef struct pbmpm_particle_id {
    uint32_t index;
    uint32_t generation;
} pbmpm_particle_id;

/** How grave a line of the log is. */
typedef enum pbmpm_log_level {
    PBMPM_LOG_ERROR = 1,   /**< a call was refused or failed */
    PBMPM_LOG_WARNING = 2, /**< a step went on, but not as asked: particles were deleted */
    PBMPM_LOG_INFO = 3,    /**< a world was created: its grid, kernels and threads */
    PBMPM_LOG_LEVEL_FORCE32 = 0x7fffffff
} pbmpm_log_level;

/** Receives one line per notable happening. Any thread that calls the library may call it, and a step in the background; several at once, too.
 *  Workers never do. It must not call the library. */
typedef void pbmpm_log_callback(pbmpm_log_level level, const char *message, void *user);

/** Sets (or, with null, removes) the process-wide log callback. Any thread; not while another thread is inside the
 *  library. Bindings need not use it: everything it says can also be polled. */
PBMPM_API pbmpm_result pbmpm_set_log_callback(pbmpm_log_callback *callback, void *user);

/** Called where an assertion inside the library fails: with the condition, and its place in the sources. It returns 0 if the call is
 *  to go on, though its results mean nothing; with another number abort() is called. Any thread may call it, workers too, and several at once. It must
 *  not call the library. */
typedef int32_t pbmpm_assert_callback(const char *condition, const char *file, int32_t line, void *user);

/** Sets (or, with null, removes) the process-wide callback for assertions. Without one a line goes to standard error, and abort() is called. Any thread; not while
 *  another thread is inside the library.
 *  Errors: UNSUPPORTED: the library was built without assertions (the default; -DPBMPM_ASSERTS=ON builds it with them); then nothing is set. */
PBMPM_API pbmpm_result pbmpm_set_assert_callback(pbmpm_assert_callback *callback, void *user);

/** Memory for one world, read at its creation. `allocate` returns a block aligned to at least `alignment` (a power of two, at most 64) or
 *  null; `release` gets the size that was asked for. Called from the thread that calls the library, and
 *  from that of a step in the background (async.h); for one world never from two at once. Must not call the library. */
typedef struct pbmpm_allocator {
    uint32_t size;                                                /**< sizeof(pbmpm_allocator), set by the caller */
    void *(*allocate)(size_t size, size_t alignment, void *user); /**< not null */
    void (*release)(void *memory, size_t size, void *user);       /**< not null */
    void *user;                                                   /**< passed on unchanged */
} pbmpm_allocator;

/** One share of parallel work; `index` counts from 0. */
typedef void pbmpm_task(int32_t index, void *context);

/** Lets the host's job system run the library's parallel work. `enqueue` shall have task(i, context) called
 *  once for each i in [0, count), on any threads, in any order. It returns a handle. `finish` returns when all
 *  of these calls have returned. Read at the creation of a world.
 *
 *  Tasks of one handle may wait for each other, for some milliseconds at most. While they wait they yield their core. None waits for a task that
 *  has not begun, so a host may also run them one after another. Only a step in the background, see `nests`, calls enqueue and finish from a task. There
 *  `finish` shall run other tasks while it waits, or leave a worker free that does: else all workers may wait for each other.
 *
 *  A substep of 5 iterations enqueues some 10 times with the paper's solver. With the dual it is 30, per group of islands. Loops of less than
 *  some 40 microseconds run on the caller.
 *
 *  One call at a time uses the hooks of a world; other calls that read the world meanwhile work on their own thread alone. There is one exception: the
 *  step in the background goes on enqueuing while another thread is in `finish` for the step itself. */
typedef struct pbmpm_task_hooks {
    uint32_t size;                                                                /**< sizeof(pbmpm_task_hooks), set by the caller */
    int32_t nests; /**< 1: a task may itself call enqueue and finish. Then a step in the background is one more task, see async.h. 0 (default): it may not */
    void *(*enqueue)(pbmpm_task *task, int32_t count, void *context, void *user); /**< not null; returns a handle */
    void (*finish)(void *handle, void *user);                                     /**< not null; any thread may call it */
    void *user;                                                                   /**< passed on unchanged */
} pbmpm_task_hooks;

/** Instruction sets of the kernels. On x86, PBMPM_ISA=sse4|avx2|avx512 in the environment lowers the choice, and never raises it. It is
 *  read at the first call that needs it. ARM and WebAssembly have one set each. */
typedef enum pbmpm_isa {
    PBMPM_ISA_NONE = 0, /**< the CPU is not supported */
    PBMPM_ISA_SSE4 = 1,
    PBMPM_ISA_AVX2 = 2,
    PBMPM_ISA_AVX512 = 3,
    PBMPM_ISA_NEON = 4,
    PBMPM_ISA_WASM = 5, /**< WebAssembly's SIMD128 */
    PBMPM_ISA_FORCE32 = 0x7fffffff
} pbmpm_isa;

/** The version of the library that is loaded, as major * 1000000 + minor * 1000 + patch. Any thread. */
PBMPM_API uint32_t pbmpm_version(void);

/** PBMPM_ABI_VERSION of the library that is loaded; a binding refuses to run when it differs from its own. Any thread. */
PBMPM_API uint32_t pbmpm_abi_version(void);

/** The kernels in use. Any thread. */
PBMPM_API pbmpm_isa pbmpm_active_isa(void);

/** The name of an instruction set ("AVX2"); never null. Any thread. */
PBMPM_API const char *pbmpm_isa_name(pbmpm_isa isa);

/** 1 if this library was built with the CMake option PBMPM_STRICT: the same results with every instruction set, bit for bit; else 0. Any thread. */
PBMPM_API int32_t pbmpm_build_is_strict(void);

/** One line of the library's own table of layouts: a field of a public structure. With an empty field name it is the
 *  structure itself (offset 0, size of the whole). This structure and the identifiers never grow. */
typedef struct pbmpm_layout_entry {
    const char *structure; /**< never null */
    const char *field;     /**< never null */
    uint32_t offset;       /**< bytes from the start of the structure */
    uint32_t size;         /**< bytes */
} pbmpm_layout_entry;

/** The layouts of all public structures as this library was compiled. Every binding compares it with its own
 *  mirror when it loads. The table is constant and lives as long as the library. Any thread. */
PBMPM_API pbmpm_result pbmpm_layout_table(const pbmpm_layout_entry **entries, uint32_t *count);

/** Destroys all worlds and joins all threads of the library. For hosts that unload the library. Unloading alone does
 *  the same, but leaks the memory of worlds with a host's allocator: that may be gone by then. No other call may
 *  be under way. Afterwards the library may be used again. */
PBMPM_API pbmpm_result pbmpm_shutdown(void);

#ifdef __cplusplus
}
#endif
#endif
