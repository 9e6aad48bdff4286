#include "services/background.h"

#include <pthread.h>
#include <stdio.h>
#include <string.h>

#include "base/assertion.h"
#include "base/cpu.h"
#include "base/result.h"
#include "base/thread.h"
#include "services/stats.h"
#include "services/views.h"
#include "step/step.h"

enum { FIELDS = VIEW_FIELDS, SETS = 2 };

/* What a step that was begun is at. Whoever first needs the copies makes them: the step, or a view that is asked for before. */
typedef enum Stage { IDLE, BEGUN, COPYING, COPIED, DONE } Stage;

struct Background {
    World *world;
    pbmpm_field wanted[FIELDS];
    uint32_t wanted_count;

    /* Copies of published fields, by field. Steps take turns with the two sets, so a renderer that is a frame late reads a whole old frame. */
    char *copy[SETS][FIELDS];
    int turn; /* the set of this step, or of the last one */
    pbmpm_view view[FIELDS]; /* of its copies; size 0: not published in this step */
    pbmpm_stats stats; /* of the step before */
    float seconds;     /* that it lasted */
    uint64_t generation;

    bool begun; /* from a begin to its end */
    float dt;
    uint32_t host_mode; /* floating point, of the thread that began it */
    pbmpm_result result;
    char message[256];

    /* Who steps: a task of the host, or a thread. */
    bool has_task, has_thread;
    void *task; /* the host's handle */
    pthread_t thread;

    pthread_mutex_t lock; /* guards what follows */
    pthread_cond_t changed;
    Stage stage;
    bool quit;
};

/* ---- Published fields ---- */

const char *background_fields_problem(const pbmpm_field *fields, uint32_t count)
{
    bool seen[FIELDS] = {false};
    for (uint32_t i = 0; i < count; i++) {
        if (!views_is_field(fields[i])) return "a field to publish does not exist";
        if (seen[fields[i]]) return "a field is to be published twice";
        seen[fields[i]] = true;
    }
    return NULL;
}

static size_t copy_bytes(const World *world, pbmpm_field field)
{
    return (size_t)world->particles.capacity * views_components(world, field) * sizeof(float);
}

/* Copies a field, its components as far apart as they have to be, or side by side as they are. */
static void copy_field(Background *background, pbmpm_field field)
{
    pbmpm_view *view = &background->view[field];
    *view = (pbmpm_view){.size = sizeof *view};
    if (views_get(background->world, field, view) != PBMPM_OK) return;
    const char *from = view->data;
    char *to = background->copy[background->turn][field];
    view->data = view->count ? to : NULL;
    view->generation = background->generation;
    if (view->stride == (uint64_t)view->components * view->component_stride) {
        if (view->count) memcpy(to, from, view->count * view->stride);
        return;
    }
    const uint32_t apart = (uint32_t)(background->world->particles.capacity * sizeof(float));
    for (uint32_t c = 0; c < view->components && view->count; c++)
        memcpy(to + (size_t)c * apart, from + (size_t)c * view->component_stride, view->count * sizeof(float));
    view->component_stride = apart;
}

static void copy_fields(Background *background)
{
    memset(background->view, 0, sizeof background->view);
    for (uint32_t i = 0; i < background->wanted_count; i++)
        if (views_has(background->world, background->wanted[i])) copy_field(background, background->wanted[i]);
}

static pbmpm_result reserve_copies(World *world)
{
    Background *background = world->background;
    for (uint32_t i = 0; i < SETS * background->wanted_count; i++) {
        const pbmpm_field field = background->wanted[i / SETS];
        char **copy = &background->copy[i % SETS][field];
        if (!*copy) *copy = memory_take(&world->memory, copy_bytes(world, field));
        if (!*copy) return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory to publish field %d", (int)field);
    }
    return PBMPM_OK;
}

/* ---- The step ---- */

static void enter_stage(Background *background, Stage stage)
{
    pthread_mutex_lock(&background->lock);
    background->stage = stage;
    pthread_cond_broadcast(&background->changed);
    pthread_mutex_unlock(&background->lock);
}

