#include "copy.h"

#include <string.h>

#include "background.h"
#include "inspect.h"
#include "numbers.h"
#include "result.h"

enum { ROW_GRAIN = 1024 };

static const pbmpm_field DRAWN[] = {PBMPM_POSITION, PBMPM_VELOCITY, PBMPM_MATERIAL};
enum { DRAWN_COUNT = sizeof DRAWN / sizeof *DRAWN };

pbmpm_copy_def copy_def_defaults(void) { return (pbmpm_copy_def){.size = sizeof(pbmpm_copy_def), .alpha = 1.0f}; }

const char *copy_problem(const pbmpm_copy_def *def)
{
    if (!in_range(def->alpha, 0.0, 1.0)) return "copy.alpha must be in [0, 1]";
    if (def->field_count > INSPECT_FIELDS) return "copy.field_count is more than there are fields";
    if (def->field_count && !def->fields) return "copy.fields is null";
    for (uint32_t i = 0; i < def->field_count; i++)
        if (!inspect_is_field(def->fields[i])) return "copy.fields has a field that does not exist";
    if (def->stride % sizeof(float) != 0) return "copy.stride must be a multiple of 4";
    if (def->offset % sizeof(float) != 0) return "copy.offset must be a multiple of 4";
    if (def->pads_vectors != 0 && def->pads_vectors != 1) return "copy.pads_vectors must be 0 or 1";
    return NULL;
}

typedef struct Copying {
    pbmpm_view view[INSPECT_FIELDS];
    bool is_position[INSPECT_FIELDS];
    uint32_t zeros[INSPECT_FIELDS]; /* behind its components */
    int fields;
    pbmpm_view velocity;
    float back; /* how long ago [s] */
    size_t stride, offset;
    char *out;
} Copying;

static float number_at(const pbmpm_view *view, size_t row, uint32_t component)
{
    float value;
    memcpy(&value, (const char *)view->data + row * view->stride + (size_t)component * view->component_stride, sizeof value);
    return value;
}

/* 4 bytes per component, whatever they mean. */
static void copy_rows(void *context, int32_t begin, int32_t end)
{
    const Copying *copying = context;
    for (size_t row = (size_t)begin; row < (size_t)end; row++) {
        char *out = copying->out + row * copying->stride + copying->offset;
        for (int f = 0; f < copying->fields; f++) {
            const pbmpm_view *view = &copying->view[f];
            for (uint32_t c = 0; c < view->components; c++, out += sizeof(float)) {
                const char *from = (const char *)view->data + row * view->stride + (size_t)c * view->component_stride;
                memcpy(out, from, sizeof(float));
                if (!copying->is_position[f] || copying->back == 0.0f) continue;
                const float place = number_at(view, row, c) - copying->back * number_at(&copying->velocity, row, c);
                memcpy(out, &place, sizeof place);
            }
            memset(out, 0, copying->zeros[f] * sizeof(float));
            out += copying->zeros[f] * sizeof(float);
        }
    }
}

static pbmpm_result look(World *world, pbmpm_field field, pbmpm_view *view)
{
    return background_is_stepping(world) ? background_view(world, field, view) : inspect_view(world, field, view);
}

static bool is_vector(pbmpm_field field) { return field == PBMPM_POSITION || field == PBMPM_VELOCITY; }

static pbmpm_result plan(World *world, const pbmpm_copy_def *def, Copying *copying)
{
    const pbmpm_field *fields = def->field_count ? def->fields : DRAWN;
    const float seconds = background_is_stepping(world) ? background_seconds(world) : world->record.seconds;
    size_t bytes = def->offset;
    *copying = (Copying){.fields = def->field_count ? (int)def->field_count : DRAWN_COUNT, .back = (1.0f - def->alpha) * seconds, .offset = def->offset};
    pbmpm_result result = copying->back != 0.0f ? look(world, PBMPM_VELOCITY, &copying->velocity) : PBMPM_OK;
    for (int f = 0; f < copying->fields && result == PBMPM_OK; f++) {
        result = look(world, fields[f], &copying->view[f]);
        copying->is_position[f] = fields[f] == PBMPM_POSITION;
        if (def->pads_vectors && is_vector(fields[f])) copying->zeros[f] = 3 - copying->view[f].components;
        bytes += (copying->view[f].components + copying->zeros[f]) * sizeof(float);
    }
    if (result != PBMPM_OK) return result;
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
