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

/* Threads. Any thread may call any function. Calls on different worlds never disturb each other. Each function says how calls on
 * one world meet:
 *
 *   Threads: shared.     It reads. Any number of such calls run at the same time, with the same results as alone.
 *   Threads: exclusive.  It returns BUSY while another thread is in any call on the world.
 *   Threads: any.        It never returns BUSY.
 *
 * While an exclusive call runs, other threads' shared and exclusive calls on that world return BUSY, too. So step a world only
 * after its reading threads have returned. While a background step runs, most calls return BUSY, see async.h.
 * No call waits for a call of another thread. There are two exceptions: async.h, and readers while one of them builds what all
 * need (query.h). */

/** The result of a call. Zero is success. Any other left the world as it was before the call, unless the function says
 *  otherwise. Details: pbmpm_last_error(). */
typedef enum pbmpm_result {
    PBMPM_OK = 0,
    PBMPM_ERROR_INVALID_ARGUMENT = 1, /**< null pointer, NaN, infinity, or a value outside its documented range */
    PBMPM_ERROR_INVALID_ID = 2,       /**< null, stale, foreign or made-up identifier */
    PBMPM_ERROR_OUT_OF_MEMORY = 3,    /**< the allocator returned null, or the memory budget is used up */
    PBMPM_ERROR_CAPACITY = 4,         /**< a limit is reached, or the caller's buffer is too small */
    PBMPM_ERROR_BUSY = 5,             /**< a conflicting call on this world by another thread, or a background step is not ended */
    PBMPM_ERROR_UNSUPPORTED_CPU = 6,  /**< the CPU has no SSE4.2 */
    PBMPM_ERROR_UNSUPPORTED = 7,      /**< unknown structure size, material kind or format; or not in this build or this world */
    PBMPM_ERROR_THREAD = 8,           /**< a worker thread could not be started */
    PBMPM_ERROR_IN_USE = 9,           /**< still in use: a material by particles or emitters, a baked solid by colliders */
    PBMPM_ERROR_FORKED = 10,          /**< the world belongs to the parent process; in the child only destroy works */
    PBMPM_ERROR_DAMAGED = 11,         /**< stored data is truncated or changed, or was never the library's */
    PBMPM_ERROR_FOREIGN = 12,         /**< a snapshot of another format version, or of a world whose definition, materials or
                                           objects differ from this one's */
    PBMPM_RESULT_FORCE32 = 0x7fffffff /**< never returned; makes the type 32 bits wide, as in all enumerations */
} pbmpm_result;

/** A short constant name of a result ("PBMPM_ERROR_CAPACITY"); "unknown result" for other numbers. Never null, never to be
 *  freed. Threads: any. */
PBMPM_API const char *pbmpm_result_name(pbmpm_result result);

/** The message of the last call that failed on this thread, or an empty string. Never null. Valid until the next call that fails on
 *  this thread.
 *  Threads: any. */
PBMPM_API const char *pbmpm_last_error(void);

/** A world. Identifiers are a slot (`index`) and a number that tells its owners apart (`generation`). All zero means "none". The
 *  identifier of a destroyed object is never valid again (short of 2^32 objects in a process). One of another world is refused,
 *  too. */
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

/** A particle of one world, for as long as the particle lives. */
typedef struct pbmpm_particle_id {
    uint32_t index;
    uint32_t generation;
} pbmpm_particle_id;

/** How severe a line of the log is. */
typedef enum pbmpm_log_level {
    PBMPM_LOG_ERROR = 1,   /**< a call was refused or failed */
    PBMPM_LOG_WARNING = 2, /**< a step went on, but not as asked: particles were deleted */
    PBMPM_LOG_INFO = 3,    /**< a world was created: its grid, kernels and threads */
    PBMPM_LOG_LEVEL_FORCE32 = 0x7fffffff
} pbmpm_log_level;

/** Receives one line per notable event. Threads that call the library call it, and so do background steps; possibly several at
 *  once. The library's worker threads never call it. `message` is valid during the call only. `user` is passed on unchanged. It
 *  must not call the library. */
typedef void pbmpm_log_callback(pbmpm_log_level level, const char *message, void *user);

/** Sets (or, with null, removes) the process-wide log callback. `user` must stay valid until it is removed. Bindings need not use
 *  it: everything it says can also be polled. Always returns OK.
 *  Threads: any, but not while another thread is inside the library. */
PBMPM_API pbmpm_result pbmpm_set_log_callback(pbmpm_log_callback *callback, void *user);

/** Called where an assertion inside the library fails: with the condition, and its place in the sources. Return 0 to go on; the
 *  library's results are then meaningless. Any other number makes the library call abort().
 *  Any thread may call it, workers too, and several at once. It must not call the library. */
typedef int32_t pbmpm_assert_callback(const char *condition, const char *file, int32_t line, void *user);

/** Sets (or, with null, removes) the process-wide callback for assertions. `user` must stay valid until it is removed. Without a
 *  callback a line goes to standard error, and abort() is called.
 *  Errors: UNSUPPORTED: the library was built without assertions (the default; -DPBMPM_ASSERTS=ON builds it with them); then
 *  nothing is set.
 *  Threads: any, but not while another thread is inside the library. */
PBMPM_API pbmpm_result pbmpm_set_assert_callback(pbmpm_assert_callback *callback, void *user);