/* Returns when the copies are there; makes them unless another thread does. So nobody waits for a step that has no thread yet. */
static void need_copies(Background *background)
{
    pthread_mutex_lock(&background->lock);
    const bool mine = background->stage == BEGUN;
    if (mine) background->stage = COPYING;
    while (!mine && background->stage == COPYING) pthread_cond_wait(&background->changed, &background->lock);
    pthread_mutex_unlock(&background->lock);
    if (!mine) return;
    copy_fields(background);
    enter_stage(background, COPIED);
}

/* Whether nobody wants the step any more that is still to be made. */
static bool is_given_up(Background *background)
{
    pthread_mutex_lock(&background->lock);
    const bool quit = background->quit;
    pthread_mutex_unlock(&background->lock);
    return quit;
}

static void step(Background *background)
{
    ASSERT(background->begun);
    const FloatModes modes = float_mode_enter_for(background->host_mode);
    need_copies(background);
    background->result = world_step(background->world, background->dt);
    snprintf(background->message, sizeof background->message, "%s", background->result == PBMPM_OK ? "" : result_message());
    float_mode_leave_for(modes);
    enter_stage(background, DONE);
}

/* Returns false when the thread has to end. */
static bool wait_for_step(Background *background)
{
    pthread_mutex_lock(&background->lock);
    while ((background->stage == IDLE || background->stage == DONE) && !background->quit) pthread_cond_wait(&background->changed, &background->lock);
    const bool go = !background->quit;
    pthread_mutex_unlock(&background->lock);
    return go;
}

static void *thread_main(void *context)
{
    Background *background = context;
    while (wait_for_step(background)) step(background);
    return NULL;
}

static void host_step(int32_t index, void *context)
{
    (void)index;
    if (!is_given_up(context)) step(context);
}

/* ---- Life ---- */

static pbmpm_result make(World *world)
{
    static const pbmpm_field usual[] = {PBMPM_POSITION, PBMPM_VELOCITY, PBMPM_MATERIAL, PBMPM_PARTICLE};
    if (world->background) return PBMPM_OK;
    Background *background = memory_take(&world->memory, sizeof *background);
    if (!background) return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for steps in the background");
    background->world = world;
    memcpy(background->wanted, usual, sizeof usual);
    background->wanted_count = sizeof usual / sizeof *usual;
    pthread_mutex_init(&background->lock, NULL);
    pthread_cond_init(&background->changed, NULL);
    world->background = background;
    return PBMPM_OK;
}

/* Whether the host's tasks may wait for tasks of their own, as a step does. */
static bool runs_on_host(const World *world) { return world->def.tasks && world->def.tasks->nests; }

static pbmpm_result start_thread(Background *background)
{
    if (background->has_thread || runs_on_host(background->world)) return PBMPM_OK;
    background->has_thread = thread_start(&background->thread, thread_main, background);
    return background->has_thread ? PBMPM_OK : fail(PBMPM_ERROR_THREAD, "could not start the thread of the step");
}

/* Gives the host's handle back; waits if the step is not done. */
static void finish_task(Background *background)
{
    const pbmpm_task_hooks *hooks = &background->world->tasks;
    if (!background->has_task) return;
    background->has_task = false;
    const uint32_t mode = float_mode_lend();
    hooks->finish(background->task, hooks->user);
    float_mode_take_back(mode);
}

void background_stop(World *world, bool here)
{
    Background *background = world->background;
    if (!background || !here) return;
    pthread_mutex_lock(&background->lock);
    background->quit = true;
    pthread_cond_broadcast(&background->changed);
    pthread_mutex_unlock(&background->lock);
    finish_task(background);
    if (background->has_thread) thread_join(background->thread);
    background->has_thread = false;
    pthread_cond_destroy(&background->changed);
    pthread_mutex_destroy(&background->lock);
}

