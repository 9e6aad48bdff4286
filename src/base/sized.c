#include "base/sized.h"

#include <stdbool.h>
#include <string.h>

#include "base/result.h"

#define END(structure, field) (offsetof(structure, field) + sizeof(((structure *)0)->field))

/* A new member must not lie in what was padding: an older caller never set it. */
#define PBMPM_SIZED(structure, remedy, newest, ...) _Static_assert((newest) == sizeof(structure), #structure " ends in padding");
#include PBMPM_SIZED_TABLE
#undef PBMPM_SIZED

enum { VERSIONS_MAX = 32 };

typedef struct Sized {
    const char *name;
    const char *remedy;           /* what sets the size */
    uint32_t sizes[VERSIONS_MAX]; /* of this version and those before it, then zeros */
} Sized;

static const Sized table[SIZED_COUNT] = {
#define PBMPM_SIZED(structure, remedy, ...) {#structure, remedy, {__VA_ARGS__}},
#include PBMPM_SIZED_TABLE
#undef PBMPM_SIZED
};

static bool had_size(const Sized *type, size_t size)
{
    if (size > type->sizes[0]) return size <= SIZED_MAX;
    for (int i = 0; i < VERSIONS_MAX && type->sizes[i]; i++)
        if (size == type->sizes[i]) return true;
    return false;
}

static uint32_t size_of(const void *given)
{
    uint32_t size;
    memcpy(&size, given, sizeof size);
    return size;
}

static size_t least(size_t a, size_t b) { return a < b ? a : b; }

pbmpm_result sized_check(int type, const char *call, const char *name, const void *given)
{
    const Sized *sized = &table[type];
    if (!given) return fail(PBMPM_ERROR_INVALID_ARGUMENT, "%s: %s is null", call, name);
    const uint32_t size = size_of(given);
    if (had_size(sized, size)) return PBMPM_OK;
    if (size == 0) return fail(PBMPM_ERROR_UNSUPPORTED, "%s: %s.size is 0: %s first", call, name, sized->remedy);
    return fail(PBMPM_ERROR_UNSUPPORTED, "%s: %s.size is %u, which no version of %s had; here it is %u: %s first", call, name, size, sized->name,
                sized->sizes[0], sized->remedy);
}

pbmpm_result sized_read(int type, const char *call, const char *name, const void *given, void *own)
{
    const pbmpm_result result = sized_check(type, call, name, given);
    if (result != PBMPM_OK) return result;
    const size_t known = table[type].sizes[0], size = size_of(given);
    const char *bytes = given;
    for (size_t i = known; i < size; i++)
        if (bytes[i] != 0)
            return fail(PBMPM_ERROR_UNSUPPORTED, "%s: %s sets a member at byte %zu, of a later version of %s; this library knows %zu bytes", call, name, i,
                        table[type].name, known);
    const size_t after = sizeof(uint32_t);
    memcpy((char *)own + after, bytes + after, least(known, size) - after);
    return PBMPM_OK;
}

void sized_write(int type, void *given, uint32_t size, const void *own)
{
    const size_t known = table[type].sizes[0];
    memcpy(given, own, least(known, size));
    if (size > known) memset((char *)given + known, 0, size - known);
    memcpy(given, &size, sizeof size);
}

void sized_put(int type, void *array, uint32_t index, const void *own)
{
    const uint32_t size = size_of(array);
    sized_write(type, (char *)array + (size_t)index * size, size, own);
}

pbmpm_result sized_init(int type, const char *call, void *given, size_t size, const void *defaults)
{
    const Sized *sized = &table[type];
    if (!given) return fail(PBMPM_ERROR_INVALID_ARGUMENT, "%s: the structure to fill is null", call);
    if (!had_size(sized, size))
        return fail(PBMPM_ERROR_UNSUPPORTED, "%s: no version of %s has %zu bytes; here it has %u", call, sized->name, size, sized->sizes[0]);
    sized_write(type, given, (uint32_t)size, defaults);
    return PBMPM_OK;
}