/** The memory of one world. The library copies this structure when it creates the world. Functions and `user` must outlive the
 *  world. They are called from threads that call the library, and from a background step (async.h). Two threads never use one
 *  world's allocator at the same time. The functions must not call the library. */
typedef struct pbmpm_allocator {
    uint32_t size;                                                /**< sizeof(pbmpm_allocator), set by the caller */
    void *(*allocate)(size_t size, size_t alignment, void *user); /**< not null; may return null. Alignment: 2^n up to 64 */
    void (*release)(void *memory, size_t size, void *user);       /**< not null. `size`: as it was asked for */
    void *user;                                                   /**< passed on unchanged */
} pbmpm_allocator;

/** One share of parallel work. `index` counts from 0. */
typedef void pbmpm_task(int32_t index, void *context);

/** Lets the host's job system run the library's parallel work. The library copies this structure when it creates the world.
 *  Functions and `user` must outlive the world.
 *  `enqueue` shall have task(i, context) called once for each i in [0, count), on any threads, in any order. It returns a handle of
 *  the host's own, null included. The library passes each handle to `finish` exactly once. `finish` returns when all calls of the
 *  task have returned.
 *
 *  Tasks of one handle may wait for each other, for some milliseconds at most, and yield their core meanwhile. A task waits only
 *  for tasks that already run. So the host may also run them one after another.
 *  Only a background step calls enqueue and finish from within a task, see `nests`. There `finish` must run other tasks while it
 *  waits, or one worker must stay free. Else all workers may wait for each other (deadlock).
 *
 *  One substep of 5 iterations calls enqueue about 10 times (paper's solver) or 30 times (dual). With the convergent solver that is
 *  for each group of islands with the same kinds of matter. Loops of less than some 40 microseconds run on the caller.
 *
 *  Only one call on a world uses its hooks at a time. Concurrent readers work on their own thread. There is one exception: a
 *  background step calls enqueue while pbmpm_world_step_end() waits in `finish`. */
typedef struct pbmpm_task_hooks {
    uint32_t size;                                                                /**< sizeof(pbmpm_task_hooks); you set it */
    int32_t nests; /**< 1: tasks may call enqueue and finish; a background step then runs as a task, see async.h. 0: they may not */
    void *(*enqueue)(pbmpm_task *task, int32_t count, void *context, void *user); /**< not null; returns a handle */
    void (*finish)(void *handle, void *user);                                     /**< not null; any thread may call it */
    void *user;                                                                   /**< passed on unchanged */
} pbmpm_task_hooks;

/** Instruction sets of the kernels. On x86, PBMPM_ISA=sse4|avx2|avx512 in the environment lowers the choice, and never raises
 *  it. The library reads it at the first call that needs it. ARM and WebAssembly have one set each. */
typedef enum pbmpm_isa {
    PBMPM_ISA_NONE = 0, /**< the CPU is not supported */
    PBMPM_ISA_SSE4 = 1,
    PBMPM_ISA_AVX2 = 2,
    PBMPM_ISA_AVX512 = 3,
    PBMPM_ISA_NEON = 4,
    PBMPM_ISA_WASM = 5, /**< WebAssembly's SIMD128 */
    PBMPM_ISA_FORCE32 = 0x7fffffff
} pbmpm_isa;

/** The version of the loaded library, as major * 1000000 + minor * 1000 + patch. Threads: any. */
PBMPM_API uint32_t pbmpm_version(void);

/** PBMPM_ABI_VERSION of the loaded library. A binding refuses to run when it differs from its own. Threads: any. */
PBMPM_API uint32_t pbmpm_abi_version(void);

/** The instruction set in use. Threads: any. */
PBMPM_API pbmpm_isa pbmpm_active_isa(void);

/** The name of an instruction set ("AVX2"); never null. Threads: any. */
PBMPM_API const char *pbmpm_isa_name(pbmpm_isa isa);

/** 1 if this library was built with the CMake option PBMPM_STRICT, else 0. Strict builds give the same results with every
 *  instruction set, bit for bit. Threads: any. */
PBMPM_API int32_t pbmpm_build_is_strict(void);

/** One line of the library's own table of layouts: a field of a public structure. With an empty field name it is the structure
 *  itself (offset 0, size of the whole). This structure and the identifiers never grow. */
typedef struct pbmpm_layout_entry {
    const char *structure; /**< never null */
    const char *field;     /**< never null */
    uint32_t offset;       /**< bytes from the start of the structure */
    uint32_t size;         /**< bytes */
} pbmpm_layout_entry;

/** The layouts of all public structures as this library was compiled. Every binding compares it with its own mirror when it
 *  loads. The table is constant and lives as long as the library. Errors: INVALID_ARGUMENT (null). Threads: any. */
PBMPM_API pbmpm_result pbmpm_layout_table(const pbmpm_layout_entry **entries, uint32_t *count);

/** Destroys all worlds and joins all threads of the library, for hosts that unload it. Unloading does this too, but it cannot free
 *  worlds with a host's allocator. Afterwards the library may be used again. Always returns OK.
 *  Threads: any, but not while another call is under way. */
PBMPM_API pbmpm_result pbmpm_shutdown(void);

#ifdef __cplusplus
}
#endif
#endif