void background_free(World *world)
{
    Background *background = world->background;
    if (!background) return;
    for (int i = 0; i < SETS * FIELDS; i++)
        memory_give(&world->memory, background->copy[i % SETS][i / SETS], copy_bytes(world, (pbmpm_field)(i / SETS)));
    memory_give(&world->memory, background, sizeof *background);
    world->background = NULL;
}

/* ---- Calls ---- */

pbmpm_result background_publish(World *world, const pbmpm_field *fields, uint32_t count)
{
    const pbmpm_result result = make(world);
    if (result != PBMPM_OK) return result;
    if (count) memcpy(world->background->wanted, fields, count * sizeof *fields);
    world->background->wanted_count = count;
    return PBMPM_OK;
}

bool background_is_stepping(const World *world) { return world->background && world->background->begun; }

pbmpm_result background_begin(World *world, float dt)
{
    pbmpm_result result = make(world);
    if (result == PBMPM_OK) result = reserve_copies(world);
    if (result == PBMPM_OK) result = start_thread(world->background);
    if (result != PBMPM_OK) return result;
    Background *background = world->background;
    world_expire_views(world);
    background->turn = (background->turn + 1) % SETS;
    stats_of_step(world, &background->stats);
    background->seconds = world->record.seconds;
    background->generation = world->generation;
    background->dt = dt;
    background->host_mode = float_mode_of_host();
    background->begun = true;
    ASSERT(background->stage == IDLE && !background->has_task);
    enter_stage(background, BEGUN);
    if (!runs_on_host(world)) return PBMPM_OK;
    const pbmpm_task_hooks *hooks = &world->tasks;
    const uint32_t mode = float_mode_lend();
    background->task = hooks->enqueue(host_step, 1, background, hooks->user);
    float_mode_take_back(mode);
    background->has_task = true;
    return PBMPM_OK;
}

static pbmpm_result no_step(void) { return fail(PBMPM_ERROR_INVALID_ARGUMENT, "no step is under way: none was begun"); }

pbmpm_result background_done(World *world, int32_t *done)
{
    Background *background = world->background;
    if (!background_is_stepping(world)) return no_step();
    pthread_mutex_lock(&background->lock);
    *done = background->stage == DONE;
    pthread_mutex_unlock(&background->lock);
    return PBMPM_OK;
}

pbmpm_result background_end(World *world, bool wait)
{
    Background *background = world->background;
    if (!background_is_stepping(world)) return no_step();
    if (wait) finish_task(background);
    pthread_mutex_lock(&background->lock);
    while (wait && background->stage != DONE) pthread_cond_wait(&background->changed, &background->lock);
    const bool done = background->stage == DONE;
    if (done) background->stage = IDLE;
    pthread_mutex_unlock(&background->lock);
    if (!done) return result_pass_on(PBMPM_ERROR_BUSY, "the step is not done yet"); /* an answer, not a failure to log */
    finish_task(background);
    background->begun = false;
    return background->result == PBMPM_OK ? PBMPM_OK : result_pass_on(background->result, background->message);
}

pbmpm_result background_view(World *world, pbmpm_field field, pbmpm_view *view)
{
    Background *background = world->background;
    bool wanted = false;
    if (!views_is_field(field)) return views_no_field(field);
    for (uint32_t i = 0; i < background->wanted_count; i++) wanted |= background->wanted[i] == field;
    if (!wanted) return fail(PBMPM_ERROR_BUSY, "field %d is not published, and a step is under way", (int)field);
    need_copies(background);
    if (background->view[field].size == 0) return fail(PBMPM_ERROR_UNSUPPORTED, "the world does not have field %d yet", (int)field);
    *view = background->view[field];
    return PBMPM_OK;
}

uint32_t background_count(const World *world) { return world->background->stats.particle_count; }

const pbmpm_stats *background_step_stats(const World *world) { return &world->background->stats; }

float background_seconds(const World *world) { return world->background->seconds; }

uint64_t background_generation(const World *world) { return world->background->generation; }
