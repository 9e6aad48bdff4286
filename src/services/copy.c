#include "services/copy.h"

#include <string.h>

#include "base/numbers.h"
#include "base/result.h"
#include "services/background.h"
#include "services/views.h"

enum { ROW_GRAIN = 1024 };

static const pbmpm_field DRAWN[] = {PBMPM_POSITION, PBMPM_VELOCITY, PBMPM_MATERIAL};
enum { DRAWN_COUNT = sizeof DRAWN / sizeof *DRAWN };

pbmpm_copy_def copy_def_defaults(void) { return (pbmpm_copy_def){.size = sizeof(pbmpm_copy_def), .alpha = 1.0f}; }

const char *copy_problem(const pbmpm_copy_def *def)
{
    if (!in_range(def->alpha, 0.0, 1.0)) return "copy.alpha must be in [0, 1]";
    if (def->field_count > VIEW_FIELDS) return "copy.field_count is more than there are fields";
    if (def->field_count && !def->fields) return "copy.fields is null";
    for (uint32_t i = 0; i < def->field_count; i++)
        if (!views_is_field(def->fields[i])) return "copy.fields has a field that does not exist";
    if (def->stride % sizeof(float) != 0) return "copy.stride must be a multiple of 4";
    if (def->offset % sizeof(float) != 0) return "copy.offset must be a multiple of 4";
    if (def->pads_vectors != 0 && def->pads_vectors != 1) return "copy.pads_vectors must be 0 or 1";
    return NULL;
}

/* Where 4 bytes of a record come from; with `speed`, the places of before. */
typedef struct Word {
    const char *from, *speed;
    uint64_t stride, speed_stride;
} Word;

enum { WORDS_MAX = 9 * VIEW_FIELDS }; /* matrices */

typedef struct Copying {
    Word word[WORDS_MAX];
    int words;
    float back; /* how long ago [s] */
    size_t stride, offset;
    char *out;
} Copying;

static uint32_t place_before(uint32_t place_bits, const char *speed_at, float back)
{
    float place, speed;
    memcpy(&place, &place_bits, sizeof place);
    memcpy(&speed, speed_at, sizeof speed);
    place -= back * speed;
    memcpy(&place_bits, &place, sizeof place);
    return place_bits;
}

/* Record by record, and nothing is read back: that is how memory of a GPU likes to be written. */
static void copy_rows(void *context, int32_t begin, int32_t end)
{
    const Copying *copying = context;
    const float back = copying->back;
    const int words = copying->words;
    for (size_t row = (size_t)begin; row < (size_t)end; row++) {
        char *out = copying->out + row * copying->stride + copying->offset;
        for (int w = 0; w < words; w++, out += sizeof(float)) {
            const Word *word = &copying->word[w];
            uint32_t bits; /* whatever they mean */
            memcpy(&bits, word->from + row * word->stride, sizeof bits);
            if (word->speed) bits = place_before(bits, word->speed + row * word->speed_stride, back);
            memcpy(out, &bits, sizeof bits);
        }
    }
}

static pbmpm_result look(World *world, pbmpm_field field, pbmpm_view *view)
{
    return background_is_stepping(world) ? background_view(world, field, view) : views_get(world, field, view);
}

static const char *component_of(const pbmpm_view *view, uint32_t component)
{
    return view->data ? (const char *)view->data + (size_t)component * view->component_stride : NULL;
}

/* Adds the words of a field; `velocity` is null unless its places are those of before. */
static void add_words(Copying *copying, const pbmpm_view *view, const pbmpm_view *velocity, uint32_t wanted)
{
    static const float zero = 0.0f;
    for (uint32_t c = 0; c < wanted; c++) {
        Word *word = &copying->word[copying->words++];
        *word = (Word){.from = (const char *)&zero};
        if (c >= view->components) continue;
        word->from = component_of(view, c);
        word->stride = view->stride;
        if (!velocity) continue;
        word->speed = component_of(velocity, c);
        word->speed_stride = velocity->stride;
    }
}

static pbmpm_result plan(World *world, const pbmpm_copy_def *def, Copying *copying)
{
    const pbmpm_field *fields = def->field_count ? def->fields : DRAWN;
    const uint32_t count = def->field_count ? def->field_count : DRAWN_COUNT;
    const float seconds = background_is_stepping(world) ? background_seconds(world) : world->record.seconds;
    pbmpm_view view, velocity;
    *copying = (Copying){.back = (1.0f - def->alpha) * seconds, .offset = def->offset};
    pbmpm_result result = copying->back != 0.0f ? look(world, PBMPM_VELOCITY, &velocity) : PBMPM_OK;
    for (uint32_t f = 0; f < count && result == PBMPM_OK; f++) {
        const bool is_vector = fields[f] == PBMPM_POSITION || fields[f] == PBMPM_VELOCITY, moves = fields[f] == PBMPM_POSITION && copying->back != 0.0f;
        result = look(world, fields[f], &view);
        if (result == PBMPM_OK) add_words(copying, &view, moves ? &velocity : NULL, is_vector && def->pads_vectors ? 3 : view.components);
    }
    if (result != PBMPM_OK) return result;
    const size_t bytes = def->offset + (size_t)copying->words * sizeof(float);
    copying->stride = def->stride ? def->stride : bytes;
    return bytes <= copying->stride ? PBMPM_OK : fail(PBMPM_ERROR_INVALID_ARGUMENT, "copy.stride is %u; offset and fields take %zu bytes", def->stride, bytes);
}

pbmpm_result copy_particles(World *world, const pbmpm_copy_def *def, void *buffer, uint64_t capacity, uint32_t *count)
{
    Copying copying;
    const pbmpm_result result = plan(world, def, &copying);
    if (result != PBMPM_OK) return result;
    const bool stepping = background_is_stepping(world);
    *count = stepping ? background_count(world) : world->particles.count;
    if (*count * (uint64_t)copying.stride > capacity)
        return fail(PBMPM_ERROR_CAPACITY, "%u particles of %zu bytes do not fit into %llu", *count, copying.stride, (unsigned long long)capacity);
    copying.out = buffer;
    if (stepping) /* the threads are the step's */
        copy_rows(&copying, 0, (int32_t)*count);
    else
        pool_for(world->pool, (int32_t)*count, ROW_GRAIN, copy_rows, &copying);
    return PBMPM_OK;
}
